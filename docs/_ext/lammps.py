# SPDX-License-Identifier: GPL-2.0-only
"""What LAMMPS's own manual has and Sphinx has not: colours of in-files, and its pages. The pages of
lammps_pkg/doc name them as LAMMPS's do, :doc:`fix pour <fix_pour>`; here these links lead to docs.lammps.org."""

from docutils import nodes
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Number, String, Text, Whitespace

COMMANDS = "lammps_pkg/doc/"


class LammpsLexer(RegexLexer):
    name, aliases = "LAMMPS", ["LAMMPS"]
    tokens = {
        "root": [
            (r"\s+", Whitespace),
            (r"#.*", Comment),
            (r"(fix|compute|region|group|variable|dump)(\s+)(\S+)", bygroups(Keyword, Whitespace, Name.Variable), "line"),
            (r"\w+", Keyword, "line"),
            (r".", Text, "line"),
        ],
        "line": [
            (r"&[ \t]*\n", Text),
            (r"\n", Whitespace, "#pop"),
            (r"[ \t]+", Whitespace),
            (r"#.*", Comment),
            (r"\$\{\w+\}|\$\w|\$\([^)\n]*\)|\bv_\w+|\b[cf]_\w+(\[\w+\])*", Name.Variable),
            (r'"""(.|\n)*?"""|"[^"\n]*"|\'[^\'\n]*\'', String),
            (r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(?![\w.])", Number),
            (r"[\w/.]+|.", Text),
        ],
    }


def page_of_lammps(app, env, node, contnode):
    """A page that does not exist here, from a page of ours, is one of LAMMPS's: unless its name has eepa in it."""
    target = node.get("reftarget", "")
    if node.get("reftype") != "doc" or not node.get("refdoc", "").startswith(COMMANDS):
        return None
    if "eepa" in target or "/" in target:
        return None
    link = nodes.reference("", "", refuri=f"https://docs.lammps.org/{target}.html", internal=False)
    link += contnode
    return link


def setup(app):
    app.add_lexer("LAMMPS", LammpsLexer)
    app.connect("missing-reference", page_of_lammps)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

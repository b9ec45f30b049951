"""The syntax tree of C++ headers and sources, as clang prints it, with places in files.

Templates need not be instantiated: clang keeps the tree of their text. Only `clang++` is needed, of
any version from 14 on; no bindings.
"""

import json
import os
import re
import subprocess
import tempfile


class ParseError(Exception):
    """clang does not take the sources; says what it says."""


class Span:
    """Where an expression stands: its file, first character and the one after the last."""

    __slots__ = ("path", "begin", "end")

    def __init__(self, path, begin, end):
        self.path, self.begin, self.end = path, begin, end


def parse(compiler, flags, includes, namespace):
    """The trees of all declarations of a namespace that a file of these includes sees.

    Every node that stands in a file, and not in a macro, has its Span under "span".
    """
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as source:
        source.write("".join(f'#include "{path}"\n' for path in includes))
        source.flush()
        done = subprocess.run(
            [compiler, "-fsyntax-only", "-w", *flags, "-Xclang", "-ast-dump=json", "-Xclang",
             "-ast-dump-filter=" + namespace, source.name], capture_output=True, text=True)
    if done.returncode:
        raise ParseError(done.stderr)
    decoder, trees, at = json.JSONDecoder(), [], 0
    text = done.stdout
    while True:
        at = text.find("{", at)
        if at < 0:
            return trees
        tree, at = decoder.raw_decode(text, at)
        # some versions count what is specialised for a type of the namespace, elsewhere
        if tree["kind"] == "NamespaceDecl":
            _Places().resolve(tree)
            trees.append(tree)


class _Places:
    """Fills in spans. clang names a file only where it is another one than before."""

    def __init__(self):
        self.path = None

    def resolve(self, node):
        for key, value in list(node.items()):
            if key == "loc":
                self.position(value)
            elif key == "range":
                begin, end = self.position(value["begin"]), self.position(value["end"])
                if begin and end and begin[0] == end[0]:
                    node["span"] = Span(begin[0], begin[1], end[1] + end[2])
            elif key == "inner":
                for child in value:
                    self.resolve(child)

    def position(self, loc):
        """(path, offset, length of the token), of a macro's use where it is one."""
        if "expansionLoc" in loc:
            self.position(loc["spellingLoc"])
            return self.position(loc["expansionLoc"])
        if "offset" not in loc:
            return None
        self.path = loc.get("file", self.path)
        return os.path.realpath(self.path), loc["offset"], loc["tokLen"]


def type_of(node):
    """The type as it is written, "" where there is none."""
    return node.get("type", {}).get("qualType", "")


def bare(kind):
    """A type without const, references and blanks."""
    return re.sub(r"\bconst\b|&|\s+", "", kind)


def name_below(node):
    """The first name under a node: of a function that is called, say."""
    while node:
        if node.get("kind") in ("UnresolvedLookupExpr", "MemberExpr", "UnresolvedMemberExpr"):
            return node.get("name")
        if node.get("kind") == "CXXDependentScopeMemberExpr":
            return node.get("member")
        if "referencedDecl" in node:
            return node["referencedDecl"].get("name")
        node = node["inner"][0] if node.get("inner") else None
    return None


def operator_name(node):
    """What stands behind `operator` where an overloaded one is called, else None."""
    if node.get("kind") != "CXXOperatorCallExpr":
        return None
    name = name_below(node["inner"][0]) or ""
    return name[len("operator"):] if name.startswith("operator") else None


def callee(node):
    """The name of the function that a node calls, "" where it has none."""
    return (name_below(node["inner"][0]) or "").lstrip(".->") if node.get("inner") else ""

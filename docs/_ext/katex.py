# SPDX-License-Identifier: GPL-2.0-only
"""Formulas by KaTeX, from the system's package, without network: its program and its style sheet with the fonts in it
go into the site. (Browsers do not load a font from another folder for a page that is a file.)"""

import base64
import html
import os
import re
import shutil
from pathlib import Path

from docutils import nodes
from sphinx.errors import ExtensionError

FOLDER = Path(os.environ.get("KATEX", "/usr/share/javascript/katex"))


def formula(text, display):
    """What is given to KaTeX: a formula of several lines needs an environment around them."""
    if display and "\\\\" in text and "\\begin" not in text:
        return "\\begin{split}" + text + "\\end{split}"
    return text


def inline(writer, node):
    writer.body.append(f'<span class="math">{html.escape(formula(node.astext(), False))}</span>')
    raise nodes.SkipNode


def block(writer, node):
    writer.body.append(f'<div class="math">{html.escape(formula(node.astext(), True))}</div>\n')
    raise nodes.SkipNode


def with_fonts(css):
    """The style sheet with each font, in the one format that all browsers of today read, as part of it."""
    def embedded(match):
        font = base64.b64encode((FOLDER / match[1]).read_bytes()).decode()
        return f"src:url(data:font/woff2;base64,{font}) format('woff2')"
    return re.sub(r"src:url\((fonts/[^)]*\.woff2)\)[^;}]*", embedded, css)


def add_files(app):
    if app.builder.format != "html":
        return
    if not (FOLDER / "katex.min.js").exists():
        raise ExtensionError(f"no KaTeX in {FOLDER}: apt-get install libjs-katex, or set KATEX to its folder")
    made = Path(app.doctreedir) / "katex"
    made.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(FOLDER / "katex.min.js", made / "katex.js")
    (made / "katex.css").write_text(with_fonts((FOLDER / "katex.min.css").read_text()))
    app.config.html_static_path.append(str(made))
    app.add_css_file("katex.css")
    app.add_js_file("katex.js", loading_method="defer")
    app.add_js_file("formulas.js", loading_method="defer")


def setup(app):
    app.add_html_math_renderer("katex", (inline, None), (block, None))
    app.connect("builder-inited", add_files)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

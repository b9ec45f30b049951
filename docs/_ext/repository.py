# SPDX-License-Identifier: GPL-2.0-only
"""Pages of the repository as pages of the site: what a reader of the files sees and Sphinx does not."""

import os
import re
from pathlib import Path


def links_of_files(app, docname, source):
    """In Markdown a link may name a folder: its page is the README there, or the only page. The repository's own README
    is for those who look at files; here its place is taken by the first page."""
    page = Path(app.env.doc2path(docname))
    if page.suffix != ".md":
        return
    here = page.parent
    root = Path(app.srcdir)

    def link(match):
        target = (here / match[1]).resolve()
        if target == root / "README.md":
            return f"]({os.path.relpath(root / app.config.root_doc, here)}.rst)"
        pages = list(target.glob("README.md")) or list(target.glob("*.md"))
        return f"]({match[1].rstrip('/')}/{pages[0].name})" if len(pages) == 1 else match[0]
    source[0] = re.sub(r"\]\(([\w./-]+)\)", link, source[0])


def open_at_top(app, error):
    """The site's first page is in docs/; whoever opens the folder finds it."""
    if not error and app.builder.name == "html":
        (Path(app.outdir) / "index.html").write_text(
            '<!DOCTYPE html>\n<meta charset="utf-8"><title>eepa</title>\n'
            '<meta http-equiv="refresh" content="0; url=docs/index.html">\n'
            '<a href="docs/index.html">eepa</a>\n')


def setup(app):
    app.connect("source-read", links_of_files)
    app.connect("build-finished", open_at_top)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

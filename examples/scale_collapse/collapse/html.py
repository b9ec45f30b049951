# SPDX-License-Identifier: GPL-2.0-only
"""One HTML file without outside assets."""
from __future__ import annotations

import base64
from html import escape
from pathlib import Path
from typing import List, Sequence

_STYLE = """body { font-family: sans-serif; max-width: 75em; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; font-size: 85%; margin: 1em 0; }
td, th { border: 1px solid #ccc; padding: 0.2em 0.5em; text-align: right; }
th { background: #f0f0f0; } td:first-child { text-align: left; }
img { max-width: 100%; } figure { margin: 1em 0; } figcaption { font-size: 90%; color: #333; }
.pair figure { display: inline-block; width: 45%; } pre { overflow: auto; background: #f7f7f7; }"""


class Page:
    """Collects a page's parts in order."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._parts: List[str] = [f"<h1>{escape(title)}</h1>"]

    def heading(self, text: str) -> None:
        self._parts.append(f"<h2>{escape(text)}</h2>")

    def paragraph(self, text: str) -> None:
        self._parts.append(f"<p>{escape(text)}</p>")

    def preformatted(self, text: str) -> None:
        self._parts.append(f"<pre>{escape(text)}</pre>")

    def table(self, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        def line(cells: Sequence[str], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"
        self._parts.append("<table>" + line(header, "th")
                           + "\n".join(line(row, "td") for row in rows) + "</table>")

    def picture(self, path: Path, caption: str) -> None:
        """A PNG, in the page itself."""
        self._parts.append(_figure(path, caption))

    def pair(self, paths: Sequence[Path], captions: Sequence[str]) -> None:
        """Pictures side by side."""
        self._parts.append('<div class="pair">' + "".join(
            _figure(path, caption) for path, caption in zip(paths, captions)) + "</div>")

    def write(self, path: Path) -> None:
        path.write_text("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                        f"<title>{escape(self._title)}</title><style>{_STYLE}</style></head>"
                        "<body>\n" + "\n".join(self._parts) + "\n</body></html>\n",
                        encoding="utf-8")


def _figure(path: Path, caption: str) -> str:
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    return (f'<figure><img alt="{escape(caption)}" src="data:image/png;base64,{data}">'
            f"<figcaption>{escape(caption)}</figcaption></figure>")

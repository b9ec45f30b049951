# SPDX-License-Identifier: GPL-2.0-only
"""What test_site.py needs of a page: links, names that links may end at, formulas, blocks of code."""
from __future__ import annotations

import html.parser
from pathlib import Path
from typing import List, NamedTuple, Optional, Tuple

VOID = {"meta", "link", "img", "br", "hr", "input", "col"}    # elements without an end


class Block(NamedTuple):
    language: str
    text: str
    is_pattern: bool    # under the heading Syntax, with names in the place of values


class Formula(NamedTuple):
    text: str
    display: bool


class Page(html.parser.HTMLParser):
    def __init__(self, path: Path):
        super().__init__()
        self.links: List[Tuple[str, str]] = []    # element, target
        self.names: List[str] = []
        self.blocks: List[Block] = []
        self.formulas: List[Formula] = []
        self._open: List[Tuple[str, str, str]] = []    # element, class, id
        self._text: Optional[str] = None
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        at = {name: value or "" for name, value in attrs}
        if "id" in at:
            self.names.append(at["id"])
        self.links += [(tag, at[name]) for name in ("href", "src") if name in at]
        if tag in VOID:
            return
        self._open.append((tag, at.get("class", ""), at.get("id", "")))
        if tag == "pre" or "math" in at.get("class", "").split():
            self._text = ""

    def handle_data(self, data):
        if self._text is not None:
            self._text += data

    def handle_endtag(self, tag):
        if tag not in {name for name, _, _ in self._open}:
            return
        while True:
            name, classes, _ = self._open.pop()
            if name == tag:
                break
        if self._text is None or not (tag == "pre" or "math" in classes.split()):
            return
        if tag == "pre":
            around = [word for _, words, _ in self._open for word in words.split()]
            language = next((word[len("highlight-"):] for word in around if word.startswith("highlight-")), "")
            self.blocks.append(Block(language, self._text, any(name == "syntax" for _, _, name in self._open)))
        else:
            self.formulas.append(Formula(self._text, tag == "div"))
        self._text = None

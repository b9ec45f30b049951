"""Writes mutants into the text of a file, all of them or one.

All of them: each site becomes a choice that is made when the program runs (mutant schemata: Untch,
Offutt, Harrold, ISSTA 1993), so that thousands of mutants are compiled once. One: the plain text of
a file with a single fault, for sites where the language wants a constant.
"""

import re

STRING_OR_COMMENT = re.compile(
    r"""("(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')|//[^\n]*|/\*.*?\*/""", re.S)
EMPTY = re.compile(r"[ \t]*\n(?:[ \t]*\n)*")


def number_all(sites):
    """Gives the mutants that are chosen at run time their numbers, from 1 on."""
    number = 1
    for site in sites:
        for mutant in site.mutants:
            mutant.number = None if site.frozen else number
            number += not site.frozen


def with_one(source, mutant):
    """The text of a file with one fault."""
    site = mutant.site
    text = {"expression": f"({mutant.text})", "block": "{ }"}.get(site.kind, mutant.text)
    return source[:site.begin] + text + source[site.end:]


class Schemata:
    """The text of a file with all its mutants that are chosen at run time.

    softened: as Finder has it. head: what the text begins with, such as the #include of mutant.h.
    text: the result, without comments, so that another comment is no reason to compile. site_at()
    says to which site a place in it belongs.
    """

    def __init__(self, path, source, sites, softened, head=""):
        self.source = source
        self.sites = [site for site in sites if site.path == path and not site.frozen]
        self.edits = sorted((begin, end, text) for p, begin, end, text in softened if p == path)
        self.next = 0    # site; they come in the order of their begin, the outer one first
        self.parts, self.length, self.spans = [], 0, []
        self._emit(head)
        self._between(0, len(source))
        self.text = "".join(self.parts)

    def site_at(self, line, column):
        """The innermost site at a place of the text, or None."""
        lines = self.text.split("\n")
        place = sum(len(text) + 1 for text in lines[:line - 1]) + column - 1
        inside = [(end - begin, number) for number, (begin, end, _) in enumerate(self.spans)
                  if begin <= place < end]
        return self.spans[min(inside)[1]][2] if inside else None

    def _emit(self, text):
        self.parts.append(text)
        self.length += len(text)

    def _between(self, begin, end):
        while self.next < len(self.sites) and self.sites[self.next].begin < end:
            site = self.sites[self.next]
            self.next += 1
            self._plain(begin, site.begin)
            start = self.length
            self._choice(site)
            self.spans.append((start, self.length, site))
            begin = site.end
        self._plain(begin, end)

    def _plain(self, begin, end):
        for first, last, text in self.edits:
            if begin <= first and last <= end:
                self._emit(_code(self.source[begin:first]) + text)
                begin = last
        self._emit(_code(self.source[begin:end]))

    def _choice(self, site):
        numbers = [mutant.number for mutant in site.mutants]
        others = [mutant.any_type for mutant in site.mutants]
        first = numbers[0]
        if site.kind == "constant":
            self._emit(f"eepa_mutant::constant<{first}>({site.original()}, {', '.join(others)})")
        elif site.kind == "block":
            self._emit(f"{{ if (!eepa_mutant::statement<{first}>()) ")
            self._between(site.begin, site.end)
            self._emit(" }")
        elif site.kind == "statement":
            for number, other in zip(numbers, others):
                self._emit(f"if (eepa_mutant::statement<{first}, {number}>()) {other}; else ")
            self._between(site.begin, site.end)
        else:
            self._emit(f"eepa_mutant::expression<{first}>([&] {{ return eepa_mutant::value(")
            self._between(site.begin, site.end)
            self._emit("); }")
            for other in others:
                self._emit(f", [&] {{ return eepa_mutant::value({other}); }}")
            self._emit(")")


def _code(text):
    """The text without comments and empty lines."""
    return EMPTY.sub("\n", STRING_OR_COMMENT.sub(lambda found: found[1] or "", text))

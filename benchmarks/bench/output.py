# SPDX-License-Identifier: GPL-2.0-only
"""Tables for the terminal, rows for a CSV."""
from __future__ import annotations

import csv
from pathlib import Path
from typing import List, Mapping, Sequence


def text_table(header: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """The first column to the left, the others to the right."""
    every: List[Sequence[str]] = [header, *lines]
    widths = [max(len(line[k]) for line in every) for k in range(len(header))]
    return "\n".join("  ".join(cell.ljust(width) if k == 0 else cell.rjust(width)
                               for k, (cell, width) in enumerate(zip(line, widths))).rstrip()
                     for line in every) + "\n"


def write_csv(path: Path, rows: Sequence[Mapping]) -> None:
    """Every key of any row is a column, in the order of their first appearance."""
    path.parent.mkdir(parents=True, exist_ok=True)
    names = list(dict.fromkeys(name for row in rows for name in row))
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, names, restval="")
        writer.writeheader()
        for row in rows:
            writer.writerow({name: f"{value:.6g}" if isinstance(value, float) else value
                             for name, value in row.items()})

# SPDX-License-Identifier: GPL-2.0-only
"""Loss of speed when particles no longer fit the cache: the same packing, and copies of it side by side."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Sequence

from .cases import Case
from .cost import one_run
from .lammps import Program
from .output import text_table
from .statistics import Median, column, median
from .styles import GRANULAR, HOOKE

STYLES = (HOOKE, GRANULAR, "gran/eepa full")
SECTIONS = ("pair", "neigh", "comm", "modify", "other")


def measure(program: Program, cases: Sequence[Case], rounds: int, work: Path) -> List[Dict]:
    """One row a run: each style with the sizes one after the other, round by round."""
    rows = []
    for k in range(rounds):
        for style in STYLES:
            for case in cases:
                row = {"case": case.name, "style": style, "round": k,
                       **one_run(program, case, style, work)}
                row["name"] = f"{style} {case.name}"
                row["ns"] = 1.0e9 * row["loop_s"] / (row["steps"] * row["atoms"])
                rows.append(row)
                print(f"  round {k + 1} of {rounds}: {row['name']}: {row['ns']:.1f} ns a particle "
                      "and step", flush=True)
    return rows


def loss(rows: Sequence[Dict], style: str, small: str, large: str) -> Median:
    """Ratio of particle steps a second between the two sizes, round by round."""
    one, other = (column(rows, f"{style} {case}", "name", "ns") for case in (small, large))
    return median([1.0 - one[k] / other[k] for k in sorted(one) if k in other])


def table(rows: Sequence[Dict]) -> str:
    header = ("case and style", "million particle steps/s", "lost, %", *(f"{s}, ns" for s in SECTIONS),
              "contacts", "neighbours", "CPU, %")
    cases = list(dict.fromkeys(row["case"] for row in rows))
    lines = []
    for style in dict.fromkeys(row["style"] for row in rows):
        for case in cases:
            own = [row for row in rows if row["style"] == style and row["case"] == case]
            last = own[-1]
            lost = "" if case == cases[0] else loss(rows, style, cases[0], case)
            lines.append([
                f"{style}, {case}",
                f"{1.0e3 / median([row['ns'] for row in own]).value:.2f}",
                f"{100.0 * lost.value:.1f} [{100.0 * lost.low:.1f}, {100.0 * lost.high:.1f}]"
                if lost else "",
                *(f"{median([row['ns'] * row[s + '_s'] / row['loop_s'] for row in own]).value:.1f}"
                  for s in SECTIONS),
                f"{last['contacts'] / last['atoms']:.2f}",
                f"{last['neighbours'] / last['atoms']:.2f}",
                f"{min(row['cpu_percent'] for row in own):.1f}"])
    return text_table(header, lines) + (
        "\nOf the whole loop, on one core: medians over the rounds; the loss of the median of "
        "the rounds' own, with its\nquartiles. A new neighbour list every 50 steps.\n")

# SPDX-License-Identifier: GPL-2.0-only
"""Cost of several types of particles: the same packing with 1, 2, 10 types in turn."""
from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Dict, List, Sequence

from .cases import Case
from .cost import one_run
from .lammps import Program
from .output import text_table
from .statistics import column, median, paired_ratios

STYLE = "gran/eepa full"
COUNTS = (1, 2, 10)


def measure(program: Program, case: Case, rounds: int, work: Path) -> List[Dict]:
    """One row a run: 1 2 10, 1 2 10, ... types."""
    rows = []
    for k in range(rounds):
        for types in COUNTS:
            row = {"case": case.name, "types": types, "round": k,
                   **one_run(program, replace(case, types=types), STYLE, work)}
            rows.append(row)
            print(f"  {case.name}, round {k + 1} of {rounds}: {types} types: pair "
                  f"{row['pair_s']:.3f} s of {row['loop_s']:.3f} s", flush=True)
    return rows


def table(rows: Sequence[Dict]) -> str:
    header = ("types", "pair, s", "pair / one type", "loop / one type", "contacts", "CPU, %")
    lines = []
    for types in dict.fromkeys(row["types"] for row in rows):
        own = [row for row in rows if row["types"] == types]
        lines.append([
            str(types), f"{median(list(column(rows, types, 'types', 'pair_s').values())).value:.3f}",
            *(median(paired_ratios(rows, types, 1, "types", value)).text()
              for value in ("pair_s", "loop_s")),
            f"{own[-1]['contacts'] / own[-1]['atoms']:.3f}",
            f"{min(row['cpu_percent'] for row in own):.1f}"])
    return text_table(header, lines) + (
        f"\n{rows[0]['case']}, {STYLE}; no two pairs of types have the same coefficients. Medians "
        "over the rounds,\nof ratios those of the rounds' ratios with their quartiles.\n")

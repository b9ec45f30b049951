# SPDX-License-Identifier: GPL-2.0-only
"""What gpu.py measured, in tables. Needs nothing but Python."""
from __future__ import annotations

import math
from typing import Dict, List, Mapping, Optional, Sequence, Tuple

from .gpu import REFERENCE
from .statistics import median, paired_ratios

#: Columns of the rows, what is told of them, and times which they are told.
_TOLD = (("ms_a_step", "Milliseconds a step", 1.0), ("pair_ms_a_step", "LAMMPS's section Pair, waiting for each kernel, ms a step", 1.0),
         ("contacts_a_particle", "Contacts a particle", 1.0), ("speed", "10^9 particle steps a second", 1e-9),
         ("joule_a_particle_step", "Energy of the card, nJ a particle step", 1e9))


def _known(rows: Sequence[Mapping], column: str) -> List[Mapping]:
    """Those that have it; the rows may be of a CSV file."""
    return [row for row in rows if row.get(column) not in (None, "")]


def _of(rows: Sequence[Mapping], law: str, column: str) -> Optional[float]:
    values = [float(row[column]) for row in _known(rows, column) if row["law"] == law]
    return median(values).value if values else None


def tables(rows: Sequence[Mapping]) -> str:
    """In Markdown, a line a size: medians, and in brackets those of ratios to the reference of the same round."""
    rows = [{**row, "speed": 1e3 * float(row["particles"]) / float(row["ms_a_step"])} for row in rows]
    laws = [law for law in dict.fromkeys(row["law"] for row in rows) if law != REFERENCE]
    head = ["| case | particles | gran/hooke/history | " + " | ".join(laws) + " |", "|---|---|---|" + "---|" * len(laws)]
    text: List[str] = []
    for column, title, times in _TOLD:
        lines = []
        for case, particles in dict.fromkeys((row["case"], row["particles"]) for row in rows):
            these = [row for row in rows if (row["case"], row["particles"]) == (case, particles)]
            cells = [_cell(these, law, column, times) for law in (REFERENCE, *laws)]
            if any(cells):
                lines.append(f"| {case} | {int(particles):,} | " + " | ".join(cells) + " |")
        if lines:
            text += [f"{title}:", "", *head, *lines, ""]
    lines = [f"| {case} | from {low:,} to {high:,} | " + " | ".join(cells) + " |"
             for case, (low, high, cells) in _memory(rows, (REFERENCE, *laws)).items()]
    if lines:
        text += ["Memory of the card, bytes a particle more:", "", *head, *lines, ""]
    return "\n".join(text)


def _cell(rows: Sequence[Mapping], law: str, column: str, times: float) -> str:
    value = _of(rows, law, column)
    if value is None:
        return ""
    ratios = [] if law == REFERENCE else paired_ratios(_known(rows, column), law, REFERENCE, "law", column)
    return f"{times * value:.3g}" + (f" ({median(ratios).value:.2f})" if ratios else "")


def _memory(rows: Sequence[Mapping], laws: Sequence[str]) -> Dict[str, Tuple[int, int, List[str]]]:
    """By case: smallest and largest size, and of each law how much memory grows between them; what a program without
    particles takes is not in it."""
    found = {}
    for case in dict.fromkeys(row["case"] for row in rows):
        sizes = sorted({int(row["particles"]) for row in rows if row["case"] == case})
        used = {(size, law): _of([r for r in rows if r["case"] == case and int(r["particles"]) == size], law, "card_bytes")
                for size in sizes for law in laws}
        if len(sizes) > 1 and any(used.values()):
            low, high = sizes[0], sizes[-1]
            found[case] = (low, high, [
                "" if used[low, law] is None or used[high, law] is None else
                f"{(used[high, law] - used[low, law]) / (high - low):.0f}" for law in laws])
    return found


def speeds(rows: Sequence[Mapping]) -> Dict[Tuple[str, str], List[Tuple[int, float]]]:
    """Of each case and law, numbers of particles and medians of particle steps a second."""
    found: Dict[Tuple[str, str], List[Tuple[int, float]]] = {}
    for case, law, particles in dict.fromkeys((row["case"], row["law"], row["particles"]) for row in rows):
        these = [row for row in rows if (row["case"], row["particles"]) == (case, particles)]
        found.setdefault((case, law), []).append((int(particles), 1e3 * int(particles) / (_of(these, law, "ms_a_step") or math.nan)))
    return found

# SPDX-License-Identifier: GPL-2.0-only
"""Instructions of a pair style's compute(), counted by callgrind and so free of noise."""
from __future__ import annotations

import re
import shutil
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Dict, List, Sequence, Tuple

from .cases import Case
from .lammps import Program, run_lammps, usable_cores
from .lammps_log import TimedRun, read_log
from .output import text_table
from .styles import GRANULAR, HOOKE, Style

STYLES = (HOOKE, GRANULAR, "gran/eepa elastic", "gran/eepa full", "gran/eepa plateau",
          "gran/eepa sds")
_TOTALS = re.compile(r"^totals: (\d+)", re.MULTILINE)


def available() -> bool:
    return shutil.which("valgrind") is not None


def measure(program: Program, case: Case, styles: Sequence[str], short: int, long: int,
            work: Path) -> List[Dict]:
    """Two runs of each style that differ only in the number of steps. The difference is free of what
    else is counted and is the same in both: force calls of set-ups, and the last step, which also
    tallies the energy. As many runs at once as there are cores, because nothing is timed."""
    lengths = (short, long)
    free = replace(program, bind=False)
    with ThreadPoolExecutor(len(usable_cores())) as pool:
        counts = {(name, steps): pool.submit(
                      _count, free, case.lasting(case.warm, steps), case.styles[name],
                      work / f"callgrind_{k}_{steps}")
                  for k, name in enumerate(styles) for steps in lengths}
        rows = []
        try:
            for name in styles:
                (few, before), (many, after) = (counts[name, steps].result() for steps in lengths)
                rows.append(_row(case, name, (many - few) / (long - short), before, after))
                print(f"  {case.name}: {name}: {rows[-1]['per_contact']:.1f} instructions a "
                      "contact", flush=True)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)    # waiting runs are not started
            raise
    return rows


def _row(case: Case, name: str, per_step: float, before: TimedRun, after: TimedRun) -> Dict:
    contacts = 0.5 * (before.figures["contacts_after"] + after.figures["contacts_after"])
    return {"case": case.name, "style": name, "atoms": after.atoms,
            "instructions_per_step": per_step, "contacts": contacts,
            "neighbours": after.neighbors, "per_contact": per_step / contacts,
            "per_neighbour": per_step / after.neighbors, "per_particle": per_step / after.atoms}


def _count(program: Program, case: Case, style: Style, folder: Path) -> Tuple[int, TimedRun]:
    variables = case.variables(style, folder)
    counts = folder / "callgrind.out"
    counts.unlink(missing_ok=True)
    done = run_lammps(program, case.infile, folder, variables, prefix=(
        "valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}",
        f"--toggle-collect=LAMMPS_NS::{style.compute}::compute(int, int)"))
    return read_total(counts.read_text(encoding="utf-8")), read_log(done.log)


def read_total(text: str) -> int:
    """:raise ValueError: where nothing was counted, as when no function has the name sought"""
    found = _TOTALS.search(text)
    if not found or int(found.group(1)) == 0:
        raise ValueError("callgrind counted nothing in the pair style's compute()")
    return int(found.group(1))


def table(rows: Sequence[Dict]) -> str:
    header = ("case and style", "a contact", "a neighbour", "a particle", "/ hooke", "/ granular",
              "contacts", "neighbours")
    lines = []
    for case in dict.fromkeys(row["case"] for row in rows):
        some = {row["style"]: row for row in rows if row["case"] == case}
        lines.append([case] + [""] * (len(header) - 1))
        for name, row in some.items():
            over = [f"{row['per_particle'] / some[other]['per_particle']:.3f}"
                    if other in some else "" for other in (HOOKE, GRANULAR)]
            lines.append(["  " + name, f"{row['per_contact']:.1f}", f"{row['per_neighbour']:.1f}",
                          f"{row['per_particle']:.1f}", *over,
                          f"{row['contacts'] / row['atoms']:.3f}",
                          f"{row['neighbours'] / row['atoms']:.3f}"])
    return text_table(header, lines) + (
        "\nInstructions of compute() a step, over contacts, neighbours and particles; contacts "
        "and\nneighbours are a particle's.\n")

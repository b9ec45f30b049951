# SPDX-License-Identifier: GPL-2.0-only
"""Memory a particle, and a million particles in the memory of this machine."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Sequence

from .cases import Case
from .cost import one_run
from .lammps import Program
from .output import text_table
from .styles import HOOKE

STYLES = (HOOKE, "gran/eepa full", "gran/eepa sds")


def measure(program: Program, cases: Sequence[Case], styles: Sequence[str],
            work: Path) -> List[Dict]:
    """One run of each case; the first is the small one, from which per_particle() counts."""
    rows = []
    for case in cases:
        for name in styles:
            rows.append({"case": case.name, "style": name, **one_run(program, case, name, work)})
            print(f"  {case.name}: {name}: {rows[-1]['peak_kb'] / 1024.0:.0f} MiB at most",
                  flush=True)
    return rows


def per_particle(small: Dict, large: Dict) -> float:
    """Bytes of resident memory for each additional particle."""
    return 1024.0 * (large["peak_kb"] - small["peak_kb"]) / (large["atoms"] - small["atoms"])


def table(rows: Sequence[Dict]) -> str:
    header = ("case and style", "peak, MiB", "peak, bytes a particle", "LAMMPS's own, MB",
              "a particle", "over hooke", "neighbours", "s a step")
    names = list(dict.fromkeys(row["case"] for row in rows))
    first = {row["style"]: row for row in rows if row["case"] == names[0]}
    lines = []
    for case in names[1:]:
        some = {row["style"]: row for row in rows if row["case"] == case}
        lines.append([case] + [""] * (len(header) - 1))
        for name, row in some.items():
            own = per_particle(first[name], row)
            lines.append([
                "  " + name, f"{row['peak_kb'] / 1024.0:.0f}", f"{own:.0f}",
                f"{row['memory_mb']:.1f}", f"{row['memory_mb'] * 1048576.0 / row['atoms']:.0f}",
                f"{own - per_particle(first[HOOKE], some[HOOKE]):+.0f}" if HOOKE in some else "",
                f"{row['neighbours'] / row['atoms']:.3f}",
                f"{row['loop_s'] / row['steps']:.3f}"])
    return text_table(header, lines) + (
        "\nPeak is the largest resident set; bytes a particle what it grew by from the run with "
        f"{first[next(iter(first))]['atoms']}\nparticles, for each one more. LAMMPS's own is its "
        "`Per MPI rank memory allocation`.\n")

# SPDX-License-Identifier: GPL-2.0-only
"""The styles for KOKKOS in turn, on the lattice of in.lattice."""
from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Mapping, Sequence, Tuple

from .lammps import Program, run_lammps
from .lammps_log import LOOP
from .statistics import median, paired_ratios

INFILE = Path(__file__).resolve().parents[1] / "in.lattice"
REFERENCE = "hooke"    #: gran/hooke/history
LAWS = ("constant", "plateau", "exponent", "sds", "luding")


@dataclass(frozen=True)
class Lattice:
    side: int     #: particles along each edge
    every: int    #: steps between two neighbour lists; 0: as particles move, which is never here
    steps: int


def lattices(sides: Sequence[int], every: Sequence[int], steps: int = 0) -> List[Lattice]:
    """:param steps: 0: so many that the runs of all sizes take about as long"""
    return [Lattice(side, e, steps or min(2000, max(200, int(2e9 / side**3))))
            for side in sides for e in every]


def read_loop(log: str) -> Tuple[float, int]:
    """Milliseconds a step and the number of particles of a log's last run.

    :raise ValueError: if there is none
    """
    runs = LOOP.findall(log)
    if not runs:
        raise ValueError("the log has no line 'Loop time of'")
    seconds, _, steps, atoms = runs[-1]
    return 1e3 * float(seconds) / int(steps), int(atoms)


def measure(program: Program, kokkos: Sequence[str], sizes: Sequence[Lattice], laws: Sequence[str],
            rounds: int, work: Path) -> List[Dict]:
    """One row a run. In each round all styles run, one after another.

    :param kokkos: LAMMPS's command line for KOKKOS
    """
    rows: List[Dict] = []
    work.mkdir(parents=True, exist_ok=True)
    for size in sizes:
        for k in range(rounds):
            for law in (REFERENCE, *laws):
                variables = {"law": law, "n": str(size.side), "every": str(size.every),
                             "steps": str(size.steps)}
                done = run_lammps(program, INFILE, work, variables, more=kokkos)
                milliseconds, atoms = read_loop(done.log.read_text(encoding="utf-8", errors="replace"))
                rows.append({"particles": atoms, "every": size.every, "round": k, "law": law,
                             "ms_a_step": milliseconds})
                print(f"{atoms} particles, every {size.every}, {law}: {milliseconds:.4g} ms a step", flush=True)
    return rows


def table(rows: Sequence[Mapping]) -> str:
    """A table in Markdown: medians of milliseconds a step, and of their ratios to the reference of the same round."""
    laws = list(dict.fromkeys(row["law"] for row in rows if row["law"] != REFERENCE))
    lines = ["| particles | steps a list | gran/hooke/history | " + " | ".join(laws) + " |",
             "|---|---|---|" + "---|" * len(laws)]
    for particles, every in dict.fromkeys((row["particles"], row["every"]) for row in rows):
        these = [row for row in rows if (row["particles"], row["every"]) == (particles, every)]

        def of(law: str) -> str:
            return f"{median([row['ms_a_step'] for row in these if row['law'] == law]).value:.3g}"

        cells = [f"{particles:,}", str(every) if every else "no list", of(REFERENCE)]
        for law in laws:
            ratio = median(paired_ratios(these, law, REFERENCE, "law", "ms_a_step"))
            cells.append(f"{of(law)} ({ratio.value:.2f})")
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def cards() -> str:
    """Names and drivers of NVIDIA's cards, as nvidia-smi tells them; "" where there are none."""
    try:
        said = subprocess.run(["nvidia-smi", "--query-gpu=name,driver_version", "--format=csv,noheader"],
                              capture_output=True, text=True, check=True, timeout=60)
    except (OSError, subprocess.SubprocessError):
        return ""
    return "; ".join(line.strip() for line in said.stdout.splitlines() if line.strip())

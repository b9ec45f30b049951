# SPDX-License-Identifier: GPL-2.0-only
"""Ranks and threads: the same particles on more cores (strong), as many on each core (weak)."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Sequence

from . import plots
from .cases import Case
from .cost import one_run
from .lammps import Parallel, Program
from .output import text_table
from .statistics import Median, column, median
from .styles import HOOKE

STYLE = "gran/eepa full"


@dataclass(frozen=True)
class Job:
    """One kind of run; `reference` names the one that it is compared with."""

    kind: str
    case: Case
    style: str
    parallel: Parallel

    @property
    def name(self) -> str:
        return f"{self.kind} {self.style} {self.parallel.name}"

    @property
    def reference(self) -> str:
        return f"{self.kind} {self.style} {Parallel().name}"


def jobs(strong: Case, weak: Dict[int, Case], with_omp: bool) -> List[Job]:
    """:param weak: for each number of cores the case with so many times the particles"""
    counts = sorted(weak)
    found = []
    for kind in ("strong", "weak"):
        for style in (STYLE, HOOKE) if kind == "strong" else (STYLE,):
            for cores in counts:
                case = strong if kind == "strong" else weak[cores]
                found.append(Job(kind, case, style, Parallel(cores, 0)))
                if with_omp and style == STYLE:
                    found.append(Job(kind, case, style, Parallel(1, cores)))
    return found


def measure(program: Program, some: Sequence[Job], rounds: int, work: Path) -> List[Dict]:
    rows = []
    for k in range(rounds):
        for job in some:
            row = {"kind": job.kind, "job": job.name, "reference": job.reference,
                   "style": job.style, "parallel": job.parallel.name,
                   "cores": job.parallel.cores, "round": k,
                   **one_run(program, job.case, job.style, work, job.parallel)}
            rows.append(row)
            print(f"  round {k + 1} of {rounds}: {job.name}, {row['atoms']} particles: pair "
                  f"{row['pair_s']:.3f} s of {row['loop_s']:.3f} s", flush=True)
    return rows


def speed_up(rows: Sequence[Dict], job: str, value: str) -> Median:
    """Steps a second over those of one serial core, round by round; in weak scaling, the part of a
    core's speed that is kept."""
    own = next(row for row in rows if row["job"] == job)
    ours = column(rows, job, "job", value)
    theirs = column(rows, own["reference"], "job", value)
    steps = next(row["steps"] for row in rows if row["job"] == own["reference"])
    return median([(theirs[k] / steps) / (ours[k] / own["steps"]) for k in ours if k in theirs])


def table(rows: Sequence[Dict], with_omp: bool) -> str:
    header = ("runs", "particles", "pair, s", "loop, s", "pair speed-up", "loop speed-up",
              "CPU, %")
    lines = []
    for job in dict.fromkeys(row["job"] for row in rows):
        own = [row for row in rows if row["job"] == job]
        lines.append([job, str(own[0]["atoms"]),
                      f"{median([row['pair_s'] for row in own]).value:.3f}",
                      f"{median([row['loop_s'] for row in own]).value:.3f}",
                      speed_up(rows, job, "pair_s").text(), speed_up(rows, job, "loop_s").text(),
                      f"{min(row['cpu_percent'] for row in own):.1f}"])
    note = ("\nRanks x threads. Speed-up over one serial core: median of the rounds' ratios with "
            "its quartiles;\nof a weak one 1 is perfect. Pair time is that of the slowest rank.\n")
    if not with_omp:
        note += "gran/eepa/omp is not in this build: no threads were measured.\n"
    return text_table(header, lines) + note


def plot(rows: Sequence[Dict], path: Path) -> None:
    series: Dict[str, Dict[str, List]] = {"strong": {}, "weak": {}}
    for job in dict.fromkeys(row["job"] for row in rows):
        own = next(row for row in rows if row["job"] == job)
        way = "threads" if own["threads"] else "ranks"
        for value in ("pair_s", "loop_s"):
            label = f"{own['style']}, {way}, {value[:4]}"
            series[own["kind"]].setdefault(label, []).append(
                (own["cores"], speed_up(rows, job, value)))
    plots.scaling(series, path)

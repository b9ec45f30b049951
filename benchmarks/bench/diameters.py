# SPDX-License-Identifier: GPL-2.0-only
"""One test with particles of several diameters, the wall time against the diameter: the runs are
those of examples/scale_collapse, one at a time."""
from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Dict, List, Sequence, Tuple

from collapse import report
from collapse.cases import Case, folder_of, make_cases
from collapse.curves import load_curve
from collapse.progress import Progress
from collapse.runs import CURVE, Launcher, Runner, read_marker

from . import plots
from .lammps import Program
from .output import text_table
from .statistics import fit_power

PRELOAD = 5.0e3
IN_FILE = (Path(__file__).resolve().parents[2] / "examples" / "scale_collapse" / "in.oedometer")


def measure(program: Program, diameters: Sequence[float], seeds: Sequence[int],
            out: Path) -> Tuple[List[Dict], List[Dict]]:
    """A row for each diameter, mean over its seeds at the strain that all of them reach; and one
    for each run."""
    cases = make_cases(diameters, seeds, "linear", ["scaled"])
    launcher = Launcher(program.lmp, IN_FILE, program.mpirun, 1)
    Runner(launcher, out, 1, Progress(cases, 1)).run(cases, redo=True)
    groups, runs = [], []
    for diameter, count in zip(diameters, seeds):
        group = report.Group(diameter, "scaled", [], [])
        for seed in range(1, count + 1):
            folder = folder_of(out, Case(diameter, True, "linear", seed))
            group.curves.append(load_curve(folder / CURVE, PRELOAD))
            group.timings.append(report.Timing.from_marker(read_marker(folder)))
            runs.append({"diameter_mm": 1e3 * diameter, "seed": seed,
                         **asdict(group.timings[-1]),
                         "loading_strain": group.curves[-1].loading_run_strain})
        groups.append(group)
    wanted = ("diameter_mm", "particles", "seeds", "loading_seconds", "total_seconds",
              "particle_steps_per_second", "deviation_percent")
    means = [{name: asdict(row)[name] for name in wanted} for row in report.make_rows(groups)]
    return means, runs


def table(rows: Sequence[Dict]) -> str:
    finest = rows[0]
    lines = []
    for row in rows:
        ratio = row["diameter_mm"] / finest["diameter_mm"]
        lines.append([f"{row['diameter_mm']:g} mm", str(row["particles"]), str(row["seeds"]),
                      f"{row['loading_seconds']:.3f}", f"{row['total_seconds']:.2f}",
                      f"{finest['loading_seconds'] / row['loading_seconds']:.1f}",
                      f"{ratio**4:.1f}", f"{row['particle_steps_per_second'] / 1e6:.1f}",
                      f"{row['deviation_percent']:.2f}"])
    text = text_table(("diameter", "particles", "seeds", "loading, s", "whole run, s",
                       "times faster", "d^4 says", "M particle steps/s", "deviation, %"), lines)
    power = fit_power([row["diameter_mm"] for row in rows],
                      [row["loading_seconds"] for row in rows])
    return text + (f"\nLoading at equal strain takes d^{power.exponent:.2f} ± {power.error:.2f} "
                   "(fit); particles ~ d^-3 and steps ~ d^-1\npromise d^-4. The deviation is that "
                   "of the stress-strain curve from the finest one's,\nin % of the peak stress.\n")


def plot(rows: Sequence[Dict], path: Path) -> None:
    diameters = [row["diameter_mm"] for row in rows]
    times = {what: [row[f"{what}_seconds"] for row in rows] for what in ("loading", "total")}
    plots.powers(diameters, times, {what: fit_power(diameters, values)
                                    for what, values in times.items()}, -4.0, path)

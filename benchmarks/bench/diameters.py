# SPDX-License-Identifier: GPL-2.0-only
"""One test with particles of several diameters, the wall time against the diameter: the runs are
those of examples/scale_collapse, one at a time."""
from __future__ import annotations

import shutil
from pathlib import Path
from typing import Dict, List, Sequence, Tuple

import yaml
from analysis import tables
from coarsen.results import tidy
from coarsen.study import read_study
from coarsen.workflow import run_study

from . import plots
from .lammps import Program
from .output import text_table
from .statistics import fit_power

INFILES = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"


def measure(program: Program, diameters: Sequence[float], seeds: Sequence[int],
            out: Path) -> Tuple[List[Dict], List[Dict]]:
    """A row for each diameter, mean over its seeds; and one for each run."""
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    study = out / "study.yaml"
    study.write_text(yaml.safe_dump({"groups": {
        f"linear-{k}": {"infile": "in.oedometer", "d": repr(d), "seed": list(range(1, count + 1))}
        for k, (d, count) in enumerate(zip(diameters, seeds))}}), encoding="utf-8")
    run_study(study, INFILES, out, program.lmp, 1)
    runs, curves = tidy(read_study(study), out, INFILES)
    runs = tables.with_kinds(runs)
    means = tables.with_curve_deviations(tables.means(runs), runs, curves)
    rows = [{"diameter_mm": 1e3 * row.d, "particles": int(row.particles), "seeds": int(row.seeds),
             "test_seconds": row.test_seconds, "total_seconds": row.seconds,
             "particle_steps_per_second": row.particles * row.test_steps / row.test_seconds,
             "deviation_percent": 0.0 if row.curve != row.curve else row.curve}
            for row in means.sort_values("d").itertuples()]
    single = [{"diameter_mm": 1e3 * row.d, **{name: getattr(row, name) for name in (
        "seed", "particles", "seconds", "test_seconds", "steps", "test_steps", "strain")}}
        for row in runs.itertuples()]
    return rows, single


def table(rows: Sequence[Dict]) -> str:
    finest = rows[0]
    lines = []
    for row in rows:
        ratio = row["diameter_mm"] / finest["diameter_mm"]
        lines.append([f"{row['diameter_mm']:g} mm", str(row["particles"]), str(row["seeds"]),
                      f"{row['test_seconds']:.3f}", f"{row['total_seconds']:.2f}",
                      f"{finest['test_seconds'] / row['test_seconds']:.1f}",
                      f"{ratio**4:.1f}", f"{row['particle_steps_per_second'] / 1e6:.1f}",
                      f"{row['deviation_percent']:.2f}"])
    text = text_table(("diameter", "particles", "seeds", "test, s", "whole run, s",
                       "times faster", "d^4 says", "M particle steps/s", "deviation, %"), lines)
    power = fit_power([row["diameter_mm"] for row in rows],
                      [row["test_seconds"] for row in rows])
    return text + (f"\nThe test, to equal stress and back, takes d^{power.exponent:.2f} ± {power.error:.2f} "
                   "(fit); particles ~ d^-3 and steps ~ d^-1\npromise d^-4. The deviation is that "
                   "of the stress-strain curve from the finest one's,\nin % of the peak stress.\n")


def plot(rows: Sequence[Dict], path: Path) -> None:
    diameters = [row["diameter_mm"] for row in rows]
    times = {what: [row[f"{what}_seconds"] for row in rows] for what in ("test", "total")}
    plots.powers(diameters, times, {what: fit_power(diameters, values)
                                    for what, values in times.items()}, -4.0, path)

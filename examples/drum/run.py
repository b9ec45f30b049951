#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Turns the drum with particles of several diameters, scaled and not, and measures the dynamic angle of
repose. See README.md."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

try:
    import numpy as np
    import matplotlib  # noqa: F401
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; on Debian: "
             f"apt-get install python3-{missing.name} and /usr/bin/python3 {sys.argv[0]}")

import geometry  # noqa: E402
import repose  # noqa: E402
from machines import meshes, running, tables  # noqa: E402
from machines.pictures import draw_section, plt, save  # noqa: E402
from machines.running import Run  # noqa: E402

SHAPE = {"radius": 0.03, "length": 0.02, "lift": 0.003, "base": 0.004, "top": 0.003, "lifters": 8,
         "facets": 96}
DIAMETERS = [1.5e-3, 2.1e-3, 3.0e-3]    # the finest first


def cases(arguments: argparse.Namespace) -> List[Run]:
    diameters = DIAMETERS if arguments.full else DIAMETERS[-1:]
    seeds = arguments.seeds or (2 if arguments.full else 1)
    turns = {"warm": 0.35, "turns": 0.65} if arguments.full else {"warm": 0.25, "turns": 0.25}
    runs = []
    for d in diameters:
        for scaled in ("yes", "no"):
            if scaled == "no" and d == DIAMETERS[0]:
                continue
            for seed in range(1, seeds + 1):
                runs.append(Run(f"d{1e3 * d:g}mm_{'scaled' if scaled == 'yes' else 'unscaled'}_seed{seed}",
                                HERE / "in.drum",
                                {"d": d, "dfine": DIAMETERS[0], "scaled": scaled, "seed": seed,
                                 "stl": arguments.out, **turns}))
    return runs


def angles(launcher: running.Launcher, run: Run) -> np.ndarray:
    """Of all snapshots of a run, kept beside the dump, for they take a while."""
    folder = launcher.folder(run)
    dump, kept = folder / "drum.dump", folder / "angles.csv"
    if not kept.is_file() or kept.stat().st_mtime < dump.stat().st_mtime:
        found = repose.angles([shot.positions() for shot in tables.read_dump(dump)],
                              float(run.variables["d"]), SHAPE["radius"], SHAPE["length"])
        np.savetxt(kept, found, fmt="%.3f", header="angle of repose, degrees")
    return np.atleast_1d(np.loadtxt(kept))


def report(launcher: running.Launcher, runs: Sequence[Run]) -> None:
    rows, reference = [], None
    groups: dict = {}
    for run in runs:
        groups.setdefault(run.name.rsplit("_seed", 1)[0], []).append(run)
    for name, group in groups.items():
        series = [angles(launcher, run) for run in group]
        means = [float(s.mean()) for s in series]
        torques = []
        for run in group:
            table = tables.read_table(launcher.folder(run) / "drum.csv")
            torques.append(1e3 * float(table.torque[len(table) // 2:].mean()))
        if reference is None:
            reference = np.mean(means)
        error = (tables.mean_and_error(means)[1] if len(means) > 1
                 else repose.error_of_mean(series[0]) if len(series[0]) > 9 else float("nan"))
        rows.append([name, str(len(group)), f"{np.mean(means):.1f} ± {error:.1f}",
                     f"{np.mean([s.std() for s in series]):.1f}", tables.with_error(torques),
                     f"{np.mean(means) - reference:+.1f}",
                     f"{np.mean([launcher.seconds(run) for run in group]):.0f}"])
    text = tables.text_table(["case", "seeds", "angle (deg)", "its fluctuation", "torque (mN m)",
                              "from the first", "s a run"], rows)
    (launcher.out / "table.txt").write_text(text, encoding="utf-8")
    print(f"\n{text}")
    picture(launcher, [group[0] for group in groups.values()])


def picture(launcher: running.Launcher, runs: Sequence[Run]) -> None:
    figure, axes = plt.subplots(1, len(runs), figsize=(4.2 * len(runs), 4.2), squeeze=False,
                                constrained_layout=True)
    walls = 1e-3 * meshes.read_stl(launcher.out / "drum.stl")
    for axis, run in zip(axes[0], runs):
        *_, shot = tables.read_dump(launcher.folder(run) / "drum.dump")
        d = float(run.variables["d"])
        speed = np.hypot(shot.columns["vx"], shot.columns["vz"])
        circles = draw_section(axis, shot.positions(), shot.columns["radius"], [turned(launcher, run, walls)],
                               1e3 * speed)
        part, middles = repose.filling(shot.positions(), d, SHAPE["radius"], SHAPE["length"], 0.5 * d)
        line = repose.surface(part, middles, SHAPE["radius"])
        axis.plot(1e3 * line.x, 1e3 * line.z, "r.", markersize=2)
        axis.set_title(f"{run.name.rsplit('_seed', 1)[0].replace('_', ', ')}: {line.angle:.0f}°", fontsize=10)
        figure.colorbar(circles, ax=axis, label="speed (mm/s)", shrink=0.7)
    save(figure, launcher.out / "drum.png")


def turned(launcher: running.Launcher, run: Run, walls: np.ndarray) -> np.ndarray:
    """The mesh at the end of a run."""
    angle = float(tables.read_table(launcher.folder(run) / "drum.csv").angle[-1])
    cos, sin = np.cos(angle), np.sin(angle)
    return walls @ np.array([[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos]])


def run(arguments: argparse.Namespace) -> None:
    launcher = running.launcher(arguments)
    arguments.out = launcher.out
    geometry.write(launcher.out, SHAPE)
    runs = cases(arguments)
    launcher.start_all(runs, arguments.jobs)
    report(launcher, runs)


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = running.parser(__doc__, "drum").parse_args(words)
    return running.exit_status("run.py", lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Makes tablets of particles of several diameters, scaled and not. See README.md."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict, List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

try:
    import numpy as np
    import matplotlib  # noqa: F401
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; on Debian: "
             f"apt-get install python3-{missing.name} and /usr/bin/python3 {sys.argv[0]}")

import compaction  # noqa: E402
import geometry  # noqa: E402
from machines import meshes, running, tables  # noqa: E402
from machines.pictures import draw_section, plt, save  # noqa: E402
from machines.running import Run  # noqa: E402

SHAPE = {"radius": 0.010, "height": 0.026, "collar": 0.024, "gap": 0.0001, "length": 0.004, "cup": 0.0,
         "facets": 72}
DIAMETERS, NREF = [1.0e-3, 1.5e-3, 2.0e-3], 6000    # the finest first; particles of that


def cases(arguments: argparse.Namespace) -> List[Run]:
    diameters = DIAMETERS if arguments.full else DIAMETERS[-1:]
    modes = ("yes", "no") if arguments.full else ("yes",)
    fast = {} if arguments.full else {"approach": 0.4, "release": 0.1, "eject": 0.5, "hold": 5e-3}
    runs = []
    for d in diameters:
        for scaled in modes:
            if scaled == "no" and d == DIAMETERS[0]:
                continue
            for seed in range(1, (arguments.seeds or (2 if arguments.full else 1)) + 1):
                runs.append(Run(f"d{1e3 * d:g}mm_{'scaled' if scaled == 'yes' else 'unscaled'}_seed{seed}",
                                HERE / "in.die", {"d": d, "dfine": DIAMETERS[0],
                                                  "scaled": scaled, "seed": 1000 + seed,
                                                  "nref": NREF, "radius": SHAPE["radius"],
                                                  "height": SHAPE["height"], "collar": SHAPE["collar"],
                                                  "stl": arguments.out, **fast}))
    return runs


def analyse(launcher: running.Launcher, run: Run) -> compaction.Tablet:
    d = float(run.variables["d"])
    volume = round(NREF * (DIAMETERS[0] / d)**3) * np.pi / 6.0 * d**3
    table = tables.read_table(launcher.folder(run) / "die.csv")
    return compaction.tablet(table, volume, np.pi * SHAPE["radius"]**2)


def report(launcher: running.Launcher, runs: Sequence[Run]) -> None:
    groups: Dict[str, List[Run]] = {}
    for run in runs:
        groups.setdefault(run.name.rsplit("_seed", 1)[0], []).append(run)
    rows = []
    for name, group in groups.items():
        made = [analyse(launcher, run) for run in group]
        rows.append([name, str(len(group)),
                     *(tables.with_error([factor * getattr(t, field) for t in made], form)
                       for field, factor, form in (
                           ("solid_loaded", 1, ".4f"), ("solid_out", 1, ".4f"), ("recovery", 100, ".2f"),
                           ("radial_loaded", 1, ".3f"), ("residual", 1e-3, ".2f"), ("ejection", 1, ".2f"))),
                     f"{np.mean([launcher.seconds(run) for run in group]):.0f}"])
    text = tables.text_table(["case", "seeds", "solid fraction pressed", "outside", "recovery (%)",
                              "radial/axial", "residual (kPa)", "ejection (N)", "s a run"], rows)
    (launcher.out / "table.txt").write_text(text, encoding="utf-8")
    print(f"\n{text}")
    draw(launcher, [group[0] for group in groups.values()])


def draw(launcher: running.Launcher, runs: Sequence[Run]) -> None:
    """Stresses over thickness and over time, and sections of the first tablet under pressure and outside."""
    figure, axes = plt.subplots(1, 4, figsize=(15.0, 4.2), constrained_layout=True)
    for i, run in enumerate(runs):
        table = tables.read_table(launcher.folder(run) / "die.csv")
        pressed = table[table.stage < compaction.EJECT]
        axes[0].plot(1e3 * pressed.thickness, 1e-3 * pressed.top, color=f"C{i}", linewidth=1.0,
                     label=run.name.rsplit("_seed", 1)[0].replace("_", ", "))
        axes[0].plot(1e3 * pressed.thickness, 1e-3 * pressed.side, color=f"C{i}", linewidth=0.8,
                     linestyle="--")
        out = table[table.stage == compaction.EJECT]
        axes[1].plot(1e3 * (out.time - out.time[0]), np.pi * SHAPE["radius"]**2 * out.bottom,
                     color=f"C{i}", linewidth=0.8)
    axes[0].set(xlabel="thickness (mm)", ylabel="axial (solid) and radial stress (kPa)")
    axes[0].legend(frameon=False, fontsize=8)
    axes[1].set(xlabel="time of ejection (ms)", ylabel="force of the lower punch (N)")
    walls = [1e-3 * meshes.read_stl(launcher.out / "die.stl")]
    for axis, name in zip(axes[2:], ("compacted", "ejected")):
        (shot,) = tables.read_dump(launcher.folder(runs[0]) / f"{name}.dump")
        draw_section(axis, shot.positions(), shot.columns["radius"], walls)
        axis.set(title=name, xlim=(-13.0, 13.0), ylim=(-2.0, 1e3 * (SHAPE["height"] + SHAPE["collar"])))
    save(figure, launcher.out / "die.png")


def run(arguments: argparse.Namespace) -> None:
    launcher = running.launcher(arguments)
    arguments.out = launcher.out
    geometry.write(launcher.out, SHAPE)
    runs = cases(arguments)
    launcher.start_all(runs, arguments.jobs)
    report(launcher, runs)


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = running.parser(__doc__, "die").parse_args(words)
    return running.exit_status("run.py", lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())

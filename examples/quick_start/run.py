#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Runs in.compress with particles of several diameters, scaled and not, and draws stress over strain."""
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

from machines import running, tables  # noqa: E402
from machines.pictures import plt, save  # noqa: E402
from machines.running import Run  # noqa: E402

LAWS = {"scaled": "linear scale 1.0e-3", "unscaled": "linear"}
DIAMETERS = [1.5e-3, 2.0e-3, 3.0e-3]
PRELOAD = 5.0e3    # from which strain counts


def cases(diameters: Sequence[float] = DIAMETERS) -> List[Run]:
    return [Run(f"d{1e3 * d:g}mm_{mode}", HERE / "in.compress", {"d": d, "law": law})
            for mode, law in LAWS.items() for d in diameters]


def strain(table: np.recarray) -> np.ndarray:
    """Of the specimen, from where the stress last rises through the preload."""
    peak = int(np.argmax(table.stress))
    start = int(np.nonzero(table.stress[:peak] < PRELOAD)[0][-1])
    return 1.0 - table.height / table.height[start]


def strain_at(table: np.recarray, stress: float) -> float:
    """On loading."""
    peak = int(np.argmax(table.stress))
    return float(strain(table)[np.nonzero(table.stress[:peak] < stress)[0][-1]])


def curve(launcher: running.Launcher, run: Run) -> np.recarray:
    return tables.read_table(launcher.folder(run) / "curve.csv")


def draw(launcher: running.Launcher, runs: Sequence[Run], path: Path) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(9.0, 3.8), sharex=True, sharey=True, layout="constrained")
    for run in runs:
        mode = run.name.split("_")[1]
        table = curve(launcher, run)
        axes[list(LAWS).index(mode)].plot(100.0 * strain(table), 1e-3 * table.stress, linewidth=1.0,
                                          label=f"{1e3 * run.variables['d']:g} mm")
    for axis, (mode, law) in zip(axes, LAWS.items()):
        axis.set(title=f"{mode}: gran/eepa {law}", xlabel="strain (%)", xlim=(0.0, None), ylim=(0.0, None))
        axis.legend(frameon=False)
    axes[0].set_ylabel("stress on the lid (kPa)")
    save(figure, path)


def work(arguments: argparse.Namespace) -> None:
    launcher = running.launcher(arguments)
    runs = cases() if arguments.full else cases(DIAMETERS[1:])
    launcher.start_all(runs, arguments.jobs)
    for run in runs:
        print(f"{run.name:>15} {100.0 * strain_at(curve(launcher, run), 4.5e4):6.2f} % strain at 45 kPa")
    draw(launcher, runs, launcher.out / "compress.png")


def main(arguments: Optional[Sequence[str]] = None) -> int:
    options = running.parser(__doc__, "quick_start")
    return running.exit_status("run.py", lambda: work(options.parse_args(arguments)))


if __name__ == "__main__":
    sys.exit(main())

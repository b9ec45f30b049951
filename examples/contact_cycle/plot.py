#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Runs in.contact_cycle for both laws and draws force over overlap: what LAMMPS wrote as points,
the formulas as lines. See README.md."""
from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path
from typing import Callable, Dict, List, Optional, Sequence, Tuple

try:
    import matplotlib
    import numpy as np
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; on Debian: "
             f"apt-get install python3-{missing.name} and /usr/bin/python3 {sys.argv[0]}")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "coarsen"))

from coarsen.workflow import find_lmp, results_folder  # noqa: E402

LAWS = ("linear", "plateau")
# The values of in.contact_cycle.
K1, K2, K_ADH, F0 = 5.0e3, 1.0e4, 5.0e3, -2.0e-2
UNIT = 2.0e-5
TARGETS = (0.0, 1.0, 0.7, 1.3, 0.25, 1.5, 0.0)
LOADING, UNLOADING, ADHESIVE = 1, 2, 3
NAMES = {LOADING: "loading", UNLOADING: "unloading, reloading", ADHESIVE: "adhesive"}
COLOURS = {LOADING: "#0072B2", UNLOADING: "#D55E00", ADHESIVE: "#009E73"}

Law = Callable[[float, float], Tuple[float, int, float]]


def linear(overlap: float, plastic: float) -> Tuple[float, int, float]:
    """Force, branch and the plastic overlap that it leaves, of the published law."""
    plastic = max(plastic, (1.0 - K1 / K2) * overlap)
    if K2 * (overlap - plastic) >= K1 * overlap * (1.0 - 1e-12):
        return F0 + K1 * overlap, LOADING, plastic
    if K2 * (overlap - plastic) <= -K_ADH * overlap:
        return F0 - K_ADH * overlap, ADHESIVE, (1.0 + K_ADH / K2) * overlap
    return F0 + K2 * (overlap - plastic), UNLOADING, plastic


def plateau(overlap: float, plastic: float) -> Tuple[float, int, float]:
    """The same of the article's equations."""
    plastic = max(plastic, K1 / K2 * overlap)
    if K2 * (overlap - plastic) >= K1 * overlap * (1.0 - 1e-12):
        return F0 + K1 * overlap, LOADING, plastic
    if K2 * (overlap - plastic) <= -K_ADH * plastic:
        return -K_ADH * plastic, ADHESIVE, plastic
    return F0 + K2 * (overlap - plastic), UNLOADING, plastic


FORMULAS: Dict[str, Law] = {"linear": linear, "plateau": plateau}


def follow(law: Law, overlaps: Sequence[float]) -> Tuple[np.ndarray, np.ndarray]:
    """Force and branch along a path of overlaps; where contact is lost, so is its history."""
    plastic = 0.0
    forces: List[float] = []
    branches: List[int] = []
    for overlap in overlaps:
        if overlap <= 0.0:
            plastic = 0.0
            forces.append(0.0)
            branches.append(0)
            continue
        force, branch, plastic = law(overlap, plastic)
        forces.append(force)
        branches.append(branch)
    return np.array(forces), np.array(branches)


def run(lmp: Path, law: str, out: Path) -> None:
    """Writes cycle_LAW.csv and log.LAW to the folder out."""
    command = [str(lmp), "-in", str(HERE / "in.contact_cycle"), "-var", "law", law, "-var", "out",
               str(out), "-log", str(out / f"log.{law}"), "-screen", "none"]
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        log = out / f"log.{law}"
        lines = log.read_text(errors="replace").splitlines() if log.is_file() else []
        raise RuntimeError(f"law {law}: {' '.join(command)} ended with status {done.returncode}\n"
                           + "\n".join(done.stdout.splitlines()[-10:] + lines[-10:]))


def draw(axis, law: str, samples: np.ndarray) -> None:
    path = np.concatenate([np.linspace(a, b, 2001)[1:] for a, b in zip(TARGETS, TARGETS[1:])])
    forces, _ = follow(FORMULAS[law], path * UNIT)
    # From nothing to f0 at the first touch and back at the last, and at plateau's step.
    broken = np.insert(1e3 * forces, 0, 0.0)
    axis.plot(np.insert(path, 0, 0.0) * UNIT * 1e6, broken, color="0.6", linewidth=0.8, zorder=1,
              label="formulas")
    touching = samples["overlap"] > 0.0
    for branch in (LOADING, UNLOADING, ADHESIVE):
        some = samples[touching & (samples["branch"] == branch)][::3]
        axis.plot(1e6 * some["overlap"], 1e3 * some["force"], "o", markersize=3.2, zorder=2,
                  markerfacecolor="none", markeredgewidth=0.9, color=COLOURS[branch],
                  label=f"LAMMPS, {NAMES[branch]}")
    axis.axhline(0.0, color="0.3", linewidth=0.6, zorder=0)
    axis.set_xlabel("overlap (µm)")
    axis.set_ylabel("normal force (mN)")
    axis.set_title(f"law {law}", fontsize=11)
    axis.spines[["top", "right"]].set_visible(False)


def mark(axis, text: str, at: Tuple[float, float], to: Tuple[float, float], colour: str) -> None:
    axis.annotate(text, xy=at, xytext=to, fontsize=8.5, color=colour, ha="center", va="center",
                  arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.7})


def label_branches(axis, law: str) -> None:
    """Labels the branches and forces, in µm and mN."""
    mark(axis, "loading, k1", (12.0, 40.0), (6.0, 82.0), COLOURS[LOADING])
    mark(axis, "unloading and\nreloading, k2", (16.5, 45.0),
         (27.0, 15.0), COLOURS[UNLOADING])
    if law == "linear":
        mark(axis, "adhesive, −k_adh:\nthe force lets go as\nthe contact opens", (6.0, -50.0),
             (6.5, -95.0), COLOURS[ADHESIVE])
        mark(axis, "pressed again from\nthe adhesive branch:\nback along k2", (7.0, -25.0),
             (24.5, -45.0), COLOURS[UNLOADING])
    else:
        mark(axis, "adhesive plateau, −k_adh δp", (3.0, -75.0), (6.0, -106.0), COLOURS[ADHESIVE])
        step = K1 / K2 * 1.5 * UNIT * (1.0 - K_ADH / K2) * 1e6
        axis.annotate("", xy=(step + 0.5, -75.0), xytext=(step + 0.5, -95.0),
                      arrowprops={"arrowstyle": "<->", "color": "0.2", "linewidth": 0.8})
        axis.text(step + 1.0, -86.0, "step of f0", fontsize=8.5, color="0.2", va="center")
        mark(axis, "pressed again from the\nplateau: back the same way", (9.5, -55.0),
             (23.0, -55.0), COLOURS[UNLOADING])


def main(words: Optional[Sequence[str]] = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lmp", type=Path, default=None,
                        help="LAMMPS with this package (default: that of the build folder or of the installation)")
    parser.add_argument("--out", type=Path, default=results_folder() / "contact_cycle",
                        help="folder of curves, logs and picture (default: %(default)s)")
    arguments = parser.parse_args(words)
    out = arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    figure, axes = plt.subplots(1, 2, figsize=(11.0, 4.8), sharex=True, sharey=True,
                                constrained_layout=True)
    worst = 0.0
    for axis, law in zip(axes, LAWS):
        try:
            run(find_lmp(arguments.lmp), law, out)
        except (OSError, RuntimeError) as error:
            print(f"plot.py: {error}", file=sys.stderr)
            return 1
        samples = np.genfromtxt(out / f"cycle_{law}.csv", delimiter=",", names=True)
        difference = distance(law, samples)
        worst = max(worst, difference)
        print(f"law {law}: LAMMPS and the formulas differ by at most {difference:.1e} of the "
              f"largest force")
        draw(axis, law, samples)
        label_branches(axis, law)
        axis.tick_params(labelleft=True)
    axes[0].set_ylim(bottom=-118.0)
    axes[0].legend(fontsize=8, frameon=False, loc="upper left")
    figure.savefig(out / "contact_cycle.png", dpi=130, metadata={"Software": None})
    print(f"Figure: {out / 'contact_cycle.png'}")
    if worst > 1e-6:
        print("plot.py: that is more than 1e-6, so LAMMPS does not follow the formulas",
              file=sys.stderr)
        return 1
    return 0


def distance(law: str, samples: np.ndarray) -> float:
    """Largest difference from the formulas, evaluated at LAMMPS's overlaps, over the largest
    force."""
    forces, _ = follow(FORMULAS[law], samples["overlap"])
    return float(np.max(np.abs(forces - samples["force"])) / np.max(np.abs(samples["force"])))


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Discharges a silo: the beads of a published benchmark, between triangles and between regions, or a cohesive
powder of several diameters, scaled and not, through several orifices. See README.md."""
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

import discharge  # noqa: E402
import geometry  # noqa: E402
from machines import meshes, running, tables  # noqa: E402
from machines.pictures import draw_section, plt, save  # noqa: E402
from machines.running import Run  # noqa: E402

BEADS = {"radius": 0.1, "orifice": 0.03, "cone": 0.07, "height": 0.3}
POWDER = {"radius": 0.02, "cone": 0.02, "height": 0.07}
# diameters of the powder, the finest first, and how many particles of 1 mm would fill the silo
DIAMETERS, NREF = [1.5e-3, 2.1e-3, 3.0e-3], 40000
ORIFICES = [12.0, 16.0, 20.0]    #: of the powder's silo [mm]
BULK_DENSITY = {"beads": 0.6 * 2500.0, "powder": 0.55 * 2000.0}


def beads(arguments: argparse.Namespace) -> List[Run]:
    meshes_of(arguments.out, BEADS, 100)
    if arguments.full:
        variables = {"d": 4.0e-3, "n": 100000, "young": arguments.young or 1.0e9, "settle": 0.4, "time": 5.0}
        walls = ["mesh"]
    else:
        variables = {"d": 8.0e-3, "n": 6000, "young": arguments.young or 2.0e6, "settle": 0.25, "time": 0.6}
        walls = ["mesh", "region"]
    return [Run(f"beads_d{1e3 * variables['d']:g}mm_young{variables['young']:g}_{wall}_seed{seed}",
                HERE / "in.silo", {"walls": wall, "seed": seed, "shots": 10, "stl": arguments.out / "beads",
                                   **BEADS, **variables})
            for wall in walls for seed in range(1, (arguments.seeds or 1) + 1)]


def powder(arguments: argparse.Namespace) -> List[Run]:
    diameters = DIAMETERS if arguments.full else DIAMETERS[-1:]
    orifices = [0.5e-3 * mm for mm in arguments.orifice or (ORIFICES if arguments.full else ORIFICES[1:2])]
    time = 1.2 if arguments.full else 0.5
    runs = []
    for orifice in orifices:
        shape = {**POWDER, "orifice": orifice}
        folder = meshes_of(arguments.out, shape, 60)
        for d in diameters:
            for scaled in ("yes", "no"):
                if scaled == "no" and d == DIAMETERS[0]:
                    continue
                mode = "scaled" if scaled == "yes" else "unscaled"
                for seed in range(1, (arguments.seeds or (2 if arguments.full else 1)) + 1):
                    runs.append(Run(
                        f"powder_orifice{2e3 * orifice:g}mm_d{1e3 * d:g}mm_{mode}_seed{seed}",
                        HERE / "in.silo", {
                            "material": "powder", "scaled": scaled, "d": d, "dfine": DIAMETERS[0],
                            "n": round(NREF * (1.0e-3 / d)**3), "seed": seed, "shots": 10, "settle": 0.15,
                            "time": time, "stl": folder, **shape}))
    return runs


def meshes_of(out: Path, shape: Dict[str, float], facets: int) -> Path:
    folder = out / ("beads" if shape is BEADS else f"orifice{2e3 * shape['orifice']:g}mm")
    geometry.write(folder, {**shape, "facets": facets})
    return folder


def report(launcher: running.Launcher, runs: Sequence[Run], what: str) -> None:
    groups: Dict[str, List[Run]] = {}
    for run in runs:
        groups.setdefault(run.name.rsplit("_seed", 1)[0], []).append(run)
    published = any(run.variables["n"] == 100000 for run in runs)
    rows = []
    for name, group in groups.items():
        curves = [tables.read_table(launcher.folder(run) / "discharge.csv") for run in group]
        found = [discharge.analyse(curve.time, curve.inside) for curve in curves]
        first = group[0].variables
        d, density = float(first["d"]), BULK_DENSITY[what]
        mass = np.pi / 6.0 * d**3 * density / (0.6 if what == "beads" else 0.55)
        rates = [f.rate for f in found]
        law = discharge.beverloo(2.0 * float(first["orifice"]), d, density)
        flowing = [f.rate * mass for f in found]
        row = [name, str(len(group)), tables.with_error(rates, ".4g"), f"{np.mean([f.error for f in found]):.2g}",
               tables.with_error([1e3 * m for m in flowing], ".4g"), f"{np.mean(flowing) / law:.3f}",
               f"{sum(f.blocked for f in found)} of {len(found)}"]
        if published:
            end = discharge.emptied(curves[0].time, curves[0].inside)
            row += [f"{end:.2f}", f"{curves[0].inside[0] / end:.4g}",
                    *(f"{number:.0f}" for number in discharge.left_at(curves[0].time, curves[0].inside))]
        rows.append(row + [f"{np.mean([launcher.seconds(run) for run in group]):.0f}"])
    head = ["case", "seeds", "particles/s", "error in a run", "g/s", "over Beverloo", "blocked"]
    if published:
        head += ["empty after, s", "mean, particles/s", *(f"left at {t:g} s" for t in discharge.TIMES)]
        for code, left in discharge.LEFT.items():
            slope = (left[0] - left[3]) / (discharge.TIMES[3] - discharge.TIMES[0])
            rows.append([f"published: {code}", "", f"{slope:.4g} from 0.5 to 3 s", *[""] * 6,
                         *map(str, left), ""])
        rows.append(["published: mean of all codes", *[""] * 6, "4.2 to 4.4", f"{discharge.PUBLISHED_RATE:.4g}",
                     *[""] * (len(discharge.TIMES) + 1)])
    text = tables.text_table([*head, "s a run"], rows)
    (launcher.out / f"{what}.txt").write_text(text, encoding="utf-8")
    print(f"\n{text}")
    draw(launcher, [group[0] for group in groups.values()], what)


def draw(launcher: running.Launcher, runs: Sequence[Run], what: str) -> None:
    """What is left over time, and sections of the first run."""
    figure, axes = plt.subplots(1, 3, figsize=(13.0, 4.6), constrained_layout=True)
    for run in runs:
        curve = tables.read_table(launcher.folder(run) / "discharge.csv")
        axes[0].plot(curve.time, curve.inside / curve.inside[0], linewidth=1.0,
                     label=run.name.rsplit("_seed", 1)[0].replace("_", " "))
    if any(run.variables["n"] == 100000 for run in runs):
        for (code, left), mark in zip(discharge.LEFT.items(), "ox"):
            axes[0].plot(discharge.TIMES, 1e-5 * np.array(left), f"k{mark}", markersize=5, label=code)
    axes[0].set(xlabel="time (s)", ylabel="part of the particles that is left", ylim=(0.0, 1.02))
    axes[0].legend(frameon=False, fontsize=7)
    folder = launcher.folder(runs[0])
    walls = [1e-3 * meshes.read_stl(Path(runs[0].variables["stl"]) / "silo.stl")]
    shots = list(tables.read_dump(folder / "silo.dump"))
    middle = shots[len(shots) // 2]
    fastest = float(np.percentile(-middle.columns["vz"], 98))
    for axis, shot in zip(axes[1:], (shots[0], middle)):
        circles = draw_section(axis, shot.positions(), shot.columns["radius"], walls, -shot.columns["vz"],
                               limits=(0.0, max(fastest, 1e-3)))
    figure.colorbar(circles, ax=axes[2], label="speed downwards (m/s)", shrink=0.8)
    save(figure, launcher.out / f"{what}.png")


def run(arguments: argparse.Namespace) -> None:
    if any(not 0.0 < mm < 2e3 * POWDER["radius"] for mm in arguments.orifice or []):
        raise running.RunFailed(f"--orifice is {arguments.orifice}, allowed are diameters in mm above 0 and "
                                f"below {2e3 * POWDER['radius']:g}, that of the silo")
    launcher = running.launcher(arguments)
    arguments.out = launcher.out
    runs = beads(arguments) if arguments.what == "beads" else powder(arguments)
    launcher.start_all(runs, arguments.jobs)
    report(launcher, runs, arguments.what)


def main(words: Optional[Sequence[str]] = None) -> int:
    parser = running.parser(__doc__, "silo")
    parser.add_argument("what", choices=["beads", "powder"], nargs="?", default="beads")
    parser.add_argument("--young", type=float, default=None, metavar="E",
                        help="Young's modulus of the beads in Pa (default: 1e9, quick 2e6)")
    parser.add_argument("--orifice", type=float, nargs="+", default=None, metavar="D",
                        help="diameters of the powder's orifice in mm (default: 12 16 20, quick 16)")
    arguments = parser.parse_args(words)
    return running.exit_status("run.py", lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())

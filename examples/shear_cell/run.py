#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Measures yield locus and flow function of a powder in an annular shear tester, with particles of several
diameters, scaled and not. See README.md."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

try:
    import numpy as np
    import matplotlib  # noqa: F401
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; on Debian: "
             f"apt-get install python3-{missing.name} and /usr/bin/python3 {sys.argv[0]}")

import geometry  # noqa: E402
import yield_locus  # noqa: E402
from machines import meshes, running, tables  # noqa: E402
from machines.pictures import draw_section, plt, save  # noqa: E402
from machines.running import Run  # noqa: E402

SHAPE, MESH = geometry.SHAPE, geometry.MESH
LEVELS = (0.25, 0.5, 0.75)
DIAMETERS = [1.5e-3, 2.0e-3, 3.0e-3]    # the finest first


def cases(arguments: argparse.Namespace) -> List[Tuple[str, Run, List[Run]]]:
    """Of each seed the name of its case, the run of preshear, and those of shear at lower stresses."""
    diameters = DIAMETERS if arguments.full else DIAMETERS[-1:]
    modes = ("yes", "no") if arguments.full else ("yes",)
    seeds = arguments.seeds or (2 if arguments.full else 1)
    strains = (({"preshear": 1.2, "rate": 2.0}, {"shearing": 0.15, "rate": 2.0}) if arguments.full else
               ({"preshear": 0.6, "rate": 3.0}, {"shearing": 0.1, "rate": 3.0}))
    tests = []
    for d in diameters:
        for scaled in modes:
            if scaled == "no" and d == DIAMETERS[0]:
                continue
            name = f"d{1e3 * d:g}mm_{'scaled' if scaled == 'yes' else 'unscaled'}"
            for seed in range(1, seeds + 1):
                common = {"d": d, "dfine": DIAMETERS[0], "scaled": scaled, "stl": arguments.out,
                          "dtfactor": 0.9, "consolidation": arguments.consolidation, **SHAPE}
                first = Run(f"{name}_seed{seed}_preshear", HERE / "in.preshear",
                            {**common, "seed": seed, **strains[0]})
                others = [Run(f"{name}_seed{seed}_shear{level:g}", HERE / "in.shear",
                              {**common, "level": level, **strains[1]}, {"state": first.name})
                          for level in LEVELS]
                tests.append((name, first, others))
    return tests


def analyse(launcher: running.Launcher, first: Run, others: Sequence[Run]):
    """The steady state (normal, shear, drift), the points at failure, and the flow function, in Pa."""
    table = tables.read_table(launcher.folder(first) / "preshear.csv")
    shear, drift = yield_locus.steady_state(table.strain, table.shear)
    normal, _ = yield_locus.steady_state(table.strain, table.normal)
    points = []
    for run in others:
        curve = tables.read_table(launcher.folder(run) / "shear.csv")
        points.append(yield_locus.failure(curve.strain, curve.normal, curve.shear))
    points = np.array(points)
    return (normal, shear, drift), points, yield_locus.flow(points[:, 0], points[:, 1], (normal, shear))


def report(launcher: running.Launcher, tests) -> None:
    groups: Dict[str, list] = {}
    for name, first, others in tests:
        groups.setdefault(name, []).append((analyse(launcher, first, others),
                                            sum(launcher.seconds(run) for run in (first, *others))))
    rows = []
    for name, group in groups.items():
        flows = [result[2] for result, _ in group]
        rows.append([name, str(len(group)),
                     *(tables.with_error([getattr(f, field) for f in flows], form) for field, form in (
                         ("cohesion", ".0f"), ("friction", ".1f"), ("unconfined", ".0f"), ("major", ".0f"),
                         ("ffc", ".2f"), ("effective", ".1f"), ("steady", ".1f"))),
                     f"{100 * np.mean([result[0][2] for result, _ in group]):+.1f}",
                     f"{np.mean([seconds for _, seconds in group]):.0f}"])
    text = tables.text_table(["case", "seeds", "c (Pa)", "phi (deg)", "fc (Pa)", "sigma1 (Pa)", "ffc",
                              "phi_e (deg)", "phi_ss (deg)", "drift (%)", "s a test"], rows)
    (launcher.out / "table.txt").write_text(text, encoding="utf-8")
    print(f"\n{text}")
    draw(launcher, tests)
    picture(launcher, tests[0][1])


def draw(launcher: running.Launcher, tests) -> None:
    """Shear stress over strain of the first test, and yield loci with Mohr circles of all."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.6), constrained_layout=True)
    _, first, others = tests[0]
    for run, name in ((first, "preshear"), *((o, "shear") for o in others)):
        table = tables.read_table(launcher.folder(run) / f"{name}.csv")
        label = name if run is first else f"{run.variables['level']:g} of it"
        left.plot(table.strain, 1e-3 * table.shear, linewidth=0.9, label=label)
    left.set(xlabel="shear strain", ylabel="shear stress (kPa)", title=tests[0][0].replace("_", ", "))
    left.legend(frameon=False, fontsize=8)
    shown = set()
    colours = {name: f"C{i}" for i, name in enumerate(dict.fromkeys(name for name, _, _ in tests))}
    for name, first, others in tests:
        (normal, shear, _), points, flow = analyse(launcher, first, others)
        colour = colours[name]
        right.plot(1e-3 * points[:, 0], 1e-3 * points[:, 1], "o", color=colour, markersize=4)
        right.plot(1e-3 * normal, 1e-3 * shear, "s", color=colour, markersize=5, markerfacecolor="none")
        if name in shown:
            continue
        shown.add(name)
        line = np.array([0.0, 1.05 * normal])
        right.plot(1e-3 * line, 1e-3 * (flow.cohesion + line * np.tan(np.radians(flow.friction))),
                   color=colour, linewidth=0.9, label=name.replace("_", ", "))
        centre, radius = yield_locus.circle_of_preshear(flow.cohesion, np.radians(flow.friction),
                                                        (normal, shear))
        for middle, size in ((centre, radius), (0.5 * flow.unconfined, 0.5 * flow.unconfined)):
            angle = np.linspace(0.0, np.pi, 181)
            right.plot(1e-3 * (middle + size * np.cos(angle)), 1e-3 * size * np.sin(angle), color=colour,
                       linewidth=0.7)
    right.set(xlabel="normal stress (kPa)", ylabel="shear stress (kPa)", xlim=(0.0, None), ylim=(0.0, None))
    right.set_aspect("equal")
    right.legend(frameon=False, fontsize=8)
    save(figure, launcher.out / "yield_locus.png")


def picture(launcher: running.Launcher, first: Run) -> None:
    """A radial section at the end of preshear, with the lid where it is then."""
    folder = launcher.folder(first)
    (shot,) = tables.read_dump(folder / "preshear.dump")
    table = tables.read_table(folder / "preshear.csv")
    lid = 1e-3 * meshes.read_stl(launcher.out / "lid.stl")
    cos, sin = np.cos(table.angle[-1]), np.sin(table.angle[-1])
    lid = meshes.moved(lid @ np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]),
                       z=float(table.height[-1]))
    walls = [1e-3 * meshes.read_stl(launcher.out / f"{name}.stl") for name in ("bottom", "sides")]
    figure, axis = plt.subplots(figsize=(9.0, 3.6), constrained_layout=True)
    speed = np.abs(shot.columns["vy"])
    circles = draw_section(axis, shot.positions(), shot.columns["radius"], [lid, *walls], 1e3 * speed)
    axis.set_ylim(-2.0, 26.0)
    figure.colorbar(circles, ax=axis, label="speed across the section (mm/s)", shrink=0.8)
    axis.set_title(first.name.rsplit("_seed", 1)[0].replace("_", ", "), fontsize=10)
    save(figure, launcher.out / "shear_cell.png")


def run(arguments: argparse.Namespace) -> None:
    launcher = running.launcher(arguments)
    arguments.out = launcher.out
    geometry.write(launcher.out, MESH)
    tests = cases(arguments)
    launcher.start_all([run for _, first, others in tests for run in (first, *others)], arguments.jobs)
    report(launcher, tests)


def main(words: Optional[Sequence[str]] = None) -> int:
    parser = running.parser(__doc__, "shear_cell")
    parser.add_argument("--consolidation", type=float, default=5.0e3, metavar="P",
                        help="normal stress of preshear in Pa")
    arguments = parser.parse_args(words)
    return running.exit_status("run.py", lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-2.0-only
"""What walls cost: spheres at rest in a cube of triangles, of planes, and without walls in turn."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Sequence

import numpy as np

from machines.meshes import write_stl

from .cases import start_file
from .lammps import Program, run_lammps
from .lammps_log import read_log
from .output import text_table
from .statistics import Median, column, median

HERE = Path(__file__).resolve().parent.parent
WALLS = ("none", "planes", "mesh")
DIAMETER = 1.0e-3    #: that of in.filling [m]


def cube(side: float, cuts: int) -> np.ndarray:
    """The surface of a cube about the origin, 12 cuts^2 triangles, normals outwards: (triangle, corner, xyz)."""
    edge = side * (np.arange(cuts + 1) / cuts - 0.5)
    u, v = (grid[:-1, :-1].ravel() for grid in np.meshgrid(edge, edge, indexing="ij"))
    step = side / cuts
    corners = [(u, v), (u + step, v), (u + step, v + step), (u, v + step)]
    faces = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            points = np.empty((4, len(u), 3))
            for k, (a, b) in enumerate(corners):
                points[k, :, axis] = 0.5 * sign * side
                points[k, :, (axis + 1) % 3] = a
                points[k, :, (axis + 2) % 3] = b
            order = ((0, 1, 2), (0, 2, 3)) if sign > 0.0 else ((0, 2, 1), (0, 3, 2))
            faces += [np.stack([points[k] for k in three], axis=1) for three in order]
    return np.concatenate(faces)


def measure(program: Program, cells: int, cuts: int, steps: int, rounds: int, work: Path) -> List[Dict]:
    """One row a run: none, planes, mesh, none, ...

    :param cells: spheres along an edge of the cube before they fall
    :param cuts: of each edge of the cube: 12 cuts^2 triangles
    """
    data = start_file(program, work, "filling", cells**3, {"cells": str(cells)})
    folder = work / "run"
    folder.mkdir(parents=True, exist_ok=True)
    stl = folder / "cube.stl"
    write_stl(stl, cube(cells * DIAMETER, cuts))
    rows = []
    for k in range(rounds):
        for walls in WALLS:
            variables = {"data": data, "walls": walls, "cells": cells, "stl": stl, "steps": steps,
                         "measure": HERE / "measure.lmp"}
            done = run_lammps(program, HERE / "in.container", folder,
                              {name: str(value) for name, value in variables.items()})
            run = read_log(done.log)
            rows.append({"walls": walls, "round": k, "atoms": run.atoms, "steps": run.steps,
                         "triangles": 12 * cuts**2, "loop_s": run.loop,
                         **{f"{name.lower()}_s": value for name, value in run.sections.items()},
                         "contacts": run.contacts, "wall_contacts": run.figures["wall_contacts"],
                         "builds": run.builds, "cpu_percent": run.cpu_percent,
                         "peak_kb": done.peak_kb})
            print(f"  round {k + 1} of {rounds}: {walls}: {run.loop:.3f} s", flush=True)
    return rows


def share(rows: Sequence[Dict], walls: str) -> Median:
    """What part of the loop the walls take, round by round: they are part of LAMMPS's section Modify, whose
    other fixes are measured without walls. All is taken over the rest of the same run, so that noise that
    slows down a whole run does not count."""
    def over_the_rest(name: str) -> Dict[int, float]:
        loop, modify = (column(rows, name, "walls", value) for value in ("loop_s", "modify_s"))
        return {k: modify[k] / (loop[k] - modify[k]) for k in loop}

    bare, own = over_the_rest("none"), over_the_rest(walls)
    return median([(own[k] - bare[k]) / (1.0 + own[k]) for k in sorted(own) if k in bare])


def table(rows: Sequence[Dict]) -> str:
    header = ("walls", "loop, s", "share of walls, %", "contacts", "with walls", "memory, MB", "CPU, %")
    lines = []
    for walls in WALLS:
        own = [row for row in rows if row["walls"] == walls]
        part = share(rows, walls)
        lines.append([
            walls, f"{median([row['loop_s'] for row in own]).value:.3f}",
            "" if walls == "none" else
            f"{100.0 * part.value:.1f} [{100.0 * part.low:.1f}, {100.0 * part.high:.1f}]",
            f"{own[-1]['contacts']:.0f}", f"{own[-1]['wall_contacts']:.0f}",
            f"{median([row['peak_kb'] for row in own]).value / 1024.0:.0f}",
            f"{min(row['cpu_percent'] for row in own):.1f}"])
    return text_table(header, lines) + (
        f"\n{rows[0]['atoms']} spheres at rest in a cube of {rows[0]['triangles']} triangles, "
        f"{rows[0]['steps']} steps on one core.\nThe share is that of "
        "the rounds' own, with its quartiles; memory is the largest of the whole program.\n")

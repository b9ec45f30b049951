#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Loads and wear of a mesh wall as files for ParaView.

    scripts/wear_to_vtk.py mill.stl wear.dump build/wear

reads the STL file of `fix wall/gran/eepa ... wall mesh mill.stl ... faces N` and a `dump local` of the
fix's six columns, and writes build/wear_STEP.vtu for each step of the dump, and build/wear.pvd, which
holds them together. The mesh is drawn as it is in its file, whatever its motion; --scale,
--rotation and --offset are those of the fix.
"""

import argparse
import sys

import meshio
import numpy as np

COLUMNS = ["number", "area", "pressure", "shear", "sliding", "impact"]


def read_dump(name):
    """Yields (step, rows) of a dump local with the columns above; rows: (faces, 6)."""
    with open(name) as lines:
        for line in lines:
            if line.strip() != "ITEM: TIMESTEP":
                continue
            step = int(next(lines))
            if not next(lines).startswith("ITEM: NUMBER OF ENTRIES"):
                raise ValueError(f"{name}: step {step}: this is no dump local")
            count = int(next(lines))
            for line in lines:
                if line.startswith("ITEM: ENTRIES"):
                    break
            columns = len(line.split()) - 2
            if columns != len(COLUMNS):
                raise ValueError(f"{name}: step {step} has {columns} columns, {len(COLUMNS)} are "
                                 "needed: f_ID[1] to f_ID[6]")
            rows = np.array([next(lines).split() for _ in range(count)], float)
            yield step, rows.reshape(count, columns)


def transformed(points, scale, rotation, offset):
    """Points (n, 3) scaled, turned about an axis through the origin by degrees, and moved."""
    axis, angle = np.array(rotation[:3]), np.radians(rotation[3])
    axis = axis / np.linalg.norm(axis)
    points = scale * points
    along = (points @ axis)[:, None] * axis
    turned = along + np.cos(angle) * (points - along) + np.sin(angle) * np.cross(axis, points)
    return turned + np.array(offset)


def write(mesh, dump, out, scale=1.0, rotation=(0, 0, 1, 0), offset=(0, 0, 0)):
    """Writes a .vtu file for each step of the dump and one .pvd file. Returns the steps."""
    stl = meshio.read(mesh, file_format="stl")
    triangles = stl.get_cells_type("triangle")
    points = transformed(stl.points, scale, rotation, offset)
    steps = []
    for step, rows in read_dump(dump):
        numbers = rows[:, 0].astype(int)
        if len(numbers) and not 1 <= numbers.min() <= numbers.max() <= len(triangles):
            raise ValueError(f"{dump}: step {step} has triangles {numbers.min()} to "
                             f"{numbers.max()}, {mesh} has {len(triangles)}")
        # triangles without area have no row
        table = np.full((len(triangles), len(COLUMNS)), np.nan)
        table[numbers - 1] = rows
        data = {name: [table[:, k]] for k, name in enumerate(COLUMNS)}
        meshio.Mesh(points, [("triangle", triangles)], cell_data=data).write(f"{out}_{step}.vtu")
        steps.append(step)
    if not steps:
        raise ValueError(f"{dump}: no step in this file")
    with open(f"{out}.pvd", "w") as collection:
        collection.write('<VTKFile type="Collection" version="0.1"><Collection>\n')
        for step in steps:
            name = f"{out}_{step}.vtu".split("/")[-1]
            collection.write(f'<DataSet timestep="{step}" file="{name}"/>\n')
        collection.write("</Collection></VTKFile>\n")
    return steps


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", help="STL file")
    parser.add_argument("dump", help="dump local of f_ID[1] to f_ID[6]")
    parser.add_argument("out", help="beginning of the names of the files to write")
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--rotation", type=float, nargs=4, default=(0, 0, 1, 0),
                        metavar=("AX", "AY", "AZ", "DEGREES"))
    parser.add_argument("--offset", type=float, nargs=3, default=(0, 0, 0),
                        metavar=("X", "Y", "Z"))
    args = parser.parse_args()
    try:
        steps = write(args.mesh, args.dump, args.out, args.scale, args.rotation, args.offset)
    except (OSError, ValueError, meshio.ReadError) as error:
        sys.exit(f"wear_to_vtk.py: {error}")
    print(f"{args.out}.pvd: {len(steps)} steps")


if __name__ == "__main__":
    main()

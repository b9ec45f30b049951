#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes silo.stl, a cylinder on a cone with an orifice, and gate.stl, the disc that closes it."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from machines import meshes  # noqa: E402


def silo(radius: float, orifice: float, cone: float, height: float, facets: int) -> np.ndarray:
    """Open at the top and at the orifice, around which z is 0.

    :param radius, orifice: radii of the cylinder and of the orifice
    :param cone, height: heights of the cone and of the cylinder on it; 0 is a flat bottom
    """
    if not 0.0 < orifice < radius:
        raise meshes.BadMesh(f"orifice {orifice:g}, allowed is between 0 and the radius, {radius:g}")
    if cone < 0.0 or height <= 0.0:
        raise meshes.BadMesh(f"heights {cone:g} and {height:g}, allowed is 0 or more and more than 0")
    return meshes.revolve([(orifice, 0.0), (radius, cone), (radius, cone + height)], facets)


def gate(orifice: float, facets: int) -> np.ndarray:
    return meshes.disc(orifice, 0.0, facets)


def write(folder: Path, shape: Dict[str, float]) -> None:
    """:param shape: the arguments of silo(), lengths in m; the files are in mm"""
    folder.mkdir(parents=True, exist_ok=True)
    mm = {name: value if name == "facets" else 1e3 * value for name, value in shape.items()}
    meshes.write_stl(folder / "silo.stl", silo(**mm))
    meshes.write_stl(folder / "gate.stl", gate(mm["orifice"], mm["facets"]))


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    for name, value in (("radius", 0.1), ("orifice", 0.03), ("cone", 0.07), ("height", 0.3)):
        parser.add_argument(f"--{name}", type=float, default=value, help="in m")
    parser.add_argument("--facets", type=int, default=100, help="of the circle")
    return parser


if __name__ == "__main__":
    sys.exit(meshes.main(arguments(), write))

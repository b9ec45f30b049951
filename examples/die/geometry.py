#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes a die and its punches: die.stl, a tube along z, open at both ends; collar.stl, a tube on it that
holds the loose powder; lower.stl, a closed punch with its face at z = 0, and upper.stl, the same with its
face downwards."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from machines import meshes  # noqa: E402


def tube(radius: float, bottom: float, top: float, facets: int) -> np.ndarray:
    """Normals point inwards."""
    return meshes.revolve([(radius, top), (radius, bottom)], facets)


def punch(radius: float, gap: float, length: float, cup: float, facets: int) -> np.ndarray:
    """A closed body with its face upwards and its rim at z = 0.

    :param gap: between punch and die
    :param cup: depth of the hollow in its face, a cone with a flat middle of half the radius; 0 is a flat
        face
    """
    rim = radius - gap
    face = [(rim, 0.0), (0.5 * rim, -cup), (0.0, -cup)] if cup else [(rim, 0.0), (0.0, 0.0)]
    return meshes.revolve([(0.0, -length), (rim, -length)] + face, facets)


def write(folder: Path, shape: Dict[str, float]) -> None:
    """:param shape: height of the die, that of the collar, and the arguments of punch(), lengths in m; the
    files are in mm"""
    folder.mkdir(parents=True, exist_ok=True)
    mm = {name: value if name == "facets" else 1e3 * value for name, value in shape.items()}
    height, collar = mm.pop("height"), mm.pop("collar")
    meshes.write_stl(folder / "die.stl", tube(mm["radius"], 0.0, height, mm["facets"]))
    meshes.write_stl(folder / "collar.stl", tube(mm["radius"], height, height + collar, mm["facets"]))
    lower = punch(**mm)
    meshes.write_stl(folder / "lower.stl", lower)
    meshes.write_stl(folder / "upper.stl", meshes.upside_down(lower))


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    for name, value, text in (("radius", 0.010, "of the die"), ("height", 0.026, "of the die"),
                              ("collar", 0.024, "height"),
                              ("gap", 0.0001, "between punch and die"),
                              ("length", 0.004, "of a punch"), ("cup", 0.0, "depth of its face")):
        parser.add_argument(f"--{name}", type=float, default=value, help=f"{text}, in m")
    parser.add_argument("--facets", type=int, default=72, help="of the circle")
    return parser


if __name__ == "__main__":
    sys.exit(meshes.main(arguments(), write))

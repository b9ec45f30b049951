#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes drum.stl: a closed drum along the y axis with lifters along its inside."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from machines import meshes  # noqa: E402


def cross_section(radius: float, lifters: int, lift: float, base: float, top: float,
                  facets: int) -> np.ndarray:
    """Corners (x, z) of the drum's inside, counter-clockwise.

    :param lifters: how many there are; 0 for a smooth drum
    :param lift, base, top: height of a lifter, its width at the drum and its smaller one inside
    :param facets: of the circle, in whole numbers between lifters
    """
    round_ = radius * meshes.same_area(facets)
    if lifters == 0:
        angles = 2.0 * np.pi * np.arange(facets) / facets
        return round_ * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    if not 0.0 < lift < radius or not 0.0 < top < base:
        raise meshes.BadMesh(f"lifters {lift:g} high, {base:g} and {top:g} wide, allowed is less than "
                             f"the radius {radius:g}, and 0 < top < base")
    foot, head = np.arcsin(0.5 * base / radius), np.arctan2(0.5 * top, radius - lift)
    if 2.0 * foot >= 2.0 * np.pi / lifters:
        raise meshes.BadMesh(f"{lifters} lifters of {base:g} touch each other")
    between = max(1, int(np.ceil(facets / lifters * (1.0 - foot * lifters / np.pi))))
    corners = []
    for middle in 2.0 * np.pi * np.arange(lifters) / lifters:
        tip = (radius - lift) / np.cos(head)
        arc = np.linspace(middle + foot, middle + 2.0 * np.pi / lifters - foot, between + 1)[:-1]
        corners += [(round_, middle - foot), (tip, middle - head), (tip, middle + head)]
        corners += [(round_, angle) for angle in arc]
    polar = np.array(corners)
    return polar[:, :1] * np.stack([np.cos(polar[:, 1]), np.sin(polar[:, 1])], axis=1)


def drum(length: float, **shape) -> np.ndarray:
    """:param shape: the arguments of cross_section()"""
    return meshes.extrude(cross_section(**shape), length)


def write(folder: Path, shape: Dict[str, float]) -> None:
    """:param shape: the arguments of drum(), lengths in m; the file is in mm"""
    folder.mkdir(parents=True, exist_ok=True)
    millimetres = {name: value if name in ("lifters", "facets") else 1e3 * value
                   for name, value in shape.items()}
    meshes.write_stl(folder / "drum.stl", drum(**millimetres))


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    for name, value in (("radius", 0.03), ("length", 0.02), ("lift", 0.003), ("base", 0.004),
                        ("top", 0.003)):
        parser.add_argument(f"--{name}", type=float, default=value, help="in m")
    parser.add_argument("--lifters", type=int, default=8, help="how many")
    parser.add_argument("--facets", type=int, default=96, help="of the circle")
    return parser


if __name__ == "__main__":
    sys.exit(meshes.main(arguments(), write))

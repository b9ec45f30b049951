#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes the parts of an annular shear cell about the z axis: bottom.stl, a ring with bars on it, z = 0
between them; lid.stl, a ring with vanes under it, z = 0 between them; sides.stl, the two walls."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from machines import meshes  # noqa: E402

#: Of the in-files, m: radii of the ring, height of bars and vanes, part of the circle that they take, gap of the lid; and what the
#: meshes need besides.
SHAPE = {"inner": 0.016, "outer": 0.032, "tooth": 0.003, "share": 0.15, "gap": 0.0003}
MESH = {**SHAPE, "height": 0.05, "teeth": 20, "facets": 120}


def bottom(inner: float, outer: float, teeth: int, tooth: float, share: float, gap: float,
           facets: int) -> np.ndarray:
    """Reaches `gap` into the walls, so that nothing falls between them."""
    return meshes.toothed_ring(inner - gap, outer + gap, teeth, tooth, share, 2.0 * gap, facets)


def lid(inner: float, outer: float, teeth: int, tooth: float, share: float, gap: float,
        facets: int) -> np.ndarray:
    """Keeps `gap` from the walls, so that it turns freely."""
    return meshes.upside_down(meshes.toothed_ring(inner + gap, outer - gap, teeth, tooth, share,
                                                  2.0 * gap, facets))


def sides(inner: float, outer: float, height: float, facets: int) -> np.ndarray:
    """Normals point into the ring."""
    return np.concatenate([meshes.revolve([(inner, 0.0), (inner, height)], facets),
                           meshes.revolve([(outer, height), (outer, 0.0)], facets)])


def write(folder: Path, shape: Dict[str, float]) -> None:
    """:param shape: the arguments of bottom() and sides(), lengths in m; the files are in mm"""
    folder.mkdir(parents=True, exist_ok=True)
    mm = {name: value if name in ("teeth", "share", "facets") else 1e3 * value
          for name, value in shape.items()}
    height = mm.pop("height")
    meshes.write_stl(folder / "bottom.stl", bottom(**mm))
    meshes.write_stl(folder / "lid.stl", lid(**mm))
    meshes.write_stl(folder / "sides.stl", sides(mm["inner"], mm["outer"], height, mm["facets"]))


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    for name, value, text in (("inner", 0.016, "radius"), ("outer", 0.032, "radius"),
                              ("height", 0.05, "of the walls"), ("tooth", 0.003, "height of bars and vanes"),
                              ("gap", 0.0003, "between lid and walls")):
        parser.add_argument(f"--{name}", type=float, default=value, help=f"{text}, in m")
    parser.add_argument("--teeth", type=int, default=20, help="bars, and vanes")
    parser.add_argument("--share", type=float, default=0.15, help="of the circle that they take")
    parser.add_argument("--facets", type=int, default=120, help="of the circle")
    return parser


if __name__ == "__main__":
    sys.exit(meshes.main(arguments(), write))

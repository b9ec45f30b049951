# SPDX-License-Identifier: GPL-2.0-only
"""Triangle meshes of revolved and extruded profiles, and STL files.

A mesh is an array of triangles, (n, 3, 3): triangle, corner, coordinate. Lengths are those of the
caller. Seen from the side that its normal points to, the corners of a triangle run counter-clockwise."""
from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, Optional, Sequence, Tuple

import numpy as np

Profile = Sequence[Tuple[float, float]]
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 80


class BadMesh(ValueError):
    """A mesh that can not be made or read; the message says what is wrong with it."""


def same_area(facets: int) -> float:
    """Radius of the corners of a regular polygon over that of the circle with the same area."""
    if facets < 3:
        raise BadMesh(f"{facets} facets, allowed are 3 or more")
    step = 2.0 * np.pi / facets
    return float(np.sqrt(step / np.sin(step)))


def revolve(profile: Profile, facets: int, closed: bool = False) -> np.ndarray:
    """The surface that a line of points (r, z) makes around the z axis.

    The circles become polygons of the same area. Normals point to the right of the line's direction
    in the r-z plane, r to the right and z up: outwards where the line runs upwards.

    :param closed: whether the last point is joined to the first
    """
    points = np.asarray(profile, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
        raise BadMesh("a profile needs two points (r, z) or more")
    if np.any(points[:, 0] < 0.0):
        raise BadMesh(f"the profile has a radius of {points[:, 0].min():g}, allowed is 0 or more")
    angles = 2.0 * np.pi * np.arange(facets) / facets
    radii = same_area(facets) * points[:, 0]
    # (point, facet, coordinate)
    ring = np.stack([radii[:, None] * np.cos(angles), radii[:, None] * np.sin(angles),
                     np.broadcast_to(points[:, 1:], (len(points), facets))], axis=2)
    turned = np.roll(ring, -1, axis=1)
    follow = list(range(1, len(points))) + ([0] if closed else [])
    pieces = []
    for here, there in zip(range(len(points)), follow):
        if radii[here] > 0.0:
            pieces.append(np.stack([ring[here], turned[here], ring[there]], axis=1))
        if radii[there] > 0.0:
            pieces.append(np.stack([turned[here], turned[there], ring[there]], axis=1))
    return np.concatenate(pieces)


def disc(radius: float, z: float, facets: int, rings: int = 1) -> np.ndarray:
    """A flat disc across the z axis, its normal along +z."""
    line = [(radius * (rings - i) / rings, z) for i in range(rings + 1)]
    return revolve(line, facets)


def extrude(polygon: Profile, length: float) -> np.ndarray:
    """The closed body of a polygon (x, z), drawn out along y from -length/2 to length/2. Normals point
    outwards.

    The polygon runs counter-clockwise with x to the right and z up. The ends are fans around the
    origin, which every corner must see."""
    points = np.asarray(polygon, dtype=float)
    turned = np.roll(points, -1, axis=0)
    cross = points[:, 0] * turned[:, 1] - points[:, 1] * turned[:, 0]
    if np.any(cross <= 0.0):
        raise BadMesh("the polygon does not run counter-clockwise about the origin in every corner")

    def at(flat: np.ndarray, y: float) -> np.ndarray:
        return np.stack([flat[:, 0], np.full(len(flat), y), flat[:, 1]], axis=1)

    half = 0.5 * length
    front, front_next = at(points, -half), at(turned, -half)
    back, back_next = at(points, half), at(turned, half)
    centre = np.zeros_like(points)
    return np.concatenate([
        np.stack([front, back, front_next], axis=1),
        np.stack([front_next, back, back_next], axis=1),
        np.stack([at(centre, -half), front, front_next], axis=1),
        np.stack([at(centre, half), back_next, back], axis=1)])


def toothed_ring(inner: float, outer: float, teeth: int, height: float, share: float,
                 thickness: float, facets: int) -> np.ndarray:
    """A closed flat ring, of which teeth stand up to z = height. Between them it reaches from
    z = -thickness to 0. Teeth are radial and as wide as the ring.

    :param share: what part of the circumference the teeth take, between 0 and 1
    :param facets: of the whole circle, rounded up so that teeth and gaps have whole numbers of them
    """
    if not 0.0 < inner < outer:
        raise BadMesh(f"radii {inner:g} and {outer:g}, allowed is 0 < inner < outer")
    if not 0.0 < share < 1.0:
        raise BadMesh(f"teeth take {share:g} of the circumference, allowed is between 0 and 1")
    across = max(1, int(np.ceil(share * facets / teeth)))
    between = max(1, int(np.ceil((1.0 - share) * facets / teeth)))
    period = 2.0 * np.pi / teeth
    edges = np.concatenate([share * period * np.arange(across) / across,
                            period * (share + (1.0 - share) * np.arange(between) / between)])
    angles = (np.arange(teeth)[:, None] * period + edges).ravel()
    tops = np.tile(np.concatenate([np.full(across, height), np.zeros(between)]), teeth)
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)

    def at(i: int, radius: float, z: float) -> np.ndarray:
        return np.append(radius * directions[i % len(angles)], z)

    triangles = []

    def quad(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> None:
        triangles.extend([(a, b, c), (a, c, d)])

    for i, top in enumerate(tops):
        before = tops[i - 1]
        quad(at(i, inner, top), at(i, outer, top), at(i + 1, outer, top), at(i + 1, inner, top))
        quad(at(i, inner, -thickness), at(i + 1, inner, -thickness), at(i + 1, outer, -thickness),
             at(i, outer, -thickness))
        # The rims have corners at z = 0 too, where the flanks of the teeth end.
        levels = [-thickness, 0.0] + ([height] if top > 0.0 else [])
        for low, high in zip(levels, levels[1:]):
            quad(at(i, outer, low), at(i + 1, outer, low), at(i + 1, outer, high), at(i, outer, high))
            quad(at(i + 1, inner, low), at(i, inner, low), at(i, inner, high), at(i + 1, inner, high))
        if top > before:
            quad(at(i, inner, 0.0), at(i, outer, 0.0), at(i, outer, top), at(i, inner, top))
        elif top < before:
            quad(at(i, outer, 0.0), at(i, inner, 0.0), at(i, inner, before), at(i, outer, before))
    return np.asarray(triangles)


def upside_down(triangles: np.ndarray) -> np.ndarray:
    """The mesh turned by half a turn about the x axis, normals along."""
    return triangles * np.array([1.0, -1.0, -1.0])


def moved(triangles: np.ndarray, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    return triangles + np.array([x, y, z])


def reversed_normals(triangles: np.ndarray) -> np.ndarray:
    return triangles[:, [0, 2, 1]]


def area(triangles: np.ndarray) -> float:
    return float(0.5 * np.linalg.norm(_cross(triangles), axis=1).sum())


def volume(triangles: np.ndarray) -> float:
    """Of the body that a closed mesh bounds, negative where its normals point inwards."""
    return float(np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6.0)


def _cross(triangles: np.ndarray) -> np.ndarray:
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


@dataclass(frozen=True)
class Topology:
    """How the triangles of a mesh hang together.

    :param euler: vertices - edges + faces
    :param border: edges of one triangle only
    :param crowded: edges of more than two
    :param turned: edges that two triangles pass in the same direction, so that their normals differ
    """

    vertices: int
    edges: int
    faces: int
    border: int
    crowded: int
    turned: int
    degenerate: int
    duplicates: int

    @property
    def euler(self) -> int:
        return self.vertices - self.edges + self.faces

    @property
    def sound(self) -> bool:
        return not (self.crowded or self.turned or self.degenerate or self.duplicates)

    @property
    def watertight(self) -> bool:
        return self.sound and not self.border


def topology(triangles: np.ndarray, tolerance: float = 1e-6) -> Topology:
    """:param tolerance: below which corners are the same, over the size of the mesh"""
    size = float(np.ptp(triangles.reshape(-1, 3), axis=0).max())
    grid = np.round(triangles.reshape(-1, 3) / (tolerance * size)).astype(np.int64)
    vertices, index = np.unique(grid, axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)
    flat = ((faces[:, 0] == faces[:, 1]) | (faces[:, 1] == faces[:, 2]) | (faces[:, 2] == faces[:, 0])
            | (np.linalg.norm(_cross(triangles), axis=1) < (tolerance * size)**2))
    duplicates = len(faces) - len(np.unique(np.sort(faces, axis=1), axis=0))
    directed = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, passes = np.unique(directed, axis=0, return_counts=True)
    edges, uses = np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)
    return Topology(len(vertices), len(edges), len(faces), int(np.sum(uses == 1)),
                    int(np.sum(uses > 2)), int(np.sum(passes > 1)), int(np.sum(flat)), duplicates)


def write_stl(path: Path, triangles: np.ndarray) -> None:
    """Binary STL. Its numbers have 24 bits, so it is best in a unit that makes them of order one."""
    records = np.zeros(len(triangles), dtype=_RECORD)
    cross = _cross(triangles)
    records["normal"] = cross / np.linalg.norm(cross, axis=1)[:, None]
    records["corners"] = triangles
    with Path(path).open("wb") as file:
        file.write(b"binary STL".ljust(_HEADER))
        file.write(np.uint32(len(triangles)).astype("<u4").tobytes())
        file.write(records.tobytes())


def read_stl(path: Path) -> np.ndarray:
    """The triangles of a binary STL file."""
    data = Path(path).read_bytes()
    count = int.from_bytes(data[_HEADER:_HEADER + 4], "little")
    if len(data) != _HEADER + 4 + count * _RECORD.itemsize:
        raise BadMesh(f"{path} is no binary STL file of {count} triangles")
    return np.frombuffer(data, dtype=_RECORD, offset=_HEADER + 4)["corners"].astype(float)


def main(parser: argparse.ArgumentParser, write: Callable[[Path, Dict[str, float]], None],
         words: Optional[Sequence[str]] = None) -> int:
    """The program that writes the files of a machine.

    :param parser: of the numbers that write() gets, by name
    :return: exit status
    """
    parser.add_argument("--out", type=Path, default=Path("."), help="folder of the files")
    shape = vars(parser.parse_args(words))
    try:
        write(shape.pop("out"), shape)
    except (BadMesh, OSError) as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 1
    return 0

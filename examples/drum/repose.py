# SPDX-License-Identifier: GPL-2.0-only
"""The dynamic angle of repose from snapshots of a drum whose axis is y."""
from __future__ import annotations

from dataclasses import dataclass
from typing import List, Sequence, Tuple

import numpy as np


@dataclass(frozen=True)
class Surface:
    """Points (x, z) of a free surface and the straight line through its middle.

    :param angle: of the line to the horizontal, positive where it falls towards +x (degrees)
    """

    x: np.ndarray
    z: np.ndarray
    angle: float
    height: float


def filling(positions: np.ndarray, d: float, radius: float, length: float,
            cell: float) -> Tuple[np.ndarray, np.ndarray]:
    """Part of the volume that spheres take, on a grid of cells in x and z, mean over the length; and the
    middles of the cells, the same in x and z.

    A sphere is spread over the cells by 200 points inside of it."""
    cells = int(np.ceil(2.0 * radius / cell))
    edges = np.linspace(-0.5 * cells * cell, 0.5 * cells * cell, cells + 1)
    random = np.random.default_rng(1)
    points = random.normal(size=(200, 3))
    points *= (0.5 * d * random.random(200)**(1 / 3) / np.linalg.norm(points, axis=1))[:, None]
    spread = (positions[:, None, [0, 2]] + points[None, :, [0, 2]]).reshape(-1, 2)
    counts, _, _ = np.histogram2d(spread[:, 0], spread[:, 1], bins=(edges, edges))
    volume = counts * (np.pi / 6.0 * d**3 / len(points))
    return volume / (cell**2 * length), 0.5 * (edges[1:] + edges[:-1])


def surface(part: np.ndarray, middles: np.ndarray, radius: float, reach: float = 0.5) -> Surface:
    """Where the filling falls to half of that of the heap, along lines normal to the surface.

    :param part: filling of cells in x and z
    :param reach: half the length of the line that is fitted, over the radius
    """
    heap = 0.5 * float(np.median(part[part > 0.3])) if np.any(part > 0.3) else 0.0
    if heap == 0.0:
        raise ValueError("there is no heap in the drum")
    angle = 0.0
    x, z = np.empty(0), np.empty(0)
    for _ in range(12):
        along = np.array([np.cos(angle), -np.sin(angle)])
        up = np.array([np.sin(angle), np.cos(angle)])
        s = np.arange(-reach * radius, reach * radius, 0.5 * (middles[1] - middles[0]))
        t = np.linspace(radius, -radius, 8 * len(middles))
        where = s[:, None, None] * along + t[None, :, None] * up
        values = _interpolate(part, middles, where)
        values[np.sum(where**2, axis=2) > (0.93 * radius)**2] = 0.0
        # From above, the first place from where on the heap is filled for more than a particle.
        full = values >= heap
        run = max(2, int(0.08 * radius / (t[0] - t[1])))
        first = np.argmax(full & _held(full, run), axis=1)
        good = first > 0
        upper = values[np.arange(len(s)), np.maximum(first - 1, 0)]
        lower = values[np.arange(len(s)), first]
        share = np.where(lower > upper, (lower - heap) / np.where(lower > upper, lower - upper, 1.0), 0.0)
        height = t[first] + share * (t[0] - t[1])
        slope, offset = np.polyfit(s[good], height[good], 1)
        points = s[good, None] * along + height[good, None] * up
        x, z = points[:, 0], points[:, 1]
        angle -= np.arctan(slope)
        if abs(slope) < 1e-4:
            break
    return Surface(x, z, float(np.degrees(angle)), float(offset))


def _held(full: np.ndarray, run: int) -> np.ndarray:
    """Where this place and the `run` - 1 next ones are full."""
    held = full.copy()
    for shift in range(1, run):
        held[:, :-shift] &= full[:, shift:]
        held[:, -shift:] = False
    return held


def _interpolate(part: np.ndarray, middles: np.ndarray, where: np.ndarray) -> np.ndarray:
    """Bilinear, 0 outside."""
    step = middles[1] - middles[0]
    at = (where - middles[0]) / step
    base = np.floor(at).astype(int)
    weight = at - base
    inside = np.all((base >= 0) & (base < len(middles) - 1), axis=-1)
    i, k = np.where(inside, base[..., 0], 0), np.where(inside, base[..., 1], 0)
    a, b = weight[..., 0], weight[..., 1]
    value = ((1 - a) * (1 - b) * part[i, k] + a * (1 - b) * part[i + 1, k]
             + (1 - a) * b * part[i, k + 1] + a * b * part[i + 1, k + 1])
    return np.where(inside, value, 0.0)


def angles(snapshots: Sequence[np.ndarray], d: float, radius: float, length: float) -> List[float]:
    """Of the surface of each snapshot (positions), in degrees."""
    found = []
    for positions in snapshots:
        part, middles = filling(positions, d, radius, length, 0.5 * d)
        found.append(surface(part, middles, radius).angle)
    return found


def error_of_mean(series: Sequence[float], blocks: int = 5) -> float:
    """Standard error of the mean of a correlated series, from the means of blocks."""
    means = [np.mean(block) for block in np.array_split(np.asarray(series, dtype=float), blocks)]
    return float(np.std(means, ddof=1) / np.sqrt(blocks))

# SPDX-License-Identifier: GPL-2.0-only
"""Sections through particles and meshes, by Matplotlib."""
from __future__ import annotations

from pathlib import Path
from typing import Optional, Sequence, Tuple

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import EllipseCollection, LineCollection  # noqa: E402

__all__ = ["plt", "cut_mesh", "cut_particles", "draw_section", "save"]

_DPI = 130


def cut_mesh(triangles: np.ndarray, axis: int = 1, at: float = 0.0) -> np.ndarray:
    """Lines in which a mesh meets the plane of constant coordinate `axis`: (n, 2, 2), each end with the
    two other coordinates in their order."""
    # A plane through corners would give points and whole triangles; a hair beside them it does not.
    at = at + 1e-9 * float(np.ptp(triangles[..., axis]) or 1.0)
    side = triangles[..., axis] - at
    crossing = np.any(side > 0.0, axis=1) & np.any(side < 0.0, axis=1)
    others = [i for i in range(3) if i != axis]
    lines = []
    for corners, s in zip(triangles[crossing], side[crossing]):
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            if (s[a] > 0.0) != (s[b] > 0.0):
                ends.append(corners[a] + s[a] / (s[a] - s[b]) * (corners[b] - corners[a]))
        lines.append([end[others] for end in ends])
    return np.asarray(lines).reshape(-1, 2, 2)


def cut_particles(positions: np.ndarray, radii: np.ndarray, axis: int = 1,
                  at: float = 0.0) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Circles in which spheres meet a plane: which spheres, their centres in the plane and radii."""
    height = positions[:, axis] - at
    hit = np.flatnonzero(np.abs(height) < radii)
    others = [i for i in range(3) if i != axis]
    return hit, positions[hit][:, others], np.sqrt(radii[hit]**2 - height[hit]**2)


def draw_section(axes, positions: np.ndarray, radii: np.ndarray, meshes: Sequence[np.ndarray] = (),
                 colours: Optional[np.ndarray] = None, axis: int = 1, at: float = 0.0,
                 scale: float = 1e3, limits: Optional[Tuple[float, float]] = None, cmap: str = "viridis"):
    """Draws the particles and meshes that a plane meets, in mm for lengths in m.

    :param colours: a number for each particle
    :return: the collection of circles, for a colour bar
    """
    hit, centres, sizes = cut_particles(positions, radii, axis, at)
    circles = EllipseCollection(2 * scale * sizes, 2 * scale * sizes, np.zeros(len(hit)), units="xy",
                                offsets=scale * centres, transOffset=axes.transData, linewidth=0.0)
    if colours is None:
        circles.set_facecolor("#8fb1cc")
    else:
        circles.set_array(np.asarray(colours)[hit])
        circles.set_cmap(cmap)
        if limits is not None:
            circles.set_clim(*limits)
    axes.add_collection(circles)
    for mesh in meshes:
        axes.add_collection(LineCollection(scale * cut_mesh(mesh, axis, at), colors="0.2",
                                           linewidths=1.2))
    names = [name for i, name in enumerate("xyz") if i != axis]
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_xlabel(f"{names[0]} (mm)")
    axes.set_ylabel(f"{names[1]} (mm)")
    return circles


def save(figure, path: Path) -> None:
    """Without the date and the version of Matplotlib, so that equal pictures are equal files."""
    figure.savefig(path, dpi=_DPI, metadata={"Software": None})
    plt.close(figure)
    print(f"Figure: {path}")

# SPDX-License-Identifier: GPL-2.0-only
"""What the table of in.die tells of a tablet. SI units."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

COMPACT, HOLD, UNLOAD, EJECT = 1, 2, 3, 4


@dataclass(frozen=True)
class Tablet:
    """:param solid_loaded, solid_out: solid fractions under the pressure and of the tablet outside
    :param radial_loaded: radial stress at the wall over the axial one, under the pressure
    :param residual: radial stress at the wall after unloading
    :param ejection: largest force of the lower punch while the tablet is pushed out, as mean over a
        fiftieth of the way: the punch starts at once, and the tablet rings
    :param recovery: growth of the thickness from the pressure to the end
    """

    solid_loaded: float
    solid_out: float
    radial_loaded: float
    residual: float
    ejection: float
    recovery: float


def tablet(table: np.ndarray, particles_volume: float, area: float) -> Tablet:
    """:param table: with fields stage, top, bottom, side, thickness, as in.die writes it
    :param particles_volume: of all particles
    :param area: of the die
    """
    for stage, name in ((HOLD, "hold"), (UNLOAD, "unload"), (EJECT, "eject")):
        if not np.any(table["stage"] == stage):
            raise ValueError(f"the table has no stage {name} ({stage})")
    hold = table[table["stage"] == HOLD]
    loaded = hold[-max(1, len(hold) // 4):]
    unload = table[table["stage"] == UNLOAD]
    # The upper punch has left the tablet: the last fifth of its way.
    free = unload[-max(1, len(unload) // 5):]
    eject = table[table["stage"] == EJECT]
    window = max(1, len(eject) // 50)
    force = np.convolve(eject["bottom"], np.full(window, 1.0 / window), "valid")
    axial = 0.5 * (loaded["top"].mean() + loaded["bottom"].mean())
    return Tablet(
        solid_loaded=float(particles_volume / (area * loaded["thickness"].mean())),
        solid_out=float(particles_volume / (area * eject["thickness"][-1])),
        radial_loaded=float(loaded["side"].mean() / axial),
        residual=float(free["side"].mean()),
        ejection=float(area * force.max()),
        recovery=float(eject["thickness"][-1] / loaded["thickness"].mean() - 1.0))

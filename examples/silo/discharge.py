# SPDX-License-Identifier: GPL-2.0-only
"""What a discharge tells: rate, whether it stopped by itself, and what to compare it with."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Sequence, Tuple

import numpy as np

# Dosta et al., Comput. Phys. Commun. 296 (2024) 109066, large orifice, material M1: mean rate of all codes in
# particles a second, how far each may be from it, and particles left at these times (s) in two re-runs.
PUBLISHED_RATE = 23.2e3
PUBLISHED_SPREAD = 0.05
TIMES = (0.5, 1.0, 2.0, 3.0, 4.0)
LEFT: Dict[str, Tuple[int, ...]] = {"LIGGGHTS": (88542, 76015, 51271, 27007, 3953),
                                    "MUSEN": (88020, 75710, 51156, 27141, 4341)}


@dataclass(frozen=True)
class Discharge:
    """:param rate: particles a second, slope of the straight line of least squares
    :param error: its standard error from the scatter of eight pieces of the line
    :param blocked: whether it stopped with the silo not empty"""

    rate: float
    error: float
    blocked: bool
    left: float


def analyse(time: Sequence[float], inside: Sequence[float], begin: float = 0.1, end: float = 0.8,
            empty: float = 0.02, still: float = 0.2) -> Discharge:
    """:param begin, end: what part of the content has left where the line begins and ends; one that ends
        earlier is taken as far as it goes
    :param empty: part of the content that counts as an empty silo: a few particles lie on the bottom
    :param still: time without a particle that leaves that counts as blocked (s)
    """
    time, inside = np.asarray(time, dtype=float), np.asarray(inside, dtype=float)
    gone = 1.0 - inside / inside[0]
    moved = np.flatnonzero(np.diff(inside))
    last = time[moved[-1] + 1] if len(moved) else time[0]
    blocked = bool(gone[-1] < 1.0 - empty and time[-1] - last >= still)
    until = last if blocked else time[-1]
    some = (gone >= begin) & (gone <= end) & (time <= until)
    if blocked and np.sum(some) < 16:
        # It stopped before it flowed steadily.
        return Discharge(0.0, 0.0, True, float(inside[-1]))
    if np.sum(some) < 16:
        raise ValueError(f"{int(np.sum(some))} samples of the steady discharge, needed are 16")
    rate = -np.polyfit(time[some], inside[some], 1)[0]
    pieces = [-np.polyfit(t, n, 1)[0] for t, n in zip(np.array_split(time[some], 8),
                                                      np.array_split(inside[some], 8)) if len(t) > 1]
    return Discharge(float(rate), float(np.std(pieces, ddof=1) / np.sqrt(len(pieces))), blocked,
                     float(inside[-1]))


def left_at(time: Sequence[float], inside: Sequence[float], at: Sequence[float] = TIMES) -> np.ndarray:
    """Particles left at these times; not a number beyond the last one of a silo that is not empty."""
    time, inside = np.asarray(time, dtype=float), np.asarray(inside, dtype=float)
    found = np.interp(at, time, inside)
    beyond = np.asarray(at) > time[-1]
    found[beyond] = np.where(inside[-1] < 0.02 * inside[0], inside[-1], np.nan)
    return found


def emptied(time: Sequence[float], inside: Sequence[float], left: float = 0.002) -> float:
    """When this part of the content is left (s); not a number where it never is."""
    time, inside = np.asarray(time, dtype=float), np.asarray(inside, dtype=float)
    empty = np.flatnonzero(inside <= left * inside[0])
    return float(time[empty[0]]) if len(empty) else float("nan")


def beverloo(orifice: float, d: float, bulk_density: float, c: float = 0.58, k: float = 1.4,
             gravity: float = 9.81) -> float:
    """Mass a second by Beverloo's law, C rho sqrt(g) (D - k d)^2.5, for a flat bottom; a cone gives more.

    :param orifice: its diameter D
    """
    return c * bulk_density * np.sqrt(gravity) * max(orifice - k * d, 0.0)**2.5

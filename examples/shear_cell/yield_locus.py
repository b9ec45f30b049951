# SPDX-License-Identifier: GPL-2.0-only
"""Yield locus, Mohr circles and flow function of a powder by the construction of ASTM D6773, with a
straight yield locus. Stresses in any unit, angles in degrees."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence, Tuple

import numpy as np


@dataclass(frozen=True)
class Flow:
    """:param cohesion, friction: of the yield locus, shear = cohesion + normal tan(friction)
    :param unconfined: unconfined yield strength, the larger principal stress of the circle through 0 that
        touches the yield locus
    :param major: major consolidation stress, that of the circle through the point of preshear
    :param effective: effective angle of internal friction
    :param steady: angle of internal friction in the steady state of preshear
    """

    cohesion: float
    friction: float
    unconfined: float
    major: float
    effective: float
    steady: float

    @property
    def ffc(self) -> float:
        return self.major / self.unconfined if self.unconfined > 0.0 else float("inf")


def prorated(shear: Sequence[float], preshear: Sequence[float]) -> np.ndarray:
    """Shear stresses at failure as if each preshear had ended at the mean of all: times mean/its own."""
    preshear = np.asarray(preshear, dtype=float)
    return np.asarray(shear, dtype=float) * preshear.mean() / preshear


def flow(normal: Sequence[float], shear: Sequence[float], preshear: Tuple[float, float]) -> Flow:
    """:param normal, shear: stresses at failure
    :param preshear: normal and shear stress of the steady state
    """
    normal, shear = np.asarray(normal, dtype=float), np.asarray(shear, dtype=float)
    if len(normal) < 2 or np.ptp(normal) == 0.0:
        raise ValueError(f"{len(normal)} points at failure, needed are 2 with different normal stresses")
    slope, cohesion = np.polyfit(normal, shear, 1)
    if slope <= 0.0:
        raise ValueError(f"the yield locus falls: slope {slope:g}")
    phi = float(np.arctan(slope))
    # A yield locus that meets the normal axis to the right of 0 is that of a powder without strength.
    unconfined = max(2.0 * cohesion * np.cos(phi) / (1.0 - np.sin(phi)), 0.0)
    centre, radius = circle_of_preshear(cohesion, phi, preshear)
    return Flow(float(cohesion), np.degrees(phi), float(unconfined), centre + radius,
                float(np.degrees(np.arcsin(min(radius / centre, 1.0)))),
                float(np.degrees(np.arctan2(preshear[1], preshear[0]))))


def circle_of_preshear(cohesion: float, phi: float, point: Tuple[float, float]) -> Tuple[float, float]:
    """Centre and radius of the Mohr circle through a point that touches the yield locus to the left of it.

    A point above the yield locus, as scatter may have it, is moved down onto it."""
    normal, shear = point
    shear = min(shear, cohesion + normal * np.tan(phi))
    # (normal - s)^2 + shear^2 = (s sin + c cos)^2 in s, of which the smaller root has the touching point left.
    a = np.cos(phi)**2
    b = normal + cohesion * np.cos(phi) * np.sin(phi)
    c = normal**2 + shear**2 - (cohesion * np.cos(phi))**2
    centre = (b - np.sqrt(max(b * b - a * c, 0.0))) / a
    return float(centre), float(centre * np.sin(phi) + cohesion * np.cos(phi))


def steady_state(strain: Sequence[float], stress: Sequence[float], last: float = 0.3) -> Tuple[float, float]:
    """Mean of the last part of preshear, by strain, and the drift within it: the difference of its two halves
    over the mean."""
    strain, stress = np.asarray(strain, dtype=float), np.asarray(stress, dtype=float)
    some = strain >= strain[-1] - last * (strain[-1] - strain[0])
    tail = stress[some]
    half = len(tail) // 2
    mean = float(tail.mean())
    return mean, float((tail[half:].mean() - tail[:half].mean()) / mean)


def failure(strain: Sequence[float], normal: Sequence[float], shear: Sequence[float],
            window: float = 0.01) -> Tuple[float, float]:
    """Normal and shear stress at the peak of the shear stress, both as mean over a window of strain.

    The window takes out the noise of few particles, of which the highest single value would be a part."""
    strain = np.asarray(strain, dtype=float)
    count = max(1, int(round(window / np.median(np.diff(strain)))))
    kernel = np.full(count, 1.0 / count)
    smooth = np.convolve(shear, kernel, "valid")
    peak = int(np.argmax(smooth))
    return float(np.convolve(normal, kernel, "valid")[peak]), float(smooth[peak])

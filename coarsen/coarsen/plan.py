# SPDX-License-Identifier: GPL-2.0-only
"""Which diameters may be simulated: what each costs, which numbers it has, how wrong it will be."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Dict, List, Mapping, Optional, Sequence

import numpy as np
import pandas as pd

from .evidence import NUMBERS, Prediction, predict
from .dimensionless import Loading, Powder

#: Steps of a geometric series of diameters that are tried when none are named.
SERIES = 8
MOST_PARTICLES = 2.0e7
FEWEST, LAMMPS_MOST = 250, 2**31 - 1


@dataclass(frozen=True)
class Speed:
    """Of LAMMPS on the machine that is planned for: particles times steps in a second of one core, and
    memory of a particle and of a program without any, bytes."""

    particle_steps: float
    particle_bytes: float = 1300.0
    program_bytes: float = 6.0e7

    def __post_init__(self) -> None:
        if not (math.isfinite(self.particle_steps) and self.particle_steps > 0.0):
            raise ValueError(f"speed is {self.particle_steps:g} particle steps a second, allowed are numbers above 0")


@dataclass(frozen=True)
class Line:
    """One diameter of a plan. SI units; core time in s, memory in bytes."""

    diameter: float
    particles: int
    time_step: float
    steps: int
    core_seconds: float
    memory: float
    numbers: Dict[str, float]
    predictions: Dict[str, Prediction]
    #: why it may not be used, empty if it may
    objections: List[str]


def numbers_of(powder: Powder, loading: Loading, diameter: float, scaled_gravity: bool) -> Dict[str, float]:
    """What errors depend on, at a diameter."""
    gravity = loading.gravity * (powder.diameter / diameter if scaled_gravity else 1.0)
    weight = 0.0
    if gravity:  # without attraction it outweighs all
        weight = 1.0 / powder.bond_number(diameter, gravity) if powder.f0 else math.inf
    bed = powder.density * loading.solid_fraction * gravity * loading.height / loading.low
    return {"narrowness": diameter / loading.narrowest, "inertia": loading.inertial_number(diameter, powder.density),
            "overlap": powder.overlap(loading.high, loose=gravity > 0.0), "weight": weight, "bed": bed}


def line(powder: Powder, loading: Loading, diameter: float, wanted: Dict[str, float], table: pd.DataFrame,
         speed: Speed, scaled_gravity: bool, calibrated: Optional[Mapping[str, float]] = None,
         simulated: Optional[Powder] = None) -> Line:
    """:param wanted: error allowed, by quantity
    :param calibrated: relative error that the coefficients leave in quantities, by quantity; none if they are
        taken for exact
    :param simulated: the powder with other stiffnesses, in place of its own
    """
    simulated = simulated or powder
    real = numbers_of(powder, loading, powder.diameter, scaled_gravity)
    coarse = numbers_of(simulated, loading, diameter, scaled_gravity)
    predictions = {quantity: predict(table, quantity, {n: (real[n], coarse[n]) for n in NUMBERS},
                                     _known(calibrated, quantity))
                   for quantity in wanted}
    objections = [reason for p in predictions.values() for reason in p.outside]
    # allowed is the same factor up and down
    objections += [f"{quantity} is off by {100 * p.low:+.1f} to {100 * p.high:+.1f}%, allowed are "
                   f"{100 * (1.0 / (1.0 + wanted[quantity]) - 1.0):+.1f} to {100 * wanted[quantity]:+.1f}%"
                   for quantity, p in predictions.items()
                   if not max(-math.log1p(p.low), math.log1p(p.high)) <= math.log1p(wanted[quantity])]
    count, step = loading.particles(diameter), simulated.time_step(diameter)
    if not FEWEST <= count <= LAMMPS_MOST:
        objections.append(f"{count:.3g} particles, allowed are {FEWEST} (about the fewest of the studies) to {LAMMPS_MOST:.3g} (LAMMPS's "
                          "32-bit IDs)")
    if calibrated is not None:
        objections += [f"what the coefficients leave open in {quantity} is not known" for quantity in wanted
                       if not math.isfinite(calibrated.get(quantity, math.nan))]
    steps = loading.steps(step)
    return Line(diameter, count, step, steps, count * float(steps) / speed.particle_steps,
                speed.program_bytes + count * speed.particle_bytes, coarse, predictions,
                list(dict.fromkeys(objections)))


def _known(calibrated: Optional[Mapping[str, float]], quantity: str) -> float:
    value = (calibrated or {}).get(quantity, 0.0)
    return value if math.isfinite(value) else 0.0  # what is not known is an objection of its own


def series(powder: Powder, loading: Loading) -> List[float]:
    """Diameters from the powder's own, or the finest that a simulation can hold, to a sixth of the width."""
    finest = max(powder.diameter, powder.diameter
                 * (loading.particles(powder.diameter) / MOST_PARTICLES)**(1.0 / 3.0))
    coarsest = max(loading.narrowest / 6.0, finest)
    return sorted({max(float(f"{d:.2g}"), powder.diameter) for d in np.geomspace(finest, coarsest, SERIES)})


def best(lines: Sequence[Line]) -> Optional[Line]:
    """The cheapest without objection."""
    free = [one for one in lines if not one.objections]
    return min(free, key=lambda one: one.core_seconds) if free else None

# SPDX-License-Identifier: GPL-2.0-only
"""The dimensionless numbers of a powder under load, its time step, and what a simulation of it costs.

Why these numbers: with stiffnesses in proportion to d and the pull-off force in proportion to d^2, a
specimen all of whose lengths are multiplied by s has every stress unchanged when times are multiplied by
s, too, and gravity is divided by it; that is exact (to the bit for a factor of two: Scale.ByTwoIsTheSameMotionToTheBit in
tests/lammps/scale.cpp).
What remains of the diameter in a given box, at a given rate and gravity, is in the numbers below.
"""
from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace

#: Part of 0.2 sqrt(m/k), the limit of compute gran/eepa/dt, that the in-files here take.
STEP = 0.95 * 0.2
#: Overlap over p d/k1, mean over the contacts of a dense packing under stress p: 0.43 at an overlap of 0.008, 0.31 at
#: 0.06, as examples/scale_collapse/evidence.py prints; of a bed that grains made themselves, pressed from 0.5 to 10 kPa.
OVERLAP_OF_STRESS, OVERLAP_OF_LOOSE = 0.43, 0.8

#: In SI units: what is beyond is meant in other ones.
PLAUSIBLE = {"diameter": (1.0e-7, 0.1), "reference": (1.0e-7, 0.1), "density": (50.0, 25000.0), "smallest": (0.1, 1.0),
             "width": (1.0e-5, 1.0e3), "length": (1.0e-5, 1.0e3), "height": (1.0e-5, 1.0e3), "solid_fraction": (0.01, 0.99),
             "gravity": (0.0, 5.0e3)}
UNITS = {"diameter": " m", "reference": " m", "density": " kg/m^3", "width": " m", "length": " m", "height": " m",
         "gravity": " m/s^2"}


def _check_plausible(of: object) -> None:
    for field in fields(of):    # type: ignore[arg-type]
        value = getattr(of, field.name)
        least, most = PLAUSIBLE.get(field.name, (-math.inf, math.inf))
        if not least <= value <= most:
            raise ValueError(f"{field.name.replace('_', ' ')} is {value:g}{UNITS.get(field.name, '')}, allowed are {least:g} to {most:g}")


@dataclass(frozen=True)
class Powder:
    """A powder with the coefficients of the law `linear` at a diameter. SI units.

    :param diameter: of the particles, m (of a distribution the volume mean)
    :param reference: diameter that k1, k2, kadh, f0 belong to, m
    :param k1, k2, kadh: stiffnesses, N/m
    :param f0: constant attraction, N, 0 or negative
    :param smallest: smallest diameter over `diameter`
    """

    diameter: float
    density: float
    reference: float
    k1: float
    k2: float
    kadh: float
    f0: float
    smallest: float = 1.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            allowed = ("0 or less" if field.name == "f0" else "0 or more" if field.name == "kadh" else
                       "above 0")
            good = math.isfinite(value) and (value <= 0.0 if field.name == "f0" else
                                             value >= 0.0 if field.name == "kadh" else value > 0.0)
            if not good:
                raise ValueError(f"{field.name} is {value:g}, allowed are numbers {allowed}")
        _check_plausible(self)
        if self.k2 < self.k1:
            raise ValueError(f"k2 is {self.k2:g}, allowed is k1 = {self.k1:g} or more")

    def softened(self, factor: float) -> "Powder":
        """With stiffnesses divided by a factor, which lengthens the time step and deepens overlaps."""
        if not factor >= 1.0:
            raise ValueError(f"stiffnesses are divided by {factor:g}, allowed is 1 or more")
        return replace(self, k1=self.k1 / factor, k2=self.k2 / factor, kadh=self.kadh / factor)

    def scale(self, diameter: float) -> float:
        """s, what stiffnesses are multiplied by at that diameter."""
        return diameter / self.reference

    def mass(self, diameter: float) -> float:
        return self.density * math.pi / 6.0 * diameter**3

    def time_step(self, diameter: float) -> float:
        """With `scale`, s. That of the smallest particles, whose mass falls faster than their stiffness."""
        small = self.smallest * diameter
        stiffest = max(self.k2, self.kadh) * self.scale(small)
        return STEP * math.sqrt(self.mass(small) / stiffest)

    def bond_number(self, diameter: float, gravity: float) -> float:
        """Constant attraction over weight."""
        return self.scale(diameter)**2 * -self.f0 / (self.mass(diameter) * gravity)

    def overlap(self, stress: float, loose: bool = False) -> float:
        """delta/d of the contacts under a stress and their own attraction, about; the same at every diameter.

        :param loose: in a bed that grains made themselves
        """
        pressed = (OVERLAP_OF_LOOSE if loose else OVERLAP_OF_STRESS) * stress * self.reference / self.k1
        return pressed - self.f0 / (self.k1 * self.reference)


@dataclass(frozen=True)
class Loading:
    """What is done with the powder. SI units.

    :param width, length, height: of the specimen or machine, m
    :param solid_fraction: of the packing
    :param low, high: stresses between which results are wanted, Pa
    :param rate: strain rate, 1/s
    :param strain: that is gone through in all
    :param gravity: m/s^2, 0 where it plays no part
    """

    width: float
    length: float
    height: float
    solid_fraction: float
    low: float
    high: float
    rate: float
    strain: float
    gravity: float

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            least = "0 or more" if field.name == "gravity" else "above 0"
            if not (math.isfinite(value) and (value > 0.0 or (value == 0.0 and field.name == "gravity"))):
                raise ValueError(f"{field.name} is {value:g}, allowed are numbers {least}")
        _check_plausible(self)
        if self.low > self.high:
            raise ValueError(f"stresses are {self.low:g} and {self.high:g}, allowed are rising ones")

    @property
    def narrowest(self) -> float:
        """Of width, length and height, m."""
        return min(self.width, self.length, self.height)

    def particles(self, diameter: float) -> int:
        volume = self.width * self.length * self.height * self.solid_fraction
        return round(volume / (math.pi / 6.0 * diameter**3))

    def inertial_number(self, diameter: float, density: float) -> float:
        """At the lowest stress, where it is largest (MiDi, Eur. Phys. J. E 14 (2004) 341)."""
        return self.rate * diameter * math.sqrt(density / self.low)

    def steps(self, time_step: float) -> int:
        return math.ceil(round(self.strain / self.rate / time_step, 6))

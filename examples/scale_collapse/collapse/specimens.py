# SPDX-License-Identifier: GPL-2.0-only
"""Runs of in.confined and in.unconfined: one specimen each, with every variable that it is given.

SI units: m, N/m, N, Pa, 1/s.
"""
from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any, Dict, List, Sequence, Tuple

from .cases import DENSITY, LAWS, fingerprint_of, require_positive

#: Porosity at which a tensile strength is turned into a pull-off force.
POROSITY = 0.4
#: Only for an estimate of the time of a run: strains of packing and of crushing to the end, steps of
#: the bath.
PACKING_STRAIN, CRUSHING_STRAIN, RELAXING_STEPS = 0.06, 0.03, 2000
#: As in.confined has them: s, and parts of the strain rate up to the first level and of crushing.
HOLD, FIRST, CRUSHING = 0.01, 0.4, 0.6
PACKING_STRESS = 4.0e3
#: Of a stress wave through the specimen, while in.unconfined unloads it, at least.
TRANSITS = 14.0


def pull_off_force(tensile_strength: float, diameter: float, porosity: float = POROSITY) -> float:
    """f0 (negative, N) of contacts that give a packing of spheres a tensile strength (Pa), by
    Rumpf's estimate: strength = (1 - n)/n |f0|/d^2 (Chem.-Ing.-Tech. 42 (1970) 538)."""
    require_positive("tensile strength", tensile_strength)
    require_positive("diameter", diameter)
    if not 0.0 < porosity < 1.0:
        raise ValueError(f"porosity is {porosity}, allowed are numbers between 0 and 1")
    return -tensile_strength * diameter**2 * porosity / (1.0 - porosity)


@dataclass(frozen=True)
class Material:
    """Coefficients at the reference diameter, as in.confined takes them; k2 = 2 k1."""

    label: str
    law: str = "linear"
    k1: float = 5.0e3
    kadh: float = 5.0e3
    f0: float = pull_off_force(100.0, 1.0e-3)
    mu: float = 0.5

    def __post_init__(self) -> None:
        if self.law not in LAWS:
            raise ValueError(f"law is {self.law!r}, allowed are {' and '.join(LAWS)}")
        require_positive("k1", self.k1)

    @property
    def k2(self) -> float:
        return 2.0 * self.k1

    def pull_off(self, plastic_overlap: float, size: float) -> float:
        """Largest attraction (N, positive) of a contact with the plastic overlap delta_p (m),
        where its stiffnesses are `size` times those here and f0 is size^2 times.

        `linear`: where the k2 line meets the adhesive branch, -k_adh k2/(k2 + k_adh) delta_p + f0;
        `plateau`: just before the plateau, -k_adh delta_p + f0.
        """
        adhesive = size * self.kadh
        if self.law == "linear":
            adhesive *= self.k2 / (self.k2 + self.kadh)
        return adhesive * plastic_overlap - size**2 * self.f0


@dataclass(frozen=True)
class Confined:
    """Confined compression to every level, held there, unloaded from the last one."""

    material: Material
    diameter: float
    scaled: bool
    seed: int
    levels: Tuple[float, ...]
    reference_diameter: float = 1.0e-3
    #: strain rate, roughly: pressure rises at strain_rate times k1/d
    strain_rate: float = 0.5
    #: width of the specimen and particles of the reference diameter in it
    side: float = 30.0e-3
    reference_particles: int = 32400

    infile = "in.confined"
    needs = None

    def __post_init__(self) -> None:
        for name in ("diameter", "reference_diameter", "strain_rate", "side"):
            require_positive(name.replace("_", " "), getattr(self, name))
        if not self.levels or list(self.levels) != sorted(set(self.levels)):
            raise ValueError(f"levels are {self.levels}, allowed are rising stresses in Pa")
        if not self.levels[0] > PACKING_STRESS:
            raise ValueError(f"the first level is {self.levels[0]:g} Pa, allowed are those above "
                             f"the {PACKING_STRESS:g} Pa of packing")

    @property
    def mode(self) -> str:
        return "scaled" if self.scaled else "unscaled"

    @property
    def name(self) -> str:
        """Also the name of the folder that keeps the run."""
        text = f"{self.material.label}_d{self.diameter * 1e3:.6g}mm_{self.mode}"
        if self.strain_rate != Confined.strain_rate:
            text += f"_rate{self.strain_rate:g}"
        if self.side != Confined.side:
            text += f"_{1e3 * self.side:g}mm_wide"
        return f"{text}_seed{self.seed}_confined"

    @property
    def kind(self) -> Tuple:
        """Runs of a kind take about as many steps."""
        return (self.infile, self.diameter, self.scaled, self.material.label, self.strain_rate,
                self.side)

    @property
    def particles(self) -> int:
        """As LAMMPS rounds, halves up."""
        return math.floor(self.reference_particles
                          * (self.reference_diameter / self.diameter) ** 3 + 0.5)

    @property
    def size(self) -> float:
        """The factor by which the law multiplies stiffnesses."""
        return self.diameter / self.reference_diameter if self.scaled else 1.0

    @property
    def time_step(self) -> float:
        """0.95 of the limit 0.2 sqrt(m/k2), s."""
        mass = DENSITY * math.pi / 6.0 * self.diameter**3
        stiffest = max(self.material.k2, self.material.kadh)
        return 0.19 * math.sqrt(mass / (stiffest * self.size))

    @property
    def pressure_rate(self) -> float:
        """Of loading, Pa/s, as in.confined has it."""
        return self.strain_rate * self.material.k1 * self.size / self.diameter

    @property
    def wave_passage(self) -> float:
        """Time in which a stress wave passes the specimen, s, as in.unconfined has it."""
        grains = self.particles * math.pi / 6.0 * self.diameter**3 / self.side**2
        height = grains / (1.0 - POROSITY)
        stiffness = self.pressure_rate / self.strain_rate
        return math.sqrt(DENSITY * grains * height / stiffness)

    def variables(self) -> List[str]:
        """The -var arguments of LAMMPS."""
        values: Dict[str, Any] = {
            "d": repr(self.diameter), "scaled": "yes" if self.scaled else "no",
            "law": self.material.law, "seed": self.seed, "dref": repr(self.reference_diameter),
            "nref": self.reference_particles, "side": repr(self.side),
            "k1": repr(self.material.k1), "k2": repr(self.material.k2),
            "kadh": repr(self.material.kadh), "f0": repr(self.material.f0),
            "mu": repr(self.material.mu), "rate": repr(self.strain_rate)}
        words = [word for name, value in values.items() for word in ("-var", name, str(value))]
        return words + ["-var", "level", *(level_name(level) for level in self.levels)]

    def expected_steps(self) -> int:
        """Roughly how many steps the run takes, for the time left."""
        size = self.diameter / self.reference_diameter
        mass = DENSITY * math.pi / 6.0 * self.diameter**3
        packing = PACKING_STRAIN * size / (0.19 * math.sqrt(mass / (5.0e3 * size)))
        seconds = (HOLD * (1 + len(self.levels))
                   + (1.5 * self.levels[-1] - self.levels[0]
                      + (self.levels[0] - PACKING_STRESS) / FIRST) / self.pressure_rate)
        return round(RELAXING_STEPS + packing + seconds / self.time_step)

    def fingerprint(self, inputs: Sequence[bytes], ranks: int) -> str:
        """Of everything that the result depends on: a finished run with another one is redone."""
        return fingerprint_of({**asdict(self), "ranks": ranks}, inputs)


@dataclass(frozen=True)
class Unconfined:
    """A specimen unloaded from one of its levels, cut free and crushed."""

    specimen: Confined
    level: float
    #: pictures before and after failure
    images: bool = False

    infile = "in.unconfined"

    def __post_init__(self) -> None:
        if self.level not in self.specimen.levels:
            raise ValueError(f"level is {self.level:g} Pa, allowed are those of the specimen, "
                             f"{', '.join(f'{level:g}' for level in self.specimen.levels)}")

    @property
    def needs(self) -> Confined:
        return self.specimen

    @property
    def state(self) -> str:
        """File of the specimen that the run starts from, without .restart."""
        return f"level_{level_name(self.level)}"

    @property
    def name(self) -> str:
        return (f"{self.specimen.name[:-len('_confined')]}_unconfined"
                f"_{self.level / 1e3:g}kPa")

    @property
    def kind(self) -> Tuple:
        return (*self.specimen.kind, self.infile, self.level)

    @property
    def diameter(self) -> float:
        return self.specimen.diameter

    @property
    def scaled(self) -> bool:
        return self.specimen.scaled

    @property
    def particles(self) -> int:
        return self.specimen.particles

    @property
    def crushing_rate(self) -> float:
        """Strain rate, 1/s."""
        return CRUSHING * self.specimen.strain_rate

    def variables(self) -> List[str]:
        return ["-var", "images", "yes" if self.images else "no"]

    def expected_steps(self) -> int:
        one = self.specimen
        unloading = max(0.5 * self.level / one.pressure_rate, TRANSITS * one.wave_passage)
        seconds = 2.0 * HOLD + unloading + CRUSHING_STRAIN / self.crushing_rate
        return round(seconds / self.specimen.time_step)

    def fingerprint(self, inputs: Sequence[bytes], ranks: int) -> str:
        return fingerprint_of({**asdict(self), "ranks": ranks}, inputs)


def level_name(level: float) -> str:
    """As in the names of in.confined's files."""
    return f"{level:.10g}"

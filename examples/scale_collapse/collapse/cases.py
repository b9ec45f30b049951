# SPDX-License-Identifier: GPL-2.0-only
"""The runs of the study: one case is one specimen, with every variable of in.oedometer."""
from __future__ import annotations

import hashlib
import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, List, Mapping, Sequence, Tuple

LAWS = ("linear", "plateau")
MODES = ("scaled", "unscaled")

# Defaults of in.oedometer that the estimate of steps and the number of particles need.
REFERENCE_PARTICLES = 5000
DENSITY = 2000.0
K1, K2 = 5.0e3, 1.0e4
STRAIN_RATE = 0.5
PACKING_RATE = 1.0
# Duration of a run with default parameters, used only to estimate the time left.
RELAXING_STEPS, PACKING_STRAIN, LOADING_STRAIN, UNLOADING_STRAIN = 2000, 0.052, 0.026, 0.015


@dataclass(frozen=True)
class Case:
    """One LAMMPS run."""

    diameter: float
    scaled: bool
    law: str
    seed: int
    reference_diameter: float = 1.0e-3

    #: file that LAMMPS reads, and the run that must be there first: none
    infile = "in.oedometer"
    needs = None

    def __post_init__(self) -> None:
        require_positive("diameter", self.diameter)
        require_positive("reference diameter", self.reference_diameter)
        if self.law not in LAWS:
            raise ValueError(f"law is {self.law!r}, allowed are {' and '.join(LAWS)}")
        if not 1 <= self.seed < 900000000:
            raise ValueError(f"seed is {self.seed}, allowed are 1 to 899999999")

    @property
    def mode(self) -> str:
        return "scaled" if self.scaled else "unscaled"

    @property
    def name(self) -> str:
        """Also the name of the folder that keeps the run."""
        return f"d{self.diameter * 1e3:.6g}mm_{self.mode}_{self.law}_seed{self.seed}"

    @property
    def kind(self) -> Tuple:
        """Runs of a kind take about as many steps."""
        return self.diameter, self.scaled

    @property
    def particles(self) -> int:
        return round(REFERENCE_PARTICLES * (self.reference_diameter / self.diameter) ** 3)

    def variables(self) -> List[str]:
        """The -var arguments of LAMMPS."""
        values = {
            "d": repr(self.diameter),
            "scaled": "yes" if self.scaled else "no",
            "law": self.law,
            "seed": str(self.seed),
            "dref": repr(self.reference_diameter),
        }
        return [word for name, value in values.items() for word in ("-var", name, value)]

    def expected_steps(self) -> int:
        """Roughly how many steps the run takes, for the time left."""
        size = self.diameter / self.reference_diameter
        mass = DENSITY * math.pi / 6.0 * self.diameter**3
        softer = 1.0 if self.scaled else max(size, 1.0)
        packing = 0.19 * math.sqrt(mass / (K1 * size))
        loading = 0.19 * math.sqrt(mass / (K2 * (size if self.scaled else 1.0)))
        strain = softer * (LOADING_STRAIN + UNLOADING_STRAIN)
        return round(RELAXING_STEPS + PACKING_STRAIN * size / PACKING_RATE / packing
                     + strain / STRAIN_RATE / loading)

    def inertial_number(self, stress: float) -> float:
        """Of the strain rate at an axial stress; a test is quasi-static below about 1e-3."""
        return STRAIN_RATE * self.diameter * math.sqrt(DENSITY / stress)

    def fingerprint(self, inputs: Sequence[bytes], ranks: int) -> str:
        """Of everything that the result depends on: a finished run with another one is redone.

        :param inputs: contents of what else decides on it, such as the in-file
        """
        return fingerprint_of({**asdict(self), "ranks": ranks}, inputs)


def fingerprint_of(parameters: Mapping[str, Any], inputs: Sequence[bytes]) -> str:
    """A digest of parameters and of the contents of files."""
    digest = hashlib.sha256()
    digest.update(json.dumps(parameters, sort_keys=True).encode())
    for content in inputs:
        digest.update(hashlib.sha256(content).digest())
    return digest.hexdigest()


def require_positive(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(f"{name} is {value}, allowed is a number above 0")


def seeds_per_diameter(diameters: Sequence[float], given: Sequence[int]) -> List[int]:
    """Number of seeds of each diameter: as given (one for all, or one each), else more for coarse
    diameters, whose packings scatter more and cost less."""
    for diameter in diameters:
        require_positive("diameter", diameter)
    if not given:
        smallest = min(diameters)
        return [min(8, int(2.0 * (d / smallest) ** 2 + 1e-9)) for d in diameters]
    if any(count < 1 for count in given):
        raise ValueError(f"seeds are {' '.join(map(str, given))}, allowed is 1 or more of each")
    if len(given) == 1:
        return list(given) * len(diameters)
    if len(given) != len(diameters):
        raise ValueError(f"{len(given)} numbers of seeds for {len(diameters)} diameters; allowed "
                         "is one for all or one for each")
    return list(given)


def make_cases(diameters: Sequence[float], seeds: Sequence[int], law: str, modes: Sequence[str],
               reference_diameter: float = 1.0e-3, first_seed: int = 1) -> List[Case]:
    """Every run of the study, the longest first, so that the last to end are short ones.

    At the reference diameter there is nothing to scale, so one run serves both modes.
    """
    if len(set(diameters)) < len(diameters):
        raise ValueError(f"diameters {' '.join(f'{d:g}' for d in diameters)}: one occurs twice")
    cases = []
    for diameter, count in zip(diameters, seeds_per_diameter(diameters, seeds)):
        for mode in modes:
            if mode not in MODES:
                raise ValueError(f"mode is {mode!r}, allowed are {' and '.join(MODES)}")
            for seed in range(first_seed, first_seed + count):
                cases.append(Case(diameter, is_scaled(diameter, mode, reference_diameter), law,
                                  seed, reference_diameter))
    unique = list(dict.fromkeys(cases))
    return sorted(unique, key=lambda case: -case.particles * case.expected_steps())


def is_scaled(diameter: float, mode: str, reference_diameter: float) -> bool:
    """Whether the run that stands for a diameter in a mode is a scaled one."""
    return mode == "scaled" or math.isclose(diameter, reference_diameter)


def folder_of(out: Path, case: Case) -> Path:
    return out / "runs" / case.name

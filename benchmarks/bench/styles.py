# SPDX-License-Identifier: GPL-2.0-only
"""The pair styles that are compared, with coefficients that make their motions alike: the same
normal and tangential stiffness, the same friction, the same damping of a collision."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Dict, List

HOOKE = "gran/hooke/history"
DAMPED = "gran/hooke/history damped"
GRANULAR = "granular"
GRANULAR_DAMPED = "granular damped"


@dataclass(frozen=True)
class Material:
    """Material of a case's spheres, in its units."""

    k1: float
    mu: float
    gamma_n: float          #: F = m* gamma_n v, as gran/hooke/history takes it
    tangential_damping: bool
    mass: float             #: of one sphere
    k2: float
    k_adh: float
    f0: float
    mu_r: float = 0.001
    #: restitution with which gran/hooke/history has as many contacts as with hysteresis; 0: none
    damped_restitution: float = 0.0
    diameter: float = 1.0

    @property
    def restitution(self) -> float:
        """Restitution of the linear spring-dashpot with gamma_n between two of the spheres."""
        half = 0.5 * self.gamma_n
        return math.exp(-math.pi * half / math.sqrt(self.k1 / (0.5 * self.mass) - half * half))


@dataclass(frozen=True)
class Style:
    """One pair style as a user would write it."""

    name: str
    pair_style: str
    pair_coeff: str
    compute: str    #: the class whose compute() is the pair loop

    @property
    def lines(self) -> str:
        return f"pair_style {self.pair_style}\npair_coeff * * {self.pair_coeff}\n"

    def lines_of(self, types: int) -> str:
        """The same for particles of several types, which move alike: their friction differs so little, but by so
        much that no two pairs of types have the same coefficients.

        :raise ValueError: for LAMMPS's own styles
        """
        if types == 1:
            return self.lines
        if not self.is_eepa:
            raise ValueError(f"{self.name}: several types are for gran/eepa alone")
        text = f"pair_style {self.pair_style}\n"
        for k in range(types):
            words = self.pair_coeff.split()
            words[4] = f"{float(words[4]) * (1.0 + 1.0e-9 * k * k):.17g}"
            text += f"pair_coeff {k + 1} {k + 1} {' '.join(words)}\n"
        return text

    @property
    def is_eepa(self) -> bool:
        return self.pair_style.startswith("gran/eepa")


def gamma_of_restitution(restitution: float, k1: float, mass: float) -> float:
    """The gamma_n of gran/hooke/history that gives two equal spheres this restitution."""
    log = math.log(restitution)
    return -2.0 * log / math.hypot(math.pi, log) * math.sqrt(k1 / (0.5 * mass))


def make_styles(m: Material) -> Dict[str, Style]:
    """All styles by name. A flow that hysteresis slows down is denser and has more contacts, which is
    no cost of the pair style; `damped` is one of LAMMPS's styles slowed down by its dashpot instead,
    where the material gives the damping. Variants of gran/eepa: elastic has the physics of
    gran/hooke/history; full adds hysteresis, adhesion, pull-off force and constant rolling friction;
    plateau is full with the other law; sds is full with a rolling spring instead; luding has that law, with a twisting
    spring, too; exponent has forces of overlap^1.5, which are those of full at an overlap of 1% of the diameter."""
    damped = 1 if m.tangential_damping else 0
    full = (f"{m.k1:.9g} {m.k2:.9g} {m.k_adh:.9g} {m.f0:.9g} {m.mu:.9g} "
            f"restitution {m.restitution:.6f}")
    elastic = f"{m.k1:.9g} {m.k1:.9g} 0 0 {m.mu:.9g} restitution {m.restitution:.6f}"
    constant = f"{full} rolling constant {m.mu_r:.9g}"
    # rolling spring and dashpot in proportion to the sliding ones
    sds = (f"{full} rolling sds {0.2 * m.k1:.9g} {0.02 * math.sqrt(m.k1 * m.mass):.9g} "
           f"{10.0 * m.mu_r:.9g}")
    root = math.sqrt(0.01 * m.diameter)
    curved = (f"{m.k1 / root:.9g} {m.k2 / root:.9g} {m.k_adh / root:.9g} {m.f0:.9g} {m.mu:.9g} kt {2.0 / 7.0 * m.k1:.9g} "
              f"restitution {m.restitution:.6f} rolling constant {m.mu_r:.9g}")

    def hooke(name: str, gamma_n: float) -> Style:
        return Style(name, f"gran/hooke/history {m.k1:.9g} NULL {gamma_n:.9g} NULL {m.mu:.9g} "
                           f"{damped}", "", "PairGranHookeHistory")

    def granular(name: str, gamma_n: float) -> Style:
        return Style(name, "granular",
                     f"hooke {m.k1:.9g} {gamma_n:.9g} tangential linear_history "
                     f"{2.0 / 7.0 * m.k1:.17g} {0.5 * damped:g} {m.mu:.9g} damping mass_velocity",
                     "PairGranular")

    styles: List[Style] = [
        hooke(HOOKE, m.gamma_n),
        granular(GRANULAR, m.gamma_n),
        Style("gran/eepa elastic", "gran/eepa linear", elastic, "PairGranEepa"),
        Style("gran/eepa full", "gran/eepa linear", constant, "PairGranEepa"),
        Style("gran/eepa plateau", "gran/eepa plateau", constant, "PairGranEepa"),
        Style("gran/eepa sds", "gran/eepa linear", sds, "PairGranEepa"),
        Style("gran/eepa luding", "gran/eepa luding", f"{sds} depth 0.1 twisting marshall", "PairGranEepa"),
        Style("gran/eepa exponent", "gran/eepa linear exponent 1.5", curved, "PairGranEepa"),
    ]
    if m.damped_restitution:
        gamma_n = gamma_of_restitution(m.damped_restitution, m.k1, m.mass)
        styles[1:2] = [hooke(DAMPED, gamma_n), styles[1], granular(GRANULAR_DAMPED, gamma_n)]
    return {style.name: style for style in styles}

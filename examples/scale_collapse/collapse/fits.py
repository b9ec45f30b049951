# SPDX-License-Identifier: GPL-2.0-only
"""What is fitted to the groups: exponents that are left free, flow function, strength over the
contacts' attraction, wall time."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Dict, List, Optional, Sequence

import numpy as np

from .groups import Group, Key, comparison_stress, curve_at_stress
from .plan import BASE, FACTORS, PULL_OFF, VARIED, Plan, pulled_harder, stickier, stiffer
from .specimens import Material
from .statistics import (Proportion, Value, best_factors, exponent, exponent_from_reference, pooled,
                         proportion, slope, value_of)


@dataclass(frozen=True)
class FlowFunction:
    """Unconfined strength over consolidation stress: means of a group, Pa, and the strength's rise
    per stress, a line for each seed (nothing for a single level)."""

    levels: List[float]
    strengths: List[Value]
    slope: Optional[Value]


def flow_function(group: Group) -> FlowFunction:
    levels = sorted(group.unconfined)
    slopes = []
    for seed in group.confined:
        some = [(level, group.unconfined[level][seed].strength) for level in levels
                if seed in group.unconfined[level]]
        if len(some) > 1:
            slopes.append(slope(*np.transpose(some)).value)
    return FlowFunction(levels, [group.strength(level) for level in levels],
                        value_of(slopes) if slopes else None)


@dataclass(frozen=True)
class StrengthPoint:
    """sigma_u d^2/f_at against Z (1 - porosity): Thakur et al., Granular Matter 16 (2014) 383."""

    material: str
    #: whether attraction grows with plastic overlap; else all contacts have the same
    plastic: bool
    mode: str
    diameter: float
    level: float
    packing: Value
    reduced_strength: Value


def strength_points(groups: Dict[Key, Group]) -> List[StrengthPoint]:
    """Of the specimens that are compared with each other, without those of the fits. Those of a
    group are of the same packings, so that the error of a fit through all points is rather too
    small."""
    return [StrengthPoint(
        group.material.label, group.material.kadh > 0.0, group.mode, group.diameter, level,
        value_of([r.coordination * (1.0 - r.porosity) for r in group.crushed(level)]),
        value_of([r.strength * group.diameter**2 / r.pull_off for r in group.crushed(level)]))
        for group in groups.values() if not group.special and group.material not in VARIED
        for level in sorted(group.unconfined)]


def proportion_of(points: Sequence[StrengthPoint]) -> Proportion:
    """Of points that are all plastic, or none of them."""
    return proportion([p.packing.value for p in points],
                      [p.reduced_strength.value for p in points])


@dataclass(frozen=True)
class FreeExponent:
    """The exponent of a coefficient against d that fits the finest particles best, when it alone
    is free: of each diameter the best factor on top of the law's scaling, and the fit."""

    what: str
    expected: float
    response: str
    reference_diameter: float
    diameters: List[float]
    #: log of the coefficient over that at the reference diameter
    logs: List[Value]
    exponent: Value
    #: whether a best factor lies beyond those that were run
    extrapolated: bool


#: Of a group by seed.
Response = Callable[[Group], Dict[int, float]]


def free_exponents(groups: Dict[Key, Group], plan: Plan) -> List[FreeExponent]:
    """Stiffness from the strain near the last level, adhesive stiffness and pull-off force each
    from the strength after it, of a material whose strength it carries. A fit that lacks runs is
    left out."""
    last = plan.levels[-1]

    def strain(group: Group) -> Dict[int, float]:
        return {seed: curve_at_stress(result.curve, "bulk", comparison_stress(plan))
                for seed, result in group.confined.items()}

    def strength(group: Group) -> Dict[int, float]:
        return {seed: r.strength for seed, r in group.unconfined.get(last, {}).items()}

    after = "unconfined strength after the last level"
    finest = plan.diameters[0]
    found = [_free_exponent(groups, plan, *given) for given in (
        ("stiffness", 1.0, BASE, stiffer, strain, "strain near the last level", finest),
        ("k_adh", 1.0, BASE, stickier, strength, after, finest),
        ("f0", 2.0, PULL_OFF, pulled_harder, strength, after, plan.pull_off_reference))]
    return [one for one in found if one]


def _free_exponent(groups: Dict[Key, Group], plan: Plan, what: str, expected: float,
                   material: Material, vary: Callable[[Material, float], Material],
                   response: Response, text: str, finest: float) -> Optional[FreeExponent]:
    def of(some: Material, diameter: float) -> Dict[int, float]:
        group = groups.get((some.label, "scaled", diameter, ""))
        return response(group) if group else {}

    wanted = of(material, finest)
    if not wanted:
        return None
    target = value_of(list(wanted.values()))
    factors = sorted((1.0, *FACTORS))
    diameters, best, slopes = [], [], []
    for diameter in (d for d in plan.fitted if d > finest):
        series = [of(material if f == 1.0 else vary(material, f), diameter) for f in factors]
        # The runs of a seed start from one packing, so that they are not independent.
        seeds = set(series[0]).intersection(*series[1:])
        if seeds:
            found, line = best_factors(factors, [[some[seed] for some in series]
                                                 for seed in sorted(seeds)], target.value)
            diameters.append(diameter)
            best.append(value_of(found))
            slopes.append(abs(line))
    if not best:
        return None
    beyond = any(not min(factors) <= np.exp(v.value) <= max(factors) for v in best)
    logs = [Value(v.value + expected * np.log(d / finest), v.error)
            for v, d in zip(pooled(best), diameters)]
    common = target.error / target.value / float(np.mean(slopes))
    fit = exponent_from_reference([d / finest for d in diameters], [v.value for v in logs],
                                  [v.error for v in logs], common)
    return FreeExponent(what, expected, text, finest, diameters, logs, fit, beyond)


def speed_exponent(groups: Dict[Key, Group], mode: str) -> Optional[Value]:
    """b of processor time of the confined test proportional to d^-b over the diameters of the base
    material; the finest, scaled one belongs to both modes."""
    usual = [g for g in groups.values() if g.material == BASE and not g.special]
    scaled = [g for g in usual if g.mode == "scaled"]
    if not scaled:
        return None
    finest = min(scaled, key=lambda g: g.diameter)
    some = [finest] + [g for g in usual if g.mode == mode and g is not finest]
    if len({g.diameter for g in some}) < 2:
        return None
    fit = exponent([g.diameter for g in some],
                   [np.mean(g.cost(lambda c: c.test_seconds)) for g in some])
    return Value(-fit.value, fit.error)

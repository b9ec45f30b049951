# SPDX-License-Identifier: GPL-2.0-only
"""Fits to the groups: exponents of the coefficients, flow function, strength over the contacts'
attraction, wall time."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Dict, List, Optional, Sequence

import numpy as np

from .groups import Group, Key, comparison_stress, curve_at_stress, equally_wide
from .plan import BASE, FACTORS, PULL_OFF, VARIED, Plan, pulled_harder, stickier, stiffer
from .specimens import Confined, Material
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
    #: whether the finest particles are in specimens as many diameters wide and high as the coarse
    #: ones, so that an effect of the specimen's size is in both; else all specimens are as wide
    equal_width: bool
    diameters: List[float]
    #: log of the coefficient over that at the reference diameter
    logs: List[Value]
    exponent: Value
    #: whether a best factor lies beyond those that were run
    extrapolated: bool


@dataclass(frozen=True)
class _Free:
    """A coefficient that is left free, of the material that it is varied in, and what it is to be
    fitted to (of a group by seed)."""

    what: str
    expected: float
    material: Material
    vary: Callable[[Material, float], Material]
    response: Callable[[Group], Dict[int, float]]
    text: str
    finest: float


def free_exponents(groups: Dict[Key, Group], plan: Plan) -> List[FreeExponent]:
    """Stiffness from the strain near the last level, adhesive stiffness and pull-off force each
    from the strength after it, of a material whose strength it carries. A diameter that lacks runs
    is left out, and a fit without any."""
    last = plan.levels[-1]

    def strain(group: Group) -> Dict[int, float]:
        return {seed: curve_at_stress(result.curve, "bulk", comparison_stress(plan))
                for seed, result in group.confined.items()}

    def strength(group: Group) -> Dict[int, float]:
        return {seed: r.strength for seed, r in group.unconfined.get(last, {}).items()}

    after = "unconfined strength after the last level"
    finest = plan.diameters[0]
    found = [_free_exponent(groups, plan, free, equal_width) for free in (
        _Free("stiffness", 1.0, BASE, stiffer, strain, "strain near the last level", finest),
        _Free("k_adh", 1.0, BASE, stickier, strength, after, finest),
        _Free("f0", 2.0, PULL_OFF, pulled_harder, strength, after, plan.pull_off_reference))
        for equal_width in (False, True)]
    return [one for one in found if one]


def _free_exponent(groups: Dict[Key, Group], plan: Plan, free: _Free,
                   equal_width: bool) -> Optional[FreeExponent]:
    def of(material: Material, diameter: float) -> Dict[int, float]:
        group = groups.get((material.label, "scaled", diameter, ""))
        return free.response(group) if group else {}

    def twins(diameter: float) -> Dict[int, float]:
        """Of the finest particles in specimens as many diameters wide and high as those of a
        diameter: from the same seed packings that are the same but for their size."""
        coarse = groups.get((free.material.label, "scaled", diameter, ""))
        similar = next((g for g in groups.values() if coarse and g.material == free.material
                        and g.mode == "scaled" and g.diameter == free.finest
                        and g.strain_rate == Confined.strain_rate and equally_wide(g, coarse)),
                       None)
        return free.response(similar) if similar else {}

    factors = sorted((1.0, *FACTORS))
    diameters, best, common = [], [], []
    for diameter in (d for d in plan.fitted if d > free.finest):
        wanted = twins(diameter) if equal_width else of(free.material, free.finest)
        series = [of(free.material if f == 1.0 else free.vary(free.material, f), diameter)
                  for f in factors]
        # The runs of a seed start from one packing, so that they are not independent.
        seeds = set(series[0]).intersection(*series[1:], *([wanted] if equal_width else []))
        if not seeds or not wanted:
            continue
        mean = value_of(list(wanted.values()))
        target = [wanted[seed] for seed in sorted(seeds)] if equal_width else mean.value
        found, line = best_factors(
            factors, [[some[seed] for some in series] for seed in sorted(seeds)], target)
        diameters.append(diameter)
        best.append(value_of(found))
        if not equal_width:  # one reference for all diameters
            common.append(mean.error / mean.value / abs(line))
    if not best:
        return None
    beyond = any(not min(factors) <= np.exp(v.value) <= max(factors) for v in best)
    sizes = [d / free.finest for d in diameters]
    logs = [Value(v.value + free.expected * np.log(size), v.error)
            for v, size in zip(pooled(best), sizes)]
    fit = exponent_from_reference(sizes, [v.value for v in logs], [v.error for v in logs],
                                  float(np.mean(common)) if common else 0.0)
    return FreeExponent(free.what, free.expected, free.text, free.finest, equal_width, diameters,
                        logs, fit, beyond)


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

# SPDX-License-Identifier: GPL-2.0-only
"""From groups of results to means over seeds and deviations from the finest particles."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Dict, List, Optional

import numpy as np

from . import curves as cv
from .groups import (Group, Key, at_stress, comparison_stress, crush_deviation,
                     curve_at_stress, equally_wide, references, speed_up)
from .plan import BASE, Plan
from .specimens import Confined
from .statistics import (Value, paired_percent, ratio_percent, scatter_percent,
                         value_of)


@dataclass(frozen=True)
class Row:
    """One group compared with its reference (groups.references). Deviations in % with their standard
    error; not a number where they have no meaning or no reference."""

    material: str
    mode: str
    special: str
    strain_rate: float
    diameter_mm: float
    width_mm: float
    reference_mm: float
    particles: int
    #: packings, those of them that were crushed after the last level, and runs of crushing, after
    #: whatever level, that did not fail
    seeds: int
    crushed: int
    not_failed: int
    inertial_number: float
    crush_inertial_number: float
    loading_deviation: Value
    loading_mean_deviation: float
    loading_scatter: float
    unloading_deviation: Value
    porosity: Value
    porosity_deviation: Value
    coordination: Value
    coordination_deviation: Value
    bulk_coordination: Value
    bulk_coordination_deviation: Value
    #: change of the coordination number when the sides are cut free, after the last level
    cut_coordination: Value
    strain: Value
    constrained_modulus: Value
    bulk_modulus: Value
    bulk_modulus_deviation: Value
    lateral_ratio: Value
    strength: Dict[float, Value]
    strength_deviation: Dict[float, Value]
    crush_deviation: Dict[float, Value]
    #: first those of the confined test alone, then those of the whole run with the making of the specimen
    steps: float
    seconds: float
    speed_up: Value
    whole_steps: float
    whole_seconds: float
    whole_speed_up: Value
    #: (d/d of the finest)^4, as particles and steps of scaled specimens alone would have it
    expected_speed_up: float

    @property
    def usual(self) -> bool:
        return not self.special


NOTHING = Value(float("nan"), float("nan"))


def make_rows(groups: Dict[Key, Group], plan: Plan) -> List[Row]:
    compared = references(groups, plan)
    return [_row(group, compared[key], comparison_stress(plan), plan.levels[-1])
            for key, group in groups.items()]


def _row(group: Group, reference: Optional[Group], stress: float, last: float) -> Row:
    paired = group.strain_rate != Confined.strain_rate
    if paired and reference:
        group = group.only(list(reference.confined))
    other = None if reference is group else reference
    if other:
        loading = paired_loading(group, other) if paired else cv.loading_deviation(
            group.curves, other.curves, "bulk")
        unloading = cv.unloading_deviation(group.curves, other.curves, "bulk")
    up_to = cv.common_strain([group.curves], "bulk")
    crushed = [level for level in sorted(group.unconfined) if other and level in other.unconfined]
    results = [r for some in group.unconfined.values() for r in some.values()]

    def apart(get: Callable[[Group], Value]) -> Value:
        return ratio_percent(get(group), get(other)) if other else NOTHING

    def at(quantity: str) -> Callable[[Group], Value]:
        return lambda some: at_stress(some, quantity, stress)

    return Row(
        material=group.material.label, mode=group.mode, special=group.special,
        strain_rate=group.strain_rate, diameter_mm=1e3 * group.diameter,
        width_mm=1e3 * group.side,
        reference_mm=1e3 * reference.diameter if reference else float("nan"),
        particles=group.particles, seeds=len(group.confined),
        crushed=len(group.unconfined.get(last, {})),
        not_failed=sum(not r.failed for r in results),
        inertial_number=max(r.inertial_number for r in group.confined.values()),
        crush_inertial_number=max((r.inertial_number for r in results), default=float("nan")),
        loading_deviation=_value(loading) if other else NOTHING,
        loading_mean_deviation=loading.mean_percent if other else float("nan"),
        loading_scatter=scatter_percent(cv.mean_stress(group.curves, "bulk", up_to)),
        unloading_deviation=_value(unloading) if other else NOTHING,
        porosity=at("bulk_porosity")(group), porosity_deviation=apart(at("bulk_porosity")),
        coordination=at("coordination")(group),
        coordination_deviation=apart(at("coordination")),
        bulk_coordination=at("bulk_coordination")(group),
        bulk_coordination_deviation=apart(at("bulk_coordination")),
        cut_coordination=(value_of([100.0 * (r.coordination / r.uncut_coordination - 1.0)
                                    for r in group.crushed(last)])
                          if last in group.unconfined else NOTHING),
        strain=at("bulk")(group),
        constrained_modulus=_moduli(group, "constrained"), bulk_modulus=_moduli(group, "bulk"),
        bulk_modulus_deviation=apart(lambda some: _moduli(some, "bulk")),
        lateral_ratio=_moduli(group, "lateral_ratio"),
        strength={level: group.strength(level) for level in sorted(group.unconfined)},
        strength_deviation={level: (paired_strength(group, other, level) if paired else
                                    ratio_percent(group.strength(level), other.strength(level)))
                            for level in crushed},
        crush_deviation={level: _value(crush_deviation(group.crushed(level), other.crushed(level)))
                         for level in crushed},
        steps=float(np.mean(group.cost(lambda c: c.test_steps))),
        seconds=float(np.mean(group.cost(lambda c: c.test_seconds))),
        speed_up=speed_up(group, other, lambda c: c.test_seconds) if other else NOTHING,
        whole_steps=float(np.mean(group.cost(lambda c: c.steps))),
        whole_seconds=float(np.mean(group.cost(lambda c: c.seconds))),
        whole_speed_up=speed_up(group, other, lambda c: c.seconds) if other else NOTHING,
        expected_speed_up=((group.diameter / other.diameter) ** 4 if other and not group.special
                           else float("nan")))


def _value(found: cv.Deviation) -> Value:
    return Value(found.percent, found.standard_error)


def _moduli(group: Group, name: str) -> Value:
    return value_of([getattr(r.moduli, name) for r in group.confined.values()])


def paired_loading(group: Group, reference: Group) -> cv.Deviation:
    """Deviation of the loading curve, seed by seed: both tests have the same packings."""
    pairs = [(group.confined[seed].curve, reference.confined[seed].curve)
             for seed in group.confined if seed in reference.confined]
    grid = np.linspace(0.0, cv.common_strain(list(zip(*pairs)), "bulk"), cv.GRID_POINTS)
    return cv.paired_deviation([tuple(
        cv.interpolate(grid, one.loading.strain["bulk"], one.loading.stress) for one in pair)
        for pair in pairs], grid)


def paired_strength(group: Group, reference: Group, level: float) -> Value:
    return paired_percent(*({seed: r.strength for seed, r in some.unconfined[level].items()}
                            for some in (group, reference)))


@dataclass(frozen=True)
class Similar:
    """Coarse particles compared with as many finer ones, in a specimen of equal width and height in
    diameters: differences are due to the law and inertia, not to the specimen. Packings of one seed
    differ in size only, so they are compared seed by seed."""

    diameter_mm: float
    width_mm: float
    fine_mm: float
    fine_width_mm: float
    seeds: int
    loading_deviation: Value
    coordination_deviation: Value
    strength_deviation: Dict[float, Value]


def similar_specimens(groups: Dict[Key, Group], plan: Plan) -> List[Similar]:
    base = [g for g in groups.values() if g.material == BASE and g.mode == "scaled"
            and g.strain_rate == Confined.strain_rate]
    return [_similar(coarse, fine, comparison_stress(plan))
            for fine in base for coarse in base if coarse.diameter > fine.diameter
            and equally_wide(coarse, fine) and coarse.particles == fine.particles
            and set(coarse.confined) & set(fine.confined)]


def _similar(coarse: Group, fine: Group, stress: float) -> Similar:
    both = (coarse, fine)
    coordination = [{seed: curve_at_stress(result.curve, "coordination", stress)
                     for seed, result in some.confined.items()} for some in both]
    return Similar(
        1e3 * coarse.diameter, 1e3 * coarse.side, 1e3 * fine.diameter, 1e3 * fine.side,
        len(set(coarse.confined) & set(fine.confined)), _value(paired_loading(coarse, fine)),
        paired_percent(*coordination),
        {level: paired_strength(coarse, fine, level) for level in sorted(coarse.unconfined)
         if set(coarse.unconfined[level]) & set(fine.unconfined.get(level, {}))})

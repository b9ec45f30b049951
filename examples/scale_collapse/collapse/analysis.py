# SPDX-License-Identifier: GPL-2.0-only
"""From groups of results to means over seeds and deviations from the finest particles."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, List

import numpy as np

from . import curves as cv
from .groups import (Group, Key, at_stress, comparison_stress, crush_deviation, reference_of,
                     speed_up)
from .plan import BASE, Plan
from .specimens import Confined
from .statistics import (Value, paired_percent, ratio_percent, scatter_percent,
                         value_of)


@dataclass(frozen=True)
class Row:
    """One group beside what it is compared with (reference_of). Deviations in % with their
    standard error; an empty field has no meaning there."""

    material: str
    mode: str
    special: str
    strain_rate: float
    diameter_mm: float
    width_mm: float
    reference_mm: float
    particles: int
    seeds: int
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
    #: of the confined test alone, and of the whole run with the making of the specimen
    steps: float
    seconds: float
    speed_up: Value
    whole_steps: float
    whole_seconds: float
    whole_speed_up: Value
    #: (d/d of the finest)^4, as particles and steps alone would have it
    expected_speed_up: float

    @property
    def usual(self) -> bool:
        return not self.special


NOTHING = Value(float("nan"), float("nan"))


def make_rows(groups: Dict[Key, Group], plan: Plan) -> List[Row]:
    stress = comparison_stress(plan)
    return [_row(group, reference_of(groups, group), stress, plan.levels[-1])
            for group in groups.values()]


def _row(group: Group, reference: Group, stress: float, last: float) -> Row:
    itself = group is reference
    paired = group.strain_rate != Confined.strain_rate and not itself

    def apart(quantity: str) -> Value:
        return NOTHING if itself else ratio_percent(at_stress(group, quantity, stress),
                                                    at_stress(reference, quantity, stress))

    loading = paired_loading(group, reference) if paired else cv.loading_deviation(
        group.curves, reference.curves, "bulk")
    unloading = cv.unloading_deviation(group.curves, reference.curves, "bulk")
    up_to = cv.common_strain([group.curves], "bulk")
    crushed = [] if itself else [level for level in sorted(group.unconfined)
                                 if level in reference.unconfined]
    results = [r for some in group.unconfined.values() for r in some.values()]
    return Row(
        material=group.material.label, mode=group.mode, special=group.special,
        strain_rate=group.strain_rate, diameter_mm=1e3 * group.diameter,
        width_mm=1e3 * group.side, reference_mm=1e3 * reference.diameter,
        particles=group.particles, seeds=len(group.confined),
        inertial_number=max(r.inertial_number for r in group.confined.values()),
        crush_inertial_number=max((r.inertial_number for r in results), default=float("nan")),
        loading_deviation=_value(loading, itself),
        loading_mean_deviation=float("nan") if itself else loading.mean_percent,
        loading_scatter=scatter_percent(cv.mean_stress(group.curves, "bulk", up_to)),
        unloading_deviation=_value(unloading, itself),
        porosity=at_stress(group, "bulk_porosity", stress),
        porosity_deviation=apart("bulk_porosity"),
        coordination=at_stress(group, "coordination", stress),
        coordination_deviation=apart("coordination"),
        bulk_coordination=at_stress(group, "bulk_coordination", stress),
        bulk_coordination_deviation=apart("bulk_coordination"),
        cut_coordination=(value_of([100.0 * (r.coordination / r.uncut_coordination - 1.0)
                                    for r in group.crushed(last)])
                          if last in group.unconfined else NOTHING),
        strain=at_stress(group, "bulk", stress),
        constrained_modulus=_moduli(group, "constrained"),
        bulk_modulus=_moduli(group, "bulk"),
        bulk_modulus_deviation=(NOTHING if itself else ratio_percent(
            _moduli(group, "bulk"), _moduli(reference, "bulk"))),
        lateral_ratio=_moduli(group, "lateral_ratio"),
        strength={level: group.strength(level) for level in sorted(group.unconfined)},
        strength_deviation={level: (paired_strength(group, reference, level) if paired else
                                    ratio_percent(group.strength(level),
                                                  reference.strength(level)))
                            for level in crushed},
        crush_deviation={level: _value(crush_deviation(group.crushed(level),
                                                       reference.crushed(level)), False)
                         for level in crushed},
        steps=float(np.mean(group.cost(lambda c: c.test_steps))),
        seconds=float(np.mean(group.cost(lambda c: c.test_seconds))),
        speed_up=speed_up(group, reference, lambda c: c.test_seconds),
        whole_steps=float(np.mean(group.cost(lambda c: c.steps))),
        whole_seconds=float(np.mean(group.cost(lambda c: c.seconds))),
        whole_speed_up=speed_up(group, reference, lambda c: c.seconds),
        expected_speed_up=(group.diameter / reference.diameter) ** 4)


def _value(found: cv.Deviation, itself: bool) -> Value:
    return NOTHING if itself else Value(found.percent, found.standard_error)


def _moduli(group: Group, name: str) -> Value:
    return value_of([getattr(r.moduli, name) for r in group.confined.values()])


def paired_loading(group: Group, reference: Group) -> cv.Deviation:
    """Of the loading curve, seed by seed: both tests are of the same packings."""
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
    """Coarse particles beside as many finer ones in a specimen as many diameters wide and high: what
    is left between them is the law's and inertia's, not the specimen's."""

    diameter_mm: float
    width_mm: float
    fine_mm: float
    fine_width_mm: float
    seeds: int
    fine_seeds: int
    loading_deviation: Value
    coordination_deviation: Value
    strength_deviation: Dict[float, Value]


def similar_specimens(groups: Dict[Key, Group], plan: Plan) -> List[Similar]:
    base = [g for g in groups.values() if g.material == BASE and g.mode == "scaled"
            and g.strain_rate == Confined.strain_rate]
    return [_similar(coarse, fine, comparison_stress(plan))
            for fine in base if fine.special
            for coarse in base if not coarse.special and coarse.diameter > fine.diameter
            and np.isclose(coarse.side / coarse.diameter, fine.side / fine.diameter)
            and coarse.particles == fine.particles]


def _similar(coarse: Group, fine: Group, stress: float) -> Similar:
    return Similar(
        1e3 * coarse.diameter, 1e3 * coarse.side, 1e3 * fine.diameter, 1e3 * fine.side,
        len(coarse.confined), len(fine.confined),
        _value(cv.loading_deviation(coarse.curves, fine.curves, "bulk"), False),
        ratio_percent(at_stress(coarse, "coordination", stress),
                      at_stress(fine, "coordination", stress)),
        {level: ratio_percent(coarse.strength(level), fine.strength(level))
         for level in sorted(coarse.unconfined) if level in fine.unconfined})

# SPDX-License-Identifier: GPL-2.0-only
"""From the results of every run to means over seeds, deviations from the finest particles and
fits. A group is every seed of one material, diameter, mode and strain rate."""
from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np

from . import curves as cv
from .cases import folder_of
from .measured import ConfinedResult, UnconfinedResult, load_confined, load_unconfined
from .plan import BASE, FACTORS, Plan, stickier, stiffer
from .specimens import Confined, Material
from .statistics import (Proportion, Value, best_factor, exponent, exponent_from_reference,
                         proportion, ratio_percent, scatter_percent, value_of)

PRELOAD = 5.0e3
Key = Tuple[str, str, float, float]


@dataclass
class Group:
    material: Material
    diameter: float
    mode: str
    strain_rate: float
    confined: List[ConfinedResult] = field(default_factory=list)
    unconfined: Dict[float, List[UnconfinedResult]] = field(default_factory=dict)

    @property
    def curves(self) -> List[cv.Curve]:
        return [result.curve for result in self.confined]

    def strength(self, level: float) -> Value:
        return value_of([result.strength for result in self.unconfined[level]])

    def cost(self, what: str) -> float:
        """Of one confined run, mean over seeds: a field of Cost."""
        return float(np.mean([getattr(result.cost, what) for result in self.confined]))

    @property
    def particles(self) -> int:
        return self.confined[0].cost.particles


def group_results(plan: Plan, out: Path) -> Dict[Key, Group]:
    """Every finished run of the plan, read from its folder."""
    groups: Dict[Key, Group] = {}
    for run in plan.runs:
        specimen = run if isinstance(run, Confined) else run.specimen
        key = (specimen.material.label, specimen.mode, specimen.diameter, specimen.strain_rate)
        group = groups.setdefault(key, Group(specimen.material, specimen.diameter, specimen.mode,
                                             specimen.strain_rate))
        folder = folder_of(out, run)
        if isinstance(run, Confined):
            group.confined.append(load_confined(folder, run, PRELOAD))
        else:
            group.unconfined.setdefault(run.level, []).append(load_unconfined(folder, run))
    return groups


@dataclass(frozen=True)
class Row:
    """One group beside the finest particles of its material, which are scaled (at the reference
    diameter there is nothing to scale). Deviations in % with their standard error; an empty field
    has no meaning there."""

    material: str
    mode: str
    strain_rate: float
    diameter_mm: float
    particles: int
    seeds: int
    inertial_number: float
    loading_deviation: Value
    loading_scatter: float
    unloading_deviation: Value
    porosity: Value
    coordination: Value
    coordination_deviation: Value
    strain: Value
    constrained_modulus: Value
    bulk_modulus: Value
    bulk_modulus_deviation: Value
    lateral_ratio: Value
    strength: Dict[float, Value]
    strength_deviation: Dict[float, Value]
    #: of the confined test alone, and of the whole run with the making of the specimen
    steps: float
    seconds: float
    speed_up: float
    whole_steps: float
    whole_seconds: float
    whole_speed_up: float
    #: (d/d of the finest)^4, as particles and steps alone would have it
    expected_speed_up: float


NOTHING = Value(float("nan"), float("nan"))


def reference_of(groups: Dict[Key, Group], group: Group) -> Group:
    """The finest of the same material, scaled, at the usual strain rate. Of runs at another rate
    it is the very same packings at the usual one."""
    usual = [g for g in groups.values() if g.material == group.material
             and g.strain_rate == Confined.strain_rate]
    if group.strain_rate == Confined.strain_rate:
        return min((g for g in usual if g.mode == "scaled"), default=group,
                   key=lambda g: g.diameter)
    same = next((g for g in usual if (g.diameter, g.mode) == (group.diameter, group.mode)), group)
    # Seeds are read in rising order from 1.
    count = len(group.confined)
    return replace(same, confined=same.confined[:count],
                   unconfined={level: results[:count]
                               for level, results in same.unconfined.items()})


def comparison_stress(plan: Plan) -> float:
    """Where groups are compared at equal stress, Pa: below the last level, for the platen lags and
    samples come at intervals."""
    return 0.9 * plan.levels[-1]


def make_rows(groups: Dict[Key, Group], plan: Plan) -> List[Row]:
    stress = comparison_stress(plan)
    return [_row(group, reference_of(groups, group), stress) for group in groups.values()]


def at_stress(group: Group, quantity: str, stress: float) -> Value:
    """A quantity of the loading branch, or `bulk` strain."""
    def values(branch: cv.Branch) -> np.ndarray:
        return branch.strain[quantity] if quantity in cv.STRAINS else getattr(branch, quantity)
    return value_of([float(cv.interpolate(np.array([stress]), c.loading.stress,
                                          values(c.loading))[0]) for c in group.curves])


def _row(group: Group, reference: Group, stress: float) -> Row:
    itself = group is reference
    loading = cv.loading_deviation(group.curves, reference.curves, "bulk")
    unloading = cv.unloading_deviation(group.curves, reference.curves, "bulk")
    up_to = cv.common_strain([group.curves], "bulk")
    coordination = at_stress(group, "coordination", stress)
    bulk = value_of([r.moduli.bulk for r in group.confined])
    strength = {level: group.strength(level) for level in group.unconfined}
    return Row(
        material=group.material.label, mode=group.mode, strain_rate=group.strain_rate,
        diameter_mm=1e3 * group.diameter, particles=group.particles, seeds=len(group.confined),
        inertial_number=max(r.inertial_number for r in group.confined),
        loading_deviation=NOTHING if itself else Value(loading.percent, loading.standard_error),
        loading_scatter=scatter_percent(cv.mean_stress(group.curves, "bulk", up_to)),
        unloading_deviation=(NOTHING if itself
                             else Value(unloading.percent, unloading.standard_error)),
        porosity=at_stress(group, "bulk_porosity", stress), coordination=coordination,
        coordination_deviation=(NOTHING if itself else
                                ratio_percent(coordination, at_stress(reference, "coordination",
                                                                      stress))),
        strain=at_stress(group, "bulk", stress),
        constrained_modulus=value_of([r.moduli.constrained for r in group.confined]),
        bulk_modulus=bulk,
        bulk_modulus_deviation=(NOTHING if itself else ratio_percent(bulk, value_of(
            [r.moduli.bulk for r in reference.confined]))),
        lateral_ratio=value_of([r.moduli.lateral_ratio for r in group.confined]),
        strength=strength,
        strength_deviation={level: ratio_percent(value, reference.strength(level))
                            for level, value in strength.items()
                            if not itself and level in reference.unconfined},
        steps=group.cost("test_steps"), seconds=group.cost("test_seconds"),
        speed_up=reference.cost("test_seconds") / group.cost("test_seconds"),
        whole_steps=group.cost("steps"), whole_seconds=group.cost("seconds"),
        whole_speed_up=reference.cost("seconds") / group.cost("seconds"),
        expected_speed_up=(group.diameter / reference.diameter) ** 4)


def mean_crush(results: Sequence[UnconfinedResult]) -> cv.Mean:
    """Stress over strain of crushing, to the strain that every seed reaches."""
    first = max(r.strain.min() for r in results)
    grid = np.linspace(first, min(r.strain.max() for r in results), cv.GRID_POINTS)
    return cv.mean_of(grid, [cv.interpolate(grid, r.strain, r.stress) for r in results])


@dataclass(frozen=True)
class FlowFunction:
    """Unconfined strength over consolidation stress: means of a group, Pa, and the strength's
    rise per stress (nothing for a single level)."""

    levels: List[float]
    strengths: List[Value]
    slope: Optional[float]


def flow_function(group: Group) -> FlowFunction:
    levels = sorted(group.unconfined)
    strengths = [group.strength(level) for level in levels]
    rise = (float(np.polyfit(levels, [s.value for s in strengths], 1)[0]) if len(levels) > 1
            else None)
    return FlowFunction(levels, strengths, rise)


@dataclass(frozen=True)
class StrengthPoint:
    """sigma_u d^2/f_at against Z (1 - porosity): Thakur et al., Granular Matter 16 (2014) 383."""

    material: str
    mode: str
    diameter: float
    level: float
    packing: Value
    reduced_strength: Value


def strength_points(groups: Dict[Key, Group]) -> List[StrengthPoint]:
    points = []
    for group in groups.values():
        for level, results in sorted(group.unconfined.items()):
            points.append(StrengthPoint(
                group.material.label, group.mode, group.diameter, level,
                value_of([r.coordination * (1.0 - r.porosity) for r in results]),
                value_of([r.strength * group.diameter**2 / r.pull_off for r in results])))
    return points


def proportion_of(points: Sequence[StrengthPoint]) -> Proportion:
    return proportion([p.packing.value for p in points],
                      [p.reduced_strength.value for p in points])


@dataclass(frozen=True)
class FreeExponent:
    """The exponent of a coefficient against d that fits the finest particles best, when it alone
    is free: of each diameter the best factor on top of the law's scaling, and the fit."""

    what: str
    expected: float
    response: str
    diameters: List[float]
    #: log of the coefficient over that at the finest diameter
    logs: List[Value]
    exponent: Value


def free_exponents(groups: Dict[Key, Group], plan: Plan) -> List[FreeExponent]:
    """Stiffness from the strain at the last level, adhesion from the strength after it."""
    last = plan.levels[-1]

    def strain(group: Group) -> Value:
        return at_stress(group, "bulk", comparison_stress(plan))

    def strength(group: Group) -> Value:
        return group.strength(last)

    found = []
    for what, expected, vary, response, text in (
            ("stiffness", 1.0, stiffer, strain, "strain near the last level"),
            ("adhesion", 2.0, stickier, strength, "unconfined strength after the last level")):
        rate = Confined.strain_rate
        reference = groups[(BASE.label, "scaled", plan.diameters[0], rate)]
        target = response(reference)
        diameters, logs, slopes = [], [], []
        for diameter in plan.fitted:
            if diameter == plan.diameters[0]:
                continue
            factors = sorted((1.0, *FACTORS))
            some = [groups[((BASE if f == 1.0 else vary(BASE, f)).label, "scaled", diameter, rate)]
                    for f in factors]
            values = [response(group) for group in some]
            best = best_factor(factors, values, target.value)
            size = np.log(diameter / plan.diameters[0])
            diameters.append(diameter)
            logs.append(Value(best.value + expected * size, best.error))
            slopes.append(abs(exponent(factors, [v.value for v in values]).value))
        common = target.error / target.value / float(np.mean(slopes))
        fit = exponent_from_reference([d / plan.diameters[0] for d in diameters],
                                      [v.value for v in logs], [v.error for v in logs], common)
        found.append(FreeExponent(what, expected, text, diameters, logs, fit))
    return found


def speed_exponent(rows: Sequence[Row], mode: str) -> Optional[Value]:
    """b of wall time proportional to d^-b over the diameters of the base material."""
    some = [r for r in rows if r.material == BASE.label and r.mode in (mode, "scaled")
            and r.strain_rate == Confined.strain_rate]
    by_diameter = {r.diameter_mm: r for r in some if r.mode == "scaled"}
    finest = min(by_diameter)
    by_diameter.update({r.diameter_mm: r for r in some
                        if r.mode == mode and r.diameter_mm != finest})
    if len(by_diameter) < 2:
        return None
    fit = exponent(list(by_diameter), [r.seconds for r in by_diameter.values()])
    return Value(-fit.value, fit.error)


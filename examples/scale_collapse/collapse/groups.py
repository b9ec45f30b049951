# SPDX-License-Identifier: GPL-2.0-only
"""The results of finished runs by group: every seed of one material, diameter, mode, strain rate
and width of the specimen."""
from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Callable, Dict, List, Optional, Sequence, Tuple

import numpy as np

from . import curves as cv
from .cases import folder_of
from .measured import ConfinedResult, Cost, UnconfinedResult, load_confined, load_unconfined
from .plan import Plan, Run, special_of
from .specimens import Confined, Material, Unconfined
from .statistics import Value, ratio_of_means, value_of

PRELOAD = 5.0e3
#: Material's label, mode, diameter, and what is special (see Group).
Key = Tuple[str, str, float, str]


@dataclass
class Group:
    """Results by seed."""

    material: Material
    diameter: float
    mode: str
    #: nothing for the specimens that are compared with each other; what makes others not so
    special: str = ""
    strain_rate: float = Confined.strain_rate
    side: float = Confined.side
    confined: Dict[int, ConfinedResult] = field(default_factory=dict)
    unconfined: Dict[float, Dict[int, UnconfinedResult]] = field(default_factory=dict)

    @property
    def key(self) -> Key:
        return self.material.label, self.mode, self.diameter, self.special

    @property
    def curves(self) -> List[cv.Curve]:
        return [result.curve for result in self.confined.values()]

    @property
    def particles(self) -> int:
        return next(iter(self.confined.values())).cost.particles

    def crushed(self, level: float) -> List[UnconfinedResult]:
        return list(self.unconfined[level].values())

    def strength(self, level: float) -> Value:
        return value_of([result.strength for result in self.crushed(level)])

    def cost(self, get: Callable[[Cost], float]) -> List[float]:
        """Something of the cost of each confined run."""
        return [get(result.cost) for result in self.confined.values()]

    def only(self, seeds: Sequence[int]) -> "Group":
        """The same of some seeds."""
        crushed = {level: {s: r for s, r in results.items() if s in seeds}
                   for level, results in self.unconfined.items()}
        return replace(self, confined={s: r for s, r in self.confined.items() if s in seeds},
                       unconfined={level: results for level, results in crushed.items() if results})


def group_results(plan: Plan, out: Path, finished: Callable[[Run], bool]) -> Dict[Key, Group]:
    """The results of the plan's finished runs, read from their folders. A group without a confined
    run is left out."""
    groups: Dict[Key, Group] = {}
    for run in plan.runs:
        if not finished(run):
            continue
        specimen = run if isinstance(run, Confined) else run.specimen
        fresh = Group(specimen.material, specimen.diameter, specimen.mode,
                      special_of(specimen, plan), specimen.strain_rate, specimen.side)
        group = groups.setdefault(fresh.key, fresh)
        folder = folder_of(out, run)
        if isinstance(run, Unconfined):
            group.unconfined.setdefault(run.level, {})[specimen.seed] = load_unconfined(folder, run)
        else:
            group.confined[specimen.seed] = load_confined(folder, run, PRELOAD)
    return {key: group for key, group in groups.items() if group.confined}


def references(groups: Dict[Key, Group], plan: Plan) -> Dict[Key, Optional[Group]]:
    """The reference of each group: the finest scaled group planned for its material; at another strain
    rate the same packings at the usual rate. Nothing where that has not been run."""
    usual = {(g.material, g.mode, g.diameter): g for g in groups.values() if not g.special}
    finest: Dict[Material, float] = {}
    for run in plan.runs:
        if isinstance(run, Confined) and run.scaled and not special_of(run, plan):
            finest[run.material] = min(run.diameter, finest.get(run.material, run.diameter))

    def of(group: Group) -> Optional[Group]:
        if group.strain_rate == Confined.strain_rate:
            return usual.get((group.material, "scaled", finest.get(group.material)))
        same = usual.get((group.material, group.mode, group.diameter))
        both = [seed for seed in group.confined if same and seed in same.confined]
        return same.only(both) if both else None
    return {key: of(group) for key, group in groups.items()}


def equally_wide(one: Group, other: Group) -> bool:
    """Whether specimens are as many diameters wide."""
    return bool(np.isclose(one.side / one.diameter, other.side / other.diameter))


def comparison_stress(plan: Plan) -> float:
    """The stress at which groups are compared, Pa: below the last level, because the platen lags and
    samples come at intervals."""
    return 0.9 * plan.levels[-1]


def curve_at_stress(curve: cv.Curve, quantity: str, stress: float) -> float:
    """A quantity of the loading branch, or `bulk` strain."""
    branch = curve.loading
    values = branch.strain[quantity] if quantity in cv.STRAINS else getattr(branch, quantity)
    return float(cv.interpolate(np.array([stress]), branch.stress, values)[0])


def at_stress(group: Group, quantity: str, stress: float) -> Value:
    return value_of([curve_at_stress(curve, quantity, stress) for curve in group.curves])


def speed_up(group: Group, reference: Group, get: Callable[[Cost], float]) -> Value:
    """How many times longer a run of the reference takes."""
    return ratio_of_means(reference.cost(get), group.cost(get))


def mean_crush(results: Sequence[UnconfinedResult]) -> cv.Mean:
    """Stress over strain of crushing, to the strain that every seed reaches."""
    return _crush_over(_crush_grid(results), results)


def _crush_grid(results: Sequence[UnconfinedResult]) -> np.ndarray:
    return np.linspace(max(r.strain.min() for r in results), min(r.strain.max() for r in results),
                       cv.GRID_POINTS)


def _crush_over(grid: np.ndarray, results: Sequence[UnconfinedResult]) -> cv.Mean:
    return cv.mean_of(grid, [cv.interpolate(grid, r.strain, r.stress) for r in results])


def crush_deviation(results: Sequence[UnconfinedResult],
                    reference: Sequence[UnconfinedResult]) -> cv.Deviation:
    """Of the curves of crushing, over the strain that all reach."""
    grid = _crush_grid([*results, *reference])
    return cv.deviation(_crush_over(grid, results), _crush_over(grid, reference))

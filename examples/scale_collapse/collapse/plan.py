# SPDX-License-Identifier: GPL-2.0-only
"""Which specimens the study of strength is made of, and how long they will take."""
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Dict, List, Optional, Sequence, Tuple, Union

from .cases import is_scaled
from .specimens import Confined, Material, Unconfined, pull_off_force

Run = Union[Confined, Unconfined]

#: At the reference diameter of 1 mm.
BASE = Material("base")
COHESIONLESS = Material("cohesionless", kadh=0.0, f0=0.0)
PLATEAU = Material("plateau", law="plateau")
SETS = (Material("k1_10", k1=1.0e4),
        Material("kadh_7.5", kadh=7.5e3),
        Material("tensile_200", f0=pull_off_force(200.0, 1.0e-3)))
#: What stiffness or adhesion is multiplied by to find the one that fits the finest particles best.
FACTORS = (0.8, 1.25)
#: Of LAMMPS on one core, particles times steps in a second; only for the first estimate.
PARTICLE_STEPS = 6.0e6
RESTART_BYTES = 480  # of one particle in one restart file


def stiffer(material: Material, factor: float) -> Material:
    """Every stiffness times factor, pull-off force kept."""
    return replace(material, label=f"{material.label}_stiffness{factor:g}",
                   k1=factor * material.k1, kadh=factor * material.kadh)


def stickier(material: Material, factor: float) -> Material:
    """Both parts of the adhesion times factor."""
    return replace(material, label=f"{material.label}_adhesion{factor:g}",
                   kadh=factor * material.kadh, f0=factor * material.f0)


@dataclass(frozen=True)
class Plan:
    """What is run, in order of appearance; a run that two purposes share is there once."""

    runs: Tuple[Run, ...]
    diameters: Tuple[float, ...]
    levels: Tuple[float, ...]
    #: diameters of the fit of exponents, and that of the runs at half the speed
    fitted: Tuple[float, ...]
    slowed: float
    quick: bool

    @property
    def work(self) -> float:
        """Particles times steps, about."""
        return float(sum(run.particles * run.expected_steps() for run in self.runs))

    @property
    def disk_bytes(self) -> float:
        return float(sum(RESTART_BYTES * run.particles * len(run.levels)
                         for run in self.runs if isinstance(run, Confined)))

    def sorted_runs(self) -> List[Run]:
        """The longest specimens first, each before those that start from it."""
        def work(specimen: Confined) -> float:
            return specimen.particles * specimen.expected_steps()
        return sorted(self.runs, key=lambda run: (
            (-work(run), 0) if isinstance(run, Confined) else (-work(run.specimen), 1)))


class _Collector:
    """Specimens that differ from each other in what the methods are given."""

    def __init__(self, levels: Sequence[float], side: float, reference_particles: int,
                 seeds: int, fine: Sequence[float] = (), fine_seeds: int = 0) -> None:
        self.levels = tuple(levels)
        self._shape: Dict = {"side": side, "reference_particles": reference_particles}
        self._seeds, self._fine, self._fine_seeds = seeds, tuple(fine), fine_seeds
        self.runs: List[Run] = []

    def add(self, material: Material, diameters: Sequence[float], modes: Sequence[str],
            crushed: Sequence[float], rate: float = Confined.strain_rate,
            seeds: int = 0) -> None:
        for mode in modes:
            for diameter in diameters:
                scaled = is_scaled(diameter, mode, Confined.reference_diameter)
                count = self._fine_seeds if diameter in self._fine else self._seeds
                for seed in range(1, min(seeds or count, count) + 1):
                    one = Confined(material, diameter, scaled, seed, self.levels,
                                   strain_rate=rate, **self._shape)
                    self.runs.append(one)
                    for level in crushed:
                        pictured = (seed == 1 and level == self.levels[-1] and scaled
                                    and rate == Confined.strain_rate
                                    and material in (BASE, PLATEAU))
                        self.runs.append(Unconfined(one, level, pictured))


BOTH = ("scaled", "unscaled")


def full(seeds: int = 5, fine_seeds: Optional[int] = None,
         diameters: Sequence[float] = ()) -> Plan:
    """The study: specimens ten diameters of the largest particle wide.

    :param fine_seeds: of diameters below 1.5 times the finest, which take most of the time: 3, or
        as many as of the others if that is less
    """
    sizes = tuple(sorted(diameters or (1.0e-3, 1.25e-3, 1.5e-3, 2.0e-3, 2.5e-3, 3.0e-3)))
    levels = (16.0e3, 36.0e3, 56.0e3, 76.0e3, 96.0e3)
    fine = [d for d in sizes if d < 1.5 * sizes[0]]
    some = _Collector(levels, 30.0e-3, 32400, seeds, fine, fine_seeds or min(3, seeds))
    coarse = [d for d in sizes if d in (1.5e-3, 2.0e-3, 3.0e-3)] or list(sizes)
    fitted = tuple(d for d in sizes if d >= 1.5e-3) or sizes[1:]
    slowed = coarse[len(coarse) // 2]
    some.add(BASE, sizes, ("scaled",), levels)
    # unscaled they are nearly the finest: their compression, but no strength, is worth the time
    some.add(BASE, [d for d in fine if d > sizes[0]], ("unscaled",), ())
    some.add(BASE, [d for d in sizes if d not in fine], ("unscaled",), levels)
    some.add(COHESIONLESS, coarse, BOTH, ())
    some.add(PLATEAU, coarse, BOTH, levels, seeds=3)
    for material in SETS:
        some.add(material, coarse, ("scaled",), (levels[1], levels[-1]), seeds=3)
    _add_fits(some, fitted, slowed, seeds=3)
    return Plan(tuple(dict.fromkeys(some.runs)), sizes, levels, fitted, slowed, False)


def quick(seeds: int = 2) -> Plan:
    """Every kind of run on specimens far too small to mean anything: tries the machinery."""
    sizes, levels = (2.0e-3, 3.0e-3), (16.0e3, 36.0e3)
    some = _Collector(levels, 15.0e-3, 8100, seeds)
    some.add(BASE, sizes, BOTH, levels)
    some.add(COHESIONLESS, sizes[1:], ("scaled",), ())
    some.add(PLATEAU, sizes[1:], ("scaled",), levels[-1:])
    some.add(SETS[0], sizes[1:], ("scaled",), levels[-1:], seeds=1)
    _add_fits(some, sizes[1:], sizes[1], seeds=1)
    return Plan(tuple(dict.fromkeys(some.runs)), sizes, levels, sizes[1:], sizes[1], True)


def _add_fits(some: _Collector, fitted: Sequence[float], slowed: float, seeds: int) -> None:
    for factor in FACTORS:
        some.add(stiffer(BASE, factor), fitted, ("scaled",), (), seeds=seeds)
        some.add(stickier(BASE, factor), fitted, ("scaled",), some.levels[-1:], seeds=seeds)
    some.add(BASE, [slowed], ("scaled",), some.levels[-1:], rate=0.5 * Confined.strain_rate,
             seeds=seeds)


def describe(plan: Plan, jobs: int, particle_steps: float) -> str:
    """The plan as a table: what, how many, and about how long."""
    lines = [f"{'parameters':<22}{'mode':<10}{'d (mm)':>7}{'particles':>11}{'seeds':>7}{'runs':>6}"
             f"{'core-minutes':>14}"]
    groups: Dict[Tuple, List[Run]] = {}
    for run in plan.runs:
        one = run if isinstance(run, Confined) else run.specimen
        label = one.material.label
        if one.strain_rate != Confined.strain_rate:
            label += f" {one.strain_rate:g}/s"
        groups.setdefault((label, one.mode, one.diameter), []).append(run)
    for (label, mode, diameter), runs in groups.items():
        specimens = [run for run in runs if isinstance(run, Confined)]
        work = sum(run.particles * run.expected_steps() for run in runs)
        lines.append(f"{label:<22}{mode:<10}{1e3 * diameter:>7g}{specimens[0].particles:>11}"
                     f"{len(specimens):>7}{len(runs):>6}{work / particle_steps / 60.0:>14.1f}")
    seconds = plan.work / particle_steps
    lines += ["", f"{len(plan.runs)} runs, about {seconds / 3600.0:.2f} core-hours at "
                  f"{particle_steps / 1e6:.1f} million particle steps a second: about "
                  f"{seconds / 3600.0 / jobs:.2f} h with {jobs} at once; restart files take about "
                  f"{plan.disk_bytes / 1e9:.2f} GB"]
    return "\n".join(lines)

# SPDX-License-Identifier: GPL-2.0-only
"""The specimens of the study of strength and an estimate of their time."""
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Dict, List, Optional, Sequence, Tuple, Union

from .cases import MODES, is_scaled
from .specimens import Confined, Material, Unconfined, pull_off_force

Run = Union[Confined, Unconfined]

#: At the reference diameter of 1 mm.
BASE = Material("base")
#: Its strength is carried by the pull-off force alone: that of a tensile strength of 4 kPa.
PULL_OFF = Material("pull_off", kadh=0.0, f0=pull_off_force(4.0e3, 1.0e-3))
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
    """Adhesive stiffness times factor."""
    return replace(material, label=f"{material.label}_kadh{factor:g}",
                   kadh=factor * material.kadh)


def pulled_harder(material: Material, factor: float) -> Material:
    """Pull-off force times factor."""
    return replace(material, label=f"{material.label}_f0{factor:g}", f0=factor * material.f0)


#: What the fits need beside the materials that they are of.
VARIED = tuple(vary(material, factor) for material, vary in (
    (BASE, stiffer), (BASE, stickier), (PULL_OFF, pulled_harder)) for factor in FACTORS)


@dataclass(frozen=True)
class Plan:
    """The runs in order of appearance; a run that two purposes share appears once."""

    runs: Tuple[Run, ...]
    diameters: Tuple[float, ...]
    levels: Tuple[float, ...]
    #: width of the specimens that are compared with each other
    side: float
    #: diameters of the fit of exponents, the finest of those for f0, and that of half the speed
    fitted: Tuple[float, ...]
    pull_off_reference: float
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
        self.side, self._reference_particles = side, reference_particles
        self._seeds, self._fine, self._fine_seeds = seeds, tuple(fine), fine_seeds
        self.runs: List[Run] = []

    def add(self, material: Material, diameters: Sequence[float], modes: Sequence[str],
            crushed: Sequence[float], rate: float = Confined.strain_rate,
            seeds: int = 0, width: float = 1.0, height: float = 1.0) -> None:
        """:param width: of the specimen, over that of the others; likewise its height"""
        shape: Dict = {"side": width * self.side, "reference_particles":
                       round(self._reference_particles * width**2 * height)}
        for mode in modes:
            for diameter in diameters:
                scaled = is_scaled(diameter, mode, Confined.reference_diameter)
                # where they are as many as in the usual specimen
                many = diameter in self._fine and width >= 1.0
                count = self._fine_seeds if many else self._seeds
                for seed in range(1, min(seeds or count, count) + 1):
                    one = Confined(material, diameter, scaled, seed, self.levels,
                                   strain_rate=rate, **shape)
                    self.runs.append(one)
                    for level in crushed:
                        pictured = (seed == 1 and level == self.levels[-1] and scaled
                                    and width == 1.0 and rate == Confined.strain_rate
                                    and material in (BASE, PLATEAU))
                        self.runs.append(Unconfined(one, level, pictured))


def full(seeds: int = 5, fine_seeds: Optional[int] = None) -> Plan:
    """The study: specimens ten diameters of the largest particle wide.

    :param fine_seeds: of diameters below 1.5 times the finest, which take most of the time: 3, or
        as many as of the others if that is less
    """
    sizes = (1.0e-3, 1.25e-3, 1.5e-3, 2.0e-3, 2.5e-3, 3.0e-3)
    levels = (16.0e3, 36.0e3, 56.0e3, 76.0e3, 96.0e3)
    fine = [d for d in sizes if d < 1.5 * sizes[0]]
    some = _Collector(levels, 30.0e-3, 32400, seeds, fine, fine_seeds or min(3, seeds))
    coarse = (1.5e-3, 2.0e-3, 3.0e-3)
    fitted = tuple(d for d in sizes if d >= 2.0e-3)
    slowed = coarse[1]
    ends = (levels[0], levels[-1])
    some.add(BASE, [d for d in sizes if d not in fine[1:]], ("scaled",), levels)
    # what is crushed less is between sizes that are crushed after every level
    some.add(BASE, fine[1:], ("scaled",), ends)
    some.add(BASE, fine[1:], ("unscaled",), ())
    some.add(BASE, coarse[:1], ("unscaled",), ends)
    some.add(BASE, [d for d in sizes if d > coarse[0]], ("unscaled",), levels)
    some.add(COHESIONLESS, sizes[:1], ("scaled",), (), seeds=2)
    some.add(COHESIONLESS, coarse, ("scaled",), ())
    some.add(COHESIONLESS, coarse[1:], ("unscaled",), ())
    some.add(PLATEAU, coarse, ("scaled",), ends, seeds=3)
    some.add(PLATEAU, coarse[1:], ("unscaled",), ends[1:], seeds=3)
    for material in SETS:
        some.add(material, coarse, ("scaled",), ends, seeds=3)
    _add_fits(some, fitted, coarse[0], slowed, seeds=3)
    _add_sizes(some, sizes[0], coarse[0], fitted, coarse[1:], seeds=3)
    return Plan(tuple(dict.fromkeys(some.runs)), sizes, levels, some.side, fitted, coarse[0],
                slowed, False)


def quick(seeds: int = 2) -> Plan:
    """Every kind of run on specimens far too small to mean anything: tries the machinery."""
    sizes, levels = (2.0e-3, 3.0e-3), (16.0e3, 36.0e3)
    some = _Collector(levels, 15.0e-3, 8100, seeds)
    some.add(BASE, sizes, MODES, levels)
    some.add(COHESIONLESS, sizes[1:], ("scaled",), ())
    some.add(PLATEAU, sizes[1:], ("scaled",), levels[-1:])
    some.add(SETS[0], sizes[1:], ("scaled",), levels[-1:], seeds=1)
    _add_fits(some, sizes[1:], sizes[0], sizes[1], seeds=1)
    _add_sizes(some, sizes[0], sizes[0], sizes[1:], sizes[1:], seeds=1)
    return Plan(tuple(dict.fromkeys(some.runs)), sizes, levels, some.side, sizes[1:], sizes[0],
                sizes[1], True)


def _add_fits(some: _Collector, fitted: Sequence[float], pull_off_reference: float,
              slowed: float, seeds: int) -> None:
    last = some.levels[-1:]
    some.add(PULL_OFF, [pull_off_reference, *fitted], ("scaled",), last, seeds=seeds)
    for factor in FACTORS:
        some.add(stiffer(BASE, factor), fitted, ("scaled",), (), seeds=seeds)
        some.add(stickier(BASE, factor), fitted, ("scaled",), last, seeds=seeds)
        some.add(pulled_harder(PULL_OFF, factor), fitted, ("scaled",), last, seeds=seeds)
    some.add(BASE, [slowed], ("scaled",), last, rate=0.5 * Confined.strain_rate, seeds=seeds)


def _add_sizes(some: _Collector, finest: float, pull_off_reference: float,
               coarse: Sequence[float], doubled: Sequence[float], seeds: int) -> None:
    """Separates the effect of the diameter from that of the number of particles across the specimen:
    the finest particles in specimens as many diameters wide and high as those of the coarse ones, and
    some of the coarse ones in specimens twice as wide and high."""
    for material, fine, levels in ((BASE, finest, some.levels),
                                   (PULL_OFF, pull_off_reference, some.levels[-1:])):
        for diameter in coarse:
            similar = fine / diameter
            some.add(material, [fine], ("scaled",), levels, width=similar, height=similar)
    some.add(BASE, doubled, ("scaled",), some.levels, seeds=seeds, width=2.0, height=2.0)


def special_of(specimen: Confined, plan: Plan) -> str:
    """The difference of a specimen from those that are compared over the diameters."""
    words = []
    if specimen.strain_rate != Confined.strain_rate:
        words.append(f"{specimen.strain_rate:g}/s")
    if specimen.side != plan.side:
        words.append(f"{1e3 * specimen.side:g} mm wide")
    return ", ".join(words)


def describe(plan: Plan, jobs: int, particle_steps: float) -> str:
    """The plan as a table: runs, their number, and about how long they take."""
    lines = [f"{'parameters':<24}{'mode':<10}{'d (mm)':>7}{'particles':>11}{'seeds':>7}{'runs':>6}"
             f"{'core-minutes':>14}"]
    groups: Dict[Tuple, List[Run]] = {}
    for run in plan.runs:
        one = run if isinstance(run, Confined) else run.specimen
        label = f"{one.material.label} {special_of(one, plan)}".rstrip()
        groups.setdefault((label, one.mode, one.diameter), []).append(run)
    for (label, mode, diameter), runs in groups.items():
        specimens = [run for run in runs if isinstance(run, Confined)]
        work = sum(run.particles * run.expected_steps() for run in runs)
        lines.append(f"{label:<24}{mode:<10}{1e3 * diameter:>7g}{specimens[0].particles:>11}"
                     f"{len(specimens):>7}{len(runs):>6}{work / particle_steps / 60.0:>14.1f}")
    seconds = plan.work / particle_steps
    lines += ["", f"{len(plan.runs)} runs, about {seconds / 3600.0:.2f} core-hours at "
                  f"{particle_steps / 1e6:.1f} million particle steps a second: about "
                  f"{seconds / 3600.0 / jobs:.2f} h with {jobs} at once; restart files take about "
                  f"{plan.disk_bytes / 1e9:.2f} GB"]
    return "\n".join(lines)

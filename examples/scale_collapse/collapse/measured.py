# SPDX-License-Identifier: GPL-2.0-only
"""Results of one run of in.confined or in.unconfined. SI units."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Mapping, Tuple

import numpy as np

from .cases import DENSITY
from .curves import BadCurve, Curve, curve_from_samples, read_samples
from .runs import CURVE, read_marker
from .specimens import Confined, Material, Unconfined
from .statistics import slope

UNLOAD = "unload.csv"
#: Part of unloading that moduli are taken from: stress over that at its beginning.
ELASTIC = (0.5, 0.95)
#: Samples, least and most, of the running mean that finds the peak of crushing (one lasts 2e-4 of
#: strain), and part of that peak from which on they make the curve whose top is the strength.
#: What samples scatter by lasts for several of them: a narrower window would be chosen by it.
SMOOTHED = (5, 15)
NEAR_PEAK = 0.8
#: Strain that in.unconfined ends at when stress has not fallen before.
LARGEST_STRAIN = 0.12
#: Stages that make a specimen rather than test it.
MAKING = ("start", "place", "relax", "pack")


@dataclass(frozen=True)
class Moduli:
    """Moduli on unloading, Pa: change of axial stress (constrained modulus) and of mean stress (bulk
    modulus) per strain of the bulk, which is axial only and counts from the beginning of unloading. Ratio
    of lateral to axial stress before unloading."""

    constrained: float
    bulk: float
    lateral_ratio: float


@dataclass(frozen=True)
class ConfinedResult:
    curve: Curve
    moduli: Moduli
    inertial_number: float
    cost: "Cost"


@dataclass(frozen=True)
class UnconfinedResult:
    """Stress is force over the cross-section before crushing."""

    strain: np.ndarray
    stress: np.ndarray
    strength: float
    strain_at_peak: float
    #: whether stress fell after it
    failed: bool
    moduli: Moduli
    #: of the bulk, coordination number and mean pull-off force (N) of the contacts before crushing
    porosity: float
    coordination: float
    pull_off: float
    #: coordination number of the unloaded specimen, before its sides were cut free
    uncut_coordination: float
    inertial_number: float
    cost: "Cost"


@dataclass(frozen=True)
class Cost:
    """Processor time of LAMMPS's loops, s, and steps: of the whole run (the placing of points has
    no steps) and of the test alone, without the making of the specimen."""

    particles: int
    seconds: float
    steps: int
    test_seconds: float
    test_steps: int

    @staticmethod
    def from_marker(marker: Mapping) -> "Cost":
        stages = marker["stages"]
        test = [s for name, s in stages.items() if name not in MAKING]
        return Cost(marker["particles"], sum(s["cpu_seconds"] for s in stages.values()),
                    sum(s["steps"] for name, s in stages.items() if name != "place"),
                    sum(s["cpu_seconds"] for s in test), sum(s["steps"] for s in test))


def axial_stress(samples: np.ndarray) -> np.ndarray:
    return 0.5 * (samples["stress_top"] + samples["stress_bottom"])


def running_mean(values: np.ndarray, width: int) -> np.ndarray:
    """Over `width` samples, fewer at the ends."""
    kernel = np.ones(min(width, len(values)))
    return np.convolve(values, kernel, "same") / np.convolve(np.ones(len(values)), kernel, "same")


def moduli_of(samples: np.ndarray, name: str = "curve") -> Moduli:
    """From the samples of stage `unload`.

    :raise BadCurve: when stress does not fall far enough
    """
    unload = samples[samples["stage"] == "unload"]
    if len(unload) < 4:
        raise BadCurve(f"{name}: {len(unload)} samples of unloading, needed are 4")
    axial = axial_stress(unload)
    mean = (axial + unload["stress_x"] + unload["stress_y"]) / 3.0
    part = (axial >= ELASTIC[0] * axial[0]) & (axial <= ELASTIC[1] * axial[0])
    if np.count_nonzero(part) < 3:
        raise BadCurve(f"{name}: unloading has {np.count_nonzero(part)} samples between "
                       f"{ELASTIC[0]:g} and {ELASTIC[1]:g} of its first stress, needed are 3")
    strain = unload["bulk_strain"] / (1.0 - unload["bulk_strain"][0])
    return Moduli(slope(strain[part], axial[part]).value, slope(strain[part], mean[part]).value,
                  float((unload["stress_x"][0] + unload["stress_y"][0]) / (2.0 * axial[0])))


def strength_of(strain: np.ndarray, stress: np.ndarray) -> Tuple[float, float]:
    """Largest stress of crushing and its strain: the maximum of the cubic of least squares through the
    samples around the peak. The largest sample, or mean of a few, would be too high by their scatter,
    which grows with the diameter."""
    width = min(SMOOTHED[1], max(SMOOTHED[0], len(stress) // 15))
    smooth = running_mean(stress, width)
    rough = int(np.argmax(smooth))
    far = np.flatnonzero(smooth < NEAR_PEAK * smooth[rough])
    first = int(far[far < rough].max(initial=-1)) + 1
    last = int(far[far > rough].min(initial=len(stress)))
    x, y = strain[first:last], stress[first:last]
    if len(x) < SMOOTHED[0]:
        return float(smooth[rough]), float(strain[rough])
    cubic = np.polynomial.Polynomial.fit(x, y, 3)
    fine = np.linspace(x[0], x[-1], 1001)
    values = cubic(fine)
    top = int(np.argmax(values))
    return float(values[top]), float(fine[top])


def inertial_number(diameter: float, strain_rate: np.ndarray, stress: np.ndarray) -> np.ndarray:
    """I = strain rate d sqrt(density/stress) (MiDi, Eur. Phys. J. E 14 (2004) 341)."""
    return np.abs(strain_rate) * diameter * np.sqrt(DENSITY / stress)


def loading_inertial_number(samples: np.ndarray, diameter: float) -> float:
    """Largest inertial number on loading, with the strain rate of the bulk over twenty samples, 0.2% of
    strain."""
    load = samples[samples["stage"] == "load"]
    width = min(20, len(load) - 1)
    if width < 1:
        raise BadCurve(f"{len(load)} samples of loading, needed are 2")
    # Holds lie between the samples of loading: no span of samples reaches over one.
    spans = np.diff(load["step"])
    whole = np.array([np.all(spans[k:k + width] == spans.min())
                      for k in range(len(load) - width)])
    rates = ((load["bulk_strain"][width:] - load["bulk_strain"][:-width])
             / (load["time"][width:] - load["time"][:-width]))
    middle = running_mean(axial_stress(load), width)[width // 2:][:len(rates)]
    numbers = inertial_number(diameter, rates, middle)
    return float(np.max(numbers[whole] if whole.any() else numbers))


def confined_from(samples: np.ndarray, specimen: Confined, preload: float, cost: Cost,
                  name: str = "curve") -> ConfinedResult:
    return ConfinedResult(curve_from_samples(samples, preload, name), moduli_of(samples, name),
                          loading_inertial_number(samples, specimen.diameter), cost)


def unconfined_from(unload: np.ndarray, crush: np.ndarray, run: Unconfined, cost: Cost,
                    name: str = "curve") -> UnconfinedResult:
    """:raise BadCurve: without samples before and on crushing"""
    free, crushed = (crush[crush["stage"] == stage] for stage in ("free", "crush"))
    if len(free) == 0 or len(crushed) < SMOOTHED[0]:
        raise BadCurve(f"{name}: {len(free)} samples before crushing and {len(crushed)} on it")
    before = free[-1]
    strain = 1.0 - crushed["height"] / before["height"]
    stress = axial_stress(crushed)
    strength, strain_at_peak = strength_of(strain, stress)
    material: Material = run.specimen.material
    pull_off = material.pull_off(float(before["plastic_overlap"]), run.specimen.size)
    return UnconfinedResult(
        strain, stress, strength, strain_at_peak,
        bool(strain[-1] < 0.99 * LARGEST_STRAIN), moduli_of(unload, name),
        float(before["bulk_porosity"]), float(before["coordination"]), pull_off,
        float(unload["coordination"][-1]),
        float(inertial_number(run.diameter, np.array(run.crushing_rate), np.array(strength))),
        cost)


def load_confined(folder: Path, specimen: Confined, preload: float) -> ConfinedResult:
    return confined_from(read_samples(folder / CURVE), specimen, preload,
                         Cost.from_marker(read_marker(folder)), str(folder / CURVE))


def load_unconfined(folder: Path, run: Unconfined) -> UnconfinedResult:
    return unconfined_from(read_samples(folder / UNLOAD), read_samples(folder / CURVE), run,
                           Cost.from_marker(read_marker(folder)), str(folder / CURVE))

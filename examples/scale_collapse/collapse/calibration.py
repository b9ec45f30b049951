# SPDX-License-Identifier: GPL-2.0-only
"""Finds the coefficients with which coarse particles reproduce a target: SciPy's least_squares on
runs of in.confined and in.unconfined.

The parameters are logarithms of ratios to their first values, so that they are of one size and
keep their sign. A run is costly and its result not smooth at small steps (contacts open and slide
in another order), so the derivatives are differences over a step of 10%, whose runs are made
side by side; a derivative-free method would need several times as many runs, one after the other.
"""
from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Callable, Dict, List, Optional, Sequence, Tuple

import numpy as np
from scipy.optimize import least_squares

from . import curves as cv
from .cases import folder_of, require_positive
from .measured import load_confined, load_unconfined
from .plan import Run
from .specimens import Confined, Material, Unconfined

FREE = ("k1", "kadh", "f0", "mu")
#: Step of the differences, in logarithms; factor that a parameter may go from its first value.
STEP, REACH = math.log(1.1), math.log(4.0)
POINTS = 40


@dataclass(frozen=True)
class Target:
    """Strain counts from the preload; porosity from its value at the lowest stress of its curve,
    because that one is a matter of the packing. Stress in Pa."""

    preload: float
    strain: np.ndarray
    stress: np.ndarray
    porosity_stress: np.ndarray
    porosity: np.ndarray
    #: unconfined strength after the highest level
    strength: Optional[float] = None
    #: standard errors of strain (as of the whole curve at once) and strength, where they are known
    strain_error: Optional[np.ndarray] = None
    strength_error: float = 0.0

    def __post_init__(self) -> None:
        if len(self.strain) < 3 or len(self.porosity) < 3:
            raise ValueError("a target curve has fewer than 3 points above the preload")
        if self.strength is not None:
            require_positive("strength", self.strength)


def read_curve(path: Path, x: str, y: str) -> Tuple[np.ndarray, np.ndarray]:
    """Two named columns of a CSV file, in rising order of the first.

    :raise ValueError: with the file's name and the column that is missing
    """
    table = np.genfromtxt(path, delimiter=",", names=True, dtype=float, encoding="utf-8")
    for name in (x, y):
        if name not in (table.dtype.names or ()):
            raise ValueError(f"{path}: no column {name}, needed are {x} and {y}")
    table = np.atleast_1d(table)
    good = np.isfinite(table[x]) & np.isfinite(table[y])
    order = np.argsort(table[x][good], kind="stable")
    return table[x][good][order], table[y][good][order]


def read_error(path: Path, x: str, y: str) -> Optional[np.ndarray]:
    """The column y_error in the order of read_curve, if the file has one that is finite."""
    try:
        error = read_curve(path, x, f"{y}_error")[1]
    except ValueError:
        return None
    return error if len(error) == len(read_curve(path, x, y)[1]) else None


def target_from(strain: np.ndarray, stress: np.ndarray, porosity_stress: np.ndarray,
                porosity: np.ndarray, preload: float, strength: Optional[float],
                strain_error: Optional[np.ndarray] = None,
                strength_error: float = 0.0) -> Target:
    """Cuts the curves at the preload and counts strain from there."""
    if not stress[0] <= preload < stress[-1]:
        raise ValueError(f"the target's stress goes from {stress[0]:g} to {stress[-1]:g} Pa, it "
                         f"must begin at the preload of {preload:g} Pa or below and end above")
    first = float(cv.interpolate(np.array([preload]), stress, strain)[0])
    above = stress > preload
    part = porosity_stress >= preload
    return Target(preload, np.concatenate([[0.0], (strain[above] - first) / (1.0 - first)]),
                  np.concatenate([[preload], stress[above]]), porosity_stress[part],
                  porosity[part], strength,
                  None if strain_error is None else np.concatenate([[0.0], strain_error[above]]),
                  strength_error)


@dataclass(frozen=True)
class Residual:
    """How far one specimen, or the mean of several, is from the target; in shares of its peak
    stress, of its change of porosity, and of its strength."""

    values: np.ndarray
    porosity_offset: float
    #: what values change by when the target's strain, or its strength, does by its standard error
    of_target: Tuple[np.ndarray, ...] = ()


def residual(target: Target, curve: cv.Curve, strength: Optional[float]) -> Residual:
    """Residuals are taken at equal stress, within the range that the run reached. Differences of
    strain are converted to stress by the target's mean stiffness."""
    top = min(target.stress[-1], float(curve.loading.stress.max()))
    grid = np.linspace(target.preload, top, POINTS)
    wanted = np.interp(grid, target.stress, target.strain)
    found = cv.interpolate(grid, curve.loading.stress, curve.loading.strain["bulk"])
    parts = [(found - wanted) / wanted[-1] / math.sqrt(POINTS)]
    of_strain = []
    if target.strain_error is not None:
        error = np.interp(grid, target.stress, target.strain_error)
        of_strain.append(-error / wanted[-1] / math.sqrt(POINTS))
    low = max(target.preload, float(target.porosity_stress[0]))
    grid = np.linspace(low, min(top, float(target.porosity_stress[-1])), POINTS)
    wanted = np.interp(grid, target.porosity_stress, target.porosity)
    found = cv.interpolate(grid, curve.loading.stress, curve.loading.bulk_porosity)
    offset = float(found[0] - wanted[0])
    span = float(np.ptp(wanted))
    if not span > 0.0:
        raise ValueError("the target's porosity does not change with stress")
    parts.append((found - wanted - offset) / span / math.sqrt(POINTS))
    if target.strain_error is not None:
        # porosity depends on strain and has the same error: its change is (1 - n) times that of strain
        error = np.interp(grid, target.stress, target.strain_error) * (1.0 - wanted)
        of_strain.append((error - error[0]) / span / math.sqrt(POINTS))
    shifts = [np.concatenate(of_strain)] if of_strain else []
    if target.strength is not None:
        assert strength is not None
        parts.append(np.array([math.log(strength / target.strength)]))
        shifts = [np.append(shift, 0.0) for shift in shifts]
        shifts.append(np.append(np.zeros(sum(map(len, parts)) - 1),
                                target.strength_error / target.strength))
    return Residual(np.concatenate(parts), offset, tuple(shifts))


@dataclass
class Fit:
    material: Material
    free: Tuple[str, ...]
    #: of each free parameter, relative: from the scatter of the packings and the target's errors
    errors: Dict[str, float]
    #: root mean square residual, and porosity less that of the target at the lowest stress
    distance: float
    porosity_offset: float
    evaluations: int
    message: str
    history: List[dict] = field(default_factory=list)


Simulate = Callable[[Sequence[Material]], List[List[Residual]]]


def with_parameters(start: Material, free: Sequence[str], logs: Sequence[float]) -> Material:
    """The start with each free parameter times exp(log), labelled by its values."""
    changed = replace(start, **{name: getattr(start, name) * math.exp(log)
                                for name, log in zip(free, logs)})
    digest = hashlib.sha256(json.dumps([changed.law, changed.k1, changed.kadh, changed.f0,
                                        changed.mu]).encode()).hexdigest()[:10]
    return replace(changed, label=f"calibrate_{digest}")


def fit(start: Material, free: Sequence[str], simulate: Simulate, most: int = 12,
        note: Callable[[dict], None] = lambda entry: None) -> Fit:
    """Least squares over the mean of the packings.

    :param simulate: residuals of every packing of every material that it is given
    :param most: steps of the optimiser at most
    :param note: is given every point that was tried, as it comes
    """
    free = tuple(free)
    for name in free:
        if name not in FREE:
            raise ValueError(f"free parameter {name}, allowed are {', '.join(FREE)}")
        if getattr(start, name) == 0.0:
            raise ValueError(f"{name} starts at 0: give it another first value or keep it fixed")
    known: Dict[Tuple[float, ...], List[Residual]] = {}
    history: List[dict] = []

    def evaluate(points: Sequence[np.ndarray]) -> None:
        missing = [p for p in points if tuple(p) not in known]
        materials = [with_parameters(start, free, p) for p in missing]
        for point, material, found in zip(missing, materials,
                                          simulate(materials) if missing else []):
            known[tuple(point)] = found
            entry = {"parameters": {name: getattr(material, name) for name in free},
                     "distance": float(np.linalg.norm(mean_of(found)))}
            history.append(entry)
            note(entry)

    def mean_of(found: Sequence[Residual]) -> np.ndarray:
        return np.mean([r.values for r in found], axis=0)

    def residuals(x: np.ndarray) -> np.ndarray:
        # The differences are needed next, and one batch fills all jobs.
        evaluate([x, *steps_from(x)])
        return mean_of(known[tuple(x)])

    def steps_from(x: np.ndarray) -> List[np.ndarray]:
        return [x + STEP * (1.0 if x[k] + STEP < REACH else -1.0) * unit
                for k, unit in enumerate(np.eye(len(x)))]

    def jacobian(x: np.ndarray) -> np.ndarray:
        points = steps_from(x)
        evaluate([x, *points])
        centre = mean_of(known[tuple(x)])
        return np.stack([(mean_of(known[tuple(p)]) - centre) / (p - x)[k]
                         for k, p in enumerate(points)], axis=1)

    result = least_squares(residuals, np.zeros(len(free)), jac=jacobian,
                           bounds=(-REACH, REACH), max_nfev=most, xtol=1e-3, ftol=1e-3)
    packings = known[tuple(result.x)]
    return Fit(with_parameters(start, free, result.x), free,
               parameter_errors(packings, jacobian(result.x), free),
               float(np.linalg.norm(mean_of(packings))),
               float(np.mean([r.porosity_offset for r in packings])), len(known),
               str(result.message), history)


def parameter_errors(packings: Sequence[Residual], jacobian: np.ndarray,
                     free: Sequence[str]) -> Dict[str, float]:
    """Relative standard error of each parameter, to first order: that of the mean over packings of
    what each of them alone would ask for, and what the standard errors of the target would change.
    Not known for a single packing, nor where the target does not depend on a parameter."""
    if len(packings) < 2 or np.linalg.matrix_rank(jacobian) < len(free):
        return {name: math.nan for name in free}
    inverse = np.linalg.pinv(jacobian)
    wanted = np.array([-inverse @ r.values for r in packings])
    square = wanted.var(axis=0, ddof=1) / len(packings)
    for shift in packings[0].of_target:
        square += (inverse @ shift) ** 2
    error = np.sqrt(square)
    return dict(zip(free, map(float, error)))


@dataclass(frozen=True)
class Specimens:
    """Runs materials as specimens of one coarse diameter."""

    target: Target
    diameter: float
    levels: Tuple[float, ...]
    seeds: Tuple[int, ...]
    out: Path
    run: Callable[[List[Run]], None]
    side: float = Confined.side
    reference_diameter: float = Confined.reference_diameter
    reference_particles: int = Confined.reference_particles

    def __call__(self, materials: Sequence[Material]) -> List[List[Residual]]:
        sets = [[self.specimen(material, seed) for seed in self.seeds] for material in materials]
        runs: List[Run] = [one for some in sets for one in some]
        crushed = self.target.strength is not None
        if crushed:
            runs += [Unconfined(one, self.levels[-1]) for some in sets for one in some]
        self.run(list(dict.fromkeys(runs)))
        return [[self._residual(one, crushed) for one in some] for some in sets]

    def specimen(self, material: Material, seed: int) -> Confined:
        return Confined(material, self.diameter, True, seed, self.levels,
                        self.reference_diameter, side=self.side,
                        reference_particles=self.reference_particles)

    def _residual(self, one: Confined, crushed: bool) -> Residual:
        curve = load_confined(folder_of(self.out, one), one, self.target.preload).curve
        strength = None
        if crushed:
            run = Unconfined(one, self.levels[-1])
            strength = load_unconfined(folder_of(self.out, run), run).strength
        return residual(self.target, curve, strength)


def include_file(found: Fit, reference_diameter: float, about: str) -> str:
    """For in.confined's variable `parameters`: it includes the file before its own defaults."""
    material = found.material
    lines = ["# Coefficients at the reference diameter, found by calibrate.py", f"# {about}",
             f"# distance from the target {found.distance:.4g}, {found.evaluations} parameter sets"]
    for name in ("k1", "k2", "kadh", "f0", "mu"):
        error = found.errors.get("k1" if name == "k2" else name)
        if name not in found.free and not (name == "k2" and "k1" in found.free):
            text = "given"
        elif error is None or not math.isfinite(error):
            text = "found, its error is not known"
        else:
            text = f"found, +- {abs(error * getattr(material, name)):.3g}"
        lines.append(f"variable {name:<9} index {getattr(material, name):<14.8g} # {text}")
    lines += [f"variable dref      index {reference_diameter:g}",
              f"variable law       index {material.law}"]
    return "\n".join(lines) + "\n"

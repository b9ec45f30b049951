# SPDX-License-Identifier: GPL-2.0-only
"""Finds the coefficients with which coarse particles reproduce measured quantities: SciPy's least_squares
on the logarithms of coefficients and quantities.

A run is costly and its result not smooth at small steps (contacts open and slide in another order), so
derivatives are differences over a step of 10%, whose runs are made side by side; a derivative-free method
would need several times as many runs, one after the other.
"""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, List, Mapping, Sequence

import numpy as np
import pandas as pd
from scipy.optimize import least_squares

#: Quantities of a target, and whether they belong to a stress (Pa).
QUANTITIES = {"strain": True, "porosity_change": True, "strength": True, "friction_angle": False,
              "steady_angle": False, "flow_function": False, "shear_strength": False}
SHEAR = tuple(name for name, has_stress in QUANTITIES.items() if not has_stress)
FREE = ("k1", "kadh", "f0", "mu", "mur")
#: Step of the differences, in logarithms; factor that a coefficient may go from its first value.
STEP, REACH = math.log(1.1), math.log(4.0)
#: Smallest relative error of a target: what is known better still counts no more.
LEAST_ERROR = 0.01

#: Of coefficient sets, for each a row a packing and a column a target.
Simulate = Callable[[Sequence[Mapping[str, float]]], List[np.ndarray]]


def read_targets(path: Path) -> pd.DataFrame:
    """Columns quantity, stress (Pa, empty where it has none), value, error (standard, empty if not known).

    `strain` and `porosity_change` count from the preload; `strength` is that after consolidation at `stress`.

    :raise ValueError: with the line and what is allowed
    """
    table = pd.read_csv(path, comment="#")
    missing = {"quantity", "value"} - set(table)
    if missing:
        raise ValueError(f"{path}: no column {', '.join(sorted(missing))}")
    for name in ("stress", "error"):
        if name not in table:
            table[name] = np.nan
    for name in ("value", "stress", "error"):
        numbers = pd.to_numeric(table[name], errors="coerce")
        odd = table.loc[table[name].notna() & ~np.isfinite(numbers.fillna(np.inf)), name]
        if len(odd):
            raise ValueError(f"{path}: {name} {odd.iloc[0]}: allowed are numbers")
        table[name] = numbers
    if table.empty:
        raise ValueError(f"{path}: it has no target")
    for k, row in table.iterrows():
        place = f"{path}: target {k + 1}"
        if row["quantity"] not in QUANTITIES:
            raise ValueError(f"{place} is {row['quantity']}, allowed are {', '.join(QUANTITIES)}")
        if QUANTITIES[row["quantity"]] != bool(row["stress"] > 0.0):
            raise ValueError(f"{place}, {row['quantity']}, "
                             + ("needs a stress above 0" if QUANTITIES[row["quantity"]] else "has no stress"))
        if not row["value"] > 0.0:
            raise ValueError(f"{place}, {row['quantity']}: value {row['value']:g}, allowed are numbers above 0")
        if row["error"] < 0.0:
            raise ValueError(f"{place}, {row['quantity']}: error {row['error']:g}, allowed is 0 or more")
    return table


@dataclass(frozen=True)
class Fit:
    """`errors` are relative, of the free coefficients: from the scatter of the packings and the errors of the
    targets; not known (NaN) for a single packing or where no target depends on a coefficient. `distance` is the
    root mean square of residuals over errors. `found` are the targets with columns found (value), relative
    error_of_coefficients."""

    values: Dict[str, float]
    errors: Dict[str, float]
    distance: float
    evaluations: int
    found: pd.DataFrame
    message: str


def fit(start: Mapping[str, float], free: Sequence[str], targets: pd.DataFrame, simulate: Simulate,
        most: int = 8, note: Callable[[Dict[str, float], float], None] = lambda values, distance: None) -> Fit:
    """:param most: steps of the optimiser at most
    :param note: is told of each set that was tried and its distance
    :raise ValueError: for a coefficient that can not be free
    """
    for name in free:
        if name not in FREE:
            raise ValueError(f"free coefficient {name}, allowed are {', '.join(FREE)}")
        if start[name] == 0.0:
            raise ValueError(f"{name} starts at 0: give it another first value or keep it fixed")
    if len(free) > len(targets):
        raise ValueError(f"{len(free)} free coefficients and {len(targets)} targets, needed are as many targets or more")
    wanted = np.log(targets["value"].to_numpy(float))
    relative = (targets["error"] / targets["value"]).fillna(0.0).to_numpy(float)
    weight = np.maximum(relative, LEAST_ERROR) * math.sqrt(len(targets))
    known: Dict[tuple, np.ndarray] = {}

    def values_at(x: np.ndarray) -> Dict[str, float]:
        return {**start, **{name: start[name] * math.exp(log) for name, log in zip(free, x)}}

    def evaluate(points: Sequence[np.ndarray]) -> None:
        missing = [p for p in points if tuple(p) not in known]
        for point, found in zip(missing, simulate([values_at(p) for p in missing]) if missing else []):
            known[tuple(point)] = (np.log(found) - wanted) / weight
            note(values_at(point), float(np.linalg.norm(known[tuple(point)].mean(axis=0))))

    def steps_from(x: np.ndarray) -> List[np.ndarray]:
        return [x + STEP * (1.0 if x[k] + STEP < REACH else -1.0) * unit for k, unit in enumerate(np.eye(len(x)))]

    def residuals(x: np.ndarray) -> np.ndarray:
        # The differences are needed next, and one batch fills all cores.
        evaluate([x, *steps_from(x)])
        return known[tuple(x)].mean(axis=0)

    def jacobian(x: np.ndarray) -> np.ndarray:
        centre = residuals(x)
        return np.stack([(known[tuple(p)].mean(axis=0) - centre) / (p - x)[k]
                         for k, p in enumerate(steps_from(x))], axis=1)

    result = least_squares(residuals, np.zeros(len(free)), jac=jacobian, bounds=(-REACH, REACH), max_nfev=most,
                           xtol=1e-3, ftol=1e-3)
    packings, slopes = known[tuple(result.x)], jacobian(result.x)
    covariance = _covariance(packings, slopes, relative / weight)
    found = targets.assign(
        found=np.exp(packings.mean(axis=0) * weight + wanted),
        error_of_coefficients=np.sqrt(np.einsum("jk,kl,jl->j", slopes, covariance, slopes)) * weight)
    return Fit(values_at(result.x), dict(zip(free, map(float, np.sqrt(np.diag(covariance))))),
               float(np.linalg.norm(packings.mean(axis=0))), len(known), found,
               str(result.message) + _at_bounds(free, result.x))


def _at_bounds(free: Sequence[str], logs: np.ndarray) -> str:
    far = [name for name, log in zip(free, logs) if abs(log) > 0.999 * REACH]
    return f" {', '.join(far)} went as far as it may, a factor of 4: begin nearer, or look at the targets' units." if far else ""


def _covariance(packings: np.ndarray, slopes: np.ndarray, of_target: np.ndarray) -> np.ndarray:
    """Of the logarithms of the coefficients, to first order: that of the mean over packings of what each of them
    alone would ask for, and what the standard errors of the targets would change."""
    count = slopes.shape[1]
    if len(packings) < 2 or np.linalg.matrix_rank(slopes) < count:
        return np.full((count, count), np.nan)
    inverse = np.linalg.pinv(slopes)
    asked = -packings @ inverse.T
    return (np.atleast_2d(np.cov(asked, rowvar=False)) / len(packings)
            + inverse @ np.diag(of_target**2) @ inverse.T)


def include_file(found: Fit, free: Sequence[str], about: str) -> str:
    """For in.confined's variable `parameters`, or any in-file that takes the same variables."""
    lines = ["# Coefficients found by coarsen calibrate", f"# {about}",
             f"# distance {found.distance:.3g} errors, {found.evaluations} sets of coefficients"]
    for name, value in found.values.items():
        error = found.errors.get("k1" if name == "k2" else name)
        text = ("given" if error is None else "found, its error is not known" if not math.isfinite(error) else
                f"found, +- {abs(error * value):.3g}")
        lines.append(f"variable {name:<9} index {value:<14.8g} # {text}")
    return "\n".join(lines) + "\n"

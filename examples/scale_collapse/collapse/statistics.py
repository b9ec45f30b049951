# SPDX-License-Identifier: GPL-2.0-only
"""Fits with their errors from the scatter of the seeds. Errors are standard errors."""
from __future__ import annotations

from dataclasses import dataclass
from typing import List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from .curves import Mean, mean_and_error, root_mean_square


@dataclass(frozen=True)
class Value:
    """A number and its standard error (not a number where a single seed gives none)."""

    value: float
    error: float


def value_of(numbers: Sequence[float]) -> Value:
    """Mean and its standard error, s/sqrt(N) with N - 1 in s."""
    return Value(*mean_and_error(numbers))


def ratio_percent(one: Value, reference: Value) -> Value:
    """Difference from the reference, in % of it."""
    ratio = one.value / reference.value
    error = np.hypot(one.error / reference.value, ratio * reference.error / reference.value)
    return Value(100.0 * (ratio - 1.0), float(100.0 * error))


def ratio_of_means(ones: Sequence[float], references: Sequence[float]) -> Value:
    """Mean of some numbers over the mean of others, independent of them."""
    percent = ratio_percent(value_of(ones), value_of(references))
    return Value(1.0 + 0.01 * percent.value, 0.01 * percent.error)


def paired_percent(ones: Mapping[int, float], references: Mapping[int, float]) -> Value:
    """Differences of numbers from others of the same packings (by seed), in % of the latter: mean over
    the packings that both have, and its error."""
    return value_of([100.0 * (one / references[seed] - 1.0) for seed, one in ones.items()
                     if seed in references])


def scatter_percent(mean: Mean) -> float:
    """Root mean square of the seeds' standard deviation along a curve, in % of its peak."""
    peak = float(np.max(np.abs(mean.value)))
    return 100.0 * root_mean_square(mean.error) * float(np.sqrt(mean.seeds)) / peak


def slope(x: np.ndarray, y: np.ndarray) -> Value:
    """Of the straight line of least squares; its error from the residuals."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if len(x) < 2 or np.ptp(x) == 0.0:
        raise ValueError(f"a slope needs 2 different points or more, there are {len(x)}")
    apart = x - x.mean()
    value = float(apart @ y / (apart @ apart))
    rest = y - y.mean() - value * apart
    error = (float(np.sqrt(rest @ rest / (len(x) - 2) / (apart @ apart))) if len(x) > 2
             else float("nan"))
    return Value(value, error)


def exponent(sizes: Sequence[float], values: Sequence[float]) -> Value:
    """a of values proportional to sizes^a."""
    return slope(np.log(sizes), np.log(values))


def exponent_from_reference(sizes: Sequence[float], logs: Sequence[float],
                            errors: Sequence[float], reference_error: float) -> Value:
    """a of log(value/value of the reference) = a log(size), by generalised least squares: every
    log has its own error, and that of the reference is common to them all.

    Errors that are not known (not a number) make an unweighted fit with the error of its
    residuals, which itself is not known for one size."""
    x, y = np.log(np.asarray(sizes, dtype=float)), np.asarray(logs, dtype=float)
    if len(x) == 0 or np.any(x == 0.0):
        raise ValueError("the exponent needs sizes other than that of the reference")
    own = np.asarray(errors, dtype=float)
    if np.all(np.isfinite(own)) and np.isfinite(reference_error) and np.all(own > 0.0):
        weights = np.linalg.inv(np.diag(own**2) + reference_error**2)
        curvature = x @ weights @ x
        return Value(float(x @ weights @ y / curvature), float(1.0 / np.sqrt(curvature)))
    value = float(x @ y / (x @ x))
    rest = y - value * x
    error = np.sqrt(rest @ rest / (len(x) - 1) / (x @ x)) if len(x) > 1 else np.nan
    return Value(value, float(error))


def best_factors(factors: Sequence[float], responses: Sequence[Sequence[float]],
                 target: Union[float, Sequence[float]]) -> Tuple[List[float], float]:
    """Of each packing log of the factor at which its response is the target, on a straight line of
    log(response) over log(factor), and the slope of these lines, the mean over the packings: what a
    single one scatters by would be in both.

    :param responses: of each packing, in the order of the factors
    :param target: one for all packings, or of each packing
    """
    x, y = np.log(factors), np.log(np.asarray(responses, dtype=float))
    line = float(np.mean([slope(x, row).value for row in y]))
    if line == 0.0:
        raise ValueError("the response does not depend on the factor")
    return list(x.mean() + (np.log(target) - y.mean(axis=1)) / line), line


def pooled(values: Sequence[Value]) -> List[Value]:
    """The same with one error for all, the root mean square of theirs: with a few seeds each, the errors
    themselves scatter too much to serve as weights."""
    error = float(np.sqrt(np.mean([v.error**2 for v in values])))
    return [Value(v.value, error) for v in values]


@dataclass(frozen=True)
class Proportion:
    """y = constant x, how much y/x scatters (standard deviation in %), and the exponent of y
    over x when it is free."""

    constant: float
    scatter_percent: float
    exponent: Optional[Value]


def proportion(x: Sequence[float], y: Sequence[float]) -> Proportion:
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    ratios = y / x
    scatter = 100.0 * float(np.std(ratios, ddof=1) / ratios.mean()) if len(x) > 1 else float("nan")
    free = exponent(x, y) if len(x) > 2 and np.ptp(x) > 0.0 else None
    return Proportion(float(x @ y / (x @ x)), scatter, free)

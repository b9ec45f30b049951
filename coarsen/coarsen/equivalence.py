# SPDX-License-Identifier: GPL-2.0-only
"""Whether two diameters give the same, decided by two one-sided tests.

A difference that is not significant says nothing about equality: with few packings everything is
"not significantly different". So the burden is turned round (Schuirmann, J. Pharmacokinet. Biopharm.
15 (1987) 657): two diameters are equivalent when the 90% confidence interval of their difference lies
within the tolerance, which is when both one-sided tests at 5% reject a difference beyond it.
Differences are relative, taken seed by seed where both have the seed.
"""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np
from scipy import stats

#: Of each one-sided test; the interval has twice of it outside.
LEVEL = 0.05
#: With which a number of seeds is to show equivalence where there is one.
POWER = 0.8
MOST_SEEDS = 1000

EQUIVALENT, DIFFERENT, OPEN = "equivalent", "different", "undecided"


@dataclass(frozen=True)
class Verdict:
    """`difference` with its `low` and `high` of the 90% interval, and `error` (standard), all relative;
    `needed` seeds in all would decide with a power of 0.8 were the difference what it seems (0 where it
    is decided, `MOST_SEEDS` where they would not suffice)."""

    verdict: str
    difference: float
    error: float
    low: float
    high: float
    tolerance: float
    seeds: int
    needed: int


def compare(coarse: Sequence[float], fine: Sequence[float], tolerance: float, paired: bool) -> Verdict:
    """Of the means of positive numbers, as log(coarse/fine), so that twice and half are as far.

    :param coarse: one number a packing; with `paired` in the order of `fine`
    :param tolerance: largest relative difference that counts as the same, above 0 and below 1
    :raise ValueError: for numbers that are not positive, or fewer than two of them, or a tolerance
        that is not between 0 and 1
    """
    one, other = (np.log(_positive(values)) for values in (coarse, fine))
    if paired:
        if len(one) != len(other):
            raise ValueError(f"{len(one)} and {len(other)} numbers are no pairs")
        apart = one - other
        difference, error = float(apart.mean()), float(apart.std(ddof=1) / math.sqrt(len(apart)))
        freedom, seeds = len(apart) - 1.0, len(apart)
    else:
        parts = [values.var(ddof=1) / len(values) for values in (one, other)]
        difference, error = float(one.mean() - other.mean()), math.sqrt(sum(parts))
        # Welch's degrees of freedom
        freedom = (sum(parts)**2 / sum(p**2 / (len(v) - 1) for p, v in zip(parts, (one, other)))
                   if error > 0.0 else len(one) + len(other) - 2.0)
        seeds = min(len(one), len(other))
    return judge(difference, error, freedom, tolerance, seeds)


def judge(difference: float, error: float, freedom: float, tolerance: float, seeds: int) -> Verdict:
    """Of a difference of logarithms, its standard error and that error's degrees of freedom.

    :raise ValueError: for a tolerance that is not between 0 and 1
    """
    if not 0.0 < tolerance < 1.0:
        raise ValueError(f"tolerance is {tolerance:g}, allowed is more than 0 and less than 1")
    reach = error * stats.t.ppf(1.0 - LEVEL, freedom)
    low, high = difference - reach, difference + reach
    # The same factor up and down, as logs have it.
    within = math.log1p(tolerance)
    if -within < low and high < within:
        verdict = EQUIVALENT
    elif low > within or high < -within:
        verdict = DIFFERENT
    else:
        verdict = OPEN
    needed = 0 if verdict != OPEN else _needed(abs(difference), error * math.sqrt(seeds), within, seeds)
    return Verdict(verdict, math.expm1(difference), error, math.expm1(low), math.expm1(high), tolerance,
                   seeds, needed)


def _needed(difference: float, scatter: float, within: float, seeds: int) -> int:
    """Seeds with which the interval would be clear of the tolerance, on the side that the difference is on, with the
    power asked for. Equivalence takes both tests to reject, so that both may fail."""
    counts = np.arange(max(2, seeds + 1), MOST_SEEDS)
    error, quantile = scatter / np.sqrt(counts), stats.t.ppf(1.0 - LEVEL, counts - 1)
    far = stats.t.cdf((within + difference) / error - quantile, counts - 1) if difference < within else 1.0
    enough = stats.t.cdf(abs(within - difference) / error - quantile, counts - 1) + far - 1.0 >= POWER
    return int(counts[enough][0]) if enough.any() else MOST_SEEDS


def _positive(values: Sequence[float]) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    if len(array) < 2:
        raise ValueError(f"{len(array)} packings, needed are 2 or more of each diameter")
    if not np.all(np.isfinite(array) & (array > 0.0)):
        raise ValueError(f"numbers to compare are {array}, allowed are those above 0")
    return array

# SPDX-License-Identifier: GPL-2.0-only
"""Medians of paired ratios, for which Python alone will do, and powers fitted to points, for which NumPy is needed."""
from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import TYPE_CHECKING, Dict, Hashable, List, Mapping, Sequence

if TYPE_CHECKING:
    import numpy as np


@dataclass(frozen=True)
class Median:
    """A median and the quartiles around it."""

    value: float
    low: float
    high: float
    count: int

    def text(self, digits: int = 3) -> str:
        return f"{self.value:.{digits}f} [{self.low:.{digits}f}, {self.high:.{digits}f}]"


def median(values: Sequence[float]) -> Median:
    if not len(values):
        raise ValueError("a median of nothing")
    several = values if len(values) > 1 else [*values] * 2
    low, middle, high = statistics.quantiles(map(float, several), n=4, method="inclusive")
    return Median(middle, low, high, len(values))


def column(rows: Sequence[Mapping], name: Hashable, by: str, value: str) -> Dict[int, float]:
    """`value` for each round, from the rows where `by` is `name`."""
    return {row["round"]: float(row[value]) for row in rows if row[by] == name}


def paired_ratios(rows: Sequence[Mapping], name: Hashable, reference: Hashable, by: str,
                  value: str) -> List[float]:
    """One ratio a round, of two consecutive runs: a slow phase of the machine slows both.

    :param rows: each has a `round`
    """
    ours, theirs = (column(rows, which, by, value) for which in (name, reference))
    return [ours[k] / theirs[k] for k in sorted(ours) if k in theirs]


@dataclass(frozen=True)
class Power:
    """y = factor x^exponent"""

    exponent: float
    factor: float
    error: float    #: standard error of the exponent; not a number for two points

    def at(self, x: np.ndarray) -> np.ndarray:
        import numpy as np

        return self.factor * np.asarray(x, dtype=float) ** self.exponent


def fit_power(x: Sequence[float], y: Sequence[float]) -> Power:
    """Least squares of logarithms."""
    import numpy as np

    u, v = np.log(np.asarray(x, dtype=float)), np.log(np.asarray(y, dtype=float))
    if len(u) < 2:
        raise ValueError("a power needs two points")
    du = u - u.mean()
    exponent = float((du * v).sum() / (du * du).sum())
    rest = v - v.mean() - exponent * du
    error = (math.sqrt(float((rest * rest).sum()) / (len(u) - 2) / float((du * du).sum()))
             if len(u) > 2 else float("nan"))
    return Power(exponent, math.exp(float(v.mean() - exponent * u.mean())), error)

# SPDX-License-Identifier: GPL-2.0-only
"""Whether a coarser diameter gives what a finer one gives, from runs of a user's own in-file.

The in-file takes the variables d, seed and out (-var), writes its files into the folder ${out}, and
prints a line for each quantity to be compared:

    print "Result strength $(v_strength)"

A quantity is equivalent when the 90% interval of its difference lies within the tolerance
(equivalence.py), and diameters are when all quantities are. With three diameters or more a trend over d
is looked for; where there is one, coarse runs are compared with the straight line's value at the real
diameter instead of with the finest that was run.
"""
from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterable, List, Optional

import numpy as np
import pandas as pd
from scipy import stats

from .equivalence import DIFFERENT, EQUIVALENT, LEVEL, OPEN, compare, judge

_RESULT = re.compile(r"^Result (\S+) (\S+)\s*$", re.MULTILINE)


class NothingToCompare(ValueError):
    """The runs do not say what is to be compared; the message says what is missing where."""


def read_results(folder: Path, needed: bool = True) -> Dict[str, float]:
    """The quantities that a run's log has `Result` lines of.

    :raise NothingToCompare: with one that is no number, or without any where they are needed
    """
    log = (folder / "log.lammps").read_text(encoding="utf-8", errors="replace")
    found: Dict[str, float] = {}
    for name, text in _RESULT.findall(log):
        try:
            found[name] = float(text)
        except ValueError as error:
            raise NothingToCompare(f"{folder}: result {name} is {text}, allowed is a number") from error
    if needed and not found:
        raise NothingToCompare(f"{folder}: log.lammps has no line `Result NAME NUMBER`: let the in-file "
                               'print them, as in print "Result strength $(v_strength)"')
    return found


def verdicts(results: pd.DataFrame, tolerance: Dict[str, float], real: Optional[float] = None,
             paired: bool = True) -> pd.DataFrame:
    """A row for each quantity and coarser diameter: its difference from the finest, or from what a trend
    gives at the real diameter, and the verdict.

    :param results: columns d, seed and the quantities, all above 0
    :param tolerance: largest relative difference, by quantity; other quantities are not judged
    :param real: diameter that a trend is followed to (m), the finest that was run if none
    :param paired: whether runs of a seed have the same packing in some sense, so that differences are
        taken seed by seed
    """
    finest = results["d"].min()
    rows: List[Dict[str, object]] = []
    for quantity, allowed in tolerance.items():
        if quantity not in results:
            raise NothingToCompare(f"no run has the result {quantity}; there are "
                                   f"{', '.join(c for c in results if c not in ('d', 'seed'))}")
        table = results.pivot(index="seed", columns="d", values=quantity)
        trend = trend_of(table)
        for diameter in [d for d in table if d > finest]:
            both = table[[diameter, finest]].dropna() if paired else table[[diameter, finest]]
            if trend is None:
                against = finest
                verdict = compare(both[diameter].dropna(), both[finest].dropna(), allowed, paired)
            else:
                against = finest if real is None else real
                verdict = judge(trend.slope * (diameter - against), trend.error * (diameter - against),
                                trend.freedom, allowed, len(both.dropna()))
            rows.append({"quantity": quantity, "d": diameter, "against": against,
                         "trend": trend is not None, **vars(verdict)})
    return pd.DataFrame(rows)


@dataclass(frozen=True)
class Trend:
    """log of a quantity over diameter, a straight line: its slope (1/m), the slope's standard error and
    degrees of freedom."""

    slope: float
    error: float
    freedom: int


def trend_of(table: pd.DataFrame) -> Optional[Trend]:
    """Of a quantity over three diameters or more; none where a straight line's slope could be chance.

    :param table: a row a seed, a column a diameter
    """
    if table.shape[1] < 3:
        return None
    points = np.log(table).stack()
    line = stats.linregress(points.index.get_level_values("d").astype(float), points)
    return Trend(line.slope, line.stderr, len(points) - 2) if line.pvalue < LEVEL else None


def overall(verdicts_: Iterable[str]) -> str:
    """All equivalent; or one different; or undecided."""
    seen = set(verdicts_)
    return EQUIVALENT if seen <= {EQUIVALENT} else DIFFERENT if DIFFERENT in seen else OPEN


def resample(results: pd.DataFrame, quantity: str, coarse: float, fine: float, seeds: int, count: int,
             tolerance: float, paired: bool, seed: int = 1) -> pd.Series:
    """How often each verdict comes out when `seeds` packings of those that there are, are drawn without
    repeating one, `count` times: false verdicts are counted so."""
    table = results.pivot(index="seed", columns="d", values=quantity)[[coarse, fine]].dropna()
    random = np.random.default_rng(seed)
    found: List[str] = []
    for _ in range(count):
        drawn = table.sample(seeds, random_state=random)
        other = drawn if paired else table.sample(seeds, random_state=random)
        found.append(compare(drawn[coarse], other[fine], tolerance, paired).verdict)
    return pd.Series(found).value_counts().reindex([EQUIVALENT, OPEN, DIFFERENT], fill_value=0)


def table_text(found: pd.DataFrame) -> str:
    """For people, a line a verdict."""
    lines = [f"{'quantity':<24}{'d (mm)':>8} {'difference':>11}  {'90% interval':<20}{'allowed':>8}  verdict"]
    for row in found.itertuples():
        against = (f", against {1e3 * row.against:g} mm by the trend over diameters" if row.trend else "")
        more = (f", {row.needed} seeds would decide" if 0 < row.needed < 1000 else
                ", it lies at the limit itself" if row.needed else "")
        lines.append(f"{row.quantity:<24}{1e3 * row.d:>8.4g} {100 * row.difference:>+10.2f}%  "
                     f"{f'[{100 * row.low:+.2f}, {100 * row.high:+.2f}]%':<20}"
                     f"{100 * row.tolerance:>7g}%  {row.verdict}{more}{against}")
    return "\n".join(lines)

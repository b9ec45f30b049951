# SPDX-License-Identifier: GPL-2.0-only
"""Whether a coarser diameter gives what a finer one gives, from runs of a user's own in-file.

The in-file takes the variables d, seed and out (-var), writes its files into the folder ${out}, and
prints a line for each quantity to be compared:

    print "Result strength $(v_strength)"

A quantity is equivalent when the 90% interval of its difference lies within the tolerance
(equivalence.py), and diameters are when all quantities are. Coarse runs are compared with the finest that was
run; with a real diameter that is finer still, and three diameters or more, with what a straight line over d
gives there, whether or not its slope is significant: what a slope of chance may be is in the interval. Where the
means lie on no straight line, or there are two diameters, nothing is extrapolated: the verdict is undecided, or
different where the runs differ among themselves.
"""
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Dict, Iterable, List, Optional

import numpy as np
import pandas as pd
from scipy import stats

from .equivalence import DIFFERENT, EQUIVALENT, LEVEL, OPEN, compare, judge


class NothingToCompare(ValueError):
    """The runs do not say what is to be compared; the message says what is missing where."""


def verdicts(results: pd.DataFrame, tolerance: Dict[str, float], real: Optional[float] = None,
             paired: bool = True) -> pd.DataFrame:
    """A row for each quantity and coarser diameter: its difference from the finest, or from what a straight line
    gives at the real diameter, and the verdict.

    :param results: columns d, seed and the quantities, all above 0
    :param tolerance: largest relative difference, by quantity; other quantities are not judged
    :param real: diameter that coarse runs shall stand for, the finest that was run if none
    :param paired: whether runs of a seed have the same packing in some sense, so that differences are
        taken seed by seed
    :raise NothingToCompare: where a quantity is missing, or nothing depends on the seed
    """
    missing = [quantity for quantity in tolerance if quantity not in results]
    if missing:
        raise NothingToCompare(f"no run has the result {missing[0]}; there are "
                               f"{', '.join(c for c in results if c not in ('d', 'seed'))}")
    wanted = list(tolerance)
    # one that is may be a count
    if (results.groupby("d")[wanted].nunique() <= 1).all(axis=None):
        raise NothingToCompare(f"{', '.join(wanted)}: the same at every seed, to the last digit: does the in-file use "
                               "its variable seed?")
    if real is not None and real > results["d"].max():
        raise NothingToCompare(f"the real diameter is {real:g}, allowed are those up to the coarsest that was run, {results['d'].max():g}")
    for quantity in wanted:
        values = results[quantity].dropna()
        few = [d for d, count in results.groupby("d")[quantity].count().items() if count < 2]
        if few:
            raise NothingToCompare(f"{quantity}: of diameter {few[0]:g} fewer than two runs have it")
        if not np.all(np.isfinite(values) & (values > 0.0)):
            raise NothingToCompare(f"{quantity}: of the results {', '.join(f'{v:g}' for v in values)} all must be numbers above 0")
    rows: List[Dict[str, object]] = []
    for quantity, allowed in tolerance.items():
        table = results.pivot(index="seed", columns="d", values=quantity)
        finest = table.columns.min()
        line = line_through(table, paired) if real is not None and not np.isclose(real, finest) else None
        for diameter in [d for d in table if d > finest]:
            if line is not None and line.is_straight:
                step = diameter - real
                verdict = judge(line.slope * step, line.error * abs(step), line.freedom, allowed, line.seeds)
            else:
                both = table[[diameter, finest]].dropna() if paired else table[[diameter, finest]]
                verdict = compare(both[diameter].dropna(), both[finest].dropna(), allowed, paired)
                if real is not None and not np.isclose(real, finest):
                    # it says nothing on the real diameter, and more seeds would not either
                    verdict = replace(verdict, verdict=DIFFERENT if verdict.verdict == DIFFERENT else OPEN, needed=0)
            extrapolated = line is not None and line.is_straight
            rows.append({"quantity": quantity, "d": diameter, "against": real if extrapolated else finest,
                         "trend": bool(extrapolated and line.probability < LEVEL), **vars(verdict)})
    return pd.DataFrame(rows)


@dataclass(frozen=True)
class Line:
    """log of a quantity over diameter: slope (1/m), its standard error and degrees of freedom, the probability
    that a slope so large is chance, whether the means lie on the line within the scatter of the seeds, and of how many
    seeds it is."""

    slope: float
    error: float
    freedom: int
    probability: float
    is_straight: bool
    seeds: int


def line_through(table: pd.DataFrame, paired: bool = False) -> Optional[Line]:
    """None with fewer than three diameters or two seeds.

    :param table: a row a seed, a column a diameter
    :param paired: each seed has a line of its own, and all of them one slope: what is peculiar to a seed is none of its
        scatter. Seeds that lack a diameter are left out
    """
    logs = np.log(table.dropna() if paired else table)
    if table.shape[1] < 3 or len(logs) < 2:
        return None
    seeds = len(logs) if paired else 1    # lines
    points = logs.sub(logs.mean(axis=1), axis=0).stack() if paired else logs.stack()
    x = points.index.get_level_values("d").to_numpy(float)
    fit = stats.linregress(x, points)
    rest = points - fit.intercept - fit.slope * x
    freedom = len(points) - seeds - 1
    error = float(np.sqrt((rest**2).sum() / freedom / ((x - x.mean())**2).sum()))
    groups = rest.groupby(level="d")
    between = (groups.size() * groups.mean()**2).sum() / (table.shape[1] - 2)
    inner = freedom - (table.shape[1] - 2)
    within = ((rest - groups.transform("mean"))**2).sum() / inner
    straight = stats.f.sf(between / within, table.shape[1] - 2, inner) >= LEVEL
    chance = 2.0 * stats.t.sf(abs(fit.slope) / error, freedom) if error > 0.0 else 0.0
    return Line(fit.slope, error, freedom, float(chance), bool(straight), len(logs))


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
    lines = [f"{'quantity':<24}{'d':>10} {'against':>10} {'difference':>11}  {'90% interval':<20}{'allowed':>8}  verdict"]
    for row in found.itertuples():
        more = (f", {row.needed} seeds would decide" if 0 < row.needed < 1000 else
                ", it lies at the limit itself" if row.needed else "")
        lines.append(f"{row.quantity:<24}{row.d:>10.4g} {row.against:>10.4g} {100 * row.difference:>+10.2f}%  "
                     f"{f'[{100 * row.low:+.2f}, {100 * row.high:+.2f}]%':<20}"
                     f"{100 * row.tolerance:>7g}%  {row.verdict}{more}{', with a trend over d' if row.trend else ''}")
    return "\n".join(lines)

# SPDX-License-Identifier: GPL-2.0-only
"""What is known of errors of coarse particles, and what it predicts.

Evidence is a table of slopes: how the logarithm of a quantity changes with a dimensionless number, in one
study of one powder. A prediction for another powder takes the mean of these slopes over the studies, with
the scatter between them (a random-effects mean; DerSimonian and Laird, Control. Clin. Trials 7 (1986)
177), since that powder is one more draw from the same lot. Numbers act independently of each other.
"""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Dict, Iterable, List, Mapping, Sequence, Tuple

import numpy as np
import pandas as pd
import statsmodels.api as sm
from scipy import stats
from statsmodels.stats.meta_analysis import combine_effects

TABLE = Path(__file__).resolve().parent / "evidence.csv"
#: What errors depend on, and how it is called to people.
NUMBERS = {"narrowness": "d/W, diameter over width", "inertia": "I, inertial number",
           "overlap": "delta/d, overlap over diameter", "weight": "1/Bo, weight over attraction",
           "bed": "weight of the bed over the lowest stress"}
#: Up to here a number needs no evidence: below an inertial number of 1e-3 flow is quasi-static (MiDi, Eur. Phys.
#: J. E 14 (2004) 341); a bed that weighs 3% of the stress changes strain, which depends on it most, by less than 1% (slope
#: of the study of loose starts: 0.21). Where there is evidence, it is taken.
HARMLESS = {"inertia": 1e-3, "bed": 0.03}
#: Largest change of a logarithm that is told.
MOST_LOG = 20.0
#: Probability outside the interval of a prediction.
OUTSIDE = 0.1


def slopes_of(runs: pd.DataFrame, study: str, quantities: Iterable[str], numbers: Sequence[str],
              family: str = "", paired: bool = False, included: Mapping[str, float] = MappingProxyType({})) -> pd.DataFrame:
    """The slopes that one study gives, a row a quantity and number.

    :param runs: a row a run, or a mean of runs with its relative error in a column QUANTITY_error;
        columns of the quantities (above 0) and of the numbers. A number that does not vary gives no row.
    :param paired: whether runs of a seed have one packing whatever the numbers, so that its scatter is none of
        theirs
    :param included: other numbers that went with the first of `numbers` and are in its slope, with their largest
        values
    :param family: of studies whose packings are the same (the study itself if none): they have one
        another's errors
    """
    rows: List[Dict[str, object]] = []
    for quantity in quantities:
        if quantity not in runs:
            continue
        known = runs[runs[quantity].notna()]
        varying = [n for n in numbers if known[n].nunique() > 1]
        if len(known) < 2 + len(varying) or not varying:
            continue
        x, y = sm.add_constant(known[varying].astype(float)), np.log(known[quantity].astype(float))
        if paired:
            x = x.join(pd.get_dummies(known["seed"], prefix="seed", drop_first=True, dtype=float))
        if f"{quantity}_error" in known:
            fit = sm.WLS(y, x, weights=known[f"{quantity}_error"].astype(float)**-2.0).fit(
                cov_type="fixed scale")
        else:
            fit = sm.OLS(y, x).fit()
        means = pd.DataFrame({"rest": y - fit.predict(x), **known[varying]}).groupby(varying)["rest"].mean()
        rows += [{"family": family or study, "study": study, "quantity": quantity, "number": number, "slope": fit.params[number],
                  "error": fit.bse[number], "least": known[number].min(), "most": known[number].max(),
                  "misfit": float(np.sqrt(np.mean(means**2))),
                  "included": ";".join(f"{name}={most:g}" for name, most in included.items())}
                 for number in varying]
    return pd.DataFrame(rows)


@dataclass(frozen=True)
class Effect:
    """Of one number on one quantity: mean slope, its error, the scatter of slopes between studies, how many
    studies of packings of their own there are, the largest value of the number that any of them had, and how far means lie from straight lines."""

    slope: float
    error: float
    scatter: float
    studies: int
    most: float
    misfit: float

    def change(self, fine: float, coarse: float) -> Tuple[float, float]:
        """Of the logarithm of the quantity, from one value of the number to the other: mean and variance."""
        step = coarse - fine
        return self.slope * step, step**2 * (self.error**2 + self.scatter**2)


def effect(table: pd.DataFrame, quantity: str, number: str) -> Effect:
    """:raise KeyError: without evidence for the two"""
    rows = table[(table["quantity"] == quantity) & (table["number"] == number)]
    if rows.empty:
        raise KeyError(f"no evidence how {quantity} depends on {NUMBERS[number]}")
    # Studies of the same packings count once, with an error of one of them.
    once = rows.groupby("family").agg(slope=("slope", "mean"), error=("error", _root_mean_square),
                                      within=("slope", lambda x: x.var(ddof=1) if len(x) > 1 else np.nan))
    within = float(np.nan_to_num(once["within"].mean()))
    known = (len(once), float(rows["most"].max()), _root_mean_square(rows["misfit"]))
    if len(once) == 1:
        return Effect(once["slope"].iloc[0], once["error"].iloc[0], math.sqrt(within), *known)
    with np.errstate(invalid="ignore"):  # it takes the root of a scatter below zero, too
        pooled = combine_effects(once["slope"].to_numpy(), once["error"].to_numpy()**2, method_re="dl")
    if pooled.tau2 <= 0.0:  # they scatter less than their errors say
        return Effect(float(pooled.mean_effect_fe), float(pooled.sd_eff_w_fe), math.sqrt(within), *known)
    return Effect(float(pooled.mean_effect_re), float(pooled.sd_eff_w_re), math.sqrt(pooled.tau2 + within), *known)


def included(table: pd.DataFrame, quantity: str) -> Dict[str, float]:
    """Numbers whose effect on a quantity is in its slopes over other numbers, with the largest values seen."""
    found: Dict[str, float] = {}
    for text in table.loc[table["quantity"] == quantity, "included"].dropna():
        for part in filter(None, str(text).split(";")):
            name, _, most = part.partition("=")
            found[name] = max(found.get(name, 0.0), float(most))
    return found


def _root_mean_square(values: pd.Series) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


@dataclass(frozen=True)
class Prediction:
    """Error of coarse particles, relative: mean and 90% interval; what is outside the evidence, by name."""

    error: float
    low: float
    high: float
    outside: Tuple[str, ...]


def predict(table: pd.DataFrame, quantity: str, changes: Mapping[str, Tuple[float, float]],
            of_coefficients: float = 0.0) -> Prediction:
    """:param changes: numbers of the real and of the coarse particles, by name
    :param of_coefficients: relative error that the coefficients leave in the quantity
    """
    total, variance, outside = 0.0, of_coefficients**2, []
    spread_of_freedom = 0.0  # variances squared over their degrees of freedom
    for number, (fine, coarse) in changes.items():
        if math.isclose(fine, coarse, rel_tol=1e-9):
            # no effect, but no study either, where none went so far
            seen = table.loc[table["number"] == number, "most"]
            most = max([included(table, quantity).get(number, 0.0), HARMLESS.get(number, 0.0), *seen])
            if len(seen) and fine > most * (1.0 + 1e-9):
                outside.append(f"{NUMBERS[number]} of {fine:.3g}, the studies end at {most:.3g}")
            continue
        try:
            found = effect(table, quantity, number)
        except KeyError as error:
            within = included(table, quantity).get(number, 0.0)
            if max(fine, coarse) > max(HARMLESS.get(number, 0.0), within):
                outside.append(f"{NUMBERS[number]} of {max(fine, coarse):.3g}, evidence for {quantity} ends at {within:.3g}"
                               if within else str(error.args[0]))
            continue
        if max(fine, coarse) > found.most * (1.0 + 1e-9):
            outside.append(f"{NUMBERS[number]} of {max(fine, coarse):.3g}, evidence for {quantity} ends at "
                           f"{found.most:.3g}")
        mean, spread = found.change(fine, coarse)
        part = spread + found.misfit**2
        total, variance = total + mean, variance + part
        spread_of_freedom += part**2 / max(1, found.studies - 1)
    # Welch and Satterthwaite: a small part that is badly known does not make the whole badly known
    freedom = variance**2 / spread_of_freedom if spread_of_freedom > 0.0 else math.inf
    reach = math.sqrt(variance) * (stats.t.ppf(1.0 - OUTSIDE / 2.0, freedom) if math.isfinite(freedom) else
                                   stats.norm.ppf(1.0 - OUTSIDE / 2.0))
    # what is far outside has no number
    error, low, high = (math.expm1(min(max(x, -MOST_LOG), MOST_LOG)) for x in (total, total - reach, total + reach))
    return Prediction(error, low, high, tuple(outside))


def read(path: Path = TABLE) -> pd.DataFrame:
    return pd.read_csv(path, comment="#")

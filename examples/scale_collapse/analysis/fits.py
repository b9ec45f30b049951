# SPDX-License-Identifier: GPL-2.0-only
"""Fits to the kinds of specimens: exponents of the coefficients left free, strength over the contacts'
attraction, flow function, time over diameter. Errors are standard errors."""
from __future__ import annotations

from dataclasses import dataclass
from typing import List, Optional, Tuple

import numpy as np
import pandas as pd
import statsmodels.api as sm

from .tables import is_varied

#: What a coefficient is multiplied by to find the one that fits the finest particles best, as in the names of
#: groups: base-stiffness0.8 and so on.
FACTORS = (0.8, 1.25)


@dataclass(frozen=True)
class Free:
    """A coefficient that is left free: the material that it is varied in, the word of its groups' names, the
    law's exponent, and the quantity that is to be that of the finest particles."""

    what: str
    material: str
    word: str
    expected: float
    quantity: str


@dataclass(frozen=True)
class Exponent:
    """Of a coefficient over d: of each diameter log(best coefficient over that of the finest) with its error,
    and the slope. `equal_width`: the finest particles are in specimens as many diameters wide."""

    free: Free
    equal_width: bool
    finest: float
    diameters: List[float]
    logs: List[float]
    errors: List[float]
    value: float
    error: float
    #: whether a best factor lies beyond those that were run
    extrapolated: bool


def exponent(runs: pd.DataFrame, free: Free, equal_width: bool) -> Optional[Exponent]:
    """For each seed a line of log response over log factor; where it reaches the response of the finest
    particles is the best factor of that seed. None without the runs for it."""
    scaled = runs[(runs["mode"] == "scaled") & ~runs["special"].str.contains("/s")]
    own = scaled[scaled["group"].str.split("-").str[0] == free.material]
    varied = own[own["group"].str.contains(f"-{free.word}", regex=False)]
    plain = own[~is_varied(own)]
    finest = plain["d"].min()
    rows: List[Tuple[float, float, float, float, bool]] = []
    for d in sorted(set(varied["d"])):
        coarse = plain[np.isclose(plain["d"], d) & (plain["special"] == "")]
        fine = plain[np.isclose(plain["d"], finest)]
        fine = (fine[np.isclose(fine["side"] / finest, (coarse["side"] / d).iloc[0])] if equal_width
                else fine[fine["special"] == ""])
        wanted = fine.set_index("seed")[free.quantity].dropna()
        series = pd.DataFrame({1.0: coarse.set_index("seed")[free.quantity], **{
            factor: varied[np.isclose(varied["d"], d) & varied["group"].str.endswith(f"-{free.word}{factor:g}")]
            .set_index("seed")[free.quantity] for factor in FACTORS}}).dropna()
        if equal_width:
            series = series[series.index.isin(wanted.index)]
        if series.empty or wanted.empty:
            continue
        factors = np.log(series.columns.to_numpy(float))
        responses = np.log(series.to_numpy())
        # One slope for all: what a single one scatters by would be in both.
        slope = float(np.mean([np.polyfit(factors, row, 1)[0] for row in responses]))
        target = np.log(wanted.loc[series.index].to_numpy() if equal_width else wanted.mean())
        best = factors.mean() + (target - responses.mean(axis=1)) / slope
        common = 0.0 if equal_width else wanted.sem() / wanted.mean() / abs(slope)
        rows.append((d, float(best.mean()), float(best.std(ddof=1) / np.sqrt(len(best))) if len(best) > 1
                     else np.nan, common, not factors.min() <= best.mean() <= factors.max()))
    if not rows:
        return None
    table = pd.DataFrame(rows, columns=["d", "log", "error", "common", "beyond"])
    x = np.log(table["d"] / finest)
    logs = table["log"] + free.expected * x
    # With a few seeds each, the errors scatter too much to serve as weights.
    error = float(np.sqrt(np.mean(table["error"]**2)))
    known = np.isfinite(error) and error > 0.0
    common = float(np.nan_to_num(table["common"].mean())) if known else 0.0
    spread = np.eye(len(x)) * (error if known else 1.0)**2 + common**2
    fit = sm.GLS(logs, x, sigma=spread).fit(cov_type="fixed scale")
    return Exponent(free, equal_width, finest, list(table["d"]), list(logs), [error] * len(table),
                    float(fit.params.iloc[0]), float(fit.bse.iloc[0]) if known else error, bool(table["beyond"].any()))


def pull_off(runs: pd.DataFrame, level: str) -> pd.Series:
    """Largest attraction (N) of a contact with the mean plastic overlap before crushing. `linear`: where the
    k2 line meets the adhesive branch; `plateau`: just before the plateau."""
    size = np.where(runs["scaled"] == "yes", runs["d"] / runs["dref"], 1.0)
    part = np.where(runs["law"] == "linear", runs["k2"] / (runs["k2"] + runs["kadh"]), 1.0)
    return size * runs["kadh"] * part * runs[f"plastic_overlap_{level}"] - size**2 * runs["f0"]


def strength_points(runs: pd.DataFrame, levels: List[str]) -> pd.DataFrame:
    """sigma_u d^2/f_at (`strength`) against Z (1 - n) (`packing`), a row a kind and level, with errors: Thakur et
    al., Granular Matter 16 (2014) 383. Specimens of a kind are of the same packings, so that the error of a fit through all
    points is rather too small."""
    usual = runs[(runs["special"] == "") & ~is_varied(runs)]
    parts = []
    for level in levels:
        if f"strength_{level}" not in usual:
            continue
        some = usual[usual[f"strength_{level}"].notna()]
        parts.append(pd.DataFrame({
            **{name: some[name] for name in ("material", "mode", "d")}, "level": level, "plastic": some["kadh"] > 0.0,
            "packing": some[f"coordination_unloaded_{level}"] * (1.0 - some[f"porosity_unloaded_{level}"]),
            "strength": some[f"strength_{level}"] * some["d"]**2 / pull_off(some, level)}))
    points = pd.concat(parts).groupby(["material", "mode", "d", "level", "plastic"])
    return points.mean().join(points.sem(), rsuffix="_error").reset_index()


def proportion(points: pd.DataFrame) -> Tuple[float, float]:
    """Constant of strength over packing, and the scatter of their ratio in %."""
    ratios = points["strength"] / points["packing"]
    constant = (points["strength"] @ points["packing"]) / (points["packing"] @ points["packing"])
    return float(constant), float(100.0 * ratios.std() / ratios.mean())


def flow_slopes(runs: pd.DataFrame, levels: List[str]) -> pd.DataFrame:
    """Rise of unconfined strength per consolidation stress of each usual kind: mean over the seeds' lines, error."""
    known = [level for level in levels if f"strength_{level}" in runs]
    some = runs[runs["special"] == ""]
    enough = some[[f"strength_{level}" for level in known]].notna().sum(axis=1) > 1
    stress = np.array([float(level) for level in known])

    def slope(row: pd.Series) -> float:
        good = row.notna().to_numpy()
        return float(np.polyfit(stress[good], row[good].astype(float), 1)[0])
    slopes = some[enough][[f"strength_{level}" for level in known]].apply(slope, axis=1)
    kinds = slopes.groupby([some.loc[slopes.index, name] for name in ("material", "mode", "d")])
    return pd.DataFrame({"slope": kinds.mean(), "error": kinds.sem()}).reset_index()


def speed_exponent(table: pd.DataFrame, mode: str) -> Optional[Tuple[float, float]]:
    """b of processor time of the test proportional to d^-b, of the base material; the finest, scaled kind belongs
    to both modes."""
    base = table[(table["material"] == "base") & (table["special"] == "")]
    some = base[(base["mode"] == mode) | ((base["mode"] == "scaled") & np.isclose(base["d"], base["reference"]))]
    if some["d"].nunique() < 3:
        return None
    fit = sm.OLS(np.log(some["test_seconds"]), sm.add_constant(np.log(some["d"]))).fit()
    return -float(fit.params.iloc[1]), float(fit.bse.iloc[1])

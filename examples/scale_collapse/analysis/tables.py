# SPDX-License-Identifier: GPL-2.0-only
"""From a row a run to a row a kind of specimen, with errors and deviations from the finest particles.

A kind is what seeds repeat: material (the group of the study file up to a dash), mode, diameter, and what is
special about it (width, rate). Groups whose coefficients are varied for the fits are materials of their own. `±` is the standard error over the seeds.
"""
from __future__ import annotations

from typing import List, Sequence, Tuple

import numpy as np
import pandas as pd

KIND = ["material", "mode", "special", "d"]
#: Points of a common grid of strain.
GRID = 200


def is_varied(runs: pd.DataFrame) -> pd.Series:
    """Whether a coefficient is multiplied by a factor, to find the one that fits best (fits.py)."""
    return runs["group"].str.contains(r"-(?:stiffness|kadh|f0)\d")


def with_kinds(runs: pd.DataFrame) -> pd.DataFrame:
    """Adds material, mode and special. Specimens of the most usual width and rate are not special."""
    side, rate = (float(runs[name].mode().iloc[0]) for name in ("side", "rate"))
    special = [", ".join(([f"{r:g}/s"] if r != rate else []) + ([f"{1e3 * w:g} mm wide"] if w != side else []))
               for r, w in zip(runs["rate"], runs["side"])]
    return runs.assign(material=runs["group"].where(is_varied(runs), runs["group"].str.split("-").str[0]),
                       special=special, mode=np.where(runs["scaled"] == "yes", "scaled", "unscaled"))


def means(runs: pd.DataFrame) -> pd.DataFrame:
    """Mean and standard error (NAME_error) of every number of each kind, its seeds, and the diameter of its
    reference: the finest scaled, usual specimens of its material."""
    numbers = runs.select_dtypes("number").columns.difference([*KIND, "seed"])
    kinds = runs.groupby(KIND)
    table = kinds[list(numbers)].mean().join(kinds[list(numbers)].sem(), rsuffix="_error")
    usual = runs[(runs["mode"] == "scaled") & (runs["special"] == "")]
    finest = usual.groupby("material")["d"].min()
    table = table.assign(seeds=kinds.size()).reset_index()
    return table.assign(reference=table["material"].map(finest))


def deviation_percent(table: pd.DataFrame, quantity: str) -> pd.DataFrame:
    """Columns `value` and `error`: of a quantity from that of each kind's reference, in %."""
    keys = pd.DataFrame({"material": table["material"], "mode": "scaled", "special": "", "d": table["reference"]})
    other = keys.merge(table, on=KIND, how="left").set_index(table.index)
    ratio = table[quantity] / other[quantity]
    error = np.hypot(table[f"{quantity}_error"] / other[quantity],
                     ratio * other[f"{quantity}_error"] / other[quantity])
    itself = (table[KIND] == keys[KIND]).all(axis=1)
    return pd.DataFrame({"value": 100.0 * (ratio - 1.0), "error": 100.0 * error})[~itself].reindex(table.index)


def curve_matrix(curves: pd.DataFrame, names: Sequence[str], branch: str, grid: np.ndarray, x: str = "strain",
                 y: str = "stress") -> np.ndarray:
    """y over x of runs on one grid, a row a run in the order of the names, without those that lack the branch."""
    own = curves[(curves["branch"] == branch) & curves["run"].isin(names)]
    by_run = {run: some.sort_values(x)[[x, y]].to_numpy().T for run, some in own.groupby("run")}
    return np.array([np.interp(grid, *by_run[name]) for name in names if name in by_run])


def reach(curves: pd.DataFrame, names: Sequence[str], branch: str, x: str = "strain") -> Tuple[float, float]:
    """Of x, what all runs have."""
    own = curves[(curves["branch"] == branch) & curves["run"].isin(names)].groupby("run")[x]
    return float(own.min().max()), float(own.max().min())


def curve_deviation(curves: pd.DataFrame, names: Sequence[str], others: Sequence[str], branch: str = "load",
                    paired: bool = False) -> Tuple[float, float, float]:
    """Root mean square distance of the mean curve from the others', its standard error, and the mean
    distance, in % of the others' peak over their common strain.

    :param paired: the k-th runs of both start from one packing, and the error is that of their differences
    """
    grid = np.linspace(*reach(curves, [*names, *others], branch), GRID)
    one, other = (curve_matrix(curves, some, branch, grid) for some in (names, others))
    apart = one.mean(axis=0) - other.mean(axis=0)
    if paired:
        squares = square_error(one - other)
    else:
        squares = square_error(one) + square_error(other)
    peak = 0.01 * np.abs(other.mean(axis=0)).max()
    return (float(np.sqrt(np.mean(apart**2)) / peak), float(np.sqrt(np.mean(squares)) / peak),
            float(apart.mean() / peak))


def square_error(rows: np.ndarray) -> np.ndarray:
    return rows.var(axis=0, ddof=1) / len(rows) if len(rows) > 1 else np.full(rows.shape[1], np.nan)


def names_of(runs: pd.DataFrame, **kind: object) -> List[str]:
    """Of the runs of a kind, or of several, in the order of their seeds."""
    chosen = runs
    for column, value in kind.items():
        chosen = chosen[np.isclose(chosen[column], value) if column == "d" else chosen[column] == value]
    return list(chosen.sort_values("seed").index)


def with_curve_deviations(table: pd.DataFrame, runs: pd.DataFrame, curves: pd.DataFrame) -> pd.DataFrame:
    """Adds `curve`, `curve_error` and `curve_mean`, the deviation of each kind's curve of loading from that of
    its reference, and `unloading`, that of stress over the strain recovered since the reversal. At another rate the
    reference are the same packings at the usual rate."""
    unload = curves[curves["branch"] == "unload"]
    recovered = unload.assign(strain=unload.groupby("run")["strain"].transform("first") - unload["strain"])
    rows = []
    for _, row in table.iterrows():
        own = {name: row[name] for name in KIND}
        other = {"material": row["material"], "mode": "scaled", "special": "", "d": row["reference"]}
        paired = "/s" in row["special"]
        if paired:
            other = {**own, "special": row["special"].partition("/s")[2].lstrip(", ")}
        names, others = names_of(runs, **own), names_of(runs, **other)
        if paired:
            seeds = set(runs.loc[names, "seed"]) & set(runs.loc[others, "seed"])
            names, others = ([n for n in some if runs.loc[n, "seed"] in seeds] for some in (names, others))
        rows.append((*curve_deviation(curves, names, others, paired=paired),
                     curve_deviation(recovered, names, others, "unload", paired)[0])
                    if others and own != other else (np.nan,) * 4)
    return table.join(pd.DataFrame(rows, columns=["curve", "curve_error", "curve_mean", "unloading"],
                                   index=table.index))


def twins(runs: pd.DataFrame, curves: pd.DataFrame, quantities: Sequence[str]) -> pd.DataFrame:
    """Coarse particles beside as many finer ones in specimens of as many diameters: packings of a seed differ
    in size only, so they are compared seed by seed. A row a pair of kinds, differences in %."""
    scaled = runs[runs["mode"] == "scaled"].assign(across=(runs["side"] / runs["d"]).round(6))
    rows = []
    for (material, across), same in scaled.groupby(["material", "across"]):
        kinds = sorted({(d, special) for d, special in zip(same["d"], same["special"]) if "/s" not in special})
        for fine in kinds:
            for coarse in kinds:
                if coarse[0] <= fine[0]:
                    continue
                pair = [same[(same["d"] == d) & (same["special"] == special)].reset_index().set_index("seed")
                        for d, special in (coarse, fine)]
                seeds = pair[0].index.intersection(pair[1].index)
                if len(seeds) < 2 or set(pair[0]["particles"]) != set(pair[1]["particles"]):
                    continue
                one, other = (some.loc[seeds] for some in pair)
                found = {"material": material, "across": across, "coarse": coarse[0], "fine": fine[0],
                         "seeds": len(seeds)}
                found["curve"], found["curve_error"], _ = curve_deviation(
                    curves, list(one["run"]), list(other["run"]), paired=True)
                for quantity in quantities:
                    percent = 100.0 * (one[quantity] / other[quantity] - 1.0)
                    found[quantity], found[f"{quantity}_error"] = percent.mean(), percent.sem()
                rows.append(found)
    return pd.DataFrame(rows)

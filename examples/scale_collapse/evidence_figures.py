# SPDX-License-Identifier: GPL-2.0-only
"""The figures of evidence.md."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Sequence, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first: there may be no display)
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402

from analysis import figures  # noqa: E402

COLOURS = figures.COLOURS[1:]  # without black
LABELS = {"strain": "strain", "porosity_before": "porosity before loading", "porosity": "porosity",
          "coordination": "coordination number", "bulk_modulus": "bulk modulus", "strength": "strength"}
#: Group of the runs, its variable, the number that it varies, how that is called, and whether its axis is
#: logarithmic.
LIMITS: Tuple[Tuple[str, str, str, str, bool], ...] = (
    ("width", "side", "narrowness", "d/W", False), ("inertia", "rate", "inertia", "inertial number", True),
    ("overlap", "k1", "overlap", "overlap δ/d (strain × k1, modulus ÷ k1)", False))


def _save(figure: plt.Figure, path: Path) -> None:
    for axis in figure.axes:
        axis.grid(alpha=0.25, linewidth=0.5)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def limits(runs: pd.DataFrame, path: Path) -> None:
    """Each quantity over its value at the smallest number, in %, over d/W, I and the overlap."""
    figure, axes = plt.subplots(1, len(LIMITS), figsize=(13.0, 4.2), constrained_layout=True)
    for axis, (group, variable, number, label, logarithmic) in zip(axes, LIMITS):
        some = runs[runs["group"] == group]
        if variable == "k1":  # strain goes with 1/k1 and modulus with k1, whatever the overlap
            some = some.assign(strain=some["strain"] * some["k1"], bulk_modulus=some["bulk_modulus"] / some["k1"])
        for colour, (quantity, name) in zip(COLOURS, LABELS.items()):
            means = some.groupby(variable)[[number, quantity]].agg(["mean", "sem"]).fillna(0.0)
            if means.empty:
                continue
            means = means.sort_values((number, "mean"))
            first = means[quantity]["mean"].iloc[0]
            axis.errorbar(means[number]["mean"], 100.0 * (means[quantity]["mean"] / first - 1.0),
                          100.0 * means[quantity]["sem"] / first, color=colour, marker="o", markersize=4,
                          capsize=2, label=name)
        axis.set_xlabel(label)
        if logarithmic:
            axis.set_xscale("log")
    axes[0].set_ylabel("difference from the leftmost (%)")
    axes[0].legend(fontsize=8, frameon=False)
    _save(figure, path)


def loose(runs: pd.DataFrame, curves: pd.DataFrame, path: Path) -> None:
    """Loose starts: porosity before loading over d by protocol, and the curves of each protocol."""
    runs = runs.assign(group=runs["group"].replace("loose_fine", "loose"))
    protocols: Dict[str, Sequence[str]] = {"scaled, gravity over s": ["loose"],
                                           "scaled, same gravity": ["loose", "loose_true_weight"],
                                           "unscaled": ["loose", "loose_unscaled"]}
    figure, axes = plt.subplots(2, 3, figsize=(13.0, 8.0), constrained_layout=True)
    for quantity, axis, label in zip(("rained_porosity", "porosity_before", "strength"), axes[0],
                                     ("porosity of the bed", "porosity before loading",
                                      "stress at 5% of crushing (Pa)")):
        for colour, (name, (usual, *own)) in zip(COLOURS, protocols.items()):
            finest = runs["d"] <= 1.001e-3
            some = runs[runs["group"].isin(own or [usual]) | ((runs["group"] == usual) & finest)]
            means = some.groupby("d")[quantity].agg(["mean", "sem"])
            axis.errorbar(1e3 * means.index, means["mean"], means["sem"].fillna(0.0), color=colour, marker="o",
                          capsize=3, label=name)
        axis.set_xlabel("d (mm)")
        axis.set_ylabel(label)
    axes[0][0].legend(fontsize=8, frameon=False)
    for axis, (name, (usual, *own)) in zip(axes[1], protocols.items()):
        for colour, d in zip(COLOURS, sorted(runs.loc[runs["group"] == usual, "d"].unique())):
            group = own[0] if own and d > 1.001e-3 else usual
            names: List[str] = list(runs.index[(runs["group"] == group) & np.isclose(runs["d"], d)])
            own_curves = curves[curves["run"].isin(names) & (curves["branch"] == "load")]
            if own_curves.empty:
                continue
            mean = own_curves.groupby(own_curves.groupby("run").cumcount())[["strain", "stress"]].mean()
            axis.plot(100.0 * mean["strain"], mean["stress"] / 1e3, color=colour, label=f"{1e3 * d:g} mm")
        axis.set_title(name, fontsize=10)
        axis.set_xlabel("axial strain (%)")
        axis.set_ylabel("axial stress (kPa)")
        axis.legend(fontsize=8, frameon=False)
    _save(figure, path)

# SPDX-License-Identifier: GPL-2.0-only
"""The figures of the studies. Each function draws one and writes it to a path."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Optional, Sequence

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first: there may be no display)
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402

from . import tables  # noqa: E402
from .fits import Exponent, proportion  # noqa: E402

#: Of a colour-blind reader (Okabe and Ito).
COLOURS = ("#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MODES = {"scaled": "#0072B2", "unscaled": "#D55E00"}


def _save(figure: plt.Figure, path: Path) -> None:
    for axis in figure.axes:
        axis.grid(alpha=0.25, linewidth=0.5)
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=8, frameon=False)
    figure.savefig(path, dpi=120)
    plt.close(figure)


def _errors(values: pd.Series, factor: float = 1.0) -> Optional[np.ndarray]:
    """For errorbar; nothing where a single seed gives none (which Matplotlib 3.6 can not draw)."""
    return factor * values.fillna(0.0).to_numpy() if values.notna().any() else None


def _columns(runs: pd.DataFrame, material: str) -> Dict[str, List[tuple]]:
    """Of each mode its kinds, by diameter: (mode, d); the finest, scaled one stands in every column."""
    same = runs[(runs["material"] == material) & (runs["special"] == "")]
    finest = same.loc[same["mode"] == "scaled", "d"].min()
    return {mode: sorted({("scaled", finest)} | {(mode, d) for d in same.loc[same["mode"] == mode, "d"]},
                         key=lambda kind: kind[1]) for mode in MODES if (same["mode"] == mode).any()}


def _colour(sizes: Sequence[float], kinds: Sequence[tuple], mode: str, own_mode: str, d: float) -> str:
    """By diameter; grey for the finest, scaled one where the column has that diameter itself."""
    return "#999999" if own_mode != mode and (mode, d) in kinds else COLOURS[list(sizes).index(d) % len(COLOURS)]


def _band(axis: plt.Axes, curves: pd.DataFrame, names: Sequence[str], branch: str, x: str,
          y: str, factors: tuple, **style: object) -> None:
    """Mean of y over x with its standard error."""
    grid = np.linspace(*tables.reach(curves, names, branch, x), 200)
    rows = tables.curve_matrix(curves, names, branch, grid, x, y)
    mean, error = rows.mean(axis=0), np.sqrt(tables.square_error(rows))
    axis.plot(factors[0] * grid, factors[1] * mean, **style)
    axis.fill_between(factors[0] * grid, factors[1] * (mean - error), factors[1] * (mean + error),
                      color=style["color"], alpha=0.15, linewidth=0.0)


def confined(runs: pd.DataFrame, curves: pd.DataFrame, material: str, path: Path,
             deviations: Optional[pd.DataFrame] = None) -> None:
    """Stress over strain; porosity and coordination number over stress.

    :param deviations: means with `curve`, for the legend
    """
    columns = _columns(runs, material)
    figure, axes = plt.subplots(3, len(columns), squeeze=False, sharey="row", sharex="row",
                                figsize=(1.2 + 4.6 * len(columns), 10.5), constrained_layout=True)
    sizes = sorted(runs["d"].unique())
    for axis, (mode, kinds) in zip(axes.T, columns.items()):
        for own_mode, d in kinds:
            names = tables.names_of(runs, material=material, special="", mode=own_mode, d=d)
            label = f"{1e3 * d:g} mm" + ("" if own_mode == mode else f" ({own_mode})")
            if deviations is not None:
                row = deviations[(deviations["mode"] == own_mode) & np.isclose(deviations["d"], d)
                                 & (deviations["material"] == material) & (deviations["special"] == "")]
                label += "".join(f", {value:.1f}% off" for value in row["curve"].dropna())
            for branch, line in (("load", "-"), ("unload", "--")):
                style = {"color": _colour(sizes, kinds, mode, own_mode, d), "linestyle": line,
                         "linewidth": 1.4 if branch == "load" else 0.9}
                for k, (x, y, factors) in enumerate((("strain", "stress", (100.0, 1e-3)),
                                                     ("stress", "porosity", (1e-3, 1.0)),
                                                     ("stress", "coordination", (1e-3, 1.0)))):
                    _band(axis[k], curves, names, branch, x, y, factors,
                          label=label if (branch, k) == ("load", 0) else None, **style)
        axis[0].set(title=mode, xlabel="axial strain of the bulk (%)")
        axis[1].set_xlabel("axial stress (kPa)")
        axis[2].set_xlabel("axial stress (kPa)")
    for axis, text in zip(axes[:, 0], ("axial stress (kPa)", "porosity of the bulk", "coordination number")):
        axis.set_ylabel(text)
    figure.suptitle(f"Confined compression, {material}: loading (lines), unloading (dashed)")
    _save(figure, path)


def unconfined(runs: pd.DataFrame, curves: pd.DataFrame, material: str, levels: Sequence[str], path: Path) -> None:
    """Stress over strain of crushing after the last level, and the flow function."""
    columns = _columns(runs, material)
    figure, axes = plt.subplots(2, len(columns), squeeze=False, sharey="row",
                                figsize=(1.2 + 4.6 * len(columns), 7.5), constrained_layout=True)
    sizes = sorted(runs["d"].unique())
    known = [level for level in levels if f"strength_{level}" in runs]
    for axis, (mode, kinds) in zip(axes.T, columns.items()):
        for own_mode, d in kinds:
            names = tables.names_of(runs, material=material, special="", mode=own_mode, d=d)
            style = {"color": _colour(sizes, kinds, mode, own_mode, d), "label": f"{1e3 * d:g} mm"}
            crushed = list(runs.loc[names].index[runs.loc[names, f"strength_{known[-1]}"].notna()])
            if crushed:
                _band(axis[0], curves, crushed, f"crush_{known[-1]}", "strain", "stress", (100.0, 1e-3), **style)
            some = runs.loc[names, [f"strength_{level}" for level in known]].dropna(axis=1, how="all")
            axis[1].errorbar([1e-3 * float(c.split("_")[1]) for c in some], 1e-3 * some.mean(),
                             _errors(some.sem(), 1e-3), marker="o", markersize=4, capsize=2, **style)
        axis[0].set(title=f"{mode}, after {1e-3 * float(known[-1]):g} kPa", xlabel="axial strain (%)")
        axis[1].set_xlabel("consolidation stress (kPa)")
    axes[0][0].set_ylabel("axial stress (kPa)")
    axes[1][0].set_ylabel("unconfined strength (kPa)")
    figure.suptitle(f"Unconfined compression, {material}")
    _save(figure, path)


def deviations(table: pd.DataFrame, last: str, path: Path) -> None:
    """Deviation from the finest particles over their relative size, of everything that shall collapse."""
    base = table[(table["material"] == "base") & (table["special"] == "") & (table["d"] > 1.001 * table["reference"])]
    panels = {"curve": "stress-strain curve, RMS (% of peak)", "coordination": "coordination number (%)",
              "bulk_modulus": "bulk modulus (%)", f"strength_{last}": f"strength after {1e-3 * float(last):g} kPa (%)"}
    figure, axes = plt.subplots(1, len(panels), figsize=(4.0 * len(panels), 3.8), constrained_layout=True)
    for axis, (quantity, title) in zip(axes, panels.items()):
        for mode, colour in MODES.items():
            some = base[base["mode"] == mode].sort_values("d")
            off = (some[["curve", "curve_error"]].set_axis(["value", "error"], axis=1) if quantity == "curve"
                   else tables.deviation_percent(table, quantity).loc[some.index])
            axis.errorbar(some["d"] / some["reference"], off["value"], _errors(off["error"]), color=colour,
                          marker="o", capsize=3, label=mode)
        axis.axhline(0.0, color="black", linewidth=0.6)
        axis.set_title(title, fontsize=10)
        axis.set_xlabel("d over that of the finest")
    _save(figure, path)


def sizes(table: pd.DataFrame, last: str, path: Path) -> None:
    """Strength and coordination number over the width in diameters: does the diameter matter, or the number
    of particles across?"""
    base = table[(table["material"] == "base") & (table["mode"] == "scaled") & ~table["special"].str.contains("/s")]
    figure, axes = plt.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    for k, (d, some) in enumerate(base.groupby("d")):
        some = some.sort_values("side")
        for axis, quantity, factor in ((axes[0], f"strength_{last}", 1e-3), (axes[1], "coordination", 1.0)):
            axis.errorbar(some["side"] / d, factor * some[quantity], _errors(some[f"{quantity}_error"], factor),
                          marker="osD^v<"[k % 6], capsize=3, color=COLOURS[k % len(COLOURS)], label=f"{1e3 * d:g} mm")
    axes[0].set_ylabel(f"unconfined strength after {1e-3 * float(last):g} kPa (kPa)")
    axes[1].set_ylabel("coordination number before unloading")
    for axis in axes:
        axis.set_xlabel("width of the specimen over d")
    _save(figure, path)


def micromechanics(points: pd.DataFrame, path: Path) -> None:
    """sigma_u d^2/f_at against Z (1 - porosity)."""
    figure, axis = plt.subplots(figsize=(6.5, 5.0), constrained_layout=True)
    for k, ((material, mode), some) in enumerate(points.groupby(["material", "mode"], sort=False)):
        axis.errorbar(some["packing"], some["strength"], _errors(some["strength_error"]), _errors(some["packing_error"]),
                      linestyle="none", marker="osD^v<>pP*X"[k % 11], markersize=4, capsize=2,
                      color=COLOURS[k % len(COLOURS)], label=f"{material}, {mode}")
    reach = np.array([0.0, 1.05 * points["packing"].max()])
    for plastic, form in ((True, "-"), (False, ":")):
        some = points[points["plastic"] == plastic]
        if len(some):
            constant = proportion(some)[0]
            axis.plot(reach, constant * reach, form, color="black", linewidth=0.8, label=f"{constant:.3f} Z (1 - n)")
    axis.set(xlabel="Z (1 - n) before crushing", ylabel=r"$\sigma_u d^2 / f_{at}$")
    _save(figure, path)


def exponents(found: Sequence[Exponent], path: Path) -> None:
    """Best coefficients over diameter, with the fitted and the law's exponent."""
    names = list(dict.fromkeys(one.free.what for one in found))
    figure, axes = plt.subplots(1, len(names), figsize=(5.0 * len(names), 4.0), squeeze=False,
                                constrained_layout=True)
    for axis, name in zip(axes[0], names):
        some = [one for one in found if one.free.what == name]
        for one in some:
            colour, marker, where = (("#D55E00", "s", "as many diameters wide") if one.equal_width
                                     else ("#0072B2", "o", "as wide"))
            ratio, values = np.array(one.diameters) / one.finest, np.exp(one.logs)
            axis.errorbar(ratio, values, values * one.errors, marker=marker, linestyle="none", capsize=3, color=colour)
            reach = np.linspace(1.0, 1.05 * ratio.max(), 50)
            axis.plot(reach, reach**one.value, color=colour, label=f"{where}: exponent {one.value:.2f}")
        axis.plot(reach, reach**some[0].free.expected, "--", color="black", linewidth=0.8,
                  label=f"scaling law: {some[0].free.expected:g}")
        finest = f"{1e3 * some[0].finest:g} mm"
        axis.set(xscale="log", yscale="log", xlabel=f"d over {finest}", ylabel=f"best {name} over that of {finest}")
        ticks = sorted({d / one.finest for one in some for d in one.diameters})
        for scale, marks in ((axis.xaxis, ticks), (axis.yaxis, [s**some[0].free.expected for s in ticks])):
            scale.set_ticks([1.0, *marks])
            scale.set_major_formatter("{x:.3g}")
            scale.set_minor_formatter("")
    _save(figure, path)


def speed(table: pd.DataFrame, path: Path) -> None:
    """Speed-up over relative diameter, beside (d/d_finest)^4, of the test and of the whole run."""
    base = table[(table["material"] == "base") & (table["special"] == "")]
    finest = base[(base["mode"] == "scaled") & np.isclose(base["d"], base["reference"])]
    figure, axis = plt.subplots(figsize=(5.5, 4.2), constrained_layout=True)
    for mode, colour in MODES.items():
        some = pd.concat([finest, base[(base["mode"] == mode) & (base["d"] > 1.001 * base["reference"])]]).sort_values("d")
        for quantity, line, label in (("test_seconds", "o-", mode), ("seconds", "o:", f"{mode}, whole run")):
            gain = finest[quantity].iloc[0] / some[quantity]
            axis.errorbar(some["d"] / some["reference"], gain, _errors(gain * some[f"{quantity}_error"] / some[quantity]),
                          fmt=line, markersize=4, capsize=2, color=colour, label=label)
    reach = np.linspace(1.0, (base["d"] / base["reference"]).max(), 50)
    axis.plot(reach, reach**4, "--", color="black", linewidth=0.8, label="(d/d finest)$^4$")
    axis.set(xscale="log", yscale="log", xlabel="d over that of the finest", ylabel="speed-up")
    _save(figure, path)

# SPDX-License-Identifier: GPL-2.0-only
"""The figures."""
from __future__ import annotations

from pathlib import Path
from typing import Mapping, Sequence, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first: there may be no display)
import numpy as np  # noqa: E402
from matplotlib.ticker import (FormatStrFormatter, LogLocator, NullFormatter,  # noqa: E402
                               NullLocator)

from analysis.figures import COLOURS  # noqa: E402

from .statistics import Median, Power  # noqa: E402


def save(figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def _with_spread(some: Sequence[Median]) -> Tuple[np.ndarray, np.ndarray]:
    """Medians and distances of the quartiles from them, in Matplotlib's form."""
    return (np.array([m.value for m in some]),
            np.array([[m.value - m.low for m in some], [m.high - m.value for m in some]]))


def ratios(cases: Sequence[str], styles: Sequence[str],
           values: Mapping[Tuple[str, str, str], Median], path: Path) -> None:
    """Bars with quartiles; a panel for the pair time, one for the whole loop."""
    figure, axes = plt.subplots(1, 2, figsize=(11.0, 4.2), constrained_layout=True)
    width = 0.8 / max(1, len(styles))
    for axis, what in zip(axes, ("pair", "loop")):
        for k, style in enumerate(styles):
            places = [n for n, case in enumerate(cases) if (style, what, case) in values]
            some = [values[style, what, cases[n]] for n in places]
            middle, spread = _with_spread(some)
            axis.bar(np.array(places) + (k - 0.5 * (len(styles) - 1)) * width, middle, width,
                     yerr=spread, capsize=2, color=COLOURS[(k + 1) % len(COLOURS)], label=style)
        axis.axhline(1.0, color="black", linewidth=0.8)
        axis.set_xticks(range(len(cases)), cases)
        axis.set_title(f"{what} time / that of gran/hooke/history", fontsize=10)
        axis.grid(axis="y", alpha=0.25, linewidth=0.5)
        axis.set_ylim(top=1.3 * axis.get_ylim()[1])    # room for the legend
        axis.legend(fontsize=8, frameon=False, loc="upper left", ncols=2)
    save(figure, path)


def bars(groups: Sequence[str], series: Sequence[str],
         panels: Mapping[str, Mapping[str, Sequence[float]]], label: str, path: Path) -> None:
    """Bars side by side, a group of them for each of `groups`, in a panel for each title."""
    figure, axes = plt.subplots(len(panels), 1, squeeze=False, sharex=True, sharey=True,
                                constrained_layout=True,
                                figsize=(1.5 + 1.1 * len(groups), 0.6 + 3.2 * len(panels)))
    width = 0.85 / len(series)
    for axis, (title, values) in zip(axes[:, 0], panels.items()):
        for k, name in enumerate(series):
            axis.bar(np.arange(len(groups)) + (k - 0.5 * (len(series) - 1)) * width, values[name],
                     width, color=COLOURS[k % len(COLOURS)], label=name)
        axis.set_title(title, fontsize=10)
        axis.set_ylabel(label)
        axis.grid(axis="y", alpha=0.25, linewidth=0.5)
    axes[-1, 0].set_xticks(range(len(groups)), groups, fontsize=9)
    axes[0, 0].legend(fontsize=8, frameon=False)
    save(figure, path)


def scaling(series: Mapping[str, Mapping[str, Sequence[Tuple[int, Median]]]], path: Path) -> None:
    """Speed-up over cores, strong and weak."""
    figure, axes = plt.subplots(1, 2, figsize=(11.0, 4.2), constrained_layout=True)
    for axis, (kind, lines) in zip(axes, series.items()):
        most = 1
        for k, (label, points) in enumerate(lines.items()):
            cores = [c for c, _ in points]
            most = max(most, *cores)
            middle, spread = _with_spread([m for _, m in points])
            axis.errorbar(cores, middle, yerr=spread, marker="o", capsize=2, linewidth=1.2,
                          linestyle="-" if label.endswith("pair") else "--",
                          color=COLOURS[(1 + k // 2) % len(COLOURS)], label=label)
        ideal = [1, most] if kind == "strong" else [1, 1]
        axis.plot([1, most], ideal, color="black", linewidth=0.8, label="ideal")
        axis.set_xlabel("cores")
        axis.set_xticks(sorted({c for points in lines.values() for c, _ in points}))
        axis.set_ylabel("times the speed of one serial core" if kind == "strong"
                        else "of the speed of one serial core")
        axis.set_title(f"{kind} scaling", fontsize=10)
        axis.set_ylim(bottom=0.0)
        axis.grid(alpha=0.25, linewidth=0.5)
        axis.legend(fontsize=8, frameon=False)
    save(figure, path)


def powers(x: Sequence[float], series: Mapping[str, Sequence[float]], fits: Mapping[str, Power],
           promised: float, path: Path) -> None:
    """Wall time against diameter on logarithmic axes, with the fitted powers and d^-4."""
    figure, axis = plt.subplots(figsize=(5.5, 4.6), constrained_layout=True)
    x = np.asarray(x, dtype=float)
    for k, (name, y) in enumerate(series.items()):
        colour = COLOURS[(k + 1) % len(COLOURS)]
        axis.plot(x, y, "o", color=colour,
                  label=f"{name}: $d^{{{fits[name].exponent:.2f}}}$")
        axis.plot(x, fits[name].at(x), color=colour, linewidth=1.0)
        axis.plot(x, y[0] * (x / x[0]) ** promised, ":", color="black", linewidth=1.0,
                  label=f"$d^{{{promised:g}}}$" if k == 0 else None)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks(x, [f"{d:g}" for d in x])
    axis.xaxis.set_minor_locator(NullLocator())
    axis.yaxis.set_minor_formatter(NullFormatter())
    axis.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.yaxis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_xlabel("diameter (mm)")
    axis.set_ylabel("wall time (s)")
    axis.grid(alpha=0.25, linewidth=0.5)
    axis.legend(fontsize=8, frameon=False)
    save(figure, path)


def particle_steps(series: Mapping[Tuple[str, str], Sequence[Tuple[int, float]]], path: Path) -> None:
    """Particle steps a second over particles, a panel for each case.

    :param series: by case and law
    """
    cases = list(dict.fromkeys(case for case, _ in series))
    figure, axes = plt.subplots(1, len(cases), squeeze=False, sharey=True, constrained_layout=True,
                                figsize=(1.0 + 3.6 * len(cases), 4.0))
    for axis, case in zip(axes[0], cases):
        for k, (law, points) in enumerate((law, p) for (c, law), p in series.items() if c == case):
            axis.plot(*zip(*points), marker="o", markersize=4, linewidth=1.2, color=COLOURS[k % len(COLOURS)], label=law)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_title(case, fontsize=10)
        axis.set_xlabel("particles")
        axis.grid(alpha=0.25, linewidth=0.5)
    axes[0][0].set_ylabel("particle steps a second")
    axes[0][0].legend(fontsize=8, frameon=False)
    save(figure, path)

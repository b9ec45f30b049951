# SPDX-License-Identifier: GPL-2.0-only
"""The figures of the study of strength. Each returns the path that it wrote."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Optional, Sequence

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first: there may be no display)
import numpy as np  # noqa: E402

from . import curves as cv  # noqa: E402
from .analysis import NOTHING, Row  # noqa: E402
from .cases import MODES  # noqa: E402
from .fits import FreeExponent, StrengthPoint, flow_function, proportion_of  # noqa: E402
from .groups import Group, Key, mean_crush  # noqa: E402
from .plan import BASE  # noqa: E402
from .report import COLOURS, WIDTH  # noqa: E402
from .statistics import Value  # noqa: E402


def _save(figure: plt.Figure, path: Path) -> Path:
    for axis in figure.axes:
        axis.grid(alpha=0.25, linewidth=0.5)
    figure.savefig(path, dpi=120)
    plt.close(figure)
    return path


def _legend(axis: plt.Axes) -> None:
    if axis.get_legend_handles_labels()[0]:
        axis.legend(fontsize=8, frameon=False)


def _of(groups: Dict[Key, Group], material: str, mode: str) -> List[Group]:
    """The groups of a figure's column, by diameter; the finest one stands in every column."""
    same = [g for g in groups.values() if g.material.label == material and not g.special]
    finest = min((g for g in same if g.mode == "scaled"), default=None, key=lambda g: g.diameter)
    return sorted({id(g): g for g in same if g.mode == mode or g is finest}.values(),
                  key=lambda g: (g.diameter, g is not finest))


def _modes(groups: Dict[Key, Group], material: str) -> List[str]:
    return [mode for mode in MODES if any(
        g.material.label == material and g.mode == mode and not g.special
        for g in groups.values())]


def _errors(errors: Sequence[float], factor: float = 1.0) -> Optional[List[float]]:
    """For errorbar; nothing where a single seed gives none (which Matplotlib 3.6 can not draw)."""
    return [factor * e for e in errors] if np.any(np.isfinite(list(errors))) else None


def _colour(groups: Dict[Key, Group], group: Group, mode: str) -> str:
    """By diameter; grey for the finest, scaled one in the column of the unscaled."""
    sizes = sorted({g.diameter for g in groups.values()})
    if group.mode != mode and len([g for g in groups.values() if g.diameter == group.diameter
                                   and g.material == group.material and g.mode == mode]):
        return "#999999"
    return COLOURS[sizes.index(group.diameter) % len(COLOURS)]


def _label(group: Group, mode: str) -> str:
    text = f"{1e3 * group.diameter:g} mm"
    return text if group.mode == mode else f"{text} ({group.mode})"


def confined(groups: Dict[Key, Group], material: str, path: Path) -> Path:
    """Stress over strain; porosity and coordination number over stress."""
    modes = _modes(groups, material)
    figure, axes = plt.subplots(3, len(modes), squeeze=False, sharey="row", sharex="row",
                                figsize=(1.2 + 4.6 * len(modes), 10.5), constrained_layout=True)
    for column, mode in enumerate(modes):
        top, middle, bottom = axes[:, column]
        for group in _of(groups, material, mode):
            colour = _colour(groups, group, mode)
            for branch, line in (("loading", "-"), ("unloading", "--")):
                strain = cv.mean_at_stress(group.curves, branch, "bulk")
                kwargs = {"color": colour, "linestyle": line, "linewidth": WIDTH[line]}
                top.plot(100.0 * strain.value, strain.grid / 1e3,
                         label=_label(group, mode) if branch == "loading" else None, **kwargs)
                top.fill_betweenx(strain.grid / 1e3, 100.0 * (strain.value - strain.error),
                                  100.0 * (strain.value + strain.error), color=colour, alpha=0.15,
                                  linewidth=0.0)
                for axis, quantity in ((middle, "bulk_porosity"), (bottom, "coordination")):
                    mean = cv.mean_at_stress(group.curves, branch, quantity)
                    axis.plot(mean.grid / 1e3, mean.value, **kwargs)
                    axis.fill_between(mean.grid / 1e3, mean.value - mean.error,
                                      mean.value + mean.error, color=colour, alpha=0.15,
                                      linewidth=0.0)
        top.set_title(mode)
        _legend(top)
        top.set_xlabel("axial strain of the bulk (%)")
        for axis in (middle, bottom):
            axis.set_xlabel("axial stress (kPa)")
    for axis, text in zip(axes[:, 0], ("axial stress (kPa)", "porosity of the bulk",
                                       "coordination number")):
        axis.set_ylabel(text)
    figure.suptitle(f"Confined compression, {material}: loading (lines), unloading (dashed)")
    return _save(figure, path)


def unconfined(groups: Dict[Key, Group], material: str, level: float, path: Path) -> Path:
    """Stress over strain of crushing after a level, and the flow function."""
    modes = _modes(groups, material)
    figure, axes = plt.subplots(2, len(modes), squeeze=False, sharey="row",
                                figsize=(1.2 + 4.6 * len(modes), 7.5), constrained_layout=True)
    for column, mode in enumerate(modes):
        crush, flow = axes[:, column]
        for group in _of(groups, material, mode):
            if not group.unconfined:
                continue
            colour = _colour(groups, group, mode)
            if level in group.unconfined:
                mean = mean_crush(group.crushed(level))
                crush.plot(100.0 * mean.grid, mean.value / 1e3, color=colour,
                           label=_label(group, mode))
                crush.fill_between(100.0 * mean.grid, (mean.value - mean.error) / 1e3,
                                   (mean.value + mean.error) / 1e3, color=colour, alpha=0.15,
                                   linewidth=0.0)
            function = flow_function(group)
            flow.errorbar(np.array(function.levels) / 1e3,
                          [s.value / 1e3 for s in function.strengths],
                          _errors([s.error for s in function.strengths], 1e-3), color=colour,
                          marker="o", markersize=4, capsize=2, label=_label(group, mode))
        crush.set_title(f"{mode}, after {level / 1e3:g} kPa")
        crush.set_xlabel("axial strain (%)")
        flow.set_xlabel("consolidation stress (kPa)")
        _legend(crush)
    axes[0][0].set_ylabel("axial stress (kPa)")
    axes[1][0].set_ylabel("unconfined strength (kPa)")
    figure.suptitle(f"Unconfined compression, {material}")
    return _save(figure, path)


def deviations(rows: Sequence[Row], path: Path) -> Path:
    """Deviation from the finest particles over their relative size, of everything that shall
    collapse."""
    base = [r for r in rows if r.material == BASE.label and r.usual]
    finest = min(r.diameter_mm for r in base if r.mode == "scaled")
    last = max((level for r in base for level in r.strength_deviation), default=None)
    panels = [("stress-strain curve, RMS (% of peak)", lambda r: r.loading_deviation),
              ("coordination number (%)", lambda r: r.coordination_deviation),
              ("bulk modulus (%)", lambda r: r.bulk_modulus_deviation)]
    if last is not None:
        panels.append((f"strength after {last / 1e3:g} kPa (%)",
                       lambda r: r.strength_deviation.get(last, NOTHING)))
    figure, axes = plt.subplots(1, len(panels), figsize=(4.0 * len(panels), 3.8),
                                constrained_layout=True)
    for axis, (title, get) in zip(axes, panels):
        for mode, colour in zip(MODES, ("#0072B2", "#D55E00")):
            some = sorted((r for r in base if r.mode == mode and r.diameter_mm > finest),
                          key=lambda r: r.diameter_mm)
            if some:
                axis.errorbar([r.diameter_mm / finest for r in some], [get(r).value for r in some],
                              _errors([get(r).error for r in some]), color=colour, marker="o",
                              capsize=3, label=mode)
        axis.axhline(0.0, color="black", linewidth=0.6)
        axis.set_title(title, fontsize=10)
        axis.set_xlabel("d over that of the finest")
        _legend(axis)
    return _save(figure, path)


def micromechanics(points: Sequence[StrengthPoint], path: Path) -> Path:
    """sigma_u d^2/f_at against Z (1 - porosity)."""
    figure, axis = plt.subplots(figsize=(6.5, 5.0), constrained_layout=True)
    labels = list(dict.fromkeys((p.material, p.mode) for p in points))
    for k, (material, mode) in enumerate(labels):
        some = [p for p in points if (p.material, p.mode) == (material, mode)]
        axis.errorbar([p.packing.value for p in some], [p.reduced_strength.value for p in some],
                      _errors([p.reduced_strength.error for p in some]),
                      _errors([p.packing.error for p in some]), linestyle="none",
                      marker="osD^v<>pP*X"[k % 11], markersize=4, capsize=2,
                      color=COLOURS[k % len(COLOURS)], label=f"{material}, {mode}")
    reach = np.array([0.0, 1.05 * max(p.packing.value for p in points)])
    for plastic, form in ((True, "-"), (False, ":")):
        some = [p for p in points if p.plastic == plastic]
        if some:
            constant = proportion_of(some).constant
            axis.plot(reach, constant * reach, form, color="black", linewidth=0.8,
                      label=f"{constant:.3f} Z (1 - n)")
    axis.set_xlabel("Z (1 - n) before crushing")
    axis.set_ylabel(r"$\sigma_u d^2 / f_{at}$")
    _legend(axis)
    return _save(figure, path)


def sizes(rows: Sequence[Row], path: Path) -> Path:
    """Strength after the last level and coordination number over the width of the specimen in
    diameters: does the diameter matter, or the number of particles across?"""
    figure, axes = plt.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    last = max(level for r in rows for level in r.strength)
    for k, size in enumerate(sorted({r.diameter_mm for r in rows})):
        some = sorted((r for r in rows if r.diameter_mm == size), key=lambda r: r.width_mm)
        across = [r.width_mm / size for r in some]
        for axis, values, factor in ((axes[0], [r.strength.get(last, NOTHING) for r in some], 1e-3),
                                     (axes[1], [r.coordination for r in some], 1.0)):
            axis.errorbar(across, [factor * v.value for v in values],
                          _errors([v.error for v in values], factor), marker="osD^v<"[k % 6],
                          capsize=3, color=COLOURS[k % len(COLOURS)], label=f"{size:g} mm")
    axes[0].set_ylabel(f"unconfined strength after {last / 1e3:g} kPa (kPa)")
    axes[1].set_ylabel("coordination number before unloading")
    for axis in axes:
        axis.set_xlabel("width of the specimen over d")
        _legend(axis)
    return _save(figure, path)


def exponents(found: Sequence[FreeExponent], path: Path) -> Path:
    """Best coefficients over diameter, with the fitted and the law's exponent."""
    names = list(dict.fromkeys(one.what for one in found))
    figure, axes = plt.subplots(1, len(names), figsize=(5.0 * len(names), 4.0), squeeze=False,
                                constrained_layout=True)
    for axis, name in zip(axes[0], names):
        some = [one for one in found if one.what == name]
        for one in some:
            colour, marker, where = (("#D55E00", "s", "as many diameters wide") if one.equal_width
                                     else ("#0072B2", "o", "as wide"))
            ratio = np.array(one.diameters) / one.reference_diameter
            values = np.exp([v.value for v in one.logs])
            errors = _errors(values * np.array([v.error for v in one.logs]))
            axis.errorbar(ratio, values, errors, marker=marker, linestyle="none", capsize=3,
                          color=colour)
            reach = np.linspace(1.0, 1.05 * ratio.max(), 50)
            axis.plot(reach, reach**one.exponent.value, color=colour,
                      label=f"{where}: exponent {one.exponent.value:.2f}")
        axis.plot(reach, reach**some[0].expected, "--", color="black", linewidth=0.8,
                  label=f"scaling law: {some[0].expected:g}")
        reference = f"{1e3 * some[0].reference_diameter:g} mm"
        axis.set(xscale="log", yscale="log", xlabel=f"d over {reference}",
                 ylabel=f"best {name} over that of {reference}")
        sizes = sorted({d / one.reference_diameter for one in some for d in one.diameters})
        for scale, ticks in ((axis.xaxis, sizes), (axis.yaxis, [s**some[0].expected
                                                               for s in sizes])):
            scale.set_ticks([1.0, *ticks])
            scale.set_major_formatter("{x:.3g}")
            scale.set_minor_formatter("")
        _legend(axis)
    return _save(figure, path)


def speed(rows: Sequence[Row], path: Path) -> Path:
    """Speed-up of the confined test over relative diameter, beside (d/d_finest)^4."""
    base = [r for r in rows if r.material == BASE.label and r.usual]
    finest = min(r.diameter_mm for r in base if r.mode == "scaled")
    figure, axis = plt.subplots(figsize=(5.5, 4.2), constrained_layout=True)
    for mode, colour in zip(MODES, ("#0072B2", "#D55E00")):
        some = sorted((r for r in base if (r.mode == mode or r.diameter_mm == finest
                                           and r.mode == "scaled")
                       and (r.diameter_mm == finest or np.isfinite(r.speed_up.value))),
                      key=lambda r: r.diameter_mm)
        ratios = [r.diameter_mm / finest for r in some]
        for get, line, size, label in ((lambda r: r.speed_up, "o-", 6, mode),
                                       (lambda r: r.whole_speed_up, "o:", 3,
                                        f"{mode}, whole run")):
            shown = [get(r) if np.isfinite(get(r).value) else Value(1.0, 0.0) for r in some]
            axis.errorbar(ratios, [value.value for value in shown],
                          _errors([value.error for value in shown]), fmt=line, markersize=size,
                          capsize=2, color=colour, label=label)
    reach = np.linspace(1.0, max(r.diameter_mm for r in base) / finest, 50)
    axis.plot(reach, reach**4, "--", color="black", linewidth=0.8, label="(d/d finest)$^4$")
    axis.set(xscale="log", yscale="log", xlabel="d over that of the finest",
             ylabel="speed-up of the confined test")
    _legend(axis)
    return _save(figure, path)

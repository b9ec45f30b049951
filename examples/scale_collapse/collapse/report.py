# SPDX-License-Identifier: GPL-2.0-only
"""The table (CSV and text) and the figure of a study."""
from __future__ import annotations

import csv
import math
from dataclasses import dataclass, fields
from pathlib import Path
from typing import List, Mapping, Optional, Sequence, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first: there may be no display)
import numpy as np  # noqa: E402

from . import curves as cv  # noqa: E402
from .curves import Curve  # noqa: E402

COLOURS = ("#000000", "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
WIDTH = {"-": 1.6, "--": 1.0}


@dataclass(frozen=True)
class Timing:
    """Loop times of LAMMPS in one run, in seconds."""

    particles: int
    loading_seconds: float
    loading_steps: int
    total_seconds: float
    total_steps: int

    @staticmethod
    def from_marker(marker: Mapping) -> "Timing":
        """Of a run's marker; the placing of points is a minimisation and has no steps in time."""
        stages = {name: stage for name, stage in marker["stages"].items() if name != "place"}
        return Timing(marker["particles"], stages["load"]["seconds"], stages["load"]["steps"],
                      sum(stage["seconds"] for stage in marker["stages"].values()),
                      sum(stage["steps"] for stage in stages.values()))


@dataclass(frozen=True)
class Group:
    """Every seed of one diameter in one mode."""

    diameter: float
    mode: str
    curves: List[Curve]
    timings: List[Timing]
    #: at the preload, where it is largest
    inertial_number: float = float("nan")


@dataclass(frozen=True)
class Row:
    """One line of the table. Units are in the names; an empty field has no meaning there."""

    mode: str
    diameter_mm: float
    particles: int
    seeds: int
    deviation_percent: float
    deviation_error_percent: float
    deviation_by_platens_percent: float
    deviation_unloading_percent: float
    porosity_at_preload: float
    porosity_at_preload_error: float
    specimen_porosity_at_preload: float
    final_porosity: float
    final_porosity_error: float
    final_coordination: float
    final_coordination_error: float
    strain_at_peak_percent: float
    strain_at_peak_error_percent: float
    loading_seconds: float
    speed_up: float
    total_seconds: float
    total_speed_up: float
    particle_steps_per_second: float
    inertial_number: float


def make_rows(groups: Sequence[Group]) -> List[Row]:
    """A line for each diameter and mode; deviations and speed-ups are from the smallest diameter
    of the same mode. Final is at the peak stress; wall times of loading are at equal strain."""
    rows = []
    for mode in dict.fromkeys(group.mode for group in groups):
        some = sorted((g for g in groups if g.mode == mode), key=lambda g: g.diameter)
        reference = some[0]
        strain = min(c.loading_run_strain for c in reference.curves)
        reference_loading = _loading_seconds(reference, strain)
        reference_total = np.mean([t.total_seconds for t in reference.timings])
        for group in some:
            rows.append(_row(group, reference, strain, reference_loading, reference_total))
    return rows


def _loading_seconds(group: Group, strain: float) -> float:
    """Mean loop time of loading by that strain; the strain rate is constant."""
    return float(np.mean([t.loading_seconds * strain / c.loading_run_strain
                          for t, c in zip(group.timings, group.curves)]))


def _row(group: Group, reference: Group, strain: float, reference_loading: float,
         reference_total: float) -> Row:
    bulk = cv.loading_deviation(group.curves, reference.curves, "bulk")
    platen = cv.loading_deviation(group.curves, reference.curves, "platen")
    unloading = cv.unloading_deviation(group.curves, reference.curves, "bulk")
    preload = cv.mean_and_error([c.preload_bulk_porosity for c in group.curves])
    specimen = cv.mean_and_error([c.preload_porosity for c in group.curves])
    porosity = cv.mean_and_error([c.loading.bulk_porosity[-1] for c in group.curves])
    coordination = cv.mean_and_error([c.loading.coordination[-1] for c in group.curves])
    peak = cv.mean_and_error([100.0 * c.loading.strain["bulk"].max() for c in group.curves])
    loading = _loading_seconds(group, strain)
    total = float(np.mean([t.total_seconds for t in group.timings]))
    itself = group is reference
    return Row(
        mode=group.mode, diameter_mm=1e3 * group.diameter, particles=group.timings[0].particles,
        seeds=len(group.curves),
        deviation_percent=0.0 if itself else bulk.percent,
        deviation_error_percent=float("nan") if itself else bulk.standard_error,
        deviation_by_platens_percent=0.0 if itself else platen.percent,
        deviation_unloading_percent=0.0 if itself else unloading.percent,
        porosity_at_preload=preload[0], porosity_at_preload_error=preload[1],
        specimen_porosity_at_preload=specimen[0],
        final_porosity=porosity[0], final_porosity_error=porosity[1],
        final_coordination=coordination[0], final_coordination_error=coordination[1],
        strain_at_peak_percent=peak[0], strain_at_peak_error_percent=peak[1],
        loading_seconds=loading, speed_up=reference_loading / loading,
        total_seconds=total, total_speed_up=float(reference_total) / total,
        particle_steps_per_second=float(
            sum(t.particles * t.loading_steps for t in group.timings)
            / sum(t.loading_seconds for t in group.timings)),
        inertial_number=group.inertial_number)


def write_csv(rows: Sequence[Row], path: Path) -> None:
    names = [field.name for field in fields(Row)]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for row in rows:
            writer.writerow([_plain(getattr(row, name)) for name in names])


def _plain(value: object) -> object:
    if not isinstance(value, float):
        return value
    return f"{value:.6g}" if math.isfinite(value) else ""


def _with_error(value: float, error: float, digits: int) -> str:
    """The error is left out where a single seed gives none."""
    text = f"{value:.{digits}f}"
    return f"{text} ± {error:.{digits}f}" if math.isfinite(error) else text


def text_table(rows: Sequence[Row], preload: float) -> str:
    """The table for the terminal."""
    header: Sequence[Tuple[str, str]] = (
        ("", "mode"), ("d", "mm"), ("particles", ""), ("seeds", ""), ("deviation", "% of peak"),
        ("by platens", "% of peak"), ("unloading", "% of peak"), ("porosity", "at preload"),
        ("porosity", "at peak"), ("coordination", "at peak"), ("strain", "at peak, %"),
        ("loading", "s"), ("speed-up", ""), ("whole run", "s"), ("speed-up", ""),
        ("M particle", "steps/s"))
    lines: List[List[str]] = [[top for top, _ in header], [bottom for _, bottom in header]]
    for row in rows:
        lines.append([
            row.mode, f"{row.diameter_mm:g}", str(row.particles), str(row.seeds),
            _with_error(row.deviation_percent, row.deviation_error_percent, 2),
            f"{row.deviation_by_platens_percent:.2f}", f"{row.deviation_unloading_percent:.2f}",
            _with_error(row.porosity_at_preload, row.porosity_at_preload_error, 4),
            f"{row.final_porosity:.4f}",
            _with_error(row.final_coordination, row.final_coordination_error, 2),
            _with_error(row.strain_at_peak_percent, row.strain_at_peak_error_percent, 2),
            f"{row.loading_seconds:.2f}", f"{row.speed_up:.1f}", f"{row.total_seconds:.1f}",
            f"{row.total_speed_up:.1f}", f"{row.particle_steps_per_second / 1e6:.1f}"])
    widths = [max(len(line[column]) for line in lines) for column in range(len(header))]
    text = ["  ".join(cell.rjust(width) for cell, width in zip(line, widths)).rstrip()
            for line in lines]
    text += ["",
             "deviation   root mean square difference between the mean stress-strain curve and",
             "            that of the smallest diameter, over their common strain range, in %",
             "            of the peak stress there; "
             f"strain of the bulk, from {preload / 1e3:g} kPa;",
             "            ± is the standard error that the scatter of the seeds leaves",
             "by platens  the same with the strain of the specimen, platen layers and all",
             "loading     loop time of LAMMPS at equal strain; speed-up from the smallest one"]
    largest = max(row.inertial_number for row in rows)
    if math.isfinite(largest):
        text += ["", f"The largest inertial number is {largest:.1e}, of the largest diameter at "
                     f"{preload / 1e3:g} kPa."]
    return "\n".join(text) + "\n"


def plot(groups: Sequence[Group], path: Path, law: str, preload: float,
         rows: Optional[Sequence[Row]] = None) -> None:
    """Stress over strain, porosity and coordination number over stress, a column for each mode."""
    modes = list(dict.fromkeys(group.mode for group in groups))
    diameters = sorted({group.diameter for group in groups})
    colours = {d: COLOURS[k % len(COLOURS)] for k, d in enumerate(diameters)}
    by_key = {(row.mode, round(row.diameter_mm, 6)): row for row in rows or ()}
    figure, axes = plt.subplots(3, len(modes), squeeze=False, sharey="row", sharex="row",
                                figsize=(1.2 + 4.6 * len(modes), 10.5), constrained_layout=True)
    for column, mode in enumerate(modes):
        for group in sorted((g for g in groups if g.mode == mode), key=lambda g: g.diameter):
            row = by_key.get((mode, round(1e3 * group.diameter, 6)))
            _plot_group(axes[:, column], group, colours[group.diameter], _label(group, row))
        title = ("stiffness and adhesion scaled with the diameter" if mode == "scaled"
                 else "the same coefficients at every diameter")
        axes[0][column].set_title(f"{mode}: {title}", fontsize=10)
        axes[0][column].legend(fontsize=8, frameon=False, loc="lower right")
        axes[0][column].set_xlabel("axial strain (%)")
        for lower in axes[1:, column]:
            lower.set_xlabel("axial stress (kPa)")
        axes[1][column].set_xlim(left=0.0)
    # Room for the legend beside the curves, which both columns' go up to.
    axes[0][0].set_xlim(right=1.35 * max(100.0 * c.loading.strain["bulk"].max()
                                         for group in groups for c in group.curves))
    axes[0][0].set_ylabel("axial stress (kPa)")
    axes[1][0].set_ylabel("porosity of the bulk")
    axes[2][0].set_ylabel("coordination number")
    for axis in axes.flat:
        axis.grid(alpha=0.25, linewidth=0.5)
        axis.tick_params(labelleft=True)
    figure.suptitle(f"Confined compression, law {law}: loading (lines) and unloading (dashed), "
                    f"mean over seeds\nwith its standard error; strain from {preload / 1e3:g} kPa",
                    fontsize=11)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def _label(group: Group, row: Optional[Row]) -> str:
    text = f"{1e3 * group.diameter:g} mm, {group.timings[0].particles} particles"
    if row is not None and row.deviation_percent > 0.0:
        text += f", {row.deviation_percent:.1f}% off"
    return text


def _plot_group(axes: Sequence, group: Group, colour: str, label: str) -> None:
    for branch, line in (("loading", "-"), ("unloading", "--")):
        strain = cv.mean_at_stress(group.curves, branch, "bulk")
        low, high = (100.0 * (strain.value + sign * strain.error) for sign in (-1.0, 1.0))
        axes[0].plot(100.0 * strain.value, strain.grid / 1e3, color=colour, linestyle=line,
                     linewidth=WIDTH[line], label=label if branch == "loading" else None)
        axes[0].fill_betweenx(strain.grid / 1e3, low, high, color=colour, alpha=0.15,
                              linewidth=0.0)
    for axis, quantity in ((axes[1], "bulk_porosity"), (axes[2], "coordination")):
        for branch, line in (("loading", "-"), ("unloading", "--")):
            values = cv.mean_at_stress(group.curves, branch, quantity)
            axis.plot(values.grid / 1e3, values.value, color=colour, linestyle=line,
                      linewidth=WIDTH[line])
            axis.fill_between(values.grid / 1e3, values.value - values.error,
                              values.value + values.error, color=colour, alpha=0.15,
                              linewidth=0.0)

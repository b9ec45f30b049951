# SPDX-License-Identifier: GPL-2.0-only
"""From the samples of each run to mean curves on common grids, and how far they are apart.

Strain is counted from the preload: where the axial stress last rises through it on loading. The
loading and the unloading branch are kept apart; each is interpolated on its own.
"""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np

#: How strain may be measured, see README.md.
STRAINS = ("bulk", "platen")
COLUMNS = ("step", "stage", "height", "bulk_strain", "stress_top", "stress_bottom", "porosity",
           "bulk_porosity", "coordination")
GRID_POINTS = 200


class BadCurve(ValueError):
    """A curve file lacks required contents."""


@dataclass(frozen=True)
class Branch:
    """Samples of loading or of unloading, in the order of time. Strain is positive in
    compression and counted from the preload, stress in Pa."""

    strain: Dict[str, np.ndarray]
    stress: np.ndarray
    bulk_porosity: np.ndarray
    porosity: np.ndarray
    coordination: np.ndarray
    #: of the grains two diameters and more away from both platens, where it was measured
    bulk_coordination: Optional[np.ndarray] = None

    def __len__(self) -> int:
        return len(self.stress)


@dataclass(frozen=True)
class Curve:
    """One run."""

    loading: Branch
    unloading: Branch
    #: values interpolated at the preload
    preload_porosity: float
    preload_bulk_porosity: float
    preload_coordination: float
    #: platen strain from the first sample of loading to its last, which the loop time is for
    loading_run_strain: float


def read_samples(path: Path) -> np.ndarray:
    """The table of one curve.csv.

    :raise BadCurve: with the file's name and what is missing
    """
    samples = np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding="utf-8")
    missing = [name for name in COLUMNS if name not in (samples.dtype.names or ())]
    if missing:
        raise BadCurve(f"{path}: no column {', '.join(missing)}")
    return np.atleast_1d(samples)


def curve_from_samples(samples: np.ndarray, preload: float, name: str = "curve") -> Curve:
    """Splits the samples into branches and counts strain from the preload.

    :raise BadCurve: when loading does not start below the preload and end above it
    """
    stress = 0.5 * (samples["stress_top"] + samples["stress_bottom"])
    load = np.flatnonzero(samples["stage"] == "load")
    unload = np.flatnonzero(samples["stage"] == "unload")
    below = load[stress[load] < preload]
    if len(below) == 0 or len(load) == 0 or below[-1] == load[-1]:
        raise BadCurve(f"{name}: stress does not rise through the preload of {preload:g} Pa "
                       f"({len(load)} samples of loading)")
    last = below[-1]
    share = (preload - stress[last]) / (stress[last + 1] - stress[last])

    def at_preload(values: np.ndarray) -> float:
        return float(values[last] + share * (values[last + 1] - values[last]))

    lengths = {"bulk": 1.0 - samples["bulk_strain"], "platen": samples["height"]}
    strains = {kind: 1.0 - length / at_preload(length) for kind, length in lengths.items()}

    def branch(rows: np.ndarray, first: Sequence[int]) -> Branch:
        def column(values: np.ndarray) -> np.ndarray:
            return np.concatenate([[at_preload(values)] if len(first) else [], values[rows]])
        return Branch({kind: column(values) for kind, values in strains.items()}, column(stress),
                      column(samples["bulk_porosity"]), column(samples["porosity"]),
                      column(samples["coordination"]),
                      column(samples["bulk_coordination"])
                      if "bulk_coordination" in samples.dtype.names else None)

    loading = branch(load[load > last], [last])
    # The branch of unloading starts with the last sample before it, of loading or of the hold after
    # loading, because its own first sample comes a little after the reversal.
    unloading = branch(np.concatenate([unload[:1] - 1, unload]), [])
    height = samples["height"][load]
    return Curve(loading, unloading, at_preload(samples["porosity"]),
                 at_preload(samples["bulk_porosity"]), at_preload(samples["coordination"]),
                 float(1.0 - height[-1] / height[0]))


def load_curve(path: Path, preload: float) -> Curve:
    return curve_from_samples(read_samples(path), preload, str(path))


@dataclass(frozen=True)
class Mean:
    """Mean over seeds on one grid, and its standard error (not a number for a single seed)."""

    grid: np.ndarray
    value: np.ndarray
    error: np.ndarray
    seeds: int


def mean_of(grid: np.ndarray, values: Sequence[np.ndarray]) -> Mean:
    table = np.asarray(values, dtype=float)
    count = len(table)
    error = (np.std(table, axis=0, ddof=1) / np.sqrt(count) if count > 1
             else np.full(table.shape[1], np.nan))
    return Mean(grid, table.mean(axis=0), error, count)


def sorted_by(key: np.ndarray, values: np.ndarray) -> tuple:
    """Sorts both by rising key, as interpolation needs. A sample against the direction of the branch
    (a grain that slips) only changes places with its neighbour."""
    order = np.argsort(key, kind="stable")
    return key[order], values[order]


def interpolate(grid: np.ndarray, key: np.ndarray, values: np.ndarray) -> np.ndarray:
    """values(key) at the points of the grid.

    :raise ValueError: when the grid reaches beyond the samples
    """
    rising, sorted_values = sorted_by(key, values)
    slack = 1e-9 * max(abs(rising[0]), abs(rising[-1]), 1e-30)
    if grid.min() < rising[0] - slack or grid.max() > rising[-1] + slack:
        raise ValueError(f"grid from {grid.min():g} to {grid.max():g} reaches beyond the samples, "
                         f"from {rising[0]:g} to {rising[-1]:g}")
    return np.interp(grid, rising, sorted_values)


def mean_stress(curves: Sequence[Curve], strain: str, up_to: float) -> Mean:
    """Stress on loading over strain from 0 to up_to."""
    grid = np.linspace(0.0, up_to, GRID_POINTS)
    return mean_of(grid, [interpolate(grid, c.loading.strain[strain], c.loading.stress)
                          for c in curves])


def mean_unloading(curves: Sequence[Curve], strain: str, down_by: float) -> Mean:
    """Stress on unloading over the strain recovered since the reversal."""
    grid = np.linspace(0.0, down_by, GRID_POINTS)
    return mean_of(grid, [interpolate(grid, recovered(c, strain), c.unloading.stress)
                          for c in curves])


def mean_at_stress(curves: Sequence[Curve], branch: str, quantity: str) -> Mean:
    """A quantity (or bulk or platen strain) over the stress that every curve has."""
    branches = [getattr(c, branch) for c in curves]
    low = max(b.stress.min() for b in branches)
    high = min(b.stress.max() for b in branches)
    grid = np.linspace(low, high, GRID_POINTS)
    return mean_of(grid, [
        interpolate(grid, b.stress,
                    b.strain[quantity] if quantity in STRAINS else getattr(b, quantity))
        for b in branches])


def recovered(curve: Curve, strain: str) -> np.ndarray:
    values = curve.unloading.strain[strain]
    return values[0] - values


def common_strain(groups: Sequence[Sequence[Curve]], strain: str) -> float:
    """The largest strain that every curve of every group reaches on loading."""
    return float(min(c.loading.strain[strain].max() for curves in groups for c in curves))


def common_recovery(groups: Sequence[Sequence[Curve]], strain: str) -> float:
    """The same of the strain that is recovered on unloading."""
    return float(min(recovered(c, strain).max() for curves in groups for c in curves))


@dataclass(frozen=True)
class Deviation:
    """Root mean square distance of one mean curve from another over their common range, the
    standard error from the seeds of both, and the mean distance (negative where the curve lies
    below), in % of the peak stress there."""

    percent: float
    standard_error: float
    up_to: float
    mean_percent: float


def deviation(mean: Mean, reference: Mean) -> Deviation:
    return _deviation(mean.value - reference.value, np.hypot(mean.error, reference.error),
                      reference)


def paired_deviation(pairs: Sequence[Tuple[np.ndarray, np.ndarray]], grid: np.ndarray) -> Deviation:
    """The same of tests of the same packings: pairs of values on the grid, the second one the
    reference. The error is that of the mean of the pairs' differences."""
    apart = mean_of(grid, [one - reference for one, reference in pairs])
    return _deviation(apart.value, apart.error, mean_of(grid, [second for _, second in pairs]))


def _deviation(apart: np.ndarray, error: np.ndarray, reference: Mean) -> Deviation:
    peak = float(np.max(np.abs(reference.value)))
    if not peak > 0.0:
        raise ValueError(f"peak stress of the reference is {peak:g}, allowed is a number above 0")
    return Deviation(100.0 * root_mean_square(apart) / peak,
                     100.0 * root_mean_square(error) / peak, float(reference.grid[-1]),
                     100.0 * float(np.mean(apart)) / peak)


def loading_deviation(curves: Sequence[Curve], reference: Sequence[Curve],
                      strain: str) -> Deviation:
    up_to = common_strain([curves, reference], strain)
    return deviation(mean_stress(curves, strain, up_to), mean_stress(reference, strain, up_to))


def unloading_deviation(curves: Sequence[Curve], reference: Sequence[Curve],
                        strain: str) -> Deviation:
    down_by = common_recovery([curves, reference], strain)
    return deviation(mean_unloading(curves, strain, down_by),
                     mean_unloading(reference, strain, down_by))


def root_mean_square(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def mean_and_error(values: Sequence[float]) -> List[float]:
    """Mean and standard error of numbers; the error of a single one is not known."""
    array = np.asarray(values, dtype=float)
    error = float(np.std(array, ddof=1) / np.sqrt(len(array))) if len(array) > 1 else float("nan")
    return [float(array.mean()), error]

# SPDX-License-Identifier: GPL-2.0-only
"""What a run says in numbers: from the files of in.confined and in.unconfined to one row a specimen.

SI units. Strain is that of the bulk, positive in compression, and counts from the preload, where axial
stress last rises through it on loading; axial stress is the mean of both platens'.
"""
from __future__ import annotations

from pathlib import Path
from typing import Dict, Tuple, Union

import numpy as np
import pandas as pd

#: Stress over that of the last level where quantities are compared, and where unloading is elastic.
COMPARED, ELASTIC = 0.9, (0.5, 0.95)
#: Columns of curve.csv that curves keep, by their names here.
COLUMNS = {"strain": "strain", "porosity": "bulk_porosity", "coordination": "coordination",
           "bulk_coordination": "bulk_coordination"}
#: Points of a curve, evenly in stress from the preload to the last level.
POINTS = 100
#: Samples, least and most, of the running mean that finds the peak of crushing, and part of that peak
#: from which on they make the cubic whose top is the strength: the largest sample, or mean of a few,
#: would be too high by their scatter, which grows with the diameter.
SMOOTHED, NEAR_PEAK = (5, 15), 0.8
#: Of loading, by which the strain rate is taken for the inertial number.
RATE_SAMPLES = 20


class BadRun(ValueError):
    """A run lacks what is to be measured; the message names its folder."""


def read_curve(path: Union[str, Path]) -> pd.DataFrame:
    """The samples of a curve.csv, with the axial stress added as `stress`."""
    samples = pd.read_csv(path)
    samples["stress"] = 0.5 * (samples["stress_top"] + samples["stress_bottom"])
    return samples


def loading(samples: pd.DataFrame, preload: float, place: str = "curve") -> pd.DataFrame:
    """The samples of loading from the preload on, with `strain` counted from it.

    :raise BadRun: when loading does not begin below the preload and end above it
    """
    load = samples[samples["stage"] == "load"]
    below = np.flatnonzero(load["stress"] < preload)
    if len(below) == 0 or below[-1] == len(load) - 1:
        raise BadRun(f"{place}: stress does not rise through the preload of {preload:g} Pa")
    pair = load.iloc[below[-1]:below[-1] + 2].select_dtypes("number")
    share = (preload - pair["stress"].iloc[0]) / pair["stress"].diff().iloc[1]
    first = pair.iloc[0] + share * (pair.iloc[1] - pair.iloc[0])
    kept = pd.concat([first.to_frame().T, load.iloc[below[-1] + 1:]], ignore_index=True)
    return kept.assign(strain=1.0 - (1.0 - kept["bulk_strain"]) / (1.0 - first["bulk_strain"]))


def at_stress(load: pd.DataFrame, stress: Union[float, np.ndarray], quantity: str):
    """A quantity of loading at a stress, or some. A sample against the rise of stress (a grain that
    slips) only changes places with its neighbour."""
    rising = load.sort_values("stress", kind="stable")
    return np.interp(stress, rising["stress"], rising[quantity].astype(float))


def curve_of(load: pd.DataFrame, top: float, points: int = POINTS) -> pd.DataFrame:
    """The curve at stresses that runs have in common: strain, porosity, coordination over stress."""
    grid = np.linspace(load["stress"].iloc[0], top, points)
    return _over_stress(load, grid)


def unloading_of(samples: pd.DataFrame, load: pd.DataFrame, points: int = POINTS) -> pd.DataFrame:
    """The same from the reversal down, with strain counted as on loading. Empty where it was not unloaded."""
    unload = samples[samples["stage"] == "unload"]
    if unload.empty:
        return pd.DataFrame(columns=["stress", *COLUMNS])
    # The branch begins with the sample before its own first one, which comes a little after the reversal.
    rows = samples.loc[[unload.index[0] - 1, *unload.index]]
    shift = (1.0 - load["strain"].iloc[-1]) / (1.0 - load["bulk_strain"].iloc[-1])
    rows = rows.assign(strain=1.0 - shift * (1.0 - rows["bulk_strain"]))
    return _over_stress(rows, np.linspace(rows["stress"].iloc[0], rows["stress"].min(), points))


def crushing_of(samples: pd.DataFrame, points: int = 2 * POINTS) -> pd.DataFrame:
    """Stress over strain of crushing, evenly in strain."""
    strain, stress = _crushing(samples)
    grid = np.linspace(strain[0], strain[-1], points)
    return pd.DataFrame({"strain": grid, "stress": np.interp(grid, strain, stress)})


def _over_stress(rows: pd.DataFrame, grid: np.ndarray) -> pd.DataFrame:
    return pd.DataFrame({"stress": grid, **{name: at_stress(rows, grid, column)
                                            for name, column in COLUMNS.items() if column in rows}})


def _crushing(samples: pd.DataFrame) -> Tuple[np.ndarray, np.ndarray]:
    crush, free = (samples[samples["stage"] == stage] for stage in ("crush", "free"))
    return 1.0 - crush["height"].to_numpy() / free["height"].iloc[-1], crush["stress"].to_numpy()


def modulus(samples: pd.DataFrame, place: str = "curve") -> Dict[str, float]:
    """On unloading: rise of axial and of mean stress per axial strain of the bulk, and the ratio of
    lateral to axial stress before it."""
    unload = samples[samples["stage"] == "unload"]
    if len(unload) == 0:
        raise BadRun(f"{place}: it was not unloaded")
    axial, strain = unload["stress"], unload["bulk_strain"] / (1.0 - unload["bulk_strain"].iloc[0])
    part = axial.between(ELASTIC[0] * axial.iloc[0], ELASTIC[1] * axial.iloc[0])
    if part.sum() < 3:
        raise BadRun(f"{place}: unloading has {part.sum()} samples between {ELASTIC[0]:g} and "
                     f"{ELASTIC[1]:g} of its first stress, needed are 3")
    axial_modulus = {"constrained_modulus": np.polyfit(strain[part], axial[part], 1)[0]}
    if "stress_x" not in unload:  # in.oedometer does not write it
        return axial_modulus
    lateral = unload["stress_x"] + unload["stress_y"]
    return {**axial_modulus,
            "bulk_modulus": np.polyfit(strain[part], (axial + lateral)[part] / 3.0, 1)[0],
            "lateral_ratio": lateral.iloc[0] / (2.0 * axial.iloc[0])}


def inertial_number(load: pd.DataFrame, diameter: float, density: float) -> float:
    """Largest I = strain rate d sqrt(density/stress) on loading (MiDi, Eur. Phys. J. E 14 (2004) 341)."""
    load = load.iloc[1:]  # the first is interpolated, at no step of its own
    # Holds lie between the samples of loading: no span of samples reaches over one.
    spans = load["step"].diff(RATE_SAMPLES)
    rate = load["bulk_strain"].diff(RATE_SAMPLES) / load["time"].diff(RATE_SAMPLES)
    stress = load["stress"].rolling(RATE_SAMPLES + 1).mean()
    numbers = rate.abs() * diameter * np.sqrt(density / stress)
    return float(numbers[spans == spans.min()].max())


def strength(strain: np.ndarray, stress: np.ndarray) -> Dict[str, float]:
    """Largest stress of crushing and its strain: the top of the cubic of least squares around it."""
    width = min(SMOOTHED[1], max(SMOOTHED[0], len(stress) // 15))
    smooth = pd.Series(stress).rolling(width, center=True, min_periods=1).mean().to_numpy()
    rough = int(np.argmax(smooth))
    far = np.flatnonzero(smooth < NEAR_PEAK * smooth[rough])
    near = slice(int(far[far < rough].max(initial=-1)) + 1, int(far[far > rough].min(initial=len(stress))))
    x, y = strain[near], stress[near]
    if len(x) < SMOOTHED[0]:
        return {"strength": float(smooth[rough]), "strain_at_peak": float(strain[rough])}
    fine = np.linspace(x[0], x[-1], 1001)
    values = np.polynomial.Polynomial.fit(x, y, 3)(fine)
    return {"strength": float(values.max()), "strain_at_peak": float(fine[values.argmax()])}


def measure_confined(samples: pd.DataFrame, load: pd.DataFrame, diameter: float, density: float,
                     place: str = "curve") -> Dict[str, float]:
    """A row of a confined test, from its samples and those of its loading: see the names in README.md."""
    at = COMPARED * load["stress"].max()
    last = samples[samples["stage"].isin(("load", "hold"))].iloc[-1]
    return {"strain": float(at_stress(load, at, "strain")),
            "porosity_before": float(load["bulk_porosity"].iloc[0]),
            **{name: float(at_stress(load, at, column)) for name, column in COLUMNS.items()
               if column in load and name != "strain"},
            **modulus(samples, place),
            "overlap": float(last["mean_overlap"]),
            "inertial_number": inertial_number(load, diameter, density) if "time" in load else np.nan}


def measure_crushed(samples: pd.DataFrame, unload: pd.DataFrame, place: str = "curve") -> Dict[str, float]:
    """A row of an unconfined test, from the samples of its crushing and of the unloading before it."""
    free = samples[samples["stage"] == "free"]
    count = int((samples["stage"] == "crush").sum())
    if len(free) == 0 or count < SMOOTHED[0]:
        raise BadRun(f"{place}: {count} samples of crushing, needed are {SMOOTHED[0]}")
    strain, stress = _crushing(samples)
    before = free.iloc[-1]
    return {**strength(strain, stress),
            # Loose specimens harden without a peak, and are compared here.
            "stress_at_5_percent": (float(np.polynomial.Polynomial.fit(*_around(strain, stress, 0.05), 1)(0.05))
                                    if strain.max() > 0.055 else np.nan),
            "largest_strain": float(strain[-1]),
            "porosity_unloaded": float(before["bulk_porosity"]),
            "coordination_unloaded": float(before["coordination"]),
            "coordination_uncut": float(unload["coordination"].iloc[-1]),
            "plastic_overlap": float(before["plastic_overlap"])}


def _around(x: np.ndarray, y: np.ndarray, middle: float, reach: float = 5e-3) -> Tuple[np.ndarray, np.ndarray]:
    near = np.abs(x - middle) <= reach
    return x[near], y[near]

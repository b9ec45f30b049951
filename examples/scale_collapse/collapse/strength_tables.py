# SPDX-License-Identifier: GPL-2.0-only
"""The tables and curves of the study of strength, for the page and as CSV."""
from __future__ import annotations

import csv
import math
import re
import shutil
from pathlib import Path
from typing import Dict, List, Sequence

from . import curves as cv
from .analysis import Row
from .groups import Group, Key, mean_crush
from .statistics import Value

VALUES = ("loading_deviation", "unloading_deviation", "porosity", "porosity_deviation",
          "coordination", "coordination_deviation", "bulk_coordination",
          "bulk_coordination_deviation", "cut_coordination", "strain", "constrained_modulus",
          "bulk_modulus", "bulk_modulus_deviation", "lateral_ratio", "speed_up", "whole_speed_up")
OF_LEVELS = ("strength", "strength_deviation", "crush_deviation")


def with_error(value: Value, digits: int, factor: float = 1.0) -> str:
    """Without the error where a single seed gives none; empty where there is no value."""
    if not math.isfinite(value.value):
        return ""
    text = f"{factor * value.value:.{digits}f}"
    return (f"{text} ± {factor * value.error:.{digits}f}" if math.isfinite(value.error) else text)


HEADER = ["material", "mode", "", "d (mm)", "reference (mm)", "particles", "seeds", "crushed",
          "inertial number", "loading (% of peak)", "scatter of seeds (%)", "unloading (%)",
          "strain (%)", "porosity", "Z", "Z off (%)", "Z of the bulk", "off (%)",
          "modulus (MPa)", "bulk modulus (MPa)", "K off (%)", "lateral ratio", "Z on cutting (%)",
          "strength (kPa)", "strength off (%)", "crushing (% of peak)", "steps", "s", "speed-up",
          "whole run, s", "speed-up", "(d/d0)^4"]


def cells(row: Row, last: float) -> List[str]:
    """:param last: the level, Pa, that strength and crushing are after"""

    def of_last(values: Dict[float, Value], digits: int, factor: float = 1.0) -> str:
        return with_error(values[last], digits, factor) if last in values else ""

    return [row.material, row.mode, row.special, f"{row.diameter_mm:g}",
            _number(row.reference_mm, "g"), str(row.particles), str(row.seeds), str(row.crushed),
            f"{row.inertial_number:.1e}",
            with_error(row.loading_deviation, 2),
            _number(row.loading_scatter, ".2f"),
            with_error(row.unloading_deviation, 2), with_error(row.strain, 3, 100.0),
            with_error(row.porosity, 4), with_error(row.coordination, 3),
            with_error(row.coordination_deviation, 2), with_error(row.bulk_coordination, 3),
            with_error(row.bulk_coordination_deviation, 2),
            with_error(row.constrained_modulus, 2, 1e-6), with_error(row.bulk_modulus, 2, 1e-6),
            with_error(row.bulk_modulus_deviation, 1), with_error(row.lateral_ratio, 3),
            with_error(row.cut_coordination, 1), of_last(row.strength, 2, 1e-3),
            of_last(row.strength_deviation, 1), of_last(row.crush_deviation, 1),
            f"{row.steps:.0f}", f"{row.seconds:.2f}", with_error(row.speed_up, 1),
            f"{row.whole_seconds:.2f}", with_error(row.whole_speed_up, 1),
            _number(row.expected_speed_up, ".1f")]


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else ""


def write_table(rows: Sequence[Row], levels: Sequence[float], path: Path) -> None:
    """Every row and value; SI units, deviations in %."""
    plain = ["material", "mode", "special", "strain_rate", "diameter_mm", "width_mm",
             "reference_mm", "particles", "seeds", "crushed", "not_failed", "inertial_number",
             "crush_inertial_number",
             "loading_mean_deviation", "loading_scatter", "steps", "seconds", "whole_steps",
             "whole_seconds", "expected_speed_up"]
    names = plain + [f"{name}{end}" for name in VALUES for end in ("", "_error")]
    for level in levels:
        names += [f"{name}_{level / 1e3:g}kPa{end}" for name in OF_LEVELS
                  for end in ("", "_error")]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for row in rows:
            line = [_plain(getattr(row, name)) for name in plain]
            for name in VALUES:
                line += _both(getattr(row, name))
            nothing = Value(math.nan, math.nan)
            for level in levels:
                for name in OF_LEVELS:
                    line += _both(getattr(row, name).get(level, nothing))
            writer.writerow(line)


def _both(value: Value) -> List[object]:
    return [_plain(value.value), _plain(value.error)]


def _plain(value: object) -> object:
    if not isinstance(value, float):
        return value
    return f"{value:.6g}" if math.isfinite(value) else ""


def write_curves(groups: Dict[Key, Group], folder: Path) -> None:
    """Mean and standard error over seeds of every curve, a file for each group and test; nothing
    else stays in the folder."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for (material, mode, diameter, special), group in groups.items():
        name = f"{material}_{mode}_d{1e3 * diameter:g}mm"
        if special:
            name += "_" + re.sub(r"\W+", "_", special)
        for branch in ("loading", "unloading"):
            means = {quantity: cv.mean_at_stress(group.curves, branch, quantity)
                     for quantity in ("bulk", "bulk_porosity", "coordination",
                                      "bulk_coordination")}
            _write_means(folder / f"{name}_{branch}.csv", "stress", means,
                         {"bulk": "strain", "bulk_porosity": "porosity"})
        for level in group.unconfined:
            _write_means(folder / f"{name}_crush_{level / 1e3:g}kPa.csv", "strain",
                         {"stress": mean_crush(group.crushed(level))}, {})


def _write_means(path: Path, grid: str, means: Dict[str, cv.Mean], rename: Dict[str, str]) -> None:
    names, columns = [grid], [next(iter(means.values())).grid]
    for quantity, mean in means.items():
        name = rename.get(quantity, quantity)
        names += [name, f"{name}_error"]
        columns += [mean.value, mean.error]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for line in zip(*columns):
            writer.writerow([_plain(float(value)) for value in line])

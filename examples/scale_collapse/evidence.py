#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""From the runs of evidence.yaml (`coarsen run`) and older results to what `coarsen plan` predicts from:
results/evidence_runs.csv, a row a specimen; results/evidence_curves.csv.gz; and the package's evidence.csv,
slopes of quantities over dimensionless numbers. See evidence.md."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict, List

import numpy as np
import pandas as pd

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "coarsen"))

import evidence_figures  # noqa: E402  (beside this file)
from coarsen import evidence  # noqa: E402
from coarsen.results import tidy  # noqa: E402
from coarsen.study import read_study  # noqa: E402

QUANTITIES = ["strain", "porosity_before", "porosity", "coordination", "bulk_modulus", "lateral_ratio",
              "strength"]
#: Groups of evidence.yaml that are one study of one powder, and the numbers that they vary. Within `loose`
#: the inertial number goes with d/W; it stays below a thousandth.
STUDIES = {"dense": (["width"], ["narrowness"]),
           "dense, one box": (["ratio"], ["narrowness"]),
           "sizes": (["sizes"], ["narrowness"]),
           "loose": (["loose", "loose_fine", "loose_true_weight", "loose_narrow"], ["narrowness", "weight"]),
           "rate": (["inertia"], ["inertia"]),
           "soft": (["overlap"], ["overlap"])}
#: At one rate in one machine the inertial number goes with d, and its effect is in the slope over d/W.
INCLUDED = {"shear_cell": {"inertia": 3.8e-3}}
#: Of results/strength.csv; the others are these with one coefficient a little changed.
MATERIALS = ("base", "cohesionless", "plateau", "pull_off", "k1_10", "kadh_7.5", "tensile_200")
#: Columns of results/strength.csv and what they are here.
OLDER = {"strain": "strain", "porosity": "porosity", "coordination": "coordination",
         "bulk_modulus": "bulk_modulus", "lateral_ratio": "lateral_ratio", "strength": "strength_96kPa"}


def with_numbers(runs: pd.DataFrame) -> pd.DataFrame:
    """Adds the numbers that errors depend on, and strength after the last level: of loose specimens, which harden
    without a peak, the stress at 5% of crushing."""
    gravity = np.where(runs["start"] == "loose",
                       runs["gravity"] * np.where(runs["weight"] == "true", 1.0, runs["dref"] / runs["d"]), 0.0)
    size = np.where(runs["scaled"] == "yes", runs["d"] / runs["dref"], 1.0)
    mass = runs["density"] * np.pi / 6.0 * runs["d"]**3
    columns = (np.where(runs["start"] == "loose", "stress_at_5_percent_", "strength_")
               + runs["level"].astype(str).str.split().str[-1])
    return runs.rename(columns={"weight": "gravity_is"}).assign(
        narrowness=runs["d"] / runs["side"],
        inertia=runs["inertial_number"],
        weight=mass * gravity / (size**2 * -runs["f0"]),
        strength=[row.get(column, np.nan) for column, (_, row) in zip(columns, runs.iterrows())])


def older(path: Path) -> Dict[str, pd.DataFrame]:
    """The studies of strength.md: scaled specimens of each material, means with their errors."""
    table = pd.read_csv(path)
    table = table[(table["mode"] == "scaled") & (table["strain_rate"] == 0.5) & table["special"].isna()
                  & table["material"].isin(MATERIALS)]
    made = {}
    for material, rows in table.groupby("material"):
        means = pd.DataFrame({"narrowness": rows["diameter_mm"] / rows["width_mm"]})
        for name, column in OLDER.items():
            if rows[column].notna().all():
                means[name], means[f"{name}_error"] = rows[column], rows[f"{column}_error"] / rows[column]
        made[f"strength.md, {material}"] = means
    return made


def machines(path: Path) -> Dict[str, pd.DataFrame]:
    """The machines, a table each, with the errors of two fillings."""
    made = {}
    for machine, rows in pd.read_csv(path, comment="#").groupby("machine"):
        parts = [pd.DataFrame({"narrowness": some["narrowness"], quantity: some["value"],
                               f"{quantity}_error": some["error"] / some["value"]})
                 for quantity, some in rows.groupby("quantity")]
        made[machine] = pd.concat(parts, ignore_index=True)
    return made


def slopes(runs: pd.DataFrame) -> pd.DataFrame:
    known = with_numbers(runs)
    parts: List[pd.DataFrame] = []
    for study, (groups, numbers) in STUDIES.items():
        parts.append(evidence.slopes_of(known[known["group"].isin(groups)], study, QUANTITIES, numbers))
    for study, means in older(HERE / "results" / "strength.csv").items():
        parts.append(evidence.slopes_of(means, study, QUANTITIES, ["narrowness"], "strength.md"))
    for machine, means in machines(HERE.parent / "machines" / "coarse.csv").items():
        parts.append(evidence.slopes_of(means, machine, [c for c in means if f"{c}_error" in means],
                                        ["narrowness"], included=INCLUDED.get(machine, {})))
    return pd.concat(parts, ignore_index=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=HERE.parents[1] / "build" / "evidence",
                        help="folder of the runs")
    parser.add_argument("--study", type=Path, default=HERE / "evidence.yaml")
    arguments = parser.parse_args()
    runs, curves = tidy(read_study(arguments.study), arguments.out, HERE)
    runs.to_csv(HERE / "results" / "evidence_runs.csv", float_format="%.6g")
    curves.to_csv(HERE / "results" / "evidence_curves.csv.gz", index=False, float_format="%.6g")
    found = slopes(runs)
    soft = runs[runs["group"].isin(("overlap", "width"))]
    pressure = soft["level"].astype(str).str.split().str[-1].astype(float) * soft["dref"] / soft["k1"]
    print(f"overlap over p d/k1: {(soft['overlap'] / pressure).groupby(soft['k1']).mean().round(3).to_dict()}")
    known = with_numbers(runs)
    evidence_figures.limits(known, HERE / "results" / "evidence_limits.png")
    evidence_figures.loose(known, curves, HERE / "results" / "evidence_loose.png")
    found.to_csv(evidence.TABLE, index=False, float_format="%.5g")
    print(found.to_string())


if __name__ == "__main__":
    main()

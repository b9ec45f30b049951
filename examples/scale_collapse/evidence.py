#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""From the runs of evidence.yaml (`coarsen run`) and older results to what `coarsen plan` predicts from:
results/evidence_runs.csv, a row a specimen; results/evidence_curves.csv.gz; and the package's evidence.csv,
slopes of quantities over dimensionless numbers. See evidence.md."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Dict, List, Sequence

import numpy as np
import pandas as pd

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "coarsen"))

import evidence_figures  # noqa: E402  (beside this file)
from coarsen import check, evidence  # noqa: E402
from coarsen.measure import BadRun  # noqa: E402
from coarsen.results import PRELOAD, tidy  # noqa: E402
from coarsen.study import read_study  # noqa: E402

QUANTITIES = ["strain", "porosity_before", "porosity", "coordination", "bulk_modulus", "lateral_ratio",
              "strength"]
#: Strain between stresses (Pa) that a bed's weight plays no part in, for the loose starts.
LATER, AFTER = "later strain", (2.5e3, 9.0e3)
NAMES = {"strain": "strain", "porosity_before": "porosity before", "porosity": "porosity", "coordination": "Z",
         "bulk_modulus": "bulk modulus", "lateral_ratio": "lateral ratio", "strength": "strength"}
#: Groups of evidence.yaml that are one study of one powder, and the numbers that they vary.
STUDIES = {"dense": (["width"], ["narrowness"]),
           "dense, one box": (["ratio"], ["narrowness"]),
           "sizes": (["sizes"], ["narrowness"]),
           "rate": (["inertia"], ["inertia"]),
           "soft": (["overlap"], ["overlap"])}
#: Those of loose starts. In them d/W goes with the weight of the bed, so that its effect is taken from the other studies;
#: so does the inertial number, which is below two thousandths.
LOOSE = ["loose", "loose_fine", "loose_true_weight"]
#: Beyond it the effect of the inertial number is no longer in proportion to it, and grows fast (evidence.md).
LINEAR_INERTIA = 2.0e-3
#: The same of overlaps, of which `coarsen plan` allows no more.
LARGEST_OVERLAP = 0.06
#: Groups in which a seed has one packing, whatever the number that is varied.
PAIRED = ("inertia", "overlap")
#: At one rate in one machine the inertial number goes with d, and its effect is in the slope over d/W; likewise, with the same
#: gravity at every diameter, weight over attraction (of ../machines/in.powder, up to 3 mm) and what the bed weighs.
INCLUDED = {"shear_cell": {"inertia": 3.8e-3, "weight": 0.771, "bed": 0.15},
            **{machine: {"weight": 0.771, "bed": np.inf} for machine in ("silo 16 mm", "silo 20 mm")}}
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
        bed=runs["particles"] * mass * gravity / runs["side"]**2 / (PRELOAD * runs["ppack"]),
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
        some = known[known["group"].isin(groups) & (known["inertia"] <= LINEAR_INERTIA)
                     & (known["overlap"] <= LARGEST_OVERLAP)]
        # some specimens of the one box are those of the other widths
        parts.append(evidence.slopes_of(some, study, QUANTITIES, numbers, "dense" if "dense" in study else "",
                                        paired=study in ("rate", "soft")))
    for study, means in older(HERE / "results" / "strength.csv").items():
        parts.append(evidence.slopes_of(means, study, QUANTITIES, ["narrowness"], "strength.md"))
    for machine, means in machines(HERE.parent / "machines" / "coarse.csv").items():
        parts.append(evidence.slopes_of(means, machine, [c for c in means if f"{c}_error" in means],
                                        ["narrowness"], included=INCLUDED.get(machine, {})))
    dense = pd.concat(parts, ignore_index=True)
    loose = loose_slopes(known[known["group"].isin(LOOSE)], dense)
    return pd.concat([dense, loose], ignore_index=True)


def loose_slopes(some: pd.DataFrame, dense: pd.DataFrame) -> pd.DataFrame:
    """Over weight and bed, when the effect of d/W that other studies have is taken off; its error and scatter between
    those studies are in the errors. Strength, which is a stress at 5% of strain here, has that of other strengths."""
    numbers = ["weight", "bed"]
    effects = {quantity: evidence.effect(dense, quantity, "narrowness") for quantity in QUANTITIES}
    bare = some.assign(**{q: some[q] / np.exp(effects[q].slope * some["narrowness"]) for q in QUANTITIES})
    found = evidence.slopes_of(bare, "loose", QUANTITIES, numbers)
    # by how much a slope changes with that of d/W
    shares = evidence.slopes_of(some.assign(q=np.exp(some["narrowness"])), "", ["q"], numbers).set_index("number")["slope"]
    spread = found["quantity"].map({q: np.hypot(e.error, e.scatter) for q, e in effects.items()})
    return found.assign(error=np.hypot(found["error"], found["number"].map(shares) * spread))


#: Rows of the tables of evidence.md: what it says, and group, variables of the coarse and of the fine specimens.
COMPARED = (
    *((f"dense, one box, {1e3 * d:g} mm with 0.5 mm", ("ratio", {"d": d}), ("ratio", {"d": 0.5e-3}))
      for d in (1.5e-3, 2e-3, 3e-3)),
    *((f"the same, unscaled, {1e3 * d:g} mm", ("ratio_unscaled", {"d": d}), ("ratio", {"d": 0.5e-3}))
      for d in (2e-3, 3e-3)),
    *((f"loose, gravity over s, {1e3 * d:g} mm with 1 mm", ("loose", {"d": d}), ("loose_fine", {}))
      for d in (1.5e-3, 2e-3, 3e-3)),
    *((f"loose, the same gravity, {1e3 * d:g} mm", ("loose_true_weight", {"d": d}), ("loose_fine", {}))
      for d in (2e-3, 3e-3)),
    *((f"loose, unscaled, {1e3 * d:g} mm", ("loose_unscaled", {"d": d}), ("loose_fine", {})) for d in (2e-3, 3e-3)),
    *((f"loose, 1 mm, {1e3 * w:g} mm wide and high with 30 mm", ("loose_narrow", {"side": w}), ("loose_fine", {})) for w in (15e-3, 10e-3)),
    ("loose, as many diameters wide, 2 mm with 1 mm", ("loose", {"d": 2e-3}), ("loose_narrow", {"side": 15e-3})),
    ("loose, as many diameters wide, 3 mm with 1 mm", ("loose", {"d": 3e-3}), ("loose_narrow", {"side": 10e-3})),
    ("log-normal, 3 mm with 1.5 mm, one box", ("sizes", {"d": 3e-3, "side": 30e-3}), ("sizes", {"d": 1.5e-3})),
    ("log-normal, 3 mm with 1.5 mm, as many wide", ("sizes", {"d": 3e-3, "side": 60e-3}), ("sizes", {"d": 1.5e-3})),
    *((f"{w} diameters wide with 30", ("width", {"side": w * 2e-3}), ("width", {"side": 60e-3}))
      for w in (6, 8, 10, 15, 20, 40)),
    *((f"rate {r:g}/s with 0.2/s", ("inertia", {"rate": r}), ("inertia", {"rate": 0.2})) for r in (0.5, 1.5, 5.0, 10.0, 15.0)),
    *((f"stiffness over {5e3 / k:g}", ("overlap", {"k1": k}), ("overlap", {"k1": 5e3})) for k in (2e3, 1e3, 5e2, 2.5e2)))


def markdown(table: pd.DataFrame) -> str:
    """Rows of `compared` for evidence.md."""
    lines = ["| | packings | W/d | I | δ/d | " + " | ".join(NAMES[q] for q in QUANTITIES) + " | later strain |",
             "|---" * (6 + len(QUANTITIES)) + "|"]
    for row in table.to_dict("records"):
        later = row.get(LATER) if row["what"].startswith("loose") else None
        cells = [row["what"], row["packings"], f"{row['W/d']:.3g}", f"{row['I']:.1e}", f"{row['overlap']:.3f}",
                 *("" if pd.isna(row.get(q)) else row[q] for q in QUANTITIES), "" if pd.isna(later) else later]
        lines.append("| " + " | ".join(cells).replace("-", "−").replace("e−0", "e-") + " |")
    return "\n".join(lines)


def _chosen(known: pd.DataFrame, group: str, values: Dict[str, float]) -> pd.DataFrame:
    some = known[known["group"] == group]
    for name, value in values.items():
        some = some[np.isclose(some[name], value)]
    return some


def compared(known: pd.DataFrame) -> pd.DataFrame:
    """The rows of COMPARED that there are runs for: differences in %, ± standard error, of every quantity; with the
    mean d/W, inertial number and overlap of the coarse specimens."""
    rows = []
    for what, *kinds in COMPARED:
        coarse, fine = (_chosen(known, *kind) for kind in kinds)
        if coarse.empty or fine.empty:
            continue
        alike = [some for _, some in known[known["group"].isin([kind[0] for kind in kinds])].groupby(["group", "d", "side"])]
        row = {"what": what, "packings": f"{len(coarse)}, {len(fine)}", "W/d": 1.0 / coarse["narrowness"].mean(),
               "I": coarse["inertia"].mean(), "overlap": coarse["overlap"].mean()}
        for quantity in [*QUANTITIES, LATER]:
            sides, others = ([some.loc[some[quantity].notna(), [quantity, "particles", "seed"]] for some in kind]
                             for kind in ((coarse, fine), alike))
            if all(map(len, sides)):
                one, other = (np.log(side[quantity]) for side in sides)
                row[quantity] = f"{100 * np.expm1(one.mean() - other.mean()):+.1f}{_error(sides, quantity, kinds[0][0] in PAIRED, others)}"
        rows.append(row)
    return pd.DataFrame(rows)


def _error(sides: Sequence[pd.DataFrame], quantity: str, paired: bool, kinds: Sequence[pd.DataFrame]) -> str:
    """Standard error of the difference of the means of logarithms.

    A packing of N particles scatters with 1/sqrt(N), by as much in all specimens of the two groups: so one that is alone
    has an error, and two that happen to be alike have no less.

    :param paired: specimens of a seed are the same packing, and only their difference scatters
    :param kinds: of specimens of the two groups
    """
    if paired:
        one, other = (np.log(side.set_index("seed")[quantity]) for side in sides)
        return f" ± {100 * (one - other).sem():.1f}"
    several = [some for some in kinds if len(some) > 1]
    if not several:
        return ""
    freedom = [len(some) - 1 for some in several]
    scatter = sum(f * np.log(some[quantity]).var(ddof=1) * some["particles"].mean()
                  for f, some in zip(freedom, several)) / sum(freedom)
    return f" ± {100 * np.sqrt(sum(scatter / side['particles'].mean() / len(side) for side in sides)):.1f}"


def later_strain(curves: pd.DataFrame) -> pd.Series:
    """Of each run that begins below, strain on loading between the stresses AFTER: far above what a bed weighs."""
    load = curves[curves["branch"] == "load"]
    points = load.groupby("run").apply(lambda c: pd.Series(np.interp(AFTER, c["stress"], c["strain"], np.nan, np.nan)))
    return 1.0 - (1.0 - points[1]) / (1.0 - points[0])


def resampling(runs: pd.DataFrame, seeds: int = 6, count: int = 200) -> pd.DataFrame:
    """How often `coarsen check` says what, of packings drawn from those of resample.yaml: groups that are equal but for
    chance, and groups that are not. `truth` is the difference of all packings, %."""
    rows = []
    for what, coarse, fine, quantity, tolerance in (
            ("scaled, as many diameters wide", "coarse", "fine", "strain", 0.05),
            ("scaled, as many diameters wide", "coarse", "fine", "strength_96e3", 0.10),
            ("unscaled", "unscaled", "fine", "strain", 0.05),
            ("unscaled", "unscaled", "fine", "bulk_modulus", 0.05),
            ("10 diameters wide, not 20", "coarse", "wide", "strength_96e3", 0.05)):
        both = pd.concat([runs[runs["group"] == coarse].assign(d=2.0), runs[runs["group"] == fine].assign(d=1.0)])
        table = both.pivot(index="seed", columns="d", values=quantity).reindex(columns=[1.0, 2.0]).dropna()
        if len(table) < seeds:
            continue
        said = check.resample(both, quantity, 2.0, 1.0, min(seeds, len(table)), count, tolerance, fine != "wide")
        rows.append({"what": what, "quantity": quantity, "allowed (%)": 100 * tolerance, "packings": len(table),
                     "truth": 100.0 * np.expm1(np.log(table[2.0] / table[1.0]).mean()),
                     "error": 100.0 * np.log(table[2.0] / table[1.0]).sem(), **said.to_dict()})
    return pd.DataFrame(rows)


def with_earlier(found: pd.DataFrame, path: Path, names: pd.Index) -> pd.DataFrame:
    """Adds the rows of a results file whose runs are still in the study, and not among those found.

    :param names: of the study's runs, whose order the rows get
    """
    earlier = pd.read_csv(path, index_col="run")
    kept = earlier[earlier.index.isin(names) & ~earlier.index.isin(found.index)]
    both = pd.concat([some for some in (kept, found) if len(some)])
    return both.loc[[name for name in names if name in both.index]].rename_axis("run")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=HERE.parents[1] / "build" / "evidence",
                        help="folder of the runs; those that are not there, and are in the results, stay")
    parser.add_argument("--study", type=Path, default=HERE / "evidence.yaml")
    parser.add_argument("--resample", action="store_true",
                        help="instead, how often `coarsen check` is right on the runs of resample.yaml")
    arguments = parser.parse_args()
    if arguments.resample:
        runs, _ = tidy(read_study(HERE / "resample.yaml"), arguments.out, HERE)
        runs.to_csv(HERE / "results" / "resample_runs.csv", float_format="%.6g")
        print(resampling(runs).round(2).to_string(index=False))
        return
    study = read_study(arguments.study)
    try:
        runs, curves = tidy(study, arguments.out, HERE)
    except BadRun as none:
        print(f"{none}: only the results of earlier runs")
        runs, curves = pd.DataFrame(index=pd.Index([], name="run")), pd.DataFrame({"run": []})
    runs = with_earlier(runs, HERE / "results" / "evidence_runs.csv", study.index)
    curves = with_earlier(curves.set_index("run"), HERE / "results" / "evidence_curves.csv.gz", runs.index).reset_index()
    runs.to_csv(HERE / "results" / "evidence_runs.csv", float_format="%.6g")
    curves[["stress", "strain", "porosity", "coordination", "bulk_coordination", "run", "branch"]].to_csv(
        HERE / "results" / "evidence_curves.csv.gz", index=False, float_format="%.6g",
        compression={"method": "gzip", "mtime": 0})    # the same curves are the same file
    found = slopes(runs)
    soft = runs[runs["group"].isin(("overlap", "width"))]
    pressure = soft["level"].astype(str).str.split().str[-1].astype(float) * soft["dref"] / soft["k1"]
    print(f"overlap over p d/k1: {(soft['overlap'] / pressure).groupby(soft['k1']).mean().round(3).to_dict()}")
    known = with_numbers(runs)
    known[LATER] = later_strain(curves)
    table = compared(known)
    table.to_csv(HERE / "results" / "evidence.csv", index=False, float_format="%.3g")
    page = HERE / "evidence.md"
    before, _, rest = page.read_text(encoding="utf-8").partition("<!-- made by evidence.py -->\n")
    _, end, after = rest.partition("<!-- until here -->")
    page.write_text(f"{before}<!-- made by evidence.py -->\n{markdown(table)}\n{end}{after}", encoding="utf-8")
    evidence_figures.limits(known, HERE / "results" / "evidence_limits.png")
    evidence_figures.loose(known, curves, HERE / "results" / "evidence_loose.png")
    found.to_csv(evidence.TABLE, index=False, float_format="%.5g")
    print(found.to_string())


if __name__ == "__main__":
    main()

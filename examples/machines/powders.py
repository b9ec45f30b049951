#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Four powders that no study used: what `coarsen plan` says of coarse particles, beside runs made for it.

Limestone and coal in a tester of 30 mm, lactose in the ring of the shear tester, iron ore fines in a silo, each with a
finer and a coarser diameter; the real powders are finer still. Writes powders.csv: predicted difference with its
90% interval, measured difference with its standard error, and whether the one has the other."""
from __future__ import annotations

import argparse
import functools
import sys
from pathlib import Path
from typing import Dict, List, Mapping, Sequence

import numpy as np
import pandas as pd
import yaml

EXAMPLES = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(EXAMPLES.parent / "coarsen"), str(EXAMPLES), str(EXAMPLES / "silo")]

from coarsen import evidence, results, workflow  # noqa: E402
from coarsen.calibrate_command import Simulation  # noqa: E402
from coarsen.dimensionless import Loading, Powder  # noqa: E402
from coarsen.plan import numbers_of  # noqa: E402
from coarsen.study import read_study  # noqa: E402

import discharge  # noqa: E402  (of the silo)
import geometry  # noqa: E402

#: Diameters (m) that are compared, of each case the finer first, and packings of each.
SIZES = {"limestone": ((1.5e-3, 3), (3.0e-3, 4)), "coal": ((1.5e-3, 3), (3.0e-3, 6)), "lactose": ((2.0e-3, 2), (3.0e-3, 2)),
         "iron ore": ((1.5e-3, 2), (3.0e-3, 2))}
#: Coefficients at 1 mm; the real diameters are 50 um of limestone and coal, 100 um and 1 mm.
LIMESTONE = {"k1": 3.0e3, "k2": 9.0e3, "kadh": 6.0e3, "f0": -3.0e-4, "mu": 0.4, "mur": 0.02, "e": 0.2, "density": 2700.0}
COAL = {"k1": 8.0e2, "k2": 2.4e3, "kadh": 8.0e2, "f0": -2.0e-4, "mu": 0.35, "mur": 0.05, "e": 0.25, "density": 1400.0}
LACTOSE = {"k1": 1.5e2, "kadh": 6.0e1, "f0": -6.0e-5, "mu": 0.4, "mur": 0.01}
IRON_ORE = {"k1": 2.0e2, "k2": 4.0e2, "kadh": 5.0e1, "f0": -5.0e-5, "mu": 0.45, "mur": 0.01, "density": 4000.0}
WIDTH, RING, ORIFICE = 30.0e-3, 16.0e-3, 18.0e-3


def pressed(name: str, powder: Mapping[str, float], top: str, out: Path, lmp: Path, cores: int) -> pd.DataFrame:
    """Confined and unconfined compression, a row a specimen.

    :param top: the last level, Pa
    """
    common = {"infile": "in.confined", **{k: repr(v) for k, v in powder.items()}, "level": [["16e3", top]],
              "after": {"infile": "in.unconfined", "state": f"level_{top}"}}
    study = _study(out / name, {f"d{k}": {**common, "d": repr(d), "seed": f"1..{seeds}"}
                                for k, (d, seeds) in enumerate(SIZES[name])})
    infiles = EXAMPLES / "scale_collapse"
    workflow.run_study(study, infiles, study.parent, lmp, cores)
    runs, _ = results.tidy(read_study(study), study.parent, infiles)
    return runs.rename(columns={f"strength_{top}": "strength"})


def lactose(out: Path, lmp: Path, cores: int) -> pd.DataFrame:
    targets = pd.DataFrame({"quantity": ["shear_strength", "flow_function", "friction_angle", "steady_angle"]})
    rows = []
    for d, seeds in SIZES["lactose"]:
        arguments = argparse.Namespace(
            diameter=d, dref=1.0e-3, law="linear", seeds=seeds, first_seed=1, side=WIDTH, preshear=5.0e3,
            out=out / f"lactose_d{1e3 * d:g}mm", lmp=lmp, cores=cores, ranks=1, snakemake=[], switches="")
        (found,) = Simulation(arguments, targets.assign(stress=np.nan))([LACTOSE])
        rows += [{"d": d, **dict(zip(targets["quantity"], values))} for values in found]
    return pd.DataFrame(rows)


def iron_ore(out: Path, lmp: Path, cores: int) -> pd.DataFrame:
    """Flow over Beverloo's law at the diameter."""
    shape = {"radius": 0.02, "cone": 0.02, "height": 0.07, "orifice": 0.5 * ORIFICE}
    stl = out / "silo_stl"
    geometry.write(stl, {**shape, "facets": 60})
    study = _study(out / "silo", {f"d{k}": {
        "infile": "in.silo", "material": "powder", "d": repr(d), "n": round(40000 * (1.0e-3 / d)**3), "seed": f"1..{seeds}",
        "settle": 0.15, "time": 1.2, "stl": str(stl), "shared": str(EXAMPLES / "machines"),
        **{k: repr(v) for k, v in {**shape, **IRON_ORE}.items()}} for k, (d, seeds) in enumerate(SIZES["iron ore"])})
    workflow.run_study(study, EXAMPLES / "silo", study.parent, lmp, cores)
    rows = []
    for run, row in read_study(study).iterrows():
        table = pd.read_csv(study.parent / run / "discharge.csv")
        d, density = float(row["d"]), 0.55 * IRON_ORE["density"]
        mass = np.pi / 6.0 * d**3 * IRON_ORE["density"]
        rows.append({"d": d, "flow": discharge.analyse(table["time"], table["inside"]).rate * mass
                     / discharge.beverloo(ORIFICE, d, density)})
    return pd.DataFrame(rows)


def _study(folder: Path, groups: Dict[str, dict]) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "study.yaml"
    text = yaml.safe_dump({"groups": groups}, sort_keys=False)
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
    return path


def _powder(diameter: float, at_1mm: Mapping[str, float]) -> Powder:
    return Powder(diameter, at_1mm["density"], 1e-3, *(at_1mm[name] for name in ("k1", "k2", "kadh", "f0")))


def compare(case: str, runs: pd.DataFrame, quantities: Sequence[str], powder: Powder, loading: Loading,
            table: pd.DataFrame) -> List[dict]:
    fine, coarse = (d for d, _ in SIZES[case])
    # with gravity all have the same
    changes = {name: (value, numbers_of(powder, loading, coarse, False)[name])
               for name, value in numbers_of(powder, loading, fine, False).items()}
    rows = []
    for quantity in quantities:
        predicted = evidence.predict(table, quantity, changes)
        one, other = (np.log(runs.loc[np.isclose(runs["d"], d), quantity].dropna()) for d in (coarse, fine))
        measured = float(np.expm1(one.mean() - other.mean()))
        rows.append({"powder": case, "quantity": quantity, "predicted": predicted.error, "low": predicted.low,
                     "high": predicted.high, "outside": "; ".join(predicted.outside), "measured": measured,
                     "error": float(np.hypot(one.sem(), other.sem())),
                     "inside": predicted.low <= measured <= predicted.high})
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=workflow.results_folder() / "powders", help="folder of the runs")
    parser.add_argument("--lmp", default=None)
    parser.add_argument("--cores", type=int, default=workflow.cores())
    parser.add_argument("--predict", action="store_true", help="only the predictions, without a run")
    parser.add_argument("--only", nargs="+", choices=list(SIZES), default=list(SIZES), help="some of the powders")
    arguments = parser.parse_args()
    out, table = arguments.out.resolve(), evidence.read()
    nothing = pd.DataFrame({"d": []})
    tester = ["strain", "porosity", "coordination", "bulk_modulus", "lateral_ratio", "strength"]
    cases = {
        "limestone": (functools.partial(pressed, "limestone", LIMESTONE, "80e3"), tester, _powder(50e-6, LIMESTONE),
                      Loading(WIDTH, WIDTH, WIDTH, 0.62, 5e3, 80e3, 0.5, 0.2, 0.0)),
        "coal": (functools.partial(pressed, "coal", COAL, "40e3"), tester, _powder(50e-6, COAL),
                 Loading(WIDTH, WIDTH, WIDTH, 0.62, 5e3, 40e3, 0.5, 0.2, 0.0)),
        "lactose": (lactose, ["shear_strength", "flow_function", "friction_angle", "steady_angle"],
                    _powder(100e-6, {"density": 2000.0, "k2": 2 * LACTOSE["k1"], **LACTOSE}),
                    Loading(RING, RING, RING, 0.55, 5e3, 5e3, 2.0, 1.2, 9.81)),
        "iron ore": (iron_ore, ["flow"], _powder(1e-3, IRON_ORE),
                     Loading(ORIFICE, ORIFICE, ORIFICE, 0.55, 300.0, 300.0, 1e-3, 1.0, 9.81))}
    rows: List[dict] = []
    for case, (run, quantities, powder, loading) in cases.items():
        if case not in arguments.only:
            continue
        runs = (nothing.reindex(columns=["d", *quantities]) if arguments.predict
                else run(out, workflow.find_lmp(arguments.lmp), arguments.cores))
        rows += compare(case, runs, quantities, powder, loading, table)
    found = pd.DataFrame(rows)
    if arguments.predict:
        found = found.drop(columns=["measured", "error", "inside"])
    out.mkdir(parents=True, exist_ok=True)
    found.to_csv(out / "powders.csv", index=False, float_format="%.4g")
    print(found.round(4).to_string(index=False))
    if not arguments.predict:
        print(f"\n{int(found['inside'].sum())} of {len(found)} inside the interval")


if __name__ == "__main__":
    main()

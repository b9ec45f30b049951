# SPDX-License-Identifier: GPL-2.0-only
"""`coarsen calibrate`: its options, and its runs of specimens and of the shear tester."""
from __future__ import annotations

import argparse
import importlib.util
import math
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, Dict, List, Mapping, Sequence

import numpy as np
import pandas as pd
import yaml

from . import calibrate, measure, workflow
from .dimensionless import Powder
from .options import add_running
from .results import PRELOAD, defaults_of

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SPECIMENS, SHEAR_CELL = EXAMPLES / "scale_collapse", EXAMPLES / "shear_cell"
#: Of preshear over which the powder is sheared to failure.
PARTS = (0.25, 0.5, 0.75)


def add(commands: Any) -> None:
    """Adds the command to the parser's commands."""
    parser = commands.add_parser(
        "calibrate", help="coefficients with which coarse particles give what was measured",
        description="Targets are a CSV file with columns quantity, stress, value, error. Quantities of confined "
                    "compression: strain and porosity_change at a stress, from the preload; strength after "
                    "consolidation at a stress, unconfined. Of a shear tester: friction_angle, steady_angle, "
                    "flow_function, shear_strength (unconfined, from the yield locus).")
    parser.add_argument("targets", type=Path)
    parser.add_argument("--diameter", type=float, required=True, metavar="M", help="of the coarse particles")
    parser.add_argument("--free", nargs="+", default=["k1", "kadh"], metavar="NAME",
                        help=f"what is sought, of {' '.join(calibrate.FREE)}; k2 stays 2 k1 (k1 kadh)")
    for name, value in (("k1", 5.0e3), ("kadh", 5.0e3), ("f0", -6.6667e-5), ("mu", 0.5), ("mur", 0.001)):
        parser.add_argument(f"--{name}", type=float, default=value, help=f"first value ({value:g})")
    parser.add_argument("--dref", type=float, default=1.0e-3, metavar="M", help="diameter that they belong to (1e-3)")
    parser.add_argument("--law", choices=("linear", "plateau", "luding"), default="linear", help="(linear)")
    parser.add_argument("--seeds", type=int, default=3, metavar="N", help="packings of each set; 2 or more for errors (3)")
    parser.add_argument("--first-seed", type=int, default=1001, metavar="S", help="(1001)")
    parser.add_argument("--side", type=float, default=30.0e-3, metavar="M", help="width of the specimens (0.03)")
    parser.add_argument("--preshear", type=float, default=5.0e3, metavar="PA", help="of the shear tester (5e3)")
    parser.add_argument("--steps", type=int, default=8, metavar="N", help="of the optimiser at most (8)")
    add_running(parser, "calibrate")
    parser.set_defaults(work=run)


def _check(a: argparse.Namespace) -> None:
    """:raise ValueError: for what is not allowed, before anything runs"""
    for name in ("seeds", "steps"):
        if getattr(a, name) < 1:
            raise ValueError(f"--{name} is {getattr(a, name)}, allowed is 1 or more")
    if len(set(a.free)) < len(a.free):
        raise ValueError(f"--free {' '.join(a.free)}: allowed is each once")
    Powder(a.diameter, 2000.0, a.dref, a.k1, 2.0 * a.k1, a.kadh, a.f0)    # which says what is wrong
    for name, least in (("mu", 0.0), ("mur", 0.0), ("preshear", 1.0), ("side", 6.0 * (1.0 - 1.0e-9) * a.diameter)):
        if not least <= getattr(a, name) < math.inf:
            raise ValueError(f"--{name} is {getattr(a, name):g}, allowed are numbers from {least:g} on")


def run(arguments: argparse.Namespace) -> int:
    _check(arguments)
    targets = calibrate.read_targets(arguments.targets)
    preload = PRELOAD * float(defaults_of(SPECIMENS / "in.confined")["ppack"])
    low = targets[targets["stress"] <= preload]
    if len(low):
        raise ValueError(f"{arguments.targets}: {low['quantity'].iloc[0]} at {low['stress'].iloc[0]:g} Pa, allowed are "
                         f"stresses above the preload of {preload:g} Pa")
    if arguments.law != "linear" and targets["quantity"].isin(calibrate.SHEAR).any():
        raise ValueError(f"--law is {arguments.law}: the powder of the shear tester has the law linear")
    arguments.out = arguments.out.resolve()
    start = {name: getattr(arguments, name) for name in calibrate.FREE}

    def note(values: Mapping[str, float], distance: float) -> None:
        print(", ".join(f"{name} {values[name]:.5g}" for name in arguments.free) + f": {distance:.3f} errors away",
              flush=True)

    found = calibrate.fit(start, arguments.free, targets, Simulation(arguments, targets), arguments.steps, note)
    values = {"k1": found.values["k1"], "k2": 2.0 * found.values["k1"],
              **{name: value for name, value in found.values.items() if name != "k1"}, "dref": arguments.dref}
    text = calibrate.include_file(calibrate.Fit(values, found.errors, found.distance, found.evaluations, found.found,
                                                found.message), arguments.free,
                                  f"{1e3 * arguments.diameter:g} mm, {arguments.seeds} packings, law {arguments.law}")
    (arguments.out / "in.calibrated").write_text(text + f"variable law       index {arguments.law}\n", encoding="utf-8")
    found.found.to_csv(arguments.out / "calibration.csv", index=False, float_format="%.6g")
    print(f"\n{text}\n{found.found.to_string(index=False)}\n\n{found.message}\nInclude file: "
          f"{arguments.out / 'in.calibrated'}; errors for coarsen plan: {arguments.out / 'calibration.csv'}")
    return 0


class Simulation:
    """Runs sets of coefficients and measures the targets' quantities."""

    def __init__(self, arguments: argparse.Namespace, targets: pd.DataFrame) -> None:
        self._arguments, self._targets = arguments, targets
        self._sheared = targets["quantity"].isin(calibrate.SHEAR)
        self._lmp = workflow.find_lmp(arguments.lmp)
        self._done = 0

    def __call__(self, sets: Sequence[Mapping[str, float]]) -> List[np.ndarray]:
        columns = np.empty((len(sets), self._arguments.seeds, len(self._targets)))
        if not self._sheared.all():
            columns[:, :, ~self._sheared] = self._specimens(sets)
        if self._sheared.any():
            columns[:, :, self._sheared] = self._shear_cells(sets)
        return list(columns)

    def _study(self, name: str, groups: Dict[str, Any], infiles: Path) -> Path:
        """Runs the groups in a folder of their own and returns it."""
        out = self._arguments.out / name
        out.mkdir(parents=True, exist_ok=True)
        study = out / f"study_{self._done}.yaml"
        self._done += 1
        study.write_text(yaml.safe_dump({"groups": groups}, sort_keys=False), encoding="utf-8")
        workflow.run_study(study, infiles, out, self._lmp, self._arguments.cores, self._arguments.ranks,
                           ["--quiet", "all", *self._arguments.snakemake], self._arguments.switches)
        return out

    def _common(self, values: Mapping[str, float]) -> Dict[str, Any]:
        a = self._arguments
        return {"d": repr(a.diameter), "dref": repr(a.dref), "k2": repr(2.0 * values["k1"]),
                **{name: repr(value) for name, value in values.items()},
                "seed": list(range(a.first_seed, a.first_seed + a.seeds))}

    def _specimens(self, sets: Sequence[Mapping[str, float]]) -> np.ndarray:
        a, targets = self._arguments, self._targets[~self._sheared]
        crushed = [f"{p:g}" for p in sorted(targets.loc[targets["quantity"] == "strength", "stress"].unique())]
        # A tenth more than what is wanted last, for the platen lags.
        levels = sorted({f"{1.1 * targets['stress'].max():g}", *crushed}, key=float)
        groups = {_name(values): {
            "infile": "in.confined", **self._common(values), "law": a.law, "side": repr(a.side),
            # as many as the 32400 of 1 mm in 30 mm, packed as stiffly and as fast
            "nref": round(32400 * (a.side / 30e-3)**3 * (1e-3 / a.dref)**3), "kpack": repr(5e6 * a.dref),
            "packrate": repr(1e-3 / a.dref),
            "level": [levels] if len(levels) > 1 else levels[0],
            **({"after": {"infile": "in.unconfined", "state": [f"level_{p}" for p in crushed]}} if crushed else {})}
            for values in sets}
        out = self._study("specimens", groups, SPECIMENS)
        preload = PRELOAD * float(defaults_of(SPECIMENS / "in.confined")["ppack"])
        found = []
        for group in groups:
            for seed in range(a.first_seed, a.first_seed + a.seeds):
                folder = out / group / (f"seed={seed}" if a.seeds > 1 else "run")
                load = measure.loading(measure.read_curve(folder / "curve.csv"), preload, str(folder))
                found.append([self._of_specimen(folder, load, row, len(crushed)) for row in targets.itertuples()])
        return np.array(found).reshape(len(sets), a.seeds, -1)

    def _of_specimen(self, folder: Path, load: pd.DataFrame, target: Any, crushed: int) -> float:
        if target.quantity == "strength":
            name = f"state=level_{target.stress:g}" if crushed > 1 else "after"
            crush, unload = (measure.read_curve(folder / name / file) for file in ("curve.csv", "unload.csv"))
            return measure.measure_crushed(crush, unload, str(folder / name))["strength"]
        if target.quantity == "strain":
            return float(measure.at_stress(load, target.stress, "strain"))
        return float(load["bulk_porosity"].iloc[0] - measure.at_stress(load, target.stress, "bulk_porosity"))

    def _shear_cells(self, sets: Sequence[Mapping[str, float]]) -> np.ndarray:
        a = self._arguments
        geometry, yield_locus = _of_shear_cell("geometry"), _of_shear_cell("yield_locus")
        meshes = a.out / "shear_cells"
        meshes.mkdir(parents=True, exist_ok=True)
        geometry.write(meshes, geometry.MESH)
        more = {**{k: repr(v) for k, v in geometry.SHAPE.items()}, "consolidation": repr(a.preshear), "stl": str(meshes),
                "shared": str(EXAMPLES / "machines"), "rate": 2.0}
        groups = {}
        for values in sets:
            common = {**self._common(values), **more}
            again = {k: v for k, v in common.items() if k != "seed"}
            groups[_name(values)] = {"infile": "in.preshear", **common, "preshear": 1.2, "after": {
                "infile": "in.shear", "state": ".", **again, "shearing": 0.15, "level": list(PARTS)}}
        out = self._study("shear_cells", groups, SHEAR_CELL)
        found = []
        for group in groups:
            for seed in range(a.first_seed, a.first_seed + a.seeds):
                folder = out / group / (f"seed={seed}" if a.seeds > 1 else "run")
                steady = pd.read_csv(folder / "preshear.csv")
                preshear = tuple(yield_locus.steady_state(steady["strain"], steady[name])[0]
                                 for name in ("normal", "shear"))
                points = [yield_locus.failure(*(pd.read_csv(folder / f"level={part}" / "shear.csv")[name].to_numpy()
                                                for name in ("strain", "normal", "shear"))) for part in PARTS]
                flow = yield_locus.flow(*np.transpose(points), preshear)
                known = {"friction_angle": flow.friction, "steady_angle": flow.steady, "flow_function": flow.ffc,
                         "shear_strength": flow.unconfined}
                wanted = list(self._targets.loc[self._sheared, "quantity"])
                odd = [q for q in wanted if not 0.0 < known[q] < np.inf]
                if odd:
                    raise ValueError(f"{folder}: {odd[0]} is {known[odd[0]]:g}, so that it can not be fitted")
                found.append([known[q] for q in wanted])
        return np.array(found).reshape(len(sets), a.seeds, -1)


def _of_shear_cell(name: str) -> ModuleType:
    """A module of examples/shear_cell, under a name of its own: other machines have a geometry, too."""
    if str(EXAMPLES) not in sys.path:
        sys.path.insert(0, str(EXAMPLES))  # of the package `machines`
    own = f"shear_cell_{name}"
    if own not in sys.modules:
        spec = importlib.util.spec_from_file_location(own, SHEAR_CELL / f"{name}.py")
        sys.modules[own] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[own])
    return sys.modules[own]


def _name(values: Mapping[str, float]) -> str:
    """Of a folder; equal coefficients have equal ones."""
    return ",".join(f"{name}={value:.8g}" for name, value in values.items())

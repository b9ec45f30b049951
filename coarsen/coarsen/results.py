# SPDX-License-Identifier: GPL-2.0-only
"""From the folders of a study's runs to one tidy table, a row a specimen, and to its curves."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Dict, List, Optional, Tuple

import pandas as pd

from . import measure
from .study import NOT_VARIABLES

_DEFAULT = re.compile(r"^variable\s+(\w+)\s+index\s+(.*?)\s*(?:#.*)?$", re.MULTILINE)
_RESULT = re.compile(r"^Result (\S+) (\S+)\s*$", re.MULTILINE)
_MULTIPLE = re.compile(r"^\$\(([\d.]+)\*v_(\w+)\)$")
_STAGE = re.compile(r"^Stage (\w+)\s*$")
_LOOP = re.compile(r"^Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms")
_CPU = re.compile(r"^(\S+)% CPU use with")
#: Stages that make a specimen rather than test it.
MAKING = ("start", "place", "relax", "pack", "rain", "press")
#: Of the stress at which a packing is made, from which on strain counts.
PRELOAD = 1.25
#: What costs() tells of a run.
COSTS = ("particles", "seconds", "test_seconds", "steps", "test_steps")


def defaults_of(infile: Path) -> Dict[str, str]:
    """The variables that an in-file's head sets where the command line does not."""
    return dict(_DEFAULT.findall(infile.read_text(encoding="utf-8")))


def read_results(folder: Path) -> Dict[str, float]:
    """The quantities that a run's log has lines `Result NAME NUMBER` of.

    :raise measure.BadRun: with one that is no number
    """
    log = (folder / "log.lammps").read_text(encoding="utf-8", errors="replace")
    found: Dict[str, float] = {}
    for name, text in _RESULT.findall(log):
        try:
            found[name] = float(text)
        except ValueError as error:
            raise measure.BadRun(f"{folder}: result {name} is {text}, allowed is a number") from error
    return found


def tidy(table: pd.DataFrame, out: Path, infiles: Optional[Path] = None) -> Tuple[pd.DataFrame, pd.DataFrame]:
    """Every finished run of a study, but those that go on from others, whose results join its row: its variables,
    defaults included, and what was measured; and the curves of all specimens, in one table.

    Specimens (of in.confined and in.oedometer) are measured, with `strength_LEVEL` and more for each level that they
    were crushed after; of other runs the Result lines are taken. The columns that were measured, costs apart, are in the
    table's attrs["results"].

    :param infiles: folder of in-files, for runs that have none of their own
    """
    first = table[table["needs"].isna()] if "needs" in table else table
    rows, curves, results = [], [], []
    for run, row in first[[_is_done(out, name) for name in first.index]].iterrows():
        given = {k: v for k, v in row.items() if k not in NOT_VARIABLES and not pd.isna(v)}
        infile = (out / run / "infiles" if (out / run / "infiles").is_dir() else infiles or out) / row["infile"]
        given = {**(defaults_of(infile) if infile.is_file() else {}), **_of_parameters(given, out / run), **given}
        after = table[table["needs"] == run] if "needs" in table else table.iloc[:0]
        after = after[[_is_done(out, name) for name in after.index]]
        if _is_specimen(out / run):
            measured, own = _specimen(out, str(run), given, after)
            curves += own
        else:
            measured = {name: value for folder in [run, *after.index]
                        for name, value in read_results(out / folder).items()}
        results += measured
        rows.append({"run": run, "group": row["group"], **_numbers(given), **measured, **costs(out / run)})
    if not rows:
        raise measure.BadRun(f"{out}: no run of the study is finished")
    runs = pd.DataFrame(rows).set_index("run")
    runs.attrs["results"] = list(dict.fromkeys(results))
    return runs, pd.concat(curves, ignore_index=True) if curves else pd.DataFrame()


def _is_specimen(folder: Path) -> bool:
    path = folder / "curve.csv"
    if not path.is_file():
        return False
    with path.open(encoding="utf-8") as file:
        return "bulk_strain" in file.readline()


def _specimen(out: Path, run: str, given: Dict[str, str],
              after: pd.DataFrame) -> Tuple[Dict[str, float], List[pd.DataFrame]]:
    """What was measured on one specimen, and its curves."""
    diameter, density, packed = (float(given[name]) for name in ("d", "density", "ppack"))
    samples = measure.read_curve(out / run / "curve.csv")
    load = measure.loading(samples, PRELOAD * packed, str(out / run))
    # The platen lags: the last level is not always reached while loading.
    top = min(float(given.get("level", given.get("pmax", "inf")).split()[-1]), load["stress"].max())
    curves = [measure.curve_of(load, top).assign(run=run, branch="load"),
              measure.unloading_of(samples, load).assign(run=run, branch="unload")]
    measured = measure.measure_confined(samples, load, diameter, density, str(out / run))
    for then, row in after.iterrows():
        level = str(row["state"]).replace("level_", "")
        crush, unload = (measure.read_curve(out / then / name) for name in ("curve.csv", "unload.csv"))
        measured.update({f"{name}_{level}": value for name, value in
                         measure.measure_crushed(crush, unload, str(out / then)).items()})
        curves.append(measure.crushing_of(crush).assign(run=run, branch=f"crush_{level}"))
    return {**measured, "rained_porosity": _rained(out / run)}, curves


def _of_parameters(given: Dict[str, str], folder: Path) -> Dict[str, str]:
    """Variables of the file that in.confined's variable `parameters` names, which go before its own defaults."""
    path = folder / given.get("parameters", "none")
    return defaults_of(path) if path.is_file() else {}


def _is_done(out: Path, run: str) -> bool:
    return (out / run / "done").is_file()


def _numbers(given: Dict[str, str]) -> Dict[str, object]:
    """Numbers where they are such. Of defaults that depend on another variable those are known that are a
    multiple of it, $(2*v_k1); others are left out."""
    made: Dict[str, object] = {}
    for name, value in given.items():
        multiple = _MULTIPLE.match(value)
        if multiple:
            value = str(float(multiple.group(1)) * float(given[multiple.group(2)]))
        if name in ("files", "out", "parameters", "images", "colourstress") or "$" in value:
            continue
        try:
            made[name] = float(value)
        except ValueError:
            made[name] = value
    return made


def _rained(folder: Path) -> float:
    """Porosity of a loose start's bed before the platen touched it, where there is one."""
    found = re.search(r"^Rained: .*?porosity of its middle (\S+),",
                      (folder / "log.lammps").read_text(encoding="utf-8", errors="replace"), re.MULTILINE)
    return float(found.group(1)) if found else float("nan")


def costs(folder: Path) -> Dict[str, float]:
    """Of LAMMPS's loops, times the part of a core that they had: the whole run, and the test without the
    making of the specimen; particles and steps of both."""
    seconds: Dict[str, float] = {}
    steps: Dict[str, int] = {}
    stage, particles, loop = "start", 0, 0.0
    with (folder / "log.lammps").open(encoding="utf-8", errors="replace") as log:
        for line in log:
            found = _STAGE.match(line) or _LOOP.match(line) or _CPU.match(line)
            if found is None:
                continue
            if found.re is _STAGE:
                stage = found.group(1)
            elif found.re is _LOOP:
                loop, particles = float(found.group(1)), int(found.group(3))
                steps[stage] = steps.get(stage, 0) + int(found.group(2))
            else:
                seconds[stage] = seconds.get(stage, 0.0) + 0.01 * float(found.group(1)) * loop

    def of_test(values: Dict[str, float]) -> float:
        return sum(value for name, value in values.items() if name not in MAKING)

    return dict(zip(COSTS, (particles, sum(seconds.values()), of_test(seconds), sum(steps.values()), of_test(steps))))

# SPDX-License-Identifier: GPL-2.0-only
"""From the folders of a study's runs to one tidy table, a row a specimen, and to its curves."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Dict, Tuple

import pandas as pd

from . import measure
from .study import NOT_VARIABLES

_DEFAULT = re.compile(r"^variable\s+(\w+)\s+index\s+(.*?)\s*(?:#.*)?$", re.MULTILINE)
#: Of the stress at which a packing is made, from which on strain counts.
PRELOAD = 1.25


def defaults_of(infile: Path) -> Dict[str, str]:
    """The variables that an in-file's head sets where the command line does not."""
    return dict(_DEFAULT.findall(infile.read_text(encoding="utf-8")))


def tidy(table: pd.DataFrame, out: Path, infiles: Path) -> Tuple[pd.DataFrame, pd.DataFrame]:
    """Every finished specimen of a study: its variables, defaults included, and what was measured, with
    `strength_LEVEL` for each level that it was crushed after; and the curves of all, in one table."""
    specimens = table[table["needs"].isna()] if "needs" in table else table
    rows, curves = [], []
    for run, row in specimens[[_is_done(out, name) for name in specimens.index]].iterrows():
        given = {**defaults_of(infiles / row["infile"]),
                 **{k: v for k, v in row.items() if k not in NOT_VARIABLES and not pd.isna(v)}}
        diameter, density, packed = (float(given[name]) for name in ("d", "density", "ppack"))
        measured = measure.measure_confined(out / run, diameter, density, PRELOAD * packed)
        crushed = table[table["needs"] == run] if "needs" in table else table.iloc[:0]
        for then, after in crushed.iterrows():
            if _is_done(out, then):
                level = str(after["state"]).replace("level_", "")
                measured.update({f"{name}_{level}": value
                                 for name, value in measure.measure_crushed(out / then).items()})
        rows.append({"run": run, "group": row["group"], **_numbers(given), **measured,
                     "rained_porosity": _rained(out / run), "seconds": _seconds(out / run)})
        load = measure.loading(measure.read_curve(out / run / "curve.csv"), PRELOAD * packed, run)
        # The platen lags: the last level is not always reached while loading.
        curves.append(measure.curve_of(load, min(float(given["level"].split()[-1]), load["stress"].max()))
                      .assign(run=run))
    if not rows:
        raise measure.BadRun(f"{out}: no run of the study is finished")
    return pd.DataFrame(rows).set_index("run"), pd.concat(curves, ignore_index=True)


def _is_done(out: Path, run: str) -> bool:
    return (out / run / "done").is_file()


def _numbers(given: Dict[str, str]) -> Dict[str, object]:
    """Numbers where they are such; what depends on another variable is left out."""
    made: Dict[str, object] = {}
    for name, value in given.items():
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


def _seconds(folder: Path) -> float:
    """Wall time of the run, s."""
    cost = folder / "cost.tsv"
    return float(pd.read_csv(cost, sep="\t")["s"].iloc[0]) if cost.is_file() else float("nan")


def with_numbers(results: pd.DataFrame) -> pd.DataFrame:
    """Adds what errors depend on: `ratio` d/dref, `width` side/d."""
    return results.assign(ratio=results["d"] / results["dref"], width=results["side"] / results["d"])

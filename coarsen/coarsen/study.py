# SPDX-License-Identifier: GPL-2.0-only
"""From a study file to a table of runs: a row a run, a column a variable of the in-file.

A study file is YAML. `common` has variables of all runs; each entry of `groups` adds its own. A value
that is a list makes a run of each of its entries, several lists all combinations, and `zip` holds
lists that go together. `infile` names the in-file; `after` runs another in-file on the state that each
run left, with its own variables, such as a specimen that is crushed after each of its levels:

    common: {infile: in.confined, level: [[16e3, 96e3]]}
    groups:
      ratio: {d: [1e-3, 2e-3], scaled: ["yes", "no"], seed: [1, 2, 3],
              after: {infile: in.unconfined, state: [level_96e3]}}

A value of several words, such as `level` above, is a list within the list; 1..5 is [1, 2, 3, 4, 5].
"""
from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import Any, Dict, Iterable, List, Mapping, Tuple, Union

import pandas as pd
import yaml

#: Columns of the table that are no variables of an in-file.
NOT_VARIABLES = ("group", "infile", "needs")


class BadStudy(ValueError):
    """A study file that can not be meant so; the message names the file, the entry, and what is allowed."""


def read_study(path: Union[str, Path]) -> pd.DataFrame:
    """The table of runs of a study file, indexed by the names of the runs.

    Values are strings as LAMMPS reads them; a variable that a run does not set is missing (NA).

    :raise BadStudy: with what is wrong
    """
    try:
        study = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    except yaml.YAMLError as error:
        raise BadStudy(f"{path}: {error}") from error
    if not isinstance(study, dict) or not isinstance(study.get("groups"), dict):
        raise BadStudy(f"{path}: it has no `groups`, each a name with variables")
    unknown = set(study) - {"common", "groups"}
    if unknown:
        raise BadStudy(f"{path}: `{'`, `'.join(sorted(unknown))}` is not allowed beside common and groups")
    rows: List[Dict[str, Any]] = []
    for group, own in study["groups"].items():
        rows += _runs_of(str(group), {**(study.get("common") or {}), **(own or {})}, str(path))
    if not rows:
        raise BadStudy(f"{path}: it has no runs")
    table = pd.DataFrame(rows).set_index("run")
    if not table.index.is_unique:
        twice = table.index[table.index.duplicated()][0]
        raise BadStudy(f"{path}: two runs are named {twice}")
    return table.astype("string")


def _runs_of(group: str, entry: Mapping[str, Any], path: str) -> Iterable[Dict[str, Any]]:
    own = dict(entry)
    after = own.pop("after", None)
    if "infile" not in own:
        raise BadStudy(f"{path}: group {group} has no infile")
    for name, values in _combinations(own, f"{path}: group {group}"):
        run = f"{group}/{name}"
        yield {"run": run, "group": group, **values}
        if after:
            for then, more in _combinations(after, f"{path}: after in group {group}"):
                yield {"run": f"{run}/{then if then != 'run' else 'after'}", "group": group, "needs": run, **more}


def _combinations(entry: Mapping[str, Any], place: str) -> Iterable[Tuple[str, Dict[str, str]]]:
    """Every combination of the entry's values, with a name made of those that vary."""
    lists = {key: _list(value) for key, value in entry.items() if key != "zip"}
    axes = [[{key: one} for one in values] for key, values in lists.items()]
    together = {key: _list(value) for key, value in (entry.get("zip") or {}).items()}
    if len({len(values) for values in together.values()}) > 1:
        raise BadStudy(f"{place}: the lists of zip are of unequal lengths")
    if together:
        axes.append([dict(zip(together, ones)) for ones in zip(*together.values())])
    empty = [key for key, values in lists.items() if not values or None in values]
    if empty:
        raise BadStudy(f"{place}: {empty[0]} has no value")
    varied = [key for axis in axes if len(axis) > 1 for key in axis[0]]
    for parts in itertools.product(*axes):
        values = {key: _words(value) for part in parts for key, value in part.items()}
        marks = [f"{key}={values[key].replace(' ', '+')}" for key in varied]
        yield ",".join(marks) or "run", values


def _list(value: Any) -> List[Any]:
    span = re.fullmatch(r"(\d+)\.\.(\d+)", value) if isinstance(value, str) else None
    if span:
        return list(range(int(span.group(1)), int(span.group(2)) + 1))
    return value if isinstance(value, list) else [value]


def _words(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return " ".join(_words(one) for one in value)
    return repr(value) if isinstance(value, float) else str(value)


def variables(row: pd.Series) -> Dict[str, str]:
    """The variables that a run's row sets."""
    return {name: value for name, value in row.items()
            if name not in NOT_VARIABLES and not pd.isna(value)}

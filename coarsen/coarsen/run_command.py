# SPDX-License-Identifier: GPL-2.0-only
"""`coarsen run`: the runs of a study file, and one table of what they say."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from . import study, workflow
from .options import add_running
from .results import tidy


def add(commands: Any) -> None:
    """Adds the command to the parser's commands."""
    parser = commands.add_parser("run", help="the runs of a study file, and one table of what they say",
                                 description=study.__doc__,
                                 formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=Path, help="YAML file")
    parser.add_argument("--infiles", type=Path, default=None,
                        help="folder of the in-files (that of the study file)")
    parser.add_argument("--plan", action="store_true", help="only say what would be run")
    add_running(parser, "run")
    parser.set_defaults(work=run)


def run(arguments: argparse.Namespace) -> int:
    if not arguments.study.is_file():
        raise FileNotFoundError(f"there is no {arguments.study}")
    table = study.read_study(arguments.study)
    infiles, out = (arguments.infiles or arguments.study.parent).resolve(), arguments.out.resolve()
    absent = sorted({name for name in table["infile"] if not (infiles / name).is_file()})
    if absent:
        raise FileNotFoundError(f"{arguments.study}: there is no {infiles / absent[0]}")
    print("\n".join(f"{group}: {len(rows)} runs" for group, rows in table.groupby("group", sort=False)))
    if arguments.plan:
        return 0
    workflow.run_study(arguments.study, infiles, out, workflow.find_lmp(arguments.lmp), arguments.cores,
                       arguments.ranks, arguments.snakemake, arguments.switches)
    (out / "study.yaml").write_text(arguments.study.read_text(encoding="utf-8"), encoding="utf-8")  # for the report
    runs, curves = tidy(table, out, infiles)
    runs.to_csv(out / "runs.csv", float_format="%.6g")
    print(f"Table: {out / 'runs.csv'}, a row a run")
    if not curves.empty:
        curves.to_csv(out / "curves.csv.gz", index=False, float_format="%.6g")
        print(f"Curves: {out / 'curves.csv.gz'}")
    return 0

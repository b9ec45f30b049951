# SPDX-License-Identifier: GPL-2.0-only
"""`coarsen report`: its options."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import pandas as pd

from .results import tidy
from .study import read_study


def add(commands: Any) -> None:
    """Adds the command to the parser's commands."""
    parser = commands.add_parser("report", help="what coarsen run or check found, as one HTML file",
                                 description="Figures that can be zoomed, means with their errors, verdicts, and pictures before "
                                             "and after failure, in one file. Runs that are not finished are left out.")
    parser.add_argument("out", type=Path, help="folder of coarsen run or check")
    parser.add_argument("--study", type=Path, default=None, help="study file (study.yaml in that folder)")
    parser.add_argument("--infiles", type=Path, default=None, help="folder of the in-files (that of the study file)")
    parser.add_argument("--to", type=Path, default=None, help="the file (report.html in that folder)")
    parser.add_argument("--title", default=None)
    parser.set_defaults(work=run)


def run(arguments: argparse.Namespace) -> int:
    from . import report  # which needs more libraries than the other commands

    study = arguments.study or arguments.out / "study.yaml"
    for path in (arguments.out, study):
        if not path.exists():
            raise FileNotFoundError(f"there is no {path}")
    runs, curves = tidy(read_study(study), arguments.out, (arguments.infiles or study.parent).resolve())
    if not runs.attrs["results"]:
        raise ValueError(f"{arguments.out}: no run is a specimen of in.confined or in.oedometer, or has lines `Result NAME NUMBER`")
    checked = arguments.out / "check.csv"
    path = arguments.to or arguments.out / "report.html"
    report.write(path, arguments.title or f"{study.stem}: {len(runs)} specimens", runs, curves, arguments.out,
                 pd.read_csv(checked) if checked.is_file() else None)
    print(f"Report: {path}")
    return 0

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Compresses the same packing with particles of several diameters, with and without the scaling
of the contact law, and compares the curves: a table and a figure. See README.md."""
from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

try:
    import numpy  # noqa: F401
    import matplotlib  # noqa: F401
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; on Debian: "
             f"apt-get install python3-{missing.name} and /usr/bin/python3 {sys.argv[0]}")

from collapse import report  # noqa: E402
from collapse.cases import (LAWS, Case, folder_of, is_scaled, make_cases,  # noqa: E402
                            seeds_per_diameter)
from collapse.command import exit_status  # noqa: E402
from collapse.curves import load_curve  # noqa: E402
from collapse.progress import Progress  # noqa: E402
from collapse.runs import CURVE, Launcher, Runner, find_lmp, read_marker  # noqa: E402

FULL_DIAMETERS = [1.0e-3, 1.5e-3, 2.0e-3]
QUICK_DIAMETERS = [1.5e-3, 2.0e-3]


def build_folder() -> Path:
    return Path(os.environ.get("BUILD_DIR") or HERE.parent.parent / "build")


def cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def parse_arguments(words: Optional[Sequence[str]] = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--diameters", type=float, nargs="+", metavar="D", default=None,
                        help="particle diameters in m (default: "
                             f"{' '.join(f'{d:g}' for d in FULL_DIAMETERS)})")
    parser.add_argument("--seeds", type=int, nargs="+", metavar="N", default=[],
                        help="packings of each diameter: one number for all or one for each "
                             "(default: 2 of the smallest, more of the coarser ones)")
    parser.add_argument("--first-seed", type=int, default=1, metavar="S",
                        help="seeds are S, S + 1, ...: other packings for an independent check")
    parser.add_argument("--law", choices=LAWS, default="linear", help="contact law")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--scaled", action="store_true", help="only the scaled runs")
    which.add_argument("--unscaled", action="store_true", help="only the unscaled runs")
    parser.add_argument("--dref", type=float, default=1.0e-3, metavar="D",
                        help="diameter in m that the coefficients of in.oedometer belong to")
    parser.add_argument("--preload", type=float, default=5.0e3, metavar="P",
                        help="axial stress in Pa from which strain is counted")
    parser.add_argument("--lmp", type=Path, default=None,
                        help="LAMMPS with this package (default: lmp in the build folder)")
    parser.add_argument("--mpirun", default="mpirun", help="what starts it")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of each run")
    parser.add_argument("--jobs", type=int, default=None,
                        help="runs at once (default: as many as there are cores for)")
    parser.add_argument("--out", type=Path, default=None,
                        help="folder of runs, table and figure (default: scale_collapse in the "
                             "build folder)")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true",
                      help="two coarse diameters and one seed each, in well under a minute")
    size.add_argument("--full", action="store_true", help="twice the seeds")
    parser.add_argument("--redo", action="store_true",
                        help="run again what an earlier call has finished")
    arguments = parser.parse_args(words)
    if arguments.ranks < 1:
        parser.error(f"--ranks is {arguments.ranks}, allowed is 1 or more")
    if arguments.jobs is None:
        arguments.jobs = max(1, cores() // arguments.ranks)
    if arguments.jobs < 1:
        parser.error(f"--jobs is {arguments.jobs}, allowed is 1 or more")
    if not 2.0e3 <= arguments.preload <= 5.0e4:
        parser.error(f"--preload is {arguments.preload:g} Pa, allowed is 2e3 to 5e4")
    if arguments.diameters is None:
        arguments.diameters = QUICK_DIAMETERS if arguments.quick else FULL_DIAMETERS
    if arguments.quick and not arguments.seeds:
        arguments.seeds = [1]
    arguments.diameters = [float(d) for d in arguments.diameters]
    arguments.modes = (["scaled"] if arguments.scaled else ["unscaled"] if arguments.unscaled
                       else ["scaled", "unscaled"])
    try:
        arguments.seeds = seeds_per_diameter(arguments.diameters, arguments.seeds)
        if arguments.full:
            arguments.seeds = [2 * count for count in arguments.seeds]
        arguments.cases = make_cases(arguments.diameters, arguments.seeds, arguments.law,
                                     arguments.modes, arguments.dref, arguments.first_seed)
    except ValueError as error:
        parser.error(str(error))
    arguments.out = (arguments.out or build_folder() / "scale_collapse").resolve()
    return arguments


def collect(arguments: argparse.Namespace) -> List[report.Group]:
    """The curves and timings of every diameter and mode."""
    groups = []
    for mode in arguments.modes:
        for diameter, count in zip(arguments.diameters, arguments.seeds):
            scaled = is_scaled(diameter, mode, arguments.dref)
            group = report.Group(diameter, mode, [], [],
                                 Case(diameter, scaled, arguments.law, 1, arguments.dref)
                                 .inertial_number(arguments.preload))
            for seed in range(arguments.first_seed, arguments.first_seed + count):
                case = Case(diameter, scaled, arguments.law, seed, arguments.dref)
                folder = folder_of(arguments.out, case)
                group.curves.append(load_curve(folder / CURVE, arguments.preload))
                group.timings.append(report.Timing.from_marker(read_marker(folder)))
            groups.append(group)
    return groups


def write_report(arguments: argparse.Namespace) -> str:
    groups = collect(arguments)
    rows = report.make_rows(groups)
    report.write_csv(rows, arguments.out / "table.csv")
    text = report.text_table(rows, arguments.preload)
    (arguments.out / "table.txt").write_text(text, encoding="utf-8")
    report.plot(groups, arguments.out / "collapse.png", arguments.law, arguments.preload, rows)
    return text


def run(arguments: argparse.Namespace) -> None:
    lmp = find_lmp(arguments.lmp, [build_folder() / "lmp"])
    launcher = Launcher(lmp, HERE / "in.oedometer", arguments.mpirun, arguments.ranks)
    arguments.out.mkdir(parents=True, exist_ok=True)
    print(f"{len(arguments.cases)} runs with {lmp}, {arguments.jobs} at once, "
          f"into {arguments.out}", flush=True)
    Runner(launcher, arguments.out, arguments.jobs,
           Progress(arguments.cases, arguments.jobs)).run(arguments.cases, arguments.redo)
    print()
    print(write_report(arguments))
    print(f"Figure: {arguments.out / 'collapse.png'}\n"
          f"Table:  {arguments.out / 'table.csv'} and table.txt")


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = parse_arguments(words)
    return exit_status("run_study.py", lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())

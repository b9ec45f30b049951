#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Compresses, unloads and crushes packings of several particle diameters and writes a report: do
stress-strain curve, porosity, coordination number, modulus and strength collapse? See
strength.md."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from run_study import build_folder, cores  # noqa: E402  (says what Python lacks)

from collapse import plan as plans  # noqa: E402
from collapse.cases import folder_of  # noqa: E402
from collapse.command import exit_status  # noqa: E402
from collapse.progress import Progress  # noqa: E402
from collapse.runs import (Launcher, Runner, find_lmp, is_complete,  # noqa: E402
                           measured_speed)


def parse_arguments(words: Optional[Sequence[str]] = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    size = parser.add_mutually_exclusive_group(required=True)
    size.add_argument("--quick", action="store_true",
                      help="every kind of run on tiny specimens, a minute or two: tries the "
                           "machinery, the figures mean nothing")
    size.add_argument("--full", action="store_true",
                      help="the study, hours; --plan says how many")
    parser.add_argument("--plan", action="store_true", help="only say what would be run")
    parser.add_argument("--report", action="store_true",
                        help="only write the report on runs that are finished")
    parser.add_argument("--seeds", type=int, default=None, metavar="N",
                        help="packings of each diameter (default: 5, or 2 with --quick)")
    parser.add_argument("--fine-seeds", type=int, default=None, metavar="N",
                        help="packings of diameters below 1.5 times the smallest, which take most "
                             "of the time (default: 3, or --seeds if that is less)")
    parser.add_argument("--lmp", type=Path, default=None,
                        help="LAMMPS with this package (default: lmp in the build folder)")
    parser.add_argument("--mpirun", default="mpirun", help="what starts it")
    parser.add_argument("--jobs", type=int, default=cores(), help="runs at once, a core each")
    parser.add_argument("--out", type=Path, default=None,
                        help="folder of runs and report (default: strength or strength_quick in "
                             "the build folder)")
    parser.add_argument("--redo", action="store_true",
                        help="run again what an earlier call has finished")
    arguments = parser.parse_args(words)
    for name in ("seeds", "fine_seeds", "jobs"):
        value = getattr(arguments, name)
        if value is not None and value < 1:
            parser.error(f"--{name.replace('_', '-')} is {value}, allowed is 1 or more")
    if arguments.quick:
        if arguments.fine_seeds is not None:
            parser.error("--fine-seeds goes with --full alone")
        arguments.study = plans.quick(arguments.seeds or 2)
    else:
        arguments.study = plans.full(arguments.seeds or 5, arguments.fine_seeds)
    arguments.out = (arguments.out or build_folder()
                     / ("strength_quick" if arguments.quick else "strength")).resolve()
    return arguments


def run(arguments: argparse.Namespace) -> None:
    study = arguments.study
    lmp = find_lmp(arguments.lmp, [build_folder() / "lmp"])
    speed = measured_speed(arguments.out)
    print(plans.describe(study, arguments.jobs, speed or plans.PARTICLE_STEPS)
          + (", a speed that finished runs had" if speed else ""), flush=True)
    if arguments.plan:
        return
    arguments.out.mkdir(parents=True, exist_ok=True)
    launcher = Launcher(lmp, HERE / "in.confined", arguments.mpirun)
    if not arguments.report:
        runs = study.sorted_runs()
        Runner(launcher, arguments.out, arguments.jobs,
               Progress(runs, arguments.jobs)).run(runs, arguments.redo)
    from collapse import strength_report
    print()
    print(strength_report.write(study, arguments.out, lmp, lambda run: is_complete(
        folder_of(arguments.out, run), launcher.fingerprint(run))))


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = parse_arguments(words)
    return exit_status("run_strength.py", lambda: run(arguments), ValueError)


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Measures what this project costs and prints, draws and writes down the result: see README.md."""
from __future__ import annotations

import argparse
import json
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "examples" / "scale_collapse")]

try:
    import numpy  # noqa: F401
    import matplotlib  # noqa: F401
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; benchmarks/run.sh finds a Python that has it")

from collapse.runs import RunFailed, find_lmp  # noqa: E402

from bench import cases, cost, instructions, machine  # noqa: E402
from bench.lammps import Program  # noqa: E402
from bench.lammps_log import BadLog  # noqa: E402
from bench.output import write_csv  # noqa: E402


@dataclass(frozen=True)
class Session:
    """What every part is given."""

    program: Program
    build: Path
    lammps_source: Path
    work: Path       #: start files and running simulations
    results: Path    #: what is left in the end
    quick: bool
    rounds: int

    def write(self, name: str, rows: Sequence[Dict], text: str) -> None:
        """The raw rows, and the table, which is also printed."""
        write_csv(self.results / f"{name}.csv", rows)
        (self.results / f"{name}.txt").write_text(text, encoding="utf-8")
        print("\n" + text, flush=True)


def build_folder() -> Path:
    return Path(os.environ.get("BUILD_DIR") or HERE.parent / "build")


def run_cost(s: Session) -> None:
    """gran/eepa beside gran/hooke/history and granular in turn: pair time and whole loop"""
    if s.quick:
        sizes = [cases.chute(s.lammps_source).lasting(50, 200),
                 cases.compression(s.program, s.work, 2000).lasting(100, 1000)]
    else:
        sizes = [cases.chute(s.lammps_source), cases.compression(s.program, s.work, 20000),
                 cases.compression(s.program, s.work, 20000, (5, 2, 1))]
    rows: List[Dict] = []
    for case in sizes:
        rows += cost.measure(s.program, case, cost.STYLES, s.rounds, s.work)
    s.write("cost", rows, cost.table(rows))
    cost.plot(rows, s.results / "cost.png")


def run_instructions(s: Session) -> None:
    """instructions a contact, by callgrind"""
    if not instructions.available():
        print("valgrind is not there: no instructions are counted")
        return
    packing = 1000 if s.quick else 4000
    sizes = [cases.compression(s.program, s.work, packing).lasting(100, 0)]
    if not s.quick:
        sizes.insert(0, cases.chute(s.lammps_source).lasting(20, 0))
    rows: List[Dict] = []
    for case in sizes:
        rows += instructions.measure(s.program, case, instructions.STYLES, 10, 30, s.work)
    s.write("instructions", rows, instructions.table(rows))


PARTS: Dict[str, Callable[[Session], None]] = {
    "cost": run_cost,
    "instructions": run_instructions,
}


def parse_arguments(words: Optional[Sequence[str]] = None) -> argparse.Namespace:
    parts = "\n".join(f"  {name:13} {part.__doc__}" for name, part in PARTS.items())
    parser = argparse.ArgumentParser(description=f"{__doc__}\n\nparts:\n{parts}",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=list(PARTS), default=list(PARTS),
                        metavar="PART", help="these parts alone")
    parser.add_argument("--quick", action="store_true",
                        help="tiny sizes, to see that it works: the figures say little")
    parser.add_argument("--rounds", type=int, default=None, metavar="N",
                        help="how often each style is run (default: 5, quick 2)")
    parser.add_argument("--lmp", type=Path, default=None,
                        help="LAMMPS with this package (default: lmp in the build folder)")
    parser.add_argument("--mpirun", default="mpirun", help="what starts several ranks")
    parser.add_argument("--no-bind", action="store_true",
                        help="let ranks and threads wander: for a machine that others use")
    parser.add_argument("--out", type=Path, default=None,
                        help="folder of the results (default: benchmarks/results in the build "
                             "folder)")
    arguments = parser.parse_args(words)
    if arguments.rounds is None:
        arguments.rounds = 2 if arguments.quick else 5
    if arguments.rounds < 1:
        parser.error(f"--rounds is {arguments.rounds}, allowed is 1 or more")
    return arguments


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = parse_arguments(words)
    started = time.monotonic()
    try:
        build = build_folder().resolve()
        results = (arguments.out or build / "benchmarks" / "results").resolve()
        work = build / "benchmarks" / "work"
        for folder in (results, work):
            folder.mkdir(parents=True, exist_ok=True)
        session = Session(
            Program(find_lmp(arguments.lmp, [build / "lmp"]), arguments.mpirun,
                    not arguments.no_bind),
            build, Path(machine.configured(build)["lammps_source_path"]), work, results,
            arguments.quick, arguments.rounds)
        description = machine.describe(build, HERE.parent, sys.argv[1:] if words is None else words)
        (results / "machine.json").write_text(json.dumps(description, indent=2) + "\n",
                                              encoding="utf-8")
        print("\n".join(f"{name}: {value}" for name, value in description.items()), flush=True)
        for name in PARTS:
            if name in arguments.only:
                print(f"\n== {name}: {PARTS[name].__doc__}", flush=True)
                PARTS[name](session)
        print(f"\nTables, figures and every single run: {results} "
              f"({(time.monotonic() - started) / 60.0:.1f} minutes)")
    except KeyboardInterrupt:
        print("\nStopped.")
        return 130
    except (RunFailed, BadLog, OSError, ValueError) as error:
        print(f"\nrun_benchmarks.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

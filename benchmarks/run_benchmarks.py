#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Measures what this project costs and prints, draws and writes down the result: see README.md."""
from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, List, Mapping, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "examples" / "scale_collapse"),
                str(HERE.parent / "examples"), str(HERE.parent / "coarsen")]

try:
    import numpy  # noqa: F401
    import matplotlib  # noqa: F401
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; benchmarks/run.sh finds a Python that has")

from coarsen.measure import BadRun  # noqa: E402
from coarsen.workflow import NotInstalled, find_lmp  # noqa: E402

from bench import (cases, cost, diameters, instructions, kernel, liggghts, machine,  # noqa: E402
                   many_particles, many_types, memory, report, scaling, walls)
from bench.lammps import Program, RunFailed, has_pair_style, usable_cores  # noqa: E402
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
    description: Mapping[str, object]    #: of machine, compiler, LAMMPS
    quick: bool
    rounds: int
    liggghts: Optional[Path] = None    #: LIGGGHTS-INL, if there is one

    def write(self, name: str, rows: Sequence[Dict], text: str) -> None:
        """The rows of every run, and the table, which is also printed."""
        write_csv(self.results / f"{name}.csv", rows)
        report.write_part(self.results, name, text, self.description)
        print("\n" + text, flush=True)


def build_folder() -> Path:
    return Path(os.environ.get("BUILD_DIR") or HERE.parent / "build")


def run_kernel(s: Session) -> None:
    """the contact law alone: ns, operations and bytes a contact"""
    if not (s.build / "bench_kernel").is_file():
        print("bench_kernel was not built: Google Benchmark is not there")
        return
    rows, context = kernel.measure(s.program, s.build, *((2, 0.005) if s.quick else (7, 0.05)))
    operations = kernel.count_operations(s.build)
    write_csv(s.results / "operations.csv", operations)
    s.write("kernel", rows, kernel.table(rows, operations, context))
    kernel.plot(rows, s.results / "kernel.png")


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
        print("valgrind is not there (on Debian: apt-get install valgrind): nothing is counted")
        return
    packing = 1000 if s.quick else 4000
    sizes = [cases.compression(s.program, s.work, packing).lasting(50, 0)]
    if not s.quick:
        sizes.insert(0, cases.chute(s.lammps_source).lasting(20, 0))
    rows: List[Dict] = []
    for case in sizes:
        rows += instructions.measure(s.program, case, instructions.STYLES, 10, 30, s.work)
    s.write("instructions", rows, instructions.table(rows))


def run_scaling(s: Session) -> None:
    """ranks and threads, the same particles on more cores and as many on each"""
    counts = [n for n in (1, 2, 4, 8, 16, 32) if n <= len(usable_cores())]
    with_omp = has_pair_style(s.program, s.work / "probe", "gran/eepa/omp")
    if not with_omp:
        print("gran/eepa/omp is not in this build: threads are left out")
    cell = 2000 if s.quick else 20000
    weak = {n: cases.compression(s.program, s.work, cell, (5, n, 1)) for n in counts}
    strong = cases.compression(s.program, s.work, cell, (5, 2, 1))
    if s.quick:
        weak = {n: case.lasting(20, 100) for n, case in weak.items()}
        strong = strong.lasting(20, 100)
    rows = scaling.measure(s.program, scaling.jobs(strong, weak, with_omp), s.rounds, s.work)
    s.write("scaling", rows, scaling.table(rows, with_omp))
    scaling.plot(rows, s.results / "scaling.png")


def run_diameters(s: Session) -> None:
    """time of one test against the particles' diameter"""
    sizes = [2.0e-3, 2.5e-3, 3.0e-3] if s.quick else [1.0e-3, 1.25e-3, 1.5e-3, 2.0e-3, 2.5e-3,
                                                      3.0e-3]
    # more for coarse diameters, whose packings scatter more and cost less
    seeds = [1 if s.quick else min(8, int(2.0 * (d / min(sizes))**2 + 1e-9)) for d in sizes]
    rows, runs = diameters.measure(s.program, sizes, seeds, s.work / "diameters")
    s.write("diameters", runs, diameters.table(rows))
    diameters.plot(rows, s.results / "diameters.png")


def run_memory(s: Session) -> None:
    """memory a particle, and a million particles"""
    cell = 1000 if s.quick else 20000
    sizes = [cases.compression(s.program, s.work, cell, copies)
             for copies in ((1, 1, 1), (5, 2, 1), (5, 5, 2))]
    rows = memory.measure(s.program, [size.lasting(5, 20) for size in sizes], memory.STYLES, s.work)
    s.write("memory", rows, memory.table(rows))


def dense_sizes(s: Session) -> List[cases.Case]:
    """4,096 and 49,152 particles, which fit the cache and do not."""
    cell = 500 if s.quick else 4096
    sizes = [cases.dense(s.program, s.work, cell, copies) for copies in ((1, 1, 1), (2, 2, 3))]
    if s.quick:
        sizes = [size.lasting(50, 200) for size in sizes]
    return sizes


def run_many_particles(s: Session) -> None:
    """what is lost when particles no longer fit the cache: 4,096 and 49,152 of them"""
    rows = many_particles.measure(s.program, dense_sizes(s), s.rounds, s.work)
    s.write("many_particles", rows, many_particles.table(rows))


def run_types(s: Session) -> None:
    """several types of particles beside one"""
    case = cases.compression(s.program, s.work, 2000 if s.quick else 20000)
    if s.quick:
        case = case.lasting(100, 1000)
    rows = many_types.measure(s.program, case, s.rounds, s.work)
    s.write("types", rows, many_types.table(rows))


def run_walls(s: Session) -> None:
    """100,000 spheres in a cube of 100,000 triangles, beside planes and no walls"""
    size = {"cells": 12, "cuts": 23, "steps": 50} if s.quick else {"cells": 47, "cuts": 91, "steps": 100}
    rows = walls.measure(s.program, rounds=s.rounds, work=s.work, **size)
    s.write("walls", rows, walls.table(rows))


def run_liggghts(s: Session) -> None:
    """beside LIGGGHTS-INL (--liggghts), at 4,096 and 49,152 particles"""
    if s.liggghts is None:
        print("no --liggghts PROGRAM: left out")
        return
    rows = liggghts.measure(s.program, s.liggghts, dense_sizes(s), s.rounds, s.work)
    s.write("liggghts", rows, liggghts.table(rows))


PARTS: Dict[str, Callable[[Session], None]] = {
    "kernel": run_kernel,
    "cost": run_cost,
    "instructions": run_instructions,
    "scaling": run_scaling,
    "diameters": run_diameters,
    "memory": run_memory,
    "many_particles": run_many_particles,
    "types": run_types,
    "walls": run_walls,
    "liggghts": run_liggghts,
}


def parse_arguments(words: Optional[Sequence[str]] = None) -> argparse.Namespace:
    parts = "\n".join(f"  {name:14} {part.__doc__}" for name, part in PARTS.items())
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
    parser.add_argument("--liggghts", type=Path, default=None, metavar="PROGRAM",
                        help="LIGGGHTS-INL, to be measured beside gran/eepa")
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
    if arguments.liggghts is not None:
        found = shutil.which(arguments.liggghts)
        if found is None:
            parser.error(f"--liggghts is {arguments.liggghts}, which is no program")
        arguments.liggghts = Path(found).resolve()
    return arguments


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = parse_arguments(words)
    started = time.monotonic()
    # ended from outside, it ends what it has started
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    try:
        build = build_folder().resolve()
        results = (arguments.out or build / "benchmarks" / "results").resolve()
        work = build / "benchmarks" / "work"
        for folder in (results, work):
            folder.mkdir(parents=True, exist_ok=True)
        session = Session(
            Program(find_lmp(arguments.lmp or build / "lmp"), arguments.mpirun,
                    not arguments.no_bind),
            build, Path(machine.configured(build)["lammps_source_path"]), work, results,
            machine.describe(build, HERE.parent, arguments.mpirun,
                             sys.argv[1:] if words is None else words),
            arguments.quick, arguments.rounds, arguments.liggghts)
        print("\n".join(f"{name}: {value}" for name, value in session.description.items()),
              flush=True)
        for name in PARTS:
            if name in arguments.only:
                print(f"\n== {name}: {PARTS[name].__doc__}", flush=True)
                PARTS[name](session)
        report.write_report(results, {name: part.__doc__ or "" for name, part in PARTS.items()})
        print(f"\nTables, figures and every single run: {results}, all on one page in "
              f"report.md ({(time.monotonic() - started) / 60.0:.1f} minutes)")
    except KeyboardInterrupt:
        print("\nStopped.")
        return 130
    except (RunFailed, NotInstalled, BadLog, BadRun, OSError, ValueError,
            subprocess.CalledProcessError) as error:
        print(f"\nrun_benchmarks.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

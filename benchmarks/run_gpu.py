#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Measures gran/eepa/kk beside LAMMPS's gran/hooke/history/kk: ms a step, time of pair kernels, contacts, memory and energy of a card.
Needs Python alone, and Matplotlib for the figure, which --draw makes elsewhere."""
from __future__ import annotations

import argparse
import csv
import datetime
import os
import sys
from pathlib import Path
from typing import Dict, List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "examples" / "scale_collapse"), str(HERE.parent / "coarsen")]

from bench import card, gpu, gpu_tables, machine  # noqa: E402
from bench.lammps import LOG, Program, RunFailed  # noqa: E402
from bench.output import write_csv  # noqa: E402


def main() -> None:
    build = Path(os.environ.get("BUILD_DIR") or HERE.parent / "build")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lmp", type=Path, default=build / "lmp", help="a LAMMPS with KOKKOS and gran/eepa/kk")
    parser.add_argument("--kokkos", default="g 1", help="what follows -k on: 'g 1' (default), or 't 4' without a GPU")
    parser.add_argument("--package", default="newton off neigh half", help="what follows -pk kokkos")
    parser.add_argument("--cases", nargs="+", default=list(gpu.WORKLOADS), choices=gpu.WORKLOADS)
    parser.add_argument("--particles", type=float, nargs="+", default=[1e5, 1e6, 4e6, 1e7], metavar="N", help="about so many")
    parser.add_argument("--every", type=int, nargs="+", default=[0, 20], metavar="STEPS",
                        help="of the lattice, steps between two neighbour lists; 0: none is made")
    parser.add_argument("--laws", nargs="+", default=list(gpu.LAWS), choices=gpu.LAWS)
    parser.add_argument("--steps", type=int, default=0, help="of each run (so many that it takes seconds on a card)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--chute", type=Path, default=None, metavar="FILE",
                        help="LAMMPS's bench/data.chute (that of the source that was built)")
    parser.add_argument("--out", type=Path, default=build / "benchmarks" / "gpu", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="tiny sizes: a test that it works, no figures")
    parser.add_argument("--draw", action="store_true", help="only gpu.md and gpu.png, of the gpu.csv in --out")
    given = parser.parse_args()
    table = given.out / "gpu.csv"
    try:
        if not given.draw and not measure(given, table):
            sys.exit("run_gpu.py: no run was finished")
        rows = read(table)
    except (OSError, ValueError, RunFailed) as failure:
        sys.exit(f"run_gpu.py: {failure}")
    report(rows, given.out)


def measure(given: argparse.Namespace, table: Path) -> List[Dict]:
    counts = [int(count) for count in given.particles]
    if min(counts) < 1000 or given.rounds < 1 or given.steps < 0:
        raise ValueError("allowed are --particles of 1000 and more, --rounds of 1 and more, --steps of 0 and more")
    if not given.lmp.is_file():
        raise ValueError(f"there is no {given.lmp}: build with -D EEPA_KOKKOS=on, or name a LAMMPS with --lmp")
    # without any, the pair styles are the processor's
    kokkos = ["-k", "on", *given.kokkos.split(), "-sf", "kk", "-pk", "kokkos", *given.package.split()] if given.kokkos else []
    program = Program(given.lmp.resolve(), bind=False)
    work = given.out.resolve() / "work"
    work.mkdir(parents=True, exist_ok=True)
    loads = workloads(program, given, counts, work)
    where = (card.names() or "a GPU that nvidia-smi does not name") if given.kokkos.startswith("g") else "no GPU"
    about = {"on": where, "kokkos": " ".join(kokkos), "date": f"{datetime.date.today():%Y-%m-%d}", "rounds": given.rounds}

    def note(rows: List[Dict]) -> None:
        with (work / LOG).open(encoding="utf-8", errors="replace") as log:
            rows[-1].update(about, lammps=log.readline().strip())
        write_csv(table, rows)

    return gpu.measure(program, kokkos, loads, given.laws, given.rounds, work, note)


def workloads(program: Program, given: argparse.Namespace, counts: Sequence[int], work: Path) -> List[gpu.Workload]:
    """Files that are missing are told before anything is made."""
    steps = 60 if given.quick else given.steps
    chute: Optional[Path] = None
    if "chute" in given.cases:
        chute = given.chute or Path(machine.configured(program.lmp.parent)["lammps_source_path"]) / "bench" / "data.chute"
        if not chute.is_file():
            raise ValueError(f"there is no {chute}: name LAMMPS's bench/data.chute with --chute, or leave chute out of --cases")
    loads: List[gpu.Workload] = []
    if "lattice" in given.cases:
        loads += gpu.lattices([216] if given.quick else counts, given.every, steps)
    if "dense" in given.cases:
        loads += gpu.dense(program, work, [600] if given.quick else counts, 600 if given.quick else 20000, steps)
    if chute:
        loads += gpu.chutes(chute, [32000] if given.quick else counts, steps)
    return loads


def read(table: Path) -> List[Dict]:
    with table.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def report(rows: Sequence[Dict], out: Path) -> None:
    first = rows[0]
    text = (f"{first['on']}; {first['lammps']}; {first['kokkos']}; {first['date']}. In brackets over gran/hooke/history; "
            f"medians of {first['rounds']} rounds.\n\n{gpu_tables.tables(rows)}")
    (out / "gpu.md").write_text(text, encoding="utf-8")
    print("\n" + text)
    try:
        from bench import plots
    except ImportError as missing:
        print(f"No figure: {missing.name} is missing. run_gpu.py --draw makes it where it is.")
        return
    plots.particle_steps(gpu_tables.speeds(rows), out / "gpu.png")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Measures gran/eepa/kk beside LAMMPS's gran/hooke/history/kk: ms a step, time of pair kernels, memory and energy of a card."""
from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "examples" / "scale_collapse"), str(HERE.parent / "coarsen")]

from bench import card, gpu, machine, plots  # noqa: E402
from bench.lammps import Program, RunFailed  # noqa: E402
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
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--lammps-source", type=Path, default=None, metavar="FOLDER",
                        help="LAMMPS's source, for bench/data.chute (that of the build)")
    parser.add_argument("--out", type=Path, default=build / "benchmarks" / "gpu", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="tiny sizes: a test that it works, no figures")
    given = parser.parse_args()
    if not given.lmp.is_file():
        sys.exit(f"there is no {given.lmp}: build with -D EEPA_KOKKOS=on, or name a LAMMPS with --lmp")

    counts = [int(count) for count in given.particles]
    if min(counts) < 1000:
        sys.exit(f"--particles {min(counts)}: allowed are 1000 and more")
    rounds = 1 if given.quick else given.rounds
    # without any, the pair styles are the processor's
    kokkos = ["-k", "on", *given.kokkos.split(), "-sf", "kk", "-pk", "kokkos", *given.package.split()] if given.kokkos else []
    program = Program(given.lmp.resolve(), bind=False)
    work = given.out.resolve() / "work"
    work.mkdir(parents=True, exist_ok=True)
    try:
        loads = workloads(program, given.cases, counts, given.every, work, given.lammps_source, given.quick)
        rows = gpu.measure(program, kokkos, loads, given.laws, rounds, work)
    except (FileNotFoundError, RunFailed) as failure:
        sys.exit(str(failure))
    write_csv(given.out / "gpu.csv", rows)
    plots.particle_steps(gpu.speeds(rows), given.out / "gpu.png")
    where = card.names() if given.kokkos.startswith("g") else ""
    text = (f"{where or 'No GPU'}; {' '.join(kokkos)}. In brackets over gran/hooke/history; "
            f"medians of {rounds} rounds.\n\n{gpu.table(rows)}")
    (given.out / "gpu.md").write_text(text, encoding="utf-8")
    print("\n" + text)


def workloads(program: Program, names: Sequence[str], counts: Sequence[int], every: Sequence[int], work: Path,
              lammps_source: Optional[Path], quick: bool) -> List[gpu.Workload]:
    """:param quick: one tiny size of each in place of `counts`"""
    steps = 60 if quick else 0
    loads: List[gpu.Workload] = []
    if "lattice" in names:
        loads += gpu.lattices([216] if quick else counts, every, steps)
    if "dense" in names:
        loads += gpu.dense(program, work, [600] if quick else counts, 600 if quick else 20000, steps)
    if "chute" in names:
        loads += gpu.chutes(lammps_source or Path(machine.configured(program.lmp.parent)["lammps_source_path"]),
                           [32000] if quick else counts, steps)
    return loads


if __name__ == "__main__":
    main()

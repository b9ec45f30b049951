#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Measures gran/eepa/kk beside LAMMPS's gran/hooke/history/kk: ms a step, with and without new neighbour lists."""
from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "coarsen")]

from bench import gpu  # noqa: E402
from bench.lammps import Program, RunFailed  # noqa: E402
from bench.output import write_csv  # noqa: E402


def main() -> None:
    build = Path(os.environ.get("BUILD_DIR") or HERE.parent / "build")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lmp", type=Path, default=build / "lmp", help="a LAMMPS with KOKKOS and gran/eepa/kk")
    parser.add_argument("--kokkos", default="g 1", help="what follows -k on: 'g 1' (default), or 't 4' without a GPU")
    parser.add_argument("--package", default="newton off neigh half", help="what follows -pk kokkos")
    parser.add_argument("--sides", type=int, nargs="+", default=[46, 100, 159], metavar="N",
                        help="particles along each edge: N^3 of them")
    parser.add_argument("--every", type=int, nargs="+", default=[0, 20], metavar="STEPS",
                        help="steps between two neighbour lists; 0: none is made")
    parser.add_argument("--laws", nargs="+", default=list(gpu.LAWS), choices=gpu.LAWS)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--out", type=Path, default=build / "benchmarks" / "gpu", help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="tiny sizes: a test that it works, no figures")
    given = parser.parse_args()
    if not given.lmp.is_file():
        sys.exit(f"there is no {given.lmp}: build with -D EEPA_KOKKOS=on, or name a LAMMPS with --lmp")

    sizes = gpu.lattices([6], given.every, 60) if given.quick else gpu.lattices(given.sides, given.every)
    rounds = 1 if given.quick else given.rounds
    kokkos = ["-k", "on", *given.kokkos.split(), "-sf", "kk", "-pk", "kokkos", *given.package.split()]
    program = Program(given.lmp.resolve(), bind=False)
    try:
        rows = gpu.measure(program, kokkos, sizes, given.laws, rounds, given.out.resolve() / "work")
    except RunFailed as failure:
        sys.exit(str(failure))
    write_csv(given.out / "gpu.csv", rows)
    where = gpu.cards() if given.kokkos.startswith("g") else ""
    text = (f"{where or 'No GPU'}; {' '.join(kokkos)}. Milliseconds a step, and over gran/hooke/history; "
            f"medians of {rounds} rounds.\n\n{gpu.table(rows)}")
    (given.out / "gpu.md").write_text(text, encoding="utf-8")
    print("\n" + text)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-2.0-only
"""Options that several commands have, and what their values may be."""
from __future__ import annotations

import argparse
import math
import re
from pathlib import Path
from typing import Any, Dict, List, Sequence

from .workflow import cores


class Parser(argparse.ArgumentParser):
    """Takes -1e-7 for a number, which argparse of its own takes for an option."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._negative_number_matcher = re.compile(r"^-(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$")


def add_running(parser: argparse.ArgumentParser, name: str) -> None:
    """What commands that start LAMMPS take."""
    parser.add_argument("--lmp", default=None, help="LAMMPS with this package (the build folder's, or lmp)")
    parser.add_argument("--cores", type=int, default=cores(), help="in use at once (all)")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of a run (1)")
    parser.add_argument("--switches", default="", metavar="'...'",
                        help="further command-line switches of LAMMPS in one argument, such as '-k on g 1 -sf kk'")
    parser.add_argument("--out", type=Path, default=Path(f"coarsen_{name}"),
                        help=f"folder of runs and results (coarsen_{name}); the same call goes on from it")
    parser.add_argument("--snakemake", nargs=argparse.REMAINDER, default=[],
                        help="last of all: further arguments of Snakemake, such as --profile slurm")


def diameters(values: Sequence[float], place: str = "--diameters") -> List[float]:
    """:raise ValueError: for fewer than two, or one that is no number above 0, or occurs twice"""
    if len(set(values)) < 2 or len(set(values)) < len(values):
        raise ValueError(f"{place} are {' '.join(f'{v:g}' for v in values)}, allowed are two or more, each once")
    for value in values:
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{place}: {value:g} is not allowed, allowed are numbers above 0")
    return sorted(values)


def percentages(words: Sequence[str], place: str = "--want") -> Dict[str, float]:
    """From NAME=PERCENT to fractions by name.

    :raise ValueError: for what is not so, or a percentage that is not between 0 and 100
    """
    found: Dict[str, float] = {}
    for word in words:
        name, sign, text = word.partition("=")
        try:
            value = 0.01 * float(text.rstrip("%"))
        except ValueError:
            value = math.nan
        if not sign or not name or not 0.0 < value < 1.0:
            raise ValueError(f"{place} {word}: allowed is NAME=PERCENT with more than 0 and less than 100")
        if name in found:
            raise ValueError(f"{place} {word}: {name} is there twice")
        found[name] = value
    return found

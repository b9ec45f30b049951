# SPDX-License-Identifier: GPL-2.0-only
"""What is simulated: LAMMPS's chute, and a dense compression of any number of particles."""
from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Dict, Mapping, Tuple

from .lammps import Program, run_lammps
from .styles import Material, Style, gamma_of_restitution, make_styles

HERE = Path(__file__).resolve().parent.parent

# Of LAMMPS's in.chute: spheres of diameter and density 1.
CHUTE = Material(k1=2.0e5, mu=0.5, gamma_n=50.0, tangential_damping=False, mass=math.pi / 6.0,
                 k2=4.0e5, k_adh=2.0e4, f0=-0.01, damped_restitution=0.1)

# Of examples/scale_collapse: spheres of 1 mm, e = 0.3.
_MASS = 2000.0 * math.pi / 6.0 * 1.0e-9
POWDER = Material(k1=5.0e3, mu=0.5, gamma_n=gamma_of_restitution(0.3, 5.0e3, _MASS),
                  tangential_damping=True, mass=_MASS, k2=1.0e4, k_adh=5.0e3, f0=-1.0e-4,
                  diameter=1.0e-3)


@dataclass(frozen=True)
class Case:
    """An in-file with its start file and the length of the run."""

    name: str
    infile: Path
    material: Material
    data: Path
    copies: Tuple[int, int, int] = (1, 1, 1)
    warm: int = 500
    steps: int = 1000
    rebuild: int = 0    #: steps between neighbour lists; 0: a list when one is needed
    types: int = 1

    @property
    def styles(self) -> Dict[str, Style]:
        return make_styles(self.material)

    def variables(self, style: Style, folder: Path) -> Dict[str, str]:
        """The -var arguments; writes the style's file."""
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / "style.lmp"
        file.write_text(style.lines_of(self.types), encoding="utf-8")
        words = {"data": self.data, "style": file, "measure": HERE / "measure.lmp",
                 "warm": self.warm, "steps": self.steps,
                 "census": "yes" if style.is_eepa else "no"}
        words.update(zip(("nx", "ny", "nz"), self.copies))
        if self.infile.name == "in.compression":
            words.update(rebuild=self.rebuild, types=self.types)
        return {name: str(word) for name, word in words.items()}

    def lasting(self, warm: int, steps: int) -> "Case":
        return replace(self, warm=warm, steps=steps)


def chute(lammps_source: Path) -> Case:
    """:raise FileNotFoundError: where LAMMPS's source has no bench folder"""
    data = lammps_source / "bench" / "data.chute"
    if not data.is_file():
        raise FileNotFoundError(f"no {data}: the chute needs the folder bench of LAMMPS's source")
    return chute_of(data)


def chute_of(data: Path, copies: Tuple[int, int] = (1, 1)) -> Case:
    """The 32,000 particles of LAMMPS's data.chute, copied along and across the flow."""
    return Case(f"chute {32000 * math.prod(copies)}", HERE / "in.chute", CHUTE, data, (*copies, 1), steps=2000)


def compression(program: Program, work: Path, cell: int,
                copies: Tuple[int, int, int] = (1, 1, 1)) -> Case:
    """A packing of `cell` particles, copied along the sides of its box.

    The start file is made once: packing 200,000 particles takes longer than everything else.
    """
    count = cell * math.prod(copies)
    steps = max(200, min(4000, round(8.0e7 / count)))
    return Case(f"compression {count}", HERE / "in.compression", POWDER,
                packing(program, work, cell), copies, warm=min(500, steps // 4), steps=steps)


def dense(program: Program, work: Path, cell: int,
          copies: Tuple[int, int, int] = (1, 1, 1)) -> Case:
    """A packing with friction, which has fewer contacts, and a new neighbour list every 50 steps, as in a flow."""
    count = cell * math.prod(copies)
    steps = max(200, min(4000, round(8.0e7 / count)))
    data = packing(program, work, cell, {"mu": "0.5", "pressure": "5e3"})
    return Case(f"dense {count}", HERE / "in.compression", POWDER, data, copies,
                warm=min(500, steps // 4), steps=steps, rebuild=50)


def packing(program: Program, work: Path, particles: int,
            variables: Mapping[str, str] = MappingProxyType({})) -> Path:
    """The start file of in.compression, made if it is not there.

    :param variables: of in.packing
    """
    return start_file(program, work, "packing", particles, {"n": str(particles), **variables})


def start_file(program: Program, work: Path, what: str, count: int, variables: Mapping[str, str]) -> Path:
    """What an in-file makes, kept for later runs.

    :param what: such as packing, of in.packing
    :param count: which tells start files of different sizes apart
    :param variables: of the in-file, without `out`
    """
    infile = HERE / f"in.{what}"
    key = hashlib.sha256(infile.read_bytes() + repr(sorted(variables.items())).encode()
                         ).hexdigest()[:12]
    data = work / f"{what}_{count}_{key}.data"
    if not data.is_file():
        print(f"  {what} {count} particles, once, into {data}", flush=True)
        folder = work / f"{what}_{count}"
        folder.mkdir(parents=True, exist_ok=True)
        partial = folder / f"{what}.data"
        run_lammps(program, infile, folder, {"out": str(partial), **variables})
        partial.rename(data)
    return data

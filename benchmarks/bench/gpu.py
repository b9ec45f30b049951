# SPDX-License-Identifier: GPL-2.0-only
"""The styles for KOKKOS in turn: a lattice, a dense packing, a chute."""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import card, cases
from .lammps import SCREEN, Program, run_lammps
from .lammps_log import TimedRun, read_run
from .statistics import median, paired_ratios
from .styles import HOOKE

INFILE = Path(__file__).resolve().parents[1] / "in.lattice"
REFERENCE = "hooke"    #: gran/hooke/history
LAWS = ("constant", "plateau", "exponent", "sds", "luding")
WORKLOADS = ("lattice", "dense", "chute")
_STYLES = {REFERENCE: HOOKE, "constant": "gran/eepa full",
           **{law: f"gran/eepa {law}" for law in LAWS if law != "constant"}}
#: LAMMPS's sections of time are those of a GPU when each kernel is waited for.
_WAIT = {"CUDA_LAUNCH_BLOCKING": "1"}


@dataclass(frozen=True)
class Lattice:
    side: int     #: particles along each edge
    every: int    #: steps between two neighbour lists; 0: as particles move, which is never here
    steps: int

    @property
    def name(self) -> str:
        return "lattice, a list every " + str(self.every) if self.every else "lattice, no list"

    @property
    def infile(self) -> Path:
        return INFILE

    def variables(self, law: str, _: Path) -> Dict[str, str]:
        return {"law": law, "n": str(self.side), "every": str(self.every), "steps": str(self.steps)}


@dataclass(frozen=True)
class Flow:
    """A dense packing, or a chute."""

    name: str
    case: cases.Case

    @property
    def steps(self) -> int:
        return self.case.steps

    @property
    def infile(self) -> Path:
        return self.case.infile

    def variables(self, law: str, folder: Path) -> Dict[str, str]:
        return {**self.case.variables(self.case.styles[_STYLES[law]], folder), "census": "no"}


Workload = Union[Lattice, Flow]


def _steps(particles: int) -> int:
    """So many that the runs of all sizes take about as long."""
    return min(2000, max(200, int(2e9 / particles)))


def lattices(counts: Sequence[int], every: Sequence[int], steps: int = 0) -> List[Lattice]:
    """:param counts: particles, about
    :param steps: 0: so many that the runs of all sizes take about as long
    """
    sides = [max(4, round(count**(1.0 / 3.0))) for count in counts]
    return [Lattice(side, e, steps or _steps(side**3)) for side in sides for e in every]


def dense(program: Program, work: Path, counts: Sequence[int], cell: int = 20000, steps: int = 0) -> List[Flow]:
    """Copies of a packing with friction, which is made if it is not there; likewise."""
    made = []
    for count in counts:
        side = max(1, int((count / cell)**(1.0 / 3.0)))
        copies = (side, side, max(1, round(count / (cell * side * side))))
        n = steps or _steps(cell * math.prod(copies))
        made.append(Flow("dense", cases.dense(program, work, cell, copies).lasting(min(200, n), n)))
    return made


def chutes(lammps_source: Path, counts: Sequence[int], steps: int = 0) -> List[Flow]:
    """Copies of LAMMPS's chute.

    :raise FileNotFoundError: where LAMMPS's source has no bench folder
    """
    made = []
    for count in counts:
        side = max(1, int(math.sqrt(count / 32000)))
        copies = (side, max(1, round(count / (32000 * side))))
        n = steps or _steps(32000 * math.prod(copies))
        made.append(Flow("chute", cases.chute(lammps_source, copies).lasting(min(200, n), n)))
    return made


def read_log(log: str) -> TimedRun:
    """The timed run of a log: the one that measure.lmp marks, or without marks the last.

    :raise ValueError: if there is none
    """
    lines = log.splitlines()
    if not any(line.startswith("Stage ") for line in lines):
        lines = ["Stage timed", *lines, "Stage done"]
    run = read_run(lines)
    if not run.steps:
        raise ValueError("the log has no line 'Loop time of'")
    return run


def measure(program: Program, kokkos: Sequence[str], workloads: Sequence[Workload], laws: Sequence[str],
            rounds: int, work: Path) -> List[Dict]:
    """One row a run. In each round all styles run, one after another; in the first, each once more for the time of its
    pair kernels.

    :param kokkos: LAMMPS's command line for KOKKOS
    """
    rows: List[Dict] = []
    work.mkdir(parents=True, exist_ok=True)
    for load in workloads:
        for k in range(rounds):
            for law in (REFERENCE, *laws):
                variables = load.variables(law, work)
                with card.Watch() as watch:
                    run, screen = _one(program, load, work, variables, kokkos)
                energy, memory = card.energy_and_memory(watch.samples, screen, run.loop)
                row = {"case": load.name, "particles": run.atoms, "round": k, "law": law,
                       "ms_a_step": 1e3 * run.loop / run.steps,
                       "joule_a_particle_step": energy and energy / (run.atoms * float(run.steps)),
                       "card_bytes_a_particle": memory and memory / run.atoms}
                if k == 0:
                    waited, _ = _one(program, load, work, variables, kokkos, _WAIT)
                    row["pair_ms_a_step"] = 1e3 * waited.pair / waited.steps
                if "contacts_after" in run.figures:
                    row["contacts_a_particle"] = run.contacts / run.atoms
                rows.append(row)
                print(f"{load.name}, {run.atoms} particles, {law}: {row['ms_a_step']:.4g} ms a step", flush=True)
    return rows


def _one(program: Program, load: Workload, work: Path, variables: Mapping[str, str], kokkos: Sequence[str],
         settings: Mapping[str, str] = MappingProxyType({})) -> Tuple[TimedRun, str]:
    """Its timed run and what it wrote to the screen."""
    done = run_lammps(program, load.infile, work, variables, more=kokkos, settings=settings)
    return (read_log(done.log.read_text(encoding="utf-8", errors="replace")),
            (work / SCREEN).read_text(encoding="utf-8", errors="replace"))


def _of(rows: Sequence[Mapping], law: str, column: str) -> Optional[float]:
    values = [row[column] for row in rows if row["law"] == law and row.get(column)]
    return median(values).value if values else None


def table(rows: Sequence[Mapping]) -> str:
    """Tables in Markdown, a line a size: medians of milliseconds a step and of their ratios to the reference of the same
    round; of pair kernels; and what else was measured of each law."""
    laws = [law for law in dict.fromkeys(row["law"] for row in rows) if law != REFERENCE]
    head = ["| case | particles | gran/hooke/history | " + " | ".join(laws) + " |", "|---|---|---|" + "---|" * len(laws)]
    text = []
    for title, column in (("Milliseconds a step", "ms_a_step"), ("Of these in pair kernels, waiting for each kernel", "pair_ms_a_step"),
                          ("Contacts a particle", "contacts_a_particle"), ("10^9 particle steps a second", ""), ("Memory of the card, bytes a particle", "card_bytes_a_particle"),
                          ("Energy of the card, nJ a particle step", "joule_a_particle_step")):
        lines = []
        for case, particles in dict.fromkeys((row["case"], row["particles"]) for row in rows):
            these = [row for row in rows if (row["case"], row["particles"]) == (case, particles)]
            cells = [_cell(these, law, column, particles) for law in (REFERENCE, *laws)]
            if any(cells):
                lines.append(f"| {case} | {particles:,} | " + " | ".join(cells) + " |")
        if lines:
            text += [f"{title}:", "", *head, *lines, ""]
    return "\n".join(text)


def speeds(rows: Sequence[Mapping]) -> Dict[Tuple[str, str], List[Tuple[int, float]]]:
    """Of each case and law, numbers of particles and medians of particle steps a second."""
    found: Dict[Tuple[str, str], List[Tuple[int, float]]] = {}
    for case, law, particles in dict.fromkeys((row["case"], row["law"], row["particles"]) for row in rows):
        these = [row for row in rows if (row["case"], row["particles"]) == (case, particles)]
        found.setdefault((case, law), []).append((particles, 1e3 * particles / (_of(these, law, "ms_a_step") or math.nan)))
    return found


def _cell(rows: Sequence[Mapping], law: str, column: str, particles: int) -> str:
    value = _of(rows, law, column or "ms_a_step")
    if value is None:
        return ""
    if not column:
        return f"{1e-6 * particles / value:.3g}"
    if column.startswith("joule"):
        return f"{1e9 * value:.3g}"
    if column != "ms_a_step" or law == REFERENCE:
        return f"{value:.3g}"
    return f"{value:.3g} ({median(paired_ratios(rows, law, REFERENCE, 'law', column)).value:.2f})"

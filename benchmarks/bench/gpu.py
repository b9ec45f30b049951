# SPDX-License-Identifier: GPL-2.0-only
"""The styles for KOKKOS in turn: a lattice, a dense packing, a chute. Needs nothing but Python."""
from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Callable, Dict, List, Mapping, Sequence, Tuple, Union

from . import card, cases
from .lammps import SCREEN, Program, RunFailed, run_lammps
from .lammps_log import BadLog, TimedRun, read_run
from .styles import HOOKE

HERE = Path(__file__).resolve().parents[1]
INFILE, MEASURE = HERE / "in.lattice", HERE / "measure_gpu.lmp"
REFERENCE = "hooke"    #: gran/hooke/history
LAWS = ("constant", "plateau", "exponent", "sds", "luding")
WORKLOADS = ("lattice", "dense", "chute")
_STYLES = {REFERENCE: HOOKE, "constant": "gran/eepa full",
           **{law: f"gran/eepa {law}" for law in LAWS if law != "constant"}}
#: LAMMPS's sections of time are those of a GPU when each kernel is waited for.
_WAIT = {"CUDA_LAUNCH_BLOCKING": "1"}
#: Steps before the clock starts.
WARM = 200


@dataclass(frozen=True)
class Lattice:
    side: int     #: particles along each edge
    every: int    #: steps between two neighbour lists; 0: as particles move, which is never here
    steps: int

    @property
    def name(self) -> str:
        return f"lattice, a list every {self.every}" if self.every else "lattice, no list"

    @property
    def infile(self) -> Path:
        return INFILE

    def variables(self, law: str, _: Path) -> Dict[str, str]:
        return {"law": law, "n": str(self.side), "every": str(self.every), "steps": str(self.steps),
                "warm": str(min(WARM, self.steps)), "timed": "yes", "measure": str(MEASURE)}


@dataclass(frozen=True)
class Flow:
    """A dense packing, or a chute."""

    name: str
    case: cases.Case

    @property
    def infile(self) -> Path:
        return self.case.infile

    def variables(self, law: str, folder: Path) -> Dict[str, str]:
        return {**self.case.variables(self.case.styles[_STYLES[law]], folder), "measure": str(MEASURE)}


Workload = Union[Lattice, Flow]


def steps_of(particles: int) -> int:
    """So many that a run takes seconds on a card, which the reading of its power needs."""
    return min(20000, max(1000, int(1e10 / particles)))


def lattices(counts: Sequence[int], every: Sequence[int], steps: int = 0) -> List[Lattice]:
    """:param counts: particles, about
    :param steps: 0: as steps_of() says
    """
    sides = [max(4, round(count**(1.0 / 3.0))) for count in counts]
    return [Lattice(side, e, steps or steps_of(side**3)) for side in sides for e in every]


def dense(program: Program, work: Path, counts: Sequence[int], cell: int = 20000, steps: int = 0) -> List[Flow]:
    """Copies of a packing with friction, which is made if it is not there; likewise."""
    made = []
    for count in counts:
        side = max(1, int((count / cell)**(1.0 / 3.0)))
        copies = (side, side, max(1, round(count / (cell * side * side))))
        made.append(_flow("dense", cases.dense(program, work, cell, copies), cell * math.prod(copies), steps))
    return made


def chutes(data: Path, counts: Sequence[int], steps: int = 0) -> List[Flow]:
    """Copies of LAMMPS's chute.

    :param data: its data.chute
    """
    made = []
    for count in counts:
        side = max(1, int(math.sqrt(count / 32000)))
        copies = (side, max(1, round(count / (32000 * side))))
        made.append(_flow("chute", cases.chute_of(data, copies), 32000 * math.prod(copies), steps))
    return made


def _flow(name: str, case: cases.Case, particles: int, steps: int) -> Flow:
    steps = steps or steps_of(particles)
    return Flow(name, case.lasting(min(WARM, steps), steps))


def read_log(log: str) -> TimedRun:
    """What measure_gpu.lmp timed: the longer of its two runs, less the shorter one. Figures are of the whole log.

    :raise BadLog: if they are not both there and finished
    """
    lines = log.splitlines()
    marks = {line: k for k, line in enumerate(lines) if line.startswith("Stage ")}
    try:
        short, timed, done = (marks[f"Stage {name}"] for name in ("short", "timed", "done"))
    except KeyError:
        raise BadLog("the log has no finished timed run") from None
    brief = read_run(["Stage timed", *lines[short + 1:timed], "Stage done"])
    run = read_run([*lines[timed:done + 1], *(line for line in lines if line.startswith("Figure "))])
    return dataclasses.replace(
        run, loop=run.loop - brief.loop, steps=run.steps - brief.steps, builds=run.builds - brief.builds,
        sections={name: seconds - brief.sections[name] for name, seconds in run.sections.items()})


def measure(program: Program, kokkos: Sequence[str], workloads: Sequence[Workload], laws: Sequence[str], rounds: int,
            work: Path, note: Callable[[List[Dict]], None] = lambda rows: None) -> List[Dict]:
    """One row a run. In each round all styles run, one after another; in the first, each once more for the time of its
    pair kernels. A run that fails is told, and left out.

    :param kokkos: LAMMPS's command line for KOKKOS
    :param note: is given all rows after each run
    """
    rows: List[Dict] = []
    work.mkdir(parents=True, exist_ok=True)
    for load in workloads:
        for k in range(rounds):
            for law in (REFERENCE, *laws):
                try:
                    rows.append({"case": load.name, "law": law, "round": k,
                                 **_row(program, kokkos, load, law, k == 0, work)})
                except (RunFailed, BadLog) as failure:
                    print(f"{load.name}, {law}: {failure}", flush=True)
                    continue
                note(rows)
                print(f"{load.name}, {rows[-1]['particles']} particles, {law}: {rows[-1]['ms_a_step']:.4g} ms a step",
                      flush=True)
    return rows


def _row(program: Program, kokkos: Sequence[str], load: Workload, law: str, first: bool, work: Path) -> Dict:
    variables = load.variables(law, work)
    with card.Watch() as watch:
        log, screen = _one(program, load, work, variables, kokkos)
    style = "gran/hooke/history/kk" if law == REFERENCE else "gran/eepa/kk"
    if kokkos and f"pair {style}" not in log:
        raise RunFailed(f"{style} did not run: the log has no neighbour list of it")
    run = read_log(log)
    energy, memory = card.energy_and_memory(watch.before, watch.samples, screen, run.loop)
    row = {"particles": run.atoms, "ms_a_step": 1e3 * run.loop / run.steps, "steps": run.steps, "builds": run.builds,
           "contacts_a_particle": run.contacts / run.atoms, "card_bytes": memory,
           "joule_a_particle_step": energy and energy / (run.atoms * float(run.steps))}
    if first:
        waited = read_log(_one(program, load, work, variables, kokkos, _WAIT)[0])
        row["pair_ms_a_step"] = 1e3 * waited.pair / waited.steps
    return row


def _one(program: Program, load: Workload, work: Path, variables: Mapping[str, str], kokkos: Sequence[str],
         settings: Mapping[str, str] = MappingProxyType({})) -> Tuple[str, str]:
    """Its log and what it wrote to the screen."""
    done = run_lammps(program, load.infile, work, variables, more=kokkos, settings=settings)
    return tuple(path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
                 for path in (done.log, work / SCREEN))

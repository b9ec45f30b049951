# SPDX-License-Identifier: GPL-2.0-only
"""The styles for KOKKOS in turn: a lattice, a dense packing, a chute. Needs nothing but Python."""
from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from types import MappingProxyType
from typing import Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

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


#: Columns of the rows, what is told of them, and times which they are told.
_TOLD = (("ms_a_step", "Milliseconds a step", 1.0), ("pair_ms_a_step", "LAMMPS's section Pair, waiting for each kernel, ms a step", 1.0),
         ("contacts_a_particle", "Contacts a particle", 1.0), ("speed", "10^9 particle steps a second", 1e-9),
         ("joule_a_particle_step", "Energy of the card, nJ a particle step", 1e9))


def _of(rows: Sequence[Mapping], law: str, column: str) -> Optional[float]:
    values = [float(row[column]) for row in rows if row["law"] == law and row.get(column) not in (None, "")]
    return median(values) if values else None


def _ratio(rows: Sequence[Mapping], law: str, column: str) -> Optional[float]:
    """Median of ratios to the reference in the same round."""
    of = [{row["round"]: float(row[column]) for row in rows if row["law"] == which and row.get(column) not in (None, "")}
          for which in (law, REFERENCE)]
    both = [of[0][k] / of[1][k] for k in of[0] if k in of[1]]
    return median(both) if both else None


def tables(rows: Sequence[Mapping]) -> str:
    """In Markdown, a line a size: medians, and in brackets those of ratios to the reference of the same round."""
    rows = [{**row, "speed": 1e3 * float(row["particles"]) / float(row["ms_a_step"])} for row in rows]
    laws = [law for law in dict.fromkeys(row["law"] for row in rows) if law != REFERENCE]
    head = ["| case | particles | gran/hooke/history | " + " | ".join(laws) + " |", "|---|---|---|" + "---|" * len(laws)]
    text: List[str] = []
    for column, title, times in _TOLD:
        lines = []
        for case, particles in dict.fromkeys((row["case"], row["particles"]) for row in rows):
            these = [row for row in rows if (row["case"], row["particles"]) == (case, particles)]
            cells = [_cell(these, law, column, times) for law in (REFERENCE, *laws)]
            if any(cells):
                lines.append(f"| {case} | {int(particles):,} | " + " | ".join(cells) + " |")
        if lines:
            text += [f"{title}:", "", *head, *lines, ""]
    lines = [f"| {case} | from {low:,} to {high:,} | " + " | ".join(cells) + " |"
             for case, (low, high, cells) in _memory(rows, (REFERENCE, *laws)).items()]
    if lines:
        text += ["Memory of the card, bytes a particle more:", "", *head, *lines, ""]
    return "\n".join(text)


def _cell(rows: Sequence[Mapping], law: str, column: str, times: float) -> str:
    value = _of(rows, law, column)
    if value is None:
        return ""
    ratio = None if law == REFERENCE else _ratio(rows, law, column)
    return f"{times * value:.3g}" + ("" if ratio is None else f" ({ratio:.2f})")


def _memory(rows: Sequence[Mapping], laws: Sequence[str]) -> Dict[str, Tuple[int, int, List[str]]]:
    """By case: smallest and largest size, and of each law how much memory grows between them; what a program without
    particles takes is not in it."""
    found = {}
    for case in dict.fromkeys(row["case"] for row in rows):
        sizes = sorted({int(row["particles"]) for row in rows if row["case"] == case})
        used = {(size, law): _of([r for r in rows if r["case"] == case and int(r["particles"]) == size], law, "card_bytes")
                for size in sizes for law in laws}
        if len(sizes) > 1 and any(used.values()):
            low, high = sizes[0], sizes[-1]
            found[case] = (low, high, [
                "" if used[low, law] is None or used[high, law] is None else
                f"{(used[high, law] - used[low, law]) / (high - low):.0f}" for law in laws])
    return found


def speeds(rows: Sequence[Mapping]) -> Dict[Tuple[str, str], List[Tuple[int, float]]]:
    """Of each case and law, numbers of particles and medians of particle steps a second."""
    found: Dict[Tuple[str, str], List[Tuple[int, float]]] = {}
    for case, law, particles in dict.fromkeys((row["case"], row["law"], row["particles"]) for row in rows):
        these = [row for row in rows if (row["case"], row["particles"]) == (case, particles)]
        found.setdefault((case, law), []).append((int(particles), 1e3 * int(particles) / (_of(these, law, "ms_a_step") or math.nan)))
    return found

# SPDX-License-Identifier: GPL-2.0-only
"""What LAMMPS's log says about the timed run of measure.lmp."""
from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, Iterable

#: seconds, ranks, steps, particles
LOOP = re.compile(r"^Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms", re.MULTILINE)
_CPU = re.compile(r"^([\d.]+)% CPU use with")
_SECTION = re.compile(r"^(\w+)\s*\|\s*([\d.e+-]*)\s*\|\s*([\d.e+-]+)\s*\|\s*([\d.e+-]*)\s*\|")
# as LAMMPS wrote it until 2013 and LIGGGHTS does
_OLD_SECTION = re.compile(r"^(\w+)\s+time \(%\) = (\S+) \(")
_NEIGHBORS = re.compile(r"^Total # of neighbors = (\d+)")
_BUILDS = re.compile(r"^Neighbor list builds = (\d+)")
_MEMORY = re.compile(r"^Per MPI rank memory allocation \(min/avg/max\) = "
                     r"\S+ \| \S+ \| (\S+) Mbytes")
_FIGURE = re.compile(r"^Figure (\w+) (\S+)\s*$")


class BadLog(ValueError):
    """A log without the timed run that it should have."""


@dataclass
class TimedRun:
    """Times in seconds; of several ranks a section's time is that of the slowest."""

    loop: float = 0.0
    ranks: int = 0
    steps: int = 0
    atoms: int = 0
    cpu_percent: float = 0.0
    sections: Dict[str, float] = field(default_factory=dict)
    neighbors: int = 0
    builds: int = 0
    memory_mb: float = 0.0
    figures: Dict[str, float] = field(default_factory=dict)

    @property
    def pair(self) -> float:
        return self.sections["Pair"]

    @property
    def contacts(self) -> float:
        """Number of contacts, mean of start and end of the run."""
        return 0.5 * (self.figures["contacts_before"] + self.figures["contacts_after"])


def read_run(lines: Iterable[str]) -> TimedRun:
    """Reads the run between the lines `Stage timed` and `Stage done`, and every figure of the log.

    :raise BadLog: if it is not there or not finished
    """
    run = TimedRun()
    stage = ""
    for line in lines:
        if line.startswith("Stage "):
            stage = line.split()[1]
            continue
        figure = _FIGURE.match(line)
        if figure:
            run.figures[figure.group(1)] = float(figure.group(2))
        elif stage == "timed":
            _read_line(run, line)
    if stage != "done" or "Pair" not in run.sections:
        raise BadLog("the log has no finished timed run")
    return run


def _read_line(run: TimedRun, line: str) -> None:
    loop = LOOP.match(line)
    if loop:
        run.loop = float(loop.group(1))
        run.ranks, run.steps, run.atoms = (int(loop.group(k)) for k in (2, 3, 4))
        return
    old = _OLD_SECTION.match(line)
    if old:
        run.sections[old.group(1)] = float(old.group(2))
        return
    section = _SECTION.match(line)
    if section:
        average, slowest = section.group(3), section.group(4)
        run.sections[section.group(1)] = float(slowest or average)
        return
    for pattern, name, kind in ((_CPU, "cpu_percent", float), (_NEIGHBORS, "neighbors", int),
                                (_BUILDS, "builds", int), (_MEMORY, "memory_mb", float)):
        found = pattern.match(line)
        if found:
            setattr(run, name, kind(found.group(1)))


def read_log(path: Path) -> TimedRun:
    """The same of a file."""
    try:
        with path.open(encoding="utf-8", errors="replace") as log:
            return read_run(log)
    except BadLog as error:
        raise BadLog(f"{path}: {error}") from None

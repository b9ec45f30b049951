# SPDX-License-Identifier: GPL-2.0-only
"""Progress and times of a run from its LAMMPS log."""
from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, Iterable, List

_STAGE = re.compile(r"^Stage (\w+)\s*$")
_LOOP = re.compile(r"^Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms")
_CPU = re.compile(r"^(\S+)% CPU use with")
_THERMO = re.compile(r"^\s*(\d+)(?:\s+-?[\d.]\S*){3,}\s*$")
# Thermo lines of these stages do not count on from one to the next.
_OWN_COUNT = "place"


@dataclass
class Stage:
    """Loop time, processor time and steps of the runs between two `Stage` lines."""

    seconds: float = 0.0
    cpu_seconds: float = 0.0
    steps: int = 0


@dataclass
class LogSummary:
    stages: Dict[str, Stage] = field(default_factory=dict)
    current: str = "start"
    step: int = 0
    particles: int = 0
    finished: bool = False


def summarise(lines: Iterable[str]) -> LogSummary:
    """Reads a log, one that is still being written as well."""
    summary = LogSummary()
    last = 0.0
    for line in lines:
        stage = _STAGE.match(line)
        if stage:
            summary.current = stage.group(1)
            summary.finished = summary.current == "done"
            summary.step = 0 if summary.current == _OWN_COUNT else summary.step
            continue
        loop = _LOOP.match(line)
        if loop:
            entry = summary.stages.setdefault(summary.current, Stage())
            last = float(loop.group(1))
            entry.seconds += last
            entry.steps += int(loop.group(3))
            summary.particles = int(loop.group(4))
            continue
        cpu = _CPU.match(line)
        if cpu:  # follows the loop time that it is a part of
            summary.stages[summary.current].cpu_seconds += 0.01 * float(cpu.group(1)) * last
            continue
        thermo = _THERMO.match(line)
        if thermo:
            summary.step = int(thermo.group(1))
    return summary


def summarise_file(path: Path) -> LogSummary:
    """The same of a file; one that is not there yet is a run that has not begun."""
    try:
        with path.open(encoding="utf-8", errors="replace") as log:
            return summarise(log)
    except FileNotFoundError:
        return LogSummary()


def tail(path: Path, lines: int = 20) -> List[str]:
    """The last lines of a file, none if there is no file."""
    try:
        return path.read_text(encoding="utf-8", errors="replace").splitlines()[-lines:]
    except FileNotFoundError:
        return []

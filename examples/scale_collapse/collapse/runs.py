# SPDX-License-Identifier: GPL-2.0-only
"""Runs the cases: so many at once, resuming where an earlier call was stopped."""
from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import time
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

from . import mpi
from .cases import Case, folder_of
from .logs import LogSummary, summarise_file, tail
from .progress import Progress
from .versions import commit, lammps

MARKER = "done.json"
LOG = "log.lammps"
SCREEN = "screen.txt"
CURVE = "curve.csv"
_INCLUDE = re.compile(r"^[^#\n]*\binclude\s+\$\{files\}/([\w.]+)", re.MULTILINE)


class RunFailed(RuntimeError):
    """A LAMMPS run failed; the message names it and shows how its log ends."""


def with_includes(infile: Path) -> List[Path]:
    """An in-file and, in its folder, those that it includes, directly or not."""
    found, waiting = [], [infile]
    while waiting:
        path = waiting.pop(0)
        if path not in found:
            found.append(path)
            waiting += [infile.with_name(name)
                        for name in _INCLUDE.findall(path.read_text(encoding="utf-8"))]
    return found


@dataclass(frozen=True)
class Launcher:
    """How LAMMPS is started.

    :param infile: what it reads; a case with another `infile` finds that in the same folder
    """

    lmp: Path
    infile: Path
    mpirun: str = "mpirun"
    ranks: int = 1

    def command(self, case: Case, folder: Path) -> List[str]:
        """The command reads a copy of the in-file in the run's folder: LAMMPS reads in-files during the
        run, and an edit meanwhile must not change a run that has begun."""
        words = [self.mpirun, "-np", str(self.ranks), str(self.lmp), "-in",
                 str(folder / self.infile_of(case).name), "-log", str(folder / LOG), "-var", "out",
                 str(folder), "-var", "files", str(folder), *case.variables()]
        if case.needs is not None:
            words += ["-var", "state", str(folder.with_name(case.needs.name) / case.state)]
        return words

    def infile_of(self, case: Case) -> Path:
        return self.infile if case.needs is None else self.infile.with_name(case.infile)

    def environment(self) -> Dict[str, str]:
        return {**os.environ, **mpi.settings(), "OMP_NUM_THREADS": "1"}

    def fingerprint(self, case: Case) -> str:
        return case.fingerprint([path.read_bytes() for path in self.inputs(case)], self.ranks)

    def inputs(self, case: Case) -> List[Path]:
        """The files on which the result depends: in-files, also of the run that this one needs, and
        build/lmp with the plugin beside it."""
        plugin = self.lmp.with_name("eepaplugin.so")
        before = with_includes(self.infile_of(case.needs)) if case.needs is not None else []
        return (with_includes(self.infile_of(case)) + before + [self.lmp]
                + ([plugin] if plugin.is_file() else []))


@dataclass
class _Active:
    case: Case
    fingerprint: str
    process: subprocess.Popen
    folder: Path
    started: float


def is_complete(folder: Path, fingerprint: str) -> bool:
    """Whether the folder holds a finished run of just these parameters."""
    try:
        marker = json.loads((folder / MARKER).read_text(encoding="utf-8"))
    except (FileNotFoundError, json.JSONDecodeError):
        return False
    return (isinstance(marker, dict) and marker.get("fingerprint") == fingerprint
            and (folder / CURVE).is_file())


def read_marker(folder: Path) -> dict:
    """The record of a finished run: parameters, times and steps of each stage."""
    return json.loads((folder / MARKER).read_text(encoding="utf-8"))


def measured_speed(out: Path) -> Optional[float]:
    """Particles times steps per second of the finished runs in the folder, if there are any."""
    work = seconds = 0.0
    for path in out.glob(f"runs/*/{MARKER}"):
        marker = json.loads(path.read_text(encoding="utf-8"))
        stages = [stage for name, stage in marker["stages"].items() if name != "place"]
        work += marker["particles"] * sum(stage["steps"] for stage in stages)
        seconds += sum(stage["seconds"] for stage in stages)
    return work / seconds if seconds > 0.0 else None


class Runner:
    """Runs cases and keeps each in a folder of its own.

    A run works in NAME.partial, which becomes NAME when it is complete and NAME.failed when it
    failed; so NAME never holds half a run, whatever ends this program.
    """

    def __init__(self, launcher: Launcher, out: Path, jobs: int, progress: Progress) -> None:
        if jobs < 1:
            raise ValueError(f"jobs is {jobs}, allowed is 1 or more")
        self._launcher = launcher
        self._files: Dict[Path, Dict[str, bytes]] = {}
        self._out = out
        self._jobs = jobs
        self._progress = progress
        self._active: List[_Active] = []
        self._versions: Dict[str, str] = {}

    def run(self, cases: Sequence[Case], redo: bool = False, poll_seconds: float = 0.25) -> None:
        """Runs the cases that are not finished.

        :raise RunFailed: on the first run that fails; the others are stopped
        """
        waiting = []
        for case in sorted(cases, key=lambda case: case.needs is None):
            fingerprint = self._launcher.fingerprint(case)
            folder = folder_of(self._out, case)
            wanted = [folder / f"{other.state}.restart" for other, _ in waiting
                      if other.needs == case]
            if (not redo and is_complete(folder, fingerprint)
                    and all(path.is_file() for path in wanted)):
                self._progress.kept(case, self._summary(folder))
            else:
                waiting.append((case, fingerprint))
        order = {case: place for place, case in enumerate(cases)}
        waiting.sort(key=lambda entry: order[entry[0]])
        # Read once, so that a commit meanwhile does not change the present runs.
        self._versions = ({"commit": commit(), "lammps": lammps(self._launcher.lmp)} if waiting
                          else {})
        self._progress.begin()
        try:
            with _deferred_signals() as received:
                while waiting or self._active:
                    while len(self._active) < self._jobs and not received:
                        ready = self._next(waiting)
                        if ready is None:
                            break
                        self._start(*waiting.pop(ready))
                    time.sleep(poll_seconds)
                    for active in list(self._active):
                        if active.process.poll() is not None:
                            self._active.remove(active)
                            self._finish(active)
                    if received:
                        break
                    self._progress.show({active.case: self._summary(active.folder)
                                         for active in self._active})
                self._stop_all()
            if signal.SIGINT in received:
                raise KeyboardInterrupt
            if received:
                raise SystemExit(128 + received[0])
        finally:
            self._stop_all()
            self._progress.close()

    def _contents(self, infile: Path) -> Dict[str, bytes]:
        """Of the in-file and its includes, as they were when the first such run began."""
        if infile not in self._files:
            self._files[infile] = {path.name: path.read_bytes() for path in with_includes(infile)}
        return self._files[infile]

    def _next(self, waiting: Sequence[Tuple[Case, str]]) -> Optional[int]:
        """Place of the first run whose needs are met: neither waiting nor under way."""
        busy = {case for case, _ in waiting} | {active.case for active in self._active}
        return next((k for k, (case, _) in enumerate(waiting) if case.needs not in busy), None)

    def _summary(self, folder: Path) -> LogSummary:
        return summarise_file(folder / LOG)

    def _start(self, case: Case, fingerprint: str) -> None:
        final = folder_of(self._out, case)
        for stale in (final, _beside(final, "partial"), _beside(final, "failed")):
            shutil.rmtree(stale, ignore_errors=True)
        folder = _beside(final, "partial")
        folder.mkdir(parents=True)
        for name, content in self._contents(self._launcher.infile_of(case)).items():
            (folder / name).write_bytes(content)
        with (folder / SCREEN).open("wb") as screen:
            # A session of its own: Ctrl-C in the terminal comes here and not to mpirun too.
            process = subprocess.Popen(
                self._launcher.command(case, folder), stdin=subprocess.DEVNULL, stdout=screen,
                stderr=subprocess.STDOUT, env=self._launcher.environment(),
                start_new_session=True)
        self._active.append(_Active(case, fingerprint, process, folder, time.monotonic()))

    def _finish(self, active: _Active) -> None:
        final = folder_of(self._out, active.case)
        summary = self._summary(active.folder)
        if active.process.returncode != 0 or not summary.finished:
            kept = _beside(final, "failed")
            active.folder.rename(kept)
            raise RunFailed(_failure(active, kept))
        marker = {
            "fingerprint": active.fingerprint,
            "case": asdict(active.case),
            "ranks": self._launcher.ranks,
            "jobs": self._jobs,
            **self._versions,
            "command": self._launcher.command(active.case, final),
            "particles": summary.particles,
            "stages": {name: asdict(stage) for name, stage in summary.stages.items()},
            "wall_seconds": time.monotonic() - active.started,
        }
        (active.folder / MARKER).write_text(json.dumps(marker, indent=2) + "\n", encoding="utf-8")
        active.folder.rename(final)
        self._progress.done(active.case, summary)

    def _stop_all(self) -> None:
        for active in self._active:
            _signal_group(active.process, signal.SIGTERM)
        for active in self._active:
            try:
                active.process.wait(timeout=5.0)
            except subprocess.TimeoutExpired:
                _signal_group(active.process, signal.SIGKILL)
                active.process.wait()
            shutil.rmtree(active.folder, ignore_errors=True)
        self._active.clear()


@contextmanager
def _deferred_signals() -> Iterator[List[int]]:
    """Collects Ctrl-C and kill signals in the list that it yields, so that they do not interrupt the
    program between the start of a run and its record."""
    received: List[int] = []
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = {}
    try:
        for number in numbers:
            before[number] = signal.signal(number, lambda got, frame: received.append(got))
    except ValueError:
        pass  # not in the main thread, which is where signals go
    try:
        yield received
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _beside(folder: Path, ending: str) -> Path:
    return folder.with_name(f"{folder.name}.{ending}")


def _signal_group(process: subprocess.Popen, number: int) -> None:
    try:
        os.killpg(process.pid, number)
    except ProcessLookupError:
        pass


def _failure(active: _Active, folder: Path) -> str:
    ending = _up_to_error(tail(folder / SCREEN, 200)) or tail(folder / LOG) or [
        "(it wrote nothing)"]
    command = " ".join(map(str, active.process.args)).replace(str(active.folder), str(folder))
    return "\n".join([f"run {active.case.name} failed with status {active.process.returncode}; "
                      f"its log is {folder / LOG} and ends", ""]
                     + [f"    {line}" for line in ending]
                     + ["", f"It was started by\n    {command}"])


def _up_to_error(lines: List[str]) -> List[str]:
    """The last lines; where there is an error, those that lead to it, without the messages of mpirun
    that follow."""
    errors = [k for k, line in enumerate(lines) if line.startswith("ERROR")]
    return lines[:errors[-1] + 2][-20:] if errors else lines[-20:]


def find_lmp(given: Optional[Path], candidates: Sequence[Path]) -> Path:
    """The LAMMPS to run, as an absolute path.

    :raise FileNotFoundError: with every place where it was sought
    """
    if given is not None:
        found = shutil.which(str(given))
        if found is None:
            raise FileNotFoundError(f"--lmp {given}: no such program")
        return Path(found).resolve()
    for candidate in candidates:
        if os.access(candidate, os.X_OK):
            return candidate.resolve()
    raise FileNotFoundError("no LAMMPS at " + ", ".join(map(str, candidates))
                            + ": build this project or name one with --lmp")

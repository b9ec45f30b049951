# SPDX-License-Identifier: GPL-2.0-only
"""Starts LAMMPS: ranks, threads, the cores they are bound to, time and memory."""
from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Dict, List, Mapping, Sequence

from coarsen.workflow import mpi_settings

LOG = "log.lammps"
SCREEN = "screen.txt"
# LAMMPS's own output is buffered, so other output can appear in its midst
_PEAK = re.compile(r"VmHWM:\s*(\d+) kB")


class RunFailed(RuntimeError):
    """A LAMMPS run failed; the message names it and shows how its log ends."""


def tail(path: Path, lines: int = 20) -> List[str]:
    """The last lines of a file, none if there is no file."""
    return path.read_text(encoding="utf-8", errors="replace").splitlines()[-lines:] if path.is_file() else []


def usable_cores() -> List[int]:
    if hasattr(os, "sched_getaffinity"):
        return sorted(os.sched_getaffinity(0))
    return list(range(os.cpu_count() or 1))


@dataclass(frozen=True)
class Program:
    """The LAMMPS to run and how."""

    lmp: Path
    mpirun: str = "mpirun"
    bind: bool = True    #: keep each rank or thread on a core of its own


@dataclass(frozen=True)
class Parallel:
    """threads = 0: without the suffix omp."""

    ranks: int = 1
    threads: int = 0

    @property
    def name(self) -> str:
        return f"{self.ranks} x {self.threads} omp" if self.threads else f"{self.ranks} x serial"

    @property
    def cores(self) -> int:
        return self.ranks * max(1, self.threads)


@dataclass(frozen=True)
class Finished:
    log: Path
    seconds: float
    peak_kb: int    #: largest resident set of the first rank; 0 where it is unknown


def command(program: Program, infile: Path, folder: Path, variables: Mapping[str, str],
            parallel: Parallel = Parallel(), prefix: Sequence[str] = (), more: Sequence[str] = ()) -> List[str]:
    words: List[str] = []
    if parallel.ranks > 1:
        words += [program.mpirun, "-np", str(parallel.ranks)]
        if not program.bind:
            words += ["--bind-to", "none"]
        elif parallel.threads > 1:
            words += ["--map-by", f"slot:PE={parallel.threads}", "--bind-to", "core"]
        else:
            words += ["--bind-to", "core"]
    words += [*prefix, str(program.lmp), "-in", str(infile), "-log", str(folder / LOG)]
    if parallel.threads:
        words += ["-sf", "omp", "-pk", "omp", str(parallel.threads)]
    words += more
    for name, value in variables.items():
        words += ["-var", name, value]
    return words


def environment(program: Program, parallel: Parallel = Parallel()) -> Dict[str, str]:
    settings = {**mpi_settings(), "OMP_NUM_THREADS": str(max(1, parallel.threads))}
    if parallel.cores <= len(usable_cores()):
        del settings["OMPI_MCA_mpi_yield_when_idle"]    # it would cost time, and is not needed
    if program.bind and parallel.threads:
        settings.update(OMP_PROC_BIND="true", OMP_PLACES="cores")
    return {**os.environ, **settings}


def bind(process: subprocess.Popen, cores: int = 1) -> None:
    """Binds a process to as many cores: the last ones, since the system uses the first."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(process.pid, usable_cores()[-cores:])


def run_lammps(program: Program, infile: Path, folder: Path, variables: Mapping[str, str],
               parallel: Parallel = Parallel(), prefix: Sequence[str] = (), more: Sequence[str] = (),
               settings: Mapping[str, str] = MappingProxyType({})) -> Finished:
    """Runs an in-file in a folder that must exist.

    :param prefix: what LAMMPS is started under, such as valgrind
    :param more: of LAMMPS's command line
    :param settings: further variables of its environment
    :raise RunFailed: with the end of what LAMMPS said
    """
    words = command(program, infile, folder, variables, parallel, prefix, more)
    started = time.monotonic()
    with (folder / SCREEN).open("wb") as screen:
        # a session of its own, so that all of it can be ended at once
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=screen,
                                   stderr=subprocess.STDOUT, cwd=folder,
                                   env={**environment(program, parallel), **settings}, start_new_session=True)
        if program.bind and parallel.ranks == 1:    # mpirun binds by itself
            bind(process, parallel.cores)
        try:
            process.wait()
        except BaseException:
            os.killpg(process.pid, signal.SIGTERM)
            process.wait()
            raise
    seconds = time.monotonic() - started
    if process.returncode != 0:
        said = "\n".join(f"    {line}" for line in tail(folder / SCREEN))
        raise RunFailed(f"status {process.returncode} of\n    {' '.join(words)}\n"
                        f"which ends\n{said}")
    # the system's account of the child is useless: it begins with this program's own size
    peak = _PEAK.search((folder / SCREEN).read_text(encoding="utf-8", errors="replace"))
    return Finished(folder / LOG, seconds, int(peak.group(1)) if peak else 0)


def has_pair_style(program: Program, folder: Path, style: str) -> bool:
    """Whether this LAMMPS knows a pair style."""
    folder.mkdir(parents=True, exist_ok=True)
    infile = folder / "in.probe"
    infile.write_text("atom_style sphere\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\n"
                      f"pair_style {style} linear\n", encoding="utf-8")
    try:
        run_lammps(program, infile, folder, {})
    except RunFailed as failure:
        if "Unrecognized pair style" in str(failure) or "nknown pair style" in str(failure):
            return False
        raise
    return True

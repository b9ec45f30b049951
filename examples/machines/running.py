# SPDX-License-Identifier: GPL-2.0-only
"""Starts LAMMPS for the examples: some runs at once, and none a second time."""
from __future__ import annotations

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable, Dict, List, Optional, Sequence

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "coarsen"))

from coarsen.workflow import NotInstalled, cores, find_lmp, mpi_settings, results_folder  # noqa: E402

_MARKER = "done.json"
_LAST_LINES = 12


class RunFailed(RuntimeError):
    """A run of LAMMPS failed; the message names it and shows how its log ends."""


@dataclass(frozen=True)
class Run:
    """One run: its name, its in-file and the variables that -var sets.

    :param needs: folders of runs whose results it reads, by the variable that names them
    """

    name: str
    infile: Path
    variables: Dict[str, object]
    needs: Dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Launcher:
    """:param out: holds a folder for each run
    :param ranks: MPI ranks of each run"""

    lmp: Path
    out: Path
    ranks: int = 1

    def folder(self, run: Run) -> Path:
        return self.out / "runs" / run.name

    def command(self, run: Run) -> List[str]:
        folder = self.folder(run)
        words = ["mpirun", "-np", str(self.ranks)] if self.ranks > 1 else []
        words += [str(self.lmp), "-in", str(folder / run.infile.name), "-log", str(folder / "log.lammps"),
                  "-screen", "none", "-var", "out", str(folder), "-var", "files", str(folder), "-var",
                  "shared", str(folder)]
        for name, value in run.variables.items():
            words += ["-var", name, *([str(v) for v in value] if isinstance(value, (list, tuple))
                                      else [str(value)])]
        for name, other in run.needs.items():
            words += ["-var", name, str(self.out / "runs" / other)]
        return words

    def fingerprint(self, run: Run) -> str:
        """Of the command and the in-files, but not of the executable: rebuilding it makes no run old."""
        content = hashlib.sha256(json.dumps(self.command(run)).encode())
        for path in _infiles(run):
            content.update(path.read_bytes())
        return content.hexdigest()

    def is_done(self, run: Run) -> bool:
        try:
            marker = json.loads((self.folder(run) / _MARKER).read_text(encoding="utf-8"))
        except (FileNotFoundError, json.JSONDecodeError):
            return False
        return marker.get("fingerprint") == self.fingerprint(run)

    def seconds(self, run: Run) -> float:
        marker = json.loads((self.folder(run) / _MARKER).read_text(encoding="utf-8"))
        return float(marker["seconds"])

    def start(self, run: Run) -> None:
        """Does the run and waits for its end."""
        folder = self.folder(run)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / _MARKER).unlink(missing_ok=True)
        # LAMMPS reads in-files during the run, and an edit meanwhile must not change a run that has begun.
        fingerprint = self.fingerprint(run)
        for path in _infiles(run):
            shutil.copyfile(path, folder / path.name)
        begin = time.monotonic()
        done = subprocess.run(self.command(run), env={**os.environ, **mpi_settings(),
                                                      "OMP_NUM_THREADS": "1"},
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            log = folder / "log.lammps"
            lines = log.read_text(errors="replace").splitlines() if log.is_file() else []
            raise RunFailed("\n".join([f"{run.name}: {' '.join(self.command(run))} ended with status "
                                       f"{done.returncode}", *done.stdout.splitlines()[-_LAST_LINES:],
                                       *lines[-_LAST_LINES:]]))
        marker = {"fingerprint": fingerprint, "seconds": time.monotonic() - begin,
                  "variables": {name: str(value) for name, value in run.variables.items()}}
        (folder / _MARKER).write_text(json.dumps(marker, indent=1), encoding="utf-8")

    def start_all(self, runs: Sequence[Run], jobs: int) -> None:
        """So many at once, those that need others after these. Finished ones are not repeated."""
        waiting = [run for run in runs if not self.is_done(run)]
        print(f"{len(runs)} runs, {len(runs) - len(waiting)} of them done before, {jobs} at once, into "
              f"{self.out}", flush=True)
        while waiting:
            names = {run.name for run in waiting}
            ready = [run for run in waiting if not names & set(run.needs.values())]
            with ThreadPoolExecutor(jobs) as pool:
                for run, _ in zip(ready, pool.map(self.start, ready)):
                    print(f"  {run.name}: {self.seconds(run):.0f} s", flush=True)
            waiting = [run for run in waiting if run not in ready]


def _infiles(run: Run) -> List[Path]:
    """Those of the example and those that all examples share."""
    return sorted({*run.infile.parent.glob("in.*"), *Path(__file__).resolve().parent.glob("in.*")})


def parser(description: str, name: str) -> argparse.ArgumentParser:
    """The options that all examples have.

    :param name: of the example, which its folder of results has too
    """
    made = argparse.ArgumentParser(description=description,
                                   formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    made.add_argument("--full", action="store_true", help="the full size instead of the quick one")
    made.add_argument("--seeds", type=int, default=None, metavar="N", help="fillings of each case")
    made.add_argument("--lmp", type=Path, default=None,
                      help="LAMMPS with this package; None is that of the build folder or of the installation")
    made.add_argument("--ranks", type=int, default=1, help="MPI ranks of each run")
    made.add_argument("--jobs", type=int, default=None, help="runs at once (default: one a core)")
    made.add_argument("--out", type=Path, default=results_folder() / name,
                      help="folder of runs, table and pictures")
    return made


def launcher(arguments: argparse.Namespace) -> Launcher:
    """Of the options of parser(); fills in --jobs."""
    if arguments.ranks < 1:
        raise RunFailed(f"--ranks is {arguments.ranks}, allowed is 1 or more")
    try:
        lmp = find_lmp(arguments.lmp)
    except NotInstalled as missing:
        raise RunFailed(str(missing)) from None
    if arguments.jobs is None:
        arguments.jobs = max(1, cores() // arguments.ranks)
    out = Path(arguments.out).resolve()
    out.mkdir(parents=True, exist_ok=True)
    return Launcher(lmp, out, arguments.ranks)


def exit_status(program: str, work: Callable[[], Optional[object]]) -> int:
    """Does the work. An error that a user can correct ends in a line without traceback."""
    try:
        work()
    except KeyboardInterrupt:
        print("\nStopped. Finished runs are kept: the same call goes on from there.")
        return 130
    except (RunFailed, OSError, ValueError) as error:
        print(f"{program}: {error}", file=sys.stderr)
        return 1
    return 0

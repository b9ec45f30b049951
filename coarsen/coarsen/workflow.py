# SPDX-License-Identifier: GPL-2.0-only
"""Runs a study through Snakemake, which starts runs, keeps what is done and goes on after a stop."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import time
from pathlib import Path
from typing import Dict, List, Sequence, Union

SNAKEFILE = Path(__file__).resolve().parent / "Snakefile"
#: An installation has the folders of the source in share/eepa, and programs in bin.
ROOT = Path(__file__).resolve().parents[2]
INSTALLED = not (ROOT / "CMakeLists.txt").is_file()


class NotInstalled(RuntimeError):
    """A program that is needed was not found; the message says where it was sought."""


def find_lmp(given: Union[None, str, Path]) -> Path:
    """LAMMPS with this package: the one named, or that of the build folder or of the installation, or lmp-eepa or
    lmp on the path.

    :raise NotInstalled: with every place where it was sought
    """
    build = os.environ.get("BUILD_DIR")
    places = [Path(build) / "lmp"] if build else []
    if INSTALLED:
        places.append(ROOT.parents[1] / "bin" / "lmp-eepa")
    elif not build:
        places.append(ROOT / "build" / "lmp")
    places = [str(given)] if given else [*map(str, places), "lmp-eepa", "lmp"]
    for place in places:
        found = shutil.which(place)
        if found:
            return Path(found).resolve()
    raise NotInstalled(f"no LAMMPS at {' or '.join(places)}: build this project, or name one "
                       "with --lmp")


def results_folder() -> Path:
    """Where examples put their results: the build folder, or for those of an installation the present folder."""
    return Path(os.environ.get("BUILD_DIR") or (Path() if INSTALLED else ROOT / "build"))


def run_study(study: Path, infiles: Path, out: Path, lmp: Path, cores: int, ranks: int = 1,
              more: Sequence[str] = (), switches: str = "") -> None:
    """Runs what of the study is not done yet, so many cores at once, and shows how far it is. All that Snakemake
    says is in snakemake.log in `out`.

    :param more: further arguments of Snakemake, such as --profile slurm
    :param switches: further command-line switches of LAMMPS, as in a shell
    :raise NotInstalled: without Snakemake
    :raise subprocess.CalledProcessError: when a run failed, after those that had begun have ended
    """
    snakemake = shutil.which("snakemake")
    if snakemake is None:
        raise NotInstalled("no snakemake on the path; on Debian: apt-get install snakemake")
    out.mkdir(parents=True, exist_ok=True)
    command = [snakemake, "--snakefile", str(SNAKEFILE), "--directory", str(out), "--cores", str(cores),
               "--rerun-incomplete", *more, "--config",
               f"study={study.resolve()}", f"infiles={infiles.resolve()}", f"out={out.resolve()}",
               f"lmp={lmp}", f"ranks={ranks}", *([f"switches={switches}"] if switches else [])]
    with (out / "snakemake.log").open("w", encoding="utf-8") as log, subprocess.Popen(
            command, env={**os.environ, **mpi_settings()}, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True) as running:
        began = time.monotonic()
        for line in running.stdout or ():
            log.write(line)
            shown = shown_of(line, time.monotonic() - began)
            if shown:
                print(shown, flush=True)
    if running.returncode != 0:
        print(f"All that Snakemake said: {out / 'snakemake.log'}")
        raise subprocess.CalledProcessError(running.returncode, command)


_PROGRESS = re.compile(r"^(\d+) of (\d+) steps \(\d+%\) done")
#: What the Snakefile and LAMMPS say of a run that failed, and Snakemake of what it can not do at all.
_ERROR = re.compile(r"^(Run .* failed, see|ERROR|Last (input|command)|\w*(Error|Exception)\b|Missing|Incomplete)")


def shown_of(line: str, seconds: float) -> str:
    """What a user sees of a line of Snakemake's, empty if nothing.

    :param seconds: since the begin
    """
    found = _PROGRESS.match(line)
    if found:
        done, runs = int(found.group(1)), int(found.group(2)) - 1  # the last step only collects
        if done > runs:
            return ""
        left = seconds * (runs - done) / done
        return f"[{done} of {runs} runs done, about {f'{left:.0f} s' if left < 100 else f'{left / 60:.0f} min'} left]"
    return line.rstrip() if _ERROR.match(line) else ""


def mpi_settings() -> Dict[str, str]:
    """The variables of scripts/mpi.env, which has the reasons."""
    path = Path(__file__).resolve().parents[2] / "scripts" / "mpi.env"
    lines: List[str] = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    return dict(line.split("=", 1) for line in lines if line and not line.startswith("#"))


def cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1



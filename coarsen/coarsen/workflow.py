# SPDX-License-Identifier: GPL-2.0-only
"""Runs a study through Snakemake, which starts runs, keeps what is done and goes on after a stop."""
from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path
from typing import Dict, List, Sequence, Union

SNAKEFILE = Path(__file__).resolve().parent / "Snakefile"


class NotInstalled(RuntimeError):
    """A program that is needed was not found; the message says where it was sought."""


def find_lmp(given: Union[None, str, Path]) -> Path:
    """LAMMPS with this package: the one named, or that of the build folder, or lmp on the path.

    :raise NotInstalled: with every place where it was sought
    """
    root = Path(__file__).resolve().parents[2]
    places = [str(given)] if given else [str(Path(os.environ.get("BUILD_DIR") or root / "build") / "lmp"), "lmp"]
    for place in places:
        found = shutil.which(place)
        if found:
            return Path(found).resolve()
    raise NotInstalled(f"no LAMMPS at {' or '.join(map(str, places))}: build this project, or name one "
                       "with --lmp")


def run_study(study: Path, infiles: Path, out: Path, lmp: Path, cores: int, ranks: int = 1,
              more: Sequence[str] = ()) -> None:
    """Runs what of the study is not done yet, so many cores at once.

    :param more: further arguments of Snakemake, such as --profile slurm
    :raise NotInstalled: without Snakemake
    :raise subprocess.CalledProcessError: when a run failed, after those that had begun have ended
    """
    snakemake = shutil.which("snakemake")
    if snakemake is None:
        raise NotInstalled("no snakemake on the path; on Debian: apt-get install snakemake")
    out.mkdir(parents=True, exist_ok=True)
    command = [snakemake, "--snakefile", str(SNAKEFILE), "--directory", str(out), "--cores", str(cores),
               "--rerun-incomplete", "--quiet", "rules", *more, "--config",
               f"study={study.resolve()}", f"infiles={infiles.resolve()}", f"out={out.resolve()}",
               f"lmp={lmp}", f"ranks={ranks}"]
    subprocess.run(command, check=True, env={**os.environ, **mpi_settings()}, stdin=subprocess.DEVNULL)


def mpi_settings() -> Dict[str, str]:
    """The variables of scripts/mpi.env, which has the reasons."""
    path = Path(__file__).resolve().parents[2] / "scripts" / "mpi.env"
    lines: List[str] = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    return dict(line.split("=", 1) for line in lines if line and not line.startswith("#"))


def cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1



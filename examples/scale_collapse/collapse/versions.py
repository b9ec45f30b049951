# SPDX-License-Identifier: GPL-2.0-only
"""Versions of the programs that ran and of those that made a report."""
from __future__ import annotations

import os
import platform
import subprocess
from pathlib import Path

_HERE = Path(__file__).resolve().parent


def commit() -> str:
    """Of this project, and whether it has changes that are not committed."""
    number = _said("git", "rev-parse", "HEAD").strip()
    if not number:
        return "unknown"
    return number + (" with changes" if _said("git", "status", "--porcelain").strip() else "")


def lammps(lmp: Path) -> str:
    """Name and version."""
    head = next((line for line in _said(str(lmp), "-h").splitlines()
                 if line.startswith("Large-scale")), "- unknown")
    return "LAMMPS " + head.split(" - ")[-1].lstrip("- ").strip()


def mpi(mpirun: str = "mpirun") -> str:
    return next(iter(_said(mpirun, "--version").splitlines()), "unknown")


def machine() -> str:
    return (f"{platform.machine()}, {_processor()}, {os.cpu_count()} cores, {platform.system()} "
            f"{platform.release()}")


def _said(*words: str) -> str:
    try:
        return subprocess.run(words, text=True, capture_output=True, timeout=60, check=True,
                              cwd=_HERE).stdout
    except (OSError, subprocess.SubprocessError):
        return ""


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or "unknown processor"

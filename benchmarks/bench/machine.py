# SPDX-License-Identifier: GPL-2.0-only
"""Description of the machine and programs with which a figure was measured."""
from __future__ import annotations

import json
import platform
import subprocess
from datetime import datetime, timezone
from pathlib import Path
from typing import Dict, Sequence

from .lammps import usable_cores


def describe(build: Path, source: Path, mpirun: str,
             words: Sequence[str]) -> Dict[str, object]:
    """Processor, memory, compiler, flags, MPI, LAMMPS, commit, date.

    :param build: build folder; its benchmarks.json was written when it was configured
    :param words: arguments of this run
    """
    return {
        "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        # the folder of the results does not belong into them
        "arguments": [Path(word).name if Path(word).is_absolute() else word for word in words],
        "processor": _from_file(Path("/proc/cpuinfo"), "model name") or platform.processor(),
        "cores": len(usable_cores()),
        "memory": _from_file(Path("/proc/meminfo"), "MemTotal"),
        "caches": _caches(),
        "system": f"{platform.system()} {platform.release()}",
        **{k: v for k, v in configured(build).items() if not k.endswith("_path")},
        "mpi": _first_line(mpirun, "--version"),
        "commit": _commit(source),
    }


def configured(build: Path) -> Dict[str, str]:
    """What CMake wrote down. :raise FileNotFoundError: if it did not"""
    path = build / "benchmarks.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise FileNotFoundError(f"no {path}: configure the build folder with benchmarks/") from None


def _from_file(path: Path, key: str) -> str:
    try:
        for line in path.read_text(encoding="utf-8").splitlines():
            name, _, value = line.partition(":")
            if name.strip() == key:
                return value.strip()
    except OSError:
        pass
    return ""


def _caches() -> str:
    parts = []
    for folder in sorted(Path("/sys/devices/system/cpu/cpu0/cache").glob("index*")):
        level, kind, size = (_word(folder / name) for name in ("level", "type", "size"))
        parts.append(f"L{level} {kind.lower()} {size}")
    return ", ".join(parts)


def _word(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8").strip()
    except OSError:
        return "?"


def _first_line(*words: str) -> str:
    """A part of a program's output; nothing where there is no such program."""
    try:
        said = subprocess.run(words, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    except OSError:
        return ""
    return said.stdout.partition("\n")[0].strip()


def _commit(source: Path) -> str:
    def git(*words: str) -> str:
        return subprocess.run(["git", "-C", str(source), *words], text=True, check=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout.strip()
    try:
        commit = git("rev-parse", "HEAD")
        changed = git("status", "--porcelain", "--untracked-files=no")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return commit + (" with changes" if changed else "")

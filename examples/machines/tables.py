# SPDX-License-Identifier: GPL-2.0-only
"""Reads what the in-files write: tables of `fix print` and snapshots of `dump custom`."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterator, List, Sequence, Tuple

import numpy as np


class BadTable(ValueError):
    """A file that does not hold what it should; the message names it."""


def read_table(path: Path) -> np.ndarray:
    """A file with a line of names and lines of numbers, comma-separated: an array with fields."""
    lines = [line for line in Path(path).read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("#")]
    if len(lines) < 2:
        raise BadTable(f"{path} has no lines of numbers")
    names = lines[0].split(",")
    try:
        rows = np.array([[float(word) for word in line.split(",")] for line in lines[1:]])
    except ValueError as error:
        raise BadTable(f"{path}: {error}") from None
    if rows.ndim != 2 or rows.shape[1] != len(names):
        raise BadTable(f"{path} has lines that are not of {len(names)} numbers")
    return np.rec.fromarrays(rows.T, names=names)


@dataclass(frozen=True)
class Snapshot:
    """Particles at one step; `columns` by name, as in the dump."""

    step: int
    box: np.ndarray
    columns: Dict[str, np.ndarray]

    def positions(self) -> np.ndarray:
        return np.stack([self.columns[name] for name in "xyz"], axis=1)


def read_dump(path: Path) -> Iterator[Snapshot]:
    """Snapshots of a text dump, one after the other. One that is cut off at its end is left out."""
    with Path(path).open(encoding="utf-8") as file:
        while True:
            head = [file.readline() for _ in range(9)]
            if not head[8]:
                return
            if not head[0].startswith("ITEM: TIMESTEP") or not head[8].startswith("ITEM: ATOMS"):
                raise BadTable(f"{path} is no text dump of LAMMPS: {head[0].strip()!r}")
            count = int(head[3])
            box = np.array([[float(word) for word in line.split()[:2]] for line in head[5:8]])
            names = head[8].split()[2:]
            lines = [file.readline() for _ in range(count)]
            if count and not lines[-1].endswith("\n"):
                return
            rows = (np.array([[float(word) for word in line.split()] for line in lines]) if count
                    else np.empty((0, len(names))))
            yield Snapshot(int(head[1]), box, dict(zip(names, rows.T)))


def mean_and_error(numbers: Sequence[float]) -> Tuple[float, float]:
    """Mean and its standard error, which a single number does not have (not a number)."""
    some = np.asarray(numbers, dtype=float)
    if len(some) < 2:
        return float(some.mean()), float("nan")
    return float(some.mean()), float(some.std(ddof=1) / np.sqrt(len(some)))


def with_error(numbers: Sequence[float], form: str = ".3g") -> str:
    """`mean ± error`, for tables; without an error where there is none."""
    mean, error = mean_and_error(numbers)
    if not np.isfinite(mean):
        return "-"
    return f"{mean:{form}}" + (f" ± {error:.1g}" if np.isfinite(error) else "")


def text_table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Columns aligned to the right, as wide as their widest word."""
    lines: List[Sequence[str]] = [head, *rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    return "\n".join("  ".join(word.rjust(width) for word, width in zip(line, widths)).rstrip()
                     for line in lines) + "\n"

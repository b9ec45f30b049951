# SPDX-License-Identifier: GPL-2.0-only
"""Thermodynamic output in LAMMPS's logs, by the stages that the in-files print."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Dict, List

import numpy as np

_STAGE = re.compile(r"^Stage (\w+)\s*$")


def stages(path: Path) -> Dict[str, np.ndarray]:
    """Of each stage its lines of numbers, with the names of their columns as fields (c_x[1] is c_x_1); those
    of a stage with several runs follow each other."""
    found: Dict[str, List[List[float]]] = {}
    names: List[str] = []
    stage, reading = "", False
    for line in Path(path).read_text(encoding="utf-8", errors="replace").splitlines():
        words = line.split()
        match = _STAGE.match(line)
        if match:
            stage, reading = match.group(1), False
        elif words[:1] == ["Step"]:
            names, reading = [_field(word) for word in words], True
        elif line.startswith("Loop time of"):
            reading = False
        elif reading and len(words) == len(names):
            try:
                row = [float(word) for word in words]
            except ValueError:
                continue  # a warning in between that has as many words
            if stage:
                found.setdefault(stage, []).append(row)
    return {name: np.rec.fromarrays(np.array(rows).T, names=names) for name, rows in found.items()}


def _field(word: str) -> str:
    return re.sub(r"\W+", "_", word).strip("_")

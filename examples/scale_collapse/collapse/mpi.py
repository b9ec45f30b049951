# SPDX-License-Identifier: GPL-2.0-only
"""Settings of MPI for the start of several ranks."""
from __future__ import annotations

from pathlib import Path
from typing import Dict

SETTINGS = Path(__file__).resolve().parents[3] / "scripts" / "mpi.env"


def settings() -> Dict[str, str]:
    """The variables of scripts/mpi.env, which has the reasons; the tests read the same file."""
    lines = SETTINGS.read_text(encoding="utf-8").splitlines()
    return dict(line.split("=", 1) for line in lines if line and not line.startswith("#"))

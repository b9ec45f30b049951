# SPDX-License-Identifier: GPL-2.0-only
"""What MPI has to be told before several ranks start, wherever they start."""
from __future__ import annotations

from pathlib import Path
from typing import Dict

SETTINGS = Path(__file__).resolve().parents[3] / "scripts" / "mpi.env"


def settings() -> Dict[str, str]:
    """The variables of scripts/mpi.env, which also says why; the tests read the same file."""
    lines = SETTINGS.read_text(encoding="utf-8").splitlines()
    return dict(line.split("=", 1) for line in lines if line and not line.startswith("#"))

# SPDX-License-Identifier: GPL-2.0-only
"""Runs of the sub-models of pair_style granular and of pair_style gran/eepa, whose forces are compared."""

import os
import re
import subprocess
import tempfile
from pathlib import Path

import numpy as np

LMP = os.environ.get("EEPA_LMP", "")
MPIEXEC = os.environ.get("EEPA_MPIEXEC", "mpirun")
IN_LAMMPS = os.environ.get("EEPA_STYLES") == "in_lammps"

LAWS = {    # sub-model, its numbers, law and numbers of gran/eepa
    "eepa": ("eepa 1e4 3e4 1e4 -5", "linear", "1e4 3e4 1e4 -5 0"),
    "luding": ("luding 1e4 3e4 1e4 -5 0.03", "luding", "1e4 3e4 1e4 -5 0 depth 0.03"),
}
NO_FRICTION = "tangential linear_nohistory 0 0"


def run(script, ranks=1, files={}):
    with tempfile.TemporaryDirectory() as folder:
        command = [MPIEXEC, "-np", str(ranks)] if ranks > 1 else []
        for name, text in {"in.test": script, **files}.items():
            Path(folder, name).write_text(text)
        return subprocess.run([*command, LMP, "-in", "in.test", "-log", "none"], cwd=folder, text=True,
                              capture_output=True, timeout=300)


def forces(script, ranks=1, files={}):
    """Rows of the thermodynamic output: the step and three forces."""
    done = run(script, ranks, files)
    if done.returncode:
        raise AssertionError(done.stdout[-1500:] + done.stderr)
    rows = re.findall(r"^ *\d+(?: +-?[\d.]\S*| +-?nan| +-?inf){3} *$", done.stdout, re.M)
    return np.array([row.split() for row in rows], float)

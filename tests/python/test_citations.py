# SPDX-License-Identifier: GPL-2.0-only
"""The papers that LAMMPS asks a user to cite are those of the law and the models in use."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

THAKUR_LAW = "doi:10.1007/s10035-014-0506-4"
SCALING = "doi:10.1016/j.powtec.2015.05.051"
LUDING = "doi:10.1007/s10035-008-0099-x"
SINGH = "arXiv:1503.03720"
ROLLING = "doi:10.1016/j.powtec.2010.09.030"
TWISTING = "doi:10.1016/j.jcp.2008.11.006"
ALL = {THAKUR_LAW, SCALING, LUDING, SINGH, ROLLING, TWISTING}

BOX = """units si
atom_style sphere
comm_modify vel yes
boundary f f f
region box block 0 0.01 0 0.01 0 0.01
create_box 1 box
create_atoms 1 single 0.005 0.005 0.002
create_atoms 1 single 0.005 0.005 0.003
set group all diameter 0.001 density 2000
neighbor 1e-4 bin
timestep 1e-6
"""
COEFF = "1e3 2e3 1e3 -1e-5 0.5"


def run(folder, lines):
    """Runs the lines in the folder. Returns the text of the log file."""
    (Path(folder) / "in.test").write_text(lines + "\nrun 0\n")
    done = subprocess.run([os.environ["EEPA_LMP"], "-in", "in.test", "-screen", "none"], cwd=folder,
                          stderr=subprocess.PIPE, text=True)
    log = (Path(folder) / "log.lammps").read_text()
    if done.returncode:
        raise AssertionError(log[-500:] + done.stderr)
    return log


def papers_in(log):
    """The papers in the log file of a run, which must stand before the run's first output."""
    before_the_run, _, later = log.partition("Step ")
    if any(paper in later for paper in ALL):
        raise AssertionError("a paper is cited only after the run")
    return {paper for paper in ALL if paper in before_the_run}


def papers_of(lines):
    with tempfile.TemporaryDirectory() as folder:
        return papers_in(run(folder, BOX + lines))


class Papers(unittest.TestCase):
    def of_pair(self, style, more=""):
        return papers_of(f"pair_style gran/eepa {style}\npair_coeff * * {COEFF} {more}")

    def test_law(self):
        self.assertEqual(self.of_pair("linear"), {THAKUR_LAW})
        self.assertEqual(self.of_pair("plateau"), {THAKUR_LAW})
        self.assertEqual(self.of_pair("luding", "depth 0.05"), {LUDING, SINGH})

    def test_scale(self):
        self.assertEqual(self.of_pair("linear scale 1e-3"), {THAKUR_LAW, SCALING})

    def test_rolling_and_twisting(self):
        self.assertEqual(self.of_pair("linear", "rolling constant 0.1"), {THAKUR_LAW, ROLLING})
        self.assertEqual(self.of_pair("linear", "rolling sds 1e2 0 0.1 twisting marshall"),
                         {THAKUR_LAW, LUDING, TWISTING})

    def test_a_wall_alone(self):
        wall = f"fix w all wall/gran/eepa luding scale 1e-3 coeff {COEFF} depth 0.05 wall zplane 0 NULL"
        self.assertEqual(papers_of(f"pair_style none\n{wall}"), {LUDING, SINGH, SCALING})

    def test_after_a_restart(self):
        with tempfile.TemporaryDirectory() as folder:
            run(folder, f"{BOX}pair_style gran/eepa linear scale 1e-3\npair_coeff * * {COEFF}\n"
                        "run 0\nwrite_restart r")
            log = run(folder, "read_restart r\ncomm_modify vel yes")
        self.assertEqual(papers_in(log), {THAKUR_LAW, SCALING})


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-only
"""The formulas that examples/contact_cycle draws behind LAMMPS's points, and, where the
environment names a LAMMPS (EEPA_LMP), the example itself."""
from __future__ import annotations

import contextlib
import importlib.util
import io
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "contact_cycle"
SPEC = importlib.util.spec_from_file_location("contact_cycle_plot", EXAMPLE / "plot.py")
plot = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(plot)
LMP = os.environ.get("EEPA_LMP")


def path(*turns, points=4001):
    legs = [np.linspace(a, b, points)[1:] for a, b in zip((0.0,) + turns, turns)]
    return plot.UNIT * np.concatenate(legs)


class Formulas(unittest.TestCase):
    def test_numbers_are_those_of_the_in_file(self):
        given = {}
        for line in (EXAMPLE / "in.contact_cycle").read_text(encoding="utf-8").splitlines():
            if line.startswith("variable") and " index " in line:
                words = line.split("#")[0].split()
                given[words[1]] = words[3:]
        for name, value in (("k1", plot.K1), ("k2", plot.K2), ("kadh", plot.K_ADH),
                            ("f0", plot.F0), ("unit", plot.UNIT)):
            self.assertEqual([float(w) for w in given[name]], [value], name)
        self.assertEqual([float(w) for w in given["target"]][:-1], list(plot.TARGETS[1:-1]))

    def test_linear_is_continuous_while_in_contact(self):
        overlaps = path(1.0, 0.2, 1.4, 0.05)
        forces, branches = plot.follow(plot.linear, overlaps)
        largest = (plot.K1 + plot.K2) * np.max(np.abs(np.diff(overlaps)))
        self.assertLess(np.max(np.abs(np.diff(forces))), largest)
        self.assertEqual(set(branches), {1, 2, 3})

    def test_plateau_steps_by_f0_where_it_begins(self):
        overlaps = path(1.0, 0.05, points=200001)
        forces, branches = plot.follow(plot.plateau, overlaps)
        begin = np.flatnonzero(branches == plot.ADHESIVE)[0]
        self.assertAlmostEqual(forces[begin] - forces[begin - 1], -plot.F0, places=5)
        self.assertEqual(np.ptp(forces[begin:]), 0.0)

    def test_history_ends_with_the_contact(self):
        forces, branches = plot.follow(plot.linear, [1e-5, -1e-6, 5e-6])
        self.assertEqual(list(branches), [1, 0, 1])
        self.assertEqual(forces[2], plot.F0 + plot.K1 * 5e-6)


class Example(unittest.TestCase):
    @unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
    def test_lammps_follows_the_formulas(self):
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as out, contextlib.redirect_stdout(said):
            self.assertEqual(plot.main(["--lmp", LMP, "--out", out]), 0)
            self.assertTrue((Path(out) / "contact_cycle.png").is_file())
            for law in plot.LAWS:
                samples = np.genfromtxt(Path(out) / f"cycle_{law}.csv", delimiter=",", names=True)
                # LAMMPS names the branches as the formulas do, but for points on a corner.
                _, branches = plot.follow(plot.FORMULAS[law], samples["overlap"])
                self.assertGreater(np.mean(branches == samples["branch"]), 0.99)
        self.assertIn("law plateau", said.getvalue())

    def test_no_lammps_is_named(self):
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as out, contextlib.redirect_stderr(said):
            self.assertEqual(plot.main(["--lmp", "/no/such/lmp", "--out", out]), 1)
        self.assertIn("/no/such/lmp", said.getvalue())


if __name__ == "__main__":
    unittest.main()

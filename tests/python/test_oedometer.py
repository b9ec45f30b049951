# SPDX-License-Identifier: GPL-2.0-only
"""in.oedometer and what the specimens of in.confined may be, with a LAMMPS that the environment names
(EEPA_LMP), so coarse that they take seconds."""
from __future__ import annotations

import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

STUDY = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path.insert(0, str(STUDY.parents[1] / "coarsen"))

from coarsen import measure  # noqa: E402

LMP = os.environ.get("EEPA_LMP")


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name)

    def lammps(self, *variables, infile="in.oedometer"):
        words = [LMP, "-in", infile, "-log", "none", "-var", "out", str(self.out)]
        for name, value in zip(variables[::2], variables[1::2]):
            words += ["-var", name, value]
        return subprocess.run(words, cwd=STUDY, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)

    def test_platens_are_in_balance(self):
        done = self.lammps("d", "2.5e-3", "law", "plateau")
        self.assertEqual(done.returncode, 0, done.stdout)
        samples = measure.read_curve(self.out / "curve.csv")
        load = measure.loading(samples, 5.0e3)
        self.assertGreater(load["stress"].iloc[-1], 9.5e4)
        self.assertLess(measure.unloading_of(samples, load)["stress"].iloc[-1], 5.0e3)
        late = samples[samples["stress_top"] > 1.0e4]
        self.assertLess((late["stress_top"] / late["stress_bottom"] - 1.0).abs().max(), 0.05)

    def test_scaled_and_unscaled_start_from_the_same_packing(self):
        packed = set()
        for scaled in ("yes", "no"):
            done = self.lammps("d", "3e-3", "scaled", scaled, "pmax", "2e4")
            self.assertEqual(done.returncode, 0, done.stdout)
            packed.update(line for line in done.stdout.splitlines() if line.startswith("Packed:"))
        self.assertEqual(len(packed), 1, packed)

    def test_bad_variables_stop_with_a_message(self):
        for variables, text in (
                (("scaled", "maybe"), "ERROR: variable scaled is maybe, allowed are yes and no"),
                (("law", "hertz"), "hertz"),
                (("d", "3e-3", "fraction", "0.2"), "ERROR: packed by 30%")):
            with self.subTest(variables=variables):
                done = self.lammps(*variables)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(text, done.stdout)

    SMALL = ("d", "3e-3", "side", "15e-3", "nref", "4050")

    def test_a_loose_start_is_loose_and_keeps_its_contacts(self):
        done = self.lammps(*self.SMALL, "start", "loose", "k1", "5e2", "kadh", "5e2", "f0", "-2e-4", "mur", "0.05",
                           "ppack", "500", "ramping", "log", "rate", "1", "level", "4e3", "fall", "0.2",
                           infile="in.confined")
        self.assertEqual(done.returncode, 0, done.stdout)
        rained = re.search(r"^Rained: bed (\S+), porosity of its middle (\S+), coordination (\S+),", done.stdout,
                           re.MULTILINE)
        self.assertGreater(float(rained.group(2)), 0.45)
        self.assertLess(float(rained.group(2)), 0.65)
        samples = measure.read_curve(self.out / "curve.csv")
        # Contacts that began anew would have no plastic overlap, and a dense start ends below 0.4.
        self.assertGreater(samples["plastic_overlap"].iloc[0], 0.0)
        self.assertGreater(samples["porosity"].iloc[0], 0.45)
        self.assertGreater(samples["stress"].max(), 3.6e3)
        # A platen that came down with the speed of its approach would leave overlaps of several percent.
        self.assertLess(samples["mean_overlap"].iloc[0], 0.005)

    def test_gravity_of_a_loose_start_is_over_s_or_true(self):
        for weight, gravity in (("scaled", 9.81 / 3.0), ("true", 9.81)):
            done = self.lammps(*self.SMALL, "start", "loose", "weight", weight, "ppack", "500", "level", "6e2",
                               "fall", "0.5", "rate", "5", infile="in.confined")
            self.assertEqual(done.returncode, 0, done.stdout)
            said = re.search(r"^Rain under gravity (\S+) at", done.stdout, re.MULTILINE)
            self.assertAlmostEqual(float(said.group(1)), gravity, places=6)

    def test_a_distribution_of_sizes_keeps_the_mean_volume(self):
        done = self.lammps(*self.SMALL, "spread", "0.3", "level", "5e3", "rate", "5", infile="in.confined")
        self.assertEqual(done.returncode, 0, done.stdout)
        said = re.search(r"^Sizes: from (\S+) to (\S+) d, mean volume (\S+) of", done.stdout, re.MULTILINE)
        self.assertAlmostEqual(float(said.group(3)), 1.0, places=9)
        # Two standard deviations down and up, which some of 150 are at; the mean volume of so few scatters.
        self.assertAlmostEqual(float(said.group(2)) / float(said.group(1)), math.exp(4 * 0.3), delta=2e-3)
        self.assertAlmostEqual(float(said.group(1)), math.exp(-0.6 - 1.5 * 0.3**2), delta=0.05)

    def test_bad_words_of_a_start_are_named(self):
        for variables, text in ((("start", "rained"), "variable start is rained, allowed are dense and loose"),
                                (("ramping", "exp"), "variable ramping is exp, allowed are linear and log"),
                                (("start", "loose", "weight", "none"), "variable weight is none, allowed are scaled"),
                                (("start", "loose", "spread", "0.3"), "variable spread is 0.3, allowed is 0")):
            with self.subTest(text):
                done = self.lammps(*variables, infile="in.confined")
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(text, done.stdout)


if __name__ == "__main__":
    unittest.main()

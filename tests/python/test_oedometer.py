# SPDX-License-Identifier: GPL-2.0-only
"""examples/scale_collapse from end to end with a LAMMPS that the environment names (EEPA_LMP), on
specimens so coarse that they take seconds."""
from __future__ import annotations

import contextlib
import csv
import io
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

STUDY = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path.insert(0, str(STUDY))

import run_study  # noqa: E402
from collapse import curves  # noqa: E402

LMP = os.environ.get("EEPA_LMP")


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name)

    def study(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            code = run_study.main([*words, "--lmp", LMP, "--out", str(self.out), "--jobs", "2"])
        self.assertEqual(code, 0)
        return said.getvalue()

    def lammps(self, *variables):
        words = [LMP, "-in", "in.oedometer", "-log", "none", "-var", "out", str(self.out)]
        for name, value in zip(variables[::2], variables[1::2]):
            words += ["-var", name, value]
        return subprocess.run(words, cwd=STUDY, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)

    def test_study_and_its_resuming(self):
        words = ("--diameters", "2.5e-3", "3e-3", "--seeds", "2", "1", "--law", "plateau",
                 "--scaled", "--dref", "1e-3")
        self.assertIn("3 runs with", self.study(*words))
        with (self.out / "table.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["diameter_mm"] for row in rows], ["2.5", "3"])
        self.assertEqual([row["particles"] for row in rows], ["320", "185"])
        self.assertGreater(float(rows[1]["speed_up"]), 1.0)
        markers = [path.stat().st_mtime_ns for path in sorted(self.out.glob("runs/*/done.json"))]
        self.assertEqual(len(markers), 3)
        self.assertIn("[3 of 3 runs done] by an earlier call", self.study(*words))
        self.assertEqual(markers, [path.stat().st_mtime_ns
                                   for path in sorted(self.out.glob("runs/*/done.json"))])
        one = curves.load_curve(next(self.out.glob("runs/d2.5mm*seed1/curve.csv")), 5.0e3)
        self.assertGreater(one.loading.stress[-1], 9.5e4)
        self.assertLess(one.unloading.stress[-1], 5.0e3)
        # Platens are in balance in a quasi-static test.
        table = curves.read_samples(next(self.out.glob("runs/d2.5mm*seed1/curve.csv")))
        late = table[table["stress_top"] > 1.0e4]
        self.assertLess(abs(late["stress_top"] / late["stress_bottom"] - 1.0).max(), 0.05)

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


if __name__ == "__main__":
    unittest.main()

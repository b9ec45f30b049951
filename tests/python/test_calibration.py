# SPDX-License-Identifier: GPL-2.0-only
"""The calibration of examples/scale_collapse against models with known parameters. LAMMPS is not
needed."""
from __future__ import annotations

import contextlib
import io
import math
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

STUDY = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path.insert(0, str(STUDY))

import calibrate  # noqa: E402
from collapse import calibration, curves  # noqa: E402
from collapse.specimens import Material  # noqa: E402

START = Material("start")
PRELOAD = 5.0e3


def curve(k1, softening=0.0, offset=0.0):
    """Stress rises by 800 k1 a strain; porosity falls by strain."""
    strain = np.linspace(0.0, 9.1e4 / (800.0 * k1), 100)
    stress = PRELOAD + 800.0 * k1 * strain * (1.0 - softening)
    branch = curves.Branch({"bulk": strain, "platen": strain}, stress, 0.36 + offset - 0.6 * strain,
                           0.37 - strain, 5.0 + strain)
    return curves.Curve(branch, branch, 0.37, 0.36 + offset, 5.0, float(strain[-1]))


def target(k1, strength=None):
    loading = curve(k1).loading
    return calibration.target_from(loading.strain["bulk"] + 0.01, loading.stress, loading.stress,
                                   loading.bulk_porosity, PRELOAD, strength)


def strength_of(material):
    return 3.0 * material.kadh**0.8 * material.k1**0.1


class Model:
    """Stands for LAMMPS; a packing is a little softer or stiffer than the next."""

    def __init__(self, wanted, scatter=()):
        self.wanted, self.scatter, self.calls = wanted, scatter or (0.0,), 0

    def __call__(self, materials):
        self.calls += 1
        return [[calibration.residual(self.wanted, curve(m.k1 * (1.0 + shift), offset=0.002),
                                      strength_of(m) * (1.0 + shift)) for shift in self.scatter]
                for m in materials]


class Fit(unittest.TestCase):
    def test_known_parameters_are_recovered(self):
        truth = Material("truth", k1=7.0e3, kadh=6.5e3)
        model = Model(target(truth.k1, strength_of(truth)))
        found = calibration.fit(START, ["k1", "kadh"], model)
        self.assertAlmostEqual(found.material.k1 / truth.k1, 1.0, delta=0.01)
        self.assertAlmostEqual(found.material.kadh / truth.kadh, 1.0, delta=0.01)
        self.assertEqual(found.material.k2, 2.0 * found.material.k1)
        self.assertEqual((found.material.f0, found.material.mu), (START.f0, START.mu))
        self.assertAlmostEqual(found.porosity_offset, 0.002, delta=2e-4)

    def test_error_is_the_scatter_of_the_packings(self):
        scatter = (-0.04, 0.01, 0.03)
        found = calibration.fit(START, ["k1"], Model(target(7.0e3), scatter))
        self.assertAlmostEqual(found.errors["k1"],
                               np.std(scatter, ddof=1) / math.sqrt(3.0), delta=0.003)
        self.assertTrue(math.isnan(calibration.fit(START, ["k1"], Model(target(7.0e3)))
                                   .errors["k1"]))

    def test_error_has_those_of_the_target(self):
        # Strain goes as 1/k1, strength as kadh^0.8 k1^0.1: so do their errors.
        wanted = target(7.0e3, strength_of(Material("truth", k1=7.0e3)))
        exact = calibration.fit(START, ["k1", "kadh"], Model(wanted, (0.0, 0.0)))
        self.assertAlmostEqual(exact.errors["k1"], 0.0, delta=1e-6)
        rough = replace(wanted, strain_error=0.03 * wanted.strain,
                        strength_error=0.04 * wanted.strength)
        found = calibration.fit(START, ["k1", "kadh"], Model(rough, (0.0, 0.0)))
        # porosity depends on strain, so that it does not reduce the error
        self.assertAlmostEqual(found.errors["k1"], 0.03, delta=0.003)
        self.assertAlmostEqual(found.errors["kadh"], 0.05, delta=0.004)

    def test_parameter_that_the_target_does_not_know_has_no_error(self):
        found = calibration.fit(START, ["k1", "mu"], Model(target(6.0e3), (-0.01, 0.01)))
        self.assertTrue(math.isnan(found.errors["mu"]))

    def test_a_batch_has_a_point_and_its_differences(self):
        model, seen = Model(target(6.0e3, 3.0e3)), []
        calibration.fit(START, ["k1", "kadh"], lambda some: seen.append(len(some)) or model(some))
        self.assertEqual(set(seen), {3})

    def test_every_point_is_noted_and_none_is_run_twice(self):
        noted, run = [], []
        model = Model(target(6.0e3))

        def simulate(materials):
            run.extend(m.label for m in materials)
            return model(materials)
        found = calibration.fit(START, ["k1"], simulate, note=noted.append)
        self.assertEqual(len(run), len(set(run)))
        self.assertEqual(len(noted), len(run))
        self.assertEqual(found.evaluations, len(run))

    def test_bad_choices_are_named(self):
        with self.assertRaisesRegex(ValueError, "free parameter k3"):
            calibration.fit(START, ["k3"], Model(target(6.0e3)))
        with self.assertRaisesRegex(ValueError, "kadh starts at 0"):
            calibration.fit(Material("a", kadh=0.0), ["kadh"], Model(target(6.0e3)))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_target_counts_strain_from_the_preload(self):
        wanted = target(6.0e3)
        self.assertEqual(wanted.strain[0], 0.0)
        # The strain of 1% before is taken off, and lengths are those at the preload.
        self.assertAlmostEqual(wanted.strain[-1], 9.1e4 / (800.0 * 6.0e3) / 0.99)
        with self.assertRaisesRegex(ValueError, "must begin at the preload"):
            calibration.target_from(np.arange(3.0), np.array([6e3, 7e3, 8e3]), np.arange(3.0),
                                    np.arange(3.0), PRELOAD, None)

    def test_columns_are_read_by_name_in_rising_order(self):
        path = self.folder / "a.csv"
        path.write_text("strain,other,stress\n0.02,1,2\n0.01,1,1\n0.03,1,\n", encoding="utf-8")
        strain, stress = calibration.read_curve(path, "strain", "stress")
        self.assertEqual((list(strain), list(stress)), ([0.01, 0.02], [1.0, 2.0]))
        with self.assertRaisesRegex(ValueError, "no column porosity"):
            calibration.read_curve(path, "stress", "porosity")

    def test_errors_are_read_where_there_are_any(self):
        path = self.folder / "a.csv"
        path.write_text("stress,strain,strain_error\n2,0.02,0.004\n1,0.01,0.002\n",
                        encoding="utf-8")
        self.assertEqual(list(calibration.read_error(path, "stress", "strain")), [0.002, 0.004])
        path.write_text("stress,strain,strain_error\n2,0.02,\n1,0.01,\n", encoding="utf-8")
        self.assertIsNone(calibration.read_error(path, "stress", "strain"))

    def test_include_file_is_what_in_confined_reads(self):
        found = calibration.fit(START, ["k1"], Model(target(7.0e3), (-0.01, 0.02)))
        text = calibration.include_file(found, 1.0e-3, "a test")
        names = [line.split()[1] for line in text.splitlines() if line.startswith("variable")]
        self.assertEqual(names, ["k1", "k2", "kadh", "f0", "mu", "dref", "law"])
        known = (STUDY / "in.confined").read_text(encoding="utf-8")
        for name in names:
            self.assertRegex(known, rf"(?m)^variable {name}\s+index ")
        self.assertRegex(text, r"k1 .*# found, \+- \d")
        self.assertRegex(text, r"mu .*# given")

    def test_tensile_strength_in_one_call(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(calibrate.main(["tensile", "--strength", "150"]), 0)
        self.assertIn("index -0.0001 ", said.getvalue())

    def test_bad_arguments_are_named(self):
        common = ["fit", "--diameter", "3e-3", "--stress-strain", str(self.folder / "none.csv"),
                  "--porosity-stress", "b.csv"]
        for words, text in ((["--seeds", "0"], "--seeds is 0"),
                            (["--strength", "1e4", "--unconfined", "c.csv"], "name one of them"),
                            (["--strength-error", "-1"], "--strength-error is -1"),
                            (["--strength-error", "9"], "--strength-error needs --strength"),
                            (["--free", "f0", "--tensile", "100"], "it can not be free")):
            said = io.StringIO()
            with contextlib.redirect_stderr(said), self.assertRaises(SystemExit):
                calibrate.parse_arguments([*common, *words])
            self.assertIn(text, said.getvalue())
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(calibrate.main([*common, "--lmp", "/bin/true"]), 1)
        self.assertIn("none.csv", said.getvalue())


if __name__ == "__main__":
    unittest.main()

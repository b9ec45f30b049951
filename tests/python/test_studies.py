# SPDX-License-Identifier: GPL-2.0-only
"""The analysis of the studies in examples/scale_collapse on made-up tables with known answers, and, with a
LAMMPS that the environment names (EEPA_LMP), every kind of run of both studies on tiny specimens."""
import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

ROOT = Path(__file__).resolve().parents[2]
STUDY = ROOT / "examples" / "scale_collapse"
sys.path[:0] = [str(STUDY), str(ROOT / "coarsen")]

import run_study  # noqa: E402
from analysis import claims, fits, summary, tables  # noqa: E402
from coarsen.study import read_study  # noqa: E402

LMP = os.environ.get("EEPA_LMP")
LEVEL = "96e3"


def specimen(group, d, seed, side=30e-3, rate=0.5, scaled="yes", stiffness=1.0, adhesion=1.0, off=0.0, packing=0.0):
    """A row and a curve: strain goes with 1/stiffness, strength with adhesion, both with `off` and `packing`."""
    factor = (1.0 + off) * (1.0 + packing)
    row = {"run": f"{group}/d={d},side={side},seed={seed}", "group": group, "d": d, "seed": float(seed), "side": side,
           "rate": rate, "scaled": scaled, "law": "linear", "dref": 1e-3, "k1": 5e3, "k2": 1e4, "kadh": 5e3, "f0": 0.0,
           "particles": round(32400 * (side / 30e-3)**3 * (1e-3 / d)**3), "strain": 0.02 / stiffness * factor,
           "porosity_before": 0.36, "porosity": 0.35, "coordination": 6.0 * factor, "bulk_coordination": 6.0,
           "bulk_modulus": 4e6, "inertial_number": 0.5 * d, "test_seconds": 1e-10 * d**-4, "seconds": 1.2e-10 * d**-4,
           f"strength_{LEVEL}": 1.5e4 * adhesion * factor, "strength_16e3": 3e3 * adhesion * factor,
           **{f"{name}_{level}": value for level in (LEVEL, "16e3") for name, value in (
               ("plastic_overlap", 1e-6 * d / 1e-3), ("coordination_unloaded", 5.5), ("porosity_unloaded", 0.36))}}
    strain = np.linspace(0.0, 0.022, 100)
    curve = pd.concat([pd.DataFrame({
        "run": row["run"], "branch": branch, "strain": strain, "stress": 5e3 + 4.5e6 * stiffness / factor * strain,
        "porosity": 0.36 - strain, "coordination": 6.0 + strain, "bulk_coordination": 6.0 + strain})
        for branch in ("load", "unload", f"crush_{LEVEL}", "crush_16e3")])
    return row, curve


def study(specimens):
    rows, curves = zip(*specimens)
    return tables.with_kinds(pd.DataFrame(rows).set_index("run")), pd.concat(curves, ignore_index=True)


def packing(seed):
    return 0.02 * (seed - 2)


#: Coarse ones 4% weaker than the finest; 3 mm in 30 mm are as many diameters wide as 1 mm in 10 mm.
BASE = [specimen("base", d, s, off=0.0 if d == 1e-3 else -0.04, packing=packing(s)) for d in (1e-3, 2e-3, 3e-3)
        for s in (1, 2, 3)]
UNSCALED = [specimen("base-unscaled", 2e-3, s, scaled="no", stiffness=0.5, packing=packing(s)) for s in (1, 2, 3)]
NARROW = [specimen("base-narrow", 1e-3, s, side=10e-3, off=-0.04, packing=packing(s)) for s in (1, 2, 3)]
SLOW = [specimen("base-slow", 2e-3, s, rate=0.25, off=-0.03, packing=packing(s)) for s in (1, 2)]
WIDE = [specimen("base-wide", 2e-3, s, side=60e-3, packing=packing(s)) for s in (1, 2, 3)]


def varied(word, factor, **more):
    return [specimen(f"base-{word}{factor:g}", d, s, off=-0.04, packing=packing(s), **more) for d in (2e-3, 3e-3)
            for s in (1, 2, 3)]


class Tables(unittest.TestCase):
    def setUp(self):
        self.runs, self.curves = study([*BASE, *UNSCALED, *NARROW, *SLOW, *WIDE])
        self.table = tables.with_curve_deviations(tables.means(self.runs), self.runs, self.curves)

    def row(self, d, mode="scaled", special=""):
        return self.table[np.isclose(self.table["d"], d) & (self.table["mode"] == mode)
                          & (self.table["special"] == special)].iloc[0]

    def test_kinds_and_their_means(self):
        self.assertEqual(len(self.table), 7)
        self.assertEqual(sorted(self.table["special"].unique()), ["", "0.25/s", "10 mm wide", "60 mm wide"])
        row = self.row(2e-3)
        self.assertEqual(row["seeds"], 3)
        self.assertAlmostEqual(row["strain"], 0.02 * 0.96)
        self.assertAlmostEqual(row["strain_error"], 0.02 * 0.96 * 0.02 / np.sqrt(3))
        self.assertTrue((self.table["reference"] == 1e-3).all())

    def test_deviation_is_from_the_finest(self):
        off = tables.deviation_percent(self.table, "strain")
        self.assertAlmostEqual(off.loc[self.row(2e-3).name, "value"], -4.0)
        self.assertAlmostEqual(off.loc[self.row(2e-3).name, "error"],
                               100 * np.hypot(0.96 * 0.02 / np.sqrt(3), 0.96 * 0.02 / np.sqrt(3)))
        self.assertTrue(np.isnan(off.loc[self.row(1e-3).name, "value"]))

    def test_deviation_of_a_curve(self):
        # stress of the coarse is 5e3 + 4.5e6/0.96 strain: apart by 4.5e6 (1/0.96 - 1) strain, RMS over 0 to e is e/sqrt(3)
        row, reach = self.row(2e-3), 0.022
        mean = np.mean([1.0 / (1.0 + packing(s)) for s in (1, 2, 3)])
        peak = 5e3 + 4.5e6 * mean * reach
        self.assertAlmostEqual(row["curve"], 100 * 4.5e6 * mean * (1 / 0.96 - 1) * reach / np.sqrt(3) / peak, delta=0.01)
        self.assertGreater(row["curve_error"], 0.5)
        self.assertTrue(np.isnan(self.row(1e-3)["curve"]))
        self.assertGreater(self.row(2e-3, "unscaled")["curve"], 25.0)

    def test_another_rate_is_compared_with_the_same_packings(self):
        # without the scatter of the packings, which is in both
        self.assertLess(self.row(2e-3, special="0.25/s")["curve_error"], 0.05)
        self.assertGreater(self.row(2e-3)["curve_error"], 0.5)

    def test_curves_come_in_the_order_of_the_names(self):
        # Names sort otherwise than seeds: the first one is in a group of its own.
        runs, curves = study([specimen("base-z", 1e-3, 1, packing=0.1), specimen("base", 1e-3, 2), specimen("base", 1e-3, 3)])
        names = tables.names_of(runs, material="base")
        rows = tables.curve_matrix(curves, names, "load", np.array([0.02]))
        self.assertLess(rows[0, 0], rows[1, 0])

    def test_twins_are_compared_seed_by_seed(self):
        found = tables.twins(self.runs, self.curves, [f"strength_{LEVEL}"])
        one = found[np.isclose(found["coarse"], 3e-3)].iloc[0]
        self.assertEqual((one["fine"], one["seeds"]), (1e-3, 3))
        self.assertAlmostEqual(one[f"strength_{LEVEL}"], 0.0)
        self.assertAlmostEqual(one[f"strength_{LEVEL}_error"], 0.0)
        wide = found[np.isclose(found["coarse"], 2e-3)].iloc[0]
        self.assertEqual(wide["fine"], 1e-3)
        self.assertAlmostEqual(wide[f"strength_{LEVEL}"], 0.0)

    def test_claims_say_what_is_met(self):
        found = claims.claims(self.table, ["16e3", LEVEL]).set_index("claim")
        self.assertEqual(found.loc["scaled, 2x: strength after 96 kPa", "met"], "yes")  # 4% of 5
        self.assertEqual(found.loc["scaled, 2x: coordination number", "met"], "NO")  # 4% of 2
        self.assertEqual(found.loc["scaled, 2x, 60 mm wide: strength after 96 kPa", "measured"], "0.00 ± 1.63%")
        self.assertEqual(found.loc["scaled, 3x: speed-up of the confined test", "measured"], "81.0")
        self.assertEqual(found.loc["unscaled, 2x: stress-strain curve, RMS", "met"], "yes")
        self.assertIn("NO", set(found["met"][[c for c in found.index if c.startswith("largest")]]))


class Fits(unittest.TestCase):
    def exponent(self, word, quantity, equal_width, **of_factor):
        rows = [*BASE, *NARROW]
        for factor in fits.FACTORS:
            rows += varied(word, factor, **{name: factor for name in of_factor})
        runs, _ = study(rows)
        return fits.exponent(runs, fits.Free(word, "base", word, 1.0, quantity), equal_width)

    def test_stiffness_that_makes_up_for_four_percent_of_strain(self):
        found = self.exponent("stiffness", "strain", False, stiffness=1)
        self.assertEqual(found.diameters, [2e-3, 3e-3])
        # strain is 0.96 of the finest one's: a stiffness of 0.96 on top of the law mends that at each diameter
        np.testing.assert_allclose(np.exp(found.logs), [2 * 0.96, 3 * 0.96], rtol=2e-3)
        x = np.log([2.0, 3.0])
        self.assertAlmostEqual(found.value, float(x @ found.logs / (x @ x)), delta=0.01)
        self.assertFalse(found.extrapolated)

    def test_at_equal_width_nothing_is_left(self):
        found = self.exponent("kadh", f"strength_{LEVEL}", True, adhesion=1)
        self.assertEqual(found.diameters, [3e-3])  # 1 mm in 10 mm
        self.assertAlmostEqual(found.value, 1.0, places=6)

    def test_strength_over_attraction(self):
        runs, _ = study(BASE)
        points = fits.strength_points(runs, [LEVEL])
        # plastic overlap goes with d, so that attraction goes with d^2: the points of all diameters agree
        fine = points[np.isclose(points["d"], 1e-3)].iloc[0]
        attraction = 5e3 * 1e4 / 1.5e4 * 1e-6
        self.assertAlmostEqual(fine["strength"], 1.5e4 * 1e-6 / attraction)
        self.assertAlmostEqual(fine["packing"], 5.5 * 0.64)
        self.assertAlmostEqual(points["strength"].iloc[-1] / fine["strength"], 0.96)
        constant, scatter = fits.proportion(points.assign(strength=2.0 * points["packing"]))
        self.assertAlmostEqual(constant, 2.0)
        self.assertAlmostEqual(scatter, 0.0)

    def test_flow_function_and_speed(self):
        runs, curves = study([*BASE, *UNSCALED])
        slopes = fits.flow_slopes(runs, ["16e3", LEVEL])
        self.assertAlmostEqual(slopes["slope"].iloc[0], (1.5e4 - 3e3) / 80e3)
        speed, error = fits.speed_exponent(tables.means(runs), "scaled")
        self.assertAlmostEqual(speed, 4.0)
        self.assertAlmostEqual(error, 0.0, places=6)


def call(*words):
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        status = run_study.main([str(word) for word in words])
    return status, out.getvalue()


class Command(unittest.TestCase):
    def test_every_study_file_can_be_read(self):
        for path in STUDY.glob("*.yaml"):
            table = read_study(path)
            for name in set(table["infile"]):
                self.assertTrue((STUDY / name).is_file(), f"{path.name}: {name}")

    def test_plan_says_what_would_be_run(self):
        status, text = call("collapse", "--plan")
        self.assertEqual(status, 0, text)
        self.assertIn("linear-2mm_unscaled: 8 runs", text)

    def test_mistakes_are_named(self):
        for words, said in ((["nonsense"], "there is no study nonsense: allowed are a file and collapse,"),
                            (["collapse", "--var", "law"], "--var law has no value"),
                            (["collapse", "--lmp", "no_such_lmp"], "no LAMMPS at no_such_lmp")):
            with self.subTest(said), tempfile.TemporaryDirectory() as out:
                status, text = call(*words, "--out", out)
                self.assertEqual(status, 1, text)
                self.assertIn(said, text)

    def test_a_summary_has_its_figures(self):
        rows = [*BASE, *UNSCALED, *NARROW, *SLOW]
        for factor in fits.FACTORS:
            rows += varied("stiffness", factor, stiffness=factor) + varied("kadh", factor, adhesion=factor)
        runs, curves = study(rows)
        with tempfile.TemporaryDirectory() as folder:
            text = summary.write(runs.drop(columns=["material", "mode", "special"]), curves, Path(folder))
            made = {path.name for path in Path(folder).iterdir()}
        self.assertLessEqual({"means.csv", "summary.txt", "confined_base.png", "unconfined_base.png", "deviations.png",
                              "sizes.png", "speed.png", "micromechanics.png", "exponents.png"}, made)
        self.assertIn("exponent of stiffness against d", text)
        self.assertIn("processor time of the confined test, scaled: d^-4.00", text)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Runs(unittest.TestCase):
    def test_every_kind_of_run(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            status, text = call("strength", "--quick", "--out", out, "--lmp", LMP)
            self.assertEqual(status, 0, text)
            made = {path.name for path in out.iterdir()}
            self.assertLessEqual({"runs.csv", "curves.csv.gz", "means.csv", "summary.txt", "confined_plateau.png",
                                  "unconfined_pull_off.png", "exponents.png", "sizes.png"}, made)
            means = pd.read_csv(out / "means.csv", keep_default_na=True)
            runs = pd.read_csv(out / "runs.csv", index_col="run")
            pictures = list(out.glob("plateau/**/*.png"))
        self.assertEqual(len(runs), 25)
        self.assertTrue(runs["strength_36e3"].dropna().between(500.0, 20000.0).all())
        self.assertTrue(means["strain"].between(1e-3, 0.05).all())
        self.assertEqual(len(pictures), 4)

    def test_the_first_study_of_the_readme(self):
        with tempfile.TemporaryDirectory() as folder:
            status, text = call("collapse", "--quick", "--out", folder, "--lmp", LMP)
            self.assertEqual(status, 0, text)
            means = pd.read_csv(Path(folder) / "means.csv").set_index(["mode", "d"])
        # Scaled curves lie near each other, unscaled ones do not.
        self.assertLess(means.loc[("scaled", 2e-3), "curve"], 6.0)
        self.assertGreater(means.loc[("unscaled", 2e-3), "curve"], 20.0)


if __name__ == "__main__":
    unittest.main()

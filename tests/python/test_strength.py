# SPDX-License-Identifier: GPL-2.0-only
"""The analysis of examples/scale_collapse's study of strength against closed forms. LAMMPS is not
needed."""
from __future__ import annotations

import contextlib
import io
import math
import sys
import tempfile
import unittest
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

STUDY = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path.insert(0, str(STUDY))

import run_strength  # noqa: E402
from collapse import analysis, claims, curves, measured, plan  # noqa: E402
from collapse import runs, specimens, statistics, strength_figures  # noqa: E402
from collapse.analysis import Row  # noqa: E402
from collapse.measured import Cost  # noqa: E402
from collapse.specimens import Confined, Material, Unconfined  # noqa: E402
from collapse.statistics import Value  # noqa: E402

COLUMNS = ("height", "bulk_strain", "stress_top", "stress_bottom", "stress_x", "stress_y",
           "porosity", "bulk_porosity", "coordination", "plastic_overlap")
SPECIMEN = Confined(plan.BASE, 2.0e-3, True, 1, (36.0e3, 96.0e3))
COST = Cost(100, 1.0, 1000, 0.5, 500)


def table(rows):
    """:param rows: dictionaries with `stage` and `time` and some of COLUMNS"""
    kinds = [("step", int), ("time", float), ("stage", "U6")] + [(n, float) for n in COLUMNS]
    return np.array([(k, row["time"], row["stage"], *(row.get(n, 0.0) for n in COLUMNS))
                     for k, row in enumerate(rows)], dtype=kinds)


def unloading(modulus=8.0e6, lateral=3.0e6, stress=96.0e3, ratio=0.4):
    """Straight in axial and lateral stress."""
    return table([{"time": 1e-4 * k, "stage": "unload", "bulk_strain": -e,
                   "stress_top": stress - modulus * e, "stress_bottom": stress - modulus * e,
                   "stress_x": ratio * stress - lateral * e,
                   "stress_y": ratio * stress - lateral * e}
                  for k, e in enumerate(np.linspace(0.0, stress / modulus, 60))])


class Statistics(unittest.TestCase):
    def test_standard_error(self):
        value = statistics.value_of([1.0, 2.0, 3.0, 4.0])
        self.assertAlmostEqual(value.value, 2.5)
        self.assertAlmostEqual(value.error, math.sqrt(5.0 / 3.0) / 2.0)
        self.assertTrue(math.isnan(statistics.value_of([1.0]).error))

    def test_ratio_has_the_error_of_both(self):
        one = statistics.ratio_percent(Value(11.0, 0.3), Value(10.0, 0.4))
        self.assertAlmostEqual(one.value, 10.0)
        self.assertAlmostEqual(one.error, 100.0 * math.hypot(0.03, 1.1 * 0.04))

    def test_scatter_is_the_standard_deviation_over_the_peak(self):
        grid = np.linspace(0.0, 1.0, 11)
        mean = curves.mean_of(grid, [10.0 * grid + shift for shift in (-1.0, 0.0, 1.0)])
        self.assertAlmostEqual(statistics.scatter_percent(mean), 10.0)

    def test_slope_and_its_error(self):
        line = statistics.slope(np.arange(5.0), 3.0 + 2.0 * np.arange(5.0))
        self.assertAlmostEqual(line.value, 2.0)
        self.assertAlmostEqual(line.error, 0.0)
        # Residuals 1, -2, 1 about slope 1.5 of (0, 1), (1, 0) ... : the textbook's formula.
        bent = statistics.slope([0.0, 1.0, 2.0], [0.0, 0.0, 3.0])
        self.assertAlmostEqual(bent.value, 1.5)
        self.assertAlmostEqual(bent.error, math.sqrt((0.25 + 1.0 + 0.25) / 1 / 2.0))
        with self.assertRaisesRegex(ValueError, "2 different points"):
            statistics.slope([1.0, 1.0], [0.0, 1.0])

    def test_exponent_is_found(self):
        sizes = np.array([1.0, 1.5, 2.0, 3.0])
        self.assertAlmostEqual(statistics.exponent(sizes, 7.0 * sizes**-4).value, -4.0)
        logs = 1.3 * np.log(sizes[1:])
        fit = statistics.exponent_from_reference(sizes[1:], logs, [0.1, 0.2, 0.3], 0.05)
        self.assertAlmostEqual(fit.value, 1.3)
        same = statistics.exponent_from_reference(sizes[1:], logs, [math.nan] * 3, math.nan)
        self.assertAlmostEqual(same.value, 1.3)
        with self.assertRaisesRegex(ValueError, "other than that of the reference"):
            statistics.exponent_from_reference([1.0], [0.0], [0.1], 0.1)

    def test_exponent_error_is_that_of_repeated_experiments(self):
        sizes, errors, common = np.array([1.5, 2.0, 3.0]), np.array([0.03, 0.05, 0.02]), 0.04
        random = np.random.default_rng(1)
        found = [statistics.exponent_from_reference(
            sizes, 2.0 * np.log(sizes) + errors * random.standard_normal(3)
            + common * random.standard_normal(), errors, common) for _ in range(3000)]
        self.assertAlmostEqual(np.mean([f.value for f in found]), 2.0, delta=0.005)
        self.assertAlmostEqual(np.std([f.value for f in found]) / found[0].error, 1.0, delta=0.05)

    def test_best_factor_of_a_power_law(self):
        factors = (0.8, 1.0, 1.25)
        responses = [Value(5.0 * f**-0.7, 0.0) for f in factors]
        best = statistics.best_factor(factors, responses, 5.0 * 1.1**-0.7)
        self.assertAlmostEqual(math.exp(best.value), 1.1)
        self.assertEqual(best.error, 0.0)

    def test_best_factor_error_is_that_of_repeated_experiments(self):
        factors, relative = np.array([0.8, 1.0, 1.25]), 0.01
        random = np.random.default_rng(2)
        found = []
        for _ in range(3000):
            noisy = 5.0 * factors**0.9 * np.exp(relative * random.standard_normal(3))
            found.append(statistics.best_factor(
                factors, [Value(v, relative * v) for v in noisy], 5.5))
        expected = np.mean([f.error for f in found])
        self.assertAlmostEqual(np.std([f.value for f in found]) / expected, 1.0, delta=0.06)

    def test_proportion(self):
        exact = statistics.proportion([1.0, 2.0, 4.0], [0.3, 0.6, 1.2])
        self.assertAlmostEqual(exact.constant, 0.3)
        self.assertAlmostEqual(exact.scatter_percent, 0.0)
        self.assertAlmostEqual(exact.exponent.value, 1.0)
        self.assertAlmostEqual(statistics.proportion([1.0, 2.0, 4.0],
                                                     [1.0, 4.0, 16.0]).exponent.value, 2.0)


class Measured(unittest.TestCase):
    def test_moduli_of_a_straight_unloading(self):
        moduli = measured.moduli_of(unloading())
        self.assertAlmostEqual(moduli.constrained, 8.0e6, delta=1.0)
        self.assertAlmostEqual(moduli.bulk, (8.0e6 + 2.0 * 3.0e6) / 3.0, delta=1.0)
        self.assertAlmostEqual(moduli.lateral_ratio, 0.4)
        with self.assertRaisesRegex(curves.BadCurve, "needed are 4"):
            measured.moduli_of(unloading()[:3], "some.csv")

    def test_modulus_is_that_of_the_first_half_of_unloading(self):
        samples = unloading()
        late = samples["stress_top"] < 0.4 * samples["stress_top"][0]
        samples["bulk_strain"][late] *= 3.0
        self.assertAlmostEqual(measured.moduli_of(samples).constrained, 8.0e6, delta=1.0)

    def test_inertial_number(self):
        # 0.5/s at 5 kPa with 2 mm and 2000 kg/m3
        self.assertAlmostEqual(float(measured.inertial_number(
            2.0e-3, np.array(0.5), np.array(5.0e3))), 0.5 * 2.0e-3 * math.sqrt(0.4))
        samples = table([{"time": 1e-3 * k, "stage": "load", "bulk_strain": 0.5e-3 * k,
                          "stress_top": 5.0e3, "stress_bottom": 5.0e3} for k in range(40)])
        self.assertAlmostEqual(measured.loading_inertial_number(samples, 2.0e-3),
                               0.5 * 2.0e-3 * math.sqrt(0.4))

    def test_inertial_number_does_not_reach_over_a_hold(self):
        rows = [{"time": 1e-3 * k, "stage": "load" if k < 30 or k >= 50 else "hold",
                 "bulk_strain": 0.5e-3 * k if k < 30 else 0.01 * (k >= 50) + 0.5e-3 * k,
                 "stress_top": 5.0e3, "stress_bottom": 5.0e3} for k in range(80)]
        self.assertAlmostEqual(measured.loading_inertial_number(table(rows), 2.0e-3),
                               0.5 * 2.0e-3 * math.sqrt(0.4))

    def crush(self, pull=2.0e-6):
        rows = [{"time": 0.0, "stage": "free", "height": 0.03, "bulk_porosity": 0.36,
                 "coordination": 6.0, "plastic_overlap": pull}]
        for k, strain in enumerate(np.linspace(2e-4, 0.06, 300)):
            stress = 1.0e4 * (1.0 - ((strain - 0.03) / 0.03) ** 2)
            rows.append({"time": 1e-3 * k, "stage": "crush", "height": 0.03 * (1.0 - strain),
                         "stress_top": stress + 100.0, "stress_bottom": stress - 100.0,
                         "coordination": 6.0 - strain})
        return table(rows)

    def test_strength_of_a_parabola(self):
        run = Unconfined(SPECIMEN, 96.0e3)
        result = measured.unconfined_from(unloading(), self.crush(), run, COST)
        self.assertAlmostEqual(result.strength, 1.0e4, delta=1.0)
        self.assertAlmostEqual(result.strain_at_peak, 0.03, delta=2.1e-4)
        self.assertAlmostEqual(result.coordination_at_peak, 5.97, delta=3e-4)
        self.assertEqual((result.porosity, result.coordination), (0.36, 6.0))
        self.assertAlmostEqual(result.inertial_number,
                               0.3 * 2.0e-3 * math.sqrt(2000.0 / result.strength))
        # Size 2: k_adh k2/(k2 + k_adh) = 10000/3 N/m twice, f0 four times.
        self.assertAlmostEqual(result.pull_off, 2.0 * 1.0e4 / 3.0 * 2.0e-6 + 4.0 * 2.0e-4 / 3.0)

    def test_one_spike_is_no_strength(self):
        samples = self.crush()
        samples["stress_top"][200] += 2.0e3
        samples["stress_bottom"][200] += 2.0e3
        result = measured.unconfined_from(unloading(), samples, Unconfined(SPECIMEN, 96.0e3), COST)
        self.assertLess(result.strength, 1.0e4 + 2.0e3 / measured.SMOOTHED + 1.0)

    def test_pull_off_of_the_laws(self):
        linear, plateau = Material("a", f0=-1e-4), Material("b", law="plateau", f0=-1e-4)
        delta_p = 3.0e-6
        # linear: the adhesive branch f0 - k_adh delta meets f0 + k2 (delta - delta_p)
        delta = linear.k2 * delta_p / (linear.k2 + linear.kadh)
        self.assertAlmostEqual(linear.pull_off(delta_p, 1.0), linear.kadh * delta + 1e-4)
        self.assertAlmostEqual(plateau.pull_off(delta_p, 1.0), plateau.kadh * delta_p + 1e-4)

    def test_pull_off_force_of_a_tensile_strength(self):
        force = specimens.pull_off_force(150.0, 1.0e-3)
        self.assertAlmostEqual(force, -1.0e-4)
        # Rumpf's estimate backwards, at any porosity and diameter.
        for porosity, diameter in ((0.35, 2.0e-3), (0.6, 0.5e-3)):
            force = specimens.pull_off_force(200.0, diameter, porosity)
            self.assertAlmostEqual((1.0 - porosity) / porosity * -force / diameter**2, 200.0)
        for wrong in (0.0, 1.0, 1.5):
            with self.assertRaisesRegex(ValueError, "porosity is"):
                specimens.pull_off_force(100.0, 1e-3, wrong)


class Figures(unittest.TestCase):
    def test_deviations_of_a_size_that_is_not_crushed(self):
        some = Value(1.0, 0.1)
        of_type = {"Value": some, "float": 1.0, "int": 3, "str": "base"}

        def row(**given):
            values = {f.name: of_type.get(f.type, {}) for f in fields(Row)}
            return Row(**{**values, "strain_rate": Confined.strain_rate, **given})
        rows = [row(mode="scaled", diameter_mm=1.0, strength_deviation={96e3: some}),
                row(mode="scaled", diameter_mm=2.0, strength_deviation={96e3: some}),
                row(mode="unscaled", diameter_mm=1.25),
                row(mode="unscaled", diameter_mm=2.0, strength_deviation={96e3: some})]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "deviations.png"
            strength_figures.deviations(rows, path)
            self.assertGreater(path.stat().st_size, 1000)


class Plan(unittest.TestCase):
    def test_full_plan_is_what_the_study_asks_for(self):
        full = plan.full()
        sizes = full.diameters
        self.assertGreaterEqual(max(sizes) / min(sizes), 3.0)
        self.assertEqual(full.levels, (16e3, 36e3, 56e3, 76e3, 96e3))
        base = [r for r in full.runs if isinstance(r, Confined) and r.material == plan.BASE
                and r.strain_rate == Confined.strain_rate]
        for size in sizes:
            seeds = 3 if size < 1.5e-3 else 5  # of the finest, which take most of the time
            self.assertEqual(sum(r.diameter == size and r.scaled for r in base), seeds)
            self.assertEqual(sum(r.diameter == size and not r.scaled for r in base),
                             0 if size == 1.0e-3 else seeds)
        self.assertTrue(all(r.side >= 10.0 * max(sizes) for r in base))
        self.assertEqual({m.law for m in {r.material for r in full.runs
                                          if isinstance(r, Confined)}}, {"linear", "plateau"})
        crushed = [r for r in full.runs if isinstance(r, Unconfined)]
        self.assertFalse([r for r in crushed if r.specimen.material == plan.COHESIONLESS])
        self.assertEqual({r.level for r in crushed}, set(full.levels))
        self.assertEqual(len(set(r.name for r in full.runs)), len(full.runs))

    def test_specimens_come_before_what_starts_from_them(self):
        some = plan.quick().sorted_runs()
        for place, run in enumerate(some):
            if run.needs is not None:
                self.assertLess(some.index(run.needs), place)

    def test_factors_change_what_they_say(self):
        stiff, sticky = plan.stiffer(plan.BASE, 1.25), plan.stickier(plan.BASE, 0.8)
        self.assertEqual((stiff.k1, stiff.k2, stiff.kadh, stiff.f0),
                         (6250.0, 12500.0, 6250.0, plan.BASE.f0))
        self.assertEqual((sticky.k1, sticky.kadh, sticky.f0),
                         (5000.0, 4000.0, 0.8 * plan.BASE.f0))

    def test_bad_specimens_are_named(self):
        for change, text in (({"levels": ()}, "rising stresses"),
                             ({"levels": (36e3, 16e3)}, "rising stresses"),
                             ({"levels": (1e3,)}, "the first level is 1000 Pa"),
                             ({"diameter": 0.0}, "diameter is 0.0"),
                             ({"strain_rate": -1.0}, "strain rate is -1.0")):
            with self.subTest(change=change), self.assertRaisesRegex(ValueError, text):
                replace(SPECIMEN, **change)
        with self.assertRaisesRegex(ValueError, "level is 50000 Pa"):
            Unconfined(SPECIMEN, 50.0e3)

    def test_loading_takes_the_same_strain_rate_scaled_or_not(self):
        for scaled in (True, False):
            one = replace(SPECIMEN, scaled=scaled)
            self.assertAlmostEqual(one.pressure_rate / (one.material.k1 * one.size / one.diameter),
                                   one.strain_rate)

    def test_crushing_reads_the_level_of_its_specimen(self):
        launcher = runs.Launcher(Path("/x/lmp"), STUDY / "in.confined")
        run = Unconfined(SPECIMEN, 96.0e3)
        words = launcher.command(run, Path("/out/runs") / f"{run.name}.partial")
        self.assertEqual(words[words.index("state") + 1],
                         f"/out/runs/{SPECIMEN.name}/level_96000")
        self.assertIn(str(Path("/out/runs") / f"{run.name}.partial" / "in.unconfined"), words)

    def test_includes_are_found_also_behind_a_condition(self):
        self.assertEqual({p.name for p in runs.with_includes(STUDY / "in.unconfined")},
                         {"in.unconfined", "in.law", "in.measures", "in.gauges", "in.micro",
                          "in.curve", "in.picture"})

    def test_arguments(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            with tempfile.TemporaryDirectory() as folder:
                lmp = Path(folder) / "lmp"
                lmp.write_text("#!/bin/sh\n", encoding="utf-8")
                lmp.chmod(0o755)
                self.assertEqual(run_strength.main(["--full", "--plan", "--lmp", str(lmp),
                                                    "--out", folder, "--jobs", "2"]), 0)
        self.assertIn("core-hours at", said.getvalue())
        for words, text in ((["--full", "--seeds", "0"], "--seeds is 0, allowed is 1 or more"),
                            (["--quick", "--fine-seeds", "1"], "--fine-seeds goes with --full"),
                            ([], "required")):
            refused = io.StringIO()
            with contextlib.redirect_stderr(refused), self.assertRaises(SystemExit):
                run_strength.parse_arguments(words)
            self.assertIn(text, refused.getvalue())


class References(unittest.TestCase):
    def test_of_what_a_group_is_compared_with(self):
        def group(diameter, mode="scaled", rate=0.5, results=(1, 2, 3)):
            return analysis.Group(plan.BASE, diameter, mode, rate, list(results),
                                  {96.0e3: list(results)})
        groups = {k: g for k, g in enumerate([
            group(2.0e-3), group(1.0e-3), group(0.5e-3, "unscaled"), group(2.0e-3, "unscaled")])}
        for one in groups.values():
            self.assertIs(analysis.reference_of(groups, one), groups[1])
        slow = group(2.0e-3, rate=0.25, results=(7, 8))
        reference = analysis.reference_of({**groups, 9: slow}, slow)
        self.assertEqual((reference.diameter, reference.mode, reference.strain_rate),
                         (2.0e-3, "scaled", 0.5))
        # Only the packings that were run at both rates.
        self.assertEqual((reference.confined, reference.unconfined), ([1, 2], {96.0e3: [1, 2]}))


class Claims(unittest.TestCase):
    def test_verdicts_name_the_standard_error_where_it_alone_saves_a_figure(self):
        for value, verdict in ((Value(1.9, 0.1), "yes"), (Value(-1.9, 0.1), "yes"),
                               (Value(2.5, 0.1), "NO"), (Value(-2.5, 0.1), "NO"),
                               (Value(2.5, math.nan), "NO"),
                               (Value(2.5, 3.0), "within its standard error only")):
            self.assertEqual(claims._near("x", value, 2.0).verdict, verdict)


if __name__ == "__main__":
    unittest.main()

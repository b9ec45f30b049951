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
from collapse import curves, groups, measured, plan  # noqa: E402
from collapse import runs, specimens, statistics, strength_figures  # noqa: E402
from collapse.analysis import Row  # noqa: E402
from collapse.measured import Cost  # noqa: E402
from collapse.specimens import Confined, Material, Unconfined  # noqa: E402
from collapse.statistics import Value  # noqa: E402

COLUMNS = ("height", "bulk_strain", "stress_top", "stress_bottom", "stress_x", "stress_y",
           "porosity", "bulk_porosity", "coordination", "bulk_coordination", "plastic_overlap")
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
                   "stress_y": ratio * stress - lateral * e, "coordination": 6.2}
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

    def test_best_factors_of_a_power_law(self):
        factors = [0.8, 1.0, 1.25]
        logs, line = statistics.best_factors(factors, [[3.0 * f**-0.7 for f in factors],
                                                       [3.3 * f**-0.7 for f in factors]],
                                             3.0 * 1.1**-0.7)
        self.assertAlmostEqual(logs[0], math.log(1.1))
        self.assertAlmostEqual(logs[1], math.log(1.1) + math.log(1.1) / 0.7)
        self.assertAlmostEqual(line, -0.7)
        with self.assertRaisesRegex(ValueError, "does not depend"):
            statistics.best_factors(factors, [[1.0, 1.0, 1.0]], 1.0)

    def test_pooled_error_is_that_of_all(self):
        some = statistics.pooled([Value(1.0, 3.0), Value(2.0, 4.0)])
        self.assertEqual([v.value for v in some], [1.0, 2.0])
        self.assertAlmostEqual(some[0].error, math.sqrt(12.5))
        self.assertEqual(some[0].error, some[1].error)

    def test_pairs_have_the_error_of_their_differences(self):
        # Packings differ much, what is done to them changes each by 2% and little else.
        before = {1: 10.0, 2: 20.0, 3: 40.0, 9: 1.0}
        after = {1: 10.2, 2: 20.4, 3: 40.8, 8: 7.0}
        found = statistics.paired_percent(after, before)
        self.assertAlmostEqual(found.value, 2.0)
        self.assertAlmostEqual(found.error, 0.0)
        apart = statistics.paired_percent({1: 10.1, 2: 20.6}, before)
        self.assertAlmostEqual(apart.value, 2.0)
        self.assertAlmostEqual(apart.error, 1.0)

    def test_ratio_of_means(self):
        found = statistics.ratio_of_means([8.0, 12.0], [1.0, 1.0])
        self.assertAlmostEqual(found.value, 10.0)
        self.assertAlmostEqual(found.error, 2.0)

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

    def test_strain_of_unloading_counts_from_its_beginning(self):
        samples = unloading()
        # as gauges say that were fixed before 10% of compression
        samples["bulk_strain"] = 0.1 + 0.9 * samples["bulk_strain"]
        self.assertAlmostEqual(measured.moduli_of(samples).constrained, 8.0e6, delta=1.0)

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
        self.assertAlmostEqual(result.strain_at_peak, 0.03, delta=1e-4)
        self.assertEqual(result.uncut_coordination, 6.2)
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
        self.assertLess(result.strength, 1.0e4 + 2.0e3 / 50.0)

    def test_what_reached_the_largest_strain_did_not_fail(self):
        samples = self.crush()
        run = Unconfined(SPECIMEN, 96.0e3)
        self.assertTrue(measured.unconfined_from(unloading(), samples, run, COST).failed)
        samples["height"] = 0.03 * (1.0 - 2.0 * (1.0 - samples["height"] / 0.03))
        self.assertFalse(measured.unconfined_from(unloading(), samples, run, COST).failed)

    def test_cost_is_processor_time_without_and_with_the_making(self):
        def stage(seconds, steps):
            return {"seconds": 9.0, "cpu_seconds": seconds, "steps": steps}
        cost = Cost.from_marker({"particles": 7, "stages": {
            "place": stage(1.0, 30), "relax": stage(2.0, 100), "pack": stage(4.0, 200),
            "load": stage(8.0, 400), "unload": stage(16.0, 800)}})
        self.assertEqual(cost, Cost(7, 31.0, 1500, 24.0, 1200))

    def test_strength_of_scattered_samples_is_not_above_them(self):
        # The scatter of grains is correlated over several samples, and after a peak stress falls slowly.
        random = np.random.default_rng(7)
        strain = np.linspace(2e-4, 0.03, 150)
        curve = 1.0e4 * 2.718281828 * strain / 0.01 * np.exp(-strain / 0.01)
        kernel = np.ones(6) / math.sqrt(6.0)
        scattered = [curve * (1.0 + np.convolve(0.05 * random.standard_normal(155), kernel,
                                                "valid")) for _ in range(300)]
        found = np.mean([measured.strength_of(strain, some)[0] for some in scattered])
        self.assertAlmostEqual(found / 1.0e4, 1.0, delta=0.008)
        # the result by the largest mean of five samples
        self.assertGreater(np.mean([measured.running_mean(some, 5).max() for some in scattered]),
                           1.03e4)

    def test_strength_of_what_does_not_fail_is_the_end(self):
        strain = np.linspace(0.0, 0.1, 100)
        strength, at = measured.strength_of(strain, 1.0e5 * strain)
        self.assertAlmostEqual(strength, 1.0e4)
        self.assertAlmostEqual(at, 0.1)

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
            return Row(**{**values, "special": "", **given})
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
                and not groups.special_of(r, full)]
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
        self.assertEqual((sticky.k1, sticky.kadh, sticky.f0), (5000.0, 4000.0, plan.BASE.f0))
        pulled = plan.pulled_harder(plan.PULL_OFF, 1.25)
        self.assertEqual((pulled.k1, pulled.kadh, pulled.f0),
                         (5000.0, 0.0, 1.25 * plan.PULL_OFF.f0))

    def test_sizes_of_specimens_are_told_apart(self):
        full = plan.full()
        special = [r for r in full.runs if isinstance(r, Confined) and r.side != full.side]
        def sizes(material):
            return {(r.diameter, round(r.side, 9), r.particles) for r in special
                    if r.material == material}
        self.assertEqual(sizes(plan.BASE), {
            (1.0e-3, 10.0e-3, 1200), (1.0e-3, 12.0e-3, 2074), (1.0e-3, 15.0e-3, 4050),
            (2.0e-3, 60.0e-3, 32400), (3.0e-3, 60.0e-3, 9600)})
        # as wide in diameters, but for the rounding, as those of 3, 2.5 and 2 mm
        self.assertEqual(sizes(plan.PULL_OFF), {
            (1.5e-3, 15.0e-3, 1200), (1.5e-3, 18.0e-3, 2073), (1.5e-3, 22.5e-3, 4050)})
        self.assertEqual({groups.special_of(r, full) for r in special}, {
            f"{width} mm wide" for width in ("10", "12", "15", "18", "22.5", "60")})

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

    def test_unloading_gives_waves_the_time_to_pass(self):
        def unloading(specimen, level):
            specimen = replace(specimen, levels=(level, 96.0e3))
            seconds = (Unconfined(specimen, level).expected_steps() * specimen.time_step
                       - 2.0 * specimens.HOLD - specimens.CRUSHING_STRAIN
                       / Unconfined(specimen, level).crushing_rate)
            return round(seconds / specimen.wave_passage, 1)
        wide = replace(SPECIMEN, side=2.0 * SPECIMEN.side,
                       reference_particles=8 * SPECIMEN.reference_particles)
        self.assertAlmostEqual(wide.wave_passage, 2.0 * SPECIMEN.wave_passage, delta=1e-6)
        self.assertEqual(unloading(SPECIMEN, 16.0e3), specimens.TRANSITS)
        self.assertEqual(unloading(wide, 16.0e3), specimens.TRANSITS)
        self.assertGreater(unloading(SPECIMEN, 76.0e3), 2.0 * specimens.TRANSITS)
        text = (STUDY / "in.unconfined").read_text(encoding="utf-8")
        self.assertIn(f"variable transits  index {specimens.TRANSITS:g} ", text)

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


if __name__ == "__main__":
    unittest.main()

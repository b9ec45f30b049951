# SPDX-License-Identifier: GPL-2.0-only
"""coarsen without LAMMPS: studies, statistics, measuring, predictions and plans."""
import contextlib
import dataclasses
import io
import math
import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd
import statsmodels.api as sm
from scipy import stats

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "coarsen"))

from coarsen import calibrate, check, equivalence, evidence, measure, plan, report  # noqa: E402
from coarsen.__main__ import main  # noqa: E402
from coarsen.dimensionless import Loading, Powder  # noqa: E402
from coarsen.options import diameters, percentages  # noqa: E402
from coarsen.results import read_results  # noqa: E402
from coarsen.study import BadStudy, read_study, variables  # noqa: E402


def study(text):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "study.yaml"
        path.write_text(text)
        return read_study(path)


def call(*words):
    """Status and what was written, errors included."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        try:
            status = main([str(word) for word in words])
        except SystemExit as end:
            status = end.code
    return status, out.getvalue()


class Study(unittest.TestCase):
    def test_lists_are_combined_and_zipped_lists_are_not(self):
        table = study("common: {infile: in.a}\n"
                      "groups:\n  g: {d: [1e-3, 2e-3], zip: {k1: [1, 2, 3], k2: [4, 5, 6]}, e: 0.3}\n")
        self.assertEqual(len(table), 6)
        self.assertEqual(table.index[0], "g/d=1e-3,k1=1,k2=4")
        self.assertEqual(variables(table.iloc[5]), {"d": "2e-3", "k1": "3", "k2": "6", "e": "0.3"})

    def test_spans_are_lists_in_zip_too(self):
        table = study("groups:\n  g: {infile: in.a, zip: {d: [4, 5, 6, 7], seed: 1..4}}\n")
        self.assertEqual(list(table["seed"]), ["1", "2", "3", "4"])

    def test_a_value_of_several_words_is_one_value(self):
        table = study("groups:\n  g: {infile: in.a, level: [[16e3, 96e3]], seed: [1, 2]}\n")
        self.assertEqual(list(table["level"]), ["16e3 96e3"] * 2)

    def test_what_runs_after_names_what_it_needs(self):
        table = study("groups:\n  g: {infile: in.a, seed: [1, 2], after: {infile: in.b, state: [x, y]}}\n")
        self.assertEqual(list(table.index), ["g/seed=1", "g/seed=1/state=x", "g/seed=1/state=y",
                                             "g/seed=2", "g/seed=2/state=x", "g/seed=2/state=y"])
        self.assertEqual(table.loc["g/seed=2/state=y", "needs"], "g/seed=2")
        self.assertEqual(variables(table.loc["g/seed=2/state=y"]), {"state": "y"})

    def test_booleans_are_the_words_of_in_files(self):
        self.assertEqual(variables(study("groups: {g: {infile: in.a, scaled: no}}").iloc[0]), {"scaled": "no"})

    def test_mistakes_are_named(self):
        for text, said in (("a: 1", "groups"), ("groups: {g: {d: 1}}", "no infile"),
                           ("groups: {g: {infile: a}}\nmore: 1", "`more` is not allowed"),
                           ("groups: {g: {infile: a, zip: {a: [1], b: [1, 2]}}}", "unequal lengths"),
                           ("groups: {g: {infile: a, d: [1, 1]}}", "two runs are named g/d=1"),
                           ("groups: {}", "it has no runs"), ("groups: {g: {infile: a, d: []}}", "d has no value"),
                           ("groups: {g: {infile: a, k2: }}", "k2 has no value"), ("groups: [", "study.yaml")):
            with self.subTest(text), self.assertRaisesRegex(BadStudy, said):
                study(text)


class Equivalence(unittest.TestCase):
    def test_of_an_example_by_hand(self):
        coarse, fine = [1.02, 1.05, 1.03, 1.06], [1.0, 1.02, 1.01, 1.02]
        apart = np.log(np.array(coarse) / fine)
        mean, error = apart.mean(), apart.std(ddof=1) / 2.0
        reach = 2.353363 * error  # 95% point of Student's t with three degrees of freedom
        found = equivalence.compare(coarse, fine, 0.05, paired=True)
        self.assertAlmostEqual(found.difference, math.expm1(mean), places=12)
        self.assertAlmostEqual(found.low, math.expm1(mean - reach), places=6)
        self.assertAlmostEqual(found.high, math.expm1(mean + reach), places=6)
        self.assertEqual(found.verdict, equivalence.EQUIVALENT)
        self.assertEqual(equivalence.compare(coarse, fine, 0.03, True).verdict, equivalence.OPEN)
        self.assertEqual(equivalence.compare(coarse, fine, 0.005, True).verdict, equivalence.DIFFERENT)

    def test_is_two_one_sided_tests(self):
        random = np.random.default_rng(3)
        for _ in range(50):
            coarse, fine = np.exp(0.03 * random.standard_normal((2, 5)) + [[0.02], [0.0]])
            apart, within = np.log(coarse / fine), math.log1p(0.05)
            p = max(stats.ttest_1samp(apart, -within, alternative="greater").pvalue,
                    stats.ttest_1samp(apart, within, alternative="less").pvalue)
            self.assertEqual(equivalence.compare(coarse, fine, 0.05, True).verdict == equivalence.EQUIVALENT,
                             p < 0.05)

    def test_unpaired_is_welchs(self):
        coarse, fine = np.array([1.0, 1.1, 1.3]), np.array([1.0, 1.01, 0.99, 1.02, 1.0])
        found = equivalence.compare(coarse, fine, 0.1, paired=False)
        interval = stats.ttest_ind(np.log(coarse), np.log(fine), equal_var=False)
        # p of no difference, from the interval found: error = (high - mean)/t
        mean = math.log1p(found.difference)
        self.assertAlmostEqual(mean / found.error, interval.statistic, places=10)
        v = [np.log(x).var(ddof=1) / len(x) for x in (coarse, fine)]
        freedom = sum(v)**2 / (v[0]**2 / 2 + v[1]**2 / 4)
        self.assertAlmostEqual(math.log1p(found.high) - mean, found.error * stats.t.ppf(0.95, freedom), places=10)

    def test_false_equivalence_is_as_rare_as_it_says(self):
        # At the very edge of the tolerance one call in twenty may say equivalent.
        random, said = np.random.default_rng(1), 0
        for _ in range(2000):
            coarse, fine = np.exp(0.02 * random.standard_normal((2, 6)) + [[math.log1p(0.05)], [0.0]])
            said += equivalence.compare(coarse, fine, 0.05, True).verdict == equivalence.EQUIVALENT
        self.assertLess(said, 0.065 * 2000)
        self.assertGreater(said, 0.03 * 2000)

    def test_so_many_seeds_would_decide(self):
        # in four of five cases, with differences in the middle, near the edge and beyond it
        random = np.random.default_rng(2)
        for middle in (0.0, 0.02, 0.035, 0.08):
            begun = middle + 0.06 * np.array([-1.0, 1.0, -1.0, 1.0])
            needed = equivalence.compare(np.exp(begun), np.ones(4), 0.05, True).needed
            self.assertGreater(needed, 4)
            decided = sum(equivalence.compare(
                np.exp(middle + begun.std(ddof=1) * random.standard_normal(needed)), np.ones(needed), 0.05,
                True).verdict != equivalence.OPEN for _ in range(2000))
            self.assertAlmostEqual(decided / 2000, 0.8, delta=0.04, msg=middle)

    def test_bad_numbers_are_named(self):
        for arguments, said in ((([1.0], [1.0], 0.05, True), "needed are 2"),
                                (([1.0, -1.0], [1.0, 1.0], 0.05, True), "above 0"),
                                (([1.0, 2.0], [1.0, 1.0], 1.5, True), "tolerance is 1.5"),
                                (([1.0, 2.0, 3.0], [1.0, 1.0], 0.05, True), "no pairs")):
            with self.subTest(said), self.assertRaisesRegex(ValueError, said):
                equivalence.compare(*arguments)


def results(function, sizes=(1.0, 2.0, 3.0), seeds=5, scatter=0.01):
    random = np.random.default_rng(4)
    return pd.DataFrame([{"d": d, "seed": s, "q": function(d) * math.exp(scatter * random.standard_normal())}
                         for d in sizes for s in range(seeds)])


class Check(unittest.TestCase):
    def test_coarse_runs_are_compared_with_the_real_diameter(self):
        found = check.verdicts(results(lambda d: math.exp(-0.05 * d)), {"q": 0.04}, real=0.1)
        self.assertTrue(found["trend"].all())
        self.assertTrue((found["against"] == 0.1).all())
        row = found[found["d"] == 3.0].iloc[0]
        self.assertAlmostEqual(math.log1p(row["difference"]), -0.05 * 2.9, delta=0.02)
        self.assertEqual(row["verdict"], equivalence.DIFFERENT)

    def test_a_slope_of_chance_is_in_the_interval(self):
        # A difference at the very edge, with so little reach of diameters that no slope is significant.
        random, said = np.random.default_rng(8), 0
        slope = math.log1p(0.05) / 1.3
        for _ in range(300):
            table = pd.DataFrame([{"d": d, "seed": s, "q": math.exp(slope * d + 0.02 * random.standard_normal())}
                                  for d in (1.0, 1.2, 1.4) for s in range(4)])
            found = check.verdicts(table, {"q": 0.05}, real=0.1)
            said += found["verdict"].iloc[-1] == equivalence.EQUIVALENT
        self.assertLess(said, 0.09 * 300)

    def test_what_is_peculiar_to_a_seed_is_none_of_the_scatter_of_a_trend(self):
        table = results(lambda d: math.exp(0.2 * d), scatter=1e-3)
        table["q"] *= np.exp(0.3 * table["seed"])
        paired, not_so = (check.verdicts(table, {"q": 0.9}, real=0.1, paired=p).set_index("d") for p in (True, False))
        self.assertTrue(paired["trend"].all())
        self.assertAlmostEqual(math.log1p(paired.loc[3.0, "difference"]), 0.58, delta=2e-3)
        self.assertEqual((paired.loc[3.0, "verdict"], paired.loc[3.0, "seeds"]), (equivalence.EQUIVALENT, 5))
        self.assertEqual(not_so.loc[3.0, "verdict"], equivalence.OPEN)
        # a seed that lacks a diameter has no line
        fewer = check.verdicts(table.drop(table.index[:2]), {"q": 0.9}, real=0.1).iloc[-1]
        self.assertAlmostEqual(math.log1p(fewer["difference"]), 0.58, delta=2e-3)
        self.assertEqual(fewer["seeds"], 3)

    def test_lines_of_seeds_are_least_squares_with_a_constant_for_each(self):
        table = results(lambda d: math.exp(0.2 * d), seeds=4, scatter=0.02)
        x = sm.add_constant(pd.get_dummies(table["seed"], drop_first=True, dtype=float).assign(d=table["d"]))
        fit = sm.OLS(np.log(table["q"]), x).fit()
        found = check.line_through(table.pivot(index="seed", columns="d", values="q"), paired=True)
        for a, b in ((found.slope, fit.params["d"]), (found.error, fit.bse["d"]), (found.freedom, fit.df_resid),
                     (found.probability, fit.pvalues["d"])):
            self.assertAlmostEqual(a / b, 1.0, places=9)

    def test_one_seed_with_all_diameters_makes_no_line(self):
        table = results(lambda d: math.exp(0.2 * d), seeds=3, scatter=1e-3)
        table = table.drop(table[(table["seed"] == 0) & (table["d"] == 2.0) | (table["seed"] == 1) & (table["d"] == 3.0)].index)
        self.assertIsNone(check.line_through(table.pivot(index="seed", columns="d", values="q"), paired=True))

    def test_numbers_that_have_no_logarithm_are_named(self):
        table = results(lambda d: 1.0)
        table.loc[3, "q"] = -5.0
        with self.assertRaisesRegex(check.NothingToCompare, "q: of the results .*-5.* all must be numbers above 0"):
            check.verdicts(table, {"q": 0.9}, real=0.1)

    def test_what_can_not_be_compared_is_named(self):
        table = results(lambda d: 1.0)
        with self.assertRaisesRegex(check.NothingToCompare, "real diameter is 3.5, allowed are those up to the coarsest that was run, 3"):
            check.verdicts(table, {"q": 0.1}, real=3.5)
        table.loc[table["d"] == 2.0, "q"] = np.nan
        with self.assertRaisesRegex(check.NothingToCompare, "q: of diameter 2 fewer than two runs have it"):
            check.verdicts(table, {"q": 0.1})

    def test_two_diameters_say_nothing_of_the_real_one_but_that_they_differ(self):
        for factor, said in ((1.0, equivalence.OPEN), (1.2, equivalence.DIFFERENT)):
            found = check.verdicts(results(lambda d: factor if d > 1.5 else 1.0, sizes=(1.0, 2.0)), {"q": 0.04}, real=0.1)
            self.assertEqual(list(found["verdict"]), [said])
            self.assertEqual(list(found["needed"]), [0])

    def test_between_the_diameters_the_interval_is_the_right_way_round(self):
        row = check.verdicts(results(lambda d: 1.0), {"q": 0.04}, real=2.5).iloc[0]
        self.assertLess(row["low"], row["high"])

    def test_nothing_is_extrapolated_where_means_lie_on_no_straight_line(self):
        found = check.verdicts(results(lambda d: 1.2 if d > 2.5 else 1.0), {"q": 0.04}, real=0.1).set_index("d")
        self.assertFalse(found["trend"].any())
        self.assertTrue((found["against"] == 1.0).all())
        self.assertEqual(found.loc[2.0, "verdict"], equivalence.OPEN)  # equal to the finest, which is not the real one
        self.assertEqual(found.loc[3.0, "verdict"], equivalence.DIFFERENT)

    def test_without_a_real_diameter_the_finest_is_the_measure(self):
        found = check.verdicts(results(lambda d: math.exp(-0.05 * d)), {"q": 0.2})
        self.assertTrue((found["against"] == 1.0).all())
        self.assertAlmostEqual(math.log1p(found["difference"].iloc[1]), -0.1, delta=0.02)
        self.assertEqual(check.overall(found["verdict"]), equivalence.EQUIVALENT)

    def test_what_does_not_depend_on_the_seed_proves_nothing(self):
        with self.assertRaisesRegex(check.NothingToCompare, "does the in-file use its variable seed"):
            check.verdicts(results(lambda d: 1.0, scatter=0.0), {"q": 0.04})

    def test_overall(self):
        yes, no, maybe = equivalence.EQUIVALENT, equivalence.DIFFERENT, equivalence.OPEN
        for seen, said in (([yes, yes], yes), ([yes, no, maybe], no), ([yes, maybe], maybe)):
            self.assertEqual(check.overall(seen), said)

    def test_results_are_read_from_the_log(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "log.lammps"
            log.write_text('print "Result strength $(v_s)"\nResult strength 12.5\nResult porosity 0.4\n')
            self.assertEqual(read_results(Path(folder)), {"strength": 12.5, "porosity": 0.4})
            log.write_text("Result strength inf?\n")
            with self.assertRaisesRegex(measure.BadRun, "result strength is inf?"):
                read_results(Path(folder))

    def test_an_unknown_quantity_is_named(self):
        with self.assertRaisesRegex(check.NothingToCompare, "no run has the result z; there are q"):
            check.verdicts(results(lambda d: 1.0), {"z": 0.1})

    def test_resampling_counts_verdicts(self):
        table = results(lambda d: 1.0 if d == 1.0 else 1.2, sizes=(1.0, 2.0), seeds=12)
        found = check.resample(table, "q", 2.0, 1.0, 5, 200, 0.05, True)
        self.assertEqual(found[equivalence.DIFFERENT], 200)
        table = results(lambda d: 1.0, sizes=(1.0, 2.0), seeds=12)
        self.assertEqual(check.resample(table, "q", 2.0, 1.0, 5, 200, 0.05, True)[equivalence.EQUIVALENT], 200)


class Measure(unittest.TestCase):
    def curve(self, slip=False):
        """Stress over strain of 1e6 Pa, 2e6 on unloading, strain counted from 5 kPa."""
        step = np.arange(201)
        strain = np.where(step <= 100, step * 1e-3, 0.1 - (step - 100) * 2.5e-4)
        stress = np.where(step <= 100, strain * 1e6, 1e5 - (0.1 - strain) * 2e6 * 1.0)
        if slip:
            stress[50] = stress[48]
        return pd.DataFrame({
            "step": step, "time": step * 1e-2, "stage": np.where(step <= 100, "load", "unload"),
            "bulk_strain": strain, "stress": stress, "bulk_porosity": 0.5 - strain,
            "coordination": 5.0 + 10.0 * strain, "stress_x": 0.5 * stress, "stress_y": 0.5 * stress})

    def test_strain_counts_from_the_preload(self):
        load = measure.loading(self.curve(), 5500.0)
        self.assertAlmostEqual(load["stress"].iloc[0], 5500.0)
        self.assertEqual(load["strain"].iloc[0], 0.0)
        self.assertAlmostEqual(measure.at_stress(load, 55e3, "strain"), 1.0 - (1.0 - 0.055) / (1.0 - 0.0055),
                               places=9)
        self.assertAlmostEqual(measure.at_stress(load, 55e3, "bulk_porosity"), 0.445)

    def test_a_grain_that_slips_changes_little(self):
        one, other = (measure.at_stress(measure.loading(self.curve(slip), 5e3), 48.5e3, "strain")
                      for slip in (False, True))
        self.assertAlmostEqual(one, other, delta=2e-3)

    def test_no_rise_through_the_preload_is_an_error(self):
        with self.assertRaisesRegex(measure.BadRun, "does not rise through the preload of 200000 Pa"):
            measure.loading(self.curve(), 2e5)

    def test_moduli(self):
        found = measure.modulus(self.curve())
        # strain counts from the length at the first sample of unloading
        self.assertAlmostEqual(found["constrained_modulus"], 2e6 * 0.90025, delta=1e-3)
        self.assertAlmostEqual(found["bulk_modulus"], 2e6 * 0.90025 * 2.0 / 3.0, delta=1e-3)
        self.assertAlmostEqual(found["lateral_ratio"], 0.5)

    def test_inertial_number(self):
        load = measure.loading(self.curve(), 5e3)
        rate = 0.1  # 1e-3 in 1e-2 s
        # 21 samples from 5 kPa on have a mean stress of 15 kPa
        self.assertAlmostEqual(measure.inertial_number(load, 1e-3, 2000.0),
                               rate * 1e-3 * math.sqrt(2000.0 / 15e3), delta=1e-7)

    def test_strength_is_the_top_of_the_smooth_curve(self):
        strain = np.linspace(0.0, 0.04, 201)
        top = 1000.0 - 1e6 * (strain - 0.02)**2
        noise = 30.0 * np.random.default_rng(5).standard_normal(len(strain))
        found = measure.strength(strain, top + noise)
        self.assertAlmostEqual(found["strength"], 1000.0, delta=10.0)
        self.assertAlmostEqual(found["strain_at_peak"], 0.02, delta=1e-3)
        self.assertGreater((top + noise).max(), 1050.0)  # which the largest sample is not


class Evidence(unittest.TestCase):
    def test_slopes_of_a_known_law(self):
        random = np.random.default_rng(6)
        runs = pd.DataFrame([{"narrowness": w, "weight": b, "q": 3.0 * math.exp(
            -2.0 * w + 0.5 * b + 0.002 * random.standard_normal())}
            for w in (0.02, 0.05, 0.1) for b in (0.1, 0.2) for _ in range(5)])
        found = evidence.slopes_of(runs, "made", ["q"], ["narrowness", "weight", "overlap"][:2]).set_index("number")
        self.assertAlmostEqual(found.loc["narrowness", "slope"], -2.0, delta=3 * found.loc["narrowness", "error"])
        self.assertAlmostEqual(found.loc["weight", "slope"], 0.5, delta=3 * found.loc["weight", "error"])
        self.assertLess(found.loc["narrowness", "error"], 0.03)
        self.assertEqual(found.loc["narrowness", "most"], 0.1)

    def test_packings_that_are_the_same_do_not_scatter(self):
        runs = pd.DataFrame([{"seed": s, "inertia": i, "q": math.exp(5.0 * i + 0.3 * s + 1e-4 * (-1)**(s + int(1e3 * i)))}
                             for s in range(4) for i in (1e-3, 2e-3, 5e-3)])
        found = {paired: evidence.slopes_of(runs, "made", ["q"], ["inertia"], paired=paired).iloc[0]
                 for paired in (False, True)}
        self.assertAlmostEqual(found[True]["slope"], 5.0, delta=0.1)
        self.assertLess(found[True]["error"], 0.05)
        self.assertGreater(found[False]["error"], 10.0)

    def test_of_means_with_errors(self):
        means = pd.DataFrame({"narrowness": [0.0, 1.0], "q": [1.0, math.e], "q_error": [0.3, 0.4]})
        self.assertTrue(evidence.slopes_of(means, "made", ["q"], ["narrowness"]).empty)  # nothing to judge by
        means = pd.DataFrame({"narrowness": [0.0, 0.0, 1.0], "q": [1.0, 1.0, math.e], "q_error": [0.3, 0.3, 0.4]})
        found = evidence.slopes_of(means, "made", ["q"], ["narrowness"]).iloc[0]
        self.assertAlmostEqual(found["slope"], 1.0)
        self.assertAlmostEqual(found["error"], math.sqrt(0.3**2 / 2 + 0.4**2))

    TABLE = pd.DataFrame([
        {"family": "a", "study": "a", "quantity": "q", "number": "narrowness", "slope": -1.0, "error": 0.1,
         "least": 0.02, "most": 0.1, "misfit": 0.0, "included": "inertia=0.004"},
        {"family": "b", "study": "b", "quantity": "q", "number": "narrowness", "slope": -2.0, "error": 0.1,
         "least": 0.02, "most": 0.15, "misfit": 0.0, "included": ""}])

    def test_the_mean_of_studies_has_their_scatter(self):
        found = evidence.effect(self.TABLE, "q", "narrowness")
        self.assertAlmostEqual(found.slope, -1.5)
        # DerSimonian and Laird with two studies of variance v: tau^2 = (difference^2/2) - v
        self.assertAlmostEqual(found.scatter**2, 0.5 - 0.01)
        self.assertAlmostEqual(found.error**2, (0.49 + 0.01) / 2)
        self.assertEqual(found.most, 0.15)

    def test_studies_of_the_same_packings_count_once(self):
        table = pd.concat([self.TABLE[:1]] * 10).assign(study=list("abcdefghij"))
        found = evidence.effect(table, "q", "narrowness")
        self.assertAlmostEqual(found.error, 0.1)
        self.assertAlmostEqual(found.scatter, 0.0)
        self.assertEqual(found.studies, 1)  # of which the degrees of freedom of an interval come

    def test_prediction(self):
        found = evidence.predict(self.TABLE, "q", {"narrowness": (0.01, 0.11)})
        spread = math.sqrt(0.1**2 * (0.49 + 0.25))
        self.assertAlmostEqual(found.error, math.expm1(-0.15))
        self.assertAlmostEqual(found.low, math.expm1(-0.15 - stats.t.ppf(0.95, 1) * spread))
        self.assertEqual(found.outside, ())

    def test_degrees_of_freedom_are_those_of_the_larger_part(self):
        other = self.TABLE[:1].assign(number="weight", slope=0.0, error=0.5, family="c")
        table = pd.concat([self.TABLE, other])
        found = evidence.predict(table, "q", {"narrowness": (0.0, 0.1), "weight": (0.0, 0.1)})
        parts = [0.1**2 * (0.49 + 0.25), 0.1**2 * 0.5**2]
        freedom = sum(parts)**2 / (parts[0]**2 + parts[1]**2)
        self.assertAlmostEqual(math.log1p(found.high), -0.15 + math.sqrt(sum(parts)) * stats.t.ppf(0.95, freedom))

    def test_errors_of_coefficients_are_added(self):
        found = evidence.predict(self.TABLE, "q", {}, of_coefficients=0.1)
        self.assertAlmostEqual(found.high, math.expm1(0.1 * stats.norm.ppf(0.95)))

    def test_what_is_outside_the_evidence_is_named(self):
        self.assertIn("d/W, diameter over width of 0.2, evidence for q ends at 0.15",
                      evidence.predict(self.TABLE, "q", {"narrowness": (0.01, 0.2)}).outside)
        self.assertIn("no evidence how q depends on delta/d, overlap over diameter",
                      evidence.predict(self.TABLE, "q", {"overlap": (0.01, 0.02)}).outside)
        self.assertEqual(evidence.predict(self.TABLE, "q", {"overlap": (0.02, 0.02)}).outside, ())
        # nor may both be where no study was
        self.assertIn("d/W, diameter over width of 0.2, the studies end at 0.15",
                      evidence.predict(self.TABLE, "q", {"narrowness": (0.2, 0.2)}).outside)
        self.assertEqual(evidence.predict(self.TABLE, "q", {"narrowness": (0.1, 0.1)}).outside, ())
        self.assertEqual(evidence.predict(self.TABLE, "q", {"inertia": (1e-5, 9e-4)}).outside, ())
        # up to 4e-3 the effect of inertia is in a slope over d/W
        self.assertEqual(len(evidence.predict(self.TABLE, "q", {"inertia": (1e-5, 3.9e-3)}).outside), 0)
        self.assertEqual(len(evidence.predict(self.TABLE, "q", {"inertia": (1e-5, 5e-3)}).outside), 1)

    def test_what_is_the_same_needs_no_study_below_what_is_harmless(self):
        table = self.TABLE.assign(number="inertia", most=1e-4)
        for value, outside in ((9e-4, 0), (2e-3, 1)):
            self.assertEqual(len(evidence.predict(table.assign(included=""), "q", {"inertia": (value, value)}).outside), outside)

    def test_loose_starts_are_predicted_as_they_were(self):
        # With gravity over s the bed presses itself less, with the same gravity it does not: strains differ by ten percent.
        runs = pd.read_csv(ROOT / "examples" / "scale_collapse" / "results" / "evidence_runs.csv")
        table = evidence.read()
        powder = Powder(1e-3, 2000.0, 1e-3, 5e2, 1e3, 5e2, -2e-4)
        loading = Loading(0.03, 0.03, 0.0376, 0.5, 625.0, 10e3, 0.2, 0.2, 9.81)
        for group, scaled in (("loose", True), ("loose_true_weight", False)):
            for d, some in runs[runs["group"] == group].groupby("d"):
                # the effect of the inertial number is in the other slopes
                fine, coarse = (plan.numbers_of(powder, loading, x, scaled) for x in (1e-3, d))
                for quantity, off in (("strain", 0.03), ("porosity_before", 4e-3), ("porosity", 4e-3), ("coordination", 0.01)):
                    found = evidence.predict(table, quantity, {n: (fine[n], coarse[n]) for n in fine if n != "inertia"})
                    measured = np.log(some[quantity]).mean() - np.log(runs.loc[runs["group"] == "loose_fine", quantity]).mean()
                    self.assertAlmostEqual(math.log1p(found.error), measured, delta=off, msg=(group, d, quantity))
                    self.assertEqual(found.outside, ())
                    self.assertTrue(found.low <= math.expm1(measured) <= found.high)

    def test_the_packages_table_is_whole(self):
        table = evidence.read()
        self.assertFalse(table.drop(columns="included").isna().any().any())
        self.assertTrue(set(table["number"]) <= set(evidence.NUMBERS))
        self.assertTrue((table["error"] > 0.0).all())


class Plan(unittest.TestCase):
    powder = Powder(1e-3, 2000.0, 1e-3, 5e3, 1e4, 5e3, -1e-4)
    loading = Loading(0.03, 0.03, 0.03, 0.6, 15e3, 1e5, 0.5, 0.2, 9.81)

    def test_time_step_is_that_of_the_in_files(self):
        # 0.95 times 0.2 sqrt(m/k2)
        mass = 2000.0 * math.pi / 6.0 * 1e-9
        self.assertAlmostEqual(self.powder.time_step(1e-3), 0.19 * math.sqrt(mass / 1e4))
        self.assertAlmostEqual(self.powder.time_step(2e-3) / self.powder.time_step(1e-3), 2.0)

    def test_what_scaling_keeps(self):
        small, large = (plan.numbers_of(self.powder, self.loading, d, True) for d in (1e-3, 2e-3))
        self.assertAlmostEqual(large["narrowness"] / small["narrowness"], 2.0)
        self.assertAlmostEqual(large["inertia"] / small["inertia"], 2.0)
        self.assertAlmostEqual(large["overlap"], small["overlap"])
        self.assertAlmostEqual(large["weight"], small["weight"])
        true = plan.numbers_of(self.powder, self.loading, 2e-3, False)
        self.assertAlmostEqual(true["weight"], 2.0 * small["weight"])
        # what it does not keep with gravity over s: what the bed presses itself with
        self.assertAlmostEqual(small["bed"], 2000.0 * 0.6 * 9.81 * 0.03 / 15e3)
        self.assertAlmostEqual(large["bed"], 0.5 * small["bed"])
        self.assertAlmostEqual(true["bed"], small["bed"])

    def test_overlaps_are_those_that_were_measured(self):
        runs = pd.read_csv(ROOT / "examples" / "scale_collapse" / "results" / "evidence_runs.csv")
        for group, stress, loose in (("width", 96e3, False), ("loose", 10e3, True)):
            for _, run in runs[runs["group"] == group].iterrows():
                powder = Powder(run["d"], run["density"], run["dref"], run["k1"], run["k2"], run["kadh"], run["f0"])
                self.assertAlmostEqual(powder.overlap(stress, loose) / run["overlap"], 1.0, delta=0.05)
        # attraction alone, too
        self.assertAlmostEqual(Powder(1e-3, 2000, 1e-3, 5e3, 1e4, 0, -5.0).overlap(1e3), 1.0, delta=1e-3)

    def test_the_narrowest_side_counts(self):
        flat = dataclasses.replace(self.loading, height=0.01)
        self.assertAlmostEqual(plan.numbers_of(self.powder, flat, 1e-3, True)["narrowness"], 0.1)

    def test_too_few_and_too_many_particles_are_named(self):
        for width, d in ((0.01, 2e-3), (10.0, 1e-3)):
            loading = Loading(width, width, width, 0.6, 15e3, 1e5, 0.5, 0.2, 0.0)
            one = plan.line(self.powder, loading, d, {"q": 0.9}, Evidence.TABLE, plan.Speed(1e7), True)
            self.assertRegex(" ".join(one.objections), "particles, allowed are 250")

    def test_particles_and_steps(self):
        self.assertEqual(self.loading.particles(1e-3), round(0.6 * 27e-6 / (math.pi / 6 * 1e-9)))
        self.assertEqual(self.loading.steps(1e-6), 400000)

    def test_the_cheapest_without_objection_is_taken(self):
        table = Evidence.TABLE
        lines = [plan.line(self.powder, self.loading, d, {"q": 0.9}, table, plan.Speed(1e7), True)
                 for d in (1e-3, 2e-3, 3e-3, 6e-3)]
        self.assertEqual([bool(one.objections) for one in lines], [False, False, False, True])
        self.assertEqual(plan.best(lines).diameter, 3e-3)
        self.assertIsNone(plan.best(lines[3:]))
        self.assertAlmostEqual(lines[1].core_seconds, lines[1].particles * lines[1].steps / 1e7)

    def test_softer_stiffnesses_count_as_deeper_overlaps(self):
        table = Evidence.TABLE.assign(number="overlap", most=0.2)
        soft = self.powder.softened(4.0)
        self.assertAlmostEqual(soft.time_step(2e-3), 2.0 * self.powder.time_step(2e-3))
        wide = Loading(10.0, 10.0, 10.0, 0.6, 5e3, 1e5, 0.05, 0.2, 0.0)
        one = plan.line(self.powder, wide, 1e-3, {"q": 0.9}, table, plan.Speed(1e7), True, simulated=soft)
        # four times 0.43 p d/k1 - f0/(k1 d) instead of once, at slopes of -1 and -2
        self.assertAlmostEqual(one.predictions["q"].error, math.expm1(-1.5 * 3 * (0.43 * 0.02 + 2e-5)), places=6)

    def test_what_is_not_known_of_the_coefficients_is_an_objection(self):
        for calibrated, said in (({"q": 0.01}, 0), ({"q": math.nan}, 1), ({}, 1), (None, 0)):
            one = plan.line(self.powder, self.loading, 2e-3, {"q": 0.9}, Evidence.TABLE, plan.Speed(1e7), True, calibrated)
            self.assertEqual(len(one.objections), said, one.objections)

    def test_a_series_begins_with_the_real_diameter(self):
        powder = Powder(1.04e-3, 2000.0, 1e-3, 5e3, 1e4, 5e3, -1e-4)
        found = plan.series(powder, self.loading)
        self.assertEqual(found[0], 1.04e-3)
        self.assertEqual(plan.series(Powder(9e-3, 2000.0, 1e-3, 5e3, 1e4, 5e3, -1e-4), self.loading), [9e-3])

    def test_bad_values_are_named(self):
        for make, said in ((lambda: Powder(1e-3, 2000, 1e-3, 5e3, 4e3, 0, 0), "k2 is 4000, allowed is k1"),
                           (lambda: Powder(1e-3, 2000, 1e-3, 5e3, 1e4, 0, 1), "f0 is 1, allowed are numbers 0 or less"),
                           (lambda: Powder(0.0, 2000, 1e-3, 5e3, 1e4, 0, 0), "diameter is 0"),
                           (lambda: Loading(1, 1, 1, 0.6, 2, 1, 1, 1, 0), "rising"),
                           (lambda: Loading(1, 1, 1, 1.2, 1, 2, 1, 1, 0), "solid fraction is 1.2")):
            with self.subTest(said), self.assertRaisesRegex(ValueError, said):
                make()


class Calibrate(unittest.TestCase):
    start = {"k1": 5e3, "kadh": 5e3, "f0": -1e-4, "mu": 0.5, "mur": 1e-3}
    TARGETS = pd.DataFrame({"quantity": ["strain", "strength"], "stress": [9e4, 9.6e4], "value": [0.02, 1.5e4],
                            "error": [2e-4, 3e2]})

    @staticmethod
    def simulate(sets, seeds=3, scatter=0.0):
        """Strain falls with k1, strength rises with kadh and falls with k1; packings scatter, the same ones for
        every set."""
        noise = scatter * np.random.default_rng(7).standard_normal((seeds, 2))
        return [np.exp(noise) * [0.025 * (values["k1"] / 5e3)**-0.9,
                                 1.2e4 * (values["kadh"] / 5e3)**0.7 * (values["k1"] / 5e3)**-0.2] for values in sets]

    def test_finds_the_coefficients(self):
        found = calibrate.fit(self.start, ["k1", "kadh"], self.TARGETS, self.simulate, 12)
        k1 = (0.025 / 0.02)**(1 / 0.9)
        kadh = (1.5e4 / 1.2e4 * k1**0.2)**(1 / 0.7)
        self.assertAlmostEqual(found.values["k1"] / 5e3, k1, places=4)
        self.assertAlmostEqual(found.values["kadh"] / 5e3, kadh, places=4)
        self.assertAlmostEqual(found.values["mu"], 0.5)
        # Errors of the targets, 1 and 2%, through the inverse of the powers; the packings do not scatter.
        self.assertAlmostEqual(found.errors["k1"], 0.01 / 0.9, places=5)
        self.assertAlmostEqual(found.errors["kadh"], math.hypot(0.02, 0.01 * 0.2 / 0.9) / 0.7, places=4)
        self.assertAlmostEqual(found.found["error_of_coefficients"][0], 0.01, places=5)
        self.assertAlmostEqual(found.found["error_of_coefficients"][1], 0.02, places=5)

    def test_scatter_of_packings_is_in_the_errors(self):
        found = calibrate.fit(self.start, ["k1"], self.TARGETS[:1].assign(error=np.nan),
                              lambda sets: [one[:, :1] for one in self.simulate(sets, 6, 0.03)], 12)
        noise = 0.03 * np.random.default_rng(7).standard_normal((6, 2))[:, 0]
        self.assertAlmostEqual(found.errors["k1"], noise.std(ddof=1) / math.sqrt(6) / 0.9, places=4)

    def test_a_single_packing_has_no_error(self):
        found = calibrate.fit(self.start, ["k1"], self.TARGETS[:1],
                              lambda sets: [one[:, :1] for one in self.simulate(sets, 1)], 12)
        self.assertTrue(math.isnan(found.errors["k1"]))
        self.assertIn("its error is not known", calibrate.include_file(found, ["k1"], ""))

    def test_a_coefficient_at_its_bound_is_told(self):
        far = self.TARGETS.assign(value=[2.0, 1.5e4])    # strain in percent
        found = calibrate.fit(self.start, ["k1"], far, self.simulate, 12)
        self.assertIn("k1 went as far as it may, a factor of 4", found.message)

    def test_what_is_known_is_not_simulated_again(self):
        seen = []

        def simulate(sets):
            seen.extend(tuple(values.items()) for values in sets)
            return self.simulate(sets)
        calibrate.fit(self.start, ["k1", "kadh"], self.TARGETS, simulate, 12)
        self.assertEqual(len(seen), len(set(seen)))

    def test_bad_targets_are_named(self):
        for text, said in (("quantity\nstrain\n", "no column value"),
                           ("quantity,value\ncolour,1\n", "target 1 is colour, allowed are strain"),
                           ("quantity,value\nstrain,1\n", "strain, needs a stress above 0"),
                           ("quantity,stress,value\nsteady_angle,5,1\n", "steady_angle, has no stress"),
                           ("quantity,stress,value\nstrength,5,0\n", "value 0, allowed are numbers above 0"),
                           ("quantity,stress,value\nstrain,20 kPa,1\n", "stress 20 kPa: allowed are numbers"),
                           ("quantity,stress,value\nstrain,5,4%\n", "value 4%: allowed are numbers"),
                           ("quantity,stress,value\nstrain,5,inf\n", "value inf: allowed are numbers"),
                           ("quantity,stress,value\n", "it has no target")):
            with self.subTest(said), tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "targets.csv"
                path.write_text(text)
                with self.assertRaisesRegex(ValueError, said):
                    calibrate.read_targets(path)
        with self.assertRaisesRegex(ValueError, "free coefficient e, allowed are"):
            calibrate.fit(self.start, ["e"], self.TARGETS, self.simulate)
        with self.assertRaisesRegex(ValueError, "2 free coefficients and 1 targets"):
            calibrate.fit(self.start, ["k1", "kadh"], self.TARGETS[:1], self.simulate)
        with self.assertRaisesRegex(ValueError, "kadh starts at 0"):
            calibrate.fit({**self.start, "kadh": 0.0}, ["kadh"], self.TARGETS, self.simulate)


class Report(unittest.TestCase):
    def runs(self):
        rows = [{"run": f"g/d={d},seed={s}", "group": "g", "d": d, "scaled": "yes", "seed": float(s), "mu": 0.5,
                 "strain": 0.02 + 0.001 * s, "strength_96e3": 1e4 * d * (1 + 0.01 * s)}
                for d in (1.0, 2.0) for s in (1, 2, 3)]
        curves = [pd.DataFrame({"stress": [1.0, 2.0], "strain": [0.0, 0.01 * s], "porosity": [0.4, 0.39],
                                "coordination": [5.0, 6.0], "run": f"g/d={d},seed={s}", "branch": "load"})
                  for d in (1.0, 2.0) for s in (1, 2, 3)]
        runs = pd.DataFrame(rows).set_index("run")
        runs.attrs["results"] = ["strain", "strength_96e3"]
        return runs, pd.concat(curves)

    def test_means_are_over_the_seeds(self):
        runs, _ = self.runs()
        self.assertEqual(report.varied(runs, runs.attrs["results"]), ["d"])
        means = report.means(runs, runs.attrs["results"])
        self.assertEqual(list(means["seeds"]), [3, 3])
        self.assertAlmostEqual(means.loc[2.0, "strength_96e3"], 2.04e4)
        self.assertAlmostEqual(means.loc[2.0, "strength_96e3_error"], 200.0 / math.sqrt(3))

    def test_results_of_other_in_files_have_their_own_names(self):
        runs = pd.DataFrame([{"run": f"check/d={d},seed={s}", "group": "check", "d": d, "seed": float(s), "flow": 3.0 * d + 0.1 * s,
                              "particles": 100, "seconds": 1.0} for d in (1.0, 2.0) for s in (1, 2)]).set_index("run")
        runs.attrs["results"] = ["flow"]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "report.html"
            report.write(path, "own", runs, pd.DataFrame(), Path(folder))
            text = path.read_text()
        self.assertIn('"text":"flow"', text)
        self.assertIn("6.15 ± 0.05", text)
        self.assertNotIn("axial strain of the bulk", text)

    def test_runs_that_differ_in_their_seeds_alone(self):
        runs = pd.DataFrame([{"run": f"g/seed={s}", "group": "g", "seed": float(s), "flow": 3.0 + 0.1 * s} for s in (1, 2)]).set_index("run")
        self.assertAlmostEqual(report.means(runs, ["flow"])["flow"].iloc[0], 3.15)

    def test_is_one_file_with_everything(self):
        runs, curves = self.runs()
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "g/d=1.0,seed=1/after/crush.500.png"
            picture.parent.mkdir(parents=True)
            picture.write_bytes(b"not really a picture")
            path = Path(folder) / "report.html"
            report.write(path, "A <title>", runs, curves, Path(folder),
                         pd.DataFrame({"quantity": ["strain"], "verdict": ["equivalent"]}))
            text = path.read_text()
        self.assertIn("A &lt;title&gt;", text)
        for said in ('"name":"d 1"', '"name":"d 2"', "strength after 96e3 Pa", "<td>equivalent</td>",
                     "2.04e+04 ± 1.2e+02", "seed=1: after failure"):
            self.assertIn(said, text)
        # Nothing is fetched; what Plotly's own code has in its comments does not count.
        own = re.sub(r"<script.*?</script>", "", text, flags=re.DOTALL)
        self.assertIn("<td>equivalent</td>", own)
        self.assertIsNone(re.search(r'(src|href)="https?:', own))


class Commands(unittest.TestCase):
    words = ["plan", "--diameter", "50e-6", "--density", "2700", "--k1", "250", "--kadh", "250", "--f0", "-1e-7",
             "--width", "0.03", "--stress", "5e3", "1e5", "--rate", "0.05", "--speed", "9e6"]

    def test_plan_writes_an_include_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "in.coarse"
            status, text = call(*self.words, "--want", "porosity=5", "--diameters", "1e-3", "2e-3", "--write", path)
            self.assertEqual(status, 0, text)
            self.assertIn("Cheapest that may be used: 2 mm", text)
            written = path.read_text()
        self.assertRegex(written, r"variable d +index 0\.002\n")
        self.assertRegex(written, r"variable f0 +index -1e-07\n")
        # at dref = 50 um packed as stiffly and as fast as 1 mm with 5e3 N/m and 1/s
        self.assertRegex(written, r"variable kpack +index 250\n")
        self.assertRegex(written, r"variable packrate +index 20\n")
        self.assertRegex(written, r"variable level +index 100000\n")
        self.assertRegex(written, r"variable ppack +index 4000\n")

    def test_plan_without_a_diameter_says_so(self):
        status, text = call(*self.words, "--want", "porosity=0.01", "--diameters", "2e-3")
        self.assertEqual(status, 3, text)
        self.assertIn("No diameter may be used", text)
        self.assertIn("2 mm: porosity is off by", text)

    def test_what_is_far_outside_is_refused_and_told(self):
        for words in (["--rate", "5e3"], ["--soften", "3e4"], ["--f0", "-7.5"], ["--height", "2e-3"], ["--width", "30"]):
            status, text = call(*self.words, "--want", "strain=50", "--diameters", "1e-3", *words)
            self.assertEqual(status, 3, text)
            self.assertIn("No diameter may be used", text)

    def test_mistakes_are_named(self):
        for words, said in (
                ([*self.words, "--want", "colour=5"], "--want colour: no evidence, there is some for"),
                ([*self.words, "--want", "porosity"], "--want porosity: allowed is NAME=PERCENT"),
                ([*self.words, "--want", "porosity=200"], "allowed is NAME=PERCENT with more than 0"),
                ([*self.words, "--want", "porosity=5", "--diameters", "1e-5"], "--diameters 1e-05: allowed are 5e-05"),
                ([*self.words, "--want", "porosity=5", "--length", "1", "--write", "x"], "--length is 1: the include file"),
                ([*self.words, "--want", "porosity=5", "--smallest", "0.5", "--write", "x"], "--smallest is 0.5: the include file is for equal"),
                ([*self.words, "--want", "flow=5", "--gravity", "9.81", "--true-gravity", "--write", "x"], "--want has flow, of a machine"),
                ([*self.words, "--want", "flow=5"], "--want flow: the machines' studies had the same gravity"),
                ([*self.words, "--want", "friction_angle=5", "--gravity", "9.81"], "give --gravity 9.81 --true-gravity"),
                ([*self.words, "--want", "porosity=5", "--true-gravity"], "--true-gravity needs --gravity"),
                ([*self.words, "--want", "porosity=5", "--write", "/no/where"], "there is no such folder"),
                ([*self.words, "--want", "porosity=5", "--width", "1e-160"], "width is 1e-160 m, allowed are"),
                ([*self.words, "--want", "porosity=5", "--gravity", "9810"], "gravity is 9810 m/s^2, allowed are 0 to"),
                ([*self.words, "--want", "porosity=5", "--smallest", "1e-6"], "smallest is 1e-06, allowed are 0.1 to 1"),
                ([*self.words, "--want", "porosity=5", "--diameters", "1e-3", "1e-3"], "each once"),
                ([*self.words, "--want", "porosity=5", "--diameters", "1"], "allowed are numbers up to the narrowest side, 0.03"),
                ([*self.words, "--want", "porosity=5", "porosity=6"], "porosity is there twice"),
                ([*self.words, "--want", "porosity=5", "--diameters", "nan"], "--diameters nan: allowed are numbers"),
                ([*self.words, "--want", "porosity=5", "--dref", "0"], "reference is 0"),
                ([*self.words, "--want", "porosity=5", "--height", "0"], "height is 0"),
                ([*self.words, "--want", "porosity=5", "--speed", "-1"], "speed is -1"),
                ([*self.words, "--want", "porosity=5", "--diameter", "50"], "diameter is 50 m, allowed are 1e-07 to 0.1"),
                ([*self.words, "--want", "porosity=5", "--density", "2.7"], "density is 2.7 kg/m^3, allowed are 50 to"),
                ([*self.words, "--want", "porosity=5", "--soften", "0.5"], "stiffnesses are divided by 0.5, allowed is 1"),
                (["check", "in.none", "--diameters", "1", "2", "--want", "a=1"], "there is no in.none"),
                (["check", __file__, "--diameters", "1", "--want", "a=1"], "allowed are two or more, each once"),
                (["check", __file__, "--diameters", "1", "2", "--want", "a=1", "--seeds", "1"], "--seeds is 1"),
                (["run", "none.yaml"], "there is no none.yaml")):
            with self.subTest(said):
                status, text = call(*words)
                self.assertEqual(status, 1, text)
                self.assertIn(said, text)
                self.assertNotIn("Traceback", text)

    def test_mistakes_of_calibrate_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            targets = Path(folder) / "targets.csv"
            targets.write_text("quantity,stress,value\nstrain,2e4,0.005\n")
            for words, said in ((["--diameter", "nan"], "diameter is nan"), (["--seeds", "0"], "--seeds is 0"), (["--k1", "nan"], "k1 is nan"),
                                (["--free", "k1", "k1"], "allowed is each once"), (["--dref", "0"], "reference is 0"),
                                (["--side", "1e-3"], "--side is 0.001, allowed are numbers from 0.012"), (["--mu", "-1"], "--mu is -1")):
                with self.subTest(said):
                    status, text = call("calibrate", targets, "--diameter", "2e-3", *words)
                    self.assertEqual(status, 1, text)
                    self.assertIn(said, text)

    def test_options(self):
        self.assertEqual(diameters([2.0, 1.0]), [1.0, 2.0])
        self.assertEqual(percentages(["a=5", "b=2.5%"]), {"a": 0.05, "b": 0.025})


if __name__ == "__main__":
    unittest.main()

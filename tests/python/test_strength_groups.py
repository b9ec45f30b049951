# SPDX-License-Identifier: GPL-2.0-only
"""The study of strength from results to verdicts, on groups whose every number is known. LAMMPS is
not needed."""
from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

STUDY = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path.insert(0, str(STUDY))

from collapse import analysis, claims, curves, fits, groups, measured, plan  # noqa: E402
from collapse import strength_report, strength_tables  # noqa: E402
from collapse.measured import Cost  # noqa: E402
from collapse.statistics import Value  # noqa: E402

COST = Cost(100, 1.0, 1000, 0.5, 500)


def strengths(values):
    """Results of crushing by seed that have nothing but a strength."""
    return {seed: SimpleNamespace(strength=value) for seed, value in values.items()}


class Groups(unittest.TestCase):
    def test_of_what_a_group_is_compared_with(self):
        def group(diameter, mode="scaled", special="", rate=0.5, results=(1, 2, 3),
                  material=plan.BASE):
            by_seed = dict(enumerate(results, 1))
            return groups.Group(material, diameter, mode, special, rate, confined=by_seed,
                                unconfined={96.0e3: by_seed})
        full = plan.full()
        some = {g.key: g for g in [
            group(2.0e-3), group(1.0e-3), group(2.0e-3, "unscaled"),
            group(1.0e-3, special="15 mm wide"),
            group(2.0e-3, special="0.25/s", rate=0.25, results=(7, 8)),
            group(2.5e-3, special="0.25/s", rate=0.25)]}
        compared = groups.references(some, full)
        finest = some["base", "scaled", 1.0e-3, ""]
        for key, reference in compared.items():
            if "/s" not in key[3]:
                self.assertIs(reference, finest)
        slow = compared["base", "scaled", 2.0e-3, "0.25/s"]
        self.assertEqual((slow.diameter, slow.mode, slow.special), (2.0e-3, "scaled", ""))
        # Only the packings that were run at both rates.
        self.assertEqual((slow.confined, slow.unconfined), ({1: 1, 2: 2}, {96.0e3: {1: 1, 2: 2}}))
        # What has not been run is not replaced by the next.
        self.assertIsNone(compared["base", "scaled", 2.5e-3, "0.25/s"])
        del some[finest.key]
        self.assertEqual(set(list(groups.references(some, full).values())[:3]), {None})
        # plateau is planned from 1.5 mm on
        plateau = [group(d, material=plan.PLATEAU) for d in (3.0e-3, 1.5e-3)] + [finest]
        self.assertIs(groups.references({g.key: g for g in plateau}, full)[plateau[0].key],
                      plateau[1])

    def test_runs_that_are_not_finished_are_left_out(self):
        quick, asked = plan.quick(1), []
        self.assertEqual(groups.group_results(quick, Path("/nowhere"),
                                              lambda run: asked.append(run)), {})
        self.assertEqual(asked, list(quick.runs))
        with self.assertRaisesRegex(ValueError, "nothing to report on"):
            strength_report.write(quick, Path("/nowhere"), Path("lmp"), lambda run: False)

    def test_flow_function_has_a_line_for_each_seed(self):
        group = groups.Group(plan.BASE, 1.0e-3, "scaled", confined={1: None, 2: None}, unconfined={
            1.0e4: strengths({1: 1.0e3, 2: 2.0e3}), 2.0e4: strengths({1: 2.0e3, 2: 3.2e3})})
        flow = fits.flow_function(group)
        self.assertAlmostEqual(flow.slope.value, 0.11)
        self.assertAlmostEqual(flow.slope.error, 0.01)


class FreeExponents(unittest.TestCase):
    """Strength that goes as the coefficient^0.8, each packing stronger or weaker than the next."""

    LAST = plan.full().levels[-1]
    SCATTER = {1: 0.9, 2: 1.0, 3: 1.15}

    def groups(self, law_falls_behind):
        found = {}
        full = plan.full()
        for material, diameter in [(plan.BASE, full.diameters[0])] + [
                (material, d) for d in full.fitted
                for material in (plan.BASE, *(plan.stickier(plan.BASE, f)
                                              for f in plan.FACTORS))]:
            factor = material.kadh / plan.BASE.kadh
            size = diameter / full.diameters[0]
            values = {seed: 1.0e4 * shift * (factor * size**-law_falls_behind) ** 0.8
                      for seed, shift in self.SCATTER.items()}
            one = groups.Group(material, diameter, "scaled",
                               unconfined={self.LAST: strengths(values)})
            found[one.key] = one
        return found

    def test_exponent_is_recovered_seed_by_seed(self):
        for behind in (0.0, 0.15):
            fit, = fits.free_exponents(self.groups(behind), plan.full())
            self.assertEqual((fit.what, fit.expected), ("k_adh", 1.0))
            self.assertAlmostEqual(fit.exponent.value, 1.0 + behind, delta=0.01)
        # The seeds' scatter is in the best factors once, though three runs share each packing.
        expected = np.std([math.log(v) for v in self.SCATTER.values()], ddof=1) / 0.8 / 3**0.5
        self.assertAlmostEqual(fit.logs[0].error, expected, delta=1e-9)
        # and that of the finest particles comes on top, common to all diameters
        own = fits.exponent_from_reference([2.0, 2.5, 3.0], [0.0] * 3, [expected] * 3, 0.0).error
        self.assertGreater(fit.exponent.error, 1.3 * own)
        self.assertFalse(fit.extrapolated)
        self.assertTrue(fits.free_exponents(self.groups(0.4), plan.full())[0].extrapolated)

    def test_an_effect_of_size_is_not_in_the_exponent_at_equal_width(self):
        """Strength falls by width in diameters^0.2, whatever the diameter is."""
        full, found = plan.full(), self.groups(0.0)
        for group in found.values():
            across = full.side / group.diameter
            for result in group.unconfined[self.LAST].values():
                result.strength *= across**0.2
        finest = full.diameters[0]
        for diameter in full.fitted[:2]:  # that of the last has not been run
            across = full.side / diameter
            one = groups.Group(plan.BASE, finest, "scaled", f"{across:g} wide",
                               side=finest * across, unconfined={self.LAST: strengths(
                                   {seed: 1.0e4 * shift * across**0.2
                                    for seed, shift in self.SCATTER.items()})})
            found[one.key] = one
        usual, equal = fits.free_exponents(found, full)
        self.assertEqual((usual.equal_width, equal.equal_width), (False, True))
        self.assertAlmostEqual(usual.exponent.value, 1.0 + 0.2 / 0.8, delta=0.01)
        self.assertAlmostEqual(equal.exponent.value, 1.0, delta=0.01)
        self.assertEqual(equal.diameters, list(full.fitted[:2]))
        # packings of a seed are as much stronger than the next at either size
        self.assertAlmostEqual(equal.logs[0].error, 0.0)
        # and where they scatter apart, that is in the exponent
        for group in found.values():
            if group.special:
                for seed, factor in ((1, 1.02), (3, 0.98)):
                    group.unconfined[self.LAST][seed].strength *= factor
        _, apart = fits.free_exponents(found, full)
        own = np.std([math.log(1.02), 0.0, math.log(0.98)], ddof=1) / 0.8 / 3**0.5
        self.assertAlmostEqual(apart.logs[0].error, own, delta=1e-9)
        alone = fits.exponent_from_reference([d / finest for d in apart.diameters], [0.0] * 2,
                                             [own] * 2, 0.0)
        self.assertAlmostEqual(apart.exponent.error, alone.error)
        # a packing that the other size does not have is left out
        del found[one.key].unconfined[self.LAST][3]
        _, fewer = fits.free_exponents(found, full)
        self.assertAlmostEqual(fewer.logs[1].value - math.log(full.fitted[1] / finest),
                               math.log(1.02) / 2.0 / 0.8, delta=0.005)


def confined_result(size, seed, strain, z=6.0, seconds=10.0, inertial=4e-4):
    """Stress over strain straight to 96 kPa at `strain`; the seeds scatter by 1% in strain."""
    stress = np.linspace(5.0e3, 96.0e3, 200)
    reached = strain * (1.0 + 0.01 * (seed - 2)) * (stress - 5.0e3) / 91.0e3
    branch = curves.Branch({"bulk": reached, "platen": reached}, stress, 0.36 - 0.5 * reached,
                           0.37 - reached, np.full(200, z), np.full(200, z + 0.4))
    back = curves.Branch({"bulk": reached[::-1], "platen": reached[::-1]}, stress[::-1],
                         *(getattr(branch, name) for name in (
                             "bulk_porosity", "porosity", "coordination", "bulk_coordination")))
    curve = curves.Curve(branch, back, 0.37, 0.36, z, 0.03)
    return measured.ConfinedResult(curve, measured.Moduli(9.0e6 / size, 5.0e6 / size, 0.4),
                                   inertial, Cost(1000, 3.0 * seconds, 300, seconds, 100))


def crushed_result(strength, z=5.0):
    strain = np.linspace(1e-3, 0.02, 90)
    return measured.UnconfinedResult(
        strain, strength * strain / 0.02, strength, 0.01, True, measured.Moduli(1.0, 1.0, 0.0), 0.4,
        z, 2.0e-3, 1.25 * z, 6e-4, COST)


class Rows(unittest.TestCase):
    """Groups whose every number is known, from the results to the verdicts."""

    def setUp(self):
        self.full, self.last = plan.full(), plan.full().levels[-1]

    def group(self, diameter, mode="scaled", special="", strain=0.03, strength=1.0e4, z=6.0,
              seconds=10.0, **given):
        return groups.Group(
            plan.BASE, diameter, mode, special, **given,
            confined={seed: confined_result(1.0, seed, strain, z, seconds) for seed in (1, 2, 3)},
            unconfined={self.last: {seed: crushed_result(strength * (1.0 + 0.02 * (seed - 2)))
                                    for seed in (1, 2, 3)}})

    def rows(self, *some):
        return {(r.mode, r.diameter_mm, r.special): r
                for r in analysis.make_rows({g.key: g for g in some}, self.full)}

    def test_deviations_are_what_was_put_in(self):
        rows = self.rows(self.group(1.0e-3, seconds=100.0),
                         self.group(2.0e-3, strain=0.0306, strength=0.9e4, z=6.12, seconds=5.0))
        fine, coarse = rows["scaled", 1.0, ""], rows["scaled", 2.0, ""]
        self.assertTrue(math.isnan(fine.loading_deviation.value))
        self.assertTrue(math.isnan(fine.speed_up.value))
        # Softer by 2%: stress at equal strain is lower by 2/1.02% of what it has risen by.
        self.assertAlmostEqual(coarse.loading_deviation.value, 100.0 * (1.0 - 1.0 / 1.02)
                               * 91.0 / 96.0 / math.sqrt(3.0), delta=0.02)
        self.assertLess(coarse.loading_mean_deviation, -0.8)
        self.assertAlmostEqual(coarse.coordination_deviation.value, 2.0)
        self.assertAlmostEqual(coarse.bulk_coordination_deviation.value, 100.0 * 0.12 / 6.4)
        self.assertAlmostEqual(coarse.cut_coordination.value, -20.0)
        self.assertAlmostEqual(coarse.strength_deviation[self.last].value, -10.0)
        error = 100.0 * 0.9 * 0.02 / math.sqrt(3.0) * math.sqrt(2.0)
        self.assertAlmostEqual(coarse.strength_deviation[self.last].error, error)
        self.assertAlmostEqual(coarse.crush_deviation[self.last].value, 10.0 / math.sqrt(3.0),
                               delta=0.2)
        self.assertAlmostEqual(coarse.strain.value, 0.0306 * (86.4 - 5.0) / 91.0)
        self.assertEqual((coarse.speed_up.value, coarse.whole_speed_up.value), (20.0, 20.0))
        self.assertEqual((coarse.expected_speed_up, coarse.reference_mm), (16.0, 1.0))
        self.assertEqual((coarse.seeds, coarse.crushed, coarse.not_failed), (3, 3, 0))

    def test_the_same_packings_are_compared_one_by_one(self):
        rows = self.rows(self.group(2.0e-3), self.group(2.0e-3, special="0.25/s", strain_rate=0.25,
                                                        strength=1.01e4))
        slow = rows["scaled", 2.0, "0.25/s"]
        self.assertAlmostEqual(slow.strength_deviation[self.last].value, 1.0)
        self.assertAlmostEqual(slow.strength_deviation[self.last].error, 0.0)
        self.assertAlmostEqual(slow.loading_deviation.value, 0.0, delta=1e-9)
        self.assertAlmostEqual(slow.loading_deviation.error, 0.0, delta=1e-9)

    def verdicts(self, coarse, unscaled=None):
        some = [self.group(1.0e-3, seconds=100.0), coarse] + ([unscaled] if unscaled else [])
        return {c.what: c.verdict
                for c in claims.claims(list(self.rows(*some).values()), 1.0)}

    def test_verdicts_follow_the_limits(self):
        good = self.verdicts(self.group(2.0e-3, strain=0.0306, strength=0.96e4, z=6.11,
                                        seconds=9.9),
                             self.group(2.0e-3, "unscaled", strain=0.05))
        bad = self.verdicts(self.group(2.0e-3, strain=0.0330, strength=0.94e4, z=6.2,
                                       seconds=10.1),
                            self.group(2.0e-3, "unscaled", strain=0.034))
        limited = [what for what, verdict in good.items() if verdict]
        self.assertEqual(len(limited), 7)
        for what in limited:
            self.assertEqual(good[what], "yes", what)
            self.assertEqual(bad[what], "yes" if "inertial" in what else "NO", what)
        # 7 and 9% of strength, 45 and 38 times faster: limits of three times the diameter
        for size, strength, seconds, verdict in (
                (2.0e-3, 0.93e4, 2.2, "NO yes"), (3.0e-3, 0.93e4, 2.2, "yes yes"),
                (3.0e-3, 0.91e4, 2.6, "NO NO")):
            found = self.verdicts(self.group(size, strength=strength, seconds=seconds))
            self.assertEqual(" ".join(v for what, v in found.items()
                                      if "strength" in what or "confined test" in what), verdict)

    def test_inertial_number_has_a_verdict(self):
        # the base material's counts in specimens of any width, that of all unscaled ones too
        for mode, special, side, verdicts in (("scaled", "60 mm wide", 60e-3, ["NO", "NO"]),
                                              ("unscaled", "", 30e-3, ["yes", "NO"])):
            fine, fast = self.group(1.0e-3), self.group(3.0e-3, mode, special, side=side)
            fast.confined = {1: confined_result(1.0, 1, 0.03, inertial=1.1e-3)}
            found = claims.claims(list(self.rows(fine, fast).values()), 1.0)
            about = [c for c in found if "inertial number on" in c.what]
            self.assertEqual([c.verdict for c in about], verdicts)
            self.assertIn(f"{mode}, 3 mm" + (f", {special}" if special else ""), about[1].what)

    def test_wide_specimens_have_the_limits_of_strength(self):
        some = [self.group(1.0e-3), self.group(2.0e-3, strength=0.9e4),
                self.group(2.0e-3, special="60 mm wide", side=60e-3, strength=0.96e4),
                self.group(3.0e-3, special="60 mm wide", side=60e-3, strength=0.91e4),
                self.group(3.0e-3, special="0.25/s", strain_rate=0.25),
                self.group(1.0e-3, special="15 mm wide", side=15e-3)]
        found = {c.what: (c.limit, c.verdict)
                 for c in claims.claims(list(self.rows(*some).values()), 1.0)
                 if "wide: strength" in c.what}
        self.assertEqual(found, {
            "scaled, 2x, 60 mm wide: strength after 96 kPa": ("<= 5%", "yes"),
            "scaled, 3x, 60 mm wide: strength after 96 kPa": ("<= 8%", "NO")})

    def test_nothing_is_claimed_without_the_finest(self):
        found = claims.claims(list(self.rows(self.group(2.0e-3), self.group(3.0e-3)).values()), 1.0)
        self.assertFalse([c for c in found if "x:" in c.what])

    def test_similar_specimens(self):
        fine = self.group(1.0e-3, special="10 mm wide", side=10.0e-3)
        others = [self.group(3.0e-3, strength=1.05e4), self.group(2.0e-3), self.group(1.0e-3)]
        one, = analysis.similar_specimens({g.key: g for g in [fine, *others]}, self.full)
        self.assertEqual((one.diameter_mm, one.fine_mm), (3.0, 1.0))
        self.assertAlmostEqual(one.strength_deviation[self.last].value, 5.0)
        # packings of a seed are the same, so that their scatter is in neither error
        self.assertAlmostEqual(one.strength_deviation[self.last].error, 0.0)
        self.assertAlmostEqual(one.loading_deviation.error, 0.0)
        self.assertEqual(one.seeds, 3)
        # as wide in diameters, but not as many particles
        for result in fine.confined.values():
            object.__setattr__(result.cost, "particles", 999)
        self.assertEqual(analysis.similar_specimens({g.key: g for g in [fine, *others]},
                                                    self.full), [])

    def test_reduced_strength_and_speed(self):
        some = {g.key: g for g in [
            self.group(1.0e-3, seconds=80.0), self.group(2.0e-3, seconds=5.0),
            self.group(1.0e-3, special="10 mm wide", side=10.0e-3)]}
        points = fits.strength_points(some)
        self.assertEqual(len(points), 2)
        self.assertAlmostEqual(points[1].packing.value, 5.0 * 0.6)
        self.assertAlmostEqual(points[1].reduced_strength.value, 1.0e4 * 4.0e-6 / 2.0e-3)
        self.assertAlmostEqual(fits.speed_exponent(some, "scaled").value, 4.0)
        self.assertIsNone(fits.speed_exponent(some, "unscaled"))

    def test_table_has_a_cell_for_each_heading(self):
        row = self.rows(self.group(1.0e-3), self.group(2.0e-3))["scaled", 2.0, ""]
        line = dict(zip(strength_tables.HEADER, strength_tables.cells(row, self.last)))
        self.assertEqual(len(strength_tables.cells(row, self.last)), len(strength_tables.HEADER))
        self.assertEqual(line["Z of the bulk"], "6.400 ± 0.000")
        self.assertEqual(line["strength (kPa)"], "10.00 ± 0.12")
        self.assertEqual(strength_tables.cells(row, 16.0e3)[strength_tables.HEADER.index(
            "strength (kPa)")], "")


class Claims(unittest.TestCase):
    def test_verdicts_name_the_standard_error_where_it_alone_saves_a_figure(self):
        for value, verdict in ((Value(1.9, 0.1), "yes"), (Value(-1.9, 0.1), "yes"),
                               (Value(2.5, 0.1), "NO"), (Value(-2.5, 0.1), "NO"),
                               (Value(2.5, math.nan), "NO"),
                               (Value(2.5, 3.0), "within its standard error only")):
            self.assertEqual(claims._near("x", value, 2.0).verdict, verdict)


if __name__ == "__main__":
    unittest.main()

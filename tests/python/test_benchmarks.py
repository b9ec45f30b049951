# SPDX-License-Identifier: GPL-2.0-only
"""The reading, the medians and the tables of benchmarks/; and, with a LAMMPS that the environment
names (EEPA_LMP), a comparison of pair styles on a packing so small that it takes seconds."""
from __future__ import annotations

import csv
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "benchmarks"), str(ROOT / "examples" / "scale_collapse"), str(ROOT / "examples"),
                str(ROOT / "coarsen")]

from bench import (cases, cost, instructions, kernel, lammps, lammps_log, liggghts,  # noqa: E402
                   many_particles, many_types, memory, output, report, scaling, statistics, styles,
                   walls)

from machines import meshes  # noqa: E402

LMP = os.environ.get("EEPA_LMP")

LOG = """\
Loop time of 0.5 on 1 procs for 20 steps with 32000 atoms
Figure contacts_before 15000.0
print           "Stage timed"
Stage timed
Per MPI rank memory allocation (min/avg/max) = 27.5 | 27.6 | 27.7 Mbytes
Loop time of 0.104984 on 2 procs for 50 steps with 32000 atoms

99.8% CPU use with 2 MPI tasks x 1 OpenMP threads

MPI task timing breakdown:
Section |  min time  |  avg time  |  max time  |%varavg| %total
---------------------------------------------------------------
Pair    | 0.073879   | 0.074      | 0.075      |   0.0 | 70.37
Neigh   | 8.3046e-03 | 8.3046e-03 | 8.3046e-03 |   0.0 |  7.91
Other   |            | 0.002896   |            |       |  2.76

Total # of neighbors = 115124
Ave neighs/atom = 3.597625
Neighbor list builds = 1
Stage done
Loop time of 1.5e-06 on 2 procs for 0 steps with 32000 atoms
Figure contacts_after 16000.0
"""


class Logs(unittest.TestCase):
    def test_timed_run_alone_is_read(self):
        run = lammps_log.read_run(LOG.splitlines(True))
        self.assertEqual((run.loop, run.ranks, run.steps, run.atoms), (0.104984, 2, 50, 32000))
        self.assertEqual(run.pair, 0.075)  # of the slowest rank
        self.assertEqual(run.sections["Neigh"], 8.3046e-3)
        self.assertEqual(run.sections["Other"], 0.002896)
        self.assertEqual((run.neighbors, run.builds), (115124, 1))
        self.assertEqual((run.cpu_percent, run.memory_mb), (99.8, 27.7))
        self.assertEqual(run.contacts, 15500.0)

    def test_sections_of_old_lammps_and_liggghts(self):
        start = LOG.index("MPI task timing")
        end = LOG.index("Total # of neighbors")
        old = LOG[:start] + "Pair  time (%) = 0.0741 (70.4)\nOther time (%) = 0.0031 (2.9)\n\n" + LOG[end:]
        run = lammps_log.read_run(old.splitlines(True))
        self.assertEqual((run.pair, run.sections["Other"], run.neighbors), (0.0741, 0.0031, 115124))

    def test_unfinished_run_is_an_error(self):
        for end in ("Stage done", "Pair    |"):
            with self.assertRaises(lammps_log.BadLog):
                lammps_log.read_run(LOG[:LOG.index(end)].splitlines(True))

    def test_callgrind_total(self):
        self.assertEqual(instructions.read_total("events: Ir\nsummary: 5\n\ntotals: 75596563\n"),
                         75596563)
        for nothing in ("totals: 0\n", "events: Ir\n"):
            with self.assertRaises(ValueError):
                instructions.read_total(nothing)


class Statistics(unittest.TestCase):
    rows = [{"style": style, "round": k, "pair_s": value}
            for style, values in (("a", (2.0, 20.0, 3.0)), ("b", (1.0, 8.0, 2.0)))
            for k, value in enumerate(values)]

    def test_ratios_are_paired(self):
        # a machine that is ten times slower in the second round does not change the result
        ratios = statistics.paired_ratios(self.rows, "a", "b", "style", "pair_s")
        self.assertEqual(ratios, [2.0, 2.5, 1.5])
        middle = statistics.median(ratios)
        self.assertEqual((middle.value, middle.low, middle.high), (2.0, 1.75, 2.25))
        self.assertEqual(middle.text(), "2.000 [1.750, 2.250]")

    def test_round_without_its_partner_is_left_out(self):
        some = [row for row in self.rows if (row["style"], row["round"]) != ("b", 1)]
        self.assertEqual(statistics.paired_ratios(some, "a", "b", "style", "pair_s"), [2.0, 1.5])

    def test_median_of_nothing(self):
        with self.assertRaises(ValueError):
            statistics.median([])

    def test_power(self):
        power = statistics.fit_power([1.0, 1.5, 2.0], [8.0 * d**-4 for d in (1.0, 1.5, 2.0)])
        self.assertAlmostEqual(power.exponent, -4.0)
        self.assertAlmostEqual(power.factor, 8.0)
        self.assertLess(power.error, 1e-9)
        self.assertTrue(math.isnan(statistics.fit_power([1.0, 2.0], [1.0, 2.0]).error))

    def test_speed_up_counts_steps(self):
        serial, two = "strong s 1 x serial", "strong s 2 x serial"
        rows = [{"job": job, "reference": serial, "round": k, "pair_s": seconds, "steps": steps}
                for job, steps, times in ((serial, 100, (4.0, 8.0)), (two, 200, (4.0, 8.0)))
                for k, seconds in enumerate(times)]
        self.assertEqual(scaling.speed_up(rows, two, "pair_s").value, 2.0)

    def test_loss_is_that_of_each_round(self):
        rows = [{"name": f"s {case}", "round": k, "ns": ns}
                for case, times in (("small", (80.0, 120.0, 90.0)), ("large", (100.0, 160.0, 100.0)))
                for k, ns in enumerate(times)]
        self.assertAlmostEqual(many_particles.loss(rows, "s", "small", "large").value, 0.2)

    def test_share_of_walls_is_free_of_the_noise_of_a_run(self):
        # the rest 8 s and other fixes 2 s, walls 2.5 s more; runs are slower by any factor
        rows = [{"walls": name, "round": k, "loop_s": factor * (10.0 + extra), "modify_s": factor * (2.0 + extra)}
                for k, factors in enumerate(((1.0, 1.7), (1.3, 0.9))) for name, extra, factor in
                (("none", 0.0, factors[0]), ("mesh", 2.5, factors[1]))]
        self.assertAlmostEqual(walls.share(rows, "mesh").value, 0.2)
        self.assertAlmostEqual(walls.share(rows, "none").value, 0.0)

    def test_cube_is_closed_and_outside_out(self):
        triangles = walls.cube(2.0, 3)
        self.assertEqual(len(triangles), 12 * 9)
        self.assertAlmostEqual(meshes.volume(triangles), 8.0)
        self.assertAlmostEqual(meshes.area(triangles), 24.0)

    def test_memory_of_a_further_particle(self):
        self.assertEqual(memory.per_particle({"peak_kb": 100, "atoms": 1000},
                                             {"peak_kb": 300, "atoms": 3000}), 102.4)


class Styles(unittest.TestCase):
    def test_restitution_and_gamma_agree(self):
        for restitution in (0.1, 0.3, 0.9):
            gamma = styles.gamma_of_restitution(restitution, 5.0e3, 1.0e-6)
            material = styles.Material(5.0e3, 0.5, gamma, True, 1.0e-6, 1.0e4, 0.0, 0.0)
            self.assertAlmostEqual(material.restitution, restitution, places=12)

    def test_chute_is_that_of_lammps(self):
        some = styles.make_styles(cases.CHUTE)
        self.assertEqual(some[styles.HOOKE].pair_style,
                         "gran/hooke/history 200000 NULL 50 NULL 0.5 0")
        gamma = styles.gamma_of_restitution(0.1, cases.CHUTE.k1, cases.CHUTE.mass)
        for name, calmed in ((styles.HOOKE, styles.DAMPED),
                             (styles.GRANULAR, styles.GRANULAR_DAMPED)):
            self.assertEqual(some[calmed].lines,
                             some[name].lines.replace(" 50 ", f" {gamma:.9g} ", 1))
            self.assertNotIn(calmed, styles.make_styles(cases.POWDER))

    def test_types_differ(self):
        some = styles.make_styles(cases.POWDER)
        lines = some["gran/eepa full"].lines_of(3).splitlines()
        self.assertEqual(lines[0], "pair_style gran/eepa linear")
        self.assertEqual([line.split()[:3] for line in lines[1:]],
                         [["pair_coeff", str(k), str(k)] for k in (1, 2, 3)])
        frictions = [float(line.split()[7]) for line in lines[1:]]
        self.assertEqual(len(set(frictions)), 3)
        for friction in frictions:
            self.assertAlmostEqual(friction, cases.POWDER.mu, places=7)
        with self.assertRaisesRegex(ValueError, "several types"):
            some[styles.HOOKE].lines_of(2)

    def test_commands(self):
        program = lammps.Program(Path("lmp"))
        one = lammps.command(program, Path("in.x"), Path("f"), {"a": "1"})
        self.assertEqual(one, ["lmp", "-in", "in.x", "-log", "f/log.lammps", "-var", "a", "1"])
        two = lammps.command(program, Path("in.x"), Path("f"), {}, lammps.Parallel(2, 0))
        self.assertEqual(two[:5], ["mpirun", "-np", "2", "--bind-to", "core"])
        threads = lammps.command(program, Path("in.x"), Path("f"), {}, lammps.Parallel(1, 2))
        self.assertEqual(threads[-5:], ["-sf", "omp", "-pk", "omp", "2"])


class Kernel(unittest.TestCase):
    def test_driver_and_bytes(self):
        self.assertEqual(kernel.driver_operations("none")["roots"], 1.0)
        self.assertGreater(kernel.driver_operations("sds")["additions"],
                           kernel.driver_operations("none")["additions"])
        context = {"history_doubles": "4", "history_doubles_sds": "7"}
        self.assertEqual(kernel.contact_bytes("none", context), (180, 84))
        self.assertEqual(kernel.contact_bytes("sds", context), (204, 108))

    def test_liggghts_is_given_what_its_script_has(self):
        case = cases.Case("some", Path("in.compression"), cases.POWDER, Path("some.data"), (2, 2, 3), rebuild=50)
        given = liggghts.variables(case, Path("other.data"))
        known = {line.split()[1]: line.split()[3] for line in liggghts.INFILE.read_text().splitlines()
                 if line.startswith("variable")}
        self.assertLessEqual(set(given), set(known))
        # the numbers in the script are those of the material, for whoever runs it by hand
        for name in ("k1", "k2", "k_adh", "f0", "mu", "mu_r", "e"):
            self.assertAlmostEqual(float(known[name]) / float(given[name]), 1.0, delta=1e-6, msg=name)
        self.assertEqual([given[n] for n in ("nx", "ny", "nz", "data")], ["2", "2", "3", "other.data"])

    def test_data_file_without_comments_of_sections(self):
        text = "LAMMPS data file # 1\n\n2 atoms\n\nAtoms # sphere\n\n1 1 0.001 2000 0 0 0 0 0 0\n"
        self.assertEqual(liggghts.plain_data(text),
                         "LAMMPS data file # 1\n\n2 atoms\n\nAtoms\n\n1 1 0.001 2000 0 0 0 0 0 0\n")

    def test_failed_benchmark_is_an_error(self):
        entry = {"run_name": "linear/loading/none/one", "name": "n", "run_type": "iteration",
                 "repetition_index": 1, "contacts": 1000.0, "cpu_time": 12000.0}
        self.assertEqual(kernel.read_benchmarks([entry])[0]["ns"], 12.0)
        with self.assertRaisesRegex(ValueError, "wrong branch"):
            kernel.read_benchmarks([{**entry, "error_occurred": True,
                                     "error_message": "wrong branch"}])


class Report(unittest.TestCase):
    def test_part_keeps_what_it_was_measured_on(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            report.write_part(folder, "cost", "a table\n", {"commit": "one", "cores": 2})
            report.write_part(folder, "memory", "another\n", {"commit": "two", "cores": 2})
            report.write_report(folder, {"memory": "bytes", "cost": "time", "kernel": "not run"})
            page = (folder / "report.md").read_text(encoding="utf-8")
        self.assertLess(page.index("another"), page.index("a table"))
        self.assertIn("- commit: one", page)
        self.assertEqual(page.count("- cores: 2"), 1)
        self.assertNotIn("not run", page)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class InLammps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = Path(folder.name)
        # other tests may be running on the same cores
        self.program = lammps.Program(Path(LMP), bind=False)

    def test_cost_from_start_file_to_table(self):
        case = cases.compression(self.program, self.work, 300).lasting(20, 60)
        made = case.data.stat().st_mtime_ns
        self.assertEqual(cases.packing(self.program, self.work, 300).stat().st_mtime_ns, made)
        rows = cost.measure(self.program, case, cost.STYLES, 2, self.work)
        names = [name for name in cost.STYLES if "damped" not in name]
        self.assertEqual([row["style"] for row in rows], names * 2)  # in turn
        for row in rows:
            self.assertEqual((row["atoms"], row["steps"]), (300, 60))
            self.assertGreater(row["pair_s"], 0.0)
            self.assertLess(row["pair_s"], row["loop_s"])
        by_name = {row["style"]: row for row in rows}
        # the same physics, the same contacts
        for name in (styles.GRANULAR, "gran/eepa elastic"):
            self.assertAlmostEqual(by_name[name]["contacts"], by_name[styles.HOOKE]["contacts"],
                                   delta=0.01 * by_name[styles.HOOKE]["contacts"])
        full = by_name["gran/eepa full"]
        self.assertGreater(full["contacts"], 2.0 * 300)
        # contacts between the last two counts: those of the last step have a branch
        self.assertGreater(full["loading"] + full["unloading"] + full["adhesive"], 2.0 * 300)
        text = cost.table(rows)
        self.assertIn("gran/eepa sds", text)
        self.assertIn("1.000 [1.000, 1.000]", text)
        cost.plot(rows, self.work / "cost.png")
        self.assertGreater((self.work / "cost.png").stat().st_size, 0)
        cost_csv = self.work / "cost.csv"
        output.write_csv(cost_csv, rows)
        with cost_csv.open(encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), len(rows))

    def test_copies_and_types_of_a_packing_with_friction(self):
        sizes = [cases.dense(self.program, self.work, 300, copies).lasting(20, 100)
                 for copies in ((1, 1, 1), (2, 1, 1))]
        rows = many_particles.measure(self.program, sizes, 1, self.work)
        self.assertEqual([row["atoms"] for row in rows], [300, 600] * len(many_particles.STYLES))
        for row in rows:
            self.assertEqual(row["builds"], 2)
            self.assertLess(row["contacts"], 2.9 * row["atoms"])    # without friction there are 3
        self.assertIn("gran/eepa full, dense 600", many_particles.table(rows))
        rows = many_types.measure(self.program, sizes[0], 1, self.work)
        self.assertEqual([row["types"] for row in rows], list(many_types.COUNTS))
        self.assertEqual(len({row["contacts"] for row in rows}), 1)
        self.assertIn("1.000 [1.000, 1.000]", many_types.table(rows))

    def test_walls_beside_planes_and_none(self):
        rows = walls.measure(self.program, 6, 5, 30, 1, self.work)
        self.assertEqual([row["walls"] for row in rows], list(walls.WALLS))
        none, planes, mesh = rows
        self.assertEqual({row["atoms"] for row in rows}, {216})
        self.assertEqual(none["wall_contacts"], 0.0)
        self.assertGreater(planes["wall_contacts"], 36.0)
        # the same particles, as far as 30 steps keep rounding small
        self.assertAlmostEqual(mesh["wall_contacts"], planes["wall_contacts"], delta=2)
        self.assertIn("216 spheres", walls.table(rows))

    def test_known_and_unknown_pair_styles(self):
        self.assertTrue(lammps.has_pair_style(self.program, self.work, "gran/eepa"))
        self.assertFalse(lammps.has_pair_style(self.program, self.work, "gran/nobody"))

    def test_failing_run_says_why(self):
        infile = self.work / "in.bad"
        infile.write_text("units nonsense\n", encoding="utf-8")
        with self.assertRaisesRegex(lammps.RunFailed, "nonsense"):
            lammps.run_lammps(self.program, infile, self.work, {})


if __name__ == "__main__":
    unittest.main()

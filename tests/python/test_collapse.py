# SPDX-License-Identifier: GPL-2.0-only
"""The analysis, the resuming and the arguments of examples/scale_collapse. LAMMPS is not needed:
a script takes its place."""
from __future__ import annotations

import contextlib
import io
import math
import os
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

STUDY = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path.insert(0, str(STUDY))

import run_study  # noqa: E402
from collapse import cases, curves, logs, progress, report, runs  # noqa: E402

CASE = cases.Case(2.0e-3, True, "linear", 1)


def samples(loading, unloading=None, shift=0.0):
    """A table like that of curve.csv: stress in Pa over strain, loading to 3% and back to 1%.

    :param shift: strain before loading counts from 0
    """
    unloading = unloading or (lambda strain: loading(0.03) - 5.0e6 * (0.03 - strain))
    rows = []
    for stage, law, strains in (("load", loading, np.linspace(-0.002, 0.03, 161)),
                                ("unload", unloading, np.linspace(0.0299, 0.0101, 100))):
        for strain in strains:
            length = (1.0 - strain) * (1.0 - shift)
            stress = law(strain)
            rows.append((len(rows), stage, 0.03 * length, 1.0 - length, stress, stress,
                         0.37 - strain, 0.36 - strain, 5.0 + 10.0 * strain))
    kinds = [("step", int), ("stage", "U6")] + [(name, float) for name in curves.COLUMNS[2:]]
    return np.array(rows, dtype=kinds)


def straight(modulus, preload=5.0e3):
    return lambda strain: preload + modulus * strain


def curve(modulus=3.0e6, shift=0.0):
    return curves.curve_from_samples(samples(straight(modulus), shift=shift), 5.0e3)


class Curves(unittest.TestCase):
    def test_strain_counts_from_the_preload_whatever_went_before(self):
        one, other = curve(), curve(shift=0.05)
        for kind in curves.STRAINS:
            self.assertAlmostEqual(one.loading.strain[kind][0], 0.0, places=12)
            np.testing.assert_allclose(one.loading.strain[kind], other.loading.strain[kind],
                                       atol=1e-12)
            self.assertAlmostEqual(one.loading.strain[kind].max(), 0.03, places=10)
        self.assertAlmostEqual(one.loading.stress[0], 5.0e3)
        self.assertAlmostEqual(one.preload_porosity, 0.37)
        self.assertAlmostEqual(one.preload_bulk_porosity, 0.36)
        self.assertAlmostEqual(one.preload_coordination, 5.0)

    def test_last_rise_through_the_preload_counts(self):
        table = samples(straight(3.0e6))
        early = np.flatnonzero(table["stage"] == "load")[2]
        table["stress_top"][early] = table["stress_bottom"][early] = 6.0e3
        again = curves.curve_from_samples(table, 5.0e3)
        np.testing.assert_allclose(again.loading.stress, curve().loading.stress)

    def test_branches_are_apart(self):
        one = curve()
        self.assertTrue(np.all(np.diff(one.loading.stress) > -1e-6))
        self.assertTrue(np.all(np.diff(one.unloading.stress) < 0.0))
        self.assertAlmostEqual(one.unloading.strain["platen"][0], 0.03)

    def test_known_deviation(self):
        # Straight lines that differ by 10% of the slope: rms of 0.1 E e over e from 0 to 0.03 is
        # 0.1 E 0.03/sqrt(3), the peak is 5e3 + 0.03 E.
        modulus = 3.0e6
        result = curves.loading_deviation([curve(1.1 * modulus)], [curve(modulus)], "bulk")
        expected = 100.0 * 0.1 * modulus * 0.03 / math.sqrt(3.0) / (5.0e3 + 0.03 * modulus)
        self.assertAlmostEqual(result.percent, expected, delta=0.01 * expected)
        self.assertAlmostEqual(result.up_to, 0.03)
        self.assertTrue(math.isnan(result.standard_error))

    def test_deviation_of_unloading(self):
        one = curves.curve_from_samples(samples(straight(3.0e6)), 5.0e3)
        other = curves.curve_from_samples(
            samples(straight(3.0e6), lambda strain: 9.5e4 - 4.0e6 * (0.03 - strain)), 5.0e3)
        recovered = 0.03 - 0.0101
        result = curves.unloading_deviation([other], [one], "platen")
        self.assertAlmostEqual(result.percent, 100.0 * 1.0e6 * recovered / math.sqrt(3.0) / 9.5e4,
                               delta=0.02)

    def test_deviation_is_over_the_common_range_only(self):
        table = samples(straight(3.0e6))
        short = curves.curve_from_samples(
            table[(table["stage"] == "unload") | (table["bulk_strain"] < 0.02)], 5.0e3)
        result = curves.loading_deviation([short], [curve()], "bulk")
        self.assertAlmostEqual(result.percent, 0.0, places=9)
        self.assertLess(result.up_to, 0.02)

    def test_mean_deviation_has_a_sign_and_pairs_the_error_of_their_differences(self):
        grid = np.linspace(0.0, 1.0, 11)
        pairs = [(level * grid - 2.0, level * grid) for level in (90.0, 110.0)]
        result = curves.paired_deviation(pairs, grid)
        self.assertAlmostEqual(result.percent, 2.0)
        self.assertAlmostEqual(result.mean_percent, -2.0)
        self.assertAlmostEqual(result.standard_error, 0.0)
        apart = curves.deviation(*(curves.mean_of(grid, some) for some in zip(*pairs)))
        self.assertAlmostEqual(apart.percent, 2.0)
        self.assertAlmostEqual(apart.mean_percent, -2.0)
        self.assertGreater(apart.standard_error, 1.0)

    def test_unloading_begins_after_the_hold(self):
        table = samples(straight(3.0e6))
        first = np.flatnonzero(table["stage"] == "unload")[0]
        held = np.repeat(table[first - 1:first], 5)
        held["stage"], held["bulk_strain"] = "hold", np.linspace(0.0301, 0.0305, 5)
        both = curves.curve_from_samples(np.concatenate([table[:first], held, table[first:]]),
                                         5.0e3)
        self.assertAlmostEqual(both.unloading.strain["bulk"][0] - both.loading.strain["bulk"][-1],
                               0.0005, delta=2e-5)

    def test_mean_and_standard_error_of_seeds(self):
        some = [curve(m) for m in (2.0e6, 3.0e6, 4.0e6)]
        mean = curves.mean_stress(some, "platen", 0.03)
        self.assertAlmostEqual(mean.value[-1], 5.0e3 + 0.03 * 3.0e6, delta=1.0)
        self.assertAlmostEqual(mean.error[-1], 0.03 * 1.0e6 / math.sqrt(3.0), delta=1.0)
        self.assertEqual(mean.seeds, 3)

    def test_mean_at_stress(self):
        mean = curves.mean_at_stress([curve(), curve()], "loading", "bulk_porosity")
        np.testing.assert_allclose(mean.value, 0.36 - (mean.grid - 5.0e3) / 3.0e6, atol=1e-9)

    def test_interpolation_needs_no_order_and_does_not_reach_beyond(self):
        key, values = np.array([0.0, 2.0, 1.0, 3.0]), np.array([0.0, 20.0, 10.0, 30.0])
        np.testing.assert_allclose(curves.interpolate(np.array([0.5, 2.5]), key, values),
                                   [5.0, 25.0])
        with self.assertRaisesRegex(ValueError, "beyond the samples"):
            curves.interpolate(np.array([0.0, 3.1]), key, values)

    def test_no_preload_is_an_error(self):
        for preload in (-2.0e3, 1.0e6):
            with self.assertRaisesRegex(curves.BadCurve, "the-name: stress does not rise"):
                curves.curve_from_samples(samples(straight(3.0e6)), preload, "the-name")

    def test_missing_column_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "curve.csv"
            path.write_text("step,stage\n1,load\n2,load\n", encoding="utf-8")
            with self.assertRaisesRegex(curves.BadCurve, "height, bulk_strain"):
                curves.read_samples(path)


class Cases(unittest.TestCase):
    def test_particles_go_with_the_cube(self):
        for diameter, particles in ((1.0e-3, 5000), (1.5e-3, 1481), (2.0e-3, 625)):
            self.assertEqual(cases.Case(diameter, True, "linear", 1).particles, particles)

    def test_reference_diameter_runs_once(self):
        some = cases.make_cases([1.0e-3, 2.0e-3], [1, 2], "linear", cases.MODES)
        self.assertEqual(len(some), 1 + 2 * 2)
        self.assertEqual([c for c in some if not c.scaled and c.diameter == 1.0e-3], [])

    def test_seeds_count_from_the_first(self):
        some = cases.make_cases([2.0e-3], [3], "linear", ["scaled"], first_seed=101)
        self.assertEqual([101, 102, 103], sorted(case.seed for case in some))

    def test_longest_first(self):
        some = cases.make_cases([2.0e-3, 1.0e-3, 1.5e-3], [], "linear", cases.MODES)
        self.assertEqual(some[0].diameter, 1.0e-3)
        work = [c.particles * c.expected_steps() for c in some]
        self.assertEqual(work, sorted(work, reverse=True))

    def test_seeds(self):
        self.assertEqual(cases.seeds_per_diameter([1e-3, 1.5e-3, 2e-3], []), [2, 4, 8])
        self.assertEqual(cases.seeds_per_diameter([1e-3, 2e-3], [3]), [3, 3])
        self.assertEqual(cases.seeds_per_diameter([1e-3, 2e-3], [1, 5]), [1, 5])

    def test_bad_values_name_themselves(self):
        for make, text in (
                (lambda: cases.seeds_per_diameter([1e-3, 2e-3], [1, 2, 3]), "3 numbers of seeds"),
                (lambda: cases.seeds_per_diameter([1e-3], [0]), "seeds are 0"),
                (lambda: cases.Case(-1e-3, True, "linear", 1), "diameter is -0.001"),
                (lambda: cases.Case(math.nan, True, "linear", 1), "diameter is nan"),
                (lambda: cases.Case(1e-3, True, "hertz", 1), "'hertz', allowed are linear and"),
                (lambda: cases.Case(1e-3, True, "linear", 0), "seed is 0, allowed"),
                (lambda: cases.make_cases([1e-3, 1e-3], [1], "linear", ["scaled"]), "twice"),
                (lambda: cases.make_cases([1e-3], [1], "linear", ["half"]), "mode is 'half'")):
            with self.assertRaisesRegex(ValueError, text):
                make()

    def test_inertial_number(self):
        self.assertAlmostEqual(CASE.inertial_number(5.0e3), 0.5 * 2.0e-3 * math.sqrt(0.4))

    def test_fingerprint_knows_every_parameter(self):
        base = CASE.fingerprint([b"in"], 1)
        self.assertEqual(base, cases.Case(2.0e-3, True, "linear", 1).fingerprint([b"in"], 1))
        others = {
            cases.Case(2.1e-3, True, "linear", 1).fingerprint([b"in"], 1),
            cases.Case(2.0e-3, False, "linear", 1).fingerprint([b"in"], 1),
            cases.Case(2.0e-3, True, "plateau", 1).fingerprint([b"in"], 1),
            cases.Case(2.0e-3, True, "linear", 2).fingerprint([b"in"], 1),
            cases.Case(2.0e-3, True, "linear", 1, 2.0e-3).fingerprint([b"in"], 1),
            CASE.fingerprint([b"in"], 2),
            CASE.fingerprint([b"changed"], 1),
            CASE.fingerprint([b"in", b""], 1),
        }
        self.assertEqual(len(others), 8)
        self.assertNotIn(base, others)

    def test_numbers_are_those_of_the_in_file(self):
        """What cases.py repeats of in.oedometer, for the number of particles and of steps."""
        text = (STUDY / "in.oedometer").read_text(encoding="utf-8")
        given = dict(line.split()[1:4:2] for line in text.splitlines()
                     if line.startswith("variable") and line.split()[2] == "index")
        for name, value in (("nref", cases.REFERENCE_PARTICLES), ("density", cases.DENSITY),
                            ("k1", cases.K1), ("k2", cases.K2), ("rate", cases.STRAIN_RATE),
                            ("packrate", cases.PACKING_RATE), ("dref", 1.0e-3)):
            self.assertEqual(float(given[name]), value, name)
        for name, value in zip(CASE.variables()[1::3], CASE.variables()[2::3]):
            self.assertIn(name, given)
            self.assertTrue(value)


LOG = """Stage place
Loop time of 0.25 on 1 procs for 30 steps with 625 atoms
Stage relax
   Step        v_height
       500   0.02   0   0.40   0.37   0   0
Loop time of 0.5 on 1 procs for 2000 steps with 625 atoms
Stage pack
Loop time of 1e-06 on 1 procs for 0 steps with 625 atoms
Loop time of 1.5 on 1 procs for 9000 steps with 625 atoms

90.0% CPU use with 1 MPI tasks x 1 OpenMP threads
Stage load
     12000   0.02   -3.5e2   0.40   0.37   5.1   0.001
Loop time of 2.0 on 1 procs for 15000 steps with 625 atoms
"""


class Logs(unittest.TestCase):
    def test_log_that_is_being_written(self):
        summary = logs.summarise(LOG.splitlines())
        self.assertEqual((summary.current, summary.step, summary.particles), ("load", 12000, 625))
        self.assertFalse(summary.finished)
        self.assertEqual(summary.stages["pack"].steps, 9000)
        self.assertAlmostEqual(summary.stages["pack"].seconds, 1.500001)
        self.assertAlmostEqual(summary.stages["pack"].cpu_seconds, 0.9 * 1.5)
        self.assertTrue(logs.summarise((LOG + "Stage done\n").splitlines()).finished)

    def test_command_echo_is_no_stage(self):
        self.assertEqual(logs.summarise(['print           "Stage load"']).current, "start")

    def test_no_log_is_a_run_not_begun(self):
        self.assertEqual(logs.summarise_file(Path("/nonexistent/log")).step, 0)
        self.assertEqual(logs.tail(Path("/nonexistent/log")), [])


class Words(unittest.TestCase):
    def test_time(self):
        self.assertEqual([progress.in_words(t) for t in (0.4, 59.4, 60, 3599, 3600, 7260)],
                         ["0 s", "59 s", "1 min 00 s", "59 min 59 s", "1 h 00 min", "2 h 01 min"])

    def test_progress_names_run_steps_and_time_left(self):
        stream = io.StringIO()
        some = cases.make_cases([2.0e-3], [3], "linear", ["scaled"])
        shown = progress.Progress(some, 1, stream, seconds_between_lines=0.0)
        shown.done(some[0], logs.summarise((LOG + "Stage done\n").splitlines()))
        shown.show({some[1]: logs.summarise(LOG.splitlines())})
        first, second = stream.getvalue().splitlines()
        self.assertEqual(first, "[1 of 3 runs done] d2mm_scaled_linear_seed1: 26000 steps of 625 "
                                "particles, 4.3 s")
        # The second run is foreseen to take as many steps as the first one took.
        self.assertIn("d2mm_scaled_linear_seed2 load 12000 of about 26000 steps", second)
        self.assertIn("left", second)

    def test_time_left_is_that_of_the_work(self):
        some = cases.make_cases([2.0e-3], [4], "linear", ["scaled"])
        shown = progress.Progress(some, 2, io.StringIO())
        for case in some[:2]:
            shown.done(case, logs.summarise((LOG + "Stage done\n").splitlines()))
        half = logs.LogSummary(current="load", step=13000)
        # Two of four done and two halfway in 30 s on two jobs: 10 s.
        self.assertEqual(shown.seconds_left({some[2]: half, some[3]: half}, 30.0),
                         "about 10 s left")


def fake_lmp(folder: Path, body: str) -> Path:
    """A program that gets what LAMMPS would get."""
    path = folder / "lmp"
    path.write_text(f"#!{sys.executable}\n"
                    "import os, pathlib, sys, time\n"
                    "words = sys.argv[1:]\n"
                    "log = pathlib.Path(words[words.index('-log') + 1])\n"
                    "names = {words[k + 1]: words[k + 2] for k, w in enumerate(words)"
                    " if w == '-var'}\n" + body, encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


GOOD = f"""
log.write_text({LOG!r} + "Stage unload\\nLoop time of 1 on 1 procs for 5000 steps with 625 atoms\\n"
               + "Stage done\\n")
(log.parent / "curve.csv").write_text("some samples of seed " + names["seed"])
with open(os.environ["FAKE_COUNT"], "a") as count:
    count.write(log.parent.name + "\\n")
"""


class Resuming(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.count = self.folder / "count"
        self.count.touch()
        os.environ["FAKE_COUNT"] = str(self.count)
        self.addCleanup(os.environ.pop, "FAKE_COUNT")
        # Takes -np N away, as mpirun would.
        self.mpirun = self.folder / "mpirun"
        self.mpirun.write_text('#!/bin/sh\nshift 2\nexec "$@"\n', encoding="utf-8")
        self.mpirun.chmod(0o755)
        self.infile = self.folder / "in.file"
        self.infile.write_text("run 0\n", encoding="utf-8")
        self.out = self.folder / "out"
        self.cases = cases.make_cases([2.0e-3], [3], "linear", ["scaled"])

    def started(self):
        return len(self.count.read_text(encoding="utf-8").splitlines())

    def run_all(self, body=GOOD, redo=False, ranks=1, some=None):
        launcher = runs.Launcher(fake_lmp(self.folder, body), self.infile, str(self.mpirun), ranks)
        shown = progress.Progress(some or self.cases, 2, io.StringIO())
        runs.Runner(launcher, self.out, 2, shown).run(some or self.cases, redo, 0.01)

    def test_progress_says_what_is_taken_over(self):
        self.run_all()
        launcher = runs.Launcher(self.folder / "lmp", self.infile, str(self.mpirun), 1)
        stream = io.StringIO()
        runs.Runner(launcher, self.out, 2, progress.Progress(self.cases, 2, stream)).run(self.cases)
        self.assertEqual(stream.getvalue(),
                         "[3 of 3 runs done] by an earlier call, and taken over\n")

    def test_finished_runs_are_not_run_again(self):
        self.run_all(some=self.cases[:1])
        self.assertEqual(self.started(), 1)
        self.run_all()
        self.assertEqual(self.started(), 3)
        self.run_all()
        self.assertEqual(self.started(), 3)
        marker = runs.read_marker(cases.folder_of(self.out, self.cases[0]))
        self.assertEqual(marker["particles"], 625)
        timing = report.Timing.from_marker(marker)
        self.assertEqual((timing.loading_seconds, timing.loading_steps), (2.0, 15000))
        self.assertEqual(timing.total_steps, 31000)

    def test_redo_and_changed_inputs_run_again(self):
        self.run_all()
        self.run_all(redo=True)
        self.assertEqual(self.started(), 6)
        self.run_all(ranks=2)
        self.assertEqual(self.started(), 9)
        self.infile.write_text("run 1\n", encoding="utf-8")
        self.run_all(ranks=2)
        self.assertEqual(self.started(), 12)
        self.run_all(GOOD + "\n# another LAMMPS\n", ranks=2)
        self.assertEqual(self.started(), 15)
        (self.folder / "eepaplugin.so").write_bytes(b"another plugin")
        self.run_all(GOOD + "\n# another LAMMPS\n", ranks=2)
        self.assertEqual(self.started(), 18)

    def test_spoilt_marker_or_lost_curve_runs_again(self):
        self.run_all()
        first, second = (cases.folder_of(self.out, case) for case in self.cases[:2])
        (first / runs.MARKER).write_text("{", encoding="utf-8")
        (second / runs.CURVE).unlink()
        self.run_all()
        self.assertEqual(self.started(), 5)

    def test_failed_run_is_named_with_the_end_of_its_log(self):
        with self.assertRaises(runs.RunFailed) as failure:
            self.run_all("print('ERROR: Lost atoms', flush=True)\nsys.exit(3)\n",
                         some=self.cases[:1])
        for text in ("d2mm_scaled_linear_seed1", "status 3", "ERROR: Lost atoms", ".failed",
                     "-var seed 1"):
            self.assertIn(text, str(failure.exception))
        self.assertEqual([p.name for p in (self.out / "runs").iterdir()],
                         ["d2mm_scaled_linear_seed1.failed"])
        self.run_all(some=self.cases[:1])
        self.assertEqual([p.name for p in (self.out / "runs").iterdir()],
                         ["d2mm_scaled_linear_seed1"])

    def test_run_that_ends_early_without_an_error_is_a_failure(self):
        with self.assertRaisesRegex(runs.RunFailed, "status 0"):
            self.run_all("log.write_text('Stage pack\\n')\n", some=self.cases[:1])

    def test_interrupted_study_leaves_nothing_half_done(self):
        self.run_all(some=self.cases[:1])
        slow = GOOD.replace("log.write_text", "time.sleep(0 if names['seed'] == '1' else 60)\n"
                            "log.write_text", 1)
        script = self.folder / "study.py"
        script.write_text(
            "import sys, io\nfrom pathlib import Path\n"
            f"sys.path.insert(0, {str(STUDY)!r})\n"
            "from collapse import cases, progress, runs\n"
            f"launcher = runs.Launcher(Path({str(self.folder / 'lmp')!r}), "
            f"Path({str(self.infile)!r}), {str(self.mpirun)!r}, 1)\n"
            "some = cases.make_cases([2.0e-3], [3], 'linear', ['scaled'])\n"
            "try:\n"
            f"    runs.Runner(launcher, Path({str(self.out)!r}), 2, progress.Progress(some, 2,"
            " io.StringIO())).run(some, True, 0.01)\n"
            "except KeyboardInterrupt:\n    sys.exit(130)\n", encoding="utf-8")
        fake_lmp(self.folder, slow)
        study = subprocess.Popen([sys.executable, "-B", str(script)])
        self.addCleanup(study.kill)
        partial = [cases.folder_of(self.out, case).with_name(
            cases.folder_of(self.out, case).name + ".partial") for case in self.cases[1:]]
        deadline = time.monotonic() + 30.0
        while not all(folder.is_dir() for folder in partial):
            self.assertLess(time.monotonic(), deadline, "the runs do not start")
            time.sleep(0.01)
        study.send_signal(signal.SIGINT)
        self.assertEqual(study.wait(timeout=20.0), 130)
        self.assertEqual(sorted(p.name for p in (self.out / "runs").iterdir()),
                         ["d2mm_scaled_linear_seed1"])

    def test_command_has_every_variable(self):
        launcher = runs.Launcher(Path("/x/lmp"), Path("/x/in"), "mpirun", 2)
        command = launcher.command(CASE, Path("/out"))
        self.assertEqual(command[:4], ["mpirun", "-np", "2", "/x/lmp"])
        self.assertEqual(command[command.index("scaled") + 1], "yes")
        self.assertEqual(command[command.index("d") + 1], "0.002")
        # Open MPI 4 and 5 read different ones
        environment = launcher.environment()
        self.assertEqual(environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"], "1")
        self.assertEqual(environment["OMPI_MCA_rmaps_base_oversubscribe"], "1")
        self.assertEqual(environment["PRTE_MCA_rmaps_default_mapping_policy"], ":oversubscribe")

    def test_lmp_that_is_not_there(self):
        with self.assertRaisesRegex(FileNotFoundError, "--lmp /no/lmp"):
            runs.find_lmp(Path("/no/lmp"), [])
        with self.assertRaisesRegex(FileNotFoundError, "/no/a, /no/b: build"):
            runs.find_lmp(None, [Path("/no/a"), Path("/no/b")])
        with self.assertRaisesRegex(ValueError, "jobs is 0"):
            runs.Runner(runs.Launcher(Path("lmp"), self.infile), self.out, 0,
                        progress.Progress([], 1, io.StringIO()))


def timing(seconds, steps=10000, particles=625):
    return report.Timing(particles, seconds, steps, 2.0 * seconds, 2 * steps)


class Report(unittest.TestCase):
    def groups(self):
        coarse = timing(2.0)
        fine = timing(32.0, 20000, 5000)
        return [report.Group(1.0e-3, "scaled", [curve()], [fine], 3.0e-4),
                report.Group(2.0e-3, "scaled", [curve(3.0e6), curve(3.06e6)], [coarse, coarse],
                             6.0e-4),
                report.Group(1.0e-3, "unscaled", [curve()], [fine], 3.0e-4),
                report.Group(2.0e-3, "unscaled", [curve(1.5e6)], [coarse], 6.0e-4)]

    def test_rows(self):
        rows = report.make_rows(self.groups())
        self.assertEqual([(r.mode, r.diameter_mm, r.seeds) for r in rows],
                         [("scaled", 1.0, 1), ("scaled", 2.0, 2), ("unscaled", 1.0, 1),
                          ("unscaled", 2.0, 1)])
        self.assertEqual(rows[0].deviation_percent, 0.0)
        self.assertAlmostEqual(rows[1].deviation_percent,
                               100.0 * 0.01 * 9.0e4 / math.sqrt(3.0) / 9.5e4, delta=0.01)
        self.assertGreater(rows[3].deviation_percent, 20.0)
        self.assertAlmostEqual(rows[1].speed_up, 16.0)
        self.assertAlmostEqual(rows[0].particle_steps_per_second, 5000 * 20000 / 32.0)
        self.assertAlmostEqual(rows[1].final_coordination, 5.3, places=6)

    def test_loading_times_are_at_equal_strain(self):
        groups = self.groups()
        longer = groups[1].curves[0].loading_run_strain / 2.0
        fine = [curves.Curve(**{**vars(c), "loading_run_strain": longer})
                for c in groups[0].curves]
        rows = report.make_rows([report.Group(1.0e-3, "scaled", fine, groups[0].timings),
                                 groups[1]])
        self.assertAlmostEqual(rows[0].loading_seconds, 32.0)
        self.assertAlmostEqual(rows[1].loading_seconds, 1.0)

    def test_csv_text_and_figure(self):
        rows = report.make_rows(self.groups())
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            report.write_csv(rows, folder / "table.csv")
            lines = (folder / "table.csv").read_text(encoding="utf-8").splitlines()
            self.assertEqual(len(lines), 5)
            fields = dict(zip(lines[0].split(","), lines[1].split(",")))
            self.assertEqual(fields["diameter_mm"], "1")
            # A single seed has no standard error.
            self.assertEqual(fields["deviation_error_percent"], "")
            self.assertNotIn("nan", "".join(lines))
            text = report.text_table(rows, 5.0e3)
            self.assertNotIn("nan", text)
            self.assertIn("strain of the bulk, from 5 kPa", text)
            self.assertIn("The largest inertial number is 6.0e-04", text)
            report.plot(self.groups(), folder / "figure.png", "linear", 5.0e3, rows)
            self.assertGreater((folder / "figure.png").stat().st_size, 10000)
            report.plot(self.groups()[:1], folder / "one.png", "linear", 5.0e3)


class Arguments(unittest.TestCase):
    def refused(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as refusal:
            run_study.parse_arguments(list(words))
        self.assertEqual(refusal.exception.code, 2)
        return said.getvalue()

    def test_defaults(self):
        arguments = run_study.parse_arguments([])
        self.assertEqual(arguments.diameters, [1.0e-3, 1.5e-3, 2.0e-3])
        self.assertEqual(len(arguments.cases), 2 + 2 * 4 + 2 * 8)
        self.assertEqual(arguments.modes, ["scaled", "unscaled"])
        self.assertGreaterEqual(arguments.jobs, 1)

    def test_choices(self):
        self.assertEqual(len(run_study.parse_arguments(["--quick"]).cases), 4)
        self.assertEqual(len(run_study.parse_arguments(["--full", "--scaled"]).cases), 28)
        only = run_study.parse_arguments(["--unscaled", "--diameters", "3e-3", "--seeds", "2"])
        self.assertEqual([c.name for c in only.cases], ["d3mm_unscaled_linear_seed1",
                                                        "d3mm_unscaled_linear_seed2"])

    def test_build_folder_of_the_environment(self):
        before = os.environ.get("BUILD_DIR")
        os.environ["BUILD_DIR"] = "/elsewhere"
        try:
            self.assertEqual(run_study.parse_arguments([]).out, Path("/elsewhere/scale_collapse"))
        finally:
            if before is None:
                del os.environ["BUILD_DIR"]
            else:
                os.environ["BUILD_DIR"] = before

    def test_bad_arguments_are_named(self):
        for words, text in (
                (["--diameters", "0"], "diameter is 0.0, allowed is a number above 0"),
                (["--diameters", "nan"], "diameter is nan"),
                (["--diameters", "1e-3", "1e-3"], "one occurs twice"),
                (["--seeds", "0"], "seeds are 0"),
                (["--seeds", "1", "2"], "2 numbers of seeds for 3 diameters"),
                (["--law", "hertz"], "hertz"),
                (["--ranks", "0"], "--ranks is 0, allowed is 1 or more"),
                (["--jobs", "-1"], "--jobs is -1, allowed is 1 or more"),
                (["--preload", "10"], "--preload is 10 Pa, allowed is"),
                (["--scaled", "--unscaled"], "not allowed with"),
                (["--dref", "-1"], "reference diameter is -1")):
            with self.subTest(words=words):
                self.assertIn(text, self.refused(*words))

    def test_no_lammps_ends_with_a_message(self):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = run_study.main(["--quick", "--lmp", "/no/such/lmp"])
        self.assertEqual(code, 1)
        self.assertIn("--lmp /no/such/lmp", said.getvalue())


if __name__ == "__main__":
    unittest.main()

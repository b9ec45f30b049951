# SPDX-License-Identifier: GPL-2.0-only
"""coarsen with LAMMPS: a user's own in-file of a second, checked, stopped, gone on with, failing."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LMP = os.environ.get("EEPA_LMP", str(ROOT / "build" / "lmp"))

#: A particle pressed between two plates by a distance in proportion to d: with `scale` the stress is the
#: same, without it goes with 1/d. A seed makes it a little longer.
INFILE = """
variable scaled index yes
variable d index 1e-3
variable seed index 1
variable law string linear
if "${scaled} == yes" then "variable law string 'linear scale 1e-3'"
units si
atom_style sphere
comm_modify vel yes
boundary f f f
region box block -0.01 0.01 -0.01 0.01 -0.01 0.01
create_box 1 box
create_atoms 1 single 0 0 0
set group all diameter ${d} density 2000
pair_style gran/eepa ${law}
pair_coeff * * 1e3 2e3 0 0 0
variable gap equal v_d*(0.5-0.01*(1+0.01*v_seed))
fix top all wall/gran/eepa ${law} coeff 1e3 2e3 0 0 0 wall zplane NULL $(v_gap)
fix bottom all wall/gran/eepa ${law} coeff 1e3 2e3 0 0 0 wall zplane $(-v_gap) NULL
timestep 1e-7
thermo_style custom step f_top[3]
run 0
print "Result stress $(abs(f_top[3])/v_d^2:%.10g)"
"""


def coarsen(folder, *words):
    done = subprocess.run([sys.executable, "-B", "-m", "coarsen", *map(str, words)], cwd=folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "coarsen")})
    return done.returncode, done.stdout


class Runs(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = Path(self._folder.name)
        (self.folder / "in.mine").write_text(INFILE)

    def tearDown(self):
        self._folder.cleanup()

    def check(self, *more):
        return coarsen(self.folder, "check", "in.mine", "--diameters", "1e-3", "2e-3", "--seeds", "3", "--want",
                       "stress=5", "--lmp", LMP, "--cores", "2", *more)

    def test_scaled_is_equivalent_and_unscaled_is_not(self):
        status, text = self.check()
        self.assertEqual(status, 0, text)
        self.assertRegex(text, r"stress +0\.002 +0\.001 +[+-]0\.00% .* equivalent")
        self.assertIn("equivalent: ", text)
        self.assertIn("[6 of 6 runs done, about 0 s left]", text)
        # A run that is there is not repeated, and another variable makes all of them new.
        done = self.folder / "coarsen_check/check/d=0.002,seed=3/done"
        before = done.stat().st_mtime_ns
        self.assertEqual(self.check()[0], 0)
        self.assertEqual(done.stat().st_mtime_ns, before)
        status, text = self.check("--var", "scaled", "no")
        self.assertEqual(status, 3, text)
        self.assertRegex(text, r"stress +0\.002 +0\.001 +-50\.00% .* different")
        self.assertGreater(done.stat().st_mtime_ns, before)

    def test_a_changed_in_file_makes_runs_old(self):
        self.assertEqual(self.check()[0], 0)
        (self.folder / "in.mine").write_text(INFILE.replace("/v_d^2", "/v_d"))
        status, text = self.check()
        self.assertEqual(status, 3, text)
        self.assertRegex(text, r"stress +0\.002 +0\.001 +\+100\.00% .* different")

    def test_a_run_that_fails_is_named_with_its_log(self):
        (self.folder / "in.mine").write_text(INFILE.replace("run 0", "run nonsense"))
        status, text = self.check()
        self.assertEqual(status, 1, text)
        self.assertRegex(text, r"seed=\d failed, see its log.lammps:\nERROR")
        self.assertIn("run nonsense", text)
        self.assertIn("coarsen check: a run failed, see above", text)
        self.assertNotIn("jobid", text)  # which is in the log
        self.assertIn("jobid", (self.folder / "coarsen_check/snakemake.log").read_text())
        self.assertNotIn("Traceback", text)

    def test_an_in_file_without_results_is_told_what_to_print(self):
        (self.folder / "in.mine").write_text(INFILE.replace("Result ", "Outcome "))
        status, text = self.check()
        self.assertEqual(status, 1, text)
        self.assertIn("lines `Result NAME NUMBER` of stress", text)

    def test_a_run_after_the_run(self):
        (self.folder / "in.mine").write_text(INFILE + "write_restart ${out}/state.restart\n")
        (self.folder / "in.then").write_text("read_restart ${state}.restart\n"
                                             "print \"Result particles $(atoms)\"\n")
        status, text = coarsen(self.folder, "check", "in.mine", "--diameters", "1e-3", "2e-3", "--seeds", "2",
                               "--want", "stress=5", "particles=1", "--then", "in.then", "--state", "state",
                               "--lmp", LMP, "--cores", "2")
        self.assertEqual(status, 0, text)
        self.assertRegex(text, r"particles +0\.002 +0\.001 +\+0\.00% .* equivalent")

    def test_folders_with_spaces_and_names_of_any_form(self):
        folder = self.folder / "my runs"
        folder.mkdir()
        (folder / "press.lmp").write_text(INFILE.replace("run 0", "include ${files}/in.then run 0".replace(" run 0", "")))
        (folder / "in.then").write_text("run 0\n")
        status, text = coarsen(folder, "check", "press.lmp", "--diameters", "1e-3", "2e-3", "--seeds", "2", "--want",
                               "stress=5", "--var", "unused", "-2e-4", "--out", "out of it", "--lmp", LMP)
        self.assertEqual(status, 0, text)
        self.assertTrue((folder / "out of it/check/d=0.002,seed=2/infiles/press.lmp").is_file())

    def test_switches_of_lammps(self):
        (self.folder / "in.mine").write_text(INFILE + 'print "Result threads $(is_active(package,omp))"\n'
                                                      'print "Result word ${word}"\n')
        (self.folder / "study.yaml").write_text("groups: {one: {infile: in.mine}}\n")
        status, text = coarsen(self.folder, "run", "study.yaml", "--lmp", LMP, "--switches",
                               "-sf omp -pk omp 1 -var word '7 8'")
        self.assertEqual(status, 0, text)
        log = (self.folder / "coarsen_run/one/run/log.lammps").read_text()
        self.assertIn("Result threads 1", log)
        self.assertIn("Result word 7 8", log)

    def test_a_study_of_any_in_file_has_a_table(self):
        (self.folder / "study.yaml").write_text(
            "groups: {one: {infile: in.mine, d: [1e-3, 2e-3], seed: 1..2}}\n")
        status, text = coarsen(self.folder, "run", "study.yaml", "--lmp", LMP)
        self.assertEqual(status, 0, text)
        lines = (self.folder / "coarsen_run/runs.csv").read_text().splitlines()
        self.assertEqual(len(lines), 5)
        self.assertIn("stress", lines[0].split(","))
        status, text = coarsen(self.folder, "report", "coarsen_run")
        self.assertEqual(status, 0, text)
        self.assertIn('"text":"stress"', (self.folder / "coarsen_run/report.html").read_text())
        (self.folder / "in.silent").write_text(INFILE.replace("Result", "result"))
        (self.folder / "study.yaml").write_text("groups: {one: {infile: in.silent, d: 1e-3, seed: 1}}\n")
        status, text = coarsen(self.folder, "run", "study.yaml", "--lmp", LMP, "--out", "silent")
        status, text = coarsen(self.folder, "report", "silent")
        self.assertEqual(status, 1, text)
        self.assertIn("no run is a specimen of in.confined", text)

    def test_no_lammps_is_said_so(self):
        status, text = coarsen(self.folder, "check", "in.mine", "--diameters", "1", "2", "--want", "a=1", "--lmp",
                               "no_such_lmp")
        self.assertEqual(status, 1)
        self.assertIn("no LAMMPS at no_such_lmp", text)

    def test_a_specimen_is_calibrated_checked_and_reported(self):
        infiles = ROOT / "examples" / "scale_collapse"
        (self.folder / "targets.csv").write_text("quantity,stress,value,error\nstrain,1.2e4,0.0025,0.0001\n")
        status, text = coarsen(self.folder, "calibrate", "targets.csv", "--diameter", "3e-3", "--side", "18e-3", "--free",
                               "k1", "--seeds", "2", "--steps", "2", "--lmp", LMP)
        self.assertEqual(status, 0, text)
        self.assertRegex((self.folder / "coarsen_calibrate/in.calibrated").read_text(),
                         r"variable k1 +index \S+ +# found, \+- ")
        found = (self.folder / "coarsen_calibrate/calibration.csv").read_text().splitlines()
        value, error = (float(x) for x in found[1].split(",")[4:6])
        self.assertAlmostEqual(value, 0.0025, delta=0.0005)
        self.assertGreater(error, 0.03)  # 4% of the target
        status, text = coarsen(self.folder, "check", infiles / "in.confined", "--diameters", "2e-3", "3e-3", "--seeds",
                               "2", "--var", "side", "18e-3", "--var", "nref", "6998", "--var", "level", "16e3", "--var",
                               "rate", "2", "--want", "strain=50", "porosity=20", "--lmp", LMP)
        self.assertIn(status, (0, 4), text)
        status, text = coarsen(self.folder, "report", "coarsen_check")
        self.assertEqual(status, 0, text)
        self.assertIn("plotly", (self.folder / "coarsen_check/report.html").read_text())


if __name__ == "__main__":
    unittest.main()

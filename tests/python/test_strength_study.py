# SPDX-License-Identifier: GPL-2.0-only
"""examples/scale_collapse's study of strength and its calibration from end to end, with a LAMMPS
that the environment names (EEPA_LMP), on specimens so small that the whole takes minutes."""
from __future__ import annotations

import contextlib
import csv
import io
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

STUDY = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path.insert(0, str(STUDY))

import calibrate  # noqa: E402
import run_strength  # noqa: E402
from collapse import curves  # noqa: E402

LMP = os.environ.get("EEPA_LMP")


def called(main, *words):
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = main([*words, "--lmp", LMP, "--jobs", "2"])
    return code, said.getvalue()


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Strength(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        cls.code, cls.said = called(run_strength.main, "--quick", "--out", str(cls.out))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def samples(self, name, file="curve.csv"):
        return curves.read_samples(self.out / "runs" / name / file)

    def test_quick_study_runs_to_its_report(self):
        self.assertEqual(self.code, 0, self.said)
        self.assertIn("core-hours", self.said)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        for text in ("QUICK MODE", "before", "after failure", "exponent of stiffness"):
            self.assertTrue(text in page, text)  # the page is long, and has pictures in it
        self.assertRegex(page.split("Versions and machine")[-1], r"runs +commit \w+.*; LAMMPS \d")
        self.assertNotRegex(page, r'(src|href)="(?!data:)')
        for name in re.findall(r'alt="([^"]+)"', page):
            self.assertTrue(name)
        with (self.out / "strength.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({(r["material"], r["mode"]) for r in rows} >= {
            ("base", "scaled"), ("base", "unscaled"), ("cohesionless", "scaled"),
            ("plateau", "scaled")}, True)
        by_key = {(r["material"], r["mode"], r["diameter_mm"], r["special"]): r for r in rows}
        off = {mode: float(by_key["base", mode, "3", ""]["loading_deviation"])
               for mode in ("scaled", "unscaled")}
        self.assertGreater(off["unscaled"], 15.0)
        self.assertLess(off["scaled"], off["unscaled"] / 2.0)

    def test_stress_follows_the_pressure_and_is_held(self):
        samples = self.samples("base_d3mm_scaled_15mm_wide_seed1_confined")
        top = samples[samples["stage"] == "hold"]["stress_top"]
        for level in (16.0e3, 36.0e3):
            self.assertLess(np.min(np.abs(top / level - 1.0)), 0.02)
        self.assertLess(samples["stress_top"].max(), 1.1 * 36.0e3)
        # Lateral stress is a part of the axial one in confined compression.
        load = samples[samples["stage"] == "load"][-1]
        self.assertTrue(0.2 < load["stress_x"] / load["stress_top"] < 0.7)

    def test_unconfined_specimen_has_free_sides_and_fails(self):
        name = "base_d3mm_scaled_15mm_wide_seed1_unconfined_36kPa"
        unload, crush = self.samples(name, "unload.csv"), self.samples(name)
        self.assertLess(abs(unload["stress_top"][-1]), 0.1 * 36.0e3)
        stress = crush["stress_top"][crush["stage"] == "crush"]
        peak = int(np.argmax(stress))
        self.assertLess(stress[peak], 0.5 * 36.0e3)
        self.assertLess(stress[peak + 1:].min(), 0.8 * stress[peak])
        self.assertEqual(len(list((self.out / "runs" / name).glob("*.png"))), 2)

    def test_strength_rises_with_consolidation(self):
        with (self.out / "strength.csv").open(encoding="utf-8") as file:
            row = next(r for r in csv.DictReader(file) if r["material"] == "base"
                       and r["mode"] == "scaled" and r["diameter_mm"] == "2"
                       and not r["special"])
        self.assertGreater(float(row["strength_36kPa"]), float(row["strength_16kPa"]))

    def test_zz_report_leaves_out_what_is_not_there_or_of_other_inputs(self):
        folder = self.out / "runs" / "plateau_d3mm_scaled_15mm_wide_seed2_confined"
        marker = folder / "done.json"
        before = marker.read_text(encoding="utf-8")
        self.addCleanup(marker.write_text, before, encoding="utf-8")
        self.assertRegex(before, r'"commit": "\w+')
        marker.write_text(re.sub(r'"fingerprint": "\w+"', '"fingerprint": "0"', before),
                          encoding="utf-8")
        code, said = called(run_strength.main, "--quick", "--report", "--out", str(self.out))
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"\b1 of \d+ runs are not there")
        with (self.out / "strength.csv").open(encoding="utf-8") as file:
            seeds = [r["seeds"] for r in csv.DictReader(file) if r["material"] == "plateau"]
        self.assertEqual(seeds, ["1"])

    def test_zz_resuming_takes_everything_over(self):
        code, said = called(run_strength.main, "--quick", "--out", str(self.out))
        self.assertEqual(code, 0)
        self.assertRegex(said, r"\[(\d+) of \1 runs done\] by an earlier call")
        self.assertIn("a speed that finished runs had", said)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Calibration(unittest.TestCase):
    """A specimen of the very packing that made the target must give its stiffness back."""

    SHAPE = ("--particles", "8100", "--side", "15e-3")

    def test_stiffness_is_recovered_and_the_call_resumes(self):
        with tempfile.TemporaryDirectory() as name:
            out = Path(name)
            known, made = 6.5e3, out / "made"
            from collapse.progress import Progress
            from collapse.runs import Launcher, Runner
            from collapse.specimens import Confined, Material
            one = Confined(Material("truth", k1=known), 3.0e-3, True, 1001, (20.0e3,),
                           side=15.0e-3, reference_particles=8100)
            Runner(Launcher(Path(LMP), STUDY / "in.confined"), made, 1,
                   Progress([one], 1, io.StringIO())).run([one])
            loading = curves.load_curve(made / "runs" / one.name / "curve.csv", 5.0e3).loading
            target = out / "target.csv"
            table = np.column_stack([loading.stress, loading.strain["bulk"],
                                     loading.bulk_porosity])
            np.savetxt(target, table, delimiter=",", header="stress,strain,porosity", comments="")
            words = ("fit", "--diameter", "3e-3", "--stress-strain", str(target),
                     "--porosity-stress", str(target), "--free", "k1", "--seeds", "1", "--level",
                     "20e3", "--steps", "5", "--out", str(out / "fit"), *self.SHAPE)
            code, said = called(calibrate.main, *words)
            self.assertEqual(code, 0, said)
            text = (out / "fit" / "in.calibrated").read_text(encoding="utf-8")
            found = float(re.search(r"variable k1 +index (\S+)", text).group(1))
            self.assertLess(abs(found / known - 1.0), 0.03, said)
            before = len(list((out / "fit" / "runs").iterdir()))
            code, again = called(calibrate.main, *words)
            self.assertEqual(code, 0)
            self.assertEqual((out / "fit" / "in.calibrated").read_text(encoding="utf-8"), text)
            self.assertEqual(len(list((out / "fit" / "runs").iterdir())), before)


if __name__ == "__main__":
    unittest.main()

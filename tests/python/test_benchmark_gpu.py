# SPDX-License-Identifier: GPL-2.0-only
"""benchmarks/run_gpu.py: sizes, reading, tables, what a card says; and with a LAMMPS that the environment names
(EEPA_LMP), a run of it, on KOKKOS where there is KOKKOS."""
from __future__ import annotations

import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
from datetime import datetime
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "benchmarks"), str(ROOT / "examples" / "scale_collapse"), str(ROOT / "coarsen")]

from bench import card, gpu, lammps  # noqa: E402

LMP = os.environ.get("EEPA_LMP")
LOG = """\
Loop time of 9 on 1 procs for 10 steps with 8 atoms
Pair    | 1          | 1          | 1          |   0.0 | 70.37
Loop time of 0.5 on 2 procs for 250 steps with 1000 atoms
Pair    | 0.25       | 0.25       | 0.25       |   0.0 | 50.00
"""
#: A card with 30 W at rest, 100 W and then 200 W in the timed part. 1,000 MiB are others'.
SAMPLES = """\
2026/11/28 19:00:00.000, 30.00, 1000
2026/11/28 19:00:01.000, 60.00, 1200
2026/11/28 19:00:02.000, 100.00, 1500
2026/11/28 19:00:03.000, 200.00, 1500
2026/11/28 19:00:04.000, 40.00, 1400
"""


class Reading(unittest.TestCase):
    def test_last_run_of_a_log_without_marks(self):
        run = gpu.read_log(LOG)
        self.assertEqual((run.loop, run.steps, run.atoms, run.pair), (0.5, 250, 1000, 0.25))

    def test_marked_run(self):
        run = gpu.read_log(LOG.replace("Loop time of 0.5", "Stage timed\nLoop time of 0.25")
                           + "Stage done\nLoop time of 7 on 1 procs for 0 steps with 8 atoms\n")
        self.assertEqual((run.loop, run.steps), (0.25, 250))

    def test_log_without_run(self):
        with self.assertRaisesRegex(ValueError, "no finished timed run"):
            gpu.read_log("ERROR\n")

    def test_energy_is_that_of_the_timed_part(self):
        end = datetime(2026, 11, 28, 19, 0, 3, 500000).timestamp()
        samples = card.read_samples(SAMPLES + "2026/11/28 19:00:05.000, [N/A], 1\n2026/11/")
        self.assertEqual(len(samples), 5)
        energy, memory = card.energy_and_memory(samples, f"words\nClock {end:.9f}\n", 2.0)
        self.assertAlmostEqual(energy, 0.5 * (100.0 + 200.0) * 2.0)
        self.assertAlmostEqual(memory, 500 * 2.0**20)
        for screen, loop in (("", 2.0), (f"Clock {end:.9f}\n", 1e-3)):    # no time; too short for a sample
            self.assertEqual(card.energy_and_memory(samples, screen, loop), (None, None))
        self.assertEqual(card.energy_and_memory([], f"Clock {end:.9f}\n", 2.0), (None, None))

    def test_watch_reads_nvidia_smi(self):
        with tempfile.TemporaryDirectory() as folder:
            smi = Path(folder) / "nvidia-smi"
            smi.write_text("#!/bin/sh\n"
                           "case $* in *power.draw*) ;; *) echo 'Card, 1.2'; exit ;; esac\n"
                           "while true; do date '+%Y/%m/%d %H:%M:%S.%3N, 50.0, 100'; sleep 0.02; done\n", encoding="utf-8")
            smi.chmod(0o755)
            with mock.patch.dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}"):
                self.assertEqual(card.names(), "Card, 1.2")
                with card.Watch() as watch:
                    self.assertEqual(len(watch.samples), 1)
                    subprocess.run(["sleep", "0.3"], check=True)
        self.assertGreater(len(watch.samples), 3)
        self.assertLess(abs(watch.samples[-1][0] - datetime.now().timestamp()), 60.0)

    def test_machine_without_cards(self):
        with mock.patch.dict(os.environ, PATH=""):
            self.assertEqual(card.names(), "")
            with card.Watch() as watch:
                pass
            self.assertEqual(watch.samples, [])


class Sizes(unittest.TestCase):
    def test_all_sizes_take_about_as_long(self):
        self.assertEqual([(size.side, size.steps) for size in gpu.lattices([1e5, 4e6, 6.4e7], [0])],
                         [(46, 2000), (159, 497), (400, 200)])

    def test_copies_give_about_as_many(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "bench").mkdir()
            (Path(folder) / "bench" / "data.chute").touch()
            for count in (1e5, 1e6, 4e6, 1e7):
                with mock.patch("bench.cases.packing", return_value=Path("some.data")):
                    loads = [*gpu.dense(lammps.Program(Path("lmp")), Path(folder), [count]), *gpu.chutes(Path(folder), [count])]
                for load in loads:
                    made = float(load.case.name.split()[1])
                    self.assertLess(abs(made / count - 1.0), 0.1, load)


class Tables(unittest.TestCase):
    def rows(self):
        return [{"case": case, "particles": 1000, "round": k, "law": law, "ms_a_step": ms, "joule_a_particle_step": None,
                 **({"pair_ms_a_step": 0.5 * ms} if k == 0 else {})}
                for case, k, hooke, eepa in (("a", 0, 1.0, 0.5), ("a", 1, 2.0, 1.8), ("a", 2, 4.0, 2.4), ("b", 0, 2.0, 3.0))
                for law, ms in (("hooke", hooke), ("sds", eepa))]

    def test_medians_of_ratios_of_the_same_round(self):
        text = gpu.table(self.rows()).split("\n\n")
        self.assertEqual([part.splitlines()[-2:] for part in text if part.startswith("|")], [
            ["| a | 1,000 | 2 | 1.8 (0.60) |", "| b | 1,000 | 2 | 3 (1.50) |"],
            ["| a | 1,000 | 0.5 | 0.25 |", "| b | 1,000 | 1 | 1.5 |"],
            ["| a | 1,000 | 0.0005 | 0.000556 |", "| b | 1,000 | 0.0005 | 0.000333 |"]])
        self.assertEqual([part for part in text if part.endswith(":")][:2],
                         ["Milliseconds a step:", "Of these in pair kernels, waiting for each kernel:"])

    def test_speeds(self):
        self.assertEqual(gpu.speeds(self.rows())["a", "hooke"], [(1000, 5e5)])

    def test_energy_and_memory(self):
        rows = [{**row, "joule_a_particle_step": 2.5e-7, "card_bytes_a_particle": 1234.0} for row in self.rows()]
        text = gpu.table(rows)
        self.assertIn("| a | 1,000 | 250 | 250 |", text)
        self.assertIn("| a | 1,000 | 1.23e+03 | 1.23e+03 |", text)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class InLammps(unittest.TestCase):
    def test_every_case_and_law(self):
        help_text = subprocess.run([LMP, "-h"], capture_output=True, text=True, check=True).stdout
        installed = re.search(r"Installed packages:\s+((?:[A-Z0-9-]+\s+)+)", help_text)[1].split()
        with tempfile.TemporaryDirectory() as folder:
            words = [sys.executable, str(ROOT / "benchmarks" / "run_gpu.py"), "--lmp", LMP, "--quick", "--out", folder,
                     "--lammps-source", os.environ["EEPA_LAMMPS_SOURCE"], "--kokkos", "t 1" if "KOKKOS" in installed else ""]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with (Path(folder) / "gpu.csv").open(encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            text = (Path(folder) / "gpu.md").read_text(encoding="utf-8")
            self.assertGreater((Path(folder) / "gpu.png").stat().st_size, 10000)
        self.assertEqual([(row["case"], row["law"]) for row in rows],
                         [(case, law) for case in ("lattice, no list", "lattice, a list every 20", "dense", "chute")
                          for law in (gpu.REFERENCE, *gpu.LAWS)])
        for row in rows:
            self.assertGreater(float(row["ms_a_step"]), 0.0)
            self.assertGreater(float(row["pair_ms_a_step"]), 0.0)
        contacts = {(row["case"], row["law"]): float(row["contacts_a_particle"]) for row in rows if row["contacts_a_particle"]}
        for law in gpu.LAWS:
            self.assertAlmostEqual(contacts["dense", law] / contacts["dense", gpu.REFERENCE], 1.0, delta=0.1)
            # hysteresis slows a flow down, which then is denser
            self.assertAlmostEqual(contacts["chute", law] / contacts["chute", gpu.REFERENCE], 1.15, delta=0.15)
        self.assertIn("| chute | 32,000 |", text)


if __name__ == "__main__":
    unittest.main()

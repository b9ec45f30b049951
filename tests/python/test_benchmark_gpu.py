# SPDX-License-Identifier: GPL-2.0-only
"""benchmarks/run_gpu.py: sizes, reading, tables, what a card says; and with a LAMMPS that the environment names
(EEPA_LMP), a run of it, on KOKKOS where there is KOKKOS."""
from __future__ import annotations

import contextlib
import csv
import io
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

from bench import card, gpu, gpu_tables, lammps, lammps_log  # noqa: E402

LMP = os.environ.get("EEPA_LMP")
LOG = """\
LAMMPS (4 Feb 2025)
Loop time of 9 on 1 procs for 200 steps with 1000 atoms
Figure contacts_before 2900.0
Stage short
Loop time of 0.5 on 1 procs for 50 steps with 1000 atoms
Pair    | 0.25       | 0.25       | 0.25       |   0.0 | 50.00
Neighbor list builds = 2
print           "Stage timed"
Stage timed
Loop time of 1.5 on 1 procs for 250 steps with 1000 atoms
Pair    | 1.0        | 1.0        | 1.0        |   0.0 | 70.37
Neighbor list builds = 10
Stage done
Loop time of 7 on 1 procs for 0 steps with 1000 atoms
Figure contacts_after 3100.0
"""
#: A card with 30 W at rest, 60 W, then 100 W and 200 W in the timed part, which begins at 19:00:00.5. 1,000 MiB are others'.
SAMPLES = """\
2026/11/28 19:00:01.000, 60.00, 1200
2026/11/28 19:00:02.000, 100.00, 1500
2026/11/28 19:00:03.000, 200.00, 1500
2026/11/28 19:00:04.000, 40.00, 1400
"""


class Reading(unittest.TestCase):
    def test_the_longer_run_less_the_shorter(self):
        run = gpu.read_log(LOG)
        self.assertEqual((run.loop, run.steps, run.atoms, run.pair, run.builds), (1.0, 200, 1000, 0.75, 8))
        self.assertEqual(run.contacts, 3000.0)

    def test_log_without_all_runs(self):
        for log in ("ERROR\n", LOG.replace("Stage done", "ERROR"), LOG.replace("\nStage short", "")):
            with self.assertRaisesRegex(lammps_log.BadLog, "no finished timed run"):
                gpu.read_log(log)

    def test_energy_is_that_of_the_timed_part_but_its_first_second(self):
        end = datetime(2026, 11, 28, 19, 0, 3, 500000).timestamp()
        before = card.read_samples("2026/11/28 18:59:00.000, 30.00, 1000\n")
        samples = card.read_samples(SAMPLES + "2026/11/28 19:00:05.000, [N/A], 1\n2026/11/")
        self.assertEqual(len(samples), 4)
        # in the midst of another line
        energy, memory = card.energy_and_memory(before, samples, f"Pair | 0.Clock {end:.9f}\n", 3.0)
        self.assertAlmostEqual(energy, 0.5 * (100.0 + 200.0) * 3.0)
        self.assertAlmostEqual(memory, 500 * 2.0**20)
        for screen, loop in (("", 3.0), (f"Clock {end:.9f}\n", 0.9)):    # no time; too short
            self.assertEqual(card.energy_and_memory(before, samples, screen, loop), (None, None))
        self.assertEqual(card.energy_and_memory([], [], f"Clock {end:.9f}\n", 3.0), (None, None))

    def smi(self, folder, fields):
        """A nvidia-smi that knows some fields, and says each sample at once or again and again."""
        path = Path(folder) / "nvidia-smi"
        path.write_text("#!/bin/sh\nsay() { date '+%Y/%m/%d %H:%M:%S.%3N, 50.0, 100'; }\n"
                        f"case $* in *driver_version*) echo 'Card, 1.2'; exit ;; {fields}) ;; *) exit 2 ;; esac\n"
                        "case $* in *-lms*) while say; do sleep 0.002; done ;; *) say ;; esac\n", encoding="utf-8")
        path.chmod(0o755)
        return mock.patch.dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}")

    def test_watch_reads_nvidia_smi(self):
        for fields in ("*power.draw.instant*", "*power.draw,*"):    # of a new driver and of an old one
            with tempfile.TemporaryDirectory() as folder, self.smi(folder, fields):
                self.assertEqual(card.names(), "Card, 1.2")
                with card.Watch() as watch:
                    self.assertEqual(len(watch.before), 1)
                    subprocess.run(["sleep", "0.3"], check=True)
            self.assertGreater(len(watch.samples), 3)
            self.assertLess(abs(watch.samples[-1][0] - datetime.now().timestamp()), 60.0)

    def test_samples_are_more_than_a_pipe_holds(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "nvidia-smi"
            path.write_text("#!/bin/sh\ncase $* in *-lms*) ;; *) echo '2026/11/28 19:00:01.000, 60.00, 1200'; exit ;; esac\n"
                            "yes '2026/11/28 19:00:01.000, 60.00, 1200' | head -n 5000\ntouch $0.done\nsleep 60\n", encoding="utf-8")
            path.chmod(0o755)
            with mock.patch.dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}"), card.Watch() as watch:
                for _ in range(600):
                    if Path(f"{path}.done").exists():
                        break
                    subprocess.run(["sleep", "0.1"], check=True)
        self.assertEqual(len(watch.samples), 5000)

    def test_machine_without_cards(self):
        with mock.patch.dict(os.environ, PATH=""):
            self.assertEqual(card.names(), "")
            with card.Watch() as watch:
                pass
            self.assertEqual((watch.before, watch.samples), ([], []))


class Sizes(unittest.TestCase):
    def test_runs_take_seconds_on_a_card(self):
        for size in gpu.lattices([1e5, 1e6, 4e6, 1e7], [0]):
            seconds = size.steps * size.side**3 / 2e9    # as one H200 has them
            self.assertTrue(0.5 <= seconds <= 10.0, seconds)

    def test_copies_give_about_as_many(self):
        for count in (1e5, 1e6, 4e6, 1e7):
            with mock.patch("bench.cases.packing", return_value=Path("some.data")):
                loads = [*gpu.dense(lammps.Program(Path("lmp")), Path("work"), [count]), *gpu.chutes(Path("data.chute"), [count])]
            for load in loads:
                made = float(load.case.name.split()[1])
                self.assertLess(abs(made / count - 1.0), 0.1, load)


class Tables(unittest.TestCase):
    def rows(self):
        return [{"case": case, "particles": particles, "round": k, "law": law, "ms_a_step": ms, "joule_a_particle_step": None,
                 "card_bytes": 1e9 + 700.0 * particles * ms, **({"pair_ms_a_step": 0.5 * ms} if k == 0 else {})}
                for case, particles, k, hooke, eepa in (("a", 1000, 0, 1.0, 0.5), ("a", 1000, 1, 2.0, 1.8), ("a", 1000, 2, 4.0, 2.4),
                                                        ("b", 1000, 0, 2.0, 3.0), ("b", 3000, 0, 2.0, 3.0))
                for law, ms in (("hooke", hooke), ("sds", eepa))]

    def test_medians_of_ratios_of_the_same_round(self):
        text = gpu_tables.tables(self.rows()).split("\n\n")
        titles = [part for part in text if part.endswith(":")]
        lines = dict(zip(titles, ([line for line in part.splitlines() if "1,000" in line] for part in text if part.startswith("|"))))
        self.assertEqual(lines, {
            "Milliseconds a step:": ["| a | 1,000 | 2 | 1.8 (0.60) |", "| b | 1,000 | 2 | 3 (1.50) |"],
            "LAMMPS's section Pair, waiting for each kernel, ms a step:": ["| a | 1,000 | 0.5 | 0.25 (0.50) |", "| b | 1,000 | 1 | 1.5 (1.50) |"],
            "10^9 particle steps a second:": ["| a | 1,000 | 0.0005 | 0.000556 (1.67) |", "| b | 1,000 | 0.0005 | 0.000333 (0.67) |"],
            # one size says nothing of what a program without particles takes
            "Memory of the card, bytes a particle more:": ["| b | from 1,000 to 3,000 | 1400 | 2100 |"]})

    def test_speeds(self):
        self.assertEqual(gpu_tables.speeds(self.rows())["a", "hooke"], [(1000, 5e5)])

    def test_energy(self):
        text = gpu_tables.tables([{**row, "joule_a_particle_step": 2.5e-7} for row in self.rows()])
        self.assertIn("| a | 1,000 | 250 | 250 (1.00) |", text)


class Failing(unittest.TestCase):
    def test_a_run_that_fails_loses_no_other(self):
        program = lammps.Program(Path("lmp"), bind=False)
        noted = []

        def run(_, __, folder, variables, **___):
            if variables["law"] == "sds":
                raise lammps.RunFailed("out of memory")
            (folder / "log.lammps").write_text(LOG if variables["law"] == "hooke" else "ERROR\n")
            return lammps.Finished(folder / "log.lammps", 1.0, 0)
        with tempfile.TemporaryDirectory() as folder, mock.patch("bench.gpu.run_lammps", run), \
                contextlib.redirect_stdout(io.StringIO()):
            rows = gpu.measure(program, [], gpu.lattices([1e3], [0]), ["sds", "constant"], 2, Path(folder),
                               lambda some: noted.append(len(some)))
        self.assertEqual([row["law"] for row in rows], ["hooke", "hooke"])
        self.assertEqual(noted, [1, 2])
        self.assertAlmostEqual(rows[0]["ms_a_step"], 5.0)

    def test_the_processors_style_is_no_answer(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "log.lammps"
            for text, said in ((LOG, "gran/hooke/history/kk did not run"), ("(1) pair gran/hooke/history/kk, perpetual\n" + LOG, None)):
                log.write_text(text)
                with mock.patch("bench.gpu.run_lammps", return_value=lammps.Finished(log, 1.0, 0)), \
                        contextlib.redirect_stdout(io.StringIO()) as out:
                    rows = gpu.measure(lammps.Program(Path("lmp")), ["-sf", "kk"], gpu.lattices([1e3], [0]), [], 1, Path(folder))
                self.assertEqual(len(rows), 0 if said else 1)
                self.assertIn(said or "ms a step", out.getvalue())

    def test_mistakes_are_told_before_anything_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            for words, said in ((["--lmp", "/none"], "there is no /none"), (["--lmp", sys.executable, "--particles", "10"], "allowed are"),
                                (["--lmp", sys.executable, "--chute", "/none"], "there is no /none: name LAMMPS's bench/data.chute"),
                                (["--draw"], "No such file")):
                done = subprocess.run([sys.executable, str(ROOT / "benchmarks" / "run_gpu.py"), "--out", folder, *words],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(said, done.stderr)
                self.assertNotIn("Traceback", done.stderr)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class InLammps(unittest.TestCase):
    def test_every_case_and_law(self):
        help_text = subprocess.run([LMP, "-h"], capture_output=True, text=True, check=True).stdout
        api = re.search(r"^KOKKOS package API:(.*)$", help_text, re.MULTILINE)
        kokkos = "" if api is None else "g 1" if "CUDA" in api[1] else "t 1"
        chute = Path(os.environ["EEPA_LAMMPS_SOURCE"]) / "bench" / "data.chute"
        with tempfile.TemporaryDirectory() as folder:
            words = [sys.executable, str(ROOT / "benchmarks" / "run_gpu.py"), "--out", folder]
            done = subprocess.run([*words, "--lmp", LMP, "--quick", "--rounds", "1", "--chute", str(chute), "--kokkos", kokkos],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            made = [Path(folder) / name for name in ("gpu.md", "gpu.png")]
            text = made[0].read_text(encoding="utf-8")
            for path in made:
                self.assertGreater(path.stat().st_size, 1000)
                path.unlink()
            subprocess.run([*words, "--draw"], capture_output=True, check=True)
            self.assertEqual(made[0].read_text(encoding="utf-8"), text)
            with (Path(folder) / "gpu.csv").open(encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
        self.assertIn("LAMMPS (", text.splitlines()[0])
        self.assertIn("| chute | 32,000 |", text)
        self.assertEqual([(row["case"], row["law"]) for row in rows],
                         [(case, law) for case in ("lattice, no list", "lattice, a list every 20", "dense", "chute")
                          for law in (gpu.REFERENCE, *gpu.LAWS)])
        contacts = {(row["case"], row["law"]): float(row["contacts_a_particle"]) for row in rows}
        for row in rows:
            self.assertEqual(row["steps"], "48")    # of 60 and of 12
            if row["case"].startswith("lattice"):
                self.assertEqual(row["builds"], "0" if "no list" in row["case"] else "3")
        for law in gpu.LAWS:
            self.assertAlmostEqual(contacts["dense", law] / contacts["dense", gpu.REFERENCE], 1.0, delta=0.1)
            # hysteresis slows a flow down, which then is denser
            self.assertTrue(1.0 < contacts["chute", law] / contacts["chute", gpu.REFERENCE] < 1.6)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-only
"""README.md: what it shows is there, and its in-file gives the figures that it names."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
IN_FILE = ROOT / "examples" / "quick_start" / "in.first"
LMP = os.environ.get("EEPA_LMP")


def stress_at_the_end(in_file, *words):
    """In kPa."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([LMP, "-in", str(in_file), "-screen", "none", *words], cwd=folder,
                              stderr=subprocess.PIPE, text=True)
        log = (Path(folder) / "log.lammps").read_text()
    if done.returncode:
        raise AssertionError(log[-500:] + done.stderr)
    if "WARNING" in log:
        raise AssertionError(log[log.index("WARNING"):][:300])
    *_, last = re.findall(r"^ *([\d.e+-]+(?: +[\d.e+-]+){3}) *$", log, re.MULTILINE)
    return float(last.split()[2]) / 1000.0


class Readme(unittest.TestCase):
    def test_is_short(self):
        self.assertLessEqual(len(TEXT.split()), 800)

    def test_shows_the_in_file_as_it_is(self):
        self.assertIn(f"```\n{IN_FILE.read_text(encoding='utf-8')}```\n", TEXT)

    def test_commands_name_in_files_that_are_there(self):
        files = re.findall(r"-in (\S+?)[`\s]", TEXT)
        self.assertGreater(len(files), 1)
        for file in files:
            self.assertTrue((ROOT / file).exists(), file)

    def test_links_lead_somewhere(self):
        links = re.findall(r"\]\(([^)]+)\)", TEXT)
        self.assertGreater(len(links), 15)
        for link in links:
            if not link.startswith("http"):
                self.assertTrue((ROOT / link).exists(), link)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Stresses(unittest.TestCase):
    """The figures named in kPa. Another packing changes them by 5%, as another compiler may."""

    named = [float(word) for word in re.findall(r"(\d+)\s+kPa", TEXT)]

    def test_scaled(self):
        coarse, fine, _ = self.named
        self.assertAlmostEqual(stress_at_the_end(IN_FILE), coarse, delta=0.15 * coarse)
        self.assertAlmostEqual(stress_at_the_end(IN_FILE, "-var", "d", "1e-3"), fine, delta=0.15 * fine)

    def test_unscaled(self):
        with tempfile.TemporaryDirectory() as folder:
            changed = Path(folder) / "in.unscaled"
            text = IN_FILE.read_text(encoding="utf-8")
            changed.write_text(text.replace(" scale 1e-3", ""), encoding="utf-8")
            self.assertNotEqual(changed.read_text(encoding="utf-8"), text)
            unscaled = self.named[2]
            self.assertAlmostEqual(stress_at_the_end(changed), unscaled, delta=0.15 * unscaled)


if __name__ == "__main__":
    unittest.main()

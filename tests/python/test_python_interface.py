# SPDX-License-Identifier: GPL-2.0-only
"""examples/python: the notebook is the script; and, where the environment names a build folder (EEPA_BUILD_DIR)
with the plugin, the script runs."""
from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import pandas as pd

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "python"
SPEC = importlib.util.spec_from_file_location("make_notebook", EXAMPLE / "make_notebook.py")
make_notebook = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(make_notebook)
BUILD = os.environ.get("EEPA_BUILD_DIR", "")
# an instrumented plugin does not load into this Python
HAS_PLUGIN = BUILD and not os.environ.get("EEPA_SANITIZE") and all(
    (Path(BUILD) / name).is_file() for name in ("eepaplugin.so", "lmp"))


def run(folder, *command, **settings):
    environment = {**os.environ, "MPLBACKEND": "Agg", "PYTHON": sys.executable, **settings}
    return subprocess.run([str(EXAMPLE / "run.sh"), *command], cwd=folder, env=environment,
                          capture_output=True, text=True, timeout=120)


class Notebook(unittest.TestCase):
    def setUp(self):
        self.script = (EXAMPLE / "compress.py").read_text(encoding="utf-8")
        self.cells = json.loads((EXAMPLE / "compress.ipynb").read_text(encoding="utf-8"))["cells"]

    def test_its_cells_are_the_parts_of_the_script(self):
        cells = [(cell["cell_type"], "".join(cell["source"])) for cell in self.cells]
        self.assertEqual(cells, make_notebook.parts(self.script), "run examples/python/make_notebook.py")

    def test_its_code_is_all_code_of_the_script(self):
        kept = "\n".join("".join(c["source"]) for c in self.cells if c["cell_type"] == "code")

        def lines(text):
            return [line for line in text.splitlines() if line.strip() and not line.startswith("#")]

        self.assertEqual(lines(kept), lines(self.script))

    def test_code_in_a_part_of_text_is_refused(self):
        with self.assertRaisesRegex(ValueError, "x = 1"):
            make_notebook.parts("# %% [markdown]\n# text\nx = 1\n")


@unittest.skipUnless(HAS_PLUGIN, "EEPA_BUILD_DIR names no folder with eepaplugin.so and lmp")
class Example(unittest.TestCase):
    def test_script(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(folder)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            curve = pd.read_csv(Path(folder) / "curve.csv")
            contacts = pd.read_csv(Path(folder) / "contacts.csv")
            self.assertTrue((Path(folder) / "compress.png").is_file())
            self.check(curve, contacts)

    def check(self, curve, contacts):
        top = curve["stress"].idxmax()
        self.assertGreater(curve["stress"][top], 1.0e5)
        self.assertLess(curve["stress"].iloc[-1], 0.5 * curve["stress"][top])
        # fix vector has a row every 20 steps, through the end of a run and over two runs
        self.assertEqual(set(curve["step"].diff().dropna()), {20})
        # height follows from the platen's speed, and goes up after the turn
        self.assertTrue((curve["height"][:top].diff().dropna() < 0).all())
        self.assertTrue((curve["height"][top + 2:].diff().dropna() > 0).all())
        start = curve["height"][curve["strain"] == 0].iloc[0]
        self.assertAlmostEqual(curve["strain"][top], 1 - curve["height"][top] / start)
        for dissipated in ("hysteresis", "sliding"):
            self.assertTrue((curve[dissipated].diff().dropna() >= -1e-12).all(), dissipated)
        # rows of pair/local belong to the pairs of property/local
        self.assertFalse(contacts.duplicated(["i", "j"]).any())
        self.assertTrue((contacts["overlap"] > 0).all())
        self.assertTrue((contacts["tangential"] <= contacts["friction_bound"] * (1 + 1e-9) + 1e-15).all())
        # on the loading branch the force is f0 + k1 delta, on the unloading one f0 + k2 delta - (k2 - k1) delta_max,
        # and a dashpot, which is small here
        for branch, law in (("loading", lambda c: 5e3 * c["overlap"]),
                            ("unloading", lambda c: 1e4 * c["overlap"] - 5e3 * c["max_overlap"])):
            found = contacts[contacts["branch"] == branch]
            self.assertGreater(len(found), 50)
            apart = (found["force"] + 1e-4 - law(found)).abs()
            self.assertLess(apart.median(), 0.02 * found["force"].max(), branch)
        self.assertGreater((contacts["max_overlap"] - contacts["overlap"]).max(), 1e-6)
        sliding = contacts[contacts["sliding"] == 1]
        self.assertGreater(len(sliding), 0)
        # pair/local has the velocities at the end of the step in the dashpot, the force call those of its middle
        self.assertLess((sliding["tangential"] / sliding["friction_bound"] - 1).abs().max(), 0.1)

    def test_without_the_plugin(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(folder, "env", "-u", "LAMMPS_PLUGIN_PATH", sys.executable, str(EXAMPLE / "compress.py"))
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("LAMMPS_PLUGIN_PATH", done.stderr)
            self.assertFalse((Path(folder) / "curve.csv").exists())

    def test_a_folder_without_the_build(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(folder, EEPA_BUILD_DIR=folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn(folder, done.stderr)


if __name__ == "__main__":
    unittest.main()

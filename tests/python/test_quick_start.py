# SPDX-License-Identifier: GPL-2.0-only
"""What the quick start of the site says of examples/quick_start: with `scale` the same strain at the same stress, without
it more, and half of it kept after unloading."""
import contextlib
import importlib.util
import io
import os
import tempfile
import unittest
from pathlib import Path

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "quick_start"
LMP = os.environ.get("EEPA_LMP")


def example():
    spec = importlib.util.spec_from_file_location("quick_start", EXAMPLE / "run.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class QuickStart(unittest.TestCase):
    def test_strain_does_not_depend_on_the_diameter_where_it_is_scaled(self):
        quick = example()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(quick.main(["--lmp", LMP, "--out", folder, "--jobs", "2"]), 0)
            self.assertGreater((Path(folder) / "compress.png").stat().st_size, 10000)
            launcher = quick.running.Launcher(Path(LMP), Path(folder))
            curves = {run.name: quick.curve(launcher, run) for run in quick.cases(quick.DIAMETERS[1:])}
        strain = {name: quick.strain_at(table, 4.5e4) for name, table in curves.items()}
        # one packing each: 3.7 and 3.9% on one machine, 5.5 and 8.7% without scaling
        self.assertAlmostEqual(strain["d3mm_scaled"] / strain["d2mm_scaled"], 1.0, delta=0.2)
        self.assertGreater(strain["d3mm_unscaled"] / strain["d2mm_unscaled"], 1.3)
        self.assertGreater(strain["d2mm_unscaled"] / strain["d2mm_scaled"], 1.2)
        for name, table in curves.items():
            with self.subTest(run=name):
                self.assertAlmostEqual(table.stress.max() / 5.0e4, 1.0, delta=0.01)
                kept = quick.strain(table)[-1] / quick.strain(table).max()
                self.assertGreater(kept, 0.3)
                self.assertLess(kept, 0.7)


if __name__ == "__main__":
    unittest.main()

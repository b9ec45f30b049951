# SPDX-License-Identifier: GPL-2.0-only
"""The report of the study of strength: tables, figures, curves as CSV, and one HTML page."""
from __future__ import annotations

import csv
import math
import os
import platform
import subprocess
from pathlib import Path
from typing import Dict, List, Sequence, Tuple

import matplotlib
import numpy

from . import curves as cv
from . import strength_figures as figures
from .analysis import (FreeExponent, Group, Key, Row, flow_function, free_exponents,
                       group_results, make_rows, mean_crush, proportion_of, speed_exponent,
                       strength_points)
from .cases import folder_of
from .claims import claims
from .html import Page
from .plan import Plan
from .specimens import Confined, Unconfined
from .statistics import Value

VALUES = ("loading_deviation", "unloading_deviation", "porosity", "coordination",
          "coordination_deviation", "strain", "constrained_modulus", "bulk_modulus",
          "bulk_modulus_deviation", "lateral_ratio")


def write(plan: Plan, out: Path, lmp: Path) -> str:
    """Writes everything into `out` and returns the text for the terminal."""
    groups = group_results(plan, out)
    rows = make_rows(groups, plan)
    fits = free_exponents(groups, plan)
    write_table(rows, plan.levels, out / "strength.csv")
    write_curves(groups, out / "curves")
    written = _figures(groups, rows, fits, plan, out)
    summary = _summary(groups, rows, fits, plan)
    (out / "summary.txt").write_text(summary, encoding="utf-8")
    page = Page("Scaling of an elasto-plastic adhesive contact law: confined and unconfined "
                "compression")
    if plan.quick:
        page.paragraph("QUICK MODE: tiny specimens that try the machinery. The figures below are "
                       "measured, but mean nothing for the scaling.")
    _fill(page, plan, out, lmp, groups, rows, summary, written)
    page.write(out / "report.html")
    return (summary + f"\nReport:  {out / 'report.html'}\nFigures: {out}\nTables:  "
            f"{out / 'strength.csv'}, {out / 'curves'}")


def _figures(groups: Dict[Key, Group], rows: Sequence[Row], fits: Sequence[FreeExponent],
             plan: Plan, out: Path) -> List[Tuple[Path, str]]:
    written = []
    materials = [m for m in dict.fromkeys(g.material.label for g in groups.values())
                 if "_stiffness" not in m and "_adhesion" not in m]
    for material in materials:
        written.append((figures.confined(groups, material, out / f"confined_{material}.png"),
                        f"Confined compression, {material}: mean over seeds with its standard "
                        "error; strain counts from 5 kPa"))
        if any(g.unconfined for g in groups.values() if g.material.label == material):
            written.append((figures.unconfined(groups, material,
                                               out / f"unconfined_{material}.png"),
                            f"Unconfined compression and flow function, {material}"))
    written += [
        (figures.deviations(rows, out / "deviations.png"),
         "Deviation from the finest particles with its standard error"),
        (figures.exponents(fits, plan, out / "exponents.png"),
         "Stiffness and adhesion that fit the finest particles best, each left free alone"),
        (figures.micromechanics(strength_points(groups), out / "micromechanics.png"),
         "Strength over the mean pull-off force of the contacts against coordination number and "
         "solid fraction (Thakur et al., Granular Matter 16 (2014) 383)"),
        (figures.speed(rows, out / "speed.png"),
         "Speed-up of the confined test, without and with the making of the specimen")]
    return written


def with_error(value: Value, digits: int, factor: float = 1.0) -> str:
    """Without the error where a single seed gives none; empty where there is no value."""
    if not math.isfinite(value.value):
        return ""
    text = f"{factor * value.value:.{digits}f}"
    return (f"{text} ± {factor * value.error:.{digits}f}" if math.isfinite(value.error) else text)


HEADER = ["material", "mode", "strain rate (1/s)", "d (mm)", "particles", "seeds",
          "inertial number", "loading (% of peak)", "scatter of seeds (%)", "unloading (%)",
          "strain (%)", "porosity", "Z", "Z off (%)", "modulus (MPa)", "bulk modulus (MPa)",
          "K off (%)", "lateral ratio", "strength (kPa)", "strength off (%)", "steps", "s",
          "speed-up", "whole run, s", "speed-up", "(d/d0)^4"]


def cells(row: Row) -> List[str]:
    last = max(row.strength, default=None)
    strength = row.strength.get(last) if last else None
    off = row.strength_deviation.get(last) if last else None
    return [row.material, row.mode, f"{row.strain_rate:g}", f"{row.diameter_mm:g}",
            str(row.particles), str(row.seeds), f"{row.inertial_number:.1e}",
            with_error(row.loading_deviation, 2),
            f"{row.loading_scatter:.2f}" if math.isfinite(row.loading_scatter) else "",
            with_error(row.unloading_deviation, 2), with_error(row.strain, 3, 100.0),
            with_error(row.porosity, 4), with_error(row.coordination, 3),
            with_error(row.coordination_deviation, 2),
            with_error(row.constrained_modulus, 2, 1e-6), with_error(row.bulk_modulus, 2, 1e-6),
            with_error(row.bulk_modulus_deviation, 1), with_error(row.lateral_ratio, 3),
            with_error(strength, 2, 1e-3) if strength else "",
            with_error(off, 1) if off else "", f"{row.steps:.0f}", f"{row.seconds:.2f}",
            f"{row.speed_up:.1f}", f"{row.whole_seconds:.2f}", f"{row.whole_speed_up:.1f}",
            f"{row.expected_speed_up:.1f}"]


def write_table(rows: Sequence[Row], levels: Sequence[float], path: Path) -> None:
    """Every row and value; SI units, deviations in %."""
    plain = ["material", "mode", "strain_rate", "diameter_mm", "particles", "seeds",
             "inertial_number", "loading_scatter", "steps", "seconds", "speed_up",
             "whole_steps", "whole_seconds", "whole_speed_up", "expected_speed_up"]
    names = plain + [f"{name}{end}" for name in VALUES for end in ("", "_error")]
    for level in levels:
        names += [f"{name}_{level / 1e3:g}kPa{end}" for name in ("strength", "strength_deviation")
                  for end in ("", "_error")]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for row in rows:
            line = [_plain(getattr(row, name)) for name in plain]
            for name in VALUES:
                line += _both(getattr(row, name))
            nothing = Value(math.nan, math.nan)
            for level in levels:
                line += _both(row.strength.get(level, nothing))
                line += _both(row.strength_deviation.get(level, nothing))
            writer.writerow(line)


def _both(value: Value) -> List[object]:
    return [_plain(value.value), _plain(value.error)]


def _plain(value: object) -> object:
    if not isinstance(value, float):
        return value
    return f"{value:.6g}" if math.isfinite(value) else ""


def write_curves(groups: Dict[Key, Group], folder: Path) -> None:
    """Mean and standard error over seeds of every curve, a file for each group and test."""
    folder.mkdir(parents=True, exist_ok=True)
    for (material, mode, diameter, rate), group in groups.items():
        name = f"{material}_{mode}_d{1e3 * diameter:g}mm_rate{rate:g}"
        for branch in ("loading", "unloading"):
            means = {quantity: cv.mean_at_stress(group.curves, branch, quantity)
                     for quantity in ("bulk", "bulk_porosity", "coordination")}
            _write_means(folder / f"{name}_{branch}.csv", "stress", means,
                         {"bulk": "strain", "bulk_porosity": "porosity"})
        for level, results in group.unconfined.items():
            _write_means(folder / f"{name}_crush_{level / 1e3:g}kPa.csv", "strain",
                         {"stress": mean_crush(results)}, {})


def _write_means(path: Path, grid: str, means: Dict[str, cv.Mean], rename: Dict[str, str]) -> None:
    names, columns = [grid], [next(iter(means.values())).grid]
    for quantity, mean in means.items():
        name = rename.get(quantity, quantity)
        names += [name, f"{name}_error"]
        columns += [mean.value, mean.error]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for line in zip(*columns):
            writer.writerow([_plain(float(value)) for value in line])


def _summary(groups: Dict[Key, Group], rows: Sequence[Row], fits: Sequence[FreeExponent],
             plan: Plan) -> str:
    lines = []
    found = claims(rows)
    width = max(len(c.what) for c in found)
    for claim in found:
        lines.append(f"{claim.what:<{width}}  {claim.limit:>9}  {claim.measured:>18}  "
                     f"{claim.verdict}")
    lines.append("")
    for fit in fits:
        lines.append(f"exponent of {fit.what} against d, left free to match {fit.response}: "
                     f"{with_error(fit.exponent, 3)} (scaling law: {fit.expected:g})")
    for row in rows:
        if row.strain_rate != Confined.strain_rate:
            lines.append(f"strain rate {row.strain_rate:g}/s, not {Confined.strain_rate:g}/s, "
                         f"same packings of {row.diameter_mm:g} mm: curve "
                         f"{with_error(row.loading_deviation, 2)}% of peak, strength "
                         + ", ".join(f"{with_error(value, 1)}% after {level / 1e3:g} kPa"
                                     for level, value in row.strength_deviation.items()))
    for group in groups.values():
        flow = flow_function(group)
        if flow.slope is not None and group.diameter in (plan.diameters[0], plan.diameters[-1]):
            lines.append(f"flow function, {group.material.label} {group.mode} "
                         f"{1e3 * group.diameter:g} mm: strength rises by {flow.slope:.3f} of the "
                         "consolidation stress")
    points = strength_points(groups)
    line = proportion_of(points)
    free = f", exponent {with_error(line.exponent, 2)} when free" if line.exponent else ""
    lines.append(f"sigma_u d^2/f_at = {line.constant:.4f} Z (1 - n), {line.scatter_percent:.1f}% "
                 f"scatter over {len(points)} points{free}")
    for mode in ("scaled", "unscaled"):
        speed = speed_exponent(rows, mode)
        if speed:
            lines.append(f"wall time of the confined test, {mode}: d^-{with_error(speed, 2)}")
    return "\n".join(lines) + "\n"


def _fill(page: Page, plan: Plan, out: Path, lmp: Path, groups: Dict[Key, Group],
          rows: Sequence[Row], summary: str, written: Sequence[Tuple[Path, str]]) -> None:
    page.heading("What was to be shown")
    page.table(["", "limit", "measured", "met"],
               [[c.what, c.limit, c.measured, c.verdict] for c in claims(rows)])
    page.preformatted(summary)
    page.heading("Every group of runs")
    page.paragraph("Deviations are from the finest scaled particles of the same material (at "
                   "another strain rate: from the same packings at the usual one); ± is "
                   "the standard error over seeds. Strain, porosity, Z are those at 90% of "
                   "the last level; moduli, lateral ratio are those of unloading from it; "
                   "strength is that after it. Steps, seconds and speed-up are of the confined "
                   "test, and of the whole run with the making of the specimen.")
    page.table(HEADER, [cells(row) for row in rows])
    page.heading("Figures")
    for path, caption in written:
        page.picture(path, caption)
    page.heading("Packings before and after failure")
    page.paragraph("The rear half of the specimen, each particle in the colour of its contact "
                   "stress: blue in tension, red in compression, 50 kPa at full colour.")
    for run in plan.runs:
        if isinstance(run, Unconfined) and run.images:
            pair = [next(iter(sorted(folder_of(out, run).glob(f"{stage}.*.png"))))
                    for stage in ("free", "crush")]
            what = (f"{run.specimen.material.label}, {1e3 * run.diameter:g} mm, after "
                    f"{run.level / 1e3:g} kPa")
            page.pair(pair, [f"{what}: before", f"{what}: after failure"])
    page.heading("Parameters")
    materials = {g.material.label: g.material for g in groups.values()}
    page.table(["material", "law", "k1 (N/m)", "k2 (N/m)", "k_adh (N/m)", "f0 (N)", "mu"],
               [[m.label, m.law, f"{m.k1:g}", f"{m.k2:g}", f"{m.kadh:g}", f"{m.f0:.6g}",
                 f"{m.mu:g}"] for m in materials.values()])
    one = plan.runs[0] if not isinstance(plan.runs[0], Unconfined) else plan.runs[0].specimen
    page.paragraph(f"At the reference diameter of {1e3 * one.reference_diameter:g} mm. Specimen "
                   f"{1e3 * one.side:g} mm wide with {one.reference_particles} particles of that "
                   f"diameter; levels {', '.join(f'{level / 1e3:g}' for level in plan.levels)} "
                   "kPa. Rolling friction, restitution, density: see in.confined.")
    page.heading("Versions and machine")
    page.preformatted(versions(lmp))


def versions(lmp: Path) -> str:
    """Of what made the report."""
    root = Path(__file__).resolve().parents[3]

    def said(*words: str) -> str:
        try:
            return subprocess.run(words, text=True, capture_output=True, timeout=60, check=True,
                                  cwd=root).stdout
        except (OSError, subprocess.SubprocessError):
            return ""

    lammps = next((line.strip() for line in said(str(lmp), "-h").splitlines()
                   if "Discrete Particle" not in line and "LAMMPS" in line or
                   line.startswith("Large-scale")), "unknown")
    return "\n".join([
        f"commit      {said('git', 'rev-parse', 'HEAD').strip() or 'unknown'}"
        f"{' with changes' if said('git', 'status', '--porcelain').strip() else ''}",
        f"LAMMPS      {lammps}",
        f"Python      {platform.python_version()}, NumPy {numpy.__version__}, Matplotlib "
        f"{matplotlib.__version__}",
        f"machine     {platform.machine()}, {_processor()}, {os.cpu_count()} cores, "
        f"{platform.system()} {platform.release()}",
        f"Open MPI    {next(iter(said('mpirun', '--version').splitlines()), 'unknown')}"])


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or "unknown processor"

# SPDX-License-Identifier: GPL-2.0-only
"""The report of the study of strength: tables, figures, curves as CSV, and one HTML page."""
from __future__ import annotations

import platform
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, List, Sequence, Tuple

import matplotlib
import numpy

from . import strength_figures as figures
from . import versions
from .analysis import Row, Similar, make_rows, similar_specimens
from .cases import folder_of
from .claims import claims
from .fits import (FreeExponent, flow_function, free_exponents, proportion_of, speed_exponent,
                   strength_points)
from .groups import Group, Key, group_results
from .html import Page
from .plan import BASE, FACTORS, VARIED, Plan, Run
from .runs import read_marker
from .specimens import TRANSITS, Confined, Unconfined
from .strength_tables import HEADER, cells, with_error, write_curves, write_table

@dataclass(frozen=True)
class Study:
    """What the report is on."""

    plan: Plan
    out: Path
    groups: Dict[Key, Group]
    rows: List[Row]
    fits: List[FreeExponent]
    similar: List[Similar]
    #: runs of the plan that are finished, by just these in-files and this LAMMPS; and how many not
    runs: List[Run]
    missing: int

    @property
    def finest_mm(self) -> float:
        return 1e3 * self.plan.diameters[0]


def write(plan: Plan, out: Path, lmp: Path, finished: Callable[[Run], bool]) -> str:
    """Writes everything into `out` and returns the text for the terminal.

    :param finished: whether a run is there, of just these in-files and this LAMMPS
    :raise ValueError: when there is nothing to report on
    """
    done = {run: finished(run) for run in plan.runs}
    groups = group_results(plan, out, done.__getitem__)
    if not any(g.material == BASE and g.mode == "scaled" and not g.special
               for g in groups.values()):
        raise ValueError(f"{out}: no finished run of the base material by these in-files and this "
                         "LAMMPS, so there is nothing to report on")
    study = Study(plan, out, groups, make_rows(groups, plan), free_exponents(groups, plan),
                  similar_specimens(groups, plan), [run for run in plan.runs if done[run]],
                  sum(not there for there in done.values()))
    write_table(study.rows, plan.levels, out / "strength.csv")
    write_curves(groups, out / "curves")
    written = _figures(study)
    summary = _summary(study)
    (out / "summary.txt").write_text(summary, encoding="utf-8")
    page = Page("Scaling of an elasto-plastic adhesive contact law: confined and unconfined "
                "compression")
    if plan.quick:
        page.paragraph("QUICK MODE: tiny specimens that try the machinery. The figures below are "
                       "measured, but mean nothing for the scaling.")
    _fill(page, study, lmp, written)
    page.write(out / "report.html")
    return (summary + f"\nReport:  {out / 'report.html'}\nFigures: {out}\nTables:  "
            f"{out / 'strength.csv'}, {out / 'curves'}")


def _figures(study: Study) -> List[Tuple[Path, str]]:
    groups, out, written = study.groups, study.out, []
    # those of the fits differ from another one in a factor only
    materials = dict.fromkeys(g.material.label for g in groups.values() if not g.special
                              and g.material not in VARIED)
    for material in materials:
        written.append((figures.confined(groups, material, out / f"confined_{material}.png"),
                        f"Confined compression, {material}: mean over seeds with its standard "
                        "error; strain counts from 5 kPa"))
        if any(g.unconfined for g in groups.values() if g.material.label == material):
            written.append((figures.unconfined(groups, material, study.plan.levels[-1],
                                               out / f"unconfined_{material}.png"),
                            f"Unconfined compression and flow function, {material}"))
    written.append((figures.deviations(study.rows, out / "deviations.png"),
                    "Deviation from the finest particles with its standard error"))
    sizes = [r for r in study.rows if r.material == BASE.label and r.mode == "scaled"
             and r.strain_rate == Confined.strain_rate and r.strength]
    if any(not r.usual for r in sizes):
        written.append((figures.sizes(sizes, out / "sizes.png"),
                        "Strength and coordination number over the width of the specimen in "
                        "diameters"))
    if study.fits:
        written.append((figures.exponents(study.fits, out / "exponents.png"),
                        "Coefficients that fit the finest particles best, each left free alone"))
    points = strength_points(groups)
    if points:
        written.append((figures.micromechanics(points, out / "micromechanics.png"),
                        "Strength over the mean pull-off force of the contacts against "
                        "coordination number and solid fraction (Thakur et al., Granular Matter "
                        "16 (2014) 383)"))
    written.append((figures.speed(study.rows, out / "speed.png"),
                    "Speed-up of the confined test, without and with the making of the specimen"))
    return written


def _summary(study: Study) -> str:
    lines = []
    if study.missing:
        lines += [f"{study.missing} of {len(study.plan.runs)} runs are not there, or are of other "
                  "in-files or another LAMMPS: the figures are without them", ""]
    lines += _in_columns([[c.what, c.limit, c.measured, c.verdict]
                          for c in claims(study.rows, study.finest_mm)])
    if study.similar:
        lines += ["", "As many particles in specimens as many diameters wide and high, coarse "
                      "beside fine, whose packings are the same but for their size, seed by seed:"]
    for one in study.similar:
        strengths = ", ".join(f"{with_error(value, 2)}% after {level / 1e3:g} kPa"
                              for level, value in one.strength_deviation.items())
        lines.append(f"{one.diameter_mm:g} mm in {one.width_mm:g} mm, {one.fine_mm:g} mm in "
                     f"{one.fine_width_mm:g} mm, {one.seeds} packings: curve "
                     f"{with_error(one.loading_deviation, 2)}% of peak, Z "
                     f"{with_error(one.coordination_deviation, 2)}%, strength {strengths}")
    lines.append("")
    for fit in study.fits:
        lines.append(f"exponent of {fit.what} against d, left free to match {fit.response} of "
                     f"{1e3 * fit.reference_diameter:g} mm"
                     + (" in specimens as many diameters wide" if fit.equal_width else "")
                     + " by " + ", ".join(f"{1e3 * d:g}" for d in fit.diameters) + " mm"
                     + f": {with_error(fit.exponent, 3)} "
                     f"(scaling law: {fit.expected:g})"
                     + (", beyond the factors that were run" if fit.extrapolated else ""))
    ends = (study.plan.diameters[0], study.plan.diameters[-1])
    for group in study.groups.values():
        flow = flow_function(group)
        if flow.slope is not None and not group.special and group.diameter in ends:
            lines.append(f"flow function, {group.material.label} {group.mode} "
                         f"{1e3 * group.diameter:g} mm: strength rises by "
                         f"{with_error(flow.slope, 4)} of the consolidation stress")
    every_point = strength_points(study.groups)
    for plastic, name in ((True, "with k_adh"), (False, "f0 alone")):
        points = [p for p in every_point if p.plastic == plastic]
        if points:
            line = proportion_of(points)
            free = f", exponent {with_error(line.exponent, 2)} when free" if line.exponent else ""
            span = [p.packing.value for p in points]
            lines.append(f"sigma_u d^2/f_at, {name} = {line.constant:.4f} Z (1 - n), "
                         f"{line.scatter_percent:.1f}% scatter over {len(points)} points{free}; Z "
                         f"(1 - n) goes from {min(span):.2f} to {max(span):.2f} only")
    for mode in ("scaled", "unscaled"):
        speed = speed_exponent(study.groups, mode)
        if speed:
            lines.append(f"processor time of the confined test, {mode}: d^-{with_error(speed, 2)}")
    return "\n".join(lines) + "\n"


def _in_columns(table: Sequence[Sequence[str]]) -> List[str]:
    widths = [max(len(line[k]) for line in table) for k in range(len(table[0]))] if table else []
    return ["  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip()
            for line in table]


def _fill(page: Page, study: Study, lmp: Path, written: Sequence[Tuple[Path, str]]) -> None:
    plan, out = study.plan, study.out
    page.heading("What was to be shown")
    page.table(["", "limit", "measured", "met"],
               [[c.what, c.limit, c.measured, c.verdict]
                for c in claims(study.rows, study.finest_mm)])
    page.preformatted(_summary(study))
    page.heading("How it was measured")
    for text in METHOD:
        page.paragraph(text)
    page.heading("Every group of runs")
    page.paragraph("Deviations are from the finest scaled particles of the same material, named in "
                   "the column `reference` (at another strain rate: from the same packings at the "
                   "usual one, curve and strength seed by seed); ± is the standard error over "
                   "seeds. A root mean square distance is above zero by about its standard error "
                   "where nothing is apart. `crushed` are seeds with the strength shown. Strain, "
                   "porosity, Z are those at 90% of the last level; moduli, lateral ratio are "
                   "those of unloading from it; strength and crushing are those after it. Steps, "
                   "seconds (of processor time) and speed-up are of the confined test, and of the "
                   "whole run with the making of the specimen.")
    page.table(HEADER, [cells(row, plan.levels[-1]) for row in study.rows])
    page.heading("Figures")
    for path, caption in written:
        page.picture(path, caption)
    page.heading("Packings before and after failure")
    page.paragraph("The rear half of the specimen, each particle in the colour of its contact "
                   "stress: blue in tension, red in compression, 50 kPa at full colour.")
    for run in study.runs:
        if isinstance(run, Unconfined) and run.images:
            pair = [next(iter(sorted(folder_of(out, run).glob(f"{stage}.*.png"))), None)
                    for stage in ("free", "crush")]
            what = (f"{run.specimen.material.label}, {1e3 * run.diameter:g} mm, after "
                    f"{run.level / 1e3:g} kPa")
            if all(pair):
                page.pair(pair, [f"{what}: before", f"{what}: after failure"])
    page.heading("Parameters")
    materials = {g.material.label: g.material for g in study.groups.values()}
    page.table(["material", "law", "k1 (N/m)", "k2 (N/m)", "k_adh (N/m)", "f0 (N)", "mu"],
               [[m.label, m.law, f"{m.k1:g}", f"{m.k2:g}", f"{m.kadh:g}", f"{m.f0:.6g}",
                 f"{m.mu:g}"] for m in materials.values()])
    one = plan.runs[0] if not isinstance(plan.runs[0], Unconfined) else plan.runs[0].specimen
    page.paragraph(f"At the reference diameter of {1e3 * one.reference_diameter:g} mm. Specimen "
                   f"{1e3 * one.side:g} mm wide with {one.reference_particles} particles of that "
                   f"diameter; levels {', '.join(f'{level / 1e3:g}' for level in plan.levels)} "
                   "kPa. Density 2000 kg/m3, restitution 0.3, rolling friction 0.001 (constant).")
    page.heading("Versions and machine")
    page.preformatted(_versions(study, lmp))


METHOD = (
    "Specimen: random points pushed apart, packed between rough platens at 4 kPa without friction "
    "and adhesion; periodic sides. Confined compression by a platen as heavy as the packing that a "
    "pressure drives, at a strain rate of about 0.5/s (0.4 of that up to the first level); every "
    "level is held for 10 ms. Strain is that of the grains two diameters and more away from the "
    "platens and counts from 5 kPa. The specimen is unloaded from the last level.",
    f"Unconfined: each level is unloaded in the time of {TRANSITS:g} passages of a stress wave or "
    "more, left for 10 ms, its periodic sides are opened (contacts across them are gone), left for "
    "10 ms and crushed at 0.3/s to 75% of the peak stress or beyond. The upper platen is held where it came to rest, so that crushing starts within 1 to "
    "2 kPa of zero. Stress is force over the cross-section before crushing, and so is the porosity "
    "in the files of crushing. Strength is the top of the cubic through the samples around the "
    "peak, above 80% of it.",
    "Moduli: rise of axial and of mean stress over strain between 95% and 50% of the stress that "
    "unloading began at. Inertial number: strain rate times d times sqrt(density/stress), the "
    "largest on loading. Deviation of a curve: root mean square distance from the reference's mean "
    "over the strain that both have, in % of its peak stress.",
    "Z counts contacts between particles for both and contacts with a platen for one, of all "
    "particles; Z of the bulk is of the grains two diameters and more away from the platens.",
    f"Exponents: at each coarse diameter a coefficient is multiplied by {FACTORS[0]:g} and "
    f"{FACTORS[1]:g} on top of the "
    "scaling law; seed by seed, the factor that gives the finest particles' mean response is read "
    "off a line through the logarithms, and over diameters makes an exponent: once in specimens all "
    "as wide, once beside finest particles in specimens as many diameters wide and high. k_adh is "
    "varied in the base material, f0 in one without k_adh.")


def _versions(study: Study, lmp: Path) -> str:
    """Of the runs, and of what made the report."""
    markers = [read_marker(folder_of(study.out, run)) for run in study.runs]

    def noted(name: str) -> str:
        return ", ".join(sorted({str(marker.get(name, "unknown")) for marker in markers}))

    return "\n".join([
        f"runs        commit {noted('commit')}; {noted('lammps')}; {noted('ranks')} rank each, "
        f"{noted('jobs')} at once",
        f"report      commit {versions.commit()}; {versions.lammps(lmp)}",
        f"Python      {platform.python_version()}, NumPy {numpy.__version__}, Matplotlib "
        f"{matplotlib.__version__}",
        f"machine     {versions.machine()}",
        f"Open MPI    {versions.mpi()}"])

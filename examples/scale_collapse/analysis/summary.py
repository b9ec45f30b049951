# SPDX-License-Identifier: GPL-2.0-only
"""What a study says, in words and columns."""
from __future__ import annotations

from pathlib import Path
from typing import List

import numpy as np
import pandas as pd

from . import claims, figures, fits, tables

FREE = (fits.Free("stiffness", "base", "stiffness", 1.0, "strain"),
        fits.Free("k_adh", "base", "kadh", 1.0, "strength_{last}"),
        fits.Free("f0", "pull_off", "f0", 2.0, "strength_{last}"))


def write(runs: pd.DataFrame, curves: pd.DataFrame, out: Path) -> str:
    """Writes means.csv, summary.txt and every figure that there are runs for, and returns the summary.

    :param runs: a row a specimen, and their curves, as coarsen makes them
    """
    runs = tables.with_kinds(runs)
    table = tables.with_curve_deviations(tables.means(runs), runs, curves)
    levels = [c[len("strength_"):] for c in runs if c.startswith("strength_")]
    levels.sort(key=float)
    table.to_csv(out / "means.csv", index=False, float_format="%.6g")
    lines = [_overview(table)]
    varied = tables.is_varied(runs)
    for material in dict.fromkeys(runs.loc[~varied, "material"]):
        own = runs[~varied & (runs["material"] == material)]
        figures.confined(own, curves, material, out / f"confined_{material}.png", table)
        if any(own[f"strength_{level}"].notna().any() for level in levels):
            figures.unconfined(own, curves, material, levels, out / f"unconfined_{material}.png")
    if levels and (runs["material"] == "base").any():
        lines += _strength(runs[~varied], runs, curves, table, levels, out)
    text = "\n".join(lines) + "\n"
    (out / "summary.txt").write_text(text, encoding="utf-8")
    return text


def _strength(plain: pd.DataFrame, runs: pd.DataFrame, curves: pd.DataFrame, table: pd.DataFrame,
              levels: List[str], out: Path) -> List[str]:
    last = levels[-1]
    usual = table[table["material"].isin(plain["material"])]
    figures.deviations(usual, last, out / "deviations.png")
    figures.sizes(usual, last, out / "sizes.png")
    figures.speed(usual, out / "speed.png")
    points = fits.strength_points(plain, levels)
    figures.micromechanics(points, out / "micromechanics.png")
    lines = ["", claims.claims(usual, levels).to_string(index=False, justify="left")]
    similar = tables.twins(plain, curves, ["coordination", *(f"strength_{level}" for level in levels)])
    if len(similar):
        similar = similar.assign(coarse=1e3 * similar["coarse"], fine=1e3 * similar["fine"])
        lines += ["", "As many particles in specimens as many diameters wide and high, coarse beside fine, seed by "
                      "seed; diameters in mm, differences in %:", similar.round(2).to_string(index=False)]
    found = [one for free in FREE for equal_width in (False, True)
             if (one := fits.exponent(runs, fits.Free(**{**vars(free), "quantity": free.quantity.format(last=last)}),
                                      equal_width))]
    if found:
        figures.exponents(found, out / "exponents.png")
    lines.append("")
    lines += [f"exponent of {one.free.what} against d, left free to match {one.free.quantity} of {1e3 * one.finest:g} mm"
              + (" in specimens as many diameters wide" if one.equal_width else "")
              + f": {one.value:.3f}" + ("" if np.isnan(one.error) else f" ± {one.error:.3f}") + f" (scaling law: {one.free.expected:g})"
              + (", beyond the factors that were run" if one.extrapolated else "") for one in found]
    flows = fits.flow_slopes(plain, levels)
    lines += [f"flow function, {row.material} {row.mode} {1e3 * row.d:g} mm: strength rises by {row.slope:.4f}"
              + ("" if np.isnan(row.error) else f" ± {row.error:.4f}") + " of the consolidation stress" for row in flows.itertuples()]
    for plastic, name in ((True, "with k_adh"), (False, "f0 alone")):
        some = points[points["plastic"] == plastic]
        if len(some) > 1:
            constant, scatter = fits.proportion(some)
            lines.append(f"sigma_u d^2/f_at, {name} = {constant:.4f} Z (1 - n), {scatter:.1f}% scatter over "
                         f"{len(some)} points; Z (1 - n) goes from {some['packing'].min():.2f} to "
                         f"{some['packing'].max():.2f} only")
    for mode in figures.MODES:
        speed = fits.speed_exponent(usual, mode)
        if speed:
            lines.append(f"processor time of the confined test, {mode}: d^-{speed[0]:.2f} ± {speed[1]:.2f}")
    return lines


def _overview(table: pd.DataFrame) -> str:
    """A line a kind; speed-ups are over the finest, scaled specimens of the material."""
    finest = table[(table["mode"] == "scaled") & (table["special"] == "")
                   & np.isclose(table["d"], table["reference"])].set_index("material")
    gain = {name: table["material"].map(finest[name]) / table[name] for name in ("test_seconds", "seconds")}
    shown = pd.DataFrame({
        "material": table["material"], "mode": table["mode"], "": table["special"], "d (mm)": 1e3 * table["d"],
        "particles": table["particles"].astype(int), "seeds": table["seeds"],
        "curve (% of peak)": _with_error(table, "curve", 2),
        "unloading": ["" if np.isnan(x) else f"{x:.1f}" for x in table["unloading"]], "porosity before": _with_error(table, "porosity_before", 4),
        "Z": _with_error(table, "coordination", 2), "strain at 90% (%)": _with_error(table, "strain", 3, 100.0),
        "test (s)": table["test_seconds"].round(2), "speed-up": gain["test_seconds"].round(1),
        "of whole runs": gain["seconds"].round(1)})
    return shown.to_string(index=False)


def _with_error(table: pd.DataFrame, name: str, digits: int, factor: float = 1.0) -> List[str]:
    return ["" if not np.isfinite(value) else f"{factor * value:.{digits}f}"
            + (f" ± {factor * error:.{digits}f}" if np.isfinite(error) else "")
            for value, error in zip(table[name], table[f"{name}_error"])]

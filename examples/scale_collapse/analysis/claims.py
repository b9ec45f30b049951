# SPDX-License-Identifier: GPL-2.0-only
"""Claims of the study of strength, each with the figure that was measured. The limits were set before the study
was run; a figure beyond its limit is reported as such."""
from __future__ import annotations

from typing import Dict, List, Optional, Tuple

import numpy as np
import pandas as pd

from .tables import deviation_percent

#: Of the scaled particles at 2 and 3 times the finest diameter: curve and strength in %, speed-up.
LIMITS: Dict[float, Tuple[float, float, float]] = {2.0: (2.0, 5.0, 10.0), 3.0: (3.0, 8.0, 40.0)}
COORDINATION, UNSCALED, INERTIAL_NUMBER = 2.0, 15.0, 1.0e-3


def claims(table: pd.DataFrame, levels: List[str]) -> pd.DataFrame:
    """Columns claim, limit, measured, met; the last two are empty where no limit was set."""
    rows: List[Tuple[str, str, str, str]] = []
    base = table[table["material"] == "base"]
    usual = base[base["special"] == ""]
    for size, (curve, strength, speed_up) in LIMITS.items():
        row = _row(usual, "scaled", size)
        if row is None:
            continue
        name = f"scaled, {size:g}x"
        rows += [_near(f"{name}: stress-strain curve, RMS", row["curve"], row["curve_error"], curve),
                 ("%s: stress-strain curve, mean" % name, "", f"{row['curve_mean']:+.2f}%", "")]
        rows += [_near(f"{name}: coordination number", *_off(table, row, "coordination"), COORDINATION)]
        rows += [(f"{name}: {text}", "", _percent(*_off(table, row, quantity)), "") for text, quantity in (
            ("coordination number of the bulk", "bulk_coordination"), ("porosity of the bulk", "porosity"))]
        rows += _strengths(table, row, name, levels, strength)
        for what, quantity, limit in (("of the confined test", "test_seconds", speed_up),
                                      ("with the making of the specimen", "seconds", None)):
            gain = _row(usual, "scaled", 1.0)[quantity] / row[quantity]
            rows.append((f"{name}: speed-up {what}", f">= {limit:g}" if limit else "", f"{gain:.1f}",
                         "" if limit is None else "yes" if gain >= limit else "NO"))
        for _, wide in base[(base["mode"] == "scaled") & np.isclose(base["d"], size * base["reference"])
                            & (base["side"] > 1.001 * row["side"])].iterrows():
            rows += _strengths(table, wide, f"{name}, {wide['special']}", levels, strength)
    row = _row(usual, "unscaled", 2.0)
    if row is not None:
        rows.append(("unscaled, 2x: stress-strain curve, RMS", f"> {UNSCALED:g}%",
                     _percent(row["curve"], row["curve_error"]), "yes" if row["curve"] > UNSCALED else "NO"))
        rows += _strengths(table, row, "unscaled, 2x", levels, None)
    for what, some in (("base material, scaled", base[base["mode"] == "scaled"]), ("all", table)):
        worst = some.loc[some["inertial_number"].idxmax()]
        rows.append((f"largest mean inertial number on loading, {what} ({worst['material']} {worst['mode']}, "
                     f"{1e3 * worst['d']:g} mm{', ' if worst['special'] else ''}{worst['special']})",
                     f"<= {INERTIAL_NUMBER:g}", f"{worst['inertial_number']:.2e}",
                     "yes" if worst["inertial_number"] <= INERTIAL_NUMBER else "NO"))
    return pd.DataFrame(rows, columns=["claim", "limit", "measured", "met"])


def _row(usual: pd.DataFrame, mode: str, size: float) -> Optional[pd.Series]:
    found = usual[(usual["mode"] == mode) & np.isclose(usual["d"], size * usual["reference"])]
    return found.iloc[0] if len(found) else None


def _off(table: pd.DataFrame, row: pd.Series, quantity: str) -> Tuple[float, float]:
    return tuple(deviation_percent(table, quantity).loc[row.name])


def _strengths(table: pd.DataFrame, row: pd.Series, name: str, levels: List[str],
               limit: Optional[float]) -> List[Tuple[str, str, str, str]]:
    made = []
    for level in levels:
        if pd.isna(row.get(f"strength_{level}")):
            continue
        what, off = f"{name}: strength after {1e-3 * float(level):g} kPa", _off(table, row, f"strength_{level}")
        made.append(_near(what, *off, limit) if limit else (what, "", _percent(*off), ""))
    return made


def _near(what: str, value: float, error: float, limit: float) -> Tuple[str, str, str, str]:
    """Within the limit, or within the standard error if that is larger, which it says."""
    apart = abs(value)
    met = ("yes" if apart <= limit else
           "within its standard error only" if np.isfinite(error) and apart <= error else "NO")
    return what, f"<= {limit:g}%", _percent(value, error), met


def _percent(value: float, error: float) -> str:
    return f"{value:.2f}" + (f" ± {error:.2f}" if np.isfinite(error) else "") + "%"

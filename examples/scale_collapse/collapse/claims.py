# SPDX-License-Identifier: GPL-2.0-only
"""What the study set out to show, each with the figure that was measured. The limits are those
that were set before it was run; a figure beyond one is reported as such."""
from __future__ import annotations

from dataclasses import dataclass
from typing import List, Optional, Sequence

import numpy as np

from .analysis import Row
from .plan import BASE
from .specimens import Confined
from .statistics import Value

#: Of the scaled particles at 2 and 3 times the finest diameter: curve and strength in %, speed-up.
LIMITS = {2.0: (2.0, 5.0, 10.0), 3.0: (3.0, 8.0, 40.0)}
COORDINATION, UNSCALED, INERTIAL_NUMBER = 2.0, 15.0, 1.0e-3


@dataclass(frozen=True)
class Claim:
    what: str
    limit: str
    measured: str
    verdict: str


def claims(rows: Sequence[Row]) -> List[Claim]:
    """Of the base material; a size that was not run makes no claim."""
    base = [r for r in rows if r.material == BASE.label and r.strain_rate == Confined.strain_rate]
    finest = min(r.diameter_mm for r in base if r.mode == "scaled")
    found: List[Claim] = []
    for size, (curve, strength, speed_up) in LIMITS.items():
        row = _find(base, "scaled", size * finest)
        if row is None:
            continue
        found += [_near(f"scaled, {size:g}x: stress-strain curve", row.loading_deviation, curve),
                  _near(f"scaled, {size:g}x: coordination number", row.coordination_deviation,
                        COORDINATION)]
        found += [_near(f"scaled, {size:g}x: strength after {level / 1e3:g} kPa", value, strength)
                  for level, value in sorted(row.strength_deviation.items())]
        found.append(Claim(f"scaled, {size:g}x: speed-up", f">= {speed_up:g}",
                           f"{row.speed_up:.1f}", "yes" if row.speed_up >= speed_up else "NO"))
    row = _find(base, "unscaled", 2.0 * finest)
    if row is not None:
        found.append(Claim("unscaled, 2x: stress-strain curve", f"> {UNSCALED:g}%",
                           f"{row.loading_deviation.value:.1f}%",
                           "yes" if row.loading_deviation.value > UNSCALED else "NO"))
    largest = max(r.inertial_number for r in rows)
    found.append(Claim("largest inertial number on loading", f"<= {INERTIAL_NUMBER:g}",
                       f"{largest:.1e}", "yes" if largest <= INERTIAL_NUMBER else "NO"))
    return found


def _find(rows: Sequence[Row], mode: str, diameter_mm: float) -> Optional[Row]:
    return next((r for r in rows if r.mode == mode
                 and np.isclose(r.diameter_mm, diameter_mm)), None)


def _near(what: str, value: Value, limit: float) -> Claim:
    """Within the limit, or within the standard error if that is larger, which it says."""
    apart = abs(value.value)
    if apart <= limit:
        verdict = "yes"
    elif np.isfinite(value.error) and apart <= value.error:
        verdict = "within its standard error only"
    else:
        verdict = "NO"
    error = f" ± {value.error:.2f}" if np.isfinite(value.error) else ""
    return Claim(what, f"<= {limit:g}%", f"{value.value:.2f}{error}%", verdict)

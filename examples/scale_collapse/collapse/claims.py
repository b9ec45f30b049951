# SPDX-License-Identifier: GPL-2.0-only
"""Claims of the study, each with the figure that was measured. The limits were set before the
study was run; a figure beyond its limit is reported as such."""
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
#: Scatter of repeated tests that the reference article reports, in %.
PUBLISHED_SCATTER = 3.4


@dataclass(frozen=True)
class Claim:
    """Limit and verdict are empty where no limit was set."""

    what: str
    limit: str
    measured: str
    verdict: str


def claims(rows: Sequence[Row], finest: float) -> List[Claim]:
    """Claims on the base material, and on the inertial numbers of all. Runs that are missing, or have
    no finest particles as a reference, make no claim.

    :param finest: diameter of the plan's finest particles, mm
    """
    base = [r for r in rows if r.material == BASE.label and r.usual
            and np.isclose(r.reference_mm, finest)]
    scaled = [r for r in base if r.mode == "scaled"]
    found: List[Claim] = []
    for size, (curve, strength, speed_up) in LIMITS.items():
        row = _find(base, "scaled", size * finest)
        if row is None:
            continue
        name = f"scaled, {size:g}x"
        found += [_near(f"{name}: stress-strain curve, RMS", row.loading_deviation, curve),
                  _plain(f"{name}: stress-strain curve, mean",
                         f"{row.loading_mean_deviation:+.2f}%"),
                  _near(f"{name}: coordination number", row.coordination_deviation, COORDINATION),
                  _plain(f"{name}: coordination number of the bulk",
                         _percent(row.bulk_coordination_deviation)),
                  _plain(f"{name}: porosity of the bulk", _percent(row.porosity_deviation))]
        found += [_near(f"{name}: strength after {level / 1e3:g} kPa", value, strength)
                  for level, value in row.strength_deviation.items()]
        found += [_plain(f"{name}: curve of crushing after {level / 1e3:g} kPa, RMS",
                         _percent(value)) for level, value in row.crush_deviation.items()]
        found += [_at_least(f"{name}: speed-up of the confined test", row.speed_up, speed_up),
                  _plain(f"{name}: speed-up with the making of the specimen",
                         _number(row.whole_speed_up))]
    found += _of_wide_specimens(rows, base, finest)
    row = _find(base, "unscaled", 2.0 * finest)
    if row is not None:
        value = row.loading_deviation
        found.append(Claim("unscaled, 2x: stress-strain curve, RMS", f"> {UNSCALED:g}%",
                           _percent(value), "yes" if value.value > UNSCALED else "NO"))
        found += [_plain(f"unscaled, 2x: strength after {level / 1e3:g} kPa", _percent(value))
                  for level, value in row.strength_deviation.items()]
    every_width = [r for r in rows if r.material == BASE.label and r.mode == "scaled"]
    for what, some in (("base material, scaled", every_width), ("all", rows)):
        worst = max(some, key=lambda r: r.inertial_number, default=None)
        if worst:
            found.append(Claim(
                f"largest inertial number on loading, {what} ({worst.material} {worst.mode}, "
                f"{worst.diameter_mm:g} mm{', ' if worst.special else ''}{worst.special})",
                f"<= {INERTIAL_NUMBER:g}",
                f"{worst.inertial_number:.2e}",
                "yes" if worst.inertial_number <= INERTIAL_NUMBER else "NO"))
    crushing = [r.crush_inertial_number for r in rows if np.isfinite(r.crush_inertial_number)]
    if crushing:
        found.append(_plain("the same at the peak of crushing", f"{max(crushing):.1e}"))
    scatter = [r.loading_scatter for r in scaled if np.isfinite(r.loading_scatter)]
    if scatter:
        found.append(_plain("scatter of the seeds' curves, scaled (published: "
                            f"{PUBLISHED_SCATTER:g}%)", f"{min(scatter):.2f} to "
                            f"{max(scatter):.2f}%"))
    slow = next((r for r in rows if r.material == BASE.label
                 and r.strain_rate < Confined.strain_rate
                 and np.isfinite(r.loading_deviation.value)), None)
    if slow is not None:
        name = f"half the speed, {slow.diameter_mm:g} mm, same packings"
        found.append(_plain(f"{name}: curve, RMS", _percent(slow.loading_deviation)))
        found += [_plain(f"{name}: strength after {level / 1e3:g} kPa", _percent(value))
                  for level, value in slow.strength_deviation.items()]
    not_failed = sum(r.not_failed for r in rows)
    if not_failed:
        found.append(_plain("specimens that were crushed by 12% and kept 75% of their peak",
                            str(not_failed)))
    return found


def _of_wide_specimens(rows: Sequence[Row], usual: Sequence[Row], finest: float) -> List[Claim]:
    """The same limits of strength for coarse particles in specimens wider than the usual ones,
    beside the finest in a usual one: with more diameters across."""
    found: List[Claim] = []
    for row in rows:
        size = next((s for s in LIMITS if np.isclose(row.diameter_mm, s * finest)), None)
        wide = usual and row.width_mm > 1.001 * usual[0].width_mm
        if (size is None or not wide or row.material != BASE.label or row.mode != "scaled"
                or not np.isclose(row.reference_mm, finest)):
            continue
        found += [_near(f"scaled, {size:g}x, {row.special}: strength after {level / 1e3:g} kPa",
                        value, LIMITS[size][1])
                  for level, value in row.strength_deviation.items()]
    return found


def _find(rows: Sequence[Row], mode: str, diameter_mm: float) -> Optional[Row]:
    return next((r for r in rows if r.mode == mode
                 and np.isclose(r.diameter_mm, diameter_mm)), None)


def _number(value: Value, digits: int = 1) -> str:
    error = f" ± {value.error:.{digits}f}" if np.isfinite(value.error) else ""
    return f"{value.value:.{digits}f}{error}"


def _percent(value: Value) -> str:
    return _number(value, 2) + "%"


def _plain(what: str, measured: str) -> Claim:
    return Claim(what, "", measured, "")


def _at_least(what: str, value: Value, limit: float) -> Claim:
    return Claim(what, f">= {limit:g}", _number(value), "yes" if value.value >= limit else "NO")


def _near(what: str, value: Value, limit: float) -> Claim:
    """Within the limit, or within the standard error if that is larger, which it says."""
    apart = abs(value.value)
    if apart <= limit:
        verdict = "yes"
    elif np.isfinite(value.error) and apart <= value.error:
        verdict = "within its standard error only"
    else:
        verdict = "NO"
    return Claim(what, f"<= {limit:g}%", _percent(value), verdict)

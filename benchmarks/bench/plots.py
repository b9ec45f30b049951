# SPDX-License-Identifier: GPL-2.0-only
"""The figures."""
from __future__ import annotations

from pathlib import Path
from typing import Mapping, Sequence, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first: there may be no display)
import numpy as np  # noqa: E402

from collapse.report import COLOURS  # noqa: E402

from .statistics import Median  # noqa: E402


def save(figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def ratios(cases: Sequence[str], styles: Sequence[str],
           values: Mapping[Tuple[str, str, str], Median], path: Path) -> None:
    """Bars with quartiles; a panel for the pair time, one for the whole loop."""
    figure, axes = plt.subplots(1, 2, figsize=(11.0, 4.2), constrained_layout=True)
    width = 0.8 / max(1, len(styles))
    for axis, what in zip(axes, ("pair", "loop")):
        for k, style in enumerate(styles):
            some = [values[style, what, case] for case in cases]
            middle = np.array([m.value for m in some])
            spread = np.array([[m.value - m.low for m in some], [m.high - m.value for m in some]])
            axis.bar(np.arange(len(cases)) + (k - 0.5 * (len(styles) - 1)) * width, middle, width,
                     yerr=spread, capsize=2, color=COLOURS[(k + 1) % len(COLOURS)], label=style)
        axis.axhline(1.0, color="black", linewidth=0.8)
        axis.set_xticks(range(len(cases)), cases)
        axis.set_title(f"{what} time / that of gran/hooke/history", fontsize=10)
        axis.grid(axis="y", alpha=0.25, linewidth=0.5)
    axes[0].legend(fontsize=8, frameon=False)
    save(figure, path)

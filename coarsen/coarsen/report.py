# SPDX-License-Identifier: GPL-2.0-only
"""A study as one HTML file: figures to zoom, means with their errors, pictures before and after failure."""
from __future__ import annotations

import base64
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import jinja2
import pandas as pd
import plotly.graph_objects as go
from plotly.offline import get_plotlyjs

from .results import COSTS

#: Quantities of runs.csv that have a panel, and what is written at its axis.
PANELS = {"strain": "strain at 90% of the last level", "porosity_before": "porosity at the preload",
          "porosity": "porosity", "coordination": "coordination number", "bulk_modulus": "bulk modulus (Pa)",
          "lateral_ratio": "lateral stress ratio"}
#: Of a colour-blind reader (Okabe and Ito).
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
#: Variables by which specimens of a group are told apart when means are taken; seeds are not.
_SEED = "seed"


def write(path: Path, title: str, runs: pd.DataFrame, curves: pd.DataFrame, folder: Path,
          verdicts: Optional[pd.DataFrame] = None) -> None:
    """:param runs: a row a specimen, indexed by its name, as results.tidy makes it; likewise the curves
    :param folder: of the runs, for their pictures
    :param verdicts: of coarsen check, if there are any
    """
    template = jinja2.Environment(autoescape=True, loader=jinja2.FileSystemLoader(
        Path(__file__).resolve().parent)).get_template("report.html.j2")
    results = runs.attrs["results"]
    groups = [_group(str(name), some, curves[curves["run"].isin(some.index)] if len(curves) else curves, folder, results)
              for name, some in runs.groupby("group", sort=False)]
    path.write_text(template.render(
        title=title, plotly_js=_safe(get_plotlyjs()), specimens=len(runs), groups=groups,
        verdicts=None if verdicts is None else _safe(verdicts.to_html(index=False, float_format="%.4g"))),
        encoding="utf-8")


def _safe(text: str) -> Any:
    return jinja2.utils.markupsafe.Markup(text)


def varied(runs: pd.DataFrame, results: Sequence[str]) -> List[str]:
    """The variables in which a group's specimens differ, but for the seed and what was measured."""
    inputs = runs.columns.drop(["group", *COSTS, *results], errors="ignore")
    return [name for name in inputs if name != _SEED and runs[name].nunique() > 1] or ["group"]


def means(runs: pd.DataFrame, results: Sequence[str]) -> pd.DataFrame:
    """Mean and standard error (`_error`) over the seeds of each kind of specimen of a group, and their
    number."""
    quantities = [name for name in runs[[c for c in (*results, *COSTS) if c in runs]].select_dtypes("number")
                  if runs[name].notna().any()]
    grouped = runs.groupby(varied(runs, results), sort=True)[quantities]
    made = grouped.mean().join(grouped.sem(), rsuffix="_error")
    made.insert(0, "seeds", grouped.size())
    return made


def _group(name: str, runs: pd.DataFrame, curves: pd.DataFrame, folder: Path, results: Sequence[str]) -> Dict[str, Any]:
    names = varied(runs, results)
    kinds = runs.groupby(_by(names), sort=True)
    table = means(runs, results)
    figures = [_curve_figure(kinds, names, curves, quantity, label) for quantity, label in (
        ("strain", "axial strain of the bulk"), ("porosity", "porosity of the bulk"),
        ("coordination", "coordination number"))] if len(curves) else []
    strengths = {c: f"strength after {c.split('_')[1]} Pa" for c in table if c.startswith("strength_")
                 and not c.endswith("_error")}
    # without curves they are no specimens of in.confined, and the in-file's own names are all that is known
    panels = {**PANELS, **strengths} if len(curves) else {quantity: quantity for quantity in results}
    figures += [_mean_figure(table, names, quantity, label) for quantity, label in panels.items() if quantity in table]
    shown = table.loc[:, [c for c in table if not c.endswith("_error")]]
    text = pd.DataFrame({c: [_with_error(v, table.get(f"{c}_error", pd.Series(dtype=float)).get(k))
                             for k, v in shown[c].items()] for c in shown}, index=shown.index)
    return {"name": name, "text": f"{len(runs)} specimens, which differ in {', '.join(names)} and their seeds.",
            "figures": [_safe(f.to_html(full_html=False, include_plotlyjs=False)) for f in figures],
            "pictures": _pictures(runs, folder), "table": _safe(text.reset_index().to_html(index=False))}


def _by(names: List[str]) -> Any:
    """What groupby takes: a name alone is no list, or its keys would be tuples in some versions of pandas."""
    return names if len(names) > 1 else names[0]


def _label(names: List[str], key: Any) -> str:
    values = key if isinstance(key, tuple) else (key,)
    return ", ".join(f"{n} {v:g}" if isinstance(v, float) else f"{n} {v}" for n, v in zip(names, values))


def _curve_figure(kinds: Any, names: List[str], curves: pd.DataFrame, quantity: str, label: str) -> go.Figure:
    """Stress over strain, or a quantity over stress: means over the seeds, with their errors as bands."""
    figure = go.Figure()
    for k, (key, some) in enumerate(kinds):
        own = curves[curves["run"].isin(some.index) & (curves["branch"] == "load")]
        order = own.groupby("run").cumcount()
        mean, error = (own.groupby(order)[["stress", quantity]].agg(how) for how in ("mean", "sem"))
        colour = COLOURS[k % len(COLOURS)]
        bar = {"type": "data", "array": error[quantity].fillna(0.0), "thickness": 0.7, "width": 0}
        strain = quantity == "strain"
        figure.add_trace(go.Scatter(
            x=mean[quantity] if strain else mean["stress"], y=mean["stress"] if strain else mean[quantity],
            error_x=bar if strain else None, error_y=None if strain else bar, mode="lines",
            line={"color": colour}, name=_label(names, key)))
    figure.update_layout(template="simple_white", width=900, height=450, margin={"t": 30},
                         xaxis_title=label if quantity == "strain" else "axial stress (Pa)",
                         yaxis_title="axial stress (Pa)" if quantity == "strain" else label)
    return figure


def _mean_figure(table: pd.DataFrame, names: List[str], quantity: str, label: str) -> go.Figure:
    """Over the first variable that varies."""
    rows = table.reset_index()
    figure = go.Figure()
    for k, (key, some) in enumerate(rows.groupby(_by(names[1:]), sort=True) if names[1:] else [((), rows)]):
        figure.add_trace(go.Scatter(
            x=some[names[0]], y=some[quantity], mode="markers+lines", marker={"size": 8},
            line={"color": COLOURS[k % len(COLOURS)]}, name=_label(names[1:], key) or quantity,
            error_y={"type": "data", "array": some[f"{quantity}_error"].fillna(0.0)}))
    figure.update_layout(template="simple_white", width=900, height=350, margin={"t": 30},
                         xaxis_title=names[0], yaxis_title=label, showlegend=bool(names[1:]))
    return figure


def _with_error(value: float, error: Optional[float]) -> str:
    if pd.isna(value):
        return ""
    return f"{value:.4g}" if error is None or pd.isna(error) else f"{value:.4g} ± {error:.2g}"


def _pictures(runs: pd.DataFrame, folder: Path) -> List[Dict[str, str]]:
    """Those that in.unconfined made with `images yes`."""
    found = []
    for run in runs.index:
        for path in sorted((folder / run).glob("**/*.png")):
            stage = {"free": "before", "crush": "after failure"}.get(path.name.split(".")[0], path.name)
            found.append({"text": f"{run}: {stage}", "data": base64.b64encode(path.read_bytes()).decode("ascii")})
    return found

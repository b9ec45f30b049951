#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Draws the force-overlap curves of the documentation, from the kernel's own functions.

    make_figures.py [--cxx c++] [--eigen /usr/include/eigen3]

Writes figures/*.png beside this file. Needs a C++17 compiler, Eigen, NumPy and Matplotlib.
"""

import argparse
import pathlib
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
KERNEL = HERE.parent.parent / "kernel"
FIGURES = HERE / "figures"

LOADING, UNLOADING, ADHESIVE = 1, 2, 3
# distinguishable with colour-vision deficiency, and by width in grey
COLOUR = {LOADING: "#0072B2", UNLOADING: "#D55E00", ADHESIVE: "#009E73"}
NAME = {LOADING: "loading", UNLOADING: "unloading, reloading", ADHESIVE: "adhesive"}

# turning points of the overlap, in units of the first peak
PATH = (1e-9, 1.0, 0.75, 1.3, 0.25, 1.45, 1e-9)


def compile_curve(folder, cxx, eigen):
    program = pathlib.Path(folder) / "force_curve"
    subprocess.run([cxx, "-std=c++17", "-O1", f"-I{KERNEL}", f"-I{eigen}",
                    str(HERE / "force_curve.cpp"), "-o", str(program)], check=True)
    return program


def curve(program, law, exponent, k2, k_adh, f0, path=PATH, mu=0.5, limit=1.0, points=2001):
    """Columns of force_curve along a path; k1 = 1. `limit` is delta* of luding."""
    legs = [np.linspace(a, b, points) for a, b in zip(path, path[1:])]
    overlaps = np.concatenate(legs)
    # delta* = k2/(k2 - k1) depth 2 R*, with the R* = 1/4 of force_curve
    depth = 2.0 * limit * (k2 - 1.0) / k2
    words = [law, exponent, 1.0, k2, k_adh, f0, mu, depth]
    run = subprocess.run([str(program)] + [str(w) for w in words], text=True, check=True,
                         input="\n".join(f"{x:.12g}" for x in overlaps), stdout=subprocess.PIPE)
    return np.array([[float(x) for x in line.split()] for line in run.stdout.splitlines()])


def draw(axes, table, title, column=1, end=1.55):
    """A column against overlap, coloured by branch, broken where it steps."""
    overlap, value, branch = table[:, 0], table[:, column], table[:, 2].astype(int)
    step = np.abs(np.diff(value)) > 0.02 * np.ptp(value)
    for b in (LOADING, UNLOADING, ADHESIVE):
        # a point of another branch ends a section, unless the force continues through it
        x, y = overlap.copy(), value.copy()
        keep = branch == b
        joined = keep.copy()
        joined[1:] |= keep[:-1] & ~step
        y[~joined] = np.nan
        breaks = np.flatnonzero(step & joined[:-1] & joined[1:])
        x, y = np.insert(x, breaks + 1, np.nan), np.insert(y, breaks + 1, np.nan)
        axes.plot(x, y, color=COLOUR[b], lw=2.0, label=NAME[b], solid_capstyle="butt")
    for at in np.flatnonzero(step):
        axes.plot(overlap[at:at + 2], value[at:at + 2], color="0.4", lw=1.0, ls=":")
    axes.axhline(0.0, color="0.3", lw=0.7)
    axes.set_title(title, fontsize=10)
    axes.set_xlabel(r"overlap $\delta/\delta_1$")
    axes.set_xlim(0.0, end)
    axes.spines[["top", "right"]].set_visible(False)


def save(figure, name):
    figure.savefig(FIGURES / name, dpi=140, metadata={"Software": None})
    plt.close(figure)
    print(FIGURES / name)


def plateau(program):
    figure, panels = plt.subplots(1, 2, figsize=(9.0, 3.9), sharey=True, layout="constrained")
    for axes, f0 in zip(panels, (0.0, -0.15)):
        table = curve(program, "plateau", 1, 2.0, 1.0, f0)
        label = "$f_0 = 0$" if f0 == 0.0 else rf"$f_0 = {f0:g}\,k_1\delta_1$"
        draw(axes, table, f"plateau, $k_2 = 2k_1$, $k_{{adh}} = k_1$, {label}")
        if f0:
            # the last opening: delta_max is the last peak
            begin = 0.5 * PATH[-2] * (1.0 - 0.5)
            pull = 0.5 * PATH[-2]
            axes.annotate("steps by $f_0$ where\nthe plateau begins", (begin, -pull + 0.5 * f0),
                          (0.66, -0.72), fontsize=9, va="center",
                          arrowprops={"arrowstyle": "->", "color": "0.3"})
            axes.annotate("$f_0$", (0.0, f0), (0.06, 0.12), fontsize=9,
                          arrowprops={"arrowstyle": "->", "color": "0.3"})
    panels[0].set_ylim(-1.05, 1.6)
    panels[0].set_ylabel(r"$f_{hys}/(k_1\delta_1)$")
    panels[0].legend(frameon=False, fontsize=9, loc="upper left")
    save(figure, "eepa_plateau.png")


def linear(program):
    figure, panels = plt.subplots(1, 2, figsize=(9.0, 3.9), layout="constrained")
    for axes, n in zip(panels, (1.0, 1.5)):
        table = curve(program, "linear", n, 2.0, 1.0, -0.15)
        draw(axes, table, rf"linear, $n = {n:g}$, $k_2 = 2k_1$, $k_{{adh}} = k_1$, "
             r"$f_0 = -0.15\,k_1\delta_1^n$")
        axes.set_ylabel(r"$f_{hys}/(k_1\delta_1^n)$")
    panels[0].legend(frameon=False, fontsize=9, loc="upper left")
    save(figure, "eepa_linear.png")


def luding(program):
    figure, panels = plt.subplots(1, 2, figsize=(9.0, 3.9), layout="constrained")
    # in units of delta*: pressed ever further, beyond the limit, and pulled apart
    path = (1e-9, 0.35, 0.2, 0.7, 0.42, 1.4, 1e-9)
    table = curve(program, "luding", 1, 5.0, 2.0, 0.0, path=path)
    draw(panels[0], table, r"luding, $k_2 = 5k_1$, $k_{adh} = 2k_1$", end=1.45)
    panels[0].axvline(1.0, color="0.6", lw=0.8, ls="--")
    panels[0].annotate("limit branch,\nup and down", (1.2, 2.0), (0.55, 2.1), fontsize=9,
                       arrowprops={"arrowstyle": "->", "color": "0.3"})
    panels[0].legend(frameon=False, fontsize=9, loc="upper left")
    # pressed again from ever lower on the adhesive branch
    path = (1e-9, 1.0, 0.25, 0.34, 0.12, 0.2, 0.04, 0.095, 1e-9)
    table = curve(program, "luding", 1, 5.0, 2.0, 0.0, path=path)
    draw(panels[1], table, "pressed again from the adhesive branch", end=1.05)
    for axes in panels:
        axes.set_xlabel(r"overlap $\delta/\delta^*$")
        axes.set_ylabel(r"$f_{hys}/(k_1\delta^*)$")
    save(figure, "eepa_luding.png")


def luding_impact(program):
    """Restitution over speed: the work that a contact returns over what was put in."""
    figure, axes = plt.subplots(figsize=(6.4, 3.9), layout="constrained")
    integrate = getattr(np, "trapezoid", None) or np.trapz
    for k_adh, name, colour in ((0.0, "0", "#0072B2"), (0.2, r"0.2\,k_1", "#009E73"),
                                (1.0, "k_1", "#D55E00")):
        for f0, style in ((0.0, "-"), (-0.02, "--")):
            speeds, restitution = [], []
            first = max(1e-3, -2.0 * f0 * (1.0 + 1e-6))
            for largest in np.sort(np.append(np.geomspace(first, 5.0, 240), 1.0)):
                table = curve(program, "luding", 1, 5.0, k_adh, f0, path=(1e-9, largest, 1e-9),
                              points=1001)
                half = len(table) // 2
                energy = integrate(table[:half, 1], table[:half, 0])
                returned = -integrate(table[half:, 1], table[half:, 0])
                if energy <= 0.0:
                    continue
                # k1 = delta* = 1: the speed over v_p is the root of twice the energy
                speeds.append(np.sqrt(2.0 * energy))
                restitution.append(np.sqrt(max(returned, 0.0) / energy))
            label = f"$k_{{adh}} = {name}$" if f0 == 0.0 else None
            axes.semilogx(speeds, restitution, color=colour, ls=style, lw=1.8, label=label)
    axes.plot([], [], color="0.3", ls="--", label=r"$f_0 = -0.02\,k_1\delta^*$")
    axes.set_xlim(1e-3, 10.0)
    axes.set_ylim(-0.02, 1.02)
    axes.set_xlabel(r"speed $v/v_p$")
    axes.set_ylabel(r"restitution $e$ (0: they stick)")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=9, loc="center left")
    save(figure, "eepa_luding_impact.png")


def check_plateau_energy(program):
    """The excess work of f0 that the documentation states."""
    k2, k_adh, f0, peak = 2.0, 1.0, -0.15, 1.0
    table = curve(program, "plateau", 1, k2, k_adh, f0, path=(1e-9, peak, 1e-9))
    without = curve(program, "plateau", 1, k2, k_adh, 0.0, path=(1e-9, peak, 1e-9))
    # `trapezoid` has another name before NumPy 2
    integrate = getattr(np, "trapezoid", None) or np.trapz
    work = integrate(table[:, 1], table[:, 0]) - integrate(without[:, 1], without[:, 0])
    begin = peak / k2 * (1.0 - k_adh / k2)
    # work is negative during loading and positive during unloading: that of f0 is minus the integral
    print(f"surplus of work of f0 per closing and opening: {-work:.4g}, |f0| delta_s: {-f0 * begin:.4g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cxx", default="c++")
    parser.add_argument("--eigen", default="/usr/include/eigen3")
    arguments = parser.parse_args()
    FIGURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        program = compile_curve(folder, arguments.cxx, arguments.eigen)
        plateau(program)
        linear(program)
        luding(program)
        luding_impact(program)
        check_plateau_energy(program)


if __name__ == "__main__":
    main()

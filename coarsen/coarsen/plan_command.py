# SPDX-License-Identifier: GPL-2.0-only
"""`coarsen plan`: its options, its table, and the include file that it writes."""
from __future__ import annotations

import argparse
import math
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import pandas as pd

from . import evidence, workflow
from .dimensionless import Loading, Powder
from .options import percentages
from .plan import Line, Speed, best, line, series
from .results import PRELOAD, costs

#: Quantities of a shear tester and of a silo; the others are of specimens.
MACHINES = ("shear_strength", "flow_function", "friction_angle", "steady_angle", "flow")
INFILES = Path(__file__).resolve().parents[2] / "examples" / "scale_collapse"


def add(commands: Any) -> None:
    """Adds the command to the parser's commands."""
    parser = commands.add_parser(
        "plan", help="which diameter may be simulated, at what cost and with what error",
        description="From a real powder and a test to a table of diameters: particles, time step, cost, "
                    "dimensionless numbers, predicted errors with 90% intervals, and what speaks against "
                    "each. SI units.",
        epilog="Exit status: 0 with a diameter that may be used, 3 without, 1 for an error, 2 for a wrong option.")
    powder = parser.add_argument_group("powder")
    powder.add_argument("--diameter", type=float, required=True, metavar="M", help="of the real particles")
    powder.add_argument("--density", type=float, required=True, metavar="KG/M3", help="of their material")
    powder.add_argument("--dref", type=float, default=None, metavar="M",
                        help="diameter that the coefficients belong to (the real one)")
    for name, unit in (("k1", "N/m"), ("k2", "N/m"), ("kadh", "N/m"), ("f0", "N")):
        powder.add_argument(f"--{name}", type=float, required=name == "k1", metavar=unit,
                            default={"k2": None, "kadh": 0.0, "f0": 0.0}.get(name),
                            help="of pair_coeff" + (" (2 k1)" if name == "k2" else ""))
    powder.add_argument("--smallest", type=float, default=1.0, metavar="PART",
                        help="smallest diameter over --diameter, for a distribution (1)")
    test = parser.add_argument_group("test")
    test.add_argument("--width", type=float, required=True, metavar="M",
                      help="of the specimen or machine: gap, orifice")
    test.add_argument("--length", type=float, default=None, metavar="M", help="the other way (--width)")
    test.add_argument("--height", type=float, default=None, metavar="M", help="(--width)")
    test.add_argument("--solid-fraction", type=float, default=0.6, metavar="PART", help="(0.6)")
    test.add_argument("--stress", type=float, nargs=2, required=True, metavar=("LOW", "HIGH"),
                      help="between which results are wanted, Pa")
    test.add_argument("--rate", type=float, required=True, metavar="1/S", help="strain rate")
    test.add_argument("--strain", type=float, default=0.2, metavar="E", help="gone through in all (0.2)")
    test.add_argument("--gravity", type=float, default=0.0, metavar="M/S2",
                      help="where weight matters, as for a bed that grains make themselves (0)")
    test.add_argument("--true-gravity", action="store_true", help="simulated unchanged, instead of over s")
    parser.add_argument("--soften", type=float, default=1.0, metavar="FACTOR",
                        help="simulate with stiffnesses divided by this: longer time steps, deeper overlaps (1)")
    parser.add_argument("--want", nargs="+", required=True, metavar="NAME=PERCENT",
                        help="quantities and the error allowed, such as strain=5 strength=10; of "
                             + ", ".join(sorted(evidence.read()["quantity"].unique())))
    parser.add_argument("--diameters", type=float, nargs="+", default=None, metavar="M",
                        help="to look at (a series)")
    parser.add_argument("--speed", type=float, default=None, metavar="N",
                        help="particles times steps in a second of a core, instead of a run of seconds here")
    parser.add_argument("--lmp", default=None, help="LAMMPS for that run")
    parser.add_argument("--calibrated", type=Path, default=None, metavar="CSV",
                        help="calibration.csv of coarsen calibrate: the errors of its coefficients are added")
    parser.add_argument("--write", type=Path, default=None, metavar="FILE",
                        help="include file with the variables of the cheapest diameter that may be used")
    parser.set_defaults(work=run)


def given(value: Optional[float], otherwise: float) -> float:
    """An option's value, where it has one: 0 is one, and not allowed later."""
    return otherwise if value is None else value


def _check_include(arguments: argparse.Namespace, loading: Loading, machine: Sequence[str]) -> None:
    """:raise ValueError: where --write would write what is not in.confined's
    :param machine: quantities of machines that are wanted
    """
    if not arguments.write:
        return
    if not arguments.write.resolve().parent.is_dir() or arguments.write.is_dir():
        raise ValueError(f"--write {arguments.write}: there is no such folder, or it is one")
    for wrong, option, what in (
            (loading.length != loading.width, f"--length is {loading.length:g}", f"specimens as long as wide, {loading.width:g}"),
            (arguments.smallest != 1.0, f"--smallest is {arguments.smallest:g}", "equal particles"),
            (machine, f"--want has {', '.join(machine)}, of a machine", "in.confined")):
        if wrong:
            raise ValueError(f"{option}: the include file is for {what}")


def run(arguments: argparse.Namespace) -> int:
    powder = Powder(arguments.diameter, arguments.density, given(arguments.dref, arguments.diameter), arguments.k1,
                    given(arguments.k2, 2.0 * arguments.k1), arguments.kadh, arguments.f0, arguments.smallest)
    loading = Loading(arguments.width, given(arguments.length, arguments.width), given(arguments.height, arguments.width),
                      arguments.solid_fraction, *arguments.stress, arguments.rate, arguments.strain,
                      arguments.gravity)
    wanted = percentages(arguments.want)
    if arguments.true_gravity and not loading.gravity:
        raise ValueError("--true-gravity needs --gravity")
    machine = [quantity for quantity in wanted if quantity in MACHINES]
    if machine and not (loading.gravity and arguments.true_gravity):
        raise ValueError(f"--want {machine[0]}: the machines' studies had the same gravity at every diameter: give --gravity 9.81 "
                         "--true-gravity")
    simulated = powder.softened(arguments.soften)
    _check_include(arguments, loading, machine)
    table = evidence.read()
    unknown = sorted(set(wanted) - set(table["quantity"]))
    if unknown:
        raise ValueError(f"--want {unknown[0]}: no evidence, there is some for "
                         f"{', '.join(sorted(table['quantity'].unique()))}")
    sizes = series(powder, loading) if arguments.diameters is None else arguments.diameters
    if not all(map(math.isfinite, sizes)) or len(set(sizes)) < len(sizes) or max(sizes) > loading.narrowest:
        raise ValueError(f"--diameters {' '.join(f'{d:g}' for d in sizes)}: allowed are numbers up to the narrowest side, "
                         f"{loading.narrowest:g}, each once")
    too_fine = [d for d in sizes if d < powder.diameter]
    if too_fine:
        raise ValueError(f"--diameters {too_fine[0]:g}: allowed are {powder.diameter:g} (the real one) or more")
    speed = Speed(measure_speed(workflow.find_lmp(arguments.lmp)) if arguments.speed is None else arguments.speed)
    lines = [line(powder, loading, d, wanted, table, speed, not arguments.true_gravity,
                  None if arguments.calibrated is None else _errors_of_coefficients(arguments.calibrated),
                  simulated) for d in sizes]
    print(text(lines, speed))
    chosen = best(lines)
    if chosen is None:
        print("\nNo diameter may be used.")
        return 3
    print(f"\nCheapest that may be used: {1e3 * chosen.diameter:.4g} mm")
    if arguments.write:
        arguments.write.write_text(include(simulated, loading, chosen, not arguments.true_gravity),
                                   encoding="utf-8")
        print(f"Include file: {arguments.write}")
    return 0


def _errors_of_coefficients(path: Path) -> Dict[str, float]:
    """By quantity, the largest of its targets'.

    :raise ValueError: for a file without them
    """
    table = pd.read_csv(path)
    missing = {"quantity", "error_of_coefficients"} - set(table)
    if missing:
        raise ValueError(f"--calibrated {path}: it has no column {', '.join(sorted(missing))}")
    known = pd.to_numeric(table["error_of_coefficients"], errors="coerce")
    if (known < 0.0).any() or (known.isna() & table["error_of_coefficients"].notna()).any():
        raise ValueError(f"--calibrated {path}: error_of_coefficients must be numbers of 0 or more, or empty")
    return table.groupby("quantity")["error_of_coefficients"].apply(lambda x: x.max(skipna=False)).to_dict()


def measure_speed(lmp: Path) -> float:
    """Particles times steps in a second of a core, from a specimen of some thousand particles that is pressed."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([str(lmp), "-in", str(INFILES / "in.confined"), "-log", "log.lammps", "-screen", "none",
                        "-var", "files", str(INFILES), "-var", "d", "2e-3", "-var", "level", "6e3", "-var",
                        "hold", "1e-3"], cwd=folder, check=True, stdin=subprocess.DEVNULL)
        cost = costs(Path(folder))
    # without the making of the specimen, in which few particles touch
    return cost["particles"] * cost["test_steps"] / cost["test_seconds"]


def text(lines: Sequence[Line], speed: Speed) -> str:
    """For people, a paragraph a diameter."""
    quantities = list(lines[0].predictions)
    head = f"{'d (mm)':>8} {'particles':>10} {'step (s)':>9} {'steps':>9} {'core h':>8} {'GB':>6} {'W/d':>6} " \
           f"{'I':>8} {'d/d':>6} {'Bo':>7} {'bed':>6}" + "".join(f"  {q[:20]:>20}" for q in quantities) + "  verdict"
    rows: List[str] = [f"{speed.particle_steps:.3g} particle steps a second and core; core h are those of the test; "
                       "to make its specimen takes half as long, by rain 1.6 times as long", "",
                       head.replace("d/d", "δ/d")]
    for one in lines:
        weight = one.numbers["weight"]
        rows.append(f"{1e3 * one.diameter:>8.4g} {one.particles:>10} {one.time_step:>9.2e} {one.steps:>9} "
                    f"{one.core_seconds / 3600:>8.2g} {1e-9 * one.memory:>6.2g} "
                    f"{1 / one.numbers['narrowness']:>6.3g} {one.numbers['inertia']:>8.1e} "
                    f"{one.numbers['overlap']:>6.3f} {f'{1 / weight:.3g}' if weight else '-':>7} "
                    f"{one.numbers['bed']:>6.2g}"
                    + "".join(f"  {_interval(p):>20}" for p in one.predictions.values())
                    + f"  {'no' if one.objections else 'yes'}")
    reasons = [(one, reason) for one in lines for reason in one.objections]
    if reasons:
        rows += ["", "Why not:"] + [f"  {1e3 * one.diameter:.4g} mm: {reason}" for one, reason in reasons]
    return "\n".join(rows)


def _interval(prediction: evidence.Prediction) -> str:
    return (f"{100 * prediction.error:+.1f} [{100 * prediction.low:+.1f}, {100 * prediction.high:+.1f}]%")


def include(powder: Powder, loading: Loading, chosen: Line, scaled_gravity: bool) -> str:
    """Variables of in.confined and of in-files that take the same ones."""
    lines = ["# Written by coarsen plan. Predicted errors against the real diameter, with 90% intervals:"]
    lines += [f"#   {quantity} {_interval(p)}" for quantity, p in chosen.predictions.items()]
    lines += [f"variable {name:<9} index {value}" for name, value in (
        ("d", f"{chosen.diameter:g}"), ("dref", f"{powder.reference:g}"), ("k1", f"{powder.k1:g}"),
        ("k2", f"{powder.k2:g}"), ("kadh", f"{powder.kadh:g}"), ("f0", f"{powder.f0:g}"),
        ("density", f"{powder.density:g}"), ("side", f"{loading.width:g}"), ("rate", f"{loading.rate:g}"),
        ("level", f"{loading.high:g}"), ("ppack", f"{loading.low / PRELOAD:g}"),
        # What in.confined packs with belongs to dref: as stiff and as fast as its own particles of 1 mm.
        ("kpack", f"{5.0e6 * powder.reference:g}"), ("packrate", f"{1.0e-3 / powder.reference:g}"),
        ("nref", str(round(loading.particles(chosen.diameter) * (chosen.diameter / powder.reference)**3))))]
    if loading.gravity:
        # in.start_loose has gravity over s at every diameter, and takes that of dref.
        at_reference = loading.gravity * (powder.diameter / powder.reference if scaled_gravity else 1.0)
        lines += ["variable start     index loose", f"variable gravity   index {at_reference:g}",
                  f"variable weight    index {'scaled' if scaled_gravity else 'true'}"]
    return "\n".join(lines) + "\n"

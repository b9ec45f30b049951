#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Finds coefficients of the contact law. `fit`: those with which coarse particles reproduce a
target's curves of confined compression, and its unconfined strength. `tensile`: the pull-off
force f0 for a tensile strength. See strength.md."""
from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from typing import List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from run_study import build_folder, cores  # noqa: E402  (says what Python lacks)

from collapse.cases import LAWS  # noqa: E402
from collapse.command import exit_status  # noqa: E402
from collapse.measured import strength_of  # noqa: E402
from collapse.progress import Progress, in_words  # noqa: E402
from collapse.runs import Launcher, Runner, find_lmp  # noqa: E402
from collapse.specimens import (POROSITY, Confined, Material,  # noqa: E402
                                pull_off_force)


def parse_arguments(words: Optional[Sequence[str]] = None) -> argparse.Namespace:
    shown = argparse.ArgumentDefaultsHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__)
    which = parser.add_subparsers(dest="command", required=True)

    tensile = which.add_parser("tensile", formatter_class=shown,
                               help="f0 of a tensile strength, by Rumpf's estimate")
    tensile.add_argument("--strength", type=float, required=True, metavar="PA")
    tensile.add_argument("--diameter", type=float, default=Confined.reference_diameter,
                         metavar="M", help="that f0 belongs to")
    tensile.add_argument("--porosity", type=float, default=POROSITY, metavar="N")

    fit = which.add_parser("fit", formatter_class=shown, help="k1, kadh, f0, mu of a target")
    fit.add_argument("--stress-strain", type=Path, required=True, metavar="CSV",
                     help="loading in confined compression: columns strain, stress (Pa)")
    fit.add_argument("--porosity-stress", type=Path, required=True, metavar="CSV",
                     help="its porosity: columns stress (Pa), porosity")
    fit.add_argument("--unconfined", type=Path, default=None, metavar="CSV",
                     help="crushing after the highest stress: columns strain, stress (Pa), of "
                          "which the strength is read as of the runs. Confined curves alone say "
                          "little about adhesion")
    fit.add_argument("--strength", type=float, default=None, metavar="PA",
                     help="unconfined strength, instead of --unconfined; of several tests the mean "
                          "of their strengths, which is more than that of their mean curve")
    fit.add_argument("--strength-error", type=float, default=0.0, metavar="PA",
                     help="its standard error")
    fit.add_argument("--diameter", type=float, required=True, metavar="M",
                     help="of the coarse particles")
    fit.add_argument("--free", nargs="+", default=["k1", "kadh"], metavar="NAME",
                     help="what is sought, of k1 kadh f0 mu (k2 is 2 k1); the rest is kept")
    fit.add_argument("--tensile", type=float, default=None, metavar="PA",
                     help="f0 from this tensile strength instead")
    fit.add_argument("--law", choices=LAWS, default="linear")
    fit.add_argument("--k1", type=float, default=5.0e3, help="first value, N/m")
    fit.add_argument("--kadh", type=float, default=5.0e3, help="first value, N/m")
    fit.add_argument("--f0", type=float, default=-6.6667e-5, help="first value, N")
    fit.add_argument("--mu", type=float, default=0.5, help="first value")
    fit.add_argument("--dref", type=float, default=Confined.reference_diameter, metavar="M",
                     help="diameter that all coefficients belong to")
    fit.add_argument("--level", type=float, default=None, metavar="PA",
                     help="stress to load to (default: the largest of the target)")
    fit.add_argument("--preload", type=float, default=5.0e3, metavar="PA",
                     help="stress that strain counts from")
    fit.add_argument("--seeds", type=int, default=3, metavar="N",
                     help="packings of each parameter set; 2 or more for an uncertainty")
    fit.add_argument("--first-seed", type=int, default=1001, metavar="S")
    fit.add_argument("--side", type=float, default=Confined.side, metavar="M",
                     help="width of the specimen")
    fit.add_argument("--particles", type=int, default=Confined.reference_particles, metavar="N",
                     help="of diameter dref that the specimen would have")
    fit.add_argument("--steps", type=int, default=8, metavar="N",
                     help="steps of the optimiser at most")
    fit.add_argument("--jobs", type=int, default=cores(), help="runs at once, a core each")
    fit.add_argument("--lmp", type=Path, default=None)
    fit.add_argument("--mpirun", default="mpirun")
    fit.add_argument("--out", type=Path, default=None,
                     help="folder of runs, state and result (default: calibrate in the build "
                          "folder); the same call goes on from what it holds")
    arguments = parser.parse_args(words)
    if arguments.command == "fit":
        for name in ("seeds", "steps", "jobs", "particles"):
            if getattr(arguments, name) < 1:
                parser.error(f"--{name} is {getattr(arguments, name)}, allowed is 1 or more")
        if arguments.strength is not None and arguments.unconfined is not None:
            parser.error("--strength and --unconfined both give the strength: name one of them")
        if arguments.strength_error < 0.0:
            parser.error(f"--strength-error is {arguments.strength_error:g}, allowed is 0 or more")
        if (arguments.strength_error and arguments.strength is None
                and arguments.unconfined is None):
            parser.error("--strength-error needs --strength or --unconfined")
        if arguments.tensile is not None and "f0" in arguments.free:
            parser.error("--tensile gives f0, so it can not be free")
        arguments.out = (arguments.out or build_folder() / "calibrate").resolve()
    return arguments


def tensile(arguments: argparse.Namespace) -> int:
    force = pull_off_force(arguments.strength, arguments.diameter, arguments.porosity)
    print(f"variable f0        index {force:.8g} # {arguments.strength:g} Pa by Rumpf's estimate "
          f"at porosity {arguments.porosity:g}, for {1e3 * arguments.diameter:g} mm")
    return 0


def fit(arguments: argparse.Namespace) -> int:
    try:
        from collapse import calibration
    except ImportError as missing:
        sys.exit(f"{sys.executable} has no {missing.name}; on Debian: "
                 f"apt-get install python3-scipy and /usr/bin/python3 {sys.argv[0]}")
    lmp = find_lmp(arguments.lmp, [build_folder() / "lmp"])
    strength = arguments.strength
    if arguments.unconfined is not None:
        strength = strength_of(*calibration.read_curve(arguments.unconfined, "strain", "stress"))[0]
    stress, strain = calibration.read_curve(arguments.stress_strain, "stress", "strain")
    target = calibration.target_from(
        strain, stress, *calibration.read_curve(arguments.porosity_stress, "stress", "porosity"),
        arguments.preload, strength,
        calibration.read_error(arguments.stress_strain, "stress", "strain"),
        arguments.strength_error)
    level = arguments.level or round(float(target.stress[-1]), 3)
    f0 = (arguments.f0 if arguments.tensile is None
          else pull_off_force(arguments.tensile, arguments.dref))
    start = Material("start", arguments.law, arguments.k1, arguments.kadh, f0, arguments.mu)
    launcher = Launcher(lmp, HERE / "in.confined", arguments.mpirun)
    arguments.out.mkdir(parents=True, exist_ok=True)
    state = arguments.out / "state.json"
    tried: List[dict] = []
    most, began = arguments.steps * (1 + len(arguments.free)), time.monotonic()

    def run(runs: list) -> None:
        Runner(launcher, arguments.out, arguments.jobs, Progress(runs, arguments.jobs)).run(runs)

    def note(entry: dict) -> None:
        tried.append(entry)
        state.write_text(json.dumps(tried, indent=2) + "\n", encoding="utf-8")
        values = ", ".join(f"{name} {value:.5g}" for name, value in entry["parameters"].items())
        left = (time.monotonic() - began) / len(tried) * max(0, most - len(tried))
        print(f"[{len(tried)} of at most {most} parameter sets, at most {in_words(left)} left] "
              f"{values}: distance {entry['distance']:.4f}", flush=True)

    seeds = tuple(range(arguments.first_seed, arguments.first_seed + arguments.seeds))
    specimens = calibration.Specimens(target, arguments.diameter, (level,), seeds, arguments.out,
                                      run, arguments.side, arguments.dref, arguments.particles)
    one = specimens.specimen(start, seeds[0])
    each = len(seeds) * (2 if strength is not None else 1)
    print(f"Sought: {', '.join(arguments.free)}; {each} runs of {one.particles} particles for each "
          f"parameter set, {1 + len(arguments.free)} sets a step, {arguments.steps} steps at most",
          flush=True)
    found = calibration.fit(start, arguments.free, specimens, arguments.steps, note)
    about = (f"{1e3 * arguments.diameter:g} mm, {arguments.seeds} packings; porosity less that of "
             f"the target at the lowest stress {found.porosity_offset:+.4f}")
    text = calibration.include_file(found, arguments.dref, about)
    path = arguments.out / "in.calibrated"
    path.write_text(text, encoding="utf-8")
    print(f"\n{text}\n{found.message}\nInclude file: {path}")
    return 0


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = parse_arguments(words)
    work = tensile if arguments.command == "tensile" else fit
    return exit_status("calibrate.py", lambda: work(arguments), ValueError)


if __name__ == "__main__":
    sys.exit(main())

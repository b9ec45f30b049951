# SPDX-License-Identifier: GPL-2.0-only
"""`coarsen check`: its options, its runs and its report."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Dict, List

import yaml

from . import check, workflow
from .equivalence import EQUIVALENT
from .options import diameters, percentages, add_running
from .results import tidy
from .study import read_study

#: Exit status: equivalent, not so, and not decided by so many seeds.
STATUS = {EQUIVALENT: 0, check.DIFFERENT: 3, check.OPEN: 4}


def add(commands: Any) -> None:
    """Adds the command to the parser's commands."""
    parser = commands.add_parser(
        "check", help="do coarse particles give what finer ones give, in runs of your in-file?",
        description=check.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Exit status: 0 equivalent, 3 different, 4 undecided, 1 for an error.")
    parser.add_argument("infile", type=Path, help="it takes -var d, seed, out, and prints Result lines")
    parser.add_argument("--diameters", type=float, nargs="+", required=True, metavar="D",
                        help="two or more, in the in-file's unit of d")
    parser.add_argument("--want", nargs="+", required=True, metavar="NAME=PERCENT",
                        help="quantities and the difference allowed, such as strength=5 porosity=1")
    parser.add_argument("--seeds", type=int, default=4, metavar="N", help="of each diameter, 2 or more (4)")
    parser.add_argument("--real", type=float, default=None, metavar="D",
                        help="the powder's own diameter, which a trend is followed to")
    parser.add_argument("--var", nargs="+", action="append", default=[], metavar=("NAME", "VALUE"),
                        help="of the in-file, for all runs; again for more of them")
    parser.add_argument("--then", type=Path, default=None, metavar="INFILE",
                        help="in-file that goes on from the folder of each run, named by its variable state")
    parser.add_argument("--state", default=None, help="value of state within that folder")
    parser.add_argument("--unpaired", action="store_true",
                        help="a seed means nothing from one diameter to the other")
    add_running(parser, "check")
    parser.set_defaults(work=run)


def run(arguments: argparse.Namespace) -> int:
    sizes = diameters(arguments.diameters)
    wanted = percentages(arguments.want)
    if arguments.seeds < 2:
        raise ValueError(f"--seeds is {arguments.seeds}, allowed is 2 or more")
    if arguments.real is not None:
        diameters([arguments.real, *sizes], "--real and --diameters")
    if (arguments.then is None) != (arguments.state is None):
        raise ValueError("--then and --state go together")
    for path in [arguments.infile] + ([arguments.then] if arguments.then else []):
        if not path.is_file():
            raise FileNotFoundError(f"there is no {path}")
    out = arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    study = out / "study.yaml"
    _write_if_new(study, yaml.safe_dump(_study_of(arguments, sizes), sort_keys=False))
    infiles = arguments.infile.resolve().parent
    workflow.run_study(study, infiles, out, workflow.find_lmp(arguments.lmp), arguments.cores, arguments.ranks,
                       arguments.snakemake, arguments.switches)
    runs, _ = tidy(read_study(study), out, infiles)
    if not set(wanted) & set(runs):
        raise check.NothingToCompare(f"{out}: no log.lammps has lines `Result NAME NUMBER` of {', '.join(wanted)}: let "
                                     'the in-file print them, as in print "Result strength $(v_strength)"')
    found = check.verdicts(runs.reset_index(drop=True), wanted, arguments.real, not arguments.unpaired)
    found.to_csv(out / "check.csv", index=False)
    print(check.table_text(found))
    said = check.overall(found["verdict"])
    print(f"\n{said}: {out / 'check.csv'}")
    return STATUS[said]


def _study_of(arguments: argparse.Namespace, sizes: List[float]) -> Dict[str, Any]:
    entry: Dict[str, Any] = {"infile": arguments.infile.name}
    for name, *values in arguments.var:
        if not values or name in ("d", "seed", "out", "files") or any(".." in value and "/" not in value for value in values):
            raise ValueError(f"--var {' '.join([name, *values])}: allowed is a name other than d, seed, out "
                             "and files, and its value, which is no span")
        entry[name] = [list(values)] if len(values) > 1 else values[0]
    entry["d"] = [repr(size) for size in sizes]
    entry["seed"] = list(range(1, arguments.seeds + 1))
    if arguments.then:
        if arguments.then.resolve().parent != arguments.infile.resolve().parent:
            raise ValueError(f"--then {arguments.then} is not in the folder of {arguments.infile}")
        entry["after"] = {"infile": arguments.then.name, "state": arguments.state}
    return {"groups": {"check": entry}}


def _write_if_new(path: Path, text: str) -> None:
    """So that an unchanged study has an unchanged date."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")

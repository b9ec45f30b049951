#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Runs a study of this folder and writes its tables and figures. The same call goes on where it was stopped."""
from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path
from typing import List, Optional, Sequence

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "coarsen")]

try:
    import yaml
    from coarsen import results, study, workflow
    from coarsen.options import Parser
except ImportError as missing:
    sys.exit(f"{sys.executable} has no {missing.name}; on Debian: apt-get install python3-{missing.name} and "
             f"/usr/bin/python3 {sys.argv[0]}")


def parse_arguments(words: Optional[Sequence[str]] = None) -> argparse.Namespace:
    parser = Parser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("study", nargs="?", default="collapse",
                        help="a study file, or the name of one here: "
                             + ", ".join(sorted(path.stem for path in HERE.glob("*.yaml"))))
    parser.add_argument("--quick", action="store_true", help="its small counterpart, STUDY_quick.yaml")
    parser.add_argument("--var", nargs="+", action="append", default=[], metavar=("NAME", "VALUE"),
                        help="of the in-file, for all runs, such as law plateau; again for more of them")
    parser.add_argument("--plan", action="store_true", help="only say what would be run")
    parser.add_argument("--report", action="store_true", help="only the tables and figures of finished runs")
    parser.add_argument("--lmp", default=None, help="LAMMPS with this package (default: lmp in the build folder)")
    parser.add_argument("--cores", type=int, default=workflow.cores(), help="runs at once")
    parser.add_argument("--out", type=Path, default=None,
                        help="folder of runs, tables and figures (default: that of the study's name in the build folder)")
    parser.add_argument("--snakemake", nargs=argparse.REMAINDER, default=[],
                        help="last of all: further arguments of Snakemake, such as --profile slurm")
    return parser.parse_args(words)


def run(arguments: argparse.Namespace) -> None:
    name = f"{arguments.study}{'_quick' if arguments.quick else ''}"
    path = Path(name) if Path(name).is_file() else HERE / f"{name}.yaml"
    if not path.is_file():
        raise FileNotFoundError(f"there is no study {name}: allowed are a file and "
                                + ", ".join(sorted(one.stem for one in HERE.glob("*.yaml"))))
    more = "".join(f"_{'_'.join(words)}" for words in arguments.var)  # so that runs are not overwritten
    out = (arguments.out or workflow.results_folder() / f"{path.stem}{more}").resolve()
    path = _with_variables(path, arguments.var, out)
    table = study.read_study(path)
    print("\n".join(f"{group}: {len(rows)} runs" for group, rows in table.groupby("group", sort=False)), flush=True)
    if arguments.plan:
        return
    if not arguments.report:
        workflow.run_study(path, HERE, out, workflow.find_lmp(arguments.lmp), arguments.cores,
                           more=arguments.snakemake)
    runs, curves = results.tidy(table, out, HERE)
    runs.to_csv(out / "runs.csv", float_format="%.6g")
    curves.to_csv(out / "curves.csv.gz", index=False, float_format="%.6g")
    from analysis import summary  # Matplotlib is not needed to run
    print(f"\n{summary.write(runs, curves, out)}\nTables and figures: {out}")


def _with_variables(path: Path, given: List[List[str]], out: Path) -> Path:
    """The study file, or one beside the runs where variables are given."""
    if not given:
        return path
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    for name, *values in given:
        if not values:
            raise ValueError(f"--var {name} has no value")
        content.setdefault("common", {})[name] = [list(values)] if len(values) > 1 else values[0]
    out.mkdir(parents=True, exist_ok=True)
    made = out / "study.yaml"
    text = yaml.safe_dump(content, sort_keys=False)
    if not made.is_file() or made.read_text(encoding="utf-8") != text:
        made.write_text(text, encoding="utf-8")
    return made


def main(words: Optional[Sequence[str]] = None) -> int:
    arguments = parse_arguments(words)
    try:
        run(arguments)
    except KeyboardInterrupt:
        print("\nStopped. Finished runs are kept: the same call goes on from there.", file=sys.stderr)
        return 130
    except subprocess.CalledProcessError:
        print("run_study.py: a run failed, see above", file=sys.stderr)
        return 1
    except (OSError, RuntimeError, ValueError) as error:
        print(f"run_study.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-2.0-only
"""The contact law alone: time of one evaluation, and the operations and bytes that it needs."""
from __future__ import annotations

import csv
import io
import json
import subprocess
from pathlib import Path
from typing import Dict, List, Mapping, Sequence, Tuple

from . import plots
from .lammps import Program, bind
from .output import text_table
from .statistics import median

LAWS = ("plateau", "linear", "linear 1.5")
ROLLING = ("none", "constant", "sds")
BRANCHES = ("loading", "unloading", "adhesive", "sliding", "mixed")
OPERATIONS = ("additions", "multiplications", "divisions", "roots", "powers", "comparisons")

# What a driver does for a contact before and after the law, counted by hand from
# body.h and the pair style's loop: (additions, multiplications, divisions, roots).
DRIVER: Sequence[Tuple[str, Tuple[int, int, int, int]]] = (
    ("offset, squared distance, reach", (6, 4, 0, 0)),
    ("distance, overlap, normal", (1, 3, 1, 1)),
    ("effective mass", (1, 1, 1, 0)),
    ("relative velocity", (3, 0, 0, 0)),
    ("lever arms, spin", (5, 8, 0, 0)),
    ("forces on i and j", (6, 0, 0, 0)),
    ("turn and twist", (10, 14, 0, 0)),
    ("torques on i and j", (6, 0, 0, 0)),
)
DRIVER_ROLLING: Sequence[Tuple[str, Tuple[int, int, int, int]]] = (
    ("relative angular velocity", (3, 0, 0, 0)),
    ("effective radius", (1, 1, 1, 0)),
)


def driver_operations(rolling: str) -> Dict[str, float]:
    rows = [counts for _, counts in (*DRIVER, *(DRIVER_ROLLING if rolling != "none" else ()))]
    return dict(zip(OPERATIONS, (float(sum(column)) for column in zip(*rows))))


def contact_bytes(rolling: str, context: Mapping[str, str]) -> Tuple[int, int]:
    """Bytes of LAMMPS's arrays that are read and written for a contact: those of the partner and of
    the pair. Bytes of the particle itself are shared by all its contacts and left out.

    :param context: of bench_kernel, which knows how long the history is
    """
    number, integer = 8, 4
    history = number * int(context["history_doubles_sds" if rolling == "sds"
                                   else "history_doubles"])
    force_and_torque = 6 * number
    read = (2 * integer                # neighbour's index, status
            + 3 * number + number      # position, radius
            + 6 * number + number      # velocity, angular velocity, mass
            + integer                  # type
            + history + force_and_torque)
    written = integer + history + force_and_torque
    return read, written


def measure(program: Program, build: Path, repetitions: int,
            min_time: float) -> Tuple[List[Dict], Dict[str, str]]:
    """Every repetition of every benchmark, in random order, and what the program says of itself."""
    words = [str(build / "bench_kernel"), f"--benchmark_repetitions={repetitions}",
             "--benchmark_enable_random_interleaving=true", f"--benchmark_min_time={min_time}",
             "--benchmark_format=json"]
    with subprocess.Popen(words, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL) as process:
        if program.bind:
            bind(process)
        text = process.communicate()[0]
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, words)
    said = json.loads(text)
    return read_benchmarks(said["benchmarks"]), said["context"]


def read_benchmarks(entries: Sequence[Mapping]) -> List[Dict]:
    """:raise ValueError: if a benchmark says that it failed"""
    rows = []
    for entry in entries:
        if entry.get("error_occurred"):
            raise ValueError(f"{entry['name']}: {entry['error_message']}")
        if entry.get("run_type") == "aggregate":
            continue
        law, branch, rolling, place = entry["run_name"].split("/")
        rows.append({"law": law, "branch": branch, "rolling": rolling, "place": place,
                     "round": entry.get("repetition_index", 0), "contacts": entry["contacts"],
                     "ns": entry["cpu_time"] / entry["contacts"]})
    return rows


def count_operations(build: Path) -> List[Dict]:
    done = subprocess.run([str(build / "count_operations")], check=True, text=True,
                          stdout=subprocess.PIPE)
    return [{**row, **{name: float(row[name]) for name in OPERATIONS}}
            for row in csv.DictReader(io.StringIO(done.stdout))]


def _medians(rows: Sequence[Dict]) -> Dict[Tuple[str, str, str, str], float]:
    values: Dict[Tuple[str, str, str, str], List[float]] = {}
    for row in rows:
        key = (row["law"], row["rolling"], row["branch"], row["place"])
        values.setdefault(key, []).append(row["ns"])
    return {key: median(some).value for key, some in values.items()}


def _models() -> List[Tuple[str, str]]:
    return [(law, rolling) for law in LAWS for rolling in ROLLING]


def _ways(rows: Sequence[Dict]) -> List[str]:
    """One by one; side by side where the compiler has lanes."""
    places = {row["place"] for row in rows}
    return [way for way in ("one", "lanes") if way in places]


def table(rows: Sequence[Dict], operations: Sequence[Dict], context: Mapping[str, str]) -> str:
    ns = _medians(rows)
    ways = _ways(rows)
    lines = []
    for way in ways:
        for law, rolling in _models():
            lines.append([f"{law}, {rolling}, {way}"]
                         + [f"{ns[law, rolling, branch, way]:.1f}" for branch in BRANCHES]
                         + [f"{ns[law, rolling, 'mixed', f'{way}, memory']:.1f}"])
    text = text_table(("law, rolling: ns a contact", *BRANCHES, "from memory"), lines)

    lines = []
    for law, rolling in _models():
        own = next(row for row in operations
                   if (row["law"], row["rolling"], row["branch"]) == (law, rolling, "mixed"))
        flops = sum(own[name] for name in OPERATIONS if name != "comparisons")
        around = sum(driver_operations(rolling).values())
        read, written = contact_bytes(rolling, context)
        lines.append([f"{law}, {rolling}"] + [f"{own[name]:.1f}" for name in OPERATIONS]
                     + [f"{flops:.0f}"]
                     + [f"{flops / ns[law, rolling, 'mixed', way]:.1f}" for way in ways]
                     + [f"{around:.0f}", str(read), str(written)])
    text += "\n" + text_table(
        ("mixed contacts need", "add", "multiply", "divide", "root", "power", "compare", "flop",
         *(f"flop/ns {way}" for way in ways), "driver's flop", "bytes read", "written"), lines)
    if "lanes" in ways:
        text += f"\nOne by one, and {context['lanes']} side by side in lanes. "
    else:
        text += "\nOne by one; this compiler has no lanes. "
    return text + (
        "Median of the repetitions. Mixed: 60% loading, 25%\nunloading, 5% adhesive, 10% sliding, "
        "in random order. Operations are counted while the kernel runs one\nby one; flop is all "
        "but comparisons. The driver's are gathering and scattering, by hand. Bytes are those\nof "
        "LAMMPS's arrays for the partner and the pair.\n")


def plot(rows: Sequence[Dict], path: Path) -> None:
    ns = _medians(rows)
    titles = {"one": "one by one", "lanes": "side by side, in lanes"}
    plots.bars([f"{law}\n{rolling}" for law, rolling in _models()], BRANCHES,
               {titles[way]: {branch: [ns[law, rolling, branch, way] for law, rolling in _models()]
                              for branch in BRANCHES} for way in _ways(rows)},
               "ns a contact", path)

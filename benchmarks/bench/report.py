# SPDX-License-Identifier: GPL-2.0-only
"""One page of all measurements, each part with the machine that it was measured on."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Dict, List, Mapping

MACHINE = "machine.json"


def write_part(results: Path, name: str, text: str, description: Mapping[str, object]) -> None:
    """A part's table. machine.json keeps machine and date for each part, since parts can be run again
    one by one."""
    (results / f"{name}.txt").write_text(text, encoding="utf-8")
    machines = read_machines(results)
    machines[name] = dict(description)
    (results / MACHINE).write_text(json.dumps(machines, indent=2) + "\n", encoding="utf-8")


def read_machines(results: Path) -> Dict[str, Dict[str, object]]:
    try:
        return json.loads((results / MACHINE).read_text(encoding="utf-8"))
    except (FileNotFoundError, json.JSONDecodeError):
        return {}


def write_report(results: Path, titles: Mapping[str, str]) -> None:
    """report.md, of every part that has a table in the folder.

    :param titles: of the parts, in their order
    """
    machines = read_machines(results)
    lines: List[str] = ["# Measured", ""]
    shown: Dict[str, object] = {}
    for name, title in titles.items():
        table = results / f"{name}.txt"
        if name not in machines or not table.is_file():
            continue
        lines += [f"## {name}: {title}", ""]
        machine = machines[name]
        # do not repeat what is the same as in the part before
        news = {key: value for key, value in machine.items() if shown.get(key) != value}
        shown = machine
        lines += [f"- {key}: {_plain(value)}" for key, value in news.items() if value]
        lines += ["", "```", table.read_text(encoding="utf-8").rstrip(), "```", ""]
        if (results / f"{name}.png").is_file():
            lines += [f"![{title}]({name}.png)", ""]
    (results / "report.md").write_text("\n".join(lines), encoding="utf-8")


def _plain(value: object) -> str:
    return " ".join(map(str, value)) if isinstance(value, list) else str(value)

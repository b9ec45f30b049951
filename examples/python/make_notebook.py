#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Makes compress.ipynb of compress.py: each part of the script becomes a cell.

    ./make_notebook.py [script] [notebook]

A line `# %%` begins a part of code, `# %% [markdown]` one of text in comments.
"""
from __future__ import annotations

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def parts(script: str) -> list[tuple[str, str]]:
    """(kind, text) of each part, kind being "code" or "markdown". What stands before the first part is left out."""
    found: list[tuple[str, list[str]]] = []
    for line in script.splitlines():
        if line in ("# %%", "# %% [markdown]"):
            found.append(("code" if line == "# %%" else "markdown", []))
        elif found:
            kind, lines = found[-1]
            if kind == "markdown" and not line.startswith("#"):
                if line:
                    raise ValueError(f"a part of text has the line {line!r}, which is no comment")
                continue
            lines.append(line[1:].removeprefix(" ") if kind == "markdown" else line)
    return [(kind, "\n".join(lines).strip()) for kind, lines in found]


def notebook(script: str) -> dict:
    cells = []
    for number, (kind, text) in enumerate(parts(script)):
        cell = {"cell_type": kind, "id": f"part-{number}", "metadata": {},
                "source": text.splitlines(keepends=True)}
        if kind == "code":
            cell.update(execution_count=None, outputs=[])
        cells.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
            "nbformat": 4, "nbformat_minor": 5}


def main(arguments: list[str]) -> int:
    if len(arguments) not in (0, 2):
        print(__doc__, file=sys.stderr)
        return 2
    script, target = map(Path, arguments or (HERE / "compress.py", HERE / "compress.ipynb"))
    text = json.dumps(notebook(script.read_text(encoding="utf-8")), indent=1, ensure_ascii=False)
    target.write_text(text + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

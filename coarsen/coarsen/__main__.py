# SPDX-License-Identifier: GPL-2.0-only
"""coarsen: how coarse may the particles of a simulation be?"""
from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Optional, Sequence

from . import calibrate_command, check_command, plan_command, report_command, run_command
from .options import Parser


def version() -> str:
    """That of the project, from its file VERSION, which stands in the same place in an installation."""
    return (Path(__file__).resolve().parents[2] / "VERSION").read_text(encoding="utf-8").strip()


def main(words: Optional[Sequence[str]] = None) -> int:
    """:return: exit status: 0, that of the command, or 1 after an error that a user can correct"""
    parser = Parser(prog="coarsen", description=__doc__)
    parser.add_argument("--version", action="version", version=f"coarsen of eepa {version()}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for command in (plan_command, check_command, calibrate_command, run_command,
                    report_command):
        command.add(commands)
    arguments = parser.parse_args(words)
    try:
        return arguments.work(arguments)
    except KeyboardInterrupt:
        print("\nStopped. Finished runs are kept: the same call goes on from there.", file=sys.stderr)
        return 130
    except subprocess.CalledProcessError as error:
        print(f"coarsen {arguments.command}: a run failed, see above; {error.cmd[0]} ended with status "
              f"{error.returncode}", file=sys.stderr)
        return 1
    except (OSError, RuntimeError, ValueError, ImportError) as error:
        print(f"coarsen {arguments.command}: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())

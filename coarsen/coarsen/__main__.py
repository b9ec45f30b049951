# SPDX-License-Identifier: GPL-2.0-only
"""coarsen: how coarse may the particles of a simulation be?"""
from __future__ import annotations

import argparse
import re
import subprocess
import sys
from typing import List, Optional, Sequence

from . import calibrate_command, check_command, plan_command, report_command, run_command

_NEGATIVE = re.compile(r"^-(\d+\.?\d*|\.\d+)e[+-]?\d+$", re.IGNORECASE)


def main(words: Optional[Sequence[str]] = None) -> int:
    """:return: exit status: 0, that of the command, or 1 after an error that a user can correct"""
    parser = argparse.ArgumentParser(prog="coarsen", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for command in (plan_command, check_command, calibrate_command, run_command,
                    report_command):
        command.add(commands)
    arguments = parser.parse_args(_with_negative_numbers(sys.argv[1:] if words is None else words))
    try:
        return arguments.work(arguments)
    except KeyboardInterrupt:
        print("\nStopped. Finished runs are kept: the same call goes on from there.", file=sys.stderr)
        return 130
    except subprocess.CalledProcessError as error:
        print(f"coarsen {arguments.command}: a run failed, see above; {error.cmd[0]} ended with status "
              f"{error.returncode}", file=sys.stderr)
        return 1
    except (OSError, RuntimeError, ValueError) as error:
        print(f"coarsen {arguments.command}: {error}", file=sys.stderr)
        return 1


def _with_negative_numbers(words: Sequence[str]) -> List[str]:
    """argparse takes -1e-7 for an option: it is joined to the option before it."""
    made: List[str] = []
    for word in words:
        if _NEGATIVE.match(word) and made and made[-1].startswith("--") and "=" not in made[-1]:
            made[-1] += f"={word}"
        else:
            made.append(word)
    return made


if __name__ == "__main__":
    sys.exit(main())

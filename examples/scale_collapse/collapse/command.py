# SPDX-License-Identifier: GPL-2.0-only
"""Exit status of the programs of this folder."""
from __future__ import annotations

import sys
from typing import Callable, Type

from .curves import BadCurve
from .runs import RunFailed


def exit_status(program: str, work: Callable[[], object], *errors: Type[Exception]) -> int:
    """Does the work. An error that a user can correct, `errors` too, ends in one line without traceback.

    :return: 0, 1 after an error, 130 when stopped
    """
    try:
        work()
    except KeyboardInterrupt:
        print("\nStopped. What is finished is kept: the same call goes on from there.")
        return 130
    except (RunFailed, BadCurve, OSError, *errors) as error:
        print(f"\n{program}: {error}", file=sys.stderr)
        return 1
    return 0

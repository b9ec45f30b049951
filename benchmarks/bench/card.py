# SPDX-License-Identifier: GPL-2.0-only
"""What NVIDIA's nvidia-smi says of a card while a program runs on it: its power and the memory in use."""
from __future__ import annotations

import os
import re
import statistics
import subprocess
import tempfile
from datetime import datetime
from types import TracebackType
from typing import List, Optional, Tuple, Type

_COMMAND = "nvidia-smi"
#: A program's line with the time at which its timed part has ended: seconds of the epoch.
#: It may be in the midst of another: LAMMPS's own output is buffered.
_CLOCK = re.compile(r"Clock (\d+\.\d+)")
#: Of the fields that tell a card's power the one of this moment, where a driver has it.
_POWERS = ("power.draw.instant", "power.draw")
SETTLING = 1.0    #: s

Sample = Tuple[float, float, float]    #: time (s of the epoch), power (W), memory in use (MiB)


def names() -> str:
    """Names and drivers of all cards; "" where there are none."""
    try:
        said = subprocess.run([_COMMAND, "--query-gpu=name,driver_version", "--format=csv,noheader"],
                              capture_output=True, text=True, check=True, timeout=60).stdout
    except (OSError, subprocess.SubprocessError):
        return ""
    return "; ".join(line.strip() for line in said.splitlines() if line.strip())


def read_samples(text: str) -> List[Sample]:
    """The lines of `nvidia-smi --query-gpu=timestamp,power.draw,memory.used --format=csv,noheader,nounits`; those
    without numbers, as of a card that does not tell its power, are left out."""
    samples = []
    for line in text.splitlines():
        words = [word.strip() for word in line.split(",")]
        try:
            when = datetime.strptime(words[0], "%Y/%m/%d %H:%M:%S.%f").timestamp()
            samples.append((when, float(words[1]), float(words[2])))
        except (ValueError, IndexError):
            continue    # also the line that was being written at the end
    return samples


def energy_and_memory(before: List[Sample], samples: List[Sample], screen: str,
                      loop: float) -> Tuple[Optional[float], Optional[float]]:
    """Energy of the timed part (J) and the memory in use at its end beyond that before the program (bytes). A card's
    power may be the mean of a second, so that the first of the timed part does not count.

    :param before: samples from before the program
    :param screen: what the program wrote, with its last line `Clock`
    :param loop: length of the timed part, s
    """
    clocks = _CLOCK.findall(screen)
    if not clocks:
        return None, None
    end = float(clocks[-1])
    timed = [sample for sample in samples if end - loop + SETTLING <= sample[0] <= end]
    if not timed:
        return None, None
    memory = 2.0**20 * (max(m for _, _, m in timed) - before[-1][2]) if before else None
    return statistics.fmean(power for _, power, _ in timed) * loop, memory


class Watch:
    """Samples a card, every 100 ms, from `with` to its end."""

    def __init__(self) -> None:
        self.before: List[Sample] = []     #: samples from before
        self.samples: List[Sample] = []    #: and meanwhile
        self._file = tempfile.TemporaryFile("w+", encoding="utf-8")
        self._process: Optional[subprocess.Popen] = None

    def __enter__(self) -> "Watch":
        for power in _POWERS:
            query = _query(power)
            try:
                said = subprocess.run(query, capture_output=True, text=True, check=True, timeout=60).stdout
            except (OSError, subprocess.SubprocessError):
                continue    # there is no card, or a driver that does not know this field
            self.before = read_samples(said)
            if self.before:
                # to a file, because nobody reads a pipe meanwhile; line by line, or its end would be lost
                self._process = subprocess.Popen(["stdbuf", "-oL", *query, "-lms", "100"], stdin=subprocess.DEVNULL, stdout=self._file,
                                                 stderr=subprocess.DEVNULL)
                break
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        if self._process is not None:
            self._process.terminate()
            self._process.wait()
            self._file.seek(0)
            self.samples = read_samples(self._file.read())
        self._file.close()


def _query(power: str) -> List[str]:
    # the card that a program gets that asks for one
    card = os.environ.get("CUDA_VISIBLE_DEVICES", "0").split(",")[0]
    return [_COMMAND, "-i", card, f"--query-gpu=timestamp,{power},memory.used", "--format=csv,noheader,nounits"]

# SPDX-License-Identifier: GPL-2.0-only
"""Shows the progress of the study: present run, step, time left."""
from __future__ import annotations

import shutil
import sys
import time
from typing import Dict, List, Mapping, Optional, Sequence, TextIO, Tuple

from .cases import Case
from .logs import LogSummary


class Progress:
    """One line that is written over and over on a terminal; now and then a line elsewhere."""

    def __init__(self, cases: Sequence[Case], jobs: int, stream: Optional[TextIO] = None,
                 seconds_between_lines: float = 15.0) -> None:
        self._cases = list(cases)
        self._jobs = max(1, jobs)
        self._stream = stream or sys.stdout
        self._terminal = self._stream.isatty()
        self._interval = 0.5 if self._terminal else seconds_between_lines
        self._shown = time.monotonic()
        self._started = time.monotonic()
        self._finished: Dict[Case, int] = {}
        # Ratio of the actual time of runs like this one to the estimate.
        self._correction: Dict[Tuple, List[float]] = {}
        self._work_before = 0.0

    def kept(self, case: Case, summary: LogSummary) -> None:
        """A run of an earlier call is taken over."""
        self._count(case, summary)
        self._work_before += self._work(case)

    def begin(self) -> None:
        """After the last kept() and before the first run."""
        if self._finished:
            self._line(f"{self._position()} by an earlier call, and taken over")

    def done(self, case: Case, summary: LogSummary) -> None:
        self._count(case, summary)
        loop = sum(stage.seconds for stage in summary.stages.values())
        self._line(f"{self._position()} {case.name}: {self._finished[case]} steps of "
                   f"{summary.particles} particles, {loop:.1f} s")

    def show(self, running: Mapping[Case, LogSummary]) -> None:
        """Called often; writes when it is time."""
        now = time.monotonic()
        if now - self._shown < self._interval or not running:
            return
        self._shown = now
        parts = [f"{case.name} {summary.current} {summary.step} of about {self.steps(case)} steps"
                 for case, summary in running.items()]
        left = self.seconds_left(running, now - self._started)
        text = f"{self._position()} {left} | " + "; ".join(parts)
        if self._terminal:
            width = shutil.get_terminal_size().columns - 1
            self._stream.write("\r\x1b[K" + text[:width])
            self._stream.flush()
        else:
            self._line(text)

    def close(self) -> None:
        if self._terminal:
            self._stream.write("\r\x1b[K")
            self._stream.flush()

    def steps(self, case: Case) -> int:
        """Steps of a run: what it took if it is finished, else foreseen from runs like it."""
        if case in self._finished:
            return self._finished[case]
        ratios = self._correction.get(case.kind) or [
            ratio for some in self._correction.values() for ratio in some] or [1.0]
        return round(case.expected_steps() * sum(ratios) / len(ratios))

    def seconds_left(self, running: Mapping[Case, LogSummary], elapsed: float) -> str:
        """Words for the time left over all runs."""
        done = sum(self._work(case) for case in self._finished) - self._work_before
        rest = []
        for case in self._cases:
            if case in self._finished:
                continue
            work = self._work(case)
            if case in running:
                share = min(running[case].step / max(1, self.steps(case)), 0.99)
                done += share * work
                work *= 1.0 - share
            rest.append(work)
        if done <= 0.0 or elapsed < 3.0:
            return "time left not known yet"
        # The time left is at least that of each run, for any number of jobs.
        width = min(self._jobs, max(1, len(rest)))
        per_job = done / (elapsed * min(self._jobs, len(self._finished) + len(running)))
        seconds = max(sum(rest) / width, max(rest, default=0.0)) / per_job
        return f"about {in_words(seconds)} left"

    def _count(self, case: Case, summary: LogSummary) -> None:
        steps = sum(stage.steps for name, stage in summary.stages.items() if name != "place")
        self._finished[case] = steps
        self._correction.setdefault(case.kind, []).append(steps / case.expected_steps())

    def _work(self, case: Case) -> float:
        return float(case.particles * self.steps(case))

    def _position(self) -> str:
        return f"[{len(self._finished)} of {len(self._cases)} runs done]"

    def _line(self, text: str) -> None:
        if self._terminal:
            self._stream.write("\r\x1b[K")
        self._stream.write(text + "\n")
        self._stream.flush()


def in_words(seconds: float) -> str:
    """A time as one says it."""
    seconds = round(seconds)
    if seconds < 60:
        return f"{seconds} s"
    minutes, rest = divmod(seconds, 60)
    if minutes < 60:
        return f"{minutes} min {rest:02d} s"
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min"

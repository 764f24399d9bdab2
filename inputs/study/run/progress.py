# SPDX-License-Identifier: GPL-2.0-or-later
"""How far the runs are: one changing line on a terminal; elsewhere a line for each tenth of a long run, and its end."""

from __future__ import annotations

import shutil
import sys
import time
from dataclasses import dataclass
from typing import Sequence


@dataclass(frozen=True)
class Reached:
    """How far LIGGGHTS is in its `run` command, by its own estimate."""

    time: float  # simulated [s]
    elapsed: float  # [s]
    left: float  # [s]

    @property
    def percent(self) -> float:
        total = self.elapsed + self.left
        return 100.0 * self.elapsed / total if total > 0.0 else 0.0

    def __str__(self) -> str:
        return f"{self.percent:.0f} %, t = {self.time:.4g} s, {self.left:.0f} s left"


def reached(log: str) -> Reached | None:
    """From the last thermo line with the columns Time, CPU and CPULeft; None before the first."""
    header, found = [], None
    for line in log[: log.rfind("\n") + 1].splitlines():  # the last one may be half written
        words = line.split()
        if "Step" in words:
            header = words
        elif {"Time", "CPU", "CPULeft"} <= set(header) and len(words) == len(header):
            column = dict(zip(header, words))
            try:
                found = Reached(*(float(column[name]) for name in ("Time", "CPU", "CPULeft")))
            except ValueError:  # a message of as many words
                continue
    return found


class Progress:
    """Of `total` runs; a tenth of a run is told where runs are longer than ten times `brief` [s]."""

    def __init__(self, total: int, brief: float = 1.0):
        self.total = total
        self.brief = brief
        self.stream = sys.stderr
        self.terminal = self.stream.isatty()
        self.started = time.monotonic()
        self.told: dict[str, int] = {}  # tenths of each run

    def watch(self, done: int, running: Sequence) -> None:
        """`running` have a name and a log: how far each one is."""
        states = [(run.name, reached(run.log())) for run in running]
        if self.terminal:
            names = "; ".join(f"{name} {state}" if state else name for name, state in states)
            seconds = time.monotonic() - self.started
            line = f"{done}/{self.total} runs, {seconds:.0f} s: {names}"
            columns = shutil.get_terminal_size().columns
            self.stream.write("\r\033[K" + line[: columns - 1])
            self.stream.flush()
        else:
            self.tell(states)

    def tell(self, states: Sequence[tuple[str, Reached | None]]) -> None:
        """A line for each long run that has got one tenth further; the tenth itself is told at the end."""
        for name, state in states:
            if state is None or state.elapsed + state.left < 10.0 * self.brief:
                continue
            tenths = int(state.percent / 10.0)
            if self.told.get(name, 0) < tenths < 10:
                self.told[name] = tenths
                self.stream.write(f"{name}: {state}\n")
                self.stream.flush()

    def finished(self, done: int, run, failure: str | None) -> None:
        """One line for a run that ended; on a terminal only if it failed."""
        if self.terminal:
            self.stream.write("\r\033[K")
        if failure:
            self.stream.write(f"{run.name}: {failure}\n")
        elif not self.terminal:
            self.stream.write(f"{done}/{self.total} {run.name} {run.seconds:.1f} s\n")
        self.stream.flush()

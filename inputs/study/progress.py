# SPDX-License-Identifier: GPL-2.0-or-later
"""How far the runs are: one changing line on a terminal, a line for each run elsewhere."""

from __future__ import annotations

import shutil
import sys
import time
from typing import Sequence


class Progress:
    def __init__(self, total: int):
        self.total = total
        self.stream = sys.stderr
        self.terminal = self.stream.isatty()
        self.started = time.monotonic()

    def watch(self, done: int, running: Sequence) -> None:
        """The line on a terminal: runs done, seconds so far, what runs now."""
        if self.terminal:
            names = ", ".join(run.name for run in running)
            seconds = time.monotonic() - self.started
            line = f"{done}/{self.total} runs, {seconds:.0f} s: {names}"
            columns = shutil.get_terminal_size().columns
            self.stream.write("\r\033[K" + line[: columns - 1])
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

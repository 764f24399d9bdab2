# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of a summary with a bound on one side."""

from __future__ import annotations

from dataclasses import dataclass

from study.run.summary import Row


@dataclass(frozen=True)
class AtLeast(Row):
    """A row that passes from its reference upwards."""

    tolerance: float = 0.0

    @property
    def passes(self) -> bool | None:
        return None if self.reference is None else bool(self.value >= self.reference)


@dataclass(frozen=True)
class AtMost(Row):
    """A row that passes up to its reference."""

    tolerance: float = 0.0

    @property
    def passes(self) -> bool | None:
        return None if self.reference is None else bool(self.value <= self.reference)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of a study: one quantity of one case beside its reference."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence


@dataclass(frozen=True)
class Row:
    """A value in SI units; without a reference it is information only."""

    case: str
    quantity: str
    value: float
    unit: str
    reference: float | None = None
    tolerance: float | None = None
    note: str = ""  # for the printed table
    of: Sequence[str] = ()  # the cases whose runs it was worked out from; (): `case` alone

    @property
    def error(self) -> float | None:
        """value/reference - 1; the value itself where the reference is 0."""
        if self.reference is None:
            return None
        return self.value if self.reference == 0.0 else self.value / self.reference - 1.0

    @property
    def passes(self) -> bool | None:
        """|error| <= tolerance (never, for a value that is no number); None without a reference."""
        return None if self.reference is None else bool(abs(self.error) <= self.tolerance)

    def as_dict(self) -> dict:
        return {
            "case": self.case,
            "quantity": self.quantity,
            "value": finite(self.value),
            "unit": self.unit,
            "reference": self.reference,
            "error": finite(self.error),
            "tolerance": None if self.reference is None else self.tolerance,
            "pass": self.passes,
            "of": list(self.of or [self.case]),
        }


def finite(x: float | None) -> float | None:
    """JSON knows no NaN and no infinity."""
    return None if x is None or x - x != 0.0 else float(x)


def read_json(path: Path) -> list[dict]:
    """The rows of a summary.json; none of a file that is missing, or is none of ours."""
    try:
        rows = json.loads(path.read_text(encoding="utf-8"))["rows"]
        return [row for row in rows if isinstance(row["case"], str) and isinstance(row["of"], list)]
    except (FileNotFoundError, ValueError, KeyError, TypeError):
        return []


def write_json(path: Path, deck: str, rows: Sequence[Row | dict]) -> None:
    """Writes summary.json as a whole or not at all; rows of an earlier one are dicts."""
    summary = {"deck": deck, "rows": [row if isinstance(row, dict) else row.as_dict() for row in rows]}
    text = json.dumps(summary, indent=1, allow_nan=False)
    partial = path.with_name(path.name + ".partial")
    partial.write_text(text + "\n", encoding="utf-8")
    os.replace(partial, path)


def table(rows: Sequence[Row]) -> str:
    """The rows as text, one line each; errors in percent, absolute ones as they are."""
    cells = [["case", "quantity", "value", "unit", "reference", "error", "tolerance", ""]]
    previous = None
    for row in rows:
        verdict = {True: "ok", False: "FAIL", None: ""}[row.passes]
        reference = "" if row.reference is None else f"{row.reference:.7g}"
        error = "" if row.error is None else shown(row.error, row.reference, "+")
        tolerance = "" if row.error is None else shown(row.tolerance, row.reference, "")
        name = row.case if row.case != previous else ""
        value = f"{row.value:.7g}"
        end = verdict if verdict else row.note
        cells.append([name, row.quantity, value, row.unit, reference, error, tolerance, end])
        previous = row.case
    widths = [max(len(line[i]) for line in cells) for i in range(len(cells[0]))]
    align = [str.ljust, str.ljust, str.rjust, str.ljust, str.rjust, str.rjust, str.rjust, str.ljust]
    lines = ("  ".join(a(c, w) for a, c, w in zip(align, line, widths)) for line in cells)
    return "\n".join(line.rstrip() for line in lines)


def shown(x: float, reference: float, sign: str) -> str:
    """An error or tolerance: relative ones in percent."""
    return f"{x:{sign}.1e}" if reference == 0.0 else f"{100.0 * x:{sign}.4f} %"

# SPDX-License-Identifier: GPL-2.0-or-later
"""Words of the command line that name nothing."""

from __future__ import annotations

import difflib
from typing import Iterable


class UsageError(Exception):
    """What the user typed cannot be done."""


def one_of(kind: str, word: str, names: Iterable[str]) -> str:
    """`word` if it is a name, else UsageError with the nearest name and the list."""
    names = list(names)
    if word in names:
        return word
    near = difflib.get_close_matches(word, names, n=1)
    hint = f"; did you mean '{near[0]}'?" if near else "."
    raise UsageError(f"no {kind} '{word}'{hint} There are: {', '.join(names)}")

# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck's study: its cases, the variables each one sets, and what a run left behind."""

from __future__ import annotations

import importlib.util
import re
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Callable, Mapping, Sequence

import numpy as np
import yaml

from study.run.summary import Row
from study.run.usage import UsageError

Values = Mapping[str, "float | str"]


@dataclass(frozen=True)
class Case:
    """One named run of a deck and what is read from it."""

    name: str
    deck: str  # the in.* file
    rows: Callable[["Result"], "list[Row]"]
    variables: Mapping[str, float | str] = field(default_factory=dict)  # -var of the deck, SI
    steps: Callable[[Values], int] | None = None  # how long to run; None: as the deck says
    files: Callable[[Values], Mapping[str, str]] | None = None  # name -> text, beside the deck
    after: str = ""  # a case that must have run; the files it leaves are put beside the deck
    leaves: Sequence[str] = ("*.restart",)  # patterns of files for the cases after this one
    ranks: int | None = None  # of MPI; None: as the user says
    keep: Sequence[str] = ()  # patterns of further files that are kept, in out/<deck>/<case>/
    on_request: bool = False  # runs only if --case names it


@dataclass(frozen=True)
class Figure:
    """A picture of some cases: draw(path, {case name: Result})."""

    file: str
    cases: Sequence[str]
    draw: Callable[[Path, Mapping[str, "Result"]], None]


@dataclass(frozen=True)
class Comparison:
    """Rows that need the results of several cases: rows({case name: Result})."""

    cases: Sequence[str]
    rows: Callable[[Mapping[str, "Result"]], "list[Row]"]


@dataclass(frozen=True)
class Study:
    cases: Sequence[Case]
    figures: Sequence[Figure]
    comparisons: Sequence[Comparison] = ()
    ranks: int = 1  # of MPI, of each run, if neither case nor user say otherwise


@dataclass(frozen=True)
class Result:
    """A finished run: the deck's variables as run, and which of them the user changed."""

    case: str
    values: Values
    changed: frozenset[str]
    folder: Path

    @cached_property
    def force(self) -> np.ndarray:
        """Columns t, F, overlap, plate_displacement (SI)."""
        return read_csv(self.folder / "contact_force.csv")

    @cached_property
    def state(self) -> np.ndarray:
        """The deck's further columns, at the same times."""
        return read_csv(self.folder / "state.csv")

    @property
    def as_published(self) -> bool:
        """Whether numbers computed elsewhere, for the case as it stands, may be references."""
        return not self.changed - {"steps"}


def read_csv(path: Path) -> np.ndarray:
    """A table with one header line; the columns by name."""
    return np.atleast_1d(np.genfromtxt(path, delimiter=",", names=True))


def index_variables(deck: Path) -> dict[str, str]:
    """`variable NAME index VALUE` lines of a deck: what -var can set, and the values without it."""
    pattern = re.compile(r"^\s*variable\s+(\w+)\s+index\s+(\S+)", re.MULTILINE)
    return dict(pattern.findall(deck.read_text(encoding="utf-8")))


def text(value: float | str) -> str:
    """A value as -var takes it; all digits of a number."""
    return value if isinstance(value, str) else repr(value)


def run_variables(
    case: Case, defaults: Mapping[str, str], user: Mapping[str, str]
) -> dict[str, str]:
    """The deck's index variables as they will be run: the user's word, the case's, the deck's."""
    own = {name: text(value) for name, value in case.variables.items()}
    values = {**defaults, **own, **{k: v for k, v in user.items() if k in defaults}}
    if case.steps and "steps" not in user:
        values["steps"] = str(contact_steps(case, values, user))
    return values


def contact_steps(case: Case, values: Mapping[str, str], user: Mapping[str, str]) -> int:
    """case.steps; UsageError if the user's values leave nothing to compute (V = 0, V = fast)."""
    try:
        steps = case.steps(numbers(values))
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        steps = 0
    if steps < 1:
        given = ", ".join(f"{name} = {value}" for name, value in user.items())
        raise UsageError(f"case '{case.name}' has no contact with {given}")
    return steps


def numbers(variables: Mapping[str, str]) -> dict[str, float | str]:
    """Numbers as floats, words as they are."""

    def convert(word: str) -> float | str:
        try:
            return float(word)
        except ValueError:
            return word

    return {name: convert(word) for name, word in variables.items()}


def material(model_file: Path) -> dict[str, float]:
    """The numbers of a model file's material (PyYAML takes 210.6e9 for a word)."""
    entries = yaml.safe_load(model_file.read_text(encoding="utf-8"))["material"]
    return {key: float(value) for key, value in entries.items() if key != "law"}


def load(folder: Path) -> Study:
    """The STUDY of a deck's folder."""
    spec = importlib.util.spec_from_file_location(f"{folder.name}_study", folder / "study.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.STUDY

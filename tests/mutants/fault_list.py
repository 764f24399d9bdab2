# SPDX-License-Identifier: GPL-2.0-or-later
"""The list of single-line faults: read from the YAML files beside this one, checked, and applied to a tree."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import yaml

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


class ListError(Exception):
    """An entry of the list that is wrong or no longer applies."""


@dataclass(frozen=True)
class Fault:
    """One fault: `find`, the `occurrence`-th in `file` (without a number it must stand there once), becomes `replace`."""

    name: str
    file: str
    find: str
    replace: str
    breaks: str  # what goes wrong in the product, a phrase
    tests: tuple[str, ...]  # regular expressions of ctest names; "name: Class.test" is one case of a Python test
    targets: tuple[str, ...]  # what these tests need built
    listed_in: str
    occurrence: int | None = None
    equivalent: str = ""  # why no test can tell it from the product
    text: str = field(default="", repr=False, compare=False)  # the entry, for the cache of results

    def where(self) -> str:
        return f"entry {self.name} in tests/mutants/{self.listed_in}"

    def place(self, source: str) -> int:
        """Where the anchor begins in the text of its file."""
        begins = [match.start() for match in re.finditer(re.escape(self.find), source)]
        if self.occurrence is not None and 0 < self.occurrence <= len(begins):
            return begins[self.occurrence - 1]
        if self.occurrence is None and len(begins) == 1:
            return begins[0]
        wanted = "once" if self.occurrence is None else f"{self.occurrence} times at least"
        raise ListError(
            f"{self.file}: the text {self.find!r} stands there {len(begins)} times, expected {wanted}; "
            f"adapt the {self.where()} or delete it"
        )

    def applied(self, source: str) -> str:
        """The text of the file with the fault in it."""
        at = self.place(source)
        return source[:at] + self.replace + source[at + len(self.find) :]


def words(value) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


def read_file(path: Path) -> list[Fault]:
    """The faults of one YAML file; `defaults` at its head holds keys that all its entries share."""
    known = set(Fault.__dataclass_fields__) - {"listed_in", "text"}
    data = yaml.safe_load(path.read_text())
    faults = []
    for given in data["faults"]:
        entry = {**data.get("defaults", {}), **given}
        label = f"entry {entry.get('name', '?')} in tests/mutants/{path.name}"
        if unknown := set(entry) - known:
            raise ListError(f"{label}: unknown keys {sorted(unknown)}, expected {sorted(known)}")
        if missing := known - set(entry) - {"occurrence", "equivalent"}:
            raise ListError(f"{label}: {sorted(missing)} missing")
        if entry["find"] == entry["replace"]:
            raise ListError(f"{label}: changes nothing")
        entry["tests"], entry["targets"] = words(entry["tests"]), words(entry["targets"])
        faults.append(Fault(**entry, listed_in=path.name, text=repr(sorted(entry.items()))))
    return faults


def read_all() -> list[Fault]:
    """All faults, in the order of their files; names must differ."""
    faults = [fault for path in sorted(HERE.glob("*.yaml")) for fault in read_file(path)]
    names = [fault.name for fault in faults]
    if twice := {name for name in names if names.count(name) > 1}:
        raise ListError(f"tests/mutants: names that stand twice: {sorted(twice)}")
    return faults


def select(faults: list[Fault], wanted: list[str]) -> list[Fault]:
    """Those named, or of the YAML files named; all if nothing is."""
    chosen = []
    for word in wanted:
        file = Path(word).name if word.endswith(".yaml") else word + ".yaml"
        found = [fault for fault in faults if fault.name == word or fault.listed_in == file]
        if not found:
            raise ListError(f"{word}: neither a fault nor a file of tests/mutants")
        chosen += [fault for fault in found if fault not in chosen]
    return chosen if wanted else faults

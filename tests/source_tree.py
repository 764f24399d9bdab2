# SPDX-License-Identifier: GPL-2.0-or-later
"""The tree as CMake and the compiler see it: targets, the files that each compiles, what files include and import.

The targets come from targets.json of the build (targets.cmake), whose path is in the environment: TARGETS=...
"""

from __future__ import annotations

import ast
import json
import os
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
INCLUDE_FOLDERS = (ROOT / "iga-solver", ROOT)  # of the product's own headers


@dataclass(frozen=True)
class Target:
    name: str
    folder: Path
    sources: frozenset[Path]
    links: frozenset[str]
    interface: frozenset[str]  # what is linked by whatever links this target


@cache
def targets() -> dict[str, Target]:
    """An object library is no target of its own but a part of those that take its objects."""
    entries = {entry["name"]: entry for entry in json.loads(Path(os.environ["TARGETS"]).read_text())}
    parts = set()
    for entry in entries.values():
        for part in re.findall(r"\$<TARGET_OBJECTS:([^>]+)>", " ".join(entry["sources"])):
            parts.add(part)
            entry["sources"] += entries[part]["sources"]
            entry["links"] += entries[part]["links"]
    return {name: target(entry) for name, entry in entries.items() if name not in parts}


def target(entry: dict) -> Target:
    """Links of which only the library itself knows ($<LINK_ONLY:...>) are in `links` alone."""
    folder = ROOT / entry["folder"]
    plain = {key: frozenset(word for word in entry[key] if "$<" not in word) for key in ("sources", "links", "interface")}
    sources = frozenset((folder / source).resolve() for source in plain["sources"])
    return Target(entry["name"], folder, sources, plain["links"], plain["interface"])


def headers_of(target: Target) -> set[str]:
    """The target and all whose headers it may include: what it links, and what comes with that."""
    return {target.name} | closure(target.links, lambda name: targets()[name].interface)


def program_of(target: Target) -> set[str]:
    """All that is linked with it, hidden or not."""
    return closure(target.links, lambda name: targets()[name].links)


def closure(names, further) -> set[str]:
    found, waiting = set(), list(names)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += further(name) if name in targets() else ()
    return found


@cache
def product() -> list[str]:
    """The top folders of the targets: all of the tree that is compiled, but the tests."""
    return sorted({target.folder.relative_to(ROOT).parts[0] for target in targets().values()})


@cache
def files(folder: str, *suffixes: str) -> list[Path]:
    return sorted(path for path in (ROOT / folder).rglob("*") if path.suffix in suffixes)


@cache
def product_files() -> list[Path]:
    return [path for folder in product() for path in files(folder, ".h", ".cpp")]


@cache
def owners(path: Path) -> frozenset[str]:
    """The targets that compile a source; of a header those of the source of its name, or of its folder's sources."""
    sources = {path.with_suffix(".cpp"), path}
    while True:
        found = frozenset(name for name, target in targets().items() if target.sources & sources)
        if found or path.suffix == ".cpp" or path == ROOT:
            return found
        path = path.parent
        sources = set(path.glob("*.cpp"))


@cache
def includes(path: Path) -> list[str]:
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(), flags=re.M)


@cache
def included_files(path: Path) -> dict[Path, str]:
    """The tree's own headers that a file includes, and by which words."""
    found = {}
    for name in includes(path):
        places = (folder / name for folder in (path.parent, *INCLUDE_FOLDERS))
        header = next((place.resolve() for place in places if place.is_file()), None)
        if header:
            found[header] = name
    return found


def compiled_with(source: Path) -> set[Path]:
    """The source and all headers of the tree that it sees."""
    found, waiting = set(), [source]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += included_files(path)
    return found


def imported_files(path: Path) -> set[Path]:
    """Python files of the tree that a file imports: beside it, in the folders above it, or under inputs/."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    folders = [path.parent, *path.parent.parents, ROOT / "inputs"]
    folders = [folder for folder in folders if ROOT in folder.parents]
    found = set()
    for name in names:
        places = (folder / (name.replace(".", "/") + ".py") for folder in folders)
        found |= {next((place for place in places if place.is_file()), path)}
    return found - {path}

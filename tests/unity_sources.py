# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: unity_sources.py [--recent] BUILD FOLDER...

What a build compiles of the project's FOLDERs, a file per line: unity files and single ones, each set of sources once
however often it is compiled (kernels are, for each instruction set).  --recent: of these as many as it takes to see each
file that has changed in the twelve hours up to the last commit, or since; all, if that cannot be known.
"""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RECENT = 12 * 3600  # [s]: more than the work takes that is checked as one
SETTINGS = ".clang-tidy"  # what is looked for


def sources(file: Path) -> tuple[str, ...]:
    """Those that a unity file includes; the file itself if it is none."""
    if "Unity" not in file.parts:
        return (str(file),)
    return tuple(line.split('"')[1] for line in file.read_text().splitlines() if line.startswith("#include"))


def output(*words: str | Path) -> str:
    return subprocess.run(words, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def recently_changed() -> set[str]:
    since = int(output("git", "log", "-1", "--format=%ct")) - RECENT
    names = output("git", "log", f"--since={since}", "--name-only", "--format=") + output("git", "diff", "HEAD", "--name-only")
    return set(names.split())


def included(build: Path) -> list[set[str]]:
    """All files that an object is made of, for each object that is built."""
    objects: list[set[str]] = []
    for line in output("ninja", "-C", build, "-t", "deps").splitlines():
        if ": #deps" in line:
            objects.append(set())
        elif line.strip():
            objects[-1].add(line.strip())
    return objects


def recent(units: dict[tuple[str, ...], Path], build: Path) -> set[Path]:
    """Those that show each file which has changed: a source's own, a header's one of those that include it."""
    try:
        changed = recently_changed()
        objects = included(build)
    except (OSError, ValueError, subprocess.CalledProcessError):
        return set(units.values())
    if SETTINGS in changed:
        return set(units.values())
    files = {f"{ROOT / name}" for name in changed}
    chosen = {file for compiled, file in units.items() if files.intersection(compiled)}
    headers = {file for file in files if file.endswith(".h") and Path(file).exists()}
    for header in sorted(headers):
        stem = header.removesuffix(".h") + ".cpp"
        seen_in = [file for compiled, file in units.items() if stem in compiled]
        seen_in += [file for file in units.values() if any(str(file) in o and header in o for o in objects)]
        if not seen_in and not objects:
            return set(units.values())
        if seen_in and not chosen.intersection(seen_in):
            chosen.add(seen_in[0])
    return chosen


def main() -> None:
    words = [word for word in sys.argv[1:] if word != "--recent"]
    build = Path(words[0]).resolve()
    folders = tuple(f"{ROOT / folder}/" for folder in words[1:])
    units: dict[tuple[str, ...], Path] = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = Path(entry["file"])
        compiled = sources(file)
        if all(source.startswith(folders) for source in compiled):
            units.setdefault(compiled, file)
    for file in sorted(recent(units, build) if "--recent" in sys.argv else units.values()):
        print(file)


if __name__ == "__main__":
    main()

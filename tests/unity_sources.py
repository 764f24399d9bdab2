# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: unity_sources.py BUILD FOLDER...

What a build compiles of the project's FOLDERs, a file per line: unity files and single ones, each set of sources once
however often it is compiled (kernels are, for each instruction set).
"""

import json
import sys
from pathlib import Path


def sources(file: Path) -> tuple[str, ...]:
    """Those that a unity file includes; the file itself if it is none."""
    if "Unity" not in file.parts:
        return (str(file),)
    return tuple(line.split('"')[1] for line in file.read_text().splitlines() if line.startswith("#include"))


def main() -> None:
    build, root = Path(sys.argv[1]).resolve(), Path(__file__).resolve().parents[1]
    folders = tuple(f"{root / folder}/" for folder in sys.argv[2:])
    units: dict[tuple[str, ...], Path] = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = Path(entry["file"])
        compiled = sources(file)
        if all(source.startswith(folders) for source in compiled):
            units.setdefault(compiled, file)
    print(*sorted(units.values()), sep="\n")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Folders of inputs/ whose benchmarks start their program themselves: benchmarks.py has PROGRAM, its name, BENCHMARKS, and
run(benchmark, program) -> rows."""

from __future__ import annotations

import importlib.util
import sys
from fnmatch import fnmatchcase
from pathlib import Path
from types import ModuleType
from typing import Sequence

from study.run.summary import Row, table, write_json
from study.run.usage import one_of


def load(folder: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(folder.name, folder / "benchmarks.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[folder.name] = module
    spec.loader.exec_module(module)
    return module


def run_all(module: ModuleType, wanted: Sequence[str], solver: Path, out: Path) -> bool:
    """Runs those that are wanted, all without any; prints them, and writes summary.json.  Whether all pass."""
    names = [benchmark.name for benchmark in module.BENCHMARKS]
    for pattern in wanted:
        if not any(fnmatchcase(name, pattern) for name in names):
            one_of("case", pattern, names)
    out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    for benchmark in module.BENCHMARKS:
        if wanted and not any(fnmatchcase(benchmark.name, pattern) for pattern in wanted):
            continue
        for row in module.run(benchmark, solver.resolve()):
            rows.append(row)
            print(table([row]).splitlines()[1], flush=True)
            if row.note:
                print(f"  {row.note}", flush=True)
        write_json(out / "summary.json", module.__name__, rows)
    print("\n" + table(rows))
    return not any(row.passes is False for row in rows)

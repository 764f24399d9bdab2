# SPDX-License-Identifier: GPL-2.0-or-later
"""Solids without particles beside closed forms and published numbers: each case is a model file that iga-solve is given.

usage: inputs/run structure_benchmarks [--case NAME] [--out DIR] [--solver IGA_SOLVE]
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bars  # noqa: E402  (files of this folder)
import beams  # noqa: E402
import large_strain  # noqa: E402
import motion  # noqa: E402
import plane  # noqa: E402
import plates  # noqa: E402
from solve import Benchmark, SolverError, iga_solve  # noqa: E402
from study.run.summary import Row  # noqa: E402

PROGRAM = "iga-solve"
BENCHMARKS = [
    benchmark
    for module in (plane, plates, beams, large_strain, bars, motion)
    for benchmark in module.BENCHMARKS
]  # fmt: skip


def run(benchmark: Benchmark, solver: Path) -> list[Row]:
    try:
        return benchmark.rows(iga_solve(solver))
    except SolverError as error:
        return [Row(benchmark.name, "iga-solve", math.nan, "", 1.0, 0.0, str(error))]

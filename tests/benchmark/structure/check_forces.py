# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: check_forces.py BENCHMARK_INTERNAL_FORCE
All that is timed gives the forces that the benchmark integrates on its own, on few elements of each body and degree."""

import sys
import tempfile
from pathlib import Path

from force_report import LARGEST_ERROR, LINEAR, ROTATING, run, timings

METHODS = ("plain", "auto", "stored", "recomputed", "auto_reduced", "auto_zou")
BODIES = ("plate", "distorted", "rational")

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        quick = ["--small", "--benchmark_repetitions=2", "--benchmark_min_time=0.001"]
        times = timings(run(sys.argv[1], Path(folder) / "raw.json", quick))
    found = {name: time.error for name, time in times.items() if name.startswith("force/")}
    expected = {
        f"force/{method}/{law}/{body}/p{p}"
        for method in METHODS
        for law in (LINEAR, ROTATING)
        for body in BODIES
        for p in (2, 3)
    }
    expected |= {f"force/{peer}/{LINEAR}/plate/p{p}" for peer in ("csr", "blocks", "blocks_huge_pages") for p in (2, 3)}
    missing = sorted(expected - found.keys())
    wrong = {name: error for name, error in found.items() if not error <= LARGEST_ERROR}
    if missing or wrong:
        sys.exit(f"not checked: {missing}; wrong, over the largest force: {wrong}")

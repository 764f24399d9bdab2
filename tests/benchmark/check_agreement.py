# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: check_agreement.py EXECUTABLE
All that is timed finds the exact feet: ours always, the others nearly always."""

import sys
import tempfile
from pathlib import Path

from report import ELEMENTS, SEARCHES, SURFACES, run, timings

EVERY_PEER = 0.99  # a peer that is set up wrongly finds few


def is_peer(name: str) -> bool:
    return name.split("/")[1] in ("opencascade", "simplex_brent")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        quick = ["--benchmark_repetitions=2", "--benchmark_min_time=0.001"]
        times = timings(run(sys.argv[1], Path(folder) / "raw.json", quick))
    found = {name: time.right for name, time in times.items() if time.right is not None}
    expected = {f"{search}/{s}/{n}" for search in SEARCHES for s in SURFACES for n in ELEMENTS}
    missing = sorted(expected - found.keys())
    wrong = {name: right for name, right in found.items() if right < (EVERY_PEER if is_peer(name) else 1.0)}
    if missing or wrong:
        sys.exit(f"not timed: {missing}; feet wrong (fraction right): {wrong}")

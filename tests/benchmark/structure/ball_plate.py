# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: ball_plate.py LIGGGHTS_NURBS OUT
The paper's Table 2 as its deck stands, 700 steps on one rank, beside the same case with the plain element loop: CPU time of
the whole program, set-up and output included.  Prints the table and writes OUT/summary.json; slow is no error."""

from __future__ import annotations

import shutil
import statistics
import sys
import tempfile
from pathlib import Path

from bounds import AtLeast, AtMost
from study.run.summary import Row, table, write_json
from wall import cpu_seconds

DECK = Path(__file__).resolve().parents[3] / "inputs" / "ball_plate"
# What is added to plate.yaml.
WAYS = {"plain": ""}
REPETITIONS = 3
LONGEST, SPEEDUP = 3.0, 7.0  # [s], [-]


def seconds(program: str, added: str) -> float:
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(DECK / "in.ball_plate", Path(folder) / "in.deck")
        text = (DECK / "plate.yaml").read_text(encoding="utf-8")
        (Path(folder) / "plate.yaml").write_text(text + added, encoding="utf-8")
        return cpu_seconds(program, folder)


def rows(times: dict[str, float]) -> list[Row]:
    case = "Table 2, 700 steps"
    result = [AtMost(case, f"{way}_time", time, "s", LONGEST if way == "auto" else None) for way, time in times.items()]
    if "auto" in times and "plain" in times:
        result.append(AtLeast(case, "speedup_over_plain", times["plain"] / times["auto"], "1", SPEEDUP))
    return result


def main(program: str, out: str) -> None:
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    taken = [{way: seconds(program, added) for way, added in WAYS.items()} for _ in range(REPETITIONS)]
    found = rows({way: statistics.median(times[way] for times in taken) for way in WAYS})
    write_json(folder / "summary.json", "ball_plate_time", found)
    print(table(found))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])

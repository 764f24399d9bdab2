# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's Table 2 as its deck stands, 700 steps on one rank, beside the same case with the plain element loop: CPU time of
the whole program, set-up and output included.  --study: all cases of the deck, as inputs/run ball_plate runs them.  Prints
the table and writes OUT/summary.json; slow is reported, never an error."""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from bounds import AtLeast, AtMost
from study.run.summary import Row, table, write_json
from wall import cpu_seconds

INPUTS = Path(__file__).resolve().parents[3] / "inputs"
DECK = INPUTS / "ball_plate"
# What is added to the model files.
WAYS = {"auto": "", "plain": "integration: {method: elements}\n"}
MASS = {"corrected_mass": "integration: {mass: corrected}\n"}
REPETITIONS = 3
LONGEST, SPEEDUP, STUDY_SPEEDUP, CORRECTED_MASS = 3.0, 7.0, 4.0, 1.3  # [s], [-], [-], [-]


def table2(program: str, added: str) -> float:
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(DECK / "in.ball_plate", Path(folder) / "in.deck")
        text = (DECK / "plate.yaml").read_text(encoding="utf-8")
        (Path(folder) / "plate.yaml").write_text(text + added, encoding="utf-8")
        return cpu_seconds(program, folder)


def study(program: str, added: str) -> float:
    """All cases, in a copy of the decks."""
    with tempfile.TemporaryDirectory() as folder:
        inputs = Path(folder) / "inputs"
        shutil.copytree(INPUTS, inputs)
        for model in (inputs / "ball_plate").glob("*.yaml"):
            model.write_text(model.read_text(encoding="utf-8") + added, encoding="utf-8")
        command = [sys.executable, "-B", "-m", "study.run.cli", "ball_plate", "--solver", program, "--jobs", "1"]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        environment = {**os.environ, "PYTHONPATH": str(inputs)}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        if done.returncode == 2:
            raise RuntimeError(done.stderr[-1500:])
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def rows(times: dict[str, float]) -> list[Row]:
    case = "Table 2, 700 steps"
    result = [AtMost(case, f"{way}_time", time, "s", LONGEST if way == "auto" else None) for way, time in times.items()]
    return [
        *result,
        AtLeast(case, "speedup_over_plain", times["plain"] / times["auto"], "1", SPEEDUP),
        AtMost(case, "corrected_mass_over_lumped", times["corrected_mass"] / times["auto"], "1", CORRECTED_MASS),
    ]


def study_rows(times: dict[str, float]) -> list[Row]:
    case = "all cases of ball_plate"
    result: list[Row] = [Row(case, f"{way}_time", time, "s") for way, time in times.items()]
    return [*result, AtLeast(case, "speedup_over_plain", times["plain"] / times["auto"], "1", STUDY_SPEEDUP)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="liggghts-nurbs")
    parser.add_argument("out", type=Path)
    parser.add_argument("--study", action="store_true", help="all cases, too: minutes")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    program = str(Path(args.program).resolve())
    taken = [{way: table2(program, added) for way, added in {**WAYS, **MASS}.items()} for _ in range(REPETITIONS)]
    found = rows({way: statistics.median(times[way] for times in taken) for way in taken[0]})
    if args.study:
        found += study_rows({way: study(program, added) for way, added in WAYS.items()})
    write_json(args.out / "summary.json", "ball_plate_time", found)
    print(table(found))


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-2.0-or-later
"""What a rank has to do when the plate of the deck ball_plate is cut (strong scaling: 1 and 2 ranks, with Jacobians recomputed
and stored) and when each rank gets as much of a larger plate (weak scaling: 1, 2, 4 and 8): CPU time outside MPI, messages,
bytes, and memory beyond that of a program with hardly a plate.  Prints the table and writes OUT/summary.json.  Slow is
reported, never an error."""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from bounds import AtLeast, AtMost
from study.run.summary import Row, table, write_json

DECK = Path(__file__).resolve().parents[3] / "inputs" / "ball_plate"
PLATE = (31, 31, 8)  # of the deck
PIECE = (32, 32, 8)  # of a rank
LARGE, TINY = (320, 320, 8), (4, 4, 4)  # for memory: a million control nodes, and hardly any
GRIDS = {1: (1, 1), 2: (2, 1), 4: (2, 2), 8: (4, 2)}
STEPS = (10, 110)  # the difference of two runs has no set-up in it
REPETITIONS = 3
SPEEDUP, MEMORY = 1.8, 0.55  # of two ranks


@dataclass(frozen=True)
class Case:
    """A plate of so many elements on so many ranks; `method` as model files have it."""

    name: str
    elements: tuple[int, int, int]
    ranks: int
    method: str = "recomputed"


@dataclass(frozen=True)
class Step:
    """Of the rank that has most to do, per step; memory of the largest rank."""

    work: float  # CPU time outside MPI [s]
    messages: float
    collectives: float
    bytes: float
    memory: float  # peak [byte]


def cases(most: int) -> list[Case]:
    result = [Case(method, PLATE, ranks, method) for method in ("recomputed", "stored") for ranks in (1, 2)]
    result += [Case("large", LARGE, ranks) for ranks in (1, 2)]
    for ranks, (nx, ny) in GRIDS.items():
        if ranks <= most:
            result.append(Case("as much per rank", (nx * PIECE[0], ny * PIECE[1], PIECE[2]), ranks))
    return result + [Case("tiny", TINY, 1)]


def model(elements: tuple[int, int, int], method: str) -> str:
    """plate.yaml with other elements of the same size."""
    size = [0.610 * elements[0] / PLATE[0], 0.610 * elements[1] / PLATE[1], 0.0501]
    box = f"box: {{origin: [{-size[0] / 2}, {-size[1] / 2}, -0.0501], size: {size}, elements: {list(elements)}, degree: 2}}"
    text, count = re.subn(r"box: \{.*\}", box, (DECK / "plate.yaml").read_text(encoding="utf-8"))
    assert count == 1
    return f"{text}integration: {{method: {method}}}\n"


def environment() -> dict[str, str]:
    wanted = {"OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_mpi_yield_when_idle": "1"}
    if os.geteuid() == 0:
        wanted |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return {**os.environ, **wanted}


@dataclass
class Bench:
    """Runs the deck in a folder of its own."""

    program: str
    census: str  # libmpi_census.so

    def run(self, text: str, ranks: int, steps: int) -> list[dict]:
        """What each rank has counted."""
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(DECK / "in.ball_plate", folder)
            (Path(folder) / "plate.yaml").write_text(text, encoding="utf-8")
            command = ["mpirun", "--bind-to", "none", "-np", str(ranks)]
            command += ["-x", f"LD_PRELOAD={self.census}", "-x", f"MPI_CENSUS={folder}", self.program]
            command += ["-in", "in.ball_plate", "-log", "none", "-var", "steps", str(steps)]
            done = subprocess.run(command, cwd=folder, env=environment(), capture_output=True, check=False)
            if done.returncode != 0:
                raise RuntimeError(f"{command} failed:\n{(done.stdout + done.stderr).decode(errors='replace')[-1500:]}")
            return [json.loads((Path(folder) / f"{rank}.json").read_text()) for rank in range(ranks)]

    def step(self, case: Case) -> Step:
        text = model(case.elements, case.method)
        few, many = (self.run(text, case.ranks, steps) for steps in STEPS)
        return per_step(few, many)


def per_step(few: list[dict], many: list[dict]) -> Step:
    """From what the ranks have counted in STEPS[0] and in STEPS[1] steps."""

    def most(count) -> float:
        return max(count(b) - count(a) for a, b in zip(few, many)) / (STEPS[1] - STEPS[0])

    return Step(
        most(lambda rank: rank["cpu"] - rank["inside_mpi"]),
        *(most(lambda rank, key=key: rank[key]) for key in ("messages", "collectives", "bytes")),
        max(rank["peak_bytes"] for rank in many),
    )


def middle(steps: list[Step]) -> Step:
    """The run with the median work."""
    return sorted(steps, key=lambda step: step.work)[len(steps) // 2]


def rows(case: Case, step: Step, tiny: float) -> list[Row]:
    name = f"{case.name} on {case.ranks}"
    return [
        Row(name, "work_per_step", 1e3 * step.work, "ms"),
        Row(name, "messages_per_step", step.messages, "1"),
        Row(name, "collectives_per_step", step.collectives, "1"),
        Row(name, "bytes_sent_per_step", step.bytes, "B"),
        Row(name, "memory_beyond_tiny", (step.memory - tiny) / 1e6, "MB"),
    ]


def report(steps: dict[Case, Step]) -> list[Row]:
    """Of all cases; the last, tiny one is what memory is counted from."""
    tiny = next(step.memory for case, step in steps.items() if case.name == "tiny")
    one = {case.name: step for case, step in steps.items() if case.ranks == 1}
    result = []
    for case, step in steps.items():
        result += rows(case, step, tiny)
        if case.ranks == 1:
            continue
        name, alone = f"{case.name} on {case.ranks}", one[case.name]
        if case.name.startswith("as much"):
            result.append(Row(name, "efficiency", alone.work / step.work, "1"))
            continue
        aim = SPEEDUP if case.method == "recomputed" else None
        result.append(AtLeast(name, "speedup", alone.work / step.work, "1", aim))
        share = (step.memory - tiny) / (alone.memory - tiny)
        result.append(AtMost(name, "memory_over_one", share, "1", MEMORY if case.name == "large" else None))
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="liggghts-nurbs")
    parser.add_argument("census", help="libmpi_census.so")
    parser.add_argument("out", type=Path)
    parser.add_argument("--most", type=int, default=8, choices=GRIDS, help="ranks of the weak scaling")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    bench = Bench(str(Path(args.program).resolve()), str(Path(args.census).resolve()))
    seen: dict[Case, list[Step]] = {case: [] for case in cases(args.most)}
    for _ in range(REPETITIONS):
        for case, taken in seen.items():
            taken.append(bench.step(case))
    found = report({case: middle(taken) for case, taken in seen.items()})
    write_json(args.out / "summary.json", "ranks", found)
    print(table(found))


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-2.0-or-later
"""What a rank has to do when the plate of the deck ball_plate is cut (strong scaling: 1 and 2 ranks) and when each rank
gets as much of a larger plate (weak scaling: 1, 2, 4 and 8): CPU time outside MPI, messages, bytes and memory.  Prints the
table and writes OUT/summary.json.  Slow is reported, never an error."""

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
PIECE = (16, 16, 8)  # of a rank
GRIDS = {1: (1, 1), 2: (2, 1), 4: (2, 2), 8: (4, 2)}
STEPS = (10, 110)  # the difference of two runs has no set-up in it
REPETITIONS = 3
SPEEDUP, MEMORY = 1.8, 0.55  # of two ranks


@dataclass(frozen=True)
class Step:
    """Of the rank that has most to do, per step; memory of the largest rank."""

    work: float  # CPU time outside MPI [s]
    messages: float
    collectives: float
    bytes: float
    memory: float  # peak [byte]


def model(elements: tuple[int, int, int]) -> str:
    """plate.yaml with other elements of the same size."""
    size = [0.610 * elements[0] / PLATE[0], 0.610 * elements[1] / PLATE[1], 0.0501]
    box = f"box: {{origin: [{-size[0] / 2}, {-size[1] / 2}, -0.0501], size: {size}, elements: {list(elements)}, degree: 2}}"
    text, count = re.subn(r"box: \{.*\}", box, (DECK / "plate.yaml").read_text(encoding="utf-8"))
    assert count == 1
    return text


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

    def step(self, text: str, ranks: int) -> Step:
        few, many = (self.run(text, ranks, steps) for steps in STEPS)
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


def rows(case: str, step: Step) -> list[Row]:
    return [
        Row(case, "work_per_step", 1e3 * step.work, "ms"),
        Row(case, "messages_per_step", step.messages, "1"),
        Row(case, "collectives_per_step", step.collectives, "1"),
        Row(case, "bytes_sent_per_step", step.bytes, "B"),
        Row(case, "memory", step.memory / 1e6, "MB"),
    ]


def report(strong: dict[int, Step], weak: dict[int, Step]) -> list[Row]:
    result = []
    for ranks, step in strong.items():
        result += rows(f"the plate on {ranks}", step)
    one, two = strong[1], strong[2]
    result.append(AtLeast("the plate on 2", "speedup", one.work / two.work, "1", SPEEDUP))
    result.append(AtMost("the plate on 2", "memory_of_a_rank_over_one", two.memory / one.memory, "1", MEMORY))
    for ranks, step in weak.items():
        case = f"as much per rank on {ranks}"
        result += rows(case, step)
        result.append(Row(case, "efficiency", weak[1].work / step.work, "1"))
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
    texts = {("strong", ranks): model(PLATE) for ranks in (1, 2)}
    for ranks, (nx, ny) in GRIDS.items():
        if ranks <= args.most:
            texts["weak", ranks] = model((nx * PIECE[0], ny * PIECE[1], PIECE[2]))
    seen = {key: [] for key in texts}
    for _ in range(REPETITIONS):
        for key, text in texts.items():
            seen[key].append(bench.step(text, key[1]))
    steps = {key: middle(taken) for key, taken in seen.items()}
    strong, weak = ({ranks: step for (kind, ranks), step in steps.items() if kind == name} for name in ("strong", "weak"))
    found = report(strong, weak)
    write_json(args.out / "summary.json", "ranks", found)
    print(table(found))


if __name__ == "__main__":
    sys.exit(main())

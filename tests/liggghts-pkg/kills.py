#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: kills.py COUNT [--first SEED]

Kills a coupled run (balls on a solid that bends and beside a roller that turns) COUNT times with SIGKILL at random moments,
chooses the restart file as the command page says, continues from it and expects

* the rest of the run to be that of a run which was only split there, to the last bit;
* every .pvd, the .vtu files that it lists and the plate's histories to open right after the kill, and all of them to be those
  of the split run in the end, with nothing unfinished left.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from random import Random

import numpy as np

import decks
import histories
import vtu
from prelude import Prelude

END, EVERY = 1500, 50  # steps of the run, and between restart files
TIMESTEP = 1e-6
SERIES = {"plate": 30, "roll": 70}  # steps between the states of each wall's output
FILES = {
    "plate.yaml": """
units: si
geometry:
  box: {origin: [-0.006, -0.006, -0.001], size: [0.012, 0.012, 0.001], elements: [6, 6, 1], degree: 2}
material: {law: saint_venant_kirchhoff, youngs_modulus: 2.0e+7, poissons_ratio: 0.3, density: 1500}
boundary: [{fix: [x, y, z], faces: [xi-, xi+]}]
surfaces: {top: zeta+}
probes: {centre: {face: zeta+, at: [0.5, 0.5]}}
output: {every: 3e-5, file: plate}
""",
    "roller.yaml": """
units: si
geometry:
  cylinder: {origin: [0, -0.007, 0.001], axis: [0, 1, 0], radius: 0.0007, length: 0.014, elements: [12, 8]}
surfaces: {wall: all}
""",
}
MODELS = "model hertz tangential history rolling_friction epsd2"
START = Prelude(
    "-0.012 0.012 -0.012 0.012 -0.006 0.014", E=(1e7, 2e7), nu=(0.3, 0.3), e=0.7, mu=0.4, models=MODELS,
    further={"coefficientRollingFriction": 0.1, "k_finnie": 1e-10}, timestep=TIMESTEP, lists="delay 0",
)
# Apart from each other: LIGGGHTS' files of `restart N` hold the tangential history of pairs as it was a step before.
BALLS = "".join(
    f"create_atoms 1 single {-0.004 + 0.00133 * i} {-0.004 + 0.002 * j} {0.00053 + 0.00015 * ((3 * i + 5 * j) % 7)} units box\n"
    for i in (0, 2, 4, 6)
    for j in range(5)
) + """
set group all diameter 0.001 density 2500
velocity all set 0.4 0.1 -0.8 units box
"""
REST = f"""
fix gravity all gravity 9.81 vector 0 0 -1
fix plate all wall/nurbs {MODELS} type 2 structure plate.yaml surface top output plate every {SERIES["plate"]}
fix roll all wall/nurbs {MODELS} type 2 geometry roller.yaml surface wall motion rotate origin 0 0 0.001 axis 0 1 0 &
    period 0.02 output roll every {SERIES["roll"]} fields pressure shear wear
fix integrate all nve/sphere
dump balls all custom 5 balls.txt id type x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz mass radius
dump_modify balls sort id format "%d %d{" %.17g" * 17}"
compute touch all contact/atom
compute touches all reduce sum c_touch
thermo_style custom step c_touches f_plate[1] f_plate[2] f_plate[3] f_plate[4] f_plate[7] f_plate[8] f_plate[11] &
    f_plate[15] f_plate[16] f_plate[20] f_roll[1] f_roll[2] f_roll[3] f_roll[5] f_roll[7] f_roll[18]
thermo_modify format float %.17g lost error norm no
thermo 5
restart {EVERY} a.restart b.restart
"""
BEGIN = START.text() + BALLS + REST


def go_on(file: str) -> str:
    return START.again(file) + REST + f"run {END} upto\n"


def put_files(folder: Path) -> None:
    for name, text in FILES.items():
        (folder / name).write_text(text)


def good(folder: Path, deck: str) -> decks.Run:
    result = decks.run_in(folder, deck)
    if result.code != 0 or not result.tables:
        raise AssertionError(f"a deck failed with exit code {result.code}:\n{result.text[-2000:]}")
    return result


def complete_restart(folder: Path) -> Path | None:
    """As the command page says: of two files the older; a single one may be unfinished."""
    files = sorted(folder.glob("?.restart"), key=lambda path: path.stat().st_mtime_ns)
    return files[0] if len(files) == 2 else None


def kill_a_run(folder: Path, ranks: int, step: int, fraction: float) -> None:
    """Runs the deck in this folder until the plate's state of `step` is written, and kills it a fraction of the time between
    two states later: a moment of the run, however busy the machine is."""
    (folder / "in.killed").write_text(BEGIN + f"run {END}\n")
    command = ["mpirun", "-n", str(ranks)] * (ranks > 1) + [decks.NURBS, "-in", "in.killed", "-log", "log.killed"]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
        environment = decks.mpi_environment() | {"OMPI_MCA_orte_tmpdir_base": scratch}
        process = subprocess.Popen(
            command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        before = wait_for(process, folder / f"plate_{step - SERIES['plate']}.vtu")
        time.sleep(fraction * (wait_for(process, folder / f"plate_{step}.vtu") - before))
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
        if process.poll() is None:
            for pid in children.read_text().split() if ranks > 1 else [process.pid]:
                os.kill(int(pid), signal.SIGKILL)
        process.wait()


def wait_for(process: subprocess.Popen, file: Path) -> float:
    """The moment at which the file is there, or the process has come to its end."""
    while process.poll() is None and not file.exists():
        time.sleep(2e-4)
    return time.monotonic()


def check_series(folder: Path) -> None:
    """Every series there is opens, and so does every state in it; its times are those of its steps.  So do the histories."""
    for index in folder.glob("*.pvd"):
        for moment, path in vtu.series(index).items():
            state = vtu.read(path)
            if not (len(state.cells) and np.isfinite(state.points).all()):
                raise AssertionError(f"{path.name} is empty or not finite")
            if abs(moment - TIMESTEP * int(path.stem.split("_")[1])) > 1e-9 * TIMESTEP:
                raise AssertionError(f"{index.name} has time {moment} for {path.name}")
    rows = histories.read(folder / "plate.h5")
    steps = rows["time"] / TIMESTEP / SERIES["plate"]
    if len(steps) < 2 or np.abs(steps - np.arange(len(steps))).max() > 1e-9:
        raise AssertionError(f"plate.h5 has the times {rows['time']}")
    if {len(values) for values in rows.values()} != {len(steps)}:
        raise AssertionError("plate.h5 lacks rows that its time has")


def same_state(a: vtu.State, b: vtu.State) -> bool:
    """The same surface to the last bit, and the same fields to round-off, which depends on the order of the contacts."""
    pairs = [(a.fields[name], b.fields[name]) for name in b.fields]
    pairs += [(a.elements[name], b.elements[name]) for name in b.elements]
    return np.array_equal(a.points, b.points) and all(np.abs(u - v).max() <= 1e-12 * np.abs(v).max() for u, v in pairs)


def same_series(folder: Path, reference: Path) -> None:
    check_series(folder)
    for name in SERIES:
        ours, theirs = ([p.name for p in vtu.series(f / f"{name}.pvd").values()] for f in (folder, reference))
        if ours != theirs:
            raise AssertionError(f"{name}.pvd lists {len(ours)} states, expected {len(theirs)}, those of the split run")
    for path in reference.glob("*.vtu"):
        if not same_state(vtu.read(folder / path.name), vtu.read(path)):
            raise AssertionError(f"{path.name} differs from that of the split run")
    ours, theirs = (histories.read(f / "plate.h5") for f in (folder, reference))
    for name, values in theirs.items():
        if not np.array_equal(ours[name], values):
            raise AssertionError(f"{name} of plate.h5 differs from that of the split run")
    unfinished = list(folder.glob("*.part"))
    if unfinished:
        raise AssertionError(f"left unfinished: {unfinished}")


def balls_after(step: int, folder: Path) -> list[str]:
    """What was dumped of the balls after this step, with 17 digits."""
    states = (folder / "balls.txt").read_text().split("ITEM: TIMESTEP\n")[1:]
    return [state for state in states if int(state.split(None, 1)[0]) > step]


class References:
    """The runs that were only split, by the step of the split."""

    def __init__(self, folder: Path):
        self.folder, self.known = folder, {}
        self.folder.mkdir()

    def split_at(self, step: int) -> tuple[decks.Run, Path]:
        if step not in self.known:
            folder = self.folder / str(step)
            folder.mkdir()
            put_files(folder)
            run = good(folder, BEGIN + f"run {step}\nrun {END} upto\n")
            if min(run.table["plate[7]"].max(), run.table["roll[7]"].max()) == 0:
                raise AssertionError("nothing touches the walls")
            if run.table["touches"].max() > 0:
                raise AssertionError("balls touch each other")
            self.known[step] = run, folder
        return self.known[step]


def examine(rng: Random, folder: Path, references: References) -> str:
    """One kill and what follows; returns what happened, raises AssertionError with what is wrong."""
    put_files(folder)
    ranks = rng.choice((1, 1, 2))
    first = 2 * EVERY // SERIES["plate"] + 1  # there are two restart files then
    kill_a_run(folder, ranks, SERIES["plate"] * rng.randint(first, END // SERIES["plate"] - 1), rng.random())
    check_series(folder)
    chosen = complete_restart(folder)
    if chosen is None:
        raise AssertionError("there are no two restart files")
    sizes = {path.name: path.stat().st_size for path in folder.glob("?.restart")}
    resumed = good(folder, go_on(chosen.name))
    step = int(resumed.table["Step"][0])
    if step % EVERY or not 0 < step <= END:
        raise AssertionError(f"'{chosen.name}' is of step {step}")
    whole, reference = references.split_at(step)
    begun = f"continued at step {step} from {sizes}"
    for column, values in whole.tables[-1].items():
        if not np.array_equal(values, resumed.table[column]):
            raise AssertionError(f"{column} differs from the split run, {begun}")
    if balls_after(step, folder) != balls_after(step, reference):
        raise AssertionError(f"the balls move otherwise than in the split run, {begun}")
    if int(resumed.table["Step"][-1]) != END:
        raise AssertionError("the run was not continued to its end")
    same_series(folder, reference)
    return f"killed on {ranks} ranks, {begun}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1])
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="seed of the first kill; default 0")
    words = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        references = References(Path(scratch) / "split")
        for seed in range(words.first, words.first + words.count):
            folder = Path(scratch) / str(seed)
            folder.mkdir()
            try:
                outcome = examine(Random(seed), folder, references)
            except Exception as problem:
                failed += 1
                outcome = f"FAILED: {problem}\nto repeat it, up to the clock: tests/run --kills 1 --first {seed}"
            print(f"kill {seed}: {outcome}", flush=True)
    print(f"{words.count} kills: {words.count - failed} runs continued to the last bit, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

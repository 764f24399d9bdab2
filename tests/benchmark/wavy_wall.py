# SPDX-License-Identifier: GPL-2.0-or-later
"""What the wavy wall costs as a NURBS surface and as LIGGGHTS' triangles, at rest and moving: prints the table and
writes OUT/summary.json in the shape of the studies' summaries.  Slow is reported, never an error."""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import wavy_memory
from bounds import AtMost
from study.build.waves import SIDE, SplineWave, model_file, triangles
from study.reference.hertz import sphere_mass
from study.run.summary import Row, table, write_json
from wall_runs import DECKS, fix_times, touching
from wavy_bench import AMPLITUDE, DEGREE, ELEMENTS, LAYERS, Bench, spheres

REPEATS = 5
SQUARES = 124  # in a row, of two triangles each
CONTINUED = (124, 496)  # elements in a row of walls that go on around the spheres


@dataclass(frozen=True)
class Wall:
    """A wall, the file in.DECK that makes it, and whose state it starts from."""

    deck: str
    geometry: str
    settled_on: str
    open: bool = False  # the box is not periodic, and wider than the grid of spheres


NEAR, FAR = (f"nurbs_continued_{n}" for n in CONTINUED)
WALLS = {
    "nurbs": Wall("nurbs", "wall_62.yaml", "nurbs"),
    "nurbs_248": Wall("nurbs", "wall_248.yaml", "nurbs_248"),
    "nurbs_moving": Wall("nurbs_moving", "wall_62.yaml", "nurbs"),
    "triangles": Wall("triangles", "wall.stl", "triangles"),
    "triangles_moving": Wall("triangles_moving", "wall.stl", "triangles"),
    NEAR: Wall("nurbs", f"continued_{CONTINUED[0]}.h5", NEAR, open=True),
    FAR: Wall("nurbs", f"continued_{CONTINUED[1]}.h5", NEAR, open=True),
}
TIMED = {3500: list(WALLS), 50000: ["nurbs", "triangles"]}
# (walls, particles): the first wall's time over the second's, at most
TARGETS = {
    ("nurbs", "triangles", 3500): 0.10,
    ("nurbs_moving", "triangles_moving", 3500): 0.05,
    ("nurbs", "triangles", 50000): 0.15,
}
FINER = 1.5  # time with elements of a quarter of the size, at most
FAR_TOLERANCE = 0.05  # of the time with FAR over that with NEAR, which should be 1


@dataclass(frozen=True)
class Timing:
    """CPU time of a step: the wall's fixes, everything [s]."""

    wall: float
    step: float


def spheres_file(particles: int, wall: Wall) -> str:
    return f"spheres_{particles}_open.data" if wall.open else f"spheres_{particles}.data"


def settle(bench: Bench, name: str, particles: int) -> int:
    """Lets the layers come to rest on a wall; how many spheres touch it."""
    wall = WALLS[name]
    variables = dict(wall=wall.deck, geometry=wall.geometry, sides="f" if wall.open else "p")
    variables |= dict(spheres=spheres_file(particles, wall), state=f"state_{name}_{particles}")
    log = bench.run("in.settle", steps=LAYERS[particles].settle, **variables)
    return touching(log)


def time(bench: Bench, name: str, particles: int) -> Timing:
    wall, layers = WALLS[name], LAYERS[particles]
    variables = dict(wall=wall.deck, geometry=wall.geometry, state=f"state_{wall.settled_on}_{particles}")
    variables |= dict(before=layers.before, steps=layers.timed, end=f"end_{name}.txt")
    if wall.open:  # a state is of one geometry alone: both walls begin anew, to end alike
        variables["id"] = "wall_anew"
    seconds, loop = fix_times(bench.run("in.time", **variables))
    return Timing(sum(seconds.values()) / layers.timed, loop / layers.timed)


def measure(bench: Bench, particles: int) -> list[Row]:
    """Rows of one number of particles; walls take turns."""
    timed = TIMED[particles]
    settled = [name for name in timed if WALLS[name].settled_on == name]
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:  # not timed, so all cores may work
        touch = dict(zip(settled, pool.map(lambda name: settle(bench, name, particles), settled)))
    times: dict[str, list[Timing]] = {name: [] for name in timed}
    for _ in range(REPEATS):
        for name in timed:
            times[name].append(time(bench, name, particles))
    wall = {name: statistics.median(t.wall for t in taken) for name, taken in times.items()}
    step = {name: statistics.median(t.step for t in taken) for name, taken in times.items()}
    case = f"{LAYERS[particles].count} particles"
    rows = [Row(case, f"{name}_touching", count, "1") for name, count in touch.items()]
    for name in timed:
        spread = [1e3 * t.wall for t in times[name]]
        note = f"{min(spread):.3g} to {max(spread):.3g}"
        rows.append(Row(case, f"{name}_wall_time_per_step", 1e3 * wall[name], "ms", note=note))
        rows.append(Row(case, f"{name}_time_per_step", 1e3 * step[name], "ms"))
    for (ours, theirs, number), bound in TARGETS.items():
        if number == particles:
            rows.append(AtMost(case, f"{ours}_over_{theirs}", wall[ours] / wall[theirs], "1", bound))
    if "nurbs_248" in wall:
        finer = wall["nurbs_248"] / wall["nurbs"]
        rows.append(AtMost(case, "nurbs_248_over_nurbs", finer, "1", FINER, note="finer, same size"))
    if FAR in wall:
        rows.append(Row(case, f"{FAR}_over_{NEAR}", wall[FAR] / wall[NEAR], "1", 1.0, FAR_TOLERANCE))
        rows += same_run(case, *((bench.folder / f"end_{name}.txt").read_text() for name in (NEAR, FAR)))
    return rows


def same_run(case: str, one: str, other: str) -> list[Row]:
    """Largest differences of two dumps of the same steps: of coordinates [m], of forces in weights of the sphere."""
    (radii, x, F), (_, x_other, F_other) = (final_state(dump) for dump in (one, other))
    weights = 9.81 * sphere_mass(radii, 2500.0)
    forces = np.abs(F - F_other) / weights[:, None]
    return [
        Row(case, "continued_position_difference", float(np.max(np.abs(x - x_other))), "m", 0.0, 1e-15),
        Row(case, "continued_force_difference", float(forces.max()), "weights", 0.0, 1e-9),
    ]


def final_state(dump: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Radii (n), coordinates (n, 3) [m], forces (n, 3) [N] in the order of ids."""
    rows = np.array([line.split() for line in dump.split("ITEM: ATOMS")[-1].splitlines()[1:]], dtype=float)
    rows = rows[np.argsort(rows[:, 0])]
    return rows[:, 1], rows[:, 2:5], rows[:, 5:8]


def write_files(bench: Bench) -> None:
    """Walls and spheres."""
    (bench.folder / "wall.stl").write_text(triangles(SQUARES, AMPLITUDE))
    for n in (ELEMENTS, 248):
        (bench.folder / f"wall_{n}.yaml").write_text(model_file(SplineWave(DEGREE, n), AMPLITUDE))
    for n in {*CONTINUED, *wavy_memory.ELEMENTS}:
        bench.continued_wall(n)
    for particles, layers in LAYERS.items():
        (bench.folder / f"spheres_{particles}.data").write_text(spheres(layers))
    room = SIDE / ELEMENTS * (CONTINUED[0] - ELEMENTS) / 2
    (bench.folder / "spheres_3500_open.data").write_text(spheres(LAYERS[3500], room))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("program")
    add("clock", help="libcpu_clock.so")
    add("out", type=Path)
    add("--convert", required=True, help="nurbs-convert")
    add("--particles", type=int, action="append", choices=list(LAYERS))
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(DECKS, folder, dirs_exist_ok=True)
        bench = Bench(args.program, args.clock, Path(folder), args.convert)
        write_files(bench)
        rows += wavy_memory.rows(bench, "spheres_3500_open.data")
        for particles in args.particles or LAYERS:
            rows += measure(bench, particles)
    write_json(args.out / "summary.json", "wavy_wall", rows)
    print(table(rows))
    print("\nMedians of thread CPU time, by LIGGGHTS' modify_timing.")


if __name__ == "__main__":
    sys.exit(main())

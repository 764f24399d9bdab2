# SPDX-License-Identifier: GPL-2.0-or-later
"""What walls of planes, pipes and triangles cost beside LIGGGHTS' own, and a plane that goes on beyond a periodic box
beside one that ends with it: prints the table and writes OUT/summary.json in the shape of the studies' summaries.  Slow is
reported, never an error."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import wall_shapes
import wavy_bench
from bounds import AtMost
from study.build.stl import stl
from study.build.waves import SplineWave, model_file, triangles
from study.run.summary import Row, table, write_json
from wall_runs import DECKS, WallRuns, fix_times, touching_rows
from wavy_memory import memory

SETTLE, BEFORE, STEPS = 4000, 50, 200
AMPLITUDE = 5e-6  # of walls that move [m]: they begin with 1.6 mm/s, and no sphere is thrown off
BOX = 12
DRUMS = {BOX: (4, 1), 92: (24, 1), 1616: (54, 14)}  # triangles: sides, bands
PLATES = {30752: 124, 123008: 248}  # triangles: squares in a row of the wavy plate
LARGEST = max(PLATES)
READ = f"{LARGEST} triangles, read"
FLAT, HOLLOW, WAVY, OPEN = "flat.data", "hollow.data", "wavy.data", "open.data"
LEVEL = "level.data"  # as WAVY, above a plane
PERIODIC = (WAVY, LEVEL)  # in boxes that are


@dataclass(frozen=True)
class Wall:
    """The file in.DECK that makes it, and what it makes it of."""

    deck: str
    geometry: str

    @property
    def is_ours(self) -> bool:
        return self.deck.startswith("nurbs")


@dataclass(frozen=True)
class Pair:
    """A wall of ours and another in its place, with the same spheres; LIGGGHTS' from the state of ours at rest."""

    case: str
    ours: Wall
    other: Wall
    spheres: str
    aim: float | None  # of ours over the other
    name: str = "stock"  # of the other: LIGGGHTS' own

    @property
    def walls(self) -> tuple[Wall, Wall]:
        return self.ours, self.other

    def state(self, wall: Wall) -> str:
        """Restart file that it starts from."""
        return state(wall.geometry if wall.is_ours else self.ours.geometry)


def stl_pairs(count: int) -> list[Pair]:
    """At rest and moving."""
    file, spheres = f"{count}.stl", WAVY if count in PLATES else FLAT if count == BOX else HOLLOW
    aim = 0.15 if count in PLATES else 0.8
    return [
        Pair(f"{count} triangles{how}", Wall("nurbs" + deck, file), Wall("triangles" + deck, file), spheres, aim)
        for how, deck in (("", ""), (", moving", "_moving"))
    ]


ZPLANE = Wall("primitive", "zplane 0.")
XCYLINDER = Wall("primitive", f"xcylinder {wall_shapes.RADIUS} 0. {wall_shapes.RADIUS}")
PAIRS = [
    Pair("plane, by words", Wall("nurbs", "plane.yaml"), ZPLANE, FLAT, 1.5),
    Pair("plane, 2 triangles", Wall("nurbs", "plane.stl"), ZPLANE, FLAT, 1.5),
    Pair("plane, 2 triangles, beside mesh", Wall("nurbs", "plane.stl"), Wall("triangles", "plane.stl"), FLAT, 0.8),
    Pair("cylinder, by words", Wall("nurbs", "pipe.yaml"), XCYLINDER, HOLLOW, 1.5),
    Pair("plane beyond a periodic box", Wall("nurbs", "wider.yaml"), Wall("nurbs", "box.yaml"), LEVEL, 1.2, "box_wide"),
    Pair("waves beyond a periodic box", Wall("nurbs", "more_waves.yaml"), Wall("nurbs", "waves.yaml"), WAVY, 1.2, "box_wide"),
    *(pair for count in (*DRUMS, *PLATES) for pair in stl_pairs(count)),
]


@dataclass(frozen=True)
class Measured:
    """Of one wall: CPU time of its fixes per step [s] in each run; spheres that touch it, every ten of the timed steps:
    a wall that begins to move throws some off."""

    seconds: list[float]
    touching: list[int]


def write_files(folder: Path) -> None:
    """Walls and spheres."""
    files = {"plane.yaml": wall_shapes.PLANE, "pipe.yaml": wall_shapes.PIPE, "plane.stl": stl(wall_shapes.plane())}
    wave = SplineWave(wavy_bench.DEGREE, wavy_bench.ELEMENTS)
    files |= {f"{name}.yaml": model_file(wave, wavy_bench.AMPLITUDE, n) for name, n in (("waves", 0), ("more_waves", 10))}
    files |= {"box.yaml": wall_shapes.BOX_PLANE, "wider.yaml": wall_shapes.WIDER_PLANE}
    files |= {f"{count}.stl": stl(wall_shapes.drum(*of)) for count, of in DRUMS.items()}
    files |= {f"{count}.stl": triangles(n, wavy_bench.AMPLITUDE) for count, n in PLATES.items()}
    files |= {FLAT: wall_shapes.spheres(hollow=False), HOLLOW: wall_shapes.spheres(hollow=True)}
    layer = wavy_bench.LAYERS[3500]
    files |= {WAVY: wavy_bench.spheres(layer), OPEN: wavy_bench.spheres(layer, wall_shapes.MARGIN)}
    files[LEVEL] = wavy_bench.spheres(layer, amplitude=0.0)
    for name, text in files.items():
        (folder / name).write_text(text)


def settle(runs: WallRuns, pairs: Sequence[Pair]) -> None:
    """Lets the spheres come down on each wall of ours; not timed, so all cores may work."""

    def run(settled: tuple[str, str]) -> None:
        file, spheres = settled
        sides = "p" if spheres in PERIODIC else "f"
        variables = dict(wall="nurbs", geometry=file, spheres=spheres, sides=sides, state=state(file))
        runs.run("in.settle", steps=SETTLE, **variables)

    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        list(pool.map(run, {(wall.geometry, pair.spheres) for pair in pairs for wall in pair.walls if wall.is_ours}))


def state(geometry: str) -> str:
    """Restart file of spheres at rest on a wall of ours."""
    return f"state_{geometry}"


def measure(runs: WallRuns, pairs: Sequence[Pair], repeats: int) -> list[Row]:
    """Rows of all pairs; walls take turns."""
    settle(runs, pairs)
    # Walls, and what they start from: pairs share runs.
    timed = dict.fromkeys((wall, pair.state(wall)) for pair in pairs for wall in pair.walls)
    words = {
        key: dict(wall=key[0].deck, geometry=key[0].geometry, state=key[1], before=BEFORE, amplitude=AMPLITUDE)
        for key in timed
    }
    found = {key: Measured([], touching_rows(runs.run("in.touch", **words[key], steps=STEPS))) for key in timed}
    for _ in range(repeats):
        for key in timed:
            fixes, _ = fix_times(runs.run("in.time", **words[key], steps=STEPS, end="end.txt"))
            found[key].seconds.append(sum(fixes.values()) / STEPS)
    return [
        row
        for pair in pairs
        for row in rows(pair, *(found[wall, pair.state(wall)] for wall in pair.walls))
    ]


def rows(pair: Pair, ours: Measured, other: Measured) -> list[Row]:
    """Least times of a step and of a contact, and the ratio of the steps'."""
    found = []
    for name, wall in (("ours", ours), (pair.name, other)):
        least, most = min(wall.seconds), max(wall.seconds)
        touch = round(sum(wall.touching) / len(wall.touching))
        note = f"up to {1e6 * most:.3g} us; {1e9 * least / touch:.3g} ns for each of {touch} that touch"
        note += f", {min(wall.touching)} to {max(wall.touching)}"
        found.append(Row(pair.case, f"{name}_per_step", 1e6 * least, "us", note=note))
    ratio = min(ours.seconds) / min(other.seconds)
    return found + [AtMost(pair.case, f"ours_over_{pair.name}", ratio, "1", pair.aim)]


def reading(runs: WallRuns, repeats: int) -> list[Row]:
    """CPU time and peak memory of `run 0` with the largest wall of triangles; walls take turns."""
    seconds: dict[str, list[float]] = {"nurbs": [], "triangles": []}
    peak: dict[str, float] = {}
    for _ in range(repeats):
        for deck, taken in seconds.items():
            time, log = runs.seconds("in.memory", wall=deck, geometry=f"{LARGEST}.stl", spheres=OPEN, steps=0)
            taken.append(time)
            peak[deck] = memory(log).peak
    return reading_rows({deck: min(taken) for deck, taken in seconds.items()}, peak)


def reading_rows(seconds: dict[str, float], peak: dict[str, float]) -> list[Row]:
    """Of CPU times [s] and memory [bytes] by deck."""
    found = []
    for quantity, unit, value, aim in (
        ("time", "s", seconds, 2.0),
        ("memory", "MiB", {deck: size / 2**20 for deck, size in peak.items()}, 1.5),
    ):
        ours, stock = value["nurbs"], value["triangles"]
        found += [Row(READ, f"ours_{quantity}", ours, unit), Row(READ, f"stock_{quantity}", stock, unit)]
        found.append(AtMost(READ, f"{quantity}_ours_over_stock", ours / stock, "1", aim))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("program")
    add("clock", help="libcpu_clock.so")
    add("out", type=Path)
    add("--only", metavar="WORD", default="", help="rows with this in their name, as '1616 triangles'")
    add("--repeats", metavar="N", type=int, default=3)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(DECKS, folder, dirs_exist_ok=True)
        runs = WallRuns(args.program, args.clock, Path(folder))
        write_files(runs.folder)
        found = measure(runs, [pair for pair in PAIRS if args.only in pair.case], args.repeats)
        found += reading(runs, args.repeats) if args.only in READ else []
    write_json(args.out / "summary.json", "walls", found)
    print(table(found))
    print(f"\nLeast of {args.repeats} thread CPU times, by LIGGGHTS' modify_timing.")


if __name__ == "__main__":
    sys.exit(main())

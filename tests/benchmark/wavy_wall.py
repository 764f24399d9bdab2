# SPDX-License-Identifier: GPL-2.0-or-later
"""What the wavy wall costs as a NURBS surface and as LIGGGHTS' triangles, at rest and moving: prints the table and
writes OUT/summary.json in the shape of the studies' summaries.  Slow is reported, never an error."""

from __future__ import annotations

import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from bounds import AtMost
from study.summary import Row, table, write_json
from study.waves import K, SIDE, SplineWave, model_file, triangles

DECKS = Path(__file__).parent / "wavy_wall"
AMPLITUDE = 2e-3  # [m]
DEGREE = 3
REPEATS = 5
SQUARES = 124  # in a row, of two triangles each


@dataclass(frozen=True)
class Layers:
    """Spheres on a grid in layers above the wall, and for how many steps they settle and are timed."""

    per_row: int
    layers: int
    settle: int
    before: int
    timed: int

    @property
    def count(self) -> int:
        return self.per_row**2 * self.layers


LAYERS = {3500: Layers(59, 1, 4000, 100, 400), 50000: Layers(49, 21, 16000, 50, 100)}


@dataclass(frozen=True)
class Wall:
    """A wall, the file in.DECK that makes it, and whose state it starts from."""

    deck: str
    geometry: str
    settled_on: str


WALLS = {
    "nurbs": Wall("nurbs", "wall_62.yaml", "nurbs"),
    "nurbs_248": Wall("nurbs", "wall_248.yaml", "nurbs_248"),
    "nurbs_moving": Wall("nurbs_moving", "wall_62.yaml", "nurbs"),
    "triangles": Wall("triangles", "wall.stl", "triangles"),
    "triangles_moving": Wall("triangles_moving", "wall.stl", "triangles"),
}
TIMED = {3500: list(WALLS), 50000: ["nurbs", "triangles"]}
# (walls, particles): the first wall's time over the second's, at most
TARGETS = {
    ("nurbs", "triangles", 3500): 0.10,
    ("nurbs_moving", "triangles_moving", 3500): 0.05,
    ("nurbs", "triangles", 50000): 0.15,
}
MEMORY_ELEMENTS = (186, 248, 372)  # enough to show beside the program itself


@dataclass(frozen=True)
class Timing:
    """CPU time of a step: the wall's fixes, everything [s]; and the largest memory of the process [bytes]."""

    wall: float
    step: float
    memory: float


def spheres(layers: Layers) -> str:
    """LIGGGHTS data file: a jittered grid 0.9 mm above the surface, radii 0.4 to 0.6 mm."""
    random = np.random.default_rng(1)
    n = layers.per_row
    i, j, layer = (a.ravel() for a in np.mgrid[0:n, 0:n, 0 : layers.layers])
    x, y = (SIDE / n * (a + 0.5 + random.uniform(-0.05, 0.05, a.size)) for a in (i, j))
    z = AMPLITUDE * np.sin(K * x) * np.sin(K * y) + 0.9e-3 + 1.25e-3 * layer
    radii = random.uniform(0.4e-3, 0.6e-3, x.size)
    z = lift(x, y, z, radii)
    rows = (f"{n} 1 {2 * r!r} 2500 {a!r} {b!r} {c!r}" for n, (r, a, b, c) in enumerate(zip(radii, x, y, z), 1))
    return (
        f"spheres above the wavy wall\n\n{layers.count} atoms\n2 atom types\n\n"
        f"0 {SIDE} xlo xhi\n0 {SIDE} ylo yhi\n-0.004 {z.max() + 4e-3!r} zlo zhi\n\nAtoms\n\n" + "\n".join(rows) + "\n"
    )


def lift(x: np.ndarray, y: np.ndarray, z: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Heights from which no two spheres overlap: of each pair that does, the upper one goes up."""
    while True:
        tree = cKDTree(np.stack([x, y, z], axis=1), boxsize=[SIDE, SIDE, 0.0])
        pairs = tree.query_pairs(2 * radii.max(), output_type="ndarray")
        upper = np.where(z[pairs[:, 0]] > z[pairs[:, 1]], 0, 1)
        high, low = (np.take_along_axis(pairs, side[:, None], axis=1)[:, 0] for side in (upper, 1 - upper))
        across = [(d - SIDE * np.round(d / SIDE)) ** 2 for d in (x[high] - x[low], y[high] - y[low])]
        needed = np.sqrt(np.maximum((radii[high] + radii[low]) ** 2 - sum(across), 0.0))
        missing = needed - (z[high] - z[low])
        if missing.max() <= 0.0:
            return z
        z = z.copy()
        np.maximum.at(z, high, z[high] + np.maximum(missing, 0.0) * (1.0 + 1e-6))


@dataclass
class Bench:
    """Runs decks in a folder of its own that holds decks, walls and states."""

    program: str
    clock: str
    folder: Path

    def run(self, deck: str, log: str, **variables: object) -> float:
        """Runs a deck; the largest memory of its process [bytes].  Raises if it fails."""
        words = [word for name, value in variables.items() for word in ("-var", name, str(value))]
        environment = dict(os.environ, LD_PRELOAD=self.clock)
        if os.geteuid() == 0:
            environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        with open(self.folder / log, "w", encoding="utf-8") as output:
            process = subprocess.Popen(
                [self.program, "-in", deck, "-log", "none", *words],
                cwd=self.folder,
                env=environment,
                stdout=output,
                stderr=subprocess.STDOUT,
            )
            _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            raise RuntimeError(f"{deck} {words} failed:\n{self.log(log)[-1500:]}")
        return 1024.0 * usage.ru_maxrss

    def log(self, log: str) -> str:
        return (self.folder / log).read_text(encoding="utf-8", errors="replace")

    def settle(self, name: str, particles: int) -> int:
        """Lets the layers come to rest on a wall; how many spheres touch it."""
        wall, layers = WALLS[name], LAYERS[particles]
        state = dict(spheres=f"spheres_{particles}.data", steps=layers.settle, state=f"state_{name}_{particles}")
        self.run("in.settle", "settle.txt", wall=wall.deck, geometry=wall.geometry, **state)
        rows = re.findall(r"^\s*\d+\s+\d+\s+\S+\s+(\d+)\s*$", self.log("settle.txt"), re.MULTILINE)
        return int(rows[-1])

    def time(self, name: str, particles: int) -> Timing:
        wall, layers = WALLS[name], LAYERS[particles]
        state = dict(state=f"state_{wall.settled_on}_{particles}", before=layers.before, steps=layers.timed)
        memory = self.run("in.time", "time.txt", wall=wall.deck, geometry=wall.geometry, **state)
        seconds, loop = fix_times(self.log("time.txt"))
        return Timing(sum(seconds.values()) / layers.timed, loop / layers.timed, memory)


def fix_times(log: str) -> tuple[dict[str, float], float]:
    """Of the last run: seconds of each fix that belongs to the wall, and of the whole loop."""
    last = log[log.rindex("Loop time of") :]
    fixes = re.findall(r"^Fix (\S+) \S+ time \(%\) = (\S+)", last, re.MULTILINE)
    wall = {name: float(seconds) for name, seconds in fixes if re.search("wall|mesh|motion", name)}
    return wall, float(last.split()[3])


def measure(bench: Bench, particles: int) -> list[Row]:
    """Rows of one number of particles; walls take turns."""
    timed = TIMED[particles]
    touching = {name: bench.settle(name, particles) for name in timed if WALLS[name].settled_on == name}
    times: dict[str, list[Timing]] = {name: [] for name in timed}
    for _ in range(REPEATS):
        for name in timed:
            times[name].append(bench.time(name, particles))
    wall = {name: statistics.median(t.wall for t in taken) for name, taken in times.items()}
    step = {name: statistics.median(t.step for t in taken) for name, taken in times.items()}
    case = f"{LAYERS[particles].count} particles"
    rows = [Row(case, f"{name}_touching", count, "1") for name, count in touching.items()]
    for name in timed:
        spread = [1e3 * t.wall for t in times[name]]
        note = f"{min(spread):.3g} to {max(spread):.3g}"
        rows.append(Row(case, f"{name}_wall_time_per_step", 1e3 * wall[name], "ms", note=note))
        rows.append(Row(case, f"{name}_time_per_step", 1e3 * step[name], "ms"))
    for (ours, theirs, number), bound in TARGETS.items():
        if number == particles:
            rows.append(AtMost(case, f"{ours}_over_{theirs}", wall[ours] / wall[theirs], "1", bound))
    if "nurbs_248" in wall:
        rows.append(Row(case, "nurbs_248_over_nurbs", wall["nurbs_248"] / wall["nurbs"], "1", note="16 x the elements"))
    return rows


def memory(bench: Bench) -> list[Row]:
    """Largest memory of a run on walls of growing numbers of elements, and what each further element takes."""
    layers = LAYERS[3500]
    largest = []
    for n in MEMORY_ELEMENTS:
        (bench.folder / f"wall_{n}.yaml").write_text(model_file(SplineWave(DEGREE, n), AMPLITUDE))
        variables = dict(spheres="spheres_3500.data", steps=1, state="state_memory", geometry=f"wall_{n}.yaml")
        largest.append(bench.run("in.settle", "memory.txt", wall="nurbs", **variables))
    case = f"memory, {layers.count} particles"
    taken = list(zip(MEMORY_ELEMENTS, largest))
    rows = [Row(case, f"{n}x{n}", m / 2**20, "MiB") for n, m in taken]
    for (n, m), (finer, more) in zip(taken, taken[1:]):
        rows.append(Row(case, f"per_element_{n}_to_{finer}", (more - m) / (finer**2 - n**2), "bytes"))
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("program")
    add("clock", help="libcpu_clock.so")
    add("out", type=Path)
    add("--particles", type=int, action="append", choices=list(LAYERS))
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(DECKS, folder, dirs_exist_ok=True)
        bench = Bench(args.program, args.clock, Path(folder))
        (bench.folder / "wall.stl").write_text(triangles(SQUARES, AMPLITUDE))
        for n in (62, 248):
            (bench.folder / f"wall_{n}.yaml").write_text(model_file(SplineWave(DEGREE, n), AMPLITUDE))
        for particles, layers in LAYERS.items():
            (bench.folder / f"spheres_{particles}.data").write_text(spheres(layers))
        rows += memory(bench)
        for particles in args.particles or LAYERS:
            rows += measure(bench, particles)
    write_json(args.out / "summary.json", "wavy_wall", rows)
    print(table(rows))
    print("\nMedians of thread CPU time, by LIGGGHTS' modify_timing.")


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-2.0-or-later
"""What the benchmarks of the wavy wall share: its spheres, its files, runs of the decks in wavy_wall/."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from study.build.waves import K, SIDE, SplineWave, model_file

DECKS = Path(__file__).parent / "wavy_wall"
AMPLITUDE = 2e-3  # [m]
DEGREE = 3
ELEMENTS = 62  # in a row, under the spheres


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


def spheres(layers: Layers, around: float = 0.0) -> str:
    """LIGGGHTS data file: a jittered grid 0.9 mm above the surface, radii 0.4 to 0.6 mm; the box is wider than the grid
    by `around` [m] on each side."""
    random = np.random.default_rng(1)
    n = layers.per_row
    i, j, layer = (a.ravel() for a in np.mgrid[0:n, 0:n, 0 : layers.layers])
    x, y = (SIDE / n * (a + 0.5 + random.uniform(-0.05, 0.05, a.size)) for a in (i, j))
    z = AMPLITUDE * np.sin(K * x) * np.sin(K * y) + 0.9e-3 + 1.25e-3 * layer
    radii = random.uniform(0.4e-3, 0.6e-3, x.size)
    z = lift(x, y, z, radii)
    rows = (f"{n} 1 {2 * r!r} 2500 {a!r} {b!r} {c!r}" for n, (r, a, b, c) in enumerate(zip(radii, x, y, z), 1))
    low, high = -around, SIDE + around
    return (
        f"spheres above the wavy wall\n\n{layers.count} atoms\n2 atom types\n\n"
        f"{low!r} {high!r} xlo xhi\n{low!r} {high!r} ylo yhi\n-0.004 {z.max() + 4e-3!r} zlo zhi\n\n"
        "Atoms\n\n" + "\n".join(rows) + "\n"
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
    convert: str  # nurbs-convert
    clock: str  # libcpu_clock.so
    folder: Path

    def run(self, deck: str, settings: dict[str, str] | None = None, **variables: object) -> str:
        """Runs a deck, with settings of the environment; what it printed.  Raises if it fails."""
        words = [word for name, value in variables.items() for word in ("-var", name, str(value))]
        environment = dict(os.environ, LD_PRELOAD=self.clock, **(settings or {}))
        if os.geteuid() == 0:
            environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(
            [self.program, "-in", deck, "-log", "none", *words],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            check=False,
        )
        if done.returncode != 0:
            raise RuntimeError(f"{deck} {words} failed:\n{done.stdout[-1500:]}")
        return done.stdout

    def continued_wall(self, elements: int) -> None:
        """Writes continued_N.yaml and continued_N.h5: the wall of 62 x 62 elements, continued around the spheres to
        N x N elements.  What lies under the spheres is the same in all of them, to the last bit."""
        around = (elements - ELEMENTS) // 2
        name = f"continued_{elements}"
        (self.folder / f"{name}.yaml").write_text(model_file(SplineWave(DEGREE, ELEMENTS), AMPLITUDE, around))
        convert = [self.convert, f"{name}.yaml", f"{name}.h5"]
        subprocess.run(convert, cwd=self.folder, check=True, stdout=subprocess.DEVNULL)

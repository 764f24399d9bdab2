# SPDX-License-Identifier: GPL-2.0-or-later
"""What the benchmarks of the wavy wall share: its spheres and its files."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from study.build.waves import K, SIDE, SplineWave, model_file
from wall_runs import WallRuns, data_file

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


def spheres(layers: Layers, around: float = 0.0, amplitude: float = AMPLITUDE) -> str:
    """LIGGGHTS data file: a jittered grid 0.9 mm above the surface of this amplitude [m], radii 0.4 to 0.6 mm; the box is wider than the grid
    by `around` [m] on each side."""
    random = np.random.default_rng(1)
    n = layers.per_row
    i, j, layer = (a.ravel() for a in np.mgrid[0:n, 0:n, 0 : layers.layers])
    x, y = (SIDE / n * (a + 0.5 + random.uniform(-0.05, 0.05, a.size)) for a in (i, j))
    z = amplitude * np.sin(K * x) * np.sin(K * y) + 0.9e-3 + 1.25e-3 * layer
    radii = random.uniform(0.4e-3, 0.6e-3, x.size)
    z = lift(x, y, z, radii)
    box = [(-around, SIDE + around), (-around, SIDE + around), (-0.004, float(z.max()) + 4e-3)]
    return data_file(box, radii, np.stack([x, y, z], axis=1))


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
class Bench(WallRuns):
    """Runs of the wavy wall."""

    convert: str  # nurbs-convert

    def continued_wall(self, elements: int) -> None:
        """Writes continued_N.yaml and continued_N.h5: the wall of 62 x 62 elements, continued around the spheres to
        N x N elements.  What lies under the spheres is the same in all of them, to the last bit."""
        around = (elements - ELEMENTS) // 2
        name = f"continued_{elements}"
        (self.folder / f"{name}.yaml").write_text(model_file(SplineWave(DEGREE, ELEMENTS), AMPLITUDE, around))
        convert = [self.convert, f"{name}.yaml", f"{name}.h5"]
        subprocess.run(convert, cwd=self.folder, check=True, stdout=subprocess.DEVNULL)

# SPDX-License-Identifier: GPL-2.0-or-later
"""A drum about the y axis, closed by flat caps: its NURBS and triangle files, particles to fill it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import Delaunay

from study.build.stl import stl


@dataclass(frozen=True)
class Drum:
    """radius and length [m]; the origin is its middle."""

    radius: float
    length: float

    def model_file(self, arcs: int, rows: int) -> str:
        """For `geometry`, surface `drum`: one closed cylinder and two discs with a pole in the middle, each of `arcs` x
        `rows` elements.  Exact: rational arcs (Piegl & Tiller 1997, section 7.3)."""
        shell, weights = self.circle(arcs)
        half = np.array([0.0, 0.5 * self.length, 0.0])
        knots = [repeated_knots(arcs, 2, 2), repeated_knots(rows, 1, 1)]
        patches = []
        for start, end in ((shell - half, shell + half), (0.0 * shell - half, shell - half), (0.0 * shell + half, shell + half)):
            points = [(1.0 - s) * a + s * b for s in np.linspace(0.0, 1.0, rows + 1) for a, b in zip(start, end)]
            patches.append(
                f"    - degrees: [2, 1]\n      knots: {knots}\n"
                f"      control_points: {[point.tolist() for point in points]}\n"
                f"      weights: {np.tile(weights, rows + 1).tolist()}\n"
            )
        return "units: si\ngeometry:\n  patches:\n" + "".join(patches) + "surfaces: {drum: all}\n"

    def circle(self, arcs: int) -> tuple[np.ndarray, np.ndarray]:
        """Control points (2 arcs + 1, 3) and weights of the cross-section at y = 0."""
        half = math.pi / arcs
        k = np.arange(2 * arcs + 1)
        weights = np.where(k % 2 == 0, 1.0, math.cos(half))
        points = np.column_stack([np.cos(half * k), 0.0 * k, np.sin(half * k)]) * (self.radius / weights)[:, None]
        points[-1] = points[0]
        return points, weights

    def triangles(self, facets: int) -> str:
        """STL of a cylinder of `facets` flat strips, corners on the circle, and its caps; strips are cut into triangles about
        four times as long as wide."""
        a = 2.0 * math.pi * np.arange(facets) / facets
        rim = self.radius * np.column_stack([np.cos(a), np.sin(a)])
        rows = max(1, round(self.length / (8.0 * math.pi * self.radius / facets)))
        y = 0.5 * self.length * np.linspace(-1.0, 1.0, rows + 1)
        corners = [[(x, height, z) for x, z in rim] for height in y]
        found = []
        for low, high in zip(corners, corners[1:]):
            for p, q, r, s in zip(low, np.roll(low, -1, 0), np.roll(high, -1, 0), high):
                found += [(p, q, r), (p, r, s)]
        flat = np.concatenate([rim, self.inner_points(self.length / rows)])
        for triangle in Delaunay(flat).simplices:
            found += [[(flat[k, 0], height, flat[k, 1]) for k in triangle] for height in y[[0, -1]]]
        return stl(found)

    def inner_points(self, spacing: float) -> np.ndarray:
        """A square grid in the cross-section, 0.6 spacings off the rim: (n, 2)."""
        grid = np.arange(-self.radius, self.radius, spacing)
        points = np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
        return points[np.hypot(*points.T) < self.radius - 0.6 * spacing]

    def bed(self, count: int, radii: tuple[float, float], seed: int) -> tuple[np.ndarray, np.ndarray]:
        """Centres (count, 3), the lowest of a hexagonal packing of the largest spheres, and radii, evenly distributed."""
        largest = max(radii)
        a = 2.001 * largest
        layer, row = math.sqrt(2.0 / 3.0) * a, math.sqrt(0.75) * a
        centres = []
        for k in range(int(2.0 * (self.radius - largest) / layer) + 1):
            for j in range(int((self.length - 2.0 * largest) / row - 1.0 / 3.0) + 1):
                x = (np.arange(-round(self.radius / a) - 1, round(self.radius / a) + 2) + 0.5 * ((j + k) % 2)) * a
                y = -0.5 * self.length + largest + (j + (k % 2) / 3.0) * row
                z = -self.radius + largest + k * layer
                centres += [(x, y, z) for x in x if math.hypot(x, z) < self.radius - largest]
        if len(centres) < count:
            raise ValueError(f"{count} particles do not fit into the drum, {len(centres)} do")
        return np.array(centres[:count]), np.random.default_rng(seed).uniform(*sorted(radii), count)


def repeated_knots(elements: int, degree: int, times: int) -> list[float]:
    """Open knots on [0, 1], each inner one `times` times."""
    inner = [k / elements for k in range(1, elements) for _ in range(times)]
    return [0.0] * (degree + 1) + inner + [1.0] * (degree + 1)


def atom_data(drum: Drum, centres: np.ndarray, radii: np.ndarray, density: float) -> str:
    """For read_data: particles of type 1 of 2 in a box a tenth larger than the drum."""
    half = 1.1 * np.array([drum.radius, 0.5 * drum.length, drum.radius])
    box = "".join(f"{-h!r} {h!r} {axis}lo {axis}hi\n" for axis, h in zip("xyz", half.tolist()))
    lines = (
        f"{tag} 1 {2.0 * r!r} {density!r} {x!r} {y!r} {z!r}\n"
        for tag, (r, (x, y, z)) in enumerate(zip(radii.tolist(), centres.tolist()), start=1)
    )
    return f"particles in a drum\n\n{len(radii)} atoms\n2 atom types\n{box}\nAtoms\n\n" + "".join(lines)

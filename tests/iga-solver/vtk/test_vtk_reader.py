# SPDX-License-Identifier: GPL-2.0-or-later
"""VTK's own reader and cells against scipy's B-splines: positions, fields and their order in our .vtu files."""

from __future__ import annotations

import os
import subprocess
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import vtk
from scipy.interpolate import BSpline
from vtk.util.numpy_support import vtk_to_numpy

WRITE = os.environ.get("WRITE_VTU_SAMPLE", "write_vtu_sample")
POINTS_PER_CASE = 100


@dataclass
class Patch:
    """A tensor-product NURBS patch; arrays per control point, first direction fastest."""

    degrees: list[int]
    knots: list[np.ndarray]
    weights: np.ndarray | None
    points: np.ndarray  # n x 3
    scalar: np.ndarray  # n x 1
    vector: np.ndarray  # n x 3
    number: np.ndarray  # per element

    def text(self) -> str:
        words: list = []
        for degree, knots in zip(self.degrees, self.knots):
            words += [degree, len(knots), *knots]
        words += [0] if self.weights is None else [1, *self.weights]
        words += [*self.points.ravel(), *self.scalar.ravel(), *self.vector.ravel(), *self.number]
        return " ".join(repr(w) if isinstance(w, int) else f"{w:.17g}" for w in words)

    def breaks(self, direction: int) -> np.ndarray:
        return np.unique(self.knots[direction])

    def element_counts(self) -> list[int]:
        return [len(self.breaks(d)) - 1 for d in range(len(self.degrees))]

    def value(self, values: np.ndarray, xi: np.ndarray) -> np.ndarray:
        """sum_A R_A(xi) values_A"""
        N = np.ones(1)
        for degree, knots, x in zip(self.degrees, self.knots, xi):
            basis = BSpline(knots, np.eye(len(knots) - degree - 1), degree)(x)
            N = np.outer(basis, N).ravel()
        R = N if self.weights is None else N * self.weights / (N @ self.weights)
        return R @ values


def random_patch(random: np.random.Generator, degrees: list[int], rational: bool) -> Patch:
    """Knots unevenly spaced and in part repeated; a jittered grid: every edge is curved differently."""
    knots = []
    for degree in degrees:
        inner = np.cumsum(random.uniform(0.2, 1.0, 4))
        inner = np.repeat(inner[:3], [1, random.integers(1, degree + 1), 1])
        knots.append(np.concatenate([np.zeros(degree + 1), inner, np.full(degree + 1, inner[-1] + 0.7)]))
    shape = [len(k) - p - 1 for k, p in zip(knots, degrees)]
    grid = np.meshgrid(*[np.linspace(0.0, 1.0, n) for n in shape], indexing="ij")
    points = np.stack([g.ravel(order="F") for g in grid] + [np.zeros(np.prod(shape))] * (3 - len(shape)), axis=1)
    count = len(points)
    elements = int(np.prod([len(np.unique(k)) - 1 for k in knots]))
    return Patch(
        degrees,
        knots,
        random.uniform(0.5, 2.0, count) if rational else None,
        points + random.uniform(-0.08, 0.08, (count, 3)),
        random.uniform(-1.0, 1.0, (count, 1)),
        random.uniform(-1.0, 1.0, (count, 3)),
        random.uniform(-1.0, 1.0, elements),
    )


def read(patches: list[Patch], folder: str) -> vtk.vtkUnstructuredGrid:
    path = str(Path(folder) / "sample.vtu")
    head = f"{len(patches[0].degrees)} {len(patches)} "
    subprocess.run([WRITE, path], input=head + "\n".join(p.text() for p in patches), text=True, check=True)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    assert reader.GetErrorCode() == 0
    grid = vtk.vtkUnstructuredGrid()
    grid.DeepCopy(reader.GetOutput())
    return grid


class VtkReader(unittest.TestCase):
    def largest_error(self, patches: list[Patch], random: np.random.Generator) -> float:
        """Of positions and fields at random points inside random cells, and of the constants of these cells."""
        with tempfile.TemporaryDirectory() as folder:
            grid = read(patches, folder)
        dimension = len(patches[0].degrees)
        sizes = [int(np.prod(p.element_counts())) for p in patches]
        self.assertEqual(grid.GetNumberOfCells(), sum(sizes))
        point_data = grid.GetPointData()
        data = {n: vtk_to_numpy(point_data.GetArray(n)).reshape(-1, c) for n, c in (("scalar", 1), ("vector", 3))}
        number = vtk_to_numpy(grid.GetCellData().GetArray("number"))
        worst = 0.0
        for _ in range(POINTS_PER_CASE):
            which = random.integers(len(patches))
            patch, element = patches[which], random.integers(sizes[which])
            cell_id = sum(sizes[:which]) + element
            t = random.uniform(0.0, 1.0, dimension)
            indices = np.unravel_index(element, patch.element_counts(), order="F")
            xi = [patch.breaks(d)[i] + t[d] * np.diff(patch.breaks(d))[i] for d, i in enumerate(indices)]

            cell = grid.GetCell(cell_id)
            position, R = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
            cell.EvaluateLocation(vtk.mutable(0), [*t, 0.0][:3], position, R)
            ids = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
            worst = max(
                worst,
                np.abs(position - patch.value(patch.points, xi)).max(),
                np.abs(R @ data["scalar"][ids] - patch.value(patch.scalar, xi)).max(),
                np.abs(R @ data["vector"][ids] - patch.value(patch.vector, xi)).max(),
                abs(number[cell_id] - patch.number[element]),
            )
        return worst

    def test_positions_and_fields(self):
        random = np.random.default_rng(4)
        for degrees in ([2, 2], [3, 3], [2, 3], [1, 4], [2, 2, 2], [3, 3, 3], [3, 2, 4]):
            for rational in (False, True):
                with self.subTest(degrees=degrees, rational=rational):
                    patch = random_patch(random, degrees, rational)
                    self.assertLess(self.largest_error([patch], random), 1e-12)

    def test_patches_of_several_degrees_in_one_file(self):
        random = np.random.default_rng(5)
        patches = [random_patch(random, [2, 2], True), random_patch(random, [3, 1], False)]
        self.assertLess(self.largest_error(patches, random), 1e-12)

    def test_elements_of_a_patch_share_points(self):
        """p n + 1 points in a direction of n elements; hence the inner faces of a solid are not drawn."""
        random = np.random.default_rng(6)
        patch = random_patch(random, [2, 3, 2], True)
        with tempfile.TemporaryDirectory() as folder:
            grid = read([patch], folder)
        n = patch.element_counts()
        expected = np.prod([p * m + 1 for p, m in zip(patch.degrees, n)])
        self.assertEqual(grid.GetNumberOfPoints(), expected)
        skin = vtk.vtkDataSetSurfaceFilter()
        skin.SetInputData(grid)
        skin.SetNonlinearSubdivisionLevel(0)
        skin.Update()
        faces = 2 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0])
        self.assertEqual(skin.GetOutput().GetNumberOfCells(), faces)

    def test_a_quarter_of_a_cylinder_is_drawn_round(self):
        """What ParaView draws (non-linear subdivision) has the radius of the cylinder."""
        s = np.sqrt(0.5)
        arc = np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        points = np.array([[*xy, z] for z in (0.0, 1.0) for xy in arc])
        knots = [np.array([0.0, 0, 0, 1, 1, 1]), np.array([0.0, 0, 1, 1])]
        weights = np.array([1.0, s, 1.0] * 2)
        patch = Patch([2, 1], knots, weights, points, points[:, 2:], points, np.zeros(1))
        with tempfile.TemporaryDirectory() as folder:
            grid = read([patch], folder)
        drawing = vtk.vtkDataSetSurfaceFilter()
        drawing.SetInputData(grid)
        drawing.SetNonlinearSubdivisionLevel(4)
        drawing.Update()
        drawn = vtk_to_numpy(drawing.GetOutput().GetPoints().GetData())
        self.assertGreater(len(drawn), 100)
        np.testing.assert_allclose(np.hypot(drawn[:, 0], drawn[:, 1]), 1.0, atol=1e-6)
        height = vtk_to_numpy(drawing.GetOutput().GetPointData().GetArray("scalar"))
        np.testing.assert_allclose(height, drawn[:, 2], atol=1e-6)


if __name__ == "__main__":
    unittest.main()

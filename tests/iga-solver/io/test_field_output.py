# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields for ParaView that iga-solve writes, as VTK reads them: displacements against probes, stresses against Hooke's law on
strains that are taken from VTK's own cells by differences, energies against the history; times, units, places, ranks."""

import os
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

PROGRAM = os.environ["IGA_SOLVE"]
MPIEXEC = os.environ["MPIEXEC"]
E, NU = 7.4e4, 0.23
FIELDS = "[displacement, velocity, stress, principal_stress, von_mises, energy_density]"
PLATE = f"""units: mm-g-ms
geometry: {{geometry}}
material: {{{{law: {{law}}, youngs_modulus: {E}, poissons_ratio: {NU}, density: 2.48e-3}}}}
boundary: [{{{{fix: [x, y, z], faces: [xi-]}}}}]
surfaces: {{{{top: zeta+, sides: [0 eta-, 0 eta+]}}}}
probes: {{{{tip: {{{{face: xi+, at: [0.3, 0.7]}}}}}}}}
loads: {{{{tractions: [{{{{face: zeta+, value: [0, 0.2, -1]}}}}]}}}}
output: {{{{every: 0.01, file: plate, fields: {{fields}}}}}}
time: {{{{end: {{end}}}}}}
"""
BOX = "{box: {origin: [0, 0, 0], size: [40, 36, 4], elements: [6, 5, 2], degree: [2, 3, 2]}}"
TUBE = "{tube: {origin: [0, 0, 0], axis: [0, 0, 1], inner_radius: 8, outer_radius: 10, length: 20, angle: [0, 120], elements: [8, 8, 2]}}"


def plate(geometry=BOX, law="linear_elastic", fields=FIELDS, end=0.0401) -> str:
    return PLATE.format(geometry=geometry, law=law, fields=fields, end=end)


def read(path: Path) -> vtk.vtkUnstructuredGrid:
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    grid = vtk.vtkUnstructuredGrid()
    grid.DeepCopy(reader.GetOutput())
    return grid


class Cell:
    """One cell of a grid: its points and fields at parameters t (0 to 1), by VTK's own shape functions."""

    def __init__(self, grid: vtk.vtkUnstructuredGrid, number: int):
        self.cell = grid.GetCell(number)
        ids = [self.cell.GetPointId(k) for k in range(self.cell.GetNumberOfPoints())]
        data = grid.GetPointData()
        self.values = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))[ids] for i in range(data.GetNumberOfArrays())}

    def __call__(self, t, name: str = "") -> np.ndarray:
        place, R = [0.0] * 3, [0.0] * self.cell.GetNumberOfPoints()
        self.cell.EvaluateLocation(vtk.mutable(0), [*t, 0.0][:3], place, R)
        return np.array(R) @ self.values[name] if name else np.array(place)

    def gradient(self, t, name: str = "") -> np.ndarray:
        """d value_i / d t_j by central differences."""
        h = 1e-4
        return np.stack([(self(t + h * e, name) - self(t - h * e, name)) / (2 * h) for e in np.eye(len(t))], axis=-1)

    def displacement_gradient(self, t) -> np.ndarray:
        return self.gradient(t, "displacement") @ np.linalg.inv(self.gradient(t))


def hooke(strain: np.ndarray) -> np.ndarray:
    return E / (1 + NU) * (strain + NU / (1 - 2 * NU) * np.trace(strain) * np.eye(3))


def tensor(six: np.ndarray) -> np.ndarray:
    xx, yy, zz, xy, yz, xz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def gauss(n: int):
    points, weights = np.polynomial.legendre.leggauss(n)
    return 0.5 * (points + 1.0), 0.5 * weights


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def solve(self, model: str, *words: str, ranks: int = 1, code: int = 0) -> str:
        (self.folder / "plate.yaml").write_text(model)
        launcher = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
        done = subprocess.run(
            [*launcher, PROGRAM, "plate.yaml", *words], cwd=self.folder, capture_output=True, text=True, timeout=60, check=False
        )
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout + done.stderr

    def states(self, place: str) -> list[tuple[float, str]]:
        entries = ElementTree.parse(self.folder / f"plate_{place}.pvd").getroot().iter("DataSet")
        return [(float(entry.get("timestep")), entry.get("file")) for entry in entries]

    def last(self, place: str) -> vtk.vtkUnstructuredGrid:
        return read(self.folder / self.states(place)[-1][1])

    def history(self, name: str) -> np.ndarray:
        with h5py.File(self.folder / "plate.h5") as file:
            return file[name][()]


class Volume(Folder):
    def test_displacement_is_that_of_the_probe(self):
        for geometry, tip in ((BOX, (4, 1, 0.5, 0.4)), (TUBE, (5, 1, 0.4, 0.4))):
            self.solve(plate(geometry))
            grid = self.last("volume")
            # element and place in it of (1, 0.3, 0.7), 5 x 2 or 8 x 2 elements along the two other directions
            n = (6, 5, 2) if geometry is BOX else (8, 8, 2)
            eta, zeta = 0.3 * n[1], 0.7 * n[2]
            number = n[0] - 1 + n[0] * (int(eta) + n[1] * int(zeta))
            there = Cell(grid, number)(np.array([1.0, eta % 1, zeta % 1]), "displacement")
            expected = self.history("probes/tip")[-1]
            self.assertGreater(np.abs(expected).max(), 1e-3)
            np.testing.assert_allclose(there, expected, rtol=0, atol=1e-13 * np.abs(expected).max())

    def test_stress_is_hookes_everywhere(self):
        """On an affine patch the stress of the small strain lies in the cells' own space."""
        self.solve(plate())
        grid, random = self.last("volume"), np.random.default_rng(1)
        largest = np.abs(vtk_to_numpy(grid.GetPointData().GetArray("stress"))).max()
        for number in random.integers(grid.GetNumberOfCells(), size=30):
            cell, t = Cell(grid, number), random.uniform(0.01, 0.99, 3)
            H = cell.displacement_gradient(t)
            np.testing.assert_allclose(tensor(cell(t, "stress")), hooke(0.5 * (H + H.T)), rtol=0, atol=1e-6 * largest)

    def test_stress_of_a_bent_tube_is_cauchys(self):
        """Rational, with a C0 line, large strain: between Gauss points up to the error of the projection."""
        self.solve(plate(TUBE, "saint_venant_kirchhoff", end=0.1))
        grid, random = self.last("volume"), np.random.default_rng(2)
        errors, sizes = [], []
        for number in random.integers(grid.GetNumberOfCells(), size=60):
            cell, t = Cell(grid, number), random.uniform(0.01, 0.99, 3)
            F = np.eye(3) + cell.displacement_gradient(t)
            expected = F @ hooke(0.5 * (F.T @ F - np.eye(3))) @ F.T / np.linalg.det(F)
            errors.append(np.linalg.norm(tensor(cell(t, "stress")) - expected))
            sizes.append(np.linalg.norm(expected))
            self.assertGreater(np.linalg.det(F), 0.5)
        self.assertLess(np.sqrt(np.mean(np.square(errors)) / np.mean(np.square(sizes))), 0.05)

    def test_what_follows_from_stress_does_so_at_gauss_points_of_inner_elements(self):
        """One element: nothing is averaged."""
        self.solve(plate("{box: {origin: [0, 0, 0], size: [4, 3, 4], elements: [1, 1, 1], degree: 3}}"))
        cell = Cell(self.last("volume"), 0)
        points, weights = gauss(4)
        energy = 0.0
        for i, x in enumerate(points):
            for j, y in enumerate(points):
                for k, z in enumerate(points):
                    t = np.array([x, y, z])
                    H = cell.displacement_gradient(t)
                    strain = 0.5 * (H + H.T)
                    stress = hooke(strain)
                    size = np.abs(stress).max()
                    principal = np.linalg.eigvalsh(stress)[::-1]
                    np.testing.assert_allclose(cell(t, "principal_stress"), principal, rtol=0, atol=1e-6 * size)
                    a, b, c = principal
                    mises = np.sqrt(0.5 * ((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2))
                    np.testing.assert_allclose(cell(t, "von_mises"), mises, rtol=0, atol=1e-6 * size)
                    density = cell(t, "energy_density")
                    np.testing.assert_allclose(density, 0.5 * np.sum(stress * strain), rtol=1e-5)
                    energy += weights[i] * weights[j] * weights[k] * 48.0 * float(density)
        np.testing.assert_allclose(energy, self.history("strain_energy")[-1], rtol=1e-10)

    def test_velocity(self):
        free = plate().replace("boundary: [{fix: [x, y, z], faces: [xi-]}]\n", "")
        self.solve(free.replace("loads:", "initial: {velocity: [1, 2, 3]}\nloads:"))
        first = Cell(read(self.folder / self.states("volume")[0][1]), 7)
        np.testing.assert_allclose(first(np.array([0.2, 0.7, 0.4]), "velocity"), [1, 2, 3], rtol=1e-14)


class Places(Folder):
    def test_skin_and_surfaces_are_the_volume_there(self):
        self.solve(plate(TUBE, "saint_venant_kirchhoff", f"{{of: {FIELDS}, steps: 40, on: [volume, top, sides, skin]}}"))
        self.assertEqual(self.last("sides").GetNumberOfCells(), 2 * 8 * 2)
        self.assertEqual(self.last("skin").GetNumberOfCells(), 2 * (8 * 8 + 8 * 2 + 8 * 2))
        volume, top = self.last("volume"), self.last("top")
        self.assertEqual(top.GetNumberOfCells(), 64)
        for number in (0, 9, 27, 63):
            for s, t in ((0.1, 0.6), (0.8, 0.3)):
                for name in ("", *Cell(top, 0).values):
                    if name != "weights":
                        on_top = Cell(top, number)(np.array([s, t]), name)
                        inside = Cell(volume, 64 + number)(np.array([s, t, 1.0]), name)
                        np.testing.assert_allclose(on_top, inside, rtol=1e-12, atol=1e-12 * np.abs(inside).max())

    def test_a_surface_alone_is_the_same(self):
        fields = f"{{of: {FIELDS}, every: 0.01, on: [sides]}}"
        self.solve(plate(TUBE, fields=fields))
        alone = (self.folder / "plate_sides_3.vtu").read_bytes()
        self.assertFalse((self.folder / "plate_volume.pvd").exists())
        self.solve(plate(TUBE, fields=fields.replace("[sides]", "[sides, volume]")))
        self.assertEqual((self.folder / "plate_sides_3.vtu").read_bytes(), alone)


class Series(Folder):
    def test_times_and_units(self):
        printed = self.solve(plate())
        self.assertIn("fields       plate_volume.pvd", printed)
        states = self.states("volume")
        np.testing.assert_array_equal([time for time, _ in states], self.history("time"))
        self.assertEqual([file for _, file in states], [f"plate_volume_{i}.vtu" for i in range(5)])
        grid = self.last("volume")
        self.assertEqual(grid.GetFieldData().GetArray("TimeValue").GetValue(0), states[-1][0])
        self.assertIn("mm-g-ms: coordinates in mm, time in ms", grid.GetFieldData().GetAbstractArray("UNITS").GetValue(0))
        data = grid.GetPointData()
        units = dict(displacement="mm", velocity="mm/ms", stress="MPa", principal_stress="MPa", von_mises="MPa",
                     energy_density="mJ/mm^3")  # fmt: skip
        for name, unit in units.items():
            self.assertEqual(data.GetArray(name).GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL()), unit, name)
        self.assertEqual([data.GetArray("stress").GetComponentName(i) for i in range(6)], ["XX", "YY", "ZZ", "XY", "YZ", "XZ"])
        self.assertFalse(list(self.folder.glob("*.part")))

    def test_every_so_many_steps(self):
        self.solve(plate(fields="{of: [displacement], steps: 7}", end=0.01), "--step", "0.0001")
        times = np.array([time for time, _ in self.states("volume")])
        np.testing.assert_allclose(times, 0.0007 * np.arange(15), rtol=1e-12)

    def test_an_own_interval(self):
        self.solve(plate(fields="{of: [von_mises], every: 0.02}"))
        self.assertEqual(len(self.states("volume")), 3)
        self.assertEqual(self.last("volume").GetPointData().GetNumberOfArrays(), 1)

    def test_ranks_write_the_same_bytes(self):
        box = "{box: {origin: [0, 0, 0], size: [40, 36, 4], elements: [40, 36, 2], degree: 2}}"
        model = plate(box, "saint_venant_kirchhoff", f"{{of: {FIELDS}, steps: 30, on: [volume, top]}}", end=0.012)
        self.solve(model)
        written = {path.name: path.read_bytes() for path in self.folder.glob("plate_*")}
        self.assertGreater(len(written), 6)
        for ranks in (2, 4):
            for name in written:
                (self.folder / name).unlink()
            self.solve(model, ranks=ranks)
            for name, content in written.items():
                self.assertEqual((self.folder / name).read_bytes(), content, f"{name} on {ranks} ranks")

    def test_a_folder_that_is_not_there(self):
        said = self.solve(plate().replace("file: plate", "file: no/plate"), code=1)
        self.assertIn("no/plate", said)


if __name__ == "__main__":
    unittest.main()

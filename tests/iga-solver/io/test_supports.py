# SPDX-License-Identifier: GPL-2.0-or-later
"""Supports of iga-solve: motion in time beside the theory of waves, symmetry beside the whole body, selections; ranks."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

PROGRAM = os.environ["IGA_SOLVE"]
MPIEXEC = os.environ["MPIEXEC"]
E, RHO, AREA = 2e11, 8000.0, 1e-4
C = (E / RHO) ** 0.5
# 100 x 1 x 1: waves along x alone
BAR = """units: si
geometry: {{box: {{origin: [0, 0, 0], size: [1, 0.01, 0.01], elements: [100, 1, 1], degree: [2, 1, 1]}}}}
material: {{law: linear_elastic, youngs_modulus: 2e11, poissons_ratio: 0, density: 8000}}
boundary:
  - {{name: wall, fix: [x], faces: [xi-]}}
  - {{name: hand, {move}, faces: [xi+]}}
  - {{fix: [y, z], faces: [eta-, eta+, zeta-, zeta+]}}
output: {{every: 1e-9, file: out}}
"""
PLATE = """units: si
geometry: {{box: {{origin: {origin}, size: {size}, elements: {elements}, degree: {degree}}}}}
material: {{law: saint_venant_kirchhoff, youngs_modulus: 7.4e10, poissons_ratio: 0.23, density: 2480}}
boundary: [{boundary}]
loads: {{tractions: [{{face: zeta+, value: [0, 0, -1e8]}}]}}
probes: {{middle: {{face: zeta-, at: {middle}}}}}
output: {{every: 1e-9, file: out}}
"""


def series_of(folder: str) -> dict[str, np.ndarray]:
    series = {}
    with h5py.File(Path(folder) / "out.h5") as file:
        file.visititems(lambda name, item: series.__setitem__(name, item[...]) if hasattr(item, "shape") else None)
    return series


def run(model: str, end: float, step: float, ranks: int = 1) -> tuple[subprocess.CompletedProcess, dict]:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "model.yaml").write_text(model)
        launcher = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
        command = [*launcher, PROGRAM, "model.yaml", "--end", repr(end), "--step", repr(step), "--quiet"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
        return done, series_of(folder) if done.returncode == 0 else {}


class Supports(unittest.TestCase):
    def solve(self, *arguments, **keywords) -> dict[str, np.ndarray]:
        done, series = run(*arguments, **keywords)
        self.assertEqual(done.returncode, 0, done.stderr)
        return series

    def balance(self, seen: dict[str, np.ndarray]) -> None:
        left = seen["kinetic_energy"] + seen["ledger/internal"] - seen["ledger/loads"] - seen["ledger/supports"]
        np.testing.assert_allclose(left, left[0], rtol=0, atol=1e-12 * seen["kinetic_energy"].max())

    def test_an_end_that_is_drawn(self):
        """With v from time 0: rho c v until the wave comes back, at 2 L / c; the fixed end feels twice that after L / c.  Then
        it stops, and pushes as much."""
        v, stop = 3.0, 0.5 / C
        seen = self.solve(BAR.format(move=f"move: {{x: {v * stop}}}, time: {{ramp: [0, {stop}]}}"), 1.9 / C, 2e-7)
        hand, wall, time = seen["reactions/hand"][:, 0], seen["reactions/wall"][:, 0], seen["time"] * C
        size = RHO * C * v * AREA
        self.assertAlmostEqual(hand[(time > 0.05) & (time < 0.45)].mean() / size, 1, delta=1e-2)
        self.assertAlmostEqual(hand[(time > 0.7) & (time < 1.9)].mean() / size, 0, delta=2e-2)
        self.assertAlmostEqual(wall[(time > 1.1) & (time < 1.4)].mean() / size, -2, delta=2e-2)
        self.balance(seen)
        # what the hand has done is a wave of half a length: half of it motion, half of it strain
        middle = (time > 0.6) & (time < 0.9)
        work = size * v * stop
        for name, expected in (("ledger/supports", work), ("kinetic_energy", work / 2), ("strain_energy", work / 2)):
            self.assertAlmostEqual(seen[name][middle].mean() / expected, 1, delta=1e-2, msg=name)

    def test_a_table(self):
        """An end moved by a (1 - cos w t): the waves that it sends are reflected at both ends, so the wall feels
        2 E A / c g'(t - (2 k + 1) L / c), k = 0, 1, ... (d'Alembert)."""
        w, a, step = 2 * np.pi * 4000.0, 1e-5, 1e-6
        rows = ", ".join(f"[{t!r}, {1 - np.cos(w * t)!r}]" for t in np.arange(0, 6 / C + 2 * step, step))
        seen = self.solve(BAR.format(move=f"move: {{x: {a}}}, time: {{table: [{rows}]}}"), 6 / C, step)
        self.balance(seen)
        expected = np.zeros_like(seen["time"])
        for arrival in (1 / C, 3 / C, 5 / C):
            since = seen["time"] - arrival
            expected += np.where(since > 0, -2 * E * AREA / C * a * w * np.sin(w * since), 0)
        away = np.all([np.abs(seen["time"] * C - front) > 0.3 for front in (1, 3, 5)], axis=0)  # from kinks, which the mesh rounds
        np.testing.assert_allclose(seen["reactions/wall"][away, 0], expected[away], rtol=0, atol=0.02 * np.abs(expected).max())

    def test_symmetry_is_half_a_body(self):
        """To round-off where functions have a kink in the middle, as all have of degree 1."""
        whole = self.solve(PLATE.format(origin="[-0.02, 0, 0]", size="[0.04, 0.012, 0.004]", elements="[8, 3, 2]", degree="[1, 2, 2]",
            middle="[0.5, 0.3]", boundary="{fix: [x, y, z], faces: [xi-, xi+]}"), 4e-6, 2e-8)
        half = self.solve(PLATE.format(origin="[-0.02, 0, 0]", size="[0.02, 0.012, 0.004]", elements="[4, 3, 2]", degree="[1, 2, 2]",
            middle="[1, 0.3]", boundary="{fix: [x, y, z], faces: [xi-]}, {name: mirror, symmetry: xi+}"), 4e-6, 2e-8)
        deflection = np.abs(whole["probes/middle"]).max()
        np.testing.assert_allclose(half["probes/middle"], whole["probes/middle"], rtol=0, atol=1e-11 * deflection)
        np.testing.assert_allclose(2 * half["strain_energy"], whole["strain_energy"], rtol=1e-9)
        self.assertGreater(np.abs(half["reactions/mirror"][:, 0]).max(), 1.0)
        self.assertTrue((half["reactions/mirror"][:, 1:] == 0).all(), "along its normal alone")

    def test_selections(self):
        """As many fixed degrees of freedom as the control points there: 6 x 5 x 4 of them."""
        for where, count in (("faces: [xi-, eta-]", 5 * 4 + 6 * 4 - 4), ("edge: [xi-, eta+]", 4), ("corner: [xi-, eta+, zeta-]", 1),
                             ("patch: 0", 120), ("box: [[0, 0, 0], [0.01, 1, 0]]", 2 * 5)):
            self.check_selected(PLATE.format(origin="[0, 0, 0]", size="[0.04, 0.012, 0.004]", elements="[4, 3, 2]", degree=2,
                                             middle="[0, 0]", boundary=f"{{fix: [x, y], {where}}}"), 2 * count)  # fmt: skip

    def check_selected(self, model: str, dofs: int) -> None:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "model.yaml").write_text(model)
            done = subprocess.run([PROGRAM, "model.yaml", "--end", "1e-9"], cwd=folder, capture_output=True, text=True,
                                  timeout=60, check=False)  # fmt: skip
            self.assertIn(f"{dofs} of them fixed", done.stdout, model)

    def test_the_borders_of_a_box_are_within_round_off(self):
        """0.1 + 0.2 is not 0.3; nor are turned control points where they are meant to be.  What is off by more is off."""
        plate = PLATE.format(origin="[0.1, 0.1, 0.1]", size="[0.2, 0.6, 0.3]", elements="[2, 3, 3]", degree=1, middle="[0, 0]",
                             boundary="{fix: [x], box: [[0.1, 0.1, 0.1], [0.3, 0.7, 0.1]]}")  # fmt: skip
        self.check_selected(plate, 3 * 4)
        self.check_selected(plate.replace("[0.3, 0.7, 0.1]", "[0.299999, 0.7, 0.1]"), 2 * 4)
        turned = PLATE.format(origin="[0, 0, 0]", size="[1, 0.4, 0.3]", elements="[4, 2, 2]", degree=2, middle="[0, 0]",
                              boundary="{fix: [x], box: [[0.2, 0, 0], [0.2, 0.4, 0.3]]}")  # fmt: skip
        turned = turned.replace("degree: 2}", "degree: 2}, rotate: {origin: [0.1, 0.2, 0.3], axis: [0, 0, 1], angle: 180}")
        self.check_selected(turned, 4 * 4)

    def test_ranks(self):
        model = PLATE.format(origin="[0, 0, 0]", size="[0.04, 0.036, 0.004]", elements="[40, 36, 2]", degree=2, middle="[0.5, 0.5]",
            boundary="{name: left, fix: [x, y, z], faces: [xi-]}, "
            "{name: right, move: {z: 1e-6, x: 2e-7}, faces: [xi+, eta+], time: {sine: {frequency: 1e6}}}")  # fmt: skip
        one = self.solve(model, 5e-7, 2e-8)
        self.balance(one)
        for ranks in (2, 4):
            more = self.solve(model, 5e-7, 2e-8, ranks)
            for name, values in one.items():
                np.testing.assert_array_equal(more[name], values, err_msg=name)

    def test_errors(self):
        tube = "geometry: {tube: {origin: [0, 0, 0], axis: [0, 0, 1], inner_radius: 1, outer_radius: 2, length: 1, angle: [0, 90], elements: [2, 2, 1]}}"
        box = PLATE.splitlines()[1].format(origin="[0, 0, 0]", size="[1, 1, 1]", elements="[2, 2, 2]", degree=2)
        for geometry, boundary, expected in (
            (tube, "{symmetry: zeta+}", "model.yaml:4: symmetry has zeta+, which extends by 2, 2, 1 along x, y, z, expected"),
            (box, "{symmetry: zeta}", "model.yaml:4: unknown face 'zeta'"),
            (box, "{fix: [x]}", "model.yaml:4: nothing says where it acts"),
            (box, "{fix: [x], faces: [xi-], box: [[0, 0, 0], [1, 1, 1]]}", "model.yaml:4: more than one key says"),
            (box, "{fix: [x], edge: [xi-, xi+]}", "model.yaml:4: edge has no control points"),
            (box, "{fix: [x], edge: [xi-, xi-]}", "model.yaml:4: edge has xi- twice, expected 2 faces that meet there"),
            (box, "{fix: [x], corner: [xi-, xi-, eta-]}", "model.yaml:4: corner has xi- twice, expected 3 faces that meet there"),
            (box, "{spring: {stiffness: 1}, faces: [xi-, eta-, xi-]}", "model.yaml:4: faces has xi- twice, expected once"),
            (box, "{spring: {stiffness: 1}, faces: [xi-], patch: [0, 0]}", "model.yaml:4: patch has 0 twice, expected once"),
            (box, "{fix: [x], edge: [xi-]}", "model.yaml:4: edge has 1 faces, expected 2"),
            (box, "{fix: [x], box: [[0.1, 0.1, 0.1], [0.2, 0.2, 0.2]]}", "model.yaml:4: box has no control points"),
            (box, "{fix: [x], box: [[1, 0, 0], [0, 2, 2]]}", "expected the lowest corner first"),
            (box, "{fix: [x], patch: 1}", "boundary[0].patch is 1, expected a whole number from 0 to 0"),
            (box, "{move: {w: 1}, faces: [xi-]}", "unknown key 'w'"),
            (box, "{move: {x: 1}, fix: [y], faces: [xi-]}", "2 of 'fix', 'move', 'spring', 'symmetry', expected one"),
            (box, "{fix: [x], faces: [xi-], time: {ramp: [0, 1]}}", "time is given for what does not move"),
            (box, "{move: {x: 1}, faces: [xi-], time: {ramp: [1, 0]}}", "expected two rising times"),
            (box, "{move: {x: 1}, faces: [xi-], time: {}}", "time has 0 keys"),
            (box, "{move: {x: 1}, faces: [xi-], time: {table: [[0, 1], [0, 2]]}}", "table: time 0 follows 0"),
            (box, "{move: {x: 1}, faces: [xi-], time: {sine: {frequency: 0}}}", "frequency is 0, expected a number > 0"),
        ):
            text = "\n".join(["units: si", geometry, PLATE.splitlines()[2].format(), f"boundary: [{boundary}]", ""])
            done, _ = run(text, 1e-9, 1e-9)
            self.assertNotEqual(done.returncode, 0, boundary)
            self.assertIn(expected, done.stderr, boundary)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()

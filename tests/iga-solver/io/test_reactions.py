# SPDX-License-Identifier: GPL-2.0-or-later
"""Reactions of named supports and the ledger in histories of iga-solve: the change of momentum in each step, the wave in a
bar, weights at rest on average, kinetic energy, the order of the truncation; ranks."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

PROGRAM = os.environ["IGA_SOLVE"]
MPIEXEC = os.environ["MPIEXEC"]
E, RHO = 2e11, 8000.0
C = (E / RHO) ** 0.5  # of a bar that cannot get thinner, nu = 0
# 100 x 1 x 1: waves along x alone
BAR = """units: si
geometry: {{box: {{origin: [0, 0, 0], size: [1, 0.01, 0.01], elements: [100, 1, 1], degree: [2, 1, 1]}}}}
material: {{law: linear_elastic, youngs_modulus: 2e11, poissons_ratio: 0, density: 8000}}
boundary:
  - {{name: wall, fix: [x], faces: [xi-]}}
  - {{fix: [y, z], faces: [eta-, eta+, zeta-, zeta+]}}
output: {{every: 1e-9, file: out}}
{loads}
"""
BLOCK = """units: si
geometry: {{box: {{origin: [0, 0, 0], size: [0.04, 0.036, 0.004], elements: {elements}, degree: 2}}}}
material: {{law: saint_venant_kirchhoff, youngs_modulus: 7.4e10, poissons_ratio: 0.23, density: 2480}}
boundary:
  - {{name: left, fix: [x, y, z], faces: [xi-, eta-]}}
  - {{name: right, fix: [z], faces: [xi+, zeta-]}}
loads: {{gravity: [1e6, 0, -9.81e5], tractions: [{{face: zeta+, value: [0, 1e6, -1e8]}}]}}
initial: {{velocity: [1, 2, -10]}}
output: {{every: 1e-9, file: out}}
"""


def block(elements="[8, 7, 2]") -> str:
    return BLOCK.format(elements=elements)


class Reactions(unittest.TestCase):
    def solve(self, model: str, end: float, step: float, ranks: int = 1) -> dict[str, np.ndarray]:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "model.yaml").write_text(model)
            launcher = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
            command = [*launcher, PROGRAM, "model.yaml", "--end", repr(end), "--step", repr(step), "--quiet"]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(Path(folder) / "out.h5") as file:
                series = {}
                file.visititems(lambda name, item: series.__setitem__(name, item[...]) if hasattr(item, "shape") else None)
                self.assertIn(file["reactions"][next(iter(file["reactions"]))].attrs["unit"], ("N", b"N"))
        return series

    def test_forces_are_the_change_of_momentum_in_each_step(self):
        step, seen = 2e-8, self.solve(block(), 4e-6, 2e-8)
        mass = 2480 * 0.04 * 0.036 * 0.004
        loads = mass * np.array([1e6, 0, -9.81e5]) + 0.04 * 0.036 * np.array([0, 1e6, -1e8])
        forces = loads + seen["reactions/left"] + seen["reactions/right"]
        self.assertEqual(len(seen["time"]), 201)
        change = np.diff(seen["linear_momentum"], axis=0)
        expected = 0.5 * step * (forces[1:] + forces[:-1])
        size = step * np.abs(seen["reactions/left"]).max()
        np.testing.assert_allclose(change, expected, rtol=0, atol=1e-12 * max(size, np.abs(seen["linear_momentum"]).max()))
        self.assertTrue((np.abs(seen["reactions/right"][1:, 2]) > 0).all())
        self.assertTrue((seen["reactions/right"][:, :2] == 0).all(), "it holds in z alone")

    def test_a_bar_that_is_stopped_pushes_with_rho_c_v(self):
        """Until the wave comes back from the free end; then nothing holds the bar, which leaves with -v."""
        v, area = 2.0, 1e-4
        seen = self.solve(BAR.format(loads=f"initial: {{velocity: [{-v}, 0, 0]}}"), 1.9 / C, 2e-7)
        pushed = seen["reactions/wall"][:, 0]
        middle = (seen["time"] > 0.2 / C) & (seen["time"] < 1.8 / C)
        self.assertAlmostEqual(pushed[middle].mean() / (RHO * C * v * area), 1.0, delta=5e-3)

    def test_a_loaded_end_is_felt_twice(self):
        """A step of pressure arrives after L / c and is reflected: a fixed end feels twice the load, until 3 L / c."""
        load, area = 1e6, 1e-4
        seen = self.solve(BAR.format(loads=f"loads: {{tractions: [{{face: xi+, value: [{load}, 0, 0]}}]}}"), 2.9 / C, 2e-7)
        held = -seen["reactions/wall"][:, 0] / (load * area)
        time = seen["time"] * C
        self.assertLess(np.abs(held[time < 0.9]).max(), 0.01)
        self.assertAlmostEqual(held[(time > 1.2) & (time < 2.8)].mean(), 2.0, delta=5e-3)

    def test_kinetic_energy_is_what_the_ledger_says(self):
        seen = self.solve(block(), 4e-6, 2e-8)
        left = seen["kinetic_energy"] + seen["ledger/internal"] - seen["ledger/loads"] - seen["ledger/contacts"]
        np.testing.assert_allclose(left, left[0], rtol=1e-12)
        self.assertGreater(np.ptp(seen["ledger/internal"]), 0.01 * left[0])
        np.testing.assert_array_equal(seen["ledger/contacts"], 0)
        np.testing.assert_allclose(
            seen["ledger/truncation"], seen["ledger/internal"] - (seen["strain_energy"] - seen["strain_energy"][0]),
            rtol=0, atol=1e-14 * left[0],
        )  # fmt: skip

    def test_truncation_is_of_second_order(self):
        """From rest under loads that are soft enough for the motion to be resolved: at the same time, half the step."""
        model = block().replace("velocity: [1, 2, -10]", "velocity: [0, 0, 0]")
        sizes = []
        for step in (2e-8, 1e-8, 5e-9):
            seen = self.solve(model, 4e-6, step)
            sizes.append(np.abs(seen["ledger/truncation"][len(seen["time"]) // 2 :: round(2e-8 / step)]).mean())
        orders = np.log2(np.array(sizes[:-1]) / sizes[1:])
        np.testing.assert_allclose(orders, 2.0, atol=0.1)

    def test_ranks(self):
        model = block("[40, 36, 2]")
        one = self.solve(model, 5e-7, 2e-8)
        for ranks in (2, 4):
            more = self.solve(model, 5e-7, 2e-8, ranks)
            for name, values in one.items():
                np.testing.assert_array_equal(more[name], values, err_msg=name)
        self.assertGreater(np.abs(one["reactions/left"]).max(), 1.0)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates of equal elements: an independent code on the same meshes, and three-dimensional elasticity as the meshes get finer."""

import unittest
from dataclasses import replace

import numpy as np

from study.reference import hertz
from study.reference.elastic_plate import ElasticPlateImpact
from study.reference.meshed_plate import MeshedPlate

GLASS = (74.6e9, 0.2285, 2480.0)
STEEL = (210.6e9, 0.286, 7850.0)
CASES = {"Z1": (GLASS, 1.0e-3, 26e-3), "Z2": (STEEL, 1.0e-3, 36e-3), "Z3": (STEEL, 1.5e-3, 60e-3)}  # ball, r, side


def sphere(case: str) -> hertz.Impact:
    ball, r, _ = CASES[case]
    return hertz.penalty_impact("hertz", 1.0, hertz.effective_modulus(*ball[:2], *GLASS[:2]), r, ball[2], 1.0)


def plate(case: str, h: float, layers: int, place: str = "corner", degree: int = 2, through: int | None = None) -> MeshedPlate:
    return MeshedPlate(*GLASS, 1.0e-3, h, layers, place, CASES[case][2], degree, through)


class SameMesh(unittest.TestCase):
    def test_without_correction(self):
        """A code of solid elements with free sides, its contact where control points have their knots."""
        expected = {
            "Z1": {(1.0, 1): (0.7619, 4.876), (0.5, 1): (0.7663, 4.788), (1.0, 2): (0.7606, 4.861)},
            "Z2": {(1.0, 1): (0.5403, 9.558), (0.5, 1): (0.5507, 9.335), (1.0, 2): (0.5396, 9.514)},
            "Z3": {(1.0, 1): (0.2560, 15.910), (0.5, 1): (0.2707, 15.532), (1.0, 2): (0.2570, 15.827)},
        }
        for case, meshes in expected.items():
            for (ratio, layers), (e, F) in meshes.items():
                with self.subTest(case=case, ratio=ratio, layers=layers):
                    found = plate(case, ratio * 1e-3, layers).impact(sphere(case), 1e-8, corrected=False)
                    self.assertAlmostEqual(found[0], e, delta=2.5e-4)
                    self.assertAlmostEqual(found[1] / F, 1.0, delta=3e-4)

    def test_rigid_motion_costs_nothing(self):
        for degree, through in ((2, None), (3, None), (2, 3)):
            zero = np.zeros(1)
            of = plate("Z1", 1e-3, 2, degree=degree, through=through)
            self.assertEqual(of.through.count, 2 + (through or degree))
            K, n = of.stiffness(zero, zero)[0], of.through.count
            for d in range(3):
                u = np.zeros(3 * n)
                u[d * n : (d + 1) * n] = 1.0
                self.assertLess(np.abs(K @ u).max(), 1e-9 * np.abs(K).max())
            np.testing.assert_allclose(K, K.conj().T, atol=1e-12 * np.abs(K).max())

    def test_mass(self):
        self.assertAlmostEqual(plate("Z1", 1e-3, 3).through.row_sums.sum(), 1e-3, delta=1e-15)


    def test_corrected_mass(self):
        """Once: 2 M_L - M between row sums' inverses; a uniform motion has the mass of row sums, waves have less."""
        of = replace(plate("Z1", 1e-3, 2), mass="corrected")
        theta = np.array([0.0, 1.3])
        root = of.root_of_inverse_mass(theta, 0.5 * theta)
        inverse = root @ root.conj().swapaxes(1, 2)
        n = of.through.count
        lumped = GLASS[2] * 1e-6 * np.tile(of.through.row_sums, 3)
        np.testing.assert_allclose(inverse[0] @ lumped, 1.0, rtol=1e-12)
        scaled = np.linalg.eigvalsh(inverse * np.sqrt(np.outer(lumped, lumped)))
        self.assertGreater(scaled.min(), 1.0 - 1e-12)
        self.assertLess(scaled.max(), 2.0)
        self.assertEqual(np.abs(inverse[:, :n, n:]).max(), 0.0, "directions are apart")
        lumped_root = replace(of, mass="lumped").root_of_inverse_mass(theta, theta)
        np.testing.assert_allclose(lumped_root[1], np.diag(lumped**-0.5), rtol=1e-12)


class Compliance(unittest.TestCase):
    def test_cubes(self):
        """Of a half-space of cubes: 0.804 and 1.274 in 1/(E' h), to 0.5 % from four layers on."""
        E_ = GLASS[0] / (1.0 - GLASS[1] ** 2)
        for place, C in (("corner", 0.804), ("centre", 1.274)):
            of = MeshedPlate(*GLASS, 1.0e-3, 0.125e-3, 8, place, 4e-3)
            self.assertAlmostEqual(of.compliance * E_ * of.h / C, 1.0, delta=0.03)


class Elasticity(unittest.TestCase):
    def test_meshes_get_there(self):
        """From meshes as wide as the plate is thick: what is left falls at least with the square of h."""
        rigid = sphere("Z1")
        exact = ElasticPlateImpact(rigid.m, rigid.V, rigid.k, *GLASS, 1.0e-3)
        for place in ("corner", "centre"):
            errors = []
            for h, layers in ((1e-3, 1), (0.5e-3, 2), (0.25e-3, 4)):
                e, F = plate("Z1", h, layers, place).impact(rigid, 1e-8)
                errors.append((abs(e - exact.restitution), abs(F / exact.peak_force - 1.0)))
            self.assertLess(errors[1][1], 0.25 * errors[0][1])
            self.assertLess(errors[2][1], 5e-4)
            self.assertLess(errors[2][0], 5e-4)

    def test_corrected_mass_takes_half_of_what_is_left(self):
        """With elements as large as the plate is thick, two layers of them: the rest is waves in the stiffness."""
        rigid = sphere("Z1")
        exact = ElasticPlateImpact(rigid.m, rigid.V, rigid.k, *GLASS, 1.0e-3)
        lumped, corrected = (replace(plate("Z1", 1e-3, 2), mass=mass).impact(rigid, 1e-8) for mass in ("lumped", "corrected"))
        for value, reference in zip(range(2), (exact.restitution, exact.peak_force)):
            self.assertLess(abs(corrected[value] - reference), 0.55 * abs(lumped[value] - reference))

    def test_one_layer_stays_away(self):
        """What a mesh of one quadratic layer is too stiff by it stays, however fine it is in the plane: its shear, which cubic
        functions through the thickness have."""
        rigid = sphere("Z1")
        exact = ElasticPlateImpact(rigid.m, rigid.V, rigid.k, *GLASS, 1.0e-3)
        for h, left in ((0.5e-3, 1.2e-3), (0.25e-3, 6e-4)):
            quadratic, cubic = (plate("Z1", h, 1, through=p).impact(rigid, 1e-8)[1] / exact.peak_force - 1.0 for p in (2, 3))
            self.assertAlmostEqual(quadratic, 0.004, delta=5e-4)
            self.assertLess(abs(cubic), left)


if __name__ == "__main__":
    unittest.main()

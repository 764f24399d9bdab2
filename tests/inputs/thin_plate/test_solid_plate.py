# SPDX-License-Identifier: GPL-2.0-or-later
"""The independent program for plates whose sides are held, and the numbers that inputs/thin_plate has from it."""

import unittest

import numpy as np
from scipy.interpolate import BSpline

import solid_plate
from solid_plate import NU, RHO, SIDE, THICKNESS, E, Plate, in_the_middle


def control_points(plate):
    """Coordinates of the nodes, [number, direction]; any linear function has these values as coefficients."""

    def greville(count, length):
        inner = np.linspace(0.0, length, count - 1)
        knots = np.r_[0.0, 0.0, inner, length, length]
        assert BSpline(knots, np.zeros(count), 2).k == 2
        return np.array([knots[i + 1 : i + 3].mean() for i in range(count)])

    along, through = greville(plate.along.count, SIDE), greville(plate.through.count, THICKNESS)
    return np.stack(np.meshgrid(along, along, through, indexing="ij"), axis=-1).reshape(-1, 3)


class Solid(unittest.TestCase):
    plate = Plate(4, 2)

    def test_mass(self):
        self.assertAlmostEqual(self.plate.mass.sum() / (3 * RHO * SIDE**2 * THICKNESS), 1.0, delta=1e-12)

    def test_rigid_motion_costs_nothing(self):
        x, stiffness = control_points(self.plate), self.plate.stiffness
        turned = np.cross([0.3, -0.7, 0.2], x)
        shifted = np.tile([1.0, 2.0, 3.0], (len(x), 1)) * SIDE
        for u in (turned, shifted):
            force = stiffness @ u.T.ravel()
            self.assertLess(np.abs(force).max(), 1e-12 * E * SIDE**2)

    def test_energy_of_uniform_strains(self):
        x, volume = control_points(self.plate), SIDE**2 * THICKNESS
        mu = E / (2 * (1 + NU))
        lame = 2 * mu * NU / (1 - 2 * NU)
        for strain, density in (
            (np.diag([0.0, 1.0, 0.0]), 0.5 * (lame + 2 * mu)),
            (np.diag([1.0, 0.0, 1.0]), 2 * lame + 2 * mu),
            (np.array([[0, 0, 1], [0, 0, 0], [0, 0, 0]]), 0.5 * mu),
            (np.array([[0, 1, 0], [0, 0, 0], [0, 0, 0]]), 0.5 * mu),
        ):
            u = (x @ strain.T).T.ravel()
            self.assertAlmostEqual(0.5 * u @ (self.plate.stiffness @ u) / (density * volume), 1.0, delta=1e-10)

    def test_middle_support_leaves_the_middle_where_it_is(self):
        plate = Plate(2, 1)
        self.assertAlmostEqual(in_the_middle(plate.through, THICKNESS).sum(), 1.0, delta=1e-14)
        self.assertEqual(plate.held("supported_middle").shape, (12, 3))  # columns around the plate


class Numbers(unittest.TestCase):
    """On 14 x 14 elements, and on the mesh of inputs/thin_plate."""

    def test_restitution(self):
        for elements, expected in ((14, {"clamped": 0.76289, "supported": 0.76211}), (28, {"supported": 0.76666})):
            for sides, restitution in expected.items():
                with self.subTest(elements=elements, sides=sides):
                    self.assertAlmostEqual(Plate(elements, 1).impact(sides)[0], restitution, delta=6e-6)

    def test_where_the_sides_are_supported_hardly_matters(self):
        plate = Plate(14, 1)
        found = [plate.impact(sides)[0] for sides in solid_plate.SIDES if sides.startswith("supported")]
        self.assertLess(max(found) - min(found), 1.5e-4)


if __name__ == "__main__":
    unittest.main()

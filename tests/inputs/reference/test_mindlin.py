# SPDX-License-Identifier: GPL-2.0-or-later
"""The plate that shears: frequencies of exact elasticity, Kirchhoff's limit, a rigid wall."""

import math
import unittest
from dataclasses import replace

import numpy as np

from study.reference import hertz
from study.reference.mindlin import SquarePlate

GLASS = (74.6e9, 0.2285, 2480.0)


def ball() -> hertz.Impact:
    E_star = hertz.effective_modulus(*GLASS[:2], *GLASS[:2])
    return hertz.penalty_impact("hertz", 1.0, E_star, 1.0e-3, GLASS[2], 1.0)


class Frequencies(unittest.TestCase):
    def first(self, sides: str, thickness: float) -> float:
        """omega a^2 sqrt(rho h/D), side a = 1, nu = 0.3."""
        plate = SquarePlate(1.0, 0.3, 1.0, thickness, 1.0, sides, functions=8)
        D = thickness**3 / (12.0 * (1.0 - 0.3**2))
        moving = plate.modes[0][plate.modes[0] > 1e-3]
        return moving[0] * math.sqrt(thickness / D)

    def test_exact_elasticity(self):
        """Supported: Srinivas (1970); clamped: solids of degree 3, 20 x 20 elements in a quarter."""
        for sides, thickness, expected, tolerance in (
            ("supported", 0.02, 19.71164, 1e-3),
            ("supported", 0.1, 19.09005, 3e-3),
            ("clamped", 0.02, 35.89, 3e-3),
            ("clamped", 0.05, 35.11, 6e-3),
        ):
            with self.subTest(sides=sides, thickness=thickness):
                self.assertAlmostEqual(self.first(sides, thickness) / expected, 1.0, delta=tolerance)

    def test_thin_limit(self):
        """2 pi^2 and 35.985, Kirchhoff's plate; free: 13.468 is odd in both directions, 19.596 the first even one."""
        for sides, expected in (("supported", 2 * math.pi**2), ("clamped", 35.985), ("free", 19.596)):
            with self.subTest(sides=sides):
                self.assertAlmostEqual(self.first(sides, 1e-3) / expected, 1.0, delta=1e-3)


class Impacts(unittest.TestCase):
    def test_kirchhoff_plate_of_an_independent_code(self):
        """14 x 14 x 1 mm of glass, isogeometric Kirchhoff shell with elements of 0.25 mm."""
        expected = {"supported": 0.7725, "clamped": 0.7764, "free": 0.7723}
        e = {}
        for sides in expected:
            plate = SquarePlate(*GLASS, 1e-3, 14e-3, sides, shear_factor=1e3, rotary_inertia=1e-3)
            e[sides] = plate.restitution(ball(), 1e-8)
            self.assertAlmostEqual(e[sides], expected[sides], delta=5e-4)
        self.assertAlmostEqual(e["clamped"] - e["supported"], 0.0039, delta=1e-4)

    def test_converged(self):
        for sides in ("supported", "clamped"):
            plate = SquarePlate(*GLASS, 1e-3, 14e-3, sides)
            coarse = plate.restitution(ball(), 2e-8)
            self.assertAlmostEqual(plate.restitution(ball(), 1e-8), coarse, delta=2e-5)

    def test_a_heavy_stiff_plate_is_a_rigid_wall(self):
        plate = SquarePlate(1e6 * GLASS[0], GLASS[1], 1e6 * GLASS[2], 1e-3, 14e-3, "clamped", functions=6)
        self.assertAlmostEqual(plate.restitution(ball(), 1e-8), 1.0, delta=1e-4)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Constrained motion against closed forms: incline, spherical bowl (swinging and circling), energy on the waves."""

import math
import unittest

import numpy as np

from study.reference.sliding import SlidingBall, Slope
from study.reference.wavy_surface import sine_surface

G = 9.81
R, r = 50e-3, 5e-3  # bowl, ball


def bowl(x: float, y: float) -> Slope:
    h = math.sqrt(R**2 - x**2 - y**2)
    return Slope(R - h, x / h, y / h, (R**2 - y**2) / h**3, x * y / h**3, (R**2 - x**2) / h**3)


def in_bowl(angle: float) -> np.ndarray:
    """The ball's centre at an angle from the lowest point, towards x."""
    return np.array([(R - r) * math.sin(angle), 0.0, R - (R - r) * math.cos(angle)])


class ClosedForms(unittest.TestCase):
    def test_incline(self):
        slope = math.tan(math.radians(20.0))
        ball = SlidingBall(lambda x, y: Slope(slope * x, slope, 0.0, 0.0, 0.0, 0.0), r, G)
        centre, v = r * np.array([-slope, 0.0, 1.0]) * math.cos(math.radians(20.0)), np.array([0.3, 0.5, 0.3 * slope])
        np.testing.assert_allclose(ball.force(centre, v, np.linspace(0.0, 0.2, 20)), math.cos(math.radians(20.0)))

    def test_swinging_in_a_bowl(self):
        # energy: F/(m g) = 3 cos(angle) - 2 cos(start); period of the pendulum of length R - r
        start = math.radians(60.0)
        period = 2 * math.pi * math.sqrt((R - r) / G) / agm(1.0, math.cos(start / 2))
        t = np.array([0.0, period / 4, period / 2, period])
        force = SlidingBall(bowl, r, G).force(in_bowl(start), np.zeros(3), t)
        turning, lowest = math.cos(start), 3 - 2 * math.cos(start)
        np.testing.assert_allclose(force, [turning, lowest, turning, turning], rtol=1e-8)

    def test_circling_in_a_bowl(self):
        angle = math.radians(40.0)
        speed = math.sqrt(G * (R - r) * math.sin(angle) * math.tan(angle))
        force = SlidingBall(bowl, r, G).force(in_bowl(angle), np.array([0.0, speed, 0.0]), np.linspace(0.0, 1.0, 50))
        np.testing.assert_allclose(force, 1.0 / math.cos(angle), rtol=1e-8)

    def test_crest_and_trough_of_the_waves(self):
        # along the line of crests: F/(m g) = 1 +- v^2 kappa / (g (1 -+ kappa r)), and energy between them
        A, radius, V = 0.5e-3, 0.5e-3, 0.3
        k = 2 * math.pi * 3 / 62e-3
        kappa = A * k**2
        ball = SlidingBall(sine_surface(A), radius, G)
        centre = np.array([62e-3 / 4, 62e-3 / 12, radius - A])
        t = np.linspace(0.0, 0.12, 12001)
        force = ball.force(centre, np.array([V, 0.0, 0.0]), t)
        self.assertAlmostEqual(force[0], 1 + V**2 * kappa / (G * (1 - kappa * radius)), delta=1e-9)
        crest = 1 - (V**2 - 4 * G * A) * kappa / (G * (1 + kappa * radius))
        self.assertAlmostEqual(force.min(), crest, delta=1e-6)


def agm(a: float, b: float) -> float:
    """Arithmetic-geometric mean."""
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return a


if __name__ == "__main__":
    unittest.main()

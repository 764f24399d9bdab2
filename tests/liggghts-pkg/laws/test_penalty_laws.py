# SPDX-License-Identifier: GPL-2.0-or-later
"""The three penalty laws against closed forms: peak, duration, impulse and restitution of a collision.

m d'' = -K d^n with K = 4/3 lambda E* sqrt(r*):  d_max = ((n+1)/2 m V^2/K)^(1/(n+1)),  F_max = K d_max^n,
t_c = 2 d_max/V sqrt(pi) Gamma(1 + 1/(n+1))/Gamma(1/2 + 1/(n+1)),  impulse 2 m V.
"""

import math
import unittest

import numpy as np

import contact_deck
from contact_deck import EXPONENT, LAWS, RADIUS, SPEED, decks

# lambda from mm to SI
MM = {"penalty/linear": 1e-3**0.5, "penalty/hertz": 1.0, "penalty/quadratic": 1e-3**-0.5}

# law, lambda in mm units, F_max [N], t_c [us]: ball of Table 2 on a rigid plane of the plate's material
PLANE_CASES = (
    ("penalty/hertz", 0.6, 5.450859, 7.011585),
    ("penalty/hertz", 0.8, 6.115619, 6.249435),
    ("penalty/hertz", 1.0, 6.686586, 5.715796),
    ("penalty/hertz", 1.2, 7.192452, 5.313788),
    ("penalty/linear", 0.055085, 6.68659, 4.88074),
    ("penalty/linear", 0.040165, 5.70970, 5.715796),
    ("penalty/linear", 0.03, 4.93456, 6.61366),
    ("penalty/linear", 0.07, 7.53767, 4.32965),
    ("penalty/quadratic", 15.7585, 6.68659, 6.53524),
    ("penalty/quadratic", 23.5542, 7.64521, 5.715796),
    ("penalty/quadratic", 10.0, 5.74601, 7.60501),
    ("penalty/quadratic", 30.0, 8.28718, 5.27302),
)


def closed_form(n: float, K: float, m: float, V: float) -> tuple[float, float]:
    """F_max and t_c of m d'' = -K d^n, d'(0) = V."""
    d_max = ((n + 1) / 2 * m * V**2 / K) ** (1 / (n + 1))
    quarter = math.sqrt(math.pi) * math.gamma(1 + 1 / (n + 1)) / math.gamma(0.5 + 1 / (n + 1))
    return K * d_max**n, 2 * d_max / V * quarter


def peak(F: np.ndarray) -> float:
    """Vertex of the parabola through the largest sample and its neighbours."""
    k = int(np.argmax(F))
    left, top, right = F[k - 1 : k + 2]
    return top + (left - right) ** 2 / (8 * (2 * top - left - right))


def end_of_contact(t: np.ndarray, overlap: np.ndarray) -> float:
    """Where the overlap, zero at t = 0, returns to zero; linear between samples."""
    k = int(np.nonzero(overlap[1:] > 0)[0][-1]) + 1
    return t[k] + overlap[k] / (overlap[k] - overlap[k + 1]) * (t[k + 1] - t[k])


FACTOR = {"penalty/linear": 1.5e-3, "penalty/hertz": 0.8, "penalty/quadratic": 600.0}


class PlaneCollision(unittest.TestCase):
    def test_peak_duration_and_impulse(self):
        dt = 1e-8
        tables = contact_deck.run_each(
            contact_deck.ball_on_plane(f"model {law}", factor=factor * MM[law], dt=dt) + "run 900\n"
            for law, factor, _, _ in PLANE_CASES
        )
        for (law, factor, F_max, t_c), table in zip(PLANE_CASES, tables):
            with self.subTest(law=law, factor_mm=factor):
                t, F = dt * table["Step"], table["fz1"]
                self.assertAlmostEqual(peak(F) / F_max, 1.0, delta=1e-5)
                duration = end_of_contact(t, RADIUS - table["z1"])
                self.assertAlmostEqual(duration / (t_c * 1e-6), 1.0, delta=1e-4)
                momentum = 2 * contact_deck.mass(RADIUS) * SPEED
                self.assertAlmostEqual(np.sum(F) * dt / momentum, 1.0, delta=1e-5)
                self.assertAlmostEqual(table["vz1"][-1], SPEED, delta=1e-5)

    def test_restitution_is_e_at_every_speed(self):
        cases = [(law, e, speed) for law in LAWS for e in (0.3, 0.7) for speed in (0.3, 2.0)]
        tables = contact_deck.run_each(
            contact_deck.ball_on_plane(
                f"model {law}",
                factor=FACTOR[law],
                velocity=(0, 0, -speed),
                restitution=e,
                dt=2e-9,
                every=8000,
            )
            + "run 8000\n"
            for law, e, speed in cases
        )
        for (law, e, speed), table in zip(cases, tables):
            with self.subTest(law=law, e=e, speed=speed):
                self.assertAlmostEqual(table["vz1"][-1] / speed, e, delta=1e-3)
                self.assertGreater(table["z1"][-1], RADIUS)

    def test_limit_force_never_pulls(self):
        cases = [(law, limit) for law in LAWS for limit in ("off", "on")]
        tables = contact_deck.run_each(
            contact_deck.ball_on_plane(
                f"model {law}", settings=f"limitForce {limit}", factor=FACTOR[law], restitution=0.3
            )
            + "run 1200\n"
            for law, limit in cases
        )
        smallest = {case: table["fz1"].min() for case, table in zip(cases, tables)}
        for law in LAWS:
            with self.subTest(law=law):
                self.assertLess(smallest[law, "off"], -1e-3)
                self.assertEqual(smallest[law, "on"], 0.0)


class BallCollision(unittest.TestCase):
    CASES = (
        ("penalty/hertz", 1.0),
        ("penalty/hertz", 0.7),
        ("penalty/linear", 2e-3),
        ("penalty/quadratic", 400.0),
    )

    def test_two_unequal_balls(self):
        r, R = RADIUS, contact_deck.OTHER_RADIUS
        m, M = contact_deck.mass(r), contact_deck.mass(R)
        dt = 1e-8
        tables = contact_deck.run_each(
            contact_deck.two_balls(f"model {law}", factor=factor, dt=dt) + "run 900\n"
            for law, factor in self.CASES
        )
        for (law, factor), table in zip(self.CASES, tables):
            with self.subTest(law=law, factor=factor):
                K = 4 / 3 * factor * contact_deck.effective_modulus(1, 2) * math.sqrt(r * R / (r + R))
                F_max, t_c = closed_form(EXPONENT[law], K, m * M / (m + M), SPEED)
                F = table["fx2"]
                overlap = r + R - (table["x2"] - table["x1"])
                self.assertAlmostEqual(peak(F) / F_max, 1.0, delta=1e-5)
                self.assertAlmostEqual(end_of_contact(dt * table["Step"], overlap) / t_c, 1.0, delta=1e-4)
                np.testing.assert_array_equal(table["fx1"], -F)
                self.assertAlmostEqual(table["vx2"][-1], 2 * m / (m + M) * SPEED, delta=1e-5)
                self.assertAlmostEqual(table["vx1"][-1], (m - M) / (m + M) * SPEED, delta=1e-5)

    def test_restitution_is_e(self):
        tables = contact_deck.run_each(
            contact_deck.two_balls(
                f"model {law}", factor=factor, restitution=0.5, dt=2e-9, every=6000
            )
            + "run 6000\n"
            for law, factor in self.CASES
        )
        for (law, factor), table in zip(self.CASES, tables):
            with self.subTest(law=law, factor=factor):
                self.assertAlmostEqual((table["vx2"][-1] - table["vx1"][-1]) / SPEED, 0.5, delta=1e-3)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Impact on a thin plate: an independent table, limits, and the balance of momentum."""

import unittest

import numpy as np

from study.reference import hertz
from study.reference.zener import ThinPlateImpact, plate_mobility, solve

GLASS = (74.6e9, 0.2285, 2480.0)
STEEL = (210.6e9, 0.286, 7850.0)


def on_glass(ball, r):
    """A ball of radius r [m] at 1 m/s on 1 mm of glass."""
    E, nu, rho = ball
    E_star = hertz.effective_modulus(E, nu, *GLASS[:2])
    rigid = hertz.penalty_impact("hertz", 1.0, E_star, r, rho, 1.0)
    return ThinPlateImpact(rigid.m, rigid.V, rigid.k, plate_mobility(*GLASS, 1.0e-3))


class Table(unittest.TestCase):
    """inelasticity: restitution, peak over m V/T, duration over T."""

    TABLE = {
        0.0: (1.00000, 1.14326, 3.21807),
        0.1: (0.84334, 1.03555, 3.27849),
        0.5: (0.43690, 0.75023, 3.62444),
        1.0: (0.18412, 0.55616, 4.38761),
        2.0: (0.02068, 0.36466, 8.48322),
        3.0: (0.00280, 0.27035, 16.934),
    }

    def test_table(self):
        for inelasticity, (e, peak, duration) in self.TABLE.items():
            with self.subTest(inelasticity=inelasticity):
                # m = V = K = 1: then T = 1, and alpha is the inelasticity.
                impact = ThinPlateImpact(1.0, 1.0, 1.0, inelasticity)
                self.assertAlmostEqual(impact.restitution, e, delta=1e-5)
                self.assertAlmostEqual(impact.peak_force, peak, delta=1e-5)
                self.assertAlmostEqual(impact.duration, duration, delta=1e-3 if e < 0.01 else 1e-5)


class Cases(unittest.TestCase):
    def test_published_cases(self):
        cases = [
            (GLASS, 1.0e-3, 0.154582, 0.76982, 4.91162, 6.90554, 0.5698, 1.838524e-5),
            (STEEL, 1.0e-3, 0.361885, 0.54769, 9.68545, 9.81243, 1.5773, 5.089106e-5),
            (STEEL, 1.5e-3, 0.814240, 0.25713, 16.17165, 17.09751, 4.3239, 1.395117e-4),
        ]
        for ball, r, inelasticity, e, peak, duration_us, w_um, impulse in cases:
            with self.subTest(r=r, peak=peak):
                impact = on_glass(ball, r)
                self.assertAlmostEqual(impact.inelasticity, inelasticity, delta=1e-6)
                self.assertAlmostEqual(impact.restitution, e, delta=1e-5)
                self.assertAlmostEqual(impact.peak_force, peak, delta=1e-4)
                self.assertAlmostEqual(impact.duration * 1e6, duration_us, delta=1e-4)
                self.assertAlmostEqual(impact.plate_displacement * 1e6, w_um, delta=1e-4)
                self.assertAlmostEqual(impact.impulse / impulse, 1.0, delta=1e-5)

    def test_samples_of_the_first_case(self):
        impact = on_glass(GLASS, 1.0e-3)
        self.assertAlmostEqual(impact.force(0.1726386e-6), 0.1187232, delta=1e-6)
        self.assertAlmostEqual(impact.force(1.20847e-6), 2.026652, delta=1e-5)

    def test_force_integrates_to_the_impulse(self):
        impact = on_glass(STEEL, 1.0e-3)
        t = np.linspace(0.0, impact.duration, 20001)
        self.assertAlmostEqual(np.trapz(impact.force(t), t) / impact.impulse, 1.0, delta=1e-6)
        np.testing.assert_array_equal(impact.force(np.array([-1e-6, 1.001 * impact.duration])), 0.0)

    def test_an_immovable_plate_is_the_hertz_impact(self):
        rigid = hertz.Impact(m=1e-5, V=2.0, k=2e9, n=1.5)
        impact = ThinPlateImpact(rigid.m, rigid.V, rigid.k, 0.0)
        self.assertAlmostEqual(impact.restitution, 1.0, delta=1e-9)
        self.assertAlmostEqual(impact.duration / rigid.duration, 1.0, delta=1e-9)
        self.assertAlmostEqual(impact.peak_force / rigid.peak_force, 1.0, delta=1e-9)

    def test_solution_satisfies_the_equation(self):
        inelasticity, h = 0.3, 1e-3
        s = solve(inelasticity).sol
        tau = np.linspace(0.5, 3.0, 6)
        f = lambda x: s(x)[0] ** 1.5  # noqa: E731
        acceleration = (s(tau + h)[0] - 2.0 * s(tau)[0] + s(tau - h)[0]) / h**2
        rate_of_f = (f(tau + h) - f(tau - h)) / (2.0 * h)
        np.testing.assert_allclose(acceleration + f(tau) + inelasticity * rate_of_f, 0.0, atol=1e-5)


if __name__ == "__main__":
    unittest.main()

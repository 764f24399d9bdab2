# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms of an impact: published numbers, and the equation of motion integrated."""

import unittest

import numpy as np
from scipy.integrate import solve_ivp

from study.reference import hertz
from study.run.usage import UsageError

STEEL = (210.6e9, 0.286)
BALL = dict(r=1.0e-3, rho=2480.0, V=1.0)


def impact(law="hertz", lam=1.0, E=74.6e9, nu=0.2285):
    """Table 2 of Gao & Feng (2019), varied."""
    return hertz.penalty_impact(law, lam, hertz.effective_modulus(E, nu, *STEEL), **BALL)


def integrated(m, V, k, n):
    """Overlap and force as functions of time, and the end of contact, by Runge-Kutta."""

    def separated(t, y):
        return y[0] if t > 0.0 else 1.0

    separated.terminal = True
    separated.direction = -1
    # Scaled time T and length T V keep all numbers near one.
    T = (m / (k * V ** (n - 1.0))) ** (1.0 / (n + 1.0))
    rate = lambda _, y: [y[1], -max(y[0], 0.0) ** n]  # noqa: E731
    options = dict(rtol=1e-12, atol=1e-14, method="DOP853", dense_output=True, max_step=0.05)
    solution = solve_ivp(rate, [0.0, 20.0], [0.0, 1.0], events=separated, **options)
    overlap = lambda t: T * V * solution.sol(np.asarray(t) / T)[0]  # noqa: E731
    return overlap, lambda t: k * overlap(t) ** n, T * solution.t[-1]


class Published(unittest.TestCase):
    """Independent reference values to all digits given."""

    def close(self, value, expected):
        self.assertAlmostEqual(value / expected, 1.0, delta=1e-6)

    def test_modulus_and_mass(self):
        self.close(hertz.effective_modulus(74.6e9, 0.2285, *STEEL), 58.59991e9)
        self.close(hertz.sphere_mass(1.0e-3, 2480.0), 1.03881997e-5)
        self.close(impact().k, 2.470789e9)
        self.close(impact().impulse, 2.0776399e-5)

    def test_hertz(self):
        table = [
            (dict(lam=0.6), 5.450859, 7.011585),
            (dict(lam=0.8), 6.115619, 6.249435),
            (dict(lam=1.0), 6.686586, 5.715796),
            (dict(lam=1.2), 7.192452, 5.313788),
            (dict(E=50e9), 5.901825, 6.475821),
            (dict(E=100e9), 7.271409, 5.256087),
            (dict(E=200e9), 8.599050, 4.444580),
            (dict(E=300e9), 9.280603, 4.118177),
            (dict(nu=0.1), 6.599905, 5.790866),
            (dict(nu=0.3), 6.767668, 5.647317),
            (dict(nu=0.4), 6.927448, 5.517062),
        ]
        for varied, peak, duration_us in table:
            with self.subTest(**varied):
                self.close(impact(**varied).peak_force, peak)
                self.close(impact(**varied).duration, duration_us * 1e-6)

    def test_linear_and_quadratic(self):
        table = [
            ("linear", 0.03, 4.93456, 6.61366),
            ("linear", 0.07, 7.53767, 4.32965),
            ("quadratic", 10.0, 5.74601, 7.60501),
            ("quadratic", 20.0, 7.23952, 6.03610),
            ("quadratic", 30.0, 8.28718, 5.27302),
        ]
        for law, lam_mm, peak, duration_us in table:
            with self.subTest(law=law, lam=lam_mm):
                varied = impact(law, lam_mm * hertz.si_factor(law))
                self.close(varied.peak_force, peak)
                self.close(varied.duration, duration_us * 1e-6)

    def test_lambda_in_mm_that_matches_hertz(self):
        linear, quadratic = hertz.si_factor("linear"), hertz.si_factor("quadratic")
        delta = impact().max_overlap
        self.assertAlmostEqual(1.25 * delta**0.5 / linear, 0.055085, places=6)
        self.assertAlmostEqual(1.0 / (1.44 * delta**0.5) / quadratic, 15.7585, places=3)
        matches = [("linear", 0.055085, 0.040165), ("quadratic", 15.7585, 23.5542)]
        for law, peak, duration in matches:
            with self.subTest(law=law):
                at_peak = impact(law, peak * hertz.si_factor(law))
                at_duration = impact(law, duration * hertz.si_factor(law))
                self.assertAlmostEqual(at_peak.peak_force / impact().peak_force, 1.0, delta=1e-5)
                self.assertAlmostEqual(at_duration.duration / impact().duration, 1.0, delta=1e-5)

    def test_eq_35_is_not_the_solution(self):
        paper = hertz.PaperPulse(58.59991e9, **BALL)
        self.close(paper.peak_force, 6.688240)
        self.close(paper.duration, 5.710782e-6)
        exact = impact()
        t = 0.217 * exact.duration
        sine = np.sin(np.pi * 0.217) ** 1.5
        self.assertAlmostEqual(sine - exact.force(t) / exact.peak_force, 0.0243, delta=1e-4)
        self.assertAlmostEqual(paper.force(0.5 * paper.duration), paper.peak_force)
        self.assertEqual(paper.force(1.01 * paper.duration), 0.0)


class EquationOfMotion(unittest.TestCase):
    """m d'' = -k d^n, integrated numerically."""

    def test_history(self):
        for law, lam in (("linear", 1.7e-3), ("hertz", 1.0), ("hertz", 0.6), ("quadratic", 500.0)):
            with self.subTest(law=law, lam=lam):
                exact = impact(law, lam)
                overlap, force, end = integrated(exact.m, exact.V, exact.k, exact.n)
                t = np.linspace(0.0, 0.9999 * exact.duration, 200)
                self.assertAlmostEqual(end / exact.duration, 1.0, delta=1e-9)
                d_max, F_max = exact.max_overlap, exact.peak_force
                np.testing.assert_allclose(exact.overlap(t), overlap(t), rtol=0, atol=1e-9 * d_max)
                np.testing.assert_allclose(exact.force(t), force(t), rtol=0, atol=1e-8 * F_max)

    def test_no_force_outside_the_contact(self):
        np.testing.assert_array_equal(impact().force(np.array([-1e-6, 0.0, 5.72e-6, 1.0])), 0.0)


class WrongLaw(unittest.TestCase):
    def test_lists_the_laws(self):
        with self.assertRaisesRegex(UsageError, "did you mean 'hertz'.*linear.*quadratic"):
            impact("hertzian")


if __name__ == "__main__":
    unittest.main()

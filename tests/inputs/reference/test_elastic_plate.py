# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates that are not quite thin: the law of a layer beside its kernel, impacts beside resolved ones, the thin limit."""

import unittest
from dataclasses import replace

import numpy as np

from layer_kernel import Layer
from study.reference import hertz
from study.reference.elastic_plate import CONSTANT, LOGARITHM, ElasticPlateImpact, contact_force
from study.reference.zener import plate_mobility

GLASS = (74.6e9, 0.2285, 2480.0)
STEEL = (210.6e9, 0.286, 7850.0)


def impact(ball, r, plate, thickness, **law) -> ElasticPlateImpact:
    """At 1 m/s."""
    rigid = hertz.penalty_impact("hertz", 1.0, hertz.effective_modulus(*ball[:2], *plate[:2]), r, ball[2], 1.0)
    return ElasticPlateImpact(rigid.m, rigid.V, rigid.k, *plate, thickness, **law)


class Law(unittest.TestCase):
    """A ln(s h/c_T) + B of layers of glass, of steel, and of others."""

    S = np.array([0.01, 0.02, 0.04, 0.08])  # s h/c_T

    def law(self, material, layers, degree, row_sums):
        """A and B that fit best, and A ln(s h/c_T) + B itself at S."""
        E, nu, rho = material
        layer = Layer(*material, 1.0e-3, layers, degree, row_sums)
        s = self.S * np.sqrt(layer.mu / rho) / layer.thickness
        unit = (1.0 - nu**2) / (E * layer.thickness)
        values = np.array([plate_mobility(E, nu, rho, layer.thickness) / x - layer.beyond_half_space(x) for x in s]) / unit
        return np.polyfit(np.log(self.S), values, 1), values

    def test_a_layer(self):
        for material in (GLASS, STEEL, (1e9, 0.4, 1000.0), (1e9, 0.0, 1000.0)):
            with self.subTest(material=material):
                (A, _), values = self.law(material, 8, 4, row_sums=False)
                self.assertAlmostEqual(A / LOGARITHM, 1.0, delta=0.02)
                np.testing.assert_allclose(values - LOGARITHM * np.log(self.S), CONSTANT, atol=0.008)

    def test_half_spaces_tractions_leave_a_half_space(self):
        layer = Layer(*GLASS, 1.0e-3, 8, 4, row_sums=False)
        for k in (100.0, 1000.0, 5000.0):
            self.assertAlmostEqual(layer.answer(k, 0.0, half_space=True) / layer.half_space(k), 1.0, delta=1e-6)

    def test_a_mesh_of_one_quadratic_layer_shears_less(self):
        """Its shear strain is even through the thickness, so shear gives way by 1 in place of 6/5."""
        for material in (GLASS, STEEL):
            (A, _), values = self.law(material, 1, 2, row_sums=False)
            self.assertAlmostEqual(A * 2.0 * np.pi, 1.0, delta=0.02)
            one, two = (x - LOGARITHM * np.log(self.S) - CONSTANT for x in (values, self.law(material, 2, 2, False)[1]))
            self.assertLess((two / one).max(), 0.25)  # fourth order


class Impacts(unittest.TestCase):
    def test_resolved_contacts(self):
        """Axisymmetric finite elements with rings of contact pressure: restitution, peak force, duration, displacement."""
        cases = (
            (GLASS, 1.0e-3, GLASS, 1.0e-3, 0.7586, 4.911, 6.881e-6, 0.582e-6),
            (STEEL, 1.0e-3, GLASS, 1.0e-3, 0.5336, 9.658, 9.798e-6, 1.591e-6),
            (STEEL, 1.5e-3, GLASS, 1.0e-3, 0.2482, 16.058, 17.246e-6, 4.330e-6),
            (GLASS, 1.0e-3, STEEL, 1.0e-3, 0.8967, 6.299, 5.764e-6, 0.208e-6),
            (GLASS, 1.0e-3, STEEL, 0.75e-3, 0.8272, 6.021, 5.816e-6, 0.353e-6),
            (GLASS, 1.0e-3, STEEL, 0.5e-3, 0.6609, 5.344, 5.992e-6, 0.716e-6),
            (GLASS, 1.0e-3, STEEL, 0.3e-3, 0.3263, 3.922, 6.821e-6, 1.573e-6),
        )
        for ball, r, plate, thickness, e, peak, duration, displacement in cases:
            with self.subTest(peak=peak):
                found = impact(ball, r, plate, thickness)
                self.assertAlmostEqual(found.restitution, e, delta=2.0e-4)
                self.assertAlmostEqual(found.peak_force / peak, 1.0, delta=5e-4)
                self.assertAlmostEqual(found.duration / duration, 1.0, delta=1e-3)
                self.assertAlmostEqual(found.plate_displacement / displacement, 1.0, delta=2e-3)

    def test_samples_of_a_resolved_contact(self):
        found = impact(GLASS, 1.0e-3, GLASS, 1.0e-3)
        for t_us, F in ((2.05, 3.83782), (4.1, 4.25131), (6.15, 0.687729)):
            self.assertAlmostEqual(found.force(t_us * 1e-6), F, delta=0.02)

    def test_without_what_makes_it_thick_it_is_zener_s(self):
        found = impact(STEEL, 1.0e-3, GLASS, 1.0e-3, logarithm=0.0, constant=0.0)
        thin = found.thin
        for name in ("restitution", "peak_force", "duration", "impulse", "plate_displacement"):
            self.assertAlmostEqual(getattr(found, name) / getattr(thin, name), 1.0, delta=1e-3, msg=name)
        t = np.linspace(0.0, found.duration, 40)
        np.testing.assert_allclose(found.force(t), thin.force(t), atol=2e-3)

    def test_momentum(self):
        found = impact(STEEL, 1.5e-3, GLASS, 1.0e-3)
        t, F = found.history[:2]
        self.assertAlmostEqual(np.trapz(F, t) / found.impulse, 1.0, delta=1e-9)
        np.testing.assert_array_equal(found.force(np.array([-1e-6, 1.001 * found.duration])), 0.0)

    def test_a_soft_ball_sees_a_thin_plate(self):
        """The longer the contact the longer the waves."""
        stiff = impact((74.6e9, 0.2285, 2480.0), 1.0e-3, GLASS, 1.0e-3)
        soft = replace(stiff, K=1e-4 * stiff.K)
        difference = [abs(of.restitution - of.thin.restitution) / (1.0 - of.restitution) for of in (stiff, soft)]
        self.assertLess(difference[1], 0.2 * difference[0])

    def test_damping_beside_a_thin_plate_s_own_equations(self):
        """dx/dt = v - alpha F, and on a plate that does not move at all."""
        for r in (1.0e-3, 1.0e-5):
            for D in (20.0, 60.0):
                found = impact(STEEL, r, GLASS, 1.0e-3, logarithm=0.0, constant=0.0, D=D * (r / 1e-3) ** 1.75)
                m, K, D_, alpha = found.m, found.K, found.D, found.thin.alpha
                dt, x, v, peak = found.thin.duration / 20000, 0.0, 1.0, 0.0
                while x > 0.0 or v == 1.0:
                    gamma = D_ * max(x, 0.0) ** 0.25
                    F = (K * max(x, 0.0) ** 1.5 + gamma * v) / (1.0 + gamma * alpha)
                    x, v, peak = x + dt * (v - 0.5 * dt * F / m - alpha * F), v - dt * F / m, max(peak, F)
                self.assertLess(found.restitution, 0.95 * replace(found, D=0.0).restitution)
                self.assertAlmostEqual(found.restitution / -v, 1.0, delta=3e-3)
                self.assertAlmostEqual(found.peak_force / peak, 1.0, delta=1e-3)

    def test_the_delay_hardly_matters(self):
        found = [impact(GLASS, 1.0e-3, GLASS, 1.0e-3, D=63.25, delay=delay) for delay in (0.3, 0.6)]
        self.assertLess(found[0].restitution, 0.6)
        self.assertAlmostEqual(found[0].restitution / found[1].restitution, 1.0, delta=2e-3)
        self.assertAlmostEqual(found[0].peak_force / found[1].peak_force, 1.0, delta=2e-3)

    def test_contact_force_is_the_law_s(self):
        for give in (0.0, 2e-8, -2e-8):
            F, d = contact_force(1e-6, give, 2e9)
            self.assertAlmostEqual(2e9 * d**1.5 / F, 1.0, delta=1e-11)
            self.assertAlmostEqual(2e9 * (1e-6 - give * F) ** 1.5 / F, 1.0, delta=1e-11)
            F, d = contact_force(1e-6, give, 2e9, damping=1e3, before=0.9e-6)
            self.assertAlmostEqual((2e9 * d**1.5 + 1e3 * d**0.25 * (d - 0.9e-6)) / F, 1.0, delta=1e-11)
            self.assertAlmostEqual((d + give * F) / 1e-6, 1.0, delta=1e-11)
        self.assertEqual(contact_force(-1e-9, 1e-8, 2e9), (0.0, 0.0))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Measurements of a pulse: exact where the interpolation is, else far better than a step."""

import unittest

import numpy as np

from study.reference import hertz
from study.run.pulse import NoPulse, measure, peak, zero_crossings

HERTZ = hertz.penalty_impact("hertz", 1.0, 58.59991e9, r=1.0e-3, rho=2480.0, V=1.0)


def samples(dt, phase=0.0, steps=700):
    """Times, force and signed overlap of the Hertz impact that begins at t = phase."""
    t = dt * np.arange(1, steps + 1)
    s = t - phase
    overlap = HERTZ.overlap(s)
    outside = np.where(s < 0.0, HERTZ.V * s, HERTZ.V * (HERTZ.duration - s))
    signed = np.where((s > 0.0) & (s < HERTZ.duration), overlap, outside)
    return t, HERTZ.force(s), signed


class Peak(unittest.TestCase):
    def test_a_parabola_is_met_exactly(self):
        t = np.arange(10) * 0.1
        time, top = peak(t, 3.0 - 2.0 * (t - 0.4321) ** 2)
        self.assertAlmostEqual(time, 0.4321, delta=1e-13)
        self.assertAlmostEqual(top, 3.0, delta=1e-13)

    def test_much_closer_than_the_largest_sample(self):
        dt = HERTZ.duration / 20.3
        runs = [samples(dt, phase, 40) for phase in np.linspace(0.0, dt, 7)]
        error = lambda top: abs(top / HERTZ.peak_force - 1.0)  # noqa: E731
        self.assertGreater(max(error(F.max()) for _, F, _ in runs), 2e-3)
        self.assertLess(max(error(peak(t, F)[1]) for t, F, _ in runs), 1e-4)

    def test_at_the_border(self):
        for F in ([1.0, 2.0, 3.0], [3.0, 2.0, 1.0]):
            with self.assertRaisesRegex(NoPulse, "no peak"):
                peak(np.arange(3.0), np.array(F))


class Crossings(unittest.TestCase):
    def test_straight_lines_are_met_exactly(self):
        t = np.arange(1.0, 12.0)
        start, end = zero_crossings(t, np.minimum(t - 3.25, 8.5 - t))
        self.assertAlmostEqual(start, 3.25, delta=1e-14)
        self.assertAlmostEqual(end, 8.5, delta=1e-14)

    def test_touching_at_the_start(self):
        t = 0.5 * np.arange(1.0, 9.0)
        start, end = zero_crossings(t, np.minimum(2.0 * t, 6.6 - 2.0 * t))
        self.assertAlmostEqual(start, 0.0, delta=1e-14)
        self.assertAlmostEqual(end, 3.3, delta=1e-14)

    def test_only_the_first_contact_counts(self):
        t = np.arange(1.0, 7.0)
        start, end = zero_crossings(t, np.array([-1.0, 1.0, -1.0, -1.0, 1.0, -1.0]))
        self.assertEqual((start, end), (1.5, 2.5))

    def test_a_sample_of_exactly_zero_is_the_end(self):
        _, end = zero_crossings(np.arange(1.0, 5.0), np.array([2.0, 1.0, 0.0, -1.0]))
        self.assertEqual(end, 3.0)

    def test_incomplete(self):
        for overlap in ([-1.0, -2.0, -3.0], [-1.0, 1.0, 2.0]):
            with self.assertRaisesRegex(NoPulse, "-var steps"):
                zero_crossings(np.arange(3.0), np.array(overlap))


class Measure(unittest.TestCase):
    def test_hertz_pulse_far_below_one_step(self):
        dt = 1e-8
        for phase in (0.0, 0.3 * dt, 7.9 * dt):
            with self.subTest(phase=phase):
                seen = measure(*samples(dt, phase))
                self.assertAlmostEqual(seen.duration, HERTZ.duration, delta=1e-3 * dt)
                top = phase + 0.5 * HERTZ.duration
                self.assertAlmostEqual(seen.peak_time, top, delta=1e-3 * dt)
                self.assertAlmostEqual(seen.peak_force / HERTZ.peak_force, 1.0, delta=1e-8)
                self.assertAlmostEqual(seen.impulse / HERTZ.impulse, 1.0, delta=1e-6)


if __name__ == "__main__":
    unittest.main()

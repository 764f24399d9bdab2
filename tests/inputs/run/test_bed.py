# SPDX-License-Identifier: GPL-2.0-or-later
"""The slope of a bed in a turning drum."""

import math
import unittest

import numpy as np

from study.run.bed import read_frames, slope
from study.run.pulse import NoPulse


class Slope(unittest.TestCase):
    def test_of_a_bed_below_an_incline(self):
        a = 4e-3  # a cubic grid, cut by inclines that climb towards -x
        grid = np.arange(-0.1, 0.1, a)
        x, y, z = np.stack(np.meshgrid(grid, grid[:12] * 0.25, grid), axis=-1).reshape(-1, 3).T
        x, y, z = (v + np.random.default_rng(3).uniform(-0.5 * a, 0.5 * a, v.shape) for v in (x, y, z))
        for degrees in (5.0, 20.0, 35.0):
            tilt = math.radians(degrees)
            inside = (np.hypot(x, z) < 0.098) & (x * math.sin(tilt) + z * math.cos(tilt) < -0.02)
            with self.subTest(degrees=degrees):
                found = slope(x[inside], y[inside], z[inside], 0.1, 5.8e-3)
                self.assertAlmostEqual(math.degrees(found), degrees, delta=0.5)

    def test_of_too_few_particles(self):
        with self.assertRaisesRegex(NoPulse, "the bed is too small to have a slope"):
            slope(np.array([0.0, 1e-3]), np.zeros(2), np.array([-0.09, -0.09]), 0.1, 5.8e-3)

    def test_frames_come_in_the_order_of_ids(self):
        head = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS id x \n"
        first, second = read_frames(head.format(10) + "2 0.25\n1 0.5\n" + head.format(20) + "1 0.75\n2 1.5\n")
        self.assertEqual((first.step, second.step), (10, 20))
        self.assertEqual(first.values["x"].tolist(), [0.5, 0.25])
        self.assertEqual(second.values["x"].tolist(), [0.75, 1.5])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Graded blocks: where elements are, and that control points make a spline of them whose map is the identity."""

import unittest

import numpy as np
import yaml
from scipy.interpolate import BSpline

from study.build.graded_block import EQUAL, GROWTH, GradedBlock, greville, open_knots

STEEL = {"law": "linear_elastic", "youngs_modulus": "210.6e9", "poissons_ratio": 0.286, "density": 7850}


class Blocks(unittest.TestCase):
    def test_places_are_where_they_say(self):
        for place, in_the_middle in (("corner", (False, False)), ("edge", (True, False)), ("centre", (True, True))):
            for breaks, middle in zip(GradedBlock(0.5, place, 10.0, 8.0, 2.0).breaks(), in_the_middle):
                nearest = np.abs(breaks).min()
                self.assertEqual(nearest, 0.25 if middle else 0.0)
                np.testing.assert_allclose(breaks, -breaks[::-1])

    def test_elements_are_equal_in_the_middle_and_grow_from_there(self):
        for place in ("corner", "centre"):
            x, _, z = GradedBlock(0.5, place, 30.0, 28.0, 2.0).breaks()
            self.assertGreaterEqual(x[-1], 30.0)
            self.assertLessEqual(z[0], -28.0)
            self.assertEqual(z[-1], 0.0)
            for sizes in (np.diff(x[x >= 0.0]), np.diff(z)[::-1]):
                np.testing.assert_allclose(sizes[: EQUAL - 1], 0.5)
                self.assertLessEqual((sizes[1:] / sizes[:-1]).max(), GROWTH + 1e-12)
                self.assertAlmostEqual(sizes.max(), 2.0)

    def test_a_plate_has_equal_layers(self):
        _, _, z = GradedBlock(0.25, "corner", 10.0, 1.0, 1.0, layers=4).breaks()
        np.testing.assert_allclose(z, [-1.0, -0.75, -0.5, -0.25, 0.0])

    def test_the_model_file_is_that_block(self):
        for degrees in ((2, 2, 2), (3, 3, 3), (2, 2, 3)):
            block = GradedBlock(0.5, "edge", 4.0, 3.0, 1.0, degrees[0], degree_through=degrees[2])
            model = yaml.safe_load(block.model_file(STEEL))
            patch = model["geometry"]["patches"][0]
            self.assertEqual(patch["degrees"], [*degrees])
            sizes = [len(b) - 1 + degree for b, degree in zip(block.breaks(), degrees)]
            points = np.array(patch["control_points"]).reshape(*sizes[::-1], 3)
            for d, (knots, breaks, degree) in enumerate(zip(patch["knots"], block.breaks(), degrees)):
                np.testing.assert_allclose(knots, open_knots(breaks, degree))
                line = np.moveaxis(points, 2 - d, 0)[:, 0, 0, d]
                np.testing.assert_allclose(line, greville(np.array(knots), degree))
                at = np.linspace(knots[0], knots[-1], 7)
                np.testing.assert_allclose(BSpline(knots, line, degree)(at), at, atol=1e-14)
            self.assertEqual(model["material"]["youngs_modulus"], "210.6e9")


if __name__ == "__main__":
    unittest.main()

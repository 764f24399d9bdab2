# SPDX-License-Identifier: GPL-2.0-or-later
"""The wavy wall: its spline against the sine, its files against the spline."""

import re
import unittest

import numpy as np
import yaml
from scipy.interpolate import BSpline

from study.build.waves import K, SIDE, SplineWave, model_file, triangles

AMPLITUDE = 0.5e-3


def tensor_product(text: str, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Points (3, len(x)) of the patch in a model file at parameters (x, y)."""
    (patch,) = yaml.safe_load(text)["geometry"]["patches"]
    (p, q), (U, V) = patch["degrees"], (np.array(knots, dtype=float) for knots in patch["knots"])
    points = np.array(patch["control_points"], dtype=float).reshape(len(V) - q - 1, len(U) - p - 1, 3)
    Nx = BSpline(U, np.eye(len(U) - p - 1), p)(x)
    Ny = BSpline(V, np.eye(len(V) - q - 1), q)(y)
    return np.einsum("nj,ni,jid->dn", Ny, Nx, points)


class Spline(unittest.TestCase):
    def test_interpolates_the_sine(self):
        for degree, shift in ((2, 0.5), (3, 0.0)):
            x = (np.arange(62) + shift) * SIDE / 62
            with self.subTest(degree=degree):
                np.testing.assert_allclose(SplineWave(degree, 62).spline(x), np.sin(K * x), atol=1e-14)

    def test_is_smooth_across_the_box(self):
        for degree in (2, 3):
            spline = SplineWave(degree, 62).spline
            for order in range(degree):
                with self.subTest(degree=degree, order=order):
                    self.assertAlmostEqual(spline(0.0, order) / K**order, spline(SIDE, order) / K**order, delta=1e-12)

    def test_clamped_anywhere_on_the_line(self):
        x = np.random.default_rng(2).uniform(-0.031, 0.093, 200)
        for degree in (2, 3):
            wave = SplineWave(degree, 62)
            short, long = wave.clamped(0, 62), wave.clamped(-31, 93)
            with self.subTest(degree=degree):
                np.testing.assert_allclose(long(x), wave.spline(x % SIDE), atol=1e-14)
                self.assertEqual((long.t[:degree + 1] - long.t[0]).tolist(), [0.0] * (degree + 1))
                inner = slice(31 + degree, -31 - degree)
                self.assertEqual(short.t[degree:-degree].tolist(), long.t[inner].tolist(), "to the last bit")
                self.assertEqual(short.c[degree:-degree].tolist(), long.c[inner].tolist(), "to the last bit")

    def test_order_of_the_curvature(self):
        x = np.linspace(0.0, SIDE, 5001)
        for degree, order in ((2, 1), (3, 2)):
            coarse, fine = (
                np.abs(SplineWave(degree, n).spline(x, 2) / K**2 + np.sin(K * x)).max() for n in (62, 124)
            )
            with self.subTest(degree=degree):
                self.assertAlmostEqual(np.log2(coarse / fine), order, delta=0.05)


class Files(unittest.TestCase):
    def test_model_file_is_the_spline(self):
        x, y = np.random.default_rng(1).uniform(0.0, SIDE, (2, 50))
        for degree in (2, 3):
            wave = SplineWave(degree, 62)
            points = tensor_product(model_file(wave, AMPLITUDE), x, y)
            expected = [x, y, AMPLITUDE * wave.spline(x) * wave.spline(y)]
            with self.subTest(degree=degree):
                np.testing.assert_allclose(points, expected, rtol=0.0, atol=1e-15)

    def test_triangles(self):
        corners = np.array(re.findall(r"vertex (\S+) (\S+) (\S+)", triangles(31, AMPLITUDE)), dtype=float)
        x, y, z = corners.T
        np.testing.assert_allclose(z, AMPLITUDE * np.sin(K * x) * np.sin(K * y), atol=1e-18)
        facets = corners.reshape(-1, 3, 3)
        self.assertEqual(len(facets), 1922)
        normals = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
        self.assertAlmostEqual(0.5 * normals[:, 2].sum(), SIDE**2, delta=1e-12)  # once over the box
        self.assertGreater(normals[:, 2].min(), 0.0)


if __name__ == "__main__":
    unittest.main()

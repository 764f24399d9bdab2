# SPDX-License-Identifier: GPL-2.0-or-later
"""The drum: its NURBS file against the cylinder, its triangles against area and volume, particles."""

import math
import re
import unittest

import numpy as np
import yaml
from scipy.interpolate import BSpline
from scipy.spatial import cKDTree

from study.build.drum import Drum, atom_data

DRUM = Drum(0.1, 0.05)
RADII = (2.1e-3, 2.9e-3)


def points(patch: dict, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Points (3, len(xi)) of a rational patch at parameters (xi, eta)."""
    (p, q), (U, V) = patch["degrees"], (np.array(knots, dtype=float) for knots in patch["knots"])
    n, m = len(U) - p - 1, len(V) - q - 1
    weights = np.array(patch["weights"], dtype=float).reshape(m, n)
    homogeneous = np.concatenate(
        [np.array(patch["control_points"], dtype=float).reshape(m, n, 3) * weights[..., None], weights[..., None]], axis=2
    )
    x, y, z, w = np.einsum("nj,ni,jid->dn", BSpline(V, np.eye(m), q)(eta), BSpline(U, np.eye(n), p)(xi), homogeneous)
    return np.array([x, y, z]) / w


class Geometry(unittest.TestCase):
    def test_nurbs_patches_are_the_cylinder_and_its_caps(self):
        shell, *caps = yaml.safe_load(DRUM.model_file(8, 3))["geometry"]["patches"]
        xi, eta = np.random.default_rng(0).uniform(size=(2, 500))
        x, y, z = points(shell, xi, eta)
        np.testing.assert_allclose(np.hypot(x, z), DRUM.radius, rtol=1e-14)
        np.testing.assert_allclose(y, DRUM.length * (eta - 0.5), atol=1e-16)
        np.testing.assert_allclose(points(shell, np.zeros(9), eta[:9]), points(shell, np.ones(9), eta[:9]), atol=1e-16)
        for cap, height in zip(caps, (-0.025, 0.025)):
            x, y, z = points(cap, xi, eta)
            np.testing.assert_allclose(y, height, rtol=1e-14)
            np.testing.assert_allclose(np.hypot(x, z), DRUM.radius * eta, atol=1e-16)

    def test_triangles_are_the_prism_over_the_polygon(self):
        facets = 40
        corners = re.findall(r"vertex (\S+) (\S+) (\S+)", DRUM.triangles(facets))
        triangles = np.array(corners, dtype=float).reshape(-1, 3, 3)
        area = 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
        polygon = 0.5 * facets * DRUM.radius**2 * math.sin(2.0 * math.pi / facets)
        girth = 2.0 * facets * DRUM.radius * math.sin(math.pi / facets)
        self.assertAlmostEqual(area.sum(), 2.0 * polygon + girth * DRUM.length, delta=1e-12)
        self.assertGreater(area.min(), 1e-7)
        edges = [tuple(sorted((tuple(t[k]), tuple(t[k - 1])))) for t in np.round(triangles, 12).tolist() for k in range(3)]
        counts = np.unique([edges.index(e) for e in edges], return_counts=True)[1]
        self.assertTrue((counts == 2).all(), "the surface is closed: two triangles at each edge")

    def test_bed_is_inside_and_apart(self):
        centres, radii = DRUM.bed(5000, RADII, 1)
        self.assertEqual((len(radii), radii.min() >= RADII[0], radii.max() <= RADII[1]), (5000, True, True))
        self.assertLess(np.hypot(centres[:, 0], centres[:, 2]).max(), DRUM.radius - RADII[1])
        self.assertLessEqual(np.abs(centres[:, 1]).max(), 0.5 * DRUM.length - RADII[1] + 1e-15)
        self.assertGreater(cKDTree(centres).query(centres, 2)[0][:, 1].min(), 2.0 * RADII[1])
        with self.assertRaisesRegex(ValueError, "100000 particles do not fit"):
            DRUM.bed(100000, RADII, 1)

    def test_atom_data(self):
        text = atom_data(DRUM, np.array([[0.01, -0.02, 0.03]]), np.array([2e-3]), 2500.0)
        self.assertIn("1 atoms", text)
        self.assertIn("-0.11000000000000001 0.11000000000000001 xlo xhi", text)
        self.assertTrue(text.endswith("1 1 0.004 2500.0 0.01 -0.02 0.03\n"))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""The benchmark of walls: its shapes, and what it makes of what was measured."""

import re
import unittest

import numpy as np
from scipy.spatial.distance import pdist

import compliance
import wall_shapes
import walls
from wall_runs import DECKS, touching, touching_rows
from walls import Measured, Pair, Wall


class Shapes(unittest.TestCase):
    def test_drums_are_closed_and_have_the_triangles_of_their_names(self):
        for count, (sides, bands) in walls.DRUMS.items():
            corners = np.array(wall_shapes.drum(sides, bands))
            self.assertEqual(corners.shape, (count, 3, 3))
            areas = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            np.testing.assert_allclose(areas.sum(axis=0), 0.0, atol=1e-15)
            volume = np.einsum("ij,ij->", areas, corners[:, 0]) / 3.0
            self.assertAlmostEqual(volume / prism(sides), 1.0, delta=1e-12)
            self.assertAlmostEqual(corners[:, :, 2].min(), 0.0, delta=1e-15)

    def test_spheres_are_apart_and_above_the_wall(self):
        for hollow in (False, True):
            rows = wall_shapes.spheres(hollow).split("Atoms\n\n")[1].split("\n\nVelocities")[0].splitlines()
            _, _, diameter, _, *centres = np.array([row.split() for row in rows], dtype=float).T
            _, y, z = centres
            gap = wall_shapes.RADIUS - np.hypot(y, z - wall_shapes.RADIUS) if hollow else z
            self.assertGreater((gap - 0.5 * diameter).min(), 0.0)
            self.assertGreater(pdist(np.transpose(centres)).min(), diameter.max())


class Compliance(unittest.TestCase):
    def test_spheres_overlap_the_solid_each_at_a_place_of_its_own(self):
        for name, body in compliance.BODIES.items():
            centres = body.centres(compliance.OVERLAP)
            height = centres[2] if name == "plate" else np.hypot(centres[0], centres[2]) - compliance.RING
            np.testing.assert_allclose(compliance.RADIUS - height, compliance.OVERLAP, rtol=1e-6)
            self.assertLess(np.abs(centres[1]).max(), 0.03)
            self.assertEqual(centres.shape, (3, compliance.SPHERES))
            self.assertGreater(pdist(centres.T).min(), 0.1 * compliance.SIZE / compliance.PER_ELEMENT)
        self.assertIn("neigh_modify exclude group all all", compliance.DECK)

    def test_the_ratio_has_a_bound(self):
        for corrected, passes in ((1.49e-7, True), (1.51e-7, False)):
            self.assertEqual(compliance.rows("plate", 1e-7, corrected)[-1].passes, passes)


def prism(sides: int) -> float:
    """Volume about the circle, in closed form [m3]."""
    return sides * wall_shapes.RADIUS**2 * np.tan(np.pi / sides) * wall_shapes.SIDE


class Report(unittest.TestCase):
    PAIR = Pair("box", Wall("nurbs", "12.stl"), Wall("triangles", "12.stl"), walls.HOLLOW, 0.8)

    def test_least_times_of_step_and_contact(self):
        ours, stock, ratio = walls.rows(self.PAIR, Measured([3e-4, 2e-4], [1100, 900]), Measured([4e-4, 9e-4], [800]))
        self.assertEqual([ours.value, stock.value, ratio.value], [200.0, 400.0, 0.5])
        self.assertEqual(ours.note, "up to 300 us; 200 ns for each of 1000 that touch, 900 to 1100")
        self.assertTrue(ratio.passes)
        self.assertFalse(walls.rows(self.PAIR, Measured([3.3e-4], [1000]), Measured([4e-4], [800]))[-1].passes)

    def test_the_other_is_named(self):
        pair = Pair("beyond", Wall("nurbs", "wider.yaml"), Wall("nurbs", "box.yaml"), walls.LEVEL, 1.2, "box_wide")
        found = walls.rows(pair, Measured([2.5e-4], [1000]), Measured([2e-4], [1000]))
        self.assertEqual([row.quantity for row in found], ["ours_per_step", "box_wide_per_step", "ours_over_box_wide"])
        self.assertFalse(found[-1].passes)  # 1.25 of 1.2

    def test_reading(self):
        seconds, peak = {"nurbs": 3.0, "triangles": 2.0}, {"nurbs": 2.0 * 2**20, "triangles": 2**20}
        found = {row.quantity: row for row in walls.reading_rows(seconds, peak)}
        self.assertEqual(found["ours_memory"].value, 2.0)
        self.assertTrue(found["time_ours_over_stock"].passes)  # 1.5 of 2
        self.assertFalse(found["memory_ours_over_stock"].passes)  # 2 of 1.5

    def test_touching_is_the_last_number(self):
        log = "LIGGGHTS\n    Step Atoms KinEng touching\n 0 1680 0.1 0\n 50 1680 0.2 1234\nLoop time of 1\n"
        self.assertEqual(touching(log), 1234)
        self.assertEqual(touching_rows(log.replace("1234", "99") + log), [0, 1234])


class Decks(unittest.TestCase):
    def test_each_wall_has_a_deck(self):
        for wall in (wall for pair in walls.PAIRS for wall in pair.walls):
            text = (DECKS / f"in.{wall.deck}").read_text(encoding="utf-8")
            self.assertTrue(re.search(r"^fix (wall|\$\{id\}) all wall/.*\$\{store\}", text, re.MULTILINE), wall.deck)

    def test_aims(self):
        aims = {pair.case: pair.aim for pair in walls.PAIRS}
        moving = [aims[f"{n} triangles, moving"] for n in (12, 92, 1616, 30752, 123008)]
        self.assertEqual(moving, [0.8, 0.8, 0.8, 0.15, 0.15])
        self.assertEqual({aims[case] for case in ("plane, by words", "plane, 2 triangles", "cylinder, by words")}, {1.5})
        self.assertEqual({aims[f"{wall} beyond a periodic box"] for wall in ("plane", "waves")}, {1.2})


if __name__ == "__main__":
    unittest.main()

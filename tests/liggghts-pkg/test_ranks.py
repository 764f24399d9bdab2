# SPDX-License-Identifier: GPL-2.0-or-later
"""1, 2 and 4 ranks give the same run of balls on a bending plate, which is cut into 2 x 2 boxes; also where ranks are left
without elements or without particles."""

import unittest

import ball_on_block as bob
import decks


def plate(elements):
    return bob.block(
        size=(16e-3, 12e-3, 1e-3), elements=elements, youngs_modulus=74.6e9, nu=0.2285, density=2480.0,
        fixed=("xi-", "xi+", "eta-", "eta+"),
    )


IN_FOUR_BOXES, IN_ONE_BOX = plate((34, 18, 1)), plate((16, 8, 1))
GLASS = (74.6e9, 0.2285)
# one on the border of all ranks, the others on ranks of their own, at their own times
BALLS = ((0.0, 0.0, 1e-3), (-4e-3, 3e-3, 1.0003e-3), (5e-3, 3.1e-3, 1.0008e-3), (4e-3, -3e-3, 1.0005e-3), (-5e-3, -2e-3, 1e-3))
COLUMNS = tuple(range(1, 22))


class Ranks(unittest.TestCase):
    def bounce(self, ranks, processors, model=IN_FOUR_BOXES):
        deck = bob.prelude(
            balls=BALLS, velocity=(0.4, -0.3, -1.0), ball=GLASS, wall=GLASS, restitution=0.8, friction=0.3,
            models="model hertz tangential history", timestep=2e-8, processors=processors,
        )
        deck += bob.wall("model hertz tangential history", "structure plate.yaml surface top") + bob.output(COLUMNS)
        return decks.good(deck + "run 500\n", files={"plate.yaml": model}, ranks=ranks).table

    def check(self, model, *cuts):
        one = self.bounce(1, "1 1 1", model)
        self.assertEqual(one["plate7"].max(), 5, "all balls touch at once for a while")
        self.assertLess(one["plate20"].min(), -1e-7, "the plate bends")
        for ranks, processors in cuts:
            more = self.bounce(ranks, processors, model)
            for column, reference in one.items():
                with self.subTest(processors=processors, column=column):
                    self.assertLessEqual(decks.largest_difference(more[column], reference), 1e-11)
                    if column.startswith("plate"):  # balls do not touch each other
                        self.assertTrue((more[column] == reference).all(), "to the last bit")

    def test_same_history_on_1_2_and_4_ranks(self):
        self.check(IN_FOUR_BOXES, (2, "2 1 1"), (4, "2 2 1"))

    def test_ranks_without_elements_or_without_particles(self):
        """One box: the others have no elements; ranks one above the other: all particles are with one of them."""
        self.check(IN_ONE_BOX, (4, "2 2 1"), (4, "1 1 4"))

    def test_corrected_mass(self):
        self.check(IN_FOUR_BOXES + "integration: {mass: corrected}\ndamping: {mass: 1e4}\n", (4, "2 2 1"))


if __name__ == "__main__":
    unittest.main()

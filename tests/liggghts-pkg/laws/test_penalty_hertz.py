# SPDX-License-Identifier: GPL-2.0-or-later
"""penalty/hertz with lambda = 1 is LIGGGHTS' hertz to the last bit: force, damping, tangential part."""

import itertools
import unittest

import numpy as np

import contact_deck

WALL = dict(velocity=(0.7, -0.2, -1.0), spin=(100.0, 50.0, -30.0), restitution=0.7, friction=0.3)
PAIR = dict(velocity=(1.0, 0.6, -0.3), spin=(80.0, -20.0, 60.0), restitution=0.7, friction=0.3)
REST = (
    ("tangential off", ""),
    ("tangential no_history", ""),
    ("tangential history", ""),
    ("tangential history rolling_friction epsd2", ""),
    ("tangential history cohesion sjkr", ""),
    ("tangential history cohesion sjkr rolling_friction epsd2", "tangential_damping off limitForce on"),
    ("tangential no_history cohesion sjkr2 rolling_friction cdt", "tangential_reduce on torsionTorque on"),
)


class SameAsHertz(unittest.TestCase):
    def compare(self, deck, common, force, **options):
        cases = list(itertools.product(REST, ("hertz", "penalty/hertz")))
        tables = contact_deck.run_each(
            (
                deck(f"model {normal} {rest}", settings=settings, **common) + "run 700\n"
                for (rest, settings), normal in cases
            ),
            **options,
        )
        for (rest, settings), stock, ours in zip(REST, tables[::2], tables[1::2]):
            with self.subTest(rest=rest, settings=settings):
                self.assertGreater(stock[force].max(), 4.0)
                for column, values in stock.items():
                    np.testing.assert_array_equal(ours[column], values, err_msg=column)

    def test_wall(self):
        self.compare(contact_deck.ball_on_plane, WALL, "fz1")

    def test_pair(self):
        self.compare(contact_deck.two_balls, PAIR, "fx2")

    def test_pair_across_a_rank_border(self):
        self.compare(contact_deck.two_balls, PAIR, "fx2", ranks=2)

    def test_lambda_scales_the_force(self):
        one, two = contact_deck.run_each(
            contact_deck.ball_on_plane("model penalty/hertz", overlap=1e-6, factor=factor) + "run 0\n"
            for factor in (1.0, 2.0)
        )
        np.testing.assert_array_equal(two["fz1"], 2.0 * one["fz1"])


if __name__ == "__main__":
    unittest.main()

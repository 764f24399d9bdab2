# SPDX-License-Identifier: GPL-2.0-or-later
"""`compliance corrected` in decks: the same digits on any number of ranks and over restarts, momentum, forces on two meshes,
coefficients of restitution, and elements that are too small."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks

CORRECTED = "structure block.yaml surface top compliance corrected"
GLASS, STEEL = (74.6e9, 0.2285), (210.6e9, 0.286)
WITHOUT = CORRECTED.replace("corrected", "none")
MODELS = "model hertz tangential history"
SETTINGS = dict(ball=GLASS, wall=GLASS, restitution=0.6, friction=0.3, models=MODELS, timestep=1e-8, velocity=(0.4, -0.3, -1.0))
BALLS = ((0.0, 0.0, 1e-3), (-4e-3, 3e-3, 1.0003e-3), (5e-3, 3.1e-3, 1.0008e-3), (4e-3, -3e-3, 1.0005e-3))
COLUMNS = tuple(range(1, 22))


def glass(size, elements, fixed=("zeta-",)):
    return bob.block(size=size, elements=elements, youngs_modulus=GLASS[0], nu=GLASS[1], density=2480.0, fixed=fixed)


PLATE = glass((16e-3, 12e-3, 1e-3), (34, 18, 1), ("xi-", "xi+", "eta-", "eta+"))


class Ranks(unittest.TestCase):
    def bounce(self, ranks=1, processors="1 1 1", words=CORRECTED):
        deck = bob.prelude(balls=BALLS, processors=processors, **SETTINGS) + bob.wall(MODELS, words) + bob.output(COLUMNS)
        return decks.good(deck + "run 500\n", files={"block.yaml": PLATE}, ranks=ranks).table

    def test_same_history_on_1_2_and_4_ranks(self):
        one = self.bounce()
        self.assertEqual(one["plate7"].max(), 4)
        for ranks, processors in ((2, "2 1 1"), (4, "2 2 1")):
            more = self.bounce(ranks, processors)
            for column in one:
                if column.startswith("plate"):
                    self.assertTrue((more[column] == one[column]).all(), f"{column} on {ranks} ranks")

    def test_momentum_goes_from_the_ball_to_the_block(self):
        """Of a free block: the force along the surface has its reaction."""
        deck = bob.prelude(**SETTINGS | dict(friction=0.0, timestep=5e-9)) + bob.wall(MODELS, CORRECTED)
        deck += bob.output((9, 10, 11)) + "run 200\n"
        table = decks.good(deck, files={"block.yaml": glass((4e-3, 4e-3, 2e-3), (12, 12, 6), ())}).table
        mass = 4.0 / 3.0 * np.pi * bob.RADIUS**3 * bob.DENSITY
        for v, p in (("vx", "plate9"), ("vy", "plate10"), ("vz", "plate11")):
            total = mass * table[v] + table[p]
            self.assertLess(np.abs(total - total[0]).max(), 1e-12 * mass, v)
        self.assertGreater(np.abs(table["plate11"]).max(), 1e-7 * mass)


class Restart(unittest.TestCase):
    def test_a_run_goes_on_in_a_contact_to_the_last_bit(self):
        wall = bob.wall(MODELS, CORRECTED) + bob.output((3, 7, 15))
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "block.yaml").write_text(PLATE)
            first = decks.run_in(Path(folder), bob.prelude(**SETTINGS) + wall + "run 260\nwrite_restart contact\nrun 60\n")
            again = decks.run_in(Path(folder), bob.prelude(restart="contact", **SETTINGS) + wall + "run 60\n")
        self.assertEqual((first.code, again.code), (0, 0), first.text[-2000:] + again.text[-2000:])
        whole, rest = first.tables[-1], again.tables[-1]
        self.assertEqual(whole["plate7"].min(), 1.0)
        for column in whole:
            self.assertTrue((whole[column] == rest[column]).all(), column)


class Meshes(unittest.TestCase):
    def peak(self, elements, words=CORRECTED):
        deck = bob.prelude(**SETTINGS | dict(restitution=1.0, friction=0.0, velocity=(0, 0, -1))) + bob.wall(MODELS, words)
        block = glass((4e-3, 4e-3, 2e-3), elements)
        return -decks.good(deck + bob.output((3,)) + "run 500\n", files={"block.yaml": block}).table["plate3"].min()

    def test_a_finer_mesh_has_the_same_force(self):
        coarse, fine = ((8, 8, 4), (16, 16, 8))
        self.assertLess(abs(self.peak(fine) / self.peak(coarse) - 1.0), 4e-3)
        self.assertLess(self.peak(fine, WITHOUT) / self.peak(coarse, WITHOUT), 0.975)

    def rigid_ball(self, elements, x):
        """What a ball that gives way by nothing does to a small steel block: the peak of its force, and the speed that it leaves by."""
        settings = SETTINGS | dict(ball=(1e20, 0.2), wall=STEEL, restitution=1.0, friction=0.0, velocity=(0, 0, -1), timestep=5e-9)
        deck = bob.prelude(balls=((x, x, bob.RADIUS),), **settings) + bob.wall(MODELS, CORRECTED)
        block = bob.block(size=(1.2e-3, 1.2e-3, 0.8e-3), elements=elements, youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0)
        table = decks.good(deck + bob.output((3,)) + "run 1000\n", files={"block.yaml": block}).table
        return -table["plate3"].min(), table["vz"][-1]

    def test_a_point_force_will_do_up_to_the_limit(self):
        """Elements of 2.9 contact radii, hit in the middle: s comes to 0.86."""
        coarse, fine = self.rigid_ball((6, 6, 4), 1e-4), self.rigid_ball((12, 12, 8), 5e-5)
        self.assertLess(abs(fine[0] / coarse[0] - 1.0), 4e-3)
        self.assertLess(abs(fine[1] / coarse[1] - 1.0), 4e-3)
        self.assertLess(fine[1], 1.0)

    def oblique(self, elements, x, words=CORRECTED):
        """The speed along a steel block by which a ball that gives way by nothing leaves; it comes with 0.2 m/s, and mostly sticks."""
        settings = SETTINGS | dict(ball=(1e20, 0.0), wall=STEEL, restitution=1.0, velocity=(0.2, 0, -1), timestep=7e-9)
        deck = bob.prelude(balls=((x, x, bob.RADIUS),), **settings) + bob.wall(MODELS, words)
        block = bob.block(size=(3e-3, 3e-3, 2e-3), elements=elements, youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0)
        return decks.good(deck + bob.output((7,)) + "run 800\n", files={"block.yaml": block}).table["vx"][-1]

    def test_friction_does_not_depend_on_the_mesh(self):
        coarse, fine, without = (
            self.oblique((12, 12, 8), 1.25e-4), self.oblique((18, 18, 12), 2.5e-4 / 3), self.oblique((18, 18, 12), 2.5e-4 / 3, WITHOUT))
        self.assertLess(abs(fine - coarse), 0.004 * 0.2)
        self.assertGreater(abs(without - coarse), 0.01 * 0.2)

    def test_elements_that_are_too_small_stop_the_run(self):
        deck = bob.prelude(**SETTINGS | dict(timestep=1e-9, velocity=(0, 0, -20))) + bob.wall(MODELS, CORRECTED) + bob.output(())
        run = decks.run(deck + "run 4000\n", files={"block.yaml": glass((1e-3, 1e-3, 0.5e-3), (12, 12, 6))})
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], "elements at .* too small for the contact of particle 1 .* or 'compliance none'")


class Damping(unittest.TestCase):
    """The law's own coefficient of restitution, as on a rigid wall; a steel block hardly takes waves from a ball of glass."""

    BLOCK = bob.block(size=(3e-3, 3e-3, 2e-3), elements=(12, 12, 8), youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0)

    def restitution(self, law, words=CORRECTED):
        deck = bob.prelude(**SETTINGS | dict(wall=STEEL, restitution=law, friction=0.0, velocity=(0, 0, -1))) + bob.wall(MODELS, words)
        table = decks.good(deck + bob.output((7,)) + "run 800\n", files={"block.yaml": self.BLOCK}).table
        self.assertEqual(table["plate7"][-1], 0.0)
        return table["vz"][-1]

    def test_the_ball_leaves_as_fast_as_its_law_says(self):
        for law in (0.3, 0.6, 0.95):
            self.assertLess(abs(self.restitution(law) / law - 1.0), 0.01, law)


if __name__ == "__main__":
    unittest.main()

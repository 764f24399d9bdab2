# SPDX-License-Identifier: GPL-2.0-or-later
"""`compliance corrected` where elements are so small beside a contact that its force is spread over them: a ball of steel on elements
of its own material that are 1.2 contact radii long.  Energy, momentum, damping, friction, ranks and restart."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
from test_compliance import COLUMNS, CORRECTED, MODELS, STEEL

FRICTIONLESS = "model hertz tangential no_history"
SIDE = 0.768e-3  # [m]
PLACE = (0.031e-3, 0.017e-3)  # on no border, and in no middle
FINE, COARSE = (16, 16, 8), (8, 8, 4)
SETTINGS = dict(ball=STEEL, wall=STEEL, restitution=1.0, models=FRICTIONLESS, timestep=2e-9, velocity=(0.0, 0.0, -1.0), balls=((*PLACE, bob.RADIUS),))


def block(elements, fixed=("zeta-",), law="linear_elastic", longer=1):
    n, m, k = elements
    model = bob.block((longer * SIDE, SIDE, 0.5 * SIDE), (longer * n, m, k), STEEL[0], STEEL[1], 7850.0, fixed)
    return model.replace("linear_elastic", law)


class SpreadForces(unittest.TestCase):
    def bounce(self, model, columns=COLUMNS, models=FRICTIONLESS, steps=2600, more=(), **settings):
        """Until nothing touches."""
        deck = bob.prelude(**SETTINGS | dict(models=models) | settings) + bob.wall(models, CORRECTED) + bob.output(columns, more=more)
        table = decks.good(deck + f"run {steps}\n", files={"block.yaml": model}, timeout=300).table
        self.assertEqual(table["plate7"][-1], 0.0)
        return table

    def test_a_contact_that_slides_over_elements_keeps_the_energy(self):
        table = self.bounce(block(FINE, longer=2), velocity=(20.0, 5.0, -1.0))
        energy = table["KinEng"] + table["plate15"] + table["plate16"]
        impact = energy[0] / 426.0
        print(f"energy: {(energy[-1] - energy[0]) / impact:.2e} of the impact's")
        self.assertLess(abs(energy[-1] - energy[0]), 2e-5 * impact)

    def test_momentum_goes_to_the_block(self):
        """Linear to round-off, angular almost; friction turns both.  The law turns with the body."""
        for friction, models in ((0.0, FRICTIONLESS), (0.3, MODELS)):
            table = self.bounce(block(FINE, (), "saint_venant_kirchhoff"), models=models, friction=friction, velocity=(0.3, -0.2, -1.0),
                                more=("omegax", "omegay", "omegaz"))  # fmt: skip
            mass = 4.0 / 3.0 * np.pi * bob.RADIUS**3 * bob.DENSITY
            place, velocity, omega = (np.stack([table[f"{v}{d}"] for d in "xyz"], axis=1) for v in ("", "v", "omega"))
            momentum = mass * velocity + np.stack([table[f"plate{k}"] for k in (9, 10, 11)], axis=1)
            self.assertLess(np.abs(momentum - momentum[0]).max(), 1e-12 * mass)
            angular = mass * np.cross(place, velocity) + 0.4 * mass * bob.RADIUS**2 * omega
            angular += np.stack([table[f"plate{k}"] for k in (12, 13, 14)], axis=1)
            print(f"angular momentum: {np.abs(angular - angular[0]).max() / (mass * bob.RADIUS):.2e}")
            self.assertLess(np.abs(angular - angular[0]).max(), 1e-8 * mass * bob.RADIUS)

    def test_force_and_speed_are_those_on_coarse_elements(self):
        coarse, fine = (self.bounce(block(elements)) for elements in (COARSE, FINE))
        force, speed = (fine[c].max() / coarse[c].max() - 1.0 for c in ("fz", "vz"))
        print(f"force {force:.2e}, speed {speed:.2e}")
        self.assertLess(abs(force), 0.006)
        self.assertLess(abs(speed), 0.004)

    def test_damping_is_that_of_the_law(self):
        for law in (0.6, 0.8):
            speed = self.bounce(block(FINE), restitution=law, timestep=1.4e-9, steps=4000)["vz"][-1]
            print(f"restitution {law}: {speed:.4f}")
            self.assertLess(abs(speed / law - 1.0), 0.01)

    def test_friction_is_that_on_coarse_elements(self):
        """It sticks and swings back while the ball is there, so what is left is a small difference of both ways."""
        coarse, fine = (self.bounce(block(elements), models=MODELS, friction=0.5, velocity=(0.1, 0.0, -1.0), more=("omegay",))
                        for elements in (COARSE, FINE))  # fmt: skip
        for name, size, most in (("vx", 0.1, 0.02), ("omegay", 0.1 / bob.RADIUS, 0.03)):
            print(f"{name}: {coarse[name][-1] / size:.4f}, {fine[name][-1] / size:.4f}")
            self.assertLess(abs(fine[name][-1] - coarse[name][-1]), most * size)
        self.assertLess(np.abs(fine["fx"]).max() / np.abs(coarse["fx"]).max() - 1.0, 0.01)


class SmallElements(unittest.TestCase):
    def test_a_run_stops_where_elements_turn_below_a_contact(self):
        """F r/(E' h^3) is 0.35 at 1 m/s, and goes as the speed to the power of 6/5."""
        deck = bob.prelude(**SETTINGS | dict(velocity=(0.0, 0.0, -1.3))) + bob.wall(FRICTIONLESS, CORRECTED)
        run = decks.run(deck + "run 1400\n", files={"block.yaml": block(FINE)})
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], r"elements at .* too small for the contact of particle 1 .* they turn below it \(0.41, "
                         r"expected at most 0.41\); use elements at least 1.1 times as large there, or 'compliance none'")  # fmt: skip


class Digits(unittest.TestCase):
    """Two balls, whose forces go over the borders of a body's boxes; damped, with friction."""

    PAIR = SETTINGS | dict(models=MODELS, restitution=0.8, friction=0.3, velocity=(0.4, -0.3, -1.0), timestep=1.4e-9,
                           balls=((-1.02e-3, 0.013e-3, bob.RADIUS), (1.02e-3, -0.02e-3, 1.0001e-3)))  # fmt: skip
    BLOCK = block((16, 16, 8), ("zeta-",), longer=4)

    def test_same_on_1_2_and_4_ranks_and_after_a_restart(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "contact"
            deck = bob.prelude(**self.PAIR) + bob.wall(MODELS, CORRECTED) + bob.output(COLUMNS) + f"run 1200\nwrite_restart {path}\nrun 60\n"
            again = bob.prelude(restart=path, **self.PAIR) + bob.wall(MODELS, CORRECTED) + bob.output(COLUMNS) + "run 60\n"
            one = decks.good(deck, files={"block.yaml": self.BLOCK}, timeout=300)
            last = one.tables[-1]
            self.assertEqual(last["plate7"].max(), 2)
            self.assertLess(last["plate3"].max(), -12.0)  # spread from 2 N on each
            for ranks, processors in ((1, "1 1 1"), (2, "2 1 1"), (4, "2 2 1")):
                with self.subTest(ranks=ranks):
                    text = deck.replace("processors * * *", f"processors {processors}")
                    more = decks.good(text, files={"block.yaml": self.BLOCK}, ranks=ranks, timeout=300).tables[-1] if ranks > 1 else last
                    restarted = decks.good(again, files={"block.yaml": self.BLOCK}, ranks=ranks, timeout=300).table
                    for column in (c for c in last if c.startswith("plate")):
                        self.assertTrue((more[column] == last[column]).all(), column)
                        self.assertTrue((restarted[column] == last[column]).all(), f"{column} after a restart")


if __name__ == "__main__":
    unittest.main()

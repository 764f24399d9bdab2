# SPDX-License-Identifier: GPL-2.0-or-later
"""`compliance corrected` with laws that damp: coefficients of restitution, energy that never grows, and what flies along."""

import unittest

import numpy as np

import ball_on_block as bob
import decks
from test_compliance import CORRECTED, GLASS, MODELS, SETTINGS, STEEL, WITHOUT, glass


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


class Rest(unittest.TestCase):
    """A ball comes to rest on a strip that nothing damps: what the contact takes from it, or gives to it, is all there is."""

    STRIP = """units: si
geometry: {box: {origin: [-0.01, -0.002, -0.0007], size: [0.02, 0.004, 0.0007], elements: [12, 2, 1], degree: [2, 2, 3]}}
material: {law: linear_elastic, youngs_modulus: 2e9, poissons_ratio: 0.35, density: 1200}
boundary: [{fix: [x, y, z], faces: [xi-, xi+]}]
surfaces: {top: zeta+}
"""

    def energies(self, restitution):
        """Of ball and strip in steps without contact, over that of the beginning."""
        speed, gravity = 0.1, 30.0
        mass = 4.0 / 3.0 * np.pi * bob.RADIUS**3 * bob.DENSITY
        deck = bob.prelude(
            ball=(70e9, 0.22), wall=(2e9, 0.35), restitution=restitution, friction=0.3, models=MODELS, timestep=1.3e-7,
            balls=((0.3e-3, 0.1e-3, bob.RADIUS),), velocity=(0.0, 0.0, -speed),
        )  # fmt: skip
        deck += f"fix gravity all gravity {gravity} vector 0 0 -1\n" + bob.wall(MODELS, CORRECTED) + bob.output((3, 15, 16), every=100)
        table = decks.good(deck + "run 100000\n", files={"block.yaml": self.STRIP}).table
        total = 0.5 * mass * sum(table[f"v{d}"] ** 2 for d in "xyz") + mass * gravity * (table["z"] - bob.RADIUS)
        total += table["plate15"] + table["plate16"]
        return total[table["plate3"] == 0.0] / (0.5 * mass * speed**2)

    def test_a_damped_contact_never_gives_energy(self):
        for restitution in (0.3, 0.5, 0.9):
            energies = self.energies(restitution)
            with self.subTest(restitution):
                self.assertGreater(len(energies), 300)
                self.assertLess((energies - np.minimum.accumulate(energies)).max(), 1e-3)
                self.assertLess(energies[-1], restitution)


class HeavyBalls(unittest.TestCase):
    """Of steel, on a thin plate of it that weighs a fifth and less: where it is hit it is gone at once."""

    def deck(self, side, timestep, words, friction=0.0, along=0.0):
        plate = bob.block(size=(side, side, side / 30), elements=(30, 30, 1), youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0, fixed=("xi-", "xi+"))
        settings = SETTINGS | dict(ball=STEEL, wall=STEEL, restitution=0.5, friction=friction, timestep=timestep, velocity=(along, 0, -1))
        deck = bob.prelude(**settings).replace(f"density {bob.DENSITY}", "density 7850") + bob.wall(MODELS, words)
        return deck + bob.output((15, 16), every=10, more=("omegax", "omegay", "omegaz")), {"block.yaml": plate.replace("linear_elastic", "saint_venant_kirchhoff")}

    def test_they_gain_no_energy(self):
        for friction, along in ((0.0, 0.0), (0.5, 1.0)):
            with self.subTest(friction):
                deck, files = self.deck(3e-3, 1.5e-9, CORRECTED, friction, along)
                table = decks.good(deck + "run 6000\n", files=files).table
                moment = 0.4 * 7850 * 4.0 / 3.0 * np.pi * bob.RADIUS**5
                spin = 0.5 * moment * sum(table[f"omega{d}"] ** 2 for d in "xyz")
                energy = table["KinEng"] + spin + table["plate15"] + table["plate16"]
                self.assertLess(energy.max() / energy[0], 1.0 + 1e-6)
                self.assertLess(energy[-1] / energy[0], 0.99)

    def test_a_damper_that_is_too_strong_for_light_nodes_stops_the_run(self):
        deck, files = self.deck(2.25e-3, 2.5e-9, WITHOUT)
        run = decks.run(deck + "run 10000\n", files=files)
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], "particle 1 is too stiff for the timestep 2.5e-09 .* with a damping of .* use a timestep of at most")


class Moving(unittest.TestCase):
    """What flies along with ball and body sees the same, although the normal turns."""

    def velocity(self, frame, size=(4e-3, 4e-3, 0.5e-3), elements=(8, 8, 1), spin=0.0, friction=0.0, ball=(0.0, 0.0, -0.5)):
        """Of the ball that comes with the velocity `ball`, the block turning about y, in a frame of this velocity."""
        block = glass(size, elements, ()).replace("linear_elastic", "neo_hooke").replace(f"{GLASS[0]}", "1e7")
        settings = SETTINGS | dict(wall=(1e7, GLASS[1]), ball=(1e7, 0.3), restitution=0.3, friction=friction, timestep=2e-7)
        settings |= dict(balls=((1e-3, 0.2e-3, 1e-3),), velocity=np.add(frame, ball))
        deck = bob.prelude(**settings) + bob.wall(MODELS, CORRECTED)
        u, v, w = frame
        velocity = f'["{u} + {spin} * z", "{v}", "{w} - {spin} * x"]'
        files = {"block.yaml": block + f"initial: {{velocity: {velocity}}}\n"}
        table = decks.good(deck + bob.output((3,), every=100) + "run 3000\n", files=files).table
        return np.array([table[axis][-1] for axis in ("vx", "vy", "vz")]) - frame

    def test_a_damped_contact_is_the_same(self):
        still = self.velocity((0.0, 0.0, 0.0))
        self.assertGreater(still[2], -0.4)
        np.testing.assert_allclose(self.velocity((3.0, 0.0, 0.0)), still, rtol=0, atol=1e-9)

    def test_a_damped_spring_along_the_surface_is_the_same(self):
        settings = dict(size=(4e-3, 4e-3, 3e-3), elements=(6, 6, 4), spin=100.0, friction=0.9, ball=(0.2, 0.1, -0.5))
        still = self.velocity((0.0, 0.0, 0.0), **settings)
        self.assertGreater(abs(still[0] - 0.2), 0.01, "it is felt")
        np.testing.assert_allclose(self.velocity((0.0, 0.0, 3.0), **settings), still, rtol=0, atol=1e-9)


if __name__ == "__main__":
    unittest.main()

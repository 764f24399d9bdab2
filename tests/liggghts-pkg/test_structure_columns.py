# SPDX-License-Identifier: GPL-2.0-or-later
"""The columns of fix wall/nurbs that tell of the solid, all of them: a free block flies until it meets a ball."""

import unittest

import numpy as np

import ball_on_block as bob
import decks

VELOCITY = np.array([0.3, -0.2, 0.5])
SIZE, DENSITY = (4e-3, 4e-3, 2e-3), 1000.0
CENTRE = np.array([0.0, 0.0, -1e-3])
BALL = np.array([0.7e-3, -0.4e-3, 1.0005e-3])  # beside the block's middle, so that the hit turns it
STEP = 1e-8
# velocity Verlet keeps momentum and, for a law that is objective, angular momentum, to round-off
ROUND_OFF = 1e-11

MODEL = bob.block(SIZE, density=DENSITY, fixed=()).replace("linear_elastic", "saint_venant_kirchhoff")
MODEL += f"initial: {{velocity: {list(VELOCITY)}}}\n"
SPIN = "compute spin all property/atom omegax omegay omegaz\n"


def vector(table: dict[str, np.ndarray], *names: str) -> np.ndarray:
    return np.stack([table[name] for name in names], axis=-1)


class StructureColumns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        deck = (
            bob.prelude(balls=(tuple(BALL),), velocity=(0, 0, 0), timestep=STEP) + bob.wall()
            + bob.output(range(1, 22)) + "run 2500\n"
        )  # fmt: skip
        cls.table = decks.good(deck, files={"block.yaml": MODEL}).table
        cls.touches = cls.table["plate7"] > 0

    def columns(self, first: int) -> np.ndarray:
        return vector(self.table, *(f"plate{first + k}" for k in range(3)))

    def test_free_flight(self):
        """m v, m c x v, m v^2/2, no strain, v t."""
        before = np.arange(len(self.touches)) < np.argmax(self.touches)
        self.assertGreater(before.sum(), 5)
        mass = DENSITY * np.prod(SIZE)
        time = STEP * self.table["Step"][before, None]
        centre = CENTRE + VELOCITY * time
        momentum = mass * VELOCITY
        for name, found, expected in (
            ("momentum", self.columns(9)[before], np.broadcast_to(momentum, centre.shape)),
            ("angular momentum", self.columns(12)[before], np.cross(centre, momentum)),
            ("kinetic energy", self.table["plate15"][before], np.full(before.sum(), 0.5 * momentum @ VELOCITY)),
            ("probe", self.columns(18)[before], VELOCITY * time),
        ):
            with self.subTest(name):
                self.assertLessEqual(abs(found - expected).max(), 1e-11 * abs(expected).max())
        self.assertLessEqual(abs(self.table["plate16"][before]).max(), 1e-12 * 0.5 * momentum @ VELOCITY)

    def test_nothing_is_lost_in_the_hit(self):
        """Ball and block together: momentum, angular momentum, and energy but for the error of the time step."""
        ball = bob.DENSITY * 4 / 3 * np.pi * bob.RADIUS**3
        x, v = vector(self.table, "x", "y", "z"), vector(self.table, "vx", "vy", "vz")
        momentum = ball * v + self.columns(9)
        angular = ball * np.cross(x, v) + self.columns(12)
        self.assertGreater(abs(v[-1]).max(), 0.2, "the ball is hit")
        self.assertGreater(self.table["plate16"].max(), 1e-3 * self.table["plate15"][0], "and the block is strained")
        for name, total, part in (("momentum", momentum, self.columns(9)), ("angular momentum", angular, self.columns(12))):
            with self.subTest(name):
                self.assertGreater(abs(part - part[0]).max(), 1e-3 * abs(part).max())
                self.assertLessEqual(abs(total - total[0]).max(), ROUND_OFF * abs(part).max())
        apart = ~self.touches  # no energy of the contact itself
        energy = self.table["KinEng"] + self.table["plate15"] + self.table["plate16"]
        self.assertTrue(apart[-1])
        self.assertLessEqual(abs(energy[apart] - energy[0]).max(), 1e-7 * energy[0])


class Supports(unittest.TestCase):
    def test_forces_are_the_change_of_momentum(self):
        """A block that two supports hold, under its weight and a ball: columns 26-28 and 29-31 are their reactions."""
        g = 1e5
        held = "boundary: [{name: below, fix: [z], faces: [zeta-]}, {name: side, fix: [x, y, z], faces: [xi-]}]\n"
        model = bob.block(SIZE, density=DENSITY, fixed=()) + held + f"loads: {{gravity: [0, 0, {-g}]}}\n"
        deck = bob.prelude(velocity=(0.5, 0, -1), timestep=STEP, friction=0.3) + bob.wall() + bob.output(range(1, 32)) + "run 600\n"
        table = decks.good(deck, files={"block.yaml": model}).table
        columns = {first: vector(table, *(f"plate{first + k}" for k in range(3))) for first in (1, 9, 26, 29)}
        weight = DENSITY * np.prod(SIZE) * np.array([0, 0, -g])
        force = weight + columns[1] + columns[26] + columns[29]
        change = 0.5 * STEP * (force[1:] + force[:-1])
        np.testing.assert_allclose(np.diff(columns[9], axis=0), change, rtol=0, atol=1e-11 * abs(columns[9]).max())
        self.assertGreater(abs(columns[1]).max(), 0.1 * abs(weight).max(), "the ball is felt")
        self.assertGreater(abs(columns[26][:, 2]).max(), 0.1 * abs(columns[1]).max(), "and held")
        np.testing.assert_array_equal(columns[26][:, :2], 0)

    def test_contacts_on_fixed_nodes(self):
        """A block that is held by its top carries there what a ball presses, whatever steps it takes; nothing moves."""
        held = "boundary: [{name: above, fix: [x, y, z], faces: [zeta+]}]\n"
        for words in ("", " substeps structure 3", " substeps structure 2"):
            deck = bob.prelude(velocity=(0.5, 0, -1), timestep=STEP, friction=0.3) + bob.wall(rest="structure block.yaml surface top" + words)
            table = decks.good(deck + bob.output(range(1, 29)) + "run 300\n", files={"block.yaml": bob.block(SIZE, fixed=()) + held}).table
            contacts, reactions = (vector(table, *(f"plate{first + k}" for k in range(3))) for first in (1, 26))
            with self.subTest(words):
                self.assertGreater(abs(contacts[-1]).max(), 0)
                np.testing.assert_allclose(reactions, -contacts, rtol=0, atol=1e-12 * abs(contacts).max())

    def test_a_support_that_moves(self):
        """The last column is its work: what the solid has and gives to the ball."""
        moved = "boundary: [{name: ram, move: {z: 4e-5, x: 1e-6}, faces: [zeta-], time: {ramp: [1e-6, 9e-6]}}]\n"
        model = bob.block(SIZE, density=DENSITY, fixed=()) + moved
        deck = bob.prelude(velocity=(0.1, 0, 0), timestep=STEP, friction=0.3) + bob.wall() + bob.output(range(1, 31))
        table = decks.good(deck + "run 1200\n", files={"block.yaml": model}).table
        kinetic, contacts, internal, supports = (table[f"plate{column}"] for column in (15, 22, 24, 29))
        balance = kinetic + internal - contacts - supports
        np.testing.assert_allclose(balance, balance[0], rtol=0, atol=1e-11 * kinetic.max())
        np.testing.assert_array_equal(table["plate30"], 0)
        self.assertGreater(np.abs(contacts).max(), 1e-3 * kinetic.max(), "it hits the ball")
        force = vector(table, "plate1", "plate2", "plate3") + vector(table, "plate26", "plate27", "plate28")
        change = 0.5 * STEP * (force[1:] + force[:-1])
        momentum = vector(table, "plate9", "plate10", "plate11")
        np.testing.assert_allclose(np.diff(momentum, axis=0), change, rtol=0, atol=1e-11 * abs(momentum).max())

    def test_loads_in_time(self):
        """What a pull that rises linearly gives to a free block, however the time is divided."""
        loads = "loads: {tractions: [{face: xi+, value: [0, 1e4, 3e4], time: {ramp: [1e-7, 5e-6]}}]}\n"
        model = bob.block(SIZE, density=DENSITY, fixed=()) + loads
        for words in ("", " substeps structure 3", " substeps particles 4"):
            deck = bob.prelude(balls=((0, 0, 4e-3),), timestep=STEP) + bob.wall(rest="structure block.yaml surface top" + words)
            table = decks.good(deck + bob.output(range(1, 13)) + "run 240\n", files={"block.yaml": model}).table
            end = STEP * 240
            impulse = SIZE[1] * SIZE[2] * np.array([0, 1e4, 3e4]) * (end - 1e-7) ** 2 / (2 * 4.9e-6)
            with self.subTest(words):
                found = vector(table, "plate9", "plate10", "plate11")[-1]
                np.testing.assert_allclose(found, impulse, rtol=2e-3, atol=1e-12 * impulse.max())  # the ramp begins within a step

    def test_truncation_is_what_internal_work_exceeds_the_strain_by(self):
        deck = bob.prelude(timestep=STEP) + bob.wall() + bob.output(range(1, 26)) + "run 600\n"
        table = decks.good(deck, files={"block.yaml": bob.block()}).table
        strain = table["plate16"] - table["plate16"][0]
        np.testing.assert_allclose(table["plate25"], table["plate24"] - strain, rtol=0, atol=1e-14 * strain.max())
        self.assertGreater(abs(table["plate25"]).max(), 0)


if __name__ == "__main__":
    unittest.main()

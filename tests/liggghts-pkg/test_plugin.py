# SPDX-License-Identifier: GPL-2.0-or-later
"""A structure of an outside code (tests/coupling/plugin/spring_net.c, compiled as C99) through `structure plugin`: against an
oscillator integrated here, by its balances, on several ranks, from a restart file; and libraries that misbehave."""

import os
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

import ball_on_block as bob
import decks

NET, OLD_NET = os.environ["SPRING_NET"], os.environ["OLD_SPRING_NET"]
E, NU = 1e7, 0.3
HISTORY = "model hertz tangential history"
BALL_MASS = bob.DENSITY * 4 / 3 * np.pi * bob.RADIUS**3
ABOVE = (0.0, 0.0, bob.RADIUS + 1e-7)
# one patch of one element: its four masses move as one under a ball in the middle
OSCILLATOR = """nodes 2 2
origin -0.002 -0.002 0
size 0.004 0.004
degree 1
mass 5e-6
ground 500
"""
# a hammock of 9 x 10 masses
HAMMOCK = """nodes 9 10
origin -0.004 -0.0045 0
size 0.008 0.009
degree 2
mass 1e-6
stiffness 300
rest 0.8
"""


def deck(structure: str, run: str, **words) -> str:
    """Words as those of bob.prelude; what stands after `structure`."""
    settings = dict(ball=(E, NU), wall=(E, NU), models=HISTORY, timestep=1e-6, balls=(ABOVE,)) | words
    return bob.prelude(**settings) + bob.wall(HISTORY, f"structure {structure}") + bob.output(range(1, 25)) + run


def plugin(library: str = NET, model: str = "net.txt", rest: str = "surface top") -> str:
    return f"plugin {library} {model} {rest}"


def net(text: str) -> dict[str, str]:
    return {"net.txt": text}


def vector(table, *names):
    return np.stack([table[name] for name in names], axis=-1)


def columns(table, first):
    return vector(table, *(f"plate{first + k}" for k in range(3)))


class Oscillator(unittest.TestCase):
    def test_a_ball_on_a_mass_on_a_spring(self):
        """Two masses, Hertz' force between them, in phase space by an independent integrator of order 8."""
        v0, m, k = 0.5, 4 * 5e-6, 4 * 500.0
        stiffness = 4 / 3 * E / (2 * (1 - NU**2)) * np.sqrt(bob.RADIUS)
        table = decks.good(deck(plugin(), "run 1200\n", velocity=(0, 0, -v0), timestep=5e-7), files=net(OSCILLATOR)).table

        def rate(_, y):
            force = stiffness * max(bob.RADIUS + y[2] - y[0], 0.0) ** 1.5
            return [y[1], force / BALL_MASS, y[3], (-force - k * y[2]) / m]
        time = 5e-7 * table["Step"]
        y = solve_ivp(rate, (0, time[-1]), [ABOVE[2], -v0, 0, 0], "DOP853", time, rtol=1e-12, atol=1e-15).y
        momentum = m * y[3]
        self.assertGreater(np.max(table["plate7"]), 0)
        self.assertGreater(np.abs(momentum).max(), 0.1 * BALL_MASS * v0)
        for name, found, expected in (
            ("place of the ball", table["z"], y[0]), ("its velocity", table["vz"], y[1]),
            ("momentum of the masses", table["plate11"], momentum), ("strain", table["plate16"], 0.5 * k * y[2] ** 2),
        ):  # fmt: skip
            with self.subTest(name):
                np.testing.assert_allclose(found, expected, rtol=0, atol=2e-4 * np.abs(expected).max())

    def test_a_load_at_rest_sees_masses_at_rest(self):
        """What comes to rest through the damper of its contact lies as deep as the law has it, also where the masses take several steps
        between two kicks: at the end of a step they fly back from the last one."""
        stiffness = 4 / 3 * E / (2 * (1 - NU**2)) * np.sqrt(bob.RADIUS)
        weight = 9.81 * BALL_MASS
        lies = bob.RADIUS - weight / (4 * 500.0) - (weight / stiffness) ** (2 / 3)
        for steps in (1, 4):
            with self.subTest(steps=steps):
                run = deck(plugin(rest=f"surface top substeps structure {steps}"),
                           "fix g all gravity 9.81 vector 0 0 -1\nrun 10000\n",
                           velocity=(0, 0, 0), timestep=4e-6, restitution=0.3, balls=((0, 0, lies),))  # fmt: skip
                table = decks.good(run, files=net(OSCILLATOR)).table
                self.assertGreater(np.abs(table["vz"]).max(), 1e-5, "the masses begin without load")
                np.testing.assert_allclose(table["vz"][-1], 0, atol=1e-12)
                self.assertLess(abs(table["z"][-1] - lies), 5e-5 * (bob.RADIUS - lies))


class Balances(unittest.TestCase):
    """A net that nothing holds, without stretch, and a ball."""

    @classmethod
    def setUpClass(cls):
        free, words = net(HAMMOCK.replace("0.8", "1")), dict(balls=((0.7e-3, 0.4e-3, ABOVE[2]),), velocity=(0.2, 0.1, -0.5))
        cls.rough = decks.good(deck(plugin(), "run 400\n", friction=0.4, **words), files=free).table
        cls.smooth, cls.finer, cls.stepped = (
            decks.good(deck(plugin(rest=f"surface top {more}"), f"run {steps}\n", timestep=dt, **words), files=free).table
            for dt, steps, more in ((1e-6, 800, ""), (5e-7, 1600, ""), (1e-6, 800, "substeps structure 3"))
        )

    def test_momentum(self):
        for table in (self.rough, self.smooth, self.stepped):
            total = BALL_MASS * vector(table, "vx", "vy", "vz") + columns(table, 9)
            self.assertGreater(np.abs(columns(table, 9)[-1]).max(), 0.1 * BALL_MASS * 0.5, "the net is hit")
            self.assertLessEqual(np.abs(total - total[0]).max(), 1e-12 * np.abs(columns(table, 9)).max())

    def test_impulse_of_each_step(self):
        force = columns(self.rough, 1)
        impulse = np.cumsum(0.5e-6 * (force[1:] + force[:-1]), axis=0)
        np.testing.assert_allclose(columns(self.rough, 9)[1:], impulse, rtol=0, atol=1e-12 * np.abs(impulse).max())

    def test_angular_momentum(self):
        for table in (self.smooth, self.stepped):
            total = BALL_MASS * np.cross(vector(table, "x", "y", "z"), vector(table, "vx", "vy", "vz")) + columns(table, 12)
            self.assertLessEqual(np.abs(total - total[0]).max(), 1e-12 * np.abs(columns(table, 12)).max())

    def test_energy(self):
        """What contacts do to the net is what the ball has lost when it is gone, and what the net then has."""
        drift = []
        for table in (self.smooth, self.finer):
            self.assertEqual(table["plate7"][-1], 0)
            lost, done = table["KinEng"][0] - table["KinEng"][-1], table["plate19"][-1]
            has = table["plate15"][-1] + table["plate16"][-1]
            self.assertGreater(lost, 0.1 * table["KinEng"][0])
            self.assertLess(abs(lost / done - 1), 1e-4)
            np.testing.assert_allclose(table["plate22"][-1], done - has, rtol=1e-9, atol=1e-12 * has)
            drift.append(np.abs(table["plate22"]).max())
        self.assertLess(drift[0], 1e-3 * self.smooth["plate19"][-1])
        self.assertAlmostEqual(np.log2(drift[0] / drift[1]), 2, delta=0.5)

    def test_substeps_change_little(self):
        for name, of in (("vz", self.smooth["vz"]), ("plate11", self.smooth["plate11"])):
            np.testing.assert_allclose(self.stepped[name], of, rtol=0, atol=2e-3 * np.abs(of).max())


class Ranks(unittest.TestCase):
    """A held, stretched net under three rubbing balls; whole on every rank, or cut into rows."""

    balls = (ABOVE, (2.2e-3, 1e-3, bob.RADIUS + 5e-6), (-1e-3, -2.4e-3, bob.RADIUS + 2e-6))

    def model(self, parts: int) -> dict[str, str]:
        return net(HAMMOCK + f"held 1\nparts {parts}\n")

    def deck(self, run: str, processors: str = "* * *", restart: str = "") -> str:
        words = dict(balls=self.balls, velocity=(0.2, 0.1, -0.5), friction=0.4, restitution=0.8, processors=processors)
        return deck(plugin(), run, restart=restart, **words)

    def check_equal(self, table, one):
        for name, reference in one.items():
            with self.subTest(name):
                if name in ("KinEng", *(f"plate{c}" for c in range(9, 25))):  # sums of what ranks have, or of their shares
                    scale = one["plate16"] if name == "plate22" else reference  # a difference of large numbers
                    np.testing.assert_allclose(table[name], reference, rtol=0, atol=1e-11 * np.abs(scale).max())
                else:
                    np.testing.assert_array_equal(table[name], reference)

    def test_same_motion_to_the_last_bit(self):
        one = decks.good(self.deck("run 300\n"), files=self.model(0)).table
        self.assertEqual(one["plate7"].max(), 3)
        for parts, ranks, processors in ((1, 1, "1 1 1"), (0, 2, "2 1 1"), (1, 2, "2 1 1"), (1, 4, "2 2 1")):
            with self.subTest(parts=parts, ranks=ranks):
                table = decks.good(self.deck("run 300\n", processors), files=self.model(parts), ranks=ranks).table
                self.check_equal(table, one)

    def test_restart_on_other_ranks(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "contact"
            whole = decks.good(self.deck(f"run 150\nwrite_restart {path}\nrun 100\n"), files=self.model(1), ranks=2).tables[1]
            restart = path.read_bytes()
        self.assertGreater(whole["plate7"][0], 0, "within contacts")
        for ranks in (1, 2):
            files = self.model(1) | {"contact": restart}
            table = decks.good(self.deck("run 100\n", restart="contact"), files=files, ranks=ranks).table
            self.check_equal(table, whole)
        other = decks.run(self.deck("run 1\n", restart="contact"), files=files | net(HAMMOCK.replace("9 10", "9 11")))
        self.assertRegex("".join(other.errors), "restart file.*geometry: .* then")


class Misbehaviour(unittest.TestCase):
    def check(self, structure: str, *expected: str, model: str = HAMMOCK, ranks: int = 1, **words):
        quiet = deck(structure, "run 100\n", **words).replace("thermo 1\n", "thermo 1000\n")  # no line is cut off
        run = decks.run(quiet, files=net(model), ranks=ranks, timeout=30)
        self.assertNotEqual(run.code, 0, run.text[-2000:])
        self.assertGreaterEqual(len(run.errors), 1, run.text[-2000:])
        for pattern in ("Fix wall/nurbs .id plate.", *expected):
            self.assertRegex(run.errors[0], pattern)

    def test_libraries(self):
        for library, expected in (
            ("libnone.so", "cannot load 'libnone.so': .*No such file"),
            ("net.txt", "cannot load 'net.txt': "),
            ("libm.so.6", "libm.so.6: exports no function 'structure_plugin'"),
            (OLD_NET, "is of version 0 of structure_plugin.h .* expected version 1"),
        ):
            for ranks in (1, 2):
                with self.subTest(library, ranks=ranks):
                    self.check(plugin(library), expected, ranks=ranks)

    def test_a_model_that_it_does_not_read(self):
        self.check(plugin(model="none.txt"), "spring_net.so .spring net.: open failed with code 2: cannot read 'none.txt'")
        self.check(plugin(), "code 3: net.txt: 'stifness' is no word", model=HAMMOCK.replace("stiff", "stif"), ranks=2)
        steep = HAMMOCK.replace("9 10", "20 21").replace("degree 2", "degree 17")
        self.check(plugin(), r"describe: patches\[0\]: .*degree", model=steep)

    def test_a_step_that_fails_on_one_rank(self):
        for parts in (0, 1):
            model = HAMMOCK + f"parts {parts}\nfault 1 20 1\n"
            text = "'net.txt': step 20: .*end_step failed with code 7: a spring has snapped, in step 20 on rank 1"
            self.check(plugin(), text, model=model, ranks=2)

    def test_numbers_that_are_none(self):
        text = "step 20: .*motion gives a place or velocity of node .* that is not finite, after begin_step"
        self.check(plugin(), text, model=HAMMOCK + "fault 2 20 0\n")
        self.check(plugin(), text, model=HAMMOCK + "parts 1\nfault 2 20 1\n", ranks=2)

    def test_time_steps(self):
        stable = 2 / np.sqrt(8 * 300 / 1e-6)
        self.check(plugin(), f"timestep 5e-05 is above the structure's stable step {stable:.6g}.*substeps", timestep=5e-5)
        self.check(plugin(rest="surface top substeps structure 1"), "which asks for 2 steps", timestep=5e-5)
        self.check(plugin(rest="surface top substeps particles 2"), "not for a plug-in")
        run = decks.good(deck(plugin(rest="surface top substeps auto"), "run 3\n", timestep=5e-5), files=net(HAMMOCK))
        self.assertIn("substeps structure 2: the structure takes 2 steps of 2.5e-05", run.text)

    def test_a_time_step_that_changes_in_a_run(self):
        """The body has forces for two half steps of what was its own step."""
        wall = plugin(rest="surface top substeps auto") + "\nfix reset all dt/reset 5 9e-6 1e-5 1"
        self.check(wall, "takes 1 steps in place of 2, .* between two runs alone, or 'substeps structure 2'", timestep=5e-5)

    def test_words(self):
        self.check("plugin", "expected a shared library")
        self.check(f"plugin {NET} surface", "keyword 'surface' is missing|top")


if __name__ == "__main__":
    unittest.main()

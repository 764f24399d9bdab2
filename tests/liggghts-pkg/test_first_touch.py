# SPDX-License-Identifier: GPL-2.0-or-later
"""The step in which a particle first touches a wall that moves, known exactly: by less than a skin per step and by more, at
constant and at changing speed, rigid and deforming, at faces and at edges.

Where particles are held LIGGGHTS has no reason of its own to rebuild its lists: the wall's motion alone must do it."""

import math
import re
import unittest

import numpy as np

import decks
from prelude import INTEGRATION, Prelude, create

R, SKIN, DT, HALF = 1e-3, 2e-4, 5e-6, 8e-3

DECK = """\
{start}{balls}
set group all diameter 0.002 density 2500
{before}
fix wall all wall/nurbs model hertz tangential no_history type 2 {wall}
{after}
variable n equal f_wall[7]
thermo_style custom step v_n {columns}
thermo_modify format float %.17g lost error
thermo 1
run {steps}
"""


def deck(balls: str, wall: str, steps: int, *, before="", after="", young=1e4, columns="") -> str:
    start = Prelude(
        "-0.06 0.06 -0.06 0.06 -0.06 0.06", E=(young, 9e8), nu=(0.3, 0.3), models="model hertz tangential no_history",
        timestep=DT, skin=SKIN, lists="delay 0 exclude group all all", particles="soft",
    )
    return DECK.format(
        start=start.text(), balls=balls, wall=wall, steps=steps, before=before, after=after, columns=columns
    )


PLANE = f"""
units: si
geometry:
  plane: {{origin: [{-HALF}, {-HALF}, 0], edges: [[{2 * HALF}, 0, 0], [0, {2 * HALF}, 0]], elements: [5, 4], degree: 2}}
surfaces: {{wall: all}}
"""
# heavy, so that soft balls do not slow it down; it is thrown upwards and falls upwards
BLOCK = """
units: si
geometry:
  box: {origin: [-0.008, -0.008, -0.004], size: [0.016, 0.016, 0.004], elements: [4, 3, 1], degree: 2}
material: {law: linear_elastic, youngs_modulus: 9e8, poissons_ratio: 0.3, density: 1e6}
surfaces: {top: zeta+}
loads: {gravity: [0, 0, ACCELERATION]}
initial: {velocity: [0, 0, VELOCITY]}
"""


def places(count: int, highest: float, seed: int) -> np.ndarray:
    """Above the wall and beside its edges, not touching; from gaps of a thousandth of a skin upwards, most of them small."""
    random = np.random.default_rng(seed)
    xy = random.uniform(-HALF - 0.9 * R, HALF + 0.9 * R, (count, 2))
    z = R + np.exp(random.uniform(math.log(1e-3 * SKIN), math.log(highest), count))
    return np.column_stack([xy, z])


def distance(balls: np.ndarray, at: np.ndarray, rotation=np.eye(3)) -> np.ndarray:
    """From the square, whose middle is `at`."""
    body = (balls - at) @ rotation
    return np.sqrt(np.maximum(np.abs(body[:, :2]) - HALF, 0.0) ** 2 @ [1.0, 1.0] + body[:, 2] ** 2)


def about(axis, angle: float) -> np.ndarray:
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K


def wiggled(amplitude: float, angle: float, n: int) -> float:
    """Sum of the steps dt A omega cos(omega k dt), k = 1 to n, as in LIGGGHTS; `angle` = omega dt."""
    return amplitude * angle * math.sin(n * angle / 2) * math.cos((n + 1) * angle / 2) / math.sin(angle / 2)


def contacts(balls, wall, steps, files, young=1e4) -> np.ndarray:
    """Their number in each step."""
    text = deck(create(*balls.tolist()), wall, steps, young=young)
    return decks.good(text, files=files).table["n"]


class HeldParticles(unittest.TestCase):
    def check(self, found: np.ndarray, balls: np.ndarray, pose, name):
        """`pose(n)`: middle and rotation of the wall in step n.  Ties within 1e-9 mm may go either way."""
        away = np.array([distance(balls, *pose(n)) for n in range(len(found))])
        expected = [(away <= R + tie).sum(axis=1) for tie in (-1e-12, 1e-12)]
        self.assertGreaterEqual(expected[0].max(), 5, name)
        self.assertGreaterEqual(len(set(expected[0])), 4, "contacts begin at different times")
        wrong = np.flatnonzero((found < expected[0]) | (found > expected[1]))
        first = wrong[:5]
        self.assertEqual(wrong.size, 0, f"{name}: steps {first} have {found[first]} contacts, not {expected[0][first]}")

    def rigid(self, words: str, pose, steps: int, highest: float, seed=1):
        balls = places(60, highest, seed)
        found = contacts(balls, f"geometry wall.yaml surface wall {words}", steps, {"wall.yaml": PLANE})
        self.check(found, balls, pose, words)

    def test_constant_speed(self):
        for skins in (0.013, 0.17, 0.49, 0.51, 0.83, 1.9, 4.7):  # per step; below and above those that rebuild the list
            V = skins * SKIN / DT
            steps = int(min(max(12, 8 / skins), 400))
            way = skins * SKIN * steps
            with self.subTest(skins=skins):
                words, seed = f"motion linear 0 0 {V!r}", int(100 * skins)
                self.rigid(words, lambda n: (np.array([0, 0, V * n * DT]),), steps, 0.9 * way, seed)

    def test_oblique_and_accelerated(self):
        shift = np.array((0.7, -0.4, 1.0)) * 0.3 * SKIN / DT
        self.rigid("motion linear {!r} {!r} {!r}".format(*shift.tolist()), lambda n: (shift * n * DT,), 60, 15 * SKIN)
        amplitude, period = 12 * SKIN, 400 * DT
        self.rigid(
            f"motion wiggle amplitude 0 0 {amplitude!r} period {period!r}",
            lambda n: (np.array([0, 0, wiggled(amplitude, 2 * math.pi * DT / period, n)]),), 300, 11 * SKIN,
        )

    def test_rotation_about_a_distant_axis(self):
        """The far edge moves by a skin per step and the near one by a sixth."""
        origin, axis, period = np.array((-0.0096, 0.0, 0.0)), (0.0, -1.0, 0.0), 2 * math.pi * 0.0176 / (SKIN / DT)
        for words, turn in (("axis 0 -1 0", axis), ("axis 0.2 -1 0.1", (0.2, -1.0, 0.1))):
            def pose(n):
                rotation = about(turn, 2 * math.pi * n * DT / period)
                return origin - rotation @ origin, rotation
            self.rigid(f"motion rotate origin -0.0096 0 0 {words} period {period!r}", pose, 40, 18 * SKIN, seed=5)

    def test_a_solid_that_moves(self):
        """A free block at constant acceleration, which velocity Verlet integrates exactly: z = v t + g t^2/2.  The one that
        sinks first, by less than half a skin, is back before LIGGGHTS' lists are rebuilt."""
        for v, g, steps in ((0.4, 0.0, 400), (-1.0, 6250.0, 100), (0.0, 2e4, 200), (12.0, 0.0, 60), (30.0, 1e5, 40), (55.0, -4e5, 20)):
            balls = places(60, 0.9 * max(v * t + g * t * t / 2 for t in DT * np.arange(steps + 1)), seed=int(v) + 3)
            block = BLOCK.replace("VELOCITY", repr(v)).replace("ACCELERATION", repr(g))
            found = contacts(balls, "structure block.yaml surface top", steps, {"block.yaml": block}, young=10.0)
            with self.subTest(v=v, g=g):
                self.check(found, balls, lambda n: (np.array([0, 0, v * n * DT + g * (n * DT) ** 2 / 2]),), f"{v} {g}")


class FreeParticles(unittest.TestCase):
    def test_wall_and_particles_both_move(self):
        """The first step with a force on each of some balls; each of both ways is less than makes a list old, or more."""
        random = np.random.default_rng(11)
        for wall_skins, ball_skins in ((0.45, 0.2), (0.3, 0.48), (0.1, 2.7), (1.7, 0.4), (2.3, 3.1)):
            count = 24
            xy, z = random.uniform(-0.9 * HALF, 0.9 * HALF, (count, 2)), R + random.uniform(0, 30 * SKIN, count)
            balls = np.column_stack([xy, z])
            V = wall_skins * SKIN / DT
            # towards the wall or away, but slower than it; the fastest set LIGGGHTS' pace
            v = -random.uniform(-0.9 * min(wall_skins, ball_skins), ball_skins, count) * SKIN / DT
            v[0] = -ball_skins * SKIN / DT
            steps = int(40 / wall_skins)
            columns = " ".join(f"v_f{k}" for k in range(1, count + 1))
            after = INTEGRATION + "".join(f"variable f{k} equal fz[{k}]\n" for k in range(1, count + 1))
            before = "".join(f"set atom {k} vz {v[k - 1]!r}\n" for k in range(1, count + 1))
            text = deck(
                create(*balls.tolist()), f"geometry wall.yaml surface wall motion linear 0 0 {V!r}", steps, before=before,
                after=after, columns=columns,
            ).replace("lost error", "lost ignore")
            table = decks.good(text, files={"wall.yaml": PLANE}).table
            touched = 0
            for k in range(count):
                gap = balls[k, 2] - R + (v[k] - V) * DT * np.arange(steps + 1)
                if not (gap < 0.0).any():
                    continue
                expected = int(np.argmax(gap < 0.0))
                if gap[expected] < -1.9 * R:
                    continue  # across in one step, which the alarm tells
                touched += 1
                force = table[f"f{k + 1}"]
                with self.subTest(wall=wall_skins, balls=ball_skins, ball=k):
                    self.assertEqual(int(np.argmax(force != 0.0)), expected)
            self.assertGreater(touched, 5)


TRIANGLE = "solid\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 0\nvertex 2 -1 0\nvertex -1 2 0\nendloop\nendfacet\nendsolid\n"


class Alarm(unittest.TestCase):
    """Whoever is fast: a centre that the wall would cross within a step is reported."""

    ALARM = r"the centre of particle 1 would cross the wall within one step, at a speed of ([\d.e+]+) "

    def warned(self, gap: float, ball: float, wall: float, geometry: str = "wall.yaml surface wall") -> str:
        text = deck(
            create((0.0003, 0.0004, R + gap)), f"geometry {geometry} motion linear 0 0 {wall!r}", steps=3,
            before=f"set atom 1 vz {ball!r}", after=INTEGRATION,
        ).replace("lost error", "lost ignore")
        found = re.search(self.ALARM, decks.good(text, files={"wall.yaml": PLANE, "wall.stl": TRIANGLE}).text)
        return found.group(1) if found else ""

    def test_a_fast_particle(self):
        self.assertEqual(self.warned(gap=20 * SKIN, ball=-60 * SKIN / DT, wall=1e-9), "2400")
        self.assertEqual(self.warned(gap=20 * SKIN, ball=-1 * SKIN / DT, wall=1e-9), "")
        self.assertEqual(self.warned(20 * SKIN, -60 * SKIN / DT, 1e-9, "wall.stl surface all"), "2400")

    def test_a_fast_wall(self):
        self.assertEqual(self.warned(gap=20 * SKIN, ball=0.0, wall=60 * SKIN / DT), "2400")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Force, torque and power of a wall with friction, against what the particles get, and friction under `rstar curvature`.

Velocity Verlet keeps three sums to round-off, whatever the contact law: in a step the momentum of the particles changes by
dt/2 (F_n + F_n+1), their angular momentum, spin included, by dt/2 (M_n + M_n+1) about any fixed point, and the wall's power
P = V.F + Omega.M (M about the axis) adds up to V.p + Omega.L.
"""

import math
import unittest

import numpy as np

import decks
import reference_ball as reference
from rubbing_balls import DENSITY, DT, FRICTION, INERTIA, MASS, R, deck, vectors
from branch_decks import FLOOR, L, SIDE, model_file, quad

ROUND_OFF = 1e-11

def nurbs(name: str, file: str, words: str = "", models: str = FRICTION) -> str:
    return f"fix {name} all wall/nurbs {models} type 2 geometry {file}.yaml surface wall {words}\n"


def totals(name: str) -> list[str]:
    return [f"f_{name}[{k}]" for k in (1, 2, 3, 4, 5, 6, 18)]


def columns(table, name: str, first: int) -> np.ndarray:
    """Three columns of a wall; LIGGGHTS cuts f_ off the head."""
    return np.array([table[f"{name}[{k}]"] for k in range(first, first + 3)]).T


def gained(table, rate: np.ndarray) -> np.ndarray:
    """Sum of dt/2 (rate_n + rate_n+1) up to each step."""
    return np.concatenate([[0 * rate[0]], np.cumsum(0.5 * DT * (rate[1:] + rate[:-1]), axis=0)])


def momenta(table, balls: int, about) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Momentum, angular momentum about a point, and the spins' part of it."""
    p = spin = orbit = 0.0
    for k in range(1, balls + 1):
        v = MASS * vectors(table, "v", k)
        p, orbit = p + v, orbit + np.cross(vectors(table, "", k) - about, v)
        spin = spin + INERTIA * vectors(table, "w", k)
    return p, orbit + spin, spin


TILTED = quad((-0.012, -0.01, -0.002), (0.02, 0.004, 0.006), (-0.003, 0.02, 0.002), (4, 3))
TILT = np.cross((0.02, 0.004, 0.006), (-0.003, 0.02, 0.002)) / np.linalg.norm(
    np.cross((0.02, 0.004, 0.006), (-0.003, 0.02, 0.002))
)
FOOT = np.array((-0.012, -0.01, -0.002)) + 0.45 * np.array((0.02, 0.004, 0.006)) + 0.4 * np.array((-0.003, 0.02, 0.002))
BALL = "units: si\ngeometry:\n  sphere: {centre: [0, 0, 0], radius: 0.01, elements: [8, 4]}\nsurfaces: {wall: all}\n"
# off the origin, oblique, with a spin of every direction; it leaves again after some 100 steps
OBLIQUE = tuple(tuple(a.tolist()) for a in (FOOT + (R + 1.1e-6) * TILT, np.array((0.5, 0.3, 0.1)) - TILT, np.array((300.0, -400.0, 200.0))))
TURN = "motion rotate origin 0.004 -0.002 0.003 axis 1 2 -0.5 period 0.02"
OMEGA = 2 * math.pi / 0.02 * np.array((1, 2, -0.5)) / np.linalg.norm((1, 2, -0.5))
CENTRE = np.array((0.004, -0.002, 0.003))


class Balance(unittest.TestCase):
    """Columns 1-6 and the power, of contacts with friction, rolling friction and cohesion."""

    def check(self, table, names, balls=1, spins=0.01):
        p, L_, spin = momenta(table, balls, np.zeros(3))
        F = sum(columns(table, name, 1) for name in names)
        M = sum(columns(table, name, 4) for name in names)
        change = np.abs(L_ - L_[0]).max()
        self.assertGreater(np.abs(F).max(), 0.0)
        self.assertGreater(np.abs(spin - spin[0]).max(), spins * change, "friction matters")
        self.assertLessEqual(np.abs(p - p[0] + gained(table, F)).max(), ROUND_OFF * np.abs(p - p[0]).max())
        self.assertLessEqual(np.abs(L_ - L_[0] + gained(table, M)).max(), ROUND_OFF * change)

    def run_deck(self, walls, balls, files, names=("wall",), steps=400, **options):
        shown = [column for name in names for column in totals(name)]
        return decks.good(deck(walls, balls, columns=shown, **options) + f"run {steps}\n", files=files).table

    def test_every_friction(self):
        for models in (
            FRICTION,
            "model hertz tangential no_history",
            "model hertz tangential history rolling_friction cdt",
            "model hertz tangential history rolling_friction epsd2",
            "model penalty/quadratic tangential history rolling_friction epsd2",
        ):
            with self.subTest(models):
                factor = 500.0 if "quadratic" in models else 1.0
                wall = nurbs("wall", "wall", models=models)
                self.check(self.run_deck(wall, [OBLIQUE], model_file(TILTED), models=models, factor=factor), ["wall"])

    def test_curved_walls_and_effective_radius(self):
        normal = np.array((0.48, 0.6, 0.64))
        for side in (1, -1):
            for words in ("", "rstar curvature"):
                with self.subTest(side=side, words=words):
                    place = (0.01 + side * (R + 1.1e-6)) * normal
                    velocity = -side * normal + np.cross((0.3, 0.2, -0.4), normal)
                    ball = (tuple(place.tolist()), tuple(velocity.tolist()), OBLIQUE[2])
                    self.check(self.run_deck(nurbs("wall", "wall", words), [ball], {"wall.yaml": BALL}), ["wall"])

    def test_two_contacts_of_one_wall_and_two_walls(self):
        """In a corner, where a particle's force and torque are those of both contacts."""
        ball = ((R + 2e-7, 1e-3, R + 4e-7), (-0.6, 0.4, -0.8), (300.0, 200.0, -500.0))
        self.check(self.run_deck(nurbs("wall", "wall"), [ball], model_file(FLOOR, SIDE)), ["wall"])
        files = {"floor.yaml": model_file(FLOOR)["wall.yaml"], "side.yaml": model_file(SIDE)["wall.yaml"]}
        both = nurbs("floor", "floor") + nurbs("side", "side")
        self.check(self.run_deck(both, [ball], files, ["floor", "side"]), ["floor", "side"])

    def test_balls_that_rub_on_each_other_and_on_the_wall(self):
        balls = [
            ((0.0, 0.0, R - 1e-6), (0.4, 0.1, -0.3), (100.0, 0.0, 300.0)),
            ((2 * R - 1e-6, 1e-5, R - 2e-6), (-0.4, 0.3, -0.2), (0.0, 200.0, 0.0)),
        ]
        files = model_file(quad((-L / 2, -L / 2, 0), (L, 0, 0), (0, L, 0)))
        self.check(self.run_deck(nurbs("wall", "wall"), balls, files), ["wall"], balls=2)

    def test_moving_walls(self):
        for words, V, Omega in (
            (TURN, np.zeros(3), OMEGA),
            ("motion linear 0.3 -0.2 0.1", np.array((0.3, -0.2, 0.1)), np.zeros(3)),
            ("surface_vel 0.3 -0.2 0.1", None, None),
        ):
            with self.subTest(words):
                table = self.run_deck(nurbs("wall", "wall", words), [OBLIQUE], model_file(TILTED))
                self.check(table, ["wall"])
                if V is None:  # a belt: LIGGGHTS turns the velocity into the tangent plane and keeps its size
                    along = np.array((0.3, -0.2, 0.1))
                    along = along - (along @ TILT) * TILT
                    V, Omega = along * np.linalg.norm((0.3, -0.2, 0.1)) / np.linalg.norm(along), np.zeros(3)
                p, about_centre, _ = momenta(table, 1, CENTRE)
                work = gained(table, table["wall[18]"])
                expected = (p - p[0]) @ V + (about_centre - about_centre[0]) @ Omega
                self.assertGreater(abs(expected[-1]), 0.01 * MASS * 0.1)
                self.assertLessEqual(abs(work - expected).max(), ROUND_OFF * abs(expected).max())

    def test_power_of_a_wall_that_turns_about_a_moving_axis(self):
        table = self.run_deck(nurbs("wall", "wall", "motion linear -0.4 0.1 0.2 " + TURN), [OBLIQUE], model_file(TILTED))
        V = np.array((-0.4, 0.1, 0.2))
        F, M = columns(table, "wall", 1), columns(table, "wall", 4)
        centre = CENTRE + np.outer(DT * table["Step"], V)
        expected = -(F @ V + (M - np.cross(centre, F)) @ OMEGA)
        self.assertGreater(abs(expected).max(), 0.01)
        self.assertLessEqual(abs(table["wall[18]"] - expected).max(), ROUND_OFF * abs(expected).max())


class EffectiveRadius(unittest.TestCase):
    """`rstar curvature` changes the stiffness; spin and torque keep the arm r - overlap/2."""

    normal = np.array((0.48, 0.6, 0.64))

    def ball(self, side: int, gap: float, speed=1.0, spin=OBLIQUE[2]):
        place = (0.01 + side * (R + gap)) * self.normal
        velocity = -side * speed * self.normal + np.cross((0.3, 0.2, -0.4), self.normal)
        return tuple(place.tolist()), tuple(velocity.tolist()), spin

    def ours(self, ball, steps=400, models=FRICTION, **options):
        text = deck(nurbs("wall", "wall", "rstar curvature", models), [ball], models=models, **options)
        return decks.good(text + f"run {steps}\n", files={"wall.yaml": BALL}).table

    def same(self, ours, expected, kinds="xvwft", tolerance=1e-9, balls=("1", "")):
        for kind in kinds:
            names = [kind + c if kind != "x" else c for c in "xyz"]
            scale = max(abs(expected[name + balls[1]]).max() for name in names)
            for name in names:
                with self.subTest(column=name):
                    self.assertLessEqual(abs(ours[name + balls[0]] - expected[name + balls[1]]).max(), tolerance * scale)

    def test_convex_wall_is_a_large_particle_held_fast(self):
        """LIGGGHTS' own contact of two particles has r* = r R/(r + R), and the same arm."""
        gap = 1.1e-6
        ball = self.ball(1, gap)
        held = "group held id 2\nset group held diameter 0.02\nfix hold held freeze\n"
        for models in (FRICTION, "model hertz tangential no_history"):
            ours = self.ours(ball, models=models)
            balls = [ball, ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))]
            text = deck("", balls, models=models, more=held)
            stock = decks.good(text + "run 400\n", program=decks.STOCK).table
            self.assertEqual(stock["fx1"][-1], 0.0, "it has left")
            self.same(ours, stock, balls=("1", "1"))

    def test_hollow_and_convex_wall_beside_the_formulas(self):
        for side in (1, -1):
            for contact in (reference.Contact(), reference.Contact(history=False, mu=0.9), reference.Contact(e=1.0, mu=2.0)):
                with self.subTest(side=side, contact=contact):
                    ball = self.ball(side, 1.1e-6)
                    models = FRICTION if contact.history else "model hertz tangential no_history"
                    ours = self.ours(ball, models=models, e=contact.e, mu=contact.mu)
                    expected = reference.trajectory(reference.sphere(0.01, side), contact, R, DENSITY, *ball, DT, 400)
                    self.assertEqual(expected["fx"][-1], 0.0, "it has left")
                    self.same(ours, expected)

    def test_torque_of_sliding_is_friction_times_arm(self):
        for side in (1, -1):
            overlap = 2e-5  # 2 % of the radius, to tell the arm from r and r*
            ball = self.ball(side, -overlap, speed=0.0, spin=(0.0, 0.0, 0.0))
            ours = self.ours(ball, steps=1, models="model hertz tangential no_history", mu=0.01)
            force, torque = (vectors(ours, kind)[0] for kind in "ft")
            normal = force @ self.normal
            friction = np.linalg.norm(force - normal * self.normal)
            with self.subTest(side=side):
                self.assertAlmostEqual(friction / (0.01 * abs(normal)), 1.0, delta=1e-12)
                self.assertAlmostEqual(np.linalg.norm(torque) / (friction * (R - overlap / 2)), 1.0, delta=1e-12)

    def test_rolling_is_without_friction(self):
        """v = (r - overlap/2) omega: the contact point stands."""
        for side in (1, -1):
            overlap = 2e-5
            velocity = np.cross((0.3, 0.2, -0.4), self.normal)
            spin = side * np.cross(self.normal, velocity) / (R - overlap / 2)
            ours = self.ours(self.ball(side, -overlap, 0.0, tuple(spin.tolist())), 1, "model hertz tangential no_history")
            force, torque = (vectors(ours, kind)[0] for kind in "ft")
            with self.subTest(side=side):
                self.assertGreater(abs(force @ self.normal), 1e-3)
                self.assertLessEqual(np.abs(force - (force @ self.normal) * self.normal).max(), 1e-12 * np.linalg.norm(force))
                self.assertLessEqual(np.abs(torque).max(), 1e-12 * R * np.linalg.norm(force))


if __name__ == "__main__":
    unittest.main()

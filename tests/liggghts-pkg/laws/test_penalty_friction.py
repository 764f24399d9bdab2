# SPDX-License-Identifier: GPL-2.0-or-later
"""Friction of the paper's laws, from the first step of a contact on, against the formulas of contact_laws.h: the tangential
stiffness is Mindlin's and its damping that of hertz for every law and every lambda."""

import math
import unittest

import numpy as np

import contact_deck
from contact_deck import EXPONENT, LAWS, decks
import reference_ball as reference
from rubbing_balls import DENSITY, DT, INERTIA, MASS, R, deck, vectors

FACTOR = {"penalty/linear": 1.7e-3, "penalty/hertz": 0.6, "penalty/quadratic": 900.0}
# touches in the third step; the contact point moves in both tangential directions
BALL = ((2e-4, -1e-4, R + 2.7e-6), (0.05, 0.03, -1.0), (-20.0, 15.0, 40.0))
FAST = ((2e-4, -1e-4, R + 2.7e-6), (0.9, 0.5, -1.0), (300.0, -200.0, 100.0))
PLANE = "fix wall all wall/gran {models} primitive type 2 zplane 0.0 {settings}\n"


def cases():
    for law in LAWS:
        for ball, mu in ((BALL, 2.0), (BALL, 0.2), (FAST, 0.3)):
            for history, damped in ((True, True), (True, False), (False, True)):
                yield law, ball, mu, history, damped


def models(law: str, history: bool) -> str:
    return f"model {law} tangential {'history' if history else 'no_history'}"


class Wall(unittest.TestCase):
    def test_contact_beside_the_formulas(self):
        decks_of_cases = []
        for law, ball, mu, history, damped in cases():
            words = models(law, history)
            wall = PLANE.format(models=words, settings="" if damped else "tangential_damping off")
            text = deck(wall, [ball], models=words, mu=mu, factor=FACTOR[law])
            decks_of_cases.append(text + "run 300\n")
        for (law, ball, mu, history, damped), ours in zip(cases(), contact_deck.run_each(decks_of_cases)):
            contact = reference.Contact(
                mu=mu, exponent=EXPONENT[law], factor=FACTOR[law], history=history, damped=damped
            )
            expected = reference.trajectory(reference.plane(), contact, R, DENSITY, *ball, DT, 300)
            with self.subTest(contact=contact, ball=ball):
                first = int(np.argmax(expected["fz"] != 0.0))
                self.assertEqual(first, 3)
                self.assertEqual(expected["fz"][-1], 0.0, "it has left")
                for kind in ("", "v", "w", "f", "t"):
                    ours_, theirs = vectors(ours, kind), np.array([expected[kind + c] for c in "xyz"]).T
                    self.assertLessEqual(abs(ours_ - theirs).max(), 1e-9 * abs(theirs).max(), kind)
                    if kind in ("f", "t"):  # the first steps, in their own measure
                        for n in range(first, first + 4):
                            self.assertLessEqual(abs(ours_[n] - theirs[n]).max(), 1e-9 * abs(theirs[n]).max(), (kind, n))

    def test_a_run_that_starts_in_contact_has_no_spring_yet(self):
        """Only the damper acts, and LIGGGHTS does not limit it."""
        ball = ((0.0, 0.0, R - 1e-5), (0.05, 0.03, 0.0), (0.0, 0.0, 0.0))
        texts = []
        for law in LAWS:
            words = models(law, True)
            texts.append(deck(PLANE.format(models=words, settings=""), [ball], models=words, factor=FACTOR[law]) + "run 0\n")
        G = 1e8 / (4 * (2 - 0.3) * (1 + 0.3))
        zeta = -math.log(0.7) / math.hypot(math.log(0.7), math.pi)
        gamma = 2 * zeta * math.sqrt(5 / 6 * 8 * G * math.sqrt(R * 1e-5) * MASS)
        for law, table in zip(LAWS, contact_deck.run_each(texts)):
            with self.subTest(law=law):
                self.assertAlmostEqual(table["fx1"][0] / (-gamma * 0.05), 1.0, delta=1e-9)
                self.assertAlmostEqual(table["fy1"][0] / (-gamma * 0.03), 1.0, delta=1e-9)


class Pair(unittest.TestCase):
    def test_first_steps_of_two_balls(self):
        """Two equal balls: r* = r/2, m* = m/2."""
        balls = [
            ((0.0, 0.0, 0.0), (0.02, 0.01, 0.4), (10.0, 20.0, -30.0)),
            ((0.0, 0.0, 2 * R + 2.7e-6), (-0.02, 0.02, -0.6), (15.0, -5.0, 20.0)),
        ]
        pairs = [(law, damped) for law in LAWS for damped in (True, False)]
        texts = []
        for law, damped in pairs:
            words = models(law, True) + ("" if damped else " tangential_damping off")
            texts.append(deck("", balls, models=words, mu=1.5, factor=FACTOR[law]) + "run 8\n")
        for (law, damped), table in zip(pairs, contact_deck.run_each(texts)):
            contact = reference.Contact(mu=1.5, exponent=EXPONENT[law], factor=FACTOR[law], damped=damped)
            shear, touched = np.zeros(3), 0
            for n in range(1, 9):
                x = [vectors(table, "", ball)[n] for ball in (2, 1)]
                half = [vectors(table, "v", ball)[n - 1] + DT / 2 / MASS * vectors(table, "f", ball)[n - 1] for ball in (2, 1)]
                spin = [vectors(table, "w", ball)[n - 1] + DT / 2 / INERTIA * vectors(table, "t", ball)[n - 1] for ball in (2, 1)]
                delta = x[0] - x[1]
                distance = np.linalg.norm(delta)
                normal, d = delta / distance, 2 * R - distance
                if d <= 0:
                    continue
                touched += 1
                arm = R - d / 2
                v = half[0] - half[1]
                v_n = v @ normal
                v_t = v - v_n * normal - arm * np.cross(spin[0] + spin[1], normal)
                shear = shear + DT * v_t
                shear = shear - (shear @ normal) * normal
                F_n, F_t, shear = contact.forces(d, R / 2, MASS / 2, v_n, v_t, shear)
                force = F_n * normal + F_t
                torque = -arm * np.cross(normal, F_t)
                with self.subTest(law=law, damped=damped, step=n):
                    for ball, sign in ((2, 1.0), (1, -1.0)):
                        self.assertLessEqual(abs(vectors(table, "f", ball)[n] - sign * force).max(), 1e-9 * abs(force).max())
                        self.assertLessEqual(abs(vectors(table, "t", ball)[n] - torque).max(), 1e-9 * abs(torque).max())
            self.assertEqual(touched, 6)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""The last column but one: what a tangential spring gains or loses as the overlap changes under it (Elata & Berryman 1996).

A ball that nothing moves, but has a velocity v along a floor, stretches its spring to xi = v t, while the floor rises or sinks,
d = d_0 + w t.  With k_t = 8 G* sqrt(R d) the column is the integral of xi^2/2 dk_t.
"""

import math
import unittest

import numpy as np
from scipy.integrate import quad as integral

import decks
from branch_decks import model_file, quad
from prelude import Prelude, create

R, YOUNG, NU = 1e-3, 1e8, 0.3
D_0, V, DT, STEPS = 1e-5, 0.01, 1e-6, 2000
K = 8 * YOUNG / (4 * (2 - NU) * (1 + NU)) * math.sqrt(R)  # k_t over sqrt(d)
FLOOR = model_file(quad((-0.01, -0.01, 0.0), (0.02, 0.0, 0.0), (0.0, 0.02, 0.0)))
HISTORY = "model hertz tangential history"


def deck(w: float, models: str = HISTORY, mu: float = 1e9, v: float = V, balls: int = 1) -> str:
    start = Prelude(
        "-0.02 0.02 -0.02 0.02 -0.02 0.02", E=(YOUNG, YOUNG), nu=(NU, NU), e=0.7, mu=mu, timestep=DT, lists="delay 0",
        models=HISTORY,
        further={"coefficientRollingFriction": 0.2, "yieldPressure": "peratomtype 1e30 1e30", "cohesionEnergyDensity": 1e3,
                 "penaltyFactor": 1.0},
    )  # fmt: skip
    places = [(-0.006 + 0.012 * k, 0.0, R - D_0) for k in range(balls)]
    text = start.text() + create(*places) + f"set type 1 diameter {2 * R!r} density 2500\nset group all vx {v!r}\n"
    text += f"fix floor all wall/nurbs {models} type 2 geometry wall.yaml surface wall motion linear 0 0 {w!r}\n"
    return text + "variable spring equal f_floor[25]\nthermo_style custom step f_floor[7] v_spring\nthermo_modify format float %.17g\nthermo 1\n"


def column(run: str, **options) -> np.ndarray:
    return decks.good(run + f"run {STEPS}\n", files=FLOOR, **options).table["spring"]


def closed_form(w: float, end: float) -> float:
    return integral(lambda t: 0.5 * (V * t) ** 2 * K * w / (2 * math.sqrt(D_0 + w * t)), 0, end)[0]


class TangentialSpring(unittest.TestCase):
    def test_gains_where_the_overlap_grows(self):
        w = 0.02
        gained = column(deck(w))
        self.assertEqual(gained[0], 0.0)
        for step in (500, STEPS):
            self.assertAlmostEqual(gained[step] / closed_form(w, step * DT), 1.0, delta=2 / step)

    def test_of_every_model_that_has_it(self):
        expected = column(deck(0.02))
        for models in (
            "model plastic/thornton tangential history",
            "model penalty/hertz tangential history",
            HISTORY + " rolling_friction epsd2",
            "model hertz tangential history cohesion sjkr",
        ):
            with self.subTest(models=models):
                self.assertLessEqual(np.abs(column(deck(0.02, models)) - expected).max(), 1e-9 * expected[-1])

    def test_is_lost_where_the_contact_opens(self):
        """All that shear has put in: integral of k_t xi dxi up to the end of the contact."""
        w, end = -0.01, D_0 / 0.01
        table = decks.good(deck(w) + f"run {STEPS}\n", files=FLOOR).table
        self.assertEqual(table["floor[7]"][-1], 0.0, "it has opened")
        work = K * V**2 * 4 / 15 * D_0**2.5 / w**2
        self.assertAlmostEqual(work, integral(lambda t: K * math.sqrt(max(D_0 + w * t, 0.0)) * V**2 * t, 0, end)[0], delta=1e-4 * work)
        self.assertAlmostEqual(table["spring"][-1] / -work, 1.0, delta=0.005)

    def test_is_nothing_without_change_or_spring(self):
        self.assertLessEqual(np.abs(column(deck(0.0))).max(), 1e-9 * closed_form(0.02, STEPS * DT))
        for models in ("model hertz tangential no_history", "model hertz"):
            self.assertEqual(np.abs(column(deck(0.02, models))).max(), 0.0, models)

    def test_is_the_sum_over_ranks_and_begins_anew_with_each_run(self):
        two = deck(0.02, balls=2)
        expected = 2 * column(deck(0.02))
        for ranks in (1, 2):
            self.assertLessEqual(np.abs(column(two, ranks=ranks) - expected).max(), 1e-9 * expected[-1])
        again = decks.good(deck(0.02) + "run 1000\nrun 1000\n", files=FLOOR).tables
        begin = expected[1000] / 2
        self.assertEqual(again[1]["spring"][0], 0.0)
        self.assertAlmostEqual(again[1]["spring"][-1] / (expected[-1] / 2 - begin), 1.0, delta=1e-9)


if __name__ == "__main__":
    unittest.main()

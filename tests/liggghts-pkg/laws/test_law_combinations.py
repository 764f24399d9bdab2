# SPDX-License-Identifier: GPL-2.0-or-later
"""Every combination of a contact law with LIGGGHTS' other models, as a wall and as a pair style.

Which models there are is read from LIGGGHTS' installed headers.  A combination works, and penalty/hertz with
lambda = 1 and plastic/thornton below its yield pressure give the bits of stock hertz in the same combination; or it
is refused with one line.
"""

import itertools
import os
import re
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import contact_deck
from contact_deck import LAWS, PLASTIC, decks


def model_words(kind: str) -> list[str]:
    """Words of the <KIND>_MODEL(identifier, word, id) entries in the headers of style_<kind>_model.h."""
    folders = [Path(folder) for folder in os.environ["LIGGGHTS_HEADERS"].split(":")]
    lists = [folder / f"style_{kind}_model.h" for folder in folders]
    (included,) = [header for header in lists if header.exists()]
    words = []
    for name in re.findall(r'#include "(.*)"', included.read_text()):
        (header,) = [folder / name for folder in folders if (folder / name).exists()]
        words += re.findall(rf"^{kind.upper()}_MODEL\(\w+,([^,]+),\d+\)", header.read_text(), re.MULTILINE)
    return words


ALL = list(
    itertools.product(
        ["off"] + model_words("tangential"),
        ["off"] + model_words("cohesion"),
        ["off"] + model_words("rolling"),
        model_words("surface"),
    )
)


def refused(rest: tuple[str, str, str, str], wall: bool) -> bool:
    tangential, cohesion, rolling, surface = rest
    return (
        surface != "default"
        or tangential == "tan_luding"
        or rolling == "luding"
        or (wall and cohesion == "easo/capillary/viscous")
    )


def deck(normal: str, rest: tuple[str, str, str, str], wall: bool, factor=1.0, yield_pressure=1e30) -> str:
    """Ten steps that begin in contact and, unless the bodies stick, end out of it; both bodies spin."""
    tangential, cohesion, rolling, surface = rest
    models = f"model {normal} tangential {tangential} cohesion {cohesion} "
    models += f"rolling_friction {rolling} surface {surface}"
    make = contact_deck.ball_on_plane if wall else contact_deck.two_balls
    velocity = (0.3, 0.1, 1.0) if wall else (-1.0, 0.3, 0.1)
    properties = dict(restitution=0.8, friction=0.4, factor=factor, yield_pressure=(yield_pressure, 1e30))
    motion = dict(velocity=velocity, spin=(50.0, 80.0, -30.0), overlap=5e-7, dt=1e-7, every=5)
    return make(models, **motion, **properties) + "run 10\n"


class Combinations(unittest.TestCase):
    def test_the_headers_have_what_is_meant(self):
        self.assertGreaterEqual(len(ALL), 4 * 5 * 6 * 3)

    def check_working(self, wall: bool):
        working = [rest for rest in ALL if not refused(rest, wall)]
        self.assertGreaterEqual(len(working), 60 if wall else 75)
        normals = (
            ("hertz", {}),
            ("penalty/hertz", {}),
            (PLASTIC, {}),
            ("penalty/linear", dict(factor=1e-3)),
            ("penalty/quadratic", dict(factor=500.0)),
            (PLASTIC, dict(yield_pressure=2e8)),
        )
        tables = contact_deck.run_each(
            deck(normal, rest, wall, **properties) for rest, (normal, properties) in itertools.product(working, normals)
        )
        for k, rest in enumerate(working):
            stock, *ours = tables[6 * k : 6 * k + 6]
            with self.subTest(rest=rest, wall=wall):
                for table in ours[:2]:
                    for column, values in stock.items():
                        np.testing.assert_array_equal(table[column], values, err_msg=column)
                force = "fz1" if wall else "fx1"
                for table in ours[2:]:
                    self.assertTrue(all(np.isfinite(values).all() for values in table.values()))
                    self.assertNotEqual(table[force][0], 0.0)
                    self.assertNotEqual(table[force][0], stock[force][0])

    def test_walls(self):
        self.check_working(wall=True)

    def test_pairs(self):
        self.check_working(wall=False)

    def test_all_others_are_refused_in_one_line(self):
        # a refusal ends its process, so not all of them: each refused word alone and with one other word
        def extras(rest):
            return sum(word != usual for word, usual in zip(rest, ("off", "off", "off", "default")))

        cases = [
            (law, rest, wall)
            for law, rest, wall in itertools.product((*LAWS, PLASTIC), ALL, (True, False))
            if refused(rest, wall) and extras(rest) <= (2 if law == LAWS[0] else 1)
        ]
        self.assertGreater(len(cases), 50)
        with ThreadPoolExecutor(8) as pool:
            runs = pool.map(lambda case: decks.run(deck(*case)), cases)
        for case, run in zip(cases, runs):
            with self.subTest(case=case):
                self.assertNotEqual(run.code, 0)
                self.assertEqual(len(run.errors), 1, run.text)
                self.assertRegex(
                    run.errors[0],
                    r"model '(multicontact|superquadric|tan_luding|luding|easo/.*)' needs ",
                )
                self.assertEqual(run.tables, [])


if __name__ == "__main__":
    unittest.main()

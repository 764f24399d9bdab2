# SPDX-License-Identifier: GPL-2.0-or-later
"""Shapes given by words are searched in closed form: balls feel them as they feel the same patches under the paper's
search, and a run that was begun with the one goes on with the other."""

import unittest

import numpy as np

import decks
from prelude import Prelude, create

PLACES = [(0.0, 0.0), (0.05, 0.0), (0.1, 0.0), (0.0, 0.05), (0.05, 0.05)]  # x, y of each shape [m]
SHAPES = {
    "plane": "plane: {{origin: [{x0}, {y0}, 0], edges: [[0.04, 0, 0], [0, 0.04, 0]], elements: [7, 5], degree: 2}}",
    "pipe": "cylinder: {{origin: [{x0}, {y}, 0.01], axis: [1, 0, 0], reference: [0, 1, 0], radius: 0.01, length: 0.04, "
    "angle: [-170, -10], elements: [6, 5]}}",
    "cone": "cone: {{origin: [{x}, {y}, -0.002], axis: [0, 0, 1], radii: [0.001, 0.018], length: 0.016, elements: [8, 4]}}",
    "bowl": "sphere: {{centre: [{x}, {y}, 0.015], radius: 0.015, latitude: [-90, 10], elements: [8, 6]}}",
    "ring": "torus: {{centre: [{x}, {y}, 0.003], axis: [0, 0, 1], radius: 0.012, tube_radius: 0.003, elements: [8, 8]}}",
}
HEIGHT = {"plane": 0.00102, "pipe": 0.0013, "cone": 0.00105, "bowl": 0.0013, "ring": 0.00702}  # of each ball's centre [m]
SEARCHES = ("newton", "simplex_brent")  # in closed form, and on the patches
MODELS = "model hertz tangential history rolling_friction epsd2"


def files() -> dict[str, str]:
    named: dict[str, str] = {}
    for (name, words), (x, y) in zip(SHAPES.items(), PLACES):
        text = words.format(x=x, y=y, x0=x - 0.02, y0=y - 0.02)
        named[f"{name}.yaml"] = f"units: si\ngeometry:\n  {text}\nsurfaces: {{wall: all}}\n"
    return named


def walls(search: str) -> str:
    line = "fix {0} all wall/nurbs {1} type 2 geometry {0}.yaml surface wall search {2}\n"
    return "".join(line.format(name, MODELS, search) for name in SHAPES)


def prelude() -> Prelude:
    return Prelude(
        "-0.03 0.13 -0.03 0.08 -0.005 0.03", E=(1e7, 1e7), nu=(0.3, 0.3), e=0.6, mu=0.4, models=MODELS, timestep=1e-5,
        further=dict(coefficientRollingFriction=0.05),
    )


BALLS = range(1, 1 + len(SHAPES))
COLUMNS = ("x", "y", "z", "fx", "fy", "fz")


def output() -> str:
    """Motion of the balls; of each wall its force and the number of its contacts."""
    lines = "".join(f"variable {v}{n} equal {v}[{n}]\n" for n in BALLS for v in COLUMNS)
    words = [f"v_{v}{n}" for n in BALLS for v in COLUMNS] + [f"f_{name}[{i}]" for name in SHAPES for i in (1, 2, 3, 7)]
    lines += f"thermo_style custom step {' '.join(words)}\nthermo_modify format float %.17g lost error\nthermo 5\n"
    return lines + "fix integrate all nve/sphere\nfix g all gravity 9.81 vector 0 0 -1\n"


def start(search: str) -> str:
    # off the axes: there a bowl and a cone have no direction of their own
    centres = [(x + 0.0015, y + (0.012 if n == "ring" else 0.0022), HEIGHT[n]) for (x, y), n in zip(PLACES, SHAPES)]
    deck = prelude().text() + create(*centres) + "set group all diameter 0.002 density 2500\n"
    return deck + "set atom * vx 0.06 vy -0.03 vz -0.05\n" + walls(search) + output()


class ClosedForms(unittest.TestCase):
    def assert_same(self, ours, reference, tolerance):
        for column, values in reference.items():
            self.assertEqual(len(values), len(ours[column]))
            scale = max(np.abs(values).max(), 1e-3)
            self.assertLess(np.abs(ours[column] - values).max(), tolerance * scale, column)

    def test_balls_feel_the_same_shapes(self):
        words, points = (decks.good(start(search) + "run 2500\n", files=files()).table for search in SEARCHES)
        for name in SHAPES:
            self.assertGreater(points[f"{name}[7]"].max(), 0.5, f"a ball touches the {name}")
        self.assert_same(words, points, 1e-9)

    def test_a_run_goes_on_on_the_other(self):
        """Slots of contacts mean the same places of the patches, on the same sides."""
        first, second = SEARCHES
        begun = start(first) + "run 600\nwrite_restart half\nrun 1900\n"
        deck = start(first) + "run 600\nwrite_restart half\nclear\n"
        deck += prelude().again("half") + walls(second) + output() + "run 1900\n"
        self.assert_same(decks.good(deck, files=files()).table, decks.good(begun, files=files()).table, 1e-9)


if __name__ == "__main__":
    unittest.main()

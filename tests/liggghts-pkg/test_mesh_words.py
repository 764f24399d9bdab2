# SPDX-License-Identifier: GPL-2.0-or-later
"""The words of stock mesh walls on a rigid wall: `scale`, `move` and `rotate` in the order given, as in the geometry file and
on fix mesh/surface."""

import unittest

import numpy as np

import decks
from prelude import INTEGRATION
from test_wall_output import FLOOR, MODELS, START, STL

# of a wall that is tilted twice; the ball meets it off its diagonal, where stock walls hand contacts on
WORDS = "scale 1.5 rotate axis 1 0 0 angle 20 move 0.0002 0.0015 -0.0004 rotate axis 0 2 -0.1 angle -10"
IN_FILE = "scale: 1.5, rotate: {axis: [1, 0, 0], angle: 20}, move: [0.0002, 0.0015, -0.0004]"
DECK = START.text() + """\
create_atoms 1 single 0.0012 -0.0007 0.0003 units box
set group all diameter 0.002 density 2480
velocity all set 0.2 0.1 -1.0 units box
{wall}
""" + INTEGRATION + "compute spin all property/atom omegax omegay omegaz\n" + decks.BALL + """\
thermo_style custom step v_x v_y v_z v_vx v_vy v_vz v_wx v_wy v_wz
thermo_modify format float %.17g lost error
thermo 20
run 900
"""


def floor(words: str, file: str = "floor.yaml") -> str:
    return DECK.format(wall=f"fix floor all wall/nurbs {MODELS} type 2 geometry {file} surface floor {words}")


def mesh(words: str) -> str:
    mesh = f"fix mesh all mesh/surface file plane.stl type 2 {words}\n"
    return DECK.format(wall=mesh + f"fix wall all wall/gran {MODELS} mesh n_meshes 1 meshes mesh")


def moved(words: str) -> str:
    """The floor's file with its geometry moved."""
    return FLOOR.replace("degree: 2}", "degree: 2}\n  " + words.replace("}, ", "}\n  ").replace("1.5, ", "1.5\n  "))


class Placement(unittest.TestCase):
    def run_deck(self, deck: str, **options) -> dict:
        files = {"floor.yaml": FLOOR, "moved.yaml": moved(IN_FILE), "plane.stl": STL}
        return decks.good(deck, files=files, **options).table

    def test_words_place_the_wall_as_its_file_does(self):
        words = WORDS[: WORDS.rindex(" rotate")]
        of_file = self.run_deck(floor("", "moved.yaml"))
        self.assertGreater(of_file["vz"][-1], -0.5, "the ball bounces")
        ours = self.run_deck(floor(words))
        for name in of_file:
            self.assertEqual(list(ours[name]), list(of_file[name]), name)

    def test_words_place_the_wall_as_they_place_a_mesh(self):
        """LIGGGHTS has nine digits of pi."""
        ours, stock = self.run_deck(floor(WORDS)), self.run_deck(mesh(WORDS), program=decks.STOCK)
        for name in ("vx", "vy"):
            self.assertLess(stock[name][-1] - stock[name][0], -0.1, "tilted along both")
        for name, column in stock.items():
            self.assertLess(decks.largest_difference(ours[name], column), 1e-7, name)

    def test_verbose_tells_what_the_wall_is(self):
        words = "scale 2 move 0 0 -0.002 verbose"
        told, silent = (decks.good(floor(f"{words} {yes}"), files={"floor.yaml": FLOOR}).text for yes in ("yes", "no"))
        extents = "x -0.008 to 0.008, y -0.008 to 0.008, z -0.002 to -0.002"
        for line in ("surface 'floor' of 'floor.yaml'", extents, "area 0.000256", "eta+: free"):
            self.assertIn(line, told)
            self.assertNotIn(line, silent)

    def test_verbose_counts_smooth_edges_by_the_angle_of_the_deck(self):
        """The sides of a prism turn by 0.39 rad."""
        corners = [(f"{np.cos(a):.9f}", f"{np.sin(a):.9f}") for a in np.linspace(0, 2 * np.pi, 17)]
        facets = ""
        for (x, y), (X, Y) in zip(corners, corners[1:]):
            for triangle in (f"{x} {y} 0 {X} {Y} 0 {X} {Y} 1", f"{x} {y} 0 {X} {Y} 1 {x} {y} 1"):
                v = triangle.split()
                loop = "".join(f"vertex {' '.join(v[k : k + 3])}\n" for k in (0, 3, 6))
                facets += f"facet normal 0 0 0\nouter loop\n{loop}endloop\nendfacet\n"
        files = {"tube.stl": f"solid tube\n{facets}endsolid tube\n"}
        for words, edges in (("", "16 convex, 0 concave, 0 smooth"), ("edge_angle 0.5", "0 convex, 0 concave, 16 smooth")):
            wall = floor(f"scale 0.008 verbose yes {words}").replace("floor.yaml surface floor", "tube.stl surface all")
            self.assertIn(edges, decks.good(wall, files=files).text)


if __name__ == "__main__":
    unittest.main()

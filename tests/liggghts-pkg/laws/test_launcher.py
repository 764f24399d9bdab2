# SPDX-License-Identifier: GPL-2.0-or-later
"""liggghts-nurbs is the stock program plus our styles; nothing of ours replaces anything else in it."""

import os
import subprocess
import unittest

import numpy as np

import contact_deck
from contact_deck import decks

PLANE = """
units: si
geometry:
  plane: {origin: [-0.005, -0.005, 0], edges: [[0.01, 0, 0], [0, 0.01, 0]], elements: [2, 2], degree: 2}
surfaces: {top: all}
"""


def defined(binary: str) -> set[str]:
    """Mangled names of the dynamic symbols that a binary defines."""
    command = [os.environ["NM"], "-D", "--defined-only", binary]
    listing = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return {line.split()[-1].split("@")[0] for line in listing.splitlines()}


class Symbols(unittest.TestCase):
    def test_library_exports_the_hook_only(self):
        self.assertEqual(defined(os.environ["WALL_NURBS_LIBRARY"]), {"_ZN9LAMMPS_NS6LAMMPS6createEv"})

    def test_executable_replaces_nothing(self):
        self.assertEqual(defined(decks.NURBS) & defined(os.environ["LIBLIGGGHTS"]), set())


class Behaviour(unittest.TestCase):
    def test_stock_deck_gives_stock_numbers(self):
        oblique = dict(velocity=(0.3, 0.0, -1.0), friction=0.2)
        deck = contact_deck.ball_on_plane("model hertz tangential history", **oblique) + "run 600\n"
        ours, stock = decks.good(deck).table, decks.good(deck, program=decks.STOCK).table
        for column, values in stock.items():
            np.testing.assert_array_equal(ours[column], values, err_msg=column)

    def test_an_error_ends_with_a_code(self):
        run = decks.run("no_such_command\n")
        self.assertEqual(len(run.errors), 1, run.text)
        self.assertNotEqual(run.code, 0)

    def test_id_in_use(self):
        # the stock styles crash here
        deck = contact_deck.ball_on_plane("model hertz tangential no_history") + "unfix wall\n"
        for word, message in (
            ("wall/nurbs", "Replacing a fix, but new style != old style"),
            ("wall/gran/nurbs", r"\(id again\): this id is in use, expected 'unfix again' first"),
        ):
            with self.subTest(word=word):
                fix = f"fix again all {word} model hertz type 2 geometry plane.yaml surface top\n"
                run = decks.run(deck + fix + fix, files={"plane.yaml": PLANE})
                self.assertEqual(len(run.errors), 1, run.text)
                self.assertRegex(run.errors[0], message)
                self.assertNotEqual(run.code, 0)


if __name__ == "__main__":
    unittest.main()

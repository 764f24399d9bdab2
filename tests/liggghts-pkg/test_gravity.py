# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck's `fix gravity` acts on particles alone: beside a solid without gravity the fix warns, with the very line that the
model file lacks."""

import re
import unittest

import numpy as np

import ball_on_block as bob
import decks

FLOOR = """
units: si
geometry:
  plane: {origin: [-0.002, -0.002, 0], edges: [[0.004, 0, 0], [0, 0.004, 0]], elements: [4, 4], degree: 2}
surfaces: {top: all}
"""
GRAVITY = "fix g all gravity 9.81 vector 0 0 -1\n"
BLOCK = bob.block(fixed=())


def run(gravity: str = GRAVITY, model: str = BLOCK, words: str = "structure block.yaml surface top", *, first=True, ranks=1,
        runs: str = "run 1\nrun 1\n", units: str = "si") -> tuple[list[str], decks.Run]:
    """The warnings of gravity; with gravity before or after the wall."""
    fixes = [gravity, bob.wall(rest=words)]
    deck = bob.prelude(units=units, balls=((0, 0, 4e-3),)) + "".join(fixes if first else fixes[::-1]) + bob.output((11,)) + runs
    result = decks.good(deck, files={"block.yaml": model, "floor.yaml": FLOOR}, ranks=ranks)
    return [line for line in result.text.splitlines() if "WARNING" in line and "gravity" in line], result


class Gravity(unittest.TestCase):
    def line(self, warnings: list[str]) -> str:
        """The line to add that the one warning names."""
        (warning,) = warnings
        self.assertRegex(warning, r"id plate.*fix gravity \(id g\).*'block.yaml'")
        return re.search(r"'(loads: \{gravity: \[[^]]*\]\})'", warning)[1]

    def test_warns_once_with_the_line_to_add(self):
        for first in (True, False):
            for ranks in (1, 2):
                self.assertEqual(self.line(run(first=first, ranks=ranks)[0]), "loads: {gravity: [0, 0, -9.81]}")

    def test_the_line_is_in_the_decks_units_and_direction(self):
        line = self.line(run("fix g all gravity 981 vector 3 0 -4\n", BLOCK.replace("units: si", "units: cgs"), units="cgs")[0])
        self.assertEqual(line, "loads: {gravity: [588.6, 0, -784.8]}")

    def test_with_the_line_the_solid_falls_and_nothing_is_said(self):
        line = self.line(run()[0])
        warnings, result = run(model=BLOCK + line + "\n", runs="run 100\n")
        self.assertEqual(warnings, [])
        mass, t = 1000.0 * 4e-3 * 4e-3 * 2e-3, 1e-8 * 100
        np.testing.assert_allclose(result.table["plate11"][-1], -mass * 9.81 * t, rtol=1e-9)

    def test_nothing_is_said_where_nothing_is_missing(self):
        for name, settings in {
            "gravity of zero, as meant": dict(model=BLOCK + "loads: {gravity: [0, 0, 0]}\n"),
            "no gravity in the deck": dict(gravity=""),
            "a deck's gravity of zero": dict(gravity="fix g all gravity 0. vector 0 0 -1\n"),
            "a rigid wall": dict(words="geometry floor.yaml surface top"),
            "a rigid wall that moves": dict(words="geometry floor.yaml surface top motion linear 0 0 0.1"),
        }.items():
            with self.subTest(name):
                self.assertEqual(run(**settings)[0], [])

    def test_a_solid_that_takes_the_decks_says_so_where_the_deck_has_none(self):
        model = BLOCK + "loads: {gravity: deck}\n"
        for ranks in (1, 2):
            (warning,) = run("", model, ranks=ranks)[0]
            self.assertRegex(warning, r"id plate.*'block.yaml' has 'gravity: deck', and the deck no fix gravity")
        self.assertEqual(run("fix g all gravity 0. vector 0 0 -1\n", model)[0], [])

    def test_a_solid_may_take_the_decks(self):
        """The sum of what there is, on any number of ranks, and anew in each run; one that varies is refused."""
        model = BLOCK + "loads: {gravity: deck, tractions: [{face: zeta+, value: [1000, 0, 0]}]}\n"
        start = bob.prelude(balls=((0, 0, 4e-3),)) + GRAVITY
        end = bob.wall() + bob.output((9, 10, 11))
        for ranks in (1, 2):
            deck = start + "fix h all gravity 5 vector 0 1 0\n" + end + "run 60\nunfix h\nrun 40\n"
            result = decks.good(deck, files={"block.yaml": model}, ranks=ranks)
            self.assertNotIn("loads: {gravity", result.text)
            mass = 1000.0 * 4e-3 * 4e-3 * 2e-3
            found = [result.tables[-1][f"plate{column}"][-1] for column in (9, 10, 11)]
            np.testing.assert_allclose(found, [1000 * 16e-6 * 1e-6, mass * 5 * 6e-7, -mass * 9.81 * 1e-6], rtol=1e-9)
        varying = start.replace(GRAVITY, "variable a equal 9.81*step\nfix g all gravity v_a vector 0 0 -1\n")
        refused = decks.run(varying + end + "run 1\n", files={"block.yaml": model})
        self.assertNotEqual(refused.code, 0)
        self.assertIn("'block.yaml' has 'gravity: deck', expected a constant one", refused.text)

    def test_tractions_alone_are_no_gravity(self):
        loads = "loads: {tractions: [{face: zeta+, value: [0, 0, -1]}]}\n"
        self.assertEqual(self.line(run(model=BLOCK + loads)[0]), "loads: {gravity: [0, 0, -9.81]}")

    def test_gravity_that_varies(self):
        (warning,) = run("variable G equal 9.81*step\nfix g all gravity v_G vector 0 0 -1\n")[0]
        self.assertIn("varies", warning)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong input to the contact laws ends in one line that says what was given; lambda comes in two units."""

import re
import unittest

import contact_deck
from contact_deck import decks

FACTOR_LINE = re.compile(r"^fix \w+ all property/global penaltyFactor .*$", re.MULTILINE)
YIELD_LINE = re.compile(r"^fix \w+ all property/global yieldPressure .*$", re.MULTILINE)


def with_factor_line(deck: str, line: str) -> str:
    return FACTOR_LINE.sub(line, deck)


class WrongInput(unittest.TestCase):
    def check(self, deck: str, message: str):
        run = decks.run(deck + "run 1\n", timeout=30)
        self.assertEqual(len(run.errors), 1, run.text)
        self.assertRegex(run.errors[0], message)
        self.assertNotEqual(run.code, 0)

    def test_factor_must_be_there(self):
        for deck in (contact_deck.ball_on_plane, contact_deck.two_balls):
            with self.subTest(deck=deck.__name__):
                without = with_factor_line(deck("model penalty/linear"), "")
                line = "fix ID all property/global penaltyFactor peratomtypepair 2 P_11 P_12 P_21 P_22"
                self.check(without, f"model penalty/linear needs penaltyFactor, expected the line '{line}'")

    def test_factor_must_be_positive(self):
        for value in ("-1", "0"):
            with self.subTest(value=value):
                line = f"fix m9 all property/global penaltyFactor peratomtypepair 2 1 {value} {value} 1"
                deck = with_factor_line(contact_deck.ball_on_plane("model penalty/quadratic"), line)
                self.check(deck, f"penaltyFactor of atom types 1 and 2 is {value}, expected a number > 0")

    def test_yield_pressure(self):
        line = "fix ID all property/global yieldPressure peratomtype P_1 P_2"
        missing = f"model plastic/thornton needs yieldPressure, expected the line '{line}'"
        cases = {
            "": missing,
            "peratomtypepair 2 1 1 1 1": missing,
            "scalar 1e9": missing,
            "peratomtype 1e9": "yieldPressure",
            "peratomtype 1e9 0": "yieldPressure of atom types 1 and 2 is 0, expected a number > 0",
            "peratomtype -1e9 1e9": "yieldPressure of atom types 1 and 1 is -1e\\+09, expected a number > 0",
        }
        for values, message in cases.items():
            line = f"fix p all property/global yieldPressure {values}" if values else ""
            for deck in (contact_deck.ball_on_plane, contact_deck.two_balls):
                with self.subTest(line, deck=deck.__name__):
                    self.check(YIELD_LINE.sub(line, deck("model plastic/thornton")), message)

    def test_unknown_models(self):
        for word in ("penalty", "penalty/cubic"):
            with self.subTest(word=word):
                self.check(contact_deck.ball_on_plane(f"model {word}"), "Invalid model specified")
                self.check(contact_deck.two_balls(f"model {word}"), "Invalid model specified")

    def test_energies_that_are_not_kept(self):
        wall, pair = contact_deck.ball_on_plane, contact_deck.two_balls
        for law, setting, deck in (
            ("penalty/linear", "computeElasticPotential", wall),
            ("penalty/hertz", "computeElasticPotential", pair),
            ("penalty/hertz", "computeDissipatedEnergy", wall),
            ("penalty/quadratic", "computeDissipatedEnergy", pair),
        ):
            with self.subTest(law=law, setting=setting, deck=deck.__name__):
                self.check(deck(f"model {law}", settings=f"{setting} on"), f"Model {law} knows neither")

    def test_unknown_setting(self):
        self.check(contact_deck.two_balls("model penalty/hertz", settings="limitforce on"), "'limitforce'")


class PrintedProperties(unittest.TestCase):
    def lines(self, deck: str) -> list[str]:
        text = decks.good(deck + "run 0\nrun 0\n").text
        return [line for line in text.splitlines() if "penaltyFactor" in line]

    def test_of_two_types_the_smaller(self):
        deck = contact_deck.ball_on_plane("model plastic/thornton", yield_pressure=(3e8, 2e9))
        text = decks.good(deck + "run 0\nrun 0\n").text
        lines = [line for line in text.splitlines() if "yieldPressure" in line]
        self.assertEqual(lines, ["Model plastic/thornton: yieldPressure 3e+08 (types 1-1 1-2); 2e+09 (types 2-2)"])

    def test_both_units_once_per_law(self):
        deck = contact_deck.ball_on_plane("model penalty/linear", factor=1.741939e-3)
        self.assertEqual(
            self.lines(deck),
            [
                "Model penalty/linear: penaltyFactor 0.00174194 m^(1/2) = 0.0550849 mm^(1/2) "
                "(types 1-1 1-2 2-2)"
            ],
        )

    def test_the_same_in_every_system_of_units(self):
        for style, unit, in_metres in (("cgs", "cm", 1e-2), ("micro", "um", 1e-6), ("nano", "nm", 1e-9)):
            factor = 1.741939e-3 / in_metres**0.5
            deck = contact_deck.ball_on_plane("model penalty/linear", factor=factor).replace("units si", f"units {style}")
            with self.subTest(style):
                (line,) = self.lines(deck)
                self.assertIn(f"penaltyFactor {factor:.6g} {unit}^(1/2) = 0.0550849 mm^(1/2) (types", line)

    def test_inverse_root_and_pure_number(self):
        deck = contact_deck.two_balls("model penalty/quadratic", factor=498.327)
        deck += "fix second all wall/gran model penalty/hertz primitive type 1 zplane -0.005\n"
        factor = "fix m9 all property/global penaltyFactor peratomtypepair 2 498.327 0.6 0.6 498.327"
        deck = with_factor_line(deck, factor)
        self.assertEqual(
            sorted(self.lines(deck)),
            [
                "Model penalty/hertz: penaltyFactor 0.6 (types 1-2); 498.327 (types 1-1 2-2)",
                "Model penalty/quadratic: penaltyFactor 0.6 m^(-1/2) = 0.0189737 mm^(-1/2) (types 1-2); "
                "498.327 m^(-1/2) = 15.7585 mm^(-1/2) (types 1-1 2-2)",
            ],
        )


if __name__ == "__main__":
    unittest.main()

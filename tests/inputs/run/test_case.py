# SPDX-License-Identifier: GPL-2.0-or-later
"""Variables of a run: what the deck, the case and the user say, in rising order."""

import tempfile
import unittest
from pathlib import Path

from study.run.case import Case, index_variables, material, numbers, run_variables
from study.run.usage import UsageError

DECK = """# variable no index 1
variable law    index hertz    # linear | hertz
variable lambda index 1.0
  variable V index 2.0e0
variable steps  index 700
variable fall equal -${V}
"""


def write(test, text):
    folder = tempfile.TemporaryDirectory()
    test.addCleanup(folder.cleanup)
    path = Path(folder.name) / "file"
    path.write_text(text)
    return path


class Variables(unittest.TestCase):
    DEFAULTS = {"law": "hertz", "lambda": "1.0", "V": "2.0e0", "steps": "700"}

    def test_index_variables_of_a_deck(self):
        self.assertEqual(index_variables(write(self, DECK)), self.DEFAULTS)

    def test_the_user_has_the_last_word(self):
        case = Case("c", "in.c", lambda result: [], {"lambda": 0.1, "law": "linear"})
        values = run_variables(case, self.DEFAULTS, {"lambda": "0.2", "elsewhere": "3"})
        self.assertEqual(values, {"law": "linear", "lambda": "0.2", "V": "2.0e0", "steps": "700"})

    def test_numbers_keep_all_digits(self):
        case = Case("c", "in.c", lambda result: [], {"V": 0.1 + 0.2})
        values = run_variables(case, self.DEFAULTS, {})
        self.assertEqual(numbers(values)["V"], 0.1 + 0.2)
        self.assertEqual(numbers(values)["law"], "hertz")

    def test_steps_follow_the_values(self):
        case = Case("c", "in.c", lambda result: [], steps=lambda v: round(100 * v["V"]))
        self.assertEqual(run_variables(case, self.DEFAULTS, {})["steps"], "200")
        self.assertEqual(run_variables(case, self.DEFAULTS, {"V": "3"})["steps"], "300")
        self.assertEqual(run_variables(case, self.DEFAULTS, {"V": "3", "steps": "9"})["steps"], "9")

    def test_values_that_leave_no_contact(self):
        case = Case("c", "in.c", lambda result: [], steps=lambda v: round(100 / v["V"]))
        for V in ("0", "-1", "fast", "nan"):
            with self.subTest(V=V), self.assertRaisesRegex(UsageError, f"'c'.*V = {V}"):
                run_variables(case, self.DEFAULTS, {"V": V})


class Material(unittest.TestCase):
    def test_numbers_without_sign_in_the_exponent(self):
        text = "material: {law: linear_elastic, youngs_modulus: 210.6e9, density: 7850}"
        file = write(self, text)
        self.assertEqual(material(file), {"youngs_modulus": 210.6e9, "density": 7850.0})


if __name__ == "__main__":
    unittest.main()

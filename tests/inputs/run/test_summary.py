# SPDX-License-Identifier: GPL-2.0-or-later
"""The shape of summary.json and the rule by which a row passes."""

import json
import tempfile
import unittest
from pathlib import Path

from study.run.summary import Row, read_json, table, write_json

KEYS = ["case", "quantity", "value", "unit", "reference", "error", "tolerance", "pass", "of"]


class Rule(unittest.TestCase):
    def test_relative_error(self):
        row = Row("a", "peak_force", 6.7, "N", 6.6, 0.02)
        self.assertAlmostEqual(row.error, 6.7 / 6.6 - 1.0, delta=1e-15)
        self.assertIs(row.passes, True)
        self.assertIs(Row("a", "peak_force", 6.4, "N", 6.6, 0.02).passes, False)

    def test_absolute_error_where_the_reference_is_zero(self):
        self.assertEqual(Row("a", "balance", -3e-13, "1", 0.0, 1e-12).error, -3e-13)
        self.assertIs(Row("a", "balance", -3e-13, "1", 0.0, 1e-12).passes, True)
        self.assertIs(Row("a", "balance", -3e-12, "1", 0.0, 1e-12).passes, False)

    def test_the_tolerance_itself_passes(self):
        self.assertIs(Row("a", "x", 1.5, "1", 1.0, 0.5).passes, True)
        self.assertIs(Row("a", "x", 0.5, "1", 1.0, 0.5).passes, True)

    def test_negative_reference(self):
        self.assertAlmostEqual(Row("a", "x", -1.1, "1", -1.0, 0.2).error, 0.1, delta=1e-15)

    def test_no_reference_is_information(self):
        row = Row("a", "lambda", 0.6, "1")
        self.assertIsNone(row.error)
        self.assertIsNone(row.passes)

    def test_no_number_never_passes(self):
        for value in (float("nan"), float("inf")):
            self.assertIs(Row("a", "x", value, "1", 1.0, 1e9).passes, False)


class Json(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "summary.json"

    def written(self, rows):
        write_json(self.path, "deck", rows)

        def no_constant(word):
            raise AssertionError(f"{word} is no JSON")

        return json.loads(self.path.read_text(), parse_constant=no_constant)

    def test_shape(self):
        rows = [Row("a", "x", 1.25, "N", 1.0, 0.3), Row("b", "y", 2.0, "1", note="said")]
        summary = self.written(rows)
        self.assertEqual(list(summary), ["deck", "rows"])
        self.assertEqual([list(row) for row in summary["rows"]], [KEYS, KEYS])
        first, second = (list(row.values()) for row in summary["rows"])
        self.assertEqual(first, ["a", "x", 1.25, "N", 1.0, 0.25, 0.3, True, ["a"]])
        self.assertEqual(second, ["b", "y", 2.0, "1", None, None, None, None, ["b"]])

    def test_a_row_of_several_cases(self):
        rows = self.written([Row("both", "ratio", 2.0, "1", of=("a", "b"))])["rows"]
        self.assertEqual(rows[0]["of"], ["a", "b"])
        self.assertEqual(read_json(self.path), rows)

    def test_no_summary_has_no_rows(self):
        self.assertEqual(read_json(self.path), [])
        for text in ("", "{", "[]", '{"rows": [{"case": "of an older version"}]}'):
            self.path.write_text(text)
            self.assertEqual(read_json(self.path), [], text)

    def test_all_digits(self):
        value = 6.6865933000000001e-5 / 3.0
        self.assertEqual(self.written([Row("a", "x", value, "1")])["rows"][0]["value"], value)

    def test_no_number_is_null(self):
        row = self.written([Row("a", "x", float("nan"), "1", 1.0, 0.1)])["rows"][0]
        self.assertEqual((row["value"], row["error"], row["pass"]), (None, None, False))

    def test_nothing_half_written(self):
        self.written([])
        with self.assertRaises(TypeError):
            write_json(self.path, "deck", [Row("a", object(), 1.0, "1")])
        self.assertEqual(json.loads(self.path.read_text())["rows"], [])
        self.assertEqual([p.name for p in self.path.parent.iterdir()], ["summary.json"])


class Table(unittest.TestCase):
    def test_lines(self):
        rows = [
            Row("a", "peak", 1.25, "N", 1.0, 0.3),
            Row("a", "balance", 3e-13, "1", 0.0, 1e-13),
            Row("b", "lambda", 1.742e-3, "m^(1/2)", note="= 0.055085 mm^(1/2)"),
        ]
        head, *lines = [line.split() for line in table(rows).splitlines()]
        self.assertEqual(head, "case quantity value unit reference error tolerance".split())
        self.assertEqual(lines[0], "a peak 1.25 N 1 +25.0000 % 30.0000 % ok".split())
        self.assertEqual(lines[1], "balance 3e-13 1 0 +3.0e-13 1.0e-13 FAIL".split())
        self.assertEqual(lines[2], "b lambda 0.001742 m^(1/2) = 0.055085 mm^(1/2)".split())


if __name__ == "__main__":
    unittest.main()

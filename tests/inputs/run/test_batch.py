# SPDX-License-Identifier: GPL-2.0-or-later
"""What a study may ask for beyond the rows of its cases: rows about several of them, further files."""

import contextlib
import io
import json
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from study.run.batch import Batch
from study.run.case import Case, Comparison, Figure, Study
from study.run.solver import Solver
from study.run.summary import Row

HERE = Path(__file__).resolve().parent
DECK = HERE.parents[2] / "inputs/ball_plate"


def peak(result):
    return result.force["F"].max()


def case(name, lam, **further):
    return Case(name, "in.ball_plate", lambda r: [Row(name, "peak", peak(r), "N")], {"lambda": lam}, **further)


class BatchOfTwo(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name)

    def run_cases(self, *chosen, expected=1.2 ** (2 / 5), user={}):
        cases = [case("one", 1.0, keep=("state.*", "plate.yaml")), case("other", 1.2)]
        ratio = Comparison(
            ["one", "other"],
            lambda results: [Row("both", "ratio", peak(results["other"]) / peak(results["one"]), "1", expected, 1e-4)],
        )
        pictures = [
            Figure(f"{name}.png", names, lambda path, results: path.write_text("drawn"))
            for name, names in (("both", ["one", "other"]), ("other", ["other"]))
        ]
        batch = Batch(DECK, Study(cases, pictures, [ratio]), [cases[i] for i in chosen], user)
        with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.redirect_stderr(io.StringIO()):
            passed = batch.run(Solver(HERE / "closed_form_solver.py"), 1, False, self.out)
        return passed, printed.getvalue()

    def test_a_comparison_has_the_results_of_its_cases(self):
        passed, printed = self.run_cases(0, 1)  # peak force ~ lambda^(2/5)
        self.assertTrue(passed, printed)
        self.assertIn("ratio", printed)
        self.assertIn('"ratio"', (self.out / "summary.json").read_text())

    def test_a_comparison_can_fail(self):
        passed, printed = self.run_cases(0, 1, expected=1.0)
        self.assertFalse(passed)
        self.assertIn("FAIL", printed)

    def test_a_comparison_waits_for_all_its_cases(self):
        passed, printed = self.run_cases(0)
        self.assertTrue(passed)
        self.assertNotIn("ratio", printed)

    def summary(self):
        rows = json.loads((self.out / "summary.json").read_text())["rows"]
        return {(row["case"], row["quantity"]): row["value"] for row in rows}

    def test_the_rows_of_other_cases_stay_as_their_files_do(self):
        self.run_cases(0, 1)
        before = self.summary()
        self.assertEqual(list(before), [("one", "peak"), ("other", "peak"), ("both", "ratio")])
        self.run_cases(0, user={"V": "2.0"})
        after = self.summary()
        self.assertEqual(list(after), [("one", "peak"), ("other", "peak")])  # the ratio was that of the old run
        self.assertAlmostEqual(after["one", "peak"] / before["one", "peak"], 2.0**1.2, delta=1e-3)  # Hertz: V^(6/5)
        self.assertEqual(after["other", "peak"], before["other", "peak"])
        left = {path.name for path in self.out.iterdir()}
        self.assertLessEqual({"contact_force_other.csv", "log_other.txt", "other.png"}, left)
        self.assertNotIn("both.png", left)

    def test_rows_go_with_their_files(self):
        self.run_cases(0, 1)
        (self.out / "log_other.txt").unlink()
        self.run_cases(0)
        self.assertEqual(list(self.summary()), [("one", "peak")])

    def test_a_failure_takes_the_rows_and_files_of_its_own_case_alone(self):
        self.run_cases(0, 1)
        with mock.patch.dict(os.environ, FAIL_AT="1.0"):
            passed, _ = self.run_cases(0)
        self.assertFalse(passed)
        self.assertEqual(list(self.summary()), [("other", "peak")])
        left = {path.name for path in self.out.iterdir()}
        self.assertEqual(left, {"contact_force_other.csv", "log_one.txt", "log_other.txt", "other.png", "summary.json"})

    def test_a_failure_of_the_last_case_leaves_the_new_rows_of_those_before(self):
        self.run_cases(0, 1)
        before = self.summary()
        with mock.patch.dict(os.environ, FAIL_AT="1.2"):
            passed, _ = self.run_cases(0, 1, user={"V": "2.0"})
        self.assertFalse(passed)
        self.assertEqual(list(self.summary()), [("one", "peak")])
        self.assertAlmostEqual(self.summary()["one", "peak"] / before["one", "peak"], 2.0**1.2, delta=1e-3)

    def test_a_failure_of_the_first_case_leaves_those_that_were_not_run(self):
        self.run_cases(0, 1)
        before = self.summary()
        with mock.patch.dict(os.environ, FAIL_AT="1.0"):
            self.run_cases(0, 1)
        self.assertEqual(self.summary(), {("other", "peak"): before["other", "peak"]})
        self.assertTrue((self.out / "other.png").exists())

    def test_further_files_are_kept_by_case_and_old_ones_are_not(self):
        (self.out / "one").mkdir()
        (self.out / "one/stale.vtu").touch()
        self.run_cases(0, 1)
        self.assertEqual(sorted(path.name for path in (self.out / "one").iterdir()), ["plate.yaml", "state.csv"])
        self.assertFalse((self.out / "other").exists())


if __name__ == "__main__":
    unittest.main()

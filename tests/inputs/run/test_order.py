# SPDX-License-Identifier: GPL-2.0-or-later
"""A case that starts from what another one leaves, numbers of ranks, cases on request, rows that compare cases."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from study.run import cli, solver
from study.run.batch import Batch
from study.run.case import Case, Comparison, Study
from study.run.solver import Run, Solver, run_all
from study.run.summary import Row

SOLVER = """#!/bin/sh
# a stand-in: the first run leaves a restart file, the others say what they found
printf 't,F\\n0,1\\n1,2\\n' > contact_force.csv
case "$*" in *in.first*) sleep 0.5 && echo ready > bed.restart && touch grains.data ;; esac
[ -e grains.data ] || { echo 'ERROR: no grains.data'; exit 1; }
"""


def rows(result):
    return [Row(result.case, "found", float((result.folder / "bed.restart").read_text() == "ready\n"), "1", 1.0, 0.0)]


def total(results):
    return [Row("both", "force", sum(results[name].force["F"][-1] for name in ("second", "third")), "N", 4.0, 0.0)]


CASES = [
    Case("second", "in.next", rows, after="first"),
    Case("first", "in.first", lambda result: [], leaves=("*.restart", "grains.*")),
    Case("third", "in.next", rows, after="first", ranks=1),
]
STUDY = Study(CASES, [], [Comparison(["second", "third"], total), Comparison(["second", "other"], total)])


class Order(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "deck"
        self.folder.mkdir()
        for deck in ("in.first", "in.next"):
            (self.folder / deck).write_text("variable V index 1\n")
        self.solver = Path(scratch.name) / "solver"

    def run_batch(self, script: str, keep_going: bool = False) -> tuple[bool, Batch, str]:
        self.solver.write_text(script)
        self.solver.chmod(0o755)
        batch, out = Batch(self.folder, STUDY, CASES, {}), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            good = batch.run(Solver(self.solver), 3, keep_going, self.folder.parent / "out")
        return good, batch, out.getvalue()

    def test_a_case_waits_for_the_one_it_starts_from(self):
        good, batch, printed = self.run_batch(SOLVER)
        self.assertTrue(good, printed)
        self.assertEqual(set(batch.results), {"first", "second", "third"})
        self.assertRegex(printed, r"both +force +4 ")

    def test_without_its_file_the_solver_says_what_is_missing(self):
        good, batch, printed = self.run_batch(SOLVER.replace("sleep 0.5", "false"), keep_going=True)
        self.assertFalse(good)
        self.assertEqual([batch.rows[case.name][0].quantity for case in CASES], ["completed"] * 3)

    def test_a_chosen_case_brings_along_where_it_starts(self):
        self.assertEqual([case.name for case in cli.chosen(CASES, ["third"])], ["first", "third"])
        self.assertEqual([case.name for case in cli.chosen(CASES, ["first"])], ["first"])

    def test_number_of_ranks_of_a_case(self):
        runs = Batch(self.folder, STUDY, CASES, {}).runs(Path("scratch"))
        self.assertEqual([run.ranks for run, _ in runs], [None, None, 1])
        self.assertIs(runs[0][0].after, runs[1][0])
        self.assertIsNone(runs[1][0].after)

    def test_cases_on_request(self):
        cases = [Case("usual", "in.first", rows), Case("usual_fine", "in.first", rows, on_request=True)]
        names = lambda *wanted: [case.name for case in cli.chosen(cases, wanted)]  # noqa: E731
        self.assertEqual(names(), ["usual"])
        self.assertEqual(names("usual_fine"), ["usual_fine"])
        self.assertEqual(names("usual*"), ["usual", "usual_fine"])

    def together(self, ranks: dict, jobs: int | None) -> set:
        """Sets of runs that were seen running side by side, on two cores; the solver has two ranks by itself."""
        scratch = Path(tempfile.mkdtemp(dir=self.folder.parent))
        runs = [Run(name, self.folder, "in.first", {}, scratch / name, ranks=n) for name, n in ranks.items()]
        seen = set()
        watch = lambda done, running: seen.add("".join(run.name for run in running))  # noqa: E731
        with (
            mock.patch.object(solver, "cores", lambda: 2),
            mock.patch.object(Solver, "command", lambda *_: ["sleep", "0.25"]),
        ):
            ended = [run.name for run in run_all(runs, Solver(self.solver, 2), jobs, watch)]
        self.assertEqual(sorted(ended), sorted(ranks))
        return {names for names in seen if len(names) > 1}

    def test_ranks_of_runs_side_by_side(self):
        self.assertEqual(self.together({"a": None, "b": None}, None), set())
        self.assertEqual(self.together({"a": 4, "b": 1, "c": 1}, None), {"bc"})
        self.assertEqual(self.together({"a": None, "b": 1}, 2), {"ab"})
        self.assertEqual(self.together({"a": 1, "b": 1}, 1), set())


if __name__ == "__main__":
    unittest.main()

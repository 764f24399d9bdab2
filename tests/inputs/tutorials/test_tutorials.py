# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks of inputs/tutorials, shortly: what passes a wall or is lost is seen, and both walls have one answer."""

import os
import shutil
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

INPUTS = Path(__file__).resolve().parents[3] / "inputs"
sys.path.insert(0, str(INPUTS / "tutorials"))
import benchmarks  # noqa: E402  (a file of that folder)
import runs  # noqa: E402
from kinds import CUBE, KINDS, Total, late  # noqa: E402
from runs import Outcome  # noqa: E402
from shapes import sides  # noqa: E402

KIND = {kind.name: kind for kind in KINDS}
PROGRAM = {"stock": Path(os.environ["LIGGGHTS"]), "nurbs": Path(os.environ["LIGGGHTS_NURBS"])}
TOTALS = [Total("height", "m", "z", late)]


def outcome(height: float, lost: int = 0, passed: int = 0, seconds: float = 1.0) -> Outcome:
    return Outcome(seconds, {"height": height}, lost, passed)


class Decks(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def run_deck(self, kind, wall: str, **variables: str) -> Outcome:
        return runs.run(PROGRAM[wall], kind, wall, benchmarks.SEEDS[0], 1, self.folder / wall, **variables)

    def test_both_walls_wear_alike_before_chaos(self):
        stock, ours = (self.run_deck(KIND["chute_wear"], wall, steps="4000") for wall in ("stock", "nurbs"))
        self.assertGreater(stock.totals["worn_volume"], 0.0)
        for name, value in stock.totals.items():
            self.assertAlmostEqual(ours.totals[name] / value, 1.0, delta=1e-3, msg=name)
        self.assertEqual((ours.lost, ours.passed), (0, 0))

    def test_particles_that_fall_through_a_box_without_floor_are_seen(self):
        whole, leaky = KIND["packing"], replace(KIND["packing"], walls={"box.stl": sides(*CUBE, (0.0, 0.1))})
        found = self.run_deck(whole, "nurbs", steps="1600")
        self.assertEqual((found.lost, found.passed), (0, 0))
        shutil.rmtree(self.folder / "nurbs")
        self.assertGreater(self.run_deck(leaky, "nurbs", steps="1600").passed, 0)

    def test_a_run_that_ends_with_an_error_is_a_row_with_its_words(self):
        (row,) = benchmarks.run(replace(KIND["servo"], variables={"model": "hertzz"}), PROGRAM["nurbs"])
        self.assertIs(row.passes, False)
        self.assertIn("ERROR", row.note)


class Rows(unittest.TestCase):
    def verdicts(self, ours: list[Outcome]) -> dict[str, bool | None]:
        theirs = [outcome(0.1 + 0.01 * i) for i in range(5)]
        return {row.quantity: row.passes for row in benchmarks.compared("kind", TOTALS, list(zip(theirs, ours)))}

    def test_the_mean_of_our_runs_counts(self):
        self.assertIs(self.verdicts([outcome(h) for h in (0.09, 0.2, 0.12, 0.13, 0.14)])["height"], True)
        self.assertIs(self.verdicts([outcome(0.1401)] * 5)["height"], False)
        self.assertIs(self.verdicts([outcome(0.0999)] * 5)["height"], False)

    def test_one_particle_lost_or_passed_fails(self):
        good = [outcome(0.12)] * 4
        self.assertIs(self.verdicts([*good, outcome(0.12)])["lost_or_passed"], True)
        self.assertIs(self.verdicts([*good, outcome(0.12, lost=1)])["lost_or_passed"], False)
        self.assertIs(self.verdicts([outcome(0.12, passed=1), *good])["lost_or_passed"], False)

    def test_the_least_times_make_the_ratio(self):
        row = benchmarks.time_row("kind", [(outcome(0, seconds=s), outcome(0, seconds=t)) for s, t in ((4, 4), (2, 9), (3, 3))])
        self.assertEqual((row.value, row.passes), (1.5, None))
        self.assertIn("above 1.03", row.note)

    def test_runs_outside_of_the_others(self):
        runs_of_five = [outcome(h) for h in (1.0, 2.0, 3.0, 4.0, 5.0)]
        self.assertEqual(benchmarks.outside(TOTALS, runs_of_five, runs_of_five), 0.4)
        self.assertEqual(benchmarks.outside(TOTALS, runs_of_five, [outcome(3.0)] * 5), 0.0)


if __name__ == "__main__":
    unittest.main()

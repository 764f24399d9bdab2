# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows and verdicts of large solids, of ranks and of the deck ball_plate."""

import unittest

import ball_plate
import large_report
import ranks


def by_name(rows):
    return {row.quantity: row for row in rows}


class LargeSolids(unittest.TestCase):
    SEEN = {"method": "auto", "body": "distorted", "elements": 1_000_000, "dofs": 3_000_000}
    SEEN |= {"solid_bytes": 6e8, "solver_bytes": 3e8, "peak_bytes": 1e9}
    SEEN |= {"set_up": 4.0, "stable_step": 7.0, "force": 0.3, "step": 0.33}

    def test_per_dof_and_per_element(self):
        rows = by_name(large_report.rows(self.SEEN))
        self.assertAlmostEqual(rows["solid_bytes_per_dof"].value, 200.0)
        self.assertAlmostEqual(rows["set_up_per_element"].value, 4.0)
        self.assertAlmostEqual(rows["force_time_per_dof"].value, 100.0)
        self.assertAlmostEqual(rows["step_over_force"].value, 1.1)

    def test_verdicts_of_a_million_elements(self):
        rows = by_name(large_report.rows(self.SEEN))
        verdicts = {name: row.passes for name, row in rows.items() if row.passes is not None}
        expected = dict(solid_memory=True, set_up=True, set_up_with_stable_step=False, step_over_force=True)
        self.assertEqual(verdicts, expected)

    def test_fewer_elements_and_the_plain_loop_have_none(self):
        for changed in ({"elements": 8000}, {"method": "plain"}):
            rows = by_name(large_report.rows({**self.SEEN, **changed, "stable_step": None}))
            self.assertEqual([row.passes for row in rows.values()], [None] * len(rows))


class Ranks(unittest.TestCase):
    def counted(self, cpu, inside, messages):
        return dict(cpu=cpu, inside_mpi=inside, messages=messages, collectives=0, bytes=0, peak_bytes=cpu * 1e6)

    def test_a_step_is_the_difference_of_two_runs_on_the_busiest_rank(self):
        few = [self.counted(10.0, 1.0, 5), self.counted(10.0, 1.0, 5)]
        many = [self.counted(13.0, 2.0, 105), self.counted(13.0, 3.5, 305)]
        step = ranks.per_step(few, many)
        self.assertAlmostEqual(step.work, 2.0 / 100)  # 3 s more, of which one inside MPI
        self.assertAlmostEqual(step.messages, 3.0)
        self.assertEqual(step.memory, 13e6)

    def test_speedup_and_memory_of_two(self):
        """Memory is counted from that of a tiny plate, 100 here."""

        def step(work, memory):
            return ranks.Step(work, 0, 0, 0, memory)

        alone, both, tiny = (ranks.Case(*case) for case in (("large", (), 1), ("large", (), 2), ("tiny", (), 1)))
        for two, verdicts in ((step(1.0, 155.0), (True, True)), (step(1.01, 156.0), (False, False))):
            found = by_name(ranks.report({alone: step(1.8, 200.0), both: two, tiny: step(0.0, 100.0)}))
            self.assertEqual(tuple(found[name].passes for name in ("speedup", "memory_over_one")), verdicts)

    def test_elements_of_a_larger_plate_are_as_large(self):
        self.assertIn("size: [0.61, 0.61, 0.0501], elements: [31, 31, 8]", ranks.model(ranks.PLATE, "stored"))
        text = ranks.model((62, 31, 8), "stored")
        self.assertIn("size: [1.22, 0.61, 0.0501], elements: [62, 31, 8]", text)
        self.assertIn("integration: {method: stored}", text)


class BallPlate(unittest.TestCase):
    def test_verdicts(self):
        for auto, verdicts in ((3.0, (True, True)), (3.1, (False, False))):
            rows = by_name(ball_plate.rows({"auto": auto, "plain": 21.0, "corrected_mass": 1.2 * auto}))
            self.assertEqual((rows["auto_time"].passes, rows["speedup_over_plain"].passes), verdicts)

    def test_the_whole_study_is_to_take_a_quarter(self):
        for auto, verdict in ((25.0, True), (25.1, False)):
            rows = by_name(ball_plate.study_rows({"auto": auto, "plain": 100.0}))
            self.assertIs(rows["speedup_over_plain"].passes, verdict)


if __name__ == "__main__":
    unittest.main()

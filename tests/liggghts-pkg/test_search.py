# SPDX-License-Identifier: GPL-2.0-or-later
"""How the fix finds closest points: the default and the paper's method give the same bounce, and every projection of a
run is counted in the line at its end."""

import re
import unittest

import ball_on_block as bob
import decks
import numpy as np

FILES = {"block.yaml": bob.block()}
STEPS = 2300
COLUMNS = (1, 2, 3, 7, 8, 15, 16, 20)
LINE = re.compile(
    r"Fix wall/nurbs \(id plate\): (?P<projections>\d+) projections: (?P<interior>\d+) interior, (?P<edge>\d+) edge, "
    r"(?P<corner>\d+) corner, (?P<not_converged>\d+) not converged; (?P<cold>\d+) cold, (?P<fallbacks>\d+) fallbacks, "
    r"(?P<iterations>[\d.]+) iterations on average"
)


def wall(search: str) -> str:
    return bob.wall(rest=f"structure block.yaml surface top {search}")


def bounce(search: str, x: float = 1.3e-4) -> str:
    """A ball that flies askew onto the block near x and leaves it again."""
    ball = bob.prelude(balls=((x, -2.1e-4, bob.RADIUS + 1e-7),), velocity=(0.2, 0.1, -1.0))
    return ball + wall(search) + bob.output(COLUMNS) + f"run {STEPS}\n"


def counts(text: str) -> list[dict[str, float]]:
    """The counts of every run, in the order printed."""
    return [{name: float(value) for name, value in match.groupdict().items()} for match in LINE.finditer(text)]


class Search(unittest.TestCase):
    def test_both_methods_give_the_same_bounce(self):
        newton, paper = (decks.good(bounce(f"search {word}"), files=FILES) for word in ("newton", "simplex_brent"))
        self.assertGreater(newton.table["fz"].max(), 0.5)
        self.assertEqual(newton.table["fz"][-1], 0.0, "the ball has left")
        force = abs(newton.table["fz"]).max()
        for column, reference in newton.table.items():
            with self.subTest(column=column):
                sideways = column in ("fx", "fy", "plate1", "plate2")  # measured against the whole force
                scale = force if sideways else abs(reference).max()
                self.assertLessEqual(abs(paper.table[column] - reference).max(), 1e-9 * scale)

        for run, search in ((newton, "newton"), (paper, "simplex_brent")):
            with self.subTest(search=search):
                (n,) = counts(run.text)
                print(f"{search}: {n}")
                near = np.count_nonzero(newton.table["fz"])
                self.assertLessEqual(n["projections"], STEPS + 1, "one ball: one a step and one in the set-up")
                self.assertGreaterEqual(n["projections"], near, "and none where the ball cannot have come near")
                self.assertEqual(n["interior"], n["projections"])
                self.assertEqual(n["fallbacks"], 0)
                self.assertGreaterEqual(n["cold"], 1)
                self.assertLess(n["cold"], 0.1 * STEPS)
                self.assertLessEqual(n["iterations"], 5.0, "the paper's figure for warm starts")

    def test_newton_is_the_default(self):
        default, newton = (decks.good(bounce(search), files=FILES) for search in ("", "search newton"))
        self.assertEqual(counts(default.text), counts(newton.text))

    def test_feet_beyond_the_edge_are_searched_in_full_and_counted(self):
        outside = 2.1e-3  # the block ends at 2e-3
        newton, paper = (
            decks.good(bounce(f"search {word}", x=outside), files=FILES) for word in ("newton", "simplex_brent")
        )
        self.assertGreater(newton.table["fz"].max(), 0.1)
        for column, reference in newton.table.items():
            self.assertLessEqual(abs(paper.table[column] - reference).max(), 1e-9 * max(abs(reference).max(), 1e-12))
        for run in (newton, paper):
            (n,) = counts(run.text)
            self.assertEqual(n["edge"], n["projections"])
            self.assertEqual(n["cold"], n["projections"], "eqs. 27-28 of the paper do not describe edges")

    def test_counts_are_of_one_run_and_of_all_ranks(self):
        balls = ((-1e-3, 0.0, bob.RADIUS), (1e-3, 0.0, bob.RADIUS))  # one on each rank
        start = bob.prelude(balls=balls, processors="2 1 1") + wall("") + bob.output() + "run 50\nrun 20\nrun 10 pre no\n"
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                deck = start if ranks == 2 else start.replace("processors 2 1 1", "processors 1 1 1")
                runs = counts(decks.good(deck, files=FILES, ranks=ranks).text)
                self.assertEqual([n["projections"] for n in runs], [2 * 51, 2 * 21, 2 * 10])
                self.assertEqual([n["interior"] for n in runs], [2 * 51, 2 * 21, 2 * 10])

    def test_the_line_is_in_the_log_file_when_the_screen_is_off(self):
        silent = ["sh", "-c", '"$@" -screen none && cat search.log', "sh"]
        run = decks.run("log search.log\n" + bounce("") + "log none\n", files=FILES, launcher=silent)
        self.assertEqual(run.code, 0, run.text)
        self.assertEqual(len(counts(run.text)), 1)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""How far a run is, read from what LIGGGHTS has printed so far; and what the user is told of it."""

import contextlib
import io
import unittest
from types import SimpleNamespace

from study.run.progress import Progress, Reached, reached

LOG = """Setting up run at Sat Nov 21 11:34:29 2026
    Step    Atoms         lowest
       0     3488 -3.6548329e-07
Loop time of 4.53e-07 on 1 procs for 0 steps with 3488 atoms
    Step           Time            CPU        CPULeft         KinEng
       0              0              0              0     0.95197681
WARNING: these are five words
     100          1e-05           0.5           49.5     0.95197681
"""


class FromTheLog(unittest.TestCase):
    def test_the_last_line_counts(self):
        self.assertEqual(reached(LOG), Reached(time=1e-5, elapsed=0.5, left=49.5))
        self.assertAlmostEqual(reached(LOG).percent, 1.0)
        more = LOG + "    5000   0.0005   30   20   0.7\n"
        self.assertEqual(str(reached(more)), "60 %, t = 0.0005 s, 20 s left")

    def test_a_half_written_line_does_not_count(self):
        self.assertEqual(reached(LOG + "    5000   0.0005   30   2").elapsed, 0.5)
        self.assertEqual(reached(LOG + "    5000   0.0005   30   20   0."), reached(LOG))

    def test_before_the_first_step(self):
        self.assertIsNone(reached(""))
        self.assertIsNone(reached(LOG[: LOG.index("    Step           Time")]))
        self.assertEqual(reached(LOG[: LOG.index("WARNING")]).percent, 0.0)

    def test_a_later_run_without_the_columns(self):
        self.assertEqual(reached(LOG + "    Step KinEng\n 7 1.0\n"), reached(LOG))


class ForTheUser(unittest.TestCase):
    def told(self, percents, total=100.0):
        """What is written outside a terminal while a run of `total` seconds goes on."""
        with contextlib.redirect_stderr(io.StringIO()) as err:
            progress = Progress(2)
            for percent in percents:
                line = f"1 1e-4 {percent * total / 100} {(100 - percent) * total / 100}\n"
                log = "Step Time CPU CPULeft\n" + line
                progress.watch(0, [SimpleNamespace(name="long", log=lambda log=log: log)])
        return err.getvalue().splitlines()

    def test_one_line_for_each_tenth(self):
        lines = self.told(range(0, 101))
        self.assertEqual(len(lines), 9)
        self.assertEqual(lines[0], "long: 10 %, t = 0.0001 s, 90 s left")
        self.assertEqual(lines[-1], "long: 90 %, t = 0.0001 s, 10 s left")

    def test_nothing_twice_and_nothing_of_short_runs(self):
        self.assertEqual(len(self.told([35, 36, 39, 34, 41])), 2)
        self.assertEqual(self.told(range(0, 101), total=5.0), [])

    def test_one_changing_line_on_a_terminal(self):
        progress, stream = Progress(2), io.StringIO()
        progress.terminal, progress.stream = True, stream
        progress.watch(1, [SimpleNamespace(name="long", log=lambda: LOG)])
        self.assertRegex(stream.getvalue(), r"^\r\x1b\[K1/2 runs, 0 s: long 1 %, t = 1e-05 s, 50 s left$")


if __name__ == "__main__":
    unittest.main()

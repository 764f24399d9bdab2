# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/run as a user meets it, with a stand-in for the solver."""

import contextlib
import errno
import io
import json
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

from study.run import cli

HERE = Path(__file__).resolve().parent
RUN = HERE.parents[2] / "inputs/run"
SOLVER = HERE / "closed_form_solver.py"


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="out with a space ")
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name)

    def words(self, *words):
        return [*words, "--solver", str(SOLVER), "--out", str(self.out)]

    def run_study(self, *words, **environment):
        """What inputs/run does once python has started."""
        out, err = io.StringIO(), io.StringIO()
        with (
            mock.patch.dict(os.environ, environment),
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(err),
        ):
            try:
                code = cli.main(self.words(*words))
            except SystemExit as end:
                code = end.code
        return SimpleNamespace(returncode=code, stdout=out.getvalue(), stderr=err.getvalue())

    def rows(self):
        rows = json.loads((self.out / "summary.json").read_text())["rows"]
        return {(row["case"], row["quantity"]): row for row in rows}

    def left_behind(self):
        return sorted(path.name for path in self.out.iterdir())

    def test_one_case(self):
        done = self.run_study("ball_plate", "--case", "linear_lambda_0.055085")
        self.assertEqual((done.returncode, done.stdout.count("ok")), (0, 4), done.stderr)
        self.assertIn("= 0.055085 mm^(1/2)", done.stdout)
        self.assertIn("1/1 linear_lambda_0.055085", done.stderr)
        case = "linear_lambda_0.055085"
        self.assertEqual(
            self.left_behind(), [f"contact_force_{case}.csv", f"log_{case}.txt", "summary.json"]
        )
        header, first = (self.out / f"contact_force_{case}.csv").read_text().splitlines()[:2]
        self.assertEqual(header, "t,F,overlap,plate_displacement")
        self.assertAlmostEqual(float(first.split(",")[0]), 1e-8, delta=1e-20)
        self.assertAlmostEqual(self.rows()[case, "lambda"]["value"], 1.741941e-3, delta=1e-8)
        self.assertAlmostEqual(self.rows()[case, "peak_force"]["reference"], 6.6866, delta=1e-4)

    def test_figures_of_which_all_cases_were_run(self):
        words = ["--case", "hertz_lambda_*", "--case", "hertz_nu_0.[!4]*"]
        done = self.run_study("ball_plate", *words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        pictures = [name for name in self.left_behind() if name.endswith(".png")]
        self.assertEqual(pictures, ["fig06.png"])
        picture = (self.out / "fig06.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreater(len(picture), 20000)

    def test_cases_with_the_same_values_share_a_run(self):
        same = ["hertz_lambda_1.0", "hertz_E_74.6GPa", "hertz_nu_0.2285"]
        words = [word for name in same for word in ("--case", name)]
        done = self.run_study("ball_plate", *words)
        self.assertIn("1/1 hertz_lambda_1.0", done.stderr)
        force = [(self.out / f"contact_force_{name}.csv").read_bytes() for name in same]
        self.assertEqual(force[0], force[1])
        self.assertEqual(force[0], force[2])
        self.assertEqual(len(self.rows()), 3 * 6)

    def test_references_follow_the_values(self):
        done = self.run_study("ball_plate", "--case", "hertz_lambda_0.6", "-var", "V", "2.0")
        self.assertEqual(done.returncode, 0, done.stdout)
        # Hertz: peak as V^(6/5), duration as V^(-1/5).
        peak = self.rows()["hertz_lambda_0.6", "peak_force"]["reference"]
        duration = self.rows()["hertz_lambda_0.6", "duration"]["reference"]
        self.assertAlmostEqual(peak / (5.450859 * 2.0**1.2), 1.0, delta=1e-6)
        self.assertAlmostEqual(duration / (7.011585e-6 * 2.0**-0.2), 1.0, delta=1e-6)

    def test_published_numbers_hold_only_as_published(self):
        as_it_is = self.run_study("ball_plate", "--case", "table2")
        self.assertEqual(as_it_is.returncode, 1)  # the stand-in's plate does not move
        self.assertEqual(self.rows()["table2", "plate_displacement_at_end"]["reference"], 7.63e-10)
        changed = self.run_study("ball_plate", "--case", "table2", "-var", "V", "2")
        self.assertEqual(changed.returncode, 0)
        for row in self.rows().values():
            self.assertEqual((row["reference"], row["pass"]), (None, None))

    def test_failing_run(self):
        words = ["--case", "hertz_lambda_*", "--jobs", "1"]
        done = self.run_study("ball_plate", *words, FAIL_AT="0.8")
        self.assertEqual(done.returncode, 1)
        self.assertIn("hertz_lambda_0.8: ERROR: Fix wall/nurbs (id plate): given", done.stderr)
        self.assertNotIn("hertz_lambda_1.2", done.stderr)
        self.assertIn("ERROR", (self.out / "log_hertz_lambda_0.8.txt").read_text())
        self.assertEqual({case for case, _ in self.rows()}, {"hertz_lambda_0.6"})  # the one that ended before

    def test_failing_run_keep_going(self):
        words = ["--case", "hertz_lambda_*", "--keep-going"]
        done = self.run_study("ball_plate", *words, FAIL_AT="0.8")
        self.assertEqual(done.returncode, 1)
        self.assertIs(self.rows()["hertz_lambda_0.8", "completed"]["pass"], False)
        self.assertIs(self.rows()["hertz_lambda_1.2", "peak_force"]["pass"], True)

    def test_run_too_short(self):
        done = self.run_study("ball_plate", "--case", "table2", "-var", "steps", "300")
        self.assertEqual(done.returncode, 1)
        self.assertIn("table2: no complete contact within the run; -var steps N", done.stderr)

    def test_an_old_summary_does_not_survive_a_failure(self):
        self.run_study("ball_plate", "--case", "hertz_lambda_0.8")
        self.assertIn("summary.json", self.left_behind())
        self.run_study("ball_plate", "--case", "hertz_lambda_0.8", FAIL_AT="0.8")
        self.assertNotIn("summary.json", self.left_behind())

    def test_interrupt(self):
        self.interrupt()
        self.assertEqual(self.left_behind(), [])

    def test_interrupt_leaves_what_was_there(self):
        self.run_study("ball_plate", "--case", "table2")
        before = {name: (self.out / name).read_bytes() for name in self.left_behind()}
        self.assertIn("summary.json", before)
        self.interrupt()
        self.assertEqual({name: (self.out / name).read_bytes() for name in self.left_behind()}, before)

    def interrupt(self):
        """Ctrl-C while a run is under way."""
        process = subprocess.Popen(
            [RUN, *self.words("ball_plate", "--case", "table2")],
            cwd="/",
            env={**os.environ, "HANG": "1"},
            stderr=subprocess.PIPE,
            text=True,
        )
        deadline = time.monotonic() + 20.0
        while not list(self.out.glob(".run-*/table2/state.csv")) and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, complaint = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130)
        self.assertIn("interrupted", complaint)

    def test_wrong_words(self):
        table = [
            (["bal_plate"], "no deck 'bal_plate'; did you mean 'ball_plate'?.*thin_plate"),
            (["ball_plate", "--case", "tabel2"], "'tabel2'; did you mean 'table2'?.*nu_0.3"),
            (["ball_plate", "-var", "lamda", "1"], "'lamda'; did you mean 'lambda'?.*nu_ball"),
            (["ball_plate", "-var", "law", "cubic"], "no law 'cubic'.*linear, hertz, quadratic"),
            (["ball_plate", "-var", "V", "-1"], "no contact with V = -1"),
            (["ball_plate", "--case", "table2", "-var", "offset", "1"], "no variable 'offset'"),
            (["ball_plate", "--ranks", "0"], "'0' is not a whole number >= 1"),
            (["ball_plate", "--rank", "2"], "unrecognized arguments"),
            ([], "which deck"),
        ]
        for words, expected in table:
            with self.subTest(words=words):
                done = self.run_study(*words)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr, expected)
                self.assertNotIn("Traceback", done.stderr)
                self.assertEqual(self.left_behind(), [])

    def test_results_that_cannot_be_written(self):
        file = self.out / "file"
        file.touch()
        self.out = file / "out"  # no folder can be made here, not even by root
        done = self.run_study("ball_plate", "--case", "hertz_lambda_0.8")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^inputs/run: .*file/out: Not a directory; .* --out DIR\n$")

    def test_a_full_disk(self):
        full = OSError(errno.ENOSPC, "No space left on device", str(self.out / "summary.json"))
        with mock.patch("study.run.batch.write_json", side_effect=full):
            done = self.run_study("ball_plate", "--case", "hertz_lambda_0.8")
        self.assertEqual(done.returncode, 2)
        said = done.stderr.splitlines()[-1]
        self.assertRegex(said, "^inputs/run: .*summary.json: No space left on device; free some space, or .* --out DIR$")
        self.assertNotIn("Traceback", done.stderr)

    def test_a_full_disk_where_decks_are_copied_to(self):
        full = OSError(errno.ENOSPC, "No space left on device", "in.ball_plate", None, "here")
        for copy in ("copytree", "copyfile"):  # of which copytree makes a list
            with self.subTest(copy=copy), mock.patch(f"shutil.{copy}", side_effect=full):
                done = self.run_study("ball_plate", "--case", "hertz_lambda_0.8")
                self.assertEqual(done.returncode, 2)
                self.assertRegex(done.stderr, "^inputs/run: .*No space left on device.*; free some space, or .* --out DIR\n$")
                self.assertEqual(self.left_behind(), [])

    def test_a_run_that_cannot_start(self):
        done = self.run_study("ball_plate", "--case", "hertz_lambda_0.8", PATH="/nonexistent")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "^inputs/run: (stdbuf|mpirun): No such file or directory\n$")

    def test_no_executable(self):
        command = [RUN, "thin_plate", "--solver", "/no/such"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--solver /no/such", done.stderr)

    def test_list(self):
        done = self.run_study("--list")
        self.assertEqual(done.returncode, 0)
        decks = [line.split()[0] for line in done.stdout.splitlines()]
        self.assertLessEqual({"ball_plate", "thin_plate"}, set(decks))
        cases = self.run_study("ball_plate", "--list").stdout.split()
        self.assertEqual(len(cases), 29)
        self.assertIn("quadratic_lambda_15.7585", cases)


if __name__ == "__main__":
    unittest.main()

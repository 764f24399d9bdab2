# SPDX-License-Identifier: GPL-2.0-or-later
"""Histories that a model file's `output` asks for, in decks: those of iga-solve for a solid without particles, closed forms,
the columns of the fix with particles; over several runs, ranks, restarts and a killed run."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
import histories

IGA_SOLVE = os.environ.get("IGA_SOLVE", "iga-solve")
STEP = 2.0**-27  # [s], so that times are exact sums
EVERY = 8


def model(every: float = EVERY * STEP, loads: str = "", probes: str = "", **settings) -> str:
    text = bob.block(**settings) + f"output: {{every: {every!r}, file: block}}\n"
    return text.replace("probes: {", "probes: {" + probes) + (f"loads: {loads}\n" if loads else "")


def deck(after: str, **settings) -> str:
    return bob.prelude(timestep=STEP, **settings) + bob.wall() + bob.output((11, 15, 16, 18, 19, 20)) + after


FAR = dict(balls=((0.0, 0.0, 5e-3),), velocity=(0.0, 0.0, 0.0))  # a ball that meets nothing
HIT = dict(balls=((0.0, 0.0, 1e-3 + 4e-8),))


class Histories(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def start(self, command: list[str]) -> subprocess.Popen:
        pipes = dict(stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        return subprocess.Popen(command, cwd=self.folder, env=decks.mpi_environment(), **pipes)

    def liggghts(self, text: str, ranks: int = 1) -> str:
        """Runs a deck in the test's folder; what it printed."""
        (self.folder / "in.deck").write_text(text)
        launcher = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        process = self.start([*launcher, decks.NURBS, "-in", "in.deck", "-log", decks.LOG])
        printed, _ = process.communicate(timeout=120)
        self.code = process.returncode
        return printed

    def good(self, text: str, ranks: int = 1) -> dict[str, np.ndarray]:
        """Runs a deck that must succeed; its thermo columns, one after the other."""
        printed = self.liggghts(text, ranks)
        self.assertEqual(self.code, 0, printed[-2000:])
        tables = decks.thermo_tables((self.folder / decks.LOG).read_text(errors="replace"))
        return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}

    def write(self, text: str):
        (self.folder / "block.yaml").write_text(text)

    def history(self, name: str = "block.h5") -> dict[str, np.ndarray]:
        return histories.read(self.folder / name)

    def assert_same(self, seen: dict[str, np.ndarray], expected: dict[str, np.ndarray]):
        """But for the ledger, which begins anew with each run."""
        self.assertEqual(seen.keys(), expected.keys())
        for name, values in expected.items():
            if not name.startswith("ledger/"):
                np.testing.assert_array_equal(seen[name], values, err_msg=name)

    def test_without_particles_they_are_those_of_iga_solve(self):
        loads = "{gravity: [10, 0, -9.81], tractions: [{face: zeta+, value: [0, 2e3, -1e4]}]}"
        steps = 400
        self.write(model(loads=loads, probes="corner: {face: xi-, at: [0.1, 0.9]}, "))
        self.good(deck(f"run {steps // 2}\nrun {steps // 2}\n", **FAR))
        shutil.move(self.folder / "block.h5", self.folder / "deck.h5")
        process = self.start([IGA_SOLVE, "block.yaml", "--end", repr(steps * STEP), "--step", repr(STEP), "--quiet"])
        printed, _ = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, printed)
        expected = self.history()
        self.assertEqual(len(expected["time"]), steps // EVERY + 1)
        self.assertGreater(np.abs(expected["probes/corner"]).max(), 0.0)
        self.assert_same(self.history("deck.h5"), expected)

    def test_a_free_block_falls_as_it_should(self):
        g, mass = 9.81, 1000.0 * 4e-3 * 4e-3 * 2e-3
        self.write(model(loads=f"{{gravity: [0, 0, {-g}]}}", fixed=()))
        self.good(deck("run 160\n", **FAR))
        seen = self.history()
        t = seen["time"]
        np.testing.assert_allclose(t, EVERY * STEP * np.arange(21), rtol=1e-14)
        for name, expected in (
            ("probes/top_centre", -0.5 * g * t**2), ("linear_momentum", -mass * g * t),
            ("kinetic_energy", 0.5 * mass * (g * t) ** 2), ("load_work", 0.5 * mass * (g * t) ** 2),
        ):
            values = seen[name] if seen[name].ndim == 1 else seen[name][:, 2]
            np.testing.assert_allclose(values, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max(), err_msg=name)

    def test_under_a_ball_they_are_the_columns_of_the_fix(self):
        self.write(model())
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                table = self.good(deck("run 800\n", **HIT), ranks)
                seen = self.history()
                rows = slice(0, None, EVERY)
                self.assertGreater(table["fz"].max(), 0.5)
                self.assertEqual(len(seen["time"]), 101)
                for name, column in (("kinetic_energy", 15), ("strain_energy", 16)):
                    np.testing.assert_array_equal(seen[name], table[f"plate{column}"][rows], err_msg=name)
                for d in range(3):
                    np.testing.assert_array_equal(seen["probes/top_centre"][:, d], table[f"plate{18 + d}"][rows])
                np.testing.assert_array_equal(seen["linear_momentum"][:, 2], table["plate11"][rows])

    def restarted(self, name: str = "plate") -> str:
        rest = (bob.wall() + bob.output((15,))).replace("fix plate", f"fix {name}").replace("f_plate", f"f_{name}")
        return bob.prelude(restart="state", timestep=STEP, **HIT) + rest

    def test_a_restart_goes_on_with_the_file(self):
        self.write(model())
        start = deck("run 260\nwrite_restart state\nrun 300\n", **HIT)
        self.good(start)
        whole = self.history()
        self.good(self.restarted() + "run 300\n")
        self.assert_same(self.history(), whole)
        os.remove(self.folder / "block.h5")  # as in another folder
        self.good(self.restarted() + "run 300\n")
        seen = self.history()
        self.assertEqual(seen["time"][0], 260 * STEP)
        np.testing.assert_array_equal(seen["time"][1:], whole["time"][-len(seen["time"]) + 1 :])

    def test_a_restart_leaves_the_file_of_something_else(self):
        self.write(model())
        self.good(deck("run 20\nwrite_restart state\n", **HIT))
        before = (self.folder / "block.h5").read_bytes()
        self.write(model(probes="edge: {face: zeta+, at: [0, 0]}, "))
        for ranks in (1, 2):
            printed = self.liggghts(self.restarted() + "run 10\n", ranks)
            self.assertNotEqual(self.code, 0)
            (error,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
            for pattern in ("id plate", "block.h5", "probes/edge", "move the file away"):
                self.assertRegex(error, pattern)
            self.assertEqual((self.folder / "block.h5").read_bytes(), before)

    def test_two_solids_do_not_share_a_file(self):
        self.write(model())
        (self.folder / "copy.yaml").write_text(model().replace("file: block", "file: ./block"))
        second = bob.wall(rest="structure copy.yaml surface top").replace("fix plate", "fix again")
        for ranks in (1, 2):
            printed = self.liggghts(deck(second + "run 10\n", **FAR), ranks)
            self.assertNotEqual(self.code, 0)
            (error,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
            self.assertRegex(error, r"id again.*copy.yaml:\d+: .*block.h5 is being written by another solid or run.*another name")
        one_after_the_other = bob.prelude(timestep=STEP, **FAR) + bob.wall() + "run 10\nunfix plate\n" + second + "run 10\n"
        for ending in ("", "clear\n" + one_after_the_other):
            self.good(one_after_the_other + ending)

    def test_partitions_do_not_share_a_file(self):
        """LIGGGHTS ends all of its partitions if one fails; each has a log of its own."""
        self.write(model())
        (self.folder / "in.deck").write_text(deck("run 200000\n", **FAR))
        launcher = ["mpirun", "-n", "2", decks.NURBS, "-partition", "2x1"]
        self.start([*launcher, "-in", "in.deck", "-log", "log"]).communicate(timeout=120)
        logs = "".join(log.read_text(errors="replace") for log in self.folder.glob("log.*"))
        self.assertRegex(logs, "block.h5 is being written by another solid or run")

    def test_a_killed_run_keeps_its_rows(self):
        self.write(model())
        (self.folder / "in.deck").write_text(deck("run 100000000\n", **HIT))
        process = self.start([decks.NURBS, "-in", "in.deck", "-log", decks.LOG, "-screen", "none"])
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and self.rows_so_far() < 5:
            time.sleep(0.05)
        os.kill(process.pid, signal.SIGKILL)
        process.communicate()
        seen = self.history()
        np.testing.assert_allclose(np.diff(seen["time"]), EVERY * STEP, rtol=1e-9)
        self.assertGreaterEqual(len(seen["time"]), 5)

    def rows_so_far(self) -> int:
        """In a copy, since HDF5 locks what is being written; the copy may be of two moments."""
        try:
            shutil.copy(self.folder / "block.h5", self.folder / "copy.h5")
            return len(self.history("copy.h5")["time"])
        except (OSError, KeyError):
            return 0

    def test_a_file_that_cannot_be_written_stops_every_rank(self):
        self.write(model().replace("file: block", "file: no/such/folder"))
        for ranks in (1, 2):
            printed = self.liggghts(deck("run 10\n", **FAR), ranks)
            self.assertNotEqual(self.code, 0)
            self.assertEqual(len(re.findall(r"^ERROR.*id plate.*no/such/folder.h5: HDF5 cannot create", printed, re.M)), 1)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""iga-solve killed between any two writes to its histories, or out of disk.  Not for the address sanitizer, which wants to be loaded first."""

import os
import signal
import subprocess
import unittest
from pathlib import Path

import h5py
import numpy
from test_iga_solve import PROGRAM, IgaSolve, changed

STEPS = 4
MODEL = changed(("every: 1e-3", "every: 1e-4"), ("time: {end: 0.1}", f"time: {{end: {STEPS}e-4, step: 1e-4}}"))


def histories(path: Path) -> dict[str, numpy.ndarray]:
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
    return found


class Killed(IgaSolve):
    def run_killed_at(self, write: int) -> bool:
        """Whether the run was killed before it was through."""
        environment = os.environ | {"LD_PRELOAD": os.environ["KILLED_AT_WRITE"], "KILL_AT": str(write)}
        done = subprocess.run([PROGRAM, "block.yaml"], cwd=self.folder, env=environment, capture_output=True, timeout=60, check=False)
        self.assertIn(done.returncode, (0, -signal.SIGKILL), done.stderr)
        return done.returncode != 0

    def test_what_was_recorded_can_be_read(self):
        self.assertEqual(self.run_model(MODEL).returncode, 0)
        file = self.folder / "block.h5"
        whole = histories(file)
        self.assertEqual(len(whole["time"]), STEPS + 1)
        file.unlink()
        rows = []
        while self.run_killed_at(len(rows)):
            if not file.exists():
                rows.append(0)
                continue
            found = histories(file)
            self.assertEqual(found.keys(), whole.keys())
            rows.append(len(found["time"]))
            for name, series in found.items():
                numpy.testing.assert_array_equal(series[: rows[-1]], whole[name][: rows[-1]], name)
            file.unlink()
        self.assertGreater(len(rows), 10 * STEPS, "writes")
        self.assertEqual(set(rows), set(range(STEPS + 2)), "a row more with each record")
        self.assertEqual(rows, sorted(rows))

    def test_an_older_history_stays_until_there_is_another(self):
        self.assertEqual(self.run_model(MODEL).returncode, 0)
        older = (self.folder / "block.h5").read_bytes()
        self.assertTrue(self.run_killed_at(0))
        self.assertEqual((self.folder / "block.h5").read_bytes(), older)


class Full(IgaSolve):
    """HDF5 does not survive a write that fails: it crashed when the program ended, after its trace."""

    def run_until_full(self, size: int) -> None:
        environment = os.environ | {"LD_PRELOAD": os.environ["KILLED_AT_WRITE"], "FULL_AT": str(size)}
        done = subprocess.run(
            [PROGRAM, "block.yaml"], cwd=self.folder, env=environment, capture_output=True, text=True, timeout=60, check=False)
        self.assert_error(done, "block.h5: cannot write here: No space left on device")

    def test_without_a_row_nothing_is_left(self):
        (self.folder / "block.yaml").write_text(MODEL)
        self.run_until_full(20_000)
        self.assertEqual(os.listdir(self.folder), ["block.yaml"])

    def test_what_was_recorded_before_can_be_read(self):
        """At any size, also where new chunks begin."""
        rows = []
        (self.folder / "block.yaml").write_text(changed(("every: 1e-3", "every: 1e-4"), ("end: 0.1", "end: 0.25, step: 1e-4")))
        for size in range(380_000, 640_000, 20_000):
            with self.subTest(size=size):
                self.run_until_full(size)
                found = histories(self.folder / "block.h5")
                rows.append(len(found["time"]))
                self.assertTrue((numpy.diff(found["time"]) > 0).all())
                for name, series in found.items():
                    self.assertGreaterEqual(len(series), rows[-1], name)
        self.assertEqual(rows, sorted(rows))
        self.assertGreater(rows[-1], 2000)


if __name__ == "__main__":
    unittest.main()

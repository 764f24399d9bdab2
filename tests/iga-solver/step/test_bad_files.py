# SPDX-License-Identifier: GPL-2.0-or-later
"""The bad files are bad: OpenCASCADE alone refuses those of which nothing
is left.  (What it takes without a word, or dies of, is for our reader to refuse.)"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import bad_files

MAKE_STEP_PARTS = os.environ["MAKE_STEP_PARTS"]
NOTHING_LEFT = ("cut_half_nested.step", "no_data_box.step", "empty_box.step", "empty_shell_box.step", "missing_parts.step")


class BadFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.good = Path(cls.folder.name)
        subprocess.run([MAKE_STEP_PARTS, cls.good, *bad_files.GOOD], check=True)
        cls.files = {bad.name: bad for bad in bad_files.bad_files(cls.good)}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def looked_at(self, path: Path) -> subprocess.CompletedProcess:
        return subprocess.run([MAKE_STEP_PARTS, "--look", path], capture_output=True, text=True)

    def test_there_are_enough(self):
        self.assertGreaterEqual(len(self.files), 80)
        self.assertLessEqual(bad_files.MENDABLE, set(self.files))

    def test_opencascade_refuses_what_is_empty(self):
        for name in NOTHING_LEFT:
            path = self.good / f"bad_{name}"
            path.write_bytes(self.files[name].content)
            if name == "missing_parts.step":
                for part in self.good.glob("external_*.stp"):
                    part.unlink()
            self.assertEqual(self.looked_at(path).returncode, 1, name)

    def test_what_they_are_made_from_is_good(self):
        run = self.looked_at(self.good / "nested.step")
        self.assertIn("5 solids, 24 faces", run.stdout)
        self.assertNotIn("INVALID", run.stdout)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Every folder is built and every file of tests is used: what CMake's lists forget is not seen to be missing.

usage: TARGETS=build/release/targets.json python3 complete.py
"""

import re
import unittest
from pathlib import Path

from source_tree import ROOT, files

LIST = "CMakeLists.txt"
PROJECTS = ("tests/consumer",)  # with a build of their own


def lists(folder: Path) -> list[Path]:
    """CMake's lists from this folder on, as they take in each other."""
    path = folder / LIST
    below = re.findall(r"^\s*add_subdirectory\((\S+?)\)", path.read_text(), re.MULTILINE)
    return [path] + [found for name in below for found in lists(folder / name)]


class Complete(unittest.TestCase):
    def test_every_folder_with_a_list_is_built(self):
        taken = set(lists(ROOT))
        there = {path for top in ROOT.glob("*/" + LIST) for path in top.parent.rglob(LIST) if top.parent.name != "build"}
        self.assertGreater(len(there), 30)
        left_out = there - taken - {ROOT / name / LIST for name in PROJECTS}
        self.assertEqual({str(path.relative_to(ROOT)) for path in left_out}, set())

    def test_every_file_of_tests_is_in_a_list(self):
        words = set()
        for path in lists(ROOT):
            words |= set(re.findall(r"[\w/]+", re.sub(r"#.*", "", path.read_text())))
        words = {word.rpartition("/")[2] for word in words}
        tests = [path for path in files("tests", ".cpp", ".py") if re.search("^test_|_test$", path.stem)]
        self.assertGreater(len(tests), 200)
        for path in tests:
            names = {path.stem, path.stem.removeprefix("test_")}  # lists may say NAME of test_NAME.py
            self.assertTrue(names & words, f"{path.relative_to(ROOT)} is in no {LIST}")


if __name__ == "__main__":
    unittest.main()

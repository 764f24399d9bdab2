# SPDX-License-Identifier: GPL-2.0-or-later
"""Nothing outgrows a reader: rooms (folders of CMake targets) of the product, files, functions of Python.  Those of C++ are
measured by clang-tidy (readability-function-size in .clang-tidy).

usage: TARGETS=build/release/targets.json python3 sizes.py
"""

import ast
import unittest
from pathlib import Path

from source_tree import ROOT, files, owners, product_files, targets

LARGEST_ROOM = 0.30  # of the product's lines
LONGEST_FILE = 400
LONGEST_FUNCTION = 60


def lines(path: Path) -> int:
    return len(path.read_text().splitlines())


class Sizes(unittest.TestCase):
    def test_no_room_holds_the_house(self):
        rooms = {}
        for path in product_files():
            for room in {targets()[owner].folder for owner in owners(path)}:
                rooms[room] = rooms.get(room, 0) + lines(path)
        house = sum(rooms.values())
        for room, count in rooms.items():
            self.assertLessEqual(count / house, LARGEST_ROOM, room.relative_to(ROOT))

    def test_no_file_is_long(self):
        paths = product_files() + [p for folder in ("inputs", "tests") for p in files(folder, ".h", ".cpp", ".py")]
        self.assertGreater(len(paths), 300)
        for path in paths:
            self.assertLessEqual(lines(path), LONGEST_FILE, path.relative_to(ROOT))

    def test_no_function_of_python_is_long(self):
        for path in (path for folder in ("inputs", "tests") for path in files(folder, ".py")):
            for node in ast.walk(ast.parse(path.read_text())):
                if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                    count = node.end_lineno - node.lineno + 1
                    self.assertLessEqual(count, LONGEST_FUNCTION, f"{path.relative_to(ROOT)}: {node.name}")


if __name__ == "__main__":
    unittest.main()

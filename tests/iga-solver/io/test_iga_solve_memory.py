# SPDX-License-Identifier: GPL-2.0-or-later
"""iga-solve where memory ends.  Not for the address sanitizer, which takes more addresses than the limits here allow."""

import subprocess
import unittest

from test_iga_solve import PROGRAM, IgaSolve, changed


class Memory(IgaSolve):
    """What does not fit is said before it is tried, or where it ends; nothing is killed without a word."""

    def limited(self, text: str, megabytes: int) -> subprocess.CompletedProcess:
        (self.folder / "block.yaml").write_text(text)
        limit = ["bash", "-c", f'ulimit -v {1000 * megabytes}; exec "$0" "$@"', PROGRAM, "block.yaml"]
        return subprocess.run(limit, cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)

    def mesh(self, elements: str) -> str:
        return changed(("[4, 4, 2]", elements))

    def test_control_points(self):
        self.assert_error(
            self.run_model(self.mesh("[100000, 100000, 100]")),
            r"block.yaml:3: elements \[100000, 100000, 100\]: 1.02e\+12 control points would take 24.5 TB of memory, this "
            r"process may have [0-9.]+ [MGT]B")

    def test_breaks(self):
        def breaks(count: int) -> str:
            return changed(("elements: [4, 4, 2]", f"breaks: {3 * [[i / (count - 1) for i in range(count)]]}"))

        self.assert_error(
            self.limited(breaks(1000), 2000),
            r"block.yaml:3: breaks: elements \[999, 999, 999\]: 1e\+09 control points would take 24.* GB of memory, this process may")
        # the control points alone would fit
        self.assert_error(self.limited(breaks(228), 300), "block.yaml:3: breaks: no memory for a box of so many elements")

    def test_solid(self):
        # 402 x 402 x 22 control points of 230 bytes
        self.assert_error(
            self.limited(self.mesh("[400, 400, 20]"), 700),
            "block.yaml:[23]: geometry: a solid of 3200000 elements of degrees 2, 2, 2 would take 818 MB of memory, this process "
            "may have 717 MB")
        # 27 points with 3 x 28 derivatives of 8 bytes and a weight: 18.4 kB per quadratic element in the plain loop
        self.assert_error(
            self.limited(self.mesh("[100, 100, 20]") + "integration: {method: elements}\n", 2000),
            "block.yaml:[23]: geometry: a solid of 200000 elements of degrees 2, 2, 2 would take 3.72 GB of memory, this process "
            "may have 2.05 GB")

    def test_where_it_ends(self):
        # the solid alone would fit, but not with what is needed besides
        self.assert_error(self.limited(self.mesh("[300, 300, 20]"), 480), "block.yaml: out of memory: .*492 MB")


if __name__ == "__main__":
    unittest.main()

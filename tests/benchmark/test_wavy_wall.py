# SPDX-License-Identifier: GPL-2.0-or-later
"""The benchmark of the wavy wall: its spheres, and what it reads from LIGGGHTS' timers, dumps and the system."""

import re
import unittest

import numpy as np
from scipy.spatial.distance import pdist

import wall_runs
import wavy_bench
import wavy_memory
import wavy_wall
from study.build.waves import K, SIDE

LOG = """
Loop time of 9.0 on 1 procs for 100 steps with 3481 atoms
Fix wall wall/gran time (%) = 7 (70)
Loop time of 2.5 on 1 procs for 400 steps with 3481 atoms
Pair  time (%) = 0.3 (10)
Fix m1 property/global time (%) = 1e-06 (2e-05)
Fix mesh mesh/surface time (%) = 0.25 (10)
Fix wall wall/gran time (%) = 1.5 (60)
Fix wall_neighlist_mesh neighlist/mesh time (%) = 0.125 (5)
Fix contacthistory contacthistory time (%) = 0.0011 (0.03)
"""


class Spheres(unittest.TestCase):
    def test_above_the_wall_and_apart(self):
        layers = wavy_bench.LAYERS[3500]
        rows = wavy_bench.spheres(layers).split("Atoms\n\n")[1].splitlines()
        self.assertEqual(len(rows), layers.count)
        _, _, diameter, _, x, y, z = np.array([row.split() for row in rows], dtype=float).T
        gap = z - 2e-3 * np.sin(K * x) * np.sin(K * y)
        self.assertGreaterEqual(gap.min(), 0.9e-3 - 1e-15)
        self.assertTrue(np.all((diameter >= 0.8e-3) & (diameter <= 1.2e-3)))
        middle = np.argsort(np.hypot(x - SIDE / 2, y - SIDE / 2))[:1000]  # far from the periodic faces
        centres, radii = np.stack([x, y, z], axis=1)[middle], diameter[middle] / 2
        first, second = np.triu_indices(len(middle), 1)
        self.assertGreaterEqual((pdist(centres) - radii[first] - radii[second]).min(), 0.0)

    def test_grid_is_the_same_in_a_wider_box(self):
        narrow, wide = (wavy_bench.spheres(wavy_bench.LAYERS[3500], around) for around in (0.0, 0.031))
        self.assertEqual(narrow.split("Atoms")[1], wide.split("Atoms")[1])
        self.assertIn("-0.031 0.093 ylo yhi", wide)


class Timers(unittest.TestCase):
    def test_fixes_of_the_wall_in_the_last_run(self):
        wall, loop = wall_runs.fix_times(LOG)
        self.assertEqual(wall, {"mesh": 0.25, "wall": 1.5, "wall_neighlist_mesh": 0.125})
        self.assertEqual(loop, 2.5)

    def test_ratios_pass_up_to_their_reference(self):
        verdicts = [wavy_wall.AtMost("c", "q", value, "1", 0.1).passes for value in (0.02, 0.1, 0.11)]
        self.assertEqual(verdicts, [True, True, False])

    def test_decks_exist(self):
        for wall in wavy_wall.WALLS.values():
            text = (wall_runs.DECKS / f"in.{wall.deck}").read_text(encoding="utf-8")
            self.assertTrue(re.search(r"^fix (wall|\$\{id\}) all wall/", text, re.MULTILINE))
            self.assertIn(wall.settled_on, wavy_wall.WALLS)


class SameRun(unittest.TestCase):
    DUMP = (
        "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
        "ITEM: ATOMS id radius x y z fx fy fz \n2 0.0005 {} 0 0 0 0 {}\n1 0.0004 0 0 0 0 0 0\n"
    )

    def verdicts(self, x: float, force: float) -> list[bool]:
        one, other = self.DUMP.format(0.03, 1e-5), self.DUMP.format(x, force)
        return [row.passes for row in wavy_wall.same_run("c", one, other)]

    def test_positions_and_forces_are_compared(self):
        self.assertEqual(self.verdicts(0.03, 1e-5), [True, True])
        self.assertEqual(self.verdicts(0.03 + 1e-14, 1e-5), [False, True])
        self.assertEqual(self.verdicts(0.03, 1.00001e-5), [True, False])
        _, force = wavy_wall.same_run("c", self.DUMP.format(0, 0.0), self.DUMP.format(0, 1e-5))
        self.assertAlmostEqual(force.value, 1e-5 / (4 / 3 * np.pi * 0.5e-3**3 * 2500 * 9.81), delta=1e-12)


class Memory(unittest.TestCase):
    LOG = "VmHWM:\t   100 kB\nVmRSS:\t    90 kB\nStep\nVmHWM:\t  300 kB\nVmRSS:\t  200 kB\n"

    def test_the_last_sizes_count(self):
        self.assertEqual(wavy_memory.memory(self.LOG), wavy_memory.Memory(200 * 1024, 300 * 1024))

    def test_per_element(self):
        sizes = {10: wavy_memory.Memory(5e5, 6e5), 20: wavy_memory.Memory(8e5, 12e5)}
        self.assertEqual([wavy_memory.per_element(sizes, 10, 20, when) for when in ("now", "peak")], [1000.0, 2000.0])


if __name__ == "__main__":
    unittest.main()

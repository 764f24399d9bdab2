# SPDX-License-Identifier: GPL-2.0-or-later
"""The dumped states of the deck trb, and the energy of their contacts."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.integrate import quad

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "inputs/trb"))
from states import State, read_states  # noqa: E402

E_STAR = 0.5e9


def dump(entries, steps=(0, 10)):
    header = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: x\n"
    return "".join(header.format(step, "ENTRIES", len(rows)) + "".join(rows) for step, rows in zip(steps, entries))


class States(unittest.TestCase):
    def test_energy_of_contacts_is_the_work_of_their_forces(self):
        r = np.array([0.4e-3, 0.6e-3, 0.5e-3])
        x = np.array([[0, 0, 0], [0.97e-3, 0, 0], [0, 5e-3, 0]])  # the first two overlap by 0.03 mm
        state = State(0, x, np.zeros((3, 3)), r, (np.array([2]), np.array([0.02e-3])))
        work = sum(
            quad(lambda d: 4.0 / 3.0 * E_STAR * np.sqrt(radius * d) * d, 0.0, depth, epsabs=0.0, epsrel=1e-12)[0]
            for radius, depth in ((0.24e-3, 0.03e-3), (0.5e-3, 0.02e-3))
        )
        self.assertAlmostEqual(state.contact_energy(E_STAR) / work, 1.0, delta=1e-10)

    def test_spheres_apart_have_none(self):
        state = State(
            0, np.array([[0, 0, 0], [0.95e-3, 0, 0]]), np.zeros((2, 3)), np.array([0.5e-3, 0.4e-3]), ([], np.array([]))
        )
        self.assertEqual(len(state.overlaps()[1]), 0)

    def test_kinetic_energy(self):
        v = np.array([[3.0, 0.0, 4.0]])
        state = State(0, np.zeros((1, 3)), v, np.array([1e-3]), ([], np.array([])))
        self.assertAlmostEqual(state.kinetic_energy(3.0), 0.5 * 4e-9 * np.pi * 25.0, delta=1e-20)

    def test_reads_dumps(self):
        with tempfile.TemporaryDirectory() as folder:
            spheres = ["1 1 2 3 4 5 6 0.5\n", "2 0 0 9 0 0 -1 0.25\n"]
            (Path(folder) / "spheres.dump").write_text(dump([spheres, spheres[::-1]]))
            (Path(folder) / "contacts.dump").write_text(dump([[], ["2 0.125\n", "1 -0.01\n"]]))
            first, second = read_states(Path(folder))
        self.assertEqual((first.step, second.step), (0, 10))
        np.testing.assert_array_equal(first.x, [[1, 2, 3], [0, 0, 9]])
        np.testing.assert_array_equal(first.v[:, 2], [6, -1])
        np.testing.assert_array_equal(second.r, [0.25, 0.5])
        self.assertEqual(len(first.wall[0]), 0)
        np.testing.assert_array_equal(second.wall[0], [1, 0])
        np.testing.assert_array_equal(second.wall[1], [0.125, 0.0])  # apart: within reach, not in contact


if __name__ == "__main__":
    unittest.main()

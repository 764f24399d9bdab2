# SPDX-License-Identifier: GPL-2.0-or-later
"""A run of the deck trb, evaluated: impulse, means of the force, the lowest layer of the packing."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from study.run.case import Result

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "inputs/trb"))
from impact import Impact  # noqa: E402

DT = 1e-7


def impact(test, F, spheres=((0, 0, 1e-3, 0.5e-3),)):
    """A run with these forces [N] and one state of spheres (x, y, z, radius) [m]."""
    scratch = tempfile.TemporaryDirectory()
    test.addCleanup(scratch.cleanup)
    folder = Path(scratch.name)

    def table(name, header, *columns):
        np.savetxt(folder / name, np.transpose(columns), "%.17g", ",", header=header, comments="")

    t = DT * np.arange(1, len(F) + 1)
    table("contact_force.csv", "t,F,overlap,plate_displacement", t, F, 0 * t, t**2)
    table("state.csv", "t,P,contacts", t, 0 * t, 0 * t)
    table("blank.csv", "t,kinetic,strain", [0.0], [0.0], [0.0])
    header = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF X\n{}\n" + "x\n" * 5
    rows = "".join(f"{i} {x} {y} {z} 0 0 0 {r}\n" for i, (x, y, z, r) in enumerate(spheres, start=1))
    (folder / "spheres.dump").write_text(header.format(len(spheres)) + rows)
    (folder / "contacts.dump").write_text(header.format(1) + "1 0.0\n")
    return Impact(Result("c", {"dt": DT, "V": 10.0}, frozenset(), folder))


class Evaluation(unittest.TestCase):
    def test_mean_over_5_us(self):
        self.assertLess(np.abs(impact(self, np.full(200, 7.0)).filtered_force() - 7.0).max(), 1e-12)
        pulse = np.zeros(400)
        pulse[200:225] = 80.0  # 2.5 us
        self.assertAlmostEqual(impact(self, pulse).filtered_force().max(), 40.0, delta=1e-12)

    def test_impulse_of_kicks_of_half_a_step(self):
        F = np.array([1.0, 3.0, 0.0])
        one = impact(self, F)
        np.testing.assert_allclose(one.impulse, DT * np.array([0.5, 2.5, 4.0]), rtol=1e-14)
        self.assertAlmostEqual(one.impulse_until(2.5 * DT), DT * 3.25, delta=1e-20)
        self.assertAlmostEqual(one.centre(2 * DT), 4 * DT**2, delta=1e-26)

    def test_lowest_layer(self):
        spheres = [
            (0.0, 0, 1.50e-3, 0.5e-3),  # the lowest bottom, at 1 mm
            (5.9e-3, 0, 1.54e-3, 0.5e-3),
            (-3e-3, 0, 1.44e-3, 0.4e-3),  # the bottom counts, not the middle
            (3e-3, 0, 1.46e-3, 0.4e-3),  # 60 um above
            (6.1e-3, 0, 1.50e-3, 0.5e-3),  # not above the crest
        ]
        self.assertEqual(impact(self, np.ones(3), spheres).lowest_layer(), 3)


if __name__ == "__main__":
    unittest.main()

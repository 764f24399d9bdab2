# SPDX-License-Identifier: GPL-2.0-or-later
"""The wavy wall as a function: its derivatives against differences."""

import unittest

from study.build.waves import K, SplineWave
from study.reference.wavy_surface import sine_surface, spline_surface

AMPLITUDE = 0.5e-3


class Derivatives(unittest.TestCase):
    def test_of_both_surfaces(self):
        h = 1e-6
        for surface in (sine_surface(AMPLITUDE), spline_surface(SplineWave(3, 62), AMPLITUDE)):
            x, y = 0.0173, 0.0058
            s, e, n = surface(x, y), surface(x + h, y), surface(x, y + h)
            w, so = surface(x - h, y), surface(x, y - h)
            differences = {
                "zx": (e.z - w.z) / (2 * h),
                "zy": (n.z - so.z) / (2 * h),
                "zxx": (e.zx - w.zx) / (2 * h),
                "zxy": (n.zx - so.zx) / (2 * h),
                "zyy": (n.zy - so.zy) / (2 * h),
            }
            for name, value in differences.items():
                self.assertAlmostEqual(getattr(s, name), value, delta=1e-6 * AMPLITUDE * K ** (len(name) - 1))


if __name__ == "__main__":
    unittest.main()

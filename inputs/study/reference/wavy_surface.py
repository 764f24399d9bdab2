# SPDX-License-Identifier: GPL-2.0-or-later
"""The wavy wall as a function z(x, y) with its derivatives: as the spline that was run, and as the sine."""

from __future__ import annotations

import numpy as np

from study.build.waves import K, SIDE, SplineWave
from study.reference.sliding import Slope, Surface


def spline_surface(wave: SplineWave, amplitude: float) -> Surface:
    """The NURBS wall, again and again in each direction."""
    s, ds, dds = (wave.spline.derivative(d) if d else wave.spline for d in range(3))

    def at(x: float, y: float) -> Slope:
        x, y = x % SIDE, y % SIDE
        a, da, dda, b, db, ddb = s(x), ds(x), dds(x), s(y), ds(y), dds(y)
        return Slope(*(amplitude * np.array([a * b, da * b, a * db, dda * b, da * db, a * ddb])))

    return at


def sine_surface(amplitude: float) -> Surface:
    """What all walls approximate."""

    def at(x: float, y: float) -> Slope:
        a, b, da, db = np.sin(K * x), np.sin(K * y), K * np.cos(K * x), K * np.cos(K * y)
        curvature = -K * K * a * b
        return Slope(*(amplitude * np.array([a * b, da * b, a * db, curvature, da * db, curvature])))

    return at

# SPDX-License-Identifier: GPL-2.0-or-later
"""The wall z = A sin(kx) sin(ky), three waves in each direction of a periodic box of 62 x 62 mm: as a spline, as its
model file for `fix wall/nurbs`, and as triangles.

The spline s(x) of sin(kx) interpolates it at equidistant points (the knots of odd degrees, the middles between them of
even ones) and is periodic, so s and all derivatives that it has are continuous across the box.  The wall is
z = A s(x) s(y) with x and y themselves as parameters.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline, insert

from study.build.stl import stl

SIDE = 62e-3  # of the periodic box [m]
WAVES = 3  # along a side
K = 2.0 * np.pi * WAVES / SIDE  # [1/m]


@dataclass(frozen=True)
class SplineWave:
    """The periodic spline s of sin(kx), on `elements` equal elements of [0, SIDE]."""

    degree: int
    elements: int

    @cached_property
    def spline(self) -> BSpline:
        """Coefficients sin(kx) on equidistant knots make a spline that is a multiple of sin(kx) at the points named
        above, where the B-splines have their centres; divided by that factor they interpolate."""
        p, h = self.degree, SIDE / self.elements
        knots = h * np.arange(-p, self.elements + p + 1)
        centres = h * (np.arange(self.elements + p) - 0.5 * (p - 1))
        wave = BSpline(knots, np.sin(K * centres), p)
        somewhere = centres[p + np.argmax(wave.c[p:-p])]
        return BSpline(knots, wave.c / (wave(somewhere) / np.sin(K * somewhere)), p)

    def clamped(self, first: int, last: int) -> BSpline:
        """The same function on the elements first <= i < last of the line, with open knots, as NURBS files want them.
        Where two of these meet, knots and coefficients are the same to the last bit, but for the ends."""
        p, h = self.degree, SIDE / self.elements
        first_knot, last_knot = first - p - 1, last + p + 1
        knots = h * np.arange(first_knot, last_knot + 1)
        coefficients = self.spline.c[np.arange(first_knot + p, last_knot) % self.elements]
        spline = knots, coefficients, p
        for end in (first, last):
            spline = insert(h * end, spline, m=p)
        knots, coefficients, _ = spline
        return BSpline(knots[p + 1 : -p - 1], coefficients[p + 1 :][: last - first + p], p)


def model_file(wave: SplineWave, amplitude: float, around: int = 0) -> str:
    """For `geometry`: the patch as surface `wall`, continued by some elements around the periodic box."""
    spline = wave.clamped(-around, wave.elements + around)
    knots, c, n = spline.t, spline.c, len(spline.c)
    x = [knots[i + 1 : i + 1 + wave.degree].mean() for i in range(n)]  # so that x(xi) = xi
    points = (f"[{x[i]!r}, {x[j]!r}, {amplitude * c[i] * c[j]!r}]" for j in range(n) for i in range(n))
    return (
        "units: si\ngeometry:\n  patches:\n"
        f"    - degrees: [{wave.degree}, {wave.degree}]\n"
        f"      knots: [{knots.tolist()}, {knots.tolist()}]\n"
        "      control_points:\n        [" + ",\n        ".join(points) + "]\n"
        "surfaces: {wall: all}\n"
    )


def triangles(cells: int, amplitude: float) -> str:
    """STL of cells x cells squares, each cut in two, with corners on the sine."""
    grid = np.linspace(0.0, SIDE, cells + 1)
    sine = np.sin(K * grid)
    corner = [[(x, y, amplitude * a * b) for x, a in zip(grid, sine)] for y, b in zip(grid, sine)]
    found = []
    for low, high in zip(corner, corner[1:]):
        for a, b, c, d in zip(low, low[1:], high[1:], high):
            found += [(a, b, c), (a, c, d)]
    return stl(found)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Integrals of B-splines on a length of equal elements, for programs that know no geometry."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import BSpline


class SplineIntegrals:
    """[i, j] of products of functions i and j: values, slopes, slope of i times value of j; and row sums of the values."""

    def __init__(self, elements: int, degree: int, length: float):
        knots = np.r_[[0.0] * degree, np.linspace(0.0, length, elements + 1), [length] * degree]
        self.count = elements + degree
        self.functions = [BSpline(knots, one, degree) for one in np.eye(self.count)]
        points, weights = np.polynomial.legendre.leggauss(degree + 1)
        half = 0.5 * length / elements
        x = np.concatenate([(2 * k + 1) * half + half * points for k in range(elements)])
        weights = np.tile(half * weights, elements)
        value, slope = (np.array([f(x, d) for f in self.functions]) for d in (0, 1))
        self.values, self.slopes, self.slope_value = (
            (a * weights) @ b.T for a, b in ((value, value), (slope, slope), (slope, value))
        )
        self.row_sums = self.values.sum(axis=1)

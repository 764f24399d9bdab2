# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields on one NURBS patch, evaluated on their own: nothing of the solver but its control points is used."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import Sequence

import numpy as np

Array = np.ndarray


def open_knots(degree: int, elements: int) -> Array:
    return np.concatenate([np.zeros(degree), np.linspace(0.0, 1.0, elements + 1), np.ones(degree)])


def functions(knots: Array, degree: int, at: Array) -> Array:
    """B-splines [points][functions] by Cox and de Boor's recursion; at = 1 belongs to the last element."""
    last = np.searchsorted(knots, knots[-1]) - 1
    span = np.minimum(np.searchsorted(knots, at, side="right") - 1, last)
    N = (np.arange(len(knots) - 1) == span[:, None]).astype(float)
    for p in range(1, degree + 1):
        N = sides(knots, p, at - knots[: len(knots) - p - 1, None], knots[p + 1 :, None] - at, N)
    return N


def sides(knots: Array, p: int, rising: Array | float, falling: Array | float, N: Array) -> Array:
    """rising/(length) N_i + falling/(length) N_(i+1) of one degree less, 0/0 = 0."""
    count = len(knots) - p - 1

    def share(numerator: Array | float, first: int) -> Array:
        length = knots[first + p : first + p + count] - knots[first : first + count]
        inverse = np.divide(1.0, length, out=np.zeros(count), where=length > 0.0)
        return np.transpose(numerator * inverse[:, None]) if np.ndim(numerator) else numerator * inverse

    return share(rising, 0) * N[:, :count] + share(falling, 1) * N[:, 1 : count + 1]


def derivatives(knots: Array, degree: int, at: Array) -> Array:
    return sides(knots, degree, degree, -degree, functions(knots, degree - 1, at))


@dataclass(frozen=True)
class Patch:
    """Uniform open knots; control points [nodes][3], xi fastest, and their weights."""

    degrees: Sequence[int]
    elements: Sequence[int]
    points: Array
    weights: Array

    def gradients(self, u: Array, at: Sequence[Array]) -> tuple[Array, Array, Array]:
        """Places X [points][3], du/dX [points][3][3] and dX/dxi of the parameters at[0] x at[1] x at[2]."""
        values = [functions(open_knots(p, n), p, xi) for p, n, xi in zip(self.degrees, self.elements, at)]
        slopes = [derivatives(open_knots(p, n), p, xi) for p, n, xi in zip(self.degrees, self.elements, at)]
        basis = [grid(values)] + [grid([slopes[j] if i == j else values[j] for j in range(3)]) for i in range(3)]
        sums = [B @ np.column_stack([self.weights, *(self.weights * c for c in (*self.points.T, *u.T))]) for B in basis]
        W, fields = sums[0][:, :1], sums[0][:, 1:] / sums[0][:, :1]
        slope = np.stack([(s[:, 1:] - s[:, :1] * fields) / W for s in sums[1:]], axis=2)  # [points][6][xi]
        J = slope[:, :3]
        return fields[:, :3], slope[:, 3:] @ np.linalg.inv(J), J


def grid(factors: Sequence[Array]) -> Array:
    """Products of three bases, [points][functions], the first fastest in both."""
    return reduce(lambda fast, slow: np.kron(slow, fast), factors)


def weights_of(degree: int, elements: int, weight: Sequence[float]) -> Array:
    """Weights on a refined basis of the quadratic weight function with three weights on one element."""
    knots = open_knots(degree, elements)
    greville = np.array([knots[i + 1 : i + degree + 1].mean() for i in range(len(knots) - degree - 1)])
    wanted = functions(open_knots(2, 1), 2, greville) @ np.asarray(weight)
    return np.linalg.solve(functions(knots, degree, greville), wanted)


def gauss(degree: int, elements: int) -> tuple[Array, Array]:
    """degree + 1 Gauss points per element of [0, 1], and their weights."""
    x, w = np.polynomial.legendre.leggauss(degree + 1)
    h = 1.0 / elements
    return (h * (np.arange(elements)[:, None] + 0.5 * (x + 1.0))).ravel(), np.tile(0.5 * h * w, elements)

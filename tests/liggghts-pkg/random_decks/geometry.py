# SPDX-License-Identifier: GPL-2.0-or-later
"""Points and frames of the random walls, and the textbook evaluation of a NURBS surface (Piegl & Tiller 1997, A2.2, A4.3)."""

from __future__ import annotations

from random import Random

import numpy as np


def unit(v) -> np.ndarray:
    return np.asarray(v, dtype=float) / np.linalg.norm(v)


def direction(rng: Random) -> np.ndarray:
    """A random unit vector."""
    return unit([rng.gauss(0, 1) for _ in range(3)])


def axes(z, reference=None) -> np.ndarray:
    """Columns x, y, z of a right-handed frame with z along `z`; without a reference that of iga-solver/nurbs/primitives.h."""
    z = unit(z)
    if reference is None:
        reference = np.roll(np.eye(3)[np.argmax(np.abs(z))], 1)
    x = unit(reference - np.dot(reference, z) * z)
    return np.column_stack([x, np.cross(z, x), z])


def text(v) -> str:
    """A vector as YAML: [x, y, z]."""
    return "[" + ", ".join(repr(float(c)) for c in v) + "]"


def basis(knots: list[float], degree: int, t: float) -> np.ndarray:
    """All B-spline functions at t, by the recursion of Cox and de Boor."""
    last = len(knots) - degree - 2
    span = max(i for i in range(degree, last + 1) if knots[i] <= t or i == degree)
    N = np.zeros(len(knots) - 1)
    N[span] = 1.0
    for p in range(1, degree + 1):
        for i in range(span - p, span + 1):
            left, right = knots[i + p] - knots[i], knots[i + p + 1] - knots[i + 1]
            N[i] = ((t - knots[i]) / left * N[i] if left > 0 else 0.0) + (
                (knots[i + p + 1] - t) / right * N[i + 1] if right > 0 else 0.0
            )
    return N[: last + 1]


class NurbsSurface:
    """One patch; control points [n][m][3] and weights [n][m], the first index along xi."""

    def __init__(self, degrees, knots, points, weights):
        self.degrees, self.knots, self.points, self.weights = degrees, knots, np.array(points), np.array(weights)

    def yaml(self) -> str:
        """As an entry of `patches`; xi runs fastest."""
        control = ", ".join(text(p) for p in self.points.transpose(1, 0, 2).reshape(-1, 3))
        weights = ", ".join(repr(float(w)) for w in self.weights.T.ravel())
        knots = ", ".join(str([float(t) for t in direction]) for direction in self.knots)
        return (
            f"{{degrees: {list(self.degrees)}, knots: [{knots}],\n      control_points: [{control}],\n"
            f"      weights: [{weights}]}}"
        )

    def point(self, xi: float, eta: float) -> np.ndarray:
        Nu, Nv = (basis(k, p, t) for k, p, t in zip(self.knots, self.degrees, (xi, eta)))
        R = np.outer(Nu, Nv) * self.weights
        return np.einsum("ij,ijk->k", R, self.points) / R.sum()

    def normal(self, xi: float, eta: float) -> np.ndarray:
        h = 1e-5
        du = self.point(xi + h, eta) - self.point(xi - h, eta)
        dv = self.point(xi, eta + h) - self.point(xi, eta - h)
        return unit(np.cross(du, dv))

    def largest_curvature(self, samples: int = 24) -> float:
        """Of normal sections along the parameter lines, from the turn of normals between neighbouring samples."""
        ts = np.linspace(0.01, 0.99, samples)
        S = np.array([[self.point(u, v) for v in ts] for u in ts])
        n = np.array([[self.normal(u, v) for v in ts] for u in ts])
        largest = 0.0
        for axis in (0, 1):
            turn = np.linalg.norm(np.diff(n, axis=axis), axis=-1)
            largest = max(largest, float((turn / np.linalg.norm(np.diff(S, axis=axis), axis=-1)).max()))
        return largest


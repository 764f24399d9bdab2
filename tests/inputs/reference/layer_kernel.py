# SPDX-License-Identifier: GPL-2.0-or-later
"""What a layer gives way more than a half-space at the foot of a unit force: an independent computation, for
study/reference/elastic_plate.py.

Waves of number k along the layer, W(z) cos kx and U(z) sin kx, by B-splines through the thickness that know no mesh in the plane:
many of high degree stand for the layer itself, few of degree 2 for what a mesh of so many layers makes of it.  g(s) is the
integral of k/(2 pi) times the answer to the force less the static one to the half-space's tractions on both sides.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import BSpline


class Layer:
    def __init__(self, E: float, nu: float, rho: float, thickness: float, layers: int, degree: int, row_sums: bool):
        self.E, self.nu, self.rho, self.thickness = E, nu, rho, thickness
        self.mu = 0.5 * E / (1.0 + nu)
        self.lame = 2.0 * self.mu * nu / (1.0 - 2.0 * nu)
        knots = np.r_[[0.0] * degree, np.linspace(0.0, thickness, layers + 1), [thickness] * degree]
        count, half = layers + degree, 0.5 * thickness / layers
        points, weights = np.polynomial.legendre.leggauss(degree + 1)
        z = np.concatenate([(2 * e + 1) * half + half * points for e in range(layers)])
        weights = np.tile(half * weights, layers)
        functions = [BSpline(knots, one, degree) for one in np.eye(count)]
        N, dN = (np.array([f(z) for f in each]) for each in (functions, [f.derivative() for f in functions]))
        self.NN, self.dNdN, self.NdN = (N * weights) @ N.T, (dN * weights) @ dN.T, (N * weights) @ dN.T
        self.mass = np.diag(self.NN.sum(axis=1)) if row_sums else self.NN

    def answer(self, k: float, s: float, half_space: bool = False) -> float:
        """W(0) to a unit load on top, and on the lower side what a half-space has there (Johnson 1985, sec. 3.2)."""
        n, inertia = len(self.NN), self.rho * s**2 * self.mass
        stiff = self.lame + 2.0 * self.mu
        A = np.zeros((2 * n, 2 * n))  # U, then W
        A[:n, :n] = stiff * k**2 * self.NN + self.mu * self.dNdN + inertia
        A[n:, n:] = stiff * self.dNdN + self.mu * k**2 * self.NN + inertia
        A[:n, n:] = self.lame * k * self.NdN - self.mu * k * self.NdN.T
        A[n:, :n] = A[:n, n:].T
        load = np.zeros(2 * n)
        load[n] = 1.0
        if half_space:
            kT = k * self.thickness
            load[n - 1] = -kT * np.exp(-kT)
            load[2 * n - 1] = -(1.0 + kT) * np.exp(-kT)
        return np.linalg.solve(A, load)[n]

    def half_space(self, k: float) -> float:
        return 2.0 * (1.0 - self.nu**2) / (self.E * k)

    def beyond_half_space(self, s: float) -> float:
        """g(s) [m/N]."""
        low, high = 0.01 / self.thickness, 60.0 / self.thickness
        points, weights = np.polynomial.legendre.leggauss(160)
        k = np.exp(0.5 * np.log(low * high) + 0.5 * np.log(high / low) * points)
        weights = 0.5 * np.log(high / low) * weights * k * k / (2.0 * np.pi)
        found = sum(w * (self.answer(x, s) - self.answer(x, 0.0, half_space=True)) for x, w in zip(k, weights))
        # Below, the layer moves as a whole.
        whole = low**2 / (4.0 * np.pi * self.rho * self.thickness * s**2)
        return found + whole - low * low * self.half_space(low) / (2.0 * np.pi)

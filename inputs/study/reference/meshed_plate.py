# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere hits a plate of equal solid elements, with the contact corrected by what the mesh gives way: an independent program.

The plate is periodic and its mesh uniform, so plane waves over the control points, exp(i (theta_x i + theta_y j)), fall apart:
for each of them 3 unknowns per layer of control points.  Their modes turn exactly, the contact's force acts in kicks.  Mass
matrices are row sums, or these corrected once by the consistent matrix.  What the mesh gives way more than the plate, c, is the same mesh's answer to the half-space's tractions
on both sides (Johnson 1985, sec. 3.2, and its transform), without any limit of a patch.  What is left beside three-dimensional
elasticity (elastic_plate.py) is the mesh's own: waves in its elements, shear of its layers.  All quantities are SI; z is the
depth below the side that is hit.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline

from study.reference.elastic_plate import contact_force, peak
from study.reference.hertz import Impact
from study.reference.spline_integrals import SplineIntegrals


class Along:
    """Integrals as in SplineIntegrals, for waves of phase theta from one control point of the plane to the next."""

    def __init__(self, h: float, degree: int, theta: np.ndarray):
        one = BSpline.basis_element(np.arange(degree + 2.0), extrapolate=False)
        slope = one.derivative()
        points, weights = np.polynomial.legendre.leggauss(degree + 1)
        x = (np.arange(degree + 1.0)[:, None] + 0.5 + 0.5 * points).ravel()
        weights = np.tile(0.5 * weights, degree + 1)
        self.values, self.slopes, self.slope_value = np.zeros((3, len(theta)), complex)
        for j in range(-degree, degree + 1):
            here, there = (one(x), slope(x)), (np.nan_to_num(one(x - j)), np.nan_to_num(slope(x - j)))
            phase = np.exp(1j * j * theta)
            self.values += h * (weights @ (here[0] * there[0])) * phase
            self.slopes += (weights @ (here[1] * there[1])) / h * phase
            self.slope_value += (weights @ (here[1] * there[0])) * phase


@dataclass(frozen=True)
class MeshedPlate:
    """The place that is hit is in the `corner` of elements or in the `centre` of one."""

    E: float
    nu: float
    rho: float
    thickness: float
    h: float  # side of the elements
    layers: int
    place: str
    side: float  # of the plate
    degree: int = 2
    degree_through: int | None = None  # of the thickness; None: the same
    mass: str = "lumped"  # or corrected
    shear_factor: float = 1.0  # of the stiffness that shear strain across the plate meets

    @property
    def shift(self) -> float:
        """From the place to the next control point, over h."""
        return 0.0 if (self.place == "centre") == (self.degree % 2 == 0) else 0.5

    @cached_property
    def through(self) -> SplineIntegrals:
        return SplineIntegrals(self.layers, self.degree_through or self.degree, self.thickness)

    def stiffness(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """[wave, unknown, unknown] of phases x, y: displacements along x, y, z, each of all layers of control points."""
        mu = 0.5 * self.E / (1.0 + self.nu)
        lame = 2.0 * mu * self.nu / (1.0 - 2.0 * self.nu)
        plane, z, n = (Along(self.h, self.degree, x), Along(self.h, self.degree, y)), self.through, self.through.count

        def product(i: int, j: int) -> np.ndarray:
            """Of the derivatives in i of one function and in j of the other."""
            factor = np.ones(len(x), complex)
            for d, along in enumerate(plane):
                if d == i == j:
                    factor = factor * along.slopes
                elif d == i:
                    factor = factor * along.slope_value
                else:
                    factor = factor * (along.slope_value.conj() if d == j else along.values)
            if i == j == 2:
                matrix = z.slopes
            elif i == 2:
                matrix = z.slope_value
            else:
                matrix = z.slope_value.T if j == 2 else z.values
            return factor[:, None, None] * matrix

        K, along = np.zeros((len(x), 3 * n, 3 * n), complex), [slice(i * n, (i + 1) * n) for i in range(3)]
        for i in range(3):
            for j in range(3):  # of stretches, and of shear between i and j
                K[:, along[i], along[j]] += lame * product(i, j) + (2.0 * mu if i == j else 0.0) * product(i, i)
                if i < j:
                    factor = mu * (self.shear_factor if j == 2 else 1.0)
                    K[:, along[i], along[i]] += factor * product(j, j)
                    K[:, along[j], along[j]] += factor * product(i, i)
                    K[:, along[i], along[j]] += factor * product(j, i)
                    K[:, along[j], along[i]] += factor * product(i, j)
        return K

    def root_of_inverse_mass(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """[wave, unknown, unknown]: L of the inverse mass L L^H."""
        lumped = self.rho * self.h**2 * self.through.row_sums
        inverse = np.broadcast_to(np.diag(1.0 / lumped), (len(x), len(lumped), len(lumped)))
        if self.mass == "corrected":
            waves = Along(self.h, self.degree, x).values * Along(self.h, self.degree, y).values
            inverse = 2.0 * inverse - self.rho * waves[:, None, None] * (self.through.values / np.outer(lumped, lumped))
        return np.kron(np.eye(3), np.linalg.cholesky(inverse))

    def at_foot(self, theta: np.ndarray) -> np.ndarray:
        """Value at the place of a wave of one direction."""
        one = BSpline.basis_element(np.arange(self.degree + 2.0), extrapolate=False)
        place = np.arange(-self.degree - 1, self.degree + 2) + self.shift
        weights = np.nan_to_num(one(0.5 * (self.degree + 1) - place))
        return np.cos(np.outer(theta, place)) @ weights

    def half_space(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """[wave, unknown]: nodal forces by which the lower side has the tractions of a half-space under a unit force."""
        n, T = self.through.count, self.thickness
        forces = np.zeros((len(x), 3 * n), complex)
        for i in range(-2, 3):
            for j in range(-2, 3):  # waves that control points cannot tell from these; shorter ones do not reach down
                k_x, k_y = (x + 2.0 * np.pi * i) / self.h, (y + 2.0 * np.pi * j) / self.h
                k = np.hypot(k_x, k_y)
                part = np.exp(-k * T) * np.exp(2j * np.pi * self.shift * (i + j))
                part *= (np.sinc(0.5 * k_x * self.h / np.pi) * np.sinc(0.5 * k_y * self.h / np.pi)) ** (self.degree + 1)
                forces[:, n - 1] += 1j * T * k_x * part
                forces[:, 2 * n - 1] += 1j * T * k_y * part
                forces[:, 3 * n - 1] -= (1.0 + k * T) * part
        return forces

    @cached_property
    def compliance(self) -> float:
        """c [m/N]."""
        low, high = np.polynomial.legendre.leggauss(5), np.geomspace(0.01 * self.h / self.thickness, np.pi, 15)
        edges = np.r_[0.0, high]
        theta = np.concatenate([0.5 * (a + b) + 0.5 * (b - a) * low[0] for a, b in zip(edges, edges[1:])])
        weight = np.concatenate([0.5 * (b - a) * low[1] for a, b in zip(edges, edges[1:])])
        x, y = (a.ravel() for a in np.meshgrid(theta, theta))
        R, forces = self.at_foot(x) * self.at_foot(y), self.half_space(x, y)
        top = 2 * self.through.count
        forces[:, top] += R
        u = np.linalg.solve(self.stiffness(x, y), forces[:, :, None])[:, top, 0].real
        return float((np.outer(weight, weight).ravel() / np.pi**2) @ (R * u))

    @cached_property
    def modes(self) -> tuple[np.ndarray, np.ndarray]:
        """Angular frequencies [rad/s] and the place's displacements, mass-normalised [kg^(-1/2)]."""
        number = 2 * round(0.5 * self.side / self.h)
        theta = 2.0 * np.pi / number * np.arange(number // 2 + 1)
        weight = np.full(len(theta), 2.0 / number)
        weight[[0, -1]] = 1.0 / number
        x, y = (a.ravel() for a in np.meshgrid(theta, theta))
        root = self.root_of_inverse_mass(x, y)
        squares, shapes = np.linalg.eigh(root.conj().swapaxes(1, 2) @ self.stiffness(x, y) @ root)
        top = 2 * self.through.count
        R = self.at_foot(x) * self.at_foot(y) * np.sqrt(np.outer(weight, weight).ravel())
        phi = np.abs((root[:, top : top + 1] @ shapes)[:, 0] * R[:, None]).ravel()
        moved = phi > 1e-12 * phi.max()
        return np.sqrt(np.maximum(squares.ravel()[moved], 0.0)), phi[moved]

    def impact(self, sphere: Impact, dt: float, corrected: bool = True) -> tuple[float, float]:
        """Restitution and peak force [N] of a sphere that follows Hertz' law, at steps dt [s]."""
        c = self.compliance if corrected else 0.0
        omega, phi = self.modes
        cos, turn, drift = np.cos(omega * dt), omega * np.sin(omega * dt), dt * np.sinc(omega * dt / np.pi)
        q, rate = np.zeros((2, len(omega)))
        x, v, F = 0.0, sphere.V, [0.0]
        while F[-1] > 0.0 or len(F) == 1:
            rate += 0.5 * dt * F[-1] * phi
            v -= 0.5 * dt * F[-1] / sphere.m
            q, rate = cos * q + drift * rate, cos * rate - turn * q
            x += dt * v
            F.append(contact_force(x - phi @ q, -c, sphere.k)[0])
            rate += 0.5 * dt * F[-1] * phi
            v -= 0.5 * dt * F[-1] / sphere.m
        return -v / sphere.V, peak(np.array(F))

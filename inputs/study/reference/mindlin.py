# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere hits the centre of a square plate so small that the bending waves come back from its sides.

The plate shears and its sections have inertia: Mindlin (1951), J. Appl. Mech. 18, 31-38.  Its modes are those of
Ritz's method with Legendre polynomials P_i(x) P_j(y), times (1 - x^2) where a side holds that motion; x, y run from -1
to 1.  Only modes that are even in both directions move the centre.

All quantities are SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh

from study.reference.hertz import Impact


class Functions:
    """The first n even or odd functions of one direction: values and slopes at points x, integrals of products."""

    def __init__(self, n: int, odd: bool, held: bool):
        self.coefficients = []
        for i in range(n):
            degree = 2 * i + odd
            c = np.sqrt(2.0 * degree + 1.0) * np.eye(degree + 1)[degree]
            self.coefficients.append(legendre.legmul(c, [2.0 / 3.0, 0.0, -2.0 / 3.0]) if held else c)  # times 1 - x^2
        self.x, self.weight = legendre.leggauss(2 * n + 4)
        self.value = self.at(self.x)
        slopes = [legendre.legder(c) for c in self.coefficients]
        self.slope = np.array([legendre.legval(self.x, c) for c in slopes])

    def at(self, x: np.ndarray) -> np.ndarray:
        return np.array([legendre.legval(x, c) for c in self.coefficients])

    def product(self, f: np.ndarray, g: np.ndarray) -> np.ndarray:
        return (f * self.weight) @ g.T


@dataclass(frozen=True)
class SquarePlate:
    """E [Pa], nu, rho [kg/m3], thickness and side [m]; sides `supported`, `clamped` or `free`.

    Supported: neither deflection nor turn along the side (solids of which a face is fixed in z alone may turn: the
    restitution is the same to 2e-5)."""

    E: float
    nu: float
    rho: float
    thickness: float
    side: float
    sides: str
    functions: int = 12  # per direction and field
    shear_factor: float = 5.0 / 6.0  # large: no shear
    rotary_inertia: float = 1.0  # 0: none

    @cached_property
    def modes(self) -> tuple[np.ndarray, np.ndarray]:
        """Angular frequencies [rad/s], and the deflections of the centre in the modes, mass-normalised [kg^(-1/2)]."""
        n, a, h = self.functions, 0.5 * self.side, self.thickness
        w = Functions(n, odd=False, held=self.sides != "free")
        odd = Functions(n, odd=True, held=self.sides == "clamped")
        even = Functions(n, odd=False, held=self.sides != "free")  # along a side
        D = self.E * h**3 / (12.0 * (1.0 - self.nu**2))
        twist = 0.5 * D * (1.0 - self.nu)
        shear = self.shear_factor * self.E * h / (2.0 * (1.0 + self.nu))
        inertia = self.rotary_inertia * self.rho * h**3 / 12.0
        I, kron, area = w.product, np.kron, a * a

        # Unknowns: w, then the turns of the normal psi_x (odd in x, even in y) and psi_y.
        ww, w_w_ = I(w.value, w.value), I(w.slope, w.slope)
        oo, o_o_ = I(odd.value, odd.value), I(odd.slope, odd.slope)
        ee, e_e_ = I(even.value, even.value), I(even.slope, even.slope)
        w_o, we = I(w.slope, odd.value), I(w.value, even.value)
        o_e, oe_ = I(odd.slope, even.value), I(odd.value, even.slope)
        xx = D * kron(o_o_, ee) + twist * kron(oo, e_e_) + shear * area * kron(oo, ee)
        yy = D * kron(ee, o_o_) + twist * kron(e_e_, oo) + shear * area * kron(ee, oo)
        xy = self.nu * D * kron(o_e, o_e.T) + twist * kron(oe_, oe_.T)
        wx, wy = shear * a * kron(w_o, we), shear * a * kron(we, w_o)
        ww_ = shear * (kron(w_w_, ww) + kron(ww, w_w_))
        stiffness = np.block([[ww_, wx, wy], [wx.T, xx, xy], [wy.T, xy.T, yy]])
        none = np.zeros_like(ww_)
        mass = np.block(
            [
                [self.rho * h * area * kron(ww, ww), none, none],
                [none, inertia * area * kron(oo, ee), none],
                [none, none, inertia * area * kron(ee, oo)],
            ]
        )
        squares, shapes = eigh(stiffness, mass)
        centre = w.at(np.zeros(1))[:, 0]
        return np.sqrt(np.maximum(squares, 0.0)), kron(centre, centre) @ shapes[: n * n]

    def restitution(self, impact: Impact, dt: float) -> float:
        """Speed of the sphere after / before, at steps dt [s]: the modes turn exactly, the force acts in kicks."""
        omega, phi = self.modes
        cos, turn = np.cos(omega * dt), omega * np.sin(omega * dt)
        drift = dt * np.sinc(omega * dt / np.pi)
        q, rate = np.zeros_like(omega), np.zeros_like(omega)
        z, v, force = 0.0, -impact.V, 0.0
        while force > 0.0 or z == 0.0:
            rate += 0.5 * dt * force * phi  # downwards
            v += 0.5 * dt * force / impact.m
            q, rate = cos * q + drift * rate, cos * rate - turn * q
            z += dt * v
            force = impact.k * max(-z - phi @ q, 0.0) ** impact.n
            rate += 0.5 * dt * force * phi
            v += 0.5 * dt * force / impact.m
        return v / impact.V

# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere hits a large thin plate: Zener (1941), Phys. Rev. 59, 669-673.

An infinite Kirchhoff plate answers a point force F with the velocity w' = alpha F: bending waves
carry energy away.  With t = T tau and the overlap d = T V s,

    s'' + (1 + inelasticity d/dtau) s^(3/2) = 0,  s(0) = 0,  s'(0) = 1.

All quantities are SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar


def plate_mobility(E: float, nu: float, rho: float, h: float) -> float:
    """alpha [m/(N s)] = 1/(8 sqrt(D rho h)), D = E h^3/(12 (1 - nu^2)), h the thickness [m]."""
    D = E * h**3 / (12.0 * (1.0 - nu**2))
    return 1.0 / (8.0 * np.sqrt(D * rho * h))


def solve(inelasticity: float):
    """(s, q) up to the end of contact; q = s' + inelasticity s^(3/2): the sphere's velocity / V."""

    def rate(_, y):
        f = max(y[0], 0.0) ** 1.5
        return [y[1] - inelasticity * f, -f]

    def contact_ends(tau, y):
        return y[0] if tau > 1e-6 else 1.0

    contact_ends.terminal = True
    contact_ends.direction = -1
    options = dict(method="DOP853", rtol=1e-11, atol=1e-13, max_step=0.05, dense_output=True)
    return solve_ivp(rate, [0.0, 50.0], [0.0, 1.0], events=contact_ends, **options)


@dataclass(frozen=True)
class ThinPlateImpact:
    """A sphere, m [kg] and V [m/s], F = K d^(3/2) [N], on a plate of mobility alpha [m/(N s)]."""

    m: float
    V: float
    K: float
    alpha: float

    @cached_property
    def _solution(self):
        return solve(self.inelasticity)

    @property
    def time_scale(self) -> float:
        """T [s]."""
        return (self.m / (self.K * np.sqrt(self.V))) ** 0.4

    @property
    def force_scale(self) -> float:
        """m V/T [N]."""
        return self.m * self.V / self.time_scale

    @property
    def inelasticity(self) -> float:
        """Zener's parameter lambda = alpha m/T [-]; 0 is a rigid wall."""
        return self.alpha * self.m / self.time_scale

    @property
    def restitution(self) -> float:
        """Speed after / speed before [-]."""
        return -self._solution.y[1, -1]

    @property
    def duration(self) -> float:
        """t_c [s]."""
        return self.time_scale * self._solution.t[-1]

    @property
    def peak_force(self) -> float:
        """F_max [N]."""
        contact = (0.0, self._solution.t[-1])
        options = dict(method="bounded", bounds=contact, options={"xatol": 1e-9})
        largest = minimize_scalar(lambda tau: -self._solution.sol(tau)[0], **options)
        return self.force_scale * (-largest.fun) ** 1.5

    @property
    def impulse(self) -> float:
        """Integral of F dt [N s]."""
        return self.m * self.V * (1.0 + self.restitution)

    @property
    def plate_displacement(self) -> float:
        """Of the plate under the sphere when contact ends [m]; it stays until a wave is back."""
        return self.alpha * self.impulse

    def force(self, t: np.ndarray) -> np.ndarray:
        """F(t) [N] for times t [s]; 0 outside the contact."""
        tau = np.asarray(t) / self.time_scale
        inside = (tau > 0.0) & (tau < self._solution.t[-1])
        s = self._solution.sol(np.where(inside, tau, 0.0))[0]
        return np.where(inside, self.force_scale * np.maximum(s, 0.0) ** 1.5, 0.0)

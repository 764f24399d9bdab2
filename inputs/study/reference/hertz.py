# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere hits a fixed wall: m d'' = -k d^n, closed forms for any power n.

The contact laws are those of Gao & Feng (2019), eqs. 31-33:

    linear      F = 4/3 lambda E* sqrt(r) d       lambda in m^(1/2)
    hertz       F = 4/3 lambda E* sqrt(r) d^1.5   lambda has no unit
    quadratic   F = 4/3 lambda E* sqrt(r) d^2     lambda in m^(-1/2)

All quantities are SI.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import beta, betaincinv

from study.run.usage import one_of

EXPONENT = {"linear": 1.0, "hertz": 1.5, "quadratic": 2.0}


def effective_modulus(E1: float, nu1: float, E2: float, nu2: float) -> float:
    """E* [Pa]: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2."""
    return 1.0 / ((1.0 - nu1**2) / E1 + (1.0 - nu2**2) / E2)


def sphere_mass(r: float, rho: float) -> float:
    """Mass [kg] of a sphere of radius r [m] and density rho [kg/m^3]."""
    return 4.0 / 3.0 * np.pi * r**3 * rho


def stiffness(lam: float, E_star: float, r: float) -> float:
    """k [N/m^n] of F = k d^n for the penalty factor lam [m^(3/2 - n)]."""
    return 4.0 / 3.0 * lam * E_star * np.sqrt(r)


def si_factor(law: str) -> float:
    """Factor from lambda in mm^(3/2 - n) to lambda in m^(3/2 - n)."""
    return 1.0e-3 ** (1.5 - EXPONENT[law])


@dataclass(frozen=True)
class Impact:
    """A mass m [kg] with velocity V [m/s] meets the spring F = k d^n [N], k in N/m^n, at t = 0.

    Energy gives d_max; u = d/d_max obeys u'^2 = (V/d_max)^2 (1 - u^(n+1)), so that
    t = t_c/2 I_x(1/(n+1), 1/2) with x = u^(n+1), I the regularised incomplete beta function
    (n = 3/2: Hertz; see Johnson, Contact Mechanics, 1985, section 11.4).
    """

    m: float
    V: float
    k: float
    n: float

    @property
    def max_overlap(self) -> float:
        """d_max [m]."""
        return ((self.n + 1.0) * self.m * self.V**2 / (2.0 * self.k)) ** (1.0 / (self.n + 1.0))

    @property
    def peak_force(self) -> float:
        """F_max [N]."""
        return self.k * self.max_overlap**self.n

    @property
    def duration(self) -> float:
        """t_c [s]."""
        a = 1.0 / (self.n + 1.0)
        return 2.0 * a * beta(a, 0.5) * self.max_overlap / self.V

    @property
    def impulse(self) -> float:
        """Integral of F dt [N s]; the sphere leaves as fast as it came."""
        return 2.0 * self.m * self.V

    def overlap(self, t: np.ndarray) -> np.ndarray:
        """d(t) [m] for times t [s]; 0 outside the contact."""
        a = 1.0 / (self.n + 1.0)
        from_ends = 1.0 - np.abs(2.0 * np.asarray(t) / self.duration - 1.0)
        return self.max_overlap * betaincinv(a, 0.5, np.clip(from_ends, 0.0, 1.0)) ** a

    def force(self, t: np.ndarray) -> np.ndarray:
        """F(t) [N] for times t [s]; 0 outside the contact."""
        return self.k * self.overlap(t) ** self.n


def penalty_impact(law: str, lam: float, E_star: float, r: float, rho: float, V: float) -> Impact:
    """A sphere (r [m], rho [kg/m^3]) hits a fixed wall with V [m/s] under one of the three laws."""
    exponent = EXPONENT[one_of("law", law, EXPONENT)]
    return Impact(sphere_mass(r, rho), V, stiffness(lam, E_star, r), exponent)


@dataclass(frozen=True)
class PaperPulse:
    """Gao & Feng (2019), eqs. 35-37, for the Hertz law.

    Eq. 35, read as f_max [sin(pi t/t_c)]^(3/2), is up to 2.4 % of the peak above the solution.
    """

    E_star: float
    r: float
    rho: float
    V: float

    @property
    def peak_force(self) -> float:
        """f_max [N], eq. 36."""
        return 1.917 * self.rho**0.6 * self.r**2 * (np.pi * self.E_star) ** 0.4 * self.V**1.2

    @property
    def duration(self) -> float:
        """t_c [s], eq. 37."""
        return 4.53 * self.r * (4.0 * self.rho / (3.0 * self.E_star)) ** 0.4 * self.V**-0.2

    def force(self, t: np.ndarray) -> np.ndarray:
        """f(t) [N], eq. 35; 0 outside the contact."""
        phase = np.asarray(t) / self.duration
        inside = (phase > 0.0) & (phase < 1.0)
        return self.peak_force * np.sin(np.pi * np.where(inside, phase, 0.0)) ** 1.5

# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere hits a large plate that is not quite thin: three-dimensional elasticity as a closed formula.

Hertz' law holds the give of the half-space under the contact.  What a layer of thickness h gives way more than that, at the
foot of a force F, is, in Laplace's s,

    w/F = alpha/s - (1 - nu^2)/(E h) [3/(5 pi) ln(s h/c_T) + 0.665]    for s below about c_T/h.

alpha/s is Zener's: bending waves.  The logarithm is shear, as far out as these have come; the constant holds the half-space
that is missing below.  Both are this project's own: from the exact kernel of a layer less a half-space's
(tests/inputs/reference/layer_kernel.py has it once more), beside finite elements that resolve the contact, whose restitutions
the formula meets to 2e-4 and whose peak forces to 0.04 %.  All quantities are SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from study.reference.zener import ThinPlateImpact, plate_mobility

LOGARITHM, CONSTANT = 3.0 / (5.0 * np.pi), 0.665
STEPS = 1500  # in the duration after Zener
LONGEST = 8  # such durations
PARTS = 8  # of a step, where integrals are not closed


def contact_force(approach: float, give: float, K: float, damping: float = 0.0, before: float = 0.0) -> tuple[float, float]:
    """F [N] = K d^(3/2) + damping d^(1/4) (d - before), and d = approach - give F, by Newton's method; give [m/N] may be
    negative."""
    if approach <= 0.0:
        return 0.0, 0.0
    d = approach
    for _ in range(60):
        F = K * d**1.5 + damping * d**0.25 * (d - before)
        slope = 1.5 * K * d**0.5 + damping * (1.25 * d**0.25 - 0.25 * before * d**-0.75)
        change = max((approach - d - give * F) / (1.0 + give * slope), -0.9 * d)
        d += change
        if abs(change) < 1e-14 * approach:
            break
    return K * d**1.5 + damping * d**0.25 * (d - before), d


def peak(F: np.ndarray) -> float:
    """Height of the parabola through the three largest of equally spaced samples."""
    below, top, above = F[np.argmax(F) - 1 : np.argmax(F) + 2]
    return top + 0.125 * (above - below) ** 2 / (2.0 * top - below - above)


@dataclass(frozen=True)
class ElasticPlateImpact:
    """A sphere, m [kg] and V [m/s], F = K d^(3/2) + D d^(1/4) dd/dt [N], on a plate of E [Pa], nu, rho [kg/m^3], thickness h
    [m].  The plate is a half-space until waves are back from its lower side, but the formula gives way by less
    from the beginning, on which a dashpot would run away: with D both terms begin with a delay, as 1 - exp(-(t/delay)^2)."""

    m: float
    V: float
    K: float
    E: float
    nu: float
    rho: float
    h: float
    logarithm: float = LOGARITHM
    constant: float = CONSTANT
    D: float = 0.0
    delay: float = 0.0  # over h/c_T

    @cached_property
    def thin(self) -> ThinPlateImpact:
        """The same after Zener."""
        return ThinPlateImpact(self.m, self.V, self.K, plate_mobility(self.E, self.nu, self.rho, self.h))

    def _spread(self, dt: float, count: int) -> np.ndarray:
        """Answers, 0, 1, ... steps later, of logarithm and constant to a force that has grown by 1 during a step: ln s is
        -(ln t + Euler's constant), folded with the force's rate."""
        step = dt * np.sqrt(0.5 * self.E / (1.0 + self.nu) / self.rho) / self.h
        if self.delay == 0.0:
            k = np.arange(count + 1.0)
            integral = k * (np.log(np.maximum(k, 1.0)) - 1.0 + np.log(step) + np.euler_gamma)
            return self.logarithm * np.diff(integral) - self.constant
        t = step * (np.arange(PARTS * count) + 0.5) / PARTS
        answer = self.logarithm * (np.log(t) + np.euler_gamma) - self.constant
        return (-np.expm1(-((t / self.delay) ** 2)) * answer).reshape(count, PARTS).mean(axis=1)

    @cached_property
    def history(self) -> np.ndarray:
        """Rows t [s], F [N], speed of the sphere [m/s], displacement of the plate beyond a half-space's [m], to the end of
        contact.  The sphere moves by central differences; the plate answers exactly to a force that is linear in a step."""
        dt, alpha, count = self.thin.duration / STEPS, self.thin.alpha, LONGEST * STEPS
        unit = (1.0 - self.nu**2) / (self.E * self.h)
        spread = unit * self._spread(dt, count)
        give = 0.5 * alpha * dt + spread[0]  # by the force at the end of the step
        rows, changes = np.zeros((4, count)), np.zeros(count)
        rows[2, 0], x, impulse, d = self.V, 0.0, 0.0, 0.0
        for n in range(1, count):
            _, F, v, _ = rows[:, n - 1]
            x += dt * (v - 0.5 * dt * F / self.m)
            w = alpha * (impulse + 0.5 * dt * F) + spread[n - 1 : 0 : -1] @ changes[1:n] - spread[0] * F
            now, d = contact_force(x - w, give, self.K, self.D / dt, d)
            impulse += 0.5 * dt * (F + now)
            changes[n] = now - F
            rows[:, n] = n * dt, now, v - 0.5 * dt * (F + now) / self.m, w + give * now
            if d == 0.0:
                return rows[:, : n + 1]
        raise ValueError(f"the contact lasts longer than {LONGEST} times the {self.thin.duration:g} s after Zener")

    @property
    def inelasticity(self) -> float:
        """Zener's parameter [-]."""
        return self.thin.inelasticity

    @property
    def restitution(self) -> float:
        """Speed after / speed before [-]."""
        return -self.history[2, -1] / self.V

    @property
    def duration(self) -> float:
        """t_c [s]."""
        return self.history[0, -1]

    @property
    def peak_force(self) -> float:
        """F_max [N]."""
        return peak(self.history[1])

    @property
    def impulse(self) -> float:
        """Integral of F dt [N s]."""
        return self.m * self.V * (1.0 + self.restitution)

    @property
    def plate_displacement(self) -> float:
        """Of the plate under the sphere when contact ends [m]."""
        return self.history[3, -1]

    def force(self, t: np.ndarray) -> np.ndarray:
        """F(t) [N] for times t [s]; 0 outside the contact."""
        return np.interp(t, self.history[0], self.history[1], left=0.0, right=0.0)

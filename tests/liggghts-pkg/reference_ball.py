# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere that hits a smooth wall, computed here: velocity Verlet, a power law with damping, Mindlin's friction.

Written from the formulas (Gao & Feng 2019, eqs. 31-33; liggghts-pkg/contact_laws.h), for comparison with the wall to
round-off.  Velocities in contact forces are those of the half step, as in LIGGGHTS.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Callable

import numpy as np


@dataclass
class Contact:
    """F_n = K d^n, K = 4/3 lambda E* sqrt(r*); E* and G* effective moduli [Pa]; one material for ball and wall."""

    young: float = 1e8
    nu: float = 0.3
    e: float = 0.7
    mu: float = 0.3
    exponent: float = 1.5
    factor: float = 1.0  # lambda
    history: bool = True
    damped: bool = True  # tangentially

    def forces(self, d, r_star, mass, v_n, v_t, shear):
        """Normal force (> 0 pushes), tangential force, and the shear as it is left."""
        E = self.young / (2 * (1 - self.nu**2))
        G = self.young / (4 * (2 - self.nu) * (1 + self.nu))
        K = 4 / 3 * self.factor * E * math.sqrt(r_star)
        n = self.exponent
        zeta = 0.0 if self.e == 1 else -math.log(self.e) / math.hypot(math.log(self.e), math.pi)
        gamma_n = 2 * zeta * math.sqrt((n + 1) / (2 * n) * n * K * d ** (n - 1) * mass)
        k_t = 8 * G * math.sqrt(r_star * d)
        gamma_t = 2 * zeta * math.sqrt(5 / 6 * k_t * mass) if self.damped else 0.0
        F_n = K * d**n - gamma_n * v_n
        bound = self.mu * abs(F_n)
        if not self.history:
            F_t = -gamma_t * v_t
            size = np.linalg.norm(F_t)
            return F_n, F_t * (min(1.0, bound / size) if size > 0 else 0.0), shear
        F_t = -k_t * shear
        size = np.linalg.norm(F_t)
        if size <= bound:
            return F_n, F_t - gamma_t * v_t, shear
        F_t *= bound / size
        return F_n, F_t, -F_t / k_t


@dataclass
class Wall:
    """`closest(x)`: distance from the surface and unit normal towards x; `r_star` of the radius."""

    closest: Callable
    r_star: Callable = lambda r: r


def plane(normal=(0.0, 0.0, 1.0)) -> Wall:
    n = np.array(normal)
    return Wall(lambda x: (x @ n, n))


def sphere(R: float, side: int) -> Wall:
    """About the origin, met from outside (side 1) or inside (-1); r* is Hertz' for it."""

    def closest(x):
        distance = np.linalg.norm(x)
        return side * (distance - R), side * x / distance

    return Wall(closest, lambda r: r / (1 + side * r / R))


def trajectory(wall: Wall, contact: Contact, radius, density, x, v, omega, dt, steps) -> dict[str, np.ndarray]:
    """Columns x y z, v, w(spin), f, t(orque) of every step."""
    mass = 4 / 3 * math.pi * radius**3 * density
    inertia = 0.4 * mass * radius**2
    x, v, omega = (np.array(a, dtype=float) for a in (x, v, omega))
    shear = np.zeros(3)

    def forces(update: bool):
        nonlocal shear
        distance, n = wall.closest(x)
        d = radius - distance
        if d <= 0:
            shear = np.zeros(3)
            return np.zeros(3), np.zeros(3)
        arm = radius - d / 2
        v_n = v @ n
        v_t = v - v_n * n - arm * np.cross(omega, n)  # of the contact point
        if update:
            shear = shear + dt * v_t
            shear = shear - (shear @ n) * n
        F_n, F_t, left = contact.forces(d, wall.r_star(radius), mass, v_n, v_t, shear)
        if update:
            shear = left
        return F_n * n + F_t, -arm * np.cross(n, F_t)

    rows = []
    F, T = forces(update=False)
    rows.append((x, v, omega, F, T))
    for _ in range(steps):
        v = v + dt / 2 * F / mass
        omega = omega + dt / 2 * T / inertia
        x = x + dt * v
        F, T = forces(update=True)
        v = v + dt / 2 * F / mass
        omega = omega + dt / 2 * T / inertia
        rows.append((x, v, omega, F, T))
    table = np.array(rows).reshape(steps + 1, 15)
    names = ["x", "y", "z"] + [kind + c for kind in ("v", "w", "f", "t") for c in "xyz"]
    return {name: table[:, k] for k, name in enumerate(names)}

# SPDX-License-Identifier: GPL-2.0-or-later
"""Elastic, perfectly plastic spheres, from the pressure in the contact (Thornton 1997; Thornton & Ning 1998).

Written from the assumptions, not from liggghts-pkg/contact_laws.h: while the overlap grows the pressure is Hertz', cut off
at p_y; after that the bodies are Hertz' on the radius r_p that the force and the contact radius of the largest overlap need.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)


@dataclass
class Material:
    """E* [pressure], r* [length], yield pressure p_y."""

    E: float
    r: float
    p_y: float

    @property
    def yield_overlap(self) -> float:
        """Where p(0) = 2 E* a/(pi r*) with a = sqrt(r* d) is p_y."""
        return self.r * (math.pi * self.p_y / (2 * self.E)) ** 2

    def loading(self, d: float) -> float:
        """Integral of min(p, p_y) over the contact, p = p(0) s with s = sqrt(1 - (radius/a)^2)."""
        a = math.sqrt(self.r * d)
        p_0 = 2 * self.E * a / (math.pi * self.r)
        corner = min(self.p_y / p_0, 1.0) if p_0 > 0 else 1.0
        force = 0.0
        for low, high in ((0.0, corner), (corner, 1.0)):
            s = 0.5 * (low + high) + 0.5 * (high - low) * NODES
            ring = 2 * math.pi * a**2 * s  # radius d(radius) = a^2 s ds
            force += 0.5 * (high - low) * float(WEIGHTS @ (np.minimum(p_0 * s, self.p_y) * ring))
        return force

    def force(self, d: float, d_max: float) -> float:
        """At the overlap d of a contact whose largest was d_max >= d."""
        if d >= d_max:
            return self.loading(d)
        top, a = self.loading(d_max), math.sqrt(self.r * d_max)
        r_p = 4 * self.E * a**3 / (3 * top)  # Hertz: F = 4/3 E* a^3/r, d = a^2/r
        elastic = d - (d_max - a**2 / r_p)
        return 4 / 3 * self.E * math.sqrt(r_p) * elastic**1.5 if elastic > 0 else 0.0

    def left_over(self, d_max: float) -> float:
        """The overlap at which the force of the unloading ends."""
        return d_max - 3 * self.loading(d_max) / (4 * self.E * math.sqrt(self.r * d_max))

    def yield_speed(self, m: float) -> float:
        """Of the impact that just yields, of a mass m* [velocity]: its energy is Hertz' 8/15 E* sqrt(r*) d_y^(5/2)."""
        return math.sqrt(2 / m * 8 / 15 * self.E * math.sqrt(self.r) * self.yield_overlap**2.5)


def restitution(speed_ratio: float) -> float:
    """Thornton (1997): coefficient of restitution of an impact at V/V_y."""
    if speed_ratio <= 1:
        return 1.0
    x = 1 / speed_ratio
    return (
        math.sqrt(6 * math.sqrt(3) / 5) * math.sqrt(1 - x**2 / 6) * (x / (x + 2 * math.sqrt(6 / 5 - x**2 / 5))) ** 0.25
    )


def integrated_restitution(material: Material, m: float, speed: float, steps: int = 4000) -> float:
    """m* d'' = -F(d) from touch to the end of the force, by Runge & Kutta of order 4."""
    duration = 3.5 * (m**2 / (material.E**2 * material.r * speed)) ** 0.2  # longer than Hertz'
    h = duration / steps
    d, v, d_max = 0.0, speed, 0.0
    while d > 0 or v > 0:
        if v <= 0 and material.force(d, d_max) == 0.0:
            break

        def slope(d, v):
            return v, -material.force(max(d, 0.0), max(d, d_max)) / m

        k1 = slope(d, v)
        k2 = slope(d + h / 2 * k1[0], v + h / 2 * k1[1])
        k3 = slope(d + h / 2 * k2[0], v + h / 2 * k2[1])
        k4 = slope(d + h * k3[0], v + h * k3[1])
        d, v = (y + h / 6 * (a + 2 * b + 2 * c + e) for y, a, b, c, e in zip((d, v), k1, k2, k3, k4))
        d_max = max(d, d_max)
    return -v / speed

#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball hits the middle of a small square plate of solid elements: an independent program, for inputs/thin_plate.

Quadratic B-splines on a box, so stiffness and mass are Kronecker products of matrices of one direction; row-sum mass,
central differences, Hertz contact at the middle of the upper side.  SI units; glass on glass, 1 m/s, 14 x 14 x 1 mm.

usage: solid_plate.py ELEMENTS LAYERS [DT [SHEAR]]   (a side's, the thickness's; SHEAR multiplies the transverse shear
modulus) prints the restitution for sides that are held in several ways, and clamped minus each of them.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import scipy.sparse as sp

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "inputs"))

from study.reference.spline_integrals import SplineIntegrals  # noqa: E402

E, NU, RHO = 74.6e9, 0.2285, 2480.0  # of plate and ball
SIDE, THICKNESS, RADIUS, SPEED = 14e-3, 1e-3, 1e-3, 1.0
DEGREE = 2
DURATION = 9e-6  # [s], longer than the contact
SIDES = ("clamped", "supported", "free", "supported_middle", "supported_lower_edge")


def in_the_middle(line: SplineIntegrals, length: float) -> np.ndarray:
    return np.array([f(0.5 * length) for f in line.functions])


@dataclass(frozen=True)
class Plate:
    elements: int  # of a side
    layers: int  # of elements through the thickness
    shear: float = 1.0  # factor of the transverse shear modulus

    @cached_property
    def along(self) -> SplineIntegrals:
        return SplineIntegrals(self.elements, DEGREE, SIDE)

    @cached_property
    def through(self) -> SplineIntegrals:
        return SplineIntegrals(self.layers, DEGREE, THICKNESS)

    @cached_property
    def nodes(self) -> np.ndarray:
        """Numbers [x, y, z]; unknown = direction * count + number."""
        shape = (self.along.count, self.along.count, self.through.count)
        return np.arange(np.prod(shape)).reshape(shape)

    @cached_property
    def mass(self) -> np.ndarray:
        x, z = self.along.row_sums, self.through.row_sums
        return np.tile(RHO * np.kron(np.kron(x, x), z), 3)

    @cached_property
    def stiffness(self) -> sp.csr_matrix:
        lame, mu = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))
        directions = (self.along, self.along, self.through)

        def product(i: int, j: int) -> sp.csr_matrix:
            """Of the derivatives in i of one function and in j of the other, over the plate."""
            factors = []
            for d, one in enumerate(directions):
                if d == i == j:
                    factors.append(one.slopes)
                elif d == i:
                    factors.append(one.slope_value)
                else:
                    factors.append(one.slope_value.T if d == j else one.values)
            first, second, third = (sp.csr_matrix(factor) for factor in factors)
            return sp.kron(sp.kron(first, second), third, "csr")

        def modulus(i: int, j: int) -> float:
            return mu * (self.shear if 2 in (i, j) and i != j else 1.0)

        def block(i: int, j: int) -> sp.csr_matrix:
            found = lame * product(i, j) + modulus(i, j) * product(j, i)
            return found if i != j else found + sum(modulus(i, k) * product(k, k) for k in range(3))

        return sp.bmat([[block(i, j) for j in range(3)] for i in range(3)], "csr")

    def held(self, sides: str) -> np.ndarray:
        """Unknowns that the sides hold one by one."""
        edge = np.zeros(self.nodes.shape[:2], bool)
        edge[[0, -1], :] = edge[:, [0, -1]] = True
        columns, count = self.nodes[edge], self.nodes.size
        return {
            "clamped": np.concatenate([d * count + columns.ravel() for d in range(3)]),
            "supported": 2 * count + columns.ravel(),
            "supported_lower_edge": 2 * count + columns[:, 0],
            "supported_middle": 2 * count + columns,
        }.get(sides, np.array([], int))

    def impact(self, sides: str, dt: float = 1e-8) -> tuple[float, float]:
        """Restitution of the ball, peak force [N]."""
        ball = RHO * 4.0 / 3.0 * np.pi * RADIUS**3
        hertz = 4.0 / 3.0 * E / (2.0 * (1.0 - NU**2)) * np.sqrt(RADIUS)
        inverse, held = 1.0 / self.mass, self.held(sides)
        columns = held if sides == "supported_middle" else None  # there, only the sum of a column with `middle`
        if columns is None:
            inverse[held] = 0.0
        else:
            middle = in_the_middle(self.through, THICKNESS)
            pull = inverse[columns] * middle / (inverse[columns] @ middle**2)[:, None]
        along = in_the_middle(self.along, SIDE)
        across = np.outer(along, along)
        near = across > 1e-12
        hit, share = 2 * self.nodes.size + self.nodes[:, :, -1][near], across[near]

        u, v, a = np.zeros((3, self.mass.size))
        z, speed, push, peak = 0.0, -SPEED, 0.0, 0.0
        for _ in range(round(DURATION / dt)):
            v += 0.5 * dt * a
            speed += 0.5 * dt * push / ball
            u += dt * v
            z += dt * speed
            push = hertz * max(share @ u[hit] - z, 0.0) ** 1.5
            peak = max(peak, push)
            force = -(self.stiffness @ u)
            force[hit] -= push * share
            a = inverse * force
            if columns is not None:
                a[columns] -= pull * (a[columns] @ middle)[:, None]
            v += 0.5 * dt * a
            speed += 0.5 * dt * push / ball
        assert push == 0.0, "the contact has not ended"
        return speed / SPEED, peak


def main(words: list[str]) -> None:
    plate = Plate(int(words[0]), int(words[1]), float(words[3]) if len(words) > 3 else 1.0)
    dt = float(words[2]) if len(words) > 2 else 1e-8
    found = {sides: plate.impact(sides, dt) for sides in SIDES}
    for sides, (e, peak) in found.items():
        print(f"{sides:22s} {e:.5f}  {peak:.5f} N  {found['clamped'][0] - e:.5f}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])

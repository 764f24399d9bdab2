# SPDX-License-Identifier: GPL-2.0-or-later
"""Plane strain: one element through the thickness, u_z = 0.  Stresses are worked out here from the displacements."""

from __future__ import annotations

import math
from typing import Callable, Sequence

import numpy as np

import spline
from solve import ALL, Benchmark, Model, Solve, Solved, fix, model, one_row, order
from study.run.summary import Row

Array = np.ndarray
Stress = Callable[[Array, Array], Array]  # of x, y: [points][xx, yy, xy]
ARC = [1.0, math.sqrt(0.5), 1.0]  # weights of a quarter circle


def plane_strain_of(E: float, nu: float) -> tuple[float, float]:
    """Constants whose plane strain is the plane stress of E and nu."""
    return E * (1 + 2 * nu) / (1 + nu) ** 2, nu / (1 + nu)


def quarter_ring(a: float, b: float, n: int, p: int) -> Model:
    """n x n elements of degree p along radius and angle, the plane x, y; the angle runs from the x axis to the y axis."""
    points = [[r * x, r * y, z] for z in (0.0, 1.0) for x, y in ((1, 0), (1, 1), (0, 1)) for r in (a, b)]
    patch = {
        "degrees": [1, 2, 1], "knots": [[0, 0, 1, 1], [0, 0, 0, 1, 1, 1], [0, 0, 1, 1]],
        "control_points": points, "weights": [w for _ in range(2) for w in ARC for _ in range(2)],
    }  # fmt: skip
    return {"patches": [patch], "refine": {"degree": [p, p, 1], "divide": [n, n, 1]}}


class Ring:
    """The solved state of a quarter ring, of Lame's constants lambda, mu."""

    def __init__(self, solved: Solved, n: int, p: int, constants: tuple[float, float]):
        E, nu = constants
        self.lam, self.mu = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
        angular = spline.weights_of(p, n, ARC)
        weights = np.tile(np.repeat(angular, n + p), 2)
        self.n, self.p, self.u = n, p, solved.state["displacement"]
        self.patch = spline.Patch([p, p, 1], [n, n, 1], solved.state["reference"], weights)

    def stress(self, r: Array, angle: Array) -> tuple[Array, Array, Array]:
        """Places, [xx, yy, xy] and the Jacobian of the plane at parameters r x angle."""
        X, H, J = self.patch.gradients(self.u, [r, angle, np.array([0.5])])
        strain = 0.5 * (H + H.transpose(0, 2, 1))
        trace = self.lam * np.trace(strain, axis1=1, axis2=2)
        S = np.stack([trace + 2 * self.mu * strain[:, 0, 0], trace + 2 * self.mu * strain[:, 1, 1],
                      2 * self.mu * strain[:, 0, 1]], axis=1)  # fmt: skip
        return X, S, np.linalg.det(J[:, :2, :2])

    def stress_error(self, exact: Stress) -> float:
        """L2 norm of the error of the stress over that of the stress."""
        at, w = spline.gauss(self.p, self.n)
        X, S, area = self.stress(at, at)
        reference = exact(X[:, 0], X[:, 1])
        weight = area * np.kron(w, w)
        square = [weight @ (T**2 @ [1.0, 1.0, 2.0]) for T in (S - reference, reference)]
        return math.sqrt(square[0] / square[1])


def lame_stress(x: Array, y: Array) -> Array:
    """Of a ring a = 1, b = 2 under an inner pressure 1."""
    r2 = x * x + y * y
    radial, hoop, cc, ss, cs = (1 - 4 / r2) / 3, (1 + 4 / r2) / 3, x * x / r2, y * y / r2, x * y / r2
    return np.stack([radial * cc + hoop * ss, radial * ss + hoop * cc, (radial - hoop) * cs], axis=1)


def lame(solve: Solve, n: int, p: int) -> tuple[float, float]:
    """Errors of u(a), relative, and of the stress."""
    E, nu = 1000.0, 0.3
    solved = solve(
        model(quarter_ring(1.0, 2.0, n, p), ("linear_elastic", E, nu, 1.0), [fix(["y"], "eta-"), fix(["x"], "eta+"), fix(["z"])],
              {"kind": "static", "tolerance": 1e-11, "save": "state.h5"},
              loads={"tractions": [{"face": "xi-", "value": ["x", "y", 0]}]})
    )  # fmt: skip
    return solved.state["displacement"][0, 0] / (1.43 / 750) - 1.0, Ring(solved, n, p, (E, nu)).stress_error(lame_stress)


def kirsch_stress(x: Array, y: Array) -> Array:
    """Around a hole of radius 1 in an infinite plate under a tension 1 along x."""
    r2, angle = x * x + y * y, np.arctan2(y, x)
    q, q2, c2, s2, c4, s4 = 1 / r2, 1 / r2**2, *(f(k * angle) for k in (2, 4) for f in (np.cos, np.sin))
    return np.stack(
        [1 - q * (1.5 * c2 + c4) + 1.5 * q2 * c4, -q * (0.5 * c2 - c4) - 1.5 * q2 * c4, -q * (0.5 * s2 + s4) + 1.5 * q2 * s4],
        axis=1,
    )


# The same along the normal of the circle r = 4, as expressions of a model file.
R2, ANGLE = "(x^2+y^2)", "atan2(y,x)"
XX = f"(1-(1.5*cos(2*{ANGLE})+cos(4*{ANGLE}))/{R2}+1.5*cos(4*{ANGLE})/{R2}^2)"
YY = f"(-(0.5*cos(2*{ANGLE})-cos(4*{ANGLE}))/{R2}-1.5*cos(4*{ANGLE})/{R2}^2)"
XY = f"(-(0.5*sin(2*{ANGLE})+sin(4*{ANGLE}))/{R2}+1.5*sin(4*{ANGLE})/{R2}^2)"
KIRSCH_TRACTION = [f"({XX}*x+{XY}*y)/sqrt{R2}", f"({XY}*x+{YY}*y)/sqrt{R2}", 0]


def kirsch(solve: Solve, n: int, p: int) -> tuple[float, float]:
    """Stress concentration sigma_xx at (0, 1), and the error of the stress."""
    constants = plane_strain_of(1e5, 0.3)
    solved = solve(
        model(quarter_ring(1.0, 4.0, n, p), ("linear_elastic", *constants, 1.0),
              [fix(["y"], "eta-"), fix(["x"], "eta+"), fix(["z"])],
              {"kind": "static", "tolerance": 1e-11, "save": "state.h5"},
              loads={"tractions": [{"face": "xi+", "value": KIRSCH_TRACTION}]})
    )  # fmt: skip
    ring = Ring(solved, n, p, constants)
    concentration = ring.stress(np.array([0.0]), np.array([1.0]))[1][0, 0]
    return concentration, ring.stress_error(kirsch_stress)


def in_plane(name: str, p: int, n: int) -> str:
    return f"{name} ({n} x {n} x 1, p = {p})"


def lame_ring(p: int, meshes: Sequence[int], u_errors: Sequence[float], stress_errors: Sequence[float]) -> Benchmark:
    """Errors at most twice those of an independent code on the same meshes; their orders between the two finest."""
    name = "Lame's ring"

    def rows(solve: Solve) -> list[Row]:
        seen = [lame(solve, n, p) for n in meshes]
        found = []
        for n, (u, stress), own_u, own_stress in zip(meshes, seen, u_errors, stress_errors):
            found.append(Row(in_plane(name, p, n), "error of u(a)", u, "", 0.0, 2 * own_u))
            found.append(Row(in_plane(name, p, n), "error of the stress, L2", stress, "", 0.0, 2 * own_stress))
        last = in_plane(name, p, meshes[-1])
        return [
            *found,
            order(last, "u(a)", seen[-2][0], seen[-1][0], 2 * p, 0.5),
            order(last, "the stress", seen[-2][1], seen[-1][1], p, 0.25),
        ]

    return Benchmark(name, rows)


def plate_with_hole(p: int, meshes: Sequence[int], stress_errors: Sequence[float], K_t: Sequence[float]) -> Benchmark:
    """As above; the stress concentration is 3, and at most twice as far off as that code's."""
    name = "plate with a hole"

    def rows(solve: Solve) -> list[Row]:
        seen = [kirsch(solve, n, p) for n in meshes]
        found = []
        for n, (concentration, stress), own, own_K in zip(meshes, seen, stress_errors, K_t):
            found.append(Row(in_plane(name, p, n), "error of the stress, L2", stress, "", 0.0, 2 * own))
            if own_K:
                found.append(Row(in_plane(name, p, n), "stress concentration", concentration, "", 3.0, 2 * (own_K / 3 - 1)))
        return [*found, order(in_plane(name, p, meshes[-1]), "the stress", seen[-2][1], seen[-1][1], p, 0.25)]

    return Benchmark(name, rows)


def cook(n: int, p: int, reference: float, tolerance: float) -> Benchmark:
    """Cook's membrane, F = 1, plane stress of E = 1, nu = 1/3: deflection of the middle of the end."""
    corners = [[0, 0], [48, 44], [0, 44], [48, 60]]
    patch = {
        "degrees": [1, 1, 1], "knots": [[0, 0, 1, 1]] * 3, "control_points": [[*xy, z] for z in (0.0, 1.0) for xy in corners],
    }  # fmt: skip
    return one_row(
        "Cook's membrane", f"{n} x {n} x 1, p = {p}", "u_y(48, 52)",
        model({"patches": [patch], "refine": {"degree": [p, p, 1], "divide": [n, n, 1]}},
              ("linear_elastic", *plane_strain_of(1.0, 1 / 3), 1.0), [fix(ALL, "xi-"), fix(["z"])],
              {"kind": "static", "tolerance": 1e-10}, loads={"tractions": [{"face": "xi+", "value": [0, 1 / 16, 0]}]},
              probes={"end": {"face": "xi+", "at": [0.5, 0.5]}}),
        lambda solved: solved.probe("end")[1], reference, tolerance,
    )  # fmt: skip


SAME_MESH = 1e-5
BENCHMARKS = [
    lame_ring(2, [2, 4, 8], [9.5e-4, 6.7e-5, 4.3e-6], [4.6e-2, 1.2e-2, 3.1e-3]),
    lame_ring(3, [4, 8], [7.1e-7, 1.4e-8], [1.2e-3, 1.7e-4]),
    plate_with_hole(2, [4, 8, 16, 32], [3.8e-2, 1.3e-2, 3.6e-3, 9.2e-4], [0, 0, 3.0208, 3.0063]),
    plate_with_hole(3, [8, 16, 32], [3.2e-3, 4.7e-4, 6.5e-5], [3.0168, 3.0033, 0]),
    *(cook(n, 2, value, SAME_MESH) for n, value in ((8, 23.9150), (16, 23.9441), (32, 23.9590), (64, 23.9643))),
    *(cook(n, 3, value, SAME_MESH) for n, value in ((32, 23.9633), (64, 23.9660))),
]

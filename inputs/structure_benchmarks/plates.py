# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates, and a roof: solids that are thin."""

from __future__ import annotations

import math
from typing import Sequence

from solve import ALL, Benchmark, Model, box, fix, mesh_of, model, one_row


def quarter(h: float, clamped: bool, elements: Sequence[int]) -> tuple[Model, list[Model]]:
    """Of a plate of unit width: its box, and what holds it.  Simply supported: nothing moves along the sides but u_n."""
    sides = [fix(ALL, "xi-", "eta-")] if clamped else [fix(["y", "z"], "xi-"), fix(["x", "z"], "eta-")]
    return box([0.5, 0.5, h], elements, [3, 3, 2]), [*sides, fix(["x"], "xi+"), fix(["y"], "eta+")]


def frequency(h: float, reference: float, clamped: bool, elements: Sequence[int], tolerance: float, shear: str = "plain") -> Benchmark:
    """omega a^2 sqrt(rho h / D) of the first mode; of corrected shear with the consistent mass, whose error is small beside it."""
    E, nu = 1.0, 0.3
    D = E * h**3 / (12 * (1 - nu**2))
    geometry, boundary = quarter(h, clamped, elements)
    return one_row(
        f"{'clamped' if clamped else 'supported'} plate, h/a = {h:g}{', shear corrected' if shear == 'corrected' else ''}",
        mesh_of(elements, [3, 3, 2]), "omega a^2 sqrt(rho h/D)",
        model(geometry, ("linear_elastic", E, nu, 1.0), boundary,
              {"kind": "modes", "count": 1, "mass": "consistent" if shear == "corrected" else "lumped"}, integration={"shear": shear}),
        lambda solved: 2 * math.pi * solved.frequencies()[0] * math.sqrt(h / D), reference, tolerance,
    )  # fmt: skip


def table_2_plate() -> Benchmark:
    """The plate of the paper's Table 2, a quarter of it, four sides fixed."""
    elements = [20, 20, 4]
    return one_row(
        "the paper's plate", mesh_of(elements, 3), "first frequency [Hz]",
        model(box([0.305, 0.305, 0.0501], elements, 3), ("linear_elastic", 210.6e9, 0.286, 7850.0),
              [fix(ALL, "xi-", "eta-"), fix(["x"], "xi+"), fix(["y"], "eta+")], {"kind": "modes", "count": 1}),
        lambda solved: solved.frequencies()[0], 1128.0, 5e-3,
    )  # fmt: skip


def under_pressure(clamped: bool, reference: float) -> Benchmark:
    """w D / (q a^4) at the middle of a thin plate."""
    E, nu, h, q, elements = 1e6, 0.3, 0.01, 1e-3, [16, 16, 1]
    D = E * h**3 / (12 * (1 - nu**2))
    geometry, boundary = quarter(h, clamped, elements)
    return one_row(
        f"{'clamped' if clamped else 'supported'} plate under pressure", mesh_of(elements, [3, 3, 2]), "w D/(q a^4)",
        model(geometry, ("linear_elastic", E, nu, 1.0), boundary, "static",
              loads={"tractions": [{"face": "zeta+", "value": [0, 0, q]}]},
              probes={"middle": {"face": "zeta-", "at": [1.0, 1.0]}}),
        lambda solved: solved.probe("middle")[2] * D / q, reference, 5e-3,
    )  # fmt: skip


def roof(elements: int, degree: int, reference: float, tolerance: float = 3e-3) -> Benchmark:
    """Scordelis and Lo's roof, solid, one layer: 80 degrees of a cylinder, R = 25, L = 50, t = 0.25, 90 per area."""
    half, R, t = math.radians(40), 25.0, 0.25
    angles = [(-half, 1.0, 1.0), (0.0, 1.0 / math.cos(half), math.cos(half)), (half, 1.0, 1.0)]
    points, weights = [], []
    for r in (R - t / 2, R + t / 2):
        for y in (0.0, 50.0):
            for angle, further, weight in reversed(angles):  # right-handed
                points.append([-r * further * math.sin(angle), y, r * further * math.cos(angle)])
                weights.append(weight)
    patch = {
        "degrees": [2, 1, 1], "knots": [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 1, 1]],
        "control_points": points, "weights": weights,
    }  # fmt: skip
    refine = {"degree": [degree, degree, 2], "divide": [elements, elements, 1]}
    return one_row(
        "Scordelis-Lo roof", mesh_of([elements, elements, 1], [degree, degree, 2]), "deflection of the free edge",
        model({"patches": [patch], "refine": refine}, ("linear_elastic", 4.32e8, 0.0, 1.0),
              [fix(["x", "z"], "eta-", "eta+"), {"fix": ["y"], "corner": ["xi-", "eta-", "zeta-"]}], "static",
              loads={"gravity": [0, 0, -90.0 / t]},
              probes={"edge": {"face": "xi+", "at": [0.5, 0.5]}}),
        lambda solved: -solved.probe("edge")[2], reference, tolerance,
    )  # fmt: skip


BENCHMARKS = [
    frequency(0.2, 17.52602, False, [20, 20, 6], 5e-3),
    frequency(0.1, 19.09005, False, [16, 16, 4], 5e-3),
    frequency(0.2, 17.52602, False, [12, 12, 1], 5e-4, "corrected"),  # 1.0 % too high without that
    frequency(0.1, 19.09005, False, [12, 12, 1], 5e-4, "corrected"),  # 0.3 %
    frequency(0.02, 19.71164, False, [16, 16, 1], 5e-3),
    frequency(0.01, 19.73229, False, [16, 16, 1], 5e-3),
    frequency(0.05, 35.11, True, [20, 20, 2], 1e-2),
    table_2_plate(),
    under_pressure(False, 0.0040624),
    under_pressure(True, 0.0012653),
    roof(16, 2, 0.2941), roof(32, 2, 0.3006), roof(8, 3, 0.3003), roof(16, 3, 0.3009),
]  # fmt: skip

# SPDX-License-Identifier: GPL-2.0-or-later
"""A glass ball on a thin glass plate: here the structure decides the answer.

Two references: an independent code on the same mesh (3D solid, 26 x 26 x 1 quadratic elements of
1 mm, contact at a knot corner), and Zener's theory of a thin plate, which the mesh meets to 2 %:
it is as coarse as the plate is thick.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Mapping

import numpy as np

from study import hertz
from study.case import Case, Figure, Result, Study, Values, material
from study.figures import Curve, Line, force_figure
from study.pulse import measure
from study.summary import Row
from study.zener import ThinPlateImpact, plate_mobility

GLASS = material(Path(__file__).parent / "thin_plate.yaml")
THICKNESS = 1.0e-3  # of the plate [m]

# quantity: (reference, relative tolerance)
SAME_MESH = {"restitution": (0.7619, 3e-3), "peak_force": (4.876, 3e-3)}

# Tolerances against Zener: 0.010 of the restitution (and so of impulse/(m V)); peak, duration.
ZENER_RESTITUTION = 0.010
ZENER_RELATIVE = 0.02


def fixed_wall(values: Values) -> hertz.Impact:
    """The impact as it would be on a plate that does not move."""
    glass = (GLASS["youngs_modulus"], GLASS["poissons_ratio"])
    E_star = hertz.effective_modulus(values["E_ball"], values["nu_ball"], *glass)
    sphere = (values["r"], values["rho"], values["V"])
    return hertz.penalty_impact("hertz", values["lambda"], E_star, *sphere)


def zener(values: Values) -> ThinPlateImpact:
    rigid = fixed_wall(values)
    glass = (GLASS["youngs_modulus"], GLASS["poissons_ratio"], GLASS["density"])
    return ThinPlateImpact(rigid.m, rigid.V, rigid.k, plate_mobility(*glass, THICKNESS))


def steps(values: Values) -> int:
    """A bit longer than the contact."""
    return math.ceil(1.1 * zener(values).duration / values["dt"])


def same_mesh_rows(result: Result) -> list[Row]:
    """Against the same mesh, if nothing was changed; and the momentum of ball and free plate."""
    force, state = result.force, result.state
    seen = measure(force["t"], force["F"], force["overlap"])
    measured = {
        "restitution": state["v"][-1] / result.values["V"],
        "peak_force": seen.peak_force,
    }
    published = SAME_MESH if result.as_published else {}
    rows = [
        Row(result.case, quantity, value, unit, *published.get(quantity, ()))
        for (quantity, value), unit in zip(measured.items(), ("1", "N"))
    ]
    start = fixed_wall(result.values).m * result.values["V"]
    drift = np.abs(fixed_wall(result.values).m * state["v"] + state["p"] + start).max() / start
    return [*rows, Row(result.case, "momentum_balance", drift, "1", 0.0, 1e-12)]


def zener_rows(result: Result) -> list[Row]:
    """Against the theory of thin plates."""
    force, theory = result.force, zener(result.values)
    seen = measure(force["t"], force["F"], force["overlap"])
    e, expected_e = result.state["v"][-1] / result.values["V"], theory.restitution
    w = np.interp(seen.end, force["t"], force["plate_displacement"])
    impulse_tolerance = ZENER_RESTITUTION / (1.0 + expected_e)
    return [
        Row(result.case, "restitution", e, "1", expected_e, ZENER_RESTITUTION / expected_e),
        Row(result.case, "peak_force", seen.peak_force, "N", theory.peak_force, ZENER_RELATIVE),
        Row(result.case, "duration", seen.duration, "s", theory.duration, ZENER_RELATIVE),
        Row(result.case, "impulse", seen.impulse, "N s", theory.impulse, impulse_tolerance),
        Row(
            result.case,
            "plate_displacement_at_end",
            w,
            "m",
            note=f"thin plate: {theory.plate_displacement:.4g}",
        ),
    ]


def draw(path: Path, results: Mapping[str, Result]) -> None:
    result = results["Z1"]
    theory, rigid = zener(result.values), fixed_wall(result.values)
    curve = Curve("3D elements of 1 mm", result.force["t"], result.force["F"], theory.force)
    lines = [Line("Hertz, plate held still", rigid.force, "--")]
    force_figure(path, "Glass ball on a 1 mm glass plate", [curve], "Zener (1941)", lines)


STUDY = Study(
    cases=[
        Case("Z1", "in.thin_plate", same_mesh_rows, steps=steps),
        Case("Z1_zener", "in.thin_plate", zener_rows, steps=steps),
    ],
    figures=[Figure("force.png", ["Z1"], draw)],
)

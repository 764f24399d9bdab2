# SPDX-License-Identifier: GPL-2.0-or-later
"""What is read from a run: peak force and restitution of a ball; and how long it lasts."""

from __future__ import annotations

import math
from pathlib import Path

from study.reference import hertz
from study.run.case import Result, Values
from study.run.pulse import measure
from study.run.summary import Row

HERE = Path(__file__).parent
DECK = "in.mesh_study"
STEEL = {"law": "linear_elastic", "youngs_modulus": "210.6e9", "poissons_ratio": 0.286, "density": 7850}


def impact(values: Values) -> hertz.Impact:
    """The ball on a half-space that does not move."""
    E_star = hertz.effective_modulus(*(values[name] for name in ("E_ball", "nu_ball", "E_wall", "nu_wall")))
    return hertz.penalty_impact("hertz", 1.0, E_star, values["r"], values["rho"], values["V"])


def steps(longer: float, values: Values) -> int:
    return math.ceil(longer * impact(values).duration / values["dt"])


def peak_force(result: Result) -> float:
    """[N]"""
    force = result.force
    return measure(force["t"], force["F"], force["overlap"]).peak_force


def contact_radius(values: Values) -> float:
    """Where the contact is deepest [m]."""
    return math.sqrt(values["r"] * impact(values).max_overlap)


def rows(
    peak: tuple[float, float] | tuple[()], restitution: tuple[float, float] | tuple[()], result: Result, balls: int = 1
) -> list[Row]:
    """Each with reference and relative tolerance, if the user changed nothing; the force of one of as many equal balls."""
    F, e = peak_force(result) / balls, result.state["v"][-1] / result.values["V"]
    known = result.as_published
    return [
        Row(result.case, "peak_force", F, "N", *(peak if known else ())),
        Row(result.case, "restitution", e, "1", *(restitution if known else ())),
    ]

# SPDX-License-Identifier: GPL-2.0-or-later
"""Balls on thin plates: here the structure decides the answer.

Two references: an independent code on the same mesh (3D solids, one quadratic element through the thickness, as wide as
the plate is thick, contact at a knot corner), and Zener's theory of thin plates, which such a mesh meets to 2 %.  An effect
smaller than that is compared as a difference of two runs: how the sides are held.
"""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Mapping

import numpy as np
import yaml

from study.reference import hertz
from study.reference.mindlin import SquarePlate
from study.reference.zener import ThinPlateImpact, plate_mobility
from study.run.case import Case, Comparison, Figure, Result, Study, Values, material, read_csv
from study.run.figures import Curve, Line, Mark, force_figure, restitution_figure
from study.run.pulse import Pulse, measure
from study.run.summary import Row
from study.run.usage import one_of

HERE = Path(__file__).parent
GLASS_BALL = {"E_ball": 74.6e9, "nu_ball": 0.2285, "rho": 2480.0}
STEEL_BALL = {"E_ball": 210.6e9, "nu_ball": 0.286, "rho": 7850.0}

# case: restitution and peak force [N] on the same mesh; relative tolerance of both.
SAME_MESH = {"Z1": (0.7619, 4.876), "Z2": (0.5403, 9.558), "Z3": (0.2560, 15.910)}
SAME_MESH_TOLERANCE = 3e-3

# Against Zener: 0.010 of the restitution (and so of impulse/(m V)); peak force; duration.
ZENER_RESTITUTION = 0.010
ZENER_RELATIVE = 0.02
# The finest elements: the Hertz law has the local indentation, and they add 0.8 F/(E' h) of it once more.
ZENER_PEAK_FINEST = 0.03

# How the sides of a small plate are held: restitution and peak force [N] on the same mesh, by another independent code
# (tests/inputs/thin_plate/solid_plate.py); and what clamping them adds to the restitution, absolute tolerance.
SIDES = {"sides_supported": (0.76666, 4.78808), "sides_clamped": (0.76865, 4.78815)}
SIDES_SAME_MESH_TOLERANCE = 1e-4
SIDES_TOLERANCE = 0.001
# Steps per contact, and the energy that comes from nowhere, at most, in that of the ball.
STEPS_PER_CONTACT = (1000, 200)
ENERGY_GAIN = 2e-5


def model_file(values: Values) -> Path:
    """Of the deck's variable `plate`."""
    names = sorted(path.stem for path in HERE.glob("*.yaml"))
    return HERE / f"{one_of('plate', values['plate'], names)}.yaml"


def size(file: Path) -> tuple[float, float, float]:
    """Of the plate in a model file [m]."""
    return tuple(map(float, yaml.safe_load(file.read_text(encoding="utf-8"))["geometry"]["box"]["size"]))


def properties(file: Path) -> tuple[float, float, float]:
    """E [Pa], nu, rho [kg/m^3] of a plate."""
    found = material(file)
    return tuple(found[name] for name in ("youngs_modulus", "poissons_ratio", "density"))


def fixed_wall(values: Values) -> hertz.Impact:
    """The impact as it would be on a plate that does not move."""
    E_star = hertz.effective_modulus(values["E_ball"], values["nu_ball"], values["E_plate"], values["nu_plate"])
    sphere = (values["r"], values["rho"], values["V"])
    return hertz.penalty_impact("hertz", values["lambda"], E_star, *sphere)


def zener(values: Values) -> ThinPlateImpact:
    rigid, file = fixed_wall(values), model_file(values)
    mobility = plate_mobility(*properties(file), size(file)[2])
    return ThinPlateImpact(rigid.m, rigid.V, rigid.k, mobility)


def mindlin(values: Values, sides: str) -> float:
    """Restitution on the plate as it is, with its sides."""
    file = model_file(values)
    side, _, thickness = size(file)
    return SquarePlate(*properties(file), thickness, side, sides).restitution(fixed_wall(values), values["dt"])


def steps(values: Values) -> int:
    """A bit longer than the contact."""
    return math.ceil(1.1 * zener(values).duration / values["dt"])


def pulse(result: Result) -> Pulse:
    return measure(result.force["t"], result.force["F"], result.force["overlap"])


def restitution(result: Result) -> float:
    """Speed of the ball after / before."""
    return result.state["v"][-1] / result.values["V"]


def momentum_row(result: Result) -> Row:
    """Of ball and free plate together: largest change over m V."""
    m, state = fixed_wall(result.values).m, result.state
    start = m * result.values["V"]
    drift = np.abs(m * state["v"] + state["p"] + start).max() / start
    return Row(result.case, "momentum_balance", drift, "1", 0.0, 1e-12)


def impact_rows(result: Result, published: tuple[float, float] | None = None, tolerance: float = 0.0) -> list[Row]:
    """Restitution and peak force; against the same mesh, if there is one and nothing was changed."""
    measured = (("restitution", restitution(result), "1"), ("peak_force", pulse(result).peak_force, "N"))
    compared = published if published and result.as_published else (None, None)
    return [
        Row(result.case, *seen, reference, None if reference is None else tolerance)
        for seen, reference in zip(measured, compared)
    ]


def same_mesh_rows(result: Result) -> list[Row]:
    """Of a free plate; and the balance of momentum."""
    return [*impact_rows(result, SAME_MESH[result.case], SAME_MESH_TOLERANCE), momentum_row(result)]


def held_rows(result: Result) -> list[Row]:
    """Of a plate whose sides are held."""
    return impact_rows(result, SIDES[result.case], SIDES_SAME_MESH_TOLERANCE)


def zener_rows(peak_tolerance: float, result: Result) -> list[Row]:
    """Against the theory of thin plates."""
    force, theory, seen = result.force, zener(result.values), pulse(result)
    e = theory.restitution
    w = np.interp(seen.end, force["t"], force["plate_displacement"])
    row = partial(Row, result.case)
    return [
        row("lambda_zener", theory.inelasticity, "1"),
        row("restitution", restitution(result), "1", e, ZENER_RESTITUTION / e),
        row("peak_force", seen.peak_force, "N", theory.peak_force, peak_tolerance),
        row("duration", seen.duration, "s", theory.duration, ZENER_RELATIVE),
        row("impulse", seen.impulse, "N s", theory.impulse, ZENER_RESTITUTION / (1.0 + e)),
        row("plate_displacement_at_end", w, "m", note=f"thin plate: {theory.plate_displacement:.4g}"),
    ]


def free_plate_rows(peak_tolerance: float, result: Result) -> list[Row]:
    return [*zener_rows(peak_tolerance, result), momentum_row(result)]


def energy_gain(result: Result) -> float:
    """Of ball and plate over the whole contact, over the ball's energy before."""
    end, ball = read_csv(result.folder / "energy.csv")[-1], fixed_wall(result.values)
    before, plate = 0.5 * ball.m * ball.V**2, end["kinetic"] + end["strain"]
    return float((end["v"] / ball.V) ** 2 - 1.0 + plate / before)


def energy_rows(result: Result) -> list[Row]:
    reference = (0.0, ENERGY_GAIN) if result.as_published else ()
    return [*impact_rows(result), Row(result.case, "energy_gain", energy_gain(result), "1", *reference)]


def sides_rows(results: Mapping[str, Result]) -> list[Row]:
    """What comes back from the sides of a small plate depends on how they are held."""
    seen, expected = (
        of("clamped") - of("supported")
        for of in (
            lambda how: restitution(results[f"sides_{how}"]),
            lambda how: mindlin(results[f"sides_{how}"].values, how),
        )
    )
    tolerance = SIDES_TOLERANCE / expected
    return [Row("sides_clamped", "restitution_minus_supported", seen, "1", expected, tolerance)]


def of_plate(name: str) -> dict[str, float | str]:
    """The deck's variables for a plate."""
    E, nu, _ = properties(HERE / f"{name}.yaml")
    return {"plate": name, "E_plate": E, "nu_plate": nu}


def both(name: str, plate_name: str, ball: Mapping[str, float], r: float) -> list[Case]:
    """One run, compared with the same mesh and with Zener."""
    variables = {**of_plate(plate_name), **ball, "r": r}
    rows = partial(zener_rows, ZENER_RELATIVE)
    return [
        Case(name, "in.thin_plate", same_mesh_rows, variables, steps),
        Case(f"{name}_zener", "in.thin_plate", rows, variables, steps),
    ]


def steel(thickness_mm: float, peak_tolerance: float = ZENER_RELATIVE) -> Case:
    """The ball of Gao & Feng's Table 2 on a plate of their steel."""
    name = f"steel_{thickness_mm}mm"
    variables = {**of_plate(name), **GLASS_BALL}
    return Case(name, "in.thin_plate", partial(free_plate_rows, peak_tolerance), variables, steps)


def small(how: str) -> Case:
    return Case(f"sides_{how}", "in.thin_plate", held_rows, of_plate(f"glass_14mm_{how}"), steps)


def in_phase(steps_per_contact: int) -> Case:
    """Z2 with a time step of that part of the contact."""
    variables = {**of_plate("glass_36mm"), **STEEL_BALL, "r": 1.0e-3, "dt": Z2_DURATION / steps_per_contact}
    return Case(f"in_phase_{steps_per_contact}", "in.thin_plate", energy_rows, variables, steps)


Z2_DURATION = 9.81243e-6  # [s]
CASES = [
    *both("Z1", "glass_26mm", GLASS_BALL, 1.0e-3),
    *both("Z2", "glass_36mm", STEEL_BALL, 1.0e-3),
    *both("Z3", "glass_60mm", STEEL_BALL, 1.5e-3),
    *(steel(h) for h in (1.0, 0.75, 0.5)),
    steel(0.3, ZENER_PEAK_FINEST),
    *(small(how) for how in ("supported", "clamped")),
    *(in_phase(n) for n in STEPS_PER_CONTACT),
]

LABELS = {
    "Z1": "glass ball, 1 mm, on 1 mm glass",
    "Z2": "steel ball, 1 mm, on 1 mm glass",
    "Z3": "steel ball, 1.5 mm, on 1 mm glass",
    "steel_1.0mm": "glass ball, 1 mm, on 1 mm steel",
    "steel_0.75mm": "... on 0.75 mm steel",
    "steel_0.5mm": "... on 0.5 mm steel",
    "steel_0.3mm": "... on 0.3 mm steel",
}
ON_GLASS = [name for name in LABELS if name.startswith("Z")]
ON_STEEL = [name for name in LABELS if name.startswith("steel")]


def draw_forces(title: str, names: list[str], path: Path, results: Mapping[str, Result]) -> None:
    """Histories over Zener's; and for the first ball, what a plate that does not move would give."""
    curves = [
        Curve(LABELS[name], results[name].force["t"], results[name].force["F"], zener(results[name].values).force)
        for name in names
    ]
    rigid = Line("Hertz, plate held still, first ball", fixed_wall(results[names[0]].values).force, "--")
    force_figure(path, title, curves, "Zener (1941)", [rigid])


def draw_restitution(path: Path, results: Mapping[str, Result]) -> None:
    marks = [
        Mark(LABELS[name], zener(results[name].values).inelasticity, restitution(results[name])) for name in LABELS
    ]
    theory = [ThinPlateImpact(1.0, 1.0, 1.0, x) for x in np.linspace(0.0, 1.0, 101)]
    curve = (np.array([x.inelasticity for x in theory]), np.array([x.restitution for x in theory]))
    restitution_figure(path, marks, *curve)


STUDY = Study(
    cases=CASES,
    figures=[
        Figure("restitution.png", list(LABELS), draw_restitution),
        Figure("force.png", ON_GLASS, partial(draw_forces, "Balls on glass of 1 mm, 1 m/s", ON_GLASS)),
        Figure("force_steel.png", ON_STEEL, partial(draw_forces, "A glass ball on thin steel, 1 m/s", ON_STEEL)),
    ],
    comparisons=[Comparison(["sides_clamped", "sides_supported"], sides_rows)],
)

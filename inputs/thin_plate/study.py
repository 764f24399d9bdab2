# SPDX-License-Identifier: GPL-2.0-or-later
"""Balls on thin plates: here the structure decides the answer.

The reference is three-dimensional elasticity (study/reference/elastic_plate.py), for contacts that are corrected by what their
mesh gives way, on elements half as wide as the plate is thick.  Uncorrected ones, on one element through the thickness, as wide
as that, are compared with an independent program on the same mesh (study/reference/meshed_plate.py).  An effect smaller than
all that is compared as a difference of two runs: how the sides are held.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Mapping, Sequence

import numpy as np
import yaml

from study.reference import hertz
from study.reference.elastic_plate import ElasticPlateImpact
from study.reference.meshed_plate import MeshedPlate
from study.reference.mindlin import SquarePlate
from study.reference.zener import ThinPlateImpact
from study.run.case import Case, Comparison, Figure, Result, Study, Values, material, read_csv
from study.run.figures import Curve, Line, Mark, Theory, force_figure, restitution_figure
from study.run.pulse import Pulse, measure
from study.run.summary import Row
from study.run.usage import one_of

HERE = Path(__file__).parent
GLASS_BALL = {"E_ball": 74.6e9, "nu_ball": 0.2285, "rho": 2480.0}
STEEL_BALL = {"E_ball": 210.6e9, "nu_ball": 0.286, "rho": 7850.0}

# Without correction, on the same mesh: absolute of the restitution, relative of the peak force.
SAME_MESH_RESTITUTION, SAME_MESH_PEAK = 1e-4, 1e-4
# Corrected, against three-dimensional elasticity: absolute of the restitution (and so of impulse/(m V)), and relative.
ELASTIC_RESTITUTION, ELASTIC_PEAK, ELASTIC_DURATION, ELASTIC_DISPLACEMENT = 0.002, 0.004, 0.004, 0.01
FINE = "_fine"  # ends the name of a plate whose elements are halved

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
    return HERE / f"{one_of('plate', values['plate'].removesuffix(FINE), names)}.yaml"


def fine_model_file(values: Values) -> dict[str, str]:
    """The same plate in elements half as large in each direction."""
    if not values["plate"].endswith(FINE):
        return {}
    text, found = re.subn(
        r"elements: \[(\d+), (\d+), (\d+)\]",
        lambda match: f"elements: {[2 * int(n) for n in match.groups()]}",
        model_file(values).read_text(encoding="utf-8"),
    )
    assert found == 1, "a plate has one line of elements"
    return {f"{values['plate']}.yaml": text}


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


def elastic(values: Values) -> ElasticPlateImpact:
    rigid, file = fixed_wall(values), model_file(values)
    return ElasticPlateImpact(rigid.m, rigid.V, rigid.k, *properties(file), size(file)[2])


def zener(values: Values) -> ThinPlateImpact:
    return elastic(values).thin


def same_mesh(values: Values) -> tuple[float, float]:
    """Restitution and peak force [N] of the independent program."""
    file = model_file(values)
    side, _, thickness = size(file)
    across, _, layers = yaml.safe_load(file.read_text(encoding="utf-8"))["geometry"]["box"]["elements"]
    place = "centre" if across % 2 else "corner"
    plate = MeshedPlate(*properties(file), thickness, side / across, layers, place, side)
    return plate.impact(fixed_wall(values), values["dt"], corrected=False)


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
    """Of a free plate without correction; and the balance of momentum."""
    e, F = same_mesh(result.values)
    return [
        Row(result.case, "restitution", restitution(result), "1", e, SAME_MESH_RESTITUTION / e),
        Row(result.case, "peak_force", pulse(result).peak_force, "N", F, SAME_MESH_PEAK),
        momentum_row(result),
    ]


def held_rows(result: Result) -> list[Row]:
    """Of a plate whose sides are held."""
    return impact_rows(result, SIDES[result.case], SIDES_SAME_MESH_TOLERANCE)


def elastic_rows(result: Result) -> list[Row]:
    """Of a corrected contact, against three-dimensional elasticity; Zener's theory of thin plates beside it."""
    force, theory, thin, seen = result.force, elastic(result.values), zener(result.values), pulse(result)
    e = theory.restitution
    w = np.interp(seen.end, force["t"], force["plate_displacement"])
    row = partial(Row, result.case)

    def beside(value: float) -> dict[str, str]:
        return {"note": f"Zener: {value:.5g}"}

    return [
        row("lambda_zener", thin.inelasticity, "1"),
        row("restitution", restitution(result), "1", e, ELASTIC_RESTITUTION / e, **beside(thin.restitution)),
        row("peak_force", seen.peak_force, "N", theory.peak_force, ELASTIC_PEAK, **beside(thin.peak_force)),
        row("duration", seen.duration, "s", theory.duration, ELASTIC_DURATION, **beside(thin.duration)),
        row("impulse", seen.impulse, "N s", theory.impulse, ELASTIC_RESTITUTION / (1.0 + e), **beside(thin.impulse)),
        row("plate_displacement_at_end", w, "m", theory.plate_displacement, ELASTIC_DISPLACEMENT,
            **beside(thin.plate_displacement)),
        momentum_row(result),
    ]  # fmt: skip


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


def both(name: str, plate_name: str, ball: Mapping[str, float]) -> list[Case]:
    """Without correction, on the plate's own mesh; corrected, on a finer one."""
    variables = {**of_plate(plate_name), **ball}
    fine = {**variables, "plate": f"{plate_name}{FINE}", "compliance": "corrected"}
    return [
        Case(name, "in.thin_plate", same_mesh_rows, variables, steps),
        Case(f"{name}_corrected", "in.thin_plate", elastic_rows, fine, steps, fine_model_file),
    ]


def small(how: str) -> Case:
    return Case(f"sides_{how}", "in.thin_plate", held_rows, of_plate(f"glass_14mm_{how}"), steps)


def in_phase(steps_per_contact: int) -> Case:
    """Z2 with a time step of that part of the contact."""
    variables = {**of_plate("glass_36mm"), **STEEL_BALL, "r": 1.0e-3, "dt": Z2_DURATION / steps_per_contact}
    return Case(f"in_phase_{steps_per_contact}", "in.thin_plate", energy_rows, variables, steps)


Z2_DURATION = 9.81243e-6  # [s]
STEEL_PLATES = tuple(f"steel_{h}mm" for h in (1.0, 0.75, 0.5, 0.3))
CASES = [
    *both("Z1", "glass_26mm", {**GLASS_BALL, "r": 1.0e-3}),
    *both("Z2", "glass_36mm", {**STEEL_BALL, "r": 1.0e-3}),
    *both("Z3", "glass_60mm", {**STEEL_BALL, "r": 1.5e-3}),
    *(case for name in STEEL_PLATES for case in both(name, name, GLASS_BALL)),  # the ball of Gao & Feng's Table 2
    *(small(how) for how in ("supported", "clamped")),
    *(in_phase(n) for n in STEPS_PER_CONTACT),
]

LAMBDA = np.linspace(0.0, 1.0, 51)
LABELS = {
    "Z1": "glass ball, 1 mm, on 1 mm glass",
    "Z2": "steel ball, 1 mm, on 1 mm glass",
    "Z3": "steel ball, 1.5 mm, on 1 mm glass",
    "steel_1.0mm": "glass ball, 1 mm, on 1 mm steel",
    "steel_0.75mm": "... on 0.75 mm steel",
    "steel_0.5mm": "... on 0.5 mm steel",
    "steel_0.3mm": "... on 0.3 mm steel",
}
ON_GLASS = [f"{name}_corrected" for name in LABELS if name.startswith("Z")]
ON_STEEL = [f"{name}_corrected" for name in LABELS if name.startswith("steel")]
WITH_AND_WITHOUT = [f"{name}{how}" for name in LABELS for how in ("", "_corrected")]


def draw_forces(title: str, names: list[str], path: Path, results: Mapping[str, Result]) -> None:
    """Histories over those of elasticity; and for the first ball, what a plate that does not move would give."""
    curves = [
        Curve(LABELS[name.removesuffix("_corrected")], results[name].force["t"], results[name].force["F"],
              elastic(results[name].values).force)
        for name in names
    ]  # fmt: skip
    rigid = Line("Hertz, plate held still, first ball", fixed_wall(results[names[0]].values).force, "--")
    force_figure(path, title, curves, "three-dimensional elasticity", [rigid])


def restitutions(impacts: Sequence[ElasticPlateImpact | ThinPlateImpact]) -> tuple[np.ndarray, np.ndarray]:
    return np.array([x.inelasticity for x in impacts]), np.array([x.restitution for x in impacts])


def draw_restitution(path: Path, results: Mapping[str, Result]) -> None:
    """Corrected and uncorrected contacts over three-dimensional elasticity, of plates of each material, and Zener."""
    marks = [
        Mark(label, zener(results[name].values).inelasticity, restitution(results[name]),
             restitution(results[f"{name}_corrected"]))
        for name, label in LABELS.items()
    ]  # fmt: skip
    curves = [
        Theory("Zener (1941), thin plates", *restitutions([ThinPlateImpact(1.0, 1.0, 1.0, x) for x in LAMBDA]), "--"),
        *(Theory(f"elasticity, {words}", *restitutions([of(elastic(results[name].values), x) for x in LAMBDA[2:]]), style)
          for name, words, of, style in FAMILIES),
    ]  # fmt: skip
    restitution_figure(path, marks, curves)


def on_thickness(impact: ElasticPlateImpact, inelasticity: float) -> ElasticPlateImpact:
    """On a plate so thick that Zener's parameter, as 1/h^2, is that."""
    return replace(impact, h=impact.h * math.sqrt(impact.inelasticity / inelasticity))


def with_radius(impact: ElasticPlateImpact, inelasticity: float) -> ElasticPlateImpact:
    """Of a sphere so large that Zener's parameter, as r^2, is that."""
    factor = math.sqrt(inelasticity / impact.inelasticity)
    return replace(impact, m=factor**3 * impact.m, K=math.sqrt(factor) * impact.K)


FAMILIES = (
    ("steel_1.0mm", "a glass ball on steel of any thickness", on_thickness, "-"),
    ("Z1", "glass balls of any size on 1 mm of glass", with_radius, "-."),
    ("Z2", "steel balls of any size on 1 mm of glass", with_radius, ":"),
)
STUDY = Study(
    cases=CASES,
    figures=[
        Figure("restitution.png", WITH_AND_WITHOUT, draw_restitution),
        Figure("force.png", ON_GLASS, partial(draw_forces, "Balls on glass of 1 mm, 1 m/s", ON_GLASS)),
        Figure("force_steel.png", ON_STEEL, partial(draw_forces, "A glass ball on thin steel, 1 m/s", ON_STEEL)),
    ],
    comparisons=[Comparison(["sides_clamped", "sides_supported"], sides_rows)],
)

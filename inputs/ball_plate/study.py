# SPDX-License-Identifier: GPL-2.0-or-later
"""Table 2 of Gao & Feng (2019), its variations (their Figs. 6-11), and a free block.

References: the closed forms of study.reference.hertz at exactly the values that were run.  The plate is so
heavy that they hold to 0.02 %; what the plate itself does is compared with an independent code on
the same mesh (SAME_MESH).
"""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Mapping

import numpy as np
import yaml

from study.reference import hertz
from study.run.case import Case, Comparison, Figure, Result, Study, Values, material
from study.run.figures import Curve, Line, force_figure
from study.run.pulse import Pulse, measure
from study.run.summary import Row

HERE = Path(__file__).parent
STEEL = material(HERE / "plate.yaml")  # block.yaml has the same
LAWS = ("saint_venant_kirchhoff", "neo_hooke", "orthotropic_elastic")  # of the plate, beside its own

# What each variation sets; lambda of the linear and quadratic laws in mm, as in the paper.
HERTZ_LAMBDA = (0.6, 0.8, 1.0, 1.2)
BALL_E_GPA = (50.0, 74.6, 100.0, 200.0, 300.0)
BALL_NU = (0.1, 0.2285, 0.3, 0.4)
LINEAR_LAMBDA_MM = (0.03, 0.040165, 0.055, 0.055085, 0.07)  # 2nd: Hertz duration, 4th: Hertz peak
QUADRATIC_LAMBDA_MM = (10.0, 15.7585, 20.0, 23.5542, 30.0)  # 2nd: Hertz peak, 4th: Hertz duration

# Relative tolerances against the closed form; curve_error: largest |F - F_exact| over the peak.
TOLERANCE = {"peak_force": 1e-3, "duration": 2e-3, "impulse": 1e-3, "curve_error": 5e-3}

# quantity: (reference, relative tolerance), from an independent code on the same mesh.
SAME_MESH = {
    "table2": {
        "peak_force": (6.68524, 2e-4),
        "restitution": (0.99962, 2e-4 / 0.99962),
        "plate_displacement_at_peak": (3.26e-10, 0.05),
        "plate_displacement_at_end": (7.63e-10, 0.05),
        "stable_time_step": (9.19e-7, 0.04),
    },
    "free_block_centre": {
        "peak_force": (6.5764, 1e-3),
        "duration": (5.730e-6, 2e-3),
        "impulse": (2.052223e-5, 1e-3),
        "block_velocity": (2.42065e-2, 1e-3),
    },
    "free_block_offset": {
        "impulse": (2.038747e-5, 1e-3),
        "block_velocity": (2.404750e-2, 1e-3),
        # J b / I, as exact as J; I is the lumped one (the continuum's would give 9.619).
        "angular_velocity": (2.038747e-5 * 1.5e-3 / 3.532500e-9, 1e-3),
    },
}
SAME_MESH |= {f"plate_{law}": {q: SAME_MESH["table2"][q] for q in ("peak_force", "restitution")} for law in LAWS}
BLOCK_MASS = 8.478e-4  # [kg]
BLOCK_CENTRE_Z = -1.5e-3  # [m]
BLOCK_LUMPED_INERTIA = 3.532500e-9  # [kg m^2] about y through the centre, row-sum lumped mass

UNIT = {
    "peak_force": "N",
    "duration": "s",
    "impulse": "N s",
    "curve_error": "1",
    "restitution": "1",
    "plate_displacement_at_peak": "m",
    "plate_displacement_at_end": "m",
    "stable_time_step": "s",
    "block_velocity": "m/s",
    "angular_velocity": "rad/s",
}
LAMBDA_UNIT = {"linear": "m^(1/2)", "hertz": "1", "quadratic": "m^(-1/2)"}


def effective_modulus(values: Values) -> float:
    """E* [Pa] of the ball and the steel."""
    steel = (STEEL["youngs_modulus"], STEEL["poissons_ratio"])
    return hertz.effective_modulus(values["E_ball"], values["nu_ball"], *steel)


def fixed_wall(values: Values) -> hertz.Impact:
    """The impact as it would be on a plate that does not move."""
    law, lam = values.get("law", "hertz"), values["lambda"]
    sphere = (values["r"], values["rho"], values["V"])
    return hertz.penalty_impact(law, lam, effective_modulus(values), *sphere)


def steps(values: Values) -> int:
    """A bit longer than the contact."""
    return math.ceil(1.05 * fixed_wall(values).duration / values["dt"])


def pulse(result: Result) -> Pulse:
    return measure(result.force["t"], result.force["F"], result.force["overlap"])


def same_mesh_rows(result: Result, measured: dict[str, float]) -> list[Row]:
    """Rows against SAME_MESH; without references if the user changed what was computed there."""
    rows = []
    for quantity, value in measured.items():
        published = SAME_MESH[result.case].get(quantity) if result.as_published else None
        rows.append(Row(result.case, quantity, value, UNIT[quantity], *(published or (None, None))))
    return rows


def variation_rows(result: Result) -> list[Row]:
    """Force pulse against the closed form of the law and the values that were run."""
    exact, seen = fixed_wall(result.values), pulse(result)
    law, lam = result.values["law"], result.values["lambda"]
    in_mm = f"= {lam / hertz.si_factor(law):.6g} {LAMBDA_UNIT[law].replace('m', 'mm')}"
    deviation = np.abs(result.force["F"] - exact.force(result.force["t"])).max() / exact.peak_force
    compared = [
        ("peak_force", seen.peak_force, exact.peak_force),
        ("duration", seen.duration, exact.duration),
        ("impulse", seen.impulse, exact.impulse),
        ("curve_error", deviation, 0.0),
    ]
    rows = [Row(result.case, "lambda", lam, LAMBDA_UNIT[law], note="" if law == "hertz" else in_mm)]
    rows += [Row(result.case, q, x, UNIT[q], ref, TOLERANCE[q]) for q, x, ref in compared]
    return [*rows, Row(result.case, "restitution", restitution(result), "1")]


def restitution(result: Result) -> float:
    """Speed of the ball after / before."""
    return result.state["v"][-1] / result.values["V"]


def table2_rows(result: Result) -> list[Row]:
    """What the plate does, too: a rigid wall would pass the forces."""
    seen, force = pulse(result), result.force
    displacement = partial(np.interp, xp=force["t"], fp=force["plate_displacement"])
    measured = {
        "peak_force": seen.peak_force,
        "restitution": restitution(result),
        "plate_displacement_at_peak": displacement(seen.peak_time),
        "plate_displacement_at_end": displacement(seen.end),
        "stable_time_step": result.state["stable_time_step"][-1],
    }
    return same_mesh_rows(result, measured)


def plate_of_law(law: str, _: Values) -> Mapping[str, str]:
    """plate.yaml of another law with the same constants: LAW.yaml."""
    E, nu, density = (STEEL[key] for key in ("youngs_modulus", "poissons_ratio", "density"))
    constants = {"youngs_modulus": E, "poissons_ratio": nu}
    if law == "orthotropic_elastic":
        constants = {f"{key}_{axes}": value for key, value, all_axes in
                     (("E", E, (1, 2, 3)), ("nu", nu, (12, 13, 23)), ("G", E / (2 * (1 + nu)), (12, 13, 23)))
                     for axes in all_axes}  # fmt: skip
    model = yaml.safe_load((HERE / "plate.yaml").read_text(encoding="utf-8"))
    model["material"] = {"law": law, **constants, "density": density}
    return {f"{law}.yaml": yaml.safe_dump(model, default_flow_style=None)}


def law_rows(result: Result) -> list[Row]:
    return same_mesh_rows(result, {"peak_force": pulse(result).peak_force, "restitution": restitution(result)})


def same_force_rows(results: Mapping[str, Result]) -> list[Row]:
    """Steel strained by 1e-7 knows no difference between laws; the sums run in another order."""
    expected = results["table2"].force["F"]
    deviations = {f"plate_{law}": np.abs(results[f"plate_{law}"].force["F"] - expected).max() for law in LAWS}
    return [Row(case, "force_beside_table2", x / expected.max(), "1", 0.0, 1e-6) for case, x in deviations.items()]


def free_block_rows(result: Result) -> list[Row]:
    """Momentum and spin of a block that nothing holds."""
    seen, state = pulse(result), result.state
    measured = {
        "peak_force": seen.peak_force,
        "duration": seen.duration,
        "impulse": seen.impulse,
        "block_velocity": -state["pz"][-1] / BLOCK_MASS,
    }
    if result.values["offset"] != 0.0:
        about_centre = state["Ly"][-1] - BLOCK_CENTRE_Z * state["px"][-1]
        measured["angular_velocity"] = about_centre / BLOCK_LUMPED_INERTIA
    m, V = hertz.sphere_mass(result.values["r"], result.values["rho"]), result.values["V"]
    drift = max(
        np.abs(m * state["v" + axis] + state["p" + axis] - start).max()
        for axis, start in (("x", 0.0), ("y", 0.0), ("z", -m * V))
    )
    balance = Row(result.case, "momentum_balance", drift / (m * V), "1", 0.0, 1e-12)
    return [*same_mesh_rows(result, measured), balance]


def variation(name: str, **variables: float | str) -> Case:
    return Case(name, "in.ball_plate", variation_rows, variables, steps)


def penalty_variation(law: str, lam_mm: float) -> Case:
    """lambda in mm in the name, in SI in the deck."""
    lam = lam_mm * hertz.si_factor(law)
    return variation(f"{law}_lambda_{lam_mm:g}", **{"law": law, "lambda": lam})


CASES = [
    Case("table2", "in.ball_plate", table2_rows, steps=steps),
    *(variation(f"hertz_lambda_{lam}", **{"lambda": lam}) for lam in HERTZ_LAMBDA),
    *(variation(f"hertz_E_{E:g}GPa", E_ball=E * 1e9) for E in BALL_E_GPA),
    *(variation(f"hertz_nu_{nu}", nu_ball=nu) for nu in BALL_NU),
    *(penalty_variation("linear", lam) for lam in LINEAR_LAMBDA_MM),
    *(penalty_variation("quadratic", lam) for lam in QUADRATIC_LAMBDA_MM),
    *(Case(f"plate_{law}", "in.ball_plate", law_rows, {"plate": f"{law}.yaml"}, steps, partial(plate_of_law, law)) for law in LAWS),
    Case("free_block_centre", "in.free_block", free_block_rows, {"offset": 0.0}, steps),
    Case("free_block_offset", "in.free_block", free_block_rows, {"offset": 1.5e-3}, steps),
]


def paper_pulse(values: Values) -> hertz.PaperPulse:
    """Eqs. 35-37, with lambda E* for E* where a Hertz law has lambda other than 1."""
    E_star = values["lambda"] * effective_modulus(values)
    return hertz.PaperPulse(E_star, values["r"], values["rho"], values["V"])


def label(values: Values, varied: str) -> str:
    """Legend entry; lambda in mm and in SI."""
    law, lam = values["law"], values["lambda"]
    if varied == "E_ball":
        return rf"$E$ = {values['E_ball'] / 1e9:g} GPa"
    if varied == "nu_ball":
        return rf"$\nu$ = {values['nu_ball']:g}"
    if law == "hertz":
        return rf"Hertz, $\lambda$ = {lam:g}"
    power = "1/2" if law == "linear" else "-1/2"
    in_mm = rf"{lam / hertz.si_factor(law):.6g} mm$^{{{power}}}$"
    return rf"{law}, $\lambda$ = {in_mm} ({lam:.4g} m$^{{{power}}}$)"


def draw(
    title: str, varied: str, names: list[str], path: Path, results: Mapping[str, Result]
) -> None:
    """Curves over their closed forms and over eq. 35 (that of lambda = 1 where lambda varies)."""
    values = [results[name].values for name in names]
    own_paper_pulse = varied != "lambda"
    curves = [
        Curve(
            label(v, varied),
            results[name].force["t"],
            results[name].force["F"],
            fixed_wall(v).force,
            paper_pulse(v).force if own_paper_pulse else None,
        )
        for name, v in zip(names, values)
    ]
    lines = []
    if not own_paper_pulse:
        reference = {**values[0], "law": "hertz", "lambda": 1.0}
        lines = [
            Line(r"Hertz, exact, $\lambda$ = 1", fixed_wall(reference).force, "--"),
            Line(r"Hertz, eq. 35, $\lambda$ = 1", paper_pulse(reference).force, ":"),
        ]
    force_figure(path, title, curves, "exact, same law and parameters", lines)


def figure(number: str, title: str, varied: str, names: list[str]) -> Figure:
    return Figure(f"fig{number}.png", names, partial(draw, title, varied, names))


def named(start: str) -> list[str]:
    return [case.name for case in CASES if case.name.startswith(start)]


EQUAL_PEAK = ["hertz_lambda_1.0", "linear_lambda_0.055085", "quadratic_lambda_15.7585"]
FIGURES = [
    figure("06", "Hertz law: penalty factor", "lambda", named("hertz_lambda_")),
    figure("07", "Hertz law: Young's modulus of the ball", "E_ball", named("hertz_E_")),
    figure("08", "Hertz law: Poisson's ratio of the ball", "nu_ball", named("hertz_nu_")),
    figure("09", "Linear law: penalty factor", "lambda", named("linear_")),
    figure("10", "Quadratic law: penalty factor", "lambda", named("quadratic_")),
    figure("11", "The three laws with equal peak", "lambda", EQUAL_PEAK),
]

STUDY = Study(CASES, FIGURES, [Comparison(["table2", *(f"plate_{law}" for law in LAWS)], same_force_rows)])

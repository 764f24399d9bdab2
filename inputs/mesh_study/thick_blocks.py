# SPDX-License-Identifier: GPL-2.0-or-later
"""Table 2's ball on blocks so large that no wave is back while it is there.

References: Hertz' solution less what waves into a half-space take (Miller & Pursey 1955; the integral is this project's own).
"""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Mapping

import numpy as np
from bounce import DECK, HERE, STEEL, contact_radius, impact, peak_force, rows, steps
from matplotlib.figure import Figure as Picture
from study.build.graded_block import PLACES, QUARTER, GradedBlock
from study.reference import hertz
from study.run.case import Case, Comparison, Figure, Result, index_variables, numbers
from study.run.figures import COLOURS, MARKERS, save
from study.run.summary import Row

# Table 2's ball on a half-space: peak force [N] and restitution.  Waves take 0.374 % of its energy and 0.11 % of the force.
PEAK, RESTITUTION = 6.679, 0.998
PEAK_TOLERANCE, RESTITUTION_TOLERANCE = 1e-3, 5e-4
COARSE_TOLERANCE = 5e-3  # of elements that are too large for the waves
CUBIC_TOLERANCE = 2e-3
SLIDING_TOLERANCE, SLIDING_ENERGY_TOLERANCE = 1e-6, 1e-4
RIGID = {"E_ball": 1e20}  # the ball gives way by nothing: E* is the block's own
RIGID_TOLERANCE = 3e-3
RIGID_SIZE = 3.7  # contact radii
# A ball of the block's steel: a point force would pass s = 0.9 from 0.9 to 1.4 contact radii on, it is spread.
ALIKE = {"E_ball": 210.6e9, "nu_ball": 0.286, "rho": 7850.0}
ALIKE_SIZES = (2.0, 1.4, 1.2)  # contact radii
ALIKE_TOLERANCE = 5e-3
ALIKE_ALWAYS = ((1.2, "corner"), (1.2, QUARTER))
# Energy that waves take into a half-space of this steel: WAVES * integral of (dF/dt)^2 [m s/N]; of Hertz' pulse the integral is
# PULSE F^2/t_c.  Of the part that is lost the peak force loses PEAK_SHARE (0.11 % of 0.374 %, by integration of the motion).
WAVES, PULSE, PEAK_SHARE = 5.301e-16, 4.685, 0.294
SIZES_MM = (1, 0.5, 0.25, 0.125, 0.0625)
COARSE_MM = (4, 2)
CUBIC_MM = (0.5, 0.25, 0.125)
MASS_MM, CUBIC_MASS_MM = (4, 2, 1), (1, 0.5)  # with corrected mass
UNCORRECTED = ("corner", "centre")
# Two balls at once, almost in touch, along the elements or across: [mm] of those, and how far apart the balls are [m], degrees.
PAIR_MM, APART, ANGLES = (2.02, 1.01), 2.02e-3, {"along": 0.0, "across": 45.0}
GIVE_SHARE = 0.75  # what the peak force loses of what the other ball moves the top by, over the overlap (energy of both)


def block(h_mm: float, place: str, degree: int, mass: str = "lumped") -> GradedBlock:
    """So large that no wave is back while the ball is there."""
    return GradedBlock(h_mm * 1e-3, place, half=25e-3, depth=25e-3, largest=2e-3, degree=degree, mass=mass)


def block_case(h_mm: float, place: str, compliance: str, degree: int = 2, mass: str = "lumped") -> Case:
    if compliance == "none":
        name, expected = f"none_{h_mm:g}mm_{place}", ((), ())
    elif degree == 3:
        restitution = (RESTITUTION, RESTITUTION_TOLERANCE) if h_mm in CUBIC_MM else ()
        name, expected = f"cubic_{h_mm:g}mm_{place}", ((PEAK, CUBIC_TOLERANCE), restitution)
    elif h_mm in COARSE_MM:
        name, expected = f"{h_mm:g}mm_{place}", ((PEAK, COARSE_TOLERANCE), ())
    else:
        name, expected = f"{h_mm:g}mm_{place}", ((PEAK, PEAK_TOLERANCE), (RESTITUTION, RESTITUTION_TOLERANCE))
    if mass == "corrected":
        name = f"mass_{name}"
    file = f"{name}.yaml"
    variables = {"block": file, "compliance": compliance, "dt": 0.6e-8 if degree == 3 else 0.8e-8}
    mesh = block(h_mm, place, degree, mass)
    return Case(name, DECK, partial(rows, *expected), variables, partial(steps, 1.08 if compliance == "corrected" else 1.3),
                lambda _: {file: mesh.model_file(STEEL)})  # fmt: skip


def with_waves(rigid: hertz.Impact, balls: int = 1) -> tuple[float, float]:
    """Peak force [N] and restitution of Hertz' impact on a half-space of steel, of each of as many balls side by side."""
    lost = balls * WAVES * PULSE * rigid.peak_force**2 / rigid.duration / (0.5 * rigid.m * rigid.V**2)
    return rigid.peak_force * (1.0 - PEAK_SHARE * lost), math.sqrt(1.0 - lost)


def rigid_rows(result: Result) -> list[Row]:
    F, e = with_waves(impact(result.values))
    return rows((F, RIGID_TOLERANCE), (e, RESTITUTION_TOLERANCE), result)


def rigid_case(place: str) -> Case:
    """Elements as small as the correction takes them under a ball that gives way by nothing."""
    name, defaults = f"rigid_{place}", numbers(index_variables(HERE / DECK))
    h_mm = 1e3 * RIGID_SIZE * contact_radius({**defaults, **RIGID})
    file, mesh = f"{name}.yaml", block(h_mm, place, 2)
    variables = {"block": file, "dt": 0.6e-8, **RIGID}
    return Case(name, DECK, rigid_rows, variables, partial(steps, 1.3),
                lambda _: {file: mesh.model_file(STEEL)})  # fmt: skip


def alike_rows(result: Result) -> list[Row]:
    F, e = with_waves(impact(result.values))
    return rows((F, ALIKE_TOLERANCE), (e, RESTITUTION_TOLERANCE), result)


def alike_case(size: float, place: str, compliance: str = "corrected") -> Case:
    """Elements that are about as small as the contact."""
    name = f"{'none_' if compliance == 'none' else ''}alike_{size:g}a_{place}"
    h_mm = 1e3 * size * contact_radius({**numbers(index_variables(HERE / DECK)), **ALIKE})
    file, mesh = f"{name}.yaml", block(h_mm, place, 2)
    variables = {"block": file, "compliance": compliance, "dt": 4.5e-8 * h_mm, **ALIKE}
    expected = alike_rows if compliance == "corrected" else partial(rows, (), ())
    return Case(name, DECK, expected, variables, partial(steps, 1.3 if compliance == "corrected" else 2.0),
                lambda _: {file: mesh.model_file(STEEL)}, on_request=(size, place) not in ALIKE_ALWAYS)  # fmt: skip


def pair_rows(fine: bool, result: Result) -> list[Row]:
    """Per ball, beside Hertz' impact on a half-space that the other ball moves, too; waves of both are in phase."""
    values, rigid = result.values, impact(result.values)
    F, e = with_waves(rigid, balls=2)
    modulus = values["E_wall"] / (1.0 - values["nu_wall"] ** 2)
    moved = rigid.peak_force / (math.pi * modulus * values["apart"])  # Boussinesq
    F -= GIVE_SHARE * moved / rigid.max_overlap * rigid.peak_force
    return rows((F, PEAK_TOLERANCE if fine else COARSE_TOLERANCE), (e, RESTITUTION_TOLERANCE) if fine else (), result, balls=2)


def pair_case(h_mm: float, place: str, direction: str) -> Case:
    """Feet as far apart as an element is long, or two."""
    name = f"pair_{h_mm:g}mm_{place}_{direction}"
    file, mesh = f"{name}.yaml", block(h_mm, place, 2)
    variables = {"block": file, "dt": 0.8e-8, "apart": APART, "angle": ANGLES[direction]}
    return Case(name, DECK, partial(pair_rows, h_mm < 1e3 * APART), variables, partial(steps, 1.08),
                lambda _: {file: mesh.model_file(STEEL)})  # fmt: skip


def sliding_rows(result: Result) -> list[Row]:
    """The speed along the top that a bounce without friction leaves as it was, over that of the impact."""
    values, after = result.values, result.state["along"][-1]
    known = result.as_published and values["compliance"] == "corrected"
    change = (after - values["slide"]) / values["V"]
    return [
        *rows(*(((PEAK, PEAK_TOLERANCE), (RESTITUTION, RESTITUTION_TOLERANCE)) if known else ((), ())), result),
        Row(result.case, "change_of_sliding_speed", change, "1", *((0.0, SLIDING_TOLERANCE) if known else ())),
    ]


def sliding_energy(results: Mapping[str, Result]) -> list[Row]:
    """Kinetic energy that the ball keeps, less what it has by the restitution of the same ball that does not slide, over that of
    its impact."""
    slide, still = (results[name] for name in ("slide", "0.125mm_corner"))
    V, along = slide.values["V"], slide.values["slide"]
    after, restitution = slide.state, still.state["v"][-1] / still.values["V"]
    change = (after["along"][-1] ** 2 + after["v"][-1] ** 2 - along**2) / V**2 - restitution**2
    known = slide.as_published and still.as_published
    return [Row("slide", "change_of_energy", change, "1", *((0.0, SLIDING_ENERGY_TOLERANCE) if known else ()))]


def sliding_case(compliance: str) -> Case:
    """Over one and a half elements of 2.8 contact radii."""
    name = "slide" if compliance == "corrected" else "none_slide"
    file, mesh = f"{name}.yaml", block(0.125, "corner", 2)
    variables = {"block": file, "compliance": compliance, "dt": 0.4e-8, "slide": 30.0}
    return Case(name, DECK, sliding_rows, variables, partial(steps, 1.3),
                lambda _: {file: mesh.model_file(STEEL)})  # fmt: skip


def draw(path: Path, results: Mapping[str, Result]) -> None:
    """Peak force less Hertz', over the size of the elements."""
    picture = Picture(figsize=(9.0, 4.6), layout="constrained")
    axes = picture.subplots()
    some = next(iter(results.values())).values
    a, exact = contact_radius(some), impact(some).peak_force
    sizes = sorted((*COARSE_MM, *SIZES_MM))
    for place, colour, marker in zip(PLACES, COLOURS, MARKERS):
        for prefix, words, style, face in (("", "corrected", "-", colour), ("none_", "none", "--", "none")):
            names = [f"{prefix}{h:g}mm_{place}" for h in sizes]
            if names[0] not in results:
                continue
            F = np.array([peak_force(results[name]) for name in names])
            axes.plot(1e-3 * np.array(sizes) / a, 100.0 * (F / exact - 1.0), style, color=colour, marker=marker,
                      markerfacecolor=face, linewidth=1.2, label=f"compliance {words}, {place} of an element")  # fmt: skip
    axes.axhline(100.0 * (PEAK / exact - 1.0), color="k", linewidth=1.0, label="half-space, waves")
    axes.set(xscale="log", xlabel="size of the elements over the contact's radius, $h/a$",
             ylabel="peak force beside Hertz' [%]", title="A glass ball on steel, 1 m/s: what the mesh does to the force")  # fmt: skip
    axes.legend(frameon=False, loc="lower right")
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    save(picture, path)


CASES = [
    *(block_case(h, place, "corrected") for h in (*COARSE_MM, *SIZES_MM) for place in PLACES),
    *(block_case(h, place, "none") for h in (*COARSE_MM, *SIZES_MM) for place in UNCORRECTED),
    *(block_case(h, place, "corrected", degree=3) for h in CUBIC_MM for place in PLACES),
    *(block_case(h, place, "corrected", mass="corrected") for h in MASS_MM for place in PLACES),
    *(block_case(h, place, "corrected", 3, "corrected") for h in CUBIC_MASS_MM for place in PLACES),
    *(rigid_case(place) for place in ("corner", "centre")),
    *(alike_case(size, place) for size in ALIKE_SIZES for place in (*PLACES, QUARTER)),
    *(alike_case(ALIKE_SIZES[-1], place, "none") for place in UNCORRECTED),
    *(pair_case(h, place, direction) for h in PAIR_MM for place in UNCORRECTED for direction in ANGLES),
    *(sliding_case(compliance) for compliance in ("corrected", "none")),
]
COMPARISONS = [Comparison(["slide", "0.125mm_corner"], sliding_energy)]
FIGURE = Figure("force.png", [case.name for case in CASES if case.name.removeprefix("none_")[0].isdigit()], draw)

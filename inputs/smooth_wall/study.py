# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball slides without friction over waves: the force of NURBS walls and of triangle walls beside the exact one.

Reference: constrained motion (study.reference.sliding) from where the ball is after the first 10 ms, in which it has
come to rest on the wall; on the spline surface that was run, and on the sine that all walls approximate.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Mapping

import numpy as np
from matplotlib.figure import Figure as Picture

from study.build.waves import SIDE, WAVES, SplineWave, model_file, triangles
from study.reference import hertz
from study.reference.sliding import SlidingBall, Surface
from study.reference.wavy_surface import sine_surface, spline_surface
from study.run.case import Case, Figure, Result, Study, Values
from study.run.figures import COLOURS, save
from study.run.summary import Row

GRAVITY = 9.81  # [m/s2]
SETTLED = 0.010  # [s]
TOUCHES = 1e-6  # of the weight

BOUNDS = (1e-3, 2e-3)  # rms force errors of the cubic wall [weight]: same surface, sine


def nurbs_file(values: Values) -> Mapping[str, str]:
    return {"wall.yaml": model_file(spline_wave(values), values["A"])}


def stl_file(values: Values) -> Mapping[str, str]:
    return {"wall.stl": triangles(int(values["elements"]), values["A"])}


def spline_wave(values: Values) -> SplineWave:
    return SplineWave(int(values["degree"]), int(values["elements"]))


def weight(values: Values) -> float:
    return GRAVITY * hertz.sphere_mass(values["r"], values["rho"])


def forces(result: Result, surface: Surface) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """From SETTLED on: t, the wall's force and that of constrained motion, both in weights."""
    force, state = result.force, result.state
    since = np.searchsorted(force["t"], SETTLED - 0.5 * result.values["dt"])
    t, F = force["t"][since:], force["F"][since:] / weight(result.values)
    centre, v = (np.array([state[name][since] for name in names]) for names in (("x", "y", "z"), ("vx", "vy", "vz")))
    return t, F, SlidingBall(surface, result.values["r"], GRAVITY).force(centre, v, t)


def rms_error(result: Result, surface: Surface) -> float:
    _, F, exact = forces(result, surface)
    return float(np.sqrt(np.mean((F - exact) ** 2)))


def steps_apart(result: Result) -> float:
    """Fraction of the steps without contact, since SETTLED."""
    force = result.force
    return float(np.mean(force["F"][force["t"] >= SETTLED] < TOUCHES * weight(result.values)))


def largest_force(result: Result) -> float:
    """In weights, since SETTLED."""
    force = result.force
    return float(force["F"][force["t"] >= SETTLED].max() / weight(result.values))


def nurbs_rows(tolerances: tuple[float, float] | None, note: str, result: Result) -> list[Row]:
    """`tolerances` for the same surface and for the sine; the references know no friction."""
    wave, A = spline_wave(result.values), result.values["A"]
    errors = {
        "rms_error_same_surface": rms_error(result, spline_surface(wave, A)),
        "rms_error_sine": rms_error(result, sine_surface(A)),
    }
    frictionless = result.values["mu"] == 0.0
    bounds = [(0.0, bound) for bound in tolerances] if tolerances and frictionless else [(None, None)] * 2
    return [
        *(Row(result.case, name, e, "weight", *bound, note) for (name, e), bound in zip(errors.items(), bounds)),
        Row(result.case, "largest_force", largest_force(result), "weight"),
        Row(result.case, "steps_without_contact", steps_apart(result), "1", *((0.0, 0.0) if frictionless else ())),
    ]


def triangle_rows(result: Result) -> list[Row]:
    note = f"{2 * int(result.values['elements']) ** 2} triangles"
    return [
        Row(result.case, "rms_error_sine", rms_error(result, sine_surface(result.values["A"])), "weight", note=note),
        Row(result.case, "largest_force", largest_force(result), "weight"),
        Row(result.case, "steps_without_contact", steps_apart(result), "1"),
    ]


def nurbs(
    name: str, degree: int, tolerances: tuple[float, float] | None, note: str = "", **variables: float
) -> Case:
    rows = partial(nurbs_rows, tolerances, note)
    return Case(name, "in.smooth_wall", rows, {"degree": degree, "elements": 62} | variables, files=nurbs_file)


def stock(name: str, squares: int) -> Case:
    variables = {"wall": "triangles", "geometry": "wall.stl", "elements": squares}
    return Case(name, "in.smooth_wall", triangle_rows, variables, files=stl_file)


DRAWN = {
    "triangles_30k": ("LIGGGHTS, 30,752 triangles", COLOURS[1]),
    "quadratic": ("NURBS, 62 x 62 quadratic elements", COLOURS[2]),
    "cubic": ("NURBS, 62 x 62 cubic elements", COLOURS[0]),
}


def draw(path: Path, results: Mapping[str, Result]) -> None:
    """The forces over the exact one; below, how far each is off."""
    picture = Picture(figsize=(9.0, 6.6), layout="constrained")
    picture.suptitle("Force on a ball that slides over waves without friction")
    above, below = picture.subplots(2, 1, sharex=True)
    for name, (label, colour) in DRAWN.items():
        t, F, exact = forces(results[name], sine_surface(results[name].values["A"]))
        above.plot(1e3 * t, F, color=colour, linewidth=0.8, label=label)
        below.semilogy(1e3 * t, np.abs(F - exact), color=colour, linewidth=0.8)
    above.plot(1e3 * t, exact, "k--", linewidth=1.2, label="exact: constrained motion on the sine")
    above.legend(frameon=False, ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    above.set_ylabel("force / weight")
    below.set(xlabel="time [ms]", ylabel="|error| / weight", ylim=(1e-5, 1e2), xlim=(1e3 * t[0], 1e3 * t[-1]))
    for axes in (above, below):
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    save(picture, path)


CURVATURE_JUMPS = "its curvature jumps at knots: use cubic walls for sliding"

STUDY = Study(
    cases=[
        nurbs("cubic", 3, BOUNDS),
        nurbs("cubic_across_the_face", 3, BOUNDS, x=15.5e-3 + 2 * SIDE / WAVES),
        nurbs("quadratic", 2, None, CURVATURE_JUMPS),
        stock("triangles_2k", 31),
        stock("triangles_30k", 124),
        stock("triangles_120k", 248),
    ],
    figures=[Figure("force.png", list(DRAWN), draw)],
)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Particles in a rotating drum: NURBS beside triangles, and 1 rank beside 2 and 4.

The bed settles once, in the NURBS drum at rest; all cases start from there.  In steady rotation the drum's torque carries
the weight of the bed at its lever arm, so the power is M g x omega, with x how far the centre of mass is off the axis:
that holds for any wall and any friction.
"""

from __future__ import annotations

import math
from functools import cache, partial
from pathlib import Path
from typing import Mapping

import numpy as np
from matplotlib.figure import Figure as Picture

from study.build.drum import Drum, atom_data
from study.reference.hertz import effective_modulus, penalty_impact, sphere_mass
from study.run.bed import Frame, read_frames, slope
from study.run.case import Case, Comparison, Figure, Result, Study, Values
from study.run.figures import COLOURS, save
from study.run.pulse import NoPulse
from study.run.summary import Row

GRAVITY = 9.81  # [m/s2]
ARCS, ROWS = 32, 4  # elements of the NURBS drum
FACETS = 240  # of the triangle drum, 1.5 degrees each; 0.0086 mm off the circle
SEED = 1
STEADY = 1.2  # [s] from here on means are taken

COMPARED_STEPS = 2000  # on 1, 2 and 4 ranks
RANKS_TOLERANCE = 1e-9  # of positions, relative to the drum's radius R; of velocities, relative to pi R / t_c
ALONE_TOLERANCE = 1e-14  # of positions / R and velocities / (omega R), without contacts between particles
SLOPE_TOLERANCE = 1.0  # [degree]
POWER_TOLERANCE = 0.02
BALANCE_TOLERANCE = 0.01  # power and M g x omega: what the bed's angular momentum still changes by
REST_TOLERANCE = 1e-3


def drum(values: Values) -> Drum:
    return Drum(values["R"], values["L"])


def geometry_files(values: Values) -> Mapping[str, str]:
    shape = drum(values)
    return {"drum.yaml": shape.model_file(ARCS, ROWS), "drum.stl": shape.triangles(FACETS)}


def settle_files(values: Values) -> Mapping[str, str]:
    shape = drum(values)
    bed = shape.bed(int(values["count"]), (values["r_min"], values["r_max"]), SEED)
    return {"drum.yaml": shape.model_file(ARCS, ROWS), "bed.data": atom_data(shape, *bed, values["rho"])}


@cache
def frames(folder: Path) -> list[Frame]:
    return read_frames((folder / "frames.txt").read_text(encoding="utf-8"))


def slopes(result: Result) -> tuple[np.ndarray, np.ndarray]:
    """Time [s] and angle [degree] of the free surface."""
    pictures, values = frames(result.folder), result.values
    t = [(picture.step - pictures[0].step) * values["dt"] for picture in pictures]
    cell = 2.0 * values["r_max"]
    angles = [slope(*(p.values[axis] for axis in "xyz"), values["R"], cell) for p in pictures]
    return np.array(t), np.degrees(angles)


def steady(t: np.ndarray, x: np.ndarray) -> np.ndarray:
    if t[-1] <= STEADY:
        raise NoPulse(f"the run ends before the slope is steady, at {STEADY} s; -var steps N makes it longer")
    return x[t > STEADY]


def repose(result: Result) -> np.ndarray:
    return steady(*slopes(result))


def power(result: Result) -> float:
    """Mean that the drum gives to the bed [W]."""
    return float(np.mean(steady(result.force["t"], result.force["power"])))


def rest_rows(result: Result) -> list[Row]:
    """The drum carries the weight of the bed; the mean of the last third, since the bed still swings a little."""
    _, radii = drum(result.values).bed(int(result.values["count"]), (result.values["r_min"], result.values["r_max"]), SEED)
    weight = GRAVITY * sum(sphere_mass(r, result.values["rho"]) for r in radii)
    F = result.force["F"]
    return [Row(result.case, "force_at_rest", float(np.mean(F[-len(F) // 3 :])), "N", weight, REST_TOLERANCE)]


def turning_rows(result: Result) -> list[Row]:
    omega = 2.0 * math.pi / result.values["period"]
    state, angles = result.state, repose(result)
    lever = -float(np.mean(steady(state["t"], state["x"])))
    return [
        Row(result.case, "angle_of_repose", float(angles.mean()), "degree", note=f"varies by {angles.std():.2f} degrees"),
        Row(result.case, "power", power(result), "W", float(state["mass"][0]) * GRAVITY * lever * omega, BALANCE_TOLERANCE),
    ]


def against_triangles(results: Mapping[str, Result]) -> list[Row]:
    """The NURBS drum with the triangle drum as reference."""
    angle, other = (float(repose(results[name]).mean()) for name in ("nurbs", "triangles"))
    return [
        Row("nurbs/triangles", "angle_of_repose", angle, "degree", other, SLOPE_TOLERANCE / other),
        Row("nurbs/triangles", "power", power(results["nurbs"]), "W", power(results["triangles"]), POWER_TOLERANCE),
    ]


def omega_R(values: Values) -> float:
    """Speed of the shell [m/s]."""
    return 2.0 * math.pi / values["period"] * values["R"]


def largest_differences(results: Mapping[str, Result], one: str, more: str) -> tuple[float, float]:
    """At the end of two runs: of coordinates [m], of velocities [m/s]."""
    last, other = (frames(results[case].folder)[-1] for case in (one, more))
    differences = {name: float(np.max(np.abs(last.values[name] - other.values[name]))) for name in last.values}
    return max(differences[c] for c in ("x", "y", "z")), max(differences[c] for c in ("vx", "vy", "vz"))


def contact_time(bed: Values, speed: float) -> float:
    """How long the smallest particle touches the drum that it meets with this speed [s], after Hertz."""
    E_star = effective_modulus(bed["E"], bed["nu"], bed["E"], bed["nu"])
    return penalty_impact("hertz", 1.0, E_star, bed["r_min"], bed["rho"], speed).duration


def ranks_rows(name: str, results: Mapping[str, Result]) -> list[Row]:
    """The bed after COMPARED_STEPS.  A contact turns a difference dx of positions into one of pi dx / t_c of
    velocities, so that is the scale on which velocities are held to the bound of positions."""
    values = results[name].values
    x, v = largest_differences(results, "ranks_1", name)
    speed = omega_R(values)
    t_c = contact_time(results["settle"].values, speed)
    return [
        Row(name, "position_difference", x / values["R"], "R", 0.0, RANKS_TOLERANCE),
        Row(name, "velocity_difference", v * t_c / (math.pi * values["R"]), "pi R/t_c", 0.0, RANKS_TOLERANCE),
        Row(name, "velocity_difference_over_omega_R", v / speed, "1"),
    ]


def alone_rows(name: str, results: Mapping[str, Result]) -> list[Row]:
    """Particles that do not feel each other: what the wall's contacts alone make of the number of ranks."""
    values = results[name].values
    x, v = largest_differences(results, "alone_1", name)
    return [
        Row(name, "position_difference", x / values["R"], "R", 0.0, ALONE_TOLERANCE),
        Row(name, "velocity_difference", v / omega_R(values), "omega R", 0.0, ALONE_TOLERANCE),
    ]


def draw(path: Path, results: Mapping[str, Result]) -> None:
    """The bed at the end, seen along the axis; slope and power against time."""
    picture = Picture(figsize=(10.0, 4.6), layout="constrained")
    left, right = picture.subfigures(1, 2, width_ratios=(1.0, 1.25))
    seen = left.subplots()
    nurbs = results["nurbs"]
    R, last = nurbs.values["R"], frames(nurbs.folder)[-1].values
    speed = np.hypot(last["vx"], last["vz"])
    dots = seen.scatter(1e3 * last["x"], 1e3 * last["z"], c=speed, s=5.0, cmap="viridis", linewidths=0.0)
    around = np.linspace(0.0, 2.0 * math.pi, 361)
    seen.plot(1e3 * R * np.cos(around), 1e3 * R * np.sin(around), color="k", linewidth=1.2)
    tilt, reach = math.radians(repose(nurbs).mean()), 1e3 * R * np.array([-0.6, 0.6])
    seen.set(aspect="equal", xlabel="x [mm]", ylabel="z [mm]", title="NURBS drum at the end")
    seen.plot(-reach * math.cos(tilt), reach * math.sin(tilt), "k--", linewidth=1.0, label=f"{math.degrees(tilt):.1f}°")
    seen.legend(frameon=False, loc="upper center", title="mean slope")
    left.colorbar(dots, ax=seen, shrink=0.8, label="speed [m/s]")

    above, below = right.subplots(2, 1, sharex=True)
    for (name, label), colour in zip((("nurbs", "NURBS"), ("triangles", "LIGGGHTS' triangles")), COLOURS):
        above.plot(*slopes(results[name]), color=colour, linewidth=1.2, label=label)
        force = results[name].force
        below.plot(force["t"], 1e3 * force["power"], color=colour, linewidth=0.9)
    above.legend(frameon=False)
    above.set_ylabel("slope [degree]")
    below.set(ylabel="power [mW]", xlabel="time [s]")
    for axes in (above, below):
        axes.axvline(STEADY, color="0.6", linewidth=0.8, linestyle=":")
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    save(picture, path)


def turning(name: str, rows=lambda result: [], ranks: int | None = None, **variables: float | str) -> Case:
    return Case(name, "in.drum", rows, variables, files=geometry_files, after="settle", ranks=ranks)


RANKS = (1, 2, 4)

STUDY = Study(
    cases=[
        Case("settle", "in.settle", rest_rows, files=settle_files),
        turning("triangles", turning_rows, wall="triangles"),
        turning("nurbs", turning_rows),
        *(turning(f"ranks_{n}", ranks=n, steps=COMPARED_STEPS) for n in RANKS),
        *(turning(f"alone_{n}", ranks=n, steps=COMPARED_STEPS, alone=1) for n in RANKS),
    ],
    comparisons=[
        Comparison(["nurbs", "triangles"], against_triangles),
        *(Comparison(["settle", "ranks_1", f"ranks_{n}"], partial(ranks_rows, f"ranks_{n}")) for n in RANKS[1:]),
        *(Comparison(["alone_1", f"alone_{n}"], partial(alone_rows, f"alone_{n}")) for n in RANKS[1:]),
    ],
    figures=[Figure("drum.png", ["nurbs", "triangles"], draw)],
)

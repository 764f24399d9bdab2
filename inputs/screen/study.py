# SPDX-License-Identifier: GPL-2.0-or-later
"""Particles on a shaken steel plate, as a modal body and as a whole solid.

References: the plate alone beside Kirchhoff's, in its first mode's quasi-static limit; the weight of the bed, which the plate
carries in the mean over whole periods; the whole solid until collisions have made the two beds different.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Mapping

import numpy as np
from matplotlib.figure import Figure as Picture

from study.run.case import Case, Comparison, Figure, Result, Study
from study.run.figures import COLOURS, save
from study.run.pulse import NoPulse
from study.run.summary import Row

GRAVITY = 9.81  # [m/s2]
# screen.yaml: side length and thickness [m], E [Pa], nu, density [kg/m3]; how the frame moves
SIDE, THICKNESS, MODULUS, POISSON, DENSITY = 0.3, 2e-3, 210e9, 0.3, 7850.0
AMPLITUDE, FREQUENCY, RAMP = 2e-3, 25.0, 0.04  # [m], [1/s], [s]
# Clamped square plate of Kirchhoff: w = 0.0012653 q a^4 / D in the middle; omega_1 a^2 sqrt(rho h / D) = 35.985.
CLAMPED, FIRST_MODE = 0.0012653, 35.985

STEADY = 0.2  # [s] from here on means are taken
PLATE_TOLERANCE = 0.02  # lumped masses, ten elements to a half wave
WEIGHT_TOLERANCE = 0.02
SAME_FORCE, SAME_MOTION = 0.01, 0.002  # rms of the difference over rms


def frame(t: np.ndarray) -> np.ndarray:
    return AMPLITUDE * np.sin(2 * math.pi * FREQUENCY * t) * np.minimum(t / RAMP, 1.0)


def bent(result: Result) -> tuple[np.ndarray, np.ndarray]:
    """Time, and the middle of the plate relative to its frame [m]."""
    t = result.force["t"]
    return t, result.force["w"] - frame(t)


def stiffness() -> float:
    return MODULUS * THICKNESS**3 / (12.0 * (1.0 - POISSON**2))


def kirchhoff(acceleration: float, frequency: float) -> float:
    """The middle of the plate under its own inertia, far below its first mode [m]."""
    sag = CLAMPED * DENSITY * THICKNESS * acceleration * SIDE**4 / stiffness()
    first = FIRST_MODE / SIDE**2 * math.sqrt(stiffness() / (DENSITY * THICKNESS))
    return sag / (1.0 - (2.0 * math.pi * frequency / first) ** 2)


def empty_rows(result: Result) -> list[Row]:
    """Amplitude and mean of the middle, by least squares over whole periods."""
    t, w = bent(result)
    late = t >= 2.0 * RAMP
    if not np.any(late):
        raise NoPulse("the run ends before the frame shakes fully; -var steps N makes it longer")
    phase = 2.0 * math.pi * FREQUENCY * t[late]
    columns = np.stack([np.sin(phase), np.cos(phase), np.ones_like(phase)], axis=1)
    sine, cosine, mean = np.linalg.lstsq(columns, w[late], rcond=None)[0]
    shaken = kirchhoff((2.0 * math.pi * FREQUENCY) ** 2 * AMPLITUDE, FREQUENCY)
    return [
        Row(result.case, "amplitude", math.hypot(sine, cosine), "m", shaken, PLATE_TOLERANCE),
        Row(result.case, "sag", -mean, "m", kirchhoff(GRAVITY, 0.0), PLATE_TOLERANCE),
    ]


def cost(result: Result) -> float:
    """Seconds of the processor that a millisecond takes, from LIGGGHTS' own count."""
    log = (result.folder / "log.txt").read_text(encoding="utf-8", errors="replace")
    seconds = float(re.search(r"Loop time of (\S+) on", log)[1])
    return seconds / (1e3 * result.values["steps"] * result.values["dt"])


def bed_rows(result: Result) -> list[Row]:
    force, weight = result.force, GRAVITY * float(result.state["mass"][0])
    late = force["t"] >= STEADY
    rows = [Row(result.case, "time_per_millisecond", cost(result), "s")]
    if result.values["steps"] * result.values["dt"] < 2.0 * STEADY:
        return rows
    return [Row(result.case, "mean_force", float(np.mean(force["F"][late])), "N", weight, WEIGHT_TOLERANCE), *rows]


def solid_rows(result: Result) -> list[Row]:
    return [Row(result.case, "time_per_millisecond", cost(result), "s")]


def difference(results: Mapping[str, Result], column: str) -> float:
    """Of modal body and solid at the solid's times, rms over rms."""
    modal, solid = (results[name].force for name in ("modal", "solid"))
    found = np.interp(solid["t"], modal["t"], modal[column])
    return float(np.sqrt(np.mean((found - solid[column]) ** 2) / np.mean(solid[column] ** 2)))


def beside_solid(results: Mapping[str, Result]) -> list[Row]:
    name = "modal/solid"
    return [
        Row(name, "force_difference", difference(results, "F"), "1", 0.0, SAME_FORCE),
        Row(name, "displacement_difference", difference(results, "w"), "1", 0.0, SAME_MOTION),
        Row(name, "cost_of_the_solid_over_that_of_the_modes", cost(results["solid"]) / cost(results["modal"]), "1"),
    ]


def draw(path: Path, results: Mapping[str, Result]) -> None:
    """The middle of the plate and the force of the bed; the solid's on top, as far as it was run."""
    picture = Picture(figsize=(9.0, 5.2), layout="constrained")
    above, below = picture.subplots(2, 1, sharex=True)
    for (name, label, style), colour in zip(
        (("modal", "40 modes, 5,000 particles", "-"), ("empty", "40 modes, no particles", "-"), ("solid", "whole solid", "--")), COLOURS
    ):
        t, w = bent(results[name])
        above.plot(1e3 * t, 1e6 * w, style, color=colour, linewidth=1.0, label=label)
        if name != "empty":
            below.plot(1e3 * t, results[name].force["F"], style, color=colour, linewidth=1.0, label=label)
    weight = GRAVITY * float(results["modal"].state["mass"][0])
    below.axhline(weight, color="k", linewidth=1.0, linestyle=":", label="weight of the bed")
    above.set(ylabel="middle relative to frame [µm]", ylim=(-210.0, 130.0))
    below.set(xlabel="time [ms]", ylabel="force of the bed [N]", xlim=(0.0, 200.0))
    for axes in (above, below):
        axes.legend(frameon=False, loc="upper right", ncols=3)
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    save(picture, path)


STUDY = Study(
    cases=[
        Case("modal", "in.screen", bed_rows),
        Case("empty", "in.screen", empty_rows, {"layers": "0", "steps": "3200"}),
        Case("solid", "in.screen", solid_rows, {"modes": "0", "dt": 5e-6, "steps": "6000", "every": "20"}),
    ],
    figures=[Figure("screen.png", ["modal", "empty", "solid"], draw)],
    comparisons=[Comparison(["modal", "solid"], beside_solid)],
)

# SPDX-License-Identifier: GPL-2.0-or-later
"""3,488 spheres on a tailor rolled blank: section 6 of Gao & Feng (2019), their Figs. 13 and 14.

Exact references: impulse, energy, the time of the first contact.  The others are those of an own small DEM code coupled
to a linear Kirchhoff plate of the same thickness law, with another packing: bands, not digits.
"""

from __future__ import annotations

import os
import subprocess
import sys
from functools import cached_property
from pathlib import Path
from typing import Mapping

import numpy as np
from matplotlib.figure import Figure as Picture

from study import hertz
from study.case import Case, Comparison, Figure, Result, Study, material, read_csv
from study.figures import COLOURS, save
from study.summary import Row

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
from states import State, read_states  # noqa: E402  (a file of this folder)

BLANK = material(HERE / "linear_elastic.yaml")
MS = 1e-3
SEEDS = {"packing_1": 86028121, "packing_2": 15485863, "packing_3": 32452843}
COARSE_STEP = 5e-7  # of the three packings [s]; comparing the first with linear_elastic shows that it is enough
SHOWN_MS = (0.03, 0.11, 0.3, 0.5, 0.7, 0.9)  # the states of Fig. 14

# Plate theory, 1e3 N, mm: mean force within 0.01 ms of a time [ms], deflection of the centre, impulse until a time.
PLATE_FORCE = {0.02: 940.0, 0.06: 590.0, 0.10: 400.0, 0.15: 230.0, 0.20: 210.0}
PLATE_CENTRE = {0.1: 0.41e-3, 0.2: 0.97e-3, 0.3: 1.37e-3, 0.5: 1.85e-3, 1.0: 2.60e-3}
PLATE_IMPULSE = 0.142  # [N s] in 1 ms
BAND, IMPULSE_BAND = 0.20, 0.10
LARGE_STRAIN_CENTRE = (2.4e-3, 0.4 / 2.4)  # at 1 ms


class Impact:
    """A finished run, evaluated."""

    def __init__(self, result: Result):
        self.values, self.folder = result.values, result.folder
        self.force, self.state = result.force, result.state
        self.blank = read_csv(result.folder / "blank.csv")

    @cached_property
    def states(self) -> list[State]:
        return read_states(self.folder)

    @property
    def dt(self) -> float:
        return self.values["dt"]

    @cached_property
    def impulse(self) -> np.ndarray:
        """Of the wall's force since the start, at every step: kicks of half a step before and after [N s]."""
        F = self.force["F"]
        return self.dt * (np.cumsum(F) - 0.5 * F)

    @cached_property
    def mass(self) -> float:
        return sum(hertz.sphere_mass(r, BLANK["density"]) for r in self.states[0].r)

    def impulse_error(self) -> float:
        """Largest |impulse - change of the spheres' momentum| over their momentum at the start."""
        start = self.mass * self.values["V"]
        return float(np.abs(self.impulse - (self.state["P"] + start)).max() / start)

    @cached_property
    def energies(self) -> dict[str, np.ndarray]:
        """Time and energies at every state; the supports do not move, so they do no work."""
        E_star = hertz.effective_modulus(*(BLANK["youngs_modulus"], BLANK["poissons_ratio"]) * 2)
        blank = {name: np.concatenate([[0.0], self.blank[name]]) for name in ("kinetic", "strain")}
        return {
            "t": self.dt * np.array([state.step for state in self.states]),
            "spheres": np.array([state.kinetic_energy(BLANK["density"]) for state in self.states]),
            "contacts": np.array([state.contact_energy(E_star) for state in self.states]),
            "blank, kinetic": blank["kinetic"],
            "blank, strain": blank["strain"],
        }

    def energy_drift(self) -> float:
        """Largest change of the total over the stream's energy."""
        total = sum(values for name, values in self.energies.items() if name != "t")
        return float(np.abs(total / total[0] - 1.0).max())

    def mean_force(self, t: float, half: float) -> float:
        within = np.abs(self.force["t"] - t) < half + 0.5 * self.dt
        return float(self.force["F"][within].mean())

    def peak_mean(self) -> float:
        """Largest mean over 5 us."""
        return max(self.mean_force(t, 2.5e-6) for t in np.arange(1e-5, 1e-4, 1e-6))

    def centre(self, t: float) -> float:
        return float(np.interp(t, self.force["t"], self.force["plate_displacement"]))

    def start_overlap(self) -> float:
        """Between spheres before anything moves, in radii."""
        return float(max(self.states[0].overlaps()[1], default=0.0) / self.states[0].r.min())

    def overlaps(self) -> tuple[np.ndarray, np.ndarray]:
        """Of spheres with the blank and with each other, over all states, in radii and in effective diameters."""
        wall = [state.wall[1] / state.r[state.wall[0]] for state in self.states]
        pairs = [overlap / (2.0 * r) for r, overlap in (state.overlaps() for state in self.states)]
        return np.concatenate(wall), np.concatenate(pairs)


def as_published(result: Result) -> bool:
    """Whether plate theory is a reference: the time step and the packing do not matter to it."""
    return not result.changed - {"dt", "seed", "states"}


def single_overlap(impact: Impact) -> float:
    """Of one sphere on a blank that does not move, in radii: (5 m V^2 / 4 K)^(2/5) / r, the same for every r."""
    E_star = hertz.effective_modulus(*(BLANK["youngs_modulus"], BLANK["poissons_ratio"]) * 2)
    one = hertz.penalty_impact("hertz", 1.0, E_star, 5e-4, BLANK["density"], impact.values["V"])
    return (5.0 * one.m * one.V**2 / (4.0 * one.k)) ** 0.4 / 5e-4


def rows(result: Result) -> list[Row]:
    """What every run must fulfil."""
    impact, case = Impact(result), result.case
    t, F = impact.force["t"], impact.force["F"]
    early = t < impact.values["gap"] / impact.values["V"] * (1.0 - 1e-9)
    found = [
        Row(case, "spheres", len(impact.states[0].r), "1", 3488.0, 0.0),
        Row(case, "overlap_at_start", impact.start_overlap(), "radius", 0.0, 1e-4),
        Row(case, "force_before_contact", np.abs(F[early]).max(), "N", 0.0, 0.0),
        Row(case, "first_contact", t[F > 0.0][0], "s"),
        Row(case, "impulse_error", impact.impulse_error(), "1", 0.0, 1e-10),
        Row(case, "energy_drift", impact.energy_drift(), "1", 0.0, 1e-3),
        Row(case, "peak_force_5us", impact.peak_mean(), "N", note="plate theory, another packing: 750 to 1300"),
    ]
    published = as_published(result)
    plate = {"linear_elastic": (PLATE_IMPULSE, IMPULSE_BAND), "saint_venant_kirchhoff": (None, None)}
    impulse = plate[impact.values["law"]] if published else (None, None)
    found.append(Row(case, "impulse", impact.impulse[-1], "N s", *impulse))
    large = LARGE_STRAIN_CENTRE if published and impact.values["law"] == "saint_venant_kirchhoff" else (None, None)
    found.append(Row(case, "centre_at_end", impact.centre(t[-1]), "m", *large))
    for name, values in impact.energies.items():
        if name != "t":
            found.append(Row(case, f"energy_{name}".replace(", ", "_"), values[-1], "J"))
    wall, pairs = impact.overlaps()
    found.append(Row(case, "largest_overlap", wall.max(), "radius", note=f"one sphere: {single_overlap(impact):.3g}"))
    found.append(Row(case, "largest_overlap_of_spheres", pairs.max(), "diameter"))
    return found


def seed_rows(results: Mapping[str, Result]) -> list[Row]:
    """Means over the packings beside plate theory; how much the packings differ; the mean deflection's symmetry."""
    impacts = [Impact(results[name]) for name in SEEDS]
    published = all(as_published(results[name]) for name in SEEDS)
    case, found = "three packings", []

    def compare(quantity: str, values: list[float], unit: str, *reference: float) -> None:
        spread = f"+- {np.std(values, ddof=1):.2g}"
        bounds = reference if published else ()
        found.append(Row(case, quantity, float(np.mean(values)), unit, *bounds, note=spread))
        found.append(Row(case, f"spread_{quantity}", float(np.std(values, ddof=1)), unit))

    for t, F in PLATE_FORCE.items():
        compare(f"force_at_{t:g}ms", [i.mean_force(t * MS, 1e-5) for i in impacts], "N", F, BAND)
    for t in (0.4, 0.8):
        compare(f"force_at_{t:g}ms", [i.mean_force(t * MS, 5e-5) for i in impacts], "N")
    for t, w in PLATE_CENTRE.items():
        compare(f"centre_at_{t:g}ms", [i.centre(t * MS) for i in impacts], "m", w, BAND)
    compare("impulse", [i.impulse[-1] for i in impacts], "N s", PLATE_IMPULSE, IMPULSE_BAND)
    for one, other in (("left", "right"), ("front", "back")):
        a, b = (np.mean([i.blank[name][-1] for i in impacts]) for name in (one, other))
        found.append(Row(case, f"asymmetry_{one}_{other}", abs(a - b) / (a + b), "1", 0.0, 0.02))
    return found


def law_rows(results: Mapping[str, Result]) -> list[Row]:
    """What large displacements change; and what a coarser step changes, which is next to nothing."""
    names = ("linear_elastic", "saint_venant_kirchhoff", "packing_1")
    linear, large, coarse = (Impact(results[name]) for name in names)
    end = linear.force["t"][-1]
    return [
        Row("laws", "centre_stvk/linear", large.centre(end) / linear.centre(end), "1"),
        Row("laws", "impulse_stvk/linear", large.impulse[-1] / linear.impulse[-1], "1"),
        Row("time step", "impulse_x5", coarse.impulse[-1], "N s", linear.impulse[-1], 0.02),
        Row("time step", "centre_x5", coarse.centre(end), "m", linear.centre(end), 0.02),
    ]


LAWS = {
    "linear_elastic": ("small strain, as in the paper", COLOURS[0]),
    "saint_venant_kirchhoff": ("St. Venant-Kirchhoff", COLOURS[1]),
}


def draw_history(path: Path, results: Mapping[str, Result]) -> None:
    """Fig. 13: force, in means of 5 us, and displacement of the bottom's centre."""
    picture = Picture(figsize=(9.0, 6.4), layout="constrained")
    picture.suptitle("3,488 spheres on a tailor rolled blank")
    above, below = picture.subplots(2, 1, sharex=True)
    for name, (label, colour) in LAWS.items():
        force = results[name].force
        window = max(1, round(5e-6 / results[name].values["dt"]))
        mean = np.convolve(force["F"], np.full(window, 1.0 / window), "same")
        above.plot(force["t"] / MS, mean, color=colour, linewidth=1.0, label=label)
        below.plot(force["t"] / MS, -force["plate_displacement"] / MS, color=colour, linewidth=1.4, label=label)
    style = dict(linestyle="none", color="k", marker="o", markersize=4.5, markerfacecolor="none")
    above.plot(list(PLATE_FORCE), list(PLATE_FORCE.values()), label="linear plate theory, another packing", **style)
    below.plot(list(PLATE_CENTRE), [-w / MS for w in PLATE_CENTRE.values()], **style)
    above.set_ylabel("impact force [N]")
    above.legend(frameon=False)
    below.set(xlabel="time [ms]", ylabel="bottom's centre [mm]")
    finish(picture, path)


def draw_energies(path: Path, results: Mapping[str, Result]) -> None:
    """Where the stream's energy goes."""
    picture = Picture(figsize=(9.0, 4.2), layout="constrained")
    axes = picture.subplots()
    energies = Impact(results["linear_elastic"]).energies
    names = [name for name in energies if name != "t"]
    axes.stackplot(energies["t"] / MS, [energies[name] for name in names], labels=names, colors=COLOURS, alpha=0.8)
    axes.set(xlabel="time [ms]", ylabel="energy [J]", title="Energy, linear blank")
    axes.legend(frameon=False, loc="center right")
    finish(picture, path)


def draw_overlaps(path: Path, results: Mapping[str, Result]) -> None:
    """Histogram over all states: at E = 1 GPa and 10 m/s a sphere is pressed in by 14 % of its radius."""
    picture = Picture(figsize=(9.0, 4.2), layout="constrained")
    axes = picture.subplots()
    impact = Impact(results["linear_elastic"])
    labels = ("with the blank, in radii", "with each other, in effective diameters")
    for overlaps, label, colour in zip(impact.overlaps(), labels, COLOURS):
        axes.hist(overlaps, bins=np.linspace(0.0, 0.25, 51), histtype="step", linewidth=1.4, color=colour, label=label)
    axes.axvline(single_overlap(impact), color="k", linestyle="--", linewidth=1.0, label="one sphere, blank held still")
    axes.set(xlabel="overlap", ylabel="contacts in 101 states", yscale="log", title="Overlaps")
    axes.legend(frameon=False)
    finish(picture, path)


def finish(picture: Picture, path: Path) -> None:
    for axes in picture.axes:
        axes.set_xlim(0.0, axes.dataLim.x1)
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    save(picture, path)


def draw_states(path: Path, results: Mapping[str, Result]) -> None:
    """Fig. 14, in a process of its own: it needs an X server."""
    result = results["linear_elastic"]
    labels = [f"{round(t * MS / result.values['dt'])}={t:g} ms" for t in SHOWN_MS]
    command = ["xvfb-run", "-a", sys.executable, str(HERE / "picture.py"), str(result.folder), str(path), *labels]
    subprocess.run(command, check=True, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})


PARAVIEW = ("blank.pvd", "blank_*.vtu", "spheres_*.vtp", "packing.data")


def case(name: str, keep: tuple[str, ...] = (), **variables: float | str) -> Case:
    return Case(name, "in.trb", rows, variables, keep=keep)


STUDY = Study(
    cases=[
        case("linear_elastic", PARAVIEW, law="linear_elastic"),
        case("saint_venant_kirchhoff", PARAVIEW, law="saint_venant_kirchhoff"),
        *(case(name, dt=COARSE_STEP, seed=seed) for name, seed in SEEDS.items()),
    ],
    figures=[
        Figure("fig13.png", list(LAWS), draw_history),
        Figure("fig14.png", ["linear_elastic"], draw_states),
        Figure("energy.png", ["linear_elastic"], draw_energies),
        Figure("overlaps.png", ["linear_elastic"], draw_overlaps),
    ],
    comparisons=[
        Comparison(list(SEEDS), seed_rows),
        Comparison(["linear_elastic", "saint_venant_kirchhoff", "packing_1"], law_rows),
    ],
)

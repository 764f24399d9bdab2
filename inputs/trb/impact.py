# SPDX-License-Identifier: GPL-2.0-or-later
"""A finished run of the deck, evaluated: balances of impulse and energy, means of the force, the packing."""

from __future__ import annotations

import sys
from functools import cached_property
from pathlib import Path

import numpy as np

from study.reference import hertz
from study.run.case import Result, material, read_csv

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
from states import State, read_states  # noqa: E402  (a file of this folder)

BLANK = material(HERE / "linear_elastic.yaml")
CREST = 6.0e-3  # half its width [m]


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

    def filtered_force(self) -> np.ndarray:
        """Means over 5 us, at every step [N]."""
        F, window = self.force["F"], np.ones(max(1, round(5e-6 / self.dt)))
        return np.convolve(F, window, "same") / np.convolve(np.ones_like(F), window, "same")

    def impulse_until(self, t: float) -> float:
        return float(np.interp(t, self.force["t"], self.impulse))

    def centre(self, t: float) -> float:
        return float(np.interp(t, self.force["t"], self.force["plate_displacement"]))

    def lowest_layer(self) -> int:
        """Spheres above the crest whose bottoms lie at most 50 um above the lowest one: they arrive within 5 us."""
        x, r = self.states[0].x, self.states[0].r
        bottom = x[:, 2] - r
        return int(np.sum((bottom < bottom.min() + 50e-6) & (np.abs(x[:, 0]) < CREST)))

    def start_overlap(self) -> float:
        """Between spheres before anything moves, in radii."""
        return float(max(self.states[0].overlaps()[1], default=0.0) / self.states[0].r.min())

    def overlaps(self) -> tuple[np.ndarray, np.ndarray]:
        """Of spheres with the blank and with each other, over all states, in radii and in effective diameters."""
        wall = [state.wall[1] / state.r[state.wall[0]] for state in self.states]
        pairs = [overlap / (2.0 * r) for r, overlap in (state.overlaps() for state in self.states)]
        return np.concatenate(wall), np.concatenate(pairs)

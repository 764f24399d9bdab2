# SPDX-License-Identifier: GPL-2.0-or-later
"""The dumped states of a run: spheres and contacts, and the energy that Hertz contacts hold."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Iterator

import numpy as np
from scipy.spatial import cKDTree

HEADER = 9  # lines of a dump before its entries


@dataclass(frozen=True)
class State:
    """All spheres at one step; id = row + 1.  Contacts with the blank: rows of the spheres, overlaps.  SI units."""

    step: int
    x: np.ndarray  # [spheres, 3]
    v: np.ndarray  # [spheres, 3]
    r: np.ndarray  # [spheres]
    wall: tuple[np.ndarray, np.ndarray]

    def overlaps(self) -> tuple[np.ndarray, np.ndarray]:
        """Of the spheres with each other: effective radius and overlap of every contact, from the positions alone."""
        i, j = cKDTree(self.x).query_pairs(2.0 * self.r.max(), output_type="ndarray").T
        overlap = self.r[i] + self.r[j] - np.linalg.norm(self.x[i] - self.x[j], axis=1)
        touch = overlap > 0.0
        return (self.r[i] * self.r[j] / (self.r[i] + self.r[j]))[touch], overlap[touch]

    def contact_energy(self, E_star: float) -> float:
        """The work of Hertz forces 4/3 E* sqrt(r*) d^1.5 from 0 to d, over all contacts [J]."""
        spheres, blank = self.overlaps(), (self.r[self.wall[0]], self.wall[1])
        return sum(float(np.sum(8.0 / 15.0 * E_star * np.sqrt(r) * d**2.5)) for r, d in (spheres, blank))

    def kinetic_energy(self, rho: float) -> float:
        """Of translation [J]; without friction nothing spins."""
        return float(np.sum(0.5 * rho * 4.0 / 3.0 * np.pi * self.r**3 * np.sum(self.v**2, axis=1)))


def frames(path: Path, columns: int) -> Iterator[tuple[int, np.ndarray]]:
    """Step and table of each state in a LIGGGHTS text dump."""
    lines = path.read_text(encoding="utf-8").splitlines()
    at = 0
    while at < len(lines):
        step, count = int(lines[at + 1]), int(lines[at + 3])
        at += HEADER
        words = " ".join(lines[at : at + count])
        yield step, np.array(words.split(), dtype=float).reshape(-1, columns)
        at += count


def read_states(folder: Path) -> list[State]:
    """All states of a run in `folder`."""
    return [
        State(step, s[:, 1:4], s[:, 4:7], s[:, 7], (c[:, 0].astype(int) - 1, np.maximum(c[:, 1], 0.0)))
        for (step, s), (_, c) in zip(frames(folder / "spheres.dump", 8), frames(folder / "contacts.dump", 2))
    ]

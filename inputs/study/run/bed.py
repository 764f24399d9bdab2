# SPDX-License-Identifier: GPL-2.0-or-later
"""A bed of particles in a turning drum, from a dump: its slope."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from study.run.pulse import NoPulse

LEAST_COLUMNS = 5  # of particles, for a straight line through their tops
WINDOW = 0.6  # of the drum's radius to either side of its middle: where the slope of a bed is measured


def slope(x: np.ndarray, y: np.ndarray, z: np.ndarray, radius: float, cell: float) -> float:
    """Angle [rad] of the free surface of a bed in a drum that turns about +y, so that the bed climbs towards -x.

    In the middle part of the surface the topmost centre of each square cell is taken, of these the median over the length
    of the drum, and a straight line is fitted; cells stand upright on the line, so this is repeated until it lies still.
    """
    angle = math.atan2(-np.mean(x), -np.mean(z))
    for _ in range(20):
        up = -x * math.cos(angle) + z * math.sin(angle)
        out = x * math.sin(angle) + z * math.cos(angle)
        middle = np.abs(up) < WINDOW * radius
        columns, rows = (np.floor(v[middle] / cell).astype(int) for v in (up, y))
        if len(set(columns)) < LEAST_COLUMNS:
            raise NoPulse("the bed is too small to have a slope; -var count N makes it larger")
        columns, rows = columns - columns.min(), rows - rows.min()
        top = np.full((columns.max() + 1, rows.max() + 1), -np.inf)
        np.maximum.at(top, (columns, rows), out[middle])
        heights = np.median(top, axis=1)
        (filled,) = np.nonzero(np.isfinite(heights))
        change = math.atan(np.polyfit(cell * filled, heights[filled], 1)[0])
        angle += change
        if abs(change) < 1e-6:
            break
    return angle


@dataclass(frozen=True)
class Frame:
    """A step of a dump, particles in the order of their ids: columns by name."""

    step: int
    values: dict[str, np.ndarray]


def read_frames(text: str) -> list[Frame]:
    """All steps of `dump custom id ...`."""
    frames = []
    for part in text.split("ITEM: TIMESTEP\n")[1:]:
        head, _, body = part.partition("ITEM: ATOMS ")
        names, _, numbers = body.partition("\n")
        table = np.array(numbers.split(), dtype=float).reshape(-1, len(names.split()))
        table = table[np.argsort(table[:, names.split().index("id")])]
        frames.append(Frame(int(head.split()[0]), dict(zip(names.split(), table.T))))
    return frames

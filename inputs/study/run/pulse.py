# SPDX-License-Identifier: GPL-2.0-or-later
"""Peak, duration and impulse of one contact, finer than the time between its samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


class NoPulse(ValueError):
    """The samples hold no complete contact."""


@dataclass(frozen=True)
class Pulse:
    """SI; `start` and `end` are the zero crossings of the overlap."""

    start: float
    end: float
    peak_time: float
    peak_force: float
    impulse: float

    @property
    def duration(self) -> float:
        return self.end - self.start


def peak(t: np.ndarray, F: np.ndarray) -> tuple[float, float]:
    """Time and height of the top of the parabola through the three largest samples."""
    i = int(np.argmax(F))
    if not 0 < i < len(F) - 1:
        raise NoPulse("the force has no peak inside the run")
    below, top, above = F[i - 1 : i + 2]
    offset = 0.5 * (above - below) / (2.0 * top - below - above)
    return t[i] + offset * (t[i + 1] - t[i]), top + 0.25 * (above - below) * offset


def zero_crossings(t: np.ndarray, overlap: np.ndarray) -> tuple[float, float]:
    """Times [s] at which the signed overlap [m] first rises, then falls through zero (linear).

    LIGGGHTS prints nothing at step 0: if the first sample is in contact already, the line through
    the first two leads back to the start (overlap = V t; off by 1e-5 of a step in these decks).
    """
    inside = overlap > 0.0
    if not inside.any() or inside[-1]:
        raise NoPulse("no complete contact within the run; -var steps N makes it longer")
    first = int(np.argmax(inside))
    last = first + int(np.argmin(inside[first:]))

    def crossing(i: int) -> float:
        return t[i] - overlap[i] * (t[i] - t[i - 1]) / (overlap[i] - overlap[i - 1])

    return crossing(max(first, 1)), crossing(last)


def measure(t: np.ndarray, F: np.ndarray, overlap: np.ndarray) -> Pulse:
    """The first contact in samples of time [s] (equally spaced), force [N], signed overlap [m]."""
    start, end = zero_crossings(t, overlap)
    peak_time, peak_force = peak(t, F)
    return Pulse(start, end, peak_time, peak_force, impulse=float(np.sum(F) * (t[1] - t[0])))

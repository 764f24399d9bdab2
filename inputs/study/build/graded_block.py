# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks and plates whose elements are cubes of one size around the middle of their top, and grow from there on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping

import numpy as np

PLACES = ("corner", "edge", "centre")  # of an element: where the middle of the top is
QUARTER = "quarter"  # a quarter of an element from two of its sides: as any place, without symmetry
GROWTH = 1.3  # from one element to the next
EQUAL = 5  # elements on each side of the middle


def lengths(h: float, reach: float, largest: float, first: float) -> np.ndarray:
    """Element borders [m] from `first` outwards to at least `reach`: EQUAL elements of h, then growing ones."""
    borders, step = [first], h
    while borders[-1] < reach:
        if len(borders) > EQUAL:
            step = min(GROWTH * step, max(h, largest))
        borders.append(borders[-1] + step)
    return np.array(borders)


def across(h: float, reach: float, largest: float, inside: float) -> np.ndarray:
    """Borders from -reach to reach, at least: 0 is one of them, or `inside` an element by this share of it."""
    left, right = (lengths(h, reach, largest, share * h) for share in (inside, 1.0 - inside if inside else 0.0))
    return np.concatenate([-left[::-1], right if inside else right[1:]])


def open_knots(breaks: np.ndarray, degree: int) -> np.ndarray:
    return np.concatenate([[breaks[0]] * degree, breaks, [breaks[-1]] * degree])


def greville(knots: np.ndarray, degree: int) -> list[float]:
    """Control points for which x(xi) = xi."""
    return [float(knots[i + 1 : i + 1 + degree].mean()) for i in range(len(knots) - degree - 1)]


@dataclass(frozen=True)
class GradedBlock:
    """Lengths in m; its top is at z = 0."""

    h: float  # of the elements in the middle of the top
    place: str  # one of PLACES, or QUARTER
    half: float  # side over two, at least
    depth: float  # at least; exact with `layers`
    largest: float  # element
    degree: int = 2
    layers: int = 0  # equal ones, through the thickness of a plate; 0: graded, too
    degree_through: int | None = None  # of the thickness; None: as the others
    mass: str = "lumped"  # or corrected
    shear: str = "plain"  # or corrected

    def breaks(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        inside = {"corner": (0.0, 0.0), "edge": (0.5, 0.0), "centre": (0.5, 0.5), QUARTER: (0.25, 0.25)}[self.place]
        x, y = (across(self.h, self.half, self.largest, share) for share in inside)
        if self.layers:
            return x, y, np.linspace(-self.depth, 0.0, self.layers + 1)
        return x, y, -lengths(self.h, self.depth, self.largest, 0.0)[::-1]

    def model_file(self, material: Mapping[str, object]) -> str:
        """Of a solid of this material with free faces, its top as surface `top`."""
        degrees = [self.degree, self.degree, self.degree_through or self.degree]
        knots = [open_knots(breaks, p) for breaks, p in zip(self.breaks(), degrees)]
        x, y, z = (greville(k, p) for k, p in zip(knots, degrees))
        points = (f"[{a!r}, {b!r}, {c!r}]" for c in z for b in y for a in x)
        constants = ", ".join(f"{key}: {value}" for key, value in material.items())
        return (
            "units: si\ngeometry:\n  patches:\n"
            f"    - degrees: {degrees}\n"
            f"      knots: {[k.tolist() for k in knots]}\n"
            "      control_points:\n        [" + ",\n        ".join(points) + "]\n"
            f"material: {{{constants}}}\nintegration: {{mass: {self.mass}, shear: {self.shear}}}\n"
            "surfaces: {top: zeta+}\nprobes:\n  under_ball: {face: zeta+, at: [0.5, 0.5]}\n"
        )

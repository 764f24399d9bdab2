# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of `walls.py`, and the spheres on them: planes, a pipe, drums of any number of triangles.  Axes are along x,
the lowest place is z = 0."""

from __future__ import annotations

import numpy as np

from study.build.stl import Point
from study.build.waves import SIDE
from wall_runs import data_file

RADIUS = 31e-3  # of pipe and drums [m]
MARGIN = 10e-3  # of plane and pipe beside the spheres, of the box beside the walls
SPACING = 1.25e-3  # of the spheres, which have diameters of 0.8 to 1.2 mm
ABOVE = 0.65e-3  # of their centres
VELOCITY = "0 0.2 0"  # they slide and roll over the wall

Point2 = tuple[float, float]
Triangle = tuple[Point, Point, Point]
LOW, LENGTHS = (-MARGIN, -RADIUS - MARGIN), (SIDE + 2 * MARGIN, 2 * (RADIUS + MARGIN))  # of the plane, along x and y


def plane_words(low: Point2, lengths: Point2, elements: int) -> str:
    """Model file of a plane z = 0 from `low`, of so many elements in a row."""
    return (
        f"units: si\ngeometry: {{plane: {{origin: [{low[0]}, {low[1]}, 0], edges: [[{lengths[0]}, 0, 0], [0, {lengths[1]}, 0]], "
        f"elements: [{elements}, {elements}], degree: 2}}}}\nsurfaces: {{wall: all}}\n"
    )


PLANE = plane_words(LOW, LENGTHS, 31)
# Of a periodic box, and beyond it.
BOX_PLANE = plane_words((0.0, 0.0), (SIDE, SIDE), 62)
WIDER_PLANE = plane_words((-MARGIN, -MARGIN), (SIDE + 2 * MARGIN, SIDE + 2 * MARGIN), 62)
PIPE = (
    f"units: si\ngeometry: {{cylinder: {{origin: [{-MARGIN}, 0, {RADIUS}], axis: [1, 0, 0], radius: {RADIUS}, "
    f"length: {SIDE + 2 * MARGIN}, elements: [32, 8]}}}}\nsurfaces: {{wall: all}}\n"
)


def plane() -> list[Triangle]:
    """The plane in two triangles."""
    a, b, c, d = ((LOW[0] + i * LENGTHS[0], LOW[1] + j * LENGTHS[1], 0.0) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return [(a, b, c), (a, c, d)]


def drum(sides: int, bands: int) -> list[Triangle]:
    """A closed prism about the circle of RADIUS, a side below, each side in so many bands of two triangles: 2 sides
    (bands + 1) - 4 of them, normals outwards.  drum(4, 1) is a box."""
    angles = -0.5 * np.pi + 2.0 * np.pi / sides * (np.arange(sides + 1) - 0.5)
    angles[-1] = angles[0]
    y, z = RADIUS / np.cos(np.pi / sides) * np.stack([np.cos(angles), np.sin(angles)])
    rings = [[(x, b, RADIUS + c) for b, c in zip(y, z)] for x in np.linspace(0.0, SIDE, bands + 1)]
    found: list[Triangle] = []
    for near, far in zip(rings, rings[1:]):
        for a, b, c, d in zip(near, near[1:], far[1:], far):
            found += [(a, b, c), (a, c, d)]
    for i in range(1, sides - 1):
        near, far = rings[0], rings[-1]
        found += [(near[0], near[i + 1], near[i]), (far[0], far[i], far[i + 1])]
    return found


def spheres(hollow: bool) -> str:
    """LIGGGHTS data file: one layer, ABOVE the plane or, if `hollow`, the circle of RADIUS."""
    random = np.random.default_rng(1)
    across = 0.7 * RADIUS
    x, y = np.meshgrid(np.arange(SPACING, SIDE - SPACING, SPACING), np.arange(-across, across, SPACING))
    x, y = (a.ravel() + random.uniform(-0.02, 0.02, a.size) * SPACING for a in (x, y))
    z = RADIUS - np.sqrt((RADIUS - ABOVE) ** 2 - y**2) if hollow else np.full(x.size, ABOVE)
    half, top = 1.5 * RADIUS + MARGIN, 2.5 * RADIUS + MARGIN
    box = [(-2 * MARGIN, SIDE + 2 * MARGIN), (-half, half), (-half + RADIUS, top)]
    return data_file(box, random.uniform(0.4e-3, 0.6e-3, x.size), np.stack([x, y, z], axis=1), VELOCITY)

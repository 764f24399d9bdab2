# SPDX-License-Identifier: GPL-2.0-or-later
"""Random walls: the shapes of iga-solver/geometry_io/shape_reader.cpp, each with points near which balls may start.

Lengths in m.  Everything of interest is within 9 mm of the origin; the simulation box reaches from -BOX to BOX.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import Callable

import numpy as np

from geometry import NurbsSurface, axes, direction, text, unit

BOX = 0.015
FACET = math.radians(2.5)  # what a curved wall turns across one cell of its triangle twin


@dataclass
class Site:
    """A point of the surface, its unit normal, and the radius of the smallest hollow on the side that the normal shows (with
    the opposite sign: on the other side)."""

    point: np.ndarray
    normal: np.ndarray
    hollow: tuple[float, float] = (math.inf, math.inf)  # in front of the normal, behind it


@dataclass
class Wall:
    kind: str
    file: str | bytes  # the geometry or model file
    site: Callable[[Random], Site]
    surface: str = "wall"
    name: str = "wall.yaml"  # of the file
    placement: str = ""  # scale, move and rotate
    slots: int = 0  # contacts that a ball may have; 0: what the fix has unless told otherwise
    primitive: str = ""  # words of the same wall as a stock primitive
    facet: float | None = None  # angle between a facet of the twin and the surface [rad]; 0: the twin is exact; None: no twin
    twin: int = 1
    curvature: float = 0.0  # the largest of the surface, where there is a curved twin
    outward: bool = False  # balls start on the side of the normal alone
    deforms: bool = False
    corrected: bool = False  # compliance corrected
    material: tuple[float, float] | None = None  # E and nu of a solid
    stable_step: float = math.inf  # of a solid, from below [s]


def rigid(shape: str) -> str:
    return f"units: si\ngeometry:\n  {shape}\nsurfaces: {{wall: all}}\n"


def in_disc(rng: Random, radius: float) -> tuple[float, float]:
    r, a = radius * math.sqrt(rng.random()), rng.uniform(0, 2 * math.pi)
    return r * math.cos(a), r * math.sin(a)


def stock_plane(rng: Random, periodic: tuple[bool, bool, bool]) -> Wall:
    """Normal to a coordinate axis, beyond the box on all sides; across periodic faces it spans the box exactly."""
    axis = rng.choice([k for k in range(3) if not periodic[k]])
    height = rng.uniform(-2e-3, 2e-3)
    u, v = (k for k in range(3) if k != axis)
    origin, edges = np.zeros(3), np.zeros((2, 3))
    origin[axis] = height
    skew = 0.0 if any(periodic) else rng.uniform(-0.3, 0.3)
    for row, k in enumerate((u, v)):
        reach = BOX if periodic[k] else BOX * rng.uniform(1.5, 2.0)
        origin[k], edges[row][k] = -reach, 2 * reach
    edges[0][v], origin[v] = skew * BOX, origin[v] - 0.5 * skew * BOX
    shape = (
        f"plane: {{origin: {text(origin)}, edges: [{text(edges[0])}, {text(edges[1])}], "
        f"elements: [{rng.randint(1, 17)}, {rng.randint(1, 17)}], degree: {rng.randint(1, 4)}}}"
    )
    normal = np.eye(3)[axis] * rng.choice((1, -1))

    def site(rng: Random) -> Site:
        point = np.zeros(3)
        point[axis] = height
        reach = BOX - 1e-4 if any(periodic) else 0.6 * BOX
        point[u], point[v] = rng.uniform(-reach, reach), rng.uniform(-reach, reach)
        return Site(point, normal)

    return Wall("plane", rigid(shape), site, primitive=f"{'xyz'[axis]}plane {height!r}")


def stock_cylinder(rng: Random, periodic: tuple[bool, bool, bool]) -> Wall:
    """Along a coordinate axis, beyond the box or exactly through it."""
    along = [k for k in range(3) if not any(periodic[j] for j in range(3) if j != k)]
    axis = rng.choice(along)
    u, v = (axis + 1) % 3, (axis + 2) % 3
    radius = rng.uniform(2.5e-3, 7e-3)
    centre = np.zeros(3)
    centre[u], centre[v] = rng.uniform(-2e-3, 2e-3), rng.uniform(-2e-3, 2e-3)
    half = BOX if periodic[axis] else 1.4 * BOX
    origin = centre - half * np.eye(3)[axis]
    shape = (
        f"cylinder: {{origin: {text(origin)}, axis: {text(np.eye(3)[axis])}, radius: {radius!r}, length: {2 * half!r}, "
        f"elements: [{4 * rng.randint(1, 6)}, {rng.randint(1, 9)}], degree: [{rng.randint(2, 4)}, {rng.randint(1, 4)}]}}"
    )

    def site(rng: Random) -> Site:
        angle = rng.uniform(0, 2 * math.pi)
        normal = np.zeros(3)
        normal[u], normal[v] = math.cos(angle), math.sin(angle)
        point = centre + radius * normal
        point[axis] = rng.uniform(-0.5, 0.5) * BOX
        return Site(point, normal, (math.inf, radius))

    place = f"{float(centre[u])!r} {float(centre[v])!r}"  # LIGGGHTS' order is cyclic: z, x for a ycylinder
    return Wall("cylinder", rigid(shape), site, primitive=f"{'xyz'[axis]}cylinder {radius!r} {place}")


def tilted_plane(rng: Random) -> Wall:
    """One element, whose twin is two triangles; balls start clear of both diagonals."""
    frame = axes(direction(rng), direction(rng))
    side = 0.03
    origin = frame @ np.array([-side / 2, -side / 2, rng.uniform(-1e-3, 1e-3)])
    edges = side * frame[:, 0], side * frame[:, 1]
    shape = (
        f"plane: {{origin: {text(origin)}, edges: [{text(edges[0])}, {text(edges[1])}], elements: [1, 1], "
        f"degree: {rng.randint(1, 4)}}}"
    )
    u, v = rng.choice([(0.5, 0.2), (0.8, 0.5), (0.2, 0.5), (0.5, 0.8)])

    def site(rng: Random) -> Site:
        a, b = in_disc(rng, 2.2e-3 / side)
        return Site(origin + (u + a) * edges[0] + (v + b) * edges[1], frame[:, 2] * rng.choice((1, -1)))

    return Wall("tilted plane", rigid(shape), site, facet=0.0)


def arc_elements(rng: Random, angle: float) -> int:
    """A multiple of the arcs of at most 90 degrees, elements of 10 to 45 degrees."""
    arcs = max(1, math.ceil(angle / 90.0 - 1e-9))
    return arcs * rng.randint(max(1, math.ceil(angle / arcs / 45.0)), 4)


def twin_of(turn: float, radius: float) -> dict[str, float]:
    """Of elements that turn by so much and have this radius of curvature at least: cells per element, and the angle between
    a facet and the surface, half of what the normal turns across a cell, with room for its diagonal and unequal cells."""
    cells = min(math.ceil(turn / FACET), 12)  # LIGGGHTS aborts where a ball meets too many triangles at once
    return {"twin": cells, "facet": 0.5 * math.sqrt(2) * 1.3 * turn / cells, "curvature": 1 / radius}


def sphere(rng: Random) -> Wall:
    axis, centre, radius = direction(rng), 1e-3 * direction(rng), rng.uniform(2.5e-3, 6e-3)
    south = rng.choice((-90.0, rng.uniform(-80, -10)))
    north = 90.0 if south > -90 else rng.choice((90.0, rng.uniform(10, 80)))
    n, m = arc_elements(rng, 360.0), arc_elements(rng, north - south)
    degree = rng.randint(2, 4)
    shape = (
        f"sphere: {{centre: {text(centre)}, axis: {text(axis)}, radius: {radius!r}, latitude: [{south!r}, {north!r}], "
        f"elements: [{n}, {m}], degree: {degree}}}"
    )
    frame = axes(axis)
    low, high = (math.sin(math.radians(t)) for t in (south if south == -90 else south + 20, north if north == 90 else north - 20))

    def site(rng: Random) -> Site:
        z, a = rng.uniform(low, high), rng.uniform(0, 2 * math.pi)
        rho = math.sqrt(1 - z * z)
        normal = frame @ np.array([rho * math.cos(a), rho * math.sin(a), z])
        return Site(centre + radius * normal, normal, (math.inf, radius))

    turn = max(2 * math.pi / n, math.radians(north - south) / m)
    return Wall("sphere", rigid(shape), site, **twin_of(turn, radius))


def cone(rng: Random) -> Wall:
    axis, length = direction(rng), rng.uniform(8e-3, 12e-3)
    radii = [rng.uniform(3e-3, 6e-3), rng.choice((0.0, rng.uniform(3e-3, 6e-3)))]
    rng.shuffle(radii)
    origin = -0.5 * length * axis
    n = arc_elements(rng, 360.0)
    shape = (
        f"cone: {{origin: {text(origin)}, axis: {text(axis)}, radii: {radii!r}, length: {length!r}, "
        f"elements: [{n}, {rng.randint(1, 5)}], degree: [{rng.randint(2, 4)}, {rng.randint(1, 4)}]}}"
    )
    frame, slope = axes(axis), (radii[1] - radii[0]) / length

    def site(rng: Random) -> Site:
        # where the cone is wide enough for a ball inside, and off its ends
        t = next(t for t in iter(lambda: rng.uniform(0.15, 0.85), None) if radii[0] + t * slope * length > 1.5e-3)
        a, rho = rng.uniform(0, 2 * math.pi), radii[0] + t * slope * length
        round_axis = frame @ np.array([math.cos(a), math.sin(a), 0.0])
        normal = unit(round_axis - slope * frame[:, 2])
        return Site(origin + t * length * frame[:, 2] + rho * round_axis, normal, (math.inf, rho * math.hypot(1, slope)))

    return Wall("cone", rigid(shape), site, **twin_of(2 * math.pi / n, 1.5e-3))


def torus(rng: Random) -> Wall:
    axis, centre = direction(rng), 1e-3 * direction(rng)
    tube = rng.uniform(1.8e-3, 2.5e-3)
    radius = tube + rng.uniform(1.8e-3, 4e-3)
    n, m = arc_elements(rng, 360.0), arc_elements(rng, 360.0)
    shape = (
        f"torus: {{centre: {text(centre)}, axis: {text(axis)}, radius: {radius!r}, tube_radius: {tube!r}, "
        f"elements: [{n}, {m}], degree: {rng.randint(2, 3)}}}"
    )
    frame = axes(axis)

    def site(rng: Random) -> Site:
        a, b = rng.uniform(0, 2 * math.pi), rng.uniform(0, 2 * math.pi)
        out = frame @ np.array([math.cos(a), math.sin(a), 0.0])
        normal = math.cos(b) * out + math.sin(b) * frame[:, 2]
        return Site(centre + radius * out + tube * normal, normal, (radius - tube, tube))

    turn = max(2 * math.pi / m, 2 * math.pi / n)  # the normal turns with either angle, at most as fast
    return Wall("torus", rigid(shape), site, **twin_of(turn, min(tube, radius - tube)))


def waves(rng: Random) -> Wall:
    """A rational patch of random height and weights."""
    p = rng.randint(2, 4), rng.randint(2, 4)
    n = [rng.randint(4, 7), rng.randint(4, 7)]
    side, height = 16e-3, rng.uniform(0.0, 2.5e-4)
    knots = []
    for q, count in zip(p, n):
        inner = sorted(rng.uniform(0.85, 1.15) * (k + 1) / (count + 1) for k in range(count - 1))
        knots.append([0.0] * (q + 1) + [t for t in inner if t < 0.95] + [1.0] * (q + 1))
    greville = [[sum(k[i + 1 : i + q + 1]) / q for i in range(len(k) - q - 1)] for k, q in zip(knots, p)]
    frame = axes(direction(rng), direction(rng))

    def control_point(u: float, v: float) -> np.ndarray:
        return frame @ [(u - 0.5) * side, (v - 0.5) * side, rng.uniform(-height, height)]

    points = [[control_point(u, v) for v in greville[1]] for u in greville[0]]
    weights = [[rng.uniform(0.85, 1.15) for _ in greville[1]] for _ in greville[0]]
    patch = NurbsSurface(p, knots, points, weights)
    least = 1.0 / max(patch.largest_curvature(), 1e-9)

    def site(rng: Random) -> Site:
        xi, eta = rng.uniform(0.15, 0.85), rng.uniform(0.15, 0.85)
        return Site(patch.point(xi, eta), patch.normal(xi, eta), (0.6 * least, 0.6 * least))

    element = 1.5 * side / min(len(set(k)) - 1 for k in knots)
    file = f"units: si\ngeometry:\n  patches:\n    - {patch.yaml()}\nsurfaces: {{wall: all}}\n"
    return Wall("waves", file, site, **twin_of(element / least, least))


CURVED = (sphere, cone, torus, waves)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of triangles, as lists of triangles [m]: plates, boxes, what turns about an axis, buckets, troughs."""

from __future__ import annotations

import math
from typing import Sequence

Point = Sequence[float]
Triangles = list[tuple[Point, Point, Point]]


def sheet(a: Point, b: Point, c: Point, d: Point, n: int = 1, m: int = 1) -> Triangles:
    """The flat quadrangle a b c d in n x m cells (n along a b) of two triangles."""

    def at(i: int, j: int) -> Point:
        s, t = i / n, j / m
        return tuple((1 - s) * ((1 - t) * p + t * q) + s * ((1 - t) * u + t * v) for p, u, v, q in zip(a, b, c, d))

    cells = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(n) for j in range(m)]
    return [triangle for p, q, r, s in cells for triangle in ((p, q, r), (p, r, s))]


def plate(x: Sequence[float], y: Sequence[float], z: float, n: int = 1, m: int = 1) -> Triangles:
    """Horizontal, at the height z."""
    return sheet((x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z), n, m)


def sides(x: Sequence[float], y: Sequence[float], z: Sequence[float], n: int = 1) -> Triangles:
    """The four upright faces of a box."""
    corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
    pairs = zip(corners, corners[1:] + corners[:1])
    return [t for p, q in pairs for t in sheet((*p, z[0]), (*q, z[0]), (*q, z[1]), (*p, z[1]), n, n)]


def tray(x: Sequence[float], y: Sequence[float], z: Sequence[float], n: int = 1) -> Triangles:
    """A box without a lid."""
    return plate(x, y, z[0], n, n) + sides(x, y, z, n)


def turned(profile: Sequence[tuple[float, float]], facets: int, centre: Sequence[float] = (0.0, 0.0)) -> Triangles:
    """A profile of (radius, height) turned about an upright axis; radius 0 is a point on it."""

    def at(r: float, z: float, i: int) -> Point:
        angle = 2.0 * math.pi * (i % facets) / facets
        return (centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle), z)

    triangles = []
    for (r, z), (u, w) in zip(profile, profile[1:]):
        for i in range(facets):
            a, b, c, d = at(r, z, i), at(r, z, i + 1), at(u, w, i + 1), at(u, w, i)
            triangles += ([(a, b, c)] if r > 0.0 else []) + ([(a, c, d)] if u > 0.0 else [])
    return triangles


def bucket(centre: Point, radius: float, y: Sequence[float], facets: int) -> Triangles:
    """The lower half of a lying cylinder along y with both ends."""
    cx, _, cz = centre
    angles = [math.pi * (1.0 + i / facets) for i in range(facets + 1)]
    rim = [(cx + radius * math.cos(a), cz + radius * math.sin(a)) for a in angles]
    triangles = []
    for (x, z), (u, w) in zip(rim, rim[1:]):
        triangles += sheet((x, y[0], z), (u, y[0], w), (u, y[1], w), (x, y[1], z))
        triangles += [((cx, end, cz), (x, end, z), (u, end, w)) for end in y]
    return triangles


def trough(length: float, width: float, height: float, slope: float, n: int, m: int) -> Triangles:
    """A slide along +x that falls by `slope` [degree] from (0, 0, 0), with a side wall along each edge."""
    run, drop, half = length * math.cos(math.radians(slope)), length * math.sin(math.radians(slope)), width / 2.0
    floor = sheet((0, -half, 0), (run, -half, -drop), (run, half, -drop), (0, half, 0), n, m)
    walls = [sheet((0, y, 0), (run, y, -drop), (run, y, height - drop), (0, y, height), n) for y in (-half, half)]
    return floor + walls[0] + walls[1]

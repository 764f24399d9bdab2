# SPDX-License-Identifier: GPL-2.0-or-later
"""Triangles as LIGGGHTS' `fix mesh/surface` reads them."""

from __future__ import annotations

from typing import Iterable, Sequence

Point = Sequence[float]


def stl(triangles: Iterable[tuple[Point, Point, Point]]) -> str:
    """ASCII STL [m], all digits; LIGGGHTS works the normals out by itself."""
    facets = []
    for corners in triangles:
        vertices = "".join("vertex {!r} {!r} {!r}\n".format(*map(float, corner)) for corner in corners)
        facets.append(f"facet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\n")
    return "solid wall\n" + "".join(facets) + "endsolid wall\n"

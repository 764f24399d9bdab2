# SPDX-License-Identifier: GPL-2.0-or-later
"""Random walls that are faces of solids: rigid ones, and the skins of solids that deform."""

from __future__ import annotations

import math
from dataclasses import replace
from random import Random
from typing import Callable

import numpy as np

from geometry import axes, direction, text
from walls import Site, Wall


def closed_box(rng: Random) -> Wall:
    """All six faces; balls start anywhere outside, at edges and corners too."""
    size = np.array([rng.uniform(3e-3, 8e-3) for _ in range(3)])
    elements = [rng.randint(1, 4) for _ in range(3)]
    shape = f"box: {{origin: {text(-size / 2)}, size: {text(size)}, elements: {elements}, degree: {rng.randint(1, 3)}}}"
    return Wall("box", of_faces(shape, "xi-", "xi+", "eta-", "eta+", "zeta-", "zeta+"), on_box(-size / 2, size), outward=True)


def such_that(accepts: Callable[[Site], bool], site: Callable[[Random], Site]) -> Callable[[Random], Site]:
    return lambda rng: next(s for s in iter(lambda: site(rng), None) if accepts(s))


def of_faces(shape: str, *faces: str) -> str:
    return f"units: si\ngeometry:\n  {shape}\nsurfaces: {{wall: [{', '.join(faces)}]}}\n"


def on_box(origin, size, faces=range(6)) -> Callable[[Random], Site]:
    def site(rng: Random) -> Site:
        axis, end = divmod(rng.choice(list(faces)), 2)
        point = origin + np.array([rng.random() for _ in range(3)]) * size
        point[axis] = origin[axis] + end * size[axis]
        return Site(point, (2 * end - 1) * np.eye(3)[axis])

    return site


def rolled_plate(rng: Random) -> tuple[str, Callable[[Random], Site]]:
    """Two thicknesses and the ramp between them; its sites are on the two flat parts of the top, or below."""
    a, b = rng.uniform(1e-3, 2e-3), rng.uniform(1e-3, 2e-3)
    width, flat, ramp = 8e-3, 4e-3, 3e-3
    origin = np.array([-flat - ramp / 2, -width / 2, -1e-3])
    shape = (
        f"rolled_plate: {{origin: {text(origin)}, width: {width}, elements: [4, 1], degree: 2, strips: [\n"
        f"    {{length: {flat}, thickness: {a!r}, elements: 2}}, {{length: {ramp}, thickness: [{a!r}, {b!r}], elements: 2}},\n"
        f"    {{length: {flat}, thickness: {b!r}, elements: 2}}]}}"
    )
    left = on_box(origin, np.array([flat, width, a]), (4, 5))
    right = on_box(origin + np.array([flat + ramp, 0, 0]), np.array([flat, width, b]), (4, 5))
    return shape, lambda rng: rng.choice((left, right))(rng)


def tube(rng: Random, elements) -> tuple[str, Callable[[Random], Site]]:
    """Half a tube or more; its sites are inside and outside."""
    axis, length = direction(rng), 8e-3
    inner = rng.uniform(3e-3, 4e-3)
    outer, angle = inner + rng.uniform(1e-3, 2e-3), rng.choice((180.0, 270.0))
    origin = -0.5 * length * axis
    arcs = math.ceil(angle / 90)
    shape = (
        f"tube: {{origin: {text(origin)}, axis: {text(axis)}, inner_radius: {inner!r}, outer_radius: {outer!r}, "
        f"length: {length}, angle: [0, {angle}], elements: [{2 * arcs}, {elements[0]}, {elements[1]}]}}"
    )
    frame = axes(axis)

    def site(rng: Random) -> Site:
        a, radius, sign = math.radians(rng.uniform(10, angle - 10)), *rng.choice([(inner, -1), (outer, 1)])
        out = frame @ np.array([math.cos(a), math.sin(a), 0.0])
        point = origin + rng.uniform(0.1, 0.9) * length * frame[:, 2] + radius * out
        return Site(point, sign * out, (inner, math.inf) if sign < 0 else (math.inf, inner))

    return shape, site


def skin_of_plate_or_tube(rng: Random) -> Wall:
    """The inner and outer face of such a solid, as a rigid wall."""
    shape, site = rng.choice((rolled_plate, lambda rng: tube(rng, (3, 1))))(rng)
    return Wall("skin", of_faces(shape, "zeta-", "zeta+"), site, outward=True)


SOLID = """units: si
geometry:
  {shape}
material: {{law: {law}, youngs_modulus: {E!r}, poissons_ratio: {nu!r}, density: {rho!r}}}
boundary: [{{fix: [x, y, z], faces: [{fixed}]}}]
surfaces: {{wall: {face}}}
probes: {{middle: {{face: {face}, at: [0.5, 0.5]}}}}
"""


def corrected(rng: Random) -> Wall:
    """One whose contacts are corrected for what its mesh gives way."""
    return replace(solid(rng, (2, 3)), corrected=True)


def solid(rng: Random, degrees=(1, 2, 3)) -> Wall:
    """A deforming wall: a block, a rolled plate or a tube, held at two of its faces or at one."""
    kind = rng.choice(("box", "rolled_plate", "tube"))
    face = "zeta+"
    if kind == "box":
        size = np.array([rng.uniform(6e-3, 9e-3), rng.uniform(6e-3, 9e-3), rng.uniform(1e-3, 2e-3)])
        shape = f"box: {{origin: {text(-size / 2)}, size: {text(size)}, elements: [4, 3, 1], degree: {rng.choice(degrees)}}}"
        site = on_box(-size / 2, size, (5,))
    elif kind == "rolled_plate":
        shape, both = rolled_plate(rng)
        site = such_that(lambda s: s.normal[2] > 0, both)
    else:
        shape, both = tube(rng, (3, 1))
        face = rng.choice(("zeta-", "zeta+"))
        site = such_that(lambda s: math.isfinite(s.hollow[0]) == (face == "zeta-"), both)
    E, nu, rho = 10 ** rng.uniform(6.8, 7.2), rng.uniform(0.0, 0.4), rng.uniform(1500, 3000)
    sound = math.sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * rho))
    text_of_file = SOLID.format(
        shape=shape, law=rng.choice(("linear_elastic", "saint_venant_kirchhoff")), E=E, nu=nu, rho=rho, face=face,
        fixed=rng.choice(("xi-, xi+", "xi-", "eta-, eta+")),
    )
    return Wall(
        "solid " + kind, text_of_file, site, outward=True, deforms=True, material=(E, nu), stable_step=0.15 * 1e-3 / sound
    )


RIGID = (closed_box, skin_of_plate_or_tube)

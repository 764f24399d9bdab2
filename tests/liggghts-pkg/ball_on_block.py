# SPDX-License-Identifier: GPL-2.0-or-later
"""The decks that several tests vary: one ball (or more) on an elastic block that is a NURBS solid."""

from __future__ import annotations

from prelude import INTEGRATION, Prelude, create

RADIUS = 1e-3
DENSITY = 2480.0
BOX = "-0.02 0.02 -0.02 0.02 -0.005 0.02"

BLOCK = """
units: {units}
geometry:
  box: {{origin: [{x0}, {y0}, {z0}], size: [{lx}, {ly}, {lz}], elements: {elements}, degree: 2}}
material: {{law: linear_elastic, youngs_modulus: {E}, poissons_ratio: {nu}, density: {rho}}}
{boundary}
surfaces: {{top: zeta+}}
probes: {{top_centre: {{face: zeta+, at: [0.5, 0.5]}}}}
"""


def block(
    size=(4e-3, 4e-3, 2e-3),
    elements=(4, 4, 2),
    youngs_modulus=5e9,
    nu=0.3,
    density=1000.0,
    fixed=("zeta-",),
    units="si",
) -> str:
    """Model file of a block with its top at z = 0, centred below the origin."""
    boundary = f"boundary: [{{fix: [x, y, z], faces: [{', '.join(fixed)}]}}]" if fixed else ""
    return BLOCK.format(
        units=units, x0=-size[0] / 2, y0=-size[1] / 2, z0=-size[2], lx=size[0], ly=size[1], lz=size[2],
        elements=list(elements), E=youngs_modulus, nu=nu, rho=density, boundary=boundary,
    )


def settings(
    *,
    ball=(5e9, 0.3),
    wall=(5e9, 0.3),
    restitution=1.0,
    friction=0.0,
    timestep=1e-8,
    models="model hertz tangential no_history",
    units="si",
    processors="* * *",
) -> Prelude:
    """Atom type 1 is the ball, type 2 the wall."""
    # LIGGGHTS wants hard_particles for E > 1e9 Pa in SI
    return Prelude(
        BOX, E=(ball[0], wall[0]), nu=(ball[1], wall[1]), e=restitution, mu=friction, models=models, timestep=timestep,
        units=units, processors=processors, particles="hard",
    )


def prelude(*, balls=((0.0, 0.0, RADIUS),), velocity=(0.0, 0.0, -1.0), restart="", **words) -> str:
    """A deck up to, but without, `fix wall`, or one that continues from the file `restart`; further words as for `settings`."""
    start = settings(**words)
    return (start.again(restart) if restart else start.text() + thrown(balls, velocity)) + INTEGRATION


def thrown(centres, velocity) -> str:
    return f"""{create(*centres)}set group all diameter {2 * RADIUS} density {DENSITY}
velocity all set {velocity[0]} {velocity[1]} {velocity[2]}
"""


def wall(models="model hertz tangential no_history", rest="structure block.yaml surface top") -> str:
    return f"fix plate all wall/nurbs {models} type 2 {rest}\n"


def output(columns=(), every=1, more=()) -> str:
    """Thermo columns with 17 digits: the ball's motion (z, vz, fz, ...) and what is asked for `more`, the kinetic energy of all particles
    (KinEng), and f_plate[n] as plate<n>: LIGGGHTS' own header cuts names after eight characters."""
    values = {name: f"{name}[1]" for name in ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", *more)}
    values |= {f"plate{c}": f"f_plate[{c}]" for c in columns}
    variables = "\n".join(f"variable {name} equal {value}" for name, value in values.items())
    shown = " ".join(f"v_{name}" for name in values)
    return f"{variables}\nthermo_style custom step {shown} ke\nthermo_modify format float %.17g lost error\nthermo {every}\n"

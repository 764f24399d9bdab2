# SPDX-License-Identifier: GPL-2.0-or-later
"""The deck of the moving walls: balls at a flat wall that is a NURBS patch or, for LIGGGHTS' own features, two triangles."""

from __future__ import annotations

import numpy as np

import decks

RADIUS, DENSITY, YOUNG, POISSON = 1e-3, 2500.0, 1e8, 0.3
HALF = 8e-3  # of the square wall

NURBS_FILE = f"""
units: si
geometry:
  plane: {{origin: [{-HALF}, {-HALF}, 0], edges: [[{2 * HALF}, 0, 0], [0, {2 * HALF}, 0]], elements: [7, 5], degree: 2}}
surfaces: {{floor: all}}
"""

DECK = """
units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
processors {processors}
region box block -0.04 0.04 -0.02 0.02 -0.02 0.02 units box
create_box 2 box
neighbor {skin!r} bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype {young!r} {young!r}
fix m2 all property/global poissonsRatio peratomtype 0.3 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 2 {e} {e} {e} {e}
fix m4 all property/global coefficientFriction peratomtypepair 2 {mu} {mu} {mu} {mu}
fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1
pair_style gran {models}
pair_coeff * *
timestep {dt!r}
{atoms}
set group all diameter 0.002 density 2500
set atom 1 vx {velocity[0]} vy {velocity[1]} vz {velocity[2]}
{before}
{wall}
fix integrate all nve/sphere
"""

OUTPUT = (
    """
compute spin all property/atom omegax omegay omegaz
variable fx equal fx[1]
variable fy equal fy[1]
variable fz equal fz[1]
"""
    + decks.BALL
    + """\
{more}
thermo_style custom step v_fx v_fy v_fz v_x v_y v_z v_vx v_vy v_vz v_wx v_wy v_wz {columns}
thermo_modify format float %.17g lost error
thermo {every}
"""
)
# at rest: a rank without any atom cannot evaluate a ball's spin
FAR_AWAY = ((-0.03, 0.0, 0.01), (0.03, 0.0, 0.01))
KINDS = {"f": ("fx", "fy", "fz"), "x": ("x", "y", "z"), "v": ("vx", "vy", "vz"), "w": ("wx", "wy", "wz")}


def triangles(height=0.0) -> str:
    """The wall as two triangles in an STL file, cut along the diagonal x = y."""
    a, b, c, d = ((x, y, float(height)) for x, y in ((-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)))
    lines = ["solid flat"]
    for corners in ((a, b, c), (a, c, d)):
        lines += ["facet normal 0 0 1", "outer loop"]
        lines += ["vertex " + " ".join(f"{x:.17g}" for x in corner) for corner in corners]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid flat"]) + "\n"


FILES = {"flat.yaml": NURBS_FILE, "flat.stl": triangles()}


def nurbs_wall(models: str, drive: str) -> str:
    return f"fix wall all wall/nurbs {models} type 2 geometry flat.yaml surface floor {drive}"


def stock_wall(models: str, motions=(), style: str = "mesh/surface", drive: str = "") -> str:
    """fix mesh/surface with its own words `drive`, and one fix move/mesh for each of `motions`."""
    lines = [f"fix cad all {style} file flat.stl type 2 {drive}"]
    lines += [f"fix move{n} all move/mesh mesh cad {motion}" for n, motion in enumerate(motions)]
    return "\n".join(lines + [f"fix wall all wall/gran {models} mesh n_meshes 1 meshes cad"])


def deck(
    wall: str,
    *,
    balls=((3e-3, -2e-3, 1.05e-3),),
    velocity=(0.3, 0.2, -1.0),
    e=0.7,
    mu=0.3,
    dt=5e-7,
    skin=2e-4,
    models="model hertz tangential history",
    before="",
    processors="* 1 1",
) -> str:
    atoms = "\n".join(f"create_atoms 1 single {x!r} {y!r} {z!r} units box" for x, y, z in tuple(balls) + FAR_AWAY)
    return DECK.format(
        wall=wall, atoms=atoms, velocity=velocity, e=e, mu=mu, dt=dt, skin=skin, models=models, before=before,
        processors=processors, young=YOUNG,
    )


def output(more: str = "", columns: str = "", every: int = 1) -> str:
    return OUTPUT.format(more=more, columns=columns, every=every)


def largest_differences(a, b) -> dict[str, float]:
    """Of force, position, velocity and spin of ball 1: largest difference of two tables relative to the largest value."""
    return {
        kind: decks.largest_difference(*(np.array([table[column] for column in columns]) for table in (a, b)))
        for kind, columns in KINDS.items()
    }


def both(wall_words, stock_words, run: str, **options):
    """The same deck with the NURBS wall and with LIGGGHTS' own: two thermo tables."""
    models = options.get("models", "model hertz tangential history")
    ours = deck(nurbs_wall(models, wall_words), **options) + run
    stock = deck(stock_wall(models, **stock_words), **options) + run
    return (
        decks.good(ours, files=FILES).table,
        decks.good(stock, files=FILES, program=decks.STOCK).table,
    )

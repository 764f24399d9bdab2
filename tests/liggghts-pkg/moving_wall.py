# SPDX-License-Identifier: GPL-2.0-or-later
"""The deck of the moving walls: balls at a flat wall that is a NURBS patch or, for LIGGGHTS' own features, two triangles."""

from __future__ import annotations

import numpy as np

import decks
from prelude import INTEGRATION, Prelude, create

RADIUS, DENSITY, YOUNG, POISSON = 1e-3, 2500.0, 1e8, 0.3
HALF = 8e-3  # of the square wall

NURBS_FILE = f"""
units: si
geometry:
  plane: {{origin: [{-HALF}, {-HALF}, 0], edges: [[{2 * HALF}, 0, 0], [0, {2 * HALF}, 0]], elements: [7, 5], degree: 2}}
surfaces: {{floor: all}}
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
THROW = f"set group all diameter {2 * RADIUS} density {DENSITY}\nset atom 1 vx {{}} vy {{}} vz {{}}\n"
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


def settings(
    *,
    e=0.7,
    mu=0.3,
    dt=5e-7,
    skin=2e-4,
    models="model hertz tangential history",
    processors="* 1 1",
    box="-0.04 0.04 -0.02 0.02 -0.02 0.02",
    boundary="f f f",
) -> Prelude:
    return Prelude(
        box, E=(YOUNG, YOUNG), nu=(POISSON, POISSON), e=e, mu=mu, further={"coefficientRollingFriction": 0.1},
        models=models, timestep=dt, skin=skin, lists="delay 0", boundary=boundary, processors=processors,
    )


def deck(wall: str, *, balls=((3e-3, -2e-3, 1.05e-3),), velocity=(0.3, 0.2, -1.0), before="", restart="", **words) -> str:
    """The first ball is thrown at the wall, whose fix stands after `before`, or the deck continues from the file `restart`;
    further words as for `settings`."""
    start = settings(**words)
    begin = start.again(restart) if restart else start.text() + create(*balls, *FAR_AWAY) + THROW.format(*velocity)
    return f"{begin}{before}\n{wall}\n{INTEGRATION}"


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

# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks of one ball on walls of several patches: what its tests write them with, and compare them by."""

import ball_on_block as bob
import decks
import numpy as np
from prelude import INTEGRATION, Prelude

R = bob.RADIUS
MODELS = "model hertz tangential history rolling_friction epsd2"
GRAVITY = "fix g all gravity 9.81 vector -0.3 0.2 -0.9\n"
COLUMNS = ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", "wx", "wy", "wz")
OUTPUT = (
    "".join(f"variable {c} equal {c}[1]\n" for c in COLUMNS[:9])
    + "compute spin all property/atom omegax omegay omegaz\n"
    + "".join(f"variable w{c} equal c_spin[1][{k}]\n" for k, c in enumerate("xyz", 1))
)
TABLE = (
    "thermo_style custom step {columns}{more}\nthermo_modify format float %.17g lost error flush yes\nthermo {every}\nrun {steps}\n"
)


def patch(points, degrees=(1, 1), knots=None) -> str:
    """A patch of the model file; points[j][i], clamped knots unless given."""
    n = (len(points[0]), len(points))
    clamped = [[0] * d + np.linspace(0, 1, c - d + 1).tolist() + [1] * d for d, c in zip(degrees, n)]
    flat = [list(map(float, p)) for row in points for p in row]
    return f"    - {{degrees: {list(degrees)}, knots: {knots or clamped}, control_points: {flat}}}\n"


def model_file(*patches: str) -> dict[str, str]:
    return {"wall.yaml": "units: si\ngeometry:\n  patches:\n" + "".join(patches) + "surfaces: {wall: all}\n"}


def quad(origin, u, v, n=(2, 2)) -> str:
    """A parallelogram with n x n control points."""
    o, u, v = (np.array(a, dtype=float) for a in (origin, u, v))
    return patch([[o + a * u + b * v for a in np.linspace(0, 1, n[0])] for b in np.linspace(0, 1, n[1])])


def settings(*, e=0.6, mu=0.4, timestep=2e-6, boundary="f f f", box=bob.BOX, processors="* * *") -> Prelude:
    return Prelude(
        box, E=(5e7, 5e7), nu=(0.3, 0.3), e=e, mu=mu, further={"coefficientRollingFriction": 0.02}, models=MODELS,
        timestep=timestep, boundary=boundary, processors=processors, lists="delay 0",
    )


def prelude(ball, velocity, *, gravity=True, restart="", **words) -> str:
    """A deck up to the wall, or one that continues from the file `restart`; further words as for `settings`."""
    start = settings(**words)
    begin = start.again(restart) if restart else start.text() + bob.thrown([ball], velocity)
    return begin + INTEGRATION + (GRAVITY if gravity else "")


def nurbs(more: str = "") -> str:
    columns = "variable n equal f_wall[7]\nvariable deepest equal f_wall[8]\n"
    return f"fix wall all wall/nurbs {MODELS} type 2 geometry wall.yaml surface wall {more}\n" + columns


def planes(*words: str) -> str:
    return "".join(
        f"fix wall{k} all wall/gran {MODELS} primitive type 2 {word} 0.0\n" for k, word in enumerate(words)
    )


def table(steps: int, every: int = 20, more: str = "", ranks: int = 1) -> str:
    """Prints every so many steps; the spin on one rank only, since LIGGGHTS cannot on ranks without particles."""
    columns = " ".join(f"v_{c}" for c in (COLUMNS if ranks == 1 else COLUMNS[:9]))
    return TABLE.format(columns=columns, steps=steps, every=every, more=more)


def run(start: str, wall: str, files=None, *, steps=4000, every=20, more="", ranks=1, **options) -> decks.Run:
    deck = start + wall + OUTPUT + table(steps, every, more, ranks)
    return decks.good(deck, files=files, ranks=ranks, **options)


def difference(ours: dict, reference: dict) -> float:
    """Largest over all columns, relative to the largest of its kind (position, velocity, force, spin)."""
    worst = 0.0
    common = [c for c in COLUMNS if c in ours]
    for column in common:
        kind = [c for c in common if c[:-1] == column[:-1]]
        scale = max(abs(reference[c]).max() for c in kind)
        worst = max(worst, abs(ours[column] - reference[column]).max() / scale)
    return worst


L = 0.03
FLOOR = quad((0, -L / 2, 0), (L, 0, 0), (0, L, 0))
SIDE = quad((0, -L / 2, 0), (0, 0, L), (0, L, 0))
# one patch round the corner: degree 2, a C0 knot in the corner; bent along xi or along eta
ROUND = [[(0, y, L), (0, y, L / 2), (0, y, 0), (L / 2, y, 0), (L, y, 0)] for y in (-L / 2, 0, L / 2)]
KINK, STRAIGHT = [0, 0, 0, 0.5, 0.5, 1, 1, 1], [0, 0, 0, 1, 1, 1]
FOLDED = patch(ROUND, degrees=(2, 2), knots=[KINK, STRAIGHT])
FOLDED_ALONG_ETA = patch(list(zip(*ROUND)), degrees=(2, 2), knots=[STRAIGHT, KINK])

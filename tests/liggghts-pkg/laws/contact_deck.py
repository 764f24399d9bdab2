# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks of one contact: a ball on a rigid plane, or two balls.  SI units.

Ball and plane (type 2) have the materials of Gao & Feng (2019), Table 2.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Iterable

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import decks  # noqa: E402
from prelude import Prelude  # noqa: E402

RADIUS, OTHER_RADIUS = 1e-3, 1.5e-3
DENSITY = 2480.0
YOUNG = (74.6e9, 210.6e9)
POISSON = (0.2285, 0.286)
SPEED = 1.0
LAWS = ("penalty/linear", "penalty/hertz", "penalty/quadratic")
EXPONENT = dict(zip(LAWS, (1.0, 1.5, 2.0)))
PLASTIC = "plastic/thornton"


def mass(radius: float) -> float:
    return 4.0 / 3.0 * math.pi * radius**3 * DENSITY


def effective_modulus(i: int, j: int) -> float:
    """E* of two types, counted from 1."""
    return 1.0 / sum((1.0 - POISSON[t - 1] ** 2) / YOUNG[t - 1] for t in (i, j))


def run_each(parts: Iterable[str], **options) -> list[dict]:
    """Thermo tables of several decks, run one after the other in one process with `clear` between them."""
    parts = list(parts)
    tables = decks.good("\nclear\n".join(parts), **options).tables
    if len(tables) != len(parts):
        raise AssertionError(f"{len(parts)} decks gave {len(tables)} tables")
    return tables


def begin(models: str, restitution=1.0, friction=0.0, factor=1.0, yield_pressure=(1e30, 1e30)) -> str:
    """An empty box, all material properties that any contact model may ask for, and the model of pairs."""
    further = {
        "coefficientRollingFriction": 0.05,
        "coefficientRollingViscousDamping": 0.1,
        "rollingStiffness": "scalar 2.0",
        "cohesionEnergyDensity": 1e6,
        "penaltyFactor": factor,
        "yieldPressure": "peratomtype {!r} {!r}".format(*yield_pressure),
        "surfaceLiquidContentInitial": "scalar 0.01",
        "surfaceTension": "scalar 0.07",
        "fluidViscosity": "scalar 0.1",
        "contactAngle": "peratomtype 0.2 0.2",
        "minSeparationDistanceRatio": "scalar 0.01",
        "maxSeparationDistanceRatio": "scalar 1.1",
    }
    return Prelude(
        "-0.01 0.01 -0.01 0.01 -0.01 0.01", E=YOUNG, nu=POISSON, e=restitution, mu=friction, further=further, models=models,
        skin=5e-4, lists="delay 0", processors="* 1 1", particles="hard",
    ).text()


def watch(atoms: Iterable[int], every: int, dt: float) -> str:
    """Integration, and a thermo table of the atoms' whole state with 17 digits, which tell every bit."""
    quantities = "x y z vx vy vz fx fy fz omegax omegay omegaz".split()
    variables = {f"{quantity}{atom}": f"{quantity}[{atom}]" for atom in atoms for quantity in quantities}
    lines = [f"variable {name} equal {value}" for name, value in variables.items()]
    return (
        "\n".join(lines)
        + f"""
fix integrate all nve/sphere
timestep {dt!r}
thermo_style custom step {" ".join("v_" + name for name in variables)}
thermo {every}
thermo_modify lost ignore norm no format float %.17g
"""
    )


def ball_on_plane(
    models: str,
    *,
    settings="",
    velocity=(0.0, 0.0, -SPEED),
    spin=(0.0, 0.0, 0.0),
    overlap=0.0,
    every=1,
    dt=1e-8,
    **properties,
) -> str:
    """Ball 1 at z = r - overlap above a stock plane z = 0 of type 2; `models` are the words from `model`."""
    return (
        begin("model hertz tangential no_history", **properties)
        + f"""\
create_atoms 1 single 0 0 {RADIUS - overlap!r} units box
set group all density {DENSITY} diameter {2 * RADIUS!r}
velocity all set {velocity[0]} {velocity[1]} {velocity[2]}
set group all omegax {spin[0]} omegay {spin[1]} omegaz {spin[2]}
fix wall all wall/gran {models} primitive type 2 zplane 0. {settings}
"""
        + watch((1,), every, dt)
    )


def two_balls(
    models: str,
    *,
    settings="",
    velocity=(SPEED, 0.0, 0.0),
    spin=(0.0, 0.0, 0.0),
    overlap=0.0,
    every=1,
    dt=1e-8,
    **properties,
) -> str:
    """Ball 1 (type 1) with the given velocity meets ball 2 (type 2, larger) at rest; contact at x = 0."""
    return (
        begin(f"{models} {settings}", **properties)
        + f"""\
create_atoms 1 single {-RADIUS + overlap!r} 0 0 units box
create_atoms 2 single {OTHER_RADIUS!r} 0 0 units box
group one type 1
set group all density {DENSITY} diameter {2 * OTHER_RADIUS!r}
set group one density {DENSITY} diameter {2 * RADIUS!r}
velocity one set {velocity[0]} {velocity[1]} {velocity[2]}
set group one omegax {spin[0]} omegay {spin[1]} omegaz {spin[2]}
"""
        + watch((1, 2), every, dt)
    )

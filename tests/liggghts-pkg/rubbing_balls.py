# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck of balls that hit and rub on walls, and what it prints of each: place, velocity, spin, force, torque."""

from __future__ import annotations

import math

import numpy as np

from prelude import INTEGRATION, Prelude, create

R, DENSITY, DT = 1e-3, 2500.0, 1e-6
MASS = DENSITY * 4 / 3 * math.pi * R**3
INERTIA = 0.4 * MASS * R**2
FRICTION = "model hertz tangential history"

MOTION = "set atom {} vx {!r} vy {!r} vz {!r} omegax {!r} omegay {!r} omegaz {!r}\n"
COMPUTES = "compute spin all property/atom omegax omegay omegaz\ncompute twist all property/atom tqx tqy tqz\n"


def deck(walls, balls, *, models=FRICTION, e=0.7, mu=0.3, young=1e8, nu=0.3, factor=1.0, dt=DT, more="", columns=()):
    """`balls`: (place, velocity, spin) of each; `walls`: the commands.  Prints x v w f t of each ball, and `columns`."""
    start = Prelude(
        "-0.03 0.03 -0.03 0.03 -0.03 0.03", E=(young, young), nu=(nu, nu), e=e, mu=mu, models=models, timestep=dt,
        further={"coefficientRollingFriction": 0.2, "penaltyFactor": factor}, lists="delay 0",
    )
    text = start.text() + create(*(place for place, _, _ in balls)) + f"set type 1 diameter {2 * R!r} density {DENSITY!r}\n"
    text += "".join(MOTION.format(k, *v, *w) for k, (_, v, w) in enumerate(balls, 1))
    text += f"{more}\n{walls}\n{INTEGRATION}{COMPUTES}"
    names = []
    for k in range(1, len(balls) + 1):
        own = {c: f"{c}[{k}]" for c in ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz")}
        for d, c in enumerate("xyz", 1):
            own |= {f"w{c}": f"c_spin[{k}][{d}]", f"t{c}": f"c_twist[{k}][{d}]"}
        text += "".join(f"variable {name}{k} equal {value}\n" for name, value in own.items())
        names += [f"v_{name}{k}" for name in own]
    thermo = f"thermo_style custom step {' '.join(names)} {' '.join(columns)}\nthermo_modify format float %.17g lost error\n"
    return text + thermo + "thermo 1\n"


def vectors(table, kind: str, ball: int = 1) -> np.ndarray:
    return np.array([table[f"{kind}{c}{ball}"] for c in "xyz"]).T

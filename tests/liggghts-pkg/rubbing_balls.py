# SPDX-License-Identifier: GPL-2.0-or-later
"""A deck of balls that hit and rub on walls, and what it prints of each: place, velocity, spin, force, torque."""

from __future__ import annotations

import math

import numpy as np

R, DENSITY, DT = 1e-3, 2500.0, 1e-6
MASS = DENSITY * 4 / 3 * math.pi * R**3
INERTIA = 0.4 * MASS * R**2
FRICTION = "model hertz tangential history"

DECK = """
units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block -0.03 0.03 -0.03 0.03 -0.03 0.03 units box
create_box 2 box
neighbor 2e-4 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype {young!r} {young!r}
fix m2 all property/global poissonsRatio peratomtype {nu!r} {nu!r}
fix m3 all property/global coefficientRestitution peratomtypepair 2 {e} {e} {e} {e}
fix m4 all property/global coefficientFriction peratomtypepair 2 {mu} {mu} {mu} {mu}
fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0.2 0.2 0.2 0.2
fix m6 all property/global penaltyFactor peratomtypepair 2 {factor!r} {factor!r} {factor!r} {factor!r}
pair_style gran {models}
pair_coeff * *
timestep {dt!r}
{atoms}
set type 1 diameter {diameter!r} density {density!r}
{motion}
{walls}
fix integrate all nve/sphere
compute spin all property/atom omegax omegay omegaz
compute twist all property/atom tqx tqy tqz
"""


def deck(walls, balls, *, models=FRICTION, e=0.7, mu=0.3, young=1e8, nu=0.3, factor=1.0, dt=DT, more="", columns=()):
    """`balls`: (place, velocity, spin) of each; `walls`: the commands.  Prints x v w f t of each ball, and `columns`."""
    atoms = "".join(f"create_atoms 1 single {x!r} {y!r} {z!r} units box\n" for (x, y, z), _, _ in balls)
    motion = ""
    for k, (_, v, w) in enumerate(balls, 1):
        motion += f"set atom {k} vx {v[0]!r} vy {v[1]!r} vz {v[2]!r} omegax {w[0]!r} omegay {w[1]!r} omegaz {w[2]!r}\n"
    text = DECK.format(
        atoms=atoms, motion=motion + more, walls=walls, models=models, e=e, mu=mu, young=young, nu=nu, factor=factor, dt=dt,
        diameter=2 * R, density=DENSITY,
    )
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

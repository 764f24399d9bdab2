# SPDX-License-Identifier: GPL-2.0-or-later
"""The kinds of decks: their walls of triangles, where no centre may be, and what is compared."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Callable, Mapping, Sequence

import numpy as np
from shapes import Triangles, bucket, plate, sides, sheet, tray, trough, turned

Places = Mapping[str, np.ndarray]  # columns of a frame, by name


@dataclass(frozen=True)
class Total:
    """A number of a run: a column of totals.txt over its windows, or `worn`, as `of` sums them up."""

    name: str
    unit: str
    column: str
    of: Callable[[np.ndarray], float]


@dataclass(frozen=True)
class Kind:
    """`passed` tells which centres are where only a particle can be that went through the wall."""

    name: str
    walls: Mapping[str, Triangles]
    passed: Callable[[Places], np.ndarray]
    totals: Sequence[Total]
    deck: str = ""  # its name if it is another
    variables: Mapping[str, str] = field(default_factory=dict)
    parallel: bool = True  # LIGGGHTS runs it on several ranks
    open: bool = False  # particles leave the box


def late(x: np.ndarray) -> float:
    """The mean of the second half of the windows."""
    return float(np.mean(x[len(x) // 2 :]))


def mean(x: np.ndarray) -> float:
    return float(np.mean(x))


def end(x: np.ndarray) -> float:
    """The mean of the last tenth."""
    return float(np.mean(x[-len(x) // 10 :]))


def peak(x: np.ndarray) -> float:
    return float(np.max(np.abs(x)))


HEIGHT, ENERGY = Total("height", "m", "z", end), Total("kinetic_energy", "J", "kinetic", mean)
SPIN, WEIGHT = Total("energy_of_spin", "J", "spin", mean), Total("force_z", "N", "fz", mean)
WORN = Total("worn_volume", "m^3", "worn", end)
COMMON = (HEIGHT, ENERGY, SPIN, WEIGHT)


def outside(x: Sequence[float], y: Sequence[float], z: Sequence[float], p: Places) -> np.ndarray:
    inside = [(low <= p[axis]) & (p[axis] <= high) for axis, (low, high) in zip("xyz", (x, y, z))]
    return ~(inside[0] & inside[1] & inside[2])


def out_of_profile(profile: Sequence[tuple[float, float]], p: Places) -> np.ndarray:
    """Beside a profile of (radius, height), at its heights."""
    height, radius = np.array(sorted((z, r) for r, z in profile)).T
    within = (p["z"] >= height[0]) & (p["z"] <= height[-1])
    return within & (np.hypot(p["x"], p["y"]) > np.interp(p["z"], height, radius))


# A funnel with its pipe, above a tray.
FUNNEL = [(0.13, 0.34), (0.035, 0.2), (0.035, 0.14)]
TRAY = ((-0.15, 0.15), (-0.15, 0.15), (0.0, 0.1))


def beside_funnel(p: Places) -> np.ndarray:
    below = (p["z"] < 0.1) & outside(TRAY[0], TRAY[1], (0.0, np.inf), p)
    return out_of_profile(FUNNEL, p) | below


BOX = ((-0.2, 0.2), (-0.1, 0.1), (0.0, 0.3))
TROUGH = dict(length=0.4, width=0.1, height=0.06, slope=35.0)


def below_trough(p: Places) -> np.ndarray:
    run = TROUGH["length"] * np.cos(np.radians(TROUGH["slope"]))
    over = (p["x"] > 0.0) & (p["x"] < run)
    return over & (p["z"] < -p["x"] * np.tan(np.radians(TROUGH["slope"])))


BELT = ((-0.2, 0.3), (-0.1, 0.1))
BIN = ((-0.5, -0.2), (-0.12, 0.12), (-0.3, 0.0))


def off_belt(p: Places) -> np.ndarray:
    """Through the belt, its sides or its back, or out of the bin."""
    over = p["x"] > BELT[0][0]
    return (over & outside(BELT[0], BELT[1], (0.0, np.inf), p)) | (~over & outside(*BIN[:2], (BIN[2][0], np.inf), p))


HOPPER = [(0.1, 0.4), (0.1, 0.2), (0.04, 0.08), (0.04, 0.07)]
HOPPER_BIN = ((-0.12, 0.12), (-0.12, 0.12), (-0.1, 0.0))


def beside_hopper(p: Places) -> np.ndarray:
    below = (p["z"] < 0.0) & outside(HOPPER_BIN[0], HOPPER_BIN[1], (HOPPER_BIN[2][0], np.inf), p)
    return out_of_profile(HOPPER, p) | below


CAN = [(0.0, 0.0), (0.05, 0.0), (0.05, 0.16)]


def out_of_can(p: Places) -> np.ndarray:
    return (np.hypot(p["x"], p["y"]) > 0.05) | (p["z"] < 0.0)


CUBE = ((-0.05, 0.05),) * 2
LID = plate((-0.049, 0.049), (-0.049, 0.049), 0.16)
PISTON = plate((0.001, 0.099), (0.001, 0.099), 0.2)
WIDE = ((-0.12, 0.12), (-0.12, 0.12), (0.0, 0.3))


def belt_frame() -> Triangles:
    x, (low, high) = BELT
    edges = [sheet((x[0], y, 0), (x[1], y, 0), (x[1], y, 0.15), (x[0], y, 0.15)) for y in (low, high)]
    back = sheet((x[1], low, 0), (x[1], high, 0), (x[1], high, 0.15), (x[1], low, 0.15))
    return edges[0] + edges[1] + back + tray(*BIN)


def can(name: str, model: str) -> Kind:
    walls = {"can.stl": turned(CAN, 48)}
    return Kind(name, walls, out_of_can, COMMON, "can", {"model": model})


KINDS = [
    Kind(
        "mesh_gran",
        {"funnel.stl": turned(FUNNEL, 24) + tray(*TRAY, n=2), "face.stl": plate((-0.05, 0.05), (-0.05, 0.05), 0.45)},
        beside_funnel,
        COMMON,
    ),
    Kind(
        "moving_mesh_gran",
        {"box.stl": tray(*BOX), "bucket.stl": bucket((-0.11, 0.0, 0.3), 0.06, (-0.05, 0.05), 12)},
        partial(outside, BOX[0], BOX[1], (0.0, np.inf)),
        (HEIGHT, ENERGY, SPIN, WEIGHT, Total("force_x", "N", "fx", mean), Total("lifted", "1", "extra", mean)),
    ),
    Kind(
        "chute_wear",
        {"trough.stl": trough(**TROUGH, n=12, m=4), "face.stl": plate((0.01, 0.05), (-0.03, 0.03), 0.15)},
        below_trough,
        (ENERGY, SPIN, WEIGHT, Total("force_x", "N", "fx", mean), Total("particles", "1", "particles", mean), WORN),
        open=True,
    ),
    Kind(
        "conveyor",
        {
            "belt.stl": plate(*BELT, 0.0),
            "frame.stl": belt_frame(),
            "face.stl": plate((0.12, 0.27), (-0.07, 0.07), 0.25),
        },
        off_belt,
        (
            *COMMON,
            Total("force_x", "N", "fx", mean),
            Total("torque_y", "N m", "ty", mean),
            Total("in_the_bin", "1", "extra", end),
        ),
    ),
    Kind(
        "servo",
        {"box.stl": tray(*CUBE, (0.0, 0.2)), "lid.stl": LID},
        partial(outside, *CUBE, (0.0, np.inf)),
        (*COMMON, Total("lid", "m", "extra", end), Total("late_force_z", "N", "fz", late)),
    ),
    Kind(
        "hopper",
        {
            "hopper.stl": turned(HOPPER, 32),
            "gate.stl": plate((-0.05, 0.05), (-0.05, 0.05), 0.065),
            "bin.stl": tray(*HOPPER_BIN),
        },
        beside_hopper,
        (*COMMON, Total("run_out", "1", "extra", mean)),
    ),
    Kind(
        "mesh_shear",
        {f"{name}.stl": plate((0.0, 0.16), (0.0, 0.08), z, 8, 4) for name, z in (("bottom", 0.0), ("top", 0.12))},
        partial(outside, (-np.inf, np.inf), (-np.inf, np.inf), (0.0, 0.12)),
        (*COMMON, Total("force_x", "N", "fx", mean), Total("drift", "m/s", "extra", end)),
    ),
    Kind(
        "heat_transfer",
        {"can.stl": turned(CAN, 48)},
        out_of_can,
        (*COMMON, Total("heat", "J", "extra", end)),
    ),
    Kind(
        "multisphere",
        {"tray.stl": tray(*WIDE, n=4)},
        partial(outside, *WIDE[:2], (0.0, np.inf)),
        (HEIGHT, ENERGY, WEIGHT),
        parallel=False,
    ),
    can("cohesion", "hertz tangential history cohesion sjkr"),
    can("contact_models", "hertz tangential history rolling_friction epsd2"),
    can("hysteresis", "hooke/hysteresis tangential history"),
    Kind(
        "hydrogel",
        {"box.stl": tray((0.0, 0.1), (0.0, 0.1), (0.0, 0.25)), "piston.stl": PISTON},
        partial(outside, (0.0, 0.1), (0.0, 0.1), (0.0, np.inf)),
        (*COMMON, Total("peak_force", "N", "fz", peak)),
    ),
    Kind(
        "packing",
        {"box.stl": tray(*CUBE, (0.0, 0.1)) + plate(*CUBE, 0.1)},
        partial(outside, *CUBE, (0.0, 0.1)),
        COMMON,
    ),
]  # fmt: skip

# SPDX-License-Identifier: GPL-2.0-or-later
"""What a contact costs in `fix wall/nurbs` itself, beside LIGGGHTS' own plane: spheres at rest on the wall, each in
contact, the same run with and without the wall."""

from __future__ import annotations

import os
import re
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path
from typing import Sequence

import numpy as np

from study.run.summary import Row

SPHERES = 50  # per direction
DIAMETER = 0.016  # less than their spacing: they touch the wall only
ELEMENTS = 31
STEPS = (50, 1050)  # the difference of two runs has no set-up in it
REPETITIONS = 3

def settings(region: str, skin: float, materials: Sequence[str], restitution: float, friction: float, timestep: float, hard: bool = False) -> str:
    """What decks of spheres on a wall begin with; the wall is of type 2.  `materials`: Young's modulus and Poisson's ratio."""
    E, nu = materials
    return f"""
units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
{"hard_particles yes" if hard else ""}
region box block {region} units box
create_box 2 box
neighbor {skin} bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype {E} {E}
fix m2 all property/global poissonsRatio peratomtype {nu} {nu}
fix m3 all property/global coefficientRestitution peratomtypepair 2{4 * f" {restitution}"}
fix m4 all property/global coefficientFriction peratomtypepair 2{4 * f" {friction}"}
pair_style gran model hertz tangential history
pair_coeff * *
timestep {timestep}
"""


DECK = settings("-0.6 0.6 -0.6 0.6 -0.1 0.2", 0.001, ("1e7", "0.3"), 0.5, 0.5, 1e-6) + """\
{spheres}
set group all diameter {diameter} density 2500
{wall}
thermo_style custom step atoms {contacts}
thermo {steps}
run {steps}
"""
MODELS = "model hertz tangential history type 2"
NURBS = f"fix wall all wall/nurbs {MODELS} geometry wall.yaml surface floor"
PLANE = "fix wall all wall/gran model hertz tangential history primitive type 2 zplane 0."


def greville() -> np.ndarray:
    """Of ELEMENTS equal quadratic elements on [-1/2, 1/2]."""
    knots = np.concatenate([[0.0], np.linspace(0.0, 1.0, ELEMENTS + 1), [1.0]])
    return 0.5 * (knots[1:] + knots[:-1]) - 0.5


def control_net(amplitude: float) -> np.ndarray:
    """Heights z[eta, xi] of the control points."""
    wave = np.sin(4.0 * np.pi * greville())
    return amplitude * np.outer(wave, wave)


def geometry_file(amplitude: float) -> str:
    x = greville()
    points = [[x[i], x[j], z] for j, row in enumerate(control_net(amplitude)) for i, z in enumerate(row)]
    knots = [0.0, 0.0, *np.linspace(0.0, 1.0, ELEMENTS + 1).tolist(), 1.0, 1.0]
    return (
        "units: si\ngeometry:\n  patches:\n"
        f"    - {{degrees: [2, 2], knots: [{knots}, {knots}], control_points: {np.array(points).tolist()}}}\n"
        "surfaces: {floor: all}\n"
    )


def wave(amplitude: float, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points and unit normals of z = amplitude sin(4 pi x) sin(4 pi y), from which the patch differs by less than the
    spheres' overlap."""
    k = 4.0 * np.pi
    points = np.stack([x, y, amplitude * np.sin(k * x) * np.sin(k * y)])
    slopes = amplitude * k * np.stack([np.cos(k * x) * np.sin(k * y), np.sin(k * x) * np.cos(k * y)])
    normals = np.stack([-slopes[0], -slopes[1], np.ones_like(x)])
    return points, normals / np.linalg.norm(normals, axis=0)


def spheres(amplitude: float) -> str:
    """create_atoms commands of a grid of spheres that overlap the wall by about a third of their radius."""
    u = (np.arange(SPHERES) + 0.5) / SPHERES - 0.5
    points, normals = wave(amplitude, *(a.ravel() for a in np.meshgrid(0.95 * u, 0.95 * u)))
    centres = points + 0.7 * 0.5 * DIAMETER * normals
    return "\n".join("create_atoms 1 single {:.12g} {:.12g} {:.12g} units box".format(*c) for c in centres.T)


def cpu_seconds(program: str, folder: str) -> float:
    """User and system time of one run; raises if it fails."""
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [program, "-in", "in.deck", "-log", "log"], cwd=folder, env=environment, capture_output=True, check=False
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(f"{program} failed: {done.stdout.decode(errors='replace')[-1000:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def contacts(log: str) -> int:
    """Last number of the thermo table's last row, the last line before the loop time that is all numbers."""
    lines = log.split("Loop time")[0].splitlines()
    row = next(line.split() for line in reversed(lines) if re.fullmatch(r"\s*\d+(\s+\d\S*)+\s*", line))
    return int(float(row[-1]))


def seconds_per_step(program: str, wall: str, amplitude: float) -> tuple[float, int]:
    """CPU time of a step, and what the deck's last thermo column says (the contacts, with our wall)."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "wall.yaml").write_text(geometry_file(amplitude))
        seconds = []
        for steps in STEPS:
            column = "f_wall[7]" if wall == NURBS else ""
            deck = DECK.format(
                spheres=spheres(amplitude), diameter=DIAMETER, wall=wall, contacts=column, steps=steps
            )
            (Path(folder) / "in.deck").write_text(deck)
            seconds.append(cpu_seconds(program, folder))
        return (seconds[1] - seconds[0]) / (STEPS[1] - STEPS[0]), contacts((Path(folder) / "log").read_text())


def rows(program: str) -> list[Row]:
    """CPU time per contact and step of each wall, the contact model included; runs take turns."""
    walls = {"plane of LIGGGHTS": (PLANE, 0.0), "plate": (NURBS, 0.0), "wavy": (NURBS, 0.03)}
    times: dict[str, list[float]] = {name: [] for name in walls}
    for _ in range(REPETITIONS):
        for name, (wall, amplitude) in walls.items():
            without, count = seconds_per_step(program, "", amplitude)
            with_wall, found = seconds_per_step(program, wall, amplitude)
            if found != count:
                raise RuntimeError(f"{name}: {found} contacts, expected one for each of {count} spheres")
            times[name].append((with_wall - without) / count)
    quantity = "wall_fix_with_contact_model_per_contact_time"
    return [Row(f"fix, {name}", quantity, 1e9 * statistics.median(t), "ns") for name, t in times.items()]

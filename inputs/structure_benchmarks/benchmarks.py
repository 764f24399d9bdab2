# SPDX-License-Identifier: GPL-2.0-or-later
"""Solids without particles beside closed forms and published numbers: each case is a model file that iga-solve is given.

usage: inputs/run structure_benchmarks [--case NAME] [--out DIR] [--solver IGA_SOLVE]
"""

from __future__ import annotations

import math
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Sequence

import yaml

from study.run.summary import Row

Model = dict
ALL = ["x", "y", "z"]


@dataclass(frozen=True)
class Printed:
    """What iga-solve prints of an analysis."""

    text: str

    def probe(self, name: str) -> list[float]:
        return [float(word) for word in re.search(rf"probe {name}: (.*)", self.text)[1].split()]

    def frequencies(self) -> list[float]:
        return [float(word) for word in re.findall(r"frequency (\S+)", self.text)]


@dataclass(frozen=True)
class Benchmark:
    name: str
    mesh: str
    quantity: str
    model: Model
    value: Callable[[Printed], float]
    reference: float
    tolerance: float  # relative


def box(size: Sequence[float], elements: Sequence[int], degree: int | Sequence[int]) -> Model:
    return {"box": {"origin": [0, 0, 0], "size": list(size), "elements": list(elements), "degree": degree}}


def model(geometry: Model, material: Sequence, boundary: Sequence[Model], analysis: Model, **more) -> Model:
    law, E, nu, density = material
    constants = {"law": law, "youngs_modulus": E, "poissons_ratio": nu, "density": density}
    return {
        "units": "si", "geometry": geometry, "material": constants, "boundary": list(boundary), "analysis": analysis, **more,
    }  # fmt: skip


def fix(directions: Sequence[str], *faces: str) -> Model:
    return {"fix": list(directions), "faces": list(faces)}


def mesh_of(elements: Sequence[int], degree: int | Sequence[int]) -> str:
    return f"{' x '.join(map(str, elements))}, p = {degree}"


def plate_frequency(h: float, reference: float, clamped: bool, elements: Sequence[int], tolerance: float) -> Benchmark:
    """omega a^2 sqrt(rho h / D) of the first mode of a quarter; simply supported: nothing moves along the sides but u_n."""
    E, nu = 1.0, 0.3
    D = E * h**3 / (12 * (1 - nu**2))
    sides = [fix(ALL, "xi-", "eta-")] if clamped else [fix(["y", "z"], "xi-"), fix(["x", "z"], "eta-")]
    symmetry = [fix(["x"], "xi+"), fix(["y"], "eta+")]
    degree = [3, 3, 2]
    return Benchmark(
        f"{'clamped' if clamped else 'supported'} plate, h/a = {h:g}", mesh_of(elements, degree), "omega a^2 sqrt(rho h/D)",
        model(box([0.5, 0.5, h], elements, degree), ("linear_elastic", E, nu, 1.0), sides + symmetry,
              {"kind": "modes", "count": 1}),
        lambda printed: 2 * math.pi * printed.frequencies()[0] * math.sqrt(h / D), reference, tolerance,
    )  # fmt: skip


def thin_plate(clamped: bool, reference: float) -> Benchmark:
    """w D / (q a^4) at the middle of a thin plate, a quarter of it."""
    E, nu, h, q, elements, degree = 1e6, 0.3, 0.01, 1e-3, [16, 16, 1], [3, 3, 2]
    D = E * h**3 / (12 * (1 - nu**2))
    sides = [fix(ALL, "xi-", "eta-")] if clamped else [fix(["y", "z"], "xi-"), fix(["x", "z"], "eta-")]
    return Benchmark(
        f"{'clamped' if clamped else 'supported'} plate under pressure", mesh_of(elements, degree), "w D/(q a^4)",
        model(box([0.5, 0.5, h], elements, degree), ("linear_elastic", E, nu, 1.0),
              sides + [fix(["x"], "xi+"), fix(["y"], "eta+")], {"kind": "static"},
              loads={"tractions": [{"face": "zeta+", "value": [0, 0, q]}]},
              probes={"middle": {"face": "zeta-", "at": [1.0, 1.0]}}),
        lambda printed: printed.probe("middle")[2] * D / q, reference, 5e-3,
    )  # fmt: skip


def cantilever(elements: Sequence[int], mode: int, reference: float) -> Benchmark:
    """omega L^2 sqrt(rho A/(E I)) of 10 x 1 x 1, nu = 0, in the plane x, z."""
    return Benchmark(
        f"cantilever, mode {mode + 1}", mesh_of(elements, 2), "omega L^2 sqrt(rho A/EI)",
        model(box([10, 1, 1], elements, 2), ("linear_elastic", 1.0, 0.0, 1.0), [fix(ALL, "xi-"), fix(["y"], "eta-", "eta+")],
              {"kind": "modes", "count": 3}),
        lambda printed: 2 * math.pi * printed.frequencies()[mode] * 100 * math.sqrt(12), reference, 1e-3,
    )  # fmt: skip


def elastica(alpha: float, component: int, reference: float) -> Benchmark:
    """Displacements over L of the end of a cantilever, L/h = 100, under a dead load alpha E I/L^2."""
    E, elements, degree = 12e4, [16, 1, 1], [3, 2, 3]
    load = alpha * E / 12 / 100**2
    return Benchmark(
        f"elastica, alpha = {alpha:g}", mesh_of(elements, degree), "vu"[component == 0] + "/L",
        model(box([100, 1, 1], elements, degree), ("saint_venant_kirchhoff", E, 0.0, 1.0), [fix(ALL, "xi-")],
              {"kind": "static", "load_steps": 4}, loads={"tractions": [{"face": "xi+", "value": [0, 0, load]}]},
              probes={"end": {"face": "xi+", "at": [0.5, 0.5]}}),
        lambda printed: abs(printed.probe("end")[component]) / 100, reference, 1e-3,
    )  # fmt: skip


def uniaxial(law: str, stress: float, stretch: float) -> Benchmark:
    """Stretch of a block under a first Piola-Kirchhoff stress, E = 1000, nu = 0.3."""
    return Benchmark(
        f"{law}, P = {stress:g}", mesh_of([1, 1, 1], 2), "stretch",
        model(box([1, 1, 1], [1, 1, 1], 2), (law, 1000.0, 0.3, 1.0),
              [fix(["x"], "xi-"), fix(["y"], "eta-"), fix(["z"], "zeta-")], {"kind": "static", "load_steps": 2, "tolerance": 1e-11},
              loads={"tractions": [{"face": "xi+", "value": [stress, 0, 0]}]},
              probes={"end": {"face": "xi+", "at": [1.0, 1.0]}}),
        lambda printed: 1.0 + printed.probe("end")[0], stretch, 1e-8,
    )  # fmt: skip


def roof(elements: int, degree: int, reference: float) -> Benchmark:
    """Scordelis and Lo's roof, solid, one layer: 80 degrees of a cylinder, R = 25, L = 50, t = 0.25, 90 per area."""
    half, R, t = math.radians(40), 25.0, 0.25
    angles = [(-half, 1.0, 1.0), (0.0, 1.0 / math.cos(half), math.cos(half)), (half, 1.0, 1.0)]
    points, weights = [], []
    for r in (R - t / 2, R + t / 2):
        for y in (0.0, 50.0):
            for angle, further, weight in reversed(angles):  # right-handed
                points.append([-r * further * math.sin(angle), y, r * further * math.cos(angle)])
                weights.append(weight)
    patch = {
        "degrees": [2, 1, 1], "knots": [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 1, 1]],
        "control_points": points, "weights": weights,
    }  # fmt: skip
    refine = {"degree": [degree, degree, 2], "divide": [elements, elements, 1]}
    return Benchmark(
        "Scordelis-Lo roof", mesh_of([elements, elements, 1], [degree, degree, 2]), "deflection of the free edge",
        model({"patches": [patch], "refine": refine}, ("linear_elastic", 4.32e8, 0.0, 1.0),
              [fix(["x", "z"], "eta-", "eta+"), {"fix": ["y"], "corner": ["xi-", "eta-", "zeta-"]}], {"kind": "static"},
              loads={"gravity": [0, 0, -90.0 / t]},
              probes={"edge": {"face": "xi+", "at": [0.5, 0.5]}}),
        lambda printed: -printed.probe("edge")[2], reference, 2e-3,
    )  # fmt: skip


BENCHMARKS = [
    plate_frequency(0.1, 19.09005, False, [16, 16, 4], 5e-3),
    plate_frequency(0.02, 19.71164, False, [16, 16, 1], 5e-3),
    plate_frequency(0.05, 35.11, True, [20, 20, 2], 1e-2),
    thin_plate(False, 0.0040624),
    thin_plate(True, 0.0012653),
    cantilever([10, 1, 1], 0, 3.4709),
    cantilever([20, 2, 2], 0, 3.4852),
    cantilever([20, 2, 2], 1, 20.786),
    *(elastica(alpha, c, value) for alpha, v, u in ((0.5, 0.162144, 0.015919), (1.0, 0.301721, 0.056433), (3.0, 0.603253, 0.254420))
      for c, value in ((2, v), (0, u))),
    *(uniaxial("neo_hooke", P, stretch) for P, stretch in ((-108.722185, 0.9), (174.929147, 1.2), (646.744660, 2.0))),
    uniaxial("saint_venant_kirchhoff", 937.5, 1.5),
    roof(16, 2, 0.2941), roof(8, 3, 0.3003), roof(16, 3, 0.3009),
]  # fmt: skip


def run(benchmark: Benchmark, solver: Path) -> Row:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "model.yaml").write_text(yaml.safe_dump(benchmark.model, default_flow_style=None), encoding="utf-8")
        done = subprocess.run([solver, "model.yaml"], cwd=folder, capture_output=True, text=True, check=False)
    value = benchmark.value(Printed(done.stdout)) if done.returncode == 0 else math.nan
    note = done.stderr.strip() if done.returncode else ""
    return Row(
        f"{benchmark.name} ({benchmark.mesh})", benchmark.quantity, value, "", benchmark.reference, benchmark.tolerance, note
    )

# SPDX-License-Identifier: GPL-2.0-or-later
"""Balls on thin plates of ever smaller elements.

References: three-dimensional elasticity (two independent programs of this project: axisymmetric finite elements with
rings of contact pressure, and the exact kernel of a layer less that of a half-space with Hertz' law; they agree to 0.03 %), and
for plates of equal elements an independent program on the same mesh, study/reference/meshed_plate.py.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Mapping, NamedTuple, Sequence

import numpy as np
from bounce import DECK, STEEL, impact, peak_force, rows, steps
from matplotlib.figure import Figure as Picture
from study.build.graded_block import GradedBlock
from study.reference import hertz
from study.reference.elastic_plate import ElasticPlateImpact
from study.reference.meshed_plate import MeshedPlate
from study.run.case import Case, Comparison, Figure, Result
from study.run.figures import COLOURS, MARKERS, save
from study.run.summary import Row

GLASS = {"law": "linear_elastic", "youngs_modulus": "74.6e9", "poissons_ratio": 0.2285, "density": 2480}
STEEL_BALL = {"E_ball": 210.6e9, "nu_ball": 0.286, "rho": 7850.0}


class Plate(NamedTuple):
    """Lengths in m; restitution and peak force [N] of three-dimensional elasticity."""

    thickness: float
    half: float  # side over two
    material: Mapping[str, object]
    ball: Mapping[str, float]
    restitution: float
    peak: float

    @property
    def constants(self) -> tuple[float, float, float]:
        """E [Pa], nu, rho [kg/m^3]."""
        return tuple(float(self.material[name]) for name in ("youngs_modulus", "poissons_ratio", "density"))


PLATES = {
    "Z1": Plate(1e-3, 13e-3, GLASS, {"r": 1.0e-3}, 0.7586, 4.911),
    "Z2": Plate(1e-3, 18e-3, GLASS, {**STEEL_BALL, "r": 1.0e-3}, 0.5336, 9.658),
    "Z3": Plate(1e-3, 30e-3, GLASS, {**STEEL_BALL, "r": 1.5e-3}, 0.2482, 16.058),
    "steel": Plate(0.5e-3, 13e-3, STEEL, {"r": 1.0e-3}, 0.6609, 5.344),
}


class Mesh(NamedTuple):
    """Of a plate."""

    ratio: float  # size of the elements over the thickness
    layers: int
    degree: int = 2  # through the thickness; in the plane 2
    mass: str = "lumped"  # or corrected
    shear: str = "plain"  # or corrected

    @property
    def is_single_quadratic(self) -> bool:
        return self.layers == 1 and self.degree == 2

    @property
    def shears_too_little(self) -> bool:
        """As the independent program says (README.md): one cubic layer, two, or corrected shear are needed."""
        return self.is_single_quadratic and self.shear == "plain"

    def of(self, plate: Plate, place: str) -> MeshedPlate:
        h, side = self.ratio * plate.thickness, 2.0 * plate.half
        factor = 5.0 / (6.0 - plate.constants[1]) if self.shear == "corrected" else 1.0
        return MeshedPlate(*plate.constants, plate.thickness, h, self.layers, place, side, degree_through=self.degree,
                           mass=self.mass, shear_factor=factor)  # fmt: skip


QUADRATIC = tuple(Mesh(*mesh) for mesh in ((1.0, 1), (0.5, 2), (0.25, 4)))
CUBIC = (Mesh(1.0, 1, 3), Mesh(0.5, 1, 3))
# On request:
FURTHER = tuple(Mesh(*mesh) for mesh in ((1.0, 2), (1.0, 4), (0.5, 1), (0.5, 4), (0.25, 1), (0.25, 1, 3), (0.25, 2), (0.125, 2), (0.125, 4)))
ALL_MESHES = (*QUADRATIC, *CUBIC, *FURTHER)
CORRECTED_MASS = tuple(mesh._replace(mass="corrected") for mesh in ALL_MESHES)
CORRECTED_SHEAR = tuple(mesh._replace(shear="corrected") for mesh in (*ALL_MESHES, *CORRECTED_MASS) if mesh.is_single_quadratic)
LARGE = ("Z3", Mesh(0.25, 4))  # half a minute: on request, too
# Of those in every run, two that miss gates with row sums and one that does with plain shear.
ALWAYS = (*((name, Mesh(1.0, 1, mass="corrected")) for name in ("Z2", "Z3")), ("Z2", Mesh(0.5, 1, shear="corrected")))
PLATE_PLACES = ("corner", "centre")
# Absolute of the restitution, relative of the force: for elements as large as the plate is thick, and for smaller ones.
PLATE_TOLERANCES = {True: (0.005, 0.01), False: (0.002, 0.004)}
# What single quadratic layers miss, beside all forces with smaller elements than the plate is thick.
MISSED_FORCE = (("Z2", 1.0, "corner"), ("Z3", 1.0, "corner"), ("Z3", 1.0, "centre"))
SOFT = ("Z2", "Z3")  # beside their balls: likewise with corrected mass
MISSED_RESTITUTION = (("Z3", 1.0, "corner"), ("Z3", 0.5, "corner"))
# Beside the independent program, of equal elements; of all meshes that shear as they should among each other.
SAME_MESH_TOLERANCES = {"lumped": (3e-4, 5e-4), "corrected": (4e-4, 7e-4)}  # by the mass: c ends with its patch, which shows more
SPREAD_TOLERANCES = (0.002, 0.003)
SPREAD_OF_FINE = ("Z3",)  # without elements as large as the plate is thick: the longer the contact the more their waves count
REFUSED = (("Z3", 0.125, "centre"),)  # too small for the contact: s comes to 0.9
# Damped contacts on plates, elements of half their thickness: coefficients of restitution of the law, relative tolerances.
DAMPED = (0.5, 0.8)
DAMPED_PLATES = ("Z1", "Z2", "steel")
DAMPED_TOLERANCES = (0.01, 0.03)
DELAY = 0.3  # of the reference, over h/c_T: twice as much changes restitutions by 1e-3 of themselves


def of_mesh(plate: Plate, mesh: MeshedPlate, result: Result) -> list[Row]:
    """What an independent program has on the same mesh."""
    found = mesh.impact(impact(result.values), result.values["dt"]) if result.as_published else (None, None)
    seen = (result.state["v"][-1] / result.values["V"], peak_force(result))
    e_tolerance, F_tolerance = SAME_MESH_TOLERANCES[mesh.mass]
    limits = (e_tolerance / plate.restitution, F_tolerance)
    return [
        Row(result.case, f"{name}_same_mesh", value, unit, reference, None if reference is None else limit)
        for name, unit, value, reference, limit in zip(("restitution", "peak_force"), "1N", seen, found, limits)
    ]


def plate_rows(name: str, mesh: Mesh, place: str, gated: bool, result: Result) -> list[Row]:
    plate, ratio = PLATES[name], mesh.ratio
    e_tolerance, F_tolerance = PLATE_TOLERANCES[ratio == 1.0]
    e, F = (plate.restitution, e_tolerance / plate.restitution), (plate.peak, F_tolerance)
    if mesh.shears_too_little:
        by_row_sums = mesh.mass == "lumped"
        if ratio < 1.0 and (by_row_sums or name in SOFT) or by_row_sums and (name, ratio, place) in MISSED_FORCE:
            F = ()
        if by_row_sums and (name, ratio, place) in MISSED_RESTITUTION:
            e = ()
    found = rows(*((F, e) if gated else ((), ())), result)
    if gated and ratio >= 0.5:
        found += of_mesh(plate, mesh.of(plate, place), result)
    return found


def plate_case(name: str, mesh: Mesh, place: str, compliance: str = "corrected") -> Case:
    plate = PLATES[name]
    h = mesh.ratio * plate.thickness
    block = GradedBlock(h, place, plate.half, plate.thickness, max(h, 0.5 * plate.thickness), layers=mesh.layers,
                        degree_through=mesh.degree, mass=mesh.mass, shear=mesh.shear)  # fmt: skip
    kind = "".join(f"_{word}" for word, holds in (("cubic", mesh.degree == 3), ("mass", mesh.mass == "corrected"),
                                                  ("shear", mesh.shear == "corrected")) if holds)  # fmt: skip
    case = f"{name}_{1e3 * h:g}mm_{mesh.layers}{kind}_{place}"
    if compliance == "none":
        case = f"none_{case}"
    file = f"{case}.yaml"
    E, nu, _ = plate.constants
    variables = {**plate.ball, "block": file, "compliance": compliance, "E_wall": E, "nu_wall": nu}
    of = partial(plate_rows, name, mesh, place, compliance == "corrected")
    on_request = (name, mesh) not in ALWAYS and (mesh in (*FURTHER, *CORRECTED_MASS, *CORRECTED_SHEAR) or (name, mesh) == LARGE)
    return Case(case, DECK, of, variables, partial(steps, 1.6),
                lambda _: {file: block.model_file(plate.material)}, on_request=on_request)  # fmt: skip


def damped_rows(name: str, result: Result) -> list[Row]:
    """Beside three-dimensional elasticity with the same law."""
    plate, values = PLATES[name], result.values
    rigid, e = impact(values), values["e"]
    E_star = hertz.effective_modulus(*(values[key] for key in ("E_ball", "nu_ball", "E_wall", "nu_wall")))
    zeta = -math.log(e) / math.hypot(math.log(e), math.pi)
    D = 2.0 * math.sqrt(5.0 / 6.0) * zeta * math.sqrt(2.0 * E_star * rigid.m * math.sqrt(values["r"]))
    exact = ElasticPlateImpact(rigid.m, rigid.V, rigid.k, *plate.constants, plate.thickness, D=D, delay=DELAY)
    e_tolerance, F_tolerance = DAMPED_TOLERANCES
    return rows((exact.peak_force, F_tolerance), (exact.restitution, e_tolerance), result)


def damped_case(name: str, e: float, place: str) -> Case:
    case = plate_case(name, Mesh(0.5, 2), place)
    return replace(case, name=f"damped_{e:g}_{case.name}", rows=partial(damped_rows, name), variables={**case.variables, "e": e})


def plate_cases(name: str, meshes: Sequence[Mesh]) -> list[Case]:
    wanted = [(mesh, place) for mesh in meshes for place in PLATE_PLACES]
    return [plate_case(name, mesh, place) for mesh, place in wanted if (name, mesh.ratio, place) not in REFUSED]


def spread(name: str, mass: str) -> Comparison:
    """Half of what restitution and force differ by among all meshes, the shear of single quadratic layers corrected."""
    coarsest = 0.5 if name in SPREAD_OF_FINE and mass == "lumped" else 1.0
    sheared = [mesh._replace(mass=mass, shear="corrected" if mesh.is_single_quadratic else "plain") for mesh in ALL_MESHES]
    misses = name in SOFT and mass == "lumped"  # single layers as wide as they are thick: their waves
    meshes = [mesh for mesh in sheared if mesh.ratio <= (0.5 if misses and mesh.is_single_quadratic else coarsest)]
    cases = [case.name for case in plate_cases(name, meshes)]

    def rows_of(results: Mapping[str, Result]) -> list[Row]:
        e = [results[case].state["v"][-1] / results[case].values["V"] for case in cases]
        F = [peak_force(results[case]) for case in cases]
        values = (0.5 * (max(e) - min(e)), 0.5 * (max(F) - min(F)) / PLATES[name].peak)
        known = all(results[case].as_published for case in cases)
        return [
            Row(f"{name}_{what}_spread{'_mass' if mass == 'corrected' else ''}", what, value, "1", *((0.0, limit) if known else ()))
            for what, value, limit in zip(("restitution", "peak_force"), values, SPREAD_TOLERANCES)
        ]

    return Comparison(cases, rows_of)


def draw(path: Path, results: Mapping[str, Result]) -> None:
    """Z1's peak force less that of elasticity, over the size of the elements, by layers; and what meshes should have."""
    picture = Picture(figsize=(9.0, 4.6), layout="constrained")
    axes, plate = picture.subplots(), PLATES["Z1"]

    def error(F: np.ndarray | float) -> np.ndarray | float:
        return 100.0 * (F / plate.peak - 1.0)

    kinds = {(1, 2): "1 layer", (1, 3): "1 layer, cubic", (2, 2): "2 layers", (4, 2): "4 layers"}
    shown = {(*kind, "lumped", "plain"): words for kind, words in kinds.items()}
    shown |= {(1, 2, "lumped", "corrected"): "1 layer, shear corrected", (2, 2, "corrected", "plain"): "2 layers, mass corrected"}
    for (kind, words), colour, marker in zip(shown.items(), COLOURS, MARKERS):
        meshes = sorted(mesh for mesh in (*ALL_MESHES, *CORRECTED_MASS, *CORRECTED_SHEAR) if mesh[1:] == kind)
        ratios = [mesh.ratio for mesh in meshes]
        found = [results[plate_case("Z1", mesh, "corner").name] for mesh in meshes]
        expected = [mesh.of(plate, "corner").impact(impact(of.values), of.values["dt"])[1] for mesh, of in zip(meshes, found)]
        axes.plot(ratios, error(np.array(expected)), color=colour, linewidth=1.2)
        axes.plot(ratios, [error(peak_force(of)) for of in found], marker, color=colour, label=f"corrected, {words}")
    off = [plate_case("Z1", mesh, "corner", "none") for mesh in QUADRATIC]
    axes.plot([mesh.ratio for mesh in QUADRATIC], [error(peak_force(results[case.name])) for case in off], "k--",
              marker="D", markerfacecolor="none", linewidth=1.2, label="compliance none; 1, 2, 4 layers")  # fmt: skip
    axes.plot([], [], color="0.4", linewidth=1.2, label="independent program, equal elements")
    axes.axhline(0.0, color="k", linewidth=1.0, label="three-dimensional elasticity")
    axes.set(xscale="log", xlabel="size of the elements over the plate's thickness, $h/T$",
             ylabel="peak force less elasticity's [%]", title="A glass ball on 1 mm of glass (Z1), hit in a corner of elements")  # fmt: skip
    axes.set_xticks([1.0, 0.5, 0.25, 0.125], ["1", "1/2", "1/4", "1/8"])
    axes.minorticks_off()
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(0.0, 0.42))
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    save(picture, path)


CASES = [
    *(case for plate in PLATES for case in plate_cases(plate, (*ALL_MESHES, *CORRECTED_MASS, *CORRECTED_SHEAR))),
    *(plate_case("Z1", mesh, "corner", "none") for mesh in QUADRATIC),
    *(damped_case(plate, e, "corner") for plate in DAMPED_PLATES for e in DAMPED),
]
COMPARISONS = [spread(name, mass) for name in PLATES for mass in ("lumped", "corrected")]
IN_CORNERS = [case.name for case in CASES if case.name.removeprefix("none_").startswith("Z1_") and "corner" in case.name]
FIGURE = Figure("plate.png", IN_CORNERS, draw)

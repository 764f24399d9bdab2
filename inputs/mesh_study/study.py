# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces over meshes: Table 2's ball on blocks, and balls on thin plates, of ever smaller elements.

References: Hertz' solution less what waves into a half-space take (Miller & Pursey 1955; the integral is this project's own),
three-dimensional elasticity of thin plates (two independent programs of this project: axisymmetric finite elements with
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
from matplotlib.figure import Figure as Picture

from study.build.graded_block import PLACES, GradedBlock
from study.reference import hertz
from study.reference.elastic_plate import ElasticPlateImpact
from study.reference.meshed_plate import MeshedPlate
from study.run.case import Case, Comparison, Figure, Result, Study, Values, index_variables, numbers
from study.run.figures import COLOURS, MARKERS, save
from study.run.pulse import measure
from study.run.summary import Row

HERE = Path(__file__).parent
STEEL = {"law": "linear_elastic", "youngs_modulus": "210.6e9", "poissons_ratio": 0.286, "density": 7850}
GLASS = {"law": "linear_elastic", "youngs_modulus": "74.6e9", "poissons_ratio": 0.2285, "density": 2480}
STEEL_BALL = {"E_ball": 210.6e9, "nu_ball": 0.286, "rho": 7850.0}

# Table 2's ball on a half-space: peak force [N] and restitution.  Waves take 0.374 % of its energy and 0.11 % of the force.
PEAK, RESTITUTION = 6.679, 0.998
PEAK_TOLERANCE, RESTITUTION_TOLERANCE = 1e-3, 5e-4
COARSE_TOLERANCE = 5e-3  # of elements that are too large for the waves
CUBIC_TOLERANCE = 2e-3
SLIDING_TOLERANCE, SLIDING_ENERGY_TOLERANCE = 1e-6, 1e-4
RIGID = {"E_ball": 1e20}  # the ball gives way by nothing: E* is the block's own
RIGID_TOLERANCE = 3e-3
RIGID_SIZE = 3.7  # contact radii
# Energy that waves take into a half-space of this steel: WAVES * integral of (dF/dt)^2 [m s/N]; of Hertz' pulse the integral is
# PULSE F^2/t_c.  Of the part that is lost the peak force loses PEAK_SHARE (0.11 % of 0.374 %, by integration of the motion).
WAVES, PULSE, PEAK_SHARE = 5.301e-16, 4.685, 0.294
SIZES_MM = (1, 0.5, 0.25, 0.125, 0.0625)
COARSE_MM = (4, 2)
CUBIC_MM = (0.5, 0.25, 0.125)
MASS_MM, CUBIC_MASS_MM = (4, 2, 1), (1, 0.5)  # with corrected mass
UNCORRECTED = ("corner", "centre")


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

    @property
    def is_single_quadratic(self) -> bool:
        """It shears too little, as the independent program says (README.md): one cubic layer, or two, are needed."""
        return self.layers == 1 and self.degree == 2

    def of(self, plate: Plate, place: str) -> MeshedPlate:
        h, side = self.ratio * plate.thickness, 2.0 * plate.half
        return MeshedPlate(*plate.constants, plate.thickness, h, self.layers, place, side, degree_through=self.degree,
                           mass=self.mass)  # fmt: skip


QUADRATIC = tuple(Mesh(*mesh) for mesh in ((1.0, 1), (0.5, 2), (0.25, 4)))
CUBIC = (Mesh(1.0, 1, 3), Mesh(0.5, 1, 3))
# On request:
FURTHER = tuple(Mesh(*mesh) for mesh in ((1.0, 2), (1.0, 4), (0.5, 1), (0.5, 4), (0.25, 1), (0.25, 1, 3), (0.25, 2), (0.125, 2), (0.125, 4)))
ALL_MESHES = (*QUADRATIC, *CUBIC, *FURTHER)
CORRECTED_MASS = tuple(mesh._replace(mass="corrected") for mesh in ALL_MESHES)
LARGE = ("Z3", Mesh(0.25, 4))  # half a minute: on request, too
MASS_ALWAYS = (("Z2", (1.0, 1, 2)), ("Z3", (1.0, 1, 2)))  # which miss gates with row sums
PLATE_PLACES = ("corner", "centre")
# Absolute of the restitution, relative of the force: for elements as large as the plate is thick, and for smaller ones.
PLATE_TOLERANCES = {True: (0.005, 0.01), False: (0.002, 0.004)}
# What single quadratic layers miss, beside all forces with smaller elements than the plate is thick.
MISSED_FORCE = (("Z2", 1.0, "corner"), ("Z3", 1.0, "corner"), ("Z3", 1.0, "centre"))
SOFT = ("Z2", "Z3")  # beside their balls: likewise with corrected mass
MISSED_RESTITUTION = (("Z3", 1.0, "corner"), ("Z3", 0.5, "corner"))
# Beside the independent program, of equal elements; of other meshes than single quadratic layers among each other.
SAME_MESH_TOLERANCES = {"lumped": (3e-4, 5e-4), "corrected": (4e-4, 7e-4)}  # by the mass: c ends with its patch, which shows more
SPREAD_TOLERANCES = (0.002, 0.003)
SPREAD_OF_FINE = ("Z3",)  # without elements as large as the plate is thick: the longer the contact the more their waves count
REFUSED = (("Z3", 0.125, "centre"),)  # too small for the contact: s comes to 0.9
# Damped contacts on plates, elements of half their thickness: coefficients of restitution of the law, relative tolerances.
DAMPED = (0.5, 0.8)
DAMPED_PLATES = ("Z1", "Z2", "steel")
DAMPED_TOLERANCES = (0.01, 0.03)
DELAY = 0.3  # of the reference, over h/c_T: twice as much changes restitutions by 1e-3 of themselves


def impact(values: Values) -> hertz.Impact:
    """The ball on a half-space that does not move."""
    E_star = hertz.effective_modulus(*(values[name] for name in ("E_ball", "nu_ball", "E_wall", "nu_wall")))
    return hertz.penalty_impact("hertz", 1.0, E_star, values["r"], values["rho"], values["V"])


def steps(longer: float, values: Values) -> int:
    return math.ceil(longer * impact(values).duration / values["dt"])


def peak_force(result: Result) -> float:
    """[N]"""
    force = result.force
    return measure(force["t"], force["F"], force["overlap"]).peak_force


def contact_radius(values: Values) -> float:
    """Where the contact is deepest [m]."""
    return math.sqrt(values["r"] * impact(values).max_overlap)


def rows(peak: tuple[float, float] | tuple[()], restitution: tuple[float, float] | tuple[()], result: Result) -> list[Row]:
    """Each with reference and relative tolerance, if the user changed nothing."""
    F, e = peak_force(result), result.state["v"][-1] / result.values["V"]
    known = result.as_published
    return [
        Row(result.case, "peak_force", F, "N", *(peak if known else ())),
        Row(result.case, "restitution", e, "1", *(restitution if known else ())),
    ]


def block(h_mm: float, place: str, degree: int, mass: str = "lumped") -> GradedBlock:
    """So large that no wave is back while the ball is there."""
    return GradedBlock(h_mm * 1e-3, place, half=25e-3, depth=25e-3, largest=2e-3, degree=degree, mass=mass)


def block_case(h_mm: float, place: str, compliance: str, degree: int = 2, mass: str = "lumped") -> Case:
    if compliance == "none":
        name, expected = f"none_{h_mm:g}mm_{place}", ((), ())
    elif degree == 3:
        restitution = (RESTITUTION, RESTITUTION_TOLERANCE) if h_mm in CUBIC_MM else ()
        name, expected = f"cubic_{h_mm:g}mm_{place}", ((PEAK, CUBIC_TOLERANCE), restitution)
    elif h_mm in COARSE_MM:
        name, expected = f"{h_mm:g}mm_{place}", ((PEAK, COARSE_TOLERANCE), ())
    else:
        name, expected = f"{h_mm:g}mm_{place}", ((PEAK, PEAK_TOLERANCE), (RESTITUTION, RESTITUTION_TOLERANCE))
    if mass == "corrected":
        name = f"mass_{name}"
    file = f"{name}.yaml"
    variables = {"block": file, "compliance": compliance, "dt": 0.6e-8 if degree == 3 else 0.8e-8}
    mesh = block(h_mm, place, degree, mass)
    return Case(name, "in.mesh_study", partial(rows, *expected), variables, partial(steps, 1.08 if compliance == "corrected" else 1.3),
                lambda _: {file: mesh.model_file(STEEL)})  # fmt: skip


def with_waves(rigid: hertz.Impact) -> tuple[float, float]:
    """Peak force [N] and restitution of Hertz' impact on a half-space of steel."""
    lost = WAVES * PULSE * rigid.peak_force**2 / rigid.duration / (0.5 * rigid.m * rigid.V**2)
    return rigid.peak_force * (1.0 - PEAK_SHARE * lost), math.sqrt(1.0 - lost)


def rigid_rows(result: Result) -> list[Row]:
    F, e = with_waves(impact(result.values))
    return rows((F, RIGID_TOLERANCE), (e, RESTITUTION_TOLERANCE), result)


def rigid_case(place: str) -> Case:
    """Elements as small as the correction takes them under a ball that gives way by nothing."""
    name, defaults = f"rigid_{place}", numbers(index_variables(HERE / "in.mesh_study"))
    h_mm = 1e3 * RIGID_SIZE * contact_radius({**defaults, **RIGID})
    file, mesh = f"{name}.yaml", block(h_mm, place, 2)
    variables = {"block": file, "dt": 0.6e-8, **RIGID}
    return Case(name, "in.mesh_study", rigid_rows, variables, partial(steps, 1.3),
                lambda _: {file: mesh.model_file(STEEL)})  # fmt: skip


def sliding_rows(result: Result) -> list[Row]:
    """The speed along the top that a bounce without friction leaves as it was, over that of the impact."""
    values, after = result.values, result.state["along"][-1]
    known = result.as_published and values["compliance"] == "corrected"
    change = (after - values["slide"]) / values["V"]
    return [
        *rows(*(((PEAK, PEAK_TOLERANCE), (RESTITUTION, RESTITUTION_TOLERANCE)) if known else ((), ())), result),
        Row(result.case, "change_of_sliding_speed", change, "1", *((0.0, SLIDING_TOLERANCE) if known else ())),
    ]


def sliding_energy(results: Mapping[str, Result]) -> list[Row]:
    """Kinetic energy that the ball keeps, less what it has by the restitution of the same ball that does not slide, over that of
    its impact."""
    slide, still = (results[name] for name in ("slide", "0.125mm_corner"))
    V, along = slide.values["V"], slide.values["slide"]
    after, restitution = slide.state, still.state["v"][-1] / still.values["V"]
    change = (after["along"][-1] ** 2 + after["v"][-1] ** 2 - along**2) / V**2 - restitution**2
    known = slide.as_published and still.as_published
    return [Row("slide", "change_of_energy", change, "1", *((0.0, SLIDING_ENERGY_TOLERANCE) if known else ()))]


def sliding_case(compliance: str) -> Case:
    """Over one and a half elements of 2.8 contact radii."""
    name = "slide" if compliance == "corrected" else "none_slide"
    file, mesh = f"{name}.yaml", block(0.125, "corner", 2)
    variables = {"block": file, "compliance": compliance, "dt": 0.4e-8, "slide": 30.0}
    return Case(name, "in.mesh_study", sliding_rows, variables, partial(steps, 1.3),
                lambda _: {file: mesh.model_file(STEEL)})  # fmt: skip


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
    if mesh.is_single_quadratic:
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
                        degree_through=mesh.degree, mass=mesh.mass)  # fmt: skip
    kind = ("_cubic" if mesh.degree == 3 else "") + ("_mass" if mesh.mass == "corrected" else "")
    case = f"{name}_{1e3 * h:g}mm_{mesh.layers}{kind}_{place}"
    if compliance == "none":
        case = f"none_{case}"
    file = f"{case}.yaml"
    E, nu, _ = plate.constants
    variables = {**plate.ball, "block": file, "compliance": compliance, "E_wall": E, "nu_wall": nu}
    of = partial(plate_rows, name, mesh, place, compliance == "corrected")
    on_request = mesh in FURTHER or mesh in CORRECTED_MASS and (name, mesh[:3]) not in MASS_ALWAYS or (name, mesh) == LARGE
    return Case(case, "in.mesh_study", of, variables, partial(steps, 1.6),
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
    """Half of what restitution and force differ by among meshes that are no single quadratic layers."""
    coarsest = 0.5 if name in SPREAD_OF_FINE and mass == "lumped" else 1.0
    meshes = [mesh._replace(mass=mass) for mesh in ALL_MESHES if not mesh.is_single_quadratic and mesh.ratio <= coarsest]
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


CASES = [
    *(block_case(h, place, "corrected") for h in (*COARSE_MM, *SIZES_MM) for place in PLACES),
    *(block_case(h, place, "none") for h in (*COARSE_MM, *SIZES_MM) for place in UNCORRECTED),
    *(block_case(h, place, "corrected", degree=3) for h in CUBIC_MM for place in PLACES),
    *(block_case(h, place, "corrected", mass="corrected") for h in MASS_MM for place in PLACES),
    *(block_case(h, place, "corrected", 3, "corrected") for h in CUBIC_MASS_MM for place in PLACES),
    *(rigid_case(place) for place in ("corner", "centre")),
    *(sliding_case(compliance) for compliance in ("corrected", "none")),
    *(case for plate in PLATES for case in plate_cases(plate, (*ALL_MESHES, *CORRECTED_MASS))),
    *(plate_case("Z1", mesh, "corner", "none") for mesh in QUADRATIC),
    *(damped_case(plate, e, "corner") for plate in DAMPED_PLATES for e in DAMPED),
]


def draw(path: Path, results: Mapping[str, Result]) -> None:
    """Peak force less Hertz', over the size of the elements."""
    picture = Picture(figsize=(9.0, 4.6), layout="constrained")
    axes = picture.subplots()
    some = next(iter(results.values())).values
    a, exact = contact_radius(some), impact(some).peak_force
    sizes = sorted((*COARSE_MM, *SIZES_MM))
    for place, colour, marker in zip(PLACES, COLOURS, MARKERS):
        for prefix, words, style, face in (("", "corrected", "-", colour), ("none_", "none", "--", "none")):
            names = [f"{prefix}{h:g}mm_{place}" for h in sizes]
            if names[0] not in results:
                continue
            F = np.array([peak_force(results[name]) for name in names])
            axes.plot(1e-3 * np.array(sizes) / a, 100.0 * (F / exact - 1.0), style, color=colour, marker=marker,
                      markerfacecolor=face, linewidth=1.2, label=f"compliance {words}, {place} of an element")  # fmt: skip
    axes.axhline(100.0 * (PEAK / exact - 1.0), color="k", linewidth=1.0, label="half-space, waves")
    axes.set(xscale="log", xlabel="size of the elements over the contact's radius, $h/a$",
             ylabel="peak force beside Hertz' [%]", title="A glass ball on steel, 1 m/s: what the mesh does to the force")  # fmt: skip
    axes.legend(frameon=False, loc="lower right")
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    save(picture, path)


def draw_plate(path: Path, results: Mapping[str, Result]) -> None:
    """Z1's peak force less that of elasticity, over the size of the elements, by layers; and what meshes should have."""
    picture = Picture(figsize=(9.0, 4.6), layout="constrained")
    axes, plate = picture.subplots(), PLATES["Z1"]

    def error(F: np.ndarray | float) -> np.ndarray | float:
        return 100.0 * (F / plate.peak - 1.0)

    kinds = {(1, 2): "1 layer", (1, 3): "1 layer, cubic", (2, 2): "2 layers", (4, 2): "4 layers"}
    of_mass = {(*kind, "lumped"): words for kind, words in kinds.items()} | {(2, 2, "corrected"): "2 layers, mass corrected"}
    for (kind, words), colour, marker in zip(of_mass.items(), COLOURS, MARKERS):
        meshes = sorted(mesh for mesh in (*ALL_MESHES, *CORRECTED_MASS) if mesh[1:] == kind)
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


ON_PLATE = [case.name for case in CASES if case.name.removeprefix("none_").startswith("Z1_") and "corner" in case.name]
ON_BLOCKS = [case.name for case in CASES if case.name.removeprefix("none_")[0].isdigit()]
STUDY = Study(
    cases=CASES,
    figures=[Figure("force.png", ON_BLOCKS, draw), Figure("plate.png", ON_PLATE, draw_plate)],
    comparisons=[*(spread(name, mass) for name in PLATES for mass in ("lumped", "corrected")), Comparison(["slide", "0.125mm_corner"], sliding_energy)],
)

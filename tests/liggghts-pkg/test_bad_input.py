# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong decks and model files: exactly one line starting with ERROR that says what was given and what was expected,
a non-zero exit, no hang and no backtrace, on 1 and 2 ranks.  A new kind of wrong input is one more row of a table."""

import re
import unittest
from concurrent.futures import ThreadPoolExecutor

import ball_on_block as bob
import decks
from test_geometry_files import wall_file, xml_file

BLOCK = bob.block()
MASS = BLOCK + "integration: {mass: corrected}\n"
FLAT = """
units: si
geometry:
  patches:
    - degrees: [2, 1]
      knots: [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]]
      control_points: [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]
      weights: [1, 1, 1, 1, 1, 1]
surfaces: {floor: all}
"""
ROUND = """
units: si
geometry:
  cylinder: {origin: [0, 0, 0], axis: [1, 0, 0], radius: 0.01, length: 0.02,
    angle: [0, 180], elements: [4, 2]}
surfaces: {wall: all}
"""
THREAD = re.sub(r"\[\d, \d, 0\]", "[0, 0, 1]", FLAT)  # all control points in one place, on the z axis
NINE = ", ".join([
    "law: orthotropic_elastic", *(f"E_{i}: 5e9" for i in (1, 2, 3)), *(f"nu_{i}: 0.3" for i in (12, 13, 23)),
    *(f"G_{i}: 2e9" for i in (12, 13, 23)),
])  # fmt: skip
# Loads that no solid bears.
SOFT = BLOCK.replace("linear_elastic", "saint_venant_kirchhoff") + "loads: {tractions: [{face: zeta+, value: [0, 0, 1e15]}]}\n"
TRAY = "solid floor\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid floor\n"
STEP = "ISO-10303-21;\nHEADER;\n"
MODELS = "model hertz tangential no_history"
GOOD = f"{MODELS} type 2 structure block.yaml surface top"
RIGID = f"{MODELS} type 2 geometry flat.yaml surface floor"
SERVO = "servo com 0 0 0 ctrlPV force axis 0 0 1 target_val 5 vel_max 1"
HDF5 = f"{MODELS} type 2 geometry wall.h5 surface all"
XML = f"{MODELS} type 2 geometry wall.xml surface all"
CAD = f"{MODELS} type 2 geometry part.step surface all"
PLUGIN = f"{MODELS} type 2 structure plugin ./net.so net.txt surface top"
CORRECTED = " compliance corrected"
OTHER_LAWS = (
    "penalty/linear", "penalty/quadratic", "plastic/thornton", "hooke", "hooke/stiffness", "hooke/hysteresis", "hertz/stiffness",
    "edinburgh", "edinburgh/stiffness", "luding", "thornton_ning",
)  # fmt: skip
COHESIONS = ("sjkr", "sjkr2", "washino/capillary/viscous")
PIPE = f"{MODELS} type 2 geometry round.yaml surface wall"


def in_block(old: str, new: str) -> dict[str, str]:
    """The block's model file with `old` replaced; `old` must be there."""
    assert old in BLOCK, old
    return {"block.yaml": BLOCK.replace(old, new)}


def in_flat(old: str, new: str) -> dict[str, str]:
    assert old in FLAT, old
    return {"flat.yaml": FLAT.replace(old, new)}


def in_round(old: str, new: str) -> dict[str, str]:
    assert old in ROUND, old
    return {"round.yaml": ROUND.replace(old, new)}


def in_xml(old: str, new: str) -> dict[str, str]:
    assert old in xml_file(), old
    return {"wall.xml": xml_file().replace(old, new, 1)}


# name: (words after `wall/nurbs`, files that differ, what the error line must say, ...)
# Model files: file and line, what was given, what was expected.
MODEL_FILES = {
    "missing model file": (GOOD.replace("block", "nowhere"), {}, ["nowhere.yaml", "No such file"]),
    "folder as model file": (f"{MODELS} type 2 structure . surface top", {}, ["'.'", "directory"]),
    "device as model file": (f"{MODELS} type 2 structure /dev/zero surface top", {}, ["'/dev/zero'", "Is a device"]),
    "device as geometry file": (f"{MODELS} type 2 geometry /dev/zero surface top", {}, ["'/dev/zero'", "Is a device"]),
    "STEP file as model file": (GOOD, {"block.yaml": STEP}, ["block.yaml: is a STEP file, expected"]),
    "STEP file as geometry file": (RIGID, {"flat.yaml": STEP}, ["flat.yaml: is a STEP file, expected"]),
    "STL file as geometry file": (RIGID, {"flat.yaml": "solid a\nfacet normal 0 0 1\n"}, ["is an STL file", "called .stl"]),
    "comma as model file": (GOOD, {"block.yaml": ","}, ["block.yaml:1: broken YAML"]),
    "comma behind a geometry file": (RIGID, {"flat.yaml": "{units: si},"}, ["flat.yaml:1: broken YAML"]),
    "empty model file": (GOOD, {"block.yaml": ""}, ["block.yaml:1"]),
    "broken YAML": (GOOD, in_block("{top: zeta+}", "{top: zeta+"), [r"block.yaml:\d+"]),
    "no mapping": (GOOD, {"block.yaml": "- 1\n- 2\n"}, ["block.yaml:1"]),
    "unknown key": (GOOD, in_block("density", "densty"), [r"block.yaml:5", "densty", "did you mean 'density'"]),
    "unknown top-level key": (GOOD, {"block.yaml": BLOCK + "sufaces: 1\n"}, ["sufaces", "did you mean 'surfaces'"]),
    "unknown units": (GOOD, in_block("units: si", "units: imperial"), ["block.yaml:2", "imperial", "si"]),
    "units missing": (GOOD, in_block("units: si", ""), ["block.yaml", "units"]),
    "negative density": (GOOD, in_block("density: 1000.0", "density: -1"), ["block.yaml:5", "density", "-1", "> 0"]),
    "density no number": (GOOD, in_block("density: 1000.0", "density: heavy"), ["block.yaml:5", "heavy", "number"]),
    "E zero": (GOOD, in_block("5000000000.0", "0"), ["block.yaml:5", "youngs_modulus", "> 0"]),
    "E not finite": (GOOD, in_block("5000000000.0", ".nan"), ["block.yaml:5", "youngs_modulus"]),
    "nu 0.5": (GOOD, in_block("poissons_ratio: 0.3", "poissons_ratio: 0.5"), ["poissons_ratio", "0.5"]),
    "nu -1": (GOOD, in_block("poissons_ratio: 0.3", "poissons_ratio: -1"), ["poissons_ratio", "-1"]),
    "unknown law": (GOOD, in_block("linear_elastic", "rubber"), ["rubber", "linear_elastic"]),
    "law missing": (GOOD, in_block("law: linear_elastic, ", ""), ["block.yaml:5", "law"]),
    "unknown face": (GOOD, in_block("faces: [zeta-]", "faces: [bottom]"), ["block.yaml:6", "bottom", "zeta-"]),
    "unknown fixed direction": (GOOD, in_block("fix: [x, y, z]", "fix: [w]"), ["block.yaml:6", "w", "x, y, z"]),
    "unknown surface": (GOOD.replace("top", "bottom"), {}, ["bottom", "top"]),
    "probe off the face": (GOOD, in_block("at: [0.5, 0.5]", "at: [0.5, 1.5]"), ["block.yaml:8", "1.5"]),
    "no elements": (GOOD, in_block("elements: [4, 4, 2]", "elements: [4, 0, 2]"), ["elements", "0"]),
    "elements that fit in no memory": (
        GOOD, in_block("elements: [4, 4, 2]", "elements: [100000, 100000, 100]"),
        ["block.yaml:4", "elements", "control points would take", "TB of memory"]),
    "a solid that fits in no memory": (
        GOOD, {"block.yaml": BLOCK.replace("[4, 4, 2], degree: 2", "[190, 190, 110], degree: 3") + "integration: {method: elements}\n"},
        ["block.yaml:", "elements", "GB of memory"]),
    "an unknown way to integrate": (
        GOOD, {"block.yaml": BLOCK + "integration: {method: quick}\n"},
        ["block.yaml:", "method is 'quick'", "auto, affine, stored, recomputed, elements"]),
    "an unknown quadrature": (
        GOOD, {"block.yaml": BLOCK + "integration: {quadrature: gauss}\n"}, ["quadrature is 'gauss'", "full, reduced, zou"]),
    "an unknown mass": (GOOD, {"block.yaml": MASS.replace("corrected", "full")}, ["block.yaml:", "mass is 'full'", "lumped, corrected"]),
    "number beyond all sense": (GOOD, in_block("density: 1000.0", "density: 1e101"), ["block.yaml:5", "density", r"1e\+100"]),
    "degree too high": (GOOD, in_block("degree: 2", "degree: 7"), ["degree", "7", "6"]),
    "negative size": (GOOD, in_block("size: [0.004, 0.004", "size: [0.004, -0.004"), ["size", "-0.004"]),
    "knots not open": (RIGID, in_flat("0, 0, 0, 1, 1, 1", "0, 0, 0.1, 1, 1, 1"), ["flat.yaml:6", "knot"]),
    "knots decrease": (RIGID, in_flat("[0, 0, 1, 1]", "[1, 1, 0, 0]"), ["flat.yaml:6", "knot"]),
    "a control point too few": (RIGID, in_flat(", [2, 1, 0]", ""), ["flat.yaml:7", "5", "6"]),
    "a control point with 2 coordinates": (RIGID, in_flat("[2, 1, 0]", "[2, 1]"), ["flat.yaml:7", "2", "3"]),
    "a weight too many": (RIGID, in_flat("[1, 1, 1, 1, 1, 1]", "[1, 1, 1, 1, 1, 1, 1]"), ["flat.yaml:8", "7", "6"]),
    "weight zero": (RIGID, in_flat("[1, 1, 1, 1, 1, 1]", "[1, 1, 0, 1, 1, 1]"), ["flat.yaml:8", "weight", "0"]),
    "cylinder's radius negative": (PIPE, in_round("0.01", "-0.01"), ["round.yaml:4", "radius", "-0.01", "> 0"]),
    "cylinder's radius misspelt": (PIPE, in_round("radius", "raduis"), ["round.yaml:4", "raduis", "did you mean 'radius'"]),
    "cylinder without an axis": (PIPE, in_round("axis: [1, 0, 0], ", ""), ["round.yaml:4", "cylinder.axis is missing"]),
    "cylinder's axis zero": (PIPE, in_round("[1, 0, 0]", "[0, 0, 0]"), ["round.yaml:4", "axis is", "direction"]),
    "cylinder's angles reversed": (PIPE, in_round("[0, 180]", "[180, 0]"), ["round.yaml:5", "180, 0", "from < to"]),
    "elements that split no arc": (PIPE, in_round("[4, 2]", "[3, 2]"), ["round.yaml:5", "3 elements", "multiple of 2"]),
    "a shape scaled to nothing": (
        PIPE, in_round("geometry:", "geometry:\n  scale: 1e-60"), ["round.yaml:4: scale is 1e-60", "2e-62 in size", r"1e-30 to 1e\+30"]),
    "triangles scaled beyond all sense": (
        RIGID, {"flat.yaml": "units: si\ngeometry: {file: tray.stl, scale: [1, 1e50, 1]}\n", "tray.stl": TRAY},
        [r"flat.yaml:2: scale is \[1, 1e\+50, 1\]", r"1e\+50 in size", r"1e-30 to 1e\+30"]),
    "triangles of no size": (
        f"{MODELS} type 2 geometry tray.stl surface all", {"tray.stl": TRAY.replace("1", "1e-34")},
        ["tray.stl: .*1e-34 in size", r"1e-30 to 1e\+30"]),
    "missing HDF5 file": (HDF5, {}, ["wall.h5", "No such file"]),
    "no HDF5 file": (HDF5, {"wall.h5": FLAT}, ["wall.h5: is no HDF5 file"]),
    "empty STEP file": (CAD, {"part.step": ""}, ["part.step: the file is empty, expected a STEP or IGES file"]),
    "empty IGES file": (CAD.replace("step", "igs"), {"part.igs": ""}, ["part.igs: the file is empty, expected a STEP or IGES file"]),
    "STEP file of random bytes": (
        CAD, {"part.step": bytes(range(256))}, ["part.step: is a binary file, expected a STEP or IGES file"]),
    "IGES file of random bytes": (
        CAD.replace("step", "igs"), {"part.igs": bytes(range(256))}, ["part.igs: is a binary file, expected a STEP or IGES file"]),
    "incomplete HDF5 file": (HDF5, {"wall.h5": wall_file()[:2000]}, ["wall.h5: damaged or incomplete"]),
    "surface that an HDF5 file has not": (HDF5.replace("surface all", "surface lid"), {"wall.h5": wall_file()}, ["'lid'", "all"]),
    "HDF5 file in other units": (HDF5, {"wall.h5": wall_file("cgs")}, ["wall.h5", "cgs", "si"]),
    "trimmed surface": (XML, {"wall.xml": "<xml>\n<TrimSurface/>\n</xml>"}, ["wall.xml:2", "TrimSurface", "not trimmed"]),
    "hierarchical splines": (XML, in_xml("TensorNurbs2", "THBSpline2"), ["wall.xml:1", "'THBSpline2'", "TensorNurbs2"]),
    "knots of an XML file not open": (XML, in_xml("0.0 0.0 0.0", "0.0 0.0"), ["wall.xml:1", "KnotVector"]),
    "broken XML": (XML, in_xml("</coefs>", ""), ["wall.xml:1: broken XML"]),
    "a file that names a missing one": (
        RIGID, {"flat.yaml": "units: si\ngeometry: {file: wall.xml}\nsurfaces: {floor: all}\n"}, ["wall.xml", "No such file"]),
    "a surface that is a solid of an STL file": (
        RIGID, {"flat.yaml": "units: si\ngeometry: {file: tray.stl}\nsurfaces: {floor: all}\n", "tray.stl": TRAY},
        ["flat.yaml:3: surface 'floor': tray.stl has a solid of that name already, expected another"]),
    "a surface of the name that all of an STL file has": (
        RIGID.replace("floor", "all"), {"flat.yaml": "units: si\ngeometry: {file: tray.stl}\nsurfaces: {all: all}\n", "tray.stl": TRAY},
        ["flat.yaml:3: surface 'all': tray.stl has a surface of that name already, expected another"]),
    "a surface that is one of a file among shapes": (
        RIGID, {"flat.yaml": "units: si\ngeometry: {shapes: [{file: tray.stl}]}\nsurfaces: {floor: all}\n", "tray.stl": TRAY},
        ["flat.yaml:3: surface 'floor': a file among its shapes has a solid of that name already, expected another"]),
    "a patch that is not there": (RIGID, in_flat("floor: all", "floor: [0, 1]"), ["flat.yaml:9", "patch is '1'", "0 to 0"]),
    "material in a rigid wall's file": (RIGID, {"flat.yaml": FLAT + "material: {law: linear_elastic}\n"}, ["material"]),
    "surface patch as a solid": (f"{MODELS} type 2 structure flat.yaml surface floor", {}, ["flat.yaml"]),
    "units differ from the deck's": (GOOD, in_block("units: si", "units: cgs"), ["cgs", "si"]),
    "units differ from the deck's, in words": (
        GOOD, in_block("units: si", "units: mm-t-s"), ["block.yaml.* units mm-t-s", "expected .*si"]),
    "wall material E differs": (GOOD, in_block("5000000000.0", "6e9"), ["youngsModulus", "5000000000", "6000000000"]),
    "compliance of nine constants": (
        GOOD + CORRECTED, in_block("law: linear_elastic, youngs_modulus: 5000000000.0, poissons_ratio: 0.3", NINE),
        ["block.yaml: local compliances are known of isotropic", "given 'orthotropic_elastic'", "or 'compliance none'"]),
    "compliance of a viscous solid": (
        GOOD + CORRECTED, {"block.yaml": BLOCK + "damping: {stiffness: 1e-9}\n"}, ["block.yaml: local compliances", "without memory"]),
    "compliance of a high degree": (
        GOOD + CORRECTED, in_block("elements: [4, 4, 2], degree: 2", "elements: [4, 4, 4], degree: 4"),
        ["block.yaml: .*degrees 2 and 3, given 4, 4, 4"]),
    "compliance with few points": (
        GOOD + CORRECTED, {"block.yaml": BLOCK + "integration: {quadrature: zou}\n"}, ["block.yaml: .*given 'zou'"]),
    "wall material nu differs": (GOOD, in_block("poissons_ratio: 0.3", "poissons_ratio: 0.31"), ["poissonsRatio", "0.31"]),
}

# The fix's words: its id, the word given, what was expected.
DECK_WORDS = {
    "no words": ("", ["model"]),
    "type 0": (GOOD.replace("type 2", "type 0"), ["id plate", "'0'", "1"]),
    "type too high": (GOOD.replace("type 2", "type 3"), ["id plate", "3", "1 to 2"]),
    "type no number": (GOOD.replace("type 2", "type wall"), ["id plate", "'wall'"]),
    "type missing": (GOOD.replace("type 2 ", ""), ["id plate", "'type' is missing"]),
    "unknown keyword": (GOOD.replace("structure", "structur"), ["'structur'", "did you mean 'structure'"]),
    "stock keyword": (GOOD + " primitive zplane 0.", ["'primitive'", "structure"]),
    "word of a stock mesh": (GOOD + " heal auto_remove_duplicates", ["'heal'", "expected nothing", "mesh_walls.md"]),
    "switch of a stock mesh": (GOOD + " stress on", ["'stress'", r"f_ID\[1..3\]"]),
    "misplaced model keyword": (f"{GOOD} cohesion sjkr", ["'cohesion'", "first"]),
    "keyword twice": (GOOD + " type 2", ["'type'", "twice"]),
    "structure and geometry": (GOOD + " geometry flat.yaml", ["'structure'", "'geometry'"]),
    "no body": (f"{MODELS} type 2 surface top", ["'structure' or 'geometry'"]),
    "no surface": (f"{MODELS} type 2 structure block.yaml", ["'surface' is missing"]),
    "last word lacks its value": (f"{MODELS} type 2 structure", ["'structure' is the last word"]),
    "material of another word": (GOOD + " material any", ["'any'", "'independent'"]),
    "store_force of another word": (GOOD + " store_force maybe", ["'maybe'", "'yes' or 'no'"]),
    "contacts beyond all sense": (GOOD + " contacts 1000000", ["id plate", "'1000000'", "1 to 256", "memory"]),
    "twin beyond all sense": (RIGID + " twin 100000", ["id plate", "'100000'", "1 to 100"]),
    "number beyond all sense": (RIGID + " motion linear 1e300 0 0", ["id plate", "'1e300'", r"at most 1e\+100"]),
    "search of another word": (GOOD + " search brent", ["'brent'", "'newton' or 'simplex_brent'"]),
    "motion of a deforming wall": (GOOD + " motion linear 1 0 0", ["'motion'", "rigid", "'structure'"]),
    "servo of a deforming wall": (f"{GOOD} {SERVO}", ["'servo'", "rigid", "'structure'"]),
    "belt on a deforming wall": (GOOD + " surface_vel 1 0 0", ["'surface_vel'", "rigid", "'structure'"]),
    "unknown motion": (RIGID + " motion rotat origin 0 0 0", ["id plate", "'rotat'", "did you mean 'rotate'"]),
    "motion lacks a word": (RIGID + " motion rotate origin 0 0 0 axis 0 0 1", ["'1' is the last word", "'period'"]),
    "motion's number is none": (RIGID + " motion linear 1 0 fast", ["motion: linear is 'fast'"]),
    "motion's variable is missing": (RIGID + " motion linear/variable v_v 0 0", ["v_v", "no variable v"]),
    "servo lacks its target": (f"{RIGID} servo com 0 0 0 ctrlPV force", ["servo: 'axis' is missing"]),
    "motion and servo": (f"{RIGID} motion linear 1 0 0 {SERVO}", ["'servo'", "'motion'"]),
    "motion and belt": (RIGID + " surface_vel 1 0 0 motion linear 1 0 0", ["'motion'", "'surface_vel'"]),
    "edge_angle beyond pi": (RIGID + " edge_angle 3.2", ["id plate", "edge_angle is '3.2'", "expected 0 to pi", "rad"]),
    "edge_angle in degrees": (GOOD + " edge_angle 30", ["id plate", "edge_angle is '30'", "expected 0 to pi", "rad"]),
    "scale of a deforming wall": (GOOD + " scale 2", ["'scale'", "given 'structure'", "model file", "scale: 0.001"]),
    "scale to nothing": (RIGID + " scale 0", ["id plate", "scale is '0'", "above 0"]),
    "scaled beyond all sense": (RIGID + " scale 1e60 scale 1e60", [r"flat.yaml: scaled by 1e\+120 ", r"2e\+120", r"1e-30 to 1e\+30"]),
    "moved beyond all sense": (RIGID + " move 9e99 0 0 move 9e99 0 0", ["flat.yaml: scaled and moved", r"1e\+100"]),
    **{
        f"scaled by {factor}": (RIGID + f" scale {factor}", [f"flat.yaml: scaled by {given} ", f" {size} in size", r"1e-30 to 1e\+30"])
        for factor, given, size in (
            ("1e-90", "1e-90", "2e-90"), ("1e-105", "1e-105", "2e-105"), ("1e-150", "1e-150", "2e-150"), ("1e99", r"1e\+99", r"2e\+99"))
    },
    "rotate lacks its angle": (RIGID + " rotate axis 0 0 1", ["'1' is the last word", "'angle'"]),
    "rotate about no axis": (RIGID + " rotate axis 0 0 0 angle 5", ["rotate axis is 0 0 0", "direction"]),
    "keep of a deforming wall": (GOOD + " keep block.h5", ["'keep'", "CAD", "given 'structure block.yaml'"]),
    "keep of what is no CAD file": (RIGID + " keep flat.h5", ["'keep'", "given 'geometry flat.yaml'", "expected .* .step"]),
    "kept under a name of another format": (CAD + " keep part.xml", ["keep is 'part.xml'", "ends in .h5, as in 'keep part.h5'"]),
    "keep without a name": (CAD + " keep", ["'keep' is the last word", "ends in .h5"]),
    "keep before another keyword": (CAD + " keep verbose yes", ["keep is 'verbose'", "ends in .h5, as in 'keep part.h5'"]),
    "kept twice": (CAD + " keep a.h5 keep b.h5", ["'keep' is given twice"]),
    "compliance of another word": (GOOD + " compliance yes", ["'yes'", "'corrected' or 'none'"]),
    "compliance of a rigid wall": (RIGID + CORRECTED, [CORRECTED[1:], "given 'geometry'", "or 'compliance none'"]),
    "compliance of a plug-in": (PLUGIN + CORRECTED, [CORRECTED[1:], "given 'structure plugin'"]),
    **{
        f"compliance with {law}": (
            GOOD.replace("hertz", law) + CORRECTED, [f"laws hertz and penalty/hertz, given 'model {law}', expected .* 'compliance none'"])
        for law in OTHER_LAWS
    },
    **{
        f"compliance with {cohesion}": (
            GOOD.replace("no_history", f"no_history cohesion {cohesion}") + CORRECTED,
            [f"without cohesion, given 'cohesion {cohesion}', expected 'compliance none'"])
        for cohesion in COHESIONS
    },
    "compliance before the body": (
        f"{MODELS.replace('hertz', 'penalty/linear')} type 2{CORRECTED} structure block.yaml surface top",
        ["laws hertz and penalty/hertz, given 'model penalty/linear'"]),
    "modes of a rigid wall": (RIGID + " body modal 4", ["'body modal' is for a solid of ours, given 'geometry'"]),
    "state of a plug-in": (PLUGIN + " state rest.h5", ["'state' is for a solid of ours, given 'structure plugin'"]),
    "compliance of modes": (GOOD.replace("block.yaml", "block.yaml body modal 4") + CORRECTED, ["given 'body modal'"]),
    "compliance with sub-steps": (GOOD + " substeps auto" + CORRECTED, ["not for 'substeps'"]),
    "contact area without heat": (RIGID + " contact_area projection", ["'contact_area'", "'temperature T'"]),
    "chord beyond all sense": (PIPE + " stl pipe every 5 chord 1e-12", ["chord 1e-12 takes about", "at most 1000"]),
    "unknown normal model": (GOOD.replace("hertz", "herz"), ["herz", "hertz"]),
    "unknown tangential model": (GOOD.replace("no_history", "historie"), ["historie", "history"]),
    "surface multicontact": (GOOD.replace("no_history", "no_history surface multicontact"), ["multicontact"]),
    "elastic potential": (GOOD + " computeElasticPotential on", ["computeElasticPotential"]),
    "dissipated energy": (GOOD + " computeDissipatedEnergy on", ["computeDissipatedEnergy"]),
    "unknown setting": (GOOD + " tangential_dampin on", ["tangential_dampin"]),
}

# What the deck does with a good wall: (lines before the fix, after it, what the error says)
DECKS = {
    "timestep above the stable step": ("timestep 1e-6\n", "run 1\n", ["id plate", "1e-06", r"2\.\d+e-07"]),
    "timestep raised between runs": ("", "run 1\ntimestep 1e-6\nrun 1\n", ["id plate", "1e-06"]),
    "motion that leads nowhere": (
        f"fix w2 all wall/nurbs {RIGID} motion rotate origin 0 0 0 axis 0 0 1 period 1e-308\n", "run 1\n",
        ["id w2", "step 1:", "not finite", "numbers that move it"]),
    "a structure that blows up": (
        f"fix w2 all wall/nurbs {GOOD.replace('block', 'soft')}\n", "run 100\n",
        ["id w2", "'soft.yaml': step 1:", "blown up at time", "control node .* undeformed at", "likely cause: .*loads.*time step"],
    ),
    "minimize": ("", "minimize 1e-4 1e-6 10 10\n", ["id plate", "minimize"]),
    "respa": ("run_style respa 2 2\n", "run 1\n", ["respa"]),
    "id in use": ("", f"fix plate all wall/nurbs {GOOD}\nrun 1\n", ["Replacing a fix, but new style != old style"]),
    "id in use, by LIGGGHTS' name of this fix": (
        "", f"fix plate all wall/gran/nurbs {GOOD}\nrun 1\n", ["Fix wall/gran/nurbs", "id plate", "in use", "'unfix plate' first"]),
    "no such column": ("", "variable v equal f_plate[99]\nthermo_style custom step v_v\nrun 1\n", ["fix"]),
    "motion's variable of another style": (
        "variable v index 1\nfix w2 all wall/nurbs " + RIGID + " motion linear/variable v_v 0 0\n", "",
        ["id w2", "variable v", "equal style"],
    ),
    "motion's variable deleted": (
        "variable v equal 1\nfix w2 all wall/nurbs " + RIGID + " motion linear/variable v_v 0 0\n",
        "run 1\nvariable v delete\nrun 1\n", ["id w2", "no variable v"],
    ),
    "servo's target becomes 0": (
        f"variable v equal 1-step\nfix w2 all wall/nurbs {RIGID} {SERVO.replace('5', 'v_v')}\n", "run 2\n",
        ["id w2", "target_val", "0"],
    ),
    "torque on a wall that lies on its axis": (
        f"fix w2 all wall/nurbs {RIGID.replace('flat', 'thread')} {SERVO.replace('force', 'torque')}\n", "",
        ["id w2", "axis"],
    ),
    "fix_modify of an unknown word": (
        f"fix w2 all wall/nurbs {RIGID}\n", "fix_modify w2 colour red\n", ["id w2", "'colour'", "motion"]),
    "fix_modify of a deforming wall": ("", "fix_modify plate motion none\n", ["id plate", "deforming"]),
    "a periodic triclinic box": ("change_box all boundary p p f triclinic\n", "", ["triclinic and periodic", "expected an orthogonal"]),
    "a box that turns triclinic behind the fix": (
        "change_box all boundary p p f\n", "change_box all triclinic\nrun 1\n", ["id plate", "triclinic and periodic", "expected an orthogonal"],
    ),
    "multicontact of the pairs": (
        "pair_style gran model hertz tangential no_history surface multicontact\npair_coeff * *\n"
        "fix mc all multicontact/halfspace\n", "run 1\n", ["multicontact|geometric|Poisson|prefactor"],
    ),
}


def attempt(deck: str, files: dict[str, str], ranks: int) -> decks.Run:
    good_files = {"block.yaml": BLOCK, "flat.yaml": FLAT, "round.yaml": ROUND, "thread.yaml": THREAD, "soft.yaml": SOFT}
    return decks.run(deck, files=good_files | files, ranks=ranks, timeout=60)


class BadInput(unittest.TestCase):
    def check(self, result: decks.Run, expected: list[str]):
        self.assertNotEqual(result.code, 0, result.text[-2000:])
        self.assertEqual(len(result.errors), 1, result.text[-3000:])
        for pattern in expected:
            self.assertRegex(result.errors[0], pattern)
        crash = re.search(r"Signal|backtrace|\*\*\* Process|terminate called", result.text)
        self.assertIsNone(crash, result.text[-3000:])

    def check_table(self, rows, on=(1, 2)):
        """Runs every row on so many ranks, several at once: most of the time mpirun starts or ends, and cores rest."""
        with ThreadPoolExecutor(4) as pool:
            runs = [
                (name, ranks, expected, pool.submit(attempt, deck, files, ranks))
                for name, (deck, files, expected) in rows.items()
                for ranks in on
            ]
            for name, ranks, expected, future in runs:
                with self.subTest(name, ranks=ranks):
                    self.check(future.result(), expected)

    def test_model_files(self):
        self.check_table({
            name: (bob.prelude() + f"fix plate all wall/nurbs {words}\nrun 1\n", files, expected)
            for name, (words, files, expected) in MODEL_FILES.items()
        })

    def test_deck_words(self):
        self.check_table({
            name: (bob.prelude() + f"fix plate all wall/nurbs {words}\nrun 1\n", {}, expected)
            for name, (words, expected) in DECK_WORDS.items()
        })

    def test_decks(self):
        self.check_table({
            name: (bob.prelude() + before + f"fix plate all wall/nurbs {GOOD}\n" + after, {}, expected)
            for name, (before, after, expected) in DECKS.items()
        })

    def test_corrected_contacts_on_three_ranks(self):
        """What stops a run in a step is seen by one of them alone."""
        fast = bob.prelude(velocity=(0, 0, -20), timestep=1e-9, processors="* 1 1", ball=(5e9, 0.3))
        small = bob.block(size=(1e-3, 1e-3, 0.5e-3), elements=(12, 12, 6))
        one = bob.block(elements=(1, 1, 1))
        words = f"fix plate all wall/nurbs {GOOD}{CORRECTED}\nrun "
        self.check_table({
            "elements that are too small": (
                fast + words + "4000\n", {"block.yaml": small},
                ["id plate", r"elements at .* too small for the contact of particle 1 \(radius \S+, overlap \S+\) at step \d+", r"they turn below it \(0.41, expected at most 0.41\)", "'compliance none'"]),
            "a solid of one element": (
                fast + words + "100\n", {"block.yaml": one}, ["id plate", "block.yaml", "elements beside the one that is hit, given a single one", "'compliance none'"]),
            **{
                name: (bob.prelude() + f"fix plate all wall/nurbs {row[0]}\nrun 1\n", row[1] if len(row) == 3 else {}, row[-1])
                for name, row in (MODEL_FILES | DECK_WORDS).items() if name.startswith("compliance")
            },
        }, on=(1, 3))

    def test_the_good_deck_is_good(self):
        for words in (GOOD, RIGID, PIPE, GOOD + " material independent store_force yes tangential_damping on"):
            files = {"block.yaml": BLOCK, "flat.yaml": FLAT, "round.yaml": ROUND}
            deck = bob.prelude(ball=(7e9, 0.25)) + f"fix plate all wall/nurbs {words}\nthermo 1\nrun 1\n"
            decks.good(deck, files=files)  # the ball's material is its own

    def test_a_poissons_ratio_of_0_may_come_with_round_off(self):
        """Hill's mean of these constants is -5e-17."""
        law = "law: orthotropic_elastic, " + ", ".join(
            [f"E_{i}: 1e8" for i in (1, 2, 3)] + [f"nu_{i}: 0" for i in (12, 13, 23)] + [f"G_{i}: 5e7" for i in (12, 13, 23)])  # fmt: skip
        files = in_block("law: linear_elastic, youngs_modulus: 5000000000.0, poissons_ratio: 0.3", law)
        deck = bob.prelude(wall=(1e8, 0.0)) + f"fix plate all wall/nurbs {GOOD}\nthermo 1\nrun 1\n"
        decks.good(deck, files=files)


if __name__ == "__main__":
    unittest.main()

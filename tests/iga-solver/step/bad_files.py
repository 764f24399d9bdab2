# SPDX-License-Identifier: GPL-2.0-or-later
"""A hundred broken CAD files, made from good ones by small edits.

usage: bad_files.py GOOD BAD
GOOD is a folder that make_step_parts has filled; BAD gets the broken files and `list.txt`, a line each: name, `refuse` or
`mend` (what is meant can still be told, so mending and saying so is as good), what is wrong.
"""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass
from pathlib import Path

ABSENT = 987654  # no file has so many entities


# Made from these.
GOOD = tuple(
    f"{name}.step"
    for name in "box cylinder frustum sphere torus holes sphere_cut spline_tip spline_plate_hole blend_cone_pipe branch_holes nested external".split()
) + ("closed_spline.igs", "branch_holes.igs", "frustum.igs", "nested.igs")
# What is meant can still be told: the order of bounds says nothing, that of edges follows from their ends.
MENDABLE = {"swapped_loops_holes.step", "crossed_loop_box.step", "twice_an_edge_box.step"}


@dataclass(frozen=True)
class Bad:
    name: str  # of the file
    wrong: str  # what
    content: bytes

    def line(self) -> str:
        return f"{self.name}  {'mend' if self.name in MENDABLE else 'refuse'}  {self.wrong}\n"


class Good:
    """A STEP file to be edited; an edit that finds nothing is an error."""

    def __init__(self, folder: Path, name: str):
        self.stem, self.ending = name.rsplit(".", 1)
        self.text = (folder / name).read_text()

    def bad(self, kind: str, wrong: str, text: str | bytes) -> Bad:
        content = text.encode() if isinstance(text, str) else text
        if content == self.text.encode():
            raise ValueError(f"{self.stem}: {kind} changes nothing")
        return Bad(f"{kind}_{self.stem}.{self.ending}", wrong, content)

    def replaced(self, kind: str, wrong: str, pattern: str, new: str, count: int = 1) -> Bad:
        """Of the first `count` places (0: all), with regular expressions as in re.sub."""
        return self.bad(kind, wrong, re.sub(pattern, new, self.text, count=count, flags=re.DOTALL))

    def first(self, entity: str) -> int:
        """The number of the first entity of this name."""
        return int(re.search(rf"#(\d+) = \(? ?{entity}\(", self.text)[1])


class GoodIges(Good):
    """An IGES file in lines of 80 columns; entities have two of section D each, section P the rest."""

    def section(self, letter: str) -> list[str]:
        return [line for line in self.text.splitlines() if line[72:73] == letter]

    def placed(self, types: tuple[int, ...], matrix: tuple[float, ...], form: int = 0) -> str:
        """All entities of these types in the place that the matrix says, a row of it and a shift three times."""
        start, directory, parameters = self.section("S") + self.section("G"), self.section("D"), self.section("P")
        number = len(directory) + 1
        for i in range(0, len(directory), 2):
            if int(directory[i][:8]) in types:
                directory[i] = f"{directory[i][:48]}{number:8d}{directory[i][56:]}"
        words = [f"{word}" for word in (124, *(repr(float(x)) for x in matrix))]
        rows = [",".join(words[:7]) + ",", ",".join(words[7:]) + ";"]
        directory.append(f"{124:8d}{len(parameters) + 1:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}00010000D{number:7d}")
        directory.append(f"{124:8d}{0:8d}{0:8d}{len(rows):8d}{form:8d}{'':24}{0:8d}D{number + 1:7d}")
        parameters += [f"{row:64}{number:8d}P{len(parameters) + k + 1:7d}" for k, row in enumerate(rows)]
        counts = (len(self.section("S")), len(self.section("G")), len(directory), len(parameters))
        end = "".join(f"{letter}{count:7d}" for letter, count in zip("SGDP", counts))
        return "\n".join([*start, *directory, *parameters, f"{end:72}T{1:7d}"]) + "\n"


def truncated(good: Good) -> list[Bad]:
    size, data = len(good.text), good.text.index("DATA;")
    places = {
        "header": data // 2,
        "tenth": data + (size - data) // 10,
        "half": data + (size - data) // 2,
        "nine_tenths": data + 9 * (size - data) // 10,
        "no_end": good.text.rindex("ENDSEC;"),
    }
    return [good.bad(f"cut_{at}", f"ends early: {at}", good.text[:n]) for at, n in places.items()]


# entity -> a pattern up to one of its references
REFERENCES = {
    "VERTEX_POINT": r"(VERTEX_POINT\('',)#\d+",
    "EDGE_CURVE": r"(EDGE_CURVE\('',#\d+,#\d+,)#\d+",
    "edge_start": r"(EDGE_CURVE\('',)#\d+",
    "ORIENTED_EDGE": r"(ORIENTED_EDGE\('',\*,\*,)#\d+",
    "EDGE_LOOP": r"(EDGE_LOOP\('',\()#\d+",
    "FACE_BOUND": r"(FACE_BOUND\('',)#\d+",
    "ADVANCED_FACE": r"(ADVANCED_FACE\('',\()#\d+",
    "face_surface": r"(ADVANCED_FACE\('',\(#\d+\),)#\d+",
    "CLOSED_SHELL": r"(CLOSED_SHELL\('',\()#\d+",
    "MANIFOLD_SOLID_BREP": r"(MANIFOLD_SOLID_BREP\('',)#\d+",
    "AXIS2_PLACEMENT_3D": r"(AXIS2_PLACEMENT_3D\('',)#\d+",
    "representation": r"(ADVANCED_BREP_SHAPE_REPRESENTATION\('',\(#\d+,)#\d+",
}


def wrong_references(good: Good) -> list[Bad]:
    found = []
    other = good.first("PRODUCT_CONTEXT")
    for what, pattern in REFERENCES.items():
        word = what.lower()
        found.append(good.replaced(f"absent_{word}", f"{what} refers to an entity that is not there", pattern, rf"\g<1>#{ABSENT}"))
        found.append(good.replaced(f"type_{word}", f"{what} refers to a PRODUCT_CONTEXT", pattern, rf"\g<1>#{other}"))
    return found


def wrong_numbers(folder: Path) -> list[Bad]:
    cylinder, cone, sphere, torus = (Good(folder, f"{name}.step") for name in ("cylinder", "frustum", "sphere", "torus"))
    surface = r"(CYLINDRICAL_SURFACE\('',#\d+,)[^)]*"
    point = r"(VERTEX_POINT.*?CARTESIAN_POINT\('',\()[^,]*"
    found = [
        cylinder.replaced("zero_radius", "CYLINDRICAL_SURFACE of radius 0", surface, r"\g<1>0."),
        cylinder.replaced("negative_radius", "CYLINDRICAL_SURFACE of negative radius", surface, r"\g<1>-30."),
        cylinder.replaced("zero_circle", "all CIRCLEs of radius 0", r"(CIRCLE\('',#\d+,)[^)]*", r"\g<1>0.", 0),
        cylinder.replaced("zero_direction", "a DIRECTION of length 0", r"(DIRECTION\('',\()[^)]*", r"\g<1>0.,0.,0."),
        cone.replaced("flat_cone", "CONICAL_SURFACE of 90 degrees", r"(CONICAL_SURFACE\('',#\d+,[^,]*,)[^)]*", r"\g<1>1.5707963267949"),
        cone.replaced("negative_radius", "CONICAL_SURFACE of negative radius", r"(CONICAL_SURFACE\('',#\d+,)[^,]*", r"\g<1>-40."),
        sphere.replaced("zero_radius", "SPHERICAL_SURFACE of radius 0", r"(SPHERICAL_SURFACE\('',#\d+,)[^)]*", r"\g<1>0."),
        torus.replaced("zero_radius", "TOROIDAL_SURFACE of minor radius 0", r"(TOROIDAL_SURFACE\('',#\d+,[^,]*,)[^)]*", r"\g<1>0."),
        torus.replaced("no_ring", "TOROIDAL_SURFACE of major radius 0", r"(TOROIDAL_SURFACE\('',#\d+,)[^,]*", r"\g<1>0."),
    ]
    words = {"nan": "NAN", "inf": "INF", "minus_nan": "-1.#IND", "huge": "1.E+999", "two_points": "1.2.3", "word": "'wide'"}
    for kind, word in words.items():
        found.append(cylinder.replaced(f"radius_{kind}", f"CYLINDRICAL_SURFACE of radius {word}", surface, rf"\g<1>{word}"))
        if kind in ("nan", "huge", "word"):
            found.append(cylinder.replaced(f"point_{kind}", f"a vertex with the coordinate {word}", point, rf"\g<1>{word}"))
    return found


def wrong_splines(folder: Path) -> list[Bad]:
    good, rational = Good(folder, "spline_tip.step"), Good(folder, "blend_cone_pipe.step")
    degree = r"(B_SPLINE_SURFACE_WITH_KNOTS\('',)\d+"
    knots = r"(\.UNSPECIFIED\.,\.F\.,\.F\.,\.F\.,)\(4,1,4\)(,\(4,1,4\),)\(0\.,1\.,2\.\)"
    weights = r"(RATIONAL_B_SPLINE_SURFACE\(\(\s*\()[^,]*"
    return [
        good.replaced("degree_0", "a spline surface of degree 0", degree, r"\g<1>0"),
        good.replaced("degree_99", "a spline surface of degree 99", degree, r"\g<1>99"),
        good.replaced("no_poles", "a spline surface without poles", degree + r",\d+,\(.*?\)\),", r"\g<1>3,3,(()),"),
        good.replaced("knots_fall", "knots that decrease", knots, r"\g<1>(4,1,4)\g<2>(0.,2.,1.)"),
        good.replaced("few_knots", "multiplicities that do not fit the poles", knots, r"\g<1>(4,4)\g<2>(0.,2.)"),
        rational.replaced("zero_weight", "a weight of 0", weights, r"\g<1>0."),
        rational.replaced("negative_weight", "a negative weight", weights, r"\g<1>-1."),
    ]


def wrong_topology(folder: Path) -> list[Bad]:
    box, holes, cap, plate = (Good(folder, f"{name}.step") for name in ("box", "holes", "sphere_cut", "spline_plate_hole"))
    first, second = re.findall(r"EDGE_LOOP\('',\(([^)]*)\)", box.text)[:2]
    edges = first.split(",")
    crossed = ",".join([edges[0], edges[2], edges[1], *edges[3:]])
    points = re.findall(r"VERTEX_POINT\('',#\d+\);\n#\d+ = CARTESIAN_POINT\('',(\([^)]*\))", box.text)
    swapped = box.text.replace(points[0], "(?)").replace(points[3], points[0]).replace("(?)", points[3])
    bounds = re.search(r"ADVANCED_FACE\('',\((#\d+),(#\d+)", holes.text)
    return [
        box.bad("empty_shell", "CLOSED_SHELL without faces", re.sub(r"(CLOSED_SHELL\('',)\([^)]*\)", r"\1()", box.text)),
        box.bad("empty_loop", "EDGE_LOOP without edges", box.text.replace(first, "", 1)),
        box.replaced("no_bounds", "ADVANCED_FACE without bounds", r"(ADVANCED_FACE\('',)\([^)]*\)", r"\1()"),
        box.replaced("all_empty", "no face has bounds", r"(ADVANCED_FACE\('',)\([^)]*\)", r"\1()", 0),
        box.bad("crossed_loop", "edges of a loop out of turn", box.text.replace(first, crossed, 1)),
        box.bad("swapped_loops", "two faces have each other's loops", box.text.replace(first, "?").replace(second, first).replace("?", second)),
        box.bad("self_intersecting", "two corners have changed places: loops that cut themselves", swapped),
        box.bad("open_loop", "a loop without its last edge", box.text.replace(first, ",".join(edges[:-1]), 1)),
        box.bad("twice_an_edge", "a loop that runs along one edge twice", box.text.replace(first, ",".join([edges[0], *edges]), 1)),
        holes.bad("swapped_loops", "outer loop and hole have changed places", holes.text.replace(f"{bounds[1]},{bounds[2]}", f"{bounds[2]},{bounds[1]}", 1)),
        holes.bad("hole_alone", "a face with its hole as its only loop", holes.text.replace(f"({bounds[1]},", "(", 1)),
        plate.replaced("hole_alone", "a sheet with its hole as its only loop", r"(ADVANCED_FACE\('',\()#\d+,", r"\1"),
        cap.replaced("curves_gone", "the curve of an edge is that of another", r"(EDGE_CURVE\('',#\d+,#\d+,)#\d+(.*EDGE_CURVE\('',#\d+,#\d+,)(#\d+)", r"\1\3\2\3"),
    ]


def wrong_placements(folder: Path) -> list[Bad]:
    """A reference to an operator in place of two axes; one that neither scales nor mirrors would do."""
    good = Good(folder, "nested.step")

    def placed(kind: str, wrong: str, z: int, scale: str) -> Bad:
        axes = "".join(f"#{ABSENT + i} = DIRECTION('',({axis}));\n" for i, axis in enumerate(("1.,0.,0.", "0.,1.,0.", f"0.,0.,{z}.")))
        words = f"'','','',#{ABSENT},#{ABSENT + 1},#{good.first('CARTESIAN_POINT')},{scale},#{ABSENT + 2}"
        operator = rf"{axes}\1CARTESIAN_TRANSFORMATION_OPERATOR_3D({words})"
        return good.replaced(kind, wrong, r"(#\d+ = )ITEM_DEFINED_TRANSFORMATION\([^)]*\)", operator)

    return [placed("mirrored", "a placement that mirrors", -1, "1."), placed("scaled", "a placement with a scale", 1, "2.")]


def wrong_sections(folder: Path) -> list[Bad]:
    box, nested, external = (Good(folder, f"{name}.step") for name in ("box", "nested", "external"))
    start, end = box.text.index("DATA;"), box.text.rindex("ENDSEC;")
    solid, shell = box.first("MANIFOLD_SOLID_BREP"), box.first("CLOSED_SHELL")
    name = re.search(r"DOCUMENT_FILE\('([^']*)'", external.text)[1]
    frame, leg = (re.search(rf"#(\d+) = PRODUCT_DEFINITION\('design','',#{formation}", nested.text)[1]
                  for formation in re.findall(r"#(\d+) = PRODUCT_DEFINITION_FORMATION\(", nested.text)[:2])  # fmt: skip
    return [
        box.bad("no_data", "no DATA section", box.text[:start] + box.text[end + len("ENDSEC;\n"):]),
        box.bad("empty_data", "an empty DATA section", box.text[:start] + "DATA;\n" + box.text[end:]),
        box.bad("no_header", "no HEADER section", box.text[:13] + "\n" + box.text[start:]),
        box.bad("no_magic", "the first line is another", box.text.replace("ISO-10303-21", "ISO-9999-99")),
        box.bad("empty", "nothing at all", b""),
        box.bad("zeros", "a thousand zero bytes", bytes(1000)),
        box.bad("text", "a letter", "Dear colleague,\nthe drawing will follow.\n"),
        box.bad("zip", "packed", b"PK\x03\x04" + bytes(range(256)) * 8),
        box.replaced("twice_a_shell", "two entities have one number", rf"#{shell} = ", f"#{shell} = MANIFOLD_SOLID_BREP('',#{shell});\n#{shell} = "),
        box.replaced("twice_a_point", "two points have one number", r"#(\d+)( = CARTESIAN_POINT)", r"#\1 = CARTESIAN_POINT('',(7.,7.,7.));\n#\1\2"),
        box.replaced("self_reference", "a solid that consists of itself", rf"#{solid} = MANIFOLD_SOLID_BREP\('',#\d+", f"#{solid} = MANIFOLD_SOLID_BREP('',#{solid}"),
        box.replaced("unknown_entity", "ADVANCED_FACEs of an unknown kind", "= ADVANCED_FACE", "= ADVENTUROUS_FACE", 0),
        box.replaced("few_words", "CLOSED_SHELL with too few words", r"CLOSED_SHELL\('',", "CLOSED_SHELL("),
        box.replaced("open_quote", "a string that does not end", r"CLOSED_SHELL\(''", "CLOSED_SHELL('"),
        box.replaced("no_unit", "no unit of length", r"SI_UNIT\(\.MILLI\.,\.METRE\.\)", "SI_UNIT(.MILLI.,.GRAM.)", 0),
        nested.replaced("circle", "an assembly that is part of itself", rf"(NEXT_ASSEMBLY_USAGE_OCCURRENCE\('[^']*','[^']*','',)#{frame},#{leg}", rf"\g<1>#{leg},#{leg}"),
        Bad("missing_parts.step", f"solids in files that are not there, the first {name}", external.text.encode()),
    ]  # fmt: skip


# Rows of a turn and a shift; and those of others.
TURNED = (0.0, -1.0, 0.0, 5.0, 1.0, 0.0, 0.0, 6.0, 0.0, 0.0, 1.0, 7.0)
MIRRORED = (1.0, 0.0, 0.0, 5.0, 0.0, 1.0, 0.0, 6.0, 0.0, 0.0, -1.0, 7.0)
SCALED = (2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0)
SKEWED = (1.0, 0.5, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)


def wrong_iges_places(folder: Path) -> list[Bad]:
    faces, holes, solid = (GoodIges(folder, f"{name}.igs") for name in ("closed_spline", "branch_holes", "frustum"))
    return [
        faces.bad("mirrored_faces", "trimmed surfaces that are mirrored", faces.placed((144,), MIRRORED, 1)),
        faces.bad("scaled_faces", "trimmed surfaces with a scale", faces.placed((144,), SCALED)),
        faces.bad("skewed_splines", "splines by a matrix that skews", faces.placed((126, 128), SKEWED)),
        holes.bad("mirrored_circles", "arcs of circles that are mirrored", holes.placed((100,), MIRRORED, 1)),
        solid.bad("turned", "a solid by a matrix that turns", solid.placed((186,), TURNED)),
        solid.bad("lost", "a solid that OpenCASCADE makes no shape of: a block, 150", block_in_place_of_solid(solid)),
    ]


def block_in_place_of_solid(good: GoodIges) -> str:
    """Beside it the solid's shell, which is part of nothing any more."""
    lines = good.text.splitlines()
    for i, line in enumerate(lines):
        if line[72:73] == "D" and line[:8].strip() == "186":
            lines[i] = f"{150:8d}{line[8:]}"
        elif line[72:73] == "D" and line[:8].strip() == "514" and line[64:66] == "00":  # its first line, with what it belongs to
            lines[i] = f"{line[:66]}00{line[68:]}"
        elif line.startswith("186,"):
            lines[i] = f"{'150,1.,2.,3.,0.,0.,0.,1.,0.,0.,0.,0.,1.;':64}{line[64:]}"
    return "\n".join(lines) + "\n"


def wrong_iges(folder: Path) -> list[Bad]:
    good = GoodIges(folder, "closed_spline.igs")
    lines = good.text.splitlines(keepends=True)
    directory = [i for i, line in enumerate(lines) if line[72:73] == "D"]
    parameters = [i for i, line in enumerate(lines) if line[72:73] == "P"]
    garbled = list(lines)
    for i in parameters[5:15]:
        garbled[i] = "?garbage; 1.2.3,,nan," + lines[i][21:]
    return [
        good.bad("garbage", "parameter lines of garbage", "".join(garbled)),
        good.bad("half", "ends in the parameters", "".join(lines[: parameters[len(parameters) // 2]])),
        good.bad("no_directory", "no directory section", "".join(lines[: directory[0]] + lines[directory[-1] + 1 :])),
        good.bad("no_parameters", "no parameter section", "".join(lines[: parameters[0]] + lines[parameters[-1] + 1 :])),
        Bad("step_inside.igs", "a STEP file that is called IGES", (folder / "box.step").read_bytes()),
        Bad("iges_inside.step", "an IGES file that is called STEP", good.text.encode()),
    ]


def bad_files(folder: Path) -> list[Bad]:
    found = [bad for name in ("box", "blend_cone_pipe", "nested") for bad in truncated(Good(folder, f"{name}.step"))]
    found += wrong_references(Good(folder, "box.step"))
    for section in (wrong_numbers, wrong_splines, wrong_topology, wrong_placements, wrong_sections, wrong_iges, wrong_iges_places):
        found += section(folder)
    return found


def main() -> None:
    good, target = Path(sys.argv[1]), Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    files = bad_files(good)
    if len({bad.name for bad in files}) != len(files):
        raise ValueError("two bad files of one name")
    for bad in files:
        (target / bad.name).write_bytes(bad.content)
    (target / "list.txt").write_text("".join(bad.line() for bad in files))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of STEP files: the same as shapes given by words and as LIGGGHTS' mesh, theory of a sheet and of what is selected,
placed, moved, on ranks, after a restart, and what is written of them."""

import os
import re
import subprocess
import unittest
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import decks
import vtu
from prelude import INTEGRATION, Prelude, create

MODELS = "model hertz tangential history"
RADIUS, DENSITY, YOUNG, POISSON = 5e-3, 2500.0, 5e6, 0.3  # of balls and walls
GRAVITY = "fix g all gravity 9.81 vector 0 0 -1\n"
WEIGHT = 4 / 3 * np.pi * RADIUS**3 * DENSITY * 9.81


@cache
def parts() -> dict[str, bytes]:
    maker = os.environ["MAKE_STEP_PARTS"]
    names = [f"{n}.step" for n in ("box", "cylinder", "cylinder_2", "cylinder_4", "cylinder_8", "nested", "thin_sheet", "trumpet")]
    with TemporaryDirectory() as folder:
        subprocess.run([maker, folder, *names], check=True)
        return {name: (Path(folder) / name).read_bytes() for name in names}


def box_stl() -> str:
    """The sides of the box in triangles."""
    lines = ["solid box"]
    for axis in range(3):
        for sign in (-1, 1):
            square = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
            corners = np.insert(square, axis, sign, axis=1) * (0.05, 0.03, 0.02)
            for triangle in (corners[[0, 1, 2]], corners[[0, 2, 3]]):
                lines += ["facet normal 0 0 0", "outer loop"]
                lines += ["vertex {:.9g} {:.9g} {:.9g}".format(*corner) for corner in triangle]
                lines += ["endloop", "endfacet"]
    return "\n".join(lines) + "\nendsolid box\n"


def prelude(mu=0.4, e=0.6, **words) -> Prelude:
    words = dict(timestep=2e-5, skin=1e-3, lists="delay 0") | words
    return Prelude("-0.1 0.9 -0.1 0.2 -0.1 0.2", E=(YOUNG,), nu=(POISSON,), e=e, mu=mu, **words)


def balls(places, velocity=(0, 0, 0)) -> str:
    lines = create(*(tuple(map(float, place)) for place in places))
    lines += f"set group all diameter {2 * RADIUS} density {DENSITY}\nvelocity all set {{}} {{}} {{}}\n".format(*velocity)
    return lines + INTEGRATION


def wall(words: str, name: str = "wall", further: str = "") -> str:
    return f"fix {name} all wall/nurbs {MODELS} type 1 geometry {words} {further}\n"


def output(columns: list[str], every: int) -> str:
    words = f"thermo_style custom step {' '.join(columns)}\nthermo_modify format float %.17g lost error\nthermo {every}\n"
    return words


def hertz(overlap: float) -> float:
    """Force of a ball on a plane of its own material."""
    return 4 / 3 * YOUNG / (2 * (1 - POISSON**2)) * RADIUS**0.5 * overlap**1.5


# Cylinders lie side by side, their axes along y; the box, half as large, stands beyond them.
CYLINDERS = {"cylinder": 0.0, "cylinder_2": 0.2, "cylinder_4": 0.4, "cylinder_8": 0.6}  # x of each
BOX = 0.8
LYING = "rotate axis 1 0 0 angle -90 rotate axis 0 1 0 angle -90 move {} 0 0"  # a seam on top
WORDS = {
    f"{name}.yaml": f"units: si\ngeometry:\n  cylinder: {{origin: [{x}, 0, 0], axis: [0, 1, 0], radius: 0.03, length: 0.08, "
    "elements: [8, 3]}\n"
    "surfaces: {all: all}\n"
    for name, x in CYLINDERS.items()
}
SIDES = "xi-, xi+, eta-, eta+, zeta-, zeta+"
WORDS["box.yaml"] = (
    f"units: si\ngeometry:\n  box: {{origin: [{BOX - 0.025}, -0.015, -0.01], size: [0.05, 0.03, 0.02], elements: [2, 3, 1], "
    f"degree: 2}}\nsurfaces: {{all: [{SIDES}]}}\n"
)
NAMES = (*CYLINDERS, "box")
FIX = {name: f"w{k}" for k, name in enumerate(NAMES)}  # names of columns are short


def walls(of_step: bool) -> str:
    if not of_step:
        return "".join(wall(f"{name}.yaml surface all", FIX[name]) for name in NAMES)
    placed = {name: LYING.format(x) for name, x in CYLINDERS.items()} | {"box": f"scale 0.5 move {BOX} 0 0"}
    return "".join(wall(f"{name}.step surface all {place}", FIX[name]) for name, place in placed.items())


def at(x: float, degrees: float, y: float) -> tuple[float, float, float]:
    """Just off a cylinder, degrees from its top."""
    angle, r = np.radians(degrees), 0.03 + 1.02 * RADIUS
    return x + r * np.sin(angle), y, r * np.cos(angle)


# Two on each cylinder, which roll over its top and the borders of its faces; on the box over its top, edges and a corner.
PLACES = [at(x, *place) for x in CYLINDERS.values() for place in ((-1.2, 0.02), (44.0, 0.055))]
PLACES += [(BOX, 0.0, 0.0151), (BOX - 0.027, 0.002, 0.0142), (BOX + 0.0255, 0.0155, 0.0149), (BOX + 0.001, -0.0165, 0.0148)]
COLUMNS = [f"v_{v}{n}" for n in range(1, 1 + len(PLACES)) for v in ("x", "y", "z", "fx", "fy", "fz")]
TRACKS = "".join(f"variable {c[2:]} equal {re.sub('[0-9]+', '', c[2:])}[{re.sub('[^0-9]+', '', c)}]\n" for c in COLUMNS)
TRACKS += output(COLUMNS + [f"f_{fix}[{k}]" for fix in FIX.values() for k in (1, 2, 3, 7)], 20)
BEGIN = balls(PLACES, (0.25, 0.05, -0.1)) + GRAVITY
HALFWAY = "run 700\nwrite_restart half\nrun 700\n"


class Shapes(unittest.TestCase):
    """Balls that roll and rebound on the outside of solids."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        for name, content in parts().items():
            (cls.folder / name).write_bytes(content)
        cls.whole = decks.run_in(cls.folder, prelude().text() + BEGIN + walls(True) + TRACKS + HALFWAY)
        assert cls.whole.code == 0, cls.whole.text[-3000:]

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def assert_near(self, table, reference, tolerance):
        forces = max(np.abs(values).max() for column, values in reference.items() if column.startswith("f"))
        for column, values in reference.items():
            scale = 1.0 if column == "Step" or "[7]" in column else forces if "f" in column or "[" in column else RADIUS
            self.assertEqual(len(values), len(table[column]))
            self.assertLess(np.abs(table[column] - values).max(), tolerance * scale, column)

    def test_the_same_as_words(self):
        words = decks.good(prelude().text() + BEGIN + walls(False) + TRACKS + HALFWAY, files=WORDS).table
        for name in NAMES:
            self.assertGreater(words[f"{FIX[name]}[7]"].max(), 0.5, f"balls touch the {name}")
        self.assert_near(self.whole.table, words, 1e-10)

    def test_the_same_on_ranks(self):
        two = prelude(processors="2 1 1").text() + BEGIN + walls(True) + TRACKS + HALFWAY
        self.assert_near(decks.good(two, files=parts(), ranks=2).table, self.whole.table, 1e-9)

    def test_goes_on_after_a_restart(self):
        again = prelude().again("half") + INTEGRATION + GRAVITY + walls(True) + TRACKS + "run 700\n"
        table = decks.run_in(self.folder, again).table
        for column, values in self.whole.tables[1].items():
            np.testing.assert_array_equal(table[column], values, column)


class Moved(unittest.TestCase):
    def test_as_the_mesh_of_liggghts(self):
        """The box turns under a ball, which it meets with its top, then with an edge."""
        motion = "rotate origin 0 0 0 axis 0 1 0 period 0.5"
        begin = prelude().text() + balls([(-0.03, 0.004, 0.0255)], (0, 0, -0.3))
        begin += "".join(f"variable {v} equal {v}[1]\n" for v in ("x", "z", "fx", "fy", "fz"))
        end = output([f"v_{v}" for v in ("x", "z", "fx", "fy", "fz")], 10) + "run 1500\n"
        ours = begin + wall("box.step surface all motion " + motion) + end
        stock = "fix cad all mesh/surface file box.stl type 1\n"
        stock += f"fix turn all move/mesh mesh cad {motion}\nfix wall all wall/gran {MODELS} mesh n_meshes 1 meshes cad\n"
        ours = decks.good(ours, files=parts()).table
        stock = decks.good(begin + stock + end, files={"box.stl": box_stl()}, program=decks.STOCK).table
        self.assertGreater(np.count_nonzero(stock["fz"]), 5)
        for column in ("x", "z", "fx", "fz"):
            self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), 1e-6, column)


class Contacts(unittest.TestCase):
    def test_a_sheet_thinner_than_a_ball(self):
        """At rest on 2 mm: one contact, the overlap is Hertz' of the weight."""
        overlap = (WEIGHT / hertz(1.0)) ** (2 / 3)
        deck = prelude().text() + balls([(0.1, 0.05, 2e-3 + RADIUS - overlap)]) + GRAVITY
        deck += wall("thin_sheet.step surface all") + output(["f_wall[1]", "f_wall[2]", "f_wall[3]", "f_wall[7]"], 10)
        table = decks.good(deck + "run 300\n", files=parts()).table
        np.testing.assert_array_equal(table["wall[7]"], 1.0)
        np.testing.assert_allclose(table["wall[3]"], -WEIGHT, rtol=1e-9)
        for k in (1, 2):
            self.assertLess(np.abs(table[f"wall[{k}]"]).max(), 1e-12 * WEIGHT)

    def test_a_centre_that_begins_inside(self):
        """It falls through the box, and what is said of it where it comes out names that cause."""
        deck = prelude().text() + balls([(0.0, 0.0, -0.019)], (0, 0, -0.2)) + wall("box.step surface all")
        run = decks.good(deck + output(["f_wall[7]"], 10) + "run 280\n", files=parts())
        self.assertEqual(run.table["wall[7]"][0], 0.0)
        self.assertIn("began inside a solid", run.text)

    def test_a_centre_that_passes_a_thin_sheet(self):
        """A soft ball hits 2 mm so hard that its centre comes out below: Hertz' law, all of its energy, back it goes."""
        deepest = 1.6 * RADIUS
        mass, energy = WEIGHT / 9.81, 2 / 5 * hertz(deepest) * deepest
        speed = np.sqrt(2 * energy / mass)
        deck = prelude(mu=0.0, e=1.0, timestep=1e-6).text() + balls([(0.1, 0.05, 2e-3 + 1.02 * RADIUS)], (0, 0, -speed))
        deck += wall("thin_sheet.step surface all") + "variable vz equal vz[1]\nvariable z equal z[1]\n"
        deck += output(["v_z", "v_vz", "f_wall[3]", "f_wall[7]"], 1)
        run = decks.good(deck + "run 1500\n", files=parts())
        z, vz, force, touches = (run.table[c] for c in ("z", "vz", "wall[3]", "wall[7]"))
        self.assertAlmostEqual(vz[-1] / speed, 1.0, delta=1e-5)
        self.assertAlmostEqual((2e-3 + RADIUS - z.min()) / deepest, 1.0, delta=1e-4)
        np.testing.assert_allclose(-force[touches > 0], hertz(2e-3 + RADIUS - z[touches > 0]), rtol=1e-9)
        self.assertIn("got inside the solid", run.text)

    def test_fields_of_a_centre_that_is_behind(self):
        """Where a fast ball's centre is below the sheet, too, it presses, and wears as it goes in, not as it comes back."""
        deck = prelude(mu=0.0, e=1.0, timestep=1e-5, further={"k_finnie": 1e-9}).text() + "variable z equal z[1]\n"
        deck += balls([(0.1, 0.05, 2e-3 + 1.02 * RADIUS)], (3, 0, -21))
        deck += wall("thin_sheet.step surface all", further="output out every 1 fields pressure wear average no")
        with TemporaryDirectory() as folder:
            for name, part in parts().items():
                (Path(folder) / name).write_bytes(part)
            run = decks.run_in(Path(folder), deck + output(["v_z", "f_wall[3]"], 1) + "run 100\n")
            self.assertEqual(run.code, 0, run.text[-1500:])
            states = [vtu.read(Path(folder) / f"out_{int(step)}.vtu").elements for step in run.table["Step"]]
        z, pushed = run.table["v_z"] if "v_z" in run.table else run.table["z"], run.table["wall[3]"] < 0.0
        self.assertTrue(np.any(z < 2e-3), "its centre is below the sheet")
        for state, is_pushed in zip(states, pushed):
            self.assertEqual(state["pressure"].max() > 0.0, is_pushed)
            self.assertGreaterEqual(state["pressure"].min(), 0.0)
        worn = np.array([state["wear"].sum() for state in states])
        deepest = np.argmin(z)
        self.assertGreater(worn[deepest], 0.9 * worn[-1])

    def test_a_face_closed_in_a_circle(self):
        """A ring of balls inside, as near a sheet of four elements as its curvature allows: each has one contact, at the seam, too."""
        t, count, radius = 0.2, 180, 4e-3
        r, z = 0.01 * (1 - t) ** 2 + 0.022 * t * (1 - t) + 0.045 * t**2, 0.078 * t * (1 - t) + 0.04 * t**2
        slope = np.array([0.002 * (1 - t) + 0.068 * t, 0.078 * (1 - t) + 0.002 * t])
        r, z = np.array([r, z]) + 0.996 * radius * np.array([-slope[1], slope[0]]) / np.linalg.norm(slope)
        angles = 2 * np.pi * (np.arange(count) + 0.37) / count
        deck = prelude(skin=2e-3, lists="delay 0 exclude type 1 1").text()
        deck += "".join(create(*((r * np.cos(a), r * np.sin(a), z) for a in angles)))
        deck += f"set group all diameter {2 * radius} density {DENSITY}\n" + INTEGRATION
        turning = "surface all motion rotate origin 0 0 0 axis 0 0 1 period 0.1"
        deck += wall("trumpet.step " + turning) + "fix still all setforce 0 0 0\n" + output(["f_wall[7]"], 50)
        table = decks.good(deck + "run 1000\n", files=parts()).table
        np.testing.assert_array_equal(table["wall[7]"], count)

    def test_what_is_selected(self):
        """A ball on top of the plate of an assembly, tilted by 5 degrees."""
        tilt, overlap = np.radians(5.0), 2e-5
        normal = np.array([0.0, -np.sin(tilt), np.cos(tilt)])
        place = np.array([0.0, 0.0, 0.11]) + (0.01 + RADIUS - overlap) * normal
        touching = ("all", "table", "top", "colour:FF8800", "face:24")
        apart = ("sole", "colour:0000FF", "face:1", '"left leg"')
        deck = prelude().text() + balls([place])
        deck += "".join(wall(f"nested.step surface {word}", f"w{k}") for k, word in enumerate(touching + apart))
        deck += output([f"f_w{k}[{i}]" for k in range(len(touching + apart)) for i in (1, 2, 3)], 1)
        table = decks.good(deck + "run 0\n", files=parts()).table
        for k, word in enumerate(touching + apart):
            force = -hertz(overlap) * normal if word in touching else np.zeros(3)
            found = [table[f"w{k}[{i}]"][0] for i in (1, 2, 3)]
            np.testing.assert_allclose(found, force, atol=1e-9 * hertz(overlap), err_msg=word)


class Kept(unittest.TestCase):
    """What `keep` leaves of an assembly, on which a ball falls."""

    def table(self, folder: Path, words: str, ranks: int) -> dict[str, np.ndarray]:
        begin = prelude(**{"processors": "2 1 1"} if ranks == 2 else {}).text() + balls([(0.1, 0.0, 0.1257)], (0.2, 0.1, -0.3))
        begin += "".join(f"variable {v} equal {v}[1]\n" for v in ("x", "y", "z"))
        columns = ["v_x", "v_y", "v_z", *(f"f_wall[{k}]" for k in range(1, 8))]
        placed = f"{words} rotate axis 0 0 1 angle 30 move 0.1 0 0"
        run = decks.run_in(folder, begin + wall(placed) + output(columns, 5) + "run 300\n", ranks)
        self.assertEqual(run.code, 0, run.text[-3000:])
        return run.table

    def test_the_same_run(self):
        """To the last digit, and the file is that of nurbs-convert."""
        with TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "nested.step").write_bytes(parts()["nested.step"])
            subprocess.run([os.environ["NURBS_CONVERT"], "nested.step", "converted.h5"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            for ranks in (1, 2):
                (folder / "kept.h5").write_text("an older one")
                of_step = self.table(folder, "nested.step keep kept.h5 surface all", ranks)
                self.assertEqual((folder / "kept.h5").read_bytes(), (folder / "converted.h5").read_bytes())
                self.assertEqual([path.name for path in folder.glob("*.part")], [])
                self.assertGreater(np.count_nonzero(of_step["wall[3]"]), 5)
                kept = self.table(folder, "kept.h5 surface all", ranks)
                for column, values in of_step.items():
                    np.testing.assert_array_equal(kept[column], values, column)


class Errors(unittest.TestCase):
    def test_each_in_one_line_on_ranks(self):
        box = parts()["box.step"]
        astray = re.sub(rb"(ADVANCED_FACE\('[^']*',\(#\d+\),)#\d+", rb"\1#987654", box, count=1)
        self.assertNotEqual(astray, box)
        files = parts() | {"cut.step": box[: len(box) // 2], "astray.step": astray}
        files["tiny.yaml"] = b"units: si\ngeometry: {file: box.step, scale: 1e-99}\n"
        for words, ranks, expected in (
            ("nested.step surface lid", 1, ["nested.step", "'lid'", "face:N with N from 1 to 24", "colour:FF8800", "sole, top"]),
            ("cut.step surface all", 3, ["cut.step:", "ends early"]),
            ("astray.step surface all", 1, ["astray.step:", "ADVANCED_FACE"]),
            ("box.step keep gone/box.h5 surface all", 2, ["gone/box.h5: cannot write here", "No such file or directory"]),
            ("box.step surface all scale 1e-150", 2, ["box.step: scaled by 1e-150 it is 1e-151 in size, expected 1e-30 to 1e+30"]),
            ("tiny.yaml surface all", 1, ["tiny.yaml:2: scale is 1e-99: the shape becomes 1e-100 in size, expected 1e-30 to 1e+30"]),
            ("box.step surface all keep /dev/box.h5/box.h5", 1, ["/dev/box.h5/box.h5: cannot write here"]),
        ):
            with self.subTest(words):
                deck = prelude().text() + balls([(0.0, 0.0, 0.1)]) + wall(words) + "run 0\n"
                run = decks.run(deck, files=files, ranks=ranks, timeout=30)
                self.assertNotEqual(run.code, 0)
                self.assertEqual(len(run.errors), 1, run.text[-1500:])
                for word in expected:
                    self.assertIn(word, run.errors[0])


class Written(unittest.TestCase):
    """A ball falls on the curved face of a cylinder that lies, without friction."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        (cls.folder / "cylinder.step").write_bytes(parts()["cylinder.step"])
        deck = prelude(mu=0.0).text() + balls([at(0.0, 20.0, 0.03)], (0, 0, -0.5))
        further = "output out every 10 fields pressure average no stl out every 10 chord 1e-4 verbose yes"
        deck += wall("cylinder.step surface all " + LYING.format(0), further=further)
        cls.whole = decks.run_in(cls.folder, deck + output([f"f_wall[{k}]" for k in (1, 2, 3)], 10) + "run 100\n")
        assert cls.whole.code == 0, cls.whole.text[-3000:]

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def corners(self, name: str) -> np.ndarray:
        """Of each triangle, n x 3 x 3."""
        lines = (self.folder / name).read_text().splitlines()
        return np.array([line.split()[1:] for line in lines if line.startswith("vertex")], dtype=float).reshape(-1, 3, 3)

    def test_what_it_says(self):
        self.assertRegex(self.whole.text, "surface 'all' of 'cylinder.step'\n.*2 planes?, 1 cylinder")

    def test_pressure_adds_up_to_the_force(self):
        forces = np.array([self.whole.table[f"wall[{k}]"] for k in (1, 2, 3)])
        size = np.linalg.norm(forces, axis=0)
        self.assertGreater(np.count_nonzero(size), 2)
        for step, force in zip(self.whole.table["Step"], size):
            state = vtu.read(self.folder / f"out_{int(step)}.vtu")
            a, b, c = (state.points[[cell[k] for cell in state.cells]] for k in range(3))
            areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
            self.assertAlmostEqual(abs(state.elements["pressure"] @ areas), force, delta=1e-6 * size.max())

    def test_triangles_are_closed(self):
        corners = self.corners("out_0.stl")
        a, b, c = corners.transpose(1, 0, 2)
        normals = 0.5 * np.cross(b - a, c - a)
        area, volume = np.linalg.norm(normals, axis=1).sum(), (a * normals).sum() / 3
        self.assertAlmostEqual(area, 2 * np.pi * 0.03 * 0.11, delta=0.005 * area)
        self.assertAlmostEqual(volume, np.pi * 0.03**2 * 0.08, delta=0.01 * volume)
        self.assertLess(np.linalg.norm(normals.sum(axis=0)), 1e-9 * area)  # nothing is missing
        y = corners[..., 1]
        self.assertAlmostEqual(y.min(), 0.0, delta=1e-8)
        self.assertAlmostEqual(y.max(), 0.08, delta=1e-8)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of triangles from STL files beside LIGGGHTS' own mesh of the same file: at rest, moved, pushed by a servo, in
periodic boxes, on ranks, after a restart."""

import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import decks
import moving_wall as mw
from prelude import INTEGRATION, Prelude

MODELS = "model hertz tangential history"
FLAT = "geometry flat.stl surface all"

# A tray with a ridge in its middle: concave edges round its floor, a convex one, walls that end in free edges.
HALF, HEIGHT, RIDGE = 0.02, 0.01, 0.004


def quads(x):
    """The tray, scaled about its middle by `x`."""
    a, r, h, k = -HALF * x, RIDGE * x, HEIGHT * x, RIDGE * x
    floor = [(a, a, 0), (-r, a, 0), (0, a, k), (r, a, 0), (-a, a, 0)]
    for p, q in zip(floor, floor[1:]):
        yield (p, q, (q[0], -a, q[2]), (p[0], -a, p[2]))
    for p, q in (((a, a), (-a, a)), ((-a, a), (-a, -a)), ((-a, -a), (a, -a)), ((a, -a), (a, a))):
        yield ((*p, 0), (*q, 0), (*q, h), (*p, h))


def stl(solids) -> str:
    """Of solids of quads, by name."""
    lines = []
    for name, faces in solids.items():
        lines.append(f"solid {name}")
        for a, b, c, d in faces:
            for corners in ((a, b, c), (a, c, d)):
                lines += ["facet normal 0 0 0", "outer loop"]
                lines += ["vertex " + " ".join(f"{v:.9g}" for v in corner) for corner in corners]
                lines += ["endloop", "endfacet"]
        lines.append(f"endsolid {name}")
    return "\n".join(lines) + "\n"


def tray(x=1.0) -> str:
    return stl({"floor": list(quads(x))[:4], "rim": list(quads(x))[4:]})


FILES = {"tray.stl": tray(), **mw.FILES}
WALLS = {
    decks.NURBS: f"fix wall all wall/nurbs {MODELS} type 1 geometry tray.stl surface all",
    decks.STOCK: f"fix cad all mesh/surface file tray.stl type 1\nfix wall all wall/gran {MODELS} mesh n_meshes 1 meshes cad",
}


def begin(processors: str = "") -> str:
    return Prelude(
        "-0.025 0.025 -0.025 0.025 -0.01 0.02", E=(5e6,), nu=(0.3,), e=0.6, mu=0.4, timestep=2e-6, skin=5e-4,
        lists="delay 0", processors=processors,
    ).text()


def balls() -> str:
    """7 x 7 of them, thrown aside and down: they meet faces, edges and vertices, not each other at first."""
    places = [(0.005 * i, 0.005 * j, 0.0065) for i in range(-3, 4) for j in range(-3, 4)]
    lines = ["create_atoms 1 single {:g} {:g} {:g} units box".format(*place) for place in places]
    return "\n".join(lines) + "\nset group all diameter 0.002 density 2500\nvelocity all set 2.7 1.05 -1.8\n" + INTEGRATION


OUTPUT = """fix g all gravity 9.81 vector 0 0 -1
compute spin all erotate/sphere
compute high all reduce sum z
thermo_style custom step ke c_spin c_high
thermo_modify format float %.17g lost error
thermo 200
"""


class BesideStock(unittest.TestCase):
    def test_balls_in_a_tray(self):
        ours, stock = (
            decks.good(begin() + balls() + wall + "\n" + OUTPUT + "run 3000\n", files=FILES, program=program).table
            for program, wall in WALLS.items()
        )
        self.assertLess(stock["KinEng"][-1], 0.7 * stock["KinEng"][0], "they have met the wall")
        for column in ("KinEng", "spin", "high"):
            self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), 1e-6, column)

    def test_units_that_no_geometry_file_names(self):
        """A file without units has those of the deck, whatever they are."""
        for units in ("cgs", "lj", "micro"):
            with self.subTest(units):
                ours, stock = (
                    decks.good(
                        begin().replace("units si", f"units {units}\nsoft_particles yes") + balls() + wall + "\n" + OUTPUT + "run 400\n",
                        files=FILES, program=program,
                    ).table
                    for program, wall in WALLS.items()
                )
                self.assertNotEqual(stock["KinEng"][-1], stock["KinEng"][0])
                for column in ("KinEng", "spin", "high"):
                    self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), 1e-6, column)

    def test_files_that_name_their_units_are_refused_in_others(self):
        named = {"tray.yaml": "units: si\ngeometry: {file: tray.stl}\n", "part.step": "ISO-10303-21;\n", **FILES}
        for file, told in (
            ("tray.yaml", "'tray.yaml' has units si, expected those of the deck, units lj"),
            ("part.step", "'part.step' is a CAD file, .* in units lj, expected units si or cgs"),
        ):
            wall = WALLS[decks.NURBS].replace("tray.stl", file)
            self.assertRegex(decks.run(begin().replace("units si", "units lj") + wall + "\n", files=named).errors[0], told)

    def test_a_wall_that_moves(self):
        for words in ("linear 0.1 -0.2 0.5", "rotate origin 0.001 -0.001 -0.0005 axis 1 2 0.5 period 0.02"):
            with self.subTest(words):
                wall = f"fix wall all wall/nurbs {MODELS} type 2 {FLAT} motion {words}"
                run = mw.output() + "run 800\n"
                ours = decks.good(mw.deck(wall) + run, files=FILES).table
                stock = decks.good(mw.deck(mw.stock_wall(MODELS, [words])) + run, files=FILES, program=decks.STOCK).table
                self.assertGreater(stock["fz"].max(), 0.05, "the ball touches")
                for kind, difference in mw.largest_differences(ours, stock).items():
                    self.assertLessEqual(difference, 1e-10, kind)

    def test_a_servo(self):
        servo = "com 0 0 2.01033e-3 ctrlPV force axis 0 0 1 target_val -0.02 vel_max 0.05 kp 0.5 ki 1000 kd 1e-6"
        files = {"flat.stl": mw.triangles("2.01033e-3")}
        options = dict(
            balls=((3e-3, -2e-3, 1e-3),), velocity=(0, 0, 0), mu=0, dt=2e-6,
            before=f"fix floor all wall/gran {MODELS} primitive type 2 zplane 0.",
        )
        run = mw.output("variable push equal {}", "v_push") + "run 2000\n"
        ours = mw.deck(f"fix wall all wall/nurbs {MODELS} type 2 {FLAT} servo {servo}", **options)
        stock = mw.deck(mw.stock_wall(MODELS, style="mesh/surface/stress/servo", drive=servo), **options)
        ours = decks.good(ours + run.replace("{}", "f_wall[3]"), files=files).table
        stock = decks.good(stock + run.replace("{}", "f_cad[3]"), files=files, program=decks.STOCK).table
        self.assertAlmostEqual(stock["push"][-1], 0.02, delta=1e-3)
        for column in ("push", "z", "vz"):
            self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), 1e-9, column)


class TJunctions(unittest.TestCase):
    """Corners on the sides of other triangles, as files of parts that were meshed apart have them."""

    def test_a_floor_in_two_meshes_is_a_plane(self):
        left = [((-0.02, -0.02, 0), (0, -0.02, 0), (0, 0.02, 0), (-0.02, 0.02, 0))]
        rows = np.linspace(-0.02, 0.02, 4).tolist()
        right = [((0, p, 0), (0.02, p, 0), (0.02, q, 0), (0, q, 0)) for p, q in zip(rows, rows[1:])]
        files = {"floor.stl": stl({"left": left, "right": right})}
        places = [(x, y) for x in (-2e-5, 0.0, 1e-5, 4e-5, 1e-3) for y in (-0.01, rows[1], 0.0, rows[2] + 1e-5, 0.015)]
        deck = begin() + "".join(f"create_atoms 1 single {x!r} {y!r} 0.000998 units box\n" for x, y in places)
        deck += "set group all diameter 0.002 density 2500\n" + INTEGRATION
        deck += "".join(f"variable f{k} equal fz[{k}]\n" for k in range(1, len(places) + 1))
        end = f"thermo_style custom step {' '.join(f'v_f{k}' for k in range(1, len(places) + 1))}\n"
        end += "thermo_modify format float %.17g\nneigh_modify exclude group all all\nrun 0\n"
        wall = f"fix wall all wall/nurbs {MODELS} type 1 geometry floor.stl surface all\n"
        plane = f"fix wall all wall/gran {MODELS} primitive type 1 zplane 0.\n"
        ours = decks.good(deck + wall + end, files=files).table
        stock = decks.good(deck + plane + end, program=decks.STOCK).table
        for k, place in enumerate(places, 1):
            self.assertGreater(stock[f"f{k}"][0], 0.0)
            self.assertAlmostEqual(ours[f"f{k}"][0] / stock[f"f{k}"][0], 1.0, delta=1e-9, msg=str(place))


class OnRanks(unittest.TestCase):
    def test_the_same_to_the_last_bit_on_ranks_and_after_a_restart(self):
        end = "thermo_style custom step f_wall[1] f_wall[2] f_wall[3] f_wall[4]\nthermo_modify format float %.17g\nthermo 20\n"
        deck = begin("{} 1 1") + balls() + WALLS[decks.NURBS] + "\n" + OUTPUT + end
        deck += "run 1250\nwrite_restart tray.restart\nrun 400\n"
        one = decks.good(deck.format(1), files=FILES)
        forces = [f"wall[{k}]" for k in (1, 2, 3, 4)]
        self.assertGreater(np.abs(one.tables[1]["wall[3]"]).max(), 1e-3, "they touch")
        two = decks.good(deck.format(2), files=FILES, ranks=2)
        with TemporaryDirectory() as folder:
            for name, text in FILES.items():
                (Path(folder) / name).write_text(text)
            self.assertEqual(decks.run_in(Path(folder), deck.format(1)).code, 0)
            again = Prelude(
                "", E=(5e6,), nu=(0.3,), e=0.6, mu=0.4, timestep=2e-6, skin=5e-4, lists="delay 0"
            ).again("tray.restart")
            again += INTEGRATION + WALLS[decks.NURBS] + "\n" + OUTPUT + end + "run 400\n"
            continued = decks.run_in(Path(folder), again)
            (Path(folder) / "tray.stl").write_text(tray(1.01))
            other = decks.run_in(Path(folder), again)
        for column in forces:
            np.testing.assert_array_equal(two.table[column], one.table[column], column)
            np.testing.assert_array_equal(continued.tables[0][column], one.tables[1][column], column)
        self.assertNotEqual(other.code, 0)
        self.assertRegex(other.text, r"geometry: \d+ faces from .* then")


class Errors(unittest.TestCase):
    def test_each_says_what_to_do(self):
        wall = WALLS[decks.NURBS]
        for line, words in (
            (wall.replace("surface all", "surface lid"), ["'lid'", "floor", "rim"]),
            (wall.replace("geometry", "structure"), ["tray.stl"]),
            (wall.replace("tray.stl", "cut.stl"), ["cut.stl:"]),
            (wall + " edge_angle -1", ["edge_angle", "-1"]),
        ):
            with self.subTest(line):
                cut = tray()[:700]
                result = decks.run(begin() + balls() + line + "\nrun 0\n", files=FILES | {"cut.stl": cut}, ranks=2)
                self.assertNotEqual(result.code, 0)
                self.assertEqual(len(result.errors), 1, result.text[-1500:])
                for word in words:
                    self.assertIn(word, result.errors[0])


if __name__ == "__main__":
    unittest.main()

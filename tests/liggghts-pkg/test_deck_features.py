# SPDX-License-Identifier: GPL-2.0-or-later
"""What real decks put beside a wall, each beside LIGGGHTS' own walls: periodic faces, clumps, other walls, groups, stored
forces, heat."""

import unittest

import numpy as np

import decks
from branch_decks import (
    GRAVITY, MODELS, OUTPUT, R, difference, model_file, nurbs, planes, prelude, quad, run, settings, table,
)  # fmt: skip
from prelude import Prelude, create

SAME = 1e-10
PATCH = "fix {id} all wall/nurbs " + MODELS + " type 2 geometry {file}.yaml surface wall {more}\n"


def floor(half=0.03) -> str:
    return quad((-half, -half, 0), (2 * half, 0, 0), (0, 2 * half, 0), (5, 4))


def side(half=0.03) -> str:
    """At x = 0."""
    return quad((0, -half, -half), (0, 2 * half, 0), (0, 0, 2 * half), (4, 5))


def square(x0: float, x1: float, half: float) -> str:
    """STL of two triangles at z = 0."""
    a, b, c, d = ((x0, -half), (x1, -half), (x1, half), (x0, half))
    facets = ""
    for corners in ((a, b, c), (a, c, d)):
        vertices = "".join(f"vertex {x!r} {y!r} 0\n" for x, y in corners)
        facets += f"facet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\n"
    return f"solid square\n{facets}endsolid square\n"


def mesh_wall(file: str) -> str:
    mesh = f"fix cad all mesh/surface file {file} type 2\n"
    return mesh + f"fix mesh all wall/gran {MODELS} mesh n_meshes 1 meshes cad\n"


class Features(unittest.TestCase):
    def same(self, ours: dict, stock: dict) -> None:
        self.assertLessEqual(difference(ours, stock), SAME)

    def test_edge_of_an_image_across_a_periodic_face(self):
        """The wall's edge at x = -6 mm is met at x = 2 mm in a box of 8 mm; LIGGGHTS' wall stands there, in a larger box."""
        y = "-0.004 0.004 -0.005 0.02"
        ball, velocity = (1.6e-3, 2e-4, 0.95 * R), (0.05, 0.1, -0.2)
        small = prelude(ball, velocity, gravity=False, boundary="p f f", box=f"-0.004 0.004 {y}")
        large = prelude(ball, velocity, gravity=False, box=f"-0.008 0.008 {y}")
        wall = model_file(quad((-6e-3, -3e-3, 0), (4e-3, 0, 0), (0, 6e-3, 0), (3, 3)))
        stock = run(large, mesh_wall("wall.stl"), {"wall.stl": square(2e-3, 6e-3, 3e-3)}, program=decks.STOCK, steps=1500).table
        self.assertLess(stock["fx"].min(), -1e-3 * abs(stock["fz"]).max(), "the edge pushes sideways")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.same(run(small, nurbs(), wall, steps=1500, ranks=ranks).table, stock)

    def test_rims_along_a_periodic_box(self):
        """On the rim of a wall longer than the box, in closed form or as a patch, near an end of its image: as in a box that is longer still."""
        ball = (3e-3 + 0.3 * R, -2.9e-3, 0.93 * R)
        reference = None
        for length, boundary, along in ((24e-3, "f f f", "-0.02 0.02"), (10.4e-3, "f p f", "-0.004 0.004"), (16e-3, "f p f", "-0.004 0.004")):
            start = prelude(ball, (0, 0.05, 0), boundary=boundary, box=f"-0.004 0.0045 {along} -0.005 0.02")
            plane = f"plane: {{origin: [-3e-3, {-length / 2}, 0], edges: [[6e-3, 0, 0], [0, {length}, 0]], elements: [3, 4], degree: 2}}"
            wall = {"wall.yaml": f"units: si\ngeometry:\n  {plane}\nsurfaces: {{wall: all}}\n"}
            for search in ("", "search simplex_brent"):
                with self.subTest(length=length, search=search):
                    seen = run(start, nurbs(search), wall, steps=2000).table
                    reference = reference or seen
                    self.assertGreater(reference["fx"].max(), 0.1 * reference["fz"].max(), "the rim pushes sideways")
                    self.same(seen, reference)

    def test_a_groove_along_a_periodic_box(self):
        """A heavy ball rolls in a groove, on both its lips, past the ends of the wall and its images, as in one without end."""
        half, velocity = 0.6 * R, (0.0, 3.0, 0.0)
        start = (0.0, 0.0, 0.797 * R)

        def patches(length: float) -> dict[str, str]:
            sides = (quad((x, -length / 2, 0), (5e-3, 0, 0), (0, length, 0), (3, 4)) for x in (-half - 5e-3, half))
            return {"wall.yaml": model_file(*sides)["wall.yaml"]}

        def cylinder(length: float) -> dict[str, str]:
            pipe = f"origin: [0, {-length / 2!r}, 0], axis: [0, 1, 0], radius: {half!r}, length: {length!r}"
            shape = f"geometry:\n  cylinder: {{{pipe}, reference: [1, 0, 0], angle: [0, 180], elements: [2, 5]}}\n"
            return {"wall.yaml": "units: si\n" + shape + "surfaces: {wall: all}\n"}

        def triangles(length: float) -> dict[str, str]:
            return {"wall.stl": square(-half - 5e-3, -half, length / 2) + square(half, half + 5e-3, length / 2)}

        for geometry, search in ((patches, ""), (patches, "search simplex_brent"), (cylinder, ""), (triangles, "")):
            wall = nurbs(search) + "fix g all gravity 981 vector 0 0 -1\n"
            if geometry is triangles:
                wall = wall.replace("wall.yaml surface wall", "wall.stl surface all")
            large = prelude(start, velocity, gravity=False, box="-0.02 0.02 -0.02 0.02 -0.005 0.02")
            endless = run(large, wall, geometry(0.04), more=" v_n", steps=2500).table
            self.assertEqual(endless["n"].min(), 2.0)
            self.assertGreater(np.ptp(endless["y"]), 0.008)
            small = prelude(start, velocity, gravity=False, boundary="f p f", box="-0.02 0.02 -0.004 0.004 -0.005 0.02")
            for length in (0.008, 0.0104, 0.016):
                with self.subTest(geometry.__name__, search=search, length=length):
                    ours = run(small, wall, geometry(length), more=" v_n", steps=2500).table
                    ours["y"] = np.unwrap(ours["y"], period=0.008)
                    np.testing.assert_array_equal(ours["n"], endless["n"])
                    self.same(ours, endless)

    def test_a_periodic_box_that_grows(self):
        """A floor as long as the box ends where that grows: a ball at the seam then lies between two edges, a radius apart."""
        y, apart = "-0.004 0.004 -0.005 0.02", 1e-3
        start = prelude((3.999e-3, 2e-4, 0.999 * R), (0, 0, 0), gravity=False, boundary="p f f", box=f"-0.004 0.004 {y}")
        wall = model_file(quad((-4e-3, -4e-3, 0), (8e-3, 0, 0), (0, 8e-3, 0), (3, 3)))
        rate = apart / 8e-3 / (40000 * 1e-6)
        grows = f"fix down all gravity 9.81 vector 0 0 -1\ntimestep 1e-6\nfix grow all deform 1 x erate {rate!r}\n"
        for ranks in (1, 2):
            seen = run(start, nurbs() + grows, wall, steps=40000, every=400, ranks=ranks).table
            aside = np.minimum(seen["x"][-1] - 4e-3, 5e-3 - seen["x"][-1])
            self.assertGreater(aside, 0.3e-3, "it is over the gap")
            self.assertAlmostEqual(seen["z"][-1] / np.sqrt(R**2 - aside**2), 1, delta=0.01)

    def test_clump_of_spheres(self):
        """fix multisphere: a dumbbell tumbles on the floor."""
        clump = """
fix sphere all particletemplate/multisphere 15485863 atom_type 1 density constant 2500 nspheres 2 ntry 100000 &
    spheres -0.0006 0 0 0.001 0.0006 0 0.001 0.0008 type 1
fix mixture all particledistribution/discrete 15485867 1 sphere 1.0
region above block -0.003 0.003 -0.003 0.003 0.003 0.008 units box
fix insert all insert/pack seed 32452843 distributiontemplate mixture maxattempt 200 insert_every once overlapcheck yes &
    all_in yes vel constant 0.3 0.1 -0.5 region above particles_in_region 1
fix clump all multisphere
run 1
"""
        start = settings().text() + GRAVITY
        output = OUTPUT + "variable other equal z[2]\n" + table(6000, more=" v_other")
        ours = decks.good(start + nurbs() + clump + output, files=model_file(floor())).tables[-1]
        stock = decks.good(start + planes("zplane") + clump + output, program=decks.STOCK).tables[-1]
        self.assertGreater(stock["vz"].max(), 0.02, "it hits the floor and comes back")
        self.assertGreater(np.ptp(stock["other"] - stock["z"]), 1e-4, "it tumbles")
        self.same(ours, stock)
        self.assertLessEqual(decks.largest_difference(ours["other"], stock["other"]), SAME)

    def test_rigid_body_on_a_solid(self):
        """fix rigid: 145 spheres as one body touch a plate with one of them, whose damping is that of all the mass: no timestep is refused."""
        places = [(2 * R * (i - 2.5), 2 * R * (j - 2.5), 6 * R + 2 * R * k) for i in range(6) for j in range(6) for k in range(4)]
        deck = Prelude("-0.06 0.06 -0.06 0.06 -0.02 0.05", E=(5e6,), nu=(0.3,), e=0.3, timestep=2e-5).text()
        deck += create((0, 0, 1.2 * R), *places) + f"set group all diameter {2 * R} density 2500\nvelocity all set 0 0 -0.5\n"
        deck += "neigh_modify exclude group all all\nfix body all rigid single\n"
        plate = "units: si\ngeometry:\n  box: {origin: [-0.05, -0.05, -0.01], size: [0.1, 0.1, 0.01], elements: [4, 4, 1], degree: 2}\n"
        plate += "material: {law: linear_elastic, youngs_modulus: 5e6, poissons_ratio: 0.3, density: 2500}\n"
        plate += "boundary: [{fix: [x, y, z], faces: [xi-, xi+]}]\nsurfaces: {top: zeta+}\n"
        deck += "fix wall all wall/nurbs model hertz tangential history type 1 structure plate.yaml surface top\n"
        deck += "variable push equal f_wall[3]\nthermo_style custom step v_push\nthermo 10\nrun 200\n"
        done = decks.run(deck, files={"plate.yaml": plate})
        self.assertEqual(done.code, 0, done.text[-1500:])
        self.assertLess(done.table["push"].min(), 0.0, "it touches")

    def test_surface_right_behind_the_models(self):
        """There stands LIGGGHTS' `surface default`, too; a name is the wall's."""
        start, wall = prelude((0.0, 0.0, 0.99 * R), (0.1, 0.0, -0.1)), model_file(floor())
        usual = f"fix wall all wall/nurbs {MODELS} type 2 geometry wall.yaml surface wall\n"
        for words in ("surface wall type 2 geometry wall.yaml", "surface default surface wall type 2 geometry wall.yaml"):
            other = f"fix wall all wall/nurbs {MODELS} {words}\n"
            self.assertEqual(difference(run(start, other, wall, steps=100).table, run(start, usual, wall, steps=100).table), 0.0)

    def test_several_walls_of_all_kinds_together(self):
        """Two NURBS walls, a plane and a mesh of LIGGGHTS: a ball meets all four; beside planes and the same mesh."""
        start = prelude((3e-3, 2.2e-3, 1.5 * R), (-1.5, -1.0, -0.4), e=0.9)
        lid = square(-0.01, 0.03, 0.02).replace(" 0\n", " 0.0027\n")  # of a wedge of 2.7 mm
        others = mesh_wall("lid.stl") + f"fix plane all wall/gran {MODELS} primitive type 2 yplane 0.0\n"
        ours = run(
            start,
            PATCH.format(id="floor", file="floor", more="") + PATCH.format(id="side", file="side", more="")
            + "variable n equal f_floor[7]+10*f_side[7]\n" + others,
            {"floor.yaml": model_file(floor())["wall.yaml"], "side.yaml": model_file(side())["wall.yaml"], "lid.stl": lid},
            steps=6000, more=" v_n",
        ).table
        stock = run(start, planes("zplane", "xplane") + others, {"lid.stl": lid}, steps=6000, program=decks.STOCK).table
        met = set(ours["n"].astype(int))
        self.assertTrue({1, 10} & met and max(met) >= 10, f"floor and side are met: {met}")
        self.assertLess(stock["vy"].min() * stock["vy"].max(), 0.0, "the plane is met")
        self.same(ours, stock)

    def test_group(self):
        """Only particles of the group feel the wall: ball 1 does, ball 2 falls through."""
        start = prelude((0, 0, 1.2 * R), (0.1, 0.05, -0.3))
        start = start.replace("set group", f"create_atoms 1 single 0.005 0 {1.2 * R!r} units box\nset group", 1)
        start += "group felt id 1\nvariable other equal z[2]\n"
        results = []
        for program, wall in ((decks.NURBS, nurbs()), (decks.STOCK, planes("zplane"))):
            results.append(
                run(start, wall.replace(" all wall", " felt wall"), model_file(floor()), more=" v_other", program=program, steps=3000).table
            )
        ours, stock = results
        self.assertLess(stock["other"][-1], 0.0, "ball 2 is below the wall")
        self.same(ours, stock)
        self.assertLessEqual(decks.largest_difference(ours["other"], stock["other"]), SAME)

    def test_stored_force_of_two_contacts(self):
        """store_force in the corner of one wall: the sum of both contacts, as two of LIGGGHTS' walls store them."""
        start = prelude((0.99 * R, 0, 0.995 * R), (-0.1, 0.3, -0.2))
        corner = model_file(floor(), side())
        stored = "".join(f"compute s{k} all reduce sum f_force_wall[{k}]\n" for k in (1, 2, 3))
        ours = run(start, nurbs("store_force yes") + stored, corner, more=" v_n c_s1 c_s2 c_s3 f_wall[1] f_wall[2] f_wall[3]").table
        twice = "".join(
            f"compute a{k} all reduce sum f_force_wall0[{k}]\ncompute b{k} all reduce sum f_force_wall1[{k}]\n"
            f"variable s{k} equal c_a{k}+c_b{k}\n"
            for k in (1, 2, 3)
        )
        walls = planes("zplane", "xplane").replace(" 0.0\n", " 0.0 store_force yes\n")
        stock = run(start, walls + twice, program=decks.STOCK, more=" v_s1 v_s2 v_s3").table
        self.assertEqual(ours["n"].max(), 2.0)
        for k in (1, 2, 3):
            with self.subTest(component=k):
                self.assertLessEqual(decks.largest_difference(ours[f"s{k}"], stock[f"s{k}"]), SAME)
                self.assertLessEqual(decks.largest_difference(ours[f"s{k}"], -ours[f"wall[{k}]"]), 1e-15)

    def test_heat(self):
        """A warm wall heats the ball that rests on it, as LIGGGHTS' plane does."""
        heat = """
fix h1 all property/global thermalConductivity peratomtype 100. 100.
fix h2 all property/global thermalCapacity peratomtype 10. 10.
fix heat all heat/gran initial_temperature 300.
"""
        start = prelude((0, 0, 0.98 * R), (0.1, 0, 0)) + heat
        output = "compute T all reduce max f_Temp\ncompute q all reduce max f_heatFlux\n"
        ours = run(start, nurbs("temperature 400.") + output, model_file(floor()), more=" c_T c_q").table
        walls = planes("zplane").replace(" 0.0\n", " 0.0 temperature 400.\n")
        stock = run(start, walls + output, program=decks.STOCK, more=" c_T c_q").table
        self.assertGreater(stock["T"][-1], 300.1, "the ball warms up")
        for column in ("T", "q"):
            self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), SAME)
        self.same(ours, stock)


if __name__ == "__main__":
    unittest.main()

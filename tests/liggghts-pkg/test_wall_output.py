# SPDX-License-Identifier: GPL-2.0-or-later
"""`output` of fix wall/nurbs: the fields' integrals are the wall's forces, wear is that of LIGGGHTS' own mesh wall, and
the series survives restarts and does not depend on the number of ranks."""

import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
import vtu
from prelude import INTEGRATION, Prelude
from test_first_touch import about

ELEMENTS, SIDE = 8, 0.008
FLOOR = f"""
units: si
geometry:
  plane: {{origin: [{-SIDE / 2}, {-SIDE / 2}, 0], edges: [[{SIDE}, 0, 0], [0, {SIDE}, 0]],
    elements: [{ELEMENTS}, {ELEMENTS}], degree: 2}}
surfaces: {{floor: all}}
"""
ELEMENT_AREA = (SIDE / ELEMENTS) ** 2
MODELS = "model hertz tangential history"

START = Prelude(
    "-0.005 0.005 -0.005 0.005 -0.001 0.006", E=(1e8, 1e8), nu=(0.3, 0.3), e=0.7, mu=0.3, models=MODELS, timestep=1e-6,
    further={"k_finnie": (1e-10, 2e-10, 2e-10, 4e-10)}, particles="hard",
)
# Balls apart from each other that fall on the floor one after the other, at an angle.
BALLS = START.text() + "".join(
    f"create_atoms 1 single {-0.003 + 0.0015 * (k % 5)} {-0.003 + 0.0015 * (k // 5)} {0.0005 + 7e-6 * k} units box\n"
    for k in range(20)
) + """
set group all diameter 0.001 density 2480
velocity all set 0.4 0.3 -0.5 units box
""" + INTEGRATION
ONE_BALL = START.text() + """\
create_atoms 1 single 0.0013 -0.0015 0.00101 units box
set group all diameter 0.002 density 2480
set atom 1 vx {vx} vy 0.5 vz {vz}
""" + INTEGRATION
THERMO = """
thermo_style custom step f_wall[1] f_wall[2] f_wall[3] f_wall[7]
thermo_modify format float %.17g lost error
thermo {every}
"""
STL = """solid plane
facet normal 0 0 1
outer loop
vertex -0.004 -0.004 0
vertex 0.004 -0.004 0
vertex 0.004 0.004 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex -0.004 -0.004 0
vertex 0.004 0.004 0
vertex -0.004 0.004 0
endloop
endfacet
endsolid plane
"""


def wall(folder: str, every: int, words: str = "") -> str:
    return (
        f"fix wall all wall/nurbs {MODELS} type 2 geometry floor.yaml surface floor "
        f"output {folder}/floor every {every} {words}\n"
    )


class WallOutput(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_deck(self, deck: str, **options) -> decks.Run:
        return decks.good(deck, files={"floor.yaml": FLOOR, "plane.stl": STL}, **options)

    def state(self, step: int) -> vtu.State:
        return vtu.read(Path(self.folder) / f"floor_{step}.vtu")

    def total(self, step: int, name: str) -> np.ndarray:
        return self.state(step).integral_on_parallelograms(name, ELEMENT_AREA)

    def test_integrals_of_one_step_are_the_forces_on_the_wall(self):
        """sum_A area_A p_A = total normal force, likewise shear; contacts are counted."""
        table = self.run_deck(BALLS + wall(self.folder, 20, "average no") + THERMO.format(every=20) + "run 200\n").table
        self.assertGreater(max(table["wall[7]"]), 3)
        for k, step in enumerate(table["Step"].astype(int)):
            scale = 1e-12 * max(1.0, np.abs(table["wall[3]"]).max())
            np.testing.assert_allclose(self.total(step, "pressure"), -table["wall[3]"][k], rtol=1e-12, atol=scale)
            np.testing.assert_allclose(
                self.total(step, "shear"), [table["wall[1]"][k], table["wall[2]"][k], 0.0], rtol=1e-11, atol=scale
            )
            self.assertEqual(self.state(step).elements["contact_count"].sum(), table["wall[7]"][k])

    def test_fields_are_means_over_the_interval(self):
        deck = BALLS + wall(self.folder, 50) + THERMO.format(every=1) + "run 120\nrun 80\n"
        first, second = self.run_deck(deck).tables
        # the set-up of the second run evaluates the forces of step 120 once more: they count once
        force, contacts = (
            np.concatenate([first[name], second[name][1:]]) for name in ("wall[3]", "wall[7]")
        )
        for step in (50, 100, 150, 200):
            steps = slice(step - 49, step + 1)
            np.testing.assert_allclose(self.total(step, "pressure"), -force[steps].mean(), rtol=1e-11)
            counted = self.state(step).elements["contact_count"].sum()
            np.testing.assert_allclose(counted, contacts[steps].mean(), rtol=1e-12)

    def test_the_series_lists_every_state(self):
        self.run_deck(BALLS + wall(self.folder, 50) + THERMO.format(every=50) + "run 100\n")
        listed = vtu.series(Path(self.folder) / "floor.pvd")
        self.assertEqual([path.name for path in listed.values()], ["floor_0.vtu", "floor_50.vtu", "floor_100.vtu"])
        np.testing.assert_allclose(list(listed), [0.0, 5e-5, 1e-4], rtol=1e-12)
        self.assertEqual(len(list(Path(self.folder).iterdir())), 4, "no unfinished file")

    def test_a_step_that_is_set_back_writes_over_nothing(self):
        series, first = Path(self.folder) / "floor.pvd", BALLS + wall(self.folder, 50, f"stl {self.folder}/floor every 50") + "run 100\n"
        for words, file in (("", "output"), (f"stl {self.folder}/other every 50", "stl")):
            line = wall(self.folder, 50, words)
            if file == "stl":
                line = re.sub("output .*every 50 stl", "stl", line)
            for ranks in (1, 2):
                run = decks.run(BALLS + line + "run 100\nreset_timestep 0\nrun 100\n", files={"floor.yaml": FLOOR}, ranks=ranks)
                self.assertNotEqual(run.code, 0)
                (error,) = run.errors
                self.assertRegex(error, rf"'{file} .*/\w+' has written step 100, a run begins at 0 .*reset_timestep")
        self.run_deck(first + "reset_timestep 100\nrun 50\nreset_timestep 1000\nrun 50\n")
        self.assertEqual([path.name for path in vtu.series(series).values()], [f"floor_{s}.vtu" for s in (0, 50, 100, 150, 1050)])

    def test_two_walls_do_not_share_a_series(self):
        for name, ranks in (("floor", 1), ("./floor", 1), ("floor", 2)):
            second = wall(self.folder, 50).replace("fix wall", "fix again").replace("/floor every", f"/{name} every")
            first = BALLS + wall(self.folder, 50)
            run = decks.run(first + second + "run 1\n", files={"floor.yaml": FLOOR}, ranks=ranks)
            self.assertNotEqual(run.code, 0)
            (error,) = run.errors
            self.assertRegex(error, r"id again.*floor.pvd is being written by fix wall, expected another name")
            self.run_deck(first + "unfix wall\n" + second + "run 1\n", ranks=ranks)

    def test_wear_is_that_of_a_stock_mesh(self):
        """Of a grazing and of a steep impact (LIGGGHTS has 0.33333 for 1/3 there): volume worn off."""
        for vx, vz, tolerance in ((1.0, -0.2, 1e-9), (0.1, -0.6, 2e-5)):
            with self.subTest(vx=vx, vz=vz):
                ball = ONE_BALL.format(vx=vx, vz=vz)
                self.run_deck(ball + wall(self.folder, 400, "fields wear") + THERMO.format(every=400) + "run 400\n")
                stock = f"""
fix mesh all mesh/surface/stress file plane.stl type 2 wear finnie
fix wall all wall/gran {MODELS} mesh n_meshes 1 meshes mesh
dump wear all mesh/vtk 400 {self.folder}/mesh*.vtk wear mesh
thermo 400
run 400
"""
                self.run_deck(ball + stock, program=decks.STOCK)
                lines = (Path(self.folder) / "mesh400.vtk").read_text().splitlines()
                wear = np.array(lines[lines.index("wear 1 2 double") + 1].split(), dtype=float)
                expected = (wear * SIDE**2 / 2).sum()
                self.assertGreater(expected, 0.0)
                np.testing.assert_allclose(self.total(400, "wear"), expected, rtol=tolerance)

    def test_triangles_have_the_fields_of_a_stock_mesh(self):
        """Pressure, shear and wear of each triangle of an STL file, which are values of its cell."""
        fields = "fields pressure shear contact_count wear average no"
        ours = BALLS + wall(self.folder, 50, fields).replace("floor.yaml surface floor", "plane.stl surface all")
        table = self.run_deck(ours + THERMO.format(every=50) + "run 200\n").table
        stock = f"""
fix mesh all mesh/surface/stress file plane.stl type 2 wear finnie
fix wall all wall/gran {MODELS} mesh n_meshes 1 meshes mesh
dump mesh all mesh/vtk 50 {self.folder}/mesh*.vtk stress wear mesh
thermo 50
run 200
"""
        self.run_deck(BALLS + stock, program=decks.STOCK)
        for k, step in enumerate((50, 100, 150, 200), 1):
            lines = (Path(self.folder) / f"mesh{step}.vtk").read_text().splitlines()
            starts = ("normal_stress_average", "shear_stress_average", "wear")
            pressure, shear, wear = (
                np.array(lines[lines.index(f"{name} 1 2 double") + 1].split(), dtype=float) for name in starts
            )
            state = self.state(step)
            # the file's first triangle is the one below the diagonal
            middles = np.array([state.points[cell].mean(axis=0) for cell in state.cells])
            order = np.argsort(middles[:, 1] - middles[:, 0])
            got = {name: values[order] for name, values in state.elements.items()}
            np.testing.assert_allclose(got["pressure"], pressure, rtol=1e-6, err_msg=str(step))
            np.testing.assert_allclose(np.linalg.norm(got["shear"], axis=1), shear, rtol=1e-6, err_msg=str(step))
            # LIGGGHTS has 0.33333 for 1/3
            np.testing.assert_allclose(got["wear"], wear, rtol=2e-5, err_msg=str(step))
            self.assertEqual(got["contact_count"].sum(), table["wall[7]"][k])
        self.assertGreater(wear.min(), 0.0)

    def test_fields_of_triangles_move_and_go_on_on_ranks_and_after_a_restart(self):
        triangles = wall(self.folder, 50, "fields pressure shear contact_count wear motion linear 0.1 0.2 0.01")
        triangles = triangles.replace("floor.yaml surface floor", "plane.stl surface all")
        restart = f"{self.folder}/half.restart"
        head = BALLS + triangles + THERMO.format(every=100)
        self.run_deck(head + f"run 120\nwrite_restart {restart}\nrun 80\n")
        one = self.state(200)
        np.testing.assert_allclose(one.points.min(axis=0), [-SIDE / 2 + 2e-5, -SIDE / 2 + 4e-5, 2e-6], atol=1e-15)
        self.run_deck(head + "run 120\nrun 80\n", ranks=2)
        two = self.state(200)
        self.run_deck(START.again(restart) + triangles + INTEGRATION + THERMO.format(every=100) + "run 80\n")
        again = self.state(200)
        self.assertGreater(one.elements["wear"].min(), 0.0)
        for other in (two, again):
            for name, expected in one.elements.items():
                scale = 1e-12 * np.abs(expected).max()
                np.testing.assert_allclose(other.elements[name], expected, rtol=1e-9, atol=scale, err_msg=name)

    def test_fields_are_the_same_on_two_ranks(self):
        fields = "fields pressure shear contact_count wear"
        deck = BALLS + wall(self.folder, 50, fields) + THERMO.format(every=50) + "run 200\n"
        self.run_deck(deck)
        one = self.state(200)
        self.run_deck(deck, ranks=2)
        two = self.state(200)
        for a, b in ((one.fields, two.fields), (one.elements, two.elements)):
            for name in a:
                scale = 1e-12 * np.abs(a[name]).max()
                np.testing.assert_allclose(a[name], b[name], rtol=1e-9, atol=scale, err_msg=name)
        self.assertGreater(one.fields["wear"].max(), 0.0)

    def test_a_restart_goes_on_with_wear_means_and_series(self):
        fields = "fields pressure contact_count wear"
        restart = f"{self.folder}/half.restart"
        head = BALLS + wall(self.folder, 50, fields) + THERMO.format(every=100)
        # in the midst of an interval; the states of the first attempt to go on are written again
        self.run_deck(head + f"run 120\nwrite_restart {restart}\nrun 80\n")
        whole = self.state(200)
        self.run_deck(
            START.again(restart) + wall(self.folder, 50, fields) + INTEGRATION + THERMO.format(every=100) + "run 80\n"
        )
        again = self.state(200)
        for name in ("pressure", "wear"):
            np.testing.assert_allclose(again.fields[name], whole.fields[name], rtol=1e-12, err_msg=name)
        np.testing.assert_array_equal(again.elements["contact_count"], whole.elements["contact_count"])
        series = vtu.series(Path(self.folder) / "floor.pvd")
        self.assertEqual([path.name for path in series.values()], [f"floor_{s}.vtu" for s in (0, 50, 100, 150, 200)])
        # LIGGGHTS' own time begins again at 0
        np.testing.assert_allclose(list(series), 1e-6 * np.array([0, 50, 100, 150, 200]), rtol=1e-12)

    def test_the_first_state_has_the_forces_of_set_up_and_no_wear(self):
        touching = ONE_BALL.format(vx=1.0, vz=-0.2).replace("0.00101 units", "0.00099 units")
        fields = "fields pressure contact_count wear"
        deck = touching + wall(self.folder, 50, fields) + THERMO.format(every=1) + "run 10\n"
        table = self.run_deck(deck).table
        self.assertGreater(-table["wall[3]"][0], 0.0)
        np.testing.assert_allclose(self.total(0, "pressure"), -table["wall[3]"][0], rtol=1e-12)
        self.assertEqual(self.state(0).elements["contact_count"].sum(), 1)
        self.assertEqual(self.total(0, "wear"), 0.0)

    def test_a_deforming_wall_is_written_where_it_is(self):
        """The centre of the top moves as the probe there does."""
        deck = (
            bob.prelude() + bob.wall(rest=f"structure block.yaml surface top output {self.folder}/floor every 200")
            + bob.output(columns=(18, 19, 20), every=200) + "run 200\n"
        )
        table = decks.good(deck, files={"block.yaml": bob.block()}).table
        before, after = self.state(0), self.state(200)
        # a corner of four elements, so a point of the surface
        centre = np.argmin(np.linalg.norm(before.points, axis=1))
        moved = after.points[centre] - before.points[centre]
        probe = [table[f"plate{c}"][-1] for c in (18, 19, 20)]
        self.assertLess(moved[2], -1e-8)
        np.testing.assert_allclose(moved, probe, rtol=1e-9, atol=1e-15)
        self.assertGreater(after.fields["pressure"].max(), 0.0)

    def test_a_turning_wall_is_written_where_it_is(self):
        """A floor that turns nearly in its plane: its points, what presses on it and the shear turn with it."""
        turn = "motion rotate origin 0 0 0 axis -0.01 0.005 1 period 1e-3"
        deck = BALLS + wall(self.folder, 100, f"average no {turn}") + THERMO.format(every=100) + "run 200\n"
        table = self.run_deck(deck).table
        start, after = self.state(0), self.state(100)
        rotation = about((-0.01, 0.005, 1), 2 * np.pi * 100e-6 / 1e-3)
        np.testing.assert_allclose(after.points, start.points @ rotation.T, atol=1e-15)
        k = list(table["Step"]).index(100)
        self.assertGreater(table["wall[7]"][k], 0)
        normal, force = rotation[:, 2], np.array([table[f"wall[{d}]"][k] for d in (1, 2, 3)])
        pressing = -force @ normal
        np.testing.assert_allclose(self.total(100, "pressure"), pressing, rtol=1e-12)
        np.testing.assert_allclose(self.total(100, "shear"), force + pressing * normal, rtol=1e-11, atol=1e-15)

    def test_wrong_output_ends_in_one_line(self):
        thermo = THERMO.format(every=50) + "run 50\n"
        no_constants = BALLS.replace("fix m5", "#")
        cases = {
            "cannot write '/no/such/folder/floor_0.vtu'": (BALLS, wall("/no/such/folder", 50)),
            "field wear needs Finnie's constants": (no_constants, wall(self.folder, 50, "fields wear")),
            "output every is '0', expected a number of steps, 1 or more": (BALLS, wall(self.folder, 0)),
            "twin is 'x', expected how many cells of two triangles": (BALLS, wall(self.folder, 5, "twin x")),
        }
        for message, (head, line) in cases.items():
            for ranks in (1, 2):
                with self.subTest(message=message, ranks=ranks):
                    run = decks.run(head + line + thermo, files={"floor.yaml": FLOOR}, ranks=ranks)
                    self.assertNotEqual(run.code, 0)
                    self.assertEqual(len(run.errors), 1, run.text[-2000:])
                    self.assertIn(message, run.errors[0])


if __name__ == "__main__":
    unittest.main()

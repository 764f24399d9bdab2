# SPDX-License-Identifier: GPL-2.0-or-later
"""`fix mesh/surface fix ID`: the triangle twin of a NURBS wall, made by LIGGGHTS itself in the same deck."""

import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

import decks
from prelude import Prelude
from test_wall_output import MODELS, START

RADIUS, LENGTH = 0.003, 0.006
CYLINDER = f"""
units: si
geometry:
  cylinder: {{origin: [0, {-LENGTH / 2}, 0.0025], axis: [0, 1, 0], radius: {RADIUS}, length: {LENGTH},
    elements: [8, 3]}}
surfaces: {{wall: all}}
"""
# large triangles: the ball stays off their edges, where stock walls hand contacts on from one to the next
FLOOR = """
units: si
geometry:
  plane: {origin: [-0.004, -0.004, 0], edges: [[0.008, 0, 0], [0, 0.008, 0]], elements: [2, 2], degree: 2}
surfaces: {floor: all}
"""
TWIN = f"""
fix twin all mesh/surface fix floor type 2
fix mesh all wall/gran {MODELS} mesh n_meshes 1 meshes twin
"""
BALL_FAR_AWAY = """
create_atoms 1 single 0 0 0.0025 units box
set group all diameter 0.0005 density 2480
fix integrate all nve/sphere
"""


def read_stl(path: Path) -> np.ndarray:
    """triangles x 3 corners x 3 coordinates"""
    corners = re.findall(r"vertex (\S+) (\S+) (\S+)", path.read_text())
    return np.array(corners, dtype=float).reshape(-1, 3, 3)


class Twin(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def twin_of_the_cylinder(self, words: str, ranks: int = 1) -> np.ndarray:
        deck = START.text() + BALL_FAR_AWAY + f"""
fix drum all wall/nurbs {MODELS} type 2 geometry drum.yaml surface wall {words}
fix twin all mesh/surface fix drum type 2
dump twin all mesh/stl 1 {self.folder}/twin*.stl twin
thermo_style custom step f_drum[1]
run 0
"""
        decks.good(deck, files={"drum.yaml": CYLINDER}, ranks=ranks)
        return read_stl(self.folder / "twin0.stl")

    def test_corners_lie_on_the_cylinder(self):
        triangles = self.twin_of_the_cylinder("twin 3")
        self.assertEqual(len(triangles), 2 * (8 * 3) * (3 * 3))
        distance = np.hypot(triangles[..., 0], triangles[..., 2] - 0.0025)
        np.testing.assert_allclose(distance, RADIUS, rtol=5e-6)  # the STL file has six digits
        self.assertEqual(triangles[..., 1].min(), -LENGTH / 2)
        self.assertEqual(triangles[..., 1].max(), LENGTH / 2)

    def test_area_is_that_of_chords(self):
        """One chord per element of 45 degrees: 2 n sin(pi/n) r l, n = 8.  The same on two ranks."""
        for ranks in (1, 2):
            triangles = self.twin_of_the_cylinder("twin 1", ranks)
            edges = triangles[:, 1:] - triangles[:, :1]
            area = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()
            np.testing.assert_allclose(area, 2 * 8 * np.sin(np.pi / 8) * RADIUS * LENGTH, rtol=1e-5)

    def test_a_wall_that_has_moved(self):
        """A quarter turn about a line beside the drum and a lift: the twin is where the wall is by then."""
        steps, dt, lift = 100, 1e-7, 0.0004
        turn = f"motion rotate origin 0.001 0 0 axis 0 0 1 period {4 * steps * dt!r}"
        deck = START.text() + BALL_FAR_AWAY + f"""
timestep {dt!r}
fix drum all wall/nurbs {MODELS} type 2 geometry drum.yaml surface wall twin 1 {turn} motion linear 0 0 {lift / steps / dt!r}
thermo_style custom step f_drum[1]
run {steps}
fix twin all mesh/surface fix drum type 2
dump twin all mesh/stl 1 {self.folder}/twin*.stl twin
run 0
"""
        decks.good(deck, files={"drum.yaml": CYLINDER})
        triangles = read_stl(self.folder / f"twin{steps}.stl")
        # (x, y) -> (0.001 - y, x - 0.001): the axis from (0, -+LENGTH/2) lies along x now, at y = -0.001
        distance = np.hypot(triangles[..., 1] + 0.001, triangles[..., 2] - 0.0025 - lift)
        np.testing.assert_allclose(distance, RADIUS, rtol=5e-6)
        np.testing.assert_allclose(triangles[..., 0].min(), 0.001 - LENGTH / 2, rtol=1e-5)
        np.testing.assert_allclose(triangles[..., 0].max(), 0.001 + LENGTH / 2, rtol=1e-5)

    def test_stl_files_follow_the_wall_within_a_chord(self):
        """A lifted drum: triangles with corners on it, none farther from it than the chord, as stock reads them."""
        steps, dt, lift, chord = 100, 1e-7, 0.0004, 2e-5
        deck = START.text() + BALL_FAR_AWAY + f"""
timestep {dt!r}
fix drum all wall/nurbs {MODELS} type 2 geometry drum.yaml surface wall stl {self.folder}/drum every 50 chord {chord!r} &
    motion linear 0 0 {lift / steps / dt!r}
thermo_style custom step f_drum[1]
run {steps}
fix stock all mesh/surface file {self.folder}/drum_100.stl type 2
dump stock all mesh/stl 1 {self.folder}/stock*.stl stock
run 0
"""
        for ranks in (1, 2):
            decks.good(deck, files={"drum.yaml": CYLINDER}, ranks=ranks)
            self.assertEqual(sorted(path.name for path in self.folder.glob("drum*")), ["drum_0.stl", "drum_100.stl", "drum_50.stl"])
            first, last, stock = (read_stl(self.folder / name) for name in ("drum_0.stl", "drum_100.stl", "stock100.stl"))
            axis = np.array([0.0, 0.0025 + lift])
            np.testing.assert_allclose(np.linalg.norm(last[..., ::2] - axis, axis=-1), RADIUS, rtol=1e-8)
            np.testing.assert_allclose(last - first, np.full_like(last, lift) * [0, 0, 1], atol=1e-11)
            middles = 0.5 * (last + np.roll(last, 1, axis=1))[..., ::2]
            sagitta = RADIUS - np.linalg.norm(middles - axis, axis=-1).min()
            self.assertTrue(0.4 * chord < sagitta < 1.01 * chord, sagitta)
            self.assertEqual(len(stock), len(last))
            self.assertLess(abs(stock.sum(axis=(0, 1)) - last.sum(axis=(0, 1))).max(), 1e-6)
            for path in self.folder.glob("*.stl"):
                path.unlink()

    def test_elements_are_cut_in_four_by_default(self):
        self.assertEqual(len(self.twin_of_the_cylinder("")), 2 * (8 * 2) * (3 * 2))

    def test_particles_are_inserted_at_a_twin_and_counted_at_another(self):
        """A stream from one face, through another 15 mm below it, which counts those that have passed."""
        start = Prelude(
            "-0.005 0.005 -0.005 0.005 -0.05 0.02", E=(1e8, 1e8), nu=(0.3, 0.3), models=MODELS, timestep=1e-5,
            lists="delay 0", particles="hard",
        )  # fmt: skip
        deck = start.text() + f"""
group nobody type 2
fix inlet nobody wall/nurbs {MODELS} type 2 geometry floor.yaml surface floor twin 1 move 0 0 0.015
fix in all mesh/surface/planar fix inlet type 2
unfix inlet
fix outlet nobody wall/nurbs {MODELS} type 2 geometry floor.yaml surface floor twin 1
fix out all mesh/surface fix outlet type 2
unfix outlet
fix ball all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 0.0004
fix balls all particledistribution/discrete 15485867 1 ball 1.0
fix stream all insert/stream seed 32452843 distributiontemplate balls nparticles 100 massrate 0.02 overlapcheck yes &
    all_in no vel constant 0 0 -5.0 insertion_face in extrude_length 0.004
fix count all massflow/mesh mesh out count once vec_side 0 0 -1
fix integrate all nve/sphere
variable passed atom "z < 0"
compute passed all reduce sum v_passed
compute low all reduce min z
compute high all reduce max z
thermo_style custom step atoms f_count[1] f_count[2] c_passed c_low c_high
thermo_modify format float %.17g lost error norm no
thermo 1
run 1
thermo 100
run 899
"""
        first, table = decks.good(deck, files={"floor.yaml": FLOOR}, ranks=2).tables
        self.assertTrue(0.015 < first["low"][-1] < first["high"][-1] < 0.0195, "inserted above the face")
        # LIGGGHTS counts up to a radius late
        counted = table["count[2]"]
        self.assertTrue(np.all(counted <= table["passed"]) and 0 < counted[-4] < 100, counted)
        self.assertTrue(counted[-1] == table["passed"][-1] == 100, (table["passed"], counted))
        np.testing.assert_allclose(table["count[1]"], counted * 2500 * 4 / 3 * np.pi * 0.0004**3, rtol=1e-12)

    def test_a_ball_on_a_flat_twin_moves_as_on_the_nurbs_wall(self):
        """The stock mesh wall acts on all particles, whatever its group: so the NURBS wall acts on none beside it."""
        nurbs, twin = (self.bounce(group, mesh) for group, mesh in (("all", ""), ("nobody", TWIN)))
        self.assertGreater(nurbs["floor[7]"].sum(), 20)
        self.assertEqual(twin["floor[7]"].sum(), 0)
        self.assertGreater(nurbs["vz"][-1], 0.0)
        for name in ("vx", "vy", "vz", "z", "wx", "wy"):
            with self.subTest(name=name):
                self.assertLess(decks.largest_difference(nurbs[name], twin[name]), 1e-10)

    def bounce(self, group: str, mesh: str) -> dict[str, np.ndarray]:
        deck = START.text() + f"""
create_atoms 1 single 0.0012 0.0027 0.00101 units box
set group all diameter 0.002 density 2480
velocity all set 0.2 0.1 -0.5 units box
group nobody type 2
fix floor {group} wall/nurbs {MODELS} type 2 geometry floor.yaml surface floor twin 1
{mesh}
fix integrate all nve/sphere
compute spin all property/atom omegax omegay omegaz
variable vx equal vx[1]
variable vy equal vy[1]
variable vz equal vz[1]
variable z equal z[1]
variable wx equal c_spin[1][1]
variable wy equal c_spin[1][2]
thermo_style custom step v_vx v_vy v_vz v_z v_wx v_wy f_floor[7]
thermo_modify format float %.17g lost error
thermo 1
run 200
"""
        return decks.good(deck, files={"floor.yaml": FLOOR}).table


if __name__ == "__main__":
    unittest.main()

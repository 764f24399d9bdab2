# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball whose centre is on the wall: its overlap is its radius, and the normal is the surface's own, to the side that the
contact came from, else out of a solid, else against the velocity.  No force is lost, and none is not a number."""

import math
import unittest
from dataclasses import replace

import numpy as np

import decks
from prelude import Prelude

RADIUS, E, NU = 0.001, 1e7, 0.3
E_STAR = E / (2.0 * (1.0 - NU**2))
HERTZ = 4.0 / 3.0 * E_STAR * RADIUS**2  # of an overlap of one radius

THROWN = """\
create_atoms 1 single {start[0]!r} {start[1]!r} {start[2]!r} units box
set group all diameter 0.002 density {density}
set atom 1 vx {velocity[0]!r} vy {velocity[1]!r} vz {velocity[2]!r}
fix wall all wall/nurbs model hertz tangential history type 2 {wall}
fix integrate all nve/sphere
variable fx equal fx[1]
variable fy equal fy[1]
variable fz equal fz[1]
thermo_style custom step v_fx v_fy v_fz f_wall[7] f_wall[8]
thermo_modify format float %.17g lost error
thermo 1
run 0
{then}
"""
START = Prelude("-0.05 0.05 -0.05 0.05 -0.05 0.05", E=(1e7, 1e7), nu=(0.3, 0.3), timestep=1e-9, skin=5e-4)
SURFACES = {
    "plane": "plane: {origin: [-0.02, -0.02, 0], edges: [[0.04, 0, 0], [0, 0.04, 0]], elements: [7, 7], degree: 2}",
    "tilted": "plane: {origin: [0, -0.02, 0], edges: [[0.03, 0, 0.04], [0, 0.04, 0]], elements: [6, 7], degree: 2}",
    "cylinder": "cylinder: {origin: [-0.015, 0, 0], axis: [1, 0, 0], radius: 0.006, length: 0.03, elements: [12, 5], degree: 2}",
    "sphere": "sphere: {centre: [0, 0, 0], radius: 0.006, elements: [8, 6], degree: 2}",
    "small_sphere": "sphere: {centre: [0, 0, 0], radius: 0.0009, elements: [8, 6], degree: 2}",
    "cone": "cone: {origin: [0, 0, 0.01], axis: [0, 0, -1], radii: [0, 0.01], length: 0.01, elements: [8, 3], degree: 2}",
}
BLOCK = "box: {origin: [-0.01, -0.01, -0.01], size: [0.02, 0.02, 0.01], elements: [3, 3, 2], degree: 2}"


def files(shape: str) -> dict[str, str]:
    return {
        "wall.yaml": f"units: si\ngeometry:\n  {SURFACES.get(shape, BLOCK)}\nsurfaces:\n"
        + ("  wall: all\n" if shape in SURFACES else "  wall: [zeta+, xi+, eta+]\n")
    }


SOLID = {
    "solid.yaml": f"units: si\ngeometry:\n  {BLOCK}\n"
    "material: {law: linear_elastic, youngs_modulus: 1e7, poissons_ratio: 0.3, density: 2500}\n"
    "boundary: [{fix: [x, y, z], faces: [zeta-]}]\nsurfaces: {wall: zeta+}\n"
}


def forces(shape: str, start, velocity=(0.0, 0.0, 0.0), then="", words="") -> np.ndarray:
    """Forces on the ball [N], a row for each `run 0`, and the number of contacts behind them."""
    wall = "structure solid.yaml surface wall" if shape == "solid" else "geometry wall.yaml surface wall"
    deck = START.text() + THROWN.format(density=2500, start=start, velocity=velocity, wall=f"{wall} {words}", then=then)
    table = decks.good(deck, files=SOLID if shape == "solid" else files(shape)).table
    return np.stack([table[name] for name in ("fx", "fy", "fz", "wall[7]", "wall[8]")], axis=1)


class CentreOnWall(unittest.TestCase):
    def check(self, row, direction, places=1e-6):
        """One contact, of the force of Hertz along the direction, whose overlap is the radius."""
        direction = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
        self.assertLess(np.max(np.abs(row[:3] / HERTZ - direction)), places, row)
        self.assertEqual(row[3], 1.0)
        self.assertLess(abs(row[4] / RADIUS - 1.0), 1e-8)

    def test_against_the_velocity(self):
        for down in (1.0, -1.0):
            self.check(forces("plane", (0.0012, 0.0023, 0.0), (0.1, 0.0, -0.5 * down))[0], (0, 0, down))
            x, z = 0.0123, 0.0164  # on the tilted plane
            self.check(forces("tilted", (x, 0.001, z), (0.4 * down, 0.0, -0.3 * down))[0], (-0.8 * down, 0, 0.6 * down))

    def test_side_of_its_branch(self):
        # in contact above (below) first; then put on the wall, whatever its velocity is
        for side in (1.0, -1.0):
            for vz in (0.0, 0.3, -0.3):
                rows = forces(
                    "plane", (0.0, 0.0, 0.00097 * side), then=f"set atom 1 z 0.0 x 0.00013 vz {vz}\nrun 0\nrun 0"
                )
                self.check(rows[1], (0, 0, side))
                self.check(rows[2], (0, 0, side))

    def test_side_after_it_was_crossed(self):
        # comes back to the wall from below, where it had been pushed from above
        move = "set atom 1 z {}\nrun 0\n"
        rows = forces("plane", (0.0, 0.0, 0.00097), then=move.format(-1e-5) + move.format(-0.0009) + move.format(0.0))
        self.check(rows[3], (0, 0, -1))

    def test_out_of_a_solid(self):
        for vz in (0.2, -0.2):
            self.check(forces("block", (0.001, 0.002, 0.0), (0.0, 0.0, vz))[0], (0, 0, 1))
            self.check(forces("solid", (0.001, 0.002, 0.0), (0.0, 0.0, vz), words="material independent compliance none")[0], (0, 0, 1))

    def test_edges_and_corners_of_a_solid(self):
        self.check(forces("block", (0.01, 0.0012, 0.0))[0], (1, 0, 1))
        self.check(forces("block", (0.01, 0.01, 0.0))[0], (1, 1, 1))
        self.check(forces("block", (0.0013, 0.01, 0.0))[0], (0, 1, 1))

    def test_curved_walls_and_poles(self):
        angle = 0.77
        outward = (0.0, math.cos(angle), math.sin(angle))
        start = tuple(0.006 * c for c in outward)
        self.check(forces("cylinder", start, tuple(-c for c in outward))[0], outward)
        self.check(forces("cylinder", start, outward)[0], tuple(-c for c in outward))
        for pole in (1.0, -1.0):
            self.check(forces("sphere", (0.0, 0.0, 0.006 * pole), (0.0, 0.0, -pole))[0], (0, 0, pole))
        self.check(forces("cone", (0.0, 0.0, 0.01), (0.0, 0.0, -1.0))[0], (0, 0, 1))

    def test_centre_of_curvature(self):
        # a ball as wide as its bowl, exactly in the middle: any direction is as good as another, one contact at least
        for words in ("", "rstar curvature"):
            row = forces("small_sphere", (0.0, 0.0, 0.0), words=words)[0]
            self.assertTrue(np.all(np.isfinite(row)), row)
            self.assertGreaterEqual(row[3], 1.0)
            self.assertLess(abs(row[4] - 0.0001), 1e-9)

    def test_effective_radius_on_the_surface_and_at_poles(self):
        # at the pole of a sphere as anywhere else on it
        aside = (0.006 + 0.9 * RADIUS) / math.sqrt(3.0)
        rows = [
            forces("sphere", start, words="rstar curvature")[0]
            for start in ((0.0, 0.0, 0.006 + 0.9 * RADIUS), (aside, aside, aside))
        ]
        self.assertLess(abs(np.linalg.norm(rows[0][:3]) / np.linalg.norm(rows[1][:3]) - 1.0), 1e-6)
        for start in ((0.0, 0.0, 0.006), (0.006, 0.0, 0.0)):
            row = forces("sphere", start, (-start[0], 0.0, -start[2]), words="rstar curvature")[0]
            self.assertTrue(np.all(np.isfinite(row)), row)
            self.assertGreater(np.linalg.norm(row[:3]), 0.1 * HERTZ)

    def test_contact_that_is_not_finite_stops_the_run(self):
        # the damping of a ball as heavy and stiff as that overflows
        start = replace(START, E=(1e300, 1e300), e=0.5, particles="hard")
        deck = start.text() + THROWN.format(
            density=1e300, start=(0.001, 0.002, 0.0005), velocity=(0, 0, -1),
            wall="geometry wall.yaml surface wall", then="",
        )
        result = decks.run(deck, files=files("plane"))
        self.assertNotEqual(result.code, 0)
        message = [line for line in result.errors if "not finite" in line]
        self.assertEqual(len(message), 1, result.text[-2000:])
        for part in ("Fix wall/nurbs (id wall)", "particle 1 ", "at step 0", "0.0005"):
            self.assertIn(part, message[0])


if __name__ == "__main__":
    unittest.main()

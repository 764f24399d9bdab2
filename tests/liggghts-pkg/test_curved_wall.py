# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid NURBS cylinder is LIGGGHTS' own cylinder: balls bounce and rub on it, outside and inside, as on the stock
primitive; and led round it at constant overlap a ball feels one and the same force."""

import math
import unittest

import numpy as np

import ball_on_block as bob
import decks

AXIS = (0.0, 0.0075)  # y and z of the cylinder's axis, which runs along x: azimuths count from y towards z
CYLINDER = """
units: si
geometry:
  cylinder: {{origin: [-0.015, 0, 0.0075], axis: [1, 0, 0], radius: {radius!r}, length: 0.03, elements: {elements},
    degree: {degree}}}
surfaces: {{wall: all}}
"""
MODELS = {
    "hertz": ("model hertz tangential no_history", 1.0, 0.0),
    "history": ("model hertz tangential history", 0.7, 0.3),
}
SIDES = {"outside": 1, "inside": -1}
SPIN = """
compute spin all property/atom omegax omegay omegaz
variable wx equal c_spin[1][1]
variable wy equal c_spin[1][2]
variable wz equal c_spin[1][3]
"""


def cylinder(radius: float, elements=(12, 5), degree=2) -> dict[str, str]:
    return {"cylinder.yaml": CYLINDER.format(radius=radius, elements=list(elements), degree=degree)}


def at(azimuth: float, distance: float, x: float = 0.0) -> tuple[float, float, float]:
    """The point at an azimuth [degree] and a distance from the cylinder's axis."""
    angle = math.radians(azimuth)
    return x, AXIS[0] + distance * math.cos(angle), AXIS[1] + distance * math.sin(angle)


def bounce(program: str, models: str, e: float, mu: float, side: int, azimuth: float) -> dict[str, np.ndarray]:
    """600 steps of a ball that meets the cylinder at an azimuth, with a velocity towards it and along it."""
    radius = 0.006
    angle = math.radians(azimuth)
    towards, along, round_axis = -side * 1.0, 0.4, 0.5
    velocity = (
        along,
        towards * math.cos(angle) - round_axis * math.sin(angle),
        towards * math.sin(angle) + round_axis * math.cos(angle),
    )
    # not a multiple of what the ball goes in a step: no step may find it just touching, where damping is singular
    start = at(azimuth, radius + side * (bob.RADIUS + 2.2e-7), x=1.3e-4)
    wall = {
        decks.STOCK: f"fix wall all wall/gran {models} primitive type 2 xcylinder {radius!r} {AXIS[0]!r} {AXIS[1]!r}\n",
        decks.NURBS: f"fix wall all wall/nurbs {models} type 2 geometry cylinder.yaml surface wall\n",
    }[program]
    deck = (
        bob.prelude(balls=(start,), velocity=velocity, restitution=e, friction=mu, timestep=5e-8, models=models)
        + wall
        + bob.output()
        + SPIN
        + "thermo_style custom step v_x v_y v_z v_vx v_vy v_vz v_fx v_fy v_fz v_wx v_wy v_wz ke\n"
        + "thermo_modify format float %.17g lost error\nrun 600\n"
    )
    return decks.good(deck, files=cylinder(radius), program=program).table


class CurvedWall(unittest.TestCase):
    def test_bounce_equals_stock_cylinder(self):
        for name, (models, e, mu) in MODELS.items():
            for side_name, side in SIDES.items():
                # somewhere, at the middle of an arc, at the joint of two arcs, and shortly before it
                for azimuth in (17.0, 135.0, 90.0, 269.9, 359.95):
                    stock = bounce(decks.STOCK, models, e, mu, side, azimuth)
                    ours = bounce(decks.NURBS, models, e, mu, side, azimuth)
                    force = np.hypot(stock["fy"], stock["fz"])
                    self.assertGreater(force.max(), 1.0)
                    self.assertEqual(force[-1], 0.0, "the ball has left again")
                    for column, reference in stock.items():
                        with self.subTest(models=name, side=side_name, azimuth=azimuth, column=column):
                            self.assertEqual(len(reference), 601)
                            # against the largest of its kind: a component may vanish
                            kind = [c for c in stock if c[:-1] == column[:-1]]
                            scale = max(abs(stock[c]).max() for c in kind) or 1.0
                            self.assertLessEqual(abs(ours[column] - reference).max() / scale, 1e-10)

    def test_constant_force_round_the_cylinder(self):
        radius, overlap = 10 * bob.RADIUS, 0.01 * bob.RADIUS
        e_star = 5e9 / (2 * (1 - 0.3**2))
        hertz = 4 / 3 * e_star * math.sqrt(bob.RADIUS) * overlap**1.5
        # all round, with the seam and the joints of the arcs, and just beside these
        azimuths = np.concatenate([np.arange(0, 360, 7.5), 90.0 * np.arange(1, 5) - 1e-6, [1e-6]])
        for side_name, side in SIDES.items():
            for elements, degree in (((4, 1), 2), ((12, 5), 2), ((60, 7), 3)):
                places = [at(a, radius + side * (bob.RADIUS - overlap), x=3e-5 * a - 5e-3) for a in azimuths]
                deck = (
                    bob.prelude(balls=places[:1], velocity=(0, 0, 0))
                    + "fix wall all wall/nurbs model hertz type 2 geometry cylinder.yaml surface wall\n"
                    + bob.output()
                    + "".join(f"set atom 1 x {x!r} y {y!r} z {z!r}\nrun 0\n" for x, y, z in places)
                )
                table = decks.good(deck, files=cylinder(radius, elements, degree)).table
                self.assertEqual(len(table["fx"]), len(azimuths))
                angle = np.radians(azimuths)
                normal = side * (table["fy"] * np.cos(angle) + table["fz"] * np.sin(angle))
                tangential = table["fy"] * np.sin(angle) - table["fz"] * np.cos(angle)
                with self.subTest(side=side_name, elements=elements, degree=degree):
                    self.assertLessEqual(abs(normal / hertz - 1).max(), 1e-10)
                    self.assertLessEqual(abs(tangential / hertz).max(), 1e-10)
                    self.assertLessEqual(abs(table["fx"] / hertz).max(), 1e-10)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""plastic/thornton: restitution over V/V_y in closed form, the energy lost, friction, and LIGGGHTS' own thornton_ning."""

import itertools
import math
import unittest

import numpy as np

import contact_deck
from contact_deck import PLASTIC, RADIUS, decks
import reference_ball as reference
import rubbing_balls as rubbing
import thornton

P_Y = 5e8
RATIOS = (0.5, 1.5, 5.0, 20.0, 100.0)  # V/V_y
PLANE = thornton.Material(contact_deck.effective_modulus(1, 2), RADIUS, P_Y)
BALL_MASS = contact_deck.mass(RADIUS)
WALL_RADIUS = 5e-3  # of a sphere


def tolerance(dt: float) -> float:
    """Velocity Verlet is of second order, also over the corners of the law."""
    return 1e-5 * (dt / 1e-8) ** 2


def on_wall(ratio, material=PLANE, *, dt=1e-8, **options) -> str:
    """A ball that hits a wall below it at V/V_y = `ratio`."""
    speed = ratio * material.yield_speed(BALL_MASS)
    options = {"yield_pressure": (P_Y, 1e30), "every": 1000} | options
    deck = contact_deck.ball_on_plane(f"model {PLASTIC}", velocity=(0.0, 0.0, -speed), dt=dt, **options)
    return deck + f"run {round(3e-5 / dt)}\n"


class Theory(unittest.TestCase):
    def test_closed_form_is_that_of_the_law(self):
        for ratio in RATIOS:
            with self.subTest(ratio=ratio):
                e = thornton.integrated_restitution(PLANE, BALL_MASS, ratio * PLANE.yield_speed(BALL_MASS))
                self.assertAlmostEqual(e, thornton.restitution(ratio), delta=1e-7)

    def test_yield_speed_of_a_sphere_on_a_plane(self):
        E, rho = PLANE.E, contact_deck.DENSITY
        expected = (math.pi / (2 * E)) ** 2 * math.sqrt(2 / (5 * rho)) * P_Y**2.5  # Thornton & Ning (1998)
        self.assertAlmostEqual(PLANE.yield_speed(BALL_MASS) / expected, 1.0, delta=1e-12)


class Restitution(unittest.TestCase):
    def check(self, cases: dict, **options):
        """cases: name -> (deck, V, V/V_y, dt); the decks run one after the other."""
        tables = contact_deck.run_each((deck for deck, _, _, _ in cases.values()), **options)
        for (name, (_, speed, ratio, dt)), table in zip(cases.items(), tables):
            with self.subTest(name):
                approach = table["vx2"] - table["vx1"] if "vx2" in table else table["vz1"]
                self.assertAlmostEqual(approach[0] / -speed, 1.0, delta=1e-12)
                self.assertAlmostEqual(approach[-1] / speed, thornton.restitution(ratio), delta=tolerance(dt))

    def test_plane(self):
        V_y = PLANE.yield_speed(BALL_MASS)
        self.check(
            {
                f"V/V_y {ratio}, dt {dt}": (on_wall(ratio, dt=dt), ratio * V_y, ratio, dt)
                for ratio, dt in itertools.product(RATIOS, (2e-8, 5e-9))
            }
        )

    def test_the_softer_material_yields(self):
        speed = 20.0 * PLANE.yield_speed(BALL_MASS)
        self.check(
            {
                str(pressures): (on_wall(20.0, yield_pressure=pressures), speed, 20.0, 1e-8)
                for pressures in ((P_Y, 2 * P_Y), (2 * P_Y, P_Y))
            }
        )

    def test_nurbs_walls(self):
        plane = "plane: {origin: [-0.004, -0.004, 0], edges: [[0.008, 0, 0], [0, 0.008, 0]], elements: [3, 3], degree: 2}"
        sphere = "sphere: {{centre: [0, 0, {}], radius: 0.005, latitude: {}, elements: [8, 4]}}"
        on_ball, in_bowl = (1 / (1 / RADIUS + side / WALL_RADIUS) for side in (1, -1))
        walls = (
            ("flat", plane, "", RADIUS),
            ("ball", sphere.format(-WALL_RADIUS, [0, 90]), "rstar curvature", on_ball),
            ("bowl", sphere.format(WALL_RADIUS, [-90, 0]), "rstar curvature", in_bowl),
        )
        files = {
            f"{name}.yaml": f"units: si\ngeometry:\n  {geometry}\nsurfaces: {{skin: all}}\n" for name, geometry, _, _ in walls
        }
        cases = {}
        for (name, _, words, r_star), ratio in itertools.product(walls, (0.5, 5.0, 100.0)):
            material = thornton.Material(PLANE.E, r_star, P_Y)
            deck = on_wall(ratio, material).replace(
                f"wall/gran model {PLASTIC} primitive type 2 zplane 0.",
                f"wall/nurbs model {PLASTIC} type 2 geometry {name}.yaml surface skin {words}",
            )
            cases[f"{name}, V/V_y {ratio}"] = (deck, ratio * material.yield_speed(BALL_MASS), ratio, 1e-8)
        self.check(cases, files=files)

    def test_two_unequal_balls(self):
        r, R = RADIUS, contact_deck.OTHER_RADIUS
        m, M = contact_deck.mass(r), contact_deck.mass(R)
        V_y = thornton.Material(PLANE.E, r * R / (r + R), P_Y).yield_speed(m * M / (m + M))
        cases = {}
        for ratio, pressures in itertools.product(RATIOS, ((P_Y, 3 * P_Y), (3 * P_Y, P_Y))):
            deck = contact_deck.two_balls(
                f"model {PLASTIC}", velocity=(ratio * V_y, 0.0, 0.0), yield_pressure=pressures, every=1000
            )
            cases[f"V/V_y {ratio}, {pressures}"] = (deck + "run 4000\n", ratio * V_y, ratio, 1e-8)
        self.check(cases)

    def test_damping_of_the_elastic_part_is_that_of_hertz(self):
        speed = PLANE.yield_speed(BALL_MASS)
        elastic, both = (decks.good(on_wall(ratio, restitution=0.7)).table["vz1"][-1] / speed for ratio in (0.5, 20.0))
        self.assertAlmostEqual(elastic / 0.5, 0.7, delta=1e-3)
        self.assertLess(both / 20.0, thornton.restitution(20.0) - 0.01)


class Energy(unittest.TestCase):
    def test_what_is_lost_is_the_area_of_the_loop(self):
        for ratio in (1.5, 20.0):
            table = decks.good(on_wall(ratio, every=1)).table
            z, F, v = table["z1"], table["fz1"], table["vz1"]
            lost = 0.5 * BALL_MASS * (v[0] ** 2 - v[-1] ** 2)
            area = -np.sum(0.5 * (F[1:] + F[:-1]) * np.diff(z))
            with self.subTest(ratio=ratio):
                self.assertGreater(lost, 0.05 * 0.5 * BALL_MASS * v[0] ** 2)
                self.assertAlmostEqual(area / lost, 1.0, delta=1e-6)

    def test_force_of_every_step(self):
        table = decks.good(on_wall(20.0, every=1)).table
        d = np.maximum(RADIUS - table["z1"], 0.0)
        expected = [PLANE.force(*pair) for pair in zip(d, np.maximum.accumulate(d))]
        np.testing.assert_allclose(table["fz1"], expected, rtol=1e-9, atol=1e-9 * max(expected))
        self.assertGreater(d[np.nonzero(table["fz1"])[0][-1]], 0.9 * PLANE.left_over(d.max()), "apart at d_p")


class PlasticContact(reference.Contact):
    """With plastic/thornton in place of the power law."""

    p_y = 2.5e6
    d_max = 0.0

    def forces(self, d, r_star, mass, v_n, v_t, shear):
        self.d_max = max(self.d_max, d)
        E = self.young / (2 * (1 - self.nu**2))
        G = self.young / (4 * (2 - self.nu) * (1 + self.nu))
        law = thornton.Material(E, r_star, self.p_y)
        F_n = law.force(d, self.d_max)
        a_max = math.sqrt(r_star * self.d_max)
        a = math.sqrt(r_star * d)
        if d < self.d_max:  # Hertz' radius, from the force: F = 4/3 E* a^3/r_p
            a = a_max * (F_n / law.force(self.d_max, self.d_max)) ** (1 / 3)
        stiffness = math.pi * self.p_y * r_star if d == self.d_max > law.yield_overlap else 2 * E * a
        zeta = -math.log(self.e) / math.hypot(math.log(self.e), math.pi)
        F_n -= 2 * zeta * math.sqrt(5 / 6 * stiffness * mass) * v_n
        k_t, bound = 8 * G * a, self.mu * abs(F_n)
        F_t = -k_t * shear
        size = np.linalg.norm(F_t)
        if size <= bound:
            return F_n, F_t - 2 * zeta * math.sqrt(5 / 6 * k_t * mass) * v_t, shear
        F_t *= bound / size
        return F_n, F_t, (-F_t / k_t if k_t > 0 else shear)


class Friction(unittest.TestCase):
    def test_contact_beside_the_formulas(self):
        ball = ((2e-4, -1e-4, rubbing.R + 2.7e-6), (0.05, 0.03, -1.0), (-20.0, 15.0, 40.0))
        for mu in (2.0, 0.2):
            contact = PlasticContact(mu=mu)
            models = f"model {PLASTIC} tangential history"
            wall = f"fix p all property/global yieldPressure peratomtype {contact.p_y!r} {2 * contact.p_y!r}\n"
            wall += f"fix wall all wall/gran {models} primitive type 2 zplane 0.0\n"
            ours = decks.good(rubbing.deck(wall, [ball], models=models, mu=mu) + "run 300\n").table
            expected = reference.trajectory(
                reference.plane(), contact, rubbing.R, rubbing.DENSITY, *ball, rubbing.DT, 300
            )
            self.assertEqual(expected["fz"][-1], 0.0, "it has left")
            law = thornton.Material(contact.young / (2 * (1 - contact.nu**2)), rubbing.R, contact.p_y)
            self.assertGreater(contact.d_max, 5 * law.yield_overlap)
            for kind in ("", "v", "w", "f", "t"):
                a = rubbing.vectors(ours, kind)
                b = np.array([expected[f"{kind}{c}"] for c in "xyz"]).T
                with self.subTest(mu=mu, kind=kind):
                    self.assertLess(abs(a - b).max(), 1e-9 * abs(b).max())


class Stock(unittest.TestCase):
    def test_loading_is_that_of_liggghts_own_law(self):
        """thornton_ning without surface energy sums up increments: the same while the overlap grows, to first order in
        the time step.  Unloading it does not flatten the surface, and rebounds 3 to 8 % slower than the theory."""
        ratio = math.pi * P_Y / (2 * PLANE.E)  # a_y/r, as p_y = 2 E* a_y/(pi r)
        more = f"fix s1 all property/global coefficientYieldRatio peratomtype {ratio!r} {ratio!r}\n"
        more += "fix s2 all property/global surfaceEnergy peratomtypepair 2 0 0 0 0\n"
        difference = []
        for dt in (1e-8, 1e-9):
            deck = on_wall(20.0, dt=dt, every=1)
            stock = deck.replace("fix wall", more + "fix wall").replace(PLASTIC, "thornton_ning")
            ours, theirs = (decks.good(text).table["fz1"] for text in (deck, stock))
            top = int(np.argmax(ours))
            difference.append(abs(ours - theirs)[:top].max() / ours[top])
        self.assertLess(difference[0], 3e-3)
        self.assertLess(difference[1], 0.15 * difference[0])


if __name__ == "__main__":
    unittest.main()

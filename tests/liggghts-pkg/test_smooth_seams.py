# SPDX-License-Identifier: GPL-2.0-or-later
"""`compliance corrected` where patches are welded, or one is to itself: a ball of steel that slides over the weld, beside the same block in
one patch."""

import functools
import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
from test_compliance import COLUMNS, CORRECTED, STEEL

FRICTIONLESS = "model hertz tangential no_history"
SIDE = 0.768e-3  # of each half [m]
IMPACT = 0.5 * 4.0 / 3.0 * np.pi * bob.RADIUS**3 * bob.DENSITY  # energy of 1 m/s
VELOCITY = (20.0, 5.0, -1.0)
SETTINGS = dict(ball=STEEL, wall=STEEL, models=FRICTIONLESS, timestep=2e-9, velocity=VELOCITY, balls=((-50e-6, 17e-6, bob.RADIUS),))


def box(low: float, width: float, elements: int, n: int, degree: int) -> str:
    return (f"{{origin: [{low}, {-SIDE / 2}, {-SIDE / 2}], size: [{width}, {SIDE}, {SIDE / 2}], elements: [{elements}, {n}, {n // 2}], "
            f"degree: {degree}}}")  # fmt: skip


def block(n: int, degree: int, patches: int) -> str:
    """The weld is at x = 0."""
    geometry = f"{{box: {box(-SIDE, 2 * SIDE, 2 * n, n, degree)}}}"
    if patches == 2:
        geometry = "{shapes: [" + ", ".join(f"{{box: {box(x, SIDE, n, n, degree)}}}" for x in (-SIDE, 0.0)) + "]}"
    held = ", ".join(f"{{patch: {p}, fix: [x, y, z], faces: [zeta-]}}" for p in range(patches))
    tops = ", ".join(f"{p} zeta+" for p in range(patches)) if patches == 2 else "zeta+"
    return f"""units: si
geometry: {geometry}
material: {{law: linear_elastic, youngs_modulus: {STEEL[0]}, poissons_ratio: {STEEL[1]}, density: 7850}}
boundary: [{held}]
surfaces: {{top: [{tops}]}}
probes: {{middle: {{patch: 0, face: zeta+, at: [0.5, 0.5]}}}}
"""


def model_of(patches: list[tuple[list[np.ndarray], np.ndarray]], degree: int) -> str:
    """Patches of knots and control points [xi][eta][zeta][3], held at zeta-; the surface is zeta+."""
    text = "".join(f"    - {{degrees: [{degree}, {degree}, {degree}], knots: {[k.tolist() for k in knots]}, "
                   f"control_points: {points.transpose(2, 1, 0, 3).reshape(-1, 3).tolist()}}}\n" for knots, points in patches)  # fmt: skip
    held = ", ".join(f"{{patch: {p}, fix: [x, y, z], faces: [zeta-]}}" for p in range(len(patches)))
    return f"""units: si
geometry:
  patches:
{text}material: {{law: linear_elastic, youngs_modulus: {STEEL[0]}, poissons_ratio: {STEEL[1]}, density: 7850}}
boundary: [{held}]
surfaces: {{top: [{", ".join(f"{p} zeta+" for p in range(len(patches)))}]}}
probes: {{middle: {{patch: 0, face: zeta+, at: [0.5, 0.5]}}}}
"""


def net(elements: tuple[int, int, int], degree: int) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Knots of a unit cube, and where its control points are, by directions."""
    knots = [np.r_[[0.0] * degree, np.linspace(0, 1, n + 1), [1.0] * degree] for n in elements]
    at = [np.array([k[i + 1 : i + 1 + degree].mean() for i in range(len(k) - degree - 1)]) for k in knots]
    return knots, list(np.meshgrid(*at, indexing="ij"))


def askew_block(n: int, degree: int, slope: float) -> str:
    """As block(n, degree, 2), but rows of control points come to the weld and leave it as in a V, each by `slope`."""
    knots, (X, Y, Z) = net((n, n, n // 2), degree)
    patches = []
    for left in (-1.0, 0.0):
        x, y = X + left, Y - 0.5
        away = np.abs(x) * (1.0 - np.abs(x))
        points = [x + 0.3 * slope * away * np.sin(2.0 * np.pi * y), y + slope * away * np.cos(np.pi * y) ** 2, 0.5 * (Z - 1.0)]
        patches.append((knots, SIDE * np.stack(points, axis=-1)))
    return model_of(patches, degree)


def three_patches(n: int, degree: int) -> str:
    """A hexagon of three rhombs that meet in its middle."""
    knots, (X, Y, Z) = net((n, n, n // 2), degree)
    ways = [np.array([np.cos(a), np.sin(a), 0.0]) for a in np.radians([0.0, 120.0, 240.0])]
    points = [SIDE * (X[..., None] * u + Y[..., None] * v + 0.5 * (Z - 1.0)[..., None] * [0.0, 0.0, 1.0]) for u, v in zip(ways, [*ways[1:], ways[0]])]
    return model_of([(knots, p) for p in points], degree)


TUBE = f"""units: si
geometry: {{tube: {{origin: [0, -0.0004, -1.6e-3], axis: [0, 1, 0], inner_radius: 1.2e-3, outer_radius: 1.6e-3, length: 0.8e-3, angle: [90, 450],
  elements: [104, 8, 4]}}}}
material: {{law: linear_elastic, youngs_modulus: {STEEL[0]}, poissons_ratio: {STEEL[1]}, density: 7850}}
surfaces: {{top: zeta+}}
probes: {{middle: {{face: zeta+, at: [0.5, 0.5]}}}}
"""


@functools.cache
def bounce(model: str, velocity=VELOCITY, start=(-50e-6, 17e-6)) -> dict[str, np.ndarray]:
    """Until nothing touches."""
    deck = bob.prelude(**SETTINGS | dict(velocity=velocity, balls=((*start, bob.RADIUS),))) + bob.wall(FRICTIONLESS, CORRECTED) + bob.output(COLUMNS)
    return decks.good(deck + f"run 2300\n", files={"block.yaml": model}, timeout=400).table


class Seams(unittest.TestCase):
    def assert_keeps_energy(self, table, most=1e-5):
        self.assertEqual(table["plate7"][-1], 0.0)
        self.assertEqual(table["plate7"].max(), 1.0)
        energy = table["KinEng"] + table["plate15"] + table["plate16"]
        print(f"energy: {(energy[-1] - energy[0]) / IMPACT:.2e} of the impact's")
        self.assertLess(abs(energy[-1] - energy[0]), most * IMPACT)

    def test_a_ball_that_slides_over_a_weld_feels_none(self):
        """Elements of 2.3 contact radii, and of 1.3: there forces are spread."""
        for n, degree, most in ((8, 2, 0.002), (8, 3, 0.002), (14, 2, 0.004)):
            with self.subTest(n=n, degree=degree):
                welded, one = (bounce(block(n, degree, patches)) for patches in (2, 1))
                place = welded["x"][welded["plate7"] > 0]
                self.assertLess(place.min(), -30e-6)
                self.assertGreater(place.max(), 30e-6)
                self.assert_keeps_energy(welded)
                force = welded["fz"].max() / one["fz"].max() - 1.0
                print(f"n {n}, degree {degree}: force {force:.2e}")
                self.assertLess(abs(force), most)

    def test_a_ball_on_the_border_of_elements_is_not_rocked(self):
        """Of one patch, beside which tables have slopes of their own; elements of 1.3 contact radii."""
        for place in (0.0, 1e-9, 1e-7):
            self.assert_keeps_energy(bounce(block(14, 2, 1), velocity=(0.0, 0.0, -1.0), start=(7e-6, place)), most=2e-8)

    def test_a_ball_on_a_weld_is_not_rocked(self):
        """Where elements are as small, of two patches; by as little as feet on a border could be taken for those on it."""
        for place in (1e-9, 1e-7):
            self.assert_keeps_energy(bounce(block(14, 2, 2), velocity=(0.0, 0.0, -1.0), start=(place, 7e-6)), most=5e-5)

    def test_a_ball_that_slides_over_a_weld_whose_rows_are_askew(self):
        """By 17 degrees in all: what is left of the kink is small."""
        for n, degree, most in ((8, 3, 1e-5), (14, 2, 1e-4)):
            with self.subTest(n=n, degree=degree):
                askew, one = bounce(askew_block(n, degree, 0.15)), bounce(block(n, degree, 1))
                self.assert_keeps_energy(askew, most)
                force = askew["fz"].max() / one["fz"].max() - 1.0
                print(f"askew, n {n}, degree {degree}: force {force:.2e}")
                self.assertLess(abs(force), 0.004)

    def test_a_kink_that_stays_is_told(self):
        """Where three patches meet, and on seams beside it; not elsewhere."""
        for place, is_told in (((20e-6, 10e-6), True), ((300e-6, 250e-6), False)):
            deck = bob.prelude(**SETTINGS | dict(velocity=(0.0, 0.0, -1.0), balls=((*place, bob.RADIUS),))) + bob.wall(FRICTIONLESS, CORRECTED)
            run = decks.good(deck + "run 300\n", files={"block.yaml": three_patches(8, 2)})
            self.assertEqual(run.text.count("the mesh kinks below the contact of particle 1 at"), 1 if is_told else 0)

    def test_where_three_patches_meet_small_elements_stop_the_run(self):
        """Four times as soft as others there, they leave no equilibrium, not even of a force that is spread."""
        deck = bob.prelude(**SETTINGS) + bob.wall(FRICTIONLESS, CORRECTED) + "run 2300\n"
        run = decks.run(deck, files={"block.yaml": three_patches(10, 2)}, timeout=300)
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], r"elements at .* too small for the contact of particle 1 .* use elements at least 1\.\d times as large there")

    def test_a_ball_on_the_seam_of_a_tube(self):
        """At its top, where its angle begins."""
        self.assert_keeps_energy(bounce(TUBE, velocity=(4.0, 2.0, -1.0), start=(-10e-6, 17e-6)))

    def test_elements_at_a_weld_turn_earlier(self):
        deck = bob.prelude(**SETTINGS | dict(velocity=(0.0, 0.0, -1.0), balls=((12e-6, 12e-6, bob.RADIUS),))) + bob.wall(FRICTIONLESS, CORRECTED)
        run = decks.run(deck + "run 1400\n", files={"block.yaml": block(16, 2, 2)})
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], r"elements at .* too small for the contact of particle 1 .* they turn below it \(0.41, "
                         r"expected at most 0.41\); use elements at least 1.1 times as large there, or 'compliance none'")  # fmt: skip


class Digits(unittest.TestCase):
    def test_same_on_1_2_and_4_ranks_and_after_a_restart(self):
        """A body in parts whose borders are at the weld, and along it."""
        model = block(14, 2, 2)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "contact"
            deck = bob.prelude(**SETTINGS) + bob.wall(FRICTIONLESS, CORRECTED) + bob.output(COLUMNS) + f"run 1200\nwrite_restart {path}\nrun 60\n"
            again = bob.prelude(restart=path, **SETTINGS) + bob.wall(FRICTIONLESS, CORRECTED) + bob.output(COLUMNS) + "run 60\n"
            last = decks.good(deck, files={"block.yaml": model}, timeout=300).tables[-1]
            self.assertEqual(last["plate7"].max(), 1)
            for ranks, processors in ((1, "1 1 1"), (2, "2 1 1"), (4, "2 2 1")):
                with self.subTest(ranks=ranks):
                    text = deck.replace("processors * * *", f"processors {processors}")
                    more = decks.good(text, files={"block.yaml": model}, ranks=ranks, timeout=300).tables[-1] if ranks > 1 else last
                    restarted = decks.good(again, files={"block.yaml": model}, ranks=ranks, timeout=300).table
                    for column in (c for c in last if c.startswith("plate")):
                        self.assertTrue((more[column] == last[column]).all(), column)
                        self.assertTrue((restarted[column] == last[column]).all(), f"{column} after a restart")


if __name__ == "__main__":
    unittest.main()

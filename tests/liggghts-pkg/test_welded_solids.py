# SPDX-License-Identifier: GPL-2.0-or-later
"""Balls on solids of several patches: four welded quarters are the tube of one patch that is closed, and until waves come round
the tube that is slit on the other side.  Ranks make no difference."""

import unittest

import numpy as np

import ball_on_block as bob
import decks

STEP = 1e-8
OUTER = 3e-3
TUBE = "tube: {{origin: [-3e-3, 0, 0], axis: [1, 0, 0], inner_radius: 2e-3, outer_radius: 3e-3, length: 6e-3, angle: [{}, {}], elements: [{}, 4, 1]}}"
REST = """material: {{law: saint_venant_kirchhoff, youngs_modulus: 5e9, poissons_ratio: 0.3, density: 1000}}
surfaces: {{outside: [{faces}]}}
weld: {weld}
"""


def quarters() -> str:
    """Angles count from y; the ball comes down on the joint at 90 degrees."""
    shapes = "\n".join("    - " + TUBE.format(90 * k, 90 * (k + 1), 4) for k in range(4))
    faces = ", ".join(f"{k} zeta+" for k in range(4))
    return f"units: si\ngeometry:\n  shapes:\n{shapes}\n" + REST.format(faces=faces, weld="yes")


def one_patch(weld: str) -> str:
    return f"units: si\ngeometry:\n  {TUBE.format(0, 360, 16)}\n" + REST.format(faces="zeta+", weld=weld)


def hit(model: str, *, steps: int, velocity=(0.3, 0.5, -2.0), ranks: int = 1, words: str = "") -> dict[str, np.ndarray]:
    models = "model hertz tangential history"
    deck = (
        bob.prelude(balls=((0.2e-3, -2e-6, OUTER + bob.RADIUS + 1e-8),), velocity=velocity, friction=0.3, models=models,
                    timestep=STEP)
        + bob.wall(models, f"structure tube.yaml surface outside {words}") + bob.output((1, 2, 3, 7, 16), every=10) + f"run {steps}\n"
    )  # fmt: skip
    return decks.good(deck, files={"tube.yaml": model}, ranks=ranks).table


class WeldedSolids(unittest.TestCase):
    def assert_close(self, found: dict[str, np.ndarray], expected: dict[str, np.ndarray], tolerance: float) -> None:
        for name in ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", "plate16"):
            scale = np.abs(expected[name]).max()
            self.assertLessEqual(np.abs(found[name] - expected[name]).max(), tolerance * scale, name)

    @classmethod
    def setUpClass(cls):
        cls.welded = hit(quarters(), steps=1200)

    def test_the_ball_crosses_a_joint(self):
        foot = self.welded["y"][self.welded["plate7"] > 0]
        self.assertLess(foot.min(), -1e-6)
        self.assertGreater(foot.max(), 1e-6)
        self.assertGreater(np.abs(self.welded["fz"]).max(), 1.0)

    def test_a_closed_tube_of_one_patch(self):
        self.assert_close(self.welded, hit(one_patch("yes"), steps=1200), 1e-9)

    def test_a_slit_tube_away_from_the_slit(self):
        welded, slit = (hit(model, steps=1200, words="compliance none") for model in (quarters(), one_patch("no")))
        early = slice(0, 10)  # 1 us: waves of 2,600 m/s run 2.6 mm, to the slit it is 4.7 mm
        self.assert_close({k: v[early] for k, v in welded.items()}, {k: v[early] for k, v in slit.items()}, 1e-6)
        self.assertGreater(np.abs(welded["plate16"] - slit["plate16"]).max(), 1e-3 * slit["plate16"].max(), "later it opens")

    def test_a_surface_of_two_materials_needs_to_be_told(self):
        other = "material: [{patches: [0, 1, 2], law: linear_elastic, youngs_modulus: 5e9, poissons_ratio: 0.3, density: 1000}, " \
                "{patches: [3], law: linear_elastic, youngs_modulus: 6e9, poissons_ratio: 0.3, density: 1000}]"
        lines = [other if line.startswith("material:") else line for line in quarters().splitlines()]
        files = {"tube.yaml": "\n".join(lines) + "\n"}
        wall = "structure tube.yaml surface outside"
        run = decks.run(bob.prelude() + bob.wall(rest=wall) + "run 1\n", files=files)
        self.assertNotEqual(run.code, 0)
        self.assertIn("the surface lies on 2 materials in 'tube.yaml' (Young's moduli 5e+09, 6e+09", " ".join(run.errors))
        run = decks.run(bob.prelude() + bob.wall(rest=f"{wall} material independent") + "run 1\n", files=files)
        self.assertEqual(run.code, 0, run.text)

    def test_a_surface_inside_the_body_is_refused(self):
        deck = bob.prelude() + bob.wall(rest="structure tube.yaml surface outside") + "run 1\n"
        for model, seam in (
            (quarters().replace("3 zeta+", "3 xi-"), "patch 3 xi-, which is inside the body: welded to patch 2 xi+"),
            (one_patch("yes").replace("[zeta+]", "[zeta+, xi+]"), "patch 0 xi+, which is inside the body: welded to patch 0 xi-"),
        ):
            run = decks.run(deck, files={"tube.yaml": model}, ranks=1)
            self.assertNotEqual(run.code, 0)
            self.assertIn(f"tube.yaml: surface 'outside' is on {seam}, expected faces that particles can reach", " ".join(run.errors))

    def test_what_is_hardly_meant_is_said_before_the_run(self):
        deck = bob.prelude() + bob.wall(rest="structure tube.yaml surface outside") + "run 1\n"

        def told(model: str) -> list[str]:
            text = decks.good(deck, files={"tube.yaml": model}, ranks=1).text
            return [line for line in text.split("Step")[0].splitlines() if "WARNING: Fix wall/nurbs (id plate): 'tube.yaml': " in line]

        self.assertEqual(told(quarters()), [])
        self.assertEqual(told(one_patch("no")), [])
        (crack,) = told(quarters().replace("[270, 360]", "[270, 359.99]"))
        self.assertRegex(crack, "the body has a crack: face '. xi.' is 3.93e-07 from face")

    def test_ranks(self):
        for ranks in (2,):
            found = hit(quarters(), steps=300, ranks=ranks)
            for name, values in found.items():
                if name not in ("CPU",):
                    self.assertTrue(np.array_equal(values, self.welded[name][: len(values)]), f"{name} on {ranks} ranks")


if __name__ == "__main__":
    unittest.main()

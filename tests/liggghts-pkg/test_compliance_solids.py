# SPDX-License-Identifier: GPL-2.0-or-later
"""Energy under `compliance corrected`: random impacts on a curved, distorted, graded solid, whose forces are compared with those
on twice and four times finer elements, too; and a ball that bounces 200 times, and 50, on bodies that are free to move."""

import unittest

import numpy as np
from scipy.interpolate import BSpline

import ball_on_block as bob
import decks

GLASS, STEEL = (74.6e9, 0.2285), (210.6e9, 0.286)
MODELS = "model hertz tangential no_history"
DT, STEPS = 6.25e-9, 1600
BALLS = 9
GAP = 1.5e-6  # at most [m]


class Solid:
    """About 16 x 16 x 4 mm, held at its base; its top is a hill of 20 mm radius, elements are 0.7 to 1.4 mm wide and skew."""

    SIZE, HEIGHT, ROUND = 16e-3, 4e-3, 20e-3

    def __init__(self, random: np.random.Generator):
        self.knots = [self.graded(16), self.graded(16)[::-1].max() - self.graded(16)[::-1], np.r_[0, 0, np.linspace(0, 1, 5), 1, 1]]
        greville = [0.5 * (k[1:-2] + k[2:-1]) for k in self.knots]
        X, Y, Z = (a.transpose(2, 1, 0) for a in np.meshgrid(*greville, indexing="ij"))  # [zeta][eta][xi]
        points = np.stack([self.SIZE * (X - 0.5), self.SIZE * (Y - 0.5), self.HEIGHT * (Z - 1.0)], axis=-1)
        points[..., 2] -= Z * (points[..., 0] ** 2 + points[..., 1] ** 2) / (2 * self.ROUND)
        inside = (slice(None), slice(2, -2), slice(2, -2))
        points[inside][..., :2] += 0.12e-3 * random.uniform(-1, 1, points[inside][..., :2].shape)
        points[(slice(1, -1), *inside[1:])][..., 2] += 0.1e-3 * random.uniform(-1, 1, points[(slice(1, -1), *inside[1:])].shape[:-1])
        self.points = points

    @staticmethod
    def graded(elements: int) -> np.ndarray:
        breaks = np.cumsum([0.0, *np.geomspace(0.7, 1.4, elements)])
        return np.r_[0, 0, breaks / breaks[-1], 1, 1]

    def top(self, xi: float, eta: float) -> tuple[np.ndarray, np.ndarray]:
        """A point of it, and the normal there."""
        along_xi = BSpline(self.knots[0], self.points[-1].transpose(1, 0, 2), 2)
        value, change = (BSpline(self.knots[1], along_xi(xi, nu), 2) for nu in (0, 1))
        normal = np.cross(change(eta), value(eta, 1))
        return value(eta), normal / np.linalg.norm(normal)

    def model(self, finer: int) -> str:
        return f"""units: si
geometry:
  patches:
    - degrees: [2, 2, 2]
      knots: {[k.tolist() for k in self.knots]}
      control_points: {self.points.reshape(-1, 3).tolist()}
  refine: {{divide: [{finer}, {finer}, {finer}]}}
material: {{law: linear_elastic, youngs_modulus: {GLASS[0]}, poissons_ratio: {GLASS[1]}, density: 2480}}
boundary: [{{fix: [x, y, z], faces: [zeta-]}}]
surfaces: {{top: zeta+}}
"""


class RandomImpacts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        random = np.random.default_rng(18)
        cls.solid = Solid(random)
        centres, cls.velocities = [], []
        for i in range(BALLS):
            place = (np.array(divmod(i, 3)) + 0.5 + random.uniform(-0.12, 0.12, 2)) / 3.0 * 0.76 + 0.12
            point, normal = cls.solid.top(*place)
            centres.append(point + (bob.RADIUS + random.uniform(0.0, GAP)) * normal)
            cls.velocities.append(-random.uniform(0.5, 1.5) * normal + random.uniform(-1.5, 1.5) * np.cross(normal, random.normal(size=3)))
        cls.centres = np.array(centres)

    def run_on(self, finer: int, words: str) -> tuple[np.ndarray, np.ndarray]:
        """Largest force on each ball [N], and the energy of all in each step [J]; at the end nothing touches."""
        deck = bob.prelude(balls=self.centres, models=MODELS, ball=GLASS, wall=GLASS, timestep=DT, velocity=(0, 0, 0))
        deck += "".join(f"set atom {n} vx {v[0]!r} vy {v[1]!r} vz {v[2]!r}\n" for n, v in enumerate(np.array(self.velocities).tolist(), 1))
        deck += bob.wall(MODELS, f"structure solid.yaml surface top compliance {words}")
        columns = [f"v_F{n}" for n in range(1, BALLS + 1)] + ["v_K", "v_U", "v_n", "ke"]
        deck += "".join(f"variable F{n} equal sqrt(fx[{n}]^2+fy[{n}]^2+fz[{n}]^2)\n" for n in range(1, BALLS + 1))
        deck += "variable K equal f_plate[15]\nvariable U equal f_plate[16]\nvariable n equal f_plate[7]\n"
        deck += f"thermo_style custom step {' '.join(columns)}\nthermo_modify format float %.17g norm no lost error\nthermo 2\nrun {STEPS}\n"
        table = decks.good(deck, files={"solid.yaml": self.solid.model(finer)}, timeout=500).tables[-1]
        self.assertEqual(table["n"][-1], 0.0)
        force = np.array([table[f"F{n}"].max() for n in range(1, BALLS + 1)])
        return force, table["KinEng"] + table["K"] + table["U"]

    def test_forces_are_those_on_twice_finer_elements_and_no_energy_comes(self):
        self.compare_with_finer(2)

    def test_forces_are_those_on_four_times_finer_elements_and_no_energy_comes(self):
        self.compare_with_finer(4)

    def compare_with_finer(self, times: int) -> None:
        coarse, energy = self.run_on(1, "corrected")
        fine, of_fine = self.run_on(times, "corrected")
        without = self.run_on(1, "none")[0]
        print("forces over those on finer elements:", (coarse / fine).round(4), "without:", (without / fine).round(4))
        for name, E, most in (("coarse", energy, 1e-7), ("fine", of_fine, 1e-6)):
            print(f"energy, {name}: at the end {E[-1] / E[0] - 1.0:.2e} more")
            self.assertLess(abs(E[-1] / E[0] - 1.0), most)
            self.assertLess(E[-1] / E[0] - 1.0, 1e-7)
        self.assertGreater(fine.min(), 1.0)
        self.assertLess(np.abs(coarse / fine - 1.0).max(), 0.01)
        self.assertGreater(np.abs(without / fine - 1.0).min(), 0.01)


class Edges(unittest.TestCase):
    """A ball that gives way by nothing flies past an edge of a free steel block and strikes it, 1 m/s down and 30 along: over the edge,
    or along it, where the foot stays on it.  Elements of the two faces are not alike. """

    def change_of_energy(self, along: tuple[float, float, float], start: float) -> float:
        """Beside that of an impact; `start`: where its centre is above the edge [degrees]."""
        block = bob.block(size=(1.2e-3, 1.2e-3, 0.9e-3), elements=(12, 6, 4), youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0, fixed=())
        block = block.replace("top: zeta+", "top: [zeta+, xi+]").replace("origin: [-0.0006,", "origin: [-0.0012,")
        down, away = np.radians(45.0), np.radians(start)
        centre = (bob.RADIUS + 2e-8) * np.array([np.cos(away), 0.0, np.sin(away)]) + [0.0, 0.03e-3, 0.0]
        velocity = 30.0 * np.array(along) - [np.cos(down), 0.0, np.sin(down)]
        models = "model hertz tangential no_history"
        deck = bob.prelude(balls=(tuple(centre.tolist()),), models=models, ball=(1e20, 0.2), wall=STEEL, timestep=1e-9, velocity=tuple(velocity.tolist()))
        deck += bob.wall(models, "structure block.yaml surface top compliance corrected") + bob.output((7, 15, 16), 10) + "run 3500\n"
        table = decks.good(deck, files={"block.yaml": block}, timeout=300).table
        touches = np.flatnonzero(table["plate7"] > 0)
        self.assertEqual(table["plate7"].max(), 1.0)
        self.assertLess(touches[-1] + 30, len(table["plate7"]))
        energy = table["KinEng"] + table["plate15"] + table["plate16"]
        change = (energy[touches[-1] + 30] - energy[0]) / (energy[0] / 901.0)
        print(f"{along}: over {np.degrees(np.arctan2(table['z'], table['x']))[touches[[0, -1]]]} degrees, energy {change:.2e}")
        return change

    def test_over_an_edge_no_energy_comes(self):
        self.assertLess(abs(self.change_of_energy((np.sqrt(0.5), 0.0, -np.sqrt(0.5)), 46.5)), 1e-7)

    def test_along_an_edge_no_energy_comes(self):
        self.assertLess(abs(self.change_of_energy((0.0, 1.0, 0.0), 45.0)), 1e-7)


class Bounces(unittest.TestCase):
    """A ball that gives way by nothing between a rigid lid and a steel block, which is 56 times as heavy as the ball, or lighter than
    it, and floats on springs that are soft beside the contact.  Both strike each other, and the block turns and vibrates."""

    GAP, EVERY = 5e-6, 20  # [m]
    PERIOD = 4e-5  # of the block on its springs [s]
    TOGETHER = 200  # energies: in the scheme that of a body that vibrates does, too, about its mean

    def run_on(self, scale: float, steps: int, dt: float) -> tuple[np.ndarray, int, float]:
        """Energy of all where nothing touches [J], how often the ball met the block, and the largest estimate of what the mesh takes."""
        size = scale * np.array([1.2e-3, 1.2e-3, 0.8e-3])
        ground = 7850.0 * size[2] * (2.0 * np.pi / self.PERIOD) ** 2  # [N/m^3]
        block = bob.block(size=tuple(size.tolist()), elements=(6, 6, 4), youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0, fixed=())
        block = block.replace("linear_elastic", "saint_venant_kirchhoff")  # it turns
        block += f"boundary: [{{name: ground, spring: {{stiffness: {ground!r}}}, faces: [zeta-]}}]\n"
        centre = (0.45e-4 * scale, 0.8e-4 * scale, bob.RADIUS + 0.2 * self.GAP)
        deck = bob.prelude(balls=(centre,), models=MODELS, ball=(1e20, 0.2), wall=STEEL, timestep=dt, velocity=(0, 0, -1))
        deck += f"fix lid all wall/gran {MODELS} primitive type 2 zplane {2 * bob.RADIUS + self.GAP!r}\n"
        deck += bob.wall(MODELS, "structure block.yaml surface top compliance corrected") + bob.output((7, 15, 16, 32), self.EVERY)
        table = decks.good(deck + f"run {steps}\n", files={"block.yaml": block}, timeout=500).table
        touches = table["plate7"] > 0
        energy = table["KinEng"] + table["plate15"] + table["plate16"]
        is_free = ~touches & (np.abs(table["fz"]) == 0.0)
        return energy[is_free], int(np.sum(touches[1:] & ~touches[:-1])), table["plate32"].max()

    def keep_the_energy(self, scale: float, steps: int, dt: float, least: float, at_least: int = 200) -> None:
        energy, bounces, missing = self.run_on(scale, steps, dt)
        change = energy / energy[0] - 1.0
        means = change[: len(change) // self.TOGETHER * self.TOGETHER].reshape(-1, self.TOGETHER).mean(axis=1)
        rise = (means - np.minimum.accumulate(means)).max()
        print(f"{bounces} bounces, estimate {missing:.3f}: energy {change.min():.2e} to {change.max():.2e}, at the end {change[-1]:.2e}, rise {rise:.2e}")
        self.assertGreaterEqual(bounces, at_least)
        self.assertGreater(missing, least)
        self.assertLess(np.abs(change).max(), 1e-4)
        self.assertLess(change.max(), 1e-5)
        self.assertLess(rise, 5e-6)

    def test_50_bounces_on_a_heavy_body_keep_the_energy(self):
        self.keep_the_energy(4.0, 150_000, 6e-9, 0.03, 50)

    def test_200_bounces_on_a_heavy_body_keep_the_energy(self):
        self.keep_the_energy(4.0, 800_000, 6e-9, 0.03)

    def test_200_bounces_on_a_light_body_keep_the_energy(self):
        self.keep_the_energy(1.0, 1_300_000, 5e-9, 0.1)


if __name__ == "__main__":
    unittest.main()

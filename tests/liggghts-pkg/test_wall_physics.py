# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid NURBS walls against closed forms: rest, incline, bowl, effective radius, impact, error of the time step."""

import math
import unittest
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

import decks
from prelude import Prelude, create

G = 9.81
DECK = """\
set group all diameter {diameter!r} density {density!r}
fix gravity all gravity {gravity!r} vector 0 0 -1
fix wall all wall/nurbs model hertz tangential history type 2 geometry wall.yaml surface wall {words}
fix integrate all nve/sphere
compute spin all property/atom omegax omegay omegaz
"""
OUTPUT = (
    """
variable overlap equal f_wall[8]
"""
    + decks.BALL
    + """\
thermo_style custom step v_x v_y v_z v_vx v_vy v_vz v_wx v_wy v_wz v_overlap
thermo_modify format float %.17g lost error
thermo {every}
run {steps}
"""
)


@dataclass
class Case:
    """A ball (or several) and a wall; SI.  `young` and `nu` of ball and wall."""

    wall: str  # the `geometry` of the wall's file
    radius: float
    at: list[tuple[float, float, float]]
    v: tuple[float, float, float] = (0.0, 0.0, 0.0)
    density: float = 2500.0
    young: tuple[float, float] = (1e8, 1e8)
    nu: tuple[float, float] = (0.3, 0.3)
    e: float = 0.3
    mu: float = 0.0
    gravity: float = G
    dt: float = 1e-5
    low: tuple[float, float, float] = (-0.6, -0.6, -0.6)
    high: tuple[float, float, float] = (0.6, 0.6, 0.6)
    steps: int = 0
    every: int = 10
    words: str = ""  # of the fix
    output: str = field(default=OUTPUT)

    @property
    def mass(self) -> float:
        return self.density * 4 / 3 * math.pi * self.radius**3

    @property
    def stiffness(self) -> float:
        """K of Hertz' F = K overlap^1.5 [N/m^1.5]."""
        modulus = 1 / sum((1 - nu**2) / E for E, nu in zip(self.young, self.nu))
        return 4 / 3 * modulus * math.sqrt(self.radius)

    def rest_overlap(self, force: float) -> float:
        return (force / self.stiffness) ** (2 / 3)

    def run(self) -> dict[str, np.ndarray]:
        """The thermo table, with the time of each row as t."""
        start = Prelude(
            " ".join(f"{a!r} {b!r}" for a, b in zip(self.low, self.high)), E=self.young, nu=self.nu, e=self.e, mu=self.mu,
            timestep=self.dt, skin=0.2 * self.radius, particles="hard",
        )
        words = vars(self) | dict(diameter=2 * self.radius)
        velocity = "set group all vx {!r} vy {!r} vz {!r}\n".format(*self.v)
        deck = start.text() + create(*self.at) + DECK.format(**words) + velocity + self.output.format(**words)
        file = f"units: si\ngeometry:\n  {self.wall}\nsurfaces: {{wall: all}}\n"
        table = decks.good(deck, files={"wall.yaml": file}).table
        return table | {"t": self.dt * table["Step"]}


def plane(tilt: float, half: float, elements=(7, 5)) -> str:
    """A square through the origin that falls towards +x by `tilt` [rad]."""
    a = np.array([math.cos(tilt), 0.0, -math.sin(tilt)]) * 2 * half
    b = np.array([0.0, 2 * half, 0.0])
    origin = -0.5 * (a + b)
    place = f"origin: {origin.tolist()}, edges: [{a.tolist()}, {b.tolist()}]"
    return f"plane: {{{place}, elements: {list(elements)}, degree: 2}}"


def frame(tilt: float) -> tuple[np.ndarray, np.ndarray]:
    """Downhill and normal of `plane`."""
    return np.array([math.cos(tilt), 0.0, -math.sin(tilt)]), np.array([math.sin(tilt), 0.0, math.cos(tilt)])


def along(table: dict[str, np.ndarray], direction: np.ndarray, kind: str = "v") -> np.ndarray:
    return sum(d * table[kind + axis] for d, axis in zip(direction, "xyz"))


class Rest(unittest.TestCase):
    def test_overlap_under_gravity(self):
        # PHYSICS.md, A13: the ball of Gao & Feng's Table 2
        case = Case(
            plane(0.0, 0.01), 1e-3, [(0.0, 0.0, 1e-3)], density=2480.0, young=(74.6e9, 210.6e9), nu=(0.2285, 0.286),
            dt=1e-7, steps=20000, low=(-0.01,) * 3, high=(0.01,) * 3,
        )
        table = case.run()
        self.assertAlmostEqual(table["overlap"][-1] / 1.193756e-9, 1.0, delta=1e-6)
        self.assertLess(abs(table["vz"][-1]), 1e-10)


class Incline(unittest.TestCase):
    """PHYSICS.md, D5."""

    radius = 5e-3

    def slide(self, degrees: float, mu: float, seconds: float, v0: float = 0.0, e: float = 0.3):
        """Time, speed downhill, spin and way of a ball that starts with the overlap of rest."""
        tilt = math.radians(degrees)
        downhill, normal = frame(tilt)
        uphill = 0.25
        case = Case(plane(tilt, 0.5, (40, 5)), self.radius, [], mu=mu, e=e, dt=5e-6, every=20)
        case.steps = round(seconds / case.dt)
        height = self.radius - case.rest_overlap(case.mass * G * math.cos(tilt))
        case.at = [tuple((-uphill * downhill + height * normal).tolist())]
        case.v = tuple((v0 * downhill).tolist())
        case.low, case.high = (-0.3, -0.02, -0.3), (0.3, 0.02, 0.3)
        table = case.run()
        return table["t"], along(table, downhill), table["wy"], along(table, downhill, "") + uphill

    def test_rolling(self):
        for degrees, mu, a in ((20, 0.3, 2.396584), (30, 0.3, 3.503571)):
            t, v, spin, x = self.slide(degrees, mu, 0.3)
            with self.subTest(degrees=degrees):
                self.assertAlmostEqual(v[-1] / (a * t[-1]), 1.0, delta=5e-3)
                self.assertAlmostEqual(x[-1] / (a * t[-1] ** 2 / 2), 1.0, delta=5e-3)
                self.assertAlmostEqual(self.radius * spin[-1] / v[-1], 1.0, delta=5e-3)

    def test_slipping(self):
        for degrees, mu, a, spin_up in ((30, 0.1, 4.055429, 2.123927), (45, 0.2, 5.549374, 3.468359)):
            t, v, spin, x = self.slide(degrees, mu, 0.3)
            with self.subTest(degrees=degrees):
                self.assertAlmostEqual(v[-1] / (a * t[-1]), 1.0, delta=5e-3)
                self.assertAlmostEqual(x[-1] / (a * t[-1] ** 2 / 2), 1.0, delta=5e-3)
                self.assertAlmostEqual(self.radius * spin[-1] / (spin_up * t[-1]), 1.0, delta=5e-3)

    def test_from_sliding_to_rolling(self):
        # e = 1: LIGGGHTS' tangential damper has no bound while the friction spring is below Coulomb's
        t, v, spin, x = self.slide(0, 0.2, 0.25, v0=1.0, e=1.0)
        sliding = v - self.radius * spin
        rolls = np.argmax(sliding < 1e-3)
        self.assertAlmostEqual(t[rolls] / 0.145624, 1.0, delta=5e-3)
        self.assertAlmostEqual(x[rolls] / 0.124821, 1.0, delta=5e-3)
        self.assertAlmostEqual(v[-1] / 0.714286, 1.0, delta=5e-3)


class Bowl(unittest.TestCase):
    """PHYSICS.md, D6: periods of swinging, frictionless and rolling, in a sphere and across a cylinder."""

    WALLS = {
        "sphere": "sphere: {{centre: [0, 0, 0], radius: {R}, latitude: [-90, 0], elements: [8, 4], degree: {p}}}",
        "cylinder": "cylinder: {{origin: [0, -0.02, 0], axis: [0, 1, 0], reference: [1, 0, 0], radius: {R}, "
        "length: 0.04, elements: [12, 3], degree: {p}}}",
    }

    def period(self, wall: str, degree: int, R: float, r: float, degrees: float, mu: float, y: float) -> float:
        """From the first and the second passage through the lowest point, half a period apart."""
        angle = math.radians(degrees)
        case = Case(
            self.WALLS[wall].format(R=R, p=degree), r, [], mu=mu, e=0.5, every=10,
            steps=round(1.1 * 0.75 * 2 * math.pi * math.sqrt(7 * (R - r) / (5 * G)) * 1.08 / 1e-5),
            low=(-0.15,) * 3, high=(0.15,) * 3,
        )
        distance = R - r + case.rest_overlap(case.mass * G * math.cos(angle))
        case.at = [(distance * math.sin(angle), y, -distance * math.cos(angle))]
        table = case.run()
        t, x = table["t"], table["x"]
        passes = np.flatnonzero(np.sign(x[1:]) != np.sign(x[:-1]))
        first, second = (t[i] + (t[i + 1] - t[i]) * x[i] / (x[i] - x[i + 1]) for i in passes[:2])
        return 2 * (second - first)

    def test_periods(self):
        small, large = (50e-3, 5e-3), (100e-3, 10e-3)
        rows = [  # wall, degree, bowl, start [degree], rolling, period [s]
            ("sphere", 2, small, 5, True, 0.503759),
            ("sphere", 2, small, 30, True, 0.512284),
            ("sphere", 2, small, 60, True, 0.540367),
            ("sphere", 2, small, 5, False, 0.425754),
            ("sphere", 3, small, 60, False, 0.456694),
            ("cylinder", 2, small, 30, True, 0.512284),
            ("cylinder", 3, small, 60, True, 0.540367),
            ("cylinder", 2, small, 30, False, 0.432959),
            ("sphere", 2, large, 10, True, 0.713441),
            ("cylinder", 2, large, 30, True, 0.724480),
        ]
        for wall, degree, (R, r), degrees, rolling, expected in rows:
            with self.subTest(wall=wall, degree=degree, R=R, degrees=degrees, rolling=rolling):
                # in the cylinder off its lines of symmetry; a sphere's swing in a plane goes through the lowest point
                y = 3e-3 if wall == "cylinder" else 0.0
                period = self.period(wall, degree, R, r, degrees, 0.8 if rolling else 0.0, y)
                self.assertAlmostEqual(period / expected, 1.0, delta=5e-3)


class EffectiveRadius(unittest.TestCase):
    """PHYSICS.md, D10: Hertz' stiffness on walls with R/r = 10, outside (convex) and inside (concave)."""

    R, r, overlap = 50e-3, 5e-3, 5e-6
    WALLS = {
        "sphere": "sphere: {centre: [0, 0, 0], radius: 0.05, elements: [8, 4]}",
        "cylinder": "cylinder: {origin: [0, -0.05, 0], axis: [0, 1, 0], radius: 0.05, length: 0.1, elements: [8, 4]}",
    }

    def force_over_flat(self, wall: str, side: int, words: str) -> float:
        """The force at a given overlap over that on a flat wall, K overlap^1.5."""
        case = Case(self.WALLS[wall], self.r, [], e=1.0, gravity=0.0, words=words, low=(-0.1,) * 3, high=(0.1,) * 3)
        distance = self.R + side * (self.r - self.overlap)
        case.at = [tuple((distance * np.array([0.6, 0.0, 0.8])).tolist())]
        case.output = (
            "variable pull equal sqrt(f_wall[1]^2+f_wall[2]^2+f_wall[3]^2)\nthermo_style custom step v_pull\n"
            "thermo_modify format float %.17g\nrun 0\n"
        )
        return case.run()["pull"][0] / (case.stiffness * self.overlap**1.5)

    def test_particle(self):
        for wall in self.WALLS:
            for words in ("", "rstar particle"):
                with self.subTest(wall=wall, words=words):
                    self.assertAlmostEqual(self.force_over_flat(wall, 1, words), 1.0, delta=1e-9)

    def test_curvature_of_a_sphere(self):
        for side, factor in ((1, 0.953463), (-1, 1.054093)):  # (1 +- r/R)^(-1/2)
            with self.subTest(side=side):
                self.assertAlmostEqual(self.force_over_flat("sphere", side, "rstar curvature"), factor, delta=1e-6)

    def test_curvature_of_a_cylinder(self):
        # Hertz' elliptic contact, Johnson (1985), section 4.2; the equivalent radius is an approximation of it
        for side in (1, -1):
            exact = elliptic_contact(1 / self.r, 1 / self.r + side / self.R)
            with self.subTest(side=side):
                self.assertAlmostEqual(
                    self.force_over_flat("cylinder", side, "rstar curvature"), exact / math.sqrt(self.r), delta=1e-3
                )


def elliptic_contact(A: float, B: float) -> float:
    """(r_e)^(1/2) for F = 4/3 E* (r_e)^(1/2) overlap^1.5 of two bodies with relative curvatures A and B [1/m].

    Half axes a > b, m = 1 - (b/a)^2.  A pressure p (1 - x^2/a^2 - y^2/b^2)^(1/2) presses the surfaces in by
    (L - M x^2 - N y^2)/E* with L = p b K, M = p b (K - E)/(m a^2), N = p b (E/(1 - m) - K)/(m a^2)
    (Johnson, eq. 3.41); so overlap = L/E*, the curvatures are 2 M/E* and 2 N/E*, and F = 2/3 pi a b p."""
    small, large = sorted((A, B))

    def ratio(m: float) -> float:  # of the curvatures, large/small
        K, E = ellipk(m), ellipe(m)
        return (E / (1 - m) - K) / (K - E)

    m = brentq(lambda m: ratio(m) - large / small, 1e-9, 1 - 1e-9)
    K, E = ellipk(m), ellipe(m)
    a = math.sqrt(2 * (K - E) / (m * small * K))  # over overlap^(1/2)
    return 0.5 * math.pi * a / K


class Impact(unittest.TestCase):
    def test_oblique_with_gross_sliding(self):
        # PHYSICS.md, D8: speed, degrees from the normal, mu, r [mm]; tangential and normal speed, spin after
        rows = [(1.0, 60, 0.1, 1.0, 0.766025, 0.5, 250.0), (2.0, 70, 0.15, 2.0, 1.674173, 0.684040, 256.515)]
        tilt = math.radians(37.0)
        downhill, normal = frame(tilt)
        for speed, degrees, mu, r_mm, Vt, Vn, spin in rows:
            angle, r = math.radians(degrees), 1e-3 * r_mm
            v = speed * (math.sin(angle) * downhill - math.cos(angle) * normal)
            case = Case(
                plane(tilt, 0.01), r, [tuple(((r + 1.3e-7) * normal).tolist())], tuple(v.tolist()), e=1.0, mu=mu,
                young=(74.6e9, 210.6e9), density=2480.0, gravity=0.0, dt=1e-8, steps=2500, every=100,
                low=(-0.02,) * 3, high=(0.02,) * 3,
            )
            table = case.run()
            self.assertEqual(table["overlap"][-1], 0.0, "the ball has left")
            with self.subTest(speed=speed):
                self.assertAlmostEqual(along(table, downhill)[-1] / Vt, 1.0, delta=5e-3)
                self.assertAlmostEqual(along(table, normal)[-1] / Vn, 1.0, delta=5e-3)
                self.assertAlmostEqual(table["wy"][-1] / spin, 1.0, delta=5e-3)

    def test_error_of_the_time_step(self):
        # PHYSICS.md, A12: largest error of the restitution over 200 phases of the start, t_c = N dt
        phases = 200
        for N, worst in ((10, 2.6e-3), (20, 4.3e-4), (50, 4.1e-5), (100, 7.2e-6), (200, 1.3e-6)):
            r, V = 1e-3, 1.0
            case = Case(
                plane(0.0, 0.02, (3, 4)), r, [], (0.0, 0.0, -V), e=1.0, gravity=0.0, density=2480.0,
                young=(74.6e9, 210.6e9), nu=(0.2285, 0.286), low=(-0.02,) * 3, high=(0.02,) * 3,
                output="variable contacts equal f_wall[7]\n"
                "compute fast all reduce max vz\ncompute slow all reduce min vz\n"
                "thermo_style custom step c_fast c_slow v_contacts\n"
                "thermo_modify format float %.17g lost error norm no\nthermo {steps}\nrun {steps}\n",
            )
            case.dt = 2.943275 * (1.25 * case.mass / (case.stiffness * math.sqrt(V))) ** 0.4 / N
            case.steps = N + 5
            side = 15
            case.at = [
                ((i % side - 7) * 2.2e-3, (i // side - 7) * 2.2e-3, r + (i + 0.5) / phases * V * case.dt)
                for i in range(phases)
            ]
            table = case.run()
            self.assertEqual(table["contacts"][-1], 0.0)
            error = max(abs(table[c][-1] / V - 1.0) for c in ("fast", "slow"))
            with self.subTest(N=N):
                self.assertAlmostEqual(error / worst, 1.0, delta=0.1)


if __name__ == "__main__":
    unittest.main()

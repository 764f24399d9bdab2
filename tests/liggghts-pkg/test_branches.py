# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts of one particle with a wall of several patches, with kinks, hollows and periodic images: each local minimum
of the distance is a contact with a memory of its own."""

import math
import re
import unittest

import ball_on_block as bob
import decks
import numpy as np
from scipy.optimize import minimize

R = bob.RADIUS
MODELS = "model hertz tangential history rolling_friction epsd2"
BOX = "region box block -0.02 0.02 -0.02 0.02 -0.005 0.02 units box"
COLUMNS = ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", "wx", "wy", "wz")
OUTPUT = (
    "".join(f"variable {c} equal {c}[1]\n" for c in COLUMNS[:9])
    + "compute spin all property/atom omegax omegay omegaz\n"
    + "".join(f"variable w{c} equal c_spin[1][{k}]\n" for k, c in enumerate("xyz", 1))
)
TABLE = (
    "thermo_style custom step {columns}{more}\nthermo_modify format float %.17g lost error flush yes\nthermo {every}\nrun {steps}\n"
)


def patch(points, degrees=(1, 1), knots=None) -> str:
    """A patch of the model file; points[j][i], clamped knots unless given."""
    n = (len(points[0]), len(points))
    clamped = [[0] * d + np.linspace(0, 1, c - d + 1).tolist() + [1] * d for d, c in zip(degrees, n)]
    flat = [list(map(float, p)) for row in points for p in row]
    return f"    - {{degrees: {list(degrees)}, knots: {knots or clamped}, control_points: {flat}}}\n"


def model_file(*patches: str) -> dict[str, str]:
    return {"wall.yaml": "units: si\ngeometry:\n  patches:\n" + "".join(patches) + "surfaces: {wall: all}\n"}


def quad(origin, u, v, n=(2, 2)) -> str:
    """A parallelogram with n x n control points."""
    o, u, v = (np.array(a, dtype=float) for a in (origin, u, v))
    return patch([[o + a * u + b * v for a in np.linspace(0, 1, n[0])] for b in np.linspace(0, 1, n[1])])


def prelude(ball, velocity, *, gravity=True, e=0.6, mu=0.4, timestep=2e-6, boundary="f f f", box=BOX) -> str:
    text = bob.prelude(
        balls=(ball,), velocity=velocity, ball=(5e7, 0.3), wall=(5e7, 0.3), restitution=e, friction=mu,
        timestep=timestep, models=MODELS,
    )
    text = text.replace("boundary f f f", f"boundary {boundary}").replace(BOX, box)
    text = text.replace("hard_particles yes\n", "neigh_modify delay 0\n")
    rolling = "fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0.02 0.02 0.02 0.02\n"
    text = text.replace("pair_style", rolling + "pair_style", 1)
    return text + ("fix g all gravity 9.81 vector -0.3 0.2 -0.9\n" if gravity else "")


def nurbs(more: str = "") -> str:
    columns = "variable n equal f_wall[7]\nvariable deepest equal f_wall[8]\n"
    return f"fix wall all wall/nurbs {MODELS} type 2 geometry wall.yaml surface wall {more}\n" + columns


def planes(*words: str) -> str:
    return "".join(
        f"fix wall{k} all wall/gran {MODELS} primitive type 2 {word} 0.0\n" for k, word in enumerate(words)
    )


def table(steps: int, every: int = 20, more: str = "", ranks: int = 1) -> str:
    """Prints every so many steps; the spin on one rank only, since LIGGGHTS cannot on ranks without particles."""
    columns = " ".join(f"v_{c}" for c in (COLUMNS if ranks == 1 else COLUMNS[:9]))
    return TABLE.format(columns=columns, steps=steps, every=every, more=more)


def run(start: str, wall: str, files=None, *, steps=4000, every=20, more="", ranks=1, **options) -> decks.Run:
    deck = start + wall + OUTPUT + table(steps, every, more, ranks)
    return decks.good(deck, files=files, ranks=ranks, **options)


def difference(ours: dict, reference: dict) -> float:
    """Largest over all columns, relative to the largest of its kind (position, velocity, force, spin)."""
    worst = 0.0
    common = [c for c in COLUMNS if c in ours]
    for column in common:
        kind = [c for c in common if c[:-1] == column[:-1]]
        scale = max(abs(reference[c]).max() for c in kind)
        worst = max(worst, abs(ours[column] - reference[column]).max() / scale)
    return worst


L = 0.03
FLOOR = quad((0, -L / 2, 0), (L, 0, 0), (0, L, 0))
SIDE = quad((0, -L / 2, 0), (0, 0, L), (0, L, 0))
# one patch round the corner: degree 2, a C0 knot in the corner; bent along xi or along eta
ROUND = [[(0, y, L), (0, y, L / 2), (0, y, 0), (L / 2, y, 0), (L, y, 0)] for y in (-L / 2, 0, L / 2)]
KINK, STRAIGHT = [0, 0, 0, 0.5, 0.5, 1, 1, 1], [0, 0, 0, 1, 1, 1]
FOLDED = patch(ROUND, degrees=(2, 2), knots=[KINK, STRAIGHT])
FOLDED_ALONG_ETA = patch(list(zip(*ROUND)), degrees=(2, 2), knots=[STRAIGHT, KINK])


class Corner(unittest.TestCase):
    """A ball that slides and rolls along the floor into a corner and on along it."""

    START = prelude((3e-3, -5e-3, R), (-0.5, 0.4, 0))

    def test_a_corner_equals_two_planes_of_liggghts(self):
        stock = run(self.START, planes("zplane", "xplane"), program=decks.STOCK).table
        self.assertGreater(stock["fx"].max(), 0.0, "the ball gets to the corner")
        walls = {"two patches": (FLOOR, SIDE), "a kink along eta": (FOLDED,), "a kink along xi": (FOLDED_ALONG_ETA,)}
        for name, patches in walls.items():
            with self.subTest(name):
                ours = run(self.START, nurbs(), model_file(*patches), more=" v_n").table
                self.assertEqual(ours["n"].max(), 2.0)
                self.assertLessEqual(difference(ours, stock), 1e-10)

    def test_a_corner_at_a_periodic_face(self):
        """What makes the corner are images: of the side, which stands at the far face, and of the floor up to a seam a radius
        off.  The side's edge is so near that feet are found anew in each step."""
        length = 0.01
        box = BOX.replace("-0.02 0.02", f"0.0 {length}", 1)
        start = prelude((3e-3, -5e-3, R), (-0.5, 0.4, 0), boundary="p f f", box=box)
        floor = quad((R, -L / 2, 0), (length, 0, 0), (0, L, 0), (5, 4))
        side = quad((length, -L / 2, R / 2), (0, 0, L), (0, L, 0), (4, 5))
        stock = run(self.START, planes("zplane", "xplane"), program=decks.STOCK).table
        ours = run(start, nurbs(), model_file(floor, side), more=" v_n").table
        self.assertEqual(ours["n"].max(), 2.0)
        self.assertLessEqual(difference(ours, stock), 1e-10)

    def test_a_hundred_balls_side_by_side_do_what_one_does(self):
        """More contacts than are resolved together, two of each ball: nobody is forgotten, nobody gets another's."""
        count, long = 100, 0.3
        box = BOX.replace("-0.02 0.02 -0.02 0.02", "-0.02 0.02 -0.15 0.15")
        files = model_file(quad((0, -long / 2, 0), (L, 0, 0), (0, long, 0)), quad((0, -long / 2, 0), (0, 0, L), (0, long, 0)))
        start = prelude((2e-3, 0.0, R), (-0.5, 0.4, 0), gravity=False, box=box)
        more = "".join(f"create_atoms 1 single 0.002 {2.5e-3 * k!r} {R!r} units box\n" for k in range(-50, 51) if k != 0)
        many = start.replace("set group all diameter", more + "set group all diameter", 1)
        extremes = "".join(f"compute {name} all reduce {name} x z vx vy vz\n" for name in ("min", "max"))
        columns = " v_n f_wall[1] f_wall[2] f_wall[3]" + "".join(f" c_{m}[{k}]" for k in range(1, 6) for m in ("min", "max"))
        one, all_ = (run(s, nurbs() + extremes, files, steps=1600, more=columns).table for s in (start, many))
        self.assertEqual(one["n"].max(), 2.0)
        np.testing.assert_array_equal(all_["n"], (count + 1) * one["n"])
        for k, name in enumerate(("x", "z", "vx", "vy", "vz"), 1):
            scale = abs(one[name]).max()
            for end in (f"min[{k}]", f"max[{k}]"):
                np.testing.assert_allclose(all_[end], one[name], rtol=0, atol=1e-12 * scale, err_msg=name)
        for k in (1, 2, 3):
            force = one[f"wall[{k}]"]
            np.testing.assert_allclose(all_[f"wall[{k}]"], (count + 1) * force, rtol=0, atol=1e-10 * (count + 1) * abs(force).max())

    def test_ranks_and_restart_keep_both_memories(self):
        """Both ranks meet in the middle of the corner; the restart falls into two contacts."""
        start = prelude((R - 1e-7, -1e-4, R - 2e-7), (0, 0.4, 0), e=0.1)  # as deep as its weight presses it
        settings = start[start.index("fix m1") : start.index("create_atoms")] + start[start.index("fix integrate") :]
        for patches in ((FLOOR, SIDE), (FOLDED,)):
            files = model_file(*patches)
            results = []
            for ranks in (1, 2):
                lines = table(800, 1, " v_n", ranks)
                resume = (
                    "clear\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\n"
                    "communicate single vel yes\nread_restart half.restart\nneighbor 0.0002 bin\n"
                    + settings + nurbs() + OUTPUT + lines
                )
                deck = start + nurbs() + OUTPUT + lines + "write_restart half.restart\n" + lines + resume
                deck = deck.replace("processors * * *", f"processors 1 {ranks} 1")
                results.append(decks.good(deck, files=files, ranks=ranks).tables)
            one, two = results
            self.assertEqual(one[2]["n"][0], 2.0, "in the corner")
            for tables in results:
                for column in tables[1]:
                    np.testing.assert_array_equal(tables[2][column], tables[1][column])
            self.assertLess(two[0]["y"][0] * two[2]["y"][-1], 0.0, "the ball changes ranks")
            for ours, reference in zip(two, one):
                self.assertLessEqual(difference(ours, reference), 1e-12)

    def test_more_contacts_than_slots_stop_the_run(self):
        deck = prelude((0.99 * R, 0, 0.99 * R), (0, 0, 0)) + nurbs("contacts 1") + OUTPUT + "run 0\n"
        for ranks in (1, 2):
            result = decks.run(deck, files=model_file(FLOOR, SIDE), ranks=ranks)
            self.assertNotEqual(result.code, 0)
            self.assertRegex(result.text, r"Fix wall/nurbs \(id wall\): particle 1 touches the wall in more than 1 places")


class Welds(unittest.TestCase):
    def test_rolling_over_welded_patches_equals_a_plane(self):
        """Four coplanar patches with parameters that run differently, and one patch with kinks that are none."""
        q = L / 2
        four = (
            quad((-q, -q, 0), (q, 0, 0), (0, q, 0), (4, 3)),
            quad((q, -q, 0), (-q, 0, 0), (0, q, 0), (3, 3)),
            quad((0, q, 0), (0, -q, 0), (-q, 0, 0), (3, 4)),
            quad((0, 0, 0), (q, 0, 0), (0, q, 0), (3, 5)),
        )
        x = np.linspace(-q, q, 9)
        kinked = patch(
            [[(a, b, 0) for a in x] for b in x], degrees=(2, 2), knots=[[0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1]] * 2
        )
        start = prelude((-3e-3, -2e-3, R), (0.7, 0.5, 0))
        stock = run(start, planes("zplane"), program=decks.STOCK).table
        self.assertGreater(stock["x"].max(), 2e-3)
        walls = (("four", four, ""), ("kinked", (kinked,), ""), ("four, by the paper's search", four, "search simplex_brent"))
        for name, patches, search in walls:
            with self.subTest(name):
                ours = run(start, nurbs(search), model_file(*patches), more=" v_n").table
                self.assertLessEqual(difference(ours, stock), 1e-10)
                self.assertEqual(ours["n"].max(), 1.0, "a foot on a border counts once")

    def test_periodic_box_has_no_seam(self):
        box = "region box block -0.004 0.004 -0.004 0.004 -0.005 0.02 units box"
        start = prelude((-1e-3, 1e-3, R), (1.0, 0.7, 0), boundary="p p f", box=box)
        stock = run(start, planes("zplane"), program=decks.STOCK, steps=20000).table
        a = 4e-3
        spanning = quad((-a, -a, 0), (2 * a, 0, 0), (0, 2 * a, 0), (5, 4))
        shifted = quad((-0.3 * a, 0.5 * a, 0), (2 * a, 0, 0), (0, 2 * a, 0), (5, 4))  # reaches out of the box
        for name, wall, search, most_ranks in (
            ("spanning", spanning, "", 2), ("shifted", shifted, "", 2), ("by the paper's search", shifted, "search simplex_brent", 1)
        ):
            for ranks in range(1, most_ranks + 1):
                with self.subTest(name, ranks=ranks):
                    ours = run(start, nurbs(search), model_file(wall), steps=20000, more=" v_n", ranks=ranks).table
                    self.assertLessEqual(difference(ours, stock), 1e-9)
                    self.assertEqual(ours["n"].max(), 1.0)


# z = DEPTH (x / WIDTH)^2: radius of curvature at the bottom 0.45 mm, less than the ball's
DEPTH, WIDTH = 1.25e-3, 0.75 * math.sqrt(2.0) * 1e-3


def trough() -> str:
    half = 3 * WIDTH
    height = DEPTH * (half / WIDTH) ** 2
    row = [(-half, height), (0.0, -height), (half, height)]  # Bezier points of the parabola
    return patch([[(x, y, z) for x, z in row] for y in (-5e-3, 0, 5e-3)], degrees=(2, 2))


class Hollow(unittest.TestCase):
    def feet(self, x: float, z: float) -> list[float]:
        """Distances of all local minima, by sampling and polishing."""
        distance = lambda u: math.hypot(u - x, DEPTH * (u / WIDTH) ** 2 - z)  # noqa: E731
        u = np.linspace(-3 * WIDTH, 3 * WIDTH, 4001)
        d = np.hypot(u - x, DEPTH * (u / WIDTH) ** 2 - z)
        minima = [k for k in range(1, len(u) - 1) if d[k] <= d[k - 1] and d[k] < d[k + 1]]
        return sorted(minimize(lambda v: distance(v[0]), [u[k]], tol=1e-16).fun for k in minima)

    def test_a_trough_narrower_than_the_ball_is_touched_on_both_sides(self):
        heights = (2.0e-3, 1.52e-3, 1.50e-3)
        for x in (0.0, 2e-5):
            for z in heights:
                feet = [d for d in self.feet(x, z) if d < R]
                start = prelude((x, 0, z), (0, 0, 0), gravity=False)
                result = run(start, nurbs(), model_file(trough()), steps=0, every=1, more=" v_n v_deepest").table
                with self.subTest(x=x, z=z):
                    self.assertEqual(result["n"][0], len(feet))
                    if feet:
                        self.assertAlmostEqual(result["deepest"][0], R - feet[0], delta=1e-9 * R)

    def test_pushed_in_and_out_without_a_jump(self):
        """Straight down the middle, both contacts share the load, and nothing is lost on the way out."""
        start = prelude((0.0, 0.0, 1.9e-3), (0, 0, -0.3), gravity=False, e=1.0, mu=0.0, timestep=2e-7)
        push = run(start, nurbs(), model_file(trough()), steps=16000, every=1, more=" v_n").table
        self.assertEqual(set(push["n"]), {0.0, 2.0})
        self.assertAlmostEqual(push["vz"][-1], 0.3, delta=1e-5)
        self.assertLessEqual(abs(push["fx"]).max(), 1e-9 * push["fz"].max())
        steps = abs(np.diff(push["fz"])).max() / push["fz"].max()
        self.assertLess(steps, 0.02)


class Edges(unittest.TestCase):
    """Balls at rest that touch an edge, a corner or a kink: the force points from the nearest point of the wall."""

    HERTZ = 4 / 3 * 5e7 / (2 * (1 - 0.3**2)) * math.sqrt(R)

    def force(self, centre, patches) -> tuple[np.ndarray, float]:
        start = prelude(tuple(float(c) for c in centre), (0, 0, 0), gravity=False)
        table = run(start, nurbs(), model_file(*patches), steps=0, every=1, more=" v_n").table
        return np.array([table[c][0] for c in ("fx", "fy", "fz")]), table["n"][0]

    def test_edge_corner_and_ridge(self):
        overlap, q = 1e-5, 2e-3
        flat = quad((0, 0, 0), (q, 0, 0), (0, q, 0), (3, 3))
        slope = np.array([q, 0, -q]) / math.sqrt(2)
        roof = (quad((-q, 0, -0.3 * q), (q, 0, 0.3 * q), (0, q, 0)), quad((0, 0, 0), slope, (0, q, 0)))
        directions = {
            "edge": ((0, 0.7 * q, 0), (-0.6, 0, 0.8), (flat,)),
            "corner": ((q, q, 0), (0.48, 0.6, -0.64), (flat,)),
            "ridge": ((0, 0.4 * q, 0), (0.1, 0, 1), roof),
            "end of the ridge": ((0, 0, 0), (0.05, -0.5, 1), roof),
        }
        for name, (point, direction, patches) in directions.items():
            n = np.array(direction) / np.linalg.norm(direction)
            force, contacts = self.force(np.array(point) + (R - overlap) * n, patches)
            with self.subTest(name):
                self.assertEqual(contacts, 1.0)
                np.testing.assert_allclose(force, self.HERTZ * overlap**1.5 * n, atol=1e-9 * self.HERTZ * overlap**1.5)


class Closed(unittest.TestCase):
    """Round walls that close on themselves: the same force everywhere, on seams and poles, too."""

    def test_sphere_and_torus(self):
        overlap, big, tube = 1e-5, 8e-3, 3e-3
        hertz = Edges.HERTZ * overlap**1.5
        seam = [0.0, 1e-9, -1e-9, 1e-4, -1e-4]
        sphere = [(a, b) for a in (*seam, 1.0, 2.5) for b in (-1.5707, -1.0, 0.0, 1e-5, 0.9)]
        poles = [(a, s * (math.pi / 2 - t)) for a in (0.0, 2.0) for s in (1, -1) for t in (0.0, 1e-7, 1e-3)]
        torus = [(a, b) for a in (*seam, 2.0) for b in (*seam, math.pi, 1.3)]

        def on_sphere(a, b):
            n = np.array([math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b)])
            return big * n, n

        def on_torus(a, b):
            n = np.array([math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b)])
            return big * np.array([math.cos(a), math.sin(a), 0]) + tube * n, n

        shapes = {
            "sphere": (f"sphere: {{centre: [0, 0, 0], radius: {big}, elements: [4, 2]}}", on_sphere, sphere + poles),
            "torus": (
                f"torus: {{centre: [0, 0, 0], axis: [0, 0, 1], radius: {big}, tube_radius: {tube}, elements: [8, 4]}}",
                on_torus, torus,
            ),
        }
        box = "region box block -0.02 0.02 -0.02 0.02 -0.02 0.02 units box"
        for name, (shape, place, angles) in shapes.items():
            for side in (1, -1):
                centres, normals = [], []
                for a, b in angles:
                    point, n = place(a, b)
                    centres.append(point + side * (R - overlap) * n)
                    normals.append(side * n)
                sets = "".join(f"set atom 1 x {x!r} y {y!r} z {z!r}\nrun 0\n" for x, y, z in np.array(centres).tolist())
                start = prelude(tuple(centres[0].tolist()), (0, 0, 0), gravity=False, box=box)
                deck = start + nurbs() + OUTPUT + table(0, 1, " v_n").replace("run 0\n", "") + sets
                files = {"wall.yaml": f"units: si\ngeometry:\n  {shape}\nsurfaces: {{wall: all}}\n"}
                found = decks.good(deck, files=files).table
                force = np.stack([found[c] for c in ("fx", "fy", "fz")], axis=1)
                with self.subTest(name, side=side):
                    self.assertEqual(set(found["n"]), {1.0})
                    self.assertLessEqual(abs(force / hertz - np.array(normals)).max(), 1e-8)
                    self.assertLessEqual(abs(np.linalg.norm(force, axis=1) / hertz - 1).max(), 1e-10)


class Reports(unittest.TestCase):
    def test_a_ball_that_would_cross_in_one_step_is_named(self):
        wall = model_file(quad((-L / 2, -L / 2, 0), (L, 0, 0), (0, L, 0)))
        for speed, crosses in ((5.0, False), (400.0, True)):
            start = prelude((0, 0, 3e-3), (0, 0, -speed), gravity=False, timestep=5e-6)
            for ranks in (1, 2):
                text = run(start, nurbs(), wall, steps=3, ranks=ranks).text
                found = re.search(r"WARNING: Fix wall/nurbs \(id wall\): the centre of particle 1 would cross the wall.*", text)
                with self.subTest(speed=speed, ranks=ranks):
                    self.assertEqual(bool(found), crosses)
                    if found:
                        advised = float(re.search(r"timestep of at most ([\d.e+-]+)", found.group()).group(1))
                        self.assertAlmostEqual(advised, 0.1 * R / speed, delta=0.01 * advised)

    def test_power_is_that_of_force_and_torque(self):
        """The last column, of a wall that turns and of one that also shifts."""
        period = 0.05
        start = prelude((2e-3, -1e-3, 0.999 * R), (0.3, 0.2, 0))
        omega = 2 * math.pi / period
        turn = f"motion rotate origin 1e-3 0 0 axis 0 0 1 period {period} "
        for name, motion, shift in (("turns", turn, 0.0), ("shifts, too", "motion linear -0.4 0 0 " + turn, -0.4)):
            more = "".join(f"variable c{k} equal f_wall[{k}]\n" for k in (1, 2, 6, 18))
            result = run(start, nurbs(motion) + more, model_file(quad((-L, -L, 0), (2 * L, 0, 0), (0, 2 * L, 0), (4, 4))),
                         steps=1000, every=1, more=" v_c1 v_c2 v_c6 v_c18").table
            time = 2e-6 * result["Step"]
            # about the centre, which may shift; before the first step the wall is at rest
            centre = 1e-3 + shift * time
            torque = result["c6"] - centre * result["c2"]
            expected = -(torque * omega + result["c1"] * shift)
            with self.subTest(name):
                self.assertGreater(abs(expected).max(), 1e-6)
                self.assertLessEqual(abs(result["c18"] - expected)[2:].max(), 2e-4 * abs(expected).max())

    def test_dump_local_has_a_row_for_each_contact(self):
        z = 0.995 * R
        deck = prelude((z, 1e-3, z), (0, 0, 0), gravity=False) + nurbs() + OUTPUT + (
            "dump d all local 1 rows.txt " + " ".join(f"f_wall[{k}]" for k in range(1, 12))
            + "\ndump_modify d format \"" + " ".join(["%.17g"] * 11) + "\"\n"
            + "thermo_style custom step v_fx v_fz\nthermo_modify format float %.17g\nrun 0\n"
        )
        launcher = ["sh", "-c", '"$@" && sed "s/^/ROW /" rows.txt', "sh"]
        result = decks.good(deck, files=model_file(FLOOR, SIDE), launcher=launcher)
        rows = [list(map(float, l.split()[1:])) for l in result.text.splitlines() if re.match(r"ROW [\d.-]+ [\d.-]+ .*", l)]
        rows = sorted((r for r in rows if len(r) == 11), key=lambda r: r[1])
        self.assertEqual(len(rows), 2)
        for row, patch_number, point in ((rows[0], 0, (z, 1e-3, 0)), (rows[1], 1, (0, 1e-3, z))):
            self.assertEqual(row[0], 1, "tag")
            self.assertEqual(row[1], patch_number)
            np.testing.assert_allclose(row[4:7], point, atol=1e-12)
            self.assertAlmostEqual(row[10], R - z, delta=1e-12)
        self.assertAlmostEqual(rows[0][2] * L, z, delta=1e-12)  # xi runs along x, eta along y
        self.assertAlmostEqual(rows[0][3] * L - L / 2, 1e-3, delta=1e-12)
        self.assertAlmostEqual(rows[0][9], -result.table["fz"][0], delta=1e-12)
        self.assertAlmostEqual(rows[1][7], -result.table["fx"][0], delta=1e-12)

    def test_effective_radius_on_round_walls(self):
        """Force on a sphere at rest, rstar curvature: Hertz with 1/r* = 1/r +- 1/R; on a cylinder the geometric mean."""
        big, overlap = 10 * R, 1e-5
        e_star = 5e7 / (2 * (1 - 0.3**2))
        hertz = lambda r: 4 / 3 * e_star * math.sqrt(r) * overlap**1.5  # noqa: E731
        shapes = {
            "sphere": (f"sphere: {{centre: [0, 0, 0], radius: {big}, elements: [4, 2]}}", 2),
            "cylinder": (f"cylinder: {{origin: [-0.02, 0, 0], axis: [1, 0, 0], radius: {big}, length: 0.04, elements: [4, 3]}}", 1),
        }
        box = "region box block -0.02 0.02 -0.02 0.02 -0.02 0.02 units box"
        for name, (shape, curved) in shapes.items():
            files = {"wall.yaml": f"units: si\ngeometry:\n  {shape}\nsurfaces: {{wall: all}}\n"}
            for side in (1, -1):
                z = big + side * (R - overlap)
                ball = (1e-4, 0.6 * math.sqrt(z * z - 1e-8), 0.8 * math.sqrt(z * z - 1e-8)) if name == "sphere" else (1e-4, 0.6 * z, 0.8 * z)
                start = prelude(ball, (0, 0, 0), gravity=False, box=box)
                for word, radius in (
                    ("particle", R),
                    ("curvature", R / math.sqrt((1 + side * R / big) ** curved)),
                ):
                    result = run(start, nurbs(f"rstar {word}"), files, steps=0, every=1).table
                    force = math.hypot(result["fx"][0], result["fy"][0], result["fz"][0])
                    with self.subTest(name, side=side, rstar=word):
                        self.assertAlmostEqual(force / hertz(radius), 1.0, delta=1e-6)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts of one particle with a wall of several patches, with kinks, hollows and periodic images: each local minimum
of the distance is a contact with a memory of its own."""

import math
import unittest

import decks
import numpy as np
from branch_decks import (
    FLOOR, FOLDED, FOLDED_ALONG_ETA, L, MODELS, OUTPUT, R, SIDE, difference, model_file, nurbs, patch, planes, prelude, quad, run, table,
)  # fmt: skip
from scipy.optimize import minimize


def facet(distance: float, normal, size: float) -> str:
    """Of an STL file: its middle at this distance from the origin along the normal."""
    n = np.array(normal, dtype=float)
    u = np.cross(n, (0, 0, 1) if abs(n[2]) < 0.8 else (0, 1, 0))
    u /= np.linalg.norm(u)
    v = np.cross(n, u)
    turns = 2 * np.pi * np.arange(3) / 3
    corners = [distance * n + size * (np.cos(t) * u + np.sin(t) * v) for t in turns]
    lines = "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*corner) for corner in corners)
    return f"facet normal 0 0 0\nouter loop\n{lines}endloop\nendfacet\n"


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

    def test_a_corner_of_one_of_ours_and_a_plane_of_liggghts(self):
        """Whichever comes first leaves force and torque on the ball, which are not the other's."""
        stock = run(self.START, planes("zplane", "xplane"), program=decks.STOCK).table
        for walls in (planes("xplane") + nurbs(), nurbs() + planes("xplane")):
            self.assertLessEqual(difference(run(self.START, walls, model_file(FLOOR)).table, stock), 1e-10)

    def test_a_corner_at_a_periodic_face(self):
        """What makes the corner are images: of the side, which stands at the far face, and of the floor up to a seam a radius
        off.  The side's edge is so near that feet are found anew in each step."""
        length = 0.01
        start = prelude((3e-3, -5e-3, R), (-0.5, 0.4, 0), boundary="p f f", box=f"0.0 {length} -0.02 0.02 -0.005 0.02")
        floor = quad((R, -L / 2, 0), (length, 0, 0), (0, L, 0), (5, 4))
        side = quad((length, -L / 2, R / 2), (0, 0, L), (0, L, 0), (4, 5))
        stock = run(self.START, planes("zplane", "xplane"), program=decks.STOCK).table
        ours = run(start, nurbs(), model_file(floor, side), more=" v_n").table
        self.assertEqual(ours["n"].max(), 2.0)
        self.assertLessEqual(difference(ours, stock), 1e-10)

    def test_a_hundred_balls_side_by_side_do_what_one_does(self):
        """More contacts than are resolved together, two of each ball: nobody is forgotten, nobody gets another's."""
        count, long = 100, 0.3
        files = model_file(quad((0, -long / 2, 0), (L, 0, 0), (0, long, 0)), quad((0, -long / 2, 0), (0, 0, L), (0, long, 0)))
        start = prelude((2e-3, 0.0, R), (-0.5, 0.4, 0), gravity=False, box="-0.02 0.02 -0.15 0.15 -0.005 0.02")
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
        thrown = (R - 1e-7, -1e-4, R - 2e-7), (0, 0.4, 0)  # as deep as its weight presses it
        for patches in ((FLOOR, SIDE), (FOLDED,)):
            files = model_file(*patches)
            results = []
            for ranks in (1, 2):
                lines = table(800, 1, " v_n", ranks)
                words = dict(e=0.1, processors=f"1 {ranks} 1")
                start, resumed = (prelude(*thrown, restart=file, **words) for file in ("", "half.restart"))
                deck = start + nurbs() + OUTPUT + lines + "write_restart half.restart\n" + lines
                deck += "clear\n" + resumed + nurbs() + OUTPUT + lines
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

    def test_many_contacts_at_once(self):
        """A ball begins in 150 small triangles and a large one, and leaves all but that, whose slot is far behind."""
        count, golden = 150, np.pi * (3 - np.sqrt(5))
        x = -0.3 - 0.69 * (np.arange(count) + 0.5) / count
        angles = golden * np.arange(count)
        normals = [(c, np.sqrt(1 - c * c) * np.cos(a), np.sqrt(1 - c * c) * np.sin(a)) for c, a in zip(x, angles)]
        stl = "".join(facet(0.98 * R, n, 0.02 * R) for n in normals) + facet(0.995 * R, (1, 0, 0), 0.1 * R)
        start = prelude((0, 0, 0), (0.5, 0, 0), gravity=False, box="-0.03 0.03 -0.03 0.03 -0.03 0.03")
        wall = f"fix wall all wall/nurbs {MODELS} type 2 geometry net.stl surface net contacts 200\n"
        more = "set group all density 4e10\nvariable n equal f_wall[7]\n"  # it flies on all the same
        done = run(start, wall + more, {"net.stl": f"solid net\n{stl}endsolid net\n"}, steps=600, every=5, more=" v_n")
        self.assertEqual(done.code, 0, done.text[-1500:])
        self.assertEqual(done.table["n"][0], count + 1)
        self.assertTrue(np.any(done.table["n"] == 1))


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
        box = "-0.004 0.004 -0.004 0.004 -0.005 0.02"
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
        box = "-0.02 0.02 -0.02 0.02 -0.02 0.02"
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


if __name__ == "__main__":
    unittest.main()

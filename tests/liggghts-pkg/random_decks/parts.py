# SPDX-License-Identifier: GPL-2.0-or-later
"""Random walls of faces, edges and vertices: triangles (STL), and parts of tests/iga-solver/step as STEP files."""

from __future__ import annotations

import os
import subprocess
from random import Random
from tempfile import TemporaryDirectory

import numpy as np
from scipy.spatial import ConvexHull

from geometry import direction, unit
from walls import Site, Wall

SIZE = 6e-3  # half of what a wall measures [m]
# Bodies and sheets of all kinds of faces.
CAD = (
    "hopper blend_cone_pipe holes variable_fillet spline_plate_hole tiny_faces tee sphere_cut torus_cut nested frustum "
    "pipe_on_cone thin_sheet near_tangent gaps loft spline_ring parallel_plates bezier_2_14"
).split()


class Placement:
    """Words of fix wall/nurbs, in any order, and what they do to points."""

    def __init__(self, scale: float, words: list[str] | None = None):
        self.matrix, self.shift, self.words = scale * np.eye(3), np.zeros(3), [f"scale {scale!r}"] if scale != 1.0 else []
        self.words += words or []

    def turn_and_move(self, rng: Random) -> Placement:
        for verb in rng.sample(("rotate", "move", "rotate"), rng.randint(0, 3)):
            if verb == "move":
                way = 1e-3 * direction(rng)
                self.shift += way
                self.words.append("move " + " ".join(repr(float(c)) for c in way))
            else:
                axis, angle = direction(rng), rng.uniform(-180, 180)
                self.words.append("rotate axis " + " ".join(repr(float(c)) for c in axis) + f" angle {angle!r}")
                a, K = np.radians(angle), np.cross(axis, np.eye(3)).T
                turn = np.eye(3) + np.sin(a) * K + (1 - np.cos(a)) * K @ K  # Rodrigues
                self.matrix, self.shift = turn @ self.matrix, turn @ self.shift
        return self

    def of(self, points: np.ndarray) -> np.ndarray:
        return points @ self.matrix.T + self.shift


def largest_ball(point: np.ndarray, normal: np.ndarray, cloud: np.ndarray) -> float:
    """Radius of the largest ball in front of a point that holds no point of the cloud."""
    way = cloud - point
    height, square = way @ normal, np.einsum("ij,ij->i", way, way)
    ahead = height > 1e-3 * np.sqrt(square)
    return float((square[ahead] / (2 * height[ahead])).min()) if ahead.any() else np.inf


def on_triangles(triangles: np.ndarray, outward: bool):
    """Sites all over triangles [n][3][3], by area."""
    span = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    area = np.linalg.norm(span, axis=1)
    share = np.cumsum(area) / area.sum()
    fill = np.random.default_rng(1)
    some = np.searchsorted(share, fill.random(4000))
    corners = fill.dirichlet((1, 1, 1), 4000)
    cloud = np.concatenate([triangles.reshape(-1, 3), np.einsum("ik,ikj->ij", corners, triangles[some])])

    def site(rng: Random) -> Site:
        k = int(np.searchsorted(share, rng.random()))
        u, v = sorted((rng.random(), rng.random()))
        point = np.array((u, v - u, 1 - v)) @ triangles[k]
        normal = span[k] / area[k] * (1 if outward else rng.choice((1, -1)))
        return Site(point, normal, (largest_ball(point, normal, cloud), largest_ball(point, -normal, cloud)))

    return site


def stl_text(triangles: np.ndarray) -> str:
    lines = ["solid wall"]
    for corners in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {!r} {!r} {!r}".format(*map(float, c)) for c in corners]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid wall"]) + "\n"


def of_triangles(kind: str, triangles: np.ndarray, rng: Random, outward: bool) -> Wall:
    """Triangles about SIZE large, in a file of other units now and then."""
    scale = rng.choice((1.0, 1e-3, 0.0254))
    placement = Placement(scale).turn_and_move(rng)
    in_file = triangles / scale
    return Wall(
        kind, stl_text(in_file), on_triangles(placement.of(in_file), outward), surface="all", name="wall.stl",
        placement=" ".join(placement.words), outward=outward, slots=24,
    )


def hull_of(points: np.ndarray) -> np.ndarray:
    """The triangles of a convex hull, seen from outside."""
    hull = ConvexHull(points)
    triangles = points[hull.simplices]
    inside = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    flipped = np.einsum("ij,ij->i", inside, hull.equations[:, :3]) < 0
    triangles[flipped] = triangles[flipped][:, ::-1]
    return triangles


def hull(rng: Random) -> Wall:
    """A convex body with 8 to 24 corners; balls are outside, or inside, where each of its faces is a wall of its own."""
    points = np.array([SIZE * rng.uniform(0.8, 1.0) * direction(rng) for _ in range(rng.randint(8, 24))])
    triangles = hull_of(points)
    if rng.random() < 0.4:
        triangles = triangles[:, ::-1]
    return of_triangles("hull", triangles, rng, True)


def lump(rng: Random) -> Wall:
    """A bumpy ball of 100 to 700 triangles; none are in a plane."""
    directions = np.array([direction(rng) for _ in range(rng.randint(50, 350))])
    waves = [(direction(rng), rng.uniform(1, 3), rng.uniform(0, 6.28)) for _ in range(4)]
    height = 1 + 0.06 * sum(np.sin(k * directions @ d * 3 + phase) for d, k, phase in waves)
    simplices = hull_of(directions)
    radius = {tuple(d): h for d, h in zip(directions, height)}
    triangles = np.array([[SIZE * 0.8 * radius[tuple(c)] * c for c in t] for t in simplices])
    return of_triangles("lump", triangles, rng, False)


def folded_sheet(rng: Random) -> Wall:
    """A grid of heights with free borders; some of its cells are in one plane, its triangles look to either side."""
    n, m = rng.randint(2, 9), rng.randint(2, 9)
    xs, ys = (np.sort([-1, 1, *(rng.uniform(-0.9, 0.9) for _ in range(k - 1))]) * SIZE for k in (n, m))
    heights = np.array([[rng.choice((0.0, 0.0, rng.uniform(-1, 1))) for _ in ys] for _ in xs]) * rng.choice((0.0, 0.05, 0.2)) * SIZE
    corner = lambda i, j: np.array((xs[i], ys[j], heights[i, j]))  # noqa: E731
    triangles = []
    for i in range(n):
        for j in range(m):
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
            pairs = ((a, b, c), (a, c, d)) if rng.random() < 0.5 else ((a, b, d), (b, c, d))
            triangles += [t if rng.random() < 0.8 else t[::-1] for t in pairs]
    return of_triangles("sheet", np.array(triangles), rng, False)


def have_cad() -> bool:
    return "MAKE_STEP_PARTS" in os.environ


def cad_part(rng: Random) -> Wall:
    """A STEP file, made about SIZE large; sites are on triangles within 1e-4 of its size."""
    name, maker = rng.choice(CAD) + ".step", os.environ["MAKE_STEP_PARTS"]
    with TemporaryDirectory() as folder:
        subprocess.run([maker, folder, name], check=True, capture_output=True)

        def meshed(deviation: float) -> np.ndarray:
            subprocess.run([maker, "--stl", f"{folder}/{name}", repr(deviation), f"{folder}/x.stl"], check=True, capture_output=True)
            return read_stl(open(f"{folder}/x.stl", "rb").read())

        extent = np.ptp(meshed(1.0).reshape(-1, 3), axis=0).max()
        triangles = 1e-3 * meshed(2e-4 * extent)  # OpenCASCADE's millimetres; the deck is in metres
        with open(f"{folder}/{name}", "rb") as file:
            content = file.read()
    scale = 2 * SIZE / (1e-3 * extent)
    middle = 0.5 * scale * (triangles.reshape(-1, 3).min(axis=0) + triangles.reshape(-1, 3).max(axis=0))
    placement = Placement(scale, ["move " + " ".join(repr(float(-c)) for c in middle)])
    placement.shift -= middle
    placement.turn_and_move(rng)
    return Wall(
        "part " + name, content, on_triangles(placement.of(triangles), True), surface="all", name="wall.step",
        placement=" ".join(placement.words), outward=True, slots=24,
    )


def read_stl(content: bytes) -> np.ndarray:
    """Triangles [n][3][3] of an ASCII or binary file."""
    if content[:5] == b"solid" and b"vertex" in content:
        numbers = [line.split()[1:] for line in content.decode().splitlines() if line.split()[:1] == ["vertex"]]
        return np.array(numbers, dtype=float).reshape(-1, 3, 3)
    records = np.frombuffer(content[84:], dtype=np.dtype([("n", "<f4", 3), ("x", "<f4", (3, 3)), ("a", "<u2")]))
    return records["x"].astype(float)


TRIANGLES = (hull, lump, folded_sheet)

# SPDX-License-Identifier: GPL-2.0-or-later
"""nurbs-convert given STL files that are written here: numbers of solids that are known from geometry."""

import math
import struct
import unittest

from convert_case import ConvertCase

SQUARES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]  # corner x + 2 y + 4 z


def box(low: float, high: float) -> list[tuple]:
    """12 triangles, normals outwards."""
    corners = [(x, y, z) for z in (low, high) for y in (low, high) for x in (low, high)]
    return [tuple(corners[i] for i in t) for a, b, c, d in SQUARES for t in ((a, b, c), (a, c, d))]


def ascii_stl(**solids: list[tuple]) -> str:
    text = ""
    for name, triangles in solids.items():
        facets = ("".join(f"vertex {x} {y} {z}\n" for x, y, z in corners) for corners in triangles)
        text += f"solid {name}\n" + "".join(f"facet normal 0 0 0\nouter loop\n{f}endloop\nendfacet\n" for f in facets) + "endsolid\n"
    return text


def binary_stl(triangles: list[tuple]) -> bytes:
    bodies = (struct.pack("<12fH", 0, 0, 0, *(x for corner in corners for x in corner), 7) for corners in triangles)
    return b"solid of a program".ljust(80) + struct.pack("<I", len(triangles)) + b"".join(bodies)


class Stl(ConvertCase):
    def printed(self, **solids: list[tuple]) -> str:
        return self.convert(self.write("part.stl", ascii_stl(**solids)))

    def test_cube(self):
        (self.folder / "cube.STL").write_bytes(binary_stl(box(0, 2)))
        for printed in (self.printed(cube=box(0, 2)), self.convert("cube.STL", "--units", "cgs")):
            self.assertIn("all patches: 12, 8 points; left out: 0 without an area, 0 that lie twice\n", printed)
            self.assertIn("  6 plane faces; edges: 12 convex, 0 concave, 0 smooth, 0 free, 0 of more than two faces\n", printed)
            self.assertIn("  area 24, closed, volume 8\n", printed)
            self.assertIn("height 1.41; 0 are thinner than 1e-6 of the whole\n  gaps: none\n  overlaps: none\n", printed)
        self.assertIn("units cgs, 1 patch\npatch 0: 12 triangles, 8 points within x 0 to 2, y 0 to 2, z 0 to 2\n", printed)
        self.assertIn("worst triangle: triangle 1 of patch 0", printed)

    def test_cavity_and_names(self):
        printed = self.printed(shell=box(0, 2), cavity=[t[::-1] for t in box(0.5, 1.5)])
        self.assertIn("  12 plane faces; edges: 12 convex, 12 concave, 0 smooth,", printed)
        self.assertIn("  area 30, closed, volume 7\n", printed)
        self.assertIn("surface 'cavity': 1\nsurface 'shell': 0\n", printed)
        alone = self.convert("part.stl", "--surface", "cavity")
        self.assertIn("  area 6, closed, volume 1, normals inwards\n", alone)
        self.assertNotIn("shell", alone)

    def test_shells(self):
        """A cavity points inwards, what floats in it outwards; else the volume is a difference without a meaning."""
        turned = [t[::-1] for t in box(4, 5)]
        self.assertIn("volume 9\n  shells: 2\n", self.printed(one=box(0, 2), other=box(4, 5)))
        self.assertIn(
            "volume 7\n  shells: 2; 1 inside out, whose volume counts with the wrong sign:\n    from (4, 4, 4) to (5, 5, 5), volume 1\n",
            self.printed(one=box(0, 2), other=turned),
        )
        cavity = [t[::-1] for t in box(1, 3)]
        self.assertIn("volume 56.125\n  shells: 3\n", self.printed(outer=box(0, 4), cavity=cavity, core=box(1.5, 2)))
        self.assertIn("volume 72\n  shells: 2; 1 inside out", self.printed(outer=box(0, 4), cavity=box(1, 3)))
        inwards = self.printed(one=[t[::-1] for t in box(0, 2)], other=turned)
        self.assertIn("volume 9, normals inwards\n  shells: 2\n", inwards)
        self.assertNotIn("shells", self.printed(one=box(0, 2)))

    def test_triangles_that_are_turned_over(self):
        cube = box(0, 2)
        self.assertIn("  area 24, closed, volume 8, normals inwards\n", self.printed(cube=[t[::-1] for t in cube]))
        one_side = [t[::-1] if i < 2 else t for i, t in enumerate(cube)]
        self.assertIn("  area 24, closed, but turned in and out: no volume\n", self.printed(cube=one_side))

    def test_holes_and_overlaps(self):
        cube = box(0, 2)
        printed = self.printed(cube=[*cube[1:], cube[4], (cube[5][0], cube[5][1], cube[5][1])])
        self.assertIn("left out: 1 without an area, 1 that lie twice\n", printed)
        self.assertIn("3 free, 0 of more than two faces\n  area 22, open: no volume\n", printed)
        self.assertIn("  gaps: 1\n    3 free sides of triangles, length 6.82843, one at line ", printed)

    def test_a_patch_and_a_plate_through_a_cube(self):
        patch = [((0.3, 0.1, 2), (0.9, 0.1, 2), (0.9, 0.3, 2))]  # on z = 2, whose diagonal is x = y
        through = [((0.4, 0.8, -1), (0.6, 0.8, -1), (0.5, 0.9, 1))]
        printed = self.printed(cube=box(0, 2), patch=patch, through=through)
        self.assertIn("\n  overlaps:\n    1 pair of triangles in one plane cover each other (contacts there may count twice)", printed)
        self.assertIn(", one at line 16 of patch 0 and line 88 of patch 1\n", printed)
        self.assertIn("    1 pair of triangles pierce each other, one at line 2 of patch 0 and line 97 of patch 2\n", printed)

    def test_a_facetted_cylinder_stays_facetted(self):
        n = 24
        rim = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n)) for i in range(n + 1)]
        strips = [((*a, 0), (*b, 0), (*b, 1)) for a, b in zip(rim, rim[1:])] + [((*a, 0), (*b, 1), (*a, 1)) for a, b in zip(rim, rim[1:])]
        printed = self.printed(pipe=strips)
        self.assertIn(f"  {n} plane faces; edges: {n} convex, 0 concave, 0 smooth, {2 * n} free", printed)
        self.assertIn("  gaps: 2\n", printed)
        self.assertIn(f"  area {2 * n * math.sin(math.pi / n):.6g}, open: no volume\n", printed)


if __name__ == "__main__":
    unittest.main()

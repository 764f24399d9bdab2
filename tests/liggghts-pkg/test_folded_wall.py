# SPDX-License-Identifier: GPL-2.0-or-later
"""A trough given as one patch that turns inside: the same run as on planes by words and on triangles of an STL file, at rest
and turned, with particles that are changed between runs, on ranks and after a restart."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import decks
from prelude import INTEGRATION, Prelude

# Profile in x and z: rims, floors, a ridge between them; along y it is 40 mm long.
PROFILE = [(-0.02, 0.012), (-0.018, 0.0), (-0.006, -0.001), (0.0, 0.004), (0.006, -0.001), (0.018, 0.0), (0.02, 0.012)]
ROWS = (-0.02, 0.0, 0.02)
SOURCES = {"patch": "patch.yaml surface wall", "planes": "planes.yaml surface wall", "triangles": "wall.stl surface all"}


def patch() -> str:
    points = ", ".join(f"[{x}, {y}, {z}]" for y in ROWS for x, z in PROFILE)
    knots = [[0, *range(n), n - 1] for n in (len(PROFILE), len(ROWS))]
    entry = f"{{degrees: [1, 1], knots: {knots}, control_points: [{points}]}}"
    return f"units: si\ngeometry:\n  patches:\n    - {entry}\nsurfaces: {{wall: all}}\n"


def planes() -> str:
    lines = ["units: si", "geometry:", "  shapes:"]
    for (x, z), (x1, z1) in zip(PROFILE, PROFILE[1:]):
        edges = f"[[{x1 - x!r}, 0, {z1 - z!r}], [0, {ROWS[-1] - ROWS[0]}, 0]]"
        lines.append(f"    - plane: {{origin: [{x}, {ROWS[0]}, {z}], edges: {edges}, elements: [1, 1], degree: 1}}")
    return "\n".join(lines) + "\nsurfaces: {wall: all}\n"


def triangles() -> str:
    lines = ["solid wall"]
    for (x, z), (x1, z1) in zip(PROFILE, PROFILE[1:]):
        a, b, c, d = (x, ROWS[0], z), (x1, ROWS[0], z1), (x1, ROWS[-1], z1), (x, ROWS[-1], z)
        for corners in ((a, b, c), (a, c, d)):
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += ["vertex {} {} {}".format(*corner) for corner in corners] + ["endloop", "endfacet"]
    return "\n".join(lines) + "\nendsolid wall\n"


FILES = {"patch.yaml": patch(), "planes.yaml": planes(), "wall.stl": triangles()}
CHANGED = "run 5000\nset atom 5 diameter 0.0024\nset group all density 2400\nvelocity all set 0.3 -0.2 -0.4\nrun 5000\n"
TURNED = "motion rotate origin 0 0 0 axis 0 1 0 period 0.4"


def deck(source: str, words: str = "", processors: str = "", restart: str = "") -> str:
    start = Prelude(
        "-0.025 0.025 -0.02 0.02 -0.01 0.03", E=(5e6,), nu=(0.3,), e=0.6, mu=0.4, timestep=2e-6, skin=5e-4, lists="delay 0",
        processors=processors,
    )
    lines = [start.again(restart) if restart else start.text()]
    if not restart:
        places = [(0.0045 * i + 0.0007 * j, 0.0045 * j) for i in range(-3, 4) for j in range(-3, 4)]
        lines += ["create_atoms 1 single {:g} {:g} 0.0085 units box".format(*place) for place in places]
        lines += ["set group all diameter 0.002 density 2500", "velocity all set 0.1 0.05 -0.8"]
    lines += [
        INTEGRATION + f"fix wall all wall/nurbs model hertz tangential history type 1 geometry {SOURCES[source]} contacts 8 {words}",
        "fix g all gravity 9.81 vector 0 0 -1",
        "compute high all reduce sum z",
        "thermo_style custom step ke c_high f_wall[1] f_wall[2] f_wall[3] f_wall[7]",
        "thermo_modify format float %.17g lost error norm no",
        "thermo 50",
    ]
    return "\n".join(lines) + "\n"


class FoldedWall(unittest.TestCase):
    def expect_same(self, one, other, tolerance: float) -> None:
        self.assertEqual(list(one), list(other))
        for column in one:
            scale = np.abs(one[column]).max()
            np.testing.assert_allclose(other[column], one[column], rtol=0, atol=tolerance * scale, err_msg=column)

    def test_it_is_planes_and_triangles_at_rest_and_turned(self):
        for words in ("", TURNED):
            patch, planes, stl = (
                decks.good(deck(source, words) + CHANGED, files=FILES).table for source in ("patch", "planes", "triangles")
            )
            self.assertGreaterEqual(patch["wall[7]"].max(), 4)
            self.expect_same(patch, planes, 1e-11)
            self.expect_same(patch, stl, 1e-11)

    def test_ranks_and_restart(self):
        two = decks.good(deck("patch", processors="2 1 1") + "run 5000\n", files=FILES, ranks=2).table
        with tempfile.TemporaryDirectory() as folder:
            for name, text in FILES.items():
                (Path(folder) / name).write_text(text)
            first = decks.run_in(Path(folder), deck("patch") + "run 5000\nwrite_restart half\nrun 1000\n")
            again = decks.run_in(Path(folder), deck("patch", restart="half") + "run 1000\n")
        self.assertEqual((first.code, again.code), (0, 0), first.text[-1000:] + again.text[-1000:])
        for column in ("wall[1]", "wall[2]", "wall[3]", "wall[7]"):
            self.assertTrue((first.tables[0][column] == two[column]).all(), column)
        for column, values in again.table.items():
            self.assertTrue((values == first.tables[1][column]).all(), column)


if __name__ == "__main__":
    unittest.main()

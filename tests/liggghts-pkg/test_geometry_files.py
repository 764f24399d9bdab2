# SPDX-License-Identifier: GPL-2.0-or-later
"""One wall, and one solid, from a file of each format: the balls move the same way to the last bit, on 1 and 2 ranks.
The files are written here, from one list of numbers, by h5py and as plain text."""

import io
import unittest

import h5py
import numpy as np

import ball_on_block as bob
import decks

DEGREES = [2, 2]
KNOTS = [[0, 0, 0, 0.4, 1, 1, 1], [0, 0, 0, 0.5, 1, 1, 1]]
XY = np.array([-0.01, -0.004, 0.004, 0.01])
HEIGHTS = 1e-4 * np.array([[0, 1, -1, 0], [2, -1, 1, 1], [0, 1, 2, -1], [1, 0, 0, 1]])
POINTS = np.array([[[x, y, z] for x, z in zip(XY, row)] for y, row in zip(XY, HEIGHTS)])  # [n_eta][n_xi][3]
WEIGHTS = np.array([[1, 1.5, 0.8, 1], [1, 1, 1.2, 1], [0.7, 1, 1, 1], [1, 1, 1.1, 1]])


def yaml_file() -> str:
    points = POINTS.reshape(-1, 3).tolist()
    return (
        f"units: si\ngeometry:\n  patches:\n    - degrees: {DEGREES}\n      knots: {KNOTS}\n"
        f"      control_points: {points}\n      weights: {WEIGHTS.ravel().tolist()}\nsurfaces: {{all: all}}\n"
    )


def xml_file() -> str:
    def text(numbers) -> str:
        return " ".join(map(repr, np.ravel(numbers).tolist()))

    bases = "".join(
        f'<Basis type="BSplineBasis"><KnotVector degree="{degree}">{text(knots)}</KnotVector></Basis>'
        for degree, knots in zip(DEGREES, KNOTS)
    )
    return (
        '<xml><Geometry type="TensorNurbs2" id="0"><Basis type="TensorNurbsBasis2">'
        f'<Basis type="TensorBSplineBasis2">{bases}</Basis><weights>{text(WEIGHTS)}</weights></Basis>'
        f'<coefs geoDim="3">{text(POINTS)}</coefs></Geometry></xml>'
    )


def hdf5_file(degrees, knots, points, weights=None, units="si") -> bytes:
    buffer = io.BytesIO()
    with h5py.File(buffer, "w") as file:
        file.attrs["format"], file.attrs["version"], file.attrs["units"] = "nurbs-geometry", 1, units
        patch = file.create_group("patches/0")
        patch.attrs["degrees"] = degrees
        for name, values in zip(("knots_xi", "knots_eta", "knots_zeta"), knots):
            patch[name] = values
        patch["control_points"] = points
        if weights is not None:
            patch["weights"] = weights
        file["surfaces/all" if len(degrees) == 2 else "surfaces/top"] = ["all" if len(degrees) == 2 else "zeta+"]
    return buffer.getvalue()


def wall_file(units: str = "si") -> bytes:
    return hdf5_file(DEGREES, KNOTS, POINTS, WEIGHTS, units)


def motion(wall: str, files: dict, ranks: int, **options) -> dict[str, np.ndarray]:
    deck = bob.prelude(velocity=(0.3, 0.2, -1.0), timestep=5e-8, friction=0.3, **options)
    deck += f"fix plate all wall/nurbs model hertz tangential no_history type 2 {wall}\n" + bob.output(columns=(1, 2, 3))
    return decks.good(deck + "run 2000\n", files=files, ranks=ranks).table


class GeometryFiles(unittest.TestCase):
    def assert_same(self, ours: dict[str, np.ndarray], reference: dict[str, np.ndarray]) -> None:
        self.assertGreater(np.abs(reference["fz"]).max(), 0.1)
        for name, column in reference.items():
            self.assertTrue(np.array_equal(ours[name], column), name)

    def test_rigid_wall(self):
        ball = {"balls": ((0.001, 0.0005, 0.00108),)}
        files = {
            "wall.yaml": yaml_file(),
            "wall.xml": xml_file(),
            "wall.h5": wall_file(),
            "named.yaml": "units: si\ngeometry: {file: wall.xml}\nsurfaces: {floor: 0}\n",
        }
        reference = motion("geometry wall.yaml surface all", files, 1, **ball)
        for wall in ("wall.xml surface all", "wall.h5 surface all", "named.yaml surface floor"):
            for ranks in (1, 2):
                with self.subTest(wall, ranks=ranks):
                    self.assert_same(motion(f"geometry {wall}", files, ranks, **ball), reference)

    def test_two_patches_are_one_wall(self):
        """A ball strikes a plane on the border of its two patches, which are one named surface of a G+Smo file."""
        basis = '<Basis type="BSplineBasis"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>'
        patches = "".join(
            f'<Geometry type="TensorBSpline2" id="{p}"><Basis type="TensorBSplineBasis2">{basis}{basis}</Basis>'
            f'<coefs geoDim="2">{x} -0.01 {x + 0.01} -0.01 {x} 0.01 {x + 0.01} 0.01</coefs></Geometry>'
            for p, x in enumerate((-0.01, 0.0))
        )
        plane = "plane: {origin: [-0.01, -0.01, 0], edges: [[0.02, 0, 0], [0, 0.02, 0]], elements: [3, 2], degree: 1}"
        files = {
            "two.xml": f'<xml>{patches}<MultiPatch parDim="2" label="floor"><patches type="id_range">0 1</patches></MultiPatch></xml>',
            "one.yaml": f"units: si\ngeometry: {{{plane}}}\nsurfaces: {{floor: all}}\n",
        }
        ball = {"balls": ((-3e-6, 0.0005, 1.001e-3),)}  # at 0.3 m/s it crosses the border while in contact
        one = motion("geometry one.yaml surface floor", files, 1, **ball)
        two = motion("geometry two.xml surface floor", files, 1, **ball)
        touching = one["fz"] > 0.0
        self.assertLess(one["x"][touching].min(), 0.0)
        self.assertGreater(one["x"][touching].max(), 0.0)
        for name, column in one.items():
            self.assertLess(decks.largest_difference(two[name], column), 1e-11, name)

    def test_solid(self):
        """A block of one element per direction as a box, and as a file of trilinear control points."""
        block = bob.block(elements=(1, 1, 1)).replace("degree: 2", "degree: 1")
        x, y, z = (-2e-3, 2e-3), (-2e-3, 2e-3), (-2e-3, 0.0)
        points = [[[[a, b, c] for a in x] for b in y] for c in z]
        knots = [[0, 0, 1, 1]] * 3
        begin, end = block.index("  box:"), block.index("material:")
        other = block[:begin] + "  file: block.h5\n" + block[end:].replace("surfaces: {top: zeta+}\n", "")
        files = {"box.yaml": block, "other.yaml": other, "block.h5": hdf5_file([1, 1, 1], knots, points)}
        reference = motion("structure box.yaml surface top", files, 1)
        for ranks in (1, 2):
            self.assert_same(motion("structure other.yaml surface top", files, ranks), reference)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""iga-solve on several ranks writes the histories of one rank to the last bit, in every way to integrate; some ranks have
nothing to do.  A fault is told once, by one of them."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

PROGRAM = os.environ["IGA_SOLVE"]
MPIEXEC = os.environ["MPIEXEC"]
# 2 x 3 x 1 boxes, held on one side, loaded, and thrown
PLATE = """units: si
geometry: {{box: {{origin: [0, 0, 0], size: [0.04, 0.036, 0.004], elements: {elements}, degree: {degree}}}}}
material: {{law: {law}, youngs_modulus: 7.4e10, poissons_ratio: 0.23, density: 2480}}
integration: {{method: {method}, quadrature: {quadrature}}}
boundary: [{{fix: [x, y, z], faces: [xi-]}}]
probes: {{tip: {{face: xi+, at: [0.5, 0.47]}}, corner: {{face: zeta+, at: [0, 1]}}}}
output: {{every: 1e-9, file: plate}}
loads: {{gravity: [0, 0, -9.81], tractions: [{{face: zeta+, value: [0, 0, -1e8]}}]}}
initial: {{velocity: [1, 0, -10]}}
time: {{end: {end}}}
"""


def plate(elements="[40, 36, 2]", degree=2, law="saint_venant_kirchhoff", method="auto", quadrature="full", end=2e-6):
    return PLATE.format(elements=elements, degree=degree, law=law, method=method, quadrature=quadrature, end=end)


def solve(model: str, ranks: int, *words: str, before: tuple[str, ...] = ()) -> tuple[subprocess.CompletedProcess, dict]:
    """`before`: words in front of the program's name."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "plate.yaml").write_text(model)
        done = subprocess.run(
            [MPIEXEC, "-n", str(ranks), *before, PROGRAM, "plate.yaml", *words], cwd=folder, capture_output=True, text=True, timeout=60,
            check=False,
        )  # fmt: skip
        series = {}
        if done.returncode == 0:
            with h5py.File(Path(folder) / "plate.h5") as file:
                file.visititems(lambda name, item: series.__setitem__(name, item[...]) if hasattr(item, "shape") else None)
        return done, series


class Ranks(unittest.TestCase):
    def check(self, model: str, *counts: int) -> None:
        done, one = solve(model, 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(one["time"]), 5)
        self.assertGreater(numpy.abs(one["probes/tip"]).max(), 1e-6, "it moves")
        for ranks in counts:
            more, series = solve(model, ranks)
            self.assertEqual(more.returncode, 0, more.stderr)
            self.assertEqual(more.stdout, done.stdout)
            self.assertEqual(set(series), set(one))
            for name, values in one.items():
                self.assertTrue(numpy.array_equal(series[name], values), f"{name} on {ranks} ranks, to the last bit")

    def test_sweeps(self):
        self.check(plate(), 2, 3, 4)

    def test_more_ranks_than_boxes(self):
        self.check(plate(end=1e-6), 8)

    def test_tables_and_fewer_points(self):
        self.check(plate(method="stored", quadrature="reduced", law="linear_elastic"), 4)

    def test_plain_loop(self):
        self.check(plate(method="elements", elements="[34, 34, 1]", end=1e-6), 4)

    def test_an_error_is_told_once(self):
        done, _ = solve(plate(), 3, "--step", "1")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("ERROR"), 1, done.stderr)
        self.assertIn("above the stable step", done.stderr)

    def test_a_solid_that_blows_up_is_told_of_in_the_same_words(self):
        model = plate().replace("-1e8", "-1e13")
        told = [solve(model, ranks)[0].stderr.splitlines()[0] for ranks in (1, 2, 4)]
        self.assertRegex(told[0], "blown up at time .* at control node [0-9]+, undeformed at .*element [0-9]+ .*is folded")
        self.assertEqual(told[1:], 2 * told[:1])

    def test_masses_too_small_for_a_number_on_one_rank(self):
        knots = [0, 0, 0, 0.5, 1, 1, 1]
        places = [0, 0.25, 0.75, 1]

        def patch(x: int) -> str:
            points = [[1e-80 * a for a in (x + k, j, i)] for i in places for j in places for k in places]
            return f"  - {{degrees: [2, 2, 2], knots: {3 * [knots]}, control_points: {points}}}\n"

        law = "law: linear_elastic, youngs_modulus: 1, poissons_ratio: 0"
        model = f"units: si\ngeometry:\n  patches:\n{patch(0)}{patch(1)}time: {{end: 1}}\nmaterial:\n"
        model += f"  - {{patches: [0], {law}, density: 1e-90}}\n  - {{patches: [1], {law}, density: 1e90}}\n"
        done, _ = solve(model, 2)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("ERROR"), 1, done.stderr)
        self.assertIn("check the density and the units of lengths", done.stderr)

    def test_memory_that_ends_on_one_rank(self):
        """Its part does not fit, or memory ends while it is built: the others do not wait for it."""
        big = plate(elements="[64, 120, 9]", method="elements", end=1e-9)  # tables of 640 MB for each of two ranks
        for megabytes in (600, 800):
            limit = f'[ "$OMPI_COMM_WORLD_RANK" = 1 ] && ulimit -v {1000 * megabytes}; exec "$0" "$@"'
            done, _ = solve(big, 2, before=("bash", "-c", limit))
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(done.stderr.count("ERROR"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""`structure FILE state STATE`: decks that start from what `iga-solve` has found at rest stay there; a ball that rests on the
block it has pressed in, beside a closed form and an independent code."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
from prelude import INTEGRATION, Prelude, create

IGA_SOLVE = os.environ.get("IGA_SOLVE", "iga-solve")
# a ball of 2 mm pressed on a knot corner of a block of cubes of 1 mm: overlap of Hertz, and how far the block's mesh gives way
RADIUS, FORCE, OVERLAP, GIVES_WAY = 2e-3, 0.05, 19.275108e-6, 3.433624e-6
STEP = 2e-6
PRESSED = """units: si
geometry: {box: {origin: [-4e-3, -4e-3, -6e-3], size: [9e-3, 9e-3, 6e-3], elements: [9, 9, 6], degree: 2}}
material: {law: linear_elastic, youngs_modulus: 10e6, poissons_ratio: 0.286, density: 1000}
boundary: [{name: base, fix: [x, y, z], faces: [zeta-]}]
surfaces: {top: zeta+}
probes: {foot: {face: zeta+, at: [0.4444444444444444, 0.4444444444444444]}}
"""
LOAD = "loads: {points: [{face: zeta+, at: [0.4444444444444444, 0.4444444444444444], force: [0, 0, -0.05]}]}\n"
SAVE = "analysis: {kind: static, save: rest.h5}\n"
START = "structure block.yaml state rest.h5 surface top"
UNCORRECTED = " compliance none"  # as that mesh is


def found(model: str) -> bytes:
    """The state that the analysis in a model saves."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "block.yaml").write_text(model)
        subprocess.run([IGA_SOLVE, "block.yaml", "--quiet"], cwd=folder, check=True, timeout=60)
        return (Path(folder) / "rest.h5").read_bytes()


def pressed_ball(words: str, z: float = RADIUS - OVERLAP - GIVES_WAY, more: str = "", steps: int = 500) -> str:
    models = "model hertz tangential no_history"
    box = "-0.01 0.01 -0.01 0.01 -0.01 0.01"
    return (
        Prelude(box, E=(100e6, 10e6), nu=(0.3, 0.286), models=models, timestep=STEP).text()
        + create((0.0, 0.0, z))
        + f"set group all diameter {2 * RADIUS} density 2500\nfix push all addforce 0 0 {-FORCE}\n" + more
        + INTEGRATION + bob.wall(models, words) + bob.output((3, 9, 10, 11, 15, 20, 26, 27, 28)) + f"run {steps}\n"
    )  # fmt: skip


class State(unittest.TestCase):
    def test_a_ball_rests_where_it_has_pressed_the_block_in(self):
        files = {"block.yaml": PRESSED, "rest.h5": found(PRESSED + LOAD + SAVE)}
        table = decks.good(pressed_ball(START + UNCORRECTED), files=files).table
        np.testing.assert_allclose(-table["plate3"], FORCE, rtol=3e-3)
        np.testing.assert_allclose(table["plate28"], FORCE, rtol=3e-3)
        np.testing.assert_allclose(-table["plate20"], GIVES_WAY, rtol=3e-3)
        flat = decks.good(pressed_ball("structure block.yaml surface top" + UNCORRECTED), files={"block.yaml": PRESSED}).table
        self.assertGreater(np.ptp(flat["plate3"]), 0.3 * FORCE, "without the state it swings")

    def test_the_same_by_relax(self):
        files = {"block.yaml": PRESSED, "rest.h5": found(PRESSED + LOAD + SAVE.replace("static", "relax, tolerance: 1e-5"))}
        table = decks.good(pressed_ball(START + UNCORRECTED, steps=100), files=files).table
        for column, value in (("plate3", -FORCE), ("plate28", FORCE), ("plate20", -GIVES_WAY)):
            np.testing.assert_allclose(table[column], value, rtol=3e-3)

    def test_the_same_by_damping(self):
        """From where ball and block just touch, both damped, to rest."""
        damped = PRESSED + "damping: {mass: 8000}\n"
        deck = pressed_ball("structure block.yaml surface top" + UNCORRECTED, RADIUS, "fix slow all viscous 0.8\n", 4000)
        table = decks.good(deck, files={"block.yaml": damped}).table
        sinks = RADIUS - table["z"]
        self.assertGreater(np.ptp(sinks), OVERLAP)
        for seen, value in (
            (sinks, OVERLAP + GIVES_WAY), (-table["plate20"], GIVES_WAY), (-table["plate3"], FORCE), (table["plate28"], FORCE),
        ):  # fmt: skip
            np.testing.assert_allclose(seen[-100:], value, rtol=3e-3)

    def test_a_block_under_its_weight_stays_at_rest_on_any_number_of_ranks(self):
        """From the deck's word, or from the model's key; the word counts."""
        sagging = bob.block() + "loads: {gravity: [0, 0, -1e5]}\n"
        files = {"rest.h5": found(sagging + SAVE), "other.h5": found(sagging.replace("1e5", "2e5") + SAVE)}
        sag = {}
        for name, model, words, ranks in (
            ("word", sagging, START, 1),
            ("ranks", sagging, START, 2),
            ("key", sagging + "state: rest.h5\n", "structure block.yaml surface top", 1),
            ("both", sagging + "state: other.h5\n", START, 1),
            ("modes", sagging, START.replace("state", "body modal 20 state"), 1),
        ):
            deck = bob.prelude(balls=((0, 0, 4e-3),)) + bob.wall(rest=words) + bob.output((11, 15, 16, 20)) + "run 300\n"
            with self.subTest(name):
                table = decks.good(deck, files={"block.yaml": model, **files}, ranks=ranks).table
                self.assertLess(table["plate15"].max(), (1e-10 if name == "modes" else 1e-12) * table["plate16"][0])
                np.testing.assert_allclose(table["plate20"], table["plate20"][0], rtol=1e-6)
                sag[name] = table["plate20"]
        for name in ("ranks", "key", "both"):
            np.testing.assert_array_equal(sag["word"], sag[name])

    def test_refusals(self):
        state = found(bob.block() + "loads: {gravity: [0, 0, -1e5]}\n" + SAVE)
        finer = bob.block(elements=(5, 4, 2))
        for words, model, expected in (
            (START.replace("rest", "none"), bob.block(), "none.h5"),
            (START.replace("rest.h5", "block.yaml"), bob.block(), "block.yaml"),
            (START, finer, "mesh and geometry are others"),
            (START, bob.block() + "output: {file: rest, every: 1e-4}\n", "rest.h5 is the file rest.h5 that the model is read from"),
            (START + " state rest.h5", bob.block(), "'state'"),
            (START.replace("state rest.h5", "state rest.h5 state rest.h5"), bob.block(), "'state' is given twice"),
            ("geometry block.yaml state rest.h5 surface top", bob.block(), "'state' is for a solid of ours, given 'geometry'"),
        ):
            with self.subTest(words):
                run = decks.run(bob.prelude() + bob.wall(rest=words) + "run 1\n", files={"block.yaml": model, "rest.h5": state})
                self.assertNotEqual(run.code, 0)
                self.assertIn(expected, " ".join(run.errors))


if __name__ == "__main__":
    unittest.main()

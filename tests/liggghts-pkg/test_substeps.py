# SPDX-License-Identifier: GPL-2.0-or-later
"""`substeps`: the glass ball on the thin glass plate of inputs/thin_plate (Z1) against the run without; restart within an
outer step, ranks, errors."""

import math
import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks

STUDY = Path(__file__).resolve().parents[2] / "inputs" / "thin_plate"
MASS = 2480.0 * 4.0 / 3.0 * math.pi * 1e-9
CONTACT = 6.9e-6  # duration of the contact of Z1 [s]


def thin_plate(words: str, timestep: float) -> dict[str, float]:
    """What the study's deck gives with these words; energies relative to the ball's."""
    steps = math.ceil(8e-6 / timestep / 20) * 20  # ends with an outer step
    deck = (STUDY / "in.thin_plate").read_text()
    deck = deck.replace("surface top\n", f"surface top {words}\n").replace("index 1.0e-8", f"index {timestep}")
    deck = deck.replace("index 800", f"index {steps}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "glass_26mm.yaml").write_text((STUDY / "glass_26mm.yaml").read_text())
        done = decks.run_in(folder, deck)
        if done.code != 0:
            raise AssertionError(done.text[-2000:])
        read = lambda file: np.atleast_1d(np.genfromtxt(folder / f"{file}.csv", delimiter=",", names=True))
        contact, state, energy = read("contact_force"), read("state"), read("energy")
    v, p = state["v"][-1], state["p"][-1]
    return {
        "force": contact["F"].max(),
        "deflection": np.abs(contact["plate_displacement"]).max(),
        "restitution": v,
        "energy": v * v + (energy["kinetic"][-1] + energy["strain"][-1]) / (0.5 * MASS) - 1.0,
        "momentum": v + p / MASS + 1.0,
        "text": done.text,
    }


class ThinPlate(unittest.TestCase):
    """The independent code on the same mesh gives 0.7619 and 4.876 N (inputs/thin_plate/README.md)."""

    @classmethod
    def setUpClass(cls):
        cls.plain = thin_plate("", 1e-8)

    def compare(self, words, timestep, *, energy, restitution, force=2e-3):
        run = thin_plate(words, timestep)
        for key, bound in (("force", force), ("deflection", 5e-3)):
            self.assertLess(abs(run[key] / self.plain[key] - 1.0), bound, (words, key))
        self.assertLess(abs(run["restitution"] - self.plain["restitution"]), restitution, words)
        self.assertLess(abs(run["energy"]), energy, words)
        self.assertLess(abs(run["momentum"]), 1e-12, words)
        return run["text"]

    def test_fast_particles(self):
        for count in (2, 5, 10):
            text = self.compare(f"substeps particles {count}", 1.2e-7 / count, energy=2e-4, restitution=1e-4)
            self.assertIn(f"substeps particles {count}: the structure takes one step of 1.2e-07", text)

    def test_fast_structure(self):
        for count in (2, 5, 10):
            self.compare(f"substeps structure {count}", CONTACT / 100, energy=1e-3, restitution=2e-4)

    def test_auto(self):
        text = self.compare("substeps auto", 1e-8, energy=1e-4, restitution=1e-4)
        self.assertRegex(text, r"substeps particles [5-9]: the structure takes one step of")


MODELS = "model hertz tangential history"
SETTINGS = dict(restitution=0.6, friction=0.3, models=MODELS, velocity=(0.5, 0.1, -1.0))
COLUMNS = (1, 3, 7, 11, 15, 16, 19, 20, 22, 23, 24)
STRUCTURE = "structure block.yaml surface top"
FILES = {"block.yaml": bob.block(elements=(4, 4, 2))}
WAYS = ("substeps particles 7", "substeps structure 3", "substeps auto")


def deck(words: str, runs: str, restart: str = "") -> str:
    prelude = bob.prelude(restart=restart, **SETTINGS)
    return prelude + bob.wall(MODELS, f"{STRUCTURE} {words}") + bob.output(COLUMNS) + runs


class Decks(unittest.TestCase):
    def test_restart_within_an_outer_step_is_bitwise(self):
        for words in WAYS:
            for before in (280, 283):
                with tempfile.TemporaryDirectory() as name:
                    folder = Path(name)
                    (folder / "block.yaml").write_text(FILES["block.yaml"])
                    first = decks.run_in(folder, deck(words, f"run {before}\nwrite_restart contact\nrun 60\n"))
                    second = decks.run_in(folder, deck(words, "run 60\n", restart="contact"))
                self.assertEqual((first.code, second.code), (0, 0), first.text[-500:] + second.text[-1500:])
                self.assertGreater(np.abs(first.tables[1]["fz"]).max(), 0.0)
                for key, values in second.tables[0].items():
                    self.assertTrue(np.array_equal(values, first.tables[1][key]), (words, before, key))

    def test_two_ranks_are_one_to_the_last_bit(self):
        for words in WAYS:
            one, two = (decks.good(deck(words, "run 300\n"), files=FILES, ranks=ranks).table for ranks in (1, 2))
            for key, values in one.items():
                self.assertTrue(np.array_equal(values, two[key]), (words, key))

    def test_errors(self):
        cases = {
            "substeps 0": ["substeps is '0'", "1 to 1000"],
            "substeps -3": ["substeps is '-3'"],
            "substeps many": ["substeps is 'many'", "'auto' or a number of steps"],
            "substeps particles": ["expected 'auto' or a number of steps"],
            "substeps particles 500": ["substeps particles 500", "above its stable step", "use at most"],
            "substeps structure 2\ntimestep 1e-6": ["substeps structure 2", "above its stable step", "use at least"],
            "substeps particles 7\nrun 3\ntimestep 2e-8": ["within an outer step of 7", "4 steps later"],
        }
        for words, expected in cases.items():
            done = decks.run(deck(words, "run 1\n"), files=FILES)
            self.assertNotEqual(done.code, 0, words)
            for part in expected:
                self.assertIn(part, done.errors[0], words)

    def test_a_rigid_wall_has_none(self):
        floor = deck("substeps 3", "run 1\n").replace("structure block.yaml", "geometry block.yaml")
        done = decks.run(floor, files=FILES)
        self.assertIn("'substeps' are those of a deforming wall", done.errors[0])


if __name__ == "__main__":
    unittest.main()

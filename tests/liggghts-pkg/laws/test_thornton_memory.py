# SPDX-License-Identifier: GPL-2.0-or-later
"""plastic/thornton remembers the largest overlap of a contact, over steps, ranks and restarts, and forgets it after."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import contact_deck
from contact_deck import PLASTIC, RADIUS, decks
import thornton

P_Y = 5e8
FLOOR = """
units: si
geometry:
  plane: {origin: [-0.008, -0.008, 0], edges: [[0.016, 0, 0], [0, 0.016, 0]], elements: [4, 4], degree: 2}
surfaces: {top: all}
"""
FILES = {"floor.yaml": FLOOR}
PLANE = thornton.Material(contact_deck.effective_modulus(1, 2), RADIUS, P_Y)
OTHER = contact_deck.OTHER_RADIUS
PAIR = thornton.Material(PLANE.E, RADIUS * OTHER / (RADIUS + OTHER), P_Y)

SPEED, DT = 1.0, 1e-8  # 100 steps are 1 um
# up to where [um of overlap], from no contact: a first loading, two reloadings, a deeper one, the end of the contact; then
# two more contacts
PATH = (3.0, 2.6, 3.0, 1.0, 4.0, 3.5, -0.5, 1.5, -3.0, 3.5, 2.0)


def nurbs(deck: str) -> str:
    """On a NURBS wall in place of LIGGGHTS' plane."""
    stock = f"wall/gran model {PLASTIC} primitive type 2 zplane 0."
    assert stock in deck
    return deck.replace(stock, f"wall/nurbs model {PLASTIC} type 2 geometry floor.yaml surface top")


def moved(deck: str, direction: tuple[float, float, float], group: str = "all") -> str:
    """The ball is moved along the path, towards the other body along `direction`; nobody else moves."""
    deck = deck.replace("fix integrate all nve/sphere", "")
    at = 0.0
    for to in PATH:
        sign = 1.0 if to > at else -1.0
        velocity = " ".join(repr(sign * SPEED * component) for component in direction)
        deck += f"fix drive {group} move linear {velocity} units box\nrun {round(100 * abs(to - at))}\nunfix drive\n"
        at = to
    return deck


def expected(material: thornton.Material, overlap: np.ndarray) -> np.ndarray:
    forces, d_max = [], 0.0
    for d in overlap:
        d_max = max(d, d_max) if d > 0 else 0.0
        forces.append(material.force(d, d_max) if d > 0 else 0.0)
    return np.array(forces)


class Reloading(unittest.TestCase):
    def check(self, material, force, overlap):
        reference = expected(material, overlap)
        self.assertEqual(np.count_nonzero(np.diff((overlap > 0).astype(int)) == 1), 3, "contacts")
        self.assertGreater(np.count_nonzero((overlap > 0) & (reference == 0.0)), 20, "apart within the overlap")
        # the overlap is a difference of coordinates: 1e-9 of it
        self.assertLess(abs(force - reference).max(), 1e-8 * reference.max())

    def test_walls(self):
        deck = contact_deck.ball_on_plane(f"model {PLASTIC}", yield_pressure=(P_Y, 1e30), dt=DT, velocity=(0, 0, 0))
        for name, wall in (("plane", lambda text: text), ("NURBS", nurbs)):
            with self.subTest(name):
                table = decks.good(moved(wall(deck), (0.0, 0.0, -1.0)), files=FILES).table
                self.check(PLANE, table["fz1"], RADIUS - table["z1"])

    def test_pair(self):
        deck = contact_deck.two_balls(f"model {PLASTIC}", yield_pressure=(P_Y, 1e30), dt=DT, velocity=(0, 0, 0))
        table = decks.good(moved(deck, (1.0, 0.0, 0.0), "one")).table
        self.check(PAIR, table["fx2"], RADIUS + OTHER - (table["x2"] - table["x1"]))

    def test_the_next_contact_within_a_run_is_new(self):
        """Particles stay in each other's lists, where LIGGGHTS keeps a memory of pairs unless it is told of the end."""
        common = dict(yield_pressure=(P_Y, 1e30), dt=DT, velocity=(0, 0, 0))
        wall = contact_deck.ball_on_plane(f"model {PLASTIC}", **common)
        pair = contact_deck.two_balls(f"model {PLASTIC}", **common)
        for name, deck, group, amplitude in (
            ("plane", wall, "all", "0 0 -3e-6"), ("NURBS", nurbs(wall), "all", "0 0 -3e-6"), ("pair", pair, "one", "3e-6 0 0"),
        ):
            drive = f"fix drive {group} move wiggle {amplitude} 6e-6 units box"
            with self.subTest(name):
                table = decks.good(deck.replace("fix integrate all nve/sphere", drive) + "run 1200\n", files=FILES).table
                force = table["fx2"] if name == "pair" else table["fz1"]
                first, second = force[1:600], force[601:1200]
                self.assertGreater(first.max(), 0.9 * (PAIR if name == "pair" else PLANE).loading(3e-6))
                self.assertLess(abs(second - first).max(), 1e-6 * first.max())

    def test_a_pair_that_comes_far_apart_in_one_step_is_new(self):
        """Eight steps to a period: the balls are never seen apart by less than LIGGGHTS' 1 % of their radii."""
        common = dict(yield_pressure=(P_Y, 1e30), dt=DT, velocity=(0, 0, 0), overlap=20e-6)
        pair = contact_deck.two_balls(f"model {PLASTIC}", **common)
        drive = f"fix drive one move wiggle 100e-6 0 0 {8 * DT!r} units box"
        table = decks.good(pair.replace("fix integrate all nve/sphere", drive) + "run 20\n", files=FILES).table
        overlap = RADIUS + OTHER - (table["x2"] - table["x1"])
        first, second = table["fx2"][1:4], table["fx2"][9:12]
        self.assertLess(overlap[5:8].max(), -0.01 * (RADIUS + OTHER))
        self.assertGreater(first.max(), 0.0)
        np.testing.assert_allclose(second, first, rtol=1e-9)

    def test_forces_between_runs_are_looked_at_without_being_remembered(self):
        deck = contact_deck.ball_on_plane(
            f"model {PLASTIC}", yield_pressure=(P_Y, 1e30), dt=DT, velocity=(0, 0, 0), overlap=1e-6
        ).replace("fix integrate all nve/sphere", "fix drive all move linear 0 0 0 units box")
        deck += "run 1\ndisplace_atoms all move 0 0 -1e-6 units box\nrun 0\ndisplace_atoms all move 0 0 1e-6 units box\nrun 1\n"
        for wall in (lambda text: text, nurbs):
            tables = decks.good(wall(deck), files=FILES).tables
            self.assertAlmostEqual(tables[1]["fz1"][-1] / PLANE.loading(2e-6), 1.0, delta=1e-7)
            self.assertAlmostEqual(tables[2]["fz1"][-1] / PLANE.loading(1e-6), 1.0, delta=1e-7)


class Carried(unittest.TestCase):
    """Contacts that yield, on their way through restart files and over a border of ranks at x = 0."""

    ALONG = 150.0  # m/s, so fast that the lists are made anew within the contact

    @classmethod
    def decks(cls):
        common = dict(yield_pressure=(P_Y, 1e30), dt=DT, restitution=0.9)
        wall = contact_deck.ball_on_plane(f"model {PLASTIC}", velocity=(cls.ALONG, 0.0, -1.0), **common)
        pair = contact_deck.two_balls(f"model {PLASTIC}", velocity=(cls.ALONG + 1.0, 0.0, 0.0), **common)
        pair += f"group two type 2\nvelocity two set {cls.ALONG} 0 0\n"
        aside = "displace_atoms all move {} 0 0 units box\n"
        wall, pair = wall + aside.format(-5e-4), pair + aside.format(RADIUS - 5e-4)
        return {"plane": wall, "NURBS": nurbs(wall), "pair": pair}

    def check_same(self, ours, reference):
        for column, values in reference.items():
            with self.subTest(column=column):
                np.testing.assert_array_equal(ours[column], values)

    def test_two_ranks(self):
        for name, deck in self.decks().items():
            with self.subTest(name):
                one, two = (decks.good(deck + "run 900\n", files=FILES, ranks=ranks).table for ranks in (1, 2))
                force = one["fx2"] if name == "pair" else one["fz1"]
                touching = np.nonzero(force)[0]
                self.assertLess(one["x1"][touching[0]], 0.0)
                self.assertGreater(one["x1"][touching[-1]], 0.0)
                self.assertEqual(force[-1], 0.0, "it has left")
                self.check_same(two, one)

    def test_restart_within_the_unloading(self):
        for name, deck in self.decks().items():
            steps = 650 if name == "pair" else 450
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                whole = decks.good(deck + f"run {steps}\nwrite_restart {folder}/contact\nrun 450\n", files=FILES).tables[1]
                force = whole["fx2"] if name == "pair" else whole["fz1"]
                overlap = RADIUS + OTHER - (whole["x2"] - whole["x1"]) if name == "pair" else RADIUS - whole["z1"]
                material = PAIR if name == "pair" else PLANE
                self.assertLess(overlap[1], overlap[0])
                self.assertLess(force[0], 0.95 * material.loading(overlap[0]), "below the curve of a first loading")
                self.assertGreater(force[0], 0.0)
                restart = (Path(folder) / "contact").read_bytes()
                again = decks.good(self.continued(deck) + "run 450\n", files=FILES | {"contact": restart}).table
                self.check_same(again, whole)

    @staticmethod
    def continued(deck: str) -> str:
        """The deck with its restart file in place of the box and the balls."""
        made = ("region box", "create_atoms", "set group", "velocity", "displace_atoms", "group ")
        lines = [line for line in deck.splitlines() if not line.startswith(made)]
        return "\n".join("read_restart contact" if line.startswith("create_box") else line for line in lines) + "\n"


if __name__ == "__main__":
    unittest.main()

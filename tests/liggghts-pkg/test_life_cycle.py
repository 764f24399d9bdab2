# SPDX-License-Identifier: GPL-2.0-or-later
"""run 0, several runs, unfix, clear, re-creation and restart of fix wall/nurbs; memory errors."""

import math
import unittest

import numpy as np

import ball_on_block as bob
import decks
from test_wall_output import FLOOR

FILES = {"block.yaml": bob.block()}
COLUMNS = (3, 7, 8, 11, 15, 16, 20)  # force, contacts, overlap, momentum, energies, probe
START = bob.prelude() + bob.wall() + bob.output(COLUMNS)
DAMPED = dict(restitution=0.6, friction=0.3, velocity=(0.5, 0.1, -1.0), models="model hertz tangential history")


def damped(restart: str = "") -> str:
    return bob.prelude(restart=restart, **DAMPED) + bob.wall(DAMPED["models"]) + bob.output(COLUMNS)


class LifeCycle(unittest.TestCase):
    def test_run_0_gives_forces_and_advances_nothing(self):
        overlap = 1e-6
        wall = bob.wall(rest="structure block.yaml surface top compliance none")
        deck = bob.prelude(balls=((0, 0, bob.RADIUS - overlap),)) + wall + bob.output(COLUMNS)
        table = decks.good(deck + "run 0\nrun 0\n", files=FILES).table
        E_star = 5e9 / (2 * (1 - 0.3**2))
        hertz = 4 / 3 * E_star * math.sqrt(bob.RADIUS) * overlap**1.5
        np.testing.assert_allclose(table["fz"], hertz, rtol=1e-9)
        np.testing.assert_allclose(table["plate3"], -hertz, rtol=1e-9)
        np.testing.assert_allclose(table["plate8"], overlap, rtol=1e-9)
        np.testing.assert_array_equal(table["plate7"], 1)
        for untouched in ("plate11", "plate15", "plate16", "plate20"):
            np.testing.assert_array_equal(table[untouched], 0.0)

    def test_several_runs_equal_one(self):
        start = bob.prelude(velocity=(0.3, 0.2, -1.0)) + bob.wall() + bob.output(COLUMNS)
        whole = decks.good(start + "run 600\n", files=FILES).table
        parts = decks.good(start + "run 200\nrun 0\nrun 150\nrun 250\n", files=FILES).table
        _, first = np.unique(parts["Step"], return_index=True)
        for column, reference in whole.items():
            # a component of the force is measured against the whole of it
            scale = np.abs(whole["fz"] if column in ("fx", "fy") else reference).max()
            with self.subTest(column=column):
                self.assertLessEqual(np.abs(parts[column][first] - reference).max(), 1e-12 * scale)
        self.assertGreater(whole["fz"].max(), 0.5)

    def test_unfix_takes_the_wall_away(self):
        deck = START + "run 100\nunfix plate\nthermo_style custom step v_vz v_fz\nrun 200\n"
        tables = decks.good(deck, files=FILES).tables
        self.assertGreater(tables[0]["fz"][-1], 0.0)
        np.testing.assert_array_equal(tables[1]["fz"], 0.0)
        np.testing.assert_array_equal(tables[1]["vz"], tables[1]["vz"][0])

    def test_unfix_of_what_the_wall_holds_is_found_before_the_next_run(self):
        for held in ("contact1_plate", "contact4_plate", "force_plate"):
            start = START.replace("surface top", "surface top store_force yes") + f"run 60\nunfix {held}\n"
            start += "thermo_style custom step\n"
            with self.subTest(held=held):
                result = decks.run(start + "run 10\n", files=FILES)
                self.assertNotEqual(result.code, 0)
                self.assertEqual(len(result.errors), 1, result.text[-2000:])
                for part in ("Fix wall/nurbs (id plate)", f"'{held}'", "do not unfix", "'unfix plate'"):
                    self.assertIn(part, result.errors[0])
                decks.good(start + "unfix plate\nrun 10\n" + bob.wall() + "run 10\n", files=FILES)

    def test_recreating_after_unfix_and_after_clear_repeats_the_run(self):
        again = "unfix plate\nset atom 1 x 0 y 0 z 0.001 vx 0 vy 0 vz -1.0\nreset_timestep 0\n" + bob.wall() + "run 300\n"
        deck = START + "run 300\n" + again + "clear\n" + START + "run 300\n"
        first, second, third = decks.good(deck, files=FILES).tables
        for column, reference in first.items():
            with self.subTest(column=column):
                np.testing.assert_array_equal(third[column], reference)
                np.testing.assert_array_equal(second[column], reference)

    def test_a_column_that_the_wall_in_its_place_has_not_ends_in_one_line(self):
        """Thermo asks for the columns of its line, whatever wall has the name by now."""
        other = bob.wall().replace("structure block.yaml surface top", "geometry floor.yaml surface floor")
        self.assertNotEqual(other, bob.wall())
        deck = START + f"thermo_style custom step f_plate[27]\nrun 10\nunfix plate\n{other}run 10\n"
        run = decks.run(deck, files={**FILES, "floor.yaml": FLOOR})
        self.assertEqual(run.code, 1, run.text[-2000:])
        (error,) = run.errors
        self.assertRegex(error, r"\(id plate\): f_ID\[27\] is asked for, this wall has 1 to \d+: .*another ID")

    def test_restart_continues_a_contact_to_the_last_bit(self):
        files = dict(FILES)
        write = damped() + "run 260\nwrite_restart contact.restart\nrun 340\n"
        read = "clear\n" + damped(restart="contact.restart") + "run 340\n"
        for ranks in (1, 2):
            tables = decks.good(write + read, files=files, ranks=ranks).tables
            self.assertGreater(tables[1]["fz"][0], 0.1, "the restart falls into the contact")
            for column, reference in tables[1].items():
                with self.subTest(ranks=ranks, column=column):
                    np.testing.assert_array_equal(tables[2][column], reference)

    def test_store_force_keeps_the_wall_force_per_particle(self):
        deck = bob.prelude() + bob.wall(rest="structure block.yaml surface top store_force yes")
        deck += "run 100\ncompute w all reduce sum f_force_plate[3]\nvariable w equal c_w\n" + bob.output((3,))
        table = decks.good(deck.replace("v_x v_y", "v_w v_x v_y") + "run 50\n", files=FILES).tables[-1]
        np.testing.assert_allclose(table["w"], -table["plate3"], rtol=1e-14)

    @unittest.skipIf(decks.PATIENCE > 1, "not in builds with sanitizers: one memory checker at a time")
    def test_valgrind_finds_no_error_of_ours(self):
        small = {"block.yaml": bob.block(elements=(2, 2, 1))}
        deck = damped() + "run 60\nthermo_style custom step\nunfix plate\nrun 5\nclear\n" + damped() + "run 10\n"
        launcher = ["valgrind", "--error-exitcode=99", "--leak-check=no", "-q",
                    "--suppressions=/usr/share/openmpi/openmpi-valgrind.supp"]
        result = decks.run(deck, files=small, launcher=launcher, timeout=500)
        self.assertEqual(result.code, 0, result.text[-4000:])


if __name__ == "__main__":
    unittest.main()

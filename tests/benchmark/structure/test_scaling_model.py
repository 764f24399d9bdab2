# SPDX-License-Identifier: GPL-2.0-or-later
"""The page says what the model works out, and the model what its inputs say."""

import math
import re
import unittest
from dataclasses import replace
from unittest import mock

import scaling_model as model


class Page(unittest.TestCase):
    def test_tables_are_those_of_the_model(self):
        page = model.PAGE.read_text(encoding="utf-8")
        self.assertEqual(page, model.with_tables(page), "run scaling_model.py --write")


class Model(unittest.TestCase):
    def test_one_rank_only_works(self):
        step = model.structure(1e6, 1)
        self.assertEqual((step.halo, step.sums), (0.0, 0.0))
        self.assertAlmostEqual(step.work, 3e6 * model.value("step"))

    def test_halo_of_a_cube(self):
        """8 nodes and two layers beyond three faces: a cube of 4 less one of 2."""
        self.assertAlmostEqual(model.halo_nodes(8.0), 64.0 - 8.0)

    def test_halo_by_hand(self):
        """1e6 nodes on 1,000 ranks: cubes of 10, 12^3 - 10^3 = 728 nodes of 24 bytes, there and back, 14 messages."""
        by_hand = 14 * 2e-6 + 728 * 48.0 / 5e9
        with inputs(latency=2.0, bandwidth=5.0, box=1.0):
            self.assertAlmostEqual(model.structure(1e6, 1000).halo, by_hand, delta=1e-12)

    def test_sums_by_hand(self):
        """8 ranks: three stages up and three down, for each of two sums of 1000 bytes at 1 GB/s."""
        with inputs(latency=2.0, bandwidth=1.0, sums=2.0, sum_bytes=1000.0):
            self.assertAlmostEqual(model.sum_time(8), 2 * 6 * (2e-6 + 1e-6))

    def test_contacts_are_those_of_a_face(self):
        """1e6 particles on 1,000 ranks: cubes of 10, 100 of them touch."""
        with inputs(contact=1e6, particle=0.0, step=0.0):  # a millisecond for each contact
            self.assertAlmostEqual(model.particles(1e6, 1e3, 1000).work, 0.1)

    def test_memory_that_no_rank_saves(self):
        with inputs(own=100.0, everywhere=10.0, box=1.0):
            self.assertAlmostEqual(model.structure(1e6, 1000).memory, 100e3 + 10e6)

    def test_more_ranks_than_boxes_do_not_help(self):
        """8,000 nodes are eight boxes of a thousand."""
        with inputs(box=1000.0):
            self.assertEqual(model.structure(8e3, 100).work, model.structure(8e3, 8).work)

    def test_boxes_are_those_of_the_code(self):
        header = model.PAGE.parents[3] / "iga-solver/structure/solid/box_grid.h"
        spans = re.search(r"kBoxSpans = \{(.*)\};", header.read_text(encoding="utf-8"))
        self.assertEqual(model.value("box"), math.prod(map(int, spans.group(1).split(","))))

    def test_units_of_what_is_shown(self):
        self.assertEqual([model.shown(t) for t in (2.0, 0.0213, 3.14e-5, 0.0)], ["2 s", "21.3 ms", "31.4 us", "0"])


def inputs(**values):
    changed = {name: replace(model.INPUTS[name], value=value) for name, value in values.items()}
    return mock.patch.dict(model.INPUTS, changed)


if __name__ == "__main__":
    unittest.main()

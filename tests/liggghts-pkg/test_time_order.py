# SPDX-License-Identifier: GPL-2.0-or-later
"""Particles and surface share one time level: the coupled scheme is second order.  With a late surface (a build of the
program for this test alone, tests/coupling/late_surface.h) it is first order and gains energy.

Richardson order: q(dt), q(dt/2), q(dt/4), q(dt/8) at two fixed times inside the contact of a ball with a light elastic
block; the order is log2 of the ratio of successive differences, each the root mean square over 20 start phases (the
Hertz force starts with a kink, so the error depends on where in a step the contact begins).
"""

import os
import unittest

import numpy as np

import ball_on_block as bob
import decks

DT = 4e-8  # the contact lasts about 18 us; the stable step of the block is 2.6e-7 s
TIMES = (110, 265)  # steps of DT: about 0.25 and 0.6 of the contact
END = 640  # well after it
PHASES = 20
REFINEMENTS = (1, 2, 4, 8)
FILES = {"block.yaml": bob.block(fixed=())}
COLUMNS = (11, 15, 16, 20)  # momentum z, kinetic and strain energy of the block, displacement of its top


def one_run(phase: float, refinement: int, corrected: bool) -> str:
    """Corrected contacts slide over the middle of an element, where what it gives way changes most."""
    start = bob.RADIUS + phase * DT  # touches after `phase` steps of the coarsest run
    ball = (0.2e-3, 0.3e-3, start) if corrected else (0.0, 0.0, start)
    deck = bob.prelude(balls=(ball,), timestep=DT / refinement, velocity=(20.0 if corrected else 0.0, 0.0, -1.0))
    deck += bob.wall(rest="structure block.yaml surface top" + " compliance corrected" * corrected) + bob.output(COLUMNS, refinement)
    return deck + f"run {END * refinement}\nclear\n"


class TimeOrder(unittest.TestCase):
    @staticmethod
    def measure(late: int, refinements=REFINEMENTS, corrected: bool = False):
        """Orders of the quantities at the two times with a surface so many steps late, and the relative gain of energy
        of each of the coarsest runs."""
        program = os.environ["LIGGGHTS_NURBS_LATE"] if late else decks.NURBS
        values = {}  # refinement -> [phase][time][quantity]
        gains = []
        for refinement in refinements:
            deck = "".join(one_run((k + 0.5) / PHASES, refinement, corrected) for k in range(PHASES))
            tables = decks.good(deck, files=FILES, program=program, environment={"LATE_STEPS": str(late)}, timeout=400).tables
            assert len(tables) == PHASES
            rows = []
            for table in tables:
                energy = table["KinEng"] + table["plate15"] + table["plate16"]
                assert table["fz"][END] == 0.0 and table["fz"][TIMES[1]] > 0.0
                if refinement == 1:
                    gains.append(energy[END] / energy[0] - 1.0)
                quantities = ("z", "vz", "plate11", "plate20", *(("vx",) if corrected else ()))
                rows.append([[table[q][step] for q in quantities] for step in TIMES])
            values[refinement] = np.array(rows)
        pairs = list(zip(refinements[:-1], refinements[1:]))
        differences = [np.sqrt(np.mean((values[a] - values[b]) ** 2, axis=0)) for a, b in pairs]
        orders = [np.log2(coarse / fine) for coarse, fine in zip(differences[:-1], differences[1:])]
        return np.array(orders), np.array(gains)

    def test_in_phase_surface_is_second_order(self):
        orders, gains = self.measure(late=0)
        print("orders [refinement][time][z, vz, momentum, displacement]:\n", orders.round(3))
        print("energy gain: mean %.2e, largest %.2e" % (gains.mean(), np.abs(gains).max()))
        self.assertGreaterEqual(orders.min(), 1.8)
        self.assertLessEqual(orders.max(), 2.3)

    def test_corrected_contacts_are_second_order(self):
        orders, _ = self.measure(late=0, refinements=(*REFINEMENTS, 16), corrected=True)
        print("orders [refinement][time][z, vz, momentum, displacement, vx]:\n", orders.round(3))
        self.assertGreaterEqual(orders.min(), 1.8)
        self.assertLessEqual(orders[1:].max(), 2.3)  # of z at the second time little is of second order, so the coarsest shows more

    def test_late_surface_is_first_order_and_gains_energy(self):
        orders, gains = self.measure(late=1)
        print("orders [refinement][time][z, vz, momentum, displacement]:\n", orders.round(3))
        print("energy gain: mean %.2e" % gains.mean())
        self.assertGreaterEqual(orders.min(), 0.9)
        self.assertLessEqual(orders.max(), 1.1)
        self.assertGreater(gains.min(), 0.0)
        _, twice = self.measure(late=2, refinements=REFINEMENTS[:1])
        print("two steps late: %.4f times the gain" % (twice.mean() / gains.mean()))
        self.assertAlmostEqual(twice.mean() / gains.mean(), 2.0, delta=0.1)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""What a surface that is seen late would compute, and that ours is not: the deck inputs/thin_plate, a steel ball on 1 mm of
glass (its case Z2), run by liggghts-nurbs, and by a build for tests whose surface is late (tests/coupling/late_surface.h).

usage: LIGGGHTS_NURBS=... LIGGGHTS_NURBS_LATE=... PYTHONPATH=inputs python3 -m unittest -v test_late_plate
"""

import math
import os
import shutil
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from study.reference import hertz
from study.reference.zener import ThinPlateImpact, plate_mobility
from study.run.case import read_csv
from study.run.pulse import measure
from study.run.solver import Run, Solver

DECK = Path(__file__).resolve().parents[3] / "inputs/thin_plate"
STEEL, GLASS = (210.6e9, 0.286, 7850.0), (74.6e9, 0.2285, 2480.0)  # E [Pa], nu, rho [kg/m^3]
RADIUS, V, THICKNESS = 1.0e-3, 1.0, 1.0e-3
RIGID = hertz.penalty_impact("hertz", 1.0, hertz.effective_modulus(*STEEL[:2], *GLASS[:2]), RADIUS, STEEL[2], V)
ZENER = ThinPlateImpact(RIGID.m, RIGID.V, RIGID.k, plate_mobility(*GLASS, THICKNESS))
# Steps late and 20 of them: the energy that this brings, in that of the ball: an independent code, a Kirchhoff plate in
# elements of 0.5 mm.
VERY_LATE, GAIN = 20, 0.057
TOLERANCE = 0.2  # of what the delay changes
IN_PHASE_GAIN = 2e-5  # of energy, at most


@dataclass(frozen=True)
class Impact:
    restitution: float
    peak_force: float  # [N]
    energy_gain: float  # of ball and plate, in the ball's energy before


def run(steps_per_contact: int, late: int, folder: Path) -> Impact:
    """The deck with a time step of that part of the contact, the surface so many steps late."""
    dt = ZENER.duration / steps_per_contact
    ball = dict(zip(("E_ball", "nu_ball", "rho"), STEEL))
    values = {**ball, "r": RADIUS, "V": V, "dt": dt, "steps": math.ceil(1.1 * ZENER.duration / dt)}
    words = {"plate": "glass_36mm", **{name: repr(value) for name, value in values.items()}}
    program = Path(os.environ["LIGGGHTS_NURBS_LATE" if late else "LIGGGHTS_NURBS"])
    job = Run(folder.name, DECK, "in.thin_plate", words, folder, environment={"LATE_STEPS": str(late)})
    job.start(Solver(program), folder.with_suffix(".sessions"))
    job.process.wait()
    job.finished()
    assert not job.failure(), job.failure()
    force, end = read_csv(folder / "contact_force.csv"), read_csv(folder / "energy.csv")[-1]
    before, plate = 0.5 * RIGID.m * V**2, end["kinetic"] + end["strain"]
    peak = measure(force["t"], force["F"], force["overlap"]).peak_force
    return Impact(end["v"] / V, peak, (end["v"] / V) ** 2 - 1.0 + plate / before)


def zener(steps_per_contact: int, late: int) -> np.ndarray:
    """Restitution and peak force over m V/T of Zener's equation with the delay itself, integrated in finer steps;
    m = V = K = 1."""
    step, inelasticity = ZENER.duration / ZENER.time_scale / steps_per_contact, ZENER.inelasticity
    finer = round(step / 5e-4)
    h, late = step / finer, late * finer
    z, v, f, peak, plate = 0.0, -1.0, 0.0, 0.0, [0.0] * (late + 2)
    while f > 0.0 or z == 0.0:
        v += 0.5 * h * f
        z += h * v
        f_before, f = f, max(-z - plate[-1 - late], 0.0) ** 1.5
        plate.append(plate[-1] + 0.5 * h * inelasticity * (f_before + f))
        v += 0.5 * h * f
        peak = max(peak, f)
    return np.array([v, peak])


class LatePlate(unittest.TestCase):
    RUNS = {(1000, 0), (1000, 1), (200, 0), (200, 1), (200, VERY_LATE)}  # steps per contact, steps late

    @classmethod
    def setUpClass(cls):
        scratch = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, scratch)
        with ThreadPoolExecutor(2) as pool:
            jobs = {key: pool.submit(run, *key, scratch / "{}_{}".format(*key)) for key in cls.RUNS}
        cls.impacts = {key: job.result() for key, job in jobs.items()}

    def test_one_step_late_changes_what_zeners_equation_says(self):
        for steps in (1000, 200):
            late, in_phase = self.impacts[steps, 1], self.impacts[steps, 0]
            seen = [late.restitution - in_phase.restitution, late.peak_force / in_phase.peak_force - 1.0]
            theory = zener(steps, 1) - zener(steps, 0)
            expected = [theory[0], theory[1] / zener(steps, 0)[1]]
            print(f"one step of {steps} late: restitution {seen[0]:+.6f}, peak force {seen[1]:+.6f}; expected", expected)
            np.testing.assert_allclose(seen, expected, rtol=TOLERANCE)

    def test_twenty_steps_late_gain_energy(self):
        gain = self.impacts[200, VERY_LATE].energy_gain
        print(f"{VERY_LATE} steps of 200 late: energy {gain:+.4f}, expected {GAIN}")
        self.assertAlmostEqual(gain / GAIN, 1.0, delta=TOLERANCE)

    def test_the_product_is_in_phase_and_conserves_energy(self):
        for steps in (1000, 200):
            gain = self.impacts[steps, 0].energy_gain
            print(f"in phase, {steps} steps: energy {gain:+.2e}")
            self.assertLess(abs(gain), IN_PHASE_GAIN)


if __name__ == "__main__":
    unittest.main()

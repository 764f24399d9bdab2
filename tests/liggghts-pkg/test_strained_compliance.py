# SPDX-License-Identifier: GPL-2.0-or-later
"""`compliance corrected` on a rubber block that is stretched by a fifth along both sides of its top: its elements give way otherwise."""

import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import ball_on_block as bob
import decks

IGA_SOLVE = os.environ.get("IGA_SOLVE", "iga-solve")
RUBBER = E, NU = 5e6, 0.3
SIZE = (10e-3, 10e-3, 6e-3)
STRETCH = 1.2
MODELS = "model hertz tangential no_history"
SPEED = 0.5


def free_stretch() -> float:
    """Along z, without a load there: neo-Hooke's P = mu (F - F^-T) + lambda ln(J) F^-T."""
    mu, lam = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
    return brentq(lambda z: mu * (z - 1 / z) + lam * math.log(STRETCH**2 * z) / z, 0.5, 1.5)


TOP = SIZE[2] * (free_stretch() - 1.0)


def block(elements: tuple[int, int, int], time: str = "", more: str = "", stretch: float = STRETCH) -> str:
    way = 0.5 * (stretch - 1.0) * SIZE[0]
    moved = "".join(
        f"  - {{move: {{{axis}: {sign * way}}}, faces: [{face}]{time}}}\n"
        for axis, face, sign in (("x", "xi-", -1), ("x", "xi+", 1), ("y", "eta-", -1), ("y", "eta+", 1))
    )
    solid = bob.block(SIZE, elements, youngs_modulus=E, nu=NU, fixed=()).replace("linear_elastic", "neo_hooke")
    return solid + "boundary:\n" + moved + "  - {fix: [z], faces: [zeta-]}\n" + more


def prelude(feet: list[tuple[float, float, float]], timestep: float, **words) -> str:
    """Balls above these."""
    centres = [(x, y, z + bob.RADIUS) for x, y, z in feet]
    return bob.prelude(balls=centres, velocity=(0, 0, -SPEED), models=MODELS, ball=RUBBER, wall=RUBBER, timestep=timestep, **words)


def wall(words: str) -> str:
    return bob.wall(MODELS, f"structure block.yaml surface top {words}")


class Force(unittest.TestCase):
    """Meshes agree: by tables of the undeformed body forces would be 1.5 and 3.1 % larger here."""

    def force(self, n: int) -> float:
        elements = (n, n, 6 * n // 10)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            model = folder / "block.yaml"
            model.write_text(block(elements, more="analysis: {kind: static, load_steps: 4, save: stretched.h5}\n"))
            subprocess.run([IGA_SOLVE, model.name, "--quiet"], cwd=folder, check=True, timeout=60)
            model.write_text(block(elements))
            deck = prelude([(0, 0, TOP + 1e-6)], 1e-5 / n) + wall("state stretched.h5 compliance corrected") + bob.output(())
            run = decks.run_in(folder, deck + f"run {140 * n}\n")
        self.assertEqual(run.code, 0, run.text[-1500:])
        return np.abs(run.table["fz"]).max()

    def test_meshes_agree(self):
        coarse, fine = self.force(10), self.force(18)
        self.assertLess(abs(coarse / fine - 1.0), 4e-3)


class Continued(unittest.TestCase):
    STEP = 2e-6
    COLUMNS = bob.output((1, 2, 3, 7, 15, 16))
    WALL = wall("compliance corrected")

    def test_restart_in_a_contact_is_bitwise(self):
        """What the element under the ball gives way is that of the block as it was before the contact, when it was stretched."""

        def deck(runs: str, restart: str = "") -> str:
            return prelude([(0, 0, 0.2e-3)], self.STEP, restart=restart) + self.WALL + self.COLUMNS + runs

        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "block.yaml").write_text(block((6, 6, 4), ", time: {ramp: [0, 2e-3]}"))
            first = decks.run_in(folder, deck("run 1300\nwrite_restart contact\nrun 400\n"))
            second = decks.run_in(folder, deck("run 400\n", "contact"), ranks=2)
        self.assertEqual((first.code, second.code), (0, 0), first.text[-1500:] + second.text[-1500:])
        self.assertGreater(abs(first.tables[1]["plate3"][0]), 0.0, "it touches")
        for key, values in second.tables[0].items():
            np.testing.assert_array_equal(values, first.tables[1][key], key)

    def test_ranks_know_what_others_touch(self):
        """The block is squeezed below one ball; another one on another rank comes down beside it, whose element stays as it was, too."""
        model = {"block.yaml": block((6, 6, 4), ", time: {ramp: [0, 4e-4]}", stretch=0.9)}
        feet = [(-0.2e-3, 0, 1e-6), (1.9e-3, 0, 0.5e-3), (-2.5e-3, 2.5e-3, 0.8e-3)]
        one, two = (
            decks.good(prelude(feet, self.STEP, processors=f"{n} 1 1") + self.WALL + self.COLUMNS + "run 600\n", files=model, ranks=n).table
            for n in (1, 2)
        )
        self.assertGreater(one["plate7"].max(), 1, "two balls touch")
        for key in one.keys() - {"KinEng"}:  # LIGGGHTS' own sum over ranks
            np.testing.assert_array_equal(one[key], two[key], key)


if __name__ == "__main__":
    unittest.main()

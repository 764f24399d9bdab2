# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields of a solid that a model file's `output` asks for, in decks: those of iga-solve for a solid without particles, beside
the columns of the fix under a ball; over several runs, ranks and a restart."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
import vtu

IGA_SOLVE = os.environ.get("IGA_SOLVE", "iga-solve")
STEP = 2.0**-27  # [s], so that times are exact sums
FIELDS = f"fields: {{of: [displacement, velocity, stress, von_mises], every: {100 * STEP!r}, on: [volume, top]}}"
FAR = dict(balls=((0.0, 0.0, 5e-3),), velocity=(0.0, 0.0, 0.0))  # a ball that meets nothing
HIT = dict(balls=((0.0, 0.0, 1e-3 + 4e-8),))


def model(loads: str = "") -> str:
    return bob.block() + f"output: {{every: {100 * STEP!r}, file: block, {FIELDS}}}\n" + loads


def deck(after: str, **settings) -> str:
    return bob.prelude(timestep=STEP, **settings) + bob.wall() + bob.output((18, 19, 20)) + after


class SolidFields(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def liggghts(self, text: str, ranks: int = 1) -> decks.Run:
        """Runs a deck that must succeed."""
        run = decks.run_in(self.folder, text, ranks)
        self.assertEqual(run.code, 0, run.text[-2000:])
        return run

    def files(self) -> dict[str, bytes]:
        return {path.name: path.read_bytes() for path in self.folder.glob("block_*")}

    def times(self, place: str) -> np.ndarray:
        return np.array(list(vtu.series(self.folder / f"block_{place}.pvd")))

    def remove(self):
        for name in self.files():
            (self.folder / name).unlink()

    def test_without_particles_they_are_those_of_iga_solve(self):
        (self.folder / "block.yaml").write_text(model("loads: {tractions: [{face: zeta+, value: [0, 2e3, -1e4]}]}\n"))
        command = [IGA_SOLVE, "block.yaml", "--end", repr(400 * STEP), "--step", repr(STEP), "--quiet"]
        subprocess.run(command, cwd=self.folder, env=decks.mpi_environment(), timeout=120, check=True)
        expected = self.files()
        self.assertEqual(len(expected), 2 * 6)
        self.remove()
        self.liggghts(deck("run 150\nrun 250\n", **FAR))
        self.assertEqual(self.files(), expected)

    def test_under_a_ball_on_ranks_and_over_a_restart(self):
        (self.folder / "block.yaml").write_text(model())
        self.liggghts(deck("run 350\nwrite_restart state\nrun 350\n", **HIT))
        expected = self.files()
        np.testing.assert_array_equal(self.times("top"), 100 * STEP * np.arange(8))
        restarted = bob.prelude(restart="state", timestep=STEP, **HIT) + bob.wall() + "run 350\n"
        for text, ranks in ((restarted, 1), (deck("run 350\nrun 350\n", **HIT), 2)):
            self.liggghts(text, ranks)
            self.assertEqual(self.files(), expected)
            self.remove()

    def test_displacement_under_the_ball_is_the_probes(self):
        (self.folder / "block.yaml").write_text(model())
        table = self.liggghts(deck("run 700\n", **HIT)).tables[0]
        for n in range(8):
            state = vtu.read(self.folder / f"block_top_{n}.vtu")
            centre = np.flatnonzero(np.abs(state.points[:, :2]).max(axis=1) < 1e-12)  # a corner of cells: its own value
            self.assertEqual(len(centre), 1)
            expected = [table[f"plate{18 + d}"][100 * n] for d in range(3)]
            np.testing.assert_allclose(state.fields["displacement"][centre[0]], expected, rtol=0, atol=1e-9 * 1e-6)
        self.assertLess(min(table["plate20"]), -1e-7)


if __name__ == "__main__":
    unittest.main()

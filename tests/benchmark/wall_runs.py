# SPDX-License-Identifier: GPL-2.0-or-later
"""What the benchmarks of whole walls share: runs of the decks in wall_decks/, and what LIGGGHTS' output says."""

from __future__ import annotations

import os
import re
import resource
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np

DECKS = Path(__file__).parent / "wall_decks"


@dataclass
class WallRuns:
    """Runs decks in a folder of its own that holds decks, walls and states."""

    program: str
    clock: str  # libcpu_clock.so
    folder: Path

    def run(self, deck: str, settings: dict[str, str] | None = None, **variables: object) -> str:
        """Runs a deck, with settings of the environment; what it printed.  Raises if it fails."""
        words = [word for name, value in variables.items() for word in ("-var", name, str(value))]
        environment = dict(os.environ, LD_PRELOAD=self.clock, **(settings or {}))
        if os.geteuid() == 0:
            environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(
            [self.program, "-in", deck, "-log", "none", *words],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            check=False,
        )
        if done.returncode != 0:
            raise RuntimeError(f"{deck} {words} failed:\n{done.stdout[-1500:]}")
        return done.stdout

    def seconds(self, deck: str, **variables: object) -> tuple[float, str]:
        """CPU time of a run, user's and system's [s], and what it printed; nothing else may run meanwhile."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        log = self.run(deck, **variables)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, log


def data_file(box: Sequence[tuple[float, float]], radii: np.ndarray, centres: np.ndarray, velocity: str = "") -> str:
    """LIGGGHTS data file of spheres (n, 3) [m], of 2500 kg/m3, in a box of two atom types; `velocity`: of all, in words
    [m/s]."""
    rows = (f"{n} 1 {2 * r!r} 2500 {x!r} {y!r} {z!r}" for n, (r, (x, y, z)) in enumerate(zip(radii, centres), 1))
    sides = "\n".join(f"{low!r} {high!r} {a}lo {a}hi" for a, (low, high) in zip("xyz", box))
    text = f"spheres above a wall\n\n{len(radii)} atoms\n2 atom types\n\n{sides}\n\nAtoms\n\n" + "\n".join(rows) + "\n"
    if velocity:
        text += "\nVelocities\n\n" + "".join(f"{n} {velocity} 0 0 0\n" for n in range(1, len(radii) + 1))
    return text


def touching_rows(log: str) -> list[int]:
    """Spheres that touch the wall in each row of the last run with in.touching."""
    last = re.split(r"^\s*Step ", log, flags=re.MULTILINE)[-1]
    return [int(row) for row in re.findall(r"^\s*\d+\s+\d+\s+\S+\s+(\d+)\s*$", last, re.MULTILINE)]


def touching(log: str) -> int:
    """The same at its end."""
    return touching_rows(log)[-1]


def fix_times(log: str) -> tuple[dict[str, float], float]:
    """Of the last run: seconds of each fix that belongs to the wall, and of the whole loop."""
    last = log[log.rindex("Loop time of") :]
    fixes = re.findall(r"^Fix (\S+) \S+ time \(%\) = (\S+)", last, re.MULTILINE)
    wall = {name: float(seconds) for name, seconds in fixes if re.search("wall|mesh|motion", name)}
    return wall, float(last.split()[3])


def loop_times(log: str) -> list[float]:
    """Of each run: seconds of the whole loop."""
    return [float(seconds) for seconds in re.findall(r"^Loop time of (\S+)", log, re.MULTILINE)]

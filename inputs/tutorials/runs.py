# SPDX-License-Identifier: GPL-2.0-or-later
"""One run of a deck with one of the walls: its time on the processor, its totals, particles that are lost or passed.

usage: PYTHONPATH=inputs python3 inputs/tutorials/runs.py KIND FOLDER
writes the decks and the walls of a kind into a new folder, to run them by hand
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Mapping

import numpy as np
import vtk
from kinds import KINDS, Kind
from study.build.stl import stl
from study.run.bed import read_frames
from study.run.solver import Solver
from vtk.util.numpy_support import vtk_to_numpy

FOLDER = Path(__file__).parent
COLUMNS = ("step inserted particles kinetic spin x y z fx fy fz tx ty tz extra").split()


class RunFailed(Exception):
    """The words of the program."""


@dataclass(frozen=True)
class Outcome:
    seconds: float  # of the processor, user and system
    totals: Mapping[str, float]
    lost: int  # particles that were inserted and are not there at the end, where none may leave
    passed: int  # places in all frames where only a particle can be that went through the wall


def run(program: Path, kind: Kind, wall: str, seed: int, ranks: int, folder: Path, **variables: str) -> Outcome:
    """Runs a deck in a new folder; RunFailed if the program ends with an error."""
    lay_out(kind, folder)
    solver = Solver(program, ranks)
    words = {"wall": wall, "seed": str(seed), **kind.variables, **variables}
    with open(folder / "log.txt", "w", encoding="utf-8") as log:
        process = subprocess.Popen(
            solver.command(f"in.{kind.deck or kind.name}", words),
            cwd=folder,
            env=solver.environment(),
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
        try:
            _, status, usage = os.wait4(process.pid, 0)  # Popen's own wait tells no times
            process.returncode = os.waitstatus_to_exitcode(status)
        except KeyboardInterrupt:
            process.terminate()
            raise
    text = (folder / "log.txt").read_text(encoding="utf-8", errors="replace")
    if process.returncode:
        errors = [line for line in text.splitlines() if line.startswith("ERROR")]
        raise RunFailed(errors[0] if errors else f"the program ended with code {process.returncode}")
    return outcome(kind, folder, usage.ru_utime + usage.ru_stime)


def lay_out(kind: Kind, folder: Path) -> None:
    """A new folder with the decks and the walls of a kind."""
    shutil.copytree(FOLDER, folder, ignore=shutil.ignore_patterns("*.py", "*.md", "*.png", "__pycache__"))
    for name, triangles in kind.walls.items():
        (folder / name).write_text(stl(triangles), encoding="utf-8")


def outcome(kind: Kind, folder: Path, seconds: float) -> Outcome:
    table = dict(zip(COLUMNS, np.loadtxt(folder / "totals.txt", ndmin=2).T))
    frames = read_frames((folder / "frames.txt").read_text(encoding="utf-8"))
    passed = sum(int(np.count_nonzero(kind.passed(frame.values))) for frame in frames)
    table |= worn(folder)
    totals = {total.name: total.of(table[total.column]) for total in kind.totals}
    lost = 0 if kind.open else round(table["inserted"][-1]) - len(frames[-1].values["x"])
    return Outcome(seconds, totals, lost, passed)


def worn(folder: Path) -> dict[str, np.ndarray]:
    """The volume [m^3] that the last file of wear shows, if there is one: LIGGGHTS' .vtk or ours."""
    files = {int(re.search(r"(\d+)\.vt", path.name)[1]): path for path in folder.glob("wear*.vt[ku]")}
    if not files:
        return {}
    last = files[max(files)]
    reader = vtk.vtkPolyDataReader() if last.suffix == ".vtk" else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(last))
    size = vtk.vtkCellSizeFilter()
    size.SetInputConnection(reader.GetOutputPort())
    size.Update()
    data = size.GetOutput().GetCellData()
    depth, area = (vtk_to_numpy(data.GetArray(name)) for name in ("wear", "Area"))
    return {"worn": np.array([depth @ area])}


if __name__ == "__main__":
    lay_out({kind.name: kind for kind in KINDS}[sys.argv[1]], Path(sys.argv[2]))

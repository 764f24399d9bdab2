# SPDX-License-Identifier: GPL-2.0-or-later
"""A model file as a dict, what iga-solve makes of it, and the rows that a benchmark has of that."""

from __future__ import annotations

import math
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Sequence

import h5py
import numpy as np
import yaml

from study.run.summary import Row

Model = dict
ALL = ["x", "y", "z"]
ABSOLUTE = ""  # unit of a ratio


@dataclass(frozen=True)
class Solved:
    """What iga-solve has printed, and written into run.h5 and state.h5 if the model asks for them."""

    text: str
    history: dict[str, np.ndarray]
    state: dict[str, np.ndarray]  # [control points][3], xi fastest

    def probe(self, name: str) -> list[float]:
        return self._numbers(rf"probe {name}: (.*)")

    def frequencies(self) -> list[float]:
        return [float(word) for word in re.findall(r"frequency (\S+)", self.text)]

    def stable_step(self) -> float:
        return self._numbers(r"stable step +([^,\n]*)")[0]

    def _numbers(self, pattern: str) -> list[float]:
        return [float(word) for word in re.search(pattern, self.text)[1].split()]


Solve = Callable[[Model], Solved]  # raises SolverError


class SolverError(Exception):
    """iga-solve's message."""


@dataclass(frozen=True)
class Benchmark:
    """Rows of one or several models."""

    name: str
    rows: Callable[[Solve], list[Row]]


def iga_solve(program: Path) -> Solve:
    def solve(model: Model) -> Solved:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "model.yaml").write_text(yaml.safe_dump(model, default_flow_style=None), encoding="utf-8")
            done = subprocess.run([program, "model.yaml"], cwd=folder, capture_output=True, text=True, check=False)
            if done.returncode:
                raise SolverError(done.stderr.strip())
            return Solved(done.stdout, read(folder / "run.h5"), read(folder / "state.h5", "state"))

    return solve


def read(path: Path, group: str = "/") -> dict[str, np.ndarray]:
    """The data sets of an HDF5 file by their names; none of a file that is not there."""
    if not path.exists():
        return {}
    found: dict[str, np.ndarray] = {}
    with h5py.File(path) as file:
        file[group].visititems(lambda name, item: found.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
    return found


def one_row(name: str, mesh: str, quantity: str, model: Model, value: Callable[[Solved], float], reference: float,
            tolerance: float) -> Benchmark:  # fmt: skip
    """One number of one model; `tolerance` is relative, absolute if the reference is 0."""
    return Benchmark(
        name, lambda solve: [Row(f"{name} ({mesh})", quantity, value(solve(model)), ABSOLUTE, reference, tolerance)]
    )


def order(case: str, quantity: str, coarse: float, fine: float, expected: float, band: float) -> Row:
    """Of two errors on meshes of which the second is twice as fine; `band` is absolute."""
    observed = math.log2(abs(coarse / fine)) if fine else math.nan
    return Row(case, f"order of {quantity}", observed, ABSOLUTE, expected, band / expected)


def box(size: Sequence[float], elements: Sequence[int], degree: int | Sequence[int]) -> Model:
    return {"box": {"origin": [0, 0, 0], "size": list(size), "elements": list(elements), "degree": degree}}


def model(geometry: Model, material: Sequence, boundary: Sequence[Model], analysis: Model | str | None = None, **more) -> Model:
    law, E, nu, density = material
    constants = {"law": law, "youngs_modulus": E, "poissons_ratio": nu, "density": density}
    whole = {"units": "si", "geometry": geometry, "material": constants, "boundary": list(boundary), **more}
    return {**whole, "analysis": analysis} if analysis else whole


def fix(directions: Sequence[str], *faces: str) -> Model:
    """Without faces: everywhere."""
    return {"fix": list(directions), **({"faces": list(faces)} if faces else {"patch": 0})}


def mesh_of(elements: Sequence[int], degree: int | Sequence[int]) -> str:
    return f"{' x '.join(map(str, elements))}, p = {degree}"

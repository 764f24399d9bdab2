# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs LIGGGHTS decks for the tests and reads back what they print.

The programs come from the environment: LIGGGHTS_NURBS (ours) and LIGGGHTS (the stock program of the distribution).
"""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

NURBS = os.environ.get("LIGGGHTS_NURBS", "liggghts-nurbs")
STOCK = os.environ.get("LIGGGHTS", "liggghts")
PATIENCE = float(os.environ.get("TEST_PATIENCE", "1"))  # builds with sanitizers are slow
LOG = "log.deck"
# Place, velocity and spin of the first ball; needs a compute `spin` of omegax, omegay, omegaz.
BALL = "".join(f"variable {c} equal {c}[1]\n" for c in ("x", "y", "z", "vx", "vy", "vz")) + "".join(
    f"variable w{c} equal c_spin[1][{k}]\n" for k, c in enumerate("xyz", 1)
)


@dataclass
class Run:
    """What a deck gave: exit code, everything it printed, and its thermo tables one after the other."""

    code: int
    text: str
    tables: list[dict[str, np.ndarray]]

    @property
    def errors(self) -> list[str]:
        return [line for line in self.text.splitlines() if line.startswith("ERROR")]

    @property
    def table(self) -> dict[str, np.ndarray]:
        """All thermo tables joined; a step that a second run repeats stands twice."""
        names = self.tables[0].keys()
        return {name: np.concatenate([t[name] for t in self.tables]) for name in names}


# LIGGGHTS and Open MPI leak, and after some errors LIGGGHTS prints a line from memory that it has freed.
SANITIZER = "detect_leaks=0:check_printf=0"


def mpi_environment() -> dict[str, str]:
    """Open MPI refuses root and more ranks than cores unless told otherwise."""
    environment = dict(os.environ, OMPI_MCA_rmaps_base_oversubscribe="1", ASAN_OPTIONS=SANITIZER)
    if os.geteuid() == 0:
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return environment


def run(
    deck: str,
    *,
    files: dict[str, str | bytes] | None = None,
    ranks: int = 1,
    program: str = NURBS,
    timeout: float = 120.0,
    environment: dict[str, str] | None = None,
    launcher: list[str] | None = None,
) -> Run:
    """Runs the deck's text in an empty folder that also holds `files` (name -> text or bytes)."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in (files or {}).items():
            (Path(folder) / name).write_bytes(content.encode() if isinstance(content, str) else content)
        return run_in(Path(folder), deck, ranks, program, timeout, environment, launcher)


def run_in(
    folder: Path,
    deck: str,
    ranks: int = 1,
    program: str = NURBS,
    timeout: float = 120.0,
    environment: dict[str, str] | None = None,
    launcher: list[str] | None = None,
) -> Run:
    """Runs the deck's text in this folder, which keeps what the run writes."""
    (folder / "in.deck").write_text(deck)
    command = (launcher or []) + [program, "-in", "in.deck", "-log", LOG]
    if ranks > 1:
        command = ["mpirun", "-n", str(ranks)] + command
    # a folder of its own for Open MPI: in a common one a run that ends may take away what another has just begun
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
        done = subprocess.run(
            command,
            cwd=folder,
            env=mpi_environment() | {"OMPI_MCA_orte_tmpdir_base": scratch} | (environment or {}),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",  # LIGGGHTS may print a line of garbage after an error
            timeout=timeout * PATIENCE,
            check=False,
        )
    # not from the screen: other ranks may print into the middle of its lines
    log = folder / LOG
    tables = thermo_tables(log.read_text(errors="replace")) if log.exists() else []
    return Run(done.returncode, done.stdout, tables)


def good(deck: str, **options) -> Run:
    """As run, but the deck must succeed."""
    result = run(deck, **options)
    if result.code != 0 or not result.tables:
        raise AssertionError(f"deck failed with exit code {result.code}:\n{result.text[-3000:]}")
    return result


def thermo_tables(text: str) -> list[dict[str, np.ndarray]]:
    tables, rows, names = [], [], None
    for line in text.splitlines() + ["Loop time"]:
        words = line.split()
        if words[:1] == ["Step"]:
            names, rows = words, []
        elif names and line.startswith("Loop time"):
            columns = np.array(rows, dtype=float).T
            tables.append(dict(zip(names, columns)))
            names = None
        elif names and len(words) == len(names) and re.match(r"^\d+$", words[0]):
            rows.append([float(word) for word in words])
    return tables


def largest_difference(a: np.ndarray, b: np.ndarray) -> float:
    """max |a - b| relative to the largest |b|; 0 where both vanish."""
    scale = np.max(np.abs(b))
    difference = np.max(np.abs(a - b))
    return difference if scale == 0.0 else difference / scale

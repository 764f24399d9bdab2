# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the solver, a few at a time, each in a folder of its own."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Callable, Iterator, Mapping, Sequence

LOG = "log.txt"


@dataclass(frozen=True)
class Solver:
    """The executable and the number of MPI ranks it runs on."""

    program: Path
    ranks: int = 1

    def command(self, deck: str, variables: Mapping[str, str]) -> list[str]:
        launcher = ["mpirun", "--bind-to", "none", "-np", str(self.ranks)] if self.ranks > 1 else []
        options = [word for name, value in variables.items() for word in ("-var", name, value)]
        by_line = ["stdbuf", "-oL"]  # the log is read while it grows
        return [*launcher, *by_line, str(self.program), "-in", deck, "-log", "none", *options]

    def environment(self) -> dict[str, str]:
        """Open MPI runs as root, and oversubscribes, only where it is told to."""
        environment = dict(os.environ)
        if os.geteuid() == 0:
            environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        if self.ranks > cores():
            environment["OMPI_MCA_rmaps_base_oversubscribe"] = "1"
        environment["OMPI_MCA_mpi_yield_when_idle"] = "1"  # other runs may want the cores of a rank that waits
        return environment


def cores() -> int:
    """Cores this process may use."""
    return len(os.sched_getaffinity(0))


@dataclass
class Run:
    """One start of the solver; `folder` gets the deck's files and all that the run writes."""

    name: str
    source: Path  # the deck's folder
    deck: str
    variables: Mapping[str, str]
    folder: Path
    files: Callable[[], Mapping[str, str]] = dict  # name -> text, written beside the deck
    ranks: int | None = None  # in place of the solver's
    after: Run | None = None  # starts when that has ended, with the files it leaves
    leaves: Sequence[str] = ()  # patterns of files for the runs after this one
    environment: Mapping[str, str] = field(default_factory=dict)  # beyond the solver's own
    written: Sequence[str] = ()  # their names, once it has started
    seconds: float = 0.0
    process: subprocess.Popen | None = field(default=None, repr=False)

    def start(self, solver: Solver, sessions: Path) -> None:
        """`sessions`: a folder of its own for those of Open MPI, which may not be there: in a common one a run that ends may
        take away what another has just begun."""
        ignored = shutil.ignore_patterns("*.py", "*.md", "__pycache__")
        shutil.copytree(self.source, self.folder, ignore=ignored)
        files = self.files()
        for name, text in files.items():
            (self.folder / name).write_text(text, encoding="utf-8")
        self.written = list(files)
        for pattern in self.after.leaves if self.after else ():
            for left in self.after.folder.glob(pattern):
                shutil.copyfile(left, self.folder / left.name)
        solver = replace(solver, ranks=self.ranks or solver.ranks)
        self.seconds = -time.monotonic()
        with open(self.folder / LOG, "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                solver.command(self.deck, self.variables),
                cwd=self.folder,
                env={**solver.environment(), "OMPI_MCA_orte_tmpdir_base": str(sessions), **self.environment},
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
            )

    def finished(self) -> bool:
        if self.process.poll() is None:
            return False
        self.seconds += time.monotonic()
        return True

    def log(self) -> str:
        """What the solver has printed so far."""
        return (self.folder / LOG).read_text(encoding="utf-8", errors="replace")

    def failure(self) -> str | None:
        """None if the run went well, else the solver's own words."""
        if self.process.returncode == 0:
            return None
        errors = [line for line in self.log().splitlines() if line.startswith("ERROR")]
        return errors[0] if errors else f"the solver ended with code {self.process.returncode}"


def run_all(
    runs: Sequence[Run],
    solver: Solver,
    jobs: int | None,
    watch: Callable[[int, Sequence[Run]], None],
) -> Iterator[Run]:
    """Runs `jobs` at a time (None: as many as the cores have room for) and yields each as it ends.

    To close the generator stops what runs.  `watch(done, running)` is called a few times a second.
    """
    waiting, running, done = list(runs), [], 0

    def ranks(run: Run) -> int:
        return run.ranks or solver.ranks

    def room(run: Run) -> bool:
        if jobs:
            return len(running) < jobs
        return not running or sum(map(ranks, [*running, run])) <= cores()

    sessions = tempfile.mkdtemp()
    try:
        while waiting or running:
            busy = [id(run) for run in waiting + running]
            for run in [run for run in waiting if id(run.after) not in busy]:
                if room(run):
                    waiting.remove(run)
                    run.start(solver, Path(sessions, str(id(run))))
                    running.append(run)
            watch(done, running)
            time.sleep(0.1)
            for run in [run for run in running if run.finished()]:
                running.remove(run)
                done += 1
                yield run
    finally:
        for run in running:
            run.process.terminate()
        for run in running:
            run.process.wait()
        shutil.rmtree(sessions, ignore_errors=True)

# SPDX-License-Identifier: GPL-2.0-or-later
"""The chosen cases of a study, from the variables the user set to the files in out/<deck>/."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from contextlib import closing
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Mapping, Sequence

from study.run.case import Case, Result, Study, index_variables, numbers, run_variables
from study.run.progress import Progress
from study.run.pulse import NoPulse
from study.run.solver import LOG, Run, Solver, run_all
from study.run.summary import Row, read_json, table, write_json
from study.run.usage import one_of


@dataclass
class Batch:
    """`user` holds the -var words; results of cases that were run are kept by case name."""

    folder: Path
    study: Study
    cases: Sequence[Case]
    user: Mapping[str, str]
    results: dict[str, Result] = field(default_factory=dict)
    rows: dict[str, list[Row]] = field(default_factory=dict)
    complete: bool = True

    def defaults(self, case: Case) -> dict[str, str]:
        return index_variables(self.folder / case.deck)

    def check_variables(self) -> None:
        """UsageError for a -var that no chosen case's deck has, or whose value is none."""
        known = sorted({name for case in self.cases for name in self.defaults(case)})
        for name in self.user:
            one_of("variable", name, known)
        for case in self.cases:
            run_variables(case, self.defaults(case), self.user)

    def runs(self, scratch: Path) -> list[tuple[Run, list[Case]]]:
        """One run for all cases that set the same variables of the same deck."""
        shared: dict[tuple, tuple[Run, list[Case]]] = {}
        for case in self.cases:
            variables = run_variables(case, self.defaults(case), self.user)
            files = partial(case.files, numbers(variables)) if case.files else dict
            own = dict(ranks=case.ranks, leaves=case.leaves)
            run = Run(case.name, self.folder, case.deck, variables, scratch / case.name, files, **own)
            same = (case.deck, tuple(numbers(variables).items()), case.after, case.ranks)
            shared.setdefault(same, (run, []))[1].append(case)
        run_of = {case.name: run for run, cases in shared.values() for case in cases}
        for run, (case, *_) in shared.values():
            run.after = run_of.get(case.after)
        return list(shared.values())

    def run(self, solver: Solver, jobs: int | None, keep_going: bool, out: Path) -> bool:
        """Runs everything and writes `out`; whether every run and every row went well."""
        out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".run-", dir=out) as scratch:
            self.run_cases(self.runs(Path(scratch)), solver, jobs, keep_going, out)
            if not self.complete and not keep_going:
                return False
            for figure in self.study.figures:
                if set(figure.cases) <= self.results.keys():
                    figure.draw(out / figure.file, self.results)
            rows = [row for case in self.cases for row in self.rows[case.name]]
            for comparison in self.study.comparisons:
                if set(comparison.cases) <= self.results.keys():
                    rows += [replace(row, of=tuple(comparison.cases)) for row in comparison.rows(self.results)]
        self.record(self.cases, rows, out)
        print(table(rows))
        return self.complete and all(row.passes is not False for row in rows)

    def forget(self, cases: Sequence[Case], out: Path) -> None:
        """What earlier runs of these cases left in summary and figures; that of the others stays."""
        for figure in self.study.figures:
            if {case.name for case in cases} & set(figure.cases):
                (out / figure.file).unlink(missing_ok=True)
        self.record(cases, [], out)

    def record(self, cases: Sequence[Case], rows: Sequence[Row], out: Path) -> None:
        """Rows in place of those of the summary that are about these cases, or whose files are gone."""
        again = {case.name for case in cases}
        summary = out / "summary.json"
        rows = [row for row in read_json(summary) if self.holds(row, again, out)] + [*rows]
        if rows:
            write_json(summary, self.folder.name, self.in_order(rows))
        else:
            summary.unlink(missing_ok=True)

    @staticmethod
    def holds(row: dict, again: set[str], out: Path) -> bool:
        """Whether a row of the summary is about none of the cases `again`, and its files are there."""
        return not again & set(row["of"]) and all((out / f"log_{case}.txt").exists() for case in row["of"])

    def in_order(self, rows: Sequence[Row | dict]) -> list[dict]:
        """Rows of single cases in the order of the study, then comparisons."""
        place = {case.name: i for i, case in enumerate(self.study.cases)}
        dicts = [row if isinstance(row, dict) else row.as_dict() for row in rows]
        return sorted(dicts, key=lambda row: place.get(row["of"][0], 0) if len(row["of"]) == 1 else len(place))

    def run_cases(
        self,
        runs: Sequence[tuple[Run, list[Case]]],
        solver: Solver,
        jobs: int | None,
        keep_going: bool,
        out: Path,
    ) -> None:
        """Fills results and rows, writes histories and logs; stops at a failure unless keep_going."""
        cases = {run.name: cases for run, cases in runs}
        progress = Progress(len(runs))
        with closing(run_all([run for run, _ in runs], solver, jobs, progress.watch)) as ended:
            for done, run in enumerate(ended, start=1):
                failure = run.failure() or self.take(run, cases[run.name])
                progress.finished(done, run, failure)
                self.publish(run, cases[run.name], out, failure)
                if failure and not keep_going:
                    return

    def take(self, run: Run, cases: Sequence[Case]) -> str | None:
        """Keeps the results and rows of a run; why it cannot, if so."""
        for case in cases:
            before = numbers(run_variables(case, self.defaults(case), {}))
            values = numbers(run.variables)
            changed = frozenset(name for name in values if values[name] != before[name])
            result = Result(case.name, values, changed, run.folder)
            try:
                self.rows[case.name] = case.rows(result)
            except NoPulse as error:
                return str(error)
            self.results[case.name] = result
        return None

    def publish(self, run: Run, cases: Sequence[Case], out: Path, failure: str | None) -> None:
        """Logs and force histories under each case's name, and its rows; a row that says so if it failed."""
        self.forget(cases, out)
        for case in cases:
            put(run.folder / LOG, out / f"log_{case.name}.txt")
            if failure:
                self.complete = False
                self.rows[case.name] = [Row(case.name, "completed", 0.0, "1", 1.0, 0.0)]
                (out / f"contact_force_{case.name}.csv").unlink(missing_ok=True)  # an earlier run's
                shutil.rmtree(out / case.name, ignore_errors=True)
            else:
                forces = [path.name for path in run.folder.glob("contact_force.csv")]  # a packing has none
                for name in [*forces, *run.written]:
                    stem, dot, ending = name.partition(".")
                    put(run.folder / name, out / f"{stem}_{case.name}{dot}{ending}")
                self.keep(run.folder, case, out / case.name)
        if failure:
            print(f"see {out / f'log_{run.name}.txt'}", file=sys.stderr)
        else:
            self.record(cases, [row for case in cases for row in self.rows[case.name]], out)

    @staticmethod
    def keep(folder: Path, case: Case, out: Path) -> None:
        """The further files of a case; those of an earlier run are gone."""
        shutil.rmtree(out, ignore_errors=True)
        files = [path for pattern in case.keep for path in sorted(folder.glob(pattern))]
        if files:
            out.mkdir()
        for path in files:
            shutil.copyfile(path, out / path.name)


def put(source: Path, target: Path) -> None:
    """Copies a file, as a whole or not at all."""
    partial = target.with_name(target.name + ".partial")
    shutil.copyfile(source, partial)
    os.replace(partial, target)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks of the kinds that LIGGGHTS' tutorials have, with its wall of triangles and with this one: totals, losses, time.

usage: inputs/run tutorials [--case NAME] [--out DIR] [--solver LIGGGHTS_NURBS]
"""

from __future__ import annotations

import math
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Sequence

sys.path.insert(0, str(Path(__file__).parent))
from kinds import KINDS, Kind, Total  # noqa: E402  (files of this folder)
from runs import Outcome, RunFailed, run as run_deck  # noqa: E402
from study.run.summary import Row  # noqa: E402

PROGRAM = "liggghts-nurbs"
BENCHMARKS = KINDS
SEEDS = (15485863, 49979687, 67867967, 86028121, 104395301)  # primes that no deck has; of both walls
RANKS = 2  # on which all seeds run, too: LIGGGHTS inserts differently there
TURNS = 3  # runs of the first seed of which the least time counts
TIME = 1.03  # the aim: this wall's time over LIGGGHTS'


def run(kind: Kind, program: Path) -> list[Row]:
    """All runs of a kind, the walls in turns, and what is made of them."""
    stock = Path(shutil.which("liggghts") or "liggghts")
    with tempfile.TemporaryDirectory() as scratch:
        count = iter(range(1000))

        def deck(wall: str, seed: int, ranks: int = 1) -> Outcome:
            folder = Path(scratch) / str(next(count))
            outcome = run_deck(stock if wall == "stock" else program, kind, wall, seed, ranks, folder)
            shutil.rmtree(folder)
            return outcome

        try:
            pairs = [(deck("stock", seed), deck("nurbs", seed)) for seed in (SEEDS[0],) * (TURNS - 1) + SEEDS]
            several = [(deck("stock", seed, RANKS), deck("nurbs", seed, RANKS)) for seed in SEEDS if kind.parallel]
        except RunFailed as error:
            return [Row(kind.name, "run", math.nan, "", 1.0, 0.0, str(error))]
    rows = compared(kind.name, kind.totals, pairs[TURNS - 1 :]) + [time_row(kind.name, pairs[:TURNS])]
    return rows + (compared(f"{kind.name} on {RANKS} ranks", kind.totals, several) if several else [])


def compared(name: str, totals: Sequence[Total], pairs: Sequence[tuple[Outcome, Outcome]]) -> list[Row]:
    theirs, ours = zip(*pairs)
    return total_rows(name, totals, theirs, ours) + loss_rows(name, theirs, ours)


def total_rows(name: str, totals: Sequence[Total], theirs: Sequence[Outcome], ours: Sequence[Outcome]) -> list[Row]:
    """The mean of our runs beside the range of theirs: its middle, and half of its width as the tolerance."""
    rows = []
    for total in totals:
        stock = [outcome.totals[total.name] for outcome in theirs]
        value = sum(outcome.totals[total.name] for outcome in ours) / len(ours)
        middle, half = (max(stock) + min(stock)) / 2.0, (max(stock) - min(stock)) / 2.0
        rows.append(Row(name, total.name, value, total.unit, middle, half / abs(middle) if middle else half))
    own = f"{outside(totals, theirs, theirs):.2f} with LIGGGHTS' wall"
    return [*rows, Row(name, "outside_of_other_seeds", outside(totals, theirs, ours), "1", note=own)]


def outside(totals: Sequence[Total], theirs: Sequence[Outcome], runs: Sequence[Outcome]) -> float:
    """The share of single totals that are outside of the range of LIGGGHTS' runs with the other seeds."""
    found = []
    for total in totals:
        stock = [outcome.totals[total.name] for outcome in theirs]
        for i, outcome in enumerate(runs):
            others = stock[:i] + stock[i + 1 :]
            found.append(not min(others) <= outcome.totals[total.name] <= max(others))
    return sum(found) / len(found)


def loss_rows(name: str, theirs: Sequence[Outcome], ours: Sequence[Outcome]) -> list[Row]:
    def missing(outcomes: Sequence[Outcome]) -> int:
        return sum(outcome.lost + outcome.passed for outcome in outcomes)

    note = f"{missing(theirs)} with LIGGGHTS' wall" if missing(theirs) else ""
    return [Row(name, "lost_or_passed", missing(ours), "1", 0.0, 0.0, note)]


def time_row(name: str, pairs: Sequence[tuple[Outcome, Outcome]]) -> Row:
    """Of whole runs, the least of each wall; no verdict, since it depends on the machine."""
    theirs, ours = (min(pair[i].seconds for pair in pairs) for i in (0, 1))
    note = f"{ours:.2f} s over {theirs:.2f} s" + (f", above {TIME}" if ours > TIME * theirs else "")
    return Row(name, "time_over_LIGGGHTS", ours / theirs, "1", note=note)

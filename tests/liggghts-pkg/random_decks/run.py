#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: run.py COUNT [--first SEED] [--jobs N] [--keep FOLDER]

Draws COUNT decks from the seeds SEED, SEED + 1, ... and holds each against itself on other ranks, after a restart, beside
stock walls, and against the balance of momentum and energy.  README.md of this folder says how.  Each deck that fails is
printed with the command that repeats it; the exit code is 1 if any does.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import traceback
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent.parent)]

import checks  # noqa: E402
import deck as random_deck  # noqa: E402
import decks  # noqa: E402

# more ranks than cores: those that wait let the others work
ENVIRONMENT = {"OMPI_MCA_mpi_yield_when_idle": "1"}


@dataclass
class Outcome:
    seed: int
    kind: str
    done: list[str] = field(default_factory=list)  # checks that held
    failures: list[str] = field(default_factory=list)
    contacts: float = 0.0
    text: str = ""


def run_variant(deck: random_deck.Deck, folder: Path, name: str, ranks: int = 1, **words) -> checks.Run:
    sub = folder / name
    sub.mkdir()
    file = deck.wall.file
    (sub / deck.wall.name).write_bytes(file if isinstance(file, bytes) else file.encode())
    if words.get("begin"):
        (sub / "half.restart").write_bytes((folder / "ranks_a" / "half.restart").read_bytes())
    program = decks.STOCK if words.get("variant") == "primitive" else decks.NURBS
    result = decks.run_in(sub, deck.text(**words), ranks=ranks, program=program, environment=ENVIRONMENT)
    if result.code != 0 or not result.tables:
        raise AssertionError(f"{name} ended with exit code {result.code}:\n{result.text[-1500:]}")
    return checks.read(result, sub)


def examine(deck: random_deck.Deck, folder: Path) -> Outcome:
    """Runs the deck's variants and all checks that apply."""
    outcome = Outcome(deck.seed, deck.kind, text=deck.text(processors=deck.processors[0]))

    def attempt(name: str, check) -> None:
        try:
            check()
            outcome.done.append(name)
        except (AssertionError, subprocess.TimeoutExpired) as problem:
            outcome.failures.append(str(problem))
        except Exception:  # a check that cannot read what a run wrote is a failure of this deck
            outcome.failures.append(traceback.format_exc())

    def run(name: str, ranks: int = 1, **words) -> checks.Run:
        return run_variant(deck, folder, name, ranks, **words)

    (a, b), (grid_a, grid_b) = deck.ranks, deck.processors
    try:
        ours = run("ranks_a", a, processors=grid_a)
    except (AssertionError, subprocess.TimeoutExpired) as problem:
        outcome.failures.append(str(problem))
        return outcome
    outcome.contacts = float(ours.rows["wall[7]"].max())
    attempt("ledger", lambda: checks.check_ledger(deck, ours))
    attempt("ranks", lambda: checks.check_ranks(deck, ours, run("ranks_b", b, processors=grid_b)))
    if deck.restart_at:
        attempt("restart", lambda: checks.check_restart(
            deck, ours, run("restart", a, processors=grid_a, begin=deck.restart_at)))
    if deck.wall.primitive:
        attempt("stock", lambda: checks.check_beside_stock(deck, ours, run("stock", variant="primitive")))
    elif deck.kind == "flat twin":
        attempt("stock", lambda: checks.check_beside_stock(deck, ours, run("stock", variant="twin")))
    elif deck.kind == "curved twin":
        attempt("twin", lambda: checks.check_curved_twin(deck, ours, run("stock", variant="twin")))
    if deck.conservative:
        attempt("energy", lambda: checks.check_energy(deck, ours))
    return outcome


def examine_seed(seed: int, keep: Path | None) -> Outcome:
    deck = random_deck.draw(seed)
    if keep:
        folder = keep / str(seed)
        folder.mkdir(parents=True)
        return examine(deck, folder)
    with tempfile.TemporaryDirectory() as folder:
        return examine(deck, Path(folder))


def report(outcome: Outcome) -> None:
    state = "FAILED" if outcome.failures else "ok"
    print(f"deck {outcome.seed} ({outcome.kind}): {state}; {', '.join(outcome.done)}; "
          f"{outcome.contacts:.0f} contacts at once", flush=True)
    if not outcome.failures:
        return
    print(f"--- the deck of seed {outcome.seed}\n{outcome.text}---")
    for failure in outcome.failures:
        print(f"seed {outcome.seed}: {failure}")
    print(f"to repeat it and keep its files: tests/run --random-decks 1 --first {outcome.seed} --keep FOLDER", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1])
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="seed of the first deck; default 0")
    parser.add_argument("--jobs", type=int, default=2, help="decks that run at once; default 2")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="where decks and what they wrote are kept")
    words = parser.parse_args()
    with ThreadPoolExecutor(words.jobs) as pool:
        outcomes = []
        for outcome in pool.map(lambda seed: examine_seed(seed, words.keep), range(words.first, words.first + words.count)):
            report(outcome)
            outcomes.append(outcome)
    failed = [outcome.seed for outcome in outcomes if outcome.failures]
    held = {name: sum(name in o.done for o in outcomes) for name in ("ledger", "ranks", "restart", "stock", "twin", "energy")}
    print(f"{len(outcomes)} decks, {len(failed)} failed {failed or ''}; checks that held: "
          + ", ".join(f"{count} {name}" for name, count in held.items())
          + f"; {sum(o.contacts > 0 for o in outcomes)} decks with contact")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

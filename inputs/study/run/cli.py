# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/run: runs a deck's study, compares it with its references, writes out/<deck>/."""

from __future__ import annotations

import argparse
import errno
import os
import re
import shutil
import subprocess
import sys
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Sequence

from study.run.usage import UsageError, one_of

INPUTS = Path(__file__).resolve().parents[2]
ROOT = INPUTS.parent
SOLVER = ROOT / "build/release/liggghts-pkg/liggghts-nurbs"
PROGRAMS = {"liggghts-nurbs": SOLVER, "iga-solve": ROOT / "build/release/iga-solver/app/iga-solve"}

EXIT_PASS, EXIT_FAIL, EXIT_USAGE, EXIT_INTERRUPTED = 0, 1, 2, 130

FULL = {errno.ENOSPC, errno.EDQUOT}
NOT_WRITABLE = {errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOTDIR, errno.EEXIST}


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="inputs/run",
        description="Runs the study of a deck, prints a table and writes out/DECK/ "
        "(summary.json, contact_force_CASE.csv, log_CASE.txt, figures).",
        epilog="Exit code: 0 if every row with a reference passes, 1 if not, 2 if misused or "
        "if results or build cannot be written.",
        allow_abbrev=False,
    )
    add = parser.add_argument
    add("deck", metavar="DECK", nargs="?", help="a folder of inputs/; see --list")
    add("--list", action="store_true", help="show the decks; with DECK, its cases")
    again = dict(action="append", default=[])
    add("--case", metavar="NAME", **again, help="only this case; may be repeated, * matches")
    pair = dict(metavar=("NAME", "VALUE"), nargs=2, **again)
    add("-var", **pair, help="a variable of the deck, in place of what deck and case say")
    add("--ranks", metavar="N", type=positive, help="MPI ranks of each run (1; trb: 2)")
    add("--jobs", metavar="N", type=positive, help="runs at a time (one rank per core)")
    add("--keep-going", action="store_true", help="go on after a run that failed")
    add("--out", metavar="DIR", type=Path, help="folder for the results (out/DECK)")
    add("--solver", metavar="FILE", type=Path, help="run this executable and build nothing")
    return parser.parse_args(arguments)


def positive(word: str) -> int:
    """A whole number >= 1, or argparse's message."""
    if not word.isdecimal() or int(word) < 1:
        raise argparse.ArgumentTypeError(f"'{word}' is not a whole number >= 1")
    return int(word)


def decks() -> dict[str, str]:
    """Name and one line of each deck: the heading of its README."""
    found = {}
    for study in sorted([*INPUTS.glob("*/study.py"), *INPUTS.glob("*/benchmarks.py")]):
        heading = (study.parent / "README.md").read_text(encoding="utf-8").splitlines()
        found[study.parent.name] = next(line[2:] for line in heading if line.startswith("# "))
    return found


def list_decks() -> None:
    for name, line in decks().items():
        print(f"{name:22s}{line}")


def chosen(cases: Sequence, wanted: Sequence[str]) -> list:
    """The cases that --case names and those that they start from, in the order of the study.

    Without --case: all but those that run on request."""
    for pattern in wanted:
        if not any(fnmatchcase(case.name, pattern) for case in cases):
            one_of("case", pattern, [case.name for case in cases])
    named = [case for case in cases if any(fnmatchcase(case.name, p) for p in wanted)]
    named = named or [case for case in cases if not case.on_request]
    return [case for case in cases if case in named or case.name in {other.after for other in named}]


def set_up(*arguments: str) -> None:
    """inputs/setup explains what went wrong by itself; it ends with 2 where nothing can be written."""
    code = subprocess.run([INPUTS / "setup", *arguments], check=False).returncode
    if code:
        raise SystemExit(EXIT_USAGE if code == EXIT_USAGE else EXIT_FAIL)


def why_not(error: OSError) -> str:
    """One line about a file, folder or program that cannot be used, and a way out where another folder is one."""
    if isinstance(error, shutil.Error):  # of copytree: [(from, to, "[Errno 28] No space left on device: ..."), ...]
        number, why = re.match(r"(?:\[Errno (\d+)\] )?(.*)", error.args[0][0][2]).groups()
        error = OSError(int(number or 0), why)
    where = f"{error.filename}: " if error.filename else ""
    way_out = ""
    if error.errno in FULL:
        way_out = "; free some space, or name a folder elsewhere with --out DIR"
    elif error.errno in NOT_WRITABLE:
        way_out = "; name a folder that can be written to with --out DIR"
    return f"{where}{error.strerror or error}{way_out}"


def main(arguments: Sequence[str]) -> int:
    args = parse(arguments)
    try:
        return dispatch(args)
    except UsageError as error:
        print(f"inputs/run: {error}", file=sys.stderr)
        return EXIT_USAGE
    except OSError as error:
        print(f"inputs/run: {why_not(error)}", file=sys.stderr)
        return EXIT_USAGE
    except KeyboardInterrupt:
        print("\ninputs/run: interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED


def dispatch(args: argparse.Namespace) -> int:
    if args.deck is None:
        if not args.list:
            raise UsageError("which deck? inputs/run --list shows them, --help the options")
        list_decks()
        return EXIT_PASS
    folder = INPUTS / one_of("deck", args.deck, decks())
    if args.solver and not os.access(args.solver, os.X_OK):
        raise UsageError(f"--solver {args.solver} is no executable file")
    if not args.solver:
        set_up("--packages")
    if (folder / "benchmarks.py").exists():
        return run_benchmarks(args, folder)

    from study.run.batch import Batch  # these need the packages
    from study.run.case import load
    from study.run.solver import Solver

    study = load(folder)
    if args.list:
        print("\n".join(case.name for case in study.cases))
        return EXIT_PASS
    batch = Batch(folder, study, chosen(study.cases, args.case), dict(args.var))
    batch.check_variables()
    if not args.solver:
        set_up("liggghts-nurbs", "iga-solve")
    solver = Solver((args.solver or SOLVER).resolve(), args.ranks or study.ranks)
    out = args.out or ROOT / "out" / args.deck
    return EXIT_PASS if batch.run(solver, args.jobs, args.keep_going, out) else EXIT_FAIL


def run_benchmarks(args: argparse.Namespace, folder: Path) -> int:
    from study.run.benchmarks import load, run_all

    module = load(folder)
    if args.list:
        print("\n".join(dict.fromkeys(benchmark.name for benchmark in module.BENCHMARKS)))
        return EXIT_PASS
    if not args.solver:
        set_up(module.PROGRAM)
    out = args.out or ROOT / "out" / args.deck
    return EXIT_PASS if run_all(module, args.case, args.solver or PROGRAMS[module.PROGRAM], out) else EXIT_FAIL


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

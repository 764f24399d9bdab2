# SPDX-License-Identifier: GPL-2.0-or-later
"""What solids of up to a million elements take: set-up, memory, forces and steps.  Prints the table and writes
OUT/summary.json in the shape of the studies' summaries.  A figure passes up to its reference; slow is reported, never an
error.  A solid is METHOD:BODY:N for N x N x N elements, degree 2."""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path

from bounds import AtMost
from study.run.summary import Row, table, write_json

SOLIDS = ["auto:plate:100", "auto:distorted:100", "stored:distorted:50", "stored:rational:50", "plain:plate:30"]
MILLION = 1_000_000  # elements, of which the figures aimed at speak


def rows(seen: dict) -> list[Row]:
    """Of what large_solid has printed."""
    dofs, elements = seen["dofs"], seen["elements"]
    case = f"{seen['method']} {seen['body']} {elements:.1g} elements"

    def most(reference: float) -> float | None:
        return reference if elements == MILLION and seen["method"] != "plain" else None

    result = [
        AtMost(case, "solid_memory", seen["solid_bytes"] / 1e9, "GB", most(0.7)),
        Row(case, "solid_bytes_per_dof", seen["solid_bytes"] / dofs, "B"),
        Row(case, "solver_bytes_per_dof", seen["solver_bytes"] / dofs, "B"),
        Row(case, "peak_memory", seen["peak_bytes"] / 1e9, "GB"),
        AtMost(case, "set_up", seen["set_up"], "s", most(5.0)),
        Row(case, "set_up_per_element", 1e6 * seen["set_up"] / elements, "us"),
    ]
    if seen["stable_step"] is not None:
        with_step = seen["set_up"] + seen["stable_step"]
        result.append(AtMost(case, "set_up_with_stable_step", with_step, "s", most(10.0)))
    return [
        *result,
        Row(case, "force_time_per_dof", 1e9 * seen["force"] / dofs, "ns"),
        Row(case, "step_time_per_dof", 1e9 * seen["step"] / dofs, "ns"),
        AtMost(case, "step_over_force", seen["step"] / seen["force"], "1", most(1.15)),
    ]


def measure(program: str, solid: str, stable: bool) -> dict:
    method, body, n = solid.split(":")
    command = [program, method, body, n, "2", *(["--stable"] if stable else [])]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="large_solid")
    parser.add_argument("out", type=Path)
    parser.add_argument("--no-stable", action="store_true", help="without the stable step")
    parser.add_argument("solids", nargs="*", metavar="METHOD:BODY:N", default=SOLIDS)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    found = [row for solid in args.solids for row in rows(measure(args.program, solid, not args.no_stable))]
    write_json(args.out / "summary.json", "large_solids", found)
    print(table(found))


if __name__ == "__main__":
    sys.exit(main())

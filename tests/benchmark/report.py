# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: report.py BENCHMARK LIGGGHTS_NURBS OUT [Google Benchmark options]
Runs the benchmarks, prints times and ratios, and writes OUT/summary.json in the shape of the studies' summaries.
Options choose among the benchmarks; then fix wall/nurbs is not timed.  A ratio passes from its reference upwards, a
time up to it; slow is reported, never an error."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Mapping

import wall
from bounds import AtLeast, AtMost
from study.run.summary import Row, table, write_json

CONTACT_SURFACES = ["plate", "wavy", "cylinder", "saddle"]  # what the figures of a contact and step are means of
SURFACES = [*CONTACT_SURFACES, "rippled"]
ELEMENTS = [31, 124]
# Peers take turns in random order, many short times each: what else the machine does hits all of them.
OPTIONS = [
    "--benchmark_repetitions=9",
    "--benchmark_min_time=0.05",
    "--benchmark_enable_random_interleaving=true",
    "--benchmark_report_aggregates_only=true",
]
TITLES = {
    "warm/ours": "warm",
    "warm_call/ours": "warm_call",
    "batch/ours": "warm_batch",
    "warm/portable": "warm_portable",
    "warm/avx2": "warm_avx2",
    "warm/avx512": "warm_avx512",
    "batch/portable": "warm_batch_portable",
    "batch/avx2": "warm_batch_avx2",
    "batch/avx512": "warm_batch_avx512",
    "nearest/ours": "nearest",
    "warm/opencascade": "opencascade_warm",
    "warm/simplex_brent": "simplex_brent_warm",
    "cold/ours": "cold",
    "cold/opencascade": "opencascade_cold",
    "rebuild/ours": "rebuild_per_element",
    "refit/ours": "tree_refit_per_element",
    "distribution/ours": "distribution_per_contact",
    "step/ours": "rebuild_projection_distribution_per_contact",
    "step_batch/ours": "rebuild_batch_projection_distribution_per_contact",
}
LEVELS = ("portable", "avx2", "avx512")  # instruction sets; timed where the machine has them
KINDS = ("warm/", "warm_call/", "batch/", "nearest/", "cold/")
SEARCHES = [what for what in TITLES if what.startswith(KINDS) and not what.endswith(LEVELS)]
STEP_TARGET = 110.0  # ns, a prototype's


@dataclass(frozen=True)
class Timing:
    """Median over the repetitions."""

    nanoseconds: float  # thread CPU time of one point, element or contact
    right: float | None  # fraction of the points whose foot is right, where feet are found


@dataclass(frozen=True)
class Ratio:
    """Time of `slow` over time of `fast`."""

    quantity: str
    slow: str
    fast: str
    targets: Mapping[tuple[str, int], float]  # by surface and elements per direction


def everywhere(target: float, but: tuple[str, ...] = ()) -> dict[tuple[str, int], float]:
    return {(surface, n): target for surface in SURFACES if surface not in but for n in ELEMENTS}


RATIOS = [
    Ratio("warm_speedup_over_opencascade", "warm/opencascade", "warm/ours", everywhere(20.0, but=("plate", "rippled"))),
    Ratio("warm_speedup_over_simplex_brent", "warm/simplex_brent", "warm/ours", everywhere(10.0)),
    Ratio("batch_speedup_over_single_avx512", "warm/avx512", "batch/avx512", everywhere(2.0)),
    Ratio("batch_speedup_over_single_avx2", "warm/avx2", "batch/avx2", {}),
    Ratio("batch_speedup_over_single_portable", "warm/portable", "batch/portable", {}),
    Ratio(
        "cold_speedup_over_opencascade",
        "cold/opencascade",
        "cold/ours",
        {("rippled", 31): 5.0} | {(s, n): {31: 5.0, 124: 100.0}[n] for s in CONTACT_SURFACES for n in ELEMENTS},
    ),
]


def timings(output: dict) -> dict[str, Timing]:
    """Medians by name, WHAT/METHOD/SURFACE/N."""
    medians = (b for b in output["benchmarks"] if b.get("aggregate_name") == "median")
    return {b["run_name"]: Timing(b["cpu_time"], b.get("right")) for b in medians}


def rows(times: Mapping[str, Timing]) -> list[Row]:
    """Of everything that was timed; a ratio needs both sides."""
    result = []
    for surface in SURFACES:
        for n in ELEMENTS:
            result += case_rows(times, surface, n)
        result += growth(times, surface)
    return result + step(times)


def case_rows(times: Mapping[str, Timing], surface: str, n: int) -> list[Row]:
    case = f"{surface} {n}x{n}"
    here = {what: times[name] for what in TITLES if (name := f"{what}/{surface}/{n}") in times}
    result = [Row(case, f"{TITLES[what]}_time", time.nanoseconds, "ns") for what, time in here.items()]
    result += [
        Row(case, f"{TITLES[what]}_fraction_right", time.right, "1")
        for what, time in here.items()
        if time.right is not None
    ]
    result += [
        AtLeast(case, r.quantity, here[r.slow].nanoseconds / here[r.fast].nanoseconds, "1", r.targets.get((surface, n)))
        for r in RATIOS
        if r.slow in here and r.fast in here
    ]
    return result


def step(times: Mapping[str, Timing]) -> list[Row]:
    """What a contact costs in a step, one point at a time and in batches: means over the surfaces of few elements."""
    n = ELEMENTS[0]
    quantity = "rebuild_projection_distribution_per_contact_and_step"
    result = []
    for what, name in (("step/ours", quantity), ("step_batch/ours", f"{quantity}_in_batches")):
        found = [times[key].nanoseconds for s in CONTACT_SURFACES if (key := f"{what}/{s}/{n}") in times]
        if len(found) == len(CONTACT_SURFACES):
            result.append(AtMost(f"all {n}x{n}", name, sum(found) / len(found), "ns", STEP_TARGET))
    return result


def growth(times: Mapping[str, Timing], surface: str) -> list[Row]:
    """Cold search on 16 times the elements: a tree's cost grows by little, a scan's by 16."""
    few, many = ELEMENTS
    return [
        Row(f"{surface} {many}x{many}", f"{TITLES[what]}_growth_from_{few}x{few}", b.nanoseconds / a.nanoseconds, "1")
        for what in ("cold/ours", "cold/opencascade")
        if (a := times.get(f"{what}/{surface}/{few}")) and (b := times.get(f"{what}/{surface}/{many}"))
    ]


def run(executable: str, raw: Path, options: list[str]) -> dict:
    """Google Benchmark's own output, kept in `raw`."""
    command = [executable, *OPTIONS, f"--benchmark_out={raw}", "--benchmark_out_format=json", *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.loads(raw.read_text(encoding="utf-8"))


def main(executable: str, liggghts_nurbs: str, out: str, *options: str) -> None:
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    output = run(executable, folder / "google_benchmark.json", list(options))
    result = rows(timings(output)) + ([] if options else wall.rows(liggghts_nurbs))
    write_json(folder / "summary.json", "benchmark", result)
    print(table(result))
    context = output["context"]
    compiled, kernels = context["compiled_for"], context["dispatched_to"]
    print(f"\nMedians of thread CPU time; compiled for: {compiled}; kernels: {kernels}.")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])

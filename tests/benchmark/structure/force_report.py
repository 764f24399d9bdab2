# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: force_report.py BENCHMARK_INTERNAL_FORCE OUT [Google Benchmark options]
Runs the benchmark of internal forces and steps, prints times and ratios, and writes OUT/summary.json in the shape of the
studies' summaries.  A speed-up passes from its reference upwards, a growth up to it; slow is reported, never an error."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Mapping, Sequence

from bounds import AtLeast, AtMost
from study.run.summary import Row, table, write_json

# Peers take turns in random order: what else the machine does hits all of them.
OPTIONS = [
    "--benchmark_repetitions=15",
    "--benchmark_min_time=0.02",
    "--benchmark_enable_random_interleaving=true",
    "--benchmark_report_aggregates_only=true",
]
LINEAR, ROTATING = "linear_elastic", "saint_venant_kirchhoff"
LARGEST_ERROR = 1e-12  # of the largest force


@dataclass(frozen=True)
class Aim:
    """Of a method with linear forces."""

    bandwidth: float | None = None  # shares of what the probes reach, on the plate
    multiply_add: float | None = None
    over_force: float | None = None  # of a step
    bytes: float | None = None  # per dof, degree 2; `rational_bytes` of rational bodies, which store more
    rational_bytes: float | None = None


AIMS = {
    "auto": Aim(multiply_add=0.5, over_force=1.15, bytes=100.0, rational_bytes=100.0),
    "recomputed": Aim(multiply_add=0.5, over_force=1.15, bytes=100.0, rational_bytes=100.0),
    "stored": Aim(bandwidth=0.8, over_force=1.15, bytes=600.0, rational_bytes=800.0),
    "plain": Aim(over_force=1.15),
}


def aim_of(name: str) -> Aim:
    _, method, law, body, degree = name.split("/")
    aim = AIMS.get(method, Aim()) if law == LINEAR else Aim()
    if body != "plate":
        aim = replace(aim, bandwidth=None, multiply_add=None)
    if body == "rational":
        aim = replace(aim, bytes=aim.rational_bytes)
    return aim if degree == "p2" else replace(aim, bytes=None)


PLATES = {2: f"{LINEAR}/plate/p2", 3: f"{LINEAR}/plate/p3"}


@dataclass(frozen=True)
class Timing:
    """Median over the repetitions, of one evaluation; bytes, flops and error where they are known."""

    nanoseconds: float  # thread CPU time
    dofs: float = 1.0
    bytes: float | None = None
    flops: float | None = None
    error: float | None = None  # over the largest force, beside the one integrated on its own
    over_force: float | None = None  # of a step: its time over that of the force alone, which took turns

    @property
    def per_dof(self) -> float:
        return self.nanoseconds / self.dofs


@dataclass(frozen=True)
class Machine:
    """What the probes reach: bytes and floating-point operations per nanosecond."""

    read: float
    multiply_add: float


@dataclass(frozen=True)
class Ratio:
    """Time of `slow` over time of `fast`, both names; passes from `target` upwards, or up to `most`."""

    case: str
    quantity: str
    slow: str
    fast: str
    target: float | None = None
    most: float | None = None

    def row(self, times: Mapping[str, Timing]) -> Row:
        value = times[self.slow].per_dof / times[self.fast].per_dof
        if self.most is not None:
            return AtMost(self.case, self.quantity, value, "1", self.most)
        return AtLeast(self.case, self.quantity, value, "1", self.target)


def ratios() -> list[Ratio]:
    """`auto` is what a model file gets that says nothing of geometry or quadrature."""
    result = []
    over = {"csr": {2: 7.0, 3: 6.0}, "blocks": {2: 5.0, 3: 4.5}, "plain": {2: 12.0, 3: 20.0}}
    for p, plate in PLATES.items():
        case, auto = f"plate p{p}", f"force/auto/{plate}"
        result += [
            Ratio(case, f"speedup_over_{peer}", f"force/{peer}/{plate}", auto, target[p])
            for peer, target in over.items()
        ]
        result.append(Ratio(case, "speedup_over_blocks_huge_pages", f"force/blocks_huge_pages/{plate}", auto))
        rotating = auto.replace(LINEAR, ROTATING)
        result.append(Ratio(case, f"{ROTATING}_over_{LINEAR}", rotating, auto, most=1.25))
        for rule, target in (("reduced", 2.5), ("zou", 8.0)):
            target = target if p == 2 else None
            result.append(Ratio(case, f"{rule}_speedup_over_full", auto, f"force/auto_{rule}/{plate}", target))
    return result


COUNTERS = ("bytes", "flops", "error", "over_force")


def timings(output: dict) -> dict[str, Timing]:
    """Medians by name, WHAT/METHOD/LAW/BODY/pDEGREE, body by body."""
    to_nanoseconds = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
    result = {}
    for b in output["benchmarks"]:
        if b.get("aggregate_name") == "median":
            name, manual = b["run_name"].removesuffix("/manual_time"), b["run_name"].endswith("/manual_time")
            time = b["real_time" if manual else "cpu_time"] * to_nanoseconds[b["time_unit"]]
            result[name] = Timing(time, b.get("dofs", 1.0), *map(b.get, COUNTERS))
    return dict(sorted(result.items(), key=lambda item: (item[0].split("/")[:1:-1], item[0])))


def machine(times: Mapping[str, Timing]) -> Machine | None:
    """The better of ordinary and huge pages."""
    reads = [t.bytes / t.nanoseconds for name, t in times.items() if name.startswith("probe/read")]
    probe = times.get("probe/multiply_add")
    return Machine(max(reads), probe.flops / probe.nanoseconds) if reads and probe else None


def label(name: str) -> tuple[str, str]:
    """Case and method of a name: ("plate p2", "step auto linear_elastic")."""
    what, method, law, body, degree = name.split("/")
    return f"{body} {degree}", f"{what} {method} {law}"


def time_rows(name: str, time: Timing, limits: Machine | None) -> list[Row]:
    case, method = label(name)
    method, aim = method.replace(" ", "_"), aim_of(name)
    result = [Row(case, f"{method}_time_per_dof", time.per_dof, "ns")]
    if time.bytes is not None:
        result.append(AtMost(case, f"{method}_bytes_per_dof", time.bytes / time.dofs, "B", aim.bytes))
        result.append(Row(case, f"{method}_flops_per_dof", time.flops / time.dofs, "1"))
    if time.over_force is not None:
        result.append(AtMost(case, f"{method}_over_force", time.over_force, "1", aim.over_force))
    if time.error is not None:
        result.append(AtMost(case, f"{method}_error", time.error, "1", LARGEST_ERROR))
    if time.bytes is None or limits is None:
        return result
    read, multiply_add = shares(time, limits)
    result.append(AtLeast(case, f"{method}_share_of_bandwidth", read, "1", aim.bandwidth))
    result.append(AtLeast(case, f"{method}_share_of_multiply_add", multiply_add, "1", aim.multiply_add))
    return result


def shares(time: Timing, limits: Machine) -> tuple[float, float]:
    """Of the probes' bandwidth and rate."""
    return time.bytes / time.nanoseconds / limits.read, time.flops / time.nanoseconds / limits.multiply_add


def probe_rows(times: Mapping[str, Timing]) -> list[Row]:
    result = []
    for name, time in times.items():
        if name.startswith("probe/read"):
            result.append(Row("machine", name.removeprefix("probe/"), time.bytes / time.nanoseconds, "GB/s"))
        elif name.startswith("probe/"):
            result.append(Row("machine", name.removeprefix("probe/"), time.flops / time.nanoseconds, "GFlop/s"))
    if limits := machine(times):
        result.append(Row("machine", "balance", limits.multiply_add / limits.read, "flop/B"))
    return result


def ratio_rows(times: Mapping[str, Timing]) -> list[Row]:
    """Of all pairs that were timed."""
    return [ratio.row(times) for ratio in ratios() if ratio.slow in times and ratio.fast in times]


def rows(times: Mapping[str, Timing]) -> list[Row]:
    limits = machine(times)
    result = probe_rows(times)
    for name, time in times.items():
        if not name.startswith("probe/"):
            result += time_rows(name, time, limits)
    return result + ratio_rows(times)


def time_table(times: Mapping[str, Timing]) -> str:
    """One line for each method: ns, bytes and flops per dof, shares of the probes, error."""
    limits = machine(times)
    lines = [["body", "method", "ns/dof", "bytes/dof", "flops/dof", "of bandwidth", "of multiply-add", "error"]]
    for name, time in times.items():
        if name.startswith("probe/"):
            continue
        line = [*label(name), f"{time.per_dof:.4g}"]
        if time.bytes is not None:
            line += [f"{time.bytes / time.dofs:.0f}", f"{time.flops / time.dofs:.0f}"]
            line += [f"{100.0 * share:.0f} %" for share in shares(time, limits)] if limits else ["", ""]
        line += [""] * (7 - len(line)) + ["" if time.error is None else f"{time.error:.1e}"]
        lines.append(line)
    return aligned(lines)


def aligned(lines: Sequence[Sequence[str]]) -> str:
    """Two columns of words, then numbers."""
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    align = [str.ljust, str.ljust] + [str.rjust] * (len(widths) - 2)
    return "\n".join("  ".join(a(c, w) for a, c, w in zip(align, line, widths)).rstrip() for line in lines)


def run(executable: str, raw: Path, options: Sequence[str]) -> dict:
    """Google Benchmark's own output, kept in `raw`."""
    command = [executable, *OPTIONS, f"--benchmark_out={raw}", "--benchmark_out_format=json", *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.loads(raw.read_text(encoding="utf-8"))


def main(executable: str, out: str, *options: str) -> None:
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    output = run(executable, folder / "google_benchmark.json", options)
    times = timings(output)
    found = rows(times)
    write_json(folder / "summary.json", "benchmark_structure", found)
    print(time_table(times), "\n")
    shown = [row for row in found if row.passes is not None or row.case == "machine" or "speedup" in row.quantity]
    print(table([row for row in shown if not row.quantity.endswith("_error")]))  # these are above
    print(f"\nMedians of thread CPU time; kernels: {output['context']['dispatched_to']}.")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])

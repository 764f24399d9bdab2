# SPDX-License-Identifier: GPL-2.0-or-later
"""What memory the wavy wall takes per element: walls of growing size with the same spheres on them."""

from __future__ import annotations

import re
from dataclasses import dataclass

from study.run.summary import Row
from wavy_bench import Bench

ELEMENTS = (62, 124, 248, 496)  # in a row
STEPS = 2500  # enough for spheres to touch
LINEAR = 0.05  # what a further element takes, in the largest walls beside those half as wide
KB = 1024.0
# A fixed threshold: else malloc raises it with what is freed, and keeps freed memory of middle-sized walls.
FREED_GOES_BACK = {"MALLOC_MMAP_THRESHOLD_": str(2**17)}


@dataclass(frozen=True)
class Memory:
    """Of a process [bytes]: what it has, with spheres on the wall; the most it ever had."""

    now: float
    peak: float


def memory(log: str) -> Memory:
    """The last sizes in the output of in.memory, in the form of Linux' /proc."""
    last = {name: KB * int(kilobytes) for name, kilobytes in re.findall(r"^Vm(RSS|HWM):\s+(\d+) kB", log, re.MULTILINE)}
    return Memory(last["RSS"], last["HWM"])


def rows(bench: Bench, spheres: str) -> list[Row]:
    def of_run(geometry: str) -> Memory:
        return memory(bench.run("in.memory", FREED_GOES_BACK, geometry=geometry, spheres=spheres, steps=STEPS))

    taken = {
        kind: {n: of_run(f"continued_{n}.{kind}") for n in numbers}
        for kind, numbers in (("h5", ELEMENTS), ("yaml", ELEMENTS[-2:]))
    }
    found = []
    for kind, sizes in taken.items():
        case = f"memory, {kind} file"
        numbers = list(sizes)
        for n, size in sizes.items():
            found.append(Row(case, f"{n}x{n}", size.now / 2**20, "MiB", note=f"largest {size.peak / 2**20:.0f} MiB"))
        for fewer, more in zip(numbers, numbers[1:]):
            found.append(Row(case, f"per_element_{fewer}_to_{more}", per_element(sizes, fewer, more, "now"), "bytes"))
        found.append(Row(case, "per_element_peak", per_element(sizes, *numbers[-2:], "peak"), "bytes"))
    (a, b, c), sizes = ELEMENTS[-3:], taken["h5"]
    ratio = per_element(sizes, b, c, "now") / per_element(sizes, a, b, "now")
    return found + [Row("memory, h5 file", "per_element_of_larger_over_smaller", ratio, "1", 1.0, LINEAR)]


def per_element(sizes: dict[int, Memory], fewer: int, more: int, when: str) -> float:
    """What each further element takes [bytes]."""
    return (getattr(sizes[more], when) - getattr(sizes[fewer], when)) / (more**2 - fewer**2)

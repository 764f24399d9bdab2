# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: scaling_model.py [--write]
Time per step and memory per rank on paper, from the inputs below.  Prints the tables of SCALING.md, or writes them there."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path

PAGE = Path(__file__).with_name("SCALING.md")
START, END = "<!-- tables: scaling_model.py --write -->", "<!-- end of tables -->"
RANKS = (1, 10, 100, 1_000, 10_000)
DEGREE = 2


@dataclass(frozen=True)
class Input:
    value: float
    unit: str
    meaning: str
    source: str


INPUTS = {
    "step": Input(75.0, "ns", "a step per dof, degree 2, Jacobians recomputed", "`large_solid auto distorted 100`, measured"),
    "contact": Input(164.0, "ns", "a contact per step, its model included", "wavy wall, 2,624 contacts, measured"),
    "particle": Input(300.0, "ns", "a particle per step without walls", "stock LIGGGHTS, 50,000 particles, measured"),
    "own": Input(393.0, "B", "memory per owned node, at its peak", "`ranks.py`, as below"),
    "everywhere": Input(79.0, "B", "memory per node of the body on every rank", "`ranks.py`, large plate: twice the peak on 2 ranks less that on 1"),
    "box": Input(8192.0, "1", "elements of a box, the least that a rank works on", "`box_grid.h`"),
    "latency": Input(2.0, "us", "a message, both ends", "assumed: InfiniBand"),
    "bandwidth": Input(5.0, "GB/s", "of a rank's messages, when all send", "assumed"),
    "sums": Input(14.0, "1", "reductions over all ranks in a step, the deck's included", "`ranks.py`, plate on 2 ranks, measured"),
    "sum_bytes": Input(3920.0, "B", "of each at most, seven exact sums", "`exact_sum.h`, counted"),
}


def value(name: str) -> float:
    """In SI units."""
    scale = {"ns": 1e-9, "us": 1e-6, "GB/s": 1e9, "B": 1.0, "1": 1.0}
    return INPUTS[name].value * scale[INPUTS[name].unit]


@dataclass(frozen=True)
class Step:
    """Seconds of a step of the rank that has most to do; bytes of memory."""

    work: float
    halo: float
    sums: float
    memory: float

    @property
    def total(self) -> float:
        return self.work + self.halo + self.sums


def message_time(messages: float, size: float) -> float:
    return messages * value("latency") + size / value("bandwidth")


def sum_time(ranks: int) -> float:
    """Of all sums of a step, by a tree there and back."""
    stages = 2.0 * math.ceil(math.log2(ranks)) if ranks > 1 else 0.0
    return value("sums") * stages * message_time(1.0, value("sum_bytes"))


def halo_nodes(own: float) -> float:
    """Nodes of neighbours that a box of `own` nodes, a cube, holds: the first DEGREE layers beyond three faces."""
    side = own ** (1.0 / 3.0)
    return (side + DEGREE) ** 3 - own


def halo_time(own: float) -> float:
    """Forces of the halo go to their owners, motion comes back: 3 numbers each, to and from 7 neighbours."""
    return message_time(2 * 7, 2 * 24.0 * halo_nodes(own))


def boxes(nodes: float) -> float:
    """More ranks than these find nothing to do."""
    return max(1.0, nodes / value("box"))


def structure(nodes: float, ranks: int) -> Step:
    """The rank that has most to do."""
    own = nodes / min(ranks, boxes(nodes))
    halo = halo_time(own) if ranks > 1 else 0.0
    memory = own * value("own") + nodes * value("everywhere")
    return Step(3.0 * own * value("step"), halo, sum_time(ranks), memory)


def particles(count: float, nodes: float, ranks: int) -> Step:
    """A bed on a body of `nodes` nodes: ranks hold cubes of particles, a face of them touches the body.  Positions
    come for the elements under the contacts (27 nodes at most), forces go to their owners: 3 + 3 numbers a node."""
    own = count / ranks
    contacts = own ** (2.0 / 3.0)
    body = structure(nodes, ranks)
    surface_nodes = min(27.0 * contacts, nodes ** (2.0 / 3.0))
    ghosts = 6.0 * contacts
    exchange = message_time(2 * 6 + 2 * 7, ghosts * 80.0 + surface_nodes * 48.0) if ranks > 1 else 0.0
    work = own * value("particle") + contacts * value("contact") + body.work
    return Step(work, body.halo + exchange, body.sums, body.memory + own * 1000.0)


CASES = {
    "1e6 control nodes": lambda ranks: structure(1e6, ranks),
    "1e8 control nodes": lambda ranks: structure(1e8, ranks),
    "1e8 particles on 1e6 control nodes": lambda ranks: particles(1e8, 1e6, ranks),
}


def shown(seconds: float) -> str:
    """With three digits, in the unit that suits."""
    for scale, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "us")):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return "0" if seconds == 0.0 else f"{seconds * 1e9:.3g} ns"


def case_table(name: str) -> list[str]:
    one = CASES[name](1)
    lines = ["", f"| {name}: ranks | work | halo | sums | step | efficiency | memory of a rank |", "|---" * 7 + "|"]
    for ranks in RANKS:
        step = CASES[name](ranks)
        cells = [f"{ranks:,}", shown(step.work), shown(step.halo), shown(step.sums), shown(step.total)]
        cells += [f"{100.0 * one.total / (ranks * step.total):.0f} %", f"{step.memory / 1e6:,.0f} MB"]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def half_work() -> float:
    """Owned nodes at which halo and sums on 10,000 ranks take as long as the work: by bisection."""
    low, high = 1.0, 1e9
    while high / low > 1.001:
        own = math.sqrt(low * high)
        work, other = 3.0 * own * value("step"), halo_time(own) + sum_time(10_000)
        low, high = (own, high) if work < other else (low, own)
    return high


def tables() -> str:
    lines = ["| input | value | from |", "|---|---|---|"]
    lines += [f"| {i.meaning} | {i.value:g} {'' if i.unit == '1' else i.unit} | {i.source} |" for i in INPUTS.values()]
    for name in CASES:
        lines += case_table(name)
    lines += ["", f"Boxes of {value('box'):,.0f} elements: {boxes(1e6):.0f} ranks have work on 1e6 nodes, {boxes(1e8):,.0f} on 1e8."]
    lines += [f"On 10,000 ranks, halo and sums take as long as the work where a rank owns {half_work():.0f} nodes; smaller boxes"]
    lines += ["than that gain nothing."]
    return "\n".join(line.replace("  |", " |") for line in lines)


def with_tables(page: str) -> str:
    """The page with its tables worked out again."""
    before, rest = page.split(START)
    return f"{before}{START}\n{tables()}\n{END}{rest.split(END)[1]}"


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    elif sys.argv[1:]:
        sys.exit(__doc__)
    else:
        print(tables())

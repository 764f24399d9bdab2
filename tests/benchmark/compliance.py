# SPDX-License-Identifier: GPL-2.0-or-later
"""What `compliance corrected` adds to a contact: 3,600 spheres pressed against an elastic solid, nine on each of 400 elements
and blind to each other, the same runs with and without them, without and with the correction.  Times are this thread's, of LIGGGHTS' loop; tables are made before it; the least of many
short runs counts, as what else the machine does slows them by up to a half.  Prints times and ratios, and writes OUT/summary.json; slow is reported, never an error."""

from __future__ import annotations

import argparse
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bounds import AtMost
from study.run.summary import Row, table, write_json
from wall import contacts, settings
from wall_runs import WallRuns, loop_times

ELEMENTS, PER_ELEMENT = 20, 3  # in a row
SPHERES = (ELEMENTS * PER_ELEMENT) ** 2
RADIUS, OVERLAP = 0.7e-3, 1e-6  # [m]
STEPS, RUNS = 50, 10  # of each process
MOST = 1.5
SIZE = 2e-3  # of elements [m]
RING = 31 * SIZE / np.pi  # radius of the ring: as long around as two plates [m]


@dataclass(frozen=True)
class Body:
    geometry: str
    top: str
    held: str

    def centres(self, overlap: float) -> np.ndarray:
        """(3, n), spread over the insides of elements, whose contacts are most of a step."""
        random = np.random.default_rng(1)
        row = np.arange(ELEMENTS * PER_ELEMENT) / PER_ELEMENT
        x, y = (SIZE * (a.ravel() + random.uniform(0.05, 0.25, SPHERES) - 0.5 * ELEMENTS) for a in np.meshgrid(row, row))
        above = RADIUS - overlap
        if self.geometry.startswith("box"):
            return np.stack([x, y, np.full_like(x, above)])
        return np.stack([(RING + above) * np.sin(2 * x / RING), y, (RING + above) * np.cos(2 * x / RING)])

    def model(self) -> str:
        return f"""units: si
geometry: {{{self.geometry}}}
material: {{law: linear_elastic, youngs_modulus: 74.6e9, poissons_ratio: 0.2285, density: 2480}}
boundary: [{{fix: [x, y, z], faces: [{self.held}]}}]
surfaces: {{top: {self.top}}}
"""


BODIES = {
    "plate": Body("box: {origin: [-0.031, -0.031, -0.002], size: [0.062, 0.062, 0.002], elements: [31, 31, 1], degree: 2}", "zeta+", "xi-, xi+"),
    "ring, rational": Body(
        f"tube: {{origin: [0, -0.031, 0], axis: [0, 1, 0], inner_radius: {RING - SIZE!r}, outer_radius: {RING!r}, length: 0.062, "
        "angle: [0, 360], elements: [64, 31, 1]}", "zeta+", "eta-, eta+"),
}  # fmt: skip

DECK = settings("-0.04 0.04 -0.04 0.04 -0.04 0.04", 0.0002, ("74.6e9", "0.2285"), 0.95, 0.3, 1e-9, hard=True) + """\
modify_timing on
{spheres}
set group all diameter {diameter} density 2480
neigh_modify exclude group all all
fix wall all wall/nurbs model hertz tangential history type 2 structure solid.yaml surface top compliance {compliance}
thermo_style custom step atoms f_wall[7]
thermo {steps}
{runs}
"""


def seconds_per_step(runs: WallRuns, body: Body, compliance: str, overlap: float) -> tuple[float, int]:
    """Of the fastest run's loop, and how many spheres touch.  They are not moved, and the solid hardly is."""
    spheres = "\n".join("create_atoms 1 single {:.12g} {:.12g} {:.12g} units box".format(*c) for c in body.centres(overlap).T)
    (runs.folder / "solid.yaml").write_text(body.model())
    (runs.folder / "in.deck").write_text(DECK.format(spheres=spheres, diameter=2 * RADIUS, compliance=compliance, steps=STEPS, runs=RUNS * f"run {STEPS}\n"))
    log = runs.run("in.deck")
    return min(loop_times(log)) / STEPS, contacts(log)


def per_contact(runs: WallRuns, body: Body, repeats: int) -> tuple[float, float]:
    """CPU time of a contact without and with the correction [s]: runs take turns, the least of each counts."""
    apart, none, corrected = ("none", -0.1 * RADIUS, 0), ("none", OVERLAP, SPHERES), ("corrected", OVERLAP, SPHERES)
    least = dict.fromkeys((apart, none, corrected), np.inf)
    for _ in range(repeats):
        for compliance, overlap, expected in least:
            seconds, count = seconds_per_step(runs, body, compliance, overlap)
            if count != expected:
                raise RuntimeError(f"{count} contacts, expected {expected}")
            least[compliance, overlap, expected] = min(seconds, least[compliance, overlap, expected])
    return (least[none] - least[apart]) / SPHERES, (least[corrected] - least[apart]) / SPHERES


def rows(name: str, none: float, corrected: float) -> list[Row]:
    """Times of a contact, the contact model included."""
    return [
        Row(name, "contact_none", 1e9 * none, "ns"),
        Row(name, "contact_corrected", 1e9 * corrected, "ns"),
        AtMost(name, "corrected/none", corrected / none, "1", MOST),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="liggghts-nurbs")
    parser.add_argument("clock", help="libcpu_clock.so")
    parser.add_argument("out", type=Path)
    parser.add_argument("--repeats", metavar="N", type=int, default=5)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        runs = WallRuns(str(Path(args.program).resolve()), str(Path(args.clock).resolve()), Path(folder))
        result = [row for name, body in BODIES.items() for row in rows(name, *per_contact(runs, body, args.repeats))]
    write_json(args.out / "summary.json", "compliance_time", result)
    print(table(result))


if __name__ == "__main__":
    main()

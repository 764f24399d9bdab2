# SPDX-License-Identifier: GPL-2.0-or-later
"""Long runs: 100 balls bounce on a plate, 500 particles turn in a drum.  Memory stays what it is, no contact is lost, and
the books are closed: energy of the plate, momentum and angular momentum of the particles.

STEPS in the environment: 1,000,000 with `tests/run --long`, else 20,000."""

import math
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import decks  # noqa: E402

STEPS = int(os.environ.get("STEPS", "20000"))
MANY = 1_000_000


@dataclass
class Long:
    table: dict[str, np.ndarray]
    contacts: np.ndarray  # of contacts.txt
    memory: list[int]  # resident, at even intervals of time [kB]
    text: str

    def check_memory(self, case: unittest.TestCase):
        """The highest of the second fifth and of the last, in MiB: the first fifth fills caches and neighbour lists."""
        fifth = len(self.memory) // 5
        if fifth < 2:
            return  # too short to tell
        early, late = max(self.memory[fifth : 2 * fifth]) / 1024, max(self.memory[-fifth:]) / 1024
        print(f"  resident memory: {early:.1f} MiB in the second fifth of the run, {late:.1f} MiB in the last")
        if STEPS >= MANY:
            case.assertLessEqual(late - early, 0.25)

    def check_alarms(self, case: unittest.TestCase):
        alarm = re.compile(r"WARNING: Fix wall/nurbs|ERROR|Dangerous builds = [1-9]")
        case.assertEqual([line for line in self.text.splitlines() if alarm.search(line)], [])
        case.assertRegex(self.text, r" 0 not converged")


def run(deck: str, files: dict[str, str], every: int, **variables: str) -> Long:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in files.items():
            (folder / file).write_text(text)
        command = [decks.NURBS, "-in", str(HERE / deck), "-var", "steps", str(STEPS), "-var", "every", str(every)]
        for variable, value in variables.items():
            command += ["-var", variable, value]
        with open(folder / "screen", "w") as screen:
            process = subprocess.Popen(command, cwd=folder, stdout=screen, stderr=subprocess.STDOUT, env=decks.mpi_environment())
            memory, pause = [], 0.05 if STEPS < MANY else 1.0
            while process.poll() is None:
                status = Path(f"/proc/{process.pid}/status").read_text()
                found = re.search(r"VmRSS:\s+(\d+)", status)
                memory += [int(found.group(1))] if found else []
                time.sleep(pause)
        text = (folder / "screen").read_text(errors="replace")
        if process.returncode != 0:
            raise AssertionError(text[-3000:])
        (table,) = decks.thermo_tables((folder / "log.liggghts").read_text(errors="replace"))
        contacts = np.loadtxt(folder / "contacts.txt", comments="#")
    return Long(table, contacts, memory, text)


def windows(values: np.ndarray, count: int = 10) -> np.ndarray:
    """Means of `count` windows of equal length."""
    return np.array([part.mean() for part in np.array_split(values, count)])


class Plate(unittest.TestCase):
    DT, RADIUS = 1e-8, 1e-3

    def balls(self) -> str:
        """At rest, on a grid, at heights that differ: they hit one after another."""
        random = np.random.default_rng(7)
        lines = []
        for i in range(10):
            for j in range(10):
                x, y = (3.2e-3 * (k - 4.5) for k in (i, j))
                lines.append(f"create_atoms 1 single {x!r} {y!r} {self.RADIUS + random.uniform(2e-6, 5e-5)!r} units box")
        return "\n".join(lines) + "\n"

    def test_energy_and_contacts(self):
        """Of the law as it is."""
        table = self.run_and_check("none")
        self.check_drift(table, table["total"], 1e-5)

    def test_energy_and_contacts_that_are_corrected(self):
        """These store c F^2/2 less than their law, c = C/(E' h): C from 0.80 at corners of elements to 1.27 in their middle."""
        table = self.run_and_check("corrected")
        design = np.stack([np.ones_like(table["squared"]), table["squared"]], axis=1)
        (_, half_c), *_ = np.linalg.lstsq(design, table["total"], rcond=None)
        C = 2.0 * half_c * 70e9 / (1.0 - 0.25**2) * 6e-3
        print(f"  what corrected contacts do not store: c = {C:.3f}/(E' h)")
        self.assertTrue(0.9 < C < 1.15, C)
        self.check_drift(table, table["total"] - half_c * table["squared"], 4e-5 if STEPS < MANY else 1e-5)

    def run_and_check(self, compliance: str) -> dict[str, np.ndarray]:
        files = {"balls": self.balls(), "plate.yaml": (HERE / "plate.yaml").read_text()}
        result = run("in.plate", files, max(STEPS // 2000, 10), compliance=compliance)
        table = result.table
        print(f"100 balls on a plate, {STEPS} steps, compliance {compliance}")
        result.check_memory(self)
        result.check_alarms(self)
        self.check_step(table)
        self.check_ledger(table)
        self.check_overlaps(result.contacts, table)
        self.assertGreater(table["lowest"].min(), 0.99 * self.RADIUS, "no ball gets through")
        return table

    def check_step(self, table):
        mass, E = 2500 * 4 / 3 * math.pi * self.RADIUS**3, 70e9 / (2 * (1 - 0.25**2))
        V = table["fastest"].max()
        t_c = 2.943275 * (1.25 * mass / (4 / 3 * E * math.sqrt(self.RADIUS * V))) ** 0.4
        stable = table["stable"][0]
        print(f"  step: {self.DT / stable:.3f} of the stable one, t_c/{t_c / self.DT:.0f} of the fastest ball ({V:.2f} m/s)")
        self.assertLessEqual(self.DT, 0.1 * stable)
        self.assertLessEqual(self.DT, t_c / 200)

    def check_ledger(self, table):
        """Kinetic energy + work against internal forces - work of contacts (and loads, of which there are none)."""
        turned = max(table["kinetic"].max(), table["strain"].max())
        turned = max(turned, np.abs(np.diff(table["given"])).sum())
        left = np.abs(table["ledger"] - table["ledger"][0]).max()
        print(f"  ledger of the plate: open by {left / turned:.1e} of the {turned:.3g} J that the contacts turned over")
        self.assertTrue((table["loads"] == 0.0).all())
        self.assertLessEqual(left, 1e-11 * turned)

    def check_drift(self, table, total, most):
        means = windows(total[1:])
        drift, spread = (means[-1] - means[0]) / total[0], np.ptp(means) / total[0]
        swing = np.abs(total / total[0] - 1).max()
        print(f"  mean total energy, last tenth of the run against the first: {drift:+.1e}; all tenths within {spread:.1e}; "
              f"largest deviation of a moment {swing:.1e}")
        share = windows((table["kinetic"] + table["strain"]) / table["total"])
        print(f"  share of the plate in it: {share[0]:.2f} in the first tenth, {share[-1]:.2f} in the last")
        self.assertLess(spread, most)

    def check_overlaps(self, contacts, table):
        """The largest overlap moves no faster than balls and plate: no contact that is there in one step is gone in the next."""
        deepest = contacts[:, 1]
        jump = np.abs(np.diff(deepest)).max() / self.DT
        speed = 2 * table["fastest"].max()
        print(f"  contacts: up to {contacts[:, 0].max():.0f} at a time; largest overlap {deepest.max():.2e} m, "
              f"it changes by at most {jump:.2f} m/s; balls by {table['fastest'].max():.2f} m/s")
        self.assertGreaterEqual(len(deepest), STEPS)
        self.assertGreater(contacts[:, 0].max(), 3)
        self.assertLess(jump, speed)


class Drum(unittest.TestCase):
    DT, R, L, OMEGA = 1e-5, 0.03, 0.03, 2 * math.pi

    def files(self) -> dict[str, str]:
        R, L = self.R, self.L
        shape = f"origin: [0, -0.001, 0], axis: [0, 1, 0], radius: {R}, length: {L + 0.002}, elements: [16, 4]"
        drum = f"units: si\ngeometry:\n  cylinder: {{{shape}}}\nsurfaces: {{drum: all}}\n"
        plates = ""
        for y in (0.0, L):
            corners = [[x, y, z] for z in (-1.2 * R, 1.2 * R) for x in (-1.2 * R, 1.2 * R)]
            plates += f"    - {{degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control_points: {corners}}}\n"
        ends = "units: si\ngeometry:\n  patches:\n" + plates + "surfaces: {ends: all}\n"
        return {"drum.yaml": drum, "ends.yaml": ends, "balls": self.balls()}

    def balls(self) -> str:
        """500 places near those of a grid inside the drum, moving along it; radii vary evenly."""
        random = np.random.default_rng(3)
        pitch, lines = 3.0e-3, []
        axis = np.arange(-0.0255, 0.026, pitch)
        places = [(x, y, z) for z in axis for x in axis for y in np.arange(2e-3, self.L - 1.9e-3, pitch)
                  if math.hypot(x, z) < self.R - 1.6e-3]
        for place in places[:500]:
            x, y, z = (np.array(place) + random.uniform(-4e-5, 4e-5, 3)).tolist()
            lines.append(f"create_atoms 1 single {x!r} {y!r} {z!r} units box")
        for k in range(1, 501):
            diameter, along = 2 * random.uniform(1.05e-3, 1.45e-3), random.uniform(-0.3, 0.3)
            lines.append(f"set atom {k} diameter {diameter!r} density 2500.0 vy {along!r}")
        return "\n".join(lines) + "\n"

    def test_balances_and_contacts(self):
        every = max(STEPS // 1000, 20)
        result = run("in.drum", self.files(), every)
        print(f"500 particles in a drum, {STEPS} steps, {STEPS * self.DT:.1f} turns")
        result.check_memory(self)
        result.check_alarms(self)
        self.check_contacts(result.contacts)
        self.check_books(result.table, every)

    def check_contacts(self, rows):
        n1, lo1, hi1, n2, lo2, hi2, deepest, deep = rows.T
        print(f"  {n1.sum() + n2.sum():.0f} contacts with the walls in {len(rows)} steps looked at, each where a particle reaches "
              f"beyond a wall; up to {n1.max():.0f} at a time with the drum, {n2.max():.0f} with its ends; "
              f"largest overlap {deepest.max():.2e} m")
        self.assertGreater(n1.max(), 50)
        self.assertGreater(n2.max(), 20, "the ends are touched, too")
        self.assertTrue(((lo1 <= n1) & (n1 <= hi1)).all(), "contacts with the drum")
        self.assertTrue(((lo2 <= n2) & (n2 <= hi2)).all(), "contacts with the ends")
        self.assertLessEqual(np.abs(deepest - np.maximum(deep, 0.0)).max(), 1e-14)
        self.assertLess(deep.max(), self.deepest_fall(), "no particle leaves the drum")

    def deepest_fall(self) -> float:
        """Hertz' overlap of the largest particle that falls across the whole drum [m]; damping only makes it less."""
        r, V2 = 1.45e-3, 2 * 9.81 * 2 * self.R
        mass, K = 2500 * 4 / 3 * math.pi * r**3, 4 / 3 * 2e6 / (2 * (1 - 0.3**2)) * math.sqrt(r)
        return (1.25 * mass * V2 / K) ** 0.4

    def check_books(self, table, every):
        def gained(now: str, mean: str) -> np.ndarray:
            """Sum of dt/2 (f_n + f_n+1) up to each row, from the mean over the steps since the last row."""
            f = table[now]
            window = every * table[mean][1:] + 0.5 * (f[:-1] - f[1:])
            return self.DT * np.concatenate([[0.0], np.cumsum(window)])

        turned = table["m"][0] * 9.81 * self.DT * STEPS
        for name, sum_, now, mean, size in (
            ("momentum x", "p[1]", "Fx", "mean[1]", turned), ("momentum y", "p[2]", "Fy", "mean[2]", turned),
            ("momentum z", "p[3]", "Fz", "mean[3]", turned), ("angular momentum", "p[4]", "My", "mean[4]", turned * self.R),
        ):
            left = np.abs(table[sum_] - table[sum_][0] - gained(now, mean)).max()
            print(f"  {name}: open by {left / size:.1e} of the weight's")
            self.assertLessEqual(left, 1e-11 * size, name)
        # the drum turns from the first step on; before it the walls are at rest
        work, torque = gained("P", "mean[5]"), self.OMEGA * gained("W", "mean[6]")
        left = np.abs((work - work[1]) - (torque - torque[1])).max()
        print(f"  work of the walls: {work[-1]:.3g} J, torque times angle open by {left / work[-1]:.1e} of it")
        self.assertLessEqual(left, 1e-11 * work[-1])


if __name__ == "__main__":
    unittest.main()

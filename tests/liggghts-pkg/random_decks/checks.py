# SPDX-License-Identifier: GPL-2.0-or-later
"""What must hold for every random deck.  Each check takes the runs of a deck and raises AssertionError with what it found."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import decks
from deck import Deck

WALL = tuple(f"wall[{n}]" for n in range(1, 9))
FORCE, TORQUE = WALL[0:3], WALL[3:6]
KINDS = {"x": slice(2, 5), "v": slice(5, 8), "f": slice(8, 11), "omega": slice(11, 14), "torque": slice(14, 17)}
AFTER_CONTACT = 200  # steps after the first contact between balls over which runs are still compared


@dataclass
class Run:
    """Thermo rows of all runs of a deck one after the other, and the balls of every tenth step (rows: id type x y z ...)."""

    rows: dict[str, np.ndarray]
    balls: dict[int, np.ndarray]

    @property
    def first_touch(self) -> int:
        """The step at which two balls touch first; a large number: never."""
        touching = np.flatnonzero(self.rows["touches"] > 0)
        return int(self.rows["Step"][touching[0]]) if len(touching) else 10**9

    def row_at(self, step: int) -> int:
        """The first row of a step: what was changed after a run is not in it."""
        return int(np.flatnonzero(self.rows["Step"] == step)[0])


def read_balls(path: Path) -> dict[int, np.ndarray]:
    states: dict[int, np.ndarray] = {}
    for block in path.read_text().split("ITEM: TIMESTEP\n")[1:]:
        head, body = block.split("ITEM: ATOMS", 1)
        values = np.array([line.split() for line in body.splitlines()[1:]], dtype=float)
        states.setdefault(int(head.split(None, 1)[0]), values.reshape(len(values), -1))
    return states


def read(result: decks.Run, folder: Path) -> Run:
    return Run(result.table, read_balls(folder / "dump.txt"))


def expect(condition: bool, message: str) -> None:
    if not condition:
        raise AssertionError(message)


def scale_of(run: Run, column: str) -> float:
    """Largest value of the columns of the same kind; a component may vanish."""
    kind = FORCE if column in FORCE else TORQUE if column in TORQUE else (column,)
    return max(float(np.abs(run.rows[c]).max()) for c in kind) or 1.0


def check_ledger(deck: Deck, run: Run) -> None:
    """Forces and torques of the wall are those that the balls lack: sum f - m g, sum x x (f - m g) + torque.  On several
    ranks LIGGGHTS' balls that touch while they grow do not push each other alike."""
    end = growing_touch(deck, run) if deck.ranks[0] > 1 else 10**9
    gravity = gravity_by_step(deck)
    largest = {"force": 0.0, "torque": 0.0}
    worst = {"force": (0.0, 0), "torque": (0.0, 0)}
    for step, balls in run.balls.items():
        if step >= end:
            break
        x, f, torque, m = balls[:, KINDS["x"]], balls[:, KINDS["f"]], balls[:, KINDS["torque"]], balls[:, 17]
        f = f - m[:, None] * gravity(step)
        moments = np.cross(x, f) + torque
        row = run.row_at(step)
        for name, columns, of_balls in (("force", FORCE, f), ("torque", TORQUE, moments)):
            wall = np.array([run.rows[c][row] for c in columns])
            largest[name] = max(largest[name], float(np.abs(of_balls).max()))
            worst[name] = max(worst[name], (float(np.abs(wall + of_balls.sum(axis=0)).max()), step))
    for name, (difference, step) in worst.items():
        expect(
            difference <= 1e-11 * largest[name],
            f"ledger: {name} on the wall and on the balls differ by {difference:.3g} of {largest[name]:.3g} at step {step}",
        )


def gravity_by_step(deck: Deck):
    """Acceleration at a step; a change holds from the run after it."""
    begins, values, begin = [], [], 0
    for number, segment in enumerate(deck.segments):
        following = deck.segments[number + 1].gravity if number + 1 < len(deck.segments) else deck.gravity_at_end
        begins.append(begin)
        values.append(np.array(following))
        begin += segment.steps
    first = np.array(deck.segments[0].gravity)

    def at(step: int) -> np.ndarray:
        current = [value for start, value in zip(begins, values) if start < step]
        return current[-1] if current else first

    return at


def growing_touch(deck: Deck, one: Run) -> int:
    """The first step at which balls touch in a run that changes their size; a large number: never.  LIGGGHTS' copies of balls
    on other ranks have the size that they had when its lists were made."""
    begin = 0
    for segment in deck.segments:
        touching = one.rows["Step"][(one.rows["touches"] > 0) & (one.rows["Step"] > begin)]
        begin += segment.steps
        if any(line.startswith("fix grow") for line in segment.before) and (touching <= begin).any():
            return int(touching[0])
    return 10**9


def check_ranks(deck: Deck, one: Run, other: Run) -> None:
    """Wall sums and balls are the same to the last bit until two balls touch, then to 1e-9 over 200 steps."""
    touch, end = one.first_touch, growing_touch(deck, one)
    expect(len(one.rows["Step"]) == len(other.rows["Step"]), "ranks: other number of rows")
    step = one.rows["Step"]
    for column in [c for c in one.rows if c.startswith("wall[")]:
        a, b = one.rows[column], other.rows[column]
        exact = np.flatnonzero((step < touch) & (a != b))
        expect(not len(exact), f"ranks: {column} differs by {message(a, b, exact, step)}")
        after = (step >= touch) & (step < min(touch + AFTER_CONTACT, end))
        # the momenta and energies of a solid are sums over all its nodes and start from 0
        far = np.flatnonzero(after & (np.abs(a - b) > 1e-9 * scale_of(one, column)))
        expect(not len(far), f"ranks: {column} differs after contact by {message(a, b, far, step)}")
    compare_balls("ranks", one, other, 0.0, 1e-9, end - 1)


def message(a, b, rows, step) -> str:
    if not len(rows):
        return ""
    k = rows[0]
    return f"{abs(a[k] - b[k]):.3g} of {a[k]:.17g} at step {int(step[k])} ({len(rows)} rows)"


def compare_balls(what: str, one: Run, other: Run, before: float, after: float, last: int = 10**9) -> None:
    """Differences up to step `last` relative to the largest value of their kind: `before` two balls touch and `after` it."""
    touch = one.first_touch
    steps = [s for s in one.balls if s in other.balls and s < min(touch + AFTER_CONTACT, last + 1)]
    expect(len(steps) > 2 and set(one.balls) >= set(other.balls), f"{what}: other steps in the dump")
    for kind, columns in KINDS.items():
        scale = max(float(np.abs(one.balls[s][:, columns]).max()) for s in steps) or 1.0
        for s in steps:
            a, b = one.balls[s], other.balls[s]
            expect(np.array_equal(a[:, :2], b[:, :2]), f"{what}: other balls at step {s}")
            difference = float(np.abs(a[:, columns] - b[:, columns]).max())
            limit = before if s < touch else after
            ball = int(a[np.abs(a[:, columns] - b[:, columns]).max(axis=1).argmax(), 0])
            expect(
                difference <= limit * scale,
                f"{what}: {kind} of ball {ball} differs by {difference / scale:.3g} of the largest at step {s}, "
                f"expected {limit:g} (balls touch first at step {touch})",
            )


def check_restart(deck: Deck, whole: Run, resumed: Run) -> None:
    """The run that read the restart file continues as the one that wrote it."""
    count = len(resumed.rows["Step"])
    step = resumed.rows["Step"]
    # the stable step (column 17) is estimated anew
    for column in [c for c in whole.rows if c.startswith("wall[") and c != "wall[17]"]:
        a, b = whole.rows[column][-count:], resumed.rows[column]
        differ = np.flatnonzero(a != b)
        expect(not len(differ), f"restart: {column} differs by {message(a, b, differ, step)}, begun at step {int(step[0])}")
    tail = {s: balls for s, balls in whole.balls.items() if s > step[0]}
    resumed_balls = {s: balls for s, balls in resumed.balls.items() if s > step[0]}
    expect(set(tail) == set(resumed_balls), "restart: other steps in the dump")
    for s in tail:
        expect(np.array_equal(tail[s], resumed_balls[s]), f"restart: balls differ at step {s}, begun at step {int(step[0])}")


def check_beside_stock(deck: Deck, ours: Run, stock: Run) -> None:
    """To 1e-11 beside a plane, to 1e-10 beside a cylinder and flat triangles, to 1e-9 beside triangles that move (LIGGGHTS
    adds up the steps of their corners) and after two balls have touched."""
    limit = 1e-11 if "plane" in deck.wall.primitive else 1e-9 if deck.motion.verbs else 1e-10
    # at the beginning of a later run the velocity of LIGGGHTS' moving mesh is not that of the last step
    last = deck.segments[0].steps if deck.motion.verbs else 10**9
    compare_balls("stock", ours, stock, limit, 1e-9, last)


def check_curved_twin(deck: Deck, ours: Run, twin: Run) -> None:
    """Without friction a ball that bounced has been pushed along n.  The twin's n is off by a facet's angle, and where the
    wall is hollow by what the wall turns across the contact, all of whose facets push.  How fast it leaves says nothing: facets
    that come into contact one after the other do not conserve energy."""
    patch = math.sqrt(2 * ours.rows["wall[8]"].max() * max(b.radius for b in deck.balls))
    limit = 2 * (deck.wall.facet + patch * deck.wall.curvature)
    last = max(ours.balls)
    a, b = ours.balls[last], twin.balls[last]
    free = (np.abs(a[:, KINDS["f"]]).max(axis=1) == 0) & (np.abs(b[:, KINDS["f"]]).max(axis=1) == 0)
    for k in np.flatnonzero(free):
        impulse, other = (balls[k, KINDS["v"]] - ours.balls[0][k, KINDS["v"]] for balls in (a, b))
        if not impulse.any():
            continue
        expect(other.any(), f"twin: ball {k + 1} bounces off the wall, but not off its twin")
        turned = float(np.linalg.norm(impulse / np.linalg.norm(impulse) - other / np.linalg.norm(other)))
        expect(turned <= limit, f"twin: ball {k + 1} is pushed elsewhere by {turned:.3g} rad, expected {limit:.3g}")


def check_energy(deck: Deck, run: Run) -> None:
    """Whenever nothing touches: kinetic and potential energy of all is what it was, but for the wall's power."""
    rows, dt = run.rows, deck.segments[0].timestep
    energy = rows["KinEng"].copy()
    for c, g in zip("xyz", deck.segments[0].gravity):
        energy -= g * rows[f"centre{c}"]
    if deck.wall.deforms:
        energy += rows["wall[15]"] + rows["wall[16]"]
    power = rows["wall[21]"] if deck.wall.deforms else rows[f"wall[{18 + 3 * deck.motion.servo}]"]
    rate = 0.5 * (power[1:] + power[:-1])
    if (twist := deck.motion.twist(rows["Step"])) is not None:
        # a step is gone through with the speed that the variable has at its end, which a mean of powers misses by first order
        push = np.array([rows[column] for column in FORCE + TORQUE])
        rate = -0.5 * ((push[:, 1:] + push[:, :-1]) * twist[:, 1:]).sum(axis=0)
    work = np.zeros(len(energy))
    if not deck.wall.deforms:
        work[1:] = np.cumsum(rate * dt * np.diff(rows["Step"]))
    free = (rows["wall[7]"] == 0) & (rows["touches"] == 0)
    if not free.any():
        return
    start = np.flatnonzero(free)[0]
    drift = np.abs((energy - work) - (energy - work)[start])[free].max()
    # velocity Verlet is second order: an impact that takes n steps misses its energy by less than (pi / n)^2
    limit = (math.pi * deck.contact_step) ** 2 * rows["KinEng"].max()
    if deck.wall.deforms:
        # the energy of a mode swings by half of the square of the step over the stable one
        limit += 0.5 * (dt / rows["wall[17]"][0]) ** 2 * rows["wall[16]"].max()
    expect(drift <= limit, f"energy: drift {drift:.3g} of {rows['KinEng'].max():.3g}, expected {limit:.3g}")

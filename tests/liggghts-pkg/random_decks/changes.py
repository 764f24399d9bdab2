# SPDX-License-Identifier: GPL-2.0-or-later
"""What a user changes between two runs: each change is a few lines of the deck, the same for every wall."""

from __future__ import annotations

import itertools
from random import Random

import numpy as np

from walls import BOX, Wall, direction

NEW_WALL = "unfix and fix the wall again"  # stands for the lines of the deck's own wall
# Until the first run after read_restart a fix that is made anew takes its state from the file once more, and the others
# are refused.
AFTER_A_RUN = (NEW_WALL, "delete_atoms", "displace_atoms", "create_atoms")


def gravity_line(g) -> str:
    size = float(np.linalg.norm(g))
    way = " ".join(repr(float(c) / size) for c in g) if size > 0 else "0 0 -1"
    return f"fix gravity all gravity {size!r} vector {way}"


class Changes:
    """Draws changes one after the other and keeps what they do to the deck."""

    def __init__(self, rng: Random, wall: Wall, balls, alike: bool, timestep: float, gravity):
        self.rng, self.wall, self.alike = rng, wall, alike
        self.timestep, self.gravity = timestep, gravity
        self.alive = list(range(1, len(balls) + 1))
        self.radius = {k: ball.radius for k, ball in enumerate(balls, 1)}
        self.places = [ball.x for ball in balls]  # where balls were put
        self.groups = 0

    def numbers(self, *values: float) -> str:
        return " ".join(repr(float(v)) for v in values)

    def group_of_one(self) -> tuple[str, str]:
        self.groups += 1
        name = f"one{self.groups}"
        return name, f"group {name} id {self.rng.choice(self.alive)}"

    def near_the_wall(self, radius: float, gap: float) -> np.ndarray:
        """A place there, off the faces of the box, and away from where other balls were put, if there is one."""
        for attempt in itertools.count():
            site = self.wall.site(self.rng)
            side = 1 if self.wall.outward else self.rng.choice((1, -1))
            x = site.point + side * (radius + gap) * site.normal
            apart = min(np.linalg.norm(x - place) for place in self.places) > 4 * radius or attempt > 100
            if site.hollow[0 if side > 0 else 1] > 1.6 * radius + gap and np.abs(x).max() < BOX - 1e-3 and apart:
                self.places.append(x)
                return x

    # each returns the lines before the run and those after it

    def set_velocity(self):
        vx, vy, vz = direction(self.rng) * self.rng.uniform(0.1, 0.5)
        return [f"set atom {self.rng.choice(self.alive)} vx {vx!r} vy {vy!r} vz {vz!r}"], []

    def set_place(self):
        k = self.rng.choice(self.alive)
        x, y, z = self.near_the_wall(self.radius[k], self.rng.uniform(-0.1, 0.1) * self.radius[k])
        return [f"set atom {k} x {x!r} y {y!r} z {z!r}"], []

    def set_diameter(self):
        k = self.rng.choice(self.alive)
        self.radius[k] *= self.rng.uniform(0.8, 1.1)
        self.alike = False
        return [f"set atom {k} diameter {2 * self.radius[k]!r}"], []

    def set_type(self):
        return [f"set atom {self.rng.choice(self.alive[1:])} type {self.rng.choice((1, 3))}"], []  # the first stays of type 1

    def displace(self):
        name, group = self.group_of_one()
        step = direction(self.rng) * self.rng.uniform(0.02, 0.2) * min(self.radius.values())
        return [group, f"displace_atoms {name} move {self.numbers(*step)} units box"], []

    def displace_all(self):
        step = direction(self.rng) * self.rng.uniform(0.02, 0.1) * min(self.radius.values())
        return [f"displace_atoms all move {self.numbers(*step)} units box"], []

    def velocity(self):
        v = direction(self.rng) * self.rng.uniform(0.1, 0.4)
        return [f"velocity all set {self.numbers(*v)} units box"], []

    def ramp(self):
        ends = self.numbers(-0.2, self.rng.uniform(0.0, 0.3))
        return [f"velocity all ramp v{self.rng.choice('xyz')} {ends} {self.rng.choice('xyz')} {-BOX} {BOX} units box"], []

    def grow(self):
        """All diameters grow, or shrink, evenly over the run from what they are."""
        if not self.alike:
            return self.set_velocity()
        d, rate = 2 * self.radius[self.alive[0]], self.rng.choice((-1, 1, 1)) * self.rng.uniform(5e-5, 4e-4)
        self.groups += 1
        begin = f"begin{self.groups}"
        # the step at which the run begins; a variable of the text form holds a number for good
        lines = [f"variable {begin} equal step", f'variable size equal {d!r}*(1+{rate!r}*(step-{"${" + begin + "}"}))']
        self.alike = False
        return lines + ["fix grow all adapt 1 atom diameter v_size"], ["unfix grow", "variable size delete"]

    def insert(self):
        k = max(self.alive) + 1  # as create_atoms counts: a number that was deleted comes again
        self.radius[k] = self.rng.uniform(0.8, 1.0) * max(self.radius.values())
        self.alive.append(k)
        self.alike = False
        x = self.near_the_wall(self.radius[k], -self.rng.uniform(0.0, 0.08) * self.radius[k])
        return [
            f"create_atoms {self.rng.choice((1, 3))} single {self.numbers(*x)} units box",
            f"set atom {k} diameter {2 * self.radius[k]!r} density 2000",
        ], []

    def delete(self):
        if len(self.alive) < 3:
            return self.set_velocity()
        k = self.rng.choice(self.alive[1:])
        self.alive.remove(k)
        del self.radius[k]
        self.groups += 1
        return [f"group one{self.groups} id {k}", f"delete_atoms group one{self.groups} compress no"], []

    def new_wall(self):
        return [NEW_WALL], []

    def shorter_timestep(self):
        self.timestep *= self.rng.uniform(0.5, 0.9)
        return [f"timestep {self.timestep!r}"], []

    def other_gravity(self):
        self.gravity = tuple(self.rng.uniform(0, 20) * direction(self.rng))
        return [gravity_line(self.gravity)], []  # takes the place of the old one, which keeps the order of forces

    def run_0(self):
        return ["run 0"], []

    ALL = (set_velocity, set_place, set_diameter, set_type, displace, displace_all, velocity, ramp, grow, grow, grow,
           insert, insert, delete, new_wall, shorter_timestep, other_gravity, run_0)


def draw(rng: Random, wall: Wall, balls, alike: bool, timestep: float, gravity, Segment):
    """Three or four runs, with one to three changes before each but the first; and the gravity of the last."""
    state = Changes(rng, wall, balls, alike, timestep, gravity)
    segments = []
    for number in range(rng.randint(3, 4)):
        before, after = [], []
        begin = state.timestep, state.gravity
        for _ in range(rng.randint(1, 3) if number > 0 else 0):
            lines, later = rng.choice(Changes.ALL)(state)
            before, after = before + lines, later + after
        steps = int(rng.uniform(1e-4, 4e-4) / state.timestep)
        segments.append(Segment(steps, before, after, *begin))
    return segments, state.gravity

# SPDX-License-Identifier: GPL-2.0-or-later
"""A random deck: wall, balls, contact models, motion, and what a user changes between runs; and its text in LIGGGHTS' words
for the NURBS wall, for the stock primitive and for the triangle twin."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from random import Random

import numpy as np

import changes
import motions
import parts
import solids
import walls
from prelude import Prelude
from walls import BOX, Site, Wall

DENSITY = (1500.0, 3000.0)
RADII = (0.35e-3, 0.6e-3)
SPEED = 0.6  # largest one towards the wall [m/s]
RIGID = (*walls.CURVED, *solids.RIGID)
# Of a deck of each kind: the walls it may have, whether things are changed between runs, whether energy is conserved.
KINDS = {
    "plane": ((walls.stock_plane,), False, False),
    "plane, changes": ((walls.stock_plane,), True, False),
    "cylinder": ((walls.stock_cylinder,), False, False),
    "flat twin": ((walls.tilted_plane,), False, False),
    "solid": ((solids.solid,), False, False),
    "rigid": (RIGID, False, False),
    "rigid, changes": (RIGID, True, False),
    "cylinder, changes": ((walls.stock_cylinder,), True, False),
    "curved twin": (walls.CURVED, False, True),
    "rigid, energy": (RIGID, False, True),
    "solid, energy": ((solids.solid,), False, True),
    "triangles": (parts.TRIANGLES, False, False),
    "triangles, changes": (parts.TRIANGLES, True, False),
    "hull, energy": ((parts.hull,), False, True),
    "corrected": ((solids.corrected,), False, False),
    "corrected, energy": ((solids.corrected,), False, True),
}
if parts.have_cad():
    KINDS |= {"part": ((parts.cad_part,), False, False), "part, changes": ((parts.cad_part,), True, False)}


@dataclass
class Ball:
    x: np.ndarray
    v: np.ndarray
    radius: float
    density: float
    type: int

    def lines(self, number: int) -> list[str]:
        place, speed = (" ".join(repr(float(c)) for c in u) for u in (self.x, self.v))
        vx, vy, vz = speed.split()
        return [
            f"create_atoms {self.type} single {place} units box",
            f"set atom {number} diameter {2 * self.radius!r} density {self.density!r} vx {vx} vy {vy} vz {vz}",
        ]


@dataclass
class Segment:
    """One run: what stands before and after it, and what holds at its beginning."""

    steps: int
    before: list[str] = field(default_factory=list)
    after: list[str] = field(default_factory=list)
    timestep: float = 0.0
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass
class Deck:
    seed: int
    kind: str
    wall: Wall
    periodic: tuple[bool, bool, bool]
    models: str
    settings: str  # words that follow the wall's own
    words: str  # of fix wall/nurbs alone: search, slots, ...
    motion: motions.Motion
    start: Prelude
    balls: list[Ball]
    segments: list[Segment]
    contact_step: float  # timestep over the shortest contact
    conservative: bool
    ranks: tuple[int, int]
    processors: tuple[str, str]
    gravity_at_end: tuple[float, float, float]
    restart_at: int  # the segment before which the run is interrupted; 0: not

    def prelude(self, processors: str, begin: int) -> str:
        start = replace(self.start, processors=processors, timestep=self.segments[begin].timestep)
        return start.again("half.restart") if begin else start.text()

    def wall_lines(self, variant: str) -> list[str]:
        wall = self.wall
        source = f"{'structure' if wall.deforms else 'geometry'} {wall.name} surface {wall.surface} {wall.placement}"
        if variant == "nurbs":
            return [f"fix wall all wall/nurbs {self.models} type 2 {source} {self.words} {self.motion.words} {self.settings}"]
        if variant == "primitive":
            return [f"fix wall all wall/gran {self.models} primitive type 2 {self.wall.primitive} {self.settings}"]
        lines = [
            "group nobody type 2",
            f"fix source nobody wall/nurbs {self.models} type 2 {source} twin {self.wall.twin}",
            "fix cad all mesh/surface fix source type 2 " + self.motion.mesh_words,
            "unfix source",
        ]
        lines += [f"fix move{n} all move/mesh mesh cad {verb}" for n, verb in enumerate(self.motion.verbs)]
        return lines + [f"fix wall all wall/gran {self.models} mesh n_meshes 1 meshes cad {self.settings}"]

    def text(self, variant: str = "nurbs", processors: str = "* * *", begin: int = 0, dump: str = "dump.txt") -> str:
        """The whole deck, or what reads the restart file and goes on with segment `begin`."""
        lines = self.prelude(processors, begin).splitlines()
        if begin == 0:
            for number, ball in enumerate(self.balls, 1):
                lines += ball.lines(number)
        lines.append(changes.gravity_line(self.segments[begin].gravity))
        lines += self.motion.variables + self.wall_lines(variant) + ["fix integrate all nve/sphere"]
        lines += self.output(variant, dump)
        for number, segment in enumerate(self.segments[begin:], begin):
            if number == self.restart_at and number > begin:
                lines.append("write_restart half.restart")
            # what follows a restart file is done in both runs; some things LIGGGHTS does only once the file's data are in use
            needs_run = number == self.restart_at and any(line.startswith(changes.AFTER_A_RUN) for line in segment.before)
            for line in ["run 0"] * needs_run + segment.before + [f"run {segment.steps}"] + segment.after:
                lines += ["unfix wall"] + self.wall_lines(variant) if line == changes.NEW_WALL else [line]
        return "\n".join(" ".join(line.split()) for line in lines) + "\n"

    def output(self, variant: str, dump: str) -> list[str]:
        columns = list(range(1, 9)) if variant == "nurbs" else []
        if variant == "nurbs" and self.wall.deforms:
            columns += list(range(9, 21))
        names = [f"f_wall[{c}]" for c in columns]
        if variant == "nurbs":
            names.append(f"f_wall[{21 if self.wall.deforms else 18 + 3 * self.motion.servo}]")
        values = "id type x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz mass radius"
        form = "%d %d" + " %.17g" * (len(values.split()) - 2)
        return [
            "compute touch all contact/atom",
            "compute touches all reduce sum c_touch",
            *(f"variable centre{c} equal xcm(all,{c})*mass(all)" for c in "xyz"),
            f"dump balls all custom 10 {dump} {values}",
            f'dump_modify balls sort id format "{form}"',
            f"thermo_style custom step ke c_touches v_centrex v_centrey v_centrez {' '.join(names)}",
            "thermo_modify format float %.17g lost error norm no",
            "thermo 1",
        ]


def draw_material(rng: Random, wall: Wall, conservative: bool) -> dict:
    """Properties of types 1 and 3 (balls) and 2 (wall), as Prelude takes them."""
    E = [10 ** rng.uniform(6.9, 7.5) for _ in range(3)]
    nu = [rng.uniform(0.1, 0.4) for _ in range(3)]
    if wall.material:
        E[1], nu[1] = wall.material

    def pairs(low: float, high: float) -> list[float]:
        values = {(i, j): rng.uniform(low, high) for i in range(3) for j in range(i, 3)}
        return [values[min(i, j), max(i, j)] for i in range(3) for j in range(3)]

    e = 1.0 if conservative else pairs(0.3, 1.0)
    mu = 0.0 if conservative else pairs(0.0, 0.8)
    further = {
        "coefficientRollingFriction": pairs(0.01, 0.3),
        "coefficientRollingViscousDamping": pairs(0.1, 0.5),
        "cohesionEnergyDensity": pairs(1e3, 2e4),
        "characteristicVelocity": "scalar 0.5",
        "penaltyFactor": pairs(0.8, 1.2),
        "yieldPressure": "peratomtype " + " ".join(repr(rng.uniform(0.01, 0.1) * modulus) for modulus in E),
    }
    return dict(E=E, nu=nu, e=e, mu=mu, further=further)


def draw_models(rng: Random, conservative: bool, stock: bool, corrected: bool) -> tuple[str, str]:
    """Contact models, and settings of them."""
    normal = rng.choice(("hertz", "hertz", "hertz", "hooke") if stock else ("hertz", "hertz", "hooke", "penalty/hertz"))
    if corrected:
        normal = rng.choice(("hertz", "penalty/hertz"))
    elif not stock and not conservative and rng.random() < 0.2:
        normal = "plastic/thornton"
    if conservative:
        return f"model {normal} tangential {rng.choice(('no_history', 'history'))}", ""
    words = [f"model {normal}", f"tangential {rng.choice(('history', 'history', 'no_history'))}"]
    if not corrected and rng.random() < 0.2:
        words.append("cohesion sjkr")
    if rng.random() < 0.6:
        # the torque of cdt has one size and the direction of the roll: where that ends, round-off chooses the direction
        words.append(f"rolling_friction {rng.choice(('epsd', 'epsd2') if stock else ('cdt', 'epsd', 'epsd2'))}")
    setting = rng.choice(("", "", "tangential_damping off", "limitForce on"))
    return " ".join(words), setting


def contact_time(radius: float, density: float, E: float, nu: float) -> float:
    """Of Hertz' impact at SPEED (Johnson 1985, eq. 11.24), on a body as stiff as the ball."""
    m, E_star = 4 / 3 * math.pi * radius**3 * density, E / (2 * (1 - nu**2))
    return 2.87 * (m**2 / (E_star**2 * radius * SPEED)) ** 0.2


def place(rng: Random, site: Site, radius: float, gap: float, outward: bool, speed: float, along: float):
    """Centre and velocity of a ball that comes to the wall at a site, up to `along` sideways; None if it does not fit."""
    side = 1 if outward else rng.choice((1, -1))
    if site.hollow[0 if side > 0 else 1] < 1.6 * radius + gap:
        return None
    normal = side * site.normal
    tangent = walls.unit(np.cross(normal, walls.direction(rng)))
    v = -speed * normal + rng.uniform(0, along) * tangent
    return site.point + (radius + gap) * normal, v


def draw_balls(rng: Random, wall: Wall, count: int, alike: bool, behind: float, twin: bool) -> list[Ball]:
    """On their way to the wall; some have another one close behind.  Those beside a curved twin are apart from each other,
    clear of its facets, and hardly slide: on facets a contact lasts as long as it likes, and the normal turns meanwhile."""
    gap, clearance, along = (2e-5, 1e-3, 0.05) if twin else (3e-6, rng.choice((2e-5, 2e-5, 4e-4)), 0.5)
    balls: list[Ball] = []
    radius, density = rng.uniform(*RADII), rng.uniform(*DENSITY)

    def add(x, v) -> None:
        if np.abs(x).max() > BOX - 1e-3:
            return
        if all(np.linalg.norm(x - b.x) > radius + b.radius + clearance for b in balls):
            # LIGGGHTS wants a ball of type 1
            balls.append(Ball(x, v, radius, density, rng.choice((1, 3)) if balls else 1))

    for _ in range(20 * count):
        if len(balls) >= count:
            break
        if not alike:
            radius, density = rng.uniform(*RADII), rng.uniform(*DENSITY)
        speed = rng.uniform(0.2, SPEED)
        placed = place(rng, wall.site(rng), radius, rng.uniform(gap, 1e-4), wall.outward, speed, along)
        if placed is None:
            continue
        before = len(balls)
        add(*placed)
        if len(balls) > before and rng.random() < behind:
            x, v = placed
            add(x - (2.2 * radius + clearance) * walls.unit(v), 1.3 * v)
    return balls


def draw_ranks(rng: Random) -> tuple[tuple[int, int], tuple[str, str]]:
    one = rng.choice((1, 1, 2))
    other = rng.choice([n for n in (2, 3, 4) if n != one])

    def grid(ranks: int) -> str:
        cuts = {1: [(1, 1, 1)], 2: [(2, 1, 1)], 3: [(3, 1, 1)], 4: [(4, 1, 1), (2, 2, 1)]}
        cut = list(rng.choice(cuts[ranks]))
        rng.shuffle(cut)
        return " ".join(map(str, cut))

    return (one, other), (grid(one), grid(other))


def draw(seed: int) -> Deck:
    """The deck of a seed; its kind goes through all of KINDS as seeds follow each other."""
    rng = Random(seed)
    kind = list(KINDS)[seed % len(KINDS)]
    makers, changing, conservative = KINDS[kind]
    make = rng.choice(makers)
    stock = make in (walls.stock_plane, walls.stock_cylinder)
    periodic = (False, False, False)
    if stock and rng.random() < 0.4:
        cuts = [(True, False, False), (False, True, False), (False, False, True)]
        if make is walls.stock_plane:
            cuts += [(True, True, False), (False, True, True), (True, False, True)]
        periodic = rng.choice(cuts)
    wall = make(rng, periodic) if stock else make(rng)

    material = draw_material(rng, wall, conservative)
    curved_twin = kind == "curved twin"
    if curved_twin:
        models, settings = "model hertz tangential no_history", ""
    else:
        models, settings = draw_models(rng, conservative, stock or kind == "flat twin", wall.corrected)
    words = ["compliance corrected"] * wall.corrected
    if not stock and not curved_twin and not wall.corrected and rng.random() < 0.2:
        words.append("rstar curvature")
    if wall.slots:
        words.append(f"contacts {wall.slots}")
    elif rng.random() < 0.2:
        words.append(f"contacts {rng.randint(5, 8)}")
    motion = motions.draw(rng, wall, kind)

    alike = changing and rng.random() < 0.5  # fix adapt gives one diameter to all
    many = rng.randint(3, 5) if kind == "flat twin" else rng.randint(4, 14)
    behind = 0.0 if curved_twin else rng.choice((0.0, 0.3))
    balls = draw_balls(rng, wall, many, alike, behind, curved_twin)
    smallest = min(balls, key=lambda b: b.radius)
    shortest = 0.85 * contact_time(smallest.radius, min(b.density for b in balls), max(material["E"]), max(material["nu"]))
    timestep = min(shortest / rng.uniform(60, 150), wall.stable_step)
    gravity = (0.0, 0.0, 0.0) if rng.random() < 0.4 or curved_twin else tuple(9.81 * walls.direction(rng))

    if changing:
        segments, gravity = changes.draw(rng, wall, balls, alike, timestep, gravity, Segment)
    else:
        count = 1 if curved_twin else rng.randint(2, 3)
        total = rng.uniform(8e-4, 1.2e-3) / timestep
        segments = [Segment(int(total / count), [], [], timestep, gravity) for _ in range(count)]
    ranks, processors = draw_ranks(rng)
    start = Prelude(
        f"{-BOX} {BOX} " * 3, models=models, boundary=" ".join("p" if p else "f" for p in periodic),
        skin=rng.uniform(5e-5, 4e-4), lists=f"every {rng.choice((1, 1, 5, 10))} delay 0 check yes", **material,
    )
    return Deck(
        seed, kind, wall, periodic, models, settings, " ".join(words), motion, start, balls, segments, timestep / shortest,
        conservative, ranks, processors, gravity, rng.randrange(1, len(segments)) if len(segments) > 1 else 0,
    )

# SPDX-License-Identifier: GPL-2.0-or-later
"""What moves a rigid wall in a random deck: words of fix wall/nurbs, and the same for fix move/mesh."""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

import numpy as np

from walls import Wall, direction


@dataclass
class Motion:
    verbs: list[str] = field(default_factory=list)  # as after fix move/mesh
    sliding: str = ""  # surface_vel ... or surface_ang_vel ...
    servo_words: str = ""
    variables: list[str] = field(default_factory=list)

    @property
    def words(self) -> str:
        return " ".join([f"motion {verb}" for verb in self.verbs] + [self.sliding, self.servo_words]).strip()

    @property
    def mesh_words(self) -> str:
        return self.sliding

    @property
    def servo(self) -> bool:
        return bool(self.servo_words)

    def twist(self, step: np.ndarray) -> np.ndarray | None:
        """(6, steps): velocity of the wall where the origin is, and angular velocity, in the steps that end with these; nothing if
        no variable says them."""
        verb = next((verb.split() for verb in self.verbs if "/variable" in verb), None)
        if verb is None:
            return None
        rate = {text.split()[1]: eval(text.split(" equal ")[1], {"sin": np.sin, "cos": np.cos, "step": step}) for text in VARIABLES}
        if verb[0] == "linear/variable":
            return np.array([rate[f"rate_{c}"] + 0 * step for c in "xyz"] + [0 * step] * 3)
        origin, axis = np.array(verb[2:5], dtype=float), np.array(verb[6:9], dtype=float)
        axis /= np.linalg.norm(axis)
        return np.outer(np.concatenate([np.cross(origin, axis), axis]), rate["turn"])


VARIABLES = [
    "variable rate_x equal 0.1*sin(step*0.02)",
    "variable rate_y equal -0.05",
    "variable rate_z equal 0.2*cos(step*0.01)",
    "variable turn equal 20*cos(step*0.01)",
]


def vector(v, scale: float = 1.0) -> str:
    return " ".join(f"{scale * c:.6g}" for c in v)


def draw_verb(rng: Random, verb: str) -> str:
    """Speeds of some 0.1 m/s near the origin."""
    origin, axis = f"origin {vector(direction(rng), 5e-3)}", f"axis {vector(direction(rng))}"
    period = rng.uniform(3e-4, 2e-3)
    if verb == "linear":
        return f"linear {vector(direction(rng), rng.uniform(0.02, 0.3))}"
    if verb == "linear/variable":
        return "linear/variable v_rate_x v_rate_y v_rate_z"
    if verb == "wiggle":
        return f"wiggle amplitude {vector(direction(rng), 0.03 * period)} period {period:.6g}"
    if verb == "rotate":
        return f"rotate {origin} {axis} period {rng.choice((-1, 1)) * rng.uniform(0.1, 1.0):.6g}"
    if verb == "rotate/variable":
        return f"rotate/variable {origin} {axis} omega v_turn"
    if verb == "riggle":
        return f"riggle {origin} {axis} period {period:.6g} amplitude {rng.uniform(50, 200) * period:.6g}"
    periods = f"phase 0.3 2 period {period:.6g} {0.7 * period:.6g}"
    if verb == "viblin":
        return f"viblin {axis} order 2 amplitude {0.02 * period:.6g} {0.01 * period:.6g} {periods}"
    return f"vibrot {origin} {axis} order 2 amplitude {3 * period:.6g} {period:.6g} {periods}"


VERBS = ("linear", "linear/variable", "wiggle", "rotate", "rotate/variable", "riggle", "viblin", "vibrot")


def draw_sliding(rng: Random, flat: bool) -> str:
    """No roller beside triangles: LIGGGHTS turns its velocity into their plane at the nodes, and interpolates it."""
    if flat or rng.random() < 0.5:
        return f"surface_vel {vector(direction(rng), rng.uniform(0.1, 0.5))}"
    axis = vector(direction(rng))
    return f"surface_ang_vel origin {vector(direction(rng), 2e-3)} axis {axis} omega {rng.uniform(-50, 50):.6g}"


def draw(rng: Random, wall: Wall, kind: str) -> Motion:
    """At rest beside primitives, which cannot move, and beside curved twins."""
    if wall.primitive or wall.deforms or kind == "curved twin" or rng.random() < 0.2:
        return Motion()
    choice = rng.random()
    if choice < 0.15:
        return Motion(sliding=draw_sliding(rng, kind == "flat twin"))
    if choice < 0.3 and kind != "flat twin":
        words = (
            f"servo com 0 0 0 ctrlPV force axis {vector(direction(rng))} target_val {rng.choice((-1, 1)) * 0.02} "
            f"vel_max {rng.uniform(0.02, 0.1):.6g} kp 0.5 ki {rng.choice((0, 100))}"
        )
        return Motion(servo_words=words)
    if choice < 0.5:
        # a rotation that is carried along; of two rotations LIGGGHTS' velocities are not those of a rigid body
        return Motion([draw_verb(rng, "rotate"), draw_verb(rng, "linear")])
    return Motion([draw_verb(rng, rng.choice(VERBS))], variables=VARIABLES)

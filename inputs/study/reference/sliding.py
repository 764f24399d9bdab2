# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball that slides without friction on a surface z(x, y) and never leaves it: the exact contact force.

Let q = (x, y) be the foot, X(q) the point there, n(q) the unit normal (upwards) and r the radius.  The centre
c = X + r n moves on the offset surface, whose tangents are c_q = X_q + r n_q and whose normal is n too.  From n.v = 0
follows n.a = -n'.v; with m a = m g + F n and n' = n_q q':

    q' = c_q^+ v,    a = g + (F/m) n,    F = -m (g.n + n'.v)

(n'.v is the curvature of the offset surface times the speed squared.)  The overlap by which a real contact carries F is
left out: it moves the centre by 4e-8 m where the surface's radii are 2e-2 m.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

DOWN = np.array([0.0, 0.0, -1.0])
RELATIVE_ERROR = 1e-11  # of the integration, per step


@dataclass(frozen=True)
class Slope:
    """Height of a wall z(x, y) with its first and second derivatives."""

    z: float
    zx: float
    zy: float
    zxx: float
    zxy: float
    zyy: float


Surface = Callable[[float, float], Slope]


@dataclass(frozen=True)
class SlidingBall:
    """radius [m], gravity [m/s2]; forces come out in units of the ball's weight."""

    surface: Surface
    radius: float
    gravity: float

    def frame(self, x: float, y: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Unit normal n, its derivatives n_q and the centre's c_q (rows: by x, by y)."""
        s = self.surface(x, y)
        length = np.sqrt(1.0 + s.zx**2 + s.zy**2)
        n = np.array([-s.zx, -s.zy, 1.0]) / length
        by_q = np.array([[-s.zxx, -s.zxy, 0.0], [-s.zxy, -s.zyy, 0.0]]) / length
        n_q = by_q - np.outer(by_q @ n, n)
        X_q = np.array([[1.0, 0.0, s.zx], [0.0, 1.0, s.zy]])
        return n, n_q, X_q + self.radius * n_q

    def rates(self, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
        """q', the acceleration a, and F over the weight."""
        n, n_q, c_q = self.frame(*q)
        q_rate = np.linalg.solve(c_q @ c_q.T, c_q @ v)
        g = self.gravity * DOWN
        force = -(g @ n + (q_rate @ n_q) @ v)
        return q_rate, g + force * n, force / self.gravity

    def foot(self, centre: np.ndarray) -> np.ndarray:
        """q below a centre that is on the offset surface, or nearly."""

        def miss(q: np.ndarray) -> np.ndarray:
            n, _, _ = self.frame(*q)
            return q + self.radius * n[:2] - centre[:2]

        return fsolve(miss, centre[:2], xtol=1e-14)

    def force(self, centre: np.ndarray, v: np.ndarray, t: np.ndarray) -> np.ndarray:
        """F over the weight at the times t (the first is the start), from a centre and a velocity near the surface."""
        q = self.foot(centre)
        n, _, _ = self.frame(*q)
        start = np.concatenate([q, v - (v @ n) * n])

        def derivative(_: float, state: np.ndarray) -> np.ndarray:
            q_rate, a, _ = self.rates(state[:2], state[2:])
            return np.concatenate([q_rate, a])

        motion = solve_ivp(
            derivative, (t[0], t[-1]), start, "DOP853", t, rtol=RELATIVE_ERROR, atol=1e-3 * RELATIVE_ERROR
        )
        return np.array([self.rates(state[:2], state[2:])[2] for state in motion.y.T])

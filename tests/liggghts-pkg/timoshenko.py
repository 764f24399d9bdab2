# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball on a simply supported beam, in closed form: Timoshenko's beam (1921), which shears and has rotary inertia, by all its
modes; Hertz' force; motion between kicks exact (Timoshenko 1913, Z. Math. Phys. 62, 198-209, asked first)."""

from __future__ import annotations

import numpy as np


def modes(E: float, nu: float, rho: float, length: float, side: float, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies [rad/s] of what moves the middle of a square beam, and phi(middle)^2 [1/kg]: w = W sin k x, psi = P cos k x."""
    A, I, G, shear = side**2, side**4 / 12, E / (2 * (1 + nu)), 10 * (1 + nu) / (12 + 11 * nu)  # Cowper (1966)
    omega, mobility = [], []
    for n in range(1, 2 * count, 2):
        k, S = n * np.pi / length, shear * G * A
        K = np.array([[S * k**2, -S * k], [-S * k, E * I * k**2 + S]])
        root = np.sqrt([rho * A, rho * I])
        squares, shapes = np.linalg.eigh(K / np.outer(root, root))
        omega += list(np.sqrt(squares))
        mobility += list(2 / length * (shapes[0] / root[0]) ** 2)
    return np.array(omega), np.array(mobility)


def impact(omega: np.ndarray, mobility: np.ndarray, mass: float, K: float, speed: float, dt: float, steps: int) -> np.ndarray:
    """Rows t, force, ball's velocity: a ball that begins to touch, K its Hertz constant [N/m^1.5]."""
    cosine, sine = np.cos(omega * dt), np.sin(omega * dt)
    q, v = np.zeros_like(omega), np.zeros_like(omega)
    x, u, force, rows = 0.0, speed, 0.0, []
    for n in range(steps):
        rows.append((n * dt, force, u))
        v += 0.5 * dt * force * mobility  # q: share of the middle's deflection
        u -= 0.5 * dt * force / mass
        q, v = cosine * q + sine / omega * v, cosine * v - omega * sine * q
        x += dt * u
        force = K * max(0.0, x - q.sum()) ** 1.5
        v += 0.5 * dt * force * mobility
        u -= 0.5 * dt * force / mass
    return np.array(rows)

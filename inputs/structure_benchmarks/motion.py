# SPDX-License-Identifier: GPL-2.0-or-later
"""Free blocks in time: energy, momenta, lumped inertia."""

from __future__ import annotations

import math

import numpy as np

from solve import Benchmark, Model, Solve, Solved, box, model, order
from study.run.summary import Row

BLOCK = box([4, 4, 4], [4, 4, 4], 2)  # unit cubes
CRITICAL_STEP = 0.6454  # of it, E = density = 1, nu = 0.3: an independent code's
STEPS = 20000


def free_block(law: str, velocity: list[str], share: float, steps: int) -> Model:
    """`share` of the critical step; a hundred rows at least."""
    dt = share * CRITICAL_STEP
    return model(BLOCK, (law, 1.0, 0.3, 1.0), [], initial={"velocity": velocity}, time={"end": steps * dt, "step": dt},
                 output={"every": 7 * dt, "file": "run"})  # fmt: skip


def energies(solved: Solved) -> np.ndarray:
    """E/E0 - 1 at whole steps."""
    E = solved.history["kinetic_energy"] + solved.history["strain_energy"]
    return E / E[0] - 1.0


def trend(deviation: np.ndarray) -> float:
    """Of the mean, from the first to the last fifth of a run."""
    part = len(deviation) // 5
    return deviation[-part:].mean() - deviation[:part].mean()


def vibration() -> Benchmark:
    """Smooth initial velocities: twice what an independent code has; its square in the step, and no trend."""
    name = "vibrating block"
    velocity = ["1e-3*sin(pi*x/8)*cos(pi*y/8)", "1e-3*cos(pi*z/8)", "1e-3*sin(pi*y/8)"]
    most = {0.95: 2.5e-2, 0.8: 1.3e-2, 0.5: 4.4e-3, 0.2: 6.9e-4, 0.1: 1.8e-4}
    drift = {0.95: 3e-4, 0.1: 1e-6}

    def rows(solve: Solve) -> list[Row]:
        seen = {share: energies(solve(free_block("linear_elastic", velocity, share, STEPS))) for share in most}
        largest = {share: np.abs(E).max() for share, E in seen.items()}
        found = [Row(case_of(share), "largest |E/E0 - 1|", largest[share], "", 0.0, 2 * most[share]) for share in most]
        found += [Row(case_of(share), "trend of E/E0", trend(seen[share]), "", 0.0, 2 * drift[share]) for share in drift]
        return [*found, order(case_of(0.1), "the energy error in the step", largest[0.2], largest[0.1], 2.0, 0.2)]

    def case_of(share: float) -> str:
        return f"{name} (4 x 4 x 4, p = 2, dt = {share:g} critical, {STEPS} steps)"

    return Benchmark(name, rows)


def spin(share: float, largest: float) -> Benchmark:
    """A block that turns freely: energy as above, angular momentum to round-off."""
    name, omega = "spinning block", 0.03
    case = f"{name} (4 x 4 x 4, p = 2, dt = {share:g} critical, {STEPS} steps)"

    def rows(solve: Solve) -> list[Row]:
        velocity = [f"-{omega}*(y-2)", f"{omega}*(x-2)", "0"]
        solved = solve(free_block("saint_venant_kirchhoff", velocity, share, STEPS))
        L = solved.history["angular_momentum"]
        turns = omega * solved.history["time"][-1] / (2 * math.pi)  # about: it is wider when it turns
        deviation = energies(solved)
        return [
            Row(case, "turns", turns, "", None, None),
            Row(case, "largest |E/E0 - 1|", np.abs(deviation).max(), "", 0.0, 2 * largest),
            Row(case, "trend of E/E0", trend(deviation), "", 0.0, 1e-6),
            Row(case, "largest |L/L0 - 1|", np.abs(L - L[0]).max() / np.linalg.norm(L[0]), "", 0.0, 1e-10),
        ]

    return Benchmark(name, rows)


def lumped_inertia(n: int, p: int, reference: float) -> Benchmark:
    """sum m x^2 / integral of rho x^2 along a direction of n elements: angular momentum of a thin rod that starts to turn."""
    name, thin = "lumped inertia", 1e-5

    def rows(solve: Solve) -> list[Row]:
        rod = {"box": {"origin": [-0.5, -thin / 2, -thin / 2], "size": [1, thin, thin], "elements": [n, 1, 1], "degree": p}}
        dt = 1e-9
        solved = solve(
            model(rod, ("linear_elastic", 1.0, 0.0, 1.0), [], initial={"velocity": ["-y", "x", 0]},
                  time={"end": dt, "step": dt}, output={"every": dt, "file": "run"})
        )  # fmt: skip
        ratio = solved.history["angular_momentum"][0, 2] / (thin**2 / 12)
        return [Row(f"{name} ({n} elements, p = {p})", "sum m x^2 / (rho L^3/12)", ratio, "", reference, 1e-6)]

    return Benchmark(name, rows)


P_2 = {2: 1.5, 4: 1.15625, 6: 1.074074, 8: 1.042969, 12: 1.019676, 20: 1.007250}
BENCHMARKS = [
    vibration(),
    spin(0.8, 1.3e-2),
    spin(0.2, 6.9e-4),
    *(lumped_inertia(n, 2, ratio) for n, ratio in P_2.items()),
    lumped_inertia(6, 3, 1.089506), lumped_inertia(12, 3, 1.025077), lumped_inertia(4, 1, 1.125),
]  # fmt: skip

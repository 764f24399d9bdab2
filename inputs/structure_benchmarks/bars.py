# SPDX-License-Identifier: GPL-2.0-or-later
"""Waves along bars, nu = 0, E = density = 1, so c = 1: what row-sum lumped masses do to them."""

from __future__ import annotations

import math
from typing import Sequence

import numpy as np

from solve import Benchmark, Model, Solve, box, fix, model, order
from study.run.summary import Row

BAR = ("linear_elastic", 1.0, 0.0, 1.0)


def bar(length: float, elements: int, p: int, width: float = 1.0) -> Model:
    return box([length, width, width], [elements, 1, 1], p)


def middle_probe() -> Model:
    return {"middle": {"face": "eta-", "at": [0.5, 0.5]}}


def wave_speed(solve: Solve, p: int, per_wavelength: int) -> float:
    """Phase speed of a standing wave, whose initial velocity is one of the infinite bar's: no end is felt in the middle."""
    waves = math.ceil(400 / per_wavelength) + 0.5  # an antinode in the middle
    n = round(per_wavelength * waves)
    k = 2 * math.pi / per_wavelength
    solved = solve(
        model(bar(n, n, p), BAR, [fix(["x"], "xi-", "xi+"), fix(["y", "z"])], initial={"velocity": [f"sin({k!r}*x)", 0, 0]},
              time={"end": 0.45 * n, "step": 0.25}, output={"every": 0.2, "file": "run"}, probes=middle_probe())
    )  # fmt: skip
    t, u = solved.history["time"], solved.history["probes/middle"][:, 0]
    before = np.flatnonzero(u[1:-1] * u[2:] < 0) + 1
    zeros = t[before] + (t[before + 1] - t[before]) * u[before] / (u[before] - u[before + 1])
    discrete = math.pi * (len(zeros) - 1) / (zeros[-1] - zeros[0])
    dt = t[1] - t[0]
    return 2 / dt * math.sin(0.5 * discrete * dt) / k  # without the error of central differences


def waves(p: int, speeds: Sequence[tuple[int, float]]) -> Benchmark:
    """Speeds over c beside the closed forms of the infinite bar; their order in the mesh is 2 whatever the degree."""
    name = "bar wave"

    def rows(solve: Solve) -> list[Row]:
        seen = [wave_speed(solve, p, n) for n, _ in speeds]
        found = [Row(f"{name} ({n} elements each, p = {p})", "speed / c", c, "", exact, 1e-3) for c, (n, exact) in zip(seen, speeds)]
        return [*found, order(f"{name} (20 to 40 elements each, p = {p})", "speed", 1 - seen[-2], 1 - seen[-1], 2.0, 0.1)]

    return Benchmark(name, rows)


def critical_step(p: int, exact: float, tolerance: float) -> Benchmark:
    """c dt/h of a free bar; what is found may lie below, by up to 0.035.  So wide that nothing across it counts."""
    name, n = "free bar", 20

    def rows(solve: Solve) -> list[Row]:
        step = solve(model(bar(n, n, p, 1e4), BAR, [fix(["y", "z"])], time={"end": 0.01})).stable_step()
        return [Row(f"{name} ({n} elements, p = {p})", "c dt/h, critical", step, "", exact, tolerance)]

    return Benchmark(name, rows)


def pulse(p: int, n: int, peak: float, error: float, step: float) -> Benchmark:
    """A half sine of force at one end: peak and L2 error of the velocity in the middle, and the momentum."""
    name, mesh = "half-sine pulse", f"{n} elements, p = {p}"

    def rows(solve: Solve) -> list[Row]:
        solved = solve(
            model(bar(1.0, n, p), BAR, [fix(["y", "z"])],
                  loads={"tractions": [{"face": "xi-", "value": [1, 0, 0], "time": "t < 0.2 ? sin(pi*t/0.2) : 0"}]},
                  time={"end": 0.95, "step": 0.5 * step / n}, output={"every": 0.4 * step / n, "file": "run"},
                  probes=middle_probe())
        )  # fmt: skip
        t, u = solved.history["time"], solved.history["probes/middle"][:, 0]
        v, at = np.diff(u) / np.diff(t), 0.5 * (t[1:] + t[:-1])
        exact = np.where((at > 0.5) & (at < 0.7), np.sin(math.pi * (at - 0.5) / 0.2), 0.0)
        momentum = solved.history["linear_momentum"][-1, 0]
        case = f"{name} ({mesh})"
        return [
            Row(case, "peak velocity", v.max(), "", peak, 2e-3),
            Row(case, "error of the velocity, L2", math.sqrt(((v - exact) ** 2).sum() / (exact**2).sum()), "", error, 2e-2),
            Row(case, "momentum", momentum, "", 0.4 / math.pi, 3e-4),
        ]

    return Benchmark(name, rows)


def step_load(free: bool) -> Benchmark:
    """A force 1 from t = 0 on: mean velocity of the free end, or mean force on the held one, behind the front is twice 1."""
    name, n, p = f"bar under a step, {'free' if free else 'held'} end", 200, 2
    end = [] if free else [{"name": "end", "fix": ["x"], "faces": ["xi+"]}]

    def rows(solve: Solve) -> list[Row]:
        history = solve(
            model(bar(1.0, n, p), BAR, [*end, fix(["y", "z"])], loads={"tractions": [{"face": "xi-", "value": [1, 0, 0]}]},
                  time={"end": 1.9, "step": 0.4 / n}, output={"every": 0.4 / n, "file": "run"},
                  probes={"end": {"face": "xi+", "at": [0.5, 0.5]}})
        ).history  # fmt: skip
        t = history["time"]
        behind = (t > 1.2) & (t < 1.8)
        if free:
            quantity, value = "v/(sigma/(rho c))", np.polyfit(t[behind], history["probes/end"][behind, 0], 1)[0]
        else:
            quantity, value = "sigma/sigma_0", -history["reactions/end"][behind, 0].mean()
        return [Row(f"{name} ({n} elements, p = {p})", quantity, value, "", 2.0, 5e-3)]

    return Benchmark(name, rows)


BENCHMARKS = [
    waves(1, [(8, 0.97450), (10, 0.98363), (16, 0.99359), (20, 0.99589), (40, 0.99897)]),
    waves(2, [(8, 0.92570), (10, 0.95181), (16, 0.98090), (20, 0.98774), (40, 0.99692)]),
    waves(3, [(8, 0.90182), (10, 0.93612), (16, 0.97459), (20, 0.98367), (40, 0.99590)]),
    critical_step(1, 1.0, 0.035), critical_step(2, 0.86206, 1e-3), critical_step(3, 0.65274, 1e-3),
    pulse(2, 100, 1.047, 0.114, 0.86206), pulse(2, 200, 1.013, 0.053, 0.86206), pulse(1, 200, 1.007, 0.028, 1.0),
    step_load(True), step_load(False),
]  # fmt: skip

# SPDX-License-Identifier: GPL-2.0-or-later
"""One element in homogeneous finite strain, E = 1000, nu = 0.3: closed forms to eight digits."""

from __future__ import annotations

from solve import ALL, Benchmark, Solve, box, fix, mesh_of, model
from study.run.summary import Row

E, NU = 1000.0, 0.3
MU = E / (2 * (1 + NU))
MESH = mesh_of([1, 1, 1], 2)
TOLERANCE = 1e-8


def uniaxial(law: str, stress: float, stretch: float, lateral: float) -> Benchmark:
    """Stretches of a block under a first Piola-Kirchhoff stress."""
    name = f"{law}, P = {stress:g}"

    def rows(solve: Solve) -> list[Row]:
        end = solve(
            model(box([1, 1, 1], [1, 1, 1], 2), (law, E, NU, 1.0),
                  [fix(["x"], "xi-"), fix(["y"], "eta-"), fix(["z"], "zeta-")],
                  {"kind": "static", "load_steps": 2, "tolerance": 1e-11},
                  loads={"tractions": [{"face": "xi+", "value": [stress, 0, 0]}]},
                  probes={"end": {"face": "xi+", "at": [1.0, 1.0]}})
        ).probe("end")  # fmt: skip
        return [
            Row(f"{name} ({MESH})", "stretch", 1.0 + end[0], "", stretch, TOLERANCE),
            Row(f"{name} ({MESH})", "lateral stretch", 1.0 + end[1], "", lateral, TOLERANCE),
        ]

    return Benchmark(name, rows)


def simple_shear(gamma: float) -> Benchmark:
    """x + gamma y of neo-Hooke, all but the middle control point moved: P_12 = sigma_12 = mu gamma, the force on the top."""
    name = f"neo_hooke, simple shear {gamma:g}"
    bottom = {"fix": ALL, "faces": ["eta-"]}
    top = {"name": "top", "move": {"x": gamma, "y": 0, "z": 0}, "faces": ["eta+"]}
    sides = {"move": {"x": gamma / 2, "y": 0, "z": 0}, "faces": ["xi-", "xi+", "zeta-", "zeta+"]}  # what is left: half way up

    def rows(solve: Solve) -> list[Row]:
        P = solve(
            model(box([1, 1, 1], [1, 1, 1], 2), ("neo_hooke", E, NU, 1.0), [bottom, top, sides],
                  {"kind": "static", "load_steps": 2, "tolerance": 1e-11}, output={"file": "run"})
        ).history["reactions/top"][-1]  # fmt: skip
        return [
            Row(f"{name} ({MESH})", "sigma_12", P[0], "", MU * gamma, TOLERANCE),
            Row(f"{name} ({MESH})", "P_22", P[1], "", 0.0, TOLERANCE * MU),
        ]

    return Benchmark(name, rows)


BENCHMARKS = [
    uniaxial("neo_hooke", -108.722185, 0.9, 1.03170243),
    uniaxial("neo_hooke", 93.077432, 1.1, 0.97149295),
    uniaxial("neo_hooke", 174.929147, 1.2, 0.94563262),
    uniaxial("neo_hooke", 646.744660, 2.0, 0.79807754),
    uniaxial("saint_venant_kirchhoff", 115.5, 1.1, 0.96798760),
    uniaxial("saint_venant_kirchhoff", 937.5, 1.5, 0.79056942),
    simple_shear(0.5),
    simple_shear(1.0),
]

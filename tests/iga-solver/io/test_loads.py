# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads of iga-solve in space and time: forces in closed form are the change of momentum in each step, a shaken base is a
moving frame, a foundation carries a weight, damping, initial velocities; the ledger with all of them; ranks; mistakes."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from test_supports import PROGRAM, run

BLOCK = """units: si
geometry: {{box: {{origin: {origin}, size: [2, 1, 0.5], elements: {elements}, degree: 2}}}}
material: {{law: {law}, youngs_modulus: 1e5, poissons_ratio: 0.3, density: 10}}
output: {{every: 1e-9, file: out}}
{more}
"""
STEP = 2e-4


def block(more: str, law="saint_venant_kirchhoff", elements="[4, 3, 2]", origin="[0, 0, 0]") -> str:
    return BLOCK.format(more=more, law=law, elements=elements, origin=origin)


EVERYTHING = """boundary:
  - {name: base, move: {x: 1e-3, z: -2e-3}, faces: [xi-], time: {sine: {frequency: 20}}}
  - {name: ground, spring: {stiffness: 1e4, direction: [0, 1, 2]}, faces: [zeta-]}
  - {name: corner, spring: {stiffness: 30}, edge: [xi+, eta+]}
loads:
  gravity: {value: [0, 0, -9.81], time: {ramp: [0, 5e-3]}}
  tractions:
    - {face: zeta+, value: [0, 10*x, "-100*sin(pi*y)*(1 + 50*t)"]}
    - {face: eta-, value: ["20*x^2", 0, 3], time: "1 - exp(-200*t)"}
  pressures: [{face: xi+, value: "300 + 100*y", time: {ramp: [1e-3, 4e-3]}}, {face: zeta+, value: 50*t}]
  lines: [{edge: [xi+, zeta+], value: [1, 2, "3*y"], time: {table: [[0, 1], [5e-3, -1]]}}]
  points: [{face: eta+, at: [0.3, 0.6], force: [5, 0, -5], time: {sine: {frequency: 100}}}]
  body_force: {value: ["4*y", 0, "x*z"], time: {ramp: [0, 1e-3]}}
initial: {velocity: [0.1*z, 0, "0.2*sin(x)"]}
damping: {mass: 5}
"""


class Loads(unittest.TestCase):
    def solve(self, *arguments, **keywords) -> dict[str, np.ndarray]:
        done, series = run(*arguments, **keywords)
        self.assertEqual(done.returncode, 0, done.stderr)
        return series

    def check_balance(self, seen: dict[str, np.ndarray]) -> None:
        left = (
            seen["kinetic_energy"] + seen["ledger/internal"] + seen["ledger/damped"] - seen["ledger/loads"]
            - seen["ledger/supports"]
        )  # fmt: skip
        np.testing.assert_allclose(left, left[0], rtol=0, atol=1e-12 * seen["kinetic_energy"].max())

    def test_momentum_is_what_the_loads_give(self):
        """Of a free block of 2 x 1 x 0.5 whose loads have closed forms."""
        for loads, force in (
            ('tractions: [{face: zeta+, value: [x, "y*t", "-3*t^2"]}]', lambda t: (2.0, t, -6 * t**2)),
            ('tractions: [{face: zeta+, value: [x, y^2, -3], time: "cos(100*t)"}]',
             lambda t: np.array([2, 2 / 3, -6]) * np.cos(100 * t)),
            ("tractions: [{face: xi+, value: [1, 2, 3], time: {ramp: [1e-3, 2e-3]}}]",
             lambda t: 0.5 * np.array([1, 2, 3]) * np.clip((t - 1e-3) / 1e-3, 0, 1)),
            ("lines: [{edge: [zeta-, eta+], value: [x, 1, 0]}]", lambda t: (2, 2, 0)),
            ("points: [{face: zeta+, at: [0.1, 0.9], force: [1, 2, 3], time: {table: [[0, 0], [1, 5]]}}]",
             lambda t: np.array([5, 10, 15]) * t),
            ("body_force: {value: [x*y*z, 1, 0]}", lambda t: (2 * 0.5 * 0.125, 1, 0)),
            ("tractions: [{face: zeta+, value: {x: [0, 1, 2], t: [0, 1e-3], table: "
             "[[0, 0, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0], [3, 0, -2], [1, 0, 4]]}}]",
             lambda t: np.array([4, 0, 0]) * np.clip(t / 1e-3, 0, 1)),
            ("tractions: [{face: zeta+, value: {y: [0, 2], table: [[0, 0, 0], [0, 3, 0]]}}]", lambda t: (0, 1.5, 0)),
            ("body_force: {value: {z: [0, 0.5], table: [[0, 0, 0], [4, 0, 2]]}}", lambda t: (2, 0, 1)),
            ("gravity: {value: [1, 0, 2], time: {sine: {frequency: 30}}}",
             lambda t: 10 * np.array([1, 0, 2]) * np.sin(2 * np.pi * 30 * t)),
        ):  # fmt: skip
            with self.subTest(loads):
                seen = self.solve(block(f"loads: {{{loads}}}"), 4e-3, STEP)
                self.assertEqual(len(seen["time"]), 21)
                forces = np.array([force(t) for t in seen["time"]], dtype=float)
                change = 0.5 * STEP * (forces[1:] + forces[:-1])
                np.testing.assert_allclose(np.diff(seen["linear_momentum"], axis=0), change, rtol=0, atol=1e-12 * np.abs(change).max())
                self.check_balance(seen)
                work = np.abs(seen["ledger/loads"]).max()
                np.testing.assert_allclose(seen["load_work"], seen["ledger/loads"], rtol=0, atol=0.2 * work)

    def test_a_number_is_an_expression(self):
        one = self.solve(block("loads: {tractions: [{face: zeta+, value: [1, -2, 3]}]}"), 4e-3, STEP)
        for value in ('["0*x + 1", -2, 3]', '["1 + 0*t", -2, 3]'):
            other = self.solve(block(f"loads: {{tractions: [{{face: zeta+, value: {value}}}]}}"), 4e-3, STEP)
            np.testing.assert_allclose(other["strain_energy"], one["strain_energy"], rtol=1e-10)

    def test_a_pressure_all_round_moves_nothing(self):
        faces = ", ".join(f"{{face: {face}, value: 2e4, time: {{ramp: [0, 2e-3]}}}}" for face in ("xi-", "xi+", "eta-", "eta+", "zeta-", "zeta+"))
        seen = self.solve(block(f"loads: {{pressures: [{faces}]}}\ndamping: {{mass: 250}}", law="neo_hooke"), 0.2, STEP)
        self.assertLess(np.abs(seen["linear_momentum"]).max(), 1e-11)
        self.assertLess(np.abs(seen["angular_momentum"]).max(), 1e-11)
        self.check_balance(seen)
        # at rest: all stretched alike by s, whose stress is mu (s - 1/s) + 3 lambda ln(s)/s = -p s^2
        mu, lam = 1e5 / 2.6, 1e5 * 0.3 / (1.3 * 0.4)
        low, high = 0.5, 1.0
        for _ in range(60):
            s = 0.5 * (low + high)
            low, high = (s, high) if mu * (s - 1 / s) + 3 * lam * np.log(s) / s < -2e4 * s**2 else (low, s)
        energy = 1.0 * (mu / 2 * (3 * s**2 - 3) - 3 * mu * np.log(s) + lam / 2 * (3 * np.log(s)) ** 2)
        self.assertAlmostEqual(seen["strain_energy"][-1] / energy, 1, delta=1e-6)

    def test_a_shaken_base_is_a_moving_frame(self):
        """What the base does is taken off the displacements; in its frame inertia is a load, by the scheme's own second
        difference, -(a sin w t) (2 cos(w dt) - 2)/dt^2."""
        a, w = 1e-3, 2 * np.pi * 25
        probes = "probes: {tip: {face: xi+, at: [0.5, 0.5]}}\n"
        speed = a * np.sin(w * STEP) / STEP
        shaken = self.solve(block(f"{probes}boundary: [{{name: base, move: {{x: 0, y: 0, z: {a}}}, faces: [xi-], "
                                  f"time: {{sine: {{frequency: 25}}}}}}]\ninitial: {{velocity: [0, 0, {speed!r}]}}", "linear_elastic"), 0.1, STEP)
        inertia = -a * (2 * np.cos(w * STEP) - 2) / STEP**2
        held = self.solve(block(f"{probes}boundary: [{{name: base, fix: [x, y, z], faces: [xi-]}}]\n"
                                f"loads: {{gravity: {{value: [0, 0, {inertia!r}], time: {{sine: {{frequency: 25}}}}}}}}", "linear_elastic"), 0.1, STEP)
        base = a * np.sin(w * shaken["time"])
        np.testing.assert_allclose(shaken["probes/tip"][:, 2] - base, held["probes/tip"][:, 2], rtol=0, atol=1e-9 * a)
        self.assertGreater(np.abs(held["probes/tip"]).max(), 0.1 * a)
        held_by = held["reactions/base"][:, 2]  # what carries the base along is what holds it against the load there
        np.testing.assert_allclose(shaken["reactions/base"][1:, 2], held_by[1:], rtol=0, atol=1e-7 * np.abs(held_by).max())
        self.check_balance(shaken)

    def test_a_foundation_carries_the_weight(self):
        """At rest, by damping: weight / (k area) deep; whatever the mesh, since forces go straight through."""
        more = ("boundary: [{name: ground, spring: {stiffness: 5e3, direction: [0, 0, -3]}, faces: [zeta-]}, {fix: [x, y], patch: 0}]\n"
                "probes: {below: {face: zeta-, at: [0.3, 0.7]}}\nloads: {gravity: [0, 0, -9.81]}\ndamping: {mass: 60}")  # fmt: skip
        seen = self.solve(block(more), 1.0, STEP)
        self.assertAlmostEqual(seen["reactions/ground"][-1, 2] / 98.1, 1, delta=1e-6)
        self.assertAlmostEqual(seen["probes/below"][-1, 2] / (-98.1 / (5e3 * 2)), 1, delta=1e-2)
        np.testing.assert_array_equal(seen["reactions/ground"][:, :2], 0)
        self.check_balance(seen)

    def test_initial_spin(self):
        """A velocity that is linear in x, y, z is met exactly; inertia is that of lumped masses, 1.15625 times the exact
        one for 4 quadratic elements across."""
        w = 3.0
        seen = self.solve(block(f"initial: {{velocity: [-{w}*y, {w}*x, 0]}}", elements="[4, 4, 2]", origin="[-1, -0.5, 0]"), 1e-3, STEP)
        exact = 10 * (2**2 + 1**2) / 12
        self.assertAlmostEqual(seen["angular_momentum"][0, 2] / (exact * 1.15625 * w), 1, delta=1e-9)
        self.assertAlmostEqual(seen["kinetic_energy"][0] / (0.5 * exact * 1.15625 * w**2), 1, delta=1e-9)
        self.assertLess(np.abs(seen["linear_momentum"][0]).max(), 1e-12)

    def test_viscosity(self):
        """The stable step that is printed is the damped one, and a step above it is refused; a body that is drawn comes to rest
        where it does without."""
        more = "boundary: [{fix: [x, y, z], faces: [xi-]}]\nloads: {gravity: [0, 0, -9.81]}\nprobes: {tip: {face: xi+, at: [0.5, 0.5]}}\n"
        lines = {}
        for name, damping in (("without", ""), ("with", "damping: {stiffness: 1e-3}\n")):
            with tempfile.TemporaryDirectory() as folder:
                (Path(folder) / "model.yaml").write_text(block(more + damping))
                done = subprocess.run([PROGRAM, "model.yaml", "--end", "1e-6"], cwd=folder, capture_output=True, text=True, check=False)
            lines[name] = [float(word) for word in re.findall(r"[-+.e0-9]{4,}", re.search("stable step (.*)", done.stdout)[1])]
        (undamped,), (damped, also) = lines["without"], lines["with"]
        self.assertAlmostEqual(damped / ((undamped**2 + 1e-6) ** 0.5 - 1e-3), 1, delta=2e-3)
        self.assertAlmostEqual(also / undamped, 1, delta=2e-3)
        done, _ = run(block(more + "damping: {stiffness: 1e-3}"), 1e-2, 1.01 * damped)
        self.assertIn("above the stable step", done.stderr)
        rest = self.solve(block(more + "damping: {mass: 24, stiffness: 1e-3}"), 1.6, 0.9 * damped)["probes/tip"][-1]
        slow = self.solve(block(more + "damping: {mass: 24}"), 1.6, 0.9 * damped)["probes/tip"][-1]
        np.testing.assert_allclose(rest, slow, rtol=0, atol=1e-6 * np.abs(slow).max())

    def test_everything_at_once(self):
        seen = self.solve(block(EVERYTHING), 0.02, STEP)
        self.check_balance(seen)
        for name in ("ledger/loads", "ledger/supports", "ledger/damped", "ledger/internal"):
            self.assertGreater(np.abs(seen[name]).max(), 1e-3 * seen["kinetic_energy"].max(), name)

    def test_ranks(self):
        model = block(EVERYTHING, elements="[40, 36, 3]")
        one = self.solve(model, 4e-4, 2e-5)
        self.check_balance(one)
        for ranks in (2, 4):
            more = self.solve(model, 4e-4, 2e-5, ranks)
            self.assertEqual(set(more), set(one))
            for name, values in one.items():
                np.testing.assert_array_equal(more[name], values, err_msg=f"{name}, {ranks} ranks")

    def test_errors(self):
        for more, expected in (
            ("loads: {tractions: [{face: zeta+, value: [0, 0, sin(x]}]}", "model.yaml:5: value is 'sin(x': "),
            ("loads: {tractions: [{face: zeta+, value: [0, q, 1]}]}", "expected a number or an expression of x, y, z, t"),
            ("loads: {tractions: [{face: zeta+, value: [0, 1]}]}", "value is a list of 2, expected 3 numbers or expressions"),
            ("loads: {tractions: [{face: zeta+, value: [0, 1, 1e200]}]}", "expected a number of at most 1e+100"),
            ("loads: {tractions: [{face: zeta+, value: [0, 1, x = 3]}]}", "it assigns"),
            ("loads: {tractions: [{face: zeta+, value: [0, 1, 1/x]}]}\nboundary: []", None),
            ("loads: {body_force: {value: [0, t, 1]}}", "expected a number or an expression of x, y, z"),
            ("loads: {body_force: {value: [0, sqrt(x-1), 1]}}", "model.yaml:5: the expression is not finite somewhere on the solid"),
            ("loads: {pressures: [{face: zeta+, value: sqrt(x-1)}]}", "model.yaml: the load of model.yaml:5 is not finite at time 0"),
            ("loads: {tractions: [{face: zeta+, value: [0, 1/t, 1]}]}", "model.yaml: the load of model.yaml:5 is not finite at time 0"),
            ("loads: {tractions: [{face: zeta+, value: [0, 1/(t-1e-6), 1]}]}", "the load of model.yaml:5 is not finite at time 1e-06"),
            ("loads: {gravity: {value: [0, 0, 1], time: 1/t}}", "model.yaml: the factor 'time' of model.yaml:5 is inf at time 0, expected a number"),
            ("loads: {gravity: {value: [0, 0, 1], time: sqrt(5e-7-t)}}", "nan at time 1e-06, expected a number"),
            ("boundary: [{move: {x: 1}, faces: [xi-], time: 1/t}]", "the factor 'time' of model.yaml:5 is inf at time 0"),
            ("loads: {pressures: [{face: zeta+, value: [0, 0, 1]}]}", "value is a list of 3, expected a word"),
            ("loads: {pressures: [{face: zeta+, value: 1, time: x}]}", "expected a number or an expression of t"),
            ("loads: {lines: [{edge: [xi+, xi+], value: [0, 0, 1]}]}", "model.yaml:5: edge has xi+ twice, expected 2 faces that meet there"),
            ("loads: {lines: [{edge: [xi+, eta+], patch: [0], value: [0, 0, 1]}]}", "patch is a list of 1"),
            ("loads: {lines: [{edge: [zeta+, zeta-], value: [0, 0, 1]}]}", "edge has no control points"),
            ("loads: {points: [{face: zeta+, at: [2, 0], force: [0, 0, 1]}]}", "at is [2, 0], expected 2 numbers from 0 to 1"),
            ("loads: {tractions: [{face: zeta+, value: {x: [0, 1], table: [[0, 0, 1]]}}]}", "table: 1 rows, expected 2"),
            ("loads: {tractions: [{face: zeta+, value: {x: [1, 0], table: [[0, 0, 1], [0, 0, 1]]}}]}", "expected rising numbers"),
            ("loads: {pressures: [{face: zeta+, value: {t: [0], table: [[0, 1]]}}]}", "a row of 2 numbers, expected 1"),
            ("loads: {body_force: {value: {t: [0], table: [[0, 0, 1]]}}}", "unknown key"),
            ("loads: {gravity: deck}", "loads.gravity is deck, expected a vector: there is no deck here"),
            ("loads: {gravity: moon}", "gravity is 'moon', expected [x, y, z]"),
            ("loads: {pressure: 3}", "did you mean 'pressures'?"),
            ("boundary: [{spring: {stiffness: 1, per: area}, edge: [xi-, eta-]}]", "per is area, expected 'faces'"),
            ("boundary: [{spring: {stiffness: -1}, faces: [xi-]}]", "stiffness is -1, expected a number > 0"),
            ("boundary: [{spring: {stiffness: 1}, fix: [x], faces: [xi-]}]", "2 of 'fix', 'move', 'spring', 'symmetry'"),
            ("damping: {stiffness: 0}", "stiffness is 0, expected a number > 0"),
            ("damping: {mass: -1}", "mass is -1, expected a number >= 0"),
            ("initial: {velocity: [0, 0, t]}", "expected a number or an expression of x, y, z"),
        ):  # fmt: skip
            done, _ = run(block(more), 1e-6, 1e-6)
            if expected is None:
                self.assertEqual(done.returncode, 0, "finite at the points where it is asked for")
                continue
            self.assertNotEqual(done.returncode, 0, more)
            self.assertIn(expected, done.stderr, more)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_what_is_not_finite_for_a_while_stops_there(self):
        """Neither at the start nor at the end; on one rank and on two."""
        gap = "(t > 1e-3 ? (t < 3e-3 ? sqrt(-1) : 1) : 1)"
        for more, expected in (
            (f'loads: {{pressures: [{{face: zeta+, value: "{gap}"}}]}}', "the load of model.yaml:5 is not finite"),
            (f'loads: {{tractions: [{{face: xi+, value: ["{gap}", 0, 0]}}]}}', "the load of model.yaml:5 is not finite"),
            (f'loads: {{pressures: [{{face: zeta+, value: 1, time: "{gap}"}}]}}', "the factor 'time' of model.yaml:5 is -?nan"),
            (f'boundary: [{{move: {{x: 1e-6}}, faces: [xi-], time: "{gap}"}}]', "the factor 'time' of model.yaml:5 is -?nan"),
        ):  # fmt: skip
            for ranks in (1, 2):
                with self.subTest(more=more, ranks=ranks):
                    done, _ = run(block(more, elements="[20, 18, 3]"), 4e-3, 5e-5, ranks)
                    self.assertNotEqual(done.returncode, 0)
                    self.assertRegex(done.stderr, rf"model.yaml: step \d+: {expected} at time 0.001\d*, expected .*; the histories before it are")

    def test_what_one_rank_alone_sees_is_told_as_on_one(self):
        """The others do not wait for it."""
        for more in (
            'initial: {velocity: ["sqrt(1.9-x)", 0, 0]}',
            'loads: {lines: [{edge: [xi+, zeta+], value: [0, 0, "ln(y-0.6)"]}]}',
            'loads: {tractions: [{face: xi+, value: [0, 0, "ln(y-0.6)"]}]}',
            'loads: {body_force: {value: [0, 0, "sqrt(1.9-x)"]}}',
            'boundary: [{move: {x: 1e-6}, faces: [xi+], time: "sqrt((t-1e-3)*(t-2e-3))"}]',
        ):
            one, two = (run(block(more, elements="[40, 36, 3]"), 4e-3, 1e-5, ranks)[0] for ranks in (1, 2))
            with self.subTest(more):
                self.assertRegex(one.stderr, "^ERROR: model.yaml:.* expected (a number|numbers)\\b")
                self.assertEqual([two.stderr.splitlines()[0] + "\n", two.stderr.count("ERROR")], [one.stderr, 1])


if __name__ == "__main__":
    unittest.main()

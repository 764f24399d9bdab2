# SPDX-License-Identifier: GPL-2.0-or-later
"""`analysis` of iga-solve: equilibrium by static and by relax beside Hooke's bar and each other, what they write, a motion that
starts from it and stays there; frequencies beside a bar's; what is refused."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

PROGRAM = os.environ["IGA_SOLVE"]
MPIEXEC = os.environ["MPIEXEC"]
E, RHO, LENGTH, STRESS = 2e9, 1000.0, 1.0, 1e6
MODEL = """units: si
geometry: {{box: {{origin: [0, 0, 0], size: [1, 0.1, 0.1], elements: [20, 2, 2], degree: 2}}}}
material: {{law: {law}, youngs_modulus: 2e9, poissons_ratio: 0, density: 1000}}
boundary: [{{name: wall, fix: [x, y, z], faces: [xi-]}}, {{fix: [y, z], faces: [eta-, eta+, zeta-, zeta+]}}]
probes: {{end: {{face: xi+, at: [0.5, 0.5]}}}}
loads: {{tractions: [{{face: xi+, value: [1e6, 0, 0]}}]}}
output: {{file: out, fields: [displacement, stress]}}
{more}
"""
MOVING = MODEL.replace("file: out, fields: [displacement, stress]", "file: out, every: 1e-4")
LONG, LONG_MOVING = (text.replace("[20, 2, 2]", "[40, 2, 2]") for text in (MODEL, MOVING))  # two boxes

# two welded bars of different stiffness, one on the other, bent by a force along the edge of the upper one
SANDWICH = """units: mm-t-s
geometry:
  shapes:
    - box: {{origin: [0, 0, 0], size: [100, 20, 4], elements: [20, 4, 2], degree: 2}}
    - box: {{origin: [0, 0, 4], size: [100, 20, 4], elements: [20, 4, 2], degree: 2}}
material:
  - {{patches: [0], law: {law}, youngs_modulus: 2.1e5, poissons_ratio: 0, density: 7.85e-9}}
  - {{patches: [1], law: {law}, youngs_modulus: 7e4, poissons_ratio: 0, density: 2.7e-9}}
boundary: [{{name: clamp, fix: [x, y, z], faces: [xi-], patch: [0, 1]}}]
loads: {{lines: [{{edge: [xi+, zeta+], patch: 1, value: [0, 0, -1]}}]}}
probes: {{end: {{face: xi+, patch: 1, at: [0.5, 0]}}}}
output: {{file: out, fields: [displacement, stress]}}
{more}
"""


class Analyses(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_model(
        self, more: str, *words: str, law: str = "linear_elastic", ranks: int = 1, text: str = MODEL, code: int = 0
    ) -> str:
        (self.folder / "model.yaml").write_text(text.format(law=law, more=more))
        launcher = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
        done = subprocess.run(
            [*launcher, PROGRAM, "model.yaml", *words], cwd=self.folder, capture_output=True, text=True, timeout=60, check=False
        )
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr

    def rows(self, name: str) -> np.ndarray:
        with h5py.File(self.folder / "out.h5") as file:
            return file[name][...]

    def test_static_is_hookes_bar(self):
        printed = self.run_model("analysis: {kind: static, load_steps: 4, save: sagged.h5}")
        self.assertIn("preconditioner sparse", printed)
        np.testing.assert_allclose(self.rows("time"), [0.25, 0.5, 0.75, 1.0])
        stretch = STRESS / E * LENGTH
        np.testing.assert_allclose(self.rows("probes/end")[:, 0], stretch * self.rows("time"), rtol=1e-8)
        np.testing.assert_allclose(self.rows("reactions/wall")[:, 0], -0.01 * STRESS * self.rows("time"), rtol=1e-7)
        np.testing.assert_allclose(self.rows("strain_energy")[-1], 0.5 * 0.01 * STRESS * stretch, rtol=1e-7)
        self.assertEqual(len(list(self.folder.glob("out_volume_*.vtu"))), 4)
        with h5py.File(self.folder / "sagged.h5") as file:
            np.testing.assert_allclose(file["state/displacement"][:, 0], STRESS / E * file["state/reference"][:, 0], atol=1e-11)
            self.assertTrue((file["state/velocity"][...] == 0).all())

    def test_a_motion_that_starts_from_it_stays_there(self):
        for kind in ("static, save: rest.h5", "relax, tolerance: 1e-9, save: rest.h5"):
            for damping in ("", "damping: {stiffness: 1e-5}\n"):
                with self.subTest(kind, damping=damping):
                    self.run_model(f"{damping}analysis: {{kind: {kind}}}", law="neo_hooke")
                    self.check_rest(damping)

    def check_rest(self, damping: str) -> None:
        """Of a motion that starts from rest.h5."""
        self.run_model(f"{damping}state: rest.h5\ntime: {{end: 2e-3}}", law="neo_hooke", text=MOVING)
        self.assertGreater(len(self.rows("time")), 15)
        end, strain = self.rows("probes/end")[:, 0], self.rows("strain_energy")[0]
        self.assertGreater(end[0], 4.9e-4)
        np.testing.assert_allclose(end, end[0], rtol=1e-6)
        self.assertLess(self.rows("kinetic_energy").max(), 1e-10 * strain)
        self.assertLess(np.abs(self.rows("ledger/damped")).max(), 1e-10 * strain)

    def test_viscosity_comes_and_goes_at_a_state(self):
        """It begins with the strain at rest, on parts of the body, too; with other points, likewise."""
        viscous, fewer = "damping: {stiffness: 1e-5}\n", "integration: {quadrature: reduced}\n"
        others = "integration: {quadrature: zou}\n"  # of as many numbers
        for then, now in (("", viscous), (viscous, ""), (viscous, viscous + fewer), (viscous + others, viscous + fewer)):
            with self.subTest(then=then, now=now):
                self.run_model(f"{then}analysis: {{kind: static, save: rest.h5}}", law="neo_hooke")
                self.check_rest(now)
        self.run_model("analysis: {kind: static, save: rest.h5}", text=LONG)
        ends = []
        for ranks in (1, 2):
            self.run_model(f"{viscous}state: rest.h5\ntime: {{end: 2e-4}}", text=LONG_MOVING, ranks=ranks)
            ends.append(self.rows("probes/end"))
            self.assertLess(np.abs(self.rows("ledger/damped")).max(), 1e-10 * self.rows("strain_energy")[0])
        np.testing.assert_array_equal(*ends)

    def test_the_step_of_a_strained_state_is_one_that_it_can_take(self):
        stretched = [text.replace("[1e6, 0, 0]", "[5.28e8, 0, 0]") for text in (MODEL, MOVING)]  # by a fifth
        self.run_model("analysis: {kind: static, load_steps: 4, save: rest.h5}", law="saint_venant_kirchhoff", text=stretched[0])
        self.assertAlmostEqual(self.rows("probes/end")[-1, 0], 0.2, delta=1e-6)
        printed = self.run_model("state: rest.h5\ntime: {end: 1e-3}", law="saint_venant_kirchhoff", text=stretched[1])
        strained, undeformed = map(float, re.search(r"stable step +(\S+), strained as in 'state'; (\S+) else", printed).groups())
        self.assertTrue(0.5 * undeformed < strained < 0.9 * undeformed)
        np.testing.assert_allclose(self.rows("probes/end")[:, 0], 0.2, atol=1e-6)

    def test_what_an_analysis_does_not_use_is_said_when_it_runs(self):
        self.run_model("analysis: {kind: static, save: rest.h5}")
        for more, key in (("state: rest.h5\nanalysis: static", "state"), ("analysis: {kind: modes, count: 1}", "probes")):
            (self.folder / "model.yaml").write_text(MODEL.format(law="linear_elastic", more=more))
            done = subprocess.run([PROGRAM, "--quiet", "model.yaml"], cwd=self.folder, capture_output=True, text=True, check=True)
            self.assertIn(f"WARNING: model.yaml: '{key}' is not used: ", done.stderr)

    def test_initial_velocities_are_taken_with_the_displacements_of_a_state(self):
        self.run_model("analysis: {kind: static, save: rest.h5}")
        thrown = "initial: {velocity: [3, 0, 0]}\ntime: {end: 1e-5}\n"
        seen = {}
        for state in ("", "state: rest.h5\n"):
            self.run_model(thrown + state, text=MOVING)
            seen[state] = self.rows("kinetic_energy")[0], self.rows("probes/end")[0, 0]
        (alone, _), (energy, end) = seen.values()
        self.assertGreater(alone, 0.9 * 0.5 * RHO * 0.01 * LENGTH * 3**2)
        self.assertEqual(energy, alone)
        self.assertAlmostEqual(end / (STRESS / E * LENGTH), 1, delta=1e-6)

    def test_relax_is_static(self):
        self.run_model("analysis: static", law="saint_venant_kirchhoff")
        expected = self.rows("probes/end")[-1]
        printed = self.run_model("analysis: {kind: relax, tolerance: 1e-7}", law="saint_venant_kirchhoff")
        self.assertIn("at rest after", printed)
        np.testing.assert_allclose(self.rows("probes/end")[-1], expected, rtol=1e-5, atol=1e-12)

    def test_relax_takes_the_step_that_is_asked_for(self):
        def step(*words: str) -> float:
            printed = self.run_model("analysis: relax\ntime: {end: 1, step: 2e-6}", *words)
            return float(re.search(r"relax +time step (\S+)", printed).group(1))

        self.assertEqual(step(), 2e-6)
        self.assertEqual(step("--step", "1e-6"), 1e-6)
        above = self.run_model("analysis: relax", "--step", "1", code=1)
        self.assertRegex(above, r"^ERROR: model.yaml: time step 1 is above the stable step \S+$")

    def test_loads_and_supports_of_relax_are_those_of_time_1(self):
        """As of static: a load and a support that are 0 at time 0, a load that is at its peak at time 1, one that has passed it."""
        load, pulled = "value: [1e6, 0, 0]", "loads: {{tractions: [{{face: xi+, value: [1e6, 0, 0]}}]}}\n"
        pull = "boundary: [{{name: hand, move: {{x: 5e-4}}, faces: [xi+], time: {{ramp: [0, 1]}}}}, "
        for name, text in (
            ("ramp", MODEL.replace(load, load + ", time: {{ramp: [0, 1]}}")),
            ("sine", MODEL.replace(load, load + ", time: {{sine: {{frequency: 0.25}}}}")),
            ("table", MODEL.replace(load, load + ", time: {{table: [[0, 3], [1, 1], [2, 3]]}}")),
            ("expression", MODEL.replace("[1e6, 0, 0]", "[1e6*t, 0, 0]")),
            ("support", MODEL.replace(pulled, "").replace("boundary: [", pull)),
        ):
            for analysis in ("static", "{kind: relax, tolerance: 1e-8}"):
                with self.subTest(name=name, analysis=analysis):
                    self.run_model(f"analysis: {analysis}", text=text)
                    np.testing.assert_allclose(self.rows("probes/end")[-1, 0], STRESS / E * LENGTH, rtol=1e-6)
                    np.testing.assert_allclose(self.rows("reactions/wall")[-1, 0], -0.01 * STRESS, rtol=1e-6)

    def test_welded_patches_of_two_materials(self):
        """Timoshenko's beam of two materials without Poisson's ratio; relax gives what static does."""
        E1, E2, width, height, length, force = 2.1e5, 7e4, 20.0, 4.0, 100.0, 20.0
        axis = (E1 * 2 + E2 * 6) / (E1 + E2)
        bending = width * height * (E1 * (height**2 / 12 + (2 - axis) ** 2) + E2 * (height**2 / 12 + (6 - axis) ** 2))
        shear = 5 / 6 * width * height * (E1 + E2) / 2
        expected = -force * (length**3 / (3 * bending) + length / shear)
        self.run_model("analysis: static", text=SANDWICH)
        found = self.rows("probes/end")[-1]
        self.assertLess(abs(found[2] / expected - 1), 2e-3)
        np.testing.assert_allclose(self.rows("reactions/clamp")[-1], [0, 0, force], atol=1e-6)
        self.run_model("analysis: {kind: relax, tolerance: 1e-7}", text=SANDWICH)
        np.testing.assert_allclose(self.rows("probes/end")[-1], found, rtol=1e-4, atol=1e-9)

    def test_a_law_of_small_strain_that_turns_is_warned_of(self):
        """The end of a cantilever that sags by an eighth of its length turns by 9 degrees or so; at rest and on its way."""
        sagging = MODEL.replace(", {{fix: [y, z], faces: [eta-, eta+, zeta-, zeta+]}}", "").replace("[1e6, 0, 0]", "[0, 0, -6e5]")
        for more in ("analysis: static", "time: {end: 0.012}"):
            for law, warned in (("linear_elastic", True), ("saint_venant_kirchhoff", False)):
                text = sagging.format(law=law, more=more).replace("output: {file: out, fields: [displacement, stress]}", "")
                (self.folder / "model.yaml").write_text(text)
                done = subprocess.run([PROGRAM, "--quiet", "model.yaml"], cwd=self.folder, capture_output=True, text=True, check=True)
                with self.subTest(more=more, law=law):
                    self.assertEqual(done.stderr.count("WARNING: model.yaml: at time"), warned, done.stderr)
                    self.assertEqual("is turned by" in done.stderr, warned)

    def test_modes_are_those_of_a_bar(self):
        finer = MODEL.replace("[20, 2, 2]", "[20, 4, 4]")  # lumped masses of fewer across make waves of others too slow
        printed = self.run_model("analysis: {kind: modes, count: 3}", text=finer)
        k = np.arange(3)
        exact = (2 * k + 1) / (4 * LENGTH) * (E / RHO) ** 0.5
        found = self.rows("frequency")
        np.testing.assert_allclose(found[:1], exact[:1], rtol=2e-3)  # lumped masses: below
        self.assertTrue((found < exact).all() and (found > 0.95 * exact).all())
        self.assertIn(f"{found[0]:.8g} 1/s", printed)
        np.testing.assert_allclose(self.rows("angular_frequency"), 2 * np.pi * found, rtol=1e-12)
        shares = self.rows("effective_mass")[:, 0] / (RHO * 0.01)
        np.testing.assert_allclose(shares, 8 / (np.pi * (2 * k + 1)) ** 2, rtol=0.05)
        self.assertEqual(len(list(self.folder.glob("out_volume_*.vtu"))), 3)

    def test_on_springs(self):
        """A bar on springs per area: static, relax; modes from tan(beta L) = k/(E beta), also of consistent masses."""
        k = 1e10
        held = "[{{name: wall, fix: [x, y, z], faces: [xi-]}}, "
        sprung = MODEL.replace(held, f"[{{{{name: wall, spring: {{{{stiffness: {k:g}, direction: [1, 0, 0]}}}}, faces: [xi-]}}}}, ")
        for analysis in ("static", "{kind: relax, tolerance: 1e-8}"):
            self.run_model(f"analysis: {analysis}", text=sprung)
            np.testing.assert_allclose(self.rows("probes/end")[-1, 0], STRESS / k + STRESS / E * LENGTH, rtol=1e-6)
            np.testing.assert_allclose(self.rows("reactions/wall")[-1, 0], -0.01 * STRESS, rtol=1e-6)
        beta = 1.0
        for _ in range(100):
            beta = np.arctan(k / (E * beta)) / LENGTH
        exact = beta * (E / RHO) ** 0.5 / (2 * np.pi)
        for mass, tolerance in (("lumped", 2e-3), ("consistent", 1e-6)):
            self.run_model(f"analysis: {{kind: modes, count: 1, mass: {mass}}}", text=sprung)
            np.testing.assert_allclose(self.rows("frequency")[0], exact, rtol=tolerance)

    def test_under_a_pressure_that_follows(self):
        """Neo-Hooke in uniaxial stress: Cauchy's, so first Piola-Kirchhoff's over the lateral stretch squared, is the pressure."""
        stretch, lateral, P = 0.9, 1.03170243, -108.722185
        block = f"""units: si
geometry: {{{{box: {{{{origin: [0, 0, 0], size: [1, 1, 1], elements: [2, 2, 2], degree: 2}}}}}}}}
material: {{{{law: {{law}}, youngs_modulus: 1000, poissons_ratio: 0.3, density: 1}}}}
boundary: [{{{{fix: [x], faces: [xi-]}}}}, {{{{fix: [y], faces: [eta-]}}}}, {{{{fix: [z], faces: [zeta-]}}}}]
probes: {{{{end: {{{{face: xi+, at: [1, 1]}}}}}}}}
loads: {{{{pressures: [{{{{face: xi+, value: {-P / lateral**2!r}}}}}]}}}}
output: {{{{file: out}}}}
{{more}}
"""
        for analysis in ("static, load_steps: 2, tolerance: 1e-10", "relax, tolerance: 1e-8"):
            self.run_model(f"analysis: {{kind: {analysis}}}", law="neo_hooke", text=block)
            expected = [stretch - 1, lateral - 1, lateral - 1]
            np.testing.assert_allclose(self.rows("probes/end")[-1], expected, atol=1e-7)

    def test_the_work_of_loads_that_change_is_not_told(self):
        """Of constant ones it is their part times displacements."""
        for value, known in (("tractions: [{{face: xi+, value: [1e6, 0, 0]}}]", True),
                             ("tractions: [{{face: xi+, value: [1e6, 0, 0], time: {{ramp: [0, 1]}}}}]", False),
                             ("tractions: [{{face: xi+, value: [1e6*t, 0, 0]}}]", False),
                             ("pressures: [{{face: xi+, value: -1e6}}]", False)):  # fmt: skip
            text = MODEL.replace("tractions: [{{face: xi+, value: [1e6, 0, 0]}}]", value)
            for analysis in ("{kind: static, load_steps: 2}", "relax"):
                with self.subTest(value=value, analysis=analysis):
                    printed = self.run_model(f"analysis: {analysis}", text=text)
                    self.assertEqual("work of the loads not known" in printed, not known)
                    work = self.rows("load_work")
                    parts = np.array([0.5, 1])[-len(work):] if known else np.full(len(work), np.nan)
                    np.testing.assert_allclose(work, 0.01 * STRESS * STRESS / E * LENGTH * parts**2, rtol=1e-5)
                    for name in ("loads", "supports", "damped", "internal", "truncation", "contacts"):
                        self.assertTrue(np.isnan(self.rows("ledger/" + name)).all(), name)

    def test_viscosity_changes_neither_rest_nor_frequencies(self):
        found = {}
        for damping in ("", "\ndamping: {stiffness: 1e-6}"):
            for analysis in ("static", "{kind: relax, tolerance: 1e-7}", "{kind: modes, count: 2}"):
                self.run_model(f"analysis: {analysis}{damping}", law="saint_venant_kirchhoff")
                name = "frequency" if "modes" in analysis else "probes/end"
                found.setdefault(analysis, []).append(self.rows(name)[-1])
        for analysis, (elastic, viscous) in found.items():
            np.testing.assert_allclose(viscous, elastic, rtol=1e-6, atol=1e-12, err_msg=analysis)

    def test_relax_looks_for_balance_without_viscosity(self):
        """Of a bar that creeps: what viscosity carries on the way is no equilibrium."""
        coarse = MODEL.replace("[20, 2, 2]", "[2, 1, 1]")
        self.run_model("analysis: static", text=coarse)
        expected = self.rows("probes/end")[-1]
        self.run_model("analysis: {kind: relax, tolerance: 1e-6}\ndamping: {stiffness: 3e-3}", text=coarse)
        np.testing.assert_allclose(self.rows("probes/end")[-1], expected, rtol=1e-5, atol=1e-12)

    def test_refusals(self):
        for more, expected in (
            ("analysis: statics", "model.yaml:8: analysis is statics, did you mean 'static'? expected one of: static, relax, modes"),
            ("analysis: {kind: static, load_step: 3}", "did you mean 'load_steps'?"),
            ("analysis: {kind: static, load_steps: 0}", "model.yaml:8: analysis.load_steps is 0, expected a whole number from 1"),
            ("analysis: {kind: static, preconditioner: multigrid}", "expected one of: auto, sparse, tensor, nodes"),
            ("analysis: {kind: relax, steps: 5}", "after 5 steps, expected 1.0e-06"),
            ("analysis: {kind: static, save: model.yaml}", "save is model.yaml, from which the model is read"),
            ("analysis: static\nstate: none.h5", "none.h5: cannot read this file"),
            ("analysis: {kind: modes, mass: full}", "expected one of: lumped, consistent"),
            ("analysis: static", "model.yaml: the load of model.yaml:6 is not finite at time 1, expected numbers"),
            ("analysis: relax", "model.yaml: the load of model.yaml:6 is not finite at time 1, expected numbers"),
        ):
            with self.subTest(more):
                text = MODEL.replace("[1e6, 0, 0]", "[1/(t-1), 0, 0]") if "finite" in expected else MODEL
                self.assertIn(expected, self.run_model(more, text=text, code=1))
        free = MODEL.replace("boundary: [{{name: wall, fix: [x, y, z], faces: [xi-]}}, ", "boundary: [")
        for kind in ("static", "relax"):
            told = self.run_model(f"analysis: {kind}", text=free, code=1)
            self.assertIn(f"{kind}: the supports leave the body free in 1 of its 6 rigid motions", told)
        standing = free.replace("boundary: [", "boundary: [{{spring: {{stiffness: 1e5, direction: [0, 0, 1]}}, faces: [zeta-]}}, ")
        for kind in ("static", "relax"):
            told = self.run_model(f"analysis: {kind}", text=standing, code=1)
            self.assertIn(f"{kind}: the supports and springs leave the body free in 1 of its 6", told)
        self.assertIn("runs on one rank", self.run_model("analysis: static", ranks=2, code=1))

    def test_what_output_has_written_is_no_state(self):
        for analysis in ("static", "modes"):
            self.run_model(f"analysis: {analysis}")
            (self.folder / "out.h5").rename(self.folder / "written.h5")
            told = self.run_model("analysis: static\nstate: written.h5", code=1)
            self.assertIn("written.h5: /: attribute 'format' is missing, as in the histories and frequencies that 'output' writes", told)
            self.assertIn("expected a state that 'save' of an analysis or a run has written", told)

    def test_a_state_of_another_mesh_is_refused(self):
        self.run_model("analysis: {kind: static, save: rest.h5}")
        finer = MODEL.replace("[20, 2, 2]", "[21, 2, 2]").replace("file: out, fields: [displacement, stress]", "file: out, every: 1")
        self.assertIn("mesh and geometry are others", self.run_model("state: rest.h5\ntime: {end: 1e-5}", text=finer, code=1))


if __name__ == "__main__":
    unittest.main()

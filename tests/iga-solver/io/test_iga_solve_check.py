# SPDX-License-Identifier: GPL-2.0-or-later
"""iga-solve --check tells what a run would be and what looks like a slip."""

import re
import subprocess
import unittest

from test_iga_solve_sessions import PLATE, PROGRAM, Sessions

# elements 0.025 wide
TWO_BOXES = """units: si
geometry:
  shapes:
    - box: {origin: [0, 0, 0], size: [0.1, 0.1, 0.1], elements: [4, 4, 4], degree: 2}
    - box: {origin: [GAP, 0, 0], size: [0.1, 0.1, 0.1], elements: [4, 4, 4], degree: 2}
material: {law: linear_elastic, youngs_modulus: 7.4e10, poissons_ratio: 0.23, density: 2480}
boundary: [{fix: [x, y, z], faces: [xi-], patch: 0}]
loads: {gravity: [0, 0, -9.81]}
time: {end: 1e-6}
"""


class Check(Sessions):
    def test_runs_nothing(self):
        printed = self.solve(PLATE.replace("LAW", "neo_hooke"), "--check")
        for pattern in (
            r"elements     1156 \(34 x 34 x 1\)", "patches      1, 3888 control points, 3888 nodes", r"dof          11664, \d+ of",
            "mass         0.0142848", "stable step", r"time step    \S+, \d+ steps", "run time     less than 1 s", r"memory       \S+ [MG]B",
            "output       11 rows of histories, 5 states of fields at 1 places", "material     neo_hooke, E 7.4e[+]10",
            "support      clamp: fixed at", "loads        1 tractions",
        ):  # fmt: skip
            self.assertRegex(printed, pattern)
        self.assertNotIn("WARNING", printed)
        self.assertEqual(sorted(path.name for path in self.folder.glob("*")), ["plate.yaml"])

    def test_plates_whose_shear_is_corrected_are_told(self):
        plate = PLATE.replace("LAW", "linear_elastic").replace("damping: {", "damping: {stiffness: 1e-9, ")
        corrected = self.solve(plate + "integration: {shear: corrected}\n", "--check")
        self.assertRegex(corrected, "material     .*linear_elastic, shear corrected")
        self.assertNotIn("shear", self.solve(plate + "integration: {shear: plain}\n", "--check"))

    def test_is_the_same_on_ranks(self):
        def lines(text):
            return [line for line in text.splitlines() if not re.search("memory|run time", line)]
        plate = PLATE.replace("LAW", "linear_elastic")
        self.assertEqual(lines(self.solve(plate, "--check", ranks=3)), lines(self.solve(plate, "--check")))

    def test_the_stable_step_that_is_told_can_be_asked_for(self):
        for elements in range(3, 8):
            plate = PLATE.replace("LAW", "linear_elastic").replace("[34, 34, 1]", f"[{elements}, 2, 2]")
            told = re.search(r"stable step +([^\s,]+)", self.solve(plate, "--check"))[1]
            self.assertIn("time step", self.solve(plate, "--check", "--step", told))
            self.assertIn(f"is above the stable step {told}", self.solve(plate, "--check", "--step", f"{1.0001 * float(told)!r}", code=1))

    def test_slips(self):
        plate = PLATE.replace("LAW", "linear_elastic")
        bare = re.sub("(?m)^(loads|initial|damping|boundary|  - ).*\n", "", plate)
        thin = plate.replace("0.004], elements: [34, 34, 1]", "0.00004], elements: [34, 34, 1]")
        static = re.sub("(?m)^time:.*", "analysis: static", plate)
        for text, expected in (
            (bare, "nothing moves it"),
            (bare + "loads: {gravity: [0, 0, -9.81]}\n", "free in 6 of its 6 rigid motions: loads carry it away"),
            (
                bare + "boundary: [{spring: {stiffness: 1, direction: [0, 0, 1]}, faces: [zeta-]}]\nloads: {gravity: [0, 0, -9.81]}\n",
                "free in 3 of its 6 rigid motions",
            ),
            (thin, "patch 0 has elements 29 times as long as they are thin"),
            (plate.replace("every: 4e-7", "every: 1"), "output.every is 1, after the end 4e-06"),
            (re.sub("(?m)^output:.*\n", "", plate), "'probes' is not used"),
            (static, "'initial' is not used"),
            (static.replace("static", "relax"), "'initial' is not used"),
            (static.replace("mass: 1e4", "stiffness: 1e-9"), "'damping.stiffness' is not used: an 'analysis' has no motion in time"),
            (static + "integration: {mass: corrected}\n", "'integration.mass' is not used"),
            (static.replace("static", "modes") + "integration: {mass: corrected}\n", "'integration.mass' is not used"),
            (re.sub("(?m)^  - .*\n", "", static).replace("boundary:\n", ""), "no equilibrium"),
        ):
            with self.subTest(expected):
                self.assertRegex(self.solve(text, "--check"), f"(?m)^WARNING: plate.yaml: .*{expected}")

    def test_patches_that_a_gap_keeps_apart(self):
        def told(gap: float, *words: str, more: str = "") -> tuple:
            (self.folder / "two.yaml").write_text(TWO_BOXES.replace("GAP", repr(0.1 + gap)) + more)
            command = [PROGRAM, "two.yaml", *words]
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60, check=True)
            pieces = re.search("(?m)^  patches .*nodes(.*)", done.stdout)
            return pieces and pieces[1], [line for line in (done.stdout + done.stderr).splitlines() if "falls into" in line]

        for gap, shown in ((1e-7, "is 1e-07 from"), (1e-3, "is 0.001 from"), (-1e-3, "touches")):
            for words in (("--check",), ()):
                pieces, (warning,) = told(gap, *words)
                self.assertRegex(warning, f"^WARNING: two.yaml: the body falls into 2 pieces: face '. [a-z]+.' {shown} face '. xi.'")
        self.assertEqual(told(0.0, "--check"), ("", []))
        for gap in (5e-3, 10.0):
            self.assertEqual(told(gap, "--check"), (", 2 pieces that are not welded to each other", []))
        self.assertEqual(told(0.0, "--check", more="weld: no\n")[1], [])

    def test_cracks_and_hinges(self):
        def told(shapes: str, more: str = "") -> list:
            text = re.sub("(?m)^    - box.*\n", "", TWO_BOXES).replace("shapes:\n", f"shapes: [{shapes}]\n")
            (self.folder / "two.yaml").write_text(text + more)
            done = subprocess.run([PROGRAM, "two.yaml", "--check"], cwd=self.folder, capture_output=True, text=True, timeout=60, check=True)
            return re.findall("(?m)^WARNING: two.yaml: (?:the body|patches) (has a crack: .*|.* share .*)", done.stdout + done.stderr)

        def box(x: float, y: float, width: float) -> str:
            return f"{{box: {{origin: [{x}, {y}, 0], size: [1, {width}, 1], elements: [4, 4, 4], degree: 2}}}}"

        def tube(begin: float, end: float) -> str:
            return f"{{tube: {{origin: [0, 0, 0], axis: [0, 0, 1], inner_radius: 0.999, outer_radius: 1, length: 0.2, " \
                   f"angle: [{begin}, {end}], elements: [8, 1, 2]}}}}"

        def expect(shapes: str, *patterns: str) -> None:
            warnings = told(shapes)
            self.assertEqual(len(warnings), len(patterns), warnings)
            for warning, pattern in zip(warnings, patterns):
                self.assertRegex(warning, pattern)
            self.assertEqual(told(shapes, "weld: no\n"), [])

        hinge, crack = "0 and 1 share an edge [(]6 nodes[)], but no face there: nothing keeps", "has a crack: face '. xi.' {} face '. xi.'"
        expect(f"{box(0, 0, 1)}, {box(1, 0, 0.5)}", crack.format("touches"), hinge)
        expect(f"{box(0, 0, 1)}, {box(1, 1, 1)}", hinge)
        expect(f"{box(0, 0, 1)}, {box(1, 0, 1)}, {box(0, 1, 1)}")  # 1 and 2 share an edge, and 0 is around it
        expect(f"{tube(0, 180)}, {tube(180, 360)}")
        for tubes in (tube(0, 359.999), f"{tube(0, 180)}, {tube(180, 359.999)}"):
            expect(tubes, crack.format("is 1.74e-05 from"))

    def test_faces_inside_the_body(self):
        def told(text: str, *words: str) -> list:
            (self.folder / "two.yaml").write_text(text)
            command = [PROGRAM, "two.yaml", *words]
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60, check=True)
            return [line for line in (done.stdout + done.stderr).splitlines() if "inside" in line]

        loads = "loads: {tractions: [{face: zeta+, patch: 1, value: [0, 0, 1]}, {face: xi-, patch: 1, value: [0, 0, 1]}], " \
                "pressures: [{face: xi+, patch: 0, value: 1}]}"
        two = TWO_BOXES.replace("GAP", "0.1").replace("loads: {gravity: [0, 0, -9.81]}", loads)
        two = two.replace("patch: 0}]", "patch: 0}, {symmetry: xi+, patch: 0}, {symmetry: eta-, patch: 1}]")
        two += "surfaces: {top: [0 zeta+, 1 zeta+], middle: [0 zeta-, 1 xi-]}\n"
        zero, one = ("patch 0 xi+, which is inside the body: welded to patch 1 xi-",
                     "patch 1 xi-, which is inside the body: welded to patch 0 xi+")  # fmt: skip
        named = (("loads.tractions[1]", one), ("loads.pressures[0]", zero), ("boundary[1].symmetry", zero), ("surface 'middle'", one))
        expected = [f"WARNING: two.yaml: {what} is on {where}" for what, where in named]
        for words in ("--check",), (), ("--quiet",):
            self.assertEqual(told(two, *words), expected)
        self.assertEqual(told(two + "weld: no\n", "--check"), [])
        for angle, seam in (360, ["WARNING: two.yaml: surface 'side' is on patch 0 xi+, which is inside the body: welded to patch 0 xi-"]), (350, []):
            tube = f"{{origin: [0, 0, 0], axis: [0, 0, 1], inner_radius: 1, outer_radius: 2, length: 1, angle: [0, {angle}], elements: [4, 1, 1]}}"
            text = f"units: si\ngeometry: {{tube: {tube}}}\n{TWO_BOXES.splitlines()[5]}\nsurfaces: {{side: xi+, outside: zeta+}}\n"
            self.assertEqual(told(text, "--check", "--end", "1e-6"), seam)

    def test_a_piece_that_nothing_holds(self):
        (self.folder / "two.yaml").write_text(TWO_BOXES.replace("GAP", "1"))
        self.assertIn(
            "WARNING: two.yaml: 'boundary' leaves patch 1 and what is welded to it free in 6 of its 6 rigid motions: loads carry it away",
            subprocess.check_output([PROGRAM, "two.yaml", "--check"], cwd=self.folder, text=True, timeout=60),
        )
        for kind in ("static", "relax"):
            (self.folder / "two.yaml").write_text(TWO_BOXES.replace("GAP", "1").replace("time: {end: 1e-6}", f"analysis: {kind}"))
            done = subprocess.run([PROGRAM, "two.yaml"], cwd=self.folder, capture_output=True, text=True, timeout=10, check=False)
            self.assertIn(f"ERROR: two.yaml: {kind}: 'boundary' leaves patch 1 and what is welded to it free in 6 of its 6", done.stderr)

    def test_errors_are_those_of_a_run(self):
        plate = PLATE.replace("LAW", "linear_elastic")
        self.assertIn("above the stable step", self.solve(plate, "--check", "--step", "1", code=1))
        self.assertIn("did you mean 'boundary'", self.solve(plate.replace("boundary:", "bondary:"), "--check", code=1))


if __name__ == "__main__":
    unittest.main()

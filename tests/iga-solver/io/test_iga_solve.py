# SPDX-License-Identifier: GPL-2.0-or-later
"""iga-solve where something goes wrong: one line that starts with ERROR and says what and where, exit code 1, and nothing
lost.  Good runs are in check_iga_solve.sh."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

PROGRAM = os.environ["IGA_SOLVE"]
# A block of a law whose stable step gets shorter when it is stretched, held below.
BLOCK = """units: si
geometry:
  box: {origin: [0, 0, 0], size: [1, 1, 0.2], elements: [4, 4, 2], degree: 2}
material: {law: saint_venant_kirchhoff, youngs_modulus: 1e6, poissons_ratio: 0.3, density: 1000}
boundary: [{fix: [x, y, z], faces: [zeta-]}]
loads: {tractions: [{face: zeta+, value: [0, 0, -1e3]}]}
output: {every: 1e-3, file: block}
time: {end: 0.1}
"""


def changed(*replacements: tuple[str, str]) -> str:
    text = BLOCK
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new)
    return text


class IgaSolve(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_model(self, text: str, *words: str, name: str = "block.yaml") -> subprocess.CompletedProcess:
        (self.folder / name).write_text(text)
        return self.solve(name, *words)

    def solve(self, *words: str) -> subprocess.CompletedProcess:
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)

    def assert_error(self, done: subprocess.CompletedProcess, *patterns: str):
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith("ERROR: "), done.stderr)
        for pattern in patterns:
            self.assertRegex(lines[0], pattern)


class Divergence(IgaSolve):
    # The load is harmless, too much in tension, too much in compression: x 1, 10,000, 1,000.
    def test_a_diverged_run_says_when_and_where_and_why(self):
        self.assertEqual(self.run_model(BLOCK).returncode, 0)
        for load in ("1e7", "-1e6"):
            with self.subTest(load=load):
                done = self.run_model(changed(("-1e3", load)))
                self.assert_error(
                    done, r"block.yaml: step \d: the solid has blown up at time 0\.0\d+", "control node .*undeformed at",
                    "likely cause: .*loads.*time step", r"stable step was 0\.00\d+", "histories before it are in block.h5")
                self.assertNotIn("nan", done.stdout + done.stderr)

    def test_a_run_that_has_diverged_before_its_first_step_names_its_file(self):
        fast = changed(("[1, 1, 0.2]", "[1e10, 1e10, 1e10]"), ("density: 1000", "density: 1e100"),
                       ("loads: {tractions: [{face: zeta+, value: [0, 0, -1e3]}]}", "initial: {velocity: [1e100, 0, 0]}"))
        self.assert_error(self.run_model(fast), "block.yaml: the solid has blown up at time 0: its kinetic energy is not finite")

    def test_too_many_steps(self):
        self.assert_error(self.run_model(BLOCK, "--step", "1e-99"), r"block.yaml: 1e\+98 steps of 1e-99 to time 0.1, expected")

    def test_histories_up_to_then_are_kept(self):
        # Tension that the block bears for some steps.
        done = self.run_model(changed(("-1e3", "3e5")))
        self.assert_error(done, "blown up")
        with h5py.File(self.folder / "block.h5") as file:
            self.assertGreater(len(file["time"]), 2)
            for name in ("time", "kinetic_energy", "strain_energy", "load_work", "linear_momentum", "largest_displacement"):
                self.assertEqual(len(file[name]), len(file["time"]), name)
                self.assertTrue(numpy.isfinite(file[name][()]).all(), name)


class ModalDamping(IgaSolve):
    def test_that_does_nothing_is_told(self):
        for more in ("damping: {modal: 0.1}\n", ""):
            for words in ([], ["--quiet"]):
                done = self.run_model(BLOCK + more, "--end", "0.001", *words)
                self.assertEqual(done.returncode, 0, done.stderr)
                told = "WARNING: block.yaml: 'damping.modal' is not used: it is of 'body modal N' in a deck\n"
                self.assertEqual(done.stderr, told if more else "")


class OwnInput(IgaSolve):
    def test_is_never_overwritten(self):
        self.run_model(BLOCK, "--end", "0.001")
        (self.folder / "block.h5").unlink()
        geometry = [Path(PROGRAM).with_name("nurbs-convert"), "box.yaml", "block.h5"]
        (self.folder / "box.yaml").write_text("\n".join(BLOCK.splitlines()[:3]) + "\n")
        subprocess.run(geometry, cwd=self.folder, check=True, capture_output=True)
        bytes_before = (self.folder / "block.h5").read_bytes()
        (self.folder / "link").symlink_to(self.folder)
        box = next(line for line in BLOCK.splitlines() if "box:" in line)
        for output in ("block", "./block", "link/block", str(self.folder / "block")):
            text = changed((box, "  file: block.h5"), ("file: block}", f"file: {output}}}"))
            done = self.run_model(text, name="model.yaml")
            self.assert_error(done, "model.yaml:7: output.file is .*block.h5 is the file .*block.h5 .* would be overwritten")
            self.assertEqual((self.folder / "block.h5").read_bytes(), bytes_before)
        # a model file that is named as its own output: no reader takes it for one
        done = self.run_model(BLOCK, name="block.h5")
        self.assert_error(done, "block.h5: is no HDF5 file, expected one by its name")
        self.assertEqual((self.folder / "block.h5").read_text(), BLOCK)

    def test_the_state_that_it_starts_from_is_not_overwritten_either(self):
        end = "time: {end: 0.1}"
        done = self.run_model(changed((end, "analysis: {kind: static, save: state.h5}"), ("file: block", "file: out")))
        self.assertEqual(done.returncode, 0, done.stderr)
        state = (self.folder / "state.h5").read_bytes()
        (self.folder / "link.h5").symlink_to("state.h5")
        (self.folder / "part.h5.part").write_bytes(state)
        for output, file in (("state", "state.h5"), ("link", "state.h5"), ("./state", "link.h5"), ("part", "part.h5.part")):
            for what in (end, "analysis: static", "analysis: modes", "analysis: relax", "check"):
                if what != end and output != "state":
                    continue
                with self.subTest(output=output, file=file, what=what):
                    key, words = (end, ["--check"]) if what == "check" else (what, [])
                    text = changed((end, f"state: {file}\n{key}"), ("file: block}", f"file: {output}}}"))
                    done = self.run_model(text, *words, name="model.yaml")
                    done.stderr = re.sub("(?m)^WARNING: .* is not used: .*\n", "", done.stderr)  # by that analysis
                    told = f"model.yaml:7: output.file is .*{output}: .*{output}.h5.* is the file {file} .* would be overwritten"
                    self.assert_error(done, told)
                    self.assertEqual((self.folder / "state.h5").read_bytes(), state)
            (self.folder / "state.h5").write_bytes(state)

    def test_save_is_none_of_the_outputs(self):
        (self.folder / "link").symlink_to(self.folder)
        (self.folder / "later.h5").symlink_to("block.h5")
        fields = ("file: block}", "file: block, fields: {of: [displacement], every: 1e-3, on: [volume, skin]}}")
        for name in ("block.h5", "./block.h5", "link/block.h5", str(self.folder / "block.h5"), "later.h5", "block.h5.part",
                     "block_volume.pvd", "block_skin.pvd", "block_skin_12.vtu"):  # fmt: skip
            for span in (f"time: {{end: 0.1, save: {name}}}", f"analysis: {{kind: static, save: {name}}}"):
                with self.subTest(span):
                    done = self.run_model(changed(fields, ("time: {end: 0.1}", span)), "--check", name="model.yaml")
                    self.assert_error(done, "model.yaml:8: save is .*, which 'output' writes, expected another file")
        other = changed(fields, ("time: {end: 0.1}", "time: {end: 0.002, save: block_state.h5}"))
        self.assertEqual(self.run_model(other).returncode, 0)
        self.assertTrue((self.folder / "block.h5").exists() and (self.folder / "block_state.h5").exists())

    def test_save_that_cannot_be_written_is_refused_at_the_start(self):
        (self.folder / "folder.h5").mkdir()
        for name, why in (("none/state.h5", "there is no folder 'none'"), ("folder.h5", "Is a directory"),
                          ("/proc/state.h5", ".*")):  # fmt: skip
            for span in (f"time: {{end: 0.01, save: {name}}}", f"analysis: {{kind: static, save: {name}}}",
                         f"analysis: {{kind: relax, save: {name}}}"):  # fmt: skip
                for words in ([], ["--check"]):
                    with self.subTest(span=span, words=words):
                        done = self.run_model(changed(("time: {end: 0.1}", span)), *words, name="model.yaml")
                        self.assert_error(done, f"{name}: cannot write here: {why}")
                        self.assertNotIn("mass", done.stdout)  # refused before anything is done
        self.assertEqual(self.run_model(changed(("0.1}", "0.1, save: state.h5}")), "--check", name="model.yaml").returncode, 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["folder.h5", "model.yaml"])

    def test_of_another_kind_says_how_it_is_taken(self):
        (self.folder / "box.yaml").write_text("\n".join(BLOCK.splitlines()[:3]) + "\n")
        convert = [Path(PROGRAM).with_name("nurbs-convert"), "box.yaml", "box.h5"]
        subprocess.run(convert, cwd=self.folder, check=True, capture_output=True)
        self.assert_error(self.solve("box.h5"), "box.h5: is an HDF5 file, expected text: .*'geometry: {file: NAME}'")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""iga-solve as it is worked with: --quiet and --verbose, progress on a terminal, and a run that was interrupted and is continued, on any
number of ranks, beside the one that was not."""

import os
import pty
import re
import subprocess
import tempfile
import termios
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

PROGRAM = os.environ["IGA_SOLVE"]
MPIEXEC = os.environ["MPIEXEC"]
# 2 x 2 boxes, held, moved, loaded in time, damped
PLATE = """units: si
geometry: {box: {origin: [0, 0, 0], size: [0.04, 0.036, 0.004], elements: [34, 34, 1], degree: 2}}
material: {law: LAW, youngs_modulus: 7.4e10, poissons_ratio: 0.23, density: 2480}
boundary:
  - {name: clamp, fix: [x, y, z], faces: [xi-]}
  - {name: shaker, move: {z: 1e-6}, faces: [xi+], time: {sine: {frequency: 1e5}}}
probes: {middle: {face: zeta+, at: [0.5, 0.47]}}
output: {every: 4e-7, file: plate, fields: {of: [velocity], every: 1e-6, on: [zeta+]}}
surfaces: {zeta+: zeta+}
loads: {tractions: [{face: zeta+, value: [0, 0, "-1e8*sin(1e6*t)"]}]}
damping: {mass: 1e4}
initial: {velocity: [1, 0, -10]}
time: {end: 4e-6, save: saved.h5, save_every: 1.5e-6}
"""


class Sessions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def solve(self, text: str, *words: str, ranks: int = 1, code: int = 0) -> str:
        (self.folder / "plate.yaml").write_text(text)
        launcher = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
        done = subprocess.run(
            [*launcher, PROGRAM, "plate.yaml", *words], cwd=self.folder, capture_output=True, text=True, timeout=60, check=False
        )
        self.assertEqual(done.returncode != 0, code != 0, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr

    def written(self) -> dict:
        series = {}
        with h5py.File(self.folder / "plate.h5") as file:
            file.visititems(lambda name, item: series.__setitem__(name, item[...]) if hasattr(item, "shape") else None)
        for path in sorted(self.folder.glob("plate_zeta+*")):
            series[path.name] = np.frombuffer(path.read_bytes(), dtype=np.uint8)
        return series


class Continued(Sessions):
    def check(self, law: str, before: int, after: int, damping: str = "{mass: 1e4}") -> None:
        """From the middle, while histories and fields have gone on to the end: what came after that is dropped, and anew."""
        plate = PLATE.replace("LAW", law).replace("{mass: 1e4}", damping)
        self.solve(plate, ranks=before)
        whole, state = self.written(), self.folder / "saved.h5"
        self.assertEqual(len(whole["time"]), 11)
        self.assertGreater(np.abs(whole["ledger/damped"][-1]), 0)
        with h5py.File(state) as file:
            self.assertAlmostEqual(file["state/time"][0], 4e-6)
            step = file["state/time_step"][0]
        middle = f"end: {round(3e-6 / step) * step!r}, step: {step!r}"
        self.solve(plate.replace("end: 4e-6", middle), "--quiet", ranks=before)
        saved = state.read_bytes()
        self.solve(plate, "--quiet")
        state.write_bytes(saved)
        self.assertRegex(self.solve(plate, "--continue", ranks=after), "continues    from time [23].")
        again = self.written()
        self.assertEqual(set(again), set(whole))
        for name, values in whole.items():
            self.assertTrue(np.array_equal(again[name], values), f"{name}, to the last bit")

    def test_on_more_ranks(self):
        self.check("saint_venant_kirchhoff", 1, 3)

    def test_on_fewer_ranks(self):
        self.check("neo_hooke", 2, 1)

    def test_a_law_with_memory(self):
        self.check("linear_elastic", 1, 2, "{mass: 1e4, stiffness: 1e-9}")

    def test_farther_than_planned(self):
        plate = PLATE.replace("LAW", "linear_elastic") + "integration: {mass: corrected}\n"
        step = ("--step", "3e-8")  # 6e-6/200 is more, by round-off
        self.solve(plate, *step, "--end", "6e-6", ranks=2)
        whole = self.written()
        np.testing.assert_allclose(whole["time"], 4e-7 * np.arange(16), atol=8e-8)
        self.solve(plate, *step, "--end", "3e-6")
        self.solve(plate, *step, "--continue", "--end", "6e-6")
        self.assertEqual([name for name, values in self.written().items() if not np.array_equal(whole[name], values)], [])

    def test_after_less_than_a_step_steps_are_those_of_a_new_run(self):
        def step(*words: str) -> float:
            return float(re.search(r"time step +(\S+),", self.solve(PLATE.replace("LAW", "linear_elastic"), *words))[1])

        new = step("--end", "4e-6")
        self.assertEqual(step("--end", "1e-12"), 1e-12)
        self.assertAlmostEqual(step("--continue", "--end", "4e-6"), new, delta=1e-5 * new)
        self.assertAlmostEqual(step("--continue", "--end", "4.01e-6"), 1e-8, delta=1e-12)  # no room for more
        self.assertGreater(step("--continue", "--end", "8e-6"), 0.9 * new)
        self.assertEqual(step("--step", "1e-8", "--end", "1e-8"), 1e-8)  # asked for, and whole
        self.assertEqual(step("--continue", "--end", "1e-7"), 1e-8)

    def test_a_changed_model_is_told(self):
        plate = PLATE.replace("LAW", "linear_elastic").replace("end: 4e-6", "end: 1.5e-6")
        self.solve(plate)
        state = self.folder / "saved.h5"
        saved = state.read_bytes()
        longer = plate.replace("end: 1.5e-6", "end: 2e-6")
        alike = longer.replace("7.4e10", "74.0e9").replace("every: 4e-7", "every: 5e-7")
        changes = (
            ("", "", ""),
            ("material: linear_elastic, E = .* then, neo_hooke, E = .* now", "linear_elastic", "neo_hooke"),
            ("material: linear_elastic, E = 7.*, nu = 0.23 then, linear_elastic, E = 7.*, nu = 0.23 now", "74.0e9", "73.0e9"),
            (r"damping: \{mass: 10000\S* then, \{mass: 20000\S* now", "mass: 1e4", "mass: 2e4"),
            (r"boundary: .*fix: \[x, y, z\].* then, .*fix: \[z\].* now", "fix: [x, y, z]", "fix: [z]"),
            ("loads.tractions: .*-1e8.* then, .*-2e8.* now", "-1e8", "-2e8"),
            (r"loads.gravity: none then, \[0\S*, 0\S*, -9.81\] now", "loads: {", "loads: {gravity: [0, 0, -9.81], "),
            ("integration: none then, {quadrature: full} now", "units: si", "units: si\nintegration: {quadrature: full}"),
        )
        for expected, old, new in changes:
            with self.subTest(expected):
                state.write_bytes(saved)
                warnings = self.warnings_of_continuing(alike.replace(old, new))
                self.assertEqual(len(warnings), 1 if expected else 0, warnings)
                if expected:
                    self.assertRegex(warnings[0], f"^WARNING: plate.yaml: goes on from saved.h5, saved with another model: {expected}$")
        state.write_bytes(saved)
        denser = longer.replace("density: 2480", "density: 2500")
        self.assertIn("another density: density: 2480 then, 2500 now", self.solve(denser, "--continue", code=1))

    def test_viscosity_comes_and_goes(self):
        """What it has taken is kept, and nothing is taken for the strain that there is by then."""
        plate = PLATE.replace("LAW", "linear_elastic").replace("every: 4e-7", "every: 1e-7").replace("mass: 1e4", "mass: 1")
        viscous = plate.replace("{mass: 1}", "{mass: 1, stiffness: 1e-8}")
        rate = self.rate_of_damping(viscous, viscous)
        for then, now in ((plate, viscous), (viscous, plate)):
            self.assertLess(self.rate_of_damping(then, now), 2 * rate)

    def rate_of_damping(self, then: str, now: str) -> float:
        """The most that is taken from row to row, which is never given back; the books are balanced."""
        self.solve(then, "--end", "2e-6")
        told = self.solve(now, "--continue", ranks=2)
        self.assertIn("continues", told)
        seen = self.written()
        self.assertGreater(len(seen["time"]), 20)
        total = sum(seen[name] for name in ("kinetic_energy", "ledger/internal", "ledger/damped"))
        total = total - seen["ledger/loads"] - seen["ledger/supports"]
        np.testing.assert_allclose(total, total[0], rtol=0, atol=1e-11 * np.abs(seen["kinetic_energy"]).max())
        taken = np.diff(seen["ledger/damped"])
        self.assertGreaterEqual(taken.min(), 0)
        self.assertLess(np.abs(np.diff(seen["ledger/truncation"])).max(), 0.2 * seen["ledger/damped"][-1])
        return taken.max()

    def test_states_of_before_settings_were_kept(self):
        plate = PLATE.replace("LAW", "linear_elastic").replace("end: 4e-6", "end: 1.5e-6")
        self.solve(plate)
        (self.folder / "saved.h5").rename(self.folder / "new.h5")
        with h5py.File(self.folder / "new.h5") as new, h5py.File(self.folder / "saved.h5", "w") as old:
            for name, value in new.attrs.items():
                old.attrs[name] = np.bytes_(value) if isinstance(value, str) else value
            new.copy("state", old)
            del old["state/settings"]
        self.assertEqual(self.warnings_of_continuing(plate.replace("end: 1.5e-6", "end: 2e-6").replace("7.4e10", "7e10")), [])

    def warnings_of_continuing(self, text: str) -> list:
        (self.folder / "plate.yaml").write_text(text)
        done = subprocess.run(
            [PROGRAM, "plate.yaml", "--continue"], cwd=self.folder, capture_output=True, text=True, timeout=60, check=True
        )
        return done.stderr.splitlines()

    def test_a_check_tells_what_the_run_would_be(self):
        plate = PLATE.replace("LAW", "linear_elastic")
        self.solve(plate.replace("end: 4e-6", "end: 2.1e-6"))
        before = {path: path.read_bytes() for path in self.folder.iterdir() if path.name != "plate.yaml"}
        for words, ranks in ((), 1), ((), 2), (("--end", "9e-6"), 1):
            told = self.solve(plate, "--check", "--continue", *words, ranks=ranks)
            self.assertRegex(told, r"continues    from time 2.1e-06 \(saved.h5\)")
            steps = re.search(r"time step .*, (\d+) steps", told)[0]
            rows, fields = map(int, re.search(r"output +(\d+) more rows of histories, (\d+) states of fields at 1 places", told).groups())
            self.assertEqual({path: path.read_bytes() for path in before}, before)
            times = self.written()["time"]
            states = len(list(self.folder.glob("plate_zeta+*.vtu")))
            self.assertIn(steps, self.solve(plate, "--continue", *words))
            self.assertEqual(len(self.written()["time"]), len(times) + rows)
            self.assertEqual(len(list(self.folder.glob("plate_zeta+*.vtu"))), states + fields)
            for path in self.folder.glob("plate_zeta+*"):
                path.unlink()
            for path, content in before.items():
                path.write_bytes(content)

    def test_refusals(self):
        for check in ((), ("--check",)):
            with self.subTest(check=check):
                self.expect_refusals(*check)

    def expect_refusals(self, *check: str) -> None:
        def told(text: str, *words: str) -> str:
            return self.solve(text, "--continue", *check, *words, code=1)

        plate = PLATE.replace("LAW", "linear_elastic")
        (self.folder / "saved.h5").unlink(missing_ok=True)
        self.assertIn("saved.h5: cannot read", told(plate))
        self.assertIn("expected a later end", self.solve(plate, "--quiet") + told(plate))
        self.assertIn("another density: density: 2480 then, 2500 now", told(plate.replace("density: 2480", "density: 2500")))
        finer = plate.replace("[34, 34, 1]", "[35, 34, 1]")
        self.assertIn("saved.h5: is a state of", told(finer, "--end", "1"))
        never = plate.replace(", save: saved.h5, save_every: 1.5e-6", "")
        self.assertIn("time: {save: FILE}", told(never))
        self.assertIn("save_every is given without", self.solve(plate.replace(" save: saved.h5,", ""), code=1))
        self.assertIn("save is plate.yaml", self.solve(plate.replace("saved.h5", "plate.yaml"), code=1))


class Together(Sessions):
    """Two runs that write to one name: the second was the one whose history was left, and both said that all was well."""

    PLATE = PLATE.replace("LAW", "linear_elastic")

    def start(self) -> subprocess.Popen:
        """A run that does not end, nor save."""
        (self.folder / "plate.yaml").write_text(self.PLATE.replace(", save: saved.h5, save_every: 1.5e-6", ""))
        words = [PROGRAM, "plate.yaml", "--end", "1"]
        run = subprocess.Popen(words, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.communicate)
        self.addCleanup(run.kill)
        return run

    def wait(self, condition) -> None:
        deadline = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def test_the_second_run_is_refused_until_the_first_is_gone(self):
        self.solve(self.PLATE.replace("end: 4e-6", "end: 4e-7"))
        file = self.folder / "plate.h5"
        older = file.stat().st_ino
        first = self.start()
        self.wait(lambda: file.stat().st_ino != older)
        same = file.stat().st_ino
        for words, ranks in (((), 1), ((), 2), (("--continue",), 1), (("--check",), 1)):
            told = self.solve(self.PLATE, *words, ranks=ranks, code=1)
            self.assertRegex(told, r"(?m)^ERROR: plate.yaml:\d+: output.file is plate: plate.h5 is being written by another solid or run")
            self.assertEqual(told.count("ERROR"), 1)
        self.assertEqual((file.stat().st_ino, first.poll()), (same, None))
        first.kill()
        first.wait()
        self.solve(self.PLATE)

    def test_of_several_at_once_one_goes_on(self):
        runs = [self.start() for _ in range(4)]
        self.wait(lambda: sum(run.poll() is None for run in runs) == 1)
        self.assertEqual({run.returncode for run in runs}, {1, None})
        (last,) = [run for run in runs if run.returncode is None]
        self.wait((self.folder / "plate.h5").exists)
        self.assertIsNone(last.poll())
        last.kill()
        last.wait()
        self.assertEqual(self.written()["time"][0], 0)

    def test_locks_of_hdf5_are_not_in_the_way(self):
        self.addCleanup(os.environ.pop, "HDF5_USE_FILE_LOCKING", None)
        for setting in ("TRUE", "BEST_EFFORT", "FALSE"):
            os.environ["HDF5_USE_FILE_LOCKING"] = setting
            self.solve(self.PLATE)

    def test_who_reads_an_older_file_is_not_in_the_way(self):
        self.solve(self.PLATE)
        with h5py.File(self.folder / "plate.h5"):
            self.solve(self.PLATE)


class Words(Sessions):
    def test_verbose_prints_energies_on_the_way(self):
        plate = PLATE.replace("LAW", "linear_elastic")
        usual, more = self.solve(plate), self.solve(plate, "--verbose")
        self.assertEqual(usual.count("energies at time"), 1)
        self.assertGreater(more.count("energies at time"), 10)
        self.assertIn("support      clamp: fixed", more)
        self.assertEqual(self.solve(plate, "--quiet"), "")
        self.assertIn("excludes", self.solve(plate, "--quiet", "--verbose", code=1))

    def test_progress_on_a_terminal(self):
        (self.folder / "plate.yaml").write_text(PLATE.replace("LAW", "linear_elastic"))
        ours, theirs = pty.openpty()
        termios.tcsetwinsize(theirs, (24, 80))
        with subprocess.Popen([PROGRAM, "plate.yaml"], cwd=self.folder, stdout=theirs, stderr=theirs) as run:
            os.close(theirs)
            text = b""
            try:
                while piece := os.read(ours, 4096):
                    text += piece
            except OSError:  # the end of a terminal
                pass
            self.assertEqual(run.wait(timeout=60), 0)
        os.close(ours)
        steps = re.search(r"(\d+) steps", text.decode())[1]
        self.assertRegex(text.decode(), rf"\r  step {steps} of {steps}, time 4e-06, .* in all")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""`structure FILE body modal N`: balls on modal bodies beside the same solids with all their degrees of freedom, and beside closed
forms: Timoshenko's beam, on which a ball bounces several times, and Zener's plate, from which waves run away."""

import re
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import ball_on_block as bob
import decks
import timoshenko
from prelude import INTEGRATION, Prelude, create

STEEL = (210e9, 0.3, 7850.0)  # E [Pa], nu, rho [kg/m^3]
LENGTH, SIDE, BALL, SPEED = 0.1535, 0.01, 0.02, 0.01  # of the beam, radius and speed of the ball [m, m/s]
BEAM = f"""units: si
geometry: {{box: {{origin: [{-LENGTH / 2}, {-SIDE / 2}, {-SIDE}], size: [{LENGTH}, {SIDE}, {SIDE}], elements: [32, 2, 2], degree: 2}}}}
material: {{law: linear_elastic, youngs_modulus: {STEEL[0]}, poissons_ratio: {STEEL[1]}, density: {STEEL[2]}}}
boundary: [{{name: ends, fix: [y, z], faces: [xi-, xi+]}}]
surfaces: {{top: zeta+}}
probes: {{middle: {{face: zeta+, at: [0.5, 0.5]}}}}
"""
END = 1.6e-3
# Z3: a steel ball of 1.5 mm on 1 mm of glass, 1 m/s; Zener's restitution and peak force [N]; of the plate a quarter, ball and force, too
GLASS, HARD_BALL, ZENER = (74.6e9, 0.2285, 2480.0), (210.6e9, 0.286, 7850.0), (0.25713, 16.17165)
PLATE = f"""units: si
geometry: {{box: {{origin: [0, 0, -1e-3], size: [30e-3, 30e-3, 1e-3], elements: [20, 20, 1], degree: 2}}}}
material: {{law: linear_elastic, youngs_modulus: {GLASS[0]}, poissons_ratio: {GLASS[1]}, density: {GLASS[2]}}}
boundary: [{{symmetry: xi-}}, {{symmetry: eta-}}]
surfaces: {{top: zeta+}}
"""


def contacts(t: np.ndarray, force: np.ndarray) -> list[tuple[float, float, float]]:
    """Begin, end and peak force of each."""
    on = np.concatenate([[False], force > 1e-9, [False]])
    begins, ends = np.flatnonzero(~on[:-1] & on[1:]), np.flatnonzero(on[:-1] & ~on[1:])
    return [(t[b], t[min(e, len(t) - 1)], force[b:e].max()) for b, e in zip(begins, ends)]


def on_beam(words: str, step: float) -> dict[str, np.ndarray]:
    models = "model hertz tangential no_history"
    E, nu, rho = STEEL
    deck = (
        Prelude("-0.1 0.1 -0.05 0.05 -0.05 0.1", E=(E, E), nu=(nu, nu), models=models, timestep=step, particles="hard", skin=1e-3).text()
        + create((0.0, 0.0, BALL)) + f"set group all diameter {2 * BALL} density {rho}\nvelocity all set 0 0 {-SPEED}\n" + INTEGRATION
        + bob.wall(models, f"structure beam.yaml {words} surface top") + bob.output((3, 15, 16, 20, 22, 24, 28)) + f"run {round(END / step)}\n"
    )  # fmt: skip
    run = decks.good(deck, files={"beam.yaml": BEAM})
    assert "too short for the modes" not in run.text
    table = run.table
    return table | {"t": step * table["Step"], "force": -table["plate3"]}


class Timoshenko(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        E, nu, rho = STEEL
        K, mass = 4 / 3 * E / (2 * (1 - nu**2)) * BALL**0.5, rho * 4 / 3 * np.pi * BALL**3
        omega, mobility = timoshenko.modes(E, nu, rho, LENGTH, SIDE, 200)
        cls.closed = timoshenko.impact(omega, mobility, mass, K, SPEED, 2e-7, round(END / 2e-7)).T
        cls.solid = on_beam("", 2e-7)
        cls.modal = on_beam("body modal 40", 2e-6)

    def assert_same_contacts(self, found, expected, tolerance: float):
        self.assertEqual(len(found), 4)
        self.assertEqual(len(expected), 4)
        for (begin, end, force), (begin0, end0, force0) in list(zip(found, expected))[:3]:
            np.testing.assert_allclose((begin, end), (begin0, end0), rtol=0, atol=5e-6)
            self.assertLess(abs(force / force0 - 1), tolerance)
        self.assertLess(abs(found[3][2] / expected[3][2] - 1), 0.15, "the last is what the first three have left")

    def test_four_contacts_as_in_closed_form(self):
        self.assert_same_contacts(contacts(self.modal["t"], self.modal["force"]), contacts(*self.closed[:2]), 0.015)
        self.assertLess(abs(self.modal["vz"][-1] / -self.closed[2, -1] - 1), 0.015)

    def test_four_contacts_as_on_the_whole_solid(self):
        solid = contacts(self.solid["t"], self.solid["force"])
        self.assert_same_contacts(contacts(self.modal["t"], self.modal["force"]), solid, 0.01)
        at = np.searchsorted(self.solid["t"], self.modal["t"] - 1e-9)
        for name, tolerance in (("plate20", 0.01), ("plate16", 0.02), ("plate22", 0.01), ("plate28", 0.06)):
            scale = abs(self.solid[name]).max()
            self.assertLess(np.sqrt(np.mean((self.modal[name] - self.solid[name][at]) ** 2)), tolerance * scale, name)

    def test_nothing_is_lost(self):
        """What the contacts did is in the modes; and the ball has the rest, but for the error of the step."""
        inside = self.modal["plate15"] + self.modal["plate16"]
        np.testing.assert_allclose(inside, self.modal["plate22"], rtol=0, atol=1e-11 * inside.max())
        apart = self.modal["force"] == 0
        total = (self.modal["KinEng"] + inside)[apart]
        np.testing.assert_allclose(total, total[0], rtol=2e-5)


class Zener(unittest.TestCase):
    def test_a_ball_on_a_thin_plate(self):
        """With modes up to four periods in the contact; the whole solid of this mesh, which also has a dent at its corner, is softer."""
        models = "model penalty/hertz tangential no_history"

        def hit(words: str, step: float) -> tuple[float, float, list[str]]:
            start = Prelude("-0.01 0.04 -0.01 0.04 -0.01 0.01", E=(HARD_BALL[0], GLASS[0]), nu=(HARD_BALL[1], GLASS[1]), models=models,
                            timestep=step, particles="hard", skin=1e-3, further={"penaltyFactor": 0.25}).text()  # fmt: skip
            ball = create((0.0, 0.0, 1.5e-3)) + f"set group all diameter 3e-3 density {HARD_BALL[2] / 4}\nvelocity all set 0 0 -1\n"
            wall = bob.wall(models, f"structure plate.yaml {words} surface top")
            deck = start + ball + INTEGRATION + wall + bob.output((3,)) + f"run {round(2e-5 / step)}\n"
            run = decks.good(deck, files={"plate.yaml": PLATE})
            return run.table["vz"][-1], -4 * run.table["plate3"].min(), re.findall(r"lasts about (\S+) \(", run.text)

        (e, force, _), (e_solid, force_solid, _) = hit("body modal 110", 1e-7), hit("", 2e-8)
        _, _, (lasts,) = hit("body modal 30", 1e-7)
        self.assertLess(abs(float(lasts) / 12.7e-6 - 1), 0.15, "as it does on a plate that is too stiff")
        self.assertLess(abs(e - ZENER[0]), 0.03)
        self.assertLess(abs(force / ZENER[1] - 1), 0.03)
        self.assertLess(abs(e - e_solid), 0.06)
        self.assertGreater(force, force_solid)


class Screen(unittest.TestCase):
    """The deck of inputs/screen on a coarse mesh."""

    def run_screen(self, **variables: str) -> dict[str, np.ndarray]:
        screen = Path(__file__).resolve().parents[2] / "inputs" / "screen"
        deck = (screen / "in.screen").read_text()
        for name, value in variables.items():
            deck = re.sub(rf"(variable {name} +index) \S+", rf"\1 {value}", deck)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "screen.yaml").write_text((screen / "screen.yaml").read_text().replace("[30, 30, 1]", "[20, 20, 1]"))
            result = decks.run_in(Path(folder), deck)
            self.assertEqual(result.code, 0, result.text[-2000:])
            tables = [np.genfromtxt(Path(folder) / name, delimiter=",", names=True) for name in ("contact_force.csv", "state.csv")]
        return {name: table[name] for table in tables for name in table.dtype.names}

    def test_a_plate_that_its_frame_shakes(self):
        """Kirchhoff's clamped plate under its own inertia: 52.4 um at 25 1/s."""
        found = self.run_screen(layers="0", dt="2e-4", steps="800", every="1")
        late = found["t"] > 0.08
        phase = 50 * np.pi * found["t"][late]
        rows = np.stack([np.sin(phase), np.cos(phase), np.ones_like(phase)], axis=1)
        sine, cosine, mean = np.linalg.lstsq(rows, (found["w"] - 2e-3 * np.sin(50 * np.pi * found["t"]))[late], rcond=None)[0]
        self.assertLess(abs(np.hypot(sine, cosine) / 52.44e-6 - 1), 0.05)
        self.assertLess(abs(mean / -10.26e-6 - 1), 0.05)

    def test_a_bed_on_it(self):
        """One layer of it, thrown up and caught: what the frame puts in is in plate and bed, or lost in contacts."""
        found = self.run_screen(layers="1", steps="1000", every="1")
        self.assertGreater(found["contacts"].max(), 1000)
        self.assertGreater(found["F"].max(), 2 * 9.81 * found["mass"][0])
        momentum = np.cumsum((found["F"][1:] + found["F"][:-1]) / 2 - 9.81 * found["mass"][0]) * 5e-5
        speed = np.diff(found["z"]) / 5e-5  # of the middle of each step
        mean = found["mass"][0] * (speed[1:] + speed[:-1]) / 2
        self.assertLess(abs(momentum[:-1] - mean).max(), 2e-2 * abs(momentum).max())


SHAKEN = bob.block(fixed=()) + """boundary: [{name: table, move: {x: 1e-6, y: 0, z: 2e-6}, faces: [zeta-], time: "1 - cos(2*pi*1e5*t)"}]
damping: {mass: 1e4, stiffness: 1e-8, modal: [0.02, 0.01]}
loads: {gravity: [0, 0, -1e5], tractions: [{face: xi+, value: [0, 1e3, 0], time: {sine: {frequency: 2e5}}}]}
output: {every: 1e-6, file: block, fields: {of: [displacement, von_mises], every: 4e-6}}
"""
MODAL = "structure block.yaml body modal 12 surface top"
COLUMNS = tuple(range(1, 31))


class AsAnyBody(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_shaken(self, name: str, runs: str, ranks: int = 1, restart: str = "") -> tuple[dict[str, np.ndarray], Path]:
        folder = self.folder / name
        folder.mkdir()
        (folder / "block.yaml").write_text(SHAKEN)
        models = "model hertz tangential history"
        balls = ((-0.4e-3, 0.2e-3, 1.0005e-3),)
        deck = (bob.prelude(balls=balls, velocity=(0.3, 0, -1), friction=0.3, models=models, timestep=5e-8, restart=restart)
                + bob.wall(models, MODAL) + bob.output(COLUMNS) + runs)  # fmt: skip
        result = decks.run_in(folder, deck, ranks)
        self.assertEqual(result.code, 0, result.text[-2000:])
        return result.table, folder

    def test_ranks_and_restarts_go_on_to_the_last_bit(self):
        whole, folder = self.run_shaken("one", "run 150\nwrite_restart half.restart\nrun 150\n")
        self.assertGreater(np.abs(whole["plate3"]).max(), 1.0)
        two, parts = self.run_shaken("two", "run 150\nrun 150\n", ranks=2)
        for name, values in whole.items():
            np.testing.assert_array_equal(two[name], values, name)
        for file in ("block_volume_1.vtu", "block_volume_3.vtu"):
            self.assertEqual((folder / file).read_bytes(), (parts / file).read_bytes())
        again, _ = self.run_shaken("again", "run 150\n", ranks=2, restart=str(folder / "half.restart"))
        for name in ("z", "vz", "fz", "plate3", "plate9", "plate14", "plate15", "plate20", "plate26", "plate28"):
            np.testing.assert_array_equal(again[name], whole[name][-151:], name)

    def test_its_ledger_is_closed_and_its_history_is_that_of_the_columns(self):
        table, folder = self.run_shaken("ledger", "run 300\n")
        kinetic, contacts, loads, internal, supports, damped = (table[f"plate{c}"] for c in (15, 22, 23, 24, 29, 30))
        balance = kinetic + internal + damped - contacts - loads - supports
        np.testing.assert_allclose(balance, balance[0], rtol=0, atol=1e-11 * kinetic.max())
        for work in (contacts, loads, supports, damped):
            self.assertGreater(abs(work).max(), 1e-4 * kinetic.max())
        rows = slice(0, None, 20)
        with h5py.File(folder / "block.h5") as file:
            for name, column in (("kinetic_energy", 15), ("strain_energy", 16), ("ledger/supports", 29)):
                np.testing.assert_allclose(file[name][...], table[f"plate{column}"][rows], rtol=1e-14, atol=0, err_msg=name)
            reactions = np.stack([table[f"plate{c}"][rows] for c in (26, 27, 28)], axis=1)
            np.testing.assert_allclose(file["reactions/table"][...], reactions, rtol=1e-14)

    def test_refusals(self):
        law = bob.block().replace("linear_elastic", "neo_hooke")
        pressed = bob.block() + "loads: {pressures: [{face: zeta+, value: 1}]}\n"
        loose = bob.block(fixed=()) + "boundary: [{move: {z: 1e-6}, faces: [zeta-]}]\n"
        for model, words, expected in (
            (law, MODAL, "body modal: law is 'neo_hooke', expected linear_elastic"),
            (pressed, MODAL, "pressures follow the motion, expected loads.tractions"),
            (loose, MODAL, "supports move, but do not hold the body"),
            (bob.block(), MODAL + " substeps auto", "'substeps' are those of a solid with a stable step"),
            (bob.block(), MODAL.replace("12", "0"), "body modal is '0', expected how many modes"),
            (bob.block(), MODAL.replace("12", "900"), "expected less than the"),
            (bob.block(), "structure block.yaml surface top body modal 900", "expected less than the"),
            (bob.block(), "body modal 900 structure block.yaml surface top", "expected less than the"),
            (bob.block(), MODAL.replace("modal", "model"), "body is 'model', expected 'modal'"),
            (bob.block() + "integration: {mass: corrected}\n", MODAL, "integration.mass is 'corrected', expected lumped"),
            (bob.block() + "damping: {modal: 0.01}\n", "structure block.yaml surface top", "damping.modal is of modes"),
            (bob.block() + "damping: {modal: [0.01, -1]}\n", MODAL, "modal has -1"),
        ):
            with self.subTest(expected):
                run = decks.run(bob.prelude() + bob.wall(rest=words) + "run 1\n", files={"block.yaml": model})
                self.assertNotEqual(run.code, 0)
                self.assertIn(expected, " ".join(run.errors))


if __name__ == "__main__":
    unittest.main()

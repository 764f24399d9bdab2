# SPDX-License-Identifier: GPL-2.0-or-later
"""A restart file belongs to the wall that wrote it: read by another one it is refused, or said not to be taken.  That the
same wall continues to the last bit is in test_life_cycle.py."""

import re
import struct
import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks

MODELS = "model hertz tangential history"
STRUCTURE = "structure block.yaml surface top"
SETTINGS = dict(restitution=0.6, friction=0.3, models=MODELS, velocity=(0.5, 0.1, -1.0))
COLUMNS = (3, 7, 15)
BLOCK = bob.block()
FLOOR = """
units: si
geometry:
  plane: {origin: [-0.002, -0.002, 0], edges: [[0.004, 0, 0], [0, 0.004, 0]], elements: [4, 4], degree: 2}
surfaces: {top: all}
"""
RIGID = "geometry floor.yaml surface top motion linear 0 0 0.1"


def writer(words: str = STRUCTURE) -> str:
    """A deck that stops within the contact."""
    return bob.prelude(**SETTINGS) + bob.wall(MODELS, words) + bob.output(COLUMNS) + "run 260\nwrite_restart contact\nrun 40\n"


def reader(words: str = STRUCTURE, models: str = MODELS, wall: tuple[float, float] = (5e9, 0.3), name: str = "plate") -> str:
    """A deck that continues it."""
    prelude = bob.prelude(restart="contact", **SETTINGS | dict(models=models, wall=wall))
    fix = bob.wall(models, words).replace("fix plate", f"fix {name}")
    return prelude + fix + bob.output(COLUMNS).replace("f_plate", f"f_{name}") + "run 40\n"


def older(restart: bytes) -> bytes:
    """The restart file as the version without fingerprints wrote it: the first two parts of the wall's state alone."""
    style = b"wall/gran/nurbs\0"
    at = restart.index(style) + len(style)
    (size,) = struct.unpack_from("i", restart, at)
    numbers = np.frombuffer(restart, count=size // 8, offset=at + 4)
    assert numbers[0] < 0.0
    end = 1  # of the two parts
    for _ in range(2):
        end += 1 + int(numbers[end])
    state = numbers[1:end].tobytes()
    return restart[:at] + struct.pack("i", len(state)) + state + restart[at + 4 + size :]


# name: (model file, its words in the fix, E and nu of the deck, what the error says)
SOLIDS = {
    "Young's modulus": (bob.block(youngs_modulus=6e9), (6e9, 0.3), ["material: E = 5000000000", "E = 6000000000"]),
    "Poisson's ratio": (bob.block(nu=0.2), (5e9, 0.2), ["material:", "nu = 0.2"]),
    "density": (bob.block(density=2000.0), (5e9, 0.3), ["material:", "density = 1000", "density = 2000"]),
    "mass": (BLOCK + "integration: {mass: corrected}\n", (5e9, 0.3), ["mass"]),
    "law": (BLOCK.replace("linear_elastic", "saint_venant_kirchhoff"), (5e9, 0.3), ["law.*linear_elastic.*saint_venant"]),
    "supports": (bob.block(fixed=()), (5e9, 0.3), ["supports: 108 .* then, 0 "]),
    "dimensions": (bob.block(size=(5e-3, 4e-3, 2e-3)), (5e9, 0.3), ["geometry:", r"\[0.002, 0.002, 0\]", r"\[0.0025, 0.002, 0\]"]),
    "elements, as many control points": (bob.block(elements=(2, 4, 4)), (5e9, 0.3), ["4 x 4 x 2 elements", "2 x 4 x 4 elements"]),
    "the other face": (BLOCK.replace("zeta+}\n", "zeta-}\n"), (5e9, 0.3), [r"surface: zeta\+ then, zeta- now"]),
}


def ball_on_block_of_boxes() -> str:
    """Four boxes, which meet under the ball."""
    return bob.block(elements=(64, 32, 2))


class Restart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.of_solid, cls.solid = cls.written(STRUCTURE)
        cls.of_floor, cls.floor = cls.written(RIGID)

    @staticmethod
    def written(words: str = STRUCTURE, ranks: int = 1, block: str = BLOCK, **settings: str) -> tuple[bytes, decks.Run]:
        """A restart file, and the run that wrote it, with settings of the environment."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "contact"
            deck = writer(words).replace("write_restart contact", f"write_restart {path}")
            run = decks.good(deck, files={"block.yaml": block, "floor.yaml": FLOOR}, ranks=ranks, environment=settings)
            return path.read_bytes(), run

    def read(self, deck: str, restart: bytes, ranks: int = 1, **files: str) -> decks.Run:
        names = {f"{name}.yaml": text for name, text in files.items()}
        return decks.run(deck, files={"block.yaml": BLOCK, "floor.yaml": FLOOR, "contact": restart} | names, ranks=ranks)

    def check_refused(self, run: decks.Run, *expected: str):
        self.assertNotEqual(run.code, 0, run.text[-2000:])
        self.assertEqual(len(run.errors), 1, run.text[-2000:])
        for pattern in ("id plate", "restart file", *expected):
            self.assertRegex(run.errors[0], pattern)

    def check_continues(self, run: decks.Run, whole: decks.Run):
        self.assertEqual(run.code, 0, run.text[-2000:])
        for column, reference in whole.tables[1].items():
            with self.subTest(column=column):
                np.testing.assert_array_equal(run.tables[0][column], reference)

    def warnings(self, run: decks.Run) -> list[str]:
        return [line for line in run.text.splitlines() if "WARNING: Fix wall/nurbs" in line and "restart file" in line]

    def test_another_solid_is_refused(self):
        for name, (text, material, expected) in SOLIDS.items():
            for ranks in (1, 2) if name == "density" else (1,):
                with self.subTest(name, ranks=ranks):
                    run = self.read(reader(wall=material), self.of_solid, ranks, block=text)
                    self.check_refused(run, "'block.yaml'", "another ID", *expected)

    def test_a_solid_in_parts_continues_on_any_number_of_ranks(self):
        block = ball_on_block_of_boxes()
        restart, whole = self.written(ranks=2, block=block)
        for ranks in (1, 2, 4):
            with self.subTest(ranks=ranks):
                self.check_continues(self.read(reader(), restart, ranks, block=block), whole)

    def test_a_plate_whose_shear_is_corrected_goes_on_and_is_another_one(self):
        plain = bob.block(size=(4e-3, 4e-3, 4e-4), elements=(4, 4, 1), fixed=("xi-", "xi+"))
        block = plain + "integration: {shear: corrected}\n"
        restart, whole = self.written(block=block)
        self.check_continues(self.read(reader(), restart, block=block), whole)
        self.check_refused(self.read(reader(), restart, block=plain), "'block.yaml'", "law.*linear_elastic, shear corrected then, linear_elastic now")

    def test_corrected_mass_goes_on(self):
        block = BLOCK + "integration: {mass: corrected}\ndamping: {mass: 1e4}\n"
        restart, whole = self.written(block=block)
        self.check_continues(self.read(reader(), restart, block=block), whole)

    def test_supports_and_loads_go_on_in_time(self):
        """And loads with their ramps; written within these, by whatever number of ranks."""
        moved = "boundary: [{move: {z: 2e-6, x: 1e-6}, faces: [zeta-], time: {ramp: [0, 4e-6]}}]"
        block = ball_on_block_of_boxes().replace("boundary: [{fix: [x, y, z], faces: [zeta-]}]", moved)
        self.assertIn(moved, block)
        block += """loads:
  tractions: [{face: xi+, value: ["1e4*y*t/1e-6", 0, 1e4], time: {ramp: [1e-6, 3e-6]}}]
  pressures: [{face: xi-, value: 1e5, time: {sine: {frequency: 1e5}}}]
damping: {mass: 1e4}
"""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "contact"
            deck = writer().replace("write_restart contact", f"write_restart {path}")
            whole = decks.good(deck, files={"block.yaml": block}, ranks=2)
            restart = path.read_bytes()
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check_continues(self.read(reader(), restart, ranks, block=block), whole)

    def test_another_rigid_wall_is_refused(self):
        for old, new in (("[4, 4]", "[8, 4]"), ("edges: [[0.004", "edges: [[0.005"), ("degree: 2", "degree: 3")):
            with self.subTest(new):
                run = self.read(reader(RIGID), self.of_floor, floor=FLOOR.replace(old, new))
                self.check_refused(run, "geometry: 4 x 4 elements of degree 2 2 .* then")
        for words in ("move 0 0 1e-5", "scale 1.01", "rotate axis 0 0 1 angle 5"):
            with self.subTest(words):
                self.check_refused(self.read(reader(f"{RIGID} {words}"), self.of_floor), "geometry: 4 x 4 elements .* then")
        self.check_refused(self.read(reader(RIGID), self.of_solid), "material: .* then, none now")

    def test_loads_output_and_the_name_of_the_file_may_differ(self):
        text = BLOCK.replace("surfaces:", "loads: {gravity: [0, 0, 0]}\noutput: {every: 1, file: other}\nsurfaces:")
        run = self.read(reader("structure other.yaml surface top"), self.of_solid, other=text)
        self.check_continues(run, self.solid)
        self.assertEqual(self.warnings(run), [])
        floor = RIGID.replace("floor.yaml", "other.yaml")
        self.check_continues(self.read(reader(floor), self.of_floor, other=FLOOR), self.floor)

    def test_a_state_larger_than_what_a_fix_may_leave(self):
        """LIGGGHTS counts a fix's bytes by an int; here a block is 1 kB, and the solid's state has some tens of them."""
        for ranks in (1, 2):
            restart, run = self.written(STRUCTURE, ranks, LIGGGHTS_NURBS_RESTART_BLOCK="125")
            self.assertGreater(restart.count(b"wall/nurbs/state\0"), 10)
            self.check_continues(self.read(reader(), restart, ranks), run)
            again = reader() + "write_restart again\nunfix plate\n"
            self.assertEqual(self.read(again, restart, ranks).code, 0)
        self.check_refused(self.read(reader(wall=(6e9, 0.3)), restart, block=bob.block(youngs_modulus=6e9)), "material: E")
        cut = restart.replace(b"state7_plate", b"state0_plate")
        self.check_refused(self.read(reader(), cut), "damaged")

    def test_a_file_of_an_older_version_is_read_with_a_warning(self):
        uncorrected = STRUCTURE + " compliance none"
        for words, restart, whole in ((uncorrected, *self.written(uncorrected)), (RIGID, self.of_floor, self.floor)):
            run = self.read(reader(words), older(restart))
            self.check_continues(run, whole)
            self.assertEqual(len(self.warnings(run)), 1, run.text)
            self.assertIn("older version", self.warnings(run)[0])
        run = self.read(reader(), older(self.of_solid))
        self.check_refused(run, "older version", "not corrected", "'compliance none'", "another ID")

    def test_contact_memory_of_another_kind_is_refused(self):
        run = self.read(reader(models="model hertz tangential no_history"), self.of_solid)
        self.check_refused(run, "31 history values", "keep 28", "another ID")
        self.check_refused(self.read(reader(STRUCTURE + " compliance none"), self.of_solid), "31 history values", "keep 3", "'compliance'")
        self.check_refused(self.read(reader(STRUCTURE + " contacts 3"), self.of_solid), "use 'contacts 4'")
        self.check_continues(self.read(reader(STRUCTURE + " contacts 6"), self.of_solid), self.solid)

    def test_a_full_disk_is_told(self):
        full = "shell ln -s /dev/full contact\n"
        for words in (STRUCTURE, RIGID):
            for ranks in (1, 2):
                with self.subTest(words, ranks=ranks):
                    files = {"block.yaml": BLOCK, "floor.yaml": FLOOR}
                    run = decks.run(full + writer(words).replace("run 260", "run 1"), files=files, ranks=ranks)
                    self.check_refused(run, "cannot write", "No space left on device", "make room")

    def test_another_id_is_told_that_nothing_was_taken(self):
        for words, restart in ((STRUCTURE, self.of_solid), (RIGID, self.of_floor)):
            run = self.read(reader(words, name="slab"), restart)
            self.assertEqual(run.code, 0, run.text[-2000:])
            (warning,) = self.warnings(run)
            self.assertRegex(warning, "id slab.*ID plate, which no fix has taken.*nothing for slab.*starts anew")

    def test_a_wall_more_is_no_reason_to_warn(self):
        far = "geometry far.yaml surface top"
        more = bob.wall(MODELS, far).replace("fix plate", "fix more")
        deck = reader().replace("fix integrate", more + "fix integrate")
        run = self.read(deck, self.of_solid, far=FLOOR.replace("-0.002, 0]", "-0.002, 0.01]"))
        self.check_continues(run, self.solid)
        self.assertEqual(self.warnings(run), [])

    def test_fields_without_output_are_told_to_be_dropped(self):
        restart, _ = self.written(STRUCTURE + " output fields every 200")
        (warning,) = self.warnings(self.read(reader(), restart))
        self.assertIn("no 'output'", warning)


class OneSolid(unittest.TestCase):
    """Two fixes with one model file would make two solids."""

    FILES = {"block.yaml": BLOCK, "copy.yaml": BLOCK}

    def deck(self, file: str, before: str = "") -> str:
        second = bob.wall(MODELS, f"structure {file} surface top").replace("fix plate", "fix again")
        return bob.prelude(**SETTINGS) + bob.wall(MODELS) + before + second + "run 1\n"

    def test_the_second_is_refused_with_the_way_out(self):
        link = "shell ln -s block.yaml link.yaml\n"
        for file, before in (("block.yaml", ""), ("./block.yaml", ""), ("link.yaml", link)):
            for ranks in (1, 2):
                with self.subTest(file, ranks=ranks):
                    run = decks.run(self.deck(file, before), files=self.FILES, ranks=ranks)
                    self.assertNotEqual(run.code, 0)
                    self.assertEqual(len(run.errors), 1, run.text[-2000:])
                    for pattern in ("id again", f"'{re.escape(file)}'", "fix plate", "two solids", "copy the file"):
                        self.assertRegex(run.errors[0], pattern)

    def test_several_faces_are_one_surface(self):
        text = bob.block(fixed=()).replace("{top: zeta+}", "{skin: [0 zeta-, 0 zeta+]}")
        inside = 1e-6
        balls = ((0.0, 0.0, bob.RADIUS - inside), (0.0, 0.0, -2e-3 - bob.RADIUS + inside))
        deck = bob.prelude(balls=balls, velocity=(0, 0, 0), models=MODELS) + bob.wall(MODELS, "structure block.yaml surface skin")
        (table,) = decks.good(deck + bob.output((7, 3)) + "run 0\n", files={"block.yaml": text}).tables
        self.assertEqual(table["plate7"][0], 2.0)
        self.assertLess(abs(table["plate3"][0]), 1e-12 * table["fz"][0])

    def test_a_copy_and_a_fix_that_is_gone_are_no_obstacle(self):
        for file, before in (("copy.yaml", ""), ("block.yaml", "unfix plate\n")):
            run = decks.run(self.deck(file, before), files=self.FILES)
            self.assertEqual(run.code, 0, run.text[-2000:])


if __name__ == "__main__":
    unittest.main()

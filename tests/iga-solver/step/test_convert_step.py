# SPDX-License-Identifier: GPL-2.0-or-later
"""CAD files through nurbs-convert: to HDF5 and back to the last bit, units, surfaces by name, the bad files."""

import os
import re
import subprocess
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy

import bad_files

MAKE_STEP_PARTS, NURBS_CONVERT = os.environ["MAKE_STEP_PARTS"], os.environ["NURBS_CONVERT"]
# Mended; read by what they are, whatever they are called.
READ = {*bad_files.MENDABLE, "step_inside.igs", "iges_inside.step"}
# What OpenCASCADE makes good shapes of.
SAID = {
    "hole_alone_holes.step": r"#213 \(ADVANCED_FACE\): its borders are holes",
    "hole_alone_spline_plate_hole.step": r"#17 \(ADVANCED_FACE\): its borders are holes",
    "mirrored_nested.step": r"#\d+ \(CARTESIAN_TRANSFORMATION_OPERATOR_3D\): a part placed as a mirror image",
    "scaled_nested.step": r"#\d+ \(CARTESIAN_TRANSFORMATION_OPERATOR_3D\): a part placed with the scale 2",
    "garbage_closed_spline.igs": r"entity D5 \(of type 128\): .*export the file again",
}


def values(path: Path) -> dict:
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
        found.update(file.attrs)
    return found


class ConvertStep(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        subprocess.run([MAKE_STEP_PARTS, cls.folder, *bad_files.GOOD], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_it(self, *words) -> subprocess.CompletedProcess:
        return subprocess.run([NURBS_CONVERT, *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def converted(self, *words) -> str:
        done = self.run_it(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_to_hdf5_and_back(self):
        """Planes, cylinders, cones, splines, an assembly; what is read from HDF5 is written alike and described alike."""
        for name in ("nested.step", "blend_cone_pipe.step", "spline_tip.step", "closed_spline.igs"):
            with self.subTest(name):
                page = self.converted(name, "one.h5")
                self.assertEqual(self.converted("one.h5", "two.h5").splitlines()[1:-1], page.splitlines()[1:-1])
                one, two = values(self.folder / "one.h5"), values(self.folder / "two.h5")
                self.assertEqual(one.keys(), two.keys())
                for key, value in one.items():
                    numpy.testing.assert_array_equal(two[key], value)

    def test_units(self):
        self.converted("box.step", "si.h5")
        self.converted("box.step", "mm.h5", "--units", "mm-g-ms")
        si, mm = values(self.folder / "si.h5"), values(self.folder / "mm.h5")
        numpy.testing.assert_allclose(si["vertices/point"], 1e-3 * mm["vertices/point"], rtol=1e-15)
        numpy.testing.assert_allclose(sorted(set(mm["edges/length"])), [40, 60, 100], rtol=1e-14)

    def test_the_page(self):
        page = self.converted("nested.step", "--units", "mm-g-ms")
        self.assertIn("CAD file in millimetre: 5 solids, 0 sheets", page)
        self.assertIn("'frame/leg/left leg/foot': 6 faces, colour:2A9D8F", page)
        self.assertIn("'top' plane, area 12800, colour:FF8800", page)
        self.assertRegex(page, "edges: 42: 2 smooth .* 0 near-tangent .* 40 sharp, 0 free")

    def test_a_broken_style_does_no_harm(self):
        """Colours and lines of drawings are none of a wall's business, whatever is wrong with them."""
        text = (self.folder / "box.step").read_text()
        at = text.rindex("ENDSEC;")
        (self.folder / "styled.step").write_text(text[:at] + "#99990 = CURVE_STYLE('',3,0.1,$);\n" + text[at:])
        self.assertIn("6 plane", self.converted("styled.step"))

    def test_surfaces_by_name_in_yaml(self):
        def surfaces(words: str) -> str:
            (self.folder / "wall.yaml").write_text(
                f"units: mm-g-ms\ngeometry: {{file: nested.step, rotate: {{axis: [0, 0, 1], angle: 90}}}}\nsurfaces: {{wall: {words}}}\n"
            )
            return self.run_it("wall.yaml").stderr

        for words in ("all", "table", "leg", "frame/plate", "[sole, 'face:1']", "'colour:FF8800'", "left leg"):
            self.assertEqual(surfaces(words), "", words)
        for words in ("nothing", "'face:25'", "'colour:000001'", "eg"):
            self.assertRegex(surfaces(words), "wall.yaml:3: .* expected all, face:N with N from 1 to 24, .*colour:FF8800.* sole, top")

    def check_bad(self, bad) -> tuple:
        path = self.folder / f"bad_{bad.name}"
        path.write_bytes(bad.content)
        start = time.monotonic()
        return path, self.run_it(path.name), time.monotonic() - start

    def test_bad_files_are_refused_in_one_line(self):
        """A crash of OpenCASCADE is one, too; of files cut short and of wrong references one kind each is enough here."""
        files = [bad for bad in bad_files.bad_files(self.folder) if not re.match("cut_.*(pipe|nested)|type_", bad.name)]
        self.assertGreater(len(files), 60)
        for part in self.folder.glob("external_*.stp"):
            part.unlink()
        with ThreadPoolExecutor(4) as pool:
            for bad, (path, done, seconds) in zip(files, pool.map(self.check_bad, files)):
                with self.subTest(bad.name, wrong=bad.wrong):
                    self.assertLess(seconds, 20)
                    if bad.name in READ:
                        self.assertEqual((done.returncode, done.stderr), (0, ""))
                    else:
                        self.assertEqual(done.returncode, 1, done.stdout)
                        self.assertRegex(done.stderr, rf"^ERROR: {path.name}: {SAID.get(bad.name, '')}.*\n$")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""CAD files through nurbs-convert: to HDF5 and back to the last bit, units, surfaces by name, the bad files."""

import os
import re
import shutil
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
    "mirrored_faces_closed_spline.igs": r"entity D3 \(of type 144\): placed as a mirror image",
    "mirrored_circles_branch_holes.igs": r"entity D\d+ \(of type 100\): placed as a mirror image",
    "scaled_faces_closed_spline.igs": r"entity D3 \(of type 144\): placed by a matrix that scales or skews",
    "skewed_splines_closed_spline.igs": r"entity D5 \(of type 128\): placed by a matrix that scales or skews",
    "turned_frustum.igs": r"entity D1 \(of type 186\): placed by a matrix, which OpenCASCADE leaves out",
    "lost_frustum.igs": r"entity D1 \(of type 150\): OpenCASCADE can make no shape of it",
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
        subprocess.run([MAKE_STEP_PARTS, cls.folder, *bad_files.GOOD, "gaps.step"], check=True)

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

    def places(self, name: str) -> tuple:
        """Points of what was read: vertices, and control points of patches; and the face's areas."""
        page = self.converted(name, "placed.h5", "--units", "mm-g-ms")
        found = values(self.folder / "placed.h5")
        points = [value.reshape(-1, 3) for key, value in found.items() if key == "vertices/point" or key.endswith("control_points") and value.shape[-1] == 3]
        return numpy.vstack(points), sorted(float(area) for area in re.findall(r"(?m)^  face.*area ([\d.e+]+)", page))

    def test_places_of_iges(self):
        """Faces, groups of them and what they consist of, turned; and splines and planes that are mirrored."""
        good = bad_files.GoodIges(self.folder, "closed_spline.igs")
        points, areas = self.places("closed_spline.igs")
        self.assertGreater(len(points), 20)
        for types, matrix in (
            ((402,), bad_files.TURNED),
            ((144,), bad_files.TURNED),
            ((108, 126, 128), bad_files.TURNED),
            ((108, 126, 128), bad_files.MIRRORED),
        ):
            with self.subTest(types=types, matrix=matrix):
                form = int(matrix is bad_files.MIRRORED)
                (self.folder / "placed.igs").write_text(good.placed(types, matrix, form))
                rows = numpy.reshape(matrix, (3, 4))
                expected = points @ rows[:, :3].T + rows[:, 3]
                placed, placed_areas = self.places("placed.igs")
                numpy.testing.assert_allclose(placed_areas, areas, rtol=1e-8)
                away = numpy.linalg.norm(placed[:, None] - expected[None], axis=2)
                self.assertLess(max(away.min(axis=0).max(), away.min(axis=1).max()), 1e-6)

    def test_iges_is_the_part_of_its_step_file(self):
        """Its surfaces of revolution are mirrored, its arcs are not."""
        matrices = re.findall(r"(?m)^124,(.*)", bad_files.Good(self.folder, "branch_holes.igs").text)
        self.assertGreater(len(matrices), 5)
        iges, step = self.places("branch_holes.igs")[1], self.places("branch_holes.step")[1]
        numpy.testing.assert_allclose(iges, step, rtol=1e-6)

    def test_a_part_and_its_only_solid_have_names(self):
        """OpenCASCADE keeps that of the part, which some programs make up."""
        text, brep = (self.folder / "box.step").read_text(), "MANIFOLD_SOLID_BREP('"
        self.assertEqual(text.count(brep), 1)
        for solid, part, expected in (
            ("block", "bin", "bin/block"), ("bin", "bin", "bin"), ("", "bin", "bin"), ("NONE", "bin", "bin"),
            ("block", "Open CASCADE STEP translator 7.6 1", "block"),
        ):  # fmt: skip
            named = re.sub(r"= PRODUCT\('[^']*','[^']*'", f"= PRODUCT('1','{part}'", text).replace(brep, brep + solid)
            (self.folder / "own.step").write_text(named)
            self.assertIn(f"  solid 1 '{expected}': 6 faces\n", self.converted("own.step"))

    def test_names_colours_and_units_of_iges(self):
        """A label of the directory is a name; colours are the file's own, or by one of IGES' numbers."""
        lines = (self.folder / "nested.igs").read_text().splitlines()
        faces = [i for i, line in enumerate(lines) if line[72:73] == "D" and line[:8].strip() == "144" and line[64:72].strip() == "00020000"]
        top, bare = faces[-1] + 1, faces[-2] + 1  # second lines: colour in the third column of 8, label in the eighth
        lines[top] = f"{lines[top][:56]}{'top':>8}{lines[top][64:]}"
        lines[bare] = f"{lines[bare][:16]}{2:8d}{lines[bare][24:]}"
        (self.folder / "named.igs").write_text("\n".join(lines) + "\n")
        page = self.converted("named.igs", "--units", "mm-g-ms")
        self.assertIn("CAD file in inch: 0 solids, 1 sheet", page)
        self.assertIn("sheet 1 'frame': 24 faces", page)
        for colour, count in (("808080", 6), ("2A9D8F", 12), ("0000FF", 1), ("FF8800", 1), ("FF0000", 1)):
            self.assertEqual(len(re.findall(f"(?m)^  face.*colour:{colour}", page)), count, colour)
        self.assertRegex(page, "face:24 'top' plane, area 12800, colour:FF8800")
        self.assertEqual(self.places("nested.igs")[1], sorted(self.places("nested.step")[1]))

    def test_without_the_program_that_reads_step(self):
        """As where OpenCASCADE was not found; what was converted before is read all the same."""
        self.converted("box.step", "kept.h5")
        with tempfile.TemporaryDirectory() as elsewhere:
            alone = shutil.copy(NURBS_CONVERT, elsewhere)
            for name in ("box.step", "frustum.igs"):
                done = subprocess.run([alone, name], cwd=self.folder, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 1)
                said = rf"^ERROR: {name}: STEP and IGES are read by the program 'nurbs-read-step', .*OpenCASCADE.*take a file that nurbs-convert wrote \(.h5\).*\n$"
                self.assertRegex(done.stderr, said)
            done = subprocess.run([alone, "kept.h5"], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_what_was_healed(self):
        """A solid that lacks a face; edges of a loop out of turn; faces side by side; angles along an arc."""
        text = (self.folder / "box.step").read_text()
        (self.folder / "lid.step").write_text(re.sub(r"(CLOSED_SHELL\('',\(#\d+),#\d+", r"\1", text, count=1))
        crossed = next(bad for bad in bad_files.wrong_topology(self.folder) if bad.name == "crossed_loop_box.step")
        (self.folder / crossed.name).write_bytes(crossed.content)
        for name, said in (
            ("lid.step", r"#\d+ \(MANIFOLD_SOLID_BREP\) encloses nothing: it is a sheet, not a body"),
            (crossed.name, "2 x Adjacent edges are not connected"),
            ("closed_spline.igs", r"sheet '': sewn along 2 edges, over gaps up to"),
            ("gaps.step", r"sheet 'gaps.step \d+': sewn along 3 edges, over gaps up to 0.0141 mm \(9.3e-05 of its size\)"),
            ("branch_holes.igs", r"face 1: \d+ curves of its border fitted within 1e-10 of its parameters"),
            ("box.step", "nothing"),
        ):
            with self.subTest(name):
                self.assertRegex(self.converted(name), f"(?s)\nhealed:.*{said}.*refused: nothing")

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

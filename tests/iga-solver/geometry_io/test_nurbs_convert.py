# SPDX-License-Identifier: GPL-2.0-or-later
"""nurbs-convert from outside, against files that h5py, ElementTree and PyYAML write and read: no code of ours on their
side.  Every number survives to the last bit; what is printed is known from geometry."""

import math
import re
import subprocess
import unittest
from pathlib import Path

import h5py
import numpy
from convert_case import FACES, PROGRAM, SURFACES, VOLUME, ConvertCase, write_hdf5, write_xml


class NurbsConvert(ConvertCase):
    def test_hdf5_of_h5py_to_yaml(self):
        for fixed_text in (False, True):
            write_hdf5(self.folder / "in.h5", SURFACES, {"shell": ["0", "2"], "rest": ["1"]}, fixed_text)
            self.convert("in.h5", "out.yaml")
            self.check_yaml("out.yaml", SURFACES, {"shell": [0, 2], "rest": [1]})
        write_hdf5(self.folder / "in.h5", [VOLUME], {"top": ["zeta+"]})
        self.convert("in.h5", "out.yaml")
        self.check_yaml("out.yaml", [VOLUME], {"top": ["zeta+"]})

    def test_hdf5_of_h5py_to_xml(self):
        write_hdf5(self.folder / "in.hdf5", SURFACES, {"shell": ["2", "0"]})
        self.convert("in.hdf5", "out.xml")
        root = self.check_xml("out.xml", SURFACES)
        self.assertEqual(root.find("MultiPatch[@label='shell']/patches").text.split(), ["2", "0"])
        write_hdf5(self.folder / "in.h5", [VOLUME], {"top": ["zeta+"]})
        self.convert("in.h5", "out.xml")
        root = self.check_xml("out.xml", [VOLUME])
        self.assertEqual(root.find("MultiPatch[@parDim='3']/boundary[@name='top']").text.split(), ["0", "6"])

    def test_xml_of_element_tree_to_hdf5(self):
        write_xml(self.folder / "in.xml", SURFACES)
        self.convert("in.xml", "out.h5", "--units", "cgs")
        self.check_hdf5("out.h5", SURFACES, {"all": [b"all"]})
        write_xml(self.folder / "in.xml", [VOLUME])
        self.convert("in.xml", "out.h5", "--units", "cgs")
        self.check_hdf5("out.h5", [VOLUME], {face: [face.encode()] for face in FACES})

    def test_units_that_a_file_has_stay(self):
        write_hdf5(self.folder / "in.h5", [VOLUME], {"top": ["zeta+"]})
        said = {}
        for units in ("cgs", "si"):
            words = [PROGRAM, "in.h5", "--units", units]
            done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=True)
            self.assertIn("in.h5: units cgs", done.stdout)
            said[units] = done.stderr
        warning = "warning: in.h5 says that its units are cgs; --units si is for files that say nothing\n"
        self.assertEqual(said, {"cgs": "", "si": warning})

    def test_integers_and_single_precision_are_numbers(self):
        with h5py.File(self.folder / "floor.h5", "w") as file:
            file.attrs["format"], file.attrs["version"], file.attrs["units"] = "nurbs-geometry", 1, "si"
            patch = file.create_group("patches/0")
            patch.attrs["degrees"] = [1, 1]
            patch["knots_xi"], patch["knots_eta"] = [0, 0, 1, 1], numpy.float32([0, 0, 1, 1])
            patch["control_points"] = [[[0, 0, 0], [3, 0, 0]], [[0, 2, 0], [3, 2, 0]]]
        self.assertIn("  area 6\n", self.convert("floor.h5"))

    def test_face_of_a_volume_as_a_surface(self):
        write_hdf5(self.folder / "in.h5", [VOLUME], {"side": ["eta+"]})
        self.convert("in.h5", "out.h5", "--surface", "side")
        with h5py.File(self.folder / "out.h5") as file:
            self.assert_same(file["patches/0/control_points"], numpy.ascontiguousarray(VOLUME.points[:, -1]))
            self.assert_same(file["patches/0/weights"], numpy.ascontiguousarray(VOLUME.weights[:, -1]))
            self.assertEqual(list(file["surfaces/side"]), [b"all"])

    def test_prints_sizes_and_continuity(self):
        self.write("box.yaml", "units: si\ngeometry:\n  box: {origin: [0, 0, 0], size: [1, 2, 3], degree: 3, "
                   "elements: [4, 1, 2]}\nsurfaces: {top: zeta+}\n")
        printed = self.convert("box.yaml")
        self.assertIn("units si, 1 patch\n", printed)
        self.assertIn("patch 0: volume, degrees 3 3 3, 7 x 4 x 5 control points, 4 x 1 x 2 elements, polynomial\n", printed)
        self.assertIn("x 0 to 1, y 0 to 2, z 0 to 3\n", printed)
        self.assertIn("  volume 6\n", printed)
        self.assertIn("  interior knots of xi: 3 C2\n  interior knots of eta: none\n", printed)
        self.assertIn("surface 'top': zeta+\n  zeta+ xi-: free\n", printed)

    def test_prints_areas_of_round_shapes(self):
        shapes = {
            "cylinder: {origin: [0, 0, 0], axis: [1, 2, 3], radius: 0.5, length: 2, elements: [8, 2]}": 2 * math.pi,
            "sphere: {centre: [0, 1, 0], radius: 0.5, elements: [8, 4]}": math.pi,
            "torus: {centre: [0, 0, 0], axis: [0, 0, 1], radius: 2, tube_radius: 1, elements: [8, 8]}": 8 * math.pi**2,
        }
        for shape, area in shapes.items():
            printed = self.convert(self.write("round.yaml", f"units: si\ngeometry:\n  {shape}\n"))
            self.assertAlmostEqual(float(re.search("area (.*)", printed)[1]) / area, 1, delta=5e-6)

    def test_prints_seams_and_poles(self):
        printed = self.convert(self.write("ball.yaml", "units: si\ngeometry:\n  sphere: {centre: [0, 0, 0], radius: 1, "
                                          "elements: [4, 2]}\nsurfaces: {ball: all}\n"))
        self.assertRegex(printed, r"patch 0 xi-: closed with its xi\+, C1, largest angle \d(\.\d+)?e-1\d degrees\n")
        self.assertIn("patch 0 eta-: pole\n", printed)
        self.assertRegex(printed, r"interior knots of xi: 3 C0, largest angle at C0 \d(\.\d+)?e-1\d degrees\n")
        self.assertIn("surface 'ball': all\n", printed)

    def test_prints_how_patches_meet(self):
        def plate(corner, u, v):
            points = [corner, *(numpy.add(corner, edge).tolist() for edge in (u, v, numpy.add(u, v)))]
            return f"    - {{degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control_points: {points}}}\n"

        slope = [math.cos(math.radians(30)), 0, math.sin(math.radians(30))]
        text = "units: si\ngeometry:\n  patches:\n" + plate([0, 0, 0], [1, 0, 0], [0, 1, 0])
        text += plate([1, 1, 0], [0, -1, 0], slope)  # beyond xi+, upwards; its xi runs against eta, its normal upwards
        text += plate([0, 0, 0], [0, 1, 0], [-2, 1, 0])  # beyond xi-, in the plane, sheared
        text += plate([0, 1, 0], [0, 1, 0], [1, 0, 0])  # beyond eta+, in the plane, turned over
        printed = self.convert(self.write("plates.yaml", text))
        self.assertIn("patch 0 xi+: welded to patch 1 eta- reversed, C0, largest angle 30 degrees\n", printed)
        self.assertIn("patch 1 eta-: welded to patch 0 xi+ reversed, C0, largest angle 30 degrees\n", printed)
        self.assertIn("patch 0 xi-: welded to patch 2 eta-, G1, largest angle 0 degrees\n", printed)
        self.assertIn("patch 0 eta+: welded to patch 3 xi-, opposite orientation, C1, largest angle 0 degrees\n", printed)
        self.assertIn("patch 0 eta-: free\n", printed)

    def test_kink_at_a_C0_knot(self):
        text = ("units: si\ngeometry:\n  patches:\n    - {degrees: [1, 1], knots: [[0, 0, 0.5, 1, 1], [0, 0, 1, 1]], "
                "control_points: [[0, 0, 0], [1, 0, 0], [2, 0, 1], [0, 1, 0], [1, 1, 0], [2, 1, 1]]}\n")
        self.assertIn("interior knots of xi: 1 C0, largest angle at C0 45 degrees\n", self.convert(self.write("v.yaml", text)))

    def test_a_yaml_file_that_names_another(self):
        (self.folder / "parts").mkdir()
        write_xml(self.folder / "parts" / "in.xml", SURFACES)
        self.write("wall.yaml", "units: cgs\ngeometry: {file: parts/in.xml}\nsurfaces: {shell: [0, 2]}\n")
        self.convert("wall.yaml", "out.h5")
        self.check_hdf5("out.h5", SURFACES, {"all": [b"all"], "shell": [b"0", b"2"]})

    def test_files_of_older_versions_are_read(self):
        """version_1.h5: SURFACES[0] as this program wrote it when its texts had variable length."""
        (self.folder / "in.h5").write_bytes((Path(__file__).parent / "version_1.h5").read_bytes())
        self.convert("in.h5", "out.yaml")
        self.check_yaml("out.yaml", SURFACES[:1], {"shell": ["all"], "b": ["all"]})


if __name__ == "__main__":
    unittest.main()

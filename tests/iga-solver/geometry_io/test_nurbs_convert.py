# SPDX-License-Identifier: GPL-2.0-or-later
"""nurbs-convert from outside, against files that h5py, ElementTree and PyYAML write and read: no code of ours on their
side.  Every number survives to the last bit; what is printed is known from geometry."""

import math
import os
import re
import resource
import shutil
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from random import Random

import h5py
import numpy
import yaml

PROGRAM = os.environ["NURBS_CONVERT"]
DAMAGES = [*range(12), 15, 18, 20, 30]
FACES = ["xi-", "xi+", "eta-", "eta+", "zeta-", "zeta+"]
SANITIZED = b"__asan_init" in Path(PROGRAM).read_bytes()  # whose shadow memory needs terabytes of addresses


def limit_memory() -> None:
    """A reader that fills the memory shall fail, and not take the machine with it."""
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))


class Patch:
    """Random numbers in the layout of the files: control points [.., n_eta, n_xi, 3]."""

    def __init__(self, seed: int, degrees: list[int], elements: list[int], rational: bool = True):
        random = numpy.random.default_rng(seed)
        self.degrees = degrees
        self.knots = []
        for degree, count in zip(degrees, elements):
            inner = numpy.sort(random.uniform(0.1, 0.9, count - 1))
            self.knots.append(numpy.concatenate([numpy.zeros(degree + 1), inner, numpy.ones(degree + 1)]))
        self.net = [len(knots) - degree - 1 for degree, knots in zip(degrees, self.knots)][::-1]
        self.points = random.normal(size=(*self.net, 3))
        self.weights = random.uniform(0.3, 3.0, self.net) if rational else None


SURFACES = [Patch(1, [2, 3], [4, 2]), Patch(2, [1, 4], [1, 5], rational=False), Patch(3, [3, 3], [2, 2])]
VOLUME = Patch(4, [2, 1, 3], [2, 3, 1])


def write_hdf5(path: Path, patches: list[Patch], surfaces: dict[str, list[str]], fixed_text: bool = False) -> None:
    """The schema of iga-solver/geometry_io/README.md, by hand."""
    with h5py.File(path, "w") as file:
        file.attrs["format"] = numpy.bytes_("nurbs-geometry") if fixed_text else "nurbs-geometry"
        file.attrs["version"] = numpy.uint8(1) if fixed_text else 1
        file.attrs["units"] = "cgs"
        for index, patch in enumerate(patches):
            group = file.create_group(f"patches/{index}")
            group.attrs["degrees"] = patch.degrees
            for name, knots in zip(("xi", "eta", "zeta"), patch.knots):
                group[f"knots_{name}"] = knots
            group.create_dataset("control_points", data=patch.points, compression=None if fixed_text else "gzip")
            if patch.weights is not None:
                group["weights"] = patch.weights
        for name, words in surfaces.items():
            text = [word.encode() for word in words]
            file.create_dataset(f"surfaces/{name}", data=numpy.array(text) if fixed_text else words)


def write_xml(path: Path, patches: list[Patch]) -> None:
    """As G+Smo writes it: the first parameter fastest."""
    dim = len(patches[0].degrees)
    root = ElementTree.Element("xml")
    for index, patch in enumerate(patches):
        kind = "BSpline" if patch.weights is None else "Nurbs"
        geometry = ElementTree.SubElement(root, "Geometry", type=f"Tensor{kind}{dim}", id=str(5 + index))
        outer = geometry
        if patch.weights is not None:
            outer = ElementTree.SubElement(geometry, "Basis", type=f"TensorNurbsBasis{dim}")
        basis = ElementTree.SubElement(outer, "Basis", type=f"TensorBSplineBasis{dim}")
        for direction, (degree, knots) in enumerate(zip(patch.degrees, patch.knots)):
            one = ElementTree.SubElement(basis, "Basis", type="BSplineBasis", index=str(direction))
            ElementTree.SubElement(one, "KnotVector", degree=str(degree)).text = " ".join(map(repr, knots.tolist()))
        if patch.weights is not None:
            ElementTree.SubElement(outer, "weights").text = "\n".join(f"{w:.17e}" for w in patch.weights.ravel())
        ElementTree.SubElement(geometry, "coefs", geoDim="3").text = " ".join(f"{x:.17g}" for x in patch.points.ravel())
    domain = ElementTree.SubElement(root, "MultiPatch", parDim=str(dim), id="99")
    ElementTree.SubElement(domain, "patches", type="id_range").text = f"5 {4 + len(patches)}"
    ElementTree.ElementTree(root).write(path, xml_declaration=True, encoding="UTF-8")


class NurbsConvert(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def convert(self, *words: str) -> str:
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def refused(self, *words: str) -> str:
        done = subprocess.run(
            [PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, check=False, timeout=60,
            stdin=subprocess.PIPE, preexec_fn=limit_memory)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"\AERROR: [^\n]+\n\Z")
        return done.stderr

    def write(self, name: str, text: str) -> str:
        (self.folder / name).write_text(text)
        return name

    def assert_same(self, numbers, expected: numpy.ndarray) -> None:
        self.assertEqual(numpy.array(numbers, dtype=float).tobytes(), expected.tobytes())

    def check_yaml(self, name: str, patches: list[Patch], surfaces: dict) -> None:
        document = yaml.safe_load((self.folder / name).read_text())
        self.assertEqual(document["units"], "cgs")
        for given, patch in zip(document["geometry"]["patches"], patches, strict=True):
            self.assertEqual(given["degrees"], patch.degrees)
            for knots, expected in zip(given["knots"], patch.knots, strict=True):
                self.assert_same(knots, expected)
            # PyYAML takes "1e-05" for text: float() reads both.
            self.assert_same([[float(x) for x in point] for point in given["control_points"]], patch.points.reshape(-1, 3))
            self.assertEqual("weights" in given, patch.weights is not None)
            if patch.weights is not None:
                self.assert_same([float(w) for w in given["weights"]], patch.weights.ravel())
        self.assertEqual(document["surfaces"], surfaces)

    def check_hdf5(self, name: str, patches: list[Patch], surfaces: dict[str, list[bytes]]) -> None:
        with h5py.File(self.folder / name) as file:
            self.assertEqual(file.attrs["format"], b"nurbs-geometry")
            self.assertEqual(file.attrs["version"], 1)
            self.assertEqual(file.attrs["units"], b"cgs")
            for index, patch in enumerate(patches):
                group = file[f"patches/{index}"]
                self.assertEqual(group.attrs["degrees"].tolist(), patch.degrees)
                for direction, knots in zip(("xi", "eta", "zeta"), patch.knots):
                    self.assert_same(group[f"knots_{direction}"], knots)
                self.assertEqual(group["control_points"].shape, patch.points.shape)
                self.assert_same(group["control_points"], patch.points)
                self.assertEqual("weights" in group, patch.weights is not None)
                if patch.weights is not None:
                    self.assert_same(group["weights"], patch.weights)
            self.assertEqual(len(file["patches"]), len(patches))
            self.assertEqual({key: list(file["surfaces"][key]) for key in file["surfaces"]}, surfaces)

    def check_xml(self, name: str, patches: list[Patch]) -> ElementTree.Element:
        root = ElementTree.parse(self.folder / name).getroot()
        for geometry, patch in zip(root.findall("Geometry"), patches, strict=True):
            dim = len(patch.degrees)
            kind = "BSpline" if patch.weights is None else "Nurbs"
            self.assertEqual(geometry.get("type"), f"Tensor{kind}{dim}")
            outer = geometry if patch.weights is None else geometry.find(f"Basis[@type='TensorNurbsBasis{dim}']")
            directions = outer.findall(f"Basis[@type='TensorBSplineBasis{dim}']/Basis[@type='BSplineBasis']/KnotVector")
            self.assertEqual([int(knots.get("degree")) for knots in directions], patch.degrees)
            for knots, expected in zip(directions, patch.knots, strict=True):
                self.assert_same(knots.text.split(), expected)
            self.assert_same(geometry.find("coefs").text.split(), patch.points.ravel())
            if patch.weights is not None:
                self.assert_same(outer.find("weights").text.split(), patch.weights.ravel())
        return root

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

    def test_files_of_other_programs_are_refused(self):
        triangle = struct.pack("<12fH", *range(12), 0)
        foreign = {
            "STEP": b"ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('plate'),'2;1');\nENDSEC;\nDATA;\n#1=POINT('',(0.,0.));\n",
            "IGES": b"plate".ljust(72) + b"S      1\n" + b"1H,,1H;".ljust(72) + b"G      1\n",
            "STL": b"solid plate\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
            "an STL": b"binary".ljust(80) + struct.pack("<I", 2) + 2 * triangle,
            "binary": bytes(range(256)),
        }
        for kind, content in foreign.items():
            for name in ("wall.yaml", "wall.h5", "wall.xml", "wall." + kind.split()[-1].lower()):
                (self.folder / name).write_bytes(content)
                self.write("model.yaml", f"units: si\ngeometry: {{file: {name}}}\n")
                for path in (name, "model.yaml"):
                    with self.subTest(kind, name=name, path=path):
                        expected = "no HDF5" if (kind, name) == ("binary", "wall.h5") else f"an? .*{kind.split()[-1]}"
                        self.assertRegex(self.refused(path), f"{name}: is {expected} file, expected")
        write_hdf5(self.folder / "good.h5", SURFACES, {})
        (self.folder / "wall.yaml").write_bytes((self.folder / "good.h5").read_bytes())
        self.assertRegex(self.refused("wall.yaml"), "wall.yaml: is an HDF5 file, expected text: .* called .h5")

    def test_texts_that_yaml_cpp_does_not_end_on(self):
        for text in (",", ", units: si", "{units: si},", "units: si\n...\n,\n", "[" * 100000, "- " * 100000):
            with self.subTest(text[:30]):
                self.assertRegex(self.refused(self.write("wall.yaml", text)), r"wall.yaml:\d: (broken YAML|lists or)")

    def test_files_of_older_versions_are_read(self):
        """version_1.h5: SURFACES[0] as this program wrote it when its texts had variable length."""
        (self.folder / "in.h5").write_bytes((Path(__file__).parent / "version_1.h5").read_bytes())
        self.convert("in.h5", "out.yaml")
        self.check_yaml("out.yaml", SURFACES[:1], {"shell": ["all"], "b": ["all"]})

    def test_own_files_hold_no_text_of_variable_length(self):
        write_hdf5(self.folder / "in.h5", SURFACES, {"shell": ["0", "2"]})
        self.convert("in.h5", "out.h5")
        with h5py.File(self.folder / "out.h5") as file:
            texts = [file.attrs.get_id(name).dtype for name in ("format", "units")] + [file["surfaces/shell"].dtype]
            self.assertEqual({(dtype.kind, h5py.check_vlen_dtype(dtype)) for dtype in texts}, {("S", None)})

    def test_damaged_hdf5_is_refused(self):
        """Bytes here and there, half of them where texts of variable length lie: HDF5 itself crashes on a tenth of these."""
        write_hdf5(self.folder / "foreign.h5", SURFACES[:1], {"shell": ["all"], "b": ["0"]})
        self.convert("foreign.h5", "own.h5")
        for name in ("foreign.h5", "own.h5"):
            good = (self.folder / name).read_bytes()
            texts = max(good.find(b"GCOL"), 0)  # the heap of these texts
            for seed in DAMAGES:
                random = Random(seed)
                bad = bytearray(good)
                for _ in range(random.choice((1, 4, 16, 64))):
                    value = random.choice((0, 255, random.randrange(256)))
                    bad[random.randrange(len(bad)) if random.random() < 0.5 else texts + random.randrange(200)] = value
                (self.folder / "bad.h5").write_bytes(bad)
                with self.subTest(name, seed=seed):
                    done = subprocess.run([PROGRAM, "bad.h5"], cwd=self.folder, capture_output=True, check=False, timeout=300)
                    self.assertIn(done.returncode, (0, 1))
                    if name == "own.h5" and bad != good and bad[:8] == good[:8]:  # else it is no file of ours
                        self.assertIn(b"bad.h5: changed since it was written (its checksum differs)", done.stderr)
                    if done.returncode == 1:
                        self.assertRegex(done.stderr, rb"\AERROR: bad.h5: [^\n]+\n\Z")

    def test_values_that_no_file_can_hold(self):
        """A data set without storage has any size; none is allocated for it."""
        write_hdf5(self.folder / "bomb.h5", SURFACES[:1], {})
        with h5py.File(self.folder / "bomb.h5", "r+") as file:
            del file["patches/0/knots_xi"]
            file["patches/0"].create_dataset("knots_xi", shape=(2**31 - 1,), chunks=(1000,), dtype="f8")
        self.assertRegex(self.refused("bomb.h5"), "/patches/0/knots_xi: holds 2147483647 values in 0 bytes of the file")

    def test_without_the_program_that_reads_foreign_files(self):
        write_hdf5(self.folder / "foreign.h5", SURFACES[:1], {})
        self.convert("foreign.h5", "own.h5")
        with tempfile.TemporaryDirectory() as elsewhere:
            alone = shutil.copy(PROGRAM, elsewhere)
            run = lambda file: subprocess.run([alone, file], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(run("own.h5").returncode, 0)
            changed = bytearray((self.folder / "own.h5").read_bytes())
            changed[-1] ^= 1  # whoever did that: it is not as we wrote it
            (self.folder / "changed.h5").write_bytes(changed)
            self.assertRegex(run("foreign.h5").stderr, "needs the program 'nurbs-read-hdf5' .*: No such file or directory")
            self.assertIn("changed.h5: changed since it was written", run("changed.h5").stderr)

    def test_an_own_file_that_has_changed_is_read_as_a_copy_without_its_checksum(self):
        write_hdf5(self.folder / "in.h5", SURFACES[:1], {"shell": ["all"]})
        self.convert("in.h5", "own.h5")
        good = (self.folder / "own.h5").read_bytes()
        at = good.find(SURFACES[0].points.tobytes())
        for changed in (good[:at] + bytes([good[at] ^ 1]) + good[at + 1 :], good + b" ", good[:-1]):  # one bit of a point, longer, cut
            (self.folder / "own.h5").write_bytes(changed)
            self.assertIn("own.h5: changed since it was written (its checksum differs): damaged or incomplete, or edited", self.refused("own.h5"))
        (self.folder / "own.h5").write_bytes(good)
        with h5py.File(self.folder / "own.h5", "r+") as file, h5py.File(self.folder / "copy.h5", "w") as copy:
            file["patches/0/weights"][0, 0] = 1.0
            for name in file:
                file.copy(name, copy)
            copy.attrs.update(file.attrs)
        self.assertIn("own.h5: changed since", self.refused("own.h5"))
        self.convert("copy.h5", "out.h5")
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(file["patches/0/weights"][0, 0], 1.0)

    def test_the_program_that_reads_foreign_files_ends_early(self):
        """Stand-ins of that program, killed as the system does it."""
        write_hdf5(self.folder / "foreign.h5", SURFACES[:1], {})
        alone = shutil.copy(PROGRAM, self.folder)
        stand_in = self.folder / "nurbs-read-hdf5"
        for signal, what in {"XCPU": "damaged: HDF5 comes to no end with it", "KILL": "nurbs-read-hdf5 was killed: more time or memory",
                             "SEGV": "damaged: HDF5 crashes on it"}.items():
            stand_in.write_text(f"#!/bin/sh\nkill -{signal} $$\n")
            stand_in.chmod(0o755)
            done = subprocess.run([alone, "foreign.h5"], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertRegex(done.stderr, rf"\AERROR: foreign.h5: {what}")

    @unittest.skipIf(SANITIZED, "takes more addresses than any limit")
    def test_values_beyond_the_memory_are_no_damage(self):
        write_hdf5(self.folder / "large.h5", SURFACES[:1], {})
        with h5py.File(self.folder / "large.h5", "r+") as file:
            del file["patches/0/knots_xi"]
            file["patches/0"].create_dataset("knots_xi", data=numpy.zeros(50_000_000, "u1"), chunks=(10**6,), compression="gzip")
        done = subprocess.run(["bash", "-c", 'ulimit -v 400000; exec "$0" large.h5', PROGRAM], cwd=self.folder, capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (1, "ERROR: large.h5: needs more memory than it may have\n"))

    def test_pipes_and_devices_are_no_files(self):
        os.mkfifo(self.folder / "pipe")
        os.mkfifo(self.folder / "pipe.h5")
        self.write("model.yaml", "units: si\ngeometry: {file: pipe.h5}\n")
        self.write("box.yaml", "units: si\ngeometry:\n  box: {origin: [0, 0, 0], size: [1, 2, 3], degree: 1, elements: [1, 1, 1]}\n")
        for words, what in {
            ("pipe",): "pipe: cannot read this file: Is a named pipe",
            ("model.yaml",): "pipe.h5: cannot read this file: Is a named pipe",
            ("/dev/zero",): "Is a device",
            ("/dev/stdin",): "Is a named pipe",
            ("box.yaml", "pipe.h5"): "pipe.h5: cannot write here: Is a named pipe",
        }.items():
            with self.subTest(words=words):
                self.assertRegex(self.refused(*words), what)

    def test_own_input_is_never_overwritten(self):
        write_hdf5(self.folder / "good.h5", SURFACES, {})
        (self.folder / "link.h5").symlink_to("good.h5")
        before = (self.folder / "good.h5").read_bytes()
        for out in ("good.h5", "./good.h5", "link.h5"):
            self.assertRegex(self.refused("good.h5", out), f"{out}: is the file good.h5 that is read and would be overwritten")
        # what a YAML file names is read, too
        self.write("wall.yaml", "units: cgs\ngeometry: {file: good.h5}\nsurfaces: {b: 0}\n")
        self.assertRegex(self.refused("wall.yaml", "link.h5", "--surface", "b"), "link.h5: is the file good.h5 that is read")
        self.assertEqual((self.folder / "good.h5").read_bytes(), before)
        # and what is written has another name until it is complete
        self.write("out.xml.part", "units: si\ngeometry:\n  box: {origin: [0, 0, 0], size: [1, 1, 1], degree: 1, elements: [1, 1, 1]}\n")
        self.assertRegex(self.refused("out.xml.part", "out.xml"), "out.xml.part: is the file out.xml.part that is read")
        self.assertIn("box", (self.folder / "out.xml.part").read_text())

    def test_nothing_unfinished_is_left(self):
        self.write("in.yaml", "units: si\ngeometry:\n  box: {origin: [0, 0, 0], size: [1, 1, 1], degree: 1, elements: [9, 9, 9]}\n")
        for out in ("out.yaml", "out.h5", "out.xml"):
            done = subprocess.run(
                [PROGRAM, "in.yaml", out], cwd=self.folder, capture_output=True, text=True, check=False,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)), restore_signals=False)
            self.assertEqual((done.returncode, done.stderr), (1, f"ERROR: {out}: cannot write here: File too large\n"))
        self.assertEqual(os.listdir(self.folder), ["in.yaml"])

    def test_wrong_input_ends_in_one_line(self):
        write_hdf5(self.folder / "good.h5", SURFACES, {})
        self.write("text.h5", "units: si\n")
        (self.folder / "cut.h5").write_bytes((self.folder / "good.h5").read_bytes()[:3000])
        self.write("trimmed.xml", "<xml>\n <TrimSurface id='0'/>\n</xml>\n")
        self.write("units.yaml", "units: si\ngeometry: {file: good.h5}\n")
        self.write("chain.yaml", "units: si\ngeometry: {file: units.yaml}\n")
        self.write("gone.yaml", "units: si\ngeometry: {file: nowhere.xml}\n")
        self.write("mixed.yaml", "units: si\n")
        table = {
            ("nowhere.h5",): "nowhere.h5: cannot read this file: No such file or directory",
            (".",): "cannot read this file: Is a directory",
            ("text.h5",): "text.h5: is no HDF5 file",
            ("cut.h5",): "cut.h5: damaged or incomplete",
            ("trimmed.xml",): "trimmed.xml:2: <TrimSurface>, expected <Geometry> or <MultiPatch>: .* not trimmed",
            ("units.yaml",): "good.h5: units are cgs, expected si as in the file that names this one",
            ("chain.yaml",): "units.yaml:2: geometry.file is good.h5 in a file that is itself read for another one",
            ("gone.yaml",): "nowhere.xml: cannot read this file",
            ("good.h5", "out.stl"): "out.stl: unknown extension, expected .yaml, .yml, .h5, .hdf5 or .xml",
            ("good.h5", "none/out.h5"): "none/out.h5: cannot write here: No such file or directory",
            ("good.h5", "--surface", "floor"): r"good.h5: unknown surface 'floor', expected one of: \(the file names none\)",
            ("trimmed.xml", "--units", "inch"): "units is 'inch', expected one of: si, cgs, mm-g-ms",
            (): "input is required",
        }
        for words, expected in table.items():
            with self.subTest(words=words):
                self.assertRegex(self.refused(*words), expected)


if __name__ == "__main__":
    unittest.main()

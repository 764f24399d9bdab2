# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of other programs, written and read by h5py, ElementTree and PyYAML, and nurbs-convert as a user runs it."""

import os
import resource
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy
import yaml

PROGRAM = os.environ["NURBS_CONVERT"]
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


class ConvertCase(unittest.TestCase):
    """Runs nurbs-convert in a folder of its own."""

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

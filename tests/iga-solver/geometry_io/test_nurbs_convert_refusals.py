# SPDX-License-Identifier: GPL-2.0-or-later
"""nurbs-convert given what it cannot or must not read, or write: one line that says why, exit code 1, and nothing lost."""

import os
import resource
import shutil
import struct
import subprocess
import tempfile
import unittest
from random import Random

import h5py
import numpy
from convert_case import PROGRAM, SANITIZED, SURFACES, ConvertCase, write_hdf5

DAMAGES = [*range(12), 15, 18, 20, 30]


class Refusals(ConvertCase):
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
            names = ["wall.yaml", "wall.h5", "wall.xml"]
            for name in names:
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
        self.write("part.stl", "solid a\nfacet\nnormal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n")
        table = {
            ("nowhere.h5",): "nowhere.h5: cannot read this file: No such file or directory",
            (".",): "cannot read this file: Is a directory",
            ("text.h5",): "text.h5: is no HDF5 file",
            ("cut.h5",): "cut.h5: damaged or incomplete",
            ("trimmed.xml",): "trimmed.xml:2: <TrimSurface>, expected <Geometry> or <MultiPatch>: .* not trimmed",
            ("units.yaml",): "good.h5: units are cgs, expected si as in the file that names this one",
            ("chain.yaml",): "units.yaml:2: geometry.file is good.h5 in a file that is itself read for another one",
            ("gone.yaml",): "nowhere.xml: cannot read this file",
            ("good.h5", "out.stp"): "out.stp: STEP or IGES files are read, not written, expected .yaml, .yml, .h5, .hdf5 or .xml",
            ("good.h5", "out.stl"): "out.stl: STL files are read, not written, expected .yaml, .yml, .h5, .hdf5 or .xml",
            ("part.stl", "out.h5"): "out.h5: HDF5 holds no triangles .STL., expected NURBS patches",
            ("good.h5", "none/out.h5"): "none/out.h5: cannot write here: No such file or directory",
            ("good.h5", "--surface", "floor"): r"good.h5: unknown surface 'floor', expected one of: \(the file names none\)",
            ("trimmed.xml", "--units", "inch"): "units is 'inch', expected one of: si, cgs, mm-g-ms, mm-t-s",
            (): "input is required",
        }
        for words, expected in table.items():
            with self.subTest(words=words):
                self.assertRegex(self.refused(*words), expected)


if __name__ == "__main__":
    unittest.main()

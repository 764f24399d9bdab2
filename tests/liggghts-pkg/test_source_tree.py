# SPDX-License-Identifier: GPL-2.0-or-later
"""The package in a LIGGGHTS source tree: Install.sh puts it there and takes it away, its sources compile with that tree's
flags (not optimised: the build itself does that), and the words it adds to Makefile.package link them.

LIGGGHTS' headers are the installed ones, and libliggghts stands for the tree's own objects.  From the environment: BUILD,
this project's build tree; LIGGGHTS_HEADERS; MODEL_LISTS, the style_*_model.h, which a tree's Make.sh writes into src;
LIGGGHTS_LIBRARY.
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "liggghts-pkg"
HEADERS, LISTS, LIBRARY = (Path(os.environ[name]) for name in ("LIGGGHTS_HEADERS", "MODEL_LISTS", "LIGGGHTS_LIBRARY"))
PLUG_IN = {"register_styles.cpp", "register_styles.h", "liggghts_nurbs.cpp"}
FLAGS = ["-O0", "-ffast-math", "-std=c++17"]  # of LIGGGHTS' own build files, but for what makes it fast
MAKEFILE_PACKAGE = """# edited by the packages
PKG_INC =   -I../../lib/poems $(FFT_INC)
PKG_PATH =  -L../../lib/poems
PKG_LIB =   -lm

PKG_SYSINC =
"""
FIX_TABLE = """
#include <map>
#include <string>
#include "lammps.h"
#include "fix.h"
#define FIX_CLASS
#define FixStyle(word, Class) {#word, 0},
const std::map<std::string, int> fixes = {
#include "fix_wall_nurbs.h"
};
#undef FIX_CLASS
#undef FixStyle
#include "fix_wall_nurbs.h"
LAMMPS_NS::Fix* make(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) { return new LAMMPS_NS::FixWallNurbs(lmp, narg, arg); }
"""


def sources(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir() if path.suffix in (".cpp", ".h")}


class SourceTree(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.prefix = Path(scratch.name) / "prefix"
        install = ["cmake", "--install", os.environ["BUILD"], "--prefix", str(cls.prefix)]
        subprocess.run(install, check=True, stdout=subprocess.DEVNULL)

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.src = Path(scratch.name) / "src"
        self.src.mkdir()
        (self.src / "Makefile.package").write_text(MAKEFILE_PACKAGE)
        (self.src / "fix_nve.h").write_text("// another fix\n")
        shutil.copytree(PACKAGE, self.src / "USER-NURBS")

    def install_sh(self, mode: int, prefix: Path | None = None) -> subprocess.CompletedProcess:
        return subprocess.run(
            ["sh", "Install.sh", str(mode)], cwd=self.src / "USER-NURBS", env=os.environ | {"NURBS": str(prefix or self.prefix)},
            capture_output=True, text=True, check=False,
        )

    def make(self, rules: str, *words: str) -> subprocess.CompletedProcess:
        """GNU make as in LIGGGHTS' folder Obj_*: Makefile.package is a copy there."""
        folder = self.src / "Obj_test"
        folder.mkdir(exist_ok=True)
        shutil.copy(self.src / "Makefile.package", folder)
        (folder / "Makefile").write_text("include Makefile.package\n" + rules)
        return subprocess.run(["make", *words], cwd=folder, capture_output=True, text=True, check=False)

    def package_words(self) -> dict[str, list[str]]:
        rules = "all:\n" + "".join(f"\t@echo '{name} = $({name})'\n" for name in ("PKG_INC", "PKG_PATH", "PKG_LIB"))
        lines = self.make(rules).stdout.splitlines()
        return {name: words.split() for name, words in (line.split(" = ", 1) for line in lines)}

    def test_install_and_uninstall(self):
        before = {path.name: path.read_bytes() for path in self.src.iterdir() if path.is_file()}
        done = self.install_sh(1)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))
        copied = sources(PACKAGE) - PLUG_IN
        self.assertEqual(sources(self.src), copied | {"fix_nve.h"})
        for name in copied:
            self.assertEqual((self.src / name).read_bytes(), (PACKAGE / name).read_bytes())
        words = self.package_words()
        self.assertEqual(words["PKG_INC"][:2], ["-fno-finite-math-only", f"-I{self.prefix}/include/liggghts-nurbs"])
        self.assertEqual(words["PKG_PATH"][0], f"-L{self.prefix}/lib")
        self.assertEqual(words["PKG_LIB"][0], "-lcoupling_contact")
        self.assertEqual([words[kind][-1] for kind in words], ["-I../../lib/poems", "-L../../lib/poems", "-lm"])

        self.install_sh(1)
        self.assertEqual(self.package_words(), words, "a second time changes nothing")

        (self.src / "USER-NURBS/run_alarm.h").write_text("// newer\n")
        self.assertEqual(self.install_sh(2).stdout, "  updating src/run_alarm.h\n")
        self.assertEqual((self.src / "run_alarm.h").read_text(), "// newer\n")

        self.assertEqual(self.install_sh(0).returncode, 0)
        self.assertEqual({path.name: path.read_bytes() for path in self.src.iterdir() if path.is_file()}, before)

    def test_without_the_libraries_nothing_is_touched(self):
        before = sorted(path.name for path in self.src.iterdir())
        done = self.install_sh(1, prefix=self.src)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"there is no '{self.src}/share/liggghts-nurbs/Makefile.nurbs'", done.stderr)
        self.assertEqual(sorted(path.name for path in self.src.iterdir()), before)

    def test_no_file_takes_the_place_of_one_of_liggghts(self):
        self.assertIn("fix_wall_gran.h", sources(HEADERS))
        stems = {Path(name).stem for name in sources(HEADERS)}
        self.assertEqual({name for name in sources(PACKAGE) if Path(name).stem in stems}, set())

    def test_sources_compile_and_link(self):
        self.assertEqual(self.install_sh(1).returncode, 0)
        (self.src / "table.cpp").write_text(FIX_TABLE)  # as modify.cpp reads it from style_fix.h
        rules = f"""
CCFLAGS = {" ".join(FLAGS)} -fPIC -I.. -I{HEADERS} -I{LISTS}
OBJECTS = $(patsubst ../%.cpp,%.o,$(wildcard ../*.cpp))
whole: $(OBJECTS)
\tmpicxx -shared -Wl,-z,defs -o $@ $(PKG_PATH) $(OBJECTS) $(PKG_LIB) {LIBRARY}
%.o: ../%.cpp
\tmpicxx $(CCFLAGS) $(PKG_INC) -c $< -o $@
"""
        done = self.make(rules, "-j2", "whole")
        self.assertEqual(done.returncode, 0, done.stdout[-500:] + done.stderr[-3000:])
        symbols = subprocess.run(["nm", "-C", self.src / "Obj_test/whole"], capture_output=True, text=True, check=True).stdout
        self.assertIn("LAMMPS_NS::FixWallNurbs::post_force(int)", symbols)
        self.assertNotRegex(symbols, r" T LAMMPS_NS::LAMMPS::create\(\)", "a tree has its own")

    def check_syntax(self, source: str, *words: str) -> subprocess.CompletedProcess:
        self.assertEqual(self.install_sh(1).returncode, 0)
        include = [word for word in self.package_words()["PKG_INC"] if word.startswith("-I")]
        command = ["mpicxx", *FLAGS, *words, f"-I{HEADERS}", f"-I{LISTS}", *include, "-fsyntax-only", source]
        return subprocess.run(command, cwd=self.src, capture_output=True, text=True, check=False)

    def test_compiles_beside_superquadrics(self):
        """`make auto` switches them on; LIGGGHTS' contact data then have more members."""
        words = ["-fno-finite-math-only", "-DSUPERQUADRIC_ACTIVE_FLAG", "-DNONSPHERICAL_ACTIVE_FLAG"]
        done = self.check_syntax("liggghts_contact_model.cpp", *words)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])

    def test_fast_math_alone_is_refused(self):
        done = self.check_syntax("fix_wall_nurbs.cpp")
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, re.escape("compile with -fno-finite-math-only after -ffast-math"))


if __name__ == "__main__":
    unittest.main()

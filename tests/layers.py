# SPDX-License-Identifier: GPL-2.0-or-later
"""The layers of the tree hold.  What a file may include follows from what its CMake target links, and what a folder may link
stands in MAY_LINK; so a new file or folder is in the layers from the start, or fails here.  No circle of files, no LIGGGHTS
header outside liggghts-pkg, an SPDX line in every source file, .clang-format kept.

usage: TARGETS=build/release/targets.json python3 layers.py
"""

import graphlib
import re
import subprocess
import unittest
from pathlib import Path

from source_tree import (
    ROOT, compiled_with, files, headers_of, imported_files, included_files, includes, owners, product, product_files,
    program_of, targets,
)  # fmt: skip

LIGGGHTS_HEADERS = {path.name for path in Path("/usr/include/liggghts").glob("*.h")}
KERNEL = "iga-solver/nurbs"
SOLVER = [f"iga-solver/{room}" for room in ("nurbs", "search", "brep", "geometry_io", "vtk", "structure", "parallel", "io")]
GEOMETRY = [KERNEL, "iga-solver/search", "iga-solver/brep"]
# folder of targets -> those that it may link, directly or not
MAY_LINK = {
    "iga-solver/nurbs": [],
    "iga-solver/search": [KERNEL],
    "iga-solver/brep": [KERNEL, "iga-solver/search"],
    "iga-solver/geometry_io": GEOMETRY,
    "iga-solver/vtk": [*GEOMETRY, "iga-solver/geometry_io"],
    "iga-solver/structure": [KERNEL],
    "iga-solver/parallel": [*GEOMETRY, *(f"iga-solver/{room}" for room in ("geometry_io", "vtk", "structure", "io"))],
    "iga-solver/io": [*GEOMETRY, "iga-solver/geometry_io", "iga-solver/vtk", "iga-solver/structure"],
    "iga-solver/app": SOLVER,
    "coupling": SOLVER,
    "liggghts-pkg": [*SOLVER, "coupling"],
}
# targets that a rigid wall needs, and what they must not have
RIGID = ("coupling", "coupling_contact", "coupling_plugin")
STRUCTURAL = ("iga-solver/structure", "iga-solver/io")
# header of a library -> what links it
LIBRARIES = {
    r"mpi\.h": "MPI::MPI_C",
    r"hdf5\.h": "hdf5::hdf5",
    r"pugixml\.hpp": "pugixml::pugixml",
    r"muParser\.h": "muparser::muparser",
    r"yaml-cpp/": "yaml-cpp",
    r"fmt/": "fmt::fmt",
    r"Eigen/": "Eigen3::Eigen",
    r"CLI/": "CLI11::CLI11",
}


def name(path: Path) -> str:
    return str(path.relative_to(ROOT))


def folders(names) -> set[str]:
    """Of these targets; libraries of others have none."""
    return {name(targets()[target].folder) for target in names if target in targets()}


class Targets(unittest.TestCase):
    def test_every_file_belongs_to_one_folder_of_targets(self):
        self.assertGreater(len(product_files()), 150)
        for path in product_files():
            self.assertEqual(len(folders(owners(path))), 1, f"{name(path)}: which target compiles it?")

    @unittest.skipIf("liggghts-pkg" not in product(), "a build without LIGGGHTS lacks what includes some")
    def test_every_header_is_included(self):
        seen = set().union(*(compiled_with(source) for target in targets().values() for source in target.sources))
        self.assertEqual([name(path) for path in product_files() if path not in seen], [])

    def test_no_link_runs_backwards(self):
        self.assertLessEqual(folders(targets()), set(MAY_LINK), "folders with targets, and the rows of MAY_LINK")
        for target in targets().values():
            own = name(target.folder)
            found = folders(program_of(target)) - {own}
            self.assertLessEqual(found, set(MAY_LINK[own]), f"what {target.name} links")

    def test_rigid_walls_have_no_structural_code(self):
        for target in RIGID:
            self.assertTrue(folders(program_of(targets()[target])).isdisjoint(STRUCTURAL), target)


class Includes(unittest.TestCase):
    def test_what_is_included_is_linked(self):
        """Of the tree's own headers, through other headers as well."""
        for target in targets().values():
            linked = headers_of(target)
            for source in target.sources:
                for path in compiled_with(source):
                    self.assertFalse(owners(path).isdisjoint(linked), f"{name(source)} of {target.name} sees {name(path)}")

    def test_libraries_that_are_included_are_linked(self):
        for target in targets().values():
            linked = headers_of(target)
            for path in (path for source in target.sources for path in compiled_with(source)):
                for pattern, library in LIBRARIES.items():
                    if any(re.match(pattern, header) for header in includes(path)):
                        self.assertIn(library, linked, f"{name(path)}, compiled in {target.name}")

    def test_mpi_is_no_business_of_the_solver(self):
        """iga-solver/parallel apart; HDF5 brings its own."""
        for path in files("iga-solver", ".h", ".cpp"):
            if "parallel" not in path.parts:
                self.assertNotIn("mpi.h", includes(path), name(path))

    def test_no_liggghts_header_outside_its_package(self):
        self.assertIn("fix_wall_gran.h", LIGGGHTS_HEADERS)
        for path in (path for folder in ("iga-solver", "coupling") for path in files(folder, ".h", ".cpp")):
            own = {header.name for header in path.parent.glob("*.h")}
            self.assertTrue((LIGGGHTS_HEADERS - own).isdisjoint(includes(path)), name(path))
        for target in targets().values():
            if "LIGGGHTS::liggghts" in target.links:
                self.assertEqual(name(target.folder), "liggghts-pkg", target.name)


class Circles(unittest.TestCase):
    def check(self, graph: dict) -> None:
        try:
            graphlib.TopologicalSorter(graph).prepare()
        except graphlib.CycleError as error:
            self.fail(" -> ".join(map(name, error.args[1])))

    def test_of_includes(self):
        """A header and the source of its name are one."""
        graph = {}
        for path in product_files() + files("tests", ".h", ".cpp"):
            stem = path.with_suffix("")
            graph.setdefault(stem, set()).update({header.with_suffix("") for header in included_files(path)} - {stem})
        self.check(graph)

    def test_of_imports(self):
        self.check({path: imported_files(path) for folder in ("inputs", "tests") for path in files(folder, ".py")})


class Text(unittest.TestCase):
    def test_every_file_names_its_licence(self):
        suffixes = (".h", ".cpp", ".py", ".cmake", ".in", ".yaml", ".map", ".md", ".svg")
        for path in (p for folder in (*product(), "inputs", "tests", ".ci") for p in (ROOT / folder).rglob("*") if p.is_file()):
            named = path.suffix in suffixes or path.name in ("CMakeLists.txt", "run", "setup") or path.name.startswith("in.")
            if named:
                head = "\n".join(path.read_text().splitlines()[:4])
                self.assertIn("SPDX-License-Identifier: GPL-2.0-or-later", head, name(path))

    def test_sources_are_formatted(self):
        sources = [str(path) for folder in (*product(), "tests") for path in files(folder, ".h", ".cpp")]
        done = subprocess.run(
            ["clang-format", "--dry-run", "-Werror", *sources], capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])


if __name__ == "__main__":
    unittest.main()

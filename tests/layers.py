# SPDX-License-Identifier: GPL-2.0-or-later
"""The layers of the tree hold: liggghts-pkg -> coupling -> iga-solver/structure -> iga-solver/nurbs, never backwards;
no LIGGGHTS header outside liggghts-pkg; no mpi.h in the geometry kernel; an SPDX line in every source file; .clang-format
kept."""

import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIGGGHTS_HEADERS = {path.name for path in Path("/usr/include/liggghts").glob("*.h")}

# folder -> what its files must not include
FORBIDDEN = {
    "iga-solver/nurbs": r"^(mpi\.h|yaml-cpp/|search/|geometry_io/|structure/|io/|vtk/|coupling/|liggghts)",
    "iga-solver/search": r"^(mpi\.h|yaml-cpp/|geometry_io/|structure/|io/|vtk/|coupling/|liggghts)",
    "iga-solver/geometry_io": r"^(mpi\.h|search/|structure/|io/|vtk/|coupling/|liggghts)",
    "iga-solver/vtk": r"^(mpi\.h|search/|structure/|io/|coupling/|liggghts)",
    "iga-solver/structure": r"^(mpi\.h|search/|geometry_io/|io/|vtk/|coupling/|liggghts)",
    "iga-solver/io": r"^(coupling/|liggghts)",
    "iga-solver/app": r"^(coupling/|liggghts)",
    "coupling": r"^liggghts",
}
# a rigid wall needs these and no structural code
RIGID = ["contact_surface", "surface_exchange", "surface_fields", "finnie", "rigid_frame", "model_text", "structure_solver",
         "fingerprint", "open_rigid_surface", "rigid/*", "contact/*"]


def includes(path: Path) -> list[str]:
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(), flags=re.M)


def sources(folder: str) -> list[Path]:
    files = [p for p in (ROOT / folder).rglob("*") if p.suffix in (".h", ".cpp")]
    assert files, folder
    return files


class Layers(unittest.TestCase):
    def test_no_include_runs_backwards(self):
        for folder, pattern in FORBIDDEN.items():
            for path in sources(folder):
                for name in includes(path):
                    self.assertNotRegex(name, pattern, f"{path.relative_to(ROOT)} includes {name}")

    def test_no_liggghts_header_outside_its_package(self):
        self.assertIn("fix_wall_gran.h", LIGGGHTS_HEADERS)
        for folder in ("iga-solver", "coupling"):
            for path in sources(folder):
                own = {p.name for p in path.parent.glob("*.h")}
                for name in includes(path):
                    self.assertFalse(name in LIGGGHTS_HEADERS - own, f"{path.relative_to(ROOT)} includes {name}")

    def test_rigid_walls_include_no_structural_code(self):
        for stem in RIGID:
            for path in (ROOT / "coupling").glob(stem + ".[hc]*"):
                for name in includes(path):
                    self.assertNotRegex(name, r"^(structure|io)/", f"{path.relative_to(ROOT)} includes {name}")

    def test_every_file_names_its_licence(self):
        suffixes = (".h", ".cpp", ".py", ".cmake", ".in", ".yaml", ".map", ".md", ".svg")
        folders = ("iga-solver", "coupling", "liggghts-pkg", "inputs", "tests", ".ci")
        for path in (p for folder in folders for p in (ROOT / folder).rglob("*") if p.is_file()):
            named = path.suffix in suffixes or path.name in ("CMakeLists.txt", "run", "setup") or path.name.startswith("in.")
            if named:
                head = "\n".join(path.read_text().splitlines()[:4])
                self.assertIn("SPDX-License-Identifier: GPL-2.0-or-later", head, str(path.relative_to(ROOT)))


    def test_sources_are_formatted(self):
        files = [str(p) for folder in (*FORBIDDEN, "liggghts-pkg", "tests") for p in sources(folder)]
        done = subprocess.run(
            ["clang-format", "--dry-run", "-Werror", *files], capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])


if __name__ == "__main__":
    unittest.main()

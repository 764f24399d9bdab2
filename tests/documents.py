# SPDX-License-Identifier: GPL-2.0-or-later
"""What the documents of the tree point at exists: their links, the files in the tables of the READMEs, and on the
theory page a place in the code for each of the paper's 37 equations."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
THEORY = ROOT / "liggghts-pkg/doc/theory.md"
FOLDERS = ("iga-solver", "coupling", "liggghts-pkg", "inputs", "tests")
SOURCE = r"[\w*/.-]+\.(?:h|cpp|py|c|cmake|svg|map|in|\*)"


def documents() -> list[Path]:
    found = [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    for folder in FOLDERS:
        found += (ROOT / folder).rglob("*.md")
    return found


def name(path: Path) -> str:
    return str(path.relative_to(ROOT))


def rows(text: str) -> list[list[str]]:
    """Cells of all table rows."""
    return [line.strip("|").split("|") for line in text.splitlines() if line.startswith("|")]


def exists(pattern: str, folder: Path) -> bool:
    """A file, by its path from the document, the folder above or the root, or as it is included; or by its name alone.
    DECK is any deck."""
    pattern = pattern.replace("DECK/", "*/")
    if any(any(base.glob(pattern)) for base in (folder, folder.parent, ROOT, ROOT / "iga-solver")):
        return True
    return "/" not in pattern and any(any((ROOT / part).rglob(pattern)) for part in FOLDERS)


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        count = 0
        for document in documents():
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", document.read_text()):
                if "://" not in target:
                    count += 1
                    self.assertTrue((document.parent / target).exists(), f"{name(document)}: {target}")
        self.assertGreater(count, 10)

    def test_files_in_tables_exist(self):
        count = 0
        for document in documents():
            for row in rows(document.read_text()):
                for pattern in re.findall(rf"`({SOURCE})`", "|".join(row)):
                    count += 1
                    self.assertTrue(exists(pattern, document.parent), f"{name(document)}: {pattern}")
        self.assertGreater(count, 100)

    def test_readmes_name_every_source_file(self):
        """In the folders whose README is a table of files."""
        for folder in ("coupling", "liggghts-pkg", "iga-solver/nurbs", "iga-solver/structure"):
            for source in (ROOT / folder).rglob("*.h"):
                readme = next(p / "README.md" for p in source.parents if (p / "README.md").is_file())
                named = rf"`(?:[\w/]+/)?{source.stem}\."
                self.assertTrue(re.search(named, readme.read_text()), f"{name(readme)} does not name {source.name}")


class Theory(unittest.TestCase):
    def setUp(self):
        self.text = THEORY.read_text()

    def test_places_in_the_code(self):
        places = re.findall(rf"`([\w-]+/{SOURCE})(?::(\w+))?`", self.text)
        self.assertGreater(len(places), 30)
        for path, function in places:
            self.assertTrue((ROOT / path).is_file(), path)
            if function:
                self.assertTrue(re.search(rf"\b{function}\b", (ROOT / path).read_text()), f"{function} in {path}")

    def test_every_equation_has_one(self):
        table = self.text.split("## Where the printed paper")[0]
        numbers = [int(n) for row in rows(table) for n in re.findall(r"\b\d+\b", row[0])]
        self.assertEqual(sorted(numbers), list(range(1, 38)))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Every example of a model file in iga-solver/io/README.md is one that iga-solve takes, and every key that a model file may
have stands in an example."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IGA_SOLVE"]
SOLVER = Path(__file__).resolve().parents[3] / "iga-solver"
README = SOLVER / "io/README.md"
# What an example leaves out.
REST = {
    "units": "units: si\n",
    "geometry": "geometry: {box: {origin: [0, 0, 0], size: [1, 1, 0.5], elements: [4, 4, 2], degree: 2}}\n",
    "material": "material: {law: neo_hooke, youngs_modulus: 1e6, poissons_ratio: 0.3, density: 1000}\n",
    "surfaces": "surfaces: {top: zeta+}\n",
    "boundary": "boundary: [{fix: [x, y, z], faces: [xi-]}]\n",
}


def key_of(entry: str) -> str:
    return entry.split(":")[0]


def examples() -> list[dict[str, str]]:
    """Top-level keys with their text; where a key comes again a block holds another example."""
    found = []
    for block in re.findall(r"```yaml\n(.*?)```", README.read_text(), re.DOTALL):
        if block.startswith(" "):  # further entries of `boundary`
            block = "boundary:\n" + block
        example: dict[str, str] = {}
        for entry in re.findall(r"(?m)^\w+:.*\n(?:[ #].*\n)*", block):
            if key_of(entry) in example:
                found.append(example)
                example = {}
            example[key_of(entry)] = entry
        found.append(example)
    return found


def known_keys() -> set[str]:
    """What the readers of model files allow, and the constants of laws."""
    keys: set[str] = set()
    for path in (SOLVER / "io").glob("*.cpp"):
        for words in re.findall(r"(?:allow_only\(|selection_keys\(|keys\.end\(\), )\{([^}]*)\}", path.read_text()):
            keys |= set(re.findall(r'"(\w+)"', words))
    laws = (SOLVER / "structure/material").glob("*.h")
    for path in laws:
        keys |= set(re.findall(r'\{"(\w+)", [^"]*\}', path.read_text()))
    return keys


class Examples(unittest.TestCase):
    def test_are_taken(self):
        self.assertGreater(len(examples()), 15)
        with tempfile.TemporaryDirectory() as folder:
            def solve(example: dict[str, str], *words: str) -> None:
                text = "".join((REST | example).values())
                (Path(folder) / "model.yaml").write_text(text)
                done = subprocess.run(
                    [PROGRAM, "model.yaml", *words], cwd=folder, capture_output=True, text=True, timeout=60, check=False
                )
                self.assertEqual(done.returncode, 0, done.stderr + text)
            box = Path(folder) / "box.yaml"
            box.write_text(REST["units"] + REST["geometry"])
            convert = [Path(PROGRAM).with_name("nurbs-convert"), "box.yaml", "block.h5"]
            subprocess.run(convert, cwd=folder, check=True, capture_output=True)
            solve({"analysis": "analysis: {kind: static, save: sagged.h5}\n"})
            for example in examples():
                with self.subTest("".join(example.values())):
                    in_a_deck = "gravity: deck" in "".join(example.values())
                    self.assertFalse(in_a_deck, "iga-solve has no deck")
                    solve(example, "--check", "--end", "1e-6")

    def test_have_each_key(self):
        text = "".join("".join(example.values()) for example in examples())
        shown = set(re.findall(r"(\w+):", re.sub("#.*", "", text)))
        self.assertGreater(len(known_keys()), 50)
        self.assertEqual(known_keys() - shown, set())


if __name__ == "__main__":
    unittest.main()

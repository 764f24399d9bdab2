# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/setup --packages with stand-ins for Debian's tools."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SETUP = Path(__file__).resolve().parents[2] / "inputs/setup"
TOOLS = "bash comm dirname env flock mkdir sed sort tail".split()

# Everything asked for is installed, but $MISSING.
DPKG_QUERY = """#!/bin/bash
for word in "$@"; do
  case $word in
    -*) ;;
    "$MISSING") echo "dpkg-query: no packages found matching $word" >&2 ;;
    *) echo "$word installed" ;;
  esac
done
[[ -z $MISSING ]]
"""
APT_GET = """#!/bin/bash
echo "apt-get $* $DEBIAN_FRONTEND" >>"$APT_CALLS"
[[ " $* " == *" ${APT_FAILS:-none} "* ]] && echo 'E: no network' && exit 100
exit 0
"""


class Packages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        for tool in TOOLS:
            (self.bin / tool).symlink_to(shutil.which(tool))
        # A root user asks nobody; anyone else goes through sudo, which here just does it.
        self.tool("sudo", '#!/bin/bash\nexec "$@"\n')
        self.tool("dpkg-query", DPKG_QUERY)
        self.tool("apt-get", APT_GET)

    def tool(self, name, text):
        (self.bin / name).write_text(text)
        (self.bin / name).chmod(0o755)

    def setup_packages(self, missing, **environment):
        calls = self.folder / "calls"
        calls.touch()
        settings = dict(PATH=str(self.bin), MISSING=missing, APT_CALLS=str(calls), **environment)
        command = [SETUP, "--packages"]
        done = subprocess.run(command, env=settings, capture_output=True, text=True, check=False)
        return done, calls.read_text().splitlines()

    def test_nothing_missing(self):
        done, calls = self.setup_packages("")
        self.assertEqual((done.returncode, done.stdout, done.stderr, calls), (0, "", "", []))

    def test_installs_what_is_missing(self):
        done, (update, install) = self.setup_packages("libcli11-dev")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "inputs/setup: installing 1 packages: libcli11-dev\n")
        self.assertRegex(update, "update noninteractive$")
        self.assertRegex(install, "install --no-install-recommends libcli11-dev noninteractive$")
        self.assertIn(" -y ", install)

    def test_apt_fails(self):
        for step in ("update", "install"):
            with self.subTest(step=step):
                done, _ = self.setup_packages("ninja-build", APT_FAILS=step)
                self.assertEqual(done.returncode, 1)
                self.assertIn("E: no network", done.stderr)
                self.assertIn(f"inputs/setup: apt-get {step} failed", done.stderr)

    def test_a_tree_that_cannot_be_written_to(self):
        inputs = self.folder / "tree/inputs"
        shutil.copytree(SETUP.parent, inputs, ignore=shutil.ignore_patterns("*.png"))
        (self.folder / "tree/build").touch()  # no folder can be made here, not even by root
        expected = "inputs/setup: cannot write to .*tree/build: build in a copy .* --solver FILE\n"
        for command in ([inputs / "setup", "--packages"], [inputs / "run", "ball_plate"]):
            with self.subTest(command=command):
                settings = dict(os.environ, PATH=f"{self.bin}:{os.environ['PATH']}", MISSING="")
                done = subprocess.run(command, env=settings, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr, f"^{expected}$")

    def test_no_debian(self):
        (self.bin / "apt-get").unlink()
        done, _ = self.setup_packages("ninja-build")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "^inputs/setup: needs a Debian-like system.*libliggghts-dev")
        self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Puts the faults of tests/mutants one by one into a copy of the tree, and says which test sees each.

The copy with its own build is build/mutants/tree; what was found is kept in build/mutants/results.json: a fault that
was caught is not tried again until its entry or its file changes (--fresh: all are)."""

import argparse
import fcntl
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import fault_list
from fault_list import ROOT, Fault, ListError

WORK = ROOT / "build" / "mutants"
TREE = WORK / "tree"
BUILD = TREE / "build" / "release"
RESULTS = WORK / "results.json"
MEMORY = 12 << 30  # bytes of a test; a fault may eat more than there is
MOST_EQUIVALENT = 0.05


def copy_tree() -> str:
    """Brings the copy to the state of the tree, touching only what differs; returns a hash of what tests depend on."""
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split("\0")
    files = {name for name in listed if name and (ROOT / name).is_file()}
    state = hashlib.sha256()
    for name in sorted(files):
        content = (ROOT / name).read_bytes()
        if not name.endswith(".md") and not name.startswith("tests/mutants/"):
            state.update(name.encode() + b"\0" + content)
        copy = TREE / name
        if not copy.is_file() or copy.read_bytes() != content:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
            shutil.copymode(ROOT / name, copy)
    for copy in TREE.rglob("*"):
        name = str(copy.relative_to(TREE))
        if copy.is_file() and name not in files and not name.startswith(("build/", "out/")):
            copy.unlink()
    return state.hexdigest()


def environment() -> dict[str, str]:
    """For builds and tests: the compiler cache, if there is one, shares what the tree itself has compiled."""
    return {
        "CCACHE_BASEDIR": str(TREE), "CCACHE_NOHASHDIR": "1", "PYTHONDONTWRITEBYTECODE": "1",
        "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        "OMPI_MCA_rmaps_base_oversubscribe": "1", **os.environ,
    }  # fmt: skip


def configure() -> None:
    if (BUILD / "build.ninja").exists():
        return
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", "-DCMAKE_C_COMPILER_LAUNCHER=ccache"]
    # Each file by itself: a fault costs the compilation of one.
    command = ["cmake", "--preset", "release", "-DCMAKE_UNITY_BUILD=OFF", *(launcher if shutil.which("ccache") else [])]
    subprocess.run(command, cwd=TREE, env=environment(), check=True, stdout=subprocess.DEVNULL)


def build(targets) -> str:
    """Builds the targets; returns what the compiler or ninja says if that fails."""
    done = subprocess.run(["ninja", "-C", BUILD, *targets], env=environment(), capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stdout[-3000:] + done.stderr


class Test:
    """A test of ctest, or one case of a test in Python."""

    def __init__(self, entry: dict, case: str):
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.name = entry["name"] + (f": {case}" if case else "")
        self.command = entry["command"]
        if any(word.endswith(".py") for word in self.command) or "unittest" in self.command:
            self.command = [*self.command, "-f", *case.split()]
        self.environment = dict(pair.split("=", 1) for pair in properties.get("ENVIRONMENT", []))
        self.cwd = properties.get("WORKING_DIRECTORY", BUILD)
        self.seconds = float(properties.get("TIMEOUT", 600))

    def failure(self) -> str:
        """What failed; nothing if the test passes."""
        process = subprocess.Popen(
            self.command, cwd=self.cwd, env={**environment(), **self.environment}, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY)),
        )  # fmt: skip
        try:
            said, _ = process.communicate(timeout=self.seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return f"{self.name} (no end after {self.seconds:g} s)"
        if process.returncode == 0:
            return ""
        case = re.search(r"^(?:FAIL|ERROR): (\w+)", said, re.M)
        return self.name + (f", {case[1]}" if case and case[1] not in self.name else "")


def tests_of(fault: Fault) -> list[Test]:
    """Those that the entry names."""
    shown = subprocess.run(
        ["ctest", "--test-dir", BUILD, "--show-only=json-v1"], env=environment(), capture_output=True, text=True, check=True
    )
    entries = json.loads(shown.stdout)["tests"]
    found = []
    for wanted in fault.tests:
        pattern, _, case = wanted.partition(": ")
        matching = [entry for entry in entries if re.search(pattern, entry["name"]) and "command" in entry]
        if not matching:
            raise ListError(f"no test is called {pattern!r}: adapt the {fault.where()}")
        found += [Test(entry, case) for entry in matching]
    return list({test.name: test for test in found}.values())


class Results:
    """What was found before."""

    def __init__(self):
        self.known = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}

    def save(self, key: str, value) -> None:
        self.known[key] = value
        RESULTS.write_text(json.dumps(self.known, indent=1))


def key_of(fault: Fault) -> str:
    return hashlib.sha256((fault.text + (ROOT / fault.file).read_text()).encode()).hexdigest()


def check_sound_tree(fault: Fault, seconds: dict[str, float]) -> None:
    """A test that fails without the fault says nothing about it; measures how long each takes."""
    for test in tests_of(fault):
        if test.name in seconds:
            continue
        begin = time.monotonic()
        if failure := test.failure():
            raise ListError(f"{failure} fails without a fault, too; needed by the {fault.where()}")
        seconds[test.name] = round(time.monotonic() - begin, 2)


def first_failure(fault: Fault, seconds: dict[str, float]) -> str:
    """The first test that fails with the fault in the copy, the quickest tests tried first; nothing if all pass."""
    path = TREE / fault.file
    sound = path.read_text()
    try:
        path.write_text(fault.applied(sound))
        if words := build(fault.targets):
            raise ListError(f"{fault.where()} does not build:\n{words}")
        tests = sorted(tests_of(fault), key=lambda test: seconds.get(test.name, 0.0))
        return next((failure for test in tests if (failure := test.failure())), "")
    finally:
        path.write_text(sound)


def try_all(faults: list[Fault], fresh: bool) -> dict[str, list[Fault]]:
    """Tries each and says at once what came of it."""
    results = Results()
    state = copy_tree()
    configure()
    if words := build(sorted({target for fault in faults for target in fault.targets})):
        raise ListError(f"the tree does not build:\n{words}")
    outcome = {"caught": [], "equivalent": [], "survived": [], "in error": []}
    seconds = results.known.get(state, {})  # of each test that passes on this tree
    for i, fault in enumerate(faults):
        begin = time.monotonic()
        by = "" if fresh else results.known.get(key_of(fault), "")
        try:
            if not by:
                build(fault.targets)
                check_sound_tree(fault, seconds)
                by = first_failure(fault, seconds)
            verdict = "caught" if by else "equivalent" if fault.equivalent else "survived"
            if by and fault.equivalent:
                raise ListError(f"{fault.where()} is said to be equivalent, yet it was caught by {by}")
            if by:
                results.save(key_of(fault), by)
        except ListError as error:
            verdict, by = "in error", str(error)
        results.save(state, seconds)
        outcome[verdict].append(fault)
        said = {"caught": f"by {by}", "equivalent": fault.equivalent, "survived": fault.breaks, "in error": by}[verdict]
        took = time.monotonic() - begin
        print(f"{i + 1:3}/{len(faults)} {fault.name:40} {took:5.0f} s  {verdict} {said}", flush=True)
    return outcome


def main() -> int:
    parser = argparse.ArgumentParser(prog="tests/run --mutants", description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME|FILE", help="faults, or files of tests/mutants; all")
    parser.add_argument("--fresh", action="store_true", help="try those again that were caught before")
    options = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that the fault is taken out of the copy
    with open(WORK / "lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # one copy, one at a time
        try:
            faults = fault_list.select(fault_list.read_all(), options.names)
            outcome = try_all(faults, options.fresh)
        except ListError as error:
            print(f"tests/mutants: {error}", file=sys.stderr)
            return 1
    print(", ".join(f"{len(found)} {verdict}" for verdict, found in outcome.items() if found or verdict != "in error"))
    for verdict in ("survived", "in error"):
        for fault in outcome[verdict]:
            print(f"{verdict}: {fault.name} ({fault.file}): {fault.breaks}")
    too_many = len(outcome["equivalent"]) > max(1, MOST_EQUIVALENT * len(faults))
    return 1 if outcome["survived"] or outcome["in error"] or too_many else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: check_symbols.py NM OBJECT...
Objects compiled for newer instruction sets define functions of the namespace that is named after the set and share nothing:
a weak symbol (an inline function or a template) may be what the linker picks for the whole program, which then fails on
older processors."""

import subprocess
import sys

if __name__ == "__main__":
    nm, *objects = sys.argv[1:]
    if not objects:
        sys.exit(__doc__)
    for path in objects:
        lines = subprocess.run([nm, "-C", path], capture_output=True, text=True, check=True).stdout.splitlines()
        entries = [line[17:].split(maxsplit=1) for line in lines]
        shared = [name for kind, name in entries if kind in "uVvWw"]
        defined = [name for kind, name in entries if kind in "TDBR"]
        if shared:
            sys.exit(f"{path} defines symbols that the linker may share: {shared}")
        if not defined or not all("::avx2::" in name or "::avx512::" in name for name in defined):
            sys.exit(f"{path} defines {defined}, expected functions of avx2 or avx512 alone")

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What the bin of inputs/hopper_step costs as a wall: a search beside OpenCASCADE's, memory beside LIGGGHTS' triangles, reading
beside OpenCASCADE's own.  usage: cad_costs.py BUILD_FOLDER"""

import resource
import subprocess
import sys
import tempfile
from pathlib import Path

DECK = """units si
atom_style granular
boundary f f f
newton off
communicate single vel yes
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
neighbor 0.01 bin
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.45
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran model hertz tangential history
pair_coeff * *
timestep 1e-5
create_atoms 1 single 0 0 0.9
set group all diameter 0.01 density 1000
fix integration all nve/sphere
{wall}
run 1
"""
WALLS = {
    "no wall": "",
    "triangles within 0.1 mm": """fix mesh all mesh/surface file wall.stl type 1 scale 0.001
fix wall all wall/gran model hertz tangential history mesh n_meshes 1 meshes mesh""",
    "wall/nurbs": "fix wall all wall/nurbs model hertz tangential history type 1 geometry wall.h5 surface all",
}


def measured(command: list, **how) -> tuple[float, float]:
    """Seconds of the processor and MiB at most, of one process."""
    child = f"import resource, subprocess, sys; subprocess.run({[str(word) for word in command]!r}, stdin=sys.stdin, stdout=subprocess.DEVNULL, check=True); u = resource.getrusage(resource.RUSAGE_CHILDREN); print(u.ru_utime + u.ru_stime, u.ru_maxrss / 1024)"
    done = subprocess.run([sys.executable, "-c", child], capture_output=True, text=True, check=True, **how)
    seconds, mib = done.stdout.split()[-2:]
    return float(seconds), float(mib)


def main() -> None:
    build = Path(sys.argv[1]).resolve()
    part = Path(__file__).resolve().parents[3] / "inputs/hopper_step/hopper.step"
    step, app = build / "tests/iga-solver/step", build / "iga-solver/app"
    subprocess.run([step / "step_cost", part], check=True)

    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([step / "make_step_parts", "--stl", part, "0.1", "wall.stl"], cwd=folder, check=True)
        subprocess.run([app / "nurbs-convert", part, "wall.h5"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        memory = {}
        for name, wall in WALLS.items():
            Path(folder, "in.deck").write_text(DECK.format(wall=wall))
            memory[name] = measured([build / "liggghts-pkg/liggghts-nurbs", "-in", "in.deck"], cwd=folder)[1]
        triangles = (Path(folder, "wall.stl").stat().st_size - 84) // 50
        stock, own = (memory[name] - memory["no wall"] for name in list(WALLS)[1:])
        print(f"memory beyond a deck without walls: {triangles} triangles {stock:.1f} MiB, wall/nurbs {own:.1f}: {own / stock:.2f}")

    def least(command: list, **how) -> float:
        return min(measured(command, **how)[0] for _ in range(7))

    alone = least([step / "step_cost", "--read", part])
    with part.open() as file:
        ours = min((file.seek(0), measured([app / "nurbs-read-step"], stdin=file)[0])[1] for _ in range(7))
    print(f"reading: nurbs-read-step {ours:.3f} s, STEPCAFControl_Reader alone {alone:.3f}: {ours / alone:.2f}")


if __name__ == "__main__":
    main()

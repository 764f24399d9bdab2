# SPDX-License-Identifier: GPL-2.0-or-later
"""Whatever moves or changes a particle between two steps or runs is met by a flat wall as by LIGGGHTS' own plane."""

import unittest
from dataclasses import replace

import numpy as np

import decks
from prelude import Prelude

FLOOR = """
units: si
geometry:
  plane: {origin: [-0.06, -0.06, 0], edges: [[0.12, 0, 0], [0, 0.12, 0]], elements: [24, 24], degree: 2}
surfaces: {floor: all}
"""
MODELS = "model hertz tangential history rolling_friction epsd2"
WALLS = {
    decks.STOCK: f"wall/gran {MODELS} primitive type 3 zplane 0.",
    decks.NURBS: f"wall/nurbs {MODELS} type 3 geometry floor.yaml surface floor",
}
START = Prelude(
    "-0.06 0.06 -0.06 0.06 -0.05 0.05", E=(1e7, 2e7, 3e7), nu=(0.3, 0.25, 0.2),
    e=(0.5, 0.6, 0.7, 0.6, 0.7, 0.8, 0.7, 0.8, 0.9), mu=(0.3, 0.4, 0.5, 0.4, 0.5, 0.2, 0.5, 0.2, 0.3),
    further={"coefficientRollingFriction": 0.1}, models=MODELS, timestep=1e-6, skin=2e-3, lists="delay 0",
)
# Three balls of 5 mm: above the plane, sliding on it, and below it, each too far from the others to touch them.
BALLS = """\
create_atoms 1 single -0.0313 0.0012 0.0052 units box
create_atoms 1 single 0.0017 0.0004 0.00499 units box
create_atoms 1 single 0.0329 -0.0008 -0.0051 units box
set group all diameter 0.01 density 2500
set atom 1 vz -0.1 vx 0.2
set atom 2 vx 0.5 vy 0.1
set atom 3 vz 0.2 vy -0.3
compute spin all property/atom omegax omegay omegaz tqx tqy tqz
compute rad all property/atom radius
fix wall all {wall}
fix integrate all nve/sphere
"""
QUANTITIES = [f"{q}[{{0}}]" for q in ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz")]
QUANTITIES += [f"c_spin[{{0}}][{k}]" for k in range(1, 7)] + ["c_rad[{0}]"]
COLUMNS = "".join(
    f"variable q{ball}_{k} equal {quantity.format(ball)}\n" for ball in (1, 2, 3) for k, quantity in enumerate(QUANTITIES)
)
COLUMNS += (
    "thermo_style custom step "
    + " ".join(f"v_q{ball}_{k}" for ball in (1, 2, 3) for k in range(len(QUANTITIES)))
    + "\nthermo_modify format float %.17g lost error\nthermo 5\n"
)
GROW = "variable size atom {factor}*2.*c_rad\nfix grow all adapt {every} atom diameter v_size\n"
CHANGES = {
    "growth": GROW.format(factor=1.0005, every=1) + "run 300\nunfix grow\nrun 300",
    # many skins without a new list of LIGGGHTS', but for stock, which would miss the contact
    "growth_at_rest": "velocity all set 0 0 0\nset group all z 0.02\nset atom 3 z -0.008\nunfix integrate\n"
    "neigh_modify every {lists} check no\n"
    + GROW.format(factor=1.02, every=5)
    + "run 400",
    "shrinking": GROW.format(factor=0.9995, every=2) + "run 300\nunfix grow\nrun 300",
    # a contact that ends by shrinking, and what comes after it is another
    "shrinking_to_a_gap_and_back": "velocity all set 0.2 0 0\nset group all z 0.00505\nunfix integrate\n"
    'variable size atom "0.01 + 0.0002 * ((step>=100)*(step<200) + (step>=300))"\nfix grow all adapt 1 atom diameter v_size\nrun 400',
    "growth_of_the_gap": "set group all z 0.0052\nvelocity all set 0 0 0\n" + GROW.format(factor=1.0002, every=1) + "run 600",
    "set_diameter": "run 100\nset group all diameter 0.0108\nrun 200\nset group all diameter 0.0096\nrun 200",
    "set_diameter_in_a_run": 'run 300 every 60 "set group all diameter 0.0104" "set atom 2 vx -0.2"',
    "set_density_and_type": "run 150\nset group all density 4000\nset atom 2 type 2\nset atom 1 type 3\nrun 250",
    "displace_within_contact": "run 150\ndisplace_atoms all move 0.00002 -0.00001 -0.00003 units box\nrun 200",
    "displace_far": "run 150\ndisplace_atoms all move 0.011 0.017 0 units box\nrun 200",
    "displace_through": "run 150\ndisplace_atoms all move 0 0 -0.0101 units box\nrun 200",
    "displace_away_and_back": "run 150\ndisplace_atoms all move 0 0 0.0006 units box\nrun 50\ndisplace_atoms all move 0 0 -0.0006 units box\nrun 200",
    # a new contact; LIGGGHTS' plane keeps the spring of a ball that is put out of its list, so stock gets a new plane
    "displace_off_the_list_and_back": "run 150\ndisplace_atoms all move 0 0 0.02 units box\nrun 50\n{new_plane}"
    "displace_atoms all move 0 0 -0.02 units box\nrun 200",
    "set_position_and_velocity": "run 150\nset atom 1 x 0.0 y 0.03 z 0.00495\nset atom 3 vz 3.0\nrun 200",
    "velocity": "run 150\nvelocity all set -0.3 0.4 -0.8 units box\nrun 300",
    "ramp_of_velocity": "run 100\nvelocity all ramp vz -2 2 x -0.06 0.06 units box\nrun 300",
    "timestep": "run 100\ntimestep 3e-6\nrun 100\ntimestep 5e-7\nrun 200",
    "skin": "run 100\nneighbor 0.0001 bin\nrun 200\nneighbor 0.004 bin\nrun 100",
    "wall_defined_anew": "run 100\nunfix wall\nrun 50\nfix wall all {wall}\nrun 200",
    "new_ball": "create_atoms 1 single 0 0.04 0.0046 units box\nset atom 4 diameter 0.01 density 2500 vz -0.5 vx 0.3\nrun 300",
    "group_pre_no": "unfix wall\ngroup some id 1\nfix wall some {wall}\nrun 100\ngroup some id 2\nrun 100 pre no\ngroup some id 3\nrun 100 pre no",
    "pre_no": "run 100\nset group all diameter 0.0103\nrun 200 pre no",
}
INSERTION = """
region above block -0.05 0.05 -0.05 0.05 -0.004 0.0049 units box
fix pts all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 0.005
fix pdd all particledistribution/discrete 32452843 1 pts 1.0
fix ins all insert/pack seed 32452867 distributiontemplate pdd maxattempt 200 insert_every 40 overlapcheck yes all_in no &
  vel constant 0.2 0. -0.3 region above particles_in_region 12
compute sum all reduce sum fx fy fz vx vy vz x y z
thermo_style custom step atoms ke c_sum[1] c_sum[2] c_sum[3] c_sum[4] c_sum[5] c_sum[6] c_sum[7] c_sum[8] c_sum[9]
thermo_modify format float %.17g lost ignore
thermo 1
run 100
"""


def run(program: str, body: str, ranks: int, columns: str = COLUMNS) -> decks.Run:
    head = replace(START, processors="2 1 1" if ranks == 2 else "* * *").text() + BALLS.format(wall=WALLS[program])
    lists, new_plane = ("1", "unfix wall\nfix wall all {wall}\n") if program == decks.STOCK else ("1000", "")
    body = body.replace("{lists}", lists).replace("{new_plane}", new_plane).replace("{wall}", WALLS[program])
    deck = head + columns + body + "\n"
    return decks.good(deck, files={"floor.yaml": FLOOR}, ranks=ranks, program=program)


class ChangedParticles(unittest.TestCase):
    def check(self, body: str, ranks: int, columns: str = COLUMNS, tolerance: float = 1e-11) -> None:
        ours, stock = (run(program, body, ranks, columns).table for program in (decks.NURBS, decks.STOCK))
        self.assertGreater(max(np.ptp(stock[name]) for name in stock), 0.0)
        for name in stock:
            self.assertLessEqual(decks.largest_difference(ours[name], stock[name]), tolerance, name)

    def test_changes_as_on_stock_plane(self):
        for name, body in CHANGES.items():
            for ranks in (1, 2):
                with self.subTest(change=name, ranks=ranks):
                    self.check(body, ranks)

    def test_insertion_with_overlap(self):
        self.check(INSERTION, 1, columns="")


if __name__ == "__main__":
    unittest.main()

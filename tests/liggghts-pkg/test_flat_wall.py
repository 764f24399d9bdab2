# SPDX-License-Identifier: GPL-2.0-or-later
"""A flat fixed NURBS patch is LIGGGHTS' own plane: same forces, torques, motion and energies to round-off."""

import unittest

import decks
from prelude import Prelude

FLAT = """
units: si
geometry:
  plane: {origin: [%(x0)g, %(y0)g, 0], edges: [[%(lx)g, 0, 0], [0, %(ly)g, 0]], elements: [%(nx)d, %(ny)d], degree: 2}
surfaces: {floor: all}
"""

WALLS = {
    decks.STOCK: "wall/gran {models} primitive type 2 zplane 0.",
    decks.NURBS: "wall/nurbs {models} type 2 geometry flat.yaml surface floor",
}

# One ball bounces off the wall; with vx > 0 it changes ranks during the contact.
BOUNCE = (
    """\
create_atoms 1 single -0.000002 0.0003 0.001 units box
# at rest, out of reach: a rank without any atom cannot evaluate c_spin[1][4]
create_atoms 1 single -0.003 0 0.003 units box
create_atoms 1 single 0.003 0 0.003 units box
set group all diameter 0.002 density 2480
set atom 1 vx {vx} vy 0.2 vz -1.0
fix wall all {wall}
fix integrate all nve/sphere
compute spin all property/atom omegax omegay omegaz tqx tqy tqz
compute rot all erotate/sphere
variable fx equal fx[1]
variable fy equal fy[1]
variable fz equal fz[1]
variable tx equal c_spin[1][4]
variable ty equal c_spin[1][5]
variable tz equal c_spin[1][6]
"""
    + decks.BALL
    + """\
thermo_style custom step v_fx v_fy v_fz v_tx v_ty v_tz v_x v_y v_z v_vx v_vy v_vz v_wx v_wy v_wz ke c_rot
thermo_modify format float %.17g lost error
thermo 1
run 600
"""
)

MODELS = {
    "hertz": ("model hertz tangential no_history", 1.0, 0.0),
    "history": ("model hertz tangential history", 0.7, 0.3),
    "epsd2": ("model hertz tangential history rolling_friction epsd2", 0.7, 0.3),
    "hooke": ("model hooke tangential history rolling_friction epsd2", 0.7, 0.3),
    "hysteresis": ("model hooke/hysteresis tangential history", 0.7, 0.3),
    "cohesion": ("model hertz tangential history cohesion sjkr rolling_friction cdt", 0.7, 0.3),
}

# Three balls roll 0.15 m over 160 elements and a rank border, 60,000 steps.
ROLL = """\
create_atoms 1 single -0.09 -0.006 0.001 units box
create_atoms 1 single -0.02 0.0005 0.001 units box
create_atoms 1 single 0.08 0.006 0.001 units box
set group all diameter 0.002 density 2500
set atom 1 vx 0.35 vy 0.005
set atom 2 vx 0.15
set atom 3 vx -0.33 vy -0.004
fix g all gravity 9.81 vector 0 0 -1
fix wall all {wall}
fix integrate all nve/sphere
compute spin all property/atom omegax omegay omegaz
{columns}
thermo_modify format float %.17g lost error
thermo 1000
run 60000
"""
MODEL_ROLL = "model hertz tangential history rolling_friction epsd2"


def before_the_bounce(models: str, e: float, mu: float, ranks: int) -> str:
    pairs = dict(coefficientRollingFriction=0.1, cohesionEnergyDensity=1e6, characteristicVelocity="scalar 1.0")
    pairs |= dict(coefficientMaxElasticStiffness=1.5, coefficientAdhesionStiffness=0.1, coefficientPlasticityDepth=0.05)
    return Prelude(
        "-0.004 0.004 -0.004 0.004 -0.001 0.004", E=(74.6e9, 210.6e9), nu=(0.2285, 0.286), e=e, mu=mu, further=pairs,
        models=models, timestep=1e-8, lists="every 50 delay 0 check no", processors=f"{ranks} 1 1", particles="hard",
    ).text()


def before_they_roll(ranks: int) -> str:
    return Prelude(
        "-0.1 0.1 -0.01 0.01 -0.001 0.004", E=(1e8, 1e8), nu=(0.3, 0.3), e=0.5, mu=0.5, models=MODEL_ROLL, timestep=1e-5,
        further=dict(coefficientRollingFriction=0.001), skin=5e-4, processors=f"{ranks} 1 1",
    ).text()


def flat(x0, y0, lx, ly, nx, ny):
    return {"flat.yaml": FLAT % dict(x0=x0, y0=y0, lx=lx, ly=ly, nx=nx, ny=ny)}


def columns_of_three_balls() -> str:
    names, lines = [], []
    for ball in (1, 2, 3):
        for value in ("x", "y", "z", "vx", "vy", "vz"):
            names.append(f"v_{value}{ball}")
            lines.append(f"variable {value}{ball} equal {value}[{ball}]")
        for k, value in enumerate(("wx", "wy", "wz"), 1):
            names.append(f"v_{value}{ball}")
            lines.append(f"variable {value}{ball} equal c_spin[{ball}][{k}]")
    return "\n".join(lines) + "\nthermo_style custom step " + " ".join(names)


def kind(column: str) -> str:
    """Position, velocity, spin or step of a column such as vx2."""
    return {"v": "velocity", "w": "spin", "S": "step"}.get(column[0], "position")


class FlatWall(unittest.TestCase):
    def bounce(self, program, models, e, mu, ranks):
        deck = before_the_bounce(models, e, mu, ranks)
        deck += BOUNCE.format(vx=0.7 if mu else 0.0, wall=WALLS[program].format(models=models))
        # 0.0101 m in 13 elements: feet and element borders fall anywhere
        return decks.good(deck, files=flat(-0.005, -0.005, 0.0101, 0.0097, 13, 11), ranks=ranks, program=program).table

    def test_bounce_equals_stock_plane(self):
        for name, (models, e, mu) in MODELS.items():
            stock = self.bounce(decks.STOCK, models, e, mu, 1)
            self.assertGreater(stock["fz"].max(), 1.0, "the ball touches")
            for ranks in (1, 2):
                ours = self.bounce(decks.NURBS, models, e, mu, ranks)
                for column, reference in stock.items():
                    with self.subTest(models=name, ranks=ranks, column=column):
                        self.assertEqual(len(reference), 601)
                        self.assertLessEqual(decks.largest_difference(ours[column], reference), 1e-11)

    def test_rolling_balls_stay_with_their_stock_twins(self):
        def roll(program, ranks):
            wall = WALLS[program].format(models=MODEL_ROLL)
            deck = before_they_roll(ranks) + ROLL.format(columns=columns_of_three_balls(), wall=wall)
            return decks.good(deck, files=flat(-0.11, -0.012, 0.22, 0.024, 161, 17), ranks=ranks, program=program).table

        stock = roll(decks.STOCK, 1)
        self.assertGreater(stock["x1"][-1], 0.05, "the first ball crosses the rank border at x = 0")
        self.assertLess(stock["x3"][-1], -0.05, "so does the third, the other way")
        for ranks in (1, 2):
            ours = roll(decks.NURBS, ranks)
            for column, reference in stock.items():
                with self.subTest(ranks=ranks, column=column):
                    # measured against the largest of its kind: some components (y of ball 2) are round-off
                    scale = max(abs(stock[c]).max() for c in stock if kind(c) == kind(column))
                    self.assertLessEqual(abs(ours[column] - reference).max() / scale, 1e-6)


if __name__ == "__main__":
    unittest.main()

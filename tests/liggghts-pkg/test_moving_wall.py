# SPDX-License-Identifier: GPL-2.0-or-later
"""Flat NURBS walls that move beside LIGGGHTS' triangles moved by fix move/mesh with the same words, and beside theory."""

import math
import re
import unittest

import numpy as np

import decks
import moving_wall as mw

MODELS = "model hertz tangential history"
VARIABLES = """
variable wall_vx equal 0.1*sin(step*0.02)
variable wall_vy equal -0.2
variable wall_vz equal 0.5*cos(step*0.01)
variable rate equal 300*cos(step*0.01)
"""
# one line of words for each fix move/mesh; several act in the order given
ROTATE = "rotate origin 0.001 -0.001 -0.0005 axis 1 2 0.5 period 0.02"
MOTIONS = {
    "linear": ["linear 0.1 -0.2 0.5"],
    "linear/variable": ["linear/variable v_wall_vx v_wall_vy v_wall_vz"],
    "wiggle": ["wiggle amplitude 0.00002 0 0.00005 period 5e-4"],
    "rotate": [ROTATE],
    "rotate/variable": ["rotate/variable origin 0.001 -0.001 0 axis 1 2 0.5 omega v_rate"],
    "riggle": ["riggle origin 0.001 -0.001 0 axis 1 2 0.5 period 5e-4 amplitude 1.5"],
    "viblin": ["viblin axis 0.1 0.2 1 order 2 amplitude 2e-5 1e-5 phase 1.3 2 period 4e-4 3e-4"],
    "vibrot": ["vibrot origin 0 0 0 axis 1 0.2 0 order 2 amplitude 0.02 0.01 phase 0.3 2 period 4e-4 3e-4"],
    "rotate, then linear": [ROTATE, "linear 0.1 -0.2 0.3"],
    "linear, then rotate": ["linear 0.1 -0.2 0.3", ROTATE],
    "linear, then riggle": ["linear 0.1 0 0", "riggle origin 0.001 -0.001 0 axis 1 2 0.5 period 5e-4 amplitude 1.5"],
}
EPICYCLE = [ROTATE, "rotate origin 0.003 0.002 0 axis 0 1 0 period 0.03"]

PRESS = "com 0 0 2.01033e-3 ctrlPV force axis 0 0 1 target_val -0.02 vel_max 0.05"
SERVOS = {
    "p": PRESS + " kp 0.5",
    "pid": PRESS + " kp 0.5 ki 1000 kd 1e-6",
    "variable target": PRESS.replace("-0.02", "v_target") + " kp 0.5",
    "auto": PRESS + " mode auto ratio 3e-4",
}


class ServoDeck:
    """A ball on a floor, and above it the wall, which starts 0.01033 mm away and presses down."""

    options = dict(
        balls=((3e-3, -2e-3, 1e-3),), velocity=(0, 0, 0), mu=0, dt=2e-6,
        before="variable target equal -0.02+0.01*exp(-0.005*step)\n"
        f"fix floor all wall/gran {MODELS} primitive type 2 zplane 0.",
    )
    files = {"flat.yaml": mw.NURBS_FILE.replace(", 0], edges", ", 2.01033e-3], edges"), "flat.stl": mw.triangles("2.01033e-3")}
    columns = "variable push equal {push}\nvariable height equal {height}"

    def ours(self, words: str, restart: str = "") -> str:
        more = self.columns.format(push="f_wall[3]", height="2.01033e-3+f_wall[20]")
        wall = mw.nurbs_wall(MODELS, "servo " + words)
        return mw.deck(wall, restart=restart, **self.options) + mw.output(more, "v_push v_height")

    def stock(self, words: str) -> str:
        # the module stress stands before servo, and gives the first six columns
        more = self.columns.format(push="f_cad[3]", height="f_cad[9]")
        wall = mw.stock_wall(MODELS, style="mesh/surface/stress/servo", drive=words)
        return mw.deck(wall, **self.options) + mw.output(more, "v_push v_height")


SERVO_DECK = ServoDeck()


def as_motions(motions) -> str:
    return " ".join("motion " + words for words in motions)


class BesideStock(unittest.TestCase):
    def compare(self, ours, stock, tolerance):
        for kind, difference in mw.largest_differences(ours, stock).items():
            self.assertLessEqual(difference, tolerance, kind)

    def test_each_verb_of_fix_move_mesh(self):
        for name, motions in MOTIONS.items():
            with self.subTest(name):
                ours, stock = mw.both(
                    as_motions(motions), {"motions": motions}, mw.output() + "run 800\n", before=VARIABLES
                )
                self.assertGreater(stock["fz"].max(), 0.05, "the ball touches")
                self.assertEqual(stock["fz"][-1], 0.0, "and leaves")
                self.compare(ours, stock, 1e-10)

    def test_rolling_friction_on_a_moving_wall(self):
        motions = MOTIONS["linear, then rotate"]
        ours, stock = mw.both(
            as_motions(motions), {"motions": motions}, mw.output() + "run 800\n", models=MODELS + " rolling_friction epsd2"
        )
        self.assertGreater(stock["fz"].max(), 0.05)
        self.compare(ours, stock, 1e-10)

    def test_a_rotation_carries_the_next(self):
        # the wall's place is LIGGGHTS'; of two rotations at once its velocities are not those of a rigid body (they differ
        # in first order of the timestep), so forces are compared that do not depend on velocities
        ours, stock = mw.both(
            as_motions(EPICYCLE), {"motions": EPICYCLE}, mw.output() + "run 800\n", e=1, mu=0,
            models="model hertz tangential no_history",
        )
        self.assertGreater(stock["fz"].max(), 0.05)
        self.compare(ours, stock, 1e-10)

    def test_belts_and_rollers(self):
        for words in ("surface_vel 0.7 0.2 0", "surface_vel v_wall_vx 0.2 0.0", "surface_vel 0.3 0 0.4",
                      "surface_ang_vel origin 0.001 -0.001 0 axis 0 0 2 omega 300"):
            with self.subTest(words):
                ours, stock = mw.both(words, {"drive": words}, mw.output() + "run 800\n", before=VARIABLES)
                self.assertGreater(stock["fz"].max(), 0.05)
                self.compare(ours, stock, 1e-10)

    def test_an_image_of_a_wall_that_turns_into_the_box(self):
        """From below; the box is periodic along its axis.  LIGGGHTS' mesh stands where the image is, in a larger box."""
        turn = "rotate origin 0 0 0 axis 0 1 0 period 0.025"
        options = dict(balls=((-5e-3, 0.014, 1.8e-3),), velocity=(0, 0, 0), dt=2e-6)
        periodic = dict(box="-0.04 0.04 -0.004 0.016 0.0017 0.02", boundary="f p f")
        small = mw.deck(mw.nurbs_wall(MODELS, "motion " + turn), **periodic, **options)
        large = mw.deck(
            mw.stock_wall(MODELS, [turn], drive="move 0 0.02 0"), box="-0.04 0.04 -0.02 0.04 -0.02 0.02", **options
        )
        run = mw.output() + "run 800\n"
        ours = decks.good(small + run, files=mw.FILES).table
        stock = decks.good(large + run, files=mw.FILES, program=decks.STOCK).table
        self.assertGreater(stock["fz"].max(), 0.05)
        self.compare(ours, stock, 1e-10)

    def test_a_roller_beyond_a_periodic_face(self):
        """Its surface moves as where it is, however many boxes away it is met."""
        words = "surface_ang_vel origin 0.001 {} 0 axis 0 0 2 omega 300"
        options = dict(balls=((3e-3, 0.0145, 1.05e-3),))
        small = mw.deck(mw.nurbs_wall(MODELS, words.format(-1e-3)), box="-0.04 0.04 -0.004 0.016 -0.02 0.02", boundary="f p f", **options)
        large = mw.deck(mw.stock_wall(MODELS, drive="move 0 0.02 0 " + words.format(0.019)), box="-0.04 0.04 -0.02 0.04 -0.02 0.02", **options)
        run = mw.output() + "run 800\n"
        ours = decks.good(small + run, files=mw.FILES).table
        stock = decks.good(large + run, files=mw.FILES, program=decks.STOCK).table
        self.assertGreater(stock["fz"].max(), 0.05)
        self.compare(ours, stock, 1e-10)

    def test_servo_with_the_words_of_the_mesh_module(self):
        for name, words in SERVOS.items():
            with self.subTest(name):
                ours = decks.good(SERVO_DECK.ours(words) + "run 4000\n", files=SERVO_DECK.files).table
                stock = decks.good(SERVO_DECK.stock(words) + "run 4000\n", files=SERVO_DECK.files, program=decks.STOCK).table
                self.compare(ours, stock, 1e-9)
                for column in ("push", "height"):
                    self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), 1e-9, column)
                self.check_settled(ours, 0.02)

    def test_servo_that_controls_a_torque(self):
        words = "com 0 8e-3 2.01033e-3 ctrlPV torque axis 2 0 0 target_val 2e-4 vel_max 0.05 kp 0.5"
        ours = decks.good(SERVO_DECK.ours(words) + "run 4000\n", files=SERVO_DECK.files).table
        stock = decks.good(SERVO_DECK.stock(words) + "run 4000\n", files=SERVO_DECK.files, program=decks.STOCK).table
        arm = 8e-3 - ours["y"]
        torque = ours["push"] * arm / 2e-4
        self.assertAlmostEqual(torque[-1], 1.0, delta=0.01, msg="the wall is not level, so the ball slides and is followed")
        for column in ("push", "z"):
            self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), 1e-9, column)

    def check_settled(self, table, force):
        """The ball lies between two Hertz contacts that each carry the force."""
        E_star = mw.YOUNG / (2 * (1 - mw.POISSON**2))
        overlap = (force / (4 / 3 * E_star * math.sqrt(mw.RADIUS))) ** (2 / 3)
        self.assertLessEqual(abs(table["push"][-1] / force - 1), 1e-3)
        self.assertLessEqual(abs(table["height"][-1] - 2 * (mw.RADIUS - overlap)), 1e-3 * overlap)


def builds(text: str) -> int:
    """How often LIGGGHTS rebuilt its neighbour lists."""
    return int(re.search(r"Neighbor list builds = (\d+)", text).group(1))


class Theory(unittest.TestCase):
    def test_rebound_from_a_moving_wall(self):
        # PHYSICS.md, A13: frictionless and elastic, a ball of speed V leaves a wall of speed V_w with 2 V_w + V
        V, V_w = 1.0, 0.4
        for words in (f"linear 0 0 {V_w}", f"rotate origin 0 1e3 0 axis -1 0 0 period {2e3 * math.pi / V_w!r}"):
            deck = mw.deck(
                mw.nurbs_wall("model hertz tangential no_history", "motion " + words), velocity=(0, 0, -V), e=1, mu=0,
                models="model hertz tangential no_history", dt=1.5e-7,
            )
            table = decks.good(deck + mw.output(every=100) + "run 1600\n", files=mw.FILES).table
            self.assertAlmostEqual(table["vz"][-1] / (2 * V_w + V), 1.0, delta=1e-6)

    def test_friction_is_that_of_the_relative_velocity(self):
        # a wall that moves along with the ball gives what a ball gets that falls straight on a wall at rest
        def leave(velocity, drive):
            deck = mw.deck(mw.nurbs_wall(MODELS, drive), velocity=velocity) + mw.output() + "run 800\n"
            return decks.good(deck, files=mw.FILES).table

        straight = leave((0, 0, -1.0), "")
        for drive in ("motion linear 0.3 0.2 0", "surface_vel 0.3 0.2 0"):
            along = leave((0.3, 0.2, -1.0), drive)
            for column, moving in (("vx", 0.3), ("vy", 0.2), ("vz", 0), ("wx", 0), ("wy", 0), ("fx", 0), ("fz", 0)):
                scale = max(abs(straight["fz" if column[0] == "f" else "vz"]))
                self.assertLessEqual(abs(along[column] - straight[column] - moving).max(), 1e-9 * scale, (drive, column))
        dragged = leave((0, 0, -1.0), "motion linear 0.3 0.2 0")
        pushed = leave((-0.3, -0.2, -1.0), "")
        for column, moving in (("vx", 0.3), ("vy", 0.2), ("vz", 0.0)):
            self.assertLessEqual(abs(dragged[column] - pushed[column] - moving).max(), 1e-12)
        self.assertGreater(dragged["vx"][-1], 0.05)

    def test_ball_laid_on_a_belt(self):
        # It slips with mu g, spinning up, until its foot is as fast as the belt; then it rolls with 2/7 of that speed.
        g, mu, V = 9.81, 0.3, 0.05
        E_star = mw.YOUNG / (2 * (1 - mw.POISSON**2))
        weight = 4 / 3 * math.pi * mw.RADIUS**3 * mw.DENSITY * g
        overlap = (weight / (4 / 3 * E_star * math.sqrt(mw.RADIUS))) ** (2 / 3)
        slipping = 2 * V / (7 * mu * g)  # until then
        dt, every = 2e-6, 50
        deck = mw.deck(
            mw.nurbs_wall(MODELS, f"surface_vel 0 {V} 0") + "\nfix g all gravity 9.81 vector 0 0 -1",
            balls=((3e-3, -6e-3, mw.RADIUS - overlap),), velocity=(0, 0, 0), e=0.5, mu=mu, dt=dt,
        )
        table = decks.good(deck + mw.output(every=every) + "run 10000\n", files=mw.FILES).table
        time = table["Step"] * dt
        # from the second output on: the first step's force is all damping, which LIGGGHTS does not limit by mu
        start, end = 2, len(time[time < 0.9 * slipping])
        for column, gain in (("vy", mu * g), ("wx", 2.5 * mu * g / mw.RADIUS)):
            slope = (table[column][end] - table[column][start]) / (time[end] - time[start])
            self.assertAlmostEqual(slope / gain, 1.0, delta=1e-3, msg=column)
        self.assertGreater(time[-1], 2 * slipping)
        self.assertAlmostEqual(table["vy"][-1] / (2 * V / 7), 1.0, delta=1e-3)
        self.assertAlmostEqual((table["vy"][-1] + table["wx"][-1] * mw.RADIUS) / V, 1.0, delta=1e-3)


class LifeCycle(unittest.TestCase):
    def test_restart_continues_a_moving_wall_to_the_last_bit(self):
        drives = {
            "motions": "motion wiggle amplitude 0 0 2e-5 period 5e-4 motion linear 0.1 0 0 motion " + ROTATE,
            "variables": "motion linear/variable v_wall_vx 0 v_wall_vz",
            "belt": "surface_vel v_wall_vx 0.3 0",
        }
        for name, drive in drives.items():
            with self.subTest(name):
                wall = mw.nurbs_wall(MODELS, drive)
                write, read = (mw.deck(wall, before=VARIABLES, restart=file) + mw.output() for file in ("", "moving.restart"))
                self.check_restart(write, read, mw.FILES, runs=(230, 400))

    def test_restart_continues_a_servo_to_the_last_bit(self):
        write, read = (SERVO_DECK.ours(SERVOS["pid"], restart=file) for file in ("", "moving.restart"))
        self.check_restart(write, read, SERVO_DECK.files, runs=(300, 300))

    def check_restart(self, write: str, read: str, files: dict, runs):
        """A run read back from a restart file equals one that is split there."""
        first, second = runs
        deck = f"{write}run {first}\nwrite_restart moving.restart\nrun {second}\nclear\n{read}run {second}\n"
        for ranks in (1, 2):
            tables = decks.good(deck, files=files, ranks=ranks).tables
            self.assertGreater(abs(tables[1]["fz"][0]), 1e-5, "the restart falls into the contact")
            for column, reference in tables[1].items():
                np.testing.assert_array_equal(tables[2][column], reference, column)

    def test_fix_modify_changes_the_motion_between_runs(self):
        # at rest, then moved, then at rest again; beside fix move/mesh added and taken away
        def run(program, wall, start, stop, more=""):
            deck = mw.deck(wall) + mw.output()
            deck += f"run 120\n{start}\nrun 130\n{stop}\nrun 500{more}\n"
            return decks.good(deck, files=mw.FILES, program=program).table

        words = "linear 0.1 -0.2 0.3"
        ours = run(decks.NURBS, mw.nurbs_wall(MODELS, ""), f"fix_modify wall motion {words}", "fix_modify wall motion none")
        stock = run(decks.STOCK, mw.stock_wall(MODELS), f"fix move all move/mesh mesh cad {words}", "unfix move")
        self.assertGreater(stock["fz"][250], 0.05, "the motion ends during the contact")
        for kind, difference in mw.largest_differences(ours, stock).items():
            self.assertLessEqual(difference, 1e-10, kind)
        # without a new setup the forces of the last step go on into the first one
        ours = run(decks.NURBS, mw.nurbs_wall(MODELS, ""), f"fix_modify wall motion {words}", "fix_modify wall motion none", " pre no")
        differences = mw.largest_differences(ours, stock)
        for kind in "xvw":
            self.assertLessEqual(differences[kind], 1e-3, kind)

    def test_fix_modify_of_a_servo(self):
        # before the contact: LIGGGHTS' mesh counts its force twice where a run starts in contact
        pauses = "run 150\nfix_modify {0} servo/integrate stop\nrun 50\nfix_modify {0} servo/integrate start\n" \
            "fix_modify {0} servo/target_val -0.03\nfix_modify {0} servo/ctrlParam 0.4 900 0.\nrun 2500\n"
        words = SERVOS["pid"]
        ours = decks.good(SERVO_DECK.ours(words) + pauses.format("wall"), files=SERVO_DECK.files).table
        stock = decks.good(SERVO_DECK.stock(words) + pauses.format("cad"), files=SERVO_DECK.files,
                           program=decks.STOCK).table
        self.assertAlmostEqual(ours["push"][-1] / 0.03, 1.0, delta=0.01)
        for column in ("push", "height", "z"):
            self.assertLessEqual(decks.largest_difference(ours[column], stock[column]), 1e-9, column)

    def test_two_ranks_give_the_same(self):
        # the ball starts just beside the border of the ranks and crosses it during the contact
        for drive in ("motion linear 0.1 -0.2 0.5 motion " + ROTATE, "surface_vel 0.7 0.2 0"):
            with self.subTest(drive):
                def bounce(ranks):
                    ball = ((-5e-5, -2e-3, 1.05e-3),)
                    deck = mw.deck(mw.nurbs_wall(MODELS, drive), balls=ball, velocity=(0.5, 0.2, -1.0))
                    return decks.good(deck + mw.output() + "run 800\n", files=mw.FILES, ranks=ranks).table

                one, two = bounce(1), bounce(2)
                self.assertGreater(one["x"][-1], 1e-5)
                for kind, difference in mw.largest_differences(two, one).items():
                    self.assertLessEqual(difference, 1e-11, kind)

    def test_two_ranks_give_the_same_servo(self):
        one, two = (
            decks.good(SERVO_DECK.ours(SERVOS["pid"]) + "run 4000\n", files=SERVO_DECK.files, ranks=ranks).table
            for ranks in (1, 2)
        )
        for column, reference in one.items():
            np.testing.assert_array_equal(two[column], reference, column)

    def test_a_fast_wall_rebuilds_its_own_list_only(self):
        # It passes under balls that do not move, 40 skins far; LIGGGHTS itself has no reason to rebuild its lists.
        balls = [(x * 1e-3, 0.0, 1e-3 - 2e-6) for x in (-7, -4, -1, 2, 5, 10, 13)]
        models = "model hertz tangential no_history"

        def run(drive):
            deck = mw.deck(mw.nurbs_wall(models, drive), balls=balls, velocity=(0, 0, 0), mu=0, e=1, models=models)
            deck = deck.replace("fix integrate all nve/sphere", "")  # the balls are held
            more = mw.output("variable contacts equal f_wall[7]", "v_contacts", every=10)
            return decks.good(deck + more + "run 1601\n", files=mw.FILES)

        still, fast = run(""), run("motion linear 10. 0 0")
        self.assertEqual(builds(fast.text), builds(still.text))
        for result, speed in ((still, 0.0), (fast, 10.0)):
            beyond_edge = [[max(abs(x - speed * 5e-7 * step) - mw.HALF, 0.0) for x, _, _ in balls]
                           for step in result.table["Step"]]
            expected = (np.hypot(beyond_edge, balls[0][2]) <= mw.RADIUS).sum(axis=1)
            self.assertGreaterEqual(min(expected), 4)
            np.testing.assert_array_equal(result.table["contacts"], expected)


if __name__ == "__main__":
    unittest.main()

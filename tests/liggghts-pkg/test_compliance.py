# SPDX-License-Identifier: GPL-2.0-or-later
"""`compliance corrected` in decks: the same digits on any number of ranks and over restarts, momentum, forces on two meshes,
and elements that are too small; without it, what the fix says of the mesh."""

import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
from test_wall_local import entries

CORRECTED = "structure block.yaml surface top compliance corrected"
GLASS, STEEL = (74.6e9, 0.2285), (210.6e9, 0.286)
WITHOUT = CORRECTED.replace("corrected", "none")
MODELS = "model hertz tangential history"
SETTINGS = dict(ball=GLASS, wall=GLASS, restitution=0.6, friction=0.3, models=MODELS, timestep=1e-8, velocity=(0.4, -0.3, -1.0))
BALLS = ((0.0, 0.0, 1e-3), (-4e-3, 3e-3, 1.0003e-3), (5e-3, 3.1e-3, 1.0008e-3), (4e-3, -3e-3, 1.0005e-3))
COLUMNS = tuple(range(1, 22))


def glass(size, elements, fixed=("zeta-",)):
    return bob.block(size=size, elements=elements, youngs_modulus=GLASS[0], nu=GLASS[1], density=2480.0, fixed=fixed)


PLATE = glass((16e-3, 12e-3, 1e-3), (34, 18, 1), ("xi-", "xi+", "eta-", "eta+"))


class Ranks(unittest.TestCase):
    def bounce(self, ranks=1, processors="1 1 1", words=CORRECTED):
        deck = bob.prelude(balls=BALLS, processors=processors, **SETTINGS) + bob.wall(MODELS, words) + bob.output(COLUMNS)
        return decks.good(deck + "run 500\n", files={"block.yaml": PLATE}, ranks=ranks).table

    def test_same_history_on_1_2_and_4_ranks(self):
        one = self.bounce()
        self.assertEqual(one["plate7"].max(), 4)
        for ranks, processors in ((2, "2 1 1"), (4, "2 2 1")):
            more = self.bounce(ranks, processors)
            for column in one:
                if column.startswith("plate"):
                    self.assertTrue((more[column] == one[column]).all(), f"{column} on {ranks} ranks")

    def test_momentum_goes_from_the_ball_to_the_block(self):
        """Of a free block: the force along the surface has its reaction."""
        deck = bob.prelude(**SETTINGS | dict(friction=0.0, timestep=5e-9)) + bob.wall(MODELS, CORRECTED)
        deck += bob.output((9, 10, 11)) + "run 200\n"
        table = decks.good(deck, files={"block.yaml": glass((4e-3, 4e-3, 2e-3), (12, 12, 6), ())}).table
        mass = 4.0 / 3.0 * np.pi * bob.RADIUS**3 * bob.DENSITY
        for v, p in (("vx", "plate9"), ("vy", "plate10"), ("vz", "plate11")):
            total = mass * table[v] + table[p]
            self.assertLess(np.abs(total - total[0]).max(), 1e-12 * mass, v)
        self.assertGreater(np.abs(table["plate11"]).max(), 1e-7 * mass)


    def test_angular_momentum_goes_to_the_block_too(self):
        """Of a law that turns with the body.  Friction acts between the surfaces of ball and block, off the foot, and turns both;
        rolling friction, too."""
        rolling = "model hertz tangential history rolling_friction cdt"
        for name, models, friction, words, spin in (
            ("corrected", MODELS, 0.0, CORRECTED, 0.0),
            ("friction", MODELS, 0.3, "structure block.yaml surface top", 1.0),
            ("friction, corrected", MODELS, 0.3, CORRECTED, 1.0),
            ("rolling friction", rolling, 0.3, "structure block.yaml surface top", 1.0),
        ):
            with self.subTest(name):
                settings = SETTINGS | dict(models=models, balls=((0.3e-3, 0.2e-3, 1e-3),), friction=friction, restitution=1.0, timestep=5e-9)
                material = "fix r all property/global coefficientRollingFriction peratomtypepair 2 0.2 0.2 0.2 0.2\n" * ("rolling" in models)
                deck = bob.prelude(**settings).replace("pair_style", material + "pair_style", 1) + bob.wall(models, words)
                deck += bob.output((9, 10, 11, 12, 13, 14), more=("omegax", "omegay", "omegaz")) + "run 400\n"
                block = glass((4e-3, 4e-3, 2e-3), (12, 12, 6), ()).replace("linear_elastic", "saint_venant_kirchhoff")
                table = decks.good(deck, files={"block.yaml": block}).table
                mass = 4.0 / 3.0 * np.pi * bob.RADIUS**3 * bob.DENSITY
                place, velocity, omega = (np.stack([table[f"{v}{d}"] for d in "xyz"], axis=1) for v in ("", "v", "omega"))
                total = mass * np.cross(place, velocity) + 0.4 * mass * bob.RADIUS**2 * omega
                total += np.stack([table[f"plate{k}"] for k in (12, 13, 14)], axis=1)
                self.assertLess(np.abs(total - total[0]).max(), 1e-12 * mass * bob.RADIUS)
                self.assertGreater(np.abs(table["plate12"]).max(), 1e-3 * mass * bob.RADIUS)
                self.assertGreaterEqual(bob.RADIUS * np.abs(omega).max(), 0.05 * spin)


class Neighbours(unittest.TestCase):
    """Two balls almost in touch, on two elements and on two boxes of a body in parts: each feels the other."""

    BLOCK = glass((128e-3, 64e-3, 4e-3), (64, 32, 2))
    PAIR = SETTINGS | dict(balls=((-1.01e-3, 0.3e-3, 1e-3), (1.01e-3, -0.2e-3, 1.0002e-3)))

    def test_same_digits_on_1_2_and_4_ranks_and_after_a_restart(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "contact"
            deck = bob.prelude(**self.PAIR) + bob.wall(MODELS, CORRECTED) + bob.output(COLUMNS) + f"run 260\nwrite_restart {path}\nrun 100\n"
            again = bob.prelude(restart=path, **self.PAIR) + bob.wall(MODELS, CORRECTED) + bob.output(COLUMNS) + "run 100\n"
            one = decks.good(deck, files={"block.yaml": self.BLOCK})
            self.assertEqual(one.tables[0]["plate7"].max(), 2)
            last = one.tables[-1]
            for ranks, processors in ((1, "1 1 1"), (2, "2 1 1"), (4, "2 2 1")):
                with self.subTest(ranks=ranks):
                    text = deck.replace("processors * * *", f"processors {processors}")
                    more = decks.good(text, files={"block.yaml": self.BLOCK}, ranks=ranks).tables[-1]
                    restarted = decks.good(again, files={"block.yaml": self.BLOCK}, ranks=ranks).table
                    for column in (c for c in last if c.startswith("plate")):
                        self.assertTrue((more[column] == last[column]).all(), column)
                        self.assertTrue((restarted[column] == last[column]).all(), f"{column} after a restart")


class Stored(unittest.TestCase):
    def test_store_force_has_the_force_along_the_surface_too(self):
        for friction in (0.0, 0.3):
            settings = SETTINGS | dict(balls=((0.3e-3, 0.2e-3, 1e-3),), velocity=(5, 0, -1), friction=friction)
            deck = bob.prelude(**settings) + bob.wall(MODELS, CORRECTED + " store_force yes") + "run 100\n"
            for k in (1, 2, 3):
                deck += f"compute w{k} all reduce sum f_force_plate[{k}]\nvariable w{k} equal c_w{k}\n"
            deck += bob.output((1, 2, 3)).replace("v_x v_y", "v_w1 v_w2 v_w3 v_x v_y")
            table = decks.good(deck + "run 100\n", files={"block.yaml": PLATE}).tables[-1]
            self.assertGreater(np.abs(table["plate1"]).max(), 0.0)
            for k in (1, 2, 3):
                np.testing.assert_allclose(table[f"w{k}"], -table[f"plate{k}"], rtol=1e-10, atol=1e-14 * np.abs(table["plate3"]).max())


class Restart(unittest.TestCase):
    def test_a_run_goes_on_in_a_contact_to_the_last_bit(self):
        wall = bob.wall(MODELS, CORRECTED) + bob.output((3, 7, 15))
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "block.yaml").write_text(PLATE)
            first = decks.run_in(Path(folder), bob.prelude(**SETTINGS) + wall + "run 260\nwrite_restart contact\nrun 60\n")
            again = decks.run_in(Path(folder), bob.prelude(restart="contact", **SETTINGS) + wall + "run 60\n")
        self.assertEqual((first.code, again.code), (0, 0), first.text[-2000:] + again.text[-2000:])
        whole, rest = first.tables[-1], again.tables[-1]
        self.assertEqual(whole["plate7"].min(), 1.0)
        for column in whole:
            self.assertTrue((whole[column] == rest[column]).all(), column)


class OneByOne(unittest.TestCase):
    def test_the_compute_of_liggghts_has_the_forces_that_acted(self):
        """Without damping and friction they do not depend on velocities.  The force along the surface, and the heat that goes
        through the law's own overlap, too."""
        heat = """
fix h1 all property/global thermalConductivity peratomtype 100. 50.
fix h2 all property/global thermalCapacity peratomtype 10. 10.
fix heat all heat/gran initial_temperature 300.
"""
        of_compute, of_fix = (1, 2, 3, 7, 8, 9, 10), (5, 6, 7, 8, 9, 10, 11)
        columns = [f"c_contacts[{k}]" for k in of_compute] + [f"f_plate[{k}]" for k in of_fix] + ["c_contacts[11]"]
        balls = ((0.06e-3, 0.05e-3, 1e-3),)
        deck = bob.prelude(balls=balls, **SETTINGS | dict(restitution=1.0, friction=0.0, velocity=(0, 0, -1))) + heat
        deck += bob.wall(MODELS, CORRECTED + " temperature 400.") + "compute contacts all wall/gran/local pos force delta heatFlux\n"
        deck += f"dump rows all local 1 rows.* {' '.join(columns)}\ndump_modify rows format \"{' '.join(['%.17g'] * 15)}\"\n"
        deck += "compute heat all reduce sum f_heatFlux\nthermo_style custom step c_heat\nthermo_modify format float %.17g norm no\nthermo 1\n"
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "block.yaml").write_text(glass((4e-3, 4e-3, 2e-3), (16, 16, 8)))
            run = decks.run_in(Path(folder), deck + "run 250\n")
            self.assertEqual(run.code, 0, run.text[-2000:])
            (row,) = entries(Path(folder) / "rows.250", 15)
        compute, fix = row[:7], row[7:14]
        fix[3:6] *= -1.0  # on the wall
        self.assertGreater(compute[5], 1.0)
        # along the surface the slope of c and that of the dented mesh push the ball to opposite sides: 1.5e-3 N each
        np.testing.assert_allclose(compute, fix, rtol=1e-12, atol=1e-16)
        self.assertGreater(abs(row[14]), 0.0)
        # the ball is warmer by a step; through the geometric overlap it would be 6 % less
        self.assertAlmostEqual(row[14] / run.table["heat"][-1], 1.0, delta=1e-5)


    def test_with_friction_it_has_them_too_and_does_not_change_the_run(self):
        """Its springs stay as they are: the same run to the last bit as without it."""
        balls = ((0.06e-3, 0.05e-3, 1e-3),)
        deck = bob.prelude(balls=balls, **SETTINGS | dict(restitution=1.0)) + bob.wall(MODELS, CORRECTED)
        asked = "compute contacts all wall/gran/local force\n"
        asked += f"dump rows all local 1 rows.* {' '.join(f'c_contacts[{k}]' for k in (1, 2, 3))}\n"
        asked += f"dump_modify rows format \"{' '.join(['%.17g'] * 3)}\"\n"
        runs, forces = [], {}
        for words in ("", asked):
            with tempfile.TemporaryDirectory() as folder:
                (Path(folder) / "block.yaml").write_text(glass((4e-3, 4e-3, 2e-3), (16, 16, 8)))
                run = decks.run_in(Path(folder), deck + words + bob.output() + "run 250\n")
                self.assertEqual(run.code, 0, run.text[-2000:])
                runs.append(run.table)
                forces |= {int(file.suffix[1:]): entries(file, 3) for file in Path(folder).glob("rows.*")}
        for column in runs[0]:
            self.assertTrue((runs[0][column] == runs[1][column]).all(), column)
        acted = np.column_stack([runs[0][name] for name in ("fx", "fy", "fz")])
        touching = [k for k, step in enumerate(runs[0]["Step"]) if len(forces[int(step)]) == 1]
        self.assertGreater(len(touching), 150)
        for k in touching:
            told = forces[int(runs[0]["Step"][k])][0]
            np.testing.assert_allclose(told, acted[k], rtol=0, atol=1e-13 * np.abs(acted).max(), err_msg=str(k))


class Meshes(unittest.TestCase):
    def peak(self, elements, words=CORRECTED):
        deck = bob.prelude(**SETTINGS | dict(restitution=1.0, friction=0.0, velocity=(0, 0, -1))) + bob.wall(MODELS, words)
        block = glass((4e-3, 4e-3, 2e-3), elements)
        return -decks.good(deck + bob.output((3,)) + "run 500\n", files={"block.yaml": block}).table["plate3"].min()

    def test_a_finer_mesh_has_the_same_force(self):
        coarse, fine = ((8, 8, 4), (16, 16, 8))
        self.assertLess(abs(self.peak(fine) / self.peak(coarse) - 1.0), 4e-3)
        self.assertLess(self.peak(fine, WITHOUT) / self.peak(coarse, WITHOUT), 0.975)

    def rigid_ball(self, elements, x):
        """What a ball that gives way by nothing does to a small steel block: the peak of its force, and the speed that it leaves by."""
        settings = SETTINGS | dict(ball=(1e20, 0.2), wall=STEEL, restitution=1.0, friction=0.0, velocity=(0, 0, -1), timestep=5e-9)
        deck = bob.prelude(balls=((x, x, bob.RADIUS),), **settings) + bob.wall(MODELS, CORRECTED)
        block = bob.block(size=(1.2e-3, 1.2e-3, 0.8e-3), elements=elements, youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0)
        table = decks.good(deck + bob.output((3,)) + "run 1000\n", files={"block.yaml": block}).table
        return -table["plate3"].min(), table["vz"][-1]

    def test_a_point_force_will_do_up_to_the_limit(self):
        """Elements of 2.9 contact radii, hit in the middle: s comes to 0.86."""
        coarse, fine = self.rigid_ball((6, 6, 4), 1e-4), self.rigid_ball((12, 12, 8), 5e-5)
        self.assertLess(abs(fine[0] / coarse[0] - 1.0), 4e-3)
        self.assertLess(abs(fine[1] / coarse[1] - 1.0), 4e-3)
        self.assertLess(fine[1], 1.0)

    def oblique(self, elements, x, words=CORRECTED):
        """The speed along a steel block by which a ball that gives way by nothing leaves; it comes with 0.2 m/s, and mostly sticks."""
        settings = SETTINGS | dict(ball=(1e20, 0.0), wall=STEEL, restitution=1.0, velocity=(0.2, 0, -1), timestep=7e-9)
        deck = bob.prelude(balls=((x, x, bob.RADIUS),), **settings) + bob.wall(MODELS, words)
        block = bob.block(size=(3e-3, 3e-3, 2e-3), elements=elements, youngs_modulus=STEEL[0], nu=STEEL[1], density=7850.0)
        return decks.good(deck + bob.output((7,)) + "run 800\n", files={"block.yaml": block}).table["vx"][-1]

    def test_friction_does_not_depend_on_the_mesh(self):
        coarse, fine, without = (
            self.oblique((12, 12, 8), 1.25e-4), self.oblique((18, 18, 12), 2.5e-4 / 3), self.oblique((18, 18, 12), 2.5e-4 / 3, WITHOUT))
        self.assertLess(abs(fine - coarse), 0.004 * 0.2)
        self.assertGreater(abs(without - coarse), 0.01 * 0.2)

    def test_too_many_contacts_on_an_element_stop_the_run(self):
        row = np.arange(-4e-3, 4e-3, 2e-3 / 9)
        balls = tuple((x, y, bob.RADIUS - 1e-5) for x in row for y in row)
        deck = bob.prelude(**SETTINGS | dict(balls=balls)) + "neigh_modify exclude group all all\n" + bob.wall(MODELS, CORRECTED) + "run 10\n"
        run = decks.run(deck, files={"block.yaml": glass((16e-3, 12e-3, 4e-3), (8, 6, 2))})
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], "contacts at .* too many on an element .* expected at most 0.8.* or 'compliance none'")

    def test_elements_that_are_too_small_stop_the_run(self):
        deck = bob.prelude(**SETTINGS | dict(timestep=1e-9, velocity=(0, 0, -20))) + bob.wall(MODELS, CORRECTED) + bob.output(())
        run = decks.run(deck + "run 4000\n", files={"block.yaml": glass((1e-3, 1e-3, 0.5e-3), (12, 12, 6))})
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], "elements at .* too small for the contact of particle 1 .* or 'compliance none'")


def missing(overlap, size):
    """0.8 (E*/E') a/h of a ball and a block of the same glass: E* = E'/2."""
    return 0.8 * 0.5 * np.sqrt(bob.RADIUS * overlap) / size


class Estimate(unittest.TestCase):
    """Of the force that is missing where nothing is corrected."""

    SIZE = np.sqrt(0.25e-3 * 0.5e-3)  # of elements that are not square
    BLOCK = glass((4e-3, 4e-3, 2e-3), (16, 8, 4))
    FREE = dict(restitution=1.0, friction=0.0)

    def deck(self, velocity=1.0, models=MODELS, words="none", **more):
        balls = ((0.0, 0.0, 1.001e-3), (-1.6e-3, 1.5e-3, 1.0002e-3), (1.5e-3, -1.6e-3, 1.0005e-3))
        words = CORRECTED.replace("corrected", words)
        settings = SETTINGS | self.FREE | dict(velocity=(0, 0, -velocity), balls=balls, models=models) | more
        return bob.prelude(**settings) + bob.wall(models, words)

    def test_it_is_a_column_and_one_of_each_contact(self):
        form = '"' + " ".join(["%.17g"] * 2) + '"'
        deck = self.deck() + bob.output((7, 8, 29)) + f"dump d all local 60 rows.* f_plate[11] f_plate[12]\ndump_modify d format {form}\n"
        tables = []
        for ranks in (1, 2):
            with tempfile.TemporaryDirectory() as folder:
                (Path(folder) / "block.yaml").write_text(self.BLOCK)
                run = decks.run_in(Path(folder), deck + "run 480\n", ranks=ranks)
                self.assertEqual(run.code, 0, run.text[-2000:])
                rows = [entries(file, 2) for file in Path(folder).glob("rows.*")]
            overlap, share = np.concatenate(rows).T
            np.testing.assert_allclose(share, missing(overlap, self.SIZE), rtol=1e-12)
            self.assertGreater(max(len(table) for table in rows), 1)
            table = run.table
            touches = table["plate7"] > 0
            np.testing.assert_allclose(table["plate29"][touches], missing(table["plate8"][touches], self.SIZE), rtol=1e-12)
            self.assertEqual(np.abs(table["plate29"][~touches]).max(), 0.0)
            self.assertGreater(table["plate29"].max(), 0.03)
            tables.append(table)
        np.testing.assert_array_equal(tables[0]["plate29"], tables[1]["plate29"])

    def warnings(self, deck, ranks=1, block=BLOCK):
        run = decks.good(deck, files={"block.yaml": block}, ranks=ranks)
        return [line for line in run.text.splitlines() if "WARNING: Fix wall/nurbs (id plate): " in line], run

    def test_it_warns_once(self):
        """Of the largest: the ball at (-1.6, 1.5) mm, which is on the first of two ranks and deepest after the first run."""
        deck = self.deck() + bob.output((8,)) + "run 320\nrun 160\n"
        for ranks in (1, 2):
            found, run = self.warnings(deck, ranks)
            (line,) = found
            share = missing(run.tables[0]["plate8"].max(), self.SIZE)
            told = re.search(r"elements of size ([\d.e-]+) give way under particle (\d) at \((\S+), (\S+), \S+\).* about ([\d.]+) % of "
                             r"the force is missing .* use 'compliance corrected', or elements of at least ([\d.e-]+)", line)  # fmt: skip
            size, particle, x, y, percent, advised = map(float, told.groups())
            self.assertEqual(particle, 2)
            np.testing.assert_allclose((x, y), (-1.6e-3, 1.5e-3), atol=1e-6)
            self.assertAlmostEqual(size, self.SIZE, delta=1e-2 * size)
            self.assertAlmostEqual(percent, 100.0 * share, delta=0.051)
            self.assertAlmostEqual(advised, self.SIZE * share / 0.02, delta=0.05 * advised)

    def test_it_is_quiet_where_it_should_be(self):
        """Below 2 %, where contacts are corrected, and with a law that is not Hertz'."""
        for name, velocity, models, words, expected in (
            ("slow", 0.05, MODELS, "none", 0), ("corrected", 1.0, MODELS, "corrected", 0), ("given", 1.0, MODELS, "none", 1),
            ("hooke", 1.0, "model hooke tangential history", "none", 0),
        ):  # fmt: skip
            deck = self.deck(velocity, models, words, restitution=0.95)
            if name == "hooke":
                deck = deck.replace("fix plate", "fix speed all property/global characteristicVelocity scalar 1.0\nfix plate")
            found, run = self.warnings(deck + bob.output((7,)) + f"run {1500 if name == 'slow' else 320}\n")
            self.assertGreater(run.table["plate7"].max(), 0)
            self.assertEqual(len(found), expected, f"{name}: {found}")


class Default(unittest.TestCase):
    """A deck without the word."""

    BLOCK = glass((4e-3, 4e-3, 2e-3), (8, 8, 4))

    def bounce(self, words="", models=MODELS, block=BLOCK, more=""):
        deck = bob.prelude(**SETTINGS | dict(models=models, friction=0.0)) + more
        deck += bob.wall(models, f"structure block.yaml surface top {words}") + bob.output((3,)) + "run 150\n"
        run = decks.good(deck, files={"block.yaml": block})
        self.assertGreater(-run.table["plate3"].min(), 0.1)
        told = re.findall(r"Fix wall/nurbs \(id plate\): 'block.yaml': contacts are as with 'compliance none': (.*)", run.text)
        return run.table["plate3"], told, run.text

    def test_contacts_are_corrected(self):
        force, told, text = self.bounce()
        self.assertEqual(told, [])
        self.assertNotIn("WARNING: Vector length", text)
        np.testing.assert_array_equal(force, self.bounce("compliance corrected")[0])
        self.assertGreater(np.abs(force / self.bounce("compliance none")[0] - 1.0)[-1], 0.01)

    def test_where_that_is_not_known_they_are_not_and_it_is_said(self):
        speed = "fix speed all property/global characteristicVelocity scalar 1.0\n"
        orthotropic = "law: orthotropic_elastic, " + ", ".join(
            [f"E_{i}: 5e9" for i in (1, 2, 3)] + [f"nu_{i}: 0.3" for i in (12, 13, 23)] + [f"G_{i}: 2e9" for i in (12, 13, 23)])  # fmt: skip
        of_wood = re.sub(r"law: .*poissons_ratio: [\d.]+", orthotropic, self.BLOCK)
        for name, setting, expected in (
            ("law", dict(models="model hooke tangential history", more=speed), "hertz and penalty/hertz, given 'model hooke'"),
            ("modes", dict(words="body modal 12"), "given 'body modal'"),
            ("sub-steps", dict(words="substeps structure 2"), "not for 'substeps'"),
            ("material", dict(block=of_wood, words="material independent"), "given 'orthotropic_elastic'"),
            ("quadrature", dict(block=self.BLOCK + "integration: {quadrature: zou}\n"), "given 'zou'"),
            ("one element", dict(block=glass((4e-3, 4e-3, 2e-3), (1, 1, 1))), "given a single one"),
            ("flat", dict(block=glass((4e-3, 4e-3, 2e-3), (28, 28, 1))), "not too flat, given those about .* expected at most 6000"),
        ):
            with self.subTest(name):
                force, told, _ = self.bounce(**setting)
                self.assertEqual(len(told), 1)
                self.assertRegex(told[0], expected)
                without = dict(setting, words=setting.get("words", "") + " compliance none")
                uncorrected, told, _ = self.bounce(**without)
                self.assertEqual(told, [])
                np.testing.assert_array_equal(force, uncorrected)
        flat = bob.prelude(**SETTINGS) + bob.wall(MODELS, CORRECTED) + "run 150\n"
        run = decks.run(flat, files={"block.yaml": glass((4e-3, 4e-3, 2e-3), (28, 28, 1))})
        self.assertNotEqual(run.code, 0)
        self.assertRegex(run.errors[0], "no local compliance of the element about .* too flat; .* or 'compliance none'")


class Statics(unittest.TestCase):
    def test_a_contact_that_is_too_short_is_named(self):
        """Shorter than a shear wave takes through three elements: 2.87 (m^2/(r E*^2 V))^(1/5) (Johnson 1985, eq. 11.25)."""
        E, nu = GLASS
        E_star, mass = 0.5 * E / (1.0 - nu * nu), 4.0 / 3.0 * np.pi * bob.RADIUS**3 * bob.DENSITY
        velocity = 2.0
        duration = 2.87 * (mass**2 / (bob.RADIUS * E_star**2 * velocity)) ** 0.2
        limit = duration * np.sqrt(0.5 * E / (1.0 + nu) / 2480.0) / 3.0
        self.assertGreater(limit, 3e-3)
        for words, ratio, expected in (("corrected", 0.98, 0), ("corrected", 1.02, 1), ("none", 1.02, 0)):
            h = ratio * limit
            block = glass((4 * h, 4 * h, h), (4, 4, 1))
            settings = SETTINGS | dict(restitution=1.0, friction=0.0, velocity=(0, 0, -velocity))
            deck = bob.prelude(**settings) + bob.wall(MODELS, CORRECTED.replace("corrected", words)) + bob.output((7,)) + "run 20\n"
            text = decks.good(deck, files={"block.yaml": block}).text
            found = re.findall(r"WARNING: .*the contact of particle 1 at \(.*\) is too short for 'compliance corrected', which is static: .* "
                               r"three elements of size ([\d.e-]+) \(1 contacts.* some of the ([\d.e-]+) % of its force .* elements of at most "
                               r"([\d.e-]+) there", text)  # fmt: skip
            self.assertEqual(len(found), expected, f"{words} {ratio}")
            depth = (1.25 * mass * velocity**2 / (4.0 / 3.0 * E_star * np.sqrt(bob.RADIUS))) ** 0.4
            for size, percent, advised in found:
                self.assertAlmostEqual(float(percent), 100.0 * missing(depth, h), delta=0.05 * float(percent))
                self.assertAlmostEqual(float(size), h, delta=0.01 * h)
                self.assertAlmostEqual(float(advised), limit, delta=0.03 * limit)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-2.0-or-later
"""What the wall says of its contacts: crossing centres, power, dumped rows, effective radii."""

import math
import re
import tempfile
import unittest
from pathlib import Path

import ball_on_block as bob
import decks
import numpy as np
from branch_decks import FLOOR, GRAVITY, L, OUTPUT, R, SIDE, model_file, nurbs, prelude, quad, run, settings
from prelude import INTEGRATION
from test_wall_local import entries


class Reports(unittest.TestCase):
    def test_a_ball_that_would_cross_in_one_step_is_named(self):
        wall = model_file(quad((-L / 2, -L / 2, 0), (L, 0, 0), (0, L, 0)))
        for speed, crosses in ((5.0, False), (400.0, True)):
            start = prelude((0, 0, 3e-3), (0, 0, -speed), gravity=False, timestep=5e-6)
            for ranks in (1, 2):
                text = run(start, nurbs(), wall, steps=3, ranks=ranks).text
                found = re.search(r"WARNING: Fix wall/nurbs \(id wall\): the centre of particle 1 would cross the wall.*", text)
                with self.subTest(speed=speed, ranks=ranks):
                    self.assertEqual(bool(found), crosses)
                    if found:
                        advised = float(re.search(r"timestep of at most ([\d.e+-]+)", found.group()).group(1))
                        self.assertAlmostEqual(advised, 0.1 * R / speed, delta=0.01 * advised)

    def test_no_timestep_is_advised_where_the_contact_is_too_soft(self):
        wall = model_file(quad((-L / 2, -L / 2, 0), (L, 0, 0), (0, L, 0)))
        start = prelude((0, 0, 0.3 * R), (0, 0, -1.0), gravity=False, timestep=1e-7)
        start = re.sub(r"(?m)^(fix .* youngsModulus peratomtype) .*", r"soft_particles yes\n\1 5e3 5e3", start)
        text = run(start, nurbs(), wall, steps=12000).text
        found = re.search(r"particle 1 would cross the wall within one step.*", text)
        self.assertIsNotNone(found, text[-2000:])
        self.assertIn("its contact does not hold it, use a stiffer one", found.group())
        self.assertNotIn("timestep", found.group())

    def test_a_linear_solid_that_turns_is_named_once(self):
        """8 degrees; a ball that is far off."""
        turning = bob.block(fixed=()) + 'initial: {velocity: ["-1000*y", "1000*x", 0]}\n'
        start = bob.prelude(balls=((0, 0, 0.01),), velocity=(0, 0, 0), timestep=2e-7)
        for law, words, ranks, warned in (
            ("linear_elastic", "", 1, 1), ("linear_elastic", "", 2, 1), ("linear_elastic", " substeps particles 2", 1, 1),
            ("saint_venant_kirchhoff", "", 1, 0),
        ):  # fmt: skip
            wall = bob.wall(rest="structure block.yaml surface top" + words)
            deck = start.replace("timestep 2e-07", "timestep 1e-07") if words else start
            files = {"block.yaml": turning.replace("linear_elastic", law)}
            text = decks.good(deck + wall + f"thermo 10000\nrun {1400 if words else 700}\n", files=files, ranks=ranks).text
            found = re.findall(r"WARNING: Fix wall/nurbs \(id plate\): step \d+: at time .* element \d+ \(spans .*\) is turned by "
                               r"3\.?\d* degrees, and its law linear_elastic, of small strain", text)  # fmt: skip
            with self.subTest(law=law, words=words, ranks=ranks):
                self.assertEqual(len(found), warned, text[-2000:])

    def test_power_is_that_of_force_and_torque(self):
        """The last column, of a wall that turns and of one that also shifts."""
        period = 0.05
        start = prelude((2e-3, -1e-3, 0.999 * R), (0.3, 0.2, 0))
        omega = 2 * math.pi / period
        turn = f"motion rotate origin 1e-3 0 0 axis 0 0 1 period {period} "
        for name, motion, shift in (("turns", turn, 0.0), ("shifts, too", "motion linear -0.4 0 0 " + turn, -0.4)):
            more = "".join(f"variable c{k} equal f_wall[{k}]\n" for k in (1, 2, 6, 18))
            result = run(start, nurbs(motion) + more, model_file(quad((-L, -L, 0), (2 * L, 0, 0), (0, 2 * L, 0), (4, 4))),
                         steps=1000, every=1, more=" v_c1 v_c2 v_c6 v_c18").table
            time = 2e-6 * result["Step"]
            # about the centre, which may shift; before the first step the wall is at rest
            centre = 1e-3 + shift * time
            torque = result["c6"] - centre * result["c2"]
            expected = -(torque * omega + result["c1"] * shift)
            with self.subTest(name):
                self.assertGreater(abs(expected).max(), 1e-6)
                self.assertLessEqual(abs(result["c18"] - expected)[2:].max(), 2e-4 * abs(expected).max())

    def test_dump_local_has_a_row_for_each_contact(self):
        z = 0.995 * R
        deck = prelude((z, 1e-3, z), (0, 0, 0), gravity=False) + nurbs() + OUTPUT + (
            "dump d all local 1 rows.txt " + " ".join(f"f_wall[{k}]" for k in range(1, 12))
            + "\ndump_modify d format \"" + " ".join(["%.17g"] * 11) + "\"\n"
            + "thermo_style custom step v_fx v_fz\nthermo_modify format float %.17g\nrun 0\n"
        )
        launcher = ["sh", "-c", '"$@" && sed "s/^/ROW /" rows.txt', "sh"]
        result = decks.good(deck, files=model_file(FLOOR, SIDE), launcher=launcher)
        rows = [list(map(float, l.split()[1:])) for l in result.text.splitlines() if re.match(r"ROW [\d.-]+ [\d.-]+ .*", l)]
        rows = sorted((r for r in rows if len(r) == 11), key=lambda r: r[1])
        self.assertEqual(len(rows), 2)
        for row, patch_number, point in ((rows[0], 0, (z, 1e-3, 0)), (rows[1], 1, (0, 1e-3, z))):
            self.assertEqual(row[0], 1, "tag")
            self.assertEqual(row[1], patch_number)
            np.testing.assert_allclose(row[4:7], point, atol=1e-12)
            self.assertAlmostEqual(row[10], R - z, delta=1e-12)
        self.assertAlmostEqual(rows[0][2] * L, z, delta=1e-12)  # xi runs along x, eta along y
        self.assertAlmostEqual(rows[0][3] * L - L / 2, 1e-3, delta=1e-12)
        self.assertAlmostEqual(rows[0][9], -result.table["fz"][0], delta=1e-12)
        self.assertAlmostEqual(rows[1][7], -result.table["fx"][0], delta=1e-12)

    def read(self, folder: Path, ranks: int, every: int, dumps: str) -> tuple[dict, dict[str, np.ndarray]]:
        """Two balls that slide over a floor: thermo table every so many steps, and rows of dumps by their files."""
        plane = f"plane: {{origin: [{-L / 2}, {-L / 2}, 0], edges: [[{L}, 0, 0], [0, {L}, 0]], elements: [4, 4], degree: 2}}"
        (folder / "wall.yaml").write_text(f"units: si\ngeometry: {{{plane}}}\nsurfaces: {{wall: all}}\n")
        balls = bob.thrown([(-3e-3, 1e-3, 0.999 * R), (4e-3, -2e-3, 0.998 * R)], (0.1, 0.2, 0.0))
        values = "".join(f"variable c{k} equal f_wall[{k}]\n" for k in range(1, 9))
        deck = settings(processors="* 1 1" if ranks == 1 else f"{ranks} 1 1").text() + balls + INTEGRATION + GRAVITY + nurbs()
        columns = " v_c".join(map(str, range(1, 9)))
        deck += f"{values}thermo_style custom step v_c{columns}\nthermo_modify format float %.17g\nthermo {every}\n{dumps}"
        table = decks.run_in(folder, deck, ranks).table
        return table, {f.name: np.sort(entries(f, 11), axis=0) for f in folder.glob("rows.*")}

    def test_rows_and_sums_are_made_for_whoever_reads(self):
        """Of steps in between, what is read in every step; write_dump has the last step's; on 1 and 2 ranks alike."""
        fields = " ".join(f"f_wall[{k}]" for k in range(1, 12))
        form = 'dump_modify d format "' + " ".join(["%.17g"] * 11) + '"\n'
        write = f"write_dump all local rows.end {fields} modify format \"{' '.join(['%.17g'] * 11)}\"\n"
        decks_of = {
            "all": (1, f"dump d all local 1 rows.* {fields}\n{form}run 60\n"),
            "few": (20, f"dump d all local 15 rows.* {fields}\n{form}run 60\n"),
            "none": (30, f"run 60\n{write}"),
            "late": (30, f"run 30\ndump d all local 15 rows.* {fields}\n{form}run 30 pre no\n"),
        }
        found = {}
        for ranks in (1, 2):
            for name, (every, dumps) in decks_of.items():
                with tempfile.TemporaryDirectory() as folder:
                    found[name, ranks] = self.read(Path(folder), ranks, every, dumps)
        table, rows = found["all", 1]
        self.assertEqual(table["c7"].min(), 2, "both touch")
        self.assertGreater(np.ptp(rows["rows.60"][:, 4] - rows["rows.0"][:, 4]), 0.0, "and move")
        for row in rows["rows.60"]:
            np.testing.assert_allclose(row[2:4], row[4:6] / L + 0.5, atol=1e-12)  # xi runs along x, eta along y
        for (name, ranks), (other, of_other) in found.items():
            with self.subTest(name, ranks=ranks):
                steps, first = np.unique(other["Step"], return_index=True)
                at = np.isin(table["Step"], steps)
                for column, values in other.items():
                    np.testing.assert_array_equal(values[first], table[column][at], column)
                self.assertEqual(len(of_other), {"all": 61, "few": 5, "none": 1, "late": 3}[name])
                for file, those in of_other.items():
                    np.testing.assert_array_equal(those, rows[file.replace("end", "60")])

    def test_effective_radius_on_round_walls(self):
        """Force on a sphere at rest, rstar curvature: Hertz with 1/r* = 1/r +- 1/R; on a cylinder the geometric mean."""
        big, overlap = 10 * R, 1e-5
        e_star = 5e7 / (2 * (1 - 0.3**2))
        hertz = lambda r: 4 / 3 * e_star * math.sqrt(r) * overlap**1.5  # noqa: E731
        shapes = {
            "sphere": (f"sphere: {{centre: [0, 0, 0], radius: {big}, elements: [4, 2]}}", 2),
            "cylinder": (f"cylinder: {{origin: [-0.02, 0, 0], axis: [1, 0, 0], radius: {big}, length: 0.04, elements: [4, 3]}}", 1),
        }
        box = "-0.02 0.02 -0.02 0.02 -0.02 0.02"
        for name, (shape, curved) in shapes.items():
            files = {"wall.yaml": f"units: si\ngeometry:\n  {shape}\nsurfaces: {{wall: all}}\n"}
            for side in (1, -1):
                z = big + side * (R - overlap)
                ball = (1e-4, 0.6 * math.sqrt(z * z - 1e-8), 0.8 * math.sqrt(z * z - 1e-8)) if name == "sphere" else (1e-4, 0.6 * z, 0.8 * z)
                start = prelude(ball, (0, 0, 0), gravity=False, box=box)
                for word, radius in (
                    ("particle", R),
                    ("curvature", R / math.sqrt((1 + side * R / big) ** curved)),
                ):
                    result = run(start, nurbs(f"rstar {word}"), files, steps=0, every=1).table
                    force = math.hypot(result["fx"][0], result["fy"][0], result["fz"][0])
                    with self.subTest(name, side=side, rstar=word):
                        self.assertAlmostEqual(force / hertz(radius), 1.0, delta=1e-6)


if __name__ == "__main__":
    unittest.main()

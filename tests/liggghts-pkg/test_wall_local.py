# SPDX-License-Identifier: GPL-2.0-or-later
"""LIGGGHTS' own `compute wall/gran/local` on this wall: every column of every contact is that of a stock mesh wall."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import ball_on_block as bob
import decks
from prelude import INTEGRATION
from test_wall_output import FLOOR, MODELS, START, STL

WIDTHS = {
    "pos": 6, "vel": 6, "id": 3, "force": 3, "force_normal": 3, "force_tangential": 3, "torque": 3, "torque_normal": 3,
    "torque_tangential": 3, "history": 3, "contactArea": 1, "delta": 1, "heatFlux": 1,
}  # fmt: skip
COLUMNS = sum(WIDTHS.values())
FIRST = dict(zip(WIDTHS, np.cumsum([0, *WIDTHS.values()])))
PARTICLE = FIRST["id"] + 2
BALLS = "".join(
    f"create_atoms 1 single {-0.0031 + 0.0015 * (k % 5)} {-0.003 + 0.0015 * (k // 5)} {0.0005 + 7e-6 * k} units box\n"
    for k in range(20)
) + """
set group all diameter 0.001 density 2480
velocity all set 0.4 0.3 -0.5 units box
fix turn all addforce 1e-4 2e-4 0
fix h1 all property/global thermalConductivity peratomtype 100. 50.
fix h2 all property/global thermalCapacity peratomtype 10. 10.
fix heat all heat/gran initial_temperature 300.
""" + INTEGRATION
MESH = f"fix wall all wall/gran {MODELS} mesh n_meshes 1 meshes mesh\n"


def mesh(words: str = "", file: str = "plane.stl", name: str = "mesh") -> str:
    return f"fix {name} all mesh/surface file {file} type 2 {words}\n"


def wall(words: str = "", name: str = "wall") -> str:
    return f"fix {name} all wall/nurbs {MODELS} type 2 geometry floor.yaml surface floor {words}\n"


def local(group: str = "all", every: int = 20) -> str:
    columns = " ".join(f"c_contacts[{k}]" for k in range(1, COLUMNS + 1))
    return (
        f"compute contacts {group} wall/gran/local {' '.join(WIDTHS)}\ndump rows all local {every} rows.* {columns}\n"
        'dump_modify rows format "' + " ".join(["%.17g"] * COLUMNS) + '"\n'
    )


def entries(path: Path, columns: int) -> np.ndarray:
    """Rows of a dump local."""
    lines = path.read_text().splitlines()
    (head,) = (k for k, line in enumerate(lines) if line.startswith("ITEM: ENTRIES"))
    return np.array([line.split() for line in lines[head + 1 :]], dtype=float).reshape(-1, columns)


def rows(path: Path) -> np.ndarray:
    """contacts x columns, in the order of particles and walls."""
    table = entries(path, COLUMNS)
    return table[np.lexsort((table[:, FIRST["id"]], table[:, PARTICLE]))]


class WallLocal(unittest.TestCase):
    def contacts(self, deck: str, **options) -> list[np.ndarray]:
        """At every 20th step."""
        return self.run_deck(deck, **options)[0]

    def run_deck(self, deck: str, **options) -> tuple[list[np.ndarray], decks.Run]:
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("floor.yaml", FLOOR), ("plane.stl", STL)):
                (Path(folder) / name).write_text(text)
            run = decks.run_in(Path(folder), START.text() + BALLS + deck + "run 200\n", **options)
            self.assertEqual(run.code, 0, run.text[-2000:])
            files = [Path(folder) / f"rows.{step}" for step in range(0, 201, 20)]
            return [rows(file) for file in files if file.exists()], run

    def assert_same(self, ours: list[np.ndarray], stock: list[np.ndarray], tolerance: float = 1e-14) -> None:
        self.assertGreater(max(len(table) for table in stock), 3)
        for name, width in WIDTHS.items():
            columns = [FIRST[name] + k for k in range(width) if name != "id" or k != 1]  # a triangle, a patch
            whole = name.split("_")[0]  # a normal part is compared at the scale of what it is part of
            of_whole = slice(FIRST[whole], FIRST[whole] + WIDTHS[whole])
            scale = max(np.abs(table[:, of_whole]).max(initial=0.0) for table in stock)
            self.assertGreater(scale, 0.0, name)
            for a, b in zip(ours, stock):
                self.assertEqual(a.shape, b.shape)
                np.testing.assert_allclose(a[:, columns], b[:, columns], rtol=0.0, atol=tolerance * scale, err_msg=name)

    def test_every_column_is_that_of_a_mesh(self):
        stock = self.contacts(mesh("temperature 400.") + MESH + local(), program=decks.STOCK)
        for ranks in (1, 2):
            self.assert_same(self.contacts(wall("temperature 400.") + local(), ranks=ranks), stock)

    def test_heat_goes_through_the_contact_area_of_the_deck(self):
        """Through an area that the deck gives, or the particle's section; temperatures of the particles, too."""
        temperatures = """
compute T all reduce sum f_Temp
thermo_style custom step c_T
thermo_modify format float %.17g norm no
thermo 100
"""
        for area in ("constant 2e-8", "projection"):
            results = []
            for deck, program in ((mesh("temperature 400.") + MESH.replace("1 meshes mesh", f"1 meshes mesh contact_area {area}"), decks.STOCK),
                                  (wall(f"temperature 400. contact_area {area}"), decks.NURBS)):  # fmt: skip
                results.append(self.run_deck(deck + local() + temperatures, program=program))
            (stock, stock_run), (ours, our_run) = results
            self.assert_same(ours, stock)
            self.assertGreater(stock_run.table["T"][-1], 6000.0)
            np.testing.assert_array_equal(our_run.table["T"], stock_run.table["T"])

    def test_one_compute_has_the_contacts_of_all_walls(self):
        """A floor and a side, as two meshes of one wall; LIGGGHTS has nine digits of pi.  Of half of the particles."""
        side = "temperature 350. scale 0.8 rotate axis 0 1 0 angle 90 move 0.00345 0 0.0024"
        some = "group some id <> 5 15\n" + local("some")
        meshes = mesh("temperature 400.") + mesh(side, name="side") + MESH.replace("1 meshes mesh", "2 meshes mesh side")
        stock = self.contacts(meshes + some, program=decks.STOCK)
        self.assertEqual({0.0, 1.0}, set(np.concatenate(stock)[:, FIRST["id"]]))
        ours = self.contacts(wall("temperature 400.") + wall(side, name="side") + some)
        self.assert_same(ours, stock, 1e-5)

    def test_a_wall_that_moves(self):
        """The wall's velocity is a column, too."""
        verb = "wiggle amplitude 0 1e-5 2e-5 period 1e-3"
        meshes = mesh("temperature 400.") + MESH + f"fix move all move/mesh mesh mesh {verb}\n"
        stock = self.contacts(meshes + local(), program=decks.STOCK)
        self.assertGreater(np.abs(np.concatenate(stock)[:, FIRST["vel"] : FIRST["vel"] + 3]).max(), 0.1)
        self.assert_same(self.contacts(wall(f"temperature 400. motion {verb}") + local()), stock, 1e-9)

    def test_the_largest_overlap_by_compute_reduce(self):
        """Of the fix's own local array."""
        deck = bob.prelude() + bob.wall() + """
compute deepest all reduce max f_plate[11]
thermo 50
thermo_style custom step c_deepest f_plate[8]
thermo_modify format float %.17g norm no
run 150
"""
        for ranks in (1, 2):
            table = decks.good(deck, files={"block.yaml": bob.block()}, ranks=ranks).table
            self.assertGreater(table["deepest"].max(), 1e-6)
            np.testing.assert_array_equal(table["deepest"], table["plate[8]"])

    def test_a_solid(self):
        """Without damping and friction nothing depends on velocities: foot, particle, force and overlap are those of f_plate."""
        of_compute, of_fix = (1, 2, 3, 15, 16, 17, 18, 20), (5, 6, 7, 1, 8, 9, 10, 11)
        columns = [f"c_contacts[{k}]" for k in of_compute] + [f"f_plate[{k}]" for k in of_fix]
        deck = bob.prelude() + bob.wall() + f"""
compute contacts all wall/gran/local pos vel id force contactArea delta
dump rows all local 100 rows.* {" ".join(columns)}
dump_modify rows format "{" ".join(["%.17g"] * 16)}"
run 100
"""
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "block.yaml").write_text(bob.block())
            run = decks.run_in(Path(folder), deck, ranks=2)
            self.assertEqual(run.code, 0, run.text[-2000:])
            (row,) = entries(Path(folder) / "rows.100", 16)
        compute, fix = row[:8], row[8:]
        fix[4:7] *= -1.0  # on the wall
        self.assertGreater(compute[6], 0.1)
        np.testing.assert_allclose(compute, fix, rtol=1e-12, atol=1e-18)

    def test_asking_changes_nothing(self):
        """Motion, friction's memory, stored forces and heat are the same to the last digit as without the compute."""
        deck = wall("temperature 400. store_force yes") + """
compute sum all reduce sum f_force_wall[1] f_force_wall[3] f_heatFlux
thermo_style custom step atoms ke f_wall[1] f_wall[2] f_wall[3] c_sum[1] c_sum[2] c_sum[3]
thermo_modify format float %.17g
thermo 10
"""
        quiet, asked = self.run_deck(deck)[1].table, self.run_deck(deck + local(every=1))[1].table
        self.assertGreater(np.abs(quiet["sum[3]"]).max(), 0.0)
        for name in quiet:
            np.testing.assert_array_equal(asked[name], quiet[name], name)

    def test_beside_a_mesh_it_has_the_contacts_of_the_mesh(self):
        """LIGGGHTS allows one wall of meshes in a deck; the order of both does not matter."""
        lid = mesh("temperature 400. move 0 0 0.00098") + MESH.replace("fix wall", "fix lid")
        for deck in (wall() + lid, lid + wall()):
            contacts, run = self.run_deck(deck + local())
            self.assertIn("detected primitive wall", run.text)
            heights = np.concatenate(contacts)[:, FIRST["pos"] + 2]
            np.testing.assert_allclose(heights, 0.00098, rtol=1e-12)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""mesh.inp: CalculiX solves a bar under tension and the patch test exactly, of first and second order, and finds all
sets. Beams bend as they should with C3D10."""
import pathlib
import re
import tempfile
import unittest

import numpy
import solver_meshes
from solver_meshes import Mesh, read_pvtu, run

YOUNG, POISSON, TENSION, LENGTH = 1000.0, 0.3, 2.0, 2.0
BAR = """algebraic3d
solid left = plane (0, 0, 0; -1, 0, 0) -bcname=left;
solid right = plane ({length}, 0, 0; 1, 0, 0) -bcname=right;
solid sides = plane (0, 0, 0; 0, -1, 0) and plane (0, 1, 0; 0, 1, 0)
  and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 1; 0, 0, 1) -bcname=sides;
solid bar = left and right and sides;
tlo bar;
"""
CASE = """geometry.file = "bar.geo"
coarse.max_size = 0.5
decompose.subdomains = 4
refine.levels = 1
"""

# Displacements of the patch test: u = GRADIENT x.
GRADIENT = 1e-3 * numpy.array([[1.0, 2.0, -1.0], [0.5, -2.0, 1.5], [3.0, -0.5, 1.0]])


class Deck:
    """What stands in mesh.inp."""

    def __init__(self, file):
        self.file = file
        text = file.read_text(encoding="utf-8")
        rows = re.search(r"^\*NODE, NSET=NALL\n([^*]*)", text, re.MULTILINE)[1].splitlines()
        numbered = numpy.array([row.split(",") for row in rows], dtype=float)
        assert (numbered[:, 0] == numpy.arange(1, len(rows) + 1)).all()
        self.xyz = numbered[:, 1:]  # Row i of node i + 1.
        elements = re.findall(r"^\*ELEMENT, TYPE=C3D(?:4|6|10), ELSET=(\S+)$", text, re.MULTILINE)
        self.elements = list(dict.fromkeys(elements))
        self.surfaces = re.findall(r"^\*SURFACE, NAME=(\S+), TYPE=ELEMENT$", text, re.MULTILINE)
        self.nodes = {
            name: numpy.array(numbers.split(), dtype=int)
            for name, numbers in re.findall(r"^\*NSET, NSET=(\S+)\n([\d\s]+)", text, re.MULTILINE)
        }

    def solve(self, load, density=1.0):
        """Tables that ccx prints, by title, with the same material everywhere."""
        sections = "".join(f"*SOLID SECTION, ELSET={name}, MATERIAL=STUFF\n" for name in self.elements)
        folder = self.file.parent
        (folder / "load.inp").write_text(
            f"*INCLUDE, INPUT={self.file.name}\n*MATERIAL, NAME=STUFF\n*ELASTIC\n{YOUNG}, {POISSON}\n"
            f"*DENSITY\n{density}\n{sections}"
            f"*STEP\n*STATIC, SOLVER=SPOOLES\n{load}*END STEP\n",
            encoding="utf-8",
        )
        out = run(["ccx", "load"], folder=folder)
        if "*ERROR" in out or "*WARNING" in out:
            raise AssertionError(out[-4000:])
        tables = {}
        for line in (folder / "load.dat").read_text(encoding="utf-8").splitlines():
            if " and time " in line:
                rows = tables.setdefault(line.strip().partition(" and time ")[0], [])
            elif line.strip():
                rows.append([float(word) for word in line.split()])
        return {title: numpy.array(rows) for title, rows in tables.items()}

    def displacements(self, tables, node_set):
        """Nodes, and a row of displacements for each."""
        table = tables[f"displacements (vx,vy,vz) for set {node_set}"]
        return table[:, 0].astype(int), table[:, 1:]


class CalculiX(unittest.TestCase):
    def deck(self, case, *settings):
        mesh = Mesh(case, 3, *settings)
        self.addCleanup(mesh.remove)
        return mesh, Deck(mesh.convert("abaqus") / "mesh.inp")

    def check_node_sets(self, mesh, deck):
        """Each has the points of its patch, each of them once."""
        points, triangles, arrays, texts = read_pvtu(mesh.mesh / "boundary.pvtu")
        names = [name.upper() for name in texts["patch_names"]]
        self.assertEqual(set(deck.surfaces), set(names))
        for name in set(names):
            found = deck.nodes[f"N_{name}"]
            self.assertEqual(len(set(found)), len(found))
            is_of_patch = numpy.isin(arrays["patch"], [i for i, other in enumerate(names) if other == name])
            expected = points[numpy.unique(triangles[is_of_patch])]
            self.assertEqual({tuple(xyz) for xyz in deck.xyz[found - 1].round(9)},
                             {tuple(xyz) for xyz in expected.round(9)})  # fmt: skip

    def check_patch_test(self, mesh, deck, outer):
        """All nodes move as those on the boundary do; ccx' volumes are ours."""
        held = numpy.unique(numpy.concatenate([deck.nodes[f"N_{name.upper()}"] for name in outer]))
        moves = deck.xyz @ GRADIENT.T
        load = "*BOUNDARY\n"
        for node in held:
            for axis in range(3):
                load += f"{node},{axis + 1},{axis + 1},{moves[node - 1, axis]:.13e}\n"
        load += "*DSLOAD\n" + "".join(f"{name},P,0.\n" for name in deck.surfaces)
        load += "".join(f"*NODE PRINT, NSET={name}\nU\n" for name in ("NALL", *deck.nodes))
        load += "".join(f"*EL PRINT, ELSET={name}, TOTALS=ONLY\nEVOL\n" for name in ("EALL", *deck.elements))
        tables = deck.solve(load)
        for name in ("NALL", *deck.nodes):
            nodes, found = deck.displacements(tables, name)
            self.assertEqual(len(nodes), len(deck.nodes.get(name, deck.xyz)))
            self.assertLess(abs(found - moves[nodes - 1]).max(), 1e-6 * abs(moves).max(), name)
        volumes = {name.upper(): volume for name, volume in mesh.volumes().items()}
        self.assertEqual(set(deck.elements), set(volumes))
        for name, volume in (*volumes.items(), ("EALL", sum(volumes.values()))):
            found = tables[f"total volume for set {name}"][0, 0]
            self.assertAlmostEqual(found / volume, 1.0, delta=1e-5)

    def bar(self, length, *settings):
        """A mesh of a bar of a square of 1."""
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "bar.toml"
            case.write_text(CASE, encoding="utf-8")
            case.with_name("bar.geo").write_text(BAR.format(length=length), encoding="utf-8")
            return self.deck(case, *settings)

    def test_bar_under_tension(self):
        for order in (1, 2):
            with self.subTest(order=order):
                mesh, deck = self.bar(LENGTH, f"output.order={order}")
                self.check_node_sets(mesh, deck)
                self.check_tension(deck)

    def check_tension(self, deck):
        def node_at(*xyz):
            return int(abs(deck.xyz - xyz).sum(axis=1).argmin()) + 1

        tables = deck.solve(
            f"*BOUNDARY\nN_LEFT,1,1\n{node_at(0, 0, 0)},2,3\n{node_at(0, 1, 0)},3,3\n"
            f"*DSLOAD\nRIGHT,P,{-TENSION}\n*NODE PRINT, NSET=NALL\nU\n"
            "*NODE PRINT, NSET=N_LEFT, TOTALS=ONLY\nRF\n"
        )
        nodes, found = deck.displacements(tables, "NALL")
        strain = TENSION / YOUNG
        expected = deck.xyz[nodes - 1] * [strain, -POISSON * strain, -POISSON * strain]
        self.assertLess(abs(found - expected).max(), 1e-6 * strain * LENGTH)
        ends = found[numpy.isin(nodes, deck.nodes["N_RIGHT"]), 0]
        self.assertLess(abs(ends / (TENSION * LENGTH / YOUNG) - 1.0).max(), 1e-6)
        force = tables["total force (fx,fy,fz) for set N_LEFT"][0]
        self.assertAlmostEqual(force[0], -TENSION, delta=1e-5)

    def test_beam_bends_as_theory_says_with_tets_of_second_order(self):
        """Under its own weight. One tet over the height is nearly enough for C3D10, and far from it for C3D4."""
        length, weight = 8.0, 1e-4
        bending = weight * length**4 / (8 * YOUNG / 12)
        shear = weight * length**2 / (2 * 5 / 6 * YOUNG / (2 * (1 + POISSON)))
        errors = []
        for order in (1, 2):
            _, deck = self.bar(length, f"output.order={order}", "coarse.max_size=1", "refine.levels=0")
            tables = deck.solve(
                "*BOUNDARY\nN_LEFT,1,3\n*DLOAD\nEALL,GRAV,1.,0.,0.,-1.\n*NODE PRINT, NSET=N_RIGHT\nU\n",
                density=weight,
            )
            _, found = deck.displacements(tables, "N_RIGHT")
            errors.append(abs(-found[:, 2].mean() / (bending + shear) - 1.0))
        self.assertGreater(errors[0], 0.2)
        self.assertLess(errors[1], 0.05)

    def test_three_materials(self):
        mesh, deck = self.deck("core")
        self.check_node_sets(mesh, deck)
        self.check_patch_test(mesh, deck, ["outside"])

    def test_bracket(self):
        mesh, deck = self.deck("bracket")
        self.check_node_sets(mesh, deck)
        self.check_patch_test(mesh, deck, mesh.areas())


if __name__ == "__main__":
    solver_meshes.main()

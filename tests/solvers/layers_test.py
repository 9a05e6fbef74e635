# SPDX-License-Identifier: BSD-3-Clause
"""Prisms and pyramids of layers: Gmsh finds them positive and of the right volume, meshio and VTK find as many in each
format, and CalculiX solves the patch test on them."""
import pathlib
import sys
import tempfile
import unittest

import gmsh
import meshio
import numpy
import solver_meshes
from calculix_test import GRADIENT, Deck
from solver_meshes import Mesh, read_pvtu
from vtkmodules.vtkIOExodus import vtkExodusIIReader as Exodus

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from capsule import CAPSULE  # noqa: E402

CASE = """geometry.file = "model.geo"
coarse.max_size = 0.4
decompose.subdomains = 3
refine.levels = 1
[[layer]]
patch = "wall"
first = 0.03
count = 2
"""
JOINT_MODEL = """algebraic3d
solid ends = plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 1; 0, 0, 1);
solid round = cylinder (0, 0, 0; 0, 0, 1; 0.5) -bcname=contact;
solid water = round and ends;
solid block = orthobrick (-1, -1, -1; 1, 1, 3) and ends and not round;
tlo water;
tlo block;
"""
JOINT_CASE = """geometry.file = "model.geo"
coarse.max_size = 0.4
decompose.subdomains = 6
refine.levels = 1
[[layer]]
patch = "contact"
side = "water"
first = 0.03
count = 2
[[layer]]
patch = "contact"
side = "block"
first = 0.02
count = 3
"""
GMSH_TYPES = {4: "tetra", 7: "pyramid", 6: "wedge", 2: "triangle", 3: "quad"}


class Layers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "case.toml"
            case.write_text(CASE, encoding="utf-8")
            case.with_name("model.geo").write_text(CAPSULE, encoding="utf-8")
            cls.mesh = Mesh(case, 3)
        cls.addClassCleanup(cls.mesh.remove)
        _, _, arrays, _ = read_pvtu(cls.mesh.mesh / "mesh.pvtu")
        of_prism = arrays["tet_of_prism"]
        sizes = numpy.diff(numpy.append(numpy.flatnonzero(of_prism == 0), len(of_prism)))
        cls.counts = {kind: int((sizes == size).sum()) for kind, size in (("tetra", 1), ("pyramid", 2), ("wedge", 3))}
        assert min(cls.counts.values()) > 10, cls.counts
        words = ("msh", "msh2", "medit", "exodus", "xdmf", "abaqus")
        cls.folders = {word: cls.mesh.convert(word) for word in words}

    def test_gmsh_finds_positive_cells(self):
        gmsh.initialize(["", "-nopopup"], readConfigFiles=False)
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)
        for word, name in (("msh", "mesh.msh"), ("msh2", "mesh_v2.msh")):
            with self.subTest(word):
                gmsh.open(str(self.folders[word] / name))
                sums, counts = {2: 0.0, 3: 0.0}, {}
                for dimension in sums:
                    for kind in gmsh.model.mesh.getElementTypes(dimension):
                        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss4")
                        if GMSH_TYPES[kind] == "pyramid":  # Gmsh 4.8 has a sum of 16 / 9.
                            weights = weights * (4.0 / 3.0 / sum(weights))
                        _, determinants, _ = gmsh.model.mesh.getJacobians(kind, points)
                        table = determinants.reshape(-1, len(weights))
                        self.assertGreater(table.min(), 0.0, GMSH_TYPES[kind])
                        sums[dimension] += float((table * weights).sum())
                        counts[GMSH_TYPES[kind]] = len(table)
                self.assertEqual({kind: counts[kind] for kind in self.counts}, self.counts)
                self.assertGreater(counts["quad"], 0)
                self.assertAlmostEqual(sums[3] / sum(self.mesh.volumes().values()), 1.0, delta=1e-9)
                self.assertAlmostEqual(sums[2] / sum(self.mesh.areas().values()), 1.0, delta=1e-9)
                gmsh.clear()

    def test_meshio_reads_as_many(self):
        files = {"msh": "mesh.msh", "msh2": "mesh_v2.msh", "medit": "mesh.mesh", "exodus": "mesh.exo", "xdmf": "tets.xdmf"}
        for word, name in files.items():
            with self.subTest(word):
                found = meshio.read(self.folders[word] / name)
                counts = {}
                for block in found.cells:
                    counts[block.type] = counts.get(block.type, 0) + len(block.data)
                self.assertEqual({kind: counts.get(kind) for kind in self.counts}, self.counts)

    def test_vtk_reads_exodus(self):
        reader = Exodus()
        reader.SetFileName(str(self.folders["exodus"] / "mesh.exo"))
        reader.UpdateInformation()
        names = [reader.GetObjectName(Exodus.ELEM_BLOCK, i) for i in range(reader.GetNumberOfObjects(Exodus.ELEM_BLOCK))]
        self.assertEqual(names, [names[0], names[0] + "_pyramids", names[0] + "_prisms"])
        reader.Update()
        grids = reader.GetOutput().GetBlock(0)
        counts = [grids.GetBlock(i).GetNumberOfCells() for i in range(grids.GetNumberOfBlocks())]
        self.assertEqual(counts, list(self.counts.values()))

    def test_calculix_solves_the_patch_test(self):
        assert_patch_test(self, self.mesh, self.folders["abaqus"], ())


class Joint(unittest.TestCase):
    """Layers on both sides of the face between a pipe full of water and the block around it."""

    def test_calculix_solves_the_patch_test_across_it(self):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "case.toml"
            case.write_text(JOINT_CASE, encoding="utf-8")
            case.with_name("model.geo").write_text(JOINT_MODEL, encoding="utf-8")
            mesh = Mesh(case, 3)
        self.addCleanup(mesh.remove)
        assert_patch_test(self, mesh, mesh.convert("abaqus"), ("N_CONTACT",))


def assert_patch_test(test, mesh, folder, free):
    """All nodes move as those on the boundary do, but for that on free patches; the volume is ours."""
    deck = Deck(folder / "mesh.inp")
    held = [nodes for name, nodes in deck.nodes.items() if name not in free]
    test.assertEqual(len(deck.nodes) - len(held), len(free), deck.nodes.keys())
    held = numpy.unique(numpy.concatenate(held))
    moves = deck.xyz @ GRADIENT.T
    load = "*BOUNDARY\n" + "".join(
        f"{node},{axis + 1},{axis + 1},{moves[node - 1, axis]:.13e}\n" for node in held for axis in range(3))
    load += "*DSLOAD\n" + "".join(f"{name},P,0.\n" for name in deck.surfaces)
    load += "*NODE PRINT, NSET=NALL\nU\n*EL PRINT, ELSET=EALL, TOTALS=ONLY\nEVOL\n"
    tables = deck.solve(load)
    nodes, found = deck.displacements(tables, "NALL")
    error = abs(found - moves[nodes - 1]).max() / abs(moves).max()
    print(f"patch test: {error:.1e}")
    volume = tables["total volume for set EALL"][0, 0]
    test.assertAlmostEqual(volume / sum(mesh.volumes().values()), 1.0, delta=1e-3)
    test.assertLess(error, 1e-3)


if __name__ == "__main__":
    solver_meshes.main()

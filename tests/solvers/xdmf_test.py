# SPDX-License-Identifier: BSD-3-Clause
"""mesh.xdmf with mesh.h5: DOLFINx reads and solves on it, PETSc reads it as a DMPlex, h5py its
arrays and names."""
import json
import pathlib
import unittest
import xml.etree.ElementTree

import h5py
import meshio
import solver_meshes
from solver_meshes import Mesh, mpirun

HERE = pathlib.Path(__file__).parent
PETSC = """
import sys
from petsc4py import PETSc
viewer = PETSc.Viewer().createHDF5(sys.argv[1], "r")
viewer.pushFormat(PETSc.Viewer.Format.HDF5_XDMF)
plex = PETSc.DMPlex().create()
plex.setType("plex")
plex.load(viewer)
cells = plex.getHeightStratum(0)
comm = PETSc.COMM_WORLD.tompi4py()
total = comm.allreduce(cells[1] - cells[0])
if comm.rank == 0:
    print(total, plex.getDimension())
"""


class Xdmf(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.meshes = {case: Mesh(case, 2) for case in ("core", "bracket")}
        for mesh in cls.meshes.values():
            cls.addClassCleanup(mesh.remove)
        cls.folders = {case: mesh.convert("xdmf") for case, mesh in cls.meshes.items()}

    def dolfinx(self, case, ranks):
        mesh = self.meshes[case]
        file = self.folders[case] / "mesh.xdmf"
        counts = [len(mesh.volumes()), len(mesh.areas())]
        found = mpirun(ranks, ["/usr/bin/python3", HERE / "xdmf_dolfinx.py", file, *counts],
                       folder=mesh.folder)  # fmt: skip
        return json.loads(found.splitlines()[-1])

    def check(self, case):
        mesh = self.meshes[case]
        serial, parallel = self.dolfinx(case, 1), self.dolfinx(case, 3)
        for found in (serial, parallel):
            self.assertEqual(found["cells"], mesh.num_tets())
            for volume, expected in zip(found["volumes"], mesh.volumes().values()):
                self.assertAlmostEqual(volume / expected, 1.0, delta=1e-10)
            outer = mesh.outer_areas()
            for name, area in zip(mesh.areas(), found["areas"]):
                self.assertAlmostEqual(area, outer.get(name, 0.0), delta=1e-8)
            self.assertLess(max(found["errors"]), 1e-9)
        self.assertEqual(serial["facets"], parallel["facets"])
        self.assertAlmostEqual(parallel["heat"] / serial["heat"], 1.0, delta=1e-9)

    def test_dolfinx_three_materials(self):
        self.check("core")

    def test_dolfinx_bracket(self):
        self.check("bracket")

    def test_petsc_reads_the_tets(self):
        for case, folder in self.folders.items():
            for ranks in (1, 3):
                with self.subTest(case=case, ranks=ranks):
                    found = mpirun(ranks, ["/usr/bin/python3", "-c", PETSC, folder / "mesh.h5"])
                    self.assertEqual(found.split()[-2:], [str(self.meshes[case].num_tets()), "3"])

    def test_meshio(self):
        mesh, folder = self.meshes["core"], self.folders["core"]
        tets = meshio.read(folder / "tets.xdmf")
        self.assertEqual(len(tets.cells_dict["tetra"]), mesh.num_tets())
        self.assertEqual(set(tets.cell_data_dict["material"]["tetra"].ravel()), {1, 2, 3})
        self.assertEqual({name: tuple(tag) for name, tag in tets.field_data.items()},
                         {"core": (1, 3), "shell": (2, 3), "matrix": (3, 3)})
        triangles = meshio.read(folder / "boundary.xdmf")
        self.assertEqual(set(triangles.cell_data_dict["patch"]["triangle"].ravel()), {1, 2, 3})

    def test_names_are_there(self):
        mesh, folder = self.meshes["core"], self.folders["core"]
        with h5py.File(folder / "mesh.h5") as file:
            texts = [text.decode().rstrip("\0") for text in file["/names/patches"][:]]
            self.assertEqual(texts, list(mesh.areas()))
            self.assertEqual(set(file["/boundary/patch"][:, 0]), {1, 2, 3})
            self.assertEqual(file["/viz/topology/cells"].shape, (mesh.num_tets(), 4))
        root = xml.etree.ElementTree.parse(folder / "mesh.xdmf").getroot()
        names = {line.get("Name"): line.get("Value") for line in root.iter("Information")}
        self.assertEqual([names[f"patch {number}"] for number in (1, 2, 3)], texts)
        self.assertIn("core_skin", texts)
        self.assertEqual(names["material 1"], "core")


if __name__ == "__main__":
    solver_meshes.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Tets of second order as Gmsh, meshio, VTK's reader of Exodus and DOLFINx read them: curved the right way round, with the
volumes and areas that the pieces have. calculix_test.py computes with C3D10."""
import json
import pathlib
import unittest

import gmsh
import meshio
import numpy as np
import solver_meshes
from solver_meshes import Mesh, mpirun, read_pvtu
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader as Exodus

HERE = pathlib.Path(__file__).parent
FORMATS = ("msh", "msh2", "abaqus", "exodus", "xdmf")

# Integrates cubics over a tet: what the Jacobian determinant of a tet of second order is.
TET_RULE = [((0.25, 0.25, 0.25), -4 / 5), *(
    (tuple(0.5 if i == j else 1 / 6 for j in range(3)), 9 / 20) for i in range(4)
)]  # fmt: skip
# Degree 5: the area of a curved triangle is no polynomial, so this is for comparing alone.
_A, _B = (6 - 15**0.5) / 21, (6 + 15**0.5) / 21
TRIANGLE_RULE = [((1 / 3, 1 / 3), 9 / 40), *(
    ((1 - 2 * s if i == 0 else s, 1 - 2 * s if i == 1 else s), weight)
    for s, weight in ((_A, (155 - 15**0.5) / 1200), (_B, (155 + 15**0.5) / 1200)) for i in range(3)
)]  # fmt: skip


def slopes(edges, at):
    """Derivatives of the shape functions, VTK's order: shape (nodes, dimension)."""
    dimension = len(at)
    weights = np.array([1 - sum(at), *at])
    of_weights = np.vstack([-np.ones(dimension), np.eye(dimension)])
    corners = [(4 * weights[c] - 1) * of_weights[c] for c in range(dimension + 1)]
    nodes = [4 * (weights[a] * of_weights[b] + weights[b] * of_weights[a]) for a, b in edges]
    return np.array(corners + nodes)


def curved_volumes(points, tets):
    """Of each tet of ten nodes."""
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
    return sum(weight / 6 * np.linalg.det(np.einsum("tni,nj->tij", points[tets], slopes(edges, at)))
               for at, weight in TET_RULE)  # fmt: skip


def curved_areas(points, triangles):
    """Of each triangle of six nodes."""
    edges, areas = [(0, 1), (1, 2), (0, 2)], 0.0
    for at, weight in TRIANGLE_RULE:
        sides = np.einsum("tni,nj->tij", points[triangles], slopes(edges, at))
        areas = areas + weight / 2 * np.linalg.norm(np.cross(sides[:, :, 0], sides[:, :, 1]), axis=1)
    return areas


def sums_by_tag(values, tags):
    return {int(tag): float(values[tags == tag].sum()) for tag in np.unique(tags)}


class SecondOrder(unittest.TestCase):
    """Three materials, curved surfaces between them."""

    @classmethod
    def setUpClass(cls):
        cls.mesh = Mesh("core", 3, "output.order=2", "refine.levels=1")
        cls.addClassCleanup(cls.mesh.remove)
        cls.folders = {name: cls.mesh.convert(name) for name in FORMATS}
        points, triangles, arrays, texts = read_pvtu(cls.mesh.mesh / "boundary.pvtu")
        areas = sums_by_tag(curved_areas(points, triangles), arrays["patch"])
        cls.areas = dict.fromkeys(texts["patch_names"], 0.0)  # Several patches have one name.
        for tag, area in areas.items():
            cls.areas[texts["patch_names"][tag]] += area
        cls.num_triangles = len(triangles)
        points, tets, arrays, texts = read_pvtu(cls.mesh.mesh / "mesh.pvtu")
        volumes = sums_by_tag(curved_volumes(points, tets), arrays["attribute"])
        cls.volumes = {texts["material_names"][tag - 1]: volume for tag, volume in volumes.items()}

    def assert_sizes(self, found, expected, tolerance=1e-10):
        self.assertEqual({name.lower() for name in found}, set(expected))
        for name, size in found.items():
            self.assertAlmostEqual(size / expected[name.lower()], 1.0, delta=tolerance)

    def test_reference_is_that_of_the_report(self):
        report = self.mesh.report()
        self.assertAlmostEqual(sum(self.volumes.values()) / report["volume"], 1.0, delta=1e-12)
        self.assert_sizes({"core": 4 / 3 * np.pi * 2**3}, {"core": self.volumes["core"]}, 1e-3)
        self.assert_sizes({"core_skin": 4 * np.pi * 2**2}, {"core_skin": self.areas["core_skin"]}, 1e-3)

    def gmsh_sizes(self, dimension, kind):
        """Volume or area by name, from Gmsh's own Jacobians, which are positive."""
        found, num_cells = {}, 0
        for _, entity in gmsh.model.getEntities(dimension):
            (group,) = gmsh.model.getPhysicalGroupsForEntity(dimension, entity)
            kinds, tags, _ = gmsh.model.mesh.getElements(dimension, entity)
            self.assertEqual(list(kinds), [kind])
            at, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss5")
            _, determinants, _ = gmsh.model.mesh.getJacobians(kind, at, entity)
            determinants = determinants.reshape(len(tags[0]), len(weights))
            self.assertGreater(determinants.min(), 0.0)
            found[gmsh.model.getPhysicalName(dimension, group)] = float((determinants @ weights).sum())
            num_cells += len(tags[0])
        return found, num_cells

    def test_gmsh(self):
        gmsh.initialize(["", "-nopopup"], readConfigFiles=False)
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)
        for name, file in (("msh", "mesh.msh"), ("msh2", "mesh_v2.msh")):
            with self.subTest(name):
                gmsh.clear()
                gmsh.logger.start()
                gmsh.open(str(self.folders[name] / file))
                said = [line for line in gmsh.logger.get() if line.startswith(("Error", "Warning"))]
                gmsh.logger.stop()
                self.assertEqual(said, [])
                self.assertEqual(len(gmsh.model.mesh.getNodes()[0]), self.mesh.report()["num_vertices"])
                volumes, num_tets = self.gmsh_sizes(3, 11)
                areas, num_triangles = self.gmsh_sizes(2, 9)
                self.assertEqual((num_tets, num_triangles), (self.mesh.num_tets(), self.num_triangles))
                self.assert_sizes(volumes, self.volumes)
                self.assert_sizes(areas, self.areas, 1e-6)

    def check_meshio(self, found, blocks):
        """`blocks`: tets by name of the material."""
        self.assertEqual(len(found.points), self.mesh.report()["num_vertices"])
        self.assertEqual(sum(map(len, blocks.values())), self.mesh.num_tets())
        volumes = {name: curved_volumes(found.points, tets) for name, tets in blocks.items()}
        self.assert_sizes({name: each.sum() for name, each in volumes.items()}, self.volumes, 1e-9)
        self.assertGreater(min(each.min() for each in volumes.values()), 0.0)

    def test_meshio_of_msh(self):
        for name, file in (("msh", "mesh.msh"), ("msh2", "mesh_v2.msh")):
            with self.subTest(name):
                found = meshio.read(self.folders[name] / file)
                tets, tags = found.get_cells_type("tetra10"), found.get_cell_data("gmsh:physical", "tetra10")
                names = {tag: name for name, (tag, dimension) in found.field_data.items() if dimension == 3}
                self.check_meshio(found, {name: tets[tags == tag] for tag, name in names.items()})
                self.assertEqual(len(found.get_cells_type("triangle6")), self.num_triangles)

    def test_meshio_of_abaqus(self):
        found = meshio.read(self.folders["abaqus"] / "mesh.inp")
        blocks = {}
        for row, block in enumerate(found.cells):
            rows = {name: sets[row] for name, sets in found.cell_sets.items() if name != "EALL"}
            (name,) = (name for name, some in rows.items() if some is not None and len(some))
            self.assertEqual(block.type, "tetra10")
            blocks[name] = block.data
        self.check_meshio(found, blocks)

    def test_meshio_of_exodus(self):
        found = meshio.read(self.folders["exodus"] / "mesh.exo")
        self.assertEqual({block.type for block in found.cells}, {"tetra10"})
        self.check_meshio(found, dict(zip(self.volumes, (block.data for block in found.cells))))

    def test_meshio_of_xdmf(self):
        found = meshio.read(self.folders["xdmf"] / "tets.xdmf")
        tets, tags = found.cells_dict["tetra10"], found.cell_data_dict["material"]["tetra10"].ravel()
        names = {int(tag): name for name, (tag, _) in found.field_data.items()}
        self.check_meshio(found, {name: tets[tags == tag] for tag, name in names.items()})
        found = meshio.read(self.folders["xdmf"] / "boundary.xdmf")
        areas = sums_by_tag(curved_areas(found.points, found.cells_dict["triangle6"]),
                            found.cell_data_dict["patch"]["triangle6"].ravel())  # fmt: skip
        names = {int(tag): name for name, (tag, _) in found.field_data.items()}
        self.assert_sizes({names[tag]: area for tag, area in areas.items()}, self.areas)

    def test_vtk_reads_exodus(self):
        reader = Exodus()
        reader.SetFileName(str(self.folders["exodus"] / "mesh.exo"))
        reader.UpdateInformation()
        names = [reader.GetObjectName(Exodus.SIDE_SET, i) for i in range(reader.GetNumberOfObjects(Exodus.SIDE_SET))]
        for i in range(len(names)):
            reader.SetObjectStatus(Exodus.SIDE_SET, i, 1)
        reader.Update()
        sizes = []
        walk = reader.GetOutput().NewIterator()
        walk.InitTraversal()
        while not walk.IsDoneWithTraversal():
            grid = walk.GetCurrentDataObject()
            cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
            points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
            measure = {10: curved_volumes, 6: curved_areas}[cells.shape[1]]
            sizes.append(measure(points, cells).sum())
            walk.GoToNextItem()
        num_blocks = len(self.volumes)
        self.assertEqual(len(sizes), num_blocks + len(names))
        self.assert_sizes(dict(zip(self.volumes, sizes)), self.volumes, 1e-5)  # Points of 32 bits.
        self.assert_sizes(dict(zip(names, sizes[num_blocks:])), self.areas, 1e-5)

    def test_dolfinx(self):
        """Its own integrals of materials and of the outside, and a solution that is among those of its elements."""
        file = self.folders["xdmf"] / "mesh.xdmf"
        heat = []
        for ranks in (1, 3):
            command = ["/usr/bin/python3", HERE / "xdmf_dolfinx.py", file, len(self.volumes), len(self.areas)]
            found = json.loads(mpirun(ranks, command, folder=self.mesh.folder).splitlines()[-1])
            self.assertEqual(found["order"], 2)
            self.assertEqual(found["cells"], self.mesh.num_tets())
            self.assert_sizes(dict(zip(self.mesh.volumes(), found["volumes"])), self.volumes)
            outside = list(self.mesh.areas()).index("outside")
            self.assertAlmostEqual(found["areas"][outside] / self.areas["outside"], 1.0, delta=1e-9)
            self.assertLess(max(found["errors"]), 1e-9)
            heat.append(found["heat"])
        self.assertAlmostEqual(heat[1] / heat[0], 1.0, delta=1e-9)


if __name__ == "__main__":
    solver_meshes.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Files of several formats as meshio reads them, and mesh.exo as VTK does: counts, tags, names."""
import unittest

import meshio
import numpy
import solver_meshes
from solver_meshes import Mesh, read_pvtu, tet_volumes, triangle_areas
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader as Exodus

CASES = ("core", "bracket")


def in_order(xyz):
    """Rows by their coordinates."""
    return xyz[numpy.lexsort(xyz.T)]


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.meshes = {case: Mesh(case, 3) for case in CASES}
        cls.folders = {}
        for case, mesh in cls.meshes.items():
            cls.addClassCleanup(mesh.remove)
            for word in ("abaqus", "medit", "exodus"):
                cls.folders[case, word] = mesh.convert(word)

    def each(self, word, name):
        for case, mesh in self.meshes.items():
            with self.subTest(case=case):
                yield mesh, self.folders[case, word] / name

    def assert_points(self, mesh, found):
        points, _, arrays, _ = read_pvtu(mesh.mesh / "mesh.pvtu")
        _, rows = numpy.unique(arrays["GlobalPointIds"], return_index=True)
        self.assertEqual(len(found), len(rows))
        numpy.testing.assert_allclose(in_order(found.round(9)), in_order(points[rows].round(9)), atol=2e-9)

    def assert_blocks(self, mesh, points, blocks):
        """`blocks`: tets by name of the material, perhaps in capitals."""
        volumes = {name.lower(): value for name, value in mesh.volumes().items()}
        self.assertEqual({name.lower() for name in blocks}, set(volumes))
        self.assertEqual(sum(map(len, blocks.values())), mesh.num_tets())
        for name, tets in blocks.items():
            self.assertAlmostEqual(tet_volumes(points, tets).sum() / volumes[name.lower()], 1.0, delta=1e-9)

    def test_abaqus(self):
        for mesh, file in self.each("abaqus", "mesh.inp"):
            found = meshio.read(file)
            self.assert_points(mesh, found.points)
            names = [name for name in found.cell_sets if name != "EALL"]
            blocks = {}
            for row, block in enumerate(found.cells):
                (name,) = (n for n in names if found.cell_sets[n][row] is not None and len(found.cell_sets[n][row]))
                blocks[name] = block.data
            self.assert_blocks(mesh, found.points, blocks)
            self.assertEqual({name.lower() for name in found.point_sets},
                             {f"n_{name}".lower() for name in mesh.areas()})  # fmt: skip

    def test_medit(self):
        for mesh, file in self.each("medit", "mesh.mesh"):
            found = meshio.read(file)
            self.assert_points(mesh, found.points)
            tags = dict(zip((block.type for block in found.cells), found.cell_data["medit:ref"]))
            tets, triangles = found.cells_dict["tetra"], found.cells_dict["triangle"]
            self.assert_blocks(mesh, found.points, {
                name: tets[tags["tetra"] == tag] for tag, name in enumerate(mesh.volumes(), 1)
            })  # fmt: skip
            areas = sorted(mesh.areas().values())
            sums = sorted(
                triangle_areas(found.points, triangles[tags["triangle"] == tag]).sum()
                for tag in range(1, len(areas) + 1)
            )
            numpy.testing.assert_allclose(sums, areas, rtol=1e-9)
            self.assertEqual(len(triangles), sum(mesh.triangles().values()))

    def test_exodus(self):
        for mesh, file in self.each("exodus", "mesh.exo"):
            found = meshio.read(file)
            self.assert_points(mesh, found.points)
            self.assert_blocks(mesh, found.points, dict(zip(mesh.volumes(), (b.data for b in found.cells))))
            self.assertEqual(set(found.point_sets), set(mesh.areas()))

    def test_vtk_reads_exodus(self):
        for mesh, file in self.each("exodus", "mesh.exo"):
            reader = Exodus()
            reader.SetFileName(str(file))
            reader.UpdateInformation()
            names = {}
            for kind in (Exodus.ELEM_BLOCK, Exodus.SIDE_SET, Exodus.NODE_SET):
                names[kind] = [reader.GetObjectName(kind, i) for i in range(reader.GetNumberOfObjects(kind))]
                for i in range(len(names[kind])):
                    reader.SetObjectStatus(kind, i, 1)
            self.assertEqual(names[Exodus.ELEM_BLOCK], list(mesh.volumes()))
            self.assertEqual(set(names[Exodus.SIDE_SET]), set(mesh.areas()))
            self.assertEqual(names[Exodus.NODE_SET], names[Exodus.SIDE_SET])
            reader.Update()
            self.check_vtk_grids(mesh, names, reader.GetOutput())

    def check_vtk_grids(self, mesh, names, output):
        found = []
        walk = output.NewIterator()
        walk.InitTraversal()
        while not walk.IsDoneWithTraversal():
            grid = walk.GetCurrentDataObject()
            cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
            found.append((vtk_to_numpy(grid.GetPoints().GetData()).astype(float), cells))
            walk.GoToNextItem()
        blocks, sides = names[Exodus.ELEM_BLOCK], names[Exodus.SIDE_SET]
        self.assertEqual(len(found), len(blocks) + 2 * len(sides))
        for (points, tets), expected in zip(found, mesh.volumes().values()):
            self.assertAlmostEqual(tet_volumes(points, tets).sum() / expected, 1.0, delta=1e-5)  # Points of 32 bits.
        areas = mesh.areas()
        for (points, triangles), name in zip(found[len(blocks) :], sides):
            self.assertAlmostEqual(triangle_areas(points, triangles).sum() / areas[name], 1.0, delta=1e-5)


if __name__ == "__main__":
    solver_meshes.main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mesh.to_meshio(): cells, materials, patches and names, also after a way through Gmsh's formats.

    tests/solvers/python_meshio_test.py --tessera build/release/bin/tessera
"""
import sys

import numpy as np
import python_ranks
from python_ranks import RanksTest, areas, volumes


def sums_by_name(given, kind, dimension, sizes):
    """What meshio.Mesh `given` says: the size of all cells of one kind with each physical name."""
    (block,) = [i for i, cells in enumerate(given.cells) if cells.type == kind]
    tags = given.cell_data["gmsh:physical"][block]
    names = {int(tag): name for name, (tag, d) in given.field_data.items() if d == dimension}
    return {names[int(tag)]: sizes[tags == tag].sum() for tag in np.unique(tags)}


class Meshio(RanksTest):
    meshes = ("core",)

    def test_names_and_cells_survive_gmsh(self):
        import meshio
        import tessera

        mesh = tessera.read(self.folder / "core")
        volume, area = volumes(mesh), areas(mesh)
        given = mesh.to_meshio(gmsh=True)
        files = [("a.msh", "gmsh22"), ("b.msh", "gmsh22")]
        for name, file_format in files:
            meshio.write(self.folder / name, given, file_format=file_format, binary=name == "b.msh")
        for made in (given, *(meshio.read(self.folder / name) for name, _ in files)):
            np.testing.assert_allclose(made.points, mesh.points, rtol=0, atol=1e-12)
            np.testing.assert_array_equal(made.get_cells_type("tetra"), mesh.cells)
            np.testing.assert_array_equal(made.get_cells_type("triangle"), mesh.triangles)
            found = sums_by_name(made, "tetra", 3, volume)
            self.assertEqual(sorted(found), sorted(mesh.names.materials))
            for name, sum_of_name in found.items():
                wanted = volume[np.isin(mesh.materials, mesh.material_tags(name))].sum()
                self.assertAlmostEqual(sum_of_name / wanted, 1.0, delta=1e-12)
            found = sums_by_name(made, "triangle", 2, area)
            self.assertEqual(sorted(found), sorted(set(mesh.names.patches)))
            self.assertAlmostEqual(found["outside"] / mesh.report["boundary_area"], 1.0, delta=1e-12)

    def test_arrays_survive_vtu_and_xdmf(self):
        import meshio
        import tessera

        mesh = tessera.read(self.folder / "core")
        for name in ("c.vtu", "d.xdmf"):
            meshio.write(self.folder / name, mesh.to_meshio())
            made = meshio.read(self.folder / name)
            kinds = [cells.type for cells in made.cells]
            for key, kind, wanted in (("material", "tetra", mesh.materials), ("patch", "triangle", mesh.patches)):
                np.testing.assert_array_equal(made.cell_data[key][kinds.index(kind)], wanted)

    def test_one_name_of_a_material_and_a_patch(self):
        import tessera

        mesh = tessera.read(self.folder / "core")
        mesh.names.patches[6] = mesh.names.materials[0]
        names = mesh.to_meshio(gmsh=True).field_data
        self.assertEqual(names["core"].tolist(), [1, 3])
        self.assertEqual(names["core (patch)"].tolist(), [7, 2])


if __name__ == "__main__":
    sys.exit(python_ranks.main(globals()))

# SPDX-License-Identifier: BSD-3-Clause
"""GetFEM solves on mesh_v2.msh: volumes and areas by region, the patch test, and conduction through
two materials, and through a plate with layers."""
import pathlib
import tempfile
import unittest

import getfem
import numpy as np
import solver_meshes
from solver_meshes import Mesh, read_pvtu

PLATE = """algebraic3d
solid plate = plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0.5; 0, 0, 1) and plane (0, 0, 0; -1, 0, 0)
    and plane (2, 0, 0; 1, 0, 0) and plane (0, 0, 0; 0, -1, 0) and plane (0, 1, 0; 0, 1, 0);
tlo plate;
"""
LAYERS = """geometry.file = "plate.geo"
size.target = 0.2
[[layer]]
patch = "*"
first = 0.001
growth = 1.5
count = 6
"""


class Problem:
    """Conduction with linear elements on an MSH file. Regions are the tags of the file."""

    def __init__(self, file):
        self.mesh = getfem.Mesh("import", "gmsh", str(file))
        self.temperatures = getfem.MeshFem(self.mesh, 1)
        self.temperatures.set_fem(getfem.Fem("FEM_PK(3,1)"))
        self.integration = getfem.MeshIm(self.mesh, getfem.Integ("IM_TETRAHEDRON(2)"))
        names, self.tags = False, {2: {}, 3: {}}
        for line in file.read_text(encoding="utf-8").splitlines():
            if line == "$EndPhysicalNames":
                break
            if names and line.count('"') == 2:
                dimension, tag, name = line.split(" ", 2)
                self.tags[int(dimension)][name.strip('"')] = int(tag)
            names = names or line == "$PhysicalNames"

    def size(self, tag):
        return float(getfem.asm_generic(self.integration, 0, "1", tag))

    def points(self):
        return self.temperatures.basic_dof_nodes()

    def solve(self, conductivities, fixed, exact):
        """Temperatures where those on some patches are the given ones."""
        model = getfem.Model("real")
        model.add_fem_variable("u", self.temperatures)
        for name, conductivity in conductivities.items():
            tag = self.tags[3][name]
            model.add_initialized_data(f"k{tag}", conductivity)
            model.add_linear_term(self.integration, f"k{tag}*Grad_u.Grad_Test_u", tag)
        model.add_initialized_fem_data("g", self.temperatures, exact)
        for name in fixed:
            model.add_Dirichlet_condition_with_simplification("u", self.tags[2][name], "g")
        model.solve("max_res", 1e-13, "max_iter", 1)
        return model.variable("u")


class GetFEM(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        getfem.util_trace_level(0)
        getfem.util_warning_level(0)
        cls.meshes, cls.problems = {}, {}
        for case in ("core", "bracket", "blocks"):
            mesh = cls.meshes[case] = Mesh(case, 2)
            cls.addClassCleanup(mesh.remove)
            cls.problems[case] = Problem(mesh.convert("msh2") / "mesh_v2.msh")

    def each(self, cases):
        for case in cases:
            with self.subTest(case=case):
                yield self.meshes[case], self.problems[case]

    def test_regions_are_materials_and_patches(self):
        for mesh, problem in self.each(("core", "bracket")):
            self.assertEqual(problem.mesh.nbcvs(), mesh.num_tets())
            self.assertEqual(problem.mesh.nbpts(), mesh.report()["num_vertices"])
            self.assertEqual(set(problem.tags[3]), set(mesh.volumes()))
            for name, volume in mesh.volumes().items():
                self.assertAlmostEqual(problem.size(problem.tags[3][name]) / volume, 1.0, delta=1e-10)
            outer = mesh.outer_areas()
            self.assertEqual(set(problem.tags[2]), set(mesh.areas()))
            for name, area in mesh.areas().items():
                # Of a triangle within, GetFEM has the faces of both tets.
                expected = area if name in outer else 2.0 * area
                self.assertAlmostEqual(problem.size(problem.tags[2][name]) / expected, 1.0, delta=1e-10)

    def test_patch_test(self):
        for mesh, problem in self.each(("core", "bracket")):
            x, y, z = problem.points()
            exact = 1.0 + 2.0 * x - 3.0 * y + z
            found = problem.solve(
                dict.fromkeys(mesh.volumes(), 1.0), mesh.outer_areas(), exact
            )
            self.assertLess(abs(found - exact).max() / abs(exact).max(), 1e-10)

    def test_two_materials(self):
        """Heat flows across a plane contact: the temperature is linear in each block."""
        (mesh, problem), = self.each(("blocks",))
        points, tets, arrays, texts = read_pvtu(mesh.mesh / "mesh.pvtu")
        boxes = []
        for tag in (1, 2):
            own = points[tets[arrays["attribute"] == tag]].reshape(-1, 3)
            boxes.append((own.min(axis=0), own.max(axis=0)))
        axis, contact = self.contact_of(boxes)
        conductivity = dict(zip(texts["material_names"], (1.0, 40.0)))
        place = problem.points()[axis] - contact
        below, above = conductivity.values()
        exact = np.where(place < 0.0, place / below, place / above)
        found = problem.solve(conductivity, mesh.outer_areas(), exact)
        self.assertLess(abs(found - exact).max() / abs(exact).max(), 1e-10)
        wrong = problem.solve(dict.fromkeys(conductivity, 1.0), mesh.outer_areas(), exact)
        self.assertGreater(abs(wrong - exact).max() / abs(exact).max(), 1e-3)

    def test_layers(self):
        """Heat flows across a plate between its two large sides: flat tets give the linear temperature too."""
        with tempfile.TemporaryDirectory() as scratch:
            (pathlib.Path(scratch) / "plate.geo").write_text(PLATE)
            case = pathlib.Path(scratch) / "plate.toml"
            case.write_text(LAYERS)
            mesh = Mesh(case, 2)
        self.addCleanup(mesh.remove)
        self.assertGreater(mesh.report()["layers"]["full_height"], 0.99)
        problem = Problem(mesh.convert("msh2", "--layers", "tets") / "mesh_v2.msh")
        self.assertEqual(problem.mesh.nbcvs(), mesh.num_tets())
        sides = [name for name, area in mesh.areas().items() if abs(area - 2.0) < 1e-9]
        self.assertEqual(len(sides), 2)
        exact = 1.0 + 2.0 * problem.points()[2]
        found = problem.solve(dict.fromkeys(mesh.volumes(), 1.0), sides, exact)
        self.assertLess(abs(found - exact).max() / abs(exact).max(), 1e-8)

    def contact_of(self, boxes):
        """Along which axis, and where, the second block follows the first."""
        (_, end), (begin, _) = boxes
        axes = np.flatnonzero(abs(end - begin) < 1e-9)
        self.assertEqual(len(axes), 1)
        return axes[0], float(end[axes[0]])


if __name__ == "__main__":
    solver_meshes.main()

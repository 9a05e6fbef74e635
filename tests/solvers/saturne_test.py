# SPDX-License-Identifier: BSD-3-Clause
"""Code_Saturne's preprocessor reads mesh.msh with its groups, and its solver measures the mesh."""
import pathlib
import re
import unittest

import solver_meshes
from solver_meshes import Mesh, run

PROGRAMS = pathlib.Path("/usr/lib/code_saturne")


class Saturne(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.meshes = {case: Mesh(case, 3) for case in ("core", "bracket")}
        cls.said, cls.log = {}, {}
        for case, mesh in cls.meshes.items():
            cls.addClassCleanup(mesh.remove)
            folder = mesh.convert("msh")
            cls.said[case] = run([PROGRAMS / "cs_preprocess", "mesh.msh"], folder=folder)
            run([PROGRAMS / "cs_solver", "--quality"], folder=folder)
            cls.log[case] = (folder / "run_solver.log").read_text(encoding="utf-8")

    def number(self, case, pattern):
        found = re.search(pattern, self.log[case])
        self.assertIsNotNone(found, pattern)
        return found[1]

    def counts_by_group(self, case):
        """Cells and faces of each group. Groups stand there by name, and once more by tag."""
        counts = {}
        for group, lines in re.findall(r'^    "(.+)"\n((?:       .+: +\d+\n)+)', self.log[case], re.M):
            numbers = re.findall(r"^ +(.+): +(\d+)$", lines, re.M)
            counts[group] = {kind: int(count) for kind, count in numbers}
        return {name: count for name, count in counts.items() if not name.isdigit()}

    def test_cells_and_faces_by_group(self):
        for case, mesh in self.meshes.items():
            with self.subTest(case=case):
                found = self.counts_by_group(case)
                for material in mesh.report()["materials"]:
                    self.assertEqual(found.pop(material["name"]), {"cells": material["tets"]})
                outer, names = mesh.outer_areas(), list(mesh.areas())
                faces = mesh.triangles()
                for name in names:
                    kind = "boundary faces" if name in outer else "interior faces"
                    self.assertEqual(found.pop(name), {kind: faces[name]})
                self.assertEqual(found, {})

    def test_the_solver_finds_the_volume_and_no_boundary_within(self):
        for case, mesh in self.meshes.items():
            with self.subTest(case=case):
                volume = float(self.number(case, r"Total volume for the domain = +(\S+)"))
                self.assertAlmostEqual(volume / mesh.report()["volume"], 1.0, delta=1e-7)
                smallest = float(self.number(case, r"Minimum control volume += +(\S+)"))
                self.assertGreater(smallest, 0.0)
                self.assertEqual(int(self.number(case, r"Number of cells: +(\d+)")), mesh.num_tets())
                outer = set(mesh.outer_areas())
                on_outside = sum(
                    count for name, count in mesh.triangles().items() if name in outer
                )
                boundary = int(self.number(case, r"Number of boundary faces: +(\d+)"))
                self.assertEqual(boundary, on_outside)


if __name__ == "__main__":
    solver_meshes.main()

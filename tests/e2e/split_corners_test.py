# SPDX-License-Identifier: BSD-3-Clause
"""fill.split_corners: no tet has two faces on the geometry, whatever made it."""
import os
import pathlib
import sys
import unittest

import numpy as np
import program
from program import OK

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "src" / "python"))
os.environ["TESSERA"] = program.PROGRAM

import tessera  # noqa: E402  From the sources.

SPLIT = program.sets("fill.split_corners=true")


def num_corner_tets(folder):
    """Tets with several faces among the triangles on the geometry, between materials too."""
    mesh = tessera.read(folder)
    faces = mesh.cells[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3)
    keys = np.array([len(mesh.points) ** 2, len(mesh.points), 1])
    is_outer = np.isin(np.sort(faces) @ keys, np.sort(mesh.triangles) @ keys)
    return int((is_outer.reshape(-1, 4).sum(axis=1) > 1).sum())


class SplitCorners(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("core.geo", program.TWO_MATERIALS)
        self.write("cut.geo", CUT_BALL)

    def case(self, geometry, **more):
        return self.write_case(
            name=f"{geometry}.toml", geometry=f"{geometry}.geo", max_size=0.8, subdomains=6, **more
        )

    def test_by_each_kernel(self):
        for kernel in ("subdivide", "netgen", "optimize"):
            with self.subTest(kernel):
                options = program.sets(f"fill.kernel={kernel}")
                plain = self.mesh(self.case("cut"), f"plain_{kernel}", *options)
                self.assertGreater(num_corner_tets(plain), 0, "the test has nothing to look for")
                folder = self.mesh(self.case("cut"), kernel, *options, *SPLIT)
                self.assertEqual(num_corner_tets(folder), 0)
                before, after = program.figures(plain), program.figures(folder)
                self.assertAlmostEqual(after["volume"], before["volume"], delta=1e-9 * before["volume"])
                self.assertEqual(after["boundary_area"], before["boundary_area"])
                outcome = self.run_program("check", folder / "mesh.pvtu")
                self.assertEqual(outcome.code, OK, outcome.err + outcome.out)

    def test_where_levels_differ_and_after_a_split(self):
        graded = program.sets("size.target=0.3", 'size.region=[{shape="ball",center=[0,0,1],radius=0.3,size=0.1}]')
        for name, options in (
            ("split", program.sets("refine.levels=2", "fill.levels=1")),
            ("curved", program.sets("output.order=2")),
            ("materials", []),
        ):
            with self.subTest(name):
                case = self.case("core" if name == "materials" else "cut")
                folder = self.mesh(case, name, *options, *SPLIT)
                if name != "curved":
                    self.assertEqual(num_corner_tets(folder), 0)
                self.assertEqual(self.run_program("check", folder / "mesh.pvtu").code, OK)
        del graded

    def test_any_number_of_ranks_and_resumed(self):
        case = self.case("core")
        alone = self.mesh(case, "alone", *SPLIT)
        other = self.mesh(case, "other", *SPLIT, ranks=3)
        self.assertEqual(program.figures(other), program.figures(alone))
        self.assertEqual(program.mesh_files(other), program.mesh_files(alone))


if __name__ == "__main__":
    unittest.main()

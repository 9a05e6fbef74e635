# SPDX-License-Identifier: BSD-3-Clause
"""fill.split_corners: no tet has two faces on the geometry, whatever made it."""
import os
import pathlib
import sys
import unittest

import kill
import numpy as np
import program
from program import WRONG_INPUT

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "src" / "python"))
os.environ["TESSERA"] = program.PROGRAM

import tessera  # noqa: E402  From the sources.

SPLIT = program.sets("fill.split_corners=true")
KEEP = program.sets("fill.split_corners=false")

# Along its edge tets have a face on the plane and one on the sphere.
HALF_BALL = "algebraic3d\nsolid half = sphere (0, 0, 0; 1) and plane (0, 0, 0; 0, 0, 1);\ntlo half;\n"


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
        self.write("two.geo", program.TWO_MATERIALS)
        self.write("half.geo", HALF_BALL)

    def made(self, geometry, folder, *values, split=True, ranks=None):
        case = self.write_case(geometry=f"{geometry}.geo", max_size=0.6, subdomains=6)
        return self.mesh(case, folder, *program.sets(*values), *(SPLIT if split else KEEP), ranks=ranks)

    def test_by_each_kernel(self):
        for kernel in ("subdivide", "netgen", "optimize"):
            with self.subTest(kernel):
                keys = ("coarse.max_size=0.4", "refine.levels=2", f"fill.kernel={kernel}")
                plain = self.made("half", f"plain_{kernel}", *keys, split=False)
                num_before = num_corner_tets(plain)
                self.assertGreater(num_before, 0, "the test has nothing to look for")
                split = self.made("half", kernel, *keys)
                self.assertEqual(num_corner_tets(split), 0)
                before, _ = self.assert_checked(plain, volume_tolerance=1e-12)
                after, _ = self.assert_checked(split, volume_tolerance=1e-12)
                self.assertAlmostEqual(after["volume"], before["volume"], delta=1e-9 * before["volume"])
                self.assertEqual(after["boundary_area"], before["boundary_area"])
                # Few tets are touched, and what becomes of them is not bad. They are 3 % of this small
                # mesh, and the others are so good that the worst percent is among them.
                self.assertLess(abs(after["num_tets"] - before["num_tets"]), 0.1 * before["num_tets"])
                for key, loss in (("mean", 0.01), ("p01", 0.1)):
                    shapes = [figures["quality"]["mean_ratio"][key] for figures in (before, after)]
                    self.assertGreater(shapes[1], shapes[0] - loss, key)

    def test_auto_leaves_alone_what_is_subdivided_but_for_openfoam(self):
        case = self.write_case(geometry="half.geo", max_size=0.6, subdomains=6)
        foam = 'output.formats=["pvtu", "openfoam-serial"]'
        for name, keys, has_corners in (
            ("netgen", (), False),
            ("optimize", ("fill.kernel=optimize",), False),
            ("subdivide", ("fill.kernel=subdivide",), True),
            ("foam", ("fill.kernel=subdivide", foam), False),
        ):
            with self.subTest(name):
                made = self.mesh(case, f"auto_{name}", *program.sets(*keys))
                self.assertEqual(num_corner_tets(made) > 0, has_corners)

    def test_whatever_follows_the_fill(self):
        region = "size.region=[{ball={centre=[1,0,0],radius=0.2},size=0.05}]"
        for name, keys in (
            ("levels_after_the_fill", ("refine.levels=3", "fill.levels=1")),
            ("levels_that_differ", ("refine.levels=3", "size.target=0.3", region)),
            ("another_kernel", ('fill.region=[{material="shell",kernel="subdivide"}]',)),
            ("parts", ("output.parts=2",)),
        ):
            with self.subTest(name):
                split = self.made("two" if name == "another_kernel" else "half", name, *keys)
                self.assertEqual(num_corner_tets(split), 0)
                self.assert_checked(split, volume_tolerance=1e-12)

    def test_of_second_order(self):
        self.assert_checked(self.made("half", "curved", "output.order=2", ranks=2), volume_tolerance=1e-12)

    def test_any_number_of_ranks(self):
        for kernel in ("subdivide", "netgen"):
            alone = self.made("half", f"alone_{kernel}", f"fill.kernel={kernel}")
            others = self.made("half", f"others_{kernel}", f"fill.kernel={kernel}", ranks=3)
            self.assertEqual(program.figures(others), program.figures(alone))
            self.assertEqual(program.mesh_files(others), program.mesh_files(alone))

    def test_numbers_are_not_known_before(self):
        case = self.write_case(geometry="half.geo", max_size=0.6, subdomains=6)
        outcome = self.run_program(
            "mesh", case, "--output", "some", *SPLIT, *program.sets("fill.kernel=subdivide"),
            "--only-subdomains", "1",
        )  # fmt: skip
        self.assert_refused(outcome, WRONG_INPUT, "--only-subdomains excludes fill.split_corners")


class Killed(kill.RestartTest):
    """One kernel's tets wait in the store, and are improved."""

    KEYS = ("refine.levels=2", "fill.kernel=optimize")

    @classmethod
    def make_arguments(cls, maker):
        maker.write("half.geo", HALF_BALL)
        case = maker.write_case(geometry="half.geo", max_size=0.5, subdomains=8)
        return [case, *program.sets(*cls.KEYS), *SPLIT]

    def assert_resumed(self):
        """With the bits of the reference, which is a mesh without such corners."""
        self.resume(ranks=3)
        self.assertEqual(num_corner_tets(self.out), 0)
        self.assert_checked(self.out, volume_tolerance=1e-12)

    def test_while_subdomains_are_filled(self):
        self.kill_run(self.has_pieces(3), ranks=2)
        self.assert_resumed()

    def test_while_files_are_written(self):
        self.kill_run(lambda watch: watch.wait_for_half_written_file("mesh"), ranks=2)
        self.assert_resumed()


class KilledOnGradedLevels(Killed):
    """Nothing is improved: pieces are split where levels differ, and then their corners."""

    KEYS = (
        "refine.levels=4", "fill.kernel=subdivide", "size.target=0.15",
        "size.region=[{ball={centre=[1,0,0],radius=0.2},size=0.04}]",
    )  # fmt: skip


if __name__ == "__main__":
    unittest.main()

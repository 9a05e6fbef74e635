# SPDX-License-Identifier: BSD-3-Clause
"""size.target: every coarse edge is split on levels of its own. The result is one mesh, with the same bits for any
number of ranks and after any interruption, whatever makes it."""
import json
import unittest

import kill
import program
from program import NO_PAGE, OK, sets

SUBDIVIDE = "fill.kernel=subdivide"
OPTIMIZE = "fill.kernel=optimize"


def write_graded_case(test, target, subdomains=6):
    """Two materials of different curvature, so that coarse edges have many lengths."""
    test.write("core.geo", program.TWO_MATERIALS)
    return test.write(
        "case.toml",
        f"geometry.file = 'core.geo'\nsize.target = {target}\ndecompose.subdomains = {subdomains}\n{NO_PAGE}",
    )


class GradedTest(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.case = write_graded_case(self, 0.45)

    def made(self, folder, *values, ranks=None):
        return self.mesh(self.case, folder, *sets(*values), ranks=ranks)

    def checked(self, folder):
        """Its figures; `check` finds the same in the files, and nothing wrong."""
        return self.assert_checked(folder, volume_tolerance=1e-9)[0]

    def assert_same(self, one, other):
        self.assertEqual(program.figures(one), program.figures(other))
        self.assertEqual(program.mesh_files(one), program.mesh_files(other))


class AnyNumberOfRanks(GradedTest):
    def test_has_the_same_bits(self):
        for kernel, others in (("subdivide", (2, 3, 5)), ("optimize", (3,)), ("netgen", (2,))):
            with self.subTest(kernel=kernel):
                alone = self.made(kernel, f"fill.kernel={kernel}", ranks=None)
                figures = self.checked(alone)
                self.assertEqual({piece["kernel"] for piece in figures["subdomains"]}, {kernel})
                for ranks in others:
                    self.assert_same(self.made(f"{kernel}_{ranks}", f"fill.kernel={kernel}", ranks=ranks), alone)


class Options(GradedTest):
    def levels_of(self, folder):
        return json.loads((folder / "report.json").read_text())["coarse"]["edges_by_level"]

    def test_edges_have_levels_of_their_own(self):
        out = self.made("out", SUBDIVIDE)
        levels = self.levels_of(out)
        self.assertGreater(sum(count > 0 for count in levels), 1, levels)
        figures = self.checked(out)
        # Not 8^L a coarse tet, nor what the coarsest edges alone would give.
        coarse_tets = json.loads((out / "report.json").read_text())["coarse"]["num_tets"]
        self.assertLess(figures["num_tets"], coarse_tets * 8 ** (len(levels) - 1))
        self.assertGreater(figures["num_tets"], coarse_tets)

    def test_beside_a_material_of_another_kernel(self):
        for kernel in ("optimize", "netgen"):
            with self.subTest(kernel=kernel):
                region = 'fill.region=[{material="core",kernel="subdivide"}]'
                figures = self.checked(self.made(kernel, f"fill.kernel={kernel}", region))
                self.assertEqual({piece["kernel"] for piece in figures["subdomains"]}, {kernel, "subdivide"})

    def test_a_split_does_not_make_the_mesh_finer_than_wanted(self):
        filled = self.checked(self.made("filled", OPTIMIZE))
        alone = self.made("alone", OPTIMIZE, "fill.levels=1", ranks=None)
        self.assertLess(self.checked(alone)["num_tets"], 1.15 * filled["num_tets"])
        self.assert_same(self.made("three", OPTIMIZE, "fill.levels=1", ranks=3), alone)

    def test_files_of_several_pieces_and_parts(self):
        plain = self.made("plain", SUBDIVIDE)
        files = self.made("files", SUBDIVIDE, "output.files=2", ranks=3)
        self.assertEqual(self.checked(files)["digest"], program.figures(plain)["digest"])
        parts = self.made("parts", OPTIMIZE, "output.parts=3")
        figures = self.checked(parts)
        self.assertEqual(sum(figures["parts"]["tets"]), figures["num_tets"])
        self.assertEqual(len(list((parts / "mesh").iterdir())), 3)
        self.assert_same(self.made("again", OPTIMIZE, "output.parts=3", ranks=None), parts)

    def test_some_subdomains_alone_are_those_of_the_whole(self):
        whole = program.mesh_files(self.made("whole", SUBDIVIDE))
        some = self.mesh(self.case, "some", *sets(SUBDIVIDE), "--only-subdomains", "1,3", ranks=2)
        files = {name: hash_ for name, hash_ in program.mesh_files(some).items() if "/" in name}
        self.assertEqual(len(files), 4)
        for name, hash_ in files.items():
            self.assertEqual(hash_, whole[name], name)

    def test_a_dry_run_foretells_the_mesh(self):
        for kernel, tolerance in ((SUBDIVIDE, 0.0), (OPTIMIZE, 0.2)):
            with self.subTest(kernel=kernel):
                outcome = self.run_program(
                    "mesh", self.case, "--dry-run", "--output", kernel[12:], *sets(kernel)
                )
                self.assertEqual(outcome.code, OK, outcome.err)
                out = self.made(kernel[12:], kernel)
                compared = json.loads((out / "report.json").read_text())["prediction"]
                self.assertLessEqual(abs(compared["tets"]["error"]), tolerance, compared["tets"])
                self.assertLessEqual(abs(compared["vertices"]["error"]), tolerance, compared["vertices"])
                self.assertEqual(compared["boundary_triangles"]["error"], 0)
                self.assertEqual(compared["files"]["error"], 0)


class Killed(kill.RestartTest):
    @staticmethod
    def make_arguments(maker):
        return [write_graded_case(maker, 0.2, subdomains=8), *sets(OPTIMIZE)]

    def test_while_subdomains_are_filled(self):
        self.kill_run(self.has_pieces(2), ranks=2)
        self.resume(ranks=3)

    def test_while_files_are_written(self):
        self.kill_run(lambda watch: watch.wait_for_stage("write"), kind="rank", ranks=2)
        self.resume()


if __name__ == "__main__":
    unittest.main()

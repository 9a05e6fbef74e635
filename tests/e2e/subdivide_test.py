# SPDX-License-Identifier: BSD-3-Clause
"""Subdivision as a kernel: alone, beside NETGEN, in few files, and of some subdomains only."""
import os
import unittest

import program
from program import DEGRADED, OK, WRONG_INPUT

SUBDIVIDE = ("--set", "fill.kernel=subdivide")


class SubdivideTest(program.ProgramTest):
    def assert_conforms(self, folder):
        outcome = self.run_program("check", folder / "mesh.pvtu")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)


class Alone(SubdivideTest):
    def setUp(self):
        super().setUp()
        self.case = self.write_case(subdomains=6, levels=2)

    def test_any_number_of_ranks(self):
        alone = self.mesh(self.case, "alone", *SUBDIVIDE)
        self.assert_conforms(alone)
        figures = program.figures(alone)
        self.assertEqual({s["kernel"] for s in figures["subdomains"]}, {"subdivide"})
        self.assertEqual(figures["num_tets"], 64 * figures["coarse"]["num_tets"])
        for ranks in (1, 2, 3):
            with self.subTest(ranks=ranks):
                other = self.mesh(self.case, f"ranks_{ranks}", *SUBDIVIDE, ranks=ranks)
                self.assertEqual(program.figures(other), figures)
                self.assertEqual(program.mesh_files(other), program.mesh_files(alone))

    def test_fewer_files_hold_the_same_mesh(self):
        """One job and one file for two subdomains each; ids and positions stay what they are."""
        six = self.mesh(self.case, "six", *SUBDIVIDE)
        three = self.mesh(self.case, "three", *SUBDIVIDE, "--set", "output.files=3", ranks=2)
        self.assertEqual(sorted(f.name for f in (three / "mesh").iterdir()),
                         [f"piece_{number:06}.vtu" for number in range(3)])
        self.assertEqual(program.figures(three), program.figures(six))
        self.assert_conforms(three)
        again = self.mesh(self.case, "again", *SUBDIVIDE, "--set", "output.files=3")
        self.assertEqual(program.mesh_files(again), program.mesh_files(three))

    def test_some_subdomains_have_the_bits_of_the_whole_run(self):
        whole = program.mesh_files(self.mesh(self.case, "whole", *SUBDIVIDE))
        some = self.mesh(self.case, "some", *SUBDIVIDE, "--only-subdomains", "1,4", ranks=2)
        pieces = {name: content for name, content in program.mesh_files(some).items() if "/" in name}
        self.assertIn("mesh/piece_000001.vtu", pieces)
        self.assertIn("mesh/piece_000004.vtu", pieces)
        self.assertEqual(len([name for name in pieces if name.startswith("mesh/")]), 2)
        self.assertEqual(pieces, {name: whole[name] for name in pieces})
        self.assertEqual(program.figures(some)["only_subdomains"], [1, 4])

    def test_some_subdomains_that_cannot_be_had(self):
        for arguments, words in (
            (["--only-subdomains", "1"], ["needs fill.kernel"]),
            ([*SUBDIVIDE, "--only-subdomains", "6"], ["no subdomain 6", "last one is 5"]),
            ([*SUBDIVIDE, "--only-subdomains", "1", "--set", "output.files=2"], ["output.files"]),
        ):
            outcome = self.run_program("mesh", self.case, "--output", "out", "--overwrite", *arguments)
            self.assert_refused(outcome, WRONG_INPUT, *words)


class Folded(SubdivideTest):
    """A thin shell of few coarse tets: on the sphere its children would be inverted on fine levels."""

    SHELL = """algebraic3d
solid outer = sphere (0, 0, 0; 1);
solid inner = sphere (0, 0, 0; 0.93);
solid shell = outer and not inner;
tlo shell;
"""
    COARSE = ("--set", "coarse.curvature=1", "--set", "coarse.grading=1.0")

    def setUp(self):
        super().setUp()
        self.write("shell.geo", self.SHELL)
        self.case = self.write_case(geometry="shell.geo", max_size=1, subdomains=4, levels=3)

    def degraded(self, output, *arguments, ranks=None, env=None):
        outcome = self.run_program("mesh", self.case, "--output", output, "--progress", "never",
                                   *self.COARSE, *arguments, ranks=ranks, env=env)
        self.assertEqual(outcome.code, DEGRADED, outcome.err + outcome.out)
        self.assert_conforms(self.folder / output)
        return self.folder / output, outcome.out

    def test_points_are_held_back_until_every_child_is_positive(self):
        alone, text = self.degraded("alone", *SUBDIVIDE)
        self.assertGreater(text.count("points kept off the geometry\n"), 1, "no second plan")
        figures = program.figures(alone)
        self.assertGreater(figures["num_points_off_geometry"], 0)
        self.assertGreater(figures["quality"]["mean_ratio"]["min"], 0)
        other, _ = self.degraded("three", *SUBDIVIDE, ranks=3)
        self.assertEqual(program.figures(other), figures)
        self.assertEqual(program.mesh_files(other), program.mesh_files(alone))

    def test_in_place_of_netgen(self):
        for fault, limit, is_reproducible in (
            ("throw", [], True),
            ("loop", ["--set", "fill.timeout_s=2"], False),
        ):
            with self.subTest(fault=fault):
                folder, _ = self.degraded(
                    fault, "--set", "refine.levels=2", *limit,
                    env=os.environ | {"TESSERA_TEST_FAULT": f"fill={fault}@1"})
                report = program.figures(folder)
                self.assertEqual([s["kernel"] for s in report["subdomains"]],
                                 ["netgen", "subdivide", "netgen", "netgen"])
                self.assertEqual(len(report["subdomains"][1]["failures"]), 4)
                self.assertGreater(report["num_points_off_geometry"], 0)
                self.assertIs(report["reproducible"], is_reproducible)


class Mixed(SubdivideTest):
    def setUp(self):
        super().setUp()
        self.write("two.geo", program.TWO_MATERIALS)
        self.case = self.write_case(geometry="two.geo", max_size=1, subdomains=4)

    def region(self, material):
        with self.case.open("a") as case:
            case.write(f"[[fill.region]]\nmaterial = '{material}'\nkernel = 'subdivide'\n")

    def test_a_kernel_by_material_conforms_between_them(self):
        self.region("core")
        alone = self.mesh(self.case, "alone")
        self.assert_conforms(alone)
        report = program.figures(alone)
        kernels = {(s["material"], s["kernel"]) for s in report["subdomains"]}
        self.assertEqual(kernels, {(1, "subdivide"), (2, "netgen")})
        self.assertEqual((report["exit_code"], report["reason"]), (OK, ""))
        together = self.mesh(self.case, "together", ranks=3)
        self.assertEqual(program.figures(together), report)
        self.assertEqual(program.mesh_files(together), program.mesh_files(alone))

    def test_files_of_both_kernels(self):
        self.region("core")
        whole = program.figures(self.mesh(self.case, "whole"))
        two = self.mesh(self.case, "two", "--set", "output.files=2", ranks=2)
        self.assertEqual(program.figures(two), whole)
        self.assert_conforms(two)

    def test_material_that_the_model_does_not_have(self):
        self.region("mantle")
        outcome = self.run_program("mesh", self.case, "--output", "out")
        self.assert_refused(outcome, WRONG_INPUT, '"mantle"')


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""The kernel "optimize": our own optimiser makes the children of the coarse tets better, in every subdomain and then
across the seams."""
import os
import unittest

import program
from program import OK


class Optimize(program.ProgramTest):
    """`alone` is the mesh of one process."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        maker.write("core.geo", program.TWO_MATERIALS)
        cls.case = maker.write_case(geometry="core.geo", max_size=0.8, subdomains=12)
        cls.alone = maker.mesh(cls.case, "alone", "--set", "fill.kernel=optimize")

    def made_by(self, kernel, folder, *options, ranks=None):
        return self.mesh(self.case, folder, "--set", f"fill.kernel={kernel}", *options, ranks=ranks)

    def checked(self, folder):
        """Its figures; `check` finds the same digest in the files."""
        figures = program.figures(folder)
        outcome = self.run_program("check", folder / "mesh.pvtu", "--json")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        self.assertEqual(program.json.loads(outcome.out)["digest"], figures["digest"])
        return figures

    def test_any_number_of_ranks(self):
        figures = self.checked(self.alone)
        self.assertEqual({part["kernel"] for part in figures["subdomains"]}, {"optimize"})
        self.assertGreater(figures["improve"]["improved"], figures["improve"]["regions"] / 4)
        self.assertEqual(figures["improve"]["failed"], 0)
        for ranks in (2, 3, 5):
            other = self.made_by("optimize", f"ranks_{ranks}", ranks=ranks)
            self.assertEqual(program.figures(other), figures)
            self.assertEqual(program.mesh_files(other), program.mesh_files(self.alone))

    def test_any_instruction_set(self):
        levels = ("--set", "refine.levels=3", "--set", "fill.levels=auto")
        wide = self.made_by("optimize", "wide", *levels)
        for name in ("baseline", "AVX2"):
            narrow = self.mesh(
                self.case, name, "--set", "fill.kernel=optimize", *levels,
                env=os.environ | {"TESSERA_TEST_INSTRUCTION_SET": name},
            )
            self.assertEqual(program.figures(narrow), program.figures(wide))
            self.assertEqual(program.mesh_files(narrow), program.mesh_files(wide))

    def test_better_than_the_children_and_seams_too(self):
        children = self.checked(self.made_by("subdivide", "children"))
        filled = self.checked(self.made_by("optimize", "filled", "--set", "improve.seams=false"))
        better = self.checked(self.alone)
        for worse, good in ((children, filled), (filled, better)):
            for key in ("mean", "p01"):
                self.assertGreater(good["quality"]["mean_ratio"][key], worse["quality"]["mean_ratio"][key])
            self.assertAlmostEqual(good["volume"], worse["volume"], delta=1e-9 * worse["volume"])
            self.assertEqual(good["boundary_area"], worse["boundary_area"])

    def test_beside_another_kernel(self):
        region = 'fill.region=[{material="core",kernel="optimize"}]'
        figures = self.checked(self.mesh(self.case, "mixed", "--set", region))
        kernels = {(part["material"], part["kernel"]) for part in figures["subdomains"]}
        self.assertEqual({kernel for _, kernel in kernels}, {"netgen", "optimize"})
        self.assertEqual(len(kernels), 2)


if __name__ == "__main__":
    unittest.main()

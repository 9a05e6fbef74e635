# SPDX-License-Identifier: BSD-3-Clause
"""What the report says of repairs that have changed something, and what becomes of a run that leaves one out."""
import os
import unittest

import program
from program import DEGRADED, OK, WRONG_INPUT

# One corner of the cube's last triangle is off by less than what is welded.
OFF = (1 + 1e-7, 1, 1)
OPEN_CUBE = [*program.CUBE_TRIANGLES[:-1], (3, 8, 5)]

PLATE = "algebraic3d\nsolid plate = orthobrick (0, 0, 0; 40, 40, 0.4);\ntlo plate;\n"


class Repairs(program.ProgramTest):
    def mesh_without(self, left_out, output, ranks=None, code=OK, **environment):
        """The report of a run that leaves repairs out."""
        outcome = self.run_program(
            "mesh", self.case, "--output", output, "--progress", "never",
            ranks=ranks, env=os.environ | {"TESSERA_LEAVE_OUT": left_out} | environment,
        )  # fmt: skip
        self.assertEqual(outcome.code, code, outcome.err)
        return program.figures(self.folder / output)

    def write_plate(self):
        self.write("plate.geo", PLATE)
        self.case = self.write_case(geometry="plate.geo", max_size=20.0, subdomains=2)

    def write_open_cube(self):
        corners = [*program.CUBE_CORNERS, OFF]
        self.write("cube.stl", program.stl_text(OPEN_CUBE, corners))
        self.case = self.write_case(geometry="cube.stl", subdomains=2)

    def test_one_of_the_import_is_needed(self):
        self.write_open_cube()
        for ranks in (None, 3):
            report = self.mesh_without("", f"on_{ranks}", ranks)
            self.assertEqual(report["repairs"], {"welded_vertices": 1})
            self.assertNotIn("left_out", report)
        outcome = self.run_program(
            "mesh", self.case, "--output", "open", env=os.environ | {"TESSERA_LEAVE_OUT": "welded_vertices"}
        )
        self.assert_refused(outcome, WRONG_INPUT, "not closed", "only one triangle")

    def test_one_of_the_sizes_is_needed(self):
        """Without it edges of 20 over a thickness of 0.4 make tets that are flat."""
        self.write_plate()
        reports = [self.mesh_without("", f"on_{ranks}", ranks) for ranks in (None, 3)]
        self.assertEqual(reports[0], reports[1])
        self.assertGreater(reports[0]["repairs"]["wall_sizes"], 0)
        without = self.mesh_without("wall_sizes", "without")
        self.assertEqual(without["left_out"], "wall_sizes")
        self.assertNotIn("wall_sizes", without["repairs"])
        self.assertEqual(reports[0]["coarse"]["sharp"]["num_tets"], 0)
        self.assertGreater(without["coarse"]["sharp"]["num_tets"], 0)
        self.assertLess(without["quality"]["min_dihedral_deg"], reports[0]["quality"]["min_dihedral_deg"])

    def test_a_try_is_one_and_the_next_takes_its_place(self):
        self.write_plate()
        fault = {"TESSERA_TEST_FAULT": "remesh=throw@0"}
        for ranks in (None, 3):
            report = self.mesh_without("", f"first_{ranks}", ranks, **fault)
            self.assertEqual(report["repairs"]["finer_coarse_size"], 1)
            report = self.mesh_without("finer_coarse_size", f"second_{ranks}", ranks, **fault)
            self.assertEqual(report["repairs"]["netgen_surface"], 1)
            self.assertNotIn("finer_coarse_size", report["repairs"])

    def test_those_of_fills_are_counted_by_subdomains(self):
        self.case = self.write_case()
        report = self.mesh_without("", "out", None, DEGRADED, TESSERA_TEST_FAULT="fill=throw@2")
        self.assertEqual(report["repairs"]["fill_tries"], 1)
        self.assertEqual(report["repairs"]["subdivided_fills"], 1)
        report = self.mesh_without("fill_tries", "once", 2, DEGRADED, TESSERA_TEST_FAULT="fill=throw@2")
        self.assertEqual([part["tries"] for part in report["subdomains"]], [1, 1, 2, 1])

    def test_a_name_that_there_is_not(self):
        self.case = self.write_case()
        for ranks in (None, 3):
            outcome = self.run_program(
                "mesh", self.case, "--output", "out", ranks=ranks, env=os.environ | {"TESSERA_LEAVE_OUT": "mend"}
            )
            self.assert_refused(outcome, WRONG_INPUT, "TESSERA_LEAVE_OUT", "'mend'", "mend_folds")
        self.assertFalse((self.folder / "out").exists())

    def test_a_run_goes_on_with_the_same_ones(self):
        self.write_plate()
        self.mesh_without("wall_sizes", "out")
        outcome = self.run_program("mesh", self.case, "--output", "out", "--resume")
        self.assert_refused(outcome, WRONG_INPUT, "TESSERA_LEAVE_OUT has changed", "'wall_sizes' there")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Tries at the coarse mesh and at fills, side by side: the same mesh for any number of ranks, sooner with more."""
import os
import time
import unittest

import program
from program import DEGRADED, OK

BUDGET_S = 8
HARD = 1  # Number of the subdomain.


class Ladder(program.ProgramTest):
    def mesh_with(self, fault, output, *arguments, ranks=None, code=OK):
        """The report and the seconds it took."""
        start = time.monotonic()
        outcome = self.run_program(
            "mesh", self.case, "--output", output, "--progress", "never", *arguments,
            ranks=ranks, env=os.environ | {"TESSERA_TEST_FAULT": fault},
        )  # fmt: skip
        seconds = time.monotonic() - start
        self.assertEqual(outcome.code, code, outcome.err)
        return program.figures(self.folder / output), seconds

    def write_cube(self):
        self.write("cube.stl", program.stl_text(program.CUBE_TRIANGLES))
        self.case = self.write_case(geometry="cube.stl", subdomains=2)

    def test_rungs_that_hang_do_so_together(self):
        """NETGEN's first and the first of the remeshed triangles; the second of these works."""
        self.write_cube()
        hang = "coarse=loop@0 remesh=loop@4"
        limit = ("--set", f"coarse.timeout_s={BUDGET_S}")
        runs = {ranks: self.mesh_with(hang, f"on_{ranks}", *limit, ranks=ranks) for ranks in (1, 2, 3)}
        for report, _ in runs.values():
            self.assertEqual(report["coarse"]["tries"], 3)
            self.assertEqual(report["coarse"]["surface_mesher"], "remesh")
            self.assertEqual(len(report["coarse"]["failures"]), 2)
            self.assertEqual(report["digest"], runs[1][0]["digest"])
        # They use as much CPU time each; on one rank that is twice the time.
        self.assertLess(runs[3][1], runs[1][1])

    def test_a_later_rung_never_wins_for_being_quicker(self):
        """The second rung works, but only after a rung that hangs was given up."""
        self.write_cube()
        for ranks in (1, 3):
            report, _ = self.mesh_with("coarse=throw@0", f"on_{ranks}", ranks=ranks)
            self.assertEqual(report["coarse"]["tries"], 2)
            self.assertEqual(report["coarse"]["surface_mesher"], "netgen")
            first = self.folder / "on_1"
            self.assertEqual(program.mesh_files(self.folder / f"on_{ranks}"), program.mesh_files(first))

    def test_tries_of_a_hard_subdomain_fail_together(self):
        """All four of NETGEN hang; the subdomain is subdivided."""
        self.case = self.write_case()
        limit = ("--set", f"fill.timeout_s={BUDGET_S}")
        runs = {}
        for ranks in (1, 3):
            runs[ranks] = self.mesh_with(f"fill=loop@{HARD}", f"on_{ranks}", *limit, ranks=ranks, code=DEGRADED)
            hard = runs[ranks][0]["subdomains"][HARD]
            self.assertEqual((hard["kernel"], hard["tries"], len(hard["failures"])), ("subdivide", 5, 4))
        self.assertEqual(runs[3][0]["digest"], runs[1][0]["digest"])
        self.assertEqual(runs[3][0]["subdomains"][HARD]["failures"], runs[1][0]["subdomains"][HARD]["failures"])
        self.assertLess(runs[3][1], runs[1][1])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Tries at the coarse mesh and at fills, side by side: the same mesh for any number of ranks, sooner with more."""
import json
import math
import os
import re
import shutil
import unittest

import program
from program import CONFIGS, DEGRADED, OK

# Jobs that sleep are given up after these seconds, and use no core meanwhile.
STALL_S = 5
LIMITS = {"TESSERA_TEST_LIMITS": f"300 {STALL_S} 8"}
HARD = 1  # Number of the subdomain.


class Ladder(program.ProgramTest):
    def mesh_with(self, fault, output, ranks=None, code=OK):
        """What the run says of itself."""
        outcome = self.run_program(
            "mesh", self.case, "--output", output, "--progress", "never",
            ranks=ranks, env=os.environ | LIMITS | {"TESSERA_TEST_FAULT": fault},
        )  # fmt: skip
        self.assertEqual(outcome.code, code, outcome.err)
        return json.loads((self.folder / output / "report.json").read_text())

    @staticmethod
    def seconds(report, stage):
        return next(one["wall_time_s"] for one in report["stages"] if one["name"] == stage)

    def write_cube(self):
        self.write("cube.stl", program.stl_text(program.CUBE_TRIANGLES))
        self.case = self.write_case(geometry="cube.stl", subdomains=2)

    def test_rungs_that_hang_do_so_together(self):
        """Both of the remesher; NETGEN's works."""
        self.write_cube()
        hang = "remesh=sleep@0 remesh=sleep@1"
        runs = {ranks: self.mesh_with(hang, f"on_{ranks}", ranks=ranks) for ranks in (None, 3)}
        for report in runs.values():
            self.assertEqual(report["coarse"]["tries"], 3)
            self.assertEqual(report["coarse"]["surface_mesher"], "netgen")
            self.assertEqual(report["repairs"]["netgen_surface"], 1)
            self.assertEqual(len(report["coarse"]["failures"]), 2)
            self.assertEqual(report["digest"], runs[None]["digest"])
        self.assertLess(self.seconds(runs[3], "coarse"), self.seconds(runs[None], "coarse"))

    def test_a_later_rung_never_wins_for_being_quicker(self):
        """The first rung fails at once, and all that follow work."""
        self.write_cube()
        for ranks in (None, 3):
            report = self.mesh_with("remesh=throw@0", f"on_{ranks}", ranks=ranks)
            self.assertEqual(report["coarse"]["tries"], 2)
            self.assertEqual(report["coarse"]["surface_mesher"], "remesh")
            first = self.folder / "on_None"
            self.assertEqual(program.mesh_files(self.folder / f"on_{ranks}"), program.mesh_files(first))

    def test_the_first_mesh_stays_if_none_can_be_made_for_the_sizes(self):
        """All tries but the first fail. So edges near the ball are too long, and that is said."""
        self.write("bar.geo", "algebraic3d\nsolid bar = orthobrick (0, 0, 0; 4, 1, 1);\ntlo bar;\n")
        self.case = self.write(
            "case.toml",
            "geometry.file = 'bar.geo'\ndecompose.subdomains = 4\nfill.kernel = 'subdivide'\n"
            f"{program.NO_PAGE}[size]\ntarget = 0.4\n"
            "[[size.region]]\nball = { centre = [3.5, 0.5, 0.5], radius = 0.05 }\nsize = 0.02\n",
        )
        later = ("remesh=throw@1", "remesh=throw@2", "coarse=throw@3")
        sound = self.mesh_with("gmsh=throw", "sound")
        self.assertEqual((sound["coarse"]["tries"], sound["coarse"]["failures"]), (2, []))
        digests = set()
        for ranks in (None, 3):
            report = self.mesh_with(" ".join(later), f"on_{ranks}", ranks=ranks, code=DEGRADED)
            self.assertEqual((report["coarse"]["tries"], len(report["coarse"]["failures"])), (4, 3))
            self.assertLess(report["coarse"]["num_tets"], sound["coarse"]["num_tets"])
            self.assertEqual(len(report["reasons"]), 1)
            place = re.search(r"near \(([^)]*)\) edges of .* are wanted", report["reason"])
            self.assertLess(math.dist(map(float, place.group(1).split(",")), (3.5, 0.5, 0.5)), 0.2)
            digests.add(report["digest"])
        self.assertEqual(len(digests), 1)

    @unittest.skipUnless(shutil.which("gmsh"), "needs the program gmsh")
    def test_gmsh_is_the_last_rung(self):
        self.case = self.write_case(geometry=CONFIGS / "geometry" / "bracket.step", max_size=10.0, subdomains=2)
        digests = set()
        for ranks in (None, 2):
            report = self.mesh_with("coarse=throw remesh=throw", f"on_{ranks}", ranks=ranks)
            self.assertEqual((report["coarse"]["mesher"], report["coarse"]["tries"]), ("gmsh", 4))
            self.assertIn("Gmsh has made the coarse mesh", " ".join(report["warnings"]))
            digests.add(report["digest"])
        self.assertEqual(len(digests), 1)

    def test_tries_of_a_hard_subdomain_fail_together(self):
        """All four of NETGEN hang; the subdomain is subdivided."""
        self.case = self.write_case()
        runs = {}
        for ranks in (None, 3):
            runs[ranks] = self.mesh_with(f"fill=sleep@{HARD}", f"on_{ranks}", ranks=ranks, code=DEGRADED)
            hard = runs[ranks]["subdomains"][HARD]
            self.assertEqual((hard["kernel"], hard["tries"], len(hard["failures"])), ("subdivide", 5, 4))
        self.assertEqual(runs[3]["digest"], runs[None]["digest"])
        self.assertEqual(runs[3]["subdomains"][HARD]["failures"], runs[None]["subdomains"][HARD]["failures"])
        self.assertLess(self.seconds(runs[3], "fill"), self.seconds(runs[None], "fill"))


if __name__ == "__main__":
    unittest.main()

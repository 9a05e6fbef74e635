# SPDX-License-Identifier: BSD-3-Clause
"""The tets around the seams are optimised across them: what that does to the mesh, and what a job that fails does."""
import os
import unittest

import program
from program import OK

REGION = 3  # Number of the region whose job fails.


class Improve(program.ProgramTest):
    """`alone` is the mesh of one process that nothing disturbed."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        maker.write("core.geo", program.TWO_MATERIALS)
        cls.case = maker.write_case(geometry="core.geo", max_size=0.8, subdomains=12)
        cls.alone = maker.mesh(cls.case, "alone")

    def conforming(self, folder):
        """Its figures; those of `check`, from the files alone, are the same."""
        report = program.figures(folder)
        found = self.check(folder)
        for key in ("digest", "num_tets", "num_vertices"):
            self.assertEqual(found[key], report[key], key)
        self.assertEqual(found["quality"]["seam"]["num_tets"], report["quality"]["seam"]["num_tets"])
        self.assertAlmostEqual(
            found["quality"]["seam"]["ks_distance"], report["quality"]["seam"]["ks_distance"], places=3
        )
        self.assertEqual(
            [part["material"] for part in found["subdomains"]],
            [part["material"] for part in report["subdomains"]],
        )
        for tets, reported in ((found["quality"], report["quality"]),
                               (found["quality"]["seam"], report["quality"]["seam"])):
            self.assertEqual(tets["mean_ratio"]["histogram"], reported["mean_ratio"]["histogram"])
        return report

    def check(self, folder):
        outcome = self.run_program("check", folder / "mesh.pvtu", "--json")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        return program.json.loads(outcome.out)

    def test_any_number_of_ranks(self):
        figures = self.conforming(self.alone)
        self.assertGreater(figures["improve"]["improved"], figures["improve"]["regions"] / 4)
        self.assertEqual(figures["improve"]["failed"], 0)
        for ranks in (2, 3, 5):
            other = self.mesh(self.case, f"ranks_{ranks}", ranks=ranks)
            self.assertEqual(program.figures(other), figures)
            self.assertEqual(program.mesh_files(other), program.mesh_files(self.alone))

    def test_any_order_of_jobs(self):
        backwards = self.mesh(
            self.case, "backwards", ranks=2, env=os.environ | {"TESSERA_TEST_FILL_ORDER": "reverse"}
        )
        self.assertEqual(program.mesh_files(backwards), program.mesh_files(self.alone))

    def test_tets_get_better_and_the_geometry_stays(self):
        improved = self.conforming(self.alone)
        plain = self.conforming(self.mesh(self.case, "plain", "--set", "improve.seams=false"))
        self.assertEqual(plain["improve"], {"regions": 0, "improved": 0, "failed": 0})
        for tets, before in ((improved["quality"], plain["quality"]),
                             (improved["quality"]["seam"], plain["quality"]["seam"])):
            self.assertGreater(tets["mean_ratio"]["mean"], before["mean_ratio"]["mean"])
            self.assertGreaterEqual(tets["min_dihedral_deg"], before["min_dihedral_deg"])
        self.assertEqual(improved["boundary_area"], plain["boundary_area"])
        self.assertAlmostEqual(improved["volume"], plain["volume"], delta=1e-9 * plain["volume"])

    def test_fewer_files_hold_the_same_mesh(self):
        single = program.figures(self.alone)
        fewer = self.mesh(self.case, "fewer", "--set", "output.files=3", ranks=2)
        self.assertEqual(self.conforming(fewer)["digest"], single["digest"])

    def test_region_that_fails_keeps_its_tets(self):
        for fault, ranks in (("throw", None), ("segv", 2), ("exit", None), ("drop", None)):
            with self.subTest(fault=fault):
                environment = os.environ | {"TESSERA_TEST_FAULT": f"improve={fault}@{REGION}"}
                folder = self.mesh(self.case, fault, ranks=ranks, env=environment)
                report = self.conforming(folder)
                self.assertEqual(report["improve"]["failed"], 1)
                self.assertIs(report["reproducible"], True)
                self.assertNotEqual(program.mesh_files(folder), program.mesh_files(self.alone))

    def test_region_that_hangs_keeps_its_tets(self):
        for fault in ("loop", "sleep"):
            with self.subTest(fault=fault):
                environment = os.environ | {"TESSERA_TEST_FAULT": f"improve={fault}@{REGION}"}
                folder = self.mesh(self.case, fault, "--set", "fill.timeout_s=3", ranks=2, env=environment)
                report = self.conforming(folder)
                self.assertEqual(report["improve"]["failed"], 1)
                self.assertIs(report["reproducible"], False)


if __name__ == "__main__":
    unittest.main()

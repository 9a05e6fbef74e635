# SPDX-License-Identifier: BSD-3-Clause
"""Whatever makes NETGEN fail on a subdomain, for real, in its process: subdivision takes its place."""
import os
import unittest

import program
from program import DEGRADED, OK

FAULTY = 2  # Number of the subdomain.

# Limits that the sound subdomains, of some hundred tets each, are far from.
LIMITS = ("--set", "fill.timeout_s=1", "--set", "fill.memory_gib=0.25")


class Fallbacks(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.case = self.write_case()

    def mesh_with(self, fault, output, *arguments, ranks=None):
        environment = os.environ | {"TESSERA_TEST_FAULT": f"fill={fault}@{FAULTY}"}
        outcome = self.run_program(
            "mesh", self.case, "--output", output, "--progress", "never", *arguments, ranks=ranks, env=environment
        )
        self.assertEqual(outcome.code, DEGRADED, outcome.err)
        self.assertIn(f"they were subdivided: {FAULTY}", outcome.out)
        return self.folder / output

    def assert_is_filled_by_subdivision(self, folder, words, is_reproducible):
        report = program.figures(folder)
        self.assertEqual((report["status"], report["exit_code"]), ("degraded", DEGRADED))
        self.assertIn(f"subdivided: {FAULTY}", report["reason"])
        self.assertIs(report["reproducible"], is_reproducible)
        self.assertEqual(len(report["subdomains"]), 4)
        for subdomain in report["subdomains"]:
            if subdomain["id"] != FAULTY:
                self.assertEqual((subdomain["kernel"], subdomain["tries"]), ("netgen", 1))
                self.assertNotIn("failures", subdomain)
                continue
            self.assertEqual((subdomain["kernel"], subdomain["tries"]), ("subdivide", 5))
            self.assertEqual(len(subdomain["failures"]), 4)
            for number, failure in enumerate(subdomain["failures"], 1):
                self.assertRegex(failure, rf"^try {number} \(netgen\): .*{words}")
        outcome = self.run_program("check", folder / "mesh.pvtu")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        return report

    def assert_same_everywhere(self, fault, words):
        """The failure is one of the skin, so it happens on every machine."""
        alone = self.mesh_with(fault, "alone")
        figures = self.assert_is_filled_by_subdivision(alone, words, is_reproducible=True)
        together = self.mesh_with(fault, "together", ranks=2)
        self.assertEqual(program.figures(together), figures)
        self.assertEqual(program.mesh_files(together), program.mesh_files(alone))

    def assert_depends_on_machine(self, fault, words):
        """On another machine the try might have succeeded."""
        folder = self.mesh_with(fault, "out", *LIMITS, ranks=2)
        self.assert_is_filled_by_subdivision(folder, words, is_reproducible=False)

    def test_exception(self):
        self.assert_same_everywhere("throw", "thrown for a test")

    def test_segmentation_fault(self):
        self.assert_same_everywhere("segv", "signal 11")

    def test_exit(self):
        self.assert_same_everywhere("exit", r"called exit\(1\)")

    def test_lost_tet(self):
        self.assert_same_everywhere("drop", "")

    def test_endless_loop(self):
        self.assert_depends_on_machine("loop", "more than 1 s of CPU time")

    def test_endless_sleep(self):
        self.assert_depends_on_machine("sleep", "no CPU time for 1 s")

    def test_memory(self):
        self.assert_depends_on_machine("memory", "more than 0.25 GiB")

    def test_sound_run_has_no_failures(self):
        report = program.figures(self.mesh(self.case, "sound"))
        self.assertEqual([s["kernel"] for s in report["subdomains"]], ["netgen"] * 4)
        self.assertTrue(report["reproducible"])
        for subdomain in report["subdomains"]:
            self.assertNotIn("failures", subdomain)


if __name__ == "__main__":
    unittest.main()

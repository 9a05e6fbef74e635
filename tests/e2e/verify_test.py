# SPDX-License-Identifier: BSD-3-Clause
"""Pieces that do not make one mesh are refused at the end of a run, whatever let them pass before."""
import json
import os
import unittest

import program
from program import FAILED, OK


class Refusal(program.ProgramTest):
    def run_with(self, fault, case, output, *arguments):
        return self.run_program(
            "mesh", case, "--output", output, "--progress", "never", *arguments, ranks=2,
            env=os.environ | {"TESSERA_TEST_FAULT": fault},
        )  # fmt: skip

    def assert_no_mesh(self, outcome, output, *words):
        """One message, a report with the same words, and no index: nobody takes this for a mesh."""
        self.assert_refused(outcome, FAILED, *words)
        report = json.loads((self.folder / output / "report.json").read_text())
        self.assertEqual((report["status"], report["exit_code"]), ("failed", FAILED))
        for word in words:
            self.assertIn(word, report["reason"])
        self.assertEqual(list((self.folder / output).glob("*.pvtu")), [])

    def test_piece_whose_points_are_one_bit_off(self):
        """As if a node of the cluster had another mathematical library: each piece alone is sound."""
        case = self.write_case(max_size=0.6, subdomains=6)
        for kernel in ("netgen", "subdivide"):
            with self.subTest(kernel=kernel):
                outcome = self.run_with("fill=nudge@2", case, kernel, "--set", f"fill.kernel={kernel}")
                self.assert_no_mesh(outcome, kernel, "subdomains", "do not meet on coarse triangle")
                self.assertRegex(outcome.messages[0], r"subdomains (2 and \d|\d and 2) do not meet")

    def test_all_pieces_one_bit_off_meet(self):
        """So it is the difference between two pieces that is refused, not the fault."""
        case = self.write_case(max_size=0.6, subdomains=6)
        outcome = self.run_with("fill=nudge", case, "out")
        self.assertEqual(outcome.code, OK, outcome.err)

    def test_tet_that_is_lost_after_its_region_was_judged(self):
        case = self.write_case(max_size=0.6, subdomains=6)
        outcome = self.run_with("improve=lose", case, "out")
        self.assert_no_mesh(outcome, "out", "pieces do not meet: the faces of their tets do not cancel")


if __name__ == "__main__":
    unittest.main()

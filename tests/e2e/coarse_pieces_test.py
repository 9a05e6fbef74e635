# SPDX-License-Identifier: BSD-3-Clause
"""A large domain of the coarse mesh is divided by membranes, and its pieces are filled by all ranks."""
import os
import unittest

import program

PIECES = "1 domains in 2 pieces"


class CoarsePieces(program.ProgramTest):
    def ball(self, folder, **how):
        self.write("ball.geo", program.BALL)
        case = self.write(
            "case.toml",
            "geometry.file = 'ball.geo'\ncoarse.max_size = 0.08\nrefine.levels = 0\n"
            "fill.kernel = 'subdivide'\ndecompose.subdomains = 3\n")
        outcome = self.run_program("mesh", case, "--output", folder, "--progress", "never", **how)
        self.assertEqual(outcome.code, program.OK, outcome.err)
        return outcome, self.assert_checked(self.folder / folder, 1e-12)[0]

    def test_ranks_do_not_matter(self):
        outcome, alone = self.ball("alone")
        self.assertIn(PIECES, outcome.out)
        for ranks in (2, 3):
            _, report = self.ball(f"on_{ranks}", ranks=ranks)
            self.assertEqual(report["digest"], alone["digest"])

    def test_a_piece_that_cannot_be_filled_or_made_leaves_the_domain_whole(self):
        for stage in ("piece", "divide"):
            outcome, report = self.ball(stage, env={**os.environ, "TESSERA_TEST_FAULT": f"{stage}=segv"}, ranks=2)
            self.assertIn("domains are filled whole", outcome.out + outcome.err)
            self.assertEqual(report["coarse"]["tries"], 1)


if __name__ == "__main__":
    unittest.main()

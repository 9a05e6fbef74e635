# SPDX-License-Identifier: BSD-3-Clause
"""The same bits for every number of ranks, from run to run, and in whatever order jobs run."""
import os
import re
import unittest

import program
from program import figures, mesh_files


def fill_order(folder):
    """Subdomains in the order in which rank 0 filled them."""
    log = (folder / "log" / "run.log").read_text()
    return [int(number) for number in re.findall(r"fill: subdomain (\d+):", log)]


class Reproducibility(program.ProgramTest):
    """`alone` is the mesh of one process."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        cls.case = maker.write_case(subdomains=6)
        cls.alone = maker.mesh(cls.case, "alone")

    def assert_same_bits(self, one, other):
        self.assertEqual(figures(one), figures(other))
        self.assertEqual(mesh_files(one), mesh_files(other))

    def test_any_number_of_ranks(self):
        self.assertEqual(len(list(self.alone.glob("mesh/*.vtu"))), 6)
        for ranks in (1, 2, 3, 5):
            with self.subTest(ranks=ranks):
                self.assert_same_bits(self.alone, self.mesh(self.case, f"ranks_{ranks}", ranks=ranks))

    def test_more_ranks_than_subdomains(self):
        case = self.write_case(subdomains=2)
        self.assert_same_bits(self.mesh(case, "alone"), self.mesh(case, "together", ranks=3))

    def test_run_to_run(self):
        self.assert_same_bits(self.alone, self.mesh(self.case, "second"))

    def test_jobs_in_reverse_order(self):
        environment = os.environ | {"TESSERA_TEST_FILL_ORDER": "reverse"}
        backwards = self.mesh(self.case, "backwards", env=environment)
        order = fill_order(self.alone)
        self.assertEqual(sorted(order), list(range(6)))
        self.assertEqual(fill_order(backwards), order[::-1])
        self.assert_same_bits(self.alone, backwards)

    def test_another_cut_is_another_mesh(self):
        """The comparison sees a difference when there is one."""
        other = self.write_case(subdomains=5)
        self.assertNotEqual(figures(self.mesh(other, "five"))["digest"], figures(self.alone)["digest"])


class StlReproducibility(program.ProgramTest):
    def test_any_number_of_ranks(self):
        """STL has a projection of its own, and a search structure that every rank builds."""
        plate = program.CONFIGS / "geometry" / "plate_with_hole.stl"
        case = self.write_case(geometry=plate, max_size=30, subdomains=3)
        alone, together = self.mesh(case, "alone"), self.mesh(case, "together", ranks=3)
        self.assertEqual(figures(alone), figures(together))
        self.assertEqual(mesh_files(alone), mesh_files(together))


if __name__ == "__main__":
    unittest.main()

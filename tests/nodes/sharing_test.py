#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Ranks of a node share memory and the process with the model, and those of different nodes share nothing."""
import unittest

import node_memory
import program
from on_nodes import HANG_S, NodesTest


class Sharing(NodesTest):
    def test_one_copy_and_one_model_zygote_a_node(self):
        case, out = program.CONFIGS / "cases" / "shaft.toml", self.folder / "out"
        words = ["mesh", case, "--set", "refine.levels=1", "--progress", "never", "--output", out]
        self.start_on({1: 3, 2: 3}, *words, variables={"TESSERA_TEST_FAULT": "fill=sleep@3"})
        program.wait_until(lambda: program.num_filled(out) > 12, "fills", HANG_S)
        looks = node_memory.look(self.room, program.PROGRAM)
        for node in (1, 2):
            with self.subTest(node=node):
                self.assertEqual(looks[node].roles["rank"], 3)
                self.assertEqual(looks[node].roles["model zygote"], 1)
                self.assertGreater(node_memory.bytes_shared(looks[node]), 0)
        self.assertEqual(looks[1].segments.keys() & looks[2].segments.keys(), set())
        self.assertEqual(looks[3].roles.total() + looks[4].roles.total(), 0)
        # The same tables in each.
        self.assertEqual(sorted(looks[1].segments.values()), sorted(looks[2].segments.values()))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The same bits on one, two and four nodes."""
import json
import unittest

import program
import room
from program import OK, ProgramTest

SHAFT = program.CONFIGS / "cases" / "shaft.toml"


class MeshTest(ProgramTest):
    def test_shaft_has_the_digest_of_one_node(self):
        digests = set()
        with room.Room(4, self.folder) as cluster:
            for num_nodes in (1, 2, 4):
                out = self.folder / f"out{num_nodes}"
                start = cluster.mpiexec(dict.fromkeys(range(1, num_nodes + 1), 2))
                mesh = [program.PROGRAM, "mesh", SHAFT, "--set", "refine.levels=1", "--output", out]
                outcome = self.finish(self.start_command(cluster.command(1, [*start, *mesh])))
                self.assertEqual(outcome.code, OK, outcome.err)
                digests.add(json.loads((out / "report.json").read_text(encoding="utf-8"))["digest"])
        self.assertEqual(len(digests), 1, digests)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Model, coarse mesh and tables stand once in the memory of a node, or in copies where that is not possible."""
import contextlib
import os
import pathlib
import re
import unittest

import program

RANKS = 3


def shared_inodes(pid):
    """Of the segments that a process has mapped."""
    with contextlib.suppress(OSError):
        maps = pathlib.Path(f"/proc/{pid}/maps").read_text()
        return set(re.findall(r"(\d+)\s+/memfd:tessera \(deleted\)$", maps, re.MULTILINE))
    return set()  # It has ended.


class SharedMeshTest(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        cls.case = maker.write_case(max_size=0.6, subdomains=6)
        cls.reference = maker.mesh(cls.case, "reference", ranks=RANKS)

    def mesh_with(self, fault, output):
        return self.mesh(
            self.case, output, ranks=RANKS, env=os.environ | {"TESSERA_TEST_FAULT": fault}
        )

    def log_of(self, folder):
        return (folder / "log" / "run.log").read_text()

    def test_ranks_and_their_workers_map_the_same_memory(self):
        """While jobs sleep there is time to look: three ranks, their model zygote and its three jobs."""
        process = self.start(
            "mesh", self.case, "--output", "out", ranks=RANKS,
            env=os.environ | {"TESSERA_TEST_FAULT": "fill=sleep"},
        )  # fmt: skip
        users = []

        def all_map():
            pids = [pid for pid in program.descendants(process.pid) if program.is_program(pid)]
            users[:] = [inodes for inodes in map(shared_inodes, pids) if inodes]
            return len(users) > 2 * RANKS or process.poll() is not None

        program.wait_until(all_map, "ranks and workers that map the mesh")
        self.assertIsNone(process.poll())
        self.assertEqual(len(set.union(*users)), 1)
        models = [chain[1] for chain in map(program.chain_of, program.ranks_of(process)) if len(chain) > 1]
        self.assertEqual(len(models), 1)
        self.assertEqual(len(program.program_children(models[0])), RANKS)

    def test_rank_that_cannot_join_the_workers_of_the_node(self):
        self.assertNotIn("process of their own", self.log_of(self.reference))
        folder = self.mesh_with("join=throw@2", "alone")
        self.assertIn(
            f"warning 1 of {RANKS} ranks keep the model in a process of their own: thrown for a test", self.log_of(folder)
        )
        self.assertEqual(program.mesh_files(folder), program.mesh_files(self.reference))

    def test_copies_make_the_same_mesh(self):
        self.assertNotIn("coarse mesh: ", self.log_of(self.reference))
        for fault, words in (
            ("share=throw@0", f"{RANKS} ranks have a copy of their own; thrown for a test"),
            ("share=throw@2", f"{RANKS} ranks have a copy of their own; thrown for a test"),
            ("map=throw", f"workers of {RANKS} ranks have copies of it: thrown for a test"),
        ):
            with self.subTest(fault=fault):
                folder = self.mesh_with(fault, fault.replace("=", "_").replace("@", "_"))
                self.assertIn(f"coarse mesh: {words}", self.log_of(folder))
                self.assertEqual(program.figures(folder), program.figures(self.reference))
                self.assertEqual(program.mesh_files(folder), program.mesh_files(self.reference))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""On one, two and four nodes the program makes the same bits."""
import filecmp
import json
import shutil
import sys
import unittest

import program
import room
from on_nodes import NodesTest, stop, two_each
from program import OK

sys.path.insert(0, str(room.ROOT / "tests" / "corpus"))
import corpus_files  # noqa: E402

NODES = {1: two_each(1), 2: two_each(1, 2), 4: two_each(1, 2, 3, 4)}
SHAFT = program.CONFIGS / "cases" / "shaft.toml"
NO_PAGE = program.sets("output.report_html=false")
COARSER = [*program.sets("refine.levels=1"), *NO_PAGE]


class SameBits(NodesTest):
    def assert_same_on_all(self, case, *arguments):
        """Meshes a case on 1, 2 and 4 nodes; the folder of the last."""
        figures = {}
        for num_nodes, ranks in NODES.items():
            out = self.mesh_on(ranks, case, f"on_{num_nodes}", *arguments)
            figures[num_nodes] = (program.figures(out), program.mesh_files(out))
            self.assertEqual(self.report(out.name)["num_ranks"], 2 * num_nodes)
            self.assertGreater(len(figures[num_nodes][1]), 1)
        self.assertEqual(figures[2], figures[1])
        self.assertEqual(figures[4], figures[1])
        return out

    def test_shaft_and_what_is_made_of_its_mesh(self):
        mesh = self.assert_same_on_all(SHAFT, *COARSER) / "mesh.pvtu"
        # Parts depend on the number of ranks, but not on where these are.
        for number, ranks in enumerate(({1: 8}, NODES[4])):
            self.run_well(ranks, "repartition", mesh, "--parts", "8", "--output", self.folder / f"parts_{number}")
            self.run_well(ranks, "convert", mesh, "--format", "exodus", "--output", self.folder / f"exodus_{number}")
        self.assertEqual(program.mesh_files(self.folder / "parts_1"), program.mesh_files(self.folder / "parts_0"))
        exodus = [self.folder / f"exodus_{number}" / "mesh.exo" for number in (0, 1)]
        self.assertTrue(filecmp.cmp(*exodus, shallow=False))
        found = [json.loads(self.run_well(NODES[number], "check", mesh, "--json").out) for number in (1, 4)]
        self.assertEqual(found[1], found[0])
        self.assertEqual(found[1]["digest"], self.report("on_4")["digest"])

    def run_well(self, ranks_of_node, *words):
        outcome = self.run_on(ranks_of_node, *words)
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        return outcome

    def test_a_step_file_by_wanted_edge_length(self):
        package = corpus_files.unpack_package("occt-misc", room.ROOT / "build" / "corpus")
        model = package / "usr/share/opencascade/data/step/linkrods.step"
        self.assert_same_on_all(model, "--size", "0.25", *NO_PAGE)

    def test_layers_on_walls(self):
        self.assert_same_on_all(program.CONFIGS / "cases" / "pipe_layers.toml", *NO_PAGE)

    def test_a_run_goes_on_on_other_nodes(self):
        arguments = ["mesh", SHAFT, *COARSER, "--progress", "never", "--output"]
        whole = self.mesh_on(NODES[1], SHAFT, "whole", *COARSER)
        out = self.folder / "out"
        begun = self.start_on(two_each(1, 2), *arguments, out, variables={"TESSERA_TEST_FAULT": "fill=sleep@3"})
        program.wait_until(lambda: program.num_filled(out) > 8, "half of the pieces", 200)
        stop(begun)
        self.finish(begun)
        outcome = self.run_on(two_each(4, 3), *arguments, out, "--resume")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        self.assertTrue(self.report("out")["resumed"])
        self.assertEqual(program.mesh_files(out), program.mesh_files(whole))

    def test_a_hundred_million_tets(self):
        """Some 2 GB, which are compared by their digest, not kept."""
        finer = program.sets("coarse.curvature=1.6", "refine.levels=5", "fill.kernel=subdivide",
                             "output.report_html=false")  # fmt: skip
        digests = []
        for num_nodes in (1, 4):
            out = self.mesh_on(NODES[num_nodes], SHAFT, "large", *finer)
            report = self.report("large")
            self.assertGreater(report["num_tets"], 100_000_000)
            digests.append(report["digest"])
            shutil.rmtree(out)
        self.assertEqual(digests[1], digests[0])

    def test_what_a_dry_run_says_of_a_thousand_million_tets(self):
        levels = ["--set", "refine.levels=6", "--set", "fill.kernel=subdivide", "--dry-run", "--ranks", "64"]
        said = {}
        for num_nodes in (1, 4):
            out = self.folder / f"dry_{num_nodes}"
            outcome = self.run_well(NODES[num_nodes], "mesh", SHAFT, *levels, "--output", out)
            # Times, memory and space differ from run to run.
            said[num_nodes] = [line for line in outcome.out.splitlines() if line.split()[:1] == ["tets"]]
        self.assertEqual(len(said[1]), 1, outcome.out)
        self.assertEqual(said[4], said[1])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""The Python package in a program that runs MPI: called by groups of ranks, by some ranks only, and what it raises."""
import json
import os
import pathlib
import sys
import unittest

import program

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "src" / "python"

# What follows is on every rank; `told` puts what it says of all ranks into a file, by rank.
BEGIN = """
import json, sys, warnings
from mpi4py import MPI
import tessera
world, case = MPI.COMM_WORLD, "case.toml"
def told(what):
    everyone = world.gather(what)
    if world.rank == 0:
        open("told.json", "w").write(json.dumps(everyone))
"""


class Door(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.write_case()

    def run_ranks(self, ranks, code):
        process = self.start_command(
            [program.MPIEXEC, "-n", str(ranks), sys.executable, "-B", "-c", BEGIN + code],
            env={**os.environ, "PYTHONPATH": str(PACKAGE), "TESSERA": program.PROGRAM},
        )
        return self.finish(process)

    def told(self, ranks, code):
        """What the ranks told; they must end well."""
        outcome = self.run_ranks(ranks, code)
        self.assertEqual(outcome.code, program.OK, outcome.err)
        return json.loads((self.folder / "told.json").read_text())

    def test_two_communicators_at_once_and_twice_give_the_same_bits(self):
        code = (
            "half = world.Split(world.rank % 2)\n"
            "digests = [tessera.mesh(case, comm=half, quiet=True).report['digest'] for _ in range(2)]\n"
            "told([*digests, tessera.mesh(case, comm=world, quiet=True).report['digest']])\n"
        )
        told = self.told(3, code)
        self.assertEqual(len(told), 3)
        self.assertEqual({len(digest) for digests in told for digest in digests}, {32})
        self.assertEqual(len({digest for digests in told for digest in digests}), 1, told)

    def test_whatever_is_raised_is_raised_on_all_ranks_and_they_go_on(self):
        """Also what rank 0 alone meets, and a warning that the program has made an error."""
        code = (
            "warnings.simplefilter('error')\n"
            "said = []\n"
            "for options in ({'keys': {'coarse.max_size': -1}}, {'output': '/dev/null/out'},\n"
            "                {'keys': {'quality.min_mean_ratio': 0.99}}, {'ranks': 0}):\n"
            "    try: tessera.mesh(case, comm=world, quiet=True, **options)\n"
            "    except Exception as error: said.append(type(error).__name__)\n"
            "told([*said, world.allreduce(1)])\n"
        )
        errors = ["InputError", "OutputError", "DegradedWarning", "ValueError"]
        self.assertEqual(self.told(2, code), 2 * [[*errors, 2]])

    def test_an_error_that_cannot_be_sent_is_raised_on_all_ranks_by_its_text(self):
        code = (
            "from tessera._exchange import all_or_none, on_root\n"
            "class Local(Exception):\n"
            "    def __init__(self, a, b): super().__init__(f'{a} {b}')\n"
            "def fail(): raise Local('only', 'here')\n"
            "said = []\n"
            "for call in (on_root, all_or_none):\n"
            "    try: call(world, fail)\n"
            "    except Exception as error: said.append(str(error).split(': ')[-1])\n"
            "told(said)\n"
        )
        self.assertEqual(self.told(2, code), 2 * [["only here", "only here"]])

    def test_a_rank_that_never_calls_is_named_and_the_program_ends(self):
        """The missing rank waits for the others, who do not catch what they get."""
        for function, absent in (("mesh", 0), ("read", 1)):
            with self.subTest(function=function, absent=absent):
                outcome = self.run_ranks(
                    3,
                    f"if world.rank == {absent}: world.Barrier()\n"
                    f"tessera.{function}(case, comm=world, rank_timeout=0.5)\n",
                )
                self.assertNotEqual(outcome.code, program.OK)
                said = f"tessera.{function}(): rank {absent} of 3 has not called it in "
                self.assertTrue(any(message.startswith(f"tessera: {said}") for message in outcome.messages), outcome.err)
                self.assertNotIn("InputError", outcome.err)  # Nothing was begun.

    def test_a_rank_that_calls_too_late_gets_an_error_too(self):
        code = (
            "ranks, said = world.Dup(), ''\n"
            "def call():\n"
            "    try: tessera.mesh(case, comm=ranks, rank_timeout=0.5)\n"
            "    except tessera.UsageError as error: return error.message\n"
            "if world.rank != 1: said = call()\n"
            "world.Barrier()\n"
            "if world.rank == 1: said = call()\n"
            "told(said)\n"
            "world.Barrier()  # The first one to end ends all.\n"
        )
        outcome = self.run_ranks(3, code)
        self.assertNotEqual(outcome.code, program.OK)  # In the end the ranks are not at the same point.
        first, late, last = json.loads((self.folder / "told.json").read_text())
        for message in (first, last):
            self.assertTrue(message.startswith("tessera.mesh(): rank 1 of 3 has not called it in "), message)
        self.assertIn("rank 1 of 3 has called it when others no longer waited", late)


if __name__ == "__main__":
    unittest.main()

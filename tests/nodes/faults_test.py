#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What may happen to nodes while a mesh is made: a clear end within two minutes, and --resume, on other nodes
too, makes the bits of a run that was never disturbed."""
import concurrent.futures
import glob
import subprocess
import time
import unittest

import program
import room
from on_nodes import HANG_S, NodesTest, on_one_node, stop, two_each
from program import CANNOT_WRITE, OK, STOPPED

CASE = ["mesh", program.CONFIGS / "cases" / "shaft.toml", "--progress", "never",
        *program.sets("refine.levels=1", "output.report_html=false")]  # fmt: skip

# What a fault may take to its end. It is the program's promise, and mostly waiting for a clock.
LONGEST_END_S = 120.0

# The fill of this subdomain does not end: so the fault comes when others are filled, and more is to be done.
HELD = {"TESSERA_TEST_FAULT": "fill=sleep@3"}
NUM_FILLED = 10


class Fault(NodesTest):
    """A run that something happens to, and one that goes on with it."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        outcome = maker.run_program(*CASE, "--output", "reference", ranks=2)
        assert outcome.code == OK, outcome.err
        cls.reference = program.mesh_files(maker.folder / "reference")

    def start_held(self, ranks_of_node):
        """Starts a run, and waits until it has but one fill to do, which does not end."""
        self.out = self.folder / "out"
        process = self.start_on(ranks_of_node, *CASE, "--output", self.out, variables=HELD)
        program.wait_until(lambda: program.num_filled(self.out) >= NUM_FILLED, "fills", HANG_S)
        return process

    def end_of(self, process, name, within_s=LONGEST_END_S):
        """How a run ends after a fault that has just happened."""
        begin = time.monotonic()
        outcome = self.finish(process, within_s)
        print(f"fault: {name}: exit code {outcome.code} after {time.monotonic() - begin:.0f} s", flush=True)
        return outcome

    def resume(self, ranks_of_node):
        return self.run_on(ranks_of_node, *CASE, "--output", self.out, "--resume")

    def assert_goes_on(self, ranks_of_node):
        """Its lock may name a node that is off: the message says what to remove."""
        outcome = self.resume(ranks_of_node)
        if outcome.code == CANNOT_WRITE:
            self.assertIn("if that run is over, remove", outcome.messages[0])
            (self.out / ".tessera.lock").unlink()
            outcome = self.resume(ranks_of_node)
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        self.assertTrue(self.report("out")["resumed"])
        self.assertEqual(program.mesh_files(self.out), self.reference)

    def assert_ended_well(self, process, name):
        outcome = self.end_of(process, name, HANG_S)  # The rest of a run, on a busy machine.
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        self.assertEqual(program.mesh_files(self.out), self.reference)


class Killed(Fault):
    def test_a_node(self):
        process = self.start_held(two_each(1, 2, 3))
        self.room.kill_node(3)
        outcome = self.end_of(process, "a node is killed")
        self.assertNotIn(outcome.code, (OK, program.FAILED))
        self.assertIn("node3", outcome.err)
        self.assert_goes_on(two_each(4, 2))

    def test_the_node_with_the_lock(self):
        process = self.start_held(two_each(1, 2))
        self.room.kill_node(1)
        self.end_of(process, "the node of mpiexec and of the lock is killed")
        program.wait_until(lambda: "tessera" not in self.room.run(2, ["ps", "-eo", "comm"]).stdout, "node2's ranks",
                           LONGEST_END_S)  # fmt: skip
        refused = self.resume(two_each(2, 3))
        self.assert_refused(refused, CANNOT_WRITE, "host node1", "if that run is over, remove", ".tessera.lock")
        self.assert_goes_on(two_each(2, 3))


class FailingFiles(Fault):
    """The shared folder of one node, and of all, fails when some pieces are there."""

    def setUp(self):
        super().setUp()
        self.library = self.folder / "write_fault.so"
        source = room.HERE / "write_fault.c"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", self.library, source, "-ldl"], check=True)
        self.out = self.folder / "out"

    def variables(self, error):
        return {"LD_PRELOAD": self.library, "WRITE_FAULT_FOLDER": self.out, "WRITE_FAULT_ERROR": error,
                "WRITE_FAULT_WHEN": self.out / "pieces" / "piece_000005.record"}  # fmt: skip

    def assert_ends_and_goes_on(self, words, name, **how):
        process = self.start_on(two_each(1, 2, 3), *CASE, "--output", self.out, **how)
        program.wait_until(lambda: (self.out / "pieces").is_dir() or process.poll() is not None, "pieces", HANG_S)
        outcome = self.end_of(process, name)
        self.assert_refused(outcome, CANNOT_WRITE, str(self.out), words)
        self.assert_goes_on(two_each(4, 2))

    def test_no_space_left_for_one_node(self):
        before = on_one_node(2, self.variables("ENOSPC"))
        self.assert_ends_and_goes_on("No space left", "no space left, seen by one node", before=before)

    def test_no_space_left_for_all(self):
        variables = self.variables("ENOSPC")
        self.assert_ends_and_goes_on("No space left", "no space left, seen by all nodes", variables=variables)

    def test_stale_file_handles_on_one_node(self):
        before = on_one_node(2, self.variables("ESTALE"))
        self.assert_ends_and_goes_on("Stale file handle", "stale file handles on one node", before=before)


class Slow(Fault):
    def test_a_node_and_lost_packets(self):
        """Three packets of a hundred are lost, and one node has a fifth of the time."""
        for node in (1, 2, 3):
            self.room.lose_packets(node, "numgen random mod 100 < 3")
        throttle = "while true; do kill -STOP -1; sleep 0.4; kill -CONT -1; sleep 0.1; done"
        self.out = self.folder / "out"
        process = self.start_on({1: 1, 2: 1, 3: 1}, *CASE, "--output", self.out)
        program.wait_until(lambda: (self.out / "log").is_dir(), "a run", HANG_S)
        throttled = self.start_command(self.room.command(3, ["sh", "-c", throttle]))
        self.assert_ended_well(process, "packets are lost, and a node is slow")
        self.assertIsNone(throttled.poll())

    def test_clocks_that_differ_by_an_hour(self):
        (library,) = glob.glob("/usr/lib/*/faketime/libfaketime.so.1")
        # Clocks that only go forward are each machine's own.
        ahead = on_one_node(2, {"LD_PRELOAD": library, "FAKETIME": "+3600", "FAKETIME_DONT_FAKE_MONOTONIC": "1"})
        hours = [int(self.room.run(node, [*ahead, "date", "+%s"]).stdout) // 60 for node in (1, 2)]
        self.assertIn(hours[1] - hours[0], (60, 61))
        self.out = self.folder / "out"
        process = self.start_on(two_each(2, 1), *CASE, "--output", self.out, before=ahead, variables=HELD)
        program.wait_until(lambda: program.num_filled(self.out) >= NUM_FILLED, "fills", HANG_S)
        stop(process)
        outcome = self.end_of(process, "a clock is an hour ahead, and the run is stopped")
        self.assert_refused(outcome, STOPPED, "stopped by a signal")
        self.assert_goes_on(two_each(1, 3))


class Silent(unittest.TestCase):
    """Faults that nobody is told of: connections stay, and nothing comes. All at the same time, for each is a minute
    of waiting."""

    FAULTS = ("off", "cut", "cut_of_mpiexec", "cut_between_two", "stopped")

    def test_all(self):
        for name in self.FAULTS:
            getattr(SilentFault, name)  # A misspelt one would fail in a thread.
        SilentFault.setUpClass()
        self.addCleanup(SilentFault.doClassCleanups)
        faults = [SilentFault(name) for name in self.FAULTS]
        for fault in faults:  # Not in the threads: a room ends with the one that made it.
            fault.setUp()
            self.addCleanup(fault.doCleanups)
        with concurrent.futures.ThreadPoolExecutor(len(faults)) as pool:
            runs = {name: pool.submit(getattr(fault, name)) for name, fault in zip(self.FAULTS, faults)}
        for name, run in runs.items():
            with self.subTest(fault=name):
                run.result()


class SilentFault(Fault):
    """Its methods are run by Silent."""

    RANKS = {1: 1, 2: 1, 3: 1}

    def assert_silence_is_noticed(self, process, name, *words):
        """By mpiexec, which says so after 45 s, or by the program after 60 s."""
        outcome = self.end_of(process, name)
        self.assertNotIn(outcome.code, (OK, program.FAILED))
        for word in words:
            self.assertIn(word, outcome.err)
        for node in self.room.pids:  # Ranks of a node that nothing reaches end too.
            running = lambda: "tessera" in self.room.run(node, ["ps", "-eo", "comm"]).stdout  # noqa: B023, E731
            program.wait_until(lambda: not running(), f"the end of node{node}'s ranks", LONGEST_END_S)  # noqa: B023

    def off(self):
        process = self.start_held(self.RANKS)
        self.room.set_link(3, "down")
        self.room.kill_node(3)
        self.assert_silence_is_noticed(process, "a node is off", "lost communication", "node3")
        self.assert_goes_on(two_each(4, 2))

    def cut(self):
        process = self.start_held(self.RANKS)
        self.room.set_link(3, "down")
        self.assert_silence_is_noticed(process, "a node's network is cut", "lost communication", "node3")
        self.assert_goes_on(two_each(4, 2))

    def cut_of_mpiexec(self):
        process = self.start_held(self.RANKS)
        self.room.set_link(1, "down")
        self.assert_silence_is_noticed(process, "the network of mpiexec's node is cut", "lost communication")
        self.assert_goes_on(two_each(4, 2))

    def cut_between_two(self):
        process = self.start_held(self.RANKS)
        for node, other in ((2, 3), (3, 2)):
            self.room.lose_packets(node, f"ip saddr {self.room.address(other)}")
        self.assert_silence_is_noticed(
            process, "the network between two nodes is cut", "its node or the network to it is down; seen from"
        )
        self.assert_goes_on(two_each(4, 2))

    def stopped(self):
        """A node whose processes stand still, as when a batch system suspends them, is not lost."""
        self.out = self.folder / "out"
        process = self.start_on(self.RANKS, *CASE, "--output", self.out)
        program.wait_until(lambda: (self.out / "pieces").is_dir(), "fills", HANG_S)
        self.room.signal_node(3, "STOP")
        time.sleep(75)  # Longer than a peer may be silent.
        self.room.signal_node(3, "CONT")
        self.assert_ended_well(process, "a node stands still for 75 s, and goes on")


def load_tests(loader, _tests, _pattern):
    cases = (Killed, FailingFiles, Slow, Silent)
    return unittest.TestSuite(loader.loadTestsFromTestCase(case) for case in cases)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Signals and killed processes: a run stops or goes on, but never hangs or leaves processes behind."""
import json
import os
import shutil
import signal
import time
import unittest

import program
from program import FAILED, OK, STOPPED

# To stop a run takes a tick of some milliseconds; the rest is for a busy machine.
QUICK_S = 10.0


def catches(pid, number):
    """Whether the process has a handler of its own for the signal."""
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        caught = next(line.split()[1] for line in status if line.startswith("SigCgt:"))
    return int(caught, 16) >> (number - 1) & 1


class SignalsTest(program.ProgramTest):
    def start_run(self, case, ranks=None, fault="fill=sleep"):
        """Fills that sleep: nobody waits for their end, and no machine is so fast that the run is over first."""
        return self.start(
            "mesh", case, "--output", "out", "--progress", "never",
            ranks=ranks, env=os.environ | {"TESSERA_TEST_FAULT": fault},
        )  # fmt: skip

    def report(self):
        return json.loads((self.folder / "out" / "report.json").read_text())

    def wait_for_job(self, *ranks):
        """Zygote, model zygote and a fill job of ranks of a node, as soon as there are all three."""

        log = self.folder / "out" / "log" / "run.log"

        def chain():
            is_planned = log.exists() and "no folds" in log.read_text()
            found = program.workers_of_node(ranks)
            return found if is_planned and len(found) == 3 else None

        return program.wait_until(chain, "a fill job")

    @staticmethod
    def all_ranks(process, num_ranks):
        ranks = program.ranks_of(process)
        return ranks if len(ranks) == num_ranks else None

    def assert_nothing_is_left(self, pids):
        program.wait_until(
            lambda: not any(program.is_running(pid) for pid in pids), "the end of all processes", QUICK_S
        )


class StopSignals(SignalsTest):
    def setUp(self):
        super().setUp()
        self.case = self.write_case(levels=4)

    def assert_stops(self, number):
        process = self.start_run(self.case)
        self.wait_for_job(process.pid)
        family = program.descendants(process.pid)
        process.send_signal(number)
        outcome = self.finish(process, QUICK_S)
        self.assert_refused(outcome, STOPPED, "stopped by a signal")
        self.assert_nothing_is_left(family)
        self.assertEqual((self.report()["status"], self.report()["exit_code"]), ("stopped", STOPPED))

    def test_interrupt(self):
        self.assert_stops(signal.SIGINT)

    def test_terminate(self):
        self.assert_stops(signal.SIGTERM)

    def test_warning_of_a_batch_system(self):
        self.assert_stops(signal.SIGUSR1)

    def test_during_the_coarse_mesh(self):
        case = self.write_case(max_size=0.05)  # Seconds of coarse meshing.
        process = self.start_run(case)
        program.wait_until(lambda: len(program.chain_of(process.pid)) == 3, "a job")
        time.sleep(0.5)  # Past the import, which takes milliseconds.
        process.terminate()
        self.assert_refused(self.finish(process, QUICK_S), STOPPED, "stopped by a signal")

    def test_check(self):
        """Each rank stops at its next piece, so the signal goes to all of them, as a batch system's does."""
        mesh = self.mesh(self.case, "out", "--set", "fill.kernel=subdivide", "--set", "refine.levels=5")
        for number in (None, 2):
            process = self.start("check", mesh / "mesh.pvtu", ranks=number)
            if number is None:
                ranks = [process.pid]
            else:
                program.wait_until(lambda: len(program.ranks_of(process)) == number, "all ranks")
                ranks = program.ranks_of(process)
            program.wait_until(lambda: all(catches(rank, signal.SIGTERM) for rank in ranks), "handlers")
            for rank in ranks:
                os.kill(rank, signal.SIGTERM)
            self.assert_refused(self.finish(process, QUICK_S), STOPPED, "stopped by a signal")

    def test_folder_can_be_used_again(self):
        process = self.start_run(self.case)
        self.wait_for_job(process.pid)
        process.terminate()
        self.finish(process, QUICK_S)
        self.mesh(self.write_case(levels=0), "out", "--overwrite")

    def test_one_rank_of_three_stops_all(self):
        process = self.start_run(self.case, ranks=3)
        ranks = program.wait_until(lambda: program.ranks_of(process), "ranks")
        self.wait_for_job(ranks[0])
        family = program.descendants(process.pid)
        os.kill(program.ranks_of(process)[1], signal.SIGUSR1)
        self.assert_refused(self.finish(process, QUICK_S), STOPPED, "stopped by a signal")
        self.assert_nothing_is_left(family)


class KilledProcesses(SignalsTest):
    def test_killed_rank(self):
        """mpirun ends the others; their jobs go with them."""
        process = self.start_run(self.write_case(), ranks=3)
        ranks = program.wait_until(lambda: program.ranks_of(process), "ranks")
        self.wait_for_job(ranks[0])
        family = program.descendants(process.pid)
        os.kill(program.ranks_of(process)[2], signal.SIGKILL)
        self.assertEqual(self.finish(process, QUICK_S).code, 128 + signal.SIGKILL)
        self.assert_nothing_is_left(family)

    def test_killed_rank_alone(self):
        process = self.start_run(self.write_case())
        self.wait_for_job(process.pid)
        family = program.descendants(process.pid)
        process.kill()
        process.wait()
        self.assert_nothing_is_left(family)

    def kill_a_job_of(self, pid):
        while True:
            _, _, job = self.wait_for_job(pid)
            try:
                return os.kill(job, signal.SIGKILL)
            except ProcessLookupError:
                pass  # It had just ended.

    def with_a_killed_job(self, case):
        """A job that was hit at its very end has done its work; then once more."""
        for _ in range(5):
            process = self.start_run(case, fault="")
            self.kill_a_job_of(process.pid)
            outcome = self.finish(process)
            self.assertEqual(outcome.code, OK, outcome.err)
            if "from outside" in outcome.out:
                return outcome
            shutil.rmtree(self.folder / "out")
        self.fail("no job could be killed at its work")

    def test_killed_job_is_repeated(self):
        case = self.write_case(max_size=0.15, levels=2, subdomains=6)  # Some seconds of jobs.
        outcome = self.with_a_killed_job(case)
        self.assertRegex(outcome.out, "warning: .*Killed.* from outside")
        self.assertTrue(self.report()["reproducible"])
        undisturbed = self.mesh(case, "undisturbed", ranks=2)
        other = json.loads((undisturbed / "report.json").read_text())
        self.assertEqual(self.report()["digest"], other["digest"])

    def assert_ends_without_hang(self, victim, num_ranks=None):
        """Victims: the zygote of the last rank, or the model zygote of all."""
        process = self.start_run(self.write_case(), ranks=num_ranks)
        ranks = [process.pid]
        if num_ranks is not None:
            ranks = program.wait_until(lambda: self.all_ranks(process, num_ranks), "ranks")
        chain = self.wait_for_job(*ranks)
        family = program.descendants(process.pid)
        victims = {"zygote": program.chain_of(ranks[-1])[0], "model zygote": chain[1]}
        os.kill(victims[victim], signal.SIGKILL)
        outcome = self.finish(process, QUICK_S)
        self.assert_refused(outcome, FAILED, "go on with --resume")
        self.assert_nothing_is_left(family)

    def test_killed_zygote(self):
        self.assert_ends_without_hang("zygote")

    def test_killed_zygote_of_one_rank(self):
        self.assert_ends_without_hang("zygote", 3)

    def test_killed_model_zygote(self):
        self.assert_ends_without_hang("model zygote")

    def test_killed_model_zygote_of_a_node(self):
        self.assert_ends_without_hang("model zygote", 3)


if __name__ == "__main__":
    unittest.main()

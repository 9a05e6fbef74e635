#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""pipeline/slurm.sbatch in a real Slurm: whatever happens to its slots, the mesh is that of a run of one slot.

A slot lasts until something happens to it, however quick the machine is: a job of the run sleeps in it.
"""
import unittest

import program
import slurm_room
from slurm_room import SCRIPT

SUBDOMAINS = 8
TASKS = 20

# Slurm warns 25 s before the end, and looks every 30 s: after 5 to 35 s.
SHORT_SLOTS = ["--time=1", "--signal=B:USR1@25"]

# Three slots of a minute at most, and what is between.
SLOTS_S = 420.0

STUCK_IN_FILL = "export TESSERA_TEST_FAULT=fill=sleep@3"
STUCK_IN_IMPROVE = "export TESSERA_TEST_FAULT=improve=sleep@0"

TWO_NODES = ["--ntasks=2", "--ntasks-per-node=1", "--mem-per-cpu=1G"]


class SlurmTest(program.ProgramTest):
    """One Slurm for all; jobs of different tests have different nodes."""

    @classmethod
    def setUpClass(cls):
        cls.maker = cls.make_maker()
        cls.shared = cls.maker.folder
        cls.case = cls.maker.write_case(max_size=0.5, subdomains=SUBDOMAINS)
        cls.reference = cls.maker.mesh(cls.case, "reference", ranks=2)
        cls.slurm = cls.enterClassContext(slurm_room.SlurmRoom(cls.shared))
        # The longest comes first, on nodes of its own. All values are those of the script but the time of a slot.
        stuck = cls.make_program("stuck_twice", slot1=STUCK_IN_FILL, slot2=STUCK_IN_IMPROVE)
        cls.slots = cls.submit("slots", *SHORT_SLOTS, stuck=stuck)

    @classmethod
    def make_program(cls, name, **by_slot):
        """The program after a command of the shell that depends on the slot."""
        slots = {"slot1": "0", "slot2": "1", "later": "*"}
        cases = [f"{slots[slot]}) {command} ;;" for slot, command in by_slot.items()]
        begin = ["#!/bin/sh", "case ${SLURM_RESTART_COUNT:-0} in"]
        file = cls.maker.write(name, "\n".join([*begin, *cases, "esac", f'exec {program.PROGRAM} "$@"', ""]))
        file.chmod(0o755)
        return file

    @classmethod
    def submit(cls, output, *options, stuck=program.PROGRAM):
        return cls.slurm.submit([f"--output={output}.out", *options, SCRIPT, cls.case.name, output], stuck)

    def submit_stuck(self, output, partition="small", **other_slots):
        """A job on two of three nodes that is stuck in its first slot, and has finished some pieces."""
        stuck = self.make_program(f"program_{output}", slot1=STUCK_IN_FILL, **other_slots)
        number = self.submit(output, f"--partition={partition}", *TWO_NODES, stuck=stuck)
        self.slurm.wait_for(lambda: program.num_filled(self.shared / output) > 2, "finished pieces")
        return number

    def said(self, output):
        return (self.shared / f"{output}.out").read_text(encoding="utf-8")

    def assert_goes_on(self, number, output, restarts=1, within_s=slurm_room.HANG_S):
        """It is put back so many times at least, and then makes the same mesh; what Slurm says of it."""
        (job,) = self.slurm.wait_for_end(number, within_s=within_s)
        self.assertGreaterEqual(int(job["Restarts"]), restarts, self.said(output))
        folder = self.shared / output
        self.assertEqual(program.figures(folder), program.figures(self.reference))
        self.assertEqual(program.mesh_files(folder), program.mesh_files(self.reference))
        return job

    def test_warned_before_the_limit_in_two_slots_and_done_in_the_third(self):
        job = self.assert_goes_on(self.slots, "slots", restarts=2, within_s=SLOTS_S)
        self.assertEqual(job["NumTasks"], "16")
        for slot in (1, 2):
            self.assertIn(f"slot {slot} is over; the job goes on", self.said("slots"))

    def preempt(self):
        """An urgent job that needs all nodes of the others; it must get them."""
        urgent = self.slurm.submit(["--partition=urgent", "--nodes=3", "--exclusive", "--wrap=true"])
        self.slurm.wait_for_end(urgent)

    def test_preempted_at_once(self):
        number = self.submit_stuck("preempted")
        self.preempt()
        self.assert_goes_on(number, "preempted")

    def test_preempted_with_a_grace_time(self):
        """Slurm tells the ranks' starters to end, but not the script."""
        number = self.submit_stuck("polite", "polite")
        self.preempt()
        self.assert_goes_on(number, "polite")

    def lose_node(self, output, which, lose):
        number = self.submit_stuck(output)
        node = self.slurm.nodes_of(self.slurm.jobs(number)[0])[which]
        lose(node)
        try:
            self.assert_goes_on(number, output)
        finally:
            if node in self.slurm.nodes.pids:
                self.slurm.nodes.kill_node(node)
            self.slurm.revive_node(node)

    def test_node_of_the_script_is_killed(self):
        self.lose_node("first_killed", 0, self.slurm.nodes.kill_node)

    def test_another_node_is_killed(self):
        """The run ends long before Slurm knows why."""
        self.lose_node("other_killed", 1, self.slurm.nodes.kill_node)

    def test_another_node_is_cut_off(self):
        """Slurm knows long before the run does."""
        self.lose_node("other_cut_off", 1, lambda node: self.slurm.nodes.set_link(node, "down"))

    def test_run_that_dies_at_the_same_place_ends(self):
        """Its first slot has finished something, the others have not."""
        number = self.submit_stuck("dying", later="kill -KILL $$")
        self.slurm.run(["scancel", "--signal=KILL", f"{number}.0"])  # What mpirun has started on the other node.
        (job,) = self.slurm.wait_for_end(number, "FAILED")
        self.assertEqual((job["Restarts"], job["ExitCode"]), ("2", "137:0"), self.said("dying"))
        self.assertIn("and would again", self.said("dying"))

    def test_cancelled_job_does_not_come_back(self):
        number = self.submit_stuck("cancelled")
        self.slurm.run(["scancel", number])
        self.slurm.wait_for_end(number, "CANCELLED")
        for node in range(5, slurm_room.HEAD):
            self.slurm.wait_for_idle(node)
        self.assertEqual(self.slurm.jobs(number)[0]["Restarts"], "0")

    def test_array_of_cases_into_folders_of_their_own(self):
        """One task is put back: the one that has the number of the array, as its last one does."""
        for task in range(1, TASKS + 1):
            case = self.maker.write_case(f"case_{task}.toml", max_size=0.7 * task)
            case.write_text(f"{case.read_text()}geometry.scale = {task}\n")
        stopped = self.maker.write("stopped_once", (
            '#!/bin/sh\n[ "$SLURM_JOB_ID$SLURM_RESTART_COUNT" = "$SLURM_ARRAY_JOB_ID" ] && exit 75\n'
            f'exec {program.PROGRAM} "$@"\n'
        ))  # fmt: skip
        stopped.chmod(0o755)
        options = ["--partition=small", f"--array=1-{TASKS}", "--ntasks=1", "--output=array_%a.out"]
        number = self.slurm.submit([*options, SCRIPT, "case_%a.toml", "array_%a"], stopped)
        tasks = self.slurm.wait_for_end(number)
        restarted = {task["JobId"]: task["Restarts"] for task in tasks}
        self.assertEqual(len(restarted), TASKS)
        self.assertEqual({job for job, restarts in restarted.items() if restarts != "0"}, {number})
        volume = program.figures(self.shared / "array_1")["volume"]
        for task in range(2, TASKS + 1):
            scaled = program.figures(self.shared / f"array_{task}")["volume"] / task**3
            self.assertAlmostEqual(scaled, volume, places=9, msg=task)


if __name__ == "__main__":
    unittest.main()

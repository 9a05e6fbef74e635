#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""A Slurm on the nodes of a room: Debian's own, its daemons started by hand.

The last node is the head: slurmctld runs there, and jobs are submitted there. Each of the others has a slurmd. All
daemons and jobs end with the room. Their logs are in the shared folder.

    with slurm_room.SlurmRoom(folder) as slurm:
        job = slurm.submit([slurm_room.SCRIPT, "case.toml", "out"])
        slurm.wait_for_end(job)

By hand: `slurm_room.py FOLDER -- COMMAND...` runs a command at the head, with FOLDER as the working directory.
"""
import os
import pathlib
import subprocess
import sys
import time

import room

SCRIPT = room.ROOT / "pipeline" / "slurm.sbatch"

# Four nodes are for a job of the script as it stands: a node is said to have so much, whatever the machine has.
NODES = 7
HEAD = NODES + 1
CPUS = 4
MEMORY_MB = 8192

# Whatever Slurm does takes some seconds here; what takes this long, also on a busy machine, never happens.
HANG_S = 150.0

# States that a job does not leave by itself.
ENDS = ("COMPLETED", "FAILED", "CANCELLED", "TIMEOUT")

# A job that was put back waits for cred_expire, a silent node is believed in for SlurmdTimeout, and KillWait is
# between SIGTERM and SIGKILL: shorter than on a cluster. Time limits are looked at every 30 s, which cannot be set.
CONF = """\
ClusterName=room
SlurmctldHost=node{head}
SlurmUser=root
AuthType=auth/munge
AuthInfo=cred_expire=5
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdParameters=config_overrides
ReturnToService=2
StateSaveLocation=/run/slurm/state
SlurmdSpoolDir=/run/slurm/spool
SlurmctldPidFile=/run/slurm/slurmctld.pid
SlurmdPidFile=/run/slurm/slurmd.pid
SlurmctldLogFile={logs}/slurmctld.log
SlurmdLogFile={logs}/%n.log
SchedulerParameters=batch_sched_delay=1,sched_interval=2,bf_interval=2
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
KillWait=5
SlurmdTimeout=15
NodeName=node[1-{nodes}] CPUs={cpus} RealMemory={memory_mb}
PartitionName=large Nodes=node[1-4] Default=YES
PartitionName=small Nodes=node[5-{nodes}] PriorityTier=1
PartitionName=polite Nodes=node[5-{nodes}] PriorityTier=1 GraceTime=30
PartitionName=urgent Nodes=node[5-{nodes}] PriorityTier=2
"""

START_MUNGED = """\
mkdir -p /run/munge /run/slurm/state
install --mode=400 {key} /run/munge/key
munged --force --key-file=/run/munge/key --log-file=/run/munge/log --seed-file=/run/munge/seed
"""


class SlurmRoom:
    """`nodes` is the room. Working directory of all commands and jobs is the shared folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        self.nodes = room.Room(HEAD, self.folder)
        self._logs = self.folder / "slurm_logs"
        self._conf = self.folder / "slurm.conf"
        self._key = self.folder / "munge.key"

    def __enter__(self):
        self._logs.mkdir(exist_ok=True)
        conf = CONF.format(head=HEAD, logs=self._logs, nodes=NODES, cpus=CPUS, memory_mb=MEMORY_MB)
        self._conf.write_text(conf, encoding="ascii")
        self._key.write_bytes(os.urandom(128))
        self.nodes.__enter__()
        try:
            self._start_daemons(HEAD, "slurmctld")
            for node in range(1, HEAD):
                self._start_daemons(node, "slurmd")
            for node in range(1, HEAD):
                self.wait_for_idle(node)
        except BaseException:
            self.nodes.close()
            raise
        return self

    def __exit__(self, *_):
        self.nodes.close()

    def command(self, command, node=HEAD):
        """What runs a command with this Slurm when it is run out here. It gets no environment from out here."""
        given = {
            "PATH": os.environ["PATH"],
            "SLURM_CONF": self._conf,
            "OMPI_ALLOW_RUN_AS_ROOT": 1,
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": 1,
            "OMPI_MCA_mpi_yield_when_idle": 1,  # There are far more ranks than cores.
        }
        environment = [f"{key}={value}" for key, value in given.items()]
        return self.nodes.command(node, ["env", "-i", *environment, *command])

    def run(self, command, node=HEAD):
        """Runs a command, which must end well; its output."""
        command = self.command(command, node)
        done = subprocess.run(command, capture_output=True, text=True, timeout=HANG_S, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{command} has ended with {done.returncode}: {done.stderr}{self.tails()}")
        return done.stdout

    def submit(self, arguments, program=""):
        """Submits a job, for which `program` is Tessera if not the one that the script names; its number."""
        return self.run(["env", f"TESSERA_PROGRAM={program}", "sbatch", "--parsable", *arguments]).strip()

    def jobs(self, number):
        """What `scontrol show job` says of a job or of each task of an array, as a table of its names."""
        lines = self.run(["scontrol", "--oneliner", "show", "job", number]).splitlines()
        return [dict(word.split("=", 1) for word in line.split() if "=" in word) for line in lines]

    def wait_for(self, condition, what, within_s=HANG_S):
        """The first true value of `condition`; after `within_s` an error with the ends of all logs."""
        end = time.monotonic() + within_s
        while time.monotonic() < end:
            if value := condition():
                return value
            time.sleep(0.2)
        raise AssertionError(f"waited {within_s} s in vain: {what}\n{self.tails()}")

    def wait_for_end(self, number, state="COMPLETED", within_s=HANG_S):
        """Until a job, or each task of an array, has ended for good, with this state; gives jobs()."""

        def ended():
            jobs = self.jobs(number)
            if wrong := [job for job in jobs if job["JobState"] in ENDS and job["JobState"] != state]:
                raise AssertionError(f"{wrong} instead of {state}\n{self.tails()}")
            return jobs if all(job["JobState"] == state for job in jobs) else None

        return self.wait_for(ended, f"the end of job {number}", within_s)

    def wait_for_idle(self, node):
        asked = ["sinfo", "--noheader", f"--nodes=node{node}", "--format=%T"]
        self.wait_for(lambda: set(self.run(asked).split()) == {"idle"}, f"node{node} idle")

    def nodes_of(self, job):
        """Numbers of the nodes that a job has, the one of its script first."""
        names = self.run(["scontrol", "show", "hostnames", job["NodeList"]]).split()
        return [int(name.removeprefix("node")) for name in sorted(names, key=lambda name: name != job["BatchHost"])]

    def revive_node(self, node):
        """Starts a node that was killed, with its daemons, and waits until Slurm knows."""
        self.nodes.start_node(node)
        self._start_daemons(node, "slurmd")
        self.wait_for_idle(node)

    def tails(self):
        """The ends of all logs, the last ones of many jobs."""
        outputs = sorted(self.folder.glob("*.out"), key=lambda file: file.stat().st_mtime)[-5:]
        files = [(file, 6) for file in sorted(self._logs.iterdir())] + [(file, 30) for file in outputs]
        return "".join(f"--- {file.name}\n{_tail_of(file, num_lines)}" for file, num_lines in files)

    def _start_daemons(self, node, name):
        self.run(["sh", "-e", "-c", START_MUNGED.format(key=self._key) + name], node)


def _tail_of(file, num_lines):
    return "".join(file.read_text(errors="replace").splitlines(keepends=True)[-num_lines:])


def main():
    folder, command = sys.argv[1], sys.argv[sys.argv.index("--") + 1:]
    os.makedirs(folder, exist_ok=True)
    with SlurmRoom(folder) as slurm:
        sys.exit(subprocess.run(slurm.command(command), check=False).returncode)


if __name__ == "__main__":
    main()

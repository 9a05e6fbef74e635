# SPDX-License-Identifier: BSD-3-Clause
"""What the tests on several nodes share: tests/e2e/program.py, in a room."""
import json
import os
import shlex
import signal

import program
import room
from program import OK

# A run here takes half a minute at most on an idle machine; this is for one that several people use.
HANG_S = 400.0

# What `pipeline/slurm.sbatch` sets; docs/user_guide.md says why.
LAUNCHER = {
    "OMPI_MCA_oob_tcp_keepalive_time": "30",
    "OMPI_MCA_oob_tcp_keepalive_intvl": "5",
    "OMPI_MCA_oob_tcp_keepalive_probes": "3",
}


def two_each(*nodes):
    """Two ranks on each of these nodes."""
    return dict.fromkeys(nodes, 2)


class NodesTest(program.ProgramTest):
    """A test with four nodes of its own. `self.folder` is what they share."""

    def setUp(self):
        super().setUp()
        self.room = room.Room(4, self.folder)
        self.room.__enter__()
        self.addCleanup(self.room.close)

    def start_on(self, ranks_of_node, *arguments, before=(), variables=None):
        """Starts the program on so many ranks of each node ({1: 2, 2: 2}); mpiexec runs on the first of them.

        `before` is a command that runs the program in each rank. `variables` are for all ranks.
        """
        first = next(iter(ranks_of_node))
        exports = [word for name, value in (variables or {}).items() for word in ("-x", f"{name}={value}")]
        command = [*self.room.mpiexec(ranks_of_node), *exports, *before, program.PROGRAM, *arguments]
        return self.start_command(self.room.command(first, command), env={**os.environ, **LAUNCHER})

    def run_on(self, ranks_of_node, *arguments, **options):
        """The same, to its end."""
        return self.finish(self.start_on(ranks_of_node, *arguments, **options), HANG_S)

    def mesh_on(self, ranks_of_node, case, output, *arguments, **options):
        """Runs a case that must end well; its folder."""
        words = ["mesh", case, "--output", self.folder / output, "--progress", "never", *arguments]
        outcome = self.run_on(ranks_of_node, *words, **options)
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        return self.folder / output

    def report(self, output):
        return json.loads((self.folder / output / "report.json").read_text(encoding="utf-8"))


def stop(process):
    """Warns a started run of its end, as a batch system does: mpiexec hands that on to its ranks."""
    (mpiexec,) = program.children(process.pid)  # Below nsenter, which hands on nothing.
    os.kill(mpiexec, signal.SIGUSR1)


def on_one_node(node, variables):
    """A command that runs another one, with these variables if it is on this node."""
    exports = " ".join(f"{name}={shlex.quote(str(value))}" for name, value in variables.items())
    return ["sh", "-c", f'[ "$(hostname)" != node{node} ] || export {exports}; exec "$@"', "sh"]

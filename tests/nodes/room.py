# SPDX-License-Identifier: BSD-3-Clause
"""Nodes of a cluster on one machine: each has network, PID, UTS, mount and IPC namespaces of its own.

A room is a set of namespaces with a bridge; the nodes are inside it. All of it ends with the process that made it,
however that ends, and the machine around has nothing of it: no interface, no mount, no process.

    with room.Room(4, shared=folder) as cluster:
        cluster.run(1, ["hostname"])                                      # node1
        cluster.run(1, [*cluster.mpiexec({1: 2, 3: 2}), "tessera", ...])  # two ranks on node1, two on node3

By hand: `room.py 4 FOLDER -- COMMAND...` runs a command in node1, with FOLDER as the working directory;
`room.py --probe` tells whether this machine can have a room.
"""
import ctypes
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from node_init import NETWORK

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
AGENT = HERE / "agent"
PYTHON = "/usr/bin/python3"

_UNSHARE = ["unshare", "--fork", "--kill-child", "--pid", "--mount", "--net", "--uts", "--ipc"]
_PR_SET_PDEATHSIG = 1

# Making a room takes a second; one that takes this long, also on a busy machine, never will be.
_READY_S = 60.0


def why_not():
    """Why this machine cannot have a room, as one line; None if it can."""
    probe = "mount -t tmpfs none /tmp && mount -t proc proc /proc"
    if shutil.which("ip"):
        probe += " && ip link add br0 type bridge && ip link add veth1 type veth peer name veth2"
    try:
        done = subprocess.run(
            [*_UNSHARE, "sh", "-c", probe], capture_output=True, text=True, timeout=_READY_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"namespaces cannot be tried here: {error}"
    if done.returncode == 0:
        return None
    return "this machine does not let us make namespaces: " + " ".join(done.stderr.split())


class Room:
    """`num_nodes` nodes, node1 and on, which have `shared` and the rest of the machine's files in common, but not
    /tmp, /run and /dev/shm. Their addresses are 10.77.0.1 and on."""

    def __init__(self, num_nodes, shared):
        self.shared = pathlib.Path(shared).resolve()
        self.num_nodes = num_nodes
        self.pids = {}  # Of the first process of each node, as the machine around counts.

    def __enter__(self):
        kept = [str(ROOT), str(self.shared)]
        libc = ctypes.CDLL(None)
        self._process = subprocess.Popen(
            [*_UNSHARE, PYTHON, "-B", str(HERE / "room_init.py"), *kept],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            preexec_fn=lambda: libc.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL),
        )  # fmt: skip
        try:
            self.pid = self._answer()
            for node in range(1, self.num_nodes + 1):
                self.start_node(node)
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends all that runs in it."""
        self._process.stdin.close()
        try:
            self._process.wait(timeout=_READY_S)
        finally:
            self._process.kill()
            self._process.stdout.close()

    def start_node(self, node):
        """Starts a node, also one that was killed. Its links and files are new then."""
        self._process.stdin.write(f"{node}\n")
        self._process.stdin.flush()
        self.pids[node] = self._answer()

    def kill_node(self, node):
        """Ends all processes of a node at once; what it had in memory is lost. Peers see their connections closed."""
        pid = self.pids.pop(node)
        os.kill(pid, signal.SIGTERM)  # The end of a PID namespace's first process kills all others of it.
        end = time.monotonic() + _READY_S
        while os.path.exists(f"/proc/{pid}") and time.monotonic() < end:
            time.sleep(0.01)

    def command(self, node, command, folder=None):
        """What runs a command in a node when it is run out here. The working directory is `shared`, if not told."""
        return [*_enter(self.pids[node]), "env", f"--chdir={folder or self.shared}", *map(str, command)]

    def run(self, node, command, timeout_s=_READY_S, **options):
        """Runs a command in a node to its end: subprocess.run(), outputs as text."""
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "check": True, **options}
        return subprocess.run(self.command(node, command), text=True, timeout=timeout_s, **options)

    def mpiexec(self, ranks_of_node):
        """The command, for the first of these nodes, that starts so many ranks on each: {1: 2, 2: 2}.

        Ranks of a node share memory, others have TCP alone.
        """
        hosts = ",".join(f"node{node}:{ranks}" for node, ranks in ranks_of_node.items())
        settings = {
            "plm_rsh_agent": AGENT,
            "pml": "ob1",
            "btl": "self,vader,tcp",
            "hwloc_base_binding_policy": "none",
            "mpi_yield_when_idle": "1",
        }
        words = [word for key, value in settings.items() for word in ("--mca", key, str(value))]
        return ["mpiexec", "--allow-run-as-root", "--host", hosts, *words, "-n", str(sum(ranks_of_node.values()))]

    def address(self, node):
        return f"{NETWORK}.{node}"

    def set_link(self, node, state):
        """Plugs the network of a node in ("up") or out ("down")."""
        self._in_room(["ip", "link", "set", f"to_node{node}", state])

    def lose_packets(self, node, which):
        """From now on a node does not get these packets: a condition of nft."""
        for words in ("table ip lost", "chain ip lost input { type filter hook input priority 0; }",
                      f"rule ip lost input {which} drop"):  # fmt: skip
            self.run(node, ["nft", "add", words])

    def signal_node(self, node, name):
        """Sends a signal ("STOP") to all processes of a node but its first."""
        self.run(node, ["sh", "-c", f"kill -{name} -1"])

    def traffic(self):
        """Bytes and packets that each node has sent since it was started: {1: (bytes, packets)}."""
        links = json.loads(self._in_room(["ip", "-json", "-stats", "link"]))
        sent = {link["ifname"]: link["stats64"]["rx"] for link in links}
        return {node: (count["bytes"], count["packets"]) for node in self.pids if (count := sent[f"to_node{node}"])}

    def _in_room(self, command):
        command = [*_enter(self.pid), *command]
        return subprocess.run(command, check=True, timeout=_READY_S, text=True, stdout=subprocess.PIPE).stdout

    def _answer(self):
        """The process number that the room says next. It ends with this process, so this does not wait for ever."""
        line = self._process.stdout.readline()
        if not line.strip().isdigit():
            raise OSError(f"the room has failed: {line or 'no answer'}")
        return int(line)


def _enter(pid):
    return ["nsenter", f"--target={pid}", "--mount", "--uts", "--ipc", "--net", "--pid"]


def main():
    if reason := why_not():
        sys.exit(f"room: {reason}")
    if sys.argv[1:] == ["--probe"]:
        return
    num_nodes, folder = int(sys.argv[1]), sys.argv[2]
    command = sys.argv[sys.argv.index("--") + 1:]
    with Room(num_nodes, folder) as cluster:
        sys.exit(subprocess.run(cluster.command(1, command), check=False).returncode)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The nodes that the other tests stand on: they share no more than real ones do, and leave nothing behind."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import room


def processes_of(folder):
    """Those that say on their command line that they belong to a room with this folder."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            if folder in pathlib.Path(f"/proc/{pid}/cmdline").read_text(encoding="utf-8", errors="replace"):
                found.append(int(pid))
        except OSError:
            continue
    return found


def names_outside():
    """What a room could leave on the machine around: interfaces and mounts."""
    interfaces = sorted(os.listdir("/sys/class/net"))
    mounts = pathlib.Path("/proc/self/mounts").read_text(encoding="utf-8").splitlines()
    return interfaces, sorted(line.split()[1] for line in mounts)


def wait_until(condition):
    end = time.monotonic() + 60
    while not condition():
        if time.monotonic() > end:
            raise AssertionError("waited a minute in vain")
        time.sleep(0.05)


class RoomTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tessera_nodes_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_nodes_have_names_and_files_of_their_own_and_one_shared_folder(self):
        with room.Room(2, self.folder) as cluster:
            self.assertEqual([cluster.run(node, ["hostname"]).stdout for node in (1, 2)], ["node1\n", "node2\n"])
            for name in ("/tmp", "/dev/shm", "/run", self.folder):
                cluster.run(1, ["touch", f"{name}/of_node1"])
                seen = "of_node1" in cluster.run(2, ["ls", name]).stdout
                self.assertEqual(seen, name == self.folder, name)
            self.assertNotIn("sleep", cluster.run(2, ["ps", "ax"]).stdout)

    def test_the_agent_hands_on_what_a_command_says_and_how_it_ends(self):
        with room.Room(2, self.folder) as cluster:
            done = cluster.run(1, [room.AGENT, "node2", "hostname;", "exit", "3"], check=False)
            self.assertEqual((done.returncode, done.stdout), (3, "node2\n"), done.stderr)

    def test_a_cut_link_and_a_killed_node_are_out_of_reach_until_they_are_back(self):
        def reached():
            return cluster.run(1, ["timeout", "5", room.AGENT, "node2", "true"], check=False).returncode == 0

        with room.Room(2, self.folder) as cluster:
            self.assertTrue(reached())
            cluster.set_link(2, "down")
            self.assertFalse(reached())
            cluster.set_link(2, "up")
            wait_until(reached)
            cluster.kill_node(2)
            self.assertFalse(reached())
            cluster.start_node(2)
            wait_until(reached)

    def test_nothing_is_left_of_a_room_whose_owner_is_killed(self):
        before = names_outside()
        owner = subprocess.Popen(
            [sys.executable, "-B", str(room.HERE / "room.py"), "2", self.folder, "--", "sh", "-c",
             f"setsid sh -c 'sleep 1000; true' {self.folder} & echo started; wait"], stdout=subprocess.PIPE,
        )  # fmt: skip
        self.assertEqual(owner.stdout.readline(), b"started\n")
        self.assertGreater(len(processes_of(self.folder)), 4)
        owner.send_signal(signal.SIGKILL)
        owner.communicate()
        wait_until(lambda: not processes_of(self.folder))
        self.assertEqual(names_outside(), before)


if __name__ == "__main__":
    unittest.main()

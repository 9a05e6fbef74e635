# SPDX-License-Identifier: BSD-3-Clause
"""First process of a room: has the bridge, and starts a node for each number that it is told on standard input.

It answers with the number of its own first process, and then of each node's, as the machine around counts. When its
standard input ends, so does it, and with it all processes of the room.
"""
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def ip(*words):
    subprocess.run(["ip", *words], check=True)


def link_of(node):
    return f"to_node{node}"


def start_node(node, kept):
    """Starts a node, gives it a link to the bridge, and waits until it is ready; its process number."""
    process = subprocess.Popen(
        ["unshare", "--fork", "--kill-child", "--pid", "--mount", "--net", "--uts", "--ipc",
         "/usr/bin/python3", "-B", str(HERE / "node_init.py"), str(node), *kept],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    pid = int(process.stdout.readline())
    link = link_of(node)
    ip("link", "add", link, "type", "veth", "peer", "name", "eth0", "netns", f"/proc/{pid}/ns/net")
    ip("link", "set", link, "master", "br0", "up")
    process.stdin.write("linked\n")
    process.stdin.flush()
    if process.stdout.readline() != "ready\n":
        raise OSError(f"node{node} has not become ready")
    return process, pid


def main():
    kept = sys.argv[1:]
    ip("link", "add", "br0", "type", "bridge")
    ip("link", "set", "br0", "up")
    print(os.readlink("/proc/self"), flush=True)  # /proc is still that of the machine around.
    nodes = {}
    for line in sys.stdin:
        node = int(line)
        if node in nodes:  # It was killed. The kernel takes its time to remove the link.
            nodes[node].wait()
            subprocess.run(["ip", "link", "delete", link_of(node)], stderr=subprocess.DEVNULL, check=False)
        nodes[node], pid = start_node(node, kept)
        print(pid, flush=True)


if __name__ == "__main__":
    main()

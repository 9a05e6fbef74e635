# SPDX-License-Identifier: BSD-3-Clause
"""What the processes of each node have in memory, and what they are."""
import collections
import dataclasses
import os
import pathlib
import re

ROLES = ("rank", "zygote", "model zygote", "job")


@dataclasses.dataclass
class Look:
    """Of one look at a node."""

    anon: float = 0.0  # Bytes, of all processes.
    shared: float = 0.0
    segments: dict = dataclasses.field(default_factory=dict)  # Bytes of each piece of shared memory, by its inode.
    roles: collections.Counter = dataclasses.field(default_factory=collections.Counter)


def text_of(path):
    try:
        return pathlib.Path(path).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def parents():
    """Of all processes."""
    stats = {int(name): text_of(f"/proc/{name}/stat") for name in os.listdir("/proc") if name.isdigit()}
    return {pid: int(stat.rpartition(")")[2].split()[1]) for pid, stat in stats.items() if stat}


def program_of(pid):
    try:
        return os.readlink(f"/proc/{pid}/exe")
    except OSError:
        return ""


def node_of(pid):
    try:
        return os.readlink(f"/proc/{pid}/ns/pid")
    except OSError:
        return ""


def look(cluster, program):
    """At each node."""
    of_node = {node_of(pid): node for node, pid in cluster.pids.items()}
    looks = {node: Look() for node in cluster.pids}
    parent = parents()
    own = {pid for pid in parent if program_of(pid) == program}
    for pid in own:
        depth, above = 0, parent[pid]
        while above in own:
            depth, above = depth + 1, parent[above]
        if (node := of_node.get(node_of(pid))) is not None:
            add_process(looks[node], pid, ROLES[min(depth, 3)])
    return looks


def add_process(node, pid, role):
    node.roles[role] += 1
    for name, kilobytes in re.findall(r"^Pss_(Anon|Shmem): +(\d+)", text_of(f"/proc/{pid}/smaps_rollup"), re.MULTILINE):
        if name == "Anon":
            node.anon += 1024 * int(kilobytes)
        else:
            node.shared += 1024 * int(kilobytes)
    for line in text_of(f"/proc/{pid}/maps").splitlines():
        if "/memfd:tessera" in line:
            begin, end = (int(word, 16) for word in line.split()[0].split("-"))
            node.segments[line.split()[4]] = end - begin


def bytes_shared(one):
    return sum(one.segments.values())

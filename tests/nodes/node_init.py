# SPDX-License-Identifier: BSD-3-Clause
"""First process of a node: gives it a name, an address and files of its own, then runs what `agent` asks for.

Says its process number as the machine around counts, waits for a line, by which there is a link eth0, and says "ready".
"""
import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys

PORT = 2222
NETWORK = "10.77.0"
MOST_NODES = 16
OWN_FOLDERS = ("/tmp", "/run", "/dev/shm")


def mount(*words):
    subprocess.run(["mount", *words], check=True)


def own_files(kept):
    """New, empty folders in place of those of the machine; what is kept of them stays where it was."""
    handles = {path: os.open(path, os.O_PATH) for path in kept}
    for folder in OWN_FOLDERS:
        mount("-t", "tmpfs", "-o", "mode=1777", "tmpfs", folder)
    for path, handle in handles.items():
        if any(pathlib.Path(folder) in pathlib.Path(path).parents for folder in OWN_FOLDERS):
            os.makedirs(path)
            # Not by its name, which means the new folder by now.
            command = ["mount", "--no-canonicalize", "--bind", f"/proc/self/fd/{handle}", path]
            subprocess.run(command, check=True, pass_fds=[handle])
        os.close(handle)
    mount("-t", "proc", "proc", "/proc")


def own_network(node):
    hosts = pathlib.Path("/run/hosts")
    names = "".join(f"{NETWORK}.{k} node{k}\n" for k in range(1, MOST_NODES + 1))
    hosts.write_text("127.0.0.1 localhost\n" + names, encoding="ascii")
    mount("--bind", str(hosts), "/etc/hosts")
    # The same after a restart, so that others need not ask for it.
    hardware = f"02:00:0a:4d:00:{node:02x}"
    address = f"{NETWORK}.{node}/24"
    for words in ("lo up", f"eth0 address {hardware}", "eth0 up"):
        subprocess.run(["ip", "link", "set", *words.split()], check=True)
    subprocess.run(["ip", "address", "add", address, "dev", "eth0"], check=True)


def serve(connection):
    """Runs one command line, and hands on what it says: a length and bytes, again and again; 0 and the exit code."""
    with connection, connection.makefile("rwb") as stream:
        (length,) = struct.unpack("!I", stream.read(4))
        command = stream.read(length).decode()
        process = subprocess.Popen(
            ["/bin/sh", "-c", command], cwd="/",
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        while said := process.stdout.read1(65536):
            stream.write(struct.pack("!I", len(said)) + said)
            stream.flush()
        stream.write(struct.pack("!Ii", 0, process.wait()))


def reap(*_):
    """Orphans of a PID namespace come to its first process."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        pass


def main():
    node, kept = int(sys.argv[1]), sys.argv[2:]
    print(os.readlink("/proc/self"), flush=True)
    socket.sethostname(f"node{node}")
    own_files(kept)
    sys.stdin.readline()
    own_network(node)
    listener = socket.create_server(("", PORT))
    print("ready", flush=True)
    signal.signal(signal.SIGCHLD, reap)
    signal.signal(signal.SIGTERM, lambda *_: os._exit(0))
    while True:
        connection, _ = listener.accept()
        if os.fork() == 0:
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            listener.close()
            serve(connection)
            os._exit(0)
        connection.close()


if __name__ == "__main__":
    main()

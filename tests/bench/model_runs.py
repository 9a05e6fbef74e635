# SPDX-License-Identifier: BSD-3-Clause
"""What the benches share that give strange models to `tessera mesh`: a program with a limit of time, how it
ended, the rows of a table in a file that grows."""
import dataclasses
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time

ENDINGS = {0: "ok", 2: "failed", 3: "degraded", 64: "refused"}  # 73 and 75 have no cause here.
HAS_MESH = ("ok", "degraded")
CAD_KINDS = (".geo", ".stl", ".step", ".stp", ".iges", ".igs", ".brep")
WALL_FOR_CPU = 3.0


@dataclasses.dataclass
class Ended:
    """How a program ended; `code` None: not within the time. CPU time is that of its children as well."""

    code: int | None
    out: str
    err: str
    seconds: float
    cpu_s: float

    @property
    def said(self):
        return "; ".join(line.strip() for line in self.err.splitlines() if line.strip())

    @property
    def outcome(self):
        return "slow" if self.code is None else ENDINGS.get(self.code, f"code {self.code}")


def cpu_of_session(session):
    """User and system seconds of its processes and of the children that they waited for."""
    ticks = 0
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # It has just ended.
            continue
        if int(fields[3]) == session:
            ticks += sum(map(int, fields[11:15]))
    return ticks / os.sysconf("SC_CLK_TCK")


def is_over_limit(process, wall_s, limit_s, wall_for_cpu):
    if not wall_for_cpu:
        return wall_s > limit_s
    return wall_s > wall_for_cpu * limit_s or cpu_of_session(process.pid) > limit_s


def wait_within(process, limit_s, wall_for_cpu):
    """The exit code, or None; and the CPU seconds until then."""
    start, pause_s, next_look_s = time.monotonic(), 0.005, 0.0
    while True:
        pid, status, used = os.wait4(process.pid, os.WNOHANG)  # It alone says what this one child took.
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, used.ru_utime + used.ru_stime
        wall_s = time.monotonic() - start
        if wall_s >= next_look_s:
            if is_over_limit(process, wall_s, limit_s, wall_for_cpu):
                return None, cpu_of_session(process.pid)
            next_look_s = wall_s + min(wall_s, 1.0)
        time.sleep(pause_s)
        pause_s = min(2.0 * pause_s, 0.05)


def run(command, limit_s, by_cpu=False, wall_for_cpu=WALL_FOR_CPU):
    """Ends the program with all its children if it takes too long: by the clock, or with `by_cpu` in CPU
    seconds of all together, for a machine that has other work (and then so many times as long by the clock)."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                   start_new_session=True)
        try:
            code, cpu_s = wait_within(process, limit_s, wall_for_cpu if by_cpu else 0.0)
        finally:  # Whatever stops the bench, nothing is left behind.
            end_session(process)
        seconds = time.monotonic() - start
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
    return Ended(code, *texts, seconds, cpu_s)


def end_session(process):
    """With its jobs: they are groups of their own."""
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
            if int(fields[3]) == process.pid:
                os.kill(int(stat.parent.name), signal.SIGKILL)
        except OSError:
            continue
    process.wait()


def mesh_command(program, ranks):
    """`tessera mesh`, on so many ranks."""
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    mpirun = ["mpirun", "-n", ranks, "--bind-to", "none", "--oversubscribe"] if ranks > 1 else []
    return [*mpirun, program, "mesh"]


def diagonal_of(program, model, limit_s):
    """Of the model's box, in the unit of the output; 1 if the program refuses the file anyway."""
    found = re.search(r"box diagonal (\S+)", run([program, "info", model], limit_s).out)
    return float(found[1]) if found else 1.0


def defect_of(program, mesh, report, limit_s):
    """What `tessera check` has against a mesh that its run calls valid; empty: nothing."""
    checked = run([program, "check", mesh, "--json"], limit_s)
    if checked.code != 0:
        return f"check ends with {checked.code}: {checked.out[:300]} {checked.err[:300]}"
    if json.loads(checked.out)["digest"] != report["digest"]:
        return "check finds another digest"
    return ""


class Rows:
    """Rows as they come: JSON lines in a file, so that a bench that was stopped can go on. Of two with the
    same key the later counts; those with an outcome of `redo` are made again."""

    def __init__(self, file: pathlib.Path | None, resume: bool, redo=()):
        self.file = file
        self.rows = []
        if file and resume and file.exists():
            lines = map(json.loads, file.read_text().splitlines())
            self.rows = [row for row in lines if row["outcome"] not in redo]
        elif file:
            file.write_text("")

    def find(self, **key):
        """The row that has all these values, or None."""
        return next((row for row in reversed(self.rows) if all(row.get(k) == v for k, v in key.items())), None)

    def add(self, row):
        self.rows.append(row)
        if self.file:
            with self.file.open("a") as lines:
                lines.write(json.dumps(row) + "\n")

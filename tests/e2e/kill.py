# SPDX-License-Identifier: BSD-3-Clause
"""Killing a run at a chosen moment: when a stage begins, some time into it, or while a file is half written."""
import contextlib
import os
import re
import shutil
import signal
import time

import program
from program import OK

STAGES = ("model", "coarse", "decompose", "plan", "fill", "improve", "verify", "write")

# Of a mesh with layers on its walls.
LAYER_STAGES = (*STAGES[:2], "layers", *STAGES[2:])

# One of each kind of process that a run has; "all": mpirun and everything below it.
VICTIMS = ("rank", "zygote", "model zygote", "job", "all")

_STAGE_LINE = re.compile(rf" info ({'|'.join(LAYER_STAGES)}) +(?!\d+ of )", re.MULTILINE)


class Watch:
    """Looks at what a run that has just been started says and writes."""

    def __init__(self, process, folder):
        self.process = process
        self.folder = folder
        self.log = folder / "log" / "run.log"
        # A resumed run goes on in the log of the one before.
        self.old_size = self.log.stat().st_size if self.log.exists() else 0
        self._seen = 0, []  # Size of the log when it was read last, and the stages that had ended.

    def ended_stages(self):
        with contextlib.suppress(FileNotFoundError):
            size = self.log.stat().st_size
            if size != self._seen[0]:
                with self.log.open() as log:
                    log.seek(self.old_size)
                    self._seen = size, _STAGE_LINE.findall(log.read())
            return self._seen[1]
        return []

    def wait_for_stage(self, stage, stages=STAGES):
        """Until `stage` of a run with these stages has begun, "end": the last is over; False if the run has ended."""
        order = [*stages, "end"]
        before = order.index(stage) - 1
        return self.wait_for(lambda: before < 0 and self.log.exists() or stages[before] in self.ended_stages())

    def wait_for_half_written_file(self, subfolder):
        """Until there is a file that has not got its final name; False if the run has ended first."""
        return self.wait_for(lambda: any(".tmp-" in name for name in names_in(self.folder / subfolder)))

    def wait(self, seconds):
        """False if the run has ended by then."""
        end = time.monotonic() + seconds
        return self.wait_for(lambda: time.monotonic() >= end)

    def victims(self, kind, which=0):
        """Processes to kill: of rank number `which`, wrapping round. Waits until there is one of the kind; to
        be asked before the moment of the kill, for the answer takes some milliseconds."""
        found = []

        def look():
            if kind == "all":
                found[:] = [self.process.pid, *program.descendants(self.process.pid)]
                return True
            own = self.process.pid
            ranks = [own] if program.is_program(own) else program.ranks_of(self.process) or [own]
            rank = ranks[which % len(ranks)]
            if kind in ("rank", "zygote"):
                found[:] = [rank, *program.chain_of(rank)[:1]][VICTIMS.index(kind):]
            else:  # All ranks of a node have theirs in common.
                found[:] = program.workers_of_node(ranks)[VICTIMS.index(kind) - 1:][:1]
            return bool(found)

        self.wait_for(look)
        return found

    def kill(self, victims):
        """SIGKILL to all of them, at once; waits until the whole run is gone; its exit code."""
        for pid in victims:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        self.process.communicate(timeout=program.HANG_S)
        program.wait_until(lambda: not self._processes(), "the end of all processes")
        return self.process.returncode

    def _processes(self):
        """Those of the run, also the ones that have lost their parents: they work in the same folder."""
        working = []
        for pid in filter(str.isdigit, os.listdir("/proc")):
            with contextlib.suppress(OSError):
                if program.is_program(pid) and os.path.samefile(f"/proc/{pid}/cwd", self.folder.parent):
                    working.append(pid)
        return working

    def has_ended(self):
        return self.process.poll() is not None

    def wait_for(self, condition):
        """False if the run has ended first. Polls often: what is waited for may last a millisecond."""
        end = time.monotonic() + program.HANG_S
        while time.monotonic() < end:
            if condition():
                return True
            if self.has_ended():
                return False
            time.sleep(2e-4)
        raise AssertionError(f"waited {program.HANG_S} s in vain")


def names_in(folder):
    """Names of the files there; none if there is no such folder, or it is gone by now."""
    with contextlib.suppress(FileNotFoundError):
        return os.listdir(folder)
    return []


# On a busy machine a moment of some milliseconds can be missed; then the same is tried again.
TRIES = 5


class RestartTest(program.ProgramTest):
    """`make_arguments(maker)` says what is meshed; `reference` is the result of a run that was not disturbed."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        cls.arguments = cls.make_arguments(maker)
        cls.reference = maker.mesh(cls.arguments[0], "reference", *cls.arguments[1:])

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def start_run(self, ranks=None):
        shutil.rmtree(self.out, ignore_errors=True)
        process = self.start(
            "mesh", *self.arguments, "--output", "out", "--progress", "never", ranks=ranks
        )
        return Watch(process, self.out)

    def kill_run(self, moment, kind="all", ranks=None):
        """Starts a run and kills the processes at the moment that `moment(watch)` waits for."""
        for _ in range(TRIES):
            watch = self.start_run(ranks)
            program.wait_until(lambda: watch.log.exists() or watch.has_ended(), "the log")
            victims = watch.victims(kind, which=1)
            if moment(watch) and watch.kill(victims) != OK and not (self.out / "mesh.pvtu").exists():
                return
        self.fail(f"{TRIES} runs have ended before they could be killed")

    def from_here(self, values):
        """The values, each with what the killed run has left as it was."""
        kept = shutil.copytree(self.out, self.folder / "kept", symlinks=True)
        for value in values:
            shutil.rmtree(self.out)
            shutil.copytree(kept, self.out, symlinks=True)
            yield value

    def resume(self, ranks=None):
        """Compares the end with the reference; the output of the resumed run."""
        outcome = self.run_program(
            "mesh", *self.arguments, "--output", "out", "--progress", "never", "--resume", ranks=ranks
        )
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(program.figures(self.out), program.figures(self.reference))
        self.assertEqual(program.mesh_files(self.out), program.mesh_files(self.reference))
        self.assertFalse((self.out / "pieces").exists())
        return outcome.out

    def assert_signal_is_resumable(self, number, stage, stages):
        for _ in range(TRIES):
            watch = self.start_run()
            if watch.wait_for_stage(stage, stages):
                watch.process.send_signal(number)
            outcome = self.finish(watch.process)
            if outcome.code != OK:
                break
        self.assert_refused(outcome, program.STOPPED, "stopped by a signal")
        self.resume()

    def record(self, name):
        return self.out / "pieces" / f"{name}.record"

    def has_pieces(self, number):
        """A moment: when there are so many finished pieces."""

        def count():
            names = names_in(self.out / "pieces")
            return sum(name.startswith("piece_") and name.endswith(".record") for name in names)

        return lambda watch: watch.wait_for(lambda: count() >= number)

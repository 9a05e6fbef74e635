# SPDX-License-Identifier: BSD-3-Clause
"""Finds the program and runs it: progress goes to standard output, Ctrl-C to the program."""
from __future__ import annotations

import codecs
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from typing import IO, Sequence

from ._errors import ProgramNotFound

# A stopped run writes down what it has; a second Ctrl-C ends it at once, within these seconds.
_SECONDS_TO_DIE = 10.0

_MESSAGE = re.compile(r"^tessera: (.*(?:\n  .*)*)", re.MULTILINE)

# What mpirun tells its ranks. A program that is started from one of these must not take it for itself.
_KEPT = ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")
_OF_MPIRUN = re.compile(
    r"PMI_|PMIX_|(OMPI|PRTE)_(?!MCA_)"
    r"|OMPI_MCA_(orte_|ess|pmix|shmem_RUNTIME|mpi_oversubscribe|initial_wdir)"
    r"|OMPI_MCA_(PREFIXES|cpu_type|mca_base_component_path|num_procs)"  # Open MPI 5
)


def find_program() -> pathlib.Path:
    """The program: what the environment variable TESSERA names, the one that this package was installed or
    built with, or the first in PATH. Local.

    Raises:
        ProgramNotFound: There is none; the message says what to do.
    """
    named = os.environ.get("TESSERA")
    if named:
        if not _is_program(pathlib.Path(named)):
            raise ProgramNotFound(f"TESSERA={named}: the environment variable must name the program, a file")
        return pathlib.Path(named)
    package = pathlib.Path(__file__).resolve().parent
    # PREFIX/lib/python3/dist-packages/tessera, or src/python/tessera in the sources.
    beside = (package.parents[3] / "bin/tessera", package.parents[2] / "build/release/bin/tessera")
    in_path = shutil.which("tessera")
    for program in (*beside, *([pathlib.Path(in_path)] if in_path else [])):
        if _is_program(program):
            return program
    raise ProgramNotFound(
        "the program tessera was not found: neither as "
        + " or ".join(map(str, beside))
        + " nor in PATH. Build it (pipeline/run does), install the Debian package, or set the environment "
        "variable TESSERA to the program"
    )


def _is_program(file: pathlib.Path) -> bool:
    return file.is_file() and os.access(file, os.X_OK)


def command_line(arguments: Sequence[str], ranks: int) -> list[str]:
    """The program with its arguments, from two ranks on under mpirun: its own, if it has MPI inside."""
    program = find_program()
    command = [str(program), *arguments]
    if ranks == 1:
        return command
    own = program.resolve().parent / "tessera-mpirun"
    mpirun = str(own) if _is_program(own) else shutil.which("mpirun")
    if mpirun is None:
        raise ProgramNotFound("mpirun is not in PATH: install openmpi-bin, or mesh with ranks=1")
    # As pipeline/run: two runs on one machine would else share the first cores, and Open MPI counts cores
    # without their hardware threads.
    return [mpirun, "-n", str(ranks), "--bind-to", "none", "--oversubscribe", *command]


def environment() -> dict[str, str]:
    """This process's environment, for a program that is no rank of this process's MPI."""
    return {
        name: value
        for name, value in os.environ.items()
        if name in _KEPT or _OF_MPIRUN.match(name) is None
    }


def run(command: Sequence[str], *, echo: bool = True) -> tuple[int, str]:
    """Runs a command to its end and copies what it prints to sys.stdout, or with echo=False nowhere.

    Returns:
        Its exit code, and what it said on standard error.
    """
    with tempfile.TemporaryFile() as said:
        # In a session of its own: so a Ctrl-C on the terminal reaches it once, from here.
        with subprocess.Popen(
            [*_end_with_this_process(), *command],
            env=environment(),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=said,
            start_new_session=True,
        ) as process:
            try:
                assert process.stdout is not None
                _copy(process.stdout, echo)
                process.wait()
            except BaseException:
                _stop(process)
                raise
        said.seek(0)
        return process.returncode, said.read().decode("utf-8", "replace")


def _end_with_this_process() -> list[str]:
    """What lets Linux end the command if this process is killed; part of util-linux."""
    setpriv = shutil.which("setpriv")
    return [setpriv, "--pdeathsig", "TERM"] if setpriv else []


def _copy(stream: IO[bytes], echo: bool) -> None:
    decoder = codecs.getincrementaldecoder("utf-8")("replace")
    while part := os.read(stream.fileno(), 65536):
        if echo:
            sys.stdout.write(decoder.decode(part))
            sys.stdout.flush()


def _stop(process: subprocess.Popen) -> None:
    """Ends a run in order; a second Ctrl-C while it waits for that ends it at once."""
    for patience in (None, _SECONDS_TO_DIE):
        try:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=patience)
            return
        except KeyboardInterrupt:
            continue
        except subprocess.TimeoutExpired:
            break
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def messages_of(said: str) -> str:
    """The program's own words on standard error; if it has said nothing, all that is there."""
    own = _MESSAGE.findall(said)
    return "\n".join(own) if own else said.strip()

# SPDX-License-Identifier: BSD-3-Clause
"""mesh(): runs the program."""
from __future__ import annotations

import json
import os
import pathlib
import shutil
import sys
import tempfile
import warnings
import weakref
from typing import Any, Mapping, Optional, Union

from . import _program
from ._errors import BY_EXIT_CODE, DegradedWarning, ProgramDied
from ._exchange import Comm, on_root, rank_of
from ._mesh import Mesh
from ._read import read, report_of
from ._roll_call import RANK_TIMEOUT_S, roll_call

_OK, _DEGRADED = 0, 3


def mesh(
    model: Union[str, os.PathLike],
    size: Optional[float] = None,
    *,
    parts: Optional[int] = None,
    ranks: int = 1,
    kernel: Optional[str] = None,
    keys: Optional[Mapping[str, Any]] = None,
    output: Union[str, os.PathLike, None] = None,
    overwrite: bool = False,
    resume: bool = False,
    quiet: bool = False,
    comm: Optional[Comm] = None,
    rank_timeout: float = RANK_TIMEOUT_S,
) -> Mesh:
    """Makes a mesh as `tessera mesh` does: the same files, the same bits. Collective if `comm` is given.

    Ctrl-C ends the run in order and raises KeyboardInterrupt; `resume=True` goes on with it. If this process
    ends for another reason, the run ends too.

    Args:
        model: A CAD model, with `size`; or a case file (.toml).
        size: The wanted edge length.
        parts: Number of parts for a solver, one file each.
        ranks: Processes that make the mesh. The mesh does not depend on it.
        kernel: What fills subdomains: "netgen", "optimize" or "subdivide".
        keys: Keys of a case file and their values, such as {"refine.levels": 2}.
        output: The output folder. Without it a temporary one, which lasts as long as the Mesh that is returned.
        overwrite: Use an output folder that is not empty.
        resume: Go on with a stopped run in `output`.
        quiet: Show no progress.
        comm: A communicator of mpi4py: rank 0 runs the program, then each rank reads its share.
        rank_timeout: How long this rank waits for the others of `comm` to call it too, seconds.

    Returns:
        The mesh. Without `comm` its arrays are read when they are first used.

    Raises:
        TesseraError: On all ranks; the class says what went wrong, see `exit_code` and `message`.
        UsageError: Of these, the one that only some ranks raise: others have not called it in time.
        ImportError: With `comm`, VTK's modules are missing.

    Warns:
        DegradedWarning: There is a valid mesh, but something wanted was missed.
    """
    if resume and output is None:
        raise ValueError("resume=True needs the output folder of the stopped run")
    options = {"--size": size, "--parts": parts, "--kernel": kernel}
    arguments = ["mesh", os.fspath(model), *_words(options), *_settings(keys or {})]
    arguments += [word for word, on in (("--overwrite", overwrite), ("--resume", resume)) if on]
    arguments += ["-q"] if quiet else ["--progress", "always" if _on_terminal() else "never"]
    roll_call(comm, "tessera.mesh()", rank_timeout)
    folder = on_root(comm, lambda: _run_into(arguments, output, ranks))
    if comm is None:
        about = {"folder": folder, "file": folder / "mesh.pvtu", "report": report_of(folder), "comm": None}
        made = Mesh(lambda: read(folder).fields(), **about)
    else:
        made = read(folder, comm)
    if output is None and rank_of(comm) == 0:
        weakref.finalize(made, shutil.rmtree, folder, ignore_errors=True)
    return made


def _on_terminal() -> bool:
    """Whether bars can be drawn; under mpirun each rank's output looks like a terminal."""
    return sys.stdout.isatty() and "OMPI_COMM_WORLD_RANK" not in os.environ


def _words(options: Mapping[str, Any]) -> list[str]:
    return [word for name, value in options.items() if value is not None for word in (name, str(value))]


def _settings(keys: Mapping[str, Any]) -> list[str]:
    """Values as TOML has them; words need no quotes there."""
    return [
        word
        for key, value in keys.items()
        for word in ("--set", f"{key}={value if isinstance(value, str) else json.dumps(value)}")
    ]


def _run_into(arguments: list[str], output: Union[str, os.PathLike, None], ranks: int) -> pathlib.Path:
    """Runs the program; the folder that it has written."""
    if output is not None:
        return _run(arguments, pathlib.Path(output).absolute(), ranks)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="tessera_"))
    try:
        return _run(arguments, folder, ranks)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise


def _run(arguments: list[str], folder: pathlib.Path, ranks: int) -> pathlib.Path:
    """Runs the program, and throws what its exit code says."""
    if ranks < 1:
        raise ValueError(f"ranks={ranks}: must be at least 1")
    command = _program.command_line([*arguments, "--output", str(folder)], ranks)
    code, said = _program.run(command)
    message = _program.messages_of(said)
    if code == _DEGRADED:
        report = report_of(folder) or {}
        warnings.warn(report.get("reason") or message, DegradedWarning, stacklevel=5)
    elif code != _OK:
        error = BY_EXIT_CODE.get(code, ProgramDied)
        raise error(message or f"{' '.join(command)} ended with code {code}", code)
    return folder

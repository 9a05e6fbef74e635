# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong, as exceptions: one class for each exit code of the program."""
from __future__ import annotations

from typing import Optional


class TesseraError(Exception):
    """What all errors of this package are.

    Attributes:
        message: What went wrong, in the program's own words where it has said something.
        exit_code: Of the program; None if it was not even started.
    """

    default_code: Optional[int] = None

    def __init__(self, message: str, exit_code: Optional[int] = None):
        super().__init__(message)
        self.message = message
        self.exit_code = self.default_code if exit_code is None else exit_code

    def __reduce__(self):  # With its exit code from rank to rank.
        return type(self), (self.message, self.exit_code)


class MeshError(TesseraError):
    """There is no valid mesh (exit code 2)."""

    default_code = 2


class InputError(TesseraError):
    """An argument, the case, the model or a mesh file is wrong or cannot be read (exit code 64)."""

    default_code = 64


class UsageError(TesseraError):
    """A function was called where it cannot work: not by all ranks of its communicator, say."""


class InternalError(TesseraError):
    """A defect of the program; please report it (exit code 70)."""

    default_code = 70


class OutputError(TesseraError):
    """Something cannot be written: permission, disk full, folder in use or not empty (exit code 73)."""

    default_code = 73


class Interrupted(TesseraError):
    """A signal stopped the run; `resume=True` goes on with it (exit code 75)."""

    default_code = 75


class ProgramDied(TesseraError):
    """The program or one of its ranks was killed, or MPI could not start; the code is mpirun's own."""


class ProgramNotFound(TesseraError):
    """The program, or mpirun, is not where it is looked for."""


class DegradedWarning(UserWarning):
    """A valid mesh is there, but the run missed something that was wanted (exit code 3)."""


BY_EXIT_CODE = {
    error.default_code: error for error in (MeshError, InputError, InternalError, OutputError, Interrupted)
}

# SPDX-License-Identifier: BSD-3-Clause
"""Imports what only some functions need."""
import importlib
import sys
from typing import Any


def needed(module: str, package: str, what_for: str) -> Any:
    """Imports a module.

    Args:
        package: The Debian package that has it, or how else to get it.

    Raises:
        ImportError: It is not there; the message says what to install.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(
            f"{what_for} needs the Python module {module.split('.')[0]}: install {package}. "
            f"Debian's packages belong to /usr/bin/python3; this is {sys.executable} ({error})"
        ) from error


def vtk(module: str) -> Any:
    """A module of VTK; ParaView's pvpython has them as well."""
    return needed(f"vtkmodules.{module}", "python3-vtk9 (or run pvpython)", "to read or make VTK's grids, tessera")

# SPDX-License-Identifier: BSD-3-Clause
"""Tessera in Python: makes meshes with the program `tessera`, reads them, and hands them to solvers.

    import tessera

    mesh = tessera.mesh("part.step", size=0.05, parts=4, ranks=2)
    mesh.points, mesh.cells, mesh.materials
"""
from ._errors import (
    DegradedWarning,
    InputError,
    InternalError,
    Interrupted,
    MeshError,
    OutputError,
    ProgramDied,
    ProgramNotFound,
    TesseraError,
    UsageError,
)
from ._make import mesh
from ._mesh import Mesh, Names, RankLists
from ._program import find_program
from ._read import read
from ._version import __version__

__all__ = [
    "DegradedWarning",
    "InputError",
    "InternalError",
    "Interrupted",
    "Mesh",
    "MeshError",
    "Names",
    "OutputError",
    "ProgramDied",
    "ProgramNotFound",
    "RankLists",
    "TesseraError",
    "UsageError",
    "__version__",
    "find_program",
    "mesh",
    "read",
]

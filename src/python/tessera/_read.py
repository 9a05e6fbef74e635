# SPDX-License-Identifier: BSD-3-Clause
"""Reads a mesh, or each rank's share of it."""
from __future__ import annotations

import json
import os
import pathlib
from typing import Any, Optional, Union

from . import _share
from ._errors import InputError
from ._exchange import Comm, all_or_none, on_root, rank_of, size_of
from ._mesh import Mesh, Names
from ._pieces import TETS, TRIANGLES, piece_files, read_piece, share_of
from ._roll_call import RANK_TIMEOUT_S, roll_call

_INDEX = "mesh.pvtu"


def read(
    mesh: Union[str, os.PathLike],
    comm: Optional[Comm] = None,
    *,
    ghost_layers: int = 0,
    consecutive: bool = False,
    rank_timeout: float = RANK_TIMEOUT_S,
) -> Mesh:
    """Reads a mesh of Tessera: all of it, or with `comm` each rank its share. Collective.

    Ranks take the piece files in their order, each some that stand together. So a mesh that was made with
    `parts=P` keeps its parts on P ranks. If there are more ranks than files, some ranks have no tets.

    Args:
        mesh: An output folder, or a .pvtu or .vtu file with global ids.
        comm: A communicator of mpi4py.
        ghost_layers: Layers of other ranks' tets around the share: those with a vertex of it, and so on.
        consecutive: New point ids, so that those of the points that a rank owns are consecutive over the ranks,
            as DOLFINx and PETSc want them. Owned points come first: `points[:num_owned_points]` is the rank's
            block of coordinates.
        rank_timeout: How long this rank waits for the others of `comm` to call it too, seconds.

    Raises:
        InputError: On all ranks: a file is missing or damaged, has no ids, or does not fit the others.
        UsageError: On the ranks that have called it, if others have not in time.
        ImportError: VTK's modules, or mpi4py's, are missing.
    """
    roll_call(comm, "tessera.read()", rank_timeout)
    index, files, boundary, report = on_root(comm, lambda: _look_at(pathlib.Path(mesh)))
    rank, size = rank_of(comm), size_of(comm)

    def read_own() -> _share.Fields:
        tets = [read_piece(file, TETS) for file in share_of(files, rank, size)]
        triangles = [read_piece(file, TRIANGLES) for file in share_of(boundary, rank, size)]
        return _share.merged(tets, triangles, str(index))

    fields = all_or_none(comm, read_own)
    _share.add_owners(comm, fields)
    names, unit = _names(comm, fields.pop("texts"))
    homes = fields.pop("homes")
    if ghost_layers > 0 and size > 1:
        _share.add_ghosts(comm, homes, fields, ghost_layers)
    if consecutive:
        _share.number_consecutively(comm, fields)
    about = {"names": names, "length_unit": unit, "report": report}
    return Mesh(**fields, **about, folder=index.parent, file=index, comm=comm)


def _look_at(mesh: pathlib.Path) -> tuple[pathlib.Path, list[pathlib.Path], list[pathlib.Path], Any]:
    """The index, the files of tets and of triangles, and the report."""
    index = (mesh / _INDEX if mesh.is_dir() else mesh).resolve()
    boundary = index.parent / "boundary.pvtu"
    has_boundary = index.name == _INDEX and boundary.is_file()
    return index, piece_files(index), piece_files(boundary) if has_boundary else [], report_of(index.parent)


def report_of(folder: pathlib.Path) -> Optional[dict[str, Any]]:
    """What report.json in this folder says; None if there is none. Local."""
    file = folder / "report.json"
    if not file.is_file():
        return None
    try:
        return json.loads(file.read_text())
    except ValueError as error:
        raise InputError(f"{file}: {error}") from error


def _names(comm: Optional[Comm], texts: dict[str, list[str]]) -> tuple[Names, str]:
    """From the first rank that has texts: one without pieces has none."""
    everyone = [texts] if comm is None else comm.allgather(texts)
    known = next((one for one in everyone if one), {})
    unit = known.get("length_unit", [])
    return Names(known.get("material_names", []), known.get("patch_names", [])), unit[0] if unit else ""

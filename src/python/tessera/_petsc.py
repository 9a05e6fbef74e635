# SPDX-License-Identifier: BSD-3-Clause
"""A DMPlex of PETSc, in our partition."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._errors import InputError
from ._exchange import Comm, ask, ranges, send
from ._imports import needed
from ._mesh import Mesh
from ._share import rows_of

_DIMENSION = 3


def to_petsc(mesh: Mesh, comm: Optional[Comm]) -> Any:
    petsc = needed("petsc4py.PETSc", "python3-petsc4py", "to_petsc()")
    if mesh.order != 1:
        raise InputError("to_petsc() takes meshes of first order; make this one with output.order = 1")
    own = mesh.num_own_cells
    # Corners 0 and 1 changed over: PETSc's tets have their faces' normals the other way round than VTK's.
    cells = mesh.cells[:own, [1, 0, 2, 3]].astype(petsc.IntType)
    num_points = len(mesh.points) - mesh.num_ghost_points
    points = np.ascontiguousarray(mesh.points[:num_points], petsc.RealType)
    plex = petsc.DMPlex().createFromCellList(
        _DIMENSION, cells, points, interpolate=False, comm=_communicator(petsc, mesh, comm)
    )
    plex.setPointSF(_shared_vertices(petsc, plex, mesh, own))
    plex.interpolate()
    _label(plex, ("material", "Cell Sets"), np.arange(own), mesh.materials[:own])
    _label(plex, ("patch", "Face Sets"), *_tagged_faces(plex, mesh))
    return plex


def _communicator(petsc: Any, mesh: Mesh, comm: Optional[Comm]) -> Any:
    return mesh.comm or comm or petsc.COMM_SELF


def _shared_vertices(petsc: Any, plex: Any, mesh: Mesh, own: int) -> Any:
    """Which vertices other ranks own, and where these have them: vertices are numbered behind the cells."""
    rows = np.flatnonzero(mesh.owner[: len(mesh.points) - mesh.num_ghost_points] != _rank(mesh))
    owners = mesh.owner[rows].astype(np.int64)

    def points_of(ids: np.ndarray) -> np.ndarray:
        return own + rows_of(mesh.point_ids, ids, "a point whose owner does not have it")

    remote = ask(mesh.comm, owners, mesh.point_ids[rows], points_of)
    forest = petsc.SF().create(plex.getComm())
    pairs = np.stack([owners, remote], axis=1).astype(petsc.IntType)
    forest.setGraph(plex.getChart()[1], (own + rows).astype(petsc.IntType), pairs)
    return forest


def _rank(mesh: Mesh) -> int:
    return 0 if mesh.comm is None else mesh.comm.Get_rank()


def _tagged_faces(plex: Any, mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """The plex's face for each triangle, and its tag; also for triangles of other ranks that this rank has."""
    corners, tags = mesh.point_ids[mesh.triangles], mesh.patches + 1
    whom, row = _sharers_of_triangles(mesh)
    _, more_corners, more_tags = send(mesh.comm, whom, corners[row], tags[row])
    corners, tags = np.concatenate([corners, more_corners]), np.concatenate([tags, more_tags])
    rows = rows_of(mesh.point_ids, corners.ravel(), "a triangle without points").reshape(corners.shape)
    first_vertex = plex.getDepthStratum(0)[0]
    faces = np.array([_face(plex, *triangle) for triangle in (rows + first_vertex).tolist()], np.int64)
    return faces[faces >= 0], tags[faces >= 0]


def _sharers_of_triangles(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """(rank, triangle) of the other ranks that have all three points; not all of them have the face."""
    offsets, ranks = mesh.sharers.offsets, mesh.sharers.ranks.astype(np.int64)
    size = 1 if mesh.comm is None else mesh.comm.Get_size()
    known = np.repeat(np.arange(len(mesh.sharers)), np.diff(offsets)) * size + ranks
    first = mesh.triangles[:, 0]
    counts = np.diff(offsets)[first]
    rank, triangle = ranks[ranges(offsets[first], counts)], np.repeat(np.arange(len(first)), counts)
    for corner in (1, 2):
        both = np.isin(mesh.triangles[triangle, corner].astype(np.int64) * size + rank, known)
        rank, triangle = rank[both], triangle[both]
    return rank, triangle


def _face(plex: Any, a: int, b: int, c: int) -> int:
    """The face of three vertices; -1 if there is none."""
    edges = [plex.getJoin(pair) for pair in ((a, b), (b, c))]
    if not all(map(len, edges)):
        return -1
    faces = plex.getJoin([edge[0] for edge in edges])
    return faces[0] if len(faces) else -1


def _label(plex: Any, names: tuple[str, ...], points: np.ndarray, values: np.ndarray) -> None:
    petsc = needed("petsc4py.PETSc", "python3-petsc4py", "to_petsc()")
    for name in names:
        plex.createLabel(name)
        label = plex.getLabel(name)
        for value in np.unique(values):
            of_value = np.unique(points[values == value]).astype(petsc.IntType)
            label.setStratumIS(int(value), petsc.IS().createGeneral(of_value, petsc.COMM_SELF))

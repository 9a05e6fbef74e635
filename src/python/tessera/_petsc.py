# SPDX-License-Identifier: BSD-3-Clause
"""A DMPlex of PETSc, in our partition."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._errors import InputError
from ._exchange import Comm, ask, send
from ._faces import ranks_with_points
from ._imports import needed
from ._mesh import Mesh
from ._share import rows_of

_DIMENSION = 3
# Where the face opposite to a corner, in VTK's order, stands in the cone of an interpolated tet.
_PLACE_OF_FACE = np.array([2, 3, 1, 0])


def to_petsc(mesh: Mesh, comm: Optional[Comm]) -> Any:
    petsc = needed("petsc4py.PETSc", "python3-petsc4py", "to_petsc()")
    if mesh.order != 1:
        raise InputError("to_petsc() takes meshes of first order; make this one with output.order = 1")
    own, num_points = mesh.num_own_cells, len(mesh.points) - mesh.num_ghost_points
    # Corners 0 and 1 changed over: PETSc's tets have their faces' normals the other way round than VTK's.
    cells = mesh.cells[:own, [1, 0, 2, 3]]
    # Not createFromCellList(), which takes the cells of rank 0 alone.
    plex = petsc.DMPlex().create(_communicator(petsc, mesh, comm))
    plex.setDimension(_DIMENSION)
    _set_cells(petsc, plex, cells, num_points)
    plex.setPointSF(_shared_vertices(petsc, plex, mesh, own))
    _set_coordinates(petsc, plex, mesh.points[:num_points], own)
    plex.interpolate()
    _label(plex, ("material", "Cell Sets"), np.arange(own), mesh.materials[:own])
    _label(plex, ("patch", "Face Sets"), *_tagged_faces(plex, mesh, own))
    return plex


def _set_cells(petsc: Any, plex: Any, cells: np.ndarray, num_points: int) -> None:
    """Cells are the plex's first points; vertices follow."""
    own = len(cells)
    plex.setChart(0, own + num_points)
    for cell in range(own):
        plex.setConeSize(cell, cells.shape[1])
    plex.setUp()
    for cell, vertices in enumerate((cells + own).astype(petsc.IntType)):
        plex.setCone(cell, vertices)
    plex.symmetrize()
    plex.stratify()


def _set_coordinates(petsc: Any, plex: Any, points: np.ndarray, first_vertex: int) -> None:
    section = petsc.Section().create(petsc.COMM_SELF)
    section.setNumFields(1)
    section.setFieldComponents(0, _DIMENSION)
    section.setChart(first_vertex, first_vertex + len(points))
    for vertex in range(first_vertex, first_vertex + len(points)):
        section.setDof(vertex, _DIMENSION)
        section.setFieldDof(vertex, 0, _DIMENSION)
    section.setUp()
    plex.setCoordinateDim(_DIMENSION)
    plex.getCoordinateDM().setSection(section)
    values = petsc.Vec().createSeq(points.size, bsize=_DIMENSION, comm=petsc.COMM_SELF)
    values.setArray(points.ravel())
    values.setName("coordinates")
    plex.setCoordinatesLocal(values)


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


def _tagged_faces(plex: Any, mesh: Mesh, own: int) -> tuple[np.ndarray, np.ndarray]:
    """The plex's face for each triangle, and its tag; also for triangles of other ranks that this rank has."""
    corners, tags = mesh.point_ids[mesh.triangles], mesh.patches + 1
    whom, row = ranks_with_points(mesh, mesh.triangles)
    _, more_corners, more_tags = send(mesh.comm, whom, corners[row], tags[row])
    corners, tags = np.concatenate([corners, more_corners]), np.concatenate([tags, more_tags])
    rows = rows_of(mesh.point_ids, corners.ravel(), "a triangle without points").reshape(corners.shape)
    triangle, cell, opposite = _cells_behind(mesh.cells[:own], rows)
    place = _PLACE_OF_FACE[opposite]
    faces = [plex.getCone(c)[p] for c, p in zip(cell.tolist(), place.tolist())]
    return np.array(faces, np.int64), tags[triangle]


def _cells_behind(cells: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(triangle, cell, corner opposite to it) for one cell of each triangle that is a face of a cell."""
    near = np.flatnonzero(np.isin(cells, triangles).sum(axis=1) >= 3)
    faces = np.concatenate([np.delete(cells[near], corner, axis=1) for corner in range(4)])
    both = np.sort(np.concatenate([faces, triangles]), axis=1)
    _, first, kind = np.unique(both, axis=0, return_index=True, return_inverse=True)
    face = first[kind.ravel()[len(faces) :]]  # The first one that is alike; a cell's, if there is any.
    triangle = np.flatnonzero(face < len(faces))
    return triangle, near[face[triangle] % max(len(near), 1)], face[triangle] // max(len(near), 1)


def _label(plex: Any, names: tuple[str, ...], points: np.ndarray, values: np.ndarray) -> None:
    petsc = needed("petsc4py.PETSc", "python3-petsc4py", "to_petsc()")
    for name in names:
        plex.createLabel(name)
        label = plex.getLabel(name)
        for value in np.unique(values):
            of_value = np.unique(points[values == value]).astype(petsc.IntType)
            label.setStratumIS(int(value), petsc.IS().createGeneral(of_value, petsc.COMM_SELF))

# SPDX-License-Identifier: BSD-3-Clause
"""Faces that two ranks have."""
from __future__ import annotations

import numpy as np

from ._exchange import ranges, send, size_of
from ._mesh import Mesh


def ranks_with_points(mesh: Mesh, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(rank, row of `faces`) for each other rank that has all points of a face; not all of them have the face.
    Local.

    Args:
        faces: Rows of points, shape (num_faces, 3).
    """
    offsets, ranks = mesh.sharers.offsets, mesh.sharers.ranks.astype(np.int64)
    known = np.repeat(np.arange(len(mesh.sharers)), np.diff(offsets)) * size_of(mesh.comm) + ranks
    first = faces[:, 0]
    counts = np.diff(offsets)[first]
    rank, face = ranks[ranges(offsets[first], counts)], np.repeat(np.arange(len(first)), counts)
    for corner in (1, 2):
        both = np.isin(faces[face, corner].astype(np.int64) * size_of(mesh.comm) + rank, known)
        rank, face = rank[both], face[both]
    return rank, face


def neighbours_of_cells(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """(own cell, rank) for each other rank that has a tet behind a face of the cell; ascending. Collective."""
    cell, corners = _faces_at_seams(mesh)
    rank, face = ranks_with_points(mesh, corners)
    ids = np.sort(mesh.point_ids[corners], axis=1)[face]
    source, theirs = send(mesh.comm, rank, ids)
    # The other rank has the face if it asks the same of this one.
    mine = np.column_stack([rank, ids])
    both = np.concatenate([np.column_stack([source, theirs]), mine])
    _, kind = np.unique(both, axis=0, return_inverse=True)
    kind = kind.ravel()
    shared = np.isin(kind[len(source) :], kind[: len(source)])
    pairs = np.unique(np.column_stack([cell[face[shared]], rank[shared]]), axis=0)
    return pairs[:, 0], pairs[:, 1]


def _faces_at_seams(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """(own cell, its three corners) of the faces that are on one own tet only and may be another rank's too."""
    is_shared = np.diff(mesh.sharers.offsets) > 0
    cells = mesh.cells[: mesh.num_own_cells, :4]
    near = np.flatnonzero(is_shared[cells].sum(axis=1) >= 3)
    faces = np.concatenate([np.delete(cells[near], corner, axis=1) for corner in range(4)])
    cell = np.tile(near, 4)
    seam = is_shared[faces].all(axis=1)
    faces, cell = faces[seam], cell[seam]
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    single = first[count == 1]
    return cell[single], faces[single]

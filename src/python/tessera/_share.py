# SPDX-License-Identifier: BSD-3-Clause
"""A rank's share of a mesh: put together from its pieces, with what it shares with other ranks."""
from __future__ import annotations

import dataclasses
from typing import Any, Optional

import numpy as np

from ._errors import InputError
from ._exchange import Comm, ask, ranges, rank_of, send, size_of, total
from ._mesh import RankLists
from ._pieces import Piece

Fields = dict[str, Any]  # What Mesh has, by name.


def rows_of(ids: np.ndarray, wanted: np.ndarray, what: str) -> np.ndarray:
    """Where in `ids`, in any order, the wanted ones stand. Local."""
    order = np.argsort(ids, kind="stable")
    at = np.searchsorted(ids, wanted, sorter=order)
    rows = order[np.minimum(at, len(ids) - 1)] if len(ids) else np.zeros(len(wanted), np.int64)
    if len(wanted) and (len(ids) == 0 or np.any(ids[rows] != wanted)):
        raise InputError(what)
    return rows


def merged(tets: list[Piece], triangles: list[Piece], name: str) -> Fields:
    """One share of pieces; points that several of them have stand once, ascending by id. Local."""
    tets = [piece for piece in tets if len(piece.cells)]
    triangles = [piece for piece in triangles if len(piece.cells)]
    ids = _joined([piece.point_ids for piece in tets], (0,), np.int64)
    xyz = _joined([piece.points for piece in tets], (0, 3), np.float64)
    point_ids, first, row = np.unique(ids, return_index=True, return_inverse=True)
    points = xyz[first]
    if not np.array_equal(points[row], xyz):
        raise InputError(f"{name}: points of one id have different coordinates; `tessera check` says where")
    starts = np.cumsum([0, *(len(piece.point_ids) for piece in tets)])
    cells = [row[start + piece.cells] for start, piece in zip(starts, tets)]
    fields = {
        "points": points,
        "point_ids": point_ids,
        "cells": _joined(cells, (0, 4), np.int32),
        "cell_ids": _array(tets, "id", np.int64),
        "materials": _array(tets, "attribute", np.int32, 1),
        "subdomains": _array(tets, "subdomain", np.int32, 0),
        "texts": tets[0].texts if tets else {},
    }
    _add_triangles(fields, triangles, name)
    return fields


def _joined(arrays: list[np.ndarray], empty: tuple[int, ...], kind: Any) -> np.ndarray:
    return np.concatenate(arrays).astype(kind, copy=False) if arrays else np.empty(empty, kind)


def _array(pieces: list[Piece], name: str, kind: Any, default: Optional[int] = None) -> np.ndarray:
    """An array of all pieces' cells; of meshes of other tools some may be missing."""
    values = []
    for piece in pieces:
        if name not in piece.cell_arrays and default is None:
            raise InputError(f"the cells have no array {name}")
        values.append(piece.cell_arrays.get(name, np.full(len(piece.cells), default or 0)))
    return _joined(values, (0,), kind)


def _add_triangles(fields: Fields, pieces: list[Piece], name: str) -> None:
    wrong = f"{name}: boundary.pvtu does not fit it; `tessera check` says where"
    corners = _joined([piece.point_ids[piece.cells] for piece in pieces], (0, 3), np.int64)
    rows = rows_of(fields["point_ids"], corners.ravel(), wrong)
    fields["triangles"] = rows.reshape(corners.shape).astype(np.int32)
    fields["triangle_ids"] = _array(pieces, "id", np.int64)
    behind = _array(pieces, "tet", np.int64)
    fields["triangle_cells"] = rows_of(fields["cell_ids"], behind, wrong).astype(np.int32)
    fields["patches"] = _array(pieces, "patch", np.int32)


@dataclasses.dataclass
class Homes:
    """Who has tets of its own on which point: the ids of points are dealt out in blocks, and each rank knows it
    of those in its block."""

    num_ids: int  # Of the whole mesh.
    ids: np.ndarray  # Shape (num_entries): ascending.
    ranks: np.ndarray  # Shape (num_entries): ascending for one id.

    def home(self, ids: np.ndarray, size: int) -> np.ndarray:
        return ids * size // max(self.num_ids, 1)

    def entries(self, ids: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """First entry and number of entries of each id."""
        first = np.searchsorted(self.ids, ids)
        return first, np.searchsorted(self.ids, ids, side="right") - first


def add_owners(comm: Optional[Comm], fields: Fields) -> None:
    """Adds owners, sharers and the figures of the whole mesh; "homes" for add_ghosts(). Collective."""
    ids = fields["point_ids"]
    rank, size = rank_of(comm), size_of(comm)
    largest = int(ids[-1]) if len(ids) else -1
    num_ids = 1 + (largest if comm is None else max(comm.allgather(largest)))
    homes = Homes(num_ids, ids, np.zeros(len(ids), np.int64))
    if size > 1:
        source, received = send(comm, homes.home(ids, size), ids)
        order = np.lexsort((source, received))
        homes = Homes(num_ids, received[order], source[order])
    fields["homes"] = homes
    shared, sharer = _pairs(comm, homes) if size > 1 else (np.empty(0, np.int64), np.empty(0, np.int64))
    row = np.searchsorted(ids, shared)
    fields["owner"] = np.full(len(ids), rank, np.int32)
    np.minimum.at(fields["owner"], row, sharer.astype(np.int32))
    offsets = np.searchsorted(row, np.arange(len(ids) + 1))
    fields["sharers"] = RankLists(offsets, sharer.astype(np.int32))
    fields["cell_ranks"] = np.full(len(fields["cells"]), rank, np.int32)
    fields["num_ghost_cells"] = fields["num_ghost_points"] = 0
    fields["num_global_points"] = total(comm, int(np.count_nonzero(fields["owner"] == rank)))
    fields["num_global_cells"] = total(comm, len(fields["cells"]))
    fields["num_global_triangles"] = total(comm, len(fields["triangles"]))


def _pairs(comm: Optional[Comm], homes: Homes) -> tuple[np.ndarray, np.ndarray]:
    """(id, other rank) of each point that this rank shares, ascending. Collective."""
    first, count = homes.entries(homes.ids)
    holder = np.repeat(np.arange(len(homes.ids)), count)
    other = ranges(first, count)
    differs = homes.ranks[holder] != homes.ranks[other]
    holder, other = holder[differs], other[differs]
    _, ids, ranks = send(comm, homes.ranks[holder], homes.ids[holder], homes.ranks[other])
    order = np.lexsort((ranks, ids))
    return ids[order], ranks[order]


def add_ghosts(comm: Optional[Comm], homes: Homes, fields: Fields, layers: int) -> None:
    """Adds layers of other ranks' tets. Collective."""
    num_points, num_cells = len(fields["points"]), len(fields["cells"])
    own_cells = fields["cells"]
    for _ in range(layers):
        _add_layer(comm, homes, fields, own_cells)
    size = size_of(comm)
    ghosts = fields["point_ids"][num_points:]
    lowest = ask(comm, homes.home(ghosts, size), ghosts, lambda ids: homes.ranks[homes.entries(ids)[0]])
    fields["owner"] = np.append(fields["owner"], lowest.astype(np.int32))
    offsets = fields["sharers"].offsets
    fields["sharers"].offsets = np.append(offsets, np.full(len(ghosts), offsets[-1]))
    fields["num_ghost_points"] = len(ghosts)
    fields["num_ghost_cells"] = len(fields["cells"]) - num_cells


def _add_layer(comm: Optional[Comm], homes: Homes, fields: Fields, own_cells: np.ndarray) -> None:
    """Adds the tets of other ranks that have a point of the share as it is."""
    source, cell = _wanted(comm, homes, fields, own_cells)
    corners = fields["cells"][cell]
    keys = ("cell_ids", "materials", "subdomains", "cell_ranks")
    _, ids, xyz, *values = send(
        comm, source, fields["point_ids"][corners], fields["points"][corners], *(fields[k][cell] for k in keys)
    )
    new = np.flatnonzero(~np.isin(values[0], fields["cell_ids"]))
    new = new[np.argsort(values[0][new], kind="stable")]
    _add_points(fields, ids[new].ravel(), xyz[new].reshape(-1, 3))
    rows = rows_of(fields["point_ids"], ids[new].ravel(), "ghosts without points")
    fields["cells"] = np.concatenate([fields["cells"], rows.reshape(-1, corners.shape[1]).astype(np.int32)])
    for key, value in zip(keys, values):
        fields[key] = np.append(fields[key], value[new])


def _wanted(
    comm: Optional[Comm], homes: Homes, fields: Fields, own_cells: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Which rank wants which own cell, in rows: asked for by ids of points, through the points' homes."""
    region = fields["point_ids"]
    asker, ids = send(comm, homes.home(region, size_of(comm)), region)
    first, count = homes.entries(ids)
    holder = homes.ranks[ranges(first, count)]
    asker, ids = np.repeat(asker, count), np.repeat(ids, count)
    other = asker != holder
    _, asker, ids = send(comm, holder[other], asker[other], ids[other])
    who, what = [], []
    for rank in np.unique(asker):
        touched = np.isin(fields["point_ids"], ids[asker == rank])
        cells = np.flatnonzero(touched[own_cells].any(axis=1))
        what.append(cells)
        who.append(np.full(len(cells), rank))
    return _joined(who, (0,), np.int64), _joined(what, (0,), np.int64)


def _add_points(fields: Fields, ids: np.ndarray, xyz: np.ndarray) -> None:
    new, first = np.unique(ids, return_index=True)
    missing = ~np.isin(new, fields["point_ids"])
    fields["point_ids"] = np.append(fields["point_ids"], new[missing])
    fields["points"] = np.concatenate([fields["points"], xyz[first[missing]]])


def consecutive_numbers(comm: Optional[Comm], point_ids: np.ndarray, owner: np.ndarray) -> np.ndarray:
    """A new number for each point: those that a rank owns follow each other, in the order of their rows, and
    those of the rank before. Collective."""
    mine = np.flatnonzero(owner == rank_of(comm))
    first = 0 if comm is None else comm.scan(len(mine)) - len(mine)
    numbers = np.full(len(point_ids), -1, np.int64)
    numbers[mine] = first + np.arange(len(mine))
    others = np.flatnonzero(numbers < 0)

    def answer(ids: np.ndarray) -> np.ndarray:
        return numbers[rows_of(point_ids, ids, "a point whose owner does not have it")]

    numbers[others] = ask(comm, owner[others], point_ids[others], answer)
    return numbers


def number_consecutively(comm: Optional[Comm], fields: Fields) -> None:
    """Gives points new ids and puts the owned ones first. Collective."""
    owner = fields["owner"]
    fields["point_ids"] = consecutive_numbers(comm, fields["point_ids"], owner)
    order = np.argsort(owner != rank_of(comm), kind="stable")  # Ghosts stay last: none is owned.
    new_row = np.empty(len(order), np.int32)
    new_row[order] = np.arange(len(order))
    for key in ("points", "point_ids", "owner"):
        fields[key] = fields[key][order]
    for key in ("cells", "triangles"):
        fields[key] = new_row[fields[key]]
    lists = fields["sharers"]
    counts = np.diff(lists.offsets)
    ranks = lists.ranks[ranges(lists.offsets[:-1][order], counts[order])]
    fields["sharers"] = RankLists(np.concatenate([[0], np.cumsum(counts[order])]), ranks)

# SPDX-License-Identifier: BSD-3-Clause
"""A mesh of DOLFINx 0.5, in our partition."""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Optional

import numpy as np

from ._exchange import Comm, ask, rank_of
from ._faces import neighbours_of_cells
from ._imports import needed
from ._mesh import Mesh
from ._share import consecutive_numbers


class DolfinxMesh(NamedTuple):
    """What `Mesh.to_dolfinx()` gives."""

    mesh: Any  #: dolfinx.mesh.Mesh.
    cell_tags: Any  #: dolfinx.mesh.MeshTags of cells: materials.
    facet_tags: Any  #: dolfinx.mesh.MeshTags of facets: patch + 1.


def to_dolfinx(mesh: Mesh, comm: Optional[Comm], ghosts: bool) -> DolfinxMesh:
    dolfinx = needed("dolfinx.mesh", "python3-dolfinx", "to_dolfinx()")
    mpi = needed("mpi4py.MPI", "python3-mpi4py", "to_dolfinx()")
    num_points = len(mesh.points) - mesh.num_ghost_points
    owner = mesh.owner[:num_points]
    numbers = consecutive_numbers(mesh.comm, mesh.point_ids[:num_points], owner)
    grid = dolfinx.create_mesh(
        mesh.comm or comm or mpi.COMM_SELF,
        _in_order_of_dolfinx(dolfinx.CellType.tetrahedron, numbers[mesh.cells[: mesh.num_own_cells]]),
        mesh.points[:num_points][owner == rank_of(mesh.comm)],
        _domain(mesh.order),
        dolfinx.GhostMode.shared_facet if ghosts else dolfinx.GhostMode.none,
        _partitioner(mesh),
    )
    return DolfinxMesh(grid, _cell_tags(dolfinx, mesh, grid), _facet_tags(dolfinx, grid, mesh, numbers))


def _domain(order: int) -> Any:
    ufl = needed("ufl", "python3-ufl", "to_dolfinx()")
    return ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), order))


def _partitioner(mesh: Mesh) -> Callable[..., Any]:
    """Every cell stays on its rank. Copies go to the ranks behind its faces: DOLFINx finds by them which points
    ranks share, and then drops them if it is to have no ghosts."""
    cpp = needed("dolfinx.cpp", "python3-dolfinx", "to_dolfinx()")
    own = mesh.num_own_cells
    cell, neighbour = neighbours_of_cells(mesh)
    cells = np.concatenate([np.arange(own), cell])
    ranks = np.concatenate([np.full(own, rank_of(mesh.comm)), neighbour])
    order = np.argsort(cells, kind="stable")  # The own rank first: it becomes the owner.
    offsets = np.searchsorted(cells[order], np.arange(own + 1))

    def destinations(*_: Any) -> Any:
        return cpp.graph.AdjacencyList_int32(ranks[order].astype(np.int32), offsets.astype(np.int32))

    return destinations


def _in_order_of_dolfinx(kind: Any, nodes: np.ndarray) -> np.ndarray:
    """Nodes of cells, shape (num_cells, nodes of a cell), from VTK's order."""
    cpp = needed("dolfinx.cpp", "python3-dolfinx", "to_dolfinx()")
    return np.ascontiguousarray(nodes[:, cpp.io.perm_vtk(kind, nodes.shape[1])])


def _cell_tags(dolfinx: Any, mesh: Mesh, grid: Any) -> Any:
    """Cells are in an order of DOLFINx's own; it knows which were given in which place, also of ghosts."""
    own = mesh.num_own_cells
    ends = np.cumsum([own] if mesh.comm is None else mesh.comm.allgather(own))
    first = ends[rank_of(mesh.comm)] - own
    given = np.asarray(grid.topology.original_cell_index, np.int64)
    materials = ask(
        mesh.comm, np.searchsorted(ends, given, side="right"), given, lambda cells: mesh.materials[cells - first]
    )
    return dolfinx.meshtags(grid, 3, np.arange(len(given), dtype=np.int32), materials)


def _facet_tags(dolfinx: Any, grid: Any, mesh: Mesh, numbers: np.ndarray) -> Any:
    """By their points, so that all ranks which have a facet tag it."""
    cpp = needed("dolfinx.cpp", "python3-dolfinx", "to_dolfinx()")
    grid.topology.create_connectivity(2, 0)
    grid.topology.create_connectivity(2, 3)
    nodes = _in_order_of_dolfinx(dolfinx.CellType.triangle, numbers[mesh.triangles])
    corners, tags = cpp.io.distribute_entity_data(grid._mesh, 2, nodes, (mesh.patches + 1).astype(np.int32))
    facets = dolfinx.meshtags_from_entities(grid, 2, cpp.graph.AdjacencyList_int32(corners), tags)
    facets.name = "patch"
    return facets

# SPDX-License-Identifier: BSD-3-Clause
"""A mesh of DOLFINx 0.5, in our partition."""
from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np

from ._exchange import Comm
from ._imports import needed
from ._mesh import Mesh
from ._share import consecutive_numbers


class DolfinxMesh(NamedTuple):
    """What `Mesh.to_dolfinx()` gives."""

    mesh: Any  #: dolfinx.mesh.Mesh.
    cell_tags: Any  #: dolfinx.mesh.MeshTags of cells: materials.
    facet_tags: Any  #: dolfinx.mesh.MeshTags of facets: patch + 1.


def to_dolfinx(mesh: Mesh, comm: Optional[Comm]) -> DolfinxMesh:
    dolfinx = needed("dolfinx.mesh", "python3-dolfinx", "to_dolfinx()")
    mpi = needed("mpi4py.MPI", "python3-mpi4py", "to_dolfinx()")
    own = mesh.num_own_cells
    num_points = len(mesh.points) - mesh.num_ghost_points
    numbers = consecutive_numbers(mesh.comm, mesh.point_ids[:num_points], mesh.owner[:num_points])
    coordinates = mesh.points[:num_points][mesh.owner[:num_points] == _rank(mesh)]
    grid = dolfinx.create_mesh(
        mesh.comm or comm or mpi.COMM_SELF,
        _in_order_of_dolfinx(dolfinx.CellType.tetrahedron, numbers[mesh.cells[:own]]),
        coordinates,
        _domain(mesh.order),
        dolfinx.GhostMode.none,
        _keep,
    )
    return DolfinxMesh(grid, _cell_tags(dolfinx, mesh, grid), _facet_tags(dolfinx, grid, mesh, numbers))


def _rank(mesh: Mesh) -> int:
    return 0 if mesh.comm is None else mesh.comm.Get_rank()


def _domain(order: int) -> Any:
    ufl = needed("ufl", "python3-ufl", "to_dolfinx()")
    return ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), order))


def _keep(comm: Any, num_ranks: int, dimension: int, cells: Any, ghost_mode: Any) -> Any:
    """A partitioner: every cell stays on its rank."""
    cpp = needed("dolfinx.cpp", "python3-dolfinx", "to_dolfinx()")
    here = np.full((cells.num_nodes, 1), _mpi_rank(comm), np.int32)
    return cpp.graph.AdjacencyList_int32(here)


def _mpi_rank(comm: Any) -> int:
    return comm.Get_rank()


def _in_order_of_dolfinx(kind: Any, nodes: np.ndarray) -> np.ndarray:
    """Nodes of cells, shape (num_cells, nodes of a cell), from VTK's order."""
    cpp = needed("dolfinx.cpp", "python3-dolfinx", "to_dolfinx()")
    return np.ascontiguousarray(nodes[:, cpp.io.perm_vtk(kind, nodes.shape[1])])


def _cell_tags(dolfinx: Any, mesh: Mesh, grid: Any) -> Any:
    """Cells are in an order of DOLFINx's own; it knows which were given in which place."""
    own = mesh.num_own_cells
    first = 0 if mesh.comm is None else mesh.comm.scan(own) - own
    row = np.asarray(grid.topology.original_cell_index) - first
    return dolfinx.meshtags(grid, 3, np.arange(own, dtype=np.int32), mesh.materials[:own][row])


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

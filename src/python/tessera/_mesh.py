# SPDX-License-Identifier: BSD-3-Clause
"""The mesh, or one rank's share of it, as arrays."""
from __future__ import annotations

import html
import os
import pathlib
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _picture
from ._exchange import Comm, size_of

if TYPE_CHECKING:
    from ._dolfinx import DolfinxMesh


class Names(NamedTuple):
    """Names that the model or the case gives."""

    materials: list[str]  #: Of the material m: materials[m - 1].
    patches: list[str]  #: Of the patch p: patches[p]. Several patches may have one name.


class RankLists:
    """Lists of ranks, one for each point: `lists[i]` is that of point i, ascending.

    Attributes:
        offsets: Shape (num_points + 1): where each list begins in `ranks`.
        ranks: All lists, one behind the other.
    """

    def __init__(self, offsets: NDArray[np.int64], ranks: NDArray[np.int32]):
        self.offsets = offsets
        self.ranks = ranks

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, i: int) -> NDArray[np.int32]:
        if not -len(self) <= i < len(self):
            raise IndexError(i)
        i %= len(self)
        return self.ranks[self.offsets[i] : self.offsets[i + 1]]


class Mesh:
    """A tet mesh, or one rank's share of it. `mesh()` and `read()` make it.

    Rows of all arrays are local; ids are those of the whole mesh, dense from 0. A point on a seam stands on
    every rank that has a tet on it, under the same id. Ghosts, the copies of other ranks' tets and the points
    that only these have, come last.

    The arrays of what `mesh()` gives are read from its folder when one of them is first used.
    """

    #: Shape (num_points, 3), in `length_unit`.
    points: NDArray[np.float64]
    #: Shape (num_points).
    point_ids: NDArray[np.int64]
    #: Shape (num_cells, 4): rows of points, positive in VTK's order. (num_cells, 10) of second order.
    cells: NDArray[np.int32]
    #: Shape (num_cells).
    cell_ids: NDArray[np.int64]
    #: Shape (num_cells): names.materials[m - 1].
    materials: NDArray[np.int32]
    #: Shape (num_cells): the subdomain, or the piece, that the tet is in.
    subdomains: NDArray[np.int32]
    #: Shape (num_cells): the rank that has the tet as its own.
    cell_ranks: NDArray[np.int32]
    #: Shape (num_triangles, 3): rows of points; on the geometry, also between materials; seen from outside of
    #: their tet. (num_triangles, 6) of second order.
    triangles: NDArray[np.int32]
    #: Shape (num_triangles).
    triangle_ids: NDArray[np.int64]
    #: Shape (num_triangles): row of the tet behind.
    triangle_cells: NDArray[np.int32]
    #: Shape (num_triangles): names.patches[p].
    patches: NDArray[np.int32]
    names: Names
    #: Shape (num_points): the lowest rank that has a tet of its own on the point.
    owner: NDArray[np.int32]
    #: The other ranks that have tets of their own on the point. Of ghost points empty.
    sharers: RankLists
    #: The last ones of the cells and points.
    num_ghost_cells: int
    num_ghost_points: int
    #: Of the whole mesh, each point and tet once.
    num_global_points: int
    num_global_cells: int
    num_global_triangles: int
    #: E.g. "mm"; empty if nobody knows it.
    length_unit: str
    #: What report.json says; None without that file.
    report: Optional[dict[str, Any]]
    #: The output folder, or the folder of the file that was read.
    folder: pathlib.Path
    #: The .pvtu or .vtu file.
    file: pathlib.Path
    #: The communicator that the mesh is spread over; None if all of it is here.
    comm: Optional[Comm]

    def __init__(self, load: Optional[Callable[[], dict[str, Any]]] = None, **fields: Any):
        self.__dict__.update(fields)
        self._load = load

    def __getattr__(self, name: str) -> Any:
        # Only of what is not there yet.
        if name in Mesh.__annotations__ and self.__dict__.get("_load"):
            fields = self._load()
            self._load = None
            self.__dict__.update(fields)
            return getattr(self, name)
        raise AttributeError(f"a mesh has no attribute {name!r}")

    def fields(self) -> dict[str, Any]:
        """The arrays and figures by name, without copies. Local."""
        return {name: getattr(self, name) for name in Mesh.__annotations__}

    @property
    def order(self) -> int:
        """1, or 2 if tets have ten points. Local."""
        return 1 if self.cells.shape[1] == 4 else 2

    @property
    def num_owned_points(self) -> int:
        """Points that this rank owns. Local."""
        return int(np.count_nonzero(self.owner == (0 if self.comm is None else self.comm.Get_rank())))

    @property
    def num_own_cells(self) -> int:
        """Cells without ghosts. Local."""
        return len(self.cells) - self.num_ghost_cells

    def material_tags(self, name: str) -> list[int]:
        """Values of `materials`, of cell tags and of the label "material" that have this name. Local."""
        return _with_name(self.names.materials, name, "material")

    def patch_tags(self, name: str) -> list[int]:
        """Facet tags of DOLFINx and values of PETSc's label "patch" that have this name: patch + 1, because
        solvers' files and labels want tags from 1. Local."""
        return _with_name(self.names.patches, name, "patch")

    def over(self, comm: Optional[Comm]) -> Mesh:
        """This mesh spread over a communicator: itself if it is already, else read anew. Collective.

        Args:
            comm: None: over the communicator that it is already spread over.
        """
        if comm is None or size_of(comm) == size_of(self.comm):
            return self
        from ._read import read

        return read(self.file, comm)

    def to_vtk(self, boundary: bool = False) -> Any:
        """A vtkUnstructuredGrid of the cells, or of the triangles, with the arrays of the files. Local."""
        from . import _convert

        return _convert.to_vtk(self, boundary)

    def to_pyvista(self, boundary: bool = False) -> Any:
        """The same for PyVista. Local."""
        from . import _convert

        return _convert.to_pyvista(self, boundary)

    def to_meshio(self, *, gmsh: bool = False) -> Any:
        """A meshio.Mesh of cells and triangles. Local.

        Args:
            gmsh: False: `cell_data` has "material" (0 of triangles) and "patch" (-1 of cells). True: it has the
                tags that Gmsh's format 2.2 wants, and `field_data` their names, so names survive there.
        """
        from . import _convert

        return _convert.to_meshio(self, gmsh)

    def to_dolfinx(self, comm: Optional[Comm] = None, *, ghosts: bool = False) -> DolfinxMesh:
        """The mesh for DOLFINx, in our partition: each rank keeps its tets. Collective.

        Args:
            comm: Default: that of the mesh, else MPI.COMM_SELF. The mesh is read anew if it is not spread over it.
            ghosts: Also copies of other ranks' tets behind the own tets' faces, for integrals over inner facets.

        Returns:
            (mesh, cell_tags, facet_tags): tags of cells are materials; tags of facets are patch + 1, see
            `patch_tags()`.
        """
        from . import _dolfinx

        return _dolfinx.to_dolfinx(self.over(comm), comm, ghosts)

    def to_petsc(self, comm: Optional[Comm] = None) -> Any:
        """A PETSc.DMPlex, interpolated, in our partition: each rank keeps its tets. Collective.

        The labels "material" and "Cell Sets" have the materials of cells, "patch" and "Face Sets" have
        patch + 1 of faces, see `patch_tags()`. Only of first order.

        Args:
            comm: As of `to_dolfinx()`.
        """
        from . import _petsc

        return _petsc.to_petsc(self.over(comm), comm)

    def picture(self, width: int = 800, height: int = 500, color: str = "patch") -> bytes:
        """A picture of the surface, as a PNG; it needs no display. Local: of this rank's share.

        Args:
            width, height: Pixels.
            color: "patch", "material" or "subdomain".
        """
        return _picture.picture(self, (width, height), color)

    def show(self, file: Union[str, os.PathLike, None] = None, *, height: int = 720) -> Optional[pathlib.Path]:
        """Shows the surface to turn and to point at: faces by click, a cut, colours, the worst tets. Local.

        The program makes a page of the files of the whole mesh, which need `boundary.pvtu`. In a notebook it is
        shown in a frame. Elsewhere it becomes a file, and a line says which.

        Args:
            file: Write the page there, in a notebook as well. Default: `view.html` in the working directory.
            height: Of the frame, pixels.

        Returns:
            The file; None in a notebook.

        Raises:
            TesseraError: The program cannot make the page.
        """
        from . import _view

        return _view.show(self, None if file is None else pathlib.Path(file), height)

    def __repr__(self) -> str:
        if self.__dict__.get("_load"):
            return f"<tessera.Mesh in {self.folder}>"
        return f"<tessera.Mesh: {self._summary()}>"

    def _summary(self) -> str:
        unit = f", in {self.length_unit}" if self.length_unit else ""
        where = "" if self.comm is None else f" on rank {self.comm.Get_rank()} of {self.comm.Get_size()}"
        return (
            f"{len(self.cells)} tets, {len(self.points)} points, {len(self.names.materials)} materials, "
            f"{len(self.names.patches)} patches{unit}{where}"
        )

    def _repr_png_(self) -> Optional[bytes]:
        try:
            return self.picture()
        except Exception:  # A notebook then shows the text.
            return None

    def _repr_html_(self) -> Optional[str]:
        try:
            image = _picture.as_data_url(self.picture())
            return f'<img src="{image}" alt="the mesh"><br>{html.escape(self._summary())}'
        except Exception:  # As above.
            return None


def _with_name(names: list[str], name: str, what: str) -> list[int]:
    tags = [i for i, one in enumerate(names, 1) if one == name]
    if not tags:
        raise KeyError(f"no {what} has the name {name!r}; there are: {', '.join(sorted(set(names)))}")
    return tags

# SPDX-License-Identifier: BSD-3-Clause
"""The mesh in the data structures of other Python packages."""
from __future__ import annotations

from typing import Any

import numpy as np

from ._imports import needed, vtk
from ._mesh import Mesh

# VTK's numbers and meshio's names of cells, by their number of points.
_VTK_TYPES = {4: 10, 10: 24, 3: 5, 6: 22}
_MESHIO_TYPES = {4: "tetra", 10: "tetra10", 3: "triangle", 6: "triangle6"}


def to_vtk(mesh: Mesh, boundary: bool) -> Any:
    cells = mesh.triangles if boundary else mesh.cells
    arrays = (
        {"patch": mesh.patches, "tet": mesh.cell_ids[mesh.triangle_cells]}
        if boundary
        else {"attribute": mesh.materials, "subdomain": mesh.subdomains}
    )
    support = vtk("util.numpy_support")
    model, core = vtk("vtkCommonDataModel"), vtk("vtkCommonCore")
    grid = model.vtkUnstructuredGrid()
    points = core.vtkPoints()
    points.SetData(support.numpy_to_vtk(mesh.points, deep=True))
    grid.SetPoints(points)
    array = model.vtkCellArray()
    offsets = np.arange(len(cells) + 1, dtype=np.int64) * cells.shape[1]
    array.SetData(_ids(support, offsets), _ids(support, cells.ravel()))
    grid.SetCells(_VTK_TYPES[cells.shape[1]], array)
    for name, values in arrays.items():
        _add_array(support, grid.GetCellData(), name, values)
    _add_global_ids(support, grid.GetPointData(), "GlobalPointIds", mesh.point_ids)
    _add_global_ids(support, grid.GetCellData(), "GlobalCellIds", mesh.triangle_ids if boundary else mesh.cell_ids)
    _add_array(support, grid.GetPointData(), "owner", mesh.owner)
    for name, texts in (("material_names", mesh.names.materials), ("patch_names", mesh.names.patches)):
        strings = core.vtkStringArray()
        strings.SetName(name)
        for text in texts:
            strings.InsertNextValue(text)
        grid.GetFieldData().AddArray(strings)
    return grid


def _ids(support: Any, values: np.ndarray) -> Any:
    return support.numpy_to_vtkIdTypeArray(np.ascontiguousarray(values, np.int64), deep=True)


def _add_array(support: Any, data: Any, name: str, values: np.ndarray) -> None:
    array = support.numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.AddArray(array)


def _add_global_ids(support: Any, data: Any, name: str, values: np.ndarray) -> None:
    array = _ids(support, values)
    array.SetName(name)
    data.SetGlobalIds(array)


def to_pyvista(mesh: Mesh, boundary: bool) -> Any:
    pyvista = needed("pyvista", "it with `pip install pyvista` (Debian 12 has no package)", "to_pyvista()")
    return pyvista.wrap(to_vtk(mesh, boundary))


def to_meshio(mesh: Mesh) -> Any:
    meshio = needed("meshio", "python3-meshio", "to_meshio()")
    material_tag, patch_tag = _tags_by_name(mesh.names.materials), _tags_by_name(mesh.names.patches)
    # Where a material and a patch have one name, Gmsh's format, which has one list of names, tells them apart.
    both = set(mesh.names.materials) & set(mesh.names.patches)
    field_data = {name: np.array([tag, 3]) for name, tag in zip(mesh.names.materials, material_tag)}
    for name, tag in zip(mesh.names.patches, patch_tag):
        field_data[f"{name} (patch)" if name in both else name] = np.array([tag, 2])
    num_cells, num_triangles = len(mesh.cells), len(mesh.triangles)
    materials, patches = mesh.materials, mesh.patches + 1
    return meshio.Mesh(
        mesh.points,
        [
            (_MESHIO_TYPES[mesh.cells.shape[1]], mesh.cells),
            (_MESHIO_TYPES[mesh.triangles.shape[1]], mesh.triangles),
        ],
        cell_data={
            "material": [materials, np.zeros(num_triangles, np.int32)],
            "patch": [np.full(num_cells, -1, np.int32), mesh.patches],
            "gmsh:physical": [material_tag[materials - 1], patch_tag[patches - 1]],
            "gmsh:geometrical": [materials, patches],
        },
        field_data=field_data,
    )


def _tags_by_name(names: list[str]) -> np.ndarray:
    """For each name the number, from 1, of the first that is equal."""
    return np.array([names.index(name) + 1 for name in names], np.int32)


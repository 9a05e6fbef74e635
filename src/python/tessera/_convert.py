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


def to_meshio(mesh: Mesh, gmsh: bool) -> Any:
    meshio = needed("meshio", "python3-meshio", "to_meshio()")
    blocks = [(_MESHIO_TYPES[cells.shape[1]], cells) for cells in (mesh.cells, mesh.triangles)]
    if not gmsh:
        no_patch, no_material = np.full(len(mesh.cells), -1, np.int32), np.zeros(len(mesh.triangles), np.int32)
        cell_data = {"material": [mesh.materials, no_material], "patch": [no_patch, mesh.patches]}
        return meshio.Mesh(mesh.points, blocks, cell_data=cell_data)
    material_tag, patch_tag = _tags_by_name(mesh.names.materials), _tags_by_name(mesh.names.patches)
    cell_data = {
        "gmsh:physical": [material_tag[mesh.materials - 1], patch_tag[mesh.patches]],
        "gmsh:geometrical": [mesh.materials, mesh.patches + 1],
    }
    names = {name: np.array([tag, 3]) for name, tag in zip(mesh.names.materials, material_tag)}
    for name, tag in zip(mesh.names.patches, patch_tag):
        # There is one list of names for both.
        both = name in mesh.names.materials
        names[f"{name} (patch)" if both else name] = np.array([tag, 2])
    return meshio.Mesh(mesh.points, blocks, cell_data=cell_data, field_data=names)


def _tags_by_name(names: list[str]) -> np.ndarray:
    """For each name the number, from 1, of the first that is equal."""
    return np.array([names.index(name) + 1 for name in names], np.int32)


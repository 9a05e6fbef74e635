# SPDX-License-Identifier: BSD-3-Clause
"""Piece files as arrays, read by VTK."""
from __future__ import annotations

import dataclasses
import pathlib
import xml.etree.ElementTree
from typing import Any

import numpy as np

from ._errors import InputError
from ._exchange import ranges
from ._imports import vtk

# VTK's numbers of cell types, with the points of each.
TETS = {10: 4, 24: 10}
TRIANGLES = {5: 3, 22: 6}
_GHOST_CELL = 1  # DUPLICATECELL of vtkGhostType.


@dataclasses.dataclass
class Piece:
    """The cells of one kind in a file; rows of points are those of the file."""

    points: np.ndarray  # Shape (num_points, 3).
    point_ids: np.ndarray  # Shape (num_points).
    cells: np.ndarray  # Shape (num_cells, points of a cell).
    cell_arrays: dict[str, np.ndarray]  # By name, shape (num_cells); the ids as "id".
    texts: dict[str, list[str]]  # Of the field data.


def piece_files(index: pathlib.Path) -> list[pathlib.Path]:
    """The files of a .pvtu index; a .vtu is its only piece. Local."""
    if index.suffix != ".pvtu":
        return [index]
    try:
        root = xml.etree.ElementTree.parse(index).getroot()
    except OSError as error:
        raise InputError(f"{index}: {error.strerror}") from error
    except xml.etree.ElementTree.ParseError as error:
        raise InputError(f"{index}: no index of VTK: {error}") from error
    sources = [piece.get("Source") for piece in root.iter("Piece")]
    if not sources or None in sources:
        raise InputError(f"{index}: it names no pieces")
    return [index.parent / str(source) for source in sources]


def read_piece(file: pathlib.Path, kinds: dict[int, int]) -> Piece:
    """The cells of these kinds in a .vtu file, without ghosts. Local."""
    grid = _read_grid(file)
    numpy = vtk("util.numpy_support").vtk_to_numpy
    rows, cells = _cells_of(grid, kinds, file, numpy)
    arrays = _cell_arrays(grid, numpy)
    kept = np.ones(len(rows), bool)
    if "vtkGhostType" in arrays:
        kept = (arrays.pop("vtkGhostType")[rows] & _GHOST_CELL) == 0
    rows, cells = rows[kept], cells[kept]
    points, used = np.unique(cells, return_inverse=True)
    ids = grid.GetPointData().GetGlobalIds()
    if ids is None or (len(rows) and "id" not in arrays):
        raise InputError(f"{file}: it has no global ids; `tessera repartition` writes the mesh with ids")
    return Piece(
        points=numpy(grid.GetPoints().GetData())[points].astype(float) if len(points) else np.empty((0, 3)),
        point_ids=numpy(ids)[points].astype(np.int64),
        cells=used.reshape(cells.shape),
        cell_arrays={name: array[rows] for name, array in arrays.items()},
        texts=_texts(grid),
    )


def _read_grid(file: pathlib.Path) -> Any:
    if not file.is_file():
        raise InputError(f"{file}: no such file")
    core = vtk("vtkCommonCore")
    window, before = core.vtkStringOutputWindow(), core.vtkOutputWindow.GetInstance()
    core.vtkOutputWindow.SetInstance(window)
    verbosity = core.vtkLogger.GetCurrentVerbosityCutoff()
    core.vtkLogger.SetStderrVerbosity(core.vtkLogger.VERBOSITY_OFF)  # The exception says it.
    try:
        reader = vtk("vtkIOXML").vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(file))
        reader.Update()
    finally:
        core.vtkOutputWindow.SetInstance(before)
        core.vtkLogger.SetStderrVerbosity(verbosity)
    said = " ".join(window.GetOutput().split())
    if said or reader.GetErrorCode() != 0:
        raise InputError(f"{file}: VTK cannot read it: {said or 'error code ' + str(reader.GetErrorCode())}")
    return reader.GetOutput()


def _cells_of(
    grid: Any, kinds: dict[int, int], file: pathlib.Path, numpy: Any
) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the cells of these kinds, and their points, shape (num_rows, points of a cell)."""
    if grid.GetNumberOfCells() == 0:
        return np.empty(0, np.int64), np.empty((0, next(iter(kinds.values()))), np.int64)
    types = numpy(grid.GetCellTypesArray())
    found = [kind for kind in kinds if np.any(types == kind)]
    if len(found) != 1:
        what = "tets" if kinds is TETS else "triangles"
        raise InputError(f"{file}: it has {'two orders of' if found else 'no'} {what}")
    rows = np.flatnonzero(types == found[0])
    starts = numpy(grid.GetCells().GetOffsetsArray())[rows].astype(np.int64)
    width = kinds[found[0]]
    picked = ranges(starts, np.full(len(rows), width))
    return rows, numpy(grid.GetCells().GetConnectivityArray())[picked].reshape(-1, width)


def _cell_arrays(grid: Any, numpy: Any) -> dict[str, np.ndarray]:
    """Arrays of one component a cell."""
    data = grid.GetCellData()
    arrays = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        if array is not None and array.GetNumberOfComponents() == 1:
            arrays[array.GetName()] = numpy(array)
    ids = data.GetGlobalIds()
    if ids is not None:
        arrays["id"] = numpy(ids).astype(np.int64)
    return arrays


def _texts(grid: Any) -> dict[str, list[str]]:
    data = grid.GetFieldData()
    texts = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        if array.GetDataTypeAsString() == "string":
            texts[array.GetName()] = [array.GetValue(j) for j in range(array.GetNumberOfValues())]
    return texts


def share_of(files: list[pathlib.Path], rank: int, size: int) -> list[pathlib.Path]:
    """The files of one rank, some that stand together; as tessera::read_mesh deals them. Local."""
    return files[len(files) * rank // size : len(files) * (rank + 1) // size]


# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts other datasets of VTK, grids of surface cells, to vtkPolyData."""
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import (
    VTK_EMPTY_CELL, VTK_LINE, VTK_PIXEL, VTK_POLY_LINE, VTK_POLY_VERTEX, VTK_POLYGON, VTK_QUAD,
    VTK_TRIANGLE, VTK_TRIANGLE_STRIP, VTK_VERTEX, vtkCellArray, vtkDataSet,
    vtkPointSet, vtkPolyData, vtkUnstructuredGrid)

from ._errors import InvalidMesh
from ._vtk_mesh import copy_cell_data

#: The place of each cell type among the four cell arrays of a vtkPolyData.
_VERTS, _LINES, _POLYS, _STRIPS = range(4)
_KINDS = {
    VTK_VERTEX: _VERTS, VTK_POLY_VERTEX: _VERTS, VTK_LINE: _LINES, VTK_POLY_LINE: _LINES,
    VTK_TRIANGLE: _POLYS, VTK_QUAD: _POLYS, VTK_PIXEL: _POLYS, VTK_POLYGON: _POLYS,
    VTK_TRIANGLE_STRIP: _STRIPS,
}


def to_poly_data(data):
    """The same points and cells, but without blanked cells; None if a cell is not a surface cell.

    Raises:
        InvalidMesh: The arrays of the cells contradict each other.
    """
    if isinstance(data, vtkPolyData):
        return data
    if not isinstance(data, vtkDataSet):
        return None
    _require_whole_cells(data)
    types = [data.GetCellType(cell) for cell in range(data.GetNumberOfCells())]
    if not set(types) <= {VTK_EMPTY_CELL, *_KINDS}:
        return None
    output = vtkPolyData()
    output.SetPoints(_get_points(data))
    output.GetPointData().PassData(data.GetPointData())
    output.GetFieldData().PassData(data.GetFieldData())
    for array in copy_cell_data(data, _copy_cells(data, types, output), output.GetCellData()):
        empty = array.NewInstance()  # the filter warns of it
        empty.SetName(array.GetName())
        output.GetCellData().AddArray(empty)
    return output


def _require_whole_cells(data):
    if not isinstance(data, vtkUnstructuredGrid) or data.GetCells() is None:
        return
    cells, types = data.GetCells(), _get_types(data)
    if (not cells.IsValid() or types is None
            or types.GetNumberOfValues() < cells.GetNumberOfCells()):
        raise InvalidMesh(
            "The offsets, the connectivity and the types of the cells contradict each other.")


def _get_types(grid):
    """The types of its cells, which VTK 9.6 and newer may keep as one constant."""
    version = vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()
    return grid.GetCellTypes() if version >= (9, 6) else grid.GetCellTypesArray()


def _get_points(data):
    if isinstance(data, vtkPointSet):
        return data.GetPoints()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetNumberOfPoints(data.GetNumberOfPoints())
    for point in range(data.GetNumberOfPoints()):
        points.SetPoint(point, data.GetPoint(point))
    return points


def _copy_cells(data, types, output):
    """Sets the output's cells. Returns the input's cells in the order of the output."""
    arrays = [vtkCellArray() for _ in range(4)]
    sources = [[] for _ in range(4)]
    ids = vtkIdList()
    for cell, kind in enumerate(types):
        if kind == VTK_EMPTY_CELL:
            continue
        data.GetCellPoints(cell, ids)
        if kind == VTK_PIXEL:
            _turn_pixel(cell, ids)
        arrays[_KINDS[kind]].InsertNextCell(ids)
        sources[_KINDS[kind]].append(cell)
    output.SetVerts(arrays[_VERTS])
    output.SetLines(arrays[_LINES])
    output.SetPolys(arrays[_POLYS])
    output.SetStrips(arrays[_STRIPS])
    return [cell for some in sources for cell in some]


def _turn_pixel(cell, ids):
    """Reorders the points of a pixel from row by row to around the quad."""
    if ids.GetNumberOfIds() != 4:
        raise InvalidMesh(
            f"Cell {cell} is a pixel, but has {ids.GetNumberOfIds()} points, not 4.")
    third, fourth = ids.GetId(2), ids.GetId(3)
    ids.SetId(2, fourth)
    ids.SetId(3, third)

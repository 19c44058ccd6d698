# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's arrays and cells as NumPy arrays, without a copy if possible."""
import numpy
from vtkmodules.util.numpy_support import get_numpy_array_type, numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import (
    vtkBitArray, vtkDataArray, vtkIdList, vtkTypeInt32Array, vtkTypeInt64Array)
from vtkmodules.vtkCommonDataModel import vtkCellArray

from ._errors import InvalidMesh


def view(array):
    """The values of a vtkDataArray, (n,) or (n, components)."""
    if not array.HasStandardMemoryLayout() or isinstance(array, vtkBitArray):
        array = copy(array)
    if array.GetNumberOfValues() == 0:
        width = array.GetNumberOfComponents()
        return numpy.empty((0, width) if width > 1 else 0, get_numpy_array_type(array.GetDataType()))
    return vtk_to_numpy(array)


def copy(array):
    """A deep copy in contiguous memory, of the same type (bits become bytes)."""
    kind = 3 if isinstance(array, vtkBitArray) else array.GetDataType()  # VTK_UNSIGNED_CHAR
    plain = vtkDataArray.CreateDataArray(kind)
    plain.DeepCopy(array)
    return plain


def make(name, values):
    """A new VTK array with a copy of these values."""
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


def make_ids(values):
    ids = vtkIdList()
    ids.SetNumberOfIds(len(values))
    for place, value in enumerate(values):
        ids.SetId(place, int(value))
    return ids


def view_points(mesh):
    """The coordinates, (n, 3) float32 or float64."""
    if mesh.GetNumberOfPoints() == 0:
        return numpy.empty((0, 3))
    data = mesh.GetPoints().GetData()
    if data.GetNumberOfComponents() != 3:
        raise InvalidMesh(f"Points must have 3 coordinates, not {data.GetNumberOfComponents()}.")
    points = view(data)
    return points if points.dtype in (numpy.float32, numpy.float64) else points.astype(float)


class Cells:
    """A vtkCellArray: ids `corners[offsets[i]:offsets[i + 1]]` are the points of cell i."""

    def __init__(self, array, what, first):
        """`what` is the word for the cells in messages, `first` the number of the first one.

        Raises:
            InvalidMesh: Offsets and connectivity contradict each other.
        """
        self.array, self.what, self.first = array, what, first
        if not array.IsValid():
            raise InvalidMesh(
                f"The offsets and the connectivity of the cell array of {what} {first} and the "
                "following ones contradict each other.", first)
        self.count = array.GetNumberOfCells()
        self.offsets = view(array.GetOffsetsArray()) if self.count else numpy.zeros(1, dtype=int)
        self.corners = view(array.GetConnectivityArray()) if self.count else numpy.zeros(0, dtype=int)

    @property
    def sizes(self):
        return numpy.diff(self.offsets)

    def are_triangles(self):
        return len(self.corners) == 3 * self.count and bool((self.sizes == 3).all())

    def require_points(self, count):
        """Raises InvalidMesh if a cell names a point that does not exist."""
        wrong = numpy.flatnonzero((self.corners < 0) | (self.corners >= count))
        if len(wrong):
            cell = int(numpy.searchsorted(self.offsets, wrong[0], side="right")) - 1
            raise name_out_of_range(
                self.what, self.first + cell, int(self.corners[wrong[0]]), count)

    def is_wide(self):
        return self.array.GetConnectivityArray().GetDataTypeSize() == 8


def name_out_of_range(what, cell, point, count):
    return InvalidMesh(
        f"Invalid mesh: {what} {cell} names point {point}, but there are {count} points, numbered "
        "from 0.", cell, point)


def new_cells(sizes, wide):
    """A vtkCellArray for cells of these sizes, and a view of its connectivity to be filled in."""
    kind = vtkTypeInt64Array if wide else vtkTypeInt32Array
    offsets, corners = kind(), kind()
    offsets.SetNumberOfValues(len(sizes) + 1)
    ends = numpy.cumsum(sizes)
    view(offsets)[0] = 0
    view(offsets)[1:] = ends
    corners.SetNumberOfValues(int(ends[-1]) if len(ends) else 0)
    cells = vtkCellArray()
    cells.SetData(offsets, corners)
    return cells, view(cells.GetConnectivityArray())

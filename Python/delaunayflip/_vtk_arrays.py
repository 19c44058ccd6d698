# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's arrays and cells as NumPy arrays, without a copy if possible."""
import numpy
from vtkmodules.util.numpy_support import get_numpy_array_type, numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import (
    vtkBitArray, vtkDataArray, vtkIdList, vtkTypeInt32Array, vtkTypeInt64Array)
from vtkmodules.vtkCommonDataModel import vtkCellArray

from . import _surface


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


def read_surface(mesh):
    return _surface.Surface(mesh, view)


def read_cells(array, what, first):
    return _surface.read_cells(array, what, first, view)


def view_points(mesh):
    """The coordinates, (n, 3) float32 or float64."""
    return read_surface(mesh).points


def is_wide(cells):
    return cells.GetConnectivityArray().GetDataTypeSize() == 8


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

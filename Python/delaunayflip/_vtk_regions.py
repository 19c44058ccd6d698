# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Cell arrays that say which edges stay: region labels and ghosts."""
import numpy
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR, vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

from . import _vtk_arrays
from ._errors import InvalidOptions
from ._surface import number_tuples


def label_cells(mesh, name):
    """One int32 label per cell; cells with equal tuples in the array have equal labels.

    Raises:
        InvalidOptions: There is no such array, or it does not have one tuple per cell.
    """
    array = mesh.GetCellData().GetAbstractArray(name)
    if array is None:
        raise InvalidOptions(f'RegionArray: the input has no cell array named "{name}".')
    if array.GetNumberOfTuples() != mesh.GetNumberOfCells():
        raise InvalidOptions(
            f'RegionArray: "{name}" must have as many tuples as the mesh has cells.')
    if isinstance(array, vtkDataArray):
        return number_tuples(_vtk_arrays.view(array))
    return _number_texts(array)


def _number_texts(array):
    width = array.GetNumberOfComponents()
    numbers = {}
    labels = numpy.empty(array.GetNumberOfTuples(), dtype=numpy.int32)
    for cell in range(len(labels)):
        texts = tuple(array.GetVariantValue(cell * width + i).ToString() for i in range(width))
        labels[cell] = numbers.setdefault(texts, len(numbers))
    return labels


def is_wrong_ghost_array(array):
    """Whether an array is named as ghost types are, but has not one number of type unsigned char for
    each tuple. Such an array is ignored."""
    return (array.GetName() == vtkDataSetAttributes.GhostArrayName()
            and (array.GetDataType() != VTK_UNSIGNED_CHAR or array.GetNumberOfComponents() != 1))


def find_ghosts(mesh):
    """The ghost types of the cells, of which there may be too few; None if there are none that are
    not ignored."""
    array = mesh.GetCellData().GetArray(vtkDataSetAttributes.GhostArrayName())
    return None if array is None or is_wrong_ghost_array(array) else _vtk_arrays.view(array)


def describe_malformed_arrays(mesh, short_points, short_cells):
    """Texts of warnings about arrays that do not fit the mesh. `short_points` is what becomes of point
    arrays with too few tuples, `short_cells` the same of cell arrays."""
    texts = _describe_short(mesh.GetPointData(), mesh.GetNumberOfPoints(), "point", short_points)
    texts += _describe_short(mesh.GetCellData(), mesh.GetNumberOfCells(), "cell", short_cells)
    ghosts = mesh.GetCellData().GetAbstractArray(vtkDataSetAttributes.GhostArrayName())
    if ghosts is not None and is_wrong_ghost_array(ghosts):
        fault = ("that is not of type unsigned char" if ghosts.GetDataType() != VTK_UNSIGNED_CHAR
                 else "with several components")
        texts.append(f'1 ghost array {fault} ignored: "{ghosts.GetName()}"')
    return texts


def _describe_short(data, tuples, kind, fate):
    arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
    names = [array.GetName() or "" for array in arrays if array.GetNumberOfTuples() < tuples]
    if not names:
        return []
    listed = ", ".join(f'"{name}"' for name in names[:3])
    more = f", and {len(names) - 3} more" if len(names) > 3 else ""
    word = "array" if len(names) == 1 else "arrays"
    return [f"{len(names)} {kind} {word} with too few tuples {fate}: {listed}{more}"]

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts a vtkPolyData to the engine's arrays, and back."""
import numpy
from vtkmodules.util.numpy_support import get_numpy_array_type, numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import (
    VTK_ID_TYPE, VTK_INT_MAX, VTK_UNSIGNED_CHAR, vtkBitArray, vtkDataArray, vtkIdList,
    vtkStringArray, vtkTypeInt32Array, vtkTypeInt64Array)
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataSetAttributes

from ._library import InvalidOptions
from ._surface import FlipInput, Surface, number_tuples


class MeshInput(FlipInput):
    """Arrays for a Session, and the parts of the input that the output needs."""

    def __init__(self, mesh, others, settings, progress):
        self.mesh = mesh.NewInstance()
        self.mesh.ShallowCopy(mesh)
        others = _read(others) if others is not None else None
        super().__init__(_read(mesh), others, settings, progress)
        if settings.region_array:
            self.regions = _label_cells(mesh, settings.region_array)[self.slots.cells]
        ghosts = mesh.GetCellData().GetArray(vtkDataSetAttributes.GhostArrayName())
        if ghosts is not None and not _find_ghost_fault(ghosts):
            self.freeze(_view(ghosts))

    def list_defects(self):
        """Texts of a warning about the input's constraints and arrays."""
        mesh, passed = self.mesh, "passed unchanged"
        texts = self.describe_unmatched()
        texts += _describe_short(mesh.GetPointData(), mesh.GetNumberOfPoints(), "point", passed)
        texts += _describe_short(mesh.GetCellData(), mesh.GetNumberOfCells(), "cell",
                                 passed if self.slots.in_place else "left out")
        name = vtkDataSetAttributes.GhostArrayName()
        ghosts = mesh.GetCellData().GetAbstractArray(name)
        fault = _find_ghost_fault(ghosts) if ghosts is not None else ""
        return texts + ([f'1 ghost array {fault} ignored: "{name}"'] if fault else [])

    def store(self, session, output, counts, angles):
        """Writes the current mesh, with the requested cell arrays."""
        mesh, slots = self.mesh, self.slots
        given = mesh.GetPolys() if mesh.GetNumberOfPolys() else mesh.GetStrips()
        is_wide = _is_wide(given) or 3 * len(slots.triangles) > VTK_INT_MAX
        polygons, corners = _new_cells(self.polygon_sizes, is_wide)
        self.fill_polygons(session, corners)
        chosen = slots.kept_strips - slots.strips.first
        strips, corners = _new_cells(slots.strips.sizes[chosen], _is_wide(mesh.GetStrips()))
        corners[:] = slots.strips.gather(chosen)
        output.SetPoints(mesh.GetPoints())
        output.SetVerts(mesh.GetVerts())
        output.SetLines(mesh.GetLines())
        output.SetPolys(polygons)
        output.SetStrips(strips)
        output.GetPointData().ShallowCopy(mesh.GetPointData())
        output.GetFieldData().ShallowCopy(mesh.GetFieldData())
        self._pass_cell_data(session, output)
        add_arrays(output.GetCellData(), "", self.list_numbers(session, counts, angles))

    def _pass_cell_data(self, session, output):
        data, slots = output.GetCellData(), self.slots
        if slots.in_place:
            data.ShallowCopy(self.mesh.GetCellData())
        else:
            copy_cell_data(self.mesh, self.cell_sources, data)
        ids, shared = data.GetGlobalIds(), data.GetNormals()
        if slots.divides_cells and ids is not None:  # several cells share an id
            data.SetActiveAttribute(-1, data.GLOBALIDS)
            if data.GetPedigreeIds() is None:
                data.SetPedigreeIds(ids)
        if (shared is not None and shared.GetNumberOfComponents() == 3
                and shared.GetNumberOfTuples() >= output.GetNumberOfCells()):
            normals = _copy(shared)
            self.renew_normals(_view(normals), session.triangles)
            data.SetNormals(normals)


def add_arrays(data, prefix, arrays):
    """`arrays`: (name, values, a number or a text) of each."""
    for name, values in arrays:
        if isinstance(values, str):
            array = vtkStringArray()
            array.InsertNextValue(values)
        else:
            values = numpy.atleast_1d(values)
            kind = VTK_ID_TYPE if values.dtype == numpy.int64 else None
            array = numpy_to_vtk(values, deep=True, array_type=kind)
        array.SetName(prefix + name)
        data.AddArray(array)


def copy_cell_data(mesh, sources, target):
    """Copies the tuples of the source cells. Returns the arrays that are too short for that, and are
    left out."""
    whole, short = vtkDataSetAttributes(), []
    whole.ShallowCopy(mesh.GetCellData())
    for i in reversed(range(whole.GetNumberOfArrays())):
        if whole.GetAbstractArray(i).GetNumberOfTuples() < mesh.GetNumberOfCells():
            short.append(whole.GetAbstractArray(i))
            whole.RemoveArray(i)
    target.CopyAllOn()
    target.CopyAllocate(whole, len(sources))
    target.CopyData(whole, _make_ids(sources), _make_ids(range(len(sources))))
    return short


def _read(mesh):
    """The arrays are copies: observers may change the input during the run."""
    return Surface(mesh, lambda array: _view(array).copy())


def _view(array):
    """The values of a vtkDataArray, (n,) or (n, components)."""
    if not array.HasStandardMemoryLayout() or isinstance(array, vtkBitArray):
        array = _copy(array)
    if array.GetNumberOfValues() == 0:
        width = array.GetNumberOfComponents()
        return numpy.empty((0, width) if width > 1 else 0, get_numpy_array_type(array.GetDataType()))
    return vtk_to_numpy(array)


def _copy(array):
    """A deep copy in contiguous memory, of the same type (bits become bytes)."""
    kind = VTK_UNSIGNED_CHAR if isinstance(array, vtkBitArray) else array.GetDataType()
    plain = vtkDataArray.CreateDataArray(kind)
    plain.DeepCopy(array)
    return plain


def _make_ids(values):
    ids = vtkIdList()
    ids.SetNumberOfIds(len(values))
    for place, value in enumerate(values):
        ids.SetId(place, int(value))
    return ids


def _is_wide(cells):
    return cells.GetConnectivityArray().GetDataTypeSize() == 8


def _new_cells(sizes, wide):
    """A vtkCellArray for cells of these sizes, and a view of its connectivity to be filled in."""
    kind = vtkTypeInt64Array if wide else vtkTypeInt32Array
    offsets, corners, ends = kind(), kind(), numpy.cumsum(sizes)
    offsets.SetNumberOfValues(len(sizes) + 1)
    _view(offsets)[0] = 0
    _view(offsets)[1:] = ends
    corners.SetNumberOfValues(int(ends[-1]) if len(ends) else 0)
    cells = vtkCellArray()
    cells.SetData(offsets, corners)
    return cells, _view(cells.GetConnectivityArray())


def _label_cells(mesh, name):
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
        return number_tuples(_view(array))
    texts = [array.GetVariantValue(i).ToString() for i in range(array.GetNumberOfValues())]
    return number_tuples(numpy.array(texts).reshape(mesh.GetNumberOfCells(), -1))


def _find_ghost_fault(ghosts):
    """Why a ghost array is ignored, or ""."""
    if ghosts.GetDataType() != VTK_UNSIGNED_CHAR:
        return "that is not of type unsigned char"
    return "with several components" if ghosts.GetNumberOfComponents() != 1 else ""


def _describe_short(data, tuples, kind, fate):
    arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
    names = [array.GetName() or "" for array in arrays if array.GetNumberOfTuples() < tuples]
    if not names:
        return []
    listed = ", ".join(f'"{name}"' for name in names[:3])
    more = f", and {len(names) - 3} more" if len(names) > 3 else ""
    word = "array" if len(names) == 1 else "arrays"
    return [f"{len(names)} {kind} {word} with too few tuples {fate}: {listed}{more}"]

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Reads and makes data objects of any VTK, and their arrays."""
import functools
import importlib

import numpy

from ._library import InvalidOptions
from ._report import join
from ._sphere import find_misplaced, place_on_sphere
from ._surface import Surface, number_tuples

HEIGHT_ARRAY = "Height"  #: That of z of longitudes, latitudes and heights.
GHOST_ARRAY = "vtkGhostType"


class Vtk:
    """The modules and arrays of one VTK. PyVista may use another one than vtkmodules."""

    def __init__(self, package):
        self.core = importlib.import_module(f"{package}.vtkCommonCore")
        self.model = importlib.import_module(f"{package}.vtkCommonDataModel")
        self.support = importlib.import_module(f"{package}.util.numpy_support")

    def add_arrays(self, data, prefix, arrays):
        """`arrays`: (name, values, a number or a text) of each; None removes it. They are no attributes, also
        if they replace some."""
        for name, values in arrays:
            data.RemoveArray(prefix + name)
            if values is None:
                continue
            if isinstance(values, str):
                array = self.core.vtkStringArray()
                array.InsertNextValue(values)
            else:
                values = numpy.atleast_1d(values)
                kind = self.core.VTK_ID_TYPE if values.dtype == numpy.int64 else None
                array = self.support.numpy_to_vtk(values, deep=True, array_type=kind)
            array.SetName(prefix + name)
            data.AddArray(array)

    def add_tuples(self, own, count, sources, first, size, data):
        """Copies the tuples `sources` of the arrays of `own` that have at least `count` to those of
        `data`, which have `size` tuples, from `first` on, as AddTuples does in C++."""
        ids, places = self.core.vtkIdList(), self.core.vtkIdList()
        for place, source in enumerate(sources, first):
            ids.InsertNextId(int(source))
            places.InsertNextId(place)
        taken = []
        for array in list_arrays(own):
            if array.GetNumberOfTuples() < count:
                continue
            target, name = find_array(data, array, taken)
            if target is None:
                target = self.core.vtkAbstractArray.CreateArray(array.GetDataType())
                target.SetName(name)
                target.SetNumberOfComponents(array.GetNumberOfComponents())
                target.SetNumberOfTuples(size)
                target.CopyComponentNames(array)
                target.CopyInformation(array.GetInformation())
                if hasattr(target, "Fill"):
                    target.Fill(0)
                    target.SetLookupTable(array.GetLookupTable())
                add_attributes(data, data.AddArray(target), find_attributes(own, array))
            taken.append(target)
            target.InsertTuples(places, ids, array)

    def interpolate_tuples(self, data, first, ids, weights):
        """Writes the tuples of added points, from `first` on, interpolated between those of two or three
        other points. Labels of points are not interpolated."""
        labels = data.GetGlobalIds(), data.GetPedigreeIds(), data.GetAbstractArray(GHOST_ARRAY)
        corners = self.core.vtkIdList()
        corners.SetNumberOfIds(3)
        for array in list_arrays(data):
            if is_among(array, labels):
                continue
            for place, (near, share) in enumerate(zip(ids.tolist(), weights.tolist()), first):
                if near[2] < 0:
                    array.InterpolateTuple(place, near[0], array, near[1], array, share[1])
                    continue
                for k in range(3):
                    corners.SetId(k, near[k])
                array.InterpolateTuple(place, corners, array, share)

    def read(self, mesh):
        """A Surface. Its arrays are copies: observers may change the input during the run."""
        return Surface(mesh, lambda array: self.view(array).copy())

    def view(self, array):
        """The values of a vtkDataArray, (n,) or (n, components)."""
        if not array.HasStandardMemoryLayout() or isinstance(array, self.core.vtkBitArray):
            array = self.copy_array(array)
        if array.GetNumberOfValues() == 0:
            width, kind = array.GetNumberOfComponents(), array.GetDataType()
            return numpy.empty((0, width) if width > 1 else 0, self.support.get_numpy_array_type(kind))
        return self.support.vtk_to_numpy(array)

    def copy_array(self, array):
        """A deep copy in contiguous memory, of the same type (bits become bytes)."""
        is_bits = isinstance(array, self.core.vtkBitArray)
        plain = self.core.vtkDataArray.CreateDataArray(
            self.core.VTK_UNSIGNED_CHAR if is_bits else array.GetDataType())
        plain.DeepCopy(array)
        return plain

    def make_cells(self, sizes, is_wide):
        """A vtkCellArray for cells of these sizes, and a view of its connectivity to be filled in."""
        kind = self.core.vtkTypeInt64Array if is_wide else self.core.vtkTypeInt32Array
        offsets, corners, ends = kind(), kind(), numpy.append(0, numpy.cumsum(sizes))
        offsets.SetNumberOfValues(len(ends))
        self.view(offsets)[:] = ends
        corners.SetNumberOfValues(int(ends[-1]))
        cells = self.model.vtkCellArray()
        cells.SetData(offsets, corners)
        return cells, self.view(cells.GetConnectivityArray())

    def label_cells(self, mesh, name):
        """One int32 label per cell; cells with equal tuples in the array have equal labels.

        Raises:
            InvalidOptions: There is no such array, or it does not have one tuple per cell.
        """
        array = mesh.GetCellData().GetAbstractArray(name)
        if array is None:
            raise InvalidOptions(f'RegionArray: the input has no cell array named "{name}"; '
                                 f"{list_names(mesh.GetCellData())}.")
        if array.GetNumberOfTuples() != mesh.GetNumberOfCells():
            raise InvalidOptions(
                f'RegionArray: "{name}" must have as many tuples as the mesh has cells.')
        if isinstance(array, self.core.vtkDataArray):
            return number_tuples(self.view(array))
        texts = [_describe_value(array.GetVariantValue(i)) for i in range(array.GetNumberOfValues())]
        return number_tuples(numpy.array(texts).reshape(mesh.GetNumberOfCells(), -1))


def _describe_value(value):
    """A text that only equal variants have: a number with all of its digits, whatever its type."""
    if not (value.IsFloat() or value.IsDouble()):
        return value.ToString()
    number = value.ToDouble() + 0.0  # 0 and -0 are equal
    return "nan" if number != number else f"{number:.17g}"


def pass_points(data, output):
    """Passes points with their data, and the field data."""
    output.SetPoints(data.GetPoints())
    output.GetPointData().ShallowCopy(data.GetPointData())
    output.GetFieldData().ShallowCopy(data.GetFieldData())


def place_points(data):
    """Takes x and y of a dataset's points as longitudes and latitudes. Returns a copy with their places on
    the unit sphere, and the text of a warning, or ""."""
    made, vtk = data.NewInstance(), vtk_of(data)
    made.ShallowCopy(data)
    if data.GetPoints() is None:
        return made, ""
    mesh, points = vtk.model.vtkPolyData(), vtk.core.vtkPoints()
    mesh.SetPoints(data.GetPoints())
    degrees = vtk.read(mesh).points[:, :2]
    points.SetData(vtk.support.numpy_to_vtk(place_on_sphere(degrees), deep=True))
    made.SetPoints(points)
    return made, describe_latitudes(degrees[:, 1])


def describe_latitudes(latitudes):
    """The text of a warning about latitudes beyond 90 degrees, or ""."""
    ids = find_misplaced(latitudes)
    if not len(ids):
        return ""
    return (f"{len(ids)} point{'s' * (len(ids) > 1)} with a latitude beyond 90 degrees (first: {ids[0]}); "
            "x is the longitude and y the latitude")


def keep_heights(given, name, data, always=False, owner="the points"):
    """Adds z of the points of a dataset to point data, as an array. If z = 0 throughout, only if `always`.
    Returns the text of a warning if there is such an array already, and z is not 0 throughout, or ""."""
    if given.GetPoints() is None:
        return ""
    vtk, mesh = vtk_of(given), vtk_of(given).model.vtkPolyData()
    mesh.SetPoints(given.GetPoints())
    heights = vtk.read(mesh).points[:, 2].astype(float)
    has_heights = numpy.nan_to_num(heights, posinf=0, neginf=0).any()
    if data.HasArray(name):
        return f'z left out, because {owner} have an array "{name}"' if has_heights else ""
    if not (always or has_heights):
        return ""
    array = vtk.support.numpy_to_vtk(heights, True)
    array.SetName(name)
    add_attributes(data, data.AddArray(array), [data.SCALARS])
    return ""


_load = functools.lru_cache(maxsize=None)(Vtk)


def vtk_of(data):
    """The Vtk of a data object."""
    module = next(cls.__module__ for cls in type(data).__mro__ if cls.__name__ == "vtkDataObject")
    return _load(module.rpartition(".")[0])


def list_arrays(data):
    return [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]


def list_names(data):
    """The names of arrays in a message."""
    names = [f'"{array.GetName() or ""}"' for array in list_arrays(data)]
    return f"it has {', '.join(names) or 'none'}"


def is_among(array, others):
    """By identity: arrays of VTK 9.7 compare their values, as those of NumPy do."""
    return any(array is other for other in others)


def find_array(data, like, taken):
    """The array of `data` for tuples of another one, or None, and its name: see AddTuples in C++."""
    def fits(array):
        return not is_among(array, taken) and (array.GetDataType(), array.GetNumberOfComponents()) == (
            like.GetDataType(), like.GetNumberOfComponents())

    name = like.GetName() or ""
    while True:
        found = [array for array in list_arrays(data)
                 if (array.GetName() or "") == name and (name or fits(array))]
        if not found or fits(found[0]):
            return found[0] if found else None, name or None
        name += " (2)"


def find_attributes(data, array):
    return [kind for kind in range(data.NUM_ATTRIBUTES) if data.GetAbstractAttribute(kind) is array]


def add_attributes(data, number, attributes):
    """Makes an array these attributes, except those that `data` has."""
    for kind in attributes:
        if data.GetAbstractAttribute(kind) is None:
            data.SetActiveAttribute(number, kind)


def demote_global_ids(data):
    """Global ids become pedigree ids, because several cells or points now share one."""
    ids = data.GetGlobalIds()
    if ids is not None:
        data.SetActiveAttribute(-1, data.GLOBALIDS)
        number = [array is ids for array in list_arrays(data)].index(True)
        add_attributes(data, number, [data.PEDIGREEIDS])


def has_wide_ids(cells):
    return cells.GetConnectivityArray().GetDataTypeSize() == 8


def describe_short(data, tuples, kind, fate, where=""):
    names = [array.GetName() or "" for array in list_arrays(data)
             if array.GetNumberOfTuples() < tuples]
    if not names:
        return []
    listed = join([f'"{name}"' for name in names], ", ")
    word = "array" if len(names) == 1 else "arrays"
    return [f"{len(names)} {kind} {word}{where} with too few tuples {fate}: {listed}"]

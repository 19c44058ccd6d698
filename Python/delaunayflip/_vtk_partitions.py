# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The partitions of a dataset as one mesh, and the way back."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkAbstractArray, vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkPolyData

from ._errors import InvalidOptions
from ._constraints import list_other_pairs
from ._vtk_arrays import (
    is_wide, make, make_ids, new_cells, read_cells, read_surface, view, view_points)
from ._surface import Surface
from ._vtk_mesh import demote_global_ids, take_whole_arrays, take_whole_point_arrays
from ._vtk_points import PartitionPoints
from ._vtk_regions import find_ghosts, is_wrong_ghost_array

_MARK = "vtkDelaunayFlipPartition"
AMBIGUOUS = ("points of some partitions coincide with others of the same partition, and edges there "
             "stayed; number the points of the mesh before it is cut, as vtkGlobalPointIds")


class JoinedPartitions:
    """One mesh, `mesh`, made of partitions; duplicate ghost cells are dropped."""

    def __init__(self, partitions, regions):
        """`regions` is the name of a cell array that all must have, or empty.

        Raises:
            InvalidMesh: A cell names a point that does not exist.
            InvalidOptions: A partition lacks the regions, or has them in another type.
        """
        for mesh in partitions:
            for cells in _list_cells(mesh):
                cells.require_points(mesh.GetNumberOfPoints())
        self._parts = [_drop_duplicates(mesh) for mesh in partitions]
        self._points = PartitionPoints(self._parts)
        self.mesh = vtkPolyData()
        self.mesh.SetPoints(self._points.points)
        self._add_cells()
        self._add_data()
        if regions:
            self._require_regions(regions)

    @property
    def has_ambiguous_points(self):
        return self._points.ambiguous > 0

    def _add_cells(self):
        owners, joined = [], []
        for kind in zip(*(_list_cells(mesh) for mesh in self._parts)):
            cells, corners = new_cells(numpy.concatenate([part.sizes for part in kind]), True)
            corners[:] = numpy.concatenate(
                [ids[part.corners] for ids, part in zip(self._points.ids, kind)])
            owners += [numpy.full(part.count, k) for k, part in enumerate(kind)]
            joined.append(cells)
        _set_cells(self.mesh, joined)
        self._owners = numpy.concatenate(owners).astype(numpy.int32)

    def _add_data(self):
        self._point_data = _Data(self.mesh.GetPointData(), self.mesh.GetNumberOfPoints())
        self._cell_data = _Data(self.mesh.GetCellData(), self.mesh.GetNumberOfCells())
        for k in reversed(range(len(self._parts))):  # the first one's points count
            self._point_data.add(self._parts[k].GetPointData(), self._points.ids[k])
            self._cell_data.add(self._parts[k].GetCellData(), numpy.flatnonzero(self._owners == k))
        self.mesh.GetCellData().AddArray(make(_MARK, self._owners))

    def _require_regions(self, name):
        joined = self.mesh.GetCellData().GetAbstractArray(name)
        for mesh in self._parts:
            own = mesh.GetCellData().GetAbstractArray(name)
            if (own is None or joined is None or not _is_same_kind(own, joined)
                    or own.GetNumberOfTuples() < mesh.GetNumberOfCells()):
                raise InvalidOptions(
                    f'not all partitions have a cell array named "{name}" of the same type, with a '
                    "tuple for every cell")

    def divide(self, flipped):
        """The partitions of the mesh after a run, each with the cells that it had; empty ones after
        a failure. Points that a partition lacks are added behind its own."""
        marks = flipped.GetCellData().GetArray(_MARK)
        if marks is None:
            return [vtkPolyData() for _ in self._parts]
        owners = view(marks).copy()
        flipped.GetCellData().RemoveArray(_MARK)
        return [self._make_part(k, flipped, owners) for k in range(len(self._parts))]

    def _make_part(self, k, flipped, owners):
        own, made = self._parts[k], vtkPolyData()
        local = numpy.full(flipped.GetNumberOfPoints(), -1)
        local[self._points.ids[k]] = numpy.arange(own.GetNumberOfPoints())
        taken = [_take_cells(cells, owners, k) for cells in _list_cells(flipped)[2:]]
        added = _list_new([corners for _, corners in taken], local)
        local[added] = own.GetNumberOfPoints() + numpy.arange(len(added))
        polygons = own.GetPolys() if own.GetNumberOfPolys() else own.GetStrips()
        wide = polygons.GetConnectivityArray().GetDataTypeSize() == 8
        arrays = [own.GetVerts(), own.GetLines()]
        for sizes, corners in taken:
            cells, ids = new_cells(sizes, wide)
            ids[:] = local[corners]
            arrays.append(cells)
        _set_cells(made, arrays)
        self._store_points(k, flipped, added, made)
        self._cell_data.store(own.GetCellData(), 0, flipped.GetCellData(),
                              numpy.flatnonzero(owners == k), made.GetCellData())
        if self.mesh.GetCellData().GetGlobalIds() and not flipped.GetCellData().GetGlobalIds():
            demote_global_ids(made.GetCellData())
        made.GetFieldData().ShallowCopy(own.GetFieldData())
        for i in range(flipped.GetFieldData().GetNumberOfArrays()):
            made.GetFieldData().AddArray(flipped.GetFieldData().GetAbstractArray(i))
        return made

    def _store_points(self, k, flipped, added, made):
        own = self._parts[k]
        if len(added) == 0:
            made.SetPoints(own.GetPoints())
            made.GetPointData().ShallowCopy(take_whole_point_arrays(own))
            return
        given = view_points(own)
        points = vtkPoints()
        points.SetDataType(own.GetPoints().GetDataType())
        points.SetNumberOfPoints(len(given) + len(added))
        points.InsertPoints(0, len(given), 0, own.GetPoints())
        for i, point in enumerate(added):
            points.SetPoint(len(given) + i, flipped.GetPoint(point))
        made.SetPoints(points)
        self._point_data.store(own.GetPointData(), len(given), flipped.GetPointData(), added,
                               made.GetPointData())


class _Data:
    """The point or cell data of all partitions: `joined` has all their arrays, with zeros or empty
    texts where a partition lacks one. Arrays of one name that differ in type stay apart."""

    def __init__(self, joined, size):
        self._joined, self._size = joined, size

    def _find_name(self, own, index):
        array = own.GetAbstractArray(index)
        name = array.GetName() if array.GetName() is not None else f"\n{index}"
        if is_wrong_ghost_array(array):  # the joined mesh has the ghost types of the other partitions
            name += "\n"
        while True:
            known = self._joined.GetAbstractArray(name)
            if known is None or _is_same_kind(known, array):
                return name
            name += "\n"  # no name that anybody gives

    def add(self, own, places):
        """`places` are those of the partition's tuples among all."""
        targets, sources = make_ids(places), make_ids(range(len(places)))
        for i in range(own.GetNumberOfArrays()):
            array = own.GetAbstractArray(i)
            if array.GetNumberOfTuples() < len(places):
                continue
            name = self._find_name(own, i)
            if not self._joined.HasArray(name):
                made = _make_zeros(array, self._size)
                made.SetName(name)
                index, attribute = self._joined.AddArray(made), own.IsArrayAnAttribute(i)
                if attribute >= 0 and self._joined.GetAbstractAttribute(attribute) is None:
                    self._joined.SetActiveAttribute(index, attribute)
            self._joined.GetAbstractArray(name).InsertTuples(targets, sources, array)

    def store(self, own, count, flipped, places, result):
        """Writes `count` tuples of a partition's own data, then those at `places` of the result.
        New arrays of the result are added if count is 0."""
        sources, targets = make_ids(places), make_ids(count + numpy.arange(len(places)))
        for i in range(own.GetNumberOfArrays()):
            array = own.GetAbstractArray(i)
            source = flipped.GetAbstractArray(self._find_name(own, i))
            if source is None or array.GetNumberOfTuples() < count:
                continue
            made = _make_zeros(array, count + len(places))
            made.CopyInformation(array.GetInformation())
            made.SetName(array.GetName())
            if count:
                made.InsertTuples(0, count, 0, array)
            made.InsertTuples(targets, sources, source)
            index, attribute = result.AddArray(made), own.IsArrayAnAttribute(i)
            if attribute >= 0:
                result.SetActiveAttribute(index, attribute)
        for i in range(flipped.GetNumberOfArrays() if count == 0 else 0):
            array = flipped.GetAbstractArray(i)
            if array.GetName() is not None and not self._joined.HasArray(array.GetName()):
                made = _make_zeros(array, len(places))
                made.InsertTuples(targets, sources, array)
                result.AddArray(made)


def join_constraints(sources):
    """One mesh of the edges of several: (constraints, mesh whose points they name or None). None if
    there are no edges."""
    edges, are_floats = [], True
    for constraints, mesh in sources:
        named = constraints if constraints.GetNumberOfPoints() else mesh
        if named is not None:
            points = view_points(named)
            edges.append(points[list_other_pairs(read_surface(constraints), len(points))].reshape(-1, 3))
            are_floats = are_floats and named.GetPoints().GetDataType() == VTK_FLOAT
    if sum(map(len, edges)) == 0:
        return None
    places = numpy.concatenate(edges).astype(numpy.float32 if are_floats else numpy.float64)
    joined, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(places, deep=True))
    joined.SetPoints(points)
    cells, corners = new_cells(numpy.full(len(places) // 2, 2), True)
    corners[:] = numpy.arange(len(places))
    joined.SetLines(cells)
    return joined


def _list_cells(mesh):
    """Verts, lines, polygons and strips: the order of cell ids."""
    lists, first = [], 0
    for array in (mesh.GetVerts(), mesh.GetLines(), mesh.GetPolys(), mesh.GetStrips()):
        lists.append(read_cells(array, "cell", first))
        first += lists[-1].count
    return lists


def _set_cells(mesh, arrays):
    for store, cells in zip((mesh.SetVerts, mesh.SetLines, mesh.SetPolys, mesh.SetStrips), arrays):
        store(cells)


def _take_cells(cells, owners, k):
    """(sizes, corners) of the cells of partition k."""
    chosen = numpy.flatnonzero(owners[cells.first:cells.first + cells.count] == k)
    return cells.sizes[chosen], cells.gather(chosen)


def _list_new(corners, local):
    """The points that the partition lacks, in the order in which its cells name them."""
    named = numpy.concatenate(corners).astype(numpy.int64)
    named = named[local[named] < 0]
    points, first = numpy.unique(named, return_index=True)
    return points[numpy.argsort(first)]


def _drop_duplicates(mesh):
    """The mesh without duplicate ghost cells; the mesh itself if it has none."""
    ghosts = find_ghosts(mesh)
    if ghosts is None:
        return mesh
    duplicates = numpy.flatnonzero(
        ghosts[:mesh.GetNumberOfCells()] & vtkDataSetAttributes.DUPLICATECELL)
    if len(duplicates) == 0:
        return mesh
    return _take_some(mesh, numpy.setdiff1d(numpy.arange(mesh.GetNumberOfCells()), duplicates))


def _take_some(mesh, chosen):
    """The mesh with some of its cells, of any size."""
    taken, arrays = vtkPolyData(), []
    taken.SetPoints(mesh.GetPoints())
    taken.GetPointData().ShallowCopy(mesh.GetPointData())
    taken.GetFieldData().ShallowCopy(mesh.GetFieldData())
    for kind, cells in zip(Surface.KINDS, _list_cells(mesh)):
        own = chosen[(chosen >= cells.first) & (chosen < cells.first + cells.count)] - cells.first
        array, corners = new_cells(cells.sizes[own], is_wide(getattr(mesh, "Get" + kind)()))
        corners[:] = cells.gather(own)
        arrays.append(array)
    _set_cells(taken, arrays)
    whole = take_whole_arrays(mesh)
    taken.GetCellData().CopyAllOn()
    taken.GetCellData().CopyAllocate(whole, len(chosen))
    taken.GetCellData().CopyData(whole, make_ids(chosen), make_ids(range(len(chosen))))
    return taken


def _is_same_kind(a, b):
    return (a.GetDataType() == b.GetDataType()
            and a.GetNumberOfComponents() == b.GetNumberOfComponents())


def _make_zeros(like, size):
    """An array of the same kind, of zeros or empty texts."""
    array = vtkAbstractArray.CreateArray(like.GetDataType())
    array.SetName(like.GetName())
    array.SetNumberOfComponents(like.GetNumberOfComponents())
    array.SetNumberOfTuples(size)
    if isinstance(array, vtkDataArray):
        array.Fill(0.0)
    return array

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The points of a mesh in several partitions, each once."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkPoints

from ._surface import split_strips
from ._vtk_arrays import read_cells, view, view_points


class PartitionPoints:
    """Finds the points that several partitions have: those with the same global id or, if a
    partition has no global ids, with equal coordinates if at least one of them is at the border of
    its partition. Points without cells are not compared.

    Attributes:
        ids: for each partition the numbers of its points among all.
        points: the vtkPoints, in the order of partitions.
        ambiguous: how many coincide with others of their partition, and with one of another.
    """

    def __init__(self, partitions):
        sizes = [mesh.GetNumberOfPoints() for mesh in partitions]
        self._first = numpy.cumsum([0] + sizes)
        self._same = numpy.arange(self._first[-1])
        self.ambiguous = 0
        self._join_places(partitions)
        is_first = self._same == numpy.arange(len(self._same))
        numbers = numpy.cumsum(is_first) - 1
        numbers = numbers[self._same]
        self.ids = [numbers[begin:begin + size] for begin, size in zip(self._first, sizes)]
        self.points = _take_points(partitions, is_first)

    def _join_places(self, partitions):
        places = _list_places(partitions)
        uses = [_find_use(mesh) for mesh in partitions]
        owners = numpy.repeat(numpy.arange(len(partitions)), numpy.diff(self._first))
        of_polygon = numpy.concatenate([use[1] for use in uses])
        at_border = numpy.concatenate([use[2] for use in uses])
        if places.dtype.kind == "i":
            at_border[:] = True
        chosen = numpy.flatnonzero(
            numpy.concatenate([use[0] for use in uses]) & (places == places).all(axis=1))
        order = chosen[numpy.lexsort([~of_polygon[chosen], *places[chosen].T[::-1]])]
        starts = numpy.flatnonzero(
            numpy.r_[True, (places[order[1:]] != places[order[:-1]]).any(axis=1)][:len(order)])
        for begin, end in zip(starts, numpy.r_[starts[1:], len(order)]):
            if end - begin > 1:
                self._join_place(order[begin:end], owners, of_polygon, at_border)

    def _join_place(self, points, owners, of_polygon, at_border):
        """`points` are those of one place; those of polygons come first."""
        chosen = []
        for point in points:
            if of_polygon[point] or owners[point] not in owners[chosen]:
                chosen.append(point)
        parts = owners[chosen]
        if len(set(parts)) < 2 or not at_border[chosen].any():
            return
        if len(set(parts)) < len(chosen):
            self.ambiguous += len(chosen)
        else:
            self._same[chosen] = min(chosen)


def _list_places(partitions):
    """(n, 3) coordinates of all points, or (n, 1) global ids."""
    numbers = [_read_numbers(mesh) for mesh in partitions]
    if any(ids is None for ids in numbers):
        places = numpy.concatenate([view_points(mesh).astype(float) for mesh in partitions])
        return places + 0.0  # -0 becomes 0
    return numpy.concatenate(numbers)[:, None]


def _read_numbers(mesh):
    """The global ids of the points, or None."""
    ids, count = mesh.GetPointData().GetGlobalIds(), mesh.GetNumberOfPoints()
    if count == 0:
        return numpy.empty(0, dtype=numpy.int64)
    if ids is None or ids.GetNumberOfComponents() != 1 or ids.GetNumberOfTuples() != count:
        return None
    return view(ids).astype(numpy.int64)


def _find_use(mesh):
    """Flags of each point: whether a line or a polygon has it; a polygon; and whether polygons do
    not close around it."""
    count = mesh.GetNumberOfPoints()
    of_polygon = numpy.zeros(count, dtype=bool)
    fans = numpy.zeros(count, dtype=numpy.uint64)
    polygons = read_cells(mesh.GetPolys(), "cell", 0)
    strips = split_strips(read_cells(mesh.GetStrips(), "cell", 0))
    for corners, offsets in ((polygons.corners, polygons.offsets),
                             (strips.ravel(), 3 * numpy.arange(len(strips) + 1))):
        of_polygon[corners] = True
        _add_corners(fans, corners.astype(numpy.int64), offsets)
    used = of_polygon.copy()
    used[read_cells(mesh.GetLines(), "cell", 0).corners] = True
    return used, of_polygon, (fans != 0) | ~of_polygon


def _add_corners(fans, corners, offsets):
    """Around a closed fan every neighbour is the next one once, and once the previous one."""
    first, last = offsets[:-1][numpy.diff(offsets) > 0], offsets[1:][numpy.diff(offsets) > 0] - 1
    following, previous = numpy.roll(corners, -1), numpy.roll(corners, 1)
    following[last], previous[first] = corners[first], corners[last]
    numpy.add.at(fans, corners, _scatter(following) - _scatter(previous))


def _scatter(ids):
    bits = ids.astype(numpy.uint64) * numpy.uint64(0x9E3779B97F4A7C15)
    bits = (bits ^ (bits >> numpy.uint64(30))) * numpy.uint64(0xBF58476D1CE4E5B9)
    return bits ^ (bits >> numpy.uint64(27))


def _take_points(partitions, chosen):
    """Those of all points that are chosen; double if those of a partition are."""
    are_doubles = any(mesh.GetPoints() and mesh.GetPoints().GetDataType() == VTK_DOUBLE
                      for mesh in partitions)
    kind = numpy.float64 if are_doubles else numpy.float32
    places = numpy.concatenate([view_points(mesh).astype(kind) for mesh in partitions])
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(places[chosen]), deep=True))
    return points

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The triangles of a vtkPolyData: the cell that contains each, and the output cell it becomes."""
import numpy

from . import _arrays, _library
from ._observers import Observers
from ._vtk_arrays import Cells

NONE = -1


class Slots:
    """Views of the triangles if all polygons are triangles and there are no strips; else the
    triangles into which polygons and strips are split.

    Attributes:
        triangles: (m, 3), views or copies.
        cells: (m,) the cell of each triangle.
        frozen: (m,) whether a triangle belongs to a cell that stays; None: none does.
        polygon_cells, polygon_triangles: for each polygon of the output the cell from which it is
            made, and its triangle, or NONE if the polygon is the whole cell.
        kept_strips: the cells that stay strips.
    """

    def __init__(self, mesh, points, triangulate, progress):
        self.first_polygon = mesh.GetNumberOfVerts() + mesh.GetNumberOfLines()
        self.first_strip = self.first_polygon + mesh.GetNumberOfPolys()
        for cells, first in ((mesh.GetVerts(), 0), (mesh.GetLines(), mesh.GetNumberOfVerts())):
            Cells(cells, "cell", first)
        strips = Cells(mesh.GetStrips(), "cell", self.first_strip)
        polygons = Cells(mesh.GetPolys(), "cell", self.first_polygon)
        self.in_place = strips.count == 0 and polygons.are_triangles()
        if self.in_place:
            self._view(polygons)
            return
        polygons.require_points(len(points))
        strips.require_points(len(points))
        parts = (_split(polygons, points, triangulate, progress), _split_strips(strips, triangulate))
        self._join(parts, triangulate)
        self.kept_strips = strips.first + numpy.flatnonzero(_stay(strips.sizes, triangulate, 2))

    def _view(self, polygons):
        self.triangles = polygons.corners.reshape(-1, 3)
        self.cells = self.polygon_cells = self.first_polygon + numpy.arange(polygons.count)
        self.polygon_triangles = numpy.arange(polygons.count)
        self.frozen = None
        self.kept_strips = numpy.empty(0, dtype=int)
        self.divides_cells = False

    def _join(self, parts, triangulate):
        self.triangles = numpy.concatenate([part.triangles for part in parts])
        self.cells = numpy.concatenate([part.cells for part in parts])
        self.frozen = numpy.concatenate([part.frozen for part in parts])
        before = numpy.cumsum([0] + [len(part.triangles) for part in parts])
        lists = [part.list_output(start) for part, start in zip(parts, before)]
        self.polygon_cells = numpy.concatenate([cells for cells, _ in lists])
        self.polygon_triangles = numpy.concatenate([triangles for _, triangles in lists])
        self.divides_cells = any(((part.counts > 1) & ~part.stays).any() for part in parts)

    @property
    def are_polygons_triangles(self):
        """Whether each output polygon i is triangle i, and there are no others."""
        return self.in_place or (len(self.polygon_cells) == len(self.triangles)
                                 and bool((self.polygon_triangles != NONE).all()))


class _Part:
    """The triangles of the polygons or of the strips. `counts` has their number for each cell.
    Cells that stay are split into triangles too, which are frozen."""

    def __init__(self, cells, triangles, counts, stays, stay_as_polygons):
        ids = cells.first + numpy.arange(cells.count)
        self.triangles, self.counts, self.stays = triangles, counts, stays
        self.cells = numpy.repeat(ids, counts)
        self.frozen = numpy.repeat(stays, counts)
        self._ids = ids
        self._stay_as_polygons = stay_as_polygons

    def list_output(self, before):
        """(cells, triangles) of the output's polygons, after the first `before` triangles."""
        rows = numpy.where(self.stays, int(self._stay_as_polygons), self.counts)
        starts = before + numpy.cumsum(self.counts) - self.counts
        steps = numpy.arange(rows.sum()) - numpy.repeat(numpy.cumsum(rows) - rows, rows)
        triangles = numpy.where(numpy.repeat(self.stays, rows), NONE,
                                numpy.repeat(starts, rows) + steps)
        return numpy.repeat(self._ids, rows), triangles


def _stay(sizes, triangulate, largest):
    """Which cells stay as they are: those without area, and those that are not to be split."""
    return (sizes < 3) | ((sizes > largest) & (not triangulate))


def _split(polygons, points, triangulate, progress):
    counts = numpy.maximum(polygons.sizes - 2, 0)
    triangles = numpy.empty((int(counts.sum()), 3), dtype=numpy.int64)
    mesh = _arrays.Mesh(points, numpy.empty((0, 3), dtype=numpy.int64))
    offsets = numpy.ascontiguousarray(polygons.offsets, dtype=numpy.int64)
    corners = numpy.ascontiguousarray(polygons.corners, dtype=numpy.int64)
    struct = _library.Polygons()
    _library.library().delaunayflip_polygons_init(struct)
    struct.number_of_polygons = polygons.count
    struct.offsets, struct.corners = _arrays.address(offsets), _arrays.address(corners)
    with Observers(progress).raising() as callbacks:
        _library.call("split_polygons", mesh.struct, struct, callbacks, _arrays.address(triangles))
    return _Part(polygons, triangles, counts, _stay(polygons.sizes, triangulate, 3), True)


def _split_strips(strips, triangulate):
    counts = numpy.maximum(strips.sizes - 2, 0)
    return _Part(strips, split_strips(strips), counts, _stay(strips.sizes, triangulate, 2), False)


def split_strips(strips):
    """(m, 3) the triangles of strips, which are Cells."""
    counts = numpy.maximum(strips.sizes - 2, 0)
    steps = numpy.arange(counts.sum()) - numpy.repeat(numpy.cumsum(counts) - counts, counts)
    first = numpy.repeat(strips.offsets[:-1], counts) + steps
    odd = steps % 2  # every other triangle of a strip is wound the other way
    places = numpy.stack([first + odd, first + 1 - odd, first + 2], axis=1)
    return strips.corners[places].astype(numpy.int64).reshape(-1, 3)

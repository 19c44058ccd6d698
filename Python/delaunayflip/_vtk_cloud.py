# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts points and segments of any VTK to arrays for `triangulate`, and the result back."""
import numpy

from ._arrays import address
from ._points import Input
from ._report import FIELD_PREFIX, POINT_COUNTS, Totals
from ._surface import list_pairs, number_places
from ._vtk_mesh import demote_global_ids, describe_short, vtk_of

OUTLINES = ("even-odd", "orientation")


class Cloud(Input):
    """The points of a dataset, and those of its segments, for `triangulate`; and the way back."""

    def __init__(self, data, others=None, lines_as_segments=False, outline="even-odd"):
        self.vtk, self.data = vtk_of(data), data
        mesh = self.vtk.model.vtkPolyData()
        mesh.SetPoints(data.GetPoints())
        if lines_as_segments and data.IsA("vtkPolyData"):
            mesh.SetVerts(data.GetVerts())  # so that lines have their cell ids
            mesh.SetLines(data.GetLines())
        own = self.vtk.read(mesh)
        self._own, self._sources, self._pairs, self._numbers = own.points, [], [], []
        self._others = others
        self._add_cells(own.read("Lines", "line, cell"), numpy.arange(len(own.points)))
        if others is not None:
            theirs = self.vtk.read(others)
            ids = self._add_points(theirs.points)
            self._add_cells(theirs.read("Lines", "segment cell"), ids)
            self._add_cells(theirs.read("Polys", "segment cell"), ids, are_rings=True)
        super().__init__(self._own, numpy.concatenate(self._pairs), None, None)
        self._numbers = numpy.concatenate(self._numbers).astype(numpy.int32)
        self.struct.rings, self.struct.outline = address(self._numbers), OUTLINES.index(outline)

    def _add_cells(self, cells, ids, are_rings=False):
        cells.require_points(len(ids))
        pairs = ids[list_pairs(cells, are_rings)]
        is_ring = are_rings & (cells.sizes > 2)
        numbers = numpy.where(is_ring, cells.first + numpy.arange(cells.count), -1)
        numbers = numpy.repeat(numbers, numpy.maximum(cells.sizes - ~is_ring, 0))
        kept = pairs[:, 0] != pairs[:, 1]
        self._pairs.append(pairs[kept])
        self._numbers.append(numbers[kept])

    def _add_points(self, others):
        """The ids of the points of the segments; those at new places are added."""
        own = self._own
        if len(others) == 0 or own.dtype == others.dtype and own.tobytes() == others.tobytes():
            return numpy.arange(len(own))
        places = numpy.concatenate(number_places(own, others))
        _, first, place = numpy.unique(places, return_index=True, return_inverse=True)
        ids = first[place.ravel()[len(own):]]
        is_new = ids >= len(own)
        self._sources, ranks = numpy.unique(ids[is_new] - len(own), return_inverse=True)
        ids[is_new] = len(own) + ranks.ravel()
        self._own = numpy.concatenate([own, others[self._sources].astype(own.dtype)])
        return ids

    def write(self, result, output):
        """Writes the mesh, with its data and its counts. Returns the text of a warning, or ""."""
        data, vtk, report = self.data, self.vtk, result.report
        count, is_grown = data.GetNumberOfPoints(), len(result.points) > data.GetNumberOfPoints()
        polygons, corners = vtk.make_cells(numpy.full(len(result.triangles), 3), is_wide=True)
        corners[:] = result.triangles.ravel()
        output.SetPolys(polygons)
        output.SetPoints(data.GetPoints())
        output.GetFieldData().ShallowCopy(data.GetFieldData())
        output.GetPointData().ShallowCopy(data.GetPointData())
        if is_grown:
            points = vtk.core.vtkPoints()
            points.SetData(vtk.support.numpy_to_vtk(result.points, deep=True))
            output.SetPoints(points)
            self._extend_data(output.GetPointData(), count)
        counts = [(name, getattr(report, field)) for name, field in POINT_COUNTS.items()]
        vtk.add_arrays(output.GetFieldData(), FIELD_PREFIX,
                       [*counts, *Totals.of_run(report, result.iterations).list_fields()])
        texts = [report.defects] if report.defects else []
        texts += describe_short(data.GetPointData(), count, "point",
                                "left out" if is_grown else "passed unchanged")
        return "; ".join(texts)

    def _extend_data(self, data, count):
        """The point data, extended by those of added points."""
        first, size = count + len(self._sources), count + len(self._sources) + len(self.ends)
        data.Initialize()
        self.vtk.add_tuples(self.data.GetPointData(), count, range(count), 0, size, data)
        if len(self._sources):
            others = self._others
            self.vtk.add_tuples(
                others.GetPointData(), others.GetNumberOfPoints(), self._sources, count, size, data)
        for array in [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]:
            for place, (start, end, share) in enumerate(self.ends, first):
                array.InterpolateTuple(place, int(start), array, int(end), array, share)
        demote_global_ids(data)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts points and segments of any VTK to the engine's arrays, and back."""
import itertools

import numpy

from . import _arrays
from ._library import InvalidOptions
from ._points import Input, interpolate_in_survey
from ._report import FIELD_PREFIX, POINT_NUMBERS, Totals
from ._surface import join_corners, number_places
from ._vtk_data import (
    GHOST_ARRAY, add_attributes, demote_global_ids, describe_short, find_attributes, is_among, list_arrays,
    list_names, pass_points, vtk_of)

HEIGHTS = None, "survey", "own"  #: SegmentHeights


class PointsInput(Input):
    """The points of a dataset, and those of its segments, for `triangulate`; and the way back."""

    def __init__(self, data, others=None, *, lines_as_segments=False, closed_lines_as_rings=True,
                 pass_segments=False, first_hole=-1, heights=None, height_array="", as_doubles=False,
                 size_array="", backend=None, projection=0, **rings):
        """`others`: the second input of the filter, or pairs of point ids. `heights`: SegmentHeights.
        `height_array`: where those of segments are not finite, they become those of the points there.
        `pass_segments`: whether the mesh gets the edges along segments. `as_doubles`: whether data become
        doubles, so that those of added points are not rounded. `size_array`: SizeArray. `projection`: that
        of the struct. `backend`: keywords that say where data are found. `rings`: outline, holes,
        hole_seeds and ring_rule, as for triangulate."""
        self.vtk, self.data = vtk_of(data), data
        mesh = self.vtk.model.vtkPolyData()
        mesh.SetPoints(data.GetPoints())
        if lines_as_segments and data.IsA("vtkPolyData"):
            mesh.SetVerts(data.GetVerts())  # so that lines have their cell ids
            mesh.SetLines(data.GetLines())
        own = self.vtk.read(mesh)
        self._own, self._sources, self._pairs, self._numbers, self._cells = own.points, [], [], [], []
        self._others, self._passes_segments = others, pass_segments
        if hasattr(others, "GetPolys"):
            self._first_own = others.GetNumberOfCells()
        else:
            self._first_own = 0 if others is None else len(others)
        self._first_ring = self._first_own + mesh.GetNumberOfCells()
        self._add_cells(own.read("Lines", "line, cell"), numpy.arange(len(own.points)), False)
        if hasattr(others, "GetPolys"):
            theirs = self.vtk.read(others)
            ids = self._add_points(theirs.points)
            self._add_cells(theirs.read("Lines", "segment cell"), ids, closed_lines_as_rings)
            self._add_cells(theirs.read("Polys", "segment cell"), ids, are_polygons=True)
        elif others is not None:
            self._pairs.append(_arrays.as_ids("segments", others, 2))
            self._numbers.append(numpy.full(len(self._pairs[-1]), -1))
            self._cells.append(numpy.arange(len(self._pairs[-1])))
        self._cells[0] += self._first_own
        super().__init__(self._own, numpy.concatenate(self._pairs),
                         ring_numbers=numpy.concatenate(self._numbers), **rings)
        if first_hole >= 0:
            self.struct.first_hole = min(first_hole, numpy.iinfo(numpy.int32).max)
        self.struct.first_added = data.GetNumberOfPoints()
        own = len(self._pairs[0])
        self.find_flat_points(
            data.GetNumberOfPoints(), self.all_segments[own:], self.all_rings[own:])
        self.take_projection(projection)
        self._surveyed = []  # (name, ids, values) of each array of added points
        self._read_data = self._as_doubles if as_doubles else lambda data: data
        self._theirs, self._received = self._match_theirs()
        self._choose_heights(heights, height_array, backend or {})
        if size_array:
            self._read_sizes(size_array)

    def _choose_heights(self, heights, height_array, backend):
        """Gives added points the heights that are asked for, and data in arrays that the segments do not
        have, interpolated between the points of the dataset."""
        count, data = self.data.GetNumberOfPoints(), self.data.GetPointData()
        added = numpy.arange(count, len(self.points))
        if heights == "survey" and self.struct.projection:
            raise InvalidOptions("SegmentHeights: the heights of the survey are for x and y; with another "
                                 "projection choose Own")
        lifted = self.choose_lifted(heights, added)
        labels = data.GetGlobalIds(), data.GetPedigreeIds(), data.GetAbstractArray(GHOST_ARRAY)
        names = [array.GetName() for array in list_arrays(data)
                 if array.GetName() and array.IsNumeric() and array.GetNumberOfTuples() >= count
                 and not is_among(array, labels)
                 and (array.GetName() == height_array or array.GetName() not in self._received)]
        if count == 0 or len(added) == 0 or not (len(lifted) or names):
            return
        columns = [self.points[:count, 2:]]
        columns += [self.vtk.view(data.GetArray(name))[:count].reshape(count, -1) for name in names]
        values = numpy.concatenate([column.astype(float) for column in columns], axis=1)
        found = interpolate_in_survey(
            self.points[:count], values, self.points[added], backend, self.struct.projection)
        if found is None:
            return
        self.points[lifted, 2] = found[lifted - count, 0]
        ends = numpy.cumsum([column.shape[1] for column in columns])
        self._surveyed = list(zip(names, itertools.repeat(added), numpy.split(found, ends, axis=1)[1:]))
        self.are_lifted = len(lifted) > 0

    def _read_sizes(self, name):
        """Finds the longest edges near points. Near those that have no number there is no limit."""
        own, count = self.data.GetPointData(), self.data.GetNumberOfPoints()
        theirs = self._theirs.GetArray(name) if name in self._received else None
        arrays = [array for array in (own.GetArray(name), theirs) if array is not None]
        if not arrays:
            raise InvalidOptions(f'SizeArray: the input has no point array of numbers named "{name}"; '
                                 f"{list_names(own)}.")
        if any(array.GetNumberOfComponents() != 1 for array in arrays) or (
                own.GetArray(name) and own.GetArray(name).GetNumberOfTuples() < count):
            raise InvalidOptions(f'SizeArray: "{name}" must have one component, and as many tuples as there '
                                 "are points.")
        sizes = numpy.full(len(self.points), numpy.nan)
        if own.GetArray(name):
            sizes[:count] = self.vtk.view(own.GetArray(name))[:count]
        if theirs is not None:
            sizes[count:] = self.vtk.view(theirs)[self._sources]
        for surveyed, ids, values in self._surveyed:
            if surveyed == name:
                sizes[ids] = values[:, 0]
        self.take_sizes(sizes)

    def _add_cells(self, cells, ids, closed_lines_as_rings=False, are_polygons=False):
        cells.require_points(len(ids))
        is_ring = numpy.full(cells.count, are_polygons)
        returns = is_ring.copy()
        if closed_lines_as_rings or are_polygons:
            some = numpy.flatnonzero(cells.sizes > 0)
            first, last = (ids[cells.corners[ends]] for ends in (
                cells.offsets[some], cells.offsets[some] + cells.sizes[some] - 1))
            if are_polygons:  # without those that end where they begin
                returns[some] = (first != last) | (cells.sizes[some] == 1)
            else:
                is_ring[some] = ((first == last) | (self._own[first] == self._own[last]).all(axis=1)) & (
                    cells.sizes[some] > 2)
        pairs = ids[join_corners(cells, returns)]
        ids_of_cells = cells.first + numpy.arange(cells.count)
        counts = numpy.maximum(cells.sizes - ~returns, 0)
        numbers = numpy.repeat(numpy.where(is_ring, ids_of_cells, -1), counts)
        kept = (pairs[:, 0] != pairs[:, 1]) | (numbers >= 0)
        self._pairs.append(pairs[kept])
        self._numbers.append(numbers[kept])
        self._cells.append(numpy.repeat(ids_of_cells, counts)[kept])

    def _add_points(self, others):
        """The ids of the points of the segments; those at new places are added."""
        own = self._own if len(self._own) else others[:0]  # of the same type
        if len(others) == 0 or own.dtype == others.dtype and own.tobytes() == others.tobytes():
            return numpy.arange(len(own))
        places = numpy.concatenate(number_places(own, others))
        _, first, place = numpy.unique(places, return_index=True, return_inverse=True)
        ids = first[place.ravel()[len(own):]]
        is_new = ids >= len(own)
        self._sources, ranks = numpy.unique(ids[is_new] - len(own), return_inverse=True)
        ids[is_new] = len(own) + ranks.ravel()
        with numpy.errstate(over="ignore"):
            self._own = numpy.concatenate([own, others[self._sources].astype(own.dtype)])
        return ids

    def write(self, result, output):
        """Writes the mesh, with its data and its counts. Returns the text of a warning, or ""."""
        data, vtk, report = self.data, self.vtk, result.report
        count, is_grown = data.GetNumberOfPoints(), len(result.points) > data.GetNumberOfPoints()
        polygons, corners = vtk.make_cells(numpy.full(len(result.triangles), 3), is_wide=True)
        corners[:] = result.triangles.ravel()
        output.SetPolys(polygons)
        pass_points(data, output)
        if is_grown:
            points = vtk.core.vtkPoints()
            points.SetData(vtk.support.numpy_to_vtk(result.points, deep=True))
            output.SetPoints(points)
            self._extend_data(output.GetPointData(), count)
        lines = numpy.empty(0, dtype=numpy.int32)
        if self._passes_segments:
            self._write_segments(result, output)
            lines = numpy.zeros(len(result.segments), dtype=numpy.int32)
        if self.struct.number_of_regions:
            regions = numpy.concatenate([lines, result.regions])
            vtk.add_arrays(output.GetCellData(), "", [("Region", regions)])
        totals = Totals.of_run(report, result.iterations)
        vtk.add_arrays(output.GetFieldData(), FIELD_PREFIX,
                       [*totals.list_numbers(POINT_NUMBERS), *totals.list_fields()])
        texts = [report.defects] if report.defects else []
        texts += describe_short(data.GetPointData(), count, "point",
                                "left out" if is_grown else "passed unchanged")
        if len(self._sources):
            texts += describe_short(self._others.GetPointData(), self._others.GetNumberOfPoints(),
                                     "point", "left out", " of the second input")
        return "; ".join(texts)

    def _write_segments(self, result, output):
        """Writes the edges that segments have become, as lines, and the ids of their cells. Rings that are
        no cells have the next numbers."""
        given = sum(map(len, self._cells))
        first_ring = self.all_rings[:given].max(initial=-1) + 1
        ids = numpy.concatenate([*self._cells, self._first_ring + self.all_rings[given:] - first_ring, [-1]])
        lines, ends = self.vtk.make_cells(numpy.full(len(result.segments), 2), is_wide=True)
        ends[:] = result.segments.ravel()
        output.SetLines(lines)
        triangles = numpy.full(len(result.triangles), -1)
        of_cells = numpy.concatenate([ids[result.segment_numbers], triangles])
        self.vtk.add_arrays(output.GetCellData(), "", [("SegmentIds", of_cells)])
        self.vtk.add_arrays(output.GetPointData(), "", [("SegmentIds", ids[result.point_segments])])

    def _is_real(self, array):
        return array.GetDataType() in (self.vtk.core.VTK_FLOAT, self.vtk.core.VTK_DOUBLE)

    def _turn_numbers(self, data, find_type):
        """A copy with other arrays for those of numbers, except labels. `find_type`: the type that an array
        becomes, from the array."""
        copy = self.vtk.model.vtkPointData()
        copy.ShallowCopy(data)
        labels = copy.GetGlobalIds(), copy.GetPedigreeIds(), copy.GetAbstractArray(GHOST_ARRAY)
        for array in list_arrays(copy):
            if not array.GetName() or not array.IsNumeric() or is_among(array, labels):
                continue
            kind = find_type(array)
            if kind != array.GetDataType():
                turned = self.vtk.core.vtkDataArray.CreateDataArray(kind)
                turned.DeepCopy(array)
                attributes = find_attributes(copy, array)
                add_attributes(copy, copy.AddArray(turned), attributes)
        return copy

    def _as_doubles(self, data):
        """A copy with arrays of doubles for those of integers, so that what is interpolated is not
        rounded."""
        return self._turn_numbers(
            data, lambda array: array.GetDataType() if self._is_real(array) else self.vtk.core.VTK_DOUBLE)

    def _match_theirs(self):
        """The point data of the segments that add points, as float or double where an array of that name of
        the dataset is, and the names of the arrays in which added points have these values."""
        if not len(self._sources):
            return None, set()
        count, own = self.data.GetNumberOfPoints(), self._read_data(self.data.GetPointData())
        like = {array.GetName(): array for array in list_arrays(own) if array.GetNumberOfTuples() >= count}

        def find_type(array):
            other = like.get(array.GetName(), array)
            return other.GetDataType() if self._is_real(other) else array.GetDataType()

        def is_received(array):
            other = like.get(array.GetName(), array)
            return array.GetNumberOfTuples() >= self._others.GetNumberOfPoints() and (
                array.GetDataType(), array.GetNumberOfComponents()) == (
                    other.GetDataType(), other.GetNumberOfComponents())

        theirs = self._turn_numbers(self._read_data(self._others.GetPointData()), find_type)
        return theirs, {array.GetName() for array in list_arrays(theirs) if is_received(array)}

    def _extend_data(self, data, count):
        """The point data, extended by those of added points."""
        size = len(self.points) + len(self.added[0])
        data.Initialize()
        own = self._read_data(self.data.GetPointData())
        self.vtk.add_tuples(own, count, range(count), 0, size, data)
        if len(self._sources):
            self.vtk.add_tuples(
                self._theirs, self._others.GetNumberOfPoints(), self._sources, count, size, data)
        for name, ids, values in self._surveyed:
            numbers = self.vtk.view(data.GetArray(name))
            if numbers.dtype.kind != "f":
                values = numpy.nan_to_num(numpy.trunc(values + numpy.copysign(0.5, values)))
            rows = numbers.reshape(size, -1)
            is_known = numpy.isfinite(rows[ids])
            is_known[len(self._sources) if name in self._received else 0:] = False
            rows[ids] = numpy.where(is_known, rows[ids], values)
        self.vtk.interpolate_tuples(data, len(self.points), *self.added)
        demote_global_ids(data)

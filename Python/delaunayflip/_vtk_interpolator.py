# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter for values at places, for every VTK with Python: see _vtk_filter."""
import math

import numpy
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkDataSet, vtkImageData, vtkPointSet, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from . import _library
from ._ask import METHODS, Field, Places, read_places
from ._vtk_blocks import copy_data, find_leaves, list_blocks
from ._vtk_data import (
    add_attributes, describe_latitudes, find_attributes, is_among, keep_heights, list_arrays, vtk_of)
from ._vtk_filter import _drop_results
from ._vtk_point_filter import vtkDelaunayFlipPoints
from ._vtk_properties import Property, finish

_MASK = "vtkValidPointMask"  # as vtkProbeFilter calls it


class vtkDelaunayFlipInterpolator(vtkDelaunayFlipPoints):
    """Gives a dataset the data of points, interpolated in their Delaunay triangulation.

    This class has the methods, outputs and warnings of the C++ class vtkDelaunayFlipInterpolator, for a
    VTK that it was not built for; vtkDelaunayFlipInterpolator.h is its manual. It triangulates anew in
    every update, and leaves out transforms and the best-fitting plane.
    """

    name = "vtkDelaunayFlipInterpolator"
    kind, others, keeps_type = vtkDataSet, (vtkPointSet, vtkPolyData), True
    size_of_others = vtkDataObject.POINT
    no_mesh = "is no dataset, passed unchanged"
    no_composite = "the source of a single dataset cannot be a composite dataset"

    def SetSourceConnection(self, port):
        self.SetInputConnection(1, port)

    def SetSourceData(self, source):
        self.SetInputDataObject(1, source)

    def GetOutput(self, port=0):
        """The first input with values; None if the output is composite (see GetOutputDataObject)."""
        return vtkDataSet.SafeDownCast(self.GetOutputDataObject(port))

    def RequestUpdateExtent(self, request, inInfo, outInfo):
        """The places are asked for as the output is. All of the source is needed for any of them."""
        asked = vtkStreamingDemandDrivenPipeline
        for vector in inInfo[1:]:
            info = vector.GetInformationObject(0)
            if info is not None:
                info.Set(asked.UPDATE_PIECE_NUMBER(), 0)
                info.Set(asked.UPDATE_NUMBER_OF_PIECES(), 1)
                info.Set(asked.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
                if info.Has(asked.WHOLE_EXTENT()):  # else the executive copies that of the places
                    info.Set(asked.UPDATE_EXTENT(), info.Get(asked.WHOLE_EXTENT()), 6)
        return 1

    def _warn_of_misfits(self, places, _):
        segments = self.GetInputDataObject(2, 0) if self.GetNumberOfInputConnections(2) else None
        self._segments = None if segments is None else copy_data(segments)
        self._prepared_place = self._prepared = None
        super()._warn_of_misfits(places, self._segments, "third input")

    def _judge_partitions(self, leaves, sources):
        has_places = any(isinstance(data, self.kind) for _, data in leaves)
        if has_places and not sources:
            raise _library.InvalidMesh("the source has no points (vtkPointSet) at the same place")
        if has_places and len(sources) > 1:
            raise _library.InvalidMesh(
                "the source is in several partitions; join them first, by vtkAppendDataSets, or Merge "
                "Blocks in ParaView")

    def _pass(self, places, output, stop_reason):
        self._totals.change(stop_reason=stop_reason)
        output.ShallowCopy(places)
        return ""

    def _flip(self, places, source, output):
        if source is None:
            raise _library.InvalidMesh("the source has no points (vtkPointSet) at the same place")
        trouble = ""
        if self._prepared_place != self._place or not self._place:
            self._prepared_place, self._prepared = self._place, None
            trouble = self._prepare(_drop_results(source))
        if self._prepared is None:
            return self._pass(places, output, "aborted") or trouble
        result, columns = self._prepared
        given, count = self._read_places(places), places.GetNumberOfPoints()
        if result is None:
            found = numpy.full((1, columns.width), math.nan), numpy.full(1, -1)
            self._require_inside(found[1], given, count)
            self._totals.change(stop_reason="converged")
            return self._write(places, columns, found, output)
        try:
            found = self._ask(result, given, columns)
        except _library.Stopped:
            return self._pass(places, output, "aborted") or trouble
        self._require_inside(found[1], given, count)
        return self._write(places, columns, found, output) or trouble

    def _require_inside(self, triangles, given, count):
        """Fails if that is wanted and places are in no triangle. If some of these are not finite, it tells of
        them alone. `triangles`: those of the places, which come again until there are `count`."""
        if self.outside != self.OUTSIDE_ERROR or not count:
            return
        is_told, what = numpy.resize(triangles < 0, count), "outside of the triangulation"
        if len(given.like):  # the cells of a raster are finite
            axes = 3 if self._find_projection() and not self.degrees else 2
            is_unusable = is_told & ~numpy.isfinite(given.like[:, :axes]).all(axis=1)
            if is_unusable.any():
                is_told, what = is_unusable, "NaN or infinite"
        told = numpy.flatnonzero(is_told)
        if len(told):
            raise _library.InvalidMesh(
                f"{len(told)} of {count} places {'is' if len(told) == 1 else 'are'} {what} (first: {told[0]})")

    def _prepare(self, source):
        """Makes the Triangulation of a block, which its partitions share, and its Columns. Without points
        there is no Triangulation; after an abort there is neither. Returns the text of a warning, or ""."""
        given, mesh = source, vtkPolyData()
        if source.GetNumberOfPoints() == 0:
            self._warnings.append((self._where, "the source has no points, so there are no values"))
        source = self._take_places(given)
        elevation = height_array = self._choose_arrays(source)
        segments = self._take_segments(self._find_segments(), elevation)
        if elevation and source is not given:
            keep_heights(given, elevation, source.GetPointData(), True)
            elevation = ""
        count = source.GetNumberOfPoints() + (segments.GetNumberOfPoints() if segments else 0)
        if count == 0:
            self._prepared = None, Columns(source, source, elevation)
            return ""
        if self._is_abort_requested():
            return ""
        result, trouble = self._triangulate(
            source, segments, mesh, self._observe_part(0.5), keeps=True, has_heights=bool(elevation),
            height_array=height_array)
        if result.report.stop_reason != "aborted":
            self._prepared = result, Columns(source, mesh, elevation)
        return trouble

    def _find_segments(self):
        if isinstance(self._segments, vtkCompositeDataSet) and not self._place:
            raise _library.InvalidOptions("the segments of a single dataset cannot be a composite dataset")
        segments = find_leaves(
            list_blocks(self._segments, vtkDataObject.CELL), self._place, vtkPolyData)
        self._require_one(segments)
        return segments[0] if segments else None

    def _choose_arrays(self, source):
        """Removes what is not interpolated from the source. Returns the name of the array of z."""
        data = source.GetPointData()
        labels = data.GetGlobalIds(), data.GetPedigreeIds(), data.GetAbstractArray("vtkGhostType")
        names, arrays = [], list_arrays(data)
        for number, array in reversed(list(enumerate(arrays))):
            is_label = is_among(array, labels)
            is_usable = array.IsNumeric() and array.GetNumberOfTuples() >= source.GetNumberOfPoints()
            if not is_label and not is_usable:
                names.insert(0, f'"{array.GetName() or ""}"')
            if is_label or not is_usable:
                data.RemoveArray(number)
        if names:
            self._warnings.append((
                self._where, "point arrays of the source left out, which have no numbers or too few tuples: "
                + ", ".join(names)))
        elevation = self.GetElevationArray()
        if self._find_projection() and not self.degrees:
            return ""  # z is one of three coordinates
        if elevation and data.HasArray(elevation):
            self._warnings.append((
                self._where, f'z of the source left out, because the source has an array "{elevation}"; give '
                "ElevationArray another name"))
            return ""
        return elevation

    def _read_places(self, places):
        if not self._find_projection():
            return read_dataset(places)
        read = read_dataset(places, may_be_raster=self.degrees)
        read.members["degrees"] = int(self.degrees)
        has_angles = self.degrees and isinstance(places, vtkPointSet) and len(read.like)
        trouble = describe_latitudes(read.like[:, 1]) if has_angles else ""
        if trouble:
            self._warnings.append((self._where, trouble))
        return read

    def _ask(self, result, places, columns):
        """The values at places, and their triangles."""
        answers = result._answers
        field = columns.width and Field(
            answers, columns.gather(), method=METHODS[self.method], fill_value=math.nan,
            outside="nearest" if self.outside == self.OUTSIDE_NEAREST else "nan")
        before, length = self._block
        self._block = before + 0.5 * length, 0.5 * length
        triangles, values = answers.ask(places, field, True, self._observe_part(1.0))
        return values, triangles

    def _write(self, places, columns, found, output):
        """`found`: values and triangles at places, which come again until there are enough."""
        output.ShallowCopy(places)
        values, triangles = found
        rows = numpy.arange(places.GetNumberOfPoints()) % max(len(triangles), 1)
        columns.scatter(None if values is None else values[rows], output.GetPointData())
        core, support = vtk_of(output).core, vtk_of(output).support
        mask = support.numpy_to_vtk((triangles[rows] >= 0).astype(numpy.int8), True, core.VTK_CHAR)
        mask.SetName(_MASK)
        output.GetPointData().AddArray(mask)
        return ""


def read_dataset(dataset, may_be_raster=True):
    """The points of a dataset as Places, after which they come again."""
    count, members = dataset.GetNumberOfPoints(), {}
    if may_be_raster and isinstance(dataset, vtkImageData) and count:
        columns, rows, _ = dataset.GetDimensions()
        extent, origin, step = dataset.GetExtent(), dataset.GetOrigin(), dataset.GetSpacing()
        # Else its coordinates are rounded in another way.
        if extent[0] == extent[2] == 0 and dataset.GetDirectionMatrix().IsIdentity():
            members = {"rows": rows, "columns": columns, "origin_x": origin[0], "origin_y": origin[1],
                       "step_x": step[0], "step_y": step[1]}
            return Places(members, (rows * columns,), numpy.empty(0))
    if isinstance(dataset, vtkPointSet):
        mesh = vtk_of(dataset).model.vtkPolyData()
        mesh.SetPoints(dataset.GetPoints())
        points = vtk_of(dataset).read(mesh).points
    else:
        points = numpy.array([dataset.GetPoint(i) for i in range(count)]).reshape(-1, 3)
    return read_places([points])


class Columns:
    """The arrays that are interpolated: those of a source, as a mesh has them, and z."""

    def __init__(self, source, mesh, elevation):
        self._mesh, self._elevation, self._vtk = mesh, elevation, vtk_of(source)
        self._arrays = list_arrays(mesh.GetPointData())[:source.GetPointData().GetNumberOfArrays()]
        self._widths = [array.GetNumberOfComponents() for array in self._arrays]
        self.width = sum(self._widths) + bool(elevation)

    def gather(self):
        """The values of all points."""
        count = self._mesh.GetNumberOfPoints()
        columns = [self._vtk.view(array)[:count].reshape(count, -1) for array in self._arrays]
        if self._elevation:
            columns.append(self._vtk.view(self._mesh.GetPoints().GetData())[:, 2:])
        return numpy.concatenate([column.astype(float) for column in columns], axis=1)

    def scatter(self, values, output):
        """Writes the arrays of values at places; None: there are none. Those that they or the mask
        replace take their attributes along."""
        first = 0
        for name in (*(array.GetName() for array in self._arrays), self._elevation, _MASK):
            output.RemoveArray(name or "")
        for like, width in zip(self._arrays, self._widths):
            kind = numpy.float32 if like.GetDataType() == self._vtk.core.VTK_FLOAT else float
            array = self._vtk.support.numpy_to_vtk(
                numpy.ascontiguousarray(values[:, first:first + width], kind), True)
            if width == 1:
                array = self._vtk.support.numpy_to_vtk(values[:, first].astype(kind), True)
            array.SetName(like.GetName())
            array.CopyComponentNames(like)
            array.CopyInformation(like.GetInformation())
            array.SetLookupTable(like.GetLookupTable())
            attributes = find_attributes(self._mesh.GetPointData(), like)
            add_attributes(output, output.AddArray(array), attributes)
            first += width
        if self._elevation:
            array = self._vtk.support.numpy_to_vtk(values[:, first].copy(), True)
            array.SetName(self._elevation)
            add_attributes(output, output.AddArray(array), [output.SCALARS])


finish(vtkDelaunayFlipInterpolator, (
    Property("Method", 0, 0, 1, ("Linear", "Natural")),
    Property("Outside", 0, 0, 2, ("Nan", "Nearest", "Error")),
    Property("ElevationArray", "Elevation"),
), {})

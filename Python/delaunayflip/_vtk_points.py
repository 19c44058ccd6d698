# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkDelaunayFlipPoints for every VTK with Python, on `triangulate`."""
from vtkmodules.vtkCommonCore import VTK_DOUBLE_MAX
from vtkmodules.vtkCommonDataModel import vtkPointSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from ._library import InvalidMesh
from ._options import CHOICES
from ._points import triangulate
from ._report import Totals
from ._vtk_cloud import OUTLINES, Cloud
from ._vtk_filter import Filter, Property, count_answers, finish
from ._vtk_update import Update


class _PointUpdate(Update):

    def _judge_partitions(self):
        raise InvalidMesh("the points are in several partitions; join them first, by vtkAppendDataSets, or "
                          "Merge Blocks in ParaView")

    def _pass(self, data, output, stop_reason):
        super()._pass(vtkPolyData(), output, stop_reason)
        output.SetPoints(data.GetPoints())
        output.GetPointData().ShallowCopy(data.GetPointData())
        output.GetFieldData().ShallowCopy(data.GetFieldData())
        return ""

    def _flip(self, data, segments, output):
        filter_ = self._filter
        piece = vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER()
        if filter_.GetOutputInformation(0).Get(piece) > 0 and data.GetNumberOfPoints():
            raise InvalidMesh("points are in several pieces; gather them in the first one, by Redistribute "
                              "DataSet with one partition in ParaView")
        if data.GetNumberOfPoints() == 0 or self._is_abort_requested():
            return self._pass(data, output, "aborted" if data.GetNumberOfPoints() else "converged")
        cloud = Cloud(data, segments, filter_.lines_as_segments, OUTLINES[filter_.outline])
        keywords = {name: getattr(filter_, name) for name in (
            "alpha", "longest_edge", "point_tolerance", "split_crossings", "maximum_iterations")}
        result = triangulate(
            cloud, backend=CHOICES["backend"][filter_.backend], threads=filter_.number_of_threads,
            device=filter_.device_id, progress=self._observe_part(1.0),
            on_iteration=self._observe, **keywords)
        self.totals = Totals.of_run(result.report, result.iterations)
        return cloud.write(result, output)


class vtkDelaunayFlipPoints(Filter):
    """Makes a Delaunay mesh from points, with or without segments.

    This class has the methods, outputs, warnings and progress of the C++ class
    vtkDelaunayFlipPoints, for a VTK that it was not built for; vtkDelaunayFlipPoints.h is its
    manual. It leaves out live updates, with a warning, and projections: x and y alone decide.
    """

    name = "vtkDelaunayFlipPoints"
    kind = vtkPointSet
    update_type = _PointUpdate
    no_mesh = "has no points of its own, passed unchanged"
    no_composite = "the segments of a single dataset cannot be a composite dataset"

    def SetSegmentsConnection(self, port):
        self.SetInputConnection(1, port)

    def SetSegmentsData(self, segments):
        self.SetInputDataObject(1, segments)


finish(vtkDelaunayFlipPoints, (
    *(Property(name, 0.0, 0.0, VTK_DOUBLE_MAX) for name in ("Alpha", "LongestEdge", "PointTolerance")),
    *(Property(name, False) for name in ("SplitCrossings", "LinesAsSegments")),
    Property("Outline", 0, 0, 1, ("EvenOdd", "Orientation")),
), count_answers(NumberOfSegmentEdges="segment_edges", NumberOfRefusedSegments="segments_refused"))

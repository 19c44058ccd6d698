# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter that triangulates points, for every VTK with Python: see _vtk_filter."""
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObject, vtkPointSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from . import _library
from ._options import GOALS
from ._points import POINT_OPTIONS, UNSEEN, run_points
from ._report import Totals
from ._rings import RING_RULES
from ._sphere import PROJECTIONS
from ._vtk_data import HEIGHT_ARRAY, keep_heights, pass_points, place_points
from ._vtk_filter import Filter, Regions, count_answers
from ._vtk_points import HEIGHTS, PointsInput
from ._vtk_properties import POINT_PROPERTIES, finish


class vtkDelaunayFlipPoints(Regions, Filter):
    """Makes a Delaunay mesh from points, with or without segments.

    This class has the methods, outputs, warnings and progress of the C++ class
    vtkDelaunayFlipPoints, for a VTK that it was not built for; vtkDelaunayFlipPoints.h is its
    manual. It leaves out live updates, with a warning, transforms and the best-fitting plane.
    """

    name = "vtkDelaunayFlipPoints"
    kind, size_of_blocks = vtkPointSet, vtkDataObject.POINT
    flips_partitions_alone = False
    no_mesh = "has no points of its own, passed unchanged"
    no_composite = "the segments of a single dataset cannot be a composite dataset"
    _last = None  #: What the last update asked for, and the Answers that have its session.

    def SetSegmentsConnection(self, port):
        self.SetInputConnection(len(self.others), port)

    def SetSegmentsData(self, segments):
        self.SetInputDataObject(len(self.others), segments)

    def _judge_partitions(self, leaves, segments):
        if len(leaves) > 1:
            raise _library.InvalidMesh(
                "the points are in several partitions; join them first, by vtkAppendDataSets, or Merge "
                "Blocks in ParaView")
        if isinstance(leaves[0][1], self.kind):
            self._require_one(segments)

    @staticmethod
    def _require_one(segments):
        if len(segments) > 1:
            raise _library.InvalidOptions(
                "the segments are in several partitions; join them first, by vtkAppendPolyData, or Merge "
                "Blocks in ParaView")

    def _pass(self, data, output, stop_reason):
        super()._pass(vtkPolyData(), output, stop_reason)
        pass_points(data, output)
        return ""

    def _find_projection(self):
        """The number of the projection in the engine."""
        if self.projection == self.PROJECTION_BEST_FITTING_PLANE:
            raise _library.InvalidOptions(
                "Projection: the best-fitting plane needs the filter in C++; this one, in Python, joins "
                "points in x and y or on a sphere")
        return PROJECTIONS.index(("plane", "", "sphere", "open-sphere")[self.projection])

    def _take_places(self, data, name=""):
        """A dataset with points. If these are longitudes and latitudes, a copy with their places."""
        if data is None or not self.degrees:
            return data
        if not self._find_projection():
            if not name:
                self._warnings.append(
                    (self._where, "Degrees has no effect, because the projection is not a sphere"))
            return data
        placed, trouble = place_points(data)
        if trouble:
            self._warnings.append((self._where, name + trouble))
        return placed

    def _take_segments(self, segments, heights):
        """Segments, also with their places. z is kept there in the array `heights`; "": nowhere."""
        placed = self._take_places(segments, "segments: ")
        if heights and placed is not segments:
            are_own = self.segment_heights == self.SEGMENT_HEIGHTS_OWN
            trouble = keep_heights(segments, heights, placed.GetPointData(), are_own, "they")
            if trouble:
                self._warnings.append((self._where, "segments: " + trouble))
        return placed

    def _flip(self, data, segments, output):
        if self.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER()) > 0:
            return self._pass(vtkPolyData(), output, "converged")  # the first one has all
        given, heights = data, HEIGHT_ARRAY
        data = self._take_places(given)
        trouble = "" if data is given else keep_heights(given, heights, data.GetPointData())
        if trouble:
            self._warnings.append((self._where, trouble))
            heights = ""
        segments = self._take_segments(segments, heights)
        if isinstance(self.GetInput(), vtkCompositeDataSet) and data.GetNumberOfPoints() == 0:
            segments = None  # those that all blocks share make no mesh of their own
        count = data.GetNumberOfPoints() + (segments.GetNumberOfPoints() if segments is not None else 0)
        if count == 0 or self._is_abort_requested():
            return self._pass(data, output, "aborted" if count else "converged")
        try:
            return self._triangulate(data, segments, output, self._observe_part(1.0), height_array=heights,
                                     follows=True)[1]
        except _library.Stopped:
            return self._pass(data, output, "aborted")

    def _is_followed(self, cloud, options):
        """Whether the points and the segments between them alone decide about the triangles, and later points
        may be these, moved."""
        # An observer may have removed the input, and VTK has an error for a connection that is not there.
        info = self.GetInputInformation(0, 0) if self.GetNumberOfInputConnections(0) else None
        times = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        has_times = info is not None and info.Has(times) and info.Length(times) > 1
        is_wanted = (has_times, True, False)[self.keep_session]
        limits = ("alpha", "longest_edge", "point_tolerance", *GOALS)
        adds_points = options["split_crossings"] and len(cloud.all_segments) > 0
        return is_wanted and not (
            adds_points or isinstance(self.GetInput(), vtkCompositeDataSet) or self._regions or self.size_array
            or any(options[name] for name in limits) or options["maximum_iterations"] >= 0
            or self.projection)

    def _follow(self, cloud, options, progress):
        """The Triangulation of a cloud. If the last cloud was this one before it has moved, the engine
        keeps its mesh."""
        cloud.triangle_order = "ordered_triangles"
        asked = (*options.items(), len(cloud.points), str(cloud.points.dtype), self.first_hole, self.ring_rule,
                 cloud.all_segments.tobytes(), cloud.all_rings.tobytes())
        last, self._last = self._last, None
        answers = last[1] if last is not None and last[0] == asked else None
        if answers is None:
            cloud.own_points()
            result, _ = run_points(cloud, options, progress, self._observe, True)
            answers = result._answers
        else:
            try:
                result = answers.move_to(cloud, options, progress)
            except _library.Stopped:
                self._last = last
                raise
        if result.report.converged:
            self._last = asked, answers
        return result

    def _triangulate(
            self, data, segments, output, progress, *, keeps=False, has_heights=True, height_array="",
            follows=False):
        """Returns the Triangulation, with or without its session, and the text of a warning, or "".
        Without heights nobody has to be told of z."""
        heights = HEIGHTS[self.segment_heights]
        if heights is not None:
            height_array = ""
        if heights != "survey" and not has_heights:
            heights = UNSEEN
        options = self._get_options("backend", *POINT_OPTIONS)
        cloud = PointsInput(
            data, segments, lines_as_segments=self.lines_as_segments, first_hole=self.first_hole,
            closed_lines_as_rings=self.closed_lines_as_rings, pass_segments=self.pass_segments and not keeps,
            ring_rule=RING_RULES[self.ring_rule],
            heights=heights, height_array=height_array, as_doubles=keeps, size_array=self.size_array,
            projection=self._find_projection(),
            backend={name: options[name] for name in ("backend", "threads", "device")})
        cloud.are_properties = True
        if follows and self._is_followed(cloud, options):
            result = self._follow(cloud, options, progress)
        else:
            self._last = None
            options["regions"] = self._list_regions()
            result, _ = run_points(cloud, options, progress, self._observe, keeps)
        self._totals = Totals.of_run(result.report, result.iterations)
        return result, cloud.write(result, output)


finish(vtkDelaunayFlipPoints, POINT_PROPERTIES,
       count_answers("NumberOf", "SegmentEdges", "RefusedSegments"))

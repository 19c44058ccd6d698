# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The essentials of vtkDelaunayFlip in Python; with numpy where bits matter."""
import importlib.util
import math
import re
import signal
import subprocess
import sys
import unittest

# Imported before any module of VTK: the package must load what it needs.
import delaunayflip
from delaunayflip import vtkDelaunayFlip, vtkDelaunayFlipInterpolator, vtkDelaunayFlipPoints

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import (
    vtkIdList, vtkObject, vtkPoints, vtkStringArray, vtkVersion)
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkImageData, vtkMultiBlockDataSet, vtkPolyData, vtkStructuredGrid, vtkTable,
    vtkUnstructuredGrid)
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm
from vtkmodules.vtkCommonMisc import vtkErrorCode
from vtkmodules.vtkFiltersAMR import vtkAMRGaussianPulseSource
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkFeatureEdges
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource, vtkSphereSource

HAS_PIPELINES = vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() >= 904


FLIPPED = frozenset((1, 3))


def make_cells(cells):
    array = vtkCellArray()
    for cell in cells:
        array.InsertNextCell(len(cell), cell)
    return array


def make_mesh(points, polygons):
    """A mesh with double points; the mesh keeps the array of points alive."""
    array = vtkPoints()
    array.SetData(numpy_to_vtk(numpy.array(points, dtype=float), deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(array)
    mesh.SetPolys(make_cells(polygons))
    return mesh


def make_rhombus():
    """A rhombus divided along its long diagonal 0-2. One flip, to 1-3, makes it Delaunay."""
    return make_mesh([(-3, 0, 0), (0, -1, 0), (3, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])


def make_bad_mesh():
    """Random points in a triangle, in the strips that a triangulation starts from."""
    points = numpy.random.default_rng(5).dirichlet([1, 1, 1], 150)[:, :2]
    points = numpy.concatenate([[(0, 0), (1, 0), (0, 1)], points])
    strips = delaunayflip.triangulate(points, maximum_iterations=0).triangles
    return make_mesh(numpy.c_[points, numpy.zeros(len(points))], strips)


def get_cells(cells):
    ids = vtkIdList()
    result = []
    for i in range(cells.GetNumberOfCells()):
        cells.GetCellAtId(i, ids)
        result.append(tuple(ids.GetId(k) for k in range(ids.GetNumberOfIds())))
    return result


def get_edges(mesh):
    return {frozenset((cell[i - 1], cell[i]))
            for cell in get_cells(mesh.GetPolys()) for i in range(len(cell))}


def get_angle(points, a, b, c):
    """The angle at c in triangle a, b, c."""
    u, v = points[a] - points[c], points[b] - points[c]
    return math.atan2(numpy.linalg.norm(numpy.cross(u, v)), numpy.dot(u, v))


def count_violations(mesh):
    """The number of edges with opposite angles that sum to more than pi."""
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    opposite = {}
    for a, b, c in get_cells(mesh.GetPolys()):
        for edge, apex in (((a, b), c), ((b, c), a), ((c, a), b)):
            opposite.setdefault(frozenset(edge), []).append(get_angle(points, *edge, apex))
    return sum(len(angles) == 2 and sum(angles) > math.pi + 1e-9 for angles in opposite.values())


def add_array(data, name, values):
    """Adds numbers, or strings."""
    if len(values) and isinstance(values[0], str):
        array = vtkStringArray()
        for value in values:
            array.InsertNextValue(value)
    else:
        array = numpy_to_vtk(numpy.asarray(values), deep=True)
    array.SetName(name)
    data.AddArray(array)


class Watched:
    """A filter that records its errors and warnings."""

    def __init__(self, data, kind=vtkDelaunayFlip):
        self.filter = kind()
        self.errors = self._watch(self.filter, "ErrorEvent")
        self.warnings = self._watch(self.filter, "WarningEvent")
        self._watch(self.filter.GetExecutive(), "ErrorEvent")
        self.filter.SetInputDataObject(data)

    @staticmethod
    def _watch(source, event):
        messages = []

        def note(_source, _event, message):
            messages.append(message)

        note.CallDataType = "string0"
        source.AddObserver(event, note)
        return messages

    def run(self):
        self.filter.Update()
        return self.filter.GetOutput()


class Meshes(unittest.TestCase):

    def test_what_passes(self):
        mesh = make_bad_mesh()
        mesh.SetLines(make_cells([(0, 1)]))
        add_array(mesh.GetPointData(), "Depth", numpy.arange(mesh.GetNumberOfPoints()))
        add_array(mesh.GetCellData(), "Number", numpy.arange(mesh.GetNumberOfCells()))
        points = vtk_to_numpy(mesh.GetPoints().GetData())
        bits, cells = points.tobytes(), get_cells(mesh.GetPolys())
        self.assertGreater(count_violations(mesh), 0)
        output = Watched(mesh).run()
        self.assertEqual(count_violations(output), 0)
        self.assertIs(output.GetPoints(), mesh.GetPoints())
        self.assertEqual(points.tobytes(), bits)
        self.assertIs(output.GetPointData().GetArray("Depth"), mesh.GetPointData().GetArray("Depth"))
        numbers = vtk_to_numpy(output.GetCellData().GetArray("Number"))
        numpy.testing.assert_array_equal(numbers, numpy.arange(len(cells) + 1))
        self.assertEqual(get_cells(output.GetLines()), [(0, 1)])
        self.assertEqual(get_cells(mesh.GetPolys()), cells)
        self.assertEqual(mesh.GetFieldData().GetNumberOfArrays(), 0)

    def test_quads_and_strips(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 2, 0), (1, 2, 0)],
                         [(0, 1, 2, 3)])
        mesh.SetStrips(make_cells([(3, 2, 4, 5)]))
        add_array(mesh.GetCellData(), "Number", numpy.arange(2))
        watched = Watched(mesh)
        output = watched.run()
        self.assertEqual(get_cells(output.GetPolys()), [(0, 1, 2), (0, 2, 3), (3, 2, 4), (4, 2, 5)])
        self.assertEqual(output.GetNumberOfStrips(), 0)
        numbers = vtk_to_numpy(output.GetCellData().GetArray("Number"))
        self.assertEqual(numbers.tolist(), [0, 0, 1, 1])
        watched.filter.TriangulateOff()
        output = watched.run()
        self.assertEqual(get_cells(output.GetPolys()), [(0, 1, 2, 3)])
        self.assertEqual(get_cells(output.GetStrips()), [(3, 2, 4, 5)])

    def test_constraints(self):
        lines, mesh = vtkPolyData(), make_rhombus()
        lines.SetLines(make_cells([(0, 2)]))
        add_array(mesh.GetCellData(), "Tree", ("oak", "elm"))
        for set_up, is_kept in ((lambda flip: None, False),
                                (lambda flip: flip.SetConstraintsData(lines), True),
                                (lambda flip: flip.SetRegionArray("Tree"), True)):
            watched = Watched(mesh)
            set_up(watched.filter)
            self.assertEqual(frozenset((0, 2)) in get_edges(watched.run()), is_kept)
            self.assertEqual(FLIPPED in get_edges(watched.run()), not is_kept)

    def test_pieces_share_constraints(self):
        line = vtkLineSource()  # all of it in the first piece
        line.SetPoint1(-3, 0, 0)
        line.SetPoint2(3, 0, 0)
        flip = vtkDelaunayFlip()
        flip.SetInputData(make_rhombus())
        flip.SetConstraintsConnection(line.GetOutputPort())
        flip.UpdatePiece(1, 2, 0)
        self.assertEqual(flip.GetNumberOfConstraintEdges(), 1)

    def test_pieces_of_one_source(self):
        """No triangle comes twice."""
        sphere, edges = vtkSphereSource(), vtkFeatureEdges()
        edges.SetInputConnection(sphere.GetOutputPort())

        def count_triangles(piece, pieces):
            flip = vtkDelaunayFlip()
            flip.SetInputConnection(sphere.GetOutputPort())
            flip.SetConstraintsConnection(edges.GetOutputPort())
            flip.UpdatePiece(piece, pieces, 0)
            return flip.GetOutput().GetNumberOfPolys()

        counts = [count_triangles(piece, 3) for piece in range(3)]
        self.assertEqual(sum(counts), count_triangles(0, 1))
        self.assertNotIn(0, counts)

    def test_kept_sliver(self):
        """A hint follows if a constraint keeps one of the worst triangles; not for a good one, nor
        without."""
        width, points = 9, [(x, y + 0.3 * (x % 2), 0) for y in range(9) for x in range(9)]
        triangles = [corners for i in range(width * (width - 1)) if i % width + 1 < width
                     for corners in ((i, i + 1, i + width + 1), (i, i + width + 1, i + width))]
        points += [(20, 0, 0), (23, -0.05, 0), (26, 0, 0), (23, 0.05, 0)]
        triangles += [(81, 82, 83), (81, 83, 84)]
        mesh = make_mesh(points, triangles)
        for kept, expected in (((81, 83), True), ((0, 1), False), ((30, 31), False), (None, False)):
            lines = vtkPolyData()
            lines.SetLines(make_cells([kept] if kept else []))
            watched = Watched(mesh)
            watched.filter.SetConstraintsData(lines)
            watched.run()
            hint = ("hint: constraints keep an edge of one of the ten triangles with the smallest angles; "
                    "with fewer constraints more can flip\n")
            self.assertEqual(hint in watched.filter.GetSummary(), expected, watched.filter.GetSummary())
            self.assertEqual("hint" in watched.filter.GetSummary(), expected)
        # These keep edges as well, which no option changes.
        add_array(mesh.GetCellData(), "vtkGhostType", numpy.ones(len(triangles), numpy.uint8))
        watched = Watched(mesh)
        watched.run()
        self.assertNotIn("hint", watched.filter.GetSummary())


class Faults(unittest.TestCase):

    def test_ten_errors_in_a_row(self):
        watched = Watched(make_rhombus())
        flip = watched.filter
        flip.SetTieRuleToCanonical()
        for i in range(10):
            flip.SetGeometryToSurface()
            flip.SetFeatureAngle(i)
            self.assertEqual(watched.run().GetNumberOfCells(), 0)
            self.assertEqual(len(watched.errors), i + 1)
            self.assertEqual(flip.GetStopReason(), vtkDelaunayFlip.STOP_REASON_FAILED)
            self.assertEqual(flip.GetStopReasonAsString(), "failed: " + flip.GetErrorMessage())
            self.assertIn("tie rule", flip.GetErrorMessage())
            self.assertEqual(flip.GetFailure(), vtkDelaunayFlip.FAILURE_OPTIONS)
            self.assertEqual(vtkErrorCode.GetStringFromErrorCode(flip.GetErrorCode()), "UnknownError")
        flip.SetGeometryToAuto()
        self.assertIn(frozenset((1, 3)), get_edges(watched.run()))
        self.assertEqual(flip.GetErrorMessage(), "")
        self.assertEqual(flip.GetErrorCode(), 0)

    def test_a_missing_or_wrong_input_is_told(self):
        filter_ = vtkDelaunayFlip()
        vtkObject.GlobalWarningDisplayOff()
        self.addCleanup(vtkObject.GlobalWarningDisplayOn)
        wrong, types = vtkUnstructuredGrid(), "it must be a vtkPolyData or vtkCompositeDataSet"
        for data, second, why in (
                (None, None, "there is no input"), (make_bad_mesh(), None, ""),
                (wrong, None, f"the input is a vtkUnstructuredGrid; {types}"),
                (None, None, "there is no input"),
                (make_bad_mesh(), wrong, f"the second input is a vtkUnstructuredGrid; {types}"),
                (make_bad_mesh(), make_rhombus(), "")):
            for port, given in enumerate((data, second)):
                filter_.RemoveAllInputConnections(port)
                if given is not None:
                    filter_.SetInputDataObject(port, given)
            filter_.Update()
            self.assertEqual(filter_.GetErrorMessage(), why)
            self.assertEqual(filter_.GetStopReasonAsString(), "failed: " + why if why else "converged")
            self.assertEqual(filter_.GetOutput().GetNumberOfCells() > 0, not why)

    def test_several_connections_are_told(self):
        filter_ = vtkDelaunayFlip()
        vtkObject.GlobalWarningDisplayOff()
        self.addCleanup(vtkObject.GlobalWarningDisplayOn)
        filter_.SetInputData(make_rhombus())
        filter_.AddInputData(make_rhombus())
        filter_.Update()
        self.assertEqual(filter_.GetErrorMessage(), "the input has 2 connections; it takes one")
        filter_.SetInputData(make_rhombus())
        filter_.AddInputData(1, make_rhombus())
        filter_.Update()
        self.assertEqual(filter_.GetErrorMessage(), "")
        filter_.AddInputData(1, make_rhombus())
        filter_.Update()
        self.assertEqual(filter_.GetErrorMessage(), "the second input has 2 connections; it takes one")

    def test_ids_and_offsets(self):
        for offsets, ids, text in (((0, 3), (0, 2, 44), "cell 0 names point 44"),
                                   *((offsets, (0, 1, 2), "offsets") for offsets in
                                     ((), (0, 9), (0, -3, 3), (3, 3), (0, 4, 3)))):
            mesh, lines = make_rhombus(), vtkCellArray()
            lines.SetData(numpy_to_vtk(numpy.array(offsets, numpy.int64), deep=True),
                          numpy_to_vtk(numpy.array(ids), deep=True))
            mesh.SetLines(lines)
            watched = Watched(mesh)
            self.assertEqual(watched.run().GetNumberOfCells(), 0)
            self.assertEqual(len(watched.errors), 1)
            self.assertIn(text, watched.errors[0])


class Observers(unittest.TestCase):

    def test_an_aborted_update_is_followed_by_a_whole_one(self):
        watched = Watched(make_bad_mesh())

        def stop(flip, _event):
            flip.SetAbortExecute(1)

        watched.filter.AddObserver("ProgressEvent", stop)
        watched.run()
        self.assertEqual(watched.filter.GetStopReason(), vtkDelaunayFlip.STOP_REASON_ABORTED)
        self.assertFalse(watched.filter.GetAbortExecute())
        watched.filter.RemoveObservers("ProgressEvent")
        watched.filter.Modified()
        watched.run()
        self.assertTrue(watched.filter.GetConverged())

    def test_a_handler_of_signals_may_ask_to_abort(self):
        """The page Start in Python tells how to end an update by Ctrl-C, which comes in an observer."""
        watched = Watched(make_bad_mesh())
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(
            signal.SIGINT, lambda *_: watched.filter.SetAbortExecute(1)))
        watched.filter.AddObserver("ProgressEvent", lambda *_: signal.raise_signal(signal.SIGINT))
        watched.run()
        self.assertEqual(watched.filter.GetStopReason(), vtkDelaunayFlip.STOP_REASON_ABORTED)
        self.assertFalse(watched.filter.GetAbortExecute())

    def test_input_is_removed(self):
        filter_ = vtkDelaunayFlip()
        filter_.SetInputData(make_bad_mesh())
        filter_.SetConstraintsData(make_rhombus())
        events = []

        def remove(source, _event):
            if 0 < source.GetProgress() < 1:
                events.append(source.GetProgress())
                source.RemoveAllInputConnections(0)
                source.RemoveAllInputConnections(1)

        filter_.AddObserver("ProgressEvent", remove)
        filter_.Update()
        self.assertEqual(filter_.GetOutput().GetNumberOfCells(), 301)

    def test_blocks_are_emptied(self):
        blocks, last = vtkMultiBlockDataSet(), make_bad_mesh()
        for i, block in enumerate((make_bad_mesh(), last)):
            blocks.SetBlock(i, block)
        watched = Watched(blocks)

        def empty(source, _event):
            if 0 < source.GetProgress() < 1:
                last.Initialize()

        watched.filter.AddObserver("ProgressEvent", empty)
        watched.filter.Update()
        self.assertEqual(last.GetNumberOfCells(), 0)
        output = watched.filter.GetOutputDataObject(0).GetBlock(1)
        self.assertGreater(output.GetNumberOfCells(), 0)

    def test_update_within_an_update(self):
        watched = Watched(make_bad_mesh())
        below = vtkAppendPolyData()
        below.AddInputConnection(watched.filter.GetOutputPort())

        def update(source, _event):
            if 0 < source.GetProgress() < 1:
                below.Update()

        watched.filter.AddObserver("ProgressEvent", update)
        self.assertEqual(count_violations(watched.run()), 0)
        self.assertIn("update within an update", watched.errors[0])


class Blocks(unittest.TestCase):

    def test_amr_holds_no_meshes(self):
        pulse = vtkAMRGaussianPulseSource()
        pulse.SetDimension(2)
        pulse.Update()
        watched = Watched(pulse.GetOutputDataObject(0))
        watched.filter.Update()
        (warning,) = watched.warnings
        self.assertIn("not a surface, passed unchanged", warning)
        self.assertNotIn("between pieces", warning)

    def test_what_is_no_mesh_passes(self):
        image = vtkImageData()
        image.SetDimensions(2, 2, 2)
        grid = vtkStructuredGrid()
        grid.SetDimensions(3, 3, 1)  # without points
        for foreign in (vtkTable(), image, grid, vtkUnstructuredGrid(), None):
            blocks = vtkMultiBlockDataSet()
            for i, block in enumerate((foreign, make_rhombus())):
                blocks.SetBlock(i, block)
            watched = Watched(blocks)
            watched.filter.SetInputDataObject(1, blocks)  # its polygons: no edge may flip
            watched.filter.Update()
            output = watched.filter.GetOutputDataObject(0)
            kept = output.GetBlock(0)
            self.assertEqual(kept and kept.GetClassName(), foreign and foreign.GetClassName())
            self.assertNotIn(FLIPPED, get_edges(output.GetBlock(1)))
            watched.filter.SetInputDataObject(1, None)
            watched.filter.Update()
            self.assertIn(FLIPPED, get_edges(output.GetBlock(1)))


def run_python(program):
    subprocess.run([sys.executable, "-c", program], check=True)


class Package(unittest.TestCase):

    def test_filter_needs_no_rendering(self):
        run_python("""
import sys
from delaunayflip import *
assert vtkDelaunayFlip().GetLiveUpdate() is False
assert not [name for name in sys.modules if "Rendering" in name]
""")


class LiveView(unittest.TestCase):

    @unittest.skipUnless(
        importlib.util.find_spec("delaunayflip.vtkDelaunayFlipRendering"),
        "built without the live view")
    def test_comes_when_asked_for(self):
        run_python("""
import delaunayflip
view = delaunayflip.vtkDelaunayFlipLiveView()
assert view is not delaunayflip.vtkDelaunayFlipLiveView()
view.SetFilter(delaunayflip.vtkDelaunayFlip())
assert view.GetFilter().GetClassName() == "vtkDelaunayFlip"
view.SetFilter(delaunayflip.vtkDelaunayFlipPoints())
assert view.GetFilter().GetClassName() == "vtkDelaunayFlipPoints"
assert view.GetColorBy() == view.COLOR_BY_SMALLEST_ANGLE
""")


def list_properties(kind):
    """The properties with both a setter and a getter in the class itself, not in a base class."""
    own = set(dir(kind)) - set(dir(vtkPolyDataAlgorithm))
    names = [name[3:] for name in own if name.startswith("Set")]
    return sorted(name for name in names if "Get" + name in own and name != "Transform")


def change_property(flip, name):
    """Gives a property another value; numbers become larger by 1, or 1 where that is the same."""
    value = getattr(flip, "Get" + name)()
    other = not value if isinstance(value, bool) else "x" if isinstance(value, str) else value + 1
    other = 1 if other == value else other
    getattr(flip, "Set" + name)(other)
    return getattr(flip, "Get" + name)() != value


class Properties(unittest.TestCase):

    def test_print_out_shows_every_property(self):
        def read(flip):
            return dict(re.findall(r"^  (\w+): (.*)$", str(flip), re.MULTILINE))

        for kind, some in ((vtkDelaunayFlip, {"Geometry", "RegionArray", "LiveUpdate"}),
                           (vtkDelaunayFlipPoints, {"Alpha", "RingRule", "LinesAsSegments"}),
                           (vtkDelaunayFlipInterpolator, {"Method", "Outside", "ElevationArray"})):
            self.assertLessEqual(some, set(list_properties(kind)))
            for name in list_properties(kind):
                flip = kind()
                before, time = read(flip), flip.GetMTime()
                self.assertTrue(change_property(flip, name), name)
                self.assertEqual(flip.GetMTime() > time, name != "Paused", name)
                after = read(flip)
                self.assertEqual({line for line in after if after[line] != before.get(line)}, {name})


    def test_names_of_arrays_are_texts(self):
        for mesh in (vtkPolyData(), numpy.zeros(3)):
            with self.assertRaises(TypeError) as caught:
                vtkDelaunayFlip().SetRegionArray(mesh)
            self.assertLess(len(str(caught.exception)), 100)


class FromPoints(unittest.TestCase):

    def test_points_and_a_breakline(self):
        cloud = make_mesh([(-3, 0, 0), (0, -1, 0), (3, 0, 0), (0, 1, 0)], [])
        points = vtkDelaunayFlipPoints()
        points.SetInputData(cloud)
        points.Update()
        self.assertIn(FLIPPED, get_edges(points.GetOutput()))
        segments = vtkPolyData()
        segments.SetLines(make_cells([(0, 2)]))
        points.SetSegmentsData(segments)
        points.Update()
        self.assertNotIn(FLIPPED, get_edges(points.GetOutput()))
        self.assertEqual(points.GetNumberOfSegmentEdges(), 1)
        self.assertEqual(points.GetNumberOfRefusedSegments(), 0)
        self.assertTrue(points.GetConverged())
        self.assertEqual(points.GetIterations().GetNumberOfRows(), points.GetNumberOfIterations())

    def test_first_piece_has_all_points(self):
        sphere = vtkSphereSource()  # makes pieces
        sphere.Update()
        for piece, count in ((0, sphere.GetOutput().GetNumberOfPoints()), (1, 0)):
            points = vtkDelaunayFlipPoints()
            points.SetInputConnection(sphere.GetOutputPort())
            points.UpdatePiece(piece, 2, 0)
            self.assertEqual(points.GetOutput().GetNumberOfPoints(), count)
            self.assertEqual(points.GetErrorMessage(), "")

    def test_segments_alone(self):
        outline = make_mesh([(0, 0, 0), (2, 0, 0), (2, 2, 1), (0, 2, 0)], [(0, 1, 2, 3)])
        for piece, triangles in ((0, 2), (1, 0)):
            watched = Watched(vtkPolyData(), vtkDelaunayFlipPoints)
            watched.filter.SetSegmentsData(outline)
            watched.filter.UpdatePiece(piece, 2, 0)
            self.assertEqual(watched.filter.GetOutput().GetNumberOfCells(), triangles)
            self.assertTrue(watched.filter.GetConverged())
            self.assertEqual(watched.warnings, [])

    def test_aborted(self):
        points, cloud = vtkDelaunayFlipPoints(), make_bad_mesh()
        points.SetInputData(cloud)
        points.AddObserver("ProgressEvent", lambda *_: points.AbortExecuteOn())
        points.Update()
        self.assertEqual(points.GetStopReasonAsString(), "aborted")
        self.assertEqual(points.GetOutput().GetNumberOfPoints(), cloud.GetNumberOfPoints())
        self.assertEqual(points.GetOutput().GetNumberOfCells(), 0)


@unittest.skipUnless(HAS_PIPELINES, "needs VTK 9.4")
class NewVtk(unittest.TestCase):

    def test_properties(self):
        flip = vtkDelaunayFlip(geometry=2, live_update=True)
        self.assertEqual(flip.GetGeometry(), vtkDelaunayFlip.GEOMETRY_PLANAR_XY)
        self.assertTrue(flip.live_update)
        flip.maximum_iterations = 7
        self.assertEqual(flip.GetMaximumIterations(), 7)
        with self.assertRaises((AttributeError, TypeError)):
            vtkDelaunayFlip(geometri=2)

    def test_pipeline(self):
        plane = vtkPlaneSource(x_resolution=3, y_resolution=3)
        flip = vtkDelaunayFlip(number_of_threads=1)
        pipeline = plane >> flip
        mesh, table = pipeline.update().output
        self.assertEqual(mesh.GetNumberOfCells(), 18)
        self.assertEqual(table.GetColumnName(0), "Iteration")
        mesh, _ = (vtkDelaunayFlip() >> vtkDelaunayFlip())(mesh)
        self.assertEqual(mesh.GetNumberOfCells(), 18)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The essentials of vtkDelaunayFlip in Python; with numpy where bits matter."""
import importlib.util
import math
import random
import re
import subprocess
import sys
import unittest

# Imported before any module of VTK: the package must load what it needs.
from delaunayflip import vtkDelaunayFlip

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkMultiBlockDataSet, vtkPolyData, vtkTable)
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm
from vtkmodules.vtkFiltersAMR import vtkAMRGaussianPulseSource

COLUMNS = ["Iteration", "Tested", "NonDelaunay", "Flipped", "Excluded", "Blocked",
           "MinimumAngle", "Seconds"]


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


def make_bad_mesh(number_of_points=150):
    """Random points, each joined to the corners of the triangle that contains it."""
    generator = random.Random(5)
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    triangles = [(0, 1, 2)]
    for _ in range(number_of_points):
        a, b, c = triangles.pop(generator.randrange(len(triangles)))
        weights = [generator.uniform(1, 2) for _ in range(3)]
        points.append(tuple(
            sum(w * points[i][k] for w, i in zip(weights, (a, b, c))) / sum(weights)
            for k in range(3)))
        p = len(points) - 1
        triangles += [(a, b, p), (b, c, p), (c, a, p)]
    return make_mesh(points, triangles)


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
    """The number of edges whose opposite angles sum to more than pi."""
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    opposite = {}
    for a, b, c in get_cells(mesh.GetPolys()):
        for edge, apex in (((a, b), c), ((b, c), a), ((c, a), b)):
            opposite.setdefault(frozenset(edge), []).append(get_angle(points, *edge, apex))
    return sum(len(angles) == 2 and sum(angles) > math.pi + 1e-9 for angles in opposite.values())


def add_numbers(data, name, count):
    array = numpy_to_vtk(numpy.arange(count), deep=True)
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


class Attributes(unittest.TestCase):

    def test_points_are_the_same_object_and_bits(self):
        mesh = make_bad_mesh()
        before = vtk_to_numpy(mesh.GetPoints().GetData()).copy()
        output = Watched(mesh).run()
        self.assertIs(output.GetPoints(), mesh.GetPoints())
        after = vtk_to_numpy(output.GetPoints().GetData())
        self.assertEqual(before.tobytes(), after.tobytes())
        self.assertTrue(numpy.shares_memory(after, vtk_to_numpy(mesh.GetPoints().GetData())))

    def test_result_is_delaunay(self):
        mesh = make_bad_mesh()
        self.assertGreater(count_violations(mesh), 0)
        self.assertEqual(count_violations(Watched(mesh).run()), 0)

    def test_data_pass(self):
        mesh = make_rhombus()
        mesh.SetLines(make_cells([(0, 1)]))
        add_numbers(mesh.GetPointData(), "Depth", 4)
        add_numbers(mesh.GetCellData(), "Number", 3)
        output = Watched(mesh).run()
        self.assertIs(output.GetPointData().GetArray("Depth"), mesh.GetPointData().GetArray("Depth"))
        self.assertEqual(vtk_to_numpy(output.GetCellData().GetArray("Number")).tolist(), [0, 1, 2])
        self.assertEqual(get_cells(output.GetLines()), [(0, 1)])

    def test_input_is_untouched(self):
        mesh = make_rhombus()
        Watched(mesh).run()
        self.assertEqual(get_cells(mesh.GetPolys()), [(0, 1, 2), (0, 2, 3)])
        self.assertEqual(mesh.GetFieldData().GetNumberOfArrays(), 0)


class Cells(unittest.TestCase):

    def make_quad_and_strip(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 2, 0), (1, 2, 0)],
                         [(0, 1, 2, 3)])
        mesh.SetStrips(make_cells([(3, 2, 4, 5)]))
        add_numbers(mesh.GetCellData(), "Number", 2)
        return mesh

    def test_quads_and_strips_become_triangles(self):
        output = Watched(self.make_quad_and_strip()).run()
        self.assertEqual(get_cells(output.GetPolys()), [(0, 1, 2), (0, 2, 3), (3, 2, 4), (4, 2, 5)])
        self.assertEqual(output.GetNumberOfStrips(), 0)
        numbers = vtk_to_numpy(output.GetCellData().GetArray("Number"))
        self.assertEqual(numbers.tolist(), [0, 0, 1, 1])

    def test_triangulate_off_keeps_them(self):
        watched = Watched(self.make_quad_and_strip())
        watched.filter.TriangulateOff()
        output = watched.run()
        self.assertEqual(get_cells(output.GetPolys()), [(0, 1, 2, 3)])
        self.assertEqual(get_cells(output.GetStrips()), [(3, 2, 4, 5)])

    def test_id_width_is_kept(self):
        for wide in (False, True):
            mesh = make_bad_mesh()
            if wide:
                mesh.GetPolys().ConvertTo64BitStorage()
            else:
                mesh.GetPolys().ConvertTo32BitStorage()
            self.assertEqual(bool(Watched(mesh).run().GetPolys().IsStorage64Bit()), wide)


class Constraints(unittest.TestCase):

    def setUp(self):
        self.diagonal = frozenset((0, 2))

    def test_lines(self):
        mesh = make_rhombus()
        mesh.SetLines(make_cells([(1, 2, 0)]))
        watched = Watched(mesh)
        self.assertIn(self.diagonal, get_edges(watched.run()))
        watched.filter.LinesAsConstraintsOff()
        self.assertNotIn(self.diagonal, get_edges(watched.run()))

    def test_second_input(self):
        constraints = vtkPolyData()
        constraints.SetLines(make_cells([(0, 2)]))
        watched = Watched(make_rhombus())
        watched.filter.SetConstraintsData(constraints)
        self.assertIn(self.diagonal, get_edges(watched.run()))

    def test_regions(self):
        mesh = make_rhombus()
        names = vtkStringArray()
        names.SetName("Tree")
        names.InsertNextValue("oak")
        names.InsertNextValue("elm")
        mesh.GetCellData().AddArray(names)
        watched = Watched(mesh)
        watched.filter.SetRegionArray("Tree")
        self.assertEqual(watched.filter.GetRegionArray(), "Tree")
        self.assertIn(self.diagonal, get_edges(watched.run()))


class Input(unittest.TestCase):

    def test_empty(self):
        watched = Watched(vtkPolyData())
        self.assertEqual(watched.run().GetNumberOfCells(), 0)
        self.assertEqual(watched.errors + watched.warnings, [])

    def test_id_out_of_range(self):
        mesh = make_rhombus()
        mesh.SetPolys(make_cells([(0, 1, 2), (0, 2, 44)]))
        watched = Watched(mesh)
        self.assertEqual(watched.run().GetNumberOfCells(), 0)
        self.assertEqual(len(watched.errors), 1)
        self.assertIn("cell 1 names point 44", watched.errors[0])

    def test_dirt_gives_one_warning(self):
        mesh = make_rhombus()
        mesh.GetPoints().InsertNextPoint(math.nan, 0, 0)
        mesh.SetPolys(make_cells([(0, 1, 2), (0, 2, 3), (1, 1, 2), (2, 3, 4)]))
        watched = Watched(mesh)
        output = watched.run()
        self.assertIn(frozenset((1, 3)), get_edges(output))
        self.assertEqual(get_cells(output.GetPolys())[2:], [(1, 1, 2), (2, 3, 4)])
        self.assertEqual(watched.errors, [])
        self.assertEqual(len(watched.warnings), 1)

    def test_wrong_options(self):
        watched = Watched(make_rhombus())
        watched.filter.SetGeometryToSurface()
        watched.filter.SetTieRuleToCanonical()
        self.assertEqual(watched.run().GetNumberOfCells(), 0)
        self.assertEqual(len(watched.errors), 1)

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
            self.assertEqual(flip.GetErrorCode(), 40000 + vtkDelaunayFlip.FAILURE_OPTIONS)
        flip.SetGeometryToAuto()
        self.assertIn(frozenset((1, 3)), get_edges(watched.run()))
        self.assertEqual(flip.GetErrorMessage(), "")
        self.assertEqual(flip.GetErrorCode(), 0)


class Pipeline(unittest.TestCase):

    def test_progress_and_abort(self):
        watched = Watched(make_bad_mesh())
        seen = []

        def stop(flip, _event):
            seen.append(flip.GetProgress())
            if flip.GetNumberOfIterations() == 2:
                flip.SetAbortExecute(1)

        watched.filter.AddObserver("ProgressEvent", stop)
        mesh = watched.run()
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(watched.filter.GetStopReason(), vtkDelaunayFlip.STOP_REASON_ABORTED)
        self.assertEqual(watched.filter.GetNumberOfIterations(), 2)
        self.assertEqual(count_violations(mesh), watched.filter.GetNumberOfNonDelaunayEdges())

    def test_abort_before_the_first_iteration(self):
        mesh = make_bad_mesh()
        watched = Watched(mesh)
        told = []

        def stop(flip, _event):
            told.append(flip.GetProgress())
            flip.SetAbortExecute(flip.GetProgress() > 0.1)

        watched.filter.AddObserver("ProgressEvent", stop)
        output = watched.run()
        self.assertEqual(watched.filter.GetStopReasonAsString(), "aborted")
        self.assertEqual(watched.filter.GetNumberOfIterations(), 0)
        # VTK tells of 1 at the end, from 9.2 on also after an abort.
        self.assertLess(max(share for share in told if share < 1), 0.5)
        self.assertEqual(get_edges(output), get_edges(mesh))

    def test_an_aborted_update_is_followed_by_a_whole_one(self):
        watched = Watched(make_bad_mesh())

        def stop(flip, _event):
            if flip.GetProgress() < 1:  # not at the end, which VTK tells of after an abort too
                flip.SetAbortExecute(1)

        watched.filter.AddObserver("ProgressEvent", stop)
        watched.run()
        self.assertEqual(watched.filter.GetStopReason(), vtkDelaunayFlip.STOP_REASON_ABORTED)
        watched.filter.RemoveObservers("ProgressEvent")
        watched.filter.Modified()
        watched.run()
        self.assertTrue(watched.filter.GetConverged())

    def test_iteration_limit(self):
        watched = Watched(make_bad_mesh())
        watched.filter.SetMaximumIterations(1)
        watched.run()
        self.assertEqual(watched.filter.GetStopReasonAsString(), "iteration limit")
        self.assertEqual(watched.warnings, [])

    def test_backend(self):
        watched = Watched(make_rhombus())
        self.assertEqual(watched.filter.GetBackend(), vtkDelaunayFlip.BACKEND_AUTO)
        self.assertEqual(watched.filter.GetDeviceId(), -1)
        watched.filter.SetDeviceId(-5)
        self.assertEqual(watched.filter.GetDeviceId(), -1)
        watched.filter.SetDeviceId(1000000)
        watched.run()  # too small for a GPU
        self.assertEqual(watched.errors + watched.warnings, [])
        watched.filter.SetBackendToCUDA()
        self.assertEqual(watched.run().GetNumberOfCells(), 0)
        self.assertEqual(watched.filter.GetFailure(), vtkDelaunayFlip.FAILURE_BACKEND)
        self.assertEqual(len(watched.errors), 1)
        self.assertIn("CUDA", watched.errors[0])
        watched.filter.ReleaseDeviceMemory()

    def test_composite(self):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, make_rhombus())
        blocks.SetBlock(1, make_bad_mesh())
        watched = Watched(blocks)
        watched.filter.Update()
        output = watched.filter.GetOutputDataObject(0)
        self.assertIn(frozenset((1, 3)), get_edges(output.GetBlock(0)))
        self.assertEqual(count_violations(output.GetBlock(1)), 0)
        flips = [output.GetBlock(i).GetFieldData().GetArray("DelaunayFlip:TotalFlips").GetValue(0)
                 for i in range(2)]
        self.assertEqual(flips[0], 1)
        self.assertEqual(watched.filter.GetTotalFlips(), sum(flips))
        table = watched.filter.GetOutputDataObject(1)
        self.assertIsInstance(table, vtkTable)
        self.assertEqual(sum(vtk_to_numpy(table.GetRowData().GetArray("Flipped"))), sum(flips))

    def test_amr_holds_no_meshes(self):
        pulse = vtkAMRGaussianPulseSource()
        pulse.SetDimension(2)
        pulse.Update()
        watched = Watched(pulse.GetOutputDataObject(0))
        watched.filter.Update()
        (warning,) = watched.warnings
        self.assertIn("not a surface, passed unchanged", warning)
        self.assertNotIn("between pieces", warning)

    def test_a_block_that_fails(self):
        broken = make_rhombus()
        broken.SetPolys(make_cells([(0, 1, 44)]))
        blocks = vtkMultiBlockDataSet()
        for i, mesh in enumerate((broken, make_rhombus())):
            blocks.SetBlock(i, mesh)
        watched = Watched(blocks)
        watched.filter.Update()
        output = watched.filter.GetOutputDataObject(0)
        self.assertEqual(output.GetBlock(0).GetNumberOfCells(), 0)
        self.assertIn(frozenset((1, 3)), get_edges(output.GetBlock(1)))
        self.assertEqual(len(watched.errors), 1)
        self.assertIn("block 1: ", watched.filter.GetErrorMessage())


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

    def test_names_that_are_not_there(self):
        run_python("""
import delaunayflip
assert not hasattr(delaunayflip, "vtkDelaunayFlop")
""")


@unittest.skipIf("_vtk_filter" in vtkDelaunayFlip.__module__, "the filter in Python has none")
class LiveUpdate(unittest.TestCase):

    def test_live_update(self):
        mesh = make_bad_mesh()
        at_once = Watched(mesh).run()
        live = Watched(mesh)
        live.filter.LiveUpdateOn()
        live.filter.SetIterationsPerUpdate(2)
        self.assertFalse(live.filter.GetNeedsUpdate())
        iterations = []
        while True:
            output = live.run()
            iterations.append(live.filter.GetNumberOfIterations())
            if not live.filter.Advance():
                break
        self.assertEqual(iterations[:3], [2, 4, 6])
        self.assertEqual(live.filter.GetStopReasonAsString(), "converged")
        self.assertEqual(get_cells(output.GetPolys()), get_cells(at_once.GetPolys()))

    def test_live_update_goes_on_if_points_are_only_read(self):
        mesh = make_bad_mesh()
        live = Watched(mesh)
        live.filter.LiveUpdateOn()
        steps, continues = 0, True
        while continues and steps < 100:
            live.run()
            mesh.GetPoints().Modified()
            continues, steps = live.filter.Advance(), steps + 1
        self.assertLess(steps, 100)


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
assert view.GetColorBy() == view.COLOR_BY_SMALLEST_ANGLE
""")


def list_properties():
    """The properties with both a setter and a getter in the class itself, not in a base class."""
    own = set(dir(vtkDelaunayFlip)) - set(dir(vtkPolyDataAlgorithm))
    names = [name[3:] for name in own if name.startswith("Set")]
    return sorted(name for name in names if "Get" + name in own)


def change_property(flip, name):
    """Gives a property another value; numbers become larger by 1, which is always valid."""
    value = getattr(flip, "Get" + name)()
    other = not value if isinstance(value, bool) else "x" if isinstance(value, str) else value + 1
    getattr(flip, "Set" + name)(other)
    return getattr(flip, "Get" + name)() != value


class Properties(unittest.TestCase):

    def read_print_out(self, flip):
        return dict(re.findall(r"^  (\w+): (.*)$", str(flip), re.MULTILINE))

    def test_the_list_is_that_of_the_class(self):
        known = {"Geometry", "Tolerance", "RegionArray", "LiveUpdate", "IterationsPerUpdate"}
        self.assertLessEqual(known, set(list_properties()))

    def test_print_out_shows_every_property(self):
        for name in list_properties():
            with self.subTest(name):
                flip = vtkDelaunayFlip()
                before = self.read_print_out(flip)
                self.assertTrue(change_property(flip, name))
                after = self.read_print_out(flip)
                changed = {line for line in after if after[line] != before.get(line)}
                self.assertEqual(changed, {name})


class Report(unittest.TestCase):

    def test_table_and_field_data(self):
        watched = Watched(make_bad_mesh())
        output = watched.run()
        table = watched.filter.GetIterations()
        self.assertEqual(
            [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())], COLUMNS)
        columns = {name: vtk_to_numpy(table.GetColumnByName(name)) for name in COLUMNS}
        rows = watched.filter.GetNumberOfIterations()
        self.assertEqual(columns["Iteration"].tolist(), list(range(1, rows + 1)))
        self.assertEqual(columns["Flipped"].sum(), watched.filter.GetTotalFlips())
        numpy.testing.assert_array_equal(
            columns["NonDelaunay"], columns["Flipped"] + columns["Excluded"] + columns["Blocked"])
        for name in COLUMNS:
            numpy.testing.assert_array_equal(
                vtk_to_numpy(output.GetFieldData().GetArray("DelaunayFlip:" + name)), columns[name])

    def test_totals(self):
        watched = Watched(make_rhombus())
        field = watched.run().GetFieldData()
        self.assertEqual(field.GetArray("DelaunayFlip:Converged").GetTuple1(0), 1)
        self.assertEqual(field.GetArray("DelaunayFlip:TotalFlips").GetTuple1(0), 1)
        self.assertEqual(field.GetArray("DelaunayFlip:NonDelaunayEdges").GetTuple1(0), 0)
        self.assertEqual(field.GetArray("DelaunayFlip:FixedEdges").GetTuple1(0), 4)
        self.assertEqual(field.GetAbstractArray("DelaunayFlip:StopReason").GetValue(0), "converged")
        self.assertEqual(field.GetAbstractArray("DelaunayFlip:GeometryUsed").GetValue(0), "planar")
        self.assertTrue(field.GetAbstractArray("DelaunayFlip:Backend").GetValue(0))
        self.assertEqual(watched.filter.GetGeometryUsed(), vtkDelaunayFlip.GEOMETRY_PLANAR)
        self.assertIs(watched.filter.GetConverged(), True)

    def test_flip_counts(self):
        watched = Watched(make_rhombus())
        watched.filter.GenerateFlipCountOn()
        counts = watched.run().GetCellData().GetArray("vtkDelaunayFlipCount")
        self.assertEqual(vtk_to_numpy(counts).tolist(), [1, 1])


if __name__ == "__main__":
    unittest.main()

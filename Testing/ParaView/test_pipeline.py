# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter in ParaView's pipelines: inputs and outputs."""

import math

from paraview import simple
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from PluginTesting import (
    Messages, PluginTest, fetch, get_edges, get_triangles, main, make_cells, make_fan, make_line,
    refresh)

COLUMNS = ["Iteration", "Tested", "NonDelaunay", "Flipped", "Excluded", "Blocked",
           "MinimumAngle", "Seconds"]


def get_rows(table, column):
    array = table.GetRowData().GetArray(column)
    return [array.GetTuple1(i) for i in range(array.GetNumberOfTuples())]


class Inputs(PluginTest):
    def test_sphere(self):
        flip = self.flip(simple.Sphere(ThetaResolution=60, PhiResolution=40))
        self.assertEqual(flip.GeometryUsed, "surface")
        self.assertEqual(flip.TotalFlips, 0)  # only rounding noise could flip
        flip.Tolerance = 1e-9
        refresh(flip)
        self.assertGreater(flip.TotalFlips, 0)
        self.assertEqual(flip.NumberOfNonDelaunayEdges, 0)

    def test_quads(self):
        flip = self.flip(simple.Plane(XResolution=5, YResolution=4))
        self.assertEqual(flip.GeometryUsed, "planar")
        self.assertEqual(len(get_triangles(fetch(flip))), 40)
        self.assertTrue(all(len(cell) == 3 for cell in get_triangles(fetch(flip))))

    def test_empty(self):
        empty = vtkPolyData()
        empty.SetPoints(vtkPoints())
        flip = self.flip(self.read(empty))
        self.assertEqual(fetch(flip).GetNumberOfCells(), 0)
        self.assertEqual(fetch(flip, 1).GetNumberOfRows(), 0)

    def test_composite(self):
        group = simple.GroupDatasets(
            Input=[self.read(make_fan(20), "a.vtp"), self.read(make_fan(30), "b.vtp")])
        output = fetch(self.flip(group))
        blocks = [output.GetPartition(i, 0) if hasattr(output, "GetPartition")
                  else output.GetBlock(i) for i in range(2)]
        flips = [block.GetFieldData().GetArray("DelaunayFlip:TotalFlips").GetTuple1(0) for block in blocks]
        alone = [self.flip(self.read(make_fan(n))).TotalFlips for n in (20, 30)]
        self.assertEqual(flips, alone)
        self.assertGreater(min(flips), 20)

    def test_sums_of_blocks(self):
        group = simple.GroupDatasets(
            Input=[self.read(make_fan(20), "a.vtp"), self.read(make_fan(30), "b.vtp")])
        flip = self.flip(group)
        alone = [self.flip(self.read(make_fan(n))) for n in (20, 30)]
        self.assertEqual(flip.TotalFlips, sum(one.TotalFlips for one in alone))
        self.assertEqual(flip.NumberOfIterations, max(one.NumberOfIterations for one in alone))
        table = fetch(flip, 1)
        self.assertTrue(table.IsA("vtkTable"), table.GetClassName())
        self.assertEqual(sum(get_rows(table, "Flipped")), flip.TotalFlips)
        self.assertEqual(table.GetNumberOfRows(), flip.NumberOfIterations)

    def test_a_block_that_fails(self):
        broken = make_fan(10)
        broken.SetPolys(make_cells([(0, 1, 77)]))
        broken.GetCellData().Initialize()
        group = simple.GroupDatasets(
            Input=[self.read(make_fan(20), "a.vtp"), self.read(broken, "b.vtp")])
        with Messages() as messages:
            flip = simple.DelaunayFlip(Input=group)
            refresh(flip)
        self.assertEqual(messages.text.count("ERROR"), 1, messages.text)
        self.assertRegex(flip.StopReason, "^failed: block [0-9]+ .*names point 77")
        self.assertGreater(flip.TotalFlips, 20)
        self.assertEqual(fetch(flip).GetNumberOfPoints(), 20)

    def test_time_series(self):
        files = [self.save(make_fan(n), f"fan_{i}.vtp") for i, n in enumerate((10, 20, 30))]
        series = simple.XMLPolyDataReader(FileName=files)
        flip = self.flip(series)
        for time, n in ((0, 10), (2, 30), (1, 20)):
            flip.UpdatePipeline(time)
            self.assertEqual(fetch(flip).GetNumberOfPoints(), n)
            alone = self.flip(self.read(make_fan(n)))
            self.assertEqual(get_triangles(fetch(flip)), get_triangles(fetch(alone)))

    def test_constraints(self):
        source, kept = self.read(make_fan(20)), frozenset((10, 19))
        flip = self.flip(source)
        self.assertNotIn(kept, get_edges(fetch(flip)))
        flip.Constraints = self.read(make_line(make_fan(20), 10, 19), "line.vtp")
        refresh(flip)
        self.assertIn(kept, get_edges(fetch(flip)))
        self.assertEqual(flip.NumberOfConstraintEdges, 1)
        self.assertEqual(flip.NumberOfUnmatchedConstraintEdges, 0)
        flip.Constraints = None
        self.assertNotIn(kept, get_edges(fetch(flip)))


class Regions(PluginTest):
    def test_cell_arrays_are_offered(self):
        flip = self.flip(self.read(make_fan(20)))
        domain = flip.SMProxy.GetProperty("RegionArray").FindDomain("vtkSMArrayListDomain")
        names = [domain.GetString(i) for i in range(domain.GetNumberOfStrings())]
        self.assertEqual(names, ["", "Side"])
        self.assertEqual(flip.RegionArray, "")

    def test_borders_stay(self):
        flip = self.flip(self.read(make_fan(20)), RegionArray="Side")
        self.assertIn(frozenset((10, 19)), get_edges(fetch(flip)))


class Outputs(PluginTest):
    def setUp(self):
        super().setUp()
        self.filter = self.flip(self.read(make_fan(20)))

    def test_table(self):
        table = fetch(self.filter, 1)
        self.assertEqual([table.GetColumnName(i) for i in range(table.GetNumberOfColumns())],
                         COLUMNS)
        self.assertEqual(table.GetNumberOfRows(), self.filter.NumberOfIterations)
        self.assertEqual(sum(get_rows(table, "Flipped")), self.filter.TotalFlips)

    def test_plot(self):
        plot = simple.PlotDelaunayFlips(Input=simple.OutputPort(self.filter, 1))
        table, iterations = fetch(plot), fetch(self.filter, 1)
        self.assertEqual(
            [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())],
            ["Iteration", "Flipped", "Excluded", "Blocked", "NonDelaunay", "Tested",
             "MinimumAngle"])
        self.assertEqual(get_rows(table, "Iteration")[0], 1)
        for column in ("Iteration", "Flipped", "Excluded", "Blocked", "Tested"):
            self.assertEqual(get_rows(table, column), get_rows(iterations, column))

    def test_plot_on_a_logarithmic_scale(self):
        """Counts of 0 are left out; the smallest angle has its own axis."""
        plot = simple.PlotDelaunayFlips(Input=simple.OutputPort(self.filter, 1), LogScale=1)
        self.assertTrue(all(math.isnan(count) for count in get_rows(fetch(plot), "Blocked")))
        self.assertGreater(get_rows(fetch(plot), "MinimumAngle")[0], 0)
        for before, after in zip(get_rows(fetch(self.filter, 1), "Excluded"),
                                 get_rows(fetch(plot), "Excluded")):
            self.assertTrue(before == after or before == 0 and math.isnan(after))

    def test_plot_of_one_row_or_none(self):
        for limit, rows in ((1, 2), (0, 0)):
            flip = self.flip(self.read(make_fan(20)), MaximumIterations=limit)
            plot = simple.PlotDelaunayFlips(Input=simple.OutputPort(flip, 1))
            self.assertEqual(get_rows(fetch(plot), "Iteration"), [1] * rows)

    def test_information(self):
        delaunay_already = self.flip(self.filter)
        self.assertEqual(delaunay_already.NumberOfIterations, 0)
        for flip in (self.filter, delaunay_already):
            information = flip.GetDataInformation().DataInformation
            arrays = information.GetFieldDataInformation()
            for name in ("Converged", "StopReason", "TotalFlips", "NonDelaunayEdges", "Backend"):
                self.assertIsNotNone(arrays.GetArrayInformation("DelaunayFlip:" + name), name)

    def test_read_back(self):
        self.assertEqual(self.filter.StopReason, "converged")
        self.assertEqual(self.filter.Converged, 1)
        self.assertEqual(self.filter.GeometryUsed, "planar")
        self.assertRegex(self.filter.BackendUsed, "^Threads: [0-9]+$")
        self.assertEqual(self.filter.NumberOfNonDelaunayEdges, 0)


class Progress(PluginTest):
    """The events for observers of the filter's object, such as the client's progress bar."""

    def setUp(self):
        super().setUp()
        self.filter = simple.DelaunayFlip(Input=self.read(make_fan(40)))
        self.object = self.filter.SMProxy.GetClientSideObject()

    def test_progress_goes_up(self):
        seen = []
        self.object.AddObserver(
            "ProgressEvent", lambda *_: seen.append(self.object.GetProgress()))
        refresh(self.filter)
        self.assertGreater(len(seen), 5)
        self.assertEqual(seen, sorted(seen))

    def abort_at(self, share):
        def stop(*_):
            self.object.SetAbortExecute(self.object.GetProgress() >= share)

        self.object.AddObserver("ProgressEvent", stop)
        refresh(self.filter)
        self.assertEqual(self.filter.StopReason, "aborted")
        return get_triangles(fetch(self.filter))

    def test_abort(self):
        self.assertEqual(len(self.abort_at(0.5)), 38)
        self.assertGreater(self.filter.NumberOfIterations, 0)
        self.assertGreater(self.filter.NumberOfNonDelaunayEdges, 0)

    def test_abort_before_the_first_iteration(self):
        before = get_triangles(fetch(self.filter.Input))
        self.assertEqual(self.abort_at(0.0), before)
        self.assertEqual(self.filter.NumberOfIterations, 0)


if __name__ == "__main__":
    main()

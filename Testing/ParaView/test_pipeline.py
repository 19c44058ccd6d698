# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter in ParaView's pipelines: inputs, outputs, progress, steps of a script; and that its
meshes are those of the command, which is built with another VTK."""

import os
import re
import subprocess
import textwrap
import unittest

from paraview import simple

from PluginTesting import (
    PluginTest, fetch, get_edges, get_triangles, main, make_fan, make_line,
    refresh)

HERE = os.path.dirname(os.path.abspath(__file__))
COMMAND = os.environ["DELAUNAYFLIP_COMMAND"]
COLUMNS = ["Iteration", "Tested", "NonDelaunay", "Flipped", "Excluded", "Blocked",
           "MinimumAngle", "Seconds"]


def get_rows(table, column):
    array = table.GetRowData().GetArray(column)
    return [array.GetTuple1(i) for i in range(array.GetNumberOfTuples())]


class Inputs(PluginTest):
    def test_composite(self):
        group = simple.GroupDatasets(
            Input=[self.read(make_fan(20), "a.vtp"), self.read(make_fan(30), "b.vtp")])
        flip = self.flip(group)
        alone = [self.flip(self.read(make_fan(n))) for n in (20, 30)]
        self.assertEqual(flip.TotalFlips, sum(one.TotalFlips for one in alone))
        self.assertEqual(flip.NumberOfIterations, max(one.NumberOfIterations for one in alone))
        table, output = fetch(flip, 1), fetch(flip)
        self.assertTrue(table.IsA("vtkTable"), table.GetClassName())
        self.assertEqual(sum(get_rows(table, "Flipped")), flip.TotalFlips)
        self.assertEqual(table.GetNumberOfRows(), flip.NumberOfIterations)
        for i, one in enumerate(alone):
            block = output.GetPartition(i, 0) if hasattr(output, "GetPartition") else output.GetBlock(i)
            flips = block.GetFieldData().GetArray("DelaunayFlip:TotalFlips").GetTuple1(0)
            self.assertEqual(flips, one.TotalFlips)

    def test_constraints(self):
        source, kept = self.read(make_fan(20)), frozenset((10, 19))
        flip = self.flip(source)
        self.assertNotIn(kept, get_edges(fetch(flip)))
        flip.Constraints = self.read(make_line(make_fan(20), 10, 19), "line.vtp")
        refresh(flip)
        self.assertIn(kept, get_edges(fetch(flip)))
        self.assertEqual(flip.NumberOfConstraintEdges, 1)
        self.assertEqual(flip.NumberOfUnmatchedConstraints, 0)
        flip.Constraints = None
        self.assertNotIn(kept, get_edges(fetch(flip)))


class Regions(PluginTest):
    def test_cell_arrays_are_offered_and_their_borders_stay(self):
        flip = self.flip(self.read(make_fan(20)))
        domain = flip.SMProxy.GetProperty("RegionArray").FindDomain("vtkSMArrayListDomain")
        names = [domain.GetString(i) for i in range(domain.GetNumberOfStrings())]
        self.assertEqual(names, ["", "Side"])
        self.assertEqual(flip.RegionArray, "")
        flip.RegionArray = "Side"
        refresh(flip)
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

    def test_plot_data(self):
        """ParaView's own filter draws the table."""
        plot = simple.PlotData(Input=simple.OutputPort(self.filter, 1))
        display = simple.Show(plot, simple.CreateView("XYChartView"))
        self.assertIn("Flipped", display.SeriesVisibility)
        self.assertEqual(get_rows(fetch(plot), "Flipped"), get_rows(fetch(self.filter, 1), "Flipped"))

    def test_read_back(self):
        """Also as field data; of a mesh that was Delaunay already, in place of earlier ones."""
        again = self.flip(self.filter)
        self.assertEqual((again.NumberOfIterations, again.TotalFlips), (0, 0))
        for flip in (self.filter, again):
            self.assertEqual((flip.StopReason, flip.Converged, flip.GeometryUsed,
                              flip.NonDelaunayAfter), ("converged", 1, "planar", 0))
            self.assertRegex(flip.BackendUsed, "^Threads: [0-9]+$")
            arrays = flip.GetDataInformation().DataInformation.GetFieldDataInformation()
            for name in ("Converged", "StopReason", "TotalFlips", "NonDelaunayAfter", "Backend"):
                self.assertIsNotNone(arrays.GetArrayInformation("DelaunayFlip:" + name), name)


class WithoutPlugin(PluginTest):
    def test_programmable_filter(self):
        """The script in the documentation."""
        with open(os.path.join(HERE, "..", "..", "Documentation", "start", "paraview.md"),
                  encoding="utf-8") as page:
            script = re.search(r"Its \*Script\*:\n\n((    .*\n|\n)+)", page.read()).group(1)
        flip = simple.ProgrammableFilter(
            Input=self.read(make_fan(20)), Script=textwrap.dedent(script))
        self.assertEqual(get_triangles(fetch(flip)),
                         get_triangles(fetch(self.flip(self.read(make_fan(20))))))


@unittest.skipUnless(os.path.exists(COMMAND), f"skipped: no command {COMMAND}")
class SameBits(PluginTest):
    def expect_same(self, path, options=(), **properties):
        flipped_by_command = self.path("command.vtp")
        environment = {name: value for name, value in os.environ.items()  # without ParaView's libraries
                       if name not in ("LD_LIBRARY_PATH", "PYTHONPATH")}
        subprocess.run([COMMAND, path, flipped_by_command, *options], check=True, timeout=120,
                       env=environment, stdout=subprocess.DEVNULL)
        before = simple.XMLPolyDataReader(FileName=[path])
        after = simple.XMLPolyDataReader(FileName=[flipped_by_command])
        triangles = get_triangles(fetch(self.flip(before, **properties)))
        # Not by assertEqual, which would take a minute to describe the difference.
        self.assertTrue(triangles == get_triangles(fetch(after)), "not the command's triangles")
        self.assertTrue(triangles != get_triangles(fetch(before)), "nothing was flipped")

    def test_plane(self):
        self.expect_same(self.save(make_fan(150)))

    def test_surface_and_terrain(self):
        sphere = simple.Sphere(ThetaResolution=300, PhiResolution=60)
        grid = simple.Triangulate(Input=simple.Plane(XResolution=120, YResolution=90))
        hills = simple.Calculator(
            Input=grid, CoordinateResults=1,
            Function="coordsX*(1+0.9*sin(9*coordsY))*iHat+coordsY*jHat+0.3*sin(8*coordsX)*kHat")
        for source, options, properties in (
                (sphere, ["--tolerance", "1e-9"], {"Tolerance": 1e-9}),
                (hills, ["--geometry", "planar-xy"], {"Geometry": "Planar XY"})):
            simple.SaveData(self.path("source.vtp"), source, DataMode="Binary")
            self.expect_same(self.path("source.vtp"), options, **properties)


if __name__ == "__main__":
    main()

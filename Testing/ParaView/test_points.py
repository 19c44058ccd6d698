# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay From Points in pipelines: of tables and blocks, with segments, in steps; its proxy; and
the example."""

import glob
import os
import random
import subprocess

from paraview import simple
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from PluginTesting import (
    PLUGIN, Messages, PluginTest, fetch, get_edges, get_triangles, main, make_cells, refresh)

EXAMPLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples",
                       "ParaView", "terrain_from_points.py")
KITE = ((0, 0, 1), (4, -1, 2), (8, 0, 3), (4, 1, 4))  # without segments, 1 and 3 are joined


def make_data(points, lines=(), polygons=()):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    for point in points:
        data.GetPoints().InsertNextPoint(point)
    data.SetLines(make_cells(lines))
    data.SetPolys(make_cells(polygons))
    return data


def make_doubles(name, values):
    array = vtkDoubleArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    return array


def make_cloud(count=300):
    generator = random.Random(2)
    return make_data([(generator.random(), generator.random(), 0) for _ in range(count)])


def make_particles(step):
    """The cloud after so many steps of up to a hundredth of the distance between particles."""
    cloud = make_cloud()
    generator = random.Random(step)
    for point in range(cloud.GetNumberOfPoints()):
        x, y, z = cloud.GetPoint(point)
        shift = [0.0006 * generator.uniform(-step, step) for _ in range(2)]
        cloud.GetPoints().SetPoint(point, x + shift[0], y + shift[1], z)
    return cloud


class Points(PluginTest):

    def apply(self, source, **properties):
        """Applies the filter. Returns it, and the messages."""
        with Messages() as messages:
            points = simple.DelaunayFromPoints(Input=source, **properties)
            refresh(points)
        return points, messages.text

    def test_segments(self):
        kite = self.read(make_data(KITE))
        points, text = self.apply(kite)
        self.assertEqual(text, "")
        self.assertIn(frozenset((1, 3)), get_edges(fetch(points)))
        points.Segments = self.read(make_data(KITE, [(0, 2)], [(0, 1, 2)]), "segments.vtp")
        refresh(points)
        self.assertEqual(len(get_triangles(fetch(points))), 1)
        self.assertEqual((points.NumberOfSegmentEdges, points.StopReason), (3, "converged"))
        arrays = points.GetDataInformation().DataInformation.GetFieldDataInformation()
        self.assertIsNotNone(arrays.GetArrayInformation("DelaunayFlip:OutsideTriangles"))

    def test_refinement(self):
        square = make_data([(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)])
        square.GetPointData().AddArray(make_doubles("Size", [2.0] * 4))
        square = self.read(square)
        points, text = self.apply(square, MinimumAngle=25, Regions=[1, 1, 7, 0.5, 9, 9, 8, 0])
        mesh = fetch(points)
        self.assertIn("1 region seed in the same part as an earlier one, not used", text)
        self.assertGreater(mesh.GetNumberOfCells(), 200)
        self.assertEqual({mesh.GetCellData().GetArray("Region").GetValue(i)
                          for i in range(mesh.GetNumberOfCells())}, {7})
        points.Regions = []
        points.SizeArray = "Size"
        points.PointLimit = 2000
        refresh(points)
        self.assertIsNone(fetch(points).GetCellData().GetArray("Region"))
        self.assertGreater(len(get_triangles(fetch(points))), 50)

    def test_table(self):
        with open(self.path("points.csv"), "w", encoding="utf-8") as file:
            file.write("east,north,up\n" + "".join(f"{x},{y},{z}\n" for x, y, z in KITE))
        table = simple.CSVReader(FileName=[self.path("points.csv")])
        source = simple.TableToPoints(Input=table, XColumn="east", YColumn="north", ZColumn="up")
        points, text = self.apply(source)
        self.assertEqual(text, "")
        self.assertEqual(len(get_triangles(fetch(points))), 2)
        self.assertTrue(fetch(points, 1).IsA("vtkTable"))

    def test_projection(self):
        """The plugin in Python does not fit planes and says so. Both have the sphere."""
        wall = self.read(make_data([(0, x, y) for x, y, _ in KITE]))
        points, text = self.apply(wall, Projection="Best-fitting plane")
        if PLUGIN.endswith(".py"):
            self.assertRegex(points.StopReason, "^failed: Projection")
            points.Projection = "XY"
            points, text = self.apply(self.read(make_data(KITE)))
        self.assertEqual((len(get_triangles(fetch(points))), text), (2, ""))
        octahedron = [(0, 0, 0), (90, 0, 0), (180, 0, 0), (-90, 0, 0), (7, 90, 0), (0, -90, 0)]
        points, text = self.apply(self.read(make_data(octahedron)), Projection="Sphere", Degrees=1)
        self.assertEqual((len(get_triangles(fetch(points))), text), (8, ""))

    def test_animation(self):
        """Particles of a time series, forwards and back. Each frame is that of a new filter."""
        files = [self.save(make_particles(step), f"particles{step}.vtp") for step in range(4)]
        points, text = self.apply(simple.XMLPolyDataReader(FileName=files))
        view = simple.CreateRenderView()
        simple.Show(points, view)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        are_followed = []
        with Messages() as messages:
            for step in (0, 1, 2, 3, 1, 0):
                scene.AnimationTime = scene.TimeKeeper.TimestepValues[step]
                simple.Render(view)
                frame = fetch(points)
                alone = simple.XMLPolyDataReader(FileName=files[step:step + 1])
                fresh, _ = self.apply(alone, KeepSession="On")  # which sorts the triangles, too
                self.assertEqual(get_triangles(frame), get_triangles(fetch(fresh)))
                rounds = frame.GetFieldData().GetArray("DelaunayFlip:MoveRounds").GetTuple1(0)
                are_followed.append(rounds > 0)
        self.assertEqual(text + messages.text, "")
        self.assertEqual(are_followed, 6 * [True])

    def test_closed_line(self):
        """ParaView's own sources make rings of this kind only. Off, it is a breakline."""
        ring = simple.PolyLineSource(Points=[1, 1, 0, 5, 1, 0, 5, 5, 0, 1, 5, 0], Closed=1)
        survey = make_data([(0, 0, 0), (6, 0, 0), (6, 6, 0), (0, 6, 0), (3, 2, 0)])
        points, text = self.apply(self.read(survey), Segments=ring)
        self.assertEqual((len(get_triangles(fetch(points))), text), (4, ""))
        points.ClosedLinesAsRings = 0
        refresh(points)
        self.assertEqual(len(get_triangles(fetch(points))), 12)

    def test_interpolation(self):
        """Onto an image, with an outline; the values are those of a plane."""
        kite = self.read(make_data([(0, 0, 1), (8, 0, 9), (8, 8, 9), (0, 8, 1)]))
        image = simple.Wavelet(WholeExtent=[0, 10, 0, 8, 0, 0])
        with Messages() as messages:
            values = simple.InterpolateFromPointsDelaunay(Input=image, Source=kite)
            refresh(values)
        self.assertEqual((values.StopReason, messages.text), ("converged", ""))
        data = fetch(values).GetPointData()
        mask, heights = (data.GetArray(name) for name in ("vtkValidPointMask", "Elevation"))
        self.assertEqual([mask.GetTuple1(i) for i in range(11)], [1] * 9 + [0] * 2)
        self.assertEqual([heights.GetValue(i) for i in range(9)], list(range(1, 10)))
        self.assertIsNotNone(data.GetArray("RTData"))
        values.Segments = self.read(make_data([(2, 2, 3), (6, 2, 7), (2, 6, 3)], (), [(0, 1, 2)]), "part.vtp")
        refresh(values)
        mask = fetch(values).GetPointData().GetArray("vtkValidPointMask")
        self.assertEqual(sum(mask.GetTuple1(i) for i in range(99)), 15)

    def test_messages(self):
        line = make_data([(0, 0, 0), (1, 1, 0), (2, 2, 0)])
        _, text = self.apply(self.read(line))
        self.assertIn("points without a triangle", text)
        wrong = self.read(make_data(KITE, (), [(0, 1, 3, 2)]), "wrong.vtp")
        points, text = self.apply(self.read(make_data(KITE)), Segments=wrong)
        self.assertIn("ring 0", text)
        self.assertTrue(points.StopReason.startswith("failed: "))


class Example(PluginTest):

    def test_picture(self):
        environment = dict(
            os.environ, PV_PLUGIN_PATH=os.path.dirname(os.environ["DELAUNAYFLIP_PLUGIN"]))
        told = subprocess.run(
            [os.environ["DELAUNAYFLIP_PVPYTHON"], EXAMPLE, self.folder], env=environment,
            timeout=120, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, encoding="utf-8", check=True).stdout
        self.assertRegex(told, "^[0-9]+ triangles, 1[0-9]+ edges along segments\n$")
        self.assertEqual(len(glob.glob(os.path.join(self.folder, "terrain.png"))), 1)


if __name__ == "__main__":
    main()

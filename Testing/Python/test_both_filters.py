# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkDelaunayFlip in C++ and in Python give the same outputs, bit for bit, and the same messages."""
import dataclasses
import itertools
import math
import pathlib
import random
import re
import unittest
import unittest.mock
import warnings
from xml.etree import ElementTree

import delaunayflip
from delaunayflip import (
    vtkDelaunayFlip as CxxFilter, vtkDelaunayFlipInterpolator as CxxInterpolator,
    vtkDelaunayFlipPoints as CxxPoints)
from delaunayflip import _vtk_filter
from delaunayflip._vtk_filter import _ANSWERS, _COMMON_ANSWERS, vtkDelaunayFlip as PythonFilter
from delaunayflip._vtk_interpolator import vtkDelaunayFlipInterpolator as PythonInterpolator
from delaunayflip._vtk_point_filter import vtkDelaunayFlipPoints as PythonPoints

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import (
    VTK_DOUBLE_MAX, vtkIdList, vtkObject, vtkPoints, vtkVariant, vtkVariantArray)
from vtkmodules.vtkCommonDataModel import (
    vtkImageData, vtkMultiBlockDataSet, vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection, vtkPolyData, vtkRectilinearGrid, vtkTable)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

from test_vtk_delaunay_flip import (
    Watched, add_array, get_cells, list_properties, make_bad_mesh, make_cells, make_mesh,
    make_rhombus)


def make_polygon_mesh(seed=3, side=9):
    """A folded grid of triangles, quads and octagons, with strips, verts, lines and attributes."""
    draw = random.Random(seed)
    points = [(x + 0.8 * draw.random(), y + 0.8 * draw.random(), 0.3 * draw.random())
              for y in range(side) for x in range(side)]
    points[-3:] = [(x, y, 0.0) for x, y, _ in points[-3:]]
    cells, strips = [], []
    for y in range(side - 1):
        for x in range(0, side - 1, 2):
            a, b = y * side + x, (y + 1) * side + x
            kind = draw.randrange(4)
            if kind == 0:
                cells += [(a, a + 1, b + 1, b), (a + 1, a + 2, b + 2, b + 1)]
            elif kind == 1:
                cells.append((a, a + 1, a + 2, b + 2, b + 1, b))
            elif kind == 2:
                strips.append((a, b, a + 1, b + 1, a + 2, b + 2))
            else:
                cells += [(a, a + 1, b), (a + 1, b + 1, b), (a + 1, a + 2, b + 2, b + 1), (a, b)]
    mesh = make_mesh(points, cells)
    mesh.SetStrips(make_cells(strips))
    mesh.SetVerts(make_cells([(0,), (5,)]))
    mesh.SetLines(make_cells([(0, 1, 2), (10, 31)]))
    count = mesh.GetNumberOfCells()
    add_array(mesh.GetCellData(), "Number", numpy.arange(count))
    add_array(mesh.GetPointData(), "Depth", numpy.arange(len(points)))
    add_array(mesh.GetCellData(), "Ids", numpy.arange(count))
    add_array(mesh.GetCellData(), "Normals", numpy.tile([0.0, 0.0, -1.0], (count, 1)))
    mesh.GetCellData().SetActiveGlobalIds("Ids")
    mesh.GetCellData().SetActiveNormals("Normals")
    mesh.GetCellData().SetActiveVectors("Normals")
    mesh.GetCellData().SetActiveScalars("Ids")
    add_array(mesh.GetCellData(), None, numpy.arange(count))
    return mesh


def add_ghosts(mesh):
    cells = numpy.arange(mesh.GetNumberOfCells() // 2)
    add_array(mesh.GetCellData(), "vtkGhostType", (cells % 3).astype(numpy.uint8))


def add_regions(mesh):
    cells = range(mesh.GetNumberOfCells())
    heights = [((0.0, -0.0, math.nan, -math.nan)[cell // 7 % 4], cell // 20) for cell in cells]
    add_array(mesh.GetCellData(), "Tree", [("oak", "elm")[cell // 11 % 2] for cell in cells])
    add_array(mesh.GetCellData(), "Height", heights)


def make_constraints(mesh, kind):
    """Lines and a polygon at places of the mesh, renumbered; some places are not in it."""
    points = vtk_to_numpy(mesh.GetPoints().GetData())[::-1][:40].astype(kind)
    points = numpy.concatenate([points, [[99, 99, 99], [math.nan, 0, 0]]]).astype(kind)
    points[points == 0] = -0.0
    constraints = vtkPolyData()
    constraints.SetPoints(make_mesh(points, []).GetPoints())
    constraints.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    constraints.SetLines(make_cells([(0, 1, 2, 12), (5, 5, 33), (3, 40), (2, 1), (7, 41)]))
    constraints.SetPolys(make_cells([(20, 21, 30)]))
    return constraints


def list_arrays(data):
    return [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]


def read_array(array):
    values = [str(array.GetVariantValue(i)) for i in range(array.GetNumberOfValues())]
    return array.GetName(), array.GetDataTypeAsString(), array.GetNumberOfComponents(), values


def read_mesh(mesh):
    """All that is in a mesh, but the time that it took."""
    if mesh is None:
        return None
    parts = [mesh.GetClassName()]
    if mesh.IsA("vtkPolyData"):
        for cells in (mesh.GetVerts(), mesh.GetLines(), mesh.GetPolys(), mesh.GetStrips()):
            parts.append((get_cells(cells), cells.GetConnectivityArray().GetDataTypeSize()))
    if mesh.IsA("vtkDataSet"):
        data = (mesh.GetPointData(), mesh.GetCellData())
        parts += [read_array(array) for attributes in data for array in list_arrays(attributes)]
        parts += [attribute and attribute.GetName() for attributes in data for attribute in map(
            attributes.GetAbstractAttribute, range(attributes.NUM_ATTRIBUTES))]
    parts += [read_array(array) for array in list_arrays(mesh.GetFieldData())
              if not array.GetName().endswith(":Seconds")]
    return parts


def get_text(messages):
    return [message.split("): ", 1)[1].strip() for message in messages]


def list_blocks(output):
    if output.IsA("vtkMultiBlockDataSet"):
        return [output.GetBlock(i) for i in range(output.GetNumberOfBlocks())]
    if output.IsA("vtkPartitionedDataSet"):
        return [output.GetPartition(i) for i in range(output.GetNumberOfPartitions())]
    if output.IsA("vtkPartitionedDataSetCollection"):
        return [mesh for i in range(output.GetNumberOfPartitionedDataSets())
                for mesh in list_blocks(output.GetPartitionedDataSet(i))]
    return [output]


def cut_triangles(mesh, count):
    """Triangle i is in part i % count, with points of its own."""
    points, cells = vtk_to_numpy(mesh.GetPoints().GetData()), numpy.array(get_cells(mesh.GetPolys()))
    parts = [numpy.unique(cells[part::count], return_inverse=True) for part in range(count)]
    return [make_mesh(points[used], ids.reshape(-1, 3)) for used, ids in parts]


def join(parts):
    data = vtkPartitionedDataSet()
    for part in parts:
        data.SetPartition(data.GetNumberOfPartitions(), part)
    return data


def collect(blocks):
    data = vtkPartitionedDataSetCollection()
    for number, parts in enumerate(blocks):
        data.SetPartitionedDataSet(number, join(parts))
    return data


ANSWERS = sorted({*_COMMON_ANSWERS, *_ANSWERS} - {"Advance", "Step", "GetNeedsUpdate"})


def run(kind, data, prepare=lambda flip: None):
    """What a filter puts out and tells for an input. `prepare` sets it up."""
    watched = Watched(data, kind)
    prepare(watched.filter)
    watched.filter.Update()
    return {
        "meshes": [read_mesh(block) for block in list_blocks(watched.filter.GetOutputDataObject(0))],
        "table": [read_array(column) for column in list_arrays(watched.filter.GetIterations().GetRowData())
                  if column.GetName() != "Seconds"],
        "errors": get_text(watched.errors), "warnings": get_text(watched.warnings),
        "answers": {name: getattr(watched.filter, name)()
                    for name in ANSWERS if hasattr(kind, name)}}


class MovingSource(VTKPythonAlgorithmBase):
    """Points with data and triangles, which move by their time. It has time steps if there are any."""

    def __init__(self, times):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")
        self._times = times

    def RequestInformation(self, request, inInfo, outInfo):
        info, asked = outInfo.GetInformationObject(0), vtkStreamingDemandDrivenPipeline
        if self._times:
            info.Set(asked.TIME_STEPS(), self._times, len(self._times))
            info.Set(asked.TIME_RANGE(), (self._times[0], self._times[-1]), 2)
        return 1

    def RequestData(self, request, inInfo, outInfo):
        info, asked = outInfo.GetInformationObject(0), vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        mesh = make_bad_mesh()
        if self._times and info.Has(asked):
            vtk_to_numpy(mesh.GetPoints().GetData())[:, 0] += 0.01 * info.Get(asked)
        mesh.SetLines(make_cells([(0, 1), (1, 2)]))
        add_array(mesh.GetPointData(), "x", vtk_to_numpy(mesh.GetPoints().GetData())[:, 0])
        vtkPolyData.GetData(outInfo, 0).ShallowCopy(mesh)
        return 1


class Pair:
    """A class in C++ and that in Python."""

    kinds = CxxFilter, PythonFilter
    maxDiff = 2000

    def expect_same(self, data, prepare=lambda flip: None):
        cxx, python = (run(kind, data, prepare) for kind in self.kinds)
        for key in cxx:
            self.assertEqual(cxx[key], python[key], key)
        return cxx

    def test_interface(self):
        """All methods and constants of the C++ class, but the types of its enumerators and transforms."""
        cxx, python = self.kinds
        own = {name for name in set(dir(cxx)) - set(dir(vtkObject))
               if not re.search("^_|Type$|^SetOutput$|(?i:transform)", name)}
        self.assertEqual(own - set(dir(python)), set())
        self.assertIsNot(cxx, python)
        for name in own:
            value = getattr(cxx, name)
            if isinstance(value, int):
                self.assertEqual(getattr(python, name), value, name)

    def test_times(self):
        """The outputs have the times of all inputs, and change with each of them."""
        steps, span = (getattr(vtkStreamingDemandDrivenPipeline, name)() for name in ("TIME_STEPS", "TIME_RANGE"))
        for given in (((0.0, 1.0), ()), ((), (0.0, 2.0)), ((0.0, 1.0), (-1.0, 1.0, 3.0)), ((), ())):
            expected, told = sorted({*given[0], *given[1]}), []
            for kind in self.kinds:
                filter_, told_here = kind(), []
                sources = [MovingSource(times) for times in given]
                for port, source in enumerate(sources):
                    filter_.SetInputConnection(port, source.GetOutputPort())
                filter_.UpdateInformation()
                for port in range(2):
                    info = filter_.GetOutputInformation(port)
                    self.assertEqual([info.Get(steps, i) for i in range(info.Length(steps))], expected)
                    self.assertEqual(
                        list(info.Get(span)) if info.Has(span) else [], expected[:1] + expected[-1:])
                for time in expected:
                    filter_.UpdateTimeStep(time)
                    output = filter_.GetOutputDataObject(0)
                    told_here.append((output.GetBounds(), read_mesh(output)))
                for i in range(1, len(told_here)):
                    self.assertNotEqual(told_here[i - 1], told_here[i])
                told.append(told_here)
            self.assertEqual(*told)

    def test_names_of_numbers(self):
        """Field data has names of the report, in upper camel case."""
        told = Watched(make_cloud() if self.kinds[0] is CxxPoints else make_bad_mesh(), self.kinds[0])
        fields = {array.GetName() for array in list_arrays(told.run().GetFieldData())}
        numbers = {field.name.title().replace("_", "") for field in dataclasses.fields(delaunayflip.Report)}
        columns = {"Iteration", "Tested", "NonDelaunay", "Flipped", "Excluded", "Blocked", "MinimumAngle", "Seconds"}
        others = {name for name in fields if name.removeprefix("DelaunayFlip:") not in numbers}
        self.assertEqual(others, {"DelaunayFlip:" + name for name in {"Converged", "Summary", *columns}})
        self.assertGreater(len(fields), 30 if self.kinds[0] is CxxPoints else 20)

    def test_defaults_and_limits(self):
        cxx, python = (kind() for kind in self.kinds)
        for name in list_properties(self.kinds[0]):
            default = getattr(cxx, "Get" + name)()
            self.assertEqual(default, getattr(python, "Get" + name)(), name)
            for value in () if isinstance(default, (bool, str)) else (-7, 1000):
                for flip in (cxx, python):
                    getattr(flip, "Set" + name)(value)
                self.assertEqual(
                    getattr(cxx, "Get" + name)(), getattr(python, "Get" + name)(), name)


class Shown(unittest.TestCase):
    """ParaView and the command show the properties with their defaults and choices."""

    def test_command(self):
        """`Documentation.Shell` compares the page with the command."""
        page = (pathlib.Path(__file__).parents[2] / "Documentation/reference/command.md").read_text()
        rows = re.findall(r"^\| `--([-a-z]+) ([^`]*)` \| .* \[([^][]+)\] \|$", page, re.MULTILINE)
        known = {"MaxDeviation": "MaximumDeviation", "MaxIterations": "MaximumIterations",
                 "Threads": "NumberOfThreads", "Pieces": "NumberOfPieces", "Device": "DeviceId",
                 "Heights": "SegmentHeights", "RasterMethod": "Method"}
        properties = {item.name: item for item in (*PythonFilter.properties, *PythonInterpolator.properties)}
        compared = []
        for option, choices, default in rows:
            name = option.title().replace("-", "")
            item = properties.get(known.get(name, name))
            if item is None:
                continue
            compared.append(item.name)
            if item.choices:
                words = [word.replace("-", "") for word in choices.strip("{}").split(",")]
                words = ["bestfittingplane" if word == "plane" else word for word in words]
                self.assertEqual(words, [choice.lower() for choice in item.choices[:len(words)]])
                self.assertEqual(default.replace("-", ""), words[item.default])
            else:
                self.assertEqual(min(float(default), VTK_DOUBLE_MAX), item.default, option)
        self.assertGreater(len(compared), 14, compared)

    def test_panel_of_paraview(self):
        text = (pathlib.Path(__file__).parents[2] / "Plugin/DelaunayFlip.xml").read_text(encoding="utf-8")
        for name, entity in re.findall(r"<!ENTITY (\w+) '([^']*)'", text):
            self.assertLess(len(entity), 4096, name)  # the limit of Qt, with which ParaView reads it
        panel = ElementTree.parse(pathlib.Path(__file__).parents[2] / "Plugin/DelaunayFlip.xml")
        proxies = {proxy.get("class").replace("vtkP", "vtk"): proxy for proxy in panel.iter("SourceProxy")}
        for kind in (PythonFilter, PythonPoints, PythonInterpolator):
            shown = {element.get("name"): element for element in proxies[kind.name]}
            for item in kind.properties:
                if kind is PythonInterpolator and item.name in (
                        "LiveUpdate", "IterationsPerUpdate", "Paused", "PassSegments",
                        "KeepSession"):
                    continue
                self.expect_shown(item, shown[item.name])

    def expect_shown(self, item, element):
        default = element.get("default_values", "")
        if not isinstance(item.default, str):
            default = float(default or 0)
        self.assertEqual(default, item.default, item.name)
        domain = next((child for child in element if child.tag.endswith("RangeDomain")), None)
        entries = [re.sub("[- ]", "", entry.get("text")).lower() for entry in element.iter("Entry")]
        self.assertEqual(entries, [choice.lower() for choice in item.choices], item.name)
        if item.low is not None and not item.choices:
            high = float(domain.get("max", "inf"))
            self.assertEqual(float(domain.get("min")), item.low, item.name)
            self.assertEqual(min(high, 2**31 - 1), min(item.high, 2**31 - 1), item.name)


class Same(Pair, unittest.TestCase):

    def test_polygons_and_attributes(self):
        def prepare(flip):
            flip.GenerateFlipCountOn()
            flip.GenerateQualityOn()
            flip.SetGeometryToPlanarXY()

        for seed in range(5):
            mesh = make_polygon_mesh(seed)
            add_ghosts(mesh)
            self.expect_same(mesh, prepare)
            self.expect_same(mesh, lambda flip: (prepare(flip), flip.TriangulateOff()))
            self.expect_same(mesh, lambda flip: (prepare(flip), flip.SetGeometryToSurface()))

    def test_repeated_corners(self):
        mesh = make_rhombus()
        mesh.SetPolys(make_cells([(0, 1, 2, 2), (1, 3, 3, 1), (0, 2, 3, 0), (0, 2, 0, 2), (0, 2, 2)]))
        add_array(mesh.GetCellData(), "Number", numpy.arange(5))
        told = self.expect_same(mesh)
        self.assertEqual(told["answers"]["GetTotalFlips"], 1)
        self.assertIn("2 polygons with fewer than three", told["warnings"][0])
        self.assertIn("1 triangle with a repeated point id (first: 4)", told["warnings"][0])
        self.expect_same(mesh, lambda flip: flip.TriangulateOff())
        mesh = make_rhombus()
        mesh.SetStrips(make_cells([(0, 1, 2, 2, 0, 2, 3)]))
        mesh.SetPolys(make_cells([]))
        self.assertEqual(self.expect_same(mesh)["answers"]["GetTotalFlips"], 1)

    def test_constraints(self):
        mesh = make_polygon_mesh()
        double = make_polygon_mesh()
        double.SetPolys(make_cells(get_cells(mesh.GetPolys()) * 2))  # crowded places
        for kind in (numpy.float32, numpy.float64):
            for data in (mesh, double, make_bad_mesh()):
                constraints = make_constraints(data, kind)
                for settings in ("InsertConstraints", "InsertLines", "LinesAsConstraints"):
                    def prepare(flip, settings=settings, constraints=constraints):
                        flip.SetGeometryToPlanarXY()
                        flip.SetConstraintsData(constraints)
                        getattr(flip, "Set" + settings)(settings == "InsertLines")
                    self.expect_same(data, prepare)

    def test_constraints_beside_unused_points(self):
        mesh, line = make_rhombus(), vtkPolyData()
        for corner in (1, 3):
            mesh.GetPoints().InsertNextPoint(mesh.GetPoint(corner))
        mesh.GetPoints().InsertNextPoint(5.0, 5.0, 0.0)
        points = vtkPoints()
        for corner in (1, 3):
            points.InsertNextPoint(mesh.GetPoint(corner))
        line.SetPoints(points)
        line.SetLines(make_cells([(0, 1)]))

        def prepare(flip):
            flip.SetConstraintsData(line)
            flip.InsertConstraintsOn()

        answers = self.expect_same(mesh, prepare)["answers"]
        self.assertEqual(answers["GetNumberOfInsertedConstraints"], 1)
        self.assertEqual(answers["GetNumberOfUnmatchedConstraints"], 0)

    def test_regions(self):
        mesh = make_polygon_mesh()
        add_regions(mesh)
        for name in ("Tree", "Height", "Number", "Nothing"):
            self.expect_same(mesh, lambda flip, name=name: flip.SetRegionArray(name))

    def test_regions_of_variants(self):
        given = ((1.23456789, 1.23456788, 1), (0.0, -0.0, 0), (math.nan, -math.nan, 0), (2, 2.0, 0),
                 (2**53, 2**53 + 1, 1), ("oak", "oak", 0), ("oak", 1.5, 1))
        for *values, keeps in given:
            mesh, labels = make_rhombus(), vtkVariantArray()
            labels.SetName("Label")
            for value in values:
                labels.InsertNextValue(vtkVariant(value))
            mesh.GetCellData().AddArray(labels)
            told = self.expect_same(mesh, lambda flip: flip.SetRegionArray("Label"))
            self.assertIn(("DelaunayFlip:TotalFlips", "idtype", 1, [str(1 - keeps)]), told["meshes"][0])

    def test_labels_replace_global_ids(self):
        mesh = make_rhombus()
        add_array(mesh.GetCellData(), "Region", numpy.arange(2))
        mesh.GetCellData().SetActiveGlobalIds("Region")
        for kind in self.kinds:
            flip = kind()
            flip.SetInputData(mesh)
            flip.AddRegion(0, 0.5, 7, 0)
            flip.Update()
            self.assertIsNone(flip.GetOutput().GetCellData().GetGlobalIds())

    def test_what_hides_bad_edges(self):
        mesh = make_rhombus()
        for cells, hint in (([(0, 1, 2), (3, 2, 0)], "hint: 1 bad edge kept between triangles that are wound "
                             "differently; wind all the same way (vtkPolyDataNormals with ConsistencyOn)"),
                            ([(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)], "hint: 2 triangles with the corners")):
            mesh.SetPolys(make_cells(cells))
            told = self.expect_same(mesh)
            self.assertIn(hint, told["answers"]["GetSummary"])

    def test_refinement(self):
        """Refines polygons and strips with data, ghosts, regions, constraints and sizes."""
        for triangulate, kind in itertools.product((True, False), (float, numpy.float32)):
            mesh = make_polygon_mesh()
            points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(kind)
            mesh.SetPoints(vtkPoints())
            mesh.GetPoints().SetData(numpy_to_vtk(points, deep=True))
            add_regions(mesh)
            add_ghosts(mesh)
            count = len(points)
            add_array(mesh.GetPointData(), "real", points[:, :2] / 7)
            add_array(mesh.GetPointData(), "size", numpy.full(count, 0.8))
            add_array(mesh.GetPointData(), "text", list("abcde" * count)[:count])
            add_array(mesh.GetPointData(), "numbers", numpy.arange(count))
            mesh.GetPointData().SetActiveGlobalIds("numbers")

            def prepare(flip):
                flip.SetGeometryToPlanarXY()
                flip.SetTriangulate(triangulate)
                flip.SetMinimumAngle(20.0)
                flip.SetMaximumArea(0.1)
                flip.SetPointLimit(4000)

            told = self.expect_same(mesh, lambda flip: (
                prepare(flip), flip.GenerateQualityOn(), flip.GenerateFlipCountOn(), flip.SetRegionArray("Tree"),
                flip.SetConstraintsData(make_constraints(mesh, kind))))
            self.assertEqual(told["errors"], [])
            self.assertNotIn(("DelaunayFlip:RefinementPoints", "vtkIdTypeArray", 1, ["0"]), told["meshes"][0])
            self.assertGreater(len(told["meshes"][0][3][0]), 100)
            told = self.expect_same(mesh, lambda flip: (
                prepare(flip), flip.SetSizeArray("size"), flip.KeepBoundaryOn(), flip.SetMaximumEdge(0.7)))
            self.assertEqual(told["errors"], [])
            told = self.expect_same(mesh, lambda flip: (
                prepare(flip), flip.SetRegionArray("Tree"), flip.AddRegion(*points[0, :2], 7, 0.05),
                flip.AddRegion(1e3, 1e3, -3, 0.0)))
            self.assertEqual(told["errors"], [])
            self.assertIn("Region", str(told["meshes"]))
            self.assertIn("1 region seed outside", told["warnings"][0])
            told = self.expect_same(mesh, lambda flip: (flip.AddRegion(1, 1, 1.5, 0.0), flip.LinesAsConstraintsOff()))
            self.assertIn("the label of region 0 must be an integer", told["errors"][0])
            for name in ("sizes", "text", "real"):
                told = self.expect_same(mesh, lambda flip: flip.SetSizeArray(name))
                self.assertIn(f'SizeArray: ', told["errors"][0])
            told = self.expect_same(mesh, lambda flip: (prepare(flip), flip.SetPointLimit(count + 5)))
            self.assertIn("PointLimit allows no more", told["warnings"][0])
            told = self.expect_same(mesh, lambda flip: (prepare(flip), flip.SetGeometryToSurface()))
            self.assertIn("surface in space", told["errors"][0])
            told = self.expect_same(join([make_rhombus(), make_rhombus()]), prepare)
            self.assertIn("several partitions", told["errors"][0])

    def test_lines_after_refinement(self):
        """Lines that are constraints get the points that refinement adds on their edges."""
        mesh = make_rhombus()
        mesh.SetLines(make_cells([(0, 2, 3), (1, 0)]))

        def prepare(flip):
            flip.SetGeometryToPlanarXY()
            flip.SetMaximumEdge(0.3)

        told = self.expect_same(mesh, prepare)
        self.assertEqual(told["errors"], [])
        for is_constraint in (True, False):
            flip = CxxFilter()
            flip.SetInputData(mesh)
            prepare(flip)
            flip.SetLinesAsConstraints(is_constraint)
            flip.Update()
            output, ids, edges = flip.GetOutput(), vtkIdList(), set()
            for cell in range(output.GetNumberOfPolys()):
                output.GetPolys().GetCellAtId(cell, ids)
                corners = [ids.GetId(k) for k in range(3)]
                edges.update(frozenset(pair) for pair in itertools.combinations(corners, 2))
            self.assertEqual(output.GetNumberOfLines(), 2)
            paths = []
            for cell in range(2):
                output.GetLines().GetCellAtId(cell, ids)
                paths.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
            pairs = [frozenset(pair) for path in paths for pair in itertools.pairwise(path)]
            self.assertEqual(all(pair in edges for pair in pairs), is_constraint)
            self.assertEqual([(path[0], path[-1]) for path in paths], [(0, 3), (1, 0)])
            self.assertIn(2, paths[0])
            self.assertEqual(len(pairs) > 9, is_constraint)

    def test_results_of_an_earlier_update(self):
        points, flip = CxxPoints(), CxxFilter()
        points.SetInputData(make_cloud())
        flip.SetInputConnection(points.GetOutputPort())
        flip.GenerateFlipCountOn()
        flip.GenerateQualityOn()
        flip.Update()
        self.expect_same(flip.GetOutput())

    def test_maximum_deviation(self):
        def prepare(flip):
            flip.SetGeometryToSurface()
            flip.SetFeatureAngle(180)
            flip.SetMaximumDeviation(0.05)

        told = self.expect_same(make_polygon_mesh(), prepare)
        self.assertGreater(told["answers"]["GetBlockedByDeviation"], 0)
        self.assertGreater(told["answers"]["GetTotalFlips"], 0)

    def test_failures(self):
        bad = make_rhombus()
        bad.SetPolys(make_cells([(0, 1, 2), (0, 2, 44)]))
        quad = make_rhombus()
        quad.SetPolys(make_cells([(0, 1, 2, 3), (0, 1, 2, -4)]))
        line = make_rhombus()
        line.SetLines(make_cells([(0, 9)]))
        for mesh in (bad, quad, line):
            self.assertEqual(len(self.expect_same(mesh)["errors"]), 1)
        self.expect_same(make_rhombus(), lambda flip: flip.SetTolerance(3))
        self.expect_same(make_rhombus(), lambda flip: flip.SetMaximumDeviation(-1))
        self.expect_same(make_rhombus(), lambda flip: flip.SetBackendToCUDA())
        self.expect_same(make_rhombus(), lambda flip: flip.SetConstraintsData(bad))
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, make_rhombus())
        self.expect_same(make_rhombus(), lambda flip: flip.SetInputDataObject(1, blocks))

    def test_warnings(self):
        mesh = make_polygon_mesh()
        mesh.SetPolys(make_cells(get_cells(mesh.GetPolys()) + [(1, 1, 2, 3), (4, 4, 4), (4, 4, 5)]))
        for data in (mesh.GetCellData(), mesh.GetPointData()):
            add_array(data, "Short", [])
        mesh.GetPoints().SetPoint(7, math.nan, 0, 0)
        ghosts = numpy.ones(mesh.GetNumberOfCells(), numpy.int32)
        add_array(mesh.GetCellData(), "vtkGhostType", ghosts)
        told = self.expect_same(mesh)
        self.assertIn("Short", told["warnings"][0])

    def test_blocks(self):
        blocks = vtkMultiBlockDataSet()
        image = vtkImageData()
        image.SetDimensions(2, 2, 2)
        broken = make_rhombus()
        broken.SetPolys(make_cells([(0, 1, 44)]))
        for i, mesh in enumerate((make_rhombus(), image, None, broken, make_bad_mesh())):
            blocks.SetBlock(i, mesh)
        told = self.expect_same(blocks, lambda flip: flip.TrackQualityOn())
        self.assertEqual(len(told["warnings"]), 1)
        self.assertEqual(len(told["errors"]), 1)
        constraints = vtkMultiBlockDataSet()
        constraints.SetBlock(0, image)
        constraints.SetBlock(2, make_polygon_mesh())
        told = self.expect_same(blocks, lambda flip: flip.SetInputDataObject(1, constraints))
        for number, text in (3, "ignored, because the first input has nothing at this place"), (1, "not a vtkPolyData"):
            self.assertIn(f"block {number} of the second input: {text}", told["warnings"][0])
        told = self.expect_same(
            make_rhombus(), lambda flip: flip.SetConstraintsData(make_polygon_mesh()))
        self.assertIn("second input: triangle strips ignored", told["warnings"][0])

    def test_constraints_of_blocks_of_another_structure(self):
        """Blocks are found by their place in the tree, not by VTK's flat index."""
        blocks, inner, lines, none = (vtkMultiBlockDataSet() for _ in range(4))
        constraint = vtkPolyData()
        constraint.SetPoints(make_rhombus().GetPoints())
        constraint.SetLines(make_cells([(0, 2)]))
        blocks.SetBlock(0, make_rhombus())
        inner.SetBlock(1, make_rhombus())
        blocks.SetBlock(1, inner)
        blocks.SetBlock(2, make_rhombus())
        lines.SetBlock(1, none)
        lines.SetBlock(2, constraint)
        told = self.expect_same(blocks, lambda flip: flip.SetInputDataObject(1, lines))
        self.assertEqual(told["answers"]["GetTotalFlips"], 2)

    def test_aborts(self):
        def stop(flip, _event):
            flip.SetAbortExecute(flip.GetNumberOfIterations() == self.last)

        def prepare(flip):
            flip.GenerateQualityOn()
            flip.AddObserver("ProgressEvent", stop)

        for self.last in (0, 2):
            told = self.expect_same(make_polygon_mesh(), prepare)
            self.assertEqual(told["answers"]["GetStopReasonAsString"], "aborted")

    def test_pieces(self):
        told = self.expect_same(make_bad_mesh(), lambda flip: (
            flip.SetNumberOfPieces(3), flip.GenerateFlipCountOn()))
        self.assertGreater(told["answers"]["GetTotalFlips"], 100)


def make_cloud(count=300, kind=numpy.float64, seed=5):
    """Points on a coarse lattice, with ties and repeated places, and data."""
    generator = numpy.random.default_rng(seed)
    places = numpy.floor(generator.uniform(0, 30, (count, 3))) + [0, 0, 0.25]
    cloud = make_mesh(places, [(0, 1, 2)])
    cloud.GetPoints().SetData(numpy_to_vtk(places.astype(kind), deep=True))
    add_array(cloud.GetPointData(), "Number", numpy.arange(count))
    add_array(cloud.GetPointData(), "Own", numpy.arange(count))
    add_array(cloud.GetPointData(), "Ids", numpy.arange(count))
    cloud.GetPointData().SetActiveGlobalIds("Ids")
    cloud.GetPointData().SetActiveScalars("Ids")
    add_array(cloud.GetPointData(), None, numpy.arange(count))
    add_array(cloud.GetPointData(), "vtkGhostType", numpy.full(count, 2, numpy.uint8))
    return cloud


def make_globe(kind=numpy.float64):
    """Such points on a sphere of radius 2, around its center."""
    cloud = make_cloud(kind=kind)
    vtk_to_numpy(cloud.GetPoints().GetData())[:] -= 15
    put_on_sphere(cloud)
    return cloud


def put_on_sphere(mesh):
    places = vtk_to_numpy(mesh.GetPoints().GetData())
    places[:] *= 2 / numpy.linalg.norm(places, axis=1, keepdims=True)


def make_segments(cloud, kind):
    """Lines and two rings: at places of the cloud, and new ones of which two are the same."""
    known = vtk_to_numpy(cloud.GetPoints().GetData())[:8]
    new = [[3.3, 3, 5], [9.5, 21.1, 6], [9.5, 21.1, 6], [25.7, 12, 7], [math.nan, 1, 1]]
    ring = [[-1, -1, 0], [29, -1, 0], [29, 29, 0], [-1, 29, 0]]
    hole = [[11, 11, 1], [11, 13.5, 1], [13.5, 13.5, 1], [13.5, 11, 1]]
    places = numpy.concatenate([known, new, ring, hole]).astype(kind)
    segments = make_mesh(places, [(13, 14, 15, 16), (17, 18, 19, 20)])
    segments.GetPoints().SetData(numpy_to_vtk(places, deep=True))
    segments.SetLines(make_cells([(0, 1, 2), (8, 9), (10, 11), (3, 3, 4), (7,)]))
    add_array(segments.GetPointData(), "Number", numpy.arange(len(places)))
    add_array(segments.GetPointData(), "Names", [str(place) for place in range(len(places))])
    return segments


class SameInterpolator(Pair, unittest.TestCase):

    kinds = CxxInterpolator, PythonInterpolator
    test_names_of_numbers = None  # the output has none

    def make_source(self, kind=numpy.float64):
        source = make_cloud(200, kind=kind)
        places = vtk_to_numpy(source.GetPoints().GetData())
        for name, values in (("real", places[:, :2] / 7), ("single", places[:, 0].astype(numpy.float32)),
                             ("integer", numpy.arange(200)), ("text", ["a"] * 200), ("short", [1.0])):
            add_array(source.GetPointData(), name, values)
        source.GetPointData().SetActiveScalars("single")
        add_array(source.GetPointData(), "ids", numpy.arange(200))
        source.GetPointData().SetActiveGlobalIds("ids")
        return source

    def list_places(self):
        image, shifted, grid = vtkImageData(), vtkImageData(), vtkRectilinearGrid()
        for each, first in ((image, 0), (shifted, 3)):
            each.SetExtent(first, first + 12, 0, 9, 0, 1)
            each.SetSpacing(2.6, 3.4, 1)
            each.SetOrigin(-1.1, -1.7, 2)
        add_array(image.GetPointData(), "Elevation", numpy.arange(260))
        grid.SetDimensions(3, 2, 1)
        grid.SetXCoordinates(numpy_to_vtk(numpy.array([3.0, 15.5, 60]), deep=True))
        grid.SetYCoordinates(numpy_to_vtk(numpy.array([6.5, 20.0]), deep=True))
        singles = make_cloud(30, seed=4, kind=numpy.float32)
        return image, shifted, grid, singles, make_cloud(40, seed=5), vtkPolyData()

    def test_places_and_sources(self):
        for source in (self.make_source(), self.make_source(numpy.float32), vtkPolyData()):
            for places in self.list_places():
                for choice in range(2):
                    told = self.expect_same(places, lambda flip, source=source, choice=choice: (
                        flip.SetSourceData(source), flip.SetMethod(choice), flip.SetOutside(choice)))
                    self.expect_same(places, lambda flip, source=source, choice=choice: (
                        flip.SetSourceData(source), flip.SetProjection(2 * choice), flip.SetOutsideToError()))
                    self.assertEqual(told["errors"], [])
                    arrays = [part[0] for part in told["meshes"][0] if isinstance(part, tuple)]
                    self.assertIn("vtkValidPointMask", arrays)
            self.expect_same(places, lambda flip, source=source: (
                flip.SetSourceData(source), flip.SetElevationArray("real")))

    def test_segments(self):
        source = self.make_source()
        for heights in range(3):
            self.expect_same(self.list_places()[0], lambda flip, heights=heights: (
                flip.SetSourceData(source), flip.SplitCrossingsOn(), flip.SetSegmentHeights(heights),
                flip.SetSegmentsData(make_segments(source, float)), flip.SetElevationArray("")))
        lines = make_segments(source, float)
        vtk_to_numpy(lines.GetPoints().GetData())[::2, 2] = numpy.nan
        for heights in (0, 2):
            self.expect_same(self.list_places()[0], lambda flip, heights=heights: (
                flip.SetSourceData(source), flip.SetSegmentsData(lines), flip.SetSegmentHeights(heights),
                flip.SetProjectionToOpenSphere(), flip.DegreesOn()))

    def test_refinement_and_regions(self):
        source = self.make_source()
        for change in (lambda flip: flip.SetMaximumArea(2), lambda flip: flip.SetMinimumAngle(25),
                       lambda flip: flip.AddRegion(15, 15, 3, 0), lambda flip: flip.AddRegion(15, 15, 3, 2)):
            told = self.expect_same(self.list_places()[4], lambda flip, change=change: (
                flip.SetSourceData(source), change(flip)))
            values = next(part[3] for part in told["meshes"][0] if part[0] == "vtkValidPointMask")
            self.assertEqual(values, ["\x01"] * 40)

    def test_sphere(self):
        source = self.make_source()
        for degrees, given in ((True, source), (False, make_globe())):
            for places in self.list_places():
                for choice in range(2):
                    told = self.expect_same(places, lambda flip, given=given, degrees=degrees, choice=choice: (
                        flip.SetSourceData(given), flip.SetMethod(choice), flip.SetOutside(choice),
                        flip.SetProjection(2 + choice), flip.SetDegrees(degrees)))
                    self.assertEqual(told["errors"], [])
                    arrays = [part[0] for part in told["meshes"][0] if isinstance(part, tuple)]
                    self.assertEqual(
                        "Elevation" in arrays, degrees or bool(places.GetPointData().HasArray("Elevation")))

    def test_sphere_with_segments(self):
        for kind in (numpy.float32, numpy.float64):
            source = self.make_source(kind)
            lines = make_segments(source, kind)
            vtk_to_numpy(lines.GetPoints().GetData())[12, 1] = -95
            for places, choice in itertools.product(self.list_places(), range(2)):
                told = self.expect_same(places, lambda flip, choice=choice: (
                    flip.SetSourceData(source), flip.SetSegmentsData(lines), flip.SetFirstHole(6),
                    flip.SetMethod(choice), flip.SetOutside(choice), flip.SetProjectionToOpenSphere(),
                    flip.DegreesOn()))
                self.assertEqual(told["errors"], [])
                self.assertIn("segments: 1 point with a latitude beyond 90 degrees", told["warnings"][0])

    def test_replaced_arrays(self):
        source, places = self.make_source(), make_cloud(30, seed=4)
        for name in ("real", "Elevation"):
            add_array(source.GetPointData(), name, numpy.arange(source.GetNumberOfPoints()))
            add_array(places.GetPointData(), name, numpy.arange(30))
            places.GetPointData().SetActiveGlobalIds(name)
            self.expect_same(places, lambda flip: flip.SetSourceData(source))
            for kind in self.kinds:
                flip = kind()
                flip.SetInputData(places)
                flip.SetSourceData(source)
                flip.Update()
                self.assertIsNone(flip.GetOutput().GetPointData().GetGlobalIds())

    def test_partitions(self):
        source, lines = self.make_source(), make_segments(self.make_source(), float)
        places = [make_cloud(30, seed=4), vtkPolyData(), make_cloud(20, seed=5)]
        for sources in (source, join([vtkPolyData(), source]), join([source, source])):
            for segments in (lines, join([lines]), join([lines, lines])):
                for data in (join(places), collect([places[:1], places])):
                    self.expect_same(data, lambda flip, sources=sources, segments=segments: (
                        flip.SetInputDataObject(1, sources), flip.SetInputDataObject(2, segments)))
        told = self.expect_same(collect([places, places]), lambda flip: flip.SetInputDataObject(
            1, collect([[source, source], [source]])))
        self.assertIn("block 2: the source is in several partitions; join them first", told["errors"][0])
        self.assertIn("vtkValidPointMask", str(told["meshes"][-1]))

    def test_failures(self):
        source, image = self.make_source(), self.list_places()[0]
        self.expect_same(image)
        self.expect_same(image, lambda flip: flip.SetSourceData(image))
        told = self.expect_same(image, lambda flip: (
            flip.SetSourceData(source), flip.SetMethodToNatural(), flip.SetMaximumIterations(0)))
        self.assertIn("natural neighbors", told["errors"][0])
        told = self.expect_same(image, lambda flip: (flip.SetSourceData(source), flip.SetOutsideToError()))
        self.assertRegex(told["errors"][0], r"\d+ of \d+ places are outside of the triangulation \(first: 0\)$")
        nowhere = make_cloud(30, seed=4)
        vtk_to_numpy(nowhere.GetPoints().GetData())[7, 1] = numpy.nan
        told = self.expect_same(nowhere, lambda flip: (flip.SetSourceData(source), flip.SetOutsideToError()))
        self.assertRegex(told["errors"][0], r"1 of 30 places is NaN or infinite \(first: 7\)$")
        blocks = vtkMultiBlockDataSet()
        for i, data in enumerate((image, vtkTable(), make_cloud(20), image)):
            blocks.SetBlock(i, data)
        self.expect_same(image, lambda flip: flip.SetSourceData(blocks))
        self.expect_same(blocks, lambda flip: flip.SetSourceData(source))
        told = self.expect_same(blocks, lambda flip: flip.SetSourceData(blocks))
        self.assertIn("no points (vtkPointSet) at the same place", told["errors"][0])
        for count in (0, 2):
            self.expect_same(image, lambda flip, count=count: flip.SetSourceData(make_cloud(count)))

    def test_aborted(self):
        for kind in self.kinds:
            filter_ = kind()
            filter_.SetInputData(self.list_places()[4])
            filter_.SetSourceData(self.make_source())
            filter_.AddObserver("ProgressEvent", lambda *_, filter_=filter_: filter_.AbortExecuteOn())
            filter_.Update()
            self.assertEqual(filter_.GetStopReasonAsString(), "aborted")
            self.assertFalse(filter_.GetOutput().GetPointData().HasArray("Elevation"))
            self.assertEqual(filter_.GetOutput().GetNumberOfPoints(), 40)


class SamePoints(Pair, unittest.TestCase):

    kinds = CxxPoints, PythonPoints

    def test_points(self):
        for kind in (numpy.float32, numpy.float64):
            told = self.expect_same(make_cloud(kind=kind))
            self.assertIn("duplicate points skipped", told["warnings"][0])
        self.expect_same(make_cloud(), lambda points: points.SetMaximumIterations(1))
        for count in (0, 1, 2, 3):
            self.expect_same(make_cloud(count, seed=2))

    def test_points_that_move(self):
        """Each frame is that of a new filter, and the triangulation is kept as long as that is possible."""
        draw = numpy.random.default_rng(3)
        for kind in (numpy.float32, numpy.float64):
            cloud = make_mesh(draw.random((900, 3)).astype(kind), [])
            places = vtk_to_numpy(cloud.GetPoints().GetData())
            told = [Watched(cloud, kind) for kind in self.kinds]
            for each in told:
                each.filter.SetKeepSessionToOn()
            for step, is_followed in ((0, False), (1e-4, True), (1e-3, True), (1, False), (1e-4, True),
                                      (math.nan, False), (1e-4, True)):
                places[:] += step * draw.normal(size=places.shape) if step == step else 0
                places[17, 0] = math.nan if step != step else places[17, 0]
                cloud.GetPoints().Modified()
                cxx, python = (read_mesh(each.run()) for each in told)
                self.assertEqual(cxx, python)
                fresh = run(PythonPoints, cloud, lambda points: points.SetKeepSessionToOn())["meshes"][0]
                self.assertEqual(cxx[3], fresh[3])
                rounds = dict((field[0], field[3]) for field in python[5:] if isinstance(field, tuple))
                self.assertEqual(rounds["DelaunayFlip:MoveRounds"][0] != "0", is_followed, step)
            for each in told:
                each.filter.SetAlpha(0.1)
            self.assertEqual(*(read_mesh(each.run()) for each in told))

    def test_segments_that_move(self):
        """Lines, an outline and a hole move with the points, and the triangulation is kept."""
        draw = numpy.random.default_rng(3)
        cloud = make_mesh(draw.random((900, 3)), [])
        places = vtk_to_numpy(cloud.GetPoints().GetData())
        corners = numpy.array([[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]])
        lines = make_mesh(numpy.c_[numpy.concatenate([
            corners, 0.4 + 0.2 * corners, [[0.2, 0.2], [0.8, 0.25], [0.2, 0.7], [0.8, 0.75]]]), numpy.zeros(12)],
            [(0, 1, 2, 3), (4, 5, 6, 7)])
        lines.SetLines(make_cells([(8, 9), (10, 11)]))
        ends = vtk_to_numpy(lines.GetPoints().GetData())

        def prepare(points):
            points.SetKeepSessionToOn()
            points.SetSegmentsData(lines)
            points.SetFirstHole(3)
            points.PassSegmentsOn()

        told = [Watched(cloud, kind) for kind in self.kinds]
        for each in told:
            prepare(each.filter)

        def expect(is_followed):
            cloud.GetPoints().Modified()
            lines.GetPoints().Modified()
            lines.Modified()
            cxx, python = (read_mesh(each.run()) for each in told)
            self.assertEqual(cxx, python)
            fresh = run(PythonPoints, cloud, prepare)["meshes"][0]
            self.assertEqual(cxx[1:4], fresh[1:4])
            rounds = dict((field[0], field[3]) for field in python[5:] if isinstance(field, tuple))
            self.assertEqual(rounds["DelaunayFlip:MoveRounds"][0] != "0", is_followed)

        expect(False)
        for step, is_followed in ((1e-5, True), (1e-5, True), (0.05, False), (1e-5, True)):
            places[:] += step * draw.normal(size=places.shape)
            ends[:] += step
            expect(is_followed)
        for each in told:
            each.filter.SetFirstHole(-1)  # the second ring is one of the outline
        with unittest.mock.patch.object(PythonPoints, "SetFirstHole", lambda *_: None):
            expect(False)
            places[:] += 1e-6
            expect(True)
        ends[9], before = (0.8, 0.8, 0), ends[9].copy()  # crosses the other line, which is refused
        with unittest.mock.patch.object(PythonPoints, "SetFirstHole", lambda *_: None):
            expect(False)
            ends[9] = before
            expect(False)
            expect(True)
        self.assertEqual(get_text(told[0].warnings), get_text(told[1].warnings))
        ends[9] = (0.8, 0.95, 0)  # crosses the outline
        lines.GetPoints().Modified()
        for each in told:
            each.run()
        self.assertEqual(*(get_text(each.errors) for each in told))
        self.assertEqual(len(told[0].errors), 1)

    def test_segments(self):
        for own in (numpy.float32, numpy.float64):
            for other in (numpy.float32, numpy.float64):
                for splits in (False, True):
                    cloud = make_cloud(kind=own)
                    segments = make_segments(cloud, other)

                    def prepare(points, segments=segments, splits=splits):
                        points.SetSegmentsData(segments)
                        points.SetSplitCrossings(splits)
                        points.SetRingRule(2 * int(splits))
                        points.SetFirstHole(6)
                        points.SetLongestEdge(9.0)

                    told = self.expect_same(cloud, prepare)
                    self.assertEqual(told["errors"], [])

    def test_sphere(self):
        """Longitudes and latitudes, and directions, with and without segments."""
        for kind, degrees in itertools.product((numpy.float32, numpy.float64), (True, False)):
            cloud = make_cloud(kind=kind) if degrees else make_globe(kind)
            if degrees:
                vtk_to_numpy(cloud.GetPoints().GetData())[5, 1] = 91.5
            segments = make_segments(cloud, kind)
            if not degrees:
                put_on_sphere(segments)
                segments.SetLines(make_cells([(7,), (7, 7)]))  # others cross the rings
            for lines in (None, segments):
                for projection in (2, 3):
                    def prepare(points, lines=lines, projection=projection, degrees=degrees):
                        points.SetProjection(projection)
                        points.SetDegrees(degrees)
                        points.SetPassSegments(True)
                        points.SetFirstHole(6)
                        if lines is not None:
                            points.SetSegmentsData(lines)

                    told = self.expect_same(cloud, prepare)
                    if degrees and lines is not None and projection == 2:
                        self.assertIn("points all around its center", told["errors"][0])
                        continue
                    self.assertEqual(told["errors"], [])
                    self.assertEqual("1 point with a latitude beyond 90 degrees" in str(told["warnings"]), degrees)
            self.expect_same(collect([[cloud, vtkPolyData()]]), prepare)
            for step, z in ((1, 0), (2, 7), (2, numpy.nan)) if degrees else ():
                vtk_to_numpy(segments.GetPoints().GetData())[::step, 2] = z
                for heights in (0, 2):
                    told = self.expect_same(cloud, lambda points, heights=heights: (
                        prepare(points), points.SetSegmentHeights(heights)))
                    self.assertIn("Height", str(told["meshes"]))
            if degrees:
                vtk_to_numpy(segments.GetPoints().GetData())[:, 2] = 7
                named = vtkPolyData()
                named.ShallowCopy(segments)
                add_array(named.GetPointData(), "Height", numpy.arange(named.GetNumberOfPoints()))
                for heights in (0, 2):
                    told = self.expect_same(cloud, lambda points, heights=heights: (
                        prepare(points), points.SetSegmentsData(named), points.SetSegmentHeights(heights)))
                    self.assertIn('segments: z left out, because they have an array "Height"', str(told["warnings"]))
                add_array(cloud.GetPointData(), "Height", numpy.arange(cloud.GetNumberOfPoints()))
                told = self.expect_same(cloud, prepare)
                self.assertIn('z left out, because the points have an array "Height"', told["warnings"][0])

    def test_degrees_without_a_sphere(self):
        cloud = make_cloud()
        plain = self.expect_same(cloud, lambda _: None)
        told = self.expect_same(cloud, lambda points: points.DegreesOn())
        self.assertEqual(told["meshes"], plain["meshes"])
        self.assertIn("Degrees has no effect", str(told["warnings"]))
        self.assertNotIn("Degrees", str(plain["warnings"]))

    def test_what_a_sphere_cannot_have(self):
        for name, value in (("Alpha", 1), ("MinimumAngle", 20), ("SizeArray", "Own"), ("MaximumIterations", 3),
                            ("SegmentHeights", 1), ("PointTolerance", 0.1)):
            told = self.expect_same(make_globe(), lambda points, name=name, value=value: (
                points.SetProjectionToSphere(), getattr(points, "Set" + name)(value)))
            self.assertNotEqual(told["errors"], [], name)
        fitted = Watched(make_globe(), PythonPoints)
        fitted.filter.SetProjectionToBestFittingPlane()
        fitted.run()
        self.assertIn("best-fitting plane needs the filter in C++", fitted.errors[0])

    def test_refinement(self):
        for kind in (numpy.float32, numpy.float64):
            cloud = make_cloud(kind=kind)
            count = cloud.GetNumberOfPoints()
            places = vtk_to_numpy(cloud.GetPoints().GetData())
            for name, values in (("real", places[:, :2] / 7), ("integer", numpy.arange(count)),
                                 ("size", numpy.full(count, 3.0)), ("text", list("abcde" * count)[:count]),
                                 ("ids", numpy.arange(count))):
                add_array(cloud.GetPointData(), name, values)
            cloud.GetPointData().SetActiveGlobalIds("ids")

            def prepare(points, lines=make_segments(cloud, kind)):
                points.SetSegmentsData(lines)
                points.SetSplitCrossings(True)
                points.SetMinimumAngle(22.0)
                points.SetMaximumArea(8.0)
                points.SetPointLimit(5000)
                points.SetPassSegments(True)
                points.AddRegion(9, 9, 7, 2.0)
                points.AddRegion(1, 1, -3, 0.0)

            told = self.expect_same(cloud, prepare)
            self.assertEqual(told["errors"], [])
            self.assertIn("Region", str(told["meshes"]))
            self.assertIn("SegmentIds", str(told["meshes"]))
            self.assertIn("RefinementPoints", str(told["meshes"]))
            self.expect_same(cloud, lambda points: (prepare(points), points.RemoveAllRegions(),
                                                    points.KeepBoundaryOn(), points.SetMaximumEdge(4.0)))
            cloud.SetVerts(make_cells([(0,), (1,)])), cloud.SetLines(make_cells([(5, 9), (2, 3, 2)]))
            self.expect_same(cloud, lambda points: (prepare(points), points.LinesAsSegmentsOn()))
            told = self.expect_same(cloud, lambda points: points.AddRegion(1, 1, 1.5, 0.0))
            self.assertIn("the label of region 0 must be an integer", told["errors"][0])
            told = self.expect_same(cloud, lambda points: (prepare(points), points.SetSizeArray("size")))
            self.assertEqual(told["errors"], [])
            for name in ("sizes", "text", "real"):
                told = self.expect_same(cloud, lambda points: points.SetSizeArray(name))
                self.assertIn(f'SizeArray: ', told["errors"][0])
                self.assertIn(f'"{name}"', told["errors"][0])

    def test_arrays_of_one_name(self):
        """Those of the segments have other types, too few tuples or more components."""
        lines = make_segments(make_cloud(), float)
        count = lines.GetNumberOfPoints()
        others = [numpy.full(count, 3, kind) for kind in (numpy.float64, numpy.float32, numpy.int32, numpy.uint8)]
        others += [["3"] * count, numpy.full((count, 2), 3.0), [3.0], numpy.full(1, 3)]
        kinds = (numpy.float64, numpy.float32, numpy.int32)
        for own in (*(numpy.full(300, 4, kind) for kind in kinds), ["4"] * 300):
            cloud = make_cloud()
            add_array(cloud.GetPointData(), "v", own)
            for values in others:
                segments = vtkPolyData()
                segments.ShallowCopy(lines)
                add_array(segments.GetPointData(), "v", values)
                for size in ("", "v"):
                    told = self.expect_same(cloud, lambda points, segments=segments, size=size: (
                        points.SetSegmentsData(segments), points.SetSizeArray(size)))
                    self.assertEqual(len(told["errors"]), int(isinstance(own, list) and size == "v"))

    def test_closed_lines_and_rings_without_area(self):
        cloud = make_cloud()
        segments = make_segments(cloud, float)
        segments.SetLines(make_cells(
            [(13, 14, 15, 16, 13), (9, 10), (0, 3, 0), (3, 3), (17, 18, 19, 20, 20, 17), (5,)]))
        segments.SetPolys(make_cells([(0, 1), (2,), (3, 4, 4), (8, 9, 10), (17, 18, 19, 17)]))
        for closed in (True, False):
            for rule in range(3):
                told = self.expect_same(cloud, lambda points, closed=closed, rule=rule: (
                    points.SetSegmentsData(segments), points.SetClosedLinesAsRings(closed),
                    points.SetRingRule(rule), points.SetSplitCrossings(True)))
                self.assertIn("rings without an area, left out (first: ", told["warnings"][0])
        same = make_mesh([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 0, 0)], [])
        lines = make_mesh([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 0, 0)], [])
        lines.SetLines(make_cells([(0, 1, 2, 3)]))  # closed by another point at the same place
        told = self.expect_same(same, lambda points: (
            points.SetSegmentsData(lines), points.SetFirstHole(0)))
        self.assertEqual(len(told["meshes"][0][3][0]), 0)

    def test_points_that_are_not_finite(self):
        for kind in (numpy.float32, numpy.float64):
            cloud, segments = make_cloud(9, kind), make_segments(make_cloud(9), kind)
            for data in (cloud, segments):
                vtk_to_numpy(data.GetPoints().GetData())[:, 2] = math.nan
            self.expect_same(cloud, lambda points, lines=segments: points.SetSegmentsData(lines))
        vtk_to_numpy(segments.GetPoints().GetData())[8] = 1e300  # beyond float32
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.expect_same(make_cloud(9, numpy.float32), lambda points: points.SetSegmentsData(segments))
        for kind in (numpy.float32, numpy.float64):
            cross = make_mesh([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)], [])
            cross.GetPoints().SetData(numpy_to_vtk(numpy.array(
                [(0, 0, 0), (4, 0, 0), (4, 4, math.inf), (0, 4, 0)], kind), deep=True))
            cross.SetLines(make_cells([(0, 2), (1, 3)]))
            self.expect_same(
                cross, lambda points: (points.LinesAsSegmentsOn(), points.SplitCrossingsOn()))

    def test_arrays_of_the_second_input_that_are_too_short(self):
        cloud, segments = make_cloud(), make_segments(make_cloud(), float)
        add_array(segments.GetPointData(), "Short", numpy.arange(3))
        told = self.expect_same(cloud, lambda points: points.SetSegmentsData(segments))
        self.assertIn('1 point array of the second input with too few tuples left out: "Short"',
                      told["warnings"][0])
        same = make_cloud()  # None of its points is added.
        add_array(same.GetPointData(), "Short", numpy.arange(3))
        told = self.expect_same(cloud, lambda points: points.SetSegmentsData(same))
        self.assertNotIn("too few tuples", told["warnings"][0])

    def test_points_of_the_second_input_alone(self):
        segments = make_segments(make_cloud(9), numpy.float32)
        told = self.expect_same(vtkPolyData(), lambda points: points.SetSegmentsData(segments))
        self.assertIn("PointsNotFinite", str(told["meshes"]))

    def test_empty_blocks_stay_empty(self):
        lattice = make_mesh([(i % 4, i // 4, 0.0) for i in range(16)], [])
        square = make_mesh([(.5, .5, 0), (2.5, .5, 0), (2.5, 2.5, 0), (.5, 2.5, 0)], [(0, 1, 2, 3)])
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, vtkPolyData())
        blocks.SetBlock(1, lattice)
        for source, empty in ((join([lattice, vtkPolyData()]), 1), (blocks, 0)):
            told = self.expect_same(source, lambda points: points.SetSegmentsData(square))
            self.assertEqual([len(mesh[3][0]) > 0 for mesh in told["meshes"]],
                             [number != empty for number in range(2)])

    def test_segments_without_heights(self):
        def make(heights):
            """A line, an outline that shares a place with the cloud, and a hole at these heights."""
            places = [(3.5, 3.5), (9.5, 9.5), (0.5, 0.5), (20.5, 0.5), (20.5, 20.5), (12.5, 12.5),
                      (15.5, 12.5), (15.5, 15.5), (1, 1)]
            cells = [(2, 3, 4), (5, 6, 7)]
            mesh = make_mesh([(*place, heights[(0, 0, 1, 1, 1, 2, 2, 2, 0)[i]])
                              for i, place in enumerate(places)], cells)
            mesh.SetLines(make_cells([(0, 1, 8)]))
            return mesh

        def prepare(points):
            points.SetSegmentsData(segments)
            points.SetFirstHole(2)

        cloud = make_mesh([(x, y, 5.25 + x) for x in range(30) for y in range(30)], [])
        for kind in (numpy.float32, numpy.float64):
            cloud.GetPoints().SetData(numpy_to_vtk(
                vtk_to_numpy(cloud.GetPoints().GetData()).astype(kind), deep=True))
            for z in (0, numpy.nan):
                segments = make((8, 9, z))
                segments.GetPoints().SetPoint(0, 3.5, 3.5, numpy.nan)
                for heights in range(3):
                    told = self.expect_same(cloud, lambda points, heights=heights: (
                        prepare(points), points.SetSegmentHeights(heights)))
                    counts = re.findall(r"(\d+) points? of segments without", str(told["warnings"]))
                    self.assertEqual(counts, (["4"], [], ["1" if z == 0 else "4"])[heights])
            for heights, count in (((9, 9, 9), 0), ((0, 9, 9), 2), ((9, 0, 9), 3), ((0, 9, 0), 5)):
                segments = make(heights)
                told = self.expect_same(cloud, prepare)
                text = f"{count} points of segments without heights (z = 0 throughout; the given points " \
                    "have z = 5.25 to 34.25)"
                self.assertEqual(text in " ".join(told["warnings"]), count > 0)
                self.assertEqual("SegmentHeights Own keeps z = 0" in " ".join(told["warnings"]), count > 0)
        places = vtk_to_numpy(cloud.GetPoints().GetData())
        for name, values in (("real", places[:, :2] / 7), ("integer", 50 - 100 * places[:, 0].astype(int)),
                             ("both", numpy.arange(len(places))), ("ids", numpy.arange(len(places)))):
            add_array(cloud.GetPointData(), name, values)
        cloud.GetPointData().SetActiveGlobalIds("ids")
        add_array(segments.GetPointData(), "both", numpy.arange(9))
        for heights in range(3):
            self.expect_same(cloud, lambda points, heights=heights: (
                prepare(points), points.SetSegmentHeights(heights), points.SplitCrossingsOn()))
        lattice = make_mesh([(x, 0, 1) for x in range(3)], [])
        told = self.expect_same(lattice, prepare)
        self.assertIn("the mesh goes to z = 0 there", told["warnings"][0])
        places[:, 2] = 0
        self.assertEqual(self.expect_same(cloud, prepare)["warnings"], [])

    def test_an_outline_elsewhere(self):
        ring = make_mesh([(50, 0, 0), (60, 0, 0), (60, 9, 0)], [(0, 1, 2)])
        cloud = make_mesh([(x, y, 0) for x in range(9) for y in range(9)], [])
        told = self.expect_same(cloud, lambda points: points.SetSegmentsData(ring))
        self.assertIn("81 points without a triangle", told["warnings"][0])
        self.assertIn("x 0 to 8, y 0 to 8, the segments in x 50 to 60, y 0 to 9", told["warnings"][0])
        told = self.expect_same(cloud, lambda points: points.SetLongestEdge(0.5))
        self.assertIn("all triangles were removed", told["warnings"][0])

    def test_lines_of_the_input(self):
        cloud = make_cloud(40)
        cloud.SetLines(make_cells([(0, 9, 3), (5, 6), (7, 8)]))
        self.expect_same(cloud, lambda points: points.LinesAsSegmentsOn())
        cloud.SetLines(make_cells([(0, 77)]))
        told = self.expect_same(cloud, lambda points: points.LinesAsSegmentsOn())
        self.assertEqual(len(told["errors"]), 1)

    def test_other_trouble(self):
        cloud = make_cloud(30)
        add_array(cloud.GetPointData(), "Short", [])
        self.expect_same(cloud)
        segments = make_segments(cloud, float)
        self.expect_same(cloud, lambda points: points.SetSegmentsData(segments))
        segments.SetPolys(make_cells([(13, 15, 14, 16)]))
        told = self.expect_same(make_cloud(30), lambda points: points.SetSegmentsData(segments))
        self.assertIn("ring 5", told["errors"][0])
        self.expect_same(make_cloud(30), lambda points: points.SetBackendToCUDA())
        blocks, image = vtkMultiBlockDataSet(), vtkImageData()
        image.SetDimensions(2, 2, 2)
        for i, data in enumerate((make_cloud(30), image, None, make_cloud(50))):
            blocks.SetBlock(i, data)
        told = self.expect_same(blocks)
        self.assertIn("has no points of its own", told["warnings"][0])
        vtk_to_numpy(blocks.GetBlock(0).GetPoints().GetData())[:] *= 100
        self.expect_same(blocks, lambda points: points.SetLongestEdge(30))  # none of block 0 are left
        blocks.SetBlock(1, vtkTable())
        told = self.expect_same(blocks)
        self.assertIn("has no points of its own", told["warnings"][0])
        told = self.expect_same(make_cloud(30), lambda points: points.SetInputDataObject(1, blocks))
        self.assertIn("cannot be a composite dataset", told["errors"][0])

    def test_partitions_are_an_error_of_their_block(self):
        several, lines = [make_cloud(9), make_cloud(8)], make_segments(make_cloud(9), float)
        for partitions in ([several[0]], several, [None, vtkPolyData(), several[1], lines]):
            told = self.expect_same(join(partitions))
            self.assertEqual("points are in several partitions; join them first" in str(told["errors"]),
                             sum(part is not None and part.GetNumberOfPoints() > 0 for part in partitions) > 1)
        blocks = collect([[make_cloud(20)], several, [make_cloud(30)]])
        told = self.expect_same(blocks)
        self.assertIn("block 4: the points are in several partitions; join them first", told["errors"][0])
        self.assertEqual([len(mesh[3][0]) > 0 for mesh in told["meshes"]], [True, False, False, True])
        for segments in (join([lines, lines]), collect([[lines], [], [lines, lines]]), collect([[], [lines]])):
            told = self.expect_same(
                blocks, lambda points, segments=segments: points.SetInputDataObject(1, segments))
            self.assertIn("block 4: the points are in several partitions; join them first", told["errors"][0])
        told = self.expect_same(
            join([make_cloud(9)]), lambda points: points.SetInputDataObject(1, join([lines, lines])))
        self.assertIn("segments are in several partitions; join them first", told["errors"][0])


class OnlyInCxx(unittest.TestCase):
    """What the filter in Python leaves out, it says."""

    def test_partitions(self):
        parts = cut_triangles(make_bad_mesh(), 3)
        told = Watched(join([parts[0], None, *parts[1:]]), PythonFilter)
        told.filter.Update()
        self.assertEqual(get_text(told.warnings), [
            "partitions were flipped one by one; edges between them stayed as they were"])
        output, flips = told.filter.GetOutputDataObject(0), 0
        for place, part in zip((0, 2, 3), parts):
            alone = Watched(part, PythonFilter)
            self.assertEqual(read_mesh(output.GetPartition(place)), read_mesh(alone.run()))
            flips += alone.filter.GetTotalFlips()
        self.assertEqual(told.filter.GetTotalFlips(), flips)
        only = Watched(join([None, parts[0], vtkPolyData()]), PythonFilter)
        only.filter.Update()
        self.assertEqual(only.warnings, [])

    def test_live_updates(self):
        told = Watched(make_bad_mesh(), PythonFilter)
        told.filter.LiveUpdateOn()
        told.filter.Update()
        self.assertTrue(told.filter.GetConverged())
        self.assertFalse(told.filter.Advance() or told.filter.Step() or told.filter.GetNeedsUpdate())
        self.assertIn("LiveUpdate needs the filter in C++", told.warnings[0])

    def test_interrupts(self):
        """They end an update; that of the filter itself raises its own."""
        flip, follower = Watched(make_bad_mesh(), PythonFilter).filter, vtkAppendPolyData()
        follower.SetInputConnection(flip.GetOutputPort())
        with unittest.mock.patch.object(_vtk_filter, "MeshInput", side_effect=SystemExit):
            follower.Update()
            self.assertEqual(flip.GetStopReasonAsString(), "aborted")
            flip.Update()
            flip.Modified()
            self.assertRaises(SystemExit, flip.Update)

    def test_observers_that_change_the_input(self):
        """Its arrays are copied."""
        outputs = []
        for changes in (False, True):
            mesh = make_bad_mesh()

            def change(flip, _event, mesh=mesh):
                if 0.3 < flip.GetProgress() < 1:
                    vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())[:] = 10**9

            told = Watched(mesh, PythonFilter)
            told.filter.GenerateQualityOn()
            if changes:
                told.filter.AddObserver("ProgressEvent", change)
            outputs.append(read_mesh(told.run()))
            self.assertEqual(told.errors, [])
        self.assertEqual(*outputs)


class TwoEngines(unittest.TestCase):
    """libvtkDelaunayFlipFilters and libdelaunayflip each have an engine of their own."""

    def test_one_thread_pool(self):
        """Built together, they share the oneTBB of the system."""
        for kind in (CxxFilter, PythonFilter):
            run(kind, make_rhombus())
        with open("/proc/self/maps", encoding="ascii") as maps:
            loaded = {line.split("/")[-1].strip() for line in maps if "/" in line}
        engines = {name.split(".")[0] for name in loaded
                   if name.startswith(("libdelaunayflip.so", "libvtkDelaunayFlipFilters.so"))}
        self.assertEqual(len(engines), 2, loaded)
        self.assertEqual(len([name for name in loaded if re.match(r"libtbb[-.]", name)]), 1)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Inputs that are surfaces but not vtkPolyData, inputs that are not surfaces, and errors, which are
explained to the user and after which the session continues."""

from paraview import simple
from vtkmodules.vtkCommonCore import (
    vtkBitArray, vtkIdTypeArray, vtkStringArray, vtkTypeInt64Array,
    vtkUnsignedCharArray, vtkVariantArray)
from vtkmodules.vtkCommonDataModel import (
    VTK_EMPTY_CELL, VTK_LINE, VTK_PIXEL, VTK_QUAD, VTK_TETRA, VTK_TRIANGLE, VTK_TRIANGLE_STRIP,
    VTK_VERTEX, vtkCellArray, vtkMultiBlockDataSet, vtkUnstructuredGrid)
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from PluginTesting import (
    PluginTest, fetch, get_triangles, main, make_cells, make_fan, refresh)

# Cells on the points of make_fan(9) that do not overlap.
MIXED = [(VTK_TRIANGLE, (0, 1, 2)), (VTK_PIXEL, (2, 3, 8, 4)), (VTK_LINE, (0, 8)),
         (VTK_VERTEX, (5,)), (VTK_TRIANGLE_STRIP, (4, 5, 8, 6)), (VTK_QUAD, (0, 2, 8, 7))]


def number_cells(data):
    """Gives every cell a number by which it can be recognised."""
    numbers = vtkIdTypeArray()
    numbers.SetName("Number")
    for i in range(data.GetNumberOfCells()):
        numbers.InsertNextValue(i)
    data.GetCellData().AddArray(numbers)


def make_grid(points, cells):
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    for kind, ids in cells:
        grid.InsertNextCell(kind, len(ids), ids)
    number_cells(grid)
    return grid


def make_volume():
    return make_grid(make_fan(5).GetPoints(), [(VTK_TETRA, (0, 1, 2, 3))])


def get_points(data):
    return [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]


def get_numbers(mesh):
    numbers = mesh.GetCellData().GetArray("Number")
    return [int(numbers.GetTuple1(i)) for i in range(mesh.GetNumberOfCells())]


class InputTest(PluginTest):
    def read_grid(self, grid, name="grid.vtu"):
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetDataModeToBinary()
        writer.SetFileName(self.path(name))
        writer.SetInputData(grid)
        self.assertEqual(writer.Write(), 1)
        return simple.XMLUnstructuredGridReader(FileName=[self.path(name)])

    def expect_same_points(self, before, after):
        self.assertEqual(after.GetClassName(), "vtkPolyData")
        self.assertEqual(get_points(after), get_points(before))


class UnstructuredGrids(InputTest):
    live = 0

    def test_triangles(self):
        """Their types may be one constant."""
        mesh = make_fan(20)
        number_cells(mesh)
        from_mesh = fetch(self.flip(self.read(mesh)))
        constant = vtkUnstructuredGrid()
        constant.SetPoints(mesh.GetPoints())
        constant.SetCells(VTK_TRIANGLE, mesh.GetPolys())
        number_cells(constant)
        producer = simple.TrivialProducer()
        producer.GetClientSideObject().SetOutput(constant)
        blanked = make_grid(mesh.GetPoints(), [(VTK_TRIANGLE, t) for t in get_triangles(mesh)] +
                            [(VTK_EMPTY_CELL, ())])
        for source in (producer, self.read_grid(blanked)):
            flip = self.flip(source, LiveUpdate=self.live)
            for step in range(1, 4 * self.live):
                self.assertEqual(flip.NumberOfIterations, step)
                flip.SMProxy.InvokeCommand("Advance")
                refresh(flip)
            while flip.StopReason == "running":
                flip.SMProxy.InvokeCommand("Advance")
                refresh(flip)
            self.expect_same_points(mesh, fetch(flip))
            self.assertEqual(get_triangles(fetch(flip)), get_triangles(from_mesh))
            self.assertEqual(get_numbers(fetch(flip)), get_numbers(from_mesh))

    def test_mixed_cells(self):
        """The output has vertices, lines, polygons and strips, in this order, with their data."""
        grid = make_grid(make_fan(9).GetPoints(), MIXED)
        mesh = fetch(self.flip_with_messages(self.read_grid(grid), Triangulate=0)[0])
        self.expect_same_points(grid, mesh)
        self.assertEqual([mesh.GetNumberOfVerts(), mesh.GetNumberOfLines()], [1, 1])
        self.assertEqual(get_triangles(mesh), [(0, 1, 2), (2, 3, 4, 8), (0, 2, 8, 7)])
        self.assertEqual(mesh.GetNumberOfStrips(), 1)
        self.assertEqual(get_numbers(mesh), [3, 2, 0, 1, 5, 4])

    def test_volume(self):
        for volume in (self.read_grid(make_volume()), simple.Wavelet(WholeExtent=[0, 3] * 3)):
            flip, text = self.flip_with_messages(volume)
            self.assertIn("Extract Surface", text)
            self.assertEqual(fetch(flip).GetNumberOfCells(), 0)


class Live(UnstructuredGrids):
    """Steps continue from the last one, although the surface is extracted."""

    live = 1


class Grids(InputTest):
    """Two-dimensional structured data."""

    def make_image(self):
        return simple.Wavelet(WholeExtent=[0, 7, 0, 5, 0, 0])

    def expect_grid(self, source, before, geometry, **properties):
        flip = self.flip(source, **properties)
        after = fetch(flip)
        self.expect_same_points(before, after)
        self.assertEqual(len(get_triangles(after)), 2 * 7 * 5)
        self.assertEqual(flip.GeometryUsed, geometry)
        self.assertEqual(after.GetPointData().GetNumberOfArrays(),
                         before.GetPointData().GetNumberOfArrays())
        return flip

    def test_image(self):
        image = self.make_image()
        flip = self.expect_grid(image, fetch(image), "planar")
        self.assertEqual(flip.TotalFlips, 0)
        for a, b, c in get_triangles(fetch(flip)):  # each is half a pixel
            self.assertEqual(max(a, b, c) - min(a, b, c), 9)

    def test_height_field(self):
        heights = simple.WarpByScalar(
            Input=self.make_image(), Scalars=["POINTS", "RTData"], ScaleFactor=0.3)
        before = fetch(heights)
        self.assertEqual(before.GetClassName(), "vtkStructuredGrid")
        flip = self.expect_grid(heights, before, "planar-xy")
        self.assertEqual(flip.TotalFlips, 0)  # all ties
        heights.ScaleFactor = 0.003
        flip = self.expect_grid(heights, fetch(heights), "surface", Geometry="Surface")
        self.assertGreater(flip.TotalFlips, 0)


class Blocks(InputTest):
    def get_leaves(self, output):
        iterator = output.NewIterator()
        iterator.InitTraversal()
        leaves = []
        while not iterator.IsDoneWithTraversal():
            leaves.append(iterator.GetCurrentDataObject())
            iterator.GoToNextItem()
        return leaves

    def test_blocks_that_are_no_surface_pass(self):
        group = simple.GroupDatasets(Input=[
            self.read_grid(make_volume(), "a.vtu"), self.read(make_fan(20)),
            self.read_grid(make_volume(), "b.vtu"), simple.Wavelet(WholeExtent=[0, 7, 0, 5, 0, 0])])
        flip, text = self.flip_with_messages(group)
        self.assertEqual(text.count("passed unchanged"), 1)
        self.assertNotIn("ERROR", text)
        leaves = self.get_leaves(fetch(flip))
        self.assertEqual([leaf.GetClassName() for leaf in leaves], [
            "vtkUnstructuredGrid", "vtkPolyData", "vtkUnstructuredGrid", "vtkPolyData"])
        self.assertEqual(get_numbers(leaves[0]), [0])
        self.assertEqual(leaves[3].GetNumberOfCells(), 2 * 7 * 5)
        alone = fetch(self.flip(self.read(make_fan(20))))
        self.assertEqual(get_triangles(leaves[1]), get_triangles(alone))


class Malformed(InputTest):
    """Grids that no reader returns, but a programmable filter may."""

    def apply(self, data):
        producer = simple.TrivialProducer()
        producer.GetClientSideObject().SetOutput(data)
        flip, text = self.flip_with_messages(producer)
        return text, flip.GetClientSideObject().GetOutputDataObject(0)

    def test_pixels_without_four_points(self):
        for ids in ((), (0, 1), (0, 1, 2)):
            text, output = self.apply(make_grid(make_fan(5).GetPoints(), [(VTK_PIXEL, ids)]))
            self.assertIn("Cell 0 is a pixel", text)
            self.assertEqual(output.GetNumberOfCells(), 0)

    def test_arrays_that_contradict_each_other(self):
        for offsets, types in (((0, 9), 1), ((0, -3, 3), 2), ((), 1), ((0, 3), 0)):
            cells = vtkCellArray()
            arrays = [vtkTypeInt64Array(), vtkTypeInt64Array(), vtkUnsignedCharArray()]
            for array, values in zip(arrays, (offsets, (0, 1, 2), [VTK_TRIANGLE] * types)):
                for value in values:
                    array.InsertNextValue(value)
            cells.SetData(*arrays[:2])
            grid = vtkUnstructuredGrid()
            grid.SetPoints(make_fan(5).GetPoints())
            grid.SetCells(arrays[2], cells)
            text, output = self.apply(grid)
            self.assertIn("contradict each other", text)
            self.assertEqual(output.GetNumberOfCells(), 0)
            blocks = vtkMultiBlockDataSet()
            for i, block in enumerate((grid, make_fan(20))):
                blocks.SetBlock(i, block)
            text, output = self.apply(blocks)
            self.assertIn("block 1: The offsets", text)
            self.assertEqual(output.GetBlock(1).GetNumberOfCells(), 18)

    def test_short_cell_arrays(self):
        for cells in ([(VTK_TRIANGLE, (0, 1, 4))] * 2, [(VTK_LINE, (0, 1)), (VTK_QUAD, (0, 1, 2, 4))]):
            grid = make_grid(make_fan(5).GetPoints(), cells)
            for kind in (vtkBitArray, vtkStringArray, vtkVariantArray):
                array = kind()
                array.SetName(kind.__name__)
                grid.GetCellData().AddArray(array)
            text, output = self.apply(grid)
            self.assertIn("3 cell arrays with too few tuples", text)
            self.assertGreater(output.GetNumberOfCells(), 1)
            self.assertEqual(get_numbers(output)[-1], 1)


class Errors(PluginTest):
    def test_errors_are_told(self):
        broken = make_fan(10)
        broken.SetPolys(make_cells([(0, 1, 2), (1, 2, 77)]))
        broken.GetCellData().Initialize()
        fan = self.read(make_fan(10))
        for word, source, properties in (
                ("tie rule", simple.Sphere(), {"TieRule": "Canonical"}),
                ("plane", simple.Sphere(), {"Geometry": "Planar"}),
                ("Regions", fan, {"RegionArray": "Regions"}),
                ("olerance", fan, {"Tolerance": 2.0}),
                ("77", self.read(broken, "broken.vtp"), {})):
            with self.subTest(word):
                flip, text = self.flip_with_messages(source, **properties)
                self.assertRegex(text, "ERROR(.|\n)*vtkDelaunayFlip(.|\n)*" + word)
                self.assertEqual(fetch(flip).GetNumberOfCells(), 0)
                self.assertRegex(flip.StopReason, "^failed: .*" + word)



class ViewErrors(PluginTest):
    """In a pipeline that only a view updates, as in the client."""

    def test_ten(self):
        flip = simple.DelaunayFlip(Input=simple.Sphere())
        view = simple.CreateView("RenderView")
        simple.Show(flip, view)
        self.expect_alternating_errors(flip, lambda: simple.Render(view))


if __name__ == "__main__":
    main()

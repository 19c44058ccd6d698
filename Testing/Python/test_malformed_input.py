# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and blocks that are not what a filter expects, as Python makes them."""
import unittest

from delaunayflip import vtkDelaunayFlip

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import (
    vtkBitArray, vtkIntArray, vtkStringArray, vtkTypeInt64Array, vtkVariantArray)
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkImageData, vtkMultiBlockDataSet, vtkStructuredGrid, vtkTable,
    vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

from test_vtk_delaunay_flip import (
    Watched, count_violations, get_cells, get_edges, make_bad_mesh, make_mesh, make_rhombus)

FLIPPED = frozenset((1, 3))


def make_quad():
    """The rhombus as one cell."""
    return make_mesh([(-3, 0, 0), (0, -1, 0), (3, 0, 0), (0, 1, 0)], [(0, 1, 2, 3)])


def make_array(kind):
    array = kind()
    array.SetName("Short")
    return array


class MalformedArrays(unittest.TestCase):

    def expect_one_warning(self, mesh, text):
        watched = Watched(mesh)
        output = watched.run()
        self.assertEqual(watched.errors, [])
        self.assertEqual(len(watched.warnings), 1)
        self.assertIn(text, watched.warnings[0])
        self.assertIn(FLIPPED, get_edges(output))
        return output

    def test_short_arrays(self):
        for kind in (vtkIntArray, vtkStringArray, vtkVariantArray, vtkBitArray):
            array = make_array(kind)
            mesh = make_quad()
            mesh.GetCellData().AddArray(array)
            output = self.expect_one_warning(mesh, 'left out: "Short"')
            self.assertIsNone(output.GetCellData().GetAbstractArray("Short"))
            mesh = make_rhombus()
            mesh.GetCellData().AddArray(array)
            output = self.expect_one_warning(mesh, 'passed unchanged: "Short"')
            self.assertIs(output.GetCellData().GetAbstractArray("Short"), array)

    def test_short_normals(self):
        mesh = make_rhombus()
        normals = numpy_to_vtk(numpy.ones((1, 3)), deep=True)
        normals.SetName("Normals")
        mesh.GetCellData().SetNormals(normals)
        output = self.expect_one_warning(mesh, '"Normals"')
        self.assertIs(output.GetCellData().GetNormals(), normals)

    def test_wrong_offsets(self):
        for offsets in ([], [0, 9], [0, -3, 3], [3, 3], [0, 4, 3]):
            mesh = make_rhombus()
            array = vtkTypeInt64Array()
            for offset in offsets:
                array.InsertNextValue(offset)
            ids = numpy_to_vtk(numpy.array([0, 1, 2]), deep=True)
            lines = vtkCellArray()
            lines.SetData(array, ids)
            mesh.SetLines(lines)
            watched = Watched(mesh)
            self.assertEqual(watched.run().GetNumberOfCells(), 0)
            self.assertEqual(len(watched.errors), 1)
            self.assertIn("offsets", watched.errors[0])

    def test_cells_added_afterwards(self):
        mesh = make_rhombus()
        output = Watched(mesh).run()
        for _ in range(1000):
            mesh.GetPolys().InsertNextCell(3, (0, 1, 2))
        self.assertEqual(output.GetNumberOfCells(), 2)
        self.assertEqual(len(get_cells(output.GetPolys())), 2)


class Observers(unittest.TestCase):

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


class ForeignBlocks(unittest.TestCase):

    def test_pass(self):
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


if __name__ == "__main__":
    unittest.main()

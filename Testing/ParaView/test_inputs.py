# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Inputs that are no vtkPolyData, and errors, which are explained to the user and after which the
session continues."""

from paraview import simple

from PluginTesting import (
    Messages, PluginTest, fetch, get_triangles, main, make_cells, make_fan, refresh)


def list_leaves(output):
    iterator = output.NewIterator()
    iterator.InitTraversal()
    leaves = []
    while not iterator.IsDoneWithTraversal():
        leaves.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return leaves


class Types(PluginTest):
    def make_image(self):
        return simple.Wavelet(WholeExtent=[0, 7, 0, 5, 0, 0])

    def test_a_grid_is_an_error(self):
        with Messages() as messages:
            refresh(simple.DelaunayFlip(Input=self.make_image()))
        self.assertIn("vtkPolyData is required", messages.text)
        heights = simple.WarpByScalar(Input=self.make_image(), Scalars=["POINTS", "RTData"])
        flip = self.flip(simple.ExtractSurface(Input=heights))
        self.assertEqual(len(get_triangles(fetch(flip))), 2 * 7 * 5)

    def test_blocks_that_are_no_surface_pass(self):
        group = simple.GroupDatasets(
            Input=[self.make_image(), self.read(make_fan(20)), self.make_image()])
        flip, text = self.flip_with_messages(group)
        self.assertEqual(text.count("passed unchanged"), 1)
        self.assertNotIn("ERROR", text)
        leaves = list_leaves(fetch(flip))
        self.assertEqual([leaf.GetClassName() for leaf in leaves],
                         ["vtkImageData", "vtkPolyData", "vtkImageData"])
        alone = fetch(self.flip(self.read(make_fan(20))))
        self.assertEqual(get_triangles(leaves[1]), get_triangles(alone))


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
                ("deviation", fan, {"MaximumDeviation": -1.0}),
                ("GPUs", fan, {"Devices": "first"}),
                ("77", self.read(broken, "broken.vtp"), {})):
            with self.subTest(word):
                flip, text = self.flip_with_messages(source, **properties)
                self.assertRegex(text, "ERROR(.|\n)*vtkP?DelaunayFlip(.|\n)*" + word)
                self.assertEqual(fetch(flip).GetNumberOfCells(), 0)
                self.assertRegex(flip.StopReason, "^failed: .*" + word)
                for name in properties:  # the panel never hides what is wrong
                    self.assertIsNone(flip.SMProxy.GetProperty(name).GetHints(), name)


class ViewErrors(PluginTest):
    """In a pipeline that only a view updates, as in the client."""

    def test_ten(self):
        flip = simple.DelaunayFlip(Input=simple.Sphere())
        view = simple.CreateView("RenderView")
        simple.Show(flip, view)
        self.expect_alternating_errors(flip, lambda: simple.Render(view))


if __name__ == "__main__":
    main()

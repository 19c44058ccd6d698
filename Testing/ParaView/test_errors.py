# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Errors are explained to the user, and the session continues."""

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkCellArray

from PluginTesting import Messages, PluginTest, fetch, main, make_cells, make_fan, refresh


class Errors(PluginTest):
    def fail_with(self, words, source, **properties):
        """Applies the filter, and expects this error and no mesh. Returns the filter."""
        with Messages() as messages:
            flip = simple.DelaunayFlip(Input=source, **properties)
            refresh(flip)
        self.assertIn("ERROR", messages.text)
        self.assertIn("vtkDelaunayFlip", messages.text)
        for word in words:
            self.assertIn(word, messages.text)
        self.assertEqual(fetch(flip).GetNumberOfCells(), 0)
        self.assertTrue(flip.StopReason.startswith("failed: "), flip.StopReason)
        self.assertIn(words[0], flip.StopReason)
        return flip

    def test_contradicting_properties(self):
        flip = self.fail_with(["tie rule", "planar"], simple.Sphere(), TieRule="Canonical")
        flip.TieRule = "Keep"
        refresh(flip)
        self.assertEqual(flip.StopReason, "converged")

    def test_not_planar(self):
        self.fail_with(["plane"], simple.Sphere(), Geometry="Planar")

    def test_no_such_region_array(self):
        self.fail_with(["Regions"], self.read(make_fan(10)), RegionArray="Regions")

    def test_point_that_does_not_exist(self):
        mesh = make_fan(10)
        mesh.SetPolys(make_cells([(0, 1, 2), (1, 2, 77)]))
        mesh.GetCellData().Initialize()
        self.fail_with(["77"], self.read(mesh))

    def test_bad_tolerance(self):
        self.fail_with(["olerance"], self.read(make_fan(10)), Tolerance=2.0)

    def test_ten_in_a_row(self):
        flip = simple.DelaunayFlip(Input=simple.Sphere())
        for geometry in ("Planar", "Surface") * 10:
            flip.Geometry = geometry
            with Messages() as messages:
                refresh(flip)
            fails = geometry == "Planar"
            self.assertEqual(messages.text.count("ERROR"), int(fails), messages.text)
            self.assertEqual(fetch(flip).GetNumberOfCells() == 0, fails)
            self.assertEqual(flip.StopReason.split(":")[0], "failed" if fails else "converged")

    def test_nothing_to_flip_is_no_error(self):
        mesh = make_fan(10)
        mesh.SetPolys(vtkCellArray())
        mesh.GetCellData().Initialize()
        self.assertEqual(fetch(self.flip(self.read(mesh))).GetNumberOfPoints(), 10)


class Warnings(PluginTest):
    def test_limit_that_was_asked_for_gives_none(self):
        with Messages() as messages:
            flip = simple.DelaunayFlip(Input=self.read(make_fan(20)), MaximumIterations=2)
            refresh(flip)
        self.assertEqual(messages.text, "")
        self.assertEqual(flip.StopReason, "iteration limit")
        self.assertEqual(flip.NumberOfIterations, 2)
        self.assertGreater(flip.NumberOfNonDelaunayEdges, 0)


if __name__ == "__main__":
    main()

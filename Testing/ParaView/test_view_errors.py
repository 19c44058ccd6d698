# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Errors in a pipeline that only a view updates, as in the client: later updates must work."""

from paraview import simple

from PluginTesting import Messages, PluginTest, main


class ViewErrors(PluginTest):
    def test_ten_errors(self):
        flip = simple.DelaunayFlip(Input=simple.Sphere())
        view = simple.CreateView("RenderView")
        simple.Show(flip, view)
        mesh = flip.SMProxy.GetClientSideObject()
        for geometry in ("Planar", "Surface") * 10:
            flip.Geometry = geometry
            with Messages() as messages:
                simple.Render(view)
            flip.SMProxy.UpdatePropertyInformation()
            fails = geometry == "Planar"
            self.assertEqual(messages.text.count("ERROR"), int(fails), messages.text)
            self.assertEqual(mesh.GetOutput().GetNumberOfCells() == 0, fails)
            self.assertEqual(flip.StopReason.split(":")[0], "failed" if fails else "converged")


if __name__ == "__main__":
    main()

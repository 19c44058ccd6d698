# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""State files and Python traces restore the same filter and the same picture."""

import hashlib

from paraview import simple, smstate, smtrace
from vtkmodules.vtkIOImage import vtkPNGReader

from PluginTesting import PluginTest, fetch, get_triangles, main, make_fan, refresh

SETTINGS = {
    "Geometry": "Planar XY",
    "RegionArray": "Side",
    "TieRule": "Canonical",
    "Backend": "Threads",
    "NumberOfPieces": 3,
    "NumberOfThreads": 2,
    "GenerateFlipCount": 1,
}


def run_script(text):
    exec(compile(text, "script", "exec"), {"__name__": "__main__"})


def digest_pixels(path):
    """The picture's size and a hash of its colours."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    colours = hashlib.sha256(memoryview(scalars)).hexdigest()
    return reader.GetOutput().GetDimensions(), colours


class Session(PluginTest):
    """A mesh, the filter with its settings, and a view that shows its edges."""

    def setUp(self):
        super().setUp()
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [300, 200]

    def build(self):
        """The pipeline, as a user would make it."""
        flip = simple.DelaunayFlip(
            registrationName="Flip", Input=self.read(make_fan(30)), **SETTINGS)
        display = simple.Show(flip, self.view)
        display.Representation = "Surface With Edges"
        simple.ColorBy(display, ("CELLS", "vtkDelaunayFlipCount"))
        simple.ResetCamera(self.view)
        simple.Render(self.view)

    def snapshot(self):
        """(settings, triangles, picture) of the current session."""
        flip = simple.FindSource("Flip")
        refresh(flip)
        settings = {name: flip.GetPropertyValue(name) for name in SETTINGS}
        simple.SaveScreenshot(self.path("picture.png"), simple.GetActiveView())
        return settings, get_triangles(fetch(flip)), digest_pixels(self.path("picture.png"))

    def start_again(self):
        self.view = None
        simple.ResetSession()
        self.assertIsNone(simple.FindSource("Flip"))

    def test_states(self):
        self.build()
        before = self.snapshot()
        script = smstate.get_state()
        self.assertIn("DelaunayFlip(registrationName='Flip'", script)
        simple.SaveState(self.path("state.pvsm"))
        for restore in (
                lambda: simple.LoadState(self.path("state.pvsm")), lambda: run_script(script)):
            self.start_again()
            restore()
            self.assertEqual(self.snapshot(), before)

    def test_trace(self):
        smtrace.start_trace()
        self.build()
        script = smtrace.stop_trace()
        self.assertIn("DelaunayFlip(registrationName='Flip'", script)
        self.assertRegex(script, r"\bGeometry ?= ?'Planar XY'")
        settings, triangles, _ = self.snapshot()
        self.start_again()
        run_script(script)
        # A trace has the settings at creation, not later changes of displays.
        self.assertEqual(self.snapshot()[:2], (settings, triangles))


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Helpers for the tests of the plugin: load it, write meshes to files, and read results.

Run by pvpython. DELAUNAYFLIP_PLUGIN names the plugin, a library or a Python file. Meshes are passed
in files, as by a user, so that a server can read them too.
"""

import inspect
import os
import sys
import tempfile
import unittest

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from surfaces import get_triangles, make_cells, make_fan, make_lattice  # noqa: F401

PLUGIN = os.environ["DELAUNAYFLIP_PLUGIN"]
if not hasattr(inspect, "getargspec"):
    # ParaView 5.11 asks for it to load a plugin in Python, but Python 3.11 has no such function.
    inspect.getargspec = inspect.getfullargspec


def make_line(mesh, start, end):
    """A constraint edge between two points of a mesh, with its own points."""
    line = vtkPolyData()
    line.SetPoints(vtkPoints())
    line.GetPoints().SetDataType(mesh.GetPoints().GetDataType())
    for point in (start, end):
        line.GetPoints().InsertNextPoint(mesh.GetPoint(point))
    line.SetLines(make_cells([(0, 1)]))
    return line


def get_edges(mesh):
    return {frozenset((cell[i - 1], cell[i])) for cell in get_triangles(mesh)
            for i in range(len(cell))}


def fetch(proxy, port=0):
    """A copy of the output of a filter or of one of its ports, on the client."""
    return servermanager.Fetch(proxy, idx=port)


def refresh(proxy):
    """Updates a filter and its information properties, like the Properties panel."""
    proxy.UpdatePipeline()
    proxy.SMProxy.UpdatePipelineInformation()


class Messages:
    """Collects the errors and warnings that a user would read in Output Messages."""

    def __enter__(self):
        self._before = vtkOutputWindow.GetInstance()
        self._window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self._window)
        return self

    def __exit__(self, *_):
        vtkOutputWindow.SetInstance(self._before)

    @property
    def text(self):
        return self._window.GetOutput()


class PluginTest(unittest.TestCase):
    """A separate session with the plugin loaded, and a folder for files."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        simple.ResetSession()
        simple.LoadPlugin(PLUGIN, remote=False)

    def path(self, name):
        return os.path.join(self.folder, name)

    def save(self, mesh, name="mesh.vtp"):
        """Writes a vtkPolyData. Returns the path."""
        writer = vtkXMLPolyDataWriter()
        writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
        writer.SetFileName(self.path(name))
        writer.SetInputData(mesh)
        self.assertEqual(writer.Write(), 1)
        return self.path(name)

    def read(self, mesh, name="mesh.vtp"):
        """A reader of the mesh."""
        return simple.XMLPolyDataReader(FileName=[self.save(mesh, name)])

    def flip_with_messages(self, source, **properties):
        """Applies the filter. Returns it, and the messages."""
        with Messages() as messages:
            flip = simple.DelaunayFlip(Input=source, **properties)
            refresh(flip)
        return flip, messages.text

    def flip(self, source, **properties):
        """Applies the filter, and expects no message. Returns it."""
        flip, text = self.flip_with_messages(source, **properties)
        self.assertEqual(text, "")
        return flip

    def expect_alternating_errors(self, flip, update):
        """Ten updates that fail, and others between them that do not."""
        for geometry in ("Planar", "Surface") * 10:
            flip.Geometry = geometry
            with Messages() as messages:
                update()
            flip.SMProxy.UpdatePropertyInformation()
            fails = geometry == "Planar"
            self.assertEqual(messages.text.count("ERROR"), int(fails), messages.text)
            mesh = flip.GetClientSideObject().GetOutputDataObject(0)
            self.assertEqual(mesh.GetNumberOfCells() == 0, fails)
            self.assertEqual(flip.StopReason.split(":")[0], "failed" if fails else "converged")


def main():
    """Runs the tests of the script and ends pvpython. Closes the views first: with open views it
    may crash."""
    program = unittest.main(module="__main__", verbosity=2, exit=False)
    simple.Disconnect()
    sys.exit(0 if program.result.wasSuccessful() else 1)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The examples, off screen: their files, pictures and frames, the formats that they read, and their
messages in case of an error.

In the environment, EXAMPLE is the program and STEM the name of its files. The baselines are frames of
the live viewers, reduced to 128 colours, a difference that the comparison ignores.
"""
import os
import subprocess
import sys
import tempfile
import unittest

from delaunayflip import vtkDelaunayFlip
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkUnstructuredGridWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

HERE = os.path.dirname(os.path.abspath(__file__))
BASELINES = os.path.join(HERE, "..", "Cxx", "Baseline")
sys.path.insert(0, os.path.join(HERE, "..", "..", "Examples", "Python"))

from example_files import make_bad_mesh  # noqa: E402

WRITERS = {".vtk": vtkPolyDataWriter, ".vtp": vtkXMLPolyDataWriter, ".ply": vtkPLYWriter,
           ".stl": vtkSTLWriter, ".obj": vtkOBJWriter}

# An error of vtkImageDifference, which tolerates shifts by a pixel, as between versions of
# FreeType. A picture without its texts has an error of 90, the mesh of another iteration 7 to 280.
TOLERANCE = 15.0


def difference(file, other):
    readers = [vtkPNGReader(), vtkPNGReader()]
    for reader, name in zip(readers, (file, other)):
        reader.SetFileName(name)
    images = vtkImageDifference()
    images.SetInputConnection(readers[0].GetOutputPort())
    images.SetImageConnection(readers[1].GetOutputPort())
    images.Update()
    return images.GetThresholdedError()


def read_triangles(mesh):
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3).tolist()


def flip_at_once():
    flip = vtkDelaunayFlip()
    flip.SetInputData(make_bad_mesh())
    flip.Update()
    return flip.GetOutput()


class Example(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.prefix = self.path(os.environ["STEM"])

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_example(self, status, *arguments):
        """What it prints."""
        command = os.environ["EXAMPLE"].split(";") + list(arguments)
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result.stdout + result.stderr

    def read_result(self):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(self.prefix + ".vtp")
        reader.Update()
        return reader.GetOutput()


class Picture(Example):
    """Examples that write a mesh and a picture into a folder."""

    def test_files(self):
        told = self.run_example(0, self.folder)
        self.assertRegex(told, r"^\d+ flips in \d+ iterations, 0 bad edges left")
        self.assertGreater(self.read_result().GetNumberOfPolys(), 1000)
        picture = vtkPNGReader()
        picture.SetFileName(self.prefix + ".png")
        picture.Update()
        self.assertEqual(picture.GetOutput().GetDimensions(), (1400, 600, 1))

    def test_usage(self):
        self.assertRegex(self.run_example(0, "--help"), "(?s)FOLDER.*Exit status")
        self.assertIn("--colour", self.run_example(2, "--colour"))
        self.assertIn("error: /no/such/folder: cannot be written to\n",
                      self.run_example(3, "/no/such/folder"))


class Strokes(Example):
    """The example with a brush. Its first two frames are the input and the mesh of that."""

    def test_frames(self):
        self.run_example(0, "--points", "2000", "--strokes", "3", "--frames", self.prefix)
        frames = sorted(os.listdir(self.folder))
        self.assertEqual(frames, [f"frame{i:04d}.png" for i in range(5)])
        for before, after in zip(frames, frames[1:]):
            self.assertGreater(difference(self.path(before), self.path(after)), 0.0, after)
        self.run_example(2, "--window", "--frames", self.prefix)


class Viewer(Example):
    """The live viewers."""

    def write(self, name, mesh, writer=None):
        writer = writer or WRITERS[os.path.splitext(name)[1].lower()]()
        writer.SetInputData(mesh)
        writer.SetFileName(self.path(name))
        writer.Write()
        return self.path(name)

    def flip(self, *arguments):
        """Runs the viewer. Returns the mesh that it wrote."""
        self.run_example(0, *arguments, "--frames", self.prefix)
        return self.read_result()

    def test_frames(self):
        mesh = self.flip()
        steps = mesh.GetFieldData().GetArray("DelaunayFlip:Flipped").GetNumberOfTuples()
        frames = sorted(name for name in os.listdir(self.folder) if name.endswith(".png"))
        self.assertEqual(frames, [f"frame{i:04d}.png" for i in range(steps + 1)])
        for number in ("0000", "0005", "0010"):
            frame, baseline = f"{self.prefix}{number}.png", f"{BASELINES}/LiveFlip{number}.png"
            self.assertLess(difference(frame, baseline), TOLERANCE, number)
        for before, after in zip(frames, frames[1:]):
            self.assertGreater(difference(self.path(before), self.path(after)), 0.0, after)
        self.assertEqual(read_triangles(mesh), read_triangles(flip_at_once()))

    def test_files(self):
        expected = flip_at_once()
        for name in [f"mesh{extension}" for extension in WRITERS] + ["UPPER.VTP"]:
            with self.subTest(name):
                mesh = self.flip(self.write(name, make_bad_mesh()))
                self.assertEqual(mesh.GetNumberOfPolys(), expected.GetNumberOfPolys())
                self.assertEqual(mesh.GetNumberOfPoints(), expected.GetNumberOfPoints())
                flips = [one.GetFieldData().GetArray("DelaunayFlip:TotalFlips").GetTuple1(0)
                         for one in (mesh, expected)]
                self.assertEqual(*flips)

    def test_what_cannot_be_read_or_written(self):
        for file, reason in ((self.path("missing.vtp"), "no such file"), (self.folder, "unknown file"),
                             (self.cut("a.ply"), "cannot be read"), (self.cut("a.vtp"), "cannot be read"),
                             (self.cut("a.vtk", 42), "cannot be read"),
                             (self.cut("b.vtk", 51), "cannot be read: Error reading"),
                             (self.write("grid.vtk", vtkUnstructuredGrid(), vtkUnstructuredGridWriter()),
                              "cannot be read")):
            with self.subTest(file):
                told = self.run_example(2 if file == self.folder else 3, file)
                self.assertIn(f"{file}: {reason}", told)
        prefix = self.path("missing/frame")
        self.assertIn(f"{prefix}.vtp: cannot be written", self.run_example(3, "--frames", prefix))

    def cut(self, name, version=None):
        """Half of a file. VTK 9.1 crashes on such .ply files, and on .vtk files of version 4.2; for
        other formats it returns a part of the mesh."""
        writer = WRITERS[os.path.splitext(name)[1]]()
        if version:
            writer.SetFileVersion(version)
            writer.SetFileTypeToBinary()
        file = self.write(name, make_bad_mesh(), writer)
        os.truncate(file, os.path.getsize(file) // 2)
        return file

    def test_options(self):
        hill = make_bad_mesh()  # no plane holds its points
        for i in range(hill.GetNumberOfPoints()):
            x, y, _ = hill.GetPoint(i)
            hill.GetPoints().SetPoint(i, x, y, 0.3 * x * y)
        file = self.write("hill.vtp", hill)
        for geometry in ("planar-xy", "surface"):
            field = self.flip(file, "--geometry", geometry).GetFieldData()
            self.assertEqual(field.GetAbstractArray("DelaunayFlip:GeometryUsed").GetValue(0), geometry)
        self.assertIn("geometry 'planar' was requested",
                      self.run_example(2, file, "--geometry", "planar", "--frames", self.prefix))
        for wrong in (("--colour",), ("--geometry", "round"), ("mesh.xyz",), ("a.vtp", "b.vtp")):
            self.assertIn(wrong[-1], self.run_example(2, *wrong))
        for word in ("MESH", "--geometry", "planar-xy", "--frames", ".vtk .vtp .ply .stl .obj"):
            self.assertIn(word, self.run_example(0, "--help"))

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The live viewers of the examples, off screen: their frames, the final mesh, the formats that they
read, and their messages in case of an error.

In the environment, EXAMPLE is the viewer. The baselines are its frames, reduced to 128 colours, a
difference that the comparison ignores.
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
# FreeType. The same picture without its texts has an error of 90, the mesh of another iteration 7
# to 280.
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


class Viewer(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.prefix = os.path.join(self.folder, "frame")

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, mesh, writer=None):
        writer = writer or WRITERS[os.path.splitext(name)[1].lower()]()
        writer.SetInputData(mesh)
        writer.SetFileName(self.path(name))
        writer.Write()
        return self.path(name)

    def write_text(self, name, text):
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write(text)
        return self.path(name)

    def run_viewer(self, *arguments):
        command = os.environ["EXAMPLE"].split(";") + list(arguments)
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def run_well(self, *arguments):
        result = self.run_viewer(*arguments)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def read_result(self):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(self.prefix + ".vtp")
        reader.Update()
        return reader.GetOutput()

    def flip_file(self, *arguments):
        """Runs the viewer on a file. Returns the mesh that it wrote, and its flips."""
        self.run_well(*arguments, "--frames", self.prefix)
        mesh = self.read_result()
        return mesh, mesh.GetFieldData().GetArray("DelaunayFlip:TotalFlips").GetTuple1(0)

    def expect_failure(self, status, *arguments, saying):
        result = self.run_viewer(*arguments)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        self.assertIn(saying, result.stderr)
        return result

    def list_frames(self):
        return sorted(name for name in os.listdir(self.folder) if name.endswith(".png"))


class Frames(Viewer):

    def test_frames(self):
        self.run_well("--frames", self.prefix)
        frames = self.list_frames()
        steps = self.read_result().GetFieldData().GetArray("DelaunayFlip:Flipped").GetNumberOfTuples()
        self.assertEqual(frames, [f"frame{i:04d}.png" for i in range(steps + 1)])
        for number in ("0000", "0005", "0010"):
            frame, baseline = f"{self.prefix}{number}.png", f"{BASELINES}/LiveFlip{number}.png"
            self.assertLess(difference(frame, baseline), TOLERANCE, number)
        paths = [os.path.join(self.folder, name) for name in frames]
        for before, after in zip(paths, paths[1:]):
            self.assertGreater(difference(before, after), 0.0, after)

    def test_last_mesh_is_that_of_a_run_at_once(self):
        self.run_well("--frames", self.prefix)
        flip = vtkDelaunayFlip()
        flip.SetInputData(make_bad_mesh())
        flip.Update()
        self.assertEqual(read_triangles(self.read_result()), read_triangles(flip.GetOutput()))

    def test_what_cannot_be_written_fails(self):
        prefix = self.path("missing/frame")
        self.expect_failure(3, "--frames", prefix, saying=f"{prefix}.vtp: cannot be written")


class Files(Viewer):

    def test_formats(self):
        flip = vtkDelaunayFlip()
        flip.SetInputData(make_bad_mesh())
        flip.Update()
        for name in [f"mesh{extension}" for extension in WRITERS] + ["UPPER.VTP"]:
            with self.subTest(name):
                mesh, flips = self.flip_file(self.write(name, make_bad_mesh()))
                self.assertEqual(mesh.GetNumberOfPolys(), flip.GetOutput().GetNumberOfPolys())
                self.assertEqual(mesh.GetNumberOfPoints(), flip.GetOutput().GetNumberOfPoints())
                self.assertEqual(flips, flip.GetTotalFlips())

    def test_points_that_a_format_repeats_are_joined(self):
        """vtkOBJReader gives each of these triangles its own points."""
        file = self.write_text("rhombus.obj", "v -3 0 0\nv 0 -1 0\nv 3 0 0\nv 0 1 0\n"
                               "vn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n")
        mesh, flips = self.flip_file(file)
        self.assertEqual(mesh.GetNumberOfPoints(), 4)
        self.assertEqual(flips, 1)

    def test_begins_where_the_file_is(self):
        flip = vtkDelaunayFlip()
        flip.SetInputData(make_bad_mesh())
        flip.SetMaximumIterations(8)
        flip.Update()
        self.flip_file(self.write("mesh.vtp", flip.GetOutput()))
        self.assertEqual(len(self.list_frames()), 3)  # the input, iterations 9 and 10

    def test_what_cannot_be_read(self):
        missing, empty = self.path("missing.vtp"), self.write_text("empty.ply", "")
        folder = self.path("folder.vtp")
        os.mkdir(folder)
        for file, reason in ((missing, "no such file"), (folder, "no such file"),
                             (empty, "cannot be read"), (self.cut("a.ply"), "cannot be read"),
                             (self.cut("a.vtk"), "cannot be read"),
                             (self.cut("a.vtp"), "cannot be read"),
                             (self.cut("b.vtk", version=51), "cannot be read: Error reading"),
                             (self.write_grid("grid.vtk"), "cannot be read")):
            with self.subTest(file):
                self.expect_failure(3, file, saying=f"error: {file}: {reason}")

    def cut(self, name, version=42):
        """Half of a file. VTK 9.1 crashes on such .ply files, and on .vtk files of version 4.2; for
        other formats it returns a part of the mesh."""
        writer = WRITERS[os.path.splitext(name)[1]]()
        if name.endswith(".vtk"):
            writer.SetFileVersion(version)
            writer.SetFileTypeToBinary()
        file = self.write(name, make_bad_mesh(), writer)
        os.truncate(file, os.path.getsize(file) // 2)
        return file

    def write_grid(self, name):
        return self.write(name, vtkUnstructuredGrid(), vtkUnstructuredGridWriter())


class Options(Viewer):

    def make_hill(self):
        """A height field whose points lie in no plane."""
        mesh = make_bad_mesh()
        points = mesh.GetPoints()
        for i in range(points.GetNumberOfPoints()):
            x, y, _ = points.GetPoint(i)
            points.SetPoint(i, x, y, 0.3 * x * y)
        return mesh

    def test_geometry(self):
        hill = self.write("hill.vtp", self.make_hill())
        for geometry in ("planar-xy", "surface"):
            mesh, _ = self.flip_file(hill, "--geometry", geometry)
            used = mesh.GetFieldData().GetAbstractArray("DelaunayFlip:GeometryUsed").GetValue(0)
            self.assertEqual(used, geometry)

    def test_geometry_that_does_not_fit(self):
        hill = self.write("hill.vtp", self.make_hill())
        self.expect_failure(2, hill, "--geometry", "planar", "--frames", self.prefix,
                            saying="error: geometry 'planar' was requested")

    def test_help(self):
        result = self.run_viewer("--help")
        self.assertEqual(result.returncode, 0)
        for word in ("MESH", "--geometry", "planar-xy", "--frames", ".vtk .vtp .ply .stl .obj"):
            self.assertIn(word, result.stdout)

    def test_wrong_usage(self):
        self.expect_failure(2, "--colour", saying="--colour")
        self.expect_failure(2, "--geometry", "round", saying="round")
        self.expect_failure(2, "mesh.xyz", saying="mesh.xyz: unknown file extension")
        self.expect_failure(2, "a.vtp", "b.vtp", saying="b.vtp")


if __name__ == "__main__":
    unittest.main()

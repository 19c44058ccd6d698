# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The live viewers of the examples, off screen: frame by frame, and the mesh that they end with.

LIVE_FLIP in the environment is the viewer. The baselines are frames of it, reduced to 128 colours,
which the comparison does not notice.
"""
import os
import subprocess
import sys
import tempfile
import unittest

from delaunayflip import vtkDelaunayFlip
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

HERE = os.path.dirname(os.path.abspath(__file__))
BASELINES = os.path.join(HERE, "..", "Cxx", "Baseline")
sys.path.insert(0, os.path.join(HERE, "..", "..", "Examples", "Python"))

from example_files import make_bad_mesh  # noqa: E402

# By vtkImageDifference, which looks past shifts by a pixel, as between versions of FreeType. The
# same picture without its texts is at 90, the mesh of another iteration at 7 to 280.
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


class LiveFlip(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.prefix = os.path.join(self.folder, "frame")

    def run_viewer(self, *arguments):
        command = os.environ["LIVE_FLIP"].split(";") + list(arguments)
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def run_well(self, *arguments):
        result = self.run_viewer(*arguments)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def read_result(self):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(self.prefix + ".vtp")
        reader.Update()
        return reader.GetOutput()

    def list_frames(self):
        return sorted(name for name in os.listdir(self.folder) if name.endswith(".png"))

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

    def test_mesh_of_a_file(self):
        writer = vtkXMLPolyDataWriter()
        writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
        flip = vtkDelaunayFlip()
        flip.SetInputData(make_bad_mesh())
        flip.SetMaximumIterations(8)
        flip.AddObserver("WarningEvent", lambda *_: None)  # of the limit
        writer.SetInputConnection(flip.GetOutputPort())
        writer.SetFileName(os.path.join(self.folder, "mesh.vtp"))
        writer.Write()
        self.run_well(writer.GetFileName(), "--frames", self.prefix)
        self.assertEqual(len(self.list_frames()), 3)  # the input, iterations 9 and 10

    def test_what_cannot_be_written_fails(self):
        result = self.run_viewer("--frames", os.path.join(self.folder, "missing", "frame"))
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("Cannot write", result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/ParaView/flip_movie.py: it writes one frame per iteration, three of which are compared
with baselines; the formats that it reads; and its error messages.

The pictures may differ by TOLERANCE, the error of vtkImageDifference that VTK's own image tests
allow, because drivers draw edges slightly differently.
"""

import os
import subprocess
import tempfile
import unittest

from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLE = os.path.join(HERE, "..", "..", "Examples", "ParaView", "flip_movie.py")
TOLERANCE = 10
FRAMES = 16
PATIENCE = 120  # seconds


def compare(file, baseline):
    """The measure of vtkImageDifference."""
    readers = []
    for name in (file, baseline):
        reader = vtkPNGReader()
        reader.SetFileName(name)
        readers.append(reader)
    difference = vtkImageDifference()
    difference.SetInputConnection(readers[0].GetOutputPort())
    difference.SetImageConnection(readers[1].GetOutputPort())
    difference.Update()
    return difference.GetThresholdedError()


def run_example(*arguments):
    environment = dict(
        os.environ, PV_PLUGIN_PATH=os.path.dirname(os.environ["DELAUNAYFLIP_PLUGIN"]))
    return subprocess.run(
        [os.environ["DELAUNAYFLIP_PVPYTHON"], EXAMPLE, *arguments], env=environment,
        timeout=PATIENCE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, encoding="utf-8", check=False)


class Movie(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_frames(self):
        self.expect(f"{FRAMES} frames of 779 flips")
        frames = self.list_frames()
        self.assertEqual(frames, [f"flip.{i:04d}.png" for i in range(FRAMES)])
        for frame in (frames[0], frames[FRAMES // 2], frames[-1]):
            baseline = os.path.join(HERE, "Baseline", frame)
            with self.subTest(frame):
                self.assertLess(compare(self.path(frame), baseline), TOLERANCE)
        self.assertGreater(
            compare(self.path(frames[0]), self.path(frames[-1])), 10 * TOLERANCE)

    def test_what_is_wrong_is_told(self):
        for status, message, *arguments in (
                (2, "known are .vtk .vtp .ply .stl .obj", "mesh.xyz"),
                (2, "invalid choice: 'round'", "--geometry", "round"),
                (3, "error: missing.vtp: no such file", "missing.vtp")):
            with self.subTest(message):
                run = run_example(self.folder, *arguments)
                self.assertEqual(run.returncode, status, run.stdout)
                self.assertIn(message, run.stdout)

    def expect(self, outcome, *arguments):
        run = run_example(self.folder, *arguments)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn(outcome, run.stdout)

    def path(self, name):
        return os.path.join(self.folder, name)

    def list_frames(self):
        return sorted(name for name in os.listdir(self.folder) if name.endswith(".png"))


if __name__ == "__main__":
    unittest.main(verbosity=2)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/ParaView/flip_movie.py: a frame an iteration, three of them compared with baselines.

The pictures may differ by TOLERANCE in the measure of vtkImageDifference, which is what VTK's own
image tests allow: other drivers draw the edges' pixels a little differently.
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


class Movie(unittest.TestCase):
    def test_frames(self):
        with tempfile.TemporaryDirectory() as folder:
            self.write_frames(folder)
            frames = sorted(name for name in os.listdir(folder) if name.endswith(".png"))
            self.assertEqual(frames, [f"flip.{i:04d}.png" for i in range(FRAMES)])
            for frame in (frames[0], frames[FRAMES // 2], frames[-1]):
                baseline = os.path.join(HERE, "Baseline", frame)
                with self.subTest(frame):
                    self.assertLess(compare(os.path.join(folder, frame), baseline), TOLERANCE)
            self.assertGreater(
                compare(os.path.join(folder, frames[0]), os.path.join(folder, frames[-1])),
                10 * TOLERANCE)

    def write_frames(self, folder):
        environment = dict(
            os.environ, PV_PLUGIN_PATH=os.path.dirname(os.environ["DELAUNAYFLIP_PLUGIN"]))
        run = subprocess.run(
            [os.environ["DELAUNAYFLIP_PVPYTHON"], EXAMPLE, folder], env=environment,
            timeout=PATIENCE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, encoding="utf-8", check=False)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn(f"{FRAMES} frames of 779 flips", run.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Examples that write a mesh and a picture into a folder: their files, and their messages in case
of an error. In the environment, EXAMPLE is the program and STEM the name of its files.
"""
import os
import subprocess
import tempfile
import unittest

from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def run(*arguments):
    command = os.environ["EXAMPLE"].split(";") + list(arguments)
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Example(unittest.TestCase):

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run(folder)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertRegex(result.stdout, r"^\d+ flips in \d+ iterations, 0 bad edges left")
            mesh, picture = vtkXMLPolyDataReader(), vtkPNGReader()
            for reader, extension in ((mesh, ".vtp"), (picture, ".png")):
                reader.SetFileName(os.path.join(folder, os.environ["STEM"] + extension))
                reader.Update()
            self.assertGreater(mesh.GetOutput().GetNumberOfPolys(), 1000)
            self.assertEqual(picture.GetOutput().GetDimensions(), (1400, 600, 1))

    def test_help(self):
        result = run("--help")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("FOLDER", result.stdout)
        self.assertIn("Exit status", result.stdout)

    def test_wrong_usage(self):
        result = run("--colour")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--colour", result.stderr)

    def test_a_folder_that_is_not_there(self):
        result = run("/no/such/folder")
        self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
        self.assertIn("error: /no/such/folder: cannot be written to\n", result.stderr)


if __name__ == "__main__":
    unittest.main()

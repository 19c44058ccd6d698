# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""test_example.py PROGRAM: Examples/Cxx/FlipInParallel.cxx on one rank and on two. The pieces of the
two must have the triangles of the one."""
import os
import subprocess
import sys
import tempfile
import unittest

from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader

from launching import HAS_MPIRUN, launch, make_environment

PATIENCE = 120  # seconds: a rank must not wait forever for another one


def run(ranks, *arguments):
    return subprocess.run([*launch(ranks), PROGRAM, *arguments], env=make_environment(),
                          timeout=PATIENCE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", check=False)


def read(path):
    """The triangles by the places of their corners, and the pieces that they are in."""
    reader = vtkXMLPPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    triangles, pieces = set(), set()
    for cell in range(mesh.GetNumberOfCells()):
        ids = mesh.GetCell(cell).GetPointIds()
        triangles.add(frozenset(mesh.GetPoint(ids.GetId(i)) for i in range(3)))
        pieces.add(mesh.GetCellData().GetArray("piece").GetValue(cell))
    return triangles, pieces


class Example(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "flipped.pvtp")

    def flip_on(self, ranks, *arguments):
        done = run(ranks, self.path, *arguments)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, rf"[1-9]\d* flips in \d+ rounds on {ranks} ranks, 0 bad")
        return read(self.path)

    def test_two_ranks(self):
        alone, pieces = self.flip_on(1)
        self.assertEqual((len(alone), pieces), (612, {0}))
        self.assertEqual(self.flip_on(2), (alone, {0, 1}))

    def test_wrong_usage(self):
        done = run(1)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("usage: ", done.stdout)

    def test_a_file_that_is_not_there(self):
        done = run(2, self.path, "/no/such/file.vtp")
        self.assertEqual(done.returncode, 3, done.stdout)


if __name__ == "__main__":
    if not HAS_MPIRUN:
        print("skipped: no mpirun")
        sys.exit(125)
    PROGRAM = sys.argv.pop(1)
    unittest.main()

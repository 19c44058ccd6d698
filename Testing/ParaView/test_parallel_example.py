# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/ParaView/flip_in_parallel.py on two ranks: its files have the triangles of one process."""

import glob
import os
import subprocess
import sys

from launching import HAS_MPIRUN, launch, make_environment
from paraview import simple
from PluginTesting import PLUGIN, PluginTest, fetch, get_triangles, main, make_lattice

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLE = os.path.join(HERE, "..", "..", "Examples", "ParaView", "flip_in_parallel.py")
PVBATCH = os.path.join(os.path.dirname(os.environ["DELAUNAYFLIP_PVPYTHON"]), "pvbatch")
PATIENCE = 120  # seconds: a rank must not wait forever for another one


def list_places(mesh):
    return {frozenset(mesh.GetPoint(i) for i in triangle) for triangle in get_triangles(mesh)}


class ExampleTest(PluginTest):
    def run_example(self, *arguments):
        environment = dict(make_environment(), PV_PLUGIN_PATH=os.path.dirname(PLUGIN))
        return subprocess.run(
            [*launch(2), PVBATCH, EXAMPLE, *arguments], env=environment, timeout=PATIENCE,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            encoding="utf-8", check=False)

    def expect_pieces_of(self, mesh):
        path = self.path("flipped.pvtp")
        done = self.run_example(mesh, path)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"[1-9]\d* flips in [2-9]\d* rounds, 0 bad edges left")
        self.assertEqual(len(glob.glob(self.path("flipped*/*.vtp"))), 2)
        pieces = fetch(simple.XMLPartitionedPolydataReader(FileName=[path]))
        alone = fetch(self.flip(simple.OpenDataFile(mesh)))
        self.assertEqual(pieces.GetNumberOfCells(), alone.GetNumberOfCells())
        self.assertEqual(list_places(pieces), list_places(alone))


class Example(ExampleTest):
    def test_pieces(self):
        """Sheared so far that edges between the pieces flip."""
        self.expect_pieces_of(self.save(make_lattice(20, shear=2.7)))

    def test_wrong_usage(self):
        done = self.run_example()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("usage: mpirun", done.stdout)


class RealMesh(ExampleTest):
    def test_coast(self):
        mesh = os.path.join(os.environ["DELAUNAYFLIP_DATA_DIR"], "adcirc_alaska.vtk")
        if not os.path.exists(mesh):
            self.skipTest("no DELAUNAYFLIP_DATA_DIR")
        self.expect_pieces_of(mesh)


if __name__ == "__main__":
    if not HAS_MPIRUN or not os.path.exists(PVBATCH):
        print("skipped: no mpirun or no pvbatch")
        sys.exit(125)
    main()

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the options reach the filter, each with a mesh for which the option matters."""

import math
import os
import resource
import unittest

from CommandTesting import (
    CommandTest, bumpy_grid, make_mesh, random_insertion, triangle_set, read_mesh, write_mesh)

# Divided along its long diagonal.
KITE = [(-2.0, 0.0, 0.0), (0.0, -1.0, 0.0), (2.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
KITE_CELLS = [(0, 1, 2), (0, 2, 3)]


class Options(CommandTest):
    def flips(self, mesh, *arguments):
        path = write_mesh(mesh, self.path("in.vtk"))
        return self.report(path, "out.vtk", *arguments)["total_flips"]

    def test_lines(self):
        mesh = make_mesh(KITE, KITE_CELLS, [(2, 0)])
        self.assertEqual(self.flips(mesh), 0)
        self.assertEqual(self.flips(mesh, "--ignore-lines"), 1)

    def test_quality(self):
        path = write_mesh(make_mesh(KITE, KITE_CELLS), self.path("in.vtk"))
        for name in ("out.vtk", "out.vtp"):
            self.succeed(path, name)
            self.assertEqual(self.angles(name), [])
            self.succeed(path, name, "--quality")
            before, after = self.angles(name)
            self.assertAlmostEqual(before, math.degrees(math.atan(1 / 2)))
            self.assertAlmostEqual(after, 2 * math.degrees(math.atan(1 / 2)))
        self.fail_with(2, path, "out.ply", "--quality", naming=["--quality", ".vtp"])

    def angles(self, name):
        """The smallest values of the arrays that --quality adds."""
        data = read_mesh(self.path(name)).GetCellData()
        arrays = [data.GetArray("vtkDelaunayFlipAngle" + when) for when in ("Before", "After")]
        return [array.GetRange()[0] for array in arrays if array]

    def test_feature_angle(self):
        """A roof of 90 degrees whose ridge is the long diagonal."""
        points = [(-2, 0, 0), (0, -1, -1), (2, 0, 0), (0, 1, -1)]
        mesh = make_mesh(points, KITE_CELLS)
        self.assertEqual(self.flips(mesh), 0)
        self.assertEqual(self.flips(mesh, "--feature-angle", "85"), 0)
        self.assertEqual(self.flips(mesh, "--feature-angle", "95"), 1)

    def test_tolerance(self):
        """The opposite angles sum to about pi + 0.01."""
        mesh = make_mesh([(-1, 0, 0), (0, -0.995, 0), (1, 0, 0), (0, 0.995, 0)], KITE_CELLS)
        angles = ("--criterion", "opposite-angles")
        self.assertEqual(self.flips(mesh, *angles), 1)
        self.assertEqual(self.flips(mesh, *angles, "--tolerance", "0.009"), 1)
        self.assertEqual(self.flips(mesh, *angles, "--tolerance", "0.011"), 0)
        self.assertEqual(self.flips(mesh, "--tolerance", "0.011"), 1)

    def test_tie_rule(self):
        """A square has two Delaunay triangulations."""
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        results = []
        for cells in (KITE_CELLS, [(0, 1, 3), (1, 2, 3)]):
            mesh = make_mesh(points, cells)
            self.assertEqual(self.flips(mesh), 0)
            self.flips(mesh, "--tie-rule", "canonical")
            results.append(triangle_set(read_mesh(self.path("out.vtk"))))
        self.assertEqual(results[0], results[1])

    def test_geometry(self):
        mesh = bumpy_grid(6, 1)
        path = write_mesh(mesh, self.path("in.vtk"))
        for geometry in ("planar-xy", "surface"):
            report = self.report(path, "out.vtk", "--geometry", geometry)
            self.assertEqual(report["geometry"], geometry)
        self.assertEqual(self.report(path, "out.vtk")["geometry"], "planar-xy")
        flat = write_mesh(bumpy_grid(6, 0), self.path("flat.vtk"))
        self.assertEqual(self.report(flat, "out.vtk")["geometry"], "planar")

    def test_threads(self):
        path = write_mesh(bumpy_grid(6, 0), self.path("in.vtk"))
        arguments = (path, "out.vtk", "--backend", "threads", "--threads")
        for threads in (1, 3):
            self.assertEqual(self.report(*arguments, threads)["backend"], f"Threads: {threads}")

    def test_too_many_threads(self):
        path = write_mesh(random_insertion(5000), self.path("in.vtk"))
        arguments = (path, "out.vtk", "--backend", "threads", "--threads")
        backend = self.report(*arguments, 65536)["backend"]
        self.assertLessEqual(int(backend.split()[1]), max(16, 2 * os.cpu_count()))
        with open(self.path("out.vtk"), "rb") as file:
            expected = file.read()
        for megabytes in (200, 250, 300, 350, 400, 500, 800):  # with room for a few of their stacks
            limit = megabytes << 20
            result = self.run_command(
                *arguments, "2000",
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            if result.returncode == 0:
                with open(self.path("out.vtk"), "rb") as file:
                    self.assertEqual(file.read(), expected)
            else:
                self.assertEqual(result.returncode, 3)
                self.assertIn("not enough memory", result.stderr)
        self.assertEqual(result.returncode, 0)  # 800 MiB are enough


if __name__ == "__main__":
    unittest.main(verbosity=2)

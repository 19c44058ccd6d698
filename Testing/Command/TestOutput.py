# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the command prints."""

import unittest

from CommandTesting import CommandTest, bumpy_grid, make_mesh, worst_case, write_mesh

NOTE = "note: a height field; --geometry planar-xy treats it as terrain"


class Summary(CommandTest):
    def test_numbers(self):
        text = self.succeed(write_mesh(worst_case(4), self.path("in.vtk")), "out.vtk").stdout
        for words in (
            "8 points, 6 triangles, 13 edges (8 fixed), planar",
            "violations      1 -> 0",
            "9 in 5 iterations, converged",
            "wrote           out.vtk",
        ):
            self.assertIn(words, text)
        self.assertRegex(text, r"smallest angle  [\d.]+ -> [\d.]+ degrees")
        self.assertRegex(text, r"time            read [\d.]+ s, edges [\d.]+ s, flips [\d.]+ s")
        self.assertLessEqual(len(text.splitlines()), 7)

    def test_thousands(self):
        text = self.succeed(write_mesh(bumpy_grid(40, 0), self.path("in.vtk")), "out.vtk").stdout
        self.assertIn("1,600 points, 3,042 triangles", text)

    def test_no_triangles(self):
        mesh = make_mesh([(0, 0, 0)], [])
        text = self.succeed(write_mesh(mesh, self.path("in.vtk")), "out.vtk").stdout
        self.assertIn("1 point, 0 triangles, 0 edges", text)


class Messages(CommandTest):
    def test_height_field(self):
        path = write_mesh(bumpy_grid(6, 1), self.path("in.vtk"))
        self.assertEqual(self.succeed(path, "out.vtk").stderr.splitlines(), [NOTE])
        for geometry in ("surface", "planar-xy"):
            self.assertEqual(self.succeed(path, "out.vtk", "--geometry", geometry).stderr, "")

    def test_no_height_field(self):
        """A closed surface, a part of it, a floor with a wall that is edge-on, and a plane."""
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        for mesh in (
            make_mesh(points, faces),
            make_mesh(points, faces[:2]),
            make_mesh(points + [(-1, 0, 0)], [(0, 1, 2), (0, 2, 3), (0, 2, 4)]),
            bumpy_grid(5, 0),
        ):
            text = self.succeed(write_mesh(mesh, self.path("in.vtk")), "out.vtk").stderr
            self.assertNotIn("height field", text)

    def test_warnings_are_single_lines(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 2), (0, 0, 1)])
        result = self.succeed(write_mesh(mesh, self.path("in.vtk")), "out.vtk", "--quiet")
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("warning: "))
        self.assertNotIn("0x", lines[0])


if __name__ == "__main__":
    unittest.main(verbosity=2)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the command prints."""

import re
import unittest

from CommandTesting import (
    CommandTest,
    bumpy_grid,
    make_mesh,
    points_of,
    read_mesh,
    triangles_of,
    worst_case,
    write_mesh,
)


def turns_of(mesh):
    """Twice the signed area of each triangle in x and y; negative if it turns right."""
    points = points_of(mesh)
    for triangle in triangles_of(mesh):
        (ax, ay, _), (bx, by, _), (cx, cy, _) = (points[i] for i in triangle)
        yield (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)



class Summary(CommandTest):
    def test_numbers(self):
        text = self.succeed(write_mesh(worst_case(4), self.path("in.vtk")), "out.vtk").stdout
        for words in (
            "8 points, 6 triangles, 13 edges (8 fixed)\n",
            "geometry        planar: all points lie in one plane; the feature angle has no effect\n",
            "bad edges       1 -> 0",
            "9 in 5 iterations, converged",
            "wrote           out.vtk",
        ):
            self.assertIn(words, text)
        self.assertRegex(text, r"smallest angle  [\d.]+ -> [\d.]+ degrees")
        self.assertRegex(text, r"time            read [\d.]+ s, edges [\d.]+ s, flips [\d.]+ s")
        self.assertLessEqual(len(text.splitlines()), 8)

    def test_why_edges_are_left(self):
        """A tetrahedron, in which every flip would duplicate an edge, beside a folded sheet."""
        points = [(-2, 0, 0), (2, 0, 0), (0, -1, 0.1), (0, 1, 0.1),
                  (-4, 9, 0), (4, 9, 0), (-3, 11, 0), (3, 12, 1)]
        triangles = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2), (6, 4, 5), (7, 5, 4)]
        text = self.succeed(
            write_mesh(make_mesh(points, triangles), self.path("in.vtk")), "out.vtk",
            "--geometry", "surface", "--feature-angle", 180).stdout
        self.assertIn("bad edges       2 -> 2 (2 blocked: 1 would duplicate an edge, "
                      "1 would fold)\n", text)

    def test_thousands(self):
        text = self.succeed(write_mesh(bumpy_grid(40, 0), self.path("in.vtk")), "out.vtk").stdout
        self.assertIn("1,600 points, 3,042 triangles", text)

    def test_no_triangles(self):
        mesh = make_mesh([(0, 0, 0)], [])
        text = self.succeed(write_mesh(mesh, self.path("in.vtk")), "out.vtk").stdout
        self.assertIn("1 point, 0 triangles, 0 edges", text)


class Messages(CommandTest):
    def test_steep_height_field(self):
        """The summary gives a hint, and a warning counts triangles that flips have turned over."""
        path = write_mesh(bumpy_grid(20, 20), self.path("in.vtk"))
        result = self.succeed(path, "out.vtk")
        self.assertIn("% of its area slopes below 45 degrees; if it is terrain", result.stdout)
        turned = sum(turn < 0 for turn in turns_of(read_mesh(self.path("out.vtk"))))
        self.assertGreater(turned, 0)
        self.assertRegex(
            result.stderr, rf"^warning: {turned} triangles that flips in space have turned over"
        )
        self.assertEqual(self.succeed(path, "out.vtk", "--geometry", "planar-xy").stderr, "")

    def test_control_characters_are_escaped(self):
        for name in ("no\x1b[31mred\n.vtk", "tab\t.xyz", "x\x7f.vtp"):
            text = self.run_command(name, "out.vtk").stderr
            escaped = "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in name)
            self.assertRegex(text, rf"^error: {re.escape(escaped)}: .*\n$")
        name = write_mesh(worst_case(4), self.path("o\x1b.vtk"))
        self.assertIn("o\\x1b.vtk\n", self.succeed(name, name).stdout)

    def test_warnings_are_single_lines(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 2), (0, 0, 1)])
        result = self.succeed(write_mesh(mesh, self.path("in.vtk")), "out.vtk", "--quiet")
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("warning: "))
        self.assertNotIn("0x", lines[0])


if __name__ == "__main__":
    unittest.main(verbosity=2)

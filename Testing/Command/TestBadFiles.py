# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Truncated or corrupt input gives an exit code and a one-line explanation, never a crash or part
of a mesh."""

import struct

from CommandTesting import BadFileTest, bumpy_grid, make_mesh

GRID = 4
TRIANGLES = 2 * (GRID - 1) ** 2


class Truncated(BadFileTest):
    """The fuzzer of files truncates those of all formats, too."""

    def test_obj(self):
        """The format has no end mark, so only truncation within a line can be noticed."""
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1")
        self.refuse("a.obj", "line 3", "number is missing")
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2")
        self.refuse("a.obj", "line 4", "3 corners")

    def test_empty(self):
        for name in ("a.vtk", "a.vtp", "a.ply", "a.stl", "a.obj"):
            self.write(name, b"")
            self.refuse(name)
        for name, text in (("a.obj", "# nothing\n"), ("a.stl", "solid a\nendsolid a\n"),
                           ("a.stl", bytes(84))):
            self.write(name, text)
            self.refuse(name, "is empty")


class Corrupt(BadFileTest):
    def test_stl_count(self):
        good = self.content(self.write_mesh(bumpy_grid(GRID, 0), "a.stl"))
        for count in (TRIANGLES - 1, TRIANGLES + 1, 0, 2**32 - 1):
            self.write("a.stl", good[:80] + struct.pack("<I", count) + good[84:])
            self.refuse("a.stl", f"{count} triangles", f"{len(good)}")

    def test_obj_indices(self):
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        for face in ("1 2 4", "0 1 2", "1 2 -4", "1 2 x", "1/x 2 3", "1 2 /"):
            self.write("a.obj", f"{points}f {face}\n")
            self.refuse("a.obj", "line 4", "index")
        self.write("a.obj", f"{points}f 1 2 3\nl 1 9\n")
        self.refuse("a.obj", "line 5", "index 9 of a vertex (v) is out of range: there are 3")


class OtherData(BadFileTest):

    def test_nothing_at_all(self):
        self.write_mesh(make_mesh([], []), "none.vtk")
        for extension in (".vtk", ".vtp", ".ply", ".stl", ".obj"):
            self.succeed("none.vtk", "out" + extension)
            if extension in (".stl", ".obj"):
                self.fail_with(3, "out" + extension, "again.vtk", naming=["is empty"])
                continue
            self.succeed("out" + extension, "again.vtk")
            self.assertEqual(self.read_mesh("again.vtk").GetNumberOfPoints(), 0)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Truncated or corrupt input gives an exit code and a one-line explanation, never a crash or part
of a mesh."""

import os
import struct

from CommandTesting import BadFileTest, bumpy_grid, make_mesh, read_mesh, triangles_of, write_mesh

GRID = 4
TRIANGLES = 2 * (GRID - 1) ** 2


class Truncated(BadFileTest):
    def cut(self, name, keep_from=0, **settings):
        """Truncates a file at every fortieth of its length. It must be refused, or read completely
        if only the end mark or the last blank is missing."""
        whole = self.content(write_mesh(bumpy_grid(GRID, 0), self.path(name), **settings))
        refused = 0
        for length in range(keep_from, len(whole), max(1, len(whole) // 40)):
            self.write("cut-" + name, whole[:length])
            result = self.run_command("cut-" + name, "out.stl")
            self.assertIn(result.returncode, (0, 3), f"{length} bytes: {result.stderr}")
            if result.returncode == 0:
                count = len(triangles_of(read_mesh(self.path("out.stl"))))
                self.assertEqual(count, TRIANGLES, f"{name}: {length} of {len(whole)} bytes")
                os.remove(self.path("out.stl"))
            else:
                refused += 1
                self.assertRegex(result.stderr, rf"^error: cut-{name}: .*\n$")
                self.assertFalse(os.path.exists(self.path("out.stl")))
        self.assertGreater(refused, 30)
        self.succeed(name, "whole.stl")

    def test_vtk(self):
        self.cut("a.vtk")
        self.cut("b.vtk", SetFileVersion=(42,))

    def test_vtp(self):
        self.cut("a.vtp")
        self.cut("b.vtp", SetDataModeToAscii=())

    def test_ply(self):
        self.cut("a.ply")
        self.cut("b.ply", SetFileTypeToASCII=())

    def test_stl(self):
        self.cut("a.stl")
        self.cut("b.stl", SetFileTypeToASCII=())

    def test_obj(self):
        """The format has no end mark, so only truncation within a line can be noticed."""
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1")
        self.refuse("a.obj", "line 3", "number is missing")
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2")
        self.refuse("a.obj", "line 4", "3 corners")

    def test_empty(self):
        for name in ("a.vtk", "a.vtp", "a.ply", "a.stl"):
            self.write(name, b"")
            self.refuse(name)


class Corrupt(BadFileTest):
    def test_stl_count(self):
        good = self.content(write_mesh(bumpy_grid(GRID, 0), self.path("a.stl")))
        for count in (TRIANGLES - 1, TRIANGLES + 1, 0, 2**32 - 1):
            self.write("a.stl", good[:80] + struct.pack("<I", count) + good[84:])
            self.refuse("a.stl", f"{count} triangles", f"{len(good)}")

    def test_obj_indices(self):
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        for face in ("1 2 4", "0 1 2", "1 2 -4", "1 2 x", "1/1 2/1 3/1", "1//1 2//1 3//1", "1 2 /"):
            self.write("a.obj", f"{points}f {face}\n")
            self.refuse("a.obj", "line 4", "index")
        self.write("a.obj", f"{points}f 1 2 3\nl 1 9\n")
        self.refuse("a.obj", "line 5", "9 is out of range")


class OtherData(BadFileTest):

    def test_nothing_at_all(self):
        write_mesh(make_mesh([], []), self.path("none.vtk"))
        for extension in (".vtk", ".vtp", ".ply", ".stl", ".obj"):
            self.succeed("none.vtk", "out" + extension)
            self.succeed("out" + extension, "again.vtk")
            self.assertEqual(read_mesh(self.path("again.vtk")).GetNumberOfPoints(), 0)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Truncated or corrupt input gives an exit code and a one-line explanation, never a crash or part
of a mesh."""

import os
import random
import struct
import unittest

from CommandTesting import CommandTest, bumpy_grid, make_mesh, read_mesh, triangles_of, write_mesh

GRID = 4
TRIANGLES = 2 * (GRID - 1) ** 2


class BadFileTest(CommandTest):
    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return name

    def refuse(self, name, *naming):
        """Expects exit code 3, one line about the file and the reason, and no output."""
        before = sorted(os.listdir(self.folder))
        result = self.fail_with(3, name, "out.vtk", naming=[name, *naming])
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)


class Truncated(BadFileTest):
    def cut(self, name, keep_from=0, **settings):
        """Truncates a file at every fortieth of its length. It must be refused, or read completely
        if only the end mark or the last blank is missing."""
        path = write_mesh(bumpy_grid(GRID, 0), self.path(name), **settings)
        with open(path, "rb") as file:
            whole = file.read()
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
        self.refuse("a.obj", "line 3", "three coordinates")
        self.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2")
        self.refuse("a.obj", "line 4", "3 corners")

    def test_empty(self):
        for name in ("a.vtk", "a.vtp", "a.ply", "a.stl"):
            self.write(name, b"")
            self.refuse(name)


class Corrupt(BadFileTest):
    def bytes_of(self, name):
        write_mesh(bumpy_grid(GRID, 0), self.path(name))
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_noise(self):
        noise = random.Random(1).randbytes(5000)
        for name in ("a.vtk", "a.vtp", "a.ply", "a.stl"):
            self.write(name, noise)
            self.refuse(name)

    def test_wrong_format(self):
        vtk = self.bytes_of("good.vtk")
        for name in ("a.vtp", "a.ply", "a.stl"):
            self.write(name, vtk)
            self.refuse(name)

    def test_stl_count(self):
        good = self.bytes_of("a.stl")
        for count in (TRIANGLES - 1, TRIANGLES + 1, 0, 2**32 - 1):
            self.write("a.stl", good[:80] + struct.pack("<I", count) + good[84:])
            self.refuse("a.stl", f"{count} triangles", f"{len(good)}")

    def test_ply_count(self):
        good = self.bytes_of("a.ply")
        for old, new in (
            (b"vertex 16", b"vertex 4000000000"),
            (b"vertex 16", b"vertex -1"),
            (b"face 18", b"face 4000000000"),
            (b"face 18", b"face 19"),
        ):
            self.assertIn(old, good)
            self.write("a.ply", good.replace(old, new))
            self.refuse("a.ply")

    def test_vtk_count(self):
        good = self.bytes_of("a.vtk")
        for old, new in (
            (b"POINTS 16", b"POINTS 17"),
            (b"POINTS 16", b"POINTS 99999999999"),
            (b"POLYGONS 19 54", b"POLYGONS 20 54"),
            (b"POLYGONS 19 54", b"POLYGONS 19 55"),
        ):
            self.assertIn(old, good)
            self.write("a.vtk", good.replace(old, new))
            self.refuse("a.vtk")

    def test_obj_indices(self):
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        for face in ("1 2 4", "0 1 2", "1 2 -4", "1 2 x", "1/1 2/1 3/1", "1//1 2//1 3//1", "1 2 /"):
            self.write("a.obj", f"{points}f {face}\n")
            self.refuse("a.obj", "line 4", "index")
        self.write("a.obj", f"{points}f 1 2 3\nl 1 9\n")
        self.refuse("a.obj", "line 5", "9 is out of range")

    def test_point_ids(self):
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
        for name in ("a.vtk", "a.vtp", "a.ply"):
            for bad in (3, -1):
                write_mesh(make_mesh(points, [(0, 1, bad)]), self.path(name))
                self.refuse(name, str(bad))


class LostByVtk(BadFileTest):
    """VTK's readers give up a part of these, or all, and report nothing."""

    def test_more_sections_than_one_of_a_vtk(self):
        head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
        for section in ("POLYGONS", "LINES", "VERTICES", "TRIANGLE_STRIPS"):
            self.write("a.vtk", head + 2 * f"{section} 1 4\n3 0 1 2\n")
            self.refuse("a.vtk", section, "2", "1")
        self.write("a.vtk", head + "POLYGONS 1 4\n3 0 1 2\nPOLYGONS 0 0\n")
        self.refuse("a.vtk", "POLYGONS", "1", "0")

    def damaged(self):
        """Damaged files, each with the attribute of Piece that shows it."""
        path = write_mesh(bumpy_grid(GRID, 0), self.path("good.vtp"), SetDataModeToAscii=())
        with open(path, encoding="ascii") as file:
            good = file.read()
        words = '<FieldData><Array type="String" Name="w" format="ascii" {}>104 101 abc 0</Array></FieldData>'
        field = "<PolyData>\n" + words.format('NumberOfTuples="1"')
        yield "NumberOfPoints", good.replace("<PolyData>", field)
        yield "NumberOfPolys", good.replace('NumberOfPolys="18"', 'NumberOfPolys="19"')
        yield "NumberOfPolys", good.replace('NumberOfPolys="18"', 'NumberOfPolys="17"')
        yield "NumberOfPoints", good.replace('NumberOfPoints="16"', 'NumberOfPoints="17"')
        polys = good.index("<Polys>")
        for array in ("connectivity", "offsets"):
            begin = good.index(f'Name="{array}"', polys)
            begin = good.rindex("<DataArray", 0, begin)
            end = good.index("</DataArray>", begin) + len("</DataArray>")
            yield "NumberOfPolys", good[:begin] + good[end:]
            yield "NumberOfPolys", good.replace(good[begin:end], good[begin:end].replace(array, "x"))
        for kind, count in (("Points", 16), ("Polys", 18)):
            yield f"NumberOf{kind}", good.replace(f' NumberOf{kind}="{count}"', "")
        for kind in ("Lines", "Verts", "Strips"):
            yield f"NumberOf{kind}", good.replace(f'NumberOf{kind}="0"', f'NumberOf{kind}="2"')
        for mode in ("Binary", "Appended"):
            for compressor in ("None", "LZ4"):
                settings = {f"SetDataModeTo{mode}": (), f"SetCompressorTypeTo{compressor}": ()}
                write_mesh(bumpy_grid(GRID, 0), self.path("good.vtp"), **settings)
                with open(path, encoding="latin-1") as file:
                    binary = file.read()
                for kind, count in (("Polys", 18), ("Points", 16)):
                    for wrong in (count - 1, count + 1):
                        old, new = (f'NumberOf{kind}="{n}"' for n in (count, wrong))
                        self.assertIn(old, binary)
                        yield f"NumberOf{kind}", binary.replace(old, new)

    def test_is_refused(self):
        for attribute, content in self.damaged():
            with self.subTest(attribute):
                before = content.encode("latin-1")
                self.write("mesh.vtp", before)
                self.refuse("mesh.vtp")
                self.fail_with(3, "mesh.vtp", "mesh.vtp", naming=["mesh.vtp"])
                with open(self.path("mesh.vtp"), "rb") as file:
                    self.assertEqual(file.read(), before)
                good = write_mesh(bumpy_grid(GRID, 0), self.path("in.vtk"))
                self.fail_with(3, good, "out.vtk", "--constraints", "mesh.vtp", naming=["mesh.vtp"])


class OtherData(BadFileTest):
    def test_other_legacy_type(self):
        self.write(
            "grid.vtk",
            "# vtk DataFile Version 3.0\ngrid\nASCII\nDATASET UNSTRUCTURED_GRID\n"
            "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n",
        )
        self.refuse("grid.vtk", "UNSTRUCTURED_GRID", "Extract Surface")

    def test_other_xml_type(self):
        self.write(
            "grid.vtp",
            '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1">\n'
            "<UnstructuredGrid/>\n</VTKFile>\n",
        )
        self.refuse("grid.vtp", "UnstructuredGrid", "Extract Surface")

    def test_newer_version(self):
        """Only a warning, since the file may be readable."""
        write_mesh(bumpy_grid(GRID, 0), self.path("a.vtk"), SetFileTypeToASCII=())
        with open(self.path("a.vtk"), encoding="ascii") as file:
            text = file.read()
        self.assertIn("Version 5.1", text)
        self.write("a.vtk", text.replace("Version 5.1", "Version 6.7"))
        self.assertRegex(self.succeed("a.vtk", "out.vtk").stderr, r"^warning: .*6\.7.*\n$")

    def test_no_triangles(self):
        """An input without triangles is not an error."""
        write_mesh(make_mesh([(0, 0, 0), (1, 0, 0)], []), self.path("points.vtk"))
        for extension in (".vtk", ".vtp", ".ply", ".obj"):
            result = self.succeed("points.vtk", "out" + extension)
            self.assertIn("note: points.vtk: contains no triangles", result.stderr)
            self.assertEqual(read_mesh(self.path("out" + extension)).GetNumberOfPoints(), 2)

    def test_nothing_at_all(self):
        write_mesh(make_mesh([], []), self.path("none.vtk"))
        for extension in (".vtk", ".vtp", ".ply", ".stl", ".obj"):
            self.succeed("none.vtk", "out" + extension)
            self.succeed("out" + extension, "again.vtk")
            self.assertEqual(read_mesh(self.path("again.vtk")).GetNumberOfPoints(), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)

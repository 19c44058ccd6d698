# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a .obj contains besides points and faces: what is kept, and what is named."""

from CommandTesting import (
    ArrayTest, bumpy_grid, cells_of, make_values, points_of, triangles_of, tuples_of, values_of)

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
TEXTURE = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 1 1\n"
NORMALS = "vn 0 0 1\nvn 0 1 1\nvn 0 0 1\n"


class Obj(ArrayTest):
    def test_texture_and_normals_of_points(self):
        mesh, said = self.read(
            "a.obj",
            SQUARE + TEXTURE + NORMALS + "f 1/1/1 2/2/2 3/3/1\nf 1/1/3 3/5/3 4/4/2 # comment\n")
        data = mesh.GetPointData()
        self.assertEqual(said, "")
        self.assertEqual(tuples_of(data.GetTCoords()), [(0, 0), (1, 0), (1, 1), (0, 1)])
        self.assertEqual(tuples_of(data.GetNormals()), [(0, 0, 1), (0, 1, 1), (0, 0, 1), (0, 1, 1)])

    def test_what_is_left_out_is_named(self):
        for text, said in (
            ("f 1 2 3\nvp 1\ncurv 0 1 1 2\nvp 2\n", "curv (1), vp (2)"),
            ("mtllib a b.mtl\nf 1 2 3\ns 1\nf 1 3 4\ns off\n", "mtllib (1), s (2)"),
            (TEXTURE + "f 1/1 2/2 3/3\nf 1/2 3/3 4/4\n", "vt (5)"),  # a seam at point 1
            (TEXTURE + "f 1/1 2/2 3\n", "vt (5)"),
            (NORMALS + "f 1//1 2//2 3//1\nf 1//2 3//3 4//2\n", "vn (3)"),
            ("v 9 9 9 .1 .2 .3\nf 1 2 3\n", "colors (1)"),
            ("v 9 9 9 .5\nf 1 2 3\n", "weights (1)"),
            ("vt 0 0 .5\nf 1/1 2/1 3/1\n", "third coordinates of vt (1)"),
        ):
            mesh, found = self.read("a.obj", SQUARE + text)
            self.assertEqual(found, f"warning: a.obj: left out {said}\n")
            if "third" not in said:
                self.assertEqual(mesh.GetPointData().GetNumberOfArrays(), 0)
            self.assertIn((0, 1, 2), triangles_of(mesh))
        self.assertIn("warning: a.obj: left out vn (3)\n", self.read("a.obj", SQUARE + NORMALS)[1])

    def test_labels_of_faces(self):
        """Two coplanar triangles of different materials, with a bad edge."""
        text = ("v 0 0 0\nv 4 0 0\nv 2 1 0\nv 2 -1 0\nf 1 2 3\nl 1 2\no a b\nusemtl red\n"
                "g one two\nf 1 2 3\nusemtl blue\nf 2 1 4\nusemtl red\nl 1 3\n")
        self.write("in.obj", text)
        note = ("its faces have labels (Material, Group, Object); --region-array Material keeps the "
                "edges between them")
        self.assertIn("note: in.obj: " + note, self.succeed("in.obj", "flipped.vtp").stderr)
        for name in ("out.vtp", "out.vtk", "out.obj"):
            said = self.succeed("in.obj", name, "--region-array", "Material").stderr
            self.assertEqual(said.count("note:"), 0, said)
            self.succeed(name, "again.vtp", "--region-array", "Material")
            mesh = self.read_mesh("again.vtp")
            for array, labels in (("Material", ("", "red", "", "red", "blue")),
                                  ("Group", ("", "one two", "", "one two", "one two")),
                                  ("Object", ("", "a b", "", "a b", "a b"))):
                texts = mesh.GetFieldData().GetAbstractArray(array + "Names")
                numbers = mesh.GetCellData().GetArray(array)
                found = [texts.GetValue(int(n)) for n in values_of(numbers)]
                self.assertEqual(tuple(found), labels, (name, array))
            self.assertIn((1, 0, 3), triangles_of(mesh))
        self.assertIn("cell data (Material", self.succeed("in.obj", "out.stl").stderr)
        self.write("one.obj", "usemtl red\n" + SQUARE + "f 1 2 3\nf 1 3 4\n")
        self.assertEqual(self.succeed("one.obj", "out.obj").stderr, "")
        self.assertIn("usemtl red\nf 1 2 3\nf ", self.content("out.obj").decode())
        self.write("line.obj", "usemtl red\n" + SQUARE + "f 1 2 3\nf 1 3 4\nusemtl blue\nl 1 2\n")
        self.assertEqual(self.succeed("line.obj", "out.obj").stderr, "")

    def test_names_with_marks_of_comments(self):
        """In names, as elsewhere in words, # begins no comment, for other programs neither."""
        text = ("mtllib a#b.mtl\n# comment\no a # b\ng #1 two\nv 0 0 0 # comment\nv 4 0 0\nv 2 1 0\nv 2 -1 0\n"
                "usemtl Material #1\nf 1 2 3 # comment\n  usemtl Material \\\n #2\nf 2 1 4\n#usemtl red\n")
        self.write("in.obj", text)
        for name in ("out.vtp", "out.obj"):
            said = self.succeed("in.obj", name, "--region-array", "Material").stderr
            self.assertEqual(said, "warning: in.obj: left out mtllib (1)\n")
            self.succeed(name, "again.vtp", "--region-array", "Material")
            mesh = self.read_mesh("again.vtp")
            self.assertEqual(triangles_of(mesh), [(0, 1, 2), (1, 0, 3)])
            for array, labels in (("Material", ["Material #1", "Material #2"]), ("Group", ["#1 two"] * 2),
                                  ("Object", ["a # b"] * 2)):
                texts = mesh.GetFieldData().GetAbstractArray(array + "Names")
                numbers = mesh.GetCellData().GetArray(array)
                self.assertEqual([texts.GetValue(int(n)) for n in values_of(numbers)], labels, (name, array))

    def test_comments_behind_names_continue_nothing(self):
        self.write("in.obj", SQUARE + "usemtl wood # from C:\\mats\\\nf 1 2 3\ng part # \\\nf 1 3 4\n")
        self.succeed("in.obj", "out.vtp")
        self.assertEqual(len(triangles_of(self.read_mesh("out.vtp"))), 2)

    def test_normals_and_texture_that_do_not_exist(self):
        for kind, element, faces in (
            ("vt", "texture coordinate (vt)", "f 1/1 2/1 3/7\nf 1/1 3/1 4/1\n"),
            ("vn", "normal (vn)", "f 1//1 2//1 3//7\nf 1//0 3//1 4//-9\n"),
            ("vn", "normal (vn)", "vt 0 0\nf 1/1/1 2/1/1 3/1/7\nf 1 3 4\n"),
        ):
            mesh, said = self.read("a.obj", SQUARE + f"{kind} 0 0 1\n" + faces)
            line = 7 if faces.startswith("vt") else 6
            self.assertIn(f"warning: a.obj: line {line}: index 7 of a {element} is out of range: there "
                          f"are 1; read without {kind}\n", said)
            self.assertEqual(said.count("is out of range"), 1)
            self.assertEqual(len(triangles_of(mesh)), 2)
            self.assertIsNone(mesh.GetPointData().GetNormals())
        self.assertIn("there are 0;", self.read("a.obj", SQUARE + "f 1//1 2//1 3//1\n")[1])

    def test_closed_surface_of_seams_stays_closed(self):
        """A tetrahedron of which every triangle has its own texture: its bad edge must not flip."""
        self.write("a.obj", "v -2 0 0\nv 2 0 0\nv 0 -1 .1\nv 0 1 .1\n"
                   + "".join(f"vt {i / 16} {i % 5 / 5}\n" for i in range(12))
                   + "f 1/1 3/2 2/3\nf 1/4 2/5 4/6\nf 2/7 3/8 4/9\nf 1/10 4/11 3/12\n")
        for name in ("out.obj", "out.ply", "out.vtp"):
            report = self.report("a.obj", name, "--geometry", "surface", "--feature-angle", 180)
            keys = ("points", "edges", "boundary_edges", "non_manifold_edges", "total_flips",
                    "non_delaunay_before", "non_delaunay_after", "blocked_by_edge")
            self.assertEqual([report[key] for key in keys], [4, 6, 0, 0, 0, 1, 1, 1])
            self.succeed(name, "again.vtp")
            self.assertEqual(
                {frozenset(cell) for cell in triangles_of(self.read_mesh("again.vtp"))},
                {frozenset(cell) for cell in ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3))})

    def test_comments_and_continued_lines(self):
        mesh, _ = self.read(
            "a.obj",
            "# v 9 9 9\\\nv 0 0 0 # here\nv 1 \\\n 0 0\n\tv 1 1 0\nv 0 1 0\nf 1 2 \\ \r\n 3 \\\n4\n"
        )
        self.assertEqual(points_of(mesh), [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
        self.assertEqual(len(triangles_of(mesh)), 2)

    def test_indices_of_later_vertices(self):
        mesh, _ = self.read("a.obj", "f 1 2 3\nl 1 2\n" + SQUARE + "f -4 -2 -1\n")
        self.assertEqual(triangles_of(mesh), [(0, 1, 2), (0, 2, 3)])
        self.assertEqual(cells_of(mesh.GetLines()), [(0, 1)])

    def test_what_is_wrong_is_on_its_line(self):
        for text, line in (
            ("v 0 0 0\n\x01\x02 1\n", 2), ("<html>\n", 1), ("v 1 2 3 4 5 6 7 8\n", 1),
            ("v 1 2 3 4 5\n", 1), ("v 1 2 3\nvn 1 2\n", 2),
        ):
            self.write("a.obj", text)
            self.refuse("a.obj", f"line {line}")

    def test_normals_texture_and_colors(self):
        self.write("in.obj",
            "v 0 0 0 .1 .2 .3\nv 1 0 0 1 0 .5\nv 1 1 0 0 0 0\nv 0 1 0 1 1 1\nv 5 5 5 0 0 1\n"
            "vt 0 0\nvt 1 .5\nvt .3333333333333333 1\nvn 0 0 1\nvn 0 .1 1\n"
            "f 1/1/1 2/2/2 3/3/1\nf 1/1/1 3/3/1 4/2/2\nl 1 2 3\np 5\n"
        )
        self.succeed("in.obj", "first.vtp")
        self.assertNotIn("cannot store", self.succeed("in.obj", "out.obj").stderr)
        self.succeed("out.obj", "second.vtp")
        first, out = (self.read_mesh(name) for name in ("first.vtp", "second.vtp"))
        self.assertEqual(points_of(first), points_of(out))
        for kind in ("GetVerts", "GetLines", "GetPolys"):
            self.assertEqual(cells_of(getattr(first, kind)()), cells_of(getattr(out, kind)()))
        data = out.GetPointData()
        for name in ("Normals", "TCoords", "Colors"):
            array = first.GetPointData().GetArray(name)
            self.assert_array(data.GetArray(name), array.GetClassName(), values_of(array))
        self.assertEqual(data.GetNormals().GetTuple(1), (0, 0.1, 1))
        self.assertEqual(data.GetTCoords().GetTuple(2), (1 / 3, 1))
        self.assertEqual(data.GetTCoords().GetTuple(4), (0, 0))  # of no polygon
        self.assertEqual(data.GetArray("Colors").GetTuple(0), (0.1, 0.2, 0.3))
        plain = self.read_mesh("out.obj")
        self.assertEqual(plain.GetNumberOfPolys(), 2)

    def test_colors_of_bytes(self):
        mesh = bumpy_grid(3, 0)
        colors = make_values("vtkUnsignedCharArray", "RGB", [(i, 0, 255) for i in range(9)])
        mesh.GetPointData().AddArray(colors)
        out = self.convert(mesh, "out.obj", "out.vtp")
        colors = out.GetPointData().GetArray("Colors")
        self.assertEqual(colors.GetTuple(3), (3 / 255, 0, 1))

    def test_bytes_that_are_no_colors(self):
        """Of bytes, only colors are fractions of 255."""
        self.write("in.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 unsigned_char\n"
                   "0 0 0 4 0 0 0 200 0\nPOLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\n"
                   "NORMALS n unsigned_char\n0 0 1 0 0 1 0 3 1\nTEXTURE_COORDINATES t 2 unsigned_char\n0 0 1 0 0 2\n")
        self.succeed("in.vtk", "out.obj")
        lines = self.content("out.obj").decode().splitlines()
        for line in ("v 4 0 0", "v 0 200 0", "vn 0 3 1", "vt 0 2"):
            self.assertIn(line, lines)

    def test_arrays_of_too_few_tuples(self):
        mesh = bumpy_grid(3, 0)
        for kind, name in (("Double", "Colors"), ("UnsignedChar", "RGB")):
            mesh.GetPointData().AddArray(make_values(f"vtk{kind}Array", name, [(9, 9, 9)] * 2))
        source = self.write_mesh(mesh, "in.vtk")
        self.assertIn("point data (Colors, RGB)", self.succeed(source, "out.obj").stderr)
        with open(self.path("out.obj"), encoding="ascii") as file:
            words = [line.split() for line in file if line[0] != "#"]
        self.assertEqual({(line[0], len(line)) for line in words}, {("v", 4), ("f", 4)})

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a .obj contains besides points and faces."""

import math
import unittest

from CommandTesting import cells_of, points_of, read_mesh, triangles_of
from TestBadFiles import BadFileTest

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def tuples_of(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def strings_of(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


class ObjTest(BadFileTest):
    def read(self, text):
        """The mesh of a file with this text, and the messages."""
        self.write("a.obj", text)
        result = self.succeed("a.obj", "out.vtp")
        return read_mesh(self.path("out.vtp")), result.stderr


class Texture(ObjTest):
    def test_without_seams(self):
        mesh, _ = self.read(
            SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 1 1 0\nf 1/1 2/2 3/3\nf 1/1 3/5 4/4\n"
        )
        self.assertEqual(mesh.GetNumberOfPoints(), 4)
        expected = [(0, 0), (1, 0), (1, 1), (0, 1)]
        self.assertEqual(tuples_of(mesh.GetPointData().GetTCoords()), expected)

    def test_of_seams_is_left_out(self):
        """Two triangles whose common edge flips, although it is a seam."""
        points = "v 0 0 0\nv 4 0 0\nv 2 1 0\nv 2 -1 0\nv 9 9 0\n"
        texture = "vt 0 0\nvt .5 0\nvt .25 .1\nvt .5 1\nvt 1 1\nvt .75 .9\n"
        for faces, textured in (("f 1/1 2/2 3/3\nf 2/5 1/4 4/6\n", 2), ("f 1/1 2/2 3/3\nf 2/2 1/4 4/6\n", 1)):
            seam, said = self.read(points + texture + faces)
            self.assertRegex(said, f"^warning: a.obj: left out its texture coordinates: {textured} point")
            self.assertIsNone(seam.GetPointData().GetTCoords())
            self.assertEqual(seam.GetNumberOfPoints(), 5)
            self.assertEqual(sorted(map(sorted, triangles_of(seam))), [[0, 2, 3], [1, 2, 3]])
        whole, said = self.read(points + texture + "f 1/1 2/2 3/3\nf 2/2 1/1 4/6\n")
        self.assertEqual(said, "")
        self.assertEqual(sorted(map(sorted, triangles_of(whole))), [[0, 2, 3], [1, 2, 3]])
        self.assertTrue(math.isnan(whole.GetPointData().GetTCoords().GetTuple(4)[0]), "unused")

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
                {frozenset(cell) for cell in triangles_of(read_mesh(self.path("again.vtp")))},
                {frozenset(cell) for cell in ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3))})

    def test_is_written_whatever_the_materials(self):
        text = "mtllib m.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n" + SQUARE
        self.write("a.obj", text + "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n")
        for name in ("out.obj", "out.ply"):
            self.succeed("a.obj", name)
            self.succeed(name, "again.vtp")
            coordinates = read_mesh(self.path("again.vtp")).GetPointData().GetTCoords()
            self.assertEqual(tuples_of(coordinates), [(0, 0), (1, 0), (1, 1), (0, 1)], name)

    def test_three_components(self):
        mesh, _ = self.read(SQUARE + "vt 0 0 0\nvt 1 0 .5\nvt 1\nf 1/1 2/2 3/3\n")
        coordinates = tuples_of(mesh.GetPointData().GetTCoords())[:3]
        self.assertEqual(coordinates, [(0, 0, 0), (1, 0, 0.5), (1, 0, 0)])


class Normals(ObjTest):
    def test_of_points(self):
        mesh, _ = self.read(
            SQUARE + "vn 0 0 1\nvn 0 1 1\nvn 0 0 1\nf 1//1 2//2 3//1\nf 1//3 3//3 4//2\n"
        )
        expected = [(0, 0, 1), (0, 1, 1), (0, 0, 1), (0, 1, 1)]
        self.assertEqual(tuples_of(mesh.GetPointData().GetNormals()), expected)

    def test_of_faces(self):
        mesh, _ = self.read(
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -1\nvn 0 -1 0\n"
            "f 1//1 3//1 2//1\nf 1//2 2//2 4//2\n"
        )
        self.assertIsNone(mesh.GetPointData().GetNormals())
        self.assertEqual(tuples_of(mesh.GetCellData().GetNormals()), [(0, 0, -1), (0, -1, 0)])

    def test_of_neither_are_left_out_with_a_note(self):
        mesh, said = self.read(
            SQUARE + "vn 0 0 1\nvn 0 1 1\nvn 1 0 1\nf 1//1 2//2 3//1\nf 1//3 3//3 4//2\n"
        )
        self.assertIn("a.obj: ignored its normals", said)
        self.assertIsNone(mesh.GetPointData().GetNormals())
        self.assertEqual(mesh.GetNumberOfPoints(), 4)

    def test_mixed_forms(self):
        mesh, _ = self.read(
            SQUARE + "vt 0 0\nvt 1 0\nvn 0 0 1\nf 1//1 2/2 3\nf 1/1/1 3//1 4 # comment\n"
        )
        self.assertEqual(triangles_of(mesh), [(0, 1, 2), (0, 2, 3)])
        coordinates = tuples_of(mesh.GetPointData().GetTCoords())
        self.assertEqual(coordinates[:2], [(0, 0), (1, 0)])
        self.assertTrue(math.isnan(coordinates[2][0]))
        self.assertEqual(tuples_of(mesh.GetPointData().GetNormals())[2], (0, 0, 1))


class Labels(ObjTest):
    def test_materials_groups_and_objects(self):
        mesh, _ = self.read(
            "mtllib a b.mtl\n" + SQUARE + "f 1 2 3\nl 1 2\nusemtl red paint\no thing\n"
            "g one two\nf 1 3 4\nusemtl blue\nf 2 1 3\np 4\nusemtl red paint\ns off\nf 3 2 1\n"
        )
        data, field = mesh.GetCellData(), mesh.GetFieldData()
        # In VTK's order: the vert, the line, the faces.
        for name, ids in {
            "MaterialIds": [1, -1, -1, 0, 1, 0],
            "ObjectIds": [0, -1, -1, 0, 0, 0],
            "GroupIds": [0, -1, -1, 0, 0, 0],
            "SmoothingIds": [-1, -1, -1, -1, -1, 0],
        }.items():
            self.assertEqual([int(i) for (i,) in tuples_of(data.GetArray(name))], ids, name)
        for name, names in {
            "MaterialLibraries": ["a b.mtl"],
            "MaterialNames": ["red paint", "blue"],
            "ObjectNames": ["thing"],
            "GroupNames": ["one two"],
            "SmoothingNames": ["off"],
        }.items():
            self.assertEqual(strings_of(field.GetAbstractArray(name)), names)

    def test_none(self):
        mesh, said = self.read(SQUARE + "f 1 2 3 4\n")
        self.assertEqual(said, "")
        self.assertEqual(mesh.GetCellData().GetNumberOfArrays(), 0)

    def test_colors_of_vertices(self):
        mesh, _ = self.read("v 0 0 0 .1 .2 .3\nv 1 0 0 1 0 .5 1\nv 0 1 0\nf 1 2 3\n")
        colors = tuples_of(mesh.GetPointData().GetArray("Colors"))
        self.assertEqual(colors[:2], [(0.1, 0.2, 0.3), (0, 0.5, 1)])
        self.assertTrue(math.isnan(colors[2][0]))


class Lines(ObjTest):
    def test_comments_and_continued_lines(self):
        mesh, _ = self.read(
            "# v 9 9 9\\\nv 0 0 0 # here\nv 1 \\\n 0 0\n\tv 1 1 0\nv 0 1 0\nf 1 2 \\ \r\n 3 \\\n4\n"
        )
        self.assertEqual(points_of(mesh), [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
        self.assertEqual(len(triangles_of(mesh)), 2)

    def test_indices_of_later_vertices(self):
        mesh, _ = self.read("f 1 2 3\nl 1 2\n" + SQUARE + "f -4 -2 -1\n")
        self.assertEqual(triangles_of(mesh), [(0, 1, 2), (0, 2, 3)])
        self.assertEqual(cells_of(mesh.GetLines()), [(0, 1)])

    def test_what_is_left_out_is_named(self):
        _, said = self.read(SQUARE + "f 1 2 3\nvp 1\ncurv 0 1 1 2\nvp 2\n")
        self.assertIn("a.obj: ignored the lines with these keywords: curv (1), vp (2)", said)

    def test_what_is_no_obj(self):
        for text, line in (("v 0 0 0\n\x01\x02 1\n", 2), ("<html>\n", 1)):
            self.write("a.obj", text)
            self.refuse("a.obj", f"line {line}")

    def test_too_many_numbers(self):
        self.write("a.obj", "v 1 2 3 4 5 6 7 8\n")
        self.refuse("a.obj", "line 1", "more than seven")


if __name__ == "__main__":
    unittest.main(verbosity=2)

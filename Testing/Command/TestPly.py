# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every element and property of a .ply: read as text and binary of both byte orders, and written."""

import math
import struct

from CommandTesting import (
    ArrayTest, BadFileTest, bumpy_grid, cells_of, make_mesh, make_values, points_of, triangles_of,
    tuples_of, values_of)

CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
         "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
         "int32": "i", "uint32": "I", "float32": "f", "float64": "d",
         "int64": "q", "uint64": "Q"}  # fmt: skip
XYZ = ["float x", "float y", "float z"]
INDICES = ["list uchar int vertex_indices"]
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
ENCODINGS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


def make_ply(encoding, *elements):
    """A file of elements (name, properties, rows); a row has a list for each list property."""
    head = ["ply", f"format {encoding} 1.0", "comment made for a test"]
    body = b""
    for name, properties, rows in elements:
        head.append(f"element {name} {len(rows)}")
        head += [f"property {text}" for text in properties]
        for row in rows:
            body += pack(ENCODINGS[encoding], properties, row)
    return "\n".join(head + ["end_header", ""]).encode() + body


def pack(order, properties, row):
    values = []  # (type, value)
    for text, value in zip(properties, row):
        words = text.split()
        if words[0] == "list":
            values.append((words[1], len(value)))
            values += [(words[2], item) for item in value]
        else:
            values.append((words[0], value))
    if not order:
        return " ".join(repr(value) for _, value in values).encode() + b"\n"
    return b"".join(struct.pack(order + CODES[kind], value) for kind, value in values)


class PlyTest(BadFileTest):
    def read_all(self, *elements):
        """Yields the mesh read from each encoding, and the messages."""
        for encoding in ENCODINGS:
            yield self.read("a.ply", make_ply(encoding, *elements))

    def refuse_all(self, elements, *naming):
        for encoding in ENCODINGS:
            self.write("a.ply", make_ply(encoding, *elements))
            self.refuse("a.ply", *naming)


class Elements(PlyTest):
    def test_faces_and_edges(self):
        for mesh, said in self.read_all(
            ("edge", ["int64 vertex1", "char vertex2", "uchar red"], [(0, 1, 9), (2, 3, 9)]),
            ("vertex", XYZ, SQUARE),
            ("face", INDICES + ["short mark", "list char float uv"], [([0, 1, 2], -7, [0.5])]),
            ("camera", ["float view", "double far"], [(1, 2)]),
        ):
            self.assertEqual(triangles_of(mesh), [(0, 1, 2)])
            self.assertEqual(cells_of(mesh.GetLines()), [(0, 1), (2, 3)])
            for names in ("red of the element edge", "uv of the element face",
                          "view, far of the element camera"):
                self.assertIn(f"warning: a.ply: left out {names}\n", said)

    def test_faces_of_few_points(self):
        """As meshio writes verts and lines. Arrays of faces follow the order of VTK's cells."""
        faces = [([0, 1, 2], 7), ([0, 2], 8), ([3], 9), ([], 10), ([0, 2, 3], 11), ([1, 3], 12), ([], 13)]
        edges = ("edge", ["int vertex1", "int vertex2"], [(0, 1)])
        for elements in ([("face", INDICES + ["int mark"], faces), edges],
                         [edges, ("face", INDICES + ["int mark"], faces)]):
            for mesh, said in self.read_all(("vertex", XYZ, SQUARE), *elements):
                self.assertEqual(cells_of(mesh.GetVerts()), [(3,)])
                self.assertEqual(cells_of(mesh.GetLines()), [(0, 1), (0, 2), (1, 3)])
                self.assertEqual(triangles_of(mesh), [(0, 1, 2), (0, 2, 3)])
                self.assertEqual(values_of(mesh.GetCellData().GetArray("mark")), [9, 0, 8, 12, 7, 11])
                self.assertIn("warning: a.ply: left out 2 faces without points\n", said)

    def test_faces_of_two_points_are_constraints(self):
        """An interface that flips would remove."""
        points = [(0, 0, 0), (4, 0, 0), (2, 1, 0), (2, -1, 0)]
        faces = [([0, 1, 2],), ([1, 0, 3],), ([0, 1],)]
        self.write("a.ply", make_ply("ascii", ("vertex", XYZ, points), ("face", INDICES, faces)))
        for name in ("out.vtp", "out.obj", "out.ply", "out.stl", "out.vtk"):
            self.succeed("a.ply", name)
            if name == "out.stl":
                continue  # which has no lines
            self.succeed(name, "again.vtp")
            mesh = self.read_mesh("again.vtp")
            self.assertEqual(triangles_of(mesh), [(0, 1, 2), (1, 0, 3)], name)
            self.assertEqual(cells_of(mesh.GetLines()), [(0, 1)], name)

    def test_textures_are_named(self):
        content = make_ply("ascii", ("vertex", XYZ, SQUARE), ("face", INDICES, [([0, 1, 2],)]))
        self.write("a.ply", content.replace(b"comment", b"comment TextureFile my x.png\ncomment", 1))
        self.assertEqual(self.succeed("a.ply", "out.vtp").stderr,
                         "warning: a.ply: left out TextureFile 'my x.png'\n")

    def test_unknown_element_with_lists_is_refused(self):
        vertices = ("vertex", XYZ, SQUARE)
        polygons = ("polygons", INDICES, [([0, 1, 2],)])
        self.refuse_all((vertices, polygons), "'polygons'")
        strips = ("tristrips", ["list int int vertex_indices"], [([0, 1, 2, -1],)])
        self.refuse_all((vertices, ("face", INDICES, [([0, 1, 2],)]), strips), "'tristrips'")

    def test_vertices_that_do_not_exist(self):
        for bad in (4, -1, -2):
            faces = ("face", INDICES, [([0, 1, 2],), ([0, 1, bad],)])
            self.refuse_all((("vertex", XYZ, SQUARE), faces), f"cell 1 names point {bad},")
        edges = ("edge", ["int vertex1", "int vertex2"], [(0, 4)])
        self.refuse_all((("vertex", XYZ, SQUARE), edges), "cell 0 names point 4,")

    def test_rows_of_another_length(self):
        content = make_ply("ascii", ("vertex", XYZ, SQUARE), ("face", INDICES, [([0, 1, 2],)]))
        for row, place in ((b"3 0 1", "line 15:"), (b"3 0 1 2 3", "line 15:"), (b"", "line 15:")):
            self.write("a.ply", content.replace(b"3 0 1 2\n", row + b"\n"))
            self.refuse("a.ply", place)

    def test_bytes_behind_the_end_are_named(self):
        for encoding in ENCODINGS:
            content = make_ply(encoding, ("vertex", XYZ, SQUARE), ("face", INDICES, [([0, 1, 2],)]))
            self.write("a.ply", content + b"3 0 2 3")
            self.assertIn("a.ply: left out 7 bytes after its last", self.succeed("a.ply", "out.vtp").stderr)


class Labels(PlyTest):
    """The integers of faces, beside an edge, which has none."""

    HEAD = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
            "property double z\nelement face 2\nproperty int material\n"
            "property list uchar int vertex_indices\nproperty float angle\nproperty uchar red\n"
            "property uchar green\nproperty uchar blue\nelement edge 1\nproperty int vertex1\n"
            "property int vertex2\nend_header\n0 0 0\n4 0 0\n2 1 0\n2 -1 0\n"
            "7 3 0 1 2 .5 1 2 3\n-8 3 1 0 3 .5 4 5 6\n0 2\n")

    def test_integers_of_faces(self):
        self.write("in.ply", self.HEAD)
        said = self.succeed("in.ply", "flipped.vtp").stderr
        self.assertIn("left out angle of the element face\n", said)
        self.assertIn("--region-array material keeps", said)
        self.assertNotIn((1, 0, 3), triangles_of(self.read_mesh("flipped.vtp")))
        for name in ("out.vtp", "out.vtk", "out.ply"):
            said = self.succeed("in.ply", name, "--region-array", "material").stderr
            self.assertNotIn("cannot store", said)
            self.succeed(name, "again.vtp", "--region-array", "material")
            mesh = self.read_mesh("again.vtp")
            self.assertEqual(mesh.GetCellData().GetArray("material").GetDataType(), 6)
            self.assertEqual(mesh.GetCellData().GetArray("material").GetTuple(0), (0,), name)
            found = [mesh.GetCellData().GetArray(array).GetTuple(cell)
                     for array in ("material", "RGB") for cell in (1, 2)]
            self.assertEqual(found, [(7,), (-8,), (1, 2, 3), (4, 5, 6)], name)
            self.assertIn((1, 0, 3), triangles_of(mesh))

    def test_integers_of_cells_that_do_not_fit(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        for kind, name, value in (("Id", "small", 9), ("Id", "large", 2**40), ("Float", "real", 1),
                                  ("UnsignedChar", "vertex_indices", 3)):
            class_name = "vtkIdTypeArray" if kind == "Id" else f"vtk{kind}Array"
            mesh.GetCellData().AddArray(make_values(class_name, name, [(value,)]))
        said = self.succeed(self.write_mesh(mesh, "in.vtp", SetDataModeToBinary=()), "out.ply").stderr
        self.assertIn("cell data (large, real, vertex_indices)", said)
        self.assertIn(b"property int small\n", self.content("out.ply"))


class Properties(PlyTest):
    def test_every_type(self):
        """Values at both ends of the range of each type."""
        types = [kind for kind in CODES if kind[-1].isalpha() or kind[-2:] == "64"]
        extremes = {"b": 7, "h": 15, "i": 31, "q": 52}
        rows = []
        for low in (True, False, True):
            row = [0.0, float(len(rows)), float(len(rows) ** 2)]
            for kind in types:
                bits = extremes.get(CODES[kind].lower())
                signed = CODES[kind].islower()
                top = 2 ** (bits + (not signed)) - 1 if bits else 1.5
                row.append((-top - 1 if signed else 0) if low and bits else top)
            rows.append(row)
        properties = XYZ + [f"{kind} a_{kind}" for kind in types]
        for mesh, _ in self.read_all(
            ("vertex", properties, rows), ("face", INDICES, [([0, 1, 2],)])
        ):
            for place, kind in enumerate(types):
                values = tuples_of(mesh.GetPointData().GetArray(f"a_{kind}"))
                self.assertEqual(values, [(row[3 + place],) for row in rows], kind)

    def test_integers_that_a_double_cannot_hold(self):
        rows = [(*p, 2**53) for p in SQUARE]
        for kind in ("int64", "uint64"):
            vertices = ("vertex", [*XYZ, kind + " id"], rows)
            self.refuse_all((vertices, ("face", INDICES, [([0, 1, 2],)])), "id has integers beyond 2^53")

    def test_colors_normals_and_texture(self):
        vertex = XYZ + ["float nx", "float ny", "float nz", "uchar red", "uchar green"]
        vertex += ["uchar blue", "uchar alpha", "float s", "float t", "float quality"]
        rows = [(*p, 0, 0, 1, 10 * i, 20, 30, 40, i / 4, 0.5, i / 8) for i, p in enumerate(SQUARE)]
        for mesh, said in self.read_all(("vertex", vertex, rows), ("face", INDICES, [([0, 1, 2],)])):
            self.assertEqual(said, "")
            points = mesh.GetPointData()
            self.assertEqual(tuples_of(points.GetNormals()), [(0, 0, 1)] * 4)
            self.assertEqual(points.GetScalars().GetName(), "RGBA")
            self.assertEqual(tuples_of(points.GetScalars())[3], (30, 20, 30, 40))
            self.assertEqual(tuples_of(points.GetTCoords())[2], (0.5, 0.5))
            self.assertEqual(tuples_of(points.GetArray("quality"))[3], (0.375,))

    def test_lists_of_vertices_are_left_out_with_a_warning(self):
        rows = [([1, 2, 3], *point) for point in SQUARE]
        for mesh, said in self.read_all(
            ("vertex", ["list uchar int near"] + XYZ, rows), ("face", INDICES, [([0, 1, 2],)])
        ):
            self.assertEqual("warning: a.ply: left out near of the element vertex\n", said)
            self.assertEqual(points_of(mesh), SQUARE)


class Heads(PlyTest):
    def test_what_is_wrong_is_named(self):
        good = make_ply("ascii", ("vertex", XYZ, SQUARE), ("face", INDICES, [([0, 1, 2],)]))
        for old, new, naming in (
            (b"vertex 4", b"vertex four", "line 4:"),
            (b"vertex 4", b"vertex -4", "line 4:"),
            (b"float y", b"quad y", "line 6: 'quad' is not a type"),
            (b"float y", b"float x", "line 6:"),
            (b"list uchar", b"list float", "line 9:"),
            (b"element face", b"elements face", "line 8:"),
            (b"element face 1", b"element vertex 1", "line 8:"),
            (b"format ascii", b"format utf8", "utf8"),
            (b"float z", b"float w", "x, y and z"),
            (b"vertex_indices", b"corners", "vertex_indices"),
            (b"element vertex", b"element points", "x, y and z"),
        ):
            self.assertIn(old, good)
            self.write("a.ply", good.replace(old, new))
            self.refuse("a.ply", naming)

# The type of an array, two values of it, and the type that comes back from a .ply.
PLY_TYPES = [
    ("vtkSignedCharArray", (-128, 127), None),
    ("vtkUnsignedCharArray", (0, 255), None),
    ("vtkShortArray", (-(2**15), 2**15 - 1), None),
    ("vtkUnsignedShortArray", (0, 2**16 - 1), None),
    ("vtkIntArray", (-(2**31), 2**31 - 1), None),
    ("vtkUnsignedIntArray", (0, 2**32 - 1), None),
    ("vtkFloatArray", (-math.inf, math.nan), None),
    ("vtkDoubleArray", (1 / 3, -1e300), None),
    ("vtkBitArray", (0, 1), "vtkDoubleArray"),
    ("vtkIdTypeArray", (-(2**31), 2**31 - 1), "vtkDoubleArray"),
    ("vtkUnsignedLongArray", (0, 2**53 - 1), "vtkDoubleArray"),
]


class Written(ArrayTest):
    def test_arrays_of_every_type(self):
        mesh = bumpy_grid(3, 0)
        for kind, (low, high), _ in PLY_TYPES:
            tuples = [(high if i % 3 else low,) for i in range(9)]
            mesh.GetPointData().AddArray(make_values(kind, "a " + kind, tuples))
        out = self.convert(mesh, "out.ply", "out.vtp").GetPointData()
        self.assertEqual(out.GetNumberOfArrays(), len(PLY_TYPES))
        for kind, (low, high), back in PLY_TYPES:
            values = [high if i % 3 else low for i in range(9)]
            self.assert_array(out.GetArray("a_" + kind), back or kind, values)

    def test_normals_colors_texture_and_vectors(self):
        mesh = bumpy_grid(3, 0)
        points = mesh.GetPointData()
        points.SetNormals(make_values("vtkDoubleArray", "N", [(i / 3, 1, -i) for i in range(9)]))
        points.SetTCoords(make_values("vtkFloatArray", "T", [(i / 8, 0.5) for i in range(9)]))
        points.SetScalars(make_values("vtkUnsignedCharArray", "C", [(i, 2, 255) for i in range(9)]))
        points.AddArray(make_values("vtkFloatArray", "flow", [(i, -i, 0.5) for i in range(9)]))
        out = self.convert(mesh, "out.ply", "out.vtp").GetPointData()
        for array, kind, row in (
            (out.GetNormals(), "vtkDoubleArray", lambda i: (i / 3, 1, -i)),
            (out.GetTCoords(), "vtkFloatArray", lambda i: (i / 8, 0.5)),
            (out.GetScalars(), "vtkUnsignedCharArray", lambda i: (i, 2, 255)),
            (out.GetArray("flow_1"), "vtkFloatArray", lambda i: (-i,)),
        ):
            self.assert_array(array, kind, [x for i in range(9) for x in row(i)])

    def test_doubles_stay(self):
        mesh = make_mesh([(581311.123, 1e300, 1 / 3), (1, 0, -0.0), (0, math.nan, 5e-324)], [(0, 1, 2)])
        source = self.write_mesh(mesh, "in.vtk")
        self.succeed(source, "out.ply", "--quiet")
        self.succeed("out.ply", "out.vtk", "--quiet")
        out = self.read_mesh("out.vtk")
        self.assert_array(out.GetPoints().GetData(), "vtkDoubleArray",
                          values_of(mesh.GetPoints().GetData()))

    def test_lines_become_edges(self):
        mesh = bumpy_grid(3, 0)
        mesh.SetLines(make_mesh([], [], [(0, 1, 2), (), (5,), (3, 4)]).GetLines())
        out = self.convert_by_vtk(mesh, "out.ply")
        self.assertEqual(cells_of(out.GetLines()), [(0, 1), (1, 2), (3, 4)])
        self.read_plainly("out.ply")

    def test_labels_of_lines_are_left_out_with_a_note(self):
        self.write("in.ply", self.text_with_line(7))
        self.assertIn("cell data of lines (material)", self.succeed("in.ply", "out.ply").stderr)
        self.write("in.ply", self.text_with_line(0))
        self.assertNotIn("cell data", self.succeed("in.ply", "out.ply").stderr)

    @staticmethod
    def text_with_line(label):
        """Two triangles, and the line between them as a face of two points."""
        return ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 3\nproperty list uchar int vertex_indices\nproperty int material\nend_header\n"
                f"0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 5\n3 0 2 3 6\n2 0 2 {label}\n")

    def convert_by_vtk(self, mesh, name):
        """Like convert, but from a .vtk, which can hold more."""
        self.succeed(self.write_mesh(mesh, "in.vtk"), name)
        self.succeed(name, "out.vtk")
        return self.read_mesh("out.vtk")

    def test_cells_of_few_and_many_points(self):
        points = [(math.cos(i / 50), math.sin(i / 50), 0) for i in range(300)] + [(math.nan, 0, 0)]
        out = self.convert_by_vtk(make_mesh(points, [(0, 1, 2), tuple(range(301))]), "out.ply")
        self.assertIn((0, 1, 2), triangles_of(out))
        for cell in ((), (4,), (4, 5)):  # which would come back as verts and lines
            source = self.write_mesh(make_mesh(points, [(0, 1, 2), cell]), "in.vtk")
            self.fail_with(3, source, "out.ply", naming=["out.ply", "polygon 1 has", "a .vtk can hold it"])

    def test_what_does_not_fit_is_named(self):
        mesh = bumpy_grid(3, 0)
        points = mesh.GetPointData()
        points.AddArray(make_values("vtkStringArray", "words", [("a",)] * 9))
        points.AddArray(make_values("vtkLongLongArray", "huge", [(2**53,)] * 9))
        points.AddArray(make_values("vtkFloatArray", "x", [(1,)] * 9))
        points.AddArray(make_values("vtkIntArray", "two words", [(1,)] * 9))
        points.AddArray(make_values("vtkIntArray", "two_words", [(1,)] * 9))
        mesh.GetCellData().AddArray(make_values("vtkIntArray", "rock", [(1,)] * 8))
        source = self.write_mesh(mesh, "in.vtp", SetDataModeToBinary=())
        said = self.succeed(source, "out.ply").stderr
        self.assertIn("point data (words, huge, x, two_words)\n", said)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Numbers in text files: read exactly or refused with the line, never changed."""

import math
import random
import struct

from CommandTesting import BadFileTest, points_of

TRIANGLE = ((0, 0, 0), (1, 0, 0), (0, 1, 0))


def as_text(points, name):
    """A triangle as a text file, with the coordinates written as given."""
    rows = [" ".join(map(str, point)) for point in points]
    body = "\n".join(rows)
    extension = name.rsplit(".", 1)[1]
    if extension == "obj":
        return "\n".join("v " + row for row in rows) + "\nf 1 2 3\n"
    if extension == "ply":
        axes = "".join(f"property double {axis}\n" for axis in "xyz")
        return (
            f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\n{axes}element face 1\n"
            f"property list uchar int vertex_indices\nend_header\n{body}\n3 0 1 2\n"
        )
    if extension == "stl":
        vertices = "\n".join("vertex " + row for row in rows)
        return (
            "solid s\nfacet normal 0 0 1\nouter loop\n"
            f"{vertices}\nendloop\nendfacet\nendsolid s\n"
        )
    if extension == "vtk":
        return (
            "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"
            f"POINTS {len(rows)} double\n{body}\nPOLYGONS 1 4\n3 0 1 2\n"
        )
    return (
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>\n'
        f'<Piece NumberOfPoints="{len(rows)}" NumberOfPolys="1"><Points>\n'
        f'<DataArray type="Float64" NumberOfComponents="3" format="ascii">\n{body}</DataArray>\n'
        '</Points><Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2'
        '</DataArray><DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>'
        "</Polys></Piece></PolyData></VTKFile>\n"
    )


# The line of the second point.
TEXTS = {"a.obj": 2, "a.ply": 11, "a.stl": 5, "a.vtk": 7, "a.vtp": 5}


class Exact(BadFileTest):
    def test_every_digit_of_a_double(self):
        generator = random.Random(5)
        for name in TEXTS:
            bits = [generator.getrandbits(64) for _ in range(9)]
            values = [struct.unpack("<d", struct.pack("<Q", b))[0] for b in bits]
            values = [0.1 if math.isnan(v) or math.isinf(v) else v for v in values]
            points = [tuple(values[i : i + 3]) for i in (0, 3, 6)]
            mesh, _ = self.read(name, as_text([map(repr, point) for point in points], name))
            self.assertEqual(points_of(mesh), points, name)
            self.assertTrue(mesh.GetPoints().GetData().IsA("vtkDoubleArray"))

    def test_ways_to_write_a_number(self):
        ways = {"+1.5": 1.5, "1.": 1.0, ".5": 0.5, "-0": 0.0, "1E3": 1e3, "1e-400": 0.0, "2e-324": 0.0}
        for name in TEXTS:
            for text, value in ways.items():
                mesh, _ = self.read(name, as_text([(0, 0, 0), (text, 0, 0), (0, 1, 0)], name))
                self.assertEqual(mesh.GetPoint(1)[0], value, (name, text))

    def test_nan_and_infinity_stay(self):
        for name in ("a.obj", "a.ply", "a.stl"):
            for text, value in (
                ("nan", math.nan),
                ("NaN", math.nan),
                ("inf", math.inf),
                ("-inf", -math.inf),
                ("-Infinity", -math.inf),
            ):
                mesh, _ = self.read(name, as_text([(0, 0, 0), (1, text, 7), (0, 1, 0)], name))
                point = mesh.GetPoint(1)
                self.assertEqual(repr(point), repr((1.0, value, 7.0)), (name, text))
                self.assertEqual(mesh.GetPoint(2), (0, 1, 0))

    def test_nan_and_infinity_as_text_of_vtk(self):
        """VTK refuses them in a .vtk, and reads -inf as inf in a .vtp."""
        for name in ("a.vtk", "a.vtp"):
            for text in ("nan", "inf", "-inf", "-Infinity"):
                self.write(name, as_text([(0, 0, 0), (1, text, 7), (0, 1, 0)], name))
                self.refuse(name)

    def test_single_precision_is_rounded_once(self):
        """Slightly more than half of a float's last place; as a double it would be exactly half."""
        text = "1.00000005960464477539062500000000000001"
        content = as_text([(0, 0, 0), (text, 0, 0), (0, 1, 0)], "a.vtk").replace("double", "float")
        mesh, _ = self.read("a.vtk", content)
        self.assertEqual(mesh.GetPoint(1)[0], 1 + 2**-23)


class Refused(BadFileTest):
    def refuse_number(self, text, *naming):
        for name, line in TEXTS.items():
            self.write(name, as_text([(0, 0, 0), (1, text, 0), (0, 1, 0)], name))
            # VTK itself reads the other two.
            own = name not in ("a.vtk", "a.vtp")
            self.refuse(name, *((f"line {line}", *naming) if own else ()))

    def test_decimal_comma(self):
        self.refuse_number("1,5", "'1,5' is not a number")

    def test_words(self):
        for text in ("abc", "1.5x", "0x10", "1e", "--1", "1.2.3", "+-1", "1d5"):
            self.refuse_number(text, f"'{text}' is not a number")

    def test_too_large(self):
        for text in ("1e400", "-1e400", "1" + 400 * "0"):
            self.refuse_number(text, "out of range")

    def test_too_large_for_single_precision(self):
        content = as_text([(0, 0, 0), (1, "1e39", 0), (0, 1, 0)], "a.ply")
        self.write("a.ply", content.replace("double", "float"))
        self.refuse("a.ply", "line 11", "'1e39' is out of range")

    def test_missing_number(self):
        for name in ("a.obj", "a.ply", "a.stl"):
            self.write(name, as_text([(0, 0, 0), (1, "", 0), (0, 1, 0)], name))
            self.refuse(name, f"line {TEXTS[name]}")

    def test_integers_of_attributes(self):
        content = as_text(TRIANGLE, "a.ply").replace("element face", "property uchar q\nelement face")
        for text in ("256", "-1", "1.5", "x"):
            rows = content.replace("0 0 0\n", "0 0 0 7\n").replace("1 0 0\n", f"1 0 0 {text}\n")
            self.write("a.ply", rows.replace("0 1 0\n", "0 1 0 9\n"))
            self.refuse("a.ply", "line 12", f"'{text}'")


class IntegersOfVtk(BadFileTest):
    """VTK wraps integers in text that their types cannot hold."""

    # Types of a .vtk and a .vtp, and for each the least and the largest integer.
    TYPES = [("unsigned_char", "UInt8", 0, 2**8 - 1), ("char", "Int8", -(2**7), 2**7 - 1),
             ("unsigned_short", "UInt16", 0, 2**16 - 1), ("short", "Int16", -(2**15), 2**15 - 1),
             ("unsigned_int", "UInt32", 0, 2**32 - 1), ("int", "Int32", -(2**31), 2**31 - 1),
             ("unsigned_long", "UInt64", 0, 2**64 - 1), ("long", "Int64", -(2**63), 2**63 - 1)]
    LEGACY = ("# vtk DataFile Version 3.0\n300 999\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
              "POLYGONS 1 4\n3 0 1 2\n")
    XML = ('<VTKFile type="PolyData" version="0.1"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1">{}'
           '<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray>'
           '</Points><Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>'
           '<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray></Polys></Piece></PolyData></VTKFile>')

    def expect(self, name, text, kind, number, fits):
        self.write(name, text)
        if fits:
            self.succeed(name, "out.vtk", "--quiet")
        else:
            self.refuse(name)
            told = self.run_command(name, "out.vtk").stderr
            isWrapped = "char" in kind or name == "a.vtp"  # else VTK itself may refuse it
            self.assertTrue(f"{number} in the array 'a' does not fit into its type {kind}" in told
                            or not isWrapped and "cannot be read" in told, told)

    def test_ends_of_the_ranges(self):
        for legacy, xml, least, most in self.TYPES:
            for number in (least, most, least - 1, most + 1):
                fits = least <= number <= most
                for field in (f"SCALARS a {legacy}\nLOOKUP_TABLE default\n1 {number}\n0\n",
                              f"FIELD f 2\na 1 3 {legacy}\n1 0 {number}\n300 1 3 short\n300 -300 7\n"):
                    self.expect("a.vtk", self.LEGACY + "POINT_DATA 3\n" + field, legacy, number, fits)
                array = f'<PointData><DataArray type="{xml}" Name="a" format="ascii">\n1 0\n {number}\n'
                self.expect("a.vtp", self.XML.format(array + "</DataArray></PointData>"), xml, number, fits)

    def test_attributes_of_a_vtk(self):
        many = "1 1 1 1 1 1 1 1 1 "
        for section, bad in (
            ("CELL_DATA 1\nSCALARS a unsigned_char 2\nLOOKUP_TABLE t\n1 ", 300), ("CELL_DATA 1\nVECTORS a char\n1 2 ", 128),
            ("CELL_DATA 1\nNORMALS a char\n1 2\n", -129), ("CELL_DATA 1\nTENSORS a char\n1 1 1 1 1 1 1 1 ", 128),
            ("CELL_DATA 1\nTEXTURE_COORDINATES a 2 char\n1 ", 128), ("FIELD FieldData 1\na 1 2 char\n1 ", 128),
            ("POINT_DATA 3\nSCALARS first float 3\nLOOKUP_TABLE default\n" + many + "\nVECTORS b char\n" + many
             + "\nMETADATA\nINFORMATION 0\n\nVECTORS a char\n1 2 3 1 2 3 1 2 ", 128),
            ("CELL_DATA 1\nSCALARS b char 1\nLOOKUP_TABLE 300\n1\nLOOKUP_TABLE 300 1\n1 1 1 1\nSCALARS a char\n"
             "LOOKUP_TABLE default\n", 128),
            ("CELL_DATA 1\nSCALARS a unsigned_char LOOKUP_TABLE default\n", 300),
            ("CELL_DATA 1\nSCALARS a unsigned_char 1 lookup_table default ", 300),
            ("CELL_DATA 1\nSCALARS a unsigned_char\n1\nLOOKUP_TABLE default\n", 300),
        ):
            for number in (3, bad):
                kind = "unsigned_char" if "unsigned" in section else "char"
                self.expect("a.vtk", self.LEGACY + section + f"{number}\n", kind, number, number == 3)

    def test_points_and_cells_of_a_vtp(self):
        for old, new, kind in (("Float32", "UInt8", "UInt8"),):
            text = self.XML.format("").replace(old, new).replace("0 0 0 1 0 0", "0 0 0 300 0 0")
            self.write("a.vtp", text)
            self.refuse("a.vtp", f"300 in the array of Points does not fit into its type {kind}")


class Lines(BadFileTest):
    def test_byte_order_mark_and_old_line_ends(self):
        for name in ("a.obj", "a.ply", "a.stl"):
            text = as_text([(0, 0, 0), (1, 0.5, 0), (0, 1, 0)], name)
            expected = None
            for mark in ("", "\ufeff"):
                for end in ("\n", "\r\n", "\r"):
                    mesh, _ = self.read(name, mark + text.replace("\n", end))
                    points = points_of(mesh)
                    expected = expected or points
                    self.assertEqual(points, expected, (name, mark, end))
            self.assertEqual(expected[1], (1, 0.5, 0))

    def test_lines_are_counted_with_any_end(self):
        for end in ("\n", "\r\n", "\r"):
            self.write("a.obj", as_text([(0, 0, 0), (1, "x", 0), (0, 1, 0)], "a.obj").replace("\n", end))
            self.refuse("a.obj", "line 2:")

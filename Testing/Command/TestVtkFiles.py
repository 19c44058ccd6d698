# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's own formats: everything is kept, and what VTK's readers lose silently is refused."""

import math

from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

from CommandTesting import (
    ArrayTest, BadFileTest, bumpy_grid, cells_of, make_cells, make_mesh, make_values, points_of,
    same, triangles_of, values_of)
from TestNumbers import as_text

GRID = 4


class Read(ArrayTest):
    def written(self, mesh):
        """Writes the mesh with VTK in every version and encoding. Yields the names of the files."""
        for version in (42, 51):
            for encoding in ("ASCII", "Binary"):
                name = f"{encoding}{version}.vtk"
                settings = {f"SetFileTypeTo{encoding}": (), "SetFileVersion": (version,)}
                self.write_mesh(mesh, name, **settings)
                yield name
        for mode in ("Ascii", "Binary", "Appended"):
            self.write_mesh(mesh, mode + ".vtp", **{f"SetDataModeTo{mode}": ()})
            yield mode + ".vtp"

    def test_every_array(self):
        """Several arrays of each kind, on verts, lines and triangles, which are Delaunay already."""
        points = [(x, y + x / 16, 0) for x in range(4) for y in range(3)]
        mesh = make_mesh(points, [(0, 3, 1), (1, 3, 4)], [(0, 1, 2), (5, 8)])
        mesh.SetVerts(make_cells([(2,), (0,)]))
        for data, size in ((mesh.GetPointData(), 12), (mesh.GetCellData(), 6)):
            for kind, components in (("Scalars", 1), ("Vectors", 3), ("Normals", 3), ("TCoords", 2)):
                for number in range(2):
                    tuples = [tuple(i + c + number for c in range(components)) for i in range(size)]
                    array = make_values("vtkDoubleArray", f"{kind} {number}", tuples)
                    data.AddArray(array)
                getattr(data, "Set" + kind)(array)
            for kind in ("UnsignedChar", "Short", "Int", "UnsignedLongLong", "Float"):
                data.AddArray(make_values(f"vtk{kind}Array", kind, [(i % 7,) for i in range(size)]))
            data.AddArray(make_values("vtkStringArray", "words", [(f"w {i}",) for i in range(size)]))
        mesh.GetFieldData().AddArray(make_values("vtkStringArray", "field", [("one",), ("",)]))
        for name in self.written(mesh):
            for out in ("out.vtk", "out.vtp"):
                self.succeed(name, out)
                found = self.read_mesh(out)
                self.assertEqual(points_of(found), points)
                for data in ("GetPointData", "GetCellData", "GetFieldData"):
                    one, other = getattr(mesh, data)(), getattr(found, data)()
                    for index in range(one.GetNumberOfArrays()):
                        array = one.GetAbstractArray(index)
                        self.assert_array(other.GetAbstractArray(array.GetName()),
                                          array.GetClassName(), values_of(array))
                for data in ("GetPointData", "GetCellData"):
                    for kind in ("Scalars", "Vectors", "Normals", "TCoords"):
                        active = getattr(getattr(found, data)(), "Get" + kind)()
                        self.assertEqual(active.GetName(), kind + " 1", (name, out))

    def test_pieces_of_xml(self):
        numbers = '<PointData><DataArray type="Int32" Name="n" format="ascii">{0}1 {0}2 {0}3</DataArray></PointData>'
        flat = [(0, 0), (1, 0), (0, 1)]
        files = [as_text([(*place, z) for place in flat], "in.vtp").replace(
            "<Points>", numbers.format(z) + "<Points>") for z in (4, 7)]
        end = "</PolyData>"
        second = files[1][files[1].index("<Piece"):files[1].index(end)]
        self.write("in.vtp", files[0].replace(end, second + end))
        self.succeed("in.vtp", "out.vtk")
        found = self.read_mesh("out.vtk")
        self.assertEqual(points_of(found), [(x, y, z) for z in (4, 7) for x, y in flat])
        self.assertEqual(triangles_of(found), [(0, 1, 2), (3, 4, 5)])
        numbers_found = [found.GetPointData().GetArray("n").GetTuple1(i) for i in range(6)]
        self.assertEqual(numbers_found, [41, 42, 43, 71, 72, 73])

    def test_every_kind_of_cell(self):
        mesh = make_mesh([(x, y, 0) for x in range(4) for y in range(2)], [(0, 2, 3, 1)])
        mesh.SetStrips(make_cells([(2, 3, 4, 5), (4, 6, 5)]))
        mesh.SetVerts(make_cells([(7,), (0, 1)]))
        mesh.SetLines(make_cells([(0, 2, 4), (1, 3)]))
        for name in self.written(mesh):
            self.succeed(name, "out.vtk")
            found = self.read_mesh("out.vtk")
            triangles = {tuple(sorted(cell)) for cell in triangles_of(found)}
            self.assertEqual(triangles, {(0, 2, 3), (0, 1, 3), (2, 3, 4), (3, 4, 5), (4, 5, 6)})
            self.assertEqual(cells_of(found.GetVerts()), [(7,), (0, 1)])
            self.assertEqual(cells_of(found.GetLines()), [(0, 2, 4), (1, 3)])

    def test_full_blocks(self):
        """64 x 64 points fill three of the blocks that VTK compresses."""
        for name in self.written(bumpy_grid(64, 0)):
            self.succeed(name, "out.vtk")
            self.assertEqual(self.read_mesh("out.vtk").GetNumberOfPoints(), 4096)


class LostByVtk(BadFileTest):
    """VTK's readers give up a part of these, or all, and report nothing."""

    def test_more_sections_than_one_of_a_vtk(self):
        head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
        for section in ("POLYGONS", "LINES", "VERTICES", "TRIANGLE_STRIPS"):
            self.write("a.vtk", head + 2 * f"{section} 1 4\n3 0 1 2\n")
            self.refuse("a.vtk", section, "2", "1")
        self.write("a.vtk", head + "POLYGONS 1 4\n3 0 1 2\nPOLYGONS 0 0\n")
        self.refuse("a.vtk", "POLYGONS", "1", "0")

    def test_last_cell_too_long(self):
        head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
        self.write("a.vtk", head + "POLYGONS 2 8\n3 0 1 2\n4 0 2 3\n")
        self.refuse("a.vtk", "POLYGONS, all integers", "8", "corrupt")
        offsets = "POLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 {}\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3\n"
        for end, code in ((6, 0), (90000, 3), (2, 3)):
            self.write("a.vtk", head.replace("3.0", "5.1") + offsets.format(end))
            self.assertEqual(self.run_command("a.vtk", "out.vtk").returncode, code, end)

    def test_words_that_look_like_headers(self):
        """A title, strings, and names of arrays before the points and after the cells."""
        mesh = bumpy_grid(GRID, 0)
        words = make_values("vtkStringArray", "words", [("POLYGONS",), ("POINT_DATA",)])
        mesh.GetFieldData().AddArray(words)
        for name in ("points", "LINES", "polygons", "vertices"):
            for add, size in (("GetFieldData", 3), ("GetPointData", 16), ("GetCellData", 18)):
                values = make_values("vtkIntArray", name, [(i,) for i in range(size)])
                getattr(mesh, add)().AddArray(values)
        for version in (42, 51):
            for encoding in ("ASCII", "Binary"):
                settings = {f"SetFileTypeTo{encoding}": (), "SetFileVersion": (version,)}
                self.write_mesh(mesh, "a.vtk", SetHeader=("Lines 3 to 5",), **settings)
                self.succeed("a.vtk", "out.vtk")
                self.succeed("out.vtk", "again.vtk")
                self.assertEqual(len(triangles_of(self.read_mesh("again.vtk"))), 18)

    def damaged(self):
        """Damaged files, each with the attribute of Piece that shows it."""
        path = self.write_mesh(bumpy_grid(GRID, 0), "good.vtp", SetDataModeToAscii=())
        good = self.content(path).decode()
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
                self.write_mesh(bumpy_grid(GRID, 0), "good.vtp", **settings)
                binary = self.content(path).decode("latin-1")
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
                self.assertEqual(self.content("mesh.vtp"), before)
                good = self.write_mesh(bumpy_grid(GRID, 0), "in.vtk")
                self.fail_with(3, good, "out.vtk", "--constraints", "mesh.vtp", naming=["mesh.vtp"])

    def test_other_legacy_type(self):
        self.write(
            "grid.vtk",
            "# vtk DataFile Version 3.0\ngrid\nASCII\nDATASET UNSTRUCTURED_GRID\n"
            "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n",
        )
        self.refuse("grid.vtk", "UNSTRUCTURED_GRID", "Extract Surface")
        self.write("image.vtk", "# vtk DataFile Version 3.0\nheights\nASCII\nDATASET STRUCTURED_POINTS\n"
                   "DIMENSIONS 2 2 1\nORIGIN 0 0 0\nSPACING 1 1 1\n")
        self.refuse("image.vtk", "STRUCTURED_POINTS", "Warp By Scalar")

    def test_other_xml_type(self):
        self.write(
            "grid.vtp",
            '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1">\n'
            "<UnstructuredGrid/>\n</VTKFile>\n",
        )
        self.refuse("grid.vtp", "UnstructuredGrid", "Extract Surface")

    def test_newer_version(self):
        """Only a warning, since the file may be readable."""
        path = self.write_mesh(bumpy_grid(GRID, 0), "a.vtk", SetFileTypeToASCII=())
        text = self.content(path).decode()
        self.assertIn("Version 5.1", text)
        self.write("a.vtk", text.replace("Version 5.1", "Version 6.7"))
        self.assertRegex(self.succeed("a.vtk", "out.vtk").stderr, r"^warning: .*6\.7.*\n$")


class Written(ArrayTest):
    def test_strings_with_zero_bytes_are_refused(self):
        """VTK's reader crashes on what its writer makes of them."""
        for add, size in (("GetFieldData", 5), ("GetPointData", 9), ("GetCellData", 8)):
            mesh = bumpy_grid(3, 0)
            words = make_values("vtkStringArray", "words", [("a",)] * size)
            getattr(mesh, add)().AddArray(words)
            source = self.write_mesh(mesh, "in.vtk", SetFileTypeToASCII=())
            self.succeed(source, "out.vtp")
            self.write("in.vtk", self.content(source).replace(b"\na\n", b"\na%00b\n", 1))
            self.fail_with(3, "in.vtk", "new.vtp", naming=["new.vtp", "words", "zero byte", ".vtk"])
            self.succeed("in.vtk", "out.vtk")

    def test_ids_that_vtk_cannot_write_or_read_are_refused(self):
        """VTK's writer crashes on ids that are strings; its reader fails on other types."""
        for kind in ("vtkStringArray", "vtkDoubleArray", "vtkUnsignedCharArray", "vtkIntArray"):
            make = str if kind == "vtkStringArray" else int
            for add, size in (("GetPointData", 9), ("GetCellData", 8)):
                mesh = bumpy_grid(3, 0)
                getattr(mesh, add)().SetPedigreeIds(
                    make_values(kind, "ids", [(make(i),) for i in range(size)]))
                source = self.write_mesh(mesh, "in.vtk")
                if kind == "vtkIntArray":
                    self.succeed(source, "out.vtp")
                    ids = getattr(self.read_plainly("out.vtp"), add)().GetAbstractAttribute(
                        vtkDataSetAttributes.PEDIGREEIDS)
                    self.assert_array(ids, kind, list(range(size)))
                else:
                    self.fail_with(3, source, "new.vtp", naming=["new.vtp", "'ids'", ".vtk"])

    def test_names_that_a_vtp_cannot_hold(self):
        for mark in "<>&\"\t":
            for is_component in (False, True):
                mesh = bumpy_grid(3, 0)
                words = make_values("vtkIntArray", "a" if is_component else f"a{mark}b", [(1,)] * 9)
                words.SetComponentName(0, f"a{mark}b" if is_component else "a")
                mesh.GetPointData().AddArray(words)
                source = self.write_mesh(mesh, "in.vtk")
                self.fail_with(3, source, "new.vtp", naming=["new.vtp", "'a", "in the name", ".vtk"])
                self.succeed(source, "out.vtk")
                out = self.read_mesh("out.vtk").GetPointData().GetArray(words.GetName())
                self.assertEqual(out.GetComponentName(0), words.GetComponentName(0))

    def test_arrays_of_a_wrong_size(self):
        """VTK reads them from the field of a .vtk, but not from a .vtp."""
        head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
        head += "0 0 0 2 -1 0 4 0 0 2 1 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\nPOINT_DATA 4\nFIELD f 1\n"
        for size in (2, 5):
            self.write("in.vtk", head + f"Colors 3 {size} float\n" + size * "1 1 1\n")
            self.fail_with(3, "in.vtk", "out.vtp", naming=["'Colors'", f"{size} tuples instead of 4"])
            self.succeed("in.vtk", "out.vtk")

    def test_what_vtk_spoils_in_a_vtk(self):
        """Ids beyond 32 bits, bits of several components, colors with a blank in their name, and active
        arrays that it would leave out."""
        mesh = bumpy_grid(3, 0)
        for data, size in ((mesh.GetPointData(), 9), (mesh.GetCellData(), 8), (mesh.GetFieldData(), 2)):
            for name in ("large", "ids", "small"):
                first = {"large": -2**40, "ids": 2**33, "small": 2**31 - size}[name]
                ids = make_values("vtkIdTypeArray", name, [(first + i,) for i in range(size)])
                data.AddArray(ids)
                if name == "ids" and size > 2:
                    data.SetGlobalIds(ids)
            for count in (1, 3, 5):
                tuples = [tuple((i + c) % 2 for c in range(count)) for i in range(size)]
                data.AddArray(make_values("vtkBitArray", f"bits {count}", tuples))
            data.AddArray(make_values("vtkUnsignedCharArray", "Vertex", [(7,)] * size))
            colors = make_values("vtkUnsignedCharArray", "Vertex Color", [(i, 1, 2) for i in range(size)])
            data.AddArray(colors)
            if size > 2:
                data.SetScalars(colors)
                for kind, count in (("Tangents", 3), ("RationalWeights", 1), ("HigherOrderDegrees", 3)):
                    tuples = [(i,) * count for i in range(size)]
                    getattr(data, "Set" + kind)(make_values("vtkDoubleArray", kind, tuples))
        source = self.write_mesh(mesh, "in.vtp")
        self.succeed(source, "out.vtk", "--max-iterations", 0, code=4)
        out = self.read_mesh("out.vtk")
        for data in ("GetPointData", "GetCellData", "GetFieldData"):
            for index in range(getattr(mesh, data)().GetNumberOfArrays()):
                array = getattr(mesh, data)().GetArray(index)
                found = getattr(out, data)().GetArray(array.GetName())
                self.assertEqual(values_of(found), values_of(array), (data, array.GetName()))
        for data in (out.GetPointData(), out.GetCellData()):
            self.assertEqual(data.GetGlobalIds().GetName(), "ids")

    def test_bits_of_several_components_beside_lines(self):
        """VTK cannot read them from a .vtp."""
        mesh = make_mesh([(0, 0, 0), (2, -1, 0), (4, 0, 0)], [(0, 1, 2)], [(0, 1)])
        bits = make_values("vtkBitArray", "bits", [(1, 0), (0, 1)])
        mesh.GetCellData().AddArray(bits)
        self.succeed(self.write_mesh(mesh, "in.vtk", SetFileTypeToASCII=()), "out.vtp")
        found = self.read_plainly("out.vtp").GetCellData().GetArray("bits")
        self.assert_array(found, "vtkUnsignedCharArray", [1, 0, 0, 1])

    def test_no_empty_arrays(self):
        """VTK 9.7 crashes on those of ids in a .vtk. Those of an earlier run go, too."""
        self.succeed(self.write_mesh(bumpy_grid(GRID, 0), "in.vtk"), "out.vtk")
        for name, expected in (("out.vtk", True), ("again.vtk", False)):
            self.succeed("out.vtk", "again.vtk")
            self.assertNotIn("cannot store", self.succeed("out.vtk", "out.ply").stderr)
            data = self.read_mesh(name).GetFieldData()
            arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
            self.assertEqual("DelaunayFlip:Flipped" in [one.GetName() for one in arrays], expected)
            self.assertEqual([one.GetName() for one in arrays if one.GetNumberOfTuples() == 0], [])

    def test_points_without_a_finite_range(self):
        for value in (1e155, 1.7e308, math.inf, math.nan):
            points = [(0, 0, 0), (value, 0, 0), (0, value, 0)]
            self.keep(make_mesh(points, [(0, 1, 2)]))
        self.keep(make_mesh([(math.nan,) * 3] * 3, [(0, 1, 2)]))

    def test_arrays_without_a_finite_range(self):
        for value in (1e155, -1e308, math.inf, -math.inf, math.nan):
            for components in (1, 3):
                mesh = bumpy_grid(3, 0)
                for data, size in ((mesh.GetPointData(), 9), (mesh.GetCellData(), 8),
                                   (mesh.GetFieldData(), 3)):
                    for name, first in (("all", value), ("some", 1.0)):
                        tuples = [(first,) * components] + [(value,) * components] * (size - 1)
                        data.AddArray(make_values("vtkDoubleArray", name, tuples))
                self.keep(mesh)

    def keep(self, mesh):
        """VTK reads all values of the .vtp that the command writes, without warnings."""
        self.succeed(self.write_mesh(mesh, "in.vtk"), "out.vtp")
        out = self.read_plainly("out.vtp")
        self.assertTrue(same(values_of(mesh.GetPoints().GetData()),
                             values_of(out.GetPoints().GetData())))
        self.assertEqual(mesh.GetNumberOfPolys(), out.GetNumberOfPolys())
        for kind in ("GetPointData", "GetCellData", "GetFieldData"):
            data = getattr(mesh, kind)()
            for index in range(data.GetNumberOfArrays()):
                array = data.GetArray(index)
                other = getattr(out, kind)().GetArray(array.GetName())
                self.assert_array(other, array.GetClassName(), values_of(array))
                self.assertTrue(same(array.GetRange(-1), other.GetRange(-1)))

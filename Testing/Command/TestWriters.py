# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What each format keeps of a mesh that is written and read back, attribute by attribute."""

import math
import unittest

import vtkmodules.vtkCommonCore as vtk
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

from CommandTesting import (
    CommandTest,
    bumpy_grid,
    cells_of,
    make_mesh,
    points_of,
    read_mesh,
    triangle_set,
    triangles_of,
    write_mesh,
)


def make_values(kind, name, tuples):
    """An array of a VTK class from tuples of values."""
    array = getattr(vtk, kind)()
    array.SetName(name)
    array.SetNumberOfComponents(len(tuples[0]))
    for values in tuples:
        for value in values:
            array.InsertNextValue(value)
    return array


def values_of(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def same(first, second):
    """Equality for which a NaN equals itself."""
    return len(first) == len(second) and all(
        a == b or (a != a and b != b) for a, b in zip(first, second)
    )


class WriterTest(CommandTest):
    def write(self, name, text):
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write(text)

    def text(self, name):
        with open(self.path(name), "rb") as file:
            return file.read().decode("latin-1")

    def convert(self, mesh, *names):
        """Passes a mesh through files with these names without losses. Returns the last mesh."""
        source = write_mesh(mesh, self.path("in.vtp"), SetDataModeToBinary=())
        for name in names:
            self.assertEqual(self.succeed(source, name).stderr, "", name)
            source = name
        return read_mesh(self.path(names[-1]))

    def read_plainly(self, name):
        """The mesh that VTK's own reader reads, without errors or warnings."""
        problems = []
        window = vtk.vtkStringOutputWindow()
        before = vtk.vtkOutputWindow.GetInstance()
        vtk.vtkOutputWindow.SetInstance(window)
        try:
            mesh = read_mesh(self.path(name))
            problems.append(window.GetOutput())
        finally:
            vtk.vtkOutputWindow.SetInstance(before)
        self.assertEqual(problems, [""], name)
        return mesh

    def assert_array(self, array, kind, values):
        self.assertIsNotNone(array)
        self.assertEqual(array.GetDataType(), getattr(vtk, kind)().GetDataType(), array.GetName())
        self.assertTrue(same(values_of(array), values), f"{array.GetName()}: {values_of(array)}")


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
    ("vtkBitArray", (0, 1), "vtkUnsignedCharArray"),
    ("vtkIdTypeArray", (-(2**31), 2**31 - 1), "vtkDoubleArray"),
    ("vtkUnsignedLongArray", (0, 2**53 - 1), "vtkDoubleArray"),
]


class Ply(WriterTest):
    def test_arrays_of_every_type(self):
        mesh = bumpy_grid(3, 0)
        for data, size in ((mesh.GetPointData(), 9), (mesh.GetCellData(), 8)):
            for kind, (low, high), _ in PLY_TYPES:
                tuples = [(high if i % 3 else low,) for i in range(size)]
                data.AddArray(make_values(kind, "a " + kind, tuples))
        out = self.convert(mesh, "out.ply", "out.vtp")
        for data, size in ((out.GetPointData(), 9), (out.GetCellData(), 8)):
            self.assertEqual(data.GetNumberOfArrays(), len(PLY_TYPES))
            for kind, (low, high), back in PLY_TYPES:
                values = [high if i % 3 else low for i in range(size)]
                self.assert_array(data.GetArray("a_" + kind), back or kind, values)

    def annotated(self):
        mesh = bumpy_grid(3, 0)
        points, cells = mesh.GetPointData(), mesh.GetCellData()
        points.SetNormals(make_values("vtkDoubleArray", "N", [(i / 3, 1, -i) for i in range(9)]))
        points.SetTCoords(make_values("vtkFloatArray", "T", [(i / 8, 0.5) for i in range(9)]))
        points.SetScalars(make_values("vtkUnsignedCharArray", "C", [(i, 2, 255) for i in range(9)]))
        points.AddArray(make_values("vtkFloatArray", "flow", [(i, -i, 0.5) for i in range(9)]))
        cells.AddArray(make_values("vtkUnsignedCharArray", "RGBA", [(i, 1, 2, 3) for i in range(8)]))
        return mesh

    def test_normals_colors_texture_and_vectors(self):
        out = self.convert(self.annotated(), "out.ply", "out.vtp")
        points, cells = out.GetPointData(), out.GetCellData()
        flat = [x for i in range(9) for x in (i / 3, 1, -i)]
        self.assert_array(points.GetNormals(), "vtkDoubleArray", flat)
        flat = [x for i in range(9) for x in (i / 8, 0.5)]
        self.assert_array(points.GetTCoords(), "vtkFloatArray", flat)
        flat = [x for i in range(9) for x in (i, 2, 255)]
        self.assert_array(points.GetScalars(), "vtkUnsignedCharArray", flat)
        for component, factor in enumerate((1, -1, 0)):
            values = [0.5 if factor == 0 else factor * i for i in range(9)]
            self.assert_array(points.GetArray(f"flow_{component}"), "vtkFloatArray", values)
        flat = [x for i in range(8) for x in (i, 1, 2, 3)]
        self.assert_array(cells.GetArray("RGBA"), "vtkUnsignedCharArray", flat)

    def test_read_by_vtk(self):
        self.convert(self.annotated(), "out.ply")
        plain = self.read_plainly("out.ply")
        self.assertEqual(points_of(plain), points_of(bumpy_grid(3, 0)))
        self.assertEqual(triangle_set(plain), triangle_set(self.convert(self.annotated(), "o.vtp")))
        points = plain.GetPointData()
        self.assertEqual(points.GetNormals().GetTuple(2), (vtk_float(2 / 3), 1, -2))
        self.assertEqual(points.GetTCoords().GetTuple(2), (0.25, 0.5))
        self.assertEqual(points.GetArray("RGB").GetTuple(3), (3, 2, 255))
        self.assertEqual(plain.GetCellData().GetArray("RGBA").GetTuple(5), (5, 1, 2, 3))

    def test_doubles_stay(self):
        mesh = make_mesh([(581311.123, 1e300, 1 / 3), (1, 0, -0.0), (0, math.nan, 5e-324)], [(0, 1, 2)])
        source = write_mesh(mesh, self.path("in.vtk"))
        self.succeed(source, "out.ply", "--quiet")
        self.succeed("out.ply", "out.vtk", "--quiet")
        out = read_mesh(self.path("out.vtk"))
        self.assert_array(out.GetPoints().GetData(), "vtkDoubleArray",
                          values_of(mesh.GetPoints().GetData()))

    def test_lines_become_edges(self):
        mesh = bumpy_grid(3, 0)
        mesh.SetLines(make_mesh([], [], [(0, 1, 2), (), (5,), (3, 4)]).GetLines())
        out = self.convert_by_vtk(mesh, "out.ply")
        self.assertEqual(cells_of(out.GetLines()), [(0, 1), (1, 2), (3, 4)])
        self.read_plainly("out.ply")

    def convert_by_vtk(self, mesh, name):
        """Like convert, but from a .vtk, which can hold more."""
        self.succeed(write_mesh(mesh, self.path("in.vtk")), name)
        self.succeed(name, "out.vtk")
        return read_mesh(self.path("out.vtk"))

    def test_cells_of_few_and_many_points(self):
        points = [(math.cos(i / 50), math.sin(i / 50), 0) for i in range(300)] + [(math.nan, 0, 0)]
        for cell in ((), (4,), (4, 5), tuple(range(301))):
            out = self.convert_by_vtk(make_mesh(points, [(0, 1, 2), cell]), "out.ply")
            self.assertIn(cell, [(), (4,), (4, 5)] + triangles_of(out) + [tuple(range(301))])
            if len(cell) < 3:
                self.assertEqual(triangles_of(out), [(0, 1, 2), cell])

    def test_what_does_not_fit_is_named(self):
        mesh = bumpy_grid(3, 0)
        points, cells = mesh.GetPointData(), mesh.GetCellData()
        points.AddArray(make_values("vtkStringArray", "words", [("a",)] * 9))
        points.AddArray(make_values("vtkLongLongArray", "huge", [(2**53,)] * 9))
        points.AddArray(make_values("vtkFloatArray", "x", [(1,)] * 9))
        cells.AddArray(make_values("vtkIntArray", "two words", [(1,)] * 8))
        cells.AddArray(make_values("vtkIntArray", "two_words", [(1,)] * 8))
        source = write_mesh(mesh, self.path("in.vtp"), SetDataModeToBinary=())
        said = self.succeed(source, "out.ply").stderr
        self.assertIn("point data (words, huge, x), cell data (two_words)\n", said)


def vtk_float(value):
    array = vtk.vtkFloatArray()
    array.InsertNextValue(value)
    return array.GetValue(0)


class Obj(WriterTest):
    def round_trip(self, text):
        """The mesh of an .obj, and the mesh of the file that the command makes from it."""
        self.write("in.obj", text)
        self.succeed("in.obj", "first.vtp")
        self.assertNotIn("cannot store", self.succeed("in.obj", "out.obj").stderr)
        self.succeed("out.obj", "second.vtp")
        return read_mesh(self.path("first.vtp")), read_mesh(self.path("second.vtp"))

    def assert_equal_data(self, first, second):
        for index in range(first.GetNumberOfArrays()):
            array = first.GetAbstractArray(index)
            if not array.GetName().endswith("Ids"):
                other = second.GetAbstractArray(array.GetName())
                self.assert_array(other, array.GetClassName(), values_of(array))

    def assert_round_trip(self, text):
        first, second = self.round_trip(text)
        self.assertEqual(points_of(first), points_of(second))
        for kind in ("GetVerts", "GetLines", "GetPolys"):
            self.assertEqual(cells_of(getattr(first, kind)()), cells_of(getattr(second, kind)()))
        self.assert_equal_data(first.GetPointData(), second.GetPointData())
        self.assert_equal_data(first.GetCellData(), second.GetCellData())
        return first, second

    def test_normals_texture_and_colors(self):
        _, out = self.assert_round_trip(
            "v 0 0 0 .1 .2 .3\nv 1 0 0 1 0 .5\nv 1 1 0 0 0 0\nv 0 1 0 1 1 1\nv 5 5 5 0 0 1\n"
            "vt 0 0\nvt 1 .5\nvt .3333333333333333 1\nvn 0 0 1\nvn 0 .1 1\n"
            "f 1/1/1 2/2/2 3/3/1\nf 1/1/1 3/3/1 4/2/2\nl 1 2 3\np 5\n"
        )
        data = out.GetPointData()
        self.assertEqual(data.GetNormals().GetTuple(1), (0, 0.1, 1))
        self.assertEqual(data.GetTCoords().GetTuple(2), (1 / 3, 1))
        self.assertEqual(data.GetTCoords().GetTuple(4), (0, 0))  # of no polygon
        self.assertEqual(data.GetArray("Colors").GetTuple(0), (0.1, 0.2, 0.3))
        plain = read_mesh(self.path("out.obj"))
        self.assertEqual(plain.GetNumberOfPolys(), 2)

    def test_colors_of_bytes(self):
        mesh = bumpy_grid(3, 0)
        colors = make_values("vtkUnsignedCharArray", "RGB", [(i, 0, 255) for i in range(9)])
        mesh.GetPointData().AddArray(colors)
        out = self.convert(mesh, "out.obj", "out.vtp")
        colors = out.GetPointData().GetArray("Colors")
        self.assertEqual(colors.GetTuple(3), (3 / 255, 0, 1))

    def test_float_points_stay_exact(self):
        mesh = make_mesh([], [(0, 1, 2)])
        points = vtk.vtkPoints()
        for point in ((0.1, 1 / 3, 1e-30), (1, 0, 0), (0, 1, math.inf)):
            points.InsertNextPoint(point)
        mesh.SetPoints(points)
        self.succeed(write_mesh(mesh, self.path("in.vtk")), "out.obj", "--quiet")
        self.succeed("out.obj", "out.vtp", "--quiet")
        self.assertEqual(points_of(read_mesh(self.path("out.vtp"))), points_of(mesh))


class Xml(WriterTest):
    def test_strings_with_zero_bytes_are_refused(self):
        """VTK's reader crashes on what its writer makes of them."""
        for add, size in (("GetFieldData", 5), ("GetPointData", 9), ("GetCellData", 8)):
            mesh = bumpy_grid(3, 0)
            words = make_values("vtkStringArray", "words", [("a",)] * size)
            getattr(mesh, add)().AddArray(words)
            source = write_mesh(mesh, self.path("in.vtk"), SetFileTypeToASCII=())
            self.succeed(source, "out.vtp")
            with open(source, encoding="ascii") as file:
                text = file.read()
            self.write("in.vtk", text.replace("\na\n", "\na%00b\n", 1))
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
                source = write_mesh(mesh, self.path("in.vtk"))
                if kind == "vtkIntArray":
                    self.succeed(source, "out.vtp")
                    ids = getattr(self.read_plainly("out.vtp"), add)().GetAbstractAttribute(
                        vtkDataSetAttributes.PEDIGREEIDS)
                    self.assert_array(ids, kind, list(range(size)))
                else:
                    self.fail_with(3, source, "new.vtp", naming=["new.vtp", "'ids'", ".vtk"])

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
        self.succeed(write_mesh(mesh, self.path("in.vtk")), "out.vtp")
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


if __name__ == "__main__":
    unittest.main(verbosity=2)

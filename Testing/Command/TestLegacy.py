# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's own files are read as VTK reads them: all versions, encodings and kinds of arrays."""

import unittest

from CommandTesting import cells_of, make_mesh, points_of, read_mesh, triangles_of, write_mesh
from TestBadFiles import BadFileTest
from vtkmodules import vtkCommonCore as core
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkIOLegacy import vtkPolyDataReader

TYPES = [
    core.vtkBitArray,
    core.vtkCharArray,
    core.vtkUnsignedCharArray,
    core.vtkShortArray,
    core.vtkUnsignedShortArray,
    core.vtkIntArray,
    core.vtkUnsignedIntArray,
    core.vtkLongArray,
    core.vtkUnsignedLongArray,
    core.vtkLongLongArray,
    core.vtkUnsignedLongLongArray,
    core.vtkIdTypeArray,
    core.vtkFloatArray,
    core.vtkDoubleArray,
]


def numbers(kind, name, tuples, components=1, step=1.0):
    array = kind()
    array.SetName(name)
    array.SetNumberOfComponents(components)
    array.SetNumberOfTuples(tuples)
    for i in range(tuples):
        for j in range(components):
            value = (i * components + j) % 7 * step
            array.SetComponent(i, j, value % 2 if kind is core.vtkBitArray else value)
    return array


def make_cells(cells):
    array = vtkCellArray()
    for cell in cells:
        array.InsertNextCell(len(cell), cell)
    return array


def strings(name, values):
    array = core.vtkStringArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    return array


def add_attributes(data, tuples):
    """One of each kind, and one more of some."""
    for kind in TYPES:
        components = 1 if kind is core.vtkBitArray else 2  # of more components VTK loses the bits
        data.AddArray(numbers(kind, kind.__name__ + " %x", tuples, components))
    named = numbers(core.vtkDoubleArray, "named", tuples, 3, 1 / 3)
    named.SetComponentName(0, "a b")
    named.SetComponentName(2, "c")
    data.AddArray(named)
    data.AddArray(strings("words", [f"w {i} ü\n" + "long" * 20 * i for i in range(tuples)]))
    for components, setter, extra in (
        (1, data.SetScalars, True),
        (3, data.SetVectors, True),
        (3, data.SetNormals, True),
        (9, data.SetTensors, False),
        (2, data.SetTCoords, False),
    ):
        setter(numbers(core.vtkDoubleArray, setter.__name__, tuples, components, 0.1))
        if extra:
            data.AddArray(numbers(core.vtkFloatArray, setter.__name__ + "2", tuples, components))
    table = vtkLookupTable()
    table.SetNumberOfTableValues(3)
    for i in range(3):
        table.SetTableValue(i, i / 255, 0.25, 1, 0.5)
    data.GetScalars().SetLookupTable(table)
    data.SetGlobalIds(numbers(core.vtkIdTypeArray, "global", tuples))
    data.SetPedigreeIds(numbers(core.vtkIntArray, "pedigree", tuples))


def rich_mesh():
    """Verts, lines and triangles, which are Delaunay already, with everything on them."""
    points = [(x, y + x / 16, 0) for x in range(4) for y in range(3)]
    mesh = make_mesh(points, [(0, 3, 1), (1, 3, 4)], [(0, 1, 2), (5, 8)])
    mesh.SetVerts(make_cells([(2,), (0,)]))
    add_attributes(mesh.GetPointData(), mesh.GetNumberOfPoints())
    add_attributes(mesh.GetCellData(), mesh.GetNumberOfCells())
    mesh.GetCellData().SetScalars(numbers(core.vtkUnsignedCharArray, "colors", 6, 3, 40))
    mesh.GetFieldData().AddArray(numbers(core.vtkIntArray, "field", 3, 2))
    mesh.GetFieldData().AddArray(strings("names", ["one", "", "two words"]))
    mesh.GetFieldData().AddArray(numbers(core.vtkDoubleArray, "none", 0))
    return mesh


def read_all(path):
    """VTK reads only the first attribute of each kind unless told otherwise."""
    reader = vtkPolyDataReader()
    reader.SetFileName(path)
    for kind in ("Scalars", "Vectors", "Normals", "Tensors", "TCoords", "Fields"):
        getattr(reader, f"ReadAll{kind}On")()
    reader.Update()
    return reader.GetOutput()


class AsVtkReads(BadFileTest):
    def same_array(self, one, other, label):
        self.assertIsNotNone(other, label)
        self.assertEqual(one.GetClassName(), other.GetClassName(), label)
        counts = (one.GetNumberOfComponents(), one.GetNumberOfTuples())
        self.assertEqual(counts, (other.GetNumberOfComponents(), other.GetNumberOfTuples()), label)
        for i in range(one.GetNumberOfTuples()):
            if one.IsNumeric():
                self.assertEqual(one.GetTuple(i), other.GetTuple(i), (label, i))
            else:
                self.assertEqual(one.GetValue(i), other.GetValue(i), (label, i))
        for i in range(one.GetNumberOfComponents()):
            self.assertEqual(one.GetComponentName(i), other.GetComponentName(i), label)

    def same_data(self, one, other, label):
        self.assertGreater(one.GetNumberOfArrays(), 2)
        for i in range(one.GetNumberOfArrays()):
            name = one.GetAbstractArray(i).GetName()
            array = other.GetAbstractArray(name)
            self.same_array(one.GetAbstractArray(i), array, (label, name))

    def same_attributes(self, one, other, label):
        for kind in range(one.NUM_ATTRIBUTES):
            arrays = [data.GetAbstractAttribute(kind) for data in (one, other)]
            names = [array.GetName() if array else None for array in arrays]
            self.assertEqual(*names, (label, kind))
        if one.GetScalars() and one.GetScalars().GetLookupTable():
            tables = [data.GetScalars().GetLookupTable().GetTable() for data in (one, other)]
            self.same_array(*tables, label)

    def written(self, mesh):
        """Writes the mesh with VTK in every version and encoding. Yields the names of the files."""
        for version in (42, 51):
            for encoding in ("ASCII", "Binary"):
                name = f"{encoding}{version}.vtk"
                settings = {f"SetFileTypeTo{encoding}": (), "SetFileVersion": (version,)}
                write_mesh(mesh, self.path(name), **settings)
                yield name

    def test_every_array(self):
        for name in self.written(rich_mesh()):
            self.succeed(name, "out.vtk")
            expected, found = read_all(self.path(name)), read_all(self.path("out.vtk"))
            self.assertEqual(points_of(expected), points_of(found), name)
            self.same_data(expected.GetFieldData(), found.GetFieldData(), name)
            for one, other in (
                (expected.GetPointData(), found.GetPointData()),
                (expected.GetCellData(), found.GetCellData()),
            ):
                self.same_data(one, other, name)
                self.same_attributes(one, other, name)

    def test_every_array_of_xml(self):
        mesh = rich_mesh()
        for data in (mesh.GetPointData(), mesh.GetCellData()):
            data.RemoveArray("vtkBitArray %x")  # VTK cannot read it back
        for mode in ("Ascii", "Binary", "Appended"):
            write_mesh(mesh, self.path("in.vtp"), **{f"SetDataModeTo{mode}": ()})
            self.succeed("in.vtp", "out.vtp")
            expected, found = read_mesh(self.path("in.vtp")), read_mesh(self.path("out.vtp"))
            self.assertEqual(points_of(expected), points_of(found), mode)
            for one, other in (
                (expected.GetPointData(), found.GetPointData()),
                (expected.GetCellData(), found.GetCellData()),
            ):
                self.same_data(one, other, mode)
                self.same_attributes(one, other, mode)

    def test_pieces_of_xml(self):
        piece = (
            '<Piece NumberOfPoints="3" NumberOfPolys="1"><PointData><DataArray type="Int32" '
            'Name="n" format="ascii"> {0}1 {0}2 {0}3 </DataArray></PointData><Points>'
            '<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 {0} 1 0 {0} 0 1 {0}'
            '</DataArray></Points><Polys><DataArray type="Int64" Name="connectivity" '
            'format="ascii">0 1 2</DataArray><DataArray type="Int64" Name="offsets" '
            'format="ascii">3</DataArray></Polys></Piece>'
        )
        self.write(
            "in.vtp",
            '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>'
            + piece.format(4)
            + piece.format(7)
            + "</PolyData></VTKFile>",
        )
        self.succeed("in.vtp", "out.vtk")
        found = read_all(self.path("out.vtk"))
        flat = [(0, 0), (1, 0), (0, 1)]
        self.assertEqual(points_of(found), [(x, y, z) for z in (4, 7) for x, y in flat])
        self.assertEqual(triangles_of(found), [(0, 1, 2), (3, 4, 5)])
        numbers_found = [found.GetPointData().GetArray("n").GetTuple1(i) for i in range(6)]
        self.assertEqual(numbers_found, [41, 42, 43, 71, 72, 73])

    def test_levels_of_ghosts(self):
        """As written by VTK before it had ghost types."""
        self.write(
            "in.vtk",
            "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
            "0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\nCELL_DATA 2\n"
            "FIELD f 1\nvtkGhostLevels 1 2 unsigned_char\n0 2\n",
        )
        self.succeed("in.vtk", "out.vtk")
        ghosts = read_all(self.path("out.vtk")).GetCellData().GetArray("vtkGhostType")
        self.assertEqual([ghosts.GetTuple1(i) for i in range(2)], [0, 1])

    def test_every_kind_of_cell(self):
        mesh = make_mesh([(x, y, 0) for x in range(4) for y in range(2)], [(0, 2, 3, 1)])
        mesh.SetStrips(make_cells([(2, 3, 4, 5), (4, 6, 5)]))
        mesh.SetVerts(make_cells([(7,), (0, 1)]))
        mesh.SetLines(make_cells([(0, 2, 4), (1, 3)]))
        for name in self.written(mesh):
            self.succeed(name, "out.vtk")
            found = read_all(self.path("out.vtk"))
            triangles = {tuple(sorted(cell)) for cell in triangles_of(found)}
            self.assertEqual(triangles, {(0, 2, 3), (0, 1, 3), (2, 3, 4), (3, 4, 5), (4, 5, 6)})
            self.assertEqual(cells_of(found.GetVerts()), [(7,), (0, 1)])
            self.assertEqual(cells_of(found.GetLines()), [(0, 2, 4), (1, 3)])


if __name__ == "__main__":
    unittest.main(verbosity=2)

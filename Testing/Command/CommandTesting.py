# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Helpers for the tests of the command: run it, make small meshes, and read its output."""

import json
import os
import random
import subprocess
import sys
import tempfile
import unittest

try:
    import vtkmodules.vtkCommonCore as vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkOBJWriter, vtkSTLReader, vtkSTLWriter
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader, vtkPolyDataWriter
    from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(125)

# VTK's reader and writer of each.
FORMATS = {
    ".vtk": (vtkPolyDataReader, vtkPolyDataWriter),
    ".vtp": (vtkXMLPolyDataReader, vtkXMLPolyDataWriter),
    ".ply": (vtkPLYReader, vtkPLYWriter),
    ".stl": (vtkSTLReader, vtkSTLWriter),
    ".obj": (vtkOBJReader, vtkOBJWriter),
}


class CommandTest(unittest.TestCase):
    """Runs the command in a new folder, in which it must leave no temporary file."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = self._folder.name

    def tearDown(self):
        left = [name for name in os.listdir(self.folder) if name.startswith(".delaunay-flip")]
        self.assertEqual(left, [], "temporary files are left")

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return name

    def content(self, name):
        """The bytes of a file."""
        with open(self.path(name), "rb") as file:
            return file.read()

    def write_mesh(self, mesh, name, **settings):
        """Writes with VTK's writer for the extension; `settings` are its methods and arguments.
        Returns the path."""
        path = self.path(name)
        writer = FORMATS[os.path.splitext(path)[1].lower()][1]()
        writer.SetFileName(path)
        writer.SetInputData(mesh)
        if hasattr(writer, "SetFileTypeToBinary"):
            writer.SetFileTypeToBinary()
        for method, arguments in settings.items():
            getattr(writer, method)(*arguments)
        writer.Write()
        return path

    def read_mesh(self, name):
        path = self.path(name)
        reader = FORMATS[os.path.splitext(path)[1].lower()][0]()
        reader.SetFileName(path)
        if path.endswith(".vtk"):  # else only the first attribute of each kind
            for kind in ("Scalars", "Vectors", "Normals", "Tensors", "TCoords", "Fields"):
                getattr(reader, f"ReadAll{kind}On")()
        reader.Update()
        return reader.GetOutput()

    def run_command(self, *arguments, **options):
        """Runs it. The result has returncode, stdout and stderr (text)."""
        return subprocess.run(
            command_line(*arguments),
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            timeout=120,
            check=False,
            **options,
        )

    def succeed(self, *arguments, code=0, **options):
        """Runs it and expects success."""
        result = self.run_command(*arguments, **options)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def fail_with(self, code, *arguments, naming=(), **options):
        """Runs it and expects this exit code and a one-line error with every word of `naming`."""
        result = self.run_command(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stderr}")
        errors = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
        self.assertEqual(len(errors), 1, result.stderr)
        self.assertNotRegex(errors[0], r"\(0x\w+\)")  # an object of VTK
        for word in naming:
            self.assertIn(word, errors[0])
        return result

    def report(self, *arguments, code=0):
        """Runs it with --report and returns the report."""
        path = self.path("report.json")
        self.succeed(*arguments, "--report", path, code=code)
        return read_report(path)


def command_line(*arguments):
    return [os.environ["DELAUNAYFLIP_COMMAND"], *map(str, arguments)]


def read_report(path):
    def refuse(constant):
        raise ValueError(f"{constant} is not JSON")

    with open(path, encoding="utf-8") as file:
        return json.load(file, parse_constant=refuse)


def make_cells(cells):
    array = vtkCellArray()
    for cell in cells:
        array.InsertNextCell(len(cell), cell)
    return array


def make_mesh(points, cells, lines=()):
    """A vtkPolyData with double points."""
    coordinates = vtkPoints()
    coordinates.SetDataTypeToDouble()
    for point in points:
        coordinates.InsertNextPoint(point)
    mesh = vtkPolyData()
    mesh.SetPoints(coordinates)
    mesh.SetPolys(make_cells(cells))
    mesh.SetLines(make_cells(lines))
    return mesh


def make_array(name, values):
    return make_values("vtkDoubleArray", name, [(value,) for value in values])


def worst_case(size):
    """The known slow case for flipping, with 2 * size points in two rows and 2 * size - 2
    triangles. It takes 2 * size - 3 iterations and (size - 1)^2 flips."""
    upper = [(size + 1.0 + i, 1.0, 0.0) for i in range(size)]
    lower = [(float(j), -1.0, 0.0) for j in range(size)]
    triangles = [(size, i + 1, i) for i in range(size - 1)]
    triangles += [(size - 1, size + j, size + j + 1) for j in range(size - 1)]
    return make_mesh(upper + lower, triangles)


def bumpy_grid(columns, height, seed=7):
    """A jittered grid of squares, each cut along a random diagonal; `height` 0 makes it planar,
    else it is a terrain. Coordinates are multiples of 2^-10, so that every format holds them."""
    generator = random.Random(seed)

    def jitter():
        return generator.randint(-200, 200) / 1024

    points = [
        (x + jitter(), y + jitter(), height * jitter())
        for y in range(columns)
        for x in range(columns)
    ]
    triangles = []
    for y in range(columns - 1):
        for x in range(columns - 1):
            a = y * columns + x
            b, c, d = a + 1, a + columns + 1, a + columns
            pairs = ((a, b, d), (b, c, d)), ((a, b, c), (a, c, d))
            triangles += generator.choice(pairs)
    return make_mesh(points, triangles)


def bad_mesh(columns):
    """A sheared grid. Most of its edges are bad."""
    mesh = bumpy_grid(columns, 0)
    for i, (x, y, z) in enumerate(points_of(mesh)):
        mesh.GetPoints().SetPoint(i, x + 2.5 * y, y, z)
    return mesh


def points_of(mesh):
    return [mesh.GetPoint(i) for i in range(mesh.GetNumberOfPoints())]


def cells_of(array):
    """The cells of a vtkCellArray as tuples of ids."""
    connectivity = array.GetConnectivityArray()
    offsets = array.GetOffsetsArray()
    ids = [int(connectivity.GetTuple1(i)) for i in range(connectivity.GetNumberOfTuples())]
    ends = [int(offsets.GetTuple1(i)) for i in range(offsets.GetNumberOfTuples())]
    return [tuple(ids[begin:end]) for begin, end in zip(ends, ends[1:])]


def triangles_of(mesh):
    return cells_of(mesh.GetPolys())


def turns_of(mesh):
    """Twice the signed area of each triangle in x and y; negative if it turns right."""
    points = points_of(mesh)
    for triangle in triangles_of(mesh):
        (ax, ay, _), (bx, by, _), (cx, cy, _) = (points[i] for i in triangle)
        yield (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


def triangle_set(mesh):
    """The triangles as coordinates, independent of their order and first corner."""
    points = points_of(mesh)
    corners = [[points[i] for i in triangle] for triangle in triangles_of(mesh)]
    return sorted(
        tuple(triangle[low:] + triangle[:low])
        for triangle in corners
        for low in [triangle.index(min(triangle))]
    )


def edge_counts(triangles):
    """(edges, edges with one triangle, edges with three or more), by counting."""
    uses = {}
    for a, b, c in triangles:
        for edge in ((a, b), (b, c), (c, a)):
            key = (min(edge), max(edge))
            uses[key] = uses.get(key, 0) + 1
    counts = list(uses.values())
    return len(counts), counts.count(1), sum(count > 2 for count in counts)


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


def tuples_of(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def same(first, second):
    """Equality for which a NaN equals itself."""
    return len(first) == len(second) and all(
        a == b or (a != a and b != b) for a, b in zip(first, second)
    )


class BadFileTest(CommandTest):
    def read(self, name, content):
        """The mesh that the command makes of a file with this content, and its messages."""
        self.write(name, content)
        result = self.succeed(name, "out.vtp")
        return self.read_mesh("out.vtp"), result.stderr

    def refuse(self, name, *naming):
        """Expects exit code 3, one line about the file and the reason, and no output."""
        before = sorted(os.listdir(self.folder))
        result = self.fail_with(3, name, "out.vtk", naming=[name, *naming])
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)


class ArrayTest(BadFileTest):
    """Compares arrays."""

    def convert(self, mesh, *names):
        """Passes a mesh through files with these names without losses. Returns the last mesh."""
        source = self.write_mesh(mesh, "in.vtp", SetDataModeToBinary=())
        for name in names:
            self.assertEqual(self.succeed(source, name).stderr, "", name)
            source = name
        return self.read_mesh(names[-1])

    def read_plainly(self, name):
        """The mesh that VTK's own reader reads, without errors or warnings."""
        window = vtk.vtkStringOutputWindow()
        before = vtk.vtkOutputWindow.GetInstance()
        vtk.vtkOutputWindow.SetInstance(window)
        try:
            mesh = self.read_mesh(name)
        finally:
            vtk.vtkOutputWindow.SetInstance(before)
        self.assertEqual(window.GetOutput(), "", name)
        return mesh

    def assert_array(self, array, kind, values):
        self.assertIsNotNone(array)
        self.assertEqual(array.GetDataType(), getattr(vtk, kind)().GetDataType(), array.GetName())
        self.assertTrue(same(values_of(array), values), f"{array.GetName()}: {values_of(array)}")

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every input format to every output format: what each keeps, and what the command reports."""

import os

from CommandTesting import (
    FORMATS, CommandTest, bumpy_grid, make_array, make_mesh, triangle_set, triangles_of)


def annotated_mesh():
    """A planar mesh with a line, point and cell data, an isolated point, and thirds as
    coordinates."""
    mesh = bumpy_grid(5, 0)
    mesh.GetPoints().SetPoint(0, -1 / 3, -2 / 3, 0)
    mesh.GetPoints().InsertNextPoint(1 / 3, -2 / 3, 0)
    lines = make_mesh([], [], [(0, 1, 2)])
    mesh.SetLines(lines.GetLines())
    mesh.GetPointData().AddArray(make_array("depth", [i / 7 for i in range(26)]))
    mesh.GetCellData().AddArray(make_array("region", [i / 3 for i in range(33)]))
    return mesh


class RoundTrip(CommandTest):
    def convert_all(self, mesh):
        """The resulting triangles are the same for every pair of formats."""
        results = {}
        for source in FORMATS:
            path = self.write_mesh(mesh, "in" + source)
            for target in FORMATS:
                self.succeed(path, "out" + target)
                results[source, target] = triangle_set(self.read_mesh("out" + target))
        return results

    def test_every_pair_of_formats(self):
        for height in (0, 1):
            mesh = bumpy_grid(8, height)
            results = self.convert_all(mesh)
            first = results[".vtk", ".vtk"]
            self.assertNotEqual(first, triangle_set(mesh), "nothing was flipped")
            self.assertEqual(len(first), 98)
            for pair, result in results.items():
                self.assertEqual(result, first, pair)


class Kept(CommandTest):
    def test_same_path(self):
        for extension in FORMATS:
            path = self.write_mesh(bumpy_grid(6, 0), "mesh" + extension)
            self.succeed(path, "separate" + extension)
            self.succeed(path, path)
            same, separate = (self.content(name + extension) for name in ("mesh", "separate"))
            self.assertEqual(same, separate)


class Lost(CommandTest):
    def losses(self, mesh, name):
        """The line that lists losses, or an empty string."""
        result = self.succeed(self.write_mesh(mesh, "in.vtk"), name)
        lines = [line for line in result.stderr.splitlines() if "cannot store" in line]
        self.assertLessEqual(len(lines), 1)
        return "".join(lines)

    def test_losses_are_named_in_one_line(self):
        arrays = ["point data (depth)", "cell data (region)"]
        for extension, words in {
            ".ply": ["cannot store: cell data (region)"],
            ".stl": arrays + ["lines (1)", "double precision", "unused points (1)"],
            ".obj": arrays,
        }.items():
            line = self.losses(annotated_mesh(), "out" + extension)
            for word in words + ["note: out" + extension]:
                self.assertIn(word, line)

    def test_points_of_an_stl(self):
        """Two of the three points are the same as float."""

        def triangle(x):
            return make_mesh([(x, 0, 0), (x + 2**-10, 0, 0), (x, 1, 0), (1e300, 0, 0)], [(0, 1, 2)])

        line = self.losses(triangle(2.0**20 + 2**-10), "out.stl")
        self.assertIn("double precision of the points (coordinates change by up to 0.002, 1 point", line)
        self.assertIn("fall on others)", line)
        line = self.losses(triangle(0.1), "out.stl")
        self.assertRegex(line, r"the points \(coordinates change by up to \S+e-09\)")

    def test_points_beyond_float(self):
        """Such points would be infinite as floats."""
        mesh = make_mesh([(0, 0, 0), (1e39, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        path = self.write_mesh(mesh, "in.vtk")
        words = ["out.stl", "cannot be written", "larger than 3.4e38", ".ply"]
        self.fail_with(3, path, "out.stl", naming=words)
        self.succeed(path, "out.ply")

    def test_cells_of_too_few_points(self):
        """VTK's .vtp writer crashes on them."""
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
        for size in (0, 1, 2):
            mesh = make_mesh(points, [(0, 1, 2), tuple(range(size))])
            path = self.write_mesh(mesh, "in.vtk")
            self.succeed(path, "out.vtk")
            self.assertEqual(triangles_of(self.read_mesh("out.vtk"))[1], tuple(range(size)))
            for name in ("out.vtp", "out.obj", "out.stl"):
                self.fail_with(3, path, name, naming=[name, f"polygon 1 has {size} point"])
        lines = make_mesh(points, [(0, 1, 2)], [(1,)])
        for name in ("out.vtp", "out.obj"):
            path = self.write_mesh(lines, "in.vtk")
            self.fail_with(3, path, name, naming=[name, "line 0 has 1 point,"])


class Solids(CommandTest):
    def test_several_solids_are_labels(self):
        """Two coplanar triangles with a bad edge. The words after "end" may be apart."""
        facet = ("facet normal 0 0 1\nouter loop\nvertex {}\nvertex {}\nvertex {}\nend loop\n"
                 "end facet\n")
        first = facet.format("0 0 0", "4 0 0", "2 1 0")
        second = facet.format("4 0 0", "0 0 0", "2 -1 0")
        self.write("in.stl", f"solid a b\n{first}end solid\nsolid a b\n{second}End Solid a b\n")
        self.assertIn("--region-array Solid keeps", self.succeed("in.stl", "out.vtp").stderr)
        self.assertEqual(self.report("in.stl", "out.vtp")["total_flips"], 1)
        self.assertEqual(self.report("in.stl", "out.vtp", "--region-array", "Solid")["total_flips"], 0)
        mesh = self.read_mesh("out.vtp")
        self.assertEqual([mesh.GetCellData().GetArray("Solid").GetValue(i) for i in (0, 1)], [0, 1])
        self.assertEqual(mesh.GetFieldData().GetAbstractArray("SolidNames").GetValue(1), "a b")
        self.write("one.stl", f"solid a\n{first}end solid\n")
        self.assertEqual(self.succeed("one.stl", "out.stl").stderr, "")


class RepeatedPoints(CommandTest):
    def test_obj_keeps_vertices_that_it_repeats(self):
        """Some programs write a vertex for every normal. The edge is then a boundary."""
        self.write(
            "in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\n"
            "f 1//1 2//1 3//1\nf 4//2 5//2 6//2\n")
        self.assertIn("no two share an edge", self.succeed("in.obj", "out.vtk").stderr)
        self.assertEqual(triangles_of(self.read_mesh("out.vtk")), [(0, 1, 2), (3, 4, 5)])

    def test_collapsed_stl_triangle_stays(self):
        mesh = make_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 1)], [(0, 1, 2), (1, 1, 3)])
        report = self.report(self.write_mesh(mesh, "in.stl"), "out.stl")
        self.assertEqual((report["points"], report["triangles"]), (4, 2))
        self.assertEqual(os.path.getsize(self.path("out.stl")), 84 + 2 * 50)

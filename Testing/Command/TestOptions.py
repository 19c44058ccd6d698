# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the options reach the filter, each with a mesh for which the option matters."""

import math
import os
import resource

from CommandTesting import (
    CommandTest, bad_mesh, bumpy_grid, cells_of, make_cells, make_mesh, make_values, points_of, triangle_set,
    triangles_of, values_of)

# Divided along its long diagonal.
KITE = [(-2.0, 0.0, 0.0), (0.0, -1.0, 0.0), (2.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
KITE_CELLS = [(0, 1, 2), (0, 2, 3)]


class Options(CommandTest):
    def flips(self, mesh, *arguments):
        path = self.write_mesh(mesh, "in.vtk")
        return self.report(path, "out.vtk", *arguments)["total_flips"]

    def test_lines(self):
        mesh = make_mesh(KITE, KITE_CELLS, [(2, 0)])
        self.assertEqual(self.flips(mesh), 0)
        self.assertEqual(self.flips(mesh, "--ignore-lines"), 1)

    def test_constraints(self):
        """A kite cut along its short diagonal 1-3. A file with the same points has the long one."""
        tall = [(0, -2, 0), (1, 0, 0), (0, 2, 0), (-1, 0, 0)]
        mesh = make_mesh(tall, [(0, 1, 3), (1, 2, 3)])
        path = self.write_mesh(mesh, "in.vtk")
        lines = self.write_mesh(make_mesh(tall, [], [(0, 2)]), "lines.vtk")
        counts = ("inserted_constraints", "constraint_flips", "constraint_edges",
                  "unmatched_constraints")

        def constrain(*arguments):
            report = self.report(path, "out.vtk", *arguments)
            return [report[key] for key in counts]

        self.assertEqual(constrain(), [0, 0, 0, 0])
        self.assertEqual(constrain("--constraints", lines), [1, 1, 1, 0])
        self.assertTrue(self.has_edge(0, 2))
        self.assertEqual(constrain("--constraints", lines, "--no-insert-constraints"), [0, 0, 0, 1])
        self.assertFalse(self.has_edge(0, 2))
        none = self.write_mesh(make_mesh(tall, []), "none.vtk")
        self.fail_with(3, path, "out.vtk", "--constraints", none, naming=["none.vtk: has no lines"])

    def has_edge(self, a, b):
        """Whether the output has this edge."""
        triangles = triangles_of(self.read_mesh("out.vtk"))
        return any(a in triangle and b in triangle for triangle in triangles)

    def test_lines_are_inserted_on_request(self):
        mesh = make_mesh(KITE, [(0, 1, 3), (1, 2, 3)], [(0, 2)])
        self.assertEqual(self.flips(mesh), 0)
        path = self.path("in.vtk")
        result = self.succeed(path, "out.vtk", "--insert-lines")
        self.assertIn("1 edge kept, 1 inserted by 1 flip, 0 not in the mesh", result.stdout)
        self.assertTrue(self.has_edge(0, 2))

    def test_constraints_beside_the_mesh(self):
        """The message says why they do not match, and where the first is."""
        path = self.write_mesh(make_mesh(KITE, KITE_CELLS), "in.vtk")
        beside = [(-2, 0, 0), (0, 1, 0), (0, 1.5, 0), (2, 0, 0)]
        lines = self.write_mesh(make_mesh(beside, [], [(0, 1), (3, 2), (2, 0)]), "lines.vtk")
        self.assertIn("2 constraint edges of the second input that the mesh does not have: ends are "
                      "not points of the mesh (coordinates must be equal, not just close), first "
                      "from (0, 1.5, 0) to (2, 0, 0)\n",
                      self.succeed(path, "out.vtk", "--constraints", lines).stderr)

    def test_merged_points(self):
        """Triangles that share no points cannot flip, which a warning says, until these are merged."""
        corners = [KITE[i] for cell in KITE_CELLS for i in cell]
        path = self.write_mesh(make_mesh(corners, [(0, 1, 2), (3, 4, 5)]), "in.vtk")
        told = self.succeed(path, "out.vtk").stderr
        self.assertEqual(told.count("\n"), 1, told)
        self.assertIn("warning: 2 triangles of which no two share an edge", told)
        self.assertIn("--merge-points", told)
        result = self.succeed(path, "out.vtk", "--merge-points")
        self.assertIn("in.vtk: of 6 points 4 are left after merging\n", result.stderr)
        self.assertIn("flips           1 in 1 iteration, converged\n", result.stdout)
        self.assertEqual(len(points_of(self.read_mesh("out.vtk"))), 4)

    def test_merging_keeps_data_and_cells(self):
        """Also if a point lies at infinity. A side that has collapsed leaves its quad; a triangle that has
        collapsed is left out."""
        corners = [(math.inf, 0, 0)] + [KITE[i] for cell in KITE_CELLS for i in cell] + KITE[:3]
        cells = [(1, 2, 3), (4, 5, 6), (7, 8, 8), (0, 8, 9), (1, 7, 8, 9)]
        mesh = make_mesh(corners, cells, [(1, 7), (2, 9)])
        size = len(corners)
        data = mesh.GetPointData()
        values = {"vtkIntArray": 2**24 + 1, "vtkLongLongArray": 2**53 + 1, "vtkDoubleArray": 1 / 3}
        for kind, first in values.items():
            data.AddArray(make_values(kind, kind, [(first + i,) for i in range(size)]))
        data.SetScalars(make_values("vtkUnsignedCharArray", "RGB", [(i, 200, 255) for i in range(size)]))
        data.SetGlobalIds(make_values("vtkIdTypeArray", "ids", [(i,) for i in range(size)]))
        data.AddArray(make_values("vtkStringArray", "words", [(f"w {i}",) for i in range(size)]))
        data.AddArray(make_values("vtkIntArray", "short", [(1,)] * 3))
        mesh.GetCellData().AddArray(make_values("vtkIntArray", "cell", [(i,) for i in range(7)]))
        path = self.write_mesh(mesh, "in.vtk")
        told = self.succeed(path, "out.vtp", "--merge-points").stderr
        self.assertIn(f"in.vtk: of {size} points 5 are left after merging; 1 polygon left out (first: 4), "
                      "because its corners are fewer than three places\n", told)
        self.assertIn("in.vtk: left out point data with too few tuples (short)\n", told)
        out = self.read_mesh("out.vtp")
        self.assertEqual(cells_of(out.GetLines()), [(1, 1), (2, 3)])
        self.assertEqual(values_of(out.GetCellData().GetArray("cell")), [0, 1, 2, 3, 5, 6])
        self.assertEqual(triangles_of(out), [(1, 2, 3), (1, 3, 4), (0, 2, 3), (1, 2, 3)])
        self.assertEqual(points_of(out), corners[:4] + [corners[6]])
        found = out.GetPointData()
        for index in range(data.GetNumberOfArrays() - 1):
            array = data.GetAbstractArray(index)
            other = found.GetAbstractArray(array.GetName())
            self.assertEqual(other.GetDataType(), array.GetDataType(), array.GetName())
            count = array.GetNumberOfComponents()
            expected = [array.GetValue(count * i + c) for i in (0, 1, 2, 3, 6) for c in range(count)]
            self.assertEqual(values_of(other), expected, array.GetName())
        self.assertEqual((found.GetScalars().GetName(), found.GetGlobalIds().GetName()), ("RGB", "ids"))
        self.assertIsNone(found.GetAbstractArray("short"))
        for name in ("out.ply", "out.obj", "out.stl", "out.vtk"):
            self.succeed(path, name, "--merge-points")

    def test_duplicates_are_dropped(self):
        """A sheet with two sides, which never flips."""
        cells = [*KITE_CELLS, *[cell[::-1] for cell in KITE_CELLS]]
        mesh = make_mesh(KITE, cells)
        mesh.GetCellData().AddArray(make_values("vtkIntArray", "cell", [(i,) for i in range(4)]))
        self.assertEqual(self.flips(mesh), 0)
        result = self.succeed(self.path("in.vtk"), "out.vtk", "--drop-duplicates")
        self.assertIn("in.vtk: 2 polygons left out as duplicates\n", result.stderr)
        self.assertIn("flips           1 in 1 iteration, converged\n", result.stdout)
        for cells in [(1, 2, 1), (2, 1, 2)], [(1, 1, 2), (2, 2, 1)], [(0, 1, 0, 2), (0, 2, 0, 1)]:
            path = self.write_mesh(make_mesh(KITE, [*KITE_CELLS, *cells]), "flat.vtk")
            told = self.succeed(path, "flat.vtp", "--drop-duplicates").stderr
            self.assertIn("flat.vtk: 1 polygon left out as a duplicate\n", told)
        out = self.read_mesh("out.vtk")
        self.assertEqual(values_of(out.GetCellData().GetArray("cell")), [0, 1])
        self.assertTrue(self.has_edge(1, 3))

    def test_repairs_of_strips_and_repeated_corners(self):
        """Strips and polygons that repeat a corner are repaired as triangles are."""
        mesh = make_mesh(KITE, [(0, 1, 2, 2), (0, 3, 2), (0, 0, 3, 2)])
        mesh.SetStrips(make_cells([(1, 0, 2)]))
        mesh.GetCellData().AddArray(make_values("vtkIntArray", "cell", [(i,) for i in range(4)]))
        path = self.write_mesh(mesh, "in.vtk")
        result = self.succeed(path, "out.vtk", "--drop-duplicates", "--orient")
        self.assertIn("in.vtk: 2 polygons left out as duplicates\n", result.stderr)
        self.assertIn("in.vtk: 1 polygon turned over", result.stderr)
        self.assertIn("flips           1 in 1 iteration, converged\n", result.stdout)
        self.assertEqual(values_of(self.read_mesh("out.vtk").GetCellData().GetArray("cell")), [0, 1])

    def test_collapsed_polygons_have_no_edges(self):
        """They are no third polygon of an edge, here of 0-2, which is to flip."""
        for polygons in [(0, 2, 2)], [(2, 0, 2, 0)], [(0, 0, 2), (2, 2, 0)]:
            cells = [KITE_CELLS[0], KITE_CELLS[1][::-1], *polygons]
            path = self.write_mesh(make_mesh(KITE, cells), "in.vtk")
            result = self.succeed(path, "out.vtk", "--orient")
            self.assertIn("in.vtk: 1 polygon turned over", result.stderr)
            self.assertIn("flips           1 in 1 iteration, converged\n", result.stdout)
        merged = self.write_mesh(make_mesh([*KITE, KITE[0], KITE[2]], [*KITE_CELLS, (0, 2, 4, 5)]), "in.vtk")
        result = self.succeed(merged, "out.vtk", "--merge-points")
        self.assertIn("1 polygon left out (first: 2)", result.stderr)
        self.assertIn("flips           1 in 1 iteration, converged\n", result.stdout)

    def test_fewer_triangles_are_turned_over(self):
        """Also if they come first; in each connected part."""
        apart = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (.5, .4, 0)]
        fan = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
        cells = [fan[0][::-1], *fan[1:], *[(a + 5, c + 5, b + 5) for a, b, c in fan]]
        mesh = make_mesh([*apart, *[(x + 5, y, z) for x, y, z in apart]], cells)
        path = self.write_mesh(mesh, "in.vtk")
        result = self.succeed(path, "out.vtk", "--orient", "--max-iterations", "0")
        self.assertIn("in.vtk: 1 polygon turned over", result.stderr)
        self.assertEqual(triangles_of(self.read_mesh("out.vtk"))[1:], cells[1:])

    def test_parts_without_gain_are_left_alone(self):
        """A Moebius band stays; polygons of one or two corners do not end the run."""
        count = 12
        band = [(math.cos(math.tau * i / count) * r, math.sin(math.tau * i / count) * r, z)
                for i in range(count) for r, z in ((1, 0), (2, math.sin(math.pi * i / count)))]
        cells = []
        for i in range(count):
            low, high = (2 * i + 2, 2 * i + 3) if i + 1 < count else (1, 0)
            cells += [(2 * i, 2 * i + 1, high), (2 * i, high, low)]
        for more in [], [(3,), (3, 4), (3, 4, 3), (0, 0)]:
            mesh = make_mesh(band, [*more, *cells])
            path = self.write_mesh(mesh, "in.vtk")
            result = self.succeed(path, "out.vtk", "--orient", "--max-iterations", "0", code=4)
            self.assertIn("in.vtk: 0 polygons turned over", result.stderr)
            self.assertEqual(triangles_of(self.read_mesh("out.vtk"))[-len(cells):], cells)

    def test_winding_is_made_consistent(self):
        mesh = make_mesh(KITE, [KITE_CELLS[0], KITE_CELLS[1][::-1]], [(0, 1)])
        mesh.GetCellData().AddArray(make_values("vtkIntArray", "cell", [(i,) for i in range(3)]))
        self.assertEqual(self.flips(mesh), 0)
        result = self.succeed(self.path("in.vtk"), "out.vtk", "--orient")
        self.assertIn("in.vtk: 1 polygon turned over to be wound like its neighbours\n", result.stderr)
        self.assertTrue(self.has_edge(1, 3))
        self.assertEqual(values_of(self.read_mesh("out.vtk").GetCellData().GetArray("cell")), [0, 1, 2])
        self.assertEqual(cells_of(self.read_mesh("out.vtk").GetLines()), [(0, 1)])

    def test_nothing_to_merge(self):
        apart = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (5, 1, 0)]
        path = self.write_mesh(make_mesh(apart, [(0, 1, 2), (3, 4, 5)]), "in.vtk")
        told = self.succeed(path, "out.vtk", "--merge-points").stderr
        self.assertIn("no two edges lie at the same place, even after --merge-points", told)

    def test_region_array(self):
        mesh = make_mesh(KITE, KITE_CELLS)
        mesh.GetCellData().AddArray(make_values("vtkIntArray", "Rock", [(1,), (2,)]))
        self.assertEqual(self.flips(mesh), 1)
        self.assertEqual(self.flips(mesh, "--region-array", "Rock"), 0)
        path = self.path("in.vtk")
        for name in ("Sand", "ring 1", "Tolerance"):
            self.fail_with(2, path, "out.vtk", "--region-array", name, naming=[f'"{name}"', 'it has "Rock"'])

    def test_quality(self):
        path = self.write_mesh(make_mesh(KITE, KITE_CELLS), "in.vtk")
        for name in ("out.vtk", "out.vtp"):
            self.succeed(path, name)
            self.assertEqual(self.angles(name), [])
            self.succeed(path, name, "--quality")
            before, after = self.angles(name)
            self.assertAlmostEqual(before, math.degrees(math.atan(1 / 2)))
            self.assertAlmostEqual(after, 2 * math.degrees(math.atan(1 / 2)))
        self.fail_with(2, path, "out.ply", "--quality", naming=["--quality", ".vtp"])

    def angles(self, name):
        """The smallest values of the arrays that --quality adds."""
        data = self.read_mesh(name).GetCellData()
        arrays = [data.GetArray(f"Smallest angle {when} (degrees)") for when in ("before", "after")]
        return [array.GetRange()[0] for array in arrays if array]

    def test_feature_angle(self):
        """A roof of 90 degrees. Its ridge is the long diagonal."""
        points = [(-2, 0, 0), (0, -1, -1), (2, 0, 0), (0, 1, -1)]
        mesh = make_mesh(points, KITE_CELLS)
        self.assertEqual(self.flips(mesh), 0)
        self.assertEqual(self.flips(mesh, "--feature-angle", "85"), 0)
        self.assertEqual(self.flips(mesh, "--feature-angle", "95"), 1)

    def test_max_deviation(self):
        """A quad with diagonals 0.25 apart; the bounding box's diagonal is 8.25."""
        mesh = make_mesh([(-4, 0, 0), (0, -1, 0.25), (4, 0, 0), (0, 1, 0.25)], KITE_CELLS)
        surface = ("--geometry", "surface")
        for bound, flips in (("inf", 1), ("0.25", 1), ("0.249", 0), ("0", 0), ("3.1%", 1), ("3%", 0)):
            self.assertEqual(self.flips(mesh, *surface, "--max-deviation", bound), flips, bound)
        mesh.GetPoints().InsertNextPoint(math.inf, 0, 0)  # not in the bounding box
        for bound, flips in (("3.1%", 1), ("3%", 0)):
            self.assertEqual(self.flips(mesh, *surface, "--max-deviation", bound), flips, bound)
        text = self.succeed("in.vtk", "out.vtk", *surface, "--max-deviation", "0.1").stdout
        self.assertIn("bad edges       1 -> 1 (1 blocked: would deviate)\n", text)
        self.assertEqual(self.flips(mesh, "--max-deviation", "0"), 1)

    def test_tolerance(self):
        """The opposite angles sum to about pi + 0.01."""
        mesh = make_mesh([(-1, 0, 0), (0, -0.995, 0), (1, 0, 0), (0, 0.995, 0)], KITE_CELLS)
        angles = ("--criterion", "opposite-angles")
        self.assertEqual(self.flips(mesh, *angles), 1)
        self.assertEqual(self.flips(mesh, *angles, "--tolerance", "0.009"), 1)
        self.assertEqual(self.flips(mesh, *angles, "--tolerance", "0.011"), 0)
        self.assertEqual(self.flips(mesh, "--tolerance", "0.011"), 1)

    def test_tie_rule(self):
        """A square has two Delaunay triangulations."""
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        results = []
        for cells in (KITE_CELLS, [(0, 1, 3), (1, 2, 3)]):
            mesh = make_mesh(points, cells)
            self.assertEqual(self.flips(mesh), 0)
            self.flips(mesh, "--tie-rule", "canonical")
            results.append(triangle_set(self.read_mesh("out.vtk")))
        self.assertEqual(results[0], results[1])

    def test_geometry(self):
        mesh = bumpy_grid(6, 1)
        path = self.write_mesh(mesh, "in.vtk")
        for geometry in ("planar-xy", "surface"):
            report = self.report(path, "out.vtk", "--geometry", geometry)
            self.assertEqual(report["geometry_used"], geometry)
        self.assertEqual(self.report(path, "out.vtk")["geometry_used"], "planar-xy")
        flat = self.write_mesh(bumpy_grid(6, 0), "flat.vtk")
        self.assertEqual(self.report(flat, "out.vtk")["geometry_used"], "planar")

    def test_pieces(self):
        path = self.write_mesh(bad_mesh(23), "in.vtk")
        meshes = []
        for pieces in (1, 5):
            report = self.report(path, "out.vtk", "--tie-rule", "canonical", "--pieces", pieces)
            self.assertEqual((report["converged"], report["non_delaunay_after"]), (True, 0))
            meshes.append(self.read_mesh("out.vtk"))
        self.assertEqual(triangle_set(meshes[0]), triangle_set(meshes[1]))
        self.assertNotEqual(triangles_of(meshes[0]), triangles_of(meshes[1]))
        rough = self.write_mesh(bumpy_grid(12, 3), "in.vtk")
        told = self.succeed(rough, "out.vtk", "--geometry", "surface", "--pieces", 2)
        self.assertNotIn("constraint", told.stdout + told.stderr)


class ManyThreads(CommandTest):
    def test_more_than_there_is_memory_for(self):
        path = self.write_mesh(bad_mesh(71), "in.vtk")
        arguments = (path, "out.vtk", "--backend", "threads", "--threads")
        backend = self.report(*arguments, 65536)["backend"]
        self.assertLessEqual(int(backend.split()[1]), max(16, 2 * os.cpu_count()))
        expected = self.content("out.vtk")
        for megabytes in (200, 250, 300, 350, 400, 500, 800):  # with room for a few of their stacks
            limit = megabytes << 20
            result = self.run_command(
                *arguments, "2000",
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            if result.returncode == 0:
                self.assertEqual(self.content("out.vtk"), expected)
            else:
                self.assertEqual(result.returncode, 3)
                # The second is said where VTK itself ends the process.
                self.assertRegex(result.stderr, "not enough memory|was there enough memory")
        self.assertEqual(result.returncode, 0)  # 800 MiB are enough

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The helpers for PyVista, trimesh, meshio and laspy, beside which the package must be installed, and the
notebook."""
import doctest
import importlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy

import delaunayflip

NOTEBOOK = pathlib.Path(__file__).parents[2] / "Examples" / "Python" / "pyvista_flips.ipynb"


def load(name):
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise unittest.SkipTest(f"no {name}: {error}") from None


KITE = [[0.0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]]
LONG, SHORT = [[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]  # diagonals


def as_set(faces):
    return {frozenset(face) for face in numpy.asarray(faces).tolist()}


class Docstrings(unittest.TestCase):

    def test_docstrings(self):
        for other in ("pyvista", "trimesh", "meshio", "laspy"):
            with self.subTest(other):
                load(other)
                results = doctest.testmod(importlib.import_module(f"delaunayflip.{other}"))
                self.assertGreater(results.attempted, 0)
                self.assertEqual(results.failed, 0)


class MeshIO(unittest.TestCase):

    def test_cells(self):
        meshio = load("meshio")
        from delaunayflip.meshio import flip
        cells = [("triangle", LONG[:1]), ("vertex", [[3]]), ("triangle", LONG[1:])]
        better = flip(meshio.Mesh(KITE, cells, cell_data={"n": [[5], [6], [7]]}), regions=0)
        self.assertEqual([block.type for block in better.cells], ["triangle", "vertex", "triangle"])
        self.assertEqual(as_set(better.cells_dict["triangle"]), as_set(SHORT))
        self.assertEqual([values.tolist() for values in better.cell_data["n"]], [[5], [6], [7]])
        for kind, other in ((numpy.uint64, numpy.int64), (numpy.int32, float)):
            cells = [("triangle", numpy.array(LONG, kind)), ("triangle", numpy.empty((0, 3), other))]
            self.assertEqual(as_set(flip(meshio.Mesh(KITE, cells)).cells[0].data), as_set(SHORT))
        for faces, line, constraints, expected in (
                (LONG, [0, 2], None, LONG),  # a line stays, but is not inserted
                (SHORT, [0, 2], None, SHORT), (SHORT, [0, 1], [[0, 2]], LONG)):
            made = flip(meshio.Mesh(KITE, [("triangle", faces), ("line", [line])]),
                        constraints=constraints)
            self.assertEqual(as_set(made.cells[0].data), as_set(expected))
        lined = meshio.Mesh(KITE, [("triangle", LONG), ("line", [[0, 1], [1, 2]])])
        with self.assertRaises(delaunayflip.InvalidMesh) as told:
            flip(lined, constraints=[[0, 3], [1, 77]])
        self.assertEqual((told.exception.cell, told.exception.point), (1, 77))
        with self.assertRaisesRegex(TypeError, "meshio.Mesh, not list"):
            flip(KITE)

    def test_edges_of_other_cells_stay(self):
        meshio = load("meshio")
        from delaunayflip.meshio import flip
        points = [*KITE, [2, 0, 1]]
        flat = [[0.0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0], [6, 1, 0], [6, -1, 0]]
        for given, kind, cell in (
                (points, "tetra", [0, 1, 2, 4]), (points, "quad", [0, 4, 2, 4]),
                (points, "tetra10", [0, 4, 2, 4, 4, 4, 4, 4, 4, 4]), (flat, "line3", [0, 2, 5]),
                (points, "polyhedron4", [[0, 4, 2], [0, 2, 4], [0, 4, 4]])):
            with self.subTest(kind), warnings.catch_warnings():
                warnings.simplefilter("error")
                mesh = meshio.Mesh(given, [("triangle", LONG), (kind, [cell])])
                better, report = flip(mesh, return_report=True)
                self.assertEqual(as_set(better.cells[0].data), as_set(LONG))
                self.assertEqual((report.total_flips, report.unmatched_constraints), (0, 0))
        collapsed = [("triangle", [*SHORT, [0, 2, 2]]), ("line3", [[0, 2, 0]])]  # 0-2 is no edge
        self.assertEqual(flip(meshio.Mesh(points, collapsed), return_report=True)[1].unmatched_constraints, 0)
        apart = meshio.Mesh(points, [("triangle", LONG), ("tetra", [[0, 1, 4, 3]])])
        self.assertEqual(as_set(flip(apart).cells[0].data), as_set(SHORT))
        with self.assertRaises(delaunayflip.InvalidMesh):
            flip(meshio.Mesh(points, [("triangle", [[0, 1, 9]]), ("tetra", [[0, 1, 7, -3]])]))

    def test_borders_of_labels_stay(self):
        meshio = load("meshio")
        from delaunayflip.meshio import flip
        one, two = [("triangle", LONG)], [("triangle", LONG[:1]), ("triangle", LONG[1:])]
        labels = {"gmsh:physical": [numpy.array([[3], [4]])], "medit:ref": [numpy.array([1, 1])],
                  "mine": [numpy.array([8, 9])]}
        sets = {"steel": [numpy.array([1])], "gmsh:bounding_entities": [numpy.array([7])]}
        bare = {name: labels[name] for name in ("medit:ref", "mine")}
        for cells, data, cell_sets, regions, expected in (
                (two, {}, {}, None, LONG), (two, {}, {}, 0, SHORT), (two, {}, {}, [5, 5], SHORT),
                (one, labels, {}, None, LONG), (one, bare, {}, None, SHORT),
                (one, bare, {}, "mine", LONG), (one, {"mine": [numpy.array([None, "steel"])]}, {}, "mine", LONG),
                (one, {"mine": [numpy.array([None, None])]}, {}, "mine", SHORT), (one, labels, sets, "medit:ref", SHORT),
                (one, {}, sets, None, LONG), (one, {}, sets, 0, SHORT),
                (one, {}, {"flags": [numpy.array([False, True])]}, None, LONG),
                (one, {}, {"all": [[0, 1]], "none": [None]}, None, SHORT)):
            with self.subTest(data=data, sets=cell_sets, regions=regions):
                mesh = meshio.Mesh(KITE, cells, cell_data=data, cell_sets=cell_sets)
                better = flip(mesh, regions=regions)
                self.assertEqual(as_set(numpy.concatenate([block.data for block in better.cells])),
                                 as_set(expected))
        with self.assertRaisesRegex(ValueError, "no cell data 'x'; it has 'medit:ref', 'mine'"):
            flip(meshio.Mesh(KITE, one, cell_data=bare), regions="x")

    def test_it_warns_where_nothing_can_flip(self):
        meshio = load("meshio")
        from delaunayflip.meshio import flip
        tetra = ("tetra", [[0, 1, 2, 3]])
        for cells, text in (
                ([("quad", [[0, 1, 2, 3]]), tetra], "no cells of type triangle. It has 1 quad, 1 tetra"),
                ([("triangle6", [[0, 1, 2, 3, 3, 3]])], "It has 1 triangle6"), ([], "of type triangle"),
                ([("triangle", LONG), tetra], r"all edges of the 2 triangles .* \(1 tetra\)")):
            with self.assertWarnsRegex(UserWarning, text) as told:
                flip(meshio.Mesh(KITE, cells))
            self.assertEqual(told.filename, __file__)

    def test_sets_and_lines_that_do_not_fit(self):
        meshio = load("meshio")
        import delaunayflip.meshio
        points = [[0.0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]]
        cells = [("triangle", [[0, 1, 2], [0, 2, 3]])]
        for wrong in ([9999], [-1], [0.5], [True], [[0]], ["a"]):
            mesh = meshio.Mesh(points, cells, cell_sets={"name": [numpy.array(wrong)]})
            with self.assertRaisesRegex(ValueError, "^cell set 'name' "):
                delaunayflip.meshio.flip(mesh)
        for right in ([0], [False, True], [], [0.0]):
            mesh = meshio.Mesh(points, cells, cell_sets={"name": [numpy.array(right)]})
            self.assertEqual(len(delaunayflip.meshio.flip(mesh).cells[0].data), 2)
        mesh = meshio.Mesh(points, [*cells, ("line", [[0, 1]]), ("line", [[0, 999]])])
        with self.assertRaisesRegex(delaunayflip.InvalidMesh, "^line 1 names point 999") as told:
            delaunayflip.meshio.flip(mesh, constraints=[[0, 1], [1, 2]])
        self.assertEqual((told.exception.cell, told.exception.point), (1, 999))
        with self.assertWarnsRegex(UserWarning, "point_limit") as told:
            delaunayflip.meshio.flip(meshio.Mesh(points, cells), point_limit=3)
        self.assertEqual(told.filename, __file__)

    def test_sets_and_info_stay(self):
        meshio = load("meshio")
        from delaunayflip.meshio import flip
        points = numpy.asfortranarray(KITE)
        given = meshio.Mesh(
            points, [meshio.CellBlock("triangle", LONG, tags=["skin"])],
            point_data={"p": [1, 2, 3, 4]}, field_data={"f": [1]}, point_sets={"a": [0, 1]},
            cell_sets={"b": [[0, 1]]}, gmsh_periodic=[1], info={"by": "me"})
        better = flip(given)
        self.assertEqual(as_set(better.cells[0].data), as_set(SHORT))
        for name in ("field_data", "point_sets", "cell_sets", "gmsh_periodic", "info"):
            self.assertEqual(getattr(better, name), getattr(given, name), name)
        self.assertEqual(better.cells[0].tags, ["skin"])
        self.assertIsNot(better.point_data, given.point_data)


class Trimesh(unittest.TestCase):

    def test_colors_attributes_and_metadata_stay(self):
        trimesh = load("trimesh")
        from delaunayflip.trimesh import flip
        given = trimesh.Trimesh(
            KITE, LONG, process=False, metadata={"by": "me"},
            face_colors=[[255, 0, 0, 255], [0, 255, 0, 255]],
            face_attributes={"f": numpy.arange(2)}, vertex_attributes={"v": numpy.arange(4)})
        better = flip(given)
        self.assertEqual(as_set(better.faces), as_set(SHORT))
        self.assertEqual(better.metadata["by"], "me")
        numpy.testing.assert_array_equal(better.visual.face_colors, given.visual.face_colors)
        numpy.testing.assert_array_equal(better.face_attributes["f"], [0, 1])
        numpy.testing.assert_array_equal(better.vertex_attributes["v"], [0, 1, 2, 3])
        self.assertEqual(flip(given, return_report=True)[1].total_flips, 1)
        given.visual = trimesh.visual.ColorVisuals(vertex_colors=numpy.arange(16).reshape(4, 4))
        self.assertEqual(flip(given).visual.vertex_colors.tolist()[3], [12, 13, 14, 15])
        given.visual = trimesh.visual.TextureVisuals(uv=numpy.arange(8).reshape(4, 2))
        self.assertEqual(flip(given).visual.uv.tolist()[3], [6, 7])
        with self.assertRaisesRegex(TypeError, "trimesh.Trimesh, not Scene"):
            flip(trimesh.Scene())

    def test_warnings_name_the_line_of_the_caller(self):
        trimesh = load("trimesh")
        import delaunayflip.trimesh
        kite = trimesh.Trimesh([[0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]], [[0, 1, 2], [0, 2, 3]])
        with self.assertWarnsRegex(UserWarning, "point_limit") as told:
            delaunayflip.trimesh.flip(kite, point_limit=3)
        self.assertEqual(told.filename, __file__)

    def test_goals_are_refused(self):
        trimesh = load("trimesh")
        from delaunayflip.trimesh import flip
        given = trimesh.Trimesh(KITE, LONG, process=False)
        self.assertEqual(len(flip(given, region_seeds=[(2, 0, 1), (2, 0, 1, 0.0)]).faces), 2)
        for options, text in (({"maximum_edge": 1}, "maximum_edge: "), ({"size": [1] * 4}, "size: "),
                              ({"region_seeds": [(2, 0, 1, 0.05)]}, "an area in region_seeds: ")):
            with self.assertRaisesRegex(delaunayflip.InvalidOptions, text + "delaunayflip.trimesh keeps"):
                flip(given, **options)


class Laspy(unittest.TestCase):

    def test_classes_and_files(self):
        laspy = load("laspy")
        from delaunayflip.laspy import triangulate
        tile = laspy.create()
        tile.x, tile.y, tile.z = [0, 4, 4, 0, 2], [0, 0, 4, 4, 2], [1, 1, 1, 1, 30]
        tile.classification, tile.withheld = [2, 2, 2, 2, 5], [0, 0, 0, 1, 0]
        file = io.BytesIO()
        tile.write(file)
        for classes, count in (([2], 1), (2, 1), ((5, 2), 2), (None, 2)):
            file.seek(0)
            for given in (tile, file):
                self.assertEqual(len(triangulate(given, classes=classes).triangles), count)
        for error, text, options in ((ValueError, "the file has the classes 2, 5", {"classes": [9]}),
                                     (ValueError, r"there is no point of the classes \[9\] that is not",
                                      {"classes": [9]}), (TypeError, "integer", {"classes": [2.5]}),
                                     (TypeError, "clases", {"clases": [2]})):
            with self.assertRaisesRegex(error, text):
                triangulate(tile, **options)
        with self.assertRaisesRegex(ValueError, "^there is no point that is not withheld"):
            triangulate(laspy.create())
        with self.assertWarnsRegex(UserWarning, "without heights") as told:
            triangulate(tile, outline=[[1, 0.5], [3, 0.5], [3, 3]])
        self.assertEqual(told.filename, __file__)


class PyVista(unittest.TestCase):

    def setUp(self):
        self.pyvista = load("pyvista")
        if not hasattr(self.pyvista, "register_dataset_accessor"):
            self.skipTest("needs PyVista 0.48")
        self.mesh = self.pyvista.Plane(i_resolution=12, j_resolution=12)
        self.mesh.points[:, 0] += 2.5 * self.mesh.points[:, 1]  # quads, which become slivers
        self.mesh.cell_data["Number"] = numpy.arange(self.mesh.n_cells)

    def test_accessor_comes_with_the_package(self):
        """By its entry point; nothing of delaunayflip.pyvista is imported here."""
        better = self.mesh.delaunay.flip(quality=True, flip_counts=True, geometry="planar")
        self.assertEqual(better.n_cells, 2 * self.mesh.n_cells)
        self.assertEqual(int(better.field_data["DelaunayFlip:Converged"][0]), 1)
        numpy.testing.assert_array_equal(better.points, self.mesh.points)
        numpy.testing.assert_array_equal(better["Number"], numpy.repeat(self.mesh["Number"], 2))
        self.assertGreater(better["vtkDelaunayFlipCount"].max(), 0)
        self.assertEqual(self.mesh.n_cells, 144)
        arrays = delaunayflip.smallest_angles(better.points, better.faces.reshape(-1, 4)[:, 1:])
        numpy.testing.assert_array_equal(better.delaunay.smallest_angles(), arrays)
        self.assertGreater(arrays.min(), self.mesh.triangulate().delaunay.smallest_angles().min())

    def test_points(self):
        cloud = self.pyvista.PolyData(numpy.random.default_rng(3).random((50, 3)))
        cloud["Number"] = numpy.arange(50)
        segments = self.pyvista.Line((0.1, 0.2, 7), (0.9, 0.8, 7))
        made = cloud.delaunay.triangulate(segments, alpha=0.5)
        expected = delaunayflip.triangulate(made.points, segments=[[50, 51]], alpha=0.5)
        numpy.testing.assert_array_equal(made.regular_faces, expected.triangles)
        numbers = delaunayflip.LinearInterpolator(
            numpy.array(cloud.points), numpy.arange(50), outside="nearest")(made.points[50:])
        self.assertEqual(made["Number"].tolist(), [*range(50), *numpy.round(numbers)])
        self.assertEqual(cloud.n_points, 50)
        self.assertGreater(int(made.field_data["DelaunayFlip:SegmentEdges"][0]), 0)
        same = delaunayflip.pyvista.triangulate(self.pyvista.PointSet(cloud.points))
        numpy.testing.assert_array_equal(same.faces, cloud.delaunay.triangulate().faces)
        with self.assertWarnsRegex(UserWarning, "cross(es)? an earlier one") as told:
            cross = self.pyvista.Line((0.1, 0.8, 7), (0.9, 0.2, 7))
            cloud.delaunay.triangulate(segments.append_polydata(cross))
        self.assertEqual(told.filename, __file__)
        with self.assertRaisesRegex(TypeError, "cloud must be a dataset with points, not list"):
            delaunayflip.pyvista.triangulate([[0, 0, 0]])
        bare = delaunayflip.pyvista.triangulate(self.pyvista.PolyData(), cloud)
        self.assertEqual((bare.n_points, bare.n_cells), (50, same.n_cells))

    def test_refinement(self):
        cloud = self.pyvista.PolyData([[0.0, 0, 0], [10, 0, 20], [10, 10, 30], [0, 10, 10]])
        cloud["Plane"] = 2 * cloud.points[:, 0] + cloud.points[:, 1]
        cloud["Size"] = [1.0, 3, 3, 1]
        wall = self.pyvista.Line((4, 0, 8), (4, 10, 18))
        options = {"minimum_angle": 28, "regions": [(1, 1, 7), (9, 9, -2)]}
        made = cloud.delaunay.triangulate(wall, size="Size", **options)
        numpy.testing.assert_allclose(made.points[:, 2], 2 * made.points[:, 0] + made.points[:, 1], atol=1e-4)
        numpy.testing.assert_allclose(made["Plane"], made.points[:, 2], atol=1e-4)
        is_left = made.cell_centers().points[:, 0] < 4
        numpy.testing.assert_array_equal(made["Region"], numpy.where(is_left, 7, -2))
        self.assertGreaterEqual(delaunayflip.smallest_angles(made.points, made.regular_faces,
                                                             geometry="planar-xy").min(), 28)
        for segments in (wall, [[0, 1], [1, 2]]):
            marked = cloud.delaunay.triangulate(
                segments, outline=[0, 1, 2, 3], pass_segments=True, maximum_edge=2.0)
            lines, ids = marked.lines.reshape(-1, 3)[:, 1:], marked.cell_data["SegmentIds"]
            places = marked.points[lines, 0]
            if segments is wall:
                wanted = numpy.where((places == 4).all(axis=1), 0, 1)
            else:  # rows of pairs; the ring follows
                wanted = numpy.where((marked.points[lines, 1] == 0).all(axis=1), 0,
                                     numpy.where((places == 10).all(axis=1), 1, 2))
            numpy.testing.assert_array_equal(ids[:len(lines)], wanted)
            self.assertTrue((ids[len(lines):] == -1).all())
            on_points = marked.point_data["SegmentIds"]
            inner = numpy.flatnonzero(on_points >= 0)
            self.assertGreater(len(inner), 0)
            for point in inner:
                self.assertEqual(set(wanted[(lines == point).any(axis=1)]), {on_points[point]})
        same = cloud.delaunay.triangulate(wall, size=[1.0, 3, 3, 1], **options)
        numpy.testing.assert_array_equal(same.faces, made.faces)
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, '^size: .* no point array of numbers named "size"'):
            cloud.delaunay.triangulate(size="size")

    def test_refinement_of_meshes(self):
        import delaunayflip.pyvista
        mesh = self.pyvista.PolyData([[0.0, 0, 0], [4, 0, 8], [10, 0, 20], [10, 10, 30], [4, 10, 18], [0, 10, 10]],
                                     faces=[3, 0, 1, 5, 3, 1, 4, 5, 4, 1, 2, 3, 4])
        mesh["Plane"] = 2 * mesh.points[:, 0] + mesh.points[:, 1]
        mesh["Size"] = [1.0, 2, 3, 3, 2, 1]
        mesh.cell_data["Zone"] = [7, 7, -2]
        options = {"minimum_angle": 28, "region_array": "Zone", "geometry": "planar-xy"}
        made = mesh.delaunay.flip(size="Size", quality=True, **options)
        self.assertGreater(made.n_points, 30)
        numpy.testing.assert_allclose(made.points[:, 2], 2 * made.points[:, 0] + made.points[:, 1], atol=1e-4)
        numpy.testing.assert_allclose(made["Plane"], made.points[:, 2], atol=1e-4)
        is_left = made.cell_centers().points[:, 0] < 4
        numpy.testing.assert_array_equal(made["Zone"], numpy.where(is_left, 7, -2))
        self.assertGreaterEqual(made["Smallest angle after (degrees)"].min(), 28)
        seeded = mesh.delaunay.flip(region_seeds=[(1, 1, 5, 0.5), (8, 1, -9)], **options)
        numpy.testing.assert_array_equal(seeded["Region"], numpy.where(seeded["Zone"] == 7, 5, -9))
        self.assertGreater(seeded.n_cells, 100)
        same = mesh.delaunay.flip(size=[1.0, 2, 3, 3, 2, 1], **options)
        numpy.testing.assert_array_equal(same.faces, made.faces)
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "size: the mesh has no point array 'size'"):
            mesh.delaunay.flip(size="size")
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "minimum_angle must be from 0 to 33"):
            mesh.delaunay.flip(minimum_angle=40)
        mesh["Pairs"] = numpy.ones((6, 2))
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, '^size: "Pairs" must have one component'):
            mesh.delaunay.flip(size="Pairs")
        seeded = mesh.delaunay.flip(region_seeds=numpy.array([[1, 1, 5], [9, 9, 6]]), **options)
        self.assertEqual(set(seeded["Region"].tolist()), {5, 6})

    def test_heights_of_rings(self):
        """Those that have none, and their data, come from the survey."""
        import delaunayflip.pyvista
        x, y = numpy.mgrid[0:11, 0:11].reshape(2, -1).astype(float)
        cloud = self.pyvista.PolyData(numpy.c_[x, y, 50 + x])
        cloud["double"] = 2 * y
        ring = [[2.5, 2.25], [7.5, 2.25], [7.5, 7.75]]
        with self.assertWarnsRegex(UserWarning, 'have got the heights .* heights="own" keeps z = 0'):
            made = cloud.delaunay.triangulate(outline=ring)
        numpy.testing.assert_allclose(made.points[121:, 2], [52.5, 57.5, 57.5])
        numpy.testing.assert_allclose(made["double"][121:], [4.5, 4.5, 15.5])
        made = cloud.delaunay.triangulate(outline=ring, heights="own")
        numpy.testing.assert_array_equal(made.points[121:, 2], 0)
        made = cloud.delaunay.triangulate(outline=[[*each, 1.0] for each in ring], heights="survey")
        numpy.testing.assert_allclose(made.points[121:, 2], [52.5, 57.5, 57.5])
        with self.assertRaisesRegex(ValueError, "heights must be one of survey, own"):
            cloud.delaunay.triangulate(outline=ring, heights="auto")

    def test_rings(self):
        """Rings are arrays as for delaunayflip.triangulate, or polygons or closed lines of a mesh."""
        import delaunayflip.pyvista
        cloud = self.pyvista.PolyData(numpy.random.default_rng(4).random((200, 3)) * [12, 12, 1])
        lower = numpy.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
        outer, lake, island = 1 + 10 * lower, 3 + 6 * lower, 5 + 2 * lower

        def join(rings, closes):
            mesh = self.pyvista.PolyData(numpy.concatenate(rings).astype(float))
            cells = [[5, *range(4 * i, 4 * i + 4), 4 * i] if closes else [4, *range(4 * i, 4 * i + 4)]
                     for i in range(len(rings))]
            setattr(mesh, "lines" if closes else "faces", numpy.concatenate(cells))
            if closes:
                mesh.verts = numpy.empty(0, int)
            return mesh

        def measure(segments=None, **options):
            made = cloud.delaunay.triangulate(segments, **options)
            return round(made.project_points_to_plane(origin=(0, 0, 0), normal=(0, 0, 1)).area, 9)

        nested = [outer, lake, island]
        self.assertEqual(measure(outline=[ring.tolist() for ring in nested]), 68)
        self.assertEqual(measure(outline=nested, ring_rule="nonzero"), 100)
        for closes in (False, True):
            self.assertEqual(measure(join(nested, closes)), 68)
            self.assertEqual(measure(outline=join(nested, closes)), 68)
            self.assertEqual(measure(outline=outer, holes=join(nested[1:], closes)), 68)
            self.assertEqual(measure(join(nested[:1], closes), holes=nested[1:]), 68)
        self.assertGreater(measure(join(nested, True), closed_lines_as_rings=False), 100)
        self.assertEqual(measure(outline=nested[:1], hole_seeds=[[5, 5]]), 0)
        made = cloud.delaunay.triangulate([[0, 1]])
        self.assertGreater(made.field_data["DelaunayFlip:SegmentEdges"][0], 0)
        made = cloud.delaunay.triangulate(outline=outer)
        self.assertEqual((made.n_points, made.point_data.keys()), (204, []))
        with self.assertWarnsRegex(UserWarning, r"1 ring without an area, left out \(first: ring 1 of holes"):
            self.assertEqual(measure(outline=outer, holes=[lake, [[2, 2], [3, 3]]]), 64)
        with self.assertRaisesRegex(ValueError, r"outline: line 0 does not end where it begins.*strip\(\)"):
            measure(outline=self.pyvista.Line())
        with self.assertRaisesRegex(ValueError, "holes must have polygons or closed lines"):
            measure(holes=self.pyvista.PolyData(outer))
        with self.assertRaisesRegex(TypeError, "outline must be a pyvista.PolyData .* not MultiBlock"):
            measure(outline=self.pyvista.MultiBlock())
        with self.assertRaisesRegex(TypeError, "outline must be .* not str"):
            measure(outline="even-odd")
        with self.assertRaisesRegex(TypeError, "segments must be a pyvista.PolyData, not UniformGrid|ImageData"):
            measure(self.pyvista.ImageData())

    def test_interpolation(self):
        draw = numpy.random.default_rng(6)
        xyz = draw.random((500, 3))
        xyz[:, 2] = 3 * xyz[:, 0] - xyz[:, 1]
        cloud = self.pyvista.PolyData(xyz)
        cloud["Wind"] = numpy.c_[xyz[:, 0], 2 * xyz[:, 1]].astype(numpy.float32)
        cloud["Number"] = numpy.arange(500)
        cloud["Name"] = ["a"] * 500
        image = self.pyvista.ImageData(dimensions=(30, 20, 1), spacing=(0.04, 0.06, 1), origin=(-0.05, 0, 9))
        x, y = image.points[:, 0], image.points[:, 1]
        river = self.pyvista.Line((0.1, 0.2, 0), (0.9, 0.7, 0))
        outline = [[0.2, 0.1], [1.3, 0.1], [1.3, 0.8], [0.2, 0.8]]
        for options in ({}, {"method": "natural"}, {"segments": river}, {"outline": outline, "holes": []}):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                made = cloud.delaunay.interpolate(image, **options)
                mesh = cloud.delaunay.triangulate(**{
                    name: value for name, value in options.items() if name != "method"})
            self.assertIs(type(made), type(image))
            self.assertEqual(made.dimensions, image.dimensions)
            self.assertEqual(image.point_data.keys(), [])
            self.assertEqual(sorted(made.point_data.keys()),
                             ["Elevation", "Number", "Wind", "vtkValidPointMask"])
            is_inside = made["vtkValidPointMask"] == 1
            self.assertGreater(is_inside.sum(), 100)
            numpy.testing.assert_array_equal(numpy.isnan(made["Elevation"]), ~is_inside)
            near = is_inside & (x < 0.9 * xyz[:, 0].max())  # between points of the cloud
            if "outline" not in options:
                near = is_inside
            numpy.testing.assert_allclose(made["Elevation"][near], (3 * x - y)[near], atol=1e-6)
            numpy.testing.assert_allclose(made["Wind"][near], numpy.c_[x, 2 * y][near], atol=1e-5)
            self.assertEqual(made["Wind"].dtype, numpy.float32)
            added = mesh.points[500:]
            self.assertEqual(numpy.abs(added[:, 2]).min(initial=1) > 0, True)
        own = cloud.delaunay.triangulate(river, heights="own")
        self.assertEqual(own.points[500:, 2].tolist(), [0, 0])
        with self.assertWarnsRegex(UserWarning, '2 points of segments .*heights="own" keeps z = 0') as told:
            lifted = cloud.delaunay.triangulate(river)
        self.assertEqual(told.filename, __file__)
        numpy.testing.assert_allclose(lifted.points[500:, 2], [0.1, 2.0], atol=1e-6)
        numpy.testing.assert_allclose(lifted["Wind"][500:], [[0.1, 0.4], [0.9, 1.4]], atol=1e-6)
        end = cloud.delaunay.interpolate(self.pyvista.PolyData([[0.1, 0.2, 7.0]]), river, heights="own")
        self.assertAlmostEqual(float(end["Elevation"][0]), 0, places=6)
        numpy.testing.assert_allclose(end["Wind"], [[0.1, 0.4]], atol=1e-6)
        points = self.pyvista.PolyData([[0.5, 0.5, 7], [9, 9, 9]])
        near = cloud.delaunay.interpolate(points, outside="nearest")
        self.assertFalse(numpy.isnan(near["Elevation"]).any())
        self.assertEqual(near["vtkValidPointMask"].tolist(), [1, 0])
        for error, options in ((ValueError, {"outside": "error"}), (TypeError, {"alpah": 1}),
                               (ValueError, {"method": "cubic"}), (ValueError, {"heights": "auto"}),
                               (delaunayflip.Stopped, {"progress": lambda share: False})):
            with self.assertRaises(error):
                cloud.delaunay.interpolate(points, **options)
        for onto in (points.points, self.pyvista.MultiBlock([points])):
            with self.assertRaisesRegex(TypeError, "onto must be a dataset with points, not"):
                cloud.delaunay.interpolate(onto)
        with self.assertWarnsRegex(UserWarning, "the cloud has no points, so there are no values"):
            empty = self.pyvista.PolyData().delaunay.interpolate(points)
        self.assertTrue(numpy.isnan(empty["Elevation"]).all())
        shares = []
        cloud.delaunay.interpolate(points, progress=shares.append)
        self.assertEqual(shares, sorted(shares))

    def test_sphere(self):
        """The same triangles as of triangulate_sphere, and the same values as of SphereInterpolator."""
        draw = numpy.random.default_rng(8)
        places = draw.normal(size=(300, 3))
        places /= numpy.linalg.norm(places, axis=1, keepdims=True)
        degrees = numpy.degrees(numpy.c_[numpy.arctan2(places[:, 1], places[:, 0]), numpy.arcsin(places[:, 2])])
        ring = [[-20, -30], [30, -40], [40, 20], [0, 40]]
        cloud = self.pyvista.PolyData(numpy.c_[degrees, numpy.arange(300)])
        cloud["Warmth"] = 30 - abs(degrees[:, 1])
        for options in ({}, {"holes": ring}, {"outline": ring}):
            expected = delaunayflip.triangulate_sphere(degrees, **options)
            given = dict(options)
            for name in ("holes", "outline"):
                if name in options:
                    given[name] = self.pyvista.PolyData(numpy.c_[ring, [0.0] * 4], faces=[4, 0, 1, 2, 3])
            for each in (options, given):
                made = cloud.delaunay.triangulate(projection="sphere", degrees=True, **each)
                numpy.testing.assert_array_equal(made.points, expected.points)
                numpy.testing.assert_array_equal(made.regular_faces, expected.triangles)
                numpy.testing.assert_array_equal(made["Height"][:300], numpy.arange(300))
                self.assertTrue(numpy.isfinite(made["Height"]).all() and (made["Height"][300:] > 0).all())
        river = self.pyvista.Line((0, 0, 0), (40, 10, 0))
        lines = delaunayflip.triangulate_sphere(degrees, [numpy.array(river.points[:, :2])])
        made = cloud.delaunay.triangulate(river, projection="sphere", degrees=True)
        numpy.testing.assert_array_equal(made.regular_faces, lines.triangles)
        closed = self.pyvista.MultipleLines(numpy.c_[[*ring, ring[0]], [0.0] * 5])
        made = cloud.delaunay.triangulate(closed, hole_seeds=[[0, 0]], closed_lines_as_rings=False,
                                          projection="sphere", degrees=True)
        numpy.testing.assert_array_equal(
            made.regular_faces, delaunayflip.triangulate_sphere(degrees, holes=ring).triangles)
        half = places[places[:, 2] > 0.1]
        opened = self.pyvista.PolyData(half).delaunay.triangulate(projection="open-sphere")
        expected = delaunayflip.triangulate_sphere(half, open=True)
        numpy.testing.assert_array_equal(opened.regular_faces, expected.triangles)
        image = self.pyvista.ImageData(dimensions=(37, 19, 1), spacing=(10, 10, 1), origin=(-180, -90, 0))
        directions = self.pyvista.PolyData(draw.normal(size=(50, 3)))
        for method in ("linear", "natural"):
            made = cloud.delaunay.interpolate(image, projection="sphere", degrees=True, method=method)
            values = delaunayflip.SphereInterpolator(degrees, cloud["Warmth"], method=method)
            numpy.testing.assert_array_equal(made["Warmth"], values(image.points[:, :2]))
            self.assertAlmostEqual(float(made["Elevation"].max()), 299, delta=40)
            globe = self.pyvista.PolyData(places)
            globe["Warmth"] = cloud["Warmth"]
            made = globe.delaunay.interpolate(directions, projection="sphere", method=method)
            values = delaunayflip.SphereInterpolator(places, cloud["Warmth"], method=method)
            numpy.testing.assert_array_equal(made["Warmth"], values(numpy.array(directions.points)))
            self.assertNotIn("Elevation", made.point_data)
        mask = self.pyvista.PolyData(half).delaunay.interpolate(directions, projection="open-sphere")
        self.assertEqual(mask.point_data.keys(), ["vtkValidPointMask"])
        self.assertEqual(set(mask["vtkValidPointMask"].tolist()), {0, 1})
        made = cloud.delaunay.interpolate(image, holes=ring, projection="sphere", degrees=True)
        values = delaunayflip.SphereInterpolator(degrees, cloud["Warmth"], holes=ring)
        numpy.testing.assert_allclose(made["Warmth"], values(image.points[:, :2]), atol=1e-12)
        with self.assertWarnsRegex(UserWarning, "^segments: 1 point with a latitude beyond 90 degrees") as told:
            cloud.delaunay.triangulate(self.pyvista.Line((0, 0, 0), (40, 95, 0)), projection="sphere", degrees=True)
        self.assertEqual(told.filename, __file__)
        for text, options in (("projection must be one of xy, sphere, open-sphere", {"projection": "plane"}),
                              ("degrees must be True or False", {"degrees": 2}),
                              ("heights=", {"heights": "survey", "projection": "sphere"}),
                              ("holes: places on a sphere have x, y and z",
                               {"holes": ring, "projection": "sphere"}),
                              ("alpha has no meaning on a sphere", {"alpha": 2, "projection": "sphere"})):
            with self.assertRaisesRegex(ValueError, text):
                cloud.delaunay.triangulate(**options)

    def test_callbacks(self):
        """They follow the flips and may stop them; without iterations, VTK 9.7 can read a .vtk."""
        for name in ("progress", "on_iteration"):
            told = []
            whole = self.mesh.delaunay.flip(**{name: told.append})
            self.assertGreater(len(told), 2, name)
            stopped = self.mesh.delaunay.flip(**{name: lambda value: False})
            self.assertEqual(stopped.field_data["DelaunayFlip:StopReason"], ["aborted"])
            self.assertLess(stopped.field_data["DelaunayFlip:TotalFlips"][0],
                            whole.field_data["DelaunayFlip:TotalFlips"][0])
        self.assertIn("DelaunayFlip:Flipped", whole.field_data)
        data = whole.delaunay.flip().field_data
        self.assertEqual([name for name in data if len(data[name]) == 0 or "Flipped" in name], [])

    def test_shares_of_interpolation(self):
        pyvista = load("pyvista")
        import delaunayflip.pyvista
        cloud, shares = pyvista.PolyData([[0.0, 0, 0], [2, 0, 2], [0, 2, 4], [2, 2, 6]]), []
        delaunayflip.pyvista.interpolate(cloud, cloud, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1.0)

    def test_what_is_refused(self):
        pyvista, flip = self.pyvista, self.mesh.delaunay.flip
        functions = [importlib.import_module("delaunayflip.pyvista").flip,
                     delaunayflip.pyvista.smallest_angles, delaunayflip.pyvista.plot_quality]
        for other in (None, pyvista.ImageData(dimensions=(3, 3, 1)), pyvista.MultiBlock([self.mesh]),
                      self.mesh.cast_to_unstructured_grid(), pyvista.PointSet(self.mesh.points)):
            for function in functions:
                with self.assertRaisesRegex(TypeError, r"mesh must be.*extract_surface\(\)"):
                    function(other)
            if other is not None:
                with self.assertRaisesRegex(TypeError, "constraints must be a pyvista.PolyData"):
                    flip(constraints=other)
        with self.assertRaisesRegex(ValueError, "no triangles"):
            self.mesh.delaunay.smallest_angles()
        for name, value, error in (
                ("feature_angle", 181, delaunayflip.InvalidOptions), ("threads", 2**32, ValueError),
                ("geometri", "planar", TypeError), ("regions", [], TypeError),
                ("triangulate", "no", TypeError), ("region_array", "no", ValueError)):
            with self.assertRaisesRegex(error, name.replace("feature_angle", "feature angle")):
                flip(**{name: value})
        for name in ("regions", "frozen", "triangle_numbers"):  # those of arrays
            with self.assertRaisesRegex(TypeError, f"'{name}' is not an option"):
                flip(**{name: [0] * 288})
        with self.assertWarnsRegex(UserWarning, "no triangles, polygons or strips") as told:
            self.pyvista.Line().delaunay.flip()
        self.assertEqual(told.filename, __file__)
        self.mesh.points[5] = numpy.nan
        with self.assertWarnsRegex(UserWarning, "NaN|finite") as told:
            flip()
        self.assertEqual(told.filename, __file__)

    def test_attributes(self):
        mesh = self.mesh
        mesh.cell_data["Tree"] = numpy.array(["oak", "elm"])[numpy.arange(144) // 12 % 2]
        mesh.field_data["Mine"] = [7]
        mesh.cell_data["Ids"] = numpy.arange(144)
        mesh.GetCellData().SetActiveAttribute("Ids", 5)
        mesh.cell_data["Up"] = numpy.tile([0.0, 0.0, -1.0], (144, 1))
        mesh.cell_data.active_normals_name = "Up"
        better = mesh.delaunay.flip(region_array="Tree")
        self.assertEqual(set(better["Tree"]), {"oak", "elm"})
        self.assertEqual(list(better.field_data["Mine"]), [7])
        self.assertEqual(better.cell_data.active_normals_name, "Up")
        numpy.testing.assert_array_equal(better["Up"], numpy.tile([0, 0, -1], (288, 1)))
        self.assertIsNone(better.GetCellData().GetGlobalIds())
        self.assertEqual(better.GetCellData().GetPedigreeIds().GetName(), "Ids")
        self.assertEqual(mesh.n_cells, 144)
        self.assertNotIn("DelaunayFlip:Converged", mesh.field_data)
        whole = mesh.delaunay.flip(triangulate=False)
        numpy.testing.assert_array_equal(whole.faces, mesh.faces)
        strips = mesh.triangulate().strip()
        for options, count in (({}, 0), ({"triangulate": False}, strips.n_strips)):
            made = strips.delaunay.flip(**options)
            self.assertEqual((made.n_strips, made.area), (count, strips.area))

    def test_the_filter_gives_the_same(self):
        vtk_data = load("vtkmodules.vtkCommonDataModel")
        if not isinstance(self.mesh, vtk_data.vtkPolyData):
            self.skipTest("PyVista uses another VTK")
        lines = self.pyvista.Line(self.mesh.points[0], self.mesh.points[-1], resolution=1)
        filter_ = delaunayflip.vtkDelaunayFlip()
        filter_.SetInputData(self.mesh)
        filter_.SetConstraintsData(lines)
        filter_.GenerateFlipCountOn()
        filter_.GenerateQualityOn()
        filter_.Update()
        expected = self.pyvista.wrap(filter_.GetOutput())
        found = self.mesh.delaunay.flip(constraints=lines, flip_counts=True, quality=True)
        numpy.testing.assert_array_equal(found.faces, expected.faces)
        self.assertEqual(found.cell_data.keys(), expected.cell_data.keys())
        for data in ("cell_data", "field_data"):
            for name in getattr(expected, data).keys():
                if name != "DelaunayFlip:Seconds":
                    numpy.testing.assert_array_equal(
                        getattr(found, data)[name], getattr(expected, data)[name], name)

    def test_pictures(self):
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)
            picture = pathlib.Path(folder, "quality.png")
            self.mesh.delaunay.plot_quality(off_screen=True, screenshot=str(picture))
            self.assertGreater(picture.stat().st_size, 1000)
            film = pathlib.Path(folder, "flips.gif")
            last = self.mesh.delaunay.animate(str(film), window_size=(160, 120))
            frames = load("imageio").mimread(film)
        self.assertGreaterEqual(len(frames), 3)
        self.assertGreater(numpy.abs(frames[0].astype(int) - frames[-1]).max(), 50)
        numpy.testing.assert_array_equal(last.faces, self.mesh.delaunay.flip().faces)


class OtherVtk(unittest.TestCase):

    def test_without_cvista(self):
        """PyVista takes cvista by itself where that is installed: all above once more with vtk."""
        load("pyvista")
        load("cvista")
        done = subprocess.run(
            [sys.executable, "-m", "unittest", "test_pyvista.PyVista"], capture_output=True, text=True,
            env={**os.environ, "PYVISTA_VTK_BACKEND": "vtk"}, cwd=pathlib.Path(__file__).parent)
        self.assertEqual(done.returncode, 0, done.stderr)


class Notebook(unittest.TestCase):

    def test_runs_and_draws(self):
        nbformat, nbclient = load("nbformat"), load("nbclient")
        load("pyvista")
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        self.assertEqual([cell for cell in notebook.cells if cell.get("outputs")], [])
        with tempfile.TemporaryDirectory() as folder:
            nbclient.NotebookClient(
                notebook, timeout=300, resources={"metadata": {"path": folder}}).execute()
        outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        kinds = [kind for output in outputs for kind in output.get("data", {})]
        self.assertGreaterEqual(kinds.count("image/png"), 2)

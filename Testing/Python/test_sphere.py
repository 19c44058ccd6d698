# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of triangulations on a sphere, and of meshes of globes, by NumPy arrays."""
import doctest
import functools
import math
import pickle
import unittest
import warnings

import delaunayflip
import numpy
from delaunayflip import _points, _sphere


def make_directions(count, seed=1):
    points = numpy.random.default_rng(seed).normal(size=(count, 3))
    return points / numpy.linalg.norm(points, axis=1, keepdims=True)


def make_grid(step):
    longitudes, latitudes = numpy.meshgrid(numpy.arange(-180, 181, step), numpy.arange(-90, 91, step))
    return numpy.c_[longitudes.ravel(), latitudes.ravel()]


def find_volume(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return (numpy.cross(a, b) * c).sum() / 6


def sort_rows(triangles):
    """The triangles in order, each from its lowest id on."""
    first = triangles.argmin(axis=1)[:, None]
    return sorted(map(tuple, numpy.take_along_axis(triangles, (first + numpy.arange(3)) % 3, axis=1).tolist()))


class Sphere(unittest.TestCase):
    def test_docstrings(self):
        for module in (_points, _sphere):
            result = doctest.testmod(module)
            self.assertGreater(result.attempted, 3)
            self.assertEqual(result.failed, 0)

    def test_grid(self):
        """Both ends of a row are one place, and so are all points at a pole."""
        grid = make_grid(10)
        globe = delaunayflip.triangulate_sphere(grid)
        places = 36 * 17 + 2
        self.assertEqual(globe.report.used_points, places)
        self.assertEqual(globe.report.repeated_points, len(grid) - places)
        self.assertEqual(globe.triangles.shape, (2 * places - 4, 3))
        self.assertEqual(len(set(globe.used_points[grid[:, 1] == 90])), 1)
        self.assertTrue((globe.used_points[grid[:, 0] == 180] == globe.used_points[grid[:, 0] == -180]).all())
        self.assertGreater(find_volume(globe.points, globe.triangles), 4.1)
        numpy.testing.assert_array_equal(globe.points[grid[:, 1] == -90], [[0, 0, -1]] * 37)

    def test_neighbors(self):
        globe = delaunayflip.triangulate_sphere(make_directions(300))
        for slot in range(3):
            ends = globe.triangles[:, [(slot + 1) % 3, (slot + 2) % 3]]
            across = globe.triangles[globe.neighbors[:, slot]]
            for end in (0, 1):
                self.assertTrue((across == ends[:, [end]]).any(axis=1).all())

    def test_flips_end_there(self):
        """If points of a mesh have moved, its flips end with the triangles of a triangulation."""
        points = make_directions(500, 2)
        before = points + 0.003 * make_directions(500, 3)
        before /= numpy.linalg.norm(before, axis=1, keepdims=True)
        start = delaunayflip.triangulate_sphere(before).triangles
        flipped = delaunayflip.flip(points, start, geometry="sphere", tie_rule="canonical")
        self.assertEqual(flipped.report.geometry_used, "sphere")
        self.assertGreater(flipped.report.total_flips, 2)
        self.assertEqual(flipped.report.defects, "")
        globe = delaunayflip.triangulate_sphere(points)
        self.assertEqual(sort_rows(flipped.triangles), sort_rows(globe.triangles))

    def test_flips_of_points_that_are_on_no_sphere(self):
        points = make_directions(100, 9)
        triangles = delaunayflip.triangulate_sphere(points).triangles
        ellipsoid = points * [1.0, 1.0, 1 - 1 / 298.257]
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            delaunayflip.flip(ellipsoid, triangles, geometry="sphere")
            delaunayflip.flip(numpy.append(points, [[0, 0, 9]], axis=0), triangles, geometry="sphere")
        points[7] *= 1.5
        with self.assertWarnsRegex(UserWarning, 'the points are 1 to 1.5 from the origin, .* geometry="sphere"') as told:
            delaunayflip.flip(points, triangles, geometry="sphere")
        self.assertEqual(told.filename, __file__)

    def test_degrees_and_radians(self):
        degrees = numpy.random.default_rng(4).uniform((-180, -90), (180, 90), (100, 2))
        first = delaunayflip.triangulate_sphere(degrees)
        second = delaunayflip.triangulate_sphere(numpy.radians(degrees), degrees=False)
        numpy.testing.assert_allclose(first.points, second.points, atol=1e-14)
        self.assertEqual(sort_rows(first.triangles), sort_rows(second.triangles))
        places = delaunayflip.triangulate_sphere(first.points)
        numpy.testing.assert_array_equal(places.triangles, first.triangles)

    def test_open(self):
        europe = numpy.random.default_rng(5).uniform((-10, 35), (30, 70), (200, 2))
        whole = delaunayflip.triangulate_sphere(europe)
        self.assertEqual(len(whole.triangles), 2 * 200 - 4)
        part = delaunayflip.triangulate_sphere(europe, open=True)
        self.assertEqual(part.report.large_triangles, len(whole.triangles) - len(part.triangles))
        self.assertEqual(part.report.euler_characteristic, 1)
        self.assertGreater((part.neighbors == -1).sum(), 3)
        self.assertLess(set(sort_rows(part.triangles)), set(sort_rows(whole.triangles)))

    def test_voronoi_corners(self):
        globe = delaunayflip.triangulate_sphere(make_directions(200, 6))
        corners = globe.voronoi_corners
        numpy.testing.assert_allclose(numpy.linalg.norm(corners, axis=1), 1, atol=1e-15)
        reach = (corners[:, None] * globe.points[globe.triangles]).sum(axis=2)
        numpy.testing.assert_allclose(reach, reach[:, :1] * [1, 1, 1], atol=1e-12)
        self.assertTrue((corners @ globe.points.T <= reach[:, :1] + 1e-12).all())  # none is nearer

    def test_latitudes_first(self):
        grid = make_grid(30)
        text = r"35 points with a latitude beyond 90 degrees \(first: 0, 1, 2\); longitudes come first"
        with self.assertWarnsRegex(UserWarning, text):
            delaunayflip.triangulate_sphere(grid[grid[:, 0] != 180][:, ::-1])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            delaunayflip.triangulate_sphere(numpy.radians(grid).astype(numpy.float32), degrees=False)
            delaunayflip.triangulate_sphere(numpy.concatenate([grid + [360, 0], [[0, numpy.nan]]]))

    def test_radians_in_single_precision(self):
        grid = make_grid(10)
        radians = numpy.radians(grid).astype(numpy.float32)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            globe = delaunayflip.triangulate_sphere(radians, degrees=False)
        exact = delaunayflip.triangulate_sphere(grid)
        self.assertEqual(globe.report.used_points, exact.report.used_points)

    def test_points_inside(self):
        points = make_directions(100, 7)
        points[[3, 8]] *= 0.5
        points[20, 1] = numpy.nan
        with self.assertWarnsRegex(UserWarning, r"2 points inside .*\(first: 3, 8\)"):
            globe = delaunayflip.triangulate_sphere(points)
        self.assertEqual(globe.report.points_inside, 2)
        self.assertEqual(globe.used_points[[3, 8, 20]].tolist(), [-1, -1, -1])
        self.assertEqual(globe.report.points_not_finite, 1)

    def test_no_triangles(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(delaunayflip.triangulate_sphere(numpy.empty((0, 2))).triangles.shape, (0, 3))
        for points in ([[0, 0], [90, 0], [0, 90]], numpy.c_[numpy.arange(0, 360, 45), numpy.zeros(8)]):
            with self.assertWarnsRegex(UserWarning, "^[38] points without a triangle: .* in one plane"):
                globe = delaunayflip.triangulate_sphere(points)
            self.assertEqual(globe.triangles.shape, (0, 3))
            self.assertEqual(globe.voronoi_corners.shape, (0, 3))
            self.assertEqual(globe.used_points.tolist(), len(points) * [-1])
        self.assertIn("one plane", globe.report.defects)

    def test_three_places(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            part = delaunayflip.triangulate_sphere([[0, 0], [90, 0], [0, 90], [0, 90]], open=True)
        self.assertEqual(part.triangles.shape, (1, 3))
        self.assertEqual(part.neighbors.tolist(), [[-1, -1, -1]])
        self.assertEqual(part.locate([[45, 30], [-135, -30]]).tolist(), [0, -1])
        values = [1.0, 2.0, 3.0, 9.0]
        self.assertAlmostEqual(part.interpolate(values, [[45, 0]])[0], 1.5)

    def test_one_parallel(self):
        parallel = [[30 * i, 60] for i in range(12)]
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            part = delaunayflip.triangulate_sphere(parallel, open=True)
        self.assertEqual(part.triangles.shape, (10, 3))
        self.assertGreaterEqual(part.locate([[0, 75]])[0], 0)
        with self.assertWarnsRegex(UserWarning, "all are on one great circle"):
            delaunayflip.triangulate_sphere([[30 * i, 0] for i in range(12)], open=True)

    def test_lines_lie_on_the_sphere_of_the_points(self):
        points, land = make_directions(2000, 5), [[0, 0], [10, 0], [10, 10]]
        for radius in (6371.0, 0.1, 1.0):
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                part = delaunayflip.triangulate_sphere(radius * points, [[[20, 0], [30, 5]]], holes=[land])
            self.assertGreater(len(part.segments), 0)
            self.assertTrue(numpy.allclose(numpy.linalg.norm(part.points, axis=1), radius))

    def test_heights_are_no_third_column(self):
        lonlat = numpy.random.default_rng(2).uniform((-180, -80), (180, 80), (200, 2))
        with self.assertWarnsRegex(UserWarning, "not on a sphere around it; longitudes and latitudes are two"):
            delaunayflip.triangulate_sphere(numpy.c_[lonlat, numpy.full(200, 500.0)])

    def test_one_place(self):
        globe = delaunayflip.triangulate_sphere([[0, 0], [90, 0], [180, 0], [270, 0], [0, 90], [0, -90]])
        expected = globe.locate([[1, 1, 1]]).tolist()
        for place in ([1, 1, 1], numpy.array([1.0, 1.0, 1.0])):
            self.assertEqual(globe.locate(place).tolist(), expected)

    def test_voronoi_corners_of_any_size(self):
        points = make_directions(50, 3)
        corners = delaunayflip.triangulate_sphere(points).voronoi_corners
        for factor in (2.0**500, 2.0**-500):
            scaled = delaunayflip.triangulate_sphere(factor * points).voronoi_corners
            self.assertTrue(numpy.array_equal(corners, scaled))

    def test_hints(self):
        points = make_directions(100, 9)
        mesh = delaunayflip.triangulate_sphere(points)
        hint = "if it is a globe, use sphere$"
        self.assertRegex(delaunayflip.flip(7 * points, mesh.triangles).report.geometry_reason, hint)
        for changed in (points + [2, 0, 0], points * [1, 1, 0.99]):
            reason = delaunayflip.flip(changed, mesh.triangles).report.geometry_reason
            self.assertNotRegex(reason, "globe")
        hint = "use the projection sphere$"
        self.assertRegex(delaunayflip.triangulate(points).report.geometry_reason, hint)
        for changed in (points[:, :2], points + [2, 0, 0], points * [1, 1, 0]):
            self.assertNotRegex(delaunayflip.triangulate(changed).report.geometry_reason, "globe")

    def test_callbacks(self):
        shares, rows = [], []
        globe = delaunayflip.triangulate_sphere(
            make_directions(1000, 8), progress=shares.append, on_iteration=rows.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1)
        self.assertEqual(len(rows), globe.report.number_of_iterations)
        stopped = delaunayflip.triangulate_sphere(make_directions(1000, 8), progress=lambda share: share < 0.3)
        self.assertEqual(stopped.report.stop_reason, "aborted")
        self.assertEqual(len(stopped.triangles), 0)

    def test_pickle(self):
        globe = delaunayflip.triangulate_sphere(make_directions(50))
        places = make_directions(20, 2)
        found = globe.locate(places)
        copied = pickle.loads(pickle.dumps(globe))
        numpy.testing.assert_array_equal(copied.locate(places), found)
        globe.points[3] = [0, 0, 2]
        with self.assertRaisesRegex(ValueError, "have been changed"):
            pickle.loads(pickle.dumps(globe)).locate(places)

    def test_values_beside_a_coast(self):
        draw, places = numpy.random.default_rng(5), make_directions(500)
        values = places[:, 2] + places[:, 0] ** 2
        land = [[-20, -30], [30, -40], [40, 20], [0, 40]]
        river = [numpy.array([[100.0, 0], [130, 30]])]
        asked = numpy.c_[draw.uniform(-180, 180, 400), draw.uniform(-90, 90, 400)]
        globe = delaunayflip.triangulate_sphere(places, river, holes=land)
        self.assertEqual(globe.locate([[5, 0], [179, 0]]).tolist()[0], -1)
        soft = delaunayflip.SphereInterpolator(places, values)
        for method in ("linear", "natural"):
            coast = delaunayflip.SphereInterpolator(places, values, method, segments=river, holes=land)
            numpy.testing.assert_array_equal(coast(asked), globe.interpolate(values, asked, method=method))
            numpy.testing.assert_array_equal(numpy.isnan(coast(asked)), globe.locate(asked) < 0)
            numpy.testing.assert_allclose(coast(land), soft(land), atol=1e-12)
            self.assertTrue(numpy.isfinite(globe.interpolate(values, asked, method=method, outside="nearest")).all())
            again = pickle.loads(pickle.dumps(coast))
            numpy.testing.assert_array_equal(again(asked), coast(asked))
        self.assertTrue(math.isnan(coast([[5, 0]])[0]))
        numpy.testing.assert_array_equal(pickle.loads(pickle.dumps(globe)).locate(asked), globe.locate(asked))
        half = places[places[:, 2] > 0]
        opened = delaunayflip.SphereInterpolator(half, half[:, 2], open=True, segments=[[0, 1]])
        self.assertEqual(opened.triangulation.report.stop_reason, "converged")
        self.assertAlmostEqual(opened(half[:1])[0], half[0, 2])

    def test_segments(self):
        points = make_directions(200, 9)
        near = numpy.argsort(points @ points[0])[-4:-1]
        globe = delaunayflip.triangulate_sphere(points, [[0, near[0]], [0, near[2]], [5, 5]])
        self.assertEqual(globe.report.refused_segments, 0)
        self.assertEqual(set(globe.segment_numbers.tolist()), {0, 1})
        sides = {frozenset(ids[[i, i - 1]].tolist()) for ids in globe.triangles for i in range(3)}
        self.assertLessEqual(set(map(frozenset, globe.segments.tolist())), sides)
        line = [[170, 10], [-170, -10], [-160, 20]]  # by coordinates
        globe = delaunayflip.triangulate_sphere(points, [line])
        self.assertEqual(len(globe.points), 203)
        self.assertEqual(globe.segments[0, 0], 200)
        crossing = [[[0, 0], [20, 20]], [[0, 20], [20, 0]]]
        with self.assertWarnsRegex(UserWarning, r"1 segment that crosses an earlier one: .*not split"):
            globe = delaunayflip.triangulate_sphere(points, crossing)
        self.assertEqual(globe.report.refused_segments, 1)
        self.assertGreaterEqual(globe.locate([[0, 0]])[0], 0)
        with self.assertRaisesRegex(delaunayflip.InvalidMesh, "opposite sides"):
            delaunayflip.triangulate_sphere(points, [[[10, 20], [-170, -20]]])
        half = points[points[:, 2] > 0]
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "need points all around"):
            delaunayflip.triangulate_sphere(half, [[0, 1]])
        self.assertEqual(delaunayflip.triangulate_sphere(half, [[0, 1]], open=True).report.refused_segments, 0)

    def test_rings(self):
        points = make_directions(500, 10)
        square = numpy.array([[160, -20], [-160, -20], [-160, 20], [160, 20]])
        inside = delaunayflip.triangulate_sphere(points, outline=square)
        outside = delaunayflip.triangulate_sphere(points, holes=[square[::-1]])
        self.assertEqual(len(inside.triangles) + len(outside.triangles), 2 * 504 - 4)
        self.assertLess(len(inside.triangles), len(outside.triangles))
        self.assertEqual(inside.report.outside_triangles, len(outside.triangles))
        by_ids = delaunayflip.triangulate_sphere(inside.points, outline=[500, 501, 502, 503])
        self.assertEqual(sort_rows(by_ids.triangles), sort_rows(inside.triangles))
        radians = delaunayflip.triangulate_sphere(points, outline=numpy.radians(square), degrees=False)
        self.assertEqual(sort_rows(radians.triangles), sort_rows(inside.triangles))
        left = delaunayflip.triangulate_sphere(points, outline=square[::-1], ring_rule="orientation")
        self.assertEqual(len(left.triangles), len(outside.triangles))
        line = [numpy.r_[square, square[:1]]]
        for seed in ([[180, 0]], [[-1.0, 0.0, 0.1]]):
            emptied = delaunayflip.triangulate_sphere(points, line, hole_seeds=seed)
            self.assertEqual(len(emptied.triangles), len(outside.triangles))
        with self.assertWarnsRegex(UserWarning, "ring 1 of holes"):
            delaunayflip.triangulate_sphere(points, holes=[square, [[0, 0], [10, 0]]])
        with self.assertRaisesRegex(delaunayflip.InvalidMesh, "ring 0 of outline .* crosses segment 0"):
            delaunayflip.triangulate_sphere(points, [[[180, -60], [180, 60]]], outline=square)
        with self.assertWarnsRegex(UserWarning, "all triangles were removed"):
            nothing = delaunayflip.triangulate_sphere(points, hole_seeds=[[0, 0]])
        self.assertEqual(nothing.report.points_inside, 0)

    def test_refusals(self):
        high = [[10, 100], [20, 100], [20, 120]]
        for name, given in (("segments", [high]), ("holes", high), ("hole_seeds", high)):
            with self.assertWarnsRegex(UserWarning, f"{name}: 3 points with a latitude beyond 90"):
                delaunayflip.triangulate_sphere(make_directions(30), **{name: given})
        for keyword in ("degrees", "open"):
            with self.assertRaisesRegex(TypeError, f"{keyword} must be True or False, not 'x'"):
                delaunayflip.triangulate_sphere(numpy.eye(3), **{keyword: "x"})
        points = make_directions(10)
        triangles = delaunayflip.triangulate_sphere(points).triangles
        for words, options in (("several pieces", {"pieces": 2}), ("in-circle", {"criterion": "opposite-angles"})):
            with self.assertRaisesRegex(delaunayflip.InvalidOptions, words):
                delaunayflip.flip(points, triangles, geometry="sphere", **options)
        for flip in (delaunayflip.flip, delaunayflip.Session):
            with self.assertRaisesRegex(ValueError, "needs x, y and z; place_on_sphere makes them"):
                flip([[0, 0], [10, 0], [10, 10]], [[0, 1, 2]], geometry="sphere")
        with self.assertRaises(ValueError):
            delaunayflip.triangulate_sphere(numpy.zeros((3, 4)))

    def test_places_on_the_sphere(self):
        for given in ([], numpy.empty((0, 2))):
            self.assertEqual(delaunayflip.place_on_sphere(given).shape, (0, 3))
        small = delaunayflip.place_on_sphere(numpy.array([[1, 0]], numpy.uint8), degrees=False)
        self.assertAlmostEqual(small[0, 0], numpy.cos(1.0), delta=1e-15)
        masked = numpy.ma.array([[1.0, 2], [3, 4]], mask=[[0, 0], [0, 1]])
        for error, text, given in (
                (ValueError, "lonlat has masked values", masked), (TypeError, "not complex128", [[1j, 2]]),
                (TypeError, "lonlat must be real numbers, not <U1", [["1", "2"]]),
                (TypeError, "not bool", [[True, False]]), (ValueError, "lonlat must have the shape", [1, 2]),
                (ValueError, r"lonlat must have the shape \(n, 2\), not \(1, 3\)", [[1, 2, 3]])):
            with self.assertRaisesRegex(error, text):
                delaunayflip.place_on_sphere(given)
        with self.assertRaisesRegex(TypeError, "degrees must be True or False, not 'no'"):
            delaunayflip.place_on_sphere([[1, 2]], degrees="no")


def find_smooth(points):
    return numpy.exp(points[..., 0]) + points[..., 1] * points[..., 2]


class SphereValues(unittest.TestCase):
    def test_locate(self):
        """A place is inside of the three sides of its triangle."""
        globe = delaunayflip.triangulate_sphere(make_directions(300))
        places = make_directions(1000, 2)
        corners = globe.points[globe.triangles[globe.locate(places)]]
        for slot in range(3):
            sides = numpy.cross(corners[:, slot], corners[:, (slot + 1) % 3])
            self.assertTrue(((sides * places).sum(axis=1) >= 0).all())
        self.assertIn(7, globe.triangles[globe.locate(globe.points[7:8])[0]])
        self.assertEqual(globe.locate(places.reshape(10, 100, 3)).shape, (10, 100))

    def test_methods(self):
        points, places = make_directions(3000), make_directions(500, 2)
        bounds = {"linear": 0.012, "natural": 0.009}
        for method, bound in bounds.items():
            f = delaunayflip.SphereInterpolator(points, find_smooth(points), method)
            self.assertLess(abs(f(places) - find_smooth(places)).max(), bound)
            numpy.testing.assert_array_equal(f(points), find_smooth(points))
            again = f.triangulation.interpolate(find_smooth(points), places, method=method)
            numpy.testing.assert_array_equal(f(places), again)
            numpy.testing.assert_array_equal(pickle.loads(pickle.dumps(f))(places), again)
            numpy.testing.assert_array_equal(
                delaunayflip.SphereInterpolator(points, find_smooth(points), method, threads=3)(places), again)

    def test_grid(self):
        """Points where longitudes meet have the values of their grid, from both sides."""
        grid = make_grid(10)
        places = delaunayflip.triangulate_sphere(grid).points
        f = delaunayflip.SphereInterpolator(grid, find_smooth(places))
        numpy.testing.assert_array_equal(f(grid), find_smooth(places))
        numpy.testing.assert_array_equal(f(grid + [360, 0]), f(grid))
        raster = f.raster((-180, 90), (10, -10), (19, 37))
        numpy.testing.assert_array_equal(raster[::-1].ravel(), f(grid))
        numpy.testing.assert_array_equal(f(grid[:, 0], grid[:, 1]), f(grid))
        numpy.testing.assert_allclose(f(5 * places), f(grid), atol=1e-14)
        values = f.triangulation.raster(find_smooth(places), (-180, 90), (10, -10), (19, 37))
        numpy.testing.assert_array_equal(values, raster)

    def test_radians(self):
        points = numpy.random.default_rng(3).uniform((-180, -90), (180, 90), (350, 2))
        points, places = points[:300], points[300:]
        values = numpy.random.default_rng(4).normal(size=(len(points), 2))
        degrees = delaunayflip.SphereInterpolator(points, values)(places)
        f = delaunayflip.SphereInterpolator(numpy.radians(points), values, degrees=False)
        self.assertEqual(degrees.shape, (50, 2))
        numpy.testing.assert_allclose(f(numpy.radians(places)), degrees, atol=1e-9)
        first = f.raster(numpy.radians([10, 20]), numpy.radians([1, 2]), (1, 1))[0, 0]
        numpy.testing.assert_allclose(first, f(numpy.radians([[10, 20]]))[0], atol=1e-9)

    def test_latitudes_of_places(self):
        f = delaunayflip.SphereInterpolator(make_grid(30), numpy.arange(91.0))
        text = "with a latitude beyond 90 degrees"
        with self.assertWarnsRegex(UserWarning, rf"2 places {text} \(first: 0, 2\); longitudes come first") as seen:
            f([[52, 113], [13, 52], [0, 100]])
        self.assertEqual(seen.filename, __file__)
        with self.assertWarnsRegex(UserWarning, f"1 place {text}"):
            f.triangulation.locate([0.5], [100.0])
        with self.assertWarnsRegex(UserWarning, rf"4 rows {text} \(first: 0, 1, 9\)") as seen:
            f.raster((0, -130), (10, 26), (11, 3))
        self.assertEqual(seen.filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            f.raster((-180, 90), (10, -10), (19, 37))
            f([[0, 1, 100]])

    def test_outside(self):
        points = numpy.random.default_rng(5).uniform((-10, 35), (30, 70), (200, 2))
        places = [[10, 50], [-170, -50], [10, numpy.nan]]
        make = functools.partial(delaunayflip.SphereInterpolator, points, points[:, 1])
        self.assertEqual(numpy.isnan(make()(places)).tolist(), [False, True, True])
        self.assertEqual(make().locate(places).tolist()[1:], [-1, -1])
        self.assertEqual(make(fill_value=-1)(places).tolist()[1:], [-1, -1])
        nearest = make(outside="nearest")(places)
        self.assertTrue(35 <= nearest[1] <= 70)
        self.assertTrue(numpy.isnan(nearest[2]))
        with self.assertRaisesRegex(ValueError, "1 of 3 places is NaN or infinite \\(first: index 2"):
            make(outside="error")(places)
        with self.assertRaisesRegex(ValueError, "1 of 2 places is outside"):
            make(outside="error")(places[:2])
        with self.assertRaisesRegex(ValueError, "1 of 1 places is NaN or infinite"):
            make(outside="error")([[0.1, 0.2, numpy.nan]])

    def test_reused_arrays(self):
        """Angles may change after the call, because the triangulation keeps places of its own."""
        angles = numpy.random.default_rng(6).uniform((-180, -90), (180, 90), (50, 2))
        globe = delaunayflip.triangulate_sphere(angles)
        places = make_directions(20)
        expected = delaunayflip.triangulate_sphere(angles.copy()).locate(places)
        angles += [5, 0]
        self.assertEqual(globe.locate(places).tolist(), expected.tolist())

    def test_refusals(self):
        points = make_directions(20)
        with self.assertRaisesRegex(ValueError, "20 rows"):
            delaunayflip.SphereInterpolator(points, numpy.zeros(19))
        with self.assertRaisesRegex(ValueError, "one plane"):
            delaunayflip.SphereInterpolator(points[:3], numpy.zeros(3))
        with self.assertRaises(ValueError):
            delaunayflip.SphereInterpolator(points, numpy.zeros(20), method="cubic")
        with self.assertRaises(delaunayflip.Stopped):
            delaunayflip.SphereInterpolator(points, numpy.zeros(20), progress=lambda share: False)
        stopped = delaunayflip.triangulate_sphere(points, progress=lambda share: False)
        with self.assertRaisesRegex(ValueError, "stopped before its end"):
            stopped.locate([[0, 0]])
        f = delaunayflip.SphereInterpolator(points, numpy.zeros(20))
        for ragged in ([[1, 2], [3]], [[1, 2, 3], [4, 5]]):
            with self.assertRaisesRegex(ValueError, "^places cannot be made an array"):
                f(ragged)

    def test_place_of_another_library(self):
        class Column:
            """Such as a row of a table of pandas; numbers are no names of its items."""

            shape = (3,)

            def __array__(self, dtype=None, copy=None):
                return numpy.array([0.0, 1.0, 0.0], dtype)

            def __getitem__(self, name):
                raise KeyError(name)

        octahedron = numpy.r_[numpy.eye(3), -numpy.eye(3)]
        f = delaunayflip.SphereInterpolator(octahedron, numpy.arange(6.0))
        for place in (Column(), [0.0, 1.0, 0.0], numpy.array([0.0, 1.0, 0.0])):
            self.assertEqual(f(place).tolist(), [1.0])


if __name__ == "__main__":
    unittest.main()

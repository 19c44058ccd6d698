# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Values between points: interpolators, and triangulations that are asked."""
import copy
import doctest
import gc
import importlib.util
import itertools
import pickle
import signal
import threading
import unittest
import unittest.mock
import warnings

import numpy

import delaunayflip
from delaunayflip import _interpolators, _library

RANDOM = numpy.random.default_rng(1)
POINTS = RANDOM.random((300, 2))
PLACES = RANDOM.random((2000, 2)) * 1.2 - 0.1
KINDS = (delaunayflip.LinearInterpolator, delaunayflip.NaturalNeighborInterpolator)
SQUARE = [[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [0.2, 0.8]]


def plane(xy):
    return 2 * xy[..., 0] - 3 * xy[..., 1] + 1


def bumps(xy):
    return numpy.sin(7 * xy[..., 0]) * numpy.cos(5 * xy[..., 1])


def find_triangles(mesh, places):
    """The first triangle of each place, by trying all; -1: outside."""
    a, b, c = (mesh.points[mesh.triangles[:, slot], None, :2] for slot in range(3))

    def side(start, end):
        return ((end - start)[..., 0] * (places - start)[..., 1]
                - (end - start)[..., 1] * (places - start)[..., 0]) >= 0

    has = side(a, b) & side(b, c) & side(c, a)
    return numpy.where(has.any(axis=0), has.argmax(axis=0), -1)


def list_corners(mesh):
    """The places of the corners of each triangle."""
    return {frozenset(map(tuple, corners)) for corners in mesh.points[mesh.triangles].tolist()}


def clip(polygon, normal, limit):
    """The part of a convex polygon where normal * x <= limit."""
    kept = []
    for start, end in zip(polygon, [*polygon[1:], *polygon[:1]]):
        before, after = limit - start @ normal, limit - end @ normal
        if before >= 0:
            kept.append(start)
        if before * after < 0:
            kept.append(start + before / (before - after) * (end - start))
    return kept


def area_of(polygon):
    x, y = numpy.array(polygon).reshape(-1, 2).T
    return 0.5 * (x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum()


def clip_to_cell(polygon, points, own):
    """The part of a polygon that is nearer to the point `own` than to all others."""
    for other in points:
        if (other != own).any():
            polygon = clip(polygon, 2 * (other - own), other @ other - own @ own)
    return polygon


def find_sibson(points, values, place):
    """The area that each point loses to the place is its weight."""
    box = list(10 * numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float))
    cell = clip_to_cell(box, points, place)
    weights = numpy.array([area_of(clip_to_cell(cell, points, point)) for point in points])
    return weights @ values / weights.sum()


class Values(unittest.TestCase):
    def test_linear_functions_are_reproduced(self):
        for kind, options in itertools.product(KINDS, (
                {}, {"segments": [[0, 1], [2, 3]], "split_crossings": True},
                {"outline": SQUARE, "holes": [[[.4, .4], [.5, .4], [.5, .6]]]},
                {"segments": [[0, 1]], "outline": SQUARE, "split_crossings": True,
                 "breaklines": "soft"})):
            f = kind(POINTS, plane(POINTS), **options)
            found = f(PLACES)
            is_inside = find_triangles(f.triangulation, PLACES) >= 0
            self.assertGreater(is_inside.sum(), 300)
            numpy.testing.assert_array_equal(numpy.isnan(found), ~is_inside)
            numpy.testing.assert_allclose(found[is_inside], plane(PLACES[is_inside]), atol=1e-12)
            numpy.testing.assert_array_equal(f.locate(PLACES) >= 0, is_inside)

    def test_linear(self):
        f = delaunayflip.LinearInterpolator(POINTS, bumps(POINTS))
        mesh, triangles = f.triangulation, f.locate(PLACES)
        self.assertEqual(triangles.dtype, numpy.int32)
        numpy.testing.assert_array_equal(triangles, find_triangles(mesh, PLACES))
        corners = mesh.triangles[triangles[triangles >= 0]]
        for place, ids, value in zip(PLACES[triangles >= 0], corners, f(PLACES)[triangles >= 0]):
            weights = numpy.linalg.solve(numpy.c_[POINTS[ids], numpy.ones(3)].T, [*place, 1])
            self.assertAlmostEqual(value, weights @ bumps(POINTS[ids]), places=10)
        vertices = f.locate(POINTS)  # where several are, the lowest
        for point, triangle in enumerate(vertices.tolist()):
            self.assertEqual(triangle, numpy.flatnonzero((mesh.triangles == point).any(axis=1))[0])
        numpy.testing.assert_array_equal(f(POINTS), bumps(POINTS))

    def test_natural_neighbors(self):
        points = POINTS[:40]
        f = delaunayflip.NaturalNeighborInterpolator(points, bumps(points))
        inside = 0.3 + 0.4 * PLACES[:30]
        expected = [find_sibson(points, bumps(points), place) for place in inside]
        numpy.testing.assert_allclose(f(inside), expected, atol=1e-9)
        self.assertGreater(numpy.abs(delaunayflip.LinearInterpolator(points, bumps(points))(inside)
                                     - expected).max(), 1e-3)

    def test_breaklines(self):
        """A step of height 1 at a fence: hard breaklines keep the sides apart."""
        x, y = numpy.meshgrid(numpy.arange(11.0), numpy.arange(11.0))
        points = numpy.c_[x.ravel(), y.ravel()] + 0.01 * RANDOM.random((121, 2))
        points[:, 0] += points[:, 0] > 5.5
        fence = [[5.9, -1], [5.9, 11], [6.1, 11], [6.1, -1]]
        all_points = numpy.r_[points, fence]
        values = (all_points[:, 0] > 6).astype(float)
        segments = numpy.array([[121, 122], [123, 124]])
        for kind in KINDS:
            hard, soft, free = (kind(all_points, values, **options) for options in (
                {"segments": segments}, {"segments": segments, "breaklines": "soft"}, {}))
            places = numpy.array([[5.6, 4.5], [5.8, 3.3], [6.3, 5.5]])
            numpy.testing.assert_allclose(hard(places), [0, 0, 1], atol=1e-12)
            numpy.testing.assert_array_equal(soft(places), free(places))
            self.assertGreater(soft(places)[0], 0.1)
            ring = {"holes": [[[2, 2], [3, 2], [3, 3], [2, 3]]], "outside": "nearest"}
            cut = kind(points, points[:, 0], breaklines="soft", **ring)
            self.assertAlmostEqual(float(cut(2.75, 2.5)), 3.0, delta=0.02)
            self.assertEqual(cut.locate(2.75, 2.5), -1)
            ridge = numpy.r_[values, 9, 9]  # what only the segments bend
            edge = {"segments": [[125, 126]], "breaklines": "soft", "outside": "nearest"}
            bent = kind(numpy.r_[all_points, [[3, 2], [3, 3]]], ridge, holes=[[125, 126, 121]], **edge)
            beside = numpy.array([[2.999999, 2.5], [3.000001, 2.5], [3.9, 4.5], [3, 2.5]])
            self.assertEqual((bent.locate(beside[:2]) < 0).tolist(), [False, True])
            self.assertAlmostEqual(*bent(beside[:2]), delta=1e-4)
            self.assertAlmostEqual(bent(beside[1:2])[0], bent.raster((3.000001, 2.5), 1, (1, 1))[0, 0])

    def test_outside(self):
        away = numpy.array([[0.5, 0.5], [3, 0.5], [numpy.nan, 0]])
        for kind in KINDS:
            self.assertEqual(numpy.isnan(kind(POINTS, plane(POINTS))(away)).tolist(), [False, True, True])
            values = numpy.c_[plane(POINTS), numpy.full(300, numpy.nan)]
            filled = kind(POINTS, values, fill_value=-7)(away)
            self.assertEqual(filled[1:].tolist(), [[-7, -7], [-7, -7]])
            self.assertTrue(numpy.isnan(filled[0, 1]))  # of the values
            near = kind(POINTS, POINTS[:, 0], outside="nearest")(away)
            self.assertAlmostEqual(near[1], POINTS[:, 0].max(), delta=0.03)
            f = kind(POINTS, plane(POINTS), outside="error")
            f(away[:1])
            with self.assertRaisesRegex(ValueError, r"^1 of 3 places is NaN or infinite \(first: index 2\)"):
                f(away)
            with self.assertRaisesRegex(ValueError, r"^2 of 3 places are outside .*\(first: index 1\)"):
                f(away[[0, 1, 1]])
            with self.assertRaisesRegex(ValueError, r"1 of 4 places is .*\(first: index 1, 0\)"):
                f(numpy.array([[away[0], away[0]], [away[1], away[0]]]))
            with self.assertRaisesRegex(ValueError, "^1 of 1 places is outside of the triangulation$"):
                f(*away[1])

    def test_values_of_added_points(self):
        """Points of rings and crossings get values from the others."""
        crossing = {"segments": [[0, 1], [2, 3]], "split_crossings": True}
        corners = numpy.array([[0, 0], [4, 4], [2, 0], [0, 2.0]])
        mesh = delaunayflip.triangulate(corners, **crossing)
        self.assertEqual(mesh.report.crossings, 1)
        self.assertEqual(mesh.interpolate([2, 10, 1, 1], 1, 1), 4)
        self.assertEqual(mesh.interpolate([2, 10, 1, 1, 5], 1, 1), 5)
        with self.assertRaisesRegex(ValueError, "must have 4 rows, .* or 5 with those .*; there are 3"):
            mesh.interpolate([0, 8, 1], 1, 1)
        f = delaunayflip.LinearInterpolator(corners, plane(corners), outline=[[-1, 0], [1, 0], [1, 1], [-1, 1]])
        self.assertAlmostEqual(float(f(-1, 0.5)), plane(numpy.array([0, 0.5])))
        river = [numpy.array([[0.5, 0.5], [0.6, 0.9], [1.2, 1.6]])]
        f = delaunayflip.LinearInterpolator(POINTS, plane(POINTS), segments=river)
        numpy.testing.assert_allclose(f(river[0][:2]), plane(river[0][:2]), atol=1e-12)
        self.assertFalse(numpy.isnan(f(river[0][2:])).any())
        f = delaunayflip.LinearInterpolator(POINTS, numpy.r_[plane(POINTS), 7, 8, 9], segments=river)
        self.assertEqual(f(river[0]).tolist(), [7, 8, 9])
        self.assertAlmostEqual(float(f(0.55, 0.7)), 7.5)
        with self.assertWarns(UserWarning), self.assertRaisesRegex(ValueError, "6 rows, .* no triangle"):
            delaunayflip.LinearInterpolator(corners[:2], [0, 1], outline=SQUARE)


class Arrays(unittest.TestCase):
    def test_a_raster_is_its_centres(self):
        for kind, step in itertools.product(KINDS, ((0.017, -0.013), 0.0123)):
            f = kind(POINTS, numpy.c_[bumps(POINTS), plane(POINTS)])
            found = f.raster((0.05, 0.93), step, (31, 47))
            sizes = numpy.broadcast_to(step, (2,))
            x, y = numpy.meshgrid(0.05 + numpy.arange(47) * sizes[0], 0.93 + numpy.arange(31) * sizes[1])
            self.assertEqual(found.shape, (31, 47, 2))
            self.assertEqual(found.tobytes(), f(x, y).tobytes())

    def test_shapes(self):
        """Shapes are those of SciPy."""
        for kind, rest in itertools.product(KINDS, ((), (1,), (2, 3))):
            f = kind(POINTS, numpy.multiply.outer(plane(POINTS), numpy.ones(rest)))
            for places, shape in (
                    ((PLACES,), (2000,)), ((PLACES.reshape(40, 50, 2),), (40, 50)), ((0.5, 0.5), ()),
                    (([0.5, 0.5],), (1,)), (([[0.5, 0.5]],), (1,)), ((numpy.arange(3) / 3, 0.5), (3,)),
                    (((numpy.ones((4, 1)), numpy.ones(5)),), (4, 5)), (([],), (0,)),
                    ((numpy.empty((0, 7, 2)),), (0, 7)), ((PLACES[:, None, :].repeat(3, 2)[..., :3],), (2000, 1))):
                self.assertEqual(f(*places).shape, shape + rest)
                self.assertEqual(f.locate(*places).shape, shape)
            self.assertEqual(f.raster((0, 0), 1, (0, 3)).shape, (0, 3) + rest)

    def test_types(self):
        exact = delaunayflip.LinearInterpolator(POINTS, bumps(POINTS))
        narrow = POINTS.astype(numpy.float32)
        for points, values, places in (
                (narrow, bumps(narrow).astype(numpy.float32), PLACES.astype(numpy.float32)),
                (narrow.astype(">f4"), bumps(narrow), numpy.asfortranarray(PLACES)),
                (tuple(POINTS.T), bumps(POINTS).tolist(), PLACES.tolist()),
                (numpy.c_[POINTS, POINTS[:, 0]][:, :2], bumps(POINTS)[::-1][::-1], PLACES)):
            found = delaunayflip.LinearInterpolator(points, values)(places)
            self.assertEqual(found.dtype, numpy.float64)
            numpy.testing.assert_allclose(found[:500], exact(PLACES[:500]), atol=1e-4)
        whole = delaunayflip.LinearInterpolator([[0, 0], [2, 0], [0, 2]], numpy.array([0, 2, 4], numpy.uint8))
        self.assertEqual(whole([[1, 1]]).tolist(), [3])

    @unittest.skipUnless(importlib.util.find_spec("scipy"), "skipped: SciPy is not installed")
    def test_scipy(self):
        from scipy import interpolate
        values = numpy.c_[bumps(POINTS), plane(POINTS)]
        theirs = interpolate.LinearNDInterpolator(POINTS, values)(PLACES)
        ours = delaunayflip.LinearInterpolator(POINTS, values)(PLACES)
        numpy.testing.assert_allclose(ours, theirs, atol=1e-9)
        grid = tuple(numpy.mgrid[0:1:20j, 0:1:30j])
        for points in (POINTS, tuple(POINTS.T)):
            numpy.testing.assert_allclose(
                delaunayflip.griddata(points, values, grid, fill_value=3.0),
                interpolate.griddata(points, values, grid, method="linear", fill_value=3.0), atol=1e-9)

    def test_what_is_refused(self):
        f = delaunayflip.LinearInterpolator(POINTS, plane(POINTS))
        for call, error, text in (
            (lambda: f([1.0, 2.0, 3.0]), ValueError, "places must have the shape"),
            (lambda: f(PLACES[:, :1]), ValueError, r"places must have the shape \(\.\.\., 2\) or \(\.\.\., 3\), not"),
            (lambda: f(1, 2, 3), TypeError, "there are 3"),
            (lambda: f("ab"), TypeError, "places"),
            (lambda: f(numpy.zeros(3), numpy.zeros(2)), ValueError, r"x of shape \(3,\) .* y\[:, None\]"),
            (lambda: f([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]), ValueError, "as two arguments, x and y"),
            (lambda: f(list(numpy.meshgrid([0, 0.5, 1], [0, 1]))), ValueError, "as two arguments, x and y"),
            (lambda: f(True, 1), TypeError, "x must be real numbers, not bool"),
            (lambda: f([1, 2], [None, 1]), TypeError, "y must be real numbers, not object"),
            (lambda: f.raster(0, 1, (2, 2)), ValueError, "origin must be two"),
            (lambda: f.raster((0, 0), (1, 0), (2, 2)), ValueError, "step must not be 0"),
            (lambda: f.raster((0, 0), numpy.inf, (2, 2)), ValueError, "step must be"),
            (lambda: f.raster((0, 0), True, (2, 2)), ValueError, "two finite numbers other than 0; it is True"),
            (lambda: f.raster((0, 0), 1, 4), TypeError, "shape must be"),
            (lambda: f.raster((0, 0), 1, (2, -2)), ValueError, "rows and columns of shape must be integers from 0"),
            (lambda: f.raster((0, 0), 1, (2, 2.5)), TypeError, "shape must be integers from 0 to .*, not 2.5"),
            (lambda: f.raster((0, 0), 1, (2**40, 2**40)), ValueError, r"at most 2\*\*40 cells"),
            (lambda: KINDS[0](POINTS, plane(POINTS)[1:]), ValueError, "must have 300 rows, .*are 299"),
            (lambda: KINDS[0](POINTS, 7), ValueError, "values must have the shape"),
            (lambda: KINDS[0](POINTS, POINTS[:, :0]), ValueError, "values must have the shape"),
            (lambda: KINDS[0](POINTS, POINTS * 1j), TypeError, "values must be real"),
            (lambda: KINDS[0](POINTS[:2], [1, 2]), ValueError, "fewer than three"),
            (lambda: KINDS[0](POINTS, POINTS, outside="far"), ValueError, "outside must be one of"),
            (lambda: KINDS[0](POINTS, POINTS, breaklines=1), ValueError, "breaklines must be one of"),
            (lambda: KINDS[0](POINTS, POINTS, outside="nearest", fill_value=0), ValueError, "fill_value"),
            (lambda: KINDS[0](POINTS, POINTS, threads=-1), ValueError, "threads"),
            (lambda: KINDS[0](POINTS, POINTS, progress=3), TypeError, "progress must be a function, not 3"),
            (lambda: KINDS[0](POINTS, POINTS, outline=SQUARE, breaklines="soft", progress=3), TypeError,
             "progress must be a function, not 3"),
            (lambda: KINDS[0](POINTS, POINTS, outline=SQUARE, breaklines="soft")(PLACES, progress=3), TypeError,
             "progress must be a function, not 3"),
            (lambda: delaunayflip.griddata(POINTS, POINTS, PLACES, "cubic"), ValueError, "method"),
        ):
            with self.assertRaisesRegex(error, text):
                call()
        rings = {"outline": [[0, 0, 0.0], [1, 0, 0], [0, 1, 0]]}
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # heights of points do not matter
            delaunayflip.LinearInterpolator(numpy.c_[POINTS, plane(POINTS)], plane(POINTS), **rings)
        crossed = numpy.array([[0.1, 0.1], [0.9, 0.9], [0.1, 0.9], [0.9, 0.1], [0.5, numpy.inf]])
        for options, text in (
                ({"outline": [[0.1, 0.1], [0.2, 0.2]]}, "ring 0 of outline"),
                ({"segments": [crossed[:2], crossed[2:4]]}, "1 segment that crosses .* with split_crossings"),
                ({"segments": [crossed[3:]]}, "1 segment that ends at a point that is not finite"),
                ({"hole_seeds": [[7, 7]]}, "1 hole seed outside of all triangles")):
            for kind in (*KINDS, lambda points, _, **options: delaunayflip.triangulate(points, **options)):
                with self.assertWarnsRegex(UserWarning, text) as told:
                    kind(POINTS, plane(POINTS), **options)
                self.assertEqual(told.filename, __file__)

    def test_docstrings(self):
        result = doctest.testmod(_interpolators)
        self.assertGreater(result.attempted, 3)
        self.assertEqual(result.failed, 0)


class Lifetime(unittest.TestCase):
    def test_a_triangulation_is_asked(self):
        values = numpy.c_[bumps(POINTS), plane(POINTS)]
        options = {"outline": SQUARE, "alpha": 0.2}
        mesh = delaunayflip.triangulate(POINTS, **options)
        for kind, method in zip(KINDS, ("linear", "natural")):
            f = kind(POINTS, values, **options)
            numpy.testing.assert_array_equal(mesh.interpolate(values, PLACES, method=method), f(PLACES))
            raster = mesh.raster(values, (0, 0), 0.1, (9, 9), method=method, outside="nearest")
            near = kind(POINTS, values, outside="nearest", **options)
            numpy.testing.assert_array_equal(raster, near.raster((0, 0), 0.1, (9, 9)))
            numpy.testing.assert_array_equal(f.triangulation.triangles, mesh.triangles)
        numpy.testing.assert_array_equal(mesh.locate(PLACES), find_triangles(mesh, PLACES))
        limited = delaunayflip.triangulate(POINTS, maximum_iterations=0)
        numpy.testing.assert_array_equal(limited.locate(PLACES), find_triangles(limited, PLACES))
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "natural neighbou?rs need"):
            limited.interpolate(values, PLACES, method="natural")
        stopped = delaunayflip.triangulate(POINTS, progress=lambda share: False)
        with self.assertRaisesRegex(ValueError, "stopped before its end"):
            stopped.locate(PLACES)
        points = POINTS.copy()
        changed = delaunayflip.triangulate(points)
        points[:100] = points[100:200] + 0.001
        with self.assertRaisesRegex(ValueError, "have been changed"):
            changed.locate(PLACES)

    def test_arrays_that_are_used_again(self):
        """A triangulation answers for its own points, or not at all."""
        ring = [[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]]
        globe = numpy.random.default_rng(3).normal(size=(50, 3))
        make = delaunayflip.triangulate
        makers = (lambda points: make(points, outline=ring), lambda points: make(points, minimum_angle=20.0),
                  lambda points: make(points[:, ::-1][:, ::-1]), lambda points: make(points).insert([[0.5, 0.6]]),
                  lambda points: make(points.tolist()))
        for maker in makers:
            points = POINTS.copy()
            mesh = maker(points)
            values = plane(mesh.points)
            points += 1e-6
            for again in (mesh, pickle.loads(pickle.dumps(mesh)), mesh.insert([[0.25, 0.75]])):
                values = plane(again.points)
                numpy.testing.assert_allclose(again.interpolate(values, 0.5, 0.5), plane(numpy.full((1, 2), 0.5))[0],
                                              rtol=1e-12)
        line = numpy.array([[0.2, 0.2], [0.8, 0.8]])
        mesh = make(POINTS, [line])
        line += 1e-9
        with self.assertRaisesRegex(ValueError, "have been changed"):
            mesh.locate(PLACES)
        line = globe[:2] / 3.0 + 0.25
        mesh = delaunayflip.triangulate_sphere(globe / numpy.linalg.norm(globe, axis=1)[:, None],
                                               [line / numpy.linalg.norm(line, axis=1)[:, None]])
        expected = mesh.locate(globe)
        self.assertGreaterEqual(expected.min(), 0)
        lines = mesh._made_from[1]["segments"]
        lines[0] *= 1.0 + 1e-9
        mesh.__dict__.pop("_answers")
        with self.assertRaisesRegex(ValueError, "have been changed"):
            mesh.locate(globe)

    def test_readers_while_points_are_inserted(self):
        """Another thread takes the engine's triangulation between a question and its answer."""
        values, expected = plane(POINTS), delaunayflip.triangulate(POINTS).locate(PLACES)
        for ask in (lambda mesh: mesh.locate(PLACES), lambda mesh: mesh.interpolate(values, PLACES),
                    lambda mesh: mesh.raster(values, (0.4, 0.4), 0.1, (2, 2))):
            mesh = delaunayflip.triangulate(POINTS)
            known, kept = ask(mesh), mesh._answers
            more = mesh.insert([[0.5, 0.5]])
            mesh.__dict__["_answers"] = kept  # as another thread has it that began to ask
            numpy.testing.assert_array_equal(ask(mesh), known)
            del mesh.__dict__["_answers"]
            self.assertEqual(list_corners(mesh.insert([[0.5, 0.5]])), list_corners(more))
        numpy.testing.assert_array_equal(mesh.locate(PLACES), expected)

    def test_points_without_others(self):
        """A triangulation without points takes the columns of those that come."""
        for columns in (2, 3):
            places = numpy.random.default_rng(columns).random((20, columns))
            mesh = delaunayflip.triangulate([]).insert(places)
            self.assertEqual(mesh.points.shape, places.shape)
            self.assertEqual(list_corners(mesh), list_corners(delaunayflip.triangulate(places)))
            again = pickle.loads(pickle.dumps(mesh)).insert([places[0] + 0.01])
            self.assertEqual(len(again.points), 21)
            self.assertGreaterEqual(again.locate([[0.5, 0.5]])[0], 0)

    def test_warnings_of_insertions(self):
        """They are those of `triangulate`, but only where something is new."""
        with self.assertWarnsRegex(UserWarning, "segment that crosses"):
            mesh = delaunayflip.triangulate([[0, 0], [1, 1], [1, 0], [0, 1]], [[0, 1], [2, 3]])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mesh = mesh.insert([[0.5, 0.25]])
        corners = [[0, 0], [4, 0], [4, 0.3], [0, 4]]
        with self.assertWarnsRegex(UserWarning, "^2 triangles that are not as good as wanted"):
            mesh = delaunayflip.triangulate(corners, minimum_angle=30, keep_boundary=True)
        with self.assertWarnsRegex(UserWarning, "^[3-9] triangles that are not as good as wanted") as told:
            mesh = mesh.insert([[2, 0.1], [1, 1]])
        self.assertEqual(told.filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            copy.copy(mesh).locate([[0.5, 0.5]])  # triangulates and inserts again

    def test_points_are_inserted(self):
        places = numpy.random.default_rng(8).random((250, 2))
        values, more_values = plane(POINTS), plane(places)
        for options in ({}, {"outline": SQUARE, "segments": [[[0.2, 0.2], [0.8, 0.8]], [[0.2, 0.8], [0.8, 0.2]]],
                             "split_crossings": True}):
            first = mesh = delaunayflip.triangulate(POINTS, **options)
            crossings = mesh.report.crossings
            inner = len(mesh.points) - crossings
            kept = mesh.locate(PLACES)
            for batch in (places[:100], places[100:], POINTS[:3], [[0.5, numpy.nan]], []):
                mesh = mesh.insert(batch)
            whole = delaunayflip.triangulate(numpy.concatenate([POINTS, places]), **options)
            self.assertEqual(list_corners(mesh), list_corners(whole))
            self.assertEqual(len(mesh.points), len(whole.points) + 4)
            self.assertEqual(mesh.report.crossings, crossings)
            numpy.testing.assert_array_equal(mesh.points[:inner], first.points[:inner])
            numpy.testing.assert_array_equal(mesh.points[inner:inner + 250], places)
            numpy.testing.assert_array_equal(mesh.used_points[inner + 250:inner + 253], [0, 1, 2])
            numpy.testing.assert_array_equal(first.locate(PLACES), kept)  # triangulated again
            found = mesh.interpolate(plane(mesh.points[:len(mesh.points) - crossings]), PLACES)
            inside = mesh.locate(PLACES) >= 0
            numpy.testing.assert_allclose(found[inside], plane(PLACES)[inside])
            numpy.testing.assert_array_equal(pickle.loads(pickle.dumps(mesh)).locate(PLACES), mesh.locate(PLACES))
        f = delaunayflip.LinearInterpolator(POINTS, bumps(POINTS))
        expected = f(PLACES)
        more = f.triangulation.insert(places.astype(numpy.float32))
        numpy.testing.assert_array_equal(f(PLACES), expected)
        self.assertEqual(len(more.interpolate(numpy.r_[values, more_values], PLACES)), len(PLACES))
        with self.assertRaisesRegex(ValueError, "must have 2 columns"):
            mesh.insert([[0.5, 0.5, 0.0]])
        refined = delaunayflip.triangulate(POINTS, minimum_angle=20)
        whole = delaunayflip.triangulate(numpy.concatenate([POINTS, places]), minimum_angle=20)
        self.assertEqual(list_corners(refined.insert(places)), list_corners(whole))
        refined = delaunayflip.triangulate(POINTS, size=numpy.full(len(POINTS), 0.1))
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "have no sizes here"):
            refined.insert(places)
        self.assertEqual(refined.locate([[0.5, 0.5]]).shape, (1,))
        with self.assertRaises(delaunayflip.Stopped):
            mesh.insert([[0.5, 0.6]], progress=lambda share: False)
        numpy.testing.assert_array_equal(mesh.insert([[0.5, 0.6]]).points[-2], [0.5, 0.6])

    def test_copies(self):
        f = delaunayflip.NaturalNeighborInterpolator(POINTS, bumps(POINTS), outside="nearest",
                                                     outline=SQUARE, breaklines="soft")
        mesh = f.triangulation
        for copied in (copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))):
            numpy.testing.assert_array_equal(copied(f)(PLACES), f(PLACES))
            numpy.testing.assert_array_equal(copied(mesh).locate(PLACES), f.locate(PLACES))

    def test_memory_is_freed(self):
        with unittest.mock.patch.object(_library, "run", wraps=_library.run) as run:
            gc.disable()
            try:
                mesh = delaunayflip.triangulate(POINTS)
                self.assertIn("close", [made.args[0] for made in run.call_args_list])
                run.reset_mock()
                mesh.locate(PLACES)
                f = delaunayflip.LinearInterpolator(POINTS, bumps(POINTS))
                self.assertNotIn("close", [made.args[0] for made in run.call_args_list])
                del mesh, f
                self.assertEqual([made.args[0] for made in run.call_args_list].count("close"), 2)
            finally:
                gc.enable()

    def test_threads_take_turns(self):
        f = delaunayflip.NaturalNeighborInterpolator(POINTS, bumps(POINTS))
        expected, found = f(PLACES), []
        has_begun, may_end = threading.Event(), threading.Event()

        def wait(_):
            has_begun.set()
            may_end.wait(60)

        first = threading.Thread(target=lambda: found.append(f(PLACES, progress=wait)))
        second = threading.Thread(target=lambda: found.append(f(PLACES)))
        first.start()
        self.assertTrue(has_begun.wait(60))
        second.start()
        second.join(0.2)
        self.assertTrue(second.is_alive())
        may_end.set()
        first.join()
        second.join()
        numpy.testing.assert_array_equal(found, [expected, expected])

    def test_progress(self):
        # A shell starts what it runs in the background with this signal ignored.
        self.addCleanup(signal.signal, signal.SIGINT,
                        signal.signal(signal.SIGINT, signal.default_int_handler))
        values, shares = plane(POINTS), []
        f = delaunayflip.LinearInterpolator(POINTS, values, outline=SQUARE, breaklines="soft",
                                            progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(shares[-1], 0.5)
        shares.clear()
        f(PLACES, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertLessEqual(shares[-1], 1.0)
        mesh = f.triangulation
        for ask in (lambda **options: f(PLACES, **options), lambda **options: f.locate(PLACES, **options),
                    lambda **options: f.raster((0, 0), 0.1, (5, 5), **options), lambda **options: f([], **options),
                    lambda **options: mesh.interpolate(values, PLACES, **options),
                    lambda **options: mesh.locate(PLACES, **options)):
            shares.clear()
            ask(progress=shares.append)
            self.assertEqual(shares, sorted(shares))
            self.assertEqual(shares[-1], 1.0)
        for call in (lambda **options: delaunayflip.LinearInterpolator(POINTS, values, **options),
                     lambda **options: f(PLACES, **options),
                     lambda **options: f.locate(PLACES, **options),
                     lambda **options: f.raster((0, 0), 0.1, (5, 5), **options)):
            with self.assertRaises(delaunayflip.Stopped):
                call(progress=lambda share: False)
            with self.assertRaises(ZeroDivisionError):
                call(progress=lambda share: 1 // 0)
            with self.assertRaises(KeyboardInterrupt):
                call(progress=lambda share: signal.raise_signal(signal.SIGINT))
            with self.assertRaises(TypeError):
                call(progress=7)
        with self.assertRaisesRegex(RuntimeError, "an observer cannot ask"):
            f.locate(PLACES, progress=lambda share: f.locate(PLACES))
        f.locate(PLACES[:1])

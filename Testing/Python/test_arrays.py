# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The package's functions for NumPy arrays. None of it may load VTK."""
import contextlib
import copy
import ctypes
import doctest
import functools
import gc
import inspect
import itertools
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import types
import typing
import unittest
import unittest.mock
import warnings
import weakref

import numpy

import delaunayflip
from delaunayflip import _arrays, _ask, _library, _options, _points, _report, _session, _surface
from lattice import sheared_lattice

ROOT = pathlib.Path(__file__).resolve().parents[2]

POINTS = numpy.array([[0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]], dtype=float)
TRIANGLES = numpy.array([[0, 1, 2], [0, 2, 3]])


class Triangulate(unittest.TestCase):
    def test_equals_flips_of_another_triangulation(self):
        points = numpy.random.default_rng(1).integers(0, 40, (800, 2)).astype(float)
        result = delaunayflip.triangulate(points)
        start = delaunayflip.triangulate(points, maximum_iterations=0)
        self.assertGreater(start.report.non_delaunay_after, 0)
        flipped = delaunayflip.flip(points, start.triangles, tie_rule="canonical")
        canonical = [{frozenset(ids) for ids in mesh.triangles.tolist()} for mesh in (result, flipped)]
        self.assertEqual(*canonical)
        shuffled = numpy.random.default_rng(2).permutation(len(points))
        again = delaunayflip.triangulate(points[shuffled]).triangles
        places = [{frozenset(map(tuple, corners)) for corners in where[triangles].tolist()}
                  for where, triangles in ((points, result.triangles), (points[shuffled], again))]
        self.assertEqual(*places)
        border = (result.neighbors == -1).sum()
        self.assertEqual(len(result.triangles), 2 * len(set(result.used_points)) - 2 - border)
        for triangle, slot in ((0, 0), (5, 1), (9, 2)):
            across = result.neighbors[triangle, slot]
            if across >= 0:
                self.assertIn(triangle, result.neighbors[across])
                self.assertNotIn(result.triangles[triangle, slot], result.triangles[across])

    def test_points_that_are_not_used(self):
        points = numpy.array([[1, 0, 9], [0, 0, 9], [numpy.nan, 0, 9], [-0.0, 0, 1], [0, 1, numpy.inf]],
                             dtype=numpy.float32)
        result = delaunayflip.triangulate(points)
        self.assertEqual(result.triangles.tolist(), [[1, 0, 4]])
        self.assertEqual(result.used_points.tolist(), [0, 1, -1, 1, 4])
        self.assertIn("1 duplicate point skipped", result.report.defects)
        with unittest.mock.patch.object(_library, "call", wraps=_library.call) as call:
            whole = delaunayflip.triangulate(points[:2])  # nothing is fetched, maybe from a GPU
        self.assertNotIn("store_used_points", [made.args[0] for made in call.call_args_list])
        self.assertEqual(whole.used_points.tolist(), [0, 1])
        self.assertIs(whole.used_points, whole.used_points)
        for none in (numpy.empty((0, 2)), points[:1], [[0, 0], [1, 1], [2, 2], [3, 3]]):
            self.assertEqual(delaunayflip.triangulate(none).triangles.shape, (0, 3))

    def test_segments(self):
        points = numpy.random.default_rng(4).random((500, 3))
        segments = [[0, 1], [2, 3], [4, 5], [6, 7]]
        refused = delaunayflip.triangulate(points, segments)
        self.assertRegex(refused.report.defects,
                         r"cross(es)? an earlier one: with split_crossings .*\(first: (\d+)-(\d+) "
                         r"crosses segment (\d) \(points \d and \d\)")
        split = delaunayflip.triangulate(points, segments, split_crossings=True)
        self.assertEqual(split.report.refused_segments, 0)
        self.assertEqual(len(split.points), 500 + split.report.crossings)
        self.assertEqual(len(split.used_points), len(split.points))
        for result in (refused, split):
            edges = {frozenset(ids) for triangle in result.triangles.tolist()
                     for ids in itertools.combinations(triangle, 2)}
            self.assertLessEqual({frozenset(ids) for ids in result.segments.tolist()}, edges)
        for crossing in split.points[500:]:  # on the first segment that it splits, z too
            distances = []
            for start, end in points[segments]:
                share = (crossing - start)[:2] @ (end - start)[:2] / ((end - start)[:2] @ (end - start)[:2])
                distances.append(numpy.abs(start + share * (end - start) - crossing).max())
            self.assertLess(min(distances), 1e-12)
        with self.assertRaisesRegex(delaunayflip.InvalidMesh, "names point 500"):
            delaunayflip.triangulate(points, [[0, 500]])
        with self.assertRaises(TypeError):
            delaunayflip.triangulate(points, [[0.0, 1.0]])
        with self.assertRaises(ValueError):
            delaunayflip.triangulate(points, [0, 1, 2])

    def test_outline_and_holes(self):
        points = numpy.random.default_rng(5).random((1000, 2))

        def area(**options):
            result = delaunayflip.triangulate(points, **options)
            a, b, c = (result.points[result.triangles[:, slot]] for slot in range(3))
            return round(0.5 * numpy.sum((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]), 9)

        square, triangle = [[.1, .1], [.9, .1], [.9, .9], [.1, .9]], [[.3, .3], [.3, .5], [.5, .5]]
        self.assertEqual(area(outline=square), 0.64)
        self.assertEqual(area(outline=square[::-1], holes=[triangle]), 0.62)
        self.assertEqual(area(outline=[square, [[2, 2], [3, 2], [3, 3]]]), 1.14)
        inner, middle = [[.2, .2], [.2, .8], [.8, .8], [.8, .2]], [[.4, .4], [.6, .4], [.6, .6], [.4, .6]]
        for given, wanted in (({"outline": [square, inner]}, 0.28),
                              ({"outline": [square, inner, middle]}, 0.32),
                              ({"outline": square, "holes": [inner, middle]}, 0.32)):
            self.assertEqual(area(**given), wanted)
        for given, wanted in (({"outline": [square, inner]}, 0.28),
                              ({"outline": [square, inner[::-1], middle]}, 0.64),
                              ({"outline": square, "holes": [inner[::-1], middle]}, 0.28)):
            self.assertEqual(area(ring_rule="nonzero", **given), wanted)
        whole = area()
        for hole in (triangle, [triangle], numpy.array(triangle), [*triangle, triangle[0]]):
            self.assertAlmostEqual(area(holes=hole), whole - 0.02)
        self.assertEqual(area(outline=square, hole_seeds=[[.5, .5]]), 0)  # no segment stops it
        result = delaunayflip.triangulate(points, outline=square)
        self.assertEqual(result.points[1000:].tolist(), square)
        self.assertEqual(result.report.triangles, len(result.triangles))
        ids = delaunayflip.triangulate(result.points, outline=[1000, 1001, 1002, 1003])
        self.assertEqual(ids.triangles.tolist(), result.triangles.tolist())
        with self.assertRaisesRegex(
                delaunayflip.InvalidMesh, "ring 0 of holes from .* crosses .*: with split_crossings"):
            delaunayflip.triangulate(points, outline=square, holes=[[[.5, .5], [2, .5], [2, .6]]])
        for ring in ([[.2, .2], [.4, .4], [.3, .3]], [5, 5, 5], [[.5, .6]], [1, 2], [7], [[], [0, 1]]):
            for name in ("outline", "holes"):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    result = delaunayflip.triangulate(points, **{name: ring})
                with self.assertWarnsRegex(UserWarning, "without an area, left out"):
                    self.assertAlmostEqual(area(**{name: ring}), whole)
                self.assertGreater(result.report.left_out_rings, 0)
                self.assertRegex(
                    result.report.defects, rf"rings? without an area, left out \(first: ring 0 of {name}")
        with self.assertWarnsRegex(
                UserWarning, r"1 ring with the edges .*, left out \(first: ring 1 of holes\)"):
            self.assertAlmostEqual(area(holes=[triangle, triangle]), whole - 0.02)
        with self.assertWarnsRegex(UserWarning, r"1 ring with a loop .*, counted once \(first: ring 0 of holes\)"):
            self.assertAlmostEqual(area(holes=[[*triangle, *triangle]]), whole - 0.02)
        with self.assertWarnsRegex(UserWarning, "points? of holes on the convex hull"):
            area(holes=[[[2, .2], [2, .8], [3, .2]]])
        spatial = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, .5]]  # integers first
        self.assertEqual(area(outline=spatial), 1)
        for name, values, error, text in (
                ("outline", numpy.array(spatial, int), ValueError, "outline: rows of three .* as floats"),
                ("outline", [[0, 1]], ValueError, "outline: rows of two integers are the coordinates of one ring"),
                ("outline", numpy.ma.masked_equal([0, 1, 2, 3], 3), ValueError, "outline has masked"),
                ("holes", [numpy.ma.masked_equal(square, .9)], ValueError, "holes has masked"),
                ("holes", numpy.ma.masked_equal(square, .9), ValueError, "holes has masked"),
                ("outline", numpy.array(square, complex), TypeError, "outline must be real"),
                *((name, value, TypeError, f"{name} must be a .*, not {kind}")
                  for name in ("outline", "holes") for value, kind in (
                      ("012", "str"), ({0, 1, 2}, "set"), (iter(square), "list_iterator"), (7, "int"))),
                ("holes", [square, {0, 1, 2}], TypeError, "ring 1 of holes must be .*, not set"),
                ("outline", ["0", "1", "2"], TypeError, "outline must be integers"),
                ("outline", [[[0, 0], [1]]], ValueError, "outline cannot be made an array"),
                ("ring_rule", "any", ValueError, "ring_rule must be one of evenodd, nonzero"),
                ("hole_seeds", [1, 2], ValueError, "hole_seeds must have the shape")):
            with self.assertRaisesRegex(error, text):
                delaunayflip.triangulate(points, **{name: values})

    def test_rings_without_heights(self):
        points = numpy.random.default_rng(5).random((100, 3)) + [0, 0, 7]
        square, hole = [[.1, .1], [.9, .1], [.9, .9], [.1, .9]], [[.3, .3, 7.], [.3, .5, 7.], [.5, .5, 7.]]
        away = [[.92, .1], [.95, .1], [.95, .2]]  # no triangle is left at these
        for rings, count in (({"outline": square, "holes": [hole]}, 4),
                             ({"outline": square, "holes": [away]}, 4), ({"holes": [square, hole]}, 4),
                             ({"holes": [[[x, y, 0.] for x, y in square]]}, 4),
                             ({"holes": [hole, [[.7, .7, 0.], [.8, .7, 0.], [.8, .8, 0.]]]}, 0)):
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                result = delaunayflip.triangulate(points, **rings)
                delaunayflip.triangulate(points[:, :2], **rings)
            text = f"{count} points of segments without heights (z = 0 throughout; the given points"
            self.assertEqual([str(one.message)[:len(text)] for one in told], [text] * (count > 0))
            self.assertEqual(text in result.report.defects, count > 0)
            self.assertEqual("they have got the heights" in result.report.defects, count > 0)

    def test_heights_that_are_not_finite(self):
        points = numpy.random.default_rng(5).random((100, 3)) + [0, 0, 7]
        line = numpy.array([[.2, .2, 9], [.4, .5, numpy.nan], [.6, .5, 9.], [.8, .6, numpy.inf]])
        for heights, flat, fate in (
            (None, [], "they have got the heights of the given points there; heights=\"own\" keeps their z"),
            ("survey", [], ""), ("own", [], "the mesh has no heights there; if it should, give them heights"),
            (None, [[.1, .8], [.5, .9]], "heights=\"own\" keeps their z"),
        ):
            lines = [line, flat] if flat else [line]
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                result = delaunayflip.triangulate(points, lines, heights=heights)
                delaunayflip.LinearInterpolator(points, points[:, 2], segments=lines)
            why = "z = 0 throughout, or not finite" if flat else "z is not finite"
            text = f"{2 + len(flat)} points of segments without heights ({why}; the given points have z = 7"
            self.assertEqual([str(one.message)[:len(text)] for one in told], [text] * bool(fate))
            self.assertIn(fate, result.report.defects)
            kept = result.points[100:104, 2]
            self.assertEqual(numpy.isfinite(kept).all(), heights != "own")
            self.assertEqual(kept[0] == 9, heights != "survey")

    def test_lines(self):
        """Lines by coordinates are segments between new points, and their points come before rings."""
        points = numpy.random.default_rng(6).random((200, 3)) + [0, 0, 4]
        river = numpy.array([[.1, .1, 5], [.5, .2, 5], [.9, .1, 5.]])
        lake = [[.4, .4, 6], [.6, .4, 6], [.6, .6, 6], [.4, .4, 6.]]
        square = [[.05, .05, 4], [.95, .05, 4], [.95, .95, 4], [.05, .95, 4.]]
        made = delaunayflip.triangulate(points, [river, lake], outline=square)
        every = numpy.r_[points, river, lake[:3], square]
        ids = [[200, 201], [201, 202], [203, 204], [204, 205], [205, 203]]
        same = delaunayflip.triangulate(every, ids, outline=[206, 207, 208, 209])
        numpy.testing.assert_array_equal(made.points, every)
        numpy.testing.assert_array_equal(made.triangles, same.triangles)
        numpy.testing.assert_array_equal(made.segments, same.segments)
        for given in (river[None], numpy.stack([river[:2], river[1:]]), (river.tolist(),)):
            again = delaunayflip.triangulate(points, given)
            self.assertEqual(again.report.segment_edges,
                             delaunayflip.triangulate(every[:203], ids[:2]).report.segment_edges)
        with self.assertWarnsRegex(UserWarning, "3 points of segments .* they have got the heights"):
            flat = delaunayflip.triangulate(points, [river[:, :2], lake], outline=square)
        self.assertTrue((flat.points[200:203, 2] > 4).all())
        for line in ([[0.1, 0.1], [0.9, 0.9]], numpy.array([[0.1, 0.1], [0.9, 0.9]])):
            with self.assertRaisesRegex(TypeError, r"put a single line into a list"):
                delaunayflip.triangulate(POINTS, line)
        with self.assertRaisesRegex(ValueError, r"line 1 of segments must have the shape"):
            delaunayflip.triangulate(points, [river, [[1, 2, 3, 4.]]])
        crossed = delaunayflip.triangulate(points, [river, [[.3, 0], [.3, 1]]], heights="own")
        self.assertRegex(crossed.report.defects, "203-204 crosses segment")

    def test_tables(self):
        """A table, as of pandas, has no dtype, and its items are columns."""
        class Table:
            def __init__(self, rows):
                self.rows = numpy.array(rows)
                self.shape = self.rows.shape

            def __array__(self, dtype=None, copy=None):
                return self.rows.astype(dtype or self.rows.dtype)

            def __len__(self):
                return len(self.rows)

            def __iter__(self):
                return iter("xyzabcdefg"[:self.shape[1]])

            def __getitem__(self, name):
                raise KeyError(name)

        points = numpy.random.default_rng(12).random((40, 2))
        square = [[.05, .05], [.95, .05], [.95, .95], [.05, .95]]
        regions = [[.5, .5, 3, 0.01], [.4, .4, 3, 0.01]]
        for options in ({"segments": [[0, 1], [2, 3]]}, {"outline": [[4, 9, 17], [4, 9, 30]]}, {"outline": square},
                        {"outline": square, "hole_seeds": [[.5, .5]]}, {"regions": regions, "outline": square}):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                same = delaunayflip.triangulate(points, **options)
                given = {name: Table(rows) for name, rows in options.items()}
                made = delaunayflip.triangulate(Table(points), **given)
            numpy.testing.assert_array_equal(made.triangles, same.triangles)
            numpy.testing.assert_array_equal(made.regions, same.regions)

    def test_empty_lines(self):
        points = numpy.random.default_rng(12).random((40, 2))
        line = [[.1, .2], [.3, .9]]
        plain, lined = (delaunayflip.triangulate(points, given).triangles for given in (None, [line]))
        for given in (numpy.empty((0, 2)), numpy.empty(0), [], [[]], [numpy.empty((0, 3))]):
            numpy.testing.assert_array_equal(delaunayflip.triangulate(points, given).triangles, plain)
        for given in ([[], line], [numpy.empty((0, 2)), line, []]):
            numpy.testing.assert_array_equal(delaunayflip.triangulate(points, given).triangles, lined)

    def test_heights_of_rings(self):
        """A plane is reproduced; beyond the survey its nearest place counts."""
        points = numpy.random.default_rng(5).random((100, 3))
        points[:4, :2] = [[0, 0], [1, 0], [1, 1], [0, 1]]
        points[:, 2] = 3 * points[:, 0] - points[:, 1] + 7
        square, hole = [[-1, .1], [.9, .1], [.9, .9], [.1, .9]], [[.3, .3, 2.], [.3, .5, 2.], [.5, .5, 2.]]
        on_plane = [6.9, 9.6, 8.8, 6.4]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            flat = delaunayflip.triangulate(points, outline=square, holes=hole)
        numpy.testing.assert_allclose(flat.points[100:, 2], [*on_plane, 2, 2, 2], rtol=1e-12)
        numpy.testing.assert_array_equal(flat.points[:100], points)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            survey = delaunayflip.triangulate(
                points.astype(numpy.float32), outline=square, holes=hole, heights="survey")
            own = delaunayflip.triangulate(points, outline=square, holes=hole, heights="own")
            two = delaunayflip.triangulate(points[:, :2], outline=square, heights="survey")
        numpy.testing.assert_allclose(survey.points[100:, 2], [*on_plane, 7.6, 7.4, 8], rtol=1e-6)
        self.assertEqual(own.points[100:, 2].tolist(), [0, 0, 0, 0, 2, 2, 2])
        self.assertEqual(two.points.shape, (104, 2))
        for mesh in (survey, own):
            self.assertEqual(len(mesh.triangles), len(flat.triangles))
        with self.assertRaisesRegex(ValueError, "heights must be one of survey, own, not 'auto'"):
            delaunayflip.triangulate(points, heights="auto")
        with self.assertWarnsRegex(UserWarning, "the mesh goes to z = 0 there; if it should not"):
            line = delaunayflip.triangulate([[0, 0, 5], [1, 1, 5], [2, 2, 5.]], outline=square)
        self.assertEqual(line.points[3:, 2].tolist(), [0, 0, 0, 0])  # without a survey to take them from

    def test_nothing_is_left(self):
        points = numpy.random.default_rng(5).random((100, 2)) * [10, 1]
        points[:2] = [[0, 0], [10, 1]]
        there, here = [[500, 0], [510, 0], [510.5, 1]], [[1, .1], [9, .1], [9, .9], [1, .9]]
        box = "the points lie in x 0 to 10, y 0 to 1"
        for options, used, texts in (
                ({"outline": there}, 3, ["all triangles but those between", box, "the segments in x 500 to 510.5, y 0 to 1"]),
                ({"outline": here, "holes": [here]}, 0, ["all triangles were removed", "the segments in x 1 to 9, y 0.1 to"]),
                ({"longest_edge": 1e-9}, 0, ["all triangles were removed", box]),
                ({"outline": here}, None, [])):
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                result = delaunayflip.triangulate(points, **options)
            self.assertEqual(len(told), len(texts) > 0)
            self.assertEqual(result.report.used_points, len(numpy.unique(result.triangles)))
            self.assertIn(used, (None, result.report.used_points))
            for text in ["100 points without a triangle", *texts] if texts else ():
                self.assertIn(text, result.report.defects)
                self.assertIn(text, str(told[0].message))
            self.assertEqual(numpy.isnan(result.report.minimum_angle_after), used == 0)
        whole = delaunayflip.triangulate(numpy.append(points, points[:3], axis=0))
        self.assertEqual(whole.report.used_points, 100)
        self.assertEqual(delaunayflip.triangulate([[0, 0], [1, 1], [2, 2]]).report.used_points, 0)

    def test_rings_of_any_size(self):
        places = numpy.array([[0, 0], [1, 0], [1, 1], [0, 1], [.5, .5]])
        for scale in (1e160, 1, 1e-165):
            for ring in ([0, 1, 2], [2, 1, 0]):
                self.assertEqual(len(delaunayflip.triangulate(scale * places, outline=ring).triangles), 2)
                self.assertEqual(len(delaunayflip.triangulate(scale * places, holes=[ring]).triangles), 2)

    def test_what_is_left_out(self):
        points = numpy.random.default_rng(6).random((2000, 2))
        result = delaunayflip.triangulate(points, longest_edge=0.05, point_tolerance=0.01)
        lengths = numpy.linalg.norm(
            points[result.triangles] - points[numpy.roll(result.triangles, 1, axis=1)], axis=2)
        self.assertLessEqual(lengths.max(), 0.05)
        self.assertGreaterEqual(lengths.min(), 0.01)
        self.assertGreater(result.report.large_triangles, 0)
        self.assertEqual(result.report.points_too_near, (result.used_points != numpy.arange(2000)).sum())
        few = delaunayflip.triangulate(points, alpha=0.02)
        self.assertLess(len(few.triangles), len(delaunayflip.triangulate(points).triangles))
        for name, value, error in (
                ("alpha", -1, delaunayflip.InvalidOptions), ("alpha", 10**400, delaunayflip.InvalidOptions),
                ("longest_edge", "x", TypeError), ("point_tolerance", None, TypeError),
                ("split_crossings", "no", TypeError), ("split_crossings", numpy.nan, TypeError)):
            with self.assertRaisesRegex(error, name):
                delaunayflip.triangulate(points, **{name: value})

    def test_can_be_stopped(self):
        points = numpy.random.default_rng(3).random((20000, 2))
        stopped = delaunayflip.triangulate(points, progress=lambda share: share < 0.2)
        self.assertEqual(stopped.report.stop_reason, "aborted")
        self.assertEqual(len(stopped.triangles), 0)
        numpy.testing.assert_array_equal(stopped.used_points, numpy.arange(20000))
        with (self.assertRaises(ZeroDivisionError),
              unittest.mock.patch.object(_library, "run", wraps=_library.run) as run):
            delaunayflip.triangulate(points, progress=lambda share: 1 / 0)
        self.assertEqual(run.call_args.args[0], "close")


class Refine(unittest.TestCase):
    """What refinement promises, measured in the mesh itself."""

    SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
    BAY = [[0.0, 0, 1], [9, 1, 2], [10, 8, 3], [6, 5, 4], [5, 9, 5], [1, 8, 6]]
    ISLAND = [[3.0, 3, 1], [4, 3.2, 2], [3.6, 4, 3]]

    def refine(self, *arguments, **options):
        """The mesh, and the corners of its triangles in x and y."""
        mesh = delaunayflip.triangulate(*arguments, **options)
        self.assertEqual(mesh.report.stop_reason, "converged")
        self.assertEqual(mesh.report.points, len(mesh.points))
        again = delaunayflip.triangulate(mesh.points[:, :2], mesh.segments)
        kept = {frozenset(ids) for ids in again.triangles.tolist()}
        self.assertLessEqual({frozenset(ids) for ids in mesh.triangles.tolist()}, kept)
        return mesh, mesh.points[mesh.triangles, :2].astype(float)

    def list_areas(self, corners):
        (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        return (ax * by - ay * bx) / 2

    def list_longest(self, corners):
        return numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2).max(axis=1)

    def test_angles_and_areas(self):
        for angle, area in ((20.0, 0.0), (28.0, 0.5), (0.0, 0.2)):
            mesh, corners = self.refine(numpy.empty((0, 3)), outline=self.BAY, holes=self.ISLAND,
                                        minimum_angle=angle, maximum_area=area)
            report = mesh.report
            self.assertEqual((report.unrefined_triangles, report.reached_point_limit), (0, 0))
            self.assertEqual(len(mesh.points), 9 + report.refinement_points)
            self.assertGreater(report.refinement_rounds, 0)
            angles = delaunayflip.smallest_angles(mesh.points[:, :2], mesh.triangles)
            self.assertGreaterEqual(angles.min(), angle - 1e-9)
            self.assertAlmostEqual(angles.min(), report.minimum_angle_after, 6)
            areas = self.list_areas(corners)
            self.assertLessEqual(areas.max(), (area or numpy.inf) * (1 + 1e-12))
            ring, hole = (numpy.array(each)[None, :, :2] for each in (self.BAY, self.ISLAND))
            whole = [sum(self.list_areas(numpy.stack([one[:, 0], one[:, i], one[:, i + 1]], axis=1))[0]
                         for i in range(1, one.shape[1] - 1)) for one in (ring, hole)]
            self.assertAlmostEqual(areas.sum(), whole[0] - whole[1], 9)

    def test_segments_are_covered(self):
        mesh, _ = self.refine(numpy.empty((0, 3)), outline=self.BAY, holes=self.ISLAND, minimum_angle=25)
        given = numpy.array([*self.BAY, *self.ISLAND])
        segments = [(i, (i + 1) % 6) for i in range(6)] + [(6, 7), (7, 8), (8, 6)]
        self.assertEqual(len(mesh.segment_numbers), len(mesh.segments))
        for number, (start, end) in enumerate(segments):
            pieces = mesh.points[mesh.segments[mesh.segment_numbers == number]]
            length = numpy.linalg.norm(given[end, :2] - given[start, :2])
            along = numpy.linalg.norm(pieces[:, 1, :2] - pieces[:, 0, :2], axis=1)
            self.assertAlmostEqual(along.sum(), length, 9)
            share = numpy.linalg.norm(pieces[:, :, :2] - given[start, :2], axis=2)[..., None] / length
            numpy.testing.assert_allclose(pieces, (1 - share) * given[start] + share * given[end], atol=1e-9)
            inner = numpy.setdiff1d(mesh.segments[mesh.segment_numbers == number], [start, end])
            numpy.testing.assert_array_equal(numpy.flatnonzero(mesh.point_segments == number), inner)
        self.assertGreater(numpy.count_nonzero(mesh.point_segments >= 0), 5)
        self.assertEqual((len(mesh.point_segments), mesh.point_segments[:9].tolist()), (len(mesh.points), 9 * [-1]))

    def test_heights_and_values(self):
        points = numpy.random.default_rng(3).random((60, 3)) * 10
        points[:, 2] = 2 * points[:, 0] - points[:, 1]
        for kind in (float, numpy.float32):
            mesh, _ = self.refine(points.astype(kind), minimum_angle=25)
            self.assertGreater(mesh.report.refinement_points, 0)
            x, y, z = mesh.points.T
            numpy.testing.assert_allclose(z, 2 * x - y, atol=2e-5 if kind is numpy.float32 else 1e-9)
            found = mesh.interpolate(points[:, :2], [[5.0, 5.0], [4.0, 6.0]])
            numpy.testing.assert_allclose(found, [[5, 5], [4, 6]], atol=1e-5)

    def test_regions(self):
        wall = [[[4.0, -1], [4, 11]]]
        regions = [(1, 1, 7, 0.3), (9.0, 9.0, -2)]
        for given in (regions, numpy.array([(*row, 0)[:4] for row in regions])):
            mesh, corners = self.refine(numpy.empty((0, 2)), wall, outline=self.SQUARE, minimum_angle=25,
                                        split_crossings=True, regions=given)
            is_left = corners.mean(axis=1)[:, 0] < 4
            numpy.testing.assert_array_equal(mesh.regions, numpy.where(is_left, 7, -2))
            areas = self.list_areas(corners)
            self.assertLessEqual(areas[is_left].max(), 0.3)
            self.assertGreater(areas[~is_left].max(), 0.3)
            self.assertAlmostEqual(areas[is_left].sum(), 40)
        with self.assertWarnsRegex(UserWarning, r"^1 region seed outside of all triangles \(first: 0\)$"):
            mesh = delaunayflip.triangulate(self.SQUARE, regions=[(20, 20, 5)])
        self.assertEqual(mesh.regions.tolist(), [0, 0])
        with self.assertWarnsRegex(UserWarning, r"^1 region seed in the same part .* \(first: 1\)$"):
            mesh = delaunayflip.triangulate(self.SQUARE, regions=[(2, 2, 5), (3, 2, 6)])
        self.assertEqual(mesh.regions.tolist(), [5, 5])
        for wrong, error in (((1, 2), ValueError), ((1, 2, 3.5), TypeError), ((1, 2, 2**31), ValueError),
                             ("abc", ValueError), ((1, 2, 3, -1.0), delaunayflip.InvalidOptions),
                             ((numpy.nan, 2, 3), delaunayflip.InvalidOptions)):
            with self.assertRaisesRegex(error, "region 0"):
                delaunayflip.triangulate(self.SQUARE, regions=[wrong])
        with self.assertRaisesRegex(TypeError, "regions must be a list"):
            delaunayflip.triangulate(self.SQUARE, regions=7)

    def test_sizes(self):
        """Points are near enough for the field to be a plane: 0.5 at x = 0, and 1.5 at x = 10."""
        grid = numpy.stack(numpy.meshgrid([0.0, 5, 10], [0.0, 5, 10]), axis=-1).reshape(-1, 2)
        mesh, corners = self.refine(grid, size=0.5 + grid[:, 0] / 10)
        limit = 0.5 + corners[:, :, 0].max(axis=1) / 10
        self.assertTrue((self.list_longest(corners) <= limit).all())
        self.assertGreater(self.list_longest(corners)[corners[:, :, 0].min(axis=1) > 8].max(), 0.7)
        mesh, corners = self.refine(grid, size=numpy.where(grid[:, 0] < 7, 1.0, numpy.nan))
        longest = self.list_longest(corners)
        self.assertLessEqual(longest[corners[:, :, 0].max(axis=1) < 4].max(), 1.0)
        mesh, corners = self.refine(grid, maximum_edge=2.0)
        self.assertLessEqual(self.list_longest(corners).max(), 2.0)
        outlined, corners = self.refine(grid, outline=[[1, 1], [9, 1], [5, 9]], size=numpy.full(9, 0.8))
        self.assertLessEqual(self.list_longest(corners).max(), 0.8)
        with self.assertRaisesRegex(ValueError, "size must have 9 rows"):
            delaunayflip.triangulate(grid, size=[1.0, 2])
        with self.assertRaisesRegex(ValueError, "size must have one number for each point"):
            delaunayflip.triangulate(grid, size=grid)
        with self.assertRaisesRegex(TypeError, "^size must be real numbers"):
            delaunayflip.triangulate(grid, size=["a"] * 9)
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "size of point 3"):
            delaunayflip.triangulate(grid, size=[1, 1, 1, -1, 1, 1, 1, 1, 1])

    def test_boundary_and_limit(self):
        thin = [[0, 0], [40, 0], [40, 1], [0, 1]]
        with self.assertWarnsRegex(UserWarning, r"^\d+ triangles that are not as good as wanted"):
            mesh, _ = self.refine(thin, outline=[0, 1, 2, 3], minimum_angle=30, keep_boundary=True)
        self.assertEqual({frozenset(edge) for edge in mesh.segments.tolist()},
                         {frozenset((i, (i + 1) % 4)) for i in range(4)})
        self.assertEqual((mesh.neighbors < 0).sum(), 4)
        self.assertGreater(mesh.report.unrefined_triangles, 0)
        self.assertRegex(mesh.report.defects, r"\d+ triangle")
        with self.assertWarnsRegex(UserWarning, "refinement has ended: point_limit allows no more"):
            mesh = delaunayflip.triangulate(thin, maximum_area=0.001, point_limit=50)
        self.assertEqual(mesh.report.reached_point_limit, 1)
        self.assertIn("refinement has ended: point_limit allows no more", mesh.report.defects)
        self.assertEqual(mesh.report.used_points, 50)
        with self.assertWarnsRegex(UserWarning, "50 points are there.*no more than 50;"):
            delaunayflip.triangulate(thin + [[99, 99]], outline=[0, 1, 2, 3], maximum_area=0.001, point_limit=50)
        for keywords, names in (({"keep_boundary": True}, "keep_boundary"), ({"point_limit": 9}, "point_limit"),
                                ({"keep_boundary": True, "point_limit": 9}, "keep_boundary, point_limit")):
            with self.assertWarnsRegex(UserWarning, f"without a goal nothing is refined: {names}$"):
                mesh = delaunayflip.triangulate(thin, **keywords)
            with self.assertWarnsRegex(UserWarning, f"without a goal nothing is refined: {names}$"):
                flipped = delaunayflip.flip(mesh.points, mesh.triangles, **keywords)
            self.assertTrue(flipped.report.defects.endswith(names))
        points = numpy.random.default_rng(1).random((30, 2)) * 10
        wall = [[[8.7, 4.9], [9.3, 2]], [[5.9, 2.6], [1.7, 9.3], [2.1, 8.5]], [[3.1, 2.2], [9.9, 3.2]]]
        for limit in range(60, 400, 20):  # also while subsegments are too short to be split
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                mesh = delaunayflip.triangulate(points, wall, split_crossings=True, minimum_angle=25,
                                                maximum_edge=0.8, point_limit=limit)
            self.assertLessEqual(mesh.report.used_points, limit)
        sharp = [[0, 0], [10, 0], [10, 0.5]]
        with self.assertWarnsRegex(UserWarning, "not as good as wanted"):
            mesh, _ = self.refine(sharp, outline=[0, 1, 2], minimum_angle=25)
        angles = delaunayflip.smallest_angles(mesh.points, mesh.triangles)
        self.assertEqual((angles < 25).sum(), mesh.report.unrefined_triangles)
        corner = numpy.degrees(numpy.arctan2(0.5, 10))
        self.assertGreater(angles.min(), 0.85 * corner)
        self.assertLess(mesh.report.used_points, 100)


class RefineMeshes(unittest.TestCase):
    """Refinement of meshes by flip and in sessions."""

    @classmethod
    def setUpClass(cls):
        rows = numpy.random.default_rng(3).random((60, 2)) * [8, 6]
        outline = [[0, 0], [8, 0], [8, 6], [5, 6], [5, 3], [3, 3], [3, 6], [0, 6]]
        mesh = delaunayflip.triangulate(rows, outline=outline, holes=[[1, 1], [2, 1], [2, 2], [1, 2]])
        points = numpy.concatenate([mesh.points, mesh.points @ [[2], [3]]], axis=1)
        cls.points, cls.triangles = points, mesh.triangles
        cls.left = (points[mesh.triangles, 0].mean(axis=1) < 4).astype(int) * 5 - 2

    def test_warnings(self):
        options = dict(geometry="planar-xy", minimum_angle=20)
        with self.assertWarnsRegex(UserWarning, "points are there.*point_limit allows no more"):
            delaunayflip.flip(self.points, self.triangles, **options, point_limit=5)
        wedge = numpy.array([[0, 0, 0], [10, -0.5, 0], [10, 0.5, 0]])
        with self.assertWarnsRegex(UserWarning, "1 triangle that is not as good as wanted") as caught:
            delaunayflip.flip(wedge, [[0, 1, 2]], **options)
        self.assertEqual(caught.filename, __file__)

    def find_areas(self, points, triangles):
        a, b, c = points[triangles, :2].transpose(1, 0, 2)
        return 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])

    def test_data_follow(self):
        result = delaunayflip.flip(self.points, self.triangles, geometry="planar-xy", minimum_angle=20,
                                   maximum_area=0.05, regions=self.left)
        report = result.report
        self.assertGreater(report.refinement_points, 100)
        self.assertEqual(report.euler_characteristic, 0)
        self.assertEqual(len(result.points), len(self.points) + report.refinement_points)
        self.assertEqual(len(result.triangles), report.triangles)
        self.assertEqual(result.flip_counts.shape, (report.triangles,))
        areas = self.find_areas(result.points, result.triangles)
        self.assertTrue(0 < areas.min() and areas.max() <= 0.05)
        before = self.find_areas(self.points, self.triangles)
        labels = self.left[result.sources]
        for label in (-2, 3):
            self.assertAlmostEqual(areas[labels == label].sum(), before[self.left == label].sum(), 9)
        wanted = result.points[:, :2] @ [2, 3]
        numpy.testing.assert_allclose(result.points[:, 2], wanted, atol=1e-12)
        values = numpy.stack([self.points[:, 0], self.points[:, 2]], axis=1)
        numpy.testing.assert_allclose(result.at_points(values)[:, 1], wanted, atol=1e-12)
        self.assertRaises(ValueError, result.at_points, values[1:])
        angles = delaunayflip.smallest_angles(result.points, result.triangles, geometry="planar-xy")
        self.assertEqual(numpy.count_nonzero(angles < 20 - 1e-9), report.unrefined_triangles)
        again = delaunayflip.flip(result.points, result.triangles, geometry="planar-xy", regions=labels)
        self.assertEqual(again.report.total_flips, 0)

    def test_region_seeds(self):
        """They label what constraints and borders of labels enclose, and limit areas there."""
        before = self.find_areas(self.points, self.triangles)
        centers = self.points[self.triangles].mean(axis=1)
        left, right = (centers[numpy.flatnonzero(self.left == label)[0], :2] for label in (3, -2))
        seeds = [(*left, 7, 0.05), (*right, -4)]
        for given in (seeds, numpy.array([(*row, 0)[:4] for row in seeds])):
            result = delaunayflip.flip(self.points, self.triangles, geometry="planar-xy", regions=self.left,
                                       region_seeds=given)
            numpy.testing.assert_array_equal(
                result.regions, numpy.where(self.left[result.sources] == 3, 7, -4))
            areas = self.find_areas(result.points, result.triangles)
            self.assertAlmostEqual(areas[result.regions == 7].sum(), before[self.left == 3].sum(), 9)
            self.assertLessEqual(areas[result.regions == 7].max(), 0.05)
            self.assertGreater(result.report.refinement_points, 10)
        with delaunayflip.Session(self.points, self.triangles, geometry="planar-xy", regions=self.left,
                                  region_seeds=seeds) as session:
            session.advance()
            numpy.testing.assert_array_equal(session.regions, result.regions)
        with self.assertWarnsRegex(UserWarning, r"^1 region seed outside of all triangles \(first: 0\)$"):
            result = delaunayflip.flip(self.points, self.triangles, geometry="planar-xy",
                                       region_seeds=[(1e3, 1e3, 5)])
        self.assertFalse(result.regions.any())
        for error, wrong in ((ValueError, (1, 2)), (TypeError, (1, 2, 2.5)),
                             (delaunayflip.InvalidOptions, (numpy.nan, 0, 1))):
            with self.assertRaisesRegex(error, "region 0"):
                delaunayflip.flip(self.points, self.triangles, region_seeds=[wrong])

    def test_without_goals(self):
        result = delaunayflip.flip(self.points, self.triangles)
        self.assertFalse(result.regions.any())
        self.assertTrue(numpy.shares_memory(result.points, self.points))
        numpy.testing.assert_array_equal(result.sources, numpy.arange(len(self.triangles)))
        numpy.testing.assert_array_equal(result.at_points(self.points), self.points)

    def test_stops(self):
        """Wherever a run stops, its mesh is complete: it has the given area, and a source per triangle."""
        flip = functools.partial(delaunayflip.flip, self.points, self.triangles, geometry="planar-xy",
                                 maximum_area=0.01)
        area = self.find_areas(self.points, self.triangles).sum()
        for most in (1, 2, 5, 10, 20):
            calls = iter(range(most))
            result = flip(progress=lambda share, left=calls: next(left, None) is not None)
            self.assertEqual(result.report.stop_reason, "aborted")
            self.assertAlmostEqual(self.find_areas(result.points, result.triangles).sum(), area, 9)
            self.assertEqual(result.sources.shape, (len(result.triangles),))
            numpy.testing.assert_allclose(result.at_points(self.points), result.points, atol=1e-12)

    def test_sizes_and_sessions(self):
        size = 0.2 + 0.1 * self.points[:, 0]
        keywords = dict(geometry="planar-xy", size=size, point_limit=3000)
        for kind, ids in ((numpy.float64, numpy.int64), (numpy.float32, numpy.int32)):
            points, triangles = self.points.astype(kind), self.triangles.astype(ids)
            result = delaunayflip.flip(points, triangles, **keywords)
            self.assertEqual((result.points.dtype, result.triangles.dtype), (kind, ids))
            ends = result.points[result.triangles]
            longest = numpy.linalg.norm((ends - numpy.roll(ends, 1, axis=1))[..., :2], axis=2).max(axis=1)
            sizes = result.at_points(size)[result.triangles].mean(axis=1)
            self.assertLess((longest / sizes).max(), 1 + 1e-5)
            with delaunayflip.Session(points, triangles, **keywords) as session:
                counts = [session.report.triangles]
                while session.advance(1):
                    counts.append(session.report.triangles)
                self.assertGreater(len(counts), 5)
                self.assertEqual(sorted(counts), counts)
                numpy.testing.assert_array_equal(session.triangles, result.triangles)
                numpy.testing.assert_array_equal(session.points, result.points)
                numpy.testing.assert_array_equal(session.sources, result.sources)
                numpy.testing.assert_array_equal(session.flip_counts, result.flip_counts)
                self.assertRaises(ValueError, session.store_triangles, triangles)

    def test_messages(self):
        flip = functools.partial(delaunayflip.flip, self.points, self.triangles)
        for keywords, words in (
                ({"minimum_angle": 34}, "minimum_angle must be from 0 to 33"),
                ({"maximum_area": -1.0}, "maximum_area must be from 1e-60 to 1e60"),
                ({"maximum_edge": 1, "geometry": "surface"}, "surface in space"),
                ({"minimum_angle": 20, "geometry": "planar-xy", "pieces": 2}, "in several pieces"),
                ({"minimum_angle": 20, "criterion": "opposite-angles"}, "in-circle"),
                ({"size": self.points[1:, 0]}, "one number for each"),
                ({"size": 0.5}, "size must have the shape"),
                ({"size": numpy.zeros(len(self.points))}, "size of point 0")):
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                flip(**keywords)
        with self.assertWarnsRegex(UserWarning, r"^\d+ triangles that .*: maximum_iterations allows no round"):
            flip(geometry="planar-xy", minimum_angle=25, maximum_iterations=0)
        limited = flip(geometry="planar-xy", maximum_area=1e-4, point_limit=200).report
        self.assertIn("point_limit allows no more", limited.defects)


class Flip(unittest.TestCase):

    def test_the_input_is_not_written_and_not_copied(self):
        points, triangles = sheared_lattice(10)
        points.flags.writeable = triangles.flags.writeable = False
        before = triangles.copy()
        delaunayflip.flip(points, triangles)
        numpy.testing.assert_array_equal(triangles, before)
        mesh = _arrays.Mesh(points, triangles)
        self.assertIs(mesh.points, points)
        self.assertIs(mesh.triangles, triangles)

    def test_a_constraint_is_inserted(self):
        short = [[0, 1, 3], [1, 2, 3]]
        inserted = delaunayflip.flip(POINTS, short, constraints=[[0, 2]])
        self.assertEqual({frozenset(t) for t in inserted.triangles.tolist()},
                         {frozenset((0, 1, 2)), frozenset((0, 2, 3))})
        self.assertEqual(inserted.report.inserted_constraints, 1)
        self.assertEqual(inserted.report.constraint_flips, 1)
        kept = delaunayflip.flip(POINTS, short, constraints=[[0, 2]], insert_constraints=False)
        numpy.testing.assert_array_equal(kept.triangles, short)
        self.assertEqual(kept.report.unmatched_constraints, 1)

    def test_empty(self):
        for points, triangles in ((numpy.empty((0, 3)), []), ([], numpy.empty((0, 3)))):
            result = delaunayflip.flip(points, triangles, regions=[], frozen=[], constraints=[])
            self.assertEqual(result.triangles.shape, (0, 3))
        self.assertTrue(numpy.isnan(result.report.minimum_angle_before))


class Errors(unittest.TestCase):
    def test_invalid_mesh(self):
        with self.assertRaises(delaunayflip.InvalidMesh) as caught:
            delaunayflip.flip(POINTS, [[0, 1, 2], [0, 2, 4]])
        self.assertEqual((caught.exception.cell, caught.exception.point), (1, 4))
        self.assertIn("4", str(caught.exception))
        with self.assertRaises(delaunayflip.InvalidMesh):
            delaunayflip.smallest_angles(POINTS, [[0, 1, -1]])

    def test_invalid_options(self):
        with self.assertRaises(TypeError):
            delaunayflip.flip(POINTS, TRIANGLES, colour="red")
        with self.assertRaisesRegex(TypeError, "colour"):
            _options.make_options(colour="red")
        with self.assertRaisesRegex(ValueError, "geometry must be one of auto, planar"):
            delaunayflip.smallest_angles(POINTS, TRIANGLES, geometry="x")
        with delaunayflip.Session(POINTS, TRIANGLES) as session:
            for iterations, error in ((1.5, TypeError), (2**63, ValueError), (-2, ValueError)):
                with self.assertRaisesRegex(error, "iterations must be"):
                    session.advance(iterations)
            self.assertEqual(session.report.number_of_iterations, 0)
        result = delaunayflip.flip(POINTS, TRIANGLES, threads=numpy.uint8(1), tolerance=numpy.float32(0),
                                   maximum_iterations=2**63 - 1, track_quality=numpy.bool_(True))
        self.assertEqual(result.report.total_flips, 1)

    def test_options_of_points(self):
        """Messages call an option as the keyword."""
        for name, kind in _points.POINT_OPTIONS.items():
            for value in {float: (-1.0, numpy.nan, numpy.inf), int: (-1,), bool: (2,)}[kind]:
                with self.assertRaisesRegex(delaunayflip.InvalidOptions, f"^{name} must be "):
                    delaunayflip.triangulate(POINTS, **{name: value})

    def test_maximum_deviation(self):
        """The diagonals of the quad are 0.25 apart."""
        points = [[0, 1, 0.25], [-4, 0, 0], [4, 0, 0], [0, -1, 0.25]]
        for bound, flips in ((numpy.inf, 1), (0.25, 1), (0.24, 0), (0, 0)):
            report = delaunayflip.flip(points, [[0, 1, 2], [3, 2, 1]], geometry="surface",
                                       maximum_deviation=bound).report
            self.assertEqual((report.total_flips, report.blocked_by_deviation), (flips, 1 - flips))
            self.assertEqual(report.non_delaunay_after, 1 - flips)

    def test_refusals(self):
        """Each is refused before it reaches the engine, by a message that names the argument."""
        def mask(values, value):
            return numpy.ma.masked_equal(values, value)

        refused = {
            "maximum_iterations": {ValueError: (2**64, -2), TypeError: (1.5, None)},
            "threads": {ValueError: (2**32 + 1, -1), TypeError: ("2",)},
            "device": {ValueError: (-2, 2**31)},
            "pieces": {ValueError: (256,), TypeError: (numpy.float64(2),)},
            "tolerance": {ValueError: (numpy.nan, 10**400), TypeError: ("0.1", [0.1])},
            "feature_angle": {ValueError: (181, numpy.inf, numpy.nan)},
            "maximum_deviation": {ValueError: (-1, numpy.nan), TypeError: ("1%", None)},
            "track_quality": {ValueError: (2,), TypeError: ("no",)},
            "geometry": {ValueError: (3, "round")},
            "backend": {ValueError: (numpy.array(["auto", "cuda"]),)},
            "devices": {ValueError: ([2**40], "0\0,1"), TypeError: (0, None, b"0", [0.5])},
            "progress": {TypeError: (3, list(range(10**5)), numpy.zeros((30, 30)))},
            "on_iteration": {TypeError: (True,)},
            "points": {
                ValueError: (POINTS.ravel(), POINTS[:, :1], mask(POINTS, 4), 3.0, [[0, 1], [2]],
                             numpy.empty((0, 3))),
                TypeError: (POINTS.astype(complex), POINTS.astype(str), POINTS > 0, None, {1, 2},
                            (row for row in POINTS))},
            "triangles": {
                ValueError: (TRIANGLES[:, :2], numpy.int64(3), mask(TRIANGLES, 3)),
                TypeError: (TRIANGLES + 0.5, map(list, TRIANGLES), "012"),
                delaunayflip.InvalidMesh: (TRIANGLES.astype(numpy.uint64) - numpy.uint64(1),)},
            "constraints": {
                ValueError: (2,), TypeError: ([[0.0, 2.0]],),
                delaunayflip.InvalidMesh: (numpy.array([[0, 2**63]], numpy.uint64),)},
            "regions": {ValueError: ([1, 2, 3], [1, 2**40], 1, mask([1, 2], 2)),
                        TypeError: ([1.0, 2.0], iter([1, 2]))},
            "frozen": {ValueError: ([numpy.nan, 0], True, mask([1, 0], 0)), TypeError: (["no", "no"],)},
            "insert_constraints": {ValueError: (numpy.nan, [True, True]), TypeError: ("no", None)},
        }
        for name, errors in refused.items():
            for error, value in ((error, value) for error in errors for value in errors[error]):
                arguments = {"points": POINTS, "triangles": TRIANGLES, "constraints": [[0, 2]],
                             name: value}
                with (self.subTest(name, value=value),
                      self.assertRaisesRegex(error, name.rstrip("s").replace("_a", "[_ ]a").replace("_d", "[_ ]d")) as caught):
                    delaunayflip.flip(**arguments)
                self.assertLess(len(str(caught.exception)), 200)
                self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(delaunayflip.flip(numpy.ma.array(POINTS), TRIANGLES).report.total_flips, 1)

        class Table:
            shape = (10**5, 3)

            def __repr__(self):
                return "Table with 1 2 3 4 5 6 7 8 9\n" * 10**5

            def __array__(self, *_arguments, **_keywords):
                raise TypeError(f"no array: {self}")

        for name, wanted in (("tolerance", "not Table of shape \\(100000, 3\\)$"),
                             ("backend", "not Table of shape"), ("points", "no array: Table.{100,}[.]{3}$"),
                             ("devices", "not Table of shape"), ("progress", "not Table of shape")):
            with self.assertRaisesRegex((TypeError, ValueError), wanted) as caught:
                delaunayflip.flip(**{"points": POINTS, "triangles": TRIANGLES, name: Table()})
            self.assertLess(len(str(caught.exception)), 200)
        with self.assertRaises(delaunayflip.InvalidMesh) as caught:
            delaunayflip.flip(POINTS, numpy.array([[0, 1, 2], [0, 2, 2**64 - 1]], numpy.uint64))
        self.assertEqual((caught.exception.cell, caught.exception.point), (1, 2**64 - 1))
        for others in ({"triangles": TRIANGLES}, {"triangles": [], "constraints": [[0, 1]]}):
            with self.assertRaisesRegex(delaunayflip.InvalidMesh, "has no points"):
                delaunayflip.flip([], **others)

    @unittest.skipIf(delaunayflip.has_cuda_device(), "there is a GPU")
    def test_arrays_of_other_libraries_on_a_gpu(self):
        class OfCuPy:
            __module__ = "cupy"

            def __init__(self, array):
                self.get = lambda: array.values

        class Other:
            __dlpack__ = None  # for CuPy

            def __init__(self, values):
                self.values = values

            def __dlpack_device__(self):
                return 2, 0  # CUDA

        cupy = types.ModuleType("cupy")
        cupy.from_dlpack = OfCuPy
        with unittest.mock.patch.dict(sys.modules, cupy=cupy):
            angles = delaunayflip.smallest_angles(Other(POINTS), Other(TRIANGLES))
            for name, arrays in (("triangles", (Other(POINTS), TRIANGLES)),
                                 ("points", (POINTS, Other(TRIANGLES)))):
                with self.assertRaisesRegex(TypeError, f"{name} must be in the memory of the GPU"):
                    delaunayflip.flip(*arrays)
        numpy.testing.assert_array_equal(angles, delaunayflip.smallest_angles(POINTS, TRIANGLES))
        with unittest.mock.patch("importlib.util.find_spec", lambda name: None):
            with self.assertRaisesRegex(TypeError, "need CuPy or PyTorch"):
                delaunayflip.flip(Other(POINTS), Other(TRIANGLES))

    def test_what_the_engine_is_told_of_an_array(self):
        class OfCuPy:
            """An array on a GPU. Its interface is not read, which takes a while."""

            __module__ = "cupy"
            dtype, shape, device = numpy.dtype("f4"), (4, 3), contextlib.nullcontext()
            flags, data = types.SimpleNamespace(c_contiguous=True), types.SimpleNamespace(ptr=4096)
            __cuda_array_interface__ = property(lambda self: self.fail())

        stream = types.SimpleNamespace(ptr=7)
        cupy = types.ModuleType("cupy")
        cupy.cuda = types.SimpleNamespace(get_current_stream=lambda: stream)
        with unittest.mock.patch.dict(sys.modules, cupy=cupy):
            struct = _points.Batch(OfCuPy()).struct
        self.assertEqual((struct.points, struct.number_of_points, struct.point_components), (4096, 4, 3))
        self.assertEqual((struct.point_type, struct.memory, struct.stream), (0, _library.CUDA, 7))
        for points in (POINTS, POINTS.astype("f4")[:, :2], POINTS[:0]):
            struct, whole = _points.Batch(points).struct, _points.Input(points).struct
            self.assertEqual((struct.memory, struct.stream), (_library.HOST, None))
            for name in ("point_type", "point_components", "number_of_points"):
                self.assertEqual(getattr(struct, name), getattr(whole, name))

    def test_arrays_of_other_libraries(self):
        class Other:
            """An array that NumPy can only view by DLPack."""

            def __init__(self, values):
                self.values = numpy.array(values)
                self.address = self.values.ctypes.data

            def __dlpack__(self, **keywords):
                return self.values.__dlpack__(**keywords)

            def __dlpack_device__(self):
                return self.values.__dlpack_device__()

        class OnHost(Other):
            """An array of a library that also has arrays on GPUs."""

            @property
            def __cuda_array_interface__(self):
                raise AttributeError("this array is not on a GPU")

        for kind in (Other, OnHost):
            points, triangles = kind(POINTS), kind(TRIANGLES)
            self.assertEqual(_arrays.as_points(points).ctypes.data, points.address)
            self.assertEqual(_arrays.as_ids("triangles", triangles, 3).ctypes.data, triangles.address)

    def test_single_values(self):
        """What is no list is refused by the argument's name; an array without dimensions is a number."""
        for name in ("outline", "holes", "regions"):
            for wrong in (numpy.array(1), numpy.array(1.5), numpy.float64(2.0)):
                with self.assertRaisesRegex(TypeError, f"^{name} must be a list of "):
                    delaunayflip.triangulate(POINTS, **{name: wrong})
        with self.assertRaisesRegex(TypeError, "^region_seeds must be a list of "):
            delaunayflip.flip(POINTS, TRIANGLES, region_seeds=numpy.array(1))
        for wrong in (numpy.array([1, 2]), numpy.array(["own", "own"]), numpy.array("own")):
            with self.assertRaisesRegex(ValueError, "^heights must be one of survey, own, not "):
                delaunayflip.triangulate(POINTS, heights=wrong)
        for make in (delaunayflip.Session, delaunayflip.flip):
            with self.assertRaisesRegex(TypeError, "^minimum_angle must be a number, not "):
                make(POINTS, TRIANGLES, minimum_angle=numpy.array([1, 2]))
        segments = memoryview(numpy.array([[1, 3]]))
        self.assertEqual(delaunayflip.triangulate(POINTS, segments).segments.tolist(), [[1, 3]])
        for one in (numpy.array(1), numpy.array(1.0), True, numpy.True_, numpy.array(True)):
            number = _options.to_number("alpha", one)
            self.assertIs(type(number), float)
            self.assertEqual(number, 1.0)
        for one in (numpy.array(1), numpy.int8(1), True, numpy.True_, numpy.array(True)):
            number = _options.check_integer("threads", one, 0, 9)
            self.assertEqual((number, isinstance(number, int)), (1, True))
        for wrong in (numpy.array([1]), numpy.ma.masked, numpy.array("1"), None):
            with self.assertRaisesRegex(TypeError, "^alpha must be a number, not "):
                _options.to_number("alpha", wrong)
            with self.assertRaisesRegex(TypeError, "^threads must be an integer from 0 to 9, not "):
                _options.check_integer("threads", wrong if wrong is not numpy.ma.masked else 1.0, 0, 9)

    def test_backend_unavailable(self):
        with self.assertRaises(delaunayflip.BackendUnavailable):
            delaunayflip.flip(POINTS, TRIANGLES, backend="cuda")


class Callbacks(unittest.TestCase):
    def test_progress(self):
        points, triangles = sheared_lattice(50)
        shares = []
        delaunayflip.flip(points, triangles, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1.0)
        result = delaunayflip.flip(points, triangles, progress=lambda share: False)
        self.assertEqual(result.report.stop_reason, "aborted")
        self.assertEqual(result.report.non_delaunay_after, -1)
        numpy.testing.assert_array_equal(result.triangles, triangles)

    def test_iterations_abort(self):
        points, triangles = sheared_lattice(30)
        records = []
        result = delaunayflip.flip(points, triangles,
                                   on_iteration=lambda record: bool(records.append(record)))
        self.assertEqual(len(records), 1)
        self.assertEqual(result.report.stop_reason, "aborted")
        self.assertEqual(records[0]["flipped"], result.report.total_flips)
        of_numpy = delaunayflip.flip(points, triangles, on_iteration=lambda record: numpy.bool_(False))
        self.assertEqual(of_numpy.report.stop_reason, "aborted")

    def test_exceptions_come_through(self):
        points, triangles = sheared_lattice(30)

        def fail(_):
            raise ZeroDivisionError("in the callback")

        for name in ("progress", "on_iteration"):
            with self.subTest(name), self.assertRaisesRegex(ZeroDivisionError, "in the callback"):
                delaunayflip.flip(points, triangles, **{name: fail})
        square = _surface.Cells(numpy.array([0, 4]), numpy.arange(4), "cell", 0)
        with self.assertRaisesRegex(ZeroDivisionError, "in the callback"):
            _surface._split(square, POINTS, fail)  # which has no partial result

    def test_exceptions_keep_no_memory(self):
        """They leave no cycle of references behind, which would keep the session until a collection."""
        def fail(_):
            raise ZeroDivisionError("in the callback")

        session = delaunayflip.Session(*sheared_lattice(300))  # which asks several times
        gone = weakref.ref(session)
        gc.disable()
        self.addCleanup(gc.enable)
        try:
            session.advance(progress=fail, on_iteration=fail)
        except ZeroDivisionError:
            del session
        self.assertIsNone(gone())

    def test_interrupt(self):
        """Ctrl-C ends a run with KeyboardInterrupt."""
        program = (
            "import lattice, delaunayflip\n"
            "mesh = lattice.sheared_lattice(600)\n"
            "def tell(share): print('ready', flush=True)\n"
            "while True: delaunayflip.flip(*mesh, threads=1, progress=tell)\n"
        )
        with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True,
                              cwd=pathlib.Path(__file__).parent) as process:
            self.assertEqual(process.stdout.readline(), "ready\n")
            process.send_signal(signal.SIGINT)
            try:
                _, errors = process.communicate(timeout=60)
            finally:
                process.kill()
        self.assertTrue(errors.rstrip().endswith("KeyboardInterrupt"), errors)
        self.assertIn("delaunayflip/_session.py", errors)

    def test_handlers_of_signals(self):
        """What they raise, as at a timeout, comes through; afterwards they are as before."""
        def raise_it(*_):
            raise TimeoutError

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, raise_it))
        # An alarm that comes later ends the process.
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0)
        mesh = sheared_lattice(600)
        for _ in range(5):
            with self.assertRaises(TimeoutError):
                signal.setitimer(signal.ITIMER_REAL, 0.02)
                delaunayflip.flip(*mesh, backend="threads", threads=1)  # a GPU is too fast
            self.assertIs(signal.getsignal(signal.SIGALRM), raise_it)
        handler = _session._raise_after([], signal.getsignal, signal.SIGALRM)
        self.assertIsNot(handler, raise_it)
        self.assertRaises(TimeoutError, handler, signal.SIGALRM, None)  # were it still there

    def test_signals_at_any_moment(self):
        """An exception of a handler, at whatever moment it comes, leaves nothing locked, and no handler."""
        def raise_it(*_):
            raise TimeoutError

        def ignore(*_):
            pass

        handlers = {signal.SIGALRM: raise_it, signal.SIGUSR1: ignore, signal.SIGUSR2: ignore}
        for number, handler in handlers.items():
            self.addCleanup(signal.signal, number, signal.signal(number, handler))
        self.addCleanup(sys.setprofile, None)
        session = delaunayflip.Session(POINTS, TRIANGLES)
        mesh = delaunayflip.MovingTriangulation(POINTS)
        f = delaunayflip.LinearInterpolator(POINTS, POINTS[:, 0])
        for act in (session.advance, lambda: session.report, session.__enter__, lambda: mesh.move(POINTS),
                    lambda: mesh.move(POINTS[:1], [0]), lambda: mesh.triangles, lambda: f([[1.0, 0.0]])):
            moment = 0
            while moment >= 0:
                left = itertools.count(moment, -1)

                def look(_, event, function):  # the interpreter handles signals where these events are
                    if event in ("call", "c_return") and next(left) == 0:
                        signal.raise_signal(signal.SIGALRM)

                try:
                    sys.setprofile(look)
                    act()
                    sys.setprofile(None)
                except TimeoutError:
                    pass
                finally:
                    sys.setprofile(None)
                moment = moment + 1 if next(left) < 0 else -1
                self.assertEqual({number: signal.getsignal(number) for number in handlers}, handlers)
                self.assertEqual(len(mesh.triangles), 2)
                self.assertEqual(session.report.triangles, 2)
                self.assertEqual(f([[1.0, 0.0]]).tolist(), [1.0])
        session.close()
        mesh.close()


class Session(unittest.TestCase):
    def test_steps_end_as_the_whole_run(self):
        points, triangles = sheared_lattice(20)
        steps = 0
        with delaunayflip.Session(points, triangles) as session:
            self.assertEqual(session.report.stop_reason, "not started")
            while session.advance(1):
                steps += 1
                self.assertEqual(len(session.iterations), steps)
                self.assertEqual(session.report.stop_reason, "running")
            stepped = session.triangles
            self.assertEqual(session.flip_counts.sum(), 2 * session.report.total_flips)
            target = numpy.zeros_like(stepped, dtype=numpy.int32)
            session.store_triangles(target)
            for wrong, error in ((target.T, ValueError), (target[1:], ValueError),
                                 (target.tolist(), TypeError), (None, TypeError)):
                with self.assertRaisesRegex(error, "target must be"):
                    session.store_triangles(wrong)
        self.assertGreater(steps, 2)
        whole = delaunayflip.flip(points, triangles)
        numpy.testing.assert_array_equal(stepped, whole.triangles)
        numpy.testing.assert_array_equal(target, whole.triangles)

    def test_points_that_move(self):
        """A session goes on with its triangles, and those are Delaunay again."""
        points, triangles = sheared_lattice(30)
        draw = numpy.random.default_rng(5)
        for dtype in (numpy.float32, numpy.float64):
            places = numpy.asarray(points, dtype=dtype)
            with delaunayflip.Session(places, triangles, geometry="planar-xy", tie_rule="canonical",
                                      backend="threads") as session:
                session.advance()
                for _ in range(3):
                    places = (places + draw.normal(0, 1e-3, places.shape)).astype(dtype)
                    given = places.astype(numpy.float64)
                    session.move(given)
                    given[:] = 0  # it has a copy
                    self.assertEqual(session.report.total_flips, 0)
                    session.advance()
                    self.assertTrue(session.report.converged)
                    numpy.testing.assert_array_equal(session.points, places)
                    expected = delaunayflip.flip(places, session.triangles, geometry="planar-xy",
                                                 tie_rule="canonical", backend="threads")
                    self.assertEqual(expected.report.total_flips, 0)
                for wrong in (places[1:], places[:, :2][:-1]):
                    with self.assertRaisesRegex(delaunayflip.InvalidOptions, "for each of its"):
                        session.move(wrong)
                with self.assertRaises(delaunayflip.Stopped):
                    session.move(places, progress=lambda share: False)
                with self.assertRaisesRegex(delaunayflip.InvalidOptions, "cannot follow its points"):
                    session.move(places * numpy.nan)
                self.assertTrue(session.report.converged)

    def test_closed(self):
        session = delaunayflip.Session(POINTS, TRIANGLES)
        session.close()
        session.close()
        for use in (session.advance, lambda: session.triangles, lambda: session.report):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()
        with self.assertRaisesRegex(ValueError, "the session is closed"):
            with session:
                self.fail("nothing can be done with it")

    def test_it_does_one_thing_at_a_time(self):
        points, triangles = sheared_lattice(60)
        session = delaunayflip.Session(points, triangles)
        told, refused = threading.Event(), threading.Event()

        def observe(_):
            for use in (session.close, session.advance, lambda: session.report,
                        lambda: session.triangles):
                with self.assertRaisesRegex(RuntimeError, "the session is at work"):
                    use()
            told.set()
            return refused.wait(60)

        thread = threading.Thread(target=session.advance, kwargs={"on_iteration": observe})
        thread.start()
        self.assertTrue(told.wait(60))
        for use in (session.advance, session.close, lambda: session.flip_counts):
            with self.assertRaisesRegex(RuntimeError, "the session is at work"):
                use()
        refused.set()
        thread.join()
        self.assertTrue(session.report.converged)
        for copy_it in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, "cannot be copied"):
                copy_it(session)
        session.close()

    def test_it_keeps_its_arrays_alive(self):
        points, triangles = sheared_lattice(20)
        expected = delaunayflip.flip(points, triangles).triangles
        session = delaunayflip.Session(points, triangles)
        reference = weakref.ref(points)
        del points, triangles
        gc.collect()
        self.assertIsNotNone(reference())
        session.advance()
        numpy.testing.assert_array_equal(session.triangles, expected)


def run_python(program):
    return subprocess.run([sys.executable, "-c", program], check=True, capture_output=True,
                          text=True).stdout


class Package(unittest.TestCase):

    def test_help_names_types(self):
        for function in (delaunayflip.flip, delaunayflip.triangulate, delaunayflip.Session):
            signature = str(inspect.signature(function))
            self.assertNotIn("numpy", signature)
            self.assertIn("points: 'Numbers'", signature)

    def test_types_can_be_looked_up(self):
        for name in set(delaunayflip.__all__) - {"Report"}:
            value = None if name.startswith("vtk") else getattr(delaunayflip, name)
            for one in (value, getattr(value, "__init__", None), getattr(value, "insert", None)):
                if isinstance(one, types.FunctionType):
                    self.assertIsInstance(typing.get_type_hints(one), dict)

    def test_names_of_another_vtk(self):
        """Names of modules in C++ that are there, but not for the VTK of Python, are left out."""
        other = types.ModuleType("delaunayflip._vtk")
        with (unittest.mock.patch.dict(sys.modules, {"delaunayflip._vtk": other}),
              unittest.mock.patch("importlib.util.find_spec", lambda name: name)):
            for is_for_this in (True, False):
                other._is_built_for_this_vtk = lambda answer=is_for_this: answer
                self.assertEqual("vtkDelaunayFlipLiveView" in dir(delaunayflip), is_for_this)

    def test_arrays_need_no_vtk(self):
        program = ("import sys, delaunayflip\n"
                   "assert 'numpy' not in sys.modules\n"
                   "delaunayflip.flip([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])\n"
                   "print([name for name in sys.modules if 'vtk' in name])")
        self.assertEqual(run_python(program), "[]\n")

    def test_help(self):
        """It looks up all names, also where VTK is not installed."""
        program = ("import sys, pydoc\n"
                   "sys.modules['vtkmodules'] = None\n"
                   "import delaunayflip\n"
                   "print('vtkDelaunayFlip' in dir(delaunayflip), len(pydoc.render_doc(delaunayflip)))\n"
                   "from delaunayflip import *")
        self.assertRegex(run_python(program), r"^False \d{5}")
        self.assertFalse(hasattr(delaunayflip, "flop"))

    def test_library(self):
        """Each system's library is taken from the package. Without one, the system searches."""
        names = {"linux": "libdelaunayflip.so.1", "darwin": "libdelaunayflip.1.dylib",
                 "win32": "delaunayflip-1.dll"}
        load = _library.library.__wrapped__
        for system, name in names.items():
            self.assertEqual(name, _library.name_library(system))
            with (self.subTest(system), tempfile.TemporaryDirectory() as folder,
                  unittest.mock.patch.object(_library, "LIBRARY", name),
                  unittest.mock.patch.object(delaunayflip, "__path__", ["/absent", folder]),
                  unittest.mock.patch.object(_library, "__file__", f"{folder}/_library.py"),
                  unittest.mock.patch("ctypes.CDLL", side_effect=OSError) as taken):
                file = pathlib.Path(folder).resolve() / name
                self.assertRaises(OSError, load)
                taken.assert_called_with(name)
                file.touch()
                self.assertRaises(OSError, load)
                taken.assert_called_with(str(file))

    def test_reference(self):
        """The page lists all members of a class, or those that Sphinx finds, also inherited ones."""
        page = (ROOT / "Documentation/reference/python.md").read_text()
        directives = re.findall(r"autoclass:: delaunayflip\.(\w+)\n((?:   .*\n)+)", page)
        self.assertGreater(len(directives), 7)
        for name, options in directives:
            kind = getattr(delaunayflip, name)
            wanted = {member for member in dir(kind) if not member.startswith("_")}
            shown = wanted if ":inherited-members:" in options else set(vars(kind))
            if ":members:\n" not in options:
                shown = set(re.findall(r"\w+", options))
            self.assertEqual(wanted - shown, set(), name)

    def test_docstrings(self):
        result = doctest.testmod(_session)
        self.assertGreater(result.attempted, 5)
        self.assertEqual(result.failed, 0)


class Cells(unittest.TestCase):
    def test_unsigned_ids(self):
        """VTK 9.6 has them."""
        ids = numpy.arange(4, dtype=numpy.uint64)
        square = _surface.Cells(4 * ids[:2], ids, "cell", 0)
        self.assertEqual(_surface.list_pairs(square, True).tolist(), [[0, 1], [1, 2], [2, 3], [3, 0]])


class Header(unittest.TestCase):
    """The structs and enumerations are those of the C header, in its order."""

    HEADER = re.sub(r"/\*.*?\*/", "", (ROOT / "CInterface/delaunayflip_c.h").read_text(), flags=re.S)
    TYPES = {"int64_t": ctypes.c_int64, "int32_t": ctypes.c_int32, "double": ctypes.c_double,
             "const char*": ctypes.c_char_p}

    def members(self, struct):
        """(type, name) of each; a pointer to a function has its return type."""
        body = re.search(rf"typedef struct\s*\{{([^}}]*)\}} {struct};", self.HEADER).group(1)
        declarations = [" ".join(text.split()) for text in body.split(";")]
        declaration = re.compile(r"((?:const |unsigned )*\w+\*?) (?:\(\*)?(\w+)")
        return [declaration.match(text).groups() for text in declarations if text]

    def test_structs(self):
        for name in ("Mesh", "Points", "Options", "Iteration", "Report", "Callbacks", "Polygons", "Query",
                     "Defect"):
            own = {"Report": _report.Struct, "Options": _options.Struct, "Points": _points.Struct}
            struct = own.get(name) or getattr(_library, name)
            members = self.members(f"delaunayflip_{name.lower()}")
            self.assertEqual([member for _, member in members],
                             [field[0] for field in struct._fields_])
            for (kind, member), field in zip(members, struct._fields_):
                wanted = ctypes.c_void_p if kind.endswith("*") else None
                if name != "Callbacks":
                    self.assertIs(field[1], self.TYPES.get(kind, wanted), f"{name}.{member}")
            last = getattr(struct, struct._fields_[-1][0])  # the next member must be beyond the size
            self.assertEqual(last.offset + last.size, ctypes.sizeof(struct), name)

    def test_defaults(self):
        for function in (delaunayflip.flip, delaunayflip.triangulate):
            options = {name: value for name, value in function.__kwdefaults__.items()
                       if name in _options.Options.__annotations__ and name != "devices"}
            self.assertGreater(len(options), 3)
            self.assertEqual(bytes(_options.make_options(**options)), bytes(_options.make_options()))
        self.assertEqual(delaunayflip.flip.__kwdefaults__["devices"], ())
        struct = _library.make(_points.Struct)
        for name in _points.POINT_OPTIONS:
            self.assertEqual(delaunayflip.triangulate.__kwdefaults__[name], getattr(struct, name), name)

    def test_defaults_in_comments(self):
        """The default of a member is in brackets at the end of its comment: a number, or the end of the
        name of a constant."""
        text = (ROOT / "CInterface/delaunayflip_c.h").read_text()
        names = {"INFINITY": numpy.inf, "NULL": None, "INT32_MAX": 2**31 - 1, "INT64_MAX": 2**63 - 1}
        constants = [(name, int(value)) for name, value in re.findall(r"DELAUNAYFLIP_(\w+) = (\d+)", text)]
        for struct in (_library.Mesh, _library.Query, _options.Struct, _points.Struct):
            body = text[:text.index(f"}} delaunayflip_{struct.__name__.lower()};")].rpartition("typedef struct")[2]
            defaults = re.findall(r"(\w+); /\*\*<(?:(?!\*/).)*\[([-\w]+)\] \*/", body, re.DOTALL)
            self.assertGreater(len(defaults), 3)
            for member, told in defaults:
                wanted = [value for name, value in constants if f"_{name}".endswith(f"_{told}")]
                wanted += [names[told]] if told in names else []
                wanted += [float(told)] if re.fullmatch("-?[0-9]+", told) else []
                self.assertIn(getattr(_library.make(struct), member), wanted, f"{struct.__name__}.{member}")

    def test_interpolators_take_options_of_points(self):
        known = inspect.signature(delaunayflip.triangulate).parameters
        for kind in (delaunayflip.LinearInterpolator, delaunayflip.NaturalNeighborInterpolator):
            shown = inspect.signature(kind).parameters
            self.assertEqual([shown[name] for name in _points.POINT_OPTIONS],
                             [known[name] for name in _points.POINT_OPTIONS])
            self.assertNotIn("options", shown)
            with self.assertRaisesRegex(TypeError, "'alfa' is not an option"):
                kind([[0, 0], [1, 0], [0, 1]], [1, 2, 3], alfa=1.0)

    def test_enumerations(self):
        enumerations = {**_options.CHOICES, "geometry": _report.GEOMETRIES, "method": _ask.METHODS,
                        "stop_reason": _library.STOP_REASONS, "defect_kind": _library.DEFECT_KINDS}
        for name, words in enumerations.items():
            body = re.search(rf"typedef enum\s*\{{([^}}]*)\}} delaunayflip_{name};", self.HEADER)
            values = re.findall(r"DELAUNAYFLIP_(\w+) = (\d+)", body.group(1))
            self.assertEqual(len(values), len(words))
            for (constant, value), word in zip(values, words):
                self.assertEqual(words[int(value)], word)
                plain = word.upper().replace("-", "_").replace(" ", "_")
                self.assertIn(plain, constant)

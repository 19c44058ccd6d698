# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of triangulations while their points are moved, inserted and removed."""
import doctest
import pickle
import threading
import unittest
import warnings

import numpy
from delaunayflip import InvalidMesh, InvalidOptions, MovingTriangulation, Stopped, _moving, triangulate


def list_triangles(mesh):
    return {tuple(sorted(ids)) for ids in mesh.triangles.tolist()}


class Moving(unittest.TestCase):
    def setUp(self):
        self.random = numpy.random.default_rng(1)
        self.points = self.random.random((2000, 2))

    def expect(self, mesh, points):
        expected = triangulate(points)
        self.assertEqual(list_triangles(mesh), list_triangles(expected))
        self.assertEqual(mesh.used_points.tolist(), expected.used_points.tolist())
        self.assertEqual(mesh.report.edges, expected.report.edges)

    def test_frames(self):
        """The results follow the points, in place and anew, and arrays of earlier frames do not change."""
        for dtype in (numpy.float64, numpy.float32):
            points = self.points.astype(dtype)
            with MovingTriangulation(points, threads=2) as mesh:
                self.expect(mesh, points)
                first, copied = mesh.triangles, mesh.triangles.copy()
                self.assertIs(mesh.triangles, first)
                for size in (1e-4, 1e-4, 0.5, 1e-4):
                    points = (points + self.random.normal(0.0, size, points.shape)).astype(dtype)
                    mesh.move(points)
                    self.assertEqual(mesh.report.move_rounds > 0, size < 0.1)
                    self.expect(mesh, points)
                numpy.testing.assert_array_equal(first, copied)

    def test_neighbors(self):
        with MovingTriangulation(self.points) as mesh:
            mesh.move(self.points + self.random.normal(0.0, 1e-4, self.points.shape))
            triangles, neighbors = mesh.triangles, mesh.neighbors
            for t in range(0, len(triangles), 17):
                for corner, other in enumerate(neighbors[t]):
                    edge = set(triangles[t]) - {triangles[t][corner]}
                    self.assertTrue(other < 0 or edge < set(triangles[other]))

    def test_points_come_and_go(self):
        points = self.points
        with MovingTriangulation(points) as mesh:
            more = self.random.random((10, 3))
            self.assertEqual(mesh.insert(more).tolist(), list(range(2000, 2010)))
            points = numpy.concatenate([points, more[:, :2]])
            self.expect(mesh, points)
            mesh.remove([5, 2003, 5])
            left = points.copy()
            left[[5, 2003]] = numpy.nan
            self.expect(mesh, left)
            self.assertEqual((mesh.report.removed_points, mesh.report.points_not_finite), (2, 0))
            mesh.move(points + 0.25)
            self.expect(mesh, left + 0.25)
            mesh.move([[0.5, 0.5], [2.0, 2.0]], [7, 1])
            left += 0.25
            left[[7, 1]] = [[0.5, 0.5], [2.0, 2.0]]
            self.expect(mesh, left)
            mesh.compact()
            self.assertEqual((len(mesh), mesh.report.removed_points), (2008, 0))
            self.assertGreater(mesh.report.total_flips, 1000)
            mesh.remove(mesh.insert([[0.4, 0.6]]))
            self.assertGreater(mesh.report.move_rounds, 0)
            mesh.insert([[0.6, 0.4]])
            self.assertLess(mesh.report.total_flips, 50)  # those of this point alone
            mesh.remove([2008, 2009])
            mesh.compact()
            self.expect(mesh, left[numpy.isfinite(left[:, 0])])

    def test_segments(self):
        """An outline, a hole and a line move with their points, in place."""
        turns = numpy.arange(40) * numpy.pi / 20
        circle = numpy.stack([numpy.cos(turns), numpy.sin(turns)], axis=1)
        points = numpy.concatenate([0.45 * circle + 0.5, 0.1 * circle + 0.5, self.points])
        near = 81 + numpy.argmin(numpy.hypot(*(points[81:] - points[80]).T))
        given = {"segments": [[80, near]], "outline": numpy.arange(40), "holes": [numpy.arange(40, 80)]}
        in_place = 0
        with MovingTriangulation(points, **given) as mesh:
            for _ in range(20):
                points = points + self.random.normal(0.0, 5e-6, points.shape)
                mesh.move(points)
                in_place += mesh.report.move_rounds > 0
                expected = triangulate(points, **given)
                self.assertEqual(list_triangles(mesh), list_triangles(expected))
                self.assertEqual(mesh.segments.tolist(), expected.segments.tolist())
                self.assertEqual(mesh.report.outside_triangles, expected.report.outside_triangles)
            with self.assertRaisesRegex(InvalidOptions, "segments"):
                mesh.compact()
        self.assertGreater(in_place, 15)

    def test_segments_that_cross(self):
        """The later one is left out, with one warning, and comes back."""
        points = numpy.array([[0.0, 0.0], [4.0, 0.0], [0.0, 1.0], [4.0, 1.0], [2.0, 2.0], [2.0, -1.0]])
        with MovingTriangulation(points, [[0, 1], [2, 3]]) as mesh, warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            for height in (-0.5, -0.25, 1.0):
                mesh.move([[0.0, height]], [2])
                points[2, 1] = height
                moved = [warning for warning in told if "split_crossings" not in str(warning.message)]
                self.assertEqual(len(moved), 1)  # that of the first move, before anything is asked
                self.assertEqual(list_triangles(mesh), list_triangles(triangulate(points, [[0, 1], [2, 3]])))
                crosses = height < 0.0
                self.assertEqual(mesh.report.refused_segments, int(crosses))
                self.assertEqual("crosses segment 0" in mesh.report.defects, crosses)
                self.assertNotIn("split_crossings", mesh.report.defects)
                self.assertEqual(len(mesh.segments), 1 if crosses else 2)
        self.assertEqual(len(told), 3)  # two are of `triangulate`
        self.assertEqual({warning.filename for warning in told}, {__file__})

    def test_ends_that_are_removed(self):
        """Segments at a removed point are called so, in a warning and in the error of a ring."""
        points = numpy.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 1.0], [3.0, 1.5]])
        with MovingTriangulation(points, [[4, 5]], outline=[0, 1, 2, 3]) as mesh:
            with self.assertWarnsRegex(UserWarning, "ends at a removed point"):
                mesh.remove([5])
            self.assertNotIn("finite", mesh.report.defects)
            with self.assertRaisesRegex(InvalidMesh, "ring 0 of outline.* an end was removed"):
                mesh.remove([0])

    def test_rings_that_cross(self):
        """A ring that crosses a segment is an error that names it, and all points stay where they were."""
        points = numpy.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 1.0], [3.0, 1.5]])
        with MovingTriangulation(points, [[4, 5]], outline=[0, 1, 2, 3]) as mesh:
            before = list_triangles(mesh)
            with self.assertRaisesRegex(InvalidMesh, "ring 0 of outline"):
                mesh.move([[9.0, 1.5]], [5])
            self.assertEqual(list_triangles(mesh), before)
            mesh.move([[3.5, 1.5]], [5])
            self.assertEqual(list_triangles(mesh), before)

    def test_stops(self):
        """After a stop the points are where they were."""
        with MovingTriangulation(self.points) as mesh:
            for most in range(4):
                shares = []

                def observe(share):
                    shares.append(share)
                    return len(shares) <= most

                with self.assertRaises(Stopped):
                    mesh.move(self.random.random((2000, 2)), progress=observe)
                self.assertEqual(len(shares), most + 1)
                self.expect(mesh, self.points)
        shares = []
        MovingTriangulation(self.points, progress=shares.append).close()
        for which in range(len(shares) - 1):  # the last call comes when all is done
            answers = [number != which for number in reversed(range(len(shares)))]
            with self.assertRaises(Stopped):
                MovingTriangulation(self.points, progress=lambda share: answers.pop())

    def test_stops_flips(self):
        """An exception, such as Ctrl-C raises, stops the flips along a curve. The points are where they were."""
        turns = numpy.arange(20000) * numpy.pi / 10000

        def make_wave(frame):
            radius = 1.0 + 0.01 * numpy.sin(7.0 * turns + frame)
            return numpy.stack([radius * numpy.cos(turns), radius * numpy.sin(turns)], axis=1)

        def interrupt(share):
            shares.append(share)
            if share > 0.0:
                raise KeyboardInterrupt

        shares = []
        with MovingTriangulation(make_wave(0)) as mesh:
            with self.assertRaises(KeyboardInterrupt):
                mesh.move(make_wave(1), progress=interrupt)
            self.expect(mesh, make_wave(0))
            self.assertEqual(len(shares), 2)
            self.assertGreater(shares[1], 0.2)  # during flips, before all is made anew
            mesh.move(make_wave(1))
            self.expect(mesh, make_wave(1))

    def test_insertion_stops(self):
        """If an insertion is stopped or its observer fails, the new points count as removed."""
        for share in (0.0, 0.5):
            def observe(done):
                if done >= share:
                    raise KeyError(share)

            with MovingTriangulation(self.points) as mesh:
                mesh.remove([3])
                left = self.points.copy()
                with self.assertRaises(KeyError):
                    mesh.insert(self.random.random((9, 2)) * 3.0, progress=observe)
                self.assertEqual((len(mesh), mesh.report.removed_points), (2009, 10))
                left[3] = numpy.nan
                self.expect(mesh, numpy.concatenate([left, numpy.full((9, 2), numpy.nan)]))
                self.assertEqual(mesh.insert([[2.0, 2.0]]).tolist(), [2009])
                mesh.compact()
                self.expect(mesh, numpy.concatenate([numpy.delete(left, 3, axis=0), [[2.0, 2.0]]]))

    def test_no_ids(self):
        with MovingTriangulation(self.points) as mesh:
            mesh.move(numpy.empty((0, 2)), [])
            mesh.remove([])
            self.expect(mesh, self.points)
            with self.assertRaisesRegex(ValueError, "there must be 0 points, not 1"):
                mesh.move([[0.0, 0.0]], [])

    def test_what_is_refused(self):
        mesh = MovingTriangulation(self.points)
        for points, ids in ((self.points[1:], None), (self.points, [1, 2]), ([[0.0, 0.0]], [[1]]),
                            ([[0.0, 0.0]], [0.5])):
            with self.assertRaises(ValueError):
                mesh.move(points, ids)
        for wrong in (2000, -1, 2**63 - 1, 2**64 - 1, 2**70, -2**70):
            for ids in ([wrong], numpy.array([wrong]), numpy.array([3, wrong], dtype=object)):
                told = f"point {wrong} does not exist; there are 2,000 points"
                with self.assertRaisesRegex(InvalidOptions, told):
                    mesh.remove(ids)
                with self.assertRaisesRegex(InvalidOptions, told):
                    mesh.move(self.points[:len(ids)], ids)
        for mask in ([True, False], numpy.ones((2000, 1), dtype=bool)):
            with self.assertRaisesRegex(ValueError, r"a mask of all points must have the shape \(2000,\), not"):
                mesh.remove(mask)
        with self.assertRaisesRegex(ValueError, "ids must be integers"):
            mesh.remove(numpy.array([True, 2], dtype=object))
        with self.assertRaises(TypeError):
            pickle.dumps(mesh)
        self.expect(mesh, self.points)
        mesh.close()
        mesh.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            mesh.move(self.points)
        with self.assertRaisesRegex(ValueError, "the triangulation is closed"):
            with mesh:
                self.fail("nothing can be done with it")

    def test_masks(self):
        """Booleans choose points, as in NumPy."""
        points = self.points
        with MovingTriangulation(points) as mesh:
            left = points[:, 0] < 0.25
            points[left] += 1e-4
            mesh.move(points[left], left)
            self.expect(mesh, points)
            mesh.remove(left.astype(object))
            points[left] = numpy.nan
            self.expect(mesh, points)
            mesh.remove(numpy.zeros(2000, dtype=bool))
            self.expect(mesh, points)
            mesh.remove(numpy.ones(2000, dtype=bool))
            self.assertEqual(len(mesh.triangles), 0)

    def test_warnings_that_are_errors(self):
        """The change is complete before it is told of."""
        points = numpy.array([[0.0, 0.0], [4.0, 0.0], [0.0, 1.0], [4.0, 1.0], [2.0, 2.0], [2.0, -1.0]])
        segments = [[0, 1], [2, 3]]
        with MovingTriangulation(points, segments) as mesh, warnings.catch_warnings():
            warnings.simplefilter("error")
            for points[2, 1], is_told in ((-0.5, True), (-0.25, False), (1.0, False), (-0.5, True)):
                if is_told:
                    with self.assertRaisesRegex(UserWarning, "crosses segment 0"):
                        mesh.move(points)
                else:
                    mesh.move(points)
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    expected = triangulate(points, segments)
                self.assertEqual(list_triangles(mesh), list_triangles(expected))
                self.assertEqual(mesh.segments.tolist(), expected.segments.tolist())
                self.assertEqual(mesh._given.points.tolist(), points.tolist())

    def test_one_thing_at_a_time(self):
        with MovingTriangulation(self.points) as mesh:
            raised = []

            def read():
                try:
                    mesh.triangles
                except RuntimeError as error:
                    raised.append(error)

            def observe(share):
                thread = threading.Thread(target=read)
                thread.start()
                thread.join()

            mesh.move(self.points, progress=observe)
            self.assertEqual(len(raised), 1)

    def test_docstrings(self):
        self.assertEqual(doctest.testmod(_moving).failed, 0)


if __name__ == "__main__":
    unittest.main()

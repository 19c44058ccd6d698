#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Python package with arrays of CuPy, PyTorch and Numba on a GPU. What is not installed is
skipped. The exit status is 77 where all is, or where there is no GPU. PYTHONPATH names the package
and ../Python.
"""
import importlib.util
import sys
import unittest

SKIPPED = 77
try:
    import numpy
except ImportError:
    print("NumPy is not installed")
    sys.exit(SKIPPED)

import delaunayflip
from lattice import sheared_lattice

LIBRARIES = ("cupy", "torch", "numba")
INSTALLED = [name for name in LIBRARIES if importlib.util.find_spec(name)]


POINTS, TRIANGLES = sheared_lattice(150)


def flip_on_threads(points=POINTS, **keywords):
    return delaunayflip.flip(points, TRIANGLES, backend="threads", **keywords)


def address_of(array):
    return array.__cuda_array_interface__["data"][0]


class OfAnotherLibrary:
    """An array that can only be viewed by DLPack."""

    def __init__(self, array):
        self._array = array

    def __dlpack__(self, **keywords):
        return self._array.__dlpack__(**keywords)

    def __dlpack_device__(self):
        return self._array.__dlpack_device__()


class ByDlpack:
    """What holds for every library with DLPack."""

    def test_arrays_of_another_library(self):
        points, triangles = self.to_device(POINTS), self.to_device(TRIANGLES)
        expected = flip_on_threads().triangles
        for given in (
            (OfAnotherLibrary(points), OfAnotherLibrary(triangles)),
            (OfAnotherLibrary(points), triangles),
            (points, OfAnotherLibrary(triangles)),
        ):
            result = delaunayflip.flip(*given, regions=OfAnotherLibrary(triangles[:, 0] * 0))
            self.assertIn(type(result.triangles).__module__.partition(".")[0], ("cupy", "torch"))
            numpy.testing.assert_array_equal(to_numpy(result.triangles), expected)
        with delaunayflip.Session(points, triangles) as session:
            session.advance()
            session.store_triangles(OfAnotherLibrary(triangles))
        numpy.testing.assert_array_equal(self.to_host(triangles), expected)

    def test_results_have_dlpack(self):
        result = delaunayflip.flip(self.to_device(POINTS), self.to_device(TRIANGLES))
        for array in (result.triangles, result.flip_counts):
            self.assertEqual(array.__dlpack_device__()[0], 2)


def to_numpy(array):
    return array.get() if hasattr(array, "get") else array.cpu().numpy()


class Cases:
    """What holds for every library. `library` is its name, `to_device` and `to_host` convert."""

    has_operators = True  #: Whether its arrays can be compared and indexed.

    def check(self, points, triangles, **keywords):
        given = self.to_device(points), self.to_device(triangles)
        result = delaunayflip.flip(*given, **keywords)
        expected = delaunayflip.flip(points, triangles, backend="threads", **keywords)
        for found, wanted in (
            (result.triangles, expected.triangles),
            (result.flip_counts, expected.flip_counts),
        ):
            self.assertIs(type(found), type(given[1]))
            numpy.testing.assert_array_equal(self.to_host(found), wanted)
            self.assertEqual(self.to_host(found).dtype, wanted.dtype)
        self.assertEqual(result.report.total_flips, expected.report.total_flips)
        self.assertGreater(result.report.total_flips, 0)
        numpy.testing.assert_array_equal(self.to_host(given[0]), points)
        numpy.testing.assert_array_equal(self.to_host(given[1]), triangles)
        self.assertNotEqual(address_of(given[1]), address_of(result.triangles))
        return result

    def test_all_types(self):
        for real in (numpy.float32, numpy.float64):
            for integer in (numpy.int32, numpy.int64):
                for columns in (2, 3):
                    with self.subTest(real=real, integer=integer, columns=columns):
                        points = numpy.ascontiguousarray(POINTS[:, :columns], dtype=real)
                        result = self.check(points, TRIANGLES.astype(integer))
                        self.assertTrue(result.report.backend.startswith("CUDA: "))
                        self.assertEqual(result.report.fallback, "")

    def test_few_triangles_on_the_gpu_and_on_threads(self):
        points, triangles = sheared_lattice(4)
        self.assertTrue(self.check(points, triangles).report.backend.startswith("CUDA: "))
        given = self.to_device(points), self.to_device(triangles)
        result = delaunayflip.flip(*given, backend="threads")
        self.assertTrue(result.report.backend.startswith("Threads: "))
        self.assertIs(type(result.triangles), type(given[1]))

    def test_steps(self):
        with delaunayflip.Session(self.to_device(POINTS), self.to_device(TRIANGLES)) as session:
            numpy.testing.assert_array_equal(self.to_host(session.triangles), TRIANGLES)
            while session.advance(2):
                self.assertEqual(tuple(session.triangles.shape), TRIANGLES.shape)
            numpy.testing.assert_array_equal(
                self.to_host(session.triangles), flip_on_threads().triangles)
            self.assertEqual(self.to_host(session.flip_counts).sum(),
                             2 * session.report.total_flips)

    def test_what_must_stay(self):
        regions = (TRIANGLES[:, 0] // 4000).astype(numpy.int32)
        frozen = TRIANGLES[:, 0] % 50 == 0
        constraints = TRIANGLES[:40, :2]
        keywords = {"regions": regions, "frozen": frozen, "constraints": constraints}
        self.check(POINTS, TRIANGLES, **keywords)
        on_device = {
            "regions": self.to_device(regions),
            "constraints": self.to_device(numpy.ascontiguousarray(constraints)),
        }
        found = delaunayflip.flip(self.to_device(POINTS), self.to_device(TRIANGLES), **on_device)
        expected = flip_on_threads(regions=regions, constraints=constraints)
        numpy.testing.assert_array_equal(self.to_host(found.triangles), expected.triangles)

    def test_a_constraint_is_inserted(self):
        ends = [[0, 150 * 75 + 149]]
        result = self.check(POINTS, TRIANGLES, constraints=ends)
        self.assertEqual(result.report.inserted_constraints, 1)

    def test_points_are_triangulated(self):
        points = numpy.random.default_rng(1).random((30000, 2))
        for options in ({}, {"segments": [[0, 1], [2, 3]]}, {"longest_edge": 0.01},
                        {"segments": [[0, 1], [2, 3], [4, 5]], "split_crossings": True}):
            for real in (numpy.float32, numpy.float64):
                with self.subTest(options=options, real=real):
                    given = self.to_device(points.astype(real))
                    found = delaunayflip.triangulate(given, **options)
                    wanted = delaunayflip.triangulate(
                        points.astype(real), backend="threads", **options)
                    self.assertTrue(found.report.backend.startswith("CUDA: "))
                    for name in ("triangles", "neighbors"):
                        self.assertIs(type(getattr(found, name)), type(given))
                        numpy.testing.assert_array_equal(
                            self.to_host(getattr(found, name)), getattr(wanted, name))
                    numpy.testing.assert_array_equal(found.used_points, wanted.used_points)
                    numpy.testing.assert_array_equal(found.segments, wanted.segments)

    def test_points_on_a_sphere(self):
        """They stay on the GPU unless there are lines or ties, as on a cube."""
        places = numpy.random.default_rng(3).normal(size=(30000, 3))
        places /= numpy.linalg.norm(places, axis=1, keepdims=True)
        cube = numpy.stack(numpy.meshgrid([-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0]), axis=-1).reshape(-1, 3)
        for points, options in ((places, {}), (places, {"segments": [[0, 1]]}), (cube, {}),
                                (numpy.r_[places, places[:5]], {})):
            for real in (numpy.float32, numpy.float64):
                with self.subTest(points=len(points), options=options, real=real):
                    given = self.to_device(points.astype(real))
                    found = delaunayflip.triangulate_sphere(given, **options)
                    wanted = delaunayflip.triangulate_sphere(
                        points.astype(real), backend="threads", **options)
                    for name in ("triangles", "neighbors"):
                        self.assertIs(type(getattr(found, name)), type(given))
                        numpy.testing.assert_array_equal(
                            self.to_host(getattr(found, name)), getattr(wanted, name))
                    for name in ("used_points", "segments", "voronoi_corners"):
                        numpy.testing.assert_array_equal(getattr(found, name), getattr(wanted, name))
                    self.assertEqual(found.report.minimum_angle_after, wanted.report.minimum_angle_after)
        found = delaunayflip.triangulate_sphere(self.to_device(places))
        wanted = delaunayflip.triangulate_sphere(places, backend="threads")
        self.assertTrue(found.report.backend.startswith("CUDA: "))
        self.assertIs(type(found.points), type(self.to_device(places)))
        numpy.testing.assert_array_equal(
            found.interpolate(places[:, 2], [[10.0, 20.0]]), wanted.interpolate(places[:, 2], [[10.0, 20.0]]))

    def test_values_between_points(self):
        """The bits are those of the host; results are where the places are, rasters where the values."""
        draw = numpy.random.default_rng(2)
        points, places = draw.random((20000, 2)), draw.random((300, 40, 2)) * 1.2 - 0.1
        values = numpy.c_[points[:, 0], numpy.sin(9 * points)]
        square = {"outline": [[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [0.2, 0.8]], "outside": "nearest"}
        moved, there = self.to_device(points), self.to_device(places)

        def check(found, wanted):
            self.assertIs(type(found), type(there))
            numpy.testing.assert_array_equal(self.to_host(found), wanted)

        for kind in (delaunayflip.LinearInterpolator, delaunayflip.NaturalNeighborInterpolator):
            on_host = kind(points, values, backend="threads")
            f = kind(moved, self.to_device(values))
            self.assertTrue(f.triangulation.report.backend.startswith("CUDA: "))
            check(f(there), on_host(places))
            check(f.locate(there), on_host.locate(places))
            check(f.raster((0, 0), 0.01, (90, 110)), on_host.raster((0, 0), 0.01, (90, 110)))
            numpy.testing.assert_array_equal(f(places), on_host(places))
            check(on_host(there), on_host(places))
            check(kind(points, values, **square)(there), kind(points, values, **square)(places))
            check(kind(moved, values[:, 0])(there), kind(points, values[:, 0])(places))
            soft = {"segments": [[0, 1]], "breaklines": "soft", "fill_value": 7.0}
            f = kind(moved, self.to_device(values), **soft)
            if self.has_operators:
                check(f(there), kind(points, values, **soft)(places))
                x, y = there[..., 0], there[..., 1]
                check(f(x, y), kind(points, values, **soft)(places))
            else:
                with self.assertRaisesRegex(TypeError, "arrays of Numba take no fill_value"):
                    f(there)
            f = kind(moved, self.to_device(values), outside="error")
            with self.assertRaisesRegex(ValueError, "places are outside"):
                f(there)
        mesh = delaunayflip.triangulate(moved)
        linear = delaunayflip.LinearInterpolator(points, values, backend="threads")
        check(mesh.interpolate(self.to_device(values), there), linear(places))

    def test_errors(self):
        points, triangles = self.to_device(POINTS), self.to_device(TRIANGLES)
        with self.assertRaisesRegex(TypeError, "float32 or float64, not float16"):
            delaunayflip.flip(self.to_device(POINTS.astype(numpy.float16)), triangles)
        with self.assertRaisesRegex(ValueError, r"triangles must have the shape \(n, 3\), not"):
            delaunayflip.flip(points, self.to_device(TRIANGLES.reshape(-1, 6)))
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "GPU 7"):
            delaunayflip.flip(points, triangles, device=7)
        wrong = TRIANGLES.copy()
        wrong[5, 1] = len(POINTS)
        with self.assertRaises(delaunayflip.InvalidMesh) as caught:
            delaunayflip.flip(points, self.to_device(wrong))
        self.assertEqual((caught.exception.cell, caught.exception.point), (5, len(POINTS)))

    def test_smallest_angles(self):
        points, triangles = self.to_device(POINTS), self.to_device(TRIANGLES)
        numpy.testing.assert_array_equal(
            delaunayflip.smallest_angles(points, triangles),
            delaunayflip.smallest_angles(POINTS, TRIANGLES))

    def test_empty(self):
        none = self.to_device(numpy.empty((0, 3), dtype=numpy.int64))
        result = delaunayflip.flip(self.to_device(POINTS), none)
        self.assertEqual(tuple(result.triangles.shape), (0, 3))


@unittest.skipUnless("cupy" in INSTALLED, "CuPy is not installed")
class CuPy(Cases, ByDlpack, unittest.TestCase):
    def to_device(self, array):
        import cupy

        return cupy.asarray(array)

    def to_host(self, array):
        return array.get()

    def test_views(self):
        columns = self.to_device(numpy.asfortranarray(POINTS))
        result = delaunayflip.flip(columns[:, :2], self.to_device(TRIANGLES))
        numpy.testing.assert_array_equal(result.triangles.get(), flip_on_threads().triangles)

    def test_current_stream(self):
        import cupy

        triangles = self.to_device(TRIANGLES)
        late = cupy.full_like(triangles, -1)
        slow = cupy.ones((4096, 4096))
        cupy.cuda.Device().synchronize()
        stream = cupy.cuda.Stream(non_blocking=True)
        with stream:
            for _ in range(200):
                slow = cupy.sqrt(slow * slow + 1)
            late[:] = triangles
            result = delaunayflip.flip(self.to_device(POINTS), late)
        numpy.testing.assert_array_equal(result.triangles.get(), flip_on_threads().triangles)


@unittest.skipUnless("torch" in INSTALLED, "PyTorch is not installed")
class PyTorch(Cases, ByDlpack, unittest.TestCase):
    def to_device(self, array):
        import torch

        return torch.as_tensor(array, device="cuda")

    def to_host(self, array):
        return array.cpu().numpy()

    def test_views_and_gradients(self):
        points = self.to_device(POINTS.T.copy()).T.requires_grad_()
        result = delaunayflip.flip(points[:, :2], self.to_device(TRIANGLES))
        numpy.testing.assert_array_equal(
            self.to_host(result.triangles), flip_on_threads().triangles)

    def test_tensors_of_the_host(self):
        import torch

        result = delaunayflip.flip(torch.as_tensor(POINTS), torch.as_tensor(TRIANGLES))
        numpy.testing.assert_array_equal(result.triangles, flip_on_threads().triangles)

    def test_current_stream(self):
        import torch

        points, triangles = self.to_device(POINTS), self.to_device(TRIANGLES)
        late = torch.full_like(triangles, -1)
        torch.cuda.synchronize()
        with torch.cuda.stream(torch.cuda.Stream()):
            torch.cuda._sleep(400_000_000)  # cycles
            late.copy_(triangles)
            result = delaunayflip.flip(points, late)
        numpy.testing.assert_array_equal(
            self.to_host(result.triangles), flip_on_threads().triangles)


@unittest.skipUnless("numba" in INSTALLED, "Numba is not installed")
class Numba(Cases, unittest.TestCase):
    has_operators = False

    def to_device(self, array):
        from numba import cuda

        return cuda.to_device(array)

    def to_host(self, array):
        return array.copy_to_host()

    def test_columns(self):
        with self.assertRaisesRegex(ValueError, "contiguous"):
            delaunayflip.flip(
                self.to_device(numpy.asfortranarray(POINTS)), self.to_device(TRIANGLES))


def main():
    if not delaunayflip.has_cuda_device() or not INSTALLED:
        print("no GPU" if INSTALLED else "none of CuPy, PyTorch and Numba is installed")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)


if __name__ == "__main__":
    main()

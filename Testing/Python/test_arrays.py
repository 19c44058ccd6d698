# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The package's functions for NumPy arrays. None of it may load VTK."""
import ctypes
import doctest
import gc
import os
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time
import types
import unittest
import unittest.mock
import weakref

import numpy

import delaunayflip
from delaunayflip import _arrays, _library, _options
from lattice import sheared_lattice

ROOT = pathlib.Path(__file__).resolve().parents[2]

POINTS = numpy.array([[0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]], dtype=float)
TRIANGLES = numpy.array([[0, 1, 2], [0, 2, 3]])


class Flip(unittest.TestCase):
    def test_square(self):
        result = delaunayflip.flip(POINTS, TRIANGLES)
        edges = {frozenset(triangle) for triangle in result.triangles.tolist()}
        self.assertEqual(edges, {frozenset((0, 1, 3)), frozenset((1, 2, 3))})
        self.assertEqual(result.flip_counts.tolist(), [1, 1])
        self.assertTrue(result.report.converged)
        self.assertEqual(result.report.geometry_used, "planar")
        self.assertEqual(result.report.non_delaunay_before, 1)
        self.assertEqual(result.report.non_delaunay_after, 0)
        self.assertEqual(result.iterations["flipped"].sum(), 1)

    def test_all_types_give_the_same_triangles(self):
        points, triangles = sheared_lattice(20)
        expected = delaunayflip.flip(points, triangles).triangles
        for real in (numpy.float32, numpy.float64):
            for integer in (numpy.int32, numpy.int64, numpy.uint16, numpy.uint64):
                with self.subTest(real=real, integer=integer):
                    given = triangles.astype(integer)
                    found = delaunayflip.flip(points.astype(real), given).triangles
                    numpy.testing.assert_array_equal(found, expected)
                    kept = integer in (numpy.int32, numpy.int64)
                    self.assertEqual(found.dtype, integer if kept else numpy.int64)

    def test_lists_and_two_columns(self):
        result = delaunayflip.flip(POINTS[:, :2].tolist(), TRIANGLES.tolist())
        self.assertEqual(result.report.total_flips, 1)

    def test_strides(self):
        points, triangles = sheared_lattice(10)
        expected = delaunayflip.flip(points, triangles).triangles
        wide = numpy.zeros((len(points), 7))
        wide[:, 1:6:2] = points
        found = delaunayflip.flip(wide[:, 1:6:2], numpy.asfortranarray(triangles)).triangles
        numpy.testing.assert_array_equal(found, expected)

    def test_the_input_is_not_written_and_not_copied(self):
        points, triangles = sheared_lattice(10)
        points.flags.writeable = triangles.flags.writeable = False
        before = triangles.copy()
        delaunayflip.flip(points, triangles)
        numpy.testing.assert_array_equal(triangles, before)
        mesh = _arrays.Mesh(points, triangles)
        self.assertIs(mesh.points, points)
        self.assertIs(mesh.triangles, triangles)

    def test_threads_agree(self):
        points, triangles = sheared_lattice(60)
        runs = [delaunayflip.flip(points, triangles, threads=n).triangles for n in (1, 2, 5)]
        numpy.testing.assert_array_equal(runs[0], runs[1])
        numpy.testing.assert_array_equal(runs[0], runs[2])

    def test_pieces_agree(self):
        points, triangles = sheared_lattice(60)
        runs = [delaunayflip.flip(points, triangles, pieces=n, tie_rule="canonical")
                for n in (0, 1, 7)]
        sets = [{frozenset(ids) for ids in run.triangles.tolist()} for run in runs]
        self.assertEqual(sets[0], sets[1])
        self.assertEqual(sets[0], sets[2])
        for run in runs:
            self.assertEqual(run.flip_counts.sum(), 2 * run.report.total_flips)
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "number of pieces"):
            delaunayflip.flip(points, triangles, pieces=256)

    def test_what_must_stay(self):
        for keywords in (
            {"constraints": [[2, 0]]},
            {"regions": [7, 8]},
            {"frozen": [False, True]},
            {"maximum_iterations": 0},
        ):
            with self.subTest(**keywords):
                result = delaunayflip.flip(POINTS, TRIANGLES, **keywords)
                numpy.testing.assert_array_equal(result.triangles, TRIANGLES)

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
        result = delaunayflip.flip(numpy.empty((0, 3)), [])
        self.assertEqual(result.triangles.shape, (0, 3))
        self.assertTrue(numpy.isnan(result.report.minimum_angle_before))

    def test_track_quality(self):
        points, triangles = sheared_lattice(10)
        plain = delaunayflip.flip(points, triangles).iterations["minimum_angle"]
        tracked = delaunayflip.flip(points, triangles, track_quality=True).iterations
        self.assertTrue(numpy.isnan(plain[1:-1]).all())
        self.assertTrue(numpy.isfinite(tracked["minimum_angle"]).all())

    def test_smallest_angles(self):
        found = delaunayflip.smallest_angles(POINTS, TRIANGLES)
        numpy.testing.assert_allclose(found, 26.565051177077976)


class Errors(unittest.TestCase):
    def test_invalid_mesh(self):
        with self.assertRaises(delaunayflip.InvalidMesh) as caught:
            delaunayflip.flip(POINTS, [[0, 1, 2], [0, 2, 4]])
        self.assertEqual((caught.exception.cell, caught.exception.point), (1, 4))
        self.assertIn("4", str(caught.exception))
        with self.assertRaises(delaunayflip.InvalidMesh):
            delaunayflip.smallest_angles(POINTS, [[0, 1, -1]])

    def test_classes(self):
        self.assertTrue(issubclass(delaunayflip.InvalidMesh, ValueError))
        self.assertTrue(issubclass(delaunayflip.InvalidMesh, delaunayflip.FlipError))

    def test_invalid_options(self):
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "feature angle"):
            delaunayflip.flip(POINTS, TRIANGLES, feature_angle=181)
        with self.assertRaisesRegex(ValueError, "geometry must be one of auto, planar"):
            delaunayflip.flip(POINTS, TRIANGLES, geometry="round")
        with self.assertRaises(TypeError):
            delaunayflip.flip(POINTS, TRIANGLES, colour="red")
        with self.assertRaisesRegex(TypeError, "colour"):
            _options.make_options(colour="red")

    def test_shapes_and_types(self):
        for points, triangles, error in (
            (POINTS.ravel(), TRIANGLES, ValueError),
            (POINTS[:, :1], TRIANGLES, ValueError),
            (POINTS, TRIANGLES[:, :2], ValueError),
            (POINTS, TRIANGLES + 0.5, TypeError),
            (POINTS.astype(complex), TRIANGLES, TypeError),
            (POINTS.astype(str), TRIANGLES, TypeError),
        ):
            with self.subTest(points=points.shape, triangles=triangles.dtype):
                with self.assertRaises(error):
                    delaunayflip.flip(points, triangles)
        with self.assertRaisesRegex(ValueError, "regions"):
            delaunayflip.flip(POINTS, TRIANGLES, regions=[1, 2, 3])
        with self.assertRaisesRegex(ValueError, "int32"):
            delaunayflip.flip(POINTS, TRIANGLES, regions=[1, 2**40])

    @unittest.skipIf(delaunayflip.has_cuda_device(), "there is a GPU")
    def test_smallest_angles_of_arrays_on_a_gpu(self):
        class Array:
            __module__ = "cupy"
            __cuda_array_interface__ = {}

            def __init__(self, values):
                self.get = lambda: values

        numpy.testing.assert_array_equal(
            delaunayflip.smallest_angles(Array(POINTS), Array(TRIANGLES)),
            delaunayflip.smallest_angles(POINTS, TRIANGLES))

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
            with self.assertRaisesRegex(TypeError, "triangles must be in the memory of the GPU"):
                delaunayflip.flip(Other(POINTS), TRIANGLES)
        numpy.testing.assert_array_equal(angles, delaunayflip.smallest_angles(POINTS, TRIANGLES))
        with unittest.mock.patch("importlib.util.find_spec", lambda name: None):
            with self.assertRaisesRegex(TypeError, "need CuPy or PyTorch"):
                delaunayflip.flip(Other(POINTS), Other(TRIANGLES))

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

        points, triangles = Other(POINTS), Other(TRIANGLES)
        self.assertEqual(_arrays.as_points(points).ctypes.data, points.address)
        self.assertEqual(_arrays.as_ids("triangles", triangles, 3).ctypes.data, triangles.address)
        self.assertEqual(delaunayflip.flip(points, triangles).report.total_flips, 1)
        for fixed in ({"constraints": [[0, 2]]}, {"regions": [1, 2]}, {"frozen": [1, 0]}):
            others = {name: Other(values) for name, values in fixed.items()}
            self.assertEqual(delaunayflip.flip(points, triangles, **others).report.total_flips, 0)

    def test_arrays_on_a_gpu(self):
        """Testing/Gpu/test_device_arrays.py flips them."""

        class Unknown:
            __cuda_array_interface__ = {"shape": (4, 3), "typestr": "<f8", "data": (0, False)}

        with self.assertRaisesRegex(TypeError, "triangles must be in the memory of the GPU"):
            delaunayflip.flip(Unknown(), TRIANGLES)
        with self.assertRaisesRegex(TypeError, "points must be in the memory of the GPU"):
            delaunayflip.flip(POINTS, Unknown())
        with self.assertRaisesRegex(TypeError, f"or have __dlpack__, not of {__name__}"):
            delaunayflip.flip(Unknown(), Unknown())

    def test_backend_unavailable(self):
        with self.assertRaises(delaunayflip.BackendUnavailable):
            delaunayflip.flip(POINTS, TRIANGLES, backend="cuda")

    def test_a_name_that_is_not_there(self):
        with self.assertRaises(AttributeError):
            delaunayflip.flop


class Callbacks(unittest.TestCase):
    def test_progress(self):
        points, triangles = sheared_lattice(50)
        shares = []
        delaunayflip.flip(points, triangles, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1.0)

    def test_progress_aborts(self):
        points, triangles = sheared_lattice(50)
        result = delaunayflip.flip(points, triangles, progress=lambda share: False)
        self.assertEqual(result.report.stop_reason, "aborted")
        numpy.testing.assert_array_equal(result.triangles, triangles)

    def test_iterations_abort(self):
        points, triangles = sheared_lattice(30)
        records = []
        result = delaunayflip.flip(points, triangles,
                                   on_iteration=lambda record: bool(records.append(record)))
        self.assertEqual(len(records), 1)
        self.assertEqual(result.report.stop_reason, "aborted")
        self.assertEqual(records[0]["flipped"], result.report.total_flips)

    def test_exceptions_come_through(self):
        points, triangles = sheared_lattice(30)

        def fail(_):
            raise ZeroDivisionError("in the callback")

        for name in ("progress", "on_iteration"):
            with self.subTest(name), self.assertRaisesRegex(ZeroDivisionError, "in the callback"):
                delaunayflip.flip(points, triangles, **{name: fail})

    def test_the_lock_of_the_interpreter_is_free(self):
        points, triangles = sheared_lattice(600)  # half a second
        done = threading.Event()
        turns = []

        def count():
            while not done.is_set():
                turns.append(None)
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        delaunayflip.flip(points, triangles, threads=1)
        done.set()
        thread.join()
        self.assertGreater(len(turns), 5)

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
                              cwd=os.path.dirname(os.path.abspath(__file__))) as process:
            self.assertEqual(process.stdout.readline(), "ready\n")
            process.send_signal(signal.SIGINT)
            try:
                _, errors = process.communicate(timeout=60)
            finally:
                process.kill()
        self.assertTrue(errors.rstrip().endswith("KeyboardInterrupt"), errors)
        self.assertIn("delaunayflip/_session.py", errors)


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
        self.assertGreater(steps, 2)
        whole = delaunayflip.flip(points, triangles)
        numpy.testing.assert_array_equal(stepped, whole.triangles)

    def test_closed(self):
        session = delaunayflip.Session(POINTS, TRIANGLES)
        session.close()
        session.close()
        for use in (session.advance, lambda: session.triangles, lambda: session.report):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()

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

    def test_a_failing_one_is_freed(self):
        with self.assertRaises(delaunayflip.InvalidMesh):
            delaunayflip.Session(POINTS, [[0, 1, 9]])
        gc.collect()


class Package(unittest.TestCase):
    def test_version(self):
        project = (ROOT / "CMakeLists.txt").read_text()
        self.assertIn(f"VERSION {delaunayflip.__version__} ", project)

    def test_arrays_need_no_vtk(self):
        program = ("import sys, delaunayflip\n"
                   "delaunayflip.flip([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])\n"
                   "print([name for name in sys.modules if 'vtk' in name])")
        output = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True,
                                text=True).stdout
        self.assertEqual(output, "[]\n")

    def test_the_package_itself_needs_no_numpy(self):
        program = "import sys, delaunayflip; print('numpy' in sys.modules)"
        output = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True,
                                text=True).stdout
        self.assertEqual(output, "False\n")

    def test_docstrings(self):
        import delaunayflip._flip as flip_module
        import delaunayflip._session as session_module
        for module in (flip_module, session_module):
            result = doctest.testmod(module)
            self.assertGreater(result.attempted, 2)
            self.assertEqual(result.failed, 0)


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
        for name in ("Mesh", "Options", "Iteration", "Report", "Callbacks", "Polygons"):
            struct = getattr(_library, name)
            members = self.members(f"delaunayflip_{name.lower()}")
            self.assertEqual([member for _, member in members],
                             [field[0] for field in struct._fields_])
            for (kind, member), field in zip(members, struct._fields_):
                wanted = ctypes.c_void_p if kind.endswith("*") else None
                if name != "Callbacks":
                    self.assertIs(field[1], self.TYPES.get(kind, wanted), f"{name}.{member}")

    def test_enumerations(self):
        for name, words in (("geometry", _library.GEOMETRIES), ("criterion", _library.CRITERIA),
                            ("tie_rule", _library.TIE_RULES), ("backend", _library.BACKENDS),
                            ("stop_reason", _library.STOP_REASONS)):
            body = re.search(rf"typedef enum\s*\{{([^}}]*)\}} delaunayflip_{name};", self.HEADER)
            values = re.findall(r"DELAUNAYFLIP_(\w+) = (\d+)", body.group(1))
            self.assertEqual(len(values), len(words))
            for (constant, value), word in zip(values, words):
                self.assertEqual(words[int(value)], word)
                plain = word.upper().replace("-", "_").replace(" ", "_")
                self.assertIn(plain, constant)

    def test_interface_version(self):
        version = re.search(r"INTERFACE_VERSION (\d+)", self.HEADER).group(1)
        self.assertEqual(int(version), _library.INTERFACE_VERSION)


if __name__ == "__main__":
    unittest.main()

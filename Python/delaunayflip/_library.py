# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""libdelaunayflip by ctypes: delaunayflip_c.h in Python."""
import ctypes
import functools
import pathlib
from ctypes import c_char_p, c_double, c_int32, c_int64, c_void_p

from . import _errors

INTERFACE_VERSION = 1
LIBRARY = f"libdelaunayflip.so.{INTERFACE_VERSION}"

FLOAT32, FLOAT64, INT32, INT64 = range(4)
HOST, CUDA = range(2)

# In the order of the enumerations of the header.
GEOMETRIES = ("auto", "planar", "planar-xy", "surface")
CRITERIA = ("in-circle", "opposite-angles")
TIE_RULES = ("keep", "canonical")
BACKENDS = ("auto", "cuda", "threads")
STOP_REASONS = ("not started", "converged", "iteration limit", "aborted", "running")


class Mesh(ctypes.Structure):
    _fields_ = [
        ("size", c_int64),
        ("points", c_void_p),
        ("number_of_points", c_int64),
        ("triangles", c_void_p),
        ("number_of_triangles", c_int64),
        ("point_type", c_int32),
        ("id_type", c_int32),
        ("constraint_edges", c_void_p),
        ("number_of_constraint_edges", c_int64),
        ("constraints_to_insert", c_void_p),
        ("regions", c_void_p),
        ("frozen_triangles", c_void_p),
        ("triangle_numbers", c_void_p),
        ("memory", c_int32),
        ("point_components", c_int32),
        ("stream", c_void_p),
    ]


class Polygons(ctypes.Structure):
    _fields_ = [
        ("size", c_int64),
        ("number_of_polygons", c_int64),
        ("offsets", c_void_p),
        ("corners", c_void_p),
    ]


class Options(ctypes.Structure):
    _fields_ = [
        ("size", c_int64),
        ("geometry", c_int32),
        ("criterion", c_int32),
        ("tie_rule", c_int32),
        ("backend", c_int32),
        ("tolerance", c_double),
        ("feature_angle", c_double),
        ("maximum_iterations", c_int64),
        ("number_of_threads", c_int32),
        ("device", c_int32),
        ("track_quality", c_int32),
        ("number_of_pieces", c_int32),
        ("devices", c_char_p),
    ]


class Iteration(ctypes.Structure):
    _fields_ = [
        ("iteration", c_int64),
        ("tested", c_int64),
        ("non_delaunay", c_int64),
        ("flipped", c_int64),
        ("excluded", c_int64),
        ("blocked", c_int64),
        ("minimum_angle", c_double),
        ("seconds", c_double),
    ]


class Report(ctypes.Structure):
    _fields_ = [
        ("size", c_int64),
        ("stop_reason", c_int32),
        ("geometry_used", c_int32),
        ("geometry_reason", c_char_p),
        ("backend", c_char_p),
        ("fallback", c_char_p),
        ("tolerance", c_char_p),
        ("defects", c_char_p),
        ("number_of_iterations", c_int64),
        ("total_flips", c_int64),
        ("total_excluded", c_int64),
        ("total_blocked", c_int64),
        ("non_delaunay_before", c_int64),
        ("non_delaunay_after", c_int64),
        ("blocked_by_shape", c_int64),
        ("blocked_by_edge", c_int64),
        ("edges", c_int64),
        ("boundary_edges", c_int64),
        ("non_manifold_edges", c_int64),
        ("wrongly_wound_edges", c_int64),
        ("feature_edges", c_int64),
        ("constraint_edges", c_int64),
        ("region_edges", c_int64),
        ("fixed_edges", c_int64),
        ("unmatched_constraints", c_int64),
        ("inserted_constraints", c_int64),
        ("constraint_flips", c_int64),
        ("euler_characteristic", c_int64),
        ("minimum_angle_before", c_double),
        ("minimum_angle_after", c_double),
        ("build_seconds", c_double),
        ("flip_seconds", c_double),
    ]


ProgressFunction = ctypes.CFUNCTYPE(c_int32, c_double, c_void_p)
IterationFunction = ctypes.CFUNCTYPE(c_int32, ctypes.POINTER(Iteration), c_void_p)


class Callbacks(ctypes.Structure):
    _fields_ = [
        ("size", c_int64),
        ("progress", ProgressFunction),
        ("iteration", IterationFunction),
        ("user", c_void_p),
    ]


def _candidates():
    """Where the library may be: in the package (a wheel or a build), in the lib folder under which
    the package was installed, or where the system searches."""
    package = pathlib.Path(__file__).resolve().parent
    for folder in (package, *list(package.parents)[1:3]):
        if (folder / LIBRARY).exists():
            yield str(folder / LIBRARY)
    yield LIBRARY


@functools.lru_cache(maxsize=None)
def library():
    """The loaded library, with the types of its functions.

    Raises:
        ImportError: The library does not exist, or has another interface version.
    """
    loaded = ctypes.CDLL(next(_candidates()))
    if loaded.delaunayflip_interface_version() != INTERFACE_VERSION:
        raise ImportError(f"{loaded._name} has another interface than this Python package")
    pointer = ctypes.POINTER
    for name, result, arguments in (
        ("version", c_char_p, []),
        ("error_message", c_char_p, []),
        ("error_cell", c_int64, []),
        ("error_point", c_int64, []),
        ("mesh_init", None, [pointer(Mesh)]),
        ("options_init", None, [pointer(Options)]),
        ("report_init", None, [pointer(Report)]),
        ("callbacks_init", None, [pointer(Callbacks)]),
        ("open", c_int32, [pointer(Mesh), pointer(Options), pointer(Callbacks), pointer(c_void_p)]),
        ("advance", c_int32, [c_void_p, c_int64, pointer(Callbacks), pointer(c_int32)]),
        ("get_report", c_int32, [c_void_p, pointer(Report)]),
        ("get_iterations", c_int32, [c_void_p, c_int64, c_int64, c_void_p, c_int64]),
        ("store_triangles", c_int32, [c_void_p, c_void_p, c_int32]),
        ("store_flip_counts", c_int32, [c_void_p, c_void_p]),
        ("store_triangles_on_device", c_int32, [c_void_p, c_void_p, c_int32, c_void_p]),
        ("store_flip_counts_on_device", c_int32, [c_void_p, c_void_p, c_void_p]),
        ("close", None, [c_void_p]),
        ("triangle_angles", c_int32, [pointer(Mesh), c_int32, c_void_p]),
        ("triangle_normals", c_int32, [pointer(Mesh), c_void_p]),
        ("polygons_init", None, [pointer(Polygons)]),
        ("split_polygons", c_int32,
         [pointer(Mesh), pointer(Polygons), pointer(Callbacks), c_void_p]),
        ("has_cuda_device", c_int32, []),
        ("release_cuda_memory", None, []),
    ):
        function = getattr(loaded, f"delaunayflip_{name}")
        function.restype = result
        function.argtypes = arguments
    return loaded


_EXCEPTIONS = {
    1: _errors.InvalidMesh,
    2: _errors.InvalidOptions,
    3: _errors.MeshTooLarge,
    4: _errors.BackendUnavailable,
    5: MemoryError,
    6: ValueError,
    8: _errors.Stopped,
}


def call(name, *arguments):
    """Calls delaunayflip_<name> and raises the exception that belongs to its status."""
    status = getattr(library(), f"delaunayflip_{name}")(*arguments)
    if status == 0:
        return
    message = library().delaunayflip_error_message().decode(errors="replace")
    if status == 1:
        place = library().delaunayflip_error_cell(), library().delaunayflip_error_point()
        raise _errors.InvalidMesh(message, *place)
    raise _EXCEPTIONS.get(status, _errors.FlipError)(message)


def version() -> str:
    """The release of the engine, e.g. "0.1.0"."""
    return library().delaunayflip_version().decode()


def has_cuda_device() -> bool:
    """Whether there is a GPU that the engine can use."""
    return bool(library().delaunayflip_has_cuda_device())


def release_cuda_memory() -> None:
    """Frees the memory that the CUDA backend keeps between runs."""
    library().delaunayflip_release_cuda_memory()

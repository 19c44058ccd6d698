# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""libdelaunayflip by ctypes: delaunayflip_c.h in Python, and the engine's exceptions. If memory runs
out, MemoryError is raised."""
import ctypes
import functools
import pathlib
import sys
from ctypes import c_char_p, c_double, c_int32, c_int64, c_void_p

class FlipError(Exception):
    """Base class of the others."""


class InvalidMesh(FlipError, ValueError):
    """A triangle or constraint edge names a point that does not exist.

    Attributes:
        cell: The triangle, or the constraint edge.
        point: The id that it names.
        ring: The number of the ring that is at fault, outlines first; -1: none.
    """

    def __init__(self, message: str, cell: int = -1, point: int = -1, ring: int = -1) -> None:
        super().__init__(message)
        self.cell = cell
        self.point = point
        self.ring = ring


class InvalidOptions(FlipError, ValueError):
    """Options that are out of range, or contradict each other or the mesh."""


class MeshTooLarge(FlipError, ValueError):
    """More triangles or points than 32-bit indices can number."""


class Stopped(FlipError):
    """An observer stopped a call that cannot return a partial result."""


class BackendUnavailable(FlipError, RuntimeError):
    """The requested backend cannot run here."""


INTERFACE_VERSION = 1


def name_library(system):
    """The file of the library, for a value of sys.platform."""
    return {"win32": f"delaunayflip-{INTERFACE_VERSION}.dll",
            "darwin": f"libdelaunayflip.{INTERFACE_VERSION}.dylib",
            }.get(system, f"libdelaunayflip.so.{INTERFACE_VERSION}")


LIBRARY = name_library(sys.platform)

#: By NumPy's names.
TYPES = {"float32": 0, "float64": 1, "int32": 2, "int64": 3}
HOST, CUDA = 0, 1  # memories

#: In the order of the header, like the choices of _options.
STOP_REASONS = ("not started", "converged", "iteration limit", "aborted", "running")
DEFECT_KINDS = (
    "other", "points not finite", "repeated ids", "triangles without area", "turned from most",
    "duplicate triangles", "turned from above", "flat from above", "overlap from above",
    "turned by flips", "separate triangles", "constraints not edges", "constraints leave mesh",
    "constraints leave part", "constraints cross", "constraints meet overlap",
    "constraints need guard", "constraints on surface", "points repeated", "points too near",
    "segments cross", "segments not finite", "segments without triangles", "hole seeds outside",
    "rings without area", "rings repeated", "rings run again", "hole points outside",
    "points without triangles", "nothing left", "polygons too small", "constraints not in mesh",
    "points without heights", "region seeds outside", "triangles not refined", "point limit reached",
    "points inside", "points in one plane", "segments inside", "region seeds repeated",
    "options without goal", "triangles not judged", "segments removed")


def make_struct(name, members):
    """A struct of the header. `members`: (type, names) in its order."""
    fields = [(member, kind) for kind, names in members for member in names.split()]
    return type(name, (ctypes.Structure,), {"_fields_": fields})


Mesh = make_struct("Mesh", (
    (c_int64, "size"), (c_void_p, "points"), (c_int64, "number_of_points"), (c_void_p, "triangles"),
    (c_int64, "number_of_triangles"), (c_int32, "point_type id_type"), (c_void_p, "constraint_edges"),
    (c_int64, "number_of_constraint_edges"),
    (c_void_p, "constraints_to_insert regions frozen_triangles triangle_numbers"),
    (c_int32, "memory point_components"), (c_void_p, "stream sizes region_seeds"),
    (c_int64, "number_of_region_seeds")))

Polygons = make_struct("Polygons", (
    (c_int64, "size number_of_polygons"), (c_void_p, "offsets corners triangle_counts")))

Query = make_struct("Query", (
    (c_int64, "size"), (c_void_p, "places"), (c_int64, "number_of_places"),
    (c_int32, "place_type place_components"), (c_int64, "columns rows"),
    (c_double, "origin_x origin_y step_x step_y"), (c_void_p, "triangles values results"),
    (c_int32, "value_components method outside memory"), (c_void_p, "stream"),
    (c_int32, "degrees reserved")))

Iteration = make_struct("Iteration", (
    (c_int64, "iteration tested non_delaunay flipped excluded blocked"),
    (c_double, "minimum_angle seconds")))

Defect = make_struct("Defect", (
    (c_int32, "kind number_of_ids"), (c_int64, "count"), (c_void_p, "first_ids crossed"),
    (c_char_p, "text")))

ProgressFunction = ctypes.CFUNCTYPE(c_int32, c_double, c_void_p)
IterationFunction = ctypes.CFUNCTYPE(c_int32, ctypes.POINTER(Iteration), c_void_p)
Callbacks = make_struct("Callbacks", (
    (c_int64, "size"), (ProgressFunction, "progress"), (IterationFunction, "iteration"),
    (c_void_p, "user")))


@functools.lru_cache(maxsize=None)
def library():
    """The loaded library. It is in a folder of the package (a wheel, a build, or an editable
    installation, which has two), in the lib folder under which the package was installed, or where
    the system searches.

    Raises:
        ImportError: The library does not exist, or has another interface version.
    """
    package = pathlib.Path(__file__).resolve().parent
    folders = [pathlib.Path(folder) for folder in sys.modules[__package__].__path__]
    places = [folder / LIBRARY for folder in (*folders, *list(package.parents)[1:3])]
    loaded = ctypes.CDLL(str(next(filter(pathlib.Path.exists, places), LIBRARY)))
    if loaded.delaunayflip_interface_version() != INTERFACE_VERSION:
        raise ImportError(f"{loaded._name} has another interface than this Python package")
    for name in ("version", "error_message"):
        getattr(loaded, f"delaunayflip_{name}").restype = c_char_p
    for name in ("error_cell", "error_point", "error_ring", "count_defects", "count_triangles"):
        getattr(loaded, f"delaunayflip_{name}").restype = c_int64
    return loaded


@functools.lru_cache(maxsize=None)
def _find(name):
    return getattr(library(), f"delaunayflip_{name}")


def run(name, *arguments):
    """Calls delaunayflip_<name>. Structs are passed by their addresses, and numbers, which may be
    addresses, in 64 bits, of which a function may use the lower half."""
    return _find(name)(*[
        ctypes.byref(value) if isinstance(value, ctypes.Structure)
        else c_int64(value) if isinstance(value, int) else value for value in arguments])


_EXCEPTIONS = {2: InvalidOptions, 3: MeshTooLarge, 4: BackendUnavailable, 5: MemoryError,
               6: ValueError, 8: Stopped}


@functools.lru_cache(maxsize=None)
def _make_default(kind):
    struct = kind()
    run(f"{kind.__name__.lower()}_init_sized", struct, ctypes.sizeof(kind))
    return struct


def make(kind):
    """A struct with its size and the defaults."""
    return kind.from_buffer_copy(_make_default(kind))


def call(name, *arguments):
    """Calls run, and raises the exception that belongs to the status that it returns."""
    status = run(name, *arguments)
    if status == 0:
        return
    message = run("error_message").decode(errors="replace")
    if status == 1:
        raise InvalidMesh(message, run("error_cell"), run("error_point"), run("error_ring"))
    raise _EXCEPTIONS.get(status, FlipError)(message)


def version() -> str:
    """The release of the engine, e.g. "0.2.0"."""
    return run("version").decode()


def has_cuda_device() -> bool:
    """Whether there is a GPU that the engine can use."""
    return bool(run("has_cuda_device"))


def release_cuda_memory() -> None:
    """Frees the memory that the CUDA backend keeps between runs."""
    run("release_cuda_memory")

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of CuPy, PyTorch and Numba in the memory of a GPU, and of other libraries by DLPack."""
import ctypes
import importlib
import importlib.util
import sys

import numpy

from . import _arrays, _library
from ._arrays import address
from ._library import TYPES


# Each class has the functions of a library that the package needs; there are no objects of it.


class _CuPy:
    def as_contiguous(array):
        return importlib.import_module("cupy").ascontiguousarray(array)

    def make_empty(like, shape, dtype):
        with like.device:
            return importlib.import_module("cupy").empty(shape, dtype)

    def get_stream(array):
        with array.device:
            return importlib.import_module("cupy").cuda.get_current_stream().ptr

    def to_host(array):
        return array.get()


class _Torch:
    def as_contiguous(array):
        return array.detach().contiguous()

    def make_empty(like, shape, dtype):
        torch = importlib.import_module("torch")
        return torch.empty(shape, dtype=getattr(torch, dtype), device=like.device)

    def get_stream(array):
        return importlib.import_module("torch").cuda.current_stream(array.device).cuda_stream

    def to_host(array):
        return array.detach().cpu().numpy()


class _Numba:
    def as_contiguous(array):
        if not array.is_c_contiguous():
            raise ValueError("points, triangles and targets of Numba must be contiguous, row by row")
        return array

    def make_empty(like, shape, dtype):
        return importlib.import_module("numba.cuda").device_array(shape, dtype)

    def get_stream(array):
        return array.__cuda_array_interface__.get("stream") or 0

    def to_host(array):
        return array.copy_to_host()


_ADAPTERS = {"cupy": _CuPy, "torch": _Torch, "numba": _Numba}
_VIEWERS = ("cupy", "torch")  # can view arrays of other libraries
_DLPACK_MEMORIES = (2, 13)  # DLPack's numbers for CUDA's memory, and for managed memory


def _library_name(array):
    return type(array).__module__.partition(".")[0]


def _is_on_device(array):
    if _library_name(array) == "torch":
        return getattr(array, "is_cuda", False)
    if hasattr(array, "__cuda_array_interface__"):
        return True
    return hasattr(array, "__dlpack__") and array.__dlpack_device__()[0] in _DLPACK_MEMORIES


def _choose_library(arrays):
    """The name of the library of the first array that is of a known one; else of one that is here,
    if possible one that the process uses. `arrays`: by name."""
    libraries = {name: _library_name(array) for name, array in arrays.items()}
    for name, library in libraries.items():
        if library not in _ADAPTERS and not hasattr(arrays[name], "__dlpack__"):
            raise TypeError(f"{name} must be an array of CuPy, PyTorch or Numba, or have __dlpack__, "
                            f"not of {library}")
    known = [library for library in libraries.values() if library in _ADAPTERS]
    known += [library for library in _VIEWERS if library in sys.modules]
    for library in (*known, *_VIEWERS):
        if library in known or importlib.util.find_spec(library):
            return library
    raise TypeError("arrays of other libraries on a GPU need CuPy or PyTorch, one of which views them "
                    "without a copy, and makes the results")


def _view(name, array, library):
    """The array as one of the library: itself, or a view of its memory."""
    own = _library_name(array)
    if own == library:
        return array
    if library not in _VIEWERS or not hasattr(array, "__dlpack__"):
        raise TypeError(f"{name} must be an array of {library}, as the other array is, not of {own}; "
                        "cupy.asarray views both without a copy")
    return importlib.import_module(library).from_dlpack(array)


def _adapt(array):
    """The functions for an array on a device, and the array as they take it."""
    library = _choose_library({"the array": array})
    return _ADAPTERS[library], _view("the array", array, library)


def to_host(array):
    """The array, or None, in the host's memory: a copy if it is on a GPU."""
    if array is None or not _is_on_device(array):
        return array
    functions, array = _adapt(array)
    return functions.to_host(array)


def view_points(points):
    """The functions for points on a device, and the points as these take them; or None, and the
    points as they are."""
    if not _is_on_device(points):
        return None, points
    library, points = _adapt(points)
    points = library.as_contiguous(points)
    _check("points", points, ("float32", "float64"), (2, 3))
    return library, points


def make_mesh(points, triangles, *others):
    """The mesh in the memory of its points and triangles. `others`: the other arguments."""
    if not _is_on_device(points) and not _is_on_device(triangles):
        return _arrays.Mesh(points, triangles, *others)
    return Mesh(points, triangles, *(to_host(values) for values in others))


def expect(session, *arrays):
    """Tells a session which new arrays its results will be written to."""
    for array in arrays:
        if isinstance(array, numpy.ndarray):
            _library.call("expect", session, address(array), ctypes.c_int64(array.nbytes))


def store_triangles(session, target, count):
    """Writes the `count` triangles of a session to an array in any memory.

    Raises:
        TypeError: The target is no plain array of NumPy, and not on a GPU.
        ValueError: It is not a contiguous (m, 3) array of int32 or int64 that can be written.
    """
    is_on_device = _is_on_device(target)
    if not is_on_device and (
            not isinstance(target, numpy.ndarray) or isinstance(target, numpy.ma.MaskedArray)):
        raise TypeError(f"target must be an array of NumPy or on a GPU, not {type(target).__name__}")
    functions, target = _adapt(target) if is_on_device else (None, target)
    fits = tuple(target.shape) == (count, 3) and _can_be_written(target, functions)
    kind = type_of(target) if fits else None
    if kind not in ("int32", "int64"):
        raise ValueError(f"target must be a contiguous ({count}, 3) array of int32 or int64 in native "
                         "byte order that can be written")
    _store("store_triangles", session, target, functions, TYPES[kind])


def store_flip_counts(session, counts):
    """Writes the flip counts of a session to an array that make_flip_counts has made."""
    functions, counts = _adapt(counts) if _is_on_device(counts) else (None, counts)
    _store("store_flip_counts", session, counts, functions)


def _store(name, session, target, functions, *types):
    name, stream = (f"{name}_on_device", [functions.get_stream(target)]) if functions else (name, [])
    _library.call(name, session, address(target), *types, *stream)


class Mesh(_arrays.Mesh):
    """A mesh on a GPU as C struct, and its arrays, which live as long."""

    def make_triangles(self):
        return self._library.make_empty(self.triangles, self.triangles.shape, self._id_type)

    def make_flip_counts(self):
        return self._library.make_empty(self.triangles, self.triangles.shape[:1], "int32")

    def _take(self, points, triangles):
        for name, array in (("points", points), ("triangles", triangles)):
            if not _is_on_device(array):
                raise TypeError(f"{name} must be in the memory of the GPU, as the other array is")
        library = _choose_library({"triangles": triangles, "points": points})
        self._library = _ADAPTERS[library]
        self.points = self._library.as_contiguous(_view("points", points, library))
        self.triangles = self._library.as_contiguous(_view("triangles", triangles, library))
        point_type = _check("points", self.points, ("float32", "float64"), (3, 2))
        self._id_type = _check("triangles", self.triangles, ("int32", "int64"), (3,))
        self._set(point_type, self._id_type)
        self.struct.point_components = self.points.shape[1]
        self.struct.memory = _library.CUDA
        self.struct.stream = self._library.get_stream(self.triangles)


def _check(name, array, types, columns):
    """The name of the array's type, if it is one of these and the array has so many columns."""
    found = type_of(array)
    if found not in types:
        raise TypeError(f"{name} on a GPU must be {' or '.join(types)}, not {found}")
    if len(array.shape) != 2 or array.shape[1] not in columns:
        shapes = " or ".join(f"(n, {count})" for count in columns)
        raise ValueError(f"{name} must have the shape {shapes}, not {tuple(array.shape)}")
    return found


def type_of(array):
    """NumPy's name for the type of the array's values, if these are in native byte order."""
    kind = array.dtype
    if _is_on_device(array):
        kind = numpy.dtype(array.__cuda_array_interface__["typestr"])
    return kind.name if kind.isnative else kind.str


def _can_be_written(array, functions):
    """Whether it is contiguous, too. `functions`: those of the array's library, or None for one of
    NumPy."""
    if functions:
        is_read_only = array.__cuda_array_interface__["data"][1]
        return not is_read_only and address(functions.as_contiguous(array)) == address(array)
    return array.flags.carray

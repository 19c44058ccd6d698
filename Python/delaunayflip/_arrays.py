# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the caller's arrays and converts them for the engine; arrays that already fit are not
copied. What does not fit is a ValueError or TypeError that names the argument. Arrays of CuPy,
PyTorch and Numba in the memory of a GPU, and of other libraries by DLPack, stay there."""
import importlib
import importlib.util
import math
import sys

import numpy

from . import _library
from ._library import TYPES, InvalidMesh
from ._options import check_integer, shorten, show

_KNOWN_TYPES = {numpy.dtype(name): name for name in TYPES}
_FEWEST_EXPECTED = 1 << 16  # bytes of an array that a session is told of
_CONVERSION_ERRORS = (TypeError, ValueError, OverflowError, RuntimeError, BufferError)


class _HostArrays:
    """Arrays of NumPy."""

    def make_empty(self, like, shape, dtype):
        return numpy.empty(shape, dtype)

    def get_stream(self, array):
        return None

    def to_host(self, array):
        return array

    def copy_to_host(self, array, target):
        target[...] = array

    def can_be_written(self, array):
        return array.flags.carray

    def join(self, x, y):
        x, y = as_array("x", x), as_array("y", y)
        for name, values in (("x", x), ("y", y)):
            if values.dtype.kind not in "fiu":
                raise TypeError(f"{name} must be real numbers, not {values.dtype}")
        try:
            return numpy.stack(numpy.broadcast_arrays(x, y), axis=-1)
        except ValueError:
            raise ValueError(f"x of shape {x.shape} and y of shape {y.shape} do not fit together; for a grid "
                             "of their values give x[None, :] and y[:, None]") from None

    def as_doubles(self, name, values):
        values = as_array(name, values)
        if values.dtype.kind not in "fiu":
            raise TypeError(f"{name} must be real numbers, not {values.dtype}")
        return _convert(values, numpy.float64)


class _DeviceArrays:
    """Arrays of a library that has them in the memory of a GPU."""

    def take(self, name, array, types, columns):
        """The array, without gaps. Requires one of these types, and so many columns."""
        array = self.as_contiguous(array)
        kind = self.type_of(array)
        if kind not in types:
            raise TypeError(f"{name} on a GPU must be {' or '.join(types)}, not {kind}")
        if len(array.shape) != 2 or array.shape[1] not in columns:
            raise _shape_error(name, array, " or ".join(f"(n, {count})" for count in columns))
        return array

    def type_of(self, array):
        return type_of(array)

    def address(self, array):
        return address(array)

    def can_be_written(self, array):
        """Whether it is contiguous, too."""
        is_read_only = array.__cuda_array_interface__["data"][1]
        return not is_read_only and address(self.as_contiguous(array)) == address(array)


class _CupyArrays(_DeviceArrays):
    def as_contiguous(self, array):
        return array if array.flags.c_contiguous else importlib.import_module("cupy").ascontiguousarray(array)

    def type_of(self, array):
        return _KNOWN_TYPES.get(array.dtype) or type_of(array)

    def address(self, array):
        return array.data.ptr

    def as_doubles(self, _, values):
        return importlib.import_module("cupy").ascontiguousarray(values, dtype="float64")

    def join(self, x, y):
        cupy = importlib.import_module("cupy")
        return cupy.stack(cupy.broadcast_arrays(x, y), axis=-1)

    def from_host(self, array, like):
        with like.device:
            return importlib.import_module("cupy").asarray(array)

    def make_empty(self, like, shape, dtype):
        with like.device:
            return importlib.import_module("cupy").empty(shape, dtype)

    def get_stream(self, array):
        with array.device:
            return importlib.import_module("cupy").cuda.get_current_stream().ptr

    def to_host(self, array):
        return array.get()

    def copy_to_host(self, array, target):
        array.get(out=target)


class _TorchArrays(_DeviceArrays):
    def as_contiguous(self, array):
        return array.detach().contiguous()

    def as_doubles(self, _, values):
        return self.as_contiguous(values).double()

    def join(self, x, y):
        torch = importlib.import_module("torch")
        return torch.stack(torch.broadcast_tensors(x, y), dim=-1)

    def from_host(self, array, like):
        return importlib.import_module("torch").tensor(array, device=like.device)

    def make_empty(self, like, shape, dtype):
        torch = importlib.import_module("torch")
        return torch.empty(shape, dtype=getattr(torch, dtype), device=like.device)

    def get_stream(self, array):
        return importlib.import_module("torch").cuda.current_stream(array.device).cuda_stream

    def to_host(self, array):
        return array.detach().cpu().numpy()

    def copy_to_host(self, array, target):
        importlib.import_module("torch").from_numpy(target).copy_(array.detach())


class _NumbaArrays(_DeviceArrays):
    def as_contiguous(self, array):
        if not array.is_c_contiguous():
            raise ValueError("points, triangles and targets of Numba must be contiguous, row by row")
        return array

    def as_doubles(self, name, values):
        if type_of(values) != "float64":
            raise TypeError(f"{name} of Numba must be float64, not {type_of(values)}")
        return self.as_contiguous(values)

    def join(self, x, y):
        raise TypeError("places of Numba must be one array, not two")

    def from_host(self, array, like):
        return importlib.import_module("numba.cuda").to_device(array)

    def make_empty(self, like, shape, dtype):
        return importlib.import_module("numba.cuda").device_array(shape, dtype)

    def get_stream(self, array):
        return array.__cuda_array_interface__.get("stream") or 0

    def to_host(self, array):
        return array.copy_to_host()

    def copy_to_host(self, array, target):
        array.copy_to_host(target)


_HOST = _HostArrays()
_ADAPTERS = {"cupy": _CupyArrays(), "torch": _TorchArrays(), "numba": _NumbaArrays()}
_VIEWERS = ("cupy", "torch")  # can view arrays of other libraries
_DLPACK_MEMORIES = (2, 13)  # DLPack's numbers for CUDA's memory, and for managed memory


def _library_name(array):
    return type(array).__module__.partition(".")[0]


def _is_on_device(array):
    if isinstance(array, numpy.ndarray):
        return False
    library = _library_name(array)
    if library == "torch":
        return getattr(array, "is_cuda", False)
    # CuPy makes the interface when it is read, which takes a while. Others raise AttributeError then if the
    # array is not on a GPU.
    asked = type(array) if library == "cupy" else array
    if hasattr(asked, "__cuda_array_interface__"):
        return True
    return hasattr(array, "__dlpack__") and array.__dlpack_device__()[0] in _DLPACK_MEMORIES


def _choose_library(*arrays):
    """The name of the library of the first array that is of a known one; else of one that is here,
    if possible one that the process uses."""
    known = [library for library in map(_library_name, arrays) if library in _ADAPTERS]
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
        raise TypeError(f"{name} must be an array of {library}, as the other array is, or have "
                        f"__dlpack__, not of {own}; cupy.asarray views all without a copy")
    return importlib.import_module(library).from_dlpack(array)


def _adapt(array):
    """The adapter for an array, and the array as it takes it."""
    if not _is_on_device(array):
        return _HOST, array
    library = _choose_library(array)
    return _ADAPTERS[library], _view("the array", array, library)


def to_host(array):
    """The array, or None, in the host's memory: a copy if it is on a GPU."""
    adapter, array = _adapt(array)
    return adapter.to_host(array)


def copy_to_host(array, target):
    """Copies an array to a contiguous one of NumPy, of the same shape and type."""
    adapter, array = _adapt(array)
    adapter.copy_to_host(array, target)


def make_empty(like, shape, dtype):
    """A new array in the memory of another one, of its library."""
    return _adapt(like)[0].make_empty(like, shape, dtype)


def find_memory(array):
    """Where an array is, and the stream that orders it, for the engine."""
    adapter, array = _adapt(array)
    memory = _library.HOST if adapter is _HOST else _library.CUDA
    return memory, adapter.get_stream(array)


def describe(array):
    """Where a contiguous array begins, its type as a number of TYPES, its memory and the stream."""
    adapter, array = _adapt(array)
    if adapter is _HOST:
        return address(array), TYPES[type_of(array)], _library.HOST, None
    return adapter.address(array), TYPES[adapter.type_of(array)], _library.CUDA, adapter.get_stream(array)


def move(array, like):
    """The array in the memory of another one, for its library."""
    adapter, like = _adapt(like)
    own, array = _adapt(array)
    if adapter is own:
        return array
    if adapter is _HOST:
        return own.to_host(array)
    if own is _HOST:
        return adapter.from_host(array, like)
    return _view("values", array, _library_name(like))


def put(results, triangles, values):
    """Writes values, a number or an array like the results, where places are in no triangle."""
    if _library_name(results) == "numba":
        raise TypeError("arrays of Numba take no fill_value and no soft breaklines; cupy.asarray views "
                        "them without a copy")
    where = triangles < 0
    results[where] = values[where] if hasattr(values, "shape") else values


def address(array):
    """Where an array of NumPy, or one on a GPU, begins; 0 if it is empty."""
    if isinstance(array, numpy.ndarray):
        return array.__array_interface__["data"][0] if array.size else 0
    return array.__cuda_array_interface__["data"][0]


def type_of(array):
    """NumPy's name for the type of the array's values, if these are in native byte order."""
    kind = array.dtype
    if isinstance(array, numpy.ndarray) and kind in _KNOWN_TYPES:
        return _KNOWN_TYPES[kind]
    if _is_on_device(array):
        kind = numpy.dtype(array.__cuda_array_interface__["typestr"])
    return kind.name if kind.isnative else kind.str


def _shape_error(name, array, wanted):
    if isinstance(array, numpy.ndarray) and array.ndim == 0 and array.dtype.kind not in "biufc":
        given = type(array.item()).__name__  # such as a set or a generator, of which NumPy makes one object
        return TypeError(f"{name} must be an array, or a list of numbers, not {given}")
    return ValueError(f"{name} must have the shape {wanted}, not {tuple(array.shape)}")


def as_array(name, values):
    """What NumPy makes of the values; by DLPack, in their memory, what it cannot convert itself."""
    if type(values) is numpy.ndarray:
        return values
    if numpy.ma.is_masked(values):
        raise ValueError(f"{name} has masked values: fill them or leave them out")
    try:
        if hasattr(values, "__dlpack__") and not hasattr(values, "__array__"):
            return numpy.from_dlpack(values)
        return numpy.asarray(values)
    except _CONVERSION_ERRORS as error:
        kind = ValueError if isinstance(error, (ValueError, OverflowError)) else TypeError
        raise kind(f"{name} cannot be made an array: {shorten(str(error))}") from error


def read_table(name, values):
    """An array of NumPy of what it can make one, such as a table of another library. The items of tables may
    be columns. Lists, and arrays on a GPU, stay as they are."""
    if _is_on_device(values) or not (hasattr(values, "__array__") or isinstance(values, memoryview)):
        return values
    return as_array(name, values)


def _choose_type(array, *kinds):
    """The array's type in native byte order if it is one of these, else the last of them."""
    native = array.dtype if array.dtype.isnative else array.dtype.newbyteorder("=")
    return native if native in kinds else numpy.dtype(kinds[-1])


def _convert(array, kind):
    """The values as the engine reads them: row by row without gaps, aligned, in native byte order."""
    flags = array.flags
    if array.dtype == kind and array.dtype.isnative and flags.c_contiguous and flags.aligned:
        return array
    return numpy.require(array, kind, "CA")


def as_plane(points, name="points"):
    """Points of shape (n, 2) or (n, 3), float32 or float64; other numbers become float64. Those on a
    device stay there."""
    adapter, points = _adapt(points)
    if adapter is not _HOST:
        return adapter.take(name, points, ("float32", "float64"), (3, 2))
    points = as_array(name, points)
    if points.size == 0 and points.ndim < 2:
        points = numpy.empty((0, 3))
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise _shape_error(name, points, "(n, 3) or (n, 2)")
    if points.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be real numbers, not {points.dtype}")
    return _convert(points, _choose_type(points, numpy.float32, numpy.float64))


def as_places(places):
    """Places of shape (..., 2) or (..., 3) in two dimensions, as as_plane has points, and the shape of
    values at them, one each."""
    is_list_of_two = isinstance(places, (list, tuple)) and len(places) == 2
    adapter, places = _adapt(places)
    if adapter is _HOST:
        places = as_array("places", places)
    shape = tuple(places.shape)
    if is_list_of_two and len(shape) >= 2 and shape[-1] == 3:
        raise ValueError("places may be those of x, y and z, or two arrays, of x and of y: give the latter as "
                         f"two arguments, x and y, and the former as an array of shape {shape}")
    if shape in ((0,), (2,)):
        shape = (shape[0] // 2, 2)  # as in SciPy
    if len(shape) < 2 or shape[-1] not in (2, 3):
        raise _shape_error("places", places, "(..., 2) or (..., 3)")
    return as_plane(places.reshape((math.prod(shape[:-1]), shape[-1])), "places"), shape[:-1]


def join_columns(x, y):
    """Places from their coordinates, which are broadcast."""
    are_on_device = [_is_on_device(x), _is_on_device(y)]
    if not any(are_on_device):
        return _HOST.join(x, y)
    if not all(are_on_device):
        raise TypeError("x and y must both be in the memory of the GPU")
    library = _choose_library(x, y)
    return _ADAPTERS[library].join(_view("x", x, library), _view("y", y, library))


def as_values(values, name="values"):
    """Values of points in two dimensions, float64, and the shape of those of a point."""
    adapter, values = _adapt(values)
    if "complex" in str(getattr(values, "dtype", "")):  # of which libraries drop the imaginary part
        raise TypeError(f"{name} must be real numbers, not {values.dtype}")
    values = adapter.as_doubles(name, values)
    shape = tuple(values.shape)
    if len(shape) == 0 or 0 in shape[1:]:
        raise _shape_error(name, values, "(n,) or (n, ...), a row per point")
    return values.reshape((shape[0], math.prod(shape[1:]))), shape[1:]


def as_points(points):
    """Points as an array of shape (n, 3): (n, 2) gets z = 0."""
    points = as_plane(points)
    if points.shape[1] == 3:
        return points
    spatial = numpy.zeros((len(points), 3), dtype=points.dtype)
    spatial[:, :2] = points
    return spatial


def as_ids(name, ids, columns):
    """Ids of shape (m, columns), int32 or int64; other integers become int64."""
    ids = as_array(name, ids)
    kind = _choose_type(ids, numpy.int32, numpy.int64)
    if ids.size == 0 and (ids.ndim < 2 or ids.shape == (0, columns)):
        ids = numpy.empty((0, columns), dtype=kind)
    if ids.ndim != 2 or ids.shape[1] != columns:
        raise _shape_error(name, ids, f"(m, {columns})")
    if ids.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {ids.dtype}")
    large = numpy.argwhere(ids > numpy.iinfo(numpy.int64).max) if ids.dtype.kind == "u" else ()
    if len(large):
        row, column = large[0].tolist()
        raise InvalidMesh(f"{name}: row {row} names point {ids[row, column]}, which no mesh has",
                          row, int(ids[row, column]))
    return _convert(ids, kind)


def _per_triangle(name, values, kind, count):
    values = as_array(name, values)
    if values.shape != (count,):
        raise _shape_error(name, values, f"({count},), a value per triangle")
    if values.dtype.kind not in "iub" and count:
        raise TypeError(f"{name} must be integers, not {values.dtype}")
    converted = _convert(values, kind)
    if not numpy.array_equal(converted, values):
        raise ValueError(f"{name} must fit {numpy.dtype(kind)}")
    return converted


def as_flags(name, values, *shapes):
    """True or false, or numbers that are 0 or not, of one of these shapes."""
    values = as_array(name, values)
    if values.shape not in shapes:
        raise _shape_error(name, values, " or ".join(map(str, shapes)))
    if values.dtype.kind not in "biuf":
        example = values.ravel()[:1].tolist() or [str(values.dtype)]
        raise TypeError(f"{name} must be true or false, not {show(example[0])}")
    if numpy.isnan(values).any():
        raise ValueError(f"{name} must be true or false, not NaN")
    return values != 0


#: delaunayflip_region.
_REGION = numpy.dtype([("x", "f8"), ("y", "f8"), ("label", "i4"), ("maximum_area", "f8")], align=True)


def as_regions(name, regions):
    """Region seeds, as `triangulate` and `flip` get them, as an array of delaunayflip_region."""
    regions = read_table(name, regions)
    is_list = hasattr(regions, "__len__") and getattr(regions, "shape", None) != ()
    if not is_list or isinstance(regions, (str, bytes, dict)):
        raise TypeError(f"{name} must be a list of (x, y, label) or (x, y, label, area), not {show(regions)}")
    made = numpy.zeros(len(regions), _REGION)
    for number, row in enumerate(regions):
        row = read_table(f"region {number}", row)
        region = as_array(f"region {number}", row)
        if region.shape not in ((3,), (4,)) or region.dtype.kind not in "fiu":
            raise ValueError(f"region {number} must be (x, y, label) or (x, y, label, area), not {show(row)}")
        label = row[2].item() if hasattr(row[2], "item") else row[2]
        if isinstance(label, float) and label.is_integer():
            label = int(label)  # of an array of floats
        label = check_integer(f"the label of region {number}", label, -2**31, 2**31 - 1)
        made[number] = (*region[:2], label, region[3] if len(region) == 4 else 0.0)
    return made


class Mesh:
    """A mesh as C struct, and its arrays, which live as long. Points and triangles are in one memory,
    that of the host or of a GPU."""

    def __init__(self, points, triangles, constraints=None, regions=None, frozen=None,
                 insert_constraints=True, triangle_numbers=None, size=None, region_seeds=()):
        self.struct, self._kept = _library.make(_library.Mesh), []
        if _is_on_device(points) or _is_on_device(triangles):
            self._take_from_device(points, triangles)
        else:
            self.points, self.triangles = as_points(points), as_ids("triangles", triangles, 3)
        struct = self.struct
        struct.points, struct.number_of_points = address(self.points), self.points.shape[0]
        struct.triangles, struct.number_of_triangles = address(self.triangles), self.triangles.shape[0]
        struct.point_type, struct.id_type = TYPES[type_of(self.points)], TYPES[type_of(self.triangles)]
        struct.memory, struct.stream = find_memory(self.triangles)
        struct.point_components = self.points.shape[1]
        if constraints is not None or insert_constraints is not True:
            self._take_constraints(to_host(constraints), to_host(insert_constraints))
        regions, frozen, triangle_numbers = map(to_host, (regions, frozen, triangle_numbers))
        count = struct.number_of_triangles
        if regions is not None:
            self._keep("regions", _per_triangle("regions", regions, numpy.int32, count))
        if frozen is not None:
            self._keep("frozen_triangles", as_flags("frozen", frozen, (count,)).astype(numpy.uint8))
        if triangle_numbers is not None:
            self._keep("triangle_numbers",
                       _per_triangle("triangle_numbers", triangle_numbers, numpy.int64, count))
        if size is not None:
            self._take_sizes(to_host(size))
        self.region_seeds = as_regions("region_seeds", region_seeds)
        if len(self.region_seeds):
            self._keep("region_seeds", self.region_seeds)
            struct.number_of_region_seeds = len(self.region_seeds)

    @property
    def has_goals(self):
        """Whether sizes of points or areas of regions ask for refinement."""
        return bool(self.struct.sizes) or bool((self.region_seeds["maximum_area"] > 0.0).any())

    def _keep(self, member, array):
        """Sets a pointer of the struct to an array, which lives as long."""
        self._kept.append(array)
        setattr(self.struct, member, address(array))

    def _take_constraints(self, constraints, insert_constraints):
        edges = as_ids("constraints", [] if constraints is None else constraints, 2)
        flags = as_flags("insert_constraints", insert_constraints, (), (len(edges),))
        self.struct.number_of_constraint_edges = len(edges)
        self._keep("constraint_edges", _convert(edges, numpy.int64))
        self._keep("constraints_to_insert", numpy.full(len(edges), flags, dtype=numpy.uint8))

    def _take_sizes(self, size):
        values, shape = as_values(size, "size")
        if shape or len(values) != self.struct.number_of_points:
            raise ValueError(f"size must have one number for each of the {self.struct.number_of_points} points, "
                             f"not the shape {tuple(numpy.shape(size))}")
        self._keep("sizes", values)

    def make_triangles(self, count=None):
        """An empty array for the triangles, by default as many as are given."""
        count = self.struct.number_of_triangles if count is None else count
        return make_empty(self.triangles, (count, 3), type_of(self.triangles))

    def make_flip_counts(self, count=None):
        """Room for a number per triangle."""
        count = self.struct.number_of_triangles if count is None else count
        return make_empty(self.triangles, (count,), "int32")

    def read_sources(self, session, count):
        """For each of `count` triangles its source: see Result.sources."""
        sources = numpy.empty(count, dtype=numpy.int32)
        _library.call("store_sources", session, address(sources))
        return sources

    def read_regions(self, session, count):
        """For each of `count` triangles the label of its region: see Result.regions."""
        labels = numpy.empty(count, dtype=numpy.int32)
        _library.call("store_regions", session, address(labels))
        return labels

    def read_points(self, session, count):
        """The points, followed by the `count` points that refinement has added; and for each of these the
        ids of three points between which it lies, the last one perhaps -1, and their weights."""
        xyz, weights = numpy.empty((count, 3)), numpy.empty((count, 3))
        ids = numpy.empty((count, 3), dtype=numpy.int64)
        _library.call("store_refined_points", session, address(xyz), address(ids), address(weights))
        if count == 0:
            return self.points, ids, weights
        given = to_host(self.points)
        added = xyz[:, :given.shape[1]].astype(given.dtype)
        return move(numpy.concatenate([given, added]), self.points), ids, weights

    def _take_from_device(self, points, triangles):
        for name, array in (("points", points), ("triangles", triangles)):
            if not _is_on_device(array):
                raise TypeError(f"{name} must be in the memory of the GPU, as the other array is")
        library = _choose_library(triangles, points)
        self.points = as_plane(_view("points", points, library))
        self.triangles = _ADAPTERS[library].take(
            "triangles", _view("triangles", triangles, library), ("int32", "int64"), (3,))


def expect(session, *arrays):
    """Tells a session which new arrays its results will be written to."""
    for array in arrays:
        if isinstance(array, numpy.ndarray) and array.nbytes >= _FEWEST_EXPECTED:
            _library.call("expect", session, address(array), array.nbytes)


def store(name, session, target, *types):
    """Writes what a function of the engine stores to an array that fits."""
    adapter, target = _adapt(target)
    way, stream = ("", ()) if adapter is _HOST else ("_on_device", (adapter.get_stream(target),))
    _library.call(f"store_{name}{way}", session, address(target), *types, *stream)


def store_triangles(session, target, count):
    """Writes the `count` triangles of a session to an array in any memory.

    Raises:
        TypeError: The target is no plain array of NumPy, and not on a GPU.
        ValueError: It is not a contiguous (m, 3) array of int32 or int64 that can be written.
    """
    adapter, target = _adapt(target)
    if adapter is _HOST and (
            not isinstance(target, numpy.ndarray) or isinstance(target, numpy.ma.MaskedArray)):
        raise TypeError(f"target must be an array of NumPy or on a GPU, not {type(target).__name__}")
    fits = tuple(target.shape) == (count, 3) and adapter.can_be_written(target)
    kind = type_of(target) if fits else None
    if kind not in ("int32", "int64"):
        raise ValueError(f"target must be a contiguous ({count}, 3) array of int32 or int64 in native "
                         "byte order that can be written")
    store("triangles", session, target, TYPES[kind])

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the caller's arrays and converts them for the engine; arrays that already fit are not
copied. What does not fit is a ValueError or TypeError that names the argument."""
import numpy

from . import _library
from ._library import TYPES, InvalidMesh

_CONVERSION_ERRORS = (TypeError, ValueError, OverflowError, RuntimeError, BufferError)


def _shape_error(name, array, wanted):
    return ValueError(f"{name} must have the shape {wanted}, not {array.shape}")


def _as_array(name, values):
    """What NumPy makes of the values; by DLPack, in their memory, what it cannot convert itself."""
    if numpy.ma.is_masked(values):
        raise ValueError(f"{name} has masked values: fill them or leave them out")
    try:
        if hasattr(values, "__dlpack__") and not hasattr(values, "__array__"):
            return numpy.from_dlpack(values)
        return numpy.asarray(values)
    except _CONVERSION_ERRORS as error:
        kind = ValueError if isinstance(error, (ValueError, OverflowError)) else TypeError
        raise kind(f"{name} cannot be made an array: {error}") from error


def _choose_type(array, *kinds):
    """The array's type in native byte order if it is one of these, else the last of them."""
    native = array.dtype if array.dtype.isnative else array.dtype.newbyteorder("=")
    return native if native in kinds else numpy.dtype(kinds[-1])


def _convert(array, kind):
    """The values as the engine reads them: row by row without gaps, aligned, in native byte order."""
    return numpy.require(array, kind, "CA")


def as_plane(points):
    """Points of shape (n, 2) or (n, 3), float32 or float64; other numbers become float64."""
    points = _as_array("points", points)
    if points.size == 0 and points.ndim < 2:
        points = numpy.empty((0, 3))
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise _shape_error("points", points, "(n, 3) or (n, 2)")
    if points.dtype.kind not in "fiu":
        raise TypeError(f"points must be real numbers, not {points.dtype}")
    return _convert(points, _choose_type(points, numpy.float32, numpy.float64))


def as_points(points):
    """The same of shape (n, 3): (n, 2) gets z = 0."""
    points = as_plane(points)
    kind = points.dtype
    if points.shape[1] == 2:
        flat, points = points, numpy.zeros((len(points), 3), dtype=kind)
        points[:, :2] = flat
    return _convert(points, kind)


def as_ids(name, ids, columns):
    """Ids of shape (m, columns), int32 or int64; other integers become int64."""
    ids = _as_array(name, ids)
    kind = _choose_type(ids, numpy.int32, numpy.int64)
    if ids.size == 0 and (ids.ndim < 2 or ids.shape == (0, columns)):
        ids = numpy.empty((0, columns), dtype=kind)
    if ids.ndim != 2 or ids.shape[1] != columns:
        raise _shape_error(name, ids, f"(m, {columns})")
    if ids.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {ids.dtype}")
    if ids.dtype.kind == "u":
        large = numpy.argwhere(ids > numpy.iinfo(numpy.int64).max)
        if len(large):
            row, column = large[0].tolist()
            raise InvalidMesh(f"{name}: row {row} names point {ids[row, column]}, which no mesh has",
                              row, int(ids[row, column]))
    return _convert(ids, kind)


def _per_triangle(name, values, kind, count):
    values = _as_array(name, values)
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
    values = _as_array(name, values)
    if values.shape not in shapes:
        raise _shape_error(name, values, " or ".join(map(str, shapes)))
    if values.dtype.kind not in "biuf":
        example = values.ravel()[:1].tolist() or [str(values.dtype)]
        raise TypeError(f"{name} must be true or false, not {example[0]!r}")
    if numpy.isnan(values).any():
        raise ValueError(f"{name} must be true or false, not NaN")
    return values != 0


class Mesh:
    """A mesh as C struct, and its arrays, which live as long."""

    def __init__(self, points, triangles, constraints=None, regions=None, frozen=None,
                 insert_constraints=True, triangle_numbers=None):
        self.struct, self._kept = _library.make(_library.Mesh), []
        self._take(points, triangles)
        edges = as_ids("constraints", [] if constraints is None else constraints, 2)
        flags = as_flags("insert_constraints", insert_constraints, (), (len(edges),))
        if constraints is not None:
            self.struct.number_of_constraint_edges = len(edges)
            self._keep("constraint_edges", _convert(edges, numpy.int64))
            self._keep("constraints_to_insert", numpy.full(len(edges), flags, dtype=numpy.uint8))
        count = self.struct.number_of_triangles
        for name, ids in (("triangles", self.triangles), ("constraints", edges)):
            if len(ids) and self.struct.number_of_points == 0:
                raise InvalidMesh(f"{name} name points, but there are no points", 0, int(ids[0, 0]))
        if regions is not None:
            self._keep("regions", _per_triangle("regions", regions, numpy.int32, count))
        if frozen is not None:
            self._keep("frozen_triangles", as_flags("frozen", frozen, (count,)).astype(numpy.uint8))
        if triangle_numbers is not None:
            self._keep("triangle_numbers",
                       _per_triangle("triangle_numbers", triangle_numbers, numpy.int64, count))

    def _keep(self, member, array):
        """Sets a pointer of the struct to an array, which lives as long."""
        self._kept.append(array)
        setattr(self.struct, member, address(array))

    def make_triangles(self):
        """Room for the triangles."""
        return numpy.empty_like(self.triangles)

    def make_flip_counts(self):
        """Room for a number per triangle."""
        return numpy.empty(len(self.triangles), dtype=numpy.int32)

    def _take(self, points, triangles):
        self.points = as_points(points)
        self.triangles = as_ids("triangles", triangles, 3)
        self._set(self.points.dtype.name, self.triangles.dtype.name)

    def _set(self, point_type, id_type):
        struct = self.struct
        struct.points, struct.number_of_points = address(self.points), self.points.shape[0]
        struct.triangles, struct.number_of_triangles = address(self.triangles), self.triangles.shape[0]
        struct.point_type, struct.id_type = TYPES[point_type], TYPES[id_type]


def address(array):
    """Of an array of NumPy, or of one on a GPU."""
    if isinstance(array, numpy.ndarray):
        return array.ctypes.data
    return array.__cuda_array_interface__["data"][0]

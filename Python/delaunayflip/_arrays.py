# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts the caller's arrays for the engine; arrays that already fit are not copied."""
import numpy

from . import _library


def _shape_error(name, array, wanted):
    return ValueError(f"{name} must have the shape {wanted}, not {array.shape}")


def _as_array(values):
    """What NumPy makes of the values; by DLPack, in their memory, what it cannot convert itself."""
    if hasattr(values, "__dlpack__") and not hasattr(values, "__array__"):
        return numpy.from_dlpack(values)
    return numpy.asarray(values)


def as_points(points):
    """Points of shape (n, 3), float32 or float64. (n, 2) gets z = 0; other numbers become float64."""
    points = _as_array(points)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise _shape_error("points", points, "(n, 3) or (n, 2)")
    if points.dtype.kind not in "fiu":
        raise TypeError(f"points must be real numbers, not {points.dtype}")
    kind = points.dtype if points.dtype in (numpy.float32, numpy.float64) else numpy.float64
    if points.shape[1] == 2:
        return numpy.column_stack([points, numpy.zeros(len(points))]).astype(kind, copy=False)
    return numpy.ascontiguousarray(points, dtype=kind)


def as_ids(name, ids, columns):
    """Ids of shape (m, columns), int32 or int64; other integers become int64."""
    ids = _as_array(ids)
    if ids.size == 0 and ids.ndim < 2:
        ids = numpy.empty((0, columns), dtype=numpy.int64)
    if ids.ndim != 2 or ids.shape[1] != columns:
        raise _shape_error(name, ids, f"(m, {columns})")
    if ids.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {ids.dtype}")
    kind = ids.dtype if ids.dtype in (numpy.int32, numpy.int64) else numpy.int64
    return numpy.ascontiguousarray(ids, dtype=kind)


def _per_triangle(name, values, kind, count):
    values = _as_array(values)
    if values.shape != (count,):
        raise _shape_error(name, values, f"({count},), a value per triangle")
    if values.dtype.kind not in "iub":
        raise TypeError(f"{name} must be integers, not {values.dtype}")
    converted = numpy.ascontiguousarray(values, dtype=kind)
    if not numpy.array_equal(converted, values):
        raise ValueError(f"{name} must fit {numpy.dtype(kind)}")
    return converted


class Mesh:
    """A mesh as C struct, and its arrays, which live as long."""

    def __init__(self, points, triangles, constraints=None, regions=None, frozen=None,
                 insert_constraints=True, triangle_numbers=None):
        self.struct = _library.Mesh()
        _library.library().delaunayflip_mesh_init(self.struct)
        self._take(points, triangles)
        if constraints is not None:
            self.constraints = as_ids("constraints", constraints, 2).astype(numpy.int64, copy=False)
            self.struct.constraint_edges = address(self.constraints)
            self.struct.number_of_constraint_edges = len(self.constraints)
            flags = _as_array(insert_constraints)
            if flags.ndim == 1 and len(flags) != len(self.constraints):
                raise _shape_error("insert_constraints", flags, f"({len(self.constraints)},)")
            self.to_insert = numpy.full(len(self.constraints), flags != 0, dtype=numpy.uint8)
            self.struct.constraints_to_insert = address(self.to_insert)
        if regions is not None:
            self.regions = _per_triangle("regions", regions, numpy.int32, len(self.triangles))
            self.struct.regions = address(self.regions)
        if frozen is not None:
            flags = _as_array(frozen) != 0
            self.frozen = _per_triangle("frozen", flags, numpy.uint8, len(self.triangles))
            self.struct.frozen_triangles = address(self.frozen)

        if triangle_numbers is not None:
            self.numbers = _per_triangle(
                "triangle_numbers", triangle_numbers, numpy.int64, len(self.triangles))
            self.struct.triangle_numbers = address(self.numbers)

    def make_triangles(self):
        """Room for the triangles."""
        return numpy.empty_like(self.triangles)

    def make_flip_counts(self):
        """Room for a number per triangle."""
        return numpy.empty(len(self.triangles), dtype=numpy.int32)

    def _take(self, points, triangles):
        self.points = as_points(points)
        self.triangles = as_ids("triangles", triangles, 3)
        self._set("points", self.points)
        self._set("triangles", self.triangles)
        is_single = self.points.dtype == numpy.float32
        self.struct.point_type = _library.FLOAT32 if is_single else _library.FLOAT64
        self.struct.id_type = id_type(self.triangles)

    def _set(self, name, array):
        setattr(self.struct, name, address(array))
        setattr(self.struct, f"number_of_{name}", len(array))


def address(array):
    return array.ctypes.data


def id_type(array):
    return _library.INT32 if array.dtype == numpy.int32 else _library.INT64

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The lines of segments and the rings of outlines and holes: what callers give, as lists of arrays."""
import typing

import numpy

from . import _arrays
from ._options import Numbers, show

RingRule = typing.Literal["evenodd", "nonzero", "orientation"]
RING_RULES = typing.get_args(RingRule)
Rings = typing.Union[Numbers, typing.Sequence[Numbers]]  # one ring, or a list of rings


def list_rings(name, given):
    """Arrays of the rings of an argument: one ring, or a list of rings. A ring has point ids, (k,), or
    coordinates, (k, 2) or (k, 3).

    Raises:
        TypeError, ValueError: It is neither. The message names the argument.
    """
    if given is None:
        return []
    given = _arrays.read_table(name, given)
    _require_list(name, given)
    if len(given) == 0:
        return []
    if _is_ring(name, given):
        return [_read_ring(name, given)]
    return [_read_ring(f"ring {number} of {name}", ring) for number, ring in enumerate(given)]


def list_lines(given):
    """Arrays of the lines of `segments`, (k, 2) or (k, 3), if it is a list of lines by coordinates; else
    an empty list."""
    given = _arrays.read_table("segments", given)
    if hasattr(given, "shape") and hasattr(given, "dtype"):
        dimensions, kind = len(given.shape), str(given.dtype)
        if 0 in given.shape:
            return []
    elif isinstance(given, (list, tuple)):
        items = (_arrays.as_array("segments", item) for item in given)
        first = next((item for item in items if item.size), numpy.empty((0, 2)))  # the others may be empty lines
        dimensions, kind = 1 + first.ndim, str(first.dtype)
    else:
        return []
    if dimensions == 2 and "float" in kind:
        raise TypeError("segments must be pairs of point ids, or a list of lines of coordinates; put a single "
                        "line into a list: [line]")
    if dimensions != 3:
        return []
    return [_arrays.to_host(_arrays.as_plane(line, f"line {number} of segments"))
            for number, line in enumerate(given)]


def _require_list(name, given):
    is_single = getattr(given, "shape", None) == ()  # such as an array without dimensions, which has no length
    is_list = hasattr(given, "__len__") and hasattr(given, "__getitem__") and not is_single
    if not is_list or isinstance(given, (str, bytes, dict)):
        raise TypeError(f"{name} must be a list of point ids, an array of coordinates or a list of such "
                        f"rings, not {show(given) if is_single else type(given).__name__}")


def _is_ring(name, given):
    if hasattr(given, "dtype") and hasattr(given, "shape"):
        shapes, kinds = {tuple(given.shape[1:])}, {numpy.dtype(given.dtype).kind}
    else:
        items = [_arrays.as_array(name, item) for item in given]
        shapes, kinds = {item.shape for item in items}, {item.dtype.kind for item in items}
    are_spatial = shapes == {(3,)} and "f" in kinds
    if shapes == {(3,)} and not are_spatial and len(given) > 2:
        _require_ids(name, given)
    if shapes == {(2,)} and kinds <= set("iu") and len(given) < 3:
        raise ValueError(f"{name}: rows of two integers are the coordinates of one ring, but a ring has at least "
                         "three points; if they are rings of point ids, each needs three ids")
    return shapes in ({()}, {(2,)}) or are_spatial


def _require_ids(name, rows):
    """Raises ValueError if a row of three integers, which is a ring of ids, names an id twice."""
    ids = numpy.sort(_arrays.as_array(name, rows), axis=1)
    if (ids[:, 1:] == ids[:, :-1]).any():
        raise ValueError(f"{name}: rows of three integers are rings of point ids, but some of these rows name "
                         "a point twice; if they are coordinates, give them as floats")


def _read_ring(name, ring):
    _require_list(name, ring)
    ring = _arrays.as_array(name, ring)
    if ring.ndim == 1:
        return _arrays.as_ids(name, numpy.stack([ring, ring], axis=1), 2)[:, 0]
    ring = _arrays.as_plane(ring, name)
    is_closed = len(ring) > 1 and numpy.array_equal(ring[0], ring[-1])
    return ring[:-1] if is_closed else ring

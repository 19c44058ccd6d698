# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay triangulations of LAS and LAZ files, by laspy."""
import inspect
import numbers
import operator
import os
import typing
import warnings

import laspy
import numpy

from ._options import show
from ._points import Triangulation, run_points
from ._points import triangulate as _triangulate

#: Points that a call reads at once.
CHUNK = 1 << 22


def triangulate(
    file: "typing.Union[str, os.PathLike[str], typing.BinaryIO, laspy.LasData]", *,
    classes: "typing.Union[None, int, typing.Iterable[int]]" = None, **options: typing.Any,
) -> Triangulation:
    """The Delaunay triangulation of the points of a LAS or LAZ file in x and y.

    Points that their scanner or an operator has marked as withheld are left out. Only the points of
    the chosen classes are kept in memory.

    Args:
        file: A path, an open binary file, or what laspy.read returns. A .laz needs lazrs or laszip,
            which `pip install "delaunayflip[lidar]"` installs.
        classes: The numbers of the classes to use, such as [2] for the ground, or one number; None: all.
        **options: Those of delaunayflip.triangulate.

    Returns:
        The `Triangulation`; its points are x, y and z as float64, scaled as the file says.

    Raises:
        ValueError: The file has no point of these classes.
        laspy.LaspyException: It is no such file, or there is no library that decompresses it.
        The exceptions of delaunayflip.triangulate.

    Example:
        >>> import io
        >>> import laspy
        >>> import delaunayflip.laspy
        >>> tile = laspy.create()
        >>> tile.x, tile.y, tile.z = [0, 4, 4, 0, 2], [0, 0, 4, 4, 2], [1, 1, 1, 1, 30]
        >>> tile.classification = [2, 2, 2, 2, 5]
        >>> len(delaunayflip.laspy.triangulate(tile, classes=[2]).triangles)
        2
    """
    inspect.signature(_triangulate).bind(None, **options)  # refuses unknown ones
    wanted = None
    if classes is not None:
        wanted = _read_classes(classes)
    if isinstance(file, laspy.LasData):
        points = _select(file.points, wanted)
        seen = numpy.unique(file.classification)
    else:
        with laspy.open(file, closefd=isinstance(file, (str, os.PathLike))) as reader:
            chunks, seen = [], numpy.empty(0, dtype=numpy.int64)
            for records in reader.chunk_iterator(CHUNK):
                chunks.append(_select(records, wanted))
                seen = numpy.union1d(seen, numpy.asarray(records.classification))
            points = numpy.concatenate(chunks) if chunks else numpy.empty((0, 3))
    if len(points) == 0:
        listed = ", ".join(str(int(number)) for number in seen) or "none"
        which = "" if classes is None else f" of the classes {classes!r}"
        raise ValueError(f"there is no point{which} that is not withheld; the file has the classes {listed}")
    observers = {name: options.pop(name, None) for name in ("progress", "on_iteration")}
    result, trouble = run_points(points, options, **observers)
    if trouble:
        warnings.warn(trouble, stacklevel=2)
    return result


def _read_classes(classes):
    """The numbers of classes as an array."""
    try:
        listed = [classes] if isinstance(classes, numbers.Integral) else classes
        if isinstance(listed, (str, bytes)):
            raise TypeError
        return numpy.array([operator.index(number) for number in listed], dtype=numpy.int64)
    except (TypeError, OverflowError):
        raise TypeError("classes must be integers, such as [2], or one integer, not "
                        f"{show(classes)}") from None


def _select(records, wanted):
    """The places of the records of these classes that are not withheld, (n, 3)."""
    is_wanted = ~numpy.asarray(records.withheld, dtype=bool)
    if wanted is not None:
        is_wanted &= numpy.isin(numpy.asarray(records.classification), wanted)
    return numpy.column_stack([numpy.asarray(records[axis])[is_wanted] for axis in "xyz"])

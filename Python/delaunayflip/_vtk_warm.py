# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Warm starts: if only points were moved, a live run continues with its triangles and the edges
that were fixed at its beginning."""
import ctypes
import dataclasses
import typing

import numpy

from . import _arrays, _library
from ._observers import Observers
from ._options import make_options

#: Counts that a warm start takes from the first run.
_COUNTS = ("constraint_edges", "unmatched_constraints", "inserted_constraints", "constraint_flips")


@dataclasses.dataclass(frozen=True)
class Start:
    """Where a warm start begins."""

    geometry: str  #: Kept, because a surface has feature edges that a plane does not have.
    triangles: typing.Any
    fixed_edges: typing.Any  #: (k, 2) ids
    counts: typing.Dict[str, int]

    def change_arguments(self, arguments):
        """Keyword arguments of a Session that begins here."""
        has_edges = len(self.fixed_edges) > 0
        return {**arguments, "triangles": self.triangles, "insert_constraints": False,
                "constraints": self.fixed_edges if has_edges else None}

    def change_options(self, options):
        """Finds no new feature edges: the fixed edges include those of the first run."""
        return {**options, "feature_angle": 180.0}

    def change_totals(self, totals):
        totals.counts.update(self.counts)
        return totals


def make_start(session, arguments, options, totals, begin):
    """A start at the triangles of a run. `begin`: its own start, or None."""
    triangles = session.triangles
    if begin is not None:
        return dataclasses.replace(begin, triangles=triangles)
    counts = {name: totals.counts[name] for name in _COUNTS}
    edges = _find_fixed_edges(_arrays.Mesh(**arguments), options)
    return Start(session.report.geometry_used, triangles, edges, counts)


def keeps_geometry(start, arguments, options):
    """Whether the moved points call for the same geometry, both with the triangles that flips have
    made and with those of the input."""
    return all(_find_geometry(_arrays.Mesh(**{**arguments, "triangles": triangles}), options)
               == start.geometry for triangles in (arguments["triangles"], start.triangles))


def _find_geometry(mesh, options):
    geometry = ctypes.c_int32()
    _library.call("find_geometry", mesh.struct, make_options(**options), geometry)
    return _library.GEOMETRIES[geometry.value]


def _find_fixed_edges(mesh, options):
    pairs = numpy.empty((3 * len(mesh.triangles) // 2 + 1, 2), dtype=numpy.int64)
    count = ctypes.c_int64()
    with Observers().raising() as callbacks:
        _library.call("find_fixed_edges", mesh.struct, make_options(**options), callbacks,
                      _arrays.address(pairs), count)
    return pairs[:count.value].copy()

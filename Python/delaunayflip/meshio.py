# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for meshio."""
import typing

import meshio
import numpy

from . import _arrays
from ._session import flip as _flip


def flip(mesh: "meshio.Mesh", **options: typing.Any) -> "meshio.Mesh":
    """A mesh with the same points, data and sets whose triangles are Delaunay. Other cells stay;
    edges along lines stay too, but lines are not inserted. Keywords as for delaunayflip.flip; its
    constraints are added to the lines.

    Raises:
        TypeError: The mesh is none of meshio.
        The exceptions of delaunayflip.flip.

    Example:
        >>> import meshio
        >>> import delaunayflip.meshio
        >>> kite = meshio.Mesh([[0.0, 0], [2, -1], [4, 0], [2, 1]],
        ...                    [("triangle", [[0, 1, 2], [0, 2, 3]])])
        >>> better = delaunayflip.meshio.flip(kite)
        >>> sorted(sorted(face) for face in better.cells_dict["triangle"].tolist())
        [[0, 1, 3], [1, 2, 3]]
    """
    if not isinstance(mesh, meshio.Mesh):
        raise TypeError(f"mesh must be a meshio.Mesh, not {type(mesh).__name__}")
    lines = [_arrays.as_ids("lines", block.data, 2) for block in mesh.cells if block.type == "line"]
    if lines:
        _add_lines(numpy.concatenate(lines), options)
    made = mesh.copy()
    blocks = [block for block in made.cells if block.type == "triangle"]
    triangles = [_arrays.as_ids("triangles", block.data, 3) for block in blocks]
    triangles = numpy.concatenate(triangles or [numpy.empty((0, 3), dtype=int)])
    flipped = _flip(mesh.points, triangles, **options).triangles
    for block, end in zip(blocks, numpy.cumsum([len(block) for block in blocks])):
        block.data = flipped[end - len(block):end]
    return made


def _add_lines(lines, options):
    """Adds them to the constraints, not to be inserted."""
    given = options.get("constraints")
    given = _arrays.as_ids("constraints", [] if given is None else given, 2)
    flags = _arrays.as_flags("insert_constraints", options.get("insert_constraints", True),
                             (), (len(given),))
    options["constraints"] = numpy.concatenate([lines, given])
    options["insert_constraints"] = numpy.concatenate(
        [numpy.zeros(len(lines), bool), numpy.full(len(given), flags)])

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
    are_triangles = [block.type == "triangle" for block in mesh.cells]
    lines = [_arrays.as_ids("lines", block.data, 2) for block in mesh.cells if block.type == "line"]
    if lines:
        _add_lines(numpy.concatenate(lines), options)
    blocks = [block.data for block, is_one in zip(mesh.cells, are_triangles) if is_one]
    triangles = numpy.concatenate(blocks) if blocks else numpy.empty((0, 3), dtype=int)
    flipped = _flip(mesh.points, triangles, **options).triangles
    parts = iter(numpy.split(flipped, numpy.cumsum([len(block) for block in blocks])[:-1]))
    cells = [meshio.CellBlock(block.type, next(parts) if is_one else block.data, block.tags)
             for block, is_one in zip(mesh.cells, are_triangles)]
    return meshio.Mesh(
        mesh.points, cells, dict(mesh.point_data),
        {name: list(values) for name, values in mesh.cell_data.items()}, mesh.field_data,
        mesh.point_sets, mesh.cell_sets, mesh.gmsh_periodic, mesh.info)


def _add_lines(lines, options):
    """Adds them to the constraints, not to be inserted."""
    given = options.get("constraints")
    given = _arrays.as_ids("constraints", [] if given is None else given, 2)
    flags = _arrays.as_flags("insert_constraints", options.get("insert_constraints", True),
                             (), (len(given),))
    options["constraints"] = numpy.concatenate([lines, given])
    options["insert_constraints"] = numpy.concatenate(
        [numpy.zeros(len(lines), bool), numpy.full(len(given), flags)])

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for meshio."""
import typing

import meshio
import numpy

from ._flip import flip as _flip


def flip(mesh: "meshio.Mesh", **options: typing.Any) -> "meshio.Mesh":
    """A mesh with the same points and data whose triangles are Delaunay. Other cells stay; lines
    are constraints. Keywords as for delaunayflip.flip.

    Example:
        >>> import meshio
        >>> import delaunayflip.meshio
        >>> kite = meshio.Mesh([[0.0, 0], [2, -1], [4, 0], [2, 1]],
        ...                    [("triangle", [[0, 1, 2], [0, 2, 3]])])
        >>> better = delaunayflip.meshio.flip(kite)
        >>> sorted(sorted(face) for face in better.cells_dict["triangle"].tolist())
        [[0, 1, 3], [1, 2, 3]]
    """
    are_triangles = [block.type == "triangle" for block in mesh.cells]
    lines = [block.data for block in mesh.cells if block.type == "line"]
    if lines and "constraints" not in options:
        options["constraints"] = numpy.concatenate(lines)
    blocks = [block.data for block, is_one in zip(mesh.cells, are_triangles) if is_one]
    triangles = numpy.concatenate(blocks) if blocks else numpy.empty((0, 3), dtype=int)
    flipped = _flip(mesh.points, triangles, **options).triangles
    parts = iter(numpy.split(flipped, numpy.cumsum([len(block) for block in blocks])[:-1]))
    cells = [(block.type, next(parts) if is_one else block.data)
             for block, is_one in zip(mesh.cells, are_triangles)]
    return meshio.Mesh(mesh.points, cells, mesh.point_data, mesh.cell_data, mesh.field_data)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for trimesh."""
import typing

import trimesh

from ._flip import flip as _flip


def flip(mesh: "trimesh.Trimesh", **options: typing.Any) -> "trimesh.Trimesh":
    """A Delaunay mesh of the same vertices; keywords as for delaunayflip.flip.

    Example:
        >>> import trimesh
        >>> import delaunayflip.trimesh
        >>> kite = trimesh.Trimesh([[0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]],
        ...                        [[0, 1, 2], [0, 2, 3]])
        >>> sorted(sorted(face) for face in delaunayflip.trimesh.flip(kite).faces.tolist())
        [[0, 1, 3], [1, 2, 3]]
    """
    result = _flip(mesh.vertices, mesh.faces, **options)
    return trimesh.Trimesh(mesh.vertices, result.triangles, process=False)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for trimesh."""
import copy
import typing

import trimesh

from ._session import flip as _flip


def flip(mesh: "trimesh.Trimesh", **options: typing.Any) -> "trimesh.Trimesh":
    """A Delaunay mesh of the same vertices, with the colours, attributes and metadata of the mesh;
    keywords as for delaunayflip.flip. Each face keeps its number and what belongs to it.

    Raises:
        TypeError: The mesh is no trimesh.Trimesh, such as a scene.
        The exceptions of delaunayflip.flip.

    Example:
        >>> import trimesh
        >>> import delaunayflip.trimesh
        >>> kite = trimesh.Trimesh([[0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]],
        ...                        [[0, 1, 2], [0, 2, 3]])
        >>> sorted(sorted(face) for face in delaunayflip.trimesh.flip(kite).faces.tolist())
        [[0, 1, 3], [1, 2, 3]]
    """
    if not isinstance(mesh, trimesh.Trimesh):
        raise TypeError(f"mesh must be a trimesh.Trimesh, not {type(mesh).__name__}; of a scene, take "
                        "scene.to_mesh(), or its geometry one by one")
    result = _flip(mesh.vertices, mesh.faces, **options)
    colors = {}
    if mesh.visual.kind in ("face", "vertex"):
        name = mesh.visual.kind + "_colors"
        colors[name] = getattr(mesh.visual, name).copy()
    elif mesh.visual.kind is not None:
        colors["visual"] = mesh.visual.copy()
    return trimesh.Trimesh(
        mesh.vertices.copy(), result.triangles, process=False, metadata=copy.deepcopy(mesh.metadata),
        face_attributes=copy.deepcopy(mesh.face_attributes),
        vertex_attributes=copy.deepcopy(mesh.vertex_attributes), **colors)

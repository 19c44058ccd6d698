# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for trimesh."""
import copy
import typing
import warnings

import trimesh

from ._options import refuse_goals
from ._report import Report
from ._session import flip_arrays


@typing.overload
def flip(mesh: "trimesh.Trimesh", **options: typing.Any) -> "trimesh.Trimesh": ...


@typing.overload
def flip(mesh: "trimesh.Trimesh", *, return_report: typing.Literal[True], **options: typing.Any
         ) -> "typing.Tuple[trimesh.Trimesh, Report]": ...


def flip(
    mesh: "trimesh.Trimesh", *, return_report: bool = False, **options: typing.Any,
) -> "typing.Union[trimesh.Trimesh, typing.Tuple[trimesh.Trimesh, Report]]":
    """A Delaunay mesh of the same vertices, with the colours, attributes and metadata of the mesh.
    Each face keeps its number and what belongs to it.

    Args:
        mesh: Any Trimesh; it is not changed.
        return_report: Also return the `Report`.
        **options: Those of delaunayflip.flip.

    Returns:
        The mesh; with `return_report`, the mesh and the report.

    Raises:
        TypeError: The mesh is not a trimesh.Trimesh, such as a scene.
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
    refuse_goals(options, "trimesh")
    result, trouble = flip_arrays(mesh.vertices, mesh.faces, **options)
    for text in trouble:
        warnings.warn(text, stacklevel=2)
    colors = {}
    if mesh.visual.kind in ("face", "vertex"):
        name = mesh.visual.kind + "_colors"
        colors[name] = getattr(mesh.visual, name).copy()
    elif mesh.visual.kind is not None:
        colors["visual"] = mesh.visual.copy()
    made = trimesh.Trimesh(
        mesh.vertices.copy(), result.triangles, process=False, metadata=copy.deepcopy(mesh.metadata),
        face_attributes=copy.deepcopy(mesh.face_attributes),
        vertex_attributes=copy.deepcopy(mesh.vertex_attributes), **colors)
    return (made, result.report) if return_report else made

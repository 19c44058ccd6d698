# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The whole run in one call."""
import dataclasses
from typing import Optional, Union

import numpy

from . import _arrays, _device, _library
from ._options import choose
from ._report import Report
from ._session import Session
from ._types import (
    Array, Backend, Criterion, Devices, Geometry, Numbers, OnIteration, Progress, TieRule)


@dataclasses.dataclass(frozen=True, eq=False)
class Result:
    """What `flip` returns. Only the same object is equal: compare the arrays."""

    triangles: Array  #: (m, 3), in the input's order and of its integers.
    flip_counts: Array  #: (m,) int32: how many flips each triangle was part of.
    iterations: Array  #: Structured, a row per iteration; see Session.iterations.
    report: Report


def flip(
    points: Numbers, triangles: Numbers, *, geometry: Geometry = "auto",
    criterion: Criterion = "in-circle", tie_rule: TieRule = "keep", tolerance: float = -1.0,
    feature_angle: float = 30.0, constraints: Optional[Numbers] = None,
    insert_constraints: Union[bool, Numbers] = True, regions: Optional[Numbers] = None,
    frozen: Optional[Numbers] = None, maximum_iterations: int = -1, backend: Backend = "auto",
    threads: int = 0, device: int = -1, devices: Devices = (), pieces: int = 0,
    track_quality: bool = False, progress: Optional[Progress] = None,
    on_iteration: Optional[OnIteration] = None,
) -> Result:
    """Turns a triangle mesh into a Delaunay mesh of the same points by flipping edges.

    Any mesh is accepted: open, non-manifold, of mixed winding, degenerate. Edges that cannot flip
    safely stay and are counted. The same input gives the same bits, on any threads or GPUs.

    Args:
        points: (n, 3) float32 or float64, used without a copy if contiguous; (n, 2) gets z = 0.
        triangles: (m, 3) int32 or int64, used without a copy if contiguous; never written.
        geometry: "planar": edges are judged in the plane of the points; "planar-xy": by x and y
            (terrain); "surface": in space; "auto": whichever fits.
        criterion: "in-circle" (exact; surfaces ignore it) or "opposite-angles".
        tie_rule: For points on one circle: "keep" edges or, in the plane, "canonical" triangles.
        tolerance: Radians by which opposite angles must exceed pi to be bad, 0 to below 1; -1:
            automatic, from the precision of the points. For "opposite-angles" and surfaces.
        feature_angle: On surfaces, edges sharper than this many degrees stay; 180 turns it off.
        constraints: (k, 2) pairs of point ids: edges that must stay.
        insert_constraints: In the plane, flips turn missing constraints into edges; or (k,) flags.
        regions: (m,) integers: edges between triangles of different labels stay.
        frozen: (m,) flags: the edges of these triangles stay.
        maximum_iterations: -1: until done; 0: only test.
        backend: "cuda", "threads", or "auto": a GPU for large meshes if there is one.
        threads: 0: as many as the machine has.
        device: CUDA's number of the GPU; -1: that of arrays on a GPU (see Session), or the current.
        devices: GPUs, connected by NVLink, that share the mesh: [0, 1] or "all"; (): device.
        pieces: 1 to 255, flipped in turn where a GPU is too small for the mesh; 0: the fewest.
        track_quality: Compute the smallest angle after every iteration.
        progress: Called with the share of the work done, 0 to 1; returning False aborts.
        on_iteration: Called after each iteration with a dict of its numbers; False aborts.

    Returns:
        A `Result`. After an abort it holds the valid mesh of the last whole iteration.

    Raises:
        InvalidMesh, InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError.

    Example:
        >>> points = [[0, 0], [2, -1], [4, 0], [2, 1]]
        >>> result = flip(points, [[0, 1, 2], [0, 2, 3]])
        >>> result.report.total_flips, sorted(sorted(ids) for ids in result.triangles.tolist())
        (1, [[0, 1, 3], [1, 2, 3]])
    """
    with Session(
        points, triangles, constraints=constraints, insert_constraints=insert_constraints,
        regions=regions, frozen=frozen, progress=progress, geometry=geometry, criterion=criterion,
        tie_rule=tie_rule, tolerance=tolerance, feature_angle=feature_angle,
        maximum_iterations=maximum_iterations, backend=backend, threads=threads, device=device,
        devices=devices, pieces=pieces, track_quality=track_quality) as session:
        if session.report.stop_reason != "aborted":
            session.advance(progress=progress, on_iteration=on_iteration)
        return Result(session.triangles, session.flip_counts, session.iterations, session.report)


def smallest_angles(
    points: Numbers, triangles: Numbers, *, geometry: Geometry = "surface"
) -> Array:
    """The smallest angle of each triangle.

    Args:
        points: As for `flip`. What is on a GPU is copied to the host.
        triangles: As for `flip`.
        geometry: "planar-xy" measures by x and y, every other in space.

    Returns:
        (m,) float64 in degrees, 0 to 60; NaN for a triangle with a coordinate that is not finite.

    Raises:
        InvalidMesh: A triangle names a point that does not exist.

    Example:
        >>> smallest_angles([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
        array([45.])
    """
    number = choose("geometry", geometry)
    mesh = _arrays.Mesh(_device.to_host(points), _device.to_host(triangles))
    angles = numpy.empty(len(mesh.triangles))
    _library.call("triangle_angles", mesh.struct, number, _arrays.address(angles))
    return angles

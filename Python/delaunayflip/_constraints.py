# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The edges along lines and polygons of surfaces, as pairs of point ids."""
import numpy


class Constraints:
    """Edges that must stay. `surface` and `others`, or None, are Surfaces.

    Attributes:
        pairs: (k, 2) int64, unique, in the order given, the smaller id of each pair first.
        to_insert: (k,) whether a pair is to be inserted if the mesh does not have it.
        unmatched: how many edges of the second input end at no point of the mesh.
    """

    def __init__(self, surface, others, settings, triangles):
        pairs, flags, self.unmatched, points = [], [], 0, surface.points
        if settings.lines:
            lines = surface.read("Lines", "line, cell")
            lines.require_points(len(points))
            pairs.append(_drop_points(_list_pairs(lines, False)))
            flags.append(numpy.full(len(pairs[-1]), settings.insert_lines))
        if others is not None:
            found, self.unmatched = _find_others(others, points, triangles)
            pairs.append(found)
            flags.append(numpy.full(len(found), settings.insert_constraints))
        self.pairs, self.to_insert = _unite(pairs, flags, max(len(points), 1))


def _list_pairs(cells, are_closed):
    """(k, 2) consecutive points of each cell; of closed ones also the last and the first."""
    corners, offsets = cells.corners.astype(numpy.int64), cells.offsets
    following = numpy.arange(1, len(corners) + 1)
    ends = offsets[1:][cells.sizes > 0] - 1  # the last corner of each cell
    is_last = numpy.zeros(len(corners), dtype=bool)
    is_last[ends] = True
    following[ends] = offsets[:-1][cells.sizes > 0]
    kept = ~is_last
    if are_closed:
        kept[offsets[1:][cells.sizes > 2] - 1] = True
    return numpy.stack([corners[kept], corners[following[kept]]], axis=1)


def _drop_points(pairs):
    """The pairs without those of equal ends; the smaller end comes first."""
    return numpy.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1)


def _unite(pairs, flags, count):
    """Each pair once, at its first position; its flag is set if any of its flags is."""
    if not pairs:
        return numpy.empty((0, 2), dtype=numpy.int64), numpy.empty(0, dtype=numpy.uint8)
    pairs, flags = numpy.concatenate(pairs), numpy.concatenate(flags)
    _, first, inverse = numpy.unique(
        pairs[:, 0] * count + pairs[:, 1], return_index=True, return_inverse=True)
    united = numpy.zeros(len(first), dtype=numpy.uint8)
    numpy.maximum.at(united, inverse.ravel(), flags.astype(numpy.uint8))
    order = numpy.argsort(first)
    return numpy.ascontiguousarray(pairs[first[order]]), united[order]


def list_other_pairs(others, count):
    """The edges of the second input, which names `count` points."""
    lines, polygons = (others.read(kind, "constraint cell") for kind in ("Lines", "Polys"))
    for cells in (lines, polygons):
        cells.require_points(count)
    return numpy.concatenate([_list_pairs(lines, False), _list_pairs(polygons, True)])


def _find_others(others, points, triangles):
    """The pairs of the second input, and how many of its edges end at no point of the mesh."""
    other_points = others.points
    has_same_bits = (other_points.dtype == points.dtype and len(other_points) == len(points)
                     and other_points.tobytes() == points.tobytes())
    if len(other_points) == 0 or has_same_bits:
        return _drop_points(list_other_pairs(others, len(points))), 0
    pairs = list_other_pairs(others, len(other_points))
    return _match_places(pairs, other_points, points, triangles)


def _number_places(points, other_points):
    """Numbers of the places of the points of both meshes; -1, -2, ... for points that are not
    finite."""
    single = numpy.float32 in (points.dtype, other_points.dtype)
    kind = numpy.float32 if single else numpy.float64
    with numpy.errstate(over="ignore"):
        joined = numpy.concatenate([points.astype(kind), other_points.astype(kind)])
    joined += kind(0)  # -0 becomes 0
    finite = numpy.isfinite(joined).all(axis=1)
    bits = numpy.ascontiguousarray(joined).view(numpy.dtype((numpy.void, 3 * joined.itemsize)))
    places = -1 - numpy.arange(len(joined))
    places[finite] = numpy.unique(bits[finite].ravel(), return_inverse=True)[1].ravel()
    return places[:len(points)], places[len(points):]


def _match_places(pairs, other_points, points, triangles):
    """Pairs of points of the mesh at the places of other points. Where several points of the mesh
    lie at one place, all pairs of them that are edges match."""
    places, other_places = _number_places(points, other_points)
    wanted = _drop_points(other_places[pairs])
    size = int(max(places.max(initial=-1), other_places.max(initial=-1))) + 1
    shift = len(places) + len(other_places)  # so that none is negative
    wanted = _unite([wanted + shift], [numpy.zeros(len(wanted))], 2 * shift)[0] - shift
    known = places[places >= 0]
    crowd = numpy.append(numpy.bincount(known, minlength=size), 0)  # [-1]: a place without points
    first = numpy.full(size + 1, -1)
    ids = numpy.flatnonzero(places >= 0)[::-1]
    first[places[ids]] = ids
    matches = numpy.prod(crowd[numpy.maximum(wanted, -1)], axis=1)
    single = _drop_points(first[wanted[matches == 1]])
    crowded, found = _find_crowded(wanted[matches > 1], places, triangles, size)
    unmatched = int((matches == 0).sum()) + int((matches > 1).sum()) - found
    return numpy.concatenate([single, crowded]), unmatched


def _find_crowded(wanted, places, triangles, size):
    """The edges of the mesh between these pairs of places, and how many pairs have any."""
    if len(wanted) == 0:
        return numpy.empty((0, 2), dtype=numpy.int64), 0
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(numpy.int64)
    sides = sides[((sides >= 0) & (sides < len(places))).all(axis=1)]
    at = numpy.sort(places[sides], axis=1)
    keys = at[:, 0] * size + at[:, 1]
    keys[at[:, 0] < 0] = -1
    wanted_keys = wanted[:, 0] * size + wanted[:, 1]
    matching = numpy.isin(keys, wanted_keys)
    return _drop_points(sides[matching]), len(numpy.unique(keys[matching]))

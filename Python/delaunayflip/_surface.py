# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A vtkPolyData of any VTK as arrays: its triangles, and the edges along lines that must stay. Nothing
here imports VTK."""
import numpy

from . import _arrays, _library
from ._library import InvalidMesh
from ._session import call

NONE = -1


class Cells:
    """Ids `corners[offsets[i]:offsets[i + 1]]` are the points of cell i. `what` is the word for the
    cells in messages, `first` the number of the first one."""

    def __init__(self, offsets, corners, what, first):
        self.offsets, self.corners = (  # those of VTK may be unsigned
            ids.astype(numpy.int64) if ids.dtype.kind == "u" else ids for ids in (offsets, corners))
        self.what, self.first = what, first
        self.count = len(offsets) - 1

    @property
    def sizes(self):
        return numpy.diff(self.offsets)

    def are_triangles(self):
        return len(self.corners) == 3 * self.count and bool((self.sizes == 3).all())

    def require_points(self, count):
        """Raises InvalidMesh if a cell names a point that does not exist."""
        wrong = numpy.flatnonzero((self.corners < 0) | (self.corners >= count))
        if len(wrong):
            cell = self.first + int(numpy.searchsorted(self.offsets, wrong[0], side="right")) - 1
            point = int(self.corners[wrong[0]])
            raise InvalidMesh(
                f"Invalid mesh: {self.what} {cell} names point {point}, but there are {count} points, "
                "numbered from 0.", cell, point)

    def gather(self, chosen):
        """The corners of the chosen cells, one after the other."""
        sizes = self.sizes[chosen]
        return self.corners[numpy.repeat(self.offsets[chosen], sizes) + _count_up(sizes)]


class Surface:
    """Reads a vtkPolyData. `view` is the function that gives the values of its arrays."""

    KINDS = ("Verts", "Lines", "Polys", "Strips")  # the order of cell ids

    def __init__(self, mesh, view):
        self._mesh, self._view = mesh, view
        counts = [getattr(mesh, "GetNumberOf" + kind)() for kind in self.KINDS]
        self.first = dict(zip(self.KINDS, numpy.cumsum([0, *counts]).tolist()))
        self.points = numpy.empty((0, 3))
        if mesh.GetNumberOfPoints():
            points = view(mesh.GetPoints().GetData())
            is_real = points.dtype in (numpy.float32, numpy.float64)
            self.points = points if is_real else points.astype(float)

    def read(self, kind, what="cell"):
        """The Cells of a kind.

        Raises:
            InvalidMesh: Offsets and connectivity contradict each other.
        """
        array, first = getattr(self._mesh, "Get" + kind)(), self.first[kind]
        if not array.IsValid():
            raise InvalidMesh(
                f"The offsets and the connectivity of the cell array of {what} {first} and the "
                "following ones contradict each other.", first)
        if array.GetNumberOfCells() == 0:
            return Cells(numpy.zeros(1, dtype=int), numpy.zeros(0, dtype=int), what, first)
        return Cells(self._view(array.GetOffsetsArray()), self._view(array.GetConnectivityArray()),
                     what, first)


class Slots:
    """The triangles into which polygons and strips are split; views if all are triangles already.

    Attributes:
        in_place: whether the triangles are the polygons, without a copy.
        triangles: (m, 3).
        cells: (m,) the cell of each triangle.
        frozen: (m,) whether a triangle belongs to a cell that stays; None: none does.
        polygon_cells, polygon_triangles: for each polygon of the output the cell from which it is
            made, and its triangle, or NONE if the polygon is the whole cell.
        kept_strips: the cells that stay strips.
        divides_cells: whether the output has several cells for one.
        no_triangles: the polygons of more than three points, of which fewer than three differ. They
            are only in the output if `triangulate` is off.
    """

    def __init__(self, surface, triangulate, progress=None):
        self.first_polygon = surface.first["Polys"]
        for kind in ("Verts", "Lines"):
            surface.read(kind)
        self.strips, self.polygons = surface.read("Strips"), surface.read("Polys")
        self.in_place = self.strips.count == 0 and self.polygons.are_triangles()
        if self.in_place:
            self.triangles = self.polygons.corners.reshape(-1, 3)
            counts = numpy.ones(len(self.triangles), dtype=int)
        else:
            for cells in (self.polygons, self.strips):
                cells.require_points(len(surface.points))
            parts = _split(self.polygons, surface.points, progress), _split_strips(self.strips)
            self.triangles, counts = map(numpy.concatenate, zip(*parts))
        self._number_cells(triangulate, counts)

    def _number_cells(self, triangulate, counts):
        """Cells that stay are split too, into frozen triangles: those of too few points, and all that
        are not to be split. `counts`: the number of triangles of each."""
        sizes = numpy.concatenate([self.polygons.sizes, self.strips.sizes])
        is_strip = numpy.arange(len(sizes)) >= self.polygons.count
        stays = (sizes < 3) | ((sizes > 3 - is_strip) & (not triangulate))
        ids = self.first_polygon + numpy.arange(len(sizes))
        self.no_triangles = ids[(sizes > 3) & (counts == 0) & ~is_strip]
        self.triangulate = triangulate
        self.cells = numpy.repeat(ids, counts)
        self.frozen = numpy.repeat(stays, counts) if stays.any() else None
        rows = numpy.where(stays, ~is_strip, counts)
        self.polygon_cells = numpy.repeat(ids, rows)
        triangles = numpy.repeat(numpy.cumsum(counts) - counts, rows) + _count_up(rows)
        self.polygon_triangles = numpy.where(numpy.repeat(stays, rows), NONE, triangles)
        self.kept_strips = ids[stays & is_strip]
        self.divides_cells = bool(((counts > 1) & ~stays).any())

    def describe_no_triangles(self):
        """Texts of a warning, if there are any."""
        count = len(self.no_triangles)
        if count == 0:
            return []
        first = ", ".join(str(cell) for cell in self.no_triangles[:3].tolist())
        fate = ", left out" if self.triangulate else ""
        return [f"{count} {'polygon' if count == 1 else 'polygons'} with fewer than three different "
                f"points{fate} (first: {first})"]

    def list_triangles(self):
        """The polygons of the output that are triangles, and the triangle of each."""
        polygons = numpy.flatnonzero(self.polygon_triangles != NONE)
        return polygons, self.polygon_triangles[polygons]


def number_tuples(values):
    """A number per tuple; equal tuples have equal numbers, and so have all NaN, and 0 and -0."""
    if len(values) == 0:
        return numpy.empty(0, dtype=numpy.int32)
    values = values.reshape(len(values), -1)
    if values.dtype.kind == "f":
        values = values + values.dtype.type(0)  # -0 becomes 0
        values[numpy.isnan(values)] = numpy.nan
    values = numpy.ascontiguousarray(values)
    width = values.shape[1] * values.itemsize
    return numpy.unique(values.view(numpy.dtype((numpy.void, width))).ravel(),
                        return_inverse=True)[1].ravel().astype(numpy.int32)


def _count_up(sizes):
    """0, 1, ... for each of these sizes."""
    return numpy.arange(sizes.sum()) - numpy.repeat(numpy.cumsum(sizes) - sizes, sizes)


def _split(polygons, points, progress):
    """(m, 3) triangles of all polygons, and the number of those of each."""
    triangles = numpy.empty((int(numpy.maximum(polygons.sizes - 2, 0).sum()), 3), dtype=numpy.int64)
    mesh = _arrays.Mesh(points, triangles[:0])
    offsets = numpy.ascontiguousarray(polygons.offsets, dtype=numpy.int64)
    corners = numpy.ascontiguousarray(polygons.corners, dtype=numpy.int64)
    struct = _library.make(_library.Polygons)
    struct.number_of_polygons = polygons.count
    struct.offsets, struct.corners = _arrays.address(offsets), _arrays.address(corners)
    made = numpy.empty(polygons.count, dtype=numpy.int64)
    struct.triangle_counts = _arrays.address(made)
    call("split_polygons", mesh.struct, struct, _arrays.address(triangles), progress)
    return triangles[:made.sum()], made


def _split_strips(strips):
    """Splits strips. Leaves out triangles that name a point twice, by which a strip continues
    elsewhere."""
    counts = numpy.maximum(strips.sizes - 2, 0)
    steps = _count_up(counts)
    first = numpy.repeat(strips.offsets[:-1], counts) + steps
    odd = steps % 2  # every other triangle of a strip is wound the other way
    places = numpy.stack([first + odd, first + 1 - odd, first + 2], axis=1)
    a, b, c = strips.corners[places].astype(numpy.int64).reshape(-1, 3).T
    is_whole = (a != b) & (b != c) & (c != a)
    strip_of = numpy.repeat(numpy.arange(strips.count), counts)
    made = numpy.bincount(strip_of[is_whole], minlength=strips.count)
    return numpy.stack([a, b, c], axis=1)[is_whole], made


class Constraints:
    """Edges that must stay. `surface` and `others`, or None, are Surfaces.

    Attributes:
        pairs: (k, 2) int64, unique, in the order given, the smaller id of each pair first.
        to_insert: (k,) whether a pair is to be inserted if the mesh does not have it.
        unmatched: how many edges of the second input the mesh does not have.
        first_stranger: where the first of them is that ends at no point of the mesh; "" if none.
    """

    def __init__(self, surface, others, triangles, keeps_lines, insert_lines, insert_others):
        pairs, flags, points = [], [], surface.points
        self.unmatched, self.first_stranger = 0, ""
        if keeps_lines:
            lines = surface.read("Lines", "line, cell")
            lines.require_points(len(points))
            pairs.append(_drop_points(list_pairs(lines, False)))
            flags.append(numpy.full(len(pairs[-1]), insert_lines))
        if others is not None:
            found, self.unmatched, self.first_stranger = _find_others(others, points, triangles)
            pairs.append(found)
            flags.append(numpy.full(len(found), insert_others))
        self.pairs, self.to_insert = _unite(pairs, flags, max(len(points), 1))


def list_pairs(cells, are_closed):
    """(k, 2) consecutive points of each cell; of closed ones also the last and the first."""
    return join_corners(cells, are_closed & (cells.sizes > 2))


def join_corners(cells, returns):
    """(k, 2) consecutive points of each cell; where `returns`, a flag per cell, says so, also the last
    and the first."""
    corners, sizes = cells.corners.astype(numpy.int64), cells.sizes
    counts = numpy.maximum(sizes - ~returns, 0)
    first, steps = numpy.repeat(cells.offsets[:-1], counts), _count_up(counts)
    following = (steps + 1) % numpy.repeat(sizes, counts)
    return numpy.stack([corners[first + steps], corners[first + following]], axis=1)


def _drop_points(pairs):
    """The pairs without those of equal ends; the smaller end comes first."""
    return numpy.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1)


def _unite(pairs, flags, count):
    """Each pair once, at its first position; its flag is set if any of its flags is."""
    if not pairs:
        return numpy.empty((0, 2), dtype=numpy.int64), numpy.empty(0, dtype=bool)
    pairs, flags = numpy.concatenate(pairs), numpy.concatenate(flags)
    keys = pairs[:, 0] * count + pairs[:, 1]
    first = numpy.sort(numpy.unique(keys, return_index=True)[1])
    return pairs[first], numpy.isin(keys[first], keys[flags])


def _find_others(others, points, triangles):
    """The pairs of the second input, and `unmatched` and `first_stranger` of Constraints."""
    other_points = others.points
    has_same_bits = (other_points.dtype == points.dtype and len(other_points) == len(points)
                     and other_points.tobytes() == points.tobytes())
    is_by_id = len(other_points) == 0 or has_same_bits
    pairs = []
    for kind in ("Lines", "Polys"):
        cells = others.read(kind, "constraint cell")
        cells.require_points(len(points if is_by_id else other_points))
        pairs.append(list_pairs(cells, are_closed=kind == "Polys"))
    pairs = numpy.concatenate(pairs)
    return (_drop_points(pairs), 0, "") if is_by_id else _match_places(
        pairs, other_points, points, triangles)


def number_places(points, other_points):
    """Numbers of the places of the points of both meshes; -1, -2, ... for points that are not
    finite."""
    single = numpy.float32 in (points.dtype, other_points.dtype)
    kind = numpy.float32 if single else numpy.float64
    with numpy.errstate(over="ignore"):
        joined = numpy.concatenate([points.astype(kind), other_points.astype(kind)])
    finite = numpy.isfinite(joined).all(axis=1)
    places = -1 - numpy.arange(len(joined))
    places[finite] = number_tuples(joined[finite])
    return places[:len(points)], places[len(points):]


def _match_places(pairs, other_points, points, triangles):
    """Pairs of points of the mesh at the places of other points. Where several points of the mesh
    lie at one place, all pairs of them that are edges match."""
    places, other_places = number_places(points, other_points)
    wanted = _drop_points(other_places[pairs])
    size = int(max(places.max(initial=-1), other_places.max(initial=-1))) + 1
    shift = len(places) + len(other_places)  # so that none is negative
    wanted = _unite([wanted + shift], [numpy.zeros(len(wanted), bool)], 2 * shift)[0] - shift
    crowd, first = _count_points(places, triangles, size)
    matches = numpy.prod(crowd[numpy.maximum(wanted, -1)], axis=1)
    single = _drop_points(first[wanted[matches == 1]])
    crowded, found = _find_crowded(wanted[matches > 1], places, triangles, size)
    unmatched = int((matches == 0).sum()) + int((matches > 1).sum()) - found
    stranger = ""
    if (matches == 0).any():
        stranger = _describe_edge(other_points, other_places, wanted[matches == 0][0], pairs)
    return numpy.concatenate([single, crowded]), unmatched, stranger


def _count_points(places, triangles, size):
    """How many points of the mesh are at each place, and the first of them; last, those of a place without
    points. Where there are several, those that no triangle uses count only if there are no others."""
    ids = numpy.flatnonzero(places >= 0)
    crowd, first = _list_points(places, ids, size)
    if (crowd > 1).any():
        is_used = numpy.zeros(len(places), dtype=bool)
        is_used[triangles[(triangles >= 0) & (triangles < len(places))]] = True
        used_crowd, used_first = _list_points(places, ids[is_used[ids]], size)
        has_used = used_crowd > 0
        crowd[has_used], first[has_used] = used_crowd[has_used], used_first[has_used]
    return crowd, first


def _list_points(places, ids, size):
    """What _count_points returns, of the points with these ids, which are ascending."""
    crowd = numpy.append(numpy.bincount(places[ids], minlength=size), 0)
    first = numpy.full(size + 1, -1)
    first[places[ids[::-1]]] = ids[::-1]
    return crowd, first


def _describe_edge(points, places, wanted, pairs):
    """E.g. "from (0, 0, 0) to (1, 2.5, 0)": the first points of the pairs at the two wanted places."""
    pairs = _drop_points(pairs)
    first = sorted(numpy.flatnonzero(places[pairs.ravel()] == place)[0] for place in wanted)
    digits = 7 if points.dtype == numpy.float32 else 10
    ends = ["(" + ", ".join(f"{x:.{digits}g}" for x in points[end].tolist()) + ")"
            for end in pairs.ravel()[first]]
    return f"from {ends[0]} to {ends[1]}"


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

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A vtkPolyData of any VTK as arrays, its triangles, and the cells that they become again. Nothing
here imports VTK."""
import dataclasses

import numpy

from . import _arrays, _library
from ._constraints import Constraints
from ._errors import InvalidMesh
from ._flip import smallest_angles
from ._observers import Observers
from ._session import Session

NONE = -1
_GHOST = 1 | 8 | 32  # vtkDataSetAttributes.DUPLICATECELL, REFINEDCELL and HIDDENCELL


@dataclasses.dataclass(frozen=True)
class Settings:
    """The properties that decide which edges exist and which stay."""

    triangulate: bool = True
    lines: bool = True
    insert_lines: bool = False
    insert_constraints: bool = True
    region_array: str = ""


class Cells:
    """Ids `corners[offsets[i]:offsets[i + 1]]` are the points of cell i. `what` is the word for the
    cells in messages, `first` the number of the first one."""

    def __init__(self, offsets, corners, what, first):
        self.offsets, self.corners, self.what, self.first = offsets, corners, what, first
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
            cell = int(numpy.searchsorted(self.offsets, wrong[0], side="right")) - 1
            raise name_out_of_range(
                self.what, self.first + cell, int(self.corners[wrong[0]]), count)

    def gather(self, chosen):
        """The corners of the chosen cells, one after the other."""
        sizes = self.sizes[chosen]
        steps = numpy.arange(sizes.sum()) - numpy.repeat(numpy.cumsum(sizes) - sizes, sizes)
        return self.corners[numpy.repeat(self.offsets[chosen], sizes) + steps]


def name_out_of_range(what, cell, point, count):
    return InvalidMesh(
        f"Invalid mesh: {what} {cell} names point {point}, but there are {count} points, numbered "
        "from 0.", cell, point)


class Surface:
    """Reads a vtkPolyData. `view` is the function that gives the values of its arrays."""

    KINDS = ("Verts", "Lines", "Polys", "Strips")  # the order of cell ids

    def __init__(self, mesh, view):
        self._mesh, self._view = mesh, view
        counts = [getattr(mesh, "GetNumberOf" + kind)() for kind in self.KINDS]
        self.first = dict(zip(self.KINDS, numpy.cumsum([0, *counts]).tolist()))
        self.points = self._read_points()

    def _read_points(self):
        if self._mesh.GetNumberOfPoints() == 0:
            return numpy.empty((0, 3))
        data = self._mesh.GetPoints().GetData()
        if data.GetNumberOfComponents() != 3:
            raise InvalidMesh(f"Points must have 3 coordinates, not {data.GetNumberOfComponents()}.")
        points = self._view(data)
        return points if points.dtype in (numpy.float32, numpy.float64) else points.astype(float)

    def read(self, kind, what="cell"):
        """The Cells of a kind.

        Raises:
            InvalidMesh: Offsets and connectivity contradict each other.
        """
        return read_cells(getattr(self._mesh, "Get" + kind)(), what, self.first[kind], self._view)


def read_cells(array, what, first, view):
    if not array.IsValid():
        raise InvalidMesh(
            f"The offsets and the connectivity of the cell array of {what} {first} and the "
            "following ones contradict each other.", first)
    if array.GetNumberOfCells() == 0:
        return Cells(numpy.zeros(1, dtype=int), numpy.zeros(0, dtype=int), what, first)
    return Cells(view(array.GetOffsetsArray()), view(array.GetConnectivityArray()), what, first)


class Slots:
    """Views of the triangles if all polygons are triangles and there are no strips; else the
    triangles into which polygons and strips are split.

    Attributes:
        triangles: (m, 3), views or copies.
        cells: (m,) the cell of each triangle.
        frozen: (m,) whether a triangle belongs to a cell that stays; None: none does.
        polygon_cells, polygon_triangles: for each polygon of the output the cell from which it is
            made, and its triangle, or NONE if the polygon is the whole cell.
        kept_strips: the cells that stay strips.
    """

    def __init__(self, surface, triangulate, progress=None):
        self.first_polygon = surface.first["Polys"]
        for kind in ("Verts", "Lines"):
            surface.read(kind)
        self.strips, self.polygons = surface.read("Strips"), surface.read("Polys")
        self.in_place = self.strips.count == 0 and self.polygons.are_triangles()
        if self.in_place:
            self._view()
            return
        self.polygons.require_points(len(surface.points))
        self.strips.require_points(len(surface.points))
        parts = (_split(self.polygons, surface.points, triangulate, progress),
                 _split_strips(self.strips, triangulate))
        self._join(parts)
        self.kept_strips = self.strips.first + numpy.flatnonzero(
            _stay(self.strips.sizes, triangulate, 2))

    def _view(self):
        count = self.polygons.count
        self.triangles = self.polygons.corners.reshape(-1, 3)
        self.cells = self.polygon_cells = self.first_polygon + numpy.arange(count)
        self.polygon_triangles = numpy.arange(count)
        self.frozen = None
        self.kept_strips = numpy.empty(0, dtype=int)
        self.divides_cells = False

    def _join(self, parts):
        self.triangles = numpy.concatenate([part.triangles for part in parts])
        self.cells = numpy.concatenate([part.cells for part in parts])
        self.frozen = numpy.concatenate([part.frozen for part in parts])
        before = numpy.cumsum([0] + [len(part.triangles) for part in parts])
        lists = [part.list_output(start) for part, start in zip(parts, before)]
        self.polygon_cells = numpy.concatenate([cells for cells, _ in lists])
        self.polygon_triangles = numpy.concatenate([triangles for _, triangles in lists])
        self.divides_cells = any(((part.counts > 1) & ~part.stays).any() for part in parts)

    @property
    def are_polygons_triangles(self):
        """Whether each output polygon i is triangle i, and there are no others."""
        return self.in_place or (len(self.polygon_cells) == len(self.triangles)
                                 and bool((self.polygon_triangles != NONE).all()))


class FlipInput:
    """What a Session gets of a surface, and the cells of its result. Subclasses and users set
    `regions`, (m,) labels or None, and call `freeze`."""

    def __init__(self, surface, others, settings, progress=None):
        self.points = surface.points
        self.slots = Slots(surface, settings.triangulate, progress)
        self.constraints = Constraints(surface, others, settings, self.slots.triangles)
        self.regions, self.frozen = None, self.slots.frozen

    def freeze(self, ghosts):
        """The edges of ghost cells stay. `ghosts`: VTK's types of the cells, of which there may be
        too few, or None."""
        if ghosts is not None:
            padded = numpy.zeros(max(self.slots.cells.max(initial=-1) + 1, len(ghosts)), numpy.uint8)
            padded[:len(ghosts)] = ghosts
            are_ghosts = (padded[self.slots.cells] & _GHOST) != 0
            self.frozen = are_ghosts if self.frozen is None else are_ghosts | self.frozen

    def get_session_arguments(self):
        """Keyword arguments of a Session."""
        pairs = self.constraints.pairs
        return {
            "points": self.points, "triangles": self.slots.triangles, "regions": self.regions,
            "frozen": self.frozen, "constraints": pairs if len(pairs) else None,
            "insert_constraints": self.constraints.to_insert if len(pairs) else False,
            "triangle_numbers": self.slots.cells,
        }

    def open(self, **arguments):
        """A Session. Errors name the cell, not the triangle."""
        try:
            return Session(**{**self.get_session_arguments(), **arguments})
        except InvalidMesh as error:
            raise name_out_of_range(
                "cell", int(self.slots.cells[error.cell]), error.point, len(self.points)) from None

    def describe_unmatched(self):
        """Texts of a warning."""
        count = self.constraints.unmatched
        edges = "edge" if count == 1 else "edges"
        text = f"{count} constraint {edges} of the second input that the mesh does not have"
        return [text] if count else []

    @property
    def cell_sources(self):
        """The cell of the input from which each cell of the output is made."""
        return numpy.concatenate([numpy.arange(self.slots.first_polygon), self.slots.polygon_cells,
                                  self.slots.kept_strips])

    @property
    def polygon_sizes(self):
        """How many corners the polygons of the output have."""
        slots = self.slots
        sizes = numpy.full(len(slots.polygon_cells), 3)
        whole = slots.polygon_triangles == NONE
        if whole.any():
            sizes[whole] = slots.polygons.sizes[slots.polygon_cells[whole] - slots.first_polygon]
        return sizes

    def fill_polygons(self, session, corners):
        """Writes the corners of the output's polygons."""
        slots = self.slots
        if slots.are_polygons_triangles:
            session.store_triangles(corners.reshape(-1, 3))
            return
        is_triangle = slots.polygon_triangles != NONE
        of_triangle = numpy.repeat(is_triangle, self.polygon_sizes)
        corners[of_triangle] = session.triangles[slots.polygon_triangles[is_triangle]].ravel()
        whole = slots.polygon_cells[~is_triangle] - slots.first_polygon
        corners[~of_triangle] = slots.polygons.gather(whole)

    def renew_normals(self, values, triangles):
        """Writes the normals of changed triangles to those of all output cells. Normals that pointed
        against the winding still do."""
        slots = self.slots
        polygons = numpy.flatnonzero(slots.polygon_triangles != NONE)
        chosen = slots.polygon_triangles[polygons]
        changed = (slots.triangles[chosen] != triangles[chosen]).any(axis=1)
        cells, chosen = slots.first_polygon + polygons[changed], chosen[changed]
        old, new = (self._find_normals(some[chosen]) for some in (slots.triangles, triangles))
        against = (old * values[cells]).sum(axis=1) < 0
        values[cells] = new * numpy.where(against, -1.0, 1.0)[:, None]

    def _find_normals(self, triangles):
        """Unit normals by the right-hand rule; 0 for triangles without area."""
        mesh = _arrays.Mesh(self.points, triangles)
        normals = numpy.empty((len(triangles), 3))
        _library.call("triangle_normals", mesh.struct, _arrays.address(normals))
        return normals

    def list_numbers(self, session, counts, angles):
        """(name, values per output cell) of the requested cell arrays."""
        if counts:
            yield "vtkDelaunayFlipCount", self._spread(session.flip_counts, 0)
        if angles:
            used = session.report.geometry_used
            for name, triangles in (("Before", self.slots.triangles), ("After", session.triangles)):
                yield "vtkDelaunayFlipAngle" + name, self._spread(
                    smallest_angles(self.points, triangles, geometry=used), numpy.nan)

    def _spread(self, values, elsewhere):
        slots = self.slots
        of_cells = numpy.full(len(self.cell_sources), elsewhere, dtype=values.dtype)
        polygons = numpy.flatnonzero(slots.polygon_triangles != NONE)
        of_cells[slots.first_polygon + polygons] = values[slots.polygon_triangles[polygons]]
        return of_cells


def number_tuples(values):
    """A number per tuple; equal tuples have equal numbers, and so have all NaN, and 0 and -0."""
    values = values.reshape(len(values), -1)
    if values.dtype.kind == "f":
        values = values + values.dtype.type(0)  # -0 becomes 0
        values[numpy.isnan(values)] = numpy.nan
    values = numpy.ascontiguousarray(values)
    width = values.shape[1] * values.itemsize
    return numpy.unique(values.view(numpy.dtype((numpy.void, width))).ravel(),
                        return_inverse=True)[1].ravel().astype(numpy.int32)


class _Part:
    """The triangles of the polygons or of the strips. `counts` has their number for each cell.
    Cells that stay are split into triangles too, which are frozen."""

    def __init__(self, cells, triangles, counts, stays, stay_as_polygons):
        ids = cells.first + numpy.arange(cells.count)
        self.triangles, self.counts, self.stays = triangles, counts, stays
        self.cells = numpy.repeat(ids, counts)
        self.frozen = numpy.repeat(stays, counts)
        self._ids = ids
        self._stay_as_polygons = stay_as_polygons

    def list_output(self, before):
        """(cells, triangles) of the output's polygons, after the first `before` triangles."""
        rows = numpy.where(self.stays, int(self._stay_as_polygons), self.counts)
        starts = before + numpy.cumsum(self.counts) - self.counts
        steps = numpy.arange(rows.sum()) - numpy.repeat(numpy.cumsum(rows) - rows, rows)
        triangles = numpy.where(numpy.repeat(self.stays, rows), NONE,
                                numpy.repeat(starts, rows) + steps)
        return numpy.repeat(self._ids, rows), triangles


def _stay(sizes, triangulate, largest):
    """Which cells stay as they are: those without area, and those that are not to be split."""
    return (sizes < 3) | ((sizes > largest) & (not triangulate))


def _split(polygons, points, triangulate, progress):
    counts = numpy.maximum(polygons.sizes - 2, 0)
    triangles = numpy.empty((int(counts.sum()), 3), dtype=numpy.int64)
    mesh = _arrays.Mesh(points, numpy.empty((0, 3), dtype=numpy.int64))
    offsets = numpy.ascontiguousarray(polygons.offsets, dtype=numpy.int64)
    corners = numpy.ascontiguousarray(polygons.corners, dtype=numpy.int64)
    struct = _library.Polygons()
    _library.library().delaunayflip_polygons_init(struct)
    struct.number_of_polygons = polygons.count
    struct.offsets, struct.corners = _arrays.address(offsets), _arrays.address(corners)
    with Observers(progress).raising() as callbacks:
        _library.call("split_polygons", mesh.struct, struct, callbacks, _arrays.address(triangles))
    return _Part(polygons, triangles, counts, _stay(polygons.sizes, triangulate, 3), True)


def _split_strips(strips, triangulate):
    counts = numpy.maximum(strips.sizes - 2, 0)
    return _Part(strips, split_strips(strips), counts, _stay(strips.sizes, triangulate, 2), False)


def split_strips(strips):
    """(m, 3) the triangles of strips, which are Cells."""
    counts = numpy.maximum(strips.sizes - 2, 0)
    steps = numpy.arange(counts.sum()) - numpy.repeat(numpy.cumsum(counts) - counts, counts)
    first = numpy.repeat(strips.offsets[:-1], counts) + steps
    odd = steps % 2  # every other triangle of a strip is wound the other way
    places = numpy.stack([first + odd, first + 1 - odd, first + 2], axis=1)
    return strips.corners[places].astype(numpy.int64).reshape(-1, 3)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts a vtkPolyData to the engine's arrays, and back."""
import dataclasses

import numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray

from . import _arrays, _library, _vtk_arrays, _vtk_regions
from ._flip import smallest_angles
from ._vtk_arrays import Cells, make, make_ids, new_cells, view
from ._vtk_constraints import Constraints
from ._vtk_slots import NONE, Slots


@dataclasses.dataclass(frozen=True)
class Settings:
    """The properties that decide which edges exist and which stay."""

    triangulate: bool
    lines: bool
    insert_lines: bool
    insert_constraints: bool
    region_array: str


class MeshInput:
    """Arrays for a Session, and the parts of the input that the output needs. `copy_points`: the
    points may be moved in place while the session lives."""

    def __init__(self, mesh, others, settings, plan, copy_points=False):
        self.mesh = mesh.NewInstance()
        self.mesh.ShallowCopy(mesh)
        self.points = _vtk_arrays.view_points(mesh)
        if copy_points:
            self.points = self.points.copy()
        self.slots = Slots(mesh, self.points, settings.triangulate, plan.part("polygons"))
        self.constraints = Constraints(mesh, others, settings, self.points, self.slots.triangles)
        self.regions = None
        if settings.region_array:
            self.regions = _vtk_regions.label_cells(mesh, settings.region_array)[self.slots.cells]
        self.frozen = _vtk_regions.find_frozen(mesh, self.slots)

    def get_session_arguments(self):
        """Keyword arguments of a Session."""
        pairs = self.constraints.pairs
        return {
            "points": self.points, "triangles": self.slots.triangles, "regions": self.regions,
            "frozen": self.frozen, "constraints": pairs if len(pairs) else None,
            "insert_constraints": self.constraints.to_insert if len(pairs) else False,
            "triangle_numbers": self.slots.cells,
        }

    def describe_defects(self, of_engine, is_warm):
        """The text of a warning: the engine's, then those about this input's arrays. A warm start
        does not say again what the first run has said of constraints."""
        texts = [of_engine] if of_engine else []
        count = self.constraints.unmatched
        if count and not is_warm:
            edges = "edge" if count == 1 else "edges"
            texts.append(f"{count} constraint {edges} of the second input that the mesh does not have")
        passed = "passed unchanged"
        texts += _vtk_regions.describe_malformed_arrays(
            self.mesh, passed, passed if self.slots.in_place else "left out")
        return "; ".join(texts)

    def store(self, session, output):
        """Writes the current mesh."""
        mesh = self.mesh
        output.SetPoints(mesh.GetPoints())
        output.SetVerts(mesh.GetVerts())
        output.SetLines(mesh.GetLines())
        output.SetPolys(self._build_polygons(session))
        output.SetStrips(self._build_strips())
        output.GetPointData().ShallowCopy(mesh.GetPointData())
        output.GetFieldData().ShallowCopy(mesh.GetFieldData())
        self._pass_cell_data(output)
        self._renew_normals(output)

    def _uses_wide_ids(self):
        mesh = self.mesh
        cells = mesh.GetPolys() if mesh.GetNumberOfPolys() else mesh.GetStrips()
        wide = cells.GetConnectivityArray().GetDataTypeSize() == 8
        return wide or 3 * len(self.slots.triangles) > numpy.iinfo(numpy.int32).max

    def _build_polygons(self, session):
        slots = self.slots
        if slots.are_polygons_triangles:
            cells, corners = new_cells(numpy.full(len(slots.triangles), 3), self._uses_wide_ids())
            session.store_triangles(corners.reshape(-1, 3))
            return cells
        kept = Cells(self.mesh.GetPolys(), "cell", slots.first_polygon)
        is_triangle = slots.polygon_triangles != NONE
        sources = slots.polygon_cells - slots.first_polygon
        sizes = numpy.full(len(sources), 3)
        sizes[~is_triangle] = kept.sizes[sources[~is_triangle]]
        cells, corners = new_cells(sizes, self._uses_wide_ids())
        of_triangle = numpy.repeat(is_triangle, sizes)
        corners[of_triangle] = session.triangles[slots.polygon_triangles[is_triangle]].ravel()
        corners[~of_triangle] = gather(kept, sources[~is_triangle])
        return cells

    def _build_strips(self):
        strips, chosen = self.mesh.GetStrips(), self.slots.kept_strips - self.slots.first_strip
        if len(chosen) == strips.GetNumberOfCells():
            return strips
        if len(chosen) == 0:
            return vtkCellArray()
        kept = Cells(strips, "cell", self.slots.first_strip)
        cells, corners = new_cells(kept.sizes[chosen], kept.is_wide())
        corners[:] = gather(kept, chosen)
        return cells

    def _pass_cell_data(self, output):
        data = output.GetCellData()
        if self.slots.in_place:
            data.ShallowCopy(self.mesh.GetCellData())
            return
        sources = numpy.concatenate([numpy.arange(self.slots.first_polygon),
                                     self.slots.polygon_cells, self.slots.kept_strips])
        whole = take_whole_arrays(self.mesh)
        data.CopyAllOn()
        data.CopyAllocate(whole, len(sources))
        data.CopyData(whole, make_ids(sources), make_ids(numpy.arange(len(sources))))
        if self.slots.divides_cells:
            demote_global_ids(data)

    def _find_changed(self, output):
        """(polygons, old triangles, new triangles) of the polygons that flips have changed."""
        polygons = numpy.flatnonzero(self.slots.polygon_triangles != NONE)
        old = self.slots.triangles[self.slots.polygon_triangles[polygons]]
        cells = Cells(output.GetPolys(), "cell", 0)
        new = cells.corners[cells.offsets[polygons][:, None] + numpy.arange(3)]
        changed = (old != new).any(axis=1)
        return polygons[changed], old[changed], new[changed]

    def _renew_normals(self, output):
        """The normals of changed triangles. Normals that pointed against the winding still do."""
        shared = output.GetCellData().GetNormals()
        if (shared is None or shared.GetNumberOfComponents() != 3
                or shared.GetNumberOfTuples() < output.GetNumberOfCells()):
            return
        normals = _vtk_arrays.copy(shared)
        values = view(normals)
        polygons, old, new = self._find_changed(output)
        cells = self.slots.first_polygon + polygons
        against = (_find_normals(self.points, old) * values[cells]).sum(axis=1) < 0
        values[cells] = _find_normals(self.points, new) * numpy.where(against, -1.0, 1.0)[:, None]
        output.GetCellData().SetNormals(normals)

    def store_flip_counts(self, session, output):
        self._add_per_triangle(output, "vtkDelaunayFlipCount", session.flip_counts, 0)

    def store_angles(self, session, output):
        used = session.report.geometry_used
        for name, triangles in (("Before", self.slots.triangles), ("After", session.triangles)):
            angles = smallest_angles(self.points, triangles, geometry=used)
            self._add_per_triangle(output, "vtkDelaunayFlipAngle" + name, angles, numpy.nan)

    def _add_per_triangle(self, output, name, values, elsewhere):
        of_cells = numpy.full(output.GetNumberOfCells(), elsewhere, dtype=values.dtype)
        polygons = numpy.flatnonzero(self.slots.polygon_triangles != NONE)
        of_cells[self.slots.first_polygon + polygons] = values[
            self.slots.polygon_triangles[polygons]]
        output.GetCellData().AddArray(make(name, of_cells))


def gather(cells, chosen):
    """The corners of the chosen cells, one after the other."""
    sizes = cells.sizes[chosen]
    steps = numpy.arange(sizes.sum()) - numpy.repeat(numpy.cumsum(sizes) - sizes, sizes)
    return cells.corners[numpy.repeat(cells.offsets[chosen], sizes) + steps]


def _find_normals(points, triangles):
    """Unit normals by the right-hand rule; 0 for triangles without area."""
    mesh = _arrays.Mesh(points, triangles)
    normals = numpy.empty((len(triangles), 3))
    _library.call("triangle_normals", mesh.struct, _arrays.address(normals))
    return normals


def take_whole_arrays(mesh):
    """The cell data without arrays that are too short."""
    return _take_arrays(mesh.GetCellData(), mesh.GetNumberOfCells())


def take_whole_point_arrays(mesh):
    """The point data without arrays that are too short."""
    return _take_arrays(mesh.GetPointData(), mesh.GetNumberOfPoints())


def _take_arrays(data, tuples):
    whole = data.NewInstance()
    whole.ShallowCopy(data)
    for i in reversed(range(whole.GetNumberOfArrays())):
        if whole.GetAbstractArray(i).GetNumberOfTuples() < tuples:
            whole.RemoveArray(i)
    return whole


def demote_global_ids(data):
    """Global ids become pedigree ids: where cells are divided, several share an id."""
    ids = data.GetGlobalIds()
    if ids is not None:
        data.SetActiveAttribute(-1, data.GLOBALIDS)
        if data.GetPedigreeIds() is None:
            data.SetPedigreeIds(ids)

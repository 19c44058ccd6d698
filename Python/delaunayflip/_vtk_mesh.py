# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts a vtkPolyData to the engine's arrays, and back."""
from vtkmodules.vtkCommonCore import VTK_INT_MAX
from vtkmodules.vtkCommonDataModel import vtkCellArray

from . import _vtk_arrays, _vtk_regions
from ._surface import FlipInput
from ._vtk_arrays import is_wide, make, make_ids, new_cells, read_surface, view


class MeshInput(FlipInput):
    """Arrays for a Session, and the parts of the input that the output needs. `copy_points`: the
    points may be moved in place while the session lives."""

    def __init__(self, mesh, others, settings, plan, copy_points=False):
        self.mesh = mesh.NewInstance()
        self.mesh.ShallowCopy(mesh)
        surface = read_surface(mesh)
        if copy_points:
            surface.points = surface.points.copy()
        others = read_surface(others) if others is not None else None
        super().__init__(surface, others, settings, plan.part("polygons"))
        if settings.region_array:
            self.regions = _vtk_regions.label_cells(mesh, settings.region_array)[self.slots.cells]
        self.freeze(_vtk_regions.find_ghosts(mesh))

    def describe_defects(self, of_engine, is_warm):
        """The text of a warning: the engine's, then those about this input's arrays. A warm start
        does not say again what the first run has said of constraints."""
        texts = [of_engine] if of_engine else []
        texts += [] if is_warm else self.describe_unmatched()
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
        self._pass_normals(session, output)

    def _build_polygons(self, session):
        mesh = self.mesh
        given = mesh.GetPolys() if mesh.GetNumberOfPolys() else mesh.GetStrips()
        wide = is_wide(given) or 3 * len(self.slots.triangles) > VTK_INT_MAX
        cells, corners = new_cells(self.polygon_sizes, wide)
        self.fill_polygons(session, corners)
        return cells

    def _build_strips(self):
        strips, chosen = self.mesh.GetStrips(), self.slots.kept_strips - self.slots.strips.first
        if len(chosen) == strips.GetNumberOfCells():
            return strips
        if len(chosen) == 0:
            return vtkCellArray()
        cells, corners = new_cells(self.slots.strips.sizes[chosen], is_wide(strips))
        corners[:] = self.slots.strips.gather(chosen)
        return cells

    def _pass_cell_data(self, output):
        data = output.GetCellData()
        if self.slots.in_place:
            data.ShallowCopy(self.mesh.GetCellData())
            return
        sources = self.cell_sources
        whole = take_whole_arrays(self.mesh)
        data.CopyAllOn()
        data.CopyAllocate(whole, len(sources))
        data.CopyData(whole, make_ids(sources), make_ids(range(len(sources))))
        if self.slots.divides_cells:
            demote_global_ids(data)

    def _pass_normals(self, session, output):
        shared = output.GetCellData().GetNormals()
        if (shared is None or shared.GetNumberOfComponents() != 3
                or shared.GetNumberOfTuples() < output.GetNumberOfCells()):
            return
        normals = _vtk_arrays.copy(shared)
        self.renew_normals(view(normals), session.triangles)
        output.GetCellData().SetNormals(normals)

    def store_numbers(self, session, output, counts, angles):
        for name, values in self.list_numbers(session, counts, angles):
            output.GetCellData().AddArray(make(name, values))


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

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts meshes of any VTK to the engine's arrays, and back."""
import dataclasses

import numpy

from . import _arrays, _library
from ._library import InvalidMesh, InvalidOptions
from ._report import FIELD_PREFIX, Totals, describe_trouble
from ._session import Session, smallest_angles
from ._surface import NONE, Constraints, Slots
from ._vtk_data import (
    GHOST_ARRAY, add_attributes, demote_global_ids, describe_short, find_attributes, has_wide_ids, list_names,
    pass_points, vtk_of)

#: Keywords of MeshInput.
SETTINGS = ("triangulate", "lines_as_constraints", "insert_lines", "insert_constraints", "region_array",
            "size_array")
#: Names of cell arrays of results.
CELL_ARRAYS = (
    "vtkDelaunayFlipCount", "Smallest angle before (degrees)", "Smallest angle after (degrees)")
_GHOST = 1 | 8 | 32  # vtkDataSetAttributes.DUPLICATECELL, REFINEDCELL and HIDDENCELL


class _Session(Session):
    """A Session. Its messages name properties, as the engine does."""

    _keywords = ()


class MeshInput:
    """What a Session gets of a mesh, and the way back. `others`: the second input, or None. The
    keywords are properties of the filter."""

    def __init__(self, mesh, others, progress=None, *, triangulate=True, lines_as_constraints=True,
                 insert_lines=False, insert_constraints=True, region_array="", size_array="",
                 region_seeds=()):
        self.vtk, self.session_type = vtk_of(mesh), _Session
        self.mesh = self.vtk.model.vtkPolyData()
        self.mesh.ShallowCopy(mesh)
        others = self.vtk.read(others) if others is not None else None
        surface = self.vtk.read(mesh)
        self.points = surface.points
        self.slots = Slots(surface, triangulate, progress)
        self.constraints = Constraints(surface, others, self.slots.triangles, lines_as_constraints,
                                       insert_lines, insert_constraints)
        self._regions, self._frozen = None, self.slots.frozen
        if region_array:
            self._regions = self.vtk.label_cells(mesh, region_array)[self.slots.cells]
        self._sizes = self._read_sizes(size_array) if size_array else None
        self._region_seeds, self._splits_lines = region_seeds, lines_as_constraints
        ghosts = self.mesh.GetCellData().GetArray(GHOST_ARRAY)
        if ghosts is not None and not _find_ghost_fault(ghosts):
            missing = numpy.zeros(self.mesh.GetNumberOfCells(), numpy.uint8)  # there may be too few
            types = numpy.append(self.vtk.view(ghosts), missing)
            are_ghosts = (types[self.slots.cells] & _GHOST) != 0
            self._frozen = are_ghosts if self._frozen is None else are_ghosts | self._frozen

    def take_sizes(self, sizes):
        """Takes an array of the longest edge near each point."""
        self._sizes = sizes

    def _read_sizes(self, name):
        data = self.mesh.GetPointData()
        array = data.GetArray(name)
        if array is None:
            raise InvalidOptions(f'SizeArray: the input has no point array of numbers named "{name}"; '
                                 f"{list_names(data)}.")
        if array.GetNumberOfComponents() != 1 or array.GetNumberOfTuples() < len(self.points):
            raise InvalidOptions(f'SizeArray: "{name}" must have one component, and as many tuples as there '
                                 "are points.")
        return self.vtk.view(array)[:len(self.points)].astype(float)

    def open(self, **arguments):
        """Begins a Session, and returns it. Errors name the cell, not the triangle."""
        self._arguments = arguments
        try:
            self.session = self.session_type(
                self.points, self.slots.triangles, regions=self._regions, frozen=self._frozen,
                constraints=self.constraints.pairs, insert_constraints=self.constraints.to_insert,
                triangle_numbers=self.slots.cells, size=self._sizes,
                region_seeds=self._region_seeds, **arguments)
        except InvalidMesh:
            self.slots.polygons.require_points(len(self.points))
            raise
        self._refines = self.session._refines
        return self.session

    def sum_up(self):
        """The Totals of the run."""
        report = self.session.report
        report = dataclasses.replace(report, points=report.points + report.refinement_points)
        return Totals.of_run(report, self.session.iterations, self.constraints.unmatched)

    def report(self, output, totals):
        """Adds the numbers of the run to the output's field data. Returns the text of a warning, or ""."""
        self.vtk.add_arrays(output.GetFieldData(), FIELD_PREFIX, totals.list_fields())
        report, mesh, passed = self.session.report, self.mesh, "passed unchanged"
        texts = [report.defects] if report.defects else []
        if self.constraints.unmatched:
            stranger, count = self.constraints.first_stranger, self.constraints.unmatched
            texts.append(
                f"{count} constraint {'edge' if count == 1 else 'edges'} of the second input that the mesh "
                "does not have" + (stranger and ": ends are not points of the mesh (coordinates must be "
                                   f"equal, not just close), first {stranger}"))
        texts += self.slots.describe_no_triangles()
        texts += describe_short(mesh.GetPointData(), mesh.GetNumberOfPoints(), "point",
                                "left out" if report.refinement_points else passed)
        texts += describe_short(mesh.GetCellData(), mesh.GetNumberOfCells(), "cell",
                                passed if self.slots.in_place and not self._refines else "left out")
        ghosts = mesh.GetCellData().GetAbstractArray(GHOST_ARRAY)
        fault = _find_ghost_fault(ghosts) if ghosts is not None else ""
        texts += [f'1 ghost array {fault} ignored: "{GHOST_ARRAY}"'] if fault else []
        return "; ".join(texts + describe_trouble(report, **self._arguments))

    def store(self, output, counts, angles):
        """Writes the current mesh, with the requested cell arrays."""
        mesh, slots = self.mesh, self.slots
        self._list_polygons()
        given = mesh.GetPolys() if mesh.GetNumberOfPolys() else mesh.GetStrips()
        is_wide = has_wide_ids(given) or 3 * len(slots.triangles) > self.vtk.core.VTK_INT_MAX
        chosen = slots.kept_strips - slots.strips.first
        strips, corners = self.vtk.make_cells(slots.strips.sizes[chosen], has_wide_ids(mesh.GetStrips()))
        corners[:] = slots.strips.gather(chosen)
        self._pass_points(output)
        output.SetVerts(mesh.GetVerts())
        output.SetLines(self._split_lines() if self._refines and self._splits_lines else mesh.GetLines())
        output.SetPolys(self._make_polygons(is_wide))
        output.SetStrips(strips)
        self._pass_cell_data(output)
        polygons = numpy.flatnonzero(self._of_polygons != NONE)
        chosen = self._of_polygons[polygons]
        for name, elsewhere, values in self._list_numbers(counts, angles):
            of_cells = numpy.full(output.GetNumberOfCells(), elsewhere, dtype=values.dtype)
            of_cells[slots.first_polygon + polygons] = values[chosen]
            self.vtk.add_arrays(output.GetCellData(), "", [(name, of_cells)])

    def _list_polygons(self):
        """Finds, for each polygon of the output, its triangle or NONE, and the cell from which it is made;
        and for each triangle its source."""
        slots = self.slots
        self._of_polygons, self._cells = slots.polygon_triangles, slots.polygon_cells
        self._points, self._added = self.points, ((), ())
        self._sources = numpy.arange(len(slots.triangles))
        if self._refines:
            self._points, *self._added = self.session._read_points()
            self._sources = self.session.sources
            more = numpy.arange(len(slots.triangles), len(self._sources))
            self._of_polygons = numpy.concatenate([slots.polygon_triangles, more])
            self._cells = numpy.concatenate([slots.polygon_cells, more])
            is_triangle = self._of_polygons != NONE
            self._cells[is_triangle] = slots.cells[self._sources[self._of_polygons[is_triangle]]]

    def _pass_points(self, output):
        """Passes the points and those that refinement has added, with their data."""
        mesh, count = self.mesh, len(self.points)
        pass_points(mesh, output)
        if len(self._points) == count:
            return
        points = self.vtk.core.vtkPoints()
        points.SetData(self.vtk.support.numpy_to_vtk(self._points, deep=True))
        output.SetPoints(points)
        data = output.GetPointData()
        data.Initialize()
        self.vtk.add_tuples(mesh.GetPointData(), count, range(count), 0, len(self._points), data)
        self.vtk.interpolate_tuples(data, count, *self._added)
        demote_global_ids(data)

    def _split_lines(self):
        """The lines of the mesh, with the points that refinement has added on edges along them."""
        lines, on_edges = self.mesh.GetLines(), {}
        for number, (near, share) in enumerate(zip(*self._added), len(self.points)):
            if near[2] < 0:
                ends = int(near[0]), int(near[1])
                is_forward = ends[0] < ends[1]
                on_edges.setdefault((min(ends), max(ends)), []).append(
                    (share[1] if is_forward else 1.0 - share[1], number))
        if not on_edges or lines.GetNumberOfCells() == 0:
            return lines
        split, ids = self.vtk.model.vtkCellArray(), self.vtk.core.vtkIdList()
        for line in range(lines.GetNumberOfCells()):
            lines.GetCellAtId(line, ids)
            corners = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
            path = corners[:1]
            for start, end in zip(corners, corners[1:]):
                between = [number for _, number in sorted(on_edges.get((min(start, end), max(start, end)), ()))]
                path += [*(between if start < end else reversed(between)), end]
            split.InsertNextCell(len(path))
            for point in path:
                split.InsertCellPoint(point)
        return split

    def _make_polygons(self, is_wide):
        slots = self.slots
        is_triangle = self._of_polygons != NONE
        whole = self._cells[~is_triangle] - slots.first_polygon
        sizes = numpy.full(len(is_triangle), 3)
        sizes[~is_triangle] = slots.polygons.sizes[whole]
        cells, corners = self.vtk.make_cells(sizes, is_wide)
        if len(whole) == 0 and len(sizes) == len(self._sources):
            self.session.store_triangles(corners.reshape(-1, 3))
        else:
            of_triangle = numpy.repeat(is_triangle, sizes)
            triangles = self.session.triangles[self._of_polygons[is_triangle]]
            corners[of_triangle] = triangles.ravel()
            corners[~of_triangle] = slots.polygons.gather(whole)
        return cells

    def _pass_cell_data(self, output):
        mesh, data, slots = self.mesh, output.GetCellData(), self.slots
        data.Initialize()
        if slots.in_place and not self._refines:
            data.ShallowCopy(mesh.GetCellData())
        else:
            sources = numpy.concatenate(
                [numpy.arange(slots.first_polygon), self._cells, slots.kept_strips])
            self.vtk.add_tuples(
                mesh.GetCellData(), mesh.GetNumberOfCells(), sources, 0, len(sources), data)
        if slots.divides_cells or len(self._sources) > len(slots.triangles):
            demote_global_ids(data)
        shared = data.GetNormals()
        if (shared is not None and shared.GetNumberOfComponents() == 3
                and shared.GetNumberOfTuples() >= output.GetNumberOfCells()):
            normals = self.vtk.copy_array(shared)
            self._renew_normals(self.vtk.view(normals), self.session.triangles)
            attributes = find_attributes(data, shared)
            add_attributes(data, data.SetNormals(normals), attributes)

    def _renew_normals(self, values, triangles):
        """Writes the normals of changed triangles to those of all output cells. Normals that pointed
        against the winding still do."""
        polygons = numpy.flatnonzero(self._of_polygons != NONE)
        chosen, before = self._of_polygons[polygons], self.slots.triangles[self._sources]
        changed = (before[chosen] != triangles[chosen]).any(axis=1)
        cells, chosen = self.slots.first_polygon + polygons[changed], chosen[changed]
        old, new = (self._find_normals(some[chosen]) for some in (before, triangles))
        against = (old * values[cells]).sum(axis=1) < 0
        values[cells] = new * numpy.where(against, -1.0, 1.0)[:, None]

    def _find_normals(self, triangles):
        """Unit normals by the right-hand rule; 0 for triangles without area."""
        mesh = _arrays.Mesh(self._points, triangles)
        normals = numpy.empty((len(triangles), 3))
        _library.call("triangle_normals", mesh.struct, _arrays.address(normals))
        return normals

    def _list_numbers(self, counts, angles):
        """(name, value elsewhere, values per triangle) of the requested cell arrays."""
        if len(self._region_seeds):
            yield "Region", 0, self.session.regions
        if counts:
            yield CELL_ARRAYS[0], 0, self.session.flip_counts
        if angles:
            used = self.session.report.geometry_used
            before = smallest_angles(self.points, self.slots.triangles, geometry=used)
            after = smallest_angles(self._points, self.session.triangles, geometry=used)
            yield CELL_ARRAYS[1], numpy.nan, before[self._sources]
            yield CELL_ARRAYS[2], numpy.nan, after


def _find_ghost_fault(ghosts):
    """Why a ghost array is ignored, or ""."""
    if ghosts.GetDataTypeAsString() != "unsigned char":
        return "that is not of type unsigned char"
    return "with several components" if ghosts.GetNumberOfComponents() != 1 else ""

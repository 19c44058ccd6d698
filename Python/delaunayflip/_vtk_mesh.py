# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Converts meshes, points and segments of any VTK to the engine's arrays, and back."""
import dataclasses
import functools
import importlib
import itertools

import numpy

from . import _arrays, _library
from ._library import InvalidMesh, InvalidOptions
from ._points import Input, interpolate_in_survey
from ._report import FIELD_PREFIX, POINT_NUMBERS, Totals, describe_trouble, join
from ._session import Session, smallest_angles
from ._sphere import find_misplaced, place_on_sphere
from ._surface import NONE, Constraints, Slots, Surface, join_corners, number_places, number_tuples

#: Keywords of MeshInput.
SETTINGS = ("triangulate", "lines_as_constraints", "insert_lines", "insert_constraints", "region_array",
            "size_array")
#: Names of cell arrays of results.
CELL_ARRAYS = (
    "vtkDelaunayFlipCount", "Smallest angle before (degrees)", "Smallest angle after (degrees)")
HEIGHTS = None, "survey", "own"  #: SegmentHeights
HEIGHT_ARRAY = "Height"  #: That of z of longitudes, latitudes and heights.
_GHOSTS = "vtkGhostType"
_GHOST = 1 | 8 | 32  # vtkDataSetAttributes.DUPLICATECELL, REFINEDCELL and HIDDENCELL


class Vtk:
    """The modules and arrays of one VTK. PyVista may use another one than vtkmodules."""

    def __init__(self, package):
        self.core = importlib.import_module(f"{package}.vtkCommonCore")
        self.model = importlib.import_module(f"{package}.vtkCommonDataModel")
        self.support = importlib.import_module(f"{package}.util.numpy_support")

    def add_arrays(self, data, prefix, arrays):
        """`arrays`: (name, values, a number or a text) of each; None removes it."""
        for name, values in arrays:
            if values is None:
                data.RemoveArray(prefix + name)
                continue
            if isinstance(values, str):
                array = self.core.vtkStringArray()
                array.InsertNextValue(values)
            else:
                values = numpy.atleast_1d(values)
                kind = self.core.VTK_ID_TYPE if values.dtype == numpy.int64 else None
                array = self.support.numpy_to_vtk(values, deep=True, array_type=kind)
            array.SetName(prefix + name)
            data.AddArray(array)

    def add_tuples(self, own, count, sources, first, size, data):
        """Copies the tuples `sources` of the arrays of `own` that have at least `count` to those of
        `data`, which have `size` tuples, from `first` on, as AddTuples does in C++."""
        ids, places = self.core.vtkIdList(), self.core.vtkIdList()
        for place, source in enumerate(sources, first):
            ids.InsertNextId(int(source))
            places.InsertNextId(place)
        taken = []
        for array in _list_arrays(own):
            if array.GetNumberOfTuples() < count:
                continue
            target, name = _find_array(data, array, taken)
            if target is None:
                target = self.core.vtkAbstractArray.CreateArray(array.GetDataType())
                target.SetName(name)
                target.SetNumberOfComponents(array.GetNumberOfComponents())
                target.SetNumberOfTuples(size)
                target.CopyComponentNames(array)
                target.CopyInformation(array.GetInformation())
                if hasattr(target, "Fill"):
                    target.Fill(0)
                    target.SetLookupTable(array.GetLookupTable())
                _add_attributes(data, data.AddArray(target), _find_attributes(own, array))
            taken.append(target)
            target.InsertTuples(places, ids, array)

    def interpolate_tuples(self, data, first, ids, weights):
        """Writes the tuples of added points, from `first` on, interpolated between those of two or three
        other points. Labels of points are not interpolated."""
        labels = data.GetGlobalIds(), data.GetPedigreeIds(), data.GetAbstractArray(_GHOSTS)
        corners = self.core.vtkIdList()
        corners.SetNumberOfIds(3)
        for array in _list_arrays(data):
            if _is_among(array, labels):
                continue
            for place, (near, share) in enumerate(zip(ids.tolist(), weights.tolist()), first):
                if near[2] < 0:
                    array.InterpolateTuple(place, near[0], array, near[1], array, share[1])
                    continue
                for k in range(3):
                    corners.SetId(k, near[k])
                array.InterpolateTuple(place, corners, array, share)

    def read(self, mesh):
        """A Surface. Its arrays are copies: observers may change the input during the run."""
        return Surface(mesh, lambda array: self.view(array).copy())

    def view(self, array):
        """The values of a vtkDataArray, (n,) or (n, components)."""
        if not array.HasStandardMemoryLayout() or isinstance(array, self.core.vtkBitArray):
            array = self.copy_array(array)
        if array.GetNumberOfValues() == 0:
            width, kind = array.GetNumberOfComponents(), array.GetDataType()
            return numpy.empty((0, width) if width > 1 else 0, self.support.get_numpy_array_type(kind))
        return self.support.vtk_to_numpy(array)

    def copy_array(self, array):
        """A deep copy in contiguous memory, of the same type (bits become bytes)."""
        is_bits = isinstance(array, self.core.vtkBitArray)
        plain = self.core.vtkDataArray.CreateDataArray(
            self.core.VTK_UNSIGNED_CHAR if is_bits else array.GetDataType())
        plain.DeepCopy(array)
        return plain

    def make_cells(self, sizes, is_wide):
        """A vtkCellArray for cells of these sizes, and a view of its connectivity to be filled in."""
        kind = self.core.vtkTypeInt64Array if is_wide else self.core.vtkTypeInt32Array
        offsets, corners, ends = kind(), kind(), numpy.append(0, numpy.cumsum(sizes))
        offsets.SetNumberOfValues(len(ends))
        self.view(offsets)[:] = ends
        corners.SetNumberOfValues(int(ends[-1]))
        cells = self.model.vtkCellArray()
        cells.SetData(offsets, corners)
        return cells, self.view(cells.GetConnectivityArray())

    def label_cells(self, mesh, name):
        """One int32 label per cell; cells with equal tuples in the array have equal labels.

        Raises:
            InvalidOptions: There is no such array, or it does not have one tuple per cell.
        """
        array = mesh.GetCellData().GetAbstractArray(name)
        if array is None:
            raise InvalidOptions(f'RegionArray: the input has no cell array named "{name}"; '
                                 f"{list_names(mesh.GetCellData())}.")
        if array.GetNumberOfTuples() != mesh.GetNumberOfCells():
            raise InvalidOptions(
                f'RegionArray: "{name}" must have as many tuples as the mesh has cells.')
        if isinstance(array, self.core.vtkDataArray):
            return number_tuples(self.view(array))
        texts = [array.GetVariantValue(i).ToString() for i in range(array.GetNumberOfValues())]
        return number_tuples(numpy.array(texts).reshape(mesh.GetNumberOfCells(), -1))


def pass_points(data, output):
    """Passes points with their data, and the field data."""
    output.SetPoints(data.GetPoints())
    output.GetPointData().ShallowCopy(data.GetPointData())
    output.GetFieldData().ShallowCopy(data.GetFieldData())


def place_points(data):
    """Takes x and y of a dataset's points as longitudes and latitudes. Returns a copy with their places on
    the unit sphere, and the text of a warning, or ""."""
    made, vtk = data.NewInstance(), vtk_of(data)
    made.ShallowCopy(data)
    if data.GetPoints() is None:
        return made, ""
    mesh, points = vtk.model.vtkPolyData(), vtk.core.vtkPoints()
    mesh.SetPoints(data.GetPoints())
    degrees = vtk.read(mesh).points[:, :2]
    points.SetData(vtk.support.numpy_to_vtk(place_on_sphere(degrees), deep=True))
    made.SetPoints(points)
    return made, describe_latitudes(degrees[:, 1])


def describe_latitudes(latitudes):
    """The text of a warning about latitudes beyond 90 degrees, or ""."""
    ids = find_misplaced(latitudes)
    if not len(ids):
        return ""
    return (f"{len(ids)} point{'s' * (len(ids) > 1)} with a latitude beyond 90 degrees (first: {ids[0]}); "
            "x is the longitude and y the latitude")


def keep_heights(given, name, data, always=False):
    """Adds z of the points of a dataset to point data, as an array. If z = 0 throughout, only if `always`.
    Returns the text of a warning if there is such an array already, or ""."""
    if given.GetPoints() is None:
        return ""
    vtk, mesh = vtk_of(given), vtk_of(given).model.vtkPolyData()
    mesh.SetPoints(given.GetPoints())
    heights = vtk.read(mesh).points[:, 2].astype(float)
    if not (always or numpy.nan_to_num(heights, posinf=0, neginf=0).any()):
        return ""
    if data.HasArray(name):
        return f'z left out, because the points have an array "{name}"'
    array = vtk.support.numpy_to_vtk(heights, True)
    array.SetName(name)
    _add_attributes(data, data.AddArray(array), [data.SCALARS])
    return ""


_load = functools.lru_cache(maxsize=None)(Vtk)


def vtk_of(data):
    """The Vtk of a data object."""
    module = next(cls.__module__ for cls in type(data).__mro__ if cls.__name__ == "vtkDataObject")
    return _load(module.rpartition(".")[0])


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
        ghosts = self.mesh.GetCellData().GetArray(_GHOSTS)
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
        texts += _describe_short(mesh.GetPointData(), mesh.GetNumberOfPoints(), "point",
                                "left out" if report.refinement_points else passed)
        texts += _describe_short(mesh.GetCellData(), mesh.GetNumberOfCells(), "cell",
                                passed if self.slots.in_place and not self._refines else "left out")
        ghosts = mesh.GetCellData().GetAbstractArray(_GHOSTS)
        fault = _find_ghost_fault(ghosts) if ghosts is not None else ""
        texts += [f'1 ghost array {fault} ignored: "{_GHOSTS}"'] if fault else []
        return "; ".join(texts + describe_trouble(report, **self._arguments))

    def store(self, output, counts, angles):
        """Writes the current mesh, with the requested cell arrays."""
        mesh, slots = self.mesh, self.slots
        self._list_polygons()
        given = mesh.GetPolys() if mesh.GetNumberOfPolys() else mesh.GetStrips()
        is_wide = _is_wide(given) or 3 * len(slots.triangles) > self.vtk.core.VTK_INT_MAX
        chosen = slots.kept_strips - slots.strips.first
        strips, corners = self.vtk.make_cells(slots.strips.sizes[chosen], _is_wide(mesh.GetStrips()))
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
        _demote_global_ids(data)

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
            _demote_global_ids(data)
        shared = data.GetNormals()
        if (shared is not None and shared.GetNumberOfComponents() == 3
                and shared.GetNumberOfTuples() >= output.GetNumberOfCells()):
            normals = self.vtk.copy_array(shared)
            self._renew_normals(self.vtk.view(normals), self.session.triangles)
            attributes = _find_attributes(data, shared)
            _add_attributes(data, data.SetNormals(normals), attributes)

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
        if self._region_seeds:
            yield "Region", 0, self.session.regions
        if counts:
            yield CELL_ARRAYS[0], 0, self.session.flip_counts
        if angles:
            used = self.session.report.geometry_used
            before = smallest_angles(self.points, self.slots.triangles, geometry=used)
            after = smallest_angles(self._points, self.session.triangles, geometry=used)
            yield CELL_ARRAYS[1], numpy.nan, before[self._sources]
            yield CELL_ARRAYS[2], numpy.nan, after


class Cloud(Input):
    """The points of a dataset, and those of its segments, for `triangulate`; and the way back."""

    def __init__(self, data, others=None, *, lines_as_segments=False, closed_lines_as_rings=True,
                 pass_segments=False, first_hole=-1, heights=None, height_array="", as_doubles=False,
                 size_array="", backend=None, projection=0, **rings):
        """`others`: the second input of the filter, or pairs of point ids. `heights`: SegmentHeights.
        `height_array`: where those of segments are not finite, they become those of the points there.
        `pass_segments`: whether the mesh gets the edges along segments. `as_doubles`: whether data become
        doubles, so that those of added points are not rounded. `size_array`: SizeArray. `projection`: that
        of the struct. `backend`: keywords that say where data are found. `rings`: outline, holes,
        hole_seeds and ring_rule, as for triangulate."""
        self.vtk, self.data = vtk_of(data), data
        mesh = self.vtk.model.vtkPolyData()
        mesh.SetPoints(data.GetPoints())
        if lines_as_segments and data.IsA("vtkPolyData"):
            mesh.SetVerts(data.GetVerts())  # so that lines have their cell ids
            mesh.SetLines(data.GetLines())
        own = self.vtk.read(mesh)
        self._own, self._sources, self._pairs, self._numbers, self._cells = own.points, [], [], [], []
        self._others, self._passes_segments = others, pass_segments
        if hasattr(others, "GetPolys"):
            self._first_own = others.GetNumberOfCells()
        else:
            self._first_own = 0 if others is None else len(others)
        self._first_ring = self._first_own + mesh.GetNumberOfCells()
        self._add_cells(own.read("Lines", "line, cell"), numpy.arange(len(own.points)), False)
        if hasattr(others, "GetPolys"):
            theirs = self.vtk.read(others)
            ids = self._add_points(theirs.points)
            self._add_cells(theirs.read("Lines", "segment cell"), ids, closed_lines_as_rings)
            self._add_cells(theirs.read("Polys", "segment cell"), ids, are_polygons=True)
        elif others is not None:
            self._pairs.append(_arrays.as_ids("segments", others, 2))
            self._numbers.append(numpy.full(len(self._pairs[-1]), -1))
            self._cells.append(numpy.arange(len(self._pairs[-1])))
        self._cells[0] += self._first_own
        super().__init__(self._own, numpy.concatenate(self._pairs),
                         ring_numbers=numpy.concatenate(self._numbers), **rings)
        if first_hole >= 0:
            self.struct.first_hole = min(first_hole, numpy.iinfo(numpy.int32).max)
        self.struct.first_added = data.GetNumberOfPoints()
        own = len(self._pairs[0])
        self.find_flat_points(
            data.GetNumberOfPoints(), self.all_segments[own:], self.all_rings[own:])
        self.take_projection(projection)
        self._surveyed = []  # (name, ids, values) of each array of added points
        self._read_data = self._as_doubles if as_doubles else lambda data: data
        self._choose_heights(heights, height_array, backend or {})
        if size_array:
            self._read_sizes(size_array)

    def _choose_heights(self, heights, height_array, backend):
        """Gives added points the heights that are asked for, and data in arrays that the segments do not
        have, interpolated between the points of the dataset."""
        count, data = self.data.GetNumberOfPoints(), self.data.GetPointData()
        added = numpy.arange(count, len(self.points))
        if heights == "survey" and self.struct.projection:
            raise InvalidOptions("SegmentHeights: the heights of the survey are for x and y; with another "
                                 "projection choose Own")
        lifted = self.choose_lifted(heights, added)
        theirs = self._others.GetPointData() if hasattr(self._others, "GetPointData") else None
        labels = data.GetGlobalIds(), data.GetPedigreeIds(), data.GetAbstractArray(_GHOSTS)
        names = [array.GetName() for array in _list_arrays(data)
                 if array.GetName() and array.IsNumeric() and array.GetNumberOfTuples() >= count
                 and not _is_among(array, labels)
                 and (array.GetName() == height_array or not (theirs and theirs.HasArray(array.GetName())))]
        if count == 0 or len(added) == 0 or not (len(lifted) or names):
            return
        columns = [self.points[:count, 2:]]
        columns += [self.vtk.view(data.GetArray(name))[:count].reshape(count, -1) for name in names]
        values = numpy.concatenate([column.astype(float) for column in columns], axis=1)
        found = interpolate_in_survey(
            self.points[:count], values, self.points[added], backend, self.struct.projection)
        if found is None:
            return
        self.points[lifted, 2] = found[lifted - count, 0]
        ends = numpy.cumsum([column.shape[1] for column in columns])
        self._surveyed = list(zip(names, itertools.repeat(added), numpy.split(found, ends, axis=1)[1:]))
        self.are_lifted = len(lifted) > 0

    def _read_sizes(self, name):
        """Finds the longest edges near points. Near those that have no number there is no limit."""
        own, count = self.data.GetPointData(), self.data.GetNumberOfPoints()
        theirs = self._others.GetPointData() if len(self._sources) else None
        arrays = [data.GetArray(name) for data in (own, theirs) if data and data.GetArray(name)]
        if not arrays:
            raise InvalidOptions(f'SizeArray: the input has no point array of numbers named "{name}"; '
                                 f"{list_names(own)}.")
        if any(array.GetNumberOfComponents() != 1 for array in arrays) or (
                own.GetArray(name) and own.GetArray(name).GetNumberOfTuples() < count):
            raise InvalidOptions(f'SizeArray: "{name}" must have one component, and as many tuples as there '
                                 "are points.")
        sizes = numpy.full(len(self.points), numpy.nan)
        if own.GetArray(name):
            sizes[:count] = self.vtk.view(own.GetArray(name))[:count]
        if theirs and theirs.GetArray(name):
            sizes[count:] = self.vtk.view(theirs.GetArray(name))[self._sources]
        for surveyed, ids, values in self._surveyed:
            if surveyed == name:
                sizes[ids] = values[:, 0]
        self.take_sizes(sizes)

    def _add_cells(self, cells, ids, closed_lines_as_rings=False, are_polygons=False):
        cells.require_points(len(ids))
        is_ring = numpy.full(cells.count, are_polygons)
        returns = is_ring.copy()
        if closed_lines_as_rings or are_polygons:
            some = numpy.flatnonzero(cells.sizes > 0)
            first, last = (ids[cells.corners[ends]] for ends in (
                cells.offsets[some], cells.offsets[some] + cells.sizes[some] - 1))
            if are_polygons:  # without those that end where they begin
                returns[some] = (first != last) | (cells.sizes[some] == 1)
            else:
                is_ring[some] = ((first == last) | (self._own[first] == self._own[last]).all(axis=1)) & (
                    cells.sizes[some] > 2)
        pairs = ids[join_corners(cells, returns)]
        ids_of_cells = cells.first + numpy.arange(cells.count)
        counts = numpy.maximum(cells.sizes - ~returns, 0)
        numbers = numpy.repeat(numpy.where(is_ring, ids_of_cells, -1), counts)
        kept = (pairs[:, 0] != pairs[:, 1]) | (numbers >= 0)
        self._pairs.append(pairs[kept])
        self._numbers.append(numbers[kept])
        self._cells.append(numpy.repeat(ids_of_cells, counts)[kept])

    def _add_points(self, others):
        """The ids of the points of the segments; those at new places are added."""
        own = self._own if len(self._own) else others[:0]  # of the same type
        if len(others) == 0 or own.dtype == others.dtype and own.tobytes() == others.tobytes():
            return numpy.arange(len(own))
        places = numpy.concatenate(number_places(own, others))
        _, first, place = numpy.unique(places, return_index=True, return_inverse=True)
        ids = first[place.ravel()[len(own):]]
        is_new = ids >= len(own)
        self._sources, ranks = numpy.unique(ids[is_new] - len(own), return_inverse=True)
        ids[is_new] = len(own) + ranks.ravel()
        with numpy.errstate(over="ignore"):
            self._own = numpy.concatenate([own, others[self._sources].astype(own.dtype)])
        return ids

    def write(self, result, output):
        """Writes the mesh, with its data and its counts. Returns the text of a warning, or ""."""
        data, vtk, report = self.data, self.vtk, result.report
        count, is_grown = data.GetNumberOfPoints(), len(result.points) > data.GetNumberOfPoints()
        polygons, corners = vtk.make_cells(numpy.full(len(result.triangles), 3), is_wide=True)
        corners[:] = result.triangles.ravel()
        output.SetPolys(polygons)
        pass_points(data, output)
        if is_grown:
            points = vtk.core.vtkPoints()
            points.SetData(vtk.support.numpy_to_vtk(result.points, deep=True))
            output.SetPoints(points)
            self._extend_data(output.GetPointData(), count)
        lines = numpy.empty(0, dtype=numpy.int32)
        if self._passes_segments:
            self._write_segments(result, output)
            lines = numpy.zeros(len(result.segments), dtype=numpy.int32)
        if self.struct.number_of_regions:
            regions = numpy.concatenate([lines, result.regions])
            vtk.add_arrays(output.GetCellData(), "", [("Region", regions)])
        totals = Totals.of_run(report, result.iterations)
        vtk.add_arrays(output.GetFieldData(), FIELD_PREFIX,
                       [*totals.list_numbers(POINT_NUMBERS), *totals.list_fields()])
        texts = [report.defects] if report.defects else []
        texts += _describe_short(data.GetPointData(), count, "point",
                                "left out" if is_grown else "passed unchanged")
        if len(self._sources):
            texts += _describe_short(self._others.GetPointData(), self._others.GetNumberOfPoints(),
                                     "point", "left out", " of the second input")
        return "; ".join(texts)

    def _write_segments(self, result, output):
        """Writes the edges that segments have become, as lines, and the ids of their cells. Rings that are
        no cells have the next numbers."""
        given = sum(map(len, self._cells))
        first_ring = self.all_rings[:given].max(initial=-1) + 1
        ids = numpy.concatenate([*self._cells, self._first_ring + self.all_rings[given:] - first_ring, [-1]])
        lines, ends = self.vtk.make_cells(numpy.full(len(result.segments), 2), is_wide=True)
        ends[:] = result.segments.ravel()
        output.SetLines(lines)
        triangles = numpy.full(len(result.triangles), -1)
        of_cells = numpy.concatenate([ids[result.segment_numbers], triangles])
        self.vtk.add_arrays(output.GetCellData(), "", [("SegmentIds", of_cells)])
        self.vtk.add_arrays(output.GetPointData(), "", [("SegmentIds", ids[result.point_segments])])

    def _as_doubles(self, data):
        """A copy with arrays of doubles for those of integers, so that what is interpolated is not
        rounded."""
        copy = self.vtk.model.vtkPointData()
        copy.ShallowCopy(data)
        labels = copy.GetGlobalIds(), copy.GetPedigreeIds(), copy.GetAbstractArray(_GHOSTS)
        for array in _list_arrays(copy):
            if array.GetName() and array.IsNumeric() and not _is_among(array, labels) and (
                    array.GetDataType() not in (self.vtk.core.VTK_FLOAT, self.vtk.core.VTK_DOUBLE)):
                doubles = self.vtk.core.vtkDoubleArray()
                doubles.DeepCopy(array)
                attributes = _find_attributes(copy, array)
                _add_attributes(copy, copy.AddArray(doubles), attributes)
        return copy

    def _extend_data(self, data, count):
        """The point data, extended by those of added points."""
        size = len(self.points) + len(self.added[0])
        data.Initialize()
        own = self._read_data(self.data.GetPointData())
        self.vtk.add_tuples(own, count, range(count), 0, size, data)
        theirs = None
        if len(self._sources):
            theirs = self._read_data(self._others.GetPointData())
            self.vtk.add_tuples(
                theirs, self._others.GetNumberOfPoints(), self._sources, count, size, data)
        for name, ids, values in self._surveyed:
            numbers = self.vtk.view(data.GetArray(name))
            if numbers.dtype.kind != "f":
                values = numpy.nan_to_num(numpy.trunc(values + numpy.copysign(0.5, values)))
            rows = numbers.reshape(size, -1)
            is_known = numpy.isfinite(rows[ids])
            is_known[len(self._sources) if theirs and theirs.HasArray(name) else 0:] = False
            rows[ids] = numpy.where(is_known, rows[ids], values)
        self.vtk.interpolate_tuples(data, len(self.points), *self.added)
        _demote_global_ids(data)


def _list_arrays(data):
    return [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]


def list_names(data):
    """The names of arrays in a message."""
    names = [f'"{array.GetName() or ""}"' for array in _list_arrays(data)]
    return f"it has {', '.join(names) or 'none'}"


def _is_among(array, others):
    """By identity: arrays of VTK 9.7 compare their values, as those of NumPy do."""
    return any(array is other for other in others)


def _find_array(data, like, taken):
    """The array of `data` for tuples of another one, or None, and its name: see AddTuples in C++."""
    def fits(array):
        return not _is_among(array, taken) and (array.GetDataType(), array.GetNumberOfComponents()) == (
            like.GetDataType(), like.GetNumberOfComponents())

    name = like.GetName() or ""
    while True:
        found = [array for array in _list_arrays(data)
                 if (array.GetName() or "") == name and (name or fits(array))]
        if not found or fits(found[0]):
            return found[0] if found else None, name or None
        name += " (2)"


def _find_attributes(data, array):
    return [kind for kind in range(data.NUM_ATTRIBUTES) if data.GetAbstractAttribute(kind) is array]


def _add_attributes(data, number, attributes):
    """Makes an array these attributes, except those that `data` has."""
    for kind in attributes:
        if data.GetAbstractAttribute(kind) is None:
            data.SetActiveAttribute(number, kind)


def _demote_global_ids(data):
    """Global ids become pedigree ids, because several cells or points now share one."""
    ids = data.GetGlobalIds()
    if ids is not None:
        data.SetActiveAttribute(-1, data.GLOBALIDS)
        number = [array is ids for array in _list_arrays(data)].index(True)
        _add_attributes(data, number, [data.PEDIGREEIDS])


def _is_wide(cells):
    return cells.GetConnectivityArray().GetDataTypeSize() == 8


def _find_ghost_fault(ghosts):
    """Why a ghost array is ignored, or ""."""
    if ghosts.GetDataTypeAsString() != "unsigned char":
        return "that is not of type unsigned char"
    return "with several components" if ghosts.GetNumberOfComponents() != 1 else ""


def _describe_short(data, tuples, kind, fate, where=""):
    names = [array.GetName() or "" for array in _list_arrays(data)
             if array.GetNumberOfTuples() < tuples]
    if not names:
        return []
    listed = join([f'"{name}"' for name in names], ", ")
    word = "array" if len(names) == 1 else "arrays"
    return [f"{len(names)} {kind} {word}{where} with too few tuples {fate}: {listed}"]

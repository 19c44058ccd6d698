# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for PyVista.

With PyVista 0.48 or newer, and if this package is installed, every PolyData has an accessor:

    better = mesh.delaunay.flip()
    better.delaunay.plot_quality()
    mesh.delaunay.animate("flips.gif")
    heights = cloud.delaunay.interpolate(image)["Elevation"]

With an older PyVista, or in a build folder, call the functions of this module with the mesh as
first argument: `delaunayflip.pyvista.flip(mesh)`.

Meshes go to the engine as arrays, so it does not matter which VTK PyVista uses (vtk or cvista).
"""
import contextlib
import inspect
import math
import types
import typing
import warnings

import numpy
import pyvista

from ._arrays import as_plane
from ._ask import Field, Method, Outside, halve, read_places
from ._library import InvalidOptions, Stopped
from ._session import Region, Session, smallest_angles as _angles_of_arrays
from ._options import (
    Array, Numbers, OnIteration, Progress, Unpack, check_integer, choose, make_options, show)
from ._options import Options as _Options
from ._points import Heights, run_points
from ._points import triangulate as _triangulate_arrays
from ._rings import RingRule, Rings, list_rings
from ._sphere import place_on_sphere
from ._surface import Slots
from ._vtk_data import HEIGHT_ARRAY, keep_heights, place_points, vtk_of
from ._vtk_mesh import SETTINGS, MeshInput
from ._vtk_points import PointsInput

_POINTS_OPTIONS = ("hole_seeds", "ring_rule", "lines_as_segments", "closed_lines_as_rings")
#: In the order of the numbers in the engine.
Projection = typing.Literal["xy", "sphere", "open-sphere"]
_ELEVATION = "Elevation"  # The array of z of what is interpolated.
_QUALITY = "Smallest angle"
_COLORS = ["#b2182b", "#ef8a62", "#fddbc7", "#d1e5f0", "#67a9cf", "#2166ac"]  # of AngleColors.json
_LOOK = {"scalars": _QUALITY, "clim": (0.0, 60.0), "cmap": _COLORS, "show_edges": True,
         # The title ends its line, so that it is above the labels.
         "scalar_bar_args": {"title": "Smallest angle (degrees)\n", "fmt": "%.0f", "n_labels": 7}}


class Options(_Options, total=False):
    """Keywords of `flip`; see there and at delaunayflip.flip."""

    region_array: str
    region_seeds: "typing.Sequence[Region]"
    lines_as_constraints: bool
    insert_lines: bool
    insert_constraints: bool
    triangulate: bool
    size: typing.Union[None, str, Numbers]


def flip(
    mesh: "pyvista.PolyData", *, constraints: "typing.Optional[pyvista.PolyData]" = None,
    flip_counts: bool = False, quality: bool = False, progress: "typing.Optional[Progress]" = None,
    on_iteration: "typing.Optional[OnIteration]" = None, **options: "Unpack[Options]",
) -> "pyvista.PolyData":
    """A Delaunay mesh of the same points, with the attributes of the mesh.

    Quads, polygons and strips become triangles; lines of the mesh are constraints.

    Args:
        mesh: Any PolyData; it is not changed.
        constraints: Lines and polygons. Their edges stay, and are inserted where the mesh is planar.
        flip_counts: Add the cell array vtkDelaunayFlipCount.
        quality: Add the cell arrays "Smallest angle before (degrees)" and "... after (degrees)".
        progress, on_iteration: Functions, as for delaunayflip.flip; returning False aborts.
        **options: Options of delaunayflip.flip, such as geometry and feature_angle. region_array: a
            cell array; edges between its values stay. lines_as_constraints, insert_lines,
            insert_constraints and triangulate as in vtkDelaunayFlip. size: an array, or the name of
            a point array. region_seeds as for delaunayflip.flip; labels are in the cell array
            "Region". Points that refinement adds (minimum_angle, maximum_area, ...) get z and
            data that are linear between the others. Triangles get the data of the cell that contains
            their centroid.

    Returns:
        The mesh. Its field data tells what was done, e.g. "DelaunayFlip:TotalFlips".

    Raises:
        delaunayflip.FlipError: Its subclasses say what is wrong with the mesh or the options.
        TypeError: The mesh, or the constraints, are no PolyData; or a keyword is not an option.
        ValueError: A value is not among the choices, or out of range.

    Example:
        >>> import pyvista
        >>> import delaunayflip.pyvista
        >>> kite = pyvista.PolyData([[0.0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]],
        ...                         faces=[3, 0, 1, 2, 3, 0, 2, 3])
        >>> better = delaunayflip.pyvista.flip(kite)
        >>> int(better.field_data["DelaunayFlip:TotalFlips"][0])
        1
    """
    run = _open(mesh, constraints, options, progress)
    if run.session.report.stop_reason != "aborted":
        run.session.advance(progress=progress, on_iteration=on_iteration)
    return _make_mesh(mesh, run, flip_counts, quality)


def triangulate(
    cloud: typing.Any, segments: "typing.Union[None, pyvista.PolyData, Numbers]" = None, *,
    outline: "typing.Union[None, pyvista.PolyData, Rings]" = None,
    holes: "typing.Union[None, pyvista.PolyData, Rings]" = None,
    hole_seeds: "typing.Optional[Numbers]" = None, ring_rule: "RingRule" = "evenodd",
    lines_as_segments: bool = False, closed_lines_as_rings: bool = True, pass_segments: bool = False,
    heights: "typing.Optional[Heights]" = None, size: "typing.Union[None, str, Numbers]" = None,
    projection: "Projection" = "xy", degrees: bool = False, **options: typing.Any,
) -> "pyvista.PolyData":
    """The Delaunay mesh of the points of a dataset in x and y, or on a sphere, with their data.

    Args:
        cloud: A dataset with points of its own, such as a PolyData or a PointSet; its cells do not
            matter.
        segments: Pairs of point ids, as for delaunayflip.triangulate, or a PolyData. Its lines become
            edges of the mesh. Its polygons, and lines that end where they begin, are rings of the
            outline. Its points are added, with their data, where they are new.
        outline, holes: As for delaunayflip.triangulate; or a PolyData. Its polygons and lines are
            rings. Each line must end where it begins; `strip()` of a PolyData joins its parts.
        hole_seeds, ring_rule: As for delaunayflip.triangulate.
        lines_as_segments: Whether the lines of `cloud` become edges, too.
        closed_lines_as_rings: If False, closed lines of the segments are only edges, such as contours.
        pass_segments: Whether the mesh also gets the edges that segments have become, as lines before the
            triangles, with two arrays "SegmentIds". That of cells has the id of the cell of `segments`
            (or its row) along which each line runs, -1 for triangles; that of points has the cell on
            which refinement has put each point, else -1. Cells of `cloud` are numbered after those of
            `segments`; rings of outline and holes follow.
        heights: As for delaunayflip.triangulate, for the points of segments and rings. Whatever their
            heights, they get the data of the cloud there, in arrays of numbers that the segments do not
            have.
        size: As for delaunayflip.triangulate, or the name of a point array. Points that refinement adds
            get z and data that are linear between the points.
        projection: "xy"; "sphere": on a sphere around the origin, with segments and rings as for
            delaunayflip.triangulate_sphere; "open-sphere": the same with open=True. Refinement, regions,
            sizes and limits of lengths are errors on a sphere.
        degrees: On a sphere, whether x and y of all points, lines, rings and seeds are longitudes and
            latitudes in degrees. Only those of the cloud and of meshes of segments are checked for
            latitudes beyond 90. The mesh has their places on the unit sphere, and z, if it is not 0
            throughout, as the point array "Height".
        **options: The other keywords of delaunayflip.triangulate, such as minimum_angle, maximum_area,
            regions, alpha, backend and progress.

    Returns:
        The mesh, with the cell array "Region" if there are regions (0 for lines). Its field data tells what
        was done, e.g. "DelaunayFlip:SegmentEdges".

    Raises:
        The same exceptions as delaunayflip.triangulate; TypeError for other datasets.

    Example:
        >>> import pyvista
        >>> import delaunayflip.pyvista
        >>> cloud = pyvista.PolyData([[0.0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]])
        >>> delaunayflip.pyvista.triangulate(cloud).n_cells
        2
    """
    size_array = size if isinstance(size, str) else ""
    if not size_array:
        options["size"] = size
    given = _read_cloud(
        cloud, segments, outline, holes, options, heights=heights, hole_seeds=hole_seeds,
        size_array=size_array, ring_rule=ring_rule, lines_as_segments=lines_as_segments,
        projection=projection, degrees=degrees,
        pass_segments=pass_segments, closed_lines_as_rings=closed_lines_as_rings)
    made = pyvista.PolyData()
    _warn(given.write(_triangulate_arrays(given, **options), made))
    return made


def interpolate(
    cloud: typing.Any, onto: typing.Any,
    segments: "typing.Union[None, pyvista.PolyData, Numbers]" = None, *, method: "Method" = "linear",
    outside: "Outside" = "nan", outline: "typing.Union[None, pyvista.PolyData, Rings]" = None,
    holes: "typing.Union[None, pyvista.PolyData, Rings]" = None, heights: "typing.Optional[Heights]" = None,
    progress: "typing.Optional[Progress]" = None, projection: "Projection" = "xy", degrees: bool = False,
    **options: typing.Any,
) -> typing.Any:
    """The data of points at the points of another dataset, interpolated in x and y or on a sphere.

    Args:
        cloud: A dataset with points of its own, as for `triangulate`.
        onto: Any dataset, such as an ImageData for a raster; it is not changed.
        segments, outline, holes, heights: As for `triangulate`. New points have data as if they were
            in the cloud, unless the segments have arrays of these names.
        method: "linear" in the triangles, or "natural" for natural neighbours.
        outside: "nan", "nearest" or "error", as for delaunayflip.LinearInterpolator.
        progress: Called with the share of the work done, 0 to 1; False stops it.
        projection, degrees: As for `triangulate`. The points of `onto` are like those of the cloud:
            longitudes and latitudes, or directions from the origin.
        **options: The other keywords of `triangulate`.

    Returns:
        A copy of `onto` with the point arrays of numbers of the cloud, z as "Elevation" if the cloud
        has no such array and z is a height, and "vtkValidPointMask": 1 where a place is in a triangle,
        else 0.

    Raises:
        The same exceptions as delaunayflip.triangulate; ValueError for outside="error";
        delaunayflip.Stopped if `progress` has returned False.

    Example:
        >>> import pyvista
        >>> import delaunayflip.pyvista
        >>> cloud = pyvista.PolyData([[0.0, 0, 0], [2, 0, 2], [0, 2, 4], [2, 2, 6]])
        >>> image = pyvista.ImageData(dimensions=(3, 3, 1))
        >>> delaunayflip.pyvista.interpolate(cloud, image)["Elevation"].tolist()
        [0.0, 1.0, 2.0, 2.0, 3.0, 4.0, 4.0, 5.0, 6.0]
    """
    if not hasattr(onto, "GetPointData"):
        raise TypeError(f"onto must be a dataset with points, not {type(onto).__name__}")
    given = _read_cloud(
        cloud, segments, outline, holes, options, heights=heights, as_doubles=True, projection=projection,
        degrees=degrees, **{name: options.pop(name) for name in _POINTS_OPTIONS if name in options})
    inspect.signature(_triangulate_arrays).bind(given, **options)  # refuses unknown ones
    result, _ = run_points(given, options, halve(progress, 0.0), keeps=True)
    mesh, made = pyvista.PolyData(), onto.copy(deep=False)
    nothing = "" if cloud.GetNumberOfPoints() else "the cloud has no points, so there are no values"
    _warn("; ".join(filter(None, (nothing, given.write(result, mesh)))))
    if result.report.stop_reason == "aborted":
        raise Stopped("stopped by progress")
    arrays = _list_numbers(given.data.GetPointData(), mesh.point_data)
    if projection == "xy":
        arrays.setdefault(_ELEVATION, mesh.points[:, 2])
    columns = [numpy.reshape(array, (len(array), math.prod(array.shape[1:]))).astype(float)
               for array in arrays.values()]
    columns = columns or [numpy.zeros((len(mesh.points), 1))]  # for a cloud without numbers
    field = Field(result._answers, numpy.concatenate(columns, axis=1), method=method, outside=outside,
                  fill_value=math.nan)
    places = read_places([onto.points])
    places.members["degrees"] = int(degrees and projection != "xy")
    triangles, values = field.find_both(places, halve(progress, 0.5))
    ends = numpy.cumsum([column.shape[1] for column in columns])
    for (name, array), found in zip(arrays.items(), numpy.split(values, ends, axis=1)):
        kind = numpy.float32 if array.dtype == numpy.float32 else float
        made.point_data[name] = found.reshape(-1, *array.shape[1:]).astype(kind)
    made.point_data["vtkValidPointMask"] = (triangles >= 0).astype(numpy.int8)
    return made


def smallest_angles(mesh: "pyvista.PolyData") -> Array:
    """The smallest angle of each triangle of a mesh of triangles, (m,) in degrees.

    Raises:
        TypeError: The mesh is no PolyData.
        ValueError: It has other polygons than triangles, or strips.

    Example:
        >>> import pyvista
        >>> import delaunayflip.pyvista
        >>> angles = delaunayflip.pyvista.smallest_angles(pyvista.Plane().triangulate())
        >>> round(float(angles.min()), 3)
        45.0
    """
    surface = vtk_of(_require_mesh("mesh", mesh)).read(mesh)
    polygons = surface.read("Polys")
    if not polygons.are_triangles() or mesh.GetNumberOfStrips():
        raise ValueError("the mesh has strips, or polygons that are no triangles: mesh.triangulate() "
                         "divides them")
    return _angles_of_arrays(surface.points, polygons.corners.reshape(-1, 3))


def plot_quality(mesh: "pyvista.PolyData", **arguments: typing.Any) -> typing.Any:
    """Plots the mesh, coloured by the smallest angles of its triangles; slivers are red.

    Args:
        mesh: Any PolyData. A copy of it, without lines and vertices and split into triangles, is
            plotted.
        **arguments: Passed to pyvista.PolyData.plot.

    Returns:
        The result of pyvista.PolyData.plot.
    """
    surface = vtk_of(_require_mesh("mesh", mesh)).read(mesh)
    shown = _color_by_quality(surface.points, Slots(surface, True).triangles)
    return shown.plot(**{**_LOOK, "cpos": _choose_camera(mesh), **arguments})


def animate(
    mesh: "pyvista.PolyData", filename: str, *, iterations_per_frame: int = 1, fps: int = 5,
    window_size: typing.Tuple[int, int] = (800, 600),
    constraints: "typing.Optional[pyvista.PolyData]" = None, **options: "Unpack[Options]",
) -> "pyvista.PolyData":
    """Writes a film of the flips: one frame of the input, and one after each step.

    Args:
        mesh: A mesh as `flip` takes it.
        filename: .gif (needs imageio) or .mp4 (also needs imageio-ffmpeg).
        iterations_per_frame: How many iterations are between two frames.
        fps: Frames per second.
        window_size: Width and height in pixels.
        constraints, **options: Those of `flip`.

    Returns:
        The flipped mesh of the last frame.

    Raises:
        The same exceptions as `flip`.
    """
    iterations_per_frame = check_integer("iterations_per_frame", iterations_per_frame, 1, 2**63 - 1)
    run = _open(mesh, constraints, options)
    plotter = pyvista.Plotter(off_screen=True, window_size=list(window_size))
    try:
        if str(filename).endswith(".gif"):
            plotter.open_gif(str(filename), fps=fps)
        else:
            plotter.open_movie(str(filename), framerate=fps)
        shown = _color_by_quality(run.session.points, run.session.triangles)
        plotter.add_mesh(shown, **_LOOK)
        plotter.camera_position = _choose_camera(mesh) or "iso"
        plotter.write_frame()
        is_running = True
        while is_running:
            is_running = run.session.advance(iterations_per_frame)
            shown.copy_from(_color_by_quality(run.session.points, run.session.triangles))
            plotter.write_frame()
    finally:
        plotter.close()
    return _make_mesh(mesh, run)


class DelaunayAccessor:
    """`mesh.delaunay`: the functions of this module for one mesh."""

    def __init__(self, mesh: "pyvista.PolyData") -> None:
        self._mesh = mesh


for _function in (flip, triangulate, interpolate, smallest_angles, plot_quality, animate):
    setattr(DelaunayAccessor, _function.__name__, property(
        lambda self, function=_function: types.MethodType(function, self._mesh), doc=_function.__doc__))

if hasattr(pyvista, "register_dataset_accessor"):
    pyvista.register_dataset_accessor("delaunay", pyvista.PolyData)(DelaunayAccessor)


def _require_mesh(name, mesh):
    if not isinstance(mesh, pyvista.PolyData):
        raise TypeError(f"{name} must be a pyvista.PolyData, not {type(mesh).__name__}; "
                        "mesh.extract_surface().triangulate() makes one from a grid or an image, and "
                        "mesh.warp_by_scalar() before that makes terrain from heights in an image")
    return mesh


@contextlib.contextmanager
def _with_keyword():
    """Puts the keyword for the sizes near points into messages, in place of the filter's property."""
    try:
        yield
    except InvalidOptions as error:
        error.args = (str(error).replace("SizeArray: ", "size: ", 1), *error.args[1:])
        raise


def _read_cloud(cloud, segments, outline, holes, options, *, projection, degrees, **settings):
    """The points of a dataset with their segments. `options`: they say where heights are found."""
    if not hasattr(cloud, "GetPoints"):
        raise TypeError(f"cloud must be a dataset with points, not {type(cloud).__name__}")
    if isinstance(segments, vtk_of(cloud).model.vtkDataObject):
        _require_mesh("segments", segments)
    number = choose("projection", projection, typing.get_args(Projection))
    degrees = bool(check_integer("degrees", degrees, 0, 1, "True or False"))
    if degrees and number == 0:
        raise ValueError('degrees=True needs projection="sphere" or "open-sphere"')
    rings = {"outline": _list_rings("outline", outline), "holes": _list_rings("holes", holes)}
    seeds = settings.pop("hole_seeds", None)
    if number == 0:
        rings["hole_seeds"], seeds = seeds, None
    elif settings["heights"] == "survey":
        raise ValueError('heights="survey" is for projection="xy"')
    else:
        rings = {name: [ring if ring.ndim == 1 else _place(name, ring, degrees)
                        for ring in list_rings(name, value)] for name, value in rings.items()}
    if number and degrees:
        name = _ELEVATION if settings.get("as_doubles") else HEIGHT_ARRAY
        cloud, segments = _place_meshes(cloud, segments, name, settings["heights"] == "own")
        if settings["heights"] is None:
            settings["height_array"] = name
    with _with_keyword():
        given = PointsInput(
            cloud, segments, **rings, projection=number,
            backend={name: options[name] for name in ("backend", "threads", "device") if name in options},
            **settings)
    if seeds is not None:
        given.take_seeds(_place("hole_seeds", as_plane(seeds, "hole_seeds"), degrees))
    return given


def _place(name, coordinates, degrees):
    """The places of coordinates on a sphere."""
    if degrees:
        return place_on_sphere(coordinates[:, :2])
    if coordinates.shape[1] != 3:
        raise ValueError(f"{name}: places on a sphere have x, y and z; longitudes and latitudes need degrees=True")
    return coordinates


def _place_meshes(cloud, segments, name, are_own):
    """A cloud, and perhaps a mesh of segments, with the places of their longitudes and latitudes. z becomes
    an array of this name; that of segments, if it is 0 throughout, only if `are_own`."""
    placed, trouble = place_points(cloud)
    _warn(trouble, 5)
    taken = keep_heights(cloud, name, placed.GetPointData(), always=name == _ELEVATION)
    if name == HEIGHT_ARRAY:
        _warn(taken, 5)
    if hasattr(segments, "GetPolys"):
        given = segments
        segments, trouble = place_points(given)
        _warn(trouble and "segments: " + trouble, 5)
        if not taken:
            trouble = keep_heights(given, name, segments.GetPointData(), are_own, "they")
            _warn(trouble and "segments: " + trouble, 5)
    return placed, segments


def _list_numbers(given, extended):
    """By name, the arrays of numbers of point data, but no labels, as they are after points were added."""
    labels = [array.GetName() for array in (given.GetGlobalIds(), given.GetPedigreeIds()) if array]
    names = [given.GetArrayName(i) for i in range(given.GetNumberOfArrays())]
    arrays = {name: extended[name] for name in names if name in extended}
    return {name: array for name, array in arrays.items()
            if array.dtype.kind in "fiu" and name not in (*labels, "vtkGhostType")}


def _warn(trouble, level=3):
    if trouble:
        warnings.warn(trouble, stacklevel=level)


def _list_rings(name, given):
    """The polygons and lines of a mesh as rings of coordinates; what is no mesh as it is."""
    if not hasattr(given, "GetPolys"):
        if hasattr(given, "GetDataObjectType"):
            raise TypeError(f"{name} must be a pyvista.PolyData or rings of points, not "
                            f"{type(given).__name__}")
        return given
    if given.GetNumberOfPoints() and not given.GetNumberOfLines() + given.GetNumberOfPolys():
        raise ValueError(f"{name} must have polygons or closed lines, which are its rings; it has "
                         f"{given.GetNumberOfPoints()} points and no such cells")
    surface = vtk_of(given).read(given)
    rings = []
    for kind in ("Lines", "Polys"):
        cells = surface.read(kind)
        cells.require_points(len(surface.points))
        for number, (start, end) in enumerate(zip(cells.offsets[:-1], cells.offsets[1:])):
            ring = surface.points[cells.corners[start:end]]
            if kind == "Lines" and len(ring) and not numpy.array_equal(ring[0], ring[-1]):
                raise ValueError(f"{name}: line {number} does not end where it begins, so it is no ring; "
                                 "mesh.strip() joins lines that follow each other")
            rings.append(ring)
    return rings


def _open(mesh, constraints, options, progress=None):
    """The mesh as MeshInput, with its session."""
    _require_mesh("mesh", mesh)
    if constraints is not None:
        _require_mesh("constraints", constraints)
    flags = {name: bool(check_integer(name, options.pop(name), 0, 1, "True or False"))
             for name in SETTINGS[:-2] if name in options}
    regions = options.pop("region_array", None)
    regions = "" if regions is None else regions
    if not isinstance(regions, str):
        raise TypeError(f"region_array must be the name of a cell array, not {show(regions)}")
    if regions and regions not in mesh.cell_data:
        listed = ", ".join(map(repr, mesh.cell_data)) or "none"
        raise InvalidOptions(
            f"region_array: the mesh has no cell array {regions!r}; it has {listed}")
    size, seeds = options.pop("size", None), options.pop("region_seeds", ())
    make_options(**options)  # refuses what is none, such as `regions`
    name = size if isinstance(size, str) else ""
    if name and name not in mesh.point_data:
        listed = ", ".join(map(repr, mesh.point_data)) or "none"
        raise InvalidOptions(f"size: the mesh has no point array {name!r}; it has {listed}")
    with _with_keyword():
        run = MeshInput(mesh, constraints, **flags, region_array=regions, size_array=name,
                        region_seeds=seeds)
    if size is not None and not name:
        run.take_sizes(size)
    run.session_type = Session
    run.open(progress=progress, **options)
    return run


def _make_mesh(mesh, run, flip_counts=False, quality=False):
    """The mesh so far. The engine's warnings become Python's."""
    made = mesh.copy(deep=False)
    if len(run.slots.triangles) == 0:
        warnings.warn("Nothing was flipped: the mesh has no triangles, polygons or strips.", stacklevel=3)
        return made
    run.store(made, flip_counts, quality)
    trouble = run.report(made, run.sum_up())
    if trouble:
        warnings.warn(trouble, stacklevel=3)
    return made


def _color_by_quality(points, triangles):
    shown = pyvista.PolyData(points, faces=numpy.insert(triangles, 0, 3, axis=1).ravel())
    shown.cell_data[_QUALITY] = _angles_of_arrays(points, triangles)
    return shown


def _choose_camera(mesh):
    """Looks from above if the mesh is flat."""
    x, y, z = (mesh.bounds[2 * i + 1] - mesh.bounds[2 * i] for i in range(3))
    return "xy" if z <= 0.05 * max(x, y) else None

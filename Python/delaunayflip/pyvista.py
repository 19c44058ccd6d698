# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for PyVista.

With PyVista 0.48 or newer, and if this package is installed, every PolyData has an accessor:

    better = mesh.delaunay.flip()
    better.delaunay.plot_quality()
    mesh.delaunay.animate("flips.gif")

With an older PyVista, or in a build folder, call the functions of this module with the mesh as
first argument: `delaunayflip.pyvista.flip(mesh)`.
"""
import typing
import warnings

import pyvista

from . import _errors, _library
from ._flip import smallest_angles as _angles_of_arrays
from ._types import Array, Criterion, Geometry, TieRule
from ._vtk import vtkDelaunayFlip

_QUALITY = "Smallest angle"
_CHOICES = {"geometry": ("Geometry", _library.GEOMETRIES),
            "criterion": ("Criterion", _library.CRITERIA),
            "tie_rule": ("TieRule", _library.TIE_RULES),
            "backend": ("Backend", _library.BACKENDS)}
_NAMES = {"threads": "NumberOfThreads", "device": "DeviceId", "pieces": "NumberOfPieces"}


class Options(typing.TypedDict, total=False):
    """Keywords of `flip`; see there and at delaunayflip.flip."""

    geometry: Geometry
    criterion: Criterion
    tie_rule: TieRule
    tolerance: float
    feature_angle: float
    region_array: str
    lines_as_constraints: bool
    insert_lines: bool
    insert_constraints: bool
    triangulate: bool
    maximum_iterations: int
    backend: str
    threads: int
    device: int
    devices: str
    pieces: int


if typing.TYPE_CHECKING:
    from typing_extensions import Unpack


def flip(
    mesh: "pyvista.PolyData", *, constraints: "typing.Optional[pyvista.PolyData]" = None,
    flip_counts: bool = False, quality: bool = False, **options: "Unpack[Options]",
) -> "pyvista.PolyData":
    """A Delaunay mesh of the same points, with the attributes of the mesh.

    Quads, polygons and strips become triangles; lines of the mesh are constraints.

    Args:
        mesh: Any PolyData; it is not changed.
        constraints: Lines and polygons whose edges stay, and are inserted where the mesh is planar.
        flip_counts: Add the cell array vtkDelaunayFlipCount.
        quality: Add vtkDelaunayFlipAngleBefore and ...After, the smallest angles in degrees.
        **options: geometry, criterion, tie_rule, tolerance, feature_angle, maximum_iterations,
            backend, threads, device, devices ("0,1") and pieces as for delaunayflip.flip;
            region_array: a cell array, edges between its values stay; lines_as_constraints,
            insert_lines, insert_constraints and triangulate as in vtkDelaunayFlip.

    Returns:
        The mesh. Its field data tells what was done, e.g. "DelaunayFlip:TotalFlips".

    Raises:
        delaunayflip.FlipError: Its subclasses say what is wrong with the mesh or the options.
        TypeError: A keyword is not an option.
        ValueError: A value is not among the choices.

    Example:
        >>> import pyvista
        >>> import delaunayflip.pyvista
        >>> kite = pyvista.PolyData([[0.0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]],
        ...                         faces=[3, 0, 1, 2, 3, 0, 2, 3])
        >>> better = delaunayflip.pyvista.flip(kite)
        >>> int(better.field_data["DelaunayFlip:TotalFlips"][0])
        1
    """
    filter_ = _make_filter(mesh, constraints, options)
    filter_.SetGenerateFlipCount(flip_counts)
    filter_.SetGenerateQuality(quality)
    return _update(filter_)


def smallest_angles(mesh: "pyvista.PolyData") -> Array:
    """The smallest angle of each triangle of a mesh of triangles, (m,) in degrees.

    Example:
        >>> import pyvista
        >>> import delaunayflip.pyvista
        >>> angles = delaunayflip.pyvista.smallest_angles(pyvista.Plane().triangulate())
        >>> round(float(angles.min()), 3)
        45.0
    """
    return _angles_of_arrays(mesh.points, mesh.faces.reshape(-1, 4)[:, 1:])


def plot_quality(mesh: "pyvista.PolyData", **arguments: typing.Any) -> typing.Any:
    """Plots the mesh, coloured by the smallest angles of its triangles; slivers are red.

    Args:
        mesh: Any PolyData. A copy of it, without lines and vertices and split into triangles, is
            plotted.
        **arguments: Passed to pyvista.PolyData.plot.

    Returns:
        The result of pyvista.PolyData.plot.
    """
    shown = _color_by_quality(mesh)
    return shown.plot(**{**_look(), "cpos": _choose_camera(mesh), **arguments})


def animate(
    mesh: "pyvista.PolyData", filename: str, *, iterations_per_frame: int = 1, fps: int = 5,
    window_size: typing.Tuple[int, int] = (800, 600),
    constraints: "typing.Optional[pyvista.PolyData]" = None, **options: "Unpack[Options]",
) -> "pyvista.PolyData":
    """Writes a film of the flips: one frame of the input, and one after each step.

    Args:
        mesh: As for `flip`.
        filename: .gif (needs imageio) or .mp4 (also needs imageio-ffmpeg).
        iterations_per_frame: How many iterations are between two frames.
        fps: Frames per second.
        window_size: Width and height in pixels.
        constraints, **options: As for `flip`.

    Returns:
        The flipped mesh of the last frame.

    Raises:
        The same exceptions as `flip`.
    """
    filter_ = _make_filter(mesh, constraints, options)
    filter_.LiveUpdateOn()
    filter_.SetIterationsPerUpdate(iterations_per_frame)
    plotter = pyvista.Plotter(off_screen=True, window_size=list(window_size))
    try:
        _open_film(plotter, filename, fps)
        shown = _color_by_quality(mesh)
        plotter.add_mesh(shown, **_look())
        plotter.camera_position = _choose_camera(mesh) or "iso"
        plotter.write_frame()
        is_running = True
        while is_running:
            flipped = _update(filter_)
            shown.copy_from(_color_by_quality(flipped))
            plotter.write_frame()
            is_running = filter_.Advance()
    finally:
        plotter.close()
    return flipped


class DelaunayAccessor:
    """`mesh.delaunay`: the functions of this module for one mesh."""

    def __init__(self, mesh: "pyvista.PolyData") -> None:
        self._mesh = mesh

    def flip(self, **arguments: typing.Any) -> "pyvista.PolyData":
        return flip(self._mesh, **arguments)

    def smallest_angles(self) -> Array:
        return smallest_angles(self._mesh)

    def plot_quality(self, **arguments: typing.Any) -> typing.Any:
        return plot_quality(self._mesh, **arguments)

    def animate(self, filename: str, **arguments: typing.Any) -> "pyvista.PolyData":
        return animate(self._mesh, filename, **arguments)

    for _function in (flip, smallest_angles, plot_quality, animate):
        locals()[_function.__name__].__doc__ = _function.__doc__


if hasattr(pyvista, "register_dataset_accessor"):
    pyvista.register_dataset_accessor("delaunay", pyvista.PolyData)(DelaunayAccessor)


def _make_filter(mesh, constraints, options):
    filter_ = vtkDelaunayFlip()
    filter_.SetInputDataObject(mesh)
    if constraints is not None:
        filter_.SetConstraintsData(constraints)
    for keyword, value in options.items():
        _set_option(filter_, keyword, value)
    filter_.told = {}
    for event in ("ErrorEvent", "WarningEvent"):
        _listen(filter_, event)
    return filter_


def _set_option(filter_, keyword, value):
    if keyword not in Options.__annotations__:
        raise TypeError(f"{keyword!r} is not an option")
    if keyword not in _CHOICES:
        name = _NAMES.get(keyword) or "".join(part.title() for part in keyword.split("_"))
        getattr(filter_, "Set" + name)(value)
        return
    name, words = _CHOICES[keyword]
    if value not in words:
        raise ValueError(f"{keyword} must be one of {', '.join(words)}, not {value!r}")
    getattr(filter_, "Set" + name)(words.index(value))


def _listen(filter_, event):
    def note(_filter, _event, text):
        told[event] = text.split("): ", 1)[-1].strip()

    told = filter_.told  # a reference to the filter would keep it alive
    note.CallDataType = "string0"
    filter_.AddObserver(event, note)


def _update(filter_):
    """The output. VTK's errors are raised as exceptions; its warnings become Python's warnings."""
    filter_.told.clear()
    filter_.Update()
    if filter_.GetFailure():
        kinds = {filter_.FAILURE_OPTIONS: _errors.InvalidOptions, filter_.FAILURE_MESH:
                 _errors.InvalidMesh, filter_.FAILURE_BACKEND: _errors.BackendUnavailable}
        raise kinds.get(filter_.GetFailure(), _errors.FlipError)(filter_.GetErrorMessage())
    if "WarningEvent" in filter_.told:
        warnings.warn(filter_.told["WarningEvent"], stacklevel=3)
    return pyvista.wrap(filter_.GetOutput()).copy(deep=False)


def _color_by_quality(mesh):
    shown = pyvista.PolyData(mesh.points, faces=mesh.faces).triangulate()
    shown.cell_data[_QUALITY] = smallest_angles(shown)
    return shown


def _look():
    return {"scalars": _QUALITY, "clim": (0.0, 60.0), "cmap": "RdYlBu", "show_edges": True,
            "scalar_bar_args": {"title": "Smallest angle (degrees)"}}


def _choose_camera(mesh):
    """Looks from above if the mesh is flat."""
    x, y, z = (mesh.bounds[2 * i + 1] - mesh.bounds[2 * i] for i in range(3))
    return "xy" if z <= 0.05 * max(x, y) else None


def _open_film(plotter, filename, fps):
    if str(filename).endswith(".gif"):
        plotter.open_gif(str(filename), fps=fps)
    else:
        plotter.open_movie(str(filename), framerate=fps)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay edge flips for triangle meshes.

With NumPy arrays:

    import delaunayflip

    result = delaunayflip.flip(points, triangles)
    result.triangles  # better triangles of the same points

    triangulation = delaunayflip.triangulate(points)
    triangulation.triangles  # of points that have none

    mesh = delaunayflip.MovingTriangulation(points)
    mesh.move(points)  # follows the points to new places

    globe = delaunayflip.triangulate_sphere(longitudes_and_latitudes)

    height = delaunayflip.LinearInterpolator(points, heights)
    height(places)  # values between points

Arrays of CuPy, PyTorch, Numba and all libraries with DLPack are flipped where they are, also on a
GPU.

As a filter of VTK:

    from delaunayflip import vtkDelaunayFlip

    flip = vtkDelaunayFlip()
    flip.SetInputConnection(reader.GetOutputPort())
    flip.Update()
    mesh = flip.GetOutput()

delaunayflip.vtkDelaunayFlipLiveView, if it was built, shows the filter at work in a window.

Modules are imported at their first use: the functions for arrays need NumPy but no VTK, the filter
needs VTK but no OpenGL, and the live view needs VTK's OpenGL modules too.
"""
import importlib
import importlib.util
import typing

if typing.TYPE_CHECKING:
    from ._interpolators import LinearInterpolator, NaturalNeighborInterpolator, griddata
    from ._library import (
        BackendUnavailable, FlipError, InvalidMesh, InvalidOptions, MeshTooLarge, Stopped,
        has_cuda_device, release_cuda_memory)
    from ._moving import MovingTriangulation
    from ._points import Triangulation, triangulate
    from ._report import Report
    from ._session import Result, Session, flip, smallest_angles
    from ._sphere import SphereInterpolator, SphereTriangulation, place_on_sphere, triangulate_sphere
    from ._vtk import vtkDelaunayFlip, vtkDelaunayFlipInterpolator, vtkDelaunayFlipPoints

    __version__: str

__all__ = [
    "BackendUnavailable", "FlipError", "InvalidMesh", "InvalidOptions", "LinearInterpolator",
    "MeshTooLarge", "MovingTriangulation", "NaturalNeighborInterpolator", "Report", "Result", "Session",
    "SphereInterpolator", "SphereTriangulation", "Stopped", "Triangulation", "flip", "griddata", "has_cuda_device",
    "place_on_sphere", "release_cuda_memory", "smallest_angles", "triangulate", "triangulate_sphere",
]
if importlib.util.find_spec("vtkmodules"):
    __all__ += ["vtkDelaunayFlip", "vtkDelaunayFlipInterpolator", "vtkDelaunayFlipPoints"]

# Modules of the names that are in neither _library nor _vtk.
_HOMES = {
    "Report": "_report", "Result": "_session", "Session": "_session", "flip": "_session",
    "MovingTriangulation": "_moving", "Triangulation": "_points", "triangulate": "_points", "smallest_angles": "_session",
    "LinearInterpolator": "_interpolators", "NaturalNeighborInterpolator": "_interpolators",
    "griddata": "_interpolators", "SphereInterpolator": "_sphere",
    "SphereTriangulation": "_sphere", "place_on_sphere": "_sphere", "triangulate_sphere": "_sphere",
}
# The names of _vtk, and what they need beside VTK.
_NEEDS = {
    "vtkDelaunayFlip": "numpy",
    "vtkDelaunayFlipInterpolator": "numpy",
    "vtkDelaunayFlipPoints": "numpy",
    "vtkDelaunayFlipLiveView": f"{__name__}.vtkDelaunayFlipRendering",
    "vtkPDelaunayFlip": f"{__name__}.vtkDelaunayFlipFiltersParallel",
}


def __getattr__(name: str) -> typing.Any:
    if name == "__version__":
        value = importlib.import_module("._library", __name__).version()
    elif name in __all__ or name in _NEEDS:
        home = "_vtk" if name in _NEEDS else _HOMES.get(name, "_library")
        value = getattr(importlib.import_module(f".{home}", __name__), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> typing.List[str]:
    """Only names that can be had: help() and inspect.getmembers() look all of them up."""
    absent = {name for name in _NEEDS if not _can_be_had(name)}
    return sorted({*globals(), *__all__, *_NEEDS, "__version__"} - absent)


def _can_be_had(name: str) -> bool:
    """Whether a name of _vtk can be imported. A module in C++ that is there may be for another VTK."""
    find = importlib.util.find_spec
    if not find("vtkmodules") or not find(_NEEDS[name]):
        return False
    if not _NEEDS[name].startswith(__name__):
        return True
    try:
        return importlib.import_module("._vtk", __name__)._is_built_for_this_vtk()
    except ImportError:
        return False

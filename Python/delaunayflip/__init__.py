# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay edge flips for triangle meshes.

With NumPy arrays:

    import delaunayflip

    result = delaunayflip.flip(points, triangles)
    result.triangles  # better triangles of the same points

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
import typing

if typing.TYPE_CHECKING:
    from ._errors import BackendUnavailable, FlipError, InvalidMesh, InvalidOptions, MeshTooLarge
    from ._flip import Result, flip, smallest_angles
    from ._library import has_cuda_device, release_cuda_memory
    from ._report import Report
    from ._session import Session
    from ._vtk import vtkDelaunayFlip

    __version__: str

_HOMES = {
    "flip": "._flip",
    "Result": "._flip",
    "Session": "._session",
    "Report": "._report",
    "smallest_angles": "._flip",
    "has_cuda_device": "._library",
    "release_cuda_memory": "._library",
    "FlipError": "._errors",
    "InvalidMesh": "._errors",
    "InvalidOptions": "._errors",
    "MeshTooLarge": "._errors",
    "BackendUnavailable": "._errors",
    "vtkDelaunayFlip": "._vtk",
    "vtkDelaunayFlipLiveView": "._vtk_rendering",
    "vtkPDelaunayFlip": "._vtk_parallel",
}

__all__ = [
    "BackendUnavailable", "FlipError", "InvalidMesh", "InvalidOptions", "MeshTooLarge", "Report",
    "Result", "Session", "flip", "has_cuda_device", "release_cuda_memory", "smallest_angles",
    "vtkDelaunayFlip",
]


def __getattr__(name: str) -> typing.Any:
    if name == "__version__":
        value = importlib.import_module("._library", __name__).version()
    elif name in _HOMES:
        value = getattr(importlib.import_module(_HOMES[name], __name__), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> typing.List[str]:
    return sorted([*globals(), *_HOMES, "__version__"])

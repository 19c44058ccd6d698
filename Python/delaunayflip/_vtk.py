# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The classes of VTK. The filter is the C++ class if it was built for the VTK that Python imports,
else the class in Python. So a process never loads two VTKs. The live view and the filter for many
ranks exist in C++ only, and are imported at their first use."""
import ctypes
import importlib.util
import os
import typing

# Base classes and types of the filters must be loaded before them.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel
import vtkmodules.vtkCommonTransforms

# The module of a class in C++, and those of VTK that must be loaded before it: of base classes, the
# rendering backend and the interactor styles.
_IN_CXX = {
    "vtkDelaunayFlipLiveView": (
        "vtkDelaunayFlipRendering",
        ("vtkInteractionStyle", "vtkRenderingFreeType", "vtkRenderingOpenGL2")),
    "vtkPDelaunayFlip": ("vtkDelaunayFlipFiltersParallel", ("vtkParallelCore",)),
}


def _is_built_for_this_vtk():
    """Whether this package has C++ modules that link the libraries of VTK already loaded."""
    if not hasattr(os, "RTLD_NOLOAD"):  # as on Windows
        return False
    try:
        from ._vtk_build import COMMON_CORE

        ctypes.CDLL(COMMON_CORE, os.RTLD_LAZY | os.RTLD_NOLOAD)
    except (ImportError, OSError):
        return False
    return importlib.util.find_spec(".vtkDelaunayFlipFilters", __package__) is not None


def __getattr__(name: str) -> typing.Any:
    if name not in _IN_CXX:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if not _is_built_for_this_vtk():
        raise ImportError(f"{name} needs a build of this package for the VTK that Python imports; a "
                          "wheel has none")
    module, needed = _IN_CXX[name]
    for other in needed:
        importlib.import_module(f"vtkmodules.{other}")
    return getattr(importlib.import_module(f".{module}", __package__), name)


if _is_built_for_this_vtk():
    from .vtkDelaunayFlipFilters import (
        vtkDelaunayFlip, vtkDelaunayFlipInterpolator, vtkDelaunayFlipPoints)
else:
    from ._vtk_filter import vtkDelaunayFlip
    from ._vtk_interpolator import vtkDelaunayFlipInterpolator
    from ._vtk_point_filter import vtkDelaunayFlipPoints

__all__ = ["vtkDelaunayFlip", "vtkDelaunayFlipInterpolator", "vtkDelaunayFlipPoints"]

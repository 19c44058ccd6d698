# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter of VTK: the C++ class if it was built for the VTK that Python imports, else the class
in Python. So a process never loads two VTKs."""
import ctypes
import importlib.util
import os

# Base classes and return types of vtkDelaunayFlip must be loaded before it.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel


def is_built_for_this_vtk():
    """Whether this package has C++ modules that link the libraries of VTK already loaded."""
    try:
        from ._vtk_build import COMMON_CORE
    except ImportError:
        return False
    try:
        ctypes.CDLL(COMMON_CORE, os.RTLD_LAZY | os.RTLD_NOLOAD)
    except OSError:
        return False
    return importlib.util.find_spec(".vtkDelaunayFlipFilters", __package__) is not None


if is_built_for_this_vtk():
    from .vtkDelaunayFlipFilters import vtkDelaunayFlip
else:
    from ._vtk_filter import vtkDelaunayFlip

__all__ = ["vtkDelaunayFlip"]

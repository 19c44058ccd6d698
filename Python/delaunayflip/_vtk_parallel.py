# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter for many ranks, a class in C++."""
from . import _vtk

if not _vtk.is_built_for_this_vtk():
    raise ImportError("vtkPDelaunayFlip needs a build of this package for the VTK that Python "
                      "imports; a wheel has none")

import vtkmodules.vtkParallelCore

from .vtkDelaunayFlipFiltersParallel import vtkPDelaunayFlip

__all__ = ["vtkPDelaunayFlip"]

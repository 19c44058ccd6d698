# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter of VTK."""
# Base classes and return types of vtkDelaunayFlip must be loaded before it.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel

from .vtkDelaunayFlipFilters import vtkDelaunayFlip

__all__ = ["vtkDelaunayFlip"]

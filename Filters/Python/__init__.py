# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay edge flips for triangle meshes, as a filter of VTK.

    from delaunayflip import vtkDelaunayFlip

    flip = vtkDelaunayFlip()
    flip.SetInputConnection(reader.GetOutputPort())
    flip.Update()
    mesh = flip.GetOutput()
"""
# The classes that vtkDelaunayFlip derives from and returns must be known before it is.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel

from .vtkDelaunayFlipFilters import vtkDelaunayFlip

__all__ = ["vtkDelaunayFlip"]

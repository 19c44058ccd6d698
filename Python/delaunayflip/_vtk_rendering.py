# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The live view of VTK, a class in C++."""
from . import _vtk

if not _vtk.is_built_for_this_vtk():
    raise ImportError("vtkDelaunayFlipLiveView needs a build of this package for the VTK that Python "
                      "imports; a wheel has none")

# These modules register the rendering backend and the interactor styles.
import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingFreeType
import vtkmodules.vtkRenderingOpenGL2

from .vtkDelaunayFlipRendering import vtkDelaunayFlipLiveView

__all__ = ["vtkDelaunayFlipLiveView"]

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The live view of VTK."""
# These modules register the rendering backend and the interactor styles.
import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingFreeType
import vtkmodules.vtkRenderingOpenGL2

from . import _vtk
from .vtkDelaunayFlipRendering import vtkDelaunayFlipLiveView

__all__ = ["vtkDelaunayFlipLiveView"]

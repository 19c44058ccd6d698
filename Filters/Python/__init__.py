# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay edge flips for triangle meshes, as a filter of VTK.

    from delaunayflip import vtkDelaunayFlip

    flip = vtkDelaunayFlip()
    flip.SetInputConnection(reader.GetOutputPort())
    flip.Update()
    mesh = flip.GetOutput()

delaunayflip.vtkDelaunayFlipLiveView, if it was built, shows the filter at work in a window. It is
loaded at its first use, together with VTK's OpenGL modules. The filter alone needs neither.
"""
# Base classes and return types of vtkDelaunayFlip must be loaded before it.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel

from .vtkDelaunayFlipFilters import vtkDelaunayFlip

__all__ = ["vtkDelaunayFlip"]


def __getattr__(name):
    """Loads the live view at its first use."""
    if name != "vtkDelaunayFlipLiveView":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    # These modules register the rendering backend and the interactor styles.
    import vtkmodules.vtkInteractionStyle
    import vtkmodules.vtkRenderingFreeType
    import vtkmodules.vtkRenderingOpenGL2

    from .vtkDelaunayFlipRendering import vtkDelaunayFlipLiveView

    globals()[name] = vtkDelaunayFlipLiveView
    return vtkDelaunayFlipLiveView

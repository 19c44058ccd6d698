# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay edge flips for triangle meshes, as a filter of VTK.

    from delaunayflip import vtkDelaunayFlip

    flip = vtkDelaunayFlip()
    flip.SetInputConnection(reader.GetOutputPort())
    flip.Update()
    mesh = flip.GetOutput()

delaunayflip.vtkDelaunayFlipLiveView, where it was built, shows the filter at work in a window. It
is loaded when it is first asked for, with VTK's OpenGL; the filter alone needs neither.
"""
# The classes that vtkDelaunayFlip derives from and returns must be known before it is.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel

from .vtkDelaunayFlipFilters import vtkDelaunayFlip

__all__ = ["vtkDelaunayFlip"]


def __getattr__(name):
    """The live view, when it is first asked for."""
    if name != "vtkDelaunayFlipLiveView":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    # These register what draws, and what moves the camera, with the classes that use it.
    import vtkmodules.vtkInteractionStyle
    import vtkmodules.vtkRenderingFreeType
    import vtkmodules.vtkRenderingOpenGL2

    from .vtkDelaunayFlipRendering import vtkDelaunayFlipLiveView

    globals()[name] = vtkDelaunayFlipLiveView
    return vtkDelaunayFlipLiveView

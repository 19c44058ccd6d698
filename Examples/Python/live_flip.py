#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shows in a window how flips make a mesh Delaunay. The window explains the keys.

With --frames no window opens: every step is written as PREFIX0000.png, PREFIX0001.png and so on,
and the last mesh as PREFIX.vtp.
"""
import sys

from delaunayflip import vtkDelaunayFlip, vtkDelaunayFlipLiveView
from example_files import DONE, GEOMETRIES, read_arguments, read_mesh, write_frames
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkRenderWindowInteractor


def main():
    arguments = read_arguments(__doc__)
    flip = vtkDelaunayFlip()
    flip.SetInputData(read_mesh(arguments.mesh))
    flip.SetGeometry(GEOMETRIES[arguments.geometry])
    window = vtkRenderWindow()
    window.SetWindowName("Delaunay flips")
    window.SetSize(700, 700)
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
    view = vtkDelaunayFlipLiveView()
    view.SetFilter(flip)
    view.SetInteractor(interactor)
    if arguments.frames:
        write_frames(view, window, arguments.frames)
        return DONE
    view.SetFrameInterval(200)  # milliseconds
    view.Run()
    interactor.Start()
    return DONE


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shows in a window how a mesh flips its way to Delaunay; the window names the keys.

With --frames no window opens: every step is written as PREFIX0000.png, PREFIX0001.png and so on,
and the last mesh as PREFIX.vtp.
"""
import argparse
import sys

from bad_mesh import make_bad_mesh
from delaunayflip import vtkDelaunayFlip, vtkDelaunayFlipLiveView
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkRenderWindowInteractor

def read_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="?", help=".vtp file (default: a bad mesh made here)")
    parser.add_argument("--frames", metavar="PREFIX", help="write frames instead of showing them")
    return parser.parse_args()


def main():
    arguments = read_arguments()
    reader = vtkXMLPolyDataReader()
    flip = vtkDelaunayFlip()
    if arguments.mesh:
        reader.SetFileName(arguments.mesh)
        flip.SetInputConnection(reader.GetOutputPort())
    else:
        flip.SetInputData(make_bad_mesh())

    window = vtkRenderWindow()
    window.SetWindowName("Delaunay flips")
    window.SetSize(700, 700)
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
    view = vtkDelaunayFlipLiveView()
    view.SetFilter(flip)
    view.SetInteractor(interactor)

    if not arguments.frames:
        view.SetFrameInterval(200)
        view.Run()
        interactor.Start()
        return 0

    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(360, 360)
    view.SetFramePrefix(arguments.frames)
    while view.Step():
        pass
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
    writer.SetInputConnection(flip.GetOutputPort())
    writer.SetFileName(arguments.frames + ".vtp")
    writer.Write()
    print(view.GetFrameNumber(), "steps,", flip.GetTotalFlips(), "flips")
    return 0 if writer.GetErrorCode() == 0 and view.GetConverged() else 1


if __name__ == "__main__":
    sys.exit(main())

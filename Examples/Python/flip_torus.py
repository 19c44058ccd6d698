#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a badly triangulated torus, flips it, and writes to FOLDER torus.vtp, the Delaunay mesh,
and torus.png, a picture of the mesh before (left) and after (right), with triangles coloured by
their smallest angles.
"""
import argparse
import math
import random
import sys

# These modules register the rendering backend.
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from delaunayflip import vtkDelaunayFlip
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

ROUND, ACROSS = 64, 28


def make_torus():
    """Rings of jittered points. Each is joined to the next one, shifted by two points."""
    generator = random.Random(1)
    points = vtkPoints()
    for ring in range(ROUND):
        for i in range(ACROSS):
            u = 2 * math.pi * (ring + generator.uniform(-0.25, 0.25)) / ROUND
            v = 2 * math.pi * (i + generator.uniform(-0.25, 0.25)) / ACROSS
            radius = 1 + 0.4 * math.cos(v)
            points.InsertNextPoint(
                radius * math.cos(u), radius * math.sin(u), 0.4 * math.sin(v))
    triangles = vtkCellArray()
    for ring in range(ROUND):
        this, other = ring * ACROSS, (ring + 1) % ROUND * ACROSS
        for i in range(ACROSS):
            a, b = this + i, this + (i + 1) % ACROSS
            c, d = other + (i + 2) % ACROSS, other + (i + 3) % ACROSS
            triangles.InsertNextCell(3, (a, c, b))
            triangles.InsertNextCell(3, (b, c, d))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(triangles)
    return mesh


def make_view(mesh, left):
    """One half of the picture. Red is a smallest angle of 0, blue of 60 degrees."""
    quality = vtkMeshQuality()
    quality.SetInputConnection(mesh)
    quality.SetTriangleQualityMeasureToMinAngle()
    colors = vtkLookupTable()
    colors.SetHueRange(0.0, 0.6)
    colors.SetSaturationRange(0.6, 0.6)
    colors.SetValueRange(1.0, 1.0)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(quality.GetOutputPort())
    mapper.SetLookupTable(colors)
    mapper.SetScalarRange(0.0, 60.0)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.3)
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.15, 0.15, 0.15)
    view = vtkRenderer()
    view.SetViewport(left, 0.0, left + 0.5, 1.0)
    view.SetBackground(1.0, 1.0, 1.0)
    view.AddActor(actor)
    view.GetActiveCamera().SetPosition(0.0, -1.0, 1.3)
    view.GetActiveCamera().SetViewUp(0.0, 0.0, 1.0)
    view.ResetCamera()
    view.GetActiveCamera().Zoom(1.4)
    return view


def write_picture(flip, file):
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(1400, 600)
    window.AddRenderer(make_view(flip.GetInputConnection(0, 0), 0.0))
    window.AddRenderer(make_view(flip.GetOutputPort(), 0.5))
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()
    return writer.GetErrorCode() == 0


def write_mesh(flip, file):
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
    writer.SetInputConnection(flip.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()
    return writer.GetErrorCode() == 0


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, epilog="Exit status: 0 done; 2 wrong usage; 3 a file cannot be written.")
    parser.add_argument("folder", nargs="?", default=".", metavar="FOLDER",
                        help="where to write (default: the current folder)")
    folder = parser.parse_args().folder

    flip = vtkDelaunayFlip()
    flip.SetInputData(make_torus())
    flip.SetFeatureAngle(180.0)  # a smooth surface: sharp edges are due to bad triangles
    flip.Update()
    print(flip.GetTotalFlips(), "flips in", flip.GetNumberOfIterations(), "iterations,",
          flip.GetNonDelaunayAfter(), "bad edges left")

    if not (write_mesh(flip, folder + "/torus.vtp") and write_picture(flip, folder + "/torus.png")):
        print(f"error: {folder}: cannot be written to", file=sys.stderr)
        return 3
    return 0 if flip.GetConverged() else 1


if __name__ == "__main__":
    sys.exit(main())

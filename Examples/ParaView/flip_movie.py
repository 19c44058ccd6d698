#!/usr/bin/env pvpython
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: pvpython flip_movie.py FOLDER [MESH.vtp]

Writes the frames of a run, one an iteration, to FOLDER/flip.0000.png and following, each triangle
coloured by how often it was part of a flip so far. Without a mesh it makes one of bad triangles.

The plugin is found by PV_PLUGIN_PATH. A movie is what a video encoder makes of the frames, or give
SaveAnimation the name of an .avi or .ogv file.
"""
import os
import random
import sys

from paraview import simple
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


def is_left(a, b, p):
    """Whether p lies to the left of a -> b."""
    return (b[0] - a[0]) * (p[1] - a[1]) > (b[1] - a[1]) * (p[0] - a[0])


def write_bad_mesh(file, number_of_points=250):
    """Random points in a square, each joined to the corners of the triangle that it falls into."""
    generator = random.Random(5)
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    triangles = [(0, 1, 2), (0, 2, 3)]
    while len(points) < number_of_points:
        p = (generator.random(), generator.random(), 0)
        around = next(t for t in triangles
                      if all(is_left(points[t[i - 1]], points[t[i]], p) for i in range(3)))
        triangles.remove(around)
        triangles += [(around[i - 1], around[i], len(points)) for i in range(3)]
        points.append(p)
    mesh = vtkPolyData()
    mesh.SetPoints(vtkPoints())
    mesh.SetPolys(vtkCellArray())
    for point in points:
        mesh.GetPoints().InsertNextPoint(point)
    for triangle in triangles:
        mesh.GetPolys().InsertNextCell(3, triangle)
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
    writer.SetInputData(mesh)
    writer.SetFileName(file)
    writer.Write()


def count_iterations(flip):
    """How many iterations the whole run takes."""
    flip.UpdatePipeline()
    flip.SMProxy.UpdatePipelineInformation()
    return int(flip.NumberOfIterations)


def show(flip, most_flips):
    view = simple.CreateRenderView(
        ViewSize=[400, 400], UseColorPaletteForBackground=0, Background=[1, 1, 1],
        OrientationAxesVisibility=0, InteractionMode="2D")
    display = simple.Show(flip, view)
    display.Representation = "Surface With Edges"
    display.EdgeColor = [0.2, 0.2, 0.2]
    display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0
    simple.ColorBy(display, ("CELLS", "vtkDelaunayFlipCount"))
    colors = simple.GetColorTransferFunction("vtkDelaunayFlipCount")
    colors.ApplyPreset("Inferno (matplotlib)", True)
    colors.InvertTransferFunction()
    colors.RescaleTransferFunction(0, most_flips)
    display.SetScalarBarVisibility(view, False)
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)
    return view


def animate(flip, iterations):
    """MaximumIterations runs from 0 to the last, one a frame."""
    scene = simple.GetAnimationScene()
    scene.PlayMode = "Sequence"
    scene.NumberOfFrames = iterations + 1
    track = simple.GetAnimationTrack("MaximumIterations", proxy=flip)
    # Half a step more, since the property takes whole numbers and drops what is behind the point.
    track.KeyFrames = [
        simple.CompositeKeyFrame(KeyTime=0.0, KeyValues=[0.5]),
        simple.CompositeKeyFrame(KeyTime=1.0, KeyValues=[iterations + 0.5])]
    return scene


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    mesh = sys.argv[2] if len(sys.argv) > 2 else os.path.join(folder, "mesh.vtp")
    if len(sys.argv) == 2:
        write_bad_mesh(mesh)

    flip = simple.DelaunayFlip(
        Input=simple.XMLPolyDataReader(FileName=[mesh]), GenerateFlipCount=1)
    iterations = count_iterations(flip)
    most_flips = flip.CellData["vtkDelaunayFlipCount"].GetRange()[1]
    view = show(flip, most_flips)
    animate(flip, iterations)
    simple.SaveAnimation(os.path.join(folder, "flip.png"), view, FrameWindow=[0, iterations],
                         SuffixFormat=".%04d")
    print(f"{iterations + 1} frames of {int(flip.TotalFlips)} flips in {folder}")
    simple.Disconnect()


main()

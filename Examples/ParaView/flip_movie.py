#!/usr/bin/env pvpython
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the frames of a run, one per iteration, to FOLDER/flip.0000.png and so on. Triangles are
coloured by the number of flips in which they have taken part.

The plugin is found by PV_PLUGIN_PATH. To make a movie, use a video encoder, or give SaveAnimation
the name of an .avi or .ogv file.
"""
import argparse
import os
import random
import sys

from paraview import simple
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

FORMATS = (".vtk", ".vtp", ".ply", ".stl", ".obj")
GEOMETRIES = {"auto": "Auto", "planar": "Planar", "planar-xy": "Planar XY", "surface": "Surface"}


def read_arguments():
    parser = argparse.ArgumentParser(
        usage="pvpython flip_movie.py [-h] [--geometry GEOMETRY] FOLDER [MESH]",
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Exit status: 0 done; 2 wrong usage; 3 a file cannot be read, written or used.")
    parser.add_argument("folder", metavar="FOLDER", help="where to write; created if necessary")
    parser.add_argument(
        "mesh", nargs="?", metavar="MESH",
        help=f"file to read: {' '.join(FORMATS)} (default: a generated bad mesh)")
    parser.add_argument(
        "--geometry", choices=GEOMETRIES, default="auto", metavar="GEOMETRY",
        help="where edges are judged: auto, planar, planar-xy (by x and y, for terrain), or surface "
             "(default: auto)")
    arguments = parser.parse_args()
    if arguments.mesh and not arguments.mesh.lower().endswith(FORMATS):
        parser.error(f"{arguments.mesh}: unknown file extension; known are {' '.join(FORMATS)}")
    return arguments


def fail(message):
    print("error:", message, file=sys.stderr)
    sys.exit(3)


def is_left(a, b, p):
    """Whether p lies to the left of a -> b."""
    return (b[0] - a[0]) * (p[1] - a[1]) > (b[1] - a[1]) * (p[0] - a[0])


def write_bad_mesh(file, number_of_points=250):
    """Random points in a square, each joined to the corners of the triangle that contains it."""
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
    """The number of iterations of the whole run."""
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
    version = simple.GetParaViewVersion()
    is_renamed = (version.major, version.minor) >= (6, 1)
    colors.ApplyPreset("Inferno" if is_renamed else "Inferno (matplotlib)", True)
    colors.InvertTransferFunction()
    colors.RescaleTransferFunction(0, most_flips)
    display.SetScalarBarVisibility(view, False)
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)
    return view


def animate(flip, iterations):
    """MaximumIterations runs from 0 to the last, one per frame."""
    scene = simple.GetAnimationScene()
    scene.PlayMode = "Sequence"
    scene.NumberOfFrames = iterations + 1
    track = simple.GetAnimationTrack("MaximumIterations", proxy=flip)
    # Half a step more, because the property is an integer and the value is truncated.
    track.KeyFrames = [
        simple.CompositeKeyFrame(KeyTime=0.0, KeyValues=[0.5]),
        simple.CompositeKeyFrame(KeyTime=1.0, KeyValues=[iterations + 0.5])]
    return scene


def read_mesh(file):
    if not os.path.isfile(file) or not os.access(file, os.R_OK):
        fail(f"{file}: no such file, or no permission to read it")
    reader = simple.OpenDataFile(file)
    reader.UpdatePipeline()
    if reader.GetDataInformation().GetNumberOfCells() == 0:
        fail(f"{file}: no mesh could be read")
    # The reader of .obj files repeats a point for every normal and texture coordinate.
    return simple.Clean(Input=reader) if file.lower().endswith(".obj") else reader


def main():
    arguments = read_arguments()
    folder = arguments.folder
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        fail(f"{folder}: {error.strerror}")
    mesh = arguments.mesh or os.path.join(folder, "mesh.vtp")
    if not arguments.mesh:
        write_bad_mesh(mesh)

    flip = simple.DelaunayFlip(
        Input=read_mesh(mesh), Geometry=GEOMETRIES[arguments.geometry], GenerateFlipCount=1)
    iterations = count_iterations(flip)
    if flip.GetDataInformation().GetNumberOfCells() == 0:
        fail(f"{mesh}: the mesh could not be flipped")
    most_flips = flip.CellData["vtkDelaunayFlipCount"].GetRange()[1]
    view = show(flip, most_flips)
    animate(flip, iterations)
    simple.SaveAnimation(os.path.join(folder, "flip.png"), view, FrameWindow=[0, iterations],
                         SuffixFormat=".%04d")
    print(f"{iterations + 1} frames of {int(flip.TotalFlips)} flips in {folder}")
    simple.Disconnect()


main()

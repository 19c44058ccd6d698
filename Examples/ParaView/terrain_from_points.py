#!/usr/bin/env pvpython
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: pvpython terrain_from_points.py FOLDER

Makes the mesh of a terrain from a table of scattered points and two breaklines, the edges of a slope.
Writes to FOLDER points.csv and breaklines.vtp, the input, and terrain.png, a picture of the mesh.

The plugin is found by PV_PLUGIN_PATH.
"""
import math
import os
import random
import sys

from paraview import simple
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

HALF_WIDTH = 0.02  # of the slope


def get_middle(x):
    """The middle of the slope."""
    return 0.5 + 0.15 * math.sin(6 * x)


def get_height(x, y):
    """Hills that a steep slope divides."""
    slope = min(max((y - get_middle(x)) / HALF_WIDTH, -1), 1)
    return 0.08 * slope + 0.02 * math.sin(9 * x) * math.cos(7 * y)


def write_points(file, count=600):
    generator = random.Random(3)
    with open(file, "w", encoding="utf-8") as table:
        table.write("x,y,z\n")
        for _ in range(count):
            x, y = generator.random(), generator.random()
            table.write(f"{x},{y},{get_height(x, y)}\n")


def write_breaklines(file):
    lines = vtkPolyData()
    lines.SetPoints(vtkPoints())
    lines.GetPoints().SetDataTypeToDouble()
    lines.SetLines(vtkCellArray())
    for side in (-1, 1):
        lines.GetLines().InsertNextCell(51)
        for i in range(51):
            x = 0.02 * i
            y = get_middle(x) + side * HALF_WIDTH
            lines.GetLines().InsertCellPoint(
                lines.GetPoints().InsertNextPoint(x, y, get_height(x, y)))
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # ParaView 5.11 with a newer expat fails on appended data
    writer.SetInputData(lines)
    writer.SetFileName(file)
    writer.Write()


def main(folder):
    points, breaklines = (os.path.join(folder, name) for name in ("points.csv", "breaklines.vtp"))
    write_points(points)
    write_breaklines(breaklines)

    table = simple.CSVReader(FileName=[points])
    cloud = simple.TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")
    terrain = simple.DelaunayFromPoints(
        Input=cloud, Segments=simple.XMLPolyDataReader(FileName=[breaklines]))
    terrain.UpdatePipeline()
    terrain.SMProxy.UpdatePipelineInformation()
    triangles = terrain.GetDataInformation().GetNumberOfCells()
    print(f"{triangles} triangles, {int(terrain.NumberOfSegmentEdges)} edges along segments")

    view = simple.CreateRenderView(
        ViewSize=[800, 600], UseColorPaletteForBackground=0, Background=[1, 1, 1],
        OrientationAxesVisibility=0)
    display = simple.Show(terrain, view)
    display.Representation = "Surface With Edges"
    display.Interpolation = "Flat"
    display.DiffuseColor = [0.75, 0.85, 0.65]
    display.EdgeColor = [0.3, 0.3, 0.3]
    view.CameraPosition, view.CameraFocalPoint = [0.5, -0.6, 1.2], [0.5, 0.5, 0]
    view.CameraViewUp = [0, 0, 1]
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)
    simple.SaveScreenshot(os.path.join(folder, "terrain.png"), view)
    simple.Disconnect()


if len(sys.argv) != 2:
    sys.exit("usage: pvpython terrain_from_points.py FOLDER")
main(sys.argv[1])
